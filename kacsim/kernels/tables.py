"""The store of tables: those of a file are kept under the hash of its bytes.

Reading and hashing trees takes a second for the package; they lie beside the compiled kernels.
"""

import functools
import hashlib
import json
import sys
from pathlib import Path

from kacsim.kernels import folder, scopes, trees

OUTSIDE = "what it computes are names for results, not results"

MOST_KEPT = 1000  # tables of files, several versions of each
_new, _seen = [], set()


def of(file, module):
    """Return the tables of a file (`kacsim.kernels.trees.analysed`).

    Parameters
    ----------
    file : Path
    module : str, its dotted name
    """
    content = file.read_bytes()
    package = module if file.name == "__init__.py" else module.rpartition(".")[0]
    key = f"{module} {package} {hashlib.sha256(content).hexdigest()}"
    known = _known()
    if key not in known:
        known[key] = trees.analysed(content.decode(), module, package)
        _new.append(key)
    _seen.add(key)
    return known[key]


def _store():
    version = ".".join(map(str, sys.version_info[:3]))
    return folder.root() / f"trees-{version}-{_rules()}.json"


@functools.cache
def _rules():
    """Return a digest of what makes tables: other rules make other tables."""
    digest = hashlib.sha256()
    for module in (scopes, trees):
        digest.update(Path(module.__file__).read_bytes())
    return digest.hexdigest()[:8]


@functools.cache
def _known():
    try:
        text = _store().read_text(encoding="utf-8")
        digest, _, content = text.partition("\n")
        return json.loads(content) if digest == _sum(content) else {}
    except (OSError, ValueError):
        return {}


def _sum(text):
    return hashlib.sha256(text.encode()).hexdigest()


def keep():
    """Keep the tables that were made by this process, if there is a place for them."""
    if _new:
        known = _known()
        kept = {key: known[key] for key in _seen} if len(known) > MOST_KEPT else known
        _new.clear()
        content = json.dumps(kept)
        folder.write_quietly(_store(), f"{_sum(content)}\n{content}")
