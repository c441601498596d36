"""What is imported, and when: in a fresh interpreter each, since this one has everything."""

import os
import subprocess
import sys

import pytest

from kacsim import items
from kacsim.kernels.provenance import ROOT

HEAVY = ("matplotlib", "netCDF4", "numba", "numpy", "pandas", "scipy", "xarray")


def said(code):
    """Return the words that a fresh interpreter prints."""
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=ROOT, env=os.environ, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_families_are_attributes_of_the_package():
    """Without an import of their own; a name that there is not stays an AttributeError."""
    code = (
        "import kacsim\n"
        "for name in ('boltzmann', 'kac', 'maxwell', 'techniques'):\n"
        "    print(getattr(kacsim, name).__name__, name in dir(kacsim))\n"
        "print(callable(kacsim.kac.draw), callable(kacsim.techniques.inject))\n"
        "print(hasattr(kacsim, 'xyzzy'), hasattr(kacsim.kac, 'xyzzy'))"
    )
    names = "boltzmann", "kac", "maxwell", "techniques"
    families = [word for name in names for word in (f"kacsim.{name}", "True")]
    assert said(code) == [*families, "True", "True", "False", "False"]


def test_the_plan_imports_nothing_heavy():
    """Snakemake reads it at every start: the cases of all items, their commands and their code."""
    code = (
        "import sys\n"
        "from kacsim import plan\n"
        "full = plan.Plan(plan.read_config('config/config.yaml'))\n"
        "from kacsim.jobs import expected\n"
        "print(len(full.cases_of), len(expected.items_table(full, full.cases_of)) > 1000)\n"
        "from kacsim.jobs import stages\n"
        "print(len({stages.code(stages.sample_roots(case)) for case in full.cases.values()}) > 9)\n"
        "print(len({stages.code(stages.reduce_roots(name)) for name in full.cases_of}) > 9)\n"
        f"print(*(set(sys.modules) & {set(HEAVY)}))"
    )
    number, *found = said(code)
    assert int(number) == len(items.NAMES)
    assert found == ["True", "True", "True"]


@pytest.mark.parametrize(
    "words", [["plan", "--ids"], ["plan"], ["sample", "kac", "--help"]], ids=" ".join
)
def test_commands_that_draw_nothing_import_nothing_heavy(words):
    code = (
        "import contextlib, os, sys\n"
        "from kacsim import cli\n"
        "with contextlib.redirect_stdout(open(os.devnull, 'w')):\n"
        "    try:\n"
        f"        status = cli.main({words})\n"
        "    except SystemExit as end:\n"
        "        status = end.code\n"
        f"print(status, *(set(sys.modules) & {set(HEAVY)}))"
    )
    assert said(code) == ["0"]


def test_formulas_need_no_compiler():
    code = (
        "import sys; from kacsim import kac; kac.density(1.0, 0.5); kac.cumulative(1.0, 0.5)\n"
        "print('numba' in sys.modules)"
    )
    assert said(code) == ["False"]


def test_draws_need_no_statistics_nor_plots():
    """Their imports would take longer than the draws of a job."""
    code = (
        "import sys; from kacsim import kac\n"
        "kac.draw('bird', n_particles=5, time=1, n_draws=1, seed=1)\n"
        "print(*({'scipy.stats', 'matplotlib', 'xarray', 'pandas'} & set(sys.modules)))"
    )
    assert said(code) == []
