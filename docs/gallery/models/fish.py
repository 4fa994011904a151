#!/usr/bin/env python3
"""A thin tall fish: z runs along it (head at 1, tail at -1.2), y up, x across. Parts: body, fins, pectorals, eyes, organs, skeleton."""
import argparse
import math

from mesh import Mesh, add, scaled, sheet, sub

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


def fin(rays, thick=0.016):
    """Skin over rays, each a list of points from the root to the edge: every second column of the sheet is a ray, thicker than the skin
    between, whose edge hangs in."""
    columns = []
    for a, b in zip(rays, rays[1:]):
        skin = []
        for k, (p, q) in enumerate(zip(a, b)):
            hang = 1 - 0.05 * (k / (len(a) - 1)) ** 4
            middle = scaled(add(p, q), 0.5)
            skin.append(add(a[0], scaled(sub(middle, a[0]), hang)))
        columns += [a, skin]
    columns.append(rays[-1])
    return sheet(columns, thick, [0.25 if i % 2 else 1 for i in range(len(columns))])


def steps_of(count):
    return [k / (count - 1) for k in range(count)]


def fins():
    def border(first, last, side, height, lean):
        """Along the back (side 1) or the belly (-1), from z first to last."""
        rays = []
        for t in steps_of(30):
            z = first + t * (last - first)
            y, h, _ = along(z)
            tall = height * (0.3 + 0.7 * math.sin(math.pi * min(1, 0.1 + 1.02 * t)) ** 0.7) * min(1, 9 * (1.02 - t)) * min(1, 0.25 + 8 * t)
            root = y + side * (h - 0.04)
            rays.append([(0, root + side * v * (tall + 0.04), z - lean * tall * (0.4 + 0.6 * v) * v) for v in steps_of(5)])
        return fin(rays)

    tail = []
    for u in steps_of(19):
        v = 2 * u - 1 # across
        long = 0.2 + 0.2 * abs(v) ** 1.8
        tail.append([(0, v * (0.075 + 0.34 * k ** 0.9), -0.8 - k * long) for k in steps_of(5)])
    return [border(0.5, -0.76, 1, 0.27, 0.75), border(0.12, -0.76, -1, 0.24, 0.8), fin(tail)]


def pectorals():
    """A fan on each side, its root behind the gill, spread back and down."""
    made = []
    for side in (1, -1):
        rays = []
        for u in steps_of(13):
            a = math.radians(-56 + 66 * u) # up from straight back
            long = 0.4 * (0.35 + 0.65 * math.sin(math.pi * (0.08 + 0.8 * u)))
            root = (side * 0.118, -0.1 + 0.06 * (u - 0.5), 0.38 + 0.02 * u)
            rays.append([add(root, (side * 0.28 * long * v, long * v * math.sin(a), -long * v * math.cos(a))) for v in steps_of(5)])
        made.append(fin(rays, thick=0.009))
    return made


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
    back = Mesh()
    back.tube([(0, spine(z), z) for z in zs], [0.03 - 0.016 * i / 20 + 0.007 * (i % 2) for i in range(21)])
    made = [back]
    for i in range(12): # bones up and down from it
        z = 0.3 - 0.085 * i
        y, h, _ = along(z)
        for side in (1, -1):
            tip = y + side * 0.78 * h
            bone = Mesh()
            bone.tube([(0, spine(z) + v * (tip - spine(z)), z - 0.13 * v - 0.03 * v * v) for v in steps_of(5)],
                      [0.015 * (1 - 0.6 * v) for v in steps_of(5)], 4)
            made.append(bone)
    skull = Mesh()
    skull.tube([(0, 0.0, 0.9), (0, 0.02, 0.84), (0, 0.05, 0.74), (0, 0.08, 0.62), (0, 0.07, 0.52)], (0.02, 0.06, 0.1, 0.11, 0.05), 8)
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
