"""What kernels read, write and call, counted by running them as plain Python.

`counted` starts this file without the compiler: arrays that a kernel makes, and tables that it
reads, then count the bytes that are read and written, and variates and elementary functions count
their calls. What a call of a kernel needs once is left out, by taking the difference of a long and
a short run. Words that come from a stream are not counted as bytes.
"""

import functools
import inspect
import json
import os
import subprocess
import sys
from collections import Counter

import numpy as np

from kacsim.kernels.provenance import ROOT

ENOUGH = 10_000  # words of a stream: a few per cent of what a draw needs
FUNCTIONS = ("kacsim.variates", "kacsim.elementary")
MAKERS = ("empty", "zeros", "full", "arange", "array")
UNTOUCHED = 0xA5


def counted(enough=ENOUGH):
    """Return name -> counts of every kernel of the benchmark, from a process of its own.

    Parameters
    ----------
    enough : int, words of a stream that each takes at least

    Returns
    -------
    dict of dict: bytes moved and calls (dict function -> number), each per word taken from the
    stream, and room, the bytes of memory that are written to
    """
    command = [sys.executable, "-W", "ignore", "-m", __name__, str(enough)]
    known = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, env=known, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"counting without the compiler failed:\n{done.stderr[-3000:]}")
    return json.loads(done.stdout)


class Counted(np.ndarray):
    """An array that adds up the bytes that are read from it and written to it."""

    moved = 0

    def __getitem__(self, key):
        """Read an element, which counts, or make a view, which does not."""
        found = super().__getitem__(key)
        if not isinstance(found, np.ndarray):
            Counted.moved += self.itemsize
        return found

    def __setitem__(self, key, value):
        """Write elements; an array that is their source is read."""
        place = super().__getitem__(key)
        Counted.moved += place.nbytes + (value.nbytes if isinstance(value, np.ndarray) else 0)
        super().__setitem__(key, value)

    def __array_function__(self, function, types, arguments, options):
        """Count what numpy's functions read."""
        Counted.moved += sum(one.nbytes for one in arguments if isinstance(one, Counted))
        return super().__array_function__(function, types, arguments, options)


def _whole(name):
    method = getattr(np.ndarray, name)

    def read(self, *arguments, **options):
        Counted.moved += self.nbytes
        return method(self.view(np.ndarray), *arguments, **options)

    return read


for _name in ("sum", "max", "min", "argmax", "argmin"):
    setattr(Counted, _name, _whole(_name))


class Watch:
    """Counts what happens in the package until the process ends."""

    def __init__(self):
        self.made, self.calls, self._within = [], Counter(), False
        modules = [module for name, module in sys.modules.items() if name.startswith("kacsim.")]
        wrapped = {}
        for module in modules:
            for name, value in list(vars(module).items()):
                if type(value) is np.ndarray:
                    setattr(module, name, value.view(Counted))
                elif inspect.isfunction(value) and value.__module__.startswith(FUNCTIONS):
                    wrapped.setdefault(value, self._counting(value))
                    setattr(module, name, wrapped[value])
        for name in MAKERS:
            setattr(np, name, self._making(getattr(np, name)))

    def _counting(self, function):
        """Return the function with its calls counted, but for those within another's.

        One that fills an array counts once for each of its n values.
        """
        signature = inspect.signature(function)

        @functools.wraps(function)
        def call(*arguments):
            if self._within:
                return function(*arguments)
            bound = signature.bind(*arguments).arguments
            self.calls[function.__name__] += bound["n"] if "values" in bound else 1
            self._within = True
            try:
                return function(*arguments)
            finally:
                self._within = False

        return call

    def _making(self, maker):
        @functools.wraps(maker)
        def make(*arguments, **options):
            made = maker(*arguments, **options).view(Counted)
            if maker.__name__ == "empty":
                made.view(np.ndarray).view(np.uint8)[...] = UNTOUCHED
            self.made.append((made, made.tobytes()))
            return made

        return make

    def take(self):
        """Return (bytes moved, Counter of calls, bytes of room) since the last time."""
        room = 0
        for made, before in self.made:
            pair = [np.frombuffer(text, np.uint8) for text in (made.tobytes(), before)]
            changed = (pair[0] != pair[1]).reshape(-1, made.itemsize).any(axis=1)
            room += int(changed.view(np.ndarray).sum()) * made.itemsize
        found = Counted.moved, self.calls, room
        Counted.moved, self.calls, self.made = 0, Counter(), []
        return found


def of(watch, work, stream, enough):
    """Return the counts of one work; parameters and result as `counted`."""
    from kacsim.benchmark import words

    def run(n):
        taken = stream.copy()
        work.call(n, taken)
        return words.used(stream, taken), *watch.take()

    n, few = 2, run(1)
    while (many := run(n))[0] < enough:
        n *= 2
    taken = many[0] - few[0]
    calls = {
        name: (count - few[2][name]) / taken
        for name, count in many[2].items()
        if count > few[2][name]
    }
    return {"bytes": (many[1] - few[1]) / taken, "calls": calls, "room": many[3]}


def main(enough):
    """Print the counts of all works, as JSON."""
    from kacsim.benchmark import standard_works
    from kacsim.streams import new_stream

    works, stream = standard_works(), new_stream(1, "benchmark")
    watch = Watch()
    found = {name: of(watch, work, stream, enough) for name, work in works.items()}
    print(json.dumps(found))


if __name__ == "__main__":
    main(int(sys.argv[1]))
