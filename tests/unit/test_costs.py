"""What cases should take: amounts in closed form, and coefficients that a fit finds again."""

import dataclasses
import json
import math

import numpy as np
import pytest

from kacsim import cli, costs, plan
from kacsim.benchmark import fitting
from kacsim.boltzmann import bkw
from kacsim.boltzmann import work as trees
from kacsim.cases import make_case, tiny_cases
from kacsim.jobs import expected
from kacsim.kac import ancestors, work
from kacsim.kac.constants import RATE
from kacsim.kernels.provenance import ROOT

CONFIG = ROOT / "config" / "config.yaml"
SIZE = {"n_draws": 1000, "n_replicates": 7, "seed": 1}


def velocities(**changes):
    given = {"algorithm": "bird", "engine": "ancestral", "n_particles": 9, "time": 1.3}
    return make_case("kac", **given | changes, **SIZE)


@pytest.fixture(scope="module")
def full():
    return plan.Plan(plan.read_config(CONFIG), [CONFIG])


@pytest.mark.parametrize("n", [2, 3, 7, 40, 10**3, 10**12, math.inf])
@pytest.mark.parametrize("time", [0.3, 2.0, 4.0])
def test_histories_have_about_the_exact_number_of_collisions(n, time):
    """Without chance: exact for N infinite, within a fifth for few particles."""
    collisions = work.history(RATE * time, n)
    exact = ancestors.expected_collisions(time, n)
    assert collisions == pytest.approx(exact, rel=0.2 if n < 1e6 else 1e-6)


def test_histories_end_with_all_particles():
    """Then all pairs of the N collide, N / 2 times in the time of one collision of a particle."""
    assert work.history(1000.0, 6) == pytest.approx(3000.0, rel=0.01)


@pytest.mark.parametrize(("m", "onset"), [(1.0, 0.0), (1.75, 0.0), (1.6, 0.8), (2.0, 5.0)])
def test_nodes_are_those_of_the_mean_recursion(m, onset):
    for time in (0.4, 1.0, 3.0):
        assert trees.nodes(time, m, onset) == pytest.approx(bkw.mean_recursion(time, m, onset))


def test_a_tree_in_the_trap_begins_with_one_node_and_grows():
    shape = {"amplitude": 0.7, "growth": 0.1, "radial": 1.9}
    assert trees.trap_nodes(1.0, 0.0, 3.0, **shape) == 1.0
    near, far = (trees.trap_nodes(r, 6.0, 3.0, **shape) for r in (0.0, 5.0))
    assert near > far > 1.0
    assert near == pytest.approx(1.0 + 0.7 * math.expm1(0.1 * 3.0 * 6.0))


def test_amounts_are_of_the_case_of_its_calls_and_of_its_draws():
    case = make_case("bkw", speed=[1.0, 2.0, 3.0], time=[1.0, 2.0], **SIZE)
    amounts = case.amounts()
    assert amounts["case"] == 1.0
    assert amounts["call"] == 6 * 7
    assert amounts["draw"] == 6 * 7000
    assert amounts["node"] == pytest.approx(3 * 7000 * (2 * math.e - 1 + 2 * math.e**2 - 1))
    shards = [part.amounts() for part in case.split(3)]
    assert sum(part["node"] for part in shards) == pytest.approx(amounts["node"])


def test_amounts_of_forward_draws_are_those_of_the_whole_ensemble():
    case = velocities(engine="forward", algorithm="nanbu_sequential", time_step=0.1)
    amounts = {term: n / 7000 for term, n in case.amounts().items()}
    assert amounts["particle"] == 9
    assert amounts["collision"] == pytest.approx(9 * RATE * 1.3 / 2)
    assert amounts["step"] == pytest.approx(13)


@pytest.mark.parametrize("case", [*tiny_cases()], ids=lambda case: case.kind)
def test_every_kind_has_coefficients_of_all_its_terms(case):
    known = costs.table()["nanoseconds"][case.kind]
    assert known.keys() == case.amounts().keys()
    assert sum(known.values()) > 0.0
    assert min(known.values()) >= 0.0


def test_kinds_of_the_configuration_were_all_measured(full):
    assert {case.kind for case in full.cases.values()} <= costs.table()["nanoseconds"].keys()


def test_what_was_not_measured_counts_as_the_slowest(monkeypatch):
    known = {"kac-bird-forward": {"draw": 3.0}, "kac-poisson-forward": {"draw": 2.0, "step": 5.0}}
    monkeypatch.setattr(costs, "table", lambda: {"nanoseconds": known})
    costs._usual.cache_clear()
    assert costs.nanoseconds("kac-lazy-forward") == {"draw": 3.0, "step": 5.0}
    assert costs.seconds("kac-bird-forward", {"draw": 10.0, "case": 1.0}) == pytest.approx(3e-8)
    assert costs.seconds("other", {"draw": 4.0}) == pytest.approx(1e-8)
    costs._usual.cache_clear()


def test_a_fit_finds_its_coefficients_again():
    """From exact times of awkward sizes."""
    true = {"case": 2e5, "call": 3e3, "draw": 7.0, "collision": 11.0}
    rows = []
    for n_particles in (2, 5, 30, 900):
        for size in ({"n_draws": 50, "n_replicates": 3}, {"n_draws": 4000, "n_replicates": 20}):
            case = dataclasses.replace(velocities(n_particles=n_particles), **size)
            seconds = 1e-9 * sum(true.get(term, 0.0) * n for term, n in case.amounts().items())
            rows.append(fitting.Timed(case, seconds))
    found = fitting.coefficients(rows)
    again = [1e-9 * sum(found[t] * n for t, n in row.amounts().items()) for row in rows]
    assert again == pytest.approx([row.seconds for row in rows], rel=0.02)
    assert found["collision"] == pytest.approx(11.0, rel=0.1)


def test_one_size_alone_is_laid_to_the_draws():
    rows = [fitting.Timed(velocities(), 1e-3)]
    found = fitting.coefficients(rows)
    assert found["case"] + found["call"] < 1e-6 * found["draw"] or found["case"] == 0.0


def test_the_shape_of_trees_is_found_again():
    shape = {"amplitude": 0.8, "growth": 0.11, "radial": 1.5}
    timed = {"trap-bkw": []}
    for radius in ([0.0, 2.0], [5.0]):
        case = make_case("trap", radius=radius, time=[1.0, 4.0, 9.0], **SIZE)
        nodes = [[trees.trap_nodes(r, t, 3.0, **shape) for t in (1.0, 4.0, 9.0)] for r in radius]
        timed["trap-bkw"].append(fitting.Timed(case, 1.0, np.array(nodes)))
    assert fitting.tree_shape(timed, "trap") == pytest.approx(shape, rel=1e-3)


def test_cases_are_chosen_at_the_ends_of_every_term():
    """Of 80 cases 6, the largest and smallest N, time and number of steps among them."""
    nanbu = {"engine": "forward", "algorithm": "nanbu_sequential"}
    found = [
        velocities(**nanbu, n_particles=n, time=time, time_step=time / steps)
        for n in (5, 6, 7, 8, 50)
        for time in (0.2, 0.4, 0.6, 3.0)
        for steps in (4, 5, 6, 700)
    ]
    chosen = [case.parameters for case in fitting.spread(found)]
    assert len(chosen) == 6
    assert {5, 50} <= {p["n_particles"] for p in chosen}
    assert {0.2, 3.0} <= {p["time"] for p in chosen}
    assert {4, 700} <= {round(p["time"] / p["time_step"]) for p in chosen}
    assert fitting.spread([found[0]] * 9) == [found[0]]


def test_cases_are_cut_to_a_short_time(monkeypatch):
    """With a clock that says what a case takes: whole replicates come last."""
    monkeypatch.setattr(
        fitting, "timed", lambda case, repeats=3: fitting.Timed(case, case.amounts()["draw"] * 1e-5)
    )
    long = dataclasses.replace(velocities(), n_draws=3000, n_replicates=50)
    cut = fitting.cut(long).case
    assert (cut.n_draws, cut.n_replicates) == (3000, pytest.approx(4, abs=3))
    assert fitting.cut(dataclasses.replace(long, n_draws=40, n_replicates=2)).case.n_draws == 40


def test_a_fit_is_written_and_read_again(tmp_path, monkeypatch):
    monkeypatch.setattr(costs, "FILE", tmp_path / "costs.json")
    (tmp_path / "costs.json").write_text(json.dumps({"stages": {"job": 0.1}}))
    costs.table.cache_clear()
    monkeypatch.setattr(fitting, "tiny_cases", lambda: iter(()))
    monkeypatch.setattr(fitting, "TRAPS", ())
    monkeypatch.setattr(fitting, "ENOUGH", 1e-3)
    case = make_case("identity", n_draws=500, n_replicates=2, seed=1)
    fitting.fit([case], {"kac_initial": [case]}, lambda line: None, tmp_path)
    written = costs.table()
    costs.table.cache_clear()
    assert written["nanoseconds"]["identity"]["draw"] > 0.0
    assert written["stages"] == {"job": 0.1}
    assert written["machine"]
    assert "numba" in written["versions"]


def test_stages_are_fitted_to_the_records_of_a_run(tmp_path):
    """Jobs of 1 to 5 cases, 0.4 s each and 0.1 s for every case; items of 2 and 6 cases."""
    for k, number in enumerate((1, 5, 3)):
        write(tmp_path / "benchmarks" / "sample" / f"a-{k}.tsv", 3.0 * number + 0.4 + 0.1 * number)
        log = tmp_path / "logs" / "sample" / f"a-{k}.log"
        log.parent.mkdir(parents=True, exist_ok=True)
        log.write_text("drew 5 values of x in 3.000 s\n" * number)
    for name, seconds in (("kac_fig1", 0.3), ("kac_fig2", 0.5)):
        write(tmp_path / "benchmarks" / "reduce" / f"{name}.tsv", seconds)
        write(tmp_path / "benchmarks" / "draw" / f"{name}.tsv", 2.0)
    found = fitting.stages({"kac_fig1": [0] * 2, "kac_fig2": [0] * 6}, tmp_path)
    wanted = {"job": 0.4, "case": 0.1, "item": 0.2 + 2.0, "read": 0.05}
    assert found == pytest.approx(wanted, rel=1e-3)
    assert fitting.stages({}, tmp_path / "none") is None


def write(path, seconds):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"s\th:m:s\n{seconds:.4f}\t0\n")


def test_the_table_of_items_adds_up(full):
    name = "kac_fig3"
    header, row = expected.items_table(full, [name]).splitlines()
    cases = full.cases_of[name]
    kernels = sum(case.seconds() for case in cases)
    assert header.split()[-1] == "seconds"
    assert row.split()[:2] == [name, str(len(cases))]
    assert float(row.split()[3]) == pytest.approx(kernels, abs=0.06)
    assert float(row.split()[4]) > kernels


def test_more_cores_take_less_but_not_less_than_the_longest_job(capsys):
    def wall(*words):
        assert cli.main(["plan", "--config", str(CONFIG), *words]) == 0
        return float(capsys.readouterr().out.rpartition("about ")[2].split()[0])

    longest = wall("--cores", "100000")
    assert wall("--cores", "1") > 1.9 * wall("--cores", "2") > 2.0
    assert 0.0 < longest < wall("--cores", "2")


def test_no_core_is_refused(capsys):
    assert cli.main(["plan", "--config", str(CONFIG), "--cores", "0"]) == 2
    assert "--cores = 0: must be an integer of at least 1" in capsys.readouterr().err
