"""One style for all figures: colours, symbols, names and shared axes; no computing."""

import math

import matplotlib
import numpy as np
from matplotlib import patheffects, ticker
from matplotlib.figure import Figure

from kacsim.drawing import marks
from kacsim.files import replace_file
from kacsim.kernels.lookup import lazy
from kacsim.recipes.carriers import FIELD

exact = lazy("kacsim.kac.exact")

# Okabe and Ito's colours, told apart by all common kinds of colour vision; markers differ too.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
# Nine others for more things than that palette has: Tol's muted ones, the lightest two darker.
MUTED = (
    "#332288",
    "#56B4E9",
    "#44AA99",
    "#117733",
    "#999933",
    "#E69F00",
    "#CC6677",
    "#882255",
    "#AA4499",
)
STYLE = {
    "font.size": 9,
    "axes.titlesize": 9,
    "legend.fontsize": 7.5,
    "legend.framealpha": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "savefig.dpi": 200,
    "svg.hashsalt": "kacsim",
    "svg.fonttype": "path",
    "pdf.fonttype": 3,
}
# A legend above a panel.
TIGHT = {"frameon": False, "columnspacing": 0.9, "handletextpad": 0.4, "handlelength": 1.5}
PANEL_WIDTH, PANEL_HEIGHT = 3.5, 2.7
SINGLE_WIDTH = 5.0


def distinct(count):
    """Return so many colours, no two alike."""
    if count <= len(MUTED):
        return MUTED[:count]
    return list(matplotlib.colormaps["turbo"](np.linspace(0.0, 1.0, count)))


def panels(rows, columns, *, share_y=False, height=None, width=None, projection=None):
    """Return (figure, flat list of axes) in the project's style; sizes in inches."""
    matplotlib.rcParams.update(STYLE)
    width = width or (SINGLE_WIDTH if columns == 1 else PANEL_WIDTH * columns)
    keywords = {"projection": projection} if projection else None
    size = (width, (height or PANEL_HEIGHT + 0.4 * (columns == 1)) * rows)
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.subplots(rows, columns, sharey=share_y, squeeze=False, subplot_kw=keywords)
    return figure, list(axes.flat)


def stack(heights, *, width):
    """Return (figure, list of axes), one below the other with heights in inches.

    Such figures hold many words: in SVG these stay text, of a third of the size.
    """
    matplotlib.rcParams.update(STYLE)
    figure = Figure(figsize=(width, sum(heights) + 0.6), layout="constrained")
    figure.svg_fonttype = "none"
    return figure, list(figure.subplots(len(heights), squeeze=False, height_ratios=heights).flat)


def rows(counts, *, heights, width):
    """Return (figure, a list of axes per row), rows of different numbers of panels."""
    matplotlib.rcParams.update(STYLE)
    figure = Figure(figsize=(width, sum(heights)), layout="constrained")
    parts = figure.subfigures(len(counts), 1, height_ratios=heights)
    return figure, [list(part.subplots(1, n)) for part, n in zip(parts, counts, strict=True)]


def points(axis, x, y, errors, k, label, *, line=True, **style):
    """Draw points with error bars of one standard error in the k-th colour and symbol."""
    axis.errorbar(
        np.asarray(x),
        np.asarray(y),
        yerr=None if errors is None else np.asarray(errors),
        **{"color": COLOURS[k], "marker": MARKERS[k], "ms": 4, "label": label} | style,
        lw=0.8 if line else 0,
        elinewidth=0.8,
        capsize=1.5,
    )


def bars(axis, edges, density, k, label, *, fill=True):
    """Draw a histogram as an outline, over a light fill or not, in the k-th colour."""
    if fill:
        style = {"fill": True, "color": COLOURS[k], "alpha": 0.25, "lw": 0}
        axis.stairs(np.asarray(density), np.asarray(edges), **style)
    axis.stairs(np.asarray(density), np.asarray(edges), color=COLOURS[k], lw=0.8, label=label)


def solution(axis, time, label="eq. (8)"):
    """Draw the exact density at a time, over all bins."""
    grid = np.linspace(-8, 8, 641)
    axis.plot(grid, exact.density(grid, time), color="black", lw=1, label=label)


def floor(axis, value):
    """Mark the noise floor of a TVN axis."""
    axis.axhline(value, color="0.5", ls=":", lw=1.2, label="noise floor")


def velocity_axis(axis, last_tick=4):
    """Name and bound the velocity axis; it ends half a tick beyond its last one."""
    axis.set_xticks(np.arange(-last_tick, last_tick + 1, 2))
    axis.set_xlim(-last_tick - 1, last_tick + 1)
    axis.set_xlabel("velocity $v_1$")


def half_turns(axis, last):
    """Put ticks at whole multiples of pi on an axis of angles up to the last one."""
    count = math.ceil(last / math.pi)
    step = max(1, count // 6)
    places = range(0, count + 1, step)
    names = ["0" if k == 0 else f"{k if k > 1 else ''}$\\pi$" for k in places]
    axis.set_xticks([k * math.pi for k in places], names)


def density_axis(axis):
    """Name the density axis."""
    axis.set_ylabel("density")


def legends_above(axes, share=0.4, ncols=1):
    """Put the legends above the data, on room made for them as a share of the common axis."""
    low, high = axes[0].get_ylim()
    room = 1.0 / (1.0 - share)
    for axis in axes:
        is_log = axis.get_yscale() == "log"
        axis.set_ylim(low, low * (high / low) ** room if is_log else low + (high - low) * room)
        tight = {"columnspacing": 0.6, "handletextpad": 0.1} if ncols > 1 else {}
        axis.legend(loc="upper center", frameon=False, ncols=ncols, **tight)


def legend_on_top(axis, height=1.0, ncols=3, **keywords):
    """Put the legend outside, above the axis, at a height in panels."""
    place = {"loc": "lower center", "bbox_to_anchor": (0.5, height), "ncols": ncols}
    axis.legend(**(place | TIGHT | keywords))


def halo_text(axis, text, place, colour):
    """Write just above a place, on a white halo that keeps it readable over lines."""
    style = {"color": colour, "ha": "center", "va": "bottom", "zorder": 10}
    halo = [patheffects.withStroke(linewidth=2.0, foreground="white")]
    offset = {"xytext": (0, 1), "textcoords": "offset points"}
    axis.annotate(text, place, path_effects=halo, **style, **offset)


def plain_log(axis):
    """Label a logarithmic axis with plain numbers at 1, 2 and 5 of each decade."""
    axis.set_major_locator(ticker.LogLocator(base=10, subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
    axis.set_minor_formatter(ticker.NullFormatter())


def with_error(mean):
    """Return an estimate as text, with two digits of its error."""
    if not (mean.standard_error > 0):
        return f"{mean.value:.4g}"
    digits = max(0, 1 - math.floor(math.log10(mean.standard_error)))
    return f"{mean.value:.{digits}f} ± {mean.standard_error:.{digits}f}"


def power_of_ten(value):
    """Return 1e-06 as 10 to the power -6, for a title."""
    mantissa, exponent = f"{value:.0e}".split("e")
    factor = "" if mantissa == "1" else f"{mantissa}\\times "
    return f"${factor}10^{{{int(exponent)}}}$"


def save(figure, path, recipe=None):
    """Write a figure; the suffix sets the format and no file holds a time or a random id.

    Parameters
    ----------
    figure : matplotlib Figure
    path : file to create or replace
    recipe : str, how the figure was made; it stands among the metadata
    """
    suffix = str(path).rpartition(".")[2]
    metadata = {
        "png": {"Software": None},
        "svg": {"Date": None, "Creator": None},
        "pdf": {"CreationDate": None, "Producer": None, "Creator": None},
    }[suffix] | {FIELD[suffix]: recipe}
    if figure.get_layout_engine() is not None:  # all formats share one layout, made once
        figure.get_layout_engine().execute(figure)
        figure.set_layout_engine(None)
    if suffix == "svg":
        marks.named(figure)
    fonttype = getattr(figure, "svg_fonttype", STYLE["svg.fonttype"])
    with matplotlib.rc_context({"svg.fonttype": fonttype}):
        replace_file(path, lambda name: figure.savefig(name, format=suffix, metadata=metadata))
