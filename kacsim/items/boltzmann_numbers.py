"""Every number and every checkable claim of the Boltzmann paper, each with its verdict."""

from kacsim.items import _bars, _claims, _laws, _rare, _zero_variance

USES = (
    "boltzmann_fig1",
    "boltzmann_fig2",
    *_bars.NAMES,
    "boltzmann_fig7",
    "boltzmann_fig8",
    "boltzmann_fig9",
    "boltzmann_fig10",
    "boltzmann_late",
    "boltzmann_oversampling",
    "boltzmann_trap_variance",
    "boltzmann_variance",
)


def cases(settings):
    """Return the cases of the claims, and those of the items that have claims of their own."""
    own = [
        *_zero_variance.grid(settings).values(),
        *_rare.grid(settings).values(),
        *_laws.grid(settings).values(),
    ]
    return [*own, *_claims.cases(USES, settings)]


def reduce(samples, settings):
    """Return the table of all claims."""
    own = [
        *_bars.findings(samples, settings),
        *_zero_variance.findings(samples, settings),
        *_rare.findings(samples, settings),
        *_laws.findings(samples, settings),
    ]
    found = own + _claims.findings(USES, samples, settings)
    return _claims.table(("boltzmann_numbers", *USES), found)


draw = _claims.draw
