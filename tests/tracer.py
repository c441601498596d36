"""What a run of the package really enters, reads and opens: measured, not derived.

Python's own trace tells which functions of the package run and which names they load, opcode by
opcode, with the kernels as plain Python; modules tell which of their attributes are asked for. What
a module does while it is imported belongs to the statement that does it, and is needed where that
statement's names are.
"""

import ast
import contextlib
import dis
import functools
import os
import sys
from collections import defaultdict
from pathlib import Path
from types import ModuleType

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "kacsim"
ENTERED, READ, CALLED = "entered", "read", "called outside"
LOADS = ("LOAD_GLOBAL", "LOAD_NAME")
LOOKUP = "kacsim.kernels.lookup"  # lies outside, but what it gets is for its caller


@functools.cache
def loads(code):
    """Return offset -> name of the instructions that may load a global name."""
    return {i.offset: i.argval for i in dis.get_instructions(code) if i.opname in LOADS}


@functools.cache
def is_ours(file):
    """Tell a file of the package."""
    return file.startswith(f"{PACKAGE}{os.sep}")


class Statement:
    """A statement at the top level of a module.

    Attributes
    ----------
    node : of its tree
    lines : range
    names : set of str, what it stores, as its bytecode says
    imports : dict name -> (module, name there)
    is_import : bool
    """

    def __init__(self, node, package):
        first = min([node.lineno, *(one.lineno for one in getattr(node, "decorator_list", ()))])
        self.lines = range(first, node.end_lineno + 1)
        self.node = node
        code = compile(ast.Module([node], []), "statement", "exec", dont_inherit=True)
        stored = (i.argval for i in dis.get_instructions(code) if i.opname == "STORE_NAME")
        self.names = set(stored) - {"__annotations__", "__doc__"}
        self.is_import = isinstance(node, (ast.Import, ast.ImportFrom))
        self.imports = {}
        for one in ast.walk(node):
            if isinstance(one, ast.ImportFrom):
                assert not one.level, f"{package}: a relative import"
                self.imports |= {n.asname or n.name: (one.module, n.name) for n in one.names}


def modules():
    """Return the names of the modules of the package."""
    files = (file.relative_to(ROOT).with_suffix("") for file in sorted(PACKAGE.rglob("*.py")))
    return [".".join(file.parts).removesuffix(".__init__") for file in files]


@functools.cache
def statements(module):
    """Return the statements of a module of the package."""
    path = ROOT.joinpath(*module.split("."))
    file = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    tree = ast.parse(file.read_text(encoding="utf-8"))
    return [Statement(node, module) for node in tree.body]


class Trace:
    """A trace of this process; it begins before the package is imported."""

    def __init__(self):
        assert not any(name.split(".")[0] == "kacsim" for name in sys.modules)
        self.events = defaultdict(set)  # phase, or (module, line) at its import -> what was done
        self.files = defaultdict(set)  # phase -> files of the project
        self.phase = None
        self.importing = []
        self.codes = []
        self.left = {}  # (context, id of code) -> loads that have not been seen there
        self.states = {}
        asked = self._asked

        class Asking(ModuleType):
            def __getattribute__(self, name):
                return asked(self, name)

        self.asking = Asking
        sys.addaudithook(self._audit)
        sys.settrace(self._call)

    @contextlib.contextmanager
    def running(self, phase):
        """Attribute what is done to a phase."""
        self.phase = phase
        yield
        self.phase = None

    def stop(self):
        """End the trace, and insist that nothing was imported past it."""
        assert sys.gettrace() == self._call
        sys.settrace(None)
        ours = {name: one for name, one in sys.modules.items() if name.split(".")[0] == "kacsim"}
        assert {name for name, one in ours.items() if type(one) is not self.asking} == set()

    def _audit(self, event, arguments):
        if event == "open" and self.phase and isinstance(arguments[0], (str, os.PathLike)):
            path = Path(arguments[0]).absolute()
            library = path.is_relative_to(sys.prefix) or path.suffix in (".py", ".pyc")
            if path.is_relative_to(ROOT) and not library:
                self.files[self.phase].add(str(path.relative_to(ROOT)))

    def _context(self):
        if self.importing:
            frame = self.importing[-1]
            return frame.f_globals["__name__"], frame.f_lineno
        return self.phase

    def _call(self, frame, event, argument):
        code = frame.f_code
        if not is_ours(code.co_filename):
            return None
        if code.co_name == "<module>":
            self.importing.append(frame)
            module = sys.modules[frame.f_globals["__name__"]]
            module.__class__ = self.asking
            frame.f_trace_lines = False
            frame.f_trace_opcodes = not is_outside(frame)
            return self._of_module
        context = self._context()
        if context is None:
            return None
        if is_outside(frame):
            if not is_outside(caller(frame)):
                self._note(context, CALLED, frame, code.co_qualname)
            return None
        self._note(context, ENTERED, frame, code.co_firstlineno)
        left = self.left.get((context, id(code)))
        if left is None:
            left = self.left[context, id(code)] = dict(loads(code))
            self.codes.append(code)  # it shall not leave its id to another
        if not left:
            return None
        frame.f_trace_lines, frame.f_trace_opcodes = False, True

        def of_function(frame, event, argument):
            if event == "opcode" and left.pop(frame.f_lasti, None):
                self._load(context, frame)
                frame.f_trace_opcodes = bool(left)
            return of_function

        return of_function

    def _of_module(self, frame, event, argument):
        if event == "opcode":
            self._load(self._context(), frame)
        elif event == "return":
            self.importing.pop()
            self.states[frame.f_globals["__name__"]] = state(frame.f_globals)
        return self._of_module

    def _load(self, context, frame):
        name = loads(frame.f_code).get(frame.f_lasti)
        if name in frame.f_globals:
            self._note(context, READ, frame, name)

    def _note(self, context, what, frame, which):
        self.events[context].add((what, frame.f_globals["__name__"], which))

    def _asked(self, module, name):
        """Get an attribute of a module; note who asks."""
        value = ModuleType.__getattribute__(module, name)
        context = self._context()
        if context and not name.startswith("__") and not isinstance(value, ModuleType):
            asking = caller(sys._getframe())
            if asking and (not is_outside(asking) or asking.f_globals["__name__"] == LOOKUP):
                home = ModuleType.__getattribute__(module, "__name__")
                self.events[context].add((READ, home, name))
        return value

    def required(self, phase):
        """Return what a phase needs: {(module, name)}, as far as it was seen."""
        needed, done = set(), set()
        waiting = list(self.events[phase])
        while waiting:
            event = waiting.pop()
            if event in done or event[0] not in (ENTERED, READ):
                continue
            done.add(event)
            for module, name in definitions(*event):
                new_module = module not in {home for home, _ in needed}
                needed.add((module, name))
                if "OUTSIDE" not in vars(sys.modules[module]):
                    waiting += self._at_import(module, name, new_module)
        return needed

    def called(self, phase):
        """Return what is called of modules that lie outside, by the package's other code."""
        return {f"{home}.{name}" for what, home, name in self.events[phase] if what == CALLED}

    def published(self, phase):
        """Return the claims whose entries in reports/published/ are read."""
        return {key for what, key, _ in self.events[phase] if what == "published"}

    def opened(self, phase):
        """Return the files of the project that a phase opens, code apart."""
        return self.files[phase]

    def _at_import(self, module, name, with_effects):
        """Yield what the statements of a name did at import, and those that have none."""
        for one in statements(module):
            effect = not one.names and with_effects
            if (name in one.names or effect) and not one.is_import:
                for line in one.lines:
                    yield from self.events.get((module, line), ())

    def changed(self):
        """Return the modules whose plain constants are not what they were after the import."""
        return sorted(
            name
            for name, before in self.states.items()
            if state(vars(sys.modules[name])) != before and "OUTSIDE" not in vars(sys.modules[name])
        )


def is_outside(frame):
    """Tell whether a frame is of a module that decides nothing by its code."""
    return frame is not None and "OUTSIDE" in outside_modules(frame.f_globals["__name__"])


@functools.cache
def outside_modules(module):
    return {name for one in statements(module) for name in one.names} & {"OUTSIDE"}


def caller(frame):
    """Return the nearest frame of the package that a frame was called from, None without one."""
    while frame := frame.f_back:
        if is_ours(frame.f_code.co_filename):
            return frame
    return None


def definitions(what, module, which):
    """Yield the (module, name) of the statements that an event is about.

    Parameters
    ----------
    what, module : ENTERED or READ, and where
    which : first line of the code that is entered, or name that is read
    """
    if what == ENTERED:
        for one in statements(module):
            if which in one.lines:
                yield from ((module, name) for name in one.names)
        return
    value = vars(sys.modules[module]).get(which)
    if isinstance(value, ModuleType) or type(value).__name__ == "_Lazy":
        return  # its attributes are asked for
    bound = [one for one in statements(module) if which in one.names]
    if not bound and "__getattr__" not in vars(sys.modules[module]) and which[:2] != "__":
        yield module, which  # nobody knows where it comes from
    for one in bound:
        if which not in one.imports:
            yield module, which
        elif (home := one.imports[which][0]).split(".")[0] == "kacsim":
            yield from definitions(READ, home, one.imports[which][1])


def state(space):
    """Return the plain values of a module as text; to ask others might import something."""
    plain = (bool, int, float, str, tuple, list, dict, set, frozenset, type(None))
    found = {}
    for name, value in list(space.items()):
        if not name.startswith("__") and isinstance(value, (*plain, np.ndarray)):
            found[name] = value.tobytes() if isinstance(value, np.ndarray) else repr(value)
    return found
