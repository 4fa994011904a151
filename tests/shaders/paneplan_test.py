"""The cameras of shaders/glass/paneplan.py: the law of reflection and Snell's law."""
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).parents[2] / "shaders/glass/paneplan.py"


def run(*arguments):
    return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], capture_output=True, text=True)


def matrix(text):
    numbers = [float(x) for x in text.splitlines()[0].strip("ConcatTransform []").split()]
    return [numbers[4 * i:4 * i + 4] for i in range(4)]


def moved(m, p):
    return [sum((*p, 1)[i] * m[i][j] for i in range(4)) for j in range(3)]


class Pane(unittest.TestCase):
    point, normal = (1, 2, 3), (1, 2, -2)

    def on_pane(self):
        return [(1, 2, 3), (3, 1, 3), (1, 3, 4)]  # differences at right angles to the normal

    def close(self, a, b):
        for x, y in zip(a, b):
            self.assertAlmostEqual(x, y, 6)

    def test_mirroring(self):
        m = matrix(run("reflect", "--pane", *self.point, *self.normal).stdout)
        for p in self.on_pane():
            self.close(moved(m, p), p)
        self.close(moved(m, (2, 4, 1)), (0, 0, 5))  # one normal in front, one behind
        self.close(moved(m, moved(m, (7, -3, 2))), (7, -3, 2))

    def test_snell(self):
        # From an eye at height 3, 3 to the side of the point: 45 degrees in air.
        out = run("refract", "--pane", 0, 0, 0, 0, 0, -1, "--eye", 3, 0, -3, "--eta", 1.33).stdout
        m = matrix(out)
        inside = math.asin(math.sin(math.radians(45)) / 1.33)
        # A point at depth 2 on the refracted ray is seen on the straight one.
        seen = moved(m, (-2 * math.tan(inside), 0, 2))
        self.assertAlmostEqual(seen[0] / seen[2], -1, 6)
        self.assertIn("ClippingPlane 0 0 0 0 0 -1", out.replace("-0 ", "0 "))

    def test_straight_down(self):
        m = matrix(run("refract", "--pane", 0, 0, 0, 0, 0, -1, "--eye", 0, 0, -5).stdout)
        self.assertAlmostEqual(moved(m, (0, 0, 4))[2], 4 / 1.33, 6)

    def test_a_file_in_place_of_standard_output(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "mirror.rib"
            self.assertEqual(run("reflect", "--pane", 0, 0, 0, 0, 0, -1, "--out", file).stdout, "")
            self.assertEqual(file.read_text(), run("reflect", "--pane", 0, 0, 0, 0, 0, -1).stdout)

    def test_mistakes(self):
        self.assertIn("the eye is behind the pane: turn the normal round",
                      run("refract", "--pane", 0, 0, 0, 0, 0, 1, "--eye", 0, 0, -5).stderr)
        self.assertIn("the normal of the pane has no length", run("reflect", "--pane", 0, 0, 0, 0, 0, 0).stderr)
        self.assertIn("refract needs --eye", run("refract", "--pane", 0, 0, 0, 0, 0, 1).stderr)


if __name__ == "__main__":
    unittest.main()
