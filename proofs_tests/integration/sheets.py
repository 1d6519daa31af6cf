"""With --resolve the parts of a box's axis are counted, however its facets are triangulated."""

import json

from tool import SEEDS, ToolTest, main

# sheets, seams, junctions + clusters
EXPECTED = {
    "cuboid 1 1.25 2": (13, 12, 4),
    "cuboid 1 1 2": (12, 9, 2),
    "cuboid 1 1 1": (12, 8, 1),
}
CHANGES = ["", "--triangulate 1", "--triangulate 2", "--split-edges 1",
           "--split-edges 2 --triangulate 3", "--shuffle 1"]


class Sheets(ToolTest):
    def test_boxes(self):
        for shape, expected in EXPECTED.items():
            for change in CHANGES:
                self.expect(self.blum("make", *shape.split(), *change.split(), "-o", "x.off"), 0)
                for seed in SEEDS:
                    with self.subTest(shape=shape, change=change, seed=seed):
                        self.expect(self.blum("medial", "x.off", "--resolve", "--seed", seed,
                                              "--summary", "x.json"), 0)
                        parts = json.loads((self.folder / "x.json").read_text())["result"]
                        self.assertEqual(
                            (parts["sheets"], parts["seams"],
                             parts["junctions"] + parts["clusters"]), expected)


if __name__ == "__main__":
    main()
