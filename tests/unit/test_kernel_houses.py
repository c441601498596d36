"""Kernels in unkind places: other users, other versions, full and read-only disks, a kill.

Each either draws the right bits or says in one line why it does not keep what it compiles.
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import faults
import pytest
from kernel_draws import DRAW, compiled, draw, first_kernels

from kacsim.kernels.provenance import ROOT

NOBODY = "65534"
first = pytest.fixture(scope="module")(first_kernels)
mounting = pytest.mark.skipif(
    os.geteuid() != 0 or not faults.can_mount(), reason="a small disk cannot be mounted here"
)


@pytest.fixture
def disk(tmp_path):
    """Return a function that mounts a small disk with some options, or mounts it otherwise."""
    place = tmp_path / "disk"
    place.mkdir()

    def mount(options):
        again = [f"remount,{options}"] if os.path.ismount(place) else [options]
        subprocess.run(["mount", "-t", "tmpfs", "-o", *again, "tmpfs", str(place)], check=True)
        return place

    yield mount
    subprocess.run(["umount", str(place)], check=False, capture_output=True)


@mounting
def test_a_full_disk_costs_time_only(disk, first):
    """The cache has room for a part of what is compiled."""
    folder = disk("size=64k")
    assert draw(KACSIM_CACHE_DIR=folder / "kernels")[0] == first[1]


@mounting
def test_a_disk_that_is_read_only_is_told(disk, first):
    """Kernels that lie there are compiled again."""
    folder = disk("size=50m")
    shutil.copytree(first[0], folder / "kernels")
    disk("ro")
    bits, _, message = draw(KACSIM_CACHE_DIR=folder / "kernels")
    assert bits == first[1]
    (line,) = message.splitlines()
    assert line.startswith(f"{folder / 'kernels'}: cannot be written (Read-only file system)")


@mounting
def test_a_disk_that_runs_no_programs_keeps_kernels(disk, first):
    """As homes are mounted at some institutes: kernels are loaded from memory, not run from it."""
    folder = disk("size=50m,noexec")
    assert draw(KACSIM_CACHE_DIR=folder)[0] == first[1]
    assert draw(KACSIM_CACHE_DIR=folder) == (first[1], True, "")


# A user who may read everything, since an interpreter may lie in the home of another, and write
# only what is his.
READER = "+dac_read_search"
AS_NOBODY = (
    *("setpriv", "--reuid", NOBODY, "--regid", NOBODY, "--clear-groups"),
    *("--inh-caps", READER, "--ambient-caps", READER),
)


def as_nobody(folder, script=DRAW, **given):
    """Draw as a user without rights: (bits, stderr)."""
    if os.geteuid() != 0 or shutil.which("setpriv") is None:
        pytest.skip("another user can be played by root only, with setpriv")
    environment = os.environ | {"HOME": str(folder), "TMPDIR": str(folder / "own")} | given
    command = [*AS_NOBODY, sys.executable, "-B", "-c", script]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()[0], done.stderr


@pytest.fixture
def home():
    """Return a home that others can enter, with a folder of temporaries for all."""
    folder = Path(tempfile.mkdtemp(prefix="home-"))
    folder.chmod(0o755)
    (folder / "own").mkdir()
    (folder / "own").chmod(0o1777)
    yield folder
    shutil.rmtree(folder)


@pytest.mark.parametrize("shared", [False, True])
def test_two_users_of_one_home(shared, home, first):
    """The second one may not write there, and is told; or may, and takes and adds kernels."""
    shutil.copytree(first[0], home / "kernels")
    if shared:
        for folder in (home / "kernels", *(home / "kernels").rglob("*")):
            folder.chmod(0o777 if folder.is_dir() else 0o644)
    bits, message = as_nobody(home, KACSIM_CACHE_DIR=str(home / "kernels"))
    assert bits == first[1]
    assert ("cannot be written (Permission denied)" in message) is not shared
    assert draw(KACSIM_CACHE_DIR=home / "kernels") == (first[1], True, "")


def test_two_versions_share_a_folder(tmp_path, first):
    """An edited callee: each version draws its own bits, whichever compiled first."""
    other, kernels = tmp_path / "other", tmp_path / "kernels"
    shutil.copytree(ROOT / "kacsim", other / "kacsim", ignore=shutil.ignore_patterns("__pycache__"))
    source = other / "kacsim/variates.py"
    text = source.read_text(encoding="utf-8")
    edited = text.replace("def uniform(stream):", "def uniform_before(stream):", 1)
    edited += "\n\n@inlined\ndef uniform(stream):\n    return 1.0 - uniform_before(stream)\n"
    assert edited != text
    source.write_text(edited, encoding="utf-8")
    found = {}
    for _ in range(2):
        for root in (ROOT, other):
            environment = os.environ | {"KACSIM_CACHE_DIR": str(kernels)}
            done = subprocess.run(
                [sys.executable, "-c", DRAW], cwd=root, env=environment, capture_output=True,
                text=True, check=True,
            )  # fmt: skip
            found.setdefault(root, []).append(done.stdout.split())
    ours, theirs = found[ROOT], found[other]
    assert ours == [[first[1], "0"], [first[1], "1"]]
    assert theirs[0][0] == theirs[1][0] != first[1]
    assert theirs[1][1] == "1"


def test_a_kill_in_the_middle_of_a_compilation(tmp_path, first):
    """At several moments: the next process draws the right bits, and keeps its kernels."""
    folder = tmp_path / "kernels"
    environment = os.environ | {"KACSIM_CACHE_DIR": str(folder)}
    for wait in (1.0, 1.8, 2.6):
        process = subprocess.Popen(
            [sys.executable, "-c", DRAW], cwd=ROOT, env=environment, stdout=subprocess.DEVNULL
        )
        time.sleep(wait)
        process.send_signal(signal.SIGKILL)
        process.wait()
    assert draw(KACSIM_CACHE_DIR=folder)[0] == first[1]
    assert draw(KACSIM_CACHE_DIR=folder) == (first[1], True, "")


def test_an_installation_that_nobody_may_write(home, first):
    """Nothing is written beside the sources, and kernels go to the user's own folder."""
    installed = home / "site"
    shutil.copytree(ROOT / "kacsim", installed / "kacsim")
    script = f"import sys; sys.path.insert(0, {str(installed)!r}); sys.path.remove('')\n{DRAW}"
    before = sorted(installed.rglob("*"))
    (home / "mine").mkdir()
    (home / "mine").chmod(0o777)
    given = {"KACSIM_CACHE_DIR": str(home / "mine/kernels"), "PYTHONPATH": ""}
    assert as_nobody(home, script, **given) == (first[1], "")
    assert compiled(home / "mine", "nbc")
    assert sorted(installed.rglob("*")) == before
