"""What pytest makes of a law test: a function of its seed, which is looked at twice.

A test of z takes `seed` as an argument, and draws with nothing else, as many as `compare.scaled`
says. What several tests share is a function of the seed, made by `compare.kept`.
"""

import inspect
import math

import pytest
from law import compare


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem):
    """Look at a test that takes a seed; keep its z with what is reported of it."""
    names = inspect.signature(pyfuncitem.obj).parameters
    if "seed" not in names:
        return None
    given = {name: pyfuncitem.funcargs[name] for name in names}
    looks = compare.look_at(lambda seed: pyfuncitem.obj(**given | {"seed": seed}), given["seed"])
    pyfuncitem.user_properties += [("z", found) for found in told(looks)]
    compare.judge(looks)
    return True


def told(looks):
    """Return (z of the first look, that of the second or None, whether it has no sign) of each."""
    again = looks[1].zs if len(looks) > 1 else [None] * len(looks[0].zs)
    return [
        (float(z), None if later is None else float(later), isinstance(z, compare.Unsigned))
        for z, later in zip(looks[0].zs, again, strict=True)
    ]


def found_in(report):
    """Return all that a report tells of null z."""
    return [found for name, found in report.user_properties if name == "z"]


def pytest_terminal_summary(terminalreporter):
    """Say how many null z were taken, and how often one stays by chance."""
    reports = [one for kind in terminalreporter.stats.values() for one in kind]
    done = [one for one in reports if getattr(one, "when", "") == "call"]
    zs = [found for one in done for found in found_in(one)]
    if zs:
        again = sum(abs(z) > compare.LIMIT for z, _, _ in zs)
        rate = math.fsum(compare.chance(unsigned) for _, _, unsigned in zs)
        terminalreporter.write_line(
            f"{len(zs)} null z, {again} of them beyond {compare.LIMIT:g} and drawn again; "
            f"one stays by chance in {rate:.2g} of the seeds"
        )
