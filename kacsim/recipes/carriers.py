"""Where each kind of file carries its recipe, and what of its bytes is not the recipe."""

import html
import json
import re
from pathlib import Path

from kacsim.files import StoreError

TABLE = "-metadata.json"  # what follows the name of a table of text (CSV on the Web)
FIELD = {"svg": "Description", "png": "Description", "pdf": "Subject"}  # of matplotlib's metadata
SVG = re.compile(r"<dc:description>(.*?)</dc:description>", re.S)
# On the page of the report: the configuration, and whatever names commits and versions.
CONFIGURATION = re.compile(r'<code id="configuration"(?: data-options="(.*?)")?>(.*?)</code>', re.S)
SOURCES = re.compile(r"<(\w+) class=\"source\">(.*?)</\1>", re.S)


def read(path):
    """Return the text of the recipe that a figure or a table carries.

    Raises
    ------
    StoreError
        Names the file that cannot be read or carries none.
    """
    path = Path(path)
    kind = path.suffix[1:]
    try:
        text = {"svg": _svg, "png": _png, "pdf": _pdf, "csv": _csv}[kind](path)
    except KeyError as error:
        known = "nc, svg, png, pdf, csv, html"
        raise StoreError(f"{path}: carries no recipe; kinds of files that do: {known}") from error
    except FileNotFoundError as error:
        raise StoreError(f"{error.filename}: is not there") from error
    except (OSError, ValueError, SyntaxError) as error:
        raise StoreError(f"{path}: is not a readable {kind} file: {error}") from error
    if not text:
        made = "made by another program, or by a version before 0.4.0"
        raise StoreError(f"{path}: carries no recipe: {made}")
    return text


def _svg(path):
    found = SVG.search(path.read_text(encoding="utf-8"))
    return html.unescape(found[1]) if found else None


def _png(path):
    from PIL import Image

    with Image.open(path) as image:
        image.load()
        return image.info.get(FIELD["png"])


def _pdf(path):
    import pikepdf

    try:
        with pikepdf.open(path) as file:
            found = file.docinfo.get("/Subject")
    except pikepdf.PdfError as error:
        raise ValueError(error) from error
    return None if found is None else str(found)


def _csv(path):
    about = json.loads(beside(path).read_text(encoding="utf-8"))
    return about.get("dc:description") if isinstance(about, dict) else None


def beside(table):
    """Return the file that describes a table of text."""
    table = Path(table)
    return table.with_name(table.name + TABLE)


def of_page(text, path):
    """Return (settings of every item, source, options) that the page of a report tells.

    Raises
    ------
    StoreError
        If the page tells none.
    """
    found, sources = CONFIGURATION.search(text), SOURCES.search(text)
    try:
        settings = json.loads(html.unescape(found[2]))
    except (TypeError, ValueError) as error:
        raise StoreError(f"{path}: is no report with its configuration as JSON") from error
    source = html.unescape(sources[2]).strip().removesuffix(".") if sources else ""
    return settings, source, html.unescape(found[1] or "")


def without_sources(text):
    """Return the page of a report without what names commits and versions."""
    return SOURCES.sub("", text)
