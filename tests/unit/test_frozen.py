"""Ids and bits of small cases are those of tests/frozen/samples.yaml: samples outlive a rewrite.

A case's id seeds its streams, so that a change of either is another result. Who means to change
one raises the version, says so in CHANGELOG.md and writes the table again:

    PYTHONPATH=. python tests/unit/test_frozen.py

which draws the cases of the table and adds the tiny ones of samplers and algorithms that it does
not have. Nothing else may change it.
"""

import hashlib
import json
from pathlib import Path

import numpy as np
import pytest
import yaml

from kacsim import plan
from kacsim.cases import make_case, tiny_cases
from kacsim.jobs import sampling
from kacsim.kernels.provenance import ROOT

TABLE = Path(__file__).parent.parent / "frozen" / "samples.yaml"
SHOWN = TABLE.relative_to(ROOT)
RENEW = "PYTHONPATH=. python tests/unit/test_frozen.py writes what the code does now"
FROZEN = yaml.safe_load(TABLE.read_text(encoding="utf-8"))
CONFIGS = {"full": ("config.yaml",), "smoke": ("config.yaml", "smoke.yaml")}
HEAD = (
    "# Ids and bits of small cases: SHA-256 over names, dims, shapes, dtypes and values.\n"
    "# Who changes one decides it, raises the version and says so in CHANGELOG.md.\n"
)


def digest(variables):
    """Return the SHA-256 of what a sampler returns: names, dims, shapes, dtypes and values."""
    found = hashlib.sha256()
    for name in sorted(variables):
        dims, values, _ = variables[name]
        values = np.ascontiguousarray(values)
        head = [name, list(dims), list(values.shape), values.dtype.str]
        found.update(json.dumps(head).encode())
        found.update(values.tobytes())
    return found.hexdigest()


def case_of(entry):
    size = {name: entry[name] for name in ("n_draws", "n_replicates", "seed")}
    return make_case(entry["sampler"], **entry["parameters"], **size)


def ids_of(files):
    """Return the number of cases of a configuration, and the SHA-256 of their ids."""
    files = [ROOT / "config" / name for name in files]
    ids = sorted(plan.Plan(plan.read_config(*files), files).cases)
    return {"cases": len(ids), "sha256": hashlib.sha256("\n".join(ids).encode()).hexdigest()}


def kind_of(sampler, parameters):
    """Return what has kernels of its own: a sampler, or an algorithm of it on an engine."""
    words = [parameters[name] for name in ("algorithm", "engine") if name in parameters]
    return " ".join([sampler, *words])


@pytest.mark.parametrize("entry", FROZEN["cases"], ids=lambda entry: entry["id"])
def test_ids_and_bits_are_those_frozen(entry):
    case = case_of(entry)
    assert case.id == entry["id"]
    assert case.problems() == []
    assert digest(sampling.run(case)) == entry["sha256"]


@pytest.mark.parametrize("name", CONFIGS)
def test_ids_of_the_plan_are_those_frozen(name):
    found, frozen = ids_of(CONFIGS[name]), FROZEN["plans"][name]
    number = f"{found['cases']} cases in place of {frozen['cases']}"
    assert found == frozen, f"{name} run: {number}, or other ids, than in {SHOWN}; {RENEW}"


def test_every_sampler_and_algorithm_is_frozen():
    known = {kind_of(entry["sampler"], entry["parameters"]) for entry in FROZEN["cases"]}
    missing = {kind_of(case.name, case.parameters) for case in tiny_cases()} - known
    assert not missing, f"{', '.join(sorted(missing))}: no bits in {SHOWN}; {RENEW}"


def test_every_part_of_a_sample_is_in_the_digest():
    """Negative control: another name, dimension, type or bit of the same numbers."""
    values = np.arange(6.0).reshape(2, 3)
    samples = {
        "as it was": {"a": (("x", "y"), values, {})},
        "name": {"b": (("x", "y"), values, {})},
        "dimension": {"a": (("x", "z"), values, {})},
        "shape": {"a": (("x", "y"), values.reshape(3, 2), {})},
        "type": {"a": (("x", "y"), values.astype(np.float32), {})},
        "bit": {"a": (("x", "y"), np.nextafter(values, 9.0), {})},
    }
    assert len({digest(one) for one in samples.values()}) == len(samples)
    transposed = {"a": (("x", "y"), np.asfortranarray(values), {"units": "1"})}
    assert digest(transposed) == digest(samples["as it was"])


def renewed():
    """Return the table as the code stands, with what it does not have yet."""
    rows = [dict(entry) for entry in FROZEN["cases"]]
    known = {kind_of(row["sampler"], row["parameters"]) for row in rows}
    for case in tiny_cases():
        if kind_of(case.name, case.parameters) not in known:
            given = {k: v for k, v in case.parameters.items() if v is not None}
            size = {"n_draws": case.n_draws, "n_replicates": case.n_replicates, "seed": case.seed}
            rows.append({"sampler": case.name, "parameters": given, **size})
    for row in rows:
        case = case_of(row)
        row["id"], row["sha256"] = case.id, digest(sampling.run(case))
    return {"plans": {name: ids_of(files) for name, files in CONFIGS.items()}, "cases": rows}


def text_of(table):
    options = {"sort_keys": False, "default_flow_style": None, "width": 150}
    return HEAD + yaml.safe_dump(table, **options)


def test_the_table_is_what_it_would_be_written_as():
    """Else a renewal would show changes that are none."""
    assert text_of(FROZEN) == TABLE.read_text(encoding="utf-8")


if __name__ == "__main__":
    TABLE.write_text(text_of(renewed()), encoding="utf-8")
