"""Changes of a mesh: exact ones, which give the same solid in another guise, and rounded ones."""

import math
from fractions import Fraction

from facets import retriangulated
from mesh import Mesh, cross, dot, integers, normal, sub

AMOUNTS = [0, "ulp", 1e-15, 1e-12, 1e-9, 1e-6, 1e-3]


def each_vertex_moved(mesh, amount, rng):
    """Every coordinate by up to `amount`, or by -1, 0 or 1 units in the last place."""
    if amount == 0:
        return mesh

    def change(x):
        if amount == "ulp":
            if x == 0:
                return x + rng.choice([-1, 0, 1]) * 2.0**-53
            return math.nextafter(x, rng.choice([-math.inf, math.inf])) if rng.random() < 2 / 3 else x
        return x + rng.uniform(-amount, amount)

    return Mesh([tuple(map(change, p)) for p in mesh.points], mesh.faces)


def mapped(mesh, function):
    return Mesh([function(p) for p in mesh.points], mesh.faces)


def quaternion_matrix(a, b, c, d):
    return [[a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d]]


def apply(matrix, p):
    return tuple(sum(row[k] * p[k] for k in range(3)) for row in matrix)


def pythagorean(mesh, rng):
    """A rotation by a rational matrix times its denominator: exact, or None where coordinates have
    too many digits for that."""
    q = (0, 0, 0, 0)
    while sum(x != 0 for x in q) < 2:
        q = tuple(rng.randint(-3, 3) for _ in range(4))
    matrix = quaternion_matrix(*q)
    exact = integers(mesh.points)
    turned = [apply(matrix, p) for p in exact]
    largest = 1 << max(abs(x) for p in exact for x in p).bit_length()
    points = [tuple(x / largest for x in p) for p in turned]  # rounded once
    if any(Fraction(x) * largest != y for p, q in zip(points, turned) for x, y in zip(p, q)):
        return None
    return Mesh(points, mesh.faces)


def snapped(mesh, bits):
    """On a grid of 2^-bits of the extent."""
    extent = max(abs(x) for p in mesh.points for x in p)
    step = math.ldexp(1.0, math.frexp(extent)[1] - bits)
    return mapped(mesh, lambda p: tuple(round(x / step) * step for x in p))


def rounded_rotation(mesh, rng):
    q = [rng.gauss(0, 1) for _ in range(4)]
    length = math.hypot(*q)
    matrix = quaternion_matrix(*(x / length for x in q))
    return mapped(mesh, lambda p: apply(matrix, p))


def mirrored(mesh):
    return Mesh([(-x, y, z) for x, y, z in mesh.points], [f[::-1] for f in mesh.faces])


def offset(mesh, size, rng):
    d = [rng.choice([-1, 0, 1]) * size for _ in range(3)]
    d[rng.randrange(3)] = size
    return mapped(mesh, lambda p: tuple(x + y for x, y in zip(p, d)))


def reordered(mesh, rng):
    order = list(range(len(mesh.points)))
    rng.shuffle(order)
    faces = []
    for f in mesh.faces:
        k = rng.randrange(len(f))
        faces.append([order[v] for v in f[k:] + f[:k]])
    rng.shuffle(faces)
    points = [None] * len(order)
    for old, new in enumerate(order):
        points[new] = mesh.points[old]
    return Mesh(points, faces)


def split_edges(mesh, share, rng):
    """Exactly collinear vertices in the middle, or at another eighth, of random edges."""
    points, inserted = list(mesh.points), {}
    for face in mesh.faces:
        for a, b in zip(face, face[1:] + face[:1]):
            if a > b or rng.random() >= share:
                continue
            t = rng.choice([0.5, 0.5, 0.125, 0.75])
            p, q = mesh.points[a], mesh.points[b]
            new = tuple(x + t * (y - x) for x, y in zip(p, q))
            e, f, g = integers([p, q, new])
            if cross(sub(f, e), sub(g, e)) == (0, 0, 0) and g not in (e, f):
                inserted[a, b] = inserted[b, a] = len(points)
                points.append(new)
    faces = []
    for face in mesh.faces:
        loop = []
        for a, b in zip(face, face[1:] + face[:1]):
            loop.append(a)
            if (a, b) in inserted:
                loop.append(inserted[a, b])
        faces.append(loop)
    return Mesh(points, faces)


CHANGES = ["triangulate", "pythagorean", "rotation", "mirror", "offset6", "offset9", "scale", "order"]


def draw(rng):
    """None, one or several changes, in the order of CHANGES."""
    if rng.random() < 0.25:
        return []
    chosen = set(rng.sample(CHANGES, rng.choice([1, 1, 2, 3])))
    if {"pythagorean", "rotation"} <= chosen:
        chosen.remove(rng.choice(["pythagorean", "rotation"]))
    if {"offset6", "offset9"} <= chosen:
        chosen.remove(rng.choice(["offset6", "offset9"]))
    return [c for c in CHANGES if c in chosen]


def changed(mesh, names, rng):
    """The changed mesh, and the names with what was drawn."""
    done = []
    for name in names:
        if name in ("rotation", "offset6", "offset9") and any(len(f) > 3 for f in mesh.faces):
            mesh = retriangulated(mesh, rng)  # rounding would leave it to chance where polygons bend
        if name == "triangulate":
            mesh = retriangulated(mesh, rng)
        elif name == "pythagorean":
            turned = pythagorean(mesh, rng)
            if turned is None:
                turned = pythagorean(snapped(retriangulated(mesh, rng), 40), rng)
                name = "pythagorean of 40 bits"
            mesh = turned
        elif name == "rotation":
            mesh = rounded_rotation(mesh, rng)
        elif name == "mirror":
            mesh = mirrored(mesh)
        elif name == "scale":
            exponent = rng.choice([-60, -30, -10, -1, 1, 10, 30, 60])
            mesh = mapped(mesh, lambda p: tuple(math.ldexp(x, exponent) for x in p))
            name = f"scale 2^{exponent}"
        elif name == "order":
            mesh = reordered(mesh, rng)
        else:
            mesh = offset(mesh, 1e6 if name == "offset6" else 1e9, rng)
        done.append(name)
    return mesh, done
