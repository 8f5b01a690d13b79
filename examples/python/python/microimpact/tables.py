"""Tables that answer without a simulation."""

from __future__ import annotations

from decimal import ROUND_UP, Context
from enum import IntEnum
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from . import _native
from .arrays import Float, Rows, rows
from .impacts import check, check_errors


class TableOutcome(IntEnum):
    """What a table says of an impact."""

    NONE = -1
    """The radius or the speed is outside its range: there is no such impact."""
    REBOUND = 0
    CAPTURE = 1
    TOO_CLOSE_TO_CALL = 2
    """The speed is closer to the critical speed than the error of the table."""
    OUTSIDE_TABLE = 3
    """The table does not cover this radius or this speed."""


class Reading(NamedTuple):
    """What a restitution table says of impacts."""

    outcome: npt.NDArray[np.int8]
    """`TableOutcome`."""
    overall_restitution: Float
    """Zero for a capture; NaN where the table does not know."""
    error: Float
    """Bound of the error of the restitution."""


def _rounded_up(bound: float) -> str:
    """A bound in two digits, rounded up, so that it still is one."""
    return f"{Context(prec=2, rounding=ROUND_UP).create_decimal_from_float(bound):.1e}"


def _radii_and_speeds(radius: npt.ArrayLike, speed_normal: npt.ArrayLike) -> tuple[Float, Float, Rows]:
    broadcast = rows({"radius": radius, "speed_normal": speed_normal})
    flat = [np.atleast_1d(np.asarray(value)) for value in broadcast.numbers.values()]
    first, second = (np.ascontiguousarray(np.broadcast_to(array, (broadcast.count,))) for array in flat)
    return first, second, broadcast


class BoundaryTable:
    """The critical speed of spheres of one material as a function of the radius, with a bound of the error."""

    def __init__(self, table: _native.BoundaryTable) -> None:
        self._table = table

    @property
    def margin(self) -> float:
        """Largest relative error of a critical speed."""
        return self._table.margin

    @property
    def smallest_radius(self) -> float:
        """Smallest radius that the table covers, m."""
        return self._table.smallest_radius

    @property
    def parts(self) -> tuple[float, int, list[list[int]]]:
        """The constants of a table in firmware: smallest radius (m), margin in units of 2^-23 octaves, and cells."""
        return self._table.parts

    def classify(
        self, radius: npt.ArrayLike, speed_normal: npt.ArrayLike, *, errors: str = "raise"
    ) -> npt.NDArray[np.int8]:
        """`TableOutcome` of spheres of a radius (m) that arrive with a speed (m/s).

        Raises ValueError for the first radius or speed outside its range; with errors="status" its outcome is `TableOutcome.NONE`.
        """
        check_errors(errors)
        radii, speeds, broadcast = _radii_and_speeds(radius, speed_normal)
        outcome, failure = self._table.classify(radii, speeds)
        check(errors, failure, 0, broadcast.shape)
        return outcome.reshape(broadcast.shape)

    def __eq__(self, other: object) -> bool:
        return self.parts == other.parts if isinstance(other, BoundaryTable) else NotImplemented

    def __hash__(self) -> int:
        return hash(str(self.parts))

    def __repr__(self) -> str:
        cells = len(self.parts[2])
        return f"<BoundaryTable: {cells} cells from {self.smallest_radius:.3e} m, margin {_rounded_up(self.margin)}>"

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return _boundary_table, self.parts


def _boundary_table(smallest: float, margin: int, cells: list[list[int]]) -> BoundaryTable:
    """The table of some parts."""
    return BoundaryTable(_native.BoundaryTable.from_parts(smallest, margin, cells))


class RestitutionTable:
    """Restitution of spheres of one material as a function of radius and speed, with a bound of the error."""

    def __init__(self, table: _native.RestitutionTable) -> None:
        self._table = table

    @property
    def error(self) -> float:
        """Largest interpolation error of a restitution; that of a reading is larger close to the critical speed."""
        return self._table.error

    def read(self, radius: npt.ArrayLike, speed_normal: npt.ArrayLike, *, errors: str = "raise") -> Reading:
        """Outcome and restitution of spheres of a radius (m) that arrive with a speed (m/s).

        Raises ValueError for the first radius or speed outside its range; with errors="status" its outcome is `TableOutcome.NONE`
        and its numbers are NaN.
        """
        check_errors(errors)
        radii, speeds, broadcast = _radii_and_speeds(radius, speed_normal)
        outcome, restitution, error, failure = self._table.read(radii, speeds)
        check(errors, failure, 0, broadcast.shape)
        shape = broadcast.shape
        return Reading(outcome.reshape(shape), restitution.reshape(shape), error.reshape(shape))

    def __eq__(self, other: object) -> bool:
        return self._table.parts == other._table.parts if isinstance(other, RestitutionTable) else NotImplemented

    def __hash__(self) -> int:
        return hash(str(self._table.parts))

    def __repr__(self) -> str:
        (smallest, _, _), _, _ = self._table.parts
        return f"<RestitutionTable: from {smallest:.3e} m, error {_rounded_up(self.error)}>"

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return _restitution_table, self._table.parts


def _restitution_table(boundary: object, scales: object, nodes: object) -> RestitutionTable:
    """The table of some parts."""
    return RestitutionTable(_native.RestitutionTable.from_parts(boundary, scales, nodes))
