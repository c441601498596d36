"""Every number and every checkable claim of the Kac paper: published, measured, verdict."""

from kacsim.items import _claims

USES = (
    "kac_fig1",
    "kac_fig2",
    "kac_fig3",
    "kac_fig5",
    "kac_fig6",
    "kac_fig9",
    "kac_bias",
    "kac_tails",
)


def cases(settings):
    """Return the cases of all items that the claims are about."""
    return _claims.cases(USES, settings)


def reduce(samples, settings):
    """Return one row per claim with its statistic and verdict."""
    return _claims.table(_claims.findings(USES, samples, settings))


def draw(dataset):
    """Draw the statistic of every claim, symbols by verdict."""
    return _claims.draw(dataset)
