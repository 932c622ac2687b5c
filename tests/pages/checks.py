"""What a check of a page does with what it finds, and what holds for every page."""

import os
import sys


class Checks:
    def __init__(self):
        self.failures = []
        self.number = 0

    def true(self, condition, what):
        self.number += 1
        if not condition:
            self.failures.append(what)

    def equal(self, got, expected, what):
        self.true(got == expected, f"{what}: {got!r:.400} is not {expected!r:.400}")

    def close(self, got, expected, what):
        same = len(got) == len(expected) and all(abs(a - b) <= 1e-6 * max(1.0, abs(b)) for a, b in zip(got, expected))
        self.true(same, f"{what}: {got!r:.400} is not {expected!r:.400}")

    def finish(self):
        for failure in self.failures:
            print("failed:", failure)
        print(f"{self.number} checks, {len(self.failures)} failed")
        sys.exit(1 if self.failures else 0)


def table_of(browser, title):
    """The first table of the section of that title, as texts row by row."""
    return browser.evaluate(f"""[...[...document.querySelectorAll('section')].find((found) => found.querySelector('h2').textContent === {title!r})
        .querySelector('table').rows].map((row) => [...row.cells].map((cell) => cell.textContent))""")


def chart_data(browser, name):
    return browser.evaluate(f"Chart.getChart('{name}').data.datasets.map((set) => set.data)")


def place_of(browser, selector):
    """Left, top, width and height in the window, after scrolling there."""
    return browser.evaluate(f"""(() => {{ const found = document.querySelector('{selector}'); found.scrollIntoView({{block: 'center'}});
        const box = found.getBoundingClientRect(); return [box.left, box.top, box.width, box.height]; }})()""")


def leave_pictures(browser, checks, page, folder, name):
    """Looks at the page on a desk, a phone and on paper, leaves its pictures, and checks that it stayed quiet and by itself."""
    os.makedirs(folder, exist_ok=True)
    browser.picture(os.path.join(folder, name + "_wide.png"))
    browser.paper(os.path.join(folder, name + ".pdf"))
    browser.size(703, 1000)  # A4 less its margins
    browser.call("Emulation.setEmulatedMedia", media="print")
    browser.evaluate("window.dispatchEvent(new Event('beforeprint'))")  # as printing does: charts take the paper's width
    tallest = browser.evaluate("Math.max(...[...document.querySelectorAll('tr')].map((row) => row.offsetHeight))")
    checks.true(tallest <= 120, f"a row of a table is {tallest} pixels tall on paper")
    checks.true(browser.evaluate("document.documentElement.scrollWidth") <= 703, "the page is wider than paper")
    browser.call("Emulation.setEmulatedMedia", media="")
    checks.equal(browser.complaints(), [], "the console")
    checks.equal([url for url in browser.requests() if not url.endswith(os.path.basename(page))], [], "requests")
    browser.size(375, 812, phone=True)
    browser.open(page)
    checks.true(browser.evaluate("document.documentElement.scrollWidth") <= 375, "the page is wider than a phone of 375 pixels")
    browser.picture(os.path.join(folder, name + "_phone.png"))
    checks.equal(browser.complaints(), [], "the console on a phone")
