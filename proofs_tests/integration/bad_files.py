"""Files that are no mesh: exit code 2, a stable code, the file named, nothing written."""

import json
import random
import struct

from tool import ToolTest, main

EXTENSIONS = ["off", "obj", "stl", "ply"]

TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def off(points=TETRAHEDRON, faces=FACES):
    return (f"OFF\n{len(points)} {len(faces)} 0\n"
            + "".join("%s %s %s\n" % p for p in points)
            + "".join("3 %s %s %s\n" % f for f in faces))


def obj(points=TETRAHEDRON, faces=FACES):
    return ("".join("v %s %s %s\n" % p for p in points)
            + "".join("f %s %s %s\n" % tuple(i + 1 for i in f) for f in faces))


def ply(points=TETRAHEDRON, faces=FACES):
    return (f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty double x\n"
            f"property double y\nproperty double z\nelement face {len(faces)}\n"
            "property list uchar int vertex_indices\nend_header\n"
            + "".join("%s %s %s\n" % p for p in points)
            + "".join("3 %s %s %s\n" % f for f in faces))


def ascii_stl(points=TETRAHEDRON, faces=FACES):
    text = "solid x\n"
    for face in faces:
        text += "facet normal 0 0 0\nouter loop\n"
        text += "".join("vertex %s %s %s\n" % points[i] for i in face)
        text += "endloop\nendfacet\n"
    return text + "endsolid x\n"


def binary_stl(points=TETRAHEDRON, faces=FACES):
    data = bytes(80) + struct.pack("<I", len(faces))
    for face in faces:
        data += struct.pack("<12fH", 0, 0, 0, *(x for i in face for x in points[i]), 0)
    return data


WRITERS = {"off": off, "obj": obj, "ply": ply, "stl": ascii_stl}


class BadFiles(ToolTest):
    def expect_refused(self, path, codes):
        """Every command refuses the file in the same way."""
        before = self.names()
        for arguments in [["info", path], ["info", path, "--json"],
                          ["medial", path, "-o", "result", "--summary", "result.json"]]:
            result = self.blum(*arguments)
            self.expect(result, 2)
            self.assertRegex(result.stderr, r"\Ablum: error: [a-z_]+: ")
            code = result.stderr.split(": ")[2]
            self.assertIn(code, codes, result.stderr)
            self.assertIn(str(path), result.stderr)
            self.assertEqual(self.names(), before)
            if "--json" in arguments:
                answer = json.loads(result.stdout)
                if "error" in answer:
                    self.assertEqual(answer["error"]["code"], code)
                    self.assertTrue(answer["error"]["message"])
                    self.assertIn("element", answer["error"])
                else:
                    self.assertFalse(answer["valid"])
                    self.assertTrue(answer["defects"])
            elif arguments[0] == "medial":
                self.assertEqual(result.stdout, "")

    def test_the_writers_here_are_right(self):
        for extension, writer in WRITERS.items():
            self.expect(self.blum("info", self.file("good." + extension, writer())), 0)
        self.expect(self.blum("info", self.file("good_binary.stl", binary_stl())), 0)

    def test_missing(self):
        for extension in EXTENSIONS:
            self.expect_refused(self.folder / ("missing." + extension), ["file_not_found"])

    def test_directory(self):
        for extension in EXTENSIONS:
            path = self.folder / ("folder." + extension)
            path.mkdir()
            self.expect_refused(path, ["not_a_regular_file"])

    def test_empty(self):
        for extension in EXTENSIONS + ["xyz", ""]:
            self.expect_refused(self.file("empty." + extension, ""), ["empty_file"])

    def test_ten_random_bytes(self):
        generator = random.Random(7)
        for extension in EXTENSIONS + ["xyz", ""]:
            for i in range(3):
                path = self.file(f"random_{i}.{extension}", generator.randbytes(10))
                self.expect_refused(path, ["unknown_format", "malformed_file", "truncated_file"])

    def test_headers_alone(self):
        for name, content in {"a.off": "OFF\n", "b.off": "OFF\n3", "a.ply": "ply\n",
                              "b.ply": "ply\nformat ascii 1.0\n", "a.stl": "solid x\n"}.items():
            self.expect_refused(self.file(name, content),
                                ["truncated_file", "malformed_file", "no_faces", "invalid_solid"])

    def test_no_faces(self):
        for extension, writer in WRITERS.items():
            path = self.file("no_faces." + extension, writer(faces=[]))
            self.expect_refused(path, ["no_faces", "invalid_solid"])
        self.expect_refused(self.file("no_faces_binary.stl", binary_stl(faces=[])),
                            ["no_faces", "invalid_solid"])

    def test_cut_off_at_every_tenth(self):
        contents = {"cut.off": off().encode(), "cut.ply": ply().encode(),
                    "cut.stl": ascii_stl().encode(), "cut_binary.stl": binary_stl()}
        for name, content in contents.items():
            for tenth in range(1, 10):
                with self.subTest(name=name, tenth=tenth):
                    path = self.file(name, content[:len(content) * tenth // 10])
                    self.expect_refused(path, ["truncated_file", "malformed_file", "no_faces",
                                               "unknown_format"])

    def test_an_obj_cut_off_bounds_no_solid(self):
        # The format has no counts: a file cut at a line's end is a whole file of fewer faces.
        text = obj()
        path = self.file("cut.obj", text[:text.rindex("f ")])
        self.expect_refused(path, ["invalid_solid"])

    def test_coordinates_that_are_no_numbers(self):
        for extension, writer in WRITERS.items():
            for value in ["nan", "NaN", "inf", "-inf"]:
                with self.subTest(extension=extension, value=value):
                    points = [(0, value, 0)] + TETRAHEDRON[1:]
                    path = self.file("bad." + extension, writer(points=points))
                    self.expect_refused(path, ["non_finite_coordinate"])
        points = [(0, float("nan"), 0)] + TETRAHEDRON[1:]
        self.expect_refused(self.file("binary.stl", binary_stl(points=points)),
                            ["non_finite_coordinate"])

    def test_coordinates_out_of_range(self):
        for extension, writer in WRITERS.items():
            for value in ["1e308", "-1e308", repr(2.0**201)]:
                with self.subTest(extension=extension, value=value):
                    points = [(0, value, 0)] + TETRAHEDRON[1:]
                    path = self.file("far." + extension, writer(points=points))
                    self.expect_refused(path, ["coordinate_out_of_range"])

    def test_garbage_for_a_number(self):
        for extension, writer in WRITERS.items():
            points = [(0, "1x", 0)] + TETRAHEDRON[1:]
            path = self.file("garbage." + extension, writer(points=points))
            self.expect_refused(path, ["malformed_file"])

    def test_indices_out_of_range(self):
        for extension, writer in [("off", off), ("obj", obj), ("ply", ply)]:
            for index in [4, 10**6, 2**31, 2**64, -3]:
                if extension == "obj" and index < 0:
                    continue  # counts from the end there
                with self.subTest(extension=extension, index=index):
                    faces = FACES[:3] + [(1, 2, index)]
                    path = self.file("index." + extension, writer(faces=faces))
                    self.expect_refused(path, ["index_out_of_range", "malformed_file"])
        self.expect_refused(self.file("zero.obj", obj(faces=FACES[:3] + [(1, 2, -1)])),
                            ["index_out_of_range"])

    def test_counts_too_large_for_the_file(self):
        for count in ["1000000000", "99999999999999999999", "-1"]:
            path = self.file("count.off", off().replace("4 4 0", f"{count} 4 0"))
            self.expect_refused(path, ["truncated_file", "malformed_file"])
        data = bytes(80) + struct.pack("<I", 2**32 - 1) + binary_stl()[84:]
        self.expect_refused(self.file("count.stl", data), ["truncated_file", "malformed_file",
                                                           "unknown_format"])


if __name__ == "__main__":
    main()
