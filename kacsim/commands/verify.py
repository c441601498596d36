"""Draw cases again and compare bits with those kept."""

import random
from pathlib import Path

from kacsim import plan
from kacsim.commands import _shared, sample
from kacsim.samplers import whole

EXAMPLE = "verify --cases 10"
OF_A_CLONE = True
FAILED = 1  # exit status where bits differ

EQUAL, MISSING, DIFFERENT = "equal", "missing", "different"


def add(parser):
    """Add the options."""
    _shared.add_config(parser)
    _shared.add_item(parser)
    parser.add_argument("--cases", type=whole, default=5, help="how many, at random (default 5)")
    parser.add_argument("--choice", type=whole, default=0, help="seed of the choice (default 0)")
    parser.add_argument("--samples", default="results/samples", metavar="FOLDER")


def run(arguments):
    """Draw cases again; return 1 if bits differ from those kept, else 0."""
    if not (isinstance(arguments.cases, int) and arguments.cases >= 1):
        raise plan.PlanError(f"--cases = {arguments.cases!r}: must be an integer, at least 1")
    wrong = 0
    for case in choose(_shared.planned(arguments)[1], arguments.cases, arguments.choice):
        with sample.progress(case) as advance:
            state, sentence = verify(case, arguments.samples, advance)
        print(sentence)
        wrong += state != EQUAL
    return FAILED if wrong else 0


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
    from kacsim import files, store
    from kacsim.jobs import sampling

    path = Path(folder) / f"{case.id}.nc"
    if not path.exists():
        return MISSING, f"{path}: not there; drawn with another --config, or not yet by snakemake"
    try:
        kept = store.read_sample(path, case)
    except files.StoreError as error:
        return DIFFERENT, str(error)
    drawn = sampling.run(case, progress)
    wrong = [name for name in kept.variables if name not in drawn]
    for name, (_, values, _) in drawn.items():
        if name not in kept.variables or not _same_bits(kept[name].values, values):
            wrong.append(name)
    if wrong:
        sentence = f"{path}: differs in {', '.join(sorted(wrong))}; remove it and run snakemake"
        return DIFFERENT, f"{sentence} again"
    return EQUAL, f"{path}: the same bits"


def _same_bits(kept, drawn):
    import numpy as np

    kept, drawn = np.asarray(kept), np.asarray(drawn)
    same_kind = kept.shape == drawn.shape and kept.dtype == drawn.dtype
    return same_kind and kept.tobytes() == drawn.tobytes()
