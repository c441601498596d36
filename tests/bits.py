"""The bits of small cases of every sampler, and what its kernels are compiled to.

python tests/bits.py [--assembly]
python tests/bits.py --switches
python tests/bits.py --printed report.html

The first draws the cases under the circumstances of the process and prints, as JSON, the digest of
each, and those of what the mathematical libraries give, which are not promised. With `--assembly`,
and an empty `KACSIM_CACHE_DIR`, it also tells what the kernels call, what in them is contracted and
what counts references.
The second prints the settings of the environment that turn off what is chosen by the processor, a
line each; the third what a report prints, but for its pictures and the versions.
"""

import dataclasses
import importlib
import json
import math
import os
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import numba
import numpy as np
import references
from numba.core.dispatcher import Dispatcher

ROOT = Path(__file__).resolve().parent.parent
DRAWS = 100  # enough for what variates rarely do
EXEMPT = "kacsim.benchmark."  # draws no sample
# What a kernel may call: itself, the interpreter at its ends, memory. On no number.
HARMLESS = re.compile(
    r"_ZN|_?Py|NRT_|mem(set|cpy|move|cmp)$|__excinfo|"
    r"numba_(gil_|unpickle|do_raise|runtime_build|attempt_nocopy_reshape)"
)
CALLED = re.compile(
    r"^\s*(?:movabsq?[ \t]+\$|callq?[ \t]+|jmpq?[ \t]+|bl?[ \t]+)([A-Za-z_][\w$]*)", re.MULTILINE
)
CONTRACTED = re.compile(r"^\s*(v?fn?m(?:add|sub)\w*|fml[as])\s", re.MULTILINE)


def calls(assembly):
    """Return the names of what is called and is not harmless, sorted."""
    return sorted({name for name in CALLED.findall(assembly) if not HARMLESS.match(name)})


def contractions(assembly):
    """Return the instructions that round a product and a sum once, sorted."""
    return sorted(set(CONTRACTED.findall(assembly)))


def kernels():
    """Return name -> kernel of the whole package."""
    import kacsim
    from kacsim.kernels import cache

    found = {}
    for module in pkgutil.walk_packages(kacsim.__path__, "kacsim."):
        if module.name.endswith("__main__"):
            continue
        for name, one in vars(importlib.import_module(module.name)).items():
            # Ancestral draws are functions around a kernel.
            kernel = one if isinstance(one, Dispatcher) else getattr(one, "__wrapped__", None)
            kept = isinstance(kernel, Dispatcher) and isinstance(kernel._cache, cache._Cache)
            if kept and kernel not in found.values():
                found[f"{module.name}.{name}"] = kernel
    return {name: kernel for name, kernel in found.items() if not name.startswith(EXEMPT)}


def digests():
    """Return id -> digest of small cases of every sampler, variant and engine."""
    from unit.test_frozen import FROZEN, case_of, digest

    from kacsim.cases import tiny_cases
    from kacsim.jobs import sampling

    cases = [dataclasses.replace(case, n_draws=DRAWS) for case in tiny_cases()]
    cases += [case_of(entry) for entry in FROZEN["cases"]]
    return {case.id: digest(sampling.run(case)) for case in cases}


def run_others():
    """Run the kernels that no sampler runs."""
    from kacsim import boltzmann, techniques
    from kacsim.kac import perfect

    techniques.integrate(lambda x: x, 0.0, 1.0, n_points=2, seed=1)
    one = lambda x: np.ones(x.shape)  # noqa: E731
    techniques.draw_by_rejection(one, one, lambda u: u, n_draws=1, seed=1)
    part = np.full(3, 0.3)
    start = boltzmann.Mixture(((1.0, (1.0,)),))
    boltzmann.estimate_relaxation(1.0, 1.0, initial=start, n_realizations=2, seed=1)
    perfect.couple_literally(2, 1.0, 0.5, np.zeros(3, np.int64), np.ones(3, np.int64), part)


@numba.njit
def through_library(x, out):
    """Fill an array by the C library."""
    for k in range(x.size):
        out[k] = math.exp(x[k]) + math.log(1.0 + x[k]) + math.sin(x[k])


def libraries():
    """Return digests of what the C library, numpy and BLAS give for some numbers."""
    from unit.test_frozen import digest

    x = np.random.default_rng(1).uniform(0.0, 1.0, 100_000)
    out = np.empty(x.size)
    through_library(x, out)
    numpy = np.exp(x) + np.log(x)
    found = {"library": out, "numpy": numpy, "blas": x.reshape(100, -1) @ x.reshape(-1, 100)}
    return {name: digest({name: ((), values, {})}) for name, values in found.items()}


def counted():
    """Return name -> what counts references in loops, of the kernels that do."""
    found = {}
    for name, kernel in kernels().items():
        here = [
            one
            for llvm in kernel.inspect_llvm().values()
            for one in references.counted_in_loops(llvm)
        ]
        if here:
            found[name] = here
    return found


def found(assembly):
    """Return what the script prints."""
    told = {"digests": digests(), "libraries": libraries()}
    if assembly:
        run_others()
        texts = {
            name: "\n".join(kernel.inspect_asm().values()) for name, kernel in kernels().items()
        }
        told["counted"] = counted()
        kinds = references.borrowers()
        told["borrowers"] = sum(map(bool, kinds.values()))
        told["lent"] = [
            name for name, found in kinds.items() if any(map(references.holds_an_array, found))
        ]
        told["sizes"] = {name: len(text) for name, text in texts.items()}
        told["calls"] = {name: calls(text) for name, text in texts.items() if calls(text)}
        told["contracted"] = {
            name: contractions(text) for name, text in texts.items() if contractions(text)
        }
    return told


def switched():
    """Return the environment that turns off what the libraries choose by the processor."""
    from numpy._core import _multiarray_umath as core

    features = [name for name in core.__cpu_dispatch__ if core.__cpu_features__[name]]
    return {
        "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2",
        "NPY_DISABLE_CPU_FEATURES": " ".join(features),
        "OPENBLAS_CORETYPE": "PRESCOTT",
    }


def printed(report):
    """Return the words and numbers of a report, a line each, but for pictures and versions."""
    text = Path(report).read_text(encoding="utf-8")
    text = re.sub(r"<(svg|style|script)\b.*?</\1>", " ", text, flags=re.DOTALL)
    text = re.sub(r"kacsim [^<]*Python [^<]*scipy [\d.]*", " ", text)
    return "\n".join(re.sub(r"<[^>]*>", " ", text).split())


def run(*words, **environment):
    """Return what the script says in a process of its own, in another environment."""
    known = os.environ | {"PYTHONPATH": str(ROOT)} | environment
    command = [sys.executable, __file__, *words]
    done = subprocess.run(command, env=known, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stderr[-3000:])
    return json.loads(done.stdout.splitlines()[-1])


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["--switches"]:
            for name, value in {**switched(), "NUMBA_CPU_NAME": "generic"}.items():
                print(f"{name}={value}")
        case ["--printed", report]:
            print(printed(report))
        case words:
            print(json.dumps(found("--assembly" in words)))
