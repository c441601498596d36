"""The table of slips fits the sources, and a slip that no test sees is told. No statistics."""

import ast
import shutil

import mutants as driver
import pytest


def test_every_slip_applies_and_is_python():
    mutants = driver.load()
    assert len(mutants) >= 40
    for mutant in mutants:
        assert mutant.stale(driver.ROOT) == "", mutant.name
        source = mutant.path(driver.ROOT).read_text(encoding="utf-8")
        assert mutant.old != mutant.new
        ast.parse(source.replace(mutant.old, mutant.new))


def test_tests_to_run_first_exist():
    for mutant in driver.load():
        files = [word for word in " ".join(mutant.tests).split() if word.startswith("tests/")]
        assert files, mutant.name
        assert all((driver.ROOT / file.split("::")[0]).exists() for file in files), mutant.name


def test_a_source_that_has_changed_is_told(tmp_path):
    mutant = driver.load()[0]
    path = mutant.path(tmp_path)
    path.parent.mkdir(parents=True)
    shutil.copy(mutant.path(driver.ROOT), path)
    mutant.apply(tmp_path)
    assert mutant.stale(tmp_path) == f"old text found 0 times in kacsim/{mutant.file}"
    mutant.undo(tmp_path)
    assert mutant.stale(tmp_path) == ""


def verdict(capsys, monkeypatch, *answers):
    """Judge the first mutant on a copy whose runs of tests end as given."""
    runs = iter(answers)
    monkeypatch.setattr(driver.Copy, "failing", lambda *words, first=True: next(runs))
    monkeypatch.setattr(driver.sys, "argv", ["mutants.py", "--only", driver.load()[0].name])
    return driver.main(), capsys.readouterr().out


PASSED, FAILED = (0, [], ""), (1, ["tests/a.py::test_b"], "")


def test_a_slip_that_all_tests_pass_survives(capsys, monkeypatch):
    status, told = verdict(capsys, monkeypatch, PASSED, PASSED)
    assert (status, "SURVIVED" in told, "0 caught, 1 survived" in told) == (1, True, True)


def test_a_slip_is_caught_by_a_test_that_passes_without_it(capsys, monkeypatch):
    status, told = verdict(capsys, monkeypatch, PASSED, FAILED, PASSED)
    assert (status, "tests/a.py::test_b" in told, "1 caught" in told) == (0, True, True)


@pytest.mark.parametrize("answers", [(FAILED, FAILED), ((2, [], "no module"),)])
def test_a_test_that_fails_anyway_catches_nothing(answers, capsys, monkeypatch):
    status, told = verdict(capsys, monkeypatch, *answers)
    assert (status, "0 caught" in told, "1 broken" in told) == (1, True, True)
