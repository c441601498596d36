"""What made a result: the commit and the versions used."""

import functools
import importlib.metadata
import platform
import subprocess
from pathlib import Path

from kacsim import __version__

PACKAGE = Path(__file__).resolve().parent.parent
ROOT = PACKAGE.parent
ANCHORED = ("kacsim", "workflow", "reports", "Snakefile", "environment.txt")


@functools.cache
def commit():
    """Return the commit of the checkout; ``+changes`` if what results come from differs from it.

    Outside a checkout it is ``unknown``.
    """
    head = _git("rev-parse", "HEAD")
    if head is None:
        return "unknown"
    changed = _git("status", "--porcelain", "--", *ANCHORED)
    return head if changed == "" else f"{head}+changes"


def _git(*words):
    """Return what git says of this checkout, None where it fails."""
    command = ["git", "-C", str(ROOT), *words]
    try:
        answer = subprocess.run(command, capture_output=True, text=True, timeout=10)
    except (OSError, subprocess.SubprocessError):
        return None
    return answer.stdout.strip() if answer.returncode == 0 else None


@functools.cache
def version(library):
    """Return the version of an installed library, ``none`` where there is none of that name."""
    try:
        return importlib.metadata.version(library)
    except importlib.metadata.PackageNotFoundError:
        return "none"


def versions(libraries=("numpy", "numba", "scipy")):
    """Return the versions that can change the bits of a result, as one sentence."""
    parts = [f"Python {platform.python_version()}"]
    return ", ".join(parts + [f"{name} {version(name)}" for name in libraries])


def source():
    """Return the version, the commit and the versions of libraries, as one sentence."""
    return f"kacsim {__version__}, commit {commit()}, {versions()}"
