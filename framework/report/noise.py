"""What the page says of a method's own noise: whose error it dominates, and which parameters lower it."""

from __future__ import annotations

import pandas as pd

from report import text
from report.methods import FILTER
from report.results import LIGHTS, Results, section, texts

_IMAGES = {"total": "final", "indirect": "indirect"}  # light -> image, as the manifest calls it
_FILTERS = {FILTER, "accumulate"}  # passes whose bias may fall with the noise of what they filter


def sentences(results: Results, light: str) -> list[str]:
    """Whether bias or noise is the larger part of each variant's nRMSE, which a second seed tells; without one,
    that it is not told where a variant has a pass that is noisy. @param light "indirect" or "total"."""
    is_noise = _is_noise(results, light)
    if is_noise is None:
        scores = results.ok[[LIGHTS[light] + metric.key for metric in results.metrics]]
        is_noisy = scores.notna().any(axis=None) and any(_noisy_parameters(results, light, name) for name in results.ok["variant"])
        return ["Bias and noise are not told apart: set measure.second_seed: true."] if is_noisy else []
    noisy, biased = list(is_noise.index[is_noise]), list(is_noise.index[~is_noise])
    said = []
    if noisy:
        said.append(f"Noise is the larger part of the error of {results.listed(noisy)}{_advice(results, light, noisy)}")
    if biased:
        said.append(_of_bias(results, biased, "the others'" if noisy else "every variant's"))
    return [" ".join(said)]


def dominated(results: Results, light: str) -> set[str]:
    """The variants whose own noise is the larger part of their error, where a second seed tells."""
    is_noise = _is_noise(results, light)
    return set() if is_noise is None else set(is_noise.index[is_noise])


def _is_noise(results: Results, light: str) -> pd.Series | None:
    """Whether noise is the larger part of each variant's error; None without a second seed."""
    split = [results.ok.set_index("variant")[LIGHTS[light] + metric.key] for metric in results.seed_metrics[:2]]
    split = pd.concat(split, axis=1).dropna() if len(split) == 2 else pd.DataFrame()
    return None if split.empty else split.iloc[:, 1] > split.iloc[:, 0]


def _of_bias(results: Results, biased: list[str], whose: str) -> str:
    filtered = [name for name in biased if any(entry.get("pass") in _FILTERS for entry in results.graph_of(name))]
    said = f"Bias is the larger part of {whose} error: more rays"
    if not filtered:
        return f"{said} don't lower it."
    if len(filtered) == len(biased):
        return f"{said} lower it only as far as a filter blurs less where there is less noise."
    return (f"{said} don't lower it. Part of that of {results.listed(filtered)} is their filter's blur, which gets less where "
            "there is less noise.")


def _noisy_parameters(results: Results, light: str, variant: str) -> list[str]:
    """The parameters whose larger values lower a variant's noise, "<id>.<parameter>", as the manifest lists them."""
    return texts(section(section(results.manifest, "noise_parameters"), _IMAGES[light]), variant)


def _advice(results: Results, light: str, noisy: list[str]) -> str:
    """The parameters with their values, by kind of pass, because one pass may have another id in each variant."""
    values: dict[str, set] = {}
    paths: dict[str, set[str]] = {}
    for variant in noisy:
        graph = {entry.get("id", entry.get("pass")): entry for entry in results.graph_of(variant)}
        for path in _noisy_parameters(results, light, variant):
            owner, _, parameter = path.rpartition(".")
            entry = graph.get(owner, {})
            key = f"{entry.get('pass', owner)}.{parameter}"
            paths.setdefault(key, set()).add(path)
            values.setdefault(key, set()).update({entry.get(parameter)} if isinstance(entry.get(parameter), (int, float)) else ())
    if not values:
        return ". ./voxray passes PASS says what makes a pass noisy."
    told = []
    for key, own in values.items():
        ends = dict.fromkeys(map(text.plain, (min(own), max(own)))) if own else ()
        name = paths[key].pop() if len(paths[key]) == 1 else key
        told.append(f"{name} (now {' to '.join(ends)})" if ends else name)
    return f"; it falls as these rise: {', '.join(told)}."
