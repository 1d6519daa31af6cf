"""SIGINT and SIGTERM end a run with 130 and 143, and nothing is written."""

import signal
import subprocess
import time

from tool import TOOL, ToolTest, main


def wait_until_caught(process, number, seconds=20):
    """Until the process has a handler of the signal: on a busy machine it takes a while to start."""
    end = time.monotonic() + seconds
    while time.monotonic() < end and process.poll() is None:
        with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
            caught = next(line for line in status if line.startswith("SigCgt:"))
        if int(caught.split()[1], 16) >> (number - 1) & 1:
            return
        time.sleep(0.02)


class Interruption(ToolTest):
    def expect_interruptible(self, *arguments):
        before = self.names()
        for number, code in [(signal.SIGINT, 130), (signal.SIGTERM, 143)]:
            with self.subTest(arguments=arguments, signal=number):
                with subprocess.Popen([TOOL, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                      stderr=subprocess.PIPE) as process:
                    wait_until_caught(process, number)
                    time.sleep(0.7)
                    self.assertIsNone(process.poll(), "the model is too small for this test")
                    process.send_signal(number)
                    start = time.monotonic()
                    _, errors = process.communicate(timeout=60)
                self.assertLess(time.monotonic() - start, 2)  # 1, but on a busy machine
                self.assertEqual(process.returncode, code, errors)
                self.assertEqual(errors, b"blum: interrupted\n")
                self.assertEqual(self.names(), before)

    def test_while_the_axis_is_computed(self):
        self.expect(self.blum("make", "knot", "2", "5", "300", "12", "2", "1", "0.25",
                              "-o", "knot.off"), 0)
        self.expect_interruptible("medial", "knot.off", "--summary", "summary.json")

    def test_while_a_mesh_is_validated(self):
        self.expect_interruptible("make", "torus", "1000", "500", "-o", "torus.off")


if __name__ == "__main__":
    main()
