# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the rows of a cone test must be, in whatever format they come: the only rules.

A zero that drifts shows as small negative readings: as large as the accuracy of the
application class 3 of ISO 22476-1 (2012) they are no mistake. Above the first row of a
test that begins below the mudline, as in a predrilled hole or at the second push down a
borehole, the soil is that which the user gives, or is ASSUMED to be that of the first
readings.
"""
import re
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from caisson.disk import InputError
from caisson.units import WATER
from caisson.design.cone_table import Table, column_cells, columns_of, numbers_of
from caisson.design.cone_table import refuse
from caisson.design.cone_words import QUANTITIES

# Pa; more and less than any test has
RANGES = {
    "qc": (-0.2e6, 200e6),
    "qt": (-0.2e6, 200e6),
    "fs": (-25e3, 5e6),
    "u2": (-2e6, 20e6),  # dense sand in deep water
}
WEAKEST = 20e3  # Pa; the largest resistance of a test is more
WEAK = 200e3  # Pa; less is doubtful
THOUSANDS = re.compile(r"[1-9]\d{0,2}([.,])\d{3}")  # 1,424 for 1424
DRY = 0.01  # u_2 / u_0; the median of a test under water is more
SMOOTHEST = 2e-4  # f_s / q_c; the median of a test is more
START = 0.5  # m; a first row that is deeper leaves soil of which nothing is known
FIRST = 0.5  # m of readings that tell of the soil above them
DEEPEST = 200.0  # m
LOAD = 0.25  # m of a push down a borehole in which the cone takes load
GAP, SPACINGS = 0.3, 4.0  # m, and times the usual step: a wider step is a gap
SOFT, NEAR = 0.3e6, 0.25  # Pa, the median of q_c within this distance (m) in soft soil
OFFSET = 50e3  # Pa of u_2 at the mudline; no soil has so much
DRIFT = 20e3  # Pa of q_c below 0
AREA_RATIO = 0.8  # net, of a cone of which it is not known
WEIGHT = 16e3  # N/m3, of clay near the mudline
MOST_PRESSURE, USUAL_PRESSURE = 0.7, 0.5  # B_q
SMOOTH = 0.015  # f_s / (q_t - u_2), less than clay has
FEW = 0.1  # of the rows may be left out where the cone met nothing
ENOUGH = 0.2  # of the rows must have a friction or a pressure
REPEATED, BACK = 0.02, 0.05  # of the rows that may go back, and how far (m)
WIDEST_STEP = 0.1  # m of a test that begins at the mudline
GIVEN, ASSUMED = "GIVEN", "ASSUMED"  # how the soil above the first row is known
EDGE = 0.005  # m; a corrected depth may be less than the length, a hole's depth
DISAGREE = 0.5  # m, and a tenth: more is no correction of a depth


def gaps_in(depth: np.ndarray) -> tuple[tuple[float, float], ...]:
    """Return top and bottom of the wide steps between depths [n] (m)."""
    step = np.diff(depth)
    wide = np.flatnonzero(step > max(GAP, SPACINGS * float(np.median(step))))
    return tuple((float(depth[i]), float(depth[i + 1])) for i in wide)


class Readings:
    """The rows of a test, [n] each: the number of each in the file, the name of its
    push, depth and length of the rods (m), cone resistance, sleeve friction and pore
    pressure (Pa), and friction ratio, nan for none; and remarks on what was made of
    them. Each rule changes or refuses them, by InputError."""

    ARRAYS = "row push depth rods tip friction pressure ratio".split()

    def __init__(self, table: Table, wanted: Sequence[str]) -> None:
        """wanted: the quantities that are read."""
        self.table, self.wanted = table, wanted
        self.columns = columns_of(table, wanted)
        self.row, values, self.push = numbers_of(table, self.columns)
        none = np.full(len(self.row), np.nan)
        self.rods = values.get("rods", none)
        self.depth = values.get("depth", self.rods)
        self.tip_name = "qt" if "qt" in values else "qc"
        self.tip, self.friction = values[self.tip_name], values.get("fs", none)
        self.pressure, self.ratio = values.get("u2", none), values.get("rf", none)
        self.remarks = list(table.remarks)
        self.check_unit = f"check the unit in {table.units_are}"

    def keep(self, rows: np.ndarray) -> None:
        """Keep some rows, or all in another order."""
        for name in self.ARRAYS:
            setattr(self, name, getattr(self, name)[rows])

    def say(self, rows: np.ndarray, what: str, why: str = "") -> None:
        """Remark on rows [n]: what they are, how many, and why."""
        some = self.row[rows]
        text = ", ".join(map(str, some[:5])) + (", ..." if len(some) > 5 else "")
        self.remarks.append(f"{what}: {len(some)}, those of number {text}{why}")

    def leave_out(self, rows: np.ndarray, what: str) -> None:
        """Leave out rows [n], and say what they are."""
        if rows.any():
            self.say(rows, f"{what}, left out")
            self.keep(~rows)
        if len(self.row) < 2:
            raise InputError(
                "a cone test needs two rows with a depth and a cone resistance; there"
                f" are {len(self.row)}. {self.remarks[-1]}"
            )

    def refuse(self, rows: np.ndarray, why: Callable[[int], str]) -> None:
        """Refuse the test if some rows [n] are wrong; why: of one."""
        refuse([(int(self.row[i]), why(i)) for i in np.flatnonzero(rows)])

    def refuse_thousands(self) -> None:
        """Refuse cone resistances that are thousands with separators, which would be
        read as decimals."""
        column = self.columns[self.tip_name]
        texts = column_cells(self.table.rows, column.place)
        there = [text for text in texts if re.search("[.,]", text)]
        factor = column.factor or 1.0
        if factor >= 1e6 or not there or not all(map(THOUSANDS.fullmatch, there)):
            return
        has_hundreds = any(re.fullmatch(r"\d{3}", text) for text in texts)
        most = max(float(text.replace(",", ".")) for text in there) * factor
        largest = float(np.nanmax(self.tip))
        if most < WEAK and (largest < WEAK or has_hundreds):
            row, text = self.table.rows[texts.index(there[0])][0], there[0]
            raise InputError(
                f"row {row}: the cone resistance {text!r} seems to have a separator of"
                f" thousands, with which the largest one is {largest / 1e3:g} kPa:"
                f" write {re.sub('[.,]', '', text)}; if decimals are meant, write the"
                f" column in MPa. The unit is that in {self.table.units_are}"
            )

    def make_depths(self) -> None:
        """Take depths that are negative by their amount, and of a corrected depth and a
        length the first if they agree; leave out rows without a depth or q_c."""
        self.depth, self.rods = self.downward(self.depth), self.downward(self.rods)
        self.depth = self.corrected()
        empty = np.isnan(self.depth) | np.isnan(self.tip)
        self.leave_out(empty, "rows without a depth or a cone resistance")
        self.refuse(
            self.depth > DEEPEST,
            lambda i: f"a depth of {self.depth[i]:g} m is no length in meters of a cone"
            " test",
        )
        if np.mean(self.depth < 0) < FEW:
            self.leave_out(self.depth < 0, "rows above the ground")
        self.refuse(
            self.depth < 0,
            lambda i: f"a depth of {self.depth[i]:g} m; depths must all be positive"
            " downward from the mudline, or all negative",
        )

    def corrected(self) -> np.ndarray:
        """Return depths [n]: those that are corrected, or the length of the rods where
        most do not agree with it; where there is none, it follows from the length."""
        depth, rods = self.depth, self.rods
        both, short = np.isfinite(depth + rods), np.isnan(depth) & np.isfinite(rods)
        if not both.any():
            return depth
        shift = (depth - rods)[both]
        if np.mean(np.abs(shift) > DISAGREE + 0.1 * np.abs(rods[both])) > 0.5:
            self.remarks.append(
                f"the column {self.columns['depth'].text!r} is no depth of this"
                " test; the penetration length is taken"
            )
            return rods
        if short.any():
            self.say(
                short,
                "rows without a corrected depth, which follows from the penetration"
                " length",
            )
            order = np.argsort(rods[both])
            shift = np.interp(rods, rods[both][order], shift[order])
            depth = np.where(short, rods + shift, depth)
        return depth

    def downward(self, depth: np.ndarray) -> np.ndarray:
        """Return depths [n] by their amount if all are negative and fall."""
        known = depth[np.isfinite(depth)]
        if len(known) < 2 or (known > 0).any() or np.median(np.diff(known)) >= 0:
            return depth
        self.remarks.append("depths are negative downward: taken by their amount")
        return -depth

    def turn_round(self) -> None:
        """Begin at the top where the deepest row comes first."""
        steps = np.diff(self.depth)
        is_other = self.table.is_register or self.table.pushes or len(steps) < 2
        if not is_other and (steps <= 0).all() and steps.any():
            self.remarks.append("the deepest row comes first: turned round")
            self.keep(np.arange(len(self.row))[::-1])

    def make_friction(self) -> None:
        """Take the sleeve friction from the friction ratio where there is none."""
        rows = np.isnan(self.friction) & np.isfinite(self.ratio)
        if rows.any():
            found = self.ratio * np.maximum(self.tip, 0.0)
            self.friction = np.where(rows, found, self.friction)
            text = f"{self.columns['rf'].text!r}, f_s = R_f q_c / 100"
            self.remarks.append(f"sleeve friction: from {text}, in {rows.sum()} rows")

    def join_pushes(self) -> None:
        """Put the pushes of a borehole below each other, without the rows in which the
        cone takes load; rows that have no order are sorted."""
        if self.table.is_register:
            self.keep(np.argsort(self.depth, kind="stable"))
        depth, push = self.depth, self.push
        every = [(depth[push == name], name) for name in np.unique(push)]
        ends = sorted((z.min(), z.max(), name) for z, name in every)
        if len(ends) < 2:
            return
        drop, end, before = np.zeros(len(depth), dtype=bool), -np.inf, ""
        for top, bottom, name in ends:
            if end - top >= min(START, 0.5 * (bottom - top)):
                raise InputError(
                    f"the pushes {before} and {name} overlap from {top:g} to"
                    f" {min(end, bottom):g} m: choose one by --location, as in"
                    f" --location {str(name)!r}"
                )
            drop |= (push == name) & (depth <= end)
            if top > START or before:
                loaded = top + min(LOAD, (bottom - top) / 2)
                drop |= (push == name) & (depth < loaded)
            end, before = max(end, bottom), name
        self.remarks.append(f"{len(ends)} pushes were joined")
        self.leave_out(
            drop,
            "rows of a push that the one above it has reached, or in which the cone"
            f" takes load, its first {LOAD:g} m",
        )
        place = {name: i for i, (*_, name) in enumerate(ends)}
        self.keep(np.argsort([place[name] for name in self.push], kind="stable"))

    def leave_out_hole(self) -> None:
        """Leave out rows above the depth of a hole, which are no soil."""
        hole = self.table.facts.predrilled or 0.0
        if hole and hole >= self.depth.max():
            raise InputError(
                f"the file says that the hole above the test is {hole:g} m deep, and"
                f" the last row is at {self.depth.max():g} m: correct one of the two"
            )
        above = self.depth < hole - EDGE
        self.leave_out(above, f"rows above the pre-excavated depth of {hole:g} m")

    def leave_out_values(self) -> None:
        """Leave out the sleeve frictions and pore pressures that cannot be meant where
        they are few, as at the end where the rods are pulled; not their rows."""
        moved = np.zeros(len(self.row), dtype=bool)
        for key, name in (("fs", "friction"), ("u2", "pressure")):
            values, (low, high) = getattr(self, name), RANGES[key]
            wrong = beyond = (values < low) | (values > high)
            if key == "fs":  # in soil, which the cone resistance shows
                wrong = beyond | (values > self.tip) & (self.tip > WEAK)
            if not 0 < wrong.sum() <= FEW * len(wrong):
                continue
            if key == "fs" and "u2" in self.columns:
                # as where the cells of a row stand one column beside their heads
                moved = beyond
            has_moved = key == "fs" and moved.any()
            some = values[wrong] / 1e3
            self.say(
                wrong,
                f"values of the {QUANTITIES[key].name} from {some.min():g} to"
                f" {some.max():g} kPa, which cannot be meant, left out",
                "; the pore pressure of these rows, too" if has_moved else "",
            )
            setattr(self, name, np.where(wrong, np.nan, values))
            self.pressure = np.where(moved, np.nan, self.pressure)

    def leave_out_no_load(self) -> None:
        """Leave out the rows in which the cone met no soil: a resistance of less than 0
        or the sleeve friction; at the start of a test, or few. In soft soil, too, the
        resistance is about 0: there they count, and less than 0 is 0."""
        tip, depth, friction = self.tip, self.depth, self.friction
        is_rubbed = friction > np.maximum(tip, 0)
        empty = (tip >= RANGES["qc"][0]) & ((tip < 0) | is_rubbed)
        first = int(np.argmin(empty)) if not empty.all() else len(tip)
        soft = np.zeros(len(tip), dtype=bool)
        for i in np.flatnonzero(empty & (first < len(tip))):
            place = depth[max(i, first)] + (2 * NEAR if i < first else 0)
            near = np.abs(depth - place) <= NEAR
            near[max(i - 2, 0) : i + 3] = True  # where rows are far from each other
            soft[i] = np.median(tip[near]) < SOFT
        if 0 < soft.sum() <= len(tip) / 2:
            some = depth[soft]
            self.say(
                soft,
                f"rows of soft soil with a q_c of about 0, from {some[0]:g} to"
                f" {some[-1]:g} m, are kept, q_c below 0 as 0",
                "; check the zero of the test",
            )
            self.tip = tip = np.where(soft, np.maximum(tip, 0.0), tip)
            empty &= ~soft
        few = empty[first:].sum() <= FEW * len(tip)
        if few and first < len(tip) / 2:
            self.leave_out(empty, "rows without load (q_c below 0 or below f_s)")
            return
        self.refuse(
            empty & (friction > np.maximum(tip, 0)),
            lambda i: f"the sleeve friction of {friction[i] / 1e3:g} kPa is more than"
            f" the cone resistance of {tip[i] / 1e3:g} kPa; check both units in"
            f" {self.table.units_are}",
        )
        self.refuse(
            empty,
            lambda i: f"the cone resistance of {tip[i] / 1e6:g} MPa is below 0, as in"
            " other rows: too many to be left out; check the zero of the test",
        )

    def check_order(self) -> None:
        """Leave out rows that repeat the depth of the row before, and few that go
        back, and refuse others."""
        depth = self.depth
        above = np.concatenate([[-1.0], np.maximum.accumulate(depth)[:-1]])
        back = depth < above
        few = back.sum() <= REPEATED * (depth != above).sum()
        self.refuse(
            back & ~(few and (depth >= above - BACK).all()),
            lambda i: f"the depth of {depth[i]:g} m is not below that of the row"
            f" before, {above[i]:g} m; leave out the row that is wrong, or divide"
            " a file of two tests",
        )
        self.leave_out(depth <= above, "rows that repeat the depth of a row before")

    def check_ranges(self) -> None:
        """Refuse stresses that cannot be meant."""
        if not np.median(self.tip) > 0:
            raise InputError(
                "the cone resistance is 0 in most rows; check which column it is, and"
                f" the unit in {self.table.units_are}"
            )
        for key, values in (
            (self.tip_name, self.tip),
            ("fs", self.friction),
            ("u2", self.pressure),
        ):
            low, high = RANGES[key]
            self.refuse(
                (values < low) | (values > high),
                lambda i: f"the {QUANTITIES[key].name} is {values[i] / 1e6:g} MPa,"
                f" which is not between {low / 1e6:g} and {high / 1e6:g} MPa;"
                f" {self.check_unit}",
            )

    def complete_friction(self) -> None:
        """Take a drift below 0 as 0, and where there is none the share of q_c of the
        rows next to it; refuse a friction in another unit than its column says."""
        if not self.has_values("fs", "friction"):
            return
        depth, friction, tip = self.depth, self.friction, np.maximum(self.tip, 1.0)
        known = np.isfinite(friction)
        ratio = float(np.median(friction[known] / tip[known]))
        if ratio < SMOOTHEST:
            raise InputError(
                f"the sleeve friction is {100 * ratio:.2g} % of the cone resistance in"
                " the median, less than in any soil; check its unit, or leave the"
                " column out and give --soil and --unit-weight"
            )
        drift = friction < 0
        if drift.any():
            self.say(
                drift,
                "rows of a sleeve friction below 0, down to"
                f" {friction[drift].min() / 1e3:g} kPa, taken as 0",
            )
        if not known.all():
            self.remarks.append(
                "ASSUMED: rows without a sleeve friction have that share of q_c which"
                f" the rows next to them have: {(~known).sum()}, from"
                f" {depth[~known][0]:g} to {depth[~known][-1]:g} m"
            )
        share = np.interp(depth, depth[known], (friction / tip)[known])
        self.friction = np.maximum(np.where(known, friction, share * tip), 0.0)

    def has_values(self, key: str, name: str) -> bool:
        """Return whether an array has values in enough rows to tell of the others; one
        that has not becomes nan, which is said."""
        number, rows = int(np.isfinite(getattr(self, name)).sum()), len(self.row)
        if number >= ENOUGH * rows:
            return True
        if number or key in self.columns:
            some = f"values in only {number} of {rows} rows" if number else "no values"
            self.remarks.append(f"the column of {QUANTITIES[key].name} has {some}")
        setattr(self, name, np.full(rows, np.nan))
        return False

    def complete_pressure(self) -> None:
        """Take the pore pressure as hydrostatic where there is none."""
        if not self.has_values("u2", "pressure"):
            return
        depth, pressure = self.depth, self.pressure
        missing = np.isnan(pressure)
        self.pressure = np.where(missing, WATER * depth, pressure)
        ratio = np.abs(pressure[~missing]) / (WATER * np.maximum(depth[~missing], 0.1))
        if np.median(ratio) < DRY:
            self.remarks.append(
                f"the pore pressure is {100 * np.median(ratio):.1g} % of water at rest"
                f" in the median; {self.check_unit}"
            )
        if missing.any():
            self.remarks.append(
                "rows without a pore pressure, which is taken as hydrostatic there:"
                f" {missing.sum()}, the first at {depth[missing][0]:g} m"
            )
        if (pressure < 0).any():
            self.remarks.append(
                f"rows of a pore pressure below 0, which dense soil has: kept,"
                f" {(pressure < 0).sum()}, down to {np.nanmin(pressure) / 1e3:g} kPa"
            )

    def zero_at_mudline(self, given: float | None, ratio: float | None) -> bool:
        """Let readings that were set to 0 on deck begin at the mudline: without the
        pressure u_0 of the water there, of u_2, and without a u_0, of q_c. Return
        whether they were. given: the depth of the water (m), None if it is not known;
        ratio: the net area ratio a."""
        ratio = ratio if ratio and 0 < ratio <= 1 else AREA_RATIO
        ratio = 1.0 if self.tip_name == "qt" else ratio
        water = WATER * given if given is not None else self.water_at_mudline(ratio)
        if not water:
            return False
        tip, text = self.tip - ratio * water, ""
        if given is not None or np.mean(tip < -DRIFT) < FEW:
            self.tip = np.maximum(tip, 0.0)
            text = f" and {ratio * water / 1e3:.0f} kPa from q_c"
        self.pressure = self.pressure - water
        text = f"{water / 1e3:.0f} kPa is subtracted from u_2{text}"
        if given is None:
            text = (
                f"some {water / WATER:.0f} m of water, as u_2 is so far above water at"
                f" rest from the mudline on: {text}; --zeroed-on-deck 20m gives the"
                " depth of the water, and 0 takes the file as it is"
            )
        how = ASSUMED if given is None else GIVEN
        self.remarks.insert(0, f"{how}: readings were set to 0 on deck; {text}")
        return True

    def water_at_mudline(self, ratio: float) -> float:
        """Return the pressure of water (Pa) that u_2 has at the mudline, 0 where it has
        none. The excess of u_2 is u_0 and B_q times the net resistance, so that a line
        through the rows below the mudline has both."""
        depth, pressure = self.depth, self.pressure
        known = np.isfinite(pressure)
        if depth[0] > START or known.sum() < ENOUGH * len(known):
            return 0.0
        tip = self.tip - WEIGHT * depth
        tip = tip + (self.tip_name == "qc") * (1 - ratio) * pressure
        depth, tip = depth[known], tip[known]
        excess = pressure[known] - WATER * depth
        first = excess[depth <= START + FIRST]
        if not len(first) or min(np.median(first), np.median(excess)) < OFFSET:
            return 0.0
        near = depth <= 4 * START
        x, y = np.maximum(tip[near], 1.0), excess[near]
        friction = self.friction[known][near]
        friction = np.where(np.isnan(friction), np.inf, friction)
        is_sand = float(np.median(friction / np.maximum(x - y, 1.0))) < SMOOTH
        if np.median(y / x) < MOST_PRESSURE and not is_sand:
            self.remarks.insert(
                0,
                f"{ASSUMED}: u_2, {np.median(first) / 1e3:.0f} kPa above water at rest"
                " at the mudline, is that of clay; if readings were set to 0 on deck,"
                " give the depth of the water, as --zeroed-on-deck 20m",
            )
            return 0.0
        share = 0.0 if is_sand else USUAL_PRESSURE
        if not is_sand:  # by medians, as single readings scatter
            near = depth <= 10 * START
            place = np.floor(depth[near] / NEAR)
            x, y = (
                np.array([np.median(v[near][place == i]) for i in np.unique(place)])
                for v in (tip, excess)
            )
            if np.ptp(x) > OFFSET:
                from scipy.stats import theilslopes  # takes half a second

                slope = theilslopes(y, x)[0]
                share = min(max(float(slope), 0.0), MOST_PRESSURE)
        found = float(np.median(y - share * x)) / (1 - share)
        return min(max(found, 0.0), float(y.min()))

    def gaps(self) -> tuple[tuple[float, float], ...]:
        """Return top and bottom (m) of what was not measured between the rows."""
        found = gaps_in(self.depth)
        if found:
            where = ", ".join(f"{a:g} to {b:g} m" for a, b in found)
            self.remarks.append(
                f"{ASSUMED}: nothing was measured from {where}; the soil above and that"
                " below it meet in the middle, or are one layer"
            )
        return found

    def reach_up(self, given: Mapping[str, float]) -> tuple[float, str]:
        """Add rows from the mudline down to the first one where that is deep. given:
        stresses (Pa) of the soil above. Return the depth of the first row that was
        measured, and how the rows above it are known; 0 and "" if none is added."""
        start = float(self.depth[0])
        if given and start < WIDEST_STEP:
            raise InputError(
                "--above is for a test that begins below the mudline; this one begins"
                f" at {start:g} m"
            )
        if start <= START and not given:
            return 0.0, ""
        first = self.depth <= start + FIRST
        tip = given.get("qc", float(np.median(self.tip[first])))
        spacing = max(float(np.median(np.diff(self.depth))), 0.02)
        depth = np.arange(0.0, start - spacing / 2, spacing)
        share = float(np.median((self.friction / np.maximum(self.tip, 1.0))[first]))
        friction = given.get("fs", share * tip) if np.isfinite(share) else np.nan
        pressure = depth * (WATER if np.isfinite(self.pressure).all() else np.nan)
        self.depth = np.append(depth, self.depth)
        self.tip = np.append(np.full_like(depth, tip), self.tip)
        self.friction = np.append(np.full_like(depth, friction), self.friction)
        self.pressure = np.append(pressure, self.pressure)
        how, soil, way = GIVEN, "by --above", ""
        if not given:
            how, soil = ASSUMED, "as the first readings below it"
            way = '; --above "qc = 2 MPa, fs = 20 kPa" gives another'
        hole = self.table.facts.predrilled
        why = f", pre-excavated to {hole:g} m" if hole else ""
        self.remarks.append(
            f"{how}: the soil above {start:g} m, where nothing was measured{why}, has a"
            f" q_c of {tip / 1e6:.3g} MPa {soil}{way}"
        )
        return start, how

    def say_rest(self) -> None:
        """Refuse a test that is too weak for any soil, and say what is doubtful and
        what was not read."""
        largest = float(self.tip.max())
        if largest < WEAKEST:
            raise InputError(
                f"the largest cone resistance is {largest:g} Pa, less than any soil"
                f" has; {self.check_unit}"
            )
        if largest < WEAK:
            self.remarks.append(
                f"the largest cone resistance is only {largest / 1e3:g} kPa:"
                f" {self.check_unit}"
            )
        if self.tip_name == "qt":
            self.remarks.append("the file has q_t and no q_c: it is taken for both")
        if self.table.facts.water is not None:
            self.remarks.append(
                f"the water level of the file, {self.table.facts.water:g} m, is not"
                " used: the ground is below water"
            )
        places = {head.place for head in self.columns.values()}
        unread = ", ".join(
            head.text
            for head in self.table.heads
            if head.text and head.place not in places
            if not head.quantity or head.quantity in self.wanted
        )
        if unread and not self.table.is_register:
            self.remarks.append(f"columns that were not read: {unread}")
