"""The public interface has types: written for every argument, and stubs that name all of it.

mypy judges them in the gate, with tests/types_in_use.py. The stubs are made by
``PYTHONPATH=. python tests/unit/test_types.py``.
"""

import ast
import importlib
import inspect

import pytest

from kacsim.kernels.provenance import ROOT

PACKAGES = ("boltzmann", "kac", "maxwell", "techniques")


def homes(package):
    """Yield (module, public name) as the package's own text attaches them."""
    tree = ast.parse((ROOT / "kacsim" / package / "__init__.py").read_text())
    (call,) = (node for node in ast.walk(tree) if isinstance(node, ast.Call))
    (given,) = (one.value for one in call.keywords if one.arg == "submod_attrs")
    for module, names in ast.literal_eval(given).items():
        for name in names:
            yield module, name


def stub(package):
    """Return the text of a package's stub."""
    lines = [f"from .{home} import {name} as {name}" for home, name in homes(package)]
    first = "# The public names, for tools that run nothing; made by tests/unit/test_types.py."
    return "\n".join([first, "", *sorted(lines), ""])


def path(package):
    return ROOT / "kacsim" / package / "__init__.pyi"


@pytest.mark.parametrize("package", PACKAGES)
def test_stubs_name_what_is_public(package):
    assert path(package).read_text() == stub(package)
    assert {name for _, name in homes(package)} == set(
        importlib.import_module(f"kacsim.{package}").__all__
    )


@pytest.mark.parametrize("package", PACKAGES)
def test_every_argument_and_result_has_a_type(package):
    module = importlib.import_module(f"kacsim.{package}")
    functions = [
        one for one in (getattr(module, name) for name in module.__all__) if inspect.isfunction(one)
    ]
    assert functions
    for function in functions:
        signature = inspect.signature(function)
        bare = [
            name
            for name, one in signature.parameters.items()
            if one.annotation is inspect.Parameter.empty
        ]
        assert not bare, f"{function.__name__}: {', '.join(bare)}"
        assert signature.return_annotation is not inspect.Signature.empty, function.__name__


if __name__ == "__main__":
    for one in PACKAGES:
        path(one).write_text(stub(one))
