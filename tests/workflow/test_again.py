"""Files of a finished run, made again from what they carry."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from runs import ROOT

from kacsim.again import comparing, making, reading

ITEM = "techniques_fig1"  # with samples, and cheap


def again(path, folder, *words):
    """Run the command in another folder; return the finished process."""
    command = [sys.executable, "-m", "kacsim", "again", str(path), *words]
    own = os.environ | {"PYTHONPATH": str(ROOT)}
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, env=own)


def test_a_dataset_is_made_again_from_nothing(finished, tmp_path):
    path = finished.folder / f"results/datasets/{ITEM}.nc"
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


@pytest.mark.parametrize("suffix", ["svg", "png", "pdf", "csv"])
def test_every_kind_has_the_same_bytes(suffix, finished, tmp_path, monkeypatch):
    """From the dataset of the run: that this is made again is tested above."""
    monkeypatch.setattr(making, "_run", lambda order, target, *_: Path(finished.folder, target))
    path = finished.folder / f"results/figures/{ITEM}.{suffix}"
    made = tmp_path / path.name
    making.make(reading.read(path), made, tmp_path, 1)
    assert comparing.differences(path, made) == []


def test_a_run_that_fails_is_told(finished, tmp_path, monkeypatch):
    order = reading.read(finished.folder / f"results/figures/{ITEM}.png")
    monkeypatch.setattr(making, "ROOT", tmp_path)
    with pytest.raises(making.StoreError, match=rf"{ITEM}\.png: cannot be made again:"):
        making.make(order, tmp_path / "a.png", tmp_path, 1)
