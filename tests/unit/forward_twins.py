"""Plain-Python twins of the kernels that draw whole ensembles, from the algorithms' descriptions.

Each yields (v_1, own collisions, collisions simulated) without end. They call the same variates,
one at a time, from the same stream, so that a kernel must give the same values; they walk through
every trial and keep whole lists.
"""

import math

from ancestral_twins import Trials, other_than

from kacsim import variates as random


class Line:
    """Kac's model."""

    @staticmethod
    def start(stream):
        return random.maxwell_speed(stream) * random.random_sign(stream)

    @staticmethod
    def collided(a, b, stream):
        """Return what both of a pair have after a collision."""
        cos, sin = random.unit_circle(stream)
        return a * cos + b * sin, b * cos - a * sin


def ensemble(law, n, stream):
    return [law.start(stream) for _ in range(n)]


def collide(law, v, i, j, stream):
    v[i], v[j] = law.collided(v[i], v[j], stream)


def nanbu(n, steps, probability, stream, law=Line, *, synchronous):
    while True:
        v, own, simulated = ensemble(law, n, stream), 0, 0
        trials = Trials(probability, stream)
        for _ in range(steps):
            read = list(v) if synchronous else v
            for i in range(n):
                if trials.next():
                    j = other_than(i, n, stream)
                    v[i] = law.collided(read[i], read[j], stream)[0]
                    own, simulated = own + (i == 0), simulated + 1
                    trials.renew()
        yield v[0], own, simulated


def nanbu_babovsky(n, steps, mean_pairs, stream, law=Line):
    order = list(range(n))
    while True:
        v, own, simulated = ensemble(law, n, stream), 0, 0
        for _ in range(steps):
            whole = int(mean_pairs)
            pairs = whole + (random.uniform(stream) < mean_pairs - whole)
            for k in range(2 * pairs):
                chosen = k + random.index_below(n - k, stream)
                order[k], order[chosen] = order[chosen], order[k]
            for i, j in zip(order[: 2 * pairs : 2], order[1 : 2 * pairs : 2], strict=True):
                collide(law, v, i, j, stream)
                own += 0 in (i, j)
            simulated += pairs
        yield v[0], own, simulated


def bird(n, n_collisions, stream, law=Line):
    while True:
        v, own = ensemble(law, n, stream), 0
        for _ in range(n_collisions):
            i, j = random.pair_below(n, stream)
            collide(law, v, i, j, stream)
            own += 0 in (i, j)
        yield v[0], own, n_collisions


def poisson(n, mean_own, pair_rate, stream, law=Line):
    while True:
        v, times, simulated = ensemble(law, n, stream), [random.exponential(stream)], 0
        while times[-1] < mean_own:
            times.append(times[-1] + random.exponential(stream))
        own, span = len(times) - 1, mean_own
        for k in range(own, 0, -1):
            gap = span * (1 - math.exp(-random.exponential(stream) / k))
            span -= gap
            budget = pair_rate * math.comb(n - 1, 2) * gap - random.exponential(stream)
            while budget > 0:
                i, j = random.pair_below(n - 1, stream)
                collide(law, v, i + 1, j + 1, stream)
                simulated += 1
                budget -= random.exponential(stream)
            collide(law, v, 0, 1 + random.index_below(n - 1, stream), stream)
        yield v[0], own, simulated + own
