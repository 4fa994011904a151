#!/usr/bin/env python3
"""A glass tank: its edges as bars, or its water as a closed box whose normals point out."""
import argparse

from mesh import Mesh


def bars(low, high, t):
    """Bars of thickness t along the twelve edges of a box."""
    mesh = Mesh()
    for axis in range(3):
        others = [k for k in range(3) if k != axis]
        for a in (0, 1):
            for b in (0, 1):
                lo, hi = [0.0] * 3, [0.0] * 3
                lo[axis], hi[axis] = low[axis] - t, high[axis] + t
                for k, side in zip(others, (a, b)):
                    edge = (low, high)[side][k]
                    lo[k], hi[k] = edge - (t if side == 0 else 0.002), edge + (t if side == 1 else 0.002)
                mesh.box(lo, hi)
    return mesh


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", choices=["edges", "water"])
    parser.add_argument("out")
    parser.add_argument("--box", type=float, nargs=6, default=[-1, 0, -0.6, 1, 1.15, 0.6], metavar=("X", "Y", "Z", "X", "Y", "Z"))
    parser.add_argument("--thickness", type=float, default=0.03)
    g = parser.parse_args()
    low, high = g.box[:3], g.box[3:]
    if g.part == "edges":
        mesh = bars(low, high, g.thickness)
    else:
        mesh = Mesh()
        mesh.box(low, high)
    with open(g.out, "w", encoding="ascii") as file:
        file.write(mesh.rib("polygons"))


if __name__ == "__main__":
    main()
