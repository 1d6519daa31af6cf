"""`blum medial --theta`: simplified axes in the files, the table, and what is refused."""

import csv
import json

from tool import ToolTest, main


class Theta(ToolTest):
    def setUp(self):
        super().setUp()
        self.expect(self.blum("make", "cuboid", "1", "1", "2", "-o", "bar.off"), 0)

    def summary(self, *arguments):
        self.expect(self.blum("medial", "bar.off", "-o", "x", "--summary", "x.json", *arguments), 0)
        return json.loads((self.folder / "x.json").read_text())

    def cells(self):
        return list(map(int, (self.folder / "x.ma").read_text().split("\n", 1)[0].split()))

    def test_a_square_bar_becomes_a_curve(self):
        whole = self.summary()
        self.assertNotIn("angles", whole)
        self.assertNotIn("pruned", whole)
        all_cells = self.cells()
        for method in ["hma", "sma"]:
            with self.subTest(method):
                summary = self.summary("--theta", "120", "--simplify", method)
                self.assertEqual(summary["result"]["sheets"], whole["result"]["sheets"])
                self.assertEqual(summary["pruned"]["method"], method)
                self.assertEqual(summary["pruned"]["sheets"], 0)
                self.assertEqual(summary["pruned"]["curves"], 1)
                self.assertEqual(summary["pruned"]["betti"], [1, 0, 0])
                vertices, edges, triangles = self.cells()
                self.assertEqual(triangles, 0)
                self.assertEqual(vertices, edges + 1)
        summary = self.summary("--theta", "0")
        self.assertEqual(self.cells(), all_cells)
        self.assertEqual(summary["angles"]["parts_wider"], 0)
        self.assertLess(summary["angles"]["widest_deg"], 1)

    def test_angles_are_in_the_vtp_file(self):
        self.summary()
        self.assertNotIn(b'"angle_hi"', (self.folder / "x.vtp").read_bytes())
        self.summary("--angles")
        text = (self.folder / "x.vtp").read_bytes()
        for name in [b"angle_lo", b"angle_hi", b"theta"]:
            self.assertEqual(text.count(b'Name="' + name + b'"'), 2)  # points and cells

    def test_the_table(self):
        result = self.blum("medial", "bar.off", "--theta-table", "0,89,91,180", "--theta-csv",
                           "t.csv")
        self.expect(result, 0)
        with open(self.folder / "t.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["method"] for row in rows], ["sma", "hma"] * 4)
        sheets = {(row["theta_deg"], row["method"]): int(row["sheets"]) for row in rows}
        self.assertEqual(sheets["0", "hma"], sheets["89", "hma"])
        self.assertEqual(sheets["91", "hma"], 0)
        for row in rows:
            self.assertEqual([row["b0"], row["b1"], row["b2"]], ["1", "0", "0"])
        self.assertIn("theta  axis", result.stdout)

    def test_what_is_refused(self):
        for arguments in [["--theta", "-1"], ["--theta", "181"], ["--theta", "nan"],
                          ["--theta", "x"], ["--simplify", "hma"], ["--theta-csv", "t.csv"],
                          ["--theta-table", "0,200"], ["--theta-table", "a"],
                          ["--theta", "30", "--simplify", "other"],
                          ["--angles", "--angle-tolerance", "-1"]]:
            with self.subTest(arguments):
                self.expect(self.blum("medial", "bar.off", *arguments), 1)
                self.assertEqual(self.names(), ["bar.off"])


if __name__ == "__main__":
    main()
