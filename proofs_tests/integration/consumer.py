"""The installed package works from outside: find_package(blum) in a project of its own."""

import os
import subprocess

from tool import BUILD, SOURCE, ToolTest, main


class Consumer(ToolTest):
    def command(self, *arguments):
        result = subprocess.run([str(a) for a in arguments], cwd=self.folder, encoding="utf-8",
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600)
        self.assertEqual(result.returncode, 0, result.stdout)
        return result.stdout

    def test_find_package_from_outside(self):
        prefix, build = self.folder / "prefix", self.folder / "build"
        self.command("cmake", "--install", BUILD, "--prefix", prefix)
        self.command("cmake", "-G", "Ninja", "-S", SOURCE / "proofs_tests" / "consumer",
                     "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release",
                     "-DCMAKE_CXX_COMPILER=" + os.environ["BLUM_CXX"],
                     "-DCMAKE_CXX_FLAGS=" + os.environ["BLUM_CXX_FLAGS"])
        self.command("cmake", "--build", build)
        self.assertIn("certified 1, Betti numbers 1 0 0", self.command(build / "consumer"))
        self.assertIn("blum", self.command(prefix / "bin" / "blum", "--version"))
        if os.environ.get("BLUM_READ_VDB"):  # its plug-in is installed where it looks for it
            self.command(prefix / "bin" / "blum", "make", "cuboid", "-o", "box.off")
            self.command(prefix / "bin" / "blum", "field", "box.off", "--resolution", 4,
                         "--backend", "cpu", "-o", "box.vdb")
            self.assertTrue((self.folder / "box.vdb").stat().st_size > 0)

    def test_every_public_header_compiles_alone(self):
        prefix = self.folder / "prefix"
        self.command("cmake", "--install", BUILD, "--prefix", prefix)
        headers = sorted((prefix / "include").rglob("*.hpp"))
        self.assertTrue(headers)
        for header in headers:
            # Twice: the second time finds a missing #pragma once.
            source = self.file("alone.cpp", f'#include "{header}"\n' * 2)
            self.command(os.environ["BLUM_CXX"], "-std=c++20", "-Wall", "-Wextra", "-Werror",
                         "-fsyntax-only", "-I", prefix / "include", source)

    def test_nothing_installed_speaks_of_the_source_tree(self):
        prefix = self.folder / "prefix"
        self.command("cmake", "--install", BUILD, "--prefix", prefix)
        for file in (prefix / "lib").rglob("*.cmake"):
            self.assertNotIn(str(SOURCE), file.read_text(), file)


if __name__ == "__main__":
    main()
