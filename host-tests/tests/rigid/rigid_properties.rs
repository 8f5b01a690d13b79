//! Properties of the rigid-body model that hold for every impact.

use microimpact::rigid::{Departure, infer, infer_assuming_rolling, infer_with_spins};
use microimpact::{
    ConstantRestitution, CriticalSpeed, Impact, ImpactError, NormalMotion, Oblique, Outcome, PlanarMotion, RigidBody,
    SpeedRestitution, Sphere, SurfaceMotion, TangentialImpact,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// The inputs of an impact in which every term takes part.
#[derive(Clone, Copy, Debug)]
struct Case {
    sphere: Sphere<f64>,
    motion: PlanarMotion<f64>,
    restitution: f64,
    adhesion: f64,
    friction: f64,
    /// mu_m a_c over r.
    rolling: f64,
    /// External impulses over those that would stop the sphere.
    external: (f64, f64),
}

impl Case {
    fn scene(&self) -> RigidBody<f64, ConstantRestitution<f64>, microimpact::rigid::AdhesionCoefficient<f64>> {
        RigidBody::new(self.sphere, ConstantRestitution::new(self.restitution).unwrap())
            .with_adhesion_coefficient(self.adhesion)
            .unwrap()
    }

    /// With friction alone.
    fn frictional(&self) -> Impact<f64, TangentialImpact<f64>> {
        self.scene().with_friction(self.friction).unwrap().impact(&self.motion)
    }

    /// With friction and rolling dissipation.
    fn resisted(&self) -> Impact<f64, TangentialImpact<f64>> {
        let arm = self.rolling * self.sphere.radius();
        let scene = self.scene().with_friction(self.friction).unwrap().with_rolling_dissipation(arm).unwrap();
        scene.impact(&self.motion)
    }

    /// With every term.
    fn whole(&self) -> Impact<f64, TangentialImpact<f64>> {
        let arm = self.rolling * self.sphere.radius();
        let momentum = self.sphere.mass() * speed(&self.motion);
        let scene = self.scene().with_friction(self.friction).unwrap().with_rolling_dissipation(arm).unwrap();
        let scene = scene.with_external_impulses(self.external.0 * momentum, self.external.1 * momentum).unwrap();
        scene.impact(&self.motion)
    }
}

fn speed(motion: &PlanarMotion<f64>) -> f64 {
    use microimpact::Approach;
    motion.normal().speed()
}

fn motion(speed: f64, tangential: f64, peripheral: f64) -> PlanarMotion<f64> {
    let oblique = NormalMotion::new(speed).and_then(|motion| motion.with_tangential(tangential));
    oblique.and_then(|motion| motion.with_peripheral_velocity(peripheral)).unwrap()
}

/// A number of either sign, or zero, of a size spread evenly over decades.
fn signed(decades: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    (decades, prop_oneof![Just(-1.0), Just(1.0), Just(1.0), Just(0.0)])
        .prop_map(|(decade, sign)| sign * 10f64.powf(decade))
}

/// A share from 0 to 1, its ends included.
fn share() -> impl Strategy<Value = f64> {
    prop_oneof![8 => 0.0..=1.0, 1 => Just(0.0), 1 => Just(1.0)]
}

fn cases() -> impl Strategy<Value = Case> {
    let sphere = (-9.0..-2.0, 1.0..4.0, 0.05..=0.667)
        .prop_map(|(radius, density, kappa)| Sphere::new(10f64.powf(radius), 10f64.powf(density), kappa).unwrap());
    let motion = (-6.0..3.0, signed(-3.0..2.0), signed(-3.0..2.0)).prop_map(|(speed, tangential, peripheral)| {
        let speed = 10f64.powf(speed);
        motion(speed, tangential * speed, peripheral * speed)
    });
    let terms = (share(), share(), prop_oneof![0.0..2.0, Just(0.0)], prop_oneof![0.0..0.5, Just(0.0)]);
    let external = (-1.0..1.0, -1.0..1.0);
    (sphere, motion, terms, external).prop_map(|(sphere, motion, terms, external)| {
        let (restitution, adhesion, friction, rolling) = terms;
        Case { sphere, motion, restitution, adhesion, friction, rolling, external }
    })
}

/// Size that rounding errors of a velocity are measured by.
fn velocity_scale(case: &Case) -> f64 {
    speed(&case.motion) + case.motion.tangential().abs() + case.motion.peripheral().abs()
}

fn close(a: f64, b: f64, scale: f64) -> Result<(), TestCaseError> {
    prop_assert!((a - b).abs() <= 1e-11 * scale, "{a:e} against {b:e}, of {scale:e}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: reference::repetitions(4000, 400),
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1995),
        ..ProptestConfig::default()
    })]

    /// A5 to A16, each in its own form.
    #[test]
    fn the_twelve_equations_hold(case in cases()) {
        let impact = case.whole();
        let (sphere, motion) = (&case.sphere, &case.motion);
        let (m, r, kappa) = (sphere.mass(), sphere.radius(), sphere.gyration_ratio());
        let normal = impact.normal.impulses(sphere);
        let tangential = impact.tangential.impulses(sphere);
        let (mid_tangential, mid_peripheral) = impact.tangential.at_deepest_point();
        let (v_n, v_t, u) = (-speed(motion), motion.tangential(), motion.peripheral());
        let momentum = m * velocity_scale(&case) / kappa;

        let pressed = (normal.body.approach + normal.external.approach, normal.body.rebound + normal.adhesion_rebound + normal.external.rebound);
        close(m * (0.0 - v_n), pressed.0, momentum)?;
        close(m * (mid_tangential - v_t), tangential.friction.approach, momentum)?;
        close(m * kappa * r * (mid_peripheral - u), tangential.moment.approach - r * tangential.friction.approach, r * momentum)?;
        close(m * impact.normal.rebound_speed(), pressed.1, momentum)?;
        close(m * (impact.tangential.velocity() - mid_tangential), tangential.friction.rebound, momentum)?;
        close(m * kappa * r * (impact.tangential.peripheral() - mid_peripheral), tangential.moment.rebound - r * tangential.friction.rebound, r * momentum)?;
        close(normal.body.rebound, case.restitution * normal.body.approach, momentum)?;
        close(normal.adhesion_rebound, -case.adhesion * normal.body.rebound, momentum)?;
        prop_assert!(tangential.friction.approach.abs() <= case.friction * pressed.0 + 1e-11 * momentum);
        prop_assert!(tangential.friction.rebound.abs() <= case.friction * pressed.1 + 1e-11 * momentum);
        let arm = impact.tangential.rolling_arm(sphere);
        close(tangential.moment.approach, arm * pressed.0, r * momentum)?;
        close(tangential.moment.rebound, arm * pressed.1, r * momentum)?;
        prop_assert!(arm.abs() <= case.rolling * r * (1.0 + 1e-12));
    }

    /// A17 to A28, as spelled out for a sphere of any kappa.
    #[test]
    fn the_combined_results_hold(case in cases()) {
        let impact = case.resisted();
        let (kappa, r) = (case.sphere.gyration_ratio(), case.sphere.radius());
        let (v_n, v_t, u) = (-speed(&case.motion), case.motion.tangential(), case.motion.peripheral());
        let (e, mu) = (impact.normal.overall_restitution(), impact.tangential.impulse_ratio());
        let arm = impact.tangential.rolling_arm(&case.sphere) / r;
        let scale = velocity_scale(&case) / kappa;
        close(e, case.restitution * (1.0 - case.adhesion), 1.0)?;
        close(impact.normal.rebound_speed(), -case.restitution * (1.0 - case.adhesion) * v_n, scale)?;
        close(impact.tangential.velocity(), v_t - mu * (1.0 + e) * v_n, scale)?;
        close(impact.tangential.peripheral(), u + (mu - arm) * (1.0 + e) * v_n / kappa, scale)?;
        close(impact.tangential.slip(), v_t - u - ((1.0 + 1.0 / kappa) * mu - arm / kappa) * (1.0 + e) * v_n, scale)?;
        let eta = (v_t - u) / v_n;
        close(impact.tangential.velocity_ratio(), eta, eta.abs())?;
        let mu_0 = (eta / (1.0 + e) + arm / kappa) / (1.0 + 1.0 / kappa);
        close(impact.tangential.rolling_ratio(), mu_0, eta.abs() + arm.abs())?;
    }

    /// Nothing but an external force adds energy, and the ledger closes.
    #[test]
    fn energy_never_grows(case in cases()) {
        for impact in [case.frictional(), case.resisted()] {
            let ledger = impact.energy(&case.sphere);
            prop_assert!(ledger.after <= ledger.before * (1.0 + 1e-12), "{ledger:?}");
            prop_assert!(ledger.material >= 0.0 && ledger.adhesion >= 0.0);
            prop_assert!(ledger.friction.min(ledger.rolling) >= -1e-12 * ledger.before, "{ledger:?}");
            close(ledger.before - ledger.after, ledger.lost(), ledger.before / case.sphere.gyration_ratio())?;
            let normal = 0.5 * case.sphere.mass() * speed(&case.motion).powi(2);
            close(impact.loss_ratio() * normal, ledger.lost(), ledger.before / case.sphere.gyration_ratio())?;
        }
        let ledger = case.whole().energy(&case.sphere);
        close(ledger.before - ledger.after, ledger.lost(), ledger.before / case.sphere.gyration_ratio())?;
        let works = case.whole().normal.works(&case.sphere);
        let normal_before = 0.5 * case.sphere.mass() * speed(&case.motion).powi(2);
        let normal_after = 0.5 * case.sphere.mass() * case.whole().normal.rebound_speed().powi(2);
        let worked = works.body_approach + works.body_rebound + works.adhesion + works.external;
        close(normal_after - normal_before, worked, normal_before + normal_after)?;
    }

    /// Rolling dissipation never leaves more energy than its absence would.
    #[test]
    fn rolling_dissipation_dissipates(case in cases()) {
        let (free, resisted) = (case.frictional().energy(&case.sphere), case.resisted().energy(&case.sphere));
        prop_assert!(resisted.after <= free.after + 1e-12 * free.before, "{resisted:?} {free:?}");
    }

    /// Turning the tangential direction round turns its results round and changes nothing else.
    #[test]
    fn mirror_symmetry(case in cases()) {
        let mirrored = Case {
            motion: motion(speed(&case.motion), -case.motion.tangential(), -case.motion.peripheral()),
            ..case
        };
        let (impact, image) = (case.whole(), mirrored.whole());
        prop_assert_eq!(impact.normal, image.normal);
        prop_assert_eq!(impact.tangential.velocity(), -image.tangential.velocity());
        prop_assert_eq!(impact.tangential.peripheral(), -image.tangential.peripheral());
        prop_assert_eq!(impact.tangential.impulse_ratio(), -image.tangential.impulse_ratio());
        prop_assert_eq!(impact.energy(&case.sphere).lost(), image.energy(&case.sphere).lost());
    }

    /// Only ratios count: all velocities k times as large give results k times as large.
    #[test]
    fn velocities_scale(case in cases()) {
        let doubled = Case {
            motion: motion(2.0 * speed(&case.motion), 2.0 * case.motion.tangential(), 2.0 * case.motion.peripheral()),
            ..case
        };
        let (impact, large) = (case.resisted(), doubled.resisted());
        prop_assert_eq!(2.0 * impact.normal.rebound_speed(), large.normal.rebound_speed());
        prop_assert_eq!(2.0 * impact.tangential.velocity(), large.tangential.velocity());
        prop_assert_eq!(2.0 * impact.tangential.peripheral(), large.tangential.peripheral());
    }

    /// Coulomb friction: |mu| = min(f, |mu_0|) with the sign of mu_0; it rolls exactly when |mu_0| <= f.
    #[test]
    fn coulomb_limits(case in cases()) {
        let impact = case.frictional();
        let (mu, mu_0) = (impact.tangential.impulse_ratio(), impact.tangential.rolling_ratio());
        close(mu.abs(), mu_0.abs().min(case.friction), mu_0.abs() + case.friction)?;
        prop_assert!(mu * mu_0 >= 0.0);
        close(impact.tangential.energy_bound(), 2.0 * mu_0, mu_0.abs())?;
        let classification = case.scene().with_friction(case.friction).unwrap().classify(&case.motion);
        let margin = classification.contact.friction_over_limit;
        let slides = classification.contact.motion == SurfaceMotion::Sliding;
        match margin {
            Some(margin) if (margin - 1.0).abs() > 1e-12 => prop_assert_eq!(slides, margin < 1.0),
            Some(_) => {}
            None => prop_assert!(!slides && mu_0 == 0.0),
        }
        if !slides {
            close(impact.tangential.slip(), 0.0, velocity_scale(&case))?;
        }
    }

    /// Without friction the tangential motion stays; with endless friction the sphere rolls as V_t = (v_t + kappa u)/(1 + kappa).
    #[test]
    fn limits_of_friction(case in cases()) {
        let (v_t, u, kappa) = (case.motion.tangential(), case.motion.peripheral(), case.sphere.gyration_ratio());
        let smooth = Case { friction: 0.0, ..case }.frictional().tangential;
        if case.motion.slip() != 0.0 {
            prop_assert_eq!((smooth.velocity(), smooth.peripheral()), (v_t, u));
        }
        let rough = Case { friction: 1e3, ..case }.frictional().tangential;
        if rough.rolling_ratio().abs() <= 1e3 {
            close(rough.velocity(), (v_t + kappa * u) / (1.0 + kappa), velocity_scale(&case))?;
            close(rough.peripheral(), rough.velocity(), velocity_scale(&case))?;
        }
    }

    /// Terms of vanishing strength give what their absence gives.
    #[test]
    fn absent_terms_are_limits(case in cases()) {
        let bare = Case { adhesion: 0.0, rolling: 0.0, external: (0.0, 0.0), ..case };
        let scene = RigidBody::new(bare.sphere, ConstantRestitution::new(bare.restitution).unwrap());
        let expected = scene.with_friction(bare.friction).unwrap().impact(&bare.motion);
        let impact = bare.whole();
        prop_assert_eq!(impact.normal, expected.normal);
        close(impact.tangential.velocity(), expected.tangential.velocity(), velocity_scale(&case))?;
        close(impact.tangential.peripheral(), expected.tangential.peripheral(), velocity_scale(&case) / case.sphere.gyration_ratio())?;
        let alone = scene.impact(&bare.motion);
        prop_assert_eq!(alone.normal, expected.normal);
    }

    /// Inverse after forward is the identity.
    #[test]
    fn inverse_returns_the_coefficients(case in cases()) {
        let law = ConstantRestitution::new(case.restitution).unwrap();
        let scale = velocity_scale(&case);
        let impact = case.frictional();
        let after = Departure { normal: impact.normal.rebound_speed(), tangential: impact.tangential.velocity() };
        let inferred = infer(&case.sphere, &law, &case.motion, &after, 1e-12 * scale).unwrap();
        close(inferred.normal.adhesion_coefficient(), impact.normal.adhesion_coefficient(), 1.0)?;
        prop_assert_eq!(inferred.normal.overall_restitution(), impact.normal.overall_restitution());
        close(inferred.tangential.impulse_ratio(), impact.tangential.impulse_ratio(), scale / speed(&case.motion))?;
        close(inferred.tangential.peripheral(), impact.tangential.peripheral(), scale / case.sphere.gyration_ratio())?;
        close(inferred.energy(&case.sphere).lost(), impact.energy(&case.sphere).lost(), impact.energy(&case.sphere).before / case.sphere.gyration_ratio())?;
        if impact.tangential.slip().abs() > 1e-9 * scale {
            prop_assert_eq!(
                case.scene().classify_impact(&inferred).class(),
                case.scene().classify_impact(&impact).class()
            );
        }
        let again = case.scene().impact_with_ratio(&case.motion, impact.tangential.impulse_ratio()).unwrap();
        close(again.tangential.velocity(), impact.tangential.velocity(), scale)?;
        close(again.tangential.peripheral(), impact.tangential.peripheral(), scale / case.sphere.gyration_ratio())?;
    }

    /// The inverse with both spins finds the rolling-dissipation arm as well.
    #[test]
    fn inverse_returns_the_rolling_arm(case in cases()) {
        let law = ConstantRestitution::new(case.restitution).unwrap();
        let (scale, kappa) = (velocity_scale(&case), case.sphere.gyration_ratio());
        let impact = case.resisted();
        let after = Departure { normal: impact.normal.rebound_speed(), tangential: impact.tangential.velocity() };
        let inferred = infer_with_spins(&case.sphere, &law, &case.motion, &after, impact.tangential.spin(&case.sphere), 1e-12 * scale);
        // A couple that friction cannot hold reverses the slip; such data are refused.
        if case.motion.slip() * impact.tangential.slip() < -1e-9 * scale * scale || case.motion.slip() * impact.tangential.impulse_ratio() > 0.0 {
            return Ok(());
        }
        let inferred = inferred.unwrap();
        let arm = impact.tangential.rolling_arm(&case.sphere) / case.sphere.radius();
        close(inferred.tangential.rolling_arm(&case.sphere) / case.sphere.radius(), arm, scale / speed(&case.motion) / kappa)?;
    }

    /// A sphere that rolls at separation tells the spin it came with.
    #[test]
    fn inverse_returns_the_spin(case in cases()) {
        let rolling = Case { friction: 1e3, ..case };
        let impact = rolling.frictional();
        prop_assume!(impact.tangential.slip() == 0.0);
        let law = ConstantRestitution::new(case.restitution).unwrap();
        let before = NormalMotion::new(speed(&case.motion)).unwrap().with_tangential(case.motion.tangential()).unwrap();
        let after = Departure { normal: impact.normal.rebound_speed(), tangential: impact.tangential.velocity() };
        let inferred = infer_assuming_rolling(&case.sphere, &law, &before, &after).unwrap();
        let peripheral = inferred.tangential.spin_before(&case.sphere) * case.sphere.radius();
        close(peripheral, case.motion.peripheral(), velocity_scale(&case) / case.sphere.gyration_ratio())?;
    }

    /// Ratios outside 0 to mu_0 are refused, ratios inside give back themselves.
    #[test]
    fn impulse_ratio_bounds(case in cases(), part in -1.0f64..3.0) {
        let mu_0 = case.frictional().tangential.rolling_ratio();
        prop_assume!(mu_0 != 0.0 && (3.0 * mu_0).abs() < 1e3 && part != 0.0 && (part - 1.0).abs() > 1e-9);
        let result = case.scene().impact_with_ratio(&case.motion, part * mu_0);
        if (0.0..1.0).contains(&part) {
            close(result.unwrap().tangential.impulse_ratio(), part * mu_0, mu_0.abs())?;
        } else {
            prop_assert_eq!(result, Err(ImpactError::ImpulseRatioOutsideBounds));
        }
    }

    /// The critical speed separates capture from rebound, with every adhesion and microforce.
    #[test]
    fn critical_speed_separates(case in cases(), k in 1.0..1e3, work in 1e-3..1e3, coefficient in any::<bool>()) {
        let energy = 0.5 * case.sphere.mass() * speed(&case.motion).powi(2);
        let momentum = case.sphere.mass() * speed(&case.motion);
        let law = SpeedRestitution::new(k).unwrap();
        let scene = RigidBody::new(case.sphere, law);
        let external = (case.external.0 * momentum, case.external.1 * momentum);
        let (critical, captured): (_, Box<dyn Fn(f64) -> bool>) = if coefficient {
            let scene = scene.with_adhesion_coefficient(case.adhesion).unwrap();
            let scene = scene.with_external_impulses(external.0, external.1).unwrap();
            (scene.critical_speed(), Box::new(move |v| scene.classify(&NormalMotion::new(v).unwrap()).outcome == Outcome::Capture))
        } else {
            let scene = scene.with_work_of_adhesion(work * energy).unwrap();
            let scene = scene.with_external_impulses(external.0, external.1).unwrap();
            (scene.critical_speed(), Box::new(move |v| scene.classify(&NormalMotion::new(v).unwrap()).outcome == Outcome::Capture))
        };
        match critical {
            CriticalSpeed::At(v) => {
                prop_assume!((1e-9..1e5).contains(&v));
                let margin = 1e-6 * (1.0 + momentum / case.sphere.mass() / v);
                prop_assert!(captured(v * (1.0 - margin).max(0.1)));
                prop_assert!(!captured(v * (1.0 + margin)));
            }
            CriticalSpeed::AlwaysRebounds => prop_assert!(!captured(speed(&case.motion))),
            CriticalSpeed::NeverRebounds => prop_assert!(captured(speed(&case.motion)) && captured(1e5)),
        }
    }
}

/// A sphere that comes with V_t = r W = 0 after the impact rests: e = 0 and mu = v_t/v_n = mu_0 at once.
#[test]
fn full_capture() {
    let sphere = Sphere::solid(1e-6, 1000.0).unwrap();
    let scene = RigidBody::new(sphere, ConstantRestitution::new(0.0).unwrap()).with_friction(2.0).unwrap();
    for tangential in [0.3, -0.7, 1.1] {
        let motion = motion(1.0, tangential, -tangential / 0.4);
        let impact = scene.impact(&motion);
        assert!((impact.tangential.impulse_ratio() + tangential).abs() < 1e-14);
        assert_eq!(scene.classify(&motion).contact.motion, SurfaceMotion::Resting);
        assert!(impact.energy(&sphere).after < 1e-30 * impact.energy(&sphere).before);
    }
}

/// A couple that friction cannot hold lets the sphere slip the other way, and still takes energy.
#[test]
fn couple_beyond_friction() {
    let sphere = Sphere::solid(1e-6, 1000.0).unwrap();
    let scene = RigidBody::new(sphere, ConstantRestitution::new(0.5).unwrap())
        .with_friction(0.01)
        .unwrap()
        .with_rolling_dissipation(0.3e-6)
        .unwrap();
    let rolling = motion(1.0, 5.0, 5.0);
    let impact = scene.impact(&rolling);
    assert!((impact.tangential.impulse_ratio() + 0.01).abs() < 1e-15);
    assert!(impact.tangential.slip() > 0.0);
    assert!(impact.energy(&sphere).rolling > 0.0);
}
