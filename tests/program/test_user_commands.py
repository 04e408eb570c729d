#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""caisson run chooses the ranks, and caisson suggest writes what is accepted."""
import re
import signal
import subprocess
import sys
import unittest
from pathlib import Path
from unittest import mock

from program import HERE, SUCCESS, ProgramTest, caisson, history, scene, summary
from program import user_scene
from test_run_command import WITHOUT_PICTURES

from caisson import run_error_bar, ranks
from caisson.paths import PROGRAM
from caisson.results import Results
from caisson.runner import query, environment, size_in

SCALING = "Time/Mass scaling"
NO_FRAMES = {"Output/Frame interval": "never", "Output/Frame penetrations": ""}


class CommandTest(ProgramTest):
    """Calls the command line as a user does."""

    def words(self, *words: str) -> list[str]:
        """Return the words of a call."""
        return [sys.executable, "-B", "-m", "caisson", *words]

    def environment(self) -> dict[str, str]:
        """Return that of a call."""
        return {
            **environment(),
            "CAISSON_MPM_PROGRAM": str(self.program),
            "PYTHONPATH": str(HERE.parent / "python"),
        }

    def caisson(self, *words: str, status: int = 0) -> tuple[str, str]:
        """Run a command; return what it says, and what it complains of."""
        done = caisson(*words)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout, done.stderr


class Launch(CommandTest):
    """caisson run."""

    def run_to(self, depth: float, path: Path) -> list[str]:
        """Return the words that run prm/jack_coarse.prm to a depth."""
        entries = {**NO_FRAMES, "Time/End penetration": str(depth)}
        sets = [w for k, v in entries.items() for w in ("--set", f"{k}={v}")]
        return [
            "run",
            user_scene("jack_coarse"),
            "--output-directory",
            str(path),
            *sets,
        ]

    @mock.patch("caisson.commands.run.draw")  # which test_run_command.py looks at
    def test_ranks(self, _: mock.Mock) -> None:
        """Those that the points and this machine are good for, said in one line, also
        for a restart; the result is that of one rank. What only prints says nothing."""
        path, one = self.directory(), self.directory("one_rank")
        points = size_in(query([user_scene("jack_coarse"), "--validate"])).points
        expected = ranks.choose(points)[0]
        text = rf"^run: {expected} ranks? \("
        self.assertRegex(self.caisson(*self.run_to(0.502, path))[1], text)
        self.assertEqual(summary(path)["ranks"], expected)
        again = [*self.run_to(0.505, path), "--restart"]
        self.assertRegex(self.caisson(*again)[1], text)
        for depth, option in ((0.502, "--overwrite"), (0.505, "--restart")):
            options = [*self.run_to(depth, one)[1:], option]
            self.assertNotIn("run:", self.caisson("run", "--ranks", "1", *options)[1])
        a, b = history(path)[-1], history(one)[-1]
        self.assertAlmostEqual(a["tip_force_N"] / b["tip_force_N"], 1, delta=1e-9)
        for option in ("--validate", "--print-parameters"):
            said, complaints = self.caisson(*again, option)
            self.assertNotIn("run:", said + complaints)

    def test_ctrl_c_on_two_ranks(self) -> None:
        """The run stops in order: with a checkpoint, and the status that says so."""
        path = self.directory()
        sets = [w for k, v in NO_FRAMES.items() for w in ("--set", f"{k}={v}")]
        sets += ["--set", "Time/End penetration=3", "--output-directory", str(path)]
        words = [sys.executable, "-B", "-c", WITHOUT_PICTURES]
        words += ["run", "--ranks", "2", scene("jack"), *sets]
        process = subprocess.Popen(
            words,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env=self.environment(),
        )
        assert process.stdout is not None
        for line in process.stdout:
            if line.startswith("pen"):
                break
        process.send_signal(signal.SIGINT)
        rest = process.stdout.read()
        process.stdout.close()
        self.assertEqual(process.wait(), 3, rest)
        self.assertEqual(summary(path)["status"], "stopped")
        self.assertTrue((path / "checkpoint.info").is_file())


class ErrorBar(CommandTest):
    """caisson error-bar, from the scene to the picture's band."""

    SCENE = f"""
include {HERE / "simulation/jack.prm"}
subsection Rigid body
  set Cells across the wall = 4
end
subsection Time
  set Mass scaling    = 400
  set End penetration = 1.05
end
subsection Output
  set Record interval = 0.1
end
"""

    @mock.patch("caisson.report.write")  # which test_run_command.py looks at
    @mock.patch("caisson.plot.draw", return_value=[])
    def test_own_scene(self, *nothing: mock.Mock) -> None:
        """Two meshes and the runs with other numerics on the coarse one; a run
        then finds its bar. A budget for one mesh is refused with the one to set. A
        wanted error takes the same runs."""
        path = self.made_directory()
        file, runs = path / "own.prm", path / "new" / "results_meshes"
        file.write_text(self.SCENE, encoding="utf-8")
        call = ["error-bar", str(file), "--results", str(runs)]
        listed, _ = self.caisson(*call, "--list")
        self.assertRegex(listed, r"(?m)^refinement 0.5: about .*\ndefault: about ")
        self.assertFalse(runs.exists())
        said, _ = self.caisson(*call)
        for run in ("inertia", "time step", "points", "boundaries"):
            self.assertRegex(said, rf"(?m)^own {run}: \d+ s$")
        self.assertIn("The next finer mesh, 1.5 times as fine", said)
        again, _ = self.caisson(*call)
        self.assertIn("runs to do: 0", again)
        results = path / "results"
        self.run_program(SUCCESS, str(file), "--output-directory", results)
        run_error_bar.adopt(results)
        bounds = Results(results).error_bounds
        self.assertGreater(len(bounds["total_force_low_N"]), 5)
        self.assertTrue((bounds["total_force_low_N"] < bounds["total_force_N"]).all())
        self.assertTrue((bounds["total_force_high_N"] > bounds["total_force_N"]).all())
        self.assertIn("total_force_limit_N", bounds)
        with (path / "own_error_bar.csv").open("a", encoding="utf-8") as bar:
            bar.write("# checked\n")
        self.assertIn("exists, and differs", self.caisson(*call, status=1)[1])
        self.assertIn(
            "exists. Choose", self.caisson(*call, "--results", str(path), status=1)[1]
        )
        file.write_text(self.SCENE.replace("wall = 4", "wall = 2"), encoding="utf-8")
        complaint = self.caisson(*call, status=1)[1]
        self.assertRegex(
            complaint, "not enough for a second mesh. Set --budget [0-9.]+(s|min|h),"
        )
        file.write_text(self.SCENE, encoding="utf-8")
        (path / "own_error_bar.csv").unlink()
        self.look_at_wanted_error(file, path / "new" / "results")

    def look_at_wanted_error(self, file: Path, results: Path) -> None:
        """The coarsest mesh that is good enough runs with its bar; an error that comes
        from the mass scaling is not looked for on finer meshes."""
        to = ["--output-directory", str(results)]
        first = ["run", "--ranks", "1", "--error", "45%", str(file), *to]
        said, _ = self.caisson(*first)
        self.assertIn("runs to do: 1, ", said)
        self.assertRegex(said, r"(?m)^refinement 0.5: error of the total force \d")
        self.assertNotIn("refinement 1: error", said)
        self.assertEqual(float(Results(results).entry("Grid/Refinement")), 0.5)
        self.assertIn("total_force_low_N", Results(results).error_bounds)
        call = ["run", "--error", "20%", str(file), *to]
        self.assertIn("a quarter of Time/Inertia", self.caisson(*call, status=1)[1])
        call[1:1] = ["--budget", "0.1s"]
        self.assertIn("Set --budget ", self.caisson(*call, status=1)[1])
        del call[3:5]
        self.assertIn("belongs to --error", self.caisson(*call, status=1)[1])


class Suggest(CommandTest):
    """Scenes of caisson suggest, without a page, which test_suggest.py looks at."""

    def setUp(self) -> None:
        patch = mock.patch("caisson.suggest.by_hand", return_value="")
        self.enterContext(patch)

    def suggest(
        self, path: Path, layer: str, status: int = 0, error: int = 20
    ) -> tuple[str, str]:
        """Write a scene for a caisson of 10 m."""
        sizes = ["--diameter", "10", "--skirt", "8", "--wall", "40mm"]
        sizes += ["--error", str(error)]
        return self.caisson(
            "suggest", str(path), *sizes, "--layer", layer, status=status
        )

    def test_refused_scene(self) -> None:
        """It leaves no file, so that the next try is not in its way."""
        path = self.made_directory() / "own.prm"
        sand = "0: Friction angle = 33, Youngs modulus = "
        said = self.suggest(path, sand + "45e6*if(d)", status=1)[1]
        self.assertIn("“set Youngs modulus = 45e6*if(d)”", said)
        self.assertNotIn(str(path.parent), said)  # no file is named that is not there
        self.assertEqual(list(path.parent.iterdir()), [])
        self.suggest(path, sand + "45 MPa")
        before = path.read_text(encoding="utf-8")
        self.assertTrue(before)

    def test_clay_alone(self) -> None:
        """Its walls have an adhesion, which is marked as assumed."""
        path = self.made_directory() / "own.prm"
        clay = "0: Friction angle = 0, Cohesion = 40e3, Youngs modulus = 8e6"
        self.suggest(path, clay)
        text = path.read_text(encoding="utf-8")
        self.assertIn("Adhesion factor of the walls = 0.5 # ASSUMED", text)

    def test_inertia_tolerance(self) -> None:
        """It is smaller for a smaller error, and warned of above 2. A large mass
        scaling instead of it is warned of, and a larger one where the stiffness of all
        soil grows with its stress."""
        path = self.made_directory()
        soft, stiff = "0: Dr = 60%", "0: Friction angle = 33, Youngs modulus = 20e6"
        self.assertNotIn("warning", "".join(self.suggest(path / "soft.prm", soft)))
        text = (path / "soft.prm").read_text(encoding="utf-8")
        self.assertRegex(text, r"Inertia tolerance *= 0.8\b")
        self.suggest(path / "fine.prm", soft, error=5)
        fine = (path / "fine.prm").read_text(encoding="utf-8")
        self.assertRegex(fine, r"Inertia tolerance *= 0.4\b")
        large = ["--validate", "--set", "Time/Inertia tolerance=6"]
        said = query([str(path / "soft.prm"), *large], PROGRAM)
        self.assertIn("Inertia tolerance above 2", said)
        self.assertIn("above 400", self.said(path / "soft.prm", 401))
        self.suggest(path / "stiff.prm", stiff)
        self.assertIn("above 100", self.said(path / "stiff.prm", 400))
        # a layer below the end of the run does not count, one above it does
        section = r"(?s)  subsection Layer 1\n(.*?)\n  end\n"
        layer = re.search(section, text)
        other = re.search(section, (path / "stiff.prm").read_text(encoding="utf-8"))
        assert layer is not None and other is not None
        for top, warns in (20, False), (4, True):
            below = path / f"below_{top}.prm"
            second = (
                f"  subsection Layer 2\n    set Top depth = {top}\n{other[1]}\n  end\n"
            )
            more = text.replace(layer[0], layer[0] + second)
            below.write_text(
                re.sub(r"(Number of layers *=) 1", r"\1 2", more), encoding="utf-8"
            )
            self.assertEqual("Mass scaling above" in self.said(below, 400), warns)

    def said(self, path: Path, scaling: int) -> str:
        """Return what the program says of a scene with this mass scaling."""
        return query(
            [
                str(path),
                "--validate",
                *("--set", "Time/Inertia tolerance=none"),
                *("--set", f"{SCALING}={scaling}"),
            ],
            PROGRAM,
        )


if __name__ == "__main__":
    unittest.main()
