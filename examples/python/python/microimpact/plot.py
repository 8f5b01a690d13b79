"""Pictures by matplotlib, which is imported when the first is drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .arrays import Float, number_array

if TYPE_CHECKING:
    from .fitting import Fit
    from .population import Sizes
    from .rigid_body import RigidBody
    from .scene import Scene
    from .trajectory import Trajectory


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as pyplot
    except ImportError as error:
        raise ImportError('pictures need matplotlib: pip install "microimpact[plot]"') from error
    return pyplot.subplots()[1]


def _logarithmic(axes: Any) -> None:
    """Makes the horizontal axis logarithmic, with plain numbers at 1, 2 and 5 of each decade."""
    from matplotlib.ticker import LogLocator, NullFormatter

    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())


def restitution(scene: Scene | RigidBody, speed_normal: npt.ArrayLike, ax: Any = None) -> Any:
    """Draws overall restitution against approach speed (m/s) of a scene of one sphere; returns the axes."""
    from .rigid_body import RigidBody

    axes = _axes(ax)
    speeds = number_array("speed_normal", speed_normal)
    impacts = scene.classify(speeds) if isinstance(scene, RigidBody) else scene.simulate(speeds)
    axes.plot(speeds, impacts.overall_restitution)
    axes.set(xlabel="approach speed, m/s", ylabel="overall restitution", ylim=(0, 1))
    _logarithmic(axes)
    return axes


POINTS = 10
"""Points that are drawn for each node, so that lines show no corners."""


def _smooth(x: Float, y: Float) -> tuple[Float, Float]:
    """A curve through nodes: cubics whose slopes at the nodes are those of the parabolas through three of them."""
    nodes = np.append(True, np.diff(x) > 0)
    x, y = x[nodes], y[nodes]
    if len(x) < 3:
        return x, y
    slope = np.gradient(y, x)
    # One row of points for each interval, from its first node on.
    part, width = np.arange(POINTS) / POINTS, np.diff(x)[:, None]
    rise = np.diff(y)[:, None]
    first, second = width * slope[:-1, None] - rise, rise - width * slope[1:, None]
    inner = y[:-1, None] + part * rise + part * (1 - part) * (first * (1 - part) + second * part)
    return np.append(x[:-1, None] + width * part, x[-1]), np.append(inner, y[-1])


def trajectory(course: Trajectory, ax: Any = None) -> Any:
    """Draws the force of an impact against time, as a smooth curve through the nodes; returns the axes."""
    axes = _axes(ax)
    axes.plot(*_smooth(1e9 * course.time, 1e6 * course.force), label="total")
    axes.plot(*_smooth(1e9 * course.time, 1e6 * course.elastic), "--", label="elastic")
    axes.axhline(0.0, color="grey", linewidth=0.5)
    axes.set(xlabel="time from first contact, ns", ylabel="normal force, µN")
    axes.legend()
    return axes


def sizes(ranges: Sizes, ax: Any = None) -> Any:
    """Draws the capture efficiency of ranges of diameters; returns the axes."""
    axes = _axes(ax)
    edges = 1e6 * np.append(ranges.diameter_from, ranges.diameter_to[-1:])
    axes.stairs(ranges.capture, edges, label="by number")
    axes.stairs(ranges.capture_by_mass, edges, linestyle="--", label="by mass")
    axes.set(xlabel="diameter, µm", ylabel="capture efficiency", ylim=(0, 1))
    _logarithmic(axes)
    axes.legend()
    return axes


def fit(found: Fit, ax: Any = None) -> Any:
    """Draws measured impacts, and the fitted curve with its bounds of 95 %; returns the axes."""
    axes = _axes(ax)
    axes.plot(*found.data, ".", label="measured")
    if found.curve is not None:
        speeds, curve, low, high = found.curve
        axes.plot(speeds, curve, label=found.law)
        axes.fill_between(speeds, low, high, alpha=0.3, label="95 %")
    axes.set(xlabel="approach speed, m/s", ylabel="overall restitution", ylim=(0, 1))
    axes.legend()
    return axes
