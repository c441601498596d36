"""Numbers and sentences as the report prints them: signs, digits, powers of ten."""

import math
import re

from markupsafe import Markup, escape

THIN_SPACE, FIXED_SPACE, MINUS = "\u202f", "\u00a0", "\u2212"
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value, digits=6):
    """Return a number as text: grouped thousands, true minus sign, powers of ten raised."""
    value = float(value)
    if not math.isfinite(value):
        return "not a number" if math.isnan(value) else f"{MINUS * (value < 0)}∞"
    if value == round(value) and abs(value) < 1e15:
        return fixed(value, 0)
    if 1e-4 <= abs(value) < 1e15:
        text = fixed(value, max(0, digits - 1 - math.floor(math.log10(abs(value)))))
        return text.rstrip("0").rstrip(".") if "." in text else text
    mantissa, exponent = f"{value:.1e}".replace("-", MINUS, value < 0).split("e")
    factor = "" if mantissa == "1.0" else f"{mantissa.removesuffix('.0')}·"
    return factor + power(int(exponent))


def fixed(value, places):
    """Return a number with a fixed count of decimals."""
    text = f"{value:,.{places}f}" if abs(value) >= 1e4 else f"{value:.{places}f}"
    return text.replace(",", THIN_SPACE).replace("-", MINUS)


def power(exponent):
    """Return a power of ten, its exponent raised."""
    return f"10{str(exponent).translate(SUPERSCRIPT)}"


def listed(values):
    """Return numbers or words as a list in words: 1, 2 and 3."""
    words = [value if isinstance(value, str) else number(value) for value in values]
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]])) or "none"


def decimals(error):
    """Return the decimals that show two digits of an error."""
    return max(0, 1 - math.floor(math.log10(error)))


def pm(value, error):
    """Return an estimate as text, with two digits of its standard error if it has one."""
    value, error = float(value), float(error)
    if not error > 0:
        return number(value, 4)
    if (size := max(abs(value), error)) < 1e-3:
        k = math.floor(math.log10(size))
        return f"({pm(value / 10.0**k, error / 10.0**k)})·{power(k)}"
    return f"{fixed(value, decimals(error))} ± {fixed(error, decimals(error))}"


def span(low, high):
    """Return an interval as text, both ends with the digits that show its width."""
    low, high = float(low), float(high)
    if not (math.isfinite(low) and math.isfinite(high)):
        return f"{number(low)} to {number(high)}"
    if 0.0 < (size := max(abs(low), abs(high))) < 1e-3:
        k = math.floor(math.log10(size))
        return f"({span(low / 10.0**k, high / 10.0**k)})·{power(k)}"
    if not high > low:
        return number(low)
    places = decimals((high - low) / 2.0)
    return f"{fixed(low, places)} to {fixed(high, places)}"


def beside(value, error):
    """Return a number with the digits of an estimate that it stands beside, as `pm` shows it."""
    value = float(value)
    if not error > 0 or value == 0:
        return number(value)
    if (size := max(abs(value), error)) < 1e-3:
        k = math.floor(math.log10(size))
        return f"{beside(value / 10.0**k, error / 10.0**k)}·{power(k)}"
    return fixed(value, decimals(error))


def measured(dataset, name, **place):
    """Return a variable with its error as text, at a place and the published bin width."""
    here = dataset.isel(bin_width=0) if "bin_width" in dataset.dims else dataset
    here = here.sel(**place)
    return pm(here[name], here[f"{name}_error"])


def typeset(text):
    """Return a sentence with true minus signs and raised powers of ten."""
    text = re.sub(r"(?<=\d)e([+-]\d+)\b", lambda found: f"·{power(int(found[1]))}", text)
    return re.sub(r"(?<=[\s=(])-(?=\d)", MINUS, text)


def bound(text):
    """Return a text whose formulas and estimates do not break at = and at ±."""
    return re.sub(" ([=±]) ", rf"{FIXED_SPACE}\1{FIXED_SPACE}", text)


def subscripted(text):
    """Return a text, escaped, in which N_t and the like have a subscript of one character."""
    return Markup(re.sub(r"\b([^\W\d_])_(\w)\b", r"\1<sub>\2</sub>", str(escape(text))))


def printed(value, error):
    """Return a published number with its own digits, and its error, if known, with as many."""
    if not error > 0:
        return number(value)
    places = max(len(str(value).partition(".")[2]), -math.floor(math.log10(error)))
    return f"{number(value)} ± {fixed(error, places)}"
