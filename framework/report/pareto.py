"""Methods of many runs, scene by scene: which are on the Pareto front, which are beaten everywhere, what they save."""

from __future__ import annotations

import math
import statistics
from dataclasses import dataclass, field

from report.equal_error import time_to_reach
from report.load import LIGHTS, Metric, Results, interval_of, section
from report.ranking import beaten_by, pareto_front
from report.setting import scene_of

RIVAL = {"path_trace", "filter_irradiance"}  # passes of what a user would pick instead
_NOT_OF_IT = ("inject_", "gather_", "sample_")  # what passes of other methods begin with
_EVERYWHERE = {"gbuffer", "voxelize", "composite"}  # passes that tell nothing of a method
COSTS = {"frame": "time of one frame, ms", "build + frame": "time of build + one frame, ms",
         "memory": "device memory, bytes", "rays": "rays traced", "voxel steps": "voxels that rays walked through"}
TIMES = ("frame", "build + frame")  # these can't be compared between machines, counts can


@dataclass(frozen=True)
class Measured:
    """A variant: its costs by COSTS, its error and the ends of the error's interval."""

    method: str
    is_rival: bool  # filtered path tracing
    machine: str
    label: str
    costs: dict[str, float]
    error: float
    low: float
    high: float
    is_worse_than_nothing: bool  # than a black or a constant image


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

    def rivals(self, machine: str, cost: str) -> list[tuple[float, float]]:
        """(cost, error) of the variants of filtered path tracing that no other of them beats."""
        points = [(m.costs[cost], m.error) for m in self.measured
                  if m.is_rival and m.machine == machine and m.costs[cost] > 0 and m.error > 0]
        return [points[i] for i in pareto_front(points)]

    def points(self, method: str, machine: str, cost: str) -> list[tuple[float, float]]:
        """(cost, error) of a method's variants on one machine."""
        return [(m.costs[cost], m.error) for m in self.measured
                if (m.method, m.machine) == (method, machine) and m.costs[cost] > 0 and m.error > 0]


def scenes_of(runs: list[Results], metric: Metric, light: str) -> list[Scene]:
    """The variants of all runs, by what they are compared with: references of one hash are one image.

    A method is named by the passes that not every variant of all runs has.
    """
    column = LIGHTS[light] + metric.key
    graphs = [(run, row, _passes(run, row["variant"])) for run in runs for _, row in run.ok.iterrows()
              if not math.isnan(row[column])]
    shared = set.intersection(*(set(passes) for _, _, passes in graphs)) if graphs else set()
    scenes: dict[str, Scene] = {}
    for run, row, passes in graphs:
        reference = run.reference_of(row["variant"]) or {}
        scene = scenes.setdefault(str(reference.get("hash")), Scene(scene_of(run, row), _run_name(run)))
        own = [name for name in dict.fromkeys(passes) if name not in shared | _EVERYWHERE]
        scene.measured.append(Measured(
            " + ".join(own) or "all", _is_rival(passes), str(run.manifest.get("device", "")), row["variant"], _costs(run, row),
            row[column], *interval_of(row, column), bool(beaten_by(run, metric, column, row))))
    return _told_apart(list(scenes.values()))


def speed_ups(scene: Scene, cost: str) -> dict[str, list[tuple[float, float]]]:
    """By method, for each variant of filtered path tracing on its front: its error, and its cost over what the method
    costs for as little error; NaN where the method does not get there. Where its cheapest variant has less error already,
    that one's cost counts: the factor is at least so much."""
    found: dict[str, list] = {}
    for method, machine in scene.on_each_machine():
        for spent, error in scene.rivals(machine, cost):
            if reached := time_to_reach(error, scene.points(method, machine, cost)):
                factor = math.nan if reached.bound == ">" else spent / reached.milliseconds
                found.setdefault(method, []).append((error, factor))
    return found


def median_speed_ups(scenes: list[Scene], cost: str) -> dict[str, tuple[float, float, int, int]]:
    """By method over all scenes: median and least factor over filtered path tracing at equal error, how often the method
    reached the rival's error and of how many times. What was not reached is in neither factor."""
    factors: dict[str, list[float]] = {}
    for scene in scenes:
        for method, entries in speed_ups(scene, cost).items():
            factors.setdefault(method, []).extend(factor for _, factor in entries)
    table = {}
    for method, all_of in factors.items():
        reached = [factor for factor in all_of if not math.isnan(factor)]
        table[method] = (statistics.median(reached) if reached else math.nan, min(reached, default=math.nan),
                         len(reached), len(all_of))
    return table


def errors_at_equal_time(scene: Scene, cost: str) -> dict[str, list[tuple[float, float]]]:
    """By method, for each variant of filtered path tracing on its front: its cost, and the least error that the method has
    for as much over the rival's; NaN where it has none as cheap."""
    found: dict[str, list[tuple[float, float]]] = {}
    for method, machine in scene.on_each_machine():
        for spent, error in scene.rivals(machine, cost):
            least = min((e for c, e in scene.points(method, machine, cost) if c <= spent), default=math.nan)
            found.setdefault(method, []).append((spent, least / error))
    return found


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


def _is_rival(passes: list[str]) -> bool:
    return RIVAL <= set(passes) and not any(name.startswith(_NOT_OF_IT) for name in passes)


def _passes(run: Results, variant: str) -> list[str]:
    graph = section(run.manifest, "variants").get(variant)
    return [str(entry.get("pass")) for entry in graph if isinstance(entry, dict)] if isinstance(graph, list) else []


def _costs(run: Results, row) -> dict[str, float]:
    steps = run.passes.loc[run.passes["variant"] == row["variant"], "voxel_steps"].sum()
    return {"frame": row["frame_ms_median"], "build + frame": row["frame_ms_median"] + row["build_ms"],
            "memory": row["memory_bytes"], "rays": row["rays"], "voxel steps": float(steps)}


def _told_apart(scenes: list[Scene]) -> list[Scene]:
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
