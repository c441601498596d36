"""Probe a density or a fraction by trees."""

import importlib
import inspect
import json
import math

from kacsim.mckean import choice
from kacsim.mckean.constants import METHODS
from kacsim.plan import PlanError

EXAMPLE = "estimate bkw --velocity 4 --time 1 --n-realizations 100000"
# command -> (family, function, what it probes)
ESTIMATORS = {
    "kac": ("kac", "estimate_density", "f(v, t) of the Kac equation"),
    "kac-tail": ("kac", "estimate_tail", "P(v_1 > v) of the Kac equation"),
    "bkw": ("boltzmann", "estimate_bkw", "f(c; t) of the BKW mode"),
    "bkw-fraction": (
        "boltzmann",
        "estimate_bkw_fraction",
        "the fraction of the BKW mode faster than a threshold",
    ),
    "extinction": ("boltzmann", "estimate_extinction", "f(t) of f' = -alpha f^2, Algorithm 4"),
    "trap": ("boltzmann", "estimate_trap", "f(r; c; t) in the harmonic trap, Algorithms 5 and 6"),
    "trap-fraction": (
        "boltzmann",
        "estimate_trap_fraction",
        "the fraction of matter beyond a radius, Algorithm 7",
    ),
}
LIMIT = 0.05  # of the largest realization's share, above which the bars are not believed
WHOLE = {"n_realizations", "seed", "max_nodes"}
DEFAULTS = {"n_realizations": 10_000, "seed": 1, "method": choice.BEST}


def _function(name):
    family, function, _ = ESTIMATORS[name]
    return getattr(importlib.import_module(f"kacsim.{family}"), function)


def add(parent):
    """Add one parser per estimator, with a flag for each of its arguments."""
    found = parent.add_subparsers(required=True, metavar="what", dest="what")
    for name, (*_, text) in ESTIMATORS.items():
        one = found.add_parser(name, help=text, description=f"Estimate {text}.")
        for parameter in inspect.signature(_function(name)).parameters.values():
            default = DEFAULTS.get(parameter.name, parameter.default)
            flag = "--" + parameter.name.replace("_", "-")
            needed = default is inspect.Parameter.empty
            kind = str if isinstance(default, str) else _kind(parameter.name)
            shown = "required" if needed else f"default {default}"
            many = {"nargs": "+"} if parameter.name in ("velocity", "position") else {}
            keywords = {"required": True} if needed else {"default": default}
            one.add_argument(flag, type=kind, help=shown, **keywords, **many)
        one.add_argument("--json", action="store_true", help="print one JSON object")


def _kind(name):
    def value(text):
        for kind in (int, float) if name in WHOLE else (float,):
            try:
                return kind(text)
            except ValueError:
                continue
        return text  # the estimator refuses it by name

    return value


def run(arguments):
    """Estimate and print: mean ± standard error, mean recursion, realizations.

    Raises
    ------
    PlanError
        Names the flag, its value and what is allowed.
    """
    function, text = _function(arguments.what), ESTIMATORS[arguments.what][-1]
    given = {name: getattr(arguments, name) for name in inspect.signature(function).parameters}
    for name, value in given.items():
        if isinstance(value, list):
            given[name] = value[0] if len(value) == 1 else value
        if name in WHOLE and isinstance(value, float) and value.is_integer():
            given[name] = int(value)
    try:
        found = function(**given)
    except ValueError as error:
        name, rest = str(error).split(" ", 1)
        flag = "--" + name.replace("_", "-") if name in given else name
        raise PlanError(f"{flag} {rest}") from error
    if arguments.json:
        print(json.dumps(vars(found)))
        return
    print(f"{text}: {found.mean:.6g} ± {found.standard_error:.2g}")
    by = f", method {found.method}" if "method" in given else ""
    print(f"{found.n_realizations} realizations, mean recursion {found.mean_recursion:.4g}{by}")
    share, doubt = f"{100 * found.largest_share:.0f} %", ""
    if found.method == choice.BRANCHING and _is_infinite(arguments.what, given):
        doubt = "the exact variance is infinite there"
    if found.largest_share > LIMIT:
        doubt = f"one realization makes {share} of the sum"
    if doubt:
        other = "method" in given and found.method != METHODS[0]
        serves = f"; --method {METHODS[0]} serves" if other else ""
        print(f"{doubt}: the error cannot be believed{serves}")


def _is_infinite(what, given):
    """Tell whether the variance of a realization by branching is known to be infinite."""
    if what == "kac":
        from kacsim.kac.probe import critical_time

        plain = given["oversampling"] == 1.0
        return plain and given["time"] >= critical_time(given["collision_rate"])
    if what in ("bkw", "bkw-fraction"):
        from kacsim.boltzmann.bkw import second_moment_oversampled

        tree = (given[name] for name in ("time", "oversampling", "onset"))
        return math.isinf(second_moment_oversampled(*tree))
    return False
