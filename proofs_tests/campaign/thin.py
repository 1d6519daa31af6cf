"""Solids with tiny gaps, walls, spikes and fins; saddle vertices; facets with holes."""

import math

from convex import hull, of_points, ring
from facets import triangulate
from mesh import Mesh, integers
from voxels import of_pattern


def steps(rng, sizes):
    """Planes of a grid from the sizes of its cells."""
    planes = [0.0]
    for size in sizes:
        planes.append(planes[-1] + size)
    return planes


def join(*meshes):
    points, faces = [], []
    for mesh in meshes:
        faces += [[v + len(points) for v in f] for f in mesh.faces]
        points += mesh.points
    return Mesh(points, faces)


def turned(mesh):
    return Mesh(mesh.points, [f[::-1] for f in mesh.faces])


def moved(mesh, offset):
    return Mesh([tuple(x + d for x, d in zip(p, offset)) for p in mesh.points], mesh.faces)


def box(low, high):
    planes = [(a, b) for a, b in zip(low, high)]
    return of_pattern(lambda *_: True, (1, 1, 1), planes, None)


def slit(rng, width, deep, wide):
    """Two blocks `width` apart, joined by `deep` of three floors (0: apart, 2 components)."""
    planes = [[0, 1, 1 + width, 2 + width], [0, 1], steps(rng, [0.5, 0.5, 0.5])]
    if wide:
        planes[1] = [0, 0.5, 1.25]
    sizes = [3, len(planes[1]) - 1, 3]
    return of_pattern(lambda i, j, k: i != 1 or k < deep, sizes, planes, rng)


def thin_wall(rng, width, rooms):
    """`rooms` voids in a row, the last one `width` from the outside, and `width` apart."""
    sizes = [1.0]
    for _ in range(rooms):
        sizes += [rng.choice([0.5, 1.0, 1.5]), width]
    planes = [steps(rng, sizes), [0, 1, 2, 3], [0, 1, 2, 3]]
    return of_pattern(lambda i, j, k: not (i % 2 == 1 and j == 1 and k == 1),
                      [len(sizes), 3, 3], planes, rng)


def nested(rng, levels, margins):
    """Boxes in boxes, alternately solid and void, `margins[level]` apart."""
    meshes, at, size = [], 0.0, 4.0
    for level in range(levels):
        shell = box([at] * 3, [size - at] * 3)
        meshes.append(shell if level % 2 == 0 else turned(shell))
        at += margins[level]
    return join(*meshes)


def tip_void(rng, distance, many):
    """A box with a void whose vertex is `distance` from the top."""
    points = [(0, 0, 0)] + [(x, y, -z) for x, y, z in ring(many, 0.5, 0.75)]
    if rng.random() < 0.5:
        points.append((0, 0, -1.5))
    void = moved(of_points(points, rng), (1.0, 1.0, 2 - distance))
    return join(box((0, 0, 0), (2, 2, 2)), turned(void))


def fins(rng, count, thickness):
    sizes = []
    for _ in range(count):
        sizes += [rng.choice([0.25, 0.5]), thickness]
    sizes.append(0.25)
    planes = [steps(rng, sizes), [0, 1], steps(rng, [0.5, 0.5, 0.25, 0.25])]
    height = [rng.randint(2, 4) for _ in sizes]
    return of_pattern(lambda i, j, k: k == 0 or (i % 2 == 1 and k < height[i]),
                      [len(sizes), 1, 4], planes, rng)


def saddle(valence, amplitude, rng):
    """A vertex with `valence` edges, alternately up and down, on a column."""
    rim = [(x, y, amplitude * (1 if i % 2 else -1)) for i, (x, y, _) in enumerate(ring(valence))]
    low = [(x, y, -2.0) for x, y, _ in ring(valence)]
    n, faces = valence, []
    for i in range(n):
        j = (i + 1) % n
        faces.append([2 * n, i, j])
        faces += rng.choice([[[n + i, n + j, i], [n + j, j, i]], [[n + i, n + j, j], [n + i, j, i]]])
    faces.append([n + i for i in range(n - 1, -1, -1)])
    return Mesh(rim + low + [(0, 0, 0)], faces)


def with_holes(rng, outline, holes, height, floors):
    """The outline extruded to `height` with a hole for each loop, down to `floors[i]` (0: through).
    Loops are lists of plane points: the outline counterclockwise, holes clockwise."""
    loops, points = [], []
    for loop in [outline, *holes]:
        loops.append(list(range(len(points), len(points) + len(loop))))
        points += loop
    n = len(points)
    plane = [p[:2] for p in integers([(x, y, 0.0) for x, y in points])]
    floor = [0.0] * len(outline) + [f for loop, f in zip(holes, floors) for _ in loop]
    top = triangulate(loops, plane.__getitem__, rng)
    through = [loop for loop, f in zip(loops[1:], floors) if f == 0]
    base = triangulate([loops[0], *through], plane.__getitem__, rng)
    if top is None or base is None:
        raise ValueError("loops that cross")
    faces = [[n + v for v in t] for t in top] + [[a, c, b] for a, b, c in base]
    for loop in loops:
        faces += [[a, b, n + b, n + a] for a, b in zip(loop, loop[1:] + loop[:1])]
    faces += [loop[::-1] for loop, f in zip(loops[1:], floors) if f != 0]
    low = [(x, y, z) for (x, y), z in zip(points, floor)]
    return Mesh(low + [(x, y, height) for x, y in points], faces)


def polygon_hole(n, center, radius, turn):
    """Clockwise."""
    return [(center[0] + x, center[1] + y) for x, y, _ in ring(n, radius, turn=turn)][::-1]


def needle(rng, n, aspect):
    """A spike: a hull of a small ring and far points on the axis."""
    points = [(x / aspect, y / aspect, 0.0) for x, y, _ in ring(n)]
    ends = rng.choice(["spike", "double", "bar", "oblique"])
    if ends == "bar":
        points += [(x, y, 1.0) for x, y, _ in points]
    elif ends == "oblique":
        points += [(rng.uniform(-1, 1), rng.uniform(-1, 1), 1.0)]
    else:
        points += [(0, 0, 1.0)] + ([(0, 0, -rng.choice([0.5, 1.0]))] if ends == "double" else [])
    return ends, of_points(points, rng) if rng.random() < 0.5 else hull(points)


def log_uniform(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))
