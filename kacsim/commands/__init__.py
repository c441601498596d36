"""The commands of the command line, one a file.

A command is a module with a docstring, whose first line is its help, ``EXAMPLE``, ``add(parser)``
for its options and ``run(arguments)``, which returns the exit status or None. One that reads the
schema, the texts or the published numbers, which are not part of the package, sets ``OF_A_CLONE``.
"""

import pkgutil

NAMES = tuple(
    found.name for found in pkgutil.iter_modules(__path__) if not found.name.startswith("_")
)
