"""What the jobs of each stage depend on: the roots of their code, and values beside their files."""

import json

from kacsim import items
from kacsim.kac.samplers import ON_PAGE
from kacsim.kernels import sources

WRITERS = (
    ("kacsim.drawing.marks", "write"),
    ("kacsim.drawing.plotting", "save"),
    ("kacsim.recipes.lines", "of_figure"),
    ("kacsim.report.csv_table", "write"),
)
LOOKED_UP = ("ancestral", "arguments")  # of an algorithm, by `kacsim.wasm`


def sample_roots(case):
    """Return (module, name) of what draws a case."""
    return case.roots


def merge_roots(case):
    """Return (module, name) of what draws a case and joins its shards."""
    kept = f"kacsim.{case.sampler.family}.sampling", "KEPT"  # which `merged` looks up
    return *case.roots, kept, ("kacsim.jobs.shards", "merged")


def reduce_roots(name):
    """Return (module, name) of what makes the dataset of an item."""
    own = ("kacsim.items", "reduced"), (f"kacsim.items.{name}", "reduce")
    stages = ("reduce", "claims")
    return *own, *((f"kacsim.items.{one}", stage) for one in items.uses(name) for stage in stages)


def draw_roots(name):
    """Return (module, name) of what draws the figure of an item and writes its numbers."""
    return (f"kacsim.items.{name}", "draw"), *WRITERS


def drawn_from(cases):
    """Return what marks of a figure are told from beside the dataset: title and settings each."""
    return [(case.title(), case.settings()) for case in cases]


def draw_values(cases):
    """Return what a figure and its numbers depend on beside the dataset, as one line."""
    return json.dumps(drawn_from(cases), sort_keys=True)


def page_roots(module):
    """Return (module, name) of what writes the report, its print or the page of run times."""
    return ((f"kacsim.report.{module}", "write"),)


def wasm_roots():
    """Return (module, name) of what compiles the kernels of the page and draws by them."""
    looked_up = ((f"kacsim.kac.{name}", part) for name in ON_PAGE for part in LOOKED_UP)
    return (
        ("kacsim.wasm.building", "SETTINGS"),  # and what that module does when it is run
        ("kacsim.wasm.stored", "content"),
        *looked_up,
    )


def code(roots):
    """Return the hash of everything that some roots reach."""
    return sources.code(roots)


def reduce_values(name, cases):
    """Return what the dataset depends on beside settings and samples: recipes, published texts."""
    names = (name, *items.uses(name))
    shown = {key: entry for key, entry in items.published().items() if items.shows(entry, names)}
    return json.dumps([[case.recipe() for case in cases], shown], sort_keys=True, default=str)
