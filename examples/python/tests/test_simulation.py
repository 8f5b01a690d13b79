"""The contact simulation against solutions to 20 digits, closed forms and balances."""

import math
import pickle

import numpy as np
import pytest

import microimpact as mi

# Of e^2 and of outputs relative to their scale: the reference is exact, the tolerance of the scenes is 1e-9.
CLOSE = 3e-8


def glass_on_steel(radius=5.06e-6, **arguments):
    contact = mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=6.25, zeta_h=10.5)
    return mi.Scene(radius=radius, density=2600, contact=contact, **{"friction": 0.1, **arguments})


def test_the_papers_scenes(table):
    # The others are next to the critical speed, where outputs depend strongly on the inputs.
    cases = table("cases.csv").where(lambda row: row["family"] != "near_critical" and float(row["peeling_n_m"]) == 0)
    contact = mi.Ring(
        stiffness=cases["stiffness_pa"], adhesion=cases["adhesion_n_m"], zeta_h=cases["zeta_h"], zeta_a=cases["zeta_a"]
    )
    scene = mi.Scene(
        radius=cases["radius_m"], density=cases["density_kg_m3"], contact=contact, friction=cases["friction"]
    )
    motion = (cases["speed_normal_m_s"], cases["speed_tangential_m_s"], cases["spin_rad_s"])
    impacts = scene.simulate(*motion, outputs="all")
    captured = impacts.outcome == mi.Outcome.CAPTURE
    assert len(captured) > 40 and captured.any()
    assert (np.where(captured, "capture", "rebound") == cases.words("outcome")).all()
    words = np.char.add(np.char.add(cases.words("outcome"), " "), cases.words("motion"))
    assert (impacts.class_name == words)[~captured].all()
    assert np.abs(impacts.overall_restitution**2 - cases["restitution"] ** 2).max() < CLOSE
    # A sphere that creeps to rest has no peak.
    assert (np.isnan(impacts.max_indentation) == np.isnan(cases["max_indentation_m"])).all()
    assert np.nanmax(np.abs(impacts.max_indentation / cases["max_indentation_m"] - 1)) < CLOSE
    rebounds = ~captured
    assert np.abs(impacts.contact_time / cases["contact_time_s"] - 1)[rebounds].max() < CLOSE
    assert np.isnan(impacts.contact_time[captured]).all()
    speed = np.abs(cases["speed_tangential_m_s"]) + cases["speed_normal_m_s"]
    assert (np.abs(impacts.speed_tangential_out - cases["speed_tangential_out_m_s"]) < CLOSE * speed)[rebounds].all()


def test_the_peeling_moment(table):
    cases = table("cases.csv").where(lambda row: float(row["peeling_n_m"]) > 0)
    contact = mi.Ring(
        stiffness=cases["stiffness_pa"], adhesion=cases["adhesion_n_m"], zeta_h=cases["zeta_h"], zeta_a=cases["zeta_a"]
    )
    scene = mi.Scene(
        radius=cases["radius_m"],
        density=cases["density_kg_m3"],
        contact=contact,
        friction=cases["friction"],
        peeling=cases["peeling_n_m"],
    )
    impacts = scene.simulate(cases["speed_normal_m_s"], cases["speed_tangential_m_s"], cases["spin_rad_s"])
    rebounds = cases.words("outcome") == "rebound"
    assert 2 <= rebounds.sum() < len(rebounds)
    assert ((impacts.outcome == mi.Outcome.REBOUND) == rebounds).all()
    scale = np.abs(cases["spin_out_rad_s"]) + cases["speed_normal_m_s"] / cases["radius_m"]
    assert (np.abs(impacts.spin_out - cases["spin_out_rad_s"]) < 1e-6 * scale)[rebounds].all()


LAWS = {
    "hertz": lambda end, work, **damped: mi.Hertz(end_rule=end, **damped),
    "dmt": lambda end, work, **damped: mi.Dmt(work_of_adhesion=work, **damped),
    "jkr": lambda end, work, **damped: mi.Jkr(work_of_adhesion=work, end_rule=end, **damped),
}


def of_row(row):
    damping = (
        {}
        if row["damping"] in ("none", "")
        else {"damping": row["damping"], "damping_value": float(row["damping_value"])}
    )
    if row["law"] == "ring":
        contact = mi.Ring(
            stiffness=float(row["stiffness_pa"]),
            adhesion=float(row["adhesion_n_m"]),
            zeta_a=float(row["zeta_a"] or 0),
            **damping,
        )
    else:
        work = float(row["work_of_adhesion_j_m2"] or 0)
        contact = LAWS[row["law"]](row["end_rule"], work, stiffness=float(row["stiffness_pa"]), **damping)
    return mi.Scene(radius=float(row["radius_m"]), density=float(row["density_kg_m3"]), contact=contact)


def test_the_other_laws(table):
    found = set()
    for row in table("laws.csv").rows:
        impact = of_row(row).simulate(float(row["speed_normal_m_s"]), outputs=["contact_time"])
        assert mi.Outcome(int(impact.outcome)).name.lower() == row["outcome"], row
        assert abs(float(impact.overall_restitution) ** 2 - float(row["restitution"] or 0) ** 2) < CLOSE, row
        if row["outcome"] == "rebound":
            assert abs(float(impact.contact_time) / float(row["contact_time_s"]) - 1) < 1e-6, row
        found.add((row["law"], row["damping"], row["end_rule"]))
    assert {law for law, *_ in found} == {"hertz", "ring", "dmt", "jkr"}


def test_critical_speeds(table):
    for row in table("laws_critical.csv").rows:
        assert abs(float(of_row(row).critical_speed()) / float(row["critical_speed_m_s"]) - 1) < CLOSE, row
    spheres = table("critical.csv")
    found = glass_on_steel(spheres["radius_m"]).critical_speed()
    same = (spheres["adhesion_n_m"] == 250) & (spheres["zeta_h"] == 10.5) & (spheres["density_kg_m3"] == 2600)
    assert same.any() and np.abs(found / spheres["critical_speed_m_s"] - 1)[same].max() < CLOSE
    bare = mi.Scene(radius=1e-6, density=1e3, contact=mi.Hertz(stiffness=1e10))
    assert bare.critical_speed() == 0
    margins = glass_on_steel(spheres["radius_m"]).classify(2 * found).speed_over_critical
    assert np.abs(margins - 2).max() < 1e-12


def test_tangential_compliance(table):
    cases = table("tangential.csv")
    scene = mi.Scene(
        radius=cases["radius_m"],
        density=cases["density_kg_m3"],
        contact=mi.Hertz(stiffness=cases["stiffness_pa"], zeta_h=cases["zeta_h"]),
        friction=cases["friction"],
        stiffness_ratio=cases["stiffness_ratio"],
    )
    motion = (cases["speed_normal_m_s"], cases["speed_tangential_m_s"], cases["spin_rad_s"])
    impacts = scene.simulate(*motion, outputs="all")
    speed = np.abs(cases["speed_tangential_m_s"]) + cases["speed_normal_m_s"]
    assert (np.abs(impacts.speed_tangential_out - cases["speed_tangential_out_m_s"]) < 1e-7 * speed).all()
    assert (impacts.phases == cases["phases"]).mean() > 0.9
    spatial = scene.strike(
        np.stack([motion[1], 0 * motion[1], -motion[0]], axis=-1),
        np.stack([0 * motion[2], motion[2], 0 * motion[2]], -1),
    )
    assert np.abs(spatial.velocity_out[:, 0] - impacts.speed_tangential_out).max() < 1e-9 * speed.max()


def test_a_trajectory_keeps_the_momentum():
    scene, sphere_mass = glass_on_steel(), 4 / 3 * math.pi * 5.06e-6**3 * 2600
    course, impact = scene.trajectory(2.8), scene.simulate(2.8, outputs=["contact_time", "max_indentation"])
    assert course.time[0] == 0 and course.time[-1] == pytest.approx(float(impact.contact_time), rel=1e-12)
    assert course.indentation.max() == pytest.approx(float(impact.max_indentation), rel=1e-12)
    # The trapezoidal rule on few nodes.
    impulse = np.sum(0.5 * (course.force[1:] + course.force[:-1]) * np.diff(course.time))
    assert impulse == pytest.approx(sphere_mass * (2.8 + float(impact.rebound_speed)), rel=0.02)


def test_a_creeping_sphere_is_followed_to_rest():
    ring = mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=6.25, zeta_h=10.5)
    course = mi.Scene(radius=1e-7, density=2600, contact=ring).trajectory(2.8)
    equilibrium = 2 * math.pi * 250 / 7.5e10
    assert course.indentation[-1] == pytest.approx(equilibrium, rel=2e-3)
    assert (np.diff(course.indentation) > 0).all() and course.velocity[-1] < 1e-3 * course.velocity.max()


def test_hertz_in_closed_form():
    radius, density, stiffness, speed = 1e-3, 7800.0, 1.5e11, np.array([0.1, 1.0, 10.0])
    scene = mi.Scene(radius=radius, density=density, contact=mi.Hertz(stiffness=stiffness))
    impacts = scene.simulate(speed, outputs=["contact_time", "max_indentation"])
    mass = 4 / 3 * math.pi * radius**3 * density
    # The force is sqrt(r) K delta^(3/2), so that (2/5) sqrt(r) K delta^(5/2) is the kinetic energy at first contact.
    peak = (1.25 * mass * speed**2 / (math.sqrt(radius) * stiffness)) ** 0.4
    duration = 2 * math.sqrt(math.pi) * math.gamma(1.4) / math.gamma(0.9) * peak / speed
    assert np.abs(impacts.max_indentation / peak - 1).max() < 1e-9
    assert np.abs(impacts.contact_time / duration - 1).max() < 1e-8
    assert np.abs(impacts.overall_restitution - 1).max() < 1e-9


def test_the_ledger_of_energies_adds_up():
    impacts = glass_on_steel().simulate([2.0, 2.8, 9.0], [0.0, 5.0, 1.0], [1e5, 0.0, -1e4], outputs="all")
    works = sum(impacts.quantities[f"work_{name}"] for name in ("material", "adhesion", "friction", "rolling"))
    lost = impacts.energy_before - impacts.energy_after
    assert np.abs(works / lost - 1).max() < 1e-8


def test_space_is_the_same_in_every_frame():
    rng = np.random.default_rng(1)
    velocity, spin = rng.normal(size=(50, 3)) * 5, rng.normal(size=(50, 3)) * 1e6
    velocity[:, 2] = -np.abs(velocity[:, 2]) - 1
    rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    rotation *= np.sign(np.linalg.det(rotation))
    wall = np.array([0.3, -2.0, 0.5])
    scene = glass_on_steel()
    upright = scene.strike(velocity, spin, wall_velocity=[0, 0, 0])
    turned = scene.strike(velocity @ rotation.T + wall, spin @ rotation.T, normal=rotation[:, 2], wall_velocity=wall)
    assert (turned.impact_class == upright.impact_class).all()
    assert np.abs(turned.velocity_out - wall - upright.velocity_out @ rotation.T).max() < 1e-7
    assert np.abs(turned.spin_out - upright.spin_out @ rotation.T).max() < 1e-7 * np.abs(spin).max()


def test_tables_agree_with_the_simulation():
    scene = glass_on_steel(radius=None)
    rng = np.random.default_rng(2)
    radius, speed = 2e-6 * 4 ** rng.random(400), 20 ** rng.random(400)
    impacts = glass_on_steel(radius).simulate(speed)
    boundary = scene.boundary_table(1.9e-6, cells=12)
    verdict = boundary.classify(radius, speed)
    decided = verdict < mi.TableOutcome.TOO_CLOSE_TO_CALL
    assert decided.mean() > 0.98 and (verdict == impacts.outcome)[decided].all()
    assert 0 < boundary.margin < 1e-3
    reading = scene.restitution_table(1.9e-6).read(radius, speed)
    known = ~np.isnan(reading.error)
    assert known.mean() > 0.7
    assert (np.abs(reading.overall_restitution - impacts.overall_restitution) <= reading.error + 1e-9)[known].all()
    assert boundary.classify(1e-9, 1.0) == mi.TableOutcome.OUTSIDE_TABLE


def test_two_spheres_keep_their_momenta():
    rng = np.random.default_rng(3)
    count, radius, second = 200, 10 ** rng.uniform(-6, -5, 200), 10 ** rng.uniform(-6, -5, 200)
    velocity, spin = rng.normal(size=(2, count, 3)) * 5, rng.normal(size=(2, count, 3)) * 1e5
    normal = rng.normal(size=(count, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    # The first sphere approaches along the normal, which points to it.
    closing = ((velocity[0] - velocity[1]) * normal).sum(axis=1)
    velocity[0] -= (np.maximum(closing, 0) + 1)[:, None] * normal
    scene = mi.Scene(radius=radius, density=2600, contact=mi.Hertz(stiffness=7e10, zeta_h=5), friction=0.2)
    after = scene.collide(
        velocity[0], spin[0], velocity_2=velocity[1], spin_2=spin[1], normal=normal, radius_2=second, density_2=1000
    )
    masses = np.array([2600 * radius**3, 1000 * second**3])[:, :, None]
    velocities, spins = (
        np.array([after.velocity_out, after.velocity_2_out]),
        np.array([after.spin_out, after.spin_2_out]),
    )
    momentum = (masses * (velocities - velocity)).sum(axis=0)
    assert np.abs(momentum / (masses[0] * np.abs(velocity).max(axis=(0, 2))[:, None])).max() < 1e-9
    # The angular momentum about the contact point of each sphere: r x p of its centre, and that of its spin.
    arms = np.array([radius[:, None] * normal, -second[:, None] * normal])
    inertias = 0.4 * masses * np.array([radius, second])[:, :, None] ** 2
    angular = np.cross(arms, masses * (velocities - velocity)) + inertias * (spins - spin)
    assert np.abs(angular).max(axis=2).max() < 1e-9 * (masses * np.abs(arms).max() * 50).max()
    energy = [(masses * v**2 + inertias * w**2).sum(axis=(0, 2)) for v, w in ((velocity, spin), (velocities, spins))]
    assert (energy[1] < energy[0]).all()
    relative = ((velocities[0] - velocities[1]) * normal).sum(axis=1)
    approach = ((velocity[1] - velocity[0]) * normal).sum(axis=1)
    assert np.abs(relative / approach - after.overall_restitution).max() < 1e-9


def test_tables_refuse_and_travel():
    scene = glass_on_steel(None)
    boundary, restitution = scene.boundary_table(1.9e-6, cells=8), scene.restitution_table(1.9e-6)
    for read in (boundary.classify, restitution.read):
        for radius, speed, name in [([5e-6, 5e-6], [2.8, -1], "speed_normal"), ([5e-6, np.nan], 2.8, "radius")]:
            with pytest.raises(ValueError, match=rf"^{name}.*at index 1"):
                read(radius, speed)
    outcome = boundary.classify([5e-6, -1.0, 5e-6], [9.0, 2.8, np.nan], errors="status")
    assert list(outcome) == [mi.TableOutcome.REBOUND, mi.TableOutcome.NONE, mi.TableOutcome.NONE]
    reading = restitution.read(2e-6, [100.0, 0.0], errors="status")
    assert reading.outcome[1] == mi.TableOutcome.NONE and np.isnan(reading.overall_restitution[1])
    for table in (boundary, restitution):
        same = pickle.loads(pickle.dumps(table))
        assert same == table and hash(same) == hash(table)
    assert boundary != scene.boundary_table(1.9e-6, cells=4)
    for make in (scene.boundary_table, scene.restitution_table):
        with pytest.raises(ValueError, match="^smallest_radius: radius is -1"):
            make(-1)
    elastic = mi.Scene(density=2600, contact=mi.Hertz(stiffness=7.5e10))
    for make in (elastic.boundary_table, elastic.restitution_table):
        with pytest.raises(
            ValueError, match="^contact: critical speed is 0 m/s.* a table needs a contact that captures"
        ):
            make()
    with pytest.raises(TypeError, match="^cells: 1.5 is refused: give a whole number, 1 to 128"):
        scene.boundary_table(1.9e-6, 1.5)
