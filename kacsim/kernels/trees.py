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

OUTSIDE = "what it computes are names for results, not results"
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
DISPATCH = "named"  # kacsim.kernels.lookup.named(package, module, attribute)
MOST_KEPT = 1000  # tables of files, several versions of each
LAZY = "lazy"  # kacsim.kernels.lookup.lazy(module)


class _Bare(ast.NodeTransformer):
    """Take out what changes no result: docstrings, annotations, messages of errors."""

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
        return ast.copy_location(ast.Raise(exc=None, cause=None), node)


def _chain(node):
    """Return the names of ``a.b.c`` as a list, None for an expression that is none."""
    names = []
    while isinstance(node, ast.Attribute):
        names.append(node.attr)
        node = node.value
    return [node.id, *reversed(names)] if isinstance(node, ast.Name) else None


def _uses(node, found):
    """Add the dotted names that a tree reads to `found`, each as long as it is written."""
    chain = _chain(node)
    if chain is not None:
        found.add(tuple(chain))
        return
    for child in ast.iter_child_nodes(node):
        _uses(child, found)


def _aliases(node):
    """Return name -> dotted target of the imports anywhere in a tree."""
    found = {}
    for one in ast.walk(node):
        if isinstance(one, ast.Import):
            for name in one.names:
                top = name.name.split(".")[0]
                found[name.asname or top] = name.name if name.asname else top
        elif isinstance(one, ast.ImportFrom):
            for name in one.names:
                found[name.asname or name.name] = f"{one.module}.{name.name}"
    return found


def _words(call, function):
    """Return the literal words of a call of a function, None if it is another call."""
    chain = _chain(call.func) if isinstance(call, ast.Call) else None
    if not chain or chain[-1] != function:
        return None
    return [word.value if isinstance(word, ast.Constant) else None for word in call.args]


def _dispatches(node):
    """Yield (package, attribute) of every look-up by name that a tree makes."""
    for one in ast.walk(node):
        words = _words(one, DISPATCH)
        if words and len(words) == 3 and words[0] and words[2]:
            yield words[0], words[2]


def _targets(node):
    """Return the names that a statement binds."""
    if isinstance(node, (*FUNCTIONS, ast.ClassDef)):
        return [node.name]
    bound = getattr(node, "targets", None) or [getattr(node, "target", None)]
    names = [one for target in bound if target is not None for one in ast.walk(target)]
    return [one.id for one in names if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store)]


def _attached(node, module):
    """Return name -> target of the public names that ``lazy_loader.attach`` gives a package."""
    if _words(getattr(node, "value", None), "attach") is None:
        return {}
    found = {}
    for keyword in node.value.keywords:
        if keyword.arg == "submod_attrs":
            for home, names in ast.literal_eval(keyword.value).items():
                found |= {name: f"{module}.{home}.{name}" for name in names}
    return found


def _entry(nodes):
    """Return what is known of one definition; several statements may bind its name."""
    uses, aliases, dispatches = set(), {}, []
    digest = hashlib.sha256()
    for node in nodes:
        aliases |= _aliases(node)
        bare = _Bare().visit(node)
        _uses(bare, uses)
        dispatches += _dispatches(bare)
        digest.update(ast.dump(bare, annotate_fields=False).encode())
    return {
        "digest": digest.hexdigest()[:16],
        "uses": sorted(map(list, uses)),
        "aliases": aliases,
        "dispatches": dispatches,
        "constant": not isinstance(nodes[0], (*FUNCTIONS, ast.ClassDef)),
    }


def analysed(text, module):
    """Return the tables of a module's text.

    Returns
    -------
    dict of definitions (name -> digest, uses, aliases, dispatches, constant), aliases (name ->
    dotted target), effects (names of statements that bind nothing: they count with each
    definition), outside (bool, the module says that its code decides nothing)
    """
    bound, aliases, effects = {}, {}, []
    for place, node in enumerate(ast.parse(text).body):
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            aliases |= _aliases(node)
            continue
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            continue
        names = _targets(node)
        lazy = _words(getattr(node, "value", None), LAZY)
        if lazy:
            aliases[names[0]] = lazy[0]
            continue
        aliases |= _attached(node, module)
        if not names:
            names = [f"statement {place}"]
            effects += names
        for name in names:
            bound.setdefault(name, []).append(node)
    return {
        "definitions": {name: _entry(nodes) for name, nodes in bound.items()},
        "aliases": aliases,
        "effects": effects,
        "outside": "OUTSIDE" in bound,
    }


def tables(file, module):
    """Return the tables of a file, from the store of tables if its bytes are known there."""
    content = file.read_bytes()
    key = f"{module} {hashlib.sha256(content).hexdigest()}"
    known = _known()
    if key not in known:
        known[key] = analysed(content.decode(), module)
        _new.append(key)
    _seen.add(key)
    return known[key]


_new, _seen = [], set()


def _store():
    version = ".".join(map(str, sys.version_info[:3]))
    return folder.root() / f"trees-{version}-{_own_digest()}.json"


@functools.cache
def _own_digest():
    """Return a digest of this file: other rules make other tables."""
    with open(__file__, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()[:8]


@functools.cache
def _known():
    try:
        return json.loads(_store().read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def keep():
    """Keep the tables that were made by this process, if there is a place for them."""
    if _new:
        known = _known()
        kept = {key: known[key] for key in _seen} if len(known) > MOST_KEPT else known
        _new.clear()
        folder.write_quietly(_store(), json.dumps(kept))
