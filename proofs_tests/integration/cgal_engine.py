"""`--engine cgal` certifies the smallest solids end to end, like the production engine."""

import json
import pathlib
import unittest

from tool import SEEDS, TOOL, ToolTest, main

HELPER = pathlib.Path(TOOL).parent / "blum-cgal-engine"


class CgalEngine(ToolTest):
    def summary(self, engine, seed):
        result = self.blum("medial", "model.off", "-o", engine, "--summary", engine + ".json",
                           "--engine", engine, "--seed", seed)
        self.expect(result, 0)
        return json.loads((self.folder / (engine + ".json")).read_text())

    @unittest.skipUnless(HELPER.exists(), "built without BLUM_CGAL_ORACLES")
    def test_small_solids_are_certified(self):
        for shape in ["cuboid 2 2 3", "lbracket"]:
            for seed in SEEDS:
                with self.subTest(shape=shape, seed=seed):
                    self.expect(self.blum("make", *shape.split(), "-o", "model.off"), 0)
                    cgal = self.summary("cgal", seed)
                    production = self.summary("production", seed)
                    for summary in [cgal, production]:
                        self.assertIs(summary["result"]["certified"], True)
                        self.assertEqual(summary["result"]["betti"], summary["solid"]["betti"])

    def test_a_missing_helper_is_an_error(self):
        self.expect(self.blum("make", "cuboid", "1", "1", "1", "-o", "model.off"), 0)
        for helper in ["/nowhere", str(self.folder)]:
            result = self.blum("medial", "model.off", "--engine", "cgal",
                               env={"BLUM_CGAL_ENGINE": helper})
            self.expect(result, 1)
            self.assertIn("blum-cgal-engine", result.stderr)
            self.assertEqual(self.names(), ["model.off"])

    def test_a_helper_that_answers_nonsense_is_never_believed(self):
        self.expect(self.blum("make", "cuboid", "1", "1", "1", "-o", "model.off"), 0)
        for name, answer in [("silent", "exit 0"), ("loud", "while read x; do echo nonsense; done"),
                             ("empty", "while read x; do echo '{\"status\": 0}'; done")]:
            helper = self.file(name, "#!/bin/sh\n" + answer + "\n")
            helper.chmod(0o755)
            result = self.blum("medial", "model.off", "--engine", "cgal", "--max-cells", "20",
                               env={"BLUM_CGAL_ENGINE": str(helper)})
            self.expect(result, 3)


if __name__ == "__main__":
    main()
