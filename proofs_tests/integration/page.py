"""The page of `blum view`, driven in headless Chromium by Playwright.

Needs chromium, node, npm and, once for each build folder, the npm registry (playwright-core, esbuild and
three.js by show/page/package-lock.json); skipped, with the reason, where one of these is not there.
"""

import json
import re
import shutil
import subprocess
import sys

from tool import BUILD, SKIPPED, SOURCE, ToolTest, main
from vtp import arrays

PAGE = SOURCE / "show" / "page"
COPY = BUILD / "page"


def prepare():
    """Why the test cannot run, if so."""
    for tool in ["chromium", "node", "npm"]:
        if shutil.which(tool) is None:
            return f"{tool} is not installed"
    COPY.mkdir(exist_ok=True)
    lock = (PAGE / "package-lock.json").read_bytes()
    done = COPY / "done"
    if not done.exists() or done.read_bytes() != lock:
        for name in ["package.json", "package-lock.json"]:
            shutil.copy(PAGE / name, COPY / name)
        result = subprocess.run(["npm", "ci", "--no-audit", "--no-fund"], cwd=COPY,
                                capture_output=True, text=True, timeout=300)
        if result.returncode != 0:
            return "npm ci failed: " + result.stderr.strip()[-300:]
        done.write_bytes(lock)
    return None


class Page(ToolTest):
    def drive(self, page, *thetas):
        result = subprocess.run(
            ["node", str(SOURCE / "proofs_tests/integration/page_driver.mjs"),
             str(COPY / "node_modules/playwright-core/index.mjs"), shutil.which("chromium"),
             str(page), *map(str, thetas)], capture_output=True, text=True, timeout=240)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return json.loads(result.stdout)

    def test_the_committed_page_is_what_its_sources_make(self):
        shutil.rmtree(COPY / "src", ignore_errors=True)
        shutil.copytree(PAGE / "src", COPY / "src")
        shutil.copy(PAGE / "build.mjs", COPY / "build.mjs")
        subprocess.run(["node", "build.mjs"], cwd=COPY, check=True, capture_output=True)
        self.assertEqual((COPY / "page.html").read_bytes(), (PAGE / "page.html").read_bytes(),
                         "run `npm ci && npm run build` in show/page and commit page.html")

    def test_an_axis(self):
        self.expect(self.blum("make", "plate", "2", "6", "-o", "plate.off"), 0)
        thetas = [0, 30, 60, 89, 91, 120, 150, 180]
        self.expect(self.blum("medial", "plate.off", "--epsilon", "0.1", "-o", "plate",
                              "--theta-table", ",".join(map(str, thetas)), "--theta-csv", "t.csv"),
                    0)
        self.expect(self.blum("view", "plate", "-o", "plate.html"), 0)
        page = self.folder / "plate.html"
        self.assertNotRegex(re.sub(r"<script.*?</script>", "", page.read_text(), flags=re.S),
                            r"(src|href)=\"(?!data:)")
        seen = self.drive(page, *thetas)
        self.assertEqual(seen["problems"], [])
        self.assertEqual(len(seen["requests"]), 1, "nothing but the page itself is loaded")

        # The slider: what `blum medial` counts.
        sheets = {}
        for line in (self.folder / "t.csv").read_text().splitlines()[1:]:
            theta, method, count, *_ = line.split(",")
            if method == "hma":
                sheets[theta] = count
        self.assertEqual(seen["sheets"], sheets)
        self.assertGreater(len(set(sheets.values())), 1)
        counts = [int(seen["triangles"][str(theta)]) for theta in thetas]
        self.assertEqual(counts, sorted(counts, reverse=True))

        # Not only background, and everything is a part of it.
        self.assertGreater(seen["first"]["covered"], 0.1)
        self.assertGreater(seen["first"]["colours"], 100)
        self.assertEqual(seen["changed"], {name: True for name in seen["changed"]})
        self.assertEqual(seen["last"]["colours"], 1, "all switched off, something is still there")

        # Picking: what the file says of that triangle.
        number = int(re.fullmatch(r"Triangle (\d+)", seen["picked"]["title"]).group(1))
        file = arrays(self.folder / "plate.vtp")
        cell = len(file["FieldData/line_edge"]) + number
        facts = seen["picked"]["facts"]
        vertices, edges, _ = file["FieldData/site_counts"]

        def name(site):
            return (f"vertex {site}" if site < vertices else f"edge {site - vertices}"
                    if site < vertices + edges else f"face {site - vertices - edges}")

        self.assertEqual(facts["governors"], ", ".join(
            name(file[f"CellData/governor_{side}"][cell]) for side in "ab"))
        low, high = re.fullmatch(r"(\S+)° to (\S+)°", facts["angle"]).groups()
        self.assertAlmostEqual(float(low), file["CellData/angle_lo"][cell], delta=0.01)
        self.assertAlmostEqual(float(high), file["CellData/angle_hi"][cell], delta=0.01)
        self.assertEqual(int(facts["sheet"]), file["CellData/sheet"][cell])
        corner = file["Polys/connectivity"][3 * number:3 * number + 3]
        radii = [file["PointData/radius"][p] for p in corner]
        self.assertGreaterEqual(float(facts["radius"]), min(radii) - 1e-4)
        self.assertLessEqual(float(facts["radius"]), max(radii) + 1e-4)
        self.in_box_of(corner, file, facts)
        self.assertFalse(seen["pickedBackground"])

    def in_box_of(self, corners, file, facts):
        """The picked point is where the triangle is, up to the digits of a float."""
        points = file[next(name for name in file if name.startswith("Points/"))]
        size = max(points) - min(points)
        for k, value in enumerate(facts["at"].split(", ")):
            values = [points[3 * p + k] for p in corners]
            self.assertGreaterEqual(float(value), min(values) - 1e-4 * size)
            self.assertLessEqual(float(value), max(values) + 1e-4 * size)

    def test_huge_and_tiny_models(self):
        for power in ["45", "-45"]:
            with self.subTest(power):
                sides = [f"{n}e{power}" for n in (4, 3, 1)]
                self.expect(self.blum("make", "cuboid", *sides, "-o", "box.off"), 0)
                self.expect(self.blum("medial", "box.off", "--angles", "-o", "box"), 0)
                self.expect(self.blum("view", "box", "-o", "box.html"), 0)
                seen = self.drive(self.folder / "box.html", 0)
                self.assertEqual(seen["problems"], [])
                self.assertGreater(seen["first"]["covered"], 0.1)
                file, facts = arrays(self.folder / "box.vtp"), seen["picked"]["facts"]
                number = int(seen["picked"]["title"].split()[1])
                corners = file["Polys/connectivity"][3 * number:3 * number + 3]
                self.in_box_of(corners, file, facts)
                self.assertLessEqual(0, float(facts["radius"]))
                self.assertLessEqual(float(facts["radius"]), max(file["PointData/radius"]) * 1.001)

    def test_what_is_undecided(self):
        self.expect(self.blum("make", "cuboid", "4", "3", "1", "-o", "box.off"), 0)
        self.expect(self.blum("medial", "box.off", "-o", "box", "--max-cells", "1"), 3)
        self.expect(self.blum("view", "box", "-o", "box.html"), 0)
        seen = self.drive(self.folder / "box.html", 0)
        self.assertEqual(seen["problems"], [])
        self.assertIs(seen["changed"]["undecided"], True)

    def test_thickness(self):
        self.expect(self.blum("make", "cuboid", "4", "3", "1", "-o", "box.off"), 0)
        self.expect(self.blum("thickness", "box.off", "--density", "5", "-o", "t"), 0)
        self.expect(self.blum("view", "t.vtp", "-o", "t.html"), 0)
        seen = self.drive(self.folder / "t.html", 0)
        self.assertEqual(seen["problems"], [])
        self.assertGreater(seen["first"]["colours"], 50)
        self.assertGreater(float(seen["picked"]["facts"]["thickness"]), 0)

    def test_titles_are_text(self):
        self.expect(self.blum("make", "cuboid", "-o", "a.off"), 0)
        evil = "<img src=x onerror=alert(1)></script>.off".replace("/", "")
        (self.folder / "a.off").rename(self.folder / evil)
        self.expect(self.blum("medial", evil, "-o", "a"), 0)
        self.expect(self.blum("view", "a", "-o", "a.html"), 0)
        self.assertNotIn("<img", (self.folder / "a.html").read_text())


if __name__ == "__main__":
    reason = prepare()
    if reason is not None:
        print(f"skipped: {reason}")
        sys.exit(SKIPPED)
    main()
