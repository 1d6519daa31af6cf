#!/usr/bin/env python3
"""Compares two runs of a benchmark program, or fits the growth within one.

    bench_medial --benchmark_out=before.json --benchmark_out_format=json
    compare.py before.json after.json [--limit 1.25]    times and counters side by side
    compare.py --growth run.json [--size sites] [--of leaves,peak_bytes]
                            exponents p in time ~ size^p, and of the counters

With --limit, exit code 1 if a benchmark takes more than that many times as long as before, or
fails where it did not. Benchmarks that repeat are compared by the median of their repetitions.
"""

import argparse
import json
import math
import re
import statistics
import sys

SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
# What Google Benchmark says about every benchmark; the rest are counters of our own.
STANDARD = {"name", "run_name", "run_type", "repetitions", "repetition_index", "threads",
            "iterations", "real_time", "cpu_time", "time_unit", "family_index", "items_per_second",
            "per_family_instance_index", "error_occurred", "error_message", "label",
            "aggregate_name", "aggregate_unit"}


def load(path):
    """name -> {"time": seconds or None, "counters": {}} with the median of repetitions."""
    with open(path) as file:
        rows = json.load(file)["benchmarks"]
    runs = {}
    for row in rows:
        if row.get("run_type", "iteration") == "iteration":
            name = re.sub(r"/iterations:\d+", "", row["run_name"])
            runs.setdefault(name, []).append(row)
    result = {}
    for name, repeats in runs.items():
        good = [r for r in repeats if not r.get("error_occurred")]
        counters = {}
        for key in good[0] if good else ():
            if key not in STANDARD and isinstance(good[0][key], (int, float)):
                counters[key] = statistics.median(r[key] for r in good)
        times = [r["cpu_time"] * SECONDS[r["time_unit"]] for r in good]
        result[name] = {"time": statistics.median(times) if times else None, "counters": counters}
    return result


def readable(seconds):
    if seconds is None:
        return "failed"
    for unit in ("s", "ms", "us"):
        if seconds >= SECONDS[unit]:
            return "%.3g %s" % (seconds / SECONDS[unit], unit)
    return "%.3g ns" % (seconds / SECONDS["ns"])


def compare(before, after, limit):
    bad = False
    print("%-44s %10s %10s %7s" % ("benchmark", "before", "after", "ratio"))
    for name in list(before) + [n for n in after if n not in before]:
        a, b = before.get(name), after.get(name)
        if a is None or b is None:
            print("%-44s only %s" % (name, "after" if a is None else "before"))
            continue
        ratio = b["time"] / a["time"] if a["time"] and b["time"] else None
        worse = (b["time"] is None and a["time"] is not None) or \
            (limit is not None and ratio is not None and ratio > limit)
        bad |= worse
        print("%-44s %10s %10s %7s%s" % (name, readable(a["time"]), readable(b["time"]),
                                        "%.3f" % ratio if ratio else "-",
                                        "  <-- worse" if worse else ""))
        for key in a["counters"]:
            old, new = a["counters"][key], b["counters"].get(key)
            if new is not None and old != new and abs(new - old) > 0.01 * abs(old):
                print("    %-40s %10.4g %10.4g" % (key, old, new))
    return 1 if bad and limit is not None else 0


def slope(points):
    """Least squares, of log y against log x."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    x, y = (statistics.fmean(column) for column in zip(*logs))
    return sum((a - x) * (b - y) for a, b in logs) / sum((a - x) ** 2 for a, _ in logs)


def growth(runs, size, counters):
    """Exponents between neighbours in size, in each family (the name up to its last '/'), of the
    time and of counters."""
    families = {}
    for name, run in runs.items():
        if run["time"] and run["counters"].get(size):
            measured = [run["time"]] + [run["counters"].get(c) for c in counters]
            families.setdefault(name.rpartition("/")[0], []).append(
                (run["counters"][size], name, measured))
    for family, rows in families.items():
        rows.sort()
        sizes = {row[0] for row in rows}
        if len(sizes) < 2 or len(sizes) < len(rows) or family.count("/") < 1:
            continue
        print("%-24s %10s" % (family, size) +
              "".join("%12s %5s" % (c, "exp.") for c in ["time"] + counters))
        before = None
        for n, name, measured in rows:
            line = "%-24s %10g" % (name.rpartition("/")[2], n)
            for k, y in enumerate(measured):
                line += "%12s" % (readable(y) if k == 0 else "-" if y is None else "%.6g" % y)
                known = before and y and before[1][k]
                line += " %5s" % ("%.2f" % slope([(before[0], before[1][k]), (n, y)])
                                  if known else "")
            print(line)
            before = (n, measured)
        line = "%-35s" % "least squares"
        for k in range(1 + len(counters)):
            points = [(n, m[k]) for n, _, m in rows if m[k]]
            line += "%12s %5s" % ("", "%.2f" % slope(points) if len(points) > 1 else "-")
        print(line)
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("runs", nargs="+", metavar="RUN.json")
    parser.add_argument("--limit", type=float)
    parser.add_argument("--growth", action="store_true")
    parser.add_argument("--size", default="sites", help="counter that is the size (default: sites)")
    parser.add_argument("--of", default="leaves,peak_bytes", metavar="COUNTERS",
                        help="whose growth is shown beside the time's (default: leaves,peak_bytes)")
    arguments = parser.parse_args()
    if len(arguments.runs) != (1 if arguments.growth else 2):
        parser.error("two runs, or one with --growth")
    try:
        runs = [load(path) for path in arguments.runs]
    except (OSError, ValueError, KeyError) as error:
        print("compare.py: %s" % error, file=sys.stderr)
        return 2
    if arguments.growth:
        return growth(runs[0], arguments.size, arguments.of.split(","))
    return compare(runs[0], runs[1], arguments.limit)


if __name__ == "__main__":
    sys.exit(main())
