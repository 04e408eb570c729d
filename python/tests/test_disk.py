# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of users: read as text, and written whole or not at all."""
import errno
import io
import os
import subprocess
import tomllib
import unittest
import unittest.mock
from collections.abc import Callable
from contextlib import redirect_stderr
from pathlib import Path
from typing import Any

from made_up_state import Temporary
from matplotlib.figure import Figure

from caisson import command_line
from caisson.__main__ import GROUPS
from caisson import disk
from caisson.disk import InputError
from caisson.paths import ROOT
from caisson.terminal import CLEAR, PlainText

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
        with unittest.mock.patch.object(disk, "MOST", 1000):
            with self.assertRaisesRegex(InputError, "/dev/zero is larger than"):
                disk.read_text(Path("/dev/zero"))
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
        return sorted(os.listdir(self.path))

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
        """Another file goes to the next earlier_N, the same one stays."""
        (self.path / "earlier_7").mkdir()
        for text in ("x", "x", "y"):
            disk.keep(self.old, text)
        self.assertEqual(self.names(), ["earlier_7", "earlier_8", "earlier_9", "old"])
        self.assertEqual((self.path / "earlier_8/old").read_text("utf-8"), "mine")
        self.assertEqual((self.path / "earlier_9/old").read_text("utf-8"), "x")


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
