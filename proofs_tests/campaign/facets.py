"""Facets: maximal connected sets of exactly coplanar faces. Merging and triangulating them anew
leaves the solid exactly as it is."""

from mesh import Disjoint, Mesh, cross, dot, edge_faces, integers, normal, sub


def groups_of(mesh, points):
    """Lists of faces; faces that are not exactly planar stay alone."""
    normals = [normal(points, f) for f in mesh.faces]
    planar = [all(dot(n, sub(points[v], points[f[0]])) == 0 for v in f)
              for n, f in zip(normals, mesh.faces)]
    owner = edge_faces(mesh.faces)
    joined = Disjoint(len(mesh.faces))
    for (a, b), i in owner.items():
        j = owner[b, a]
        if (i != j and planar[i] and planar[j] and dot(normals[i], normals[j]) > 0
                and cross(normals[i], normals[j]) == (0, 0, 0)):
            joined.join(i, j)
    groups = {}
    for i in range(len(mesh.faces)):
        groups.setdefault(joined.find(i), []).append(i)
    return list(groups.values())


def border(faces):
    """The border's loops, or None where one touches itself."""
    following = {}
    edges = {(a, b) for f in faces for a, b in zip(f, f[1:] + f[:1])}
    for a, b in edges:
        if (b, a) not in edges:
            if a in following:
                return None
            following[a] = b
    loops = []
    while following:
        start = min(following)
        loop, v = [], start
        while v in following:
            loop.append(v)
            v = following.pop(v)
        if v != start:
            return None
        loops.append(loop)
    return loops


def project(points, n):
    """Plane coordinates that keep the sense of rotation about n."""
    k = max(range(3), key=lambda axis: abs(n[axis]))
    u, v = (k + 1) % 3, (k + 2) % 3
    return (lambda i: (points[i][u], points[i][v])) if n[k] > 0 else (
        lambda i: (points[i][v], points[i][u]))


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def crosses(a, b, c, d):
    """Do the open segments cross in one point?"""
    ab = turn(a, b, c), turn(a, b, d)
    cd = turn(c, d, a), turn(c, d, b)
    return 0 not in ab + cd and (ab[0] > 0) != (ab[1] > 0) and (cd[0] > 0) != (cd[1] > 0)


def triangulate(loops, at, rng):
    """A random triangulation, without new vertices, of the region left of the loops: a triangle is
    cut off at any border edge until nothing is left. Loops as indices, `at` gives the plane point.
    None if the loops bound no such region."""
    front = {(a, b) for loop in loops for a, b in zip(loop, loop[1:] + loop[:1])}
    vertices = sorted({v for loop in loops for v in loop})
    result = []

    def fits(a, b, c):
        p, q, r = at(a), at(b), at(c)
        if turn(p, q, r) <= 0:
            return False
        for v in vertices:
            x = at(v)
            if v not in (a, b, c) and min(turn(p, q, x), turn(q, r, x), turn(r, p, x)) >= 0:
                return False
        return not any(crosses(*pair, at(e), at(f)) for e, f in front
                       for pair in ((p, r), (q, r)))

    while front:
        a, b = rng.choice(sorted(front))
        choices = [v for v in vertices if v not in (a, b)]
        rng.shuffle(choices)
        c = next((v for v in choices if fits(a, b, v)), None)
        if c is None:
            return None
        result.append([a, b, c])
        front.remove((a, b))
        for edge in ((b, c), (c, a)):
            if edge in front:
                front.remove(edge)
            else:
                front.add(edge[::-1])
        vertices = sorted({v for edge in front for v in edge})
    return result


def retriangulated(mesh, rng):
    """Every facet anew at random. Vertices inside a facet vanish, those on straight edges stay;
    faces that are not planar are triangulated in their projection (the solid then is that one)."""
    points = integers(mesh.points)
    faces = []
    for group in groups_of(mesh, points):
        members = [mesh.faces[i] for i in group]
        n = normal(points, members[0])
        loops = border(members)
        new = triangulate(loops, project(points, n), rng) if loops else None
        if new is None:  # each face by itself
            new = []
            for face in members:
                new += triangulate([face], project(points, normal(points, face)), rng) or [face]
        faces += new
    return Mesh(mesh.points, faces).compact()


def merged(mesh, rng, share=1.0):
    """Facets without holes become polygons, those with holes triangles; vertices in the middle of a
    straight edge between two facets are dropped with probability `share`."""
    points = integers(mesh.points)
    regions = []
    for group in groups_of(mesh, points):
        members = [mesh.faces[i] for i in group]
        loops = border(members)
        regions += [(normal(points, members[0]), loops)] if loops else [
            (normal(points, f), [f]) for f in members]
    around = {}
    for _, loops in regions:
        for loop in loops:
            for a, v, b in zip(loop[-1:] + loop[:-1], loop, loop[1:] + loop[:1]):
                around.setdefault(v, []).append((a, b))

    def is_straight(v):
        (a, b), *rest = around[v]
        return len(rest) == 1 and cross(sub(points[v], points[a]), sub(points[b], points[v])) == (
            0, 0, 0) and rest[0] == (b, a) and rng.random() < share

    dropped = set()
    for v in sorted(around):
        # A loop must keep three corners: neighbours of a dropped vertex are judged by their line.
        if len(around[v]) == 2 and is_straight(v):
            dropped.add(v)
            (a, b), _ = around[v]
            for w, old, new in ((a, v, b), (b, v, a)):
                around[w] = [tuple(new if x == old else x for x in pair) for pair in around[w]]
    faces = []
    for n, loops in regions:
        loops = [[v for v in loop if v not in dropped] for loop in loops]
        if len(loops) == 1:
            faces.append(loops[0])
        else:
            new = triangulate(loops, project(points, n), rng)
            if new is None:
                return mesh
            faces += new
    return Mesh(mesh.points, faces).compact()
