"""Files in one step, checksums, and YAML: what every writer and reader needs."""

import errno
import glob
import hashlib
import os
import tempfile
from pathlib import Path

import yaml

try:
    from yaml import CSafeLoader as SafeLoader  # ten times as fast, where libyaml is there
except ImportError:
    from yaml import SafeLoader

OUTSIDE = "a file is written whole or not at all, whatever it holds"


class StoreError(Exception):
    """A result file that cannot be read or written, with what to do about it."""


def replace_file(path, write):
    """Call write(temporary path), then give the file its name in one step.

    Raises
    ------
    StoreError
        Names the file and the reason; nothing is left under either name.
    """
    path = Path(path)
    temporary = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        for left in path.parent.glob(f".{glob.escape(path.stem)}-????????{path.suffix}"):
            left.unlink()  # of a job that was killed
        handle, temporary = tempfile.mkstemp(
            dir=path.parent, prefix=f".{path.stem}-", suffix=path.suffix
        )
        os.close(handle)
        write(temporary)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
    except (OSError, RuntimeError) as error:  # the NetCDF library reports a full disk as either
        reason = getattr(error, "strerror", None) or error
        raise StoreError(f"{path}: cannot be written: {reason}") from error
    finally:
        if temporary and os.path.exists(temporary):
            os.remove(temporary)


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def read_yaml(path):
    """Return the content of a YAML file.

    Raises
    ------
    OSError, UnicodeDecodeError, yaml.YAMLError
    """
    return yaml.load(Path(path).read_text(encoding="utf-8"), SafeLoader)


def write_sums(paths, output):
    """Write the SHA-256 of files of one folder, in the form of `sha256sum`."""
    lines = [f"{_sum(path)}  {Path(path).name}\n" for path in sorted(paths)]
    replace_file(output, lambda name: Path(name).write_text("".join(lines), encoding="utf-8"))


def check_sums(path):
    """Refuse files that do not fit the sums kept beside them.

    Raises
    ------
    StoreError
        Names the first file that has changed since it was written.
    """
    path = Path(path)
    try:
        kept = [line.split() for line in path.read_text(encoding="utf-8").splitlines()]
        wrong = [
            path.with_name(name) for digest, name in kept if _sum(path.with_name(name)) != digest
        ]
    except (OSError, ValueError) as error:
        raise StoreError(f"{path}: cannot be read: remove it and run snakemake again") from error
    for changed in wrong:
        raise StoreError(f"{changed}: has changed; remove it and run snakemake again to rebuild it")


def _sum(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def check_writable(path):
    """Raise StoreError if no file can be written at the path: before any work starts."""
    path = Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        raise StoreError(f"{path}: cannot be written: {error.strerror or error}") from error
