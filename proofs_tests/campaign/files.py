"""Models from files, as runs of the campaign: seed 1 is the file as it is, others are it in another guise.

As with generated models the tool is given an OFF file of this tool's.
"""

import math
import pathlib
import random
import re
import struct

import change
from mesh import Mesh, betti_numbers, shells


def off(content):
    lines = [line.split() for line in re.sub(r"#[^\n]*", "", content.decode()).splitlines()]
    lines = [line for line in lines if line]
    if not re.fullmatch(r"(ST|C|N)*OFF", lines[0][0]):
        raise ValueError("no OFF file")
    head = lines.pop(0)[1:] or lines.pop(0)
    points, faces = int(head[0]), int(head[1])
    return ([tuple(map(float, line[:3])) for line in lines[:points]],
            [[int(line[k]) for k in range(1, 1 + int(line[0]))] for line in lines[points:points + faces]])


def obj(content):
    points, faces = [], []
    for line in content.decode(errors="replace").replace("\\\n", " ").splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            points.append(tuple(map(float, rest[:3])))
        elif word == "f":
            indices = [int(w.split("/")[0]) for w in rest]
            faces.append([i - 1 if i >= 0 else len(points) + i for i in indices])
    return points, faces


def stl(content):
    """Corners at one place are one vertex."""
    triangles = struct.unpack_from("<I", content, 80)[0] if len(content) >= 84 else -1
    if len(content) == 84 + 50 * triangles:
        corners = [c for i in range(triangles)
                   for c in struct.iter_unpack("<3f", content[96 + 50 * i:132 + 50 * i])]
    else:
        corners = [tuple(map(float, m)) for m in
                   re.findall(r"^\s*vertex\s+(\S+)\s+(\S+)\s+(\S+)", content.decode(), re.MULTILINE)]
    index = {}
    used = [index.setdefault(tuple(x + 0.0 for x in c), len(index)) for c in corners]
    return list(index), [used[i:i + 3] for i in range(0, len(used), 3)]


READERS = {".off": off, ".obj": obj, ".stl": stl}


def parsed(path, content):
    """ValueError where it is no such file."""
    try:
        points, faces = READERS[path.suffix.lower()](content)
    except (IndexError, OverflowError, struct.error) as problem:
        raise ValueError(problem) from problem
    if not all(len(p) == 3 and all(map(math.isfinite, p)) for p in points):
        raise ValueError("a corner without three finite coordinates")
    if not all(len(f) >= 3 and all(0 <= v < len(points) for v in f) for f in faces):
        raise ValueError("a face of fewer than three corners, or one of corners that are not there")
    return Mesh(points, faces).compact()


def found(folders):
    """(names of the mesh files below the folders, each content once, small ones first; those that are
    no meshes of faces)."""
    paths = [p for folder in map(pathlib.Path, folders)
             for p in ([folder] if folder.is_file() else folder.rglob("*"))
             if p.suffix.lower() in READERS and p.is_file()]
    sizes, others, contents = [], [], set()
    for path in sorted(paths):
        content = path.read_bytes()
        if content in contents:
            continue
        contents.add(content)
        try:
            size = len(parsed(path, content).faces)
        except ValueError:
            size = 0
        if size:
            sizes.append((size, str(path)))
        else:
            others.append(str(path))
    return [name for _, name in sorted(sizes)], others


def generate(name, seed):
    """As of families.py, of a file; faces outward where that can be told. Open surfaces have no guises:
    facets cannot be triangulated anew there."""
    path = pathlib.Path(name)
    mesh, parameters = parsed(path, path.read_bytes()), {"changes": []}
    rng = random.Random(f"{path.name}/{seed}")
    turned = Mesh(mesh.points, [f[::-1] for f in mesh.faces])
    mesh = mesh if betti_numbers(turned) is None else turned
    if seed > 1 and shells(mesh) is not None:
        mesh, parameters["changes"] = change.changed(mesh, change.draw(rng), rng)
    parameters["blum_seed"] = 1 if seed == 1 else rng.randint(1, 1000)
    return mesh, parameters, betti_numbers(mesh)
