# SPDX-License-Identifier: MIT
"""Files that the program writes are opened by the programs that people open them with, and their numbers compared.

    written_files.py PROGRAM

Tables in HDF5: h5py, h5ls and h5dump. Tables for NumPy: NumPy. CSV: Python's reader, and pandas where it is there. Pictures:
rsvg-convert, whose pixels must lie on the curves. Units: Python's readers of zip archives and XML. Scenes: Python's reader of
TOML. (C, C++, JavaScript and pages have tests of their own; tests/written_elsewhere.sh tries what Debian does not have.)
Exit 77 where one of these is missing."""

import csv
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import tomllib
import unittest
import xml.etree.ElementTree as xml
import zipfile
import zlib

TESTS = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(TESTS, "../scenes")
try:
    import h5py
    import numpy as np
    missing = [name for name in ("h5dump", "h5ls", "rsvg-convert") if shutil.which(name) is None]
except ImportError as error:
    missing = [error.name]
if missing:
    print("missing: " + ", ".join(missing))
    sys.exit(int(os.environ.get("ALEMBERT_NO_SKIP", 77)))
try:
    import pandas
except ImportError:
    pandas = None

PROGRAM = os.path.abspath(sys.argv.pop(1))
# Multipliers, reactions, contacts with text columns, generalized speeds, quaternions, friction.
MOTIONS = [("textbook/double_pendulum", []), ("textbook/slider_crank", ["--reactions"]), ("textbook/bouncing_ball", []),
           ("textbook/chaplygin_sleigh_in_speeds", []), ("textbook/free_body_quaternion", []), ("friction/stick_slip", []),
           ("textbook/relativistic_kepler", ["--sample", "1e-4"])]
# Names of other alphabets and with marks; a text that is longer than a block of HDF5.
UNUSUAL = "title = \"Pendel, 摆\"\n" + "# long\n" * 20000 + """gravity = [0, "-g"]
[parameters]
g = 9.81
[coordinates]
"θ" = { initial = 0.5, unit = "rad" }
units = { initial = 0.1, unit = "m", rate = 0.25 }
[[particle]]
name = "P"
mass = 1
position = ["(2 + units)*sin(θ)", "-(2 + units)*cos(θ)"]
[outputs]
"höhe" = "1 - cos(θ)"
[simulation]
duration = 1
"""


def run(*arguments):
    told = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)
    assert told.returncode in (0, 4), (arguments, told.returncode, told.stderr)
    return told.stdout


def rows_of_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return names, [list(column) for column in zip(*rows)] if rows else [[] for _ in names]


def parts_of(png):
    """Width, height, numbers of a pixel and lines of a picture with 8 bits for each of red, green, blue (and opacity)."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data = 8, b""
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", png[at + 8:at + 18])
        if kind == b"IDAT":
            data += png[at + 8:at + 8 + length]
        at += 12 + length
    assert depth == 8 and colour in (2, 6)
    return width, height, 4 if colour == 6 else 3, zlib.decompress(data)


def pixels(png, rows):
    """The first rows of (red, green, blue): the filters of PNG undone."""
    width, _, size, lines = parts_of(png)
    length, result = size * width, []
    before = bytearray(length)
    for y in range(rows):
        kind, line = lines[y * (length + 1)], bytearray(lines[y * (length + 1) + 1:(y + 1) * (length + 1)])
        for k in range(length if kind else 0):
            left, up, corner = (line[k - size], before[k], before[k - size]) if k >= size else (0, before[k], 0)
            if kind == 1:
                guess = left
            elif kind == 2:
                guess = up
            elif kind == 3:
                guess = (left + up) // 2
            else:
                of_left, of_up, of_corner = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
                guess = left if of_left <= of_up and of_left <= of_corner else up if of_up <= of_corner else corner
            line[k] = (line[k] + guess) & 255
        before = line
        result.append(np.frombuffer(bytes(line), dtype=np.uint8).reshape(width, size)[:, :3])
    return np.array(result, dtype=int)


class Files(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = holder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def written(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def tables(self, *command):
        """The same table in all forms."""
        for ending in ("csv", "npz", "h5"):
            run(*command, "-o", self.path("table." + ending))
        names, columns = rows_of_csv(self.path("table.csv"))
        self.assertGreater(len(columns[0]), 1)
        return names, columns

    def same(self, given, texts):
        """Numbers bit by bit (CSV has 17 digits), or texts."""
        if given.dtype.kind in "fi":
            self.assertEqual(given.tolist(), [type(given.tolist()[0])(text) for text in texts])
        else:
            self.assertEqual([one.decode() if isinstance(one, bytes) else str(one) for one in given], texts)

    def compare_hdf5(self, names, columns, scene):
        path = self.path("table.h5")
        with h5py.File(path, "r") as file:
            self.assertEqual([name.decode() for name in file.attrs["columns"]], names)
            self.assertEqual(sorted(file), sorted(names))
            for name, texts in zip(names, columns):
                self.same(file[name][()], texts)
                self.assertIn("unit", file[name].attrs)
            stored = file.attrs["scene"]
            with open(scene, encoding="utf-8") as source:
                self.assertEqual(stored.decode() if isinstance(stored, bytes) else str(stored), source.read())
        listed = subprocess.run(["h5ls", path], capture_output=True, text=True)
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertEqual(len(listed.stdout.splitlines()), len(names))
        dumped = self.path("dumped")
        done = subprocess.run(["h5dump", "-d", "/" + names[0], "-m", "%.17g", "-y", "-w", "1", "-o", dumped, path],
                              capture_output=True, text=True)  # yapf: disable
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(dumped, encoding="utf-8") as file:
            self.assertEqual([float(line.strip(" ,\n")) for line in file if line.strip()], [float(x) for x in columns[0]])

    def compare(self, scene, *command):
        names, columns = self.tables(*command)
        self.compare_hdf5(names, columns, scene)
        with np.load(self.path("table.npz")) as file:
            self.assertEqual(file["columns"].tolist(), names)
            for name, texts in zip(names, columns):
                self.same(file[name], texts)
        if pandas is not None:
            table = pandas.read_csv(self.path("table.csv"), float_precision="round_trip")
            self.assertEqual(list(table.columns), names)
            for name, texts in zip(names, columns):
                if table[name].dtype.kind in "fi":
                    self.assertEqual(table[name].tolist(), [float(text) for text in texts])
                else:
                    self.assertEqual([str(one) for one in table[name]], texts)

    def test_motions_in_all_forms(self):
        for name, options in MOTIONS:
            with self.subTest(scene=name):
                scene = os.path.join(SCENES, name + ".toml")
                self.compare(scene, "simulate", scene, "--duration", "1", *options)

    def test_names_of_other_alphabets_and_long_texts(self):
        scene = self.written("pendel.toml", UNUSUAL)
        self.compare(scene, "simulate", scene)
        with h5py.File(self.path("table.h5"), "r") as file:
            self.assertAlmostEqual(file["höhe"][0], 1 - math.cos(0.5), places=15)
            unit = file["θ"].attrs["unit"]
            self.assertEqual(unit.decode() if isinstance(unit, bytes) else unit, "rad")

    def test_sweeps_in_all_forms(self):
        scene = os.path.join(SCENES, "textbook/double_pendulum.toml")
        sweep = ("sweep", scene, "--vary", "theta1=0.1:0.5:5", "--vary", "l1=1:2:3", "--duration", "0.5")
        self.compare(scene, *sweep)
        self.compare(scene, *sweep, "--along", "min,max")
        ball = os.path.join(SCENES, "textbook/bouncing_ball.toml")
        self.compare(ball, "sweep", ball, "--vary", "y=1:2:4", "--duration", "0.5")

    def test_other_tables_are_csv_that_others_read(self):
        for scene, command in (("textbook/rotating_hoop", ["equilibrium", "--vary", "Omega=1:6"]),
                               ("textbook/double_pendulum", ["bench", "--method", "rk4"]),
                               ("textbook/double_pendulum", ["stability", "--matrices", "--along"])):
            with self.subTest(command=command[0]):
                verb, *options = command
                told = subprocess.run([PROGRAM, verb, os.path.join(SCENES, scene + ".toml"), *options, "-o", self.path("t.csv")],
                                      capture_output=True, text=True)  # yapf: disable
                if told.returncode == 3:  # another verb or option has this table
                    self.fail(told.stderr)
                names, columns = rows_of_csv(self.path("t.csv"))
                self.assertEqual(len({len(column) for column in columns}), 1)
                self.assertEqual(len(set(names)), len(names))

    def test_the_curves_of_a_picture_lie_where_the_numbers_are(self):
        scene = os.path.join(SCENES, "textbook/double_pendulum.toml")
        run("simulate", scene, "--duration", "4", "-o", self.path("t.csv"), "--svg", self.path("t.svg"))
        picture = xml.parse(self.path("t.svg")).getroot()
        scale = 2
        drawn = subprocess.run(["rsvg-convert", "--zoom", str(scale), self.path("t.svg")], capture_output=True)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        names, columns = rows_of_csv(self.path("t.csv"))
        t = np.array(columns[0], dtype=float)
        space = "{http://www.w3.org/2000/svg}"
        frame = next(one for one in picture.iter(space + "rect") if one.get("fill") == "none")
        curves = [one for one in picture.iter(space + "path") if one.get("stroke-width") == "1.6"]
        self.assertEqual(len(curves), 5)
        x0, top, width, height = (float(frame.get(key)) for key in ("x", "y", "width", "height"))
        seen = pixels(drawn.stdout, math.ceil(scale * (top + height)))[math.ceil(scale * top) + 2:]
        # The numbers beside the frame and their heights: the scale of the chart of theta1 and theta2.
        ticks = [(float(one.get("y")) - 4, float(one.text.replace("−", "-"))) for one in picture.iter(space + "text")
                 if one.get("text-anchor") == "end" and top - 6 < float(one.get("y")) < top + height + 12]
        slope, zero = np.polyfit([value for _, value in ticks], [y for y, _ in ticks], 1)
        for label, curve in zip(("theta1", "theta2"), curves):
            colour = [int(curve.get("stroke")[k:k + 2], 16) for k in (1, 3, 5)]
            is_on = np.abs(seen - colour).sum(axis=2) < 12
            values = np.array(columns[names.index(label)], dtype=float)
            looked = 0
            for column in range(math.ceil(scale * x0) + 4, math.floor(scale * (x0 + width)) - 4):
                heights = np.flatnonzero(is_on[:, column])
                if len(heights) == 0 or heights[-1] - heights[0] > 8:  # under another curve, or steep
                    continue
                value = np.interp(((column + 0.5) / scale - x0) / width * t[-1], t, values)
                y = (heights.mean() + 0.5 + math.ceil(scale * top) + 2) / scale
                self.assertLess(abs(y - (zero + slope * value)), 1.5, (label, column))  # less than the line is wide
                looked += 1
            self.assertGreater(looked, 300, label)

    def test_every_kind_of_picture_is_drawn(self):
        double, hoop = (os.path.join(SCENES, "textbook", name + ".toml") for name in ("double_pendulum", "rotating_hoop"))
        for command in (("derive", double), ("simulate", double, "--duration", "1"),
                        ("sweep", double, "--vary", "theta1=0.1:0.5:5", "--duration", "0.5"),
                        ("sweep", double, "--vary", "theta1=0.1:0.5:5", "--vary", "l1=1:2:4", "--duration", "0.5"),
                        ("equilibrium", hoop, "--vary", "Omega=1:6"), ("bench", double, "--method", "rk4"),
                        ("stability", hoop, "--vary", "Omega=1:6", "--at", "theta=0")):
            with self.subTest(command=command[0]):
                run(*command, "--svg", self.path("p.svg"))
                drawn = subprocess.run(["rsvg-convert", self.path("p.svg")], capture_output=True)
                self.assertEqual(drawn.returncode, 0, drawn.stderr)
                width, height, _, lines = parts_of(drawn.stdout)
                self.assertGreater(min(width, height), 50)
                self.assertGreater(len(set(lines)), 30)  # a page without anything on it has few numbers

    def test_units_are_archives_with_a_description_and_the_start(self):
        scene = os.path.join(SCENES, "textbook/slider_crank.toml")
        start = json.loads(run("eval", scene, "--json"))
        for version in ("2", "3"):
            run("emit", scene, "--fmu", self.path("u.fmu"), "--fmi", version)
            with zipfile.ZipFile(self.path("u.fmu")) as archive:
                self.assertIsNone(archive.testzip())
                description = xml.fromstring(archive.read("modelDescription.xml"))
            told = {}
            for variable in description.iter("ScalarVariable" if version == "2" else "Float64"):
                number = variable.find("Real") if version == "2" else variable
                told[variable.get("name")] = number.get("start")
            for name, value in {**start["coordinates"]}.items():
                self.assertAlmostEqual(float(told[name]), value, places=12)

    def test_scenes_are_toml_that_others_read(self):
        run("new", self.path("first.toml"))
        with open(self.path("first.toml"), "rb") as file:
            first = tomllib.load(file)
        self.assertEqual(json.loads(run("eval", self.path("first.toml"), "--json"))["coordinates"].keys(),
                         first["coordinates"].keys())  # yapf: disable
        run("import", os.path.join(TESTS, "robots/arm6.urdf"), "-o", self.path("arm.toml"))
        with open(self.path("arm.toml"), "rb") as file:
            arm = tomllib.load(file)
        robot = xml.parse(os.path.join(TESTS, "robots/arm6.urdf"))
        masses = {link.get("name"): float(link.find("inertial/mass").get("value")) for link in robot.iter("link")
                  if link.find("inertial") is not None}  # yapf: disable
        masses.pop("base_link")  # the ground
        self.assertAlmostEqual(sum(body["mass"] for body in arm["body"]), sum(masses.values()), places=12)


unittest.main(argv=sys.argv)
