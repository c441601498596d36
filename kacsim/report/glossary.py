"""Symbols and what they mean: a list on the page, and links to it where a caption has one first."""

import re

import yaml
from markupsafe import Markup, escape

from kacsim.report.texts import read_text


def read(path):
    """Return the list of terms: dicts of key, html and meaning."""
    return [term | {"html": Markup(term["html"])} for term in yaml.safe_load(read_text(path))]


def linked(caption, terms):
    """Return a caption in which the first of each term leads to its meaning and tells it."""
    # Whole links and tags are kept as they are; the longer term first, so that it is found whole.
    pieces = re.split(r"(<a .*?</a>|<[^>]*>)", str(caption), flags=re.S)
    text, places = "".join(pieces), {}
    for term in sorted(terms, key=lambda one: -len(one["html"])):
        word = str(term["html"])
        plain = not word.startswith("<")
        pattern = rf"(?<![\w>]){re.escape(word)}(?!\w)" if plain else re.escape(word)
        for found in re.finditer(pattern, text):
            inside = text[: found.start()].rfind("<") > text[: found.start()].rfind(">")
            taken = any(a < found.end() and found.start() < b for a, b in places)
            if not inside and not taken:
                places[found.span()] = term
                break
    for (start, end), term in sorted(places.items(), reverse=True):
        about = escape(term["meaning"])
        link = f'<a class="term" href="#term-{term["key"]}" data-meaning="{about}">'
        text = f"{text[:start]}{link}{text[start:end]}</a>{text[end:]}"
    return Markup(text)
