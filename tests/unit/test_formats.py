"""Figures for columns, pages and talks: their width, their fonts, their panels."""

import pytest
from matplotlib.text import Text

from kacsim import cli, store
from kacsim.drawing import formats, plotting


def drawn(columns=2):
    figure, axes = plotting.panels(1, columns, share_y=True)
    for k, axis in enumerate(axes):
        plotting.points(axis, [1.0, 2.0], [1.0, 2.0], [0.1, 0.1], 0, f"series {k}")
        axis.legend()
    axes[0].set_ylabel("value")
    return figure


@pytest.mark.parametrize("name", formats.STYLES)
@pytest.mark.parametrize("columns", [1, 2, 3])
def test_width_and_fonts(columns, name, tmp_path):
    figure = drawn(columns)
    formats.fit(figure, name)
    plotting.save(figure, tmp_path / "a.svg", "recipe")
    style = formats.STYLES[name]
    assert figure.get_size_inches()[0] == pytest.approx(style["width"])
    shown = [text for text in figure.findobj(Text) if text.get_text() and text.get_visible()]
    sizes = {round(text.get_fontsize(), 6) for text in shown}
    assert max(sizes) == pytest.approx(style["font"])
    assert min(sizes) >= 0.8 * style["font"]


def test_a_column_has_its_panels_in_a_column():
    figure = drawn(2)
    formats.fit(figure, "column")
    figure.draw_without_rendering()
    first, second = (axes.get_window_extent() for axes in figure.axes)
    assert first.y0 > second.y1
    assert first.x0 == pytest.approx(second.x0, abs=2.0)
    assert [axes.get_ylabel() for axes in figure.axes] == ["value", "value"]
    wide = drawn(2)
    formats.fit(wide, "page")
    wide.draw_without_rendering()
    first, second = (axes.get_window_extent() for axes in wide.axes)
    assert first.x1 < second.x0


def test_lines_of_a_talk_are_thicker():
    talk, page = drawn(1), drawn(1)
    formats.fit(talk, "talk")
    formats.fit(page, "page")
    widths = [figure.axes[0].lines[0].get_linewidth() for figure in (talk, page)]
    assert widths[0] > 1.5 * widths[1]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["kac_fig4", "--style", "poster", "--output", "a.svg"], "--style = 'poster': must be one"),
        (["kac_fig4", "--output", "a.gif"], "--output = 'gif': must be one of svg, png, pdf"),
        (["kac_fog", "--output", "a.svg"], "item = 'kac_fog': must be one of kac_fig1"),
        (["kac_fig4", "--output", "a.svg", "--dataset", "none.nc"], "none.nc"),
    ],
)
def test_bad_input(words, sentence, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["figure", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert sentence in line
    assert list(tmp_path.iterdir()) == []


def test_what_does_not_fit_is_said(tmp_path, monkeypatch, capsys):
    """Tables of many words are wider than a column."""

    def wide(dataset):
        figure, axes = plotting.stack([1.0, 1.0], width=9.0)
        for axis in axes:
            axis.set_yticks([0.5], ["many words " * 20])
        return figure

    monkeypatch.setattr("kacsim.items.kac_fig4.draw", wide)
    monkeypatch.setattr(store, "read_dataset", lambda path, item: store.read_dataset)
    monkeypatch.setattr("kacsim.recipes.lines.of_figure", lambda dataset, code: "recipe")
    output = str(tmp_path / "a.svg")
    assert cli.main(["figure", "kac_fig4", "--style", "column", "--output", output]) == 2
    assert "kac_fig4 does not fit; take page" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
