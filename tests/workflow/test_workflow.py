"""The workflow: what a run makes, and what a change makes it do again."""

import json
import os
import re
import shutil
import subprocess
import sys

import printer
import pytest
import yaml
from projects import new_project
from runs import ROOT, SMOKE

from kacsim import items, plan


def test_a_bare_dry_run_plans_every_job(tmp_path):
    project = new_project(tmp_path)
    jobs = project.planned()
    full = plan.Plan(plan.read_config(tmp_path / "config/config.yaml"))
    assert jobs["sample"] == len(full.batches)
    assert jobs["reduce"] == jobs["draw"] == len(items.NAMES)
    assert jobs["report"] == jobs["run_times"] == jobs["all"] == 1


def test_jobs_of_a_cluster_are_as_good_as_cores(finished):
    """Read to its end without Slurm: all is there, and nothing is submitted."""
    where = ("--executor", "slurm", "--jobs", "3")
    answer = finished.snakemake("kac_fig4", *SMOKE, where=where)
    assert answer.returncode == 0, answer.stdout + answer.stderr
    assert "Nothing to be done" in answer.stdout + answer.stderr


def test_the_smoke_run_makes_everything_once(finished):
    results = finished.folder / "results"
    for name in items.NAMES:
        for suffix in ("png", "svg", "pdf", "csv"):
            assert (results / "figures" / f"{name}.{suffix}").stat().st_size > 100
    report = (results / "report/report.html").read_text(encoding="utf-8")
    assert all(f'id="{name}"' in report for name in items.NAMES)
    command = re.search(r"<code>(snakemake -c2 kac_fig1 .*?)</code>", report)[1]
    assert finished.planned(*command.split()[2:]) == {}
    assert "Not the project’s own configuration." in report
    assert "sample/kac_fig1-" in (results / "report/runtime.html").read_text(encoding="utf-8")
    assert finished.planned(*SMOKE) == {}


def test_without_a_browser_the_run_says_once_that_nothing_is_printed(finished):
    lines = [line for line in finished.said.splitlines() if "not printed" in line]
    assert len(lines) == 1
    assert lines[0].startswith("results/report/report.pdf: not printed: no Chromium found")


def test_with_a_browser_the_report_is_printed_once(project):
    project.chromium = str(printer.browser(project.folder / "bin"))
    # The report is written again too, since its texts lie elsewhere in a copy.
    jobs = {"report": 1, "print_report": 1, "run_times": 1, "all": 1}
    assert project.planned(*SMOKE) == jobs
    answer = project.snakemake(*SMOKE)
    assert answer.returncode == 0, answer.stderr
    assert "not printed" not in answer.stdout
    assert (project.folder / "results/report/report.pdf").stat().st_size > 0
    assert project.planned(*SMOKE) == {}


def test_the_page_of_snakemake_itself_has_captions_and_categories(project):
    answer = project.snakemake(*SMOKE, "--report", "page.html")
    assert answer.returncode == 0, answer.stdout + answer.stderr
    page = (project.folder / "page.html").read_text(encoding="utf-8")
    for name in items.NAMES:
        assert f"results/report/report.html#{name}</tt>" in page
    for words in ("Kac paper", "Boltzmann paper", "Histograms of v", "<strong>Fig. 1.</strong>"):
        assert words in page


def test_every_job_has_a_log_and_a_benchmark(finished):
    files = [finished.folder / "config" / name for name in ("config.yaml", "smoke.yaml")]
    batches = {batch.id for batch in plan.Plan(plan.read_config(*files)).batches}
    logs, benchmarks = finished.folder / "logs/sample", finished.folder / "benchmarks/sample"
    assert batches == {path.stem for path in logs.glob("*.log")}
    assert batches == {path.stem for path in benchmarks.glob("*.tsv")}


def test_one_figure_runs_only_what_it_needs(tmp_path):
    project = new_project(tmp_path)
    jobs = project.planned("kac_fig9", *SMOKE)
    # One of its two cases serves another item too, so each has a job of its own.
    assert jobs == {"compile": 1, "sample": 2, "reduce": 1, "draw": 1, "kac_fig9": 1}


def test_editing_a_caption_writes_the_report_again_and_nothing_else(project):
    captions = project.folder / "reports/captions.yaml"
    captions.write_text(captions.read_text(encoding="utf-8") + "\n# edited\n", encoding="utf-8")
    assert project.planned(*SMOKE) == {"report": 1, "run_times": 1, "all": 1}


def test_editing_an_item_does_what_comes_after_it_again(project):
    project.edit("kacsim/items/kac_fig4.py", "share=0.25", "share=0.3")
    assert project.planned("kac_fig4", *SMOKE) == {"draw": 1, "kac_fig4": 1}
    project.edit("kacsim/items/kac_fig4.py", "case.id], width)[0]", "case.id], width)[1]")
    assert project.planned("kac_fig4", *SMOKE) == {"reduce": 1, "draw": 1, "kac_fig4": 1}


def test_changing_a_setting_changes_only_its_item(project):
    config = {"kac_fig4": {"n_draws": 2001}}
    (project.folder / "more.yaml").write_text(yaml.safe_dump(config), encoding="utf-8")
    both = ("--configfile", "config/smoke.yaml", "more.yaml")
    again = project.samples_planned(*both)
    assert again == {
        "kac-bird-ancestral-n10-t2-3x2001",
        "kac-poisson-ancestral-n10-t2-3x2001",
    }


def test_shards_give_the_same_samples_and_are_not_kept(finished, project):
    words = ("results/datasets/kac_fig5.nc", *SMOKE, "--config", "shard_seconds=0.0006")
    jobs = project.planned(*words)
    assert jobs == {"shard": 4, "merge": 2, "reduce": 1}
    for part in ("samples", "datasets"):  # what is compared below is made anew
        shutil.rmtree(project.folder / "results" / part)
    assert project.snakemake(*words).returncode == 0
    made = list((project.folder / "results/samples").glob("*.nc"))
    assert len(made) == 2
    for path in [*made, project.folder / "results/datasets/kac_fig5.nc"]:
        again = finished.folder / path.relative_to(project.folder)
        assert path.read_bytes() == again.read_bytes()
    assert not list(project.folder.glob("results/shards/*"))
    assert project.planned(*words) == {}


def test_another_seed_samples_everything_again(project):
    everything = {path.stem for path in (project.folder / "results/samples").glob("*.nc")}
    assert project.samples_planned(*SMOKE, "--config", "seed=7") == everything


def test_removing_a_figure_draws_it_alone(project):
    (project.folder / "results/figures/kac_fig7.svg").unlink()
    assert project.planned("kac_fig7", *SMOKE) == {"draw": 1, "kac_fig7": 1}


@pytest.mark.parametrize(
    ("config", "messages"),
    [
        ({"kac_fig3": {"time_step": 2.0}}, ["kac_fig3.time_step = 2.0"]),
        (
            {"kac_fig2": {"n_particle": [5]}, "seed": -1},
            ["kac_fig2.n_particle: unknown key", "seed = -1"],
        ),
    ],
    ids=["values", "keys"],
)
def test_a_wrong_configuration_starts_nothing(tmp_path, config, messages):
    project = new_project(tmp_path)
    (tmp_path / "wrong.yaml").write_text(json.dumps(config), encoding="utf-8")
    answer = project.snakemake("--configfile", "wrong.yaml")
    assert answer.returncode == 2
    assert all(f"wrong.yaml: {message}" in answer.stderr for message in messages)
    assert not (tmp_path / "results").exists()


@pytest.mark.parametrize("content", ["", "[1, 2]", "a: ["])
def test_a_file_that_is_no_configuration_starts_nothing(tmp_path, content):
    project = new_project(tmp_path)
    (tmp_path / "wrong.yaml").write_text(content, encoding="utf-8")
    answer = project.snakemake("--configfile", "wrong.yaml")
    assert answer.returncode != 0
    assert "onfig file" in answer.stderr
    assert "Traceback" not in answer.stderr
    assert not (tmp_path / "results").exists()


def test_the_example_of_the_documents_runs(finished):
    words = [sys.executable, str(ROOT / "docs" / "example.py")]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    answer = subprocess.run(
        words, cwd=finished.folder, env=environment, capture_output=True, text=True
    )
    assert answer.returncode == 0, answer.stderr
    assert "E[v**4] = " in answer.stdout
