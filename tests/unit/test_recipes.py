"""Recipes that files carry: read back, refused, followed, and what is told of a difference."""

import json
import re

import numpy as np
import pytest

from kacsim import cli, files, items, plan, store
from kacsim.again import comparing, making, reading
from kacsim.cases import make_case
from kacsim.drawing import plotting
from kacsim.jobs import sampling
from kacsim.kernels.provenance import ROOT
from kacsim.recipes import carriers, lines
from kacsim.report import csv_table

xr = pytest.importorskip("xarray")
NAME = "kac_fig4"
KINDS = ("svg", "png", "pdf", "csv")
GOOD = {"item": "", "settings": {}, "code": {}, "source": ""}
SOURCE = "kacsim 0.1, commit 0, Python 3.11.0"


@pytest.fixture(scope="module")
def settings():
    return plan.Plan(plan.read_config(ROOT / "config/config.yaml")).settings[NAME]


@pytest.fixture
def dataset(settings):
    about = {"item": NAME, "settings": settings, "code": "0123", "source": SOURCE}
    return xr.Dataset({"a": store.described([1.0, 2.0], ("x",), "<a & b>")}, attrs=about)


def carried(kind, dataset, path):
    """Write a file that carries the recipe of the dataset."""
    recipe = lines.of_figure(dataset, "4567")
    if kind == "csv":
        csv_table.write(dataset, path, recipe)
    else:
        plotting.save(plotting.panels(1, 1)[0], path, recipe)
    return recipe


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_file_carries_its_recipe(kind, dataset, settings, tmp_path):
    path = tmp_path / f"a.{kind}"
    text = carried(kind, dataset, path)
    assert carriers.read(path) == text
    order = reading.read(path)
    assert order.recipe[:2] == (NAME, json.loads(json.dumps(settings)))
    assert order.recipe.source == SOURCE
    assert order.recipe.code == {"reduce": "0123", "draw": "4567"}
    assert [case.id for case in order.plan.cases_of[NAME]] == [
        case.id for case in items.load(NAME).cases(settings)
    ]


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_but_the_recipe_differs(kind, dataset, tmp_path):
    """Two files with one recipe have the same bytes, with two recipes others."""
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        carried(kind, dataset, tmp_path / name / f"a.{kind}")
    pair = [tmp_path / name / f"a.{kind}" for name in ("a", "b")]
    assert comparing.differences(*pair) == []
    data = pair[1].read_bytes()
    pair[1].write_bytes(data[:-3] + bytes([data[-3] ^ 1]) + data[-2:])
    (line,) = comparing.differences(*pair)
    assert line.endswith(f"the first other one at {len(data) - 3}")


def test_the_table_beside_a_table_has_the_form_of_the_web(dataset, tmp_path):
    carried("csv", dataset, tmp_path / "a.csv")
    about = json.loads((tmp_path / "a.csv-metadata.json").read_text())
    assert about["@context"] == "http://www.w3.org/ns/csvw"
    assert about["url"] == "a.csv"
    columns = about["tableSchema"]["columns"]
    header = (tmp_path / "a.csv").read_text().splitlines()[0]
    assert [column["titles"] for column in columns] == header.split(",")
    assert [column["datatype"] for column in columns] == ["integer", "double"]
    assert columns[1]["dc:description"] == "<a & b>"


def test_configurations_of_all_items_come_back():
    """Also of those that use other items, whose settings they hold."""
    config = plan.read_config(ROOT / "config/config.yaml", ROOT / "config/smoke.yaml")
    whole = plan.Plan(config).settings
    for name in (NAME, "kac_numbers", "boltzmann_late"):
        assert reading.plan_of({name: whole[name]}, "a.nc").settings[name] == whole[name]
    assert reading.plan_of(whole, "a.html").settings == whole


WRONG = [
    ("{", "carries no recipe of kacsim: "),
    ("[1]", "carries no recipe of kacsim"),
    (json.dumps({"item": "a"}), "carries no recipe of kacsim: code, settings, source is missing"),
    (json.dumps(GOOD | {"shell": "rm"}), "its recipe has unknown words: shell"),
    (json.dumps(GOOD | {"settings": []}), "settings = '[]' in its recipe: must be a dict"),
    (json.dumps(GOOD) + " " * lines.LARGEST, "its recipe has 1000054 characters, more than"),
]


@pytest.mark.parametrize(("text", "sentence"), WRONG)
def test_a_wrong_recipe_is_refused(text, sentence):
    with pytest.raises(files.StoreError, match=re.escape(f"a.png: {sentence}")):
        lines.parsed(text, "a.png")


FOLLOWED = [
    ({"item": "../x"}, "item = '../x' in its recipe: is not one of this version"),
    ({"settings": {"sampler": "os.system"}}, "sampler = 'os.system' in its recipe"),
    ({"settings": {"sampler": "kac"}}, "n_draws is missing in its recipe"),
    ({"item": NAME, "settings": {"n_drows": 3}}, f"{NAME}.n_drows"),
    ({"item": NAME, "settings": {"time": "$(reboot)"}}, f"{NAME}.time = '$(reboot)'"),
    ({"item": NAME, "settings": {"seed": -1}}, "seed = -1"),
    ({"settings": {"kac_fog": {}}}, "kac_fog"),
    ({"item": "kac_own", "settings": {"initial": "/etc/a.csv"}}, "or a file below this folder"),
    ({"item": "kac_own", "settings": {"initial": "b/../../a.csv"}}, "or a file below this folder"),
    ({"settings": {"kac_fig4": 3}}, "settings in its recipe: must be mappings"),
]


@pytest.mark.parametrize(("changes", "sentence"), FOLLOWED)
def test_a_recipe_of_unknown_words_is_not_followed(changes, sentence, tmp_path):
    path = tmp_path / "a.svg"
    plotting.save(plotting.panels(1, 1)[0], path, json.dumps(GOOD | changes))
    with pytest.raises((files.StoreError, plan.PlanError), match=re.escape(sentence)) as caught:
        reading.read(path)
    assert all(str(path.name) in line for line in str(caught.value).splitlines())


SAMPLE = {"sampler": "kac", "n_draws": 40, "n_replicates": 2, "seed": 1, "algorithm": "bird"}
OUTSIDE = "must be a name, or a file below this folder"
CASES = [
    ({}, "n_particles"),
    ({"n_particles": 1, "time": 1.0}, "n_particles = 1: must be"),
    ({"n_particles": 5, "time": 1.0, "folder": "/"}, "folder"),
    ({"n_particles": 5, "time": 1.0, "shard": 3}, "its recipe: "),
    ({"n_particles": 5, "time": 1.0, "initial": "/etc/passwd"}, "must be a name, or a file below"),
    (
        {"n_particles": 5, "time": 1.0, "initial": "a/../../b.csv"},
        "must be a name, or a file below",
    ),
    ({"n_particles": 5, "time": 1.0, "initial": "b.csv@0123456789abcdef"}, "initial = 'b.csv"),
]


@pytest.mark.parametrize(("more", "sentence"), CASES)
def test_a_case_is_checked_like_any_other(more, sentence):
    with pytest.raises(files.StoreError, match=re.escape(sentence)):
        reading.case_of(SAMPLE | more, "a.nc")


@pytest.mark.parametrize("suffix", ["nc", "csv"])
def test_samples_are_made_again(suffix, tmp_path, capsys, monkeypatch):
    """The same bits; a changed value is told with its size, and the status says so."""
    monkeypatch.chdir(tmp_path)
    words = "sample kac --algorithm bird --n-particles 5 --time 1.5 --n-draws 40 --seed 3 --output"
    assert cli.main([*words.split(), f"a.{suffix}"]) == 0
    assert cli.main(["again", f"a.{suffix}"]) == 0
    said = capsys.readouterr().out
    assert "bits: the same" in said
    assert f"again/a.{suffix}: written" in said
    assert comparing.differences(f"a.{suffix}", f"again/a.{suffix}") == []
    assert cli.main(["again", f"a.{suffix}", "--output", "."]) == 2
    assert "is where the file itself lies" in capsys.readouterr().err


def test_other_samples_are_told(tmp_path, capsys):
    case = make_case("identity", n_draws=50, n_replicates=1, seed=3)
    variables = sampling.run(case, lambda done: None)
    name = next(n for n, (_, v, _) in variables.items() if np.asarray(v).dtype.kind == "f")
    dims, values, about = variables[name]
    variables[name] = dims, values + 0.5, about
    store.write_sample(variables, tmp_path / "a.nc", case)
    assert cli.main(["again", str(tmp_path / "a.nc"), "--check"]) == 1
    said = capsys.readouterr().out
    assert f"bits: other {name}, by at most 0.5" in said
    assert list(tmp_path.iterdir()) == [tmp_path / "a.nc"]


def test_other_settings_are_other_content(tmp_path):
    """Not so what tells the commit, the sources and the sum of all."""
    case = make_case("identity", n_draws=50, n_replicates=1, seed=3)
    variables = sampling.run(case, lambda done: None)
    for seed, code in ((3, "a"), (3, "b"), (4, "a")):
        told = {"title": "t", "settings": {"seed": seed}, "code": code}
        store.write(variables, tmp_path / f"{seed}{code}.nc", **told)
    first, *others = (tmp_path / name for name in ("3a.nc", "3b.nc", "4a.nc"))
    assert [comparing.differences(first, other) for other in others] == [
        [],
        ["bits: other attribute settings"],
    ]


def test_what_differs_here_is_told_a_line_each(dataset, settings, tmp_path):
    about = dataset.attrs | {
        "source": "kacsim 0.1, commit 0+changes",
        "settings": settings | {"x": 1},
    }
    text = lines.of_figure(dataset.assign_attrs(about), "4567")
    checked = reading.plan_of({NAME: settings}, "a.png")
    recipe = lines.parsed(text, "a.png")
    told = reading.differences(reading.Order(tmp_path / "a.png", text, recipe, None, checked))
    assert len(told) == 4
    assert told[0] == "settings: other x here"
    assert told[1] == "sources: other code here to draw and reduce"
    assert told[2].startswith("versions: kacsim ")
    assert "here, kacsim 0.1 there" in told[2]
    assert told[3] == "sources: made from files with changes that no commit holds"


FOREIGN = [
    ("a.txt", b"", "carries no recipe; kinds of files that do: nc, svg"),
    ("a.svg", b"<svg/>", "carries no recipe: made by another program, or by a version before"),
    ("a.svg", b"\xff\xfe", "is not a readable svg file"),
    ("a.png", b"no picture", "is not a readable png file"),
    ("a.pdf", b"no print", "is not a readable pdf file"),
    ("a.csv", b"x\n1\n", "a.csv-metadata.json: is not there"),
    ("a.nc", b"no data", "not a readable result file"),
    ("a.html", b"<p>page</p>", "is no report with its configuration as JSON"),
]


@pytest.mark.parametrize(("name", "content", "sentence"), FOREIGN)
def test_foreign_and_damaged_files_get_one_line(name, content, sentence, tmp_path, capsys):
    (tmp_path / name).write_bytes(content)
    assert cli.main(["again", str(tmp_path / name)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert sentence in line
    assert str(tmp_path / "a.") in line


def test_the_tables_of_a_configuration_come_along(tmp_path, monkeypatch):
    """Where the workflow runs for a file they lie as they do here."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/f.csv").write_text("x,density\n0,1\n1,1\n")
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    config = {"seed": 1, "kac_own": {"initial": "mine/f.csv@0123456789ab", "scattering": "forward"}}
    making._bring_tables(config, scratch)
    found = [path for path in scratch.rglob("*") if path.is_file()]
    assert found == [scratch / "mine/f.csv"]
    assert found[0].read_text() == (tmp_path / "mine/f.csv").read_text()
