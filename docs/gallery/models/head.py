#!/usr/bin/env python3
"""The bust of a goblin with large thin ears, as subdivision meshes: y up, chin at 0, crown at 1, looking along -z, its bottom at -0.42.

Writes archives into a folder: skin.rib, eyes.rib, bone.rib (the skull below the skin). The skin has st for maps that are painted from in front:
x and y from -1 to 1 and from 1.05 down to -0.45."""
import math
import pathlib
import sys

from mesh import add, scaled, sub
from solids import Solid, ball, ellipsoid, frame, half_space, rod, steps, surface, symmetric

EYE, EYE_RADIUS = (0.15, 0.475, -0.265), 0.095
BOTTOM = -0.42


def skull(s, thinner=0.0):
    """What is below the skin: the skin's large forms by so much smaller."""
    def r(*radii):
        return tuple(v - thinner for v in radii)
    s.add(ellipsoid((0, 0.625, 0.075), r(0.365, 0.375, 0.425)))
    s.add(ellipsoid((0, 0.36, -0.06), r(0.265, 0.33, 0.285)), 0.14)           # face
    s.add(ellipsoid((0, 0.085, -0.2), r(0.125, 0.085, 0.105)), 0.13)          # chin
    s.add(rod((0.25, 0.27, 0.06), (0.1, 0.075, -0.2), *r(0.075, 0.07)), 0.1)  # jaw
    s.add(ellipsoid((0.215, 0.385, -0.2), r(0.105, 0.07, 0.1)), 0.09)         # cheek bone
    s.add(rod((0.05, 0.575, -0.315), (0.235, 0.6, -0.225), *r(0.055, 0.05)), 0.07) # brow


def bones():
    s = Solid()
    skull(s, 0.035)
    s.cut(ball((0.147, 0.478, -0.3), 0.105), 0.05)
    s.cut(ellipsoid((0.03, 0.37, -0.36), (0.045, 0.07, 0.09)), 0.03)
    for y in (0.16, 0.225):                                                  # teeth
        for i in range(4):
            x = 0.022 + 0.042 * i
            s.add(ellipsoid((x, y, -0.27 + 1.6 * x * x), (0.021, 0.032, 0.022)), 0.012)
    s.cut(rod((-0.2, 0.192, -0.3), (0.2, 0.192, -0.2), 0.006), 0.01)
    s.add(rod((0, 0.2, 0.14), (0, -0.45, 0.16), 0.07), 0.05)                 # neck
    s.cut(half_space((0, BOTTOM + 0.03, 0), (0, 1, 0)))
    return s


def skin():
    s = Solid()
    skull(s)
    x, y, z = EYE
    s.add(ellipsoid((0.165, 0.29, -0.2), (0.1, 0.1, 0.105)), 0.1)             # cheek
    s.cut(ellipsoid((x, y, -0.37), (0.105, 0.075, 0.09)), 0.09)               # socket
    # Nose: back, tip, wings, nostrils.
    s.add(rod((0, 0.535, -0.31), (0, 0.36, -0.45), 0.03, 0.045), 0.06)
    s.add(ellipsoid((0, 0.325, -0.478), (0.06, 0.052, 0.06)), 0.05)
    s.add(ellipsoid((0.053, 0.315, -0.42), (0.036, 0.034, 0.05)), 0.035)
    s.cut(ellipsoid((0.03, 0.27, -0.44), (0.015, 0.017, 0.026)), 0.02)
    # Mouth: its ground, two lips, which meet in a crease.
    s.add(ellipsoid((0, 0.205, -0.26), (0.155, 0.085, 0.11)), 0.09)
    s.cut(rod((0, 0.272, -0.392), (0, 0.24, -0.4), 0.01), 0.03)
    upper = ((0, 0.216, -0.366), (0.045, 0.222, -0.353), (0.1, 0.212, -0.322), (0.145, 0.208, -0.285))
    lower = ((0, 0.174, -0.364), (0.05, 0.177, -0.35), (0.1, 0.188, -0.318), (0.14, 0.2, -0.285))
    for lip, blend, r in ((upper, 0.018, (0.021, 0.021, 0.016, 0.012)), (lower, 0.01, (0.026, 0.025, 0.018, 0.012))):
        for i in range(3):
            s.add(rod(lip[i], lip[i + 1], r[i], r[i + 1]), blend)
    s.cut(rod((0, 0.196, -0.398), (0.055, 0.2, -0.386), 0.006), 0.012)
    s.cut(rod((0.055, 0.2, -0.386), (0.15, 0.207, -0.318), 0.006), 0.012)
    s.cut(rod((0, 0.13, -0.375), (0.05, 0.132, -0.37), 0.02), 0.06)
    s.cut(rod((0.1, 0.33, -0.39), (0.19, 0.2, -0.335), 0.012), 0.07)          # fold beside the mouth
    # Lids: a shell round the eye, open in front.
    s.add(ball(EYE, EYE_RADIUS + 0.019), 0.025)
    s.add(rod((0.08, 0.535, -0.335), (0.23, 0.525, -0.28), 0.02, 0.016), 0.03) # fold above
    s.cut(ellipsoid((x, y - 0.008, z - 0.09), (0.078, 0.041, 0.1)), 0.012)
    ear(s)
    # Neck and shoulders, cut flat.
    s.add(rod((0, 0.22, 0.1), (0, -0.3, 0.14), 0.13, 0.145), 0.11)
    s.add(rod((0.17, 0.28, 0.16), (0.035, -0.22, -0.015), 0.045, 0.035), 0.07) # muscles of the neck
    s.add(ellipsoid((0, -0.06, -0.02), (0.04, 0.045, 0.035)), 0.05)           # throat
    s.add(rod((0, -0.38, 0.13), (0.44, -0.5, 0.12), 0.15, 0.13), 0.15)
    s.add(rod((0.06, -0.3, -0.015), (0.36, -0.33, 0.02), 0.028, 0.02), 0.06)  # collar bone
    s.cut(rod((0, -0.25, -0.06), (0, -0.31, -0.08), 0.03), 0.06)
    s.cut(half_space((0, BOTTOM, 0), (0, 1, 0)), 0.02)
    return s


def ear(s):
    """A pointed blade with a hollow in it, folds, a lobe."""
    along, up, front = frame((0.86, 0.36, 0.36), (-0.3, 1, 0))
    front = front if front[2] < 0 else scaled(front, -1)
    axes = (along, up, front)

    def place(a, b, c):
        return add((0.3, 0.4, 0.05), add(scaled(along, a), add(scaled(up, b), scaled(front, c))))

    def leaf(a, b, c, radii, turn):
        """A flat ellipsoid whose length is turned from along towards up."""
        u = add(scaled(along, math.cos(turn)), scaled(up, math.sin(turn)))
        v = sub(scaled(up, math.cos(turn)), scaled(along, math.sin(turn)))
        return ellipsoid(place(a, b, c), radii, (u, v, front))

    def rounded(distance, much=0.012):
        return lambda x, y, z: distance(x, y, z) - much
    s.add(rounded(leaf(0.16, 0.03, 0.012, (0.24, 0.145, 0.038), 0.1)), 0.03)
    s.add(rounded(leaf(0.4, 0.1, 0.004, (0.26, 0.065, 0.018), 0.22)), 0.05)         # tip
    s.add(leaf(0.1, -0.11, 0.02, (0.075, 0.055, 0.032), 0.3), 0.04)           # lobe
    s.cut(leaf(0.18, 0.035, 0.068, (0.2, 0.112, 0.06), 0.1), 0.03)            # hollow
    s.cut(leaf(0.38, 0.095, 0.042, (0.21, 0.04, 0.032), 0.22), 0.03)
    s.add(rod(place(0.1, 0.07, 0.01), place(0.34, 0.075, 0.008), 0.02, 0.012), 0.03)
    s.add(rod(place(0.1, 0.07, 0.01), place(0.09, -0.07, 0.02), 0.02, 0.018), 0.03)
    s.cut(ball(place(0.05, -0.005, 0.03), 0.03), 0.03)
    s.add(ellipsoid(place(0.035, -0.03, 0.055), (0.026, 0.034, 0.02), axes), 0.02) # before its entrance


def skin_mesh():
    # Cells are small where lips, lids and ears are.
    xs = symmetric(steps(0.0, (0.24, 0.02), (0.98, 0.028)))
    ys = steps(-0.46, (-0.02, 0.036), (0.15, 0.026), (0.24, 0.0125), (0.41, 0.021), (0.54, 0.0165), (0.8, 0.026), (1.05, 0.04))
    zs = steps(-0.58, (-0.2, 0.02), (0.36, 0.023), (0.56, 0.04))
    mesh = surface(skin(), xs, ys, zs)
    mesh.relax(2)
    return mesh


def bone_mesh():
    xs = symmetric(steps(0.0, (0.24, 0.02), (0.6, 0.035)))
    ys = steps(-0.46, (0.08, 0.035), (0.6, 0.02), (1.0, 0.035))
    zs = steps(-0.4, (-0.15, 0.02), (0.5, 0.035))
    mesh = surface(bones(), xs, ys, zs)
    mesh.relax(2)
    return mesh


def st(p):
    return 0.5 + 0.5 * p[0], (1.05 - p[1]) / 1.5


def eyes():
    text = ""
    for side in (1, -1):
        # The pole of the sphere, where its iris is, looks ahead, a little down and to one side.
        text += (f"AttributeBegin\nTranslate {side * EYE[0]} {EYE[1]} {EYE[2]}\nRotate -9 0 1 0\nRotate 4 1 0 0\nRotate 180 0 1 0\n"
                 f"Sphere {EYE_RADIUS} {-EYE_RADIUS} {EYE_RADIUS} 360\nAttributeEnd\n")
    return text


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    mesh = skin_mesh()
    coordinates = " ".join(f"{v:.4f}" for p in mesh.points for v in st(p))
    text = {"skin.rib": mesh.rib().rstrip() + f' "vertex float[2] st" [ {coordinates} ]\n', "eyes.rib": eyes(), "bone.rib": bone_mesh().rib()}
    for name, what in text.items():
        (folder / name).write_text(what, encoding="ascii")


if __name__ == "__main__":
    main()
