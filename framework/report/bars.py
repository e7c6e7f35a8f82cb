"""Bars of where time and memory go."""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd

from report import text
from report.load import Results
from report.names import Names


@dataclass(frozen=True)
class Segment:
    color: str
    percent: float
    title: str


@dataclass(frozen=True)
class Bar:
    number: str
    name: str
    anchor: str
    total: str
    segments: list[Segment]


@dataclass(frozen=True)
class BarGroup:
    """Bars on one scale, one for each variant."""

    heading: str
    bars: list[Bar]


def bar_groups(results: Results, colors: dict[str, str], names: Names, anchors: dict[str, str]) -> list[BarGroup]:
    """Frame time, build time and memory, split by pass; without groups that have no bar."""
    def milliseconds(value: float) -> str:
        return f"{text.figures(value)} ms"

    groups = []
    for heading, phase, column, part, write in (
            ("Time of a frame", "frame", "frame_ms_median", "ms_median", milliseconds),
            ("Time of the build, once for each scene or light", "build", "build_ms", "ms_median", milliseconds),
            ("Device memory that the passes keep", None, "memory_bytes", "memory_bytes", text.size)):
        rows = results.ok[results.ok[column].fillna(0) > 0]
        split = {row["variant"]: _by_pass(results, row, phase, column, part) for _, row in rows.iterrows()}
        longest = max((sum(parts.values()) for parts in split.values()), default=0)
        bars = [Bar(names.numbers[name], names.short[name], anchors[name], write(total),
                    [Segment(colors.get(own, "var(--muted)"), 100 * value / longest, f"{own}: {write(value)}")
                     for own, value in split[name].items()])
                for name, total in zip(rows["variant"], rows[column])]
        groups.append(BarGroup(heading, bars))
    return [group for group in groups if group.bars]


def _by_pass(results: Results, row: pd.Series, phase: str | None, column: str, part: str) -> dict[str, float]:
    rows = results.passes
    # By kind: an id may be that of another pass in each variant
    mine = rows[(rows["variant"] == row["variant"]) & (rows[part] > 0)]
    if phase:
        mine = mine[mine["phase"] == phase]
    values = mine.groupby("kind", sort=False)[part].sum().to_dict()
    # Whatever no pass accounts for is shown as such; a sum of medians can also exceed the whole's median.
    rest = row[column] - sum(values.values())
    return {**values, "outside the passes": rest} if rest > 0 else values
