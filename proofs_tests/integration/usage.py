"""Usage errors exit with 1 and write nothing; help and version exit with 0."""

from tool import ToolTest, main


class Usage(ToolTest):
    def test_wrong_command_lines_exit_with_1(self):
        self.expect(self.blum("make", "cuboid", "-o", "box.off"), 0)
        wrong = [
            [],
            ["nonsense"],
            ["--nonsense"],
            ["info"],
            ["info", "box.off", "box.off"],
            ["info", "box.off", "--nonsense"],
            ["medial"],
            ["medial", "box.off", "--seed", "x"],
            ["medial", "box.off", "--seed", "-1"],
            ["medial", "box.off", "--seed", "1.5"],
            ["medial", "box.off", "--engine", "fast"],
            ["medial", "box.off", "--max-depth", "-1"],
            ["medial", "box.off", "--max-cells", "-1"],
            ["medial", "box.off", "--time-limit", "-1"],
            ["medial", "box.off", "--time-limit", "nan"],
            ["medial", "box.off", "--time-limit", "soon"],
            ["medial", "box.off", "--threads", "0"],
            ["medial", "box.off", "--coplanar-tolerance", "-1"],
            ["medial", "box.off", "--coplanar-tolerance", "nan"],
            ["medial", "box.off", "--coplanar-tolerance", "2"],
            ["medial", "box.off", "--write-flattened", "flat.off"],
            ["medial", "box.off", "--threads", "1e9"],
            ["medial", "box.off", "--max-memory", "-1"],
            ["medial", "box.off", "--max-memory", "1e30"],
            ["medial", "box.off", "-o"],
            ["medial", "box.off", "--margin", "1"],
            ["medial", "box.off", "--engine", "brute", "--certificate", "x.cert"],
            ["voronoi", "box.off", "--theta", "30"],
            ["voronoi", "box.off", "--angles"],
            ["voronoi", "box.off", "--no-cuts"],
            ["voronoi", "box.off", "--certificate", "x.cert"],
            ["voronoi", "box.off", "--engine", "cgal"],
            ["make", "cuboid"],
            ["make", "-o", "x.off"],
            ["make", "sphere", "-o", "x.off"],
            ["make", "cuboid", "1", "2", "3", "4", "-o", "x.off"],
            ["make", "cuboid", "0", "1", "1", "-o", "x.off"],
            ["make", "cuboid", "--", "-1", "1", "1", "-o", "x.off"],
            ["make", "cuboid", "nan", "-o", "x.off"],
            ["make", "cuboid", "inf", "-o", "x.off"],
            ["make", "cuboid", "1e308", "-o", "x.off"],
            ["make", "cuboid", "--move", "1", "-o", "x.off"],
            ["make", "lbracket", "1", "1", "1", "-o", "x.off"],
            ["make", "prism", "2", "-o", "x.off"],
            ["make", "prism", "3.5", "-o", "x.off"],
            ["make", "prism", "1e9", "-o", "x.off"],
            ["make", "plate", "-o", "x.off", "--", "-1"],
            ["make", "torus", "8", "4", "1", "2", "-o", "x.off"],
            ["make", "knot", "2", "4", "-o", "x.off"],
            ["make", "knot", "2", "3", "48", "6", "2", "1", "1.5", "-o", "x.off"],
            ["make", "cuboid", "-o", "x.off", "--rotate", "-1"],
            ["make", "cuboid", "-o", "x.off", "--rotate", "a"],
        ]
        for arguments in wrong:
            with self.subTest(arguments):
                result = self.blum(*arguments)
                self.expect(result, 1)
                self.assertTrue(result.stderr)
                self.assertEqual(self.names(), ["box.off"])

    def test_help_and_version_exit_with_0(self):
        commands = ["certificate", "field", "info", "make", "medial", "midsurface", "render",
                    "thickness", "verify", "view", "voronoi"]
        for arguments in [["--help"], ["-h"], *([command, "--help"] for command in commands)]:
            with self.subTest(arguments):
                result = self.blum(*arguments)
                self.expect(result, 0)
                self.assertIn("Examples:", result.stdout)
                self.assertTrue(result.stdout.replace("\n", "").isprintable(), arguments)
        result = self.blum("--version")
        self.expect(result, 0)
        self.assertRegex(result.stdout, r"^blum \d+\.\d+\.\d+\n$")

    def test_the_model_is_never_overwritten(self):
        self.expect(self.blum("make", "cuboid", "-o", "box.off"), 0)
        lines = (self.folder / "box.off").read_text().split()
        points, faces = int(lines[1]), int(lines[2])
        numbers = lines[4:]
        text = "".join("v " + " ".join(numbers[3 * i:3 * i + 3]) + "\n" for i in range(points))
        numbers = [int(n) for n in numbers[3 * points:]]
        for _ in range(faces):
            count = numbers[0]
            text += "f " + " ".join(str(n + 1) for n in numbers[1:count + 1]) + "\n"
            numbers = numbers[count + 1:]
        model = self.file("box.obj", text)
        for arguments in [["medial", "box.obj"], ["medial", "box.obj", "-o", "./box"],
                          ["medial", "box.obj", "-o", "other", "--summary", "box.obj"],
                          ["medial", "box.obj", "-o", "other", "--coplanar-tolerance", "0",
                           "--write-flattened", "box.obj"]]:
            with self.subTest(arguments):
                self.expect(self.blum(*arguments), 1)
                self.assertEqual(model.read_text(), text)
                self.assertEqual(self.names(), ["box.obj", "box.off"])


if __name__ == "__main__":
    main()
