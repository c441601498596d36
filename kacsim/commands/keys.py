"""Write a page of all keys of a configuration, from its schema."""

import json
from pathlib import Path

from kacsim import files, plan

EXAMPLE = "keys --output config/README.md"
OF_A_CLONE = True
HEAD = """# Configuration

`config.yaml` is the full run, and each of its lines has its reason there; `smoke.yaml` overrides it
for a tiny run of everything. To run with other values write the keys that differ to a file and give
it with `--configfile my.yaml`, or one with `--config seed=7`. Wrong keys and values are refused
before anything starts, all at once, with what is allowed. This page is made by
`python -m kacsim keys` from `workflow/schemas/config.schema.yaml`, where bounds are.
"""
TABLE = ("| key | default | meaning |", "| --- | --- | --- |")


def add(parser):
    """Add the options."""
    parser.add_argument("--output", required=True, metavar="FILE")


def run(arguments):
    """Write the page."""
    text = page(files.read_yaml(plan.SCHEMA))
    files.replace_file(arguments.output, lambda name: Path(name).write_text(text, encoding="utf-8"))


def page(schema):
    """Return the page: a table of the common keys, then one of each item."""
    common, sections = {}, {}
    for key, entry in schema["properties"].items():
        (sections if "properties" in entry else common)[key] = entry
    lines = [HEAD, *TABLE, *(_row(key, entry) for key, entry in common.items())]
    for name, entry in sections.items():
        lines += ["", f"## {name}", "", entry["description"], "", *TABLE]
        lines += [_row(key, one) for key, one in entry["properties"].items()]
    return "\n".join(lines) + "\n"


def _row(key, entry):
    default = json.dumps(entry["default"]) if "default" in entry else ""
    meaning = " ".join(entry.get("description", "").split()).replace("|", "\\|")
    return f"| `{key}` | {f'`{default}`' if default else ''} | {meaning} |"
