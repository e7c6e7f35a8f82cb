"""Trials of variants: runs of the program, and what their results say of error and cost."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

from orchestration.errors import UsageError, did_you_mean
from orchestration.program import Program
from orchestration.search import Outcome
from report.rows import read_rows

AXIS = "tuned"  # the pass that trials swap for whole graphs
SMALL_EDGE, MIN_EDGE = 4, 48  # small images have a fourth of the width and height, but no fewer pixels than these
HIGHER_IS_BETTER = {"ssim": lambda v: 1 - v, "psnr_db": lambda v: 10 ** (-v / 20)}  # as an error that falls to 0
NEAR_ONE = ("mean_ratio",)


@dataclass(frozen=True)
class Target:
    """A column of results.csv and the value to meet."""

    column: str
    value: float

    @staticmethod
    def read(text: str, columns: Iterable[str]) -> Target:
        """@param columns of results.csv, those with numbers"""
        column, _, value = text.rpartition("=")
        try:
            target = Target(column, float(value))
        except ValueError:
            raise UsageError(f"--target {text}: expected NAME=VALUE, as in indirect_relmse=0.02") from None
        if column not in columns:
            raise UsageError(f"--target {column}: no such column of results.csv{did_you_mean(column, columns)}")
        if not math.isfinite(target.value) or not target.error(target.value) > 0:
            raise UsageError(f"--target {text}: a target is above 0 and can be met: ssim below 1, mean_ratio other than 1")
        return target

    def error(self, value: float) -> float:
        metric = self.column.partition("@")[0].removeprefix("indirect_")
        if metric in NEAR_ONE:
            return abs(value - 1)
        return HIGHER_IS_BETTER[metric](value) if metric in HIGHER_IS_BETTER else value

    def excess(self, value: float) -> float:
        return max(self.error(value), 0) / self.error(self.value) if math.isfinite(value) else math.inf


class Trials:
    """Runs variants at full or small size, each once; both keep a results folder of their own.

    options: config, minimize, resume, scenes."""

    def __init__(self, space: dict, program: Program, out: Path, targets: list[Target], options: SimpleNamespace) -> None:
        self.space, self.program, self.out, self.targets, self.minimize = space, program, out, targets, options.minimize
        self.scenes = options.scenes or str(Path(options.config).parent)
        self.graphs = {entry["name"]: entry["graph"] for entry in space["variants"]}
        image = space["config"].get("image", {})
        self.size = {"width": image.get("width", 640), "height": image.get("height", 360)}
        self.small_size = {key: max(math.ceil(edge / SMALL_EDGE), min(edge, MIN_EDGE)) for key, edge in self.size.items()}
        self.has_small = self.small_size != self.size
        self.names: dict[str, list[str]] = {"small": [], "full": [], "sweep": []}
        self.values: dict[tuple[str, str], list[float]] = {}  # of targets, by rung and variant
        self._fresh = {rung: not options.resume for rung in self.names}

    def pixels(self) -> float:
        """The pixels of a full image over those of a small one."""
        return math.prod(self.size.values()) / math.prod(self.small_size.values())

    def config(self, rung: str) -> dict:
        config = dict(self.space["config"])
        config["name"] = f"tune_{rung}"
        measure = dict(config.get("measure", {}))
        frames = measure.get("frames", 20)
        if self.minimize != "ms" and not measure.get("compare_every"):
            measure["frames"] = 1
        elif rung == "small" and not measure.get("compare_every"):
            measure["frames"] = max(1, frames // SMALL_EDGE)
        config["measure"] = measure
        if rung == "small":
            config["image"] = {**config.get("image", {}), **self.small_size}
        names = self.names[rung]
        config["graph"] = [{"pass": self.graphs[names[0]][-1]["pass"], "id": AXIS}]
        config["sweep"] = {AXIS: {name: self.graphs[name] for name in names}}
        return config

    def run(self, names: list[str], rung: str) -> dict[str, Outcome | None]:
        self.names[rung] += [name for name in names if name not in self.names[rung]]
        config = self.out / f"{rung}.yaml"
        config.write_text(json.dumps(self.config(rung), indent=1, ensure_ascii=False), encoding="utf-8")
        self.program.run_quietly(str(config), str(self.out / rung), self.scenes, [] if self._fresh[rung] else ["--resume"])
        self._fresh[rung] = False
        return {name: self._outcome(name, rung) for name in names}

    def _outcome(self, name: str, rung: str) -> Outcome | None:
        folder = self.out / rung
        results = {row[AXIS]: row for row in _rows(folder / "results.csv")}
        row = results.get(name)
        if row is None or row["status"] != "ok":
            return None
        for target in self.targets:
            if row.get(target.column, "") == "":
                raise UsageError(f"--target {target.column}: results.csv has no number there: the graph writes no such image")
        values = [float(row[target.column]) for target in self.targets]
        self.values[rung, name] = values
        excess = max(target.excess(value) for target, value in zip(self.targets, values))
        build, frame = self._cost(row, [p for p in _rows(folder / "passes.csv") if p["variant"] == row["variant"]])
        grows = self.pixels() if rung == "small" else 1
        if self.minimize == "bytes":  # which do not grow with the image as time does
            memory = float(row["memory_bytes"])
            return Outcome(excess, (memory,), memory / grows)
        return Outcome(excess, (build, frame * grows), build + frame)

    def _cost(self, row: dict, passes: list[dict]) -> tuple[float, float]:
        if self.minimize == "ms":
            return float(row["build_ms"]), float(row["frame_ms_median"])
        build, frame = (sum(float(p["rays"]) for p in passes if p["phase"] == phase) for phase in ("build", "frame"))
        return build, frame

    def said(self, rung: str, name: str) -> str:
        return ", ".join(f"{target.column} {value:.4g}{'' if target.excess(value) <= 1 else f' (aim {target.value:g})'}"
                         for target, value in zip(self.targets, self.values[rung, name]))


def _rows(path: Path) -> list[dict[str, str]]:
    try:
        return read_rows(path)
    except FileNotFoundError:
        raise UsageError(f"{path} is missing: the trial did not run") from None
