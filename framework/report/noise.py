"""What the page says of a method's own noise: whose error it dominates, and which parameters lower it."""

from __future__ import annotations

from report import text
from report.methods import FILTER
from report.results import LIGHTS, Results, section

_IMAGES = {"total": "final", "indirect": "indirect"}  # light -> image, as the manifest calls it
_FILTERS = {FILTER, "accumulate"}  # passes whose bias may fall with the noise of what they filter


def sentences(results: Results, light: str) -> list[str]:
    """Whether bias or noise is the larger part of each variant's nRMSE, which a second seed tells; without one,
    that it is not told where a variant has a pass that is noisy. @param light "indirect" or "total"."""
    finished = results.ok.set_index("variant")
    if not len(finished):
        return []
    split = _split(results, light)
    if not split:
        scores = finished[[LIGHTS[light] + metric.key for metric in results.metrics]]
        is_noisy = scores.notna().any(axis=None) and any(
            parameters_of(results, light, name) for name in finished.index)
        return ["Bias and noise are not told apart: set measure.second_seed: true."] if is_noisy else []
    bias, noise = split
    noisy = [name for name in bias.index if noise[name] > bias[name]]
    biased = [name for name in bias.index if bias[name] >= noise[name]]
    said = []
    if noisy:
        said.append(f"Noise is the larger part of the error of {results.listed(noisy)}{_advice(results, light, noisy)}")
    if biased:
        said.append(_of_bias(results, biased, "the others'" if noisy else "every variant's"))
    return [" ".join(said)]


def dominated(results: Results, light: str) -> set[str]:
    """The variants whose own noise is the larger part of their error, where a second seed tells."""
    split = _split(results, light)
    return {name for name in split[0].index if split[1][name] > split[0][name]} if split else set()


def _split(results: Results, light: str):
    """Bias and noise of each finished variant; None without a second seed."""
    split = [results.ok.set_index("variant")[LIGHTS[light] + metric.key] for metric in results.seed_metrics[:2]]
    return split if len(split) == 2 and split[0].notna().any() else None


def _of_bias(results: Results, biased: list[str], whose: str) -> str:
    filtered = [name for name in biased if any(entry.get("pass") in _FILTERS for entry in results.graph_of(name))]
    said = f"Bias is the larger part of {whose} error"
    if not filtered:
        return f"{said}: more rays don't lower it."
    if len(filtered) == len(biased):
        return f"{said}: more rays lower it only as far as a filter blurs less where there is less noise."
    return (f"{said}: more rays don't lower it. Part of that of {results.listed(filtered)} is their filter's blur, which gets less "
            "where there is less noise.")


def parameters_of(results: Results, light: str, variant: str) -> list[str]:
    """The parameters whose larger values lower a variant's noise, "<id>.<parameter>", as the manifest lists them."""
    images = section(section(results.manifest, "noise_parameters"), _IMAGES[light])
    listed = images.get(variant)
    return [str(path) for path in listed] if isinstance(listed, list) else []


def _advice(results: Results, light: str, noisy: list[str]) -> str:
    # Grouped by kind, because one pass may have another id in each variant
    values: dict[str, list] = {}
    paths: dict[str, list[str]] = {}
    for variant in noisy:
        for path in parameters_of(results, light, variant):
            owner, _, parameter = path.rpartition(".")
            entry = _entry(results, variant, owner)
            key = f"{entry.get('pass', owner)}.{parameter}"
            values.setdefault(key, []).append(entry.get(parameter))
            paths.setdefault(key, []).append(path)
    if not values:
        return ". ./voxray passes PASS says what makes a pass noisy."
    named = {key: paths[key][0] if len(set(paths[key])) == 1 else key for key in values}
    return f"; it falls as these rise: {', '.join(_with_values(named[key], own) for key, own in values.items())}."


def _entry(results: Results, variant: str, owner: str) -> dict:
    """The pass of an id in a variant's graph, {} where the manifest does not tell."""
    return next((entry for entry in results.graph_of(variant) if entry.get("id", entry.get("pass")) == owner), {})


def _with_values(path: str, values: list) -> str:
    numbers = sorted({value for value in values if isinstance(value, (int, float))})
    if not numbers:
        return path
    ends = [text.plain(number) for number in (numbers[0], numbers[-1])]
    return f"{path} (now {ends[0]})" if len(numbers) == 1 else f"{path} (now {ends[0]} to {ends[1]})"
