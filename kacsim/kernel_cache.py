"""Checksums of compiled kernels: machine code with a flipped bit must not draw anything.

numba reads its cache without a check. A process that compiles leaves the checksums of the folder
when it ends; a process that loads compares them first, and compiles again what does not fit. A
folder without checksums is left alone: another process may be compiling there.
"""

import atexit
import functools
import hashlib
import json
import os
import sys
import tempfile
from pathlib import Path

CHECKSUMS = "checksums.json"
_kernels = []


def watch(kernel):
    """Check the folder of a kernel's compiled code, and seal it at the end if it is compiled."""
    folder = Path(kernel.stats.cache_path)
    if not _kernels:
        atexit.register(_seal_compiled)
    _kernels.append((kernel, folder))
    repair(folder)


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
    try:
        text = (folder / CHECKSUMS).read_text(encoding="utf-8")
    except OSError:
        return False
    found = _compiled(folder)
    if text == json.dumps(found):
        return False
    for name in (*found, CHECKSUMS):
        (folder / name).unlink(missing_ok=True)
    print(f"{folder}: damaged kernels are compiled again", file=sys.stderr)
    return True


def _seal_compiled():
    for kernel, folder in _kernels:
        compiled = sum(kernel.stats.cache_misses.values())
        loaded = sum(kernel.stats.cache_hits.values())
        try:
            if compiled or (loaded and not (folder / CHECKSUMS).exists()):
                seal(folder)
        except OSError:  # a full disk or a read-only folder: the next process compiles again
            continue
