"""The report: datasets, figures and texts become one self-contained HTML page.

Every number on the page comes from a dataset, from reports/published/ or from a formula; words
come from the template, from captions.yaml (one entry per item) and from errata.yaml (one entry per
text). No time, no random id and no network address: the same inputs give the same bytes.
"""

import functools
import json
import os
import re
from pathlib import Path
from urllib.parse import quote

import jinja2
import yaml
from markupsafe import Markup

from kacsim import files, store
from kacsim.boltzmann import bkw
from kacsim.items import published
from kacsim.report import (
    figures,
    findings,
    glossary,
    inventory,
    overview,
    registered,
    scripts,
    svg,
    verdicts,
)
from kacsim.report.numbers import bound, listed, number, pm, subscripted
from kacsim.report.texts import TEXTS, read_text
from kacsim.statistics.verdict import MISSED

FORMATS = ("svg", "png", "pdf")  # every figure is drawn in all of them


def write(items, datasets_folder, figures_folder, output, options="", kernels=None, draws=None):
    """Write the report of some items, in the given order, to the file `output`.

    Parameters
    ----------
    items : names, in the order of the page
    datasets_folder, figures_folder : where their files lie
    output : file to create or replace
    options : of the ``snakemake`` command that makes the results again; those of a run with other
        values than the project's own, which the page then says
    kernels, draws : files of ``kacsim wasm``; without them the page draws nothing itself

    Raises
    ------
    StoreError
        Names the dataset, figure or text that cannot be read, or the output.
    """
    paths = {name: Path(datasets_folder) / f"{name}.nc" for name in items}
    datasets = {name: store.read(path) for name, path in paths.items()}
    env, folder = environment(), Path(output).parent
    claims = verdicts.rows(datasets.values(), published())
    captions = yaml.safe_load(read_text(TEXTS / "captions.yaml"))
    render, shared, shown = functools.partial(_rendered, env), svg.Shared(), []
    for name in items:
        if name not in captions:
            raise files.StoreError(f"{TEXTS / 'captions.yaml'}: has no entry {name}")
        figure = Path(figures_folder) / f"{name}.svg"
        if figure.with_suffix(".sha256").exists():
            files.check_sums(figure.with_suffix(".sha256"))
        item = figures.item(render, name, datasets[name], captions[name], figure, shared)
        item["claims"] = [row for row in claims.values() if row["item"] == name]
        item["printed"] = [row for row in item["claims"] if row["printed"]]
        item["dataset_link"] = _link(paths[name], folder)
        item["links"] = {f: _link(figure.with_suffix(f".{f}"), folder) for f in FORMATS}
        item["numbers_link"] = _link(figure.with_suffix(".csv"), folder)
        shown.append(item)
    terms = glossary.read(TEXTS / "glossary.yaml")
    for item, before, after in zip(shown, [None, *shown], [*shown[1:], None], strict=False):
        item |= {"before": before, "after": after}
        item["caption"] = glossary.linked(item["caption"], terms)
    raw = verdicts.components(datasets.values())
    settings = {name: dataset.attrs["settings"] for name, dataset in datasets.items()}
    html = env.get_template("report.html.j2").render(
        style=Markup(read_text(TEXTS / "style.css")),
        texts=_sections(env, datasets, claims, shown),
        items=shown,
        claims=claims,
        kinds=verdicts.counted(claims),
        inventory=inventory.entries(TEXTS / "inventory", claims, items),
        overview=overview.drawn(datasets.values(), shared),
        findings=findings.shown(
            read_text(TEXTS / "findings.yaml"), claims, raw, settings, published(), render
        ),
        ranked=findings.RANKED,
        glossary=terms,
        letters=shared.markup(),
        marks=scripts.as_json({item["name"]: item["marks"] for item in shown if item["marks"]}),
        scripts=scripts.page(),
        lab=_lab(kernels, draws, raw, settings, datasets),
        intervals=_intervals(datasets),
        registered=_registered(datasets, options),
        sources=sorted({dataset.attrs["source"] for dataset in datasets.values()}),
        seeds=sorted({dataset.attrs["settings"]["seed"] for dataset in datasets.values()}),
        configuration=_configuration(datasets),
        options=options,
    )
    files.replace_file(output, lambda name: Path(name).write_text(html, encoding="utf-8"))


def without_scripts(html):
    """Return the page without its scripts and what only they read: for paper."""
    bare = re.sub(r"<script\b.*?</script>\n?", "", html, flags=re.S)
    return re.sub(r"<noscript>(<svg.*?</svg>)</noscript>", r"\1", bare, flags=re.S)


def without_files(html):
    """Return the page without its links to other files: for a copy that stands alone."""
    return re.sub(r'<a href="(?!#)[^"]*">(.*?)</a>', r"\1", html, flags=re.S)


def environment():
    """Return the template environment: escaping everything, refusing unknown names."""
    loader, undefined = jinja2.FileSystemLoader(TEXTS), jinja2.StrictUndefined
    trim = {"trim_blocks": True, "lstrip_blocks": True}
    env = jinja2.Environment(loader=loader, autoescape=True, undefined=undefined, **trim)
    env.globals |= {
        "number": number,
        "listed": listed,
        "pm": pm,
        "signs": verdicts.SIGNS,
        "missed": MISSED,
    }
    env.filters["subscripted"] = subscripted
    env.globals["critical_time"] = bkw.critical_time
    return env


def _rendered(env, text, **words):
    """Return a text with its expressions filled in."""
    return Markup(bound(env.from_string(text).render(words)).strip())


def _link(path, folder):
    """Return a file's address relative to the folder of the report."""
    return quote(Path(os.path.relpath(path, folder)).as_posix())


def _configuration(datasets):
    """Return the settings of every item as JSON, without its copies of other items' settings."""
    settings = {name: dict(dataset.attrs["settings"]) for name, dataset in datasets.items()}
    for one in settings.values():
        one.pop("items", None)
    text = json.dumps(settings, indent=2, sort_keys=True)
    return re.sub(r"\[[^]]*\]", lambda found: " ".join(found[0].split()), text)


def _lab(kernels, draws, raw, settings, datasets):
    """Return what the part that draws needs, None without its files."""
    if kernels is None:
        return None
    narrowed = findings.narrowed(raw, settings, _intervals(datasets))
    return scripts.lab(Path(kernels), Path(draws), narrowed)


def _intervals(datasets):
    """Return the tables of claims: name of the text, its intervals and its chance of an error."""
    return {
        name.partition("_")[0]: (int(dataset["n_intervals"]), dataset.attrs["family_error"])
        for name, dataset in datasets.items()
        if "claim" in dataset
    }


def _registered(datasets, options):
    """Return the commit of the sets that were fixed before the run, and what has changed since.

    None for a run of another configuration, which nothing was registered for.
    """
    known = None if options else registered.read(TEXTS / registered.PATH.name)
    if known is None:
        return None
    return {"commit": known["commit"], "changes": registered.changes(datasets, known)}


def _sections(env, datasets, claims, shown):
    """Return the texts that have items on the page, each with its items and its known errors."""
    found = []
    for key, text in yaml.safe_load(read_text(TEXTS / "errata.yaml")).items():
        own = [item for item in shown if item["name"].partition("_")[0] == key]
        errors = []
        for error in text["errors"] if own else ():
            rows = [claims[claim] for claim in error["claims"] if claim in claims]
            words = {"note": ""} | {part: error[part] for part in error if part != "claims"}
            words = {part: _rendered(env, w, datasets=datasets) for part, w in words.items()}
            errors.append(words | {"claims": rows})
        if own:
            found.append(text | {"key": key, "items": own, "errors": errors})
    return found
