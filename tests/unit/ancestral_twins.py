"""Plain-Python twins of the ancestral kernels, written from the algorithms' descriptions.

A history keeps whole lists, walks through every trial and every step, and uses binomial
coefficients where the kernels skip, overwrite and multiply factors. They call the same variates,
one at a time, from the same stream, in the order of the tape: the histories of a batch of draws,
all energies, all angles, all signs.
"""

import itertools
import math

import variate_twins

from kacsim import variates as random
from kacsim.kac import tape


class FullError(Exception):
    """A history does not fit on the tape."""


class Room:
    """What is left on a tape of which the draws before have used so much."""

    def __init__(self, capacity, used):
        self.used, self.events, self.most = used, capacity - used, capacity // tape.EVENTS

    def must_hold(self, events, members):
        """Refuse collisions of one draw, or so many of its ancestors."""
        if events > self.events or members >= self.most:
            raise FullError(self.used)


class Trials:
    """Independent trials in a row; after a success the user asks for the next gap."""

    def __init__(self, probability, stream):
        self.probability, self.stream = probability, stream
        self.renew()

    def renew(self):
        self.left = failures(self.probability, self.stream) + 1

    def next(self):
        self.left -= 1
        return self.left == 0


def failures(probability, stream):
    """Return the trials before the next success."""
    scale = 0.0 if probability >= 1 else -1 / math.log1p(-probability)
    return int(random.failures_before_success(scale, stream))


def other_than(i, n, stream):
    """Return a uniform index below n that is not i."""
    return [k for k in range(n) if k != i][random.index_below(n - 1, stream)]


def touching(members, n, stream):
    """Return a uniform pair of n that touches the members 0, 1, ..., a new one being the next.

    Each of them can meet every other one, in one way as in the other, but for the pairs among
    them, which are met from both sides.
    """
    i, way = random.two_below(members, members - 1 + 2 * (n - members), stream)
    others = [k for k in range(members) if k != i]
    return i, others[way] if way < len(others) else members


def nanbu_sequential(n, steps, probability, stream, room):
    slots, lots = {0: 0}, []
    trials = Trials(probability, stream)
    for _ in range(steps):
        label = n
        while any(known < label for known in slots):
            label = max(known for known in slots if known < label)
            if trials.next():
                room.must_hold(len(lots) + 1, len(slots))
                partner = other_than(label, n, stream)
                slots.setdefault(partner, len(slots))
                lots.append([(slots[label], slots[partner])])
                trials.renew()
    return lots, len(slots)


def nanbu_synchronous(n, steps, probability, stream, room):
    members, history = 1, []
    trials = Trials(probability, stream)
    for _ in range(steps):
        events = []
        for i in range(members):
            if trials.next():
                room.must_hold(len(flat(history)) + len(events) + 1, 0)
                j = min(other_than(i, n, stream), members)
                members += j == members
                events.append((i, j))
                trials.renew()
        history.append(events)
    return history, members


def spared(members, n, pairs):
    """Return the chance that all of 2 * pairs particles come from the others."""
    return math.comb(n - members, 2 * pairs) / max(1, math.comb(n, 2 * pairs))


def matched(members, n, pairs, first, stream):
    """Return the pairs of a uniform matching that touch members, of which `first` is the lowest."""
    found, new = [], members
    waiting, outside = list(range(first + 1, members)), n - members
    i = first
    while True:
        place = random.index_below(len(waiting) + outside, stream)
        if place < len(waiting):
            found.append((i, waiting.pop(place)))
        else:
            found.append((i, new))
            new, outside = new + 1, outside - 1
        pairs -= 1
        aim, alive = random.uniform(stream), len(waiting) + outside
        alone = 0
        while alone < len(waiting) and spared(alone + 1, alive, pairs) > aim:
            alone += 1
        if alone == len(waiting):
            return found, new
        i, waiting = waiting[alone], waiting[alone + 1 :]


def nanbu_babovsky(n, steps, mean_pairs, stream, room):
    few = int(mean_pairs)
    chance_more = mean_pairs - few
    members, lots, left = 1, [], steps
    while True:
        touch_few = (1 - chance_more) * (1 - spared(members, n, few))
        touch_more = chance_more * (1 - spared(members, n, few + 1))
        left -= failures(touch_few + touch_more, stream) + 1
        if left < 0:
            return lots, members
        # As if every ancestor met a new one.
        room.must_hold(len(flat(lots)) + members, 2 * members if n >= room.most else 0)
        place = random.uniform(stream) * (touch_few + touch_more)
        more = place >= touch_few
        aim = (place - touch_few) / chance_more if more else place / (1 - chance_more)
        first = 0
        while first < members - 1 and 1 - spared(first + 1, n, few + more) <= aim:
            first += 1
        step, members = matched(members, n, few + more, first, stream)
        lots.append(step)


def bird(n, n_collisions, stream, room):
    members, lots, left = 1, [], n_collisions
    while True:
        room.must_hold(len(lots) + 1, members)
        untouched = math.comb(n - members, 2) / math.comb(n, 2)
        left -= failures(1 - untouched, stream) + 1
        if left < 0:
            return lots, members
        i, j = touching(members, n, stream)
        members += j == members
        lots.append([(i, j)])


def poisson(n, mean_own, pair_rate, stream, room):
    """Return a history; every pair collides at the rate 1 / (n - 1), whatever is given."""
    members, lots, left = 1, [], mean_own
    while True:
        room.must_hold(len(lots) + 1, members)
        rate = (members * (n - members) + math.comb(members, 2)) / (n - 1)
        left -= random.exponential(stream) / rate
        if left < 0:
            return lots, members
        i, j = touching(members, n, stream)
        members += j == members
        lots.append([(i, j)])


def poisson_printed(n, mean_own, pair_rate, stream, room):
    """Return a history; particle 0 collides at the rate 1, each pair of others at its own."""
    others, lots, left = 0, [], mean_own
    while True:
        rate = 1 + pair_rate * (math.comb(others, 2) + others * (n - 1 - others))
        left -= random.exponential(stream) / rate
        if left < 0:
            return lots, 1 + others
        room.must_hold(len(lots) + 1, 1 + others)
        if random.uniform(stream) * rate < 1:
            i, place = random.two_below(1, n - 1, stream)
            j = 1 + min(place, others)
        else:
            i, j = (1 + k for k in touching(others, n - 1, stream))
        others += j == 1 + others
        lots.append([(i, j)])


def flat(lots):
    return list(itertools.chain.from_iterable(lots))


class Line:
    """Kac's model: energies, and the share of one of a pair."""

    @staticmethod
    def starts(n, stream):
        return variate_twins.energies(n, stream)

    @staticmethod
    def inputs(n, stream):
        return [random.squared_cosine(stream) for _ in range(n)]

    @staticmethod
    def collided(a, b, share):
        return (a + b) * share, (a + b) * (1 - share)

    @staticmethod
    def value(energy, stream):
        return math.sqrt(energy) * random.random_sign(stream)


def together(law, states, lots, inputs):
    """Change both of each pair, earliest collision (the last event) first."""
    for (i, j), one in reversed(list(zip(flat(lots), inputs, strict=True))):
        states[i], states[j] = law.collided(states[i], states[j], one)


def one_after_another(law, states, lots, inputs):
    """Change the first of each pair."""
    for (i, j), one in reversed(list(zip(flat(lots), inputs, strict=True))):
        states[i] = law.collided(states[i], states[j], one)[0]


def at_once(law, states, lots, inputs):
    """Change the first of each pair, reading both at the old level of the step."""
    inputs = list(inputs)
    for events in reversed(lots):
        old = list(states)
        for i, j in reversed(events):
            states[i] = law.collided(old[i], old[j], inputs.pop())[0]


REPLAYS = {nanbu_sequential: one_after_another, nanbu_synchronous: at_once}


def histories(history, arguments, most, capacity, stream):
    """Return histories until the tape is half full or there are so many."""
    found, used = [], 0
    while len(found) < most and 2 * used <= capacity:
        room = Room(capacity, used)
        found.append(history(*arguments, stream, room))
        used += len(flat(found[-1][0]))
    return found


def draws(history, arguments, n_draws, stream, law=Line):
    """Return [(v_1, own collisions, collisions)] and [(capacity, used)] of tapes too small.

    A batch of which one history does not fit is drawn again, from its beginning.
    """
    rows, capacity, refused = [], tape.LEAST, []
    replay = REPLAYS.get(history, together)
    while len(rows) < n_draws:
        before, most = stream.copy(), min(tape.MOST_DRAWS, n_draws - len(rows))
        try:
            batch = histories(history, arguments, most, capacity, stream)
        except FullError as full:
            refused.append((capacity, *full.args))
            stream[:] = before
            capacity *= 2
            continue
        states = iter(law.starts(sum(members for _, members in batch), stream))
        pairs = [flat(lots) for lots, _ in batch]
        inputs = iter(law.inputs(sum(map(len, pairs)), stream))
        for (lots, members), events in zip(batch, pairs, strict=True):
            own = [next(states) for _ in range(members)]
            replay(law, own, lots, [next(inputs) for _ in events])
            v = law.value(own[0], stream)
            changed = [pair if replay is together else pair[:1] for pair in events]
            rows.append((v, sum(0 in particles for particles in changed), len(events)))
    return rows, refused
