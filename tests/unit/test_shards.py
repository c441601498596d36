"""Shards: however many, the merged file has the bytes of the one drawn in one go."""

import dataclasses
import shlex
import tracemalloc
from pathlib import Path

import pytest

from kacsim import cli, files, plan, store
from kacsim.boltzmann import sampling as boltzmann_sampling
from kacsim.cases import make_case, tiny_cases
from kacsim.jobs import expected, sampling, shards
from kacsim.kac import replicates
from kacsim.kac import sampling as kac_sampling
from kacsim.kernels.provenance import ROOT
from kacsim.maxwell import sampling as maxwell_sampling
from kacsim.samplers import registry
from kacsim.techniques import sampling as techniques_sampling

CONFIG = ROOT / "config" / "config.yaml"
SIZE = {"n_draws": 60, "n_replicates": 5, "seed": 3}
LIMIT = 130  # of first and largest values: fewer than a case draws, more than one shard of five
KAC = ("kac", "poisson", "ancestral")


def sized(tiny, **size):
    """Return a tiny case of several draws and replicates, at four probes if it has a grid."""
    given = {name: [1.0, 1.5] if v == [1.0] else v for name, v in tiny.parameters.items()}
    if "keep_above" in given:
        given["keep_above"] = 0.5
    return make_case(tiny.name, **given, **(SIZE | size))


# Every sampler, algorithm and engine.
CASES = {}
for tiny in tiny_cases():
    words = [v for name, v in tiny.parameters.items() if name in ("algorithm", "engine")]
    CASES.setdefault((tiny.name, *words), tiny)
SHARDED = {key: tiny for key, tiny in CASES.items() if tiny.sampler.by_replicate}


def case_of(sampler, **size):
    return sized(CASES[KAC if sampler == "kac" else (sampler,)], **size)


def written(variables, case, path):
    store.write_sample(variables, path, case)
    return Path(path).read_bytes()


def drawn(case, path=None):
    return written(sampling.run(case), case, path or case.output())


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Run in a folder of its own, with limits that a few draws reach."""
    monkeypatch.chdir(tmp_path)
    for module in (replicates, kac_sampling, maxwell_sampling):
        monkeypatch.setattr(module, "KEPT", LIMIT)
    monkeypatch.setattr(boltzmann_sampling, "TOP", LIMIT)
    monkeypatch.setattr(techniques_sampling, "KEPT", LIMIT)


@pytest.mark.parametrize("key", SHARDED, ids="-".join)
def test_any_number_of_shards_gives_the_same_bytes(key, folder):
    case = sized(SHARDED[key])
    expected = drawn(case)
    for number in (1, 2, 3, case.n_replicates):
        parts = case.split(number)
        for part in parts:
            drawn(part, Path("parts") / Path(part.output()).name)
        assert written(shards.merged(parts, "parts"), case, "a.nc") == expected, number


def test_the_limits_are_reached(folder):
    """The cases above would not show a wrong merge of first or largest values otherwise."""
    names = {"kac_equilibrium": "coupling_time", "bkw": "top", "injection": "kept"}
    for sampler, name in names.items():
        assert LIMIT in sampling.run(case_of(sampler))[name][1].shape
    assert sampling.run(case_of("kac", n_draws=200))["kept_velocity"][1].size == LIMIT


def test_first_values_above_a_threshold_are_cut_at_their_limit(folder):
    case = case_of("kac", n_draws=200)
    expected = drawn(case)
    for part in case.split(3):
        drawn(part)
    assert written(shards.merged(case.split(3)), case, "a.nc") == expected


@pytest.mark.parametrize("sampler", ["kac", "kac_equilibrium", "bkw"])
def test_a_shard_of_wrong_replicates_changes_the_bytes(sampler, folder):
    """The negative control: the second shard draws the replicates of the first."""
    case = case_of(sampler, n_replicates=4)
    expected = drawn(case)
    first, second = case.split(2)
    drawn(first)
    written(sampling.run(first), second, second.output())
    assert written(shards.merged([first, second]), case, "a.nc") != expected
    drawn(second)
    assert written(shards.merged([first, second]), case, "a.nc") == expected


@pytest.mark.parametrize("number", [2, 3, 5])
def test_shards_are_a_partition_of_the_replicates(number):
    parts = case_of("kac").split(number)
    assert [k for part in parts for k in part.replicates] == list(range(5))
    assert {len(part.replicates) for part in parts} <= {5 // number, 5 // number + 1}
    whole = case_of("kac")
    for term in {*whole.amounts()} - {"case"}:
        assert sum(part.amounts()[term] for part in parts) == pytest.approx(whole.amounts()[term])
    assert len({part.output() for part in parts}) == number


def test_a_file_of_another_shard_is_refused(folder):
    first, second = case_of("kac").split(2)
    drawn(first)
    drawn(first, second.output())
    with pytest.raises(files.StoreError, match="other shard"):
        shards.merged([first, second])
    Path(second.output()).unlink()
    with pytest.raises(files.StoreError, match="2of2"):
        shards.merged([first, second])


def test_the_command_line_draws_and_merges(folder, capsys):
    case = case_of("bkw")
    expected = drawn(case, "expected.nc")
    for part in case.split(3):
        words = ["sample", *shlex.split(part.arguments()), "--output", part.output()]
        assert cli.main(words) == 0
    assert "drew 60 values" in capsys.readouterr().out
    merge = ["merge", *shlex.split(case.arguments()), "--shards", "3", "--output", "a.nc"]
    assert cli.main(merge) == 0
    assert Path("a.nc").read_bytes() == expected


@pytest.mark.parametrize("shard", ["0/3", "4/3", "1/6", "-1/2", "1/0"])
def test_a_wrong_shard_is_refused(shard, folder, capsys):
    words = ["sample", *shlex.split(case_of("kac").arguments()), f"--shard={shard}"]
    assert cli.main([*words, "--output", "a.nc"]) == 2
    assert f"--shard = '{shard}': must be k/K" in capsys.readouterr().err


@pytest.mark.parametrize("shard", ["1", "one/two", "1/2/3", "1.0/2"])
def test_text_that_is_no_shard_is_refused(shard, capsys):
    words = ["sample", *shlex.split(case_of("kac").arguments()), "--shard", shard]
    with pytest.raises(SystemExit) as stopped:
        cli.main([*words, "--output", "a.nc"])
    assert stopped.value.code == 2
    assert "must be k/K" in capsys.readouterr().err


def test_samplers_of_runs_are_not_sharded():
    runs = {name for name, sampler in registry().items() if not sampler.by_replicate}
    assert runs == {"kac_corners", "bkw_tree", "sphere_lattice", "circle_lattice"}
    for sampler in runs:
        case = case_of(sampler)
        assert shards.make_shards([case], 1e-12) == {}
        assert dataclasses.replace(case, shard=(1, 2)).problems()


def test_the_table_of_cases_tells_the_shards():
    some = plan.Plan(plan.read_config(CONFIG) | {"shard_seconds": 5.0}, [CONFIG])
    name, parts = next(iter(some.shards.items()))
    assert f"{len(parts)} shards" in expected.cases_table(some, [some.cases[name]])
    said = expected.whole(some, [some.cases[name]], ["kac_fig4"], 2)
    assert f"1 cases in {len(parts) + 1} jobs" in said


def test_the_report_tells_no_way_of_making_jobs():
    """Else its bytes would depend on the number of shards."""
    given = {"batch_seconds": 600, "shard_seconds": 5}
    assert plan.recipe_options([], given) == plan.recipe_options([], {})
    assert "seed=7" in plan.recipe_options([], given | {"seed": 7})


def test_the_plan_shards_the_long_cases_only():
    config = plan.read_config(CONFIG)
    assert plan.Plan(config, [CONFIG]).shards == {}
    some = plan.Plan(config | {"shard_seconds": 5.0}, [CONFIG])
    assert 0 < len(some.shards) < len(some.cases)
    for name, parts in some.shards.items():
        case = some.cases[name]
        one = case.seconds() / case.n_replicates
        assert case.seconds() > 5.0
        assert all(part.seconds() < 5.0 + one for part in parts)
    batched = {case.id for batch in some.batches for case in batch.cases}
    assert batched | set(some.shards) == set(some.cases)
    assert not batched & set(some.shards)


@pytest.mark.parametrize("value", [-1, "many", None, float("inf"), float("nan"), True])
def test_a_wrong_shard_seconds_is_refused(value):
    with pytest.raises(plan.PlanError, match="shard_seconds"):
        plan.Plan({"shard_seconds": value}, [CONFIG])


def test_more_replicates_ask_for_more_memory():
    few, many = case_of("kac"), case_of("kac", n_replicates=100_000)
    assert many.megabytes() > few.megabytes() > 0
    assert many.split(1000)[0].megabytes() == pytest.approx(few.megabytes(), abs=2)


@pytest.mark.parametrize("sampler", ["kac", "bkw_moment"])
def test_memory_of_merging_does_not_grow_with_the_shards(sampler, folder, monkeypatch):
    """Ten times the shards take at most what ten times the replicates of the result take.

    A shard holds some 100 kB of first values or largest ones, so that a hundred kept at once would
    take 10 MB.
    """
    for module in (replicates, kac_sampling, maxwell_sampling):
        monkeypatch.setattr(module, "KEPT", 12_000)
    monkeypatch.setattr(boltzmann_sampling, "TOP", 12_000)
    peak, size = {}, {}
    for number in (10, 100):
        parts = case_of(sampler, n_draws=12_000, n_replicates=number).split(number)
        content = sampling.run(parts[0])
        for part in parts:
            written(content, part, part.output())
        tracemalloc.start()
        merged = shards.merged(parts)
        peak[number] = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        size[number] = sum(values.nbytes for _, values, _ in merged.values())
    assert size[100] < 2_000_000
    assert peak[100] < peak[10] + size[100] - size[10] + 400_000
