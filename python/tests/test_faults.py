# SPDX-License-Identifier: LGPL-2.1-or-later
"""The search for faults sees what it must see, and can repeat what it has done."""
import random
import tempfile
import unittest
from pathlib import Path

from caisson_workshop.faults import damages, mutations
from caisson_workshop.faults.process import Outcome, call
from caisson_workshop.faults.states import difference

SCENE = b"""set Title = a scene
subsection Grid
  set Outer radius = 15
  set Bottom       = -18
end
"""


def outcome(status: int, words: str = "", seconds: float = 1.0) -> Outcome:
    """Return how a call has ended."""
    return Outcome(status, words, seconds, seconds, 0, False)


class Complaints(unittest.TestCase):
    """What is wrong with the end of a call."""

    def test_what_is_right(self) -> None:
        for status, words in (
            (0, "x.prm is valid"),
            (1, "warning: a\nbad input: there is no entry x"),
            (2, "failure: the state is not finite"),
            (2, "error: 2 of 6 checks failed"),
            (3, "stopped: SIGTERM received"),
        ):
            self.assertEqual(outcome(status, words).complaint(), "", words)

    def test_what_is_wrong(self) -> None:
        for status, words, seconds in (
            (-11, "", 1.0),
            (4, "", 1.0),
            (134, "", 1.0),
            (1, "", 1.0),
            (2, "warning: failure: or not", 1.0),
            (2, "failure: std::bad_alloc", 1.0),
            (2, "failure: vector::_M_range_check: __n (which is 3)", 1.0),
            (1, "bad input: \nAn error occurred in line <1> of file", 1.0),
            (0, "Errc: 0\nx.prm is valid", 1.0),
            (0, "x.prm is valid", 21.0),
        ):
            found = outcome(status, words, seconds).complaint()
            self.assertNotEqual(found, "", words)

    def test_calls(self) -> None:
        """Of programs that die, that hang, and that want too much memory."""
        with tempfile.TemporaryDirectory() as name:
            place = Path(name)
            killed = call(["sh", "-c", "kill -SEGV $$"], place)
            self.assertEqual(killed.complaint(), "died of SIGSEGV")
            hangs = call(["sleep", "60"], place, wall_limit=0.2)
            self.assertIn("took", hangs.complaint())
            hit = call(["sleep", "60"], place, kill_after=0.2)
            self.assertEqual(hit.complaint(), "died of SIGKILL")
            greedy = "bytearray(1 << 40)"
            refused = call(["/usr/bin/python3", "-c", greedy], place)
            self.assertIn("MemoryError", refused.words)


class Mutations(unittest.TestCase):
    """Spoilt scenes."""

    def test_each_follows_from_its_seed(self) -> None:
        material = mutations.Material({"a": SCENE}, {"Grid/Top": "1"})
        for kinds in (mutations.ROUGH, mutations.GENTLE):
            once, again = (
                [
                    mutations.mutate(SCENE, random.Random(i), material, kinds)
                    for i in range(200)
                ]
                for _ in range(2)
            )
            self.assertEqual(once, again)
            self.assertGreater(len(set(once)), 100)

    def test_gentle_ones_keep_the_form(self) -> None:
        material = mutations.Material({"a": SCENE}, {"Grid/Top": "1"})
        for i in range(50):
            text = mutations.nudge_number(SCENE, random.Random(i), material)
            self.assertEqual(len(text.splitlines()), len(SCENE.splitlines()))
            self.assertEqual(text.count(b"="), SCENE.count(b"="))

    def test_no_text_is_too_short(self) -> None:
        material = mutations.Material({"a": SCENE}, {"Grid/Top": "1"})
        for mutation in {*mutations.ROUGH, *mutations.GENTLE}:
            for i in range(50):
                mutation(b"", random.Random(i), material)


class Differences(unittest.TestCase):
    """What has changed in a directory."""

    def test_any_byte_is_seen(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            places = [Path(name) / side for side in "ab"]
            for place in places:
                place.mkdir()
                (place / "history.csv").write_text("time_s\n0\n1\n")
                (place / "checkpoint.info").write_text("file a\nstate\ntime 1\n")
            self.assertEqual(difference(*places), "")
            (places[1] / "checkpoint.info").write_text("file b\nstate\ntime 1\n")
            self.assertEqual(difference(*places), "")
            (places[1] / "checkpoint.info").write_text("file b\nstate\ntime 2\n")
            self.assertIn("state", difference(*places))
            (places[0] / "history.csv").unlink()
            self.assertIn("history.csv", difference(*places))

    def test_each_damage_changes_the_file(self) -> None:
        data = bytes(range(48, 58)) * 3 + b"\nx\n"
        for how in {*damages.ANY, *damages.OF_TEXT}:
            changed = [how(data, random.Random(i), 5 + i) != data for i in range(20)]
            self.assertGreater(sum(changed), 10, how.__name__)


if __name__ == "__main__":
    unittest.main()
