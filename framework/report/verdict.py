"""What a number that was measured with some seeds says against a limit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

HOLDS, FAILS, UNDECIDED, NOISE = "holds", "fails", "undecided", "noise"

# Of Student's t distribution, two-sided, 95 %, for 1 to 9 degrees of freedom, and of the normal distribution.
_T_95 = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262)
_NORMAL_95 = 1.960


@dataclass(frozen=True)
class Estimate:
    """A number and the ends of its interval of 95 %, which are the number itself where its noise is not known."""

    value: float
    low: float
    high: float


def _half_width(count: int, variance: float) -> float:
    """Half of the interval of a mean of `count` values, from the mean's variance."""
    return (_T_95[count - 2] if count - 2 < len(_T_95) else _NORMAL_95) * math.sqrt(variance)


def mean_of(values: Sequence[float]) -> Estimate:
    """The mean over seeds. Of one seed alone the noise is not known."""
    count = len(values)
    mean = sum(values) / count
    if count == 1:
        return Estimate(mean, mean, mean)
    variance = sum((value - mean) ** 2 for value in values) / (count - 1)
    half = _half_width(count, variance / count)
    return Estimate(mean, mean - half, mean + half)


def magnitude_of(values: Sequence[float]) -> Estimate:
    """The mean of signed values, without its sign."""
    mean = mean_of(values)
    ends = sorted((abs(mean.low), abs(mean.high)))
    return Estimate(abs(mean.value), 0.0 if mean.low < 0 < mean.high else ends[0], ends[1])


def root_mean_square_of(values: Sequence[float]) -> Estimate:
    """The root of the mean square: what errors of several seeds are together."""
    return _root(mean_of([value * value for value in values]))


def _root(square: Estimate) -> Estimate:
    """What is below 0 by noise counts as 0."""
    return Estimate(*(math.sqrt(max(0.0, part)) for part in (square.value, square.low, square.high)))


def shared_error_of(errors: Sequence[np.ndarray]) -> Estimate:
    """The root mean square of what images of independent seeds have in common of their errors: the mean of products of two
    different ones, in which noise cancels, that of references of their own too. Its interval is the jackknife's over seeds; two
    seeds don't tell it, and it is without end.

    @param errors of two seeds or more, of the same shape
    """
    count = len(errors)
    products = np.array([[np.mean(one * other) for other in errors] for one in errors])

    def shared(seeds: np.ndarray) -> float:
        part = products[np.ix_(seeds, seeds)]
        return (part.sum() - np.trace(part)) / (len(seeds) * (len(seeds) - 1))

    seeds = np.arange(count)
    if count == 2:
        return Estimate(_root(Estimate(shared(seeds), 0, 0)).value, 0.0, math.inf)
    without_one = np.array([shared(np.delete(seeds, seed)) for seed in seeds])
    square, half = shared(seeds), _half_width(count, (count - 1) * without_one.var())
    return _root(Estimate(square, square - half, square + half))


def verdict(estimate: Estimate, limit: float) -> str:
    """HOLDS or FAILS where the whole interval is on one side of the limit, or the value was not measured (NaN: FAILS). Else
    NOISE where half of the interval is more than a third of the limit, so that more samples or seeds would tell; and
    UNDECIDED where the value is that near to its limit."""
    if math.isnan(estimate.value) or estimate.low > limit:
        return FAILS
    if estimate.high <= limit:
        return HOLDS
    return NOISE if estimate.high - estimate.low > 2 / 3 * limit else UNDECIDED
