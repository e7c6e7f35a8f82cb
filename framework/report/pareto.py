"""Methods of many runs, scene by scene: which are on the Pareto front, which are beaten everywhere, what they save."""

from __future__ import annotations

import math
import statistics
from dataclasses import dataclass, field

from report.equal_error import Reached, time_to_reach
from report.ranking import beaten_by, pareto_front
from report.results import LIGHTS, Metric, Results, interval_of, number, section
from report.setting import scene_of

TRACED = "path_trace"
RIVAL = {TRACED, "filter_irradiance"}  # passes of what a user would pick instead
_OTHER_METHODS = ("inject_", "gather_", "sample_")  # what their passes begin with
_EVERYWHERE = {"gbuffer", "voxelize", "composite"}  # passes that tell nothing of a method
_LAYOUT = "layout"  # the parameter that makes two methods of the same passes
# Build passes whose results do not depend on light; all others run again where it is new
_LIGHT_INDEPENDENT = {"voxelize", "voxelize_clipmap", "voxelize_octree", "voxelize_packed", "place_surfels", "link_surfels",
                      "cluster_voxels", "find_patches", "cluster_visibility", "build_hybrid_leaves"}
COSTS = {"frame": "time of one frame, ms", "frame + light": "time of one frame with its light injected, ms",
         "build + frame": "time of build + one frame, ms", "memory": "device memory, bytes", "rays": "rays traced",
         "voxel steps": "voxels that rays traversed"}
TIMES = ("frame", "frame + light", "build + frame")  # these can't be compared between machines, counts can


@dataclass(frozen=True)
class Measured:
    """A variant: its costs by COSTS, its error and the ends of the error's interval."""

    method: str
    spp: int  # samples a pixel of filtered path tracing, 0 for all else
    machine: str
    label: str
    costs: dict[str, float]
    error: float
    low: float
    high: float
    is_worse_than_nothing: bool  # than a black or a constant image
    scores: dict[str, float]  # of every metric of the run

    @property
    def is_rival(self) -> bool:
        return self.spp > 0


@dataclass(frozen=True)
class Factor:
    """A method over filtered path tracing with some samples a pixel: by how much, and what the intervals of both errors
    make of it. NaN where the method does not get there."""

    rival: Measured
    value: float
    low: float
    high: float

    @property
    def is_significant(self) -> bool:
        """Whether the intervals leave no doubt on which side of 1 it lies."""
        return self.low > 1 or self.high < 1


@dataclass
class Scene:
    """What was compared with one reference."""

    name: str
    run: str  # the first one that shows it
    measured: list[Measured] = field(default_factory=list)

    def methods(self) -> list[str]:
        return list(dict.fromkeys(m.method for m in self.measured))

    def on_each_machine(self) -> list[tuple[str, str]]:
        """(method, machine), those of filtered path tracing left out."""
        return list(dict.fromkeys((m.method, m.machine) for m in self.measured if not m.is_rival))

    def rivals(self, machine: str, cost: str) -> list[Measured]:
        """The variants of filtered path tracing that no other of them beats, by rising cost."""
        own = [m for m in self.measured if m.is_rival and m.machine == machine and m.costs[cost] > 0 and m.error > 0]
        return [own[i] for i in pareto_front([(m.costs[cost], m.error) for m in own])]

    def of(self, method: str, machine: str, cost: str) -> list[Measured]:
        """A method's variants on one machine."""
        return [m for m in self.measured
                if (m.method, m.machine) == (method, machine) and m.costs[cost] > 0 and m.error > 0]


def scenes_of(runs: list[Results], metric: Metric, light: str) -> list[Scene]:
    """The variants of all runs, by what they are compared with: references of one hash are one image.

    A method is named by the passes that not every variant of all runs has.
    """
    column = LIGHTS[light] + metric.key
    graphs = [(run, row, _passes(run, row["variant"])) for run in runs for _, row in run.ok.iterrows()
              if not math.isnan(number(row.get(column)))]
    shared = set.intersection(*(set(names) for *_, names in graphs)) if graphs else set()
    scenes: dict[str, Scene] = {}
    for run, row, names in graphs:
        reference = run.reference_of(row["variant"]) or {}
        scene = scenes.setdefault(str(reference.get("hash")), Scene(scene_of(run, row), _run_name(run)))
        own = [name for name in names if name not in shared | _EVERYWHERE]
        scene.measured.append(Measured(
            " + ".join(own) or "all", _samples_of_rival(run, row["variant"]), str(run.manifest.get("device", "")), row["variant"], _costs(run, row),
            row[column], *interval_of(row, column), bool(beaten_by(run, metric, column, row)),
            {other.key: row[LIGHTS[light] + other.key] for other in run.metrics}))
    return _with_unique_names(list(scenes.values()))


def speed_ups(scene: Scene, cost: str) -> dict[str, list[Factor]]:
    """By method: for each variant of filtered path tracing on its own front, its cost over what the method costs for as
    little error. Where the method's cheapest variant has less error already, that one's cost counts: the factor is at least
    so much."""
    found: dict[str, list[Factor]] = {}
    for method, machine in scene.on_each_machine():
        variants = scene.of(method, machine, cost)
        for rival in scene.rivals(machine, cost) if variants else []:
            value, low, high = (_factor(rival.costs[cost], wanted, [(m.costs[cost], error(m)) for m in variants])
                                for wanted, error in ((rival.error, lambda m: m.error), (rival.low, lambda m: m.high),
                                                      (rival.high, lambda m: m.low)))
            # An end that is not reached leaves it open whether the method gets there at all
            found.setdefault(method, []).append(Factor(rival, value, 0.0 if math.isnan(low) else low,
                                                       0.0 if math.isnan(high) else high))
    return found


def median_speed_ups(scenes: list[Scene], cost: str) -> dict[str, tuple[float, float, int, int]]:
    """By method, over all scenes: median and least factor over filtered path tracing at equal error, how many of its errors
    the method reached, and how many there are. Errors that it did not reach are in neither factor."""
    factors: dict[str, list[float]] = {}
    for scene in scenes:
        for method, entries in speed_ups(scene, cost).items():
            factors.setdefault(method, []).extend(factor.value for factor in entries)
    table = {}
    for method, all_of in factors.items():
        reached = [factor for factor in all_of if not math.isnan(factor)]
        table[method] = (statistics.median(reached) if reached else math.nan, min(reached, default=math.nan),
                         len(reached), len(all_of))
    return table


def best_at(views: list[Scene], cost: str, samples: tuple[int, ...]) -> tuple[str, Factor] | None:
    """The method other than path tracing whose least factor over filtered path tracing is largest, and that factor. Factors
    are those at all of `samples` a pixel in all views, which show one scene by several metrics. None where no method reaches
    all errors."""
    by_view = [speed_ups(scene, cost) for scene in views]
    known = {}
    for method in dict.fromkeys(method for found in by_view for method in found if TRACED not in method):
        own = [[factor for factor in found.get(method, []) if factor.rival.spp in samples] for found in by_view]
        factors = [factor for of_view in own for factor in of_view]
        if all({factor.rival.spp for factor in of_view} == set(samples) for of_view in own) and not any(math.isnan(f.value) for f in factors):
            known[method] = min(factors, key=lambda factor: factor.value)
    return max(known.items(), key=lambda entry: entry[1].value, default=None)


def best_point(scene: Scene, cost: str) -> tuple[Measured, Reached, list[Measured]] | None:
    """The most accurate of the variants that cost no more than filtered path tracing at their error, what path tracing costs
    for that error, and the variants whose intervals overlap its own."""
    found = []
    for m in scene.measured:
        rivals = [(r.costs[cost], r.error) for r in scene.rivals(m.machine, cost)]
        if TRACED in m.method or not (m.error > 0 and rivals):
            continue
        reached = time_to_reach(m.error, rivals)
        if reached.bound == ">" or 0 < m.costs[cost] <= reached.milliseconds:
            found.append((m, reached))
    if not found:
        return None
    best, reached = min(found, key=lambda entry: entry[0].error)
    return best, reached, [m for m, _ in found if m is not best and m.low <= best.high]


def errors_at_equal_time(scene: Scene, cost: str) -> dict[str, list[Factor]]:
    """By method: for each variant of filtered path tracing on its own front, the least error that the method has at no more
    cost, over that variant's; NaN where the method has no variant as cheap."""
    found: dict[str, list[Factor]] = {}
    for method, machine in scene.on_each_machine():
        for rival in scene.rivals(machine, cost):
            cheap = [m for m in scene.of(method, machine, cost) if m.costs[cost] <= rival.costs[cost]]
            own = min(cheap, key=lambda m: m.error, default=None)
            ends = (math.nan, 0.0, math.inf) if own is None else (
                own.error / rival.error, own.low / rival.high if rival.high > 0 else 0.0,
                own.high / rival.low if rival.low > 0 else math.inf)
            found.setdefault(method, []).append(Factor(rival, *ends))
    return found


def on_front(scenes: list[Scene], cost: str) -> dict[str, int]:
    """In how many scenes each method is on the Pareto front of cost and upper end of the error, most first. A front is of
    the variants of one machine that are better than a black and a constant image."""
    counts: dict[str, int] = {}
    for scene in scenes:
        usable = [m for m in scene.measured if m.costs[cost] > 0 and m.error > 0 and not m.is_worse_than_nothing]
        by_machine = [[m for m in usable if m.machine == machine] for machine in dict.fromkeys(m.machine for m in usable)]
        for method in dict.fromkeys(own[i].method for own in by_machine
                                    for i in pareto_front([(m.costs[cost], m.high) for m in own])):
            counts[method] = counts.get(method, 0) + 1
    return dict(sorted(counts.items(), key=lambda entry: -entry[1]))


def dominated(scenes: list[Scene], cost: str) -> list[str]:
    """Methods that are surely beaten in every scene that they were measured in: each of their variants costs no less
    than another method's whose error's interval lies below theirs."""
    methods = dict.fromkeys(method for scene in scenes for method in scene.methods())
    return [method for method in methods
            if all(_is_beaten(scene, m, cost) for scene in scenes for m in scene.measured if m.method == method)]


def _is_beaten(scene: Scene, own: Measured, cost: str) -> bool:
    return own.is_worse_than_nothing or any(
        other.method != own.method and (cost not in TIMES or other.machine == own.machine)
        and 0 < other.costs[cost] <= own.costs[cost] and other.high < own.low for other in scene.measured)


def _factor(spent: float, error: float, points: list[tuple[float, float]]) -> float:
    usable = [point for point in points if point[1] > 0]
    reached = time_to_reach(error, usable) if error > 0 and usable else None
    return math.nan if reached is None or reached.bound == ">" else spent / reached.milliseconds


def _samples_of_rival(run: Results, variant: str) -> int:
    graph = run.graph_of(variant)
    kinds = [str(entry.get("pass")) for entry in graph]
    if not RIVAL <= set(kinds) or any(kind.startswith(_OTHER_METHODS) for kind in kinds):
        return 0
    return int(next(entry.get("spp", 1) for entry in graph if entry.get("pass") == TRACED))


def _passes(run: Results, variant: str) -> list[str]:
    # Each once, those of several layouts with theirs.
    return list(dict.fromkeys(f"{entry.get('pass')} ({entry[_LAYOUT]})" if _LAYOUT in entry else str(entry.get("pass"))
                              for entry in run.graph_of(variant)))


def _light_ms(run: Results, variant: str) -> float:
    """Time of the build passes that run again where light is new; 0 where they run in each frame already."""
    own = run.passes[run.passes["variant"] == variant]
    again = set(own.loc[own["phase"] == "frame", "pass"])
    lit = (own["phase"] == "build") & ~own["kind"].isin(_LIGHT_INDEPENDENT) & ~own["pass"].isin(again)
    return float(own.loc[lit, "ms_median"].sum())


def _costs(run: Results, row) -> dict[str, float]:
    steps = run.passes.loc[run.passes["variant"] == row["variant"], "voxel_steps"].sum()
    return {"frame": row["frame_ms_median"], "frame + light": row["frame_ms_median"] + _light_ms(run, row["variant"]),
            "build + frame": row["frame_ms_median"] + row["build_ms"],
            "memory": row["memory_bytes"], "rays": row["rays"], "voxel steps": float(steps)}


def _with_unique_names(scenes: list[Scene]) -> list[Scene]:
    # The same scene may have several references: other cameras, lights, sizes. Then the run's name goes with it.
    names = [scene.name for scene in scenes]
    for scene in scenes:
        if names.count(scene.name) > 1:
            scene.name = f"{scene.name} ({scene.run})"
    names = [scene.name for scene in scenes]
    for i, scene in enumerate(scenes):
        if names.count(scene.name) > 1:
            scene.name += f" {names[:i + 1].count(names[i])}"
    return scenes


def _run_name(run: Results) -> str:
    return str(section(run.manifest, "config").get("name") or run.directory.name)
