"""Long cases are drawn in shards, ranges of replicates with a job each, and merged.

A stream belongs to a replicate of a case, whichever job draws it: the merged file has the bytes
of a file drawn in one go.
"""

import math
from pathlib import Path

from kacsim.kernels.lookup import named


def make_shards(cases, shard_seconds):
    """Return the shards of the cases that take longer than a time.

    Parameters
    ----------
    cases : of Case
    shard_seconds : float, expected time in the kernels of a shard at most; 0 never shards

    Returns
    -------
    dict case id -> list of Case, at least two shards, at most one for each replicate
    """
    parts = {}
    for case in cases:
        wanted = math.ceil(case.seconds() / shard_seconds) if shard_seconds else 1
        number = min(wanted, case.n_replicates)
        if number > 1 and case.sampler.by_replicate:
            parts[case.id] = case.split(number)
    return parts


def merged(parts, folder="results/shards"):
    """Return the variables of a case from the files of its shards.

    What has a dimension ``replicate`` is joined along it, first values are cut at their number,
    largest values are ranked anew. One shard at a time is in memory beside the result.

    Parameters
    ----------
    parts : list of Case, all shards of one case
    folder : where their files lie

    Returns
    -------
    dict name -> variable of `kacsim.store.described`

    Raises
    ------
    StoreError
        Names the file that is missing, or belongs to another case or shard.
    """
    import numpy as np  # none of this for the plan, which Snakemake reads at every start

    from kacsim import store
    from kacsim.boltzmann.sampling import TOP, descending

    most = named(f"kacsim.{parts[0].sampler.family}", "sampling", "KEPT")

    found = {}
    for part in parts:
        content = store.read_variables(Path(folder) / Path(part.output()).name, part)
        for name, (dims, values, attributes) in content.items():
            known = found[name][1] if name in found else None
            if "replicate" in dims:
                axis = dims.index("replicate")
                if known is None:
                    shape = list(values.shape)
                    shape[axis] = part.n_replicates
                    known = np.empty(shape, values.dtype)
                np.moveaxis(known, axis, 0)[part.replicates] = np.moveaxis(values, axis, 0)
                values = known
            elif known is not None and dims[0] in ("kept", "draw"):
                values = np.concatenate([known, values[: max(0, most - len(known))]])
            elif known is not None and "rank" in dims:
                values = descending(np.concatenate([known, values], axis=-1))[..., :TOP].copy()
            found[name] = dims, values, attributes
    return found
