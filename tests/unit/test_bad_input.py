"""Wrong input is refused before any work: one line with its name, its value and what is allowed."""

import math
import os
import subprocess
import sys

import pytest

from kacsim import cli, kac

# (configuration, key = value as the message shows it, what is allowed)
SETTINGS = [
    ("kac_fig2: {n_particle: [5]}", "kac_fig2.n_particle:", "did you mean n_particles?"),
    ("kac_fgi2: {}", "kac_fgi2:", "did you mean kac_fig2?"),
    ("sed: 3", "sed:", "did you mean seed?"),
    ("kac_fig1: {engine: sideways}", "kac_fig1.engine = 'sideways'", "'ancestral', 'forward'"),
    ("kac_fig1: {algorithm: brid}", "kac_fig1.algorithm:", "unknown key"),
    ("kac_fig1: {n_particles: 1}", "kac_fig1.n_particles = 1", "at least 2"),
    ("kac_fig3: {n_particles: [7, 1]}", "kac_fig3.n_particles[1] = 1", "at least 2"),
    ("kac_fig1: {n_particles: 5.5}", "kac_fig1.n_particles = 5.5", "integer"),
    ("kac_fig1: {n_particles: 5.0}", "kac_fig1.n_particles = 5.0", "integer"),
    ("kac_fig1: {n_particles: yes}", "kac_fig1.n_particles = True", "integer"),
    ("kac_fig1: {n_particles: .inf}", "kac_fig1.n_particles = inf", "integer"),
    ("kac_fig1: {time: 0}", "kac_fig1.time = 0", "greater than 0"),
    ("kac_fig1: {time: -2.0}", "kac_fig1.time = -2.0", "greater than 0"),
    ("kac_fig1: {time: .nan}", "kac_fig1.time = nan", "number"),
    ("kac_fig1: {time: .inf}", "kac_fig1.time = inf", "number"),
    ("kac_fig1: {time: long}", "kac_fig1.time = 'long'", "number"),
    ("kac_fig1: {time_step: [0.01, 2.0]}", "kac_fig1.time_step[1] = 2.0", "<= 1"),
    ("kac_fig1: {time_step: [0.3]}", "kac_fig1.time_step[0] = 0.3", "must divide time = 2.0"),
    ("kac_fig1: {time_step: [.nan]}", "kac_fig1.time_step[0] = nan", "number"),
    ("kac_fig1: {time_step: 1.0}", "kac_fig1.time_step = 1.0", "array"),
    ("kac_fig1: {time_step: []}", "kac_fig1.time_step = []", "at least 1"),
    ("kac_fig1: {time_step: [1.0, 1.0]}", "kac_fig1.time_step = [1.0, 1.0]", "repetitions"),
    ("kac_bias: {fixed_n_particles: 3}", "kac_bias.time_step[0] = 1.0", "n_particles / 2"),
    ("kac_fig9: {tolerance: 0}", "kac_fig9.tolerance = 0", "greater than 0"),
    ("kac_fig9: {tolerance: -1.0}", "kac_fig9.tolerance = -1.0", "greater than 0"),
    ("kac_fig9: {tolerance: 1.0e-15}", "kac_fig9.tolerance = 1e-15", "double precision"),
    ("kac_fig9: {tolerance: 1e-6}", "kac_fig9.tolerance = '1e-6'", "number"),
    ("kac_fig1: {n_draws: 0}", "kac_fig1.n_draws = 0", "at least 1"),
    (
        "kac_fig1: {n_draws: 9223372036854775808}",
        "kac_fig1.n_draws = 9223372036854775808",
        "at most",
    ),
    (
        f"techniques_exercises: {{n_points: [1{'0' * 400}]}}",
        "techniques_exercises.n_points[0]",
        "at most",
    ),
    ("kac_fig1: {n_draws: 1.5}", "kac_fig1.n_draws = 1.5", "integer"),
    ("kac_fig1: {n_replicates: -3}", "kac_fig1.n_replicates = -3", "at least 1"),
    ("bin_width: 0", "bin_width = 0", "one of [0.05, 0.1"),
    ("bin_width: -0.1", "bin_width = -0.1", "one of [0.05, 0.1"),
    ("bin_width: 0.3", "bin_width = 0.3", "one of [0.05, 0.1"),
    ("other_bin_widths: [0.5, 0]", "other_bin_widths[1] = 0", "one of [0.05, 0.1"),
    ("seed: -1", "seed = -1", "at least 0"),
    ("seed: 1.5", "seed = 1.5", "integer"),
    ("kac_fig5: {tail_threshold: [9.0]}", "kac_fig5.tail_threshold[0] = 9.0", "at most"),
    ("kac_fig6: {drawn_tolerance: 1.0e-7}", "kac_fig6.drawn_tolerance = 1e-07", "tolerance"),
    ("kac_fig7: {n_particles: 4}", "kac_fig7.n_particles = 4", "3"),
    ("kac_fig1: 3", "kac_fig1 = 3", "object"),
    ("kac_fig1: [1]", "kac_fig1 = [1]", "object"),
    ("kac_fig1:", "kac_fig1 = None", "object"),
    ("batch_seconds: -1", "batch_seconds = -1", "at least 0"),
    ("boltzmann_fig9: {large_turn: [7.0]}", "boltzmann_fig9.large_turn = [7.0]", "among turn"),
    ("boltzmann_extension: {n_draws: [5]}", "boltzmann_extension.n_draws = [5]", "per value of"),
]
FILES = [
    ("", "is empty"),
    ("# nothing\n", "is empty"),
    ("[1, 2]", "is a list"),
    ("just words", "is a str"),
    ("a: [", "is not YAML"),
    ("a: b: c", "is not YAML"),
    ("\ta: 1", "is not YAML"),
    (b"\xff\xfe\x00", "is not YAML"),
]


def run(capsys, *words):
    """Run a command that must fail; return its lines on stderr."""
    assert cli.main([str(word) for word in words]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    return output.err.splitlines()


def file_of(tmp_path, content):
    path = tmp_path / "wrong.yaml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(("content", "shown", "allowed"), SETTINGS, ids=[s[0] for s in SETTINGS])
def test_wrong_setting(content, shown, allowed, tmp_path, capsys):
    """One line: the file that sets the key, the key with its value, what is allowed."""
    (line,) = run(capsys, "plan", "--config", file_of(tmp_path, content))
    file, _, message = line.partition(": ")
    assert file.endswith("wrong.yaml")
    assert message.startswith(shown)
    assert allowed in message[len(shown) :]


def test_all_errors_are_listed_at_once(tmp_path, capsys):
    content = "seed: -1\nkac_fig1: {time: 0, n_draws: 0}\nkac_fig9: {tolernce: 1.0}"
    lines = run(capsys, "plan", "--config", file_of(tmp_path, content))
    assert len(lines) == 4
    for key in ("seed = -1", "kac_fig1.time = 0", "kac_fig1.n_draws = 0", "kac_fig9.tolernce"):
        assert sum(key in line for line in lines) == 1


def test_all_errors_of_the_physics_are_listed_at_once(tmp_path, capsys):
    content = "kac_fig1: {time_step: [2.0, 0.3]}\nkac_fig9: {tolerance: 1.0e-15}"
    lines = run(capsys, "plan", "--config", file_of(tmp_path, content))
    assert len(lines) == 3


def test_the_file_that_sets_the_key_is_named(tmp_path, capsys):
    good = tmp_path / "good.yaml"
    good.write_text("seed: 3\nkac_fig1: {n_particles: 7}\nother_bin_widths: [0.1]\n")
    wrong = file_of(tmp_path, "kac_fig1: {time: 0}\nother_bin_widths: [0.0]\n")
    lines = run(capsys, "plan", "--config", wrong, good)
    assert [line.split(": ")[0][-10:] for line in lines if "time" in line] == ["wrong.yaml"]
    lines = run(capsys, "plan", "--config", good, wrong)
    assert {line.split(": ")[0][-10:] for line in lines} == {"wrong.yaml"}


@pytest.mark.parametrize(("content", "reason"), FILES, ids=[repr(f[0]) for f in FILES])
def test_wrong_file(content, reason, tmp_path, capsys):
    (line,) = run(capsys, "plan", "--config", file_of(tmp_path, content))
    assert f"wrong.yaml: {reason}" in line


def test_missing_file_and_folder(tmp_path, capsys):
    (line,) = run(capsys, "plan", "--config", tmp_path / "none.yaml")
    assert "none.yaml: cannot be read: No such file" in line
    (line,) = run(capsys, "plan", "--config", tmp_path)
    assert "cannot be read: Is a directory" in line


@pytest.mark.parametrize(
    "words",
    [
        ["plan", "--item", "kac_fig99", "--config"],
        ["reduce", "kac_fig99", "--settings", "{}", "--output"],
        ["draw", "kac_fig99", "--dataset", "a.nc", "--output"],
    ],
    ids=lambda words: words[0],
)
def test_unknown_item(words, tmp_path, capsys):
    last = tmp_path / "out.nc"
    if words[0] == "plan":
        last = file_of(tmp_path, "seed: 3")
    (line,) = run(capsys, *words, last)
    assert "item = 'kac_fig99': must be one of kac_fig1, " in line


GOOD = {
    "algorithm": "bird",
    "engine": "ancestral",
    "n_particles": 5,
    "time": 2.0,
    "n_draws": 10,
    "seed": 1,
}
NANBU = {"algorithm": "nanbu_sequential", "time_step": 0.5}
BABOVSKY = {"algorithm": "nanbu_babovsky", "time_step": 1.0}
# (changes of GOOD, the name to blame, what is allowed)
DRAWS = [
    ({"algorithm": "brid"}, "algorithm", "one of nanbu_sequential"),
    ({"engine": "sideways"}, "engine", "one of ancestral, forward"),
    ({"n_particles": 1}, "n_particles", "integer of at least 2"),
    ({"n_particles": 2.5}, "n_particles", "integer of at least 2"),
    ({"n_particles": math.inf}, "n_particles", "infinity needs ancestral poisson"),
    ({"algorithm": "poisson_printed", "n_particles": math.inf}, "n_particles", "ancestral poisson"),
    ({"algorithm": "poisson", "engine": "forward", "n_particles": math.inf}, "n_particles", "anc"),
    ({"time": 0.0}, "time", "positive finite"),
    ({"time": -2.0}, "time", "positive finite"),
    ({"time": math.nan}, "time", "positive finite"),
    ({"time": math.inf}, "time", "positive finite"),
    ({"time": "long"}, "time", "positive finite"),
    ({"time_step": 0.5}, "time_step", "bird has no such parameter"),
    ({"collision_rate": 0.0}, "collision_rate", "positive finite"),
    ({"collision_rate": math.nan}, "collision_rate", "positive finite"),
    (NANBU | {"time_step": 2.0}, "time_step", "<= 1 (0.8862 * 2.0 = 1.772)"),
    (NANBU | {"collision_rate": 2.1}, "time_step", "<= 1 (2.1 * 0.5 = 1.05)"),
    (NANBU | {"time_step": 0.3}, "time_step", "divide time = 2.0"),
    (NANBU | {"time_step": 4.0, "collision_rate": 0.1}, "time_step", "divide time = 2.0"),
    (NANBU | {"time_step": math.nan}, "time_step", "positive finite"),
    (NANBU | {"time_step": 0.0}, "time_step", "positive finite"),
    (BABOVSKY | {"n_particles": 3}, "time_step", "n_particles / 2"),
    (BABOVSKY | {"time_step": 2.0}, "time_step", "<= 1"),
    ({"n_draws": 0}, "n_draws", "integer of at least 1"),
    ({"n_draws": 2**63}, "n_draws", "must be at most 9223372036854775807"),
    ({"n_draws": 1.5}, "n_draws", "integer of at least 1"),
    ({"seed": -1}, "seed", "integer of at least 0"),
    ({"seed": 0.5}, "seed", "integer of at least 0"),
]
EQUILIBRIUM = {"n_particles": 5, "tolerance": 1e-6, "n_draws": 10, "seed": 1}
COUPLED = [
    ({"n_particles": 1}, "n_particles", "integer of at least 2"),
    ({"n_particles": math.inf}, "n_particles", "integer of at least 2"),
    ({"tolerance": 0.0}, "tolerance", "positive finite"),
    ({"tolerance": -1e-6}, "tolerance", "positive finite"),
    ({"tolerance": math.nan}, "tolerance", "positive finite"),
    ({"tolerance": 1e-15}, "tolerance", "double precision"),
    ({"energy": 0.0}, "energy", "positive finite"),
    ({"energy": math.inf}, "energy", "positive finite"),
    ({"n_draws": 0}, "n_draws", "integer of at least 1"),
    ({"seed": -1}, "seed", "integer of at least 0"),
]
PERFECT = [
    ({"n_particles": 1}, "n_particles", "integer of at least 2"),
    ({"n_particles": 1001}, "n_particles", "at most 1000"),
    ({"energy": -2.0}, "energy", "positive finite"),
    ({"energy": math.nan}, "energy", "positive finite"),
    ({"n_draws": 0}, "n_draws", "integer of at least 1"),
    ({"seed": 1.5}, "seed", "integer of at least 0"),
]
# Command-line values reach the same checks; these are refused there only.
SAMPLES = [
    ({"n_replicates": 0}, "n_replicates", "integer of at least 1"),
    ({"keep_above": "high"}, "keep_above", "number"),
    ({"keep_above": math.nan}, "keep_above", "number"),
]


def ids(table):
    return [" ".join(f"{key}={value}" for key, value in row[0].items()) for row in table]


@pytest.mark.parametrize(("change", "name", "allowed"), DRAWS, ids=ids(DRAWS))
def test_wrong_draw(change, name, allowed):
    arguments = GOOD | change
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
        kac.draw(arguments.pop("algorithm"), **arguments)
    assert str(error.value).startswith(f"{name} = {(GOOD | change)[name]!r}: ")
    assert allowed in str(error.value)


@pytest.mark.parametrize(("change", "name", "allowed"), COUPLED, ids=ids(COUPLED))
def test_wrong_draw_at_equilibrium(change, name, allowed):
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
        kac.draw_equilibrium(**(EQUILIBRIUM | change))
    assert str(error.value).startswith(f"{name} = {change[name]!r}: ")
    assert allowed in str(error.value)


@pytest.mark.parametrize(("change", "name", "allowed"), PERFECT, ids=ids(PERFECT))
def test_wrong_perfect_draw(change, name, allowed):
    good = {"n_particles": 3, "n_draws": 1, "seed": 1}
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
        kac.draw_perfect(**(good | change))
    assert str(error.value).startswith(f"{name} = {change[name]!r}: ")
    assert allowed in str(error.value)


@pytest.mark.parametrize(
    ("sampler", "change", "name", "allowed"),
    [("kac", *row) for row in DRAWS + SAMPLES] + [("kac_equilibrium", *row) for row in COUPLED],
    ids=ids(DRAWS + SAMPLES) + ["eq " + one for one in ids(COUPLED)],
)
def test_wrong_sample(sampler, change, name, allowed, tmp_path, capsys):
    """The command line refuses the same, by the flag's name, and creates nothing."""
    words = ["sample", sampler, "--output", tmp_path / "new" / "a.nc"]
    for key, value in ((GOOD if sampler == "kac" else EQUILIBRIUM) | change).items():
        words += [f"--{key.replace('_', '-')}={value}"]
    (line,) = run(capsys, *words)
    assert line.startswith(f"--{name.replace('_', '-')} = ")
    assert allowed in line
    assert os.listdir(tmp_path) == []


def test_output_that_cannot_be_written(tmp_path, capsys):
    """A file in place of the folder; refused before the 1e12 draws begin."""
    (tmp_path / "file").write_text("")
    words = [f"--{key.replace('_', '-')}={v}" for key, v in (GOOD | {"n_draws": 10**12}).items()]
    (line,) = run(capsys, "sample", "kac", *words, "--output", tmp_path / "file" / "a.nc")
    assert line.startswith(f"{tmp_path}/file/a.nc: cannot be written: ")


def test_exit_status_of_the_real_command(tmp_path):
    path = file_of(tmp_path, "seed: -1")
    command = [sys.executable, "-m", "kacsim", "plan", "--config", str(path)]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    answer = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert (answer.returncode, answer.stdout, answer.stderr.count("\n")) == (2, "", 1)
