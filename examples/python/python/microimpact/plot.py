"""Pictures by matplotlib, which is imported when the first is drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

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


def restitution(scene: Scene | RigidBody, speed_normal: npt.ArrayLike, ax: Any = None) -> Any:
    """Draws overall restitution against approach speed (m/s) of a scene of one sphere; returns the axes."""
    from .rigid_body import RigidBody

    axes = _axes(ax)
    speeds = np.asarray(speed_normal, dtype=np.float64)
    impacts = scene.classify(speeds) if isinstance(scene, RigidBody) else scene.simulate(speeds)
    axes.plot(speeds, impacts.overall_restitution)
    axes.set(xlabel="approach speed, m/s", ylabel="overall restitution", xscale="log", ylim=(0, 1))
    return axes


def trajectory(course: Trajectory, ax: Any = None) -> Any:
    """Draws the force of an impact against time; returns the axes."""
    axes = _axes(ax)
    axes.plot(1e9 * course.time, 1e6 * course.force, label="total")
    axes.plot(1e9 * course.time, 1e6 * course.elastic, "--", label="elastic")
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
    axes.set(xlabel="diameter, µm", ylabel="capture efficiency", xscale="log", ylim=(0, 1))
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
