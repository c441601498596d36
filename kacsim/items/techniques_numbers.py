"""Every checkable claim of the chapter, and its exercises: printed, measured, verdict."""

from kacsim.items import _claims

USES = (
    "techniques_fig1",
    "techniques_fig2",
    "techniques_fig3",
    "techniques_fig4",
    "techniques_exercises",
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
