//! Impacts whose losses are in proportion to the force, which are taken in closed form: against that form, and against the same law where
//! the solver does not know.

use microimpact::contact::{
    Adaptive, Collocation, Contact, ContactLaw, HertzLaw, HystereticDamping, Impulses, Method, Times, Units, Works,
};
use microimpact::{InputError, NormalMotion, Sphere, Stiffness};

type Law = HertzLaw<f64, HystereticDamping<f64>>;

/// The law without the statement that its losses are in proportion to the force.
#[derive(Clone, Copy)]
struct Silent(Law);

impl ContactLaw<f64> for Silent {
    fn in_units(&self, sphere: &Sphere<f64>, approach: f64) -> Result<(Self, Units<f64>), InputError> {
        self.0.in_units(sphere, approach).map(|(law, units)| (Self(law), units))
    }
    fn loss_power(&self) -> u32 {
        self.0.loss_power()
    }
    fn potential(&self, s: f64) -> f64 {
        self.0.potential(s)
    }
    fn slope(&self, s: f64) -> f64 {
        self.0.slope(s)
    }
    fn curvature(&self, s: f64) -> f64 {
        self.0.curvature(s)
    }
    fn mean_slope(&self, p: f64, s: f64) -> f64 {
        self.0.mean_slope(p, s)
    }
    fn elastic_force(&self, s: f64) -> f64 {
        self.0.elastic_force(s)
    }
    fn material_damping(&self, s: f64) -> f64 {
        self.0.material_damping(s)
    }
    fn may_have_barrier(&self) -> bool {
        false
    }
}

const SPEED: f64 = 1.0;

fn sphere() -> Sphere<f64> {
    Sphere::solid(5e-6, 2600.0).unwrap()
}

/// The law with a product of damping constant and approach speed.
fn law(drag: f64) -> Law {
    let hertz = HertzLaw::new(Stiffness::new(1e10).unwrap());
    let unit = Contact::new(sphere(), hertz.with_damping(1.0).unwrap());
    let unit = unit.groups(&NormalMotion::new(SPEED).unwrap()).unwrap().material_damping;
    hertz.with_damping(drag / unit).unwrap()
}

fn drags(per_decade: i32, decades: std::ops::Range<i32>) -> impl Iterator<Item = f64> {
    let steps = per_decade * decades.start..per_decade * decades.end;
    steps.map(move |step| 10_f64.powf(f64::from(step) / f64::from(per_decade)))
}

/// The restitution is that of d (1 + e) = ln((1 + d)/(1 - e d)) to roundings, for any damping and tolerance.
#[test]
fn restitution_is_exact() {
    let motion = NormalMotion::new(SPEED).unwrap();
    for d in drags(7, -6..6) {
        let scene = Contact::new(sphere(), law(d));
        let loose = Adaptive::new(1e-3).unwrap();
        let e = scene.solve(&motion, &loose).unwrap().normal.overall_restitution();
        // 1 - e d = (1 + d) exp(-d (1 + e)); for weak damping both sides are close to one, and their logarithms small.
        let (fall, product) = (-d * (1.0 + e), e * d);
        let residual =
            if d < 1.0 { (-product).ln_1p() - d.ln_1p() - fall } else { 1.0 - product - (1.0 + d) * fall.exp() };
        // The residual changes with e as d^2 (1 + e) or more where d is small.
        let slope = if d < 1.0 { d * d } else { d };
        assert!(residual.abs() < 8.0 * f64::EPSILON * (slope + d), "{d}: e = {e}, residual {residual:e}");
    }
}

/// Contact time, time of the peak, elastic impulse and work of the materials.
fn observed(law: impl ContactLaw<f64>, method: &impl Method<f64>) -> [f64; 4] {
    let motion = NormalMotion::new(SPEED).unwrap();
    let (_, (times, impulses, works)) =
        Contact::new(sphere(), law).solve_for(&motion, method, (Times, Impulses, Works)).unwrap();
    [times.contact.unwrap(), times.peak.unwrap(), impulses.elastic, works.material]
}

/// A law, and what the solver observes along its intervals where it does not know that it can do without.
type Case = (f64, Law, [f64; 4]);

fn assert_observed(cases: &[Case], method: &impl Method<f64>, tolerance: f64, name: &str) {
    let momentum = sphere().mass() * SPEED;
    for (d, law, exact) in cases {
        let found = observed(*law, method);
        let scales = [exact[0], exact[0], momentum, 0.5 * momentum * SPEED];
        let errors: [f64; 4] = std::array::from_fn(|k| (found[k] - exact[k]) / scales[k]);
        let largest = errors.iter().fold(0.0_f64, |most, error| most.max(error.abs()));
        assert!(largest <= tolerance, "{name}, {tolerance:e}, d = {d}: {errors:?}");
    }
}

/// Times, impulses and works are those that the solver finds by intervals, to the tolerance.
#[test]
fn what_is_observed_meets_the_tolerance() {
    let exact = Collocation::<14, f64>::new(1e-13).unwrap();
    let cases: Vec<Case> = drags(9, 0..5).map(|d| (d, law(d), observed(Silent(law(d)), &exact))).collect();
    for tolerance in [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11] {
        assert_observed(&cases, &Adaptive::new(tolerance).unwrap(), tolerance, "adaptive");
        assert_observed(&cases, &Collocation::<12, f64>::new(tolerance).unwrap(), tolerance, "12 nodes");
    }
    for tolerance in [1e-4, 1e-5, 1e-6] {
        assert_observed(&cases, &Collocation::<7, f64>::new(tolerance).unwrap(), tolerance, "7 nodes");
    }
    assert_observed(&cases, &Collocation::<4, f64>::new(1e-3).unwrap(), 1e-3, "4 nodes");
}
