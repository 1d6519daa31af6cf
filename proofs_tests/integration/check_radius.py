#!/usr/bin/env python3
"""Checks PREFIX.vtp of `blum medial` against the model, sharing nothing with the library.

    check_radius.py PREFIX.vtp MODEL [--tolerance 1e-9] [--sample N] [--min-feet 1e-7]
    check_radius.py --self-test [PREFIX.vtp MODEL]

For every vertex with on_axis = 1 (or N of them, spread evenly):
  * radius and distance to the closest triangle of the model agree to tolerance * diagonal;
  * every claimed governor is that near (a site id counts through the vertices, edges and triangles
    in the file's own solid_points, solid_edges, solid_triangles, which have to be the model's);
  * at crossings of essential ties (kinds arc point and event) the governors have two different feet.
Some vertices are also tested to lie inside the solid, by the solid angle.

Only the standard library. Distances are computed in doubles, pruned by a box tree; what fails is
computed again with fractions from all triangles before it is called a failure, and a few vertices
are computed without the tree in any case.

Exit code: 0 everything agrees, 1 something does not (said on stderr), 2 usage or unreadable files.
--self-test spoils the data in several ways and fails unless every one is noticed.
"""

import argparse
import array
import base64
import copy
import math
import os
import struct
import sys
import tempfile
import xml.etree.ElementTree
from fractions import Fraction

KIND_NAMES = ["arc point", "event", "rim", "convex edge", "boundary", "cone"]
KINDS_ON_TIES = (0, 1)  # arc point, event
MOST_MESSAGES = 10


class Unreadable(Exception):
    pass


# ---------------------------------------------------------------- the .vtp

TYPE_CODES = {
    "Float64": "d", "Float32": "f", "Int64": "q", "UInt64": "Q", "Int32": "i", "UInt32": "I",
    "UInt8": "B", "Int8": "b",
}


def decode(element, big_endian, header_type):
    """The values of one DataArray, inline ascii or uncompressed base64."""
    code = TYPE_CODES.get(element.get("type"))
    if code is None:
        raise Unreadable("array of unknown type %s" % element.get("type"))
    text = (element.text or "").strip()
    if element.get("format") == "ascii":
        return [float(x) if code in "df" else int(x) for x in text.split()]
    if element.get("format") != "binary":
        raise Unreadable("array in format %s" % element.get("format"))
    data = base64.b64decode(text)
    header = struct.Struct((">" if big_endian else "<") + TYPE_CODES[header_type])
    (length,) = header.unpack_from(data)
    data = data[header.size:]
    if len(data) != length:
        raise Unreadable("array '%s' has %d bytes, says %d" % (element.get("Name"), len(data), length))
    values = array.array(code)
    values.frombytes(data)
    if big_endian != (sys.byteorder == "big"):
        values.byteswap()
    return values.tolist()


def tuples(values, size):
    return list(zip(*(values[i::size] for i in range(size))))


class Axis:
    """What a .vtp says, as plain lists."""

    def __init__(self, path):
        try:
            root = xml.etree.ElementTree.parse(path).getroot()
        except (OSError, xml.etree.ElementTree.ParseError) as error:
            raise Unreadable("%s: %s" % (path, error))
        big = root.get("byte_order") == "BigEndian"
        header_type = root.get("header_type", "UInt32")

        def values(where, name):
            for element in root.iterfind(".//%s/DataArray" % where):
                if element.get("Name") == name:
                    return decode(element, big, header_type)
            raise Unreadable("%s: no array '%s' in %s" % (path, name, where))

        self.points = tuples(values("Points", "Points"), 3)
        self.radius = values("PointData", "radius")
        self.on_axis = values("PointData", "on_axis")
        self.kind = values("PointData", "kind")
        self.polys = tuples(values("Polys", "connectivity"), 3)
        self.governor_offset = values("FieldData", "governor_offset")
        self.governor = values("FieldData", "governor")
        self.site_counts = values("FieldData", "site_counts")
        self.solid_points = tuples(values("FieldData", "solid_points"), 3)
        self.solid_edges = tuples(values("FieldData", "solid_edges"), 2)
        self.solid_triangles = tuples(values("FieldData", "solid_triangles"), 3)

    def governors(self, i):
        return self.governor[self.governor_offset[i]:self.governor_offset[i + 1]]


# ---------------------------------------------------------------- models

def read_off(text):
    words = [w for line in text.splitlines() for w in line.split("#")[0].split()]
    if words and words[0].endswith("OFF"):
        words.pop(0)
    vertices, faces = int(words[0]), int(words[1])
    at = 3
    points = [tuple(map(float, words[at + 3 * i:at + 3 * i + 3])) for i in range(vertices)]
    at += 3 * vertices
    # A face may be followed by a colour: its line ends there.
    polygons = []
    lines = [line.split("#")[0].split() for line in text.splitlines()]
    lines = [line for line in lines if line]
    if lines[0][0].endswith("OFF"):
        lines[0].pop(0)
        lines = [line for line in lines if line]
    for line in lines[1 + vertices:1 + vertices + faces]:
        polygons.append([int(i) for i in line[1:1 + int(line[0])]])
    return points, polygons


def read_obj(text):
    points, polygons = [], []
    for line in text.splitlines():
        words = line.split("#")[0].split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            corner = [int(w.split("/")[0]) for w in words[1:]]
            polygons.append([i - 1 if i > 0 else len(points) + i for i in corner])
    return points, polygons


def merge_equal(triangles):
    index, points, polygons = {}, [], []
    for triangle in triangles:
        polygon = []
        for p in triangle:
            if p not in index:
                index[p] = len(points)
                points.append(p)
            polygon.append(index[p])
        polygons.append(polygon)
    return points, polygons


def read_stl(data):
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        count = struct.unpack_from("<I", data, 80)[0]
        rows = [struct.unpack_from("<12f", data, 84 + 50 * i)[3:] for i in range(count)]
        return merge_equal([(r[0:3], r[3:6], r[6:9]) for r in rows])
    corners = [tuple(map(float, line.split()[1:4])) for line in data.decode().splitlines()
               if line.split()[:1] == ["vertex"]]
    return merge_equal(tuples(corners, 3))


def read_ply(data):
    end = data.index(b"end_header")
    end = data.index(b"\n", end) + 1
    header = data[:end].decode().splitlines()
    ascii_format = any(line.startswith("format ascii") for line in header)
    order = ">" if any("big_endian" in line for line in header) else "<"
    codes = {"char": "b", "int8": "b", "uchar": "B", "uint8": "B", "short": "h", "int16": "h",
             "ushort": "H", "uint16": "H", "int": "i", "int32": "i", "uint": "I", "uint32": "I",
             "float": "f", "float32": "f", "double": "d", "float64": "d"}
    elements = []
    for line in header:
        words = line.split()
        if words[:1] == ["element"]:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            elements[-1][2].append(words[1:])
    words = iter(data[end:].split()) if ascii_format else None
    offset = end

    def take(kind):
        nonlocal offset
        if words is not None:
            word = next(words)
            return float(word) if codes[kind] in "fd" else int(word)
        item = struct.Struct(order + codes[kind])
        (value,) = item.unpack_from(data, offset)
        offset += item.size
        return value

    points, polygons = [], []
    for name, count, properties in elements:
        for _ in range(count):
            row = {}
            for p in properties:
                if p[0] == "list":
                    row[p[3]] = [take(p[2]) for _ in range(take(p[1]))]
                else:
                    row[p[1]] = take(p[0])
            if name == "vertex":
                points.append((row["x"], row["y"], row["z"]))
            elif name == "face":
                polygons.append(row.get("vertex_indices", row.get("vertex_index")))
    return points, polygons


def read_model(path):
    try:
        with open(path, "rb") as file:
            data = file.read()
        if data.lstrip().startswith(b"ply"):
            return read_ply(data)
        extension = os.path.splitext(path)[1].lower()
        if extension == ".stl":
            return read_stl(data)
        return read_obj(data.decode()) if extension == ".obj" else read_off(data.decode())
    except (OSError, ValueError, IndexError, KeyError, struct.error, StopIteration) as error:
        raise Unreadable("%s: %s" % (path, error))


# ---------------------------------------------------------------- distances
# All of these work on floats and on Fractions.

def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def along(a, u, t):
    return (a[0] + t * u[0], a[1] + t * u[1], a[2] + t * u[2])


def foot_on_segment(p, a, b):
    u = sub(b, a)
    t, length = dot(sub(p, a), u), dot(u, u)
    if t <= 0 or length == 0:
        return a
    return b if t >= length else along(a, u, t / length)


def foot_on_triangle(p, a, b, c):
    """The nearest point: inside the three side planes the projection, else on a side."""
    ab, ac, ap = sub(b, a), sub(c, a), sub(p, a)
    n = cross(ab, ac)
    if (dot(cross(n, ab), ap) > 0 and dot(cross(n, sub(c, b)), sub(p, b)) > 0
            and dot(cross(n, sub(a, c)), sub(p, c)) > 0):
        return along(p, n, -dot(ap, n) / dot(n, n))
    best, best_squared = None, None
    for s, e in ((a, b), (b, c), (c, a)):
        foot = foot_on_segment(p, s, e)
        d = sub(p, foot)
        squared = dot(d, d)
        if best is None or squared < best_squared:
            best, best_squared = foot, squared
    return best


def squared_to_triangle(p, triangle):
    d = sub(p, foot_on_triangle(p, *triangle))
    return dot(d, d)


def exact(p):
    return tuple(Fraction(x) for x in p)


class BoxTree:
    """Triangles in nested boxes; answers the squared distance to the nearest below a bound."""

    LEAF = 4

    def __init__(self, triangles):
        items = [(tuple(min(v[k] for v in t) for k in range(3)),
                  tuple(max(v[k] for v in t) for k in range(3)), t) for t in triangles]
        self.root = self.build(items)

    def build(self, items):
        lo = tuple(min(i[0][k] for i in items) for k in range(3))
        hi = tuple(max(i[1][k] for i in items) for k in range(3))
        if len(items) <= self.LEAF:
            return (lo, hi, None, [i[2] for i in items])
        axis = max(range(3), key=lambda k: hi[k] - lo[k])
        items.sort(key=lambda i: i[0][axis] + i[1][axis])
        middle = len(items) // 2
        return (lo, hi, (self.build(items[:middle]), self.build(items[middle:])), None)

    @staticmethod
    def squared_to_box(p, node):
        total = 0.0
        for x, lo, hi in zip(p, node[0], node[1]):
            if x < lo:
                total += (lo - x) * (lo - x)
            elif x > hi:
                total += (x - hi) * (x - hi)
        return total

    def nearest(self, p, bound):
        best = bound
        stack = [(self.squared_to_box(p, self.root), self.root)]
        while stack:
            squared, node = stack.pop()
            if squared >= best:
                continue
            if node[2] is None:
                for triangle in node[3]:
                    best = min(best, squared_to_triangle(p, triangle))
            else:
                near, far = sorted(((self.squared_to_box(p, child), child) for child in node[2]),
                                   key=lambda entry: entry[0])
                stack.append(far)
                stack.append(near)
        return best


def winding_number(p, triangles):
    """Sum of the signed solid angles over 4 pi: 1 inside, 0 outside."""
    total = 0.0
    for t in triangles:
        a, b, c = (sub(v, p) for v in t)
        la, lb, lc = (math.sqrt(dot(v, v)) for v in (a, b, c))
        total += 2 * math.atan2(dot(a, cross(b, c)),
                                la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)
    return total / (4 * math.pi)


# ---------------------------------------------------------------- the checks

class Failures:
    def __init__(self):
        self.messages, self.count = [], 0

    def add(self, message):
        self.count += 1
        if len(self.messages) < MOST_MESSAGES:
            self.messages.append(message)


def check_solid(axis, points, polygons, failures):
    """The solid in the file is the model: same vertices, same area, every triangle within a face."""
    solid = axis.solid_points
    if axis.site_counts != [len(solid), len(axis.solid_edges), len(axis.solid_triangles)]:
        failures.add("site_counts %s do not fit the solid in the file" % axis.site_counts)
        return
    for name, rows in (("solid_edges", axis.solid_edges), ("solid_triangles", axis.solid_triangles)):
        if any(not 0 <= i < len(solid) for row in rows for i in row):
            failures.add("%s: index out of range" % name)
            return
    theirs = {solid[i] for t in axis.solid_triangles for i in t}
    ours = {points[i] for polygon in polygons for i in polygon}
    for p in sorted(theirs ^ ours)[:3]:
        failures.add("point %s is in the %s only" % (p, "solid" if p in theirs else "model"))
    if theirs != ours:
        return

    # A triangle lies within a polygon of the model that has its three corners and its normal (up
    # to the sign, for files that were inverted as a whole).
    faces_at = {}
    for f, polygon in enumerate(polygons):
        for i in polygon:
            faces_at.setdefault(points[i], set()).add(f)

    def vector_area(corners):
        total = (0.0, 0.0, 0.0)
        for i in range(1, len(corners) - 1):
            total = tuple(map(float.__add__, total, cross(sub(corners[i], corners[0]),
                                                          sub(corners[i + 1], corners[0]))))
        return total

    normals = [vector_area([points[i] for i in polygon]) for polygon in polygons]
    covered = [0.0] * len(polygons)
    for number, t in enumerate(axis.solid_triangles):
        corners = [solid[i] for i in t]
        faces = faces_at[corners[0]] & faces_at[corners[1]] & faces_at[corners[2]]
        area = vector_area(corners)
        if not faces:
            failures.add("solid triangle %d lies in no face of the model" % number)
            continue
        face = max(faces, key=lambda f: abs(dot(area, normals[f])) / math.sqrt(dot(normals[f], normals[f])))
        covered[face] += dot(area, normals[face]) / dot(normals[face], normals[face])
    # Vector area depends on the outline alone, so even a polygon that is not planar is covered once.
    sign = 1 if sum(covered) > 0 else -1
    for face, share in enumerate(covered):
        if abs(sign * share - 1) > 1e-6:
            failures.add("face %d of the model is covered %.9g times by the solid's triangles"
                         % (face, sign * share))

    sides = set()
    for a, b, c in axis.solid_triangles:
        sides |= {frozenset((a, b)), frozenset((b, c)), frozenset((c, a))}
    if sides != {frozenset(e) for e in axis.solid_edges} or len(sides) != len(axis.solid_edges):
        failures.add("solid_edges are not the sides of solid_triangles")


def site_foot(axis, site, p, convert=lambda q: q):
    vertices, edges, triangles = axis.site_counts
    if not 0 <= site < vertices + edges + triangles:
        return None
    if site < vertices:
        return convert(axis.solid_points[site])
    if site < vertices + edges:
        ends = axis.solid_edges[site - vertices]
        return foot_on_segment(p, *(convert(axis.solid_points[i]) for i in ends))
    corners = axis.solid_triangles[site - vertices - edges]
    return foot_on_triangle(p, *(convert(axis.solid_points[i]) for i in corners))


def site_name(axis, site):
    vertices, edges, _ = axis.site_counts
    if site < vertices:
        return "vertex %d" % site
    return "edge %d" % (site - vertices) if site < vertices + edges else \
        "triangle %d" % (site - vertices - edges)


def differs(p, foot, radius, tolerance):
    d = sub(p, foot)
    return abs(math.sqrt(dot(d, d)) - radius) > tolerance


def differs_exactly(squared, radius, tolerance):
    """|sqrt(squared) - radius| > tolerance, in fractions."""
    high = Fraction(radius) + Fraction(tolerance)
    low = Fraction(radius) - Fraction(tolerance)
    return squared > high * high or (low > 0 and squared < low * low)


class Report:
    vertices = governors = inside = 0
    worst = 0.0


def spread(items, most):
    if most is None or len(items) <= most:
        return items
    return [items[i * len(items) // most] for i in range(most)]


def check(axis, model, tolerance=1e-9, sample=None, min_feet=1e-7):
    """Returns (Failures, Report)."""
    failures, report = Failures(), Report()
    points, polygons = model
    check_solid(axis, points, polygons, failures)
    if failures.count:
        return failures, report

    used = [points[i] for polygon in polygons for i in polygon]
    lo = [min(p[k] for p in used) for k in range(3)]
    hi = [max(p[k] for p in used) for k in range(3)]
    diagonal = math.dist(lo, hi)
    allowed = tolerance * diagonal
    triangles = [tuple(axis.solid_points[i] for i in t) for t in axis.solid_triangles]
    tree = BoxTree(triangles)

    count = len(axis.points)
    if any(len(values) != count for values in (axis.radius, axis.on_axis, axis.kind)) or \
            len(axis.governor_offset) != count + 1:
        failures.add("arrays of different length")
        return failures, report
    if any(not 0 <= i < count for poly in axis.polys for i in poly):
        failures.add("triangle with a vertex out of range")
        return failures, report

    chosen = spread([i for i in range(count) if axis.on_axis[i]], sample)
    if count and not chosen:
        failures.add("no vertex is on the axis")
    without_tree = set(spread(chosen, max(1, 200000 // len(triangles))))
    for i in chosen:
        p, r = axis.points[i], axis.radius[i]
        name = "vertex %d (%s) at %s" % (i, KIND_NAMES[axis.kind[i]], p)
        if not all(map(math.isfinite, (*p, r))) or r < 0:
            failures.add("%s: radius %r" % (name, r))
            continue
        report.vertices += 1

        bound = (r + 2 * allowed) ** 2
        squared = tree.nearest(p, bound)
        if i in without_tree:
            squared = min(squared_to_triangle(p, t) for t in triangles)
        error = abs(math.sqrt(squared) - r)
        if error > allowed:
            nearest = min(squared_to_triangle(exact(p), tuple(map(exact, t))) for t in triangles)
            error = abs(math.sqrt(nearest) - r)
            if differs_exactly(nearest, r, allowed):
                failures.add("%s: radius %r, distance %r" % (name, r, math.sqrt(nearest)))
        report.worst = max(report.worst, error / diagonal)

        feet = []
        for site in axis.governors(i):
            report.governors += 1
            foot = site_foot(axis, site, p)
            if foot is None:
                failures.add("%s: governor %d does not exist" % (name, site))
                continue
            if differs(p, foot, r, allowed):
                foot = site_foot(axis, site, exact(p), exact)
                d = sub(exact(p), foot)
                if differs_exactly(dot(d, d), r, allowed):
                    failures.add("%s: radius %r, but %s is %r away" %
                                 (name, r, site_name(axis, site), math.sqrt(dot(d, d))))
                foot = tuple(map(float, foot))
            feet.append(foot)
        if axis.kind[i] in KINDS_ON_TIES:
            if len(feet) < 2:
                failures.add("%s: %d governor(s), at least 2 expected" % (name, len(feet)))
            elif max(math.dist(a, b) for a in feet for b in feet) <= min_feet * r:
                failures.add("%s: all its governors have one foot" % name)

    away = [i for i in chosen if axis.radius[i] > 1e-6 * diagonal]
    for i in spread(away, max(10, min(200, 1000000 // len(triangles)))):
        report.inside += 1
        if abs(abs(winding_number(axis.points[i], triangles)) - 1) > 0.1:
            failures.add("vertex %d at %s is outside the solid" % (i, axis.points[i]))
    return failures, report


# ---------------------------------------------------------------- self-test

CUBE_OFF = """OFF # the unit cube
8 6 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 3 2 1 0
4 4 5 6 7 255 0 0
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""


def cube_vtp(binary):
    """A few points of the cube's axis, written here: nothing is taken over from the library."""
    points, polygons = read_off(CUBE_OFF)
    triangles = [t for f in polygons for t in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]
    edges = sorted({tuple(sorted(e)) for a, b, c in triangles for e in ((a, b), (b, c), (c, a))})
    site = {frozenset(t): 8 + len(edges) + i for i, t in enumerate(triangles)}
    bottom, front, left = (site[frozenset(t)] for t in ((3, 1, 0), (0, 1, 5), (3, 0, 4)))
    front_upper, left_upper, back = (site[frozenset(t)] for t in ((0, 5, 4), (3, 4, 7), (2, 3, 7)))
    edge = 8 + edges.index((0, 4))
    rows = [  # point, radius, on_axis, kind, governors
        ((0.25, 0.25, 0.5), 0.25, 1, 0, [front_upper, left]),
        ((0.125, 0.125, 0.125), 0.125, 1, 1, [bottom, front, left]),
        ((0.0, 0.0, 0.5), 0.0, 1, 3, [edge]),
        ((0.0, 0.0, 0.0), 0.0, 1, 4, [0]),
        ((0.3, 0.4, 0.5), 9.0, 0, 5, []),  # a cone point: not on the axis, not checked
        ((0.25, 0.75, 0.5), 0.25, 1, 0, [left_upper, back]),
    ]
    offsets = [0]
    for row in rows:
        offsets.append(offsets[-1] + len(row[4]))

    def data_array(name, kind, values):
        if binary:
            body = array.array(TYPE_CODES[kind], values).tobytes()
            text = base64.b64encode(struct.pack("=Q", len(body)) + body).decode()
        else:
            text = " ".join(map(repr, values))
        return '<DataArray type="%s" Name="%s" format="%s">%s</DataArray>' % (
            kind, name, "binary" if binary else "ascii", text)

    flat = lambda lists: [x for row in lists for x in row]
    order = "LittleEndian" if sys.byteorder == "little" else "BigEndian"
    return ('<VTKFile type="PolyData" byte_order="%s" header_type="UInt64"><PolyData><FieldData>' % order
            + data_array("governor_offset", "Int64", offsets)
            + data_array("governor", "Int64", flat(r[4] for r in rows))
            + data_array("site_counts", "Int64", [8, len(edges), len(triangles)])
            + data_array("solid_points", "Float64", flat(points))
            + data_array("solid_edges", "Int64", flat(edges))
            + data_array("solid_triangles", "Int64", flat(triangles))
            + "</FieldData><Piece><PointData>"
            + data_array("radius", "Float64", [r[1] for r in rows])
            + data_array("on_axis", "UInt8", [r[2] for r in rows])
            + data_array("kind", "UInt8", [r[3] for r in rows])
            + "</PointData><Points>" + data_array("Points", "Float64", flat(r[0] for r in rows))
            + "</Points><Polys>" + data_array("connectivity", "Int64", [0, 1, 4])
            + "</Polys></Piece></PolyData></VTKFile>")


def spoiled(axis):
    """(what is wrong, a copy of the data with that wrong)."""
    diagonal = math.dist(*[[f(p[k] for p in axis.solid_points) for k in range(3)] for f in (min, max)])
    ties = [i for i in range(len(axis.points)) if axis.on_axis[i] and axis.kind[i] in KINDS_ON_TIES]
    if not ties:
        raise Unreadable("no vertex on a tie: nothing to spoil")
    i = max(ties, key=lambda t: axis.radius[t])
    begin = axis.governor_offset[i]
    far = max(range(axis.site_counts[0]),
              key=lambda v: math.dist(axis.solid_points[v], axis.points[i]))
    for step in (1e-3, -1e-3, 1e-8, -1e-8):
        bad = copy.deepcopy(axis)
        bad.radius[i] += step * diagonal
        yield "radius changed by %g of the diagonal" % step, bad
    bad = copy.deepcopy(axis)
    bad.points[i] = tuple(x + 1e-3 * diagonal for x in bad.points[i])
    yield "vertex moved", bad
    bad = copy.deepcopy(axis)
    bad.governor[begin] = far
    yield "governor replaced by a far vertex", bad
    bad = copy.deepcopy(axis)
    bad.governor[begin] = sum(axis.site_counts)
    yield "governor that does not exist", bad
    bad = copy.deepcopy(axis)
    for k in range(begin, bad.governor_offset[i + 1]):
        bad.governor[k] = bad.governor[begin]
    yield "one governor only, claimed twice", bad
    bad = copy.deepcopy(axis)
    bad.radius[i] = math.nan
    yield "radius not a number", bad
    bad = copy.deepcopy(axis)
    bad.solid_points[0] = tuple(x + 1e-12 * diagonal for x in bad.solid_points[0])
    yield "solid that is not the model's", bad
    bad = copy.deepcopy(axis)
    bad.solid_triangles[0] = bad.solid_triangles[-1]
    yield "solid with one triangle twice and one missing", bad
    bad = copy.deepcopy(axis)
    bad.on_axis = [0] * len(bad.on_axis)
    yield "no vertex on the axis", bad


def must_pass_then_fail(axis, model, what):
    good = True
    failures, report = check(axis, model)
    if failures.count:
        print("self-test: %s: good data refused: %s" % (what, failures.messages[0]), file=sys.stderr)
        good = False
    for wrong, bad in spoiled(axis):
        if not check(bad, model)[0].count:
            print("self-test: %s: not noticed: %s" % (what, wrong), file=sys.stderr)
            good = False
    return good


def formats_agree():
    """One tetrahedron in every format and flavour gives the same triangles."""
    points = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.5, 0.0), (0.0, 0.0, 2.0)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    lines = lambda rows: "\n".join(" ".join(map(str, row)) for row in rows) + "\n"
    ply = ("ply\nformat %s 1.0\ncomment x\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n")
    corners = [[points[i] for i in f] for f in faces]
    flavours = {
        "a.off": ("OFF 4 4 0\n" + lines(points) + lines([(3, *f) for f in faces])).encode(),
        "a.obj": (lines([("v", *p) for p in points])
                  + lines([("f", *("%d/1/1" % (i + 1) for i in f)) for f in faces])).encode(),
        "a.ply": (ply % "ascii" + lines(points) + lines([(3, *f) for f in faces])).encode(),
        "b.ply": (ply % "binary_little_endian").encode()
        + b"".join(struct.pack("<3f", *p) for p in points)
        + b"".join(struct.pack("<B3i", 3, *f) for f in faces),
        "a.stl": ("solid\n" + "".join("facet normal 0 0 0\nouter loop\n"
                                      + lines([("vertex", *p) for p in c])
                                      + "endloop\nendfacet\n" for c in corners)
                  + "endsolid\n").encode(),
        "b.stl": bytes(80) + struct.pack("<I", 4)
        + b"".join(struct.pack("<12fH", 0, 0, 0, *c[0], *c[1], *c[2], 0) for c in corners),
    }
    good = True
    with tempfile.TemporaryDirectory() as folder:
        for name, data in flavours.items():
            path = os.path.join(folder, name)
            with open(path, "wb") as file:
                file.write(data)
            got_points, got_faces = read_model(path)
            if [[got_points[i] for i in f] for f in got_faces] != corners:
                print("self-test: %s is not read right" % name, file=sys.stderr)
                good = False
    return good


def self_test(arguments):
    good = True
    with tempfile.TemporaryDirectory() as folder:
        model_file = os.path.join(folder, "cube.off")
        with open(model_file, "w") as file:
            file.write(CUBE_OFF)
        for binary in (False, True):
            vtp_file = os.path.join(folder, "cube.vtp")
            with open(vtp_file, "w") as file:
                file.write(cube_vtp(binary))
            good &= must_pass_then_fail(Axis(vtp_file), read_model(model_file),
                                        "binary" if binary else "ascii")
    tetrahedron = [((0, 0, 0), (1, 0, 0), (0, 1, 0))]
    for p, expected in (((0.25, 0.25, 2), 4), ((-1, -1, 0), 2), ((1, 1, 0), 0.5), ((3, 0, 0), 4)):
        if abs(squared_to_triangle(p, tetrahedron[0]) - expected) > 1e-15:
            print("self-test: distance from %s" % (p,), file=sys.stderr)
            good = False
    good &= formats_agree()
    if arguments.vtp and arguments.model:
        good &= must_pass_then_fail(Axis(arguments.vtp), read_model(arguments.model), arguments.vtp)
    print("self-test %s" % ("passed" if good else "FAILED"))
    return 0 if good else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("vtp", nargs="?")
    parser.add_argument("model", nargs="?")
    parser.add_argument("--tolerance", type=float, default=1e-9, help="of the diagonal")
    parser.add_argument("--sample", type=int, help="check so many vertices instead of all")
    parser.add_argument("--min-feet", type=float, default=1e-7,
                        help="least distance between two feet on a tie, in radii; models with "
                             "nearly coplanar faces have ties below any bound")
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    try:
        if arguments.self_test:
            return self_test(arguments)
        if not arguments.model:
            parser.error("PREFIX.vtp and MODEL are needed")
        failures, report = check(Axis(arguments.vtp), read_model(arguments.model),
                                 arguments.tolerance, arguments.sample, arguments.min_feet)
    except Unreadable as error:
        print("check_radius: %s" % error, file=sys.stderr)
        return 2
    for message in failures.messages:
        print("check_radius: %s: %s" % (arguments.vtp, message), file=sys.stderr)
    if failures.count:
        print("check_radius: %s: %d failure(s)" % (arguments.vtp, failures.count), file=sys.stderr)
        return 1
    print("check_radius: ok: %d vertices on the axis, %d governors, %d inside; "
          "largest error %.2e of the diagonal" %
          (report.vertices, report.governors, report.inside, report.worst))
    return 0


if __name__ == "__main__":
    sys.exit(main())
