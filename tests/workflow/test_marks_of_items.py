"""The case that a mark names: draws of another seed there change this mark, and no other's."""

import dataclasses

import numpy as np
import pytest

from kacsim import items, store
from kacsim.drawing import marks, origins
from kacsim.jobs import sampling, stages

# Grids over settings of the same and of other names, sizes, histograms, all texts.
TOLD = (
    "kac_fig2",
    "kac_fig5",
    "kac_bias",
    "boltzmann_fig4",
    "boltzmann_fig7",
    "boltzmann_fig10",
    "maxwell_cost",
    "techniques_steps",
)


def drawn(name, samples, settings):
    """Return (dataset, series of its figure)."""
    dataset = items.reduced(name, samples, settings)
    panels = marks.named(items.load(name).draw(dataset))
    return dataset, [one for _, shown in panels for one in shown]


@pytest.mark.parametrize("name", TOLD)
def test_another_seed_of_a_case_changes_its_marks_alone(name, smoke_run, tmp_path):
    results = smoke_run / "results"
    settings = store.read(results / f"datasets/{name}.nc").attrs["settings"]
    cases = items.load(name).cases(settings)
    samples = {case.id: store.read(results / f"samples/{case.id}.nc") for case in cases}
    dataset, before = drawn(name, samples, settings)
    told = [origins.of_series(one, dataset, stages.drawn_from(cases)) for one in before]
    named = sorted({k for places in told for k in places} - {None})
    assert named
    for k in named[:2]:
        other = dataclasses.replace(cases[k], seed=cases[k].seed + 1)
        store.write_sample(sampling.run(other), tmp_path / "other.nc", other)
        anew = {cases[k].id: store.read(tmp_path / "other.nc")}
        _, after = drawn(name, samples | anew, settings)
        changed = [
            place
            for one, two, places in zip(before, after, told, strict=True)
            for old, new, place in zip(one["y"], two["y"], places, strict=True)
            if not np.array_equal(old, new, equal_nan=True)
        ]
        assert k in changed
        assert set(changed) <= {k, None}
