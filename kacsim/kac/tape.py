"""Ancestral draws: histories of several draws on one tape, then all their energies at once.

An algorithm says how the collisions that touch particle 1's ancestors are found, going back from t:
its `history` writes the pairs of one draw on the tape. What follows is the same for all: energies
at time 0 for the ancestors of every draw on the tape, an angle for every collision, and the replay,
each in one long loop that does not stop between draws.
"""

import functools
from typing import NamedTuple

import numpy as np

from kacsim.kac.model import signed_root
from kacsim.kernels.jit import inlined, kernel
from kacsim.streams import BLOCK, copy_state
from kacsim.variates import maxwell_energies, squared_cosines

LEAST = 4096
MOST_DRAWS = 512
EVENTS = 16  # on the tape for each ancestor of one draw


class Tape(NamedTuple):
    """Histories, one draw's after another's.

    Attributes
    ----------
    first, second : uint64[capacity], slots of the colliding pair, a draw's latest collision first
    mark : int64[capacity], what else an algorithm notes of it
    part : float64[capacity], cos(theta)**2 of each collision
    energy : float64[capacity + MOST_DRAWS], of the ancestor in each slot
    root : uint64[MOST_DRAWS], slot of particle 1 of each draw
    new, missed : float64[capacity], uint64[BLOCK], workspace
    """

    first: object
    second: object
    mark: object
    part: object
    energy: object
    root: object
    new: object
    missed: object


def new_tape(capacity):
    """Return an empty tape."""
    slots = np.empty((2, capacity), np.uint64)
    mark, real = np.empty(capacity, np.int64), np.empty((2, capacity))
    energy, root = np.empty(capacity + MOST_DRAWS), np.empty(MOST_DRAWS, np.uint64)
    return Tape(*slots, mark, real[0], energy, root, real[1], np.empty(BLOCK, np.uint64))


@inlined
def share(tape, n_events):
    """Replay collisions that share the pair's energy as a rotation by a uniform angle does.

    A uniform rotation makes v_i**2 = (v_i**2 + v_j**2) cos(theta)**2 with theta uniform, and both
    signs uniform and independent of all energies; the sign of v_1 is drawn once, at the end.
    """
    for event in range(n_events - 1, -1, -1):
        i, j = tape.first[event], tape.second[event]
        total = tape.energy[i] + tape.energy[j]
        tape.energy[i] = total * tape.part[event]
        tape.energy[j] = total - tape.energy[i]


def ancestral_draws(prepare, history, replay=share):
    """Return an algorithm's ancestral kernel.

    Parameters
    ----------
    prepare : kernel (arguments, most) -> what all histories of one call share, for fewer than
        `most` ancestors
    history : kernel (arguments, prepared, tape, start, root, stream) -> (events, ancestors, own).
        Writes one draw's collisions on the tape from place `start` on, its ancestors having the
        slots from `root` on; `events` is the place after them, or -1 if they, or
        so many ancestors, do not fit, `own` the number of collisions of particle 1.
    replay : kernel (tape, n_events), turns energies at time 0 into those at time t

    Returns
    -------
    function (velocities, own, *arguments, stream) -> int, collisions simulated, as a forward kernel
    """

    @inlined
    def play(tape, velocities, n_events, n_slots, stream):
        maxwell_energies(tape.energy, tape.missed, n_slots, stream)
        squared_cosines(tape.part, n_events, stream)
        replay(tape, n_events)
        for draw in range(velocities.size):
            velocities[draw] = signed_root(tape.energy[tape.root[draw]], stream)

    @kernel
    def attempt(velocities, own, arguments, stream, tape):
        """Draw until a history does not fit on the tape; return (draws, collisions simulated)."""
        prepared = prepare(arguments, tape.first.size // EVENTS)
        before = stream.copy()
        draw, simulated = 0, 0
        while draw < velocities.size:
            copy_state(stream, before)
            begun, events, root = draw, 0, 0
            last = min(draw + MOST_DRAWS, velocities.size)
            while draw < last and 2 * events <= tape.first.size:
                tape.root[draw - begun] = root
                events, ancestors, own[draw] = history(
                    arguments, prepared, tape, events, root, stream
                )
                if events < 0:
                    copy_state(before, stream)
                    return begun, simulated
                root += ancestors
                draw += 1
            play(tape, velocities[begun:draw], events, root, stream)
            simulated += events
        return draw, simulated

    @functools.wraps(attempt)
    def ancestral(velocities, own, *arguments):
        done, simulated, capacity = 0, 0, LEAST
        while done < velocities.size:
            tape, rest = new_tape(capacity), (velocities[done:], own[done:])
            more, collisions = attempt(*rest, arguments[:-1], arguments[-1], tape)
            done += more
            simulated += collisions
            capacity *= 2
        return simulated

    return ancestral
