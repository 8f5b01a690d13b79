"""Motions before the impact."""

from __future__ import annotations

import numpy.typing as npt

from .arrays import components

UPRIGHT = (0.0, 0.0, 1.0)
AT_REST = (0.0, 0.0, 0.0)

ABOUT_ONE_AXIS = ("peeling", "rolling_arm")

Numbers = dict[str, npt.ArrayLike | None]


def in_plane(speed_normal: npt.ArrayLike, speed_tangential: npt.ArrayLike, spin: npt.ArrayLike) -> Numbers:
    """The numbers of motions in a plane."""
    return {"speed_normal": speed_normal, "speed_tangential": speed_tangential, "spin": spin}


def at_wall(
    scene: Numbers, velocity: npt.ArrayLike, spin: npt.ArrayLike, normal: npt.ArrayLike, wall_velocity: npt.ArrayLike
) -> Numbers:
    """The numbers of motions in space towards a wall, for a scene that goes with them."""
    return _in_space(scene, {"velocity": velocity, "spin": spin, "normal": normal, "wall_velocity": wall_velocity})


def of_two(
    scene: Numbers,
    velocities: tuple[npt.ArrayLike, npt.ArrayLike],
    spins: tuple[npt.ArrayLike, npt.ArrayLike],
    normal: npt.ArrayLike,
    radius_2: npt.ArrayLike | None,
    density_2: npt.ArrayLike | None,
    gyration_ratio_2: npt.ArrayLike,
) -> Numbers:
    """The numbers of two spheres that collide, of which the second is like the first where nothing else is said."""
    vectors = {
        "velocity": velocities[0],
        "velocity_2": velocities[1],
        "spin": spins[0],
        "spin_2": spins[1],
        "normal": normal,
    }
    return {
        **_in_space(scene, vectors),
        "radius_2": scene["radius"] if radius_2 is None else radius_2,
        "density_2": scene["density"] if density_2 is None else density_2,
        "gyration_ratio_2": gyration_ratio_2,
    }


def _in_space(scene: Numbers, vectors: dict[str, npt.ArrayLike]) -> Numbers:
    for name in ABOUT_ONE_AXIS:
        if scene.get(name) is not None:
            raise ValueError(
                f"{name}: it acts against a spin about one axis, and its effect in space is not known; leave it out"
            )
    return {name: part for vector, value in vectors.items() for name, part in components(vector, value).items()}
