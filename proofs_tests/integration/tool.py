"""Runs the built `blum` in a scratch folder. Python's standard library alone."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

TOOL = os.environ["BLUM_TOOL"]
SOURCE = pathlib.Path(os.environ["BLUM_SOURCE_DIR"])
BUILD = pathlib.Path(os.environ["BLUM_BUILD_DIR"])
SHARED_MODELS = SOURCE.parent / "shared" / "models"
SEEDS = os.environ.get("BLUM_SEEDS", "1").split()
SKIPPED = 77
# Those the tool is built with: "address,undefined" or "thread".
SANITIZERS = "".join(re.findall(r"-fsanitize=(\S+)", os.environ.get("BLUM_CXX_FLAGS", "")))


class ToolTest(unittest.TestCase):
    """Each test gets an empty folder of its own, which is the tool's working directory."""

    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="blum-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def blum(self, *arguments, **options):
        return subprocess.run([TOOL, *map(str, arguments)], cwd=self.folder, capture_output=True,
                              encoding="utf-8", errors="replace", timeout=600, **options)

    def file(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def expect(self, result, code):
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)

    def expect_certified(self, model):
        """With every seed of BLUM_SEEDS."""
        for seed in SEEDS:
            with self.subTest(seed=seed):
                result = self.blum("medial", model, "-o", "x", "--summary", "x.json",
                                   "--seed", seed)
                self.expect(result, 0)
                summary = json.loads((self.folder / "x.json").read_text())
                self.assertIs(summary["result"]["certified"], True)
                self.assertEqual(summary["result"]["betti"], summary["solid"]["betti"])


def main():
    program = unittest.main(module="__main__", exit=False, verbosity=2)
    result = program.result
    if not result.wasSuccessful():
        sys.exit(1)
    sys.exit(SKIPPED if result.testsRun == len(result.skipped) else 0)
