"""The examples run and say what their comments promise."""

import subprocess

from tool import BUILD, ToolTest, main


class Examples(ToolTest):
    def run_example(self, name, *arguments):
        command = [BUILD / "bin" / f"example_{name}", *arguments]
        result = subprocess.run(command, cwd=self.folder,
                                capture_output=True, encoding="utf-8", timeout=600)
        self.expect(result, 0)
        return result.stdout

    def test_mesh_to_axis(self):
        self.assertIn("certified", self.run_example("mesh_to_axis"))
        self.assertEqual(self.names(), ["wedge.ma", "wedge.obj", "wedge.vtp"])

    def test_walk_sheets(self):
        lines = self.run_example("walk_sheets").splitlines()
        self.assertGreater(len(lines), 13)  # an L-bracket has more sheets than a box
        for line in lines:
            self.assertRegex(
                line, r"^area \S+, radius \S+ to \S+, between( (vertex|edge|face) \d+)+$")

    def test_sample_field(self):
        self.expect(self.blum("make", "cuboid", 2, 3, 4, "-o", "box.off"), 0)
        words = self.run_example("sample_field", "box.off", "40").split()
        fits, most = float(words[4]), float(words[-1])
        self.assertLessEqual(fits, 1)
        self.assertGreaterEqual(most, 1)
        self.assertLess(most - fits, 0.2)

    def test_find_neighbours(self):
        self.expect(self.blum("make", "lbracket", "-o", "bracket.off"), 0)
        pairs, superset, seen = [int(word) for word in
                                 self.run_example("find_neighbours", "bracket.off").split()
                                 if word.isdigit()]
        self.assertLess(seen, superset)
        self.assertLess(superset, pairs)


if __name__ == "__main__":
    main()
