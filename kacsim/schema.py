"""The configuration's schema: every violation at once, and defaults filled in."""

import copy
import difflib
import math

import jsonschema

from kacsim.checks import LARGEST_COUNT, MISSING
from kacsim.files import read_yaml


def complete(config, schema_file):
    """Return (configuration with defaults, problems).

    Parameters
    ----------
    config : dict
    schema_file : path of the JSON schema, in YAML

    Returns
    -------
    (dict, list of (path, value, sentence))
    """
    schema = read_yaml(schema_file)
    config = copy.deepcopy(config)
    _fill(config, schema)
    strict = jsonschema.validators.extend(
        jsonschema.Draft202012Validator, type_checker=_type_checker()
    )
    validator = strict(schema)
    errors = sorted(validator.iter_errors(config), key=lambda error: list(map(str, error.path)))
    problems = [problem for error in errors for problem in _problems(error)]
    return config, problems + list(_huge(config, ()))


def _huge(value, path):
    """Yield the whole numbers that no counter holds; a seed may be any."""
    if isinstance(value, (dict, list)):
        inside = value.items() if isinstance(value, dict) else enumerate(value)
        for key, one in inside:
            yield from _huge(one, (*path, key))
    elif isinstance(value, int) and abs(value) > LARGEST_COUNT and path != ("seed",):
        yield path, value, f"must be at most {LARGEST_COUNT}"


def _type_checker():
    """Return JSON's types, but 3.0 is no integer and infinity and nan are no numbers."""

    def is_integer(_, value):
        return isinstance(value, int) and not isinstance(value, bool)

    def is_number(_, value):
        finite = isinstance(value, float) and value - value == 0.0
        return finite or is_integer(_, value)

    checker = jsonschema.Draft202012Validator.TYPE_CHECKER
    return checker.redefine("integer", is_integer).redefine("number", is_number)


def _fill(config, schema):
    for key, rule in schema.get("properties", {}).items():
        if "properties" in rule:
            if isinstance(config.setdefault(key, {}), dict):
                _fill(config[key], rule)
        elif "default" in rule:
            config.setdefault(key, copy.deepcopy(rule["default"]))


def _problems(error):
    path = tuple(error.absolute_path)
    if error.validator == "additionalProperties":
        known = list(error.schema["properties"])
        for key in error.instance:
            if key not in known:
                yield (*path, key), MISSING, _unknown(key, known)
        return
    yield path, error.instance, f"must be {_allowed(error)}{_misread(error.instance)}"


def _misread(value):
    """Return a hint for a number that YAML takes for text, such as 1e-6 without a point."""
    try:
        number = float(value) if isinstance(value, str) else math.nan
    except ValueError:
        return ""
    return f"; YAML reads {value} as text, write {number:.1e}" if math.isfinite(number) else ""


def _unknown(key, known):
    near = difflib.get_close_matches(str(key), known, n=1)
    others = f"known: {', '.join(known)}" if known else "no keys are known here"
    hint = f"did you mean {near[0]}?" if near else others
    return f"unknown key; {hint}"


def _allowed(error):
    """Return what the failed rule allows, in words."""
    bound = error.validator_value
    sentences = {
        "type": f"of type {bound}",
        "minimum": f"at least {bound}",
        "exclusiveMinimum": f"greater than {bound}",
        "maximum": f"at most {bound}",
        "exclusiveMaximum": f"less than {bound}",
        "enum": f"one of {bound}",
        "const": f"{bound}",
        "minItems": f"a list of at least {bound} values",
        "uniqueItems": "a list without repetitions",
    }
    sentence = sentences.get(error.validator, error.message)
    description = error.schema.get("description") if isinstance(error.schema, dict) else None
    return f"{sentence} ({description})" if description else sentence
