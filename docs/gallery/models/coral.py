#!/usr/bin/env python3
"""A branching coral as one subdivision mesh: branches grow out of faces, and branch from their own sides. It stands on y = 0,
about 2 high. tipdistance and basedistance are the business of slfields."""
import argparse
import math
import random

from mesh import Mesh, add, dot, scaled, unit


class Coral:
    def __init__(self, seed, levels, spread, thickness, lift):
        self.random = random.Random(seed)
        self.mesh = Mesh()
        self.levels, self.spread, self.thickness, self.lift = levels, spread, thickness, lift

    def wander(self, direction, amount):
        r = self.random
        return unit(add(direction, scaled((r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1)), amount)))

    def branch(self, face, direction, length, radius, level):
        """Grows a branch out of a face: some joints, then its end, or new branches from the end and the walls."""
        mesh, r = self.mesh, self.random
        joints = max(2, round(length / (1.7 * radius)))
        walls = []
        for i in range(joints):
            direction = unit(add(self.wander(direction, 0.22), (0, self.lift, 0)))
            thick = radius * (1 - 0.25 * (i + 1) / joints) * (1 + 0.12 * r.uniform(-1, 1))
            walls = mesh.extrude(face, scaled(direction, length / joints), thick)
            # Some stubs on the way.
            if level < self.levels and 0 < i < joints - 1 and r.random() < 0.35:
                self.stub(r.choice(walls), radius * 0.62, level)
        radius *= 0.75
        if level >= self.levels:
            mesh.extrude(face, scaled(direction, 0.6 * radius), 0.62 * radius) # a round end
            return
        sides = sorted(walls, key=lambda w: -dot(mesh.normal(w), (0, 1, 0)))[:3]
        chosen = r.sample(sides, 2 if r.random() < 0.6 else 1)
        for wall in chosen:
            out = mesh.normal(wall)
            way = unit(add(scaled(out, self.spread), direction))
            self.branch(wall, way, length * r.uniform(0.62, 0.9), radius * 0.86, level + 1)
        away = [mesh.normal(w) for w in chosen]
        lean = scaled((sum(a[0] for a in away), sum(a[1] for a in away), sum(a[2] for a in away)), -0.35 * self.spread)
        self.branch(face, unit(add(direction, lean)), length * r.uniform(0.7, 0.95), radius * 0.95, level + 1)

    def stub(self, wall, radius, level):
        way = unit(add(self.mesh.normal(wall), (0, 0.6, 0)))
        if level + 1 < self.levels and self.random.random() < 0.5:
            self.branch(wall, way, radius * 5, radius, self.levels)
        else:
            self.mesh.extrude(wall, scaled(way, 1.6 * radius), radius * 0.9)
            self.mesh.extrude(wall, scaled(way, 0.8 * radius), radius * 0.6)

    def grow(self):
        mesh, t = self.mesh, self.thickness
        mesh.box((-t, 0, -t), (t, 0.6 * t, t))
        top, sides = 1, [2, 3, 4, 5]
        for side in sides: # a foot
            mesh.extrude(side, add(scaled(mesh.normal(side), 0.5 * t), (0, -0.1 * t, 0)), 0.75 * t)
        start = self.random.uniform(0, 2 * math.pi)
        stems = self.random.sample(sides, 2)
        for i, side in enumerate(stems):
            way = unit(add(scaled(mesh.normal(side), 0.75), (0.1 * math.cos(start + i), 1, 0.1 * math.sin(start + i))))
            self.branch(side, way, 0.6, 0.8 * t, 1)
        self.branch(top, (0, 1, 0), 0.75, t, 0)
        return mesh


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--levels", type=int, default=3)
    parser.add_argument("--spread", type=float, default=1.0, help="how far branches lean out")
    parser.add_argument("--thickness", type=float, default=0.16)
    parser.add_argument("--lift", type=float, default=0.12, help="how much branches turn up")
    g = parser.parse_args()
    mesh = Coral(g.seed, g.levels, g.spread, g.thickness, g.lift).grow()
    with open(g.out, "w", encoding="ascii") as file:
        file.write(mesh.rib())


if __name__ == "__main__":
    main()
