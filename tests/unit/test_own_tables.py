"""Laws of one's own: what tables become, what is refused, and what of them is in a case's id."""

import dataclasses
import itertools
import json
import math
import re
import shlex
import shutil

import numpy as np
import pytest

from kacsim import cli, kac, techniques
from kacsim.cases import make_case
from kacsim.kac import own_drawn, own_law, own_tables, samplers
from kacsim.kernels.provenance import ROOT
from kacsim.streams import PLACE, new_stream

FILE = ROOT / "docs/examples/own_initial.csv"
ANGLES = ROOT / "docs/examples/own_scattering.csv"
SIZE = {"n_draws": 5, "n_replicates": 1, "seed": 1}
CASE = {"algorithm": "bird", "n_particles": 5, "time": 1.0, **SIZE}
DRAW = {"n_particles": 5, "time": 1.0, "n_draws": 5, "seed": 1}
WORDS = shlex.split("--algorithm bird --n-particles 5 --time 1 --n-draws 5 --seed 1")
# (content of a file, what is blamed, what is allowed); 7 is an angle beyond 2 pi
WRONG = [
    ("", "line 1", "x,density"),
    ("x,y\n0,1\n1,1\n", "line 1", "x,density"),
    ("0,1\n1,1\n", "line 1", "x,density"),
    ("x,density\n", "", "two lines or more"),
    ("x,density\n0,1\n", "", "two lines or more"),
    ("x,density\n0,0\n1,0\n", "", "not 0"),
    ("x,density\n1,1\n1,2\n", "", "two lines or more"),
    ("x,density\n0,1\n1\n", "line 3: 1", "two numbers"),
    ("x,density\n0,1\n1,2,3\n", "line 3: 1,2,3", "two numbers"),
    ("x,density\n0,1\n\none,2\n", "line 4: x = 'one'", "finite number"),
    ("x,density\n0,nan\n1,2\n", "line 2: density = nan", "at least 0"),
    ("x,density\n0,1\n1,-2\n", "line 3: density = -2.0", "at least 0"),
    ("x,density\n0,1\ninf,2\n", "line 3: x = inf", "finite number"),
    ("x,density\n0,1\n-1,2\n", "line 3: x = -1.0", "must not fall"),
    (b"\xff\xfe\x00", "cannot be read", "no text"),
]
BEYOND = ("x,density\n0,1\n7,1\n", "line 3: x = 7.0", "between -6.2832 and 6.2832")


def refusal(**given):
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
        kac.draw("bird", **DRAW, **given)
    return str(error.value)


@pytest.mark.parametrize("name", samplers.LAWS)
@pytest.mark.parametrize(("content", "blamed", "allowed"), [*WRONG, BEYOND])
def test_wrong_file(name, content, blamed, allowed, tmp_path, capsys):
    """One line with the argument, the file, the line, its value and what is allowed."""
    path = tmp_path / "own.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    words = ["sample", "kac", *WORDS, f"--{name}", str(path), "--output", str(tmp_path / "a.nc")]
    if (content, blamed, allowed) == BEYOND and name == "initial":
        assert cli.main(words) in (0, None)
        return
    said = refusal(**{name: path})
    assert said.startswith(f"{name} = {str(path)!r}: {blamed}")
    assert allowed in said
    assert cli.main(words) == 2
    assert capsys.readouterr().err == f"--{said}\n"


@pytest.mark.parametrize(
    ("given", "blamed", "allowed"),
    [
        ({"initial": "f1"}, "initial = 'f1'", "one of f0, two_peaks, uniform, maxwell, or a file"),
        ({"scattering": "f0"}, "scattering = 'f0'", "one of uniform, forward, grazing, or a file"),
        ({"initial": "none.csv"}, "initial = 'none.csv'", "cannot be read: No such file"),
        ({"initial": "\0.csv"}, "initial = '\\x00.csv'", "cannot be read"),
        ({"initial": 3.0}, "initial = 3.0", "two or more numbers"),
        ({"initial": [1.0]}, "initial = [1.0]", "two or more numbers"),
        ({"initial": ["a", "b"]}, "initial = ['a', 'b']", "two or more numbers"),
        ({"initial": [0.0, math.nan]}, "initial[1] = nan", "finite number"),
        ({"initial": np.array([0.0, 1.0, 0.5])}, "initial[2] = 0.5", "must not fall"),
        ({"scattering": [0.0, 6.3]}, "scattering[1] = 6.3", "between -6.2832 and 6.2832"),
        ({"scattering": [1.0, math.inf]}, "scattering[1] = inf", "finite number"),
    ],
    ids=str,
)
def test_wrong_law(given, blamed, allowed):
    said = refusal(**given)
    assert said.startswith(f"{blamed}: ")
    assert allowed in said


def test_an_algorithm_without_such_kernels_refuses_laws(monkeypatch):
    monkeypatch.setattr(samplers, "takes_own_laws", lambda algorithm: algorithm == "poisson")
    assert refusal(initial="uniform") == "initial = 'uniform': needs one of poisson"
    assert refusal(scattering=[0.0, 1.0]) == "scattering = [0.0, 1.0]: needs one of poisson"


def test_exact_moments_take_no_laws():
    for name in samplers.LAWS:
        with pytest.raises(ValueError, match=f"^{name} = 'forward': bird has no such parameter"):
            kac.fourth_moment(1.0, 5, algorithm="bird", **{name: "forward"})


def test_the_content_of_a_file_is_in_the_id_and_in_the_recipe(tmp_path):
    """Its digest, not its place: an edited table is another case, a moved one is the same draws."""
    here, there = tmp_path / "a.csv", tmp_path / "b.csv"
    for path in (here, there):
        shutil.copy(FILE, path)
    cases = [make_case("kac", **CASE, initial=str(path)) for path in (here, there)]
    assert cases[0].id == cases[1].id
    there.write_text(there.read_text(encoding="utf-8") + "3,0\n", encoding="utf-8")
    edited = make_case("kac", **CASE, initial=str(there))
    assert edited.id != cases[1].id
    assert edited.recipe() != cases[1].recipe()
    assert json.loads(edited.recipe())[1]["initial"].startswith(str(there))
    # What was planned before the edit is refused, and not drawn from the new table.
    (problem,) = cases[1].problems()
    assert "has changed since: the digest of its content is" in problem.allowed
    assert not cases[0].problems()
    other = make_case("kac", **CASE, scattering=str(here))
    assert len({other.id, cases[0].id, make_case("kac", **CASE).id}) == 3


def test_names_of_the_papers_laws_are_the_paper():
    case = make_case("kac", **CASE)
    named = make_case("kac", **CASE, initial="f0", scattering="uniform")
    assert named == case
    assert "initial" not in case.settings()
    given = {"initial": "f0", "scattering": "uniform"}
    assert (kac.draw("bird", **DRAW, **given) == kac.draw("bird", **DRAW)).all()


def test_a_case_is_what_its_words_say():
    case = make_case("kac", **CASE, initial=str(FILE), scattering=str(ANGLES))
    for name, path in (("initial", FILE), ("scattering", ANGLES)):
        assert case.parameters[name].startswith(f"{path}@")
        assert f"--{name} {case.parameters[name]}" in case.arguments()
    again = make_case("kac", **CASE, **{name: case.parameters[name] for name in samplers.LAWS})
    assert again == case
    assert not again.problems()


def test_kernels_of_all_tables_are_compiled_once():
    from kacsim.kac import bird

    counts = []
    for table in ([0.0, 1.0], techniques.tabulate(lambda x: x, -1.0, 1.0, 5), "two_peaks"):
        kac.draw("bird", **DRAW, initial=table, engine="forward")
        counts.append(len(bird.own_forward.signatures))
    assert set(counts) == {1}


def shares(masses):
    """Return what Walker's aliases draw, by hand."""
    cut, other = own_tables.aliases(masses)
    found = np.zeros(len(masses))
    for k in range(len(masses)):
        found[k] += cut[k] / len(masses)
        found[other[k]] += (1.0 - cut[k]) / len(masses)
    return found


@pytest.mark.parametrize("masses", [[1.0], [1.0, 3.0], [5.0, 1e-9, 2.0], [*range(1, 40)]], ids=len)
def test_aliases_give_the_masses(masses):
    assert shares(masses) == pytest.approx(np.array(masses) / sum(masses), rel=1e-12)


def test_pieces_of_a_file_are_those_of_its_density():
    """Widths and masses by hand; a jump is no piece, nor is what has no mass."""
    pieces = own_tables.pieces_of([(0.0, 1.0), (2.0, 3.0), (2.0, 0.0), (3.0, 0.0), (4.0, 2.0)])
    assert pieces == [(0.0, 2.0, 0.5, 4.0), (3.0, 1.0, 1.0, 1.0)]
    assert own_tables.pieces_of([(1.0, 3.0), (3.0, 1.0)]) == [(3.0, -2.0, 0.5, 4.0)]
    assert own_tables.even(pieces[:1]) == [(0.0, 2.0, 0.5, 4.0), (0.0, -2.0, 0.5, 4.0)]


@pytest.mark.parametrize("tilt", [0.0, 1e-12, 0.4, 0.7, 0.999999999, 1.0])
def test_a_piece_inverts_its_cumulative_function(tilt):
    """From given words: u = (1 - tilt) t + tilt t**2, and never nan at either end."""
    law = own_drawn._drawn([(2.0, -3.0, tilt, 1.0)])
    drawn = map(int, np.random.default_rng(2).integers(2**63, size=50))
    for word in (0, 1, 2**11, 2**63, 2**64 - 1, *drawn):
        stream = new_stream(1)
        stream[-2:] = 0, word
        stream[PLACE] = len(stream) - 2
        t = (2.0 - own_law.in_piece(law, stream)) / 3.0
        u = 1.0 - (word >> 11) * 2.0**-53
        assert 0.0 <= t <= 1.0 + 2e-16
        assert (1.0 - tilt) * t + tilt * t**2 == pytest.approx(u, abs=1e-14)


def test_a_collision_foreseen_changes_nothing_before_it_is_settled():
    law = own_drawn.initial_law("uniform")
    state = own_law.new_state(1, 2, law, law)
    state.velocity[:], state.cos[0], state.sin[0] = (1.0, 2.0), 0.6, 0.8
    own_law.foresee(state, 0, 1, 0)
    assert state.velocity.tolist() == [1.0, 2.0]
    own_law.settle(state, 0, 0)
    assert state.velocity == pytest.approx([2.2, 2.0])


def test_every_name_has_a_law_of_mean_energy():
    """E v**2 = 3/2 of every initial law, by its pieces and what is added."""
    for name in own_tables.INITIALS[1:]:
        law = own_drawn.initial_law(name)
        squares = [a * a + a * w + w * w / 3.0 for a, w in zip(law.start, law.width, strict=True)]
        assert (np.mean(squares) if squares else 0.0) + law.spread**2 == pytest.approx(1.5)


def test_tables_differ_in_what_they_draw():
    """Negative control: no name, file or table of these is another's."""
    given = [*itertools.product(("f0", "two_peaks", "maxwell"), ("uniform", "grazing"))]
    draws = {kac.draw("bird", **DRAW, initial=a, scattering=b).tobytes() for a, b in given}
    assert len(draws) == len(given)


def test_the_kind_of_costs_is_the_same_for_all_tables():
    kinds = {make_case("kac", **CASE, initial=one).kind for one in ("uniform", str(FILE))}
    assert kinds == {"kac-bird-ancestral-own"}
    case = make_case("kac", **CASE)
    assert case.kind == "kac-bird-ancestral"
    assert dataclasses.replace(case).kind == case.kind


def test_the_example_of_the_documents_runs(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    page = (ROOT / "docs/own_physics.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"```python\n(.*?)```", page, re.S)
    exec(code, {})
    square, fourth = map(float, capsys.readouterr().out.split())
    assert square == pytest.approx(1.5, abs=0.05)
    assert 3.8 < fourth < 6.75
