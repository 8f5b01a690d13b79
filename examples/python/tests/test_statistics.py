"""Populations against draws, fits against the law that made the data."""

import math
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import microimpact as mi

CONTACT = mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=6.25, zeta_h=10.5)
DRAWS = 40_000


def draws(rng, median, deviation):
    return median * np.exp(math.log(deviation) * rng.standard_normal(DRAWS))


def beyond(found, counted, number):
    """Whether a fraction that was counted lies beyond four binomial standard errors and that of the quadrature."""
    error = math.sqrt(max(found.value * (1 - found.value), 1 / number) / number)
    return abs(found.value - counted) > 4 * error + found.error


def test_a_population_against_draws():
    rng = np.random.default_rng(3)
    diameter, speed = draws(rng, 8.6e-6, 1.2), draws(rng, 3.0, 1.3)
    angle = np.radians(np.abs(30 + 5 * rng.standard_normal(DRAWS)))
    population = mi.Scene(density=2600, contact=CONTACT, friction=0.1).population(
        diameter=mi.LogNormal(8.6e-6, 1.2),
        speed=mi.LogNormal(3.0, 1.3),
        angle_deg=mi.Normal(30, 5),
        speeds=[2.0],
    )
    scene = mi.Scene(radius=diameter / 2, density=2600, contact=CONTACT, friction=0.1)
    impacts = scene.simulate(speed * np.cos(angle), speed * np.sin(angle))
    captured = impacts.outcome == mi.Outcome.CAPTURE
    sliding = np.isin(impacts.impact_class, [mi.Class.REBOUND_SLIDING, mi.Class.CAPTURED_SLIDING])
    for name, counted in {
        "capture": captured,
        "rebound_sliding": ~captured & sliding,
        "captured_sliding": captured & sliding,
    }.items():
        assert not beyond(population.by_number[name], counted.mean(), DRAWS), name
    sizes = population.sizes
    assert len(sizes.capture) == 8 and sizes.number_fraction.sum() == pytest.approx(0.998, abs=1e-6)
    for bin, (low, high) in enumerate(zip(sizes.diameter_from, sizes.diameter_to)):
        inside = (diameter > low) & (diameter <= high)
        found = mi.Estimate(sizes.capture[bin], sizes.capture_error[bin])
        assert not beyond(found, captured[inside].mean(), inside.sum()), bin
    mean = population.restitution[0]
    spread = impacts.overall_restitution.std() / math.sqrt(DRAWS)
    assert abs(mean.value - impacts.overall_restitution.mean()) < 4 * spread + mean.error
    assert 0 < population.bounces.fraction[0] < 1


def test_the_interval_of_a_bounce_fraction():
    body = mi.RigidBody(density=2600, restitution_speed=130, work_of_adhesion=1e-12, friction=0.1)
    spheres = {"diameter": mi.LogNormal(8.6e-6, 1.3), "speed": 2.0, "speeds": [1.0, 1.5, 2.0]}
    for particles in (10, 1000):
        bounces = body.population(**spheres, particles=particles).bounces
        # The ends are the probabilities from which the fraction is 1.96 standard deviations away (Wilson 1927).
        for end in (bounces.low, bounces.high):
            deviation = np.sqrt(end * (1 - end) / particles)
            assert np.abs(bounces.fraction - end) == pytest.approx(1.959964 * deviation, rel=1e-5)
        assert (bounces.low < bounces.fraction).all() and (bounces.fraction < bounces.high).all()
    with pytest.raises(ValueError, match="^particles: 0 is refused: it must be 1 to "):
        body.population(**spheres, particles=0)


def test_a_population_of_rigid_bodies_against_draws():
    rng = np.random.default_rng(4)
    diameter, speed = draws(rng, 8.6e-6, 1.3), draws(rng, 2.0, 1.2)
    body = {"density": 2600, "restitution_speed": 130, "work_of_adhesion": 1e-12, "friction": 0.1}
    population = mi.RigidBody(**body).population(diameter=mi.LogNormal(8.6e-6, 1.3), speed=mi.LogNormal(2.0, 1.2))
    captured = mi.RigidBody(radius=diameter / 2, **body).classify(speed).outcome == mi.Outcome.CAPTURE
    assert not beyond(population.by_number["capture"], captured.mean(), DRAWS)
    # Samples of the same diameters have the same captures, to the last.
    few, slow = diameter[:50], 1.2
    sampled = mi.RigidBody(**body).population(diameter=mi.Samples(few), speed=slow)
    counted = (mi.RigidBody(radius=few / 2, **body).classify(slow).outcome == mi.Outcome.CAPTURE).mean()
    assert sampled.by_number["capture"].value == pytest.approx(counted, abs=1e-12)


def test_a_smaller_tolerance_has_a_smaller_error():
    def capture(tolerance):
        return (
            mi.Scene(density=2600, contact=CONTACT)
            .population(
                diameter=mi.LogNormal(8.6e-6, 1.3),
                speed=mi.LogNormal(1.9, 1.3),
                angle_deg=mi.Normal(40, 10),
                bins=0,
                tolerance=tolerance,
            )
            .by_number["capture"]
        )

    coarse, fine = capture(1e-3), capture(1e-8)
    assert abs(coarse.value - fine.value) <= coarse.error and fine.error < 0.1 * coarse.error < 1e-4
    with pytest.raises(ValueError, match="^tolerance: 0.0 is refused"):
        capture(0.0)


def test_a_range_without_spheres_has_nan():
    body = mi.RigidBody(density=2600, restitution_speed=130, work_of_adhesion=1e-12)
    edges = [1e-8, 1e-7, 5e-6, 8e-6, 1e-5, 1e-4, 1e-3]
    for diameter in (mi.LogNormal(8.6e-6, 1.3), mi.Samples([5.5e-6, 9e-6, 9e-6, 2e-5])):
        sizes = body.population(diameter=diameter, speed=mi.LogNormal(2.0, 1.2), edges=edges).sizes
        assert (sizes.diameter_from == edges[:-1]).all() and (sizes.diameter_to == edges[1:]).all()
        assert sizes.number_fraction.sum() == pytest.approx(1)
        assert (np.isnan(sizes.capture) == (sizes.number_fraction == 0)).all() and np.isnan(sizes.capture[[0, 5]]).all()
    # The smallest sample is in the first range.
    sizes = body.population(diameter=mi.Samples([5e-6, 9e-6, 2e-5]), speed=2.0, bins=5).sizes
    assert len(sizes.capture) == 5 and sizes.number_fraction.sum() == pytest.approx(1)


def test_populations_refuse():
    scene = mi.Scene(density=2600, contact=CONTACT)
    with pytest.raises(ValueError, match="diameter: .*must be positive"):
        scene.population(diameter=-1e-6, speed=1.0)
    for diameter in (8.6, mi.LogNormal(8.6, 1.3), mi.Normal(8.6, 0.1), mi.Samples([5e-6, 8.6])):
        with pytest.raises(
            ValueError, match="^diameter: 8.6 m is refused: it must be 2e-10 to 2 m; enter 8.6 um as 8.6e-6$"
        ):
            scene.population(diameter=diameter, speed=1.0)
    with pytest.raises(ValueError, match="^diameter: the distribution reaches from .* enter a smaller deviation$"):
        scene.population(diameter=mi.LogNormal(5e-6, 20.0), speed=1.0)
    soft = mi.Scene(density=2600, contact=mi.Ring(stiffness=75, adhesion=250, zeta_h=10.5, zeta_a=6.25))
    with pytest.raises(ValueError, match="^stiffness, zeta_h, zeta_a, speed_normal: damping over elasticity"):
        soft.population(diameter=8e-6, speed=2.0)
    with pytest.raises(ValueError, match="^stiffness, zeta_h, zeta_a, speed_normal: damping over elasticity"):
        mi.Scene(radius=4e-6, density=2600, contact=soft.contact).critical_speed()
    with pytest.raises(ValueError, match="angle_deg: an angle"):
        scene.population(diameter=1e-6, speed=1.0, angle_deg=95.0)
    with pytest.raises(TypeError, match="^bins: 2.5 is refused: give a whole number, 0 to 200"):
        scene.population(diameter=1e-6, speed=1.0, bins=2.5)
    with pytest.raises(ValueError, match="edges: 10.0 m is refused: a diameter must be at most 2.0 m"):
        scene.population(diameter=1e-6, speed=1.0, edges=[5, 8, 10])
    with pytest.raises(ValueError, match="edges: "):
        scene.population(diameter=1e-6, speed=1.0, edges=[2e-6, 1e-6])
    with pytest.raises(ValueError, match="density: an array is refused"):
        mi.Scene(density=[2600, 2700], contact=CONTACT).population(diameter=1e-6, speed=1.0)


def test_a_fit_finds_the_law():
    rng = np.random.default_rng(5)
    speed, k, work_over_mass = np.geomspace(1.8, 20, 60), 100.0, 1.2
    restitution = np.sqrt((k / (k + speed)) ** 2 - 2 * work_over_mass / speed**2)
    found = mi.fit(speed, rebound_speed=restitution * speed + 0.01 * rng.standard_normal(60))
    assert found.fits and found.law == "speed-restitution" and found.p_value > 0.001
    for name, truth in (("restitution_speed_m_s", k), ("work_of_adhesion_j_kg", work_over_mass)):
        quantity = found.quantities[name]
        assert quantity.low < truth < quantity.high and quantity.high - quantity.low < 0.2 * truth
    critical = found.critical_speed
    assert critical.low < critical.value < critical.high
    assert (k / (k + critical.value)) ** 2 == pytest.approx(2 * work_over_mass / critical.value**2, rel=0.1)


def test_fits_that_say_nothing():
    few = mi.fit([1.0, 2.0], overall_restitution=[0.5, 0.6])
    assert few.fits is None and few.law is None and "not enough data" in few.reason
    rng = np.random.default_rng(6)
    speed, laws = np.geomspace(1, 30, 60), ["constant", "speed-restitution"]
    waves = 0.5 + 0.3 * np.sin(8 * np.log(speed)) + 0.01 * rng.standard_normal(60)
    wave = mi.fit(speed, overall_restitution=waves, laws=laws)
    assert wave.fits is False and wave.law is None and "no law fits" in wave.reason
    with pytest.raises(ValueError, match="speed_normal: -1.0 is refused.*at index 1"):
        mi.fit([1.0, -1.0], overall_restitution=[0.5, 0.5])
    with pytest.raises(ValueError, match="laws: "):
        mi.fit(speed, overall_restitution=0.5 + 0 * speed, laws=["linear"])


def test_measurements_that_are_refused():
    speed = np.geomspace(1.5, 20, 40)
    restitution = 130 / (130 + speed)
    for wrong in (50.0, -0.5, np.nan):
        one = np.where(np.arange(40) == 5, wrong, restitution)
        with pytest.raises(ValueError, match=rf"(?i)^overall_restitution: {wrong} is refused: it must be .*at index 5"):
            mi.fit(speed, overall_restitution=one)
        with pytest.raises(ValueError, match=r"^rebound_speed: .* is refused: it must be .* m/s.*at index 5"):
            mi.fit(speed, rebound_speed=one * speed)
    with pytest.raises(ValueError, match=r"^overall_restitution: .*at index 0"):
        mi.fit(speed, overall_restitution=100 * restitution)
    with pytest.raises(ValueError, match=r"^rebound_speed: -.*at index 0"):
        mi.fit(speed, rebound_speed=-restitution * speed)
    with pytest.raises(ValueError, match=r"^overall_restitution_error: -0.1 is refused"):
        mi.fit(speed, overall_restitution=restitution, overall_restitution_error=-0.1)
    with pytest.raises(ValueError, match=r"^mass: 0.0 is refused.* kg"):
        mi.fit(speed, overall_restitution=restitution, mass=0.0)
    with pytest.raises(ValueError, match=r"^overall_restitution: .*the sphere was captured \(at index 3\)"):
        mi.fit(speed, overall_restitution=restitution, captured=np.arange(40) == 3)
    for wrong in (np.nan, 2.0):
        with pytest.raises(ValueError, match=r"^captured: .* is refused: it must be True or False \(at index 20\)"):
            mi.fit(speed, overall_restitution=restitution, captured=np.where(np.arange(40) == 20, wrong, 0.0))
    for wrong in ([None] * 40, ["no"] * 40):
        with pytest.raises(TypeError, match="^captured: "):
            mi.fit(speed, overall_restitution=restitution, captured=wrong)
    masked = np.ma.array(restitution, mask=np.arange(40) == 7)
    with pytest.raises(ValueError, match=r"^overall_restitution: NaN is refused.*at index 7"):
        mi.fit(speed, overall_restitution=masked)


def test_a_captured_sphere_needs_no_rebound():
    speed = np.geomspace(0.5, 20, 60)
    square = (100 / (100 + speed)) ** 2 - 2 / speed**2
    captured = square < 0
    e = np.sqrt(np.where(captured, 0.0, square))
    told = [mi.fit(speed, overall_restitution=e, laws=["speed-restitution"])]
    told.append(
        mi.fit(speed, overall_restitution=np.where(captured, np.nan, e), captured=captured, laws=["speed-restitution"])
    )
    assert captured.any() and told[0].quantities == told[1].quantities and told[0].fits


LONG_FIT = """
random = np.random.default_rng(1)
speed = random.uniform(1.0, 20.0, 3000)
rebound = mi.Scene(radius=5e-6, density=2600, contact=contact).simulate(speed).rebound_speed
print("computing", flush=True)
mi.fit(speed, rebound_speed=np.clip(rebound + 0.01 * speed * random.standard_normal(3000), 0.0, speed))
"""

LONG_POPULATION = """
print("computing", flush=True)
mi.Scene(density=2600, contact=contact, friction=0.1).population(
    diameter=mi.LogNormal(8.6e-6, 1.3),
    speed=mi.LogNormal(3.0, 1.3),
    angle_deg=mi.Normal(30.0, 5.0),
    adhesion=mi.LogNormal(250.0, 1.3),
    tolerance=1e-7,
)
"""

LONG_METHOD = """
print("computing", flush=True)
scene = mi.Scene(radius=5e-6, density=2600, contact=contact, friction=0.1)
scene.simulate(np.full(30_000, 2.8), 1.0, method=mi.RungeKuttaGill(steps=20_000))
"""

BEGIN = """
import signal

import numpy as np
import microimpact as mi

# A shell ignores interrupts for what it runs in the background.
signal.signal(signal.SIGINT, signal.default_int_handler)
contact = mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=6.25, zeta_h=10.5)
"""


@pytest.mark.skipif(os.name == "nt", reason="no SIGINT for one process on this system")
@pytest.mark.parametrize("program", [LONG_FIT, LONG_POPULATION, LONG_METHOD], ids=["fit", "population", "method"])
def test_an_interrupt_ends_a_long_computation(program):
    command = [sys.executable, "-c", f"{BEGIN}{program}print('done')"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "computing\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        begin = time.perf_counter()
        output, complaint = process.communicate(timeout=60)
        # Much less than the minutes of the whole, however busy the machine is.
        assert time.perf_counter() - begin < 20.0
    assert "KeyboardInterrupt" in complaint and "done" not in output
