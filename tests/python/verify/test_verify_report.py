"""The reports of a made suite: their words, tables and files."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest
from made_suite import PICTURE, all_stopped, no_reference, one_run, stability, strange, suite, wave, whole_suite

from courant.files import OutputError
from courant.verify import text
from courant.verify.changes import Change, Comparison
from courant.verify.figures import Figure, figures
from courant.verify.model import BoundCheck, CaseResult
from courant.verify.registry import CHARTS, chart
from courant.verify.report import html, verdict, write_page, write_reports
from courant.verify.tables import check_text, runs_table


def test_escaped_texts() -> None:
    assert text.escape_xml("<a href=\"x\" o='y'> & ü\n") == "&lt;a href=&quot;x&quot; o=&#x27;y&#x27;&gt; &amp; ü\n"
    assert text.escape_xml("a\x01z\udcff|\uffff") == "a?z?|?", "a control character, half a character, none of XML"
    assert text.escape_markdown("a|b *c* _d_ `e` <f>\n[g] #1 $x$") == "a\\|b \\*c\\* \\_d\\_ \\`e\\` &lt;f&gt; \\[g\\] \\#1 \\$x\\$"
    assert text.escape_markdown("- no list - here") == "\\- no list - here"


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        (text.number(0), "0"),
        (text.number(-0.0), "0"),
        (text.number(1234.56, 3), "1235"),
        (text.number(0.0123456, 3), "0.0123"),
        (text.number(1.2e-5, 3), "1.2e-5"),
        (text.number(-2.5e9, 3), "-2.5e9"),
        (text.number(math.nan), "not a number"),
        (text.number(-math.inf), "-infinite"),
        (text.percent(0.0123), "1.2 %"),
        (text.percent(0.125), "12.5 %"),
        (text.percent(3.5), "350 %"),
        (text.percent(1e-9), "1e-9"),
        (text.percent(math.inf), "infinite"),
        (text.seconds(3.14), "3.1 s"),
        (text.seconds(754), "12 min 34 s"),
        (text.seconds(7380), "2 h 3 min"),
        (text.integer(-1234567), "-1 234 567"),
        (text.integer(999), "999"),
        (text.megabytes(12_340_000), "12.3"),
        (text.shorten("dünn", 4), "dünn"),
        (text.shorten("dünner", 4), "dün…"),
        (text.file_stem("a/b: c.k"), "a-b-c-k"),
        (text.file_stem("../"), "unnamed"),
    ],
)
def test_numbers_and_words(written: str, expected: str) -> None:
    assert written.replace("\u00a0", " ") == expected


def test_a_missed_bound_differs_from_what_was_measured() -> None:
    assert check_text(BoundCheck("", "a", "error at most", 0.03, 0.0304, False)) == "a: error at most 3\u00a0%, measured 3.04\u00a0%"
    assert check_text(BoundCheck("", "a", "error at most", 0.03, 0.0304, True)) == "a: error at most 3\u00a0%, measured 3\u00a0%"
    assert check_text(BoundCheck("", "a", "order at least", 2, 1.9999, False)) == "a: order at least 2, measured 1.9999"
    assert check_text(BoundCheck("", "", "stable", 1, 0, False)) == "stable: no"


def test_links() -> None:
    assert text.links("See [a_b](c_d.md#e-f), [g].\n[h](x y)") == [("See ", ""), ("a_b", "c_d.md#e-f"), (", [g].\n[h](x y)", "")]
    assert text.links("[here](#there)") == [("here", "#there")]
    assert text.links("[a](<script>) [b](https://x) [c](javascript:d)") == [("[a](<script>) [b](https://x) [c](javascript:d)", "")]


def test_links_of_the_page(tmp_path: Path) -> None:
    made = suite(one_run())
    made.suite.about = "See *all* of [a_b](c_d.md#e-f) & [g]."
    write_page(made, tmp_path / "page.md", tmp_path / "pictures")
    assert "\nSee \\*all\\* of [a\\_b](c_d.md#e-f) &amp; \\[g\\].\n\n**" in (tmp_path / "page.md").read_text()
    assert "<p>See *all* of a_b &amp; [g].</p>" in html(made)


def test_paragraphs() -> None:
    assert text.paragraphs("a\nb\n \n\nc\n") == ["a\nb", "c"]


def test_one_line_says_whether_the_suite_holds() -> None:
    assert verdict(suite(one_run())) == "The suite states no bounds."
    c = one_run()
    c.checks = [BoundCheck("a", "mass", "error at most", 0.1, 0.05, True)]
    assert verdict(suite(c)) == "The one bound is met."
    assert verdict(suite(c, c)) == "All 2 bounds are met."
    assert verdict(suite(c, all_stopped())) == "1 of 2 bounds is missed."
    assert "a, mass: error at most 10\u00a0%, measured not a number" in html(suite(c, all_stopped()))
    assert "MISSED" not in html(suite(c))


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the reports of the whole suite, whose charts take seconds."""
    folder = tmp_path_factory.mktemp("whole")
    write_reports(whole_suite(), folder / "deep" / "down", Comparison("<earlier>", [Change("<change>", True)]))
    write_page(whole_suite(), folder / "page.md", folder / "pictures here")
    return folder


def test_text_of_the_suite_is_text(reports: Path) -> None:
    page = (reports / "deep" / "down" / "report.html").read_text()
    assert "<script" not in page and "&lt;script&gt;" in page
    assert not [raw for raw in ("<in>", "<suite>", "<water>", "<earlier>", "<change>") if raw in page]
    assert "_Markup" not in page and "{{" not in page


def test_nothing_is_loaded(reports: Path) -> None:
    page = (reports / "deep" / "down" / "report.html").read_text()
    assert page.count("http") == 2 * page.count('xmlns="http://www.w3.org/2000/svg"'), "names of SVG's words"
    assert page.count("src=") == 1, "the picture"
    assert 'src="data:image/png;base64,iVBORw0KGgo' in page
    assert not re.search(r"url\((?!#)|href=\"(?!#|data:)", page)


@pytest.mark.parametrize(("case", "charts"), [(wave(), 3), (stability(3, 2), 1), (one_run(), 1)])
def test_a_chart_for_each_observation_and_a_map_for_each_stability_case(case: CaseResult, charts: int) -> None:
    assert html(suite(case)).count("<svg ") == charts


def test_changes_are_there_when_there_is_something_to_compare_with() -> None:
    assert 'id="changes"' not in html(suite(one_run()))
    assert "Nothing has changed." in html(suite(one_run()), Comparison("yesterday's"))
    assert "Worse: slower" in html(suite(one_run()), Comparison("yesterday's", [Change("slower", True)]))


def test_what_cannot_be_drawn_is_told() -> None:
    (stopped,) = figures(all_stopped())
    assert stopped.svg == "" and len(stopped.notes) == 3 and "runaway energy" in stopped.notes[1]
    (free,) = figures(no_reference())  # no chart of errors that do not exist
    assert free.notes == ["the run: 1 of 4 values are not finite numbers and are left out."]
    nothing = one_run()
    nothing.definition.observations, nothing.runs[0].observed = [], []
    assert figures(nothing)[0].notes == ["Nothing is observed that could be drawn."]
    nothing.runs = []
    assert figures(nothing) == []
    assert "There is no run." in html(suite(nothing))
    assert "The suite states no bounds." in html(suite())


def test_runs_have_their_cost_and_the_order_beside_the_finest() -> None:
    table = runs_table(wave())
    assert len(table.rows) == 12 and all(len(row.cells) == len(table.columns) for row in table.rows)
    heads = [column.head for column in table.columns]
    finest = dict(zip(heads, table.rows[3].cells, strict=True))
    assert [finest[h] for h in ("n", "CPU time [s]", "CPU ns per particle-step", "period [s]", "period: order")] == [
        "80",
        "51.2",
        "2043",
        "1.2779",
        "1.00",
    ], "51.2 s / (20880 * 1200)"
    assert table.rows[2].cells[heads.index("period: order")] == ""


def test_stopped_runs_stand_out() -> None:
    table = runs_table(strange())
    assert table.rows[10].bad and not table.rows[0].bad
    assert table.columns[-1].head == "end"
    assert "exit code 2, error: runaway energy" in table.rows[10].cells[-1]


def test_files_are_put_where_they_belong(reports: Path) -> None:
    assert (reports / "deep" / "down" / "report.html").read_text().endswith("</html>\n")
    page = (reports / "page.md").read_text()
    assert "(<pictures here/wave-period-error.svg>)" in page
    assert (reports / "pictures here" / "wave-picture.png").read_bytes() == PICTURE
    svg = (reports / "pictures here" / "wave-period-error.svg").read_text()
    assert svg.startswith("<svg xmlns=") and "prefers-color-scheme" in svg
    shown = re.findall(r"\]\(<(.*?)>\)", page)
    assert len(shown) == 11 and all((reports / name).is_file() for name in shown)


def test_tables_of_the_page_are_tables_of_markdown(reports: Path) -> None:
    for block in (reports / "page.md").read_text().split("\n\n"):
        lines = [line for line in block.split("\n") if line.startswith("|")]
        if lines:
            assert re.fullmatch(r"\|((---:|---)\|)+", lines[1])
            assert len({len(re.findall(r"(?<!\\)\|", line)) for line in lines}) == 1, block


def test_cases_with_the_same_name_are_kept_apart(tmp_path: Path) -> None:
    write_page(suite(one_run(), one_run()), tmp_path / "page.md", tmp_path)
    assert (tmp_path / "one-mass-error.svg").is_file() and (tmp_path / "one-mass-error-2.svg").is_file()
    assert "(<one-mass-error-2.svg>)" in (tmp_path / "page.md").read_text()


def test_files_that_cannot_be_written_are_an_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("not a folder")
    with pytest.raises(OutputError, match="cannot write '"):
        write_reports(suite(), tmp_path / "file" / "below")
    with pytest.raises(OutputError):
        write_page(suite(wave()), tmp_path / "page.md", tmp_path / "file")
    assert not (tmp_path / "page.md").exists()


def test_a_chart_of_ones_own() -> None:
    @chart("cost", of="case")
    def cost(case: CaseResult) -> list[Figure]:
        return [Figure("cost", "Cost of it all", notes=[f"{sum(run.cpu_seconds for run in case.runs):g} s"])]

    try:
        assert "Cost of it all" in html(suite(one_run())) and "1.5 s" in html(suite(one_run()))
    finally:
        del CHARTS.functions["cost"]
