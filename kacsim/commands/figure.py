"""Draw a figure for a journal's column or page, or for a talk."""

import warnings

from kacsim.commands import _shared

EXAMPLE = "figure kac_fig4 --style column --output fig4.pdf"


def add(parser):
    """Add the options."""
    parser.add_argument("item")
    parser.add_argument("--style", default="page", metavar="STYLE", help="column, page or talk")
    parser.add_argument("--dataset", metavar="FILE", help="default results/datasets/ITEM.nc")
    parser.add_argument("--output", required=True, metavar="FILE", help="svg, png or pdf")


def run(arguments):
    """Draw the figure of a dataset at the width and with the fonts of a style."""
    module = _shared.known_item(arguments.item)
    from kacsim import files, store
    from kacsim.drawing import formats, plotting
    from kacsim.jobs import stages
    from kacsim.recipes import carriers, lines

    styles, kinds = list(formats.STYLES), list(carriers.FIELD)
    suffix = arguments.output.rpartition(".")[2]
    for name, value, known in (("style", arguments.style, styles), ("output", suffix, kinds)):
        if value not in known:
            raise files.StoreError(f"--{name} = {value!r}: must be one of {', '.join(known)}")
    files.check_writable(arguments.output)
    path = arguments.dataset or f"results/datasets/{arguments.item}.nc"
    dataset = store.read_dataset(path, arguments.item)
    recipe = lines.of_figure(dataset, stages.code(stages.draw_roots(arguments.item)))
    figure = module.draw(dataset)
    formats.fit(figure, arguments.style)
    with warnings.catch_warnings():
        warnings.filterwarnings("error", "constrained_layout not applied")
        try:
            plotting.save(figure, arguments.output, recipe)
        except UserWarning as error:
            sentence = f"--style = {arguments.style!r}: {arguments.item} does not fit; take page"
            raise files.StoreError(sentence) from error
