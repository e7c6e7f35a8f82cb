"""What the page shows of a variant besides its row: images, passes, graph."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import pandas as pd

from report import film, images, text
from report.names import Names
from report.results import IMAGES, LIGHTS, ReportError, Results, folder_of, section


@dataclass(frozen=True)
class View:
    """A variant's image and error map under one light, and its compared frames as a film; None where a file is absent."""

    light: str
    image: images.Picture | None
    error: images.Picture | None
    film: images.Picture | None = None


@dataclass(frozen=True)
class PassRow:
    """A pass in a variant's timeline: it begins at `start` percent of the longest phase and takes `percent` of it."""

    name: str
    phase: str
    color: str
    start: float
    percent: float
    cells: list[str]


@dataclass(frozen=True)
class Variant:
    number: str
    name: str
    full_name: str
    anchor: str
    facts: list[tuple[str, str]]
    error: str
    views: list[View]
    passes: list[PassRow] = field(default_factory=list)
    reference: str = ""
    graph: str = ""


@dataclass(frozen=True)
class Thumbnail:
    """A small copy of an image that the page shows elsewhere, under the id `image`; it links to `anchor`."""

    light: str
    image: str
    anchor: str
    number: str
    name: str
    facts: str


@dataclass(frozen=True)
class Lead:
    """What the page begins with under one light: the reference, the variant nearest to it, and that one's error map."""

    light: str
    copies: list[Thumbnail]


def picture(results: Results, folder: str, name: str, embed: Callable, warnings: list[str]) -> images.Picture | None:
    """An image of a folder as `embed` makes it of its path; None, with a warning, where it is none."""
    path = results.image(folder, name)
    return _or_warning(lambda: embed(path), warnings) if path else None


def photo(results: Results, folder: str, light: str, has_floats: bool, warnings: list[str]) -> images.Picture | None:
    """A folder's image under a light, with its radiance as half floats where it has them and they are wanted."""
    name = IMAGES[light][0]
    preview = picture(results, folder, name, images.embed, warnings)
    exr = results.image(folder, name.replace(".png", ".exr")) if preview and has_floats else None
    return exr and _or_warning(lambda: images.with_floats(preview, exr), warnings) or preview


def variants(results: Results, lights: list[str], colors: dict[str, str], names: Names, anchors: dict[str, str],
             with_floats: set[str], warnings: list[str]) -> list[Variant]:
    """All variants of `results`. Films are of the light that the page shows first.

    @param with_floats Folders whose images are embedded as half floats, too.
    """
    passes = dict(list(results.passes.groupby("variant", sort=False)))
    return [_variant(results, row, passes.get(row["variant"]), lights, colors, names, anchors, with_floats, warnings)
            for row in results.variants.to_dict("records")]


def thumbnails(results: Results, lights: list[str], shown: list[Variant]) -> list[Thumbnail]:
    """The first reference and each variant under each light, for those that have an image."""
    folder = folder_of(results.references()[0])
    rows = results.variants.set_index("variant")
    metric = results.metrics[0] if results.metrics else None
    small = []
    for light in lights:
        if results.image(folder, IMAGES[light][0]):
            small.append(Thumbnail(light, f"{folder}-{light}", "reference", "", "reference", ""))
        for variant in shown:
            if not any(view.light == light and view.image for view in variant.views):
                continue
            ms = f"{text.figures(rows.loc[variant.full_name, 'frame_ms_median'])} ms"
            score = (f", {metric.label} {text.figures(rows.loc[variant.full_name, LIGHTS[light] + metric.key])}"
                     if metric else "")
            small.append(Thumbnail(light, f"{variant.anchor}-{light}", variant.anchor, variant.number, variant.name,
                                   ms + score))
    return small


def leads(results: Results, lights: list[str], shown: list[Variant], small: list[Thumbnail]) -> list[Lead]:
    """One for each light that has all three images; none where variants have different references.

    @param small What thumbnails() made of `shown`.
    """
    if not results.metrics or results.only_reference is None:
        return []
    metric = results.metrics[0]
    found = []
    for light in lights:
        scores = results.ok.set_index("variant")[LIGHTS[light] + metric.key].dropna()
        with_error = {variant.anchor: variant for variant in shown
                      if variant.full_name in scores.index and any(view.light == light and view.error for view in variant.views)}
        variants_of = [copy for copy in small if copy.light == light and copy.anchor in with_error]
        reference = next((copy for copy in small if copy.light == light and copy.anchor == "reference"), None)
        if not variants_of or reference is None:
            continue
        best = min(variants_of, key=lambda copy: metric.rank(scores[with_error[copy.anchor].full_name]))
        found.append(Lead(light, [
            replace(reference, facts=f"{light} light"), replace(best, facts=f"nearest to it: {best.facts}"),
            replace(best, image=f"{best.image}-error", number="", name="its error", facts="HDR-FLIP: black is none")]))
    return found


def _or_warning(make: Callable, warnings: list[str]) -> images.Picture | None:
    try:
        return make()
    except (ReportError, OSError) as error:
        warnings.append(f"An image is not shown: {error}")
        return None


def _variant(results: Results, row: Mapping, passes: pd.DataFrame | None, lights: list[str], colors: dict[str, str],
             names: Names, anchors: dict[str, str], with_floats: set[str], warnings: list[str]) -> Variant:
    name = row["variant"]
    if row["status"] != "ok":
        return Variant(names.numbers[name], names.short[name], name, anchors[name], [],
                       row["error"] or f"status is '{row['status']}', with no error text", [])
    views = [View(light, photo(results, name, light, name in with_floats, warnings),
                  picture(results, name, IMAGES[light][1], images.embed_error, warnings),
                  _film(results, name, light, warnings) if light == lights[-1] else None)
             for light in lights]
    if not any(view.image for view in views):
        warnings.append(f"Variant {name} has no image in its results.")
    facts = [("frame", f"{text.figures(row['frame_ms_median'])} ms (p05 {text.figures(row['frame_ms_p05'])}, "
              f"p95 {text.figures(row['frame_ms_p95'])})"), ("build", f"{text.figures(row['build_ms'])} ms" if row["build_ms"] != 0 else "nothing"),
             ("memory", f"{text.size(row['memory_bytes'])}, at the most {text.size(row['peak_bytes'])}"),
             ("rays", text.count(row["rays"]))]
    graph = section(results.manifest, "variants").get(name)
    return Variant(names.numbers[name], names.short[name], name, anchors[name], facts, "", views,
                   _timeline(passes, colors) if passes is not None else [],
                   results.reference_folder(name) or "", text.yaml_like(graph) if graph else "")


def _film(results: Results, name: str, light: str, warnings: list[str]) -> images.Picture | None:
    frames = film.frames_of(results, name, light)
    return _or_warning(lambda: film.film(frames), warnings) if frames else None


def _timeline(passes: pd.DataFrame, colors: dict[str, str]) -> list[PassRow]:
    """Passes of a phase one after another, as they run, by their median times; both phases on one scale."""
    longest = passes.groupby("phase")["ms_median"].sum().max()
    ends: dict[str, float] = {}
    rows = []
    for row in passes.to_dict("records"):
        start = ends.get(row["phase"], 0.0)
        ms = row["ms_median"] if row["ms_median"] > 0 else 0.0
        ends[row["phase"]] = start + ms
        part = 100 / longest if longest > 0 else 0.0
        name = row["pass"] if row["pass"] == row["kind"] else f"{row['pass']} ({row['kind']})"
        rows.append(PassRow(name, row["phase"], colors[row["kind"]], part * start, part * ms,
                            [*(text.figures(row[key]) for key in ("ms_median", "ms_p05", "ms_p95")),
                             text.count(row["rays"]), text.count(row["voxel_steps"]),
                             text.size(row["memory_bytes"]), text.size(row["scratch_bytes"]),
                             text.count(row["dispatches"]), text.count(row["host_waits"]), text.size(row["host_bytes"])]))
    return rows
