"""The benchmark: what it counts, how it tells it, and what it does where something is not there."""

import os
import re
import subprocess
import sys

import numpy as np
import pytest

from kacsim import benchmark, cli
from kacsim.benchmark import counts, floors, native, peers, pieces, stages, timing, words
from kacsim.kernels.provenance import ROOT
from kacsim.streams import new_stream


@pytest.mark.parametrize("n", [0, 1, 255, 256, 257, 1000])
@pytest.mark.parametrize("begun", [0, 3, 256])
def test_words_are_counted_from_states(n, begun):
    """However they are taken, by calls or in blocks."""
    before = new_stream(5, "words")
    words.add_by_calls(begun, before)
    by_calls, in_blocks = before.copy(), before.copy()
    assert words.add_by_calls(n, by_calls) == words.add_in_blocks(n, in_blocks)
    assert words.used(before, by_calls) == words.used(before, in_blocks) == n


def test_a_state_of_another_stream_is_refused():
    with pytest.raises(ValueError, match="within 10 blocks"):
        words.used(new_stream(1), new_stream(2), 10)


def test_words_are_copied_to_and_fro():
    source, target = np.arange(4.0), np.zeros(4)
    words.move(source, target, 3)
    assert target.tolist() == [0.0, 1.0, 2.0, 0.0]
    target[:] = 7.0
    words.move(source, target, 6)  # four there, two back
    assert source.tolist() == target.tolist() == [0.0, 1.0, 2.0, 3.0]


def test_bytes_are_counted_where_elements_are_read_and_written(monkeypatch):
    monkeypatch.setattr(counts.Counted, "moved", 0)

    def moved(action):
        before = counts.Counted.moved
        action()
        return counts.Counted.moved - before

    one, small = np.arange(6.0).view(counts.Counted), np.zeros(3, np.int32).view(counts.Counted)
    table = one.reshape(2, 3)
    assert moved(lambda: one[2]) == 8
    assert moved(lambda: small[2]) == 4
    assert moved(lambda: table[1, 2]) == 8
    assert moved(lambda: one[1:4]) == moved(lambda: table[1]) == 0
    assert moved(lambda: one[1:4][0]) == 8
    assert moved(lambda: one.__setitem__(0, 2.0)) == 8
    assert moved(lambda: one.__setitem__(slice(None), 2.0)) == 48
    assert moved(lambda: one.__setitem__(slice(0, 3), one[3:])) == 48
    assert moved(lambda: one.argmax()) == moved(lambda: table.sum()) == 48


@pytest.fixture(scope="module")
def found():
    """Return the counts of all kernels, of as few draws as there can be."""
    return counts.counted(300)


def test_forward_bird_is_counted_exactly(found):
    """50 particles and 45 collisions; a speed that its strip does not settle at once reads more."""
    count = found["Bird forward, N = 50"]
    calls = count["calls"]
    per_draw = 50 / calls["maxwell_speed"]
    exact = {"maxwell_speed": 50, "random_sign": 50, "pair_below": 45, "unit_circle": 45}
    assert {name: round(per_draw * share, 9) for name, share in calls.items()} == exact
    velocities = 50 * 8 + 45 * 4 * 8 + 8 + 8 + 8  # v, v_1 read, it and `own` written
    tables = 50 * 3 * 8 + 45 * 2 * 8  # of a strip; cosine and sine of a point
    assert velocities + tables <= count["bytes"] * per_draw <= 1.1 * (velocities + tables)
    assert count["room"] >= 50 * 8


def test_every_function_that_is_counted_is_timed(found):
    assert found.keys() == benchmark.standard_works().keys()
    for name, count in found.items():
        assert set(count["calls"]) <= set(pieces.PIECES), name
        assert count["bytes"] > 8.0
        assert sum(count["calls"].values()) > 0.5, name


def test_a_floor_is_told_for_one_unit():
    times = {"kernel": 8e-6, "calls": 2e-6, "blocks": 1e-6, "copy": 4e-6}
    count = {"bytes": 20.0, "calls": {"exp": 0.5, "uniform": 1.0}}
    floor = floors.told("node", times, 1000, 4000, count, {"exp": 1e-9, "uniform": 0.25e-9})
    assert (floor.words, floor.bytes) == (4.0, 80.0)
    assert floor.pieces == {
        "exp": (2.0, pytest.approx(2e-9)),
        "uniform": (4.0, pytest.approx(1e-9)),
    }
    cells = ("8.00", "4.00", "2.00", "4.00", "1.00", "8.00", "80.0", "4.00", "2.00", "3.00", "2.67")
    assert floors.row("tree", floor) == ("tree", "node", *cells)
    assert len(floors.HEAD) == len(floors.row("tree", floor))
    assert floors.pieces_of("tree", floor) == (
        "tree, per node: 2.00 exp 2.00 ns, 4.00 uniform 1.00 ns"
    )
    with pytest.raises(LookupError, match="exp: not timed in kacsim"):
        floors.told("node", times, 1000, 4000, count, {"uniform": 1e-9})


def test_numbers_and_lines_of_a_table():
    assert [floors.number(x) for x in (0.123, 9.949, 9.95, 99.4, 99.5, 12345.6)] == [
        "0.12",
        "9.95",
        "9.9",
        "99.4",
        "100",
        "12346",
    ]
    assert (
        "\n".join(floors.lines([("a", "b"), ("1", "2")])) == "| a | b |\n| --- | --- |\n| 1 | 2 |"
    )


def test_stages_of_a_draw_add_up():
    of_functions = {"maxwell_energies": 8, "squared_cosines": 4, "random_sign": 1, "exponential": 9}
    told = stages.of(60.0, 50.0, {name: (1.0, cost) for name, cost in of_functions.items()})
    assert told == (60.0, 37.0, 9.0, 8.0, 4.0, 10.0, 1.0)
    assert told.draw == sum(told[1:]) - told.variates


def test_medians_are_taken_in_turns(monkeypatch):
    asked = []
    monkeypatch.setattr(timing, "seconds", lambda call: asked.append(call()) or len(asked))
    taken = timing.medians({"a": lambda: "a", "b": lambda: "b"}, 3)
    assert asked == list("ababab")
    assert taken == {"a": 3, "b": 4}


def test_draws_fill_the_span(monkeypatch):
    def seconds(call):
        return 1e-3 * call()

    monkeypatch.setattr(timing, "seconds", seconds)
    assert timing.draws_for(lambda n: n, span=1.0) == 1000
    assert timing.draws_for(lambda n: 5000.0 * n, span=1.0) == 2


def test_parts_are_chosen_by_options(monkeypatch):
    asked = []
    monkeypatch.setattr(benchmark, "run", lambda *given: asked.append(given))
    for words_ in ((), ("--floors",), ("--floors", "--peers", "--repeats", "2")):
        cli.main(["benchmark", *words_])
    assert asked == [(["goals"], 5), (["floors"], 5), (["floors", "peers"], 2)]


def test_without_a_compiler_c_is_left_out(monkeypatch, capsys):
    monkeypatch.setattr(native.shutil, "which", lambda name: None)
    monkeypatch.setattr(peers, "compare", lambda *_: None)
    assert set(peers.peers(1)) == set(peers.NAMES) - set(native.PEERS)
    peers.run(1)
    assert capsys.readouterr().out == "no C compiler is there (cc, gcc, clang): C is left out\n"


@pytest.mark.skipif(native.compiler() is None, reason="no C compiler")
def test_what_the_compiler_refuses_is_said(monkeypatch, tmp_path):
    wrong = tmp_path / "wrong.c"
    wrong.write_text("int wrong(void) { return x; }\n")
    monkeypatch.setattr(native, "SOURCE", wrong)
    with pytest.raises(RuntimeError, match=r"wrong\.c"):
        native.library.__wrapped__()


def compared(*given):
    command = [sys.executable, str(ROOT / "tests" / "compare_speed.py"), *given]
    return subprocess.run(command, cwd=ROOT, env=os.environ, capture_output=True, text=True)


def test_two_states_are_compared_in_turns():
    done = compared("--repeats", "1", "--only", "BKW", str(ROOT), str(ROOT))
    assert done.returncode == 0, done.stderr
    head, _, row = done.stdout.splitlines()
    assert len(head.split("|")) == len(row.split("|"))
    assert re.match(r"\| BKW tree, t = 2 \| [\d.]+ \| [\d.]+ \| \d+\.\d\d \| ", row)


def test_a_state_that_there_is_not_is_refused():
    done = compared("xyzzy", str(ROOT))
    assert done.returncode == 1
    assert done.stderr.startswith("xyzzy: neither a folder nor a commit of ")
