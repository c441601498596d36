"""Compiled kernels: kept, checked before they are loaded, compiled again if damaged, and where."""

import os
import shutil
from pathlib import Path

import pytest
from kernel_draws import compiled, draw, first_kernels, stray

DRAW_ENCLOSED = """
import numpy as np
from kacsim.kac import poisson
from kacsim.streams import new_stream
values, own = np.empty(3), np.empty(3, np.int64)
poisson.ancestral(values, own, *poisson.arguments(n_particles=5, time=1.0, collision_rate=1.0),
                  new_stream(5, "test"))
print(values.tobytes().hex())
print(sum(poisson.ancestral.__wrapped__.stats.cache_hits.values()))
"""


first = pytest.fixture(scope="module")(first_kernels)


@pytest.fixture
def kernels(first, tmp_path):
    """Return a folder of kernels of this test."""
    return shutil.copytree(first[0], tmp_path / "kernels")


def test_kernels_are_kept_and_damaged_ones_compiled_again(kernels, first):
    _, bits = first
    assert draw(KACSIM_CACHE_DIR=kernels) == (bits, True, "")
    for suffix in ("nbc", "nbi"):
        (file,) = compiled(kernels, suffix)
        broken = bytearray(file.read_bytes())
        broken[len(broken) // 2] ^= 0x10
        file.write_bytes(broken)
        again, loaded, message = draw(KACSIM_CACHE_DIR=kernels)
        assert (again, loaded) == (bits, False)
        assert "damaged kernels are compiled again" in message
    (file,) = compiled(kernels, "nbc")
    file.write_bytes(b"")
    assert draw(KACSIM_CACHE_DIR=kernels)[0] == bits
    assert draw(KACSIM_CACHE_DIR=kernels)[1], "sealed again"
    assert stray() == []


def test_a_kernel_that_encloses_others_is_kept(tmp_path):
    """An ancestral kernel encloses the histories of its algorithm, themselves compiled."""
    bits, loaded, _ = draw(DRAW_ENCLOSED, KACSIM_CACHE_DIR=tmp_path)
    assert not loaded
    assert draw(DRAW_ENCLOSED, KACSIM_CACHE_DIR=tmp_path) == (bits, True, "")


def test_kernels_without_checksums_are_left_alone(kernels, first):
    (file,) = compiled(kernels, "nbc")
    (file.parent / "checksums.json").unlink()
    assert draw(KACSIM_CACHE_DIR=kernels) == (first[1], True, "")


def unusable(kind, tmp_path):
    """Return a folder for kernels that cannot be made, or cannot be written."""
    if kind == "in a file":
        (tmp_path / "file").write_text("")
        return tmp_path / "file" / "kernels"
    if kind == "a file":
        (tmp_path / "kernels").write_text("")
        return tmp_path / "kernels"
    return Path("/proc")  # it is there, and nobody can write to it


@pytest.mark.parametrize("kind", ["in a file", "a file", "not writable"])
def test_a_folder_that_cannot_be_used_is_told_and_replaced(kind, first, tmp_path):
    """One line, the same bits, and nothing stays: not in the temporary folder, not here.

    numba would go, silently, to __pycache__ beside the sources, and not see edited callees there.
    """
    wanted, temporary = unusable(kind, tmp_path), tmp_path / "temporary"
    temporary.mkdir()
    bits, loaded, message = draw(KACSIM_CACHE_DIR=wanted, TMPDIR=temporary)
    assert (bits, loaded) == (first[1], False)
    (line,) = message.splitlines()
    assert line.startswith(f"{wanted}: cannot be written (")
    assert f"kernels are compiled into {temporary}/kacsim-" in line
    assert "KACSIM_CACHE_DIR names another folder" in line
    assert os.listdir(temporary) == []
    assert stray() == []


def test_a_folder_without_permission_is_replaced(first, tmp_path):
    """As root one may write everywhere: then the kernels are there."""
    wanted = tmp_path / "wanted"
    wanted.mkdir(mode=0o500)
    bits, _, message = draw(KACSIM_CACHE_DIR=wanted)
    assert bits == first[1]
    if os.access(wanted, os.W_OK):
        assert compiled(wanted, "nbc")
    else:
        assert "cannot be written (Permission denied)" in message
        assert os.listdir(wanted) == []
    assert stray() == []


def test_without_a_name_the_users_cache_is_taken(first, tmp_path):
    shutil.copytree(first[0], tmp_path / "kacsim")
    found = draw(KACSIM_CACHE_DIR="", XDG_CACHE_HOME=tmp_path)
    assert found == (first[1], True, "")
