"""Mutated configurations and command lines: a valid plan, or one clear line for each mistake.

200 of each by default; ``KACSIM_FUZZ=2000`` tries more.
"""

import copy
import functools
import os
import re
import shlex

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kacsim import cli, plan, schema, store
from kacsim.cases import tiny_cases
from kacsim.jobs import sampling
from kacsim.kernels.provenance import ROOT

FILES = [str(ROOT / "config" / name) for name in ("config.yaml", "smoke.yaml")]
TRIES = int(os.environ.get("KACSIM_FUZZ", "200"))
LOOSE = settings(
    max_examples=TRIES,
    deadline=None,
    derandomize=TRIES == 200,
    suppress_health_check=list(HealthCheck),
)
NUMBERS = st.one_of(
    st.integers(-3, 3),
    st.sampled_from([10**400, -(10**30), 2**63, 1e300, -1e-300, 5e-324, 0.1, 0.3, 1e17]),
    st.floats(allow_nan=True, allow_infinity=True),
)
TEXTS = st.one_of(
    st.text(max_size=8),
    st.sampled_from(["", "$(touch x)", "a; b", "'", '"', "../../x", "inf", "nan", "１２", "\x00"]),
)
VALUES = st.recursive(
    st.one_of(st.none(), st.booleans(), NUMBERS, TEXTS),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(TEXTS, inner, max_size=2)),
    max_leaves=4,
)
# A mistake in a file, and one on a command line.
LINE = re.compile(r"config/(config|smoke)\.yaml: .+: .+")
WORD = re.compile(r"(kacsim.*|--[a-z-]+.*): .+")


@functools.cache
def good():
    return plan.read_config(*FILES)


def paths(config, path=()):
    """Yield the path of every setting and of every member of a list."""
    inside = config.items() if isinstance(config, dict) else enumerate(config)
    for key, value in inside:
        yield (*path, key)
        if isinstance(value, (dict, list)):
            yield from paths(value, (*path, key))


@st.composite
def configurations(draw):
    """Return the smoke configuration with one to three settings replaced, added or removed."""
    config = copy.deepcopy(good())
    for _ in range(draw(st.integers(1, 3))):
        *way, last = draw(st.sampled_from(sorted(paths(config), key=repr)))
        place = config
        for key in way:
            place = place[key]
        change = draw(st.sampled_from(["replace", "replace", "replace", "add", "remove"]))
        if change == "remove":
            del place[last]
        elif change == "add" and isinstance(place, dict):
            place[draw(TEXTS)] = draw(VALUES)
        else:
            place[last] = draw(VALUES)
    return config


@pytest.fixture(scope="module")
def files_are_read_once():
    """Parse the schema and the files that messages name once, not for every configuration."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(schema, "read_yaml", functools.cache(schema.read_yaml))
        patch.setattr(plan, "_read_yaml", functools.cache(plan._read_yaml))
        yield


@pytest.mark.usefixtures("files_are_read_once")
@LOOSE
@given(configurations())
def test_a_configuration_is_a_plan_or_is_refused_line_by_line(config):
    try:
        checked = plan.Plan(copy.deepcopy(config), FILES)
    except plan.PlanError as error:
        for line in str(error).split("\n"):
            assert LINE.fullmatch(line), line
        return
    for case in checked.cases.values():
        assert re.fullmatch(r"[A-Za-z0-9.+-]+", case.id)
        assert "/" not in case.id
        assert shlex.split(case.arguments())[0] == case.name


WORDS = [
    "kac --algorithm bird --n-particles 7 --time 1.7 --n-draws 5 --seed 1 --output a.nc",
    "kac --algorithm nanbu_babovsky --n-particles 7 --time 1 --time-step 0.5 --n-draws 5 --seed 1",
    "kac_equilibrium --n-particles 7 --tolerance 1e-3 --n-draws 5 --seed 1 --output a.nc",
    "bkw --speed 1 2 --time 0.5 --oversampling 1.5 --n-draws 5 --seed 1 --output a.nc",
    "trap --radius 0 1 --time 0.5 --initial bkw --n-draws 5 --seed 1 --output a.nc",
    "injection --density 1 --temperature 1 --drift 0 0 0 --half-width 1 1 1 --step 1 --n-draws 5",
    "sphere_points --generator good --dimension 2 3 --n-points 10 20 --n-draws 5 --seed 1",
]


# Of every sampler, algorithm and engine.
TINY = [f"{case.arguments()} --output a.nc" for case in tiny_cases()]


@st.composite
def commands(draw, good):
    """Return the words of a good `sample` command with one or two of them changed."""
    words = draw(st.sampled_from(good)).split()
    for _ in range(draw(st.integers(1, 2))):
        place = draw(st.integers(0, len(words) - 1))
        new = draw(st.one_of(TEXTS, NUMBERS.map(str), st.sampled_from(["--seed", "--nope", "-1"])))
        change = draw(st.sampled_from(["replace", "replace", "insert", "remove"]))
        if change == "remove" and len(words) > 1:
            del words[place]
        else:
            words[place : place + (change == "replace")] = [new]
    return ["sample", *words]


@LOOSE
@given(words=commands(WORDS))
def test_a_command_draws_or_is_refused_in_one_line(words, monkeypatch, capsys, tmp_path):
    draws_or_is_refused(words, monkeypatch, capsys, tmp_path)


@LOOSE
@given(words=commands(TINY))
def test_every_sampler_draws_or_is_refused_in_one_line(words, monkeypatch, capsys, tmp_path):
    draws_or_is_refused(words, monkeypatch, capsys, tmp_path)


@pytest.mark.parametrize("words", TINY, ids=lambda words: " ".join(words.split()[:5]))
def test_good_words_draw(words, monkeypatch, capsys, tmp_path):
    """Without this the refusals above might have another reason."""
    draws_or_is_refused(["sample", *words.split()], monkeypatch, capsys, tmp_path, good=True)


def draws_or_is_refused(words, monkeypatch, capsys, tmp_path, good=False):
    drawn = []
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sampling, "load", lambda case: None)
    monkeypatch.setattr(sampling, "run", lambda case, progress: drawn.append(case))
    monkeypatch.setattr(store, "write", lambda *given, **named: None)
    try:
        status = cli.main(words)
    except SystemExit as end:
        status = end.code
    _, err = capsys.readouterr()
    if "--help" in words or "-h" in words:
        return
    assert status in ((0,) if good else (0, 2)), err
    if status == 2:
        assert not drawn
        for line in err.removesuffix("\n").split("\n"):
            assert WORD.fullmatch(line), err
    else:
        assert drawn


def test_values_reach_no_shell(tmp_path):
    """A seed of shell words is refused; a folder with quotes and spaces works."""
    config = copy.deepcopy(good()) | {"seed": "1; touch pwned"}
    with pytest.raises(plan.PlanError, match=r"^--config: seed = '1; touch pwned'"):
        plan.Plan(config, FILES, given=("seed",))
