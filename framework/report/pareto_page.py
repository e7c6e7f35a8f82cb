"""The page of `voxray pareto`: a matrix of methods by scenes, a chart of cost against error for each scene, and tables."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from PIL import Image

from report import figures, images, methods, pages, pareto, style, text
from report.load import load
from report.pareto import CHARTED, COSTS, Error, Scene
from report.results import IMAGES, ReportError, Results
from report.table import Cell, Table, number

_SCRIPTS = ("d3", "toolkit.js", "state.js", "matrix.js", "chart.js", "pareto.js")
_NEEDS = {"frame": "Still light (frame)", "frame + light": "Light that changes (frame + light)",
          "build + frame": "Surfaces that move (build + frame)"}
_UNITS = np.array([[1], [1], [1], [2**20]])  # of costs in charts: ms, MiB
_MAX_CELLS = 10000  # of the matrix with one cost and error, over all rivals
_MAX_PICTURES = 300  # variants; of more, those on a front
_WIDTH, _JPEG_QUALITY = 320, 85  # of pictures, pixels


def write(page: Path, folders: list[Path], error: str, light: str, with_images: bool = True, figures_to: Path | None = None) -> Path:
    """Makes the page, next to it a table of the same name, and figures for a paper. @return the table
    @throws ReportError where there are no results with that error"""
    compared = Comparison.of([load(folder) for folder in folders], error, light)
    table = page.with_suffix(".csv")
    pages.write_whole(page, render(compared, with_images))
    pages.write_whole(table, pages.csv_text(csv_lines(compared)))
    if figures_to:
        figures.write(figures_to, compared)
    return table


@dataclass
class Comparison:
    """Methods and scenes of several runs; errors[first] is the one that is shown first."""

    runs: list[Results]
    light: str
    errors: list[Error]
    first: int
    methods: list[methods.Method]
    scenes: list[Scene]

    @staticmethod
    def of(runs: list[Results], error: str, light: str) -> Comparison:
        errors = pareto.errors_of(runs, error)
        keys = [found.metric.key for found in errors]
        if error not in keys:
            raise ReportError(f"--error: '{error}' is none of {', '.join(keys)}")
        listed, members = methods.methods_of(runs)
        first = keys.index(error)
        scenes = pareto.scenes_of(runs, members, errors, light)
        if not any(np.isfinite(scene.errors[first, 0]).any() for scene in scenes):
            raise ReportError(f"no variant has {errors[first].label} of the {light} light")
        return Comparison(runs, light, errors, first, listed, scenes)

    @cached_property
    def measured(self) -> np.ndarray:
        """Whether each scene has each method, shape (scenes, methods)."""
        return np.array([np.isin(np.arange(len(self.methods)), scene.methods) for scene in self.scenes])

    @cached_property
    def costs(self) -> list[int]:
        """Those of CHARTED that some variant has: runs of earlier versions tell no frame with its light."""
        return [i for i in range(len(CHARTED)) if any(np.isfinite(scene.costs[i]).any() for scene in self.scenes)]

    @cached_property
    def speed_ups(self) -> pareto.SpeedUps:
        order = sorted(range(len(self.methods)), key=lambda i: (not self.methods[i].is_rival, -self.measured[:, i].sum()))
        return pareto.speed_ups(self.scenes, self.methods, order[:max(1, _MAX_CELLS // self.measured.size)], len(self.errors))

    @property
    def rival(self) -> int | None:
        """Filtered path tracing, where it was measured."""
        return next((i for i, method in enumerate(self.methods) if method.is_rival), None)


def render(compared: Comparison, with_images: bool = True) -> str:
    """The whole page, self-contained."""
    pictures = _pictures(compared) if with_images else [{} for _ in compared.scenes]
    return pages.render(
        "pareto.html.j2", scripts=_SCRIPTS, data=_data(compared), pictures=pages.json_text(pictures),
        costs=[(i, _NEEDS.get(CHARTED[i], CHARTED[i])) for i in compared.costs], errors=[(i, error.label) for i, error in enumerate(compared.errors)],
        first=compared.first, rivals=[(i, compared.methods[rival].name) for i, rival in enumerate(compared.speed_ups.rivals)],
        sentences=sentences(compared), has_rival=compared.rival is not None, notes=_notes(compared), light=compared.light,
        tables=[_method_table(compared), *_rival_tables(compared), *_filled_tables(compared)], runs=[str(run.directory) for run in compared.runs])


def csv_lines(compared: Comparison):
    """Every variant of all runs: scene, method, machine, id, name, costs, errors and their intervals."""
    order = sorted(range(len(compared.errors)), key=lambda i: i != compared.first)
    keys = ["one_minus_ssim" if error.metric.key == "ssim" else error.metric.key for error in compared.errors]
    yield ["scene", "method", "machine", "variant", "name", *COSTS, *(f"{keys[i]}{end}" for i in order for end in ("", "_low", "_high"))]
    for scene in compared.scenes:
        for i, (_, variant) in enumerate(scene.pictures):
            numbers = [*scene.costs[:, i], *scene.errors[order, :, i].ravel()]
            yield [scene.name, compared.methods[scene.methods[i]].name, scene.machine, variant, scene.labels[i],
                   *(f"{value:.9g}" for value in numbers)]


def sentences(compared: Comparison) -> list[str]:
    """What to take for still light, light that changes and surfaces that move, and where nothing beats path tracing."""
    if compared.rival is None:
        return []
    lines, losses = [], {}
    for cost, need in _NEEDS.items():
        wins: dict[str, list[str]] = {}  # by method: scenes
        for s, scene in enumerate(compared.scenes):
            found = compared.speed_ups.best(compared.methods, CHARTED.index(cost), compared.first, s)
            if found and found[1][0] >= 1:
                method, (value, low, high, _) = found
                wins.setdefault(method, []).append(f"{scene.name} ({'' if low > 1 else '≈ '}{text.figures(value, 2)}×)")
            elif compared.speed_ups.count[0, CHARTED.index(cost), compared.first, s] and compared.measured[s].sum() > 1:
                losses.setdefault(need, []).append(scene.name)
        if wins:
            listed = [f"{method} in {', '.join(names)}" for method, names in sorted(wins.items(), key=lambda entry: -len(entry[1]))]
            lines.append(f"{need}: take {'; '.join(listed)}.")
    if losses:
        every = sum(compared.measured[:, compared.rival])
        listed = [f"{need[0].lower()}{need[1:]} in {'every scene' if len(names) == every > 1 else ', '.join(names)}" for need, names in losses.items()]
        lines.append(f"Filtered paths stay ahead at most of their errors: {'; '.join(listed)}.")
    return lines


def _notes(compared: Comparison) -> list[str]:
    label, rival = compared.errors[compared.first].label, compared.rival
    without = [scene.name for s, scene in enumerate(compared.scenes) if rival is None or not compared.measured[s, rival]]
    shown = {id(run) for scene in compared.scenes for run, _ in scene.pictures}
    unseen = [str(run.directory) for run in compared.runs if id(run) not in shown]
    return [sentence for sentence, names in (
        (f"Without filtered path tracing (path_trace and filter_irradiance) to compare with: {', '.join(without)}.", without),
        (f"Not shown, for no variant has {label} of the {compared.light} light: {', '.join(unseen)}.", unseen)) if names]


def _data(compared: Comparison) -> dict:
    """What the page's script shows."""
    found = compared.speed_ups
    counts = found.count[..., None] * np.broadcast_to(compared.measured, (*found.count.shape[:3], *compared.measured.shape))
    return {
        "light": compared.light, "rivals": found.rivals, "count": found.count,
        "costs": [{"key": cost, "label": COSTS[cost].replace("bytes", "MiB")} for cost in CHARTED],
        "errors": [{"name": error.label} for error in compared.errors],
        "methods": [{"name": method.name, "chain": " + ".join(method.chain), "color": own.color, "mark": own.mark}
                    for method, own in zip(compared.methods, style.styles(len(compared.methods)))],
        # null: not measured, 0: no error is reached
        "factors": _nested(found.factors, counts), "medians": found.medians(compared.measured),
        "scenes": [{"name": scene.name, "method": scene.methods, "label": scene.labels, "cost": scene.costs[:len(CHARTED)] / _UNITS, "error": scene.errors,
                    "fronts": [[scene.fronts(cost, error) for error in range(len(compared.errors))] for cost in range(len(CHARTED))],
                    "front": [[scene.front_of_all(cost, error) for error in range(len(compared.errors))] for cost in range(len(CHARTED))]}
                   for scene in compared.scenes]}


def _nested(factors: np.ndarray, counts: np.ndarray) -> list | None | int:
    if counts.ndim == 0:
        return None if not counts else 0 if not factors[3] else [*factors[:3], int(factors[3])]
    return [_nested(*parts) for parts in zip(factors, counts)]


def _method_table(compared: Comparison) -> Table:
    variants = np.bincount(np.concatenate([scene.methods for scene in compared.scenes]), minlength=len(compared.methods))
    return Table("Methods and their passes", ["method", "passes", "variants"],
                 [[method.name, " + ".join(method.chain), str(count)] for method, count in zip(compared.methods, variants)],
                 words=(0, 1))


def _filled_tables(compared: Comparison) -> list[Table]:
    """Tables whose rows the page's script writes: they follow its switches, or are long."""
    errors = [f"{error.label}{end}" for error in compared.errors for end in ("", " low", " high")]
    return [Table("Speed-ups of the matrix", ["method", "scene", "factor", "low", "high", "errors reached", "of"], words=(0, 1),
                  note="As the switches say; low and high: the ends by the intervals of both errors."),
            Table("All variants", ["scene", "method", "variant", *CHARTED, *errors], words=(0, 1, 2),
                  note="The CSV next to the page has them with more digits, rays and voxel steps.")]


def _rival_tables(compared: Comparison) -> list[Table]:
    rival, error = compared.rival, compared.first
    if rival is None:
        return []
    label, traced = compared.errors[error].label, {i for i, method in enumerate(compared.methods) if method.traces_paths}
    best, equal = [], []
    for scene in compared.scenes:
        if found := pareto.best_point(scene, rival, traced, 0, error):
            i, spent, bound, ties = found
            best.append([scene.name, scene.labels[i], str(len(ties)), number(scene.costs[0, i]),
                         Cell("never", sort="inf") if bound == ">" else number(spent, f"{bound}{text.figures(spent)}"),
                         *map(number, scene.errors[:, 0, i])])
        for m in np.unique(scene.methods):
            ratios = pareto.errors_at_equal_cost(scene, rival, m, 0, error)
            if ratios and m != rival:
                values = [ratio[0] for ratio in ratios]
                is_open = any(low <= 1 <= high for _, low, high in ratios)
                equal.append([compared.methods[m].name, scene.name, number(min(values)), number(max(values)),
                              str(len(values)), "≈" if is_open else ""])
    return [Table("Most accurate variant that is no slower than filtered path tracing at its error",
                  ["scene", "variant", "ties", "frame, ms", "path tracing, ms", *(error.label for error in compared.errors)], best,
                  "ties: other variants whose intervals overlap this one's. never: path tracing has no variant of as little "
                  "error. <: its cheapest variant has less.", (0, 1)),
            Table(f"{label} at equal time of a frame", ["method", "scene", "least", "greatest", "of times", "open"], equal,
                  "The least error in no more time than filtered path tracing takes, over that one's; below 1 the method is more "
                  "accurate. ≈: the intervals leave that open.", (0, 1))]


def _pictures(compared: Comparison) -> list[dict]:
    """By scene: the reference, and image and error map of variants by their index."""
    everything = sum(len(scene.labels) for scene in compared.scenes) <= _MAX_PICTURES
    final, error_map = IMAGES[compared.light]
    found = []
    for scene in compared.scenes:
        fronts = {i for cost, error in np.ndindex(len(CHARTED), len(compared.errors)) for i in scene.front_of_all(cost, error).tolist()}
        run, variant = scene.pictures[0]
        uris = {"reference": [_jpeg(run, run.reference_folder(variant) or "", final)]}
        for i in range(len(scene.labels)) if everything else sorted(fronts):
            uris[str(i)] = [_jpeg(*scene.pictures[i], final), _jpeg(*scene.pictures[i], error_map, is_map=True)]
        found.append({key: pair for key, pair in uris.items() if pair[0]})
    return found


def _jpeg(run: Results, folder: str, name: str, is_map: bool = False) -> str:
    path = run.image(folder, name)
    if not path:
        return ""
    image = images.open_png(path).convert("L" if is_map else "RGB")
    image.thumbnail((_WIDTH, 10 * _WIDTH))
    if is_map:
        image = Image.fromarray(images.colors(images.ERROR_COLORS, np.asarray(image, dtype=int)))
    return images.embed_image(image, "JPEG", quality=_JPEG_QUALITY).uri
