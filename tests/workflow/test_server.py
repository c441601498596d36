"""Jobs forked from one warmed process: what they see, how they end, and that they leave nothing."""

import os
import re
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from kacsim.jobs import client

ROOT = Path(__file__).parents[2]
HOLD = """
import os, sys
from kacsim.jobs import server
server.start(sys.argv[1])
print(os.environ["KACSIM_SERVER"], server.start.process.pid, flush=True)
sys.stdin.read()
"""
LONG = [
    *("sample", "kac", "--algorithm", "bird", "--n-particles", "50", "--time", "2"),
    *("--n-draws", "200000", "--n-replicates", "100000", "--seed", "7", "--output", "long.nc"),
]

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="jobs are forked on Linux only")


@pytest.fixture
def served(tmp_path):
    """Return (process that holds a server, its address, the server's process id)."""
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(ROOT)],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    address, number = holder.stdout.readline().split()
    yield holder, address, int(number)
    holder.kill()
    holder.wait()


def start(words, address, folder, **keywords):
    environment = {**os.environ, client.ADDRESS: address, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-S", "-E", client.__file__, *words]
    return subprocess.Popen(command, cwd=folder, env=environment, text=True, **keywords)


def finish(words, address, folder):
    job = start(words, address, folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    out, err = job.communicate(timeout=60)
    return job.returncode, out, err


def children(number):
    tasks = Path(f"/proc/{number}/task/{number}/children")
    return [int(word) for word in tasks.read_text().split()]


def until(condition, seconds=20.0):
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.02)


def gone(number):
    try:
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except FileNotFoundError:
        return True


def test_a_job_is_what_a_process_of_its_own_is(served, tmp_path):
    """Status, both streams and the folder are the job's own; the server imports, it only forks."""
    _, address, number = served
    words = [*LONG[:-7], "5", "--n-replicates", "2", "--seed", "7", "--output", "small.nc"]
    for folder, where in ((tmp_path / "with", address), (tmp_path / "without", "/absent")):
        folder.mkdir()
        status, out, err = finish(words, where, folder)
        assert (status, err) == (0, "")
        assert re.fullmatch(r"drew 10 values of kac-bird-ancestral-n50-t2-2x5 in [\d.]+ s\n", out)
        status, out, err = finish(["reduce", "nothing", "--settings", "{}", "--output", "x"],
                                  where, folder)  # fmt: skip
        assert (status, out) == (2, "")
        assert err.startswith("item = 'nothing': must be one of ")
        status, out, err = finish(["plan", "--help"], where, folder)
        assert status == 0
        assert out.startswith("usage: kacsim plan")
    first, second = ((tmp_path / name / "small.nc").read_bytes() for name in ("with", "without"))
    assert first == second
    assert children(number) == []


def test_a_job_ends_with_its_client(served, tmp_path):
    """Whichever way the client is ended, its job ends and leaves no file."""
    _, address, number = served
    for how in (signal.SIGTERM, signal.SIGINT, signal.SIGKILL):
        job = start(LONG, address, tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until(lambda: children(number))
        time.sleep(0.5)
        job.send_signal(how)
        assert job.wait() != 0
        until(lambda: not children(number))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
def test_jobs_and_server_end_with_the_run(served, tmp_path, how):
    """No orphan goes on to write when Snakemake is killed; the socket's folder goes too."""
    holder, address, number = served
    job = start(LONG, address, tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    until(lambda: children(number))
    (child,) = children(number)
    holder.send_signal(how)
    until(lambda: gone(number) and gone(child))
    assert job.wait(timeout=20) != 0
    until(lambda: not Path(address).parent.exists())
    assert list(tmp_path.iterdir()) == []


def test_a_run_goes_on_without_its_server(served, tmp_path):
    """The job that it served fails with one line; later ones take a process of their own."""
    _, address, number = served
    job = start(LONG, address, tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    until(lambda: children(number))
    (child,) = children(number)
    os.kill(number, signal.SIGKILL)
    _, err = job.communicate(timeout=20)
    assert (job.returncode, err.splitlines()[-1]) == (
        1,
        "kacsim: the process that served the jobs of this run has ended",
    )
    until(lambda: gone(child))
    status, out, _ = finish(["plan", "--help"], address, tmp_path)
    assert status == 0
    assert out


def test_jobs_that_compile_share_a_process(served, tmp_path, monkeypatch):
    """One after the other, with streams and status of their own; two at a time take two.

    After a failure there is another one.
    """
    holder, address, number = served
    monkeypatch.setenv("KACSIM_CACHE_DIR", str(tmp_path / "kernels"))
    unit = "techniques/integration.sphere_points.count_good"
    assert finish(["compile", unit, "--output", "good.txt"], address, tmp_path) == (0, "", "")
    (child,) = children(number)
    for folder, where in ((tmp_path / "with", address), (tmp_path / "without", "/absent")):
        folder.mkdir()
        words = ["compile", "techniques/circles.circle_lattice", "--output", "lattice.txt"]
        assert finish(words, where, folder) == (0, "", "")
    first, second = ((tmp_path / name / "lattice.txt") for name in ("with", "without"))
    assert first.read_bytes() == second.read_bytes()
    assert children(number) == [child]
    two = [start([*words[:-1], name], address, tmp_path) for name in ("a.txt", "b.txt")]
    assert [job.wait(timeout=60) for job in two] == [0, 0]
    assert child in children(number)
    for _ in range(3):
        status, out, err = finish(["compile", "nothing", "--output", "x.txt"], address, tmp_path)
        assert (status, out) == (2, "")
        assert "invalid choice: 'nothing'" in err
    until(lambda: not children(number))
    assert finish(["compile", unit, "--output", "good.txt"], address, tmp_path) == (0, "", "")
    (child,) = children(number)
    holder.kill()
    until(lambda: gone(number) and gone(child))


def test_a_job_that_compiles_ends_with_its_client(served, tmp_path, monkeypatch):
    """Its process ends with it; the next job takes another."""
    _, address, number = served
    monkeypatch.setenv("KACSIM_CACHE_DIR", str(tmp_path / "kernels"))
    unit = "kac/perfect.kac_corners"  # some seconds
    job = start(["compile", unit, "--output", "corners.txt"], address, tmp_path)
    until(lambda: children(number))
    job.send_signal(signal.SIGTERM)
    assert job.wait() != 0
    until(lambda: not children(number))
    unit = "techniques/integration.sphere_points.count_good"
    assert finish(["compile", unit, "--output", "good.txt"], address, tmp_path) == (0, "", "")


def test_a_job_may_be_answered_before_its_client_goes_on(tmp_path, monkeypatch):
    """A short one is: its client has nothing more to send then, and sends nothing."""
    address, listening = str(tmp_path / "jobs"), socket.socket(socket.AF_UNIX)
    listening.bind(address)
    listening.listen()

    def answer():
        connection, _ = listening.accept()
        _, descriptors, _, _ = socket.recv_fds(connection, client.LONGEST, 3)
        connection.sendall(b"7")
        for one in (connection, listening):
            one.close()
        for descriptor in descriptors:
            os.close(descriptor)

    answering, send = threading.Thread(target=answer), socket.send_fds
    answering.start()

    def send_and_wait(*request):
        sent = send(*request)
        answering.join()
        return sent

    monkeypatch.setattr(socket, "send_fds", send_and_wait)
    monkeypatch.setattr(signal, "signal", lambda *handler: None)
    monkeypatch.setattr(os, "execv", lambda *command: pytest.fail("the job is done again"))
    monkeypatch.setenv(client.ADDRESS, address)
    assert client.main(["compile"]) == 7
