//! The energy ledger closes to rounding, however strong the damping.

use microimpact::contact::{Adaptive, Collocation, Contact, Energy, FixedCost, Method, RungeKuttaGill, Status, Works};
use microimpact::rigid::EnergyLedger;
use microimpact::{InputError, NormalMotion, Oblique, Real, Sphere, Stiffness};

/// What the works lack of the energy lost, over the energy before, at a damping h of the materials; without adhesion and with.
fn lacking<T, M>(method: &M, damping: f64, strength: f64) -> Result<f64, InputError>
where
    T: Real + Into<f64>,
    M: Method<T>,
{
    let c = T::constant;
    let sphere = Sphere::solid(c(5e-6), c(2600.0))?;
    let motion = NormalMotion::new(c(1.0))?;
    // zeta_H of h = 1.
    let unit = Contact::hertz(Sphere::solid(5e-6, 2600.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
    let material = damping / unit.groups(&NormalMotion::new(1.0)?)?.material_damping;
    let scene = Contact::hertz(sphere, Stiffness::new(c(1e10))?)
        .with_damping(c(material))?
        .with_ring(c(strength), c(0.5 * material))?;
    let (impact, works) = scene.solve_for(&motion, method, Works)?;
    assert_eq!(impact.run.status, Status::Solved, "{damping}");
    let e: f64 = impact.normal.overall_restitution().into();
    let before: f64 = 0.5 * sphere.mass().into();
    let works: [f64; 2] = [works.material, works.adhesion].map(Into::into);
    if impact.normal.rebound_speed() == T::ZERO {
        return Ok(0.0);
    }
    Ok(1.0 - e * e - (works[0] + works[1]) / before)
}

/// From mild to a million, 20 values a decade.
fn dampings() -> impl Iterator<Item = f64> {
    (0..=160).map(|step| 10_f64.powf(0.05 * f64::from(step) - 2.0))
}

#[test]
fn double_precision() -> Result<(), InputError> {
    for damping in dampings() {
        for strength in [0.0, 1e-3] {
            let lacking = [
                lacking::<f64, _>(&Collocation::<7, f64>::new(1e-6)?, damping, strength)?,
                lacking::<f64, _>(&Collocation::<9, f64>::new(1e-9)?, damping, strength)?,
                lacking::<f64, _>(&Collocation::<12, f64>::new(1e-12)?, damping, strength)?,
                lacking::<f64, _>(&Collocation::<14, f64>::new(1e-13)?, damping, strength)?,
                lacking::<f64, _>(&Adaptive::new(1e-11)?, damping, strength)?,
            ];
            for (lacking, bound) in lacking.into_iter().zip([1e-6, 1e-9, 1e-12, 1e-13, 1e-11]) {
                assert!(lacking.abs() < bound, "{damping}, {strength}: {lacking:e}, not {bound:e}");
            }
        }
    }
    Ok(())
}

#[test]
fn single_precision() -> Result<(), InputError> {
    for damping in dampings() {
        for strength in [0.0, 1e-3] {
            let collocation = lacking::<f32, _>(&Collocation::<8, f32>::new(1e-6)?, damping, strength)?;
            let adaptive = lacking::<f32, _>(&Adaptive::new(1e-6)?, damping, strength)?;
            for lacking in [collocation, adaptive] {
                assert!(lacking.abs() < 5e-6, "{damping}, {strength}: {lacking:e}");
            }
        }
    }
    Ok(())
}

/// The ledger of a rebound of Table 1's sphere with a spin (rad/s), under a peeling moment, and its kinetic energy before.
fn along<T: Real>(
    method: &impl Method<T>,
    spin: f64,
    lambda: f64,
    speed: f64,
) -> Result<(EnergyLedger<T>, T), InputError> {
    let c = T::constant;
    let sphere = Sphere::solid(c(5.06e-6), c(2600.0))?;
    let scene = Contact::hertz(sphere, Stiffness::new(c(7.5e10))?).with_damping(c(10.5))?;
    let scene = scene.with_ring(c(if speed < 1.0 { 0.0 } else { 250.0 }), c(6.25))?.with_friction(c(0.1))?;
    let motion = NormalMotion::new(c(speed))?.with_tangential(c(3.0))?.with_spin(&sphere, c(spin))?;
    let (v, u) = (motion.tangential(), motion.peripheral());
    let kinetic = sphere.mass() * (c(0.5) * (c(speed) * c(speed) + v * v + sphere.gyration_ratio() * u * u));
    let (impact, ledger) = scene.with_peeling(c(lambda))?.solve_for(&motion, method, Energy)?;
    assert_eq!(impact.run.status, Status::Solved);
    Ok((ledger.unwrap(), kinetic))
}

/// What friction and the peeling moment take, by every method.
#[test]
fn along_the_surface() -> Result<(), InputError> {
    for lambda in [0.0, 1e-12, 1e-9] {
        for spin in [-1e6, 1.454e5, 5e5] {
            let (exact, _) = along(&Collocation::<12, f64>::new(1e-11)?, spin, lambda, 2.8)?;
            let ledgers = [
                (along(&Adaptive::new(1e-9)?, spin, lambda, 2.8)?, 1e-8),
                (along(&Collocation::<9, f64>::new(1e-9)?, spin, lambda, 2.8)?, 1e-8),
                (along(&FixedCost::<7>::new(4)?.with_outputs::<13>(), spin, lambda, 2.8)?, 1e-4),
                (along(&RungeKuttaGill::new(4000), spin, lambda, 2.8)?, 1e-5),
            ];
            for ((ledger, kinetic), bound) in ledgers {
                for (found, exact) in [
                    (ledger.before, kinetic),
                    (ledger.after, exact.after),
                    (ledger.friction, exact.friction),
                    (ledger.rolling, exact.rolling),
                ] {
                    assert!(
                        (found - exact).abs() <= bound * kinetic,
                        "{lambda:e} {spin:e} {bound:e}: {ledger:?} {exact:?}"
                    );
                }
            }
        }
    }
    Ok(())
}

/// A slow sphere with a spin so fast that the square of the ratio is beyond single precision.
#[test]
fn a_slow_sphere_that_spins_fast_in_single_precision() -> Result<(), InputError> {
    let (ledger, kinetic) = along::<f32>(&Adaptive::new(1e-6)?, 1e11, 0.0, 1e-12)?;
    assert!((ledger.before / kinetic - 1.0).abs() < 1e-5 && (ledger.after / kinetic - 1.0).abs() < 1e-5, "{ledger:?}");
    let (ledger, kinetic) = along::<f32>(&FixedCost::<5>::new(5)?.with_outputs::<10>(), 1e11, 0.0, 1e-12)?;
    assert!((ledger.before / kinetic - 1.0).abs() < 1e-5, "{ledger:?}");
    Ok(())
}
