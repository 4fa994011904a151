#!/usr/bin/env python3
"""A tuft of water weed as ribbons that get narrow and pale towards their ends: on y = 0, about 1 high."""
import argparse
import math
import random


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out")
    parser.add_argument("--blades", type=int, default=9)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--spread", type=float, default=0.16, help="radius of the tuft at its foot")
    parser.add_argument("--lean", type=float, default=0.15, help="how far the water bends it")
    g = parser.parse_args()
    chance, points, widths, colours, joints = random.Random(g.seed), [], [], [], 9
    for _ in range(g.blades):
        turn, root = chance.uniform(0, 2 * math.pi), g.spread * math.sqrt(chance.random())
        high, wave, tone = chance.uniform(0.55, 1.0), chance.uniform(0, 6.3), chance.uniform(0.75, 1.15)
        for k in range(joints + 2):
            # The first and the last are beyond the ends of the curve.
            v = (k - 1) / (joints - 1)
            x = root * math.cos(turn) * (1 + 0.8 * v) + g.lean * v * v + 0.05 * v * math.sin(wave + 7 * v)
            z = root * math.sin(turn) * (1 + 0.8 * v) + 0.05 * v * math.cos(wave + 6 * v)
            points += [x, high * v, z]
            if 1 <= k <= joints:
                widths.append(0.065 * (0.55 + 0.45 * math.sin(math.pi * min(1, 0.15 + 0.85 * v))) * (1 - 0.75 * v ** 3))
                colours += [tone * (0.35 + 0.65 * v)] * 3
    def numbers(values):
        return "[ " + " ".join(f"{v:.4g}" for v in values) + " ]"
    with open(g.out, "w", encoding="ascii") as file:
        file.write(f'Basis "catmull-rom" 1 "catmull-rom" 1\nCurves "cubic" {numbers([joints + 2] * g.blades)} "nonperiodic" "P" {numbers(points)}'
                   f' "varying width" {numbers(widths)} "varying float tone" {numbers(colours[::3])}\n')


if __name__ == "__main__":
    main()
