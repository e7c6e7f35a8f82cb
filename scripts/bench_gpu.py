#!/usr/bin/python3
"""Measures one device: parity of its images, every pass, the papers' tables, throughput. `./voxray bench gpu` builds and calls it.

Needs the built program, Python with Jinja2, NumPy and pandas, and nothing else: no network, no compiler. Writes into DIR gpu.html, one self-contained
page with the device's name, gpu.md, gpu.json with all that was measured, and runs/, the result files of the runs. They are written
after each part, so that what was measured stays whatever comes after. A part that fails, or has no time left, stops no other one.

Exit status: 0 all is measured, 1 something failed or did not fit into the time (the page says what), 2 a wrong argument,
130 interrupted.
"""
import argparse
import json
import os
import shlex
import shutil
import signal
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.append(str(ROOT / "framework"))
from bench import page, processes, tables  # noqa: E402
from bench.clocks import ClockWatch  # noqa: E402
from bench.parts import PARTS, Bench, Ending, PartError  # noqa: E402
from bench.processes import Clock  # noqa: E402
from bench.runs import SHORTEST, Program  # noqa: E402
from report.pages import write_whole  # noqa: E402

KEPT = ("result.json", "reference.json")  # of the images folder of a run
PICTURES = ("indirect.png", "final.png")  # of runs that are compared


def arguments():
    names = [part.name for part in PARTS]
    parser = argparse.ArgumentParser(prog="voxray bench gpu", description="Measures a device and writes a page with its name.",
                                     epilog="; ".join(f"{part.name}: {part.what}" for part in PARTS))
    parser.add_argument("--device", default="", metavar="NAME", help="part of the device's name; default: the best that qualifies")
    parser.add_argument("--out", type=Path, default=Path("results/gpu"), metavar="DIR", help="default results/gpu")
    parser.add_argument("--scenes", type=Path, metavar="DIR", help="folder in which scene files are looked for first")
    parser.add_argument("--tracer", default="auto", choices=("auto", "ray_query", "ray_pipeline", "embree"),
                        help="auto (default): all that the device has")
    parser.add_argument("--profile", default="small", metavar="NAME",
                        help="of the configs; small (default) is also what those run by that lack the profile; full: as they stand")
    parser.add_argument("--limit", type=float, default=240, metavar="SECONDS", help="for all parts together; default 240")
    parser.add_argument("--only", nargs="+", default=names, choices=names, metavar="PART", help=", ".join(names))
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/bin/voxray", metavar="PATH", help="the built voxray")
    parser.add_argument("--benches", type=Path, metavar="DIR", help="where the bench programs are; default: as the build has them")
    options = parser.parse_args()
    if not options.program.is_file():
        parser.error(f"--program: no file {options.program}")
    if options.scenes and not options.scenes.is_dir():
        parser.error(f"--scenes: no folder {options.scenes}")
    return options


def prune(bench):
    """Leaves tables of the runs, and the images that the page shows."""
    for path in (bench.out / "runs").glob("*/images/*/*"):
        shown = path.name in PICTURES and path.parents[2].name.startswith("parity.")
        if path.is_file() and path.name not in KEPT and not shown:
            path.unlink()


def write(bench):
    """All of the three files, of what is measured so far."""
    rows = tables.pass_rows(run for run in bench.runs if run.device == bench.data.get("device"))
    bench.data["passes"] = rows
    if bench.runs:
        bench.data["not_covered"] = sorted(set(bench.data["all_passes"]) - {row["kind"] for row in rows})
    found = page.tables_of(bench.data, tables.slowest(rows), tables.fastest_rays(rows))
    write_whole(bench.out / "gpu.json", json.dumps(bench.data, indent=1, ensure_ascii=False) + "\n")
    write_whole(bench.out / "gpu.md", page.markdown(bench.data, found))
    write_whole(bench.out / "gpu.html", page.render(bench.data, found))


def run_part(bench, part, clock):
    """How a part ended, whatever happened in it."""
    if clock.left < SHORTEST:
        return Ending(processes.SKIPPED, processes.NO_TIME)
    try:
        return part.measure(bench, clock)
    except PartError as error:
        return Ending(processes.FAILED, str(error))
    except Exception as error:  # A mistake in one part must not lose the others.
        return Ending(processes.FAILED, f"{type(error).__name__}: {error}")


def main():
    options = arguments()
    benches = options.benches or options.program.resolve().parents[1] / "tests"
    if options.scenes:
        os.environ["VOXRAY_SCENES"] = str(options.scenes.resolve())  # benchmarks look there
    program = Program(options.program.resolve(), ROOT / "configs", options.device, options.scenes and options.scenes.resolve(),
                      options.profile)
    bench = Bench(program, options.out.resolve(), options.tracer, benches.resolve())
    shutil.rmtree(bench.out / "runs", ignore_errors=True)
    bench.out.mkdir(parents=True, exist_ok=True)
    bench.data.update(started=time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime()), command=["voxray bench gpu", *map(shlex.quote, sys.argv[1:])],
                      profile=options.profile, limit=options.limit, parts=[])
    whole = Clock(options.limit)
    missing = ""
    try:
        bench.find_device()
    except PartError as error:
        missing = str(error)
    bench.data["all_passes"] = tables.pass_names(program, whole.left)
    for part in PARTS:
        if part.name not in options.only:
            continue
        clock = whole.part(part.fraction * options.limit)
        limit, watch = clock.left, ClockWatch()
        ending = Ending(processes.FAILED, missing) if missing else run_part(bench, part, clock)
        bench.data["parts"].append({"name": part.name, "what": part.what, "status": ending.status, "why": ending.why,
                                    "seconds": round(clock.spent, 1), "limit": round(limit, 1), "clock_mhz": watch.ended(),
                                    "ran": ending.ran})
        print(f"{part.name}: {ending.status}{': ' + ending.why if ending.why else ''} ({clock.spent:.1f} s)", flush=True)
        prune(bench)
        write(bench)
    print(bench.out / "gpu.html")
    return 0 if all(part["status"] == processes.DONE for part in bench.data["parts"]) else 1


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends what runs, too
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        print("bench gpu: interrupted; the parts before stand on the page", file=sys.stderr)
        sys.exit(130)
