"""`blum thickness` and `blum midsurface`, as a user meets them."""

import csv
import math
import re
import struct

from png import pixels
from tool import ToolTest, main
from vtp import arrays


class Thickness(ToolTest):
    def setUp(self):
        super().setUp()
        self.expect(self.blum("make", "cuboid", "4", "3", "1", "-o", "box.off"), 0)

    def test_the_wall_of_a_box(self):
        result = self.blum("thickness", "box.off", "--theta", "100", "--density", "10", "-o", "t")
        self.expect(result, 0)
        self.assertEqual(self.names(), ["box.off", "t.csv", "t.ply", "t.png", "t.vtp"])
        value = float(re.search(r"thinnest +([0-9.e-]+) at", result.stdout).group(1))
        self.assertAlmostEqual(value, 1, places=9)
        cells = arrays(self.folder / "t.vtp")
        counted = [t for t, c in zip(cells["CellData/thickness"], cells["CellData/counts"]) if c]
        self.assertTrue(counted)
        for t in counted:
            self.assertAlmostEqual(t, 1, places=9)
        for t, c in zip(cells["CellData/thickness"], cells["CellData/counts"]):
            self.assertEqual(math.isnan(t), not c)
        self.assertLess(max(cells["CellData/error"]), 1e-9)
        self.assertGreater(max(cells["CellData/error"]), 0)
        rows = list(csv.DictReader((self.folder / "t.csv").read_text().splitlines()))
        self.assertEqual(len(rows), 40)
        self.assertAlmostEqual(sum(float(row["fraction"]) for row in rows), 1, places=6)
        self.assertAlmostEqual(float(rows[-1]["fraction"]), 1, places=6)
        width, height, picture = pixels(self.folder / "t.png")
        self.assertEqual((width, height), (900, 560))
        self.assertGreater(len({p for row in picture[::20] for p in row}), 5)

    def test_the_samples_as_ply(self):
        self.expect(self.blum("thickness", "box.off", "--density", "10", "-o", "t"), 0)
        head, body = (self.folder / "t.ply").read_bytes().split(b"end_header\n", 1)
        count = int(re.search(rb"element vertex (\d+)", head).group(1))
        record = struct.Struct("<6diB")
        self.assertEqual(len(body), count * record.size)
        for x, y, z, t, error, angle, sheet, counts in record.iter_unpack(body):
            exact = min(h if v < 1e-12 or v > h - 1e-12 else 2 * min(v, h - v)
                        for v, h in ((x, 4), (y, 3), (z, 1)))
            self.assertAlmostEqual(t, exact, delta=error + 1e-14)

    def test_can_be_drawn_and_viewed(self):
        self.expect(self.blum("thickness", "box.off", "--density", "5", "-o", "t"), 0)
        self.expect(self.blum("render", "t.vtp", "-o", "t.render.png", "--width", "100"), 0)
        self.expect(self.blum("view", "t.vtp", "-o", "t.html"), 0)

    def test_bad_arguments(self):
        for options, code in [(["--density", "0"], 1), (["--density", "1e12"], 1),
                              (["--theta", "181"], 1), (["-o", "missing/t"], 5)]:
            with self.subTest(options):
                self.expect(self.blum("thickness", "box.off", *options), code)
        common = ["--epsilon", "--time-limit"]
        for command, names in [("thickness", ["--density", "--theta", *common]),
                               ("midsurface", ["--opposite", "--max-thickness", *common])]:
            for name in names:
                with self.subTest(f"{command} {name} nan"):
                    self.expect(self.blum(command, "box.off", name, "nan"), 1)
        self.expect(self.blum("thickness", "missing.off"), 2)
        self.assertEqual(self.names(), ["box.off"])

    def test_the_model_is_not_overwritten(self):
        counts, *rest = (self.folder / "box.off").read_text().split("\n", 2)[1:]
        points, faces, _ = counts.split()
        head = (f"ply\nformat ascii 1.0\nelement vertex {points}\n"
                "property double x\nproperty double y\nproperty double z\n"
                f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n")
        model = self.file("wall.ply", head + rest[0])
        before = model.read_bytes()
        for command, *options in [["thickness", "--density", "5"], ["midsurface", "--epsilon", "0.2"]]:
            self.expect(self.blum(command, "wall.ply", *options, "-o", "wall"), 1)
            self.assertEqual(model.read_bytes(), before)
            self.assertEqual(self.names(), ["box.off", "wall.ply"])
            self.expect(self.blum(command, "wall.ply", *options, "-o", "other"), 0)
            for path in self.folder.glob("other.*"):
                path.unlink()

    def test_a_midsurface(self):
        result = self.blum("midsurface", "box.off", "--epsilon", "0.1", "-o", "m")
        self.expect(result, 0)
        self.assertEqual(self.names(), ["box.off", "m.ply", "m.vtp"])
        data = arrays(self.folder / "m.vtp")
        self.assertAlmostEqual(max(data["PointData/thickness"]), 1, places=9)
        self.assertEqual(len(set(data["CellData/sheet"]) - {-1}), 1)
        self.expect(self.blum("midsurface", "box.off", "--max-thickness", "0.5", "-o", "m"), 0)
        self.assertEqual(arrays(self.folder / "m.vtp")["PointData/thickness"], [])


if __name__ == "__main__":
    main()
