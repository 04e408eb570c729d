# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of users: read as text, and written whole or not at all."""
import argparse
import csv
import errno
import io
import os
import shutil
import subprocess
import tomllib
import unittest
import unittest.mock
from collections.abc import Callable
from contextlib import ExitStack, redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

import numpy as np
import test_log
import test_uncertain_runs
from made_up_state import Temporary, made_up
from matplotlib.figure import Figure
from test_band import KNOWN
from test_error_bar import ErrorBar

from caisson import command_line
from caisson.__main__ import GROUPS, main
from caisson import disk
from caisson.commands import park, park_rows
from caisson.disk import InputError
from caisson.error_bars import bar_study
from caisson.export.command import FORMS
from caisson.paths import ROOT
from caisson.study import Options
from caisson.table import write_csv
from caisson.terminal import CLEAR, PlainText

EXPORT = "caisson.export.command"
FULL = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


class Reading(Temporary):
    """Bytes that are no text."""

    def test_text(self) -> None:
        path = self.path / "a.txt"
        path.write_bytes(b"\xef\xbb\xbfa\nb\xc3\xbc")
        self.assertEqual(disk.read_text(path), "a\nb\u00fc")
        path.write_bytes("a\nGr\u00fcndung".encode("latin-1"))
        with self.assertRaisesRegex(InputError, f"{path}, line 2: the byte 0xfc is no"):
            disk.read_text(path)

    def test_devices_and_directories(self) -> None:
        (self.path / "large").write_bytes(bytes(1001))
        with unittest.mock.patch.object(disk, "MOST", 1000):
            with self.assertRaisesRegex(InputError, "large is larger than"):
                disk.read_text(self.path / "large")
        os.mkfifo(self.path / "pipe")
        for path in (Path("/dev/zero"), self.path / "pipe"):
            with self.assertRaisesRegex(InputError, f"{path} is a device or a pipe: "):
                disk.read_text(path)
        with self.assertRaisesRegex(InputError, "cannot be read: Is a directory"):
            disk.read_text(self.path)
        with self.assertRaisesRegex(InputError, "cannot be read: embedded null"):
            disk.read_text(Path("a\0b"))

    def test_remarks(self) -> None:
        """No text of a user begins a line of its own, or reaches a terminal as code."""
        text = "x\nexit()\r\x1b[31m\x85y\u2028z"
        self.assertEqual(disk.remarks("#", [text]), ["# x exit()  [31m y z"])
        name = 'O"Brien\\1\n.prm'
        said = tomllib.loads(f"a = {disk.quoted(name)}")["a"]
        self.assertEqual(said, name)


class Terminal(unittest.TestCase):
    """What is written there is no command to it."""

    def test_commands(self) -> None:
        for text, written in (
            ("plot: a\x1b[2J.csv\n", "plot: a\\x1b[2J.csv\n"),
            ("a\tb\n\x07\n", "a\tb\n\\x07\n"),
            (f"{CLEAR}10 % {CLEAR}", f"{CLEAR}10 % \\r\\x1b[K"),
        ):
            stream = io.StringIO()
            print(text, end="", file=PlainText(stream))
            self.assertEqual(stream.getvalue(), written)


class Writing(Temporary):
    """What stays where writing fails."""

    def setUp(self) -> None:
        super().setUp()
        self.old = self.path / "old"
        self.old.write_text("mine", encoding="utf-8")

    def names(self) -> list[str]:
        """Return what the directory has."""
        return sorted(set(os.listdir(self.path)) - {disk.RECORD})

    def test_a_full_disk(self) -> None:
        for name in ("os.fsync", "pathlib.Path.replace"):
            with unittest.mock.patch(name, side_effect=FULL):
                for path, kept in (self.old, "; what was"), (self.path / "new", "$"):
                    with self.assertRaisesRegex(
                        OSError, f"{path} .*: No space.*{kept}"
                    ):
                        disk.write(path, "x")
        self.assertEqual(self.names(), ["old"])
        self.assertEqual(self.old.read_text(encoding="utf-8"), "mine")

    def test_devices(self) -> None:
        """They get the bytes, and are not replaced by a file."""
        link = self.path / "link"
        link.symlink_to("/dev/full")
        with self.assertRaisesRegex(OSError, "link cannot be written: No space left"):
            disk.write(link, "x" * 10000)
        self.assertTrue(link.is_symlink())

    def test_all_or_none(self) -> None:
        new = self.path / "new"

        def write_both(overwrite: bool, text: str = "x") -> None:
            with disk.all_or_none(overwrite):
                disk.write(new, "x")
                disk.write(self.old, text)
                self.assertEqual(self.old.read_text(encoding="utf-8"), "mine")

        with self.assertRaisesRegex(InputError, f"{self.old} exists, and differs"):
            write_both(False)
        self.assertEqual(self.names(), ["old"])
        write_both(False, "mine")
        write_both(True)
        self.assertEqual(self.old.read_text(encoding="utf-8"), "x")
        with self.assertRaises(ZeroDivisionError):
            with disk.all_or_none(True):
                disk.write(new, str(1 / 0))
        disk.write(new, "y")
        self.assertEqual(new.read_text(encoding="utf-8"), "y")

    def test_keep(self) -> None:
        """Another file goes to the next earlier_N, the same one stays. A folder of the
        user with a number that no run comes to does not count."""
        for name in ("earlier_7", "earlier_999999999"):
            (self.path / name).mkdir()
        for text in ("x", "x", "y"):
            disk.keep(self.old, text)
        names = [f"earlier_{number}" for number in (7, 8, 9, 999_999_999)]
        self.assertEqual(self.names(), [*names, "old"])
        self.assertEqual((self.path / "earlier_8/old").read_text("utf-8"), "mine")
        self.assertEqual((self.path / "earlier_9/old").read_text("utf-8"), "x")

    def test_own_and_other_files(self) -> None:
        """A file that we wrote is replaced, one of others or one that was changed goes
        to earlier_N; as do those of another name where one that differs is removed."""
        new = self.path / "new"
        with redirect_stderr(io.StringIO()) as said:
            for text in ("a", "b", "c"):
                disk.write(new, text)
            self.assertEqual((self.names(), said.getvalue()), (["new", "old"], ""))
            new.write_text("C", encoding="utf-8")
            disk.write(new, "d")
            disk.write(self.old, "e")
            with disk.all_or_none():
                disk.write(new, "f")
            new.write_text("F", encoding="utf-8")
            disk.remove(new)
            disk.remove(self.old)
        self.assertEqual(self.names(), ["earlier_1", "earlier_2"])
        kept = [path.read_text("utf-8") for path in sorted(self.path.glob("e*/*"))]
        self.assertEqual(kept, ["C", "mine", "F"])
        self.assertIn(
            f"kept: {self.old} is now {self.path}/earlier_1/old", said.getvalue()
        )

    def test_an_input(self) -> None:
        """It is never replaced, also not by --overwrite."""
        disk.begin([self.old])
        self.addCleanup(disk.begin, [])
        disk.write(self.old, "free")
        disk.read_bytes(self.old)
        disk.write(self.old, "free")  # as it is
        for overwrite in (None, True):
            with self.assertRaisesRegex(InputError, f"{self.old} is an input of this"):
                with disk.all_or_none(overwrite):
                    disk.write(self.old, "x")

    def test_owner(self) -> None:
        """A directory has the results of one file."""
        one, two = self.path / "a/t.csv", self.path / "b/t.csv"
        disk.claim(self.path / "r", one, "choose another")
        disk.claim(self.path / "r", one, "choose another")
        disk.write(self.path / "r/x", "x")
        with self.assertRaisesRegex(InputError, f"r has the results of {one}, and not"):
            disk.claim(self.path / "r", two, "choose another")
        shutil.move(self.path / "r", self.path / "s")
        disk.claim(self.path / "s", one, "choose another")

    def test_formulas(self) -> None:
        """No text of a table is a formula of a spreadsheet, and numbers stay."""
        cells = ["=1+1", "+A1", "-A1", "@x", " =1", "-1.5e3", "+2", "-", "a=1", "=", 3]
        write_csv(self.path / "t.csv", ["x"] * len(cells), [cells])
        with (self.path / "t.csv").open(encoding="utf-8") as file:
            found = list(csv.reader(file))[1]
        self.assertEqual(
            found,
            ["'=1+1", "'+A1", "'-A1", "'@x", "' =1"]
            + ["-1.5e3", "+2", "-", "a=1", "=", "3"],
        )


class Commands(Temporary):
    """Every command that writes, once more over what it has written and a user has
    changed: nothing of it is lost."""

    def setUp(self) -> None:
        super().setUp()
        tiny = Path(__file__).with_name("tiny_run")
        self.run_of_tiny = Path(shutil.copytree(tiny, self.path / "run"))
        self.stack = ExitStack()
        self.addCleanup(self.stack.close)
        self.addCleanup(disk.begin, [])

        def savefig(_: object, file: Any, **__: object) -> None:
            file.write(b"a picture")  # to draw it would take a second each

        for name in ("matplotlib.figure.Figure.savefig",):
            self.stack.enter_context(unittest.mock.patch(name, savefig))

    def call(self, *words: object) -> str:
        """Call a command; return what it says, whatever its status."""
        with redirect_stdout(io.StringIO()) as said, redirect_stderr(said):
            main([str(word) for word in words])
        return said.getvalue()

    def files(self) -> dict[Path, bytes]:
        """Return all files there are with their contents."""
        every = filter(Path.is_file, self.path.rglob("*"))
        return {path: path.read_bytes() for path in every if path.name != disk.RECORD}

    def check(self, command: Any) -> None:
        """Call a command twice, the second time over its files with a byte changed."""
        before = self.files()
        said = command()
        new = [path for path in self.files() if path not in before]
        self.assertTrue(new, said)
        for path in new:
            data = path.read_bytes()
            last = bytes([(data or b" ")[-1] ^ 1])
            is_study = path.suffix == ".toml"  # it is read before it is replaced
            path.write_bytes(data + b"#" if is_study else data[:-1] + last)
        changed = {path: path.read_bytes() for path in new}
        said = command()
        lost = set(changed.values()) - set(self.files().values())
        names = [path.name for path, data in changed.items() if data in lost]
        # the verdict goes into run.json, which keeps all that it has
        self.assertEqual([x for x in names if x != "run.json"], [], said)

    def test_results(self) -> None:
        run, state = self.run_of_tiny, made_up()
        patch = unittest.mock.patch(f"{EXPORT}.read_state", return_value=state)
        self.stack.enter_context(patch)
        words: list[tuple[object, ...]] = [("plot", run), ("compare", run)]
        export = ("export", run, "--spacing", 0.9, "--radius", 4, "--depth", 4, "--to")
        words += [(*export, form) for form in FORMS]
        for command in words:
            with self.subTest(command=command[0], form=command[-1]):
                self.check(lambda c=command: self.call(*c))
        points = self.path / "points.csv"
        points.write_text("r_m,z_m\n1,-1\n", encoding="utf-8")
        place = ("--points", points, "--output", points, "--overwrite")
        said = self.call("export", run, "--to", "csv", *place)
        self.assertIn(f"{points} is an input of this command", said)

    def test_log(self) -> None:
        """Also where an output is the input."""
        vessel = test_log.Vessel()
        vessel.path, vessel.own = self.path, self.path / "own"
        vessel.file = self.path / "measured.csv"
        vessel.write_runs()
        vessel.write_log(test_log.BEST, 5.0)
        page = unittest.mock.patch("caisson.report.page.html", return_value="page")
        self.stack.enter_context(page)
        self.check(lambda: self.call("report", vessel.own))
        self.check(lambda: self.call("log", vessel.own, vessel.file))
        self.check(lambda: self.call("log", vessel.own, "--blank"))
        table = vessel.own / "vessel.csv"
        shutil.copyfile(vessel.file, table)
        said = self.call("log", vessel.own, table)
        self.assertIn(f"log: {table} is an input of this command", said)
        self.assertEqual(table.read_bytes(), vessel.file.read_bytes())

    def test_set_up(self) -> None:
        """suggest, cpt and the scenes of park, without the program."""
        cone, scene = self.path / "t.csv", self.path / "own.prm"
        depths = np.arange(0.5, 8, 0.1)
        rows = [f"{z:.1f},{2 + z:.2f},{20 + 10 * z:.1f}" for z in depths]
        cone.write_text("\n".join(["depth_m,qc_MPa,fs_kPa", *rows]), encoding="utf-8")
        out = self.path / "out"
        size = (
            "--diameter",
            "8",
            "--skirt",
            "6",
            "--wall",
            "30mm",
            "--weight",
            "3000kN",
        )
        layer = ("--layer", "0: phi = 33, E = 20 MPa")
        known = {"cost_of": "valid", "entries_of_layers": KNOWN, "by_hand": "a page"}
        for name, value in known.items():
            patch = unittest.mock.patch(f"caisson.suggest.{name}", return_value=value)
            self.stack.enter_context(patch)
        self.check(lambda: self.call("suggest", scene, *size, *layer))
        self.check(lambda: self.call("cpt", cone, "--out", out))
        for words in (("cpt", cone, *size, "--out", out), ("cpt", cone, "--out", out)):
            self.check_kept(out, *words)
        table = self.path / "p.csv"

        def prepare(weight: str) -> str:
            rows = ["name,diameter_m,skirt_m,wall_mm,layers,weight_kN"]
            rows += [f"{name},8,6,30,0: x,{weight}" for name in ("A", "=B")]
            table.write_text("\n".join(rows), encoding="utf-8")
            with redirect_stderr(io.StringIO()) as said:
                park.prepare(table, 10, self.path / "park")
            return said.getvalue()

        def write_all(options: argparse.Namespace) -> tuple[list[str], str]:
            disk.write(options.file, f"set Title = {options.weight}\n")
            return [], ""

        table.touch()
        weights = iter("123")
        with unittest.mock.patch("caisson.suggest.write_all", write_all):
            with redirect_stdout(io.StringIO()):
                self.check(lambda: prepare(next(weights)))
                other = self.path / "b/p.csv"
                other.parent.mkdir()
                shutil.copyfile(table, other)
                with self.assertRaisesRegex(InputError, f"results of {table}, and not"):
                    park.prepare(other, 10, self.path / "park")

    def check_kept(self, directory: Path, *words: object) -> None:
        """Call a command over files of a user."""
        for path in self.files():
            if path.is_relative_to(directory):
                path.write_text("mine", encoding="utf-8")
        before = self.files()
        said = self.call(*words)
        self.assertIn("exists, and differs", said)
        self.assertEqual(self.files(), before)

    def test_names_of_a_park(self) -> None:
        """A position has not the name of an estimate of another one."""
        rows = [park_rows.Position(i, x, {}) for i, x in enumerate(("A", "B", "a_Low"))]
        (said,) = park_rows.wrong_names(Path("p.csv"), rows)
        self.assertRegex(
            said, "p.csv, row 2, .*: it is that of the low estimate of row 0"
        )

    def test_studies(self) -> None:
        """study, and the evaluation of error-bar."""
        study = test_uncertain_runs.Commands()
        study.path = self.path
        (self.path / "a.prm").touch()
        study.write(test_uncertain_runs.PHI + "values = [30, 34]")
        study.study()
        for path in (self.path / "results/s").glob("*.*"):
            path.unlink()
        self.check(lambda: study.study("--evaluate")[1])
        file = self.path / "s2.toml"
        text = (self.path / "s.toml").read_text(encoding="utf-8")
        file.write_text(f'id = "s"\n{text}', encoding="utf-8")
        said = self.call("study", file, "--results", self.path / "results")
        self.assertRegex(said, "s has the results of .*s.toml, and not of .*s2.toml")
        bar = ErrorBar()
        bar.path = self.path
        made = bar.study()

        def evaluate() -> str:
            with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()) as said:
                bar_study.evaluate([made], Options(), 0)
            return said.getvalue()

        self.check(evaluate)


class Damage(Temporary):
    """The last resort at the command line: one line, and status 1."""

    def setUp(self) -> None:
        super().setUp()
        self.file = self.path / "a.csv"
        self.file.write_text("1", encoding="utf-8")

    def said(self, main: Callable[[object], int]) -> str:
        """Return what a command says in which something fails."""
        said = io.StringIO()
        with unittest.mock.patch("caisson.scenes.main", main), redirect_stderr(said):
            status = command_line.run_command(["scenes"], "caisson", "", GROUPS)
        self.assertEqual(status, 1)
        self.assertRegex(said.getvalue(), r"\Ascenes: .*\n\Z")
        self.assertLess(len(said.getvalue()), 600)
        with unittest.mock.patch("caisson.scenes.main", main):
            with unittest.mock.patch.dict(os.environ, {disk.TRACEBACK: "1"}):
                with self.assertRaises((LookupError, ArithmeticError, RuntimeError)):
                    command_line.run_command(["scenes"], "caisson", "", GROUPS)
        return said.getvalue()

    def test_of_a_file(self) -> None:
        """What reading a file leads to names it, and the kind."""
        for error in (KeyError("a\nb"), OverflowError("x" * 999)):

            @disk.reads
            def read(path: Path) -> int:
                raise error

            several: Any = [self.file, self.path]
            for paths in (self.file, several):
                kind = rf" {self.file} is damaged or too large \({type(error).__name__}"
                self.assertRegex(self.said(lambda _: read(paths)), kind)

    def test_of_the_program(self) -> None:
        """Any other error is a fault of the program, whatever it has read before."""

        def fail(_: object) -> int:
            disk.read_text(self.file)
            raise error

        for error in (KeyError("a\nb"), RuntimeError("x" * 999)):
            text = self.said(fail)
            self.assertRegex(
                text, r"fault of the program itself, at test_disk.py:\d+: "
            )
            self.assertIn(f"{type(error).__name__}: ", text)
            self.assertNotIn("damaged", text)


class Pictures(Temporary):
    """Texts of users in pictures."""

    def test_dollars_and_long_lines(self) -> None:
        """A dollar sign begins no formula but in the label of an axis."""
        figure = Figure()
        axes = figure.subplots()
        figure.suptitle(r"$\frac$ " + 3000 * "long ")
        axes.set_title(r"5 $ to $x_$")
        axes.plot([1, 2], label=r"$\a$")
        axes.legend(title="$^$")
        axes.barh([1], [1])
        axes.set_yticks([1], [r"$\sqrt$"])
        axes.set_xlabel("$q_c$")
        figure.set_layout_engine("tight")
        self.assertTrue(disk.save(figure, self.path / "a.png").is_file())
        disk.save_pages([figure], self.path / "a.pdf")
        self.assertTrue(axes.xaxis.label.get_parse_math())


class Streams(Temporary):
    """Standard output that takes no text."""

    def test_full_and_closed(self) -> None:
        """A list that is cut off is a failure."""
        command = f"{ROOT}/scripts/caisson"
        for words in ("scenes >/dev/full", "scenes >&-", "cpt --help >&-"):
            with self.subTest(words):
                done = subprocess.run(
                    f"{command} {words}", shell=True, text=True, capture_output=True
                )
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, r"\A.*No space left on device.*\n\Z")
        words = f"{command} scenes 2>&- <&-"
        text = subprocess.check_output(words, shell=True, text=True)
        self.assertIn("tutorial.prm", text)


if __name__ == "__main__":
    unittest.main()
