#!/usr/bin/env python3
"""Writes docs/theta.md: the thesis' table 5.2 beside what `blum medial --theta-table` says.

Usage: docs/make_theta.py TOOL MODELS_FOLDER [SECONDS]
Runs the tool on each model below (time limit in seconds, default 120; knot.off takes 1,100) and
rewrites the page. Models that do not exist or are not certified within the limit are named as such.
Standard library alone.
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

# Table 5.2 of the thesis: model, polygons, theta, sheets of the axis, θ-HMA, θ-SMA, seconds.
THESIS = [
    ("Plate", 990, 150, 1896, 21, 22, 1.29),
    ("Rotor", 4736, 150, 1365, 41, 17, 1.23),
    ("Mount", 2442, 45, 7455, 536, 283, 2.43),
    ("Knot", 2562, 150, 13940, 451, 386, 5.01),
    ("Ridge-Rod", 5012, 120, 30676, 74, 36, 18.10),
    ("Anvil", 4340, 150, 32102, 4, 4, 17.51),
    ("Drivewheel", 60712, 90, 89885, 16, 759, 24.94),
    ("Drivewheel", 60712, 150, 89885, 3, 4, 26.05),
]
# Ours: file in the models folder or arguments of `blum make`, and angles.
OURS = [
    ("plate_holes.off", "Plate", [90, 150, 180]),
    ("joint.off", "Mount", [45, 90, 150, 180]),
    ("cray_left_void.off", "cube with void (figure 5.22)", [90, 150, 180]),
    (["plate", "2", "6"], "Plate", [90, 150, 180]),
    (["torus", "16", "8"], "", [45, 90, 150, 180]),
    (["knot"], "Knot", [90, 150, 180]),
    ("knot.off", "Knot", [90, 150, 180]),
    (["lbracket"], "L-shape (figure 5.13)", [90, 91, 180]),
]


def run(tool, source, angles, limit, folder):
    if isinstance(source, list):
        model = folder / ("_".join(source) + ".off")
        subprocess.run([tool, "make", *source, "-o", model], check=True, capture_output=True)
    else:
        model = source
    command = [tool, "medial", model, "-o", folder / "x", "--summary", folder / "x.json",
               "--theta-table", ",".join(map(str, [0, *angles])), "--theta-csv", folder / "x.csv",
               "--time-limit", str(limit)]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode != 0:
        return None
    with open(folder / "x.csv", newline="") as rows:
        table = {(float(row["theta_deg"]), row["method"]): row for row in csv.DictReader(rows)}
    return json.loads((folder / "x.json").read_text()), table


def betti(row):
    return " ".join(row[key] for key in ("b0", "b1", "b2"))


def main():
    tool, models = sys.argv[1], pathlib.Path(sys.argv[2])
    limit = float(sys.argv[3]) if len(sys.argv) > 3 else 120
    out = ["# Simplified axes by angle", "",
           "Written by `docs/make_theta.py`; do not edit. Sheets are maximal connected 2-manifold "
           "pieces.", "", "## Table 5.2 of the thesis", "",
           "| model | polygons | θ | sheets | θ-HMA | θ-SMA | seconds |",
           "|---|---|---|---|---|---|---|"]
    for row in THESIS:
        out.append("| " + " | ".join(map(str, row)) + " |")
    out += ["", "Its models are not at hand; below are the nearest that are. The seconds are those "
            "of the pruning there; here pruning takes milliseconds (`bench/bench_prune.cpp`: 30,000 "
            "sheets in 0.3 s of CPU time), and the column gives the time to bound the angles.", "",
            "## Ours", "",
            "Degrees: the certified upper bounds decide, so a part whose angle is known only up to "
            "an interval counts as large; \"wide\" says how many parts have an interval of more "
            "than a degree. Curves are what is left of seams without sheets.", "",
            "| model | near | faces | θ | sheets | θ-HMA | θ-SMA | curves | HMA b0 b1 b2 | "
            "SMA b0 b1 b2 | wide | angles s |", "|" + "---|" * 12]
    missing = []
    with tempfile.TemporaryDirectory() as name:
        for source, near, angles in OURS:
            title = " ".join(source) if isinstance(source, list) else source
            path = source if isinstance(source, list) else models / source
            if not isinstance(source, list) and not path.is_file():
                missing.append(title + " (no such file)")
                continue
            answer = run(tool, path, angles, limit, pathlib.Path(name))
            if answer is None:
                missing.append(title + " (not certified within the limit)")
                continue
            summary, table = answer
            for theta in angles:
                hma, sma = table[(theta, "hma")], table[(theta, "sma")]
                out.append(f"| {title} | {near} | {summary['sites']['faces']} | {theta} | "
                           f"{table[(0.0, 'hma')]['sheets']} | {hma['sheets']} | {sma['sheets']} | "
                           f"{hma['curves']} | {betti(hma)} | {betti(sma)} | "
                           f"{summary['angles']['parts_wider']} | "
                           f"{summary['angles']['time_s']:.1f} |")
    if missing:
        out += ["", "Not in the table: " + ", ".join(missing) + "."]
    page = pathlib.Path(__file__).parent / "theta.md"
    page.write_text("\n".join(out) + "\n")


if __name__ == "__main__":
    main()
