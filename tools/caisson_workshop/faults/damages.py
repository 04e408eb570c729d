# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checkpoints that a disk, a copy or a hand has damaged: the program must refuse
them, say that something is lost, or end with the same bits as without the damage."""
import random
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path

from caisson.paths import PROGRAM
from caisson.runner import Status, set_options
from caisson_workshop.faults.campaign import Part, Result
from caisson_workshop.faults.process import Outcome, call
from caisson_workshop.faults.states import CASES, COMPARED, contents, state_of

Random = random.Random
DIGITS = b"0123456789"
# file: how often. Both files of points are there, the older one is not used.
FILES = {
    "checkpoint.info": 40,
    "checkpoint-a.h5": 12,
    "checkpoint-b.h5": 12,
    "history.csv": 16,
    "observations.csv": 10,
    "points.pvd": 5,
    "grid.pvd": 5,
    "body.pvd": 5,
}
STRUCTURE = 2500  # bytes of an HDF5 file that are not rows of points
OBSERVED = {"Verification/Observations": "u = max displacement_z; s = min stress_zz"}


def flip(data: bytes, source: Random, place: int) -> bytes:
    """Flip one bit."""
    return (
        data[:place]
        + bytes([data[place] ^ 1 << source.randrange(8)])
        + data[place + 1 :]
    )


def change_digit(data: bytes, source: Random, place: int) -> bytes:
    """Change the next digit."""
    while place < len(data) and data[place] not in DIGITS:
        place += 1
    return data[:place] + bytes([source.choice(DIGITS)]) + data[place + 1 :]


def cut(data: bytes, _: Random, place: int) -> bytes:
    """Lose the end."""
    return data[:place]


def lose(data: bytes, source: Random, place: int) -> bytes:
    """Lose a piece in the middle."""
    return data[:place] + data[place + source.choice((1, 1, 16, 512)) :]


def zero(data: bytes, source: Random, place: int) -> bytes:
    """Have zeros in place of a piece, as after a crash of the machine."""
    n = min(source.choice((1, 64, 512)), len(data) - place)
    return data[:place] + bytes(n) + data[place + n :]


def insert(data: bytes, source: Random, place: int) -> bytes:
    """Have a strange piece in the middle."""
    return data[:place] + source.randbytes(source.choice((1, 8, 100))) + data[place:]


def double_line(data: bytes, _: Random, place: int) -> bytes:
    """Have a line twice."""
    begin = data.rfind(b"\n", 0, place) + 1
    end = data.find(b"\n", place) + 1 or len(data)
    return data[:end] + data[begin:end] + data[end:]


def lose_line(data: bytes, _: Random, place: int) -> bytes:
    """Lose a line."""
    begin = data.rfind(b"\n", 0, place) + 1
    end = data.find(b"\n", place) + 1 or len(data)
    return data[:begin] + data[end:]


Damage = Callable[[bytes, Random, int], bytes]
ANY: Sequence[Damage] = (flip, flip, flip, cut, lose, zero, insert)
OF_TEXT: Sequence[Damage] = (*ANY, change_digit, change_digit, double_line, lose_line)


def damage(file: Path, source: Random) -> str:
    """Damage a file; return how."""
    data = file.read_bytes()
    kind = source.random()
    if kind < 0.04:
        file.unlink()
        return "removed"
    if kind < 0.08:
        file.write_bytes(b"")
        return "emptied"
    is_text = file.suffix != ".h5"
    end = len(data) if is_text or source.random() < 0.5 else STRUCTURE
    place = source.randrange(min(end, len(data)))
    how = source.choice(OF_TEXT if is_text else ANY)
    file.write_bytes(how(data, source, place))
    return f"{how.__name__} at {place} of {len(data)}"


class Damages(Part):
    """Restarts after one file has been damaged."""

    name = "damages"

    def prepare(self) -> None:
        """Make finished runs with two checkpoints, and what they become if they go on
        to a later end."""
        self.cases = [case for case in CASES if case.name in ("jacking", "coupled")]
        for case in self.cases:
            for name, ends in (
                ("finished", (0.52, 0.54)),
                ("whole", (0.52, 0.54, 0.56)),
            ):
                path = self.directory / f"{name}_{case.name}"
                shutil.rmtree(path, ignore_errors=True)
                for end in ends:
                    outcome = self.run(case.name, path, end)
                    assert outcome.status == Status.SUCCESS, outcome.words

    def run(self, name: str, path: Path, end: float) -> Outcome:
        """Run a case to a penetration (m), after a checkpoint if there is one."""
        case = next(case for case in self.cases if case.name == name)
        entries = {
            **case.entries,
            **OBSERVED,
            "Time/End penetration": end,
            "Output/Record interval": 0.05,
            "Output/Checkpoint interval": "never",
        }
        words = [PROGRAM, case.scene, "--output-directory", path]
        words += set_options(entries) + ["--restart"] * path.exists()
        return call(words, self.directory)

    def attempt(self, number: int, directory: Path) -> Result:
        """Damage a copy of a finished run, and continue it."""
        source = self.random(number)
        name = source.choice(self.cases).name
        path = directory / "results"
        shutil.copytree(self.directory / f"finished_{name}", path)
        before = {file: contents(path, file) for file in FILES}
        file = source.choices(list(FILES), list(FILES.values()))[0]
        how = damage(path / file, source)
        (directory / "damage.txt").write_text(f"{name}: {file}: {how}\n")
        if contents(path, file) == before[file]:
            return Result("of no effect on the file")
        outcome = self.run(name, path, 0.56)
        complaint = outcome.complaint()
        kind = "refused"
        if outcome.status == Status.SUCCESS and not complaint:
            kind, complaint = self.judge(name, path, outcome.words)
        if complaint:
            complaint = f"{name}: {file}: {how}: {complaint}"
        return Result(kind, complaint, (outcome,))

    def judge(self, name: str, path: Path, words: str) -> tuple[str, str]:
        """Return what kind of a result it is, and what is wrong with it."""
        whole = self.directory / f"whole_{name}"
        if state_of(path) != state_of(whole):
            return "", "the state at the end differs"
        changed = [f for f in COMPARED if contents(path, f) != contents(whole, f)]
        warnings = [line for line in words.splitlines() if "warning" in line]
        silent = [f for f in changed if not any(f in line for line in warnings)]
        if silent:
            return "", f"differs silently in {', '.join(silent)}"
        return "reported" if changed else "the same", ""
