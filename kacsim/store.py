"""The only reader and writer of result files (NetCDF).

Files are written under a temporary name and then renamed: a file that exists is whole. No
attribute holds a time, so that the same result has the same bytes.
"""

import hashlib
import json
from pathlib import Path

import netCDF4
import numpy as np

from kacsim.files import StoreError, replace_file
from kacsim.kernels import provenance, sources


def write(content, path, *, title, settings, code=""):
    """Write a dataset with its provenance and a checksum of everything in it.

    Parameters
    ----------
    content : dict name -> variable of `described`, or xarray.Dataset
    path : file to create or replace
    title : one sentence that says what the file holds
    settings : dict, everything the content was made from; stored as JSON
    code : hash of the sources that made it
    """
    variables, attributes = content, {}
    if hasattr(content, "variables"):
        variables = {name: (v.dims, v.values, v.attrs) for name, v in content.variables.items()}
        attributes = {name: _plain(value) for name, value in content.attrs.items()}
    attributes |= {
        "Conventions": "CF-1.11",
        "title": title,
        "source": provenance.source(),
        "settings": json.dumps(settings, sort_keys=True),
        "code": code,
    }
    attributes["checksum"] = _checksum(variables, attributes)
    replace_file(path, lambda name: _write_netcdf(name, variables, attributes))


def write_sample(variables, path, case):
    """Write the samples of a case, or of a shard, with what `read_sample` will check."""
    code = sources.code(case.roots)
    write(variables, path, title=case.title(), settings=case.settings(), code=code)


def _checksum(variables, attributes):
    """Return the hash of names, values and attributes: a file with flipped bits fails it."""
    digest = hashlib.sha256(json.dumps(attributes, sort_keys=True).encode())
    for name, (dims, values, described_as) in sorted(variables.items()):
        values = np.asarray(values)
        if values.dtype.kind in "OUT":
            values = np.array(json.dumps(values.tolist()), dtype=str)
        about = [
            name,
            list(dims),
            list(values.shape),
            values.dtype.str,
            sorted(described_as.items()),
        ]
        digest.update(json.dumps(about).encode())
        digest.update(np.ascontiguousarray(values).tobytes())
    return digest.hexdigest()


def _plain(value):
    return value if isinstance(value, (str, int, float)) else json.dumps(value, sort_keys=True)


def _write_netcdf(path, variables, attributes):
    """Write variables (dims, values, attributes) and global attributes to a new file."""
    with netCDF4.Dataset(path, "w", format="NETCDF4") as file:
        file.setncatts(attributes)
        for name, (dims, values, described_as) in variables.items():
            values = np.asarray(values)
            for dim, size in zip(dims, values.shape, strict=True):
                if dim not in file.dimensions:
                    file.createDimension(dim, size)
            text = values.dtype.kind in "OU"
            kind = str if text else values.dtype
            # Text cannot be compressed, and small arrays need not be.
            packed = {} if text or values.size <= 1000 else {"zlib": True, "shuffle": True}
            variable = file.createVariable(name, kind, dims, fill_value=False, **packed)
            variable.setncatts(described_as)
            variable[...] = values.astype(object) if text else values


def read(path):
    """Return the dataset of a file, in memory, with its settings decoded in ``attrs``.

    Raises
    ------
    StoreError
        Names the file and the command that makes it again.
    """
    import xarray as xr  # half a second to import, which samplers should not pay

    path = Path(path)
    try:
        with xr.open_dataset(path, engine="netcdf4", decode_cf=False) as dataset:
            content = dataset.load()
        variables = {name: (v.dims, v.values, v.attrs) for name, v in content.variables.items()}
        kept = content.attrs.pop("checksum")
        if kept != _checksum(variables, content.attrs):
            raise ValueError("the checksum does not fit the content")
        for name in ("settings", "published"):
            if name in content.attrs or name == "settings":
                content.attrs[name] = json.loads(content.attrs[name])
    except (OSError, KeyError, ValueError, RuntimeError, AttributeError) as error:
        hint = f"remove it and run snakemake again to rebuild it ({type(error).__name__})"
        raise StoreError(f"{path}: not a readable result file; {hint}") from error
    return content


def read_sample(path, case):
    """Return the samples of a case, refused if drawn with other settings or by other code.

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
    if content.attrs["code"] != sources.code(case.roots):
        raise StoreError(f"{path}: drawn by other code; run snakemake to draw it again")
    return content


def read_dataset(path, item):
    """Return the dataset of an item, refused if it is another's.

    Raises
    ------
    StoreError
        Names the file and the item that it holds.
    """
    content = read(path)
    if content.attrs.get("item", item) != item:
        raise StoreError(
            f"{path}: holds {content.attrs['item']}, not {item}; remove it and run snakemake again"
        )
    return content


def read_variables(path, case):
    """Return the samples of a case as `write` was given them: xarray changes their order.

    Raises
    ------
    StoreError
        As `read_sample`.
    """
    content = read_sample(path, case)
    with netCDF4.Dataset(path) as file:
        names = list(file.variables)
    return {name: (content[name].dims, content[name].values, content[name].attrs) for name in names}


def described(values, dims, long_name, units="1"):
    """Return (dims, values, attributes), a variable with the attributes that every one has."""
    return dims, np.asarray(values), {"long_name": long_name, "units": units}
