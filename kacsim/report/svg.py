"""SVG that stands in a page with other SVG."""

import re
from dataclasses import dataclass, field
from xml.etree import ElementTree

from markupsafe import Markup

from kacsim import files

PLACES = 2  # of coordinates: a hundredth of a point is nothing on any screen
ROUNDED = ("d", "x", "y", "x1", "x2", "y1", "y2", "points", "width", "height")
KEPT = re.compile(r"mark-[-\d]+|figure_1")  # ids that the page looks for


@dataclass
class Shared:
    """What the figures of a page share.

    Attributes
    ----------
    letters : dict, id -> markup of their letters
    many : int, ids given so far
    """

    letters: dict = field(default_factory=dict)
    many: int = 0

    def new_id(self):
        """Return an id that no other element of the page has."""
        self.many += 1
        return f"i{self.many}"

    def markup(self):
        """Return the letters of all figures as one element, which shows nothing itself."""
        inside = "".join(self.letters[name] for name in sorted(self.letters))
        size = 'width="0" height="0" aria-hidden="true"'
        return Markup(f'<svg id="letters" {size}><defs>{inside}</defs></svg>')


def inline(text, path, prefix, label, shared):
    """Return (markup, view box) of SVG, fit to stand in a page with others.

    Ids that the page looks for get a prefix, others are new ones, so that all are unique in the
    page; those that nothing refers to are left out, as are metadata, comments, namespaces and the
    style sheet, which would rule the whole page. What all parts of a group have stands at it.

    Parameters
    ----------
    text : str
    path : file that it was read from
    prefix : str, of ids that the page looks for
    label : str, what it shows, for those who do not see it
    shared : Shared, to which the figure's letters are added

    Raises
    ------
    StoreError
        Names the file that the text was read from, if it is not SVG.
    """
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise files.StoreError(f"{path}: is not SVG: {error}; draw it again") from error
    for element in list(root.iter()):
        element.tag, element.tail = _local(element.tag), None
        element.text = (element.text or "").strip() or None
        for child in list(element):
            if _local(child.tag) in ("metadata", "style"):
                element.remove(child)
        for key in list(element.attrib):
            element.set(_local(key), " ".join(element.attrib.pop(key).split()))
    _share(root, shared.letters)
    own = set(_ids(root))
    new = {name: shared.new_id() for name in sorted(_referred(root) & own)}
    new |= {name: f"{prefix}-{name}" for name in own if KEPT.fullmatch(name)}
    for element in root.iter():
        element.attrib.pop("target", None)  # of a link
        for key, value in list(element.attrib.items()):
            element.set(key, _placed(key, value, new))
        name = element.attrib.pop("id", None)
        if name in new:
            element.set("id", new[name])
    _unwrap(root)
    _hoist(root)
    box = root.get("viewBox")
    size = f"--width:{box.split()[2]}"  # for one that stands alone
    root.attrib = {"viewBox": box, "role": "img", "aria-label": label, "style": size}
    return Markup(ElementTree.tostring(root, encoding="unicode").replace(" />", "/>")), box


def _share(root, letters):
    """Move the letters of a figure, which have the same ids and outlines in all, to `letters`."""
    for element in root.iter("defs"):
        for child in list(element):
            name = child.get("id", "")
            if re.fullmatch(r"[A-Za-z]+-[A-Za-z0-9-]*[0-9a-f]+", name) and "Sans" in name:
                letters.setdefault(name, ElementTree.tostring(child, encoding="unicode"))
                element.remove(child)


def _unwrap(element):
    """Put the children of groups that say nothing in their groups' place; empty ones go."""
    children = []
    for child in element:
        _unwrap(child)
        bare = child.tag in ("g", "defs") and not child.attrib
        if bare and (child.tag == "g" or not len(child)):
            children += list(child)
        else:
            children.append(child)
    element[:] = children


def _hoist(element):
    """Give a group what all its children have: a style that is inherited, or what clips them."""
    for child in element:
        _hoist(child)
    children = [child for child in element if child.tag != "defs"]
    if element.tag != "g" or len(children) < 2:
        return
    for key in ("style", "clip-path"):
        values = {child.get(key) for child in children}
        value = values.pop()
        moved = not values and value and "opacity:" not in value.replace("-opacity:", "")
        if moved and key not in element.attrib:
            element.set(key, value)
            for child in children:
                del child.attrib[key]


def _ids(root):
    return [element.get("id") for element in root.iter() if "id" in element.attrib]


def _referred(root):
    """Return the ids that a figure's elements refer to."""
    values = (value for element in root.iter() for value in element.attrib.values())
    found = (
        re.findall(r"url\(#([^)]+)\)", value) or re.findall(r"^#(.+)$", value) for value in values
    )
    return {name for names in found for name in names}


def _placed(key, value, new):
    """Return the value of an attribute with the new ids and its numbers rounded."""
    if key == "href":
        return f"#{new[value[1:]]}" if value[1:] in new else value
    if key == "id":
        return value
    if key in ROUNDED:
        short = re.sub(r"-?\d+\.\d{3,}", _rounded, value)
        return re.sub(r" ?([A-Za-z]) ?", r"\1", short) if key == "d" else short
    if key == "style":
        value = value.replace(": ", ":").replace("; ", ";")
    if key == "transform":
        return re.sub(r"(translate|matrix|rotate)\([^)]*\)", _rounded_all, value)
    return re.sub(r"url\(#([^)]+)\)", lambda found: f"url(#{new[found[1]]})", value)


def _rounded_all(found):
    if found[1] == "matrix":
        return found[0]
    return re.sub(r"-?\d+\.\d{3,}", _rounded, found[0])


def _rounded(found):
    text = f"{float(found[0]):.{PLACES}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _local(name):
    """Return a tag's or attribute's name without its namespace."""
    return name.rpartition("}")[2]
