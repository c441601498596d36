"""Draw the figure of one item from its dataset."""

from kacsim.commands import _shared

EXAMPLE = "draw kac_fig4 --dataset results/datasets/kac_fig4.nc --output fig4.png"
OF_A_CLONE = True


def add(parser):
    """Add the options."""
    parser.add_argument("item")
    parser.add_argument("--dataset", required=True)
    parser.add_argument(
        "--output",
        required=True,
        nargs="+",
        help="svg, png, pdf, csv; csv-metadata.json, marks.json, sha256",
    )


def run(arguments):
    """Draw the figure of an item, and write the numbers behind it."""
    module = _shared.known_item(arguments.item)
    from kacsim import files, store
    from kacsim.drawing import marks, plotting
    from kacsim.jobs import stages
    from kacsim.recipes import carriers, lines
    from kacsim.report import csv_table, figures

    dataset = store.read_dataset(arguments.dataset, arguments.item)
    recipe = lines.of_figure(dataset, stages.code(stages.draw_roots(arguments.item)))
    figure = module.draw(dataset)
    cases = stages.drawn_from(module.cases(dataset.attrs["settings"]))
    sums = [path for path in arguments.output if path.endswith(".sha256")]
    drawn = [path for path in arguments.output if path not in sums]
    later = []
    for path in drawn:
        if path.endswith(".csv"):
            csv_table.write(dataset, path, recipe)
        elif path.endswith(figures.MARKS):
            later.append(path)  # where panels lie is known when a figure has been drawn
        elif not path.endswith(carriers.TABLE):  # which a table brings with it
            plotting.save(figure, path, recipe)
    for path in later:
        marks.write(figure, path, dataset, cases)
    for path in sums:
        files.write_sums(drawn, path)
