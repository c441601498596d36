"""Build the module of the page: ``python -m kacsim.wasm.building FILE``, in a process of its own.

numba must not have made its code for this machine yet: `SETTINGS` are read when it is imported.
"""

import os
import subprocess
import sys
from pathlib import Path

# Nothing is optimized for another machine's sizes, and no processor's features are used.
SETTINGS = {"NUMBA_OPT": "0", "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}


def write(path):
    """Write the module to a file, by another process.

    Raises
    ------
    StoreError
        Says what failed.
    """
    from kacsim import files
    from kacsim.kernels.provenance import ROOT

    def build(name):
        command = [sys.executable, "-m", "kacsim.wasm.building", str(name)]
        own = os.environ | SETTINGS | {"PYTHONPATH": str(ROOT)}
        done = subprocess.run(command, env=own, capture_output=True, text=True)
        if done.returncode:
            raise files.StoreError(f"{path}: cannot be built:\n{done.stderr}")

    files.replace_file(path, build)


if __name__ == "__main__":
    from kacsim.wasm import entries, module

    Path(sys.argv[1]).write_bytes(module.built(entries.entries()))
