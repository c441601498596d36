"""The texts that the report is made of, and where they lie."""

from kacsim import files
from kacsim.kernels.provenance import ROOT

TEXTS = ROOT / "reports"


def read_text(path):
    """Return the text of a file; StoreError names one that cannot be read."""
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise files.StoreError(f"{path}: cannot be read: {error}") from error
