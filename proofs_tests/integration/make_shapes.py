"""`blum make`: every shape, changed in every way, is a valid solid with the stated topology."""

import json
import re

from tool import ToolTest, main

SHAPES = {
    "cuboid": [1, 0, 0],
    "cuboid 2 2 3": [1, 0, 0],
    "lbracket": [1, 0, 0],
    "lpocket": [1, 0, 0],
    "lpocket 1 1.5 0.5": [1, 0, 0],
    "prism 3": [1, 0, 0],
    "prism 16": [1, 0, 0],
    "prism 7 --move 1e-6": [1, 0, 0],
    "prism 7 --move -1e-12": [1, 0, 0],
    "prism 7 --move-ulps -1": [1, 0, 0],
    "plate 0": [1, 0, 0],
    "plate 1 4": [1, 1, 0],
    "plate 2 6": [1, 2, 0],
    "plate 5 3 1 0.125": [1, 5, 0],
    "voids 1": [1, 0, 1],
    "voids 3": [3, 0, 3],
    "torus 8 4": [1, 1, 0],
    "torus 16 8 2 0.5": [1, 1, 0],
    "planar_torus 8 4": [1, 1, 0],
    "planar_torus 16 8": [1, 1, 0],
    "knot": [1, 1, 0],
    "knot 3 2": [1, 1, 0],
}


class MakeShapes(ToolTest):
    def expect_valid(self, name, betti):
        info = self.blum("info", name, "--json")
        self.expect(info, 0)
        answer = json.loads(info.stdout)
        self.assertTrue(answer["valid"])
        self.assertEqual(answer["solid"]["betti"], betti)
        self.assertEqual(answer["defects"], [])
        return answer

    def test_every_shape_and_change_is_a_valid_solid(self):
        changes = ["", "--rotate 1", "--triangulate 2", "--split-edges 3", "--shuffle 4",
                   "--split-edges 5 --triangulate 6 --rotate 7 --shuffle 8"]
        for shape, betti in SHAPES.items():
            for change in changes:
                with self.subTest(shape=shape, change=change):
                    made = self.blum("make", *shape.split(), *change.split(), "-o", "x.off")
                    self.expect(made, 0)
                    self.expect_valid("x.off", betti)

    def test_help_lists_every_shape(self):
        text = self.blum("make", "--help").stdout
        listed = set(re.findall(r"^  (\w+)(?: \w+=\S+)+$", text, re.MULTILINE))
        self.assertEqual(listed, {shape.split()[0] for shape in SHAPES})

    def test_seeds_decide_the_file(self):
        def made(*arguments):
            self.expect(self.blum("make", "plate", *arguments, "-o", "x.off"), 0)
            return (self.folder / "x.off").read_bytes()

        for option in ["--rotate", "--triangulate", "--split-edges", "--shuffle"]:
            self.assertEqual(made(option, "1"), made(option, "1"))
            self.assertNotEqual(made(option, "1"), made(option, "2"))

    def test_text_of_info(self):
        self.expect(self.blum("make", "cuboid", "1", "2", "3", "-o", "box.off"), 0)
        result = self.blum("info", "box.off")
        self.expect(result, 0)
        for line in [r"valid solid: +yes", r"Betti numbers: +1 0 0", r"volume: +6\b",
                     r"dihedral angles: +90 \.\. 90 degrees", r"facets: +6\b",
                     r"edges: +18 of the triangulation: 12 convex, 0 reflex, 6 flat"]:
            self.assertRegex(result.stdout, line)

    def test_parameters_are_used(self):
        self.expect(self.blum("make", "cuboid", "1", "2", "4", "-o", "box.off"), 0)
        answer = self.expect_valid("box.off", [1, 0, 0])
        self.assertEqual(answer["bounding_box"], {"min": [0, 0, 0], "max": [1, 2, 4]})
        self.assertEqual(answer["solid"]["volume"], 8)


if __name__ == "__main__":
    main()
