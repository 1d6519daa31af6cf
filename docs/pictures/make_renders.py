#!/usr/bin/env python3
"""Makes the PNG pictures of README and docs: docs/pictures/make_renders.py [NAME...]

Runs build/release/bin/blum (or $BLUM_TOOL) on models of ../shared/models and of `blum make`; all pictures, or
those whose names begin with one of the given ones. The growth plot needs gnuplot (gnuplot-nox), the page chromium. Minutes.
"""

import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TOOL = os.environ.get("BLUM_TOOL", ROOT / "build/release/bin/blum")
MODELS = ROOT.parent / "shared" / "models"
SMALL = ["--width", "800", "--height", "600"]
TORUS = ["--colour", "radius", "--elevation", "55", "--no-model", "--zoom", "1.3", "--no-legend"]

# name: model (a file, or arguments of `blum make`), command with options, options of `blum render`.
RENDERS = {
    "plate": ("plate 2 6", "medial --angles --epsilon 0.02", []),
    "theta_0": ("joint.off", "medial --angles --leaf-diameter 0.05", ["--theta", "0"]),
    "theta_60": ("joint.off", "medial --angles --leaf-diameter 0.05", ["--theta", "60"]),
    "theta_150": ("joint.off", "medial --angles --leaf-diameter 0.05", ["--theta", "150"]),
    "hma": ("torus 16 8", "medial --theta 80 --leaf-diameter 0.04", TORUS),
    "sma": ("torus 16 8", "medial --theta 80 --simplify sma --leaf-diameter 0.04", TORUS),
    "void": ("derived_cube_sphere_void.off", "medial --angles --epsilon 0.08",
             ["--theta", "90", "--section", "-y:0.5", "--azimuth", "-70", "--elevation", "22"]),
    "thickness": ("joint.off", "thickness --theta 100", []),
    "midsurface": ("joint.off", "midsurface --epsilon 0.07", []),
}
GROWTH = [(12, 6), (16, 8), (20, 10), (24, 12), (28, 14), (32, 16)]


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def model_file(model, folder):
    if model.endswith(".off"):
        return MODELS / model
    path = folder / (model.replace(" ", "_") + ".off")
    if not path.exists():
        run(TOOL, "make", *model.split(), "-o", path)
    return path


def result_of(model, command, folder, results):
    """The prefix of a result, computed once."""
    prefix = results.get((model, command))
    if prefix is None:
        prefix = folder / f"result{len(results)}"
        verb, *rest = command.split()
        run(TOOL, verb, model_file(model, folder), *rest, "-o", prefix)
        results[(model, command)] = prefix
    return prefix


def render(name, folder, results):
    model, command, options = RENDERS[name]
    prefix = result_of(model, command, folder, results)
    run(TOOL, "render", f"{prefix}.vtp", "-o", HERE / f"{name}.png", *SMALL, *options)
    if command.startswith("thickness"):
        shutil.copy(f"{prefix}.png", HERE / "thickness_histogram.png")


def page(folder, results):
    """A page of `blum view`, as a browser shows it (needs chromium)."""
    model, command, _ = RENDERS["theta_0"]
    prefix = result_of(model, command, folder, results)
    run(TOOL, "view", prefix, "-o", folder / "page.html")
    run("chromium", "--headless", "--no-sandbox", "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader", "--hide-scrollbars", "--window-size=1100,760",
        "--virtual-time-budget=8000", f"--screenshot={HERE / 'page.png'}",
        (folder / "page.html").as_uri())


def growth(folder):
    rows = []
    for n, m in GROWTH:
        model = model_file(f"torus {n} {m}", folder)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        run(TOOL, "medial", model, "-o", folder / "t", "--threads", "1")
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        summary = json.loads((folder / "t.json").read_text())
        rows.append((sum(summary["sites"].values()), seconds))
    data = folder / "growth.dat"
    data.write_text("".join(f"{sites} {seconds}\n" for sites, seconds in rows))
    script = f"""set terminal pngcairo size 900,560 font 'sans,13'
set output '{HERE / "growth.png"}'
set logscale xy
set grid
set key left top
set xlabel 'sites of the torus (faces, edges, vertices)'
set ylabel 'seconds of CPU time'
set fit quiet logfile '/dev/null'
f(x) = a + b * x
fit f(x) '{data}' using (log10($1)):(log10($2)) via a, b
plot '{data}' with points pointtype 7 pointsize 1.4 linecolor rgb '#21908d' \\
  title 'blum medial, one thread', \\
  10**a * x**b with lines linewidth 2 linecolor rgb '#440154' title sprintf('n^{{%.2f}}', b)
"""
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def main():
    wanted = sys.argv[1:] or [""]
    results = {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for picture in [*RENDERS, "page", "growth"]:
            if not any(picture.startswith(start) for start in wanted):
                continue
            print(picture, flush=True)
            if picture == "growth":
                growth(folder)
            elif picture == "page":
                page(folder, results)
            else:
                render(picture, folder, results)


if __name__ == "__main__":
    main()
