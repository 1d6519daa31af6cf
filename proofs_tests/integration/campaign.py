"""The campaign tool: a sample of every family, resumed after an interrupt; it notices what it has to
notice (a tool that lies, crashes or hangs); replays; shrinks."""

import json
import pathlib
import random
import signal
import sqlite3
import struct
import subprocess
import sys
import unittest

from tool import SANITIZERS, SOURCE, TOOL, ToolTest, main

FOLDER = SOURCE / "proofs_tests" / "campaign"
MEMORY = ["--max-memory", "0"] if SANITIZERS else []
sys.path.insert(0, str(FOLDER))

import convex  # noqa: E402
import families  # noqa: E402
import thin  # noqa: E402
from facets import merged, retriangulated  # noqa: E402
from mesh import Mesh, betti_numbers, integers, triangles, volume  # noqa: E402
from voxels import of_pattern, unit_planes  # noqa: E402

# Runs the tool, then changes what it leaves behind, as the first argument says.
LIAR = """#!{python}
import json, os, pathlib, signal, subprocess, sys, time
what = {what!r}
asks_for_certificate = "--certificate" in sys.argv
if what == "hangs" or what == "certificate hangs" and asks_for_certificate:
    time.sleep(600)
if what == "refuses" and sys.argv[1] == "verify":
    print("FALSE      a lie about cell 17")
    sys.exit(4)
if what == "certificate of no solid" and asks_for_certificate:
    print("  error: 0 self_intersection", file=sys.stderr)
    sys.exit(2)
if what == "certificate undecided" and asks_for_certificate:
    sys.argv += ["--max-cells", "1"]
ended = subprocess.run([{tool!r}, *sys.argv[1:]], stdout=subprocess.DEVNULL)
path = None
if "--summary" in sys.argv:
    path = pathlib.Path(sys.argv[sys.argv.index("--summary") + 1])
if path and path.is_file():
    summary = json.loads(path.read_text())
    if what == "wrong axis" or what == "certificate wrong" and asks_for_certificate:
        summary["result"]["betti"][1] += 1
    if what == "wrong solid":
        summary["solid"]["betti"][0] += 1
    if what == "not what it says":
        summary["result"]["certified"] = False
    path.write_text(json.dumps(summary))
if what == "signal":
    os.kill(os.getpid(), signal.SIGSEGV)
if what == "wrong radius":
    vtp = pathlib.Path("x.vtp")
    model = pathlib.Path("model.off").read_text().splitlines()
    model[2] = "0.015625 0 0"
    pathlib.Path("model.off").write_text("\\n".join(model))
if what == "wrong or not" and len(pathlib.Path("model.off").read_text()) > 400:
    summary["result"]["betti"][0] += 1
    path.write_text(json.dumps(summary))
sys.exit(4 if what == "internal error" else ended.returncode)
"""


class Campaign(ToolTest):
    def campaign(self, command, *arguments, tool=TOOL, **options):
        if command in ("run", "replay", "shrink"):
            arguments = ["--tool", tool, *MEMORY, *arguments]
        return subprocess.run(
            [sys.executable, "-B", FOLDER / "campaign.py", command, "--store", "runs.db",
             *map(str, arguments)], cwd=self.folder, capture_output=True, encoding="utf-8",
            timeout=300, **options)

    def runs(self, columns="*"):
        base = sqlite3.connect(self.folder / "runs.db")
        try:
            return base.execute(f"SELECT {columns} FROM run ORDER BY id").fetchall()
        finally:
            base.close()

    def liar(self, what):
        path = self.file("liar", LIAR.format(python=sys.executable, tool=TOOL, what=what))
        path.chmod(0o755)
        return path

    def test_a_sample_of_every_family(self):
        names = [name for name in families.FAMILIES if name != "cone"]  # too slow for a sample
        result = self.campaign("run", "--count", len(names), "--families", ",".join(names),
                               "--time-limit", "1", "--workers", "2", "--check-axis", "5")
        self.expect(result, 0)
        rows = self.runs("family, seed, outcome, betti_expected, betti, certified, exit_code, sites,"
                         " commit_id, parameters")
        self.assertEqual({row[0] for row in rows}, set(names))
        outcomes = [row[2] for row in rows]
        self.assertGreater(outcomes.count("certified"), len(names) / 2)
        self.assertLessEqual(set(outcomes), {"certified", "undecided", "invalid"})
        for row in rows:
            self.assertIn("changes", json.loads(row[9]))
            if row[2] == "certified":
                self.assertEqual(row[3], row[4])
                self.assertEqual((row[5], row[6]), (1, 0))
        table = self.campaign("table")
        self.expect(table, 0)
        self.assertRegex(table.stdout, rf"\nall +{len(names)} ")

    def test_an_interrupted_campaign_goes_on(self):
        arguments = ["--count", "12", "--families", "boxes,gap,platonic", "--time-limit", "1",
                     "--commit", "abc"]
        process = subprocess.Popen(
            [sys.executable, "-B", FOLDER / "campaign.py", "run", "--store", "runs.db", "--tool",
             TOOL, "--verbose", *MEMORY, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, encoding="utf-8")
        for _ in range(3):
            process.stdout.readline()
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        before = self.runs("family, seed, model_hash")
        self.assertGreaterEqual(len(before), 3)
        self.assertLess(len(before), 12)
        self.expect(self.campaign("run", *arguments), 0)
        after = self.runs("family, seed, model_hash")
        self.assertEqual(after[:len(before)], before)
        self.assertEqual(sorted((f, s) for f, s, _ in after),
                         sorted((f, s) for f in ["boxes", "gap", "platonic"] for s in range(1, 5)))
        self.assertIn("0 runs in", self.campaign("run", *arguments).stdout)

    def test_defects_are_noticed(self):
        for what, outcome, reason in [
            ("wrong axis", "wrong", "Betti numbers of the axis"),
            ("wrong solid", "wrong", "Betti numbers of the solid"),
            ("not what it says", "wrong", "exit code 0, but certified: False"),
            ("wrong radius", "wrong", "axis: "),
            ("signal", "crash", "SIGSEGV"),
            ("internal error", "crash", "exit code 4"),
            ("hangs", "killed", "not ended"),
        ]:
            with self.subTest(what):
                wall = ["--grace", "1"] if what == "hangs" else []
                result = self.campaign("run", "--count", "1", "--families", "boxes", "--commit",
                                       what, "--time-limit", "1", "--check-axis", "1", *wall,
                                       tool=self.liar(what))
                self.expect(result, 3)
                found = self.runs("outcome, reason")[-1]
                self.assertEqual(found[0], outcome)
                self.assertTrue(found[1].startswith(reason), found)

    def test_models_from_files(self):
        cube = convex.prism(4, 1)
        models = self.folder / "models" / "deeper"
        models.mkdir(parents=True)
        (models / "cube.off").write_text("# a comment\n" + cube.off())
        (models / "twice.off").write_text("# a comment\n" + cube.off())
        (models / "inwards.obj").write_text(
            "".join("v %r %r %r\n" % p for p in cube.points) +
            "".join("f " + " ".join(f"{v + 1}/7/8" for v in f[::-1]) + "\n" for f in cube.faces))
        corners = [cube.points[v] for f in retriangulated(cube, random.Random(1)).faces for v in f]
        (models / "ascii.stl").write_text(
            "solid x\n" + "".join("vertex %r %r %r\n" % p for p in corners) + "endsolid x\n")
        (models / "binary.STL").write_bytes(
            bytes(80) + struct.pack("<I", len(corners) // 3) + b"".join(
                bytes(12) + b"".join(struct.pack("<3f", *p) for p in corners[i:i + 3]) + bytes(2)
                for i in range(0, len(corners), 3)))
        (models / "open.off").write_text(Mesh(cube.points, cube.faces[1:]).off())
        for name, content in [("cut.off", "OFF\n4 4 0\n0 0 0\n"), ("edge.off", "OFF\n2 1 0\n0 0 0\n"
                              "1 0 0\n2 0 1\n"), ("nan.obj", "v nan 0 0\nf 1 1 1\n"),
                              ("points.obj", "v 1 2 3\n"), ("words.stl", "solid"),
                              ("zeroth.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"),
                              ("short.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n"),
                              ("flat.off", "OFF\n3 1 0\n0 0\n1 0\n0 1\n3 0 1 2\n")]:
            (models / name).write_text(content)
        result = self.campaign("run", "--files", "models", "--verify", "1", "--time-limit", "5")
        self.expect(result, 0)
        self.assertEqual(result.stderr.count("no mesh of faces"), 8, result.stderr)
        solid = ("certified", "verified", "[1, 0, 0]")
        rows = {pathlib.Path(name).name: rest for name, *rest in
                self.runs("family, outcome, certificate, betti_expected, seed")}
        self.assertEqual(rows, {"open.off": ["invalid", None, None, 1], **{
            name: [*solid, 1] for name in ("cube.off", "inwards.obj", "ascii.stl", "binary.STL")}})
        self.expect(self.campaign("run", "--files", "models", "--count", "11", "--time-limit", "5"), 0)
        changed = self.runs("seed, parameters, outcome")[5:]
        self.assertEqual([seed for seed, _, _ in changed], [2] * 5 + [3])
        self.assertTrue(any(json.loads(p)["changes"] for _, p, _ in changed))
        self.assertLessEqual({outcome for _, _, outcome in changed}, {"certified", "invalid"})
        self.expect(self.campaign("replay", "1"), 0)
        again = self.campaign("run", "--again", "invalid", "--time-limit", "6")
        self.expect(again, 0)
        self.assertRegex(again.stdout, r"open.off 1: invalid")

    def test_names_that_there_are_not(self):
        (self.folder / "empty").mkdir()
        for arguments, message in ((["--files", "empty"], "no mesh files: empty"),
                                   (["--files", "missing"], "no mesh files: missing"),
                                   (["--families", "boxes,cubes"], "no such family: cubes")):
            result = self.campaign("run", *arguments, "--count", "3")
            self.expect(result, 1)
            self.assertEqual(result.stderr, message + "\n")

    def test_certificates(self):
        arguments = ["--count", "2", "--families", "boxes", "--verify", "1", "--time-limit", "5"]
        self.expect(self.campaign("run", *arguments), 0)
        self.assertEqual(self.runs("outcome, certificate"), [("certified", "verified")] * 2)
        self.assertIn(" 2 of 2 ", self.campaign("table").stdout)
        lines = self.campaign("table", "--certificates").stdout.splitlines()
        self.assertEqual(len(lines), 4)
        for line in lines[2:]:
            self.assertRegex(line, r"^\| boxes( 2)? \| \d+ \| .* s, .* MiB \| .* s, .* MiB \| .* MB \|$")

        liar = self.liar("refuses")
        result = self.campaign("run", *arguments, "--commit", "refuses", tool=liar)
        self.expect(result, 3)
        self.assertIn("certificate refused: a lie about cell #", result.stdout)
        refused = self.runs("id, outcome, certificate, statement, model")[-1]
        self.assertEqual(refused[1:4], ("certified", "refused", "a lie about cell #"))
        self.assertIsNotNone(refused[4], "the model of a defect is kept")
        # As it was recorded, so with the certificate.
        self.expect(self.campaign("replay", refused[0], tool=liar), 3)
        self.expect(self.campaign("replay", refused[0]), 0)
        shrunk = self.campaign("shrink", refused[0], "-o", "small.off", "--seconds", "2", tool=liar)
        self.expect(shrunk, 0)
        self.assertIn("certificate refused", shrunk.stdout)
        self.assertNotEqual(
            self.campaign("shrink", refused[0], "-o", "small.off").returncode, 0)

        for what, code, found in [
            ("certificate hangs", 3, ("killed", None, None)),
            ("certificate wrong", 3, ("wrong", None, None)),
            ("certificate of no solid", 3, ("crash", None, None)),
            ("certificate undecided", 0,
             ("certified", "incomplete", "undecided without cutting planes: cells")),
        ]:
            with self.subTest(what):
                result = self.campaign("run", "--count", "1", "--families", "boxes", "--verify",
                                       "1", "--time-limit", "1", "--grace", "2", "--commit", what,
                                       tool=self.liar(what))
                self.expect(result, code)
                self.assertEqual(self.runs("outcome, certificate, statement")[-1], found)

    def test_a_record_of_an_older_version(self):
        self.expect(self.campaign("run", "--count", "1", "--families", "boxes"), 0)
        base = sqlite3.connect(self.folder / "runs.db")
        with base:
            for column in ("certificate", "statement", "certificate_s", "verify_s",
                           "certificate_bytes"):
                base.execute(f"ALTER TABLE run DROP COLUMN {column}")
        base.close()
        self.expect(self.campaign("table"), 0)
        self.expect(self.campaign("run", "--count", "2", "--families", "boxes", "--verify", "1",
                                  "--commit", "new"), 0)
        self.assertEqual(self.runs("certificate"), [(None,), ("verified",), ("verified",)])

    def test_replay_and_shrink(self):
        liar = self.liar("wrong or not")
        self.expect(self.campaign("run", "--count", "1", "--families", "geodesic", "--commit",
                                  "c", tool=liar), 3)
        again = self.campaign("replay", "1", tool=liar)
        self.expect(again, 3)
        self.assertIn("Betti numbers of the axis", again.stdout)
        self.expect(self.campaign("replay", "1"), 0)
        self.expect(self.campaign("model", "1", "-o", "model.off"), 0)
        result = self.campaign("shrink", "1", "-o", "small.off", "--seconds", "2", tool=liar)
        self.expect(result, 0)
        large, small = ((self.folder / name).read_text() for name in ("model.off", "small.off"))
        self.assertLess(len(small), len(large))
        self.assertGreater(len(small), 400)  # what the liar lies about
        self.expect(self.blum("info", "small.off"), 0)


class Models(unittest.TestCase):
    """The generator's own mathematics, on solids whose answer is known."""

    def test_betti_numbers(self):
        rng = families.random.Random(1)
        cube = thin.box((0, 0, 0), (1, 1, 1))
        self.assertEqual(betti_numbers(cube), [1, 0, 0])
        self.assertEqual(betti_numbers(thin.nested(rng, 5, [0.25] * 5)), [3, 0, 2])
        self.assertEqual(betti_numbers(thin.join(cube, thin.moved(cube, (2, 0, 0)))), [2, 0, 0])
        # An inner shell without a hole around it, an outer one in nothing, an open one, a pinched one.
        self.assertIsNone(betti_numbers(thin.turned(cube)))
        inner = thin.moved(thin.box((0, 0, 0), (0.5, 0.5, 0.5)), (0.25, 0.25, 0.25))
        self.assertIsNone(betti_numbers(thin.join(cube, inner)))
        self.assertEqual(betti_numbers(thin.join(cube, thin.turned(inner))), [1, 0, 1])
        self.assertIsNone(betti_numbers(thin.Mesh(cube.points, cube.faces[1:])))
        for level, genus in ((1, 5), (2, 81)):
            n = 3**level
            sponge = of_pattern(lambda *c: families.menger_full(level, c), [n] * 3,
                                unit_planes([n] * 3), rng)
            self.assertEqual(betti_numbers(sponge), [1, genus, 0])

    def test_merging_and_triangulating_keep_the_solid(self):
        rng = families.random.Random(2)

        def volume_of(mesh):
            points = integers(mesh.points)
            return sum(volume((0, 0, 0), *t) for t in triangles(points, mesh.faces))

        for seed in range(1, 6):
            for name in ("boxes", "extrusion", "lattice", "fins"):
                mesh, _ = families.FAMILIES[name](families.random.Random(seed))
                for other in (merged(mesh, rng), retriangulated(mesh, rng),
                              retriangulated(merged(mesh, rng), rng)):
                    self.assertEqual(betti_numbers(other), betti_numbers(mesh))
                    self.assertEqual(volume_of(other), volume_of(mesh))
                    self.assertLessEqual(set(other.points), set(mesh.points))

    def test_hulls_have_the_known_number_of_vertices(self):
        expected = {"tetrahedron": 4, "cube": 8, "octahedron": 6, "icosahedron": 12,
                    "dodecahedron": 20, "truncated_tetrahedron": 12, "cuboctahedron": 12,
                    "truncated_cube": 24, "truncated_octahedron": 24, "rhombicuboctahedron": 24,
                    "truncated_cuboctahedron": 48, "snub_cube": 24, "icosidodecahedron": 30,
                    "truncated_dodecahedron": 60, "truncated_icosahedron": 60,
                    "rhombicosidodecahedron": 60, "truncated_icosidodecahedron": 120}
        for name, points in {**convex.PLATONIC, **convex.ARCHIMEDEAN}.items():
            mesh = convex.of_points(points(), families.random.Random(1))
            self.assertEqual(len(mesh.points), expected[name], name)
            self.assertEqual(betti_numbers(mesh), [1, 0, 0])

    def test_generating_is_a_function_of_family_and_seed(self):
        for name in families.FAMILIES:
            a, b = families.generate(name, 7), families.generate(name, 7)
            self.assertEqual((a[0].off(), a[1:]), (b[0].off(), b[1:]))


if __name__ == "__main__":
    main()
