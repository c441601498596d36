"""What a result says of its origin: the commit, and whether results could come from other code."""

import shutil
import subprocess

import pytest

from kacsim.kernels import provenance

pytestmark = pytest.mark.skipif(not shutil.which("git"), reason="no git")


@pytest.fixture
def checkout(tmp_path, monkeypatch):
    """Return a small checkout that the project takes for its own."""
    for name in ("kacsim/a.py", "Snakefile", "environment.txt", "README.md", ".gitignore"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("results\n")
    git(tmp_path, "init", "--quiet")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "--quiet", "--message", "first")
    monkeypatch.setattr(provenance, "ROOT", tmp_path)
    return tmp_path


def git(folder, *words):
    who = ["-c", "user.name=nobody", "-c", "user.email=nobody@localhost", "-c", "commit.gpgsign=0"]
    command = ["git", "-C", str(folder), *who, *words]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def commit():
    return provenance.commit.__wrapped__()  # each process asks once


def test_a_clean_checkout_is_its_commit(checkout):
    head = git(checkout, "rev-parse", "HEAD")
    assert len(head) == 40
    assert commit() == head
    (checkout / "results").mkdir()
    (checkout / "results/a.nc").write_text("a result")
    (checkout / "README.md").write_text("no result depends on it")
    assert commit() == head


@pytest.mark.parametrize("file", ["kacsim/a.py", "kacsim/new.py", "Snakefile", "environment.txt"])
@pytest.mark.parametrize("staged", [False, True])
def test_a_checkout_with_changes_is_marked(file, staged, checkout):
    head = git(checkout, "rev-parse", "HEAD")
    (checkout / file).write_text("something else\n")
    if staged:
        git(checkout, "add", file)
    assert commit() == f"{head}+changes"
    git(checkout, "add", file)
    git(checkout, "commit", "--quiet", "--message", "second")
    assert commit() == git(checkout, "rev-parse", "HEAD") != head


def test_a_deleted_source_is_marked(checkout):
    (checkout / "kacsim/a.py").unlink()
    assert commit().endswith("+changes")


def test_without_a_checkout_the_commit_is_unknown(checkout, monkeypatch):
    shutil.rmtree(checkout / ".git")
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(checkout.parent))
    assert commit() == "unknown"


def test_without_git_the_commit_is_unknown(checkout, monkeypatch):
    monkeypatch.setenv("PATH", str(checkout))
    assert commit() == "unknown"
