"""SVG that stands in a page with other SVG."""

from xml.etree import ElementTree

from markupsafe import Markup

from kacsim import files


def inline(text, path, prefix, label):
    """Return (markup, view box) of SVG, fit to stand in a page with others.

    Ids get a prefix, so that they are unique in the page. Metadata, comments, namespaces and the
    style sheet, which would rule the whole page, are left out.

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
            value = " ".join(element.attrib.pop(key).split()).replace("url(#", f"url(#{prefix}-")
            edge = {"id": f"{prefix}-{value}", "href": value.replace("#", f"#{prefix}-", 1)}
            element.set(_local(key), edge.get(_local(key), value))
    box = root.get("viewBox")
    size = f"--width:{box.split()[2]}"
    root.attrib = {"viewBox": box, "role": "img", "aria-label": label, "style": size}
    return Markup(ElementTree.tostring(root, encoding="unicode")), box


def _local(name):
    """Return a tag's or attribute's name without its namespace."""
    return name.rpartition("}")[2]
