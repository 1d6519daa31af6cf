"""`blum field`: files that kept readers read back, pictures, plans, and clear errors."""

import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import unittest
import zlib

from tool import SHARED_MODELS, TOOL, ToolTest, main


def python_with(*modules):
    """A Python that has the modules (Debian's has its packages), or None."""
    for program in ["python3", "/usr/bin/python3"]:
        path = shutil.which(program)
        imports = "import " + ", ".join(modules)
        if path and subprocess.run([path, "-c", imports], capture_output=True).returncode == 0:
            return path
    return None


def run_reader(modules, program, *arguments):
    python = python_with(*modules)
    if python is None:
        raise unittest.SkipTest("no Python with " + " and ".join(modules))
    return json.loads(subprocess.run([python, "-c", program, *map(str, arguments)], check=True,
                                     capture_output=True, encoding="utf-8", timeout=300).stdout)


READ_VTI = """
import json, sys
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
reader = vtkXMLImageDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
image = reader.GetOutput()
data = image.GetPointData()
array = lambda name: data.GetArray(name)
values = lambda name: [array(name).GetTuple1(i) for i in range(array(name).GetNumberOfTuples())]
print(json.dumps({"size": image.GetDimensions(), "origin": image.GetOrigin(),
                  "spacing": image.GetSpacing(), "distance": values("distance"),
                  "site": values("site"), "side": values("side") if array("side") else []}))
"""
READ_NRRD = """
import json, sys
from vtkmodules.vtkIOImage import vtkNrrdReader
reader = vtkNrrdReader()
reader.SetFileName(sys.argv[1])
reader.Update()
image = reader.GetOutput()
data = image.GetPointData().GetScalars()
print(json.dumps({"size": image.GetDimensions(), "origin": image.GetOrigin(),
                  "spacing": image.GetSpacing(), "type": image.GetScalarTypeAsString(),
                  "distance": [data.GetTuple1(i) for i in range(data.GetNumberOfTuples())]}))
"""
READ_NPY = """
import json, sys
import numpy
a = numpy.load(sys.argv[1])
print(json.dumps({"shape": a.shape, "type": str(a.dtype), "distance": a.flatten().tolist()}))
"""


class Field(ToolTest):
    def setUp(self):
        super().setUp()
        self.expect(self.blum("make", "cuboid", 1, 2, 3, "-o", "box.off"), 0)

    GRID = ["--resolution", "5,4,3", "--box", "-0.3,-1,-1,1.7,3,4"]
    ORIGIN = [-0.3 + 0.5 * (2.0 / 5), -1 + 0.5 * (4 / 4), -1 + 0.5 * (5 / 3)]
    SPACING = [(1.7 + 0.3) / 5, 1, 5 / 3]

    def distances(self):
        """Signed, by the formula for a box, x fastest."""
        out = []
        for k in range(3):
            for j in range(4):
                for i in range(5):
                    p = [o + n * s for o, n, s in zip(self.ORIGIN, (i, j, k), self.SPACING)]
                    beyond = [max(-x, x - e) for x, e in zip(p, (1, 2, 3))]
                    out.append(max(beyond) if max(beyond) <= 0 else
                               math.hypot(*[max(0, b) for b in beyond]))
        return out

    def expect_close(self, values, expected):
        self.assertEqual(len(values), len(expected))
        for a, b in zip(values, expected):
            self.assertAlmostEqual(a, b, delta=1e-12)

    def test_vti_survives_the_round_trip(self):
        self.expect(self.blum("field", "box.off", *self.GRID, "--backend", "cpu", "--signed",
                              "-o", "box.vti"), 0)
        read = run_reader(["vtkmodules.vtkIOXML"], READ_VTI, self.folder / "box.vti")
        self.assertEqual(read["size"], [5, 4, 3])
        self.assertEqual(read["origin"], self.ORIGIN)
        self.assertEqual(read["spacing"], self.SPACING)
        self.expect_close(read["distance"], self.distances())
        self.assertEqual(read["side"], [int(d < 0) for d in self.distances()])
        self.assertLess(max(read["site"]), 8 + 12 + 6)

    def test_nrrd_survives_the_round_trip(self):
        # VTK takes a first axis of less than ten for components: a grid larger along x.
        grid = ["--resolution", "20,4,3", "--box", "-1,-1,-1,4,3,5"]
        for name in ["box.nrrd", "box.vti"]:
            self.expect(self.blum("field", "box.off", *grid, "--backend", "cpu", "-o", name), 0)
        read = run_reader(["vtkmodules.vtkIOImage"], READ_NRRD, self.folder / "box.nrrd")
        self.assertEqual(read["size"], [20, 4, 3])
        self.assertEqual(read["origin"], [-0.875, -0.5, 0])
        self.assertEqual(read["spacing"], [0.25, 1, 2])
        self.assertEqual(read["type"], "double")
        vti = run_reader(["vtkmodules.vtkIOXML"], READ_VTI, self.folder / "box.vti")
        self.assertEqual(read["distance"], vti["distance"])

    def test_npy_survives_the_round_trip(self):
        self.expect(self.blum("field", "box.off", *self.GRID, "--backend", "cpu",
                              "-o", "box.npy"), 0)
        geometry = json.loads((self.folder / "box.npy.json").read_text())
        self.assertEqual(geometry, {"size": [5, 4, 3], "origin": self.ORIGIN,
                                    "spacing": self.SPACING, "order": 1})
        read = run_reader(["numpy"], READ_NPY, self.folder / "box.npy")
        self.assertEqual(read["shape"], [3, 4, 5])
        self.assertEqual(read["type"], "float64")
        self.expect_close(read["distance"], [abs(d) for d in self.distances()])

    def test_npy_and_nrrd_hold_the_same_bytes(self):
        """Without any reader: the raw values at the end of the files."""
        for name in ["box.npy", "box.nrrd"]:
            self.expect(self.blum("field", "box.off", *self.GRID, "--backend", "cpu",
                                  "-o", name), 0)
        count = 5 * 4 * 3
        npy, nrrd = [(self.folder / name).read_bytes()[-8 * count:]
                     for name in ["box.npy", "box.nrrd"]]
        self.assertEqual(npy, nrrd)
        self.expect_close(struct.unpack(f"<{count}d", npy), [abs(d) for d in self.distances()])

    def test_files_do_not_depend_on_threads_or_backend(self):
        for name, options in [("a", ["--threads", "1"]), ("b", ["--threads", "5"])]:
            self.expect(self.blum("field", "box.off", "--resolution", 24, "--backend", "cpu",
                                  "--signed", *options, "-o", name + ".vti"), 0)
        self.assertEqual((self.folder / "a.vti").read_bytes(), (self.folder / "b.vti").read_bytes())
        self.expect(self.blum("field", "box.off", *self.GRID, "--backend", "brute",
                              "-o", "c.npy"), 0)
        values = struct.unpack("<60d", (self.folder / "c.npy").read_bytes()[-480:])
        self.expect_close(values, [abs(d) for d in self.distances()])

    def test_vdb_survives_the_round_trip(self):
        reader = os.environ.get("BLUM_READ_VDB")
        if not reader:
            result = self.blum("field", "box.off", *self.GRID, "-o", "box.vdb")
            self.expect(result, 1)
            self.assertIn("OpenVDB", result.stderr)
            self.skipTest("built without OpenVDB")
        self.expect(self.blum("field", "box.off", *self.GRID, "--backend", "cpu", "--signed",
                              "-o", "box.vdb"), 0)
        read = json.loads(subprocess.run([reader, self.folder / "box.vdb"], check=True,
                                         capture_output=True, encoding="utf-8").stdout)
        self.expect_close(read["origin"], self.ORIGIN)
        self.expect_close(read["spacing"], self.SPACING)
        values = {(k, j, i): d for i, j, k, d, site in read["values"]}
        self.assertEqual(len(values), 5 * 4 * 3)
        self.expect_close([d for _, d in sorted(values.items())], self.distances())
        self.assertLess(max(site for *_, site in read["values"]), 8 + 12 + 6)
        self.expect(self.blum("field", "box.off", *self.GRID, "--backend", "cpu", "--band", 0.5,
                              "-o", "b.vdb"), 0)
        read = json.loads(subprocess.run([reader, self.folder / "b.vdb"], check=True,
                                         capture_output=True, encoding="utf-8").stdout)
        self.assertEqual(len(read["values"]), sum(abs(d) <= 0.5 for d in self.distances()))
        self.assertEqual(read["inactive_inside"], 0)
        self.expect(self.blum("field", "box.off", *self.GRID, "--backend", "cpu", "--band", 0.25,
                              "--signed", "-o", "b.vdb"), 0)
        read = json.loads(subprocess.run([reader, self.folder / "b.vdb"], check=True,
                                         capture_output=True, encoding="utf-8").stdout)
        self.assertEqual(len(read["values"]), sum(abs(d) <= 0.25 for d in self.distances()))
        # Beyond the band the side is still told.
        inside = sum(d < -0.25 for d in self.distances())
        self.assertGreater(inside, 0)
        self.assertEqual(read["inactive_inside"], inside)

    def test_vdb_without_its_plugin_is_refused_before_anything_is_done(self):
        if not os.environ.get("BLUM_READ_VDB"):
            self.skipTest("built without OpenVDB")
        alone = self.folder / "alone"
        alone.mkdir()
        shutil.copy(TOOL, alone / "blum")

        def run(output):
            return subprocess.run([alone / "blum", "field", "box.off", *map(str, self.GRID),
                                   "--backend", "cpu", "-o", output], cwd=self.folder,
                                  capture_output=True, encoding="utf-8", timeout=60)

        result = run("box.vdb")
        self.expect(result, 1)
        self.assertIn("--output: cannot load the part for OpenVDB: ", result.stderr)
        self.assertIn("blum-vdb.so", result.stderr)
        self.assertEqual(self.names(), ["alone", "box.off"])
        (alone / "blum-vdb.so").write_text("not a library")
        self.expect(run("box.vdb"), 1)
        self.assertEqual(self.names(), ["alone", "box.off"])
        # All else works without.
        self.expect(run("box.npy"), 0)
        shutil.copy(pathlib.Path(TOOL).parent / "blum-vdb.so", alone)
        self.expect(run("box.vdb"), 0)
        self.assertIn("box.vdb", self.names())

    def test_opengl_backends_are_within_their_regret(self):
        ways = [["--method", "fragments"], ["--method", "gather"], ["--method", "havoc"],
                ["--method", "difi", "--cull", "domains,sweep,clamp"],
                ["--method", "fragments", "--cull", "ranges"]]
        for backend in ["egl", "osmesa"]:
            for way in ways:
                with self.subTest(backend=backend, way=way):
                    result = self.blum("field", "box.off", *self.GRID, "--signed",
                                       "--backend", backend, *way, "-o", "gl.npy")
                    if re.search("no OpenGL|gather needs", result.stderr):
                        self.skipTest(result.stderr.strip())
                    self.expect(result, 0)
                    self.assertRegex(result.stdout, rf"backend: +{backend} \(.*{way[1]}\)")
                    regret = float(re.search(r"regret: +at most (\S+)", result.stdout)[1])
                    values = struct.unpack("<60d", (self.folder / "gl.npy").read_bytes()[-480:])
                    for d, expected in zip(values, self.distances()):
                        self.assertLessEqual(abs(expected) - 1e-12, abs(d))
                        self.assertLessEqual(abs(d), abs(expected) + regret + 1e-12)
        result = self.blum("field", "box.off", "--resolution", 4, "--dry-run")
        self.assertRegex(result.stdout, r"backend: +(cpu|egl) \(auto: .+\)")

    def test_auto_leaves_signs_to_the_cpu(self):
        result = self.blum("field", "box.off", "--resolution", 4, "--signed", "--dry-run")
        self.expect(result, 0)
        self.assertRegex(result.stdout, r"backend: +cpu \(auto: .+\)")

    def test_a_missing_driver_is_an_error_in_a_dry_run_too(self):
        for backend in ["egl", "osmesa"]:
            with self.subTest(backend):
                result = self.blum("field", "box.off", "--resolution", 4, "--backend", backend,
                                   "--dry-run")
                if result.returncode == 0:
                    self.assertRegex(result.stdout, rf"backend: +{backend} \(.*OpenGL \d")
                else:
                    self.expect(result, 1)
                    self.assertRegex(result.stderr, "no OpenGL")
                    self.assertNotIn("backend:", result.stdout)

    def test_order_and_band_show_in_the_shape(self):
        self.expect(self.blum("field", "box.off", *self.GRID, "--order", 2, "--band", 0.8,
                              "-o", "two.npy"), 0)
        values = struct.unpack("<120d", (self.folder / "two.npy").read_bytes()[-960:])
        for nearest, second, d in zip(values[::2], values[1::2], self.distances()):
            self.assertLessEqual(nearest, second)
            self.assertAlmostEqual(nearest, abs(d) if abs(d) <= 0.8 else math.inf, delta=1e-12)

    def test_a_slice_is_a_picture_of_its_voxels(self):
        self.expect(self.blum("field", "box.off", "--resolution", "30,40,50", "--signed",
                              "--slice", "box.png", "--slice-axis", "x", "--slice-index", 3), 0)
        self.assertEqual(self.names(), ["box.off", "box.png"])
        png = (self.folder / "box.png").read_bytes()
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", png[16:24]), (40, 50))
        length = struct.unpack(">I", png[png.index(b"IDAT") - 4:png.index(b"IDAT")])[0]
        start = png.index(b"IDAT") + 4
        self.assertEqual(len(zlib.decompress(png[start:start + length])), 50 * (1 + 3 * 40))

    def test_a_dry_run_says_what_it_would_take_and_writes_nothing(self):
        result = self.blum("field", "box.off", "--resolution", 200, "--backend", "cpu", "--dry-run",
                           "-o", "x.vti")
        self.expect(result, 0)
        for word in ["sites:", "grid:", "200", "backend:", "cpu", "memory:", "MiB"]:
            self.assertIn(word, result.stdout)
        self.assertEqual(self.names(), ["box.off"])

    def test_a_grid_too_large_for_memory_is_refused_with_one_that_fits(self):
        result = self.blum("field", "box.off", "--resolution", "100000,100000,100000",
                           "--backend", "cpu", "-o", "x.vti")
        self.expect(result, 2)
        self.assertRegex(result.stderr, r"needs about \d+ MiB.*--resolution \d+,\d+,\d+ would fit")
        self.assertEqual(self.names(), ["box.off"])

    def test_open_surfaces_have_a_field_but_no_sign(self):
        self.file("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.expect(self.blum("field", "open.off", "--resolution", 8, "-o", "x.npy"), 0)
        result = self.blum("field", "open.off", "--resolution", 8, "--signed", "-o", "y.npy")
        self.expect(result, 2)
        self.assertIn("boundary_edge", result.stderr)
        self.assertEqual(self.names(), ["box.off", "open.off", "x.npy", "x.npy.json"])

    def test_points_alone_have_a_field(self):
        points = [(0, 0, 0), (1, 2, 3), (0.5, 0.25, 2), (1, 0, 1)]
        lines = ["%r %r %r" % p for p in points]
        self.file("p.off", "OFF\n4 0 0\n" + "\n".join(lines) + "\n")
        self.file("p.obj", "".join(f"v {line}\n" for line in lines))
        self.file("p.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\n"
                           "property double y\nproperty double z\nend_header\n" +
                           "\n".join(lines) + "\n")
        expected = [min(math.dist(p, [o + n * s for o, n, s in zip(self.ORIGIN, at, self.SPACING)])
                        for p in points)
                    for at in [(i, j, k) for k in range(3) for j in range(4) for i in range(5)]]
        for kind in ["off", "obj", "ply"]:
            with self.subTest(kind):
                self.expect(self.blum("field", f"p.{kind}", *self.GRID, "--backend", "cpu",
                                      "-o", f"{kind}.npy"), 0)
                raw = (self.folder / f"{kind}.npy").read_bytes()[-8 * 60:]
                self.expect_close(list(struct.unpack("<60d", raw)), expected)
        self.expect(self.blum("field", "p.ply", *self.GRID, "--signed", "-o", "x.npy"), 2)
        self.file("l.obj", "v 0 0 0\nv 1 1 1\nl 1 2\n")
        self.expect(self.blum("field", "l.obj", *self.GRID, "-o", "x.npy"), 2)

    def test_wrong_command_lines_exit_with_1(self):
        for arguments in [["box.off"], ["box.off", "--resolution", "8"],
                          ["box.off", "--resolution", "0", "-o", "x.vti"],
                          ["box.off", "--resolution", "8,8", "-o", "x.vti"],
                          ["box.off", "--resolution", "-8", "-o", "x.vti"],
                          ["box.off", "--resolution", "8", "-o", "x.txt"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--band", "-1"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--band", "nan"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--order", "0"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--order", "2",
                           "--signed"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--backend", "gpu"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--backend", "cpu",
                           "--cull", "sweep"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--cull", "all"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--cull",
                           "none,domains"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--backend", "cpu",
                           "--method", "difi"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--backend", "brute",
                           "--mesh-error", "0.5"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--signed",
                           "--method", "fragments"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--backend", "egl",
                           "--method", "havoc", "--mesh-error", "1e-40"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--backend", "egl",
                           "--method", "havoc", "--mesh-error", "inf"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--backend", "egl",
                           "--method", "havoc", "--mesh-error", "nan"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--backend", "egl",
                           "--cull", "clamp"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--backend", "egl",
                           "--order", "2"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--box", "0,0,0,1,1"],
                          ["box.off", "--resolution", "8", "-o", "x.vti", "--box", "0,0,0,1,1,0"],
                          ["box.off", "--resolution", "8", "--slice", "x.png", "--slice-index",
                           "8"]]:
            with self.subTest(arguments):
                self.expect(self.blum("field", *arguments), 1)
                self.assertEqual(self.names(), ["box.off"])
        self.expect(self.blum("field", "missing.off", "--resolution", 8, "-o", "x.vti"), 2)
        self.expect(self.blum("field", "box.off", "--resolution", 8, "-o", "no/x.vti"), 5)

    def test_dirty_models_have_fields(self):
        if not SHARED_MODELS.is_dir():
            self.skipTest("no shared models")
        for name in ["dirty_elephant_with_holes", "dirty_capsule_degenerate"]:
            with self.subTest(name):
                self.expect(self.blum("field", SHARED_MODELS / f"{name}.off", "--resolution", 24,
                                      "-o", "x.npy"), 0)


if __name__ == "__main__":
    main()
