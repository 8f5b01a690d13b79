"""Shapes, statuses, errors, and threads."""

import copy
import pickle
import threading
import time

import numpy as np
import pytest

import microimpact as mi

SCENE = mi.Scene(
    radius=5.06e-6,
    density=2600,
    contact=mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=6.25, zeta_h=10.5),
    friction=0.1,
)


def test_broadcasting_equals_single_calls():
    radius = np.array([[2.5e-6], [5.06e-6], [2e-5]])
    speed = np.array([0.5, 1.4, 2.8, 10.0])
    scene = mi.Scene(radius=radius, density=2600, contact=SCENE.contact, friction=0.1)
    impacts = scene.simulate(speed, 1.0)
    assert impacts.overall_restitution.shape == (3, 4) and scene.critical_speed().shape == (3, 1)
    for i, j in np.ndindex(3, 4):
        one = mi.Scene(radius=radius[i, 0], density=2600, contact=SCENE.contact, friction=0.1).simulate(speed[j], 1.0)
        assert one.impact_class.shape == ()
        assert one.impact_class == impacts.impact_class[i, j]
        assert one.overall_restitution == impacts.overall_restitution[i, j]
    with pytest.raises(ValueError, match=r"cannot be broadcast together: speed_normal \(4,\), speed_tangential \(3,\)"):
        SCENE.simulate(speed, np.zeros(3))


def test_views_lists_and_integers():
    speeds = np.arange(1, 9)[::2]
    expected = [float(SCENE.simulate(float(speed)).overall_restitution) for speed in speeds]
    assert (SCENE.simulate(speeds).overall_restitution == expected).all()
    assert (SCENE.simulate(list(speeds)).overall_restitution == expected).all()
    assert SCENE.simulate(np.empty((0, 3))).overall_restitution.shape == (0, 3)
    assert (SCENE.simulate(speeds.astype(np.float32)).overall_restitution == expected).all()


def test_errors_name_the_argument():
    with pytest.raises(ValueError, match=r"^speed_normal: approach speed is -2.8 m/s.*at index 1, 0"):
        SCENE.simulate([[1.0], [-2.8]])
    for arguments, message in [
        ({"radius": 5.0}, "^radius is 5 m, but must be 1e-10 to 1 m; enter 5 um as 5e-6"),
        ({"density": float("nan")}, "^density is NaN"),
        ({"friction": -1}, "friction: "),
        ({"gyration_ratio": 2}, "gyration_ratio: gyration ratio is 2"),
    ]:
        scene = mi.Scene(**{"radius": 1e-6, "density": 1e3, "contact": SCENE.contact, **arguments})
        with pytest.raises(ValueError, match=message):
            scene.simulate(1.0)
    with pytest.raises(ValueError, match="zeta_a: "):
        contact = mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=-1)
        mi.Scene(radius=1e-6, density=1e3, contact=contact).simulate(1.0)
    with pytest.raises(ValueError, match="^tolerance is 1, but"):
        mi.Scene(radius=1e-6, density=1e3, contact=SCENE.contact, tolerance=1).simulate(1.0)
    with pytest.raises(TypeError, match="radius: 'large' is refused"):
        mi.Scene(radius="large", density=1e3, contact=SCENE.contact).simulate(1.0)
    with pytest.raises(TypeError, match="contact: 75000000000.0 is refused"):
        mi.Scene(radius=1e-6, density=1e3, contact=7.5e10)
    with pytest.raises(ValueError, match="radius: missing"):
        mi.Scene(density=1e3, contact=SCENE.contact).simulate(1.0)
    with pytest.raises(ValueError, match='outputs: "lifetime" is refused'):
        SCENE.simulate(1.0, outputs=["lifetime"])
    with pytest.raises(ValueError, match="velocity: the shape"):
        SCENE.strike([1.0, 2.0])
    with pytest.raises(ValueError, match="normal: length of the normal"):
        SCENE.strike([0, 0, -1.0], normal=[1, 1, 1])
    with pytest.raises(ValueError, match="damping: given twice"):
        mi.Hertz(stiffness=1e10, zeta_h=1, damping="constant", damping_value=0.5)
    with pytest.raises(ValueError, match="external_force: "):
        contact = mi.Jkr(stiffness=1e10, work_of_adhesion=0.1, external_force=1e-9)
        mi.Scene(radius=1e-6, density=1e3, contact=contact).simulate(1.0)


def test_statuses_on_request():
    impacts = SCENE.simulate([1.0, -2.8, 2.8, np.nan], errors="status")
    assert list(impacts.status) == [mi.Status.SOLVED, mi.Status.REFUSED, mi.Status.SOLVED, mi.Status.REFUSED]
    assert list(impacts.parameter) == ["", "speed_normal", "", "speed_normal"]
    assert list(impacts.outcome) == [mi.Outcome.CAPTURE, mi.Outcome.NONE, mi.Outcome.REBOUND, mi.Outcome.NONE]
    assert list(np.isnan(impacts.overall_restitution)) == [False, True, False, True]
    assert list(impacts.class_name)[1] == "" and "2 without a result" in repr(impacts)
    radii = mi.Scene(radius=[1e-6, -1.0], density=2600, contact=SCENE.contact).critical_speed(errors="status")
    assert list(np.isnan(radii)) == [False, True]
    with pytest.raises(ValueError, match="errors: "):
        SCENE.simulate(1.0, errors="ignore")


def test_quantities_that_were_not_asked_for():
    impacts = SCENE.simulate(2.8)
    with pytest.raises(AttributeError, match=r'give outputs=\["contact_time"\]'):
        _ = impacts.contact_time
    assert not hasattr(impacts, "colour")


def test_scenes_travel_between_processes():
    assert pickle.loads(pickle.dumps(SCENE)) == SCENE
    impacts = SCENE.simulate([1.0, 2.8])
    assert (copy.deepcopy(impacts).overall_restitution == impacts.overall_restitution).all()
    assert (pickle.loads(pickle.dumps(impacts)).impact_class == impacts.impact_class).all()


def test_the_interpreters_lock_is_released():
    speeds, lasted = np.full(400_000, 2.8), []

    def work():
        begin = time.perf_counter()
        SCENE.simulate(speeds)
        lasted.append(time.perf_counter() - begin)

    thread = threading.Thread(target=work)
    thread.start()
    longest, before = 0.0, time.perf_counter()
    while thread.is_alive():
        time.sleep(1e-4)
        longest, before = max(longest, time.perf_counter() - before), time.perf_counter()
    thread.join()
    assert longest < 0.5 * lasted[0]
