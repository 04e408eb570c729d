#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The functions of `import caisson` with the program, and the notebook of the manual,
whose cells are executed in their order. No Jupyter is needed, and none is tested."""
import contextlib
import io
import json
import os
import signal
import subprocess
import sys
import unittest
from pathlib import Path
from typing import Any

from program import HERE, ProgramTest

os.environ["MPLBACKEND"] = "Agg"  # no display is needed

import caisson  # noqa: E402
from caisson.paths import ROOT  # noqa: E402
from caisson.runner import environment  # noqa: E402

NOTEBOOK = ROOT / "doc/notebooks/caisson.ipynb"
SHORT = {"Time/End penetration": 0.6, "Output/Frame penetrations": [0.55, 0.6]}


def cells_of(notebook: Path) -> list[str]:
    """Return the code of a notebook, cell by cell."""
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return ["".join(c["source"]) for c in cells if c["cell_type"] == "code"]


class Notebook(ProgramTest):
    """doc/notebooks."""

    def test_all_cells(self) -> None:
        names: dict[str, Any] = {}
        with contextlib.chdir(self.made_directory()):
            for number, cell in enumerate(cells_of(NOTEBOOK)):
                exec(compile(cell, f"{NOTEBOOK.name}, cell {number}", "exec"), names)
        run, frame = names["run"], names["frame"]
        self.assertEqual(run.status, "finished")
        self.assertAlmostEqual(run.history["penetration_m"].iloc[-1], 1.0, places=2)
        self.assertAlmostEqual(frame.penetration, 1.0, places=2)
        self.assertGreater(len(names["axes"].collections), 0)

    def test_it_is_stored_without_outputs(self) -> None:
        for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]:
            self.assertEqual(cell.get("outputs", []), [])


class Functions(ProgramTest):
    """The commands that are functions of the package."""

    def test_a_scene_and_its_page(self) -> None:
        """From the sizes of a caisson to the page on its run. The log has its own
        test, python/tests/test_log.py."""
        write_scene, write_page = caisson.suggest_scene, caisson.write_report
        sizes: dict[str, Any] = {
            "diameter": 4,
            "skirt": 2.5,
            "wall": "400mm",
            "error": 20,
        }
        with contextlib.chdir(self.made_directory()):
            scene = write_scene("own.prm", sand="dense", penetration=1, **sizes)
            bar = caisson.error_bar(scene, "10h", list=True)
            self.assertEqual(bar.resolve(), Path("own_error_bar.csv").resolve())
            run = caisson.run(scene, {"Time/End time": 0.1}, output_directory="own")
            self.assertEqual(write_page("own", rate=2), Path("own/report.html"))
            self.assertTrue((run.directory / "verdict.json").is_file())
            nothing: Any = None
            rates: list[Any] = [0, float("nan"), "fast"]
            for rate in rates:
                with self.assertRaisesRegex(caisson.InputError, "m/h above 0"):
                    write_page("own", rate=rate)
            with self.assertRaisesRegex(caisson.InputError, "None is no path"):
                write_scene(nothing, **sizes)
            with self.assertRaisesRegex(caisson.InputError, "own.prm is no dir"):
                caisson.cpt(ROOT / "prm/cpt_example.csv", "own.prm")
            with self.assertRaisesRegex(caisson.InputError, "own.prm exists"):
                write_scene("own.prm", sand="dense", **sizes)
            with self.assertRaisesRegex(caisson.InputError, "did you mean --weight"):
                write_scene("two.prm", sand="dense", weigh=1, **sizes)
            layers = caisson.cpt(ROOT / "prm/cpt_example.csv", "ground", tops="0,3")
            self.assertTrue((layers / "layers.csv").is_file())


class Runs(ProgramTest):
    """caisson.run()."""

    scene = HERE / "simulation/jack.prm"

    def run_short(self, path: Path, **options: Any) -> caisson.LoadedRun:
        """Run the scene for 0.1 m."""
        return caisson.run(self.scene, set=SHORT, output_directory=path, **options)

    def test_results(self) -> None:
        """Tables and meshes agree with each other; the lines of the program appear."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            run = self.run_short(self.directory(), ranks=1, echo=True)
        self.assertIn("pen 0.6 m", said.getvalue())
        self.assertEqual((run.status, run.summary["ranks"]), ("finished", 1))
        history = run.history
        self.assertEqual(history.attrs["units"]["tip_force_N"], "N")
        self.assertEqual(history.index.name, "time_s")
        frame = run.frame(penetration=0.55)
        self.assertAlmostEqual(frame.penetration, 0.55, places=3)
        stress = -1e3 * frame.cell_data["vertical_effective_stress_kPa"]
        self.assertEqual(stress.shape, frame.corners.shape[:1])
        self.assertEqual(len(frame.positions), run.summary["material_points"])
        self.assertEqual(frame.point_data["velocity_m_s"].shape[1], 3)
        self.assertLess(stress[frame.cell_data["material_points"] > 0].max(), 1e4)
        self.assertGreater(frame.body.GetNumberOfCells(), 0)

    def test_earlier_results(self) -> None:
        path = self.directory()
        self.run_short(path, ranks=1)
        self.run_short(path, ranks=1)
        self.assertTrue((path / "earlier_1/history.csv").is_file())
        self.run_short(path, ranks=2, overwrite=True)
        self.assertEqual(caisson.load(path).summary["ranks"], 2)

    def test_refusal(self) -> None:
        """The message is the program's own."""
        path = self.directory()
        with self.assertRaisesRegex(caisson.RunError, "(?s)no entry.*Did you mean"):
            caisson.run(self.scene, set={"Time/Mas scaling": 9}, output_directory=path)
        with self.assertRaisesRegex(caisson.RunError, "none.prm"):
            caisson.run("none.prm", output_directory=path)
        self.assertFalse(path.exists())

    def test_interrupt(self) -> None:
        """As of a notebook: the run stops with a checkpoint, on two ranks, too."""
        code = (
            "import sys, caisson; caisson.run(sys.argv[1], {'Time/End penetration': 2,"
            " 'Time/Mass scaling': 1}, output_directory=sys.argv[2],"  # it takes long
            " ranks=2, echo=True)"
        )
        path = self.directory()
        words = ["-c", code, str(self.scene), str(path)]
        with subprocess.Popen(
            [sys.executable, "-B", *words],
            cwd=ROOT / "python",
            env={**environment(), "CAISSON_MPM_PROGRAM": str(self.program)},
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        ) as process:
            assert process.stdout
            while "pen " not in process.stdout.readline():
                self.assertIsNone(process.poll())
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate()
        self.assertIn("KeyboardInterrupt", errors)
        self.assertTrue((path / "checkpoint.info").is_file())
        self.assertLess(caisson.load(path).history["penetration_m"].iloc[-1], 1.9)

    def test_failure(self) -> None:
        """A run that cannot continue is one; what it has written is there."""
        path = self.directory()
        fault = {"Soil/Layer 1/Solid density": 1e307}
        with self.assertRaisesRegex(caisson.RunError, "exit status 2, results: .*"):
            caisson.run(self.scene, {**SHORT, **fault}, output_directory=path)
        self.assertEqual(caisson.load(path).status, "failed")


if __name__ == "__main__":
    unittest.main()
