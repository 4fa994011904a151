"""The pass runner, with programs in place of slrender and slc that write what they were given."""
import json
import os
import pathlib
import stat
import subprocess
import sys
import tempfile
import textwrap
import unittest

SCRIPT = pathlib.Path(__file__).parents[2] / "render/tools/slpass.py"

# Writes the file of each Display: the scenes, and what the files they name hold.
SLRENDER = '''\
#!/usr/bin/env python3
import json, os, re, sys
words = sys.argv[1:]
scenes = [w for w in words if w.endswith(".rib")]
text = "".join(open(s).read() for s in scenes)
if "Broken" in text:
    sys.exit("scene.rib:1: error: it is broken")
names = re.findall(r'"([^"]*)"', text)
shown = re.findall(r'Display "([^"]*)"', text)
held = "".join(open(n).read() for n in names if os.path.isfile(n) and n not in shown)
size = words[words.index("-res") + 1:words.index("-res") + 3] if "-res" in words else []
for name in shown:
    open(name, "w").write(text + held + " ".join(size))
open(words[words.index("--statisticsfile") + 1], "w").write(json.dumps({"rays": {"all": 7}, "shaded_points": 5}) + "\\n")
'''
SLC = '''\
#!/usr/bin/env python3
import sys
w = sys.argv[1:]
open(w[w.index("-o") + 1], "w").write(open(w[-1]).read())
open(w[w.index("-MF") + 1], "w").write(w[w.index("-o") + 1] + ": " + w[-1] + " " + w[-1].replace("matte.sl", "matte.h") + "\\n")
'''


class SlpassTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        for name, text in (("slrender", SLRENDER), ("slc", SLC)):
            self.write(f"bin/{name}", text).chmod(stat.S_IRWXU)

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))
        return path

    def passes(self, text):
        self.write("scene/passes.toml", text)

    def run_it(self, *words):
        return subprocess.run([sys.executable, SCRIPT, "--bin", "bin", "scene", *words], cwd=self.root, capture_output=True,
                              text=True)

    def ran(self, *words):
        """The passes that ran, in any order."""
        result = self.run_it(*words)
        self.assertEqual(result.returncode, 0, result.stderr)
        return sorted(line.split(": ")[1] for line in result.stdout.splitlines() if line.startswith("scene: "))

    def fails(self, *parts, status=1):
        result = self.run_it()
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)
        return result.stderr

    def made(self, name):
        return (self.root / "passes/scene" / name).read_text()

    def two_passes(self):
        # The order in the file is not that of need.
        self.passes("""\
            [[pass]]
            name = "beauty"
            rib = "beauty.rib"
            out = ["beauty.tif"]

            [[pass]]
            name = "mask"
            rib = "mask.rib"
            out = ["mask.tif"]
            """)
        self.write("scene/mask.rib", 'Display "mask.tif" "zfile" "z"\n')
        self.write("scene/beauty.rib", 'Display "beauty.tif" "file" "rgb" # after\nSurface "s" "map" "mask.tif"\n')

    def test_runs_what_is_needed_first_and_only_what_changed(self):
        self.two_passes()
        self.assertEqual(self.ran(), ["beauty", "mask"])
        self.assertIn('Display "mask.tif"', self.made("beauty.tif"))
        self.assertIn("everything is up to date", self.run_it().stdout)
        os.utime(self.root / "scene/mask.rib") # a new time is no change
        self.assertEqual(self.ran(), [])
        self.write("scene/beauty.rib", 'Display "beauty.tif" "file" "rgb"\nSurface "s" "map" "mask.tif"\n')
        self.assertEqual(self.ran(), ["beauty"])
        self.write("scene/mask.rib", 'Display "mask.tif" "zfile" "z" # moved\n')
        self.assertEqual(self.ran(), ["beauty", "mask"])
        self.assertIn("# moved", self.made("beauty.tif"))

    def test_what_was_tampered_with_is_made_again(self):
        self.two_passes()
        self.ran()
        (self.root / "passes/scene/mask.tif").write_text("other")
        self.assertEqual(self.ran(), ["mask"]) # and is what it was: the picture need not be made again
        (self.root / "passes/scene/beauty.tif").unlink()
        self.assertEqual(self.ran(), ["beauty"])
        self.assertEqual(self.ran("--force"), ["beauty", "mask"])

    def test_a_new_program_makes_everything_again(self):
        self.two_passes()
        self.ran()
        self.write("bin/slrender", SLRENDER + "# newer\n")
        self.assertEqual(self.ran(), ["beauty", "mask"])

    def test_shaders_and_their_headers(self):
        self.passes("""\
            shaders = ["../shaders"]
            [[pass]]
            name = "p"
            rib = "p.rib"
            out = ["p.tif"]
            """)
        self.write("scene/p.rib", 'Display "p.tif" "file" "rgb"\nSurface "matte"\n')
        self.write("shaders/matte.sl", "surface matte() {}")
        self.write("shaders/matte.h", "")
        self.write("shaders/other.sl", "surface other() {}")
        self.assertEqual(self.ran(), ["p", "shader matte"])
        self.write("shaders/other.sl", "surface other() { }")
        self.assertEqual(self.ran(), [])
        self.write("shaders/matte.sl", "surface matte() { }")
        self.assertEqual(self.ran(), ["p", "shader matte"])
        self.write("shaders/matte.h", "/* new */")
        self.assertEqual(self.ran(), ["shader matte"]) # which comes out the same here

    def test_scenes_that_are_made_and_archives(self):
        self.passes("""\
            archives = ["../models"]
            [[pass]]
            name = "render"
            rib = "made.rib"
            out = ["picture.tif"]

            [[pass]]
            name = "write"
            run = ["write.py", "made.rib", "{width}"]
            size = [30, 20]
            out = ["made.rib"]
            """)
        self.write("models/fish.rib", "Sphere\n")
        self.write("scene/helper.py", "NAME = 'picture.tif'\n")
        self.write("scene/write.py", """\
            import sys
            from helper import NAME
            open(sys.argv[1], "w").write('Display "' + NAME + '"\\nReadArchive "fish.rib"\\n# ' + sys.argv[2])
            """)
        self.assertEqual(self.ran(), ["render", "write"])
        self.assertIn("# 30", self.made("picture.tif"))
        self.write("models/fish.rib", "Disk\n")
        self.assertEqual(self.ran(), ["render"])
        self.write("scene/helper.py", "NAME = 'picture.tif' # changed\n")
        self.assertEqual(self.ran(), ["write"])
        self.assertEqual(self.ran("--scale", "0.5"), ["render", "write"])
        self.assertIn("# 15", self.made("picture.tif"))

    def test_variations_and_text(self):
        self.passes("""\
            [[pass]]
            name = "v{samples}"
            each.samples = [1, 4]
            size = [8, 6]
            text = 'Display "v{samples}.tif"'
            rib = "v.rib"
            out = ["v{samples}.tif"]
            """)
        self.write("scene/v.rib", "Sphere\n")
        self.assertEqual(self.ran(), ["v1", "v4"])
        self.assertEqual(self.made("v4.tif"), 'Display "v4.tif"\nSphere\n8 6')

    def test_in_chooses_among_the_names_of_a_scene(self):
        # One scene for both passes names both pictures.
        text = """\
            [[pass]]
            name = "mask"
            text = 'Display "mask.tif"'
            rib = "s.rib"
            {}
            out = ["mask.tif"]
            [[pass]]
            name = "beauty"
            text = 'Display "beauty.tif"'
            rib = "s.rib"
            out = ["beauty.tif"]
            """
        self.write("scene/s.rib", 'Surface "a" "mask.tif" "beauty.tif"\n')
        self.passes(text.format("# nothing"))
        self.fails("passes.toml:1: error: pass \"mask\" waits for itself: \"mask\" for \"beauty\" for \"mask\"; 'in' says which")
        self.passes(text.format("in = []"))
        self.assertEqual(self.ran(), ["beauty", "mask"])

    def test_page_and_statistics(self):
        self.two_passes()
        path = self.root / "scene/passes.toml"
        path.write_text('title = "Two <passes>"\npicture = "beauty.tif"\n' + path.read_text())
        self.ran("--page", "out/index.html")
        page = (self.root / "out/index.html").read_text()
        self.assertIn('<img src="../passes/scene/beauty.tif" alt="Two &lt;passes&gt;">', page)
        self.assertRegex(page, r"<td>mask</td><td>\d+\.\d\d</td><td>7</td><td>5</td>")
        self.assertIn("1 scenes, ", page)

    def test_a_pass_that_fails(self):
        self.two_passes()
        self.write("scene/mask.rib", "Broken\n")
        said = self.fails("scene.rib:1: error: it is broken",
                          'scene/passes.toml:8: error: pass "mask" failed: slrender ended with status 1; its messages are above',
                          "scene/passes.toml: not made: beauty, mask")
        self.assertLess(said.index("it is broken"), said.index("status 1"))
        self.write("scene/mask.rib", 'Display "mask.tiff"\n')
        self.fails('passes.toml:9: error: pass "mask" did not make "mask.tif": does its Display, or its command, write another file?')

    def test_mistakes(self):
        one = '[[pass]]\nname = "p"\nrib = "p.rib"\nout = ["p.tif"]\n'
        self.write("scene/p.rib", 'Display "p.tif"\n')
        for text, message in (
                ("[[pass]\n", "scene/passes.toml:1:7: error: "),
                ("title = 'none'\n", "passes.toml:1: error: there is no pass: begin one with [[pass]]"),
                (one + "ribs = 'p.rib'\n", "passes.toml:5: error: unknown key 'ribs'; did you mean 'rib'?"),
                ("[[pass]]\nname = 3\n", "passes.toml:2: error: 'name' must be a text"),
                ("size = [640]\n" + one, "passes.toml:1: error: 'size' must be [width, height] in pixels"),
                ("[[pass]]\nrib = 'p.rib'\nout = ['p.tif']\n", "passes.toml:1: error: this pass has no 'name'"),
                (one + "run = ['a']\n", "passes.toml:1: error: a pass has either 'rib', scenes for slrender, or 'run', a command"),
                (one + one, "passes.toml:6: error: pass \"p\" has the name of another; with 'each', put its keys in {} into the name"),
                (one + one.replace('"p"', '"q"'), "passes.toml:8: error: pass \"q\" makes \"p.tif\", which pass \"p\" makes, too"),
                (one.replace('"p.tif"', '"../p.tif"'),
                 "passes.toml:4: error: pass \"p\" makes \"../p.tif\", which would be outside its folder"),
                (one.replace("p.rib", "r.rib"),
                 "passes.toml:3: error: pass \"p\" renders \"r.rib\", which no pass makes and which is not in "),
                (one + 'in = ["p.tiff"]\n', "passes.toml:5: error: pass \"p\" takes \"p.tiff\", which no pass makes and which is not in "),
                (one + 'in = ["p.tiff"]\n', "; did you mean \"p.tif\"?"),
                (one + "text = '{size}'\n", "passes.toml:1: error: {size} has no value; there are none"),
                (one + "each.k = 3\n", "passes.toml:5: error: 'each.k' must be a list of values"),
                (one.replace('rib = "p.rib"', 'run = ["nosuchtool"]'),
                 "passes.toml:3: error: pass \"p\" needs the program 'nosuchtool', which is neither in "),
                (one.replace('rib = "p.rib"', 'run = ["a"]\ntext = "Sides 1"'),
                 "passes.toml:4: error: pass \"p\" has 'text', which is RIB before that of 'rib', but no 'rib'"),
                ("picture = 'q.tif'\n" + one, "passes.toml:1: error: no pass makes the picture \"q.tif\"; did you mean \"p.tif\"?"),
                ("shaders = ['s']\n" + one, "passes.toml:1: error: there is no shader or folder \"s\" beside the pass file"),
                ("archives = ['s']\n" + one, "passes.toml:1: error: there is no folder \"s\" beside the pass file"),
        ):
            with self.subTest(message):
                self.passes(text)
                self.fails(message)

    def test_no_file(self):
        self.fails("slpass: error: there is no pass file 'scene'", status=3)

    def test_dry_run(self):
        self.two_passes()
        result = self.run_it("-n")
        self.assertIn("scene: mask: ", result.stdout)
        self.assertFalse((self.root / "passes/scene/mask.tif").exists())


if __name__ == "__main__":
    unittest.main()
