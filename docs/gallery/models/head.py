#!/usr/bin/env python3
"""A head on its neck as one subdivision mesh: y up, chin at 0, crown at 1, looking along -z. Nobody's: a table of outlines, and bumps."""
import math
import sys

from mesh import Mesh

# Height, half width, depth to the front and to the back.
OUTLINE = [(-0.62, 0.5, 0.2, 0.26), (-0.52, 0.44, 0.2, 0.26), (-0.42, 0.3, 0.17, 0.24), (-0.3, 0.215, 0.15, 0.22), (-0.18, 0.195, 0.15, 0.22),
           (-0.07, 0.2, 0.17, 0.23), (-0.025, 0.215, 0.28, 0.24), (0.0, 0.225, 0.325, 0.245), (0.04, 0.245, 0.345, 0.255), (0.1, 0.275, 0.35, 0.28),
           (0.2, 0.305, 0.365, 0.325), (0.3, 0.325, 0.37, 0.37), (0.42, 0.34, 0.365, 0.415), (0.52, 0.35, 0.36, 0.44), (0.6, 0.355, 0.368, 0.455),
           (0.7, 0.352, 0.36, 0.455), (0.8, 0.325, 0.318, 0.43), (0.88, 0.275, 0.255, 0.375), (0.94, 0.21, 0.185, 0.3), (0.975, 0.145, 0.125, 0.215),
           (0.995, 0.07, 0.06, 0.11), (1.0, 0.002, 0.002, 0.002)]
# Bumps: angle from the front, height, their widths, and how far out. Those beside the middle are on both sides.
BUMPS = [(0, 0.56, 0.12, 0.07, 0.025), (0, 0.45, 0.11, 0.06, 0.05), (0, 0.37, 0.12, 0.045, 0.075), (0, 0.325, 0.14, 0.025, 0.06), # nose
         (0.17, 0.325, 0.06, 0.022, 0.03), (0.1, 0.3, 0.05, 0.012, -0.025),
         (0.4, 0.495, 0.19, 0.05, -0.085), (0.4, 0.497, 0.125, 0.03, 0.065), (0.4, 0.49, 0.14, 0.007, -0.016),                      # eyes
         (0.36, 0.578, 0.26, 0.025, 0.036), (0.75, 0.4, 0.25, 0.06, 0.02), (0.75, 0.22, 0.25, 0.08, -0.012),                          # brows, cheeks
         (0.07, 0.224, 0.09, 0.013, 0.024), (0, 0.172, 0.17, 0.017, 0.038), (0, 0.215, 0.23, 0.012, 0.02), (0, 0.197, 0.25, 0.008, -0.034), # lips
         (0, 0.262, 0.05, 0.025, -0.006), (0, 0.13, 0.22, 0.022, -0.014), (0, 0.055, 0.2, 0.045, 0.03),                              # chin
         (1.7, 0.44, 0.085, 0.08, 0.13), (1.6, 0.45, 0.06, 0.045, -0.06), (1.45, 0.42, 0.06, 0.03, -0.01),                        # ears
         (0.32, -0.3, 0.12, 0.2, 0.012)]


def outline(y):
    for a, b in zip(OUTLINE, OUTLINE[1:]):
        if a[0] <= y <= b[0]:
            t = (y - a[0]) / (b[0] - a[0])
            return [p + t * (q - p) for p, q in zip(a[1:], b[1:])]
    return OUTLINE[-1][1:]


def place(angle, y):
    wide, front, back = outline(y)
    out = 0
    for a, at, across, along, much in BUMPS:
        for side in ((1,) if a == 0 else (1, -1)):
            d = ((angle - side * a) / across) ** 2 + ((y - at) / along) ** 2
            out += much * math.exp(-0.5 * d)
    s, c = math.sin(angle), math.cos(angle)
    deep = front if c > 0 else back
    # The face is flatter than an ellipse.
    s, c = (math.copysign(abs(v) ** 0.9, v) for v in (s, c))
    return wide * s + out * math.sin(angle), y, -(deep * c + out * math.cos(angle))


def head():
    mesh = Mesh()
    # Close together where the face is.
    heights = [-0.62, -0.57, -0.5, -0.42, -0.34, -0.26, -0.18, -0.11, -0.06, -0.03, -0.01]
    heights += [0.01 + 0.0165 * i for i in range(38)] + [0.65, 0.69, 0.74, 0.79, 0.84, 0.88, 0.92, 0.95, 0.975, 0.99, 1.0]
    columns = 60
    rings = []
    for y in heights:
        ring = []
        for i in range(columns):
            t = 2 * i / columns - 1
            ring.append(place(math.pi * math.copysign(abs(t) ** 1.35, t), y))
        rings.append(mesh.ring(ring))
    # Open below, and by a hair at the crown: a face of sixty corners would have every face cut in four.
    mesh.shell(rings, close=False)
    return mesh


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="ascii") as file:
        file.write(head().rib())
