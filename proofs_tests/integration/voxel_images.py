"""`blum field` of voxel images: against all pairs of voxels, in all ways that NRRD holds values."""

import base64
import gzip
import itertools
import json
import math
import random
import re
import struct
import unittest

from tool import ToolTest, main

NONE = 4294967295


def header(size, kind="unsigned char", encoding="raw", extra=""):
    return (f"NRRD0005\ntype: {kind}\ndimension: 3\nsizes: {size[0]} {size[1]} {size[2]}\n"
            f"endian: little\nencoding: {encoding}\n{extra}\n")


class VoxelImages(ToolTest):
    SIZE = (7, 5, 4)
    GEOMETRY = ("space dimension: 3\nspace directions: (0.3,0,0) (0,1.25,0) (0,0,2)\n"
                "space origin: (-1.5,0.1,7)\n")
    SPACING = (0.3, 1.25, 2)

    def setUp(self):
        super().setUp()
        result = self.blum("field", "none.nrrd", "-o", "x.npy")
        if "without Teem" in result.stderr:
            self.skipTest("built without Teem")

    def places(self, size):
        return [(i, j, k) for k, j, i in itertools.product(*map(range, reversed(size)))]

    def brute(self, size, spacing, features):
        """Nearest feature, the first of equal ones, and its distance."""
        places = self.places(size)
        sites, distances = [], []
        for p in places:
            squared = [sum(((a - b) * s) ** 2 for a, b, s in zip(p, places[f], spacing))
                       for f in features]
            least = min(squared)
            sites.append(features[squared.index(least)])
            distances.append(math.sqrt(least))
        return sites, distances

    def read_vti(self, name):
        text = (self.folder / name).read_text()
        out = {"origin": re.search('Origin="([^"]*)"', text).group(1),
               "spacing": re.search('Spacing="([^"]*)"', text).group(1)}
        for array, code in [("distance", "d"), ("site", "I")]:
            data = re.search(f'Name="{array}"[^>]*>\\s*([^<]*?)\\s*<', text).group(1)
            raw = base64.b64decode(data)[8:]
            out[array] = list(struct.unpack(f"<{len(raw) // struct.calcsize(code)}{code}", raw))
        return out

    def expect_field(self, model, size, spacing, features, *options):
        self.expect(self.blum("field", model, "-o", "out.vti", *options), 0)
        read = self.read_vti("out.vti")
        sites, distances = self.brute(size, spacing, features)
        for d, e in zip(read["distance"], distances, strict=True):
            self.assertAlmostEqual(d, e, delta=2 ** -48 * e)
        self.assertEqual(len(read["site"]), len(sites))
        places = self.places(size)
        for v, (site, expected) in enumerate(zip(read["site"], sites)):
            if site == expected:
                continue
            # Other roundings may see a tie otherwise: then both are as near.
            self.assertIn(site, features)
            d = math.dist([a * s for a, s in zip(places[v], spacing)],
                          [a * s for a, s in zip(places[site], spacing)])
            self.assertAlmostEqual(d, distances[v], delta=2 ** -48 * d)
        return read

    def image(self, seed, size, part):
        voxels = math.prod(size)
        features = sorted(random.Random(seed).sample(range(voxels), max(1, int(part * voxels))))
        chosen = set(features)
        return [int(v in chosen) for v in range(voxels)], features

    def test_values_of_all_kinds(self):
        values, features = self.image(1, self.SIZE, 0.05)
        labels = [v * (n % 90 + 1) for n, v in enumerate(values)]
        kinds = {
            "raw": ("unsigned char", "raw", bytes(labels)),
            "ascii": ("int", "ascii", " ".join(map(str, labels)).encode()),
            "gzip": ("float", "gzip", gzip.compress(struct.pack(f"<{len(labels)}f", *labels))),
            "short": ("short", "raw", struct.pack(f"<{len(labels)}h", *[-v for v in labels])),
        }
        for name, (kind, encoding, data) in kinds.items():
            with self.subTest(name):
                self.file(f"{name}.nrrd", header(self.SIZE, kind, encoding,
                                                 self.GEOMETRY).encode() + data)
                read = self.expect_field(f"{name}.nrrd", self.SIZE, self.SPACING, features)
                self.assertEqual(read["origin"], "-1.5 0.1 7")
                self.assertEqual(read["spacing"], "0.3 1.25 2")

    def test_a_header_for_the_values_of_another_file(self):
        """So that any array of numbers is read, .npy files too: their values are at the end."""
        values, features = self.image(2, self.SIZE, 0.1)
        self.file("mask.npy", b"\x93NUMPY\x01\x00 and what else is before them\n" + bytes(values))
        self.file("mask.nhdr", header(self.SIZE, extra="spacings: 1 1 3\nbyte skip: -1\n"
                                                       "data file: mask.npy\n"))
        read = self.expect_field("mask.nhdr", self.SIZE, (1, 1, 3), features)
        self.assertEqual(read["origin"], "0 0 0")

    def test_extreme_images(self):
        size = (6, 1, 5)
        for name, features in {"one": [17], "all": list(range(30)), "corners": [0, 29]}.items():
            with self.subTest(name):
                chosen = set(features)
                data = bytes(v in chosen for v in range(30))
                self.file("image.nrrd", header(size).encode() + data)
                self.expect_field("image.nrrd", size, (1, 1, 1), features)
        for shape in [(1, 1, 1), (40, 1, 1), (1, 1, 40)]:
            values, features = self.image(3, shape, 0.1)
            self.file("thin.nrrd", header(shape).encode() + bytes(values))
            self.expect_field("thin.nrrd", shape, (1, 1, 1), features)

    def test_an_image_without_features_is_refused(self):
        self.file("zero.nrrd", header((3, 3, 3)).encode() + bytes(27))
        result = self.blum("field", "zero.nrrd", "-o", "x.npy")
        self.expect(result, 2)
        self.assertIn("all voxels are 0", result.stderr)
        result = self.blum("field", "zero.nrrd", "--threshold", 1, "-o", "x.npy")
        self.expect(result, 2)
        self.assertIn("threshold", result.stderr)
        self.expect(self.blum("field", "zero.nrrd", "--threshold", 0, "-o", "x.npy"), 0)

    def test_what_field_wrote_is_read_back(self):
        """A field's .nrrd as a grey image: the voxels far from a box."""
        self.expect(self.blum("make", "cuboid", 1, 2, 3, "-o", "box.off"), 0)
        self.expect(self.blum("field", "box.off", "--resolution", "7,5,4", "--backend", "cpu",
                              "-o", "grey.nrrd"), 0)
        raw = (self.folder / "grey.nrrd").read_bytes()
        grey = struct.unpack("<140d", raw[-140 * 8:])
        text = raw[:-140 * 8].decode()
        directions = re.search(r"space directions: (.*)", text).group(1)
        spacing = [float(x) for x in re.findall(r"[-0-9.e]+", directions)]
        spacing = (spacing[0], spacing[4], spacing[8])
        origin = re.search(r"space origin: \((.*)\)", text).group(1).replace(",", " ")
        level = sorted(grey)[120]
        features = [v for v, d in enumerate(grey) if d >= level]
        read = self.expect_field("grey.nrrd", self.SIZE, spacing, features, "--threshold", level)
        self.assertEqual(read["origin"], origin)

    def test_a_band_leaves_what_is_beyond_without_a_site(self):
        values, features = self.image(4, self.SIZE, 0.02)
        self.file("image.nrrd", header(self.SIZE).encode() + bytes(values))
        self.expect(self.blum("field", "image.nrrd", "--band", 1.5, "-o", "band.vti"), 0)
        read = self.read_vti("band.vti")
        _, distances = self.brute(self.SIZE, (1, 1, 1), features)
        self.assertLess(max(d for d in read["distance"] if d < math.inf), 1.5)
        for d, site, expected in zip(read["distance"], read["site"], distances, strict=True):
            self.assertEqual(d, expected if expected <= 1.5 else math.inf)
            self.assertEqual(site == NONE, expected > 1.5)

    def test_threads_change_no_byte_and_slices_are_written(self):
        size = (33, 21, 17)
        values, _ = self.image(5, size, 0.01)
        self.file("image.nrrd", header(size).encode() + bytes(values))
        for name, threads in [("a", 1), ("b", 4)]:
            self.expect(self.blum("field", "image.nrrd", "--threads", threads, "-o", f"{name}.npy",
                                  "--slice", f"{name}.png"), 0)
        for end in ["npy", "png"]:
            self.assertEqual((self.folder / f"a.{end}").read_bytes(),
                             (self.folder / f"b.{end}").read_bytes())
        geometry = json.loads((self.folder / "a.npy.json").read_text())
        self.assertEqual(geometry["size"], list(size))

    def test_a_dry_run_needs_no_values(self):
        self.file("large.nrrd", header((400, 300, 200)))
        result = self.blum("field", "large.nrrd", "--dry-run")
        self.expect(result, 0)
        self.assertRegex(result.stdout, r"400 x 300 x 200[^$]*memory: +about \d+ MiB")
        self.file("larger.nrrd", header((1200, 1200, 1200)))
        result = self.blum("field", "larger.nrrd", "-o", "x.npy")
        if result.returncode == 2 and "free" in result.stderr:
            self.assertRegex(result.stderr, r"needs about \d+ MiB, \d+ MiB are free")

    def test_bad_images_are_refused_with_a_reason(self):
        good = header((3, 3, 3)).encode() + bytes(27)
        turned = "space dimension: 3\nspace directions: (0,1,0) (1,0,0) (0,0,1)\n"
        reversed_axis = "space dimension: 3\nspace directions: (-1,0,0) (0,1,0) (0,0,1)\n"
        nan = struct.pack("<27f", *[0] * 26, math.nan)
        for name, content, reason in [
                ("text", b"not an image", ""), ("empty", b"", ""), ("short", good[:-5], ""),
                ("turned", header((3, 3, 3), extra=turned).encode() + bytes(27), "resample"),
                ("reversed", header((3, 3, 3), extra=reversed_axis).encode() + bytes(27),
                 "resample"),
                ("flat", b"NRRD0005\ntype: uchar\ndimension: 2\nsizes: 3 3\nencoding: raw\n\n" +
                 bytes(9), "2 axes"),
                ("nan", header((3, 3, 3), "float").encode() + nan, "voxel 26"),
                ("spacing", header((3, 3, 3), extra="spacings: 1 -1 1\n").encode() + bytes(27),
                 "")]:
            with self.subTest(name):
                self.file(f"{name}.nrrd", content)
                result = self.blum("field", f"{name}.nrrd", "-o", "x.npy")
                self.expect(result, 2)
                self.assertIn(f"{name}.nrrd", result.stderr)
                self.assertIn(reason, result.stderr)
                self.assertFalse((self.folder / "x.npy").exists())
        self.expect(self.blum("field", "missing.nrrd", "-o", "x.npy"), 2)

    def test_options_of_surfaces_are_refused(self):
        self.file("image.nrrd", header((3, 3, 3)).encode() + bytes([1] * 27))
        for options in [["--resolution", 8], ["--box", "0,0,0,1,1,1"], ["--order", 2], ["--signed"],
                        ["--backend", "cpu"], ["--cull", "none"], ["--slice", "x.png",
                                                                  "--slice-index", 3]]:
            with self.subTest(options):
                self.expect(self.blum("field", "image.nrrd", "-o", "x.npy", *options), 1)
        self.expect(self.blum("field", "image.nrrd", "-o", "image.nrrd"), 1)
        self.expect(self.blum("field", "image.off", "--resolution", 8, "--threshold", 1,
                              "-o", "x.npy"), 1)


if __name__ == "__main__":
    main()
