#!/usr/bin/python3
"""Makes packs of docs/packs again, as packs.toml there says.

make_packs.py NAME... [--program PROGRAM] [--results DIR]

Do so where what `voxray verify` of a pack finds is a change that was meant. Commit first: a pack names the commit that made it.
"""
import argparse
import shlex
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PACKS = ROOT / "docs" / "packs"


def definitions():
    with open(PACKS / "packs.toml", "rb") as file:
        return tomllib.load(file)


def main():
    known = definitions()
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("name", nargs="+", metavar="NAME", choices=list(known), help=", ".join(known))
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/voxray"))
    parser.add_argument("--results", type=Path, metavar="DIR", help="folder that keeps results of the runs; one that is there is packed")
    options = parser.parse_args()
    for name in options.name:
        with tempfile.TemporaryDirectory() as scratch:
            results = ["--results", str((options.results or Path(scratch)) / name), "--resume"]
            done = subprocess.run([options.program, "pack", known[name]["config"], *shlex.split(known[name]["options"]), *results,
                                   "--out", str(PACKS / f"{name}.zip")], cwd=ROOT, check=False)
            if done.returncode:
                sys.exit(done.returncode)


if __name__ == "__main__":
    main()
