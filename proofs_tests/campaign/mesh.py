"""Polygon meshes with double coordinates, and their topology by exact integers.

Shares nothing with the library: what a run is expected to find is computed here.
"""

import math
import random


class Mesh:
    """Outward faces, each a loop of at least three indices into points (tuples of floats)."""

    def __init__(self, points, faces):
        self.points = [tuple(float(x) for x in p) for p in points]
        self.faces = [list(f) for f in faces]

    def off(self):
        lines = ["OFF", f"{len(self.points)} {len(self.faces)} 0"]
        lines += ["%r %r %r" % p for p in self.points]
        lines += [" ".join(map(str, [len(f), *f])) for f in self.faces]
        return "\n".join(lines) + "\n"

    @staticmethod
    def from_off(text):
        words = iter(text.split())
        if next(words) != "OFF":
            raise ValueError("not an OFF file of this tool")
        points, faces, _ = (int(next(words)) for _ in range(3))
        return Mesh([tuple(float(next(words)) for _ in range(3)) for _ in range(points)],
                    [[int(next(words)) for _ in range(int(next(words)))] for _ in range(faces)])

    def compact(self):
        """Without unused vertices; the order of the others stays."""
        used = sorted({v for f in self.faces for v in f})
        name = {v: i for i, v in enumerate(used)}
        return Mesh([self.points[v] for v in used], [[name[v] for v in f] for f in self.faces])


def integers(points):
    """The same points times a power of two, as exact integers."""
    ratios = [[x.as_integer_ratio() for x in p] for p in points]
    scale = max((d for p in ratios for _, d in p), default=1)
    return [tuple(n * (scale // d) for n, d in p) for p in ratios]


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def volume(a, b, c, d):
    """Six times the signed volume: positive if abc is counterclockwise seen from d."""
    return dot(cross(sub(b, a), sub(c, a)), sub(d, a))


def normal(points, face):
    """Newell's normal: twice the vector area."""
    base, n = points[face[0]], (0, 0, 0)
    for a, b in zip(face[1:], face[2:]):
        c = cross(sub(points[a], base), sub(points[b], base))
        n = (n[0] + c[0], n[1] + c[1], n[2] + c[2])
    return n


def edge_faces(faces):
    """Face of each directed edge; None where an edge occurs twice in one direction."""
    owner = {}
    for i, face in enumerate(faces):
        for a, b in zip(face, face[1:] + face[:1]):
            if a == b or (a, b) in owner:
                return None
            owner[a, b] = i
    return owner


class Disjoint:
    def __init__(self, n):
        self.parent = list(range(n))

    def find(self, i):
        while self.parent[i] != i:
            self.parent[i] = self.parent[self.parent[i]]
            i = self.parent[i]
        return i

    def join(self, i, j):
        self.parent[self.find(i)] = self.find(j)


def shells(mesh):
    """Lists of faces joined by edges, or None: not closed, oriented and vertex-manifold."""
    owner = edge_faces(mesh.faces)
    if owner is None or any((b, a) not in owner for a, b in owner):
        return None
    joined = Disjoint(len(mesh.faces))
    degree, fans = {}, {}
    for (a, b), face in owner.items():
        joined.join(face, owner[b, a])
        degree[a] = degree.get(a, 0) + 1
        fans[a] = b
    for v, first in fans.items():  # one turn about v has to meet all of its edges
        w, count = first, 0
        while True:
            face = mesh.faces[owner[v, w]]
            w = face[face.index(v) - 1]
            count += 1
            if w == first or count > degree[v]:
                break
        if count != degree[v]:
            return None
    groups = {}
    for i in range(len(mesh.faces)):
        groups.setdefault(joined.find(i), []).append(i)
    return list(groups.values())


def triangles(points, faces):
    """By fans, without empty ones: enough for signed volumes and crossings where faces are planar or
    nearly so."""
    fans = [(points[f[0]], points[b], points[c]) for f in faces for b, c in zip(f[1:], f[2:])]
    return [t for t in fans if normal(t, (0, 1, 2)) != (0, 0, 0)]


def is_inside(point, triangle_list, rng):
    """Parity of the crossings of a random ray: exact. None for a point on the surface, or if no ray
    was in general position."""
    for _ in range(20):
        end = tuple(x + rng.randint(-10**6, 10**6) for x in point)
        crossings = 0
        for a, b, c in triangle_list:
            # Which side of the line are the triangle's edges on, and does the ray go towards it?
            sides = [volume(point, end, p, q) for p, q in ((a, b), (b, c), (c, a))]
            below = volume(a, b, c, point)
            if min(sides) < 0 < max(sides):
                continue
            if below == 0:
                return None
            if 0 in sides:
                crossings = None
                break
            direction = dot(normal((a, b, c), (0, 1, 2)), sub(end, point))
            crossings += (direction > 0) != (below > 0)
        if crossings is not None:
            return crossings % 2 == 1
    return None


def betti_numbers(mesh):
    """Of the solid that the mesh bounds, from the shells, their genus and their nesting; None if
    the mesh is no closed oriented manifold or its shells are not nested as their signs say."""
    groups = shells(mesh)
    if groups is None:
        return None
    points = integers(mesh.points)
    scene, genus = [], 0
    for group in groups:
        faces = [mesh.faces[i] for i in group]
        vertices = {v for f in faces for v in f}
        characteristic = len(vertices) - sum(map(len, faces)) // 2 + len(faces)
        genus += (2 - characteristic) // 2
        flat = triangles(points, faces)
        corners = [points[v] for v in sorted(vertices)]
        scene.append((sum(volume(corners[0], *t) for t in flat), corners, flat))
    rng = random.Random(1)
    for i, (signed, corners, _) in enumerate(scene):
        # A corner may lie in a fan's triangle beyond the polygon: then the next may tell.
        depth = [next((inside for corner in corners
                       if (inside := is_inside(corner, other[2], rng)) is not None), None)
                 for j, other in enumerate(scene) if j != i]
        if None in depth or signed == 0 or (signed > 0) != (sum(depth) % 2 == 0):
            return None
    outer = sum(signed > 0 for signed, _, _ in scene)
    return [outer, genus, len(scene) - outer]


def diagonal(points):
    return math.dist([min(p[k] for p in points) for k in range(3)],
                     [max(p[k] for p in points) for k in range(3)])
