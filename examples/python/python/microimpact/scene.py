"""The contact simulation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy.typing as npt

from . import _native
from .arrays import ByValue, Float, one_number, rows, whole_number
from .distributions import Distributed
from .impacts import AT_WALL, OF_TWO, PLANAR, Impacts, computed, critical_speeds, outputs_of
from .laws import Contact
from .methods import Adaptive, Method, checked
from .motions import AT_REST, UPRIGHT, Numbers, at_wall, in_plane, of_two
from .population import PARTICLES, TOLERANCE, Population
from .tables import BoundaryTable, RestitutionTable
from .trajectory import Trajectory

SIMULATED = (
    "max_indentation",
    "turning_indentation",
    "time_peak",
    "contact_time",
    "time_roll",
    "impulse_hertz",
    "impulse_adhesion_rebound",
    "work_material",
    "work_adhesion",
    "work_friction",
    "work_rolling",
    "energy_before",
    "energy_after",
    "rotation",
    "displacement_tangential",
)
"""What a simulation can be asked for: lengths in m, times in s, impulses in N s, works and energies in J, angles in rad.
`energy_before` and `energy_after` are those of the motion in the plane of the impact, relative to the wall or of two spheres to
each other; their difference is what the impact takes. Works of a capture are those until the sphere first turns back."""

COMPLIANT = (*(name for name in SIMULATED if name != "time_roll"), "impulse_ratio_out", "phases")
"""The same of a contact that is compliant along the surface, which slips and sticks several times."""


MOST_CELLS = 128
"""Largest number of cells of a boundary table."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene(ByValue):
    """Spheres, the law of their contact with a surface, and what happens along the surface.

    Every number may be an array. Solid spheres have `gyration_ratio` 0.4. A peeling moment goes with the law `Ring`; a
    `stiffness_ratio` makes the contact stick elastically, and goes with `Hertz` without an external force.
    """

    density: npt.ArrayLike
    """Density, kg/m^3, 1e-2 to 1e6."""
    contact: Contact
    """The law of contact: `Hertz`, `Ring`, `Dmt` or `Jkr`."""
    radius: npt.ArrayLike | None = None
    """Radius, m, 1e-10 to 1. Tables and populations do not need it."""
    friction: npt.ArrayLike = 0.0
    """Coulomb's friction coefficient f, 0 to 1e3."""
    peeling: npt.ArrayLike | None = None
    """Strength lambda of the peeling moment, N m, 0 to 1e3."""
    stiffness_ratio: npt.ArrayLike | None = None
    """Tangential stiffness over (3/2) K a, 1e-3 to 1e3; about 0.85 for a Poisson's ratio of 0.25."""
    gyration_ratio: npt.ArrayLike = 0.4
    """Squared radius of gyration over the squared radius, 1e-3 to 1."""
    tolerance: float = _native.TOLERANCE
    """Tolerance of e^2 and of all outputs, 1e-13 to 1e-2, of all that is computed without another `method`."""

    def __post_init__(self) -> None:
        if not isinstance(self.contact, Contact):
            raise TypeError(f"contact: {self.contact!r} is refused: give Hertz, Ring, Dmt or Jkr")
        one_number("tolerance", self.tolerance)
        if self.peeling is not None and self.stiffness_ratio is not None:
            raise ValueError("peeling: it is not known with a stiffness_ratio; leave one of them out")

    def _numbers(self) -> Numbers:
        return {
            "radius": self.radius,
            "density": self.density,
            "gyration_ratio": self.gyration_ratio,
            "friction": self.friction,
            "peeling": self.peeling,
            "stiffness_ratio": self.stiffness_ratio,
            **self.contact.numbers(),
        }

    def _with_radius(self) -> Numbers:
        if self.radius is None:
            raise ValueError("radius: missing; give the radius of the spheres in m")
        return self._numbers()

    def _material(self) -> dict[str, float | Float]:
        """The numbers without the radius, each of which is one number."""
        numbers = {name: value for name, value in self._numbers().items() if name != "radius"}
        return {name: one_number(name, value) for name, value in numbers.items() if value is not None}

    def _simulated(
        self,
        motions: Numbers,
        basic: tuple[str, ...],
        outputs: str | Sequence[str],
        errors: str,
        method: Method | None,
    ) -> Impacts:
        by = Adaptive(self.tolerance) if method is None else checked(method)
        if self.stiffness_ratio is not None and not isinstance(by, Adaptive):
            name = type(by).__name__
            raise ValueError(
                f"stiffness_ratio: the method {name} is not offered with it; use Adaptive, or leave it out"
            )
        names = outputs_of(outputs, basic, SIMULATED if self.stiffness_ratio is None else COMPLIANT)
        words = self.contact.words()

        def compute(numbers: dict[str, float | Float], count: int) -> _native._Results:
            return _native.simulate(words, numbers, count, by, names)

        return computed(rows({**self._with_radius(), **motions}), errors, compute)

    def simulate(
        self,
        speed_normal: npt.ArrayLike,
        speed_tangential: npt.ArrayLike = 0.0,
        spin: npt.ArrayLike = 0.0,
        *,
        outputs: str | Sequence[str] = (),
        errors: str = "raise",
        method: Method | None = None,
    ) -> Impacts:
        """Simulates impacts in a plane.

        `speed_normal` is the approach speed, m/s, a positive number; `speed_tangential` the tangential velocity, m/s; `spin` the
        spin, rad/s. `outputs` names quantities besides restitution and the velocities after the impact, or is "all"; they are
        listed in `microimpact.scene.SIMULATED`, and cost about as much time again. Raises ValueError for the first impact that
        is refused or does not converge; with errors="status" the result says so in its `status`. `method` is `Adaptive` with the
        scene's tolerance, or another of `microimpact.methods`, of which `Adaptive` alone goes with a stiffness_ratio.
        """
        return self._simulated(in_plane(speed_normal, speed_tangential, spin), PLANAR, outputs, errors, method)

    def strike(
        self,
        velocity: npt.ArrayLike,
        spin: npt.ArrayLike = AT_REST,
        *,
        normal: npt.ArrayLike = UPRIGHT,
        wall_velocity: npt.ArrayLike = AT_REST,
        outputs: str | Sequence[str] = (),
        errors: str = "raise",
        method: Method | None = None,
    ) -> Impacts:
        """Simulates impacts in space, on a wall of any direction that may move.

        Arguments are vectors: their last axis has three components. `velocity` and `wall_velocity` in m/s, `spin` in rad/s;
        `normal` has length one and points from the wall to the sphere. The result has `velocity_out` and `spin_out` as vectors.
        """
        motions = at_wall(self._numbers(), velocity, spin, normal, wall_velocity)
        return self._simulated(motions, AT_WALL, outputs, errors, method)

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
        method: Method | None = None,
    ) -> Impacts:
        """Simulates collisions of two spheres in space, of which the second is like the first where nothing else is said.

        Velocities in m/s and spins in rad/s are vectors: their last axis has three components. `normal` has length one and points
        from the second sphere to the first. The result has `velocity_out` and `spin_out` of the first sphere, `velocity_2_out` and
        `spin_2_out` of the second. A captured sphere stays in contact with the other.
        """
        both, spins = (velocity, velocity_2), (spin, spin_2)
        motions = of_two(self._with_radius(), both, spins, normal, radius_2, density_2, gyration_ratio_2)
        return self._simulated(motions, OF_TWO, outputs, errors, method)

    def classify(
        self,
        speed_normal: npt.ArrayLike,
        speed_tangential: npt.ArrayLike = 0.0,
        spin: npt.ArrayLike = 0.0,
        *,
        outputs: str | Sequence[str] = (),
        errors: str = "raise",
        method: Method | None = None,
    ) -> Impacts:
        """Simulates impacts as `simulate` does, and adds `speed_over_critical`: the approach speed over the critical speed.

        It is infinite where every speed rebounds, and zero where none does. The search for critical speeds takes several
        times as long as a simulation, and keeps the scene's tolerance with every `method`.
        """
        impacts = self.simulate(speed_normal, speed_tangential, spin, outputs=outputs, errors=errors, method=method)
        return impacts.with_margin(speed_normal, self.critical_speed(errors=errors))

    def critical_speed(self, *, errors: str = "raise") -> Float:
        """The critical speeds, m/s: spheres of this speed and of every lower one are captured.

        Zero where spheres of every speed rebound, infinite where those of every speed from 1e-12 to 1e6 m/s are captured.
        """
        words = self.contact.words()

        def compute(numbers: dict[str, float | Float], count: int) -> tuple[_native._Statuses, Float]:
            return _native.critical_speeds(words, numbers, count, self.tolerance)

        return critical_speeds(rows(self._with_radius()), errors, compute)

    def trajectory(self, speed_normal: float, speed_tangential: float = 0.0, spin: float = 0.0) -> Trajectory:
        """One impact in time: indentation, velocity and force at the nodes of the solution, up to 1024.

        Arguments as for `simulate`, each of them one number, as those of the scene. A captured sphere is followed until it first
        turns back or, if it creeps, to rest.
        """
        numbers = {**self._with_radius(), **in_plane(speed_normal, speed_tangential, spin)}
        single = {name: one_number(name, value) for name, value in numbers.items() if value is not None}
        return Trajectory(**_native.trajectory(self.contact.words(), single, self.tolerance))

    def boundary_table(self, smallest_radius: float = 1e-6, cells: int = 24) -> BoundaryTable:
        """A table of critical speeds for this material, from a radius (m) on; four cells an octave, 1 to 128."""
        smallest, material = one_number("smallest_radius", smallest_radius), self._material()
        cells = whole_number("cells", cells, 1, MOST_CELLS)
        return BoundaryTable(_native.BoundaryTable(self.contact.words(), material, smallest, cells, self.tolerance))

    def restitution_table(self, smallest_radius: float = 1e-6, speed_ratio: float = 10.0) -> RestitutionTable:
        """A table of restitution for this material, over two octaves of radii from the smallest (m), and up to `speed_ratio`
        (1.1 to 1e4) times the critical speed."""
        smallest, ratio = one_number("smallest_radius", smallest_radius), one_number("speed_ratio", speed_ratio)
        words, material = self.contact.words(), self._material()
        return RestitutionTable(_native.RestitutionTable(words, material, smallest, ratio, self.tolerance))

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
        """What a population of spheres does. Quantities are independent: numbers, `LogNormal`, `Normal` or `Samples`.

        `diameter` in m; `speed` along the path in m/s; `angle_deg` between the path and the normal, in degrees; `adhesion` takes
        the place of the number of adhesion that the law has. Capture efficiency is that in `bins` ranges of diameters, or between
        the `edges` (m), NaN in a range without spheres; the bounce fraction that at each of the `speeds` (m/s), with the
        interval for as many `particles`. Angles end at 89.9 degrees. Spheres do not spin before the impact.

        Each result has an estimate of its error, which `tolerance`, 1e-9 to 1e-3, makes smaller; that of the default is about 1e-4 or
        less. With the default, a table by size takes less than a second where three of the quantities are distributed, and about
        15 s of one core where all four are; a tolerance of 1e-6 takes three times as long, and one of 2e-7 more than ten times.
        """
        for name in ("peeling", "stiffness_ratio"):
            if self._numbers()[name] is not None:
                raise ValueError(f"{name}: populations do not take it; leave it out")
        if adhesion is not None and self.contact.law == "hertz":
            raise ValueError("adhesion: the law Hertz has none; choose Ring, Dmt or Jkr")

        def compute(shapes: Population.Shapes, questions: Population.Questions) -> dict[str, object]:
            return _native.population_of_contacts(
                self.contact.words(), self._material(), shapes, questions, self.tolerance
            )

        return Population.of(compute, diameter, speed, angle_deg, adhesion, bins, edges, speeds, particles, tolerance)
