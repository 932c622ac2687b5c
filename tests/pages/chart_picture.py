#!/usr/bin/env python3
"""The chart of a sweep's page as PNG: chart_picture.py PAGE PICTURE [AXIS=VALUE...]

Of each axis that is named, that value alone passes the page's filter."""

import base64
import sys

from browser import Browser


def keep(browser, axis, value):
    left = browser.evaluate(f"""(() => {{
        const k = page.axes.findIndex((axis) => axis.path === {axis!r} || axis.name === {axis!r});
        const kept = k < 0 ? -1 : page.axes[k].values.indexOf({value!r});
        if (kept < 0) return 0;
        document.querySelectorAll(`input[data-axis="${{k}}"]`).forEach((box) => {{
          if (box.checked !== (Number(box.dataset.value) === kept)) box.click();
        }});
        return view.allowed[k].filter(Boolean).length;
    }})()""")
    if left != 1:
        raise SystemExit(f"chart_picture.py: the page has no box for {axis} = {value}")


def main():
    page, picture = sys.argv[1:3]
    with Browser() as browser:
        browser.size(1180, 900)
        browser.open(page)
        for one in sys.argv[3:]:
            keep(browser, *one.split("=", 1))
        browser.evaluate("view.chosen = null, refresh()")
        left, top, width, height = browser.evaluate("""(() => { const box = document.getElementById('scatter').parentElement.getBoundingClientRect();
            return [box.left + scrollX, box.top + scrollY, box.width, box.height]; })()""")
        shot = browser.call("Page.captureScreenshot", format="png", captureBeyondViewport=True,
                            clip={"x": left, "y": top, "width": width, "height": height, "scale": 1})
        with open(picture, "wb") as file:
            file.write(base64.b64decode(shot["data"]))
        if browser.complaints():
            raise SystemExit(f"chart_picture.py: {browser.complaints()}")


main()
