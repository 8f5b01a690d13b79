//! Derivatives by dual numbers against differences of plain runs, and the rules of differentiation by themselves.

use microimpact::contact::{Collocation, Contact, FixedCost, Method, Nodes, NormalContact, RingScene};
use microimpact::{
    CriticalSpeed, Dual, InputError, NormalMotion, Real, RigidBody, SpeedRestitution, Sphere, Stiffness,
};
use reference::{Case, cases};

/// Names of the inputs below, for messages.
const INPUTS: [&str; 7] = ["speed", "radius", "density", "stiffness", "f0", "zeta_H", "zeta_A"];

fn scene<T: Real>(inputs: [T; 7]) -> Result<RingScene<T>, InputError> {
    let [_, radius, density, stiffness, strength, zeta_h, zeta_a] = inputs;
    Contact::hertz(Sphere::solid(radius, density)?, Stiffness::new(stiffness)?)
        .with_damping(zeta_h)?
        .with_ring(strength, zeta_a)
}

fn contact<T: Real>(method: &impl Method<T>, inputs: [T; 7]) -> NormalContact<T> {
    scene(inputs).unwrap().solve_normal(&NormalMotion::new(inputs[0]).unwrap(), method).unwrap()
}

fn exact<T: Real>() -> Collocation<14, T> {
    Collocation::new(T::constant(1e-13)).unwrap()
}

fn critical_speed<T: Nodes<14>>(inputs: [T; 7]) -> T {
    match scene(inputs).unwrap().critical_speed(&exact()).unwrap() {
        CriticalSpeed::At(speed) => speed,
        other => panic!("{other:?}"),
    }
}

/// Derivative by the logarithm of one input: central differences of two widths, extrapolated to none.
fn difference(inputs: [f64; 7], input: usize, width: f64, f: impl Fn([f64; 7]) -> f64) -> f64 {
    let slope = |width: f64| {
        let [ahead, back] = [1.0 + width, 1.0 - width].map(|factor| {
            let mut moved = inputs;
            moved[input] *= factor;
            f(moved)
        });
        (ahead - back) / (2.0 * width)
    };
    (4.0 * slope(width / 2.0) - slope(width)) / 3.0
}

/// Largest difference between the derivatives of a result by the logarithms of its inputs, over the result.
fn worst(inputs: [f64; 7], result: Dual<f64, 7>, width: f64, plain: impl Fn([f64; 7]) -> f64) -> f64 {
    let mut worst: f64 = 0.0;
    for (input, (value, partial)) in inputs.into_iter().zip(result.partials).enumerate() {
        let error = (value * partial - difference(inputs, input, width, &plain)).abs() / result.value.abs();
        assert!(error < 1e-2, "by {}: {error:e}", INPUTS[input]);
        worst = worst.max(error);
    }
    worst
}

/// Rebounds of some families of the reference. Those close to the critical speed are left out: there differences of any
/// width cross it or drown in rounding.
fn rebounds(families: &'static [&str]) -> impl Iterator<Item = [f64; 7]> {
    let columns = ["speed_normal_m_s", "radius_m", "density_kg_m3", "stiffness_pa", "adhesion_n_m", "zeta_h", "zeta_a"];
    let wanted = |case: &Case| families.contains(&case.text("family")) && case.number("restitution") > 0.0;
    cases().into_iter().filter(wanted).map(move |case| columns.map(|column| case.number(column)))
}

/// Largest error of the derivatives of e^2, which unlike e is smooth down to capture.
fn worst_restitution(families: &'static [&str], method: &impl Method<Dual<f64, 7>>) -> f64 {
    let errors = rebounds(families).map(|inputs| {
        let result = square(contact(method, Dual::variables(inputs)).overall_restitution());
        worst(inputs, result, 1e-3, |inputs| square(contact(&exact(), inputs).overall_restitution()))
    });
    errors.fold(0.0, f64::max)
}

fn square<T: Real>(x: T) -> T {
    x * x
}

fn collocation<const N: usize>(tolerance: f64) -> Collocation<N, Dual<f64, 7>> {
    Collocation::new(Dual::fixed(tolerance)).unwrap()
}

/// Derivatives converge one iteration later than values, so a larger error can remain in them. The bounds are those of the worst
/// scene, just above its critical speed. In most scenes the derivatives are as exact as the values.
#[test]
fn derivatives_of_restitution() {
    let families = &["paper", "figure6", "random", "extreme", "peeling"];
    assert!(rebounds(families).count() > 40);
    for (error, bound) in [
        (worst_restitution(families, &collocation::<7>(1e-6)), 3e-6),
        (worst_restitution(families, &collocation::<9>(1e-9)), 1e-7),
        (worst_restitution(families, &collocation::<12>(1e-12)), 1e-9),
        (worst_restitution(families, &collocation::<14>(1e-13)), 1e-10),
    ] {
        assert!(error < bound, "{error:e} of {bound:e}");
    }
}

/// After a fixed number of iterations the error of the derivatives is larger than that of the values.
#[test]
fn derivatives_at_fixed_cost() {
    let error = worst_restitution(&["paper", "figure6"], &FixedCost::<7>::new(4).unwrap());
    assert!(error < 3e-4, "{error:e}");
}

#[test]
fn derivatives_of_the_critical_speed() {
    let mut reader = csv::Reader::from_path(concat!(env!("CARGO_MANIFEST_DIR"), "/data/critical.csv")).unwrap();
    let names = reader.headers().unwrap().clone();
    let mut count = 0;
    for row in reader.records() {
        let row = row.unwrap();
        let number = |column: &str| row[names.iter().position(|name| name == column).unwrap()].parse::<f64>().unwrap();
        let [radius, density, stiffness] = ["radius_m", "density_kg_m3", "stiffness_pa"].map(number);
        let inputs = [1.0, radius, density, stiffness, number("adhesion_n_m"), number("zeta_h"), number("zeta_a")];
        let error = worst(inputs, critical_speed(Dual::variables(inputs)), 1e-3, critical_speed);
        assert!(error < 1e-10, "{error:e}");
        count += 1;
    }
    assert!(count >= 5);
}

/// In single precision the derivatives keep the accuracy that the values have there.
#[test]
fn derivatives_in_single_precision() {
    for inputs in rebounds(&["paper", "figure6"]) {
        let double = contact(&collocation::<12>(1e-12), Dual::variables(inputs)).overall_restitution();
        let method = Collocation::<8, Dual<f32, 7>>::new(Dual::fixed(1e-6)).unwrap();
        let single = contact(&method, Dual::variables(inputs.map(|input| input as f32))).overall_restitution();
        for ((input, single), double) in inputs.into_iter().zip(single.partials).zip(double.partials) {
            assert!((input * (f64::from(single) - double)).abs() < 1e-4, "{single:e} {double:e}");
        }
    }
}

/// Every function of [`Real`] against differences.
#[test]
fn rules_of_differentiation() {
    fn all<T: Real>([x, y]: [T; 2]) -> [T; 11] {
        [
            x + y,
            x - y,
            x * y,
            x / y,
            -x,
            x.sqrt(),
            x.two_fifths_power(),
            (x - y).exp(),
            x.saturating_div(y),
            (x - y).abs() + x.max(y),
            x.min(y) * T::constant(3.0),
        ]
    }
    for inputs in [[0.7, 2.9], [3.1, 0.4]] {
        for (index, dual) in all(Dual::variables(inputs)).into_iter().enumerate() {
            assert_eq!(dual.value, all(inputs)[index]);
            for (input, partial) in dual.partials.into_iter().enumerate() {
                let moved = |step: f64| {
                    let mut moved = inputs;
                    moved[input] += step * inputs[input];
                    all(moved)[index]
                };
                let difference =
                    (8.0 * (moved(1e-3) - moved(-1e-3)) - (moved(2e-3) - moved(-2e-3))) / 12e-3 / inputs[input];
                assert!((partial - difference).abs() < 1e-9, "function {index}: {partial} {difference}");
            }
        }
    }
}

/// Where a derivative is infinite or lost to overflow, partials are zero rather than not a number.
#[test]
fn no_derivative_is_not_a_number() {
    let [x] = Dual::variables([0.0]);
    for result in [x.sqrt(), x.two_fifths_power(), Dual::ONE.saturating_div(x)] {
        assert!(result.is_finite(), "{result:?}");
    }
    assert_eq!(Dual::ONE.saturating_div(x).value, f64::MAX);
    assert!(!Dual { value: 1.0, partials: [f64::NAN] }.is_finite());
}

/// The rigid-body model through the same code: e^2 = R^2 - 2 W_A/(m v^2) (A34), by hand.
#[test]
fn derivatives_of_the_rigid_body_model() {
    let [k, work, speed] = Dual::variables([130.0_f64, 2.22e-12, 2.8]);
    let sphere = Sphere::solid(Dual::fixed(5.06e-6), Dual::fixed(2600.0)).unwrap();
    let scene = RigidBody::new(sphere, SpeedRestitution::new(k).unwrap()).with_work_of_adhesion(work).unwrap();
    let e = scene.impact(&NormalMotion::new(speed).unwrap()).normal.overall_restitution();
    let (k, work, speed, mass) = (k.value, work.value, speed.value, sphere.mass().value);
    let (r, b) = (k / (k + speed), 2.0 * work / (mass * speed * speed));
    let expected = [
        r * speed / (k + speed).powi(2) / e.value,
        -b / work / 2.0 / e.value,
        (b / speed - r * k / (k + speed).powi(2)) / e.value,
    ];
    for (partial, expected) in e.partials.into_iter().zip(expected) {
        assert!((partial / expected - 1.0).abs() < 1e-12, "{partial:e} {expected:e}");
    }
}

/// The margins of a class have derivatives too: by hand, the critical speed grows with the root of the work of adhesion where
/// R is close to one, and the friction margin in proportion to f.
#[test]
fn derivatives_of_margins() {
    let [work, friction] = Dual::variables([2.22e-12_f64, 0.1]);
    let sphere = Sphere::solid(Dual::fixed(5.06e-6), Dual::fixed(2600.0)).unwrap();
    let scene = RigidBody::new(sphere, SpeedRestitution::new(Dual::fixed(1e9)).unwrap())
        .with_work_of_adhesion(work)
        .and_then(|scene| scene.with_friction(friction))
        .unwrap();
    let motion = NormalMotion::new(Dual::fixed(2.8)).unwrap().with_tangential(Dual::fixed(0.5)).unwrap();
    let class = scene.classify(&motion);
    let (speed, slip) = (class.speed_over_critical.unwrap(), class.contact.friction_over_limit.unwrap());
    assert!((work.value * speed.partials[0] / speed.value + 0.5).abs() < 1e-6);
    assert_eq!(speed.partials[1], 0.0);
    assert!((friction.value * slip.partials[1] / slip.value - 1.0).abs() < 1e-12);
    assert!(slip.partials[0] < 0.0); // a slower rebound presses less
}
