"""A graph with stages swapped for their exact counterparts, which passes/common/counterparts.toml lists."""

from __future__ import annotations

import tomllib
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from orchestration.errors import UsageError

TABLE = Path(__file__).resolve().parents[2] / "passes" / "common" / "counterparts.toml"

Entry = dict[str, Any]  # of a graph, as a config has it
Graph = list[Entry]
Schemas = dict[str, dict[str, dict]]  # of each parameter by pass (Program.passes)


@dataclass
class Stage:
    """A stage of a graph whose own error a counterpart takes out.

    cure: what lowers its error. needs: stages that are swapped whenever it is. changes: what its counterpart changes."""

    name: str
    cure: str
    needs: list[str]
    changes: list[str]


@dataclass
class Swaps:
    """stages: in the table's order. graphs: by label, one for every set of stages that holds what its stages need."""

    stages: list[Stage] = field(default_factory=list)
    sets: dict[str, list[str]] = field(default_factory=dict)
    graphs: dict[str, Graph] = field(default_factory=dict)

    def listed(self) -> dict:
        """For the page."""
        return {"stages": [asdict(stage) for stage in self.stages], "variants": self.sets}


def read_table() -> dict:
    with open(TABLE, "rb") as file:
        return tomllib.load(file)


def id_of(entry: Entry) -> str:
    return entry.get("id", entry["pass"])


def _resolved(entry: Entry, schemas: Schemas) -> Entry:
    """With every default filled in, in the order of the pass's parameters."""
    return {name: entry.get(name, schema.get("default", "")) for name, schema in schemas[entry["pass"]].items()}


def _number(value: float) -> int | float:
    return int(value) if value == int(value) else float(f"{value:.9g}")


def _value(rule: Any, own: Any) -> Any:
    """What a parameter becomes: a plain value, or a number that goes by the parameter's own."""
    if not isinstance(rule, dict):
        return rule
    if "least" in rule:
        return _number(max(own, rule["least"]))
    value = own * rule["times"]
    return _number(max(own, min(value, rule["most"])) if "most" in rule else value)


def text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def has_effect(name: str, entry: Entry, schemas: Schemas) -> bool:
    """Whether another parameter has a value that this one needs."""
    conditions = schemas[entry["pass"]].get(name, {}).get("x-only-with", [])
    own = _resolved(entry, schemas)

    def holds(condition: dict) -> bool:
        value = text(own[condition["parameter"]])
        return value in condition["in"] if "in" in condition else value not in condition["not_in"]

    return not conditions or any(map(holds, conditions))


def _with_parameters(entry: Entry, rule: dict, schemas: Schemas) -> Entry:
    """Parameters that the new values leave without effect must not be written."""
    own = _resolved(entry, schemas)
    changed = entry | {name: _value(value, own[name]) for name, value in rule.items()}
    return {name: value for name, value in changed.items() if has_effect(name, changed, schemas)}


def _chain(entry: Entry, chain: list[Entry], schemas: Schemas) -> Graph:
    """The last pass gets the id, so that later passes find it."""
    own = _resolved(entry, schemas)
    passes = [{name: own[name] if value == "own" else value for name, value in item.items()} for item in chain]
    passes[-1]["id"] = id_of(entry)
    return passes


def _swapped(graph: Graph, rules: dict, schemas: Schemas) -> Graph:
    """One stage swapped: each pass that its rules name becomes what they say."""
    out: Graph = []
    for entry in graph:
        rule = rules.get(entry["pass"])
        if rule is None:
            out.append(entry)
        elif isinstance(rule, dict):
            out.append(_with_parameters(entry, rule, schemas))
        elif isinstance(rule, list):
            out += _chain(entry, rule, schemas)
    return out


def _changes(before: Graph, after: Graph, schemas: Schemas) -> list[str]:
    found = []
    same_id = {id_of(entry): entry for entry in reversed(after)}
    for entry in before:
        same = same_id.get(id_of(entry))
        if same is None:
            found.append(f"without {entry['pass']}")
        elif same["pass"] != entry["pass"]:
            found.append(f"{same['pass']} in place of {entry['pass']}")
        else:
            was = _resolved(entry, schemas)
            found += [f"{id_of(entry)}.{name} {text(was[name])} → {text(value)}"
                      for name, value in _resolved(same, schemas).items() if value != was[name]]
    return found


def passes_of(variant: dict, table: dict) -> Graph:
    """The variant's passes that its image depends on. @throws UsageError where the table knows none of their counterparts."""
    known = {*table["exact"], *(name for stage in table["stages"].values() for name in stage["passes"])}
    graph: Graph = []
    for entry, place in zip(variant["config"]["graph"], variant["places"]):
        if id_of(entry) in variant["left_out"]:
            continue
        if entry["pass"] not in known:
            raise UsageError(f"{place}: '{entry['pass']}' has no exact counterpart, so its error can't be told from the others': "
                             f"swap it with --set {id_of(entry)}=OTHER, or add it to {TABLE}")
        graph.append(entry)
    return graph


def plan_swaps(variant: dict, schemas: Schemas, table: dict) -> Swaps:
    """@param variant of Program.plan(). @throws UsageError where a pass has no counterpart, or nothing is left to swap."""
    own, stages = passes_of(variant, table), table["stages"]

    def graph_of(names: list[str]) -> Graph:
        graph = own
        for name, stage in stages.items():
            if name in names:
                graph = _swapped(graph, stage["passes"], schemas)
        return graph

    # Stages whose counterpart changes something, after those that they need
    swaps = Swaps()
    for name, stage in stages.items():
        present = [other.name for other in swaps.stages]
        needs = [need for need in stage.get("needs", []) if need in present]
        before, after = graph_of(needs), graph_of([*needs, name])
        if before != after:
            swaps.stages.append(Stage(name, stage["cure"], needs, _changes(before, after, schemas)))
    if not swaps.stages:
        raise UsageError(f"{variant['places'][0]}: nothing to explain: every stage of this graph is as fine as its counterpart")

    for bits in range(1 << len(swaps.stages)):
        chosen = [stage for i, stage in enumerate(swaps.stages) if bits >> i & 1]
        names = [stage.name for stage in chosen]
        if all(need in names for stage in chosen for need in stage.needs):
            label = " + ".join(names) or "as it is"
            swaps.sets[label], swaps.graphs[label] = names, graph_of(names)
    return swaps
