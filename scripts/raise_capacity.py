#!/usr/bin/python3
"""Seok 2021's search for the capacity p of hybrid leaves (chapter 4, figure 22), by runs of a config.

raise_capacity.py CONFIG [--pass ID] [--start P] [--minimize MEASURE] [--trials N] [--out DIR] [--run OPTION=VALUE]...

Raises `primitives` of the pass ID by the mean number of triangles in leaves that have grids, as the last trial that was kept
reports it. Where MEASURE, a sum as in tune.py, grows, it goes back to that trial and halves the step, for good: the thesis doesn't
say whether a step that follows is whole again. Ends where no leaf has a grid, where a step is below 1, or after N trials. The config
must make one variant. Prints the trail, writes trail.csv and the chosen config, chosen.yaml, into DIR; trials that are there already
are not run again. Exit status: 0 found, 1 the first trial failed, 2 a wrong argument.
"""
import argparse
import math
import sys

sys.dont_write_bytecode = True
import tune  # noqa: E402

IN_GRIDS, GRIDS = '"triangles in leaves with grids"', '"leaves with a grid"'


class Capacities:
    """Trials by their capacity."""

    def __init__(self, options):
        options.limit = []
        self.trials = tune.Trials(options, f"{getattr(options, 'pass')}.primitives", [])

    def cost(self, capacity):
        """What is minimized, infinite where the trial failed."""
        if str(capacity) not in self.trials.values:
            self.trials.values.append(str(capacity))
        return self.trials.cost(self.trials.values.index(str(capacity)))[1]

    def mean_in_grids(self, capacity):
        """Mean number of triangles in leaves with grids; 0 where there are none."""
        folder = self.trials.folder(self.trials.values.index(str(capacity)))
        grids = tune.measure(folder, GRIDS)
        return tune.measure(folder, IN_GRIDS) / grids if grids else 0


def search(cost, mean_in_grids, start, trials):
    """The capacity that the search ends at. cost(capacity) and mean_in_grids(capacity) are as in Capacities."""
    kept, least, part = start, cost(start), 1.0
    for _ in range(trials - 1):
        step = round(part * mean_in_grids(kept))
        if step < 1 or math.isinf(least):
            break
        now = cost(kept + step)
        if now > least:
            part /= 2
        else:
            kept, least = kept + step, now
    return kept


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("config", metavar="CONFIG")
    parser.add_argument("--pass", default="leaves", metavar="ID")
    parser.add_argument("--start", type=int, default=16, metavar="P")
    parser.add_argument("--minimize", default="leaves.ms+mirror.ms", metavar="MEASURE")
    parser.add_argument("--trials", type=int, default=8, metavar="N")
    parser.add_argument("--out", default="results/capacity", metavar="DIR")
    parser.add_argument("--run", action="append", default=[], metavar="OPTION=VALUE")
    options = parser.parse_args()
    try:
        if options.start < 1 or options.trials < 2:
            raise tune.UsageError("--start: at least 1; --trials: at least 2")
        capacities = Capacities(options)
        found = search(capacities.cost, capacities.mean_in_grids, options.start, options.trials)
        least = capacities.cost(found)
        if math.isinf(least):
            print(f"raise_capacity: error: the trial of {found} failed", file=sys.stderr)
            return 1
        tune.write_results(capacities.trials)
    except tune.UsageError as error:
        print(f"raise_capacity: error: {error}", file=sys.stderr)
        return 2
    print(f"{capacities.trials.path}={found}: {options.minimize} {least:g}, after {len(capacities.trials.costs)} trials")
    return 0


if __name__ == "__main__":
    sys.exit(main())
