"""The scenarios of tests/faults.py on a few items: killed, broken, full, at the same time."""

import os

import faults
import pytest
from runs import Run

ITEMS = ("kac_fig4", "kac_fig6", "boltzmann_fig7")


@pytest.fixture(scope="module")
def warm(tmp_path_factory):
    """Return (checksums of an undisturbed run, its kernel cache)."""
    run = Run(tmp_path_factory.mktemp("undisturbed"), ITEMS)
    return run.complete(), run.cache


@pytest.mark.parametrize("scenario", faults.SCENARIOS, ids=lambda scenario: scenario.__name__)
def test_same_bytes_after(scenario, warm, tmp_path):
    if scenario is faults.full_disk and not (os.geteuid() == 0 and faults.can_mount()):
        pytest.skip("a small disk cannot be mounted here")
    expected, cache = warm
    made = []

    def make():
        made.append(Run(tmp_path / str(len(made)), ITEMS, cache))
        return made[-1]

    assert scenario(make, expected, False) > 0
