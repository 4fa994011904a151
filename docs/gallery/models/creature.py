#!/usr/bin/env python3
"""A young dragon as a RIB archive of subdivision meshes: it stands on y = 0 and looks along -z, about 2.3 long with its tail and 1.2 high.

Its body is one solid of smooth blends, made symmetric and straight; then the tail and the head are turned, which bends the mesh."""
import math
import sys

from mesh import Mesh, add, scaled, sheet, sub
from solids import Solid, ball, ellipsoid, frame, half_space, rod, steps, surface, symmetric

EYE, EYE_RADIUS = (0.078, 1.055, -0.625), 0.036
# The spine from the neck to the tip of the tail: z, y, radius of the body there.
SPINE = [(-0.43, 0.9, 0.075), (-0.37, 0.78, 0.085), (-0.27, 0.67, 0.115), (-0.1, 0.6, 0.165), (0.08, 0.585, 0.17), (0.24, 0.57, 0.155),
         (0.4, 0.52, 0.11), (0.56, 0.43, 0.082), (0.74, 0.31, 0.062), (0.94, 0.2, 0.047), (1.16, 0.125, 0.034), (1.38, 0.085, 0.024),
         (1.56, 0.075, 0.014)]
TAIL, NECK = 0.42, -0.24 # where it begins to bend, along z


def trunk(s):
    s.add(ellipsoid((0, 0.5, -0.12), (0.155, 0.185, 0.22)))                   # chest
    s.add(ellipsoid((0, 0.475, 0.08), (0.165, 0.165, 0.24)), 0.1)             # belly
    s.add(ellipsoid((0, 0.5, 0.27), (0.13, 0.145, 0.18)), 0.1)                # hips
    for (z0, y0, r0), (z1, y1, r1) in zip(SPINE, SPINE[1:]):
        # The ridge of the spine lies on top: the rods are below it by their radius.
        s.add(rod((0, y0 - r0, z0), (0, y1 - r1, z1), r0, r1), 0.06)
    s.add(rod((0, 0.83, -0.42), (0, 0.99, -0.5), 0.078, 0.075), 0.06)         # neck
    s.cut(ellipsoid((0.2, 0.62, 0.1), (0.05, 0.09, 0.3)), 0.1)                # flanks


def head(s):
    s.add(ellipsoid((0, 1.03, -0.55), (0.1, 0.085, 0.115)), 0.09)             # skull
    s.add(ellipsoid((0, 0.985, -0.7), (0.066, 0.05, 0.135)), 0.07)            # muzzle
    s.add(ellipsoid((0, 0.99, -0.81), (0.052, 0.04, 0.045)), 0.035)           # nose
    s.add(rod((0.05, 0.965, -0.5), (0.022, 0.945, -0.8), 0.042, 0.026), 0.035) # jaw
    s.add(ellipsoid((0.07, 0.99, -0.56), (0.045, 0.045, 0.06)), 0.04)         # cheek
    # Brow, socket, lid.
    s.add(rod((0.045, 1.07, -0.7), (0.098, 1.1, -0.57), 0.014, 0.024), 0.03)
    s.cut(ball((EYE[0] + 0.012, EYE[1] - 0.003, EYE[2] - 0.012), EYE_RADIUS), 0.022)
    s.add(ball(EYE, EYE_RADIUS + 0.008), 0.012)
    s.cut(ellipsoid((EYE[0] + 0.034, EYE[1] - 0.006, EYE[2] - 0.012), (0.028, 0.019, 0.036)), 0.006)
    # The mouth runs back below the eye; nostrils.
    lips = ((0, 0.966, -0.87), (0.045, 0.966, -0.83), (0.068, 0.964, -0.7), (0.1, 0.985, -0.58))
    for a, b in zip(lips, lips[1:]):
        s.cut(rod(a, b, 0.011), 0.014)
    s.cut(ellipsoid((0.026, 1.012, -0.85), (0.01, 0.009, 0.016)), 0.012)
    s.add(ellipsoid((0, 1.035, -0.815), (0.012, 0.026, 0.022)), 0.02)         # the horn on its nose
    # Horns, and a frill of three spines.
    horn = ((0.058, 1.095, -0.51), (0.082, 1.165, -0.43), (0.1, 1.2, -0.33), (0.112, 1.205, -0.235))
    for i, r in enumerate((0.03, 0.023, 0.015)):
        s.add(rod(horn[i], horn[i + 1], r, (0.023, 0.015, 0.006)[i]), 0.02)
    for tip, r in (((0.185, 1.05, -0.36), 0.019), ((0.175, 0.97, -0.38), 0.018), ((0.14, 0.91, -0.42), 0.016)):
        s.add(rod((0.07, 0.99, -0.5), tip, r, 0.008), 0.025)


def leg(s, joints, radii, blend):
    for a, b, r, q in zip(joints, joints[1:], radii, radii[1:]):
        s.add(rod(a, b, r, q), blend)


def foot(s, heel, size):
    """A paw of three toes that looks ahead from its heel, with claws."""
    x, _, z = heel
    s.add(ellipsoid((x, 0.045 * size, z - 0.03), (0.058 * size, 0.045 * size, 0.07 * size)), 0.04)
    for turn in (-0.5, 0.0, 0.5):
        u, w = math.sin(turn), -math.cos(turn)
        knuckle = (x + 0.06 * u * size, 0.042 * size, z - 0.03 + 0.07 * w * size)
        tip = (x + 0.125 * u * size, 0.026 * size, z - 0.03 + 0.135 * w * size)
        s.add(rod(knuckle, tip, 0.026 * size, 0.022 * size), 0.014)
        s.add(rod((tip[0], tip[1] + 0.004, tip[2]), (tip[0] + 0.045 * u * size, 0.006, tip[2] + 0.045 * w * size), 0.013 * size, 0.003), 0.004)


def legs(s):
    s.add(ellipsoid((0.115, 0.48, -0.17), (0.07, 0.13, 0.1)), 0.06)           # shoulder
    leg(s, ((0.125, 0.45, -0.17), (0.165, 0.27, -0.11), (0.165, 0.06, -0.19)), (0.07, 0.046, 0.036), 0.03)
    foot(s, (0.165, 0, -0.2), 1.0)
    s.add(ellipsoid((0.12, 0.43, 0.26), (0.085, 0.15, 0.13)), 0.07)           # thigh
    leg(s, ((0.13, 0.42, 0.26), (0.165, 0.28, 0.175), (0.17, 0.14, 0.33), (0.17, 0.05, 0.29)), (0.1, 0.064, 0.038, 0.036), 0.05)
    foot(s, (0.17, 0, 0.28), 1.1)


def plates(s):
    """Along the spine, tall on the shoulders, small on neck and tail."""
    z = -0.46
    while z < 1.45:
        y, slope = spine_at(z)
        tall = 0.085 * math.exp(-((z - 0.08) / 0.5) ** 2) + 0.026
        along, up, _ = frame((0, slope, 1), (0, 1, 0.5)) # they lean back
        s.add(ellipsoid((0, y + 0.35 * tall, z + 0.1 * tall), (0.62 * tall, tall, 0.013), (along, up, (1, 0, 0))), 0.012)
        z += 0.075 + 0.5 * tall


def spine_at(z):
    for (z0, y0, _), (z1, y1, _) in zip(SPINE, SPINE[1:]):
        if z0 <= z <= z1 or z < z0:
            return y0 + (z - z0) / (z1 - z0) * (y1 - y0), (y1 - y0) / (z1 - z0)
    return SPINE[-1][1], 0.0


def spade(s):
    """The end of the tail."""
    s.add(ellipsoid((0, 0.062, 1.58), (0.075, 0.012, 0.1)), 0.02)
    s.add(ellipsoid((0.055, 0.062, 1.53), (0.035, 0.011, 0.06)), 0.03)


def creature():
    s = Solid()
    trunk(s)
    head(s)
    legs(s)
    plates(s)
    spade(s)
    s.cut(half_space((0, 0.002, 0), (0, 1, 0)))
    return s


def eyes():
    text = ""
    for side in (1, -1):
        x, y, z = bend((side * EYE[0], *EYE[1:]))
        text += f"AttributeBegin\nTranslate {x:.4g} {y:.4g} {z:.4g}\nSphere {EYE_RADIUS} {-EYE_RADIUS} {EYE_RADIUS} 360\nAttributeEnd\n"
    return text


def wings():
    """On each side an arm, a hand of four fingers, and skin between them and the body."""
    shoulder, elbow, wrist = (0.03, 0.5, -0.14), (0.23, 0.8, 0.06), (0.28, 1.0, -0.12)
    tips = ((0.44, 1.4, 0.22), (0.54, 1.2, 0.5), (0.5, 0.96, 0.68), (0.34, 0.74, 0.64))
    fingers = [[add(wrist, add(scaled(sub(tip, wrist), t), (0.0, 0.07 * math.sin(math.pi * t), 0.03 * math.sin(math.pi * t))))
                for t in (k / 6 for k in range(7))] for tip in tips]
    arm = [wrist, elbow, elbow, shoulder, shoulder, (0.06, 0.56, 0.1), (0.05, 0.54, 0.3)]
    arm[1], arm[3] = scaled(add(wrist, elbow), 0.5), scaled(add(elbow, shoulder), 0.5)
    made = []
    for side in (1, -1):
        def turned(p):
            return side * p[0], p[1], p[2]
        bones = Mesh()
        bones.tube([turned(p) for p in (shoulder, elbow, wrist)], (0.05, 0.034, 0.027))
        for finger in fingers:
            bones.tube([turned(p) for p in finger], [0.02 - 0.0023 * k for k in range(7)])
        made.append(bones)
        for first, second in zip(fingers, fingers[1:] + [arm]):
            columns = []
            for i in range(7):
                u = i / 6
                sag = 4 * u * (1 - u)
                column = []
                for k in range(7):
                    p = add(scaled(first[k], 1 - u), scaled(second[k], u))
                    p = add(p, scaled(sub(wrist, p), 0.22 * sag * (k / 6) ** 2)) # the edge hangs in from tip to tip
                    column.append(turned((p[0] + 0.03 * sag * k / 6, p[1], p[2])))
                columns.append(column)
            made.append(sheet(columns, 0.006))
    return made


def bend(p):
    """Turns the tail to one side and the head to the other."""
    x, y, z = p
    if z > TAIL:
        long, turned = 1.25, 1.9
        n = 24
        px, pz, step = 0.0, TAIL, (z - TAIL) / n
        for i in range(n):
            a = turned * ((i + 0.5) * step / long) ** 1.3
            px, pz = px + step * math.sin(a), pz + step * math.cos(a)
        a = turned * ((z - TAIL) / long) ** 1.3
        return px + x * math.cos(a), y, pz - x * math.sin(a)
    if z < NECK and y > 0.55:
        t = min(max((y - 0.62) / 0.36, 0), 1)
        a = -0.2 * t * t * (3 - 2 * t)
        c, q, dz = math.cos(a), math.sin(a), z + 0.42
        return x * c + dz * q, y, -0.42 + dz * c - x * q
    return p


def body():
    # Cells are small where the plates, the head and the toes are.
    xs = symmetric(steps(0.0, (0.03, 0.009), (0.28, 0.016)))
    ys = steps(-0.02, (0.08, 0.012), (0.46, 0.024), (0.9, 0.021), (1.24, 0.0135))
    zs = steps(-0.93, (-0.4, 0.0135), (0.4, 0.024), (1.72, 0.023))
    mesh = surface(creature(), xs, ys, zs)
    mesh.relax(2)
    mesh.points = [bend(p) for p in mesh.points]
    return mesh


def main():
    with open(sys.argv[1], "w", encoding="ascii") as file:
        file.write("".join(mesh.rib() for mesh in [body()] + wings()) + eyes())


if __name__ == "__main__":
    main()
