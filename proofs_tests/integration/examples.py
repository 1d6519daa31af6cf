"""The examples run and say what their comments promise."""

import subprocess

from tool import BUILD, ToolTest, main


class Examples(ToolTest):
    def run_example(self, name):
        result = subprocess.run([BUILD / "bin" / f"example_{name}"], cwd=self.folder,
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


if __name__ == "__main__":
    main()
