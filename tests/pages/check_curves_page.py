#!/usr/bin/env python3
"""The page of a sweep with curves, given axes and further figures in a real browser: check_curves_page.py PAGE ARTEFACTS NAME"""

import json
import re
import sys

from browser import Browser
from checks import Checks, chart_data, leave_pictures, place_of, table_of


def data_of(page):
    with open(page, encoding="utf-8") as file:
        return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', file.read(), re.S).group(1))


def labels(browser):
    return browser.evaluate("Chart.getChart('scatter').legend.legendItems.map((item) => item.text)")


def expected_curves(data, screens):
    """By curve and screen the points in the order of the methods, as the data has them."""
    found = {}
    for row in data["rows"]:
        method, screen = row["values"]
        if screen in screens and row["figures"][0] is not None:
            name = data["axes"][0]["curves"][method] + (f", {data['axes'][1]['values'][screen]}" if len(screens) > 1 else "")
            found.setdefault(name, []).append({"x": row["figures"][0], "y": row["figures"][1]})
    return found


def check_curves(browser, checks, data, screens, what):
    found = browser.evaluate("Object.fromEntries(Chart.getChart('scatter').data.datasets.slice(6).map((set) => [set.label, set.data]))")
    checks.equal(found, expected_curves(data, screens), f"curves, {what}")
    marked = {(point["x"], point["y"]) for group in (2, 3) for point in chart_data(browser, "scatter")[group]}
    front = {tuple(row["figures"][:2]) for row in data["rows"] if row.get("front") and row["values"][1] in screens and row["figures"][0] is not None}
    checks.equal(marked, front, f"the marked front, {what}")
    stairs = [(point["x"], point["y"]) for point in chart_data(browser, "scatter")[4] if point["x"] is not None]
    checks.equal(set(stairs), front, f"the stairs, {what}")
    checks.equal(sum(1 for point in chart_data(browser, "scatter")[4] if point["x"] is None), len(screens) - 1, f"gaps between stairs, {what}")


def press(browser, selector):
    left, top, width, height = place_of(browser, selector)
    browser.press(left + width / 2, top + height / 2)


def main():
    page, artefacts, name = sys.argv[1:4]
    data = data_of(page)
    checks = Checks()
    with Browser() as browser:
        browser.size(1280, 900)
        browser.open(page)
        check_curves(browser, checks, data, [1], "the baseline's case at first")
        checks.equal(browser.evaluate("Chart.getChart('scatter').options.plugins.title.text"), "screen large", "the case above the chart")
        checks.equal(browser.evaluate("['x', 'y'].map((axis) => Chart.getChart('scatter').scales[axis].type)"), ["logarithmic"] * 2, "scales")
        ticks = browser.evaluate("['x', 'y'].flatMap((axis) => { const s = Chart.getChart('scatter').scales[axis]; return s.ticks.map((t) => t.value >= s.min && t.value <= s.max); })")
        checks.true(len(ticks) > 4 and all(ticks), "ticks within the scales")
        shown = labels(browser)
        checks.true(all(curve in shown for curve in ("flat", "cut", "exact", "baseline")), f"curves in the legend: {shown}")
        checks.true(not {"beaten", "chosen", "breaks a constraint"} & set(shown), f"what is not drawn is not in the legend: {shown}")
        rows = table_of(browser, "Table")
        checks.equal(rows[0][-2], "drawn_pieces (triangles)", "the further figure's heading")
        checks.equal([row[-2] for row in rows[1:]], [str(row["figures"][2]) for row in data["rows"] if row["values"][1] == 1], "its column")
        press(browser, 'input[data-axis="1"][data-value="0"]')
        check_curves(browser, checks, data, [0, 1], "two cases")
        checks.equal(browser.evaluate("Chart.getChart('scatter').options.plugins.title.display"), False, "no title for two cases")
        press(browser, 'input[data-axis="1"][data-value="1"]')
        check_curves(browser, checks, data, [0], "the other case")
        browser.evaluate("(() => { const box = document.getElementById('axis-x'); box.value = '2'; box.dispatchEvent(new Event('change')); })()")
        sets = chart_data(browser, "scatter")
        checks.equal(sorted(point["x"] for group in sets[:4] for point in group), sorted(row["figures"][2] for row in data["rows"] if row["values"][1] == 0),
                     "points over a further figure")
        checks.equal(sets[4], [], "no front over what counts for nothing")
        checks.equal(browser.evaluate("Chart.getChart('scatter').scales.x.type"), "linear", "its scale")
        checks.equal(browser.complaints(), [], "the console, used")
        browser.open(page)
        leave_pictures(browser, checks, page, artefacts, name)
    checks.finish()


main()
