"""Which Chromium prints the report, if any. Nothing heavy: Snakemake asks at every start."""

import os
import shutil

PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
VARIABLE = "KACSIM_CHROMIUM"  # the browser to use; empty: none
NONE = f"no Chromium found ({', '.join(PROGRAMS)}, or the path in {VARIABLE})"


def find():
    """Return the path of a Chromium, None where there is none."""
    chosen = os.environ.get(VARIABLE)
    names = PROGRAMS if chosen is None else (chosen,)
    return next(filter(None, map(shutil.which, filter(None, names))), None)
