"""The rigid-body model against the equations of the paper."""

import math

import numpy as np
import pytest

import microimpact as mi

MASS = 4 / 3 * math.pi * 5.06e-6**3 * 2600


def body(**arguments):
    return mi.RigidBody(radius=5.06e-6, density=2600, **{"restitution_speed": 130, **arguments})


def test_restitution_with_a_work_of_adhesion():
    speed, work = np.geomspace(0.5, 50, 40), 2.22e-12
    impacts = body(work_of_adhesion=work).classify(speed)
    squared = (130 / (130 + speed)) ** 2 - 2 * work / (MASS * speed**2)  # A34
    assert (impacts.outcome == np.where(squared > 0, mi.Outcome.REBOUND, mi.Outcome.CAPTURE)).all()
    assert np.abs(impacts.overall_restitution - np.sqrt(np.maximum(squared, 0))).max() < 1e-9
    assert ((impacts.speed_over_critical > 1) == (squared > 0)).all()


@pytest.mark.parametrize(
    ("law", "restitution"),
    [
        ({"restitution": 0.7, "restitution_speed": None}, lambda v: 0.7 + 0 * v),
        ({"restitution_power": 0.5}, lambda v: 130**0.5 / (130**0.5 + v**0.5)),
        ({"adhesion_coefficient": 0.25}, lambda v: 0.75 * 130 / (130 + v)),
        ({"adhesion_speed": 0.5, "adhesion_power": 2.0}, lambda v: 130 / (130 + v) * v**2 / (0.25 + v**2)),
    ],
)
def test_laws_of_restitution_and_adhesion(law, restitution):
    speed = np.geomspace(0.1, 100, 30)
    assert np.abs(body(**law).classify(speed).overall_restitution - restitution(speed)).max() < 1e-12


def test_friction_and_spin():
    # Sliding: friction takes f (1 + R) v of the slip's velocity; the torque of the same impulse changes the spin (A9 to A11).
    speed, tangential, friction = np.array([1.0, 2.0]), 50.0, 0.1
    impacts = body(friction=friction).classify(speed, tangential, 0.0, outputs="all")
    change = friction * (speed + impacts.rebound_speed)
    assert (impacts.impact_class == mi.Class.REBOUND_SLIDING).all()
    assert np.abs(impacts.speed_tangential_out - (tangential - change)).max() < 1e-12
    assert np.abs(impacts.spin_out * 5.06e-6 - 2.5 * change).max() < 1e-12
    works = sum(impacts.quantities[f"work_{name}"] for name in ("material", "adhesion", "friction", "rolling"))
    assert np.abs(works / (impacts.energy_before - impacts.energy_after) - 1).max() < 1e-9
    # Rolling: 5/7 of the tangential velocity.
    rolling = body(friction=5.0).classify(1.0, 0.7)
    assert rolling.class_name == "rebound rolling" and rolling.speed_tangential_out == pytest.approx(0.5)


def test_a_wall_in_space():
    velocity = np.array([[3.0, 4.0, -2.0], [30.0, 40.0, -2.0]])
    impacts = body(friction=0.1).strike(velocity)
    rebound = float(impacts.rebound_speed[0])
    assert impacts.velocity_out[0, 2] == pytest.approx(rebound)
    change = 0.1 * (2 + rebound)
    assert np.allclose(impacts.velocity_out[1, :2], [30 - 0.6 * change, 40 - 0.8 * change], rtol=1e-12)


def test_one_of_each():
    with pytest.raises(ValueError, match="restitution: give one of"):
        body(restitution=0.5)
    with pytest.raises(ValueError, match="restitution: give one of"):
        mi.RigidBody(radius=1e-6, density=1e3)
    with pytest.raises(ValueError, match="adhesion: given twice"):
        body(work_of_adhesion=1e-12, adhesion_coefficient=0.1)
    with pytest.raises(ValueError, match="adhesion_power: adhesion_speed is missing"):
        body(adhesion_power=2.0)
    with pytest.raises(ValueError, match="rolling_arm: it acts against a spin about one axis"):
        body(rolling_arm=1e-8).strike([0, 0, -1])


def test_a_distributed_adhesion_says_what_it_is():
    size, speed, works = mi.LogNormal(8.6e-6, 1.3), mi.LogNormal(1.9, 1.3), mi.LogNormal(1e-12, 1.1)
    with pytest.raises(ValueError, match="^adhesion: this body has none; give it one of work_of_adhesion"):
        mi.RigidBody(density=2600, restitution_speed=130).population(diameter=size, speed=speed, adhesion=works)
    found = [
        mi.RigidBody(density=2600, restitution_speed=130, work_of_adhesion=own)
        .population(diameter=size, speed=speed, adhesion=works)
        .by_number["capture"]
        .value
        for own in (0.0, 1e-9)
    ]
    assert found[0] == found[1] and 0.1 < found[0] < 0.9
