#!/usr/bin/env python3
"""slpass: makes pictures that take several passes, and makes again only what has changed.

A pass file (TOML) lists passes: scenes for slrender, and other programs that make files or change them. What a pass takes, and so the
order of passes, is found in the scenes themselves: a string that names a file another pass makes, a file beside the pass file, or a
shader of its `shaders`. Passes run in a folder of their own. A pass is up to date when its command, its program and the contents of
all it takes are what they were. docs/passes.md describes the file; docs/gallery is full of them.
"""
import argparse
import concurrent.futures
import difflib
import hashlib
import html
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys
import threading
import time
import tomllib

VERSION = "slpass 0.1.0 (Anemone)"
STATE = ".slpass.json"
TOP_KEYS = {"title": str, "picture": str, "size": list, "shaders": list, "archives": list, "pass": list}
PASS_KEYS = {"name": str, "rib": (str, list), "text": str, "run": list, "in": list, "out": list, "size": list, "each": dict}


class Problem(Exception):
    """A mistake, with the place where it can be mended."""


class Hashes:
    """Contents of files as short texts; each file is read once while it stays as it is."""

    def __init__(self):
        self.known, self.lock = {}, threading.Lock()

    def of(self, path):
        stat = os.stat(path)
        stamp = (stat.st_mtime_ns, stat.st_size)
        with self.lock:
            if self.known.get(path, (None,))[0] == stamp:
                return self.known[path][1]
        with open(path, "rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
        with self.lock:
            self.known[path] = (stamp, digest)
        return digest


class PassFile:
    """The text of a pass file as tables, with the lines where they stand."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        try:
            text = self.path.read_text(encoding="utf-8")
        except OSError as error:
            raise Problem(f"slpass: error: cannot read '{path}': {error.strerror}") from None
        self.lines = text.splitlines()
        try:
            self.top = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            place = re.search(r"\(at (?:line (\d+), column (\d+)|end of document)\)", str(error))
            line, column = (place[1], place[2]) if place and place[1] else (len(self.lines), 1)
            what = re.sub(r" \(at .*\)", "", str(error))
            raise Problem(f"{path}:{line}:{column}: error: {what[:1].lower() + what[1:]}") from None
        self.check(self.top, TOP_KEYS, None)
        if not self.top.get("pass"):
            raise self.error(None, None, "there is no pass: begin one with [[pass]]")
        for number, table in enumerate(self.top["pass"]):
            self.check(table, PASS_KEYS, number)

    def line(self, number, key):
        """Of a key of the pass with this number, counted from 0, or of the head of the file (None)."""
        heads = [i for i, line in enumerate(self.lines) if re.match(r"\s*\[\[\s*pass\s*\]\]", line)]
        begin = 0 if number is None else heads[number]
        end = next((h for h in heads if h > begin or number is None), len(self.lines))
        for i in range(begin, end):
            if key and re.match(rf"\s*{re.escape(key)}\b", self.lines[i]):
                return i + 1
        return begin + 1

    def error(self, number, key, what):
        return Problem(f"{self.path}:{self.line(number, key)}: error: {what}")

    def check(self, table, keys, number):
        kinds = {str: "a text", list: "a list", dict: "a table", (str, list): "a text or a list"}
        for key, value in table.items():
            if key not in keys:
                near = difflib.get_close_matches(key, keys, 1)
                hint = f"did you mean '{near[0]}'?" if near else "there are " + ", ".join(keys)
                raise self.error(number, key, f"unknown key '{key}'; {hint}")
            if not isinstance(value, keys[key]):
                raise self.error(number, key, f"'{key}' must be {kinds[keys[key]]}")
        size = table.get("size", [1, 1])
        if len(size) != 2 or not all(isinstance(n, int) and n > 0 for n in size):
            raise self.error(number, "size", "'size' must be [width, height] in pixels")


class Pass:
    """One run of one program. `words` are its command, without what depends on the machine; `takes` names files."""

    def __init__(self, scene, name, number, out):
        self.scene, self.name, self.number, self.out = scene, name, number, out
        self.ribs, self.words, self.text, self.size, self.given, self.shader = [], [], "", None, None, None
        self.record = {}

    def error(self, key, what):
        return self.scene.file.error(self.number, "shaders" if self.shader else key, f"pass \"{self.name}\" {what}")


def listed(value):
    return value if isinstance(value, list) else [value]


class Scene:
    """The passes of one file."""

    def __init__(self, path, arguments):
        self.file = PassFile(path)
        self.folder = self.file.path.resolve().parent
        self.name = self.folder.name if self.file.path.stem == "passes" else self.file.path.stem
        self.work = pathlib.Path(arguments.out).resolve() / self.name
        self.scale = arguments.scale
        self.title = self.file.top.get("title", self.name)
        self.picture = self.file.top.get("picture")
        self.archives = [self.folder] + [self.source_folder(f, "archives") for f in self.file.top.get("archives", [])]
        self.shaders = self.find_shaders()
        self.passes, self.makers = {}, {}
        state = self.work / STATE
        self.kept = json.loads(state.read_text()) if state.is_file() else {}
        for number, table in enumerate(self.file.top["pass"]):
            for values in self.combinations(number, table):
                self.add(self.make_pass(number, table, values))
        if self.picture and self.picture not in self.makers:
            raise self.file.error(None, "picture", f"no pass makes the picture \"{self.picture}\"{self.suggestion(self.picture)}")

    def source_folder(self, name, key):
        path = self.folder / name
        if not path.is_dir():
            raise self.file.error(None, key, f"there is no folder \"{name}\" beside the pass file")
        return path

    def find_shaders(self):
        found = {}
        for name in self.file.top.get("shaders", []):
            path = self.folder / name
            if not path.exists():
                raise self.file.error(None, "shaders", f"there is no shader or folder \"{name}\" beside the pass file")
            for source in sorted(path.glob("*.sl")) if path.is_dir() else [path]:
                found.setdefault(source.stem, source)
        return found

    def combinations(self, number, table):
        each = table.get("each", {})
        for key, values in each.items():
            if not isinstance(values, list) or not values:
                raise self.file.error(number, "each", f"'each.{key}' must be a list of values")
        return [dict(zip(each, values)) for values in itertools.product(*each.values())]

    def make_pass(self, number, table, values):
        for key in ("name", "out"):
            if not table.get(key):
                raise self.file.error(number, None, f"this pass has no '{key}'")
        if ("rib" in table) == ("run" in table):
            raise self.file.error(number, None, "a pass has either 'rib', scenes for slrender, or 'run', a command")
        size = table.get("size", self.file.top.get("size"))
        if size:
            size = [max(1, round(n * self.scale)) for n in size]
            values = {"width": size[0], "height": size[1]} | values

        def filled(text):
            if not isinstance(text, (str, int, float)):
                raise self.file.error(number, None, "lists of a pass hold texts and numbers")
            return re.sub(r"\{(\w+)\}", lambda m: str(value_of(m[1])), str(text))

        def value_of(key):
            if key not in values:
                raise self.file.error(number, None, f"{{{key}}} has no value; there are {', '.join(values) or 'none'}")
            return values[key]

        made = Pass(self, filled(table["name"]), number, [filled(o) for o in table["out"]])
        made.ribs = [filled(r) for r in listed(table.get("rib", []))]
        made.words = [filled(w) for w in table.get("run", [])]
        made.text = filled(table.get("text", ""))
        made.size = size if made.ribs else None
        made.given = [filled(i) for i in table["in"]] if "in" in table else None
        if made.text and not made.ribs:
            raise made.error("text", "has 'text', which is RIB before that of 'rib', but no 'rib'")
        return made

    def add(self, made):
        if made.name in self.passes:
            raise made.error("name", "has the name of another; with 'each', put its keys in {} into the name")
        for out in made.out:
            if out in self.makers:
                raise made.error("out", f"makes \"{out}\", which pass \"{self.makers[out].name}\" makes, too")
            if pathlib.PurePath(out).is_absolute() or ".." in pathlib.PurePath(out).parts:
                raise made.error("out", f"makes \"{out}\", which would be outside its folder")
            self.makers[out] = made
        made.record = self.kept.get(made.name, {})
        self.passes[made.name] = made

    def save(self):
        """Remembers what the passes were made of, also of those that are not made this time."""
        records = {p.name: {k: v for k, v in p.record.items() if k != "done"} for p in self.passes.values() if p.record}
        part = self.work / (STATE + ".part")
        part.write_text(json.dumps(records, indent=1))
        part.replace(self.work / STATE)

    def suggestion(self, name):
        near = difflib.get_close_matches(name, self.makers, 1)
        return f"; did you mean \"{near[0]}\"?" if near else ""

    def source(self, name):
        """The file beside the pass file, or in a folder of archives, of this name."""
        for folder in self.archives:
            path = folder / name
            if name and path.is_file():
                return path
        return None

    def compilation(self, name):
        """The pass that compiles a shader."""
        title = f"shader {name}"
        if title not in self.passes:
            made = Pass(self, title, None, [f"shaders/{name}.slo"])
            made.shader = self.shaders[name]
            self.add(made)
        return self.makers[f"shaders/{name}.slo"]

    def takes(self, wanted):
        """(files that other passes make, source files) of a pass, as far as it can be told now: what is in a scene that is
        itself made is known when it is there."""
        made, sources = {}, set()
        if wanted.shader:
            return [], [wanted.shader] + [pathlib.Path(f) for f in wanted.record.get("included", []) if os.path.exists(f)]
        for name in wanted.given or []:
            if name in self.makers:
                made[name] = None
            elif path := self.source(name):
                sources.add(path)
            else:
                raise wanted.error("in", f"takes \"{name}\", which no pass makes and which is not in {self.folder}"
                                   + self.suggestion(name))
        todo = list(wanted.ribs) + wanted.words
        for name in wanted.ribs:
            if name not in self.makers and not self.source(name):
                raise wanted.error("rib", f"renders \"{name}\", which no pass makes and which is not in {self.folder}"
                                   + self.suggestion(name))
        todo += re.findall(r'"([^"\n]*)"', wanted.text)
        seen = set(wanted.out)
        while todo:
            name = todo.pop()
            if name in seen:
                continue
            seen.add(name)
            path = None
            if name in self.makers:
                if wanted.given is not None and name not in wanted.given and name not in wanted.ribs + wanted.words:
                    continue
                made[name] = None
                path = self.work / name if self.makers[name].record.get("done") else None
            elif path := self.source(name):
                sources.add(path)
            elif name in self.shaders and wanted.ribs:
                made[self.compilation(name).out[0]] = None
            if path and path.suffix == ".rib" and path.is_file():
                todo += re.findall(r'"([^"\n]*)"', path.read_text(encoding="latin-1"))
            elif path and path.suffix == ".py":
                imported = re.findall(r"^\s*(?:from|import)\s+(\w+)", path.read_text(encoding="utf-8"), re.M)
                todo += [os.path.relpath(path.with_name(m + ".py"), self.folder) for m in imported
                         if path.with_name(m + ".py").is_file()]
        return list(made), sorted(sources)


class Runner:
    """Runs what is not up to date, several passes at once where they do not wait for each other."""

    def __init__(self, arguments):
        self.arguments, self.hashes, self.lock = arguments, Hashes(), threading.Lock()
        self.failed, self.count = False, 0
        self.processors = len(os.sched_getaffinity(0))
        self.jobs = arguments.jobs or self.processors

    def program(self, wanted, name):
        """The path of a program: those of Anemone lie beside this one, or where --bin says."""
        if path := wanted.scene.source(name):
            return path
        for folder in [pathlib.Path(self.arguments.bin)] + [pathlib.Path(p) for p in os.get_exec_path()]:
            if (folder / name).is_file() and os.access(folder / name, os.X_OK):
                return folder / name
        raise wanted.error("run" if wanted.words else "rib",
                           f"needs the program '{name}', which is neither in {self.arguments.bin} nor on the PATH; --bin says "
                           "where Anemone's programs are")

    def command(self, wanted, threads):
        """(program, the words of the command as they are run, the same as they are remembered)."""
        scene = wanted.scene
        if wanted.shader:
            program = self.program(wanted, "slc")
            words = ["-q", "-MD", "-MF", f"{wanted.out[0]}.d", "-o", wanted.out[0], str(wanted.shader)]
            return program, [program] + words, words[:-1]
        if wanted.words:
            program = self.program(wanted, wanted.words[0])
            words = [str(scene.source(w) or w) for w in wanted.words[1:]]
            python = [sys.executable] if program.suffix == ".py" else []
            return program, python + [program] + words, wanted.words[1:]
        program = self.program(wanted, "slrender")
        files = [str(scene.source(r) or r) for r in wanted.ribs]
        if wanted.text:
            before = scene.work / f".{wanted.name}.rib"
            before.write_text(wanted.text + "\n", encoding="utf-8")
            files.insert(0, str(before))
        size = ["-res", *map(str, wanted.size)] if wanted.size else []
        words = [f"-t:{threads}", "--statisticsfile", f".{wanted.name}.json", "--shaders", "shaders:@", "--archives",
                 ":".join(map(str, scene.archives + ["."])), *size, *files]
        return program, [program] + words, size + wanted.ribs + [wanted.text]

    def signature(self, wanted, program, words, inputs):
        digest = hashlib.sha256()
        tools = [program] + (sorted(program.parent.glob("*.so")) if wanted.ribs else [])
        for word in [*words, *(self.hashes.of(p) for p in tools)]:
            digest.update(word.encode() + b"\0")
        for path in inputs:
            digest.update(f"{path.name}\0{self.hashes.of(path)}\0".encode())
        return digest.hexdigest()

    def inputs(self, wanted):
        made, sources = wanted.scene.takes(wanted)
        return [wanted.scene.work / name for name in made] + sources

    def is_current(self, wanted, signature):
        scene, kept = wanted.scene, wanted.record
        if self.arguments.force or kept.get("signature") != signature:
            return False
        return all((scene.work / o).is_file() and self.hashes.of(scene.work / o) == h for o, h in kept["outputs"].items())

    def say(self, text, stream=sys.stdout):
        with self.lock:
            print(text, file=stream, flush=True)

    def run(self, wanted, threads):
        """Makes one pass, if it must be made. What went wrong is raised."""
        scene = wanted.scene
        for out in wanted.out:
            (scene.work / out).parent.mkdir(parents=True, exist_ok=True)
        program, command, words = self.command(wanted, threads)
        signature = self.signature(wanted, program, words, self.inputs(wanted))
        if self.is_current(wanted, signature):
            wanted.record["done"] = True
            return
        if self.arguments.dry_run:
            self.say(f"{scene.name}: {wanted.name}: " + " ".join(map(str, command)))
            wanted.record["done"] = True
            return
        environment = os.environ | {"PATH": f"{self.arguments.bin}{os.pathsep}{os.environ.get('PATH', '')}",
                                    "PYTHONDONTWRITEBYTECODE": "1"} # nothing is written beside the sources
        begin = time.monotonic()
        result = subprocess.run(command, cwd=scene.work, env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                                text=True, errors="replace", check=False)
        seconds = time.monotonic() - begin
        if output := (result.stdout + result.stderr).strip():
            self.say(output, sys.stderr)
        if result.returncode:
            raise wanted.error("run" if wanted.words else "rib",
                               f"failed: {program.name} ended with status {result.returncode}; its messages are above")
        missing = [o for o in wanted.out if not (scene.work / o).is_file()]
        if missing:
            raise wanted.error("out", f"did not make \"{missing[0]}\": does its Display, or its command, write another file?")
        wanted.record = {"seconds": round(seconds, 3), "outputs": {o: self.hashes.of(scene.work / o) for o in wanted.out}}
        if wanted.shader: # the headers are known only now
            wanted.record["included"] = dependencies(scene.work / f"{wanted.out[0]}.d")
            signature = self.signature(wanted, program, words, self.inputs(wanted))
        if wanted.ribs:
            wanted.record |= statistics(scene.work / f".{wanted.name}.json")
        wanted.record |= {"signature": signature, "done": True}
        self.count += 1
        self.say(f"{scene.name}: {wanted.name}: {seconds:.2f} s")

    def make(self, scene):
        """All passes of a scene. False if one failed."""
        scene.work.mkdir(parents=True, exist_ok=True)
        running, fine = {}, True
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            while True:
                ready, waiting = self.sort_out(scene, running.values())
                if not fine:
                    ready = []
                elif not ready and not running and waiting:
                    raise self.circle(waiting)
                ready = ready[:self.jobs - len(running)]
                for made in ready:
                    threads = max(1, self.processors // min(self.jobs, len(ready) + len(running)))
                    running[pool.submit(self.run, made, threads)] = made
                if not running:
                    break
                done, _ = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
                for future in done:
                    running.pop(future)
                    if problem := future.exception():
                        if not isinstance(problem, Problem):
                            raise problem
                        self.say(problem, sys.stderr)
                        fine = False
                scene.save()
        left = [p.name for p in scene.passes.values() if not p.record.get("done")]
        if not fine and left:
            self.say(f"{scene.file.path}: not made: {', '.join(left)}", sys.stderr)
        return fine

    @staticmethod
    def sort_out(scene, running):
        """Passes that can run now, and those that wait for others, with what they wait for."""
        ready, waiting = [], {}
        for made in [p for p in scene.passes.values() if not p.record.get("done") and p not in running]:
            needs = {scene.makers[n] for n in scene.takes(made)[0]}
            needs = [n for n in needs if not n.record.get("done")]
            if needs:
                waiting[made] = needs
            else:
                ready.append(made)
        # Shaders found meanwhile.
        known = set(ready) | set(waiting) | set(running)
        ready += [p for p in scene.passes.values() if p not in known and not p.record.get("done")]
        return ready, waiting

    @staticmethod
    def circle(waiting):
        chain = [next(iter(waiting))]
        while chain[-1] not in chain[:-1]:
            chain.append(next(n for n in waiting[chain[-1]] if n in waiting))
        chain = chain[chain.index(chain[-1]):]
        text = " for ".join(f"\"{p.name}\"" for p in chain)
        return chain[0].error("in", f"waits for itself: {text}; 'in' says which of the files that a scene names a pass takes")


def dependencies(file):
    """The files of a rule for make, without its target."""
    text = file.read_text().replace("\\\n", " ").partition(":")[2]
    return [p.replace("\\ ", " ") for p in re.findall(r"(?:\\ |\S)+", text)]


def statistics(file):
    """Of all frames of a run of slrender."""
    frames = [json.loads(line) for line in file.read_text().splitlines()]
    return {"rays": sum(f["rays"]["all"] for f in frames), "points": sum(f["shaded_points"] for f in frames)}


PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Gallery</title><style>
body {{ font: 15px/1.4 sans-serif; margin: 2em auto; max-width: 70em; background: #1b1d1f; color: #ddd }}
section {{ display: flex; gap: 1.5em; margin: 0 0 2.5em }} img {{ max-width: 40em }} h2 {{ margin: 0 0 .5em; font-size: 1.15em }}
td, th {{ padding: .1em .9em .1em 0; text-align: right }} td:first-child, th:first-child {{ text-align: left }}
</style></head><body><h1>Gallery</h1>
{scenes}<p>{total}</p></body></html>
"""


def write_page(path, scenes):
    """Pictures and times as one HTML file."""
    target = pathlib.Path(path).resolve()
    parts, total = [], 0.0
    for scene in scenes:
        rows = []
        for made in scene.passes.values():
            seconds = made.record.get("seconds", 0)
            total += seconds
            numbers = [f"{seconds:.2f}"] + [f"{made.record[k]:,}" if k in made.record else "" for k in ("rays", "points")]
            rows.append(f"<tr><td>{html.escape(made.name)}</td>" + "".join(f"<td>{n}</td>" for n in numbers) + "</tr>")
        picture = ""
        if scene.picture:
            source = html.escape(os.path.relpath(scene.work / scene.picture, target.parent))
            picture = f"<img src=\"{source}\" alt=\"{html.escape(scene.title)}\">"
        heads = "<tr><th>pass</th><th>seconds</th><th>rays</th><th>points shaded</th></tr>"
        parts.append(f"<section>{picture}<div><h2>{html.escape(scene.title)}</h2><table>{heads}{''.join(rows)}</table></div></section>\n")
    summary = f"{len(scenes)} scenes, {total:.1f} seconds"
    target.parent.mkdir(parents=True, exist_ok=True)
    part = target.with_suffix(".part")
    part.write_text(PAGE.format(scenes="".join(parts), total=summary), encoding="utf-8")
    part.replace(target)


def parse_arguments():
    parser = argparse.ArgumentParser(prog="slpass", description="Makes pictures that take several passes, and makes again only "
                                     "what has changed.", epilog="Exit status: 0 fine, 1 a pass file is wrong or a pass failed, "
                                     "2 wrong usage, 3 a pass file is missing.")
    parser.add_argument("files", nargs="*", default=["passes.toml"], help="pass files, or folders with a passes.toml (passes.toml)")
    parser.add_argument("-o", "--out", default="passes", metavar="FOLDER", help="a folder for each scene is made in it (passes)")
    parser.add_argument("-j", "--jobs", type=int, default=0, metavar="N",
                        help="passes at once; 1 for times that can be compared (all processors)")
    parser.add_argument("--scale", type=float, default=1, metavar="X", help="sizes of pictures are multiplied by it")
    parser.add_argument("-f", "--force", action="store_true", help="make everything again")
    parser.add_argument("-n", "--dry-run", action="store_true", help="print the commands that would run, as far as they are known")
    parser.add_argument("--page", metavar="FILE", help="write an HTML page with pictures and times")
    parser.add_argument("--bin", default=os.path.dirname(os.path.realpath(__file__)), metavar="FOLDER",
                        help="where Anemone's programs are (beside slpass)")
    parser.add_argument("--version", action="version", version=VERSION)
    given = parser.parse_args()
    if given.jobs < 0 or not 0 < given.scale <= 16:
        parser.error("-j is not negative, --scale from 0 to 16")
    return given


def main():
    arguments = parse_arguments()
    arguments.bin = os.path.abspath(arguments.bin)
    runner, scenes, fine = Runner(arguments), [], True
    for name in arguments.files:
        path = os.path.join(name, "passes.toml") if os.path.isdir(name) else name
        if not os.path.exists(path):
            print(f"slpass: error: there is no pass file '{path}'", file=sys.stderr)
            return 3
        try:
            scene = Scene(path, arguments)
            scenes.append(scene)
            fine = runner.make(scene) and fine
        except Problem as problem:
            print(problem, file=sys.stderr)
            fine = False
    if arguments.page:
        write_page(arguments.page, scenes)
    if fine and not runner.count and not arguments.dry_run:
        print("everything is up to date")
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
