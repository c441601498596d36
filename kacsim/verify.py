"""Draw cases again and compare bits with what lies in the results folder."""

import random
from pathlib import Path

import numpy as np

from kacsim import sampling, store

EQUAL, MISSING, DIFFERENT = "equal", "missing", "different"


def choose(cases, n_cases, choice):
    """Return cases picked at random, without repetition.

    Parameters
    ----------
    cases : list of Case
    n_cases : int, all if there are fewer
    choice : int, seed of the choice; has nothing to do with the seeds of the draws
    """
    return random.Random(choice).sample(cases, min(n_cases, len(cases)))


def verify(case, folder, progress=None):
    """Return (EQUAL, MISSING or DIFFERENT, one sentence) for one case.

    Parameters
    ----------
    case : Case
    folder : where the samples lie
    progress : callable(draws done)
    """
    path = Path(folder) / f"{case.id}.nc"
    if not path.exists():
        return MISSING, f"{path}: not there; drawn with another --config, or not yet by snakemake"
    try:
        kept = store.read_sample(path, case)
    except store.StoreError as error:
        return DIFFERENT, str(error)
    drawn = sampling.run(case, progress or (lambda done: None))
    wrong = [name for name in kept.variables if name not in drawn]
    for name, (_, values, _) in drawn.items():
        if name not in kept.variables or not _same_bits(kept[name].values, values):
            wrong.append(name)
    if wrong:
        sentence = f"{path}: differs in {', '.join(sorted(wrong))}; remove it and run snakemake"
        return DIFFERENT, f"{sentence} again"
    return EQUAL, f"{path}: the same bits"


def _same_bits(kept, drawn):
    kept, drawn = np.asarray(kept), np.asarray(drawn)
    same_kind = kept.shape == drawn.shape and kept.dtype == drawn.dtype
    return same_kind and kept.tobytes() == drawn.tobytes()
