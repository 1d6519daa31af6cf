#!/usr/bin/env python3
"""Draws the pictures of this folder: solids and their medial axes, computed by `blum`.

    docs/pictures/make_pictures.py [BLUM] [-o DIR]     (BLUM: build/release/bin/blum by default)

Orthographic projection, drawn back to front: far faces of the solid, sheets and seams of the axis,
near faces, edges. Triangles of a sheet with the same shade are one piece with one outline. The order of pieces and seams is read off a coarse raster that knows what lies over a
pixel, and how deep. One liberty is taken: vertices that need not lie on the axis (on_axis = 0) are
moved to the mean of their neighbours; seams would look ragged otherwise. Standard library only.
"""

import argparse
import array
import base64
import colorsys
import math
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from collections import Counter, defaultdict

# Arguments of `blum make`; azimuth and elevation of the eye, in degrees; pixels per unit of length.
BOX = ("cuboid 1 2 3", 32, 24, 100)
BRACKET = ("lbracket", -58, 28, 80)
PLATE = ("plate 2 16 2 0.4", -62, 55, 125)
PICTURES = {"overview": [BOX, BRACKET, PLATE], "lbracket": [BRACKET], "plate": [PLATE]}
EPSILON = 0.03
PALETTE = [(0.58, 0.42), (0.08, 0.62), (0.40, 0.38), (0.95, 0.42), (0.13, 0.62), (0.76, 0.30),
           (0.50, 0.42), (0.03, 0.55)]  # hue, saturation
SHADES = 8  # steps of brightness to either side of the middle
LIGHT = (-0.35, -0.75, 0.56)  # towards the light: right, down, towards the eye
STEP = 2.0  # a pixel of the raster, in pixels of the picture
MARGIN, GAP = 16, 50
STYLE = """<style>
path { stroke-linejoin: round; fill-rule: evenodd; }
.seam, .edge, .soft, .hidden { fill: none; stroke: #34495e; }
.far { fill: #dfe7ee; stroke: none; }
.near { fill: #9fb8cc; fill-opacity: 0.15; stroke: none; }
.sheet { stroke-width: 0.7; }
.seam { stroke: #16202b; stroke-width: 1.3; stroke-linecap: round; }
.edge { stroke-width: 1.6; stroke-linecap: round; }
.soft { stroke-width: 0.6; stroke-opacity: 0.6; }
.hidden { stroke-width: 0.7; stroke-opacity: 0.4; }
</style>
<rect width="100%" height="100%" fill="white"/>"""


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def mean(vectors):
    return tuple(sum(c) / len(vectors) for c in zip(*vectors))


def unit(a):
    return tuple(x / (math.hypot(*a) or 1) for x in a)


def normal(a, b, c):
    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    return tuple(u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3))


def tuples(values, size):
    return list(zip(*(values[i::size] for i in range(size))))


def grouped(pairs):
    """{key: its values}"""
    groups = defaultdict(list)
    for key, value in pairs:
        groups[key].append(value)
    return groups


def edges_of(triangle):
    a, b, c = sorted(triangle)
    return (a, b), (a, c), (b, c)


def compute(blum, make):
    """The arrays of the .vtp: {section/name: values}, vectors flat."""
    codes = {"Float64": "d", "Int64": "q", "UInt64": "Q", "Int32": "i", "UInt8": "B"}
    with tempfile.TemporaryDirectory() as folder:
        model, prefix = folder + "/model.off", folder + "/axis"
        for command in (["make", *make.split(), "-o", model],
                        ["medial", model, "-o", prefix, "--resolve", "--epsilon", str(EPSILON)]):
            subprocess.run([blum, *command], check=True, stdout=subprocess.DEVNULL)
        root = xml.etree.ElementTree.parse(prefix + ".vtp").getroot()
    arrays = {}
    for section in root.iterfind(".//DataArray/.."):
        for element in section.iterfind("DataArray"):
            values = array.array(codes[element.get("type")])
            values.frombytes(base64.b64decode(element.text)[8:])  # after the length
            if root.get("byte_order") != sys.byteorder.capitalize() + "Endian":
                values.byteswap()
            arrays[section.tag + "/" + element.get("Name")] = values.tolist()
    return arrays


def calmed(points, on_axis, lines, triangles):
    """Points not on the axis go to the mean of their neighbours (on seams and rims, if on such)."""
    beside = [grouped((v, w) for cell in cells for v in cell for w in cell if v != w)
              for cells in (lines, triangles)]
    for _ in range(5):
        for v in (v for v, on in enumerate(on_axis) if not on):
            points[v] = mean([points[w] for w in beside[0].get(v) or beside[1][v]])
    return points


def colours(triangles, sheet):
    """{sheet: (hue, saturation)}: neighbours differ, and all are used."""
    at = grouped((v, s) for t, s in zip(triangles, sheet) for v in t)
    chosen, used = {}, Counter()
    for s, _ in sorted(Counter(sheet).items(), key=lambda item: (-item[1], item[0])):
        taken = {chosen.get(n) for sheets in at.values() if s in sheets for n in sheets}
        chosen[s] = min(PALETTE, key=lambda c: (c in taken, used[c]))
        used[chosen[s]] += 1
    return chosen


def surface(points, triangles, style):
    """SVG (the outline: edges with an odd number of triangles) and raster of a piece of surface."""
    count = Counter(e for t in triangles for e in edges_of(t))
    odd = [e for e in count if count[e] % 2]
    beside = grouped(pair for a, b in odd for pair in ((a, b), (b, a)))
    paths = []
    for start in beside:
        while beside[start]:
            path = [start]
            while len(path) == 1 or path[-1] != start:
                path.append(beside[path[-1]].pop())
                beside[path[-1]].remove(path[-2])
            paths.append([points[v] for v in path])
    return svg_path(paths, style), dict(p for t in triangles for p in raster(*(points[v] for v in t)))


def raster(a, b, c):
    """(pixel, depth) for the pixels with their centres in a triangle."""
    nx, ny, nz = normal(a, b, c)
    low, high = ([f(p[i] / STEP for p in (a, b, c)) for i in (0, 1)] for f in (min, max))
    for i in range(math.ceil(low[0]), math.floor(high[0]) + 1):
        for j in range(math.ceil(low[1]), math.floor(high[1]) + 1):
            x, y = i * STEP, j * STEP
            sides = [((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) * nz
                     for p, q in ((a, b), (b, c), (c, a))]
            if nz and min(sides) >= 0:
                yield (i, j), a[2] - (nx * (x - a[0]) + ny * (y - a[1])) / nz


def stretches(p, q, length):
    """A line cut into short ones: (its ends, its raster)."""
    n = round(math.dist(p, q) / length) or 1
    dense = [tuple(a + (b - a) * k / (8 * n) for a, b in zip(p, q)) for k in range(8 * n + 1)]
    for i in range(0, 8 * n, 8):
        yield [dense[i], dense[i + 8]], {(round(x / STEP), round(y / STEP)): z
                                         for x, y, z in dense[i:i + 9]}


def svg_path(paths, style):
    lines = ("M" + "L".join("%.1f %.1f" % p[:2] for p in path) for path in paths)
    return '<path d="%s" %s/>' % ("".join(lines), style)


def back_to_front(rasters, bounds):
    """An order of {pixel: depth}: i before j if it is deeper at most of the pixels that they share,
    as far as possible; those in bounds[j] in any case before j."""
    over = grouped((pixel, (z, i)) for i, pixels in enumerate(rasters) for pixel, z in pixels.items())
    votes = Counter((i, j) for stack in map(sorted, over.values())
                    for k, (_, i) in enumerate(stack) for _, j in stack[k + 1:])
    for j, earlier in bounds.items():
        for i in earlier:
            votes[i, j], votes[j, i] = 1000, 0
    before = {i: {} for i in range(len(rasters))}
    for (i, j), n in votes.items():
        if n > votes.get((j, i), 0):
            before[j][i] = n
    depth = [max(pixels.values(), default=0) for pixels in rasters]
    while before:
        i = min(before, key=lambda i: (sum(before[i].values()), depth[i]))
        del before[i]
        for earlier in before.values():
            earlier.pop(i, None)
        yield i


def solid(points, triangles):
    """SVG of what lies behind the axis, and of what before it."""
    planes = []  # its outward normal (the projection mirrors), its distance from the origin
    for t in triangles:
        n = unit(normal(*(points[v] for v in reversed(t))))
        planes.append((*(round(c, 6) for c in n), round(dot(n, points[t[0]]), 3)))
    far, near, over = [], [], defaultdict(list)  # over: pixel -> [(depth, plane)]
    for plane, face in grouped(zip(planes, triangles)).items():
        seen = plane[2] > 0
        svg, pixels = surface(points, face, 'class="near"' if seen else 'class="far"')
        (near if seen else far).append(svg)
        for pixel, z in pixels.items():
            over[pixel].append((z, plane))
    beside = grouped((e, plane) for t, plane in zip(triangles, planes) for e in edges_of(t))
    for (a, b), (m, n) in beside.items():
        for part, pixels in stretches(points[a], points[b], 6) if m != n else ():
            covered = sum(any(w > z + STEP and face not in (m, n) for w, face in over[pixel])
                          for pixel, z in pixels.items())
            hidden = max(m[2], n[2]) <= 0 or 2 * covered > len(pixels)
            style = "hidden" if hidden else "edge" if dot(m[:3], n[:3]) < 0.8 else "soft"
            near.append(svg_path([part], 'class="%s"' % style))
    return far, near


def axis(points, data, lines, triangles):
    """SVG of sheets and seams, in their order."""
    a, b, sheet = (data["CellData/" + name][len(lines):]
                   for name in ("governor_a", "governor_b", "sheet"))
    hue, pieces = colours(triangles, sheet), defaultdict(list)
    for key, part in grouped(zip(zip(sheet, a, b), triangles)).items():
        normals = [normal(*(points[v] for v in t)) for t in part]
        towards_eye = mean([[math.copysign(1, n[2]) * c for c in n] for n in normals])
        pieces[key[0], round(SHADES * dot(unit(towards_eye), LIGHT))] += part
    drawn, bounds = [], {}
    for (which, shade), piece in pieces.items():
        h, s = hue[which]
        rgb = colorsys.hls_to_rgb(h, 0.56 + 0.26 * shade / SHADES, s)
        rgb = "#%02x%02x%02x" % tuple(round(255 * c) for c in rgb)
        drawn.append(surface(points, piece, 'class="sheet" fill="%s" stroke="%s"' % (rgb, rgb)))
    at = grouped((e, i) for i, piece in enumerate(pieces.values()) for t in piece for e in edges_of(t))
    for (v, w), seam in zip(lines, data["CellData/seam"]):
        for part, pixels in stretches(points[v], points[w], 20) if seam >= 0 else ():
            bounds[len(drawn)] = at[min(v, w), max(v, w)]
            drawn.append((svg_path([part], 'class="seam"'), pixels))
    return [drawn[i][0] for i in back_to_front([pixels for _, pixels in drawn], bounds)]


def picture(data, azimuth, elevation, scale):
    """SVG of one solid with its axis, width, height. Projection: (right, down, towards the eye)."""
    a, e = math.radians(azimuth), math.radians(elevation)
    right = (-math.sin(a), math.cos(a), 0.0)
    down = (math.sin(e) * math.cos(a), math.sin(e) * math.sin(a), -math.cos(e))
    eye = (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))

    def project(points):
        return [tuple(scale * dot(p, direction) for direction in (right, down, eye)) for p in points]

    outside = project(tuples(data["FieldData/solid_points"], 3))
    lines = tuples(data["Lines/connectivity"], 2)
    triangles = tuples(data["Polys/connectivity"], 3)
    inside = calmed(project(tuples(data["Points/Points"], 3)), data["PointData/on_axis"], lines,
                    triangles)
    far, near = solid(outside, tuples(data["FieldData/solid_triangles"], 3))
    (left, top), (w, h) = ([f(p[i] for p in outside) for i in (0, 1)] for f in (min, max))
    svg = ['<g transform="translate(%.1f %.1f)">' % (-left, -top), *far,
           *axis(inside, data, lines, triangles), *near, "</g>"]
    return "\n".join(svg), w - left, h - top


def main():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("blum", nargs="?", default=here.parents[1] / "build/release/bin/blum")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=here, metavar="DIR")
    options = parser.parse_args()
    drawn = {scene: picture(compute(options.blum, scene[0]), *scene[1:])
             for scene in (BOX, BRACKET, PLATE)}
    for name, scenes in PICTURES.items():
        height = max(drawn[scene][2] for scene in scenes) + 2 * MARGIN
        x, text = MARGIN, []
        for svg, w, h in (drawn[scene] for scene in scenes):
            text.append('<g transform="translate(%.1f %.1f)">\n%s\n</g>' % (x, (height - h) / 2, svg))
            x += w + GAP
        size = (x - GAP + MARGIN, height)
        head = '<svg xmlns="http://www.w3.org/2000/svg" width="%.0f" viewBox="0 0 %.0f %.0f">'
        file = options.output / (name + ".svg")
        file.write_text("\n".join([head % (size[0], *size), STYLE, *text, "</svg>\n"]))
        print("%s: %d kB" % (file, file.stat().st_size // 1000))


if __name__ == "__main__":
    main()
