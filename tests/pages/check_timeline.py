#!/usr/bin/env python3
"""timeline.json held against report.json of the same run: check_timeline.py DIRECTORY [FIRST_LINE LAST_LINE]

Without lines the whole run is expected, and its sums are those of the report."""

import collections
import json
import os
import re
import sys

from checks import Checks

GROUPS = {1: "picture", 2: "units", 3: "links"}


def picoseconds(text):
    whole, fraction = text.split(".")
    assert len(fraction) == 6, text
    return int(whole + fraction)


def read(directory):
    """Tracks by group and name, each with its events [name, begin, end, arguments] in the file's order."""
    with open(os.path.join(directory, "timeline.json"), encoding="utf-8") as file:
        events = json.load(file, parse_float=lambda text: text)["traceEvents"]
    names = {(event["pid"], event["tid"]): event["args"]["name"] for event in events if event["name"] == "thread_name"}
    tracks = {(GROUPS[process], name): [] for (process, _), name in names.items()}
    for event in events:
        if event["ph"] == "X":
            begin = picoseconds(event["ts"])
            tracks[GROUPS[event["pid"]], names[event["pid"], event["tid"]]].append(
                [event["name"], begin, begin + picoseconds(event["dur"]), event.get("args", {})])
    return tracks


def check_nesting(checks, tracks):
    for track, events in tracks.items():
        open_ends = []
        before = (-1, 0)
        for name, begin, end, _ in events:
            checks.true(begin < end, f"{track}: {name} takes no time")
            checks.true((begin, -end) > before, f"{track}: {name} at {begin} is out of order")
            before = (begin, -end)
            while open_ends and open_ends[-1] <= begin:
                open_ends.pop()
            checks.true(not open_ends or end <= open_ends[-1], f"{track}: {name} at {begin} lies across another")
            open_ends.append(end)


def leaves(events):
    """What holds no other event."""
    return [event for event, after in zip(events, events[1:] + [["", 1 << 62, 1 << 62, {}]]) if not (after[1] < event[2])]


def run_end(tracks, report):
    """Where the report's cycles end: of a machine whose frames go to a store, when the last of them is shown."""
    return tracks["picture", "frame"][-1][1 if report["platform"] == "quadratic" else 2]


def check_units(checks, tracks, report):
    end_of_run = run_end(tracks, report)
    for unit in report["units"]:
        events = leaves(tracks.get(("units", unit["name"]), []))
        checks.true(("units", unit["name"]) in tracks, f"no track of {unit['name']}")
        sums = collections.Counter()
        pieces = collections.Counter()
        for name, begin, end, _ in events:
            kind = name if name in ("busy", "starved", "blocked", "idle") else "busy"
            sums[kind] += max(0, min(end, end_of_run) - begin)
            pieces[kind] += 1
        for kind in ("busy", "starved", "blocked"):
            cycles = sums[kind] * unit["clock_hz"] * 1e-12
            if unit["name"] == "frame store":  # the screen's reads after the last access are not told
                lines = sum(1 for event in tracks["units", "scan-out"] if events[-1][2] - 1e8 < event[1] < end_of_run + 1e8)
                burst = max((event[2] - event[1] for event in events if event[0] == "screen"), default=0) * unit["clock_hz"] * 1e-12
                checks.true(kind != "busy" or -1 <= unit[kind] - cycles <= lines * burst + 1, f"frame store: {cycles} cycles, the report has {unit[kind]}")
                continue
            # Every end may lie within a cycle.
            checks.true(abs(cycles - unit[kind]) <= 1e-6 * cycles + pieces[kind], f"{unit['name']}: {cycles} cycles {kind}, the report has {unit[kind]}")


def check_links(checks, tracks, report):
    for link in report["links"]:
        events = tracks.get(("links", link["name"]), [])
        checks.true(("links", link["name"]) in tracks, f"no track of {link['name']}")
        told = sum(int(event[3].get("bytes", 0)) for event in events)
        by_time = sum(event[2] - event[1] for event in events) * 1e-12 * link["peak_bytes_per_s"]
        if any("bytes" in event[3] for event in events):
            checks.true(abs(told - link["bytes"]) <= len(events), f"{link['name']}: {told} bytes, the report has {link['bytes']}")
        elif events:
            checks.true(abs(by_time - link["bytes"]) <= 1e-6 * by_time + 1, f"{link['name']}: time for {by_time} bytes, the report has {link['bytes']}")


def check_quadrics(checks, tracks, report):
    """Fragments of triangles and of quadrics leave their boards together. Those of quadrics have been in a pipeline before
    that is longer by so many clocks, and a line's steps, start and pixels follow each other in its time."""
    later = [entry["count"] for entry in report["logic"] if entry["name"] == "quadric processor: later than a triangle"]
    if not later:
        return
    triangles = [event[1:3] for event in tracks["links", "board 0 to decision unit"]]
    boards = [name for group, name in tracks if group == "units" and name.startswith("quadric board")]
    checks.true(len(boards) > 0, "quadric boards have tracks")
    clock_ps = (triangles[0][1] - triangles[0][0]) / report["video"]["columns"]
    for board in boards:
        fragments = [event[1:3] for event in tracks["links", f"{board} to decision unit"]]
        checks.equal(fragments, triangles, f"{board}: fragments beside those of triangles")
        pixels = [event for event in tracks["units", board] if event[0] == "pixels"]
        for event, (begin, _) in zip(pixels, fragments):
            clocks = round((begin - event[1]) / clock_ps)  # a register stage of pre-normalisation is the last
            checks.true(clocks == later[0] + 1, f"{board}: fragments {clocks} clocks behind their pixels")
        starts = [event for event in tracks["units", board] if event[0] == "line start"]
        steps = [event for event in tracks["units", board] if event[0] == "line step"]
        lines = [event for event in tracks["units", board] if event[0].startswith("line ") and event[0] not in ("line start", "line step")]
        checks.equal([len(starts), len(lines)], [len(pixels), len(pixels)], f"{board}: a start and pixels a line")
        for start, line, event in zip(starts, lines, pixels):
            checks.true(line[1] <= start[1] and start[2] <= event[1] and event[2] == line[2], f"{board}: {line[0]}")
        begun = {start[1] for start in starts}
        checks.true(all(step[2] in begun for step in steps), f"{board}: a line start follows each step")


def check_frames(checks, tracks, report):
    fields = 2 if report["video"]["interlaced"] else 1
    frames = tracks["picture", "frame"]
    names = [f"frame {k}, field {f}" if fields == 2 else f"frame {k}" for k in range(report["frames"]) for f in range(fields)]
    checks.equal([event[0] for event in frames], names, "frames")
    checks.equal([event[3]["animation frame"] for event in frames[::fields]], [image["animation_frame"] for image in report["images"]], "poses")
    output = tracks["units", "video output"]
    for image, first, last in zip(report["images"], frames[::fields], frames[fields - 1::fields]):
        lines = [event for event in output if first[1] <= event[1] < last[2]]
        checks.equal(len(lines), report["video"]["lines"], "lines of a frame")
        checks.equal(lines[0][1], image["first_pixel_ps"], "the first pixel")
        clock_ps = (lines[0][2] - lines[0][1]) / report["video"]["columns"]
        checks.true(abs(lines[-1][2] - clock_ps - image["last_pixel_ps"]) <= 1, "the last pixel")


def check_limits(checks, tracks, report):
    """The slowest update that was shown is the report's; the report says of which unit the next one is."""
    limits = tracks["picture", "what limits"]
    checks.equal(len(limits), len(tracks["picture", "frame"]), "what limits each frame")
    hosts = {unit["name"]: unit["clock_hz"] for unit in report["units"]}
    if report["deadlines"]["host"]["shown"] and report["answer"]["sustained"]:
        of_hosts = [(end - begin) * 1e-12 * hosts[name] for name, begin, end, _ in limits[:-1] if name.startswith("computation unit")]
        cycles = max(of_hosts, default=report["deadlines"]["host"]["used_cycles"])
        checks.true(abs(cycles - report["deadlines"]["host"]["used_cycles"]) <= 1, f"the slowest update: {cycles} cycles")


def check_store_frames(checks, tracks, report):
    """Frames that go to a store: computed one after the other, each shown after that; its first pixel in the report."""
    computed, shown = tracks["picture", "set-up"], tracks["picture", "frame"]
    names = [f"frame {k}" for k in range(report["frames"])]
    checks.equal([event[0] for event in computed], names, "frames computed")
    checks.equal([event[0] for event in shown], names, "frames shown")
    sent = tracks["units", "scan-out"]  # the link counts to where the last frame is shown
    for image, of_set_up, frame in zip(report["images"], computed, shown):
        checks.true(of_set_up[2] <= frame[1], "a frame is shown when it has been computed")
        checks.true(any(event[1] == image["first_pixel_ps"] and event[0] == "line 0" for event in sent), "the first pixel")
        checks.close([image["set_up_us"], image["shown_us"]], [(end - of_set_up[1]) * 1e-6 for end in (of_set_up[2], frame[1])], "times of a frame")
    worst = max(tracks["picture", "what limits"], key=lambda event: float(event[3]["of the frame"]))
    bottleneck = report["answer"]["bottleneck"]
    checks.equal(worst[0], bottleneck["unit"], "what limits")
    checks.close([float(worst[3]["of the frame"])], [bottleneck["utilisation"]], "by how much")


def check_lines(checks, tracks, first, last):
    wanted = {f"line {line}" for line in range(first, last + 1)}
    checks.equal({event[0] for event in tracks["picture", "line"]}, wanted, "lines")
    for track, events in tracks.items():
        named = {event[0] for event in events if re.match("line [0-9]", event[0])}
        checks.true(named <= wanted, f"{track} has other lines: {named - wanted}")
    host = tracks.get(("units", "computation unit 0")) or tracks["units", "set-up processor"]
    checks.true(len(host) > 2, "hosts are there for the whole frame")


def main():
    directory = sys.argv[1]
    with open(os.path.join(directory, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    checks = Checks()
    tracks = read(directory)
    check_nesting(checks, tracks)
    if len(sys.argv) > 2:
        check_lines(checks, tracks, int(sys.argv[2]), int(sys.argv[3]))
    else:
        check_units(checks, tracks, report)
        check_links(checks, tracks, report)
        check_quadrics(checks, tracks, report)
        if "deadlines" in report:
            check_frames(checks, tracks, report)
            check_limits(checks, tracks, report)
        else:
            check_store_frames(checks, tracks, report)
    checks.finish()


main()
