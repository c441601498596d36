"""Initial laws and laws of the scattering angle of one's own: their names, their files, checks.

A file is a table of a density: a CSV file with the columns ``x`` and ``density``. A case names it
with a digest of its content, ``path@digest``, so that an edited table is another case. Nothing
heavy is imported: the plan reads files at every start of Snakemake.
"""

import csv
import hashlib
import math
from pathlib import Path

from kacsim.checks import Problem, at_least, finite, is_number

INITIALS = ("f0", "two_peaks", "uniform", "maxwell")  # the first is the paper's
SCATTERINGS = ("uniform", "forward", "grazing")
COLUMNS = ["x", "density"]
SUFFIX = ".csv"
DIGITS = 12  # hexadecimal, of the SHA-256 of a file
LARGEST_ANGLE = 6.2832  # 2 pi, rounded up
ANGLES = f"must lie between -{LARGEST_ANGLE} and {LARGEST_ANGLE}, in radians"


class TableError(ValueError):
    """A table of a density that cannot be used: the place, the value and what is allowed."""


def is_file(value):
    """Tell a value that names a file, with or without the digest of its content."""
    return isinstance(value, str) and parts_of(value)[0].endswith(SUFFIX)


def parts_of(value):
    """Return (path, digest) of ``path@digest``; the digest is "" if there is none."""
    path, mark, digest = value.rpartition("@")
    is_digest = len(digest) == DIGITS and set(digest) <= set("0123456789abcdef")
    return (path, digest) if mark and is_digest else (value, "")


def settled(value, names, angles=False):
    """Return what a case keeps of a value: None for the paper's law, ``path@digest`` for a file.

    What cannot be used is returned as it is, for the check to refuse.
    """
    value = str(value) if isinstance(value, Path) else value
    if isinstance(value, str) and value == names[0]:
        return None
    if not is_file(value) or parts_of(value)[1]:
        return value
    try:
        return f"{value}@{_content(value, angles)[1]}"
    except TableError:
        return value


def token(value):
    """Return the part of a case's id: the name of a law, or the digest of a file."""
    return parts_of(value)[1] if is_file(value) else str(value).replace("_", "-")


def problems(name, value, names, angles=False):
    """Yield the problems of a value: neither a name nor a file that can be used."""
    if value is None or value in names:
        return
    if not is_file(value):
        allowed = f"must be one of {', '.join(names)}, or a file of a table, ending in {SUFFIX}"
        yield Problem(name, value, allowed)
        return
    try:
        read(value, angles)
    except TableError as error:
        yield Problem(name, value, str(error))


def read(value, angles=False):
    """Return the points of a file's table.

    Parameters
    ----------
    value : str, path or path@digest
    angles : bool, x are angles in radians

    Returns
    -------
    list of (x, density), x never falling; at a repeated x the density jumps

    Raises
    ------
    TableError
        Names the line, its value and what is allowed.
    """
    path, digest = parts_of(value)
    points, now = _content(path, angles)
    if digest and digest != now:
        raise TableError(f"has changed since: the digest of its content is {now}")
    return points


def _content(path, angles):
    """Return (points, digest) of a file."""
    try:
        content = Path(path).read_bytes()
        text = content.decode("utf-8-sig")
        rows = [(k, row) for k, row in enumerate(csv.reader(text.splitlines()), 1) if row]
    except (OSError, ValueError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or "is no text"
        raise TableError(f"cannot be read: {reason}") from error
    if not rows or [word.strip() for word in rows[0][1]] != COLUMNS:
        raise TableError(f"line 1: must name the columns {','.join(COLUMNS)}")
    points = []
    for line, row in rows[1:]:
        points.append(_point(line, row))
        problem = _place_problem(points, angles)
        if problem:
            raise TableError(f"line {line}: x = {points[-1][0]!r}: {problem}")
    if not pieces_of(points):
        raise TableError("must have two lines or more, between which the density is not 0")
    return points, hashlib.sha256(content).hexdigest()[:DIGITS]


def _point(line, row):
    if len(row) != len(COLUMNS):
        raise TableError(f"line {line}: {','.join(row)}: must be two numbers, x and density")
    point = []
    for column, word, check in zip(COLUMNS, row, (finite, _density), strict=True):
        try:
            number = float(word)
        except ValueError:
            number = word.strip()
        for problem in check(column, number):
            raise TableError(f"line {line}: {problem}")
        point.append(number)
    return tuple(point)


def _density(name, value):
    yield from at_least(name, value, 0)


def _place_problem(points, angles):
    if len(points) > 1 and points[-1][0] < points[-2][0]:
        return "must not fall from each line to the next"
    return ANGLES if angles and abs(points[-1][0]) > LARGEST_ANGLE else ""


def pieces_of(points):
    """Return the pieces of a density that is linear between points.

    Returns
    -------
    list of (start, width, tilt, mass), as of `kacsim.kac.own_law.Drawn`: a piece begins where the
    density is lower, which no rounding then makes negative
    """
    found = []
    for k in range(1, len(points)):
        (left, low), (right, high) = points[k - 1], points[k]
        mass = 0.5 * (low + high) * (right - left)
        if mass > 0.0:
            start, width = (left, right - left) if high >= low else (right, left - right)
            found.append((start, width, abs(high - low) / (high + low), mass))
    return found


def pieces_of_table(name, table, angles=False):
    """Return the pieces of a table of `kacsim.techniques.tabulate`, equally probable.

    Raises
    ------
    ValueError
        Names the entry, its value and what is allowed.
    """
    try:
        values = [float(one) for one in table]
    except (TypeError, ValueError):
        values = []
    if len(values) < 2:
        raise ValueError(f"{name} = {table!r}: must be a name, a file or two or more numbers")
    for k, value in enumerate(values):
        allowed = ""
        if not is_number(value):
            allowed = "must be a finite number"
        elif k and value < values[k - 1]:
            allowed = "must not fall from each value to the next"
        elif angles and abs(value) > LARGEST_ANGLE:
            allowed = ANGLES
        if allowed:
            raise ValueError(f"{name}[{k}] = {value!r}: {allowed}")
    return [(values[k], values[k + 1] - values[k], 0.0, 1.0) for k in range(len(values) - 1)]


def even(pieces):
    """Return the pieces of the even part of a density: half of each piece lies mirrored."""
    mirrored = [(-start, -width, tilt, mass) for start, width, tilt, mass in pieces]
    return [*pieces, *mirrored]


def aliases(masses):
    """Return Walker's aliases of masses, by Vose's method: lists cut and other, as of `Drawn`."""
    total = math.fsum(masses)
    left = [mass / total * len(masses) for mass in masses]
    cut, other = [1.0] * len(masses), list(range(len(masses)))
    small = [k for k, mass in enumerate(left) if mass < 1.0]
    large = [k for k, mass in enumerate(left) if mass >= 1.0]
    while small and large:
        k, donor = small.pop(), large[-1]
        cut[k], other[k] = left[k], donor
        left[donor] -= 1.0 - left[k]
        if left[donor] < 1.0:
            small.append(large.pop())
    return cut, other
