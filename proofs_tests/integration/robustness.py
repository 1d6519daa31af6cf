"""Full disks, folders that cannot be written, interrupts at any moment, one name for two outputs:
under every final name there is the old file or the whole new one, and no temporary file stays."""

import os
import random
import resource
import signal
import stat
import subprocess
import time
import unittest

from tool import SANITIZERS, TOOL, ToolTest, main

MEDIAL = ["medial", "box.off", "-o", "x", "--summary", "x.json", "--threads", "1"]
WRITTEN = ["x.json", "x.ma", "x.obj", "x.vtp"]
NOBODY = 65534


class Robustness(ToolTest):
    def setUp(self):
        super().setUp()
        self.expect(self.blum("make", "cuboid", "1", "2", "3", "-o", "box.off"), 0)

    def contents(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}

    def expect_not_written(self, result, message):
        self.expect(result, 5)
        self.assertRegex(result.stderr, r"\Ablum: error: output_not_written: .*" + message)

    def expect_usage_error(self, message, *arguments):
        before = self.contents()
        result = self.blum(*arguments)
        self.expect(result, 1)
        self.assertIn(message, result.stderr)
        self.assertEqual(self.contents(), before)

    # ---- a full disk, played by a limit on the size of files

    def limited(self, size, *arguments, **options):
        if size == 0 and SANITIZERS == "thread":
            self.skipTest("ThreadSanitizer itself writes a file when it starts")

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        return self.blum(*arguments, preexec_fn=limit, **options)

    def test_no_room_for_one_of_the_files(self):
        self.expect(self.blum(*MEDIAL, "--epsilon", "0.2"), 0)
        largest = max((self.folder / name).stat().st_size for name in WRITTEN)
        for name in WRITTEN:
            (self.folder / name).write_text("old " + name)
        before = self.contents()
        sizes = sorted({0, 1, 100, largest // 8, largest // 4, largest // 2, largest - 1})
        for size in sizes:
            with self.subTest(size=size):
                result = self.limited(size, *MEDIAL, "--epsilon", "0.2")
                self.expect_not_written(result, "File too large")
                self.assertEqual(self.contents(), before)
        self.expect(self.limited(largest, *MEDIAL, "--epsilon", "0.2"), 0)

    def test_no_room_for_what_is_undecided(self):
        before = self.contents()
        result = self.limited(1000, *MEDIAL, "--max-depth", "0")
        self.expect_not_written(result, "File too large")
        self.assertEqual(self.contents(), before)

    def test_no_room_for_a_shape(self):
        before = self.contents()
        for name in ["new.off", "box.off"]:
            for size in [0, 10, len(before["box.off"]) - 1]:
                with self.subTest(name=name, size=size):
                    result = self.limited(size, "make", "cuboid", "1", "2", "3", "-o", name)
                    self.expect_not_written(result, "File too large")
                    self.assertEqual(self.contents(), before)

    def test_no_room_for_standard_output(self):
        # A file on standard output is cut off: that cannot be helped, but it is said.
        for arguments, code in [(["info", "box.off"], 5), (["info", "box.off", "--json"], 5),
                                (["make", "cuboid", "-o", "other.off"], 5),
                                (["medial", "box.off", "--max-depth", "0"], 5)]:
            with self.subTest(arguments), open("/dev/full", "w") as full:
                result = subprocess.run([TOOL, *arguments], cwd=self.folder, stdout=full,
                                        stderr=subprocess.PIPE, timeout=60)
                self.assertEqual(result.returncode, code)
                self.assertIn(b"output_not_written: standard output", result.stderr)

    # ---- folders and names

    def test_a_folder_without_permission(self):
        locked = self.folder / "locked"
        locked.mkdir()
        (locked / "x.ma").write_text("old")
        locked.chmod(0o555)
        self.folder.chmod(0o755)
        options = {}
        if os.geteuid() == 0:  # root may write everywhere
            options["user"] = NOBODY
            if self.blum("--version", **options).returncode != 0:
                raise unittest.SkipTest("the tool cannot be run by another user")
        elif os.access(locked, os.W_OK):
            raise unittest.SkipTest("permissions do not count here")
        for arguments in [["medial", "box.off", "-o", "locked/x"],
                          ["medial", "box.off", "-o", "/tmp/never-written", "--summary",
                           "locked/x.json"],
                          ["make", "cuboid", "-o", "locked/new.off"]]:
            with self.subTest(arguments):
                result = self.blum(*arguments, **options)
                self.expect_not_written(result, "(not writable|Permission denied)")
                self.assertEqual(sorted(p.name for p in locked.iterdir()), ["x.ma"])
                self.assertEqual((locked / "x.ma").read_text(), "old")
        locked.chmod(0o755)

    def test_pipes_and_devices_are_not_replaced(self):
        pipe = self.folder / "x.ma"
        os.mkfifo(pipe)
        for arguments in [MEDIAL, ["make", "cuboid", "-o", "x.ma"],
                          ["medial", "box.off", "-o", "y", "--summary", "x.ma"]]:
            with self.subTest(arguments):
                self.expect_not_written(self.blum(*arguments), "not a regular file")
                self.assertTrue(stat.S_ISFIFO(pipe.stat().st_mode))
                self.assertEqual(self.names(), ["box.off", "x.ma"])

    def test_one_file_for_two_outputs(self):
        (self.folder / "folder").mkdir()
        (self.folder / "link").symlink_to("folder")
        two = "two outputs would go to one file"
        for arguments in [
            ["-o", "x", "--summary", "x.ma"],
            ["-o", "x", "--summary", "./x.vtp"],
            ["-o", "x", "--summary", "folder/../x.obj"],
            ["-o", "x", "--summary", "x.undecided.vtp"],
            ["-o", "folder/x", "--summary", "link/x.ma"],
            ["-o", "x", "--summary", str(self.folder / "x.ma")],
            ["-o", "x", "--coplanar-tolerance", "1e-6", "--summary", "s", "--write-flattened",
             "./s"],
            ["-o", "x", "--coplanar-tolerance", "1e-6", "--write-flattened", "x.obj"],
        ]:
            with self.subTest(arguments):
                self.expect_usage_error(two, "medial", "box.off", *arguments)

    def test_the_model_is_no_output(self):
        (self.folder / "same.off").symlink_to("box.off")
        (self.folder / "x.undecided.vtp").write_bytes((self.folder / "box.off").read_bytes())
        for arguments in [["box.off", "--summary", "box.off"],
                          ["box.off", "--summary", "./box.off"],
                          ["same.off", "--summary", "box.off"],
                          ["x.undecided.vtp", "-o", "x"],
                          ["box.off", "--coplanar-tolerance", "1e-6", "--write-flattened",
                           "box.off"]]:
            with self.subTest(arguments):
                self.expect_usage_error("the model would be overwritten", "medial", *arguments)

    # ---- interrupts

    def test_interrupts_at_any_moment(self):
        arguments = [*MEDIAL, "--epsilon", "0.08"]
        start = time.monotonic()
        self.expect(self.blum(*arguments), 0)
        duration = time.monotonic() - start
        whole = {name: size for name, size in
                 ((path.name, path.stat().st_size) for path in self.folder.iterdir())
                 if name.startswith("x.") and name != "x.json"}
        rng = random.Random(1)
        codes = []
        for _ in range(12):
            for path in self.folder.glob("x.*"):
                path.unlink()
            number = rng.choice([signal.SIGINT, signal.SIGTERM])
            with subprocess.Popen([TOOL, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE) as process:
                # Most near the end, where files are written.
                time.sleep(duration * rng.choice([rng.uniform(0.05, 1), rng.uniform(0.8, 1.1)]))
                process.send_signal(number)
                _, errors = process.communicate(timeout=60)
            codes.append(process.returncode)
            if process.returncode == 0:  # it was about to end, or was writing
                sizes = {name: (self.folder / name).stat().st_size for name in whole}
                self.assertEqual(sizes, whole)
                self.assertEqual(self.names(), ["box.off", *WRITTEN])
            else:
                # Before its handler stands, the system's own takes the signal.
                self.assertIn(process.returncode, (128 + number, -number), errors)
                if process.returncode > 0:
                    self.assertEqual(errors, b"blum: interrupted\n")
                self.assertEqual(self.names(), ["box.off"])
        self.assertTrue(any(code > 0 for code in codes), codes)

    def test_interrupts_when_the_files_stand(self):
        for _ in range(10):
            for path in self.folder.glob("x.*"):
                path.unlink()
            with subprocess.Popen([TOOL, *MEDIAL], cwd=self.folder, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE) as process:
                while self.names() != ["box.off", *WRITTEN] and process.poll() is None:
                    pass
                process.send_signal(signal.SIGTERM)
                _, errors = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 0, errors)
            self.assertEqual(self.names(), ["box.off", *WRITTEN])


if __name__ == "__main__":
    main()
