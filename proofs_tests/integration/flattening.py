"""--coplanar-tolerance: the changed solid is certified, saved and described, or nothing is written."""

import json

from tool import SHARED_MODELS, ToolTest, main

CUBE_MINUS_OCTANT = SHARED_MODELS / "cube_minus_octant.off"
JOINT = SHARED_MODELS / "joint.off"


def thin_plate():
    corners = [(x, y, z) for z in (0, 1e-7) for y in (0, 1) for x in (0, 1)]
    faces = ["0 2 3 1", "4 5 7 6", "0 1 5 4", "2 6 7 3", "0 4 6 2", "1 3 7 5"]
    return ("OFF\n8 6 0\n" + "".join("%r %r %r\n" % corner for corner in corners) +
            "".join(f"4 {face}\n" for face in faces))


class Flattening(ToolTest):
    def flatten(self, model, prefix):
        """Writes PREFIX.ma and PREFIX.off; returns the summary as text and as JSON."""
        result = self.blum("medial", model, "-o", prefix, "--summary", "summary.json",
                           "--coplanar-tolerance", "1e-6", "--write-flattened", prefix + ".off")
        self.expect(result, 0)
        return result.stdout, json.loads((self.folder / "summary.json").read_text())

    def test_the_changed_solid_is_certified_saved_and_described(self):
        if not SHARED_MODELS.is_dir():
            self.skipTest(f"no models: {SHARED_MODELS} is missing")
        for model, moved, flat, left, betti in [(CUBE_MINUS_OCTANT, 11, (7, 15), 0, [1, 0, 0]),
                                                (JOINT, 11, (321, 341), 2, [1, 2, 0])]:
            with self.subTest(model.name):
                text, summary = self.flatten(model, "once")
                self.assertIs(summary["result"]["certified"], True)
                self.assertEqual(summary["result"]["betti"], betti)
                changes = summary["coplanar"]
                self.assertEqual(changes["tolerance"], 1e-6)
                self.assertEqual(changes["vertices_moved"], moved)
                self.assertEqual((changes["flat_edges_before"], changes["flat_edges_after"]), flat)
                self.assertEqual(changes["nearly_flat_edges_left"], left)
                self.assertGreater(changes["largest_displacement"], 0)
                self.assertIn(f"changed    {moved} vertices moved by at most", text)
                info = json.loads(self.blum("info", "once.off", "--json").stdout)
                self.assertEqual(info["solid"]["betti"], betti)
                text, summary = self.flatten("once.off", "twice")
                self.assertIn("changed    nothing", text)
                self.assertEqual(summary["coplanar"]["vertices_moved"], 0)
                for suffix in (".off", ".ma"):
                    once, twice = ((self.folder / (name + suffix)).read_bytes()
                                   for name in ("once", "twice"))
                    self.assertEqual(once, twice)

    def test_tolerance_0_changes_nothing(self):
        self.expect(self.blum("make", "lbracket", "-o", "l.off", "--rotate", "1"), 0)
        self.expect(self.blum("medial", "l.off", "-o", "a"), 0)
        self.expect(self.blum("medial", "l.off", "-o", "b", "--coplanar-tolerance", "0",
                              "--summary", "b.json", "--write-flattened", "same.off"), 0)
        self.assertNotIn("coplanar", json.loads((self.folder / "b.json").read_text()))
        for a, b in [("a.ma", "b.ma"), ("l.off", "same.off")]:
            self.assertEqual((self.folder / a).read_bytes(), (self.folder / b).read_bytes())

    def test_a_wall_thinner_than_the_tolerance_is_bad_input(self):
        self.file("plate.off", thin_plate())
        result = self.blum("medial", "plate.off", "-o", "x", "--coplanar-tolerance", "1e-6",
                           "--write-flattened", "flat.off")
        self.expect(result, 2)
        self.assertIn("plate.off: the coplanar tolerance is too large", result.stderr)
        self.assertEqual(self.names(), ["plate.off"])


if __name__ == "__main__":
    main()
