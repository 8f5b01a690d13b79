"""Results of impacts."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import IntEnum
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _native
from .arrays import Float, Rows, number_array

if TYPE_CHECKING:
    from ._native import _Results, _Statuses


class Status(IntEnum):
    """How the computation of an impact ended."""

    SOLVED = 0
    """There is a result. Its class may be undecided."""
    NOT_CONVERGED = 1
    """The method did not converge; there is no result."""
    UNSUPPORTED = 2
    """The method cannot represent the law of contact; there is no result."""
    REFUSED = 3
    """A number is outside its range; there is no result."""


class Outcome(IntEnum):
    """How an impact ends."""

    NONE = -1
    """There is no result."""
    REBOUND = 0
    """The sphere leaves the surface."""
    CAPTURE = 1
    """The surface holds the sphere."""
    UNDECIDED = 2
    """Rebound and capture are closer to each other than the tolerance."""


class Class(IntEnum):
    """Outcome of an impact, and motion along the surface."""

    NONE = -1
    """There is no result."""
    REBOUND_SLIDING = 0
    REBOUND_ROLLING = 1
    CAPTURED_SLIDING = 2
    CAPTURED_ROLLING = 3
    CAPTURED_RESTING = 4
    UNDECIDED = 5


CLASSES: tuple[str, ...] = (
    "rebound sliding",
    "rebound rolling",
    "captured sliding",
    "captured rolling",
    "captured resting",
    "undecided",
)
"""The names of the classes, in the order of their codes."""

OUTCOMES = np.array([0, 0, 1, 1, 1, 2, -1], dtype=np.int8)
"""The outcome of each class; the last is that of -1, no result."""

PLANAR = ("overall_restitution", "rebound_speed", "speed_tangential_out", "spin_out", "friction_over_limit")
"""What is computed without being asked for."""

VECTORS = ("velocity_out", "spin_out", "velocity_2_out", "spin_2_out")
"""What is computed of impacts in space: motions of the sphere, and of the second of two."""

BOTH = ("overall_restitution", "rebound_speed", "friction_over_limit")
AT_WALL = (*BOTH, *(f"{vector}_{axis}" for vector in VECTORS[:2] for axis in "xyz"))
OF_TWO = (*BOTH, *(f"{vector}_{axis}" for vector in VECTORS for axis in "xyz"))
"""What is computed without being asked for in space."""


class Impacts:
    """Results of impacts, in the shape to which the arguments were broadcast.

    Quantities are attributes (`impacts.overall_restitution`); `quantities` has their names. An impact that does not have a
    quantity has NaN there: a capture has no contact time, and a row without a result has nothing.
    """

    status: npt.NDArray[np.int8]
    """`Status` of each impact."""
    impact_class: npt.NDArray[np.int8]
    """`Class` of each impact."""
    quantities: dict[str, Float]
    """The quantities by their names, in SI units."""

    overall_restitution: Float
    """Rebound speed over approach speed; zero for a capture."""
    rebound_speed: Float
    """Speed along the normal after the impact, m/s; zero for a capture."""
    speed_tangential_out: Float
    """Tangential velocity, m/s: after a rebound, or of a captured sphere when its slip has ended."""
    friction_over_limit: Float
    """Friction divided by the least friction that ends the slip: from one on, the sphere rolls. NaN with a peeling moment or a
    `stiffness_ratio`, and by another method than `Adaptive`."""
    spin_out: Float
    """Spin after the impact, rad/s; vectors for impacts in space."""
    velocity_out: Float
    """Velocity after an impact in space, m/s: vectors."""
    velocity_2_out: Float
    """Velocity of the second of two spheres after a collision, m/s: vectors."""
    spin_2_out: Float
    """Spin of the second of two spheres after a collision, rad/s: vectors."""

    def __init__(self, parts: list[_Results], shape: tuple[int, ...]) -> None:
        def whole(arrays: Iterable[npt.NDArray[Any]]) -> npt.NDArray[Any]:
            return np.concatenate(list(arrays)).reshape(shape)

        self.status = whole(status for (status, _, _), _, _ in parts)
        self.impact_class = whole(classes for _, classes, _ in parts)
        self._parameter = whole(parameter for (_, parameter, _), _, _ in parts)
        self.quantities = {name: whole(numbers[name] for _, _, numbers in parts) for name in parts[0][2]}
        for name in VECTORS:
            components = [self.quantities.pop(f"{name}_{axis}", None) for axis in "xyz"]
            if all(component is not None for component in components):
                known = [component for component in components if component is not None]
                self.quantities[name] = np.stack(known, axis=-1)

    def __getattr__(self, name: str) -> Float:
        quantities: dict[str, Float] = self.__dict__.get("quantities", {})
        if name in quantities:
            return quantities[name]
        if name in _native.QUANTITIES:
            raise AttributeError(f'{name} was not computed; give outputs=["{name}"]')
        raise AttributeError(f"impacts have no {name}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.quantities]

    @property
    def outcome(self) -> npt.NDArray[np.int8]:
        """`Outcome` of each impact."""
        return np.asarray(OUTCOMES[self.impact_class])

    @property
    def class_name(self) -> npt.NDArray[np.str_]:
        """The class of each impact in words; empty where there is no result."""
        return np.asarray(np.array([*CLASSES, ""])[self.impact_class])

    @property
    def parameter(self) -> npt.NDArray[np.str_]:
        """The argument that was refused in each impact, or those that only together are out of range; empty where none was."""
        return np.asarray(np.array([*_native.PARAMETERS, ""])[self._parameter])

    def with_margin(self, speed_normal: npt.ArrayLike, critical: Float) -> Impacts:
        """Adds the quantity `speed_over_critical`: infinite where every speed rebounds, zero where none does."""
        with np.errstate(divide="ignore"):
            margin = number_array("speed_normal", speed_normal) / critical
        margin = np.broadcast_to(margin, self.status.shape)
        self.quantities["speed_over_critical"] = np.where(self.impact_class == Class.NONE, np.nan, margin)
        return self

    def __repr__(self) -> str:
        counts = ((name, int((self.impact_class == code).sum())) for code, name in enumerate(CLASSES))
        words = ", ".join(f"{count} {name}" for name, count in counts if count)
        failed = int((self.status != Status.SOLVED).sum())
        return (
            f"<Impacts {self.status.shape}: {words or 'no result'}{f', {failed} without a result' if failed else ''}>"
        )


def computed(broadcast: Rows, errors: str, compute: Callable[[dict[str, float | Float], int], _Results]) -> Impacts:
    """Computes the impacts of all rows, some at a time."""
    check_errors(errors)
    parts, before = [], 0
    for numbers, count in broadcast.parts():
        parts.append(compute(numbers, count))
        check(errors, parts[-1][0][2], before, broadcast.shape)
        before += count
    return Impacts(parts, broadcast.shape)


def critical_speeds(
    broadcast: Rows, errors: str, compute: Callable[[dict[str, float | Float], int], tuple[_Statuses, Float]]
) -> Float:
    """Computes the critical speeds of all rows, some at a time."""
    check_errors(errors)
    parts, before = [], 0
    for numbers, count in broadcast.parts():
        (_, _, failure), speeds = compute(numbers, count)
        check(errors, failure, before, broadcast.shape)
        parts.append(speeds)
        before += count
    return np.concatenate(parts).reshape(broadcast.shape)


def check_errors(errors: str) -> None:
    """Demands that errors are raised or are statuses."""
    if errors not in ("raise", "status"):
        raise ValueError(f'errors: "{errors}" is refused: it must be "raise" or "status"')


def check(errors: str, failure: tuple[int, str] | None, before: int, shape: tuple[int, ...]) -> None:
    """Raises an error for the first row that failed, with some rows before it, unless statuses are asked for."""
    if failure is None or errors == "status":
        return
    row, reason = failure
    place = ", ".join(str(int(index)) for index in np.unravel_index(before + row, shape)) if shape else ""
    raise ValueError(f"{reason} (at index {place})" if place else reason)


def outputs_of(asked: object, basic: tuple[str, ...], more: tuple[str, ...]) -> list[str]:
    """The names of the quantities: the basic ones, and those asked for of the others that an impact of this kind has."""
    if isinstance(asked, str):
        if asked != "all":
            raise ValueError(f'outputs: "{asked}" is refused: give a list of names, or "all"')
        return [*basic, *more]
    if not isinstance(asked, Iterable):
        raise TypeError(f'outputs: {asked!r} is refused: give a list of names, or "all"')
    # Vectors are computed by their components.
    vectors = [name for name in VECTORS if f"{name}_x" in basic]
    planar = [name for name in PLANAR if name not in vectors]
    names = [name for name in asked if name not in vectors]
    known = dict.fromkeys([*basic, *planar, *more])
    for name in names:
        if name not in known:
            raise ValueError(f'outputs: "{name}" is refused: impacts of this kind have {", ".join([*known, *vectors])}')
    return list(dict.fromkeys([*basic, *names]))
