"""Figures for a journal's column or page, or for a talk: their width, fonts and panels."""

from matplotlib.gridspec import GridSpec
from matplotlib.lines import Line2D
from matplotlib.text import Text

# Widths in inches and fonts in points; panels below each other are so high.
STYLES = {
    "column": {"width": 3.375, "font": 7.0, "panel": 2.3},
    "page": {"width": 7.0, "font": 8.0},
    "talk": {"width": 10.0, "font": 14.0},
}
FONT = 9.0  # of figures as they are drawn
STEADY = ("column", "page")  # whose lines stay as they are


def fit(figure, name):
    """Give a figure the width and the fonts of a style; a column has its panels in a column."""
    style, (width, height) = STYLES[name], figure.get_size_inches()
    letters = style["font"] / FONT
    for text in figure.findobj(Text):
        text.set_fontsize(letters * text.get_fontsize())
    for axes in figure.axes:
        axes.tick_params(labelsize=style["font"])
    if name not in STEADY:
        for line in figure.findobj(Line2D):
            line.set(
                linewidth=letters * line.get_linewidth(), markersize=letters * line.get_markersize()
            )
    high = height * style["width"] / width
    if "panel" in style and _in_rows(figure):
        _stack(figure)
        high = style["panel"] * len(figure.axes)
    figure.set_size_inches(style["width"], high)


def _in_rows(figure):
    """Tell a figure of one grid of panels, some of them side by side."""
    grids = {axes.get_gridspec() for axes in figure.axes}
    return len(grids) == 1 and None not in grids and next(iter(grids)).ncols > 1


def _stack(figure):
    """Put the panels of a grid below each other, each with its own names."""
    grid = GridSpec(len(figure.axes), 1, figure=figure)
    named = ""
    for k, axes in enumerate(figure.axes):
        named = axes.get_ylabel() or named
        axes.set_subplotspec(grid[k])
        axes.set_ylabel(named)
        axes.tick_params(labelleft=True, labelbottom=True)
