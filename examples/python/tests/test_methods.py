"""The methods of the simulation against solutions to 20 digits, and what they refuse."""

import numpy as np
import pytest

import microimpact as mi

METHODS = [
    # Error of e^2 on the paper's scenes, and the number of scenes that are not decided.
    (mi.Adaptive(1e-6), 1e-6, 0),
    (mi.Collocation(), 1e-9, 0),
    (mi.Collocation(nodes=5, tolerance=3e-4), 3e-4, 0),
    (mi.FixedCost(nodes=9, iterations=8), 1e-6, 5),
    (mi.RungeKuttaGill(steps=1000), 1e-4, 1),
]


@pytest.mark.parametrize(("method", "error", "undecided"), METHODS)
def test_the_papers_scenes(table, method, error, undecided):
    cases = table("cases.csv").where(lambda row: row["family"] != "near_critical" and float(row["peeling_n_m"]) == 0)
    names = {"stiffness": "stiffness_pa", "adhesion": "adhesion_n_m", "zeta_h": "zeta_h", "zeta_a": "zeta_a"}
    contact = mi.Ring(**{name: cases[column] for name, column in names.items()})
    scene = mi.Scene(
        radius=cases["radius_m"], density=cases["density_kg_m3"], contact=contact, friction=cases["friction"]
    )
    motion = (cases["speed_normal_m_s"], cases["speed_tangential_m_s"], cases["spin_rad_s"])
    impacts = scene.simulate(*motion, method=method, outputs=["contact_time"], errors="status")
    decided = np.isin(impacts.outcome, [mi.Outcome.REBOUND, mi.Outcome.CAPTURE])
    assert (~decided).sum() <= undecided
    captured = impacts.outcome == mi.Outcome.CAPTURE
    assert (captured == (cases.words("outcome") == "capture"))[decided].all()
    assert np.abs(impacts.overall_restitution**2 - cases["restitution"] ** 2)[decided].max() < error
    rebounds = decided & ~captured
    assert np.abs(impacts.contact_time / cases["contact_time_s"] - 1)[rebounds].max() < 100 * error


GLASS = mi.Scene(radius=5.06e-6, density=2600, contact=mi.Hertz(stiffness=7.5e10, zeta_h=10.5), friction=0.1)


def with_law(contact):
    return mi.Scene(radius=5.06e-6, density=2600, contact=contact)


def test_the_default_is_adaptive():
    speeds = [2.0, 3.0, 5.0]
    expected = GLASS.simulate(speeds).overall_restitution
    assert (GLASS.simulate(speeds, method=mi.Adaptive()).overall_restitution == expected).all()
    loose = mi.Adaptive(1e-6)
    assert (GLASS.simulate(speeds, method=loose).overall_restitution != expected).any()


def test_all_kinds_of_impacts_take_a_method():
    method, velocity = mi.FixedCost(nodes=9, iterations=6), [[1.0, 0.0, -3.0], [0.0, 2.0, -5.0]]
    for impacts, expected in [
        (GLASS.strike(velocity, method=method), GLASS.strike(velocity)),
        (GLASS.collide(velocity, method=method), GLASS.collide(velocity)),
    ]:
        assert np.abs(impacts.velocity_out - expected.velocity_out).max() < 1e-6
        assert (impacts.velocity_out != expected.velocity_out).any()
    classified = GLASS.classify([3.0, 5.0], method=method)
    assert (classified.impact_class == GLASS.simulate([3.0, 5.0]).impact_class).all()
    assert np.isinf(classified.speed_over_critical).all()


@pytest.mark.parametrize("method", [mi.FixedCost(), mi.RungeKuttaGill()])
@pytest.mark.parametrize(
    "contact", [mi.Jkr(stiffness=7.5e10, work_of_adhesion=0.4), mi.Hertz(stiffness=7.5e10, end_rule="no-force")]
)
def test_laws_that_a_method_cannot_represent(method, contact):
    with pytest.raises(ValueError, match=r"^method: it cannot represent this law of contact; use Adaptive or Coll"):
        with_law(contact).simulate(3.0, method=method)
    assert with_law(contact).simulate(3.0, method=method, errors="status").status == mi.Status.UNSUPPORTED
    assert with_law(contact).simulate(3.0, method=mi.Collocation()).status == mi.Status.SOLVED


def test_without_convergence():
    damped = with_law(mi.Hertz(stiffness=7.5e10, zeta_h=[10.0, 1e5]))
    with pytest.raises(ValueError, match=r"^method: FixedCost did not converge; use .* or Adaptive \(at index 1\)"):
        damped.simulate(3.0, method=mi.FixedCost())
    impacts = damped.simulate(3.0, method=mi.FixedCost(), errors="status")
    assert impacts.status.tolist() == [mi.Status.SOLVED, mi.Status.NOT_CONVERGED]


def test_rows_of_fixed_cost_are_single_calls():
    rows = np.arange(203)
    speeds = 0.5 * 1.02**rows
    # A row in seven is damped too strongly for the method, and a row in eleven has a number outside its range.
    zeta_h, radii = np.where(rows % 7 == 3, 1e5, 10.5), np.where(rows % 11 == 5, -1.0, 5.06e-6)
    names, quantities = ["contact_time"], ["overall_restitution", "speed_tangential_out", "spin_out", "contact_time"]

    def simulate(row):
        contact = mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=6.25, zeta_h=zeta_h[row])
        scene = mi.Scene(radius=radii[row], density=2600, contact=contact, friction=0.1)
        return scene.simulate(speeds[row], 3.0, method=mi.FixedCost(), outputs=names, errors="status")

    together, alone = simulate(rows), [simulate(row) for row in rows]
    assert together.status.tolist() == [impact.status for impact in alone]
    assert set(together.status) == {mi.Status.SOLVED, mi.Status.NOT_CONVERGED, mi.Status.REFUSED}
    assert together.impact_class.tolist() == [impact.impact_class for impact in alone]
    assert {mi.Class.REBOUND_ROLLING, mi.Class.CAPTURED_ROLLING} <= set(together.impact_class)
    for name in quantities:
        expected = np.array([getattr(impact, name) for impact in alone])
        np.testing.assert_allclose(getattr(together, name), expected, rtol=1e-12, err_msg=name)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: mi.FixedCost(nodes=4), "nodes: 4 is refused: it must be 5 to 9"),
        (lambda: mi.FixedCost(iterations=41), "iterations: 41 is refused: it must be 1 to 40"),
        (lambda: mi.Collocation(nodes=15), "nodes: 15 is refused: it must be 5 to 14"),
        (lambda: mi.RungeKuttaGill(15), "steps: 15 is refused: it must be 16 to 1000000"),
        (lambda: GLASS.simulate(3.0, method=mi.Collocation(5, 1e-9)), "tolerance is 1e-9, but must be at least"),
        (lambda: GLASS.simulate(3.0, method=mi.Adaptive(0.5)), "tolerance is 0.5, but must be 1e-13 to 0.01"),
        (lambda: GLASS.simulate(-3.0, method=mi.FixedCost()), "speed_normal: approach speed is -3 m/s"),
    ],
)
def test_refused_numbers(make, words):
    with pytest.raises(ValueError, match=f"^{words}"):
        make()


def test_refused_kinds():
    for make, words in [
        (lambda: mi.FixedCost(nodes=7.5), "nodes: 7.5 is refused: give a whole number, 5 to 9"),
        (lambda: mi.Collocation(tolerance="small"), "tolerance: 'small' is refused"),
        (lambda: GLASS.simulate(3.0, method="adaptive"), "method: 'adaptive' is refused: give Adaptive, Collocation, "),
    ]:
        with pytest.raises(TypeError, match=f"^{words}"):
            make()
    compliant = mi.Scene(radius=1e-6, density=1e3, contact=mi.Hertz(stiffness=1e10), stiffness_ratio=0.8)
    assert compliant.simulate(1.0, method=mi.Adaptive(1e-6)).status == mi.Status.SOLVED
    with pytest.raises(ValueError, match="^stiffness_ratio: the method FixedCost is not offered with it"):
        compliant.simulate(1.0, method=mi.FixedCost())
