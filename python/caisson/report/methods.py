# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report says of the design methods: their numbers beside those of the run,
computed over method, and why the run is where it is."""
import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from caisson import curves
from caisson.evaluation import depths_of
from caisson.verdict import by_hand, design, suction_methods, theory
from caisson.plot.charts import CRITICAL
from caisson.results import Results
from caisson.design import reasons, suction_installation as installation
from caisson.design.houlsby_byrne import STILL, UNDISTURBED
from caisson.design.method import Forces
from caisson.table import by_rows, shown_text, text_of
from caisson.template import say
from caisson.shown import SMALLER, USUAL, Units
from caisson.report import relief
from caisson.report.content import SENTENCES
from caisson.verdict.installation import Installation, Rate, installation_of
from caisson.verdict.installation import needs_suction, plug_area

OVER = "Computed / method"
# the lower case of a method: the upper one
LOWER = {"low": "high", "most probable": "highest"}
UNDISTURBED_IS = (
    f"{UNDISTURBED}: K0 tan \N{GREEK SMALL LETTER DELTA} without stress enhancement, a"
    " lower bound"
)
# the critical suctions that a table has
SHOWN_LIMITS = (suction_methods.PIPING, suction_methods.CRITICAL_SENDERS_RANDOLPH)
NOT_IN_MEAN = " *"
OVERVIEW = (
    *("method", "rests at (m)", "resistance (kN)"),
    *("(R - W) / A, no flow (kPa)", "required suction (kPa)"),
)
AT_DEPTH = 0.05  # m, between a depth and the frame that is taken for it
NO_ANSWER = "none (piping)"
NOTHING: dict[str, Any] = {"tables": [], "why": [], "reasons": [], "notes": []}


def table(title: str, columns: dict[str, Any], shown: Units = USUAL) -> dict[str, Any]:
    """Return title, heads and rows of columns of numbers or words [n], in the units
    shown. The title has the unit of columns that name none."""

    def factor(head: str) -> float:
        has_unit = any(f"({unit})" in head for unit in SMALLER)
        return shown.factor_of(head if has_unit else title)

    texts = {shown.named(h): shown_texts(x, factor(h)) for h, x in columns.items()}
    return {"title": shown.named(title), **by_rows(texts)}


def shown_texts(values: Iterable[Any], factor: float) -> list[str]:
    """Return words as they are, and numbers times a factor."""
    return [x if isinstance(x, str) else text_of(factor * float(x)) for x in values]


def columns_of(method: theory.Beside, what: str, factor: float) -> dict[str, list[str]]:
    """Return the cases of a method (N or Pa) as text, its lower and its upper one as a
    range. what: before the name; factor: of what is shown in kN or kPa."""

    def plain(values: np.ndarray) -> list[str]:
        return shown_texts(values, 1.0)

    texts = {
        case: (or_piping if method.may_end else plain)(factor * x / 1e3)
        for case, x in (method.cases | method.bounds).items()
    }
    low, high = method.cases
    if LOWER.get(low) == high:
        pairs = zip(texts.pop(low), texts.pop(high))
        both = [" to ".join(dict.fromkeys(filter(None, pair))) for pair in pairs]
        texts = {f"{low} to {high}": both} | texts
    return {f"{what}{method.name}, {case}": column for case, column in texts.items()}


def beside(
    title: str,
    columns: dict[str, Any],
    computed: np.ndarray | None,
    methods: list[theory.Beside],
    shown: Units,
    what: str = "",
    last: dict[str, Any] = {},
) -> list[dict[str, Any]]:
    """Return a table of what a run has (N or Pa), if it has this, and methods say
    behind other columns, the first of which is the depth, and last ones; and one of
    their ratios. what: before the names of methods."""
    depth, over = dict(list(columns.items())[:1]), dict[str, list[str]]()
    if computed is not None:
        columns["computed"] = computed / 1e3
    for method in methods:
        columns |= columns_of(method, what, shown.factor_of(title))
        ends = {method.name: tuple(method.cases.values())}
        ends |= {bound: (x, x) for bound, x in method.bounds.items()}
        if computed is None:
            continue
        for name, pair in ends.items():
            rows = zip(computed, *pair)
            over[name] = [reasons.ratio_in_words(*map(float, row)) for row in rows]
    found = [table(title, columns | last, shown)]
    if over:
        words = f"{OVER}: {title[0].lower()}{title[1:]}"
        found.append(table(words, depth | over, shown))
    return found


def under_suction(
    run: Results, at: np.ndarray, site: theory.Site, answers: list[theory.Answer]
) -> list[theory.Beside]:
    """Return the resistance that methods for suction have at depths [n] under the
    suction of the run; answers: of jacking."""
    suction = np.maximum(design.suction_at(run.history, at), 0)
    try:
        byrne = theory.houlsby_byrne_of(site, float(at.max()))
    except theory.NotApplicable:
        return []
    caisson = byrne.by_name[UNDISTURBED]
    pairs = list(zip(map(float, suction), map(float, at)))
    flows = [
        installation.seepage(caisson, s, h, byrne.permeability_ratio) for s, h in pairs
    ]

    def of_byrne(case: str) -> np.ndarray:
        both = zip(flows, at)
        return np.array([byrne.forces(float(h), case, f).total for f, h in both])

    cases = {case: of_byrne(case) for case in byrne.cases}
    found = [theory.Beside(suction_methods.HOULSBY_BYRNE, cases)]
    critical = [installation.critical_suction(caisson, h) for _, h in pairs]
    left = np.clip(1 - suction / critical, 0.0, 1.0)
    for answer in answers:
        if answer.method in suction_methods.BY_CONE and answer.forces:
            cases = {}
            for case in answer.method.cases:
                tip, inner, outer, _ = answer.forces[case].values()
                cases[case] = left * (tip + inner) + outer
            found.append(theory.Beside(answer.name, cases))
    return found


def or_piping(values: np.ndarray) -> list[str]:
    """Return suctions as text; NO_ANSWER below the depth where a method ends, as the
    suction exceeds its critical one."""
    known = np.flatnonzero(np.isfinite(values))
    last = int(known[-1]) if len(known) else -1
    return [text_of(float(v)) if i <= last else NO_ANSWER for i, v in enumerate(values)]


def suction_tables(
    run: Results, at: np.ndarray, site: theory.Site, answers: list[theory.Answer]
) -> list[dict[str, Any]]:
    """Return the tables of required and critical suctions, and of the resistance under
    the suction of the run; answers: of jacking."""
    required = np.maximum(design.suction_at(run.history, at), 0)
    found = suction_methods.answers_of(site, at)
    critical = {
        f"critical, {CRITICAL[column][0]}": found.suctions[column] / 1e3
        for column in SHOWN_LIMITS
        if found.suctions
    }
    title, columns = "Required and critical suction (kPa)", {"depth (m)": at}
    mine = None if run.by_hand else required
    suctions = beside(
        title, columns, mine, found.required, run.shown, "required, ", critical
    )
    if not (methods := [] if run.by_hand else under_suction(run, at, site, answers)):
        return suctions
    resistance = beside(
        "Resistance under the suction of the run (kN)",
        {"depth (m)": at, "suction (kPa)": required / 1e3},
        design.compared_at(run.history, at)[design.FORCES[-1]],
        methods,
        run.shown,
    )
    return suctions + resistance


# ------------------------------------------------------------------ why


def computed_at(run: Results, h: float) -> Forces | None:
    """Return the forces of a run at a depth, None where it lacks one."""
    known = design.compared_at(run.history, np.array([h]))
    if set(known) != set(design.FORCES):
        return None
    return Forces(*(float(known[name][0]) for name in design.FORCES[:3]))


def of_byrne(run: Results, h: float) -> str:
    """Return a sentence on where the run is beside Houlsby & Byrne at a depth, and why;
    nothing where the method has no answer there or the run lacks a force."""
    site, at = theory.site_of(run), np.array([h])
    try:
        byrne = theory.houlsby_byrne_of(site, h)
    except theory.NotApplicable:
        return ""
    if (computed := computed_at(run, h)) is None:
        return ""
    suction, flow, mine, what = 0.0, STILL, computed.total, "force"
    ends = [byrne.forces(h, case).total for case in byrne.cases]
    caisson = byrne.by_name[UNDISTURBED]
    if needs_suction(run):
        suction = mine = float(design.suction_at(run.history, at)[0])
        found = suction_methods.answers_of(site, at).suctions
        ends = [float(found[name][0]) for name in suction_methods.RANGE if found]
        s, ratio = max(suction, 0.0), byrne.permeability_ratio
        flow, what = installation.seepage(caisson, s, h, ratio), "suction"
    if not ends or not reasons.ratio_in_words(mine, *ends):
        return ""
    low, high = (byrne.forces(h, case, flow) for case in byrne.cases)
    name, both = suction_methods.HOULSBY_BYRNE, (mine, ends[0], ends[1])
    beside = reasons.Compared(name, h, what, both, computed, low, high)
    frictions = computed.outer_friction, caisson.forces(h, flow).outer_friction
    k, k0 = (caisson.k_tan_delta_of(friction, h, flow) for friction in frictions)
    enhanced = byrne.by_name["low"].enhanced
    return reasons.of_houlsby_byrne(beside, suction, enhanced, (k, k0))


def why_of(run: Results, at: np.ndarray) -> str:
    """Return that sentence at the deepest of depths [n] (m) with an answer."""
    return next(filter(None, (of_byrne(run, float(h)) for h in at[::-1])), "")


def others_of(run: Results, h: float, answers: list[theory.Answer]) -> list[str]:
    """Return a sentence for each method that the run is not like, at a depth (m), of
    which answers have the forces of jacking."""
    at = np.array([h])
    if (computed := computed_at(run, h)) is None:
        return []
    mine, what, left, suctions = computed.total, "force", None, dict[str, Any]()
    if needs_suction(run):
        mine, what = float(design.suction_at(run.history, at)[0]), "suction"
        suctions = suction_methods.answers_of(theory.site_of(run), at).suctions
        if not suctions:
            return []
        left = 1 - mine / suctions[suction_methods.CRITICAL_SENDERS_RANDOLPH][0]
    found, sentences, causes = list[str](), list[str](), dict[str, None]()
    for answer in (x for x in answers if x.forces and not x.beside):
        parts = {c: by_case(answer, c) for c in answer.method.all_cases}
        low, high = (parts[case] for case in answer.method.cases)
        ends = mine, low.total, high.total
        for bound in answer.method.bound:
            force = parts[bound].total
            if suctions:
                force = float(suctions[suction_methods.LOWER_BOUND][0])
            found.append(reasons.of_undisturbed(h, mine, force, what))
        columns = suction_methods.CONE_COLUMNS.get(answer.method.key)
        if left is not None and columns:
            low, high = reasons.relieved(low, left), reasons.relieved(high, left)
            needed = [float(suctions[column][0]) for column in columns]
            ends = mine, needed[0], needed[1]
        elif answer.method.bound or left is not None or answer.method == theory.OF_CLAY:
            continue
        name = answer.name
        by_cone = reasons.Compared(name, h, what, ends, computed, low, high, left)
        if sentence := reasons.of_cone(by_cone):
            sentences.append(sentence)
            causes[reasons.of_cause(by_cone.cause, h, walls_of(run, h))] = None
    sentences += causes
    if any(sentences) and any(answer.assumed for answer in answers):
        sentences.append(reasons.say("assumed_cone"))
    return [sentence for sentence in [*found, *sentences] if sentence]


def walls_of(run: Results, h: float) -> reasons.Walls | None:
    """Return the stress on the walls at the frame at a depth; None without one."""
    table, scene = run.walls, run.scene
    rows = np.abs(table.get("penetration_m", np.empty(0)) - h) < AT_DEPTH
    layers = [x for x in scene["layers"] if theory.top_of(x) < h]
    angles = [float(x.get("friction_angle_deg") or 0) for x in layers]
    at_rest = [float(x.get("K0") or 0) for x in layers]
    if not {"inner_area_m2", "outer_area_m2"} <= set(table) or not rows.any():
        return None
    if "suction_Pa" in run.history and any(x.get("total_stress") for x in layers):
        return None  # the suction is in the stress on the inner wall
    rows &= table["time_s"] == table["time_s"][rows][-1]
    rows &= table["vertical_stress_at_rest_Pa"] > 0
    if not all(table[f"{side}_area_m2"][rows].sum() > 0 for side in ("inner", "outer")):
        return None  # no wall is in the ground yet
    means = []
    for side in ("inner", "outer"):
        area = table[f"{side}_area_m2"][rows]
        normal = table[f"{side}_normal_stress_Pa"][rows]
        below = table["vertical_stress_at_rest_Pa"][rows] @ area
        means.append(float(np.nansum(normal * area) / below))
    passive = [math.tan(math.radians(45 + angle / 2)) ** 2 for angle in angles]
    ends = [(min(values), max(values)) for values in (at_rest, passive)]
    return reasons.Walls(means[0], means[1], ends[0], ends[1])


def by_case(answer: theory.Answer, case: str) -> Forces:
    """Return the forces of an answer at the first of its depths."""
    return Forces(*(float(answer.forces[case][part][0]) for part in theory.PARTS[:3]))


# ------------------------------------------------------- one beside the other


def overview(run: Results, found: Installation, planned: float) -> dict[str, Any]:
    """Return heads and rows of what each method says of a caisson with a weight, from
    its lower to its upper case: where it rests, resistance and required suction at the
    planned depth (m), or where the run has ended above, and below them the run. Empty
    without a method, or where no suction is computed."""
    if not (weight := run.weight) or not (found.has_suction or run.by_hand):
        return {}
    shown, site, area = run.shown, theory.site_of(run), 1e3 * plug_area(run.scene)
    depth = planned if run.by_hand else min(planned, float(found.depth[-1]))
    at = np.array([depth])
    counted = [answer.method for answer in by_hand.answers_of(site, at)]
    needs = {x.name: x.cases for x in suction_methods.answers_of(site, at).every}

    def pair(values: Iterable[Any], unit: str, none: str) -> str:
        texts = [shown_text(x, shown.factor(unit)) or none for x in values]
        return " to ".join(dict.fromkeys(texts)) or "-"

    def cells(
        name: str, rests: Iterable[Any], forces: Sequence[Any], needs: Iterable[Any]
    ) -> list[str]:
        plain = [max(float(x) - weight, 0.0) / area for x in forces]
        rests = [0.0 if float(x) < 1e-3 * depth else x for x in rests]
        is_known = bool(np.isfinite(plain).all())
        return [
            name,
            pair(rests, "m", f"below {shown.place(depth)}"),
            pair([x / 1e3 for x in forces], "kN", ""),
            pair(plain, "kPa", ""),
            pair([x / 1e3 for x in needs], "kPa", NO_ANSWER if is_known else ""),
        ]

    rows = list[list[str]]()
    for answer in theory.answers_of(site, at):
        if not answer.forces:
            continue
        name = answer.name + answer.method.remark
        mark = "" if not run.by_hand or answer.method in counted else NOT_IN_MEAN
        rests = suction_methods.rests_of(answer.method, site, depth).values()
        cases = needs.get(answer.name, {}).values()
        if answer.beside:
            cases = suction_methods.needed_by(site, answer).values()
        rows.append(cells(name + mark, [*rests][::-1], answer.band("total"), cases))
    if not rows or (here := installation_of(run, Rate(), at)) is None:
        return {}
    rest = [] if found.rest is None else [found.rest]
    own = [here.forces[design.FORCES[-1]] * 1e3] if run.by_hand else []
    name = "best: the mean" if run.by_hand else "computed"
    rows.append(cells(name, rest, own, here.required * 1e3))
    heads = map(shown.named, OVERVIEW)
    note = say(SENTENCES, "overview", bool(run.by_hand), bool(run.ledges))
    return {"heads": [*heads], "rows": rows, "note": note, "place": shown.place(depth)}


# ------------------------------------------------------------------ all


def card_of(found: dict[str, Any]) -> list[list[str]]:
    """Return a card with computed over method, of the first two tables of them, at
    the deepest depth with an answer of a method that is fitted to field data, without
    an assumed cone if possible, else of the lower bound; nothing where none has an
    answer."""
    answers = [
        (f"{row[0]} {table['heads'][0][7:-1]}", name, cell)
        for table in found["tables"][1:2]
        if table["title"].startswith(OVER)
        for row in reversed(table["rows"])
        for name, cell in zip(table["heads"][1:], row[1:])
        if cell
    ]
    fitted = [answer for answer in answers if answer[1] != UNDISTURBED]
    measured = [answer for answer in fitted if theory.ASSUMED_CONE not in answer[1]]
    for depth, name, value in (measured or fitted or answers)[:1]:
        return [["Computed / method", value, f"of {name} at {depth}"]]
    return []


def methods_of(run: Results, end: float | None = None) -> dict[str, Any]:
    """Return the tables of the design methods at each meter, (methods, why they say
    nothing), and sentences on them; nothing for a run without a way down. end: the
    depth where suction ends (m)."""
    history = run.history
    if curves.penetration(history) is None or not design.goes_down(history):
        return NOTHING
    rows_down = curves.way_down(history["penetration_m"])[1:]
    site = theory.site_of(run)
    at = curves.down_to(end, depths_of(history["penetration_m"][rows_down], 1.0))
    answers = theory.answers_of(site, at)
    with_suction, total = needs_suction(run), design.FORCES[-1]
    computed = None
    if total in history and not with_suction and not run.by_hand:
        computed = design.compared_at(history, at)[total]
    title = "Total force (kN)"
    if computed is None:
        title = "Force of jacking, without suction (kN)"
    forces = [answer.total for answer in answers if answer.forces]
    tables = beside(title, {"depth (m)": at}, computed, forces, run.shown)
    leaves = ""
    if with_suction:
        columns = relief.table_of(run, at)
        leaves = say(SENTENCES, "suction_leaves") if columns else ""
        title = "What suction leaves of the forces"
        left = [table(title, columns, run.shown)] if columns else []
        tables = [*suction_tables(run, at, site, answers), *left, *tables]
    # the deepest of them that a cone test reaches
    end = site.cone.depth[-1] if site.cone else np.inf
    h = float(max((z for z in at if z <= end), default=at[-1]))
    why = list[str]()
    if not run.by_hand:
        at_h = theory.answers_of(site, np.array([h]))
        why = [why_of(run, at), *others_of(run, h, at_h)]
    kept = say(SENTENCES, "kept_cone") if site.cone and not run.by_hand else ""
    notes = [kept, theory.about_cone(site, float(at.max())), leaves]
    if answers[0].forces:
        assumed = theory.assumptions_in_words(site.scene)
        notes.insert(0, f"{assumed}; {UNDISTURBED_IS}.")
    return {
        "tables": [x for x in tables if {*x["heads"][1:]} - {"computed"}],
        "why": [sentence for sentence in why if sentence],
        "reasons": theory.reasons(answers),
        "notes": [note for note in notes if note],
    }
