"""`voxray tune`: searches a sweep for the cheapest variant that meets a target.

Leaves space.json (what is searched), trail.csv, chosen.yaml, tune.html and, with --every, sweep.csv in its folder, next to
the results of trials."""

from __future__ import annotations

import csv
import json
import math
import shlex
import sys
from pathlib import Path
from types import SimpleNamespace

from orchestration.errors import Failed, ProgramEnded, UsageError, did_you_mean
from orchestration.program import INTERRUPTED, Program
from orchestration.search import Outcome, Search, variants_of
from orchestration.trials import AXIS, Target, Trials
from orchestration.yaml_text import yaml_lines

DEFAULT_PART = 1 / 5  # of the sweep's cost, what a search may spend
DOUBLES = 3  # of a parameter's own value, and as many halves, that --vary tries
FEW_CHOICES = 2 * DOUBLES + 1
FIXED = ("scene", "image", "seed", "tracer")  # what a search can't vary


def spread(own: float, least: float, most: float, is_integer: bool) -> list[str]:
    """Halves and doubles of a number, those within the range."""
    values: list[str] = []
    for step in range(-DOUBLES, DOUBLES + 1):
        value = math.ldexp(own, step)
        value = min(max(math.floor(value + 0.5) if is_integer else value, least), most)
        text = f"{value:.0f}" if is_integer else f"{value:.9g}"
        if text not in values[-1:]:
            values.append(text)
    return values


def values_of(schema: dict, own, path: str) -> list[str]:
    """Values of a parameter to search: all of them where it takes few, else its own and halves and doubles of it."""
    if schema.get("type") == "boolean":
        return ["false", "true"]
    if "enum" in schema:
        choices = [str(choice) for choice in schema["enum"]]
        at = choices.index(str(own)) if str(own) in choices else None
        return choices if len(choices) <= FEW_CHOICES or at is None else choices[max(at - DOUBLES, 0):at + DOUBLES + 1]
    if schema.get("type") not in ("integer", "number"):
        raise UsageError(f"--vary {path}: it is no number and no choice: list its values in the config's sweep")
    if float(own) == 0:
        raise UsageError(f"--vary {path}: its value is 0, which has no doubles: list its values in the config's sweep")
    return spread(float(own), schema.get("minimum", -math.inf), schema.get("maximum", math.inf), schema["type"] == "integer")


def axis_of(path: str, graph: list[dict], program: Program) -> str:
    """For --set: an axis of a pass's parameter. @param path ID.PARAMETER"""
    owner, _, name = path.rpartition(".") if "." in path else (path, "", "")
    entries = {entry.get("id", entry["pass"]): entry for entry in graph}
    if owner not in entries:
        raise UsageError(f"--vary {path}: no pass '{owner}' in the graph{did_you_mean(owner, entries)}")
    entry = entries[owner]
    parameters = program.passes[entry["pass"]]
    if name not in parameters:
        raise UsageError(f"--vary {path}: '{owner}' has no parameter '{name}'{did_you_mean(name, parameters)}")
    own = entry.get(name, parameters[name].get("default", ""))
    return f"sweep.{path}=[{', '.join(values_of(parameters[name], own, path))}]"


def space_of(plan: dict) -> dict:
    """What is searched: the config without graph and sweep, axes by path, whether they swap a pass, the variants."""
    if plan["reference"] is None:
        raise UsageError(f"{plan['place']}: there is no 'reference', so there is no error to aim at: write one, as in "
                         "{pass: path_trace, spp: 1024, bounces: 8}")
    for axis in plan["axes"]:
        path = axis["path"]
        if path.partition(".")[0] in FIXED:
            raise UsageError(f"{axis['place']}: the sweep varies '{path}', and a search is for one graph: choose a value with "
                             f"--set 'sweep.{path}=null' --set {path}=VALUE")
    paths = [axis["path"] for axis in plan["axes"]]
    return {"config": {key: value for key, value in plan["config"].items() if key not in ("graph", "sweep")},
            "axes": paths, "swaps": ["." not in path for path in paths],
            "variants": [{"name": variant["name"], "values": variant["values"], "graph": variant["config"]["graph"]}
                         for variant in plan["variants"]]}


def claim(out: Path, space: dict, resume: bool) -> None:
    """Makes the folder of a search."""
    path = out / "space.json"
    if not path.exists() and not resume and out.exists() and any(out.iterdir()):
        raise UsageError(f"{out} holds something else than a search: choose another --out")
    if resume and path.exists() and json.loads(path.read_text(encoding="utf-8")) != space:
        raise UsageError(f"{out}: another config was searched there: leave out --resume")
    out.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(space, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


class Trail:
    """Runs trials, prints each, and remembers them for trail.csv."""

    def __init__(self, trials: Trials) -> None:
        self.trials = trials
        self.rows: list[list[str]] = []

    def __call__(self, names: list[str], is_small: bool) -> dict[str, Outcome | None]:
        rung = "small" if is_small else "full"
        found = self.trials.run(names, rung)
        for name, outcome in found.items():
            if outcome is None:
                print(f"{rung:5} {name}: failed", flush=True)
                self.rows.append([rung, name, "", "", ""])
                continue
            print(f"{rung:5} {name}: {self.trials.said(rung, name)}, {self.trials.minimize} {outcome.cost:.6g}", flush=True)
            self.rows.append([rung, name, f"{outcome.excess:.6g}", f"{outcome.cost:.6g}", f"{outcome.spent:.6g}"])
        return found


def write_csv(path: Path, header: list[str], rows: list[list[str]]) -> None:
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


def write_chosen(path: Path, trials: Trials, name: str, note: str) -> None:
    config = trials.space["config"]
    whole = {key: value for key, value in config.items() if key not in ("reference", "measure")}
    whole["graph"] = trials.graphs[name]
    whole |= {key: config[key] for key in ("reference", "measure") if key in config}
    path.write_text(f"# {note}\n" + "\n".join(yaml_lines(whole)) + "\n", encoding="utf-8")


def write_page(trials: Trials, trail: Trail, chosen: str, sentence: str) -> Path:
    from report import tune_page
    from report.results import ReportError

    light = "indirect" if trials.targets[0].column.startswith("indirect_") else "total"
    try:
        return tune_page.write(trials.out, trail.rows, trials.minimize, chosen, AXIS, light, sentence)
    except ReportError as error:
        raise Failed(f"tune: {error}") from error


def compare(trials: Trials, search: Search, chosen: str) -> str:
    """Runs the whole sweep. @return how good the choice is and what the search saved."""
    every = trials.run([variant.name for variant in search.variants], "sweep")
    ran = {name: outcome for name, outcome in every.items() if outcome is not None}
    write_csv(trials.out / "sweep.csv", ["variant", "excess", trials.minimize],
              [[name, f"{o.excess:.6g}", f"{o.cost:.6g}"] for name, o in ran.items()])
    best = min(ran, key=lambda name: (max(ran[name].excess, 1), ran[name].cost, name))
    spent = sum(o.spent for rung in (search.small, search.full) for o in rung.values())
    whole = sum(o.spent for o in ran.values())
    if ran[best].excess > 1:
        return f"The sweep: none of {len(ran)} variants meets the target; {best} comes closest."
    return (f"The sweep: {best} is the cheapest of {len(ran)} variants ({ran[best].cost:.6g}); the chosen one costs "
            f"{ran[chosen].cost / ran[best].cost:.3f} times as much, the trials {spent / whole:.3f} of the sweep.")


def tune(trials: Trials, options: SimpleNamespace) -> int:
    variants = variants_of(trials.space)
    budget = float(options.budget) or max(1.0, DEFAULT_PART * len(variants))
    print(f"{len(variants)} variants; trials may cost as much as {budget:.3g} of them", flush=True)
    trail = Trail(trials)
    search = Search(variants, trail, budget, trials.has_small)
    try:
        search.run()
    finally:
        write_csv(trials.out / "trail.csv", ["size", "variant", "excess", trials.minimize, "spent"], trail.rows)
    chosen = search.best()
    if chosen is None:
        print("voxray: error: every trial failed; results.csv in the folders of trials says why", file=sys.stderr)
        return 1
    outcome = search.full[chosen]
    path = trials.out / "chosen.yaml"
    aims = " and ".join(options.target)
    note = (f"{chosen}: {trials.said('full', chosen)}, {trials.minimize} {outcome.cost:.6g}, "
            f"after {len(trail.rows)} trials for {aims}.")
    write_chosen(path, trials, chosen, note)
    met = outcome.excess <= 1
    said = f"{'Chosen' if met else 'Closest'}: {note}"
    print(f"{said}\nConfig: {path}\nPage: {write_page(trials, trail, chosen, said)}", flush=True)
    if options.every:
        print(compare(trials, search, chosen), flush=True)
    if not met:
        command = ["voxray", "explain", str(path)] + (["--tracer", options.tracer] if options.tracer else [])
        print(f"voxray: error: nothing that was tried meets {aims}; which stage stands in the way says: "
              f"{shlex.join(command)}", file=sys.stderr)
    return 0 if met else 1


def main(program: Program, options: SimpleNamespace) -> int:
    """Exit status: 0 a variant meets the target, 1 none does."""
    for path in options.vary:
        graph = program.plan(options.config)["config"]["graph"]
        options.set.append(axis_of(path, graph, program))
        program = program.replace(set=options.set)
    plan = program.plan(options.config)
    space = space_of(plan)
    targets = [Target.read(text, plan["columns"]) for text in options.target]
    out = Path(options.out or f"results/tune_{plan['name']}")
    claim(out, space, options.resume)
    try:
        return tune(Trials(space, program, out, targets, options), options)
    except (ProgramEnded, KeyboardInterrupt) as ended:
        if isinstance(ended, ProgramEnded) and ended.status != INTERRUPTED:
            raise
        print(f"voxray: interrupted; finished trials are kept in {out}, --resume goes on", file=sys.stderr)
        return INTERRUPTED
