#!/usr/bin/env python3
"""The page of a sweep in a real browser, held against the data inside it: check_sweep_page.py PAGE ARTEFACTS NAME"""

import json
import math
import os
import re
import sys

from browser import Browser
from checks import Checks, chart_data, leave_pictures, place_of, table_of


def data_of(page):
    with open(page, encoding="utf-8") as file:
        return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', file.read(), re.S).group(1))


def number(figure):
    return math.inf if figure == "inf" else -math.inf if figure == "-inf" else figure


class Expected:
    """What the chart should show of the points that pass a filter, over two objectives; by comparing all with all."""

    def __init__(self, data, x, y, passes=lambda row: True):
        self.rows = [row for row in data["rows"] if passes(row)]
        self.drawn = [row for row in self.rows if row["state"] == "done" and all(
            row["figures"][k] is not None and math.isfinite(number(row["figures"][k])) for k in (x, y))]
        self.points = sorted([number(row["figures"][x]), number(row["figures"][y])] for row in self.drawn)
        met = [[number(row["figures"][k]) for k in (x, y)] for row in self.drawn if row.get("allowed", True)]
        sign = [-1 if data["objectives"][k]["most"] else 1 for k in (x, y)]

        def beats(p, q):
            no_worse = all(s * a <= s * b for s, a, b in zip(sign, p, q))
            return no_worse and p != q
        self.front = sorted({tuple(q) for q in met if not any(beats(p, q) for p in met)})


def check_scatter(browser, checks, expected, what):
    sets = chart_data(browser, "scatter")
    drawn = sorted([point["x"], point["y"]] for group in sets[:4] for point in group)
    checks.equal(drawn, expected.points, f"points, {what}")
    checks.equal(sorted((point["x"], point["y"]) for point in sets[4]), expected.front, f"the front of the two axes, {what}")
    checks.true(len(drawn) > 0, f"no points, {what}")


def check_groups(browser, checks, data):
    sets = chart_data(browser, "scatter")
    baseline = data["baseline"]
    checks.equal({point["row"] for point in sets[2]},
                 {k for k, row in enumerate(data["rows"]) if row.get("front") and k != baseline and row["figures"][0] is not None and row["figures"][1] is not None},
                 "the front of all objectives")
    checks.equal([point["row"] for point in sets[3]], [] if baseline is None else [baseline], "the baseline")
    checks.true(all(not data["rows"][point["row"]].get("allowed", True) for point in sets[1]), "points that break a constraint")


def check_tooltip(browser, checks, data):
    left, top, _, _ = place_of(browser, "#scatter")
    x, y = browser.evaluate("(() => { const point = Chart.getChart('scatter').getDatasetMeta(3).data[0]; return [point.x, point.y]; })()")
    browser.point(left + x, top + y)
    lines = browser.evaluate("(Chart.getChart('scatter').tooltip.body || []).flatMap((item) => item.lines)")
    row = data["rows"][data["baseline"]]
    for axis, value in zip(data["axes"], row["values"]):
        checks.true(any(line.startswith(f"{axis['path']} = {axis['values'][value]}") for line in lines), f"{axis['path']} in the tooltip: {lines}")


def choose_axis(browser, axis, objective):
    browser.evaluate(f"(() => {{ const box = document.getElementById('axis-{axis}'); box.value = '{objective}'; box.dispatchEvent(new Event('change')); }})()")


def check_filter(browser, checks, data):
    filters = [k for k, axis in enumerate(data["axes"]) if 1 < len(axis["values"]) <= 12]
    checks.true(len(filters) > 0, "a parameter with boxes")
    axis = filters[-1]
    selector = f"input[data-axis=\"{axis}\"][data-value=\"0\"]"
    before = len(table_of(browser, "Table"))
    left, top, width, height = place_of(browser, selector)
    browser.press(left + width / 2, top + height / 2)
    expected = Expected(data, 0, 1, lambda row: row["values"][axis] != 0)
    check_scatter(browser, checks, expected, "filtered")
    rows = table_of(browser, "Table")
    checks.equal(sorted(int(row[0]) for row in rows[1:]), sorted(row["number"] for row in expected.rows), "rows of the table, filtered")
    checks.true(len(rows) < before, "the filter leaves rows away")
    left, top, width, height = place_of(browser, selector)
    browser.press(left + width / 2, top + height / 2)
    checks.equal(len(table_of(browser, "Table")), before, "all rows are back")


def check_table(browser, checks, data):
    rows = table_of(browser, "Table")
    checks.equal(len(rows) - 1, len(data["rows"]), "a row a point")
    for line, row in list(zip(rows[1:], data["rows"]))[::37]:
        checks.equal(line[2:2 + len(data["axes"])], [axis["values"][value] for axis, value in zip(data["axes"], row["values"])], "values of a point")
    column = 2 + len(data["axes"])
    header = f"#table th:nth-child({column + 1})"
    for descending in (False, True):
        left, top, width, height = place_of(browser, header)
        browser.press(left + width / 2, top + height / 2)
        order = [int(row[0]) for row in table_of(browser, "Table")[1:]]
        figures = {row["number"]: number(row["figures"][0]) for row in data["rows"]}
        told = [figures[k] for k in order if figures[k] is not None]
        checks.equal(told, sorted(told, reverse=descending), "sorted by the first objective")
        checks.equal([figures[k] for k in order[len(told):]], [None] * (len(order) - len(told)), "what is missing comes last")


def check_thumbnails(browser, checks, data):
    widths = browser.evaluate("[...document.querySelectorAll('#thumbnails img')].map((image) => image.naturalWidth)")
    checks.equal(len(widths), len(data["thumbnails"]), "pictures")
    checks.true(all(width > 0 for width in widths), "every picture can be read")
    if widths:
        left, top, width, height = place_of(browser, "#thumbnails figure:nth-child(2) img")
        browser.press(left + width / 2, top + height / 2)
        chosen = data["rows"][data["thumbnails"][1]["row"]]
        checks.true(browser.evaluate("document.querySelector('#chosen h3').textContent").startswith(f"Point {chosen['number']}"), "the chosen point")


def check_paper(browser, checks, data):
    browser.call("Emulation.setEmulatedMedia", media="print")
    printed = browser.evaluate("[...document.querySelectorAll('#table tbody tr')].filter((row) => row.offsetHeight > 0).length")
    kept = sum(1 for k, row in enumerate(data["rows"]) if row.get("front") or k == data["baseline"])
    checks.equal(printed, kept, "rows on paper: the front and the baseline")
    browser.call("Emulation.setEmulatedMedia", media="")


def main():
    page, artefacts, name = sys.argv[1:4]
    data = data_of(page)
    checks = Checks()
    with Browser() as browser:
        browser.size(1280, 900)
        browser.open(page)
        check_scatter(browser, checks, Expected(data, 0, 1), "at first")
        check_groups(browser, checks, data)
        if data["baseline"] is not None:
            check_tooltip(browser, checks, data)
        check_table(browser, checks, data)
        check_filter(browser, checks, data)
        last = len(data["objectives"]) - 1
        choose_axis(browser, "x", last)
        check_scatter(browser, checks, Expected(data, last, 1), "over another objective")
        check_thumbnails(browser, checks, data)
        check_paper(browser, checks, data)
        checks.equal(browser.evaluate("typeof window.intruder"), "undefined", "a script in a name")
        checks.equal(browser.complaints(), [], "the console, used")
        browser.open(page)
        leave_pictures(browser, checks, page, artefacts, name)
    checks.finish()


main()
