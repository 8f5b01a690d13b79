"""Motions before the impact."""

from __future__ import annotations

import numpy.typing as npt

from .arrays import components

UPRIGHT = (0.0, 0.0, 1.0)
AT_REST = (0.0, 0.0, 0.0)

ABOUT_ONE_AXIS = ("peeling", "rolling_arm")


def in_plane(
    speed_normal: npt.ArrayLike, speed_tangential: npt.ArrayLike, spin: npt.ArrayLike
) -> dict[str, npt.ArrayLike | None]:
    """The numbers of motions in a plane."""
    return {"speed_normal": speed_normal, "speed_tangential": speed_tangential, "spin": spin}


def in_space(
    scene: dict[str, npt.ArrayLike | None],
    velocity: npt.ArrayLike,
    spin: npt.ArrayLike,
    normal: npt.ArrayLike,
    wall_velocity: npt.ArrayLike,
) -> dict[str, npt.ArrayLike | None]:
    """The numbers of motions in space, for a scene that goes with them."""
    for name in ABOUT_ONE_AXIS:
        if scene.get(name) is not None:
            raise ValueError(f"{name}: it acts against a spin about one axis, and its effect in space is not known; leave it out")
    vectors = {"velocity": velocity, "spin": spin, "normal": normal, "wall_velocity": wall_velocity}
    return {name: part for vector, value in vectors.items() for name, part in components(vector, value).items()}
