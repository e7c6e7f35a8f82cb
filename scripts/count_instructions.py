#!/usr/bin/python3
"""Counts the instructions of a run by what executes them, on software Vulkan: a cost that no other work on the machine changes.

count_instructions.py CONFIG [--program PROGRAM] [--set PATH=VALUE ...]

Runs PROGRAM (build/release/bin/voxray by default) on one thread under valgrind's callgrind, some fifty times slower than without: take a
small config, such as configs/bench/instructions.yaml. Shaders are what the driver compiled, by its own code. Counts of the driver's compiler
depend on what its cache holds and are not printed. Run it twice: the first run compiles shaders, which counts as Voxray's.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
LINE = re.compile(r"\s*([\d,]+) \([ \d.]+%\)\s+(.*)")
KINDS = {"shaders": "[???]", "Embree": "embree", "Voxray": "bin/voxray"}  # By what callgrind calls their object.


def by_kind(annotated):
    """Instructions by kind, of callgrind_annotate's table of functions."""
    counts = dict.fromkeys(KINDS, 0)
    for line in annotated.splitlines():
        entry = LINE.match(line)
        kind = entry and next((k for k, mark in KINDS.items() if mark in entry.group(2)), None)
        if kind:
            counts[kind] += int(entry.group(1).replace(",", ""))
    return counts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("config")
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/voxray"))
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE")
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        sys.exit("count_instructions: valgrind was not found: install Debian's package 'valgrind'")
    with tempfile.TemporaryDirectory() as folder:
        profile = os.path.join(folder, "profile")
        run = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}", options.program, "run", options.config,
               "--out", os.path.join(folder, "out"), "--no-report", "--quiet", "--threads", "1"]
        done = subprocess.run(run + [word for change in options.set for word in ("--set", change)],
                              stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(f"count_instructions: the run failed\n{done.stderr}")
        table = subprocess.run(["callgrind_annotate", "--threshold=100", profile], check=True, capture_output=True, text=True)
    for kind, count in by_kind(table.stdout).items():
        print(f"{kind:8} {count:>16,}")


if __name__ == "__main__":
    main()
