"""The page draws: the bits of the run, its laws, its speed, its answers to wrong values.

Statistical tests with fixed seeds of the page: |z| <= 4, a chance of 6e-5 for each of six.
"""

import json
import math
import re

import numpy as np
import pytest

from kacsim import boltzmann, kac
from kacsim.boltzmann import bkw
from kacsim.kac import exact

RATE = kac.RATE
CHECKED, BITS = "✓ Checked here", "the bits that the run stored"


def lab(opened, **view):
    page = opened("#lab", **view)
    page.locator("#lab").scroll_into_view_if_needed()
    page.wait_for_function("/^[✓✗]/.test(document.querySelector('[data-status]').textContent)")
    return page


FILL = """(form, wanted) => {
  for (const [name, value] of Object.entries(wanted)) {
    form.elements.namedItem(name).value = value;
    form.dispatchEvent(new Event('input', {bubbles: true}));
  }
}"""


def choose(page, problem="kac", algorithm=None, **values):
    wanted = {"problem": problem} | ({"algorithm": algorithm} if algorithm else {})
    wanted |= {name: str(value) for name, value in values.items()}
    page.eval_on_selector("#lab-room form", FILL, wanted)


def draw(page, button="[data-draw]"):
    """Press a button and wait until all is drawn; return what the page says."""
    page.click(button)
    page.wait_for_function("document.querySelector('[data-stop]').disabled", timeout=60_000)
    return page.inner_text("[data-answer]")


def estimate(text):
    """Return (mean, error, exact or None) of what the page says."""
    mean, error = re.search(r" = (-?[\d.e+-]+) ± ([\d.e+-]+)", text).groups()
    known = re.search(r"exact (-?[\d.e+-]+\d)", text)
    return float(mean), float(error), float(known[1]) if known else None


def test_the_kernels_of_the_page_have_the_bits_of_the_run(opened):
    page = lab(opened)
    status = page.inner_text("[data-status]")
    many = len(json.loads(page.text_content("#lab-data"))["stored"]["checks"])
    assert (
        status
        == f"{CHECKED}: {many} sets of draws by every kernel have the bits that the run stored."
    )
    assert many >= 29


# Slips of the page's scripts, each of which the stored draws must catch.
SLIPS = {
    "seeds-factor": ("Math.imul(hash, factor)", "Math.imul(hash, factor) + 1"),
    "seeds-shift": ("(value ^ (value >>> 16)) >>> 0", "(value ^ (value >> 16)) >>> 0"),
    "seeds-halves": ("halves[2 * k + 1]) << 32n", "halves[2 * k]) << 32n"),
    "seeds-length": ("[own.length, ...own", "[...own"),
    "seeds-long": ("while ((number >>= 32n))", "while ((number >>= 64n))"),
    "bird-rounded-down": ("BigInt(Math.ceil(meanCollisions", "BigInt(Math.floor(meanCollisions"),
    "poisson-partners": ('"poisson" ? n - 1 : n - 2', '"poisson" ? n - 2 : n - 1'),
    "two-particles": ("n === 2 ? 0 : 1 / others", "1 / others"),
    "pairs-whole": ("(rate * n * time) / 2", "rate * n * time"),
    "pairs-of-all-steps": ("meanCollisions(n, given.time_step", "meanCollisions(n, given.time"),
    "energy-of-one": ("1.5 * n, given.tolerance", "n, given.tolerance"),
    "speed-and-time": ("[given.speed, given.time]", "[given.time, given.speed]"),
    "another-stream": ('bkw: "boltzmann.estimate_bkw"', 'bkw: "kac.draw_equilibrium"'),
}  # fmt: skip


CHECK = """async ([old, other, place]) => {
  const text = id => document.getElementById(id).textContent;
  const kernels = Uint8Array.from(atob(text('kernels').trim()), letter => letter.charCodeAt(0));
  if (place) kernels.fill(place, kernels.length * place, kernels.length * place + 200);
  const code = text('worker-code').replace(old, other);
  const worker = new Worker(URL.createObjectURL(new Blob([code])));
  const answer = new Promise(done => {
    worker.onmessage = ({data}) => done(data.told === 'checked' ? data.wrong : data.told);
    worker.onerror = () => done('failed');
    setTimeout(() => done('no answer'), 5000);
  });
  worker.postMessage({kernels, stored: JSON.parse(text('lab-data')).stored});
  const found = await answer;
  worker.terminate();
  return found;
}"""


def test_slips_of_the_scripts_and_of_the_kernels_are_seen(opened):
    """Each is noticed by the stored draws, or the kernels fail or give no answer."""
    page = opened()
    code = page.text_content("#worker-code")
    assert page.evaluate(CHECK, ["", "", 0]) == 0
    for slip, (old, new) in SLIPS.items():
        assert code.count(old) == 1, slip
        assert page.evaluate(CHECK, [old, new, 0]) != 0, slip
    for place in (0.2, 0.4, 0.6, 0.8):
        assert page.evaluate(CHECK, ["", "", place]) != 0, place


def test_draws_of_kac(opened):
    """The first draws are those of `kac.draw`; the mean is that of the process."""
    page = lab(opened)
    choose(page, "kac", "bird", n_particles=7, time=1.7, seed=2**70 + 5)
    text = draw(page)
    mean, error, known = estimate(text)
    assert known == pytest.approx(kac.fourth_moment(1.7, 7, algorithm="bird"), rel=1e-4)
    assert abs(mean - known) <= 4.0 * error
    assert abs(mean - kac.fourth_moment(3.4, 7, algorithm="bird")) > 20.0 * error
    first = re.search(r"first: (.*?)\.?$", text)[1].split(", ")
    wanted = kac.draw("bird", n_particles=7, time=1.7, n_draws=8192, seed=2**70 + 5)
    assert [float(one) for one in first] == pytest.approx(wanted[:4], rel=1e-5)
    assert page.inner_text("[data-python]") == (
        f'kac.draw("bird", n_particles=7, time=1.7, n_draws=8192, seed={2**70 + 5})'
    )
    assert page.locator("[data-pictures] svg").count() == 2


def test_the_law_on_the_page_is_that_of_eq_8(opened):
    """TVN of draws of very many particles is that of exact draws."""
    page = lab(opened)
    choose(page, "kac", "poisson", n_particles=10**12, time=2.0)
    text = draw(page)
    tvn, floor = map(float, re.search(r"TVN = ([\d.]+), of exact draws ([\d.]+)", text).groups())
    assert 0.8 * floor < tvn < 1.3 * floor
    page.fill("#lab-room [name=n_particles]", "3")
    tvn = float(re.search(r"TVN = ([\d.]+)", draw(page))[1])
    assert tvn > 3.0 * floor


def test_draws_of_the_bkw_mode(opened):
    page = lab(opened)
    choose(page, "bkw", speed=2.5, time=1.7, seed=3)
    mean, error, known = estimate(draw(page))
    assert known == pytest.approx(float(bkw.relative_density(2.5, 1.7)), rel=1e-4)
    assert abs(mean - known) <= 4.0 * error
    assert abs(mean - float(bkw.relative_density(2.5, 1.2))) > 20.0 * error
    own = boltzmann.estimate_bkw(2.5, 1.7, method="free_leaf", n_realizations=100_000, seed=3)
    deviation = math.sqrt(own.variance) / float(bkw.maxwellian(2.5))
    assert error == pytest.approx(deviation / 1000.0, rel=0.1)


def test_a_million_more_moves_the_interval_of_a_claim(opened):
    page = lab(opened)
    choose(page, "perfect", n_particles=3, tolerance="1e-6", seed=4)
    texts = [draw(page), draw(page, "[data-more]")]
    widths = []
    for text in texts:
        low, high = map(
            float,
            re.search(r"interval of row kac_51_perfect \[([\d.]+), ([\d.]+)\]", text).groups(),
        )
        widths.append(high - low)
        assert low < exact.equilibrium_fourth_moment(3) < high
    assert widths[1] == pytest.approx(widths[0] / math.sqrt(2.0), rel=0.02)
    assert texts[1].startswith("2,0")
    assert texts[1].count("reproduced") == 1
    mean, error, known = estimate(texts[1])
    assert known == pytest.approx(exact.equilibrium_fourth_moment(3), rel=1e-4)
    assert abs(mean - known) <= 4.0 * error


def test_a_million_draws_a_second(opened):
    page = lab(opened)
    choose(page, "kac", "bird", n_particles=50, time=2.0)
    fastest = max(float(re.search(r"([\d.]+) million a second", draw(page))[1]) for _ in range(3))
    assert fastest > 1.0


# values, the field at fault, and what the project itself says of it
WRONG = [
    ("kac", "bird", {"n_particles": "1"}, "n_particles"),
    ("kac", "bird", {"n_particles": "2.5"}, "n_particles"),
    ("kac", "bird", {"n_particles": "1e3"}, "n_particles"),
    ("kac", "bird", {"n_particles": ""}, "n_particles"),
    ("kac", "poisson", {"n_particles": 10**15 + 1}, "n_particles"),
    ("kac", "bird", {"time": "0"}, "time"),
    ("kac", "bird", {"time": "-1"}, "time"),
    ("kac", "bird", {"time": "soon"}, "time"),
    ("kac", "bird", {"seed": "-1"}, "seed"),
    ("kac", "nanbu_synchronous", {"time": "2", "time_step": "0.3"}, "time_step"),
    ("kac", "nanbu_synchronous", {"time": "2", "time_step": "2"}, "time_step"),
    ("kac", "nanbu_babovsky", {"n_particles": "3", "time": "2", "time_step": "1"}, "time_step"),
    ("perfect", None, {"tolerance": "0"}, "tolerance"),
    ("perfect", None, {"n_particles": "3", "tolerance": "1e-14"}, "tolerance"),
]


def sentence_of(problem, algorithm, values):
    """Return the sentence of Python's own checks."""
    given = (
        {"n_particles": 50, "time": 2.0}
        if problem == "kac"
        else {"n_particles": 50, "tolerance": 1e-6}
    )
    given |= {"seed": 1, "n_draws": 1}
    for name, text in values.items():
        try:
            given[name] = json.loads(str(text))
        except json.JSONDecodeError:
            given[name] = str(text)
        if name == "n_particles" and isinstance(given[name], float):
            given[name] = str(text)
    function = kac.draw_equilibrium if algorithm is None else kac.draw
    with pytest.raises(ValueError, match=": ") as refused:
        function(*filter(None, [algorithm]), **given)
    return str(refused.value).partition(": ")[2]


def test_wrong_values_get_the_sentence_of_the_project(opened):
    page = lab(opened)
    for problem, algorithm, values, field in WRONG:
        choose(page, problem, algorithm, **({"seed": 1} | RIGHT[problem] | values))
        page.eval_on_selector("#lab-room form", "form => form.requestSubmit()")
        said = page.inner_text(f"#lab-{field}-note").partition(": ")[2]
        wanted = sentence_of(problem, algorithm, values)
        assert said.partition(" for ")[0] == wanted.partition(" for ")[0], values
        assert page.get_attribute(f"#lab-room [name={field}]", "aria-invalid") == "true"
        assert page.evaluate("document.activeElement.name") == field
    assert page.inner_text("[data-answer]") == "Nothing has been drawn yet."


RIGHT = {
    "kac": {"n_particles": 50, "time": 2},
    "perfect": {"n_particles": 50, "tolerance": "1e-6"},
}


def test_what_would_take_too_long_is_refused_or_can_be_stopped(opened):
    page = lab(opened)
    choose(page, "kac", "poisson", n_particles=10**9, time="30")
    page.click("[data-draw]")
    assert "must be earlier: about 1e+09 ancestors" in page.inner_text("#lab-time-note")
    choose(page, "perfect", n_particles="200", tolerance="1e-9")
    page.click("[data-draw]")
    page.wait_for_timeout(300)
    assert page.evaluate("1 + 1") == 2  # the page answers
    page.click("[data-stop]")
    page.wait_for_function("document.querySelector('[data-status]').textContent.startsWith('✓')")
    choose(page, "bkw", speed="1", time="0.5")
    assert "draws" in draw(page)


def test_by_the_keyboard_alone(opened):
    page = lab(opened)
    page.focus("#lab-room [name=n_particles]")
    page.keyboard.press("Control+A")
    page.keyboard.type("9")
    page.keyboard.press("Enter")
    page.wait_for_function("document.querySelector('[data-answer]').textContent.includes('E v')")
    assert page.locator("[data-answer]").get_attribute("role") == "status"


def test_pictures_follow_what_is_drawn(opened):
    """The bars of the histogram have the area of the draws that they show."""
    page = lab(opened)
    choose(page, "kac", "bird", n_particles=50, time=2.0)
    draw(page)
    bars = page.get_attribute("[data-pictures] path.bars", "d")
    tops = [float(y) for y in re.findall(r"V([\d.]+)H", bars)]
    ends = [(float(a), float(b)) for a, b in re.findall(r"M([\d.]+) [\d.]+V[\d.]+H([\d.]+)", bars)]
    curve = np.array(
        [
            [float(x) for x in one.split()]
            for one in re.split("[ML]", page.get_attribute("[data-pictures] path.exact", "d"))[1:]
        ]
    )
    middle = np.array([(a + b) / 2 for a, b in ends])
    under = np.interp(middle, curve[:, 0], curve[:, 1])
    assert np.abs(np.array(tops) - under).mean() < 3.0  # of 200 points high
    assert np.abs(np.array(tops)[3:] - under[:-3]).mean() > 10.0
