#!/usr/bin/env python3
"""The page of a run in a real browser, held against the files of the run: check_run_page.py DIRECTORY ARTEFACTS NAME"""

import json
import os
import sys

from browser import Browser
from checks import Checks, chart_data, leave_pictures, place_of, table_of
from picture import read_png


def kind_of(name):
    return "".join("#" if c.isdigit() else c for c in name)


def check_charts(browser, checks, report):
    sums = [sum(parts) for parts in zip(*chart_data(browser, "units-chart"))]
    checks.true(len(sums) > 0, "bars of units")
    checks.close(sums, [100.0] * len(sums), "a unit's parts")
    named = browser.evaluate("Chart.getChart('units-chart').data.labels")
    for k, unit in enumerate(report["units"]):
        if unit["name"] in named:
            bar = named.index(unit["name"])
            checks.close([chart_data(browser, "units-chart")[0][bar]], [100.0 * unit["busy"] / unit["cycles"]], unit["name"])
    checks.equal({kind_of(n).rstrip("#-") for n in named} >= {kind_of(u["name"]).rstrip("#") for u in report["units"]}, True,
                 "every kind of unit has a bar")
    checks.close(chart_data(browser, "budgets-chart")[0], [100.0 * b["used"] / b["available"] for b in report["budgets"]], "budgets")
    links = {link["name"]: link for link in report["links"]}
    over, active = chart_data(browser, "links-chart")
    for name, of_run, of_activity in zip(browser.evaluate("Chart.getChart('links-chart').data.labels"), over, active):
        if name in links:
            peak = links[name]["peak_bytes_per_s"]
            checks.close([of_run, of_activity], [100.0 * links[name][key] / peak for key in ("achieved_bytes_per_s", "active_bytes_per_s")], name)
    if "deadlines" in report:
        lines, worst = chart_data(browser, "slack-chart")
        slack = report["deadlines"]["lines"]["slack_cycles"]
        checks.equal([point["y"] for point in lines], slack, "slack of every line")
        checks.equal([worst[0]["y"], slack[worst[0]["x"]]], [min(slack)] * 2, "the worst line is marked")


def pixel(browser, x, y):
    return browser.evaluate(f"Array.from(document.getElementById('compare').getContext('2d').getImageData({x}, {y}, 1, 1).data).slice(0, 3)")


def check_pictures(browser, checks, shown, error):
    columns, lines, frame = shown
    probes = [(x * (columns - 1) // 6, y * (lines - 1) // 6) for x in range(7) for y in range(7)]
    left, top, width, height = place_of(browser, "#slider")
    for end, (_, _, expected), what in ((width - 2, shown, "the frame"), (2, error, "the error map")):
        browser.press(left + width / 2, top + height / 2, dx=end - width / 2)
        for x, y in probes:
            checks.equal(pixel(browser, x, y), expected(x, y), f"{what} at {x}, {y}")
    browser.press(left + 2, top + height / 2, dx=width / 2 - 2)  # half and half
    checks.equal(pixel(browser, 1, lines // 2), frame(1, lines // 2), "left of the slider")
    checks.equal(pixel(browser, columns - 2, lines // 2), error[2](columns - 2, lines // 2), "right of the slider")
    left, top, width, height = place_of(browser, "#compare")
    for x, y in ((columns // 3, lines // 2), (columns // 2 + 1, lines // 2)):
        browser.point(left + (x + 0.5) * width / columns, top + (y + 0.5) * height / lines)
        rows = browser.evaluate("[...document.querySelectorAll('#pixel-values tr')].map((row) => [...row.cells].map((cell) => cell.textContent))")
        checks.equal(rows[1], ["frame", *map(str, frame(x, y))], f"values of the frame at {x}, {y}")
        checks.equal([int(a) - int(b) for a, b in zip(rows[1][1:], rows[2][1:])], [int(d) for d in rows[3][1:]], "differences of levels")


def check_configuration(browser, checks):
    rows = table_of(browser, "Configuration")
    keys = {row[0]: row for row in rows}
    checks.true(keys.get("video.columns", ["", "", ""])[2] != "", "video.columns has an origin")
    left, top, width, height = place_of(browser, "#changed-only")
    browser.press(left + width / 2, top + height / 2)
    changed = table_of(browser, "Configuration")
    checks.equal(changed[1:], [row for row in rows[1:] if row[2] != "default"], "what differs from the defaults")
    checks.true(len(changed) < len(rows), "there are defaults")


def check_blame(browser, checks, report, blamed):
    columns, lines, colour = blamed
    rows = table_of(browser, "What made pixels wrong")
    steps = [(frame, step) for frame in report["blame"]["frames"] for step in frame["steps"]]
    checks.equal([row[:3] for row in rows[1:]],
                 [[str(frame["frame"]), " " + step["step"], f"{step['blamed_pixels']:,}"] for frame, step in steps], "blamed steps")
    browser.evaluate("""for (const box of document.querySelectorAll('select'))
      if ([...box.options].some((option) => option.value === 'blame')) { box.value = 'blame'; box.dispatchEvent(new Event('change')); }""")
    for x, y in [(x * (columns - 1) // 6, y * (lines - 1) // 6) for x in range(7) for y in range(7)]:
        checks.equal(pixel(browser, x, y), colour(x, y), f"the blamed step at {x}, {y}")
    named = {entry["colour"]: entry["name"] for entry in report["blame"]["legend"]}
    left, top, width, height = place_of(browser, "#compare")
    x, y = columns // 2, lines // 2
    browser.point(left + (x + 0.5) * width / columns, top + (y + 0.5) * height / lines)
    told = browser.evaluate("document.getElementById('pixel-values').textContent")
    checks.true(f"Blamed here: {named['#%02x%02x%02x' % tuple(colour(x, y))]}." in told, "the step under the pointer")


def main():
    directory, artefacts, name = sys.argv[1:4]
    page = os.path.join(directory, "report.html")
    with open(os.path.join(directory, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    checks = Checks()
    with Browser() as browser:
        browser.size(1280, 900)
        browser.open(page)
        with open(os.path.join(directory, "report.txt"), encoding="utf-8") as file:
            checks.equal(browser.evaluate("document.querySelector('.answer').textContent"), file.readline().rstrip("\n"), "the answer")
        check_charts(browser, checks, report)
        check_pictures(browser, checks, read_png(os.path.join(directory, "frame_0000.png")), read_png(os.path.join(directory, "error_0000.png")))
        check_configuration(browser, checks)
        if "blame" in report:
            check_blame(browser, checks, report, read_png(os.path.join(directory, "blame_0000.png")))
        checks.equal(browser.evaluate("typeof window.intruder"), "undefined", "a script in a name")
        browser.open(page)
        leave_pictures(browser, checks, page, artefacts, name)
    checks.finish()


main()
