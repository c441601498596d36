"""Join the shards of one case."""

from kacsim.commands import _shared, sample

EXAMPLE = (
    "merge kac --algorithm bird --n-particles 50 --time 2 --n-draws 100 --n-replicates 4 "
    "--seed 1 --shards 2 --output bird.nc"
)


def add(parser):
    """Add the samplers and their options."""
    for one in _shared.add_samplers(parser):
        one.add_argument("--shards", type=_number, required=True, dest="shard", help="how many")
        one.add_argument("--folder", default="results/shards", help="where they lie")
        sample.add_output(one)


def _number(text):
    return sample.shard(f"1/{text}")


def run(arguments):
    """Join the shards of one case."""
    parts = _shared.case_of(arguments).split(arguments.shard[1])
    from kacsim import files
    from kacsim.jobs import shards

    files.check_writable(arguments.output)
    variables = shards.merged(parts, arguments.folder)
    _shared.write_sample(variables, arguments.output, parts[0].whole())
