"""Names in a syntax tree: what is bound in a module, what runs at its import, what is changed.

A constant that something else fills or replaces is not what its own statement says. What a module
does to its own constants while it is imported counts with all that it defines; what a function
does, or another module, is refused where a result depends on it (`kacsim.kernels.sources`).
"""

import ast

OUTSIDE = "what it computes are names for results, not results"

DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
SCOPES = (*DEFINITIONS, ast.Lambda)
COMPREHENSIONS = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
SET, CALLED = "set", "called"
# Methods of containers that change them.
CHANGING = {
    "__delitem__",
    "__setattr__",
    "__setitem__",
    "add",
    "append",
    "appendleft",
    "clear",
    "discard",
    "extend",
    "extendleft",
    "fill",
    "insert",
    "pop",
    "popitem",
    "popleft",
    "put",
    "remove",
    "resize",
    "reverse",
    "setdefault",
    "sort",
    "update",
}
SETTERS = ("setattr", "delattr")


def place(node):
    """Return the dotted name that an expression starts from.

    Returns
    -------
    (tuple of str, or None; bool, whether the name is the whole expression)
    """
    names, whole = [], True
    while not isinstance(node, ast.Name):
        if isinstance(node, ast.Attribute):
            names.append(node.attr)
            node = node.value
        elif isinstance(node, (ast.Subscript, ast.Call)):
            names, whole = [], False
            node = node.value if isinstance(node, ast.Subscript) else node.func
        else:
            return None, False
    return (node.id, *reversed(names)), whole


def chain(node):
    """Return the names of ``a.b.c`` as a tuple, None for an expression that is none."""
    found, whole = place(node)
    return found if whole else None


def now(node, to_bind=False):
    """Yield the nodes of a statement that run while the module is imported.

    Parameters
    ----------
    to_bind : only those in the scope of the module itself, where names are bound
    """
    yield node
    if isinstance(node, SCOPES):
        parts = [*getattr(node, "decorator_list", ()), getattr(node, "args", None)]
        if isinstance(node, ast.ClassDef) and not to_bind:
            parts += [*node.bases, *node.keywords, *node.body]
        parts = [part for part in parts if part is not None]
    else:
        parts = ast.iter_child_nodes(node)
    for part in parts:
        if to_bind and isinstance(part, COMPREHENSIONS):
            yield from (one for one in ast.walk(part) if isinstance(one, ast.NamedExpr))
        else:
            yield from now(part, to_bind)


def targets(statement):
    """Return the names that a statement binds in the scope of its module, imports apart."""
    found = []
    for node in now(statement, to_bind=True):
        if isinstance(node, (*DEFINITIONS, ast.ExceptHandler, ast.MatchAs, ast.MatchStar)):
            found.append(node.name)
        elif isinstance(node, ast.NamedExpr):
            found.append(node.target.id)
        elif isinstance(node, ast.MatchMapping):
            found.append(node.rest)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            found.append(node.id)
    return list(dict.fromkeys(filter(None, found)))


def changes(nodes):
    """Return what some trees change that their own functions have not made.

    Returns
    -------
    set of (kind, later, path): SET a name, or CALLED what may change the value of one; `later`,
    when a function runs, or at once; path, the dotted name
    """
    found = set()
    for node in nodes:
        _walk(node, frozenset(), frozenset(), False, found)
    return found


def _walk(node, hidden, hidden_here, later, found):
    """Add the changes in a tree.

    Parameters
    ----------
    hidden : names of the functions around it; what they hold is their own
    hidden_here : names of the class around it, which its functions do not see
    """
    for kind, path in _changed(node, later):
        if isinstance(node, ast.Global) or path[0] not in hidden | hidden_here:
            found.add((kind, later, path))
    if not isinstance(node, SCOPES):
        for child in ast.iter_child_nodes(node):
            _walk(child, hidden, hidden_here, later, found)
        return
    is_class = isinstance(node, ast.ClassDef)
    own = _bound_in(node)
    for part in ast.iter_child_nodes(node):
        if part in getattr(node, "decorator_list", ()) or isinstance(part, ast.arguments):
            _walk(part, hidden, hidden_here, later, found)
        elif is_class:
            _walk(part, hidden, own, later, found)
        else:
            _walk(part, hidden | own, frozenset(), True, found)


def _changed(node, later):
    """Yield (kind, path) of what one node changes, whoever's it is."""
    if isinstance(node, ast.Global):
        yield from ((SET, (name,)) for name in node.names)
    elif isinstance(node, (ast.Attribute, ast.Subscript)) and not isinstance(node.ctx, ast.Load):
        path, whole = place(node)
        if path:
            yield (SET, path) if whole else (CALLED, path)
    elif isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name):
        yield CALLED, (node.target.id,)  # a list that has a second name changes under both
    elif isinstance(node, ast.Call):
        yield from _call(node)
    elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Call) and not later:
        yield from _method(node.value.func)  # a call for its effect, whatever the method's name
    for decorator in getattr(node, "decorator_list", ()):
        yield from _method(decorator.func if isinstance(decorator, ast.Call) else decorator)


def _call(node):
    """Yield what a call changes by its name."""
    if isinstance(node.func, ast.Name) and node.func.id in SETTERS and node.args:
        path, _ = place(node.args[0])
        if path:
            yield SET, path
    elif isinstance(node.func, ast.Attribute) and node.func.attr in CHANGING:
        yield from _method(node.func)


def _method(function):
    """Yield the object of a method."""
    path, _ = place(function.value) if isinstance(function, ast.Attribute) else (None, False)
    if path:
        yield CALLED, path


def _bound_in(node):
    """Return the names that a function or class binds for itself."""
    arguments = getattr(node, "args", None)
    parts = ast.walk(arguments) if arguments else ()
    found, elsewhere = {one.arg for one in parts if isinstance(one, ast.arg)}, set()
    waiting = list(node.body) if isinstance(node.body, list) else [node.body]
    while waiting:
        one = waiting.pop()
        if isinstance(one, ast.Global):
            elsewhere |= set(one.names)
        elif isinstance(one, ast.Name) and not isinstance(one.ctx, ast.Load):
            found.add(one.id)
        elif isinstance(one, SCOPES):
            found |= {one.name} if hasattr(one, "name") else set()
            continue
        waiting += ast.iter_child_nodes(one)
    return found - elsewhere
