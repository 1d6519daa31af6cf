"""One run of `blum medial` on one model, with limits, and what is to be said about it."""

import hashlib
import json
import math
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time

from mesh import diagonal

# What a run can end as. The first three are honest answers; the others are defects.
CERTIFIED, UNDECIDED, INVALID, WRONG, CRASH, KILLED = (
    "certified", "undecided", "invalid", "wrong", "crash", "killed")
OUTCOMES = [CERTIFIED, UNDECIDED, INVALID, WRONG, CRASH, KILLED]
DEFECTS = [WRONG, CRASH, KILLED]

# What `blum verify` says of the certificate of a run that is certified.
VERIFIED, INCOMPLETE, REFUSED = "verified", "incomplete", "refused"

def is_defect(row):
    """Of a recorded run or one just made: a wrong answer, a crash, a run that did not end, or a
    certificate that is not true."""
    return row["outcome"] in DEFECTS or row["certificate"] == REFUSED


CHECK_RADIUS = pathlib.Path(__file__).resolve().parent.parent / "integration" / "check_radius.py"


class Limits:
    """Of one run. The tool is asked to keep `seconds` and `mebibytes`, and made to keep somewhat
    more: a run that does not end by itself is a defect. 0 MiB: no limit of memory (a sanitizer
    reserves terabytes of addresses)."""

    def __init__(self, seconds=60.0, mebibytes=4096, cells=0, grace=30.0):
        self.seconds, self.mebibytes, self.cells, self.grace = seconds, mebibytes, cells, grace

    def arguments(self):
        result = ["--time-limit", repr(self.seconds), "--max-memory", str(self.mebibytes)]
        return result + (["--max-cells", str(self.cells)] if self.cells else [])

    def text(self):
        return f"{self.seconds:g} s, {self.mebibytes or 'unlimited'} MiB" + (
            f", {self.cells} cells" if self.cells else "")

    def wall(self):
        """Reading, validating and writing are outside the tool's own limit."""
        return 1.25 * self.seconds + self.grace

    def apply(self, process):
        if self.mebibytes:
            space = (2 * self.mebibytes + 1024) << 20
            resource.prlimit(process.pid, resource.RLIMIT_AS, (space, space))
        resource.prlimit(process.pid, resource.RLIMIT_CORE, (0, 0))


class Runner:
    def __init__(self, tool, limits):
        self.tool = pathlib.Path(tool).resolve()
        self.limits = limits
        self.running, self.stopped, self.lock = set(), False, threading.Lock()

    @staticmethod
    def hash_of(mesh):
        return hashlib.sha256(mesh.off().encode()).hexdigest()

    def stop(self):
        """Ends the runs in progress; they give None."""
        with self.lock:
            self.stopped = True
            for process in self.running:
                os.killpg(process.pid, signal.SIGKILL)

    def run(self, mesh, expected, blum_seed=1, check_axis=False, verify=False):
        """A dictionary of what store.py keeps, or None if stopped."""
        row = {"betti_expected": expected, "vertices": len(mesh.points), "faces": len(mesh.faces),
               "model_hash": self.hash_of(mesh), "certificate": None}
        with tempfile.TemporaryDirectory(prefix="blum-campaign-") as name:
            folder = pathlib.Path(name)
            (folder / "model.off").write_text(mesh.off())
            ended = self._call(folder, [
                self.tool, "medial", "model.off", "-o", "x", "--summary", "x.json", "--threads",
                "1", "--seed", str(blum_seed), *self.limits.arguments()])
            if ended is None:
                return None
            row.update(ended)
            del row["stdout"]
            summary = read_summary(folder / "x.json", row)
            row["outcome"], row["reason"] = judge(row, summary)
            if row["outcome"] == CERTIFIED and check_axis:
                row["axis_checked"], complaint = check_radii(folder, mesh)
                if complaint:
                    row["outcome"], row["reason"] = WRONG, "axis: " + complaint
            if row["outcome"] == CERTIFIED and verify:
                checked = self._verify(folder, blum_seed, expected)
                if checked is None:
                    return None
                row.update(checked)
        return row

    def _verify(self, folder, blum_seed, expected):
        """Of a run of its own, judged like the first: one that writes a certificate decides without
        cutting planes (`blum verify` follows none), so it may need more cells, or end undecided where
        the first did not."""
        made = self._call(folder, [
            self.tool, "medial", "model.off", "-o", "y", "--summary", "y.json", "--certificate",
            "y.cert", "--threads", "1", "--seed", str(blum_seed), *self.limits.arguments()])
        if made is None:
            return None
        made["betti_expected"] = expected
        outcome, reason = judge(made, read_summary(folder / "y.json", made))
        row = {"certificate_s": made["time_s"], "certificate_cpu_s": made["cpu_s"],
               "certificate_memory": made["memory"]}
        if outcome == UNDECIDED:
            return {**row, "certificate": INCOMPLETE,
                    "statement": f"undecided without cutting planes: {reason}"}
        if outcome != CERTIFIED:  # of a model that the first run took for a solid
            return {**row, "outcome": outcome if outcome in DEFECTS else CRASH,
                    "reason": f"--certificate: {reason}"}
        row["certificate_bytes"] = (folder / "y.cert").stat().st_size
        checked = self._call(folder, [self.tool, "verify", "model.off", "y.cert"])
        if checked is None:
            return None
        row.update(verify_s=checked["time_s"], verify_cpu_s=checked["cpu_s"],
                   verify_memory=memory_of(checked))
        if checked["late"]:  # it has no limit of its own to keep
            return {**row, "certificate": INCOMPLETE, "statement": "not verified in time"}
        if checked["exit_code"] == 0:
            return {**row, "certificate": VERIFIED}
        if checked["exit_code"] != 4:
            return {**row, "outcome": CRASH, "reason": f"verify: {how(checked)}"}
        said = re.search(r"^FALSE +(.*)$", checked["stdout"], re.MULTILINE)
        statement = re.sub(r"\d[-+.e0-9]*", "#", said.group(1) if said else "no statement")
        incomplete = "the result is not certified" in statement or statement.startswith("not shown")
        return {**row, "certificate": INCOMPLETE if incomplete else REFUSED,
                "statement": statement}

    def _call(self, folder, command):
        late = threading.Event()

        def kill():
            late.set()
            with self.lock:
                if process in self.running:
                    os.killpg(process.pid, signal.SIGKILL)

        with open(folder / "stderr", "wb") as errors, open(folder / "stdout", "wb") as output:
            start = time.monotonic()
            with self.lock:
                if self.stopped:
                    return None
                process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL,
                                           stdout=output, stderr=errors,
                                           start_new_session=True)
                self.limits.apply(process)
                self.running.add(process)
        timer = threading.Timer(self.limits.wall(), kill)
        timer.start()
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
        elapsed = time.monotonic() - start
        timer.cancel()
        with self.lock:  # the process id is free for others after this
            self.running.discard(process)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            if self.stopped:
                return None
        by_signal = os.WIFSIGNALED(status)
        return {"exit_code": None if by_signal else os.WEXITSTATUS(status),
                "signal": os.WTERMSIG(status) if by_signal else None, "late": late.is_set(),
                "stderr": (folder / "stderr").read_text(errors="replace")[-2000:],
                "stdout": (folder / "stdout").read_text(errors="replace")[-2000:],
                "time_s": elapsed, "cpu_s": usage.ru_utime + usage.ru_stime,
                # At most: it counts what this process held when it became the tool, too.
                "memory": usage.ru_maxrss << 10}


def memory_of(checked):
    """As `blum verify` says itself, in bytes."""
    said = re.search(r"^needed .* ([.0-9]+) MB at most$", checked["stdout"], re.MULTILINE)
    return round(float(said.group(1)) * 1e6) if said else checked["memory"]


def how(ended):
    """A run ended that should have ended otherwise."""
    if ended["signal"] is not None:
        return signal.Signals(ended["signal"]).name
    return f"exit code {ended['exit_code']}"


def not_ended(ended):
    return f"not ended after {ended['time_s']:.0f} s"


def read_summary(path, row):
    """The summary that a run wrote, if any; what it says goes into the row."""
    if not path.is_file():
        return None
    summary = json.loads(path.read_text())
    row.update(from_summary(summary))
    return summary


def from_summary(summary):
    result, stages = summary["result"], summary["stages"]
    return {"certified": result["certified"], "betti": result["betti"],
            "betti_solid": summary["solid"]["betti"], "sites": sum(summary["sites"].values()),
            "memory": summary["peak_memory_bytes"], "leaves": result["leaves"],
            "max_depth": result["max_depth"], "undecided_cells": result["undecided_cells"],
            "undecided_depth": max((c["depth"] for c in summary.get("undecided", [])), default=None),
            "stage_filter": stages["filter"], "stage_extended": stages["extended"],
            "stage_exact": stages["exact"]}


def judge(row, summary):
    """(outcome, reason) of a row and the summary that was written, if any."""
    code = row["exit_code"]
    if row["late"]:
        return KILLED, not_ended(row)
    if row["signal"] is not None:
        return CRASH, how(row)
    lines = row["stderr"].strip().splitlines()
    if code == 2:
        kinds = re.findall(r"^  error: \d+ (\w+)", row["stderr"], re.MULTILINE)
        if summary is not None:
            return CRASH, "refused, with a summary"
        if kinds:
            return INVALID, ", ".join(kinds)
        if "coordinate_out_of_range" in row["stderr"]:
            return INVALID, "coordinate_out_of_range"
        # Of files that this tool writes nothing can be unreadable.
        return CRASH, "exit code 2: " + (lines[-1] if lines else "no message")
    if code not in (0, 3):
        return CRASH, f"exit code {code}: " + (lines[0] if lines else "no message")
    if summary is None:
        return CRASH, "no summary"
    if summary["result"]["certified"] is not (code == 0):
        return WRONG, f"exit code {code}, but certified: {summary['result']['certified']}"
    if row["betti_solid"] != row["betti_expected"]:
        return WRONG, "Betti numbers of the solid"
    if code == 3:
        counts = summary.get("undecided_by_reason", {})
        return UNDECIDED, " ".join(sorted(counts)) or "no reason given"
    if row["betti"] != row["betti_expected"]:
        return WRONG, "Betti numbers of the axis"
    return CERTIFIED, ""


def check_radii(folder, mesh):
    """(whether it was done, complaint): distances by brute force, of a sample of the vertices."""
    # Beside a large offset the written coordinates are themselves rounded to more than that.
    rounding = math.ulp(max(abs(x) for p in mesh.points for x in p)) / diagonal(mesh.points)
    if rounding > 1e-10:
        return False, ""
    try:
        ended = subprocess.run(
            [sys.executable, "-B", CHECK_RADIUS, "--sample", "100", "--min-feet", "0", "x.vtp",
             "model.off"], cwd=folder, capture_output=True, encoding="utf-8", timeout=120)
    except subprocess.TimeoutExpired:
        return False, ""
    if ended.returncode == 0:
        return True, ""
    lines = ended.stderr.strip().splitlines() or [f"check_radius.py ends with {ended.returncode}"]
    # What is wrong, without where: "vertex 3 (event) at (1, 2, 3): radius 1, distance 2".
    what = lines[0].rpartition(")")[2].lstrip(": ")
    return True, re.sub(r"\d[-+.e0-9]*", "#", what)
