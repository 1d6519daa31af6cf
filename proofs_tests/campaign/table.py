"""What the runs say, by family."""

import collections
import pathlib
import statistics

from runner import CERTIFIED, CRASH, INVALID, KILLED, UNDECIDED, VERIFIED, WRONG

HEAD = ["family", "runs", "invalid", "certified", "undecided", "wrong", "crash", "killed",
        "not certified", "verified", "write s", "verify s", "sites", "time s", "most s", "most MiB"]


def median(rows, column):
    """Of the runs that have it. `write s`, `verify s`: processor time of a run with a certificate, and of
    verifying that."""
    values = [row[column] for row in rows if row[column] is not None]
    return f"{statistics.median(values):.2f}" if values else "-"


def line(name, rows):
    count = collections.Counter(row["outcome"] for row in rows)
    valid = [row for row in rows if row["outcome"] != INVALID]
    share = 1 - count[CERTIFIED] / len(valid) if valid else 0
    times = [row["time_s"] for row in valid] or [0]
    asked = collections.Counter(row["certificate"] for row in rows if row["certificate"])
    return [name, len(rows), count[INVALID], count[CERTIFIED], count[UNDECIDED], count[WRONG],
            count[CRASH], count[KILLED], f"{100 * share:.1f} %",
            f"{asked[VERIFIED]} of {asked.total()}", median(rows, "certificate_cpu_s"),
            median(rows, "verify_cpu_s"),
            max((row["sites"] or 0 for row in valid), default=0),
            f"{statistics.median(times):.2f}", f"{max(times):.1f}",
            f"{max((row['memory'] or 0 for row in valid), default=0) / 2**20:.0f}"]


def text(rows):
    families = {}
    for row in rows:
        families.setdefault(row["family"], []).append(row)
    lines = [HEAD] + [line(pathlib.Path(name).name, members) for name, members in sorted(families.items())]
    lines.append(line("all", rows))
    widths = [max(len(str(cells[i])) for cells in lines) for i in range(len(HEAD))]
    out = ["  ".join(str(c).ljust(w) if i == 0 else str(c).rjust(w)
                     for i, (c, w) in enumerate(zip(cells, widths))) for cells in lines]
    out.insert(1, "-" * len(out[0]))
    out.insert(-1, out[1])
    causes = collections.Counter((row["outcome"], row["reason"]) for row in rows
                                 if row["outcome"] != CERTIFIED)
    if causes:
        out += ["", "outcome and reason (runs, first ids):"]
    for (outcome, reason), n in sorted(causes.items()):
        ids = [str(r["id"]) for r in rows if (r["outcome"], r["reason"]) == (outcome, reason)]
        out.append(f"  {n:5}  {outcome}: {reason}  (" + ", ".join(ids[:6]) +
                   (", ..." if n > 6 else "") + ")")
    statements = collections.Counter((row["certificate"], row["statement"]) for row in rows
                                     if row["certificate"] not in (None, VERIFIED))
    if statements:
        out += ["", "certificates not verified (runs, first ids):"]
    for (outcome, statement), n in sorted(statements.items()):
        ids = [str(r["id"]) for r in rows if (r["certificate"], r["statement"]) == (outcome, statement)]
        out.append(f"  {n:5}  {outcome}: {statement}  (" + ", ".join(ids[:6]) +
                   (", ..." if n > 6 else "") + ")")
    return "\n".join(out)


def certificates(rows):
    """Every verified run (of which that is known) for a page: processor seconds, most memory."""
    lines = ["| model | faces | `medial --certificate` | `verify` | certificate |", "|---|---|---|---|---|"]
    known = [r for r in rows if r["certificate"] == VERIFIED and r["verify_cpu_s"] is not None]
    for r in sorted(known, key=lambda r: r["faces"]):
        name = pathlib.Path(r["family"]).stem + (f" {r['seed']}" if r["seed"] > 1 else "")
        lines.append(f"| {name} | {r['faces']} | {r['certificate_cpu_s']:.2f} s, "
                     f"{r['certificate_memory'] / 2**20:.0f} MiB | {r['verify_cpu_s']:.2f} s, "
                     f"{r['verify_memory'] / 2**20:.0f} MiB | {r['certificate_bytes'] / 1e6:.2f} MB |")
    return "\n".join(lines)
