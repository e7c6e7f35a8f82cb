"""Bars of where time and memory go."""

from __future__ import annotations

from dataclasses import dataclass

from report import text
from report.names import Names
from report.results import Results


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
        split = _by_pass(results, dict(zip(rows["variant"], rows[column])), phase, part)
        longest = max((sum(parts.values()) for parts in split.values()), default=0)
        bars = [Bar(names.numbers[name], names.short[name], anchors[name], write(total),
                    [Segment(colors.get(own, "var(--muted)"), 100 * value / longest, f"{own}: {write(value)}")
                     for own, value in split[name].items()])
                for name, total in zip(rows["variant"], rows[column])]
        groups.append(BarGroup(heading, bars))
    return [group for group in groups if group.bars]


def _by_pass(results: Results, totals: dict[str, float], phase: str | None, part: str) -> dict[str, dict[str, float]]:
    """For each variant what each kind of pass takes, and what is left of the total."""
    rows = results.passes[results.passes[part] > 0]
    if phase:
        rows = rows[rows["phase"] == phase]
    # Grouped by kind, because an id may be that of another pass in each variant
    split = {variant: {} for variant in totals}
    for (variant, kind), value in rows.groupby(["variant", "kind"], sort=False)[part].sum().items():
        if variant in split:
            split[variant][kind] = value
    # Whatever no pass accounts for is shown as such; a sum of medians can also exceed the whole's median.
    for variant, values in split.items():
        if (rest := totals[variant] - sum(values.values())) > 0:
            values["outside the passes"] = rest
    return split
