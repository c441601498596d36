# ruff: noqa: E501
"""What is made again after an edit: what the edit changes, and nothing else.

Edits go through a real dry run of Snakemake on a finished smoke run, and are undone.
"""

import re
import shutil
from pathlib import Path

import pytest
from runs import SMOKE

from kacsim import items

FAMILY = {"samples": "sample", "datasets": "reduce", "figures": "draw"}


@pytest.fixture(scope="module")
def edited(finished, tmp_path_factory):
    """Return a function: edit files of a finished project, plan, undo; what would be made."""
    folder = tmp_path_factory.mktemp("edited") / "project"
    shutil.copytree(finished.folder, folder, symlinks=True)
    project = type(finished)(folder)

    def plan(*edits):
        for file, old, new in edits:
            path, kept = folder / file, folder.parent / "kept" / file
            text = path.read_text(encoding="utf-8")
            assert text.count(old) == 1, f"{file} holds {old!r} {text.count(old)} times"
            kept.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, kept)
            path.write_text(text.replace(old, new), encoding="utf-8")
        try:
            answer = project.snakemake("--dry-run", "--printshellcmds", *SMOKE)
        finally:
            for file, _, _ in edits:
                shutil.copy2(folder.parent / "kept" / file, folder / file)
        assert answer.returncode == 0, answer.stdout + answer.stderr
        return planned(answer.stdout)

    return plan


def planned(output):
    """Return stage -> names of the files' stems that a dry run would make."""
    found = {"sample": set(), "reduce": set(), "draw": set(), "report": set()}
    for name in re.findall(r"(results/\w+/\S+)", "\n".join(re.findall(r"--output (.*)", output))):
        path = Path(name)
        stage = FAMILY.get(path.parent.name, "report")
        # Cases have points in their names, files of figures after their items'.
        stem = path.name.partition(".")[0] if stage == "draw" else path.name.rpartition(".")[0]
        found[stage].add(path.name if stage == "report" else stem)
    return found


def of(stem, names):
    return {name for name in names if name.startswith(stem)}


NOTHING = [
    ("kacsim/kac/bird.py", '    """Return E v_1**4 after', '    # A remark.\n    """Return E v_1**4, after'),
    ("kacsim/cases.py", "BASE_MEGABYTES = 350", "BASE_MEGABYTES = 400"),
    ("kacsim/store.py", "drawn by other code; run", "drawn by some other code; run"),
    ("kacsim/boltzmann/bkw_estimators.py", '"""Estimate f(c; t) of', '"""Give f(c; t) of'),
    ("kacsim/boltzmann/samplers.py", '"radii of the probes,', '"distances of the probes,'),
    ("kacsim/boltzmann/estimators.py", "past the budget of nodes;", "past its budget of nodes;"),
    ("kacsim/checks.py", "must be a positive finite number", "must be positive and finite"),
    ("kacsim/jobs/sampling.py", "def run(case, progress=None):", "def run(case, progress=None):  # here"),
    ("kacsim/kac/draws.py", "n_draws=n_draws,\n        n_replicates=1,\n        seed=seed,\n        **parameters,", "n_draws=n_draws,\n        seed=seed,\n        n_replicates=1,\n        **parameters,"),
    ("README.md", "# kacsim", "# kacsim!"),
]  # fmt: skip


def test_edits_that_change_no_result_redo_nothing(edited):
    """All of them at once: no two can make up for each other, since hashes do not."""
    again = edited(*NOTHING)
    assert not again["sample"] | again["reduce"] | again["draw"]


def all_samples(finished):
    return {path.stem for path in (finished.folder / "results/samples").glob("*.nc")}


# file, old, new, first words of the cases that are drawn again, of some that are not
SAMPLES = [
    ("kacsim/techniques/exact.py", "NARROW = 2.0 / 3.0", "NARROW = 0.5",
     ["rejection"], ["identity", "kac-", "bkw"]),
    ("kacsim/techniques/constants.py", '    "ramp": (0.0, 1.0),\n    "triangle": (0.0, 1.0),',
     '    "triangle": (0.0, 1.0),\n    "ramp": (0.0, 1.0),', ["rejection", "inversion"], ["kac-", "bkw"]),
    ("kacsim/statistics/histogram.py", "LIMIT = 8.0", "LIMIT = 7.0", ["kac-bird", "kac-equilibrium"],
     ["trap", "bkw", "rejection", "kac-probe"]),
    ("kacsim/boltzmann/trap.py", "MAJORANT = ", "MAJORANT = 1.1 * ", ["trap", "trap-literal"],
     ["bkw", "kac"]),
    ("kacsim/kac/constants.py", "RATE = math.sqrt(math.pi) / 2", "RATE = 1.0",
     ["kac-bird", "kac-poisson", "kac-probe"], ["kac-equilibrium", "kac-corners", "bkw", "trap"]),
    ("kacsim/kac/constants.py", "MEAN_ENERGY = 1.5", "MEAN_ENERGY = 1.0",
     ["kac-equilibrium", "kac-corners"], ["kac-poisson", "kac-nanbu", "bkw"]),
    ("kacsim/boltzmann/samplers.py", "are oversampled\", not_negative, 0.0", "are oversampled\", not_negative, 0.1",
     ["bkw-c", "bkw-fraction-c", "kac-probe"], ["trap", "kac-bird"]),
    ("kacsim/boltzmann/constants.py", "COUPLING = 3.0", "COUPLING = 2.0", ["trap"], ["bkw", "kac"]),
    ("kacsim/kac/bird.py", "touched += (i == 0) + (j == 0)", "touched += (i == 0)",
     ["kac-bird-forward"], ["kac-bird-ancestral", "kac-poisson", "kac-nanbu", "bkw"]),
    ("kacsim/streams.py", "BLOCK = 256", "BLOCK = 512",
     ["kac-bird", "bkw", "trap", "identity", "injection"], ["sphere-lattice"]),
    ("kacsim/variate_tables.py", "E_TAIL = 7.69711747013104972", "E_TAIL = 7.69", ["kac-bird", "trap"],
     ["sphere-lattice", "area", "inverse-transform"]),
    ("kacsim/kac/replicates.py", "sums[3] += square**4", "sums[3] += square**5",
     ["kac-bird", "kac-equilibrium"], ["kac-corners", "kac-probe", "bkw"]),
]  # fmt: skip


@pytest.mark.parametrize(
    ("file", "old", "new", "drawn", "spared"), SAMPLES, ids=[edit[0] for edit in SAMPLES]
)
def test_an_edit_of_what_draws_redraws_its_cases_alone(
    edited, finished, file, old, new, drawn, spared
):
    again = edited((file, old, new))["sample"]
    everything = all_samples(finished)
    for stem in drawn:
        wanted = of(stem, everything)
        assert wanted, stem
        # A new default gives new ids, so that the same number of cases is drawn under other names.
        missing = f"not drawn again: {sorted(wanted - again)[:3]}"
        assert len(of(stem, again)) >= len(wanted), missing
    for stem in spared:
        assert of(stem, everything), stem
        assert not of(stem, again), f"drawn again: {sorted(of(stem, again))[:3]}"


EVERY = set(items.NAMES)
KAC_FIGURES = {"kac_fig1", "kac_fig3", "kac_fig4"}
# file, old, new, items reduced again and drawn again; every dataset made anew is drawn anew
LATER = [
    ("reports/published/kac.yaml", 'printed: "0.0187"', 'printed: "0.0178"', {"kac_fig1", "kac_numbers"}, None),
    ("kacsim/items/__init__.py", "settings=settings, published=values", "published=values, settings=settings",
     EVERY, None),
    ("kacsim/kac/samplers.py", 'Variant("bird", "Bird")', 'Variant("bird", "Bird (DSMC)")',
     {"kac_numbers", "kac_work_precision"},
     KAC_FIGURES),
    ("kacsim/cases.py", "draws of {self.id}", "values of {self.id}", set(), {"kac_fig3", "kac_fig4"}),
    ("kacsim/drawing/plotting.py", '"axes.titlesize": 9', '"axes.titlesize": 10', set(), EVERY),
    ("kacsim/items/kac_fig4.py", '"""Draw ', '"""Paint ', set(), set()),
    ("kacsim/report/csv_table.py", 'lineterminator="\\n"', 'lineterminator="\\r\\n"', set(), EVERY),
    ("reports/captions.yaml", "# What the report says of each item.", "# What the report tells of each item.", set(), set()),
]  # fmt: skip


@pytest.mark.parametrize(
    ("file", "old", "new", "reduced", "drawn"), LATER, ids=[edit[0] for edit in LATER]
)
def test_an_edit_of_a_later_stage_redoes_that_stage(edited, file, old, new, reduced, drawn):
    again = edited((file, old, new))
    assert not again["sample"]
    assert again["reduce"] == reduced
    assert again["draw"] >= (reduced if drawn is None else drawn)
    if drawn in (None, set()):
        assert again["draw"] == reduced
