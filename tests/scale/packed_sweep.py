#!/usr/bin/python3
"""How long a sweep takes on Snakemake, packed, against `run`: the same untimed variants on the same number of threads.

packed_sweep.py PROGRAM [--variants N] [--size WxH] [--spp N] [--cores N] [--out DIR]: each of both with an empty cache of
references and a full one of shaders. Prints the time of each, of one variant, the ratio, and whether all scores are the
same. Exit status 1: they differ."""
import argparse
import csv
import os
import shutil
import subprocess
import sys
import time

CONFIG = """\
name: packed
scene: {{builtin: cornell}}
image: {{width: {width}, height: {height}}}
graph:
  - {{pass: path_trace, id: trace, spp: {spp}, bounces: 4}}
reference: {{pass: path_trace, spp: {spp}, bounces: 32}}
sweep: {{trace.bounces: [{bounces}]}}
measure: {{frames: 1, warmup: 0}}
"""


def scores(folder):
    with open(os.path.join(folder, "results.csv"), newline="", encoding="utf-8") as file:
        return [{key: value for key, value in row.items() if "ms" not in key.split("_")} for row in csv.DictReader(file)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--variants", type=int, default=20)
    parser.add_argument("--size", default="320x180")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--cores", type=int, default=2)
    parser.add_argument("--out", default="packed_sweep")
    options = parser.parse_args()
    program, folder = os.path.abspath(options.program), os.path.abspath(options.out)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    width, height = options.size.split("x")
    config = os.path.join(folder, "packed.yaml")
    with open(config, "w", encoding="utf-8") as file:
        file.write(CONFIG.format(width=width, height=height, spp=options.spp,
                                 bounces=", ".join(str(8 + i) for i in range(options.variants))))
    environment = dict(os.environ, VOXRAY_CACHE=os.path.join(folder, "cache"))

    def timed(*arguments):
        shutil.rmtree(os.path.join(folder, "cache", "references"), ignore_errors=True)
        began = time.monotonic()
        subprocess.run([program, *arguments], cwd=folder, env=environment, check=True, stdout=subprocess.DEVNULL)
        return time.monotonic() - began

    timed("run", config, "--out", "warm", "--set", "image.width=16", "--set", "image.height=16", "--set", "sweep={trace.bounces: [1]}")
    whole = timed("run", config, "--out", "whole", "--threads", str(options.cores))
    packed = timed("sweep", config, "--out", "packed", "--cores", str(options.cores), "--untimed")
    same = scores(os.path.join(folder, "whole")) == scores(os.path.join(folder, "packed"))
    print(f"run {whole:.1f} s ({whole / options.variants:.1f} s a variant), sweep --cores {options.cores} {packed:.1f} s: "
          f"{packed / whole:.3f} times as long; scores {'are the same' if same else 'differ'}; "
          f"load before it ended {os.getloadavg()[0]:.2f}")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
