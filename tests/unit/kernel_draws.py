"""A kernel drawn with in a new process: its bits, whether it was loaded, what was said."""

import os
import subprocess
import sys

from kacsim.kernels.provenance import ROOT

DRAW = """
import numpy as np
from kacsim.streams import new_stream
from kacsim.techniques.inverse_transform import through_table
values = np.empty(3)
through_table(values, np.array([0.0, 0.7, 1.9]), new_stream(5, "test"))
print(values.tobytes().hex())
print(sum(through_table.stats.cache_hits.values()))
"""


def draw(script=DRAW, **given):
    """Draw in a new process with some environment: (bits, loaded from the cache, stderr)."""
    command = [sys.executable, "-c", script]
    environment = os.environ | {name: str(value) for name, value in given.items()}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    bits, hits = done.stdout.split()
    return bits, hits == "1", done.stderr


def compiled(folder, suffix):
    return sorted(folder.rglob(f"inverse_transform.through_table*.{suffix}"))


def stray():
    """Return the compiled kernels beside the sources."""
    return [str(file) for file in (ROOT / "kacsim").rglob("*.nb[ic]")]


def first_kernels(tmp_path_factory):
    """Return (a folder of kernels that was not there before, the bits that they draw)."""
    folder = tmp_path_factory.mktemp("first") / "new" / "kernels"
    bits, loaded, message = draw(KACSIM_CACHE_DIR=folder)
    assert (loaded, message) == (False, "")
    return folder, bits
