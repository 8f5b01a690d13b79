"""Shapes, statuses, errors, and threads."""

import copy
import multiprocessing
import os
import pickle
import signal
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


@pytest.mark.parametrize(
    "value",
    [
        np.array(["2020-01-01"], dtype="M8[D]"),
        np.array([3], dtype="m8[s]"),
        np.array([2.8 + 1j]),
        2.8 + 1j,
        "2.8",
        ["2.8", "3"],
        [2.8, None],
        [[2.8], [1, 2]],
        True,
        [True, False],
    ],
)
def test_what_is_no_number_is_refused(value):
    with pytest.raises(TypeError, match="^speed_normal: .*is refused: give a number or an array of numbers"):
        SCENE.simulate(value)


def test_what_a_mask_hides_is_not_a_number():
    speeds = np.ma.array([2.8, 1.0, 2.8], mask=[False, True, False])
    impacts = SCENE.classify(speeds, errors="status")
    assert list(impacts.status) == [mi.Status.SOLVED, mi.Status.REFUSED, mi.Status.SOLVED]
    assert impacts.parameter[1] == "speed_normal" and np.isnan(impacts.speed_over_critical[1])
    with pytest.raises(ValueError, match=r"^speed_normal: approach speed is NaN.*at index 1"):
        SCENE.simulate(speeds)
    with pytest.raises(ValueError, match="^diameter: must be finite"):
        SCENE.population(diameter=mi.Samples(np.ma.array([1e-5, 2e-5], mask=[0, 1])), speed=2.0)


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
    for name in ("friction", "gyration_ratio"):
        scene = mi.Scene(**{"radius": 1e-6, "density": 1e3, "contact": SCENE.contact, name: None})
        with pytest.raises(ValueError, match=f"^{name}: missing"):
            scene.simulate(1.0)
    with pytest.raises(ValueError, match="^tolerance: an array is refused"):
        mi.Scene(density=1e3, contact=SCENE.contact, tolerance=[1e-9, 1e-6])
    with pytest.raises(TypeError, match="^Contact has no law"):
        mi.laws.Contact(stiffness=1e10)
    for name, radius in [("radius_2", -1.0), ("density_2", 0.0), ("gyration_ratio_2", 2.0)]:
        with pytest.raises(ValueError, match=f"^{name}: "):
            SCENE.collide([0, 0, -4.0], **{name: radius})
        assert SCENE.collide([0, 0, -4.0], **{name: radius}, errors="status").parameter == name
    with pytest.raises(ValueError, match="^radius is -1"):
        mi.Scene(radius=-1.0, density=1e3, contact=SCENE.contact).collide([0, 0, -4.0])
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
    soft = mi.Scene(radius=1e-6, density=2600, contact=mi.Ring(stiffness=75, adhesion=250, zeta_h=10.5, zeta_a=6.25))
    together = "stiffness, zeta_h, zeta_a, speed_normal"
    assert soft.simulate(2.8, errors="status").parameter == together
    with pytest.raises(ValueError, match=f"^{together}: damping over elasticity is .*, but must be 0 to 1e9"):
        soft.simulate(2.8)
    with pytest.raises(ValueError, match="errors: "):
        SCENE.simulate(1.0, errors="ignore")


def test_quantities_that_were_not_asked_for():
    impacts = SCENE.simulate(2.8)
    with pytest.raises(AttributeError, match=r'give outputs=\["contact_time"\]'):
        _ = impacts.contact_time
    assert not hasattr(impacts, "colour")


def test_outputs_that_an_impact_cannot_have():
    body = mi.RigidBody(radius=1e-6, density=1e3, restitution=0.5)
    compliant = mi.Scene(radius=1e-6, density=1e3, contact=mi.Hertz(stiffness=1e10), stiffness_ratio=0.85)
    for thing, output in [
        (SCENE, "phases"),
        (SCENE, "rolling_ratio"),
        (compliant, "time_roll"),
        (body, "contact_time"),
    ]:
        with pytest.raises(ValueError, match=f'^outputs: "{output}" is refused: impacts of this kind have '):
            thing.classify(2.8, outputs=[output])
    assert compliant.simulate(2.8, 1.0, outputs=["phases"]).phases >= 1
    assert np.isfinite(SCENE.classify(2.8, outputs=["contact_time"]).contact_time)
    for wrong in (None, 3):
        with pytest.raises(TypeError, match="^outputs: "):
            SCENE.simulate(2.8, outputs=wrong)


def test_many_rows_are_those_of_single_calls():
    # More than are computed at a time.
    speed = np.linspace(0.5, 5.0, 2 * mi.arrays.AT_A_TIME + 7)
    body = mi.RigidBody(radius=5.06e-6, density=2600, restitution_speed=130, work_of_adhesion=2.22e-12)
    restitution = body.classify(speed).overall_restitution
    for row in (0, mi.arrays.AT_A_TIME - 1, mi.arrays.AT_A_TIME, len(speed) - 1):
        assert restitution[row] == body.classify(speed[row]).overall_restitution
    speed[mi.arrays.AT_A_TIME + 5] = -1.0
    with pytest.raises(ValueError, match=f"at index {mi.arrays.AT_A_TIME + 5}"):
        body.classify(speed)


def test_scenes_travel_between_processes():
    assert pickle.loads(pickle.dumps(SCENE)) == SCENE
    radii = np.array([1e-6, 2e-6])
    many = mi.Scene(radius=radii, density=2600, contact=SCENE.contact)
    assert pickle.loads(pickle.dumps(many)) == many
    assert many != mi.Scene(radius=2 * radii, density=2600, contact=SCENE.contact) and many != SCENE
    assert mi.Samples(radii) == mi.Samples(radii.copy()) != mi.Samples(radii[:1])
    impacts = SCENE.simulate([1.0, 2.8])
    assert (copy.deepcopy(impacts).overall_restitution == impacts.overall_restitution).all()
    assert (pickle.loads(pickle.dumps(impacts)).impact_class == impacts.impact_class).all()


def test_what_can_change_has_no_hash():
    assert hash(pickle.loads(pickle.dumps(SCENE))) == hash(SCENE)

    def scene(radius):
        return mi.Scene(radius=radius, density=2600, contact=SCENE.contact)

    assert len({scene((1e-6, 2e-6)), scene((1e-6, 2e-6)), scene((1e-6, 3e-6))}) == 2
    for radius in (np.array([1e-6, 2e-6]), [1e-6, 2e-6]):
        assert scene(radius) == scene((1e-6, 2e-6))
        with pytest.raises(TypeError, match="^radius: an array or a list has no hash, because its numbers may change"):
            hash(scene(radius))


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


def restitution(speed):
    return float(SCENE.simulate(np.full(100, speed)).overall_restitution[0])


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no fork on this system")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_fork_computes_after_its_parent_has():
    speeds = [2.8, 5.0]
    expected = [restitution(speed) for speed in speeds]
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(restitution, speeds).get(timeout=60) == expected
    assert restitution(2.8) == expected[0]


def test_an_interrupt_ends_a_call():
    # A shell ignores interrupts for what it runs in the background.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    speeds = np.full(3_000_000, 2.8)
    interrupt = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    begin = time.perf_counter()
    SCENE.simulate(speeds[: len(speeds) // 20])
    whole = 20 * (time.perf_counter() - begin)
    interrupt.start()
    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        SCENE.simulate(speeds)
    assert time.perf_counter() - begin < 0.2 + 0.5 * whole
