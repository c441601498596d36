"""What all tests share: the seed, fixed unless KACSIM_TEST_SEED says otherwise."""

import os
import sys
from pathlib import Path

import pytest

# Tests import law.compare, runs and faults from this folder, whatever the import mode.
sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(scope="session")
def seed():
    """Return the seed of every random stream that a test draws from."""
    return int(os.environ.get("KACSIM_TEST_SEED", "1"))
