#!/usr/bin/env python3
"""A small creature of blobs, as a RIB archive: it stands on y = 0 and looks along +x, about 1.6 long and 1 high."""
import math
import sys


class Blobs:
    """Ellipsoids and rods that flow together."""

    def __init__(self):
        self.codes, self.numbers, self.count = [], [], 0

    def leaf(self, code, numbers):
        self.codes += [code, len(self.numbers)]
        self.numbers += numbers
        self.count += 1

    def ellipsoid(self, x, y, z, rx, ry, rz, turn=0.0):
        """Radii of the surface of this one alone; turned about z by `turn` degrees."""
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        # The field of a leaf ends at twice the radius of its surface.
        self.leaf(1001, [2 * rx * c, 2 * rx * s, 0, 0, -2 * ry * s, 2 * ry * c, 0, 0, 0, 0, 2 * rz, 0, x, y, z, 1])

    def rod(self, a, b, radius):
        self.leaf(1002, [*a, *b, 2 * radius, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])

    def rib(self):
        codes = self.codes + [0, self.count] + list(range(self.count))
        numbers = " ".join(f"{n:.4g}" for n in self.numbers)
        return f"Blobby {self.count} [ {' '.join(map(str, codes))} ] [ {numbers} ] [ ]\n"


def creature():
    b = Blobs()
    b.ellipsoid(0, 0.5, 0, 0.36, 0.24, 0.23, 4)       # body
    b.ellipsoid(-0.22, 0.47, 0, 0.2, 0.21, 0.21)      # haunches
    b.rod((0.25, 0.58, 0), (0.5, 0.82, 0), 0.115)     # neck
    b.ellipsoid(0.56, 0.9, 0, 0.17, 0.15, 0.15)       # head
    b.ellipsoid(0.7, 0.84, 0, 0.11, 0.075, 0.09)      # snout
    for side in (-1, 1):
        b.rod((0.5, 0.98, 0.08 * side), (0.45, 1.14, 0.15 * side), 0.052) # horns
        b.ellipsoid(0.62, 0.99, 0.085 * side, 0.055, 0.055, 0.055)        # eyes
        b.rod((0.22, 0.4, 0.14 * side), (0.27, 0.08, 0.18 * side), 0.075) # legs
        b.rod((-0.26, 0.4, 0.15 * side), (-0.3, 0.08, 0.19 * side), 0.085)
        b.ellipsoid(0.31, 0.055, 0.185 * side, 0.1, 0.055, 0.075)         # feet
        b.ellipsoid(-0.26, 0.055, 0.195 * side, 0.11, 0.06, 0.08)
    tail = [(-0.38, 0.46, 0), (-0.6, 0.3, 0.06), (-0.8, 0.16, 0.2), (-0.95, 0.1, 0.4), (-0.98, 0.1, 0.6)]
    for i, (p, q) in enumerate(zip(tail, tail[1:])):
        b.rod(p, q, 0.1 - 0.013 * i)
    for i in range(6): # plates along the back
        x = 0.3 - 0.13 * i
        b.ellipsoid(x, 0.76 - 0.35 * (x + 0.05) ** 2 - (0.02 if i in (0, 5) else 0), 0, 0.07, 0.09, 0.055, 8)
    return b.rib()


if __name__ == "__main__":
    sys.stdout.write(creature()) if len(sys.argv) < 2 else open(sys.argv[1], "w", encoding="ascii").write(creature())
