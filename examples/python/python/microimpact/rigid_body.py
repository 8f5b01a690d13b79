"""The rigid-body model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy.typing as npt

from . import _native
from .arrays import ByValue, Float, one_number, rows
from .distributions import Distributed
from .impacts import AT_WALL, OF_TWO, PLANAR, Impacts, computed, critical_speeds, outputs_of
from .motions import AT_REST, UPRIGHT, Numbers, at_wall, in_plane, of_two
from .population import PARTICLES, TOLERANCE, Population

COMPUTED = (
    "impulse_ratio_out",
    "rolling_ratio",
    "work_material",
    "work_adhesion",
    "work_friction",
    "work_rolling",
    "energy_before",
    "energy_after",
)
"""What a rigid body can be asked for: works and energies in J. `energy_before` and `energy_after` are those of the motion in the
plane of the impact, relative to the wall or of two spheres to each other; their difference is what the impact takes."""

RESTITUTIONS = ("restitution", "restitution_speed", "yield_speed")
ADHESIONS = ("work_of_adhesion", "adhesion_coefficient", "adhesion_speed")


@dataclass(frozen=True, kw_only=True, eq=False)
class RigidBody(ByValue):
    """Spheres as rigid bodies: a restitution law, adhesion and friction. Every number may be an array.

    Restitution without adhesion is one of `restitution` R, `restitution_speed` k (with `restitution_power` p: R = k^p/(k^p + v^p)),
    and `yield_speed` (elastic-plastic, Thornton 1997). Adhesion is one of `work_of_adhesion`, `adhesion_coefficient`, and
    `adhesion_speed` l (with `adhesion_power` q: rho = l^q/(l^q + v^q)), or none.
    """

    radius: npt.ArrayLike | None = None
    """Radius, m, 1e-10 to 1. Populations do not need it."""
    density: npt.ArrayLike
    """Density, kg/m^3, 1e-2 to 1e6."""
    restitution: npt.ArrayLike | None = None
    """R, 0 to 1."""
    restitution_speed: npt.ArrayLike | None = None
    """k, m/s, 1e-6 to 1e12."""
    restitution_power: npt.ArrayLike | None = None
    """p, 0.01 to 1; 1 if not given."""
    yield_speed: npt.ArrayLike | None = None
    """Speed at which the material starts to yield, m/s, 1e-9 to 1e9."""
    work_of_adhesion: npt.ArrayLike | None = None
    """W_A, J, 0 to 1e6."""
    adhesion_coefficient: npt.ArrayLike | None = None
    """rho, 0 to 1."""
    adhesion_speed: npt.ArrayLike | None = None
    """l, m/s, 1e-9 to 1e9."""
    adhesion_power: npt.ArrayLike | None = None
    """q, 0.01 to 16; 1 if not given."""
    friction: npt.ArrayLike = 0.0
    """Coulomb's friction coefficient f, 0 to 1e3."""
    rolling_arm: npt.ArrayLike | None = None
    """Rolling-dissipation coefficient times its moment arm, m, 0 to 1."""
    gyration_ratio: npt.ArrayLike = 0.4
    """Squared radius of gyration over the squared radius, 1e-3 to 1."""

    def __post_init__(self) -> None:
        numbers = self._numbers()
        restitutions = [name for name in RESTITUTIONS if numbers[name] is not None]
        if len(restitutions) != 1:
            found = " and ".join(restitutions) if restitutions else "none"
            raise ValueError(f"restitution: give one of {', '.join(RESTITUTIONS)}; found {found}")
        adhesions = [name for name in ADHESIONS if numbers[name] is not None]
        if len(adhesions) > 1:
            raise ValueError(f"adhesion: given twice, as {' and '.join(adhesions)}; leave all but one out")
        for power, speed in (("restitution_power", "restitution_speed"), ("adhesion_power", "adhesion_speed")):
            if numbers[power] is not None and numbers[speed] is None:
                raise ValueError(f"{power}: {speed} is missing; give it too, or leave the power out")

    def _numbers(self) -> Numbers:
        return dict(vars(self))

    def _with_radius(self) -> Numbers:
        if self.radius is None:
            raise ValueError("radius: missing; give the radius of the spheres in m")
        return self._numbers()

    def _classified(
        self, motions: Numbers, basic: tuple[str, ...], outputs: str | Sequence[str], errors: str
    ) -> Impacts:
        names = outputs_of(outputs, basic, COMPUTED)

        def compute(numbers: dict[str, float | Float], count: int) -> _native._Results:
            return _native.classify(numbers, count, names)

        return computed(rows({**self._with_radius(), **motions}), errors, compute)

    def classify(
        self,
        speed_normal: npt.ArrayLike,
        speed_tangential: npt.ArrayLike = 0.0,
        spin: npt.ArrayLike = 0.0,
        *,
        outputs: str | Sequence[str] = (),
        errors: str = "raise",
    ) -> Impacts:
        """Classifies impacts in a plane, with the margins `speed_over_critical` and `friction_over_limit`.

        `speed_normal` is the approach speed, m/s, a positive number; `speed_tangential` the tangential velocity, m/s; `spin` the
        spin, rad/s. `outputs` names quantities besides restitution and the velocities after the impact, or is "all"; they are
        listed in `microimpact.rigid_body.COMPUTED`. Raises ValueError for the first impact that is refused; with errors="status"
        the result says so in its `status`. `speed_over_critical` is infinite where every speed rebounds, and zero where none
        does.
        """
        impacts = self._classified(in_plane(speed_normal, speed_tangential, spin), PLANAR, outputs, errors)
        return impacts.with_margin(speed_normal, self.critical_speed(errors=errors))

    def strike(
        self,
        velocity: npt.ArrayLike,
        spin: npt.ArrayLike = AT_REST,
        *,
        normal: npt.ArrayLike = UPRIGHT,
        wall_velocity: npt.ArrayLike = AT_REST,
        outputs: str | Sequence[str] = (),
        errors: str = "raise",
    ) -> Impacts:
        """Computes impacts in space, on a wall of any direction that may move.

        Arguments are vectors: their last axis has three components. `velocity` and `wall_velocity` in m/s, `spin` in rad/s;
        `normal` has length one and points from the wall to the sphere. The result has `velocity_out` and `spin_out` as vectors.
        """
        motions = at_wall(self._numbers(), velocity, spin, normal, wall_velocity)
        return self._classified(motions, AT_WALL, outputs, errors)

    def collide(
        self,
        velocity: npt.ArrayLike,
        spin: npt.ArrayLike = AT_REST,
        *,
        velocity_2: npt.ArrayLike = AT_REST,
        spin_2: npt.ArrayLike = AT_REST,
        normal: npt.ArrayLike = UPRIGHT,
        radius_2: npt.ArrayLike | None = None,
        density_2: npt.ArrayLike | None = None,
        gyration_ratio_2: npt.ArrayLike = 0.4,
        outputs: str | Sequence[str] = (),
        errors: str = "raise",
    ) -> Impacts:
        """Computes collisions of two spheres in space, of which the second is like the first where nothing else is said.

        Velocities in m/s and spins in rad/s are vectors: their last axis has three components. `normal` has length one and points
        from the second sphere to the first. The result has `velocity_out` and `spin_out` of the first sphere, `velocity_2_out` and
        `spin_2_out` of the second. A captured sphere stays in contact with the other.
        """
        both, spins = (velocity, velocity_2), (spin, spin_2)
        motions = of_two(self._with_radius(), both, spins, normal, radius_2, density_2, gyration_ratio_2)
        return self._classified(motions, OF_TWO, outputs, errors)

    def critical_speed(self, *, errors: str = "raise") -> Float:
        """The critical speeds, m/s: spheres of this speed and of every lower one are captured.

        Zero where spheres of every speed rebound, infinite where those of every speed are captured.
        """
        return critical_speeds(rows(self._with_radius()), errors, _native.critical_speeds_of_bodies)

    def population(
        self,
        *,
        diameter: Distributed,
        speed: Distributed,
        angle_deg: Distributed = 0.0,
        adhesion: Distributed | None = None,
        bins: int = 8,
        edges: Sequence[float] = (),
        speeds: Sequence[float] = (),
        particles: int = PARTICLES,
        tolerance: float = TOLERANCE,
    ) -> Population:
        """What a population of spheres does, as `Scene.population`, in a few seconds at most.

        `adhesion` takes the place of the body's `work_of_adhesion`, `adhesion_coefficient` or `adhesion_speed`, one of which the body
        must have: it says what the numbers are.
        """
        if self.rolling_arm is not None:
            raise ValueError("rolling_arm: populations do not take it; leave it out")
        if adhesion is not None and all(self._numbers()[name] is None for name in ADHESIONS):
            raise ValueError(
                f"adhesion: this body has none; give it one of {', '.join(ADHESIONS)}, whose place the distribution takes"
            )
        numbers = {name: value for name, value in self._numbers().items() if name != "radius" and value is not None}
        single: dict[str, float | Float] = {name: one_number(name, value) for name, value in numbers.items()}

        def compute(shapes: Population.Shapes, questions: Population.Questions) -> dict[str, object]:
            return _native.population_of_bodies(single, shapes, questions)

        return Population.of(compute, diameter, speed, angle_deg, adhesion, bins, edges, speeds, particles, tolerance)
