"""Batches: every case in one of them, of the same items and kernels, within the time."""

import shlex

import pytest

from kacsim import cli, plan, store
from kacsim.cases import make_case
from kacsim.jobs.batches import make_batches
from kacsim.kernels.provenance import ROOT

SECONDS = 30.0


@pytest.fixture(scope="module")
def full():
    return plan.Plan(plan.read_config(ROOT / "config" / "config.yaml"))


def bird(time, n_draws=1000):
    given = {"algorithm": "bird", "engine": "ancestral", "n_particles": 7, "time": time}
    return make_case("kac", **given, n_draws=n_draws, n_replicates=2, seed=1)


def test_every_case_is_in_one_batch(full):
    found = [case.id for batch in full.batches for case in batch.cases]
    assert sorted(found) == sorted(full.cases)
    assert len({batch.id for batch in full.batches}) == len(full.batches)


def test_a_batch_draws_for_the_same_items_with_the_same_kernels(full):
    for batch in full.batches:
        assert len({case.kernel_module for case in batch.cases}) == 1
        needed = {
            tuple(item for item, cases in full.cases_of.items() if case in cases)
            for case in batch.cases
        }
        assert len(needed) == 1


def test_a_batch_ends_before_its_time(full):
    long = [batch for batch in full.batches if batch.seconds() > SECONDS]
    assert all(len(batch.cases) == 1 for batch in long)
    assert len(full.batches) < len(full.cases) / 3


def test_no_time_gives_each_case_a_job():
    cases = [bird(1.0), bird(2.0)]
    assert [batch.cases for batch in make_batches({"a": cases}, 0)] == [(cases[0],), (cases[1],)]
    (both,) = make_batches({"a": cases}, SECONDS)
    assert both.cases == tuple(cases)
    assert both.id == "a-bird-1"


def test_longer_batches_start_first():
    small, large = (make_batches({"a": [bird(1.0, n)]}, 0)[0] for n in (1000, 100_000))
    assert large.priority() > small.priority()
    assert large.minutes() >= small.minutes() > 0


def test_the_command_of_a_batch_draws_all_its_cases(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    cases = [bird(0.4), bird(1.7)]
    (batch,) = make_batches({"a": cases}, SECONDS)
    assert cli.main(["sample", *shlex.split(batch.arguments())]) == 0
    for case in cases:
        assert store.read_sample(case.output(), case).sizes["replicate"] == 2
    assert capsys.readouterr().out.count("drew 2000 values") == 2


def test_a_wrong_case_stops_the_batch_before_any_is_drawn(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    words = shlex.split(make_batches({"a": [bird(1.0), bird(-2.0)]}, SECONDS)[0].arguments())
    assert cli.main(["sample", *words]) == 2
    assert "--time = -2.0" in capsys.readouterr().err
    assert not list(tmp_path.rglob("*.nc"))
