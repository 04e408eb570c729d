# SPDX-License-Identifier: LGPL-2.1-or-later
"""What runs expect of an installation: the resistance of the soil over depth, low, best
and high, and the suction that is allowed.

Low and high are those of the runs of a band. Where there is none they are the error bar
of the run or the range of the design methods, whichever is wider, as shares of the best
estimate. The resistance is what the caisson has to overcome, weight in water and
suction on the lid together, with what seepage takes from it.
"""
from dataclasses import dataclass

import numpy as np

from caisson import band, curves, evaluation
from caisson.band import BEST, ESTIMATES, HIGH, LOW
from caisson.verdict import suction_methods, theory
from caisson.verdict.installation import Installation, Rate, installation_of
from caisson.verdict.installation import plug_area
from caisson.results import Results, ResultsError

ROWS = 200  # of the grid
# half width of the logarithm of a band: no run is better, and of one without runs of
# other soil
LEAST, LEAST_ASSUMED = 0.08, 0.182  # 8 and 20 %
NO_BAND = "no run of low and high resistance is there"


@dataclass
class Expected:
    """Columns [n] at depths [n] (m): resistances (kN), and the allowable suction (kPa)
    with what governs it; the weight in water (kN), the area inside (m2), what low and
    high are, the depth where the scene ends (m), and where low, best and high are
    extrapolated, as no run has been there."""

    run: Results
    depth: np.ndarray
    low: np.ndarray
    best: np.ndarray
    high: np.ndarray
    allowable: np.ndarray
    governing: list[str]
    weight: float
    area: float
    source: str
    planned: float
    extrapolated: dict[str, np.ndarray]

    @property
    def title(self) -> str:
        """The title of the scene, or the name of the directory."""
        return str(self.run.summary.get("title") or self.run.directory.resolve().name)

    def known_to(self, name: str) -> float:
        """Return the depth (m) below which low, best or high is extrapolated; the last
        one where it is not."""
        known = self.depth[~self.extrapolated[name]]
        return float(known[-1] if len(known) else self.depth[0])

    def extrapolated_at(self, depth: float) -> str:
        """Return which of low, best and high are extrapolated at a depth (m)."""
        return " ".join(x for x in ESTIMATES if depth > self.known_to(x) + curves.EDGE)

    def extrapolations(self, upto: float = np.inf) -> list[tuple[str, float]]:
        """Return which of low, best and high are extrapolated above a depth (m), and
        from where on (m)."""
        known, end = {x: self.known_to(x) for x in ESTIMATES}, float(self.depth[-1])
        return [pair for pair in known.items() if pair[1] < min(upto, end)]

    def suction(
        self, resistance: np.ndarray, weight: float | None = None
    ) -> np.ndarray:
        """Return the suction (kPa) that resistances (kN) take under a weight (kN), that
        of the scene without one."""
        carried = self.weight if weight is None else weight
        return np.maximum((resistance - carried) / self.area, 0.0)

    @property
    def suctions(self) -> dict[str, np.ndarray]:
        """The suction [n] (kPa) that low, best and high resistance take."""
        return {name: self.suction(getattr(self, name)) for name in ESTIMATES}

    def halves(self, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return how far low and high are from best in logarithms, at depths [m]."""
        down, up = np.log(self.best / self.low), np.log(self.high / self.best)
        found = [np.interp(at, self.depth, x).clip(LEAST) for x in (down, up)]
        return found[0], found[1]

    def share(self, at: np.ndarray, resistance: np.ndarray) -> np.ndarray:
        """Return where resistances [m] (kN) at depths [m] (m) are in the band: -1 at
        low, 0 at best, 1 at high, in equal ratios between them and beyond."""
        ratio = np.log(resistance / np.interp(at, self.depth, self.best))
        down, up = self.halves(at)
        return np.where(ratio < 0, ratio / down, ratio / up)

    def resistance(self, at: np.ndarray, share: np.ndarray) -> np.ndarray:
        """Return the resistances (kN) at depths [m] (m) of shares [..., m]."""
        down, up = self.halves(at)
        ratio = np.where(share < 0, share * down, share * up)
        return np.interp(at, self.depth, self.best) * np.exp(ratio)


def resistance_of(run: Results, at: np.ndarray) -> np.ndarray:
    """Return the resistance (kN) of a run at depths [n] (m), nan where it has not
    been. Raises ResultsError."""
    weight, scene = run.scene.get("submerged_weight_N"), run.scene
    numbers = evaluation.at_depths(run, at)
    if evaluation.SUCTION not in numbers or not weight:
        raise ResultsError(
            f"{run.directory} is no installation by suction: give the results of a"
            " scene with a weight, as `caisson suggest --weight` writes"
        )
    found = float(weight) + plug_area(scene) * numbers[evaluation.SUCTION]
    way = run.history[evaluation.DEPTH]
    inside = (at >= way.min() - curves.EDGE) & (at <= way.max() + curves.EDGE)
    return np.where(inside & (found > 0), found, np.nan) / 1e3


def continued(values: np.ndarray, best: np.ndarray) -> np.ndarray:
    """Return a resistance [n] with the ratio to the best one of its ends where it is
    nan; the best one where it has none."""
    known = np.flatnonzero(np.isfinite(values) & np.isfinite(best))
    if not len(known):
        return best
    ratio = np.interp(np.arange(len(best)), known, (values / best)[known])
    return best * ratio


def by_methods(run: Results, at: np.ndarray, best: np.ndarray) -> list[np.ndarray]:
    """Return low and high (kN) by the range of the first design method that has one,
    about the best one; none without."""
    answers = suction_methods.answers_of(theory.site_of(run), at)
    weight, area = float(run.scene["submerged_weight_N"]), plug_area(run.scene)
    for method in answers.required:
        low, high = ((weight + area * end) / 1e3 for end in method.band)
        half = np.log(high / low) / 2
        if np.isfinite(half).any() and np.nanmax(half) > 0:
            return [best * np.exp(-half), best * np.exp(half)]
    return []


def band_about(
    run: Results, found: Installation, best: np.ndarray
) -> tuple[list[np.ndarray], str]:
    """Return low and high (kN) about the best estimate where no run has them, and what
    they are."""
    area, bars = plug_area(run.scene), found.required_bounds
    sides = (bars.low, bars.high) if bars else ()
    some = {
        "the error bar of the run": [best + area * (x - found.required) for x in sides],
        "the range of the design methods about the run": by_methods(
            run, found.depth, best
        ),
    }
    widths = {
        name: float(np.nanmean(np.log(ends[1] / ends[0])))
        for name, ends in some.items()
        if ends and np.isfinite(ends[0]).any()
    }
    widest = max(widths, key=lambda name: widths[name], default="")
    low, high = some[widest] if widest else (best, best)
    least = np.exp(LEAST_ASSUMED)
    ends = [np.fmin(low, best / least), np.fmax(high, best * least)]
    assumed = f"at least {100 * (least - 1):.0f} % to either side (ASSUMED)"
    why = " and ".join(band.left_out(run).values()) or NO_BAND
    return ends, f"{', '.join(filter(None, (widest, assumed)))}, as {why}"


def expected_of(run: Results) -> Expected:
    """Return what a best estimate and the runs of its band expect. Raises
    ResultsError."""
    runs = band.band_of(run)
    ways = {name: one.history[evaluation.DEPTH] for name, one in runs.items()}
    begin = max(float(way.min()) for way in ways.values())
    end = max(float(way.max()) for way in ways.values())
    if not end > begin:
        raise ResultsError(f"{run.directory}: the caisson does not go down")
    at = np.linspace(begin, end, ROWS)[1:]
    found = {name: resistance_of(one, at) for name, one in runs.items()}
    best = found[BEST]
    longest = max(found.values(), key=lambda x: int(np.isfinite(x).sum()))
    best = continued(best, longest)
    limits = installation_of(run, Rate(), at)
    assert limits is not None  # it has a required suction
    if LOW in found and HIGH in found:
        ends = [found[LOW], found[HIGH]]
        source = "the runs of low and high resistance"
    else:
        ends, source = band_about(run, limits, best)
    extrapolated = {
        name: ~np.isfinite(line)
        for name, line in zip(ESTIMATES, (ends[0], found[BEST], ends[1]))
    }
    low, high = (continued(side, best) for side in ends)
    return Expected(
        run,
        at,
        np.minimum(low, best),
        best,
        np.maximum(high, best),
        limits.allowable,
        [limits.governing_in_words(i) for i in range(len(at))],
        float(run.scene["submerged_weight_N"]) / 1e3,
        plug_area(run.scene),
        source,
        run.planned or end,
        extrapolated,
    )
