"""Makes a failing model small: fewer shells and faces, then simpler coordinates."""

import math
import random

from facets import retriangulated
from mesh import Mesh, edge_faces, shells


def collapsed(mesh, pairs):
    """Each pair's first vertex moved into its second: triangles that shrink vanish."""
    target = dict(pairs)
    faces = []
    for f in mesh.faces:
        g = [target.get(v, v) for v in f]
        if len(set(g)) == 3:
            faces.append(g)
    return Mesh(mesh.points, faces).compact()


def without_shell(mesh, group):
    drop = set(group)
    return Mesh(mesh.points, [f for i, f in enumerate(mesh.faces) if i not in drop]).compact()


def on_grid(mesh, bits, vertices=None):
    """Coordinates as multiples of 2^-bits of the extent."""
    extent = max(abs(x) for p in mesh.points for x in p) or 1.0
    step = math.ldexp(1.0, math.frexp(extent)[1] - bits)
    chosen = set(range(len(mesh.points))) if vertices is None else set(vertices)
    return Mesh([tuple(round(x / step) * step for x in p) if i in chosen else p
                 for i, p in enumerate(mesh.points)], mesh.faces)


class Shrinker:
    """`fails(mesh)` decides; `go_on()` turns false when time is up."""

    def __init__(self, fails, go_on, seed=1):
        self.fails, self.go_on, self.rng = fails, go_on, random.Random(seed)

    def accept(self, mesh):
        return bool(mesh.faces) and shells(mesh) is not None and self.fails(mesh)

    def shrink(self, mesh):
        if any(len(f) > 3 for f in mesh.faces):
            triangles = retriangulated(mesh, self.rng)
            if not self.accept(triangles):
                return self.coordinates(mesh)  # it takes the polygons
            mesh = triangles
        size = None
        while size != len(mesh.faces) and self.go_on():
            size = len(mesh.faces)
            mesh = self.fewer_faces(self.fewer_shells(mesh))
        return self.coordinates(mesh)

    def fewer_shells(self, mesh):
        i = 0
        while self.go_on():
            groups = shells(mesh)
            if len(groups) == 1 or i >= len(groups):
                break
            smaller = without_shell(mesh, groups[i])
            if self.accept(smaller):
                mesh = smaller
            else:
                i += 1
        return mesh

    def fewer_faces(self, mesh):
        """Edge collapses, many at once first."""
        share = 0.25
        while self.go_on():
            edges = sorted(edge_faces(mesh.faces))
            self.rng.shuffle(edges)
            many = max(1, int(share * len(mesh.points)))
            if many == 1:
                break
            pairs, used = [], set()
            for a, b in edges:
                if a not in used and b not in used and len(pairs) < many:
                    pairs.append((a, b))
                    used |= {a, b}
            smaller = collapsed(mesh, pairs)
            if self.accept(smaller):
                mesh = smaller
            else:
                share /= 1.5
        done = False
        while not done and self.go_on():
            done = True
            edges = sorted(edge_faces(mesh.faces))
            self.rng.shuffle(edges)
            for pair in edges:
                if not self.go_on():
                    break
                smaller = collapsed(mesh, [pair])
                if self.accept(smaller):
                    mesh, done = smaller, False
                    break
        return mesh

    def coordinates(self, mesh):
        for bits in (2, 3, 4, 6, 8, 12, 16, 20, 26, 32, 40):
            simpler = on_grid(mesh, bits)
            if simpler.points == mesh.points or not self.go_on():
                break
            if self.accept(simpler):
                mesh = simpler
                break
        for v in range(len(mesh.points)):
            for bits in (2, 3, 4, 6, 8, 12, 16, 24, 32):
                simpler = on_grid(mesh, bits, [v])
                if simpler.points == mesh.points or not self.go_on():
                    break
                if self.accept(simpler):
                    mesh = simpler
                    break
        return mesh
