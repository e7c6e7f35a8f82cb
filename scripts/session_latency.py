#!/usr/bin/python3
"""Times changes of a session: from a value that is set to the new image, over the time of that image's own frame.

session_latency.py CONFIG PATH VALUE VALUE... [--profile NAME] [--set PATH=VALUE...] [--repeat N]: sets the values (JSON) by turns,
each N times, and prints the median of the time to the image in ms, of its frame, of both parts of the rest (set, and the
rest of the render), and their ratio.
"""
import argparse
import json
import statistics
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1] / "framework" / "python"))
import voxray  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("config")
    parser.add_argument("path")
    parser.add_argument("values", nargs="+", type=json.loads)
    parser.add_argument("--profile")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE")
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    words = [word for one in options.set for word in ("--set", one)]
    times = []
    with voxray.open(options.config, profile=options.profile, options=words) as study:
        study.render()
        for number in range(options.repeat * len(options.values)):
            start = time.perf_counter()
            study.set(options.path, options.values[number % len(options.values)])
            middle = time.perf_counter()
            frame = study.render().frame_ms
            end = time.perf_counter()
            times.append((1000 * (end - start), frame, 1000 * (middle - start), 1000 * (end - middle) - frame, 1000 * (end - start) / frame))
    total, frame, of_set, rest, ratio = (statistics.median(column) for column in zip(*times))
    print(f"to the image {total:.1f} ms, its frame {frame:.1f} ms, set {of_set:.1f} ms, rest of the render {rest:.1f} ms; ratio {ratio:.2f}")


if __name__ == "__main__":
    main()
