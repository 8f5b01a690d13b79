"""Fits of laws to measured impacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _native, plot
from .arrays import Float, rows

VELOCITY_ERROR = 0.01
"""Standard error of both speeds where rebound speeds have none, m/s."""

LEAST_P_VALUE = 0.001
"""Probability below which a law does not fit."""


class Quantity(NamedTuple):
    """A fitted quantity with its interval of 95 %."""

    value: float
    low: float
    high: float
    """Infinite if the data set no bound."""
    unit: str


class Candidate(NamedTuple):
    """A law that was tried."""

    law: str
    aic: float
    """Akaike's criterion less that of the best law."""
    p_value: float
    """Probability of data at least as far from the law."""

    @property
    def fits(self) -> bool:
        """Whether the law fits."""
        return self.p_value >= LEAST_P_VALUE


@dataclass(frozen=True, eq=False)
class Fit:
    """What measured impacts say."""

    law: str | None
    """The law that fits; None if none does, or if the data are not enough."""
    fits: bool | None
    """Whether a law fits; None if the data are not enough."""
    reason: str
    """Why there is no law; empty if there is one."""
    p_value: float | None
    """Probability of data at least as far from the law."""
    quantities: dict[str, Quantity]
    """Its parameters and the critical speed, by names that end with the unit."""
    candidates: list[Candidate]
    """All laws that were tried, the best first."""
    indistinguishable_laws: list[str]
    """Other laws that the data do not tell apart from it."""
    natural_scatter: float | None
    """Standard deviation of the natural scatter of the restitution."""
    outlier_fraction: float | None
    """Fraction of outliers."""
    curve: tuple[Float, Float, Float, Float] | None = field(repr=False)
    """Speeds, m/s, the fitted restitution there, and its bounds of 95 %."""
    data: tuple[Float, Float] = field(repr=False)
    """Measured approach speeds, m/s, and restitutions; a capture has zero."""

    @property
    def critical_speed(self) -> Quantity | None:
        """The critical speed, m/s."""
        return self.quantities.get("critical_speed_m_s")

    def plot(self, ax: Any = None) -> Any:
        """Draws the impacts and the fitted curve with matplotlib; returns the axes."""
        return plot.fit(self, ax)


def fit(
    speed_normal: npt.ArrayLike,
    *,
    rebound_speed: npt.ArrayLike | None = None,
    overall_restitution: npt.ArrayLike | None = None,
    captured: npt.ArrayLike | None = None,
    speed_normal_error: npt.ArrayLike | None = None,
    rebound_speed_error: npt.ArrayLike | None = None,
    overall_restitution_error: npt.ArrayLike | None = None,
    mass: npt.ArrayLike | None = None,
    mass_relative_error: npt.ArrayLike = 0.0,
    laws: Sequence[str] = (),
    natural_scatter: bool = True,
) -> Fit:
    """Fits restitution laws and laws of contact to measured impacts, by maximum likelihood.

    `speed_normal` has approach speeds, m/s. Give `rebound_speed`, m/s, or `overall_restitution`, the rebound speed over the
    approach speed. The rebound speed must lie between zero and the approach speed, give or take six standard errors, or a fifth of
    the approach speed where there are no errors. `captured` says which spheres were captured, whose rebound may be NaN; without it,
    they are those whose rebound speed is exactly zero. Standard errors of both speeds are 0.01 m/s where rebound speeds have none;
    restitutions without an error scatter by nature. With the `mass` of each sphere, kg, works are in J, and else in J/kg. `laws`
    names the laws to fit instead of all: constant, speed-restitution, elastic-plastic, viscoelastic, ring, dmt, jkr. Without
    `natural_scatter` the stated errors are all of the scatter.
    """
    if (rebound_speed is None) == (overall_restitution is None):
        raise ValueError("rebound_speed: give one of rebound_speed and overall_restitution")
    as_restitutions = overall_restitution is not None
    if as_restitutions:
        measured, error, assumed = ("overall_restitution", overall_restitution), overall_restitution_error, 0.0
        other = ("rebound_speed_error", rebound_speed_error)
    else:
        measured, error, assumed = ("rebound_speed", rebound_speed), rebound_speed_error, VELOCITY_ERROR
        other = ("overall_restitution_error", overall_restitution_error)
    if other[1] is not None:
        raise ValueError(f"{other[0]}: it does not go with {measured[0]}; give {measured[0]}_error")
    if isinstance(laws, str):
        raise TypeError(f'laws: "{laws}" is refused: give a list of names')
    broadcast = rows(
        {
            "speed_normal": speed_normal,
            "speed_normal_error": assumed if speed_normal_error is None else speed_normal_error,
            measured[0]: measured[1],
            f"{measured[0]}_error": assumed if error is None else error,
            "mass": 1.0 if mass is None else mass,
            "mass_relative_error": mass_relative_error,
            "captured": 0.0 if captured is None else _truth(captured),
        }
    )
    columns = [np.array(np.broadcast_to(value, (broadcast.count,))) for value in broadcast.numbers.values()]
    speed, speed_error, rebound, rebound_error, masses, mass_error, caught = columns
    is_captured = None
    if captured is not None:
        _require_truth("captured", caught)
        is_captured = caught != 0.0
        # A captured sphere has no rebound.
        rebound = np.where(is_captured & np.isnan(rebound), 0.0, rebound)
    numbers = (speed, speed_error, rebound, rebound_error, masses, mass_error)
    answer = _native.fit(
        numbers, is_captured, mass is not None, as_restitutions, list(dict.fromkeys(laws)), natural_scatter
    )
    at_rest = rebound == 0.0 if is_captured is None else is_captured
    return _fit(answer, (speed, np.where(at_rest, 0.0, rebound if as_restitutions else rebound / speed)))


def _truth(values: npt.ArrayLike) -> npt.ArrayLike:
    """Truth values as zeros and ones."""
    array = np.asanyarray(values)
    return array.astype(np.float64) if array.dtype.kind == "b" else values


def _require_truth(name: str, values: Float) -> None:
    wrong = ~np.isin(values, [0.0, 1.0])
    if wrong.any():
        row = int(np.argmax(wrong))
        raise ValueError(f"{name}: {values[row]} is refused: it must be True or False (at index {row})")


def _fit(answer: dict[str, Any], data: tuple[Float, Float]) -> Fit:
    law = answer.get("law")
    candidates = [Candidate(*candidate) for candidate in answer.get("candidates", [])]
    reason = answer.get("reason", "")
    if law is None and not reason:
        best = (
            f"the best, {candidates[0].law}, has p = {candidates[0].p_value:.1e}"
            if candidates
            else "no curve comes near the data"
        )
        reason = f"no law fits: {best}"
    return Fit(
        law=law,
        fits=None if "reason" in answer else law is not None,
        reason=reason,
        p_value=answer.get("p_value"),
        quantities={
            name: Quantity(value, low, high, unit) for name, unit, value, low, high in answer.get("quantities", [])
        },
        candidates=candidates,
        indistinguishable_laws=answer.get("indistinguishable_laws", []),
        natural_scatter=answer.get("natural_scatter"),
        outlier_fraction=answer.get("outlier_fraction"),
        curve=tuple(np.array(column) for column in answer["curve"]) if "curve" in answer else None,  # type: ignore[arg-type]
        data=data,
    )
