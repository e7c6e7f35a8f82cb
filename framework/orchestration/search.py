"""A search for the cheapest variant of a sweep that meets a target, by few trials: on small images first, the best of them
at full size. It knows nothing of rendering: trials are a function."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

NONE = "-"  # in place of a value that does not reach a variant, as framework/config/sweep.h has it
SLACK = 1.15  # the largest expected error over the target at which a variant is tried at full size
GUESS = 2.0  # the same for a small trial of a variant that was not tried: its expected error is less certain
WORTHWHILE = 0.7  # the fraction of a full trial's cost above which a small one is not run
DESIGN = 0.5  # the fraction of the budget that goes into learning how each parameter acts


@dataclass(frozen=True)
class Variant:
    """group: values of axes that swap passes; position: of each other axis, from 0 (its first value) to 1 (its last)."""

    name: str
    group: tuple[str, ...]
    position: tuple[float, ...]


@dataclass(frozen=True)
class Outcome:
    """What a trial showed. excess: error over the target, at most 1 where it is met; costs: terms of the variant's cost at
    full size, which a small trial estimates, each modelled on its own; spent: what the trial itself cost, in the same unit."""

    excess: float
    costs: tuple[float, ...]
    spent: float

    @property
    def cost(self) -> float:
        return sum(self.costs)


def variants_of(space: dict) -> list[Variant]:
    """The variants of space.json (tune.py). Values stand on an axis as the sweep lists them."""
    order: list[list[str]] = [[] for _ in space["axes"]]
    for entry in space["variants"]:
        for values, text in zip(order, entry["values"]):
            if text != NONE and text not in values:
                values.append(text)
    found = []
    for entry in space["variants"]:
        group = tuple(text for text, swaps in zip(entry["values"], space["swaps"]) if swaps)
        position = tuple(0.5 if text == NONE or len(values) < 2 else values.index(text) / (len(values) - 1)
                      for text, values, swaps in zip(entry["values"], order, space["swaps"]) if not swaps)
        found.append(Variant(entry["name"], group, position))
    return found


class Model:
    """Logarithm of a positive number over positions: a Gaussian process whose covariance is a line and a smooth bend along
    each axis, and a little that bends with all of them."""

    LINE, BEND, TOGETHER, NOISE, LENGTH = 4.0, 1.0, 0.3, 1e-3, 0.5

    def __init__(self, positions: list[tuple[float, ...]], values: list[float]):
        self._positions = np.array(positions, dtype=float).reshape(len(positions), -1)
        logarithms = np.log(np.maximum(np.array(values, dtype=float), 1e-12))
        self._mean = float(logarithms.mean())
        covariance = self._covariance(self._positions) + self.NOISE * np.eye(len(positions))
        self._weights = np.linalg.solve(covariance, logarithms - self._mean)

    def _covariance(self, others: np.ndarray) -> np.ndarray:
        a, b = others[:, None, :] - 0.5, self._positions[None, :, :] - 0.5
        bend = np.exp(-0.5 * ((a - b) / self.LENGTH) ** 2)
        return (self.LINE * a * b + self.BEND * bend).sum(axis=-1) + self.TOGETHER * bend.prod(axis=-1)

    def __call__(self, positions: list[tuple[float, ...]]) -> np.ndarray:
        others = np.array(positions, dtype=float).reshape(len(positions), -1)
        return np.exp(self._mean + self._covariance(others) @ self._weights)


@dataclass
class Search:
    """trial(names, is_small): an outcome for each name, None where it failed. budget: in variants of mean cost."""

    variants: list[Variant]
    trial: object
    budget: float
    has_small: bool = True
    small: dict[str, Outcome] = field(default_factory=dict)
    full: dict[str, Outcome] = field(default_factory=dict)
    failed: set[str] = field(default_factory=set)

    def run(self) -> None:
        self._groups: dict[tuple[str, ...], list[Variant]] = {}
        for variant in self.variants:
            self._groups.setdefault(variant.group, []).append(variant)
        centers = {group: min(members, key=lambda v: (sum((x - 0.5) ** 2 for x in v.position), v.name))
                   for group, members in self._groups.items()}
        self._expected: dict[str, tuple[float, float]] = {}
        self._run([center.name for center in centers.values()], self.has_small)
        self._learn(centers)
        while (step := self._next()) is not None:
            self._run([step[0]], step[1])

    def best(self) -> str | None:
        """The cheapest variant that meets the target at full size, else the one that comes closest."""
        if not self.full:
            return None
        return min(self.full, key=lambda name: (max(self.full[name].excess, 1), self.full[name].cost, name))

    def used(self) -> float:
        """What trials cost so far, in variants of mean cost."""
        spent = sum(outcome.spent for rung in (self.small, self.full) for outcome in rung.values())
        return spent / self._mean_cost()

    def _mean_cost(self) -> float:
        costs = [cost for name, (_, cost) in self._expected.items() if name not in self.failed and math.isfinite(cost)]
        return max(float(np.mean(costs)), 1e-300) if costs else math.inf

    def _run(self, names: list[str], is_small: bool) -> None:
        rung = self.small if is_small else self.full
        names = [name for name in names if name not in rung and name not in self.failed]
        if not names:
            return
        for name, outcome in self.trial(names, is_small).items():
            if outcome is None:
                self.failed.add(name)
            else:
                rung[name] = outcome
        self._fit()

    def _fit(self) -> None:
        """Models of each group, by its small trials, and by full ones brought to their level."""
        both = [name for name in self.full if name in self.small]
        ratio = lambda pick: math.exp(float(np.median([math.log(max(pick(self.full[n]), 1e-12) / max(pick(self.small[n]), 1e-12))
                                                       for n in both]))) if both else 1.0
        self._excess_ratio, self._cost_ratio = ratio(lambda o: o.excess), ratio(lambda o: o.cost)
        self._expected = {}
        for members in self._groups.values():
            known = {v.name: self._known(v.name) for v in members if self._known(v.name) is not None}
            excess = cost = np.full(len(members), math.inf)
            if known:
                positions, everywhere = [v.position for v in members if v.name in known], [v.position for v in members]
                excess = Model(positions, [pair[0] for pair in known.values()])(everywhere)
                cost = sum(Model(positions, part)(everywhere) for part in zip(*(pair[1] for pair in known.values())))
            self._expected |= {v.name: (float(e), float(c)) for v, e, c in zip(members, excess, cost)}
            self._expected |= {name: (error, sum(costs)) for name, (error, costs) in known.items()}

    def _known(self, name: str) -> tuple[float, tuple[float, ...]] | None:
        """Excess and parts of the cost at full size, as far as trials tell."""
        if name in self.full:
            return self.full[name].excess, self.full[name].costs
        if name in self.small:
            small = self.small[name]
            return small.excess * self._excess_ratio, tuple(cost * self._cost_ratio for cost in small.costs)
        return None

    def _learn(self, centers: dict[tuple[str, ...], Variant]) -> None:
        """The ends of each axis, of the groups that promise most first: first values before last ones, and axes of many
        values before those of few."""
        promise = {group: math.prod(self._expected[center.name]) for group, center in centers.items()}
        for group in sorted(centers, key=lambda g: (promise[g], g)):
            center, members = centers[group], self._groups[group]
            axes = sorted(range(len(center.position)), key=lambda i: (-len({v.position[i] for v in members}), i))
            for end in (0.0, 1.0):
                for axis in axes:
                    corner = tuple(end if i == axis else x for i, x in enumerate(center.position))
                    ends = [v.name for v in members if v.position == corner and v.name != center.name]
                    if self.used() + sum(self._price(name) for name in ends) > DESIGN * self.budget:
                        return
                    self._run(ends, self.has_small and self._is_small_worthwhile())

    def _is_small_worthwhile(self) -> bool:
        parts = [outcome.spent / outcome.cost for outcome in self.small.values() if outcome.cost > 0]
        return not parts or float(np.median(parts)) < WORTHWHILE

    def _price(self, name: str) -> float:
        """The cost of one more trial, in variants of mean cost."""
        parts = [outcome.spent / outcome.cost for outcome in self.small.values() if outcome.cost > 0]
        return float(np.median(parts)) if parts and self._is_small_worthwhile() else 1.0

    def _next(self) -> tuple[str, bool] | None:
        """The next trial: its variant, and whether it is a small one."""
        best = self.best()
        met = best is not None and self.full[best].excess <= 1
        limit = self.full[best].cost if met else math.inf
        pool = []
        for variant in self.variants:
            if variant.name in self.failed or variant.name in self.full:
                continue
            excess, cost = self._expected[variant.name]
            if cost < limit:
                pool.append((excess, cost, variant.name))
        if not pool:
            return None
        good = [(cost, excess, name) for excess, cost, name in pool if excess <= 1]
        if good:
            name = min(good)[2]
        else:
            small = self.has_small and self._is_small_worthwhile()
            near = [entry for entry in pool if entry[0] <= (GUESS if small and entry[2] not in self.small else SLACK)]
            if met and not near:
                return None
            name = min(near or pool)[2]
        full_price = self._expected[name][1] / self._mean_cost()
        is_small = self.has_small and name not in self.small and self._is_small_worthwhile()
        price = self._price(name) * full_price if is_small else full_price
        if self.full and self.used() + price > self.budget:
            return None
        if not self.full and is_small and self.used() + price + full_price > self.budget:
            is_small = False  # the budget is left for one trial at full size
        return name, is_small
