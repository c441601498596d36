"""Whether bars of one standard deviation cover the exact value as often as normal ones."""

from kacsim.items import _bkw
from kacsim.items._lazy import bkw, estimate, np, verdict

SAMPLERS = {3: "bkw", 4: "bkw", 5: "bkw_fraction", 6: "bkw_fraction"}
AT_TWO_TIMES = (4, 6)  # figures whose panels are at two printed times
NAMES = tuple(
    f"boltzmann_fig{number}{suffix}" for suffix in ("", "_oversampled") for number in SAMPLERS
)


def findings(samples, settings):
    """Count the bars of replicates, of Figs. 3 to 6 and of their oversampled versions.

    Parameters
    ----------
    settings : of `boltzmann_numbers`, with those of the figures among ``items``
    """
    early, late, over = (np.zeros(2, np.int64) for _ in range(3))
    for number in SAMPLERS:
        chosen = settings["items"][f"boltzmann_fig{number}"]
        covered, time = _bars(number, samples, chosen)
        last = number in AT_TWO_TIMES and time == time[-1]
        before = (time < bkw.critical_time()) & ~np.asarray(last)
        early += _counted(covered, before, chosen)
        late += _counted(covered, last, chosen)
        chosen = settings["items"][f"boltzmann_fig{number}_oversampled"]
        covered, time = _bars(number, samples, chosen)
        over += _counted(covered, time >= 0.0, chosen)
    published = settings["items"]["boltzmann_fig4"]
    last = f"t = {published['time'][-1]:g}, t* = {bkw.critical_time():.3f}."
    size = f"bars, {published['large_n_draws']:,} realizations each"
    each = settings["items"]["boltzmann_fig4_oversampled"]["large_n_draws"]
    return [
        _finding("boltzmann_bars_early", early, f"{early[1]} {size}, at times before t*."),
        _finding("boltzmann_bars_late", late, f"{late[1]} {size}, Figs. 4 and 6, {last}"),
        _finding(
            "boltzmann_bars_oversampled", over, f"{over[1]} bars, {each:,} realizations each."
        ),
    ]


def _bars(number, samples, settings):
    """Return the numbers of covering bars, int[first, time], and the times."""
    covered = _bkw.covering(SAMPLERS[number], samples, settings, "large")
    return covered, np.array(settings["time"], dtype=float)


def _counted(covered, chosen, settings):
    """Return (covering bars, all bars) at the chosen times."""
    here = covered[:, np.broadcast_to(chosen, covered.shape[1])]
    return here.sum(), here.size * settings["n_replicates"]


def _finding(claim, counts, evidence):
    return verdict.finding(claim, estimate.Share(int(counts[0]), int(counts[1])), evidence)
