"""Runs whose budget is spent end with 3, in time, and write what is undecided."""

import base64
import json
import re
import struct
import time

from tool import SANITIZERS, ToolTest, main

REASON = {"depth": 0, "cells": 1, "time": 2, "face_undecided": 3, "memory": 4}


def array(text, name, kind):
    encoded = re.search(rf'<DataArray [^>]*Name="{name}"[^>]*>\n(\S*)\n', text).group(1)
    data = base64.b64decode(encoded)[8:]
    return struct.unpack(f"<{len(data) // struct.calcsize(kind)}{kind}", data)


class Limits(ToolTest):
    def setUp(self):
        super().setUp()
        self.expect(self.blum("make", "torus", "64", "32", "-o", "torus.off"), 0)

    def expect_undecided(self, reason, *budget):
        """Gives the summary, after comparing it with the text and the boxes."""
        result = self.blum("medial", "torus.off", "-o", "x", "--summary", "x.json", *budget)
        self.expect(result, 3)
        self.assertEqual(self.names(), ["torus.off", "x.json", "x.ma", "x.obj", "x.undecided.vtp",
                                        "x.vtp"])
        self.assertIn("wrote x.undecided.vtp\n", result.stdout)
        summary = json.loads((self.folder / "x.json").read_text())
        count = summary["result"]["undecided_cells"]
        self.assertGreater(count, 0)
        self.assertEqual(summary["undecided_by_reason"], {reason: count})
        self.assertIn(f"undecided ({count} {reason})", result.stdout)
        text = (self.folder / "x.undecided.vtp").read_text()
        self.assertEqual(array(text, "reason", "B"), (REASON[reason],) * (6 * count))
        depth, points = array(text, "depth", "i"), array(text, "Points", "d")
        self.assertEqual(len(points), 24 * count)
        for i, cell in enumerate(summary["undecided"]):
            self.assertEqual(cell["reason"], reason)
            self.assertEqual(cell["depth"], depth[6 * i])
            self.assertEqual(cell["lo"] + cell["hi"],
                             [*points[24 * i:24 * i + 3], *points[24 * i + 21:24 * i + 24]])
        return summary

    def test_time(self):
        for threads in ["1", "3"]:
            for limit in [0.001, 2]:
                with self.subTest(threads=threads, limit=limit):
                    start = time.monotonic()
                    self.expect_undecided("time", "--time-limit", str(limit), "--threads", threads)
                    # A second for the limit, another for all else on a machine that is busy.
                    self.assertLess(time.monotonic() - start, limit + 2)

    def test_memory(self):
        summary = self.expect_undecided("memory", "--max-memory", "40", "--threads", "2")
        beyond = 256 if SANITIZERS else 64  # sanitizers keep what is freed, and shadows of it
        self.assertLess(summary["peak_memory_bytes"], (40 + beyond) << 20)

    def test_cells(self):
        for threads in ["1", "3"]:
            summary = self.expect_undecided("cells", "--max-cells", "100", "--threads", threads)
            self.assertLessEqual(summary["result"]["leaves"], 50)
            self.assertEqual(summary["threads"], int(threads))

    def test_boxes_of_an_earlier_run_do_not_stay(self):
        self.expect(self.blum("make", "cuboid", "-o", "box.off"), 0)
        self.expect(self.blum("medial", "box.off", "--max-depth", "0"), 3)
        self.assertIn("box.undecided.vtp", self.names())
        result = self.blum("medial", "box.off")
        self.expect(result, 0)
        self.assertNotIn("box.undecided.vtp", self.names())
        self.assertNotIn("undecided", result.stdout)


if __name__ == "__main__":
    main()
