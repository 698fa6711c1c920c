#!/usr/bin/env python3
"""The report of a suite in a browser: headless Chromium loads one made from numbers, 1280 and 400 pixels wide.

usage: report.py MAKE_REPORT WORK_DIR
Bounds: all charts there, no message on the console, nothing loaded, the page no wider than the window, letters of charts at
least 11 pixels high, none outside its chart, none on top of another; light and dark page differ. Screenshots stay in WORK_DIR.
"""
import html
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

from checks import check, failures

make_report, work = sys.argv[1], os.path.abspath(sys.argv[2])
folder = os.path.join(work, "report")
chromium = shutil.which("chromium") or shutil.which("chromium-browser")

# Put into a page of its own that shows the report in a frame: Chromium's window is never narrower than 500 pixels.
MEASURE = """<!DOCTYPE html><meta charset="utf-8"><style>body{margin:0}</style>
<iframe id="frame" src="report.html" style="border:0;width:WIDTHpx;height:2400px"></iframe><pre id="measured"></pre><script>
addEventListener('load', () => {
  const page = document.getElementById('frame').contentDocument, view = page.defaultView, found = {};
  page.querySelectorAll('details').forEach(d => d.open = true);
  const charts = [...page.querySelectorAll('svg.chart')], outside = [], touching = [];
  let letters = 1e9;
  for (const chart of charts) {
    const box = chart.getBoundingClientRect(), texts = [...chart.querySelectorAll('text')];
    letters = Math.min(letters, 13.5 * box.width / chart.viewBox.baseVal.width);
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


def browse(page, *options):
    words = [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--allow-file-access-from-files",
             "--disable-background-networking", "--no-first-run", "--enable-logging=stderr",
             "--user-data-dir=" + os.path.join(work, "chromium"), "--virtual-time-budget=5000", *options, "file://" + page]
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=240)


def measure(width, *options):
    page = os.path.join(folder, f"measure_{width}.html")
    with open(page, "w", encoding="utf-8") as file:
        file.write(MEASURE.replace("WIDTH", str(width)))
    done = browse(page, f"--window-size={max(width, 500)},2400", "--dump-dom", *options)
    found = re.search(r'<pre id="measured">(.*?)</pre>', done.stdout, re.S)
    if not found or not found.group(1):
        sys.exit(f"Chromium measured nothing:\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return json.loads(html.unescape(found.group(1))), page


def on_console(done):
    return [line for line in done.stderr.splitlines() if "CONSOLE" in line]


def check_width(width, charts):
    found, page = measure(width)
    check(found["inside"] == width, f"{width}: the frame is {found['inside']} wide")
    check(found["scroll"] <= width, f"{width}: the page is {found['scroll']} wide")
    check(not found["wide"], f"{width}: nothing stands out of the page {found['wide'][:5]}")
    check(found["charts"] == charts, f"{width}: {found['charts']} charts of {charts}")
    check(found["letters"] >= 11, f"{width}: smallest letters of charts {found['letters']:.1f} pixels, bound 11")
    check(not found["outside"], f"{width}: no letters outside their chart {found['outside'][:5]}")
    check(not found["touching"], f"{width}: no letters on top of others {found['touching'][:5]}")
    check(not found["loaded"], f"{width}: nothing is loaded {found['loaded'][:5]}")
    check(found["title"] == "Made <suite>", f"{width}: title {found['title']!r}")
    check(found["pictures"] == [8], f"{width}: pictures are {found['pictures']} pixels wide")
    check((found["columns"] == 1) == (width == 400), f"{width}: {found['columns']} charts side by side")
    dark, _ = measure(width, "--blink-settings=preferredColorScheme=0")
    check(dark["paper"] != found["paper"], f"{width}: paper {found['paper']}, on a dark page {dark['paper']}")
    shot = os.path.join(work, f"report_{width}.png")
    browse(page, f"--window-size={max(width, 500)},2400", "--screenshot=" + shot)
    with open(shot, "rb") as file:
        head = file.read(24)
    size = struct.unpack(">II", head[16:24])
    check(size[0] == max(width, 500) and os.path.getsize(shot) > 50000, f"{width}: screenshot {size}, {os.path.getsize(shot)} bytes")


shutil.rmtree(folder, ignore_errors=True)
subprocess.run([make_report, folder], check=True)
for name in sorted(os.listdir(os.path.join(folder, "page"))):
    if name.endswith(".svg"):
        ElementTree.parse(os.path.join(folder, "page", name))  # throws where it is not XML
if chromium is None:
    print("skipped: Chromium is not here (Debian: apt-get install chromium)")
    sys.exit(77)

# The check must see what it looks for.
faulty = os.path.join(folder, "faulty.html")
with open(faulty, "w", encoding="utf-8") as file:
    file.write("<!DOCTYPE html><script>nothing.of.the.kind()</script>")
check(on_console(browse(faulty, "--dump-dom")), "self test: an error of a script is seen")

done = browse(os.path.join(folder, "report.html"), "--dump-dom")
check(done.returncode == 0 and done.stdout.rstrip().endswith("</html>"), f"Chromium loads the report, exit code {done.returncode}")
check(not on_console(done), f"no message on the console {on_console(done)[:3]}")
with open(os.path.join(folder, "report.html"), encoding="utf-8") as file:
    charts = file.read().count("<svg ")
check(charts == 10, f"{charts} charts in the file: four of errors, two of curves, four maps")
check(done.stdout.count("<svg ") == charts, "all of them in the document")
for width in (1280, 400):
    check_width(width, charts)

print(f"{len(failures)} failed" if failures else "all good")
sys.exit(1 if failures else 0)
