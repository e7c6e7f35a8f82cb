"""`voxray explain`: renders a config with each stage of its graph swapped for an exact counterpart, and says how much of
the error of the indirect light each stage brings."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from types import SimpleNamespace

from orchestration.counterparts import Swaps, plan_swaps, read_table
from orchestration.errors import Failed, UsageError, did_you_mean
from orchestration.program import Program, assignment
from report.rows import read_rows

AXIS = "explained"  # the pass that the sweep swaps for whole graphs; report/explain.py reads it


def chosen(variants: list[dict], name: str | None) -> dict:
    """The variant of that id or name, or the only one whose id ends so after a '-': `lookup` of `cornell-lookup`."""
    names = [variant["id"] for variant in variants]
    for variant in variants:
        if name in (variant["id"], variant["name"]) or (not name and len(variants) == 1):
            return variant
    if not name:
        raise UsageError(f"the config has {len(names)} variants, and explain takes one: choose it with --variant, "
                         f"as in --variant {names[-1]}")
    endings = [variant for variant in variants if variant["id"].endswith("-" + name)]
    if len(endings) == 1:
        return endings[0]
    if endings:
        raise UsageError(f"--variant: '{name}' ends the names of {len(endings)} variants: "
                         + ", ".join(variant["id"] for variant in endings))
    raise UsageError(f"--variant: no variant '{name}'{did_you_mean(name, names)}")


def name_of(plan: dict) -> str:
    """The experiment's name, of at most 100 characters as the program demands."""
    return f"explain_{plan['name']}"[:100]


def assignments(plan: dict, variant: dict, swaps: Swaps) -> list[str]:
    """For --set: what makes a config that renders a variant with every set of stages swapped."""
    config = dict(variant["config"])
    config["name"] = name_of(plan)
    config["graph"] = [{"pass": next(iter(swaps.graphs.values()))[-1]["pass"], "id": AXIS}]
    config["sweep"] = {AXIS: swaps.graphs}
    limit = plan["config"].get("measure", {}).get("memory_limit_mb", 0)
    config["measure"] = {"frames": 1, "warmup": 0, "build_repeats": 0, "memory_limit_mb": limit}

    # A map would be merged into the one that is there
    words = []
    for key, value in config.items():
        before = plan["config"].get(key)
        if value != before:
            words += [assignment(key, None)] if isinstance(before, dict) else []
            words.append(assignment(key, value))
    return words


def tell_failed(results: Path) -> None:
    """Says how many variants failed, where any did: what else fails the program tells itself."""
    if not results.exists():
        return
    failed = [row["status"] != "ok" for row in read_rows(results)]
    if any(failed):
        print(f"voxray: error: {sum(failed)} of {len(failed)} variants failed, {results} says why", file=sys.stderr)


def main(program: Program, options: SimpleNamespace) -> int:
    plan = program.plan(options.config)
    if plan["reference"] is None:
        raise UsageError(f"{plan['place']}: there is no 'reference', so there is no error to explain: write one, as in "
                         "{pass: path_trace, spp: 1024, bounces: 8}")
    variant = chosen(plan["variants"], options.variant)
    swaps = plan_swaps(variant, program.passes, read_table())
    changes = assignments(plan, variant, swaps)
    out = Path(options.out or f"results/{name_of(plan)}")
    status = program.replace(set=options.set + changes, only=[]).run(options.config, str(out))
    if options.dry_run:
        return status
    if status != 0:
        tell_failed(out / "results.csv")
        return status

    from report import explain_page
    from report.pages import write_whole
    from report.results import ReportError

    write_whole(out / "explain.json", json.dumps(swaps.listed(), indent=2, ensure_ascii=False))
    try:
        print(explain_page.write(out))
    except ReportError as error:
        raise Failed(f"explain: {error}") from error
    print(f"Page: {out / 'explain.html'}")
    return 0
