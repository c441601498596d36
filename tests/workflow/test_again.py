"""Files of a finished run, made again from what they carry: in another folder, by hand."""

import os
import subprocess
import sys

import pytest
from runs import ROOT

ITEM = "techniques_fig1"  # with samples, and cheap


def again(path, folder, *words):
    """Run the command in an empty folder; return the finished process."""
    command = [sys.executable, "-m", "kacsim", "again", str(path), *words]
    own = {"PYTHONPATH": str(ROOT)}
    return subprocess.run(
        command, cwd=folder, capture_output=True, text=True, env={**os.environ, **own}
    )


@pytest.mark.parametrize("suffix", ["nc", "svg", "png", "pdf", "csv"])
def test_a_file_of_a_run_is_made_again(suffix, finished, tmp_path):
    kind = "datasets" if suffix == "nc" else "figures"
    path = finished.folder / f"results/{kind}/{ITEM}.{suffix}"
    answer = again(path, tmp_path, "--check")
    assert answer.returncode == 0, answer.stdout + answer.stderr
    assert "bits: the same, apart from what says how the file was made" in answer.stdout
    assert list(tmp_path.iterdir()) == []


def test_a_figure_that_was_sent_is_enough(finished, tmp_path):
    """Under another name and in another folder; one that was drawn over is told so."""
    sent = tmp_path / "sent.svg"
    text = (finished.folder / f"results/figures/{ITEM}.svg").read_text(encoding="utf-8")
    sent.write_text(text.replace("stroke-width: 0.8", "stroke-width: 0.9", 1), encoding="utf-8")
    answer = again(sent, tmp_path)
    assert answer.returncode == 0, answer.stdout + answer.stderr
    assert "the first other one at" in answer.stdout
    assert (tmp_path / "again/sent.svg").read_text(encoding="utf-8") == text
