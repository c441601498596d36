"""The scenarios of tests/faults.py on the cheapest items: killed, broken, full, two at a time."""

import fcntl
import os

import faults
import pytest
from runs import Run, same

ITEMS = ("boltzmann_fig7", "techniques_fig1")


@pytest.fixture(scope="session")
def undisturbed(shared_folder):
    """Return a finished run of the items, begun with a cold kernel cache; made by one process."""
    folder = shared_folder / "undisturbed"
    with open(folder.with_suffix(".lock"), "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        new = not folder.exists()
        folder.mkdir(exist_ok=True)
        run = Run(folder, ITEMS)
        if new:
            run.complete()
        return run


@pytest.mark.parametrize("scenario", faults.SCENARIOS, ids=lambda scenario: scenario.__name__)
def test_same_bytes_after(scenario, undisturbed, tmp_path):
    if scenario is faults.full_disk and not (os.geteuid() == 0 and faults.can_mount()):
        pytest.skip("a small disk cannot be mounted here")
    make = faults.Maker(tmp_path, ITEMS, undisturbed)
    assert scenario(make, undisturbed.checksums(), False) > 0


def test_same_bytes_as_in_a_run_of_everything(undisturbed, finished):
    everything = Run(finished.folder).checksums()
    expected = undisturbed.checksums()
    same({name: everything.get(name) for name in expected}, expected, "a run of everything")
