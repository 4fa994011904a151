#!/usr/bin/env python3
"""Cameras for the pictures that a flat pane of glass shows: what it mirrors, and what is seen in the water behind it.

Prints RIB to be put between the camera and WorldBegin of the pass, as if it were part of the camera:

    paneplan.py reflect --pane X Y Z NX NY NZ
    paneplan.py refract --pane X Y Z NX NY NZ --eye X Y Z [--eta 1.33]

The pane is a point of it and its normal, which points to the viewer, all in world space; --eye is where the viewing camera is.

Law of reflection: the reflection camera is the viewing camera mirrored at the pane; the world is mirrored instead, which is the same, and what
lies behind the pane is clipped away. Snell's law: behind the pane everything seems nearer. The refraction camera stands on the same
normal of the pane as the viewing camera, tan(angle in air) / tan(angle in water) times as far away, the angles being those of the ray
to the given point of the pane; for that ray the picture is exact. Again the world is moved instead: it is pressed together
along the normal. Both leave the pane itself in its place, so that the pictures fall on it by the projection of their own files.
"""
import argparse
import math
import sys


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    length = math.sqrt(dot(v, v))
    if length == 0:
        raise ValueError("the normal of the pane has no length")
    return [x / length for x in v]


def scaling_along(normal, point, factor):
    """The matrix, for row vectors, that scales distances from the plane by `factor`."""
    n, k = unit(normal), factor - 1
    rows = [[(1 if i == j else 0) + k * n[i] * n[j] for j in range(3)] + [0] for i in range(3)]
    move = [-k * dot(point, n) * n[j] for j in range(3)]
    return rows + [move + [1]]


def mirror(normal, point):
    return scaling_along(normal, point, -1)


def pressing(normal, point, eye, eta):
    """How much nearer things behind the pane seem: tan(in water) / tan(in air) for the ray from eye to point."""
    n = unit(normal)
    to_eye = [e - p for e, p in zip(eye, point)]
    height = dot(to_eye, n)
    if height <= 0:
        raise ValueError("the eye is behind the pane: turn the normal round")
    lateral = math.sqrt(max(dot(to_eye, to_eye) - height * height, 0))
    if lateral < 1e-6 * height:
        return 1 / eta
    sine = lateral / math.hypot(lateral, height) / eta
    return (sine / math.sqrt(1 - sine * sine)) / (lateral / height)


def rib_matrix(rows):
    return "ConcatTransform [ " + "  ".join(" ".join(f"{x:.9g}" for x in row) for row in rows) + " ]"


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kind", choices=["reflect", "refract"])
    parser.add_argument("--pane", type=float, nargs=6, required=True, metavar=("X", "Y", "Z", "NX", "NY", "NZ"))
    parser.add_argument("--eye", type=float, nargs=3, metavar=("X", "Y", "Z"))
    parser.add_argument("--eta", type=float, default=1.33)
    parser.add_argument("--out", help="a file for it, in place of standard output")
    given = parser.parse_args(arguments)
    point, normal = given.pane[:3], given.pane[3:]
    try:
        if given.kind == "reflect":
            matrix = mirror(normal, point)
            visible = unit(normal)
        else:
            if given.eye is None:
                parser.error("refract needs --eye")
            matrix = scaling_along(normal, point, pressing(normal, point, given.eye, given.eta))
            visible = [-x for x in unit(normal)]
    except ValueError as problem:
        sys.exit(f"paneplan.py: {problem}")
    # What lies on the side the plane's normal points to is clipped.
    hidden = [-x for x in visible]
    text = f"{rib_matrix(matrix)}\nClippingPlane " + " ".join(f"{x:.9g}" for x in point + hidden) + "\n"
    if given.out:
        with open(given.out, "w", encoding="ascii") as file:
            file.write(text)
    else:
        print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
