"""Methods of the contact simulation."""

from __future__ import annotations

from dataclasses import dataclass

from . import _native
from .arrays import one_number, whole_number


@dataclass(frozen=True)
class Adaptive:
    """Chooses nodes and intervals that keep the tolerance. It takes every scene, and decides the most impacts."""

    tolerance: float = _native.TOLERANCE
    """Tolerance of e^2 and of all outputs, 1e-13 to 1e-2."""

    def __post_init__(self) -> None:
        one_number("tolerance", self.tolerance)


@dataclass(frozen=True)
class Collocation:
    """As many intervals as the tolerance needs, with a fixed number of nodes in each."""

    nodes: int = _native.COLLOCATION_NODES[2]
    """Nodes of an interval, 5 to 14."""
    tolerance: float = _native.TOLERANCE
    """Tolerance of e^2 and of all outputs. The least depends on the nodes: 1e-9 takes 8, 1e-11 takes 9."""

    def __post_init__(self) -> None:
        whole_number("nodes", self.nodes, *_native.COLLOCATION_NODES[:2])
        one_number("tolerance", self.tolerance)


@dataclass(frozen=True)
class FixedCost:
    """For firmware: a fixed number of nodes and iterations.

    An impact that this does not resolve has the status `NOT_CONVERGED`, and one close to the critical speed is undecided. It does not
    follow a captured sphere beyond its peak, and cannot represent the law `Jkr` and the end rule "no-force".

    Four rows are computed at a time where the outputs are at most times and impulses, and there is no external force, peeling moment
    or `stiffness_ratio`.
    """

    nodes: int = _native.FIXED_COST_NODES[2]
    """Nodes of a phase, 5 to 9."""
    iterations: int = _native.ITERATIONS[2]
    """Iterations in each phase, 1 to 40."""

    def __post_init__(self) -> None:
        whole_number("nodes", self.nodes, *_native.FIXED_COST_NODES[:2])
        whole_number("iterations", self.iterations, *_native.ITERATIONS[:2])


@dataclass(frozen=True)
class RungeKuttaGill:
    """The paper's own: fixed steps in time. It does not follow a captured sphere to its turning point, and cannot represent the law
    `Jkr` and the end rule "no-force"."""

    steps: int = _native.STEPS[2]
    """Time steps in an undamped impact, 16 to 1000000."""

    def __post_init__(self) -> None:
        whole_number("steps", self.steps, *_native.STEPS[:2])


Method = Adaptive | Collocation | FixedCost | RungeKuttaGill


def checked(method: Method) -> Method:
    """An argument that must be a method."""
    if not isinstance(method, Method):
        raise TypeError(f"method: {method!r} is refused: give Adaptive, Collocation, FixedCost or RungeKuttaGill")
    return method
