"""One warmed process from which the jobs of a run are forked: imports are paid once, not per job.

It is started by Snakemake on Linux, ends with it, however that ends, and serves `client.py`. A job
keeps its own process, log, status and benchmark; one whose client goes away is told to end. Jobs
that compile share a process, one after the other: kernels share most of what they are built from.
"""

import atexit
import contextlib
import gc
import importlib
import json
import os
import pkgutil
import selectors
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

import kacsim
from kacsim.jobs.client import ADDRESS, LONGEST

SET_DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of linux/prctl.h
# What libraries import late by themselves.
LATE = (
    "matplotlib.backends.backend_agg",
    "matplotlib.backends.backend_pdf",
    "matplotlib.backends.backend_svg",
    "numba.core.runtime.nrt",
    "scipy.special",
    "xarray.backends.netCDF4_",
)


def start(root):
    """Start a server for the jobs of this process; they find it by the environment.

    Parameters
    ----------
    root : Path, the folder of the package
    """
    if sys.platform != "linux":  # elsewhere the system's libraries do not survive a fork
        return
    address = str(Path(tempfile.mkdtemp(prefix="kacsim-")) / "jobs")
    environment = {**os.environ, "PYTHONPATH": str(root), "OPENBLAS_NUM_THREADS": "1"}
    # Bound here, so that no job finds it too early; closed here, so that none waits for the dead.
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(address)
        listening.listen(64)
        # The pipe is never written to: its end tells the server that this process is gone.
        start.process = subprocess.Popen(
            [sys.executable, "-m", "kacsim.jobs.server", address, str(listening.fileno())],
            stdin=subprocess.PIPE,
            env=environment,
            pass_fds=(listening.fileno(),),
            start_new_session=True,
        )
    os.environ[ADDRESS] = address


class Server:
    """Forks a child for each connection and sends its status back when it ends.

    A child that compiles stays for the next such connection.
    """

    def __init__(self, listening):
        """Take over a listening socket."""
        self.socket = listening
        self.children = {}  # process id -> connection of its client
        self.compilers = {}  # process id of a child that compiles -> channel to it
        read, write = os.pipe()
        os.set_blocking(write, False)
        signal.set_wakeup_fd(write)
        signal.signal(signal.SIGCHLD, lambda number, frame: None)
        self.ended = read
        self.waiting = selectors.DefaultSelector()
        for source in (self.socket, self.ended, sys.stdin.fileno()):
            self.waiting.register(source, selectors.EVENT_READ)

    def serve(self):
        """Serve until the process that started this one is gone."""
        while True:
            for key, _ in self.waiting.select():
                if key.fileobj is self.socket:
                    self._accept()
                elif key.fileobj == self.ended:
                    os.read(self.ended, 4096)
                    self._bury()
                elif key.fileobj == sys.stdin.fileno():
                    self._end_all()
                    return
                elif key.fileobj in self.compilers.values():
                    self._compiled(key.fileobj)
                else:
                    self._end(key.fileobj)

    def _accept(self):
        connection, _ = self.socket.accept()
        message, descriptors = received(connection)
        if not message:
            connection.close()
            return
        request = json.loads(message)
        if request["words"][:1] == ["compile"]:
            child = self._compile(message, descriptors, connection)
        else:
            child = os.fork()
            if child == 0:
                self._become_job(request, descriptors)
        for descriptor in descriptors:
            os.close(descriptor)
        self.children[child] = connection
        self.waiting.register(connection, selectors.EVENT_READ)

    def _compile(self, message, descriptors, connection):
        """Hand a job to a compiler; return its process id."""
        while True:
            child = self._idle_compiler(connection.fileno(), *descriptors)
            try:
                sent = socket.send_fds(self.compilers[child], [message], descriptors)
                if rest := message[sent:]:
                    self.compilers[child].sendall(rest)
                return child
            except OSError:  # it has just ended
                self._retire(child)

    def _retire(self, child):
        """Give a compiler no more jobs; one that is alive then ends."""
        channel = self.compilers.pop(child)
        self._forget(channel)
        channel.close()

    def _idle_compiler(self, *of_client):
        """Return the process id of a compiler without work, a new one if there is none.

        A new one must not hold what is `of_client`, who waits for its end.
        """
        for child in self.compilers:
            if child not in self.children:
                return child
        ours, theirs = socket.socketpair()
        child = os.fork()
        if child == 0:
            ours.close()
            for descriptor in of_client:
                os.close(descriptor)
            self._become_compiler(theirs)
        theirs.close()
        self.compilers[child] = ours
        self.waiting.register(ours, selectors.EVENT_READ)
        return child

    def _compiled(self, channel):
        """Send the status of a compiler's job to its client."""
        child = next(one for one, of_child in self.compilers.items() if of_child is channel)
        status = channel.recv(16)
        if status != b"0":  # after a failure or its own end it may have left anything
            self._retire(child)
        if status:  # else `_bury` tells the client
            self._answer(self.children.pop(child), status)

    def _leave_server(self):
        """Make this child of the server a process like any other."""
        signal.set_wakeup_fd(-1)
        end_with_parent()
        for number in (signal.SIGCHLD, signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_DFL)
        self.waiting.close()
        self.socket.close()
        for connection in (*self.children.values(), *self.compilers.values()):
            connection.close()

    def _become_job(self, request, descriptors):
        """Run a command in this child, and never return."""
        self._leave_server()
        status = 1
        try:
            status = answer(request, descriptors)
        finally:
            os._exit(status)

    def _become_compiler(self, channel):
        """Run commands in this child as they come, and never return."""
        self._leave_server()
        nothing = os.open(os.devnull, os.O_RDWR)
        try:
            while True:
                message, descriptors = received(channel)
                if not message:
                    break
                status = answer(json.loads(message), descriptors)
                for target in range(3):  # who reads the job's output waits for its end
                    os.dup2(nothing, target)
                channel.sendall(str(status).encode())
                if status:
                    break
        finally:
            os._exit(0)

    def _bury(self):
        """Send the status of every child that has ended to its client."""
        while True:
            try:
                child, status = os.waitpid(-1, os.WNOHANG)
            except ChildProcessError:  # there is none
                return
            if child == 0:
                return
            if child in self.compilers:
                self._retire(child)
            if child in self.children:
                code = os.waitstatus_to_exitcode(status)
                code = code if code >= 0 else 128 - code
                self._answer(self.children.pop(child), str(code).encode())

    def _answer(self, connection, status):
        """Send a status to a client, and be done with it."""
        self._forget(connection)
        with contextlib.suppress(OSError):
            connection.sendall(status)
        connection.close()

    def _end(self, connection):
        """Tell the job of a client that has gone to end."""
        for child, of_child in self.children.items():
            if of_child is connection:
                os.kill(child, signal.SIGTERM)
        self._forget(connection)

    def _end_all(self):
        for child in {*self.children, *self.compilers}:
            os.kill(child, signal.SIGTERM)

    def _forget(self, connection):
        with contextlib.suppress(KeyError, ValueError):  # closed meanwhile
            self.waiting.unregister(connection)


def received(connection):
    """Return (message, descriptors) of a client; an empty message if it has gone."""
    message, descriptors, _, _ = socket.recv_fds(connection, LONGEST, 3)
    while message and not message.endswith(b"\n"):
        more = connection.recv(LONGEST)
        message = message + more if more else b""
    return message, descriptors


def answer(request, descriptors):
    """Run a command with a client's streams, folder and environment; return its status."""
    for target, descriptor in enumerate(descriptors):
        os.dup2(descriptor, target)
        os.close(descriptor)
    try:
        os.chdir(request["folder"])
        os.environ.clear()
        os.environ.update(request["environment"])
        return run(request["words"])
    finally:
        with contextlib.suppress(OSError, ValueError):
            sys.stdout.flush()
            sys.stderr.flush()


def end_with_parent():
    """Let the kernel send SIGTERM to this process when its parent is gone, were it by SIGKILL."""
    import ctypes

    ctypes.CDLL(None).prctl(SET_DEATH_SIGNAL, signal.SIGTERM)


def run(words):
    """Run one command as `python -m kacsim` would; return its exit status."""
    import runpy
    import traceback

    sys.argv = ["kacsim", *words]
    status = 0
    try:
        runpy.run_module("kacsim", run_name="__main__", alter_sys=True)
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
        status = 1
    atexit._run_exitfuncs()
    return status


def warm():
    """Import what jobs need. Nothing is computed: caches must be each job's own."""
    own = (module.name for module in pkgutil.walk_packages(kacsim.__path__, "kacsim."))
    for name in (*LATE, *own):
        if not name.endswith("__main__"):
            importlib.import_module(name)
    gc.collect()
    gc.freeze()  # children share these pages: collecting there would copy them


def main(address, descriptor):
    """Serve at an address, whose socket is handed over, until standard input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for Snakemake, which then ends
    try:
        server = Server(socket.socket(fileno=int(descriptor)))
        warm()
        server.serve()
    finally:
        shutil.rmtree(Path(address).parent, ignore_errors=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
