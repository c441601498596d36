"""The study of one's own laws, on samples made by hand, and its keys. No z tests: all is exact."""

import math
import shutil

import numpy as np
import pytest
from fabricated import about, bins, reduced, settings, velocities

from kacsim import items, plan
from kacsim.kac import own_moments
from kacsim.kernels.provenance import ROOT

TIMES = (0.7, 1.7)
N_DRAWS, N_REPLICATES = 1000, 4
EXAMPLE = ROOT / "docs/examples/own_initial.csv"


def make(case):
    """Return a sample of which E v² is 0.1 too much, and E v⁴ would be 4 E v² if that were right.

    One replicate has all its draws at 0.5, the others at -1.
    """
    k = TIMES.index(case.parameters["time"])
    counts = [bins({0.5: N_DRAWS})] + [bins({-1.0: N_DRAWS})] * (N_REPLICATES - 1)
    return velocities(
        case,
        counts,
        v2=about(1.6, 0.01, N_REPLICATES),
        v4=about(5.0 + k, 0.02, N_REPLICATES),
        v6=1.6 * (5.0 + k) + 4.0 * (5.0 + k - 1.6**2),
        v8=900.0,
    )


CHOSEN = {
    "initial": "two_peaks", "scattering": "forward", "algorithm": "bird", "n_particles": 7,
    "time": list(TIMES), "n_draws": N_DRAWS, "n_replicates": N_REPLICATES,
}  # fmt: skip


@pytest.fixture(scope="module")
def dataset():
    return reduced("kac_own", settings("kac_own", **CHOSEN), make)


def test_the_fourth_moment_is_mended_by_the_second(dataset):
    assert dataset.moment.values == pytest.approx([5.0 - 0.4, 6.0 - 0.4])
    spread = [m - 1.6**2 for m in (5.0, 6.0)]
    left = [900.0 - m**2 - 16.0 * s for m, s in zip((5.0, 6.0), spread, strict=True)]
    errors = [math.sqrt(one / (N_DRAWS * N_REPLICATES)) for one in left]
    assert dataset.moment_error.values == pytest.approx(errors)


def test_the_second_moment_is_its_own(dataset):
    assert dataset.square.values == pytest.approx([1.6, 1.6])
    errors = [math.sqrt((m - 1.6**2) / (N_DRAWS * N_REPLICATES)) for m in (5.0, 6.0)]
    assert dataset.square_error.values == pytest.approx(errors)
    assert float(dataset.square_exact) == pytest.approx(1.5)


def test_the_exact_moments_are_those_of_the_case(dataset):
    for time in TIMES:
        wanted = own_moments.fourth_moment(
            time, 7, initial="two_peaks", scattering="forward", algorithm="bird"
        )
        assert float(dataset.moment_exact.sel(time=time)) == pytest.approx(wanted)
    limit = own_moments.fourth_moment(1.7, initial="two_peaks", scattering="forward")
    assert float(dataset.moment_limit[-1]) == pytest.approx(limit)
    assert float(dataset.curve_time[-1]) == pytest.approx(1.7)


def test_the_histogram_is_of_all_replicates(dataset):
    width = dataset.attrs["settings"]["bin_width"]
    edges = dataset.edge.values
    for k in range(len(TIMES)):
        inside = dataset.density[k].values * width
        assert inside[np.searchsorted(edges, 0.5 + 1e-9) - 1] == pytest.approx(1 / N_REPLICATES)
        assert inside.sum() == pytest.approx(1.0)
    middle = 0.5 * (edges[1:] + edges[:-1])
    start = dataset.density_start.values * width
    assert start.sum() == pytest.approx(1.0)
    assert (start * middle**2).sum() == pytest.approx(1.5, rel=2e-3)


def made(**own):
    config = plan.read_config(ROOT / "config" / "smoke.yaml")
    config["kac_own"].update(own)
    return plan.Plan(config)


def test_an_edited_file_is_another_case_and_another_setting(tmp_path, monkeypatch):
    """A job that was planned before the edit is refused in one line."""
    monkeypatch.chdir(tmp_path)
    shutil.copy(EXAMPLE, "mine.csv")
    first = made(initial="mine.csv")
    text = (tmp_path / "mine.csv").read_text()
    (tmp_path / "mine.csv").write_text(text.replace("\n", "\n-9,0\n", 1))
    other = made(initial="mine.csv")
    ids = [{case.id for case in one.cases_of["kac_own"]} for one in (first, other)]
    assert not ids[0] & ids[1]
    before, after = (one.settings["kac_own"]["initial"] for one in (first, other))
    assert before.startswith("mine.csv@")
    assert after.startswith("mine.csv@")
    assert before != after
    with pytest.raises(plan.PlanError, match="has changed since: the digest"):
        made(initial=before)
    assert made(initial=after).settings == other.settings


@pytest.mark.parametrize(
    ("key", "value", "sentence"),
    [
        ("initial", "peaks", "must be one of f0, two_peaks, uniform, maxwell, or a file"),
        ("initial", "absent.csv", "cannot be read: No such file"),
        ("initial", 3, "must be of type string"),
        ("scattering", "two_peaks", "must be one of uniform, forward, grazing, or a file"),
        ("algorithm", "nanbu_synchronous", "must be one of ['bird', 'poisson']"),
    ],
)
def test_bad_input_is_named_by_its_key(key, value, sentence):
    with pytest.raises(plan.PlanError) as refused:
        made(**{key: value})
    (line,) = str(refused.value).splitlines()
    assert f"kac_own.{key} = {value!r}: " in line
    assert sentence in line


def test_the_papers_laws_are_the_papers_cases():
    """Named or not: the cases of the other items, and no kernels for tables."""
    (case,) = made(initial="f0", scattering="uniform").cases_of["kac_own"]
    assert "initial" not in case.id
    assert case.roots[-1][1] == "ancestral"
    assert items.load("kac_own").settled({"initial": "f0", "scattering": "uniform"}) == {
        "initial": "f0",
        "scattering": "uniform",
    }
