"""Meshes for generators of models: faces that are extruded, tubes and shells of rings, written as RIB."""
import math


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def scaled(a, k):
    return tuple(k * x for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return scaled(a, 1 / length) if length else (0.0, 1.0, 0.0)


class Mesh:
    """Points and faces. A face that is extruded goes away: its walls and its moved copy take its place."""

    def __init__(self):
        self.points, self.faces = [], []

    def point(self, p):
        self.points.append(tuple(p))
        return len(self.points) - 1

    def face(self, corners):
        self.faces.append(list(corners))
        return len(self.faces) - 1

    def centre(self, f):
        corners = self.faces[f]
        return scaled(tuple(sum(self.points[c][k] for c in corners) for k in range(3)), 1 / len(corners))

    def normal(self, f):
        a, b, c = (self.points[i] for i in self.faces[f][:3])
        return unit(cross(sub(b, a), sub(c, a)))

    def extrude(self, f, along, radius):
        """Moves face f along a vector, turns it square to it and gives it a radius. Returns the faces of the walls."""
        old = self.faces[f]
        m, d = self.centre(f), unit(along)
        middle = add(m, along)
        new = []
        for c in old:
            spoke = sub(self.points[c], m)
            spoke = unit(sub(spoke, scaled(d, dot(spoke, d))))
            new.append(self.point(add(middle, scaled(spoke, radius))))
        walls = []
        for i in range(len(old)):
            j = (i + 1) % len(old)
            walls.append(self.face([old[i], old[j], new[j], new[i]]))
        self.faces[f] = new
        return walls

    def ring(self, points):
        return [self.point(p) for p in points]

    def shell(self, rings, close=True):
        """Quadrilaterals between rings of as many points; the first and the last are closed by a face each."""
        for a, b in zip(rings, rings[1:]):
            for i in range(len(a)):
                j = (i + 1) % len(a)
                self.face([a[i], a[j], b[j], b[i]])
        if close:
            self.face(list(reversed(rings[0])))
            self.face(rings[-1])

    def tube(self, path, radii, sides=6):
        """Round a path of at least two points, as thick at each as its radius says."""
        across = cross(sub(path[1], path[0]), (0.31, 0.87, 0.38))
        rings = []
        for i, (p, r) in enumerate(zip(path, radii)):
            along = unit(sub(path[min(i + 1, len(path) - 1)], path[max(i - 1, 0)]))
            # What is left of the last ring's axis: no ring is twisted against the next.
            across = unit(sub(across, scaled(along, dot(across, along))))
            other = cross(along, across)
            turns = [2 * math.pi * k / sides for k in range(sides)]
            rings.append(self.ring([add(p, add(scaled(across, r * math.cos(a)), scaled(other, r * math.sin(a)))) for a in turns]))
        self.shell(rings)

    def box(self, low, high):
        (x, y, z), (u, v, w) = low, high
        c = [self.point(p) for p in ((x, y, z), (u, y, z), (u, y, w), (x, y, w), (x, v, z), (u, v, z), (u, v, w), (x, v, w))]
        for f in ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)):
            self.face([c[i] for i in f])

    def relax(self, times):
        """Smooths, keeping the volume: a step towards the mean of the neighbours and most of it back (Taubin 1995)."""
        near = [set() for _ in self.points]
        for face in self.faces:
            for a, b in zip(face, face[1:] + face[:1]):
                near[a].add(b)
                near[b].add(a)
        for _ in range(times):
            for k in (0.5, -0.42):
                # Sorted: sums of sets depend on their order.
                means = [scaled(tuple(sum(self.points[j][d] for j in sorted(n)) for d in range(3)), 1 / len(n)) if n else p
                         for n, p in zip(near, self.points)]
                self.points = [add(p, scaled(sub(m, p), k)) for p, m in zip(self.points, means)]

    def rib(self, scheme="catmull-clark"):
        """A SubdivisionMesh, or PointsPolygons for the scheme "polygons"."""
        def numbers(values):
            return "[ " + " ".join(f"{v:.5g}" for v in values) + " ]"
        counts, corners = numbers(len(f) for f in self.faces), numbers(c for f in self.faces for c in f)
        text = f"PointsPolygons {counts} {corners}" if scheme == "polygons" else \
            f"SubdivisionMesh \"{scheme}\" {counts} {corners} [ \"interpolateboundary\" ] [ 0 0 ] [ ] [ ]"
        return text + " \"P\" " + numbers(x for p in self.points for x in p) + "\n"


def sheet(columns, thick=0.012, weights=None):
    """Two skins of columns of points, from the root of a fin or a wing to its edge, each column as long; so thick across x, at the root and a
    quarter of that at the edge. Weights, one a column, are parts of that thickness."""
    mesh = Mesh()
    weights = weights or [1] * len(columns)
    rings = []
    for column, weight in zip(columns, weights):
        n = len(column) - 1
        sides = [[(x + s * thick * weight * (1 - 0.75 * k / n), y, z) for k, (x, y, z) in enumerate(column)] for s in (1, -1)]
        rings.append(mesh.ring(sides[0] + sides[1][::-1]))
    mesh.shell(rings)
    return mesh
