"""Figures to read off: what a mark tells is in the dataset; curves, a closer look, files."""

import csv
import io
import json
import re
from xml.etree import ElementTree

import numpy as np
import pytest

from kacsim import store
from kacsim.items import kac_fig3

FIGURE = "figure[data-item={}]"
ITEMS = ("kac_fig2", "kac_fig3", "kac_fig4", "boltzmann_fig4")


def marks_of(page):
    return json.loads(page.text_content("#marks"))


def numbers(dataset):
    """Return all numbers of a dataset, and sums and differences that error bars end at."""
    return np.unique(
        np.concatenate([dataset[name].values.ravel() for name in dataset.variables
                        if dataset[name].dtype.kind in "if"]).astype(float)
    )  # fmt: skip


def close(value, known):
    return bool(np.isclose(known, value, rtol=5.1e-6, atol=0.0).any())


def to(page, item):
    page.evaluate(
        f"document.querySelector('{FIGURE.format(item)}').scrollIntoView({{block: 'center'}})"
    )
    plate = page.locator(f"{FIGURE.format(item)} .plate")
    plate.focus()
    return plate


def told(page, item):
    """Return (x, y, error or None) that the last chosen mark tells."""
    text = page.inner_text(f"{FIGURE.format(item)} output").replace("\N{MINUS SIGN}", "-")
    text = re.sub(r"(\d) ± ", r"\1±", text)
    values = re.findall(r" = (-?[\d.e+-]+?)(?:±(-?[\d.e+-]+?))?[;.] ", text)
    (x, _), (y, error) = values[0], values[-1]
    return float(x), float(y), float(error) if error else None


@pytest.mark.parametrize("item", ITEMS)
def test_what_marks_hold_is_in_the_dataset(item, opened, results):
    """Every point with an error bar, to six digits: value and error."""
    known = numbers(store.read(results / f"datasets/{item}.nc"))
    series = [one for axes in marks_of(opened())[item]["axes"] for one in axes["series"]]
    points = [one for one in series if "error" in one]
    if item != "kac_fig4":  # of histograms
        assert points
    for one in points:
        for value, error in zip(one["y"], one["error"], strict=True):
            assert close(value, known), (one["label"], value)
            assert close(error, known), (one["label"], error)
    bars = [one for one in series if one["kind"] == "bars"]
    assert all(close(value, known) for one in bars for value in one["y"])


def test_the_keyboard_walks_through_the_marks(opened, results):
    page = opened()
    item = "kac_fig3"
    to(page, item)
    page.keyboard.press("ArrowRight")
    first = told(page, item)
    axes = marks_of(page)[item]["axes"][0]["series"][0]
    assert first[1] == pytest.approx(axes["y"][0])
    assert first[2] == pytest.approx(axes["error"][0], rel=0.05)
    page.keyboard.press("ArrowRight")
    if len(axes["y"]) > 1:
        assert told(page, item)[1] == pytest.approx(axes["y"][1])
    page.keyboard.press("ArrowDown")
    other = marks_of(page)[item]["axes"][0]["series"][1]
    assert told(page, item)[1] == pytest.approx(other["y"][0])
    assert page.locator("#tip").is_visible()
    assert "draws" in page.inner_text("#tip")
    page.keyboard.press("Escape")
    assert not page.locator("#tip").is_visible()


def test_a_mark_tells_the_draws_that_it_is_from(opened, results):
    """As the item itself says which case that is; the data that are saved say it too."""
    page = opened()
    item = "kac_fig3"
    settings = store.read(results / f"datasets/{item}.nc").attrs["settings"]
    grid = kac_fig3._grid(settings)
    to(page, item)
    for k, n in enumerate(settings["n_particles"]):
        page.keyboard.press("ArrowRight")
        text = page.inner_text(f"{FIGURE.format(item)} output")
        assert f"N = {n};" in text
        assert text.endswith(f". {grid[0, k].title()}.")
    page.keyboard.press("ArrowDown")
    other = page.inner_text(f"{FIGURE.format(item)} output")
    assert other.endswith(f". {grid[1, 0].title()}.")
    rows = list(csv.DictReader(io.StringIO(saved(page, item, "csv"))))
    drawn = [row["draws"] for row in rows if row["error"]]
    assert drawn == [case.title() for case in grid.values()]


def test_marks_in_space_tell_three_velocities(opened, results):
    page = opened()
    item = "kac_fig7"
    dataset = store.read(results / f"datasets/{item}.nc")
    series = [one["label"] for one in marks_of(page)[item]["axes"][0]["series"]]
    assert {"points", "their images", "image of the octant"} <= set(series)
    to(page, item)
    for name, label in (("before", "points"), ("after", "their images")):
        while not page.inner_text(f"{FIGURE.format(item)} output").startswith(f"{label};"):
            page.keyboard.press("ArrowDown" if name == "after" else "ArrowRight")
        text = page.inner_text(f"{FIGURE.format(item)} output").replace("\N{MINUS SIGN}", "-")
        found = [float(x) for x in re.findall(r"v[₁₂₃] = (-?[\d.e-]+)[;.]", text)]
        assert np.isclose(dataset[name].values, found, rtol=1e-5).all(axis=1).any()
    ring = page.locator(f"{FIGURE.format(item)} .ring").bounding_box()
    own = next(o for o in marks_of(page)[item]["axes"][0]["series"] if o["label"] == label)
    places = page.locator(f"[id='{item}-{own['id']}'] use")
    boxes = [places.nth(k).bounding_box() for k in range(places.count())]
    middle = ring["x"] + ring["width"] / 2, ring["y"] + ring["height"] / 2
    assert any(
        abs(b["x"] + b["width"] / 2 - middle[0]) < 1.0
        and abs(b["y"] + b["height"] / 2 - middle[1]) < 1.0
        for b in boxes
    )


def test_pointing_at_a_mark_tells_it(opened):
    """At the place where the figure has drawn it, not where a script thinks that it is."""
    page = opened()
    item = "kac_fig3"
    to(page, item)
    own = marks_of(page)[item]["axes"][0]["series"][0]
    use = page.locator(f"[id='{item}-{own['id']}'] use").nth(len(own["y"]) - 1)
    box = use.bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2 + 2, box["y"] + box["height"] / 2 + 1)
    tip = page.inner_text("#tip").replace("\N{MINUS SIGN}", "-")
    assert f"= {float(own['y'][-1]):.6g}" in tip
    page.mouse.move(box["x"] + 2000, 5)
    assert not page.locator("#tip").is_visible()


def test_pictures_at_a_glance_are_there_when_near_and_for_paper(opened):
    page = opened()
    pictures, places = page.locator(".thumb svg use"), page.locator(".thumb").count()
    assert pictures.count() == 0
    page.evaluate("document.getElementById('gallery').scrollIntoView()")
    page.wait_for_selector(".thumb svg use", state="attached")
    assert page.locator(".thumb svg").first.bounding_box()["height"] > 50
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert pictures.count() == places > 10


def test_curves_are_switched_off_and_on(opened):
    page = opened()
    item = "kac_fig3"
    to(page, item)
    own = marks_of(page)[item]["axes"][0]["series"][0]
    shape = page.locator(f"[id='{item}-{own['id']}']").first
    button = page.locator(f"{FIGURE.format(item)} [data-curve='{own['label']}']")
    assert button.get_attribute("aria-pressed") == "true"
    button.focus()
    page.keyboard.press("Enter")
    assert button.get_attribute("aria-pressed") == "false"
    assert "off" in shape.get_attribute("class")
    assert not shape.is_visible()
    to(page, item).press("ArrowRight")
    assert own["label"] not in page.inner_text(f"{FIGURE.format(item)} output").split(";")[0]
    button.click()
    assert shape.is_visible()


def test_a_closer_look(opened):
    page = opened()
    item = "kac_fig4"
    svg = page.locator(f"{FIGURE.format(item)} .plate svg")
    whole = [float(x) for x in svg.get_attribute("viewBox").split()]
    plate = to(page, item)
    plate.press("+")
    near = [float(x) for x in svg.get_attribute("viewBox").split()]
    assert near[2] == pytest.approx(whole[2] / 1.5)
    box = svg.bounding_box()
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(*middle)
    page.mouse.down()
    page.mouse.move(middle[0] + 40, middle[1])
    page.mouse.up()
    moved = [float(x) for x in svg.get_attribute("viewBox").split()]
    assert moved[0] < near[0]
    for _ in range(12):
        plate.press("+")
    assert float(svg.get_attribute("viewBox").split()[2]) >= whole[2] / 12 - 1e-3
    page.click(f"{FIGURE.format(item)} [data-tool=whole]")
    assert [float(x) for x in svg.get_attribute("viewBox").split()] == whole


def saved(page, item, tool):
    with page.expect_download() as download:
        page.click(f"{FIGURE.format(item)} [data-tool={tool}]")
    assert download.value.suggested_filename == f"{item}.{tool}"
    return download.value.path().read_text(encoding="utf-8")


def test_data_are_saved_from_the_page(opened):
    page = opened()
    item = "boltzmann_fig4"
    to(page, item)
    rows = list(csv.DictReader(io.StringIO(saved(page, item, "csv"))))
    axes = marks_of(page)[item]["axes"]
    values = [y for one in axes for series in one["series"] for y in series["y"]]
    errors = [
        e for one in axes for s in one["series"] for e in s.get("error", [None] * len(s["y"]))
    ]
    for name, wanted in (("y", values), ("error", errors)):
        found = [float(row[name]) if row[name] else None for row in rows]
        assert found == wanted


def test_a_saved_figure_stands_alone(opened, chromium, tmp_path):
    """It is SVG with all its letters, and looks like the figure on the page."""
    page = opened()
    item = "kac_fig4"
    to(page, item)
    text = saved(page, item, "svg")
    root = ElementTree.fromstring(text)
    used = {e.get("href")[1:] for e in root.iter("{http://www.w3.org/2000/svg}use")}
    there = {e.get("id") for e in root.iter() if e.get("id")}
    assert used <= there
    assert any("Sans" in name for name in used)


@pytest.mark.parametrize("item", ["kac_fig2", "boltzmann_fig4", "kac_fig7"])
def test_the_page_changes_nothing_of_a_figure(item, chromium, results, opened, tmp_path):
    """Rounded, its letters shared, styles moved to groups: the same picture to the eye."""
    from PIL import Image, ImageChops

    page = opened()
    to(page, item)
    page.evaluate("document.activeElement.blur()")
    svg = page.locator(f"{FIGURE.format(item)} .plate svg")
    shot = svg.screenshot(path=tmp_path / "page.png")
    box = svg.bounding_box()
    alone = chromium.new_page(viewport={"width": 1300, "height": 1000})
    address = (results / f"figures/{item}.svg").as_uri()
    size = f"width: {box['width']}px; height: {box['height']}px; display: block"
    (tmp_path / "a.html").write_text(
        f"<body style='margin: 0'><img src='{address}' style='{size}'>"
    )
    alone.goto((tmp_path / "a.html").as_uri())
    alone.locator("img").screenshot(path=tmp_path / "alone.png")
    alone.close()
    assert shot
    one, other = (Image.open(tmp_path / f"{n}.png").convert("L") for n in ("page", "alone"))
    size = min(one.width, other.width), min(one.height, other.height)
    both = [
        image.crop((0, 0, *size)).resize((size[0] // 4, size[1] // 4)) for image in (one, other)
    ]
    assert unlike(*both) < 0.005  # letters that fall between pixels otherwise
    # Controls: a figure that is shifted, and one without its letters or marks.
    assert unlike(both[0], ImageChops.offset(both[1], 2)) > 0.01
    assert unlike(both[0], Image.new("L", both[0].size, 255)) > 0.01


def unlike(one, other):
    """Return the share of the pixels that differ, of pictures that are a quarter of the size."""
    from PIL import ImageChops

    return float((np.asarray(ImageChops.difference(one, other), float) > 48).mean())
