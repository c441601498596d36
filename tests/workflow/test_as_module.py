"""The workflow where the catalogue looks for it, and as a module of another one."""

import os
import subprocess
import sys

from runs import ROOT

MODULE = """
module kacsim:
    snakefile: "{root}/workflow/Snakefile"
    config: {{"seed": 3, "boltzmann_fig3": {{"time": [0.5]}}}}

use rule * from kacsim as kacsim_*

rule all:
    input: rules.kacsim_boltzmann_fig8.input
    default_target: True
"""


SMOKE = ("--configfile", str(ROOT / "config/smoke.yaml"))


def snakemake(folder, *words):
    command = [sys.executable, "-m", "snakemake", *words]
    own = os.environ | {"KACSIM_CHROMIUM": ""}
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, env=own)


def test_either_file_plans_the_same_jobs(tmp_path):
    found = []
    for file in ("Snakefile", "workflow/Snakefile"):
        answer = snakemake(tmp_path, "-n", "--snakefile", str(ROOT / file), *SMOKE)
        assert answer.returncode == 0, answer.stderr
        found.append(answer.stdout.split("Job stats:")[1].split("\n\n")[0])
    assert found[0] == found[1]


def test_another_workflow_uses_it_as_a_module(tmp_path):
    """Schema, texts and package are found; an item is made in the other's folder."""
    (tmp_path / "Snakefile").write_text(MODULE.format(root=ROOT), encoding="utf-8")
    answer = snakemake(tmp_path, "-c1")
    assert answer.returncode == 0, answer.stdout + answer.stderr
    assert (tmp_path / "results/figures/boltzmann_fig8.svg").exists()


def test_a_module_with_a_wrong_configuration_is_refused(tmp_path):
    text = MODULE.format(root=ROOT).replace("0.5", "-1")
    (tmp_path / "Snakefile").write_text(text, encoding="utf-8")
    answer = snakemake(tmp_path, "-n")
    assert answer.returncode != 0
    assert "boltzmann_fig3.time[0] = -1" in answer.stdout + answer.stderr
