"""The plan: case ids, items that share cases, defaults, and the command line's round trip."""

import dataclasses
import json
import math
import re
import shlex

import pytest
import yaml

from kacsim import cli, items, plan, schema, store
from kacsim.cases import Case, make_case, tiny_cases
from kacsim.jobs import sampling, stages
from kacsim.kernels.provenance import ROOT

CONFIG = ROOT / "config" / "config.yaml"
SMOKE = ROOT / "config" / "smoke.yaml"
SIZE = {"n_draws": 100000, "n_replicates": 10, "seed": 1}


@pytest.fixture(scope="module")
def full():
    return plan.Plan(plan.read_config(CONFIG), [CONFIG])


def case_of(sampler="kac", **parameters):
    bird = {"algorithm": "bird", "engine": "forward", "n_particles": 50, "time": 2.0}
    return make_case(sampler, **((bird if sampler == "kac" else {}) | parameters), **SIZE)


@pytest.mark.parametrize(
    ("case", "name"),
    [
        (case_of(), "kac-bird-forward-n50-t2-10x100000"),
        (
            case_of(algorithm="nanbu_sequential", time_step=0.01, collision_rate=0.9),
            "kac-nanbu-sequential-forward-n50-t2-dt0.01-rate0.9-10x100000",
        ),
        (
            case_of(algorithm="poisson", engine="ancestral", n_particles=math.inf, keep_above=3.0),
            "kac-poisson-ancestral-ninf-t2-above3-10x100000",
        ),
        (
            case_of("kac_equilibrium", n_particles=50, tolerance=1e-6, energy=50.0),
            "kac-equilibrium-n50-eps1e-06-e50-10x100000",
        ),
        (case_of("kac_corners", n_particles=3, tolerance=0.1), "kac-corners-n3-eps0.1-10x100000"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_case_ids_are_stable(case, name):
    """Results on disk are found again under these names."""
    assert case.id == name


@pytest.mark.parametrize(
    "change",
    [
        {"algorithm": "poisson"},
        {"engine": "ancestral"},
        {"n_particles": 51},
        {"time": 2.5},
        {"time": 20.0},
        {"collision_rate": 0.9},
        {"keep_above": 2.0},
    ],
    ids=str,
)
def test_every_parameter_is_in_the_id(change):
    assert case_of(**change).id != case_of().id


def test_the_step_is_in_the_id():
    ids = {case_of(algorithm="nanbu_sequential", time_step=step).id for step in (0.5, 0.25, 0.2)}
    assert len(ids) == 3


@pytest.mark.parametrize("case", [*tiny_cases()], ids=lambda case: case.id)
def test_every_declared_parameter_is_in_the_id_and_in_the_words(case):
    """Of every sampler, variant and engine: another value of one parameter, another case."""
    ids, words = {case.id}, {case.arguments()}
    names = case.parameters.keys() - {"algorithm"}  # it has modules and parameters of its own
    for name in names:
        value = case.parameters[name]
        other = [*value, 7.5] if isinstance(value, list) else 7.5 if value != 7.5 else 6.5
        changed = dataclasses.replace(case, parameters=case.parameters | {name: other})
        ids.add(changed.id)
        words.add(changed.arguments())
    assert len(ids) == len(words) == 1 + len(names)


def test_sizes_are_in_the_id_and_the_seed_is_not():
    first = case_of()
    assert Case("kac", first.parameters, 100000, 11, 1).id != first.id
    assert Case("kac", first.parameters, 100001, 10, 1).id != first.id
    assert Case("kac", first.parameters, 100000, 10, 2).id == first.id


def test_ids_are_unique_and_safe_file_names(full):
    known = {}
    for cases in full.cases_of.values():
        for case in cases:
            assert re.fullmatch(r"[a-z0-9.+-]+", case.id)
            assert known.setdefault(case.id, case) == case
    assert len(known) == len(full.cases)


def test_items_share_cases(full):
    """One file serves Fig. 3 and the study of the bias, and one Figs. 7 and 8."""
    ids = {name: {case.id for case in cases} for name, cases in full.cases_of.items()}
    assert ids["kac_fig7"] == ids["kac_fig8"]
    assert ids["kac_fig3"] & ids["kac_bias"]
    assert len(full.cases) < sum(map(len, ids.values()))


def test_every_item_has_a_section_and_a_description():
    properties = yaml.safe_load(plan.SCHEMA.read_text(encoding="utf-8"))["properties"]
    jobs = {"batch_seconds", "shard_seconds"}
    assert set(items.NAMES) | set(plan.COMMON) | jobs == set(properties)


def leaves(rule, path=()):
    for key, one in rule["properties"].items():
        if "properties" in one:
            yield from leaves(one, (*path, key))
        else:
            yield ".".join((*path, key)), one


SCHEMA = yaml.safe_load(plan.SCHEMA.read_text(encoding="utf-8"))


@pytest.mark.parametrize(("name", "leaf"), list(leaves(SCHEMA)), ids=lambda v: str(v)[:40])
def test_every_key_is_described_and_has_a_default(name, leaf):
    assert leaf["description"].endswith((".", "1."))
    assert "default" in leaf
    chosen = ("engine", "algorithm", "initial", "scattering")  # by words
    assert not isinstance(leaf["default"], str) or name.endswith(chosen)


def test_defaults_are_the_full_run():
    defaults, problems = schema.complete({}, plan.SCHEMA)
    assert problems == []
    assert defaults == plan.read_config(CONFIG)


@pytest.mark.parametrize("files", [[CONFIG], [CONFIG, SMOKE]], ids=["full", "smoke"])
def test_own_configurations_are_right(files, capsys):
    assert cli.main(["plan", "--config", *map(str, files), "--ids"]) == 0
    listed = capsys.readouterr().out.split()
    assert len(set(listed)) == len(listed) > 10


def test_a_later_file_overrides_single_keys():
    merged = plan.read_config(CONFIG, SMOKE)
    assert merged["kac_fig1"]["n_draws"] == 2000
    assert merged["kac_fig1"]["n_particles"] == 5


def test_plan_of_one_item(capsys, full):
    assert cli.main(["plan", "--config", str(CONFIG), "--item", "kac_fig9", "--ids"]) == 0
    listed = capsys.readouterr().out.split()
    assert listed == [case.id for case in full.cases_of["kac_fig9"]]


def test_settings_survive_json(full):
    for name in items.NAMES:
        assert json.loads(full.settings_json(name)) == full.settings[name]


def test_arguments_round_trip_through_the_command_line(full, monkeypatch, tmp_path):
    """`sample` rebuilds each case, and a few awkward ones, from the words the plan gives it."""
    awkward = [
        case_of(algorithm="poisson", engine="ancestral", n_particles=math.inf),
        case_of(algorithm="nanbu_babovsky", time_step=1.0 / 3.0, collision_rate=0.9),
        case_of(keep_above=0.0),
        case_of("kac_equilibrium", n_particles=7, tolerance=1e-9, energy=0.1 + 0.2),
    ]
    seen = []
    monkeypatch.setattr(sampling, "load", lambda case: None)
    monkeypatch.setattr(sampling, "run", lambda case, progress: seen.append(case))
    monkeypatch.setattr(store, "write", lambda *args, settings, **_: seen.append(settings))
    for case in [*full.cases.values(), *awkward]:
        seen.clear()
        words = ["sample", *shlex.split(case.arguments()), "--output", str(tmp_path / "a.nc")]
        assert cli.main(words) == 0
        assert seen == [case, case.settings()]


@pytest.mark.parametrize("name", items.NAMES)
def test_roots_of_every_stage_exist(name, full):
    """A misspelt root would never start a rerun: its code is refused."""
    roots = {stages.reduce_roots(name), stages.draw_roots(name)}
    roots |= {stages.merge_roots(case) for case in full.cases_of[name]}
    roots |= {stages.sample_roots(case) for case in full.cases_of[name]}
    for one in roots:
        assert re.fullmatch(r"[0-9a-f]{16}", stages.code(one))


def test_longer_cases_start_first():
    small, large = case_of(n_particles=5), case_of(n_particles=500)
    assert large.seconds() > small.seconds()
    assert case_of(engine="ancestral").seconds() < case_of().seconds()
