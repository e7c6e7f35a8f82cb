#!/usr/bin/env python3
"""Runs glTF files through `scene`, `validate` and `run`: one voxel variant against the reference, all Lambert.

usage: gltf_chain.py [--every N] [--out TABLE.csv] FOLDER...

FOLDER: its .gltf and .glb files, with all below. Where it has a cases.json (gltf_cases.py), files are read or refused as
it says. A file passes where each command ends with status 0, or with 1 or 2 and one line that begins with voxray:, and
where the mean of the voxel variant is within 1 % of the reference's. Exit status 1: one did not.
"""
import argparse
import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PROGRAM = os.environ.get("VOXRAY_PROGRAM", str(pathlib.Path(__file__).parents[2] / "build/release/bin/voxray"))
TOLERANCE = 0.01
CONFIG = """\
name: chain
scene: {{file: "{file}", materials: lambert, {camera}{light}}}
image: {{width: 48, height: 48}}
tracer: embree
graph:
  - {{pass: gbuffer, samples_per_pixel_edge: 4}}
  - {{pass: voxelize, resolution: 48}}
  - {{pass: inject_light_rays, rays_per_light: 1048576, bounces: 7}}
  - {{pass: trace_gather_rays, rays_per_block: 64, block: 4}}
  - {{pass: gather_rays}}
  - {{pass: direct_shadow_rays}}
  - {{pass: composite}}
reference: {{pass: path_trace, spp: 1024, bounces: 8}}
measure: {{frames: 1, warmup: 0}}
"""


class Failed(Exception):
    """What a file did that none should."""


def voxray(*words):
    """@return standard output, and the message where the command refuses"""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, errors="replace", timeout=1200)
    lines = [line for line in done.stderr.splitlines() if line.startswith("voxray: error:")]
    if done.returncode not in (0, 1, 2) or (done.returncode != 0 and not lines) or "Sanitizer" in done.stderr:
        raise Failed(f"{words[0]}: status {done.returncode}: {done.stderr[-300:]!r}")
    return done.stdout, lines[0].removeprefix("voxray: error: ") if done.returncode else ""


def chain(file, folder):
    """@return 'refused' and the message, or 'read' and the ratio of means"""
    told, message = voxray("scene", file)
    if message:
        return "refused", message
    camera = re.findall(r"camera: \{.*\}", told)
    light = "" if "nothing shines" not in told else ", environment: 1"
    config = folder / "chain.yaml"
    config.write_text(CONFIG.format(file=str(file).replace('"', '\\"'), camera=camera[-1], light=light))
    for command in (["validate", config], ["run", config, "--out", folder / "out"]):
        told, message = voxray(*command)
        if message:
            raise Failed(f"{command[0]}: {message}")
    with open(folder / "out" / "results.csv", newline="") as table:
        row = next(csv.DictReader(table))
    return "read", float(row["mean_ratio"] or "nan")


def files_of(folder):
    """Pairs of a file and whether it is to be read; None: either."""
    cases = folder / "cases.json"
    expected = json.loads(cases.read_text()) if cases.exists() else {}
    found = sorted(p for p in folder.rglob("*") if p.suffix.lower() in (".gltf", ".glb"))
    return [(file, expected.get(str(file.relative_to(folder)))) for file in found]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--every", type=int, default=1, help="take each Nth file only")
    parser.add_argument("--out", type=pathlib.Path, help="write a table")
    parser.add_argument("folder", type=pathlib.Path, nargs="+")
    arguments = parser.parse_args()
    rows = []
    files = [entry for folder in arguments.folder for entry in files_of(folder.resolve())]
    for file, good in files[::arguments.every]:
        with tempfile.TemporaryDirectory() as temporary:
            try:
                outcome, value = chain(file, pathlib.Path(temporary))
                fault = (good is not None and good != (outcome == "read")) or (
                    outcome == "read" and not abs(value - 1) <= TOLERANCE)
            except (Failed, subprocess.TimeoutExpired) as error:
                outcome, value, fault = "failed", str(error), True
        rows.append((str(file), outcome, value, "FAULT" if fault else ""))
        print(*rows[-1], sep="\t", flush=True)
    faults = sum(row[3] != "" for row in rows)
    print(f"{len(rows)} files: {sum(r[1] == 'read' for r in rows)} read, "
          f"{sum(r[1] == 'refused' for r in rows)} refused, {faults} at fault")
    if arguments.out:
        with open(arguments.out, "w", newline="") as table:
            csv.writer(table).writerows([("file", "outcome", "value", "fault"), *rows])
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
