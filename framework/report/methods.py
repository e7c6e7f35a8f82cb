"""Methods: variants with the same chain of passes are one, and have one name, color and mark on a page."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field

from report.ranking import is_numeric
from report.results import Results

TRACED, FILTER = ("path_trace", "path_trace_device"), "filter_irradiance"
_RIVALS = tuple((traced, FILTER) for traced in TRACED)  # what a user would pick instead of any method of voxels
_OTHER_METHODS = ("inject_", "gather_", "sample_")  # what their passes begin with
_EVERYWHERE = {"gbuffer", "voxelize", "composite"}  # passes that tell nothing of a method
_LAYOUT = "layout"  # the parameter that makes two methods of the same passes


@dataclass
class Method:
    """`chain`: its passes, those of several layouts with theirs; `names`: what its variants are called."""

    chain: tuple[str, ...]
    names: list[str] = field(default_factory=list)
    name: str = ""

    @property
    def traces_paths(self) -> bool:
        return any(traced in self.chain for traced in TRACED)

    @property
    def is_rival(self) -> bool:
        """Whether it is filtered path tracing and nothing else."""
        return self.chain in _RIVALS


def methods_of(runs: list[Results]) -> tuple[list[Method], list[dict[str, int]]]:
    """The methods of all runs, and for each run the index of each variant's."""
    methods: dict[tuple, Method] = {}
    found: list[dict[str, Method]] = []
    for run in runs:
        names = dict(_method_names(run))
        found.append({variant: methods.setdefault(chain := _chain(run, variant), Method(chain)) for variant in names})
        for variant, method in found[-1].items():
            method.names.append(names[variant])
    listed = list(methods.values())
    _give_names(listed)
    position = {method.chain: i for i, method in enumerate(listed)}
    return listed, [{variant: position[method.chain] for variant, method in variants.items()} for variants in found]


def families_of(results: Results) -> list[tuple[Method, list[str]]]:
    """The methods of one run, each with its variants that finished."""
    methods, [members] = methods_of([results])
    return [(method, [variant for variant, own in members.items() if own == i]) for i, method in enumerate(methods)]


def _method_names(run: Results) -> Iterator[tuple[str, str]]:
    """(variant, its name without numbers and scenes that the sweep varies): "" where it varies nothing else."""
    keys = [key for key in run.sweep_keys if key.split(".")[0] != "scene" and not is_numeric(run.ok[key][run.ok[key] != "-"])]
    columns = zip(*(run.ok[key] for key in keys)) if keys else [()] * len(run.ok)
    for variant, name, values in zip(run.ok["variant"], run.ok["name"], columns):
        yield variant, ", ".join(value for value in values if value != "-") or ("" if run.sweep_keys else name)


def _chain(run: Results, variant: str) -> tuple[str, ...]:
    graph = run.graph_of(variant)
    kinds = [str(entry.get("pass")) for entry in graph]
    for rival in _RIVALS:
        if set(kinds) >= set(rival) and not any(kind.startswith(_OTHER_METHODS) for kind in kinds):
            return rival
    names = (f"{kind} ({entry[_LAYOUT]})" if _LAYOUT in entry else kind for kind, entry in zip(kinds, graph))
    return tuple(name for name in dict.fromkeys(names) if name not in _EVERYWHERE) or ("all",)


def _give_names(methods: list[Method]) -> None:
    for method in methods:
        method.name = common_words(method.names)
    for rename in (_by_gather, _by_difference, _by_number):
        groups: dict[str, list[Method]] = {}
        for method in methods:
            groups.setdefault(method.name, []).append(method)
        for same in groups.values():
            if len(same) > 1 or not same[0].name:
                for method, name in zip(same, [rename(method, same) for method in same]):
                    method.name = name


def _by_gather(method: Method, _: list[Method]) -> str:
    gather = next((kind for kind in reversed(method.chain) if kind.startswith(("gather_", *TRACED))), method.chain[-1])
    return gather.replace("_", " ") + (", filtered" if FILTER in method.chain else "")


def _by_difference(method: Method, same: list[Method]) -> str:
    shared = set.intersection(*(set(other.chain) for other in same))
    apart = [kind.replace("_", " ") for kind in method.chain if kind not in shared]
    return f"{method.name} ({', '.join(apart)})" if apart else method.name


def common_words(names: list[str]) -> str:
    """The words that all names begin with."""
    return " ".join(os.path.commonprefix([name.split() for name in names])).rstrip(",:+ ")


def _by_number(method: Method, same: list[Method]) -> str:
    return f"{method.name} {next(i for i, other in enumerate(same, 1) if other is method)}"
