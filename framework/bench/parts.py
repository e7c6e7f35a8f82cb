"""The parts of `voxray bench gpu`: each fills its own section of the measurements and tells how it ended."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

from bench import devices, parity, processes, rivals, runs, tables
from bench.processes import Clock, Outcome
from bench.runs import Program, Run

# Configs whose tables stand in docs/papers: first one of each paper, then more.
PAPERS = ("magalhaes2020/base", "arneback2017/dynamic_light", "sun2015/table1", "cosin2022/table1", "seok2021/table1",
          "magalhaes2020/published_write_strategies", "arneback2017/dynamic_geometry", "cosin2022/table2", "sun2015/table1_sponza",
          "arneback2017/fly_through", "magalhaes2020/published_sampling", "arneback2017/cone_cost", "sun2015/resolution",
          "seok2021/table1_bunnies")


@dataclass(frozen=True)
class PaperRun:
    """A config of a paper, and how it is run."""

    config: str
    profile: str = "full"
    assignments: tuple[str, ...] = ()


_FULL_HD = ("image.width=1920", "image.height=1080")
_STILL = ("measure.build_repeats=10", "reference=null")
# Clusters take long to build, and their lists do not depend on the light, whose repetitions warm the clock
_CLUSTERS = ("measure.build_repeats=4", "reference=null", *_FULL_HD)
HEADLINES = (PaperRun("arneback2017/fly_through", assignments=(*_STILL, "image.width=1497", "image.height=1014")),
             PaperRun("arneback2017/dynamic_light", "thesis", _STILL),
             PaperRun("arneback2017/dynamic_geometry", "thesis", ("reference=null",)),
             PaperRun("sun2015/table1", assignments=_STILL), PaperRun("sun2015/table1_sponza", assignments=_STILL),
             PaperRun("magalhaes2020/base", assignments=(*_STILL, *_FULL_HD)),
             PaperRun("magalhaes2020/secondary", "tables", _STILL),
             PaperRun("seok2021/like_for_like", "times", (*_STILL, *_FULL_HD)),
             PaperRun("cosin2022/rivals_vct", assignments=_CLUSTERS), PaperRun("cosin2022/table1", assignments=_CLUSTERS))
_PASSES = "bench/gpu_passes.yaml"
_WRITES = "papers/magalhaes2020/published_write_strategies.yaml"
_LISTING = 30  # seconds for `voxray devices`
# A GPU's clock rises with its work: builds that repeat bring it up before the median of them, and the frames, are timed
_WARM = ("measure.build_repeats=20",)


class PartError(Exception):
    """Why a part has nothing to show."""


@dataclass
class Bench:
    """What is measured, on which device, and what has been so far. `data` becomes gpu.json."""

    program: Program
    out: Path
    tracer: str
    benches: Path
    devices: list[devices.Device] = field(default_factory=list)
    device: devices.Device | None = None
    runs: list[Run] = field(default_factory=list)
    data: dict = field(default_factory=dict)

    @property
    def warming(self) -> tuple[str, ...]:
        """What is set in runs that are timed; a device in software has one clock."""
        return () if self.device.is_cpu else _WARM

    @property
    def tracers(self) -> list[str]:
        """The tracers to measure by: the one that was named, else the device's own."""
        return [self.tracer] if self.tracer not in ("auto", "embree") else self.device.own_tracers if self.tracer == "auto" else []

    def find_device(self) -> None:
        """@throws PartError where none qualifies."""
        listed = self.program.call("devices", limit=_LISTING)
        self.devices = devices.parse(listed.output)
        self.device = devices.chosen(self.devices, self.program.device)
        self.data["cores"] = os.cpu_count()
        self.data["version"] = self.program.call("--version", limit=_LISTING).output.strip()
        self.data["devices"] = [{"name": d.name, "kind": "CPU" if d.is_cpu else "GPU", **d.facts} for d in self.devices]
        if self.device is None:
            wanted = f"no device that qualifies has '{self.program.device}' in its name" if self.devices else "no device was found"
            raise PartError("\n".join(filter(None, (wanted, listed.last if listed.status != processes.DONE else ""))))
        self.data["device"] = self.device.name


@dataclass
class Ending:
    """How a part ended: with the outcomes of what it ran, one with `name` each."""

    status: str = processes.DONE
    why: str = ""
    ran: list[dict] = field(default_factory=list)

    def add_run(self, run: Run) -> None:
        self._add(run.record(), run.status)

    def add(self, name: str, outcome: Outcome) -> None:
        self._add({"name": name, **outcome.record()}, outcome.status)

    def _add(self, record: dict, status: str) -> None:
        self.ran.append(record)
        ranks = (processes.DONE, processes.SKIPPED, processes.OUT_OF_TIME, processes.FAILED)
        self.status = max(self.status, status, key=ranks.index)


def list_devices(_bench: Bench, _clock: Clock) -> Ending:
    """What find_device() found before any part began."""
    return Ending()


def compare_images(bench: Bench, clock: Clock) -> Ending:
    ending = Ending()
    done, rows = parity.measure(bench.program, bench.devices, bench.device, bench.tracers, bench.out, clock, bench.warming)
    for run in done:
        ending.add_run(run)
    bench.runs += done
    bench.data["parity"] = rows
    bench.data["over_paths"] = rivals.rows(done[0])
    broken = sum("error" in row for row in rows)
    if broken and ending.status == processes.DONE:
        ending.status, ending.why = processes.FAILED, f"{broken} of {len(rows)} pairs of images could not be compared"
    return ending


def time_passes(bench: Bench, clock: Clock) -> Ending:
    """What parity has not run yet."""
    ending = Ending()
    run = runs.run_config(bench.program, _PASSES, "passes", bench.out, clock, tracer=next(iter(bench.tracers), "embree"),
                          assignments=bench.warming)
    ending.add_run(run)
    bench.runs.append(run)
    return ending


def time_writes(bench: Bench, clock: Clock) -> Ending:
    """Ways of merging light that meets in a voxel, where it crowds into few voxels."""
    ending = Ending()
    run = runs.run_config(bench.program, _WRITES, "writes", bench.out, clock, tracer=next(iter(bench.tracers), "embree"),
                          profile="near_floor", assignments=bench.warming)
    ending.add_run(run)
    bench.runs.append(run)
    bench.data["writes"] = tables.write_rows(run)
    return ending


def run_papers(bench: Bench, clock: Clock) -> Ending:
    return _run_papers(bench, clock, "papers", [PaperRun(paper, "", bench.warming) for paper in PAPERS])


def run_headlines(bench: Bench, clock: Clock) -> Ending:
    """Times at the papers' own resolutions, without references."""
    return _run_papers(bench, clock, "headlines", HEADLINES)


def _run_papers(bench: Bench, clock: Clock, part: str, paper_runs: Iterable[PaperRun]) -> Ending:
    ending = Ending()
    bench.data[part] = []
    for paper in paper_runs:
        run = runs.run_config(bench.program, f"papers/{paper.config}.yaml", f"{part}.{paper.config.replace('/', '.')}", bench.out,
                              clock.part(clock.left / 2), tracer=next(iter(bench.tracers), "embree"), profile=paper.profile,
                              assignments=paper.assignments)
        ending.add_run(run)
        bench.runs.append(run)
        if run.variants:
            bench.data[part].append({"config": f"configs/{run.config}", "profile": paper.profile, "set": list(paper.assignments),
                                     "page": f"docs/papers/{paper.config.split('/')[0]}.md", "variants": tables.variant_rows(run)})
    return ending


def measure_throughput(bench: Bench, clock: Clock) -> Ending:
    """Google Benchmark's programs. They choose their device themselves: the best."""
    ending = Ending()
    bench.data["benchmarks"] = []
    if devices.chosen(bench.devices, "") is not bench.device:
        return Ending(processes.SKIPPED, "the benchmarks run on the best device alone, which is another one")
    for name, pattern in tables.BENCHMARKS:
        path = next((path for path in (bench.benches / name, bench.benches / "bench" / name) if path.is_file()), None)
        if path is None:
            ending.add(name, Outcome(processes.SKIPPED, None, 0.0, "", f"is not in {bench.benches}", [name]))
            continue
        if clock.left < runs.SHORTEST:
            ending.add(f"{name} {pattern}", Outcome(processes.SKIPPED, None, 0.0, "", processes.NO_TIME, [str(path)]))
            continue
        done, rows = tables.benchmark(path, pattern, clock.part(clock.left / 2))
        ending.add(f"{name} {pattern}", done)
        bench.data["benchmarks"] += rows
    return ending


@dataclass(frozen=True)
class Part:
    name: str
    fraction: float  # of the whole time, at most; what a part leaves goes to those after it
    what: str
    measure: Callable[[Bench, Clock], Ending]


PARTS = (Part("devices", 0.1, "devices, their drivers and features", list_devices),
         Part("parity", 0.45, "the same images by the device's own tracers, by Embree, twice, and by a device in software", compare_images),
         Part("passes", 0.35, "the time of every pass", time_passes),
         Part("writes", 0.25, "what merging light near a floor costs, by way of writing", time_writes),
         Part("papers", 0.4, "the configs whose tables stand in docs/papers", run_papers),
         Part("headlines", 0.6, "what papers' abstracts and main tables give in ms, at their own resolutions", run_headlines),
         Part("throughput", 0.35, "rays, steps, scans and sorts a second", measure_throughput))
