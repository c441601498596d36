"""The documents' example of a new algorithm: one file and one line, and everything else follows.

It has a parameter that no other algorithm has, two engines and an exact moment of its own.
"""

import os
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
import xarray as xr
from runs import SMOKE

FILE = "docs/examples/lazy_bird.py"
LINE = re.compile(r"^    (Variant\(\"lazy_bird\".*)$", re.M)
FLAGS = "--algorithm lazy_bird --n-particles 7 --time 1.7 --laziness 0.3 --n-draws 4000 --seed 1"


@pytest.fixture(scope="module")
def project(finished, tmp_path_factory):
    """Return a finished project to which the example of docs/architecture.md has been added."""
    folder = tmp_path_factory.mktemp("algorithm") / "project"
    shutil.copytree(finished.folder, folder, symlinks=True)
    shutil.copy(folder / FILE, folder / "kacsim/kac/lazy_bird.py")
    line = LINE.search((folder / "docs/architecture.md").read_text(encoding="utf-8"))[1]
    declared = folder / "kacsim/kac/samplers.py"
    text = declared.read_text(encoding="utf-8")
    last = '    Variant("poisson_printed", "Poisson (printed rate)"),\n'
    assert text.count(last) == 1
    declared.write_text(text.replace(last, f"{last}    {line}\n"), encoding="utf-8")
    return type(finished)(folder)


def kacsim(project, *words):
    command = [sys.executable, "-m", "kacsim", *words]
    answer = subprocess.run(
        command, cwd=project.folder, capture_output=True, text=True, env=os.environ
    )
    return answer.returncode, answer.stdout + answer.stderr


def test_its_parameter_is_in_the_help(project):
    status, said = kacsim(project, "sample", "kac", "--help")
    assert status == 0
    assert re.search(r"--laziness LAZINESS\s+pairs passed over for one that collides", said)


def test_its_parameter_is_checked_and_belongs_to_it_alone(project):
    flags = FLAGS.replace("0.3", "-1.5").split()
    status, said = kacsim(project, "sample", "kac", *flags, "--output", "x.nc")
    assert status == 2
    assert said.startswith("--laziness = -1.5: must be")
    flags = FLAGS.replace("lazy_bird", "bird").split()
    status, said = kacsim(project, "sample", "kac", *flags, "--output", "x.nc")
    assert status == 2
    assert said.startswith("--laziness = 0.3: bird has no such parameter")


@pytest.mark.parametrize("engine", ["forward", "ancestral"])
def test_it_is_drawn(project, engine):
    words = [*FLAGS.split(), "--engine", engine, "--output", f"{engine}.nc"]
    status, said = kacsim(project, "sample", "kac", *words)
    assert status == 0, said
    with xr.open_dataset(project.folder / f"{engine}.nc") as sample:
        assert np.isfinite(sample["moment"].values).all()


def test_no_existing_sample_is_planned_again(project):
    """Studies that go through all algorithms plan its cases beside their own."""
    answer = project.snakemake("--dry-run", "--printshellcmds", *SMOKE)
    assert answer.returncode == 0, answer.stderr
    planned = set(re.findall(r"--output results/samples/(\S+)\.nc", answer.stdout))
    assert planned
    assert all("lazy-bird" in name for name in planned)


def test_the_shared_law_test_takes_it_up(project):
    """Both engines against its exact moment at N = 7, 3 and 2."""
    test = "tests/law/test_fourth_moments.py"
    words = ["-m", "pytest", "-q", "-o", "addopts=", "-p", "no:cacheprovider", test]
    command = [sys.executable, *words, "-k", "test_moments and lazy_bird"]
    answer = subprocess.run(command, cwd=project.folder, capture_output=True, text=True)
    assert answer.returncode == 0, answer.stdout[-2000:]
    assert re.search(r"\b6 passed", answer.stdout)
