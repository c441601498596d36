"""Checksums of compiled kernels: machine code with a flipped bit must not draw anything.

numba reads its cache without a check. Whoever compiles leaves the checksums of the folder; whoever
loads compares them first, and compiles again what does not fit. A folder without checksums is left
alone: another process may be compiling there.
"""

import contextlib
import functools
import hashlib
import json
import os
import sys
import tempfile
import time
from pathlib import Path

CHECKSUMS = "checksums.json"
PATIENCE = 0.2  # seconds between another process saving code and sealing it, twice


def watch(kernel):
    """Check the folder of a kernel's compiled code, and seal it whenever code is added."""
    folder = Path(kernel.stats.cache_path)
    repair(folder)
    cache = kernel._cache  # numba tells nobody when it has saved
    save = cache.save_overload

    def save_and_seal(*arguments):
        save(*arguments)
        with contextlib.suppress(OSError):  # a full disk, a read-only folder: compiled again
            seal(folder)

    cache.save_overload = save_and_seal


def _compiled(folder):
    return {
        file.name: hashlib.sha256(file.read_bytes()).hexdigest()
        for file in sorted(folder.glob("*.nb[ic]"))
    }


def seal(folder):
    """Write the checksums of the compiled code in a folder."""
    handle, name = tempfile.mkstemp(dir=folder, prefix=".checksums-")
    with os.fdopen(handle, "w", encoding="utf-8") as file:
        json.dump(_compiled(folder), file)
    os.replace(name, folder / CHECKSUMS)


@functools.cache
def repair(folder):
    """Remove the compiled code of a folder if it does not fit its checksums.

    Returns
    -------
    bool, whether something was removed: it is compiled again at its first call
    """
    for wait in (PATIENCE, PATIENCE, 0.0):
        try:
            text = (folder / CHECKSUMS).read_text(encoding="utf-8")
            found = _compiled(folder)
        except OSError:
            return False
        if text == json.dumps(found):
            return False
        time.sleep(wait)
    for name in (*found, CHECKSUMS):
        (folder / name).unlink(missing_ok=True)
    print(f"{folder}: damaged kernels are compiled again", file=sys.stderr)
    return True
