"""C of the same forward loop (`bird.c`), built where a compiler is."""

import ctypes
import functools
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from kacsim import variate_tables as tables

SOURCE = Path(__file__).with_name("bird.c")
COMPILERS = ("cc", "gcc", "clang")
PEERS = ("C, libm", "C, our variates")
FLAGS = ("-O3", "-march=native", "-shared", "-fPIC")
LANES, BLOCK = 8, 256  # as in bird.c: words of a state, the place of the next word, words
PLACE = 4 * LANES
END = PLACE + 1 + BLOCK
PLACES = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
WORDS = np.ctypeslib.ndpointer(np.uint64, flags="C_CONTIGUOUS")


def compiler():
    """Return the path of a C compiler, that of the environment's CC first, or None."""
    named = os.environ.get("CC", "").split()[:1]
    return next(filter(None, map(shutil.which, (*named, *COMPILERS))), None)


@functools.cache
def library():
    """Return the functions of `bird.c`.

    Raises
    ------
    RuntimeError
        The compiler refuses it; with its last line.
    """
    with tempfile.TemporaryDirectory(prefix="kacsim-bird-") as folder:
        file = Path(folder, "bird.so")
        command = [compiler(), *FLAGS, "-o", str(file), str(SOURCE), "-lm"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(f"{' '.join(command)}: {done.stderr.strip().splitlines()[-1]}")
        found = ctypes.CDLL(str(file))
    whole = [ctypes.c_int64] * 2
    found.bird_by_library.argtypes = [PLACES, ctypes.c_int64, PLACES, *whole, WORDS]
    found.bird_by_tables.argtypes = [*found.bird_by_library.argtypes, ctypes.POINTER(Tables)]
    return found


class Tables(ctypes.Structure):
    """What `bird_by_tables` looks variates up in: pointers to the tables of `variate_tables`."""

    NAMES = ("SPEED_EDGE", "SPEED_LEAST", "SPEED_LARGEST", "SPEED_WIDTH", "SPEED_SURE")
    NAMES += ("SPEED_SCALE", "COS_SIN")
    _fields_ = [(name, ctypes.c_void_p) for name in NAMES]
    _fields_ += [("LAYERS", ctypes.c_int64), ("POINTS", ctypes.c_int64)]


def peers(seed):
    """Return name -> function (velocities, n_particles, n_collisions); none without a compiler."""
    if compiler() is None:
        return {}
    pointers = (getattr(tables, name).ctypes.data for name in Tables.NAMES)
    known = Tables(*pointers, tables.LAYERS, tables.POINTS)
    plain, looked_up = _stream(seed, 0), _stream(seed, 1)

    def by_library(velocities, *ensemble):
        room = np.empty(ensemble[0])
        library().bird_by_library(velocities, velocities.size, room, *ensemble, plain)

    def by_tables(velocities, *ensemble):
        room, table = np.empty(ensemble[0]), ctypes.byref(known)
        library().bird_by_tables(velocities, velocities.size, room, *ensemble, looked_up, table)

    return dict(zip(PEERS, (by_library, by_tables), strict=True))


def _stream(*entropy):
    """Return a stream of `bird.c`, all of whose words are used up."""
    stream = np.zeros(END, np.uint64)
    stream[:PLACE] = np.random.SeedSequence(entropy).generate_state(PLACE, np.uint64)
    stream[PLACE] = END
    return stream
