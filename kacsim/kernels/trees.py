"""The tables of one module: what it binds, what each definition uses, and a digest of its tree."""

import ast
import builtins
import hashlib

from kacsim.kernels.scopes import DEFINITIONS, chain, changes, now, place, targets

OUTSIDE = "what it computes are names for results, not results"

# What a constant that cannot change is made of.
FIXED = (ast.Constant, ast.UnaryOp, ast.BinOp, ast.Tuple, ast.operator, ast.unaryop, ast.Load)
LAZY = "kacsim.kernels.lookup.lazy"  # lazy(module)
NAMED = "kacsim.kernels.lookup.named"  # named(package, module, attribute)
HANDLE = "kacsim.kernels.lookup._Lazy"
ATTACH = "lazy_loader.attach"
# What leads to code that no name in the tree stands for, or to texts that digests leave out.
HIDDEN = {
    "__builtins__",
    "__code__",
    "__dict__",
    "__doc__",
    "__globals__",
    "__init_subclass__",
    "__set_name__",
    "__subclasses__",
    "metaclass",
}


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


def _uses(node, found):
    """Add the dotted names that a tree reads to `found`, each as long as it is written."""
    names = chain(node)
    if names is not None:
        found.add(names)
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
        levels = package.split(".")
        home = levels[: len(levels) - node.level + 1] if node.level else []
        for name in node.names:
            target = ".".join([*home, *filter(None, [node.module]), name.name])
            yield name.asname or name.name, target


def _aliases(nodes, package):
    """Return name -> dotted targets of the imports among some nodes; several may bind a name."""
    found = {}
    for node in nodes:
        for name, target in _imported(node, package):
            found.setdefault(name, set()).add(target)
    return {name: sorted(meant) for name, meant in found.items()}


def _meant(node, aliases):
    """Return the dotted names that an expression may stand for, as far as imports say."""
    names = chain(node)
    if names is None:
        return set()
    return {".".join([target, *names[1:]]) for target in aliases.get(names[0], ())}


def _words(call):
    """Return the literal words of a call, None for each argument that is no literal."""
    if call.keywords or any(isinstance(word, ast.Starred) for word in call.args):
        return [None] * 4
    return [word.value if isinstance(word, ast.Constant) else None for word in call.args]


def _attachment(call):
    """Return name -> module or function that ``lazy_loader.attach`` gives, None if not literal."""
    given = dict(zip(("name", "submodules", "submod_attrs"), call.args, strict=False))
    given |= {keyword.arg: keyword.value for keyword in call.keywords}
    try:
        modules = ast.literal_eval(given.get("submodules", ast.Constant(())))
        homes = ast.literal_eval(given.get("submod_attrs", ast.Dict([], [])))
    except ValueError:
        return None
    named = {name: f"{home}.{name}" for home, names in homes.items() for name in names}
    return {name: name for name in modules} | named


def _is_idle(node):
    """Tell a statement that is an import, which is followed by its name, or a bare text."""
    text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    return text or isinstance(node, (ast.Import, ast.ImportFrom))


class _Module:
    """A module's text: its names, imports and statements."""

    def __init__(self, text, module, package):
        self.module, self.package = module, package
        body = ast.parse(text).body
        self.aliases = _aliases((one for node in body for one in now(node, True)), package)
        imports = _aliases((one for node in body for one in ast.walk(node)), package)
        self.imports = sorted({target for meant in imports.values() for target in meant})
        self.statements = [_Bare().visit(node) for node in body if not _is_idle(node)]
        self.own = {name for node in self.statements for name in targets(node)}
        self.fixed = set()
        for node in self.statements:
            if isinstance(node, DEFINITIONS) or self._lasts(node):
                self.fixed |= set(targets(node))

    def _lasts(self, node):
        """Tell an assignment of a value that cannot change."""
        return isinstance(node, ast.Assign) and all(
            isinstance(one, FIXED) or (isinstance(one, ast.Name) and one.id in self.fixed)
            for one in ast.walk(node.value)
        )

    def only_binds(self, node):
        """Tell a statement that does nothing but bind names.

        A call may change what it is given, unless that cannot change or the function is Python's.
        """
        if any(not later and path[0] in self.own for _, later, path in changes([node])):
            return False
        if not targets(node) or not isinstance(node, (*DEFINITIONS, ast.Assign, ast.AnnAssign)):
            return False
        for call in now(node):
            if isinstance(call, ast.Call) and not self._is_python(call.func):
                given = [*call.args, *(keyword.value for keyword in call.keywords)]
                names = {n.id for g in given for n in ast.walk(g) if isinstance(n, ast.Name)}
                if names & self.own - self.fixed:
                    return False
        return True

    def _is_python(self, function):
        path, _ = place(function)
        known = path is None or (hasattr(builtins, path[0]) and path[0] not in self.aliases)
        return known and (path is None or path[0] not in self.own)

    def looked_up(self, node):
        """Return name -> targets of the names that a statement gives to modules, found lazily."""
        call = getattr(node, "value", None)
        if not isinstance(call, ast.Call):
            return {}
        meant, names, words = _meant(call.func, self.aliases), targets(node), _words(call)
        if LAZY in meant and len(names) == len(words) == 1 and words[0]:
            return {names[0]: [words[0]]}
        if ATTACH in meant:
            found = _attachment(call) or {}
            return {name: [f"{self.module}.{target}"] for name, target in found.items()}
        return {}


def _kind(node):
    if isinstance(node, ast.ClassDef):
        return "class"
    return "function" if isinstance(node, DEFINITIONS) else "constant"


class _Definition:
    """What is known of one definition; several statements may bind its name."""

    def __init__(self, nodes, module):
        self.uses, self.dispatches, self.whole, self.unfollowed = set(), [], set(), set()
        kinds = {_kind(node) for node in nodes}
        self.kind = kinds.pop() if len(kinds) == 1 else "constant"
        self.aliases = _aliases((one for node in nodes for one in ast.walk(node)), module.package)
        # Both count where an import in one scope hides another's: which is read is not followed.
        self._known = {
            name: [*self.aliases.get(name, ()), *module.aliases.get(name, ())]
            for name in {*self.aliases, *module.aliases}
        }
        self.changes = sorted([kind, later, list(path)] for kind, later, path in changes(nodes))
        digest = hashlib.sha256()
        for node in nodes:
            _uses(node, self.uses)
            self._look_up(node)
            digest.update(ast.dump(node, annotate_fields=False).encode())
        self.digest = digest.hexdigest()[:16]

    def _look_up(self, tree):
        """Note what is looked up by name, and what cannot be followed."""
        mentioned = followed = 0
        for one in ast.walk(tree):
            mentioned += not _meant(one, self._known).isdisjoint((LAZY, NAMED, HANDLE, ATTACH))
            followed += isinstance(one, ast.Call) and self._is_followed(one)
            names = {getattr(one, key, None) for key in ("attr", "id", "name", "arg")}
            self.unfollowed |= {name for name in names if isinstance(name, str)} & HIDDEN
        if mentioned != followed:
            self.unfollowed.add("a look-up whose names are not written in it")

    def _is_followed(self, call):
        """Tell a look-up that can be followed, or that roots stand for; note its words."""
        meant, words = _meant(call.func, self._known), _words(call)
        if NAMED in meant and len(words) == 3:
            if words[0] and words[2]:
                self.dispatches.append(words)
            return True
        if LAZY in meant and len(words) == 1 and words[0]:
            self.whole.add(words[0])
            return True
        return ATTACH in meant and _attachment(call) is not None

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
            "kind": self.kind,
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
    read = _Module(text, module, package)
    bound, effects = {}, []
    aliases = {name: list(targets) for name, targets in read.aliases.items()}
    for node in read.statements:
        found, names = read.looked_up(node), targets(node)
        for name, meant in found.items():
            aliases.setdefault(name, []).extend(meant)
        if found and set(names) == set(found):
            continue
        if not read.only_binds(node):
            effects.append(f"effect {len(effects) + 1}")
            names.append(effects[-1])
        for name in names:
            bound.setdefault(name, []).append(node)
    return {
        "definitions": {name: _Definition(nodes, read).table() for name, nodes in bound.items()},
        "aliases": aliases,
        "effects": effects,
        "imports": read.imports,
        "outside": "OUTSIDE" in bound,
    }
