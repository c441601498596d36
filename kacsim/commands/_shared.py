"""What several commands share: options, and the plan that a configuration makes."""

from kacsim import plan
from kacsim.cases import flag, make_case
from kacsim.checks import Problem
from kacsim.samplers import REQUIRED, registry, whole


def add_config(parser):
    """Add the option that names configuration files."""
    text = "configuration of the run; later files override (default config/config.yaml)"
    default = ["config/config.yaml"]
    parser.add_argument("--config", nargs="+", default=default, metavar="FILE", help=text)


def add_item(parser):
    """Add the option that chooses one item."""
    parser.add_argument("--item", help="the cases of one item only")


def checked_plan(arguments):
    """Return the plan of the configuration."""
    return plan.Plan(plan.read_config(*arguments.config), arguments.config)


def planned(arguments):
    """Return (plan, cases of the wanted item or of all items)."""
    checked = checked_plan(arguments)
    if arguments.item is None:
        return checked, list(checked.cases.values())
    if arguments.item not in checked.cases_of:
        known = ", ".join(checked.cases_of)
        raise plan.PlanError(f"--item = {arguments.item!r}: must be one of {known}")
    return checked, checked.cases_of[arguments.item]


def known_item(name):
    """Return the module of an item, or refuse the name."""
    from kacsim import items

    if name not in items.NAMES:
        raise plan.PlanError(f"item = {name!r}: must be one of {', '.join(items.NAMES)}")
    return items.load(name)


def add_samplers(parser):
    """Add the samplers to a command on one case; yield the parser of each."""
    found = parser.add_subparsers(required=True, metavar="sampler", dest="sampler")
    for sampler in registry().values():
        one = found.add_parser(
            sampler.name, help=sampler.draws, description=f"Draw {sampler.draws}."
        )
        of_variants = {p.name for variant in sampler.variants for p in variant.parameters}
        for parameter in sampler.parameters_of({}):
            optional = parameter.default is not REQUIRED or parameter.name in of_variants
            many = {"nargs": "+"} if parameter.many else {}
            one.add_argument(
                flag(parameter.name),
                type=parameter.kind,
                required=not optional,
                help=parameter.meaning,
                **many,
            )
        one.add_argument("--n-draws", type=whole, required=True, help="draws of a replicate")
        one.add_argument("--n-replicates", type=whole, default=1, help="default 1")
        one.add_argument("--seed", type=whole, required=True)
        yield one


def case_of(arguments):
    """Return the case that the flags of `sample` or `merge` describe."""
    sampler = registry()[arguments.sampler]
    given = {p.name: getattr(arguments, p.name) for p in sampler.parameters_of({})}
    size = {name: getattr(arguments, name) for name in ("n_draws", "n_replicates", "seed")}
    try:
        case = make_case(sampler.name, **given, **size, shard=arguments.shard)
    except ValueError as error:
        raise plan.PlanError(flag(str(error))) from error
    problems = [Problem(flag(p.name), p.value, p.allowed) for p in case.problems()]
    if problems:
        raise plan.PlanError("\n".join(map(str, problems)))
    return case


def write_sample(variables, path, case):
    """Write the samples of a case, or of a shard, with what `store.read_sample` will check.

    A name that ends in .csv gets the values alone, as a table.
    """
    from kacsim import store

    if str(path).endswith(".csv"):
        import xarray as xr

        from kacsim.recipes import lines
        from kacsim.report import csv_table

        csv_table.write(xr.Dataset(variables), path, lines.of_case(case))
        return
    store.write_sample(variables, path, case)
