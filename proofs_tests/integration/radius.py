"""Radii and governors of written axes, checked by check_radius.py against the model itself."""

import re
import subprocess
import sys

from tool import SOURCE, ToolTest, main

CHECKER = SOURCE / "proofs_tests" / "integration" / "check_radius.py"

# Least distance between two feet on a tie, in radii. The quads of a rounded torus and of a rotated
# box are planar up to 1e-16: real sheets stand on their diagonals, whose feet are that close.
NEARLY_COPLANAR = ["--min-feet", "0"]
SHAPES = {"cuboid 1 2 3": [], "lbracket": [], "lpocket": [], "prism 5 --move-ulps 1": [],
          "plate 1 6": [], "cuboid 1 2 3 --rotate 1": NEARLY_COPLANAR,
          "torus 8 4": NEARLY_COPLANAR}


class Radius(ToolTest):
    def test_the_checker_notices_spoilt_data(self):
        result = subprocess.run([sys.executable, "-B", CHECKER, "--self-test"], encoding="utf-8",
                                capture_output=True, cwd=self.folder, timeout=600)
        self.expect(result, 0)

    def expect_on_axis(self, model, options):
        result = subprocess.run([sys.executable, "-B", CHECKER, *options, "x.vtp", model],
                                encoding="utf-8", capture_output=True, cwd=self.folder,
                                timeout=600)
        self.expect(result, 0)
        checked = re.search(r"ok: (\d+) vertices on the axis", result.stdout)
        self.assertTrue(checked, result.stdout)
        self.assertGreater(int(checked[1]), 0)

    def test_axis_vertices_are_equally_far_from_their_governors(self):
        for shape, options in SHAPES.items():
            with self.subTest(shape):
                self.expect(self.blum("make", *shape.split(), "-o", "x.off"), 0)
                self.expect(self.blum("medial", "x.off"), 0)
                self.expect_on_axis("x.off", options)

    def test_an_event_whose_rectangle_reaches_out_of_the_solid(self):
        model = SOURCE / "proofs_tests" / "fixtures" / "event_outside_the_solid.off"
        self.expect(self.blum("medial", model, "-o", "x", "--seed", "431"), 0)
        self.expect_on_axis(model, NEARLY_COPLANAR)


if __name__ == "__main__":
    main()
