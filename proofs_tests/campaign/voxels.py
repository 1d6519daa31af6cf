"""Solids made of the cells of a rectilinear grid."""

import itertools

from mesh import Mesh

SIDES = [  # axis, direction, corners of the side as offsets, outward
    (0, 1, [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)]),
    (0, -1, [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)]),
    (1, 1, [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)]),
    (1, -1, [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)]),
    (2, 1, [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]),
    (2, -1, [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)]),
]


def connected(octants):
    """Are these of the eight cells around a vertex connected through sides?"""
    if not octants:
        return True
    rest = set(octants)
    todo = [rest.pop()]
    while todo:
        c = todo.pop()
        for axis in range(3):
            d = tuple(1 - x if k == axis else x for k, x in enumerate(c))
            if d in rest:
                rest.remove(d)
                todo.append(d)
    return not rest


OCTANTS = list(itertools.product((0, 1), repeat=3))


def made_manifold(cells, sizes, rng):
    """Fills cells of the grid around vertices where the boundary would be pinched, until none is.
    (Around a vertex of the grid's border that ends with all cells inside, at the latest.)"""
    cells = set(cells)
    todo = {tuple(c + o for c, o in zip(cell, octant)) for cell in cells for octant in OCTANTS}
    while todo:
        v = min(todo)
        todo.remove(v)
        around = {o: tuple(x - 1 + y for x, y in zip(v, o)) for o in OCTANTS}
        full = {o for o, c in around.items() if c in cells}
        if connected(full) and connected(set(OCTANTS) - full):
            continue
        new = rng.choice([c for o, c in sorted(around.items()) if o not in full
                          and all(0 <= x < n for x, n in zip(c, sizes))])
        cells.add(new)
        todo |= {tuple(c + o for c, o in zip(new, octant)) for octant in OCTANTS}
    return cells


def surface(cells, planes):
    """Squares between full and empty cells; `planes[axis]` maps a grid index to a coordinate."""
    index, points, faces = {}, [], []
    for cell in sorted(cells):
        for axis, direction, corners in SIDES:
            if tuple(x + direction * (k == axis) for k, x in enumerate(cell)) in cells:
                continue
            face = []
            for corner in corners:
                v = tuple(x + y for x, y in zip(cell, corner))
                if v not in index:
                    index[v] = len(points)
                    points.append(tuple(planes[k][v[k]] for k in range(3)))
                face.append(index[v])
            faces.append(face)
    return Mesh(points, faces)


def of_pattern(full, sizes, planes, rng):
    """The cells for which full(i, j, k), made manifold."""
    cells = {c for c in itertools.product(*map(range, sizes)) if full(*c)}
    return surface(made_manifold(cells, sizes, rng), planes)


def unit_planes(sizes):
    return [list(range(n + 1)) for n in sizes]
