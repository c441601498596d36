"""What all tests share: the seed, one finished smoke run, and which of them run the workflow."""

import os
from pathlib import Path

import pytest
import smoke
from law.looks import pytest_pyfunc_call, pytest_terminal_summary  # noqa: F401

HERE = Path(__file__).parent
SLOW = (HERE / "workflow", HERE / "browser")


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_collection_modifyitems(items):
    """Mark what runs the workflow; what waits for the smoke run comes last."""
    for item in items:
        if item.path.parent in SLOW:
            item.add_marker(pytest.mark.workflow)
    yield
    items.sort(key=lambda item: "smoke_run" in item.fixturenames)


@pytest.fixture(scope="session")
def seed():
    """Return the seed of every random stream that a test draws from."""
    return int(os.environ.get("KACSIM_TEST_SEED", "1"))


@pytest.fixture(scope="session")
def shared_folder(tmp_path_factory):
    """Return a temporary folder of this run of tests, the same for all its processes."""
    own = tmp_path_factory.getbasetemp()
    return own.parent if "PYTEST_XDIST_WORKER" in os.environ else own


@pytest.fixture(scope="session", autouse=True)
def smoke_under_way(request, shared_folder):
    """Start the smoke run, if it is not there and some test will want it; return its folder."""
    if folder := smoke.given():
        return folder
    if any("smoke_run" in item.fixturenames for item in request.session.items):
        session = os.getppid() if "PYTEST_XDIST_WORKER" in os.environ else os.getpid()
        smoke.start(shared_folder / "smoke", session)
    return shared_folder / "smoke"


@pytest.fixture(scope="session")
def smoke_run(smoke_under_way):
    """Return the folder of the finished smoke run, a copy of the project; leave it as it is."""
    if smoke.given() is None:
        smoke.wait(smoke_under_way)
    return smoke_under_way
