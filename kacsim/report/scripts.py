"""The scripts of the page: files of one idea each, which stand in it as one text."""

import base64
import json

from markupsafe import Markup

from kacsim.report.texts import TEXTS, read_text

SHARED = ("bytes.js", "exact.js")
WORKER = (*SHARED, "streams.js", "kernels.js", "worker.js")
LAST = "main.js"  # begins what all others define
FIELDS = (
    ("n_particles", "Particles N", "50", "kac perfect"),
    ("time", "Time t", "2", "kac bkw"),
    ("time_step", "Time step Δt", "0.5", "kac"),
    ("speed", "Speed c / c_q", "4", "bkw"),
    ("tolerance", "Distance ε", "1e-6", "perfect"),
    ("seed", "Seed", "1", "kac bkw perfect"),
)


def page():
    """Return the scripts of the page, as one function that shares nothing with others."""
    others = {path.name for path in (TEXTS / "scripts").glob("*.js")} - {*WORKER, LAST}
    names = (*SHARED, *sorted(others), LAST)
    files = "\n".join(read_text(TEXTS / "scripts" / name) for name in names)
    return Markup(f"(() => {{\n{_inside(files)}\n}})();")


def worker():
    """Return the script of the worker."""
    return Markup(_inside("\n".join(read_text(TEXTS / "scripts" / name) for name in WORKER)))


def as_json(value):
    """Return a value as JSON that can stand in a script element."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), sort_keys=True)
    return Markup(text.replace("<", "\\u003c"))


def lab(kernels, draws, claims):
    """Return what the part of the page that draws needs.

    Parameters
    ----------
    kernels, draws : files of ``kacsim wasm``
    claims : list of dicts, rows whose interval its draws narrow
    """
    stored = json.loads(read_text(draws))
    return {
        "kernels": Markup(base64.b64encode(kernels.read_bytes()).decode()),
        "worker": worker(),
        "algorithms": stored["algorithms"],
        "fields": [
            dict(zip(("name", "label", "value", "problems"), f, strict=True)) for f in FIELDS
        ],
        "data": as_json({"stored": stored, "claims": claims}),
    }


def _inside(text):
    """Return a script that does not end its element."""
    return text.replace("</script", "<\\/script")
