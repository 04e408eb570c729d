# SPDX-License-Identifier: LGPL-2.1-or-later
"""States of made-up points, exported and read back by a plain solver."""
import contextlib
import errno
import importlib
import io
import json
import math
import os
import shutil
import subprocess
import unittest
import unittest.mock
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
from made_up_state import (
    FORCES,
    K0,
    WEDGE,
    WEIGHT,
    Temporary,
    on_mesh,
    made_up,
)
from plain_solver import Deck, forces_of, read_deck

from caisson import __main__ as program
from caisson.results import Results, ResultsError, read_table
from caisson.export import command, files
from caisson.export.exported import Exported, force_of_run
from caisson.export.interpolate import interpolate
from caisson.export.state import Layer, State, forces_at, layers_of
from caisson.export.text import about, judged

CCX = shutil.which("ccx")
TINY = Path(__file__).with_name("tiny_run")


class States(unittest.TestCase):
    """What is derived from the frames of a run."""

    def test_weight_follows_void_ratio(self) -> None:
        """Grains keep their mass; a void ratio that is not known changes nothing."""
        one = {
            "top_depth_m": 1.0,
            "layer": 2,
            "submerged_unit_weight_N_m3": 1e4,
            "porosity": 0.5,
        }
        scene = {"layers": [{**one, "youngs_modulus_Pa": 1e7}]}
        data = {"material": np.zeros(3), "void_ratio": np.array([1, 0.6, np.nan])}
        _, weight, layers = layers_of(scene, data, np.ones(3), np.ones((3, 4)))
        np.testing.assert_allclose(weight, [1e4, 1.25e4, 1e4])
        self.assertEqual((layers[0].number, layers[0].top), (2, 1.0))
        self.assertEqual((layers[0].youngs_modulus, layers[0].assumed), (1e7, False))
        with self.assertRaisesRegex(ResultsError, "only runs of a caisson"):
            layers_of({}, data, np.ones(3), np.ones((3, 4)))

    def test_a_law_without_a_youngs_modulus(self) -> None:
        """It follows the stress of the layer, and the file says so."""
        one: dict[str, Any] = {"top_depth_m": 0.0}
        one |= {"submerged_unit_weight_N_m3": 1e4, "porosity": 0.5}
        known = [{**one, "layer": 1, "youngs_modulus_Pa": 1e7}, {**one, "layer": 2}]
        data = {"material": np.array([0, 1, 1])}
        stress = np.outer([1e3, 2e3, 5e3], [0, 1, 0, 0])
        volume = np.array([1.0, 2.0, 1.0])
        _, _, layers = layers_of({"layers": known}, data, volume, stress)
        np.testing.assert_allclose([x.youngs_modulus for x in layers], [1e7, 3e6])
        state = made_up()
        self.assertNotIn("no Young's modulus", "\n".join(about(on_mesh(state))))
        state.layers = [layers[1]]
        found = on_mesh(state)
        self.assertIn(
            "Layer 2: its law has no Young's modulus. Input files assume 3e+06 Pa",
            "\n".join(about(found)),
        )
        (layer,) = found.state.layers
        self.assertEqual(layer.youngs_modulus, 3e6)

    def test_forces_of_a_frame(self) -> None:
        """A row is the mean since the row before; the first one is zero."""
        history = {
            "time_s": np.array([0, 1, 2.0]),
            "tip_force_N": np.array([0, 5, 7.0]),
        }
        for time, force in ((1, 5), (1.5, 7), (2, 7), (2.5, 7)):
            self.assertEqual(forces_at(history, time), {"tip_force_N": force})
        self.assertEqual(forces_at(history, 0), {})


class Interpolation(unittest.TestCase):
    """Moving least squares around a wall."""

    def test_at_rest_is_exact(self) -> None:
        """A wished-in-place state is met to 1e-6, and the whole is in balance."""
        state = made_up()
        found = on_mesh(state)
        vertical = WEIGHT * found.mesh.centers[:, 1]
        exact = np.outer(vertical, [K0, 1, K0, 0])
        self.assertLess(abs(found.values.stress - exact).max(), 1e-6 * WEIGHT)
        self.assertAlmostEqual(found.boundary / found.weight, 1, delta=1e-3)

    def test_wall_is_a_barrier(self) -> None:
        """Stress and pressure inside are not mixed with those outside."""
        state = made_up()
        inside = state.position[:, 0] < 1.95
        state.stress = np.where(inside, -1.0, -9.0)[:, np.newaxis] * np.ones(4)
        state.pressure = np.where(inside, 5.0, 0.0)
        places = np.array([[1.89, -0.5], [1.89, -1.8], [2.01, -0.5], [2.01, -1.8]])
        values = interpolate(state, places)
        np.testing.assert_allclose(values.stress[:, 0], [-1, -1, -9, -9])
        np.testing.assert_allclose(values.pressure, [5, 5, 0, 0], atol=1e-12)
        np.testing.assert_allclose(values.scatter, 0, atol=1e-9)

    def test_layers_are_not_mixed(self) -> None:
        """The kink of the stress between two layers stays sharp."""
        state = made_up(wall=None)
        state.layer = (state.position[:, 1] < -2).astype(int)
        state.layers = [Layer(1, WEIGHT, 1e7), Layer(2, 2 * WEIGHT, 1e7)]
        z = state.position[:, 1]
        state.stress[:, 1] = np.where(z < -2, 2 * WEIGHT * (z + 1), WEIGHT * z)
        state.layers[1].top = 2.0
        rest = state.at_rest(np.array([-1.0, -3.0])) / WEIGHT
        np.testing.assert_allclose(rest, [1, 4])
        values = interpolate(state, np.array([[1.0, -1.98], [1.0, -2.03]]))
        np.testing.assert_allclose(
            values.stress[:, 1], WEIGHT * np.array([-1.98, -2.06])
        )
        np.testing.assert_array_equal(values.layer, [0, 1])

    def test_scatter_is_that_of_the_points(self) -> None:
        state = made_up(noise=0.02)
        values = interpolate(state, np.array([[1.0, -3.0], [3.0, -3.0]]))
        expected = 0.02 * 3 * WEIGHT
        self.assertLess(abs(values.scatter[:, 1] / expected - 1).max(), 0.5)


class Balance(Temporary):
    """Decks read back by the plain solver."""

    def deck(self, state: Exported) -> Deck:
        """Return what is read back."""
        files.write_deck(self.path / "a.inp", state, "abaqus")
        return read_deck(self.path / "a.inp")

    def test_forces_of_the_run(self) -> None:
        """They are loads on the walls; the weight, and the whole balance, are right."""
        state = made_up(noise=0.02)
        found = on_mesh(state)
        deck = self.deck(found)
        forces = forces_of(deck)
        self.assertAlmostEqual(forces.whole / found.weight, 1, delta=1e-6)
        for name in ("INNER_WALL", "OUTER_WALL"):
            nodes = set(deck.node_sets[name])
            load = sum(f for (n, c), f in deck.loads.items() if n in nodes and c == 2)
            force = FORCES[f"{name.lower()[:5]}_friction_N"]
            self.assertAlmostEqual(-load / force, 1, delta=1e-6)
            self.assertFalse({(n, 2) for n in nodes} & deck.held)
        self.assertAlmostEqual(found.boundary / found.weight, 1, delta=0.01)
        text = "\n".join(about(found))
        self.assertRegex(text, r"OUTER_WALL: .* run 30, of the interpolated stress ")
        self.assertRegex(text, r"Vertical balance: .* kN, which differs by 0\.\d+ %")

    def test_no_folder_of_a_user(self) -> None:
        """Of a folder that is not in the project, a title has the last name only."""
        run = Results(Path("/home/anna/secret/run_7"))
        known = {"title": "a caisson", "scene_file": "/home/anna/mine.prm"}
        with unittest.mock.patch.object(Results, "known", known):
            self.assertEqual(run.title, "a caisson, mine.prm, results in run_7")

    def test_judged(self) -> None:
        """A stress is warned of that is 10 % off at a wall, or 2 % off the weight."""
        found = on_mesh(made_up(noise=0.02))
        for name in found.wall:
            found.wall[name] = force_of_run(found.state, name) or 0.0
        found.boundary = 1.019 * found.weight
        self.assertTrue(judged(found).startswith("It is a state to begin with"))
        found.boundary = 0.97 * found.weight
        found.wall["TIP"] *= 1.23
        words = "WARNING: .* by 3 % at the weight, 23 % at TIP; limits: 10 %"
        self.assertRegex(judged(found), words)
        self.assertIn(judged(found), about(found))

    def test_friction_of_the_stress(self) -> None:
        """What the walls bear is the integral of the shear stress beside them."""
        state = made_up()
        state.stress[:, 3] = 1e3 * np.sign(state.position[:, 0] - 1.95)
        for name, radius in (("INNER_WALL", 1.9), ("OUTER_WALL", 2.0)):
            force = on_mesh(state).wall[name]
            expected = 2 * math.pi * radius * 1.95 * 1e3
            self.assertAlmostEqual(force / expected, 1, delta=0.1, msg=name)

    def test_forces_that_are_not_there(self) -> None:
        """Without a history the wall is held."""
        state = made_up(noise=0.02)
        state.forces = {}
        found = on_mesh(state)
        self.assertFalse(found.applied.any())
        self.assertTrue(found.held[found.mesh.sets["OUTER_WALL"]].all())
        self.assertIn("run unknown", "\n".join(about(found)))

    def test_seepage(self) -> None:
        """Water that flows up in the ground carries a part of its weight: effective
        stress of the rest, and pressure, are in balance."""
        state = made_up(wall=None)
        rise = 3e3  # Pa/m
        state.pressure = -rise * state.position[:, 1]
        state.stress *= (WEIGHT - rise) / WEIGHT
        found = on_mesh(state)
        self.assertAlmostEqual(found.boundary / found.weight, 1, delta=1e-3)
        deck = self.deck(found)
        self.assertLess(forces_of(deck).residual(deck), 1e-3)

    def test_surcharge_and_lid(self) -> None:
        """They are loads on the surface, the lid's on the plug only."""
        state = made_up()
        state.surcharge = 1e4
        state.stress -= [1e4 * K0, 1e4, 1e4 * K0, 0]
        deck = self.deck(on_mesh(state))
        self.assertLess(forces_of(deck).residual(deck), 2e-3)
        state.surcharge, state.stress[:] = 0, made_up().stress
        state.forces = {"lid_force_N": 1e5}
        self.assertAlmostEqual(on_mesh(state).applied[:, 1].sum() / -1e5, 1, delta=0.1)

    def test_suction_on_clay(self) -> None:
        """It pulls at the surface of a plug of total stress; files name such layers."""
        state = made_up()
        state.suction = 5e4
        sand = on_mesh(state)
        self.assertNotIn("undrained clay", "\n".join(about(sand)))
        state.layers[0].total = True
        clay = on_mesh(state)
        pull = (clay.applied - sand.applied)[:, 1].sum()
        self.assertAlmostEqual(pull / (5e4 * np.pi * WEDGE.inner**2), 1, delta=0.1)
        np.testing.assert_array_equal(clay.values.total, clay.values.stress)
        said = r"(?s)Stresses are total, .*Layer 1: undrained clay by total stress"
        self.assertRegex("\n".join(about(clay)), said)

    @unittest.skipUnless(CCX, "needs ccx of the package calculix-ccx")
    def test_calculix(self) -> None:
        """CalculiX keeps a stress in equilibrium, and balances one with noise by no
        more than the noise."""
        for noise, allowed in ((0.0, 1e-3), (0.02, 0.02)):
            state = made_up(noise=noise)
            state.forces = {}
            with self.subTest(noise):
                self.assertLess(self.change_by_calculix(on_mesh(state)), allowed)

    def change_by_calculix(self, found: Exported) -> float:
        """Return how much CalculiX changes the stress, as a share of it."""
        files.write_deck(self.path / "a.inp", found, "calculix")
        assert CCX is not None
        done = subprocess.run([CCX, "a"], cwd=self.path, text=True, capture_output=True)
        self.assertNotIn("*ERROR", done.stdout)
        lines = (self.path / "a.dat").read_text(encoding="utf-8").split("stresses")[1]
        rows = [line.split() for line in lines.splitlines()[2:] if line.strip()]
        stress = np.array([[float(x) for x in row[2:6]] for row in rows])
        self.assertEqual(len(stress), 8 * len(found.values.total))
        change = stress - np.repeat(found.values.total, 8, axis=0)
        return float(np.linalg.norm(change) / np.linalg.norm(stress))


class Tables(Temporary):
    """Tables and pictures."""

    def test_csv(self) -> None:
        found = on_mesh(made_up(noise=0.02))
        files.write_cells(self.path / "a.csv", found)
        table = read_table(self.path / "a.csv")
        np.testing.assert_allclose(
            table["stress_tt_Pa"], found.values.stress[:, 2], rtol=1e-8
        )
        self.assertIn("void_ratio", table)
        vertical = -table["stress_zz_Pa"]
        ratio = vertical / (-WEIGHT * table["z_m"])
        for name, expected in (
            ("vertical_effective_stress_kPa", vertical / 1e3),
            ("vertical_stress_over_stress_at_rest", ratio),
        ):
            np.testing.assert_allclose(table[name], expected, rtol=1e-6)
        text = (self.path / "a.csv").read_text(encoding="utf-8")
        self.assertIn("# Stresses are effective, in Pa, positive in tension", text)

    def test_vtu(self) -> None:
        from caisson import vtu

        found = on_mesh(made_up())
        files.write_vtu(self.path / "a.vtu", found)
        grid = vtu.read_grid(self.path / "a.vtu")
        cells = vtu.named_arrays(grid.GetCellData())
        np.testing.assert_array_equal(cells["stress_rr_Pa"], found.values.stress[:, 0])
        self.assertEqual(grid.GetNumberOfPoints(), len(found.mesh.nodes))
        text = (self.path / "a.vtu").read_text(encoding="utf-8")
        self.assertIn("\n  Stresses are effective, in Pa", text.split("-->")[0])
        with contextlib.suppress(ModuleNotFoundError):  # python3-meshio is not needed
            mesh = importlib.import_module("meshio").read(self.path / "a.vtu")
            self.assertEqual(len(mesh.points), len(found.mesh.nodes))


class Command(Temporary):
    """scripts/caisson export."""

    def call(self, *words: str | Path) -> tuple[int, str]:
        """Return the exit status and all that is said."""
        with contextlib.redirect_stdout(io.StringIO()) as said:
            with contextlib.redirect_stderr(said):
                status = program.main(["export", *map(str, words)])
        return status, said.getvalue()

    def state_of(self, state: State) -> Any:
        """Let a made-up state be that of any run."""
        return unittest.mock.patch.object(command, "read_state", return_value=state)

    def test_all_forms(self) -> None:
        for form in command.FORMS:
            path = self.path / form
            with self.state_of(made_up(noise=0.02)):
                status, text = self.call(
                    TINY, "--to", form, "--output", path, "--spacing", "0.4"
                )
            self.assertEqual(status, 0, text)
            self.assertIn("Vertical balance", text)
            self.assertIn(str(path), text)
            self.assertTrue(path.stat().st_size, form)

    def test_points(self) -> None:
        points, path = self.path / "points.csv", self.path / "out.csv"
        given = ("--points", points, "--output", path)
        with self.state_of(made_up()):
            for text in ("r_m,z_m\n1,-1\n3,-2.5\n", "r_m;z_m\n1;-1\n3;-2,5\n"):
                points.write_text(text, encoding="utf-8")
                path.unlink(missing_ok=True)
                status, text = self.call(TINY, "--to", "csv", *given)
                self.assertEqual(status, 0, text)
                stress = read_table(path)["stress_zz_Pa"]
                np.testing.assert_allclose(stress, [-WEIGHT, -2.5 * WEIGHT])
            self.assertIn("interpolated between", text)
            self.assertEqual(self.call(TINY, "--to", "abaqus", *given)[0], 1)
            for row, words in (
                ("1.95,-1", "line 4: .* lies in the wall"),
                ("1,3", r"line 4: .* above the ground, whose surface is at z = .* m"),
                ("4,0.2", "line 4: .* above the ground"),
                ("-1,-1", "line 4: the point r = -1 m, z = -1 m lies beyond the axis"),
                ("6,-1", "line 4: .* which ends at r = 5 m"),
                ("1,-6", "line 4: .* which ends at z = -5 m"),
                ("nan,-1", "line 4: 'nan,-1' has no numbers"),
                (",-2", "line 4: ',-2' has no numbers"),
                ("2", "line 4: '2' has no numbers"),
            ):
                text = f"# remark\nr_m,z_m\n1,-1\n{row}\n"
                points.write_text(text, encoding="utf-8")
                with self.subTest(row):
                    status, text = self.call(TINY, "--to", "csv", *given)
                    self.assertEqual(status, 1)
                    self.assertRegex(text, words)
            points.write_text("r_m,z_m\n", encoding="utf-8")
            self.assertIn("no point", self.call(TINY, "--to", "csv", *given)[1])

    def test_frames_of_a_run(self) -> None:
        path = self.path / "a.csv"
        status, text = self.call(TINY, "--to", "csv", "--output", path)
        self.assertEqual(status, 0, text)
        self.assertTrue(np.isfinite(read_table(path)["stress_zz_Pa"]).all())

    def test_vertical_stress_of_a_run(self) -> None:
        """It is that of the exported stress, not one that is interpolated."""
        path = self.path / "a.csv"
        self.assertEqual(self.call(TINY, "--to", "csv", "--output", path)[0], 0)
        table = read_table(path)
        stress = -table["stress_zz_Pa"] / 1e3
        np.testing.assert_allclose(
            table["vertical_effective_stress_kPa"], stress, rtol=1e-6
        )

    def test_a_broken_frame(self) -> None:
        for name in ("points_0002.vtu", "grid_0002.vtu"):
            run = self.path / name
            shutil.copytree(TINY, run)
            content = (run / name).read_bytes()
            (run / name).write_bytes(content[: len(content) // 2])
            status, text = self.call(run, "--to", "csv")
            self.assertEqual(status, 1)
            self.assertRegex(text, f"the frame is broken: .*{name} is not complete")

    def run_with(self, scene: dict[str, Any]) -> Path:
        """Return a copy of the run whose run.json has this scene."""
        run = self.path / "run"
        shutil.copytree(TINY, run)
        summary = json.loads((run / "run.json").read_text(encoding="utf-8"))
        summary["scene"] = scene
        (run / "run.json").write_text(json.dumps(summary), encoding="utf-8")
        return run

    def test_a_run_without_a_youngs_modulus(self) -> None:
        scene = json.loads((TINY / "run.json").read_text(encoding="utf-8"))["scene"]
        for layer in scene["layers"]:
            del layer["youngs_modulus_Pa"]
        run = self.run_with(scene)
        for form in ("csv", "calculix"):
            path = self.path / form
            status, text = self.call(run, "--to", form, "--output", path)
            self.assertEqual(status, 0, text)
            for said in (text, path.read_text(encoding="utf-8")):
                self.assertIn("Layer 1: its law has no Young's modulus", said)

    def test_a_title_is_no_code(self) -> None:
        """A title of several lines, with quotes and signs of remarks, is a remark."""
        run = self.path / "run"
        shutil.copytree(TINY, run)
        summary = json.loads((run / "run.json").read_text(encoding="utf-8"))
        summary["title"] = 'x\n*STEP\r"""\nexit()\x1b[31m\u2028exit() --> <a>'
        (run / "run.json").write_text(json.dumps(summary), encoding="utf-8")
        marks = {"csv": "#", "abaqus": "**", "vtu": ""}
        for form, mark in marks.items():
            path = self.path / form
            status, said = self.call(run, "--to", form, "--output", path)
            self.assertEqual(status, 0, said)
            self.assertNotIn("\x1b", said)
            text = path.read_text(encoding="utf-8")
            (line,) = (line for line in text.splitlines() if "exit()" in line)
            self.assertTrue(line.startswith(mark), line)
            self.assertNotIn("\x1b", text)
            if form == "vtu":
                comment = ElementTree.fromstring(text)
                self.assertEqual(comment.tag, "VTKFile")

    def test_a_disk_that_is_full(self) -> None:
        """Nothing is said to be written, the older file stays, and no half of one."""
        run = self.path / "run"
        shutil.copytree(TINY, run)
        full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        for form in ("vtu", "abaqus"):
            path = self.path / f"old.{form}"
            path.write_text("mine", encoding="utf-8")
            given = (run, "--to", form, "--output", path)
            status, text = self.call(*given)
            self.assertEqual(status, 1)
            self.assertIn(f"{path} exists, and differs", text)
            with unittest.mock.patch("os.fsync", side_effect=full):
                status, text = self.call(*given, "--overwrite")
            self.assertEqual(status, 1)
            self.assertRegex(text, rf"^export: {path} cannot .*: No space left .*kept$")
            self.assertEqual(path.read_text(encoding="utf-8"), "mine")
            self.assertEqual(list(self.path.glob(".*")), [])

    def test_a_run_of_another_body(self) -> None:
        status, text = self.call(self.run_with({}), "--to", "csv")
        self.assertEqual(status, 1)
        self.assertIn("only runs of a caisson are exported, not those of a pile", text)

    def test_spacing(self) -> None:
        """It may have a unit, and must suit the wall and the memory."""
        given = (TINY, "--to", "csv", "--output", self.path / "a.csv", "--spacing")
        with self.state_of(made_up()):
            status, text = self.call(*given, "400mm")
            self.assertEqual(status, 0, text)
            _, text = self.call(*given, "0.001")
            self.assertRegex(text, r"gives .* cells, more than 200000: take 0\.01\d m")
            _, text = self.call(*given, "3")
            self.assertRegex(text, "does not resolve the wall.* at most 0.95 m")

    def test_what_is_refused(self) -> None:
        with self.state_of(made_up()):
            _, text = self.call(TINY, "--to", "csv", "--radius", "50")
        self.assertIn("the mesh reaches to r = 50 m", text)
        _, text = self.call(self.path, "--to", "csv")
        self.assertIn("no history.csv", text)


if __name__ == "__main__":
    unittest.main()
