"""The families of models: each draws its parameters and gives (mesh, parameters)."""

import math
import random

import change
import convex
import thin
from facets import merged, retriangulated
from mesh import Mesh, betti_numbers
from thin import log_uniform
from voxels import of_pattern, unit_planes

FAMILIES = {}


def family(function):
    FAMILIES[function.__name__] = function
    return function


def planes_of(rng, sizes):
    """Integer steps, sometimes all 1."""
    if rng.random() < 0.5:
        return unit_planes(sizes)
    return [thin.steps(rng, [rng.choice([1, 1, 2, 3]) for _ in range(n)]) for n in sizes]


def tidied(mesh, rng, parameters):
    """Squares as they are, merged to polygons, or partly so."""
    how = rng.choice(["squares", "merged", "merged", "partly merged"])
    parameters["facets"] = how
    return mesh if how == "squares" else merged(mesh, rng, 1.0 if how == "merged" else 0.5)


def perturbed(mesh, rng, parameters):
    """Each vertex moved; polygons are triangulated before, or bend."""
    amount = rng.choice(change.AMOUNTS)
    parameters["moved"] = amount
    if amount != 0 and rng.random() < 0.7:
        parameters["triangulated"] = True
        mesh = retriangulated(mesh, rng)
    return change.each_vertex_moved(mesh, amount, rng), parameters


# ---- grids


@family
def boxes(rng):
    n = rng.randint(1, 4)
    sizes = [rng.randint(2, 4) for _ in range(3)]
    chosen = []
    for _ in range(n):
        low = [rng.randrange(s) for s in sizes]
        chosen.append((low, [rng.randint(a + 1, s) for a, s in zip(low, sizes)]))
    p = {"boxes": chosen}

    def full(*cell):
        return any(all(a <= x < b for a, x, b in zip(low, cell, high)) for low, high in chosen)

    return tidied(of_pattern(full, sizes, planes_of(rng, sizes), rng), rng, p), p


@family
def extrusion(rng):
    sizes = [rng.randint(2, 6), rng.randint(2, 6), 1]
    density = rng.choice([0.5, 0.7, 0.85])
    cells = {(i, j) for i in range(sizes[0]) for j in range(sizes[1]) if rng.random() < density}
    cells = cells or {(0, 0)}
    p = {"sizes": sizes, "density": density}
    mesh = of_pattern(lambda i, j, k: (i, j) in cells, sizes, planes_of(rng, sizes), rng)
    return tidied(mesh, rng, p), p


def menger_full(level, cell):
    for _ in range(level):
        if sum(x % 3 == 1 for x in cell) >= 2:
            return False
        cell = [x // 3 for x in cell]
    return True


@family
def menger(rng):
    level = 2 if rng.random() < 0.1 else 1
    n = 3**level
    p = {"level": level}
    planes = planes_of(rng, [n] * 3) if rng.random() < 0.5 else unit_planes([n] * 3)
    return tidied(of_pattern(lambda *c: menger_full(level, c), [n] * 3, planes, rng), rng, p), p


@family
def lattice(rng):
    sizes = [2 * rng.randint(1, 3) + 1 for _ in range(3)]
    missing = rng.choice([0, 0, 0.1, 0.3])
    p = {"sizes": sizes, "missing": missing}

    def full(*cell):
        odd = sum(x % 2 for x in cell)
        return odd == 0 or (odd == 1 and rng.random() >= missing)

    return tidied(of_pattern(full, sizes, planes_of(rng, sizes), rng), rng, p), p


# ---- convex, and each vertex moved


@family
def prism(rng):
    p = {"n": rng.randint(3, 64), "height": rng.choice([0.1, 0.5, 1.0, 2.0, 5.0])}
    return perturbed(convex.prism(p["n"], p["height"]), rng, p)


@family
def antiprism(rng):
    p = {"n": rng.randint(3, 64), "height": rng.choice([0.1, 0.5, 1.0, 2.0])}
    return perturbed(convex.antiprism(p["n"], p["height"]), rng, p)


@family
def pyramid(rng):
    p = {"n": rng.randint(3, 64), "height": rng.choice([0.1, 0.5, 1.0, 2.0, 5.0])}
    return perturbed(convex.pyramid(p["n"], p["height"]), rng, p)


@family
def bipyramid(rng):
    up = rng.choice([0.25, 1.0, 2.0])
    p = {"n": rng.randint(3, 64), "up": up, "down": rng.choice([up, 0.5])}
    return perturbed(convex.bipyramid(p["n"], up, p["down"]), rng, p)


@family
def cone(rng):
    p = {"n": 64, "height": log_uniform(rng, 0.05, 20), "tips": rng.choice([1, 2])}
    mesh = (convex.pyramid(64, p["height"]) if p["tips"] == 1
            else convex.bipyramid(64, p["height"], p["height"]))
    return perturbed(mesh, rng, p)


def from_points(table, rng):
    name = rng.choice(sorted(table))
    p = {"name": name}
    points = [tuple(map(float, q)) for q in sorted(table[name]())]
    if rng.random() < 0.5:  # the hull of the moved points: convex still
        p["moved"] = rng.choice(change.AMOUNTS)
        p["hull"] = "of the moved points"
        cloud = change.each_vertex_moved(Mesh(points, []), p["moved"], rng)
        return convex.of_points(cloud.points, rng), p
    return perturbed(merged(convex.of_points(points, rng), rng), rng, p)


@family
def platonic(rng):
    return from_points(convex.PLATONIC, rng)


@family
def archimedean(rng):
    return from_points(convex.ARCHIMEDEAN, rng)


@family
def geodesic(rng):
    p = {"frequency": rng.choice([1, 2, 2, 3, 3, 4, 5])}
    return perturbed(convex.geodesic(p["frequency"]), rng, p)


@family
def schoenhardt(rng):
    p = {"twist": rng.choice([0.05, 0.125, 0.25, 0.35]), "height": rng.choice([0.5, 1.0, 2.0])}
    return perturbed(convex.schoenhardt(p["twist"], p["height"]), rng, p)


# ---- thin, near, sharp


@family
def thin_plate(rng):
    aspect = log_uniform(rng, 1e3, 1e9)
    sizes = [rng.randint(1, 3), rng.randint(1, 3), 1]
    p = {"aspect": aspect, "sizes": sizes}
    planes = [*unit_planes(sizes[:2]), [0, sizes[0] / aspect]]
    hole = rng.choice([None, (rng.randrange(sizes[0]), rng.randrange(sizes[1]))])
    if sizes[:2] == [1, 1]:
        hole = None
    mesh = of_pattern(lambda i, j, k: (i, j) != hole, sizes, planes, rng)
    return tidied(mesh, rng, p), p


@family
def needle(rng):
    p = {"n": rng.randint(3, 12), "aspect": log_uniform(rng, 1e3, 1e9)}
    p["ends"], mesh = thin.needle(rng, p["n"], p["aspect"])
    return mesh, p


def tiny(rng):
    return rng.choice([1e-9, 1e-9, 2.0**-30, log_uniform(rng, 1e-9, 1e-3)])


@family
def gap(rng):
    p = {"gap": tiny(rng), "deep": rng.randint(0, 2), "wide": rng.random() < 0.3}
    return tidied(thin.slit(rng, p["gap"], p["deep"], p["wide"]), rng, p), p


@family
def wall(rng):
    p = {"wall": tiny(rng), "rooms": rng.randint(1, 2)}
    return tidied(thin.thin_wall(rng, p["wall"], p["rooms"]), rng, p), p


@family
def voids(rng):
    if rng.random() < 0.5:
        levels = rng.randint(2, 5)
        margins = [rng.choice([0.25, 0.3, tiny(rng)]) for _ in range(levels)]
        p = {"levels": levels, "margins": margins}
        return thin.nested(rng, levels, margins), p
    p = {"distance": tiny(rng), "tip": rng.randint(3, 16)}
    return thin.tip_void(rng, p["distance"], p["tip"]), p


@family
def fins(rng):
    p = {"count": rng.randint(1, 6), "thickness": log_uniform(rng, 1e-6, 0.1)}
    return tidied(thin.fins(rng, p["count"], p["thickness"]), rng, p), p


@family
def saddle(rng):
    p = {"valence": 2 * rng.randint(2, 16), "amplitude": rng.choice([0.01, 0.1, 0.5, 1.0])}
    return perturbed(thin.saddle(p["valence"], p["amplitude"], rng), rng, p)


@family
def holes(rng):
    nx, ny = rng.randint(1, 3), rng.randint(1, 2)
    loops, floors, p = [], [], {"grid": [nx, ny], "holes": []}
    for i in range(nx):
        for j in range(ny):
            n, blind = rng.randint(3, 12), rng.random() < 0.4
            radius = rng.choice([0.25, 0.4, 0.49, 0.5 - tiny(rng)])
            loops.append(thin.polygon_hole(n, (i + 0.5, j + 0.5), radius, rng.choice([0, 0.5, 0.3])))
            floors.append(rng.choice([0.125, 0.25, tiny(rng)]) if blind else 0)
            p["holes"].append([n, radius, floors[-1]])
    outline = [(0, 0), (nx, 0), (nx, ny), (0, ny)]
    return thin.with_holes(rng, outline, loops, 0.5, floors), p


@family
def collinear(rng):
    name = rng.choice(["boxes", "extrusion", "lattice", "prism", "fins", "schoenhardt"])
    mesh, p = FAMILIES[name](rng)
    p["of"], p["share"] = name, rng.choice([0.2, 0.5, 1.0])
    return change.split_edges(mesh, p["share"], rng), p


def generate(name, seed):
    """(mesh, parameters, expected Betti numbers or None): a function of its arguments alone."""
    rng = random.Random(f"{name}/{seed}")
    mesh, parameters = FAMILIES[name](rng)
    mesh, parameters["changes"] = change.changed(mesh, change.draw(rng), rng)
    parameters["blum_seed"] = rng.randint(1, 1000)
    return mesh, parameters, betti_numbers(mesh)

