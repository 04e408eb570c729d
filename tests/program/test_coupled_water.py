#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pore water whose pressure follows from the motion of the soil."""
import math
import shutil
import unittest
from pathlib import Path

from program import (
    FAILURE,
    SUCCESS,
    Entries,
    ProgramTest,
    Status,
    history,
    user_scene,
)

COARSE: Entries = {"Grid/Cell width": 0.1, "Grid/Cell height": 0.1}
COUPLED: Entries = {"Water/Level": "coupled"}
AT_REST: Entries = {
    "Rigid body/Velocity": 0,
    "Rigid body/Ramp time": 0,
    "Water/Suction control": "table",
    "Water/Suction table": "0:0, 0.5:2000",
    "Time/End penetration": "never",
    "Time/End time": 1,
}
NO_SUCTION: Entries = {
    "Water/Suction control": "table",
    "Water/Suction table": "0:0, 1:0",
}


class Column(ProgramTest):
    """Columns of soil that have a known answer."""

    def run_column(self, name: str, entries: Entries, status: Status = SUCCESS) -> Path:
        path = self.directory()
        self.run_program(
            status,
            user_scene(f"verification/{name}"),
            "--output-directory",
            path,
            entries=entries,
        )
        return path

    def test_consolidation(self) -> None:
        path = self.run_column("consolidation", COARSE)
        last = history(path)[-1]
        self.assertAlmostEqual(last["pore_pressure_largest_Pa"] / 9490.5, 1, 2)
        self.assertLess(last["water_balance"], 1e-8)

    def test_permeability_decides(self) -> None:
        entries = {**COARSE, "Soil/Layer 1/Permeability": 1.1e-4}
        self.run_column("consolidation", entries, FAILURE)

    def test_time_compression(self) -> None:
        """Ten times faster with a tenth of the permeability is the same."""
        entries = {
            **COARSE,
            "Soil/Layer 1/Permeability": 1e-5,
            "Water/Time compression": 10,
        }
        self.run_column("consolidation", entries)

    def test_short_last_step(self) -> None:
        """A rest of a step before the end leaves the pressure where it is."""
        entries = {
            "Time/End time": 1.45748615,
            "Output/Record interval": 0.1457486,
            "Verification/Checks": "",
        }
        rows = history(self.run_column("consolidation", entries))[-2:]
        self.assertLess(rows[1]["time_s"] - rows[0]["time_s"], 1e-6)
        before, after = (row["pore_pressure_largest_Pa"] for row in rows)
        self.assertAlmostEqual(after / before, 1, delta=0.002)

    def test_soil_that_conducts_badly(self) -> None:
        """A front of two cells keeps its pressure: 1 - 2 sqrt(T / pi) of it is left
        at T = 0.01."""
        entries = {
            "Soil/Layer 1/Permeability": 4e-6,
            "Time/Mass scaling": 1,
            "Verification/Checks": "",
            "Verification/Observations": "p = mean pore_pressure",
            "Time/End time": 3.643715,
            "Output/Record interval": 3.643715,
        }
        path = self.run_column("consolidation", entries)
        p = history(path, "observations")[-1]["p"]
        self.assertAlmostEqual(p / 8871.6, 1, delta=0.003)

    def test_soil_that_cannot_drain(self) -> None:
        """The water bears the load, next to the open surface too: the effective stress
        is that of the weight."""
        entries = {
            "Soil/Layer 1/Permeability": 1e-12,
            "Verification/Checks": "rms stress_zz : 8829*z : 0.01",
        }
        self.run_column("consolidation", entries)

    def test_drained_bottom(self) -> None:
        """A closed surface over an open bottom is the same column upside down."""
        scene = Path(user_scene("verification/consolidation")).read_text()
        checks = scene.split("set Checks =")[1].split("end")[0].replace("\\\n", "")
        entries = {
            "Water/Drained surface": "false",
            "Water/Drained bottom": "true",
            "Verification/Checks": checks.strip().replace("z", "(-1 - z)"),
        }
        self.run_column("consolidation", entries)

    def test_closed_surface_that_rises(self) -> None:
        """Water that enters from below lifts the surface into the highest row of the
        mesh, whose upper nodes are held: it moves freely all the same, by the share of
        p H / M that is consolidated."""
        entries: Entries = {
            **COARSE,
            "Boundary conditions/Top": "roller",
            "Loads/Surrounding pressure": 0,
            "Water/Drained surface": "false",
            "Water/Drained bottom": "true",
            "Water/Bottom pressure": 1e4,
            "Verification/Checks": "",
        }
        path = self.run_column("consolidation", entries)
        rise = history(path, "observations")[-1]["top"]
        self.assertAlmostEqual(rise / (0.35682 * 1e4 / 6.7308e6), 1, delta=0.05)

    def test_points_in_cells_of_two_sizes(self) -> None:
        """The pressure of points is interpolated where cells become smaller, too."""
        scene = Path(user_scene("verification/consolidation")).read_text()
        checks = scene.split("set Checks =")[1].split("end")[0].replace("\\\n", "")
        entries = {
            **COARSE,
            "Grid/Outer radius": 0.4,
            "Grid/Refinement levels": 1,
            "Grid/Refined region": "-z-0.55",
            "Verification/Checks": checks.strip().replace(": 0.01", ": 0.003"),
        }
        self.run_column("consolidation", entries)

    def test_surface_between_cells_of_two_sizes(self) -> None:
        """The lower half rises on the left and sinks on the right: pressures are odd
        about the middle. Left of r = 0.25, the surface rises above cells of 0.05 m,
        but less than it sinks right of it, so that the larger cell above is dry."""
        entries: Entries = {
            **COARSE,
            "Grid/Outer radius": 0.4,
            "Grid/Refinement levels": 1,
            "Grid/Refined region": "-z-0.01",
            "Loads/Surrounding pressure": 0,
            "Soil/Layer 1/Permeability": 1e-8,
            "Boundary conditions/Bottom": "free",
            "Boundary conditions/Prescribed region": "-0.5-z",
            "Boundary conditions/Prescribed velocity": "0 ; "
            "t < 1 ? 0.002*(cos(pi*r/0.4)+0.06) : 0",
            "Time/Mass scaling": 4,
            "Time/End time": 1.5,
            "Output/Record interval": 1.5,
            "Verification/Checks": "",
            "Verification/Observations": "; ".join(
                f"{name} = projection pore_pressure on "
                f"(r>{left})*(r<{left + 0.05})*(z>-0.05)"
                for name, left in (("left", 0.15), ("right", 0.2))
            ),
        }
        path = self.run_column("consolidation", entries)
        last = history(path, "observations")[-1]
        self.assertGreater(last["right"], 300)
        self.assertAlmostEqual(last["right"] / last["left"], -1, delta=0.04)

    def test_points_beside_a_layer_that_conducts_badly(self) -> None:
        """What flows up through clay has hardly any pressure left in the sand above,
        next to the clay too."""
        entries: Entries = {
            "Soil/Number of layers": 2,
            "Soil/Layer 1/Permeability": 1e-2,
            "Soil/Layer 2/Top depth": 0.5,
            "Soil/Layer 2/Permeability": 1e-6,
            "Soil/Layer 2/Law": "linear elastic",
            "Soil/Layer 2/Youngs modulus": 5e7,
            "Soil/Layer 2/Poisson ratio": 0.3,
            "Loads/Surrounding pressure": 0,
            "Water/Drained bottom": "true",
            "Water/Bottom pressure": "2000*min(t, 1)",
            "Time/Mass scaling": 1000,
            "Time/End time": 50,
            "Output/Record interval": 50,
            "Verification/Checks": "",
            "Verification/Observations": "p = projection pore_pressure on "
            "(abs(z+0.475) < 0.024)",
        }
        path = self.run_column("consolidation", entries)
        resistances = 0.475 / 1e-2, 0.5 / 1e-2 + 0.5 / 1e-6
        p = history(path, "observations")[-1]["p"]
        self.assertAlmostEqual(
            p / (2000 * resistances[0] / resistances[1]), 1, delta=0.02
        )

    def test_upward_flow(self) -> None:
        """Just below the critical gradient nothing moves; just above, all does."""
        self.run_column("updraft", {})
        entries = {
            "Water/Bottom pressure": "1.05*8829*min(t, 1)",
            "Verification/Checks": "",
            "Output/Record interval": 1,
        }
        path = self.run_column("updraft", entries)
        self.assertGreater(history(path, "observations")[-1]["bottom"], 1e-3)

    def test_boiling_is_told(self) -> None:
        """A bottom at 1 m that is drawn at with 200 kPa has 101.3 - 200 + 9.81 kPa,
        1.2 kPa of it vapor; under 20 m of water it is far from boiling."""
        entries: Entries = {
            **COARSE,
            "Water/Drained bottom": "true",
            "Water/Bottom pressure": -2e5,
            "Time/End time": 0.02,
            "Output/Record interval": 0.01,
            "Verification/Checks": "",
        }
        for depth in (0, 20):
            with self.subTest(depth=depth):
                path = self.directory(f"depth_{depth}")
                text = self.run_program(
                    SUCCESS,
                    user_scene("verification/consolidation"),
                    "--output-directory",
                    path,
                    entries={**entries, "Water/Water depth": depth},
                )
                margin = 101.3e3 - 1.2e3 + 9810 * (depth + 1) - 2e5
                self.assertAlmostEqual(
                    history(path)[-1]["cavitation_margin_Pa"], margin, delta=1
                )
                if margin < 0:
                    self.assert_words(["vapor pressure", "z = -1 m"], text)
                else:
                    self.assertNotIn("vapor pressure", text)


class TightLayer(ProgramTest):
    """A layer of clay between two of sand in a box. Water under pressure comes in
    through the bottom, and leaves through the top and the outer side, so that the
    pressure changes along the clay, too."""

    SAND = 0.1  # thickness of that above and below, width of the box, m
    PERMEABILITY = 1e-9  # of the clay, m/s
    PERMEABILITY_OF_SAND = 1e-4
    PRESSURE = 2e4  # at the bottom, Pa
    CELL = 0.02  # m

    def pressure_above(self, thickness: float, x: float, depth: float) -> float:
        """Return that in the upper sand, Pa. Series in cos(k x): the sand below does
        not feel that some water leaves it, and the clay takes all of its pressure."""
        result = 0.0
        for m in range(100):
            k = (m + 0.5) * math.pi / self.SAND
            below = 2 * (-1) ** m / (k * self.SAND) / math.cosh(k * self.SAND)
            flow = self.PERMEABILITY * below / math.sinh(k * thickness)
            above = math.sinh(k * depth) / math.cosh(k * self.SAND) * math.cos(k * x)
            result += self.PRESSURE * flow / self.PERMEABILITY_OF_SAND * above
        return result

    def entries(self, thickness: float, modulus: float) -> Entries:
        """Return those of a run until the flow is steady. modulus: Young's, Pa"""
        c_v = self.PERMEABILITY * 1.346 * modulus / 9810
        end = 1.1 * thickness**2 / c_v
        result: Entries = {
            "Soil/Number of layers": 3,
            "Soil/Layer 2/Top depth": self.SAND,
            "Soil/Layer 3/Top depth": self.SAND + thickness,
            "Loads/Surrounding pressure": 0,
            "Water/Drained outer side": "true",
            "Water/Drained bottom": "true",
            "Water/Bottom pressure": f"{self.PRESSURE}*min(t/{end / 8}, 1)",
            "Grid/Outer radius": self.SAND,
            "Grid/Bottom": -2 * self.SAND - thickness,
            "Grid/Top": 2 * self.CELL,
            "Grid/Cell width": self.CELL,
            "Grid/Cell height": self.CELL,
            "Method/Local damping": 0.3,
            "Time/End time": end,
            "Output/Record interval": end,
            "Verification/Checks": "",
        }
        for layer in (1, 2, 3):
            soil = f"Soil/Layer {layer}"
            result[f"{soil}/Law"] = "linear elastic"
            result[f"{soil}/Youngs modulus"] = modulus
            result[f"{soil}/Poisson ratio"] = 0.3
            result[f"{soil}/Permeability"] = (
                self.PERMEABILITY if layer == 2 else self.PERMEABILITY_OF_SAND
            )
        return result

    def test_flow(self) -> None:
        """What crosses the clay is what Darcy's law lets through, with one or more
        rows of cells and any mass scaling. A step dt without kept pressure would let
        r = dt gamma_w / (rho k) times as much through, 300 to 2000 here."""
        x, depth = 0.005, 0.045  # the place of a point in the upper sand
        for rows, mass_scaling, stiffness in (
            (1, 1, 100),
            (1, 100, 1),
            (3, 25, 200),
        ):
            with self.subTest(rows=rows, mass_scaling=mass_scaling):
                thickness = rows * self.CELL
                path = self.directory(f"{rows}_{mass_scaling}")
                self.run_program(
                    SUCCESS,
                    user_scene("verification/consolidation"),
                    "--output-directory",
                    path,
                    entries={
                        **self.entries(thickness, 5e9 * stiffness),
                        "Time/Mass scaling": mass_scaling,
                        "Verification/Observations": "p = point pore_pressure at "
                        f"{x} {-depth}",
                    },
                )
                p = history(path, "observations")[-1]["p"]
                exact = self.pressure_above(thickness, x, depth)
                self.assertAlmostEqual(p / exact, 1, delta=0.03)


class Rest(ProgramTest):
    """Soil at rest stays so, whatever its layers."""

    def test_layers(self) -> None:
        path = self.directory()
        entries = {**COUPLED, **NO_SUCTION, "Soil/Layer 2/Permeability": 1e-9}
        self.run_scene("equilibrium_layers", path, entries=entries)
        self.assertLess(abs(history(path)[-1]["pore_pressure_largest_Pa"]), 1e-6)


class Caisson(ProgramTest):
    """The caisson of water/suction.prm."""

    def compare_with_seepage(self, mesh: Entries, tolerances: dict[str, float]) -> None:
        """Where water moves freely, its flow is steady at each time."""
        rows = {}
        for level in ("seepage", "coupled"):
            path = self.directory(level)
            entries = {
                **AT_REST,
                **mesh,
                "Water/Level": level,
                "Soil/Layer 1/Permeability": 0.1,
                "Soil/Layer 1/Permeability ratio": 1,
            }
            self.run_scene("suction", path, entries=entries)
            rows[level] = history(path)[-1]
        for name, tolerance in tolerances.items():
            ratio = rows["coupled"][name] / rows["seepage"][name]
            self.assertAlmostEqual(ratio, 1, delta=tolerance, msg=name)

    def test_much_permeability_is_seepage(self) -> None:
        """The force on the tip has an error of first order, in which cells and nodes
        differ in sign."""
        self.compare_with_seepage(
            {}, {"tip_water_force_N": 0.02, "seepage_flow_m3_s": 0.01}
        )

    def test_seepage_through_cells_of_two_sizes(self) -> None:
        """Above the mudline cells are larger than below: what leaves through one of
        them comes from two. Taken from one of them, the gradient is half as large."""
        mesh: Entries = {
            "Rigid body/Cells across the wall": 4,
            "Grid/Refinement levels": 2,
            "Grid/Refinement levels along wall": 1,
        }
        self.compare_with_seepage(
            mesh, {"seepage_flow_m3_s": 0.03, "exit_gradient_wall": 0.05}
        )

    def test_little_permeability_has_excess_pressure(self) -> None:
        path = self.directory()
        entries = {**COUPLED, **NO_SUCTION, "Soil/Layer 1/Permeability": 1e-7}
        self.run_scene("suction", path, entries=entries)
        last = history(path)[-1]
        self.assertGreater(last["tip_water_force_N"], 1e3)
        self.assertLess(last["water_balance"], 1e-7)

    def mean_force(self, name: str, entries: Entries) -> tuple[float, Path]:
        """Return that of soil and water from 0.6 m on (N), and the results."""
        path = self.directory(name)
        self.run_scene("suction", path, entries=entries)
        rows = [row for row in history(path) if row["penetration_m"] >= 0.6]
        return sum(row["total_force_with_water_N"] for row in rows) / len(rows), path

    def test_tight_soil_is_undrained(self) -> None:
        """Where no water flows, the pressure from the equation agrees with that of
        water that is much stiffer than the soil: in sand and in Tresca's clay. Soil
        around the tip keeps its volume, but for what the projection leaves once: a
        small part of the strain by the pressure on the tip in soil that drains."""
        layer = {"Friction angle": 0, "Cohesion": 1e4, "K0": 1, "Tension cut-off": 1e9}
        clay: Entries = {f"Soil/Layer 1/{key}": x for key, x in layer.items()}
        for part in ("tip", "inner wall", "outer wall"):
            clay[f"Rigid body/Friction angle of the {part}"] = 0
        shares = {"low": 0.01, "high": 0.99}  # of the points around the tip
        area, modulus_of_soil = math.pi * (3**2 - 2.8**2), 6.73e6  # m2, Pa
        around = "(r > 2.5)*(r < 3.3)*(z > -1.2)*(z < -0.5)"
        soils: list[tuple[str, Entries, float]] = [  # and the modulus of the water
            ("sand", {}, 8.33e8),
            ("clay", clay, 2.5e8),
        ]
        for kind, soil, modulus in soils:
            with self.subTest(kind):
                soil["Output/Record interval"] = 0.1
                soil["Time/End penetration"] = 0.68
                undrained, _ = self.mean_force(
                    f"{kind}_undrained",
                    {**soil, "Water/Level": "undrained", "Water/Bulk modulus": modulus},
                )
                coupled, path = self.mean_force(
                    f"{kind}_coupled",
                    {
                        **soil,
                        **COUPLED,
                        **NO_SUCTION,
                        "Soil/Layer 1/Permeability": 1e-9,
                        "Verification/Observations": "; ".join(
                            f"{name} = quantile {share} volume_ratio where {around}"
                            for name, share in shares.items()
                        ),
                    },
                )
                self.assertAlmostEqual(coupled / undrained, 1, delta=0.03)
                last = history(path, "observations")[-1]
                pressure = history(path)[-1]["tip_water_force_N"] / area
                for name in shares:
                    strain = abs(last[name] - 1)
                    self.assertLess(strain, 0.05 * pressure / modulus_of_soil, name)

    def test_restart_and_ranks(self) -> None:
        """A checkpoint has the pressure, for any number of ranks."""
        begin = self.directory("begin")
        entries = {**COUPLED, "Time/End time": 0.3}
        self.run_scene("suction", begin, entries=entries)
        entries["Time/End time"] = 0.32
        rows = []
        for ranks in (1, 2):
            path = self.directory(f"of_{ranks}")
            shutil.copytree(begin, path)
            self.run_scene(
                "suction", path, SUCCESS, "--restart", entries=entries, ranks=ranks
            )
            rows.append(history(path)[-2:])
        for name in ("total_force_N", "tip_water_force_N", "required_suction_Pa"):
            self.assertAlmostEqual(rows[0][1][name] / rows[1][1][name], 1, 6, msg=name)
        # the pressure goes on where it was
        before, after = (row["tip_water_force_N"] for row in rows[0])
        self.assertAlmostEqual(after / before, 1, delta=0.3)


class BadInput(ProgramTest):
    """Scenes without an answer."""

    def test_warnings(self) -> None:
        """What is known to be wrong is reported, and only where it is."""
        cases: list[tuple[Entries, list[str]]] = [
            ({"Water/Bottom pressure": "1e4"}, ["Drained bottom is false"]),
            ({"Water/Suction table": "0:0, 1:1"}, ["no caisson"]),
        ]
        for entries, words in cases:
            with self.subTest(entries=entries):
                self.assert_reported(
                    words,
                    "verification/consolidation",
                    {
                        **COARSE,
                        **entries,
                        "Time/End time": 0.01,
                        "Verification/Checks": "",
                    },
                )

    def test_messages(self) -> None:
        cases: list[tuple[Entries, list[str]]] = [
            ({"Soil/Submerged": "false"}, ["Submerged", "dry"]),
            ({"Water/Level": "seepage"}, ["caisson", "coupled"]),
            ({"Water/Drained surface": "false"}, ["nowhere", "Drained bottom"]),
            ({"Water/Bottom pressure": "1e4*x"}, ["Water/Bottom pressure", "x"]),
            (
                {"Water/Drained bottom": "true", "Water/Bottom pressure": "1/t"},
                ["Water/Bottom pressure = 1/t is inf at t = 0"],
            ),
            (
                {"Loads/Surrounding pressure": "sqrt(-1)"},
                ["Loads/Surrounding pressure = sqrt(-1) is", "nan at t = 0"],
            ),
            ({"Method/Mean volume change": "false"}, ["Mean volume change"]),
        ]
        for entries, words in cases:
            with self.subTest(entries=entries):
                self.assert_invalid(words, "verification/consolidation", entries)


if __name__ == "__main__":
    unittest.main()
