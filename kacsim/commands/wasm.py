"""Compile the kernels that the page of the report runs itself, to WebAssembly."""

EXAMPLE = "wasm --module kernels.wasm --draws draws.json"
OF_A_CLONE = True


def add(parser):
    """Add the options."""
    parser.add_argument("--module", required=True, metavar="FILE", help="the kernels")
    parser.add_argument(
        "--draws", required=True, metavar="FILE", help="draws that the page compares its own with"
    )


def run(arguments):
    """Write the module, and the draws of the run's own kernels."""
    import json
    from pathlib import Path

    from kacsim import files
    from kacsim.wasm import building, stored

    files.check_writable(arguments.module)
    text = json.dumps(stored.content(), ensure_ascii=False, sort_keys=True)
    files.replace_file(arguments.draws, lambda name: Path(name).write_text(text, encoding="utf-8"))
    building.write(arguments.module)
