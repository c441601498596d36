"""What the texts print, entry by entry, each with the row that tests it or why there is none.

``reports/inventory/{text}.yaml`` lists entries in the order of a text: ``id``, ``where``, ``what``,
``sort`` (figure, number, algorithm, formula or claim), ``printed`` (digits, if any), and one of
``rows`` (ids of rows), ``item`` (of a figure) and ``none`` (a reason).
"""

from kacsim import files
from kacsim.report.numbers import bound


def entries(folder, claims, items):
    """Return text -> its entries, with the rows and the item that are on this page.

    Parameters
    ----------
    folder : of the inventory's files
    claims : claim id -> row
    items : names of the items on the page
    """
    found = {}
    for path in sorted(folder.glob("*.yaml")):
        found[path.stem] = [_entry(one, claims, items) for one in files.read_yaml(path)]
    return found


def _entry(one, claims, items):
    printed = one.get("printed", [])
    return {
        "where": bound(one["where"]),
        "what": bound(one["what"]),
        "sort": one["sort"],
        "printed": ", ".join([printed] if isinstance(printed, str) else printed),
        "rows": [claims[claim] for claim in one.get("rows", []) if claim in claims],
        "item": one["item"] if one.get("item") in items else "",
        "none": bound(one.get("none", "")),
    }
