"""What the page of `snakemake --report` calls a figure: read only when such a page is made."""

import functools

import yaml

from kacsim.kernels.provenance import ROOT


@functools.cache
def _texts(name):
    return yaml.safe_load((ROOT / "reports" / name).read_text(encoding="utf-8"))


def labels_of(wildcards):
    """Return the labels of an item's figure."""
    texts = _texts("captions.yaml")[wildcards.item]
    return {"item": texts["label"], "shows": texts["title"]}


def part_of(wildcards):
    """Return whether an item is a figure of its text or a study."""
    printed = labels_of(wildcards)["item"].startswith("Fig.")
    return "Figures" if printed else "Studies and claims"


def category_of(wildcards):
    """Return the text that an item belongs to."""
    return _texts("errata.yaml")[wildcards.item.partition("_")[0]]["name"]
