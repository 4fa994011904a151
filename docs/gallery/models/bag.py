#!/usr/bin/env python3
"""A bag of water, tied at its neck, as one closed subdivision mesh, normals out; its middle is at the origin, about 1.3 high."""
import math
import sys

from mesh import Mesh

# From the bottom up: height, radius.
PROFILE = [(-0.6, 0.1), (-0.585, 0.24), (-0.52, 0.4), (-0.36, 0.54), (-0.12, 0.6), (0.12, 0.56), (0.32, 0.44), (0.46, 0.28),
           (0.55, 0.14), (0.6, 0.075), (0.64, 0.085), (0.7, 0.17), (0.76, 0.23)]


def bag():
    mesh = Mesh()
    rings = []
    for k, (y, r) in enumerate(PROFILE):
        ring = []
        for i in range(20):
            a = -2 * math.pi * i / 20
            # Folds towards the knot, and a belly that hangs a little to one side.
            fold = 1 + (0.1 if k < 7 else 0.3) * max(0, (k - 5) / 7) * math.cos(5 * a + 0.6 * k) + 0.02 * math.cos(3 * a + 1)
            ring.append((r * fold * math.cos(a) + 0.03 * math.sin(2.2 * y), y, 0.92 * r * fold * math.sin(a)))
        rings.append(mesh.ring(ring))
    mesh.shell(rings)
    return mesh


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="ascii") as file:
        file.write(bag().rib())
