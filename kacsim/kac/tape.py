"""Ancestral draws: histories of several draws on one tape, then all their collisions at once.

An algorithm says how the collisions that touch particle 1's ancestors are found, going back from t:
its `history` writes the pairs of one draw on the tape. What follows is the same for all: states
at time 0 for the ancestors of every draw on the tape, what each collision needs (by the law of
collisions, `kacsim.kac.model` or another one), and the replay, each in one long loop that does not
stop between draws.
"""

import functools
from typing import NamedTuple

import numpy as np

from kacsim.kernels.jit import inlined, kernel
from kacsim.streams import copy_state

LEAST = 4096
MOST_DRAWS = 512
EVENTS = 16  # on the tape for each ancestor of one draw


class Tape(NamedTuple):
    """Histories, one draw's after another's.

    Attributes
    ----------
    first, second : uint64[capacity], slots of the colliding pair, a draw's latest collision first
    mark : int64[capacity], what else an algorithm notes of it
    root : uint64[MOST_DRAWS], slot of particle 1 of each draw
    """

    first: object
    second: object
    mark: object
    root: object


def new_tape(capacity):
    """Return an empty tape."""
    slots = np.empty((2, capacity), np.uint64)
    return Tape(*slots, np.empty(capacity, np.int64), np.empty(MOST_DRAWS, np.uint64))


def new_state(law, capacity, tables=()):
    """Return the state of a law for a tape: as many slots as collisions, and one of each draw."""
    return law.new_state(capacity, capacity + MOST_DRAWS, *tables)


def in_pairs(law):
    """Return the replay of collisions that change both of a pair, in order.

    Parameters
    ----------
    law : module of the law of collisions, such as `kacsim.kac.model`

    Returns
    -------
    kernel (tape, state, n_events), turns states at time 0 into those at time t
    """
    share = law.share

    @inlined
    def replay(tape, state, n_events):
        for event in range(n_events - 1, -1, -1):
            share(state, tape.first[event], tape.second[event], event)

    return replay


def ancestral_draws(law, prepare, history, replay_of=in_pairs):
    """Return an algorithm's ancestral kernel.

    Parameters
    ----------
    law : module of the law of collisions
    prepare : kernel (arguments, most) -> what all histories of one call share, for fewer than
        `most` ancestors
    history : kernel (arguments, prepared, tape, start, root, stream) -> (events, ancestors, own).
        Writes one draw's collisions on the tape from place `start` on, its ancestors having the
        slots from `root` on; `events` is the place after them, or -1 if they, or
        so many ancestors, do not fit, `own` the number of collisions of particle 1.
    replay_of : function of the law, as `in_pairs`

    Returns
    -------
    function (velocities, own, *arguments, stream, tables=()) -> int, collisions simulated, as a
    forward kernel; tables : what the law of collisions draws from, if it has tables
    """
    fill, read, replay = law.fill, law.read, replay_of(law)

    @inlined
    def play(tape, state, velocities, n_events, n_slots, stream):
        fill(state, n_events, n_slots, stream)
        replay(tape, state, n_events)
        for draw in range(len(velocities)):
            read(velocities, draw, state, tape.root[draw], stream)

    @kernel
    def attempt(velocities, own, arguments, stream, tape, state):
        """Draw until a history does not fit on the tape; return (draws, collisions simulated)."""
        prepared = prepare(arguments, tape.first.size // EVENTS)
        before = stream.copy()
        draw, simulated = 0, 0
        while draw < len(velocities):
            copy_state(stream, before)
            begun, events, root = draw, 0, 0
            last = min(draw + MOST_DRAWS, len(velocities))
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
            play(tape, state, velocities[begun:draw], events, root, stream)
            simulated += events
        return draw, simulated

    @functools.wraps(attempt)
    def ancestral(velocities, own, *arguments, tables=()):
        done, simulated, capacity = 0, 0, LEAST
        while done < len(velocities):
            tape, state = new_tape(capacity), new_state(law, capacity, tables)
            rest = velocities[done:], own[done:]
            more, collisions = attempt(*rest, arguments[:-1], arguments[-1], tape, state)
            done += more
            simulated += collisions
            capacity *= 2
        return simulated

    return ancestral
