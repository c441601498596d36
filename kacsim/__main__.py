"""Entry point of ``python -m kacsim``."""

import sys

from kacsim.cli import main

if __name__ == "__main__":
    sys.exit(main())
