"""What variants are called on the page: by a number and by the name that the run gave them."""

from __future__ import annotations

import os
from dataclasses import dataclass

from report import text
from report.results import Results


@dataclass(frozen=True)
class Family:
    """Variants whose graphs hold the same passes and differ in parameters alone."""

    name: str
    variants: list[str]
    passes: tuple[str, ...]  # names of the passes, not their ids


@dataclass(frozen=True)
class Names:
    """For each variant its number in the table, and its name in results.csv."""

    numbers: dict[str, str]
    short: dict[str, str]

    def full(self, variant: str) -> str:
        """Number and short name, as sentences call it."""
        return f"{self.numbers[variant]} ({self.short[variant]})"

    def listed(self, variants: list[str], limit: int = 6) -> str:
        """Several variants by their numbers, up to three by their names too."""
        if len(variants) <= 3:
            return text.joined([self.full(name) for name in variants])
        numbers = [self.numbers[name] for name in variants]
        if len(numbers) > limit:
            return f"{', '.join(numbers[:limit])} and {len(numbers) - limit} more"
        return text.joined(numbers)


def names_of(results: Results) -> Names:
    """Numbers in the order of the table."""
    variants = list(results.variants["variant"])
    return Names({variant: str(i) for i, variant in enumerate(variants, 1)}, dict(zip(variants, results.variants["name"])))


def families_of(results: Results, names: Names) -> list[Family]:
    """The families of the variants that finished, in the order of their first members."""
    groups: dict[tuple, list[str]] = {}
    for name in results.ok["variant"]:
        key = tuple((str(p.get("pass")), str(p.get("id")), str(p.get("inputs"))) for p in results.graph_of(name))
        groups.setdefault(key or (name,), []).append(name)
    return [Family(_common(members, names), members, tuple(p[0] for p in key if isinstance(p, tuple)))
            for key, members in groups.items()]


def _common(members: list[str], names: Names) -> str:
    return common_words([names.short[name] for name in members]) or names.short[members[0]]


def common_words(names: list[str]) -> str:
    """The words that all names begin with."""
    words = [name.split() for name in names]
    return " ".join(os.path.commonprefix(words)).rstrip(",:+ ")
