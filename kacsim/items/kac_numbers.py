"""Every number and every checkable claim of the Kac paper: published, measured, verdict."""

import functools

from kacsim.items import _claims

USES = (
    "kac_fig1",
    "kac_fig2",
    "kac_fig3",
    "kac_fig4",
    "kac_fig5",
    "kac_fig6",
    "kac_fig7",
    "kac_fig8",
    "kac_fig9",
    "kac_bias",
    "kac_cost",
    "kac_forward",
    "kac_initial",
    "kac_late",
    "kac_perfect",
    "kac_probe",
    "kac_statements",
    "kac_tails",
)

cases = functools.partial(_claims.cases, USES)
reduce = functools.partial(_claims.reduce, "kac_numbers", USES)
draw = _claims.draw
