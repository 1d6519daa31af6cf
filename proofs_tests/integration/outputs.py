"""`blum medial` writes what it says, all or nothing; outputs that cannot be written exit with 5."""

import json
import subprocess
import unittest

from tool import TOOL, ToolTest, main


class Outputs(ToolTest):
    def setUp(self):
        super().setUp()
        self.expect(self.blum("make", "cuboid", "1", "2", "3", "-o", "box.off"), 0)

    def test_a_certified_axis_and_its_files(self):
        result = self.blum("medial", "box.off", "--summary", "summary.json", "--seed", "3",
                           "--threads", "2")
        self.expect(result, 0)
        self.assertIn("certified", result.stdout)
        self.assertEqual(result.stderr, "")  # no progress bar off a terminal
        self.assertEqual(self.names(), ["box.ma", "box.obj", "box.off", "box.vtp", "summary.json"])
        summary = json.loads((self.folder / "summary.json").read_text())
        self.assertEqual(summary["model"], "box.off")
        self.assertEqual(summary["sites"], {"vertices": 8, "edges": 12, "faces": 12})
        self.assertEqual(summary["solid"]["betti"], [1, 0, 0])
        answer = summary["result"]
        self.assertEqual(answer["mode"], "medial")
        self.assertIs(answer["certified"], True)
        self.assertEqual(answer["betti"], [1, 0, 0])
        self.assertEqual(answer["undecided_cells"], 0)
        self.assertGreater(answer["leaves"], 0)
        self.assertGreater(answer["hausdorff_bound"], 0)
        self.assertEqual(set(summary["stages"]), {"filter", "extended", "exact"})
        self.assertEqual(set(summary["time_s"]),
                         {"read", "sites", "subdivide", "assemble", "total"})
        self.assertGreater(summary["peak_memory_bytes"], 0)
        self.assertEqual(summary["seed"], 3)
        self.assertEqual(summary["threads"], 2)
        self.assertIn(summary["version"], self.blum("--version").stdout)

    def test_a_budget_too_small_is_not_certified_but_written(self):
        self.expect(self.blum("make", "torus", "8", "4", "-o", "torus.off"), 0)
        for budget in [["--max-cells", "1"], ["--max-cells", "3"], ["--max-depth", "0"],
                       ["--max-depth", "1"], ["--time-limit", "1e-9"]]:
            with self.subTest(budget):
                result = self.blum("medial", "torus.off", "-o", "small", "--summary", "small.json",
                                   *budget)
                self.expect(result, 3)
                summary = json.loads((self.folder / "small.json").read_text())
                self.assertIs(summary["result"]["certified"], False)
                self.assertIsNone(summary["result"]["betti"])
                self.assertGreater(summary["result"]["undecided_cells"], 0)
                reasons = {cell["reason"] for cell in summary["undecided"]}
                self.assertTrue(reasons)
                for suffix in ["ma", "vtp", "obj", "undecided.vtp"]:
                    self.assertTrue((self.folder / f"small.{suffix}").is_file())

    def test_equal_seeds_give_equal_files(self):
        for prefix, threads in [("a", "1"), ("b", "1"), ("c", "3")]:
            self.expect(self.blum("medial", "box.off", "-o", prefix, "--threads", threads), 0)
        for suffix in ["ma", "obj", "vtp"]:
            a, b, c = ((self.folder / f"{prefix}.{suffix}").read_bytes() for prefix in "abc")
            self.assertEqual(a, b)
            self.assertEqual(a, c)

    def test_outputs_that_cannot_be_written(self):
        (self.folder / "taken.ma").mkdir()
        before = self.names()
        for arguments in [
            ["medial", "box.off", "-o", "missing/box"],
            ["medial", "box.off", "-o", "taken"],
            ["medial", "box.off", "-o", "box.off/box"],
            ["medial", "box.off", "-o", "/proc/box"],
            ["medial", "box.off", "-o", "fine", "--summary", "missing/summary.json"],
            ["make", "cuboid", "-o", "missing/box.off"],
            ["make", "cuboid", "-o", "taken.ma"],
            ["make", "cuboid", "-o", "/proc/box.off"],
        ]:
            with self.subTest(arguments):
                result = self.blum(*arguments)
                self.expect(result, 5)
                self.assertRegex(result.stderr, r"\Ablum: error: output_not_written: ")
                self.assertEqual(self.names(), before)

    def test_a_full_standard_output(self):
        try:
            full = open("/dev/full", "w")
        except OSError:
            raise unittest.SkipTest("no /dev/full")
        with full:
            result = subprocess.run([TOOL, "info", "box.off"], cwd=self.folder, stdout=full,
                                    stderr=subprocess.PIPE, timeout=60)
        self.assertEqual(result.returncode, 5)


if __name__ == "__main__":
    main()
