#!/usr/bin/python3
"""Searches a parameter's values for the cheapest one within limits, by runs of a config.

tune.py CONFIG --vary PATH=V1,V2,... [--minimize MEASURE] [--limit MEASURE=NUMBER]... [--trials N] [--every] [--out DIR]
        [--run OPTION=VALUE]...

PATH is a dotted path as `voxray run --set` takes it, its values stand in order. A MEASURE is a sum, as leaves.ms+mirror.ms, of
  PASS.ms, PASS.memory_bytes ...  columns of passes.csv (ms: ms_median), by the pass's id, summed over building and frames
  COLUMN                          a column of results.csv (frame_ms_median, memory_bytes, flip@mirror ...)
  a name in quotation marks       a row of values.csv ('"bytes of grids"')
The config must make one variant. A value is better than another where it exceeds the limits by less, and at the same excess,
such as none, where MEASURE is smaller. Where that has one valley along the values, a Fibonacci search (Kiefer 1953) finds its
bottom; trials that are left then go to the largest gaps between values tried, lest there be another valley. A trial that failed
counts as beyond all limits. Trials that are there already, in DIR, are not run again.

--every tries all values in place of a search: how good a found value is. Prints the trail, writes trail.csv and the chosen
config, chosen.yaml, into DIR. Exit status: 0 found, 1 no value keeps the limits, 2 a wrong argument.
"""
import argparse
import csv
import json
import math
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
sys.dont_write_bytecode = True
sys.path.append(os.path.join(ROOT, "framework"))
from orchestration.errors import UsageError  # noqa: E402
from orchestration.yaml_text import yaml_lines  # noqa: E402
from report.rows import read_rows  # noqa: E402

PROGRAM = os.environ.get("VOXRAY_PROGRAM", os.path.join(ROOT, "voxray"))


def rows(folder, name):
    return read_rows(folder, name) if os.path.exists(os.path.join(folder, name)) else []


def number(text):
    try:
        return float(text)
    except ValueError:
        raise UsageError(f"'{text}' is not a number") from None


def part(folder, name):
    """One term of a measure."""
    if name.startswith('"'):
        found = [row["value"] for row in rows(folder, "values.csv") if row["name"] == name.strip('"')]
        if not found:
            raise UsageError(f"values.csv has no {name}")
        return number(found[-1])
    result = rows(folder, "results.csv")[0]
    if name in result:
        return number(result[name])
    owner, _, column = name.rpartition(".")
    column = "ms_median" if column == "ms" else column
    found = [row for row in rows(folder, "passes.csv") if row["pass"] == owner]
    if not found or column not in found[0]:
        raise UsageError(f"'{name}' is no column of results.csv, and no pass with a column of passes.csv")
    return sum(number(row[column]) for row in found if row[column])


def measure(folder, terms):
    return sum(part(folder, name.strip()) for name in terms.split("+"))


class Trials:
    """Runs values, each once, and compares them."""

    def __init__(self, options, path, values):
        self.options, self.path, self.values = options, path, values
        self.costs = {}  # By place among the values: (excess over limits, what is minimized).
        self.limits = []
        for text in options.limit:
            terms, separator, bound = text.rpartition("=")
            if not separator or not number(bound) > 0:
                raise UsageError(f"--limit {text}: expected MEASURE=NUMBER, with a number above 0")
            self.limits.append((terms, number(bound)))

    def folder(self, at):
        return os.path.join(self.options.out, f"{self.path}-{self.values[at]}")

    def run(self, at):
        command = [PROGRAM, "run", self.options.config, "--set", f"{self.path}={self.values[at]}", "--out", self.folder(at)]
        for option in self.options.run:
            name, separator, value = option.partition("=")
            command += [f"--{name}"] + ([value] if separator else [])
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode == 2:
            raise UsageError(done.stderr.strip().splitlines()[-1])

    def cost(self, at):
        if at in self.costs:
            return self.costs[at]
        folder = self.folder(at)
        if not os.path.exists(os.path.join(folder, "results.csv")):
            self.run(at)
        results = rows(folder, "results.csv")
        if len(results) > 1:
            raise UsageError(f"{self.options.config} makes {len(results)} variants: a trial is one; take its sweep out, or set it")
        if not results or results[0]["status"] != "ok":
            self.costs[at] = (math.inf, math.inf)
            return self.costs[at]
        found = [measure(folder, terms) for terms, _ in self.limits]
        excess = sum(max(value / bound - 1, 0) for value, (_, bound) in zip(found, self.limits))
        self.costs[at] = (excess, measure(folder, self.options.minimize))
        print(f"{self.path}={self.values[at]}: {self.options.minimize} {self.costs[at][1]:g}" +
              "".join(f", {terms} {value:g}{' > ' + format(bound, 'g') if value > bound else ''}"
                      for (terms, bound), value in zip(self.limits, found)), flush=True)
        return self.costs[at]

    def best(self):
        return min(self.costs, key=lambda at: (self.costs[at], at))


def search(cost, count, trials):
    """Calls cost(place) of places 0 to count - 1, at most `trials` of them: a Fibonacci search, then the largest gaps."""
    tried = set()

    def of(place):
        if place >= count:  # The search's length is a Fibonacci number: beyond the last place all is worse.
            return (math.inf, math.inf, place)
        tried.add(place)
        return (*cost(place), 0)

    before, last = 1, 1
    while last < count + 1:
        before, last = last, before + last
    first, end = -1, last - 1  # Open ends: places between them are left.
    while end - first > 1 and len(tried) < trials:
        step = last - before  # Of both sides of the two places that are compared.
        low, high = first + step, end - step
        if low == high or low > high:
            of(min(low, high))
            break
        if of(low) <= of(high):
            end = high
        else:
            first = low
        before, last = last - before, before
    while len(tried) < min(trials, count):
        marks = [-1, *sorted(tried), count]
        gap, start = max((b - a, -a) for a, b in zip(marks, marks[1:]))
        of(-start + gap // 2)


def write_results(trials):
    out, options = trials.options.out, trials.options
    with open(os.path.join(out, "trail.csv"), "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([trials.path, "excess", options.minimize])
        writer.writerows([trials.values[at], *cost] for at, cost in trials.costs.items())
    best = trials.best()
    with open(os.path.join(trials.folder(best), "manifest.json"), encoding="utf-8") as file:
        config = json.load(file)["config"]
    with open(os.path.join(out, "chosen.yaml"), "w", encoding="utf-8") as file:
        file.write(f"# {trials.path}={trials.values[best]}: the least {options.minimize} of {len(trials.costs)} trials" +
                   "".join(f", {limit}" for limit in options.limit) + ".\n")
        file.write("\n".join(yaml_lines(config)) + "\n")
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("config", metavar="CONFIG")
    parser.add_argument("--vary", required=True, metavar="PATH=V1,V2,...")
    parser.add_argument("--minimize", default="frame_ms_median", metavar="MEASURE")
    parser.add_argument("--limit", action="append", default=[], metavar="MEASURE=NUMBER")
    parser.add_argument("--trials", type=int, default=8, metavar="N")
    parser.add_argument("--every", action="store_true")
    parser.add_argument("--out", default="results/tune", metavar="DIR")
    parser.add_argument("--run", action="append", default=[], metavar="OPTION=VALUE")
    options = parser.parse_args()
    try:
        path, separator, listed = options.vary.partition("=")
        values = listed.split(",")
        if not separator or len(values) < 2 or "" in values or len(set(values)) < len(values):
            raise UsageError(f"--vary {options.vary}: expected PATH=V1,V2,..., with two different values or more")
        if options.trials < 2:
            raise UsageError("--trials: at least 2")
        trials = Trials(options, path, values)
        if options.every:
            for at in range(len(values)):
                trials.cost(at)
        else:
            search(trials.cost, len(values), options.trials)
        best = write_results(trials)
    except UsageError as error:
        print(f"tune: error: {error}", file=sys.stderr)
        return 2
    excess, least = trials.costs[best]
    print(f"{path}={values[best]}: {options.minimize} {least:g}, after {len(trials.costs)} of {len(values)} values; "
          f"{os.path.join(options.out, 'chosen.yaml')}")
    if excess > 0:
        print("tune: error: no value keeps the limits; this one came closest", file=sys.stderr)
    return 1 if excess > 0 else 0


if __name__ == "__main__":
    sys.exit(main())
