#!/usr/bin/env python3
"""Draws the pictures of this folder: make_pictures.py [BLUM]   (build/release/bin/blum by default)

Orthographic, drawn back to front: far faces of the solid, sheets and seams, near faces, edges. The
triangles of a sheet with one shade are one piece with one outline; the order of the pieces is read
off a coarse raster that knows what lies over a pixel, and how deep. One liberty is taken: vertices
that need not lie on the axis (on_axis = 0) move to the mean of their neighbours, to smooth seams.
"""

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
from itertools import combinations

# Arguments of `blum make`; azimuth and elevation of the eye, in degrees; pixels per unit of length.
BOX = ("cuboid 1 2 3", 32, 24, 100)
BRACKET = ("lbracket", -62, 33, 80)
PLATE = ("plate 2 16 2 0.4", -62, 55, 125)
PICTURES = {"overview": [BOX, BRACKET, PLATE], "lbracket": [BRACKET], "plate": [PLATE]}
OPTIONS = "--resolve --epsilon 0.03"
PALETTE = ((0.58, 0.42), (0.08, 0.62), (0.40, 0.38), (0.95, 0.42), (0.13, 0.62), (0.76, 0.30),
           (0.50, 0.42), (0.03, 0.55))  # hue, saturation
LIGHT = (-0.35, -0.75, 0.56)  # towards the light: right, down, towards the eye
SHADES, STEP = 8, 2.0  # levels of brightness below and above the mean; size of a raster pixel
STYLE = """<style>
path { stroke-linejoin: round; stroke-width: 0.7; fill: none; fill-rule: evenodd; }
.far { fill: #dfe7ee; }
.near { fill: #9fb8cc; fill-opacity: 0.15; }
.seam { stroke: #16202b; stroke-width: 1.3; stroke-linecap: round; }
.edge { stroke: #34495e; stroke-width: 1.6; stroke-linecap: round; }
.hidden { stroke: #34495e; stroke-opacity: 0.45; }
</style><rect width="100%" height="100%" fill="white"/>"""


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    return tuple(x / (math.hypot(*a) or 1) for x in a)


def normal(a, b, c):
    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    return tuple(u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3))


def edges(triangle):
    return combinations(sorted(triangle), 2)


def tuples(values, size):
    return list(zip(*(values[i::size] for i in range(size))))


def grouped(pairs):
    groups = defaultdict(list)  # key -> its values
    for key, value in pairs:
        groups[key].append(value)
    return groups


def compute(blum, make):
    """The arrays of the .vtp, written on this machine: {section/name: values}, vectors flat."""
    codes = {"Float64": "d", "Int64": "q", "UInt64": "Q", "Int32": "i", "UInt8": "B"}
    with tempfile.TemporaryDirectory() as folder:
        for command in "make %s -o solid.off" % make, "medial solid.off -o axis " + OPTIONS:
            subprocess.run([blum, *command.split()], check=True, cwd=folder, stdout=sys.stderr)
        root = xml.etree.ElementTree.parse(folder + "/axis.vtp").getroot()
    arrays = {}
    for section in root.iterfind(".//DataArray/.."):
        for element in section.iterfind("DataArray"):
            values = base64.b64decode(element.text)[8:]  # after the length
            values = array.array(codes[element.get("type")], values).tolist()
            arrays[section.tag + "/" + element.get("Name")] = values
    return arrays


def calmed(points, on_axis, lines, triangles):
    """Points not on the axis go to the mean of their neighbours (on seams and rims, if on such)."""
    beside = [grouped((v, w) for cell in cells for v in cell for w in cell if v != w)
              for cells in (lines, triangles)]
    for _ in range(5):
        for v in (v for v, on in enumerate(on_axis) if not on):
            near = [points[w] for w in beside[0].get(v) or beside[1][v]]
            points[v] = tuple(sum(c) / len(near) for c in zip(*near))
    return points


def colours(triangles, sheet):
    """{sheet: (hue, saturation)}; neighbours differ, and all are used."""
    at = grouped((v, s) for t, s in zip(triangles, sheet) for v in t)
    chosen = {}
    for s, _ in Counter(sheet).most_common():
        taken = {chosen.get(n) for sheets in at.values() if s in sheets for n in sheets}
        chosen[s] = min(PALETTE, key=lambda c: (c in taken, list(chosen.values()).count(c)))
    return chosen


def surface(points, triangles, style):
    """SVG (the outline: edges with an odd number of triangles) and raster of a piece of surface."""
    count, paths = Counter(e for t in triangles for e in edges(t)), []
    beside = grouped(e for (a, b), n in count.items() if n % 2 for e in ((a, b), (b, a)))
    for start in beside:
        while beside[start]:
            path = [start]
            while len(path) == 1 or path[-1] != start:
                path.append(beside[path[-1]].pop())
                beside[path[-1]].remove(path[-2])
            paths.append([points[v] for v in path])
    return svg_path(paths, style), dict(hit for t in triangles for hit in raster(points, t))


def raster(points, triangle):
    """(pixel, depth) for the pixels with their centres in a triangle."""
    a, b, c = (points[v] for v in triangle)
    nx, ny, nz = normal(a, b, c)
    low, high = ([f(p[i] / STEP for p in (a, b, c)) for i in (0, 1)] for f in (min, max))
    for i in range(math.ceil(low[0]), math.floor(high[0]) + 1):
        for j in range(math.ceil(low[1]), math.floor(high[1]) + 1):
            x, y = i * STEP, j * STEP
            sides = [((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) * nz
                     for p, q in ((a, b), (b, c), (c, a))]
            if nz and min(sides) >= 0:
                yield (i, j), a[2] - (nx * (x - a[0]) + ny * (y - a[1])) / nz


def stretches(p, q, length, style):
    """SVG and raster (a little lifted) of short pieces of a line."""
    n = round(math.dist(p, q) / length) or 1
    dense = [tuple(a + (b - a) * k / (8 * n) for a, b in zip(p, q)) for k in range(8 * n + 1)]
    for i in range(0, 8 * n, 8):
        pixels = {(round(x / STEP), round(y / STEP)): z + 3 * STEP for x, y, z in dense[i:i + 9]}
        yield svg_path([[dense[i], dense[i + 8]]], style), pixels


def svg_path(paths, style):
    lines = ("M" + "L".join("%.1f %.1f" % p[:2] for p in path) for path in paths)
    return '<path d="%s" %s/>' % ("".join(lines), style)


def back_to_front(rasters, bounds):
    """An order, deeper first at most pixels; those in bounds[j] before j in any case."""
    over = grouped((p, (z, i)) for i, pixels in enumerate(rasters) for p, z in pixels.items())
    votes = Counter((i, j) for stack in map(sorted, over.values())
                    for k, (_, i) in enumerate(stack) for _, j in stack[k + 1:])
    votes.update({(i, j): 1000 for j, earlier in bounds.items() for i in earlier})
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
    beside = grouped((e, plane) for t, plane in zip(triangles, planes) for e in edges(t))
    for (a, b), (m, n) in beside.items():
        faint = max(m[2], n[2]) <= 0 or dot(m[:3], n[:3]) > 0.8
        for svg, pixels in stretches(points[a], points[b], 6, 'class="edge"') if m != n else ():
            covered = sum(any(w > z - 2 * STEP and face not in (m, n) for w, face in over[pixel])
                          for pixel, z in pixels.items())
            hidden = faint or 2 * covered > len(pixels)
            near.append(svg.replace("edge", "hidden") if hidden else svg)
    return far, near


def axis(points, data, lines, triangles):
    """SVG of sheets and seams, in their order."""
    a, b, sheet = (data["CellData/" + name][len(lines):]
                   for name in ("governor_a", "governor_b", "sheet"))
    hue, pieces = colours(triangles, sheet), defaultdict(list)
    normals = [normal(*(points[v] for v in t)) for t in triangles]
    normals = [[math.copysign(c, c * n[2]) for c in n] for n in normals]  # towards the eye
    total = {s: [sum(c) for c in zip(*n)] for s, n in grouped(zip(sheet, normals)).items()}
    for (s, *_), part in grouped(zip(zip(sheet, a, b), zip(triangles, normals))).items():
        n = unit([sum(c) for c in zip(*(n for _, n in part))])
        n = unit(total[s]) if dot(n, unit(total[s])) > 0.9 else n  # no shades if almost plane
        pieces[s, round(SHADES * dot(n, LIGHT))] += [t for t, _ in part]
    drawn, bounds = [], {}
    for (which, shade), piece in pieces.items():
        rgb = colorsys.hls_to_rgb(hue[which][0], 0.56 + 0.26 * shade / SHADES, hue[which][1])
        rgb = "#%02x%02x%02x" % tuple(round(255 * c) for c in rgb)
        drawn.append(surface(points, piece, 'style="fill:%s;stroke:%s"' % (rgb, rgb)))
    at = grouped((e, i) for i, piece in enumerate(pieces.values()) for t in piece for e in edges(t))
    for (v, w), seam in zip(lines, data["CellData/seam"]):
        for piece in stretches(points[v], points[w], 20, 'class="seam"') if seam >= 0 else ():
            bounds[len(drawn)] = at[min(v, w), max(v, w)]
            drawn.append(piece)
    return [drawn[i][0] for i in back_to_front([pixels for _, pixels in drawn], bounds)]


def picture(data, azimuth, elevation, scale):
    """SVG of one solid with its axis; its box. Projection: right, down, towards the eye."""
    a, e = math.radians(azimuth), math.radians(elevation)
    turn = ((-math.sin(a), math.cos(a), 0.0),
            (math.sin(e) * math.cos(a), math.sin(e) * math.sin(a), -math.cos(e)),
            (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)))
    outside, inside = ([tuple(scale * dot(p, row) for row in turn) for p in tuples(data[name], 3)]
                       for name in ("FieldData/solid_points", "Points/Points"))
    lines = tuples(data["Lines/connectivity"], 2)
    triangles = tuples(data["Polys/connectivity"], 3)
    far, near = solid(outside, tuples(data["FieldData/solid_triangles"], 3))
    inside = calmed(inside, data["PointData/on_axis"], lines, triangles)
    box = [f(p[i] for p in outside) for f in (min, max) for i in (0, 1)]
    return "\n".join([*far, *axis(inside, data, lines, triangles), *near]), box


def main():
    here = pathlib.Path(__file__).resolve().parent
    blum = pathlib.Path((sys.argv + [here.parents[1] / "build/release/bin/blum"])[1]).resolve()
    drawn = {scene: picture(compute(blum, scene[0]), *scene[1:]) for scene in (BOX, BRACKET, PLATE)}
    for name, scenes in PICTURES.items():
        height = max(drawn[s][1][3] - drawn[s][1][1] for s in scenes) + 32
        x, text = 16, ""
        for svg, (left, top, right, bottom) in (drawn[s] for s in scenes):
            text += '<g transform="translate(%.1f %.1f)">\n%s\n</g>\n' % (
                x - left, (height - top - bottom) / 2, svg)
            x += right - left + 48
        head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %.0f %.0f">%s\n'
        (here / (name + ".svg")).write_text(head % (x - 32, height, STYLE) + text + "</svg>\n")


if __name__ == "__main__":
    main()
