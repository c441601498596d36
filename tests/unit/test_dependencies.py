"""The proof that derived dependencies are complete: runs under trace, and a second derivation.

What a job enters, reads and opens must lie in what its roots reach, apart from code that decides
nothing, which is listed here. The items follow in tests/workflow/test_item_dependencies.py.
"""

import importlib

import bytecode
import numpy as np
import pytest
import traced
import tracer
from toy import make_toy

from kacsim.cases import tiny_cases
from kacsim.jobs import stages
from kacsim.kernels import cache, names, sources

CASES = list(tiny_cases())
# What calls the roots, and what a case's id is made by, which its streams have.
RUN = {
    ("kacsim.jobs.sampling", "run"),
    ("kacsim.kac.own_tables", "token"),
    ("kacsim.kernels.lookup", "named"),
}
# What samplers ask of code that lies outside: what a recipe says, which kernel of the roots it is,
# and looking up by name.
ASKED = {
    "kacsim.cases.Case.id",
    "kacsim.cases.Case.kernel_module",
    "kacsim.cases.Case.replicates",
    "kacsim.cases.Case.roots",
    "kacsim.cases.Case.sampler",
    "kacsim.checks.raise_problems",
    "kacsim.kac.samplers.entry",
    "kacsim.kac.samplers.is_own",
    "kacsim.kernels.lookup.named",
}
# The same of joining shards: where they lie, and whether they are the wanted ones.
JOINED = ASKED | {
    "kacsim.cases.Case.output",
    "kacsim.cases.Case.settings",
    "kacsim.cases.Case.split",
    "kacsim.kernels.sources.code",
}
# Around the roots of a command: words become a case, and variables a file that is checked by the
# sum of all that it holds.
AROUND = {
    "kacsim": {"__version__"},
    "kacsim.cli": None,
    "kacsim.commands": None,
    "kacsim.commands._shared": None,
    "kacsim.commands.sample": None,
    "kacsim.jobs.sampling": {"load", "run", "tiny"},
    "kacsim.jobs.times": {"drawn_sentence"},
    "kacsim.kernels.provenance": None,
    "kacsim.store": {"_checksum", "_write_netcdf", "write", "write_sample"},
}


def number_of(name):
    """Return the place of a sampler among the tiny cases."""
    return next(k for k, case in enumerate(CASES) if case.name == name)


def unexplained(needed, roots):
    """Return what was needed and does not follow from the roots."""
    return needed["required"] - sources.closure(frozenset(roots))[0] - RUN


def test_what_samplers_need_follows_from_their_roots():
    found = traced.run([["sample", k] for k in range(len(CASES))])
    for case, phases in zip(CASES, found, strict=True):
        needed = phases["sample"]
        assert unexplained(needed, stages.sample_roots(case)) == set(), case.id
        assert needed["called"] <= ASKED, case.id
        assert needed["opened"] == set(), case.id


def test_what_joining_shards_needs_follows_from_its_roots():
    joined = [number_of(name) for name in ("kac_equilibrium", "bkw", "injection", "identity")]
    for k, phases in zip(joined, traced.run([["merge", k] for k in joined]), strict=True):
        needed, case = phases["merge"], CASES[k]
        assert unexplained(needed, stages.merge_roots(case)) == set(), case.id
        assert needed["called"] <= JOINED
        assert needed["opened"] == set()
    # The control: what is looked up by a name that is put together must be a root.
    less = [*case.roots, ("kacsim.jobs.shards", "merged")]
    assert unexplained(needed, less) == {("kacsim.techniques.sampling", "KEPT")}


def test_around_the_roots_a_command_has_only_what_decides_nothing(tmp_path):
    case = CASES[number_of("kac")]
    words = ["sample", *case.arguments().split(), "--output", str(tmp_path / "sample.nc")]
    needed = traced.run([["command", *words]])[0]["command"]
    for module, name in unexplained(needed, stages.sample_roots(case)):
        if not names.table(module)["outside"]:
            assert name in (AROUND[module] or {name}), f"{module}.{name}"
    assert needed["opened"] == set()


def test_the_trace_sees_what_a_hole_would_hide(monkeypatch):
    """Negative controls: whatever is taken out of the derived set is what the trace reports."""
    kac, literal = number_of("kac"), number_of("trap")
    first, second = (one["sample"] for one in traced.run([["sample", kac], ["sample", literal]]))
    assert first["required"] >= {
        ("kacsim.kac.nanbu_sequential", "ancestral"),  # looked up by name
        ("kacsim.kac.replicates", "value_sums"),  # called
        ("kacsim.kac.tape", "ancestral_draws"),  # runs at the import
        ("kacsim.statistics.histogram", "FINE_WIDTH"),  # a constant of another module
        ("kacsim.variate_tables", "strips"),  # called to make a constant
        ("kacsim.kernels.jit", "ERROR_MODEL"),  # read to make a function
    }
    roots, other = (frozenset(stages.sample_roots(CASES[k])) for k in (kac, literal))
    reached = sources.closure(roots)
    for one in first["required"] - RUN:
        monkeypatch.setattr(sources, "closure", lambda _, one=one: (reached[0] - {one}, reached[1]))
        assert unexplained(first, roots) == {one}
    monkeypatch.undo()
    engine = ("kacsim.kac.nanbu_sequential", "ancestral")
    assert engine in unexplained(first, roots - {engine})
    missing = unexplained(second, roots)
    assert other - {("kacsim.boltzmann.sampling", "sample")} <= missing
    assert ("kacsim.boltzmann.trap_tree", "tree") in missing


def test_names_in_bytecode_follow_from_every_definition():
    """The second derivation, of code that runs and of code that does not."""
    checked = 0
    for module in names.modules():
        if names.table(module)["outside"] or module.endswith("__main__"):
            continue
        space = vars(importlib.import_module(module))
        own = {name for one in tracer.statements(module) for name in one.names - set(one.imports)}
        for name in sorted(own):
            if name not in names.table(module)["definitions"]:
                assert type(space[name]).__name__ in ("_Lazy", "module"), f"{module}.{name}"
                continue
            try:
                reached, _ = sources.closure(frozenset([(module, name)]))
            except sources.UnfollowedError:
                continue  # no result depends on it: tests of all roots would be refused
            loaded = {one for one in bytecode.loads(module, name) if one[1] != "__doc__"}
            assert loaded <= reached, f"{module}.{name}"
            checked += len(loaded)
    assert checked > 1000


def test_the_second_derivation_sees_what_a_hole_would_hide():
    roots = {("kacsim.items.kac_fig3", "reduce"), ("kacsim.items.kac_fig3", "draw")}
    importlib.import_module("kacsim.items.kac_fig3")
    found = set().union(*(bytecode.loads(*root) for root in roots))
    assert found >= {
        ("kacsim.items._kac", "tvn_table"),  # of a module
        ("kacsim.drawing.plotting", "panels"),  # of a lazy module
        ("kacsim.kac.samplers", "TITLES"),  # imported
    }
    assert bytecode.loads("kacsim.jobs.shards", "merged") >= {
        ("kacsim.boltzmann.sampling", "TOP"),  # imported in the function
        ("kacsim.store", "read_variables"),  # of a module that is imported there
    }


KERNELS = {
    "laws/slow.py": """
        LIMIT = 1.0
        def collide(x): return min(x, LIMIT)
        def other(x): return x
    """,
    "laws/fast.py": """
        def collide(x): return 2.0 * x
    """,
    "walks/tree.py": """
        from toy.walks import parts
        DEPTH = 4
        def build(collide, depth=DEPTH, names=()):
            def estimate(x):
                for _ in range(depth):
                    x = collide(x) + parts.step(x)
                return x, names
            return estimate
        def unused(x): return x
    """,
    "walks/parts.py": """
        def step(x): return x
        def leap(x): return x
    """,
}


@pytest.fixture
def toy(tmp_path, monkeypatch):
    """Return a function that makes a package of files: name -> text."""
    yield from make_toy(tmp_path, monkeypatch)


@pytest.mark.parametrize(
    ("file", "old", "new", "slow", "fast"),
    [
        ("laws/slow.py", "min(x, LIMIT)", "max(x, LIMIT)", True, False),
        ("laws/slow.py", "LIMIT = 1.0", "LIMIT = 2.0", True, False),
        ("laws/fast.py", "2.0 * x", "3.0 * x", False, True),
        ("walks/tree.py", "range(depth)", "range(depth + 1)", True, True),
        ("walks/tree.py", "DEPTH = 4", "DEPTH = 5", True, True),
        ("walks/parts.py", "def step(x): return x", "def step(x): return -x", True, True),
        ("laws/slow.py", "def other(x): return x", "def other(x): return -x", False, False),
        ("walks/parts.py", "def leap(x): return x", "def leap(x): return -x", False, False),
        ("walks/tree.py", "def unused(x): return x", "def unused(x): return -x", False, False),
        ("walks/tree.py", "def estimate(x):", "def estimate(x):  # moved\n", False, False),
    ],
)
def test_a_kernel_of_several_folders_has_a_folder_of_its_parts(toy, file, old, new, slow, fast):
    """The callee is chosen by a parameter, and only the chosen one is compiled."""
    package = toy(KERNELS)

    def keys():
        build = package.load("walks.tree").build
        laws = (importlib.import_module(f"toy.laws.{name}").collide for name in ("slow", "fast"))
        return [cache.key(build(law)) for law in laws]

    before = keys()
    assert before[0] != before[1]
    package.edit(file, old, new)
    assert [one != other for one, other in zip(before, keys(), strict=True)] == [slow, fast]


def test_a_kernel_has_a_folder_for_each_choice(toy):
    package = toy(KERNELS)
    build = package.load("walks.tree").build
    law = importlib.import_module("toy.laws.fast").collide
    assert len({cache.key(build(law, depth)) for depth in (1, 2, 3)}) == 3
    assert cache.key(build(law, 4)) == cache.key(build(law))
    assert cache.key(build(law, 4, ("a",))) != cache.key(build(law))


def test_kernels_that_reach_the_same_have_folders_by_what_they_enclose(toy):
    """Each law reaches the other, and which one is enclosed is all that differs."""
    edited = {"laws/slow.py": "def collide(x): return other(x)\ndef other(x): return collide(-x)"}
    package = toy(KERNELS | edited)
    build = package.load("walks.tree").build
    slow = importlib.import_module("toy.laws.slow")
    keys = [cache.key(build(law)) for law in (slow.collide, slow.other)]
    closures = [
        sources.closure(cache.roots_of(build(law))[0]) for law in (slow.collide, slow.other)
    ]
    assert closures[0] == closures[1]
    assert keys[0] != keys[1]


def test_bytecode_tells_functions_of_one_name_apart():
    """Of what encloses one, too; a docstring is none of it."""

    def around(law):
        return lambda x: law(x)

    def documented(x):
        """Say something."""
        return 2 * x

    twice = cache.written(around(lambda x: 2 * x))
    assert twice == cache.written(around(lambda x: 2 * x)) == cache.written(around(documented))
    others = lambda x: 3 * x, lambda x: 2 + x, lambda x: 2 * x.real
    assert len({twice, *(cache.written(around(law)) for law in others)}) == 4


def test_a_kernel_whose_enclosed_values_have_no_short_text_is_refused(toy):
    """Two long arrays look alike in a text, and two lists of functions never do."""
    package = toy(KERNELS)
    build = package.load("walks.tree").build
    for value in (np.arange(2000), (build,)):
        with pytest.raises(sources.UnfollowedError, match="names"):
            cache.key(build(build, 4, value))
