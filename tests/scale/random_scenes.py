#!/usr/bin/env python3
"""Random scenes through the chain that most configs have, with the validation layer on, against the reference.

    tests/scale/random_scenes.py build/release/bin/voxray --runs 1000

Each scene runs through voxelize, inject_light_rays, trace_gather_rays and gather_rays at 32 x 32 pixels. A scene misses
where anything fails, or where the mean of the indirect light is off by more than 3 % and is not negligible next to the
direct light. Ends with a list of misses and what is awkward about
each; exit status 1 where there is any. The same seed is the same scene: --first 17 --runs 1 --keep DIR looks at one.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

from scene_maker import make

CHAIN = [{"gbuffer": {"samples_per_pixel_edge": 3}}, "voxelize", {"inject_light_rays": {"rays_per_light": 262144, "bounces": 7}},
         {"trace_gather_rays": {"rays_per_block": 32}}, "gather_rays", "direct_shadow_rays", "composite"]
LARGEST_ERROR = 0.03     # Of the mean
NEGLIGIBLE = 0.02        # Of the whole image's light
BATCH = 25


def passes(resolution):
    for entry in CHAIN:
        name, parameters = (entry, {}) if isinstance(entry, str) else next(iter(entry.items()))
        yield {"pass": name, **({"resolution": resolution} if name == "voxelize" else parameters)}


def run_batch(program, seeds, folder):
    """Runs the scenes of some seeds. @return by seed: what is awkward about it, and its miss, else None."""
    found, by_resolution = {}, {}
    for seed in seeds:
        scene, resolution, tags = make(seed, os.path.join(folder, f"{seed}.glb"))
        found[seed] = [tags, "it has no result"]
        by_resolution.setdefault(resolution, {})[f"s{seed}"] = scene
    for resolution, scenes in by_resolution.items():
        first = next(iter(scenes.values()))
        config = {"name": f"r{resolution}", "scene": first, "image": {"width": 32, "height": 32}, "seed": 1,
                  "graph": list(passes(resolution)), "reference": {"pass": "path_trace", "spp": 1024, "bounces": 8},
                  "measure": {"frames": 1, "warmup": 0, "second_seed": False, "metrics": ["nrmse", "mean_ratio"]}}
        if len(scenes) > 1:
            config["sweep"] = {"scene": scenes}
        file, out = os.path.join(folder, f"r{resolution}.yaml"), os.path.join(folder, f"out{resolution}")
        with open(file, "w", encoding="utf-8") as written:
            json.dump(config, written, indent=1)
        done = subprocess.run([program, "run", file, "--validate", "--out", out, "--no-report"], capture_output=True,
                              text=True, check=False)
        for seed in (int(name[1:]) for name in scenes):
            found[seed][1] = f"exit {done.returncode}: {done.stderr.strip()[-600:]}" if done.returncode else None
        compare(out, scenes, found)
    return found


def compare(out, scenes, found):
    table = os.path.join(out, "results.csv")
    if not os.path.exists(table):
        return
    with open(table, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            name = row["scene"] if len(scenes) > 1 else next(iter(scenes))
            found[int(name[1:])][1] = miss(row)


def miss(row):
    if row["status"] != "ok":
        return f"failed: {row['error']}"
    error, of_all = float(row["indirect_mean_ratio"]) - 1, float(row["mean_ratio"]) - 1
    # Direct light is exact: what the whole is off by is the indirect light's part of it
    if abs(error) < LARGEST_ERROR or abs(of_all) < NEGLIGIBLE * abs(error):
        return None
    return f"the indirect light's mean is off by {100 * error:+.2f} %, that of all light by {100 * of_all:+.2f} %"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--first", type=int, default=1, help="the first seed")
    parser.add_argument("--keep", help="a folder for scenes, configs and results")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    misses = 0
    for first in range(arguments.first, arguments.first + arguments.runs, BATCH):
        seeds = range(first, min(first + BATCH, arguments.first + arguments.runs))
        with tempfile.TemporaryDirectory() as scratch:
            folder = os.path.abspath(os.path.join(arguments.keep, str(first))) if arguments.keep else scratch
            os.makedirs(folder, exist_ok=True)
            for seed, (tags, what) in run_batch(program, seeds, folder).items():
                if what:
                    misses += 1
                    print(f"seed {seed} ({', '.join(tags)}): {what}", flush=True)
        print(f"{seeds.stop - arguments.first} scenes, {misses} misses", flush=True)
    sys.exit(1 if misses else 0)


if __name__ == "__main__":
    main()
