"""Certificates as a user meets them: written, summarised, verified, refused."""

import json
import re

from tool import ToolTest, main


class Certificates(ToolTest):
    def certify(self, shape, *options, code=0):
        self.expect(self.blum("make", *shape, "-o", "m.off"), 0)
        self.expect(self.blum("medial", "m.off", "-o", "x", "--certificate", "m.cert", *options),
                    code)
        self.assertNotIn("m.cert.unfinished", self.names())

    def test_written_and_verified(self):
        for shape in (["lbracket", "--rotate", "7", "--triangulate", "3"], ["voids", "2"],
                      ["plate", "2"], ["torus", "8", "4", "--shuffle", "5"]):
            with self.subTest(shape=shape):
                self.certify(shape)
                result = self.blum("verify", "m.off", "m.cert")
                self.expect(result, 0)
                self.assertIn("verified\n", result.stdout)
                summary = self.blum("certificate", "m.cert")
                self.expect(summary, 0)
                self.assertIn("Betti numbers", summary.stdout)

    def test_memory_is_its_own(self):
        held = bytearray(400 << 20)  # by the process that starts the tool
        held[::4096] = b"x" * len(held[::4096])
        self.certify(["lbracket"], "--summary", "x.json")
        summary = json.loads((self.folder / "x.json").read_text())
        result = self.blum("verify", "m.off", "m.cert")
        self.expect(result, 0)
        said = re.search(r"^needed +[.0-9]+ s, ([.0-9]+) MB at most$", result.stdout, re.MULTILINE)
        for megabytes in (summary["peak_memory_bytes"] / 1e6, float(said.group(1))):
            self.assertGreater(megabytes, 1)
            self.assertLess(megabytes, len(held) / 1e6)

    def test_collapses_are_replayed(self):
        # The second has faces that are decided again with other candidates: their arcs come in another
        # order than in the complex.
        for shape, options in ((["lbracket"], []), (["cuboid", "1", "2", "3"], ["--epsilon", "0.1"])):
            with self.subTest(shape=shape):
                self.certify(shape, "--theta", "120", *options)
                result = self.blum("verify", "m.off", "m.cert")
                self.expect(result, 0)
                self.assertRegex(result.stdout, r"pruned +by 120 degrees: [1-9]\d* collapses")
                summary = self.blum("certificate", "m.cert")
                self.expect(summary, 0)
                self.assertRegex(summary.stdout, r"pruned +by 120 degrees: [1-9]\d* collapses")

    def test_collapse_left_out_is_false(self):
        self.certify(["lbracket"], "--theta", "120")
        lines = (self.folder / "m.cert").read_text().splitlines(keepends=True)
        dropped = next(i for i, line in enumerate(lines) if line.startswith('{"collapse"'))
        self.file("less.cert", "".join(lines[:dropped] + lines[dropped + 1:]))
        result = self.blum("verify", "m.off", "less.cert")
        self.expect(result, 4)
        self.assertIn("FALSE           pruning: ", result.stdout)

    def test_a_simplified_axis_that_may_be_torn_has_no_certificate(self):
        self.expect(self.blum("make", "lbracket", "-o", "m.off"), 0)
        result = self.blum("medial", "m.off", "--theta", "60", "--simplify", "sma", "--certificate",
                           "m.cert")
        self.expect(result, 1)
        self.assertIn("--simplify sma: keeps no homotopy type", result.stderr)
        self.assertNotIn("m.cert", self.names())

    def test_another_version_is_unreadable(self):
        self.certify(["cuboid"])
        text = (self.folder / "m.cert").read_text()
        for version, code in ((1, 2), (2, 0), (3, 0), (4, 0), (5, 2)):
            self.file("other.cert", text.replace('"version":4', f'"version":{version}'))
            result = self.blum("verify", "m.off", "other.cert")
            self.expect(result, code)
            if code != 0:
                self.assertIn(f"version {version} of the format; this program reads 2 to 4",
                              result.stderr)

    def test_other_model_is_false(self):
        self.certify(["cuboid"])
        self.expect(self.blum("make", "lbracket", "-o", "other.off"), 0)
        result = self.blum("verify", "other.off", "m.cert")
        self.expect(result, 4)
        self.assertIn("FALSE           the certificate is of another model", result.stdout)

    def test_cut_short_is_unreadable(self):
        self.certify(["cuboid"])
        lines = (self.folder / "m.cert").read_text().splitlines(keepends=True)
        for kept in (0, 1, len(lines) - 1):
            self.file("short.cert", "".join(lines[:kept]))
            for command in (["verify", "m.off", "short.cert"], ["certificate", "short.cert"]):
                result = self.blum(*command)
                self.expect(result, 2)
                self.assertEqual(result.stdout, "")

    def test_missing_file_and_no_certificate(self):
        self.certify(["cuboid"])
        for name in ("none.cert", "m.off"):
            self.expect(self.blum("verify", "m.off", name), 2)
            self.expect(self.blum("certificate", name), 2)

    def test_not_certified_is_false_and_says_what_is_missing(self):
        self.certify(["torus", "8", "4"], "--max-depth", "1", code=3)
        result = self.blum("verify", "m.off", "m.cert")
        self.expect(result, 4)
        self.assertIn("leaf 0 is undecided (depth)", result.stdout)
        summary = self.blum("certificate", "m.cert")
        self.expect(summary, 0)
        self.assertIn("missing         leaves undecided: 2 depth", summary.stdout)


if __name__ == "__main__":
    main()
