#!/usr/bin/env python3
"""A thin tall fish: z runs along it (head at 1, tail at -1.2), y up, x across. Parts: body, fins, pectorals, eyes, organs, skeleton."""
import argparse
import math

from mesh import Mesh

# Along the body: z, middle y, half height, half width.
BODY = [(1.02, -0.14, 0.035, 0.03), (0.97, -0.135, 0.075, 0.05), (0.86, -0.1, 0.15, 0.075), (0.72, -0.04, 0.27, 0.1),
        (0.54, 0.02, 0.41, 0.125), (0.32, 0.04, 0.52, 0.14), (0.08, 0.04, 0.55, 0.14), (-0.18, 0.03, 0.51, 0.125),
        (-0.42, 0.01, 0.4, 0.1), (-0.62, 0.0, 0.25, 0.07), (-0.76, 0.0, 0.13, 0.048), (-0.86, 0.0, 0.09, 0.035)]


def along(z):
    """Middle, half height, half width at z."""
    for (z0, *a), (z1, *b) in zip(BODY, BODY[1:]):
        if z0 >= z >= z1:
            t = (z0 - z) / (z0 - z1)
            return [x + t * (y - x) for x, y in zip(a, b)]
    return list(BODY[0][1:] if z > BODY[0][0] else BODY[-1][1:])


def body():
    mesh = Mesh()
    rings = []
    for z, y, h, w in BODY:
        ring = []
        for i in range(12): # a lens with round edges
            a = 2 * math.pi * i / 12
            c = math.cos(a)
            ring.append((w * c * (0.55 + 0.45 * abs(c)), y + h * math.sin(a), z))
        rings.append(mesh.ring(ring))
    mesh.shell(rings)
    return [mesh]


def sheet(columns, thick=0.012):
    """A fin of columns of points, from its root to its edge, each column as long: two skins."""
    mesh = Mesh()
    rings = []
    for column in columns:
        n = len(column) - 1
        sides = [[(x + s * thick * (1 - 0.75 * k / n), y, z) for k, (x, y, z) in enumerate(column)] for s in (1, -1)]
        rings.append(mesh.ring(sides[0] + sides[1][::-1]))
    mesh.shell(rings)
    return mesh


def fins():
    def border(first, last, side, height, lean):
        """Along the back (side 1) or the belly (-1), from z first to last."""
        columns = []
        for i in range(15):
            t = i / 14
            z = first + t * (last - first)
            y, h, _ = along(z)
            tall = height * math.sin(math.pi * min(1, 0.12 + 0.88 * t)) ** 0.55 * (1 - 0.12 * (i % 2))
            root = y + side * (h - 0.04)
            columns.append([(0, root + side * k / 3 * (tall + 0.04), z - lean * tall * k / 3) for k in range(4)])
        return sheet(columns)

    tail = []
    for i in range(9):
        v = i / 4 - 1 # -1 to 1 across
        long = 0.22 + 0.16 * v * v
        tail.append([(0, v * (0.085 + 0.33 * (k / 3) ** 0.8), -0.82 - k / 3 * long * (1 + 0.06 * (i % 2))) for k in range(4)])
    return [border(0.5, -0.76, 1, 0.26, 0.55), border(0.1, -0.76, -1, 0.22, 0.6), sheet(tail)]


def pectorals():
    made = []
    for side in (1, -1):
        columns = []
        for i in range(7):
            a = math.radians(-28 + 11 * i)
            long = 0.3 - 0.035 * abs(i - 3)
            columns.append([(side * (0.125 + 0.3 * long * k / 3), -0.1 + 0.025 * (i - 3) + long * k / 3 * math.sin(a) * 0.8,
                             0.36 - long * k / 3 * math.cos(a)) for k in range(4)])
        made.append(sheet(columns, 0.008))
    return made


def tube(points, radii, sides=6):
    mesh = Mesh()
    rings = [mesh.ring([(x + r * math.cos(2 * math.pi * i / sides), y + r * math.sin(2 * math.pi * i / sides), z) for i in range(sides)])
             for (x, y, z), r in zip(points, radii)]
    mesh.shell(rings)
    return mesh


def organs():
    def bag(z, y, long, high, wide):
        mesh = Mesh()
        rings = []
        for k in range(1, 8):
            t = -math.cos(math.pi * k / 8)
            s = math.sin(math.pi * k / 8)
            rings.append(mesh.ring([(wide * s * math.cos(a), y + high * s * math.sin(a), z - long * t)
                                    for a in (2 * math.pi * i / 8 for i in range(8))]))
        mesh.shell(rings)
        return mesh
    return [bag(0.28, -0.19, 0.24, 0.17, 0.09), bag(-0.02, -0.22, 0.2, 0.12, 0.08), bag(0.44, -0.02, 0.12, 0.12, 0.08)]


def skeleton():
    def spine(z):
        return 0.09 * math.sin(math.pi * (z + 0.86) / 1.6)
    zs = [0.62 - 1.5 * i / 20 for i in range(21)]
    made = [tube([(0, spine(z), z) for z in zs], [0.03 - 0.016 * i / 20 + 0.007 * (i % 2) for i in range(21)])]
    for i in range(12): # bones up and down from it
        z = 0.3 - 0.085 * i
        y, h, _ = along(z)
        for side in (1, -1):
            tip = y + side * 0.78 * h
            steps = [k / 4 for k in range(5)]
            bone = Mesh()
            rings = []
            for t in steps:
                p, r = (spine(z) + t * (tip - spine(z)), z - 0.13 * t - 0.03 * t * t), 0.011 * (1 - 0.6 * t)
                rings.append(bone.ring([(r * math.cos(a), p[0], p[1] + r * math.sin(a)) for a in (2 * math.pi * i / 4 for i in range(4))]))
            bone.shell(rings)
            made.append(bone)
    skull = tube([(0, 0.0, 0.9), (0, 0.02, 0.84), (0, 0.05, 0.74), (0, 0.08, 0.62), (0, 0.07, 0.52)], [0.02, 0.06, 0.1, 0.11, 0.05], 8)
    return made + [skull]


def eyes():
    text = ""
    for side in (1, -1):
        # A white of the eye with the pupil pushed through it.
        text += (f"AttributeBegin\nTranslate {side * 0.07:g} 0.07 0.74\nColor 0.95 0.9 0.75\nSphere 0.062 -0.062 0.062 360\n"
                 f"Color 0.01 0.01 0.015\nTranslate {side * 0.026:g} 0 0.004\nSphere 0.042 -0.042 0.042 360\nAttributeEnd\n")
    return text


def main():
    parts = {"body": body, "fins": fins, "pectorals": pectorals, "organs": organs, "skeleton": skeleton}
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", choices=[*parts, "eyes"])
    parser.add_argument("out")
    g = parser.parse_args()
    with open(g.out, "w", encoding="ascii") as file:
        file.write(eyes() if g.part == "eyes" else "".join(m.rib() for m in parts[g.part]()))


if __name__ == "__main__":
    main()
