"""What made a result: the hash of the sources, the commit and the versions used."""

import functools
import hashlib
import importlib.metadata
import platform
import subprocess
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
ROOT = PACKAGE.parent


def source_hash(*paths):
    """Return 16 hex digits that change when one of the sources does.

    Parameters
    ----------
    *paths : files or folders (every ``.py`` below them), relative to the package

    Raises
    ------
    FileNotFoundError
        If a path does not exist: a misspelt name would hash nothing, silently.
    """
    digest = hashlib.sha256()
    for path in paths:
        target = PACKAGE / path
        if not target.exists():
            raise FileNotFoundError(f"no source at {target}")
        files = sorted(target.rglob("*.py")) if target.is_dir() else [target]
        for file in files:
            digest.update(file.relative_to(PACKAGE).as_posix().encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


@functools.cache
def commit():
    """Return the commit of the checkout, ``unknown`` outside one."""
    command = ["git", "-C", str(ROOT), "rev-parse", "HEAD"]
    try:
        answer = subprocess.run(command, capture_output=True, text=True, timeout=10)
    except (OSError, subprocess.SubprocessError):
        return "unknown"
    return answer.stdout.strip() if answer.returncode == 0 else "unknown"


def versions():
    """Return the versions that can change the bits of a draw, as one sentence."""
    parts = [f"Python {platform.python_version()}"]
    parts += [f"{name} {importlib.metadata.version(name)}" for name in ("numpy", "numba", "scipy")]
    return ", ".join(parts)
