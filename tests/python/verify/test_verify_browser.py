"""The report of a made suite in a browser: headless Chromium loads it, 1280 and 400 pixels wide, light and dark.

Bounds: all charts there, no message on the console, nothing loaded, the page no wider than the window, letters of charts at least 11
pixels high, none outside its chart, none on top of another; light and dark page differ.
"""

from __future__ import annotations

import html
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from made_suite import whole_suite

from courant.verify.changes import Change, Comparison
from courant.verify.report import write_reports

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="Chromium is not here (Debian: apt-get install chromium)")
CHARTS = 10  # four of errors, two of curves, four maps

# Put into a page of its own that shows the report in a frame: Chromium's window is never narrower than 500 pixels.
MEASURE = """<!DOCTYPE html><meta charset="utf-8"><style>body{margin:0}</style>
<iframe id="frame" src="report.html" style="border:0;width:WIDTHpx;height:2400px"></iframe><pre id="measured"></pre><script>
addEventListener('load', () => {
  const page = document.getElementById('frame').contentDocument, view = page.defaultView;
  page.querySelectorAll('details').forEach(d => d.open = true);
  const charts = [...page.querySelectorAll('svg.chart')], outside = [], touching = [];
  let letters = 1e9;
  for (const chart of charts) {
    const box = chart.getBoundingClientRect(), texts = [...chart.querySelectorAll('text')];
    for (const t of texts) letters = Math.min(letters, parseFloat(view.getComputedStyle(t).fontSize) * box.width / chart.viewBox.baseVal.width);
    const boxes = texts.map(t => t.getBoundingClientRect());
    boxes.forEach((b, i) => {
      const name = chart.getAttribute('aria-label') + ': ' + texts[i].textContent;
      if (b.left < box.left - 1 || b.right > box.right + 1 || b.top < box.top - 1 || b.bottom > box.bottom + 1) outside.push(name);
      for (let k = 0; k < i; ++k) {
        const c = boxes[k];
        if (b.left < c.right - 1 && c.left < b.right - 1 && b.top < c.bottom - 3 && c.top < b.bottom - 3)
          touching.push(name + ' and ' + texts[k].textContent);
      }
    });
  }
  const wide = [...page.querySelectorAll('body *')].filter(e => !e.closest('.scroll') && e.getBoundingClientRect().right > WIDTH + 1);
  document.getElementById('measured').textContent = JSON.stringify({
    inside: view.innerWidth, scroll: Math.max(page.documentElement.scrollWidth, page.body.scrollWidth), charts: charts.length,
    letters, outside, touching, wide: wide.map(e => e.tagName + ' ' + e.textContent.slice(0, 40)),
    loaded: view.performance.getEntriesByType('resource').map(r => r.name).filter(n => !n.startsWith('data:')),
    title: page.title, pictures: [...page.images].map(i => i.naturalWidth), paper: view.getComputedStyle(page.body).backgroundColor,
    columns: new Set([...page.querySelectorAll('#case-1-wave .figures > figure')].map(f => f.getBoundingClientRect().left)).size});
});</script>"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("report")
    write_reports(
        whole_suite(),
        out,
        Comparison("an earlier report <of yesterday>", [Change("wave is slower by 12 %", True), Change("strange is faster")]),
    )
    return out


def browse(page: Path, *options: str) -> subprocess.CompletedProcess[str]:
    words = [
        str(CHROMIUM),
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--hide-scrollbars",
        "--allow-file-access-from-files",
        "--disable-background-networking",
        "--no-first-run",
        "--enable-logging=stderr",
        f"--user-data-dir={page.parent / 'chromium'}",
        "--virtual-time-budget=5000",
        *options,
        f"file://{page}",
    ]
    return subprocess.run(words, capture_output=True, text=True, timeout=240, check=False)


def on_console(done: subprocess.CompletedProcess[str]) -> list[str]:
    return [line for line in done.stderr.splitlines() if "CONSOLE" in line]


def measure(folder: Path, width: int, *options: str) -> dict:
    page = folder / f"measure_{width}.html"
    page.write_text(MEASURE.replace("WIDTH", str(width)))
    done = browse(page, f"--window-size={max(width, 500)},2400", "--dump-dom", *options)
    found = re.search(r'<pre id="measured">(.+?)</pre>', done.stdout, re.S)
    assert found, f"Chromium measured nothing:\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}"
    return json.loads(html.unescape(found[1]))


def test_it_loads_without_a_message(folder: Path) -> None:
    faulty = folder / "faulty.html"
    faulty.write_text("<!DOCTYPE html><script>nothing.of.the.kind()</script>")
    assert on_console(browse(faulty, "--dump-dom")), "an error of a script is seen"
    done = browse(folder / "report.html", "--dump-dom")
    assert done.returncode == 0 and done.stdout.rstrip().endswith("</html>")
    assert on_console(done) == []
    assert (folder / "report.html").read_text().count("<svg ") == done.stdout.count("<svg ") == CHARTS


@pytest.mark.parametrize("width", [1280, 400])
def test_all_is_readable(folder: Path, width: int) -> None:
    found = measure(folder, width)
    assert (found["inside"], found["charts"], found["title"], found["pictures"]) == (width, CHARTS, "Made <suite>", [8])
    assert found["scroll"] <= width and found["letters"] >= 11
    assert (found["wide"], found["outside"], found["touching"], found["loaded"]) == ([], [], [], [])
    assert (found["columns"] == 1) == (width == 400)
    assert measure(folder, width, "--blink-settings=preferredColorScheme=0")["paper"] != found["paper"], "a dark page is dark"
