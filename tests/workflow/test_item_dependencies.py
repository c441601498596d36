"""The proof that the dependencies of items are complete: each is reduced and drawn under trace.

What samplers need is in tests/unit/test_dependencies.py.
"""

import traced

from kacsim import items, plan
from kacsim.jobs import stages
from kacsim.kernels import names, sources

# What items ask of code that lies outside: names of samples, which of a case's values are its
# algorithm's own, looking up by name; and checks of public functions' arguments, whichever.
CHECKS = (
    "kacsim.checks.",
    "kacsim.kac.samplers.moment_problems",
    "kacsim.kac.samplers.number_of_particles",
    "kacsim.kac.samplers.step_problems",
)
ASKED = {
    "kacsim.cases.Case.id",
    "kacsim.cases.make_case",
    "kacsim.kac.samplers.own_parameters",
    "kacsim.kernels.lookup._Lazy.__getattr__",
    "kacsim.kernels.lookup.named",
}
# What ids are made by: with another id a job has another file to read.
NAMING = {("kacsim.kac.own_tables", "settled"), ("kacsim.kac.own_tables", "token")}
WRITTEN = {
    "kacsim.files.check_sums",
    "kacsim.files.read_yaml",
    "kacsim.files.replace_file",
    "kacsim.kernels.lookup._Lazy.__getattr__",  # the picture of all rows is drawn as items are
}
DRAWN = "kac_fig4"
EMPTY = {"published": set()}
# Inputs of the rules that write the pages.
TEXTS = {
    "page": set(plan.REPORT_FILES),
    "printing": set(),
    "runtime": {"runtime.html.j2", "style.css"},
}


def roots_of(name):
    """Return phase -> roots of what is done with an item."""
    return {
        "reduce": stages.reduce_roots(name),
        "claims": [(f"kacsim.items.{name}", "claims")],
        "draw": stages.draw_roots(name),
    }


def unexplained(needed, roots):
    """Return what was needed and does not follow from the roots."""
    return needed["required"] - sources.closure(frozenset(roots))[0]


def forget():
    """Forget what was derived under other rules."""
    for one in (sources._used, sources.closure):
        one.cache_clear()


def test_what_is_done_with_items_follows_from_their_roots(smoke_run, monkeypatch):
    jobs = [["item", name, str(smoke_run / "results")] for name in items.NAMES]
    done = dict(zip(items.NAMES, traced.run(jobs), strict=True))
    published = items.published()
    for name in items.NAMES:
        for phase, needed in done[name].items():
            assert unexplained(needed, roots_of(name)[phase]) <= NAMING, (name, phase)
            asked = {one for one in needed["called"] if not one.startswith(CHECKS)}
            assert asked <= ASKED, (name, phase)
            assert needed["opened"] == set(), (name, phase)
        used = items.uses(name)
        read = done[name]["reduce"]["published"] | done[name].get("claims", EMPTY)["published"]
        assert {key for key in read if not items.shows(published[key], (name, *used))} == set()
        assert done[name]["draw"]["published"] == set()
        # A control: tables of claims run more than their own module, as their roots say.
        reduce = stages.reduce_roots(name)
        own = [root for root in reduce if root[0].rpartition(".")[2] not in used]
        missed = {module for module, stage in unexplained(done[name]["reduce"], own)}
        assert missed >= {f"kacsim.items.{one}" for one in used}, name

    # Another control: without dispatch by name the exact moments of algorithms would be missed.
    monkeypatch.setattr(names, "dispatched", lambda *words: ())
    forget()
    missed = unexplained(done["kac_fig3"]["reduce"], stages.reduce_roots("kac_fig3"))
    monkeypatch.undo()
    forget()
    assert ("kacsim.kac.bird", "fourth_moment") in missed


def test_what_writes_files_and_pages_follows_from_its_roots(smoke_run):
    results = str(smoke_run / "results")
    files, pages = traced.run([["writers", DRAWN, results], ["pages", results]])
    assert unexplained(files["draw"], stages.draw_roots(DRAWN)) == set()
    for page, needed in pages.items():
        assert unexplained(needed, stages.page_roots(page)) == set(), page
        assert needed["called"] <= WRITTEN, page
        assert {name.removeprefix("reports/") for name in needed["opened"]} == TEXTS[page], page
