"""The only reader and writer of result files (NetCDF).

Files are written under a temporary name and then renamed: a file that exists is whole. No
attribute holds a time, so that the same result has the same bytes.
"""

import json
import os
import tempfile
from pathlib import Path

import numpy as np
import xarray as xr

from kacsim import __version__, provenance


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
        handle, temporary = tempfile.mkstemp(
            dir=path.parent, prefix=f".{path.stem}-", suffix=path.suffix
        )
        os.close(handle)
        write(temporary)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
    except OSError as error:
        raise StoreError(f"{path}: cannot be written: {error.strerror or error}") from error
    finally:
        if temporary and os.path.exists(temporary):
            os.remove(temporary)


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def write(dataset, path, *, title, settings):
    """Write a dataset with its provenance.

    Parameters
    ----------
    dataset : xarray.Dataset, every variable with ``long_name`` and ``units``
    path : file to create or replace
    title : one sentence that says what the file holds
    settings : dict, everything the content was made from; stored as JSON
    """
    attributes = {k: v if isinstance(v, (str, int, float)) else json.dumps(v, sort_keys=True)
                  for k, v in dataset.attrs.items()}
    complete = dataset.drop_attrs(deep=False).assign_attrs(
        attributes,
        Conventions="CF-1.11",
        title=title,
        source=f"kacsim {__version__}, commit {provenance.commit()}, {provenance.versions()}",
        settings=json.dumps(settings, sort_keys=True),
    )
    encoding = {name: _encoding(variable) for name, variable in complete.variables.items()}
    replace_file(
        path, lambda name: complete.to_netcdf(name, engine="netcdf4", encoding=encoding)
    )


def _encoding(variable):
    # Coordinates and counts have no missing values; text cannot be compressed.
    plain = {"_FillValue": None} if variable.dtype.kind in "fiub" else {}
    large = variable.dtype.kind in "fi" and variable.size > 1000
    return plain | ({"zlib": True, "complevel": 4, "shuffle": True} if large else {})


def read(path):
    """Return the dataset of a file, in memory, with its settings decoded in ``attrs``.

    Raises
    ------
    StoreError
        Names the file and the command that makes it again.
    """
    path = Path(path)
    try:
        with xr.open_dataset(path, engine="netcdf4") as dataset:
            content = dataset.load()
        for name in ("settings", "published"):
            if name in content.attrs or name == "settings":
                content.attrs[name] = json.loads(content.attrs[name])
    except (OSError, KeyError, ValueError, RuntimeError, AttributeError) as error:
        hint = f"remove it and run snakemake again to rebuild it ({type(error).__name__})"
        raise StoreError(f"{path}: not a readable result file; {hint}") from error
    return content


def read_sample(path, case):
    """Return the samples of a case, refused if they were drawn with other settings.

    Raises
    ------
    StoreError
        Names the file and what differs.
    """
    content = read(path)
    found, wanted = content.attrs["settings"], json.loads(json.dumps(case.settings()))
    if found != wanted:
        keys = sorted(key for key in found | wanted if found.get(key) != wanted.get(key))
        raise StoreError(
            f"{path}: drawn with other {', '.join(keys)}; remove it and run snakemake again"
        )
    return content


def check_writable(path):
    """Raise StoreError if no file can be written at the path: before any work starts."""
    path = Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        raise StoreError(f"{path}: cannot be written: {error.strerror or error}") from error


def described(values, dims, long_name, units="1"):
    """Return a variable with the two attributes that every variable has."""
    return xr.Variable(dims, np.asarray(values), {"long_name": long_name, "units": units})
