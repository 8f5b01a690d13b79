"""One impact in time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from . import plot
from .arrays import Float


@dataclass(frozen=True, repr=False, eq=False)
class Trajectory:
    """The motion and forces during an impact: arrays with a number for each moment, from first contact on."""

    time: Float
    """Time from first contact, s."""
    indentation: Float
    """Indentation, m."""
    velocity: Float
    """Its rate, m/s: positive on the way in, negative on the way out."""
    force: Float
    """Normal force of the surface on the sphere, N, positive where it repels; without a constant external force."""
    elastic: Float
    """Elastic part of the force, N."""

    def __repr__(self) -> str:
        return f"<Trajectory: {len(self.time)} moments in {self.time[-1]:.3e} s>"

    def plot(self, ax: Any = None) -> Any:
        """Draws the force against time with matplotlib; returns the axes."""
        return plot.trajectory(self, ax)
