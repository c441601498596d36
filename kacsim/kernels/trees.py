"""The tables of one module: what it binds, what each definition uses, and a digest of its tree.

Reading and hashing trees takes a second for the package, so that the tables of a file are kept,
under the hash of its bytes, beside the compiled kernels.
"""

import ast
import functools
import hashlib
import json
import sys

from kacsim.kernels import folder
from kacsim.kernels.changes import changes, place

OUTSIDE = "what it computes are names for results, not results"
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
SCOPES = (*FUNCTIONS, ast.ClassDef)
IMPORTS = (ast.Import, ast.ImportFrom)
COMPREHENSIONS = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
LAZY = "kacsim.kernels.lookup.lazy"  # lazy(module)
NAMED = "kacsim.kernels.lookup.named"  # named(package, module, attribute)
ATTACH = "lazy_loader.attach"
# What leads to code that no name in the tree stands for, or to texts that digests leave out.
HIDDEN = {"__doc__", "__dict__", "__globals__", "__builtins__", "__subclasses__", "__code__"}
HOOKS = {"__init_subclass__", "__set_name__"}
MOST_KEPT = 1000  # tables of files, several versions of each


class _Bare(ast.NodeTransformer):
    """Take out what changes no result: docstrings, annotations, what errors say."""

    def _body(self, node):
        self.generic_visit(node)
        first = node.body[0] if node.body else None
        if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
            node.body = node.body[1:] or [ast.Pass()]
        return node

    def visit_FunctionDef(self, node):
        node.returns = None
        return self._body(node)

    visit_AsyncFunctionDef = visit_FunctionDef  # noqa: N815
    visit_ClassDef = _body  # noqa: N815

    def visit_arg(self, node):
        node.annotation = None
        return node

    def visit_Raise(self, node):
        kind = node.exc.func if isinstance(node.exc, ast.Call) else node.exc
        return ast.copy_location(ast.Raise(exc=kind, cause=None), node)


def _chain(node):
    """Return the names of ``a.b.c`` as a tuple, None for an expression that is none."""
    found, whole = place(node)
    return found if whole else None


def _uses(node, found):
    """Add the dotted names that a tree reads to `found`, each as long as it is written."""
    chain = _chain(node)
    if chain is not None:
        found.add(chain)
        return
    for child in ast.iter_child_nodes(node):
        _uses(child, found)


def _imported(node, package):
    """Yield (name bound, dotted target) of one import; relative ones start from the package."""
    if isinstance(node, ast.Import):
        for name in node.names:
            top = name.name.split(".")[0]
            yield name.asname or top, name.name if name.asname else top
    elif isinstance(node, ast.ImportFrom):
        home = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
        for name in node.names:
            target = ".".join([*home, *filter(None, [node.module]), name.name])
            yield name.asname or name.name, target


def _aliases(nodes, package):
    """Return name -> dotted targets of the imports among some nodes; several may bind a name."""
    found = {}
    for node in nodes:
        for name, target in _imported(node, package):
            found.setdefault(name, set()).add(target)
    return {name: sorted(targets) for name, targets in found.items()}


def _meant(chain, aliases):
    """Return the dotted names that a chain may stand for, as far as imports say."""
    if chain is None:
        return set()
    return {".".join([target, *chain[1:]]) for target in aliases.get(chain[0], ())}


def _scope(node):
    """Yield the nodes of a statement that run in the scope of the module itself."""
    yield node
    if isinstance(node, (*SCOPES, ast.Lambda)):
        return
    for child in ast.iter_child_nodes(node):
        if isinstance(child, COMPREHENSIONS):
            yield from (one for one in ast.walk(child) if isinstance(one, ast.NamedExpr))
        else:
            yield from _scope(child)


def _targets(node):
    """Return the names that a statement binds in the scope of its module, imports apart."""
    found = {}
    for one in _scope(node):
        if isinstance(one, SCOPES):
            found[one.name] = None
        elif isinstance(one, ast.NamedExpr):
            found[one.target.id] = None
        elif isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store):
            found[one.id] = None
        elif isinstance(one, (ast.ExceptHandler, ast.MatchAs, ast.MatchStar)) and one.name:
            found[one.name] = None
        elif isinstance(one, ast.MatchMapping) and one.rest:
            found[one.rest] = None
    return list(found)


def _only_binds(node, fixed):
    """Tell a statement that does nothing but bind names.

    A call may change what it is given, unless that is a constant that cannot change.
    """
    if isinstance(node, SCOPES):
        return not node.decorator_list or not changes(node.decorator_list)
    if not isinstance(node, (ast.Assign, ast.AnnAssign)) or changes([node]):
        return False
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    if any(isinstance(one, (ast.Attribute, ast.Subscript)) for t in targets for one in ast.walk(t)):
        return False
    calls = [one for one in _scope(node) if isinstance(one, ast.Call)]
    given = (one for call in calls for one in (*call.args, *(k.value for k in call.keywords)))
    own = {one.id for part in given for one in ast.walk(part) if isinstance(one, ast.Name)}
    return not own & fixed


def _words(call):
    """Return the literal words of a call, None for each argument that is no literal."""
    if call.keywords or any(isinstance(word, ast.Starred) for word in call.args):
        return [None] * 4
    return [word.value if isinstance(word, ast.Constant) else None for word in call.args]


def _attached(node, module, aliases):
    """Return name -> targets of the public names that ``lazy_loader.attach`` gives a package."""
    call = getattr(node, "value", None)
    if not isinstance(call, ast.Call) or ATTACH not in _meant(_chain(call.func), aliases):
        return {}
    names = dict(zip(("package_name", "submodules", "submod_attrs"), call.args, strict=False))
    names |= {keyword.arg: keyword.value for keyword in call.keywords}
    modules, attributes = (
        ast.literal_eval(names[key]) if key in names else ()
        for key in ("submodules", "submod_attrs")
    )
    found = {name: [f"{module}.{name}"] for name in modules or ()}
    for home in attributes or ():
        found |= {name: [f"{module}.{home}.{name}"] for name in attributes[home]}
    return found


class _Definition:
    """What is known of one definition; several statements may bind its name."""

    def __init__(self, nodes, module_aliases, package):
        self.uses, self.dispatches, self.whole, self.unfollowed = set(), [], set(), set()
        self.constant = not all(isinstance(node, SCOPES) for node in nodes)
        inner = [one for node in nodes for one in ast.walk(node)]
        self.aliases = _aliases(inner, package)
        # Both count where an import in one scope hides another: which is read is not followed.
        self._known = {
            name: [*self.aliases.get(name, ()), *module_aliases.get(name, ())]
            for name in {*self.aliases, *module_aliases}
        }
        self.changes = sorted(map(list, changes(nodes)))
        digest = hashlib.sha256()
        for node in nodes:
            bare = _Bare().visit(node)
            _uses(bare, self.uses)
            self._look_up(bare)
            digest.update(ast.dump(bare, annotate_fields=False).encode())
        self.digest = digest.hexdigest()[:16]

    def _look_up(self, tree):
        """Note what is looked up by name, and what cannot be followed."""
        mentioned = followed = 0
        for one in ast.walk(tree):
            meant = _meant(_chain(one), self._known)
            mentioned += not meant.isdisjoint((LAZY, NAMED))
            if isinstance(one, ast.Call):
                followed += self._call(one)
            name = getattr(one, "attr", getattr(one, "id", getattr(one, "name", None)))
            if name in HIDDEN | HOOKS or getattr(one, "arg", None) == "metaclass":
                self.unfollowed.add(name or "metaclass")
        if mentioned != followed:
            self.unfollowed.add("a module looked up by a name that is not written there")

    def _call(self, call):
        """Return 1 for a look-up that can be followed, or that roots stand for."""
        meant, words = _meant(_chain(call.func), self._known), _words(call)
        if NAMED in meant and len(words) == 3:
            if words[0] and words[2]:
                self.dispatches.append(words)
            return 1
        if LAZY in meant and len(words) == 1 and words[0]:
            self.whole.add(words[0])
            return 1
        return 0

    def table(self):
        """Return it as JSON-ready values."""
        return {
            "digest": self.digest,
            "uses": sorted(map(list, self.uses)),
            "aliases": self.aliases,
            "dispatches": self.dispatches,
            "whole": sorted(self.whole),
            "changes": self.changes,
            "unfollowed": sorted(self.unfollowed),
            "constant": self.constant,
        }


def analysed(text, module, package):
    """Return the tables of a module's text.

    Parameters
    ----------
    text : str
    module, package : its dotted name, and that of the package that relative imports start from

    Returns
    -------
    dict of definitions (name -> what `_Definition.table` says), aliases (name -> dotted targets),
    effects (names of statements that do more than to bind names: they count with each
    definition), imports (dotted targets of all imports), outside (bool, the module says that its
    code decides nothing)
    """
    body = ast.parse(text).body
    bound, effects, lazy = {}, [], {}
    aliases = _aliases((one for node in body for one in _scope(node)), package)
    imports = _aliases((one for node in body for one in ast.walk(node)), package)
    fixed = _changeable(body)
    for node in body:
        if isinstance(node, IMPORTS):
            continue
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            continue
        names, value = _targets(node), getattr(node, "value", None)
        if isinstance(value, ast.Call) and LAZY in _meant(_chain(value.func), aliases):
            words = _words(value)
            if len(names) == len(words) == 1 and words[0]:
                lazy.setdefault(names[0], []).append(words[0])
                continue
        for name, targets in _attached(node, module, aliases).items():
            lazy.setdefault(name, []).extend(targets)
        if not _only_binds(node, fixed):
            effects.append(f"effect {len(effects) + 1}")
            names.append(effects[-1])
        for name in names:
            bound.setdefault(name, []).append(node)
    definitions = {name: _Definition(nodes, aliases, package) for name, nodes in bound.items()}
    for name, targets in lazy.items():
        aliases[name] = [*aliases.get(name, ()), *targets]
    return {
        "definitions": {name: entry.table() for name, entry in definitions.items()},
        "aliases": aliases,
        "effects": effects,
        "imports": sorted({target for targets in imports.values() for target in targets}),
        "outside": "OUTSIDE" in bound,
    }
