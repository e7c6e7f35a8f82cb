"""Tables of docs/replicate.md: of each table of a page of docs/papers, what makes it, what comes out, and how long that takes.

Used by paper_tables.py, which writes and checks them."""
import csv
import json
import re
from datetime import datetime

PREFIX = "replicate_"
HEADINGS = ["table", "command", "comes out", "time"]
MARK = re.compile(r"^(?:#+ (?P<heading>.*)|<!-- table: (?P<table>\S+) -->)$", re.M)
RUN_OF = re.compile(r"""of\[['"](\w+)['"]\]\[['"][^'"]+['"]\]\[""")
SHOWN_CELLS = 4  # of a table's first row


def times_path(root):
    return root / "docs/papers/tables/times.csv"


def kept_times(root):
    """Seconds by run, of those that have been kept."""
    path = times_path(root)
    if not path.exists():
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {row["run"]: float(row["seconds"]) for row in csv.DictReader(file)}


def seconds_of(folder):
    """How long a run took, references that came from a cache included; None of one that was not finished. One that was interrupted and
    resumed: each session from its start to its last result, which is the age of its file."""
    path = folder / "manifest.json"
    if not path.exists():
        return None
    manifest = json.loads(path.read_text(encoding="utf-8"))
    if not manifest.get("finished"):
        return None
    def moment(text):
        return datetime.fromisoformat(text.replace("Z", "+00:00")).timestamp()
    *earlier, last = manifest["sessions"]
    seconds = moment(manifest["finished"]) - moment(last["started"])
    for session in earlier:
        results = [(folder / "images" / variant / "result.json").stat().st_mtime for variant in session["variants"]]
        seconds += max(results, default=moment(session["started"])) - moment(session["started"])
    return seconds + sum(entry["seconds"] for entry in manifest.get("references", []) if entry["cached"])


def keep_times(root, folders):
    """Adds the times of runs, by the folder of each one's results."""
    keep_seconds(root, {name: seconds for name, folder in folders.items() if (seconds := seconds_of(folder)) is not None})


def keep_seconds(root, found):
    """Adds times of runs."""
    if not found:
        return
    times = kept_times(root) | found
    with open(times_path(root), "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["run", "seconds"])
        writer.writerows([name, f"{seconds:.0f}"] for name, seconds in sorted(times.items()))


def anchor(heading):
    """As GitHub spells it."""
    shown = re.sub(r"\]\([^)]*\)", "", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", shown).replace(" ", "-")


def shown_time(seconds):
    return f"{seconds / 60:.0f} min" if seconds >= 90 else f"{max(seconds, 1):.0f} s"


def time_of(root, names, times):
    """How long the runs of a table take; "> …" where some of them have no time, "GPU" where they want one, "-" where nothing was kept."""
    known = [times[name] for name in names if name in times]
    if known:
        return ("> " if len(known) < len(names) else "") + shown_time(sum(known))
    return "GPU" if names and all(device_of(root, name).startswith("NVIDIA") for name in names) else "-"


def runs_of(table):
    """Names of the runs that a table's cells are of."""
    if "run" in table:
        return [table["run"]]
    return list(dict.fromkeys(run for line in table["lines"] for cell in line for run in RUN_OF.findall(cell)))


def header_of(root, name):
    """(device, command) of a run, as its CSV says."""
    with open(root / "docs/papers/tables" / f"{name}.csv", encoding="utf-8") as file:
        return file.readline().strip().split("; ")[1:3]


def device_of(root, name):
    return header_of(root, name)[0]


def command_of(root, name, runs):
    """As one types it in the root of the repository, and the device that it was measured on where that is a GPU. A run without
    definition is told by its CSV."""
    device, command = header_of(root, name)
    command = (runs[name]["command"] if name in runs else command)
    device = f", on an {device}" if device.startswith("NVIDIA") else ""
    if command.startswith("bench "):  # Whose output is no results folder
        command = f"scripts/paper_tables.py --measure {name}"
    return (f"`/usr/bin/python3 {command}`" if command.startswith("scripts/") else f"`./voxray {command}`") + device


def first_row(lines):
    """What stands in the first row of a Markdown table, by column, and how many rows follow."""
    headings, _, *rows = ([cell.strip() for cell in line.strip().strip("|").split("|")] for line in lines.splitlines())
    cells = [f"{heading} {cell}" for heading, cell in zip(headings[1:], rows[0][1:]) if cell][:SHOWN_CELLS]
    more = f"; {len(rows) - 1} more rows" if len(rows) > 2 else "; 1 more row" if len(rows) == 2 else ""
    return f"{rows[0][0]}: {', '.join(cells)}{more}"


def without_links(text):
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)


def rows(root, path, tables, runs, times):
    """A row for each table of the page, in its order. @param tables by name: as it is defined, and its lines"""
    heading, found = "", []
    for match in MARK.finditer(path.read_text(encoding="utf-8")):
        if match["heading"]:
            heading = match["heading"]
            continue
        table, lines = tables[match["table"]]
        names = runs_of(table)
        link = f"[{without_links(heading)}](papers/{path.name}#{anchor(heading)}), `{match['table']}`"
        command = command_of(root, names[0], runs) if len(names) == 1 else f"the runs {', '.join(f'`{name}`' for name in names)}"
        found.append([link, command if names else "-", without_links(first_row(lines)),
                      time_of(root, names, times)])
    return found
