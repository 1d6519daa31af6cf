"""The geometry of `blum medial`: --epsilon, --edge-length, --feet, --smooth, --reconstruction."""

import json
import math

from tool import SANITIZERS, ToolTest, main
from vtp import arrays


class Geometry(ToolTest):
    def setUp(self):
        super().setUp()
        self.expect(self.blum("make", "cuboid", "3", "2", "1", "-o", "box.off"), 0)
        self.diagonal = math.sqrt(14)

    def summary(self, *arguments, code=0):
        self.expect(self.blum("medial", "box.off", "-o", "x", "--summary", "x.json", *arguments),
                    code)
        return json.loads((self.folder / "x.json").read_text())

    def points(self):
        lines = (self.folder / "x.ma").read_text().splitlines()
        return [list(map(float, line.split()[1:])) for line in lines if line.startswith("v ")]

    def test_the_bound_is_reached_with_few_leaves(self):
        summary = self.summary("--epsilon", "0.02")
        geometry = summary["geometry"]
        self.assertIs(geometry["epsilon_reached"], True)
        self.assertLessEqual(geometry["hausdorff_percent"], 2)
        self.assertEqual(geometry["hausdorff_bound"], summary["result"]["hausdorff_bound"])
        self.assertAlmostEqual(geometry["hausdorff_bound"] * 100 / self.diagonal,
                               geometry["hausdorff_percent"])
        self.assertLess(summary["result"]["leaves"], 500)
        self.assertEqual(geometry["mesh"]["vertices"], len(self.points()))
        uniform = self.summary("--leaf-diameter", "0.1")
        self.assertLessEqual(uniform["geometry"]["hausdorff_percent"], 10)
        self.assertGreater(uniform["result"]["leaves"], 500)

    def test_points_are_on_the_axis(self):
        self.assertEqual(self.summary("--epsilon", "0.05")["geometry"]["unconverged"], 0)
        for x, y, z, r in self.points():
            walls = sorted([x, 3 - x, y, 2 - y, z, 1 - z])
            self.assertAlmostEqual(walls[0], r)
            self.assertAlmostEqual(walls[1], r)  # two walls at least

    def test_a_time_limit_leaves_a_larger_bound_and_says_so(self):
        self.expect(self.blum("make", "torus", "8", "5", "-o", "box.off"), 0)
        seconds = 10 if SANITIZERS else 0.5  # enough for the topology, never for the bound
        summary = self.summary("--epsilon", "1e-5", "--time-limit", seconds, code=3)
        self.assertIs(summary["result"]["certified"], True)
        self.assertIs(summary["geometry"]["epsilon_reached"], False)
        self.assertGreater(summary["geometry"]["hausdorff_percent"], 1e-3)

    def test_without_a_certificate_there_is_no_bound(self):
        self.expect(self.blum("make", "plate", "-o", "box.off"), 0)
        summary = self.summary("--epsilon", "0.01", "--max-depth", "0", code=3)
        self.assertIs(summary["result"]["certified"], False)
        self.assertIsNone(summary["result"]["hausdorff_bound"])
        self.assertIsNone(summary["geometry"]["hausdorff_bound"])
        self.assertIs(summary["geometry"]["epsilon_reached"], False)

    def test_meshes_are_as_fine_as_asked_for(self):
        coarse = self.summary("--edge-length", "0.1")["geometry"]["mesh"]
        fine = self.summary("--edge-length", "0.05")["geometry"]["mesh"]
        self.assertGreater(fine["triangles"], 3 * coarse["triangles"])
        lines = (self.folder / "x.ma").read_text().splitlines()
        points = self.points()
        for line in lines:
            if line.startswith("e "):
                a, b = (points[int(i)][:3] for i in line.split()[1:])
                self.assertLessEqual(math.dist(a, b), 0.05 * self.diagonal * (1 + 1e-9))

    def test_smoothing_is_for_display_only(self):
        summary = self.summary("--edge-length", "0.05", "--smooth")
        self.assertIs(summary["result"]["certified"], True)
        self.assertIn("largest_displacement", summary["smooth"])
        self.assertEqual(arrays(self.folder / "x.vtp")["FieldData/certified"], [0])
        self.summary("--edge-length", "0.05")
        self.assertEqual(arrays(self.folder / "x.vtp")["FieldData/certified"], [1])
        result = self.blum("medial", "box.off", "--smooth", "--certificate", "x.cert")
        self.expect(result, 1)
        self.assertFalse((self.folder / "x.cert").exists())

    def test_reconstruction(self):
        last = math.inf
        for length in ["0.2", "0.05"]:
            r = self.summary("--edge-length", length, "--reconstruction")["reconstruction"]
            low, high = r["boundary_to_union_percent"]
            self.assertLessEqual(low, high)
            self.assertLess(high, last)
            last = high
            self.assertGreater(r["border_samples"], 0)

    def test_feet(self):
        self.summary("--feet")
        feet = (self.folder / "x.feet.vtp").read_bytes()
        for name in [b"axis_point", b"axis_triangle", b"side", b"sheet", b"element",
                     b"element_kind"]:
            self.assertEqual(feet.count(b'Name="' + name + b'"'), 1, name)

    def test_from_a_face_to_the_axis_and_back(self):
        self.summary("--epsilon", "0.05", "--feet")
        feet, axis = (arrays(self.folder / name) for name in ["x.feet.vtp", "x.vtp"])
        patches = list(zip(feet["CellData/element_kind"], feet["CellData/element"],
                           feet["CellData/axis_triangle"], feet["CellData/side"]))
        of_triangle, of_face = {}, {}
        for kind, element, triangle, side in patches:
            of_triangle.setdefault(triangle, {})[side] = (kind, element)
            if kind == 2:
                of_face.setdefault(element, set()).add(triangle)
        self.assertEqual(sorted(of_triangle), list(range(len(axis["Polys/offsets"]))))
        self.assertEqual(sorted(of_face), list(range(axis["FieldData/site_counts"][2])))
        lines = len(axis["Lines/offsets"])
        vertices, edges, _ = axis["FieldData/site_counts"]
        for face, triangles in of_face.items():
            for triangle in triangles:
                sides = of_triangle[triangle]
                self.assertEqual(sorted(sides), [0, 1])
                self.assertIn((2, face), sides.values())
                # Its governors are the two sides', or others of the same sides.
                governors = {axis[f"CellData/governor_{k}"][lines + triangle] for k in "ab"}
                self.assertEqual(len(governors), 2)
        shared = sum({vertices + edges + e for k, e in sides.values() if k == 2} ==
                     {axis[f"CellData/governor_{k}"][lines + t] for k in "ab"}
                     for t, sides in of_triangle.items())
        self.assertGreater(shared, len(of_triangle) / 2)

    def test_certificates_of_refined_results_verify(self):
        self.summary("--epsilon", "0.05", "--certificate", "x.cert")
        self.expect(self.blum("verify", "box.off", "x.cert"), 0)

    def test_bad_lengths(self):
        for option in ["--epsilon", "--edge-length", "--leaf-diameter"]:
            with self.subTest(option):
                self.expect(self.blum("medial", "box.off", option, "-1"), 1)


if __name__ == "__main__":
    main()
