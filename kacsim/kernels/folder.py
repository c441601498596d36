"""The folder of what is compiled or kept between runs."""

import atexit
import contextlib
import functools
import os
import shutil
import sys
import tempfile
from pathlib import Path

OUTSIDE = "where compiled code lies changes no result"


@functools.cache
def root():
    """Return the folder: ``KACSIM_CACHE_DIR``, or ``kacsim`` in the user's cache.

    Where it cannot be written the process has a temporary one of its own, and says so.
    """
    default = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "kacsim"
    wanted = Path(os.environ.get("KACSIM_CACHE_DIR") or default).absolute()
    try:
        wanted.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=wanted):
            return wanted
    except OSError as error:
        temporary = Path(tempfile.mkdtemp(prefix="kacsim-"))
        atexit.register(_remove, temporary, os.getpid())
        reason = error.strerror or error
        print(
            f"{wanted}: cannot be written ({reason}): kernels are compiled into {temporary}, "
            "for this process alone; KACSIM_CACHE_DIR names another folder",
            file=sys.stderr,
        )
        return temporary


def _remove(temporary, process):
    if os.getpid() == process:  # a forked process must not take it away from its parent
        shutil.rmtree(temporary, ignore_errors=True)


def write_quietly(path, text):
    """Write a file in one step; a full disk or a read-only folder only costs time later."""
    with contextlib.suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}-")
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                file.write(text)
            os.replace(name, path)
        except OSError:
            os.unlink(name)
            raise
