"""A run packed for an archive: what is in it, and what it says of itself."""

import hashlib
import json
import re
import zipfile

import pytest

from kacsim import cli
from kacsim.kernels import provenance

PAGE = '<p class="source">kacsim 9.9, commit 0</p><code id="configuration">{"kac_fig4": {}}</code>'


@pytest.fixture
def results(tmp_path):
    """Return the folder of a run: a report, a figure, a dataset, a sample."""
    made = {"report/report.html": PAGE, "figures/kac_fig4.csv": "x\n1\n"}
    made |= {"datasets/kac_fig4.nc": "data", "samples/kac.nc": "draws"}
    for name, content in made.items():
        path = tmp_path / "results" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="utf-8")
    return tmp_path / "results"


def packed(results, tmp_path, *words):
    output = tmp_path / "run.zip"
    assert cli.main(["crate", "--results", str(results), "--output", str(output), *words]) == 0
    with zipfile.ZipFile(output) as file:
        names = file.namelist()
        graph = json.loads(file.read("ro-crate-metadata.json"))["@graph"]
        content = {name: file.read(name) for name in names if not name.endswith("/")}
    return content, {one["@id"]: one for one in graph}


@pytest.mark.parametrize("words", [(), ("--samples",)])
def test_every_file_is_there_with_its_sum(words, results, tmp_path):
    content, entities = packed(results, tmp_path, *words)
    made = {name for name in content if name.startswith("results/")}
    wanted = {"results/report/report.html", "results/figures/kac_fig4.csv"}
    wanted |= {"results/datasets/kac_fig4.nc"} | ({"results/samples/kac.nc"} if words else set())
    assert made == wanted
    for name in made:
        about = entities[name]
        assert about["sha256"] == hashlib.sha256(content[name]).hexdigest()
        assert about["contentSize"] == str(len(content[name]))


def test_the_run_is_an_action_of_the_workflow(results, tmp_path):
    content, entities = packed(results, tmp_path)
    workflow = entities[entities["./"]["mainEntity"]["@id"]]
    assert "ComputationalWorkflow" in workflow["@type"]
    assert workflow["version"] == "9.9"
    language = entities[workflow["programmingLanguage"]["@id"]]
    assert language["version"] == provenance.version("snakemake")
    (run,) = [one for one in entities.values() if one["@type"] == "CreateAction"]
    assert run["instrument"]["@id"] == workflow["@id"]
    assert {one["@id"] for one in run["result"]} == {n for n in content if n.startswith("results/")}
    assert "configuration.json" in {one["@id"] for one in run["object"]}
    assert json.loads(content["configuration.json"]) == {"kac_fig4": {}}
    assert re.match(r"\d{4}-\d\d-\d\dT", run["endTime"])
    # What the profiles' validator asks for.
    about = entities["ro-crate-metadata.json"]["conformsTo"]
    assert {"@id": "https://w3id.org/ro/crate/1.1"} in about
    assert {"File", "SoftwareSourceCode", "ComputationalWorkflow"} <= set(workflow["@type"])
    forms = {one["@id"] for one in entities["./"]["conformsTo"]}
    assert "https://w3id.org/ro/wfrun/workflow/0.5" in forms


def test_without_a_report_nothing_is_packed(results, tmp_path, capsys):
    (results / "report/report.html").unlink()
    assert cli.main(["crate", "--results", str(results), "--output", str(tmp_path / "a.zip")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "report.html: cannot be read" in line
    assert not (tmp_path / "a.zip").exists()
