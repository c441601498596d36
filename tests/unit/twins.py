"""Plain-Python twins of every kernel, written from the algorithms' descriptions.

Each yields (v_1, own collisions, collisions simulated) without end. They call the same variates,
one at a time, from the same stream, so that a kernel must give the same values; they keep whole
lists, walk through every trial and every step, and use binomial coefficients where the kernels
skip, overwrite and multiply factors.
"""

import math

from kacsim import variates as random


def initial(n, stream):
    """Return n squared velocities under f0, Exp + Z**2 / 2; the normal variate comes first."""
    energies = []
    for _ in range(n):
        normal = random.half_normal(stream)
        energies.append(random.exponential(stream) + normal**2 / 2)
    return energies


def ensemble(n, stream):
    return [signed(initial(1, stream)[0], stream) for _ in range(n)]


def signed(energy, stream):
    return math.sqrt(energy) * random.random_sign(stream)


def rotate(v, i, j, stream):
    cos, sin = random.unit_circle(stream)
    v[i], v[j] = v[i] * cos + v[j] * sin, v[j] * cos - v[i] * sin


def other_than(i, n, stream):
    """Return a uniform index below n that is not i."""
    return [k for k in range(n) if k != i][random.index_below(n - 1, stream)]


def replay(events, n_ancestors, stream, *, both):
    """Share energies, earliest collision (the last event) first; `both` partners are changed."""
    energies = initial(n_ancestors, stream)
    for i, j in reversed(events):
        total = energies[i] + energies[j]
        energies[i] = total * random.squared_cosine(stream)
        if both:
            energies[j] = total - energies[i]
    return signed(energies[0], stream)


def failures(probability, stream):
    """Return the trials before the next success."""
    scale = 0.0 if probability >= 1 else -1 / math.log1p(-probability)
    return int(random.failures_before_success(scale, stream))


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


def nanbu_forward(n, steps, probability, stream, *, synchronous):
    while True:
        v, own, simulated = ensemble(n, stream), 0, 0
        trials = Trials(probability, stream)
        for _ in range(steps):
            read = list(v) if synchronous else v
            for i in range(n):
                if trials.next():
                    j = other_than(i, n, stream)
                    cos, sin = random.unit_circle(stream)
                    v[i] = read[i] * cos + read[j] * sin
                    own, simulated = own + (i == 0), simulated + 1
                    trials.renew()
        yield v[0], own, simulated


def nanbu_sequential_ancestral(n, steps, probability, stream):
    while True:
        slots, events, own = {0: 0}, [], 0
        trials = Trials(probability, stream)
        for _ in range(steps):
            label = n
            while any(known < label for known in slots):
                label = max(known for known in slots if known < label)
                if trials.next():
                    partner = other_than(label, n, stream)
                    slots.setdefault(partner, len(slots))
                    events.append((slots[label], slots[partner]))
                    own += label == 0
                    trials.renew()
        yield replay(events, len(slots), stream, both=False), own, len(events)


def nanbu_synchronous_ancestral(n, steps, probability, stream):
    while True:
        members, history, own = 1, [], 0
        trials = Trials(probability, stream)
        for _ in range(steps):
            events = []
            for i in range(members):
                if trials.next():
                    known = random.uniform(stream) * (n - 1) < members - 1
                    j = other_than(i, members, stream) if known else members
                    members += not known
                    events.append((i, j))
                    own += i == 0
                    trials.renew()
            history.append(events)
        energies = initial(members, stream)
        for events in reversed(history):
            old = list(energies)
            for i, j in reversed(events):
                energies[i] = (old[i] + old[j]) * random.squared_cosine(stream)
        yield signed(energies[0], stream), own, sum(map(len, history))


def nanbu_babovsky_forward(n, steps, mean_pairs, stream):
    order = list(range(n))
    while True:
        v, own, simulated = ensemble(n, stream), 0, 0
        for _ in range(steps):
            whole = int(mean_pairs)
            pairs = whole + (random.uniform(stream) < mean_pairs - whole)
            for k in range(2 * pairs):
                chosen = k + random.index_below(n - k, stream)
                order[k], order[chosen] = order[chosen], order[k]
            for i, j in zip(order[: 2 * pairs : 2], order[1 : 2 * pairs : 2], strict=True):
                rotate(v, i, j, stream)
                own += 0 in (i, j)
            simulated += pairs
        yield v[0], own, simulated


def spared(members, n, pairs):
    """Return the chance that all of 2 * pairs particles come from the others."""
    return math.comb(n - members, 2 * pairs) / max(1, math.comb(n, 2 * pairs))


def matched(members, n, pairs, stream):
    """Yield the pairs of a uniform matching that touch the members 0, 1, ..., at least one."""
    aim, first = random.uniform(stream) * (1 - spared(members, n, pairs)), 0
    while first < members - 1 and 1 - spared(first + 1, n, pairs) <= aim:
        first += 1
    waiting, outside, new, certain = list(range(first, members)), n - members, members, True
    while waiting:
        i = waiting.pop(0)
        alive = 1 + len(waiting) + outside
        if certain or random.uniform(stream) * alive < 2 * pairs:
            if random.uniform(stream) * (alive - 1) < len(waiting):
                yield i, waiting.pop(random.index_below(len(waiting), stream))
            else:
                yield i, new
                new, outside = new + 1, outside - 1
            pairs -= 1
        certain = False


def nanbu_babovsky_ancestral(n, steps, mean_pairs, stream):
    few = int(mean_pairs)
    chance_more = mean_pairs - few
    while True:
        members, events, own, left = 1, [], 0, steps
        while True:
            touch_few = (1 - chance_more) * (1 - spared(members, n, few))
            touch_more = chance_more * (1 - spared(members, n, few + 1))
            left -= failures(touch_few + touch_more, stream) + 1
            if left < 0:
                break
            more = random.uniform(stream) * (touch_few + touch_more) >= touch_few
            step = list(matched(members, n, few + more, stream))
            members = max(members, *(j + 1 for _, j in step))
            own += sum(0 in pair for pair in step)
            events += step
        yield replay(events, members, stream, both=True), own, len(events)


def bird_forward(n, n_collisions, stream):
    while True:
        v, own = ensemble(n, stream), 0
        for _ in range(n_collisions):
            i, j = random.pair_below(n, stream)
            rotate(v, i, j, stream)
            own += 0 in (i, j)
        yield v[0], own, n_collisions


def bird_ancestral(n, n_collisions, stream):
    while True:
        members, events, own, left = 1, [], 0, n_collisions
        while True:
            untouched = math.comb(n - members, 2) / math.comb(n, 2)
            left -= failures(1 - untouched, stream) + 1
            if left < 0:
                break
            i = random.index_below(members, stream)
            # Ordered pairs that begin at i: each outer pair counts twice, as both its orders do.
            inner, outer = members - 1, 2 * (n - members)
            known = random.uniform(stream) * (inner + outer) < inner
            j = other_than(i, members, stream) if known else members
            members += not known
            events.append((i, j))
            own += 0 in (i, j)
        yield replay(events, members, stream, both=True), own, len(events)


def poisson_forward(n, mean_own, pair_rate, stream):
    while True:
        v, times, simulated = ensemble(n, stream), [random.exponential(stream)], 0
        while times[-1] < mean_own:
            times.append(times[-1] + random.exponential(stream))
        own, span = len(times) - 1, mean_own
        for k in range(own, 0, -1):
            gap = span * (1 - math.exp(-random.exponential(stream) / k))
            span -= gap
            budget = pair_rate * math.comb(n - 1, 2) * gap - random.exponential(stream)
            while budget > 0:
                i, j = random.pair_below(n - 1, stream)
                rotate(v, i + 1, j + 1, stream)
                simulated += 1
                budget -= random.exponential(stream)
            rotate(v, 0, 1 + random.index_below(n - 1, stream), stream)
        yield v[0], own, simulated + own


def poisson_ancestral(n, mean_own, pair_rate, stream):
    """Yield draws; n = 0 means infinitely many particles, each colliding at rate 1."""
    while True:
        others, events, own, left = 0, [], 0, mean_own
        while True:
            among = pair_rate * math.comb(others, 2)
            outward = float(others) if n == 0 else pair_rate * others * (n - 1 - others)
            total = 1 + among + outward
            left -= random.exponential(stream) / total
            if left < 0:
                break
            if random.uniform(stream) * total < 1:
                i, own = 0, own + 1
                known = random.uniform(stream) < (others / (n - 1) if n else 0)
                j = 1 + random.index_below(others, stream)
            else:
                i = 1 + random.index_below(others, stream)
                known = random.uniform(stream) * (among + outward) < among
                rest = [k for k in range(1, others + 1) if k != i]
                place = random.index_below(others - 1, stream)
                j = rest[place] if known else None
            others += not known
            events.append((i, j if known else others))
        yield replay(events, others + 1, stream, both=True), own, len(events)


def couple(n, energy, tolerance, stream):
    """Return (abs(v_1), coupling time) of the first draw: D looked at after every step."""
    columns = [[float(i == k) for i in range(n)] for k in range(n)]  # images of the corners
    steps, goal = 0, tolerance**2 / energy
    while True:
        p, q = random.pair_below(n, stream)
        share = random.squared_cosine(stream)
        merged = [share * a + (1 - share) * b for a, b in zip(columns[p], columns[q], strict=True)]
        columns[p] = columns[q] = merged
        steps += 1
        images = [[math.sqrt(x) for x in column] for column in columns]
        if not any(
            sum((a - b) ** 2 for a, b in zip(images[i], images[j], strict=True)) >= goal
            for i in range(n)
            for j in range(i)
        ):
            return math.sqrt(energy) * sum(image[0] for image in images) / n, steps


def gap(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b, strict=True)))


def stopping_times(n, walk, tolerances, stream):
    """Yield rule -> stopping times at the tolerances, every rule looked at after every step."""
    pick = {
        "printed": lambda: random.pair_below(n, stream),
        "replacement": lambda: (random.index_below(n, stream), random.index_below(n, stream)),
        "with_first": lambda: (0, 1 + random.index_below(n - 1, stream)),
    }
    split = {
        "half": lambda: 0.5,
        "uniform_share": lambda: random.uniform(stream),
        "uniform_sine": lambda: random.uniform(stream) ** 2,
    }
    while True:
        columns = [[float(i == k) for i in range(n)] for k in range(n)]  # images of the corners
        times, mean, step = {}, [1 / n] * n, 0
        while not times or min(map(len, times.values())) < len(tolerances):
            p, q = pick.get(walk, pick["printed"])()
            share = split.get(walk, lambda: random.squared_cosine(stream))()
            merged = [share * a + (1 - share) * b for a, b in zip(columns[p], columns[q], strict=1)]
            columns[p] = columns[q] = merged
            step += 1
            points = [[math.sqrt(x) for x in column] for column in columns]
            pairs = [(i, j) for i in range(n) for j in range(i)]
            gaps = [gap(points[i], points[j]) for i, j in pairs]
            ranges = [max(x) - min(x) for x in zip(*points, strict=True)]
            before, mean = mean, [sum(x) / n for x in zip(*points, strict=True)]
            seen = {
                "largest": max(gaps),
                "consecutive": max(gap(points[i], points[i + 1]) for i in range(n - 1)),
                "first_two": gap(points[0], points[1]),
                "mean_square": math.sqrt(sum(x * x for x in gaps) / len(gaps)),
                "coordinate": max(ranges),
                "first_coordinate": ranges[0],
                "energies": max(gap(columns[i], columns[j]) for i, j in pairs),
                "settled": gap(mean, before),
            }
            for rule, value in seen.items():
                known = times.setdefault(rule, [])
                while len(known) < len(tolerances) and value < tolerances[len(known)]:
                    known.append(step)
        yield times


def couple_both_ways(n, energy, tolerance, stream):
    """Yield (corner from the past, forward corner, times, errors): products of matrices anew.

    The inputs come in lots of 256, of which a draw leaves the rest unused.
    """

    def product(steps):
        """Return the images of the corners (rows) after steps in the order of time."""
        rows = [[energy * float(i == k) for k in range(n)] for i in range(n)]
        for p, q, share in steps:
            for row in rows:
                total = row[p] + row[q]
                row[p], row[q] = share * total, (1 - share) * total
        return [[math.sqrt(x) for x in row] for row in rows]

    def width(points):
        return max(gap(points[i], points[j]) for i in range(n) for j in range(i))

    def centre(points):
        return [sum(x) / n for x in zip(*points, strict=True)]

    while True:
        inputs = []

        def first(number, inputs=inputs):
            """Return so many first inputs, drawn if need be."""
            while len(inputs) < number:
                for _ in range(256):
                    pair = random.pair_below(n, stream)
                    inputs.append((*pair, random.squared_cosine(stream)))
            return inputs[:number]

        def until(close, *, past, first=first):
            """Return the least number of inputs that brings the corners so close."""
            number = 1
            while width(product(first(number)[:: -1 if past else 1])) >= close:
                number += 1
            return number

        back = until(tolerance, past=True)
        power = 2 ** math.ceil(math.log2(back))
        # The limit is taken after both.
        last = max(power, until(1e-4 * tolerance, past=True))
        corners = [centre(product(first(k)[::-1])) for k in (back, power, last)]
        onward = until(tolerance, past=False)
        yield (
            corners[0],
            centre(product(first(onward))),
            (back, onward),
            [gap(corners[0], other) for other in corners[1:]],
        )
