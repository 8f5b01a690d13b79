"""Statistics of populations of spheres."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from . import _native, distributions, plot
from .arrays import Float, number_array, one_number, whole_number
from .distributions import Distributed, LogNormal

MOST_BINS = 200
"""Largest number of ranges of diameters."""

PARTICLES = 100
"""Particles observed at each speed, where nothing else is said."""

MOST_PARTICLES = 4_294_967_295
"""Their largest number."""

TOLERANCE = 1e-5
"""Tolerance of the quadrature: the error of a part of an integral over one distribution at which the part is not divided again; ten
times as much for each further distribution."""

TOLERANCES = (1e-9, 1e-3)
"""Its range."""


class Estimate(NamedTuple):
    """A number, and an estimate of its error from the differences of two orders of quadrature."""

    value: float
    error: float


@dataclass(frozen=True, eq=False)
class Sizes:
    """Capture efficiency in ranges of diameters, each array with a number for each range. A range without spheres has NaN."""

    diameter_from: Float
    """Smallest diameter, m."""
    diameter_to: Float
    """Largest diameter, m."""
    number_fraction: Float
    """Part of the spheres."""
    mass_fraction: Float
    """Part of their mass."""
    capture: Float
    """Part of these spheres that is captured."""
    capture_error: Float
    """Its error."""
    capture_by_mass: Float
    """Part of the mass of these spheres that is captured."""
    capture_by_mass_error: Float
    """Its error."""


@dataclass(frozen=True, eq=False)
class Bounces:
    """Bounce fraction by speed."""

    speed: Float
    """Speed along the path, m/s."""
    fraction: Float
    """Probability of a rebound."""
    error: Float
    """Its error."""
    low: Float
    """Lower end of the interval of 95 % (Wilson 1927) in which as many `particles` are counted to rebound."""
    high: Float
    """Its upper end."""


@dataclass(frozen=True, eq=False)
class Population:
    """What a population of spheres does."""

    Shapes = tuple[distributions.Shape, distributions.Shape, distributions.Shape, "distributions.Shape | None"]
    Questions = tuple[int, Sequence[float], Sequence[float], int, float]

    by_number: dict[str, Estimate]
    """Probabilities of rebound, capture, and each class; a capture that rests counts as rolling."""
    by_mass: dict[str, Estimate]
    """The same by mass."""
    sizes: Sizes
    """Capture efficiency by size."""
    bounces: Bounces
    """Bounce fraction by speed."""
    restitution: tuple[Estimate, Estimate, Estimate]
    """Mean, variance and skewness of e of all impacts, where a capture has zero."""
    restitution_of_rebounds: tuple[Estimate, Estimate, Estimate] | None
    """The same of the rebounds alone; None if there are practically none."""

    @classmethod
    def of(
        cls,
        compute: Callable[[Any, Any], dict[str, Any]],
        diameter: Distributed,
        speed: Distributed,
        angle_deg: Distributed,
        adhesion: Distributed | None,
        bins: int,
        edges: Sequence[float],
        speeds: Sequence[float],
        particles: int,
        tolerance: float,
    ) -> Population:
        """Asks Rust for the statistics."""
        bins = whole_number("bins", bins, 0, MOST_BINS)
        edge = number_array("edges", edges).reshape(-1).tolist()
        if edge and (len(edge) < 2 or edge[0] <= 0.0 or not all(a < b for a, b in zip(edge, edge[1:]))):
            raise ValueError("edges: give two or more positive diameters in m, in increasing order")
        largest = _native.LARGEST_DIAMETER
        if edge and not edge[-1] <= largest:
            raise ValueError(
                f"edges: {edge[-1]} m is refused: a diameter must be at most {largest} m; enter 5 um as 5e-6"
            )
        fast = number_array("speeds", speeds).reshape(-1).tolist()
        if not all(np.isfinite(value) and value > 0.0 for value in fast):
            raise ValueError("speeds: give positive speeds in m/s")
        particles = whole_number("particles", particles, 1, MOST_PARTICLES)
        tolerance = one_number("tolerance", tolerance)
        if not TOLERANCES[0] <= tolerance <= TOLERANCES[1]:
            raise ValueError(f"tolerance: {tolerance} is refused: it must be {TOLERANCES[0]} to {TOLERANCES[1]}")
        shapes = (
            distributions.shape("diameter", diameter),
            distributions.shape("speed", speed),
            _angle(angle_deg),
            None if adhesion is None else distributions.shape("adhesion", adhesion),
        )
        answer = compute(shapes, (bins, edge, fast, particles, tolerance))
        if not all(np.isfinite(number) for _, estimate in answer["by_number"] for number in estimate):
            raise ValueError("population: the quadrature does not resolve these distributions; give narrower ones")

        def estimates(numbers: Any) -> tuple[Estimate, Estimate, Estimate]:
            mean, variance, skewness = (Estimate(*number) for number in numbers)
            return mean, variance, skewness

        def columns(pairs: list[tuple[float, float]]) -> Float:
            return np.array(pairs, dtype=np.float64).reshape(-1, 2).T

        ranges = np.array([size[0] for size in answer["sizes"]], dtype=np.float64).reshape(-1, 4).T
        number, mass = columns([size[1] for size in answer["sizes"]]), columns([size[2] for size in answer["sizes"]])
        bounce = columns([bounce[0] for bounce in answer["bounces"]])
        interval = columns([bounce[1] for bounce in answer["bounces"]])
        rebounds = answer["restitution_of_rebounds"]
        return cls(
            by_number={name: Estimate(*value) for name, value in answer["by_number"]},
            by_mass={name: Estimate(*value) for name, value in answer["by_mass"]},
            sizes=Sizes(*ranges, *number, *mass),
            bounces=Bounces(np.array(fast), *bounce, *interval),
            restitution=estimates(answer["restitution"]),
            restitution_of_rebounds=None if rebounds is None else estimates(rebounds),
        )

    def plot(self, ax: Any = None) -> Any:
        """Draws the capture efficiency by size with matplotlib; returns the axes."""
        return plot.sizes(self.sizes, ax)


def _angle(angle: Distributed) -> distributions.Shape:
    """An angle of incidence. It may be zero, so that a log-normal one is none."""
    if isinstance(angle, LogNormal):
        raise TypeError("angle_deg: a log-normal angle is refused: give a number, Normal or Samples")
    return distributions.shape("angle_deg", angle)
