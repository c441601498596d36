"""Make the dataset of one item from its samples."""

import json
from pathlib import Path

from kacsim import plan
from kacsim.commands import _shared

EXAMPLE = "reduce kac_fig4 --settings '{...}' --output results/datasets/kac_fig4.nc"
OF_A_CLONE = True


def add(parser):
    """Add the options."""
    parser.add_argument("item")
    parser.add_argument("--settings", required=True, help="the item's settings, as JSON")
    parser.add_argument("--samples", default="results/samples", metavar="FOLDER")
    parser.add_argument("--output", required=True)


def run(arguments):
    """Make the dataset of an item."""
    module = _shared.known_item(arguments.item)
    try:
        settings = json.loads(arguments.settings)
    except json.JSONDecodeError as error:
        raise plan.PlanError(
            f"--settings = {arguments.settings!r}: is not JSON: {error}"
        ) from error
    from kacsim import items, store
    from kacsim.jobs import stages

    wanted = module.cases(settings)
    folder = Path(arguments.samples)
    samples = {case.id: store.read_sample(folder / f"{case.id}.nc", case) for case in wanted}
    dataset = items.reduced(arguments.item, samples, settings)
    about = {
        "title": module.__doc__.splitlines()[0],
        "settings": settings,
        "code": stages.code(stages.reduce_roots(arguments.item)),
    }
    store.write(dataset.assign_attrs(item=arguments.item), arguments.output, **about)
