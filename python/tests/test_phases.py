# SPDX-License-Identifier: LGPL-2.1-or-later
"""Words of Installation/Phases, the entries of their runs, and their rows on a page."""
import contextlib
import fcntl
import html
import io
import json
import tempfile
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
from synthetic import write_run
from test_report import SCENE, SUMMARY, WithPage, leave_run

import caisson.report as report
from caisson import disk, phases
from caisson.commands.run_several import Chain, phases_asked_for, say_end
from caisson.report import verdict
from caisson.report.phases import rows_of
from caisson.results import Results
from caisson.runner import Run, RunError
from caisson.runs import StudyRun, survey
from caisson.verdict import outcome

FAKE_PROGRAM = Path(__file__).resolve().parent / "fake_program.py"

COUPLED = {
    "Water/Level": "coupled",
    "Time/End penetration": "2",
    "Rigid body/Outer diameter": "6",
    "Rigid body/Velocity": "0.1",
}
CLAY = {"Soil/Layer 1/Law": "Mohr-Coulomb", "Soil/Layer 1/Friction angle": "0"}


class Words(unittest.TestCase):
    """What a user writes."""

    def test_list(self) -> None:
        """Each word is known, and blanks do not matter."""
        text = "rest  30 d, pull undrained, retrieval to 0.5 m, push to .9"
        with self.assertRaisesRegex(RunError, "'push to .9' is no phase; known are"):
            phases.phases_in(text)
        found = phases.phases_in(text.replace(" .9", " 0.9"))
        self.assertEqual(
            [(x.word, x.depth, x.time) for x in found],
            [
                ("rest", None, 30 * 86400),
                ("pull undrained", None, 0),
                ("retrieval", 0.5, 0),
                ("push", 0.9, 0),
            ],
        )
        self.assertEqual(phases.folder_of(found[1], 3), "phase_3_pull_undrained")
        self.assertEqual(phases.phases_in(""), [])

    def test_bad_words(self) -> None:
        """One line lists the known ones."""
        huge = "9" * 400
        bad = ["pull", "rest", "rest 30", "rest 3 d to 1 m", "push to", "grout"]
        for text in (*bad, f"rest {huge} d", f"push to {huge} m"):
            with self.assertRaises(RunError) as caught:
                phases.phases_in(f"retrieval, {text}")
            said = str(caught.exception)
            self.assertIn(f"{text!r} is no phase; known are rest TIME", said)
            self.assertNotIn("\n", said)

    def refusal(self, text: str, **entries: str) -> str:
        """Return why a scene cannot have phases."""
        every = COUPLED | {k.replace("_", "/"): v for k, v in entries.items()}
        with self.assertRaises(RunError) as caught:
            phases_asked_for([], every | {phases.ENTRY: text})
        return str(caught.exception)

    def test_what_a_scene_cannot_have(self) -> None:
        """Each is refused before a run, with what to do instead."""
        said = self.refusal("rest 30 d", Water_Level="seepage")
        self.assertIn("leave it out and give Design/Factor on set-up", said)
        said = self.refusal("rest 30 d", Water_Level="undrained")
        self.assertIn("does not flow", said)
        said = self.refusal("rest 0 d")
        self.assertIn("give a time above 0", said)
        said = self.refusal("pull undrained", Water_Level="drained")
        self.assertIn("set Level = coupled", said)
        said = self.refusal("retrieval, push to 1.5")
        self.assertIn("push to 1.5: give a depth below 1.82 m", said)
        self.assertIn("above 2 m", self.refusal("retrieval to 2 m"))
        with self.assertRaisesRegex(RunError, "strength of layer 1 is undrained"):
            phases.refuse_faults(phases.phases_in("pull drained"), COUPLED | CLAY)
        said = self.refusal("retrieval to 0.1 m, pull undrained")
        self.assertIn("undrained: give a depth above 0.1 m, where the phase", said)
        self.assertIn("3 % of the diameter ends at the mudline", said)
        said = self.refusal("push", **{"Rigid body_Velocity": "0"})
        self.assertIn("a share of Rigid body/Velocity, which is 0; set it", said)
        self.assertEqual(phases_asked_for(["--validate"], {phases.ENTRY: "push"}), [])

    def test_what_the_program_would_refuse(self) -> None:
        """Or compute to a wrong end: it is known before the installation is computed,
        also where that has no planned depth."""
        said = self.refusal("pull drained", Water_Level="undrained")
        self.assertIn("would become effective stress; set Level = coupled", said)
        for end in ("2", "never"):
            for word in ("retrieval", "pull drained", "push"):
                planned = {"Time_End penetration": end}
                said = self.refusal(f"{word} to 0 m", **planned)
                self.assertIn("give a depth above 0, such as to 0.1 m", said)
        said = self.refusal("retrieval", Water_Level="drained")
        self.assertIn("flows through layer 1, and Water/Level is drained; set", said)
        clay = {"Soil_Layer 1_Law": "Mohr-Coulomb", "Soil_Layer 1_Friction angle": "0"}
        two = {**clay, "Soil_Number of layers": "2", "Water_Level": "drained"}
        self.assertIn("flows through layer 2", self.refusal("retrieval", **two))
        formula = {**clay, "Soil_Layer 1_Friction angle": "30 + d"}
        said = self.refusal("retrieval", Water_Level="drained", **formula)
        self.assertIn("flows through layer 1", said)
        for none in ("0", "0.0"):
            known = COUPLED | CLAY | {"Soil/Layer 1/Friction angle": none}
            part = phases.phases_in("retrieval")
            phases.refuse_faults(part, known | {"Water/Level": "drained"})


class Page(WithPage):
    """The rows on the page of a scene, and the runs that follow it."""

    def test_entries(self) -> None:
        """A rise of 0.18 m of 6 m at a fifth of the velocity, from the last row; the
        water of a rest flows for 30 d in 5 s."""
        leave_run(self.path, SUMMARY)
        leave_run(self.path / "phase_2_rest", SUMMARY)
        part = phases.phases_in("rest 30 d, retrieval")
        known = COUPLED | {"Rigid body/Velocity table": "0:0.1"}
        found = phases.entries_of(part, self.path / "phase_2_rest", known, "mine")
        self.assertEqual(found["Title"], "mine: rest 30 d; retrieval")
        self.assertEqual(found["Time/End penetration"], 4.32)
        self.assertEqual(found["Rigid body/Velocity"], "-0.02")
        self.assertEqual(found["Rigid body/Velocity table"], "")
        self.assertEqual(found["Water/Suction control"], "required")
        self.assertNotIn("Time/Inertia tolerance", found)
        known["Time/Mass scaling"] = "1000"
        found = phases.entries_of(part[:1], self.path, known, "mine")
        self.assertEqual(found["Water/Time compression"], "518400")
        self.assertNotIn("Time/Mass scaling", found)
        self.assertEqual(found["Time/End time"], 5.0)

    def test_inertia(self) -> None:
        """After an installation with a tolerance of it, the mass is not scaled in a
        rest, and as much as in the installation in a slow pull, at most by 100."""
        leave_run(self.path, {**SUMMARY, "mass_scaling": [2.0, 500.0]})
        leave_run(self.path / "phase_2_rest", {**SUMMARY, "mass_scaling": [1.0, 1.0]})
        part = phases.phases_in("rest 30 d, pull undrained")
        known = COUPLED | {"Time/Inertia tolerance": "0.8", "Time/Mass scaling": "1"}
        rest = phases.entries_of(part[:1], self.path, known, "mine")
        self.assertEqual(rest["Time/Inertia tolerance"], "none")
        self.assertEqual(rest["Time/End time"], 2.0)
        self.assertEqual(rest["Water/Time compression"], "1.296e+06")
        pull = phases.entries_of(part, self.path / "phase_2_rest", known, "mine")
        self.assertEqual(pull["Time/Inertia tolerance"], "0.0004")
        self.assertFalse({"Time/Mass scaling"} & {*rest, *pull})

    def test_ended_before_its_depth(self) -> None:
        """A depth that the run before has not come to is no end of a retrieval."""
        leave_run(self.path, SUMMARY)
        with self.assertRaisesRegex(RunError, "give a depth above 4.5 m"):
            part = phases.phases_in("retrieval to 5 m")
            phases.entries_of(part, self.path, COUPLED, "mine")

    def leave_phase(self, name: str, title: str, **scene: Any) -> None:
        """Leave a phase that has ended, with its page."""
        path = self.path / name
        leave_run(path, {**SUMMARY, "title": title, "scene": {**SCENE, **scene}})
        report.write(path)

    def test_rows(self) -> None:
        """One that has ended, with its page, and those of other phases that do not
        count; the last list counts."""
        entries = {phases.ENTRY: "push, retrieval"}
        leave_run(self.path, {**SUMMARY, "entries": entries})
        title = str(SUMMARY["title"])
        reason = "the plug fills the caisson (refusal)"
        self.leave_phase("phase_2_push", f"{title}: push", end_reason=reason)
        self.leave_phase("phase_3_retrieval", f"{title}: rest 3 d; retrieval")
        push, retrieval = rows_of(Results(self.path))
        self.assertEqual(push.folder, "phase_2_push")
        self.assertRegex(
            push.said, "^Feasible to .*Ended early: the plug fills .*l\\).$"
        )
        self.assertEqual(retrieval.said, "not run yet: caisson run computes it")
        page = html.unescape(report.write(self.path).read_text(encoding="utf-8"))
        self.assertTrue('<a href="phase_2_push/report.html">push</a>' in page)
        self.assertTrue("not run yet" in page)

    def test_retrieval_that_no_force_pulls(self) -> None:
        """Water pushes the body up, whose soil bears a load all the way: it has its
        verdict, too."""
        depth = np.linspace(2, 1.5, 101)
        table = {"time_s": 2 - depth, "penetration_m": depth}
        names = "total_force tip_force inner_friction outer_friction".split()
        table |= {f"{name}_N": 1e5 * depth for name in names}
        for name in ("suction_Pa", "required_suction_Pa"):
            table[name] = -3e4 * depth
        write_run(self.path, table, SUMMARY)
        said = verdict.keep(Results(self.path))
        self.assertIn("retrieval takes an overpressure of up to 59.8 kPa", said)
        known = json.loads((self.path / verdict.NAME).read_text(encoding="utf-8"))
        self.assertFalse({"limits", "uncertainty"} & known.keys())

    def test_after_suction_that_ends(self) -> None:
        """A phase begins where the run before it ended, however far suction comes: its
        verdict says so, and that of the next one. No run follows a later one."""
        pump = {"Water/Largest suction": "20000"}
        every = {**SUMMARY, "status": "stopped", "written": "2026-01-01"}
        leave_run(self.path, {**every, "entries": pump})
        end, reason = outcome.end_of(Results(self.path)) or (0.0, "")
        self.assertLess(end, 4.5)
        before = self.path
        for day, is_after in ((2, True), (3, True), (1, False)):
            entries = {"Installation/Directory": str(before)}
            before = self.path / f"day_{day}"
            told = {"entries": entries, "written": f"2026-01-0{day}"}
            leave_run(before, {**every, **told})
            said = verdict.verdict_of(Results(before)).text
            begin = f"The installation before this run is feasible to {end:.3g} m only"
            self.assertEqual(said.startswith(f"{begin} ({reason})."), is_after, said)

    def test_older_than_its_scene(self) -> None:
        """A phase does not count whose scene was computed again after it."""
        scene: dict[str, Any] = {**SUMMARY, "status": "stopped"}
        scene["entries"] = {phases.ENTRY: "push"}
        push = {**scene, "title": f"{SUMMARY['title']}: push", "written": "2026-01-02"}
        leave_run(self.path / "phase_2_push", push)
        for written, folder in (("2026-01-01", "phase_2_push"), ("2026-01-03", "")):
            leave_run(self.path, {**scene, "written": written})
            self.assertEqual(rows_of(Results(self.path))[0].folder, folder)

    def test_behind_one_that_does_not_count(self) -> None:
        """Nor does a phase count after one that is of an earlier scene."""
        title, entries = SUMMARY["title"], {phases.ENTRY: "push, retrieval"}
        scene = {**SUMMARY, "entries": entries, "status": "stopped"}
        folders = ["phase_2_push", "phase_3_retrieval"]
        for day, name, text in zip((2, 3), folders, ("push", "push; retrieval")):
            told = {"title": f"{title}: {text}", "written": f"2026-01-0{day}"}
            leave_run(self.path / name, {**scene, **told})
        for day, known in ((1, folders), (4, ["", ""])):
            leave_run(self.path, {**scene, "written": f"2026-01-0{day}"})
            rows = rows_of(Results(self.path))
            self.assertEqual([row.folder for row in rows], known)
            words = "not finished yet" if known[0] else "not run yet"
            self.assertTrue(all(row.said.startswith(words) for row in rows))


class Taken(unittest.TestCase):
    """A folder in which another run computes."""

    def test_nothing_is_run_or_drawn(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            entries = {"Output/Directory": name, phases.ENTRY: "rest 1 d"}
            chain = Chain(["a.prm"], entries, None, None)
            with (Path(name) / ".lock").open("w", encoding="utf-8") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX)
                with self.assertRaisesRegex(RunError, "another run computes in"):
                    chain.main(mock.Mock(), mock.Mock())


class RunsOfUser(unittest.TestCase):
    """What `caisson run` does with earlier results, beside a study."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)
        (self.path / "a.prm").touch()

    def member(self, angle: int, is_of_user: bool = True) -> StudyRun:
        """Return a run of an angle, always in the same folder."""
        entries = {"Soil/Friction angle": angle}
        scene, place = self.path / "a.prm", self.path / "out"
        run = Run(scene, entries, place, program=FAKE_PROGRAM)
        run.is_of_user = is_of_user
        return StudyRun("run:", "a", run)

    def test_finished_ones_are_kept(self) -> None:
        """The program puts them aside, but of a study and of one that failed."""
        picture = self.path / "out/forces.png"  # gone with --overwrite
        for before, is_of_user, overwrites in (
            (30, True, False),
            (30, True, True),
            (30, False, False),
            (41, True, False),
        ):
            self.member(before).execute(again=True)
            picture.touch()
            member = self.member(31, is_of_user)
            member.run.overwrites = overwrites
            member.execute()
            is_kept = before == 30 and is_of_user and not overwrites
            self.assertEqual(picture.is_file(), is_kept)

    def test_failed_ones_are_repeated(self) -> None:
        """As after a full disk; a study does not do so."""
        self.member(41).execute()
        self.assertEqual(survey([self.member(41, False)]), [])
        self.assertEqual(len(survey([self.member(41)])), 1)

    def test_restart(self) -> None:
        """One that is asked for does not look what the checkpoint is of. What the
        program then refuses is no result, and is said in full, in one line."""
        self.member(30).execute()
        (self.path / "out/checkpoint.info").touch()
        member = self.member(-1)
        member.run.restarts = True
        member.execute()
        self.assertIsNone(member.status)
        self.assertRegex(
            str(member.trouble),
            "exit status 1, see .*: Friction angle must be positive Set it",
        )

    def test_said_at_the_end(self) -> None:
        """What a phase needs that has not succeeded, and no circle."""
        member = self.member(30)
        member.run.entries[Run.BEFORE] = self.path / "before"
        for trouble, has_checkpoint, said in (
            ("ended early, see log", True, "the same command goes on"),
            ("exit status 1, see log: bad", True, ""),
            ("exit status 1, see log: bad", False, "--overwrite computes the scene"),
        ):
            if has_checkpoint:
                disk.make_directory(self.path / "before")
                (self.path / "before/checkpoint.info").touch()
            else:
                (self.path / "before/checkpoint.info").unlink()
            member.trouble = trouble
            with contextlib.redirect_stderr(io.StringIO()) as told:
                say_end(member)
            end = told.getvalue().strip().partition(trouble)[2]
            self.assertTrue(end.startswith(f"; {said}") if said else not end, end)


if __name__ == "__main__":
    unittest.main()
