"""Every checkable claim of the chapter, and its exercises: printed, measured, verdict."""

import functools

from kacsim.items import _claims

USES = (
    "techniques_means",
    "techniques_fig1",
    "techniques_fig2",
    "techniques_fig3",
    "techniques_steps",
    "techniques_fig4",
    "techniques_exercises",
)

cases = functools.partial(_claims.cases, USES)
reduce = functools.partial(_claims.reduce, "techniques_numbers", USES)
draw = _claims.draw
