//! Single precision against double, over spheres from nanometres to centimetres.

use microimpact::{
    Class, Classification, ContactClass, Hertz, Impact, InputError, NormalMotion, Oblique, PlanarMotion, Real,
    RigidBody, SpeedRestitution, Sphere, Stiffness, TangentialImpact,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Plain numbers of an impact with a work of adhesion, friction and spin.
#[derive(Clone, Copy, Debug)]
struct Numbers {
    radius: f64,
    density: f64,
    restitution_speed: f64,
    /// Work of adhesion over the kinetic energy of the normal motion.
    adhesion: f64,
    friction: f64,
    speed: f64,
    tangential: f64,
    peripheral: f64,
}

struct Result<T> {
    sphere: Sphere<T>,
    motion: PlanarMotion<T>,
    impact: Impact<T, TangentialImpact<T>>,
    classification: Classification<T, ContactClass<T>>,
}

impl Numbers {
    fn compute<T: Real>(&self) -> std::result::Result<Result<T>, InputError> {
        let c = T::constant;
        let sphere = Sphere::solid(c(self.radius), c(self.density))?;
        let motion = NormalMotion::new(c(self.speed))?
            .with_tangential(c(self.tangential))?
            .with_peripheral_velocity(c(self.peripheral))?;
        let work =
            2.0 / 3.0 * std::f64::consts::PI * self.density * self.radius.powi(3) * self.speed.powi(2) * self.adhesion;
        let scene = RigidBody::new(sphere, SpeedRestitution::new(c(self.restitution_speed))?)
            .with_work_of_adhesion(c(work))?
            .with_friction(c(self.friction))?;
        let impact = scene.impact(&motion);
        Ok(Result { sphere, motion, impact, classification: scene.classify(&motion) })
    }
}

fn numbers() -> impl Strategy<Value = Numbers> {
    let decade = |range: std::ops::Range<f64>| range.prop_map(|decade| 10f64.powf(decade));
    let size = (decade(-9.0..-2.0), decade(1.0..4.3), decade(0.0..4.0));
    let terms = (0.0..1.5, 0.0..1.0, decade(-3.0..3.0), -3.0..3.0, -3.0..3.0);
    (size, terms).prop_map(
        |((radius, density, restitution_speed), (adhesion, friction, speed, tangential, peripheral))| Numbers {
            radius,
            density,
            restitution_speed,
            adhesion,
            friction,
            speed,
            tangential: tangential * speed,
            peripheral: peripheral * speed,
        },
    )
}

fn close(single: f32, double: f64, scale: f64) -> std::result::Result<(), TestCaseError> {
    prop_assert!((f64::from(single) - double).abs() <= 2e-6 * scale, "{single:e} against {double:e}, of {scale:e}");
    Ok(())
}

/// How far a class is from its neighbours, in terms of the two margins.
fn distance_to_neighbours(classification: &Classification<f64, ContactClass<f64>>) -> f64 {
    let margins = [classification.speed_over_critical, classification.contact.friction_over_limit];
    margins.into_iter().flatten().map(|margin| (margin - 1.0).abs()).fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: reference::repetitions(10_000, 1000),
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1995),
        ..ProptestConfig::default()
    })]

    #[test]
    fn single_precision_agrees_with_double(numbers in numbers()) {
        let (single, double) = (numbers.compute::<f32>().unwrap(), numbers.compute::<f64>().unwrap());
        // Close to capture e grows like a square root and its error with it.
        let e = double.impact.normal.overall_restitution();
        let amplified = 1.0 / e.max(1e-3);
        let velocities = double.motion.slip().abs() + double.motion.tangential().abs() + numbers.speed;
        if distance_to_neighbours(&double.classification) > 1e-5 {
            prop_assert_eq!(single.classification.class(), double.classification.class());
        }
        close(single.impact.normal.overall_restitution(), e, amplified)?;
        close(single.impact.tangential.velocity(), double.impact.tangential.velocity(), velocities * amplified)?;
        close(single.impact.tangential.peripheral(), double.impact.tangential.peripheral(), 4.0 * velocities * amplified)?;
        if let (Some(single), Some(double)) = (single.classification.speed_over_critical, double.classification.speed_over_critical) {
            // v_c = k s/(k - s) has no digits left where s, the speed that adhesion takes, comes close to k.
            close(single, double, double + numbers.speed / numbers.restitution_speed)?;
        }
        let (single, double) = (single.impact.energy(&single.sphere), double.impact.energy(&double.sphere));
        if double.before > 1e-30 {
            close(single.lost(), double.lost(), double.before * amplified)?;
        }
    }

    #[test]
    fn hertz_in_single_precision(numbers in numbers(), stiffness in 3.0..14.0) {
        let stiffness = 10f64.powf(stiffness);
        let single = numbers.compute::<f32>().unwrap();
        let double = numbers.compute::<f64>().unwrap();
        let single = Hertz::new(&single.sphere, Stiffness::new(stiffness as f32).unwrap(), &single.motion);
        let double = Hertz::new(&double.sphere, Stiffness::new(stiffness).unwrap(), &double.motion);
        close(single.indentation, double.indentation, double.indentation)?;
        close(single.contact_radius, double.contact_radius, double.contact_radius)?;
        close(single.force, double.force, double.force)?;
        close(single.duration, double.duration, double.duration)?;
    }

    /// Twelve decades of every input end in a result of finite numbers or in a named error.
    #[test]
    fn no_input_ends_in_nonsense(
        size in (-12.0..1.0, -3.0..7.0, -6.0..6.0),
        terms in (-6.0..6.0, -6.0..6.0, -6.0..6.0, -6.0..6.0, -6.0..6.0),
    ) {
        let (radius, density, restitution_speed) = size;
        let (adhesion, friction, speed, tangential, peripheral) = terms;
        let [radius, density, restitution_speed, adhesion, friction, speed, tangential, peripheral] =
            [radius, density, restitution_speed, adhesion, friction, speed, tangential, peripheral].map(|decade: f64| 10f64.powf(decade));
        let numbers = Numbers { radius, density, restitution_speed, adhesion, friction, speed, tangential, peripheral: -peripheral };
        if let Ok(result) = numbers.compute::<f32>() {
            let ledger = result.impact.energy(&result.sphere);
            let (normal, tangential) = (result.impact.normal, result.impact.tangential);
            let values = [
                normal.overall_restitution(), normal.rebound_speed(), normal.adhesion_coefficient(), normal.adhesion_loss(),
                tangential.velocity(), tangential.spin(&result.sphere), tangential.impulse_ratio(), tangential.rolling_ratio(),
                result.classification.speed_over_critical.unwrap_or(0.0),
                result.classification.contact.friction_over_limit.unwrap_or(0.0),
                ledger.before, ledger.after, ledger.lost(),
            ];
            prop_assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
            prop_assert!((0.0..=1.0).contains(&normal.overall_restitution()));
            let captured = matches!(
                result.classification.class(),
                Class::CapturedResting | Class::CapturedRolling | Class::CapturedSliding
            );
            prop_assert_eq!(captured, normal.rebound_speed() == 0.0);
        }
    }
}
