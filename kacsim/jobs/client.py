"""Runs one command in a process forked from the server of this run, or in one of its own.

Started as a file, without the package and `site`: what it imports is most of what it costs.
"""

import os
import sys

ADDRESS = "KACSIM_SERVER"
LONGEST = 1 << 20  # bytes read at once


def main(words):
    """Run a command; return its exit status."""
    address = os.environ.get(ADDRESS)
    connection = _connect(address) if address else None
    if connection is None or not _sent(connection, words):
        os.execv(sys.executable, [sys.executable, "-m", "kacsim", *words])
    status = connection.recv(16)
    if not status:
        sys.stderr.write("kacsim: the process that served the jobs of this run has ended\n")
        return 1
    return int(status)


def _sent(connection, words):
    """Send a command with this process's streams; return whether all of it was taken."""
    import json
    import signal
    import socket

    request = {"words": words, "folder": os.getcwd(), "environment": dict(os.environ)}
    message = json.dumps(request).encode() + b"\n"
    try:
        sent = socket.send_fds(connection, [message], [0, 1, 2])
        # To send nothing fails too, where a short job has been answered already.
        if rest := message[sent:]:
            connection.sendall(rest)
    except OSError:  # the server has just ended: without its last byte it began nothing
        connection.close()
        return False
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # ends at once; the server then ends the job
    return True


def _connect(address):
    """Return a connection, or None where no server answers."""
    import socket

    connection = socket.socket(socket.AF_UNIX)
    try:
        connection.connect(address)
    except OSError:
        connection.close()
        return None
    return connection


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
