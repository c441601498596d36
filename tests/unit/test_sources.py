"""Derived dependencies of small packages: what changes a hash, what does not, what is refused.

The packages and the edits are in toy_packages.yaml; the hash is that of what ``a.f`` depends on.
"""

import os
from pathlib import Path

import pytest
from toy import make_toy

from kacsim import files
from kacsim.kernels import sources, tables
from kacsim.kernels.names import UnknownError
from kacsim.kernels.sources import UnfollowedError

REAL, INSTALLED = tables._known, sources._distributions
CASES = files.read_yaml(Path(__file__).with_name("toy_packages.yaml"))


@pytest.fixture
def toy(tmp_path, monkeypatch):
    """Return a function that makes a package of files: name -> text."""
    yield from make_toy(tmp_path, monkeypatch)


def cases(kind):
    """Return the parametrization of a test by some packages."""
    return pytest.mark.parametrize("case", CASES[kind].values(), ids=CASES[kind])


@cases("ignored")
def test_an_edit_that_changes_no_result_is_ignored(toy, case):
    package = toy(case["files"])
    before = package.code("a.f")
    for edit in case["edits"]:
        package.edit(*edit)
        assert package.code("a.f") == before, edit


@cases("counted")
def test_an_edit_of_what_is_used_counts(toy, case):
    package = toy(case["files"])
    before = package.code("a.f")
    for file, old, new in case["edits"]:
        package.edit(file, old, new)
        assert package.code("a.f") != before, (file, old, new)
        package.edit(file, new, old)
        assert package.code("a.f") == before


@cases("refused")
def test_what_cannot_be_followed_is_refused(toy, case):
    with pytest.raises(UnfollowedError) as error:
        toy(case["files"]).code("a.f")
    assert case["reason"] in str(error.value)


def test_an_unknown_name_is_refused(toy):
    package = toy({"a.py": "from toy import nowhere\ndef f(): return nowhere.g\nx = 1"})
    for root in ("a.f", "a.g", "c.x"):
        with pytest.raises(UnknownError):
            package.code(root)
    assert package.code("a.x")


def test_a_library_counts_by_the_version_of_its_distribution():
    assert sources._distributions("math") == ()
    assert sources._distributions("numba") == ("numba", "llvmlite")
    assert sources._distributions("yaml") == ("PyYAML",)
    assert sources._distributions("mpl_toolkits") == ("matplotlib",)
    assert sources._distributions("not_there") == ("not_there",)


def test_a_library_that_has_no_version_is_refused(toy, tmp_path):
    package = toy({"a.py": "import helper\ndef f(): return helper.x"})
    assert package.code("a.f")
    (tmp_path / "helper.py").write_text("x = 1", encoding="utf-8")
    INSTALLED.cache_clear()
    package.forget()
    with pytest.raises(UnknownError, match="helper"):
        package.code("a.f")


def test_another_version_is_another_hash(toy, monkeypatch):
    package = toy({"a.py": "import numpy\ndef f(): return numpy.pi\ndef g(): return 1"})
    before = package.code("a.f"), package.code("a.g")
    monkeypatch.setattr(sources, "versions", lambda found: ", ".join([*found, "newer"][::-1]))
    package.forget()
    assert package.code("a.f") != before[0]
    monkeypatch.setattr(sources, "versions", lambda found: "newer" if "numpy" in found else "")
    package.forget()
    alone = package.code("a.g")
    monkeypatch.setattr(sources, "versions", lambda found: "newest" if "numpy" in found else "")
    package.forget()
    assert package.code("a.g") == alone


def test_an_edit_that_leaves_size_and_time_is_seen(toy):
    """Tables are found by a file's bytes, so that a copy or a quick edit cannot deceive."""
    package = toy({"a.py": "def f(): return 1"})
    before, path = package.code("a.f"), package.folder / "a.py"
    stamp = os.stat(path)
    package.write("a.py", "def f(): return 2")
    os.utime(path, ns=(stamp.st_atime_ns, stamp.st_mtime_ns))
    assert os.stat(path).st_size == stamp.st_size
    assert package.code("a.f") != before


def test_tables_are_kept_and_damaged_ones_made_again(toy, tmp_path, monkeypatch):
    package = toy({"a.py": "def f(): return g()\ndef g(): return 1"})
    kept = tmp_path / "tables.json"
    before = package.code("a.f")
    text = kept.read_text(encoding="utf-8")
    monkeypatch.setattr(tables, "_known", REAL)
    for content in (text, text.replace('"g"', '"h"'), text[:-9], "", "[]"):
        kept.write_text(content, encoding="utf-8")
        REAL.cache_clear()
        package.forget()
        assert package.code("a.f") == before
        assert bool(REAL()) is True
    REAL.cache_clear()
