"""The tables of `kacsim.kac.own_law`: of laws by their names, of files, of `tabulate`."""

import math
from pathlib import Path

import numpy as np

from kacsim.checks import raise_problems
from kacsim.kac import own_tables
from kacsim.kac.constants import MEAN_ENERGY
from kacsim.kac.own_law import Drawn

PEAK = 1.1  # place of either peak of the initial law "two_peaks"


def _drawn(pieces, spread=0.0, paper=False):
    cut, other = own_tables.aliases([mass for *_, mass in pieces])
    columns = [np.array([piece[k] for piece in pieces], dtype=float) for k in range(3)]
    return Drawn(*columns, np.array(cut), np.array(other, dtype=np.int64), spread, paper)


def initial_law(value=None):
    """Return the `Drawn` of an initial law.

    Parameters
    ----------
    value : None or "f0", "two_peaks", "uniform", "maxwell" (all with E v**2 = 3/2), a file or a
        table of `kacsim.techniques.tabulate`

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    value = str(value) if isinstance(value, Path) else value
    if value is None or isinstance(value, str):
        raise_problems(own_tables.problems("initial", value, own_tables.INITIALS))
    if value is None or (isinstance(value, str) and value == "f0"):
        return _drawn([], paper=True)
    if not isinstance(value, str):
        return _drawn(own_tables.pieces_of_table("initial", value))
    if value == "two_peaks":
        peaks = [(-PEAK, 0.0, 0.0, 0.5), (PEAK, 0.0, 0.0, 0.5)]
        return _drawn(peaks, spread=math.sqrt(MEAN_ENERGY - PEAK**2))
    if value == "maxwell":
        return _drawn([], spread=math.sqrt(MEAN_ENERGY))
    if value == "uniform":
        edge = math.sqrt(3.0 * MEAN_ENERGY)
        return _drawn([(-edge, 2.0 * edge, 0.0, 1.0)])
    return _drawn(own_tables.pieces_of(own_tables.read(value)))


def tables(initial, scattering):
    """Return the tables of `kacsim.kac.own_law`; None stands for the paper's law of either."""
    return initial_law(initial), scattering_law(scattering)


# The density falls linearly from 0 to a right angle; all angles up to an eighth of pi are alike.
FORWARD = ((-0.5 * math.pi, 0.0), (0.0, 1.0), (0.5 * math.pi, 0.0))
ANGLES = {
    "uniform": ((-math.pi, 1.0), (math.pi, 1.0)),
    "forward": FORWARD,
    "grazing": ((-math.pi / 8.0, 1.0), (math.pi / 8.0, 1.0)),
}


def scattering_law(value=None):
    """Return the `Drawn` of the scattering angle: the even part of a density rho(theta).

    Parameters
    ----------
    value : None or "uniform", "forward", "grazing", a file or a table of
        `kacsim.techniques.tabulate`

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    value = str(value) if isinstance(value, Path) else value
    if value is not None and not isinstance(value, str):
        return _drawn(own_tables.even(own_tables.pieces_of_table("scattering", value, angles=True)))
    value = own_tables.SCATTERINGS[0] if value is None else value
    raise_problems(own_tables.problems("scattering", value, own_tables.SCATTERINGS, angles=True))
    points = ANGLES.get(value) or own_tables.read(value, angles=True)
    # Either of a pair may be the first: theta and -theta are equally likely.
    return _drawn(own_tables.even(own_tables.pieces_of(points)))
