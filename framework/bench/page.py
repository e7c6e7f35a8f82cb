"""What `voxray bench gpu` measured as a page and as Markdown: the same tables in both."""

from __future__ import annotations

from pathlib import Path

from bench import processes, rivals
from report import pages, text
from report.rows import markdown_table
from report.table import Cell, Table

_HERE = Path(__file__).resolve().parent
_FAR = 0.01  # a mean ratio so far from 1 is marked


def number(value: float | None, digits: int = 3) -> str:
    return "" if value is None else text.figures(float(value), digits)


def size(value: float | None) -> str:
    return "" if value is None else text.size(value)


def count(value: float | None) -> str:
    if value is None:
        return ""
    return str(value) if isinstance(value, int) and value < 1000 else text.count(value)


def _status(status: str) -> Cell:
    return Cell(status, "worse" if status in (processes.FAILED, processes.OUT_OF_TIME) else "")


def parts_table(data: dict) -> Table:
    table = Table("Parts", ["part", "outcome", "s", "of at most", "runs: done, of", "clock MHz while busy: median, p05",
                            "what it measures, and what went wrong"], words=(0, 1, 6))
    for part in data["parts"]:
        ran = part["ran"]
        done = f"{sum(run['status'] == processes.DONE for run in ran)}, {len(ran)}" if ran else ""
        clock = part["clock_mhz"]
        table.add(part["name"], _status(part["status"]), number(part["seconds"]), number(part["limit"]), done,
                  f"{number(clock['median'])}, {number(clock['p05'])}" if clock else "",
                  "; ".join(filter(None, (part["what"], part["why"]))))
    return table


def runs_table(data: dict) -> Table:
    table = Table("Runs that did not end well", ["run", "outcome", "s", "variants failed, of", "what was said last"], words=(0, 1, 4))
    unbegun = []
    for part in data["parts"]:
        for run in part["ran"]:
            if run["last"] == processes.NO_TIME:
                unbegun.append(run["name"])
            if run["last"] == processes.NO_TIME or (run["status"] == processes.DONE and not run.get("alone")):
                continue
            failed = run.get("failed", [])
            said = [run["last"]] if run["last"] and run["status"] != processes.DONE else []
            said += [f"{entry['variant']}: {entry['error']}" for entry in failed]
            if run.get("alone"):
                said.append(f"run again on their own: {', '.join(run['alone'])}")
            table.add(run["name"], _status(run["status"]), number(run["seconds"]),
                      f"{len(failed)}, {run['variants']}" if "variants" in run else "", "\n".join(said))
    if unbegun:
        table.add(", ".join(unbegun), processes.SKIPPED, "", "", processes.NO_TIME)
    return table


def parity_table(data: dict) -> Table:
    rows = data.get("parity", [])
    pairs = list(dict.fromkeys(row["pair"] for row in rows))
    table = Table("Parity", ["method", *(f"{pair}: nRMSE, mean ratio, FLIP, pixels apart" for pair in pairs), "nRMSE against the reference, by run"],
                  note="Indirect light. Two tracers meet other triangles at edges and where surfaces touch, and random walks part there: "
                  "so compare with a method's own error, in the last column. Pixels apart differ by over 1 % of the reference's, or of "
                  f"its mean: few of them lie at edges. Mean ratios over {100 * _FAR:g} % from 1 are marked.")
    found = {(row["pair"], row["method"]): row for row in rows}
    for method in dict.fromkeys(row["method"] for row in rows):
        cells = [_difference(found.get((pair, method))) for pair in pairs]
        errors: dict[str, float | None] = {}
        for pair in pairs:
            values = (found.get((pair, method)) or {}).get("errors", [None, None])
            errors.update({run: value for run, value in zip(pair.split(" against "), values) if value is not None})
        table.add(method, *cells, "; ".join(f"{run} {number(value)}" for run, value in errors.items()))
    return table


def _difference(row: dict | None) -> Cell:
    if row is None:
        return Cell("")
    if "error" in row:
        return Cell("failed", "worse", title=row["error"])
    if row["same_bytes"]:
        return Cell("same bytes", "tie")
    ratio = row["mean_ratio"]
    far = ratio is None or abs(ratio - 1) > _FAR
    apart = f", {number(100 * row['pixels_apart'], 2)} %"
    return Cell(f"{number(row['nrmse'], 2)}, {'–' if ratio is None else text.ratio(ratio)}, {number(row['flip'], 2)}{apart}",
                "worse" if far else "")


def rivals_table(data: dict) -> Table:
    rows = data.get("over_paths", [])
    table = Table("Methods over path tracing on this device", [
        "method", "ms a frame", "ms with all that is built", *rivals.ERRORS.values(),
        *(f"over paths of equal {name}: frame, with builds" for name in rivals.ERRORS.values())],
        note="Cornell, indirect light. Paths on the device (path_trace_device) have the same filter, lights and bounces as all others; the time "
             "to an error lies between that of their numbers of samples, logarithm over logarithm. Below 1 the method is faster. >: at least so "
             "much, because the fewest samples have less error; <: at most so much, because the most samples have more.", words=(0,))
    for row in rows:
        over = [_over(row["over"].get(error)) for error in rivals.ERRORS]
        table.add(row["variant"], number(row["frame_ms"]), number(row["whole_ms"]), *(number(row["errors"][e]) for e in rivals.ERRORS), *over)
    return table


def _over(found: dict | None) -> str:
    if found is None:
        return ""
    sign = {"least": ">", "most": "<"}.get(found["at"], "")
    return ", ".join(f"{sign}{number(found[part], 2)}" for part in ("frame", "whole"))


def passes_table(rows: list[dict]) -> Table:
    note = "Of all variants the one in which the pass took longest, Embree's only where no other tracer ran it; gpu.json has all. " \
           "Memory: of the pass's outputs, and scratch. Dispatches, and waits and copies of the host: in one run of the pass."
    table = Table("Passes", ["pass", "phase", "config", "variant", "tracer", "ms", "p05", "p95", "of rows", "memory", "scratch", "dispatches",
                             "host waits", "host bytes"], note=note, words=(0, 1, 2, 3, 4))
    for row in rows:
        table.add(row["kind"], row["phase"], row["config"], row["variant"], row["tracer"], number(row["ms"]),
                  number(row["ms_p05"]), number(row["ms_p95"]), str(row["of"]), size(row["memory_bytes"]), size(row["scratch_bytes"]),
                  count(row["dispatches"]), count(row["host_waits"]), size(row["host_bytes"]))
    return table


def absent_table(data: dict) -> Table:
    table = Table("Passes that did not run", ["passes"])
    if data.get("not_covered"):
        table.add(", ".join(data["not_covered"]))
    return table


def rays_table(rows: list[dict]) -> Table:
    table = Table("Rays and voxel steps a second, by pass", ["pass", "phase", "tracer", "config, variant", "rays", "rays/s", "steps/s", "ms"],
                  note="The fastest variant, with all else that the pass does in that time.", words=(0, 1, 2, 3))
    for row in rows:
        table.add(row["kind"], row["phase"], row["tracer"], f"{row['config']}, {row['variant']}", count(row["rays"]),
                  count(row["rays_per_s"]), count(row["voxel_steps_per_s"]), number(row["ms"]))
    return table


def benchmarks_table(data: dict) -> Table:
    table = Table("Benchmarks", ["program", "benchmark", "time", "counters"], words=(0, 1, 3))
    for row in data.get("benchmarks", []):
        counters = ", ".join(f"{name} {count(value)}" for name, value in row["counters"].items())
        table.add(row["program"], row["name"], Cell(row["error"], "worse") if row["error"] else f"{number(row['time'])} {row['unit']}", counters)
    return table


def writes_table(data: dict) -> Table:
    table = Table("Merging light near a floor", ["pass", "voxels", "write", "ms", "p05 to p95", "over none"], words=(0, 2),
                  note="Light of a lamp 25 cm above the floor, 2^20 rays: each pass that merges what meets in a voxel, by way of writing; over "
                  "a plain store by the same pass. The paper's numbers, and ours without a GPU, stand in docs/papers/magalhaes2020.md.")
    for row in data.get("writes", []):
        table.add(row["kind"], str(row["voxels"]), row["write"], number(row["ms"]), f"{number(row['ms_p05'])} to {number(row['ms_p95'])}",
                  number(row["over_none"], 2))
    return table


def papers_tables(data: dict) -> list[Table]:
    tables = []
    for paper in data.get("papers", []) + data.get("headlines", []):
        stages = list(dict.fromkeys(name for row in paper["variants"] for name in row.get("passes", {})))
        profile = [] if paper["profile"] in ("", "full") else ["--profile", paper["profile"]]
        table = Table(" ".join([paper["config"], *profile, *paper["set"]]),
                      ["variant", "build ms", "frame ms", "p05 to p95", "memory", "indirect nRMSE", "mean ratio", *stages],
                      note=f"The paper's numbers, and ours without a GPU, stand in {paper['page']}. Last columns: median ms of each pass.")
        for row in paper["variants"]:
            if "error" in row:
                table.add(row["variant"], Cell("failed", "worse", title=row["error"]), *[""] * (5 + len(stages)))
                continue
            table.add(row["variant"], number(row["build_ms"]), number(row["frame_ms"]),
                      f"{number(row['frame_ms_p05'])} to {number(row['frame_ms_p95'])}", size(row["memory_bytes"]),
                      number(row["indirect_nrmse"]), "" if row["mean_ratio"] is None else text.ratio(row["mean_ratio"]),
                      *(number(row["passes"].get(stage)) for stage in stages))
        tables.append(table)
    return tables


def tables_of(data: dict, slowest: list[dict], rays: list[dict]) -> list[Table]:
    """All tables that have rows."""
    found = [parts_table(data), runs_table(data), parity_table(data), rivals_table(data), passes_table(slowest), absent_table(data), rays_table(rays), writes_table(data),
             benchmarks_table(data), *papers_tables(data)]
    return [table for table in found if table.rows]


def markdown(data: dict, tables: list[Table]) -> str:
    lines = [f"# {title(data)}", "", summary(data), ""]
    for table in tables:
        lines += [f"## {table.title}", ""]
        lines += [table.note, ""] if table.note else []
        lines += [*markdown_table([heading.text for heading in table.headings], (map(_plain, row) for row in table.rows)), ""]
    return "\n".join(lines)


def _plain(cell: Cell | str) -> str:
    cell = cell if isinstance(cell, Cell) else Cell(cell)
    words = cell.text.replace("\n", "; ").replace("|", "\\|")
    return f"**{words}**" if cell.css == "worse" and words else words


def title(data: dict) -> str:
    return f"Voxray on {data.get('device') or 'no device'}"


def summary(data: dict) -> str:
    ended = [f"{part['name']} {part['status']}" for part in data["parts"]]
    return f"{data['started']}, {data.get('version', '')}, profile {data['profile']}, {data.get('cores')} cores: {', '.join(ended)}."


def render(data: dict, tables: list[Table]) -> str:
    """The whole page, self-contained."""
    return pages.render("gpu.html.j2", folder=_HERE, title=title(data), summary=summary(data), measured=data, tables=tables,
                        strips=_strips(data), devices=data.get("devices", []))


def _strips(data: dict) -> list[tuple[str, list[tuple[str, str]]]]:
    """By method, the images of all runs that were compared."""
    strips: dict[str, dict[str, str]] = {}
    for row in data.get("parity", []):
        for run, path in zip(row["pair"].split(" against "), row.get("pictures", [])):
            if Path(path).is_file() and not run.endswith(" again"):
                strips.setdefault(row["method"], {}).setdefault(run, path)
    return [(method, [(run, pages.data_uri(Path(path).read_bytes()))
                      for run, path in pictures.items()]) for method, pictures in strips.items()]
