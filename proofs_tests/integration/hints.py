"""`blum medial --hints`: the same axis with hints of any kind, and with none."""

import re

from tool import ToolTest, main


class Hints(ToolTest):
    SHAPES = [["lpocket"], ["torus", 6, 4, 2, 0.75]]

    # What is printed of each.
    SOURCES = {"none": "none", "cpu": "cpu", "gl": "(egl|osmesa)", "corrupted": "cpu, corrupted"}

    def run_with(self, name, *arguments):
        result = self.blum("medial", "shape.off", "-o", name, *arguments)
        if "no OpenGL" in result.stderr:
            return None, None
        self.expect(result, 0)
        return (self.folder / (name + ".ma")).read_bytes(), result.stdout

    def test_axis_is_the_same(self):
        for shape in self.SHAPES:
            self.expect(self.blum("make", *shape, "-o", "shape.off"), 0)
            plain, _ = self.run_with("plain")
            for source in self.SOURCES:
                with self.subTest(shape=shape, hints=source):
                    hinted, text = self.run_with("hinted", "--hints", source,
                                                 "--hint-resolution", 9)
                    if hinted is None:
                        self.assertEqual(source, "gl")
                        self.skipTest("no OpenGL driver")
                    self.assertEqual(plain, hinted)
                    self.assertRegex(text, r"hints +" + self.SOURCES[source])
                    self.assertTrue(re.search(r"[1-9]\d* pairs of a cell and a site", text))

    def test_voronoi_is_the_same(self):
        self.expect(self.blum("make", "cuboid", 1, 2, 3, "-o", "shape.off"), 0)
        complexes = set()
        for source in ["none", "cpu", "corrupted"]:
            self.expect(self.blum("voronoi", "shape.off", "-o", "v", "--hints", source), 0)
            complexes.add((self.folder / "v.ma").read_bytes())
        self.assertEqual(len(complexes), 1)


if __name__ == "__main__":
    main()
