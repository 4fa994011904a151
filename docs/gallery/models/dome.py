#!/usr/bin/env python3
"""A sky of lamps: parallel lights from all around, as a RIB archive. Together they are to a white matte surface that nothing shadows as
bright as --brightness, brighter from above; with their shadows traced they give the ambient occlusion of each point."""
import argparse
import math


def directions(count):
    """Evenly over the sphere: turned on by the golden angle from one to the next, from the top down."""
    for i in range(count):
        y = 1 - (2 * i + 1) / count
        angle, r = i * math.pi * (3 - math.sqrt(5)), math.sqrt(1 - y * y)
        yield r * math.cos(angle), y, r * math.sin(angle)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split(":")[0])
    parser.add_argument("out")
    parser.add_argument("--lights", type=int, default=48)
    parser.add_argument("--brightness", type=float, default=0.2)
    parser.add_argument("--above", type=float, nargs=3, default=(0.9, 1, 1.15), help="colour from above")
    parser.add_argument("--below", type=float, nargs=3, default=(0.5, 0.42, 0.36), help="and from below")
    parser.add_argument("--first", type=int, default=100, help="handle of the first light")
    given = parser.parse_args()
    with open(given.out, "w", encoding="ascii") as file:
        for i, d in enumerate(directions(given.lights)):
            # The mean cosine over all directions is 1/4.
            k = 4 * given.brightness / given.lights
            t = 0.5 + 0.5 * d[1]
            colour = [k * (b + t * (a - b)) for a, b in zip(given.above, given.below)]
            file.write(f'LightSource "shadowdistant" {given.first + i} "from" [ {d[0]:.4f} {d[1]:.4f} {d[2]:.4f} ] "to" [ 0 0 0 ] '
                       f'"lightcolor" [ {" ".join(f"{c:.5f}" for c in colour)} ]\n')


if __name__ == "__main__":
    main()
