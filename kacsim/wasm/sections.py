"""Sections of a WebAssembly module: a compiler's object becomes a module that exports.

An object of one unit is a module but for its export section, which a linker would add
(WebAssembly core specification, section 5.5).
"""

HEADER = 8  # bytes: magic number and version
CUSTOM, IMPORT, EXPORT = 0, 2, 7
AFTER_EXPORT = (8, 9, 12, 10, 11)  # start, element, data count, code, data
FUNCTION = 0  # kind of an import or export


def exporting(content, names):
    """Return a module with names for functions of an object, without its custom sections.

    Parameters
    ----------
    content : bytes, of an object file
    names : mapping, name -> place among the functions that the object defines
    """
    first = sum(kind == FUNCTION for kind in _imported(content))
    entries = [
        _text(name) + bytes([FUNCTION]) + number(first + place) for name, place in names.items()
    ]
    section = number(len(entries)) + b"".join(entries)
    found, added = [content[:HEADER]], False
    for kind, body in sections(content):
        if kind == CUSTOM:
            continue
        if kind in AFTER_EXPORT and not added:
            found.append(_section(EXPORT, section))
            added = True
        found.append(_section(kind, body))
    return b"".join(found)


def sections(content):
    """Yield (kind, body) of a module's sections."""
    place = HEADER
    while place < len(content):
        kind = content[place]
        size, start = read_number(content, place + 1)
        place = start + size
        yield kind, content[start:place]


def number(value):
    """Return an unsigned number in LEB128."""
    found = bytearray()
    while True:
        value, low = value >> 7, value & 0x7F
        found.append(low | (0x80 if value else 0))
        if not value:
            return bytes(found)


def read_number(content, place):
    """Return (unsigned number in LEB128 at a place, place after it)."""
    value = shift = 0
    while True:
        byte = content[place]
        place += 1
        value |= (byte & 0x7F) << shift
        shift += 7
        if not byte & 0x80:
            return value, place


def _text(name):
    return number(len(name)) + name.encode()


def _section(kind, body):
    return bytes([kind]) + number(len(body)) + body


def _imported(content):
    """Return the kinds of a module's imports: function, table, memory, global."""
    bodies = [body for kind, body in sections(content) if kind == IMPORT]
    kinds = []
    for body in bodies:
        many, place = read_number(body, 0)
        for _ in range(many):
            for _ in range(2):  # names of module and field
                size, place = read_number(body, place)
                place += size
            kinds.append(body[place])
            place = _after(body, place)
    return kinds


def _after(body, place):
    """Return the place after an import's kind and what describes it."""
    kind, place = body[place], place + 1
    if kind == FUNCTION:
        return read_number(body, place)[1]
    if kind == 3:  # global: a type and whether it changes
        return place + 2
    place += kind == 1  # a table's type stands before its limits
    flags, place = read_number(body, place)
    for _ in range(1 + (flags & 1)):
        _, place = read_number(body, place)
    return place
