"""The tape: replays of histories that are written by hand, and what is kept between batches."""

import numpy as np
import pytest

from kacsim.kac import bird, model, nanbu_sequential, nanbu_synchronous, tape
from kacsim.streams import new_stream

# (pair, share, step) of the collisions of two draws, the latest of each first. The first draw has
# the slots 0 to 3, the second one 4 and 5.
EVENTS = [
    (0, 1, 0.3, 2),
    (1, 2, 0.6, 2),
    (0, 2, 0.9, 1),
    (2, 3, 0.2, 1),
    (4, 5, 0.7, 1),
    (5, 4, 0.1, 1),
]
ENERGY = [0.3, 1.7, 2.9, 1e-8, 41.0, 5.0]


@pytest.fixture
def written():
    """Return a tape with those collisions, and the state before them."""
    found, state = tape.new_tape(64), tape.new_state(model, 64)
    for k, (i, j, part, step) in enumerate(EVENTS):
        found.first[k], found.second[k], state.part[k], found.mark[k] = i, j, part, step
    state.energy[: len(ENERGY)] = ENERGY
    return found, state


def test_both_of_a_pair_share_their_energy(written):
    x = list(ENERGY)
    for i, j, part, _ in reversed(EVENTS):
        total = x[i] + x[j]
        x[i], x[j] = part * total, (1.0 - part) * total
    tape.in_pairs(model)(*written, len(EVENTS))
    np.testing.assert_allclose(written[1].energy[: len(x)], x, rtol=1e-15)
    np.testing.assert_allclose([sum(x[:4]), sum(x[4:])], [sum(ENERGY[:4]), sum(ENERGY[4:])])


def test_the_first_of_a_pair_changes_in_place(written):
    x = list(ENERGY)
    for i, j, part, _ in reversed(EVENTS):
        x[i] = (x[i] + x[j]) * part
    nanbu_sequential.in_place(model)(*written, len(EVENTS))
    np.testing.assert_array_equal(written[1].energy[: len(x)], x)


def test_a_step_is_replayed_at_its_old_level(written):
    """Slot 2 is read by two of a step that change, and the last step runs into the other draw's."""
    old = dict(enumerate(ENERGY))
    one = old | {0: 0.9 * (old[0] + old[2]), 2: 0.2 * (old[2] + old[3])}
    one |= {4: 0.7 * (old[4] + old[5]), 5: 0.1 * (old[5] + old[4])}
    two = one | {0: 0.3 * (one[0] + one[1]), 1: 0.6 * (one[1] + one[2])}
    nanbu_synchronous.at_old_level(model)(*written, len(EVENTS))
    np.testing.assert_array_equal(written[1].energy[: len(two)], list(two.values()))


def test_nothing_is_replayed_of_an_empty_tape(written):
    for of in (tape.in_pairs, nanbu_sequential.in_place, nanbu_synchronous.at_old_level):
        of(model)(*written, 0)
        np.testing.assert_array_equal(written[1].energy[: len(ENERGY)], ENERGY)


def test_a_tape_has_room_for_the_first_particles_too():
    """As many slots as collisions, and one more of each draw."""
    found, state = tape.new_tape(100), tape.new_state(model, 100)
    assert state.energy.size == 100 + tape.MOST_DRAWS
    assert len({array.ctypes.data for array in (*found, *state)}) == len(found) + len(state)


def test_draws_of_two_calls_follow_one_another(seed):
    """A call ends with a batch: 1024 draws in one call are those of two calls of 512."""
    arguments = bird.arguments(n_particles=50, time=0.3, collision_rate=0.9)
    (together, apart), own = np.empty((2, 2 * tape.MOST_DRAWS)), np.empty((2, 512), np.int64)
    streams = new_stream(seed, "calls"), new_stream(seed, "calls")
    bird.ancestral(together, own.ravel(), *arguments, streams[0])
    for half, counts in zip(np.split(apart, 2), own, strict=True):
        bird.ancestral(half, counts, *arguments, streams[1])
    np.testing.assert_array_equal(together, apart)
    np.testing.assert_array_equal(*streams)
