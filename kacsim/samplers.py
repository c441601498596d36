"""The tables of samplers: their parameters, short forms, defaults, lists and sources."""

from kacsim.checks import BREATHING, MAX_NODES, RATE

_TREE = {"oversampling": "m", "onset": "from", "max_nodes": "budget"}
_GAS = {
    "density": "n",
    "temperature": "temp",
    "drift": "drift",
    "half_width": "box",
    "step": "dt",
}
_TRAP = {
    "initial": "",
    "breathing": "eps",
    "start_phase": "phi",
    "coupling": "coupling",
    "majorant_factor": "majorant",
    "spread": "spread",
    "anisotropy": "anisotropy",
    "max_nodes": "budget",
}
# sampler -> its parameters with their short forms in a case id, in the order of both
SAMPLERS = {
    "kac": {
        "algorithm": "",
        "engine": "",
        "n_particles": "n",
        "time": "t",
        "time_step": "dt",
        "collision_rate": "rate",
        "keep_above": "above",
    },
    "kac_equilibrium": {"n_particles": "n", "tolerance": "eps", "energy": "e"},
    "kac_corners": {"n_particles": "n", "tolerance": "eps"},
    "kac_probe": {"speed": "v", "time": "t", "collision_rate": "rate", **_TREE},
    "bkw": {"speed": "c", "time": "t", **_TREE},
    "bkw_fraction": {"threshold": "c", "time": "t", **_TREE},
    "bkw_tree": {"speed": "c", "time": "t"},
    "bkw_literal": {"initial": "", "speed": "c", "time": "t"},
    "extinction": {"majorant": "nu", "time": "t", "max_nodes": "budget"},
    "trap": {"radius": "r", "time": "t", **_TRAP},
    "trap_fraction": {"radius": "r", "time": "t", **_TRAP},
    "trap_energy": {"radius": "r", "time": "t", **_TRAP},
    "trap_literal": {
        "initial": "",
        "radius": "r",
        "time": "t",
        "breathing": "eps",
        "coupling": "coupling",
    },
    "bkw_moment": {"time": "t", **_TREE},
    "inverse_transform": {"law": "", "n_table": "table"},
    "inversion": {"law": "", "rate": "rate"},
    "rejection": {"law": "", "envelope": ""},
    "identity": {},
    "injection": _GAS,
    "outer_gas": _GAS,
    "weighted_particles": {"n_representatives": "n", "temperature": "temp", "drift": "drift"},
    "sphere_lattice": {"dimension": "d", "edge": "m"},
    "sphere_points": {"generator": "", "dimension": "d", "n_points": "n"},
    "area": {"exponent": "power", "n_points": "n"},
}
# Parameters that are lists: a case of the Boltzmann paper holds a grid of probes.
LISTS = {
    name: {"speed", "time", "threshold", "majorant", "radius"} & set(SAMPLERS[name])
    | ({"oversampling"} if name == "bkw_moment" else set())
    for name in (
        "kac_probe",
        "bkw",
        "bkw_fraction",
        "bkw_literal",
        "extinction",
        "trap",
        "trap_fraction",
        "trap_energy",
        "trap_literal",
        "bkw_moment",
    )
}
PROBES = tuple(LISTS)  # samplers at grids of probes
LISTS |= {
    name: {"n_table", "drift", "half_width", "dimension", "edge", "n_points"} & set(SAMPLERS[name])
    for name in (
        "inverse_transform",
        "injection",
        "outer_gas",
        "weighted_particles",
        "sphere_lattice",
        "sphere_points",
        "area",
    )
}
DEFAULTS = {
    "time_step": None,
    "collision_rate": RATE,
    "keep_above": None,
    "energy": None,
    "oversampling": 1.0,
    "onset": 0.0,
    "max_nodes": MAX_NODES,
    "initial": "bkw",
    "breathing": BREATHING,
    "start_phase": 0.0,
    "coupling": 3.0,
    "majorant_factor": 1.0,
    "spread": 1.0,
    "anisotropy": 0.0,
}

# The sources that a draw's bits depend on; `Case.sources` adds the files of the sampler.
SAMPLE_SOURCES = ("jit.py", "streams.py", "variates.py", "sampling.py", "store.py")
FAMILY_SOURCES = {
    "kac": ("kac/sampling.py", "kac/draws.py", "kac/model.py"),
    "boltzmann": (
        "boltzmann/sampling.py",
        "boltzmann/estimators.py",
        "boltzmann/model.py",
        "boltzmann/trap.py",
        "boltzmann/literal.py",
    ),
    "techniques": (
        "techniques/sampling.py",
        "techniques/model.py",
        "techniques/exact.py",
        "techniques/flux.py",
        "checks_techniques.py",
        "kac/model.py",
    ),
}
ALGORITHM_FILES = {
    "nanbu_sequential": "kac/nanbu.py",
    "nanbu_synchronous": "kac/nanbu.py",
    "nanbu_babovsky": "kac/nanbu_babovsky.py",
    "bird": "kac/bird.py",
    "poisson": "kac/poisson.py",
    "poisson_printed": "kac/poisson.py",
}
SAMPLER_FILES = {
    "kac_equilibrium": "kac/perfect.py",
    "kac_corners": "kac/perfect.py",
    "kac_probe": "boltzmann/kac_tree.py",
    "bkw": "boltzmann/bkw_tree.py",
    "bkw_fraction": "boltzmann/bkw_tree.py",
    "bkw_tree": "boltzmann/literal.py",
    "bkw_literal": "boltzmann/literal.py",
    "extinction": "boltzmann/null_collisions.py",
    "trap": "boltzmann/trap_tree.py",
    "trap_fraction": "boltzmann/trap_tree.py",
    "trap_energy": "boltzmann/trap_tree.py",
    "trap_literal": "boltzmann/literal_trap.py",
    "bkw_moment": "boltzmann/bkw_tree.py",
    "inverse_transform": "techniques/inverse_transform.py",
    "inversion": "techniques/inverse_transform.py",
    "rejection": "techniques/rejection.py",
    "identity": "techniques/identity.py",
    "injection": "techniques/injection.py",
    "outer_gas": "techniques/injection.py",
    "weighted_particles": "techniques/particles.py",
    "sphere_lattice": "techniques/integration.py",
    "sphere_points": "techniques/integration.py",
    "area": "techniques/integration.py",
}
# Measured: a collision, or a node of a tree, with all that belongs to it.
WORK_SECONDS = 3e-8
# Samplers that record runs or count, without replicates: theirs is drawn in one go.
UNSHARDED = ("kac_corners", "bkw_tree", "sphere_lattice")
KERNEL_MODULES = tuple(dict.fromkeys([*ALGORITHM_FILES.values(), *SAMPLER_FILES.values()]))
