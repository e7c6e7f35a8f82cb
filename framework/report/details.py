"""What the page shows of a variant besides its row: images, passes, graph."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from report import images, text
from report.results import IMAGES, LIGHTS, ReportError, Results, folder_of, section
from report.table import Cell, Table

_PASS_COLUMNS = {"ms_median": ("median, ms", text.figures), "ms_p05": ("p05, ms", text.figures), "ms_p95": ("p95, ms", text.figures),
                 "rays": ("rays", text.count), "voxel_steps": ("voxel steps", text.count), "memory_bytes": ("memory", text.size),
                 "scratch_bytes": ("scratch", text.size), "dispatches": ("dispatches", text.count),
                 "host_waits": ("host waits", text.count), "host_bytes": ("host bytes", text.size)}


class View(NamedTuple):
    """A variant's image and error map under one light, and its compared frames as a film; None where a file is absent."""

    light: str
    image: images.Picture | None
    error: images.Picture | None
    film: images.Picture | None


class Variant(NamedTuple):
    """A variant of the run; where it failed, it has an error and nothing else."""

    number: str
    name: str
    full_name: str
    anchor: str
    error: str = ""
    views: tuple[View, ...] = ()
    passes: Table | None = None
    reference: str = ""
    graph: str = ""


class Copy(NamedTuple):
    """A small copy of an image that the page shows elsewhere, under the id `image`; it links to `anchor`."""

    light: str
    image: str
    anchor: str
    number: str
    name: str
    facts: str


def picture(results: Results, path: Path | list[Path] | None, embed: Callable) -> images.Picture | None:
    """What `embed` makes of an image's path; None where there is none, with a warning where it is no image."""
    try:
        return embed(path) if path else None
    except (ReportError, OSError) as error:
        results.warnings.append(f"An image is not shown: {error}")
        return None


def photo(results: Results, folder: str, light: str, has_floats: bool) -> images.Picture | None:
    """A folder's image under a light, with its radiance as half floats where it has them and they are wanted."""
    name = IMAGES[light][0]
    preview = picture(results, results.image(folder, name), images.embed)
    exr = results.image(folder, name.replace(".png", ".exr")) if preview and has_floats else None
    return picture(results, exr, lambda path: images.with_floats(preview, path)) or preview


def variants(results: Results, lights: list[str], anchors: dict[str, str], with_floats: set[str]) -> list[Variant]:
    """All variants of `results`. Films are of the light that the page shows first.

    @param with_floats Folders whose images are embedded as half floats, too.
    """
    passes = dict(list(results.passes.groupby("variant", sort=False)))
    return [_variant(results, row, passes.get(row["variant"]), lights, anchors, with_floats)
            for row in results.variants.to_dict("records")]


def copies(results: Results, lights: list[str], shown: list[Variant]) -> list[Copy]:
    """The first reference and the variants that have an image, by their error, under each light."""
    folder = folder_of(results.references[0])
    rows = results.variants.set_index("variant")
    found = []
    for light in lights:
        if results.image(folder, IMAGES[light][0]):
            found.append(Copy(light, f"{folder}-{light}", "reference", "", "reference", f"{light} light"))
        pictured = [variant for variant in shown if any(view.light == light and view.image for view in variant.views)]
        for metric in results.metrics[:1]:
            ranks = rows[LIGHTS[light] + metric.key].map(metric.rank).fillna(float("inf"))
            pictured.sort(key=lambda variant: ranks[variant.full_name])
        for variant in pictured:
            row = rows.loc[variant.full_name]
            facts = [f"{text.figures(row['frame_ms_median'])} ms", text.size(row["memory_bytes"])]
            facts += [f"{metric.label} {text.figures(row[LIGHTS[light] + metric.key])}" for metric in results.metrics[:1]]
            found.append(Copy(light, f"{variant.anchor}-{light}", variant.anchor, variant.number, variant.name, " · ".join(facts)))
    return found


def _variant(results: Results, row: Mapping, passes: pd.DataFrame | None, lights: list[str], anchors: dict[str, str],
             with_floats: set[str]) -> Variant:
    name = row["variant"]
    called = (results.numbers[name], results.names[name], name, anchors[name])
    if row["status"] != "ok":
        return Variant(*called, error_of(row))
    views = tuple(View(light, photo(results, name, light, name in with_floats),
                       picture(results, results.image(name, IMAGES[light][1]), images.embed_error),
                       picture(results, images.frames_of(results, name, light) if light == lights[-1] else None, images.film))
                  for light in lights)
    if not any(view.image for view in views):
        results.warnings.append(f"Variant {name} has no image in its results.")
    graph = section(results.manifest, "variants").get(name)
    return Variant(*called, "", views, _pass_table(f"Passes of {results.names[name]}", passes)
                   if passes is not None else None, results.reference_folder(name) or "", text.yaml_of(graph) if graph else "")


def error_of(row: Mapping) -> str:
    """Why a variant failed, by its row."""
    return row["error"] or f"status is '{row['status']}', with no error text"


def _pass_table(title: str, passes: pd.DataFrame) -> Table:
    table = Table(title, ["pass", "phase", *(heading for heading, _ in _PASS_COLUMNS.values())], words=(0, 1))
    for row in passes.to_dict("records"):
        name = row["pass"] if row["pass"] == row["kind"] else f"{row['pass']} ({row['kind']})"
        table.add(Cell(name, "name"), row["phase"], *(write(row[key]) for key, (_, write) in _PASS_COLUMNS.items()))
    return table
