"""The speeds of the kernels, with what was asked for, beside plain versions of the same.

The plain versions are the peers' obvious numba version of Bird's algorithm, the literal
epsilon-perfect algorithm, and plain recursions of the trees.
"""

import resource
import statistics

import numpy as np

from kacsim.benchmark.peers import obvious_bird
from kacsim.benchmark.timing import seconds_per_draw
from kacsim.boltzmann import bkw_tree, literal, literal_trap, trap, trap_tree
from kacsim.boltzmann.constants import BREATHING
from kacsim.cases import make_case
from kacsim.kac import bird, perfect, poisson
from kacsim.kac.constants import MEAN_ENERGY, RATE
from kacsim.maxwell import bird as maxwell_bird
from kacsim.maxwell import poisson as maxwell_poisson
from kacsim.maxwell.constants import RATE as MAXWELL_RATE
from kacsim.streams import new_stream

SPAN = 2.0  # from the start to what is drawn


def run(repeats):
    """Measure everything and print one line per figure."""
    _bird(repeats)
    _ancestral(repeats)
    _maxwell(repeats)
    _perfect(repeats)
    _initial(repeats)
    _bkw_tree(repeats)
    _trap_tree(repeats)
    _mckean(repeats)
    _memory()


def _draws(kernel_function, arguments, *components):
    stream = new_stream(1, "benchmark")

    def call(n):
        kernel_function(np.empty((n, *components)), np.empty(n, np.int64), *arguments, stream)

    return call


def _parameters(n_particles):
    return {"n_particles": n_particles, "time": SPAN, "collision_rate": RATE}


def _bird(repeats):
    """Forward Bird against the obvious version, per collision."""
    for n_particles, n_draws in ((50, 40_000), (1000, 2_000)):
        arguments = bird.arguments(**_parameters(n_particles))
        fast = seconds_per_draw(_draws(bird.forward, arguments), n_draws, repeats)
        slow = seconds_per_draw(
            lambda n, arguments=arguments: obvious_bird(np.empty(n), *arguments), n_draws, repeats
        )
        print(
            f"Bird forward, N = {n_particles}: {fast / arguments[1] * 1e9:.1f} ns per collision, "
            f"obvious version {slow / arguments[1] * 1e9:.1f}: ratio {slow / fast:.1f} (goal 6)"
        )


def _ancestral(repeats):
    """Ancestral draws against forward ones, and their flatness in N."""
    n_draws = 200_000
    forward = seconds_per_draw(
        _draws(bird.forward, bird.arguments(**_parameters(1000))), 2_000, repeats
    )
    for name, module in (("bird", bird), ("poisson", poisson)):
        cost = {}
        for n_particles in (50, 1000, 10**9):
            arguments = module.arguments(**_parameters(n_particles))
            cost[n_particles] = seconds_per_draw(
                _draws(module.ancestral, arguments), n_draws, repeats
            )
        print(
            f"{name} ancestral: {cost[50] * 1e6:.3f} us at N = 50, {cost[1000] * 1e6:.3f} at 1000, "
            f"{cost[10**9] * 1e6:.3f} at 10^9: ratio 10^9 to 50 {cost[10**9] / cost[50]:.2f} "
            f"(goal at most 1.3); forward Bird at 1000 to it {forward / cost[1000]:.0f} (goal 40)"
        )


def _maxwell(repeats):
    """Ancestral draws of Maxwell molecules, and their flatness in N."""
    for name, module in (("bird", maxwell_bird), ("poisson", maxwell_poisson)):
        cost = []
        for n_particles in (50, 1000, 10**9):
            arguments = module.arguments(
                n_particles=n_particles, time=SPAN, collision_rate=MAXWELL_RATE
            )
            cost.append(seconds_per_draw(_draws(module.ancestral, arguments, 3), 100_000, repeats))
        told = ", ".join(f"{seconds * 1e6:.3f}" for seconds in cost)
        print(
            f"{name} ancestral of Maxwell molecules: {told} us at N = 50, 1000, 10^9 (goal 0.5): "
            f"ratio 10^9 to 50 {cost[-1] / cost[0]:.2f} (goal at most 1.3)"
        )


def _perfect(repeats):
    """The epsilon-perfect sampler against the literal algorithm."""
    n_particles, tolerance = 50, 1e-6
    energy = MEAN_ENERGY * n_particles
    stream = new_stream(1, "benchmark")

    def fast(n):
        perfect.couple(np.empty(n), np.empty(n, np.int64), n_particles, energy, tolerance, stream)

    inputs = perfect.record(n_particles, 6000, stream)

    def literal(_):
        perfect.couple_literally(n_particles, energy, tolerance, *inputs)

    quick = seconds_per_draw(fast, 500, repeats)
    slow = seconds_per_draw(literal, 1, min(repeats, 3))
    print(
        f"epsilon-perfect, N = 50: {quick * 1e3:.3f} ms per draw (goal 0.15), literal "
        f"{slow * 1e3:.0f} ms: ratio {slow / quick:.0f} (goal 1000)"
    )


def _nodes(call, n_draws, repeats):
    """Return (seconds per node, nodes per realization) of call(values, nodes)."""
    counts = []

    def one(n):
        nodes = np.empty(n, np.int64)
        call(np.empty(n), nodes)
        counts.append(nodes.mean())

    seconds = seconds_per_draw(one, n_draws, repeats)
    mean = statistics.median(counts[1:])
    return seconds / mean, mean


def _initial(repeats):
    """f0 by a table, by rejection and by the Gamma identity; a triangle by the first two.

    The chapter holds rejection for slower than a table unless random numbers cost very little; the
    triangle's trials take no function at all, so that its random numbers are all that they cost.
    """
    from kacsim.techniques import identity, inverse_transform, rejection

    stream = new_stream(1, "benchmark")
    table = inverse_transform.law_table("kac_initial", 512)
    bounds = {name: rejection.arguments("kac_initial", name) for name in ("constant", "closer")}
    ways = {
        "table": lambda n: inverse_transform.through_table(np.empty(n), table, stream),
        "rejection, constant": lambda n: rejection.draw(np.empty(n), *bounds["constant"], stream),
        "rejection, closer": lambda n: rejection.draw(np.empty(n), *bounds["closer"], stream),
        "Gamma identity": lambda n: identity.draw(np.empty(n), stream),
    }
    cost = {name: seconds_per_draw(way, 500_000, repeats) for name, way in ways.items()}
    print("f0: " + ", ".join(f"{name} {1e9 * cost[name]:.1f} ns" for name in ways))
    simple = inverse_transform.law_table("triangle", 512)
    bounds = rejection.arguments("triangle", "constant")
    table, trials = (
        seconds_per_draw(way, 500_000, repeats)
        for way in (
            lambda n: inverse_transform.through_table(np.empty(n), simple, stream),
            lambda n: rejection.draw(np.empty(n), *bounds, stream),
        )
    )
    print(
        f"triangle: table {1e9 * table:.1f} ns, rejection at half the area {1e9 * trials:.1f} ns: "
        f"ratio {trials / table:.1f}"
    )


def _bkw_tree(repeats):
    """Algorithm 2 against its plain recursion with vectors and printed weights."""
    stream, budget = new_stream(1, "benchmark"), 10**7
    fast, nodes = _nodes(
        lambda v, n: bkw_tree.estimate(v, n, 2.0, SPAN, 1.0, 0.0, budget, stream), 50_000, repeats
    )
    slow, _ = _nodes(lambda v, n: literal.estimate(v, n, 2.0, SPAN, False, stream), 20_000, repeats)
    print(
        f"BKW tree, {nodes:.1f} nodes: {fast * 1e9:.1f} ns per node (goal 45), plain recursion "
        f"{slow * 1e9:.1f}: ratio {slow / fast:.1f}"
    )


def _trap_tree(repeats):
    """Algorithm 6 against its plain recursion, at the centre after half a turn."""
    stream, budget, time_, eps = new_stream(1, "benchmark"), 10**7, 3.0, BREATHING
    physics, laws = (3.0, eps, 0.0, 1.0), (trap.MAJORANT, 1.0, 0.0)
    fast, nodes = _nodes(
        lambda v, n: trap_tree.estimate(v, n, 0.0, 0.0, 0.0, time_, physics, laws, budget, stream),
        20_000,
        repeats,
    )

    slow, _ = _nodes(
        lambda v, n: literal_trap.estimate(v, n, 0.0, 0.0, time_, 3.0, eps, False, stream),
        5_000,
        repeats,
    )
    print(
        f"trap tree, {nodes:.1f} nodes: {fast * 1e9:.1f} ns per node (goal 120), plain recursion "
        f"{slow * 1e9:.1f}: ratio {slow / fast:.1f}"
    )


def _mckean(repeats):
    """McKean's trees per leaf, and those whose subtrees are cut per draw."""
    from kacsim.mckean import constants, contour, probing

    stream = new_stream(1, "benchmark")
    for name, law in (("BKW", constants.BKW), ("Kac", constants.KAC)):
        for time, n_draws in ((SPAN, 20_000), (5.0, 1_000), (10.0, 20)):
            draw = _tree_of(probing, contour.TAIL, time, law, 0.0)
            leaf, leaves = _nodes(lambda v, n, draw=draw: draw(v, n, stream), n_draws, repeats)
            print(
                f"McKean's tree, {name}, t = {time:g}, {leaves:.0f} leaves: {leaf * 1e9:.1f} ns "
                "per leaf (goal 60)"
            )
    draw = _tree_of(probing, contour.BEYOND, 20.0, constants.BKW, constants.CUT)
    end, ends = _nodes(lambda v, n: draw(v, n, stream), 20_000, repeats)
    print(f"McKean's tree, cut, t = 20: {end * ends * 1e6:.1f} us per draw (goal 15)")


def _tree_of(probing, quantity, time, law, cut):
    tree = {"method": "ancestral", "cut": cut, "max_nodes": 10**7}
    return probing.bound(quantity, 6.0, time, law, **tree)


def _memory():
    """Peak memory after a sampler job of many draws."""
    from kacsim.jobs import sampling

    common = {"algorithm": "bird", "engine": "ancestral", "n_particles": 50, "time": SPAN}
    case = make_case("kac", n_draws=5_000_000, n_replicates=1, seed=1, **common)
    sampling.run(case)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak memory after {case.n_draws} draws in one job: {peak:.0f} MB (goal below 400)")
