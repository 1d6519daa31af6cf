#!/usr/bin/env python3
"""Writes docs/commands/: a page a command, with what it really says. docs/make_commands.py [TOOL]

Everything shown is run, in an empty folder, in the order of PAGES; later pages use files of earlier ones.
A run with another exit code than the one expected stops the script.
"""

import pathlib
import shlex
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TOOL = pathlib.Path(sys.argv[1] if len(sys.argv) > 1
                    else HERE.parent / "build/release/bin/blum").resolve()  # runs are in another folder

# Command: what it is for, and examples: what they show, the line, the exit code.
PAGES = {
    "make": ("Writes a solid to try things on.", [
        ("A plate with two hexagonal holes:", "blum make plate 2 6 -o plate.off", 0),
        ("A box:", "blum make cuboid 4 3 1 -o box.off", 0),
    ]),
    "info": ("Says whether a mesh is a solid, and what kind of.", [
        ("", "blum info plate.off", 0),
        ("A mesh with a face missing is none; every class of defects is named:",
         "blum info open.off", 2),
    ]),
    "medial": ("Computes the certified medial axis of a solid.", [
        ("As coarse as the topology allows:", "blum medial plate.off", 0),
        ("With all angles, for `blum view` and `blum render`, and finer:",
         "blum medial plate.off --angles --epsilon 0.05 -o fine", 0),
        ("Both simplified axes at some angles:",
         "blum medial box.off --theta-table 0,89,91,180", 0),
        ("A budget that does not suffice: nothing is guessed, and the exit code is 3:",
         "blum medial plate.off -o small --max-cells 2", 3),
    ]),
    "voronoi": ("Computes the certified Voronoi diagram of faces, edges and vertices, inside and "
                "outside, in a box; see [modes.md](../modes.md).", [
        ("", "blum voronoi box.off -o boxv --graph boxv.graphml", 0),
    ]),
    "field": ("Distances on a grid, with certified error bounds; see [fields.md](../fields.md).", [
        ("", "blum field plate.off --resolution 64 --signed -o plate.vti --slice slice.png", 0),
        ("A voxel image, here a field's own: the distance of every voxel to the nearest one of at "
         "least 0.25:",
         "blum field plate.off --resolution 40,30,20 --backend cpu -o grey.nrrd", 0),
        ("", "blum field grey.nrrd --threshold 0.25 -o distance.vti", 0),
    ]),
    "thickness": ("How thick the walls are: the largest ball inside that touches at each sample of a "
                  "face; see [thickness.md](../thickness.md).", [
        ("", "blum thickness plate.off", 0),
        ("Walls alone, not the neighbourhood of edges of 90 degrees:",
         "blum thickness plate.off --theta 100 --bins 5 -o walls", 0),
        ("The histogram:", "cat walls.csv", 0),
    ]),
    "midsurface": ("The middle surface of thin walls, with the thickness at each vertex.", [
        ("", "blum midsurface plate.off", 0),
    ]),
    "view": ("Writes a result as one page to turn around, cut and look into.", [
        ("", "blum view fine -o fine.html", 0),
        ("Results of thickness and midsurface, too:", "blum view walls.vtp -o walls.html", 0),
    ]),
    "render": ("Draws a result as a picture, without display or GPU; see "
               "[rendering.md](../rendering.md).", [
        ("", "blum render fine -o fine.png --theta 60", 0),
        ("Half of it, one colour a sheet:",
         "blum render fine -o half.png --section y:0.5 --colour sheet --azimuth -80", 0),
    ]),
    "certificate": ("Says what a certificate says, for people; see [certificate.md](../certificate.md).", [
        ("", "blum medial box.off -o c --certificate box.cert", 0),
        ("", "blum certificate box.cert", 0),
        ("Of an axis simplified by an angle it has the collapses, too:",
         "blum medial box.off -o c --theta 95 --certificate pruned.cert", 0),
        ("", "blum certificate pruned.cert", 0),
    ]),
    "verify": ("Checks a certificate, independently of what made it.", [
        ("", "blum verify box.off box.cert", 0),
        ("With the collapses of a simplified axis:", "blum verify box.off pruned.cert", 0),
        ("Of another model:", "blum verify plate.off box.cert", 4),
    ]),
}


def run(line, folder):
    words = shlex.split(line)
    if words[0] == "blum":
        words[0] = str(TOOL)
    done = subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True)
    return done.returncode, done.stdout


def page(name, folder):
    purpose, examples = PAGES[name]
    code, text = run(f"blum {name} --help", folder)
    assert code == 0
    lines = [f"# blum {name}", "", "Written by `docs/make_commands.py`; do not edit.", "", purpose, "",
             "## Examples", ""]
    for what, line, expected in examples:
        code, output = run(line, folder)
        if code != expected:
            sys.exit(f"{line}: exit code {code}, not {expected}\n{output}")
        lines += [what, ""] if what else []
        lines += ["```", f"$ {line}", output.rstrip(), "```", ""] if output else []
        if code != 0:
            lines += [f"Exit code {code}.", ""]
    lines += ["## Options", "", "```", text.rstrip(), "```", ""]
    return "\n".join(lines)


def main():
    (HERE / "commands").mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "open.off").write_text(
            "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n")
        for command in PAGES:
            print(command, flush=True)
            (HERE / "commands" / f"{command}.md").write_text(page(command, folder))
    index = ["# Commands", "", "Written by `docs/make_commands.py`; do not edit.", ""]
    index += [f"* [blum {name}]({name}.md): {PAGES[name][0].split(';')[0].rstrip('.')}."
              for name in PAGES]
    code, text = run("blum --help", ".")
    assert code == 0
    index += ["", "```", "$ blum --help", text.rstrip(), "```", ""]
    (HERE / "commands" / "README.md").write_text("\n".join(index))


if __name__ == "__main__":
    main()
