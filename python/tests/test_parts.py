# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parts of scripts/test: order, counts and the table at the end."""
import contextlib
import io
import tempfile
import unittest
from collections.abc import Sequence
from pathlib import Path

from caisson_workshop.parts import PARTS, Part, Result, count, run_all, table


def shell(name: str, words: str, needs: str = "", is_beside: bool = False) -> Part:
    """Return a part that is a command of the shell."""
    return Part(name, ["sh", "-c", words], needs, is_beside)


class Parts(unittest.TestCase):
    """Runs of small commands, and words of the real ones."""

    def run_all(self, *parts: Part) -> tuple[dict[str, Result], str]:
        """Run parts; return their results and what is printed."""
        said = io.StringIO()
        with tempfile.TemporaryDirectory() as path:
            with contextlib.redirect_stdout(said):
                results = run_all(parts, Path(path))
        return results, said.getvalue()

    def assert_counts(
        self, name: str, status: int, words: str, expected: Sequence[int]
    ) -> None:
        """Ask for what a part has passed, failed and skipped."""
        (part,) = [part for part in PARTS if part.name == name]
        found = count(part, status, words)
        self.assertEqual([found.passed, found.failed, found.skipped], list(expected))

    def test_it_continues_after_a_failure(self) -> None:
        results, said = self.run_all(
            shell("one", "echo first; exit 3"),
            shell("two", "echo second", needs="one"),
            shell("three", "echo third", needs="two"),
            shell("four", "echo fourth"),
        )
        found = {n: (r.passed, r.failed, r.skipped) for n, r in results.items()}
        self.assertEqual(
            found,
            {"one": (0, 1, 0), "two": (0, 0, 1), "three": (0, 0, 1), "four": (1, 0, 0)},
        )
        self.assertIn("first\n", said)
        self.assertIn("fourth\n", said)
        self.assertNotIn("second\n", said)
        self.assertEqual(
            table(results, 7).splitlines()[-1], "test: 1 passed, 1 failed, 2 skipped"
        )

    def test_two_at_once(self) -> None:
        """Each waits for the other; the words of one follow those of the other."""
        with tempfile.TemporaryDirectory() as path:
            meet = (
                "touch {0}/{1}; while [ ! -e {0}/{2} ]; do sleep 0.01; done; echo {1}"
            )
            results, said = self.run_all(
                shell("a", meet.format(path, "a", "b"), is_beside=True),
                shell("b", meet.format(path, "b", "a")),
                shell("c", f"ls {path}"),
            )
        self.assertEqual([r.passed for r in results.values()], [1, 1, 1])
        self.assertLess(said.index("\nb\n"), said.index("\na\n"))

    def test_counts_of_ctest(self) -> None:
        closing = "\n98% tests passed, 2 tests failed out of 100\n\nTotal Test time"
        self.assert_counts("tests", 8, closing, (98, 2, 0))
        left_out = " 3/9 Test #3: tests/a ...***Skipped   0.01 sec\n"
        closing = "\n100% tests passed, 0 tests failed out of 9\n"
        self.assert_counts("tests", 0, left_out + closing, (8, 0, 1))
        self.assert_counts("tests", 1, "No test configuration file found!", (0, 1, 0))

    def test_counts_of_the_ladder(self) -> None:
        words = "| a row |\n30 rows: 28 pass, 1 fall short as known, 1 fail\n"
        self.assert_counts("verification", 1, words, (29, 1, 0))
        words = "short: NOT KNOWN WHY\nvalidation: 12 rows, 0.3 minutes\n"
        self.assert_counts("validation", 1, words, (11, 1, 0))
        self.assert_counts("validation", 1, "caisson: no program\n", (0, 1, 0))

    def test_counts_of_faults(self) -> None:
        words = (
            "fuzz             60 in 0.2 min: 20 refused, 40 valid; slowest call 1 s\n"
            "fuzzed runs       6 in 0.1 min: 1 wrong, 5 valid; slowest call 1 s\n"
        )
        self.assert_counts("faults", 0, words, (66, 0, 0))
        words += "faults: 1 trials went wrong\n"
        self.assert_counts("faults", 1, words, (65, 1, 0))


if __name__ == "__main__":
    unittest.main()
