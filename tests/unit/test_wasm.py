"""WebAssembly: sections of a module, and a small kernel that is built and read back.

That the page's kernels have the bits of the run is tested in a browser (tests/browser/test_lab.py).
"""

import json
import subprocess
import sys

import pytest

from kacsim import cli, kac
from kacsim.files import StoreError
from kacsim.jobs import stages
from kacsim.kac import samplers
from kacsim.kernels import names, sources
from kacsim.kernels.provenance import ROOT
from kacsim.wasm import building, sections, stored

SMALL = """
import sys
import numba
import numpy as np
from numba import carray, types
from kacsim.kernels.jit import ERROR_MODEL
from kacsim.kernels.wide import product
from kacsim.wasm import module

@numba.njit(error_model=ERROR_MODEL)
def total(values, n):
    x, found = carray(values, (n,)), 0.0
    for k in range(n):
        found += x[k]
    return found

@numba.njit(error_model=ERROR_MODEL)
def high(a, b):
    return product(a, b)[0]

@numba.njit(error_model=ERROR_MODEL)
def fails(n):
    if n == 7:
        raise ValueError("sevens")
    return np.empty(n)[:2].sum() * n

floats, words = types.CPointer(types.float64), types.uint64
content = module.built({"total": (total, (floats, types.int64)), "high": (high, (words, words)),
    "fails": (fails, (types.int64,))})
sys.stdout.buffer.write(content)
"""


@pytest.mark.parametrize("value", [0, 1, 127, 128, 300, 2**31 - 1])
def test_numbers(value):
    text = b"\xff" + sections.number(value) + b"\x7f"
    assert sections.read_number(text, 1) == (value, len(text) - 1)


def section(kind, body):
    return bytes([kind]) + sections.number(len(body)) + body


HEAD = b"\0asm\1\0\0\0"
IMPORTS = (
    b"\5"  # a memory, a function, a global, a function, a table
    b"\3env\1m\2\1\1\2" b"\3env\1f\0\0" b"\3env\1g\3\x7f\1" b"\3env\1h\0\1" b"\3env\1t\1\x70\0\0"
)  # fmt: skip


def test_exports_stand_after_imported_functions_and_before_code():
    content = HEAD + section(1, b"\0") + section(2, IMPORTS) + section(0, b"\4nameX")
    content += section(3, b"\2\0\0") + section(12, b"\0") + section(10, b"\2\2\0\x0b\2\0\x0b")
    found = list(sections.sections(sections.exporting(content, {"a": 0, "bb": 1})))
    assert [kind for kind, _ in found] == [1, 2, 3, 7, 12, 10]
    assert dict(found)[7] == b"\2\1a\0\2\2bb\0\3"  # two are imported


def build():
    command = [sys.executable, "-c", SMALL]
    own = {"PYTHONPATH": str(ROOT), "PATH": "", **building.SETTINGS}
    return subprocess.run(command, env=own, capture_output=True, check=True).stdout


def test_a_module_has_the_same_bytes_each_time_and_needs_memory_alone():
    content = build()
    assert content == build()
    found = dict(sections.sections(content))
    assert content.startswith(HEAD)
    assert found[7].count(b"total") == found[7].count(b"high") == 1
    assert set(sections._imported(content)) <= {2, 3}  # memory and the pointer of its stack
    assert b"__multi3" not in found[2]
    # Nothing of this machine, as in what errors say of the place where they were raised.
    assert not any(word in content for word in (b"sevens", b"Error", b".py", b"/"))


def test_stored_draws_are_those_of_the_public_functions(tmp_path):
    content = stored.content()
    assert json.loads(json.dumps(content)) == content
    check = next(one for one in content["checks"] if one["given"].get("algorithm") == "bird")
    values = kac.draw(**check["given"], n_draws=stored.N_DRAWS, seed=int(check["seed"]))
    assert stored._drawn(values, 3)["values"] == check["values"]
    kernels = {one["given"].get("algorithm", one["problem"]) for one in content["checks"]}
    assert kernels == {*kac.ALGORITHMS, "bkw", "perfect"}
    for name, words in content["streams"].items():
        assert len(words) == 8, name


def test_an_output_that_cannot_be_written_is_said_before_any_work(tmp_path, capsys):
    words = ["wasm", "--module", str(tmp_path / "none/a.wasm"), "--draws", str(tmp_path / "b.json")]
    (tmp_path / "none").write_text("a file")
    assert cli.main(words) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "a.wasm" in line
    assert not (tmp_path / "b.json").exists()


def test_a_module_is_built_once_and_damage_is_noticed(tmp_path, monkeypatch):
    made = []
    monkeypatch.setattr(building, "built", lambda path: made.append(path) or b"\0asm" + bytes(99))
    monkeypatch.setattr("kacsim.kernels.folder.root", lambda: tmp_path)
    for _ in range(2):
        building.write(tmp_path / "a.wasm")
        assert (tmp_path / "a.wasm").read_bytes() == b"\0asm" + bytes(99)
    assert len(made) == 1
    (kept,) = tmp_path.glob("page-*.json")
    whole = kept.read_text(encoding="utf-8")
    for damaged in (whole.replace("AAAA", "AAAB", 1), whole[:40], "[]", "{}", ""):
        kept.write_text(damaged, encoding="utf-8")
        assert building.read(kept) is None
        building.write(tmp_path / "a.wasm")
        assert building.read(kept) == b"\0asm" + bytes(99)
    assert len(made) == 6
    kept.unlink()
    kept.mkdir()  # cannot be written: built each time, and nothing else
    building.write(tmp_path / "a.wasm")
    assert len(made) == 7


def test_a_build_that_fails_says_why(tmp_path, monkeypatch):
    monkeypatch.setattr(building, "SETTINGS", {"NUMBA_OPT": "x", "NUMBA_DISABLE_JIT": "1"})
    with pytest.raises(StoreError, match=r"a\.wasm: cannot be built"):
        building.built(tmp_path / "a.wasm")


FAMILY = ("entries", "module", "sections", "stored")


def test_the_rule_depends_on_all_that_it_runs():
    """Every definition of the family, and the kernels that are looked up by name."""
    roots = stages.wasm_roots()
    assert missed(roots) == set()
    for root in roots:  # a control: each root that is no algorithm's brings something of its own
        if root[0].startswith("kacsim.wasm"):
            assert missed([one for one in roots if one != root]), root


def missed(roots):
    """Return the definitions that a build runs and that these roots do not reach."""
    modules = [f"kacsim.wasm.{name}" for name in FAMILY]
    wanted = {(module, one) for module in modules for one in names.table(module)["definitions"]}
    wanted.add(("kacsim.wasm.building", "SETTINGS"))
    own = {(f"kacsim.kac.{name}", part) for name in samplers.ON_PAGE for part in stages.LOOKED_UP}
    assert {part for _, part in own} == {"ancestral", "arguments"}
    wanted |= {one for one in own if one[1] in names.table(one[0])["definitions"]}
    return wanted - sources.closure(frozenset(roots))[0]
