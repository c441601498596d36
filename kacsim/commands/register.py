"""Write down the sets of all verdicts, before a run with another seed is judged by them."""

from kacsim import files

EXAMPLE = "register"
OF_A_CLONE = True


def add(parser):
    """Add the options."""
    parser.add_argument("--datasets", default="results/datasets", metavar="FOLDER")


def run(arguments):
    """Write reports/registered.yaml from the datasets of a run of the full configuration."""
    from pathlib import Path

    from kacsim import store
    from kacsim.kernels import provenance
    from kacsim.report import registered

    commit = provenance.commit()
    if not commit.isalnum() or commit == "unknown":
        raise files.StoreError(f"commit = {commit!r}: must be that of a clean checkout")
    paths = sorted(Path(arguments.datasets).glob("*_numbers.nc"))
    if not paths:
        raise files.StoreError(f"{arguments.datasets}: holds no *_numbers.nc; run snakemake first")
    registered.write({path.stem: store.read(path) for path in paths}, commit, registered.PATH)
    print(f"{registered.PATH}: the sets of commit {commit}")
