"""Solids as signed distances, blended smoothly, and the quadrilaterals of their surface: for generators of models.

A distance is negative inside. Blends are the polynomial ones with a width k, in which two surfaces flow together."""
import math

from mesh import Mesh, add, cross, dot, scaled, sub, unit


def ball(centre, radius):
    a, b, c = centre
    return lambda x, y, z: math.sqrt((x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2) - radius


def ellipsoid(centre, radii, axes=((1, 0, 0), (0, 1, 0), (0, 0, 1))):
    """Radii along axes of unit length that are square to each other. The distance is a first order one, right at the surface."""
    a, b, c = centre
    (ux, uy, uz), (vx, vy, vz), (wx, wy, wz) = axes
    ru, rv, rw = (1 / r for r in radii)
    inside = -min(radii)

    def distance(x, y, z):
        x, y, z = x - a, y - b, z - c
        p, q, r = (x * ux + y * uy + z * uz) * ru, (x * vx + y * vy + z * vz) * rv, (x * wx + y * wy + z * wz) * rw
        f = math.sqrt(p * p + q * q + r * r)
        slope = math.sqrt((p * ru) ** 2 + (q * rv) ** 2 + (r * rw) ** 2)
        return f * (f - 1) / slope if slope > 1e-9 else inside
    return distance


def rod(start, end, first, last=None):
    """From start to end, its radius changes from first to last."""
    last = first if last is None else last
    axis = sub(end, start)
    square = dot(axis, axis)
    (a, b, c), (u, v, w) = start, axis

    def distance(x, y, z):
        x, y, z = x - a, y - b, z - c
        t = (x * u + y * v + z * w) / square
        t = 0 if t < 0 else 1 if t > 1 else t
        return math.sqrt((x - t * u) ** 2 + (y - t * v) ** 2 + (z - t * w) ** 2) - first - t * (last - first)
    return distance


def half_space(point, outward):
    n = unit(outward)
    offset = dot(point, n)
    return lambda x, y, z: x * n[0] + y * n[1] + z * n[2] - offset


def frame(along, up):
    """Axes of unit length: along, one across in the plane of up, and the third."""
    u = unit(along)
    v = unit(sub(up, scaled(u, dot(up, u))))
    return u, v, cross(u, v)


def steps(*runs):
    """Planes from a list of (up to, step): the first entry is where they begin."""
    at = [runs[0]]
    for end, step in runs[1:]:
        count = max(round((end - at[-1]) / step), 1)
        begin = at[-1]
        at += [begin + (end - begin) * (i + 1) / count for i in range(count)]
    return at


def symmetric(planes):
    return [-x for x in reversed(planes) if x > 0] + planes


class Solid:
    """Parts that are added and cut away one after the other. Symmetric about x = 0: parts need to be there for positive x only."""

    def __init__(self):
        self.parts = []
        self.widest = 0.0

    def add(self, distance, blend=0.0):
        self.parts.append((distance, blend, 1))
        self.widest = max(self.widest, blend)

    def cut(self, distance, blend=0.0):
        self.parts.append((distance, blend, -1))
        self.widest = max(self.widest, blend)

    def near(self, x, y, z, reach, parts=None):
        """Those of the parts (all of them) that matter for the surface within reach of a point."""
        # First order distances may be too large a little.
        bound = 2.5 * reach + self.widest
        return [part for part in (self.parts if parts is None else parts) if part[0](x, y, z) < bound]


def distance_of(parts, x, y, z):
    f = 1e9
    for part, k, sign in parts:
        # To cut is to add the outside to the outside.
        a, b = sign * f, part(x, y, z)
        h = k - abs(a - b)
        f = sign * (min(a, b) - (h * h / (4 * k) if h > 0 else 0))
    return f


def surface(solid, xs, ys, zs, block=6):
    """The surface in a box as quadrilaterals, one vertex to each cell that it passes (surface nets, Gibson 1998). xs, ys, zs are the
    planes of the cells, ascending and of any spacing; xs symmetric about 0. Cells are looked at in blocks of blocks: most are far off."""
    values = {}
    last = len(xs) - 1

    def look(begin, size, parts):
        """Finds the distances at the corners of a block of cells, if the surface may pass it."""
        end = [min(b + size, len(planes) - 1) for b, planes in zip(begin, (xs, ys, zs))]
        low, high = [(xs[i], ys[j], zs[k]) for i, j, k in (begin, end)]
        (x, y, z), reach = scaled(add(low, high), 0.5), 0.5 * math.dist(low, high)
        x = abs(x)
        parts = solid.near(x, y, z, reach, parts)
        if not parts or abs(distance_of(parts, x, y, z)) > 2 * reach:
            return False
        if size > 3:
            half = size // 2
            inner = [range(b, e, half) for b, e in zip(begin, end)]
            return any([look((i, j, k), half, parts) for i in inner[0] for j in inner[1] for k in inner[2]])
        for i in range(begin[0], end[0] + 1):
            for j in range(begin[1], end[1] + 1):
                for k in range(begin[2], end[2] + 1):
                    if (i, j, k) not in values:
                        mirrored = values.get((last - i, j, k))
                        values[i, j, k] = distance_of(parts, abs(xs[i]), ys[j], zs[k]) if mirrored is None else mirrored
        return True

    mesh, vertex = Mesh(), {}
    corners = [(a, b, c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
    edges = [(p, q) for p in corners for q in corners if p < q and sum(u != v for u, v in zip(p, q)) == 1]
    for i0 in range(0, len(xs) - 1, block):
        for j0 in range(0, len(ys) - 1, block):
            for k0 in range(0, len(zs) - 1, block):
                if not look((i0, j0, k0), block, None):
                    continue
                for i in range(i0, min(i0 + block, len(xs) - 1)):
                    for j in range(j0, min(j0 + block, len(ys) - 1)):
                        for k in range(k0, min(k0 + block, len(zs) - 1)):
                            at = [values.get((i + a, j + b, k + c)) for a, b, c in corners]
                            if None not in at and min(at) < 0 <= max(at):
                                vertex[i, j, k] = mesh.point(crossing_mean(at, edges, corners, (xs, ys, zs), (i, j, k)))
    for (i, j, k) in list(vertex):
        for axis in range(3):
            faces_across(mesh, vertex, values, (i, j, k), axis)
    return mesh


def crossing_mean(at, edges, corners, planes, cell):
    """The mean of the places where the surface cuts the edges of a cell."""
    value = dict(zip(corners, at))
    total, count = (0.0, 0.0, 0.0), 0
    for p, q in edges:
        a, b = value[p], value[q]
        if (a < 0) != (b < 0):
            t = a / (a - b)
            total = add(total, tuple(planes[d][cell[d] + p[d]] + t * (planes[d][cell[d] + q[d]] - planes[d][cell[d] + p[d]])
                                     for d in range(3)))
            count += 1
    return scaled(total, 1 / count)


def faces_across(mesh, vertex, values, cell, axis):
    """The quadrilateral round the edge along an axis at a cell's first corner, facing out."""
    end = tuple(c + (d == axis) for d, c in enumerate(cell))
    if cell not in values or end not in values or (values[cell] < 0) == (values[end] < 0):
        return
    u, v = (axis + 1) % 3, (axis + 2) % 3
    ring = [tuple(c - (a if d == u else b if d == v else 0) for d, c in enumerate(cell)) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    if all(c in vertex for c in ring):
        face = [vertex[c] for c in ring]
        mesh.face(face if values[cell] < 0 else face[::-1])
