#!/usr/bin/env python3
"""Prints what part of indirect light filter_irradiance keeps, by scene: the mean of its image over that of the same rays
without it, with the standard error over seeds. Arguments: the program, a folder for results, the number of seeds, and
further arguments of `run`, such as `--only scene=sponza`. Runs configs/bench/filter_energy.yaml."""
import statistics
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "framework"))
from report import exr_pixels  # noqa: E402


def main(program, out, seeds, *arguments):
    ratios = defaultdict(list)
    for seed in range(1, int(seeds) + 1):
        folder = Path(out) / str(seed)
        subprocess.run([program, "run", str(ROOT / "configs/bench/filter_energy.yaml"), "--set", f"seed={seed}", "--out",
                        str(folder), *arguments], check=True, stdout=subprocess.DEVNULL)
        means = {path.parent.name: exr_pixels.rgb(path).mean() for path in (folder / "images").glob("*/indirect.exr")}
        for name, mean in means.items():
            if name.endswith("-filtered"):
                ratios[name.split("-")[0]].append(mean / means[name.removesuffix("filtered") + "unfiltered"])
    print("| scene | filtered over unfiltered | standard error |\n| --- | --- | --- |")
    for scene, values in sorted(ratios.items()):
        error = statistics.stdev(values) / len(values) ** 0.5 if len(values) > 1 else float("nan")
        print(f"| `{scene}` | {statistics.mean(values):.5f} | {error:.5f} |")


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
