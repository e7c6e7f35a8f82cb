"""What methods of many runs cost and how wrong they are, scene by scene, and how much faster one is than another at equal error."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pandas as pd

from report.methods import Method
from report.ranking import all_beaten, log_cost_at, pareto_front
from report.results import LIGHTS, Metric, Results, interval_ends, section
from report.setting import scenes_of as names_of_scenes

COSTS = {"frame": "time of one frame, ms", "frame + light": "time of one frame with its light injected, ms",
         "build + frame": "time of build + one frame, ms", "memory": "device memory, bytes", "rays": "rays traced",
         "voxel steps": "voxels that rays traversed"}
CHARTED = tuple(COSTS)[:4]
_UNLIT = "light_independent"  # of the manifest: kinds of passes whose results do not depend on light
_ERRORS = ("nrmse", "relmse", "flip", "ssim")


@dataclass(frozen=True)
class Error:
    """A metric that is 0 for a perfect image."""

    metric: Metric

    @property
    def label(self) -> str:
        return f"1 − {self.metric.label}" if self.metric.better == "high" else self.metric.label

    def of(self, table: pd.DataFrame, light: str) -> np.ndarray:
        """Value and ends of the interval of each row; shape (3, rows)."""
        column = LIGHTS[light] + self.metric.key
        low, high = interval_ends(table, column)
        ends = (table[column], low, high) if self.metric.better == "low" else (1 - table[column], 1 - high, 1 - low)
        return np.array(ends, dtype=float)


def errors_of(runs: list[Results], wanted: str) -> list[Error]:
    """The errors that methods are compared by, `wanted` among them where any run has it."""
    metrics: dict[str, Metric] = {}
    for metric in (metric for run in runs for metric in run.metrics):
        metrics.setdefault(metric.key, metric)
    return [Error(metric) for key, metric in metrics.items() if key in _ERRORS or key == wanted and metric.better == "low"]


@dataclass
class Scene:
    """The variants that were compared with one reference on one machine.

    methods: the index of each variant's; labels: the variants' names; costs: shape (COSTS, variants); errors: value and ends of the
    95 % interval, shape (errors, 3, variants); usable: whether both are above 0 and the image is better than a black and a
    constant one, shape (COSTS, errors, variants); pictures: the run and the folder of each variant's images.
    """

    name: str
    machine: str
    methods: np.ndarray
    labels: list[str]
    costs: np.ndarray
    errors: np.ndarray
    usable: np.ndarray
    pictures: list[tuple[Results, str]]

    def front(self, chosen: np.ndarray, cost: int, error: int, end: int = 0) -> np.ndarray:
        """The chosen variants that no other of them beats, by rising cost. `end` of the interval: 0 value, 1 low, 2 high"""
        indices = np.flatnonzero(chosen & self.usable[cost, error])
        return indices[pareto_front(list(zip(self.costs[cost, indices].tolist(), self.errors[error, end, indices].tolist())))]

    def curve(self, front: np.ndarray, cost: int, error: int, end: int = 0) -> tuple[np.ndarray, np.ndarray]:
        """Costs and errors of a front."""
        return self.costs[cost, front], self.errors[error, end, front]

    def fronts(self, cost: int, error: int) -> dict[int, np.ndarray]:
        """Each method's own front."""
        found = {int(method): self.front(self.methods == method, cost, error) for method in np.unique(self.methods)}
        return {method: front for method, front in found.items() if len(front)}

    def front_of_all(self, cost: int, error: int) -> np.ndarray:
        return self.front(np.ones(len(self.labels), dtype=bool), cost, error)


def scenes_of(runs: list[Results], members: list[dict[str, int]], errors: list[Error], light: str) -> list[Scene]:
    """The variants of all runs that have an error, by what they are compared with (references of one hash are one image) and
    by machine, for times of two machines don't compare. `members`: see methods_of()."""
    parts = [_variants(run, of, errors, light) for run, of in zip(runs, members)]
    costs, values, usable = (np.concatenate([arrays[i] for _, *arrays in parts], axis=-1) for i in range(3))
    table = pd.concat([rows for rows, *_ in parts], ignore_index=True)
    table["run"] = np.repeat(range(len(runs)), [len(rows) for rows, *_ in parts])
    groups = table[np.isfinite(values[:, 0]).any(axis=0)].groupby(["reference", "machine"], sort=False)
    first = groups[["scene", "of", "machine"]].first()
    return [Scene(name, rows["machine"].iloc[0], rows["method"].to_numpy(), rows["name"].tolist(), costs[:, rows.index],
                  values[:, :, rows.index], usable[:, :, rows.index], [(runs[i], variant) for i, variant in zip(rows["run"], rows["variant"])])
            for name, (_, rows) in zip(_unique_names(first.to_numpy().tolist()), groups)]


def _variants(run: Results, members: dict[str, int], errors: list[Error], light: str):
    """The variants of a run as rows, and their costs, errors and which of these are usable, as Scene has them."""
    table = run.ok
    costs = _costs(run, table)
    values, is_worse = np.full((len(errors), 3, len(table)), np.nan), np.zeros((len(errors), len(table)), dtype=bool)
    for i, error in enumerate(errors):
        if error.metric.key in [metric.key for metric in run.metrics]:
            values[i] = error.of(table, light)
            is_worse[i] = table["variant"].isin(list(all_beaten(run, error.metric, LIGHTS[light] + error.metric.key)))
    is_known = (costs > 0) & np.isfinite(costs)
    usable = is_known[:, None] & ((values[:, 0] > 0) & np.isfinite(values[:, 0]) & ~is_worse)[None]
    rows = table[["variant", "name"]].assign(
        method=table["variant"].map(members), machine=str(run.manifest.get("device", "")),
        scene=table["variant"].map(dict(zip(run.variants["variant"], names_of_scenes(run)))),
        of=str(section(run.manifest, "config").get("name") or run.directory.name),
        reference=[str((run.reference_of(variant) or {}).get("hash")) for variant in table["variant"]])
    return rows, costs, values, usable


@dataclass(frozen=True)
class SpeedUps:
    """The cost of each rival over each method's at equal error: at the error of each variant on the rival's front by time of a
    frame, what the rival costs for as little error over what the method costs; of the errors that it reaches the (geometric)
    median.

    factors: value, its ends by the intervals of both errors and how many errors were reached, shape (rivals, CHARTED, errors,
        scenes, methods, 4); value NaN where none is. count: errors of the rival, 0 where it was not measured, shape (rivals,
        CHARTED, errors, scenes). Where the method's cheapest variant has less error already, that one's cost counts.
    """

    rivals: list[int]
    factors: np.ndarray
    count: np.ndarray

    def medians(self, measured: np.ndarray) -> np.ndarray:
        """Over the scenes in which both were measured, shape (rivals, CHARTED, errors, methods); an error that is never
        reached counts as slower than all. `measured`: whether each scene has each method."""
        is_compared = measured[None, None, None] & (self.count[..., None] > 0)
        value = np.where(is_compared, np.nan_to_num(self.factors[..., 0]), np.nan)
        with np.errstate(all="ignore"):
            found = np.exp(_nanmedian(np.log(value), axis=3))
        return np.where(found > 0, found, np.nan)

    def best(self, methods: list[Method], cost: int, error: int, scene: int) -> tuple[str, np.ndarray] | None:
        """The method whose speed-up over the first rival is largest, and that cell. Methods that reach less than half of the
        rival's errors do not count."""
        cells = self.factors[0, cost, error, scene]
        value = np.where(2 * cells[:, 3] >= max(self.count[0, cost, error, scene], 1), cells[:, 0], np.nan)
        value[self.rivals[0]] = np.nan
        if np.isnan(value).all():
            return None
        best = int(np.nanargmax(value))
        return methods[best].name, cells[best]


def speed_ups(scenes: list[Scene], methods: list[Method], rivals: list[int], error_count: int) -> SpeedUps:
    factors = np.full((len(rivals), len(CHARTED), error_count, len(scenes), len(methods), 4), np.nan)
    factors[..., 3] = 0
    count = np.zeros(factors.shape[:4], dtype=int)
    for s, scene in enumerate(scenes):
        for cost, error in np.ndindex(len(CHARTED), error_count):
            fronts = scene.fronts(cost, error)
            # Memory does not rise with accuracy, so that its own front would have few errors
            fronts_by_time = {rival: scene.front((scene.methods == rival) & scene.usable[cost, error], 0, error) for rival in rivals}
            compared = [(i, rival) for i, rival in enumerate(rivals) if rival in fronts and len(fronts_by_time[rival])]
            if not compared:
                continue
            targets = [fronts_by_time[rival] for _, rival in compared]
            begins = np.cumsum([0, *map(len, targets)])
            value, low, high = scene.errors[error][:, np.concatenate(targets)]
            spent = np.concatenate([log_cost_at(scene.errors[error, 0, target], *scene.curve(fronts[rival], cost, error))
                                    for (_, rival), target in zip(compared, targets)])
            present, logs = list(fronts), []
            # At an end: the one's least error against the other's largest
            for errors, end in ((value, 0), (low, 2), (high, 1)):
                limits = [scene.front(scene.methods == method, cost, error, end) for method in present]
                logs.append(spent - np.array([log_cost_at(errors, *scene.curve(front, cost, error, end)) for front in limits]))
            is_reached = ~np.isnan(logs[0])
            # An end that is not reached leaves it open whether the method gets there at all
            logs[1], logs[2] = np.where(np.isnan(logs[1]), -np.inf, logs[1]), np.where(np.isnan(logs[2]), np.inf, logs[2])
            logs = np.where(is_reached, logs, np.nan)
            for (i, _), begin, end in zip(compared, begins, begins[1:]):
                count[i, cost, error, s] = end - begin
                factors[i, cost, error, s, present, :3] = np.exp(_nanmedian(logs[..., begin:end], axis=2)).T
                factors[i, cost, error, s, present, 3] = is_reached[:, begin:end].sum(axis=1)
    return SpeedUps(rivals, factors, count)


def errors_at_equal_cost(scene: Scene, rival: int, method: int, cost: int, error: int) -> list[tuple[float, float, float]]:
    """For each variant on the rival's own front the least error that the method has at no more cost, over that variant's, and
    its ends; nothing where the method has no variant as cheap."""
    front = scene.front(scene.methods == method, cost, error)
    found = []
    for r in scene.front(scene.methods == rival, cost, error):
        cheap = front[scene.costs[cost, front] <= scene.costs[cost, r]]
        if len(cheap):
            (value, low, high), (of, of_low, of_high) = scene.errors[error, :, cheap[-1]], scene.errors[error, :, r]
            found.append((value / of, low / of_high, high / of_low if of_low > 0 else math.inf))
    return found


def best_point(scene: Scene, rival: int, rejected: set[int], cost: int, error: int) -> tuple[int, float, str, list[int]] | None:
    """The most accurate variant that costs no more than the rival at its error, by methods that are not rejected; what the
    rival costs for that error, "<" where its cheapest variant has less and ">" where none has as little; and the variants as
    good within the intervals."""
    front = scene.front(scene.methods == rival, cost, error)
    found = np.flatnonzero(scene.usable[cost, error] & ~np.isin(scene.methods, list(rejected)))
    if not len(front) or not len(found):
        return None
    costs, errors = scene.curve(front, cost, error)
    spent = np.exp(log_cost_at(scene.errors[error, 0, found], costs, errors))
    found, spent = (values[np.isnan(spent) | (scene.costs[cost, found] <= spent)] for values in (found, spent))
    if not len(found):
        return None
    i = int(np.argmin(scene.errors[error, 0, found]))
    best, bound = found[i], "<" if errors[0] < scene.errors[error, 0, found[i]] else ""
    ties = [int(other) for other in found if other != best and scene.errors[error, 1, other] <= scene.errors[error, 2, best]]
    return int(best), *((costs[-1], ">") if np.isnan(spent[i]) else (spent[i], bound)), ties


def _nanmedian(values: np.ndarray, axis: int) -> np.ndarray:
    """np.nanmedian() that takes −∞ and says nothing of slices without a number."""
    ordered, count = np.sort(values, axis), (~np.isnan(values)).sum(axis, keepdims=True)
    middle = [np.take_along_axis(ordered, np.maximum(index, 0), axis) for index in ((count - 1) // 2, count // 2)]
    return np.where(count > 0, (middle[0] + middle[1]) / 2, np.nan).squeeze(axis)


def _costs(run: Results, table: pd.DataFrame) -> np.ndarray:
    passes = run.passes
    keys = pd.Series(list(zip(passes["variant"], passes["pass"])), index=passes.index, dtype=object)
    is_again = keys.isin(set(keys[passes["phase"] == "frame"]))
    # Build passes that run again where light is new; runs of before the manifest told these have no such cost
    is_lit = (passes["phase"] == "build") & ~passes["kind"].isin(run.manifest.get(_UNLIT, [])) & ~is_again
    of_light = 1 if _UNLIT in run.manifest else math.nan

    def total(rows: pd.DataFrame, column: str) -> pd.Series:
        sums = rows.groupby("variant")[column].sum() if column in rows and len(rows) else pd.Series(dtype=float)
        return table["variant"].map(sums).fillna(0.0)
    frame = table["frame_ms_median"]
    return np.array([frame, frame + of_light * total(passes[is_lit], "ms_median"), frame + table["build_ms"], table["memory_bytes"],
                     table["rays"], total(passes, "voxel_steps")], dtype=float)


def _unique_names(keys: list[list[str]]) -> list[str]:
    """Of (scene, run, machine). The same scene may have several references: other cameras, lights, sizes."""
    names = [scene for scene, *_ in keys]
    for i in (2, 1):
        names = [f"{name} ({key[i]})" if len({other[i] for other, same in zip(keys, names) if same == name}) > 1 else name
                 for key, name in zip(keys, names)]
    return [f"{name} {names[:i + 1].count(name)}" if names.count(name) > 1 else name for i, name in enumerate(names)]
