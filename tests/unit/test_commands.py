"""Commands that a user calls by hand: plan, estimate, verify, and the line of progress."""

import io
import json
import shutil
import subprocess
import sys

import netCDF4
import pytest

from kacsim import boltzmann, cli, commands, kac, plan, store
from kacsim.cases import make_case
from kacsim.commands import estimate as estimating
from kacsim.commands import sample, verify
from kacsim.jobs import sampling
from kacsim.kernels.provenance import ROOT
from kacsim.samplers import registry

CONFIG = ROOT / "config" / "config.yaml"


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_every_parameter_has_a_meaning_in_the_help(capsys):
    """Of every sampler; line ends and columns of the help aside."""
    for sampler in registry().values():
        shown = help_of(capsys, "sample", sampler.name)
        assert f"Draw {sampler.draws}." in shown
        for parameter in sampler.parameters_of({}):
            assert len(parameter.meaning) > 10
            assert parameter.meaning in shown
            assert f"--{parameter.name.replace('_', '-')} " in shown


def help_of(capsys, *words):
    with pytest.raises(SystemExit) as end:
        cli.main([*words, "--help"])
    assert end.value.code == 0
    return " ".join(capsys.readouterr().out.split())


# (sampler, parameter, what its help must say, what it must not: it was so, and wrong)
HELP = [
    ("kac", "keep_above", "first values of v_1 above this", "|v_1|"),
    ("sphere_points", "generator", "good, exhausted, congruential or sobol", ""),
    ("kac_probe", "speed", "in the unit of the paper", "RMS"),
    ("kac_probe", "time", "of the Kac paper", "collision times"),
    ("bkw", "speed", "in RMS velocities per axis", ""),
    ("bkw", "time", "in mean collision times", "Kac"),
    ("trap", "time", "in 1 / omega", "Kac"),
    ("inversion", "rate", "rate of the law", "exponential"),
]


@pytest.mark.parametrize(("sampler", "name", "says", "says_not"), HELP)
def test_help_is_true(sampler, name, says, says_not, capsys):
    shown = help_of(capsys, "sample", sampler)
    _, _, mine = shown.rpartition(f"--{name.replace('_', '-')} {name.upper()} ")
    mine = mine.split(" --")[0]
    assert says in mine
    assert not says_not or says_not not in mine


@pytest.mark.parametrize("command", commands.NAMES)
def test_help_shows_an_example(command, capsys):
    with pytest.raises(SystemExit) as end:
        cli.main([command, "--help"])
    assert end.value.code == 0
    shown = capsys.readouterr().out
    assert f"kacsim {command}" in shown.split("example:")[1]


@pytest.mark.skipif(not shutil.which("bash"), reason="no bash")
@pytest.mark.parametrize(
    ("words", "offered"),
    [
        (["ver"], ["verify"]),
        (["estimate", ""], list(estimating.ESTIMATORS)),
        (["sample", "kac", "--alg"], ["--algorithm"]),
    ],
)
def test_the_shell_completes_commands(words, offered, capsys):
    with pytest.raises(SystemExit):
        cli.main([cli.COMPLETION, "bash"])
    script = capsys.readouterr().out + (
        f"COMP_WORDS=(kacsim {' '.join(word or chr(34) * 2 for word in words)})\n"
        f"COMP_CWORD={len(words)}; _shtab_kacsim; echo ${{COMPREPLY[@]}}"
    )
    shown = subprocess.run(["bash"], input=script, capture_output=True, text=True, check=True)
    assert shown.stdout.split() == offered


@pytest.mark.parametrize("command", ["plan", "kept"])
def test_a_package_without_its_clone_says_so(command, monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(plan, "SCHEMA", tmp_path / "config.schema.yaml")
    assert cli.main([command]) == 2
    assert capsys.readouterr().err.startswith(f"kacsim {command}: needs a clone of the project;")


def test_plan_is_a_table_with_costs(capsys):
    assert cli.main(["plan", "--config", str(CONFIG), "--item", "kac_fig9"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["stage", "seconds", "draws", "job", "case", "for"]
    assert all("kac_fig9, kac_numbers" in line for line in lines[1:3])
    assert lines[4].split() == ["item", "cases", "jobs", "in", "kernels", "seconds"]
    assert lines[5].split()[0] == "kac_fig9"
    assert len(lines) == 3 + 1 + 2 + 1 + 1
    assert lines[-1].startswith("2 cases in ")


ESTIMATES = [
    (
        "kac --v 2.5 --time 0.7",
        kac.estimate_density,
        {"v": 2.5, "time": 0.7, "method": "ancestral"},
    ),
    ("kac-tail --v 2.5 --time 0.7", kac.estimate_tail, {"v": 2.5, "time": 0.7}),
    (
        "bkw --velocity 1 0.5 -2 --time 0.7 --rms-velocity 1.7",
        boltzmann.estimate_bkw,
        {"velocity": [1.0, 0.5, -2.0], "time": 0.7, "rms_velocity": 1.7, "method": "best"},
    ),
    (
        "trap --position 2 --velocity 0.3 --time 1 --initial breathing",
        boltzmann.estimate_trap,
        {"position": 2.0, "velocity": 0.3, "time": 1.0, "initial": "breathing"},
    ),
    (
        "extinction --time 1 --rate 2 --initial 0.7 --majorant 2.5",
        boltzmann.estimate_extinction,
        {"time": 1.0, "rate": 2.0, "initial": 0.7, "majorant": 2.5},
    ),
]


@pytest.mark.parametrize(("words", "function", "given"), ESTIMATES)
def test_estimate_is_the_function(words, function, given, capsys):
    size = ["--n-realizations", "500", "--seed", "3"]
    assert cli.main(["estimate", *words.split(), *size, "--json"]) == 0
    expected = function(**given, n_realizations=500, seed=3)
    assert json.loads(capsys.readouterr().out) == vars(expected)
    assert cli.main(["estimate", *words.split(), *size]) == 0
    shown = capsys.readouterr().out
    assert f"{expected.mean:.6g} ± {expected.standard_error:.2g}" in shown


def test_all_estimators_are_commands():
    public = {name for module in (kac, boltzmann) for name in module.__all__}
    functions = {function for _, function, _ in estimating.ESTIMATORS.values()}
    typed = {name for name in public if name.startswith("estimate_")}
    # An initial law is an object.
    assert functions == {name for name in typed if not name.startswith("estimate_relaxation")}


@pytest.mark.parametrize(
    ("words", "last"),
    [
        ("bkw --velocity 4 --time 10 --n-realizations 50", "method ancestral"),
        ("bkw --velocity 4 --time 1 --oversampling 1.5", "method branching"),
        ("bkw-fraction --threshold 2 --time 40", "method ancestral"),
        ("kac-tail --v 6 --time 2", "method ancestral"),
        (
            "bkw --velocity 1 --time 2.4 --method branching",
            "the exact variance is infinite there: the error cannot be believed; "
            "--method ancestral serves",
        ),
        (
            "kac --v 0.5 --time 1.4 --method branching",
            "the exact variance is infinite there: the error cannot be believed; "
            "--method ancestral serves",
        ),
        ("bkw --velocity 1 --time 2.3 --method branching", "method branching"),
    ],
)
def test_an_estimate_says_which_method_serves(words, last, capsys):
    assert cli.main(["estimate", *words.split()]) == 0
    assert capsys.readouterr().out.strip().endswith(last)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("bkw --velocity 1 --time -1", "--time = -1.0: must"),
        ("bkw --velocity nan --time 1", "--velocity = nan: must"),
        ("bkw --velocity 1 --time 1 --n-realizations 1", "--n-realizations = 1: must"),
        ("bkw --velocity 1 --time 1 --n-realizations many", "--n-realizations = 'many': must"),
        ("trap --position 1 --velocity 0 --time 1 --initial warm", "--initial = 'warm': must"),
        ("extinction --time 1 --rate 1 --initial 1 --majorant 0", "--majorant = 0.0: must"),
        ("bkw --velocity 1 --time 9 --max-nodes 10 --method branching", "max_nodes: a tree has"),
        ("bkw --velocity 1 --time 9 --method tree", "--method = 'tree': must be one of"),
        ("bkw --velocity 1 --time 20 --method ancestral", "--time = 20.0: a tree has 5e+08 leaves"),
        ("bkw --velocity 0 --time 1 --method free_leaf", "--velocity = 0.0: needs method"),
        ("bkw --velocity 1 --time 1 --cut 1 --method branching", "--cut = 1.0: needs method"),
        ("kac-tail --v 300 --time 1", "--v = 300.0: must be at most 100"),
        ("kac-tail --v 60 --time 1", "the probe lies where double precision"),
    ],
)
def test_wrong_estimate(words, message, capsys):
    assert cli.main(["estimate", *words.split()]) == 2
    assert capsys.readouterr().err.startswith(message)


@pytest.fixture
def drawn(tmp_path, monkeypatch):
    """Return a case whose samples lie where the workflow keeps them."""
    monkeypatch.chdir(tmp_path)
    given = {"algorithm": "bird", "engine": "ancestral", "n_particles": 7, "time": 1.7}
    case = make_case("kac", **given, n_draws=500, n_replicates=2, seed=9)
    words = [*case.arguments().split(), "--output", case.output()]
    assert cli.main(["sample", *words]) == 0
    return case


def test_verify_finds_the_same_bits(drawn):
    assert verify.verify(drawn, "results/samples")[0] == verify.EQUAL


def test_verify_finds_one_wrong_count(drawn):
    """A file that is whole, with one draw in another bin."""
    variables = sampling.run(drawn)
    variables["counts"][1][1, 40] += 1
    store.write_sample(variables, drawn.output(), drawn)
    state, sentence = verify.verify(drawn, "results/samples")
    assert state == verify.DIFFERENT
    assert "differs in counts" in sentence
    assert drawn.output() in sentence


def test_verify_finds_a_flipped_bit(drawn):
    with netCDF4.Dataset(drawn.output(), "a") as file:
        file["counts"][1, 40] += 1
    state, sentence = verify.verify(drawn, "results/samples")
    assert state == verify.DIFFERENT
    assert "not a readable result file" in sentence


def test_verify_of_a_missing_file(drawn):
    shutil.rmtree("results")
    assert verify.verify(drawn, "results/samples")[0] == verify.MISSING
    assert cli.main(["verify", "--config", str(CONFIG), "--cases", "1"]) == 1


@pytest.mark.parametrize("number", ["0", "-1", "many"])
def test_verify_wants_cases(number, capsys):
    assert cli.main(["verify", "--config", str(CONFIG), "--cases", number]) == 2
    assert "--cases = " in capsys.readouterr().err


def of_4000_draws():
    given = {"algorithm": "bird", "engine": "ancestral", "n_particles": 7, "time": 1.7}
    return make_case("kac", **given, n_draws=1000, n_replicates=4, seed=9)


def test_progress_on_a_terminal_shows_share_throughput_and_time_left(monkeypatch):
    """A quarter is done after 1.9 seconds of a made-up clock."""
    clock = [0.0]
    monkeypatch.setenv("COLUMNS", "120")
    monkeypatch.setattr("tqdm.std.time", lambda: clock[0])
    monkeypatch.setattr(sys, "stderr", Terminal())
    with sample.progress(of_4000_draws()) as advance:
        clock[0] = 1.9
        advance(1000)
        shown = sys.stderr.getvalue().split("\r")[-1]
    assert shown.startswith("kac-bird-ancestral-n7-t1.7-4x1000:  25%|")
    assert shown.rstrip().endswith("| 1.00k/4.00k [00:01<00:05, 526draws/s]")
    assert sys.stderr.getvalue().split("\r")[-2].strip() == ""  # the line is taken away


def test_progress_is_silent_in_a_log(monkeypatch):
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    with sample.progress(of_4000_draws()) as advance:
        sampling.run(of_4000_draws(), advance)
    assert sys.stderr.getvalue() == ""


def test_samples_as_text(tmp_path, drawn):
    words = [*drawn.arguments().split(), "--output", str(tmp_path / "a.csv")]
    assert cli.main(["sample", *words]) == 0
    lines = (tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("replicate,")
    counts = store.read_sample(drawn.output(), drawn)["counts"].values
    column = lines[0].split(",").index("counts [1]")
    found = [
        int(cells[column]) for cells in (line.split(",") for line in lines[1:]) if cells[column]
    ]
    assert found == counts.ravel().tolist()
