"""Samples of parameters: points within ranges, at random or as a Latin hypercube.

A Latin hypercube of N points divides every range into N parts and puts one point into each part of each range, so that
no part of any range stays empty. Same ranges, count and seed, same points. (SciPy draws them; it is imported only
here.)
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from guidewire.studies.keys import Value
from guidewire.studies.table import Rows

METHODS = ("random", "latinHypercube")


@dataclass(frozen=True)
class Range:
    """Values that a parameter can take.

    Attributes
    ----------
    key : of the parameter.
    low, high : ends of the range, in the unit of the key.
    logarithmic : whether each factor is as likely as any other, and not each difference.
    whole : whether only whole numbers are.
    """

    key: str
    low: float
    high: float
    logarithmic: bool = False
    whole: bool = False

    def __post_init__(self) -> None:
        if not self.low < self.high:
            raise ValueError(f"{self.key} goes from {self.low:g} to {self.high:g}: the second has to be above "
                             "the first")
        if self.logarithmic and self.low <= 0:
            raise ValueError(f"{self.key} goes from {self.low:g}: a logarithmic range lies above 0")

    def at(self, fraction: float) -> Value:
        """Return the value at this part of the range, 0 for its start and 1 for its end."""
        low, high = self.low, self.high
        if self.whole:  # each of them as wide as any other
            low, high = math.ceil(low) - 0.5, math.floor(high) + 0.5
        if self.logarithmic:
            value = low * (high / low) ** fraction if low > 0 else high * fraction
        else:
            value = low + fraction * (high - low)
        return min(max(round(value), math.ceil(self.low)), math.floor(self.high)) if self.whole else float(value)

    def spaced(self, count: int) -> list[Value]:
        """So many values at equal distances or factors, both ends among them; of whole numbers none twice."""
        if self.whole:
            fractions = (k / max(1, count - 1) for k in range(count))
            exact = Range(self.key, self.low, self.high, self.logarithmic)
            return list(dict.fromkeys(round(exact.at(fraction)) for fraction in fractions))
        return [self.at(k / max(1, count - 1)) for k in range(count)]


def sample(method: str, ranges: Sequence[Range], count: int, seed: int) -> Rows:
    """So many points within ranges, by one of `METHODS`."""
    if method == "random":
        import numpy

        points = numpy.random.default_rng(seed).random((count, len(ranges)))
    else:
        from scipy.stats import qmc

        points = qmc.LatinHypercube(len(ranges), seed=seed).random(count)
    rows = tuple(tuple(one.at(float(fraction)) for one, fraction in zip(ranges, point)) for point in points)
    return Rows("sample", tuple(one.key for one in ranges), rows)
