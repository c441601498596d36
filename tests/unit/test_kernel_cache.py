"""Compiled kernels: kept, checked before they are loaded, and compiled again if damaged."""

import os
import subprocess
import sys

import pytest

from kacsim.kernels.provenance import ROOT

DRAW = """
import numpy as np
from kacsim.boltzmann import null_collisions
from kacsim.streams import new_stream
values, nodes = np.empty(3), np.empty(3, np.int64)
null_collisions.estimate(values, nodes, 1.7, 1.3, 10**6, new_stream(5, "test"))
print(values.tobytes().hex())
print(sum(null_collisions.estimate.stats.cache_hits.values()))
"""


@pytest.fixture
def draw(tmp_path):
    """Return a function that draws in a new process: (bits, loaded from the cache, stderr)."""

    def run():
        environment = os.environ | {"KACSIM_CACHE_DIR": str(tmp_path / "kernels")}
        command = [sys.executable, "-c", DRAW]
        done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        bits, hits = done.stdout.split()
        return bits, hits == "1", done.stderr

    return run


def compiled(folder, suffix):
    return sorted(folder.rglob(f"null_collisions.estimate*.{suffix}"))


def test_kernels_are_kept_and_damaged_ones_compiled_again(draw, tmp_path):
    first, loaded, _ = draw()
    assert not loaded
    again, loaded, message = draw()
    assert (again, loaded, message) == (first, True, "")
    for suffix in ("nbc", "nbi"):
        (file,) = compiled(tmp_path / "kernels", suffix)
        broken = bytearray(file.read_bytes())
        broken[len(broken) // 2] ^= 0x10
        file.write_bytes(broken)
        bits, loaded, message = draw()
        assert (bits, loaded) == (first, False)
        assert "damaged kernels are compiled again" in message
    (file,) = compiled(tmp_path / "kernels", "nbc")
    file.write_bytes(b"")
    assert draw()[0] == first
    assert draw()[1], "sealed again"


def test_kernels_without_checksums_are_left_alone(draw, tmp_path):
    first, _, _ = draw()
    (seal,) = (tmp_path / "kernels").rglob("checksums.json")
    seal.unlink()
    assert draw() == (first, True, "")
