"""Distributions of the quantities of a population."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .arrays import ByValue, Float, number_array, one_number


@dataclass(frozen=True)
class LogNormal:
    """A log-normal distribution by its median and its geometric standard deviation, at least 1."""

    median: float
    geometric_deviation: float


@dataclass(frozen=True)
class Normal:
    """A normal distribution of a positive quantity by its mean and its standard deviation. It begins at a thousandth of its mean;
    that of an angle begins at zero."""

    mean: float
    deviation: float


@dataclass(frozen=True, eq=False)
class Samples(ByValue):
    """Measured values, each as probable as the others."""

    values: npt.ArrayLike


Distributed = float | LogNormal | Normal | Samples

Shape = tuple[str, float, float] | Float


def shape(name: str, distributed: Distributed) -> Shape:
    """The distribution, for Rust."""
    if isinstance(distributed, LogNormal):
        median = one_number(name, distributed.median)
        return ("log-normal", median, one_number(name, distributed.geometric_deviation))
    if isinstance(distributed, Normal):
        mean, deviation = (one_number(name, number) for number in (distributed.mean, distributed.deviation))
        return ("normal", mean, deviation)
    if isinstance(distributed, Samples):
        return np.ascontiguousarray(number_array(name, distributed.values).reshape(-1))
    if not np.isscalar(distributed) and np.ndim(distributed):
        raise TypeError(f"{name}: an array is refused: give a number, LogNormal, Normal or Samples")
    return ("fixed", one_number(name, distributed), 0.0)
