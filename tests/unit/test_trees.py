"""Tables of one module: what statements bind, do and change, and what digests leave out."""

import ast
import textwrap

import pytest

from kacsim.kernels import trees
from kacsim.kernels.scopes import CALLED, SET, changes, place, targets

BOUND = {
    "a = b.c = d[0] = 1": ["a"],
    "(a, [b, *c]) = d": ["a", "b", "c"],
    "a: int = 1": ["a"],
    "a += b": ["a"],
    "def a(b=(c := 1)): d = 2": ["a", "c"],
    "class a(b): c = 1": ["a"],
    "for a, b in c:\n    d = 1\nelse:\n    e = 2": ["a", "b", "d", "e"],
    "while (a := b()): c = 1": ["a", "c"],
    "with a as b, c() as (d, e): f = 1": ["b", "d", "e", "f"],
    "try: a = 1\nexcept B as c: d = 2\nfinally: e = 3": ["a", "c", "d", "e"],
    "if a:\n    def b(): c = 1\nelse:\n    class b: pass": ["b"],
    "match a:\n    case {'x': b}: pass\n    case [c, *d] | e(c, d=d): pass": ["b", "c", "d"],
    "match a:\n    case {'x': 1, **b}: pass\n    case c: pass": ["b", "c"],
    "a = [b for b in c if (d := b)]": ["a", "d"],
    "a = lambda b: (c := b)": ["a"],
    "del a[0]": [],
    "print(a)": [],
}  # fmt: skip
# text: what is changed (kind, when a function runs, the name)
CHANGED = {
    "t['x'] = 1": {(CALLED, False, "t")},
    "t.a.b = 1": {(SET, False, "t.a.b")},
    "del t['x'].y": {(CALLED, False, "t")},
    "t += [1]": {(CALLED, False, "t")},
    "t.put(1)": {(CALLED, False, "t")},
    "t.a['x'].any_method(1)": {(CALLED, False, "t.a")},
    "x = t.any_method(1)": set(),
    "x = t.pop(1)": {(CALLED, False, "t")},
    "for k in s: t[k] = 1": {(CALLED, False, "t")},
    "def f(): t['x'] = 1": {(CALLED, True, "t")},
    "def f(): t.append(1)": {(CALLED, True, "t")},
    "def f(): t.any_method(1)": set(),
    "def f(): t.get(1).append(2)": {(CALLED, True, "t.get")},
    "def f(): setattr(t, 'x', 1)": {(SET, True, "t")},
    "def f():\n    global t\n    t = 1": {(SET, True, "t")},
    "f = lambda: t.clear()": {(CALLED, True, "t")},
    "class A:\n    t = {}\n    t['x'] = 1": set(),
    "class A:\n    t = {}\n    def f(self): t['x'] = 1": {(CALLED, True, "t")},
    "@t.append\ndef f(): pass": {(CALLED, False, "t")},
    "@t.enter(1)\nclass A: pass": {(CALLED, False, "t")},
    "def f(t): t['x'] = 1": set(),
    "def f(*t, **s): t.x, s['x'] = 1": set(),
    "def f():\n    t = {}\n    def g(): t['x'] = 1": set(),
    "def f():\n    for t in s: t.append(1)\n    with u as v: v.add(1)": set(),
    "def f():\n    t = 1\n    def g():\n        global t\n        t = 1": {(SET, True, "t")},
    "def f(x=t.pop()): pass": {(CALLED, False, "t")},
}  # fmt: skip


def analysed(text, module="toy.a", package="toy"):
    return trees.analysed(textwrap.dedent(text), module, package)


@pytest.mark.parametrize("text", BOUND)
def test_names_that_a_statement_binds(text):
    assert targets(ast.parse(text).body[0]) == BOUND[text]


@pytest.mark.parametrize("text", CHANGED)
def test_what_a_statement_changes(text):
    found = {(kind, later, ".".join(path)) for kind, later, path in changes(ast.parse(text).body)}
    assert found == CHANGED[text]


@pytest.mark.parametrize(
    ("text", "path", "whole"),
    [
        ("a", "a", True),
        ("a.b.c", "a.b.c", True),
        ("a.b[0].c", "a.b", False),
        ("a.b(1).c", "a.b", False),
        ("(a or b).c", None, False),
        ("'a'.join(b)", None, False),
    ],
)
def test_the_name_that_an_expression_starts_from(text, path, whole):
    found = place(ast.parse(text, mode="eval").body)
    assert found == (path and tuple(path.split(".")), whole)


def test_statements_that_do_more_than_bind_count_with_all():
    table = analysed("""
        import math
        from toy.b import K
        LIMIT = -2.0
        LIST = []
        BOTH = 1, LIST
        ROOT = math.sqrt(LIMIT)
        def fill(x): return x
        A = fill(LIMIT)
        B = tuple(LIST)
        C = fill(lambda: 1)
        D = ", ".join(LIST)
        @fill
        def g(): pass
        E = fill(LIST)
        G = fill(BOTH)
        print("said")
        H: int = 1
        H += 1
        @fill(LIST)
        def h(): pass
    """)
    assert table["effects"] == [f"effect {k}" for k in range(1, 6)]
    assert [name for name in table["definitions"] if " " not in name] == [
        "LIMIT", "LIST", "BOTH", "ROOT", "fill", "A", "B", "C", "D", "g", "E", "G", "H", "h",
    ]  # fmt: skip


def test_imports_are_followed_by_their_names():
    text = "import numpy as np, os.path\nfrom .c import d as e\nfrom .. import f\nimport toy.b.g"
    found = analysed(text, "toy.b.a", "toy.b")["aliases"]
    assert found == {
        "np": ["numpy"],
        "os": ["os"],
        "e": ["toy.b.c.d"],
        "f": ["toy.f"],
        "toy": ["toy"],
    }
    text = "try: from b import x\nexcept E:\n    from c import x\ndef f():\n    from d import x, y"
    table = analysed(text)
    assert table["aliases"] == {"x": ["b.x", "c.x"]}
    assert table["definitions"]["f"]["aliases"] == {"x": ["d.x"], "y": ["d.y"]}
    assert table["imports"] == ["b.x", "c.x", "d.x", "d.y"]


def test_a_name_that_is_bound_twice_counts_twice():
    one, two = (analysed(text)["definitions"]["a"] for text in ("a = b", "a = b\na = c(a)"))
    assert one["digest"] != two["digest"]
    assert two["uses"] == [["a"], ["b"], ["c"]]


def test_kinds_of_definitions():
    text = "def f(): pass\nclass A: pass\nx = 1\nif x:\n    def g(): pass\ndef x(): pass"
    found = {name: entry["kind"] for name, entry in analysed(text)["definitions"].items()}
    assert found == {
        "f": "function", "A": "class", "x": "constant", "g": "constant", "effect 1": "constant",
    }  # fmt: skip
    assert analysed("OUTSIDE = 'it tells'")["outside"]
    assert not analysed("INSIDE = 'it tells'")["outside"]


@pytest.mark.parametrize(
    ("first", "second", "same"),
    [
        ("def f(x: int = 1) -> int: return x", "def f(x=1): return x", True),
        ('def f():\n    """A."""', 'def f():\n    """B."""', True),
        ('class f:\n    """A."""\n    x = 1', "class f:\n    x = 1", True),
        ("def f(): raise E('a') from g", "def f(): raise E('b')", True),
        ("def f(): raise E('a')", "def f(): raise F('a')", False),
        ("class f:\n    x: int", "class f:\n    x: float", False),
        ("def f(): return 'a'", "def f(): return 'b'", False),
        ("f = 1", "f = 1.0", False),
        ("f = 1", "f = True", False),
        ("f = 0.0", "f = -0.0", False),
        ("f = (1, 2)", "f = [1, 2]", False),
        ("def f(a, b): pass", "def f(b, a): pass", False),
        ("async def f(): pass", "def f(): pass", False),
    ],
)
def test_digests(first, second, same):
    one, two = (analysed(text)["definitions"]["f"]["digest"] for text in (first, second))
    assert (one == two) == same
