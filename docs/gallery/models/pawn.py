#!/usr/bin/env python3
"""A pawn without its head: a NURBS surface of revolution, straight, and bent, with the straight one's points as Pref."""
import math
import pathlib
import sys

# Radius and height of the profile's control points, from the foot up.
PROFILE = [(0.36, 0.0), (0.37, 0.05), (0.36, 0.13), (0.27, 0.16), (0.16, 0.26), (0.12, 0.5), (0.1, 0.68), (0.23, 0.7),
           (0.24, 0.77), (0.11, 0.79), (0.1, 0.83)]
# A circle of four quadratic arcs: directions and weights.
CIRCLE = [(x, z, 1 if x * z == 0 else math.sqrt(0.5)) for x, z in
          [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]]


CURVATURE = 0.6


def bend(x, y, z):
    """Along an arc to the right; what is across the axis stays so."""
    angle = CURVATURE * y
    return ((1 - math.cos(angle)) / CURVATURE + x * math.cos(angle), math.sin(angle) / CURVATURE - x * math.sin(angle), z)


def numbers(points):
    return " ".join(f"{c:.6g}" for p in points for c in p)


def surface(shape, with_reference):
    rows = PROFILE[::-1]
    n = len(rows)
    knots = [0] * 4 + list(range(1, n - 3)) + [n - 3] * 4
    straight = [(r * x, y, r * z, w) for r, y in rows for x, z, w in CIRCLE]
    weighted = []
    for x, y, z, w in straight:
        px, py, pz = shape(x, y, z)
        weighted.append((px * w, py * w, pz * w, w))
    text = (f"NuPatch 9 3 [ 0 0 0 1 1 2 2 3 3 4 4 4 ] 0 4 {n} 4 [ {' '.join(map(str, knots))} ] 0 {n - 3}\n"
            f'  "Pw" [ {numbers(weighted)} ]\n')
    if with_reference:
        text += f'  "vertex point Pref" [ {numbers(p[:3] for p in straight)} ]\n'
    return text


def main():
    folder = pathlib.Path(sys.argv[1])
    (folder / "pawn.rib").write_text(surface(lambda x, y, z: (x, y, z), False))
    (folder / "bentpawn.rib").write_text(surface(bend, True))


if __name__ == "__main__":
    main()
