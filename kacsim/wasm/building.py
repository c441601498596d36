"""Build the module of the page: ``python -m kacsim.wasm.building FILE``, in a process of its own.

numba must not have made its code for this machine yet: `SETTINGS` are read when it is imported.
What was built is kept beside the kernels, under the hash of what it was built from.
"""

import base64
import hashlib
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

# Nothing is optimized for another machine's sizes, and no processor's features are used.
SETTINGS = {"NUMBA_OPT": "0", "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}


def write(path):
    """Write the module to a file: the one that is kept, or a new one by another process.

    Raises
    ------
    StoreError
        Says what failed.
    """
    from kacsim import files
    from kacsim.jobs import stages
    from kacsim.kernels import folder

    kept = folder.root() / f"page-{stages.code(stages.wasm_roots())[:16]}.json"
    content = read(kept)
    if content is None:
        content = built(path)
        about = {"sha256": _digest(content), "module": base64.b64encode(content).decode()}
        folder.write_quietly(kept, json.dumps(about))
    files.replace_file(path, lambda name: Path(name).write_bytes(content))


def read(kept):
    """Return the module of a kept file; None if there is none, or what is there is damaged."""
    try:
        about = json.loads(kept.read_text(encoding="utf-8"))
        content = base64.b64decode(about["module"], validate=True)
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return content if _digest(content) == about.get("sha256") else None


def built(path):
    """Return the bytes of a new module, built by another process for a file."""
    from kacsim import files
    from kacsim.kernels.provenance import ROOT

    with tempfile.TemporaryDirectory(prefix="kacsim-") as scratch:
        output = Path(scratch) / "page.wasm"
        command = [sys.executable, "-m", "kacsim.wasm.building", str(output)]
        own = os.environ | SETTINGS | {"PYTHONPATH": str(ROOT)}
        done = subprocess.run(command, env=own, capture_output=True, text=True)
        if done.returncode:
            raise files.StoreError(f"{path}: cannot be built:\n{done.stderr}")
        return output.read_bytes()


def _digest(content):
    return hashlib.sha256(content).hexdigest()


if __name__ == "__main__":
    from kacsim.wasm import entries, module

    Path(sys.argv[1]).write_bytes(module.built(entries.entries()))
