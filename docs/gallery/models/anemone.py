#!/usr/bin/env python3
"""A sea anemone as subdivision meshes: a foot and a crown of tentacles that lean with the water; about 1 high, on y = 0."""
import math
import random
import sys

from mesh import Mesh


def foot():
    mesh = Mesh()
    rings = []
    for y, r in ((0, 0.34), (0.06, 0.27), (0.22, 0.24), (0.36, 0.3), (0.42, 0.34), (0.45, 0.28)):
        rings.append(mesh.ring([(r * math.cos(a), y, r * math.sin(a)) for a in (-2 * math.pi * i / 14 for i in range(14))]))
    mesh.shell(rings)
    return mesh


def tentacle(chance, turn, root, long):
    """From a ring of the crown outwards and up, then bent by the water."""
    path, out = [], chance.uniform(0.5, 0.9) * root / 0.3
    wave, lean = chance.uniform(0, 6.3), 0.22 * long
    x, y, z = root * math.cos(turn), 0.4, root * math.sin(turn)
    for k in range(7):
        v = k / 6
        path.append((x + lean * v * v + 0.04 * v * math.sin(wave + 3 * v), y, z + 0.05 * v * math.cos(wave + 2.5 * v)))
        rise = math.cos(out * (1 - 0.3 * v))
        side = math.sin(out * (1 - 0.3 * v))
        x, y, z = x + long / 6 * side * math.cos(turn), y + long / 6 * rise, z + long / 6 * side * math.sin(turn)
    mesh = Mesh()
    mesh.tube(path, [0.036, 0.036, 0.033, 0.029, 0.026, 0.03, 0.03], 6) # a knob at its end
    return mesh


def main():
    chance = random.Random(7)
    made = [foot()]
    for count, root, long in ((18, 0.3, 0.5), (14, 0.21, 0.56), (9, 0.11, 0.6)):
        for i in range(count):
            made.append(tentacle(chance, 2 * math.pi * (i + chance.uniform(-0.3, 0.3)) / count, root, long * chance.uniform(0.85, 1.1)))
    with open(sys.argv[1], "w", encoding="ascii") as file:
        file.write("".join(mesh.rib() for mesh in made))


if __name__ == "__main__":
    main()
