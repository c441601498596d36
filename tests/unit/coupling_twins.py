"""Plain-Python twins of the kernels of coupling, written from the algorithms' descriptions.

They call the same variates, one at a time, from the same stream; they multiply whole matrices, and
look at every rule and at every pair of corners after every step.
"""

import math

from kacsim import variates as random


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


def blocks(n, block, stream):
    """Yield (energy of particle 1 where a block begins, whether it succeeds, the largest difference
    of two states after a sweep that does), block after block.

    Of all states of sum 1 the corners and the one that is followed are carried along; after each of
    the sweep's steps what the corners have in particles k and N is summed anew.
    """
    state = [1.0] + [0.0] * (n - 1)
    while True:
        begun = state[0]
        points = [[float(i == k) for i in range(n)] for k in range(n)] + [state]
        for p, q, share in _ahead(n, block, stream):
            for x in points:
                total = x[p] + x[q]
                x[p], x[q] = share * total, (1 - share) * total
        corners, state = points[:n], points[n]
        succeeds, k = True, 0
        while succeeds and k < n - 1:
            low, high = (side(x[k] + x[-1] for x in corners) for side in (min, max))
            y = high * random.squared_cosine(stream)
            if y <= low or k == n - 2:
                for x in points:
                    x[k], x[-1] = y, x[k] + x[-1] - y
                k += 1
            else:
                succeeds = False
        if not succeeds:
            total = state[k] + state[-1]
            while True:
                y = total * random.squared_cosine(stream)
                # The densities of y for the sums `total` and `high`, without their common factor.
                own, common = ((s - y) ** -0.5 if s > y else math.inf for s in (total, high))
                if y > low or random.uniform(stream) * own >= common:
                    break
            state[k], state[-1] = y, total - y
            for j in range(k + 1, n - 1):
                total, share = state[j] + state[-1], random.squared_cosine(stream)
                state[j], state[-1] = share * total, (1 - share) * total
        yield begun, succeeds, max(max(x) - min(x) for x in zip(*points, strict=True))


def _ahead(n, block, stream):
    """Yield steps (p, q, share), which the kernel draws in lots of 1024."""
    for start in range(0, block, 1024):
        size = min(1024, block - start)
        yield from [
            (*random.pair_below(n, stream), random.squared_cosine(stream)) for _ in range(size)
        ]


def perfect(n, energy, block, stream):
    """Yield (v_1, blocks until then): the first block that succeeds begins no draw."""
    started = False
    for number, (begun, succeeds, _) in enumerate(blocks(n, block, stream), 1):
        if succeeds and started:
            yield math.sqrt(energy * begun) * random.random_sign(stream), number
        started = started or succeeds
