//! Friction on a contact that is compliant along the surface: reference solutions, exact results, and random scenes.

use std::f64::consts::PI;

use microimpact::contact::{
    Adaptive, AnyLaw, Collocation, CompliantVelocities, Contact, Energy, FixedCost, JkrEnd, Method, Recording,
    RungeKuttaGill, SimulatedImpact, Slip, Status, Times, Unloading, Works,
};
use microimpact::{Class, Dual, Fault, NormalMotion, Outcome, Parameter, Real, Sphere, Stiffness, SurfaceMotion};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use reference::{laws, repetitions};
use truth::CompliantImpact;

/// The gyration ratio of a solid sphere, and the stiffness ratio of the tables below: two equal materials of Poisson's ratio 1/4.
const SOLID: f64 = 0.4;
const CHI: f64 = 6.0 / 7.0;

fn impact(slip: f64, friction: f64, stiffness_ratio: f64, damping: f64) -> CompliantImpact {
    CompliantImpact { slip, friction, stiffness_ratio, damping, gyration_ratio: SOLID, incremental: false }
}

type Solved<T> = SimulatedImpact<T, CompliantVelocities<T>>;

/// Solves an impact of unit speed, for a sphere of unit mass and radius and a surface of unit stiffness: zeta_H is then h.
fn solve<T: Real>(impact: &CompliantImpact, method: &impl Method<T>) -> Solved<T> {
    let c = T::constant;
    let sphere = Sphere::new(T::ONE, c(0.75 / PI), c(impact.gyration_ratio)).unwrap();
    let unloading = if impact.incremental { Unloading::Incremental } else { Unloading::Rescaled };
    let scene = Contact::hertz(sphere, Stiffness::new(T::ONE).unwrap())
        .with_damping(c(impact.damping))
        .and_then(|scene| scene.with_friction(c(impact.friction))?.with_compliance(c(impact.stiffness_ratio)))
        .unwrap()
        .with_unloading(unloading);
    scene.solve(&NormalMotion::new(T::ONE).unwrap().with_tangential(c(impact.slip)).unwrap(), method).unwrap()
}

fn exactly(impact: &CompliantImpact) -> Solved<f64> {
    let solved = solve(impact, &Adaptive::new(1e-11).unwrap());
    assert_eq!(solved.run.status, Status::Solved, "{impact:?}");
    solved
}

/// The largest error over the rows of the reference, relative to the approach speed, v/r, and the contact time. Numbers of phases
/// are exact.
fn largest_error<T: Real + Into<f64>>(method: &impl Method<T>) -> f64 {
    let rows = laws::rows(include_str!("../../data/tangential.csv"));
    assert_eq!(rows.len(), 47);
    let mut largest = 0.0_f64;
    for row in rows {
        let number = |column: &str| row.number(column).unwrap();
        let c = |column: &str| T::constant(number(column));
        let sphere = Sphere::solid(c("radius_m"), c("density_kg_m3")).unwrap();
        let scene = Contact::hertz(sphere, Stiffness::new(c("stiffness_pa")).unwrap())
            .with_damping(c("zeta_h"))
            .and_then(|scene| scene.with_friction(c("friction"))?.with_compliance(c("stiffness_ratio")))
            .unwrap();
        let motion = NormalMotion::new(c("speed_normal_m_s")).unwrap();
        let motion = motion.with_tangential(c("speed_tangential_m_s")).unwrap();
        let motion = motion.with_spin(&sphere, c("spin_rad_s")).unwrap();
        let (solved, times) = scene.solve_for(&motion, method, Times).unwrap();
        assert_eq!(solved.run.status, Status::Solved);
        let after = solved.tangential;
        assert_eq!(f64::from(after.phases()), number("phases"), "chi {}", number("stiffness_ratio"));
        let (speed, radius) = (number("speed_normal_m_s"), number("radius_m"));
        for (found, column, scale) in [
            (after.velocity(), "speed_tangential_out_m_s", speed),
            (after.spin(), "spin_out_rad_s", speed / radius),
            (after.impulse_ratio(), "impulse_ratio", 1.0),
            (times.contact.unwrap(), "contact_time_s", number("contact_time_s")),
        ] {
            let found: f64 = found.into();
            largest = largest.max((found - number(column)).abs() / scale);
        }
    }
    largest
}

#[test]
fn reference_solutions() {
    for (error, allowed) in [
        (largest_error(&Adaptive::new(1e-10).unwrap()), 1e-10),
        (largest_error(&Adaptive::new(1e-12).unwrap()), 1e-12),
        (largest_error(&Collocation::<9, f64>::new(1e-10).unwrap()), 1e-10),
        (largest_error(&Collocation::<12, f64>::new(1e-10).unwrap()), 1e-10),
        (largest_error(&Adaptive::new(1e-6).unwrap()), 1e-6),
        (largest_error::<f64>(&FixedCost::<9>::new(4).unwrap().with_outputs::<18>()), 1e-6),
        (largest_error(&Adaptive::new(1e-6_f32).unwrap()), 1e-5),
        (largest_error(&Collocation::<8, f32>::new(1e-6).unwrap()), 1e-5),
    ] {
        assert!(error < allowed, "{error:e}, not {allowed:e}");
    }
}

/// Slip after the impact over f, and the phases, at a damping h, a stiffness ratio and psi = chi u0/f.
const TABLE: [(f64, f64, f64, f64, u32); 35] = [
    (0.0, CHI, 0.2, 0.1326218983372, 2),
    (0.0, CHI, 0.5, 0.3237032768532, 2),
    (0.0, CHI, 0.9, 0.5052777674236, 2),
    (0.0, CHI, 1.2, 0.4251549165567, 3),
    (0.0, CHI, 1.5, 0.1227610560569, 3),
    (0.0, CHI, 2.0, -0.4191191820576, 3),
    (0.0, CHI, 2.5, -0.8645726390775, 3),
    (0.0, CHI, 3.0, -1.176242118493, 3),
    (0.0, CHI, 4.0, -1.423855885285, 3),
    (0.0, CHI, 5.0, -1.091598825841, 3),
    (0.0, CHI, 5.3, -0.8158389829101, 3),
    (0.0, CHI, 6.0, 0.0, 1),
    (0.2, CHI, 0.2, 0.1334372851832, 2),
    (0.2, CHI, 0.5, 0.322828025442, 2),
    (0.2, CHI, 0.9, 0.4685711713579, 2),
    (0.2, CHI, 1.2, 0.3428338377073, 3),
    (0.2, CHI, 1.5, 0.02309436621706, 3),
    (0.2, CHI, 2.0, -0.4987653578621, 3),
    (0.2, CHI, 2.5, -0.8946808220686, 3),
    (0.2, CHI, 3.0, -1.148150332551, 3),
    (0.2, CHI, 4.0, -1.284847851274, 3),
    (0.2, CHI, 5.0, -0.7516099877416, 3),
    (0.2, CHI, 5.3, -0.4043316185322, 1),
    (0.2, CHI, 6.0, 0.4123350481344, 1),
    (0.0, 2.0 / 3.0, 0.5, 0.04454529095924, 2),
    (0.0, 2.0 / 3.0, 2.0, -1.366546641976, 3),
    (0.0, 2.0 / 3.0, 4.0, -1.0, 1),
    (0.0, 1.0, 0.5, 0.3450390021936, 2),
    (0.0, 1.0, 2.0, 0.1734746402570, 3),
    (0.0, 1.0, 4.0, -1.122371119045, 3),
    (0.0, 5.0, 0.5, 0.009871345616681, 2),
    (0.0, 5.0, 2.0, 0.1773332658241, 3),
    (0.0, 5.0, 4.0, 0.2117487611300, 5),
    // At f = 1/2: a grazing slip, which a search for changes of sign at the ends of steps misses.
    (0.0, 10.0, 20.0, 0.072934 / 0.5, 7),
    (0.0, CHI, 0.0, 0.0, 1),
];

#[test]
fn published_values() {
    for (damping, chi, psi, slip, phases) in TABLE {
        for friction in [0.5, 0.01] {
            let impact = impact(psi * friction / chi, friction, chi, damping);
            let after = exactly(&impact).tangential;
            let allowed = if psi == 20.0 { 1e-6 } else { 1e-11 };
            assert!((after.slip() / friction - slip).abs() < allowed, "{impact:?}: {}", after.slip() / friction);
            assert_eq!(after.phases(), phases, "{impact:?}");
            assert!((impact.solve().slip - after.slip()).abs() < 1e-11, "{impact:?}");
        }
    }
}

/// A sphere slips throughout from |u0|/f = (7/2)(1 + e) - (2/3) e/chi on. The impulse ratio is then f.
#[test]
fn slip_throughout_begins_at_its_threshold() {
    for damping in [0.0, 0.2, 3.0] {
        for chi in [0.7, CHI, 1.0, 4.0, 30.0] {
            let e = exactly(&impact(0.0, 0.3, chi, damping)).normal.overall_restitution();
            let threshold = 3.5 * (1.0 + e) - 2.0 / 3.0 * e / chi;
            for sign in [1.0, -1.0] {
                let after =
                    |factor: f64| exactly(&impact(sign * factor * threshold * 0.3, 0.3, chi, damping)).tangential;
                for factor in [1.0, 1.001, 2.0] {
                    assert_eq!(after(factor).phases(), 1, "{chi} {damping} {factor}");
                    assert!((after(factor).impulse_ratio() + sign * 0.3).abs() < 1e-11);
                }
                assert_eq!(after(1.0 - 1e-6).phases(), 3);
                assert!((after(1.0 - 1e-6).impulse_ratio() + sign * 0.3).abs() < 1e-6);
            }
        }
    }
}

/// The stiffer the contact, the closer it comes to rolling.
#[test]
fn a_stiff_contact_rolls() {
    for (chi, slip) in [(100.0, -8.0e-3), (1000.0, -6e-4)] {
        let after = exactly(&impact(1.0, 0.5, chi, 0.0)).tangential;
        assert!((after.slip() / slip - 1.0).abs() < 0.1, "{}", after.slip());
        assert!((after.velocity() - 5.0 / 7.0).abs() < after.slip().abs());
    }
}

#[test]
fn nothing_happens_without_friction_or_slip() {
    let after = exactly(&impact(1.5, 0.0, CHI, 0.2)).tangential;
    assert_eq!((after.slip(), after.velocity(), after.spin(), after.phases()), (1.5, 1.5, 0.0, 1));
    assert_eq!((after.motion(), after.impulse_ratio()), (SurfaceMotion::Sliding, 0.0));
    let solved = exactly(&impact(0.0, 0.5, CHI, 0.2));
    assert_eq!((solved.tangential.slip(), solved.tangential.velocity(), solved.tangential.phases()), (0.0, 0.0, 1));
    assert_eq!((solved.tangential.motion(), solved.class()), (SurfaceMotion::Rolling, Some(Class::ReboundRolling)));
}

/// A ball of alumina (Kharaz, Gorham and Salman 2001; Chung and Ooi 2011): V_t/v_t by both rules of unloading.
#[test]
fn alumina() {
    let chi = 2.0 * (1.0 - 0.23) / (2.0 - 0.23);
    // h with a restitution of 0.98: h (1 + e) = ln((1 + h)/(1 - e h)).
    let e = |damping| exactly(&impact(0.0, 0.092, chi, damping)).normal.overall_restitution();
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if e(middle) > 0.98 { &mut low } else { &mut high }) = middle;
    }
    for (degrees, rescaled, incremental) in [
        (5.0_f64, 0.86558, 0.89659),
        (10.0, 0.71041, 0.71321),
        (15.0, 0.63160, 0.62730),
        (20.0, 0.62044, 0.60968),
        (25.0, 0.63837, 0.62788),
        (30.0, 0.68449, 0.68449),
        (60.0, 0.89483, 0.89483),
        (85.0, 0.98406, 0.98406),
    ] {
        let slip = degrees.to_radians().tan();
        for (incremental, expected) in [(false, rescaled), (true, incremental)] {
            let impact = CompliantImpact { incremental, ..impact(slip, 0.092, chi, low) };
            let found = exactly(&impact).tangential.velocity() / slip;
            assert!((found - expected).abs() < 6e-6, "{degrees} {incremental}: {found}");
        }
    }
}

/// Impacts of any stiffness and damping, with slip of both signs.
fn random(random: &mut StdRng) -> CompliantImpact {
    let mut decades = |from: f64, to: f64| 10_f64.powf(random.random_range(from..to));
    let friction = decades(-2.0, 0.5);
    let (stiffness_ratio, damping) = (decades(-2.0, 1.5), decades(-2.0, 1.5));
    let slip = friction * decades(-1.5, 1.0);
    let slip = if random.random() { slip } else { -slip };
    let damping = if random.random() { damping } else { 0.0 };
    let (incremental, gyration_ratio) = (random.random(), random.random_range(0.2..0.7));
    CompliantImpact { slip, friction, stiffness_ratio, damping, gyration_ratio, incremental }
}

/// Random impacts, against an independent solver. The energy never grows but by the incremental rule, and friction keeps the angular
/// momentum about the contact point.
#[test]
fn random_impacts() {
    let mut source = StdRng::seed_from_u64(5);
    for _ in 0..repetitions(3000, 150) {
        let impact = random(&mut source);
        let truth = impact.solve();
        let check = |solved: Solved<f64>, allowed: f64| {
            let after = solved.tangential;
            assert_eq!(solved.run.status, Status::Solved, "{impact:?}");
            let error = (after.slip() - truth.slip).abs() / impact.slip.abs().max(1.0);
            assert!(error < allowed, "{impact:?}: {error:e}, not {allowed:e}");
            assert_eq!(after.phases(), truth.phases, "{impact:?}");
        };
        check(solve(&impact, &Adaptive::new(1e-10).unwrap()), 1e-10);
        check(solve(&impact, &Collocation::<12, f64>::new(1e-11).unwrap()), 1e-11);
        check(solve(&impact, &Adaptive::new(1e-6).unwrap()), 1e-6);

        let solved = exactly(&impact);
        let (v, u) = (solved.tangential.velocity(), solved.tangential.spin());
        let kept = v + impact.gyration_ratio * u - impact.slip;
        assert!(kept.abs() < 1e-15 * (1.0 + impact.slip.abs()), "{impact:?}: {kept:e}");
        let energies = [impact.slip * impact.slip, v * v + impact.gyration_ratio * u * u];
        assert!(impact.incremental || energies[1] <= energies[0] * (1.0 + 1e-14), "{impact:?}");
        assert!(impact.incremental || truth.growth < 1e-14 * (1.0 + energies[0]), "{impact:?}");
        let reversed = exactly(&CompliantImpact { slip: -impact.slip, ..impact }).tangential;
        assert_eq!((reversed.velocity(), reversed.spin(), reversed.phases()), (-v, -u, solved.tangential.phases()));
        // Only the ratio of slip and friction counts.
        let scaled = CompliantImpact { slip: 0.1 * impact.slip, friction: 0.1 * impact.friction, ..impact };
        let change = 10.0 * exactly(&scaled).tangential.slip() - solved.tangential.slip();
        assert!(change.abs() < 1e-9 * impact.friction.max(1.0), "{impact:?}: {change:e}");
    }
}

/// Extreme stiffness, friction and slip are solved or given up, and more exact methods agree.
#[test]
fn ends_of_the_ranges() {
    for chi in [1e-3, 1.0, 1e3] {
        for friction in [1e-6, 0.3, 100.0] {
            for slip in [1e-9, 1.0, 1e3].map(|ratio| ratio * friction) {
                let impact = impact(slip, friction, chi, 0.1);
                let [coarse, fine] = [1e-6, 1e-11].map(|tolerance| solve(&impact, &Adaptive::new(tolerance).unwrap()));
                assert_eq!((coarse.run.status, fine.run.status), (Status::Solved, Status::Solved), "{impact:?}");
                let difference = (coarse.tangential.slip() - fine.tangential.slip()).abs();
                assert!(difference < 1e-5 * slip.min(friction), "{impact:?}: {difference:e}");
                let single = solve(&impact, &Adaptive::new(1e-6_f32).unwrap());
                assert_eq!(single.run.status, Status::Solved, "{impact:?}");
            }
        }
    }
}

/// Damping of any strength: up to a limit every impact is solved; beyond it some are given up, without an outcome. None is wrong.
#[test]
fn strong_damping_is_solved_or_given_up() {
    const ALWAYS_SOLVED: f64 = 1e5;
    // The smallest that is solved is the truth.
    const FINER: [f64; 3] = [1e-12, 1e-11, 1e-10];
    let mut source = StdRng::seed_from_u64(9);
    let (mut beyond, mut unsolved, mut unverified) = (0, 0, 0);
    for _ in 0..repetitions(3000, 100) {
        let mut decades = |from: f64, to: f64| 10_f64.powf(source.random_range(from..to));
        let (chi, damping, friction) = (decades(-3.0, 3.0), decades(-2.0, 9.0), decades(-3.0, 1.0));
        let slip = friction * decades(-2.0, 2.0);
        let impact = CompliantImpact { incremental: source.random(), ..impact(slip, friction, chi, damping) };
        let strong = chi * damping > ALWAYS_SOLVED;
        beyond += usize::from(strong);
        for tolerance in [1e-6, 1e-9] {
            let solved = solve(&impact, &Adaptive::new(tolerance).unwrap());
            if solved.run.status == Status::BudgetSpent {
                assert!(strong, "{impact:?}");
                assert_eq!((solved.normal.outcome(), solved.class()), (None, None), "{impact:?}");
                unsolved += 1;
                continue;
            }
            assert!(solved.normal.overall_restitution() * damping < 1.01 || damping < 1e2, "{impact:?}");
            assert_eq!(solved.run.status, Status::Solved, "{impact:?}");
            let finer = FINER.map(|finer| solve(&impact, &Adaptive::new(finer).unwrap()));
            let fine = finer.into_iter().find(|fine| fine.run.status == Status::Solved);
            let Some(fine) = fine else {
                assert!(strong, "{impact:?}");
                unverified += 1;
                continue;
            };
            let error = (solved.tangential.slip() - fine.tangential.slip()).abs() / slip.max(1.0);
            assert!(error < 2.0 * tolerance, "{impact:?}: {error:e}, not {tolerance:e}");
        }
    }
    assert!(unsolved > 0 && unsolved < 2 * beyond, "{unsolved} of {beyond}");
    assert!(100 * unverified < beyond, "{unverified} of {beyond}");
}

#[test]
fn other_laws_are_refused() {
    let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0).unwrap(), Stiffness::new(1e10).unwrap());
    let hertz = AnyLaw::hertz(stiffness);
    let accepted = [hertz, hertz.with_damping(3.0).unwrap()];
    let refused = [
        hertz.with_viscoelastic_damping(1e-9).unwrap(),
        hertz.with_constant_damping(0.5).unwrap(),
        hertz.with_external_force(1e-9).unwrap(),
        AnyLaw::ring(stiffness, 1.0, 0.0).unwrap(),
        AnyLaw::dmt(stiffness, 0.1).unwrap(),
        AnyLaw::jkr(stiffness, 0.1, JkrEnd::SnapOff).unwrap(),
        AnyLaw::without_tension(stiffness),
    ];
    let with_compliance = |law| Contact::new(sphere, law).with_friction(0.1).unwrap().with_compliance(CHI);
    for law in accepted {
        assert!(with_compliance(law).is_ok(), "{law:?}");
    }
    for law in refused {
        let error = with_compliance(law).unwrap_err();
        assert_eq!((error.parameter, error.fault), (Parameter::StiffnessRatio, Fault::OtherLaw), "{law:?}");
    }
    // Terms that are added later are refused by the impact.
    let scene = Contact::hertz(sphere, stiffness).with_friction(0.1).unwrap().with_compliance(CHI).unwrap();
    let motion = NormalMotion::new(1.0).unwrap().with_tangential(1.0).unwrap();
    let error = scene.with_dmt(0.1).unwrap().solve(&motion, &Adaptive::new(1e-9).unwrap()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "stiffness ratio is 0.85714287, but must only be given with Hertz's contact without adhesion and external force, \
         with hysteretic damping or none"
    );
}

#[test]
fn a_method_with_a_time_step_refuses_it() {
    let solved = solve::<f64>(&impact(1.0, 0.5, CHI, 0.1), &RungeKuttaGill::new(1000));
    assert_eq!((solved.run.status, solved.normal.outcome(), solved.class()), (Status::Unsupported, None, None));
}

/// Outputs beside it see the same motion, and agree with it.
#[test]
fn outputs() {
    let sphere = Sphere::solid(1.0, 0.75 / PI).unwrap();
    let rigid =
        Contact::hertz(sphere, Stiffness::new(1.0).unwrap()).with_damping(0.3).unwrap().with_friction(0.5).unwrap();
    let motion = NormalMotion::new(1.0).unwrap().with_tangential(1.0).unwrap();
    let motion = motion.with_peripheral_velocity(-0.5).unwrap();
    let method = Adaptive::new(1e-12).unwrap();
    let asked = (Slip, (Energy, Times), Works, Recording::<32>);
    let (_, (_, (_, times), works, trajectory)) = rigid.solve_for(&motion, &method, asked).unwrap();
    let scene = rigid.with_compliance(5.0).unwrap();
    let (solved, (slip, (ledger, beside), beside_works, beside_trajectory)) =
        scene.solve_for(&motion, &method, asked).unwrap();
    let after = solved.tangential;
    assert_eq!((solved.normal.outcome(), solved.class()), (Some(Outcome::Rebound), Some(Class::ReboundSliding)));
    assert_eq!((slip.velocity, slip.spin, slip.slides, slip.rolls_from), (after.velocity(), after.spin(), true, None));
    assert!((after.slip() - (after.velocity() - after.spin())).abs() < 1e-14);
    // The normal motion does not depend on what happens along the surface.
    assert!((beside.contact.unwrap() / times.contact.unwrap() - 1.0).abs() < 1e-12);
    assert!((beside.peak.unwrap() / times.peak.unwrap() - 1.0).abs() < 1e-12);
    assert!((beside_works.material / works.material - 1.0).abs() < 1e-12);
    let peaks = [&trajectory, &beside_trajectory].map(|trajectory| trajectory.peak().unwrap());
    assert!((peaks[0].time / peaks[1].time - 1.0).abs() < 1e-12);
    let ledger = ledger.unwrap();
    assert!((ledger.lost() / (ledger.before - ledger.after) - 1.0).abs() < 1e-12 && ledger.friction > 0.0);
    // The distance of the contact point is that of the centre less the path of the periphery; both follow the velocities.
    let (time, momentum) = (times.contact.unwrap(), 1.0 + SOLID * -0.5);
    assert!((slip.displacement + SOLID * slip.rotation - momentum * time).abs() < 1e-12);
    // Slip throughout, without damping: the mean velocity is the mean of the first and the last, by symmetry.
    let elastic = Contact::hertz(sphere, Stiffness::new(1.0).unwrap()).with_friction(0.1).unwrap();
    let fast = NormalMotion::new(1.0).unwrap().with_tangential(9.0).unwrap();
    let (solved, (slip, times)) =
        elastic.with_compliance(1.0).unwrap().solve_for(&fast, &method, (Slip, Times)).unwrap();
    let mean = 0.5 * (9.0 + solved.tangential.velocity());
    assert!((slip.displacement / times.contact.unwrap() - mean).abs() < 1e-11);
}

/// Dual numbers carry derivatives through all phases.
#[test]
fn derivatives() {
    let method = Adaptive::new(Dual::constant(1e-12)).unwrap();
    let start = impact(1.0, 0.5, 5.0, 0.2);
    let sphere = Sphere::solid(Dual::ONE, Dual::constant(0.75 / PI)).unwrap();
    let [chi, friction] = Dual::<f64, 2>::variables([start.stiffness_ratio, start.friction]);
    let scene = Contact::hertz(sphere, Stiffness::new(Dual::ONE).unwrap()).with_damping(Dual::constant(0.2)).unwrap();
    let scene = scene.with_friction(friction).unwrap().with_compliance(chi).unwrap();
    let motion = NormalMotion::new(Dual::ONE).unwrap().with_tangential(Dual::constant(start.slip)).unwrap();
    let slip = scene.solve(&motion, &method).unwrap().tangential.slip();
    let step = 1e-4;
    let after = |stiffness_ratio, friction| CompliantImpact { stiffness_ratio, friction, ..start }.solve().slip;
    let differences = [
        (after(5.0 + step, 0.5) - after(5.0 - step, 0.5)) / (2.0 * step),
        (after(5.0, 0.5 + step) - after(5.0, 0.5 - step)) / (2.0 * step),
    ];
    assert!((slip.value - start.solve().slip).abs() < 1e-12);
    for (partial, difference) in slip.partials.iter().zip(differences) {
        assert!((partial - difference).abs() < 1e-6, "{partial} {difference}");
    }
}
