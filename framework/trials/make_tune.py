"""Searches a sweep for the cheapest variant that meets a target, for `voxray tune`: make_tune.py OUT --program ... --target ...

OUT holds space.json (framework/experiment/trials.h). Writes trail.csv, chosen.yaml and, with --every, sweep.csv there."""

from __future__ import annotations

import argparse
import csv
import json
import shlex
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1]))

from trials.runs import Mistake, Stopped, Trials  # noqa: E402
from trials.search import Outcome, Search, variants_of  # noqa: E402
from trials.yaml_text import yaml_lines  # noqa: E402

DEFAULT_PART = 1 / 5  # of the sweep's cost, what a search may spend


class Trail:
    """Runs trials, prints each, and remembers them for trail.csv."""

    def __init__(self, trials: Trials) -> None:
        self.trials, self.rows = trials, []

    def __call__(self, names: list[str], is_small: bool) -> dict[str, Outcome | None]:
        rung = "small" if is_small else "full"
        found = self.trials.run(names, rung)
        for name, outcome in found.items():
            if outcome is None:
                print(f"{rung:5} {name}: failed", flush=True)
                self.rows.append([rung, name, "", "", ""])
                continue
            print(f"{rung:5} {name}: {self.trials.said(rung, name)}, {self.trials.options.minimize} {outcome.cost:.6g}", flush=True)
            self.rows.append([rung, name, f"{outcome.excess:.6g}", f"{outcome.cost:.6g}", f"{outcome.spent:.6g}"])
        return found


def write_csv(path: Path, header: list[str], rows: list[list]) -> None:
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


def write_chosen(path: Path, trials: Trials, name: str, note: str) -> None:
    config = dict(trials.space["config"])
    config.pop("profiles", None)
    whole = {key: value for key, value in config.items() if key not in ("reference", "measure")}
    whole["graph"] = trials.graphs[name]
    whole |= {key: config[key] for key in ("reference", "measure") if key in config}
    path.write_text(f"# {note}\n" + "\n".join(yaml_lines(whole)) + "\n", encoding="utf-8")


def compare(trials: Trials, search: Search, chosen: str) -> str:
    """Runs the whole sweep. @return how good the choice is and what the search saved."""
    every = trials.run([variant.name for variant in search.variants], "sweep")
    ran = {name: outcome for name, outcome in every.items() if outcome is not None}
    write_csv(Path(trials.options.out) / "sweep.csv", ["variant", "excess", trials.options.minimize],
              [[name, f"{o.excess:.6g}", f"{o.cost:.6g}"] for name, o in ran.items()])
    best = min(ran, key=lambda name: (max(ran[name].excess, 1), ran[name].cost, name))
    spent = sum(o.spent for rung in (search.small, search.full) for o in rung.values())
    whole = sum(o.spent for o in ran.values())
    if ran[best].excess > 1:
        return f"The sweep: none of {len(ran)} variants meets the target; {best} comes closest."
    return (f"The sweep: {best} is the cheapest of {len(ran)} variants ({ran[best].cost:.6g}); the chosen one costs "
            f"{ran[chosen].cost / ran[best].cost:.3f} times as much, the trials {spent / whole:.3f} of the sweep.")


def tune(trials: Trials, options) -> int:
    variants = variants_of(trials.space)
    budget = options.budget or max(1.0, DEFAULT_PART * len(variants))
    print(f"{len(variants)} variants; trials may cost as much as {budget:.3g} of them", flush=True)
    trail = Trail(trials)
    search = Search(variants, trail, budget, trials.has_small)
    try:
        search.run()
    finally:
        write_csv(Path(options.out) / "trail.csv", ["size", "variant", "excess", options.minimize, "spent"], trail.rows)
    chosen = search.best()
    if chosen is None:
        print("voxray: error: every trial failed; results.csv in the folders of trials says why", file=sys.stderr)
        return 1
    outcome = search.full[chosen]
    path = Path(options.out) / "chosen.yaml"
    aims = " and ".join(options.target)
    note = (f"{chosen}: {trials.said('full', chosen)}, {options.minimize} {outcome.cost:.6g}, "
            f"after {len(trail.rows)} trials for {aims}.")
    write_chosen(path, trials, chosen, note)
    met = outcome.excess <= 1
    print(f"{'Chosen' if met else 'Closest'}: {note}\nConfig: {path}", flush=True)
    if options.every:
        print(compare(trials, search, chosen), flush=True)
    if not met:
        command = ["voxray", "explain", str(path)] + (["--tracer", options.tracer] if options.tracer else [])
        print(f"voxray: error: nothing that was tried meets {aims}; which stage stands in the way says: "
              f"{shlex.join(command)}", file=sys.stderr)
    return 0 if met else 1


def main(arguments: list[str]) -> int:
    """Exit status: 0 a variant meets the target, 1 none does, 2 a mistake, 130 interrupted."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out")
    for name in ("--program", "--config", "--minimize", "--scenes"):
        parser.add_argument(name, required=True)
    parser.add_argument("--target", action="append", required=True)
    parser.add_argument("--budget", type=float, default=0)
    parser.add_argument("--tracer")
    parser.add_argument("--device")
    parser.add_argument("--every", action="store_true")
    parser.add_argument("--resume", action="store_true")
    options = parser.parse_args(arguments)
    try:
        space = json.loads((Path(options.out) / "space.json").read_text(encoding="utf-8"))
        return tune(Trials(space, options), options)
    except Mistake as mistake:
        print(f"voxray: error: {str(mistake).removeprefix('voxray: error: ')}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"voxray: error: {error.filename or options.out}: {error.strerror or error}", file=sys.stderr)
        return 1
    except (Stopped, KeyboardInterrupt):
        print(f"voxray: interrupted; finished trials are kept in {options.out}, --resume goes on", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
