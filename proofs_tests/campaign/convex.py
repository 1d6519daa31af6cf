"""Prisms and their relatives, Platonic and Archimedean solids, geodesic spheres; hulls."""

import itertools
import math

from mesh import Mesh, cross, dot, integers, sub, volume

GOLDEN = (1 + math.sqrt(5)) / 2


def ring(n, radius=1.0, z=0.0, turn=0.0):
    return [(radius * math.cos(2 * math.pi * (i + turn) / n),
             radius * math.sin(2 * math.pi * (i + turn) / n), z) for i in range(n)]


def prism(n, height):
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return Mesh(ring(n) + ring(n, z=height),
                [list(range(n - 1, -1, -1)), list(range(n, 2 * n)), *sides])


def antiprism(n, height):
    sides = []
    for i in range(n):
        j = (i + 1) % n
        sides += [[i, j, n + i], [j, n + j, n + i]]
    return Mesh(ring(n) + ring(n, z=height, turn=0.5),
                [list(range(n - 1, -1, -1)), list(range(n, 2 * n)), *sides])


def pyramid(n, height):
    return Mesh(ring(n) + [(0, 0, height)],
                [list(range(n - 1, -1, -1))] + [[i, (i + 1) % n, n] for i in range(n)])


def bipyramid(n, up, down):
    sides = [[i, (i + 1) % n, n] for i in range(n)] + [[(i + 1) % n, i, n + 1] for i in range(n)]
    return Mesh(ring(n) + [(0, 0, up), (0, 0, -down)], sides)


def schoenhardt(twist, height):
    """A triangular prism twisted by `twist` (in turns of a third, 0 to 1/2) with its sides folded in:
    no tetrahedralisation without new vertices."""
    sides = []
    for i in range(3):
        j = (i + 1) % 3
        sides += [[i, j, 3 + i], [j, 3 + j, 3 + i]]
    return Mesh(ring(3) + ring(3, z=height, turn=-twist), [[2, 1, 0], [3, 4, 5], *sides])


def geodesic(frequency):
    """An icosahedron with each face cut in frequency^2 triangles, put on the unit sphere."""
    base = hull(PLATONIC["icosahedron"]())
    index, points, faces = {}, [], []

    def vertex(face, i, j, k):
        weights = sorted((v, w) for v, w in zip(face, (i, j, k)) if w)
        if tuple(weights) not in index:
            p = [sum(w * base.points[v][axis] for v, w in weights) for axis in range(3)]
            length = math.hypot(*p)
            index[tuple(weights)] = len(points)
            points.append(tuple(x / length for x in p))
        return index[tuple(weights)]

    f = frequency
    for face in base.faces:
        for i in range(f):
            for j in range(f - i):
                k = f - 1 - i - j
                faces.append([vertex(face, i + 1, j, k), vertex(face, i, j + 1, k),
                              vertex(face, i, j, k + 1)])
                if k > 0:
                    faces.append([vertex(face, i + 1, j + 1, k - 1), vertex(face, i, j + 1, k),
                                  vertex(face, i + 1, j, k)])
    mesh = Mesh(points, faces)
    a, b, c = (mesh.points[v] for v in mesh.faces[1])
    if dot(cross(sub(b, a), sub(c, a)), a) < 0:
        raise AssertionError("turned inside out")
    return mesh


def hull(given):
    """The convex hull of the points as the doubles they are, by exact signs, in triangles. The order
    of the points chooses the triangulation of facets. Points inside are dropped."""
    points = integers(given)
    start = first_tetrahedron(points)
    a, b, c, d = start
    if volume(*(points[i] for i in start)) > 0:
        a, b = b, a
    faces = {(a, b, c), (a, c, d), (a, d, b), (b, d, c)}
    for v in range(len(points)):
        if v in start:
            continue
        seen = {f for f in faces if volume(*(points[i] for i in f), points[v]) > 0}
        edges = {e for f in seen for e in zip(f, f[1:] + f[:1])}
        faces -= seen
        faces |= {(a, b, v) for a, b in edges if (b, a) not in edges}
    return Mesh(given, [list(f) for f in sorted(faces)]).compact()


def first_tetrahedron(points):
    for quadruple in itertools.combinations(range(len(points)), 4):
        if volume(*(points[i] for i in quadruple)) != 0:
            return quadruple
    raise ValueError("the points are in one plane")


def signs(*point):
    return {tuple(s * x for s, x in zip(sign, point))
            for sign in itertools.product((1, -1), repeat=3)}


def cyclic(*point):
    return {q for i in range(3) for q in signs(*(point[i:] + point[:i]))}


def permuted(*point):
    return {q for p in itertools.permutations(point) for q in signs(*p)}


def even(parity, *point):
    """Even (0) or odd (1) permutations with an even or odd number of minus signs: chiral cubes."""
    out = set()
    for order in itertools.permutations(range(3)):
        swaps = sum(order[i] > order[j] for i in range(3) for j in range(i))
        for sign in itertools.product((1, -1), repeat=3):
            if (swaps + sign.count(-1)) % 2 == parity:
                out.add(tuple(s * point[i] for s, i in zip(sign, order)))
    return out


def tribonacci():
    x = 1.8
    for _ in range(60):
        x -= (x**3 - x**2 - x - 1) / (3 * x**2 - 2 * x - 1)
    return x


def truncated_tetrahedron():
    return {p for p in permuted(3, 1, 1) if math.prod(p) > 0}


PLATONIC = {
    "tetrahedron": lambda: {p for p in signs(1, 1, 1) if math.prod(p) > 0},
    "cube": lambda: signs(1, 1, 1),
    "octahedron": lambda: permuted(1, 0, 0),
    "icosahedron": lambda: cyclic(0.0, 1.0, GOLDEN),
    "dodecahedron": lambda: signs(1, 1, 1) | cyclic(0.0, 1 / GOLDEN, GOLDEN),
}

PHI = GOLDEN
ARCHIMEDEAN = {
    "truncated_tetrahedron": truncated_tetrahedron,
    "cuboctahedron": lambda: permuted(1, 1, 0),
    "truncated_cube": lambda: permuted(math.sqrt(2) - 1, 1, 1),
    "truncated_octahedron": lambda: permuted(0, 1, 2),
    "rhombicuboctahedron": lambda: permuted(1, 1, 1 + math.sqrt(2)),
    "truncated_cuboctahedron": lambda: permuted(1, 1 + math.sqrt(2), 1 + 2 * math.sqrt(2)),
    "snub_cube": lambda: even(0, 1, 1 / tribonacci(), tribonacci()),
    "icosidodecahedron": lambda: cyclic(0.0, 0.0, 2 * PHI) | cyclic(1.0, PHI, PHI**2),
    "truncated_dodecahedron": lambda: (cyclic(0.0, 1 / PHI, 2 + PHI) | cyclic(1 / PHI, PHI, 2 * PHI)
                                       | cyclic(PHI, 2.0, PHI + 1)),
    "truncated_icosahedron": lambda: (cyclic(0.0, 1.0, 3 * PHI) | cyclic(1.0, 2 + PHI, 2 * PHI)
                                      | cyclic(PHI, 2.0, 2 * PHI + 1)),
    "rhombicosidodecahedron": lambda: (cyclic(1.0, 1.0, PHI**3) | cyclic(PHI**2, PHI, 2 * PHI)
                                       | cyclic(2 + PHI, 0.0, PHI**2)),
    "truncated_icosidodecahedron": lambda: (
        cyclic(1 / PHI, 1 / PHI, 3 + PHI) | cyclic(2 / PHI, PHI, 1 + 2 * PHI)
        | cyclic(1 / PHI, PHI**2, 3 * PHI - 1) | cyclic(2 * PHI - 1, 2.0, 2 + PHI)
        | cyclic(PHI, 3.0, 2 * PHI)),
}


def of_points(points, rng):
    points = sorted(points)
    rng.shuffle(points)
    return hull(points)
