"""`blum render`: pictures show what they should, and depend on nothing that they should not."""

import math

from png import pixels
from tool import ToolTest, main

WHITE = (255, 255, 255)


class Render(ToolTest):
    def setUp(self):
        super().setUp()
        self.expect(self.blum("make", "plate", "1", "6", "-o", "plate.off"), 0)
        self.expect(self.blum("medial", "plate.off", "--angles", "-o", "plate"), 0)

    def render(self, name, *options):
        """What the tool says; the file's bytes, which equal pictures have in common."""
        result = self.blum("render", "plate", "-o", name, "--width", "120", "--height", "90",
                           "--no-legend", *options)
        self.expect(result, 0)
        return result.stdout, (self.folder / name).read_bytes()

    def covered(self, name):
        """Pixels that are not background, and how many colours there are."""
        width, height, rows = pixels(self.folder / name)
        self.assertEqual((width, height), (120, 90))
        flat = [pixel for row in rows for pixel in row]
        return sum(pixel != WHITE for pixel in flat), len(set(flat))

    def test_a_picture_is_not_background_only(self):
        said = self.render("a.png")[0]
        covered, colours = self.covered("a.png")
        share = int(said.splitlines()[1].split(" % of the picture covered")[0])
        self.assertLessEqual(share, math.ceil(100 * covered / (120 * 90)) + 1)  # of pixels, in part
        self.assertGreater(share, 0.7 * 100 * covered / (120 * 90))
        self.assertGreater(covered, 120 * 90 / 5)
        self.assertGreater(colours, 200)
        said = self.render("b.png", "--no-model", "--no-sheets", "--no-seams", "--no-rims")[0]
        self.assertEqual(said.splitlines()[1], "0 % of the picture covered")
        self.assertEqual(self.covered("b.png"), (0, 1))

    def test_equal_on_any_number_of_threads(self):
        one, three = (self.render(f"{n}.png", "--threads", n)[1] for n in ["1", "3"])
        self.assertEqual(one, three)

    def test_switches_theta_camera_colour_and_section_change_it(self):
        seen = [self.render("a.png")[1]]
        for options in [["--no-model"], ["--no-sheets"], ["--no-seams"], ["--no-rims"],
                        ["--theta", "100"], ["--azimuth", "20"], ["--elevation", "60"],
                        ["--colour", "sheet"], ["--colour", "angle"], ["--zoom", "2"],
                        ["--section", "y:0.5"], ["--section", "-y:0.5"]]:
            with self.subTest(options):
                picture = self.render("b.png", *options)[1]
                self.assertNotIn(picture, seen)
                seen.append(picture)

    def test_theta_draws_the_triangles_of_the_simplified_axis(self):
        for theta in ["0", "89", "100", "180"]:
            said, _ = self.render("a.png", "--theta", theta)
            self.expect(self.blum("medial", "plate.off", "--theta", theta, "-o", "pruned"), 0)
            faces = (self.folder / "pruned.ma").read_text().split()[2]
            self.assertEqual(said.splitlines()[0], f"{faces} triangles")

    def test_a_legend_is_drawn(self):
        self.expect(self.blum("render", "plate", "-o", "with.png", "--width", "300"), 0)
        self.expect(self.blum("render", "plate", "-o", "without.png", "--width", "300",
                              "--no-legend"), 0)
        self.assertNotEqual((self.folder / "with.png").read_bytes(),
                            (self.folder / "without.png").read_bytes())

    def test_what_is_undecided_is_shown(self):
        self.expect(self.blum("medial", "plate.off", "-o", "small", "--max-cells", "1"), 3)
        self.expect(self.blum("render", "small", "-o", "a.png", "--width", "300"), 0)
        self.expect(self.blum("render", "small", "-o", "b.png", "--width", "300",
                              "--no-undecided"), 0)
        self.assertNotEqual((self.folder / "a.png").read_bytes(),
                            (self.folder / "b.png").read_bytes())

    def test_bad_arguments(self):
        for options, code in [(["missing", "-o", "x.png"], 2), (["plate.off", "-o", "x.png"], 2),
                              (["plate", "-o", "x.png", "--colour", "taste"], 1),
                              (["plate", "-o", "x.png", "--section", "w"], 1),
                              (["plate", "-o", "x.png", "--section", "x:2"], 1),
                              (["plate", "-o", "x.png", "--section", "x:a"], 1),
                              (["plate", "-o", "x.png", "--section", "x:nan"], 1),
                              (["plate", "-o", "x.png", "--theta", "nan"], 1),
                              (["plate", "-o", "x.png", "--zoom", "nan"], 1),
                              (["plate", "-o", "x.png", "--azimuth", "nan"], 1),
                              (["plate", "-o", "x.png", "--elevation", "nan"], 1),
                              (["plate", "-o", "x.png", "--width", "0"], 1),
                              (["plate", "-o", "missing/x.png"], 5), (["plate"], 1)]:
            with self.subTest(options):
                result = self.blum("render", *options)
                self.expect(result, code)
                self.assertFalse((self.folder / "x.png").exists())


if __name__ == "__main__":
    main()
