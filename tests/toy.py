"""A small package in a temporary folder whose dependencies are derived in place of kacsim's."""

import functools
import importlib
import sys
import textwrap

from kacsim.kernels import names, sources, tables

NAME = "toy"
CACHED = (names.table, names.modules, names.imported)
CACHED += (sources._used, sources._changed, sources.closure, sources._code)
CACHED += (sources._effects, sources._digest)


class Toy:
    """A package of some files, in place of kacsim while a test runs."""

    def __init__(self, folder, files):
        self.folder = folder / NAME
        for file in ("__init__.py", *files):
            self.write(file, files.get(file, ""))

    def write(self, file, text):
        """Write a file, and the packages that it is in."""
        path = self.folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        for parent in path.relative_to(self.folder).parents:
            (self.folder / parent / "__init__.py").touch()
        path.write_text(textwrap.dedent(text), encoding="utf-8")
        self.forget()

    def edit(self, file, old, new):
        """Replace a text that stands once in a file."""
        text = (self.folder / file).read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{file} holds {old!r} {text.count(old)} times"
        self.write(file, text.replace(old, new))

    def code(self, *roots):
        """Return the hash of what some roots, written module.name, depend on."""
        return sources.code(map(self._root, roots))

    def closure(self, *roots):
        """Return what some roots reach, written module.name, and the libraries."""
        found, libraries = sources.closure(frozenset(map(self._root, roots)))
        return {f"{home}.{name}".removeprefix(f"{NAME}.") for home, name in found}, libraries

    def _root(self, text):
        module, _, name = text.rpartition(".")
        return f"{NAME}.{module}", name

    def load(self, module):
        """Import a module of the package as it is now."""
        self.forget()
        return importlib.import_module(f"{NAME}.{module}")

    def forget(self):
        """Forget what was derived from files that may be others now."""
        for one in CACHED:
            one.cache_clear()
        for name in [name for name in sys.modules if name.partition(".")[0] == NAME]:
            del sys.modules[name]
        importlib.invalidate_caches()


def make_toy(folder, monkeypatch):
    """Yield, for a fixture, a function that makes a package of files: name -> text."""
    made, distributions = [], sources._distributions

    def make(files):
        made.append(Toy(folder, files))
        return made[0]

    monkeypatch.setattr(names, "PACKAGE", folder / NAME)
    monkeypatch.setattr(tables, "_known", functools.cache(dict))
    monkeypatch.setattr(tables, "_store", lambda: folder / "tables.json")
    monkeypatch.setattr(tables, "_new", [])
    monkeypatch.setattr(tables, "_seen", set())
    monkeypatch.setattr(
        sources, "_distributions", lambda one: () if one == "kacsim" else distributions(one)
    )
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.syspath_prepend(folder)
    yield make
    for one in made:
        one.forget()
