"""The axis of every shared model of the list is certified, with the solid's Betti numbers."""

from tool import SHARED_MODELS, ToolTest, main

MODELS = ["cube", "cube_minus_octant", "cross", "P_polygons", "cray_left_void",
          "derived_cube_sphere_void"]


class CertifiedModels(ToolTest):
    def test_axes_are_certified(self):
        if not SHARED_MODELS.is_dir():
            self.skipTest(f"no models: {SHARED_MODELS} is missing")
        for name in MODELS:
            with self.subTest(name):
                self.expect_certified(SHARED_MODELS / (name + ".off"))


if __name__ == "__main__":
    main()
