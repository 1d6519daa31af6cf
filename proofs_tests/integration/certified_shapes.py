"""The axis of every generated solid of the list is certified, with the solid's Betti numbers."""

from tool import ToolTest, main

SHAPES = (["cuboid 2 2 3", "lbracket", "lpocket", "plate 1 6", "plate 2 6", "voids 1", "voids 2",
           "voids 3", "torus 8 4", "torus 16 8"]
          + [f"prism {n}{move}" for n in range(3, 17)
             for move in ["", " --move 1e-6", " --move 1e-12", " --move-ulps 1"]])
# Turned in every way: medial/must_hold_test.cpp.
ROTATED = [shape + " --rotate 1" for shape in SHAPES if not shape.startswith(("lpocket", "voids"))]


class CertifiedShapes(ToolTest):
    def test_axes_are_certified(self):
        for shape in SHAPES + ROTATED:
            with self.subTest(shape):
                self.expect(self.blum("make", *shape.split(), "-o", "model.off"), 0)
                self.expect_certified("model.off")


if __name__ == "__main__":
    main()
