"""What a page needs beside its kernels: draws to compare with, and the sentences of checks.

The draws are those of the public functions, by the kernels of the run. A page repeats them before
it draws anything else.
"""

import base64
import hashlib
import math

import numpy as np

from kacsim import kac
from kacsim.boltzmann import mckean_tree
from kacsim.cases import make_case
from kacsim.kac import samplers
from kacsim.kac.constants import RATE
from kacsim.kac.equilibrium_samplers import RELATIVE_TOLERANCE
from kacsim.streams import new_stream
from kacsim.wasm.entries import MAX_NODES

N_DRAWS = 96
STEPS = 5
BKW_STREAM, PERFECT_STREAM = "boltzmann.estimate_bkw", "kac.draw_equilibrium"
# Of the page, where a reader waits for an answer.
MOST_CORNERS = 200
MOST_ANCESTORS = 20_000
LARGEST_SPEED = 20.0
LATEST = 6.0  # of the BKW mode, in mean collision times


def kac_stream(algorithm):
    """Return the name of the stream of `kac.draw`, ancestral."""
    return f"kac.draw {algorithm} ancestral"


def content():
    """Return all of it, ready for JSON."""
    names = [*map(kac_stream, samplers.ON_PAGE), BKW_STREAM, PERFECT_STREAM]
    return {
        "rate": RATE,
        "most_ancestors": MOST_ANCESTORS,
        "least_tolerance": RELATIVE_TOLERANCE,
        "algorithms": {name: samplers.TITLES[name] for name in samplers.ON_PAGE},
        "stepped": list(samplers.STEPPED),
        "streams": {name: name_words(name) for name in names},
        "checks": checks(),
        "sentences": sentences(),
    }


def name_words(name):
    """Return the words that a stream's name adds to the entropy of its state."""
    return np.frombuffer(hashlib.sha256(name.encode()).digest(), dtype="<u4").tolist()


def checks():
    """Return draws with what they were drawn by, those of every kernel."""
    found = [_kac(name, n, time) for name in samplers.ON_PAGE for n, time in PROCESSES]
    size = {"n_draws": N_DRAWS, "seed": 2**40 + 7}
    for given in ({"n_particles": 3, "tolerance": 1e-6}, {"n_particles": 10, "tolerance": 1e-3}):
        values, _ = kac.draw_equilibrium(**given, **size)
        found.append({"problem": "perfect", "given": given, **_drawn(values, size["seed"])})
    for speed, time in ((1.0, 2.0), (4.0, 3.0), (2.5, 0.3)):
        values, nodes = np.empty(N_DRAWS), np.empty(N_DRAWS, np.int64)
        kernel = mckean_tree.bkw_ancestral(
            speed, time, method="free_leaf", cut=0.0, max_nodes=MAX_NODES
        )
        kernel(values, nodes, new_stream(11, BKW_STREAM))
        given = {"speed": speed, "time": time}
        found.append({"problem": "bkw", "given": given, **_drawn(values, 11)})
    return found


PROCESSES = ((7, 1.7), (50, 2.0), (10**9, 4.0), (2, 0.6))


def _kac(algorithm, n, time):
    given = {"algorithm": algorithm, "n_particles": n, "time": time}
    own = {"time_step": time / STEPS} if algorithm in samplers.STEPPED else {}
    values = kac.draw(**given, **own, n_draws=N_DRAWS, seed=3)
    return {"problem": "kac", "given": given | own, **_drawn(values, 3)}


def _drawn(values, seed):
    return {"seed": str(seed), "values": base64.b64encode(values.astype("<f8").tobytes()).decode()}


def sentences():
    """Return problem -> field -> what it may be, and the sentence of the checks if it is not.

    A field has ``kind`` (whole or real), bounds that it may reach (``least``, ``most``) or not
    (``above``), and the sentences ``allowed`` and ``too_large``; what fields must be together
    stands under ``together``.
    """
    seed = {"kind": "whole", "least": 0, "allowed": _of(case_problems(seed=-1))}
    particles = {"kind": "whole", "least": 2, "most": samplers.LARGEST_ENSEMBLE["ancestral"]}
    particles["allowed"] = _of(case_problems(n_particles=1))
    particles["too_large"] = _of(case_problems(n_particles=10**15 + 1))
    moment = {"kind": "real", "above": 0, "allowed": _of(case_problems(time=0.0))}
    step = {
        "kind": "real",
        "above": 0,
        "allowed": _of(case_problems(algorithm="nanbu_synchronous", time_step=0.0)),
    }
    corners = particles | {"most": MOST_CORNERS, "too_large": f"must be at most {MOST_CORNERS}"}
    tolerance = {"kind": "real", "above": 0, "allowed": _of(equilibrium_problems(tolerance=0.0))}
    speed = {"kind": "real", "above": 0, "most": LARGEST_SPEED}
    speed["allowed"] = speed["too_large"] = f"must be a number above 0, up to {LARGEST_SPEED:g}"
    late = {"kind": "real", "least": 0, "most": LATEST}
    late["allowed"] = late["too_large"] = f"must be a number from 0 to {LATEST:g}"
    return {
        "kac": {"n_particles": particles, "time": moment, "time_step": step, "seed": seed},
        "perfect": {"n_particles": corners, "tolerance": tolerance, "seed": seed},
        "bkw": {"speed": speed, "time": late, "seed": seed},
        "together": _together(),
    }


def _together():
    """Return the sentences on several fields, with their values in braces."""
    time, step = 1234.5, 1000.25
    uneven, fast = samplers.step_problems("Nanbu", time, step, 1.0)
    given = {"n_particles": 3, "time": 1.0, "time_step": 1.0, "collision_rate": RATE}
    pairs = next(samplers.nanbu_babovsky(**given)).allowed
    few = _of(equilibrium_problems(tolerance=1e-15))
    return {
        "uneven": uneven.allowed.replace(repr(time), "{time}"),
        "fast": fast.allowed.partition(" (")[0],
        "pairs": pairs.replace("2 disjoint", "{pairs} disjoint").replace("of 3 ", "of {n} "),
        "tolerance": few.replace(f"{RELATIVE_TOLERANCE * math.sqrt(7.5):.1e}", "{least}"),
        "late": "must be earlier: about {n} ancestors, more than {most}",
    }


def case_problems(**changed):
    """Return the problems of a case of Kac's model with some values changed."""
    given = {
        "algorithm": "poisson",
        "n_particles": 5,
        "time": 1.0,
        "n_draws": 1,
        "seed": 1,
    } | changed
    return make_case("kac", n_replicates=1, **given).problems()


def equilibrium_problems(**changed):
    """Return the problems of a case of the perfect sampler with some values changed."""
    given = {"n_particles": 5, "tolerance": 1e-3} | changed
    return make_case("kac_equilibrium", n_draws=1, n_replicates=1, seed=1, **given).problems()


def _of(problems):
    return problems[0].allowed
