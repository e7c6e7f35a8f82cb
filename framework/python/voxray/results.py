"""Results of a run: its tables, images of its variants, the chart of methods, scores by a metric of one's own."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path

import matplotlib
import numpy as np
import pandas as pd
from orchestration.errors import did_you_mean
from PIL import Image
from report import exr_pixels, figures, images, pareto, pareto_page, results, text
from report.load import load as load_tables

from voxray import display
from voxray.errors import VoxrayError

LIGHTS = {"total": "final", "indirect": "indirect"}  # names of their images
Metric = Callable[[np.ndarray, np.ndarray], float]
_SHOWN = 5  # variants in a strip
_MOST_ROWS = 60
_DPI = 160
_LONGEST = 400  # list in a message, characters


class Results(results.Results):
    """A run's results; its tables are those of docs/reading-a-report.md.

    variants, passes, values, frames: DataFrames. manifest: manifest.json. names: of variants by their id. warnings: the run's.
    results["lookup"] is a variant, by its id or its name.
    """

    def __getitem__(self, variant: str) -> Variant:
        """@throws VoxrayError where the run has no such variant, or it failed"""
        ids = [known for known in self.ok["variant"] if variant in (known, self.names[known])]
        if not ids:
            failed = self.variants[(self.variants["variant"] == variant) | (self.variants["name"] == variant)]
            if len(failed):
                raise VoxrayError(f"{self.directory}: '{variant}' failed: {failed['error'].iloc[0]}")
            known = did_you_mean(variant, self.ok["variant"])
            raise VoxrayError(f"{self.directory}: no variant '{variant}'{known if len(known) < _LONGEST else '; the table `variants` lists them'}")
        return Variant(self, ids[0])

    def light(self, light: str | None = None) -> str:
        """A light by its name, "total" or "indirect"; None: the indirect light where the run has it apart, else the total."""
        known = self.lights()
        if light is not None and light not in known:
            raise VoxrayError(f"{self.directory}: has no light '{light}'; one of: {', '.join(known)}")
        return light or known[-1]

    def pareto(self, scene: str | None = None, *, cost: str = "frame", error: str = "nrmse", light: str | None = None,
               more: Iterable[Results] = ()) -> pd.DataFrame:
        """Costs and errors of a scene's variants, as `./voxray pareto` has them, and their chart.

        Rows are variants, columns those of the command's CSV: scene, method (variants with the same chain of passes), machine,
        variant, name, costs (times in ms, memory in bytes, rays, voxel steps), and each error with the ends of its 95 %
        interval, named as in `variants`: `nrmse` of all light, `indirect_nrmse` of the indirect light. `front`: whether no other variant has less of both the cost and the error. The chart, a figure of
        matplotlib.pyplot, shows the error against the cost, and the front of each method.

        @param scene its name; None where there is one alone
        @param cost "frame", "frame + light", "build + frame" or "memory"
        @param error a metric of the run that is lower for better images, without the light's prefix
        @param light "total" or "indirect"; None: the indirect light where the run has it apart
        @param more other runs that are compared; variants with the same reference and machine are one scene
        @throws VoxrayError where there is no such scene, cost or error
        """
        if cost not in pareto.CHARTED:
            raise VoxrayError(f"cost '{cost}' is none of {', '.join(pareto.CHARTED)}")
        try:
            compared = pareto_page.Comparison.of([self, *more], error, self.light(light))
        except results.ReportError as wrong:
            raise VoxrayError(str(wrong)) from wrong
        names = [one.name for one in compared.scenes]
        if scene is None and len(names) > 1 or scene is not None and scene not in names:
            asked = "several scenes" if scene is None else f"no scene '{scene}'"
            raise VoxrayError(f"{self.directory}: {asked}; name one of: {', '.join(names)}")
        chosen = compared.scenes[names.index(scene or names[0])]
        _draw(compared, chosen, cost)
        columns, *rows = pareto_page.csv_lines(compared)
        first = columns.index([*pareto.COSTS][-1]) + 1
        columns[first:] = [results.LIGHTS[self.light(light)] + column for column in columns[first:]]
        table = pd.DataFrame(rows, columns=columns)
        table = table.astype(dict.fromkeys(columns[columns.index("name") + 1:], float))
        table = table[table["scene"] == chosen.name].reset_index(drop=True)
        front = chosen.front_of_all(pareto.CHARTED.index(cost), compared.first)
        return table.assign(front=np.isin(np.arange(len(table)), front))

    def metric(self, function: Metric, light: str | None = None) -> pd.DataFrame:
        """Scores all finished variants by a metric of one's own.

        @param function of an image and its reference, linear radiance in W/(m² sr), shape (height, width, 3): a number
        @return a row for each variant that has an image and a reference: variant, name, value; where the reference has halves,
            low and high, the least and the largest value against the reference and either half, which have half the samples: how
            far the reference's noise moves the number (not a 95 % interval); and floor, the mean of both halves' values against
            their mean, from which they differ by as much noise as it has: about what a perfect image would score
        """
        rows = []
        for variant in map(self.__getitem__, self.ok["variant"]):
            truth = variant.reference(light)
            if truth is None or not variant.file(light):
                continue
            image = variant.image(light)
            row = {"variant": variant.id, "name": variant.name, "value": function(image, truth.mean)}
            if truth.halves:
                values = [row["value"], *(function(image, half) for half in truth.halves)]
                floor = np.mean([function(half, truth.mean) for half in truth.halves])
                row |= {"low": min(values), "high": max(values), "floor": floor}
            rows.append(row)
        return pd.DataFrame(rows, columns=None if rows else ["variant", "name", "value"])

    def best(self, count: int = _SHOWN) -> list[Variant]:
        """The finished variants with the least nRMSE, by rising error; as the run has them where it has no reference."""
        column = results.LIGHTS[self.light()] + "nrmse"
        rows = self.ok.sort_values(column, kind="stable") if column in self.ok else self.ok
        return [self[variant] for variant in rows["variant"].head(count)]

    def __repr__(self) -> str:
        return f"Results of {self.directory.name}: {len(self.ok)} of {len(self.variants)} variants finished"

    def _repr_html_(self) -> str:
        light = self.light()
        prefix = results.LIGHTS[light]
        shown = self.best()
        pictures, maps = {}, {}
        for variant in shown:
            if variant.file(light) and not pictures and (truth := variant.reference(light)):
                pictures["reference"] = variant.picture(truth.mean)
            if variant.file(light):
                pictures[variant.name] = variant.picture(variant.image(light))
            if error := variant.error_map(light):
                maps[f"FLIP of {variant.name}"] = error
        columns = {"name": "name", "build_ms": "build, ms", "frame_ms_median": "frame, ms", "memory_bytes": "memory",
                   **{prefix + metric.key: metric.label for metric in self.metrics}}
        table = self.ok[list(columns)].rename(columns=columns).dropna(axis=1, how="all")
        count = f"{len(self.ok)} of {len(self.variants)} variants finished"
        note = f", {light} light of the {len(shown)} with the least nRMSE" if len(self.ok) > len(shown) else f", {light} light"
        warnings = "".join(f"<li>{html.escape(warning)}</li>" for warning in self.warnings)
        return (f"<p><code>{html.escape(str(self.directory.name))}</code>: {count}{note}</p>{display.captioned(pictures)}"
                f"{display.captioned(maps)}{table.to_html(index=False, max_rows=_MOST_ROWS, formatters=_formatters(table))}"
                + (f"<p>Warnings:</p><ul>{warnings}</ul>" if warnings else ""))


@dataclass(frozen=True)
class Reference:
    """The image that is right: linear radiance in W/(m² sr), shape (height, width, 3). halves: two independent images with half
    of its samples each, whose mean it is; None where the run kept none."""

    mean: np.ndarray
    halves: tuple[np.ndarray, np.ndarray] | None
    file: Path


@dataclass(frozen=True)
class Variant:
    """A finished variant of a run. Images are linear radiance of frame 0, W/(m² sr), shape (height, width, 3); light: "total" or
    "indirect", None for that of Results.light()."""

    results: Results
    id: str

    @property
    def name(self) -> str:
        return self.results.names[self.id]

    @cached_property
    def row(self) -> pd.Series:
        """Its row of results.csv: costs and scores."""
        return self.results.ok[self.results.ok["variant"] == self.id].iloc[0]

    @property
    def final(self) -> np.ndarray:
        """All light."""
        return self.image("total")

    @property
    def indirect(self) -> np.ndarray:
        """The indirect light. @throws VoxrayError where the run has it not apart"""
        return self.image("indirect")

    def file(self, light: str | None = None) -> Path | None:
        """The EXR file, None where the run kept none."""
        return self.results.image(self.id, f"{LIGHTS[self.results.light(light)]}.exr")

    def image(self, light: str | None = None) -> np.ndarray:
        """@throws VoxrayError where the run kept no image of that light"""
        path = self.file(light)
        if path is None:
            raise VoxrayError(f"{self.results.directory}: no image of the {self.results.light(light)} light of '{self.id}'")
        return exr_pixels.rgb(path)

    def reference(self, light: str | None = None) -> Reference | None:
        """What it was compared with, None where that is not there."""
        stem, folder = LIGHTS[self.results.light(light)], self.results.reference_folder(self.id)
        paths = [self.results.image(folder, f"{stem}{end}.exr") if folder else None for end in ("", "_a", "_b")]
        if paths[0] is None:
            return None
        halves = tuple(map(exr_pixels.rgb, paths[1:])) if all(paths) else None
        return Reference(exr_pixels.rgb(paths[0]), halves, paths[0])

    def picture(self, radiance: np.ndarray) -> Image.Image:
        """8-bit sRGB at the run's exposure."""
        return display.picture(radiance, self.results.manifest.get("exposure_stops", 0))

    def error_map(self, light: str | None = None) -> Image.Image | None:
        """HDR-FLIP from 0 (black) to 1 (light yellow), None where there is no reference."""
        path = self.results.image(self.id, results.IMAGES[self.results.light(light)][1])
        return display.error_picture(np.asarray(images.open_png(path).convert("L")) / 255) if path else None

    def __repr__(self) -> str:
        return f"Variant '{self.id}' of {self.results.directory.name}"

    def _repr_html_(self) -> str:
        pictures = {}
        for light in reversed(self.results.lights()):
            if not self.file(light):
                continue
            pictures[f"{light} light"] = self.picture(self.image(light))
            if truth := self.reference(light):
                pictures[f"reference, {light}"] = self.picture(truth.mean)
            if error := self.error_map(light):
                pictures[f"FLIP, {light}"] = error
        return f"<p>{html.escape(self.name)}</p>{display.captioned(pictures)}"


def load(directory: str | Path) -> Results:
    """Reads a results folder. @throws VoxrayError where it has no results"""
    try:
        loaded = load_tables(directory)
    except results.ReportError as error:
        raise VoxrayError(str(error)) from error
    return Results(**{field.name: getattr(loaded, field.name) for field in fields(loaded)})


def _draw(compared: pareto_page.Comparison, scene: pareto.Scene, cost: str) -> None:
    from matplotlib import pyplot  # where there is a chart alone: it looks for a display
    # Before rc_context(), which takes back what the first figure sets: Jupyter would not show the next one
    figure = pyplot.figure(figsize=figures.CHART, dpi=_DPI)
    with matplotlib.rc_context(figures.STYLE):
        figures.chart(figure, compared, scene, pareto.CHARTED.index(cost))


def _formatters(table: pd.DataFrame) -> dict:
    known = {"memory": text.size, "name": str}
    return {column: known.get(column, text.figures) for column in table}
