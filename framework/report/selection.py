"""Which variants the page shows in detail: with their images, their passes and their graph."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from report.images import BYTES_OF_EXR, film_bytes
from report.ranking import pareto_front
from report.results import IMAGES, LIGHTS, ReportError, Results, folder_of, interval_ends
from report.setting import comparisons

FRONT, ALL = "front", "all"
_MAX_BYTES = 50e6  # of images and rows in a page: charts and the text of some hundred variants take less than 10 MB
_MAX_FLOAT_BYTES = 25e6  # of half floats in a page
_ROW_BYTES = 2500  # of a variant's row and its points
_MAX_VARIANTS = 500
_TEXT_BYTES = 4 / 3  # of a byte in base64


def selected(results: Results, lights: list[str], wanted: list[str]) -> list[str]:
    """The variants to show in detail, in the order of the table.

    @param wanted "front" (those on the Pareto front of a chart, as many as fit into a page), "all", numbers or names of
        variants, or several of these; empty: all where they fit, else "front".
    @throws ReportError where a word is none of these.
    """
    variants = list(results.variants["variant"])
    meant = {called: name for of in (results.names, results.numbers) for name, called in of.items()}
    meant |= dict(zip(variants, variants))
    chosen = set()
    for word in wanted or [ALL if _all_fit(results, lights) else FRONT]:
        if word == FRONT:
            chosen.update(_that_fit(results, lights))
        elif word == ALL:
            chosen.update(variants)
        elif word in meant:
            chosen.add(meant[word])
        else:
            raise ReportError(f"--images: '{word}' is neither '{FRONT}' nor '{ALL}', nor the number or the name of a variant")
    return [name for name in variants if name in chosen]


def front_of(results: Results, lights: list[str]) -> list[str]:
    """The variants on the Pareto front of any chart, of each scene and reference its own; those on most fronts first."""
    counts = dict.fromkeys(results.variants["variant"], 0)
    for _, compared in comparisons(results):
        for column in (LIGHTS[light] + metric.key for light in lights for metric in results.charted):
            _, high = interval_ends(compared.ok, column)
            for build in (0.0, compared.ok["build_ms"]):
                points = [(cost, error, name) for cost, error, name in zip(compared.ok["frame_ms_median"] + build, high,
                                                                           compared.ok["variant"])
                          if 0 < cost < math.inf and 0 < error < math.inf]
                for i in pareto_front([point[:2] for point in points]):
                    counts[points[i][2]] += 1
    return sorted((name for name, count in counts.items() if count), key=lambda name: -counts[name])


def with_floats(results: Results, lights: list[str], shown: list[str]) -> set[str]:
    """The folders whose images the page has as half floats: those of the references and of all shown variants where they fit,
    else of those on a Pareto front, as many as fit."""
    references = {folder_of(record) for record in results.references}
    left = min(_MAX_FLOAT_BYTES, _bytes_left(results, lights) - sum(_bytes(results, name, lights) for name in shown))
    left -= sum(_float_bytes(results, folder, lights) for folder in references)
    if left < 0:
        return set()
    sizes = {name: _float_bytes(results, name, lights) for name in shown}
    all_fit = sum(sizes.values()) <= left
    return references | set(shown if all_fit else _fitting((name for name in front_of(results, lights) if name in sizes), sizes.get, left))


def _float_bytes(results: Results, folder: str, lights: list[str]) -> float:
    """About what the half floats of a folder's images take in the page."""
    paths = [results.image(folder, IMAGES[light][0].replace(".png", ".exr")) for light in lights]
    return _TEXT_BYTES * BYTES_OF_EXR * sum(path.stat().st_size for path in paths if path)


def _fitting(names: Iterable[str], bytes_of: Callable[[str], float], left: float) -> list[str]:
    """The first names that fit into the bytes left."""
    chosen = []
    for name in names:
        left -= bytes_of(name)
        if left < 0:
            break
        chosen.append(name)
    return chosen


def _bytes_left(results: Results, lights: list[str]) -> float:
    """What the images of variants may take."""
    references = sum(_bytes(results, folder_of(record), lights) for record in results.references)
    return _MAX_BYTES - references - _ROW_BYTES * len(results.variants)


def _all_fit(results: Results, lights: list[str]) -> bool:
    variants = results.variants["variant"]
    return len(variants) <= _MAX_VARIANTS and sum(_bytes(results, name, lights) for name in variants) <= _bytes_left(results, lights)


def _that_fit(results: Results, lights: list[str]) -> list[str]:
    """The variants that are on most fronts, as many as fit."""
    return _fitting(front_of(results, lights)[:_MAX_VARIANTS], lambda name: _bytes(results, name, lights), _bytes_left(results, lights))


def _bytes(results: Results, folder: str, lights: list[str]) -> float:
    """About what a folder's images take in the page."""
    paths = [results.image(folder, file) for light in lights for file in IMAGES[light]]
    return _TEXT_BYTES * (sum(path.stat().st_size for path in paths if path) + film_bytes(results, folder, lights[-1]))
