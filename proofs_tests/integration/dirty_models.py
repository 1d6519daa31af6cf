"""Every class of defects that the manifest counts for a dirty model is named, with exit code 2."""

import csv
import json

from tool import SHARED_MODELS, ToolTest, main

CODES = {
    "boundary_edges": "boundary_edge",
    "nonmanifold_edges": "nonmanifold_edge",
    "nonmanifold_vertices": "nonmanifold_vertex",
    "inconsistent_edges": "inconsistent_orientation",
    "self_intersecting_pairs": "self_intersection",
    "duplicate_vertices": "duplicate_vertex",
    "duplicate_faces": "duplicate_face",
    "degenerate_faces": "degenerate_face",
    "isolated_vertices": "isolated_vertex",
}


def manifest():
    with open(SHARED_MODELS / "MANIFEST.csv", newline="") as file:
        return list(csv.DictReader(file))


class DirtyModels(ToolTest):
    def setUp(self):
        if not SHARED_MODELS.is_dir():
            self.skipTest(f"no models: {SHARED_MODELS} is missing")
        super().setUp()

    def test_every_defect_class_of_the_manifest_is_named(self):
        rows = [row for row in manifest() if row["file"].startswith("dirty_")]
        self.assertTrue(rows)
        for row in rows:
            model = SHARED_MODELS / row["file"]
            expected = {code for column, code in CODES.items() if int(row[column] or 0) > 0}
            with self.subTest(row["file"]):
                self.assertTrue(expected)
                info = self.blum("info", model, "--json")
                self.expect(info, 2)
                answer = json.loads(info.stdout)
                self.assertFalse(answer["valid"])
                found = {defect["code"]: defect for defect in answer["defects"]}
                self.assertLessEqual(expected, set(found))
                for defect in found.values():
                    self.assertGreater(defect["count"], 0)
                    self.assertTrue(defect["examples"])
                    self.assertTrue(all(len(point) == 3 for example in defect["examples"]
                                        for point in example["points"]))
                for command in [["info", model], ["medial", model, "-o", "result"]]:
                    result = self.blum(*command)
                    self.expect(result, 2)
                    for code in expected:
                        self.assertIn(code, result.stderr)
                self.assertEqual(self.names(), [])

    def test_valid_models_are_what_the_manifest_says(self):
        for row in manifest():
            if row["valid_solid"] != "yes" or int(row["faces"]) > 7000:
                continue
            with self.subTest(row["file"]):
                info = self.blum("info", SHARED_MODELS / row["file"], "--json")
                self.expect(info, 0)
                answer = json.loads(info.stdout)
                self.assertTrue(answer["valid"])
                self.assertEqual(answer["solid"]["betti"],
                                 [int(row[column]) for column in ("beta0", "beta1", "beta2")])
                self.assertEqual(answer["mesh"]["vertices"], int(row["vertices"]))
                self.assertEqual(answer["mesh"]["faces"], int(row["faces"]))


if __name__ == "__main__":
    main()
