#!/usr/bin/python3
"""Writes tables of docs/papers from results that are kept beside them, and measures those results.

paper_tables.py [--measure RUN...] [--take RUN=DIR... --commit COMMIT] [--times DIR...] [--out DIR] [--program PROGRAM] [--root ROOT]

Writes each table into the page that has a line "<!-- table: NAME -->", in place of the table below that line. With --measure the
runs named are made first, by the build in build/release; with --take their results are read from a folder DIR, to which another
machine's were brought, say; --times keeps how long the runs in such folders took. tests/repository/docs.py fails where a page says something else.

docs/papers/tables/PAPER.toml has
- [run.NAME]: `command` and `values`: by a name, where the run has the value. A command is
  - the arguments of the program. A value is a column of results.csv, "PASS.PHASE.COLUMN" of passes.csv, "PASS.NAME" of values.csv
    (the median over its frames), or a noise floor of manifest.json, as "flip_noise". With `script`, one that prints a table of the
    run's folder, "SCRIPT.COLUMN" of that table, too, whose first column has the variants;
  - "bench FILTER", benchmarks of a build's bench programs: their variants are their names, values counters, cpu_time or real_time;
  - "scripts/SEARCH.py ARGUMENTS", a search whose trials are variants, in the order tried;
- [table.NAME]: `run`; `heading` of the first column; `rows`: by variant, what stands there; `columns`: by heading, either a cell
  of each row in order, or one text for all rows in which {EXPRESSION:FORMAT} is Python's expression of the run's values,
  `variant` the row's, and `of["VARIANT"]["NAME"]` a value of another row;
- or, for a table of several runs: `columns`, its headings, and `lines`, the cells of each line, with
  `of["RUN"]["VARIANT"]["NAME"]`. Expressions have min and max besides.
docs/papers/tables/NAME.csv has the values of a run by variant; its first line has the commit, the device and the command.
docs/papers/tables/times.csv has the seconds that a run took. A table named replicate_PAGE lists the tables of docs/papers/PAGE.md,
with what makes each (scripts/replicate_tables.py).
Where the results of a run were not kept, its CSV was copied from the page, and its first line says so; --measure writes a measured one.
"""
import argparse
import csv
import json
import os
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.append(str(ROOT / "framework"))
sys.path.append(str(ROOT / "scripts"))
import replicate_tables  # noqa: E402
from report.rows import markdown_table, read_rows  # noqa: E402

TABLE = re.compile(r"^<!-- table: (\S+) -->\n((?:\|.*\n)*)", re.M)
FIELD = re.compile(r"\{([^{}]*?)(?::([^{}:]*))?\}")


class TableError(Exception):
    """A table, a run or a page that doesn't fit the others; the message says which."""


def definitions(root):
    """(runs, tables) of all papers: each by name."""
    runs, tables = {}, {}
    for path in sorted((root / "docs/papers/tables").glob("*.toml")):
        with open(path, "rb") as file:
            read = tomllib.load(file)
        for kind, found in (("run", runs), ("table", tables)):
            for name, entry in read.get(kind, {}).items():
                if name in found:
                    raise TableError(f"{path}: {kind} {name} is defined twice")
                found[name] = entry
    return runs, tables


def csv_path(root, run):
    return root / "docs/papers/tables" / f"{run}.csv"


def values_of(folder):
    """What a run measured: by variant, by the name that `values` uses."""
    found = {row["variant"]: {k: v for k, v in row.items() if v} for row in read_rows(folder, "results.csv") if row["status"] == "ok"}
    for row in read_rows(folder, "passes.csv"):
        prefix = f"{row['pass']}.{row['phase']}"
        found.get(row["variant"], {}).update({f"{prefix}.{k}": v for k, v in row.items()})
    reported = {}
    if (Path(folder) / "values.csv").exists():
        for row in read_rows(folder, "values.csv"):
            reported.setdefault((row["variant"], f"{row['pass']}.{row['name']}"), []).append(float(row["value"]))
    for (variant, name), values in reported.items():
        found.get(variant, {})[name] = str(statistics.median(values))
    with open(Path(folder) / "manifest.json", encoding="utf-8") as file:
        references = json.load(file).get("references", [])
    for reference in references:
        floors = {k: str(v) for k, v in reference.items() if re.search("_noise$", k)}
        for variant in reference["variants"]:
            found.get(variant, {}).update(floors)
    return found


def commit_of(root):
    """The commit, with "-dirty" where anything but docs, which no result depends on, differs from it."""
    def git(*arguments):
        return subprocess.run(["git", *arguments], cwd=root, check=True, capture_output=True, text=True).stdout.strip()
    return git("describe", "--always") + ("-dirty" if git("status", "--porcelain", "--", ".", ":!docs") else "")


def printed_values(table, prefix):
    """Values of a Markdown table that a script printed: by its first cell, by "PREFIX.COLUMN"."""
    headings, _, *rows = ([cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines() if line.startswith("|"))
    return {row[0]: {f"{prefix}.{h}": cell for h, cell in zip(headings[1:], row[1:])} for row in rows}


def results_of(root, run, out):
    """(device, values by variant) of a config's run, whose results lie in a folder."""
    found = values_of(out)
    device = next(iter(found.values()))["device"]
    if script := run.get("script"):
        done = subprocess.run([sys.executable, script, str(out)], cwd=root, check=True, capture_output=True, text=True)
        for variant, values in printed_values(done.stdout, Path(script).stem).items():
            found[variant].update(values)
    return device, found


def measure_bench(root, run):
    """The same of benchmarks. They count CPU time, of the machine that the device says."""
    benchmarks, context = [], {}
    for program in sorted((root / "build/release").rglob("bench_*")):
        if program.is_file() and os.access(program, os.X_OK):
            which = f"--benchmark_filter={shlex.split(run['command'])[1]}"
            if subprocess.run([program, "--benchmark_list_tests", which], capture_output=True, check=False).stdout:
                done = subprocess.run([program, which, "--benchmark_format=json"], cwd=root, check=True, capture_output=True, text=True)
                context, found = (json.loads(done.stdout)[key] for key in ("context", "benchmarks"))
                benchmarks += found
    if not benchmarks:
        raise TableError(f"no benchmark of {root / 'build/release'} matches '{run['command']}': build it first")
    return f"{context['num_cpus']} cores", {re.sub("/(iterations:|process_time).*", "", b["name"]): b for b in benchmarks}


def measure_search(root, run, program, out):
    """The same of a search's trials."""
    environment = {**os.environ, "VOXRAY_PROGRAM": program}
    subprocess.run([sys.executable, *shlex.split(run["command"]), "--out", str(out)], cwd=root, check=True, env=environment)
    found = {}
    for trial in read_rows(out, "trail.csv"):
        path = next(iter(trial))
        values, = values_of(out / f"{path}-{trial[path]}").values()
        found[trial[path]] = values
    return next(iter(found.values()))["device"], found


def measure(root, name, run, program, kept_in=None):
    """Makes the run and writes its CSV. `kept_in`: a folder that keeps the run's results; variants that are there already stay."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(kept_in or folder) / name
        start, is_new = time.monotonic(), not out.exists()
        if run["command"].startswith(("bench ", "scripts/")):
            is_bench = run["command"].startswith("bench ")
            device, found = measure_bench(root, run) if is_bench else measure_search(root, run, program, out)
            if is_new:
                replicate_tables.keep_seconds(root, {name: time.monotonic() - start})
        else:
            resume = ["--resume"] if kept_in else []
            subprocess.run([program, *shlex.split(run["command"]), "--out", str(out), *resume], cwd=root, check=True)
            replicate_tables.keep_times(root, {name: out})
            device, found = results_of(root, run, out)
        keep(root, name, run, device, found)


def keep(root, name, run, device, found, commit=None):
    """Writes the CSV of a run. `found`: see values_of()."""
    with open(csv_path(root, name), "w", newline="", encoding="utf-8") as file:
        file.write(f"# {commit or commit_of(root)}; {device}; {run['command']}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["variant", *run["values"]])
        for variant, values in found.items():
            row = [values.get(source, "") for source in run["values"].values()]
            if any(row):
                writer.writerow([variant, *row])


def kept(root, run):
    """Values of a run's CSV: by variant and name; those that a variant has not are left out."""
    path = csv_path(root, run)
    if not path.exists():
        raise TableError(f"no {path.relative_to(root)}: paper_tables.py --measure {run}")
    with open(path, newline="", encoding="utf-8") as file:
        file.readline()
        return {row.pop("variant"): {k: float(v) for k, v in row.items() if v} for row in csv.DictReader(file)}


class Runs(dict):
    """Values of runs by name, read when asked for."""

    def __init__(self, root):
        super().__init__()
        self.root = root

    def __missing__(self, run):
        self[run] = kept(self.root, run)
        return self[run]


def cell(template, names, where):
    """A cell's text; `names`: what its expressions may use, `where`: for messages."""
    def value(match):
        return format(eval(match[1], {"__builtins__": {}, "min": min, "max": max}, names), match[2] or "")
    try:
        return FIELD.sub(value, template)
    except (NameError, KeyError) as error:
        raise TableError(f"table {where}: {error}") from None


def table_lines(root, name, table):
    """The table as Markdown."""
    if "lines" in table:
        headings, names = table["columns"], {"of": Runs(root)}
        rows = [[cell(template, names, f"{name}, {line[0]}") for template in line] for line in table["lines"]]
        return "".join(line + "\n" for line in markdown_table(headings, rows))
    of = kept(root, table["run"])
    rows = [[label] for label in table["rows"].values()]
    for number, (variant, row) in enumerate(zip(table["rows"], rows)):
        if variant not in of:
            raise TableError(f"table {name}: no variant {variant} in the results of {table['run']}")
        names = {**of[variant], "variant": variant, "of": of}
        row.extend(cell(column if isinstance(column, str) else column[number], names, f"{name}, {variant}")
                   for column in table["columns"].values())
    return "".join(line + "\n" for line in markdown_table([table["heading"], *table["columns"]], rows))


def replicate_lines(root, name):
    """The table of what makes the tables of a page."""
    path = root / "docs/papers" / f"{name.removeprefix(replicate_tables.PREFIX)}.md"
    if not path.exists():
        raise TableError(f"table {name}: no {path.relative_to(root)}")
    runs, tables = definitions(root)
    rows = replicate_tables.rows(root, path, {n: (table, table_lines(root, n, table)) for n, table in tables.items()}, runs,
                                 replicate_tables.kept_times(root))
    return "".join(line + "\n" for line in markdown_table(replicate_tables.HEADINGS, rows))


def pages(root):
    """(path, text as it is, text with its tables as the results have them) of each page with tables."""
    _, tables = definitions(root)
    shown = set()

    def written(match):
        if match[1].startswith(replicate_tables.PREFIX):
            return match[0][:match.start(2) - match.start()] + replicate_lines(root, match[1])
        if match[1] not in tables:
            raise TableError(f"{path.relative_to(root)}: no table {match[1]} in docs/papers/tables")
        shown.add(match[1])
        return f"<!-- table: {match[1]} -->\n{table_lines(root, match[1], tables[match[1]])}"
    for path in sorted((root / "docs").rglob("*.md")):
        text = path.read_text(encoding="utf-8")
        if TABLE.search(text):
            yield path, text, TABLE.sub(written, text)
    if unused := tables.keys() - shown:
        raise TableError(f"tables that no page shows: {', '.join(sorted(unused))}")


def check(root):
    """What is wrong with the pages' tables, a line each."""
    try:
        return [f"{path.relative_to(root)}: a table is not what its results say: scripts/paper_tables.py writes it"
                for path, text, right in pages(root) if text != right]
    except TableError as error:
        return [str(error)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--measure", nargs="+", default=[], metavar="RUN", help="runs to make first")
    parser.add_argument("--take", nargs="+", default=[], metavar="RUN=DIR", help="runs whose results lie in a folder")
    parser.add_argument("--commit", help="of the build that made what --take reads")
    parser.add_argument("--times", nargs="+", default=[], type=Path, metavar="DIR", help="folders of runs, whose times to keep")
    parser.add_argument("--out", type=Path, metavar="DIR", help="folder that keeps results of runs; one that was interrupted goes on")
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/voxray"))
    parser.add_argument("--root", type=Path, default=ROOT)
    options = parser.parse_args()
    try:
        runs, _ = definitions(options.root)
        if options.take and not options.commit:
            parser.error("--take needs --commit")
        taken = dict(entry.partition("=")[::2] for entry in options.take)
        for name in [*options.measure, *taken]:
            if name not in runs:
                parser.error(f"no run {name}; there are {', '.join(runs) or 'none'}")
            if name in taken:
                keep(options.root, name, runs[name], *results_of(options.root, runs[name], taken[name]), options.commit)
            else:
                measure(options.root, name, runs[name], options.program, options.out)
        replicate_tables.keep_times(options.root, {folder.name: folder for folder in options.times if folder.name in runs})
        for path, text, right in pages(options.root):
            if text != right:
                path.write_text(right, encoding="utf-8")
                print(path.relative_to(options.root))
    except TableError as error:
        sys.exit(f"paper_tables.py: {error}")


if __name__ == "__main__":
    main()
