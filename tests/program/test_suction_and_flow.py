#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Weight, suction and the flow of pore water around a caisson."""
import math
import unittest

from program import (
    BAD_INPUT,
    SUCCESS,
    Entries,
    ProgramTest,
    Results,
    Rows,
    history,
    scene,
    summary,
    user_scene,
)

from caisson import run_error_bar
from caisson.results import ResultsError

INNER_RADIUS = 2.8  # m, of simulation/jack.prm
WEIGHT = 6e4  # N, of water/suction.prm
GAMMA_W = 9810.0  # N/m3
AT_REST: Entries = {
    "Rigid body/Velocity": 0,
    "Rigid body/Ramp time": 0,
    "Water/Suction control": "table",
    "Water/Suction table": "0:0, 1:10000",
    "Time/End penetration": "never",
    "Time/End time": 0.5,
    "Output/Record interval": 0.1,
}


PUMPED: Entries = {"Water/Level": "seepage", "Water/Suction control": "flow"}


class Suction(ProgramTest):
    """A caisson that moves as prescribed; the suction is a result."""

    def test_flow_and_equilibrium(self) -> None:
        path = self.directory()
        self.run_scene("suction", path, entries={"Output/Record interval": 0.1})
        area = math.pi * INNER_RADIUS**2
        rows = history(path)
        self.assertGreater(rows[-1]["suction_Pa"], 5e3)
        for row in rows:
            self.assertAlmostEqual(
                row["seepage_flow_m3_s"], row["seepage_inflow_m3_s"], delta=1e-11
            )
            self.assertAlmostEqual(
                row["suction_force_N"], area * row["suction_Pa"], delta=1
            )
        # weight and suction bear the resistance, but for the delay
        tail = rows[-5:]
        loads = [
            WEIGHT + row["suction_force_N"] - row["tip_water_force_N"] for row in tail
        ]
        forces = [row["total_force_N"] for row in tail]
        self.assertAlmostEqual(sum(loads) / sum(forces), 1, delta=0.1)

    def test_suction_reduces_the_resistance(self) -> None:
        drained, drawn = self.directory("drained"), self.directory("drawn")
        self.run_scene("suction", drained, entries={"Water/Level": "drained"})
        self.run_scene("suction", drawn)
        self.assertNotIn("suction_Pa", history(drained)[-1])
        self.assertLess(
            history(drawn)[-1]["tip_force_N"], 0.9 * history(drained)[-1]["tip_force_N"]
        )

    def test_error_bar(self) -> None:
        """Bounds of a file whose half-widths grow with depth: relative ones of forces,
        absolute ones of the suction; none where the file is of another scene."""
        path = self.directory()
        entries: Entries = {"Time/End time": 1.2, "Output/Record interval": 0.1}
        self.run_scene("suction", path, entries=entries)
        file = self.made_directory() / "bar.csv"
        file.write_text(
            f"# fingerprint: {summary(path)['fingerprint']}\n"
            "penetration_m,tip_below,tip_above,tip_shift,total_below,total_above,"
            "total_shift,required_suction_below_Pa,required_suction_above_Pa,"
            "required_suction_shift_Pa\n"
            "0.52,0.1,0.1,-0.05,0.2,0.2,-0.1,1000,1000,-500\n"
            "0.58,0.4,0.4,-0.05,0.2,0.2,-0.1,4000,4000,-500\n"
        )
        run_error_bar.adopt(path, file)
        rows = [r for r in history(path) if 0.52 <= r["penetration_m"] <= 0.58]
        self.assertGreater(len(rows), 3)
        bounds = Results(path).error_bounds
        self.assertEqual(len(bounds["penetration_m"]), len(rows))
        self.assertNotIn("plug_heave_low_m", bounds)
        for i, row in enumerate(rows):
            share = (row["penetration_m"] - 0.52) / 0.06
            for side, sign in (("low", -1), ("high", 1)):
                self.assertAlmostEqual(
                    bounds[f"required_suction_{side}_Pa"][i],
                    row["required_suction_Pa"] + sign * (1e3 + 3e3 * share),
                    delta=0.1,
                )
                self.assertAlmostEqual(
                    bounds[f"tip_force_{side}_N"][i] / row["tip_force_N"],
                    1 + sign * (0.1 + 0.3 * share),
                    6,
                )
            # where all meshes would end
            self.assertAlmostEqual(
                bounds["required_suction_limit_Pa"][i],
                row["required_suction_Pa"] - 500,
                delta=0.1,
            )
            limit = bounds["tip_force_limit_N"][i] / row["tip_force_N"]
            self.assertAlmostEqual(limit, 0.95, 6)
        entries["Rigid body/Submerged weight"] = 5e4
        other = self.directory("other")
        self.run_scene("suction", other, entries=entries)
        with self.assertRaisesRegex(ResultsError, "other parameters"):
            run_error_bar.adopt(other, file)
        self.assertFalse((other / run_error_bar.HISTORY).exists())

    def test_exit_gradient_has_no_peaks(self) -> None:
        """Over the suction, it falls with depth; at a single node it would rise by
        2 % and more where the mudline of a column crosses a row of cells."""
        path = self.directory()
        self.run_program(
            SUCCESS,
            user_scene("jack_coarse"),
            "--output-directory",
            path,
            entries={
                "Water/Level": "seepage",
                "Soil/Layer 1/Permeability": 1e-4,
                "Rigid body/Submerged weight": 6e5,
                "Grid/Growth ratio": 1.4,
                "Material points/Per direction in path": 3,
                "Material points/Per direction near": 2,
                "Material points/Per direction far": 2,
                "Time/Inertia tolerance": "none",
                "Time/Mass scaling": 100,
                "Time/End penetration": 1.8,
                "Output/Frame interval": "never",
            },
        )
        shares = [
            row["exit_gradient_wall"] / row["suction_Pa"]
            for row in history(path)
            if row["penetration_m"] > 0.7 and row["suction_Pa"] > 0
        ]
        self.assertGreater(len(shares), 100)
        for before, after in zip(shares, shares[1:]):
            self.assertLess(after, 1.005 * before)
            self.assertGreater(after, 0.95 * before)

    def test_plug_at_lid(self) -> None:
        """The lid, 0.3 m over the mudline, bears no load before the soil is there,
        and the run ends where it bears on the whole lid."""
        path = self.directory()
        entries: Entries = {
            "Rigid body/Skirt length": 1,
            "Rigid body/Lid thickness": 0.2,
            "Time/End penetration": 0.95,
            "Output/Record interval": 0.05,
        }
        text = self.run_scene("suction", path, entries=entries)
        self.assert_words(["ended at a penetration", "plug fills"], text)
        self.assertNotIn("refusal", text)  # piping has begun before
        rows = history(path)
        for row in rows:
            gap = 0.3 - (row["penetration_m"] - 0.5) - row["plug_heave_m"]
            if gap > 0.05:
                self.assertEqual(row["lid_force_N"], 0)
        self.assertGreater(rows[-1]["lid_force_N"], 0)
        self.assertLess(rows[-1]["suction_Pa"], 1e5)

    def test_heavy_body_needs_no_suction(self) -> None:
        path = self.directory()
        self.run_scene("suction", path, entries={"Rigid body/Submerged weight": 1e7})
        last = history(path)[-1]
        self.assertEqual(last["suction_Pa"], 0)
        self.assertLess(last["required_suction_Pa"], 0)

    def test_pump_ends_the_run(self) -> None:
        path = self.directory()
        text = self.run_scene("suction", path, entries={"Water/Largest suction": 5e3})
        self.assert_words(["ended at a penetration", "Largest suction", "pump"], text)
        self.assertLess(history(path)[-1]["penetration_m"], 0.7)
        self.assertIn("pump", summary(path)["scene"]["end_reason"])

    def test_cavitation_ends_the_run(self) -> None:
        path = self.directory()
        entries = {
            **AT_REST,
            "Water/Suction table": "0:0, 1:1e6",
            "Water/Water depth": 0,
        }
        text = self.run_scene("suction", path, entries=entries)
        self.assert_words(["cavitation", "2.5 m above the mudline"], text)
        # the atmosphere less vapor pressure, less the water up to the lid
        boils = 101.3e3 - 1.2e3 - 2.5 * GAMMA_W
        last = history(path)[-1]
        self.assertAlmostEqual(last["cavitation_suction_Pa"] / boils, 1, 9)
        self.assertGreater(last["suction_Pa"], boils)
        self.assertLess(last["suction_Pa"], boils + 1e6 * last["time_step_s"])

    def test_plug_balance(self) -> None:
        """The mudline rises by the soil that comes in and its dilation. A part of
        what the wall displaces comes in, and suction draws in more."""
        path = self.directory()
        entries = {"Time/End penetration": 1.5}
        self.run_scene("suction", path, entries=entries)
        rows = [row for row in history(path) if row["penetration_m"] > 1.24]
        self.assertGreater(len(rows), 3)
        area = math.pi * INNER_RADIUS**2
        for row in rows:
            self.assertLess(abs(row["plug_balance_error"]), 0.025)
            rise, inflow, growth = (
                row[f"plug_{name}_m3"]
                for name in ("heave_volume", "inflow", "dilation")
            )
            self.assertAlmostEqual(rise, area * row["plug_heave_m"], 8)
            self.assertAlmostEqual(
                row["plug_balance_error"], (rise - inflow - growth) / rise, 9
            )
            wall = math.pi * (3**2 - INNER_RADIUS**2) * (row["penetration_m"] - 0.5)
            self.assertGreater(inflow, 0.8 * wall)
            self.assertLess(inflow, wall)

    def test_plug_of_ranks_and_restart(self) -> None:
        """The soil of all ranks counts, from the start of the first run on."""
        rows = []
        for ranks, ends in ((1, [0.6]), (3, [0.6]), (1, [0.55, 0.6])):
            path = self.directory(f"{ranks}_{len(ends)}")
            for end in ends:
                self.run_scene(
                    "suction",
                    path,
                    SUCCESS,
                    *(["--restart"] if end != ends[0] else []),
                    entries={"Time/End penetration": end},
                    ranks=ranks,
                )
            rows.append(history(path)[-1])
        self.assertGreater(rows[0]["plug_inflow_m3"], 0.1)
        for row, delta in zip(rows[1:], (1e-4, 0.05)):
            self.assertAlmostEqual(
                row["plug_inflow_m3"] / rows[0]["plug_inflow_m3"], 1, delta=delta
            )

    def test_ranks(self) -> None:
        rows = []
        for ranks in (1, 2):
            path = self.directory(f"of_{ranks}")
            entries = {**AT_REST, "Time/End time": 0.05, "Output/Record interval": 0.05}
            self.run_program(
                SUCCESS,
                scene("suction"),
                "--output-directory",
                path,
                entries=entries,
                ranks=ranks,
            )
            rows.append(history(path)[-1])
        for name in (
            "total_force_N",
            "pore_pressure_factor",
            "seepage_flow_m3_s",
            "exit_gradient_wall",
            "mudline_at_inner_wall_m",
        ):
            self.assertAlmostEqual(rows[1][name] / rows[0][name], 1, 6, name)

    def test_restart(self) -> None:
        """The flow is computed again, so that digits change, but not the curve."""
        whole, parts = self.directory("whole"), self.directory("parts")
        self.run_scene("suction", whole)
        self.run_scene("suction", parts, entries={"Time/End penetration": 0.6})
        self.run_scene("suction", parts, SUCCESS, "--restart")
        self.assertAlmostEqual(
            history(parts)[-1]["suction_Pa"] / history(whole)[-1]["suction_Pa"],
            1,
            delta=0.05,
        )


class Flow(ProgramTest):
    """The steady flow around a skirt that does not move."""

    def test_permeability(self) -> None:
        """A uniform one scales the flow, and changes nothing else."""
        rows = []
        for k in (1e-3, 1e-9):
            path = self.directory(f"k_{k}")
            entries = {**AT_REST, "Soil/Layer 1/Permeability": k}
            self.run_scene("suction", path, entries=entries)
            rows.append(history(path)[-1])
        self.assertAlmostEqual(
            rows[0]["seepage_flow_m3_s"] / rows[1]["seepage_flow_m3_s"] / 1e6, 1, 9
        )
        self.assertAlmostEqual(
            rows[0]["pore_pressure_factor"], rows[1]["pore_pressure_factor"], 9
        )

    def test_layers(self) -> None:
        """A tight layer at the top takes the gradient of the plug; a tight one
        below the tip hardly matters to it."""
        factor = {}
        for name, top, bottom in (("top", 1e-8, 1e-3), ("even", 1e-3, 1e-3)):
            path = self.directory(name)
            entries = {
                **AT_REST,
                "Soil/Number of layers": 2,
                "Soil/Layer 2/Top depth": 0.3,
                "Soil/Layer 1/Permeability": top,
                "Soil/Layer 2/Permeability": bottom,
                "Soil/Layer 1/Permeability ratio": 1,
            }
            self.run_scene("suction", path, entries=entries)
            factor[name] = history(path)[-1]
        self.assertAlmostEqual(
            factor["top"]["seepage_flow_m3_s"], factor["top"]["seepage_inflow_m3_s"], 12
        )
        # half of the head is lost on either side, over the thickness of 0.3 m
        gradient = 0.5 * factor["top"]["suction_Pa"] / GAMMA_W / 0.3
        self.assertGreater(factor["top"]["exit_gradient_axis"], 0.3 * gradient)
        self.assertGreater(
            factor["top"]["exit_gradient_axis"], factor["even"]["exit_gradient_axis"]
        )


def flow_of_pump(rows: Rows) -> float:
    """Return the mean flow from the first to the last row, in m3/s."""
    pumped, time = [
        rows[-1][key] - rows[0][key] for key in ("pumped_volume_m3", "time_s")
    ]
    return pumped / time


class Lowered(ProgramTest):
    """A caisson that sinks by its loads."""

    def test_weight_is_borne(self) -> None:
        path = self.directory()
        text = self.run_scene("lowered", path)
        self.assert_words(["came to rest"], text)
        rows = history(path)
        self.assertAlmostEqual(rows[-1]["total_force_N"] / 1e5, 1, delta=0.01)
        depths = [row["penetration_m"] for row in rows]
        self.assertGreater(depths[1], depths[0])
        self.assertAlmostEqual(depths[-1], depths[1], delta=2e-3)
        self.assertAlmostEqual(depths[-1], 0.505, delta=1e-3)

    def test_velocity(self) -> None:
        """It sinks as fast as it may while the soil bears little."""
        path = self.directory()
        entries = {"Rigid body/Lowering velocity": 4e-3, "Time/End time": 0.8}
        entries["Output/Record interval"] = 0.1
        self.run_scene("lowered", path, entries=entries)
        a, b = history(path)[-2:]
        way = b["penetration_m"] - a["penetration_m"]
        self.assertAlmostEqual(way / (b["time_s"] - a["time_s"]), 4e-3, delta=1e-5)

    def test_suction_begins_at_rest(self) -> None:
        path = self.directory()
        entries = {
            "Water/Level": "seepage",
            "Water/Suction control": "table",
            "Water/Suction table": "0:0, 2:1e4",
            "Output/Record interval": 0.1,
        }
        self.run_scene("lowered", path, entries=entries)
        rows = history(path)
        begin = next(row for row in rows if row["suction_Pa"] > 0)
        self.assertGreater(begin["time_s"], 0.5)
        self.assertGreater(rows[-1]["penetration_m"], begin["penetration_m"] + 0.02)

    def test_suction_at_once_waits_for_rest(self) -> None:
        """A table that begins above 0 does not act before the weight is borne."""
        path = self.directory()
        entries = {
            "Water/Level": "seepage",
            "Water/Suction control": "table",
            "Water/Suction table": "0:1e4",
            "Time/End time": 2,
            "Output/Record interval": "every step",
        }
        text = self.run_scene("lowered", path, entries=entries)
        self.assert_words(["came to rest"], text)
        rows = history(path)
        begin = next(i for i, row in enumerate(rows) if row["suction_Pa"] > 0)
        self.assertGreater(rows[begin]["time_s"], 0.5)
        self.assertEqual(rows[begin]["suction_Pa"], 1e4)
        self.assertAlmostEqual(
            rows[begin]["penetration_m"],
            summary(path)["scene"]["rest_penetration_m"],
            delta=1e-4,
        )
        self.assertGreater(
            rows[-1]["penetration_m"], rows[begin]["penetration_m"] + 0.02
        )

    def test_pump_takes_its_flow(self) -> None:
        """The pump takes 0.5 m3/s: what the lid, the plug and the seepage leave."""
        path = self.directory()
        entries: Entries = {
            **PUMPED,
            "Water/Pumped flow table": "0:0, 1:0.5",
            "Time/End penetration": 0.75,
            "Time/End time": 12,
            "Output/Record interval": 1,
        }
        self.run_scene("lowered", path, entries=entries)
        rows = history(path)[-5:]
        self.assertAlmostEqual(flow_of_pump(rows) / 0.5, 1, delta=0.1)
        self.assertGreater(rows[-1]["suction_Pa"], rows[0]["suction_Pa"])

    def test_pump_takes_gas(self) -> None:
        """100 m3 of gas under 30 m of water: it expands as Boyle says, and the pump
        takes 0.1 m3/s of water and gas."""
        path = self.directory()
        entries: Entries = {
            **PUMPED,
            "Water/Pumped flow table": "0:0.1",
            "Water/Trapped gas": 100,
            "Time/End time": 8,
            "Output/Record interval": 1,
        }
        self.run_scene("lowered", path, entries=entries)
        rows = history(path)
        ambient = 101.3e3 + 30 * GAMMA_W
        for row in rows:
            s = row["suction_Pa"]
            self.assertAlmostEqual(
                row["gas_expansion_m3"], 100 * (ambient / (ambient - s) - 1), 6
            )
        self.assertGreater(rows[-1]["gas_expansion_m3"], 0.3)
        self.assertAlmostEqual(flow_of_pump(rows[-5:]) / 0.1, 1, delta=0.1)

    def test_pump_that_is_too_weak(self) -> None:
        entries: Entries = {
            **PUMPED,
            "Water/Pumped flow table": "0:0.5",
            "Water/Largest suction": 2e3,
            "Time/End time": 20,
        }
        text = self.run_scene("lowered", self.directory(), entries=entries)
        self.assert_words(["ended at a penetration", "Largest suction"], text)

    def test_no_rest_is_told(self) -> None:
        entries: Entries = {"Time/End time": 0.4}
        text = self.run_scene("lowered", self.directory(), entries=entries)
        self.assert_words(["has not come to rest", "End time"], text)
        self.assertNotIn("suction", text)
        entries = {
            "Rigid body/Submerged weight": 1e7,
            "Water/Level": "seepage",
            "Water/Suction control": "table",
            "Water/Suction table": "0:1e4",
            "Time/End penetration": 0.52,
        }
        text = self.run_scene("lowered", self.directory("heavy"), entries=entries)
        words = ["has not come to rest", "has not begun", "(1e+07 N)", "bears less"]
        self.assert_words(words, text)
        self.assertNotIn("End time", text.split("has not begun")[1])


class Dropped(ProgramTest):
    """A caisson that its loads accelerate."""

    def test_mass(self) -> None:
        """However light the body is against the soil at its tip, it rests there,
        and its weight does the work that the soil takes."""
        for mass, delta, residual in (("844", 0.02, 0.01), ("auto", 0.01, 0.001)):
            with self.subTest(mass=mass):
                path = self.directory(f"mass_{mass}")
                entries = {"Rigid body/Inertia": mass, "Time/End time": 2}
                text = self.run_scene("dropped", path, entries=entries)
                self.assert_words(["came to rest"], text)
                last = history(path)[-1]
                travel = last["penetration_m"] - 0.5
                self.assertAlmostEqual(travel, 5.3e-3, delta=1e-3)
                self.assertAlmostEqual(
                    last["external_work_J"] / (1e5 * travel), 1, delta=delta
                )
                self.assertAlmostEqual(last["total_force_N"] / 1e5, 1, delta=0.03)
                self.assertLess(abs(last["energy_residual"]), residual)

    def test_inertia_delays(self) -> None:
        """A body of 84,400 t hardly moves, so that the soil below the tip bears no
        more than it did at the start."""
        path = self.directory()
        entries = {
            "Rigid body/Inertia": 8.44e7,
            "Time/End time": 0.2,
            "Output/Record interval": 0.05,
        }
        self.run_scene("dropped", path, entries=entries)
        travel = history(path)[-1]["penetration_m"] - 0.5
        load = 1e5 - 0.6 * 1500 * 9.81 * 0.5 * math.pi * (3**2 - INNER_RADIUS**2)
        expected = 0.5 * load / 8.44e7 * 0.2**2
        self.assertAlmostEqual(travel / expected, 1, delta=0.05)

    def test_release(self) -> None:
        """Weight that is let go slowly is borne as it comes."""
        path = self.directory()
        entries = {
            "Rigid body/Release time": 2,
            "Time/End time": 1,
            "Output/Record interval": 0.25,
        }
        self.run_scene("dropped", path, entries=entries)
        for row in history(path)[1:]:
            released = 5e4 * (row["time_s"] - 0.125)  # the force is a mean
            self.assertAlmostEqual(row["total_force_N"], released, delta=3e3)

    def test_ranks_and_restart(self) -> None:
        entries: Entries = {"Time/End time": 0.4, "Output/Record interval": 0.2}
        whole, parts, ranks = [self.directory(n) for n in ("whole", "parts", "ranks")]
        self.run_scene("dropped", whole, entries=entries)
        self.run_scene("dropped", parts, entries={**entries, "Time/End time": 0.2})
        self.run_scene("dropped", parts, SUCCESS, "--restart", entries=entries)
        self.run_scene("dropped", ranks, entries=entries, ranks=2)
        for path in (parts, ranks):
            self.assertAlmostEqual(
                history(path)[-1]["penetration_m"],
                history(whole)[-1]["penetration_m"],
                delta=1e-7,
            )


class Header(ProgramTest):
    """What a run says of its water before it begins."""

    def test_velocity_of_a_dropped_body_is_a_result(self) -> None:
        entries = {
            "Water/Level": "coupled",
            "Water/Suction control": "table",
            "Water/Suction table": "0:0",
            "Time/End time": 0.002,
        }
        text = self.run_scene("dropped", self.directory(), entries=entries)
        self.assert_words(["v D / c_v", "for each m/s", "a result"], text)


class BadInput(ProgramTest):
    """Scenes that have no flow, or no answer."""

    def test_messages(self) -> None:
        cases: list[tuple[Entries, list[str]]] = [
            ({"Soil/Submerged": "false"}, ["Submerged", "dry"]),
            ({"Rigid body/Kind": "none"}, ["Water/Level", "caisson"]),
            ({"Rigid body/Initial penetration": 0}, ["Initial penetration"]),
            ({"Water/Suction control": "table"}, ["Suction table", "empty"]),
            (
                {
                    "Water/Suction control": "table",
                    "Water/Suction table": "1:0, 1:5",
                },
                ["does not follow"],
            ),
            ({"Rigid body/Motion": "lowered"}, ["table or flow", "prescribed"]),
            (
                {"Rigid body/Motion": "lowered", "Rigid body/Submerged weight": 0},
                ["Submerged weight is 0", "comes to rest"],
            ),
            ({"Water/Suction control": "flow"}, ["Pumped flow table", "no flow"]),
            (
                {
                    "Water/Suction control": "flow",
                    "Water/Pumped flow table": "0:0.5",
                },
                ["prescribed", "lowered or dropped", "required or table"],
            ),
            ({"Grid/Geometry": "plane strain"}, ["Geometry", "axisymmetric"]),
            (
                {
                    "Rigid body/Motion": "lowered",
                    "Water/Suction control": "table",
                    "Water/Suction table": "0:0, 1:5",
                },
                ["End time", "rest"],
            ),
        ]
        for entries, words in cases:
            with self.subTest(entries=entries):
                text = self.run_program(
                    BAD_INPUT, scene("suction"), "--validate", entries=entries
                )
                self.assert_words(words, text)


if __name__ == "__main__":
    unittest.main()
