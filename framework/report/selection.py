"""Which variants the page shows in detail: with their images, their passes and their graph."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Iterable

from report.charts import error_charts
from report.images import BYTES_OF_EXR, film_bytes
from report.results import IMAGES, ReportError, Results, folder_of
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
    left = _bytes_left(results, lights)
    if not wanted:
        fit = len(variants) <= _MAX_VARIANTS and sum(_bytes(results, name, lights) for name in variants) <= left
        wanted = [ALL if fit else FRONT]
    meant = {called: [name] for of in (results.names, results.numbers) for name, called in of.items()}
    meant |= {name: [name] for name in variants} | {ALL: variants}
    if FRONT in wanted:
        meant[FRONT] = _fitting(front_of(results, lights)[:_MAX_VARIANTS], lambda name: _bytes(results, name, lights), left)
    for word in wanted:
        if word not in meant:
            raise ReportError(f"--images: '{word}' is neither '{FRONT}' nor '{ALL}', nor the number or the name of a variant")
    chosen = {name for word in wanted for name in meant[word]}
    return [name for name in variants if name in chosen]


def front_of(results: Results, lights: list[str]) -> list[str]:
    """The variants on the Pareto front of any chart, of each scene and reference its own; those on most fronts first."""
    counts = Counter(compared.ok["variant"].iloc[i] for _, compared in comparisons(results)
                     for chart in error_charts(compared, lights)[0] for i in chart["front"])
    return [name for name, _ in counts.most_common()]


def with_floats(results: Results, lights: list[str], shown: list[str]) -> set[str]:
    """The folders whose images the page has as half floats: those of the references and of all shown variants where they fit,
    else of those on a Pareto front, as many as fit."""
    references = {folder_of(record) for record in results.references}
    left = min(_MAX_FLOAT_BYTES, _bytes_left(results, lights) - sum(_bytes(results, name, lights) for name in shown))
    left -= sum(_float_bytes(results, folder, lights) for folder in references)
    sizes = {name: _float_bytes(results, name, lights) for name in shown}
    if left < 0:
        return set()
    if sum(sizes.values()) > left:
        shown = _fitting([name for name in front_of(results, lights) if name in sizes], sizes.get, left)
    return {*references, *shown}


def _fitting(names: list[str], bytes_of: Callable[[str], float], left: float) -> list[str]:
    """The first names that fit into the bytes left."""
    ends = itertools.accumulate(map(bytes_of, names))
    return [name for name, end in zip(names, ends) if end <= left]


def _bytes_left(results: Results, lights: list[str]) -> float:
    """What the images of variants may take."""
    references = sum(_bytes(results, folder_of(record), lights) for record in results.references)
    return _MAX_BYTES - references - _ROW_BYTES * len(results.variants)


def _size(results: Results, folder: str, names: Iterable[str]) -> int:
    return sum(path.stat().st_size for name in names if (path := results.image(folder, name)))


def _bytes(results: Results, folder: str, lights: list[str]) -> float:
    """About what a folder's images take in the page."""
    pictures = _size(results, folder, (file for light in lights for file in IMAGES[light]))
    return _TEXT_BYTES * (pictures + film_bytes(results, folder, lights[-1]))


def _float_bytes(results: Results, folder: str, lights: list[str]) -> float:
    """About what the half floats of a folder's images take in the page."""
    return _TEXT_BYTES * BYTES_OF_EXR * _size(results, folder, (IMAGES[light][0].replace(".png", ".exr") for light in lights))
