"""A line of progress on a terminal: share done, throughput and time left; silent in logs."""

import sys
import time

INTERVAL = 0.2  # seconds between two updates of the line


class Progress:
    """Callable that a sampler tells how many of its draws are done.

    Parameters
    ----------
    n_draws : int, draws in all
    label : str, what is drawn
    stream : where the line goes, if it is a terminal
    clock : callable without arguments, seconds
    """

    def __init__(self, n_draws, label, stream=None, clock=time.monotonic):
        self.n_draws, self.label, self.clock = n_draws, label, clock
        self.stream = sys.stderr if stream is None else stream
        self.seen = self.stream.isatty()
        self.start = self.shown = clock()

    def __call__(self, done):
        """Show the state after `done` draws, a few times a second."""
        now = self.clock()
        if not self.seen or now - self.shown < INTERVAL:
            return
        self.shown = now
        rate = done / (now - self.start)
        left = (self.n_draws - done) / rate
        text = f"{100 * done / self.n_draws:3.0f} %  {_plain(rate)}draws/s  {left:.0f} s left"
        self.stream.write(f"\r\033[K{self.label}: {text}")
        self.stream.flush()

    def end(self):
        """Clear the line."""
        if self.seen:
            self.stream.write("\r\033[K")
            self.stream.flush()


def _plain(rate):
    for factor, letter in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if rate >= factor:
            return f"{rate / factor:.3g} {letter}"
    return f"{rate:.3g} "
