//! The adhesion of Johnson, Kendall and Roberts: contact begins at once with a finite radius and ends, stretched, at another.

use std::f64::consts::PI;

use super::assert_refused;
use microimpact::contact::{
    Adaptive, Collocation, Contact, ContactLaw, Energy, ErrorControl, FixedCost, Impulses, Recording, RestCriterion,
    RungeKuttaGill, Status, Times, Units, Works,
};
use microimpact::{CriticalSpeed, InputError, NormalMotion, Outcome, Sphere};

/// Stiffness K, Pa, and work of adhesion, J/m^2; hysteretic damping zeta_H, and a viscous relaxation time of the material, s.
///
/// In units of an impact, at the root s of the contact radius: the stiffness is one, and instead of the work of adhesion stands
/// q, so that the indentation is s^4 - q s and the elastic force (5/4) s^6.
#[derive(Clone, Copy, Debug)]
struct Jkr {
    stiffness: f64,
    adhesion: f64,
    hysteretic: f64,
    viscous: f64,
}

impl Jkr {
    fn elastic(stiffness: f64, adhesion: f64) -> Self {
        Self { stiffness, adhesion, hysteretic: 0.0, viscous: 0.0 }
    }

    /// 2 pi G/E*, of which q is the root.
    fn stretch(&self) -> f64 {
        (2.0 * PI * self.adhesion / (0.75 * self.stiffness)).sqrt()
    }

    /// The potential but for its value at the end of contact.
    fn energy(q: f64, s: f64) -> f64 {
        let cube = s * s * s;
        s * (cube * (0.46875 * q * q + cube * (0.5 * cube - 1.25 * q)))
    }
}

/// (p^n - s^n)/(p - s).
fn mean_power(p: f64, s: f64, n: i32) -> f64 {
    (0..n).map(|i| p.powi(i) * s.powi(n - 1 - i)).sum()
}

impl ContactLaw<f64> for Jkr {
    fn in_units(&self, sphere: &Sphere<f64>, approach: f64) -> Result<(Self, Units<f64>), InputError> {
        let (radius, mass) = (sphere.radius(), sphere.mass());
        let q = |length: f64| self.stretch() * (radius * length).powf(0.25) / length;
        let speed = |length: f64| (self.stiffness * radius.sqrt() * length.powf(2.5) / (1.25 * mass)).sqrt();
        let kinetic = |length: f64| 0.5 * (approach / speed(length)).powi(2);
        // The undamped motion turns at s = 1 if the potential there is the energy that the sphere brings.
        let beyond = |length: f64| {
            let q = q(length);
            Self::energy(q, 1.0) - Self::energy(q, q.cbrt()) > kinetic(length)
        };
        let equilibrium = (1.5 * self.stretch() * radius.powf(0.25)).powf(4.0 / 3.0);
        let hertz = (1.25 * mass * approach * approach / (radius.sqrt() * self.stiffness)).powf(0.4);
        let (mut below, mut above) = (equilibrium.max(0.5 * hertz), 4.0 * (equilibrium + hertz));
        for _ in 0..100 {
            let middle = 0.5 * (below + above);
            if beyond(middle) { above = middle } else { below = middle }
        }
        let (length, speed) = (above, speed(above));
        let unit = (mass / (radius.powi(3) * self.stiffness * approach.sqrt())).powf(0.4);
        let law = Self {
            stiffness: 1.0,
            adhesion: q(length),
            hysteretic: self.hysteretic * unit * speed,
            viscous: 1.5 * self.viscous * speed / length,
        };
        Ok((law, Units { length, speed, energy: kinetic(length) }))
    }

    fn loss_power(&self) -> u32 {
        0 // contact begins and ends elsewhere than at s = 0
    }

    fn potential(&self, s: f64) -> f64 {
        Self::energy(self.adhesion, s) - Self::energy(self.adhesion, self.end())
    }

    fn slope(&self, s: f64) -> f64 {
        -self.conservative_force(s) * self.indentation_slope(s)
    }

    fn curvature(&self, s: f64) -> f64 {
        let (q, cube) = (self.adhesion, s * s * s);
        s * s * (5.625 * q * q + cube * (45.0 * cube - 52.5 * q))
    }

    fn mean_slope(&self, p: f64, s: f64) -> f64 {
        let q = self.adhesion;
        0.5 * mean_power(p, s, 10) - 1.25 * q * mean_power(p, s, 7) + 0.46875 * q * q * mean_power(p, s, 4)
    }

    fn elastic_force(&self, s: f64) -> f64 {
        1.25 * s.powi(6)
    }

    fn adhesion_force(&self, s: f64) -> f64 {
        1.875 * self.adhesion * s.powi(3)
    }

    fn conservative_force(&self, s: f64) -> f64 {
        self.adhesion_force(s) - self.elastic_force(s)
    }

    fn material_damping(&self, s: f64) -> f64 {
        1.25 * (self.hysteretic * s.powi(6) + self.viscous * s * s)
    }

    fn indentation(&self, s: f64) -> f64 {
        s * (s * s * s - self.adhesion)
    }

    fn indentation_slope(&self, s: f64) -> f64 {
        4.0 * s * s * s - self.adhesion
    }

    fn coordinate(&self, _indentation: f64) -> Option<f64> {
        None // a stretched contact has two radii for each indentation
    }

    fn contact_radius(&self, s: f64) -> f64 {
        s * s
    }

    fn start(&self) -> f64 {
        self.adhesion.cbrt()
    }

    fn end(&self) -> f64 {
        (self.adhesion / 4.0).cbrt()
    }

    fn may_have_barrier(&self) -> bool {
        false
    }

    fn energy_power(&self) -> f64 {
        10.0
    }

    fn speed_of_adhesion(&self, sphere: &Sphere<f64>) -> f64 {
        let work = (self.adhesion.powi(5) * sphere.radius().powi(4) / (0.75 * self.stiffness).powi(2)).cbrt();
        (2.0 * work / sphere.mass()).sqrt()
    }
}

/// Work that an impact without damping loses, over (G^5 r^4/E*^2)^(1/3).
const SNAP_OFF: f64 = 7.092_195_971_863_959;

/// V/V_s, e, and the largest indentation and contact time in units of (pi^2 G^2 r/E*^2)^(1/3) and of that over the speed.
const UNDAMPED: [[f64; 4]; 7] = [
    [1.01, 0.140370761176, 2.13549193887, 5.8723710300134],
    [1.1, 0.416597790451, 2.19886022249, 5.8583984087819],
    [1.5, 0.745355992500, 2.49467351270, 6.8288738870518],
    [2.0, 0.866025403784, 2.87933838034, 8.1359963150581],
    [5.0, 0.979795897113, 5.14542804259, 15.227533256296],
    [10.0, 0.994987437107, 8.56652745943, 25.488863389012],
    [100.0, 0.999949998750, 52.3562077304, 154.67784963545],
];

const STIFFNESS: f64 = 5e9;
const ADHESION: f64 = 0.1;

fn sphere() -> Sphere<f64> {
    Sphere::solid(2e-6, 1050.0).unwrap()
}

fn scene() -> Contact<f64, Jkr> {
    Contact::new(sphere(), Jkr::elastic(STIFFNESS, ADHESION))
}

/// Work that an impact of the scene loses, J.
fn work_of_snapping() -> f64 {
    SNAP_OFF * (ADHESION.powi(5) * sphere().radius().powi(4) / (0.75 * STIFFNESS).powi(2)).cbrt()
}

/// The speed below which the scene captures, m/s.
fn critical() -> f64 {
    (2.0 * work_of_snapping() / sphere().mass()).sqrt()
}

/// The whole undamped result by a method against what is known.
fn check(method: &impl ErrorControl<f64>, tolerance: f64) {
    let scene = scene();
    let unit = (PI * PI * ADHESION * ADHESION * sphere().radius() / (0.75 * STIFFNESS).powi(2)).cbrt();
    for [ratio, e, depth, time] in UNDAMPED {
        let speed = ratio * critical();
        // The table has twelve digits.
        let close = |found: f64, expected: f64, allowed: f64, what: &str| {
            let error = found / expected - 1.0;
            assert!(error.abs() < allowed + 1e-11, "{what} at {ratio}: {error:e} of {allowed:e}");
        };
        let motion = NormalMotion::new(speed).unwrap();
        let outputs = ((Times, Impulses, Works), Energy, Recording::<64>);
        let (impact, ((times, impulses, works), ledger, trajectory)) =
            scene.solve_for(&motion, method, outputs).unwrap();
        assert_eq!((impact.run.status, impact.normal.outcome()), (Status::Solved, Some(Outcome::Rebound)), "{ratio}");
        close(impact.normal.overall_restitution().powi(2), e * e, tolerance / (e * e), "e^2");
        close(impact.normal.peak_indentation().unwrap(), depth * unit, tolerance, "depth");
        // Just above the critical speed the sphere hardly moves where it lets go.
        close(times.contact.unwrap(), time * unit / speed, 3.0 * tolerance / (ratio - 1.0).min(1.0), "contact time");
        assert!(times.peak.unwrap() < 0.5 * times.contact.unwrap());
        // All that is lost is lost to the neck that the surface pulls out.
        let energy = 0.5 * sphere().mass() * speed * speed;
        let ledger = ledger.unwrap();
        assert_eq!((works.material, works.adhesion), (0.0, ledger.adhesion));
        close(ledger.adhesion, work_of_snapping(), tolerance, "work of adhesion");
        close(ledger.before - ledger.after, ledger.lost(), tolerance * energy / work_of_snapping(), "energy");
        // The momentum is that of the elastic force less adhesion, over the whole contact.
        let momentum = sphere().mass() * speed * (1.0 + e);
        assert!(impulses.elastic > momentum && impulses.adhesion_rebound > 0.0);

        let samples: Vec<_> = trajectory.samples().collect();
        let (first, last) = (samples[0], samples[samples.len() - 1]);
        // Forces at first touch and at snap-off, over the pull-off force (3/2) pi G r.
        let pull = 1.5 * PI * ADHESION * sphere().radius();
        close(first.force, -8.0 / 9.0 * pull, 1e-12, "first force");
        close(last.force, -5.0 / 9.0 * pull, 1e-12, "last force");
        close(last.indentation, -0.75 * unit, 1e-12, "last indentation");
        close(last.velocity, -e * speed, tolerance / (e * e), "last velocity");
        assert!(first.indentation.abs() < 1e-12 * depth * unit && (first.velocity / speed - 1.0).abs() < 1e-12);
        assert_eq!(trajectory.peak().map(|peak| peak.time), times.peak);
    }
}

#[test]
fn undamped_impacts() {
    check(&Adaptive::new(1e-6).unwrap(), 1e-6);
    check(&Adaptive::new(1e-9).unwrap(), 1e-9);
    check(&Adaptive::new(1e-12).unwrap(), 1e-12);
    check(&Collocation::<7, f64>::new(1e-6).unwrap(), 1e-6);
    check(&Collocation::<9, f64>::new(1e-9).unwrap(), 1e-9);
    check(&Collocation::<14, f64>::new(1e-13).unwrap(), 1e-13);
}

#[test]
fn methods_that_cannot_carry_it_refuse() {
    for ratio in [0.5, 2.0] {
        let speed = ratio * critical();
        assert_refused(&scene(), speed, &RungeKuttaGill::new(1000));
        assert_refused(&scene(), speed, &FixedCost::<7>::new(3).unwrap());
        assert_refused(&scene(), speed, &FixedCost::<9>::new(8).unwrap().with_outputs::<14>());
    }
}

#[test]
fn slow_spheres_are_captured() {
    let method = Collocation::<9, f64>::new(1e-9).unwrap();
    for ratio in [1e-3, 0.03, 0.3, 0.9, 0.99, 0.999_999] {
        let motion = NormalMotion::new(ratio * critical()).unwrap();
        let (impact, times) = scene().solve_for(&motion, &method, Times).unwrap();
        assert_eq!((impact.run.status, impact.normal.outcome()), (Status::Solved, Some(Outcome::Capture)), "{ratio}");
        assert_eq!((impact.normal.overall_restitution(), times.contact), (0.0, None));
        // It turns back stretched, before the surface lets go.
        let (peak, turning) = (impact.normal.peak_indentation().unwrap(), impact.normal.turning_indentation().unwrap());
        assert!(peak > 0.0 && turning < peak && turning > -0.75 * peak, "{ratio}: {turning:e} {peak:e}");
        assert_eq!(scene().solve(&motion, &method).unwrap().normal.outcome(), Some(Outcome::Capture));
    }
    let motion = NormalMotion::new(1.000_001 * critical()).unwrap();
    assert_eq!(scene().solve(&motion, &method).unwrap().normal.outcome(), Some(Outcome::Rebound));
}

#[test]
fn critical_speed() {
    fn close(method: &impl ErrorControl<f64>, scene: &Contact<f64, Jkr>, exact: f64, allowed: f64) {
        let CriticalSpeed::At(speed) = scene.critical_speed(method).unwrap() else { panic!("no critical speed") };
        assert!((speed / exact - 1.0).abs() < allowed, "{speed} {exact} {allowed}");
    }
    close(&Adaptive::new(1e-6).unwrap(), &scene(), critical(), 1e-6);
    close(&Adaptive::new(1e-9).unwrap(), &scene(), critical(), 1e-9);
    close(&Collocation::<12, f64>::new(1e-12).unwrap(), &scene(), critical(), 2e-12);
    // V_s = 1.840183180799 (G/r)^(5/6) rho^(-1/2) E*^(-1/3).
    let formula = 1.840_183_180_799 * (ADHESION / sphere().radius()).powf(5.0 / 6.0)
        / sphere().density().sqrt()
        / (0.75 * STIFFNESS).cbrt();
    assert!((critical() / formula - 1.0).abs() < 1e-11);
    let class = scene().classify(&NormalMotion::new(3.0 * formula).unwrap(), &Adaptive::new(1e-9).unwrap());
    assert!((class.unwrap().unwrap().speed_over_critical.unwrap() - 3.0).abs() < 1e-8);
}

/// Nothing takes energy from a captured sphere without damping: it swings for ever, between the same places.
#[test]
fn a_captured_sphere_swings() {
    let method = Collocation::<12, f64>::new(1e-12).unwrap();
    let motion = NormalMotion::new(0.5 * critical()).unwrap();
    let settle =
        |most| scene().solve_to_rest(&motion, &method, &RestCriterion::new(1e-6, most).unwrap(), Times).unwrap();
    let [first, second, late, later] = [1, 2, 101, 102].map(settle);
    for (settled, most) in [(&first, 1), (&second, 2), (&late, 101), (&later, 102)] {
        assert_eq!(settled.impact.run.status, Status::BudgetSpent);
        assert_eq!(settled.motion.unwrap().turning_points, most);
    }
    let peak = first.impact.normal.peak_indentation().unwrap();
    let [first, second, late, later] = [first, second, late, later].map(|settled| settled.motion.unwrap().indentation);
    assert!((late / first - 1.0).abs() < 1e-9, "{late} {first}");
    assert!((later / second - 1.0).abs() < 1e-9 && (second / peak - 1.0).abs() < 1e-9, "{later} {second} {peak}");
}

/// In units m = r = K = 2 pi G = 1, by an independent integration: v, zeta_H, A_v, then e, peak, its time, contact time.
const DAMPED: [[f64; 7]; 4] = [
    [1.0, 0.0, 0.0, 0.4436637015018, 1.686672864477, 1.843667906995, 4.491717562496],
    [3.0, 0.0, 0.0, 0.9543373198211, 2.989987729936, 1.35984847364, 2.915048711027],
    [3.0, 0.1, 0.0, 0.3853164219619, 2.490735745944, 1.26832687106, 3.464834631099],
    [3.0, 0.0, 0.05, 0.7308069490601, 2.795944495077, 1.337239250589, 3.051062212045],
];

/// A sphere of those units.
fn unit_scene(hysteretic: f64, viscous: f64) -> Contact<f64, Jkr> {
    let sphere = Sphere::solid(1.0, 0.75 / PI).unwrap();
    Contact::new(sphere, Jkr { stiffness: 1.0, adhesion: 0.5 / PI, hysteretic, viscous })
}

#[test]
fn damped_impacts() {
    let method = Collocation::<12, f64>::new(1e-11).unwrap();
    for [speed, hysteretic, viscous, e, depth, peak, contact] in DAMPED {
        let motion = NormalMotion::new(speed).unwrap();
        let scene = unit_scene(hysteretic, viscous);
        let (impact, (times, works, ledger)) = scene.solve_for(&motion, &method, (Times, Works, Energy)).unwrap();
        for (found, exact) in [
            (impact.normal.overall_restitution(), e),
            (impact.normal.peak_indentation().unwrap(), depth),
            (times.peak.unwrap(), peak),
            (times.contact.unwrap(), contact),
        ] {
            assert!((found / exact - 1.0).abs() < 2e-10, "{speed} {hysteretic} {viscous}: {found} for {exact}");
        }
        let ledger = ledger.unwrap();
        assert!((ledger.lost() / (ledger.before - ledger.after) - 1.0).abs() < 1e-10);
        assert_eq!(ledger.material, works.material);
    }
}

/// With damping the sphere comes to rest, and the critical speed lies where its neighbours part.
#[test]
fn damped_captures_and_critical_speeds() {
    let method = Collocation::<12, f64>::new(1e-10).unwrap();
    let criterion = RestCriterion::new(1e-6, 1000).unwrap();
    for (hysteretic, viscous) in [(0.1, 0.0), (0.0, 0.05), (0.3, 0.3), (1.0, 0.0), (3.0, 1.0)] {
        let scene = unit_scene(hysteretic, viscous);
        let motion = NormalMotion::new(1.0).unwrap();
        let settled = scene.solve_to_rest(&motion, &method, &criterion, (Times, Works)).unwrap();
        assert_eq!(settled.impact.normal.outcome(), Some(Outcome::Capture));
        assert_eq!(settled.impact.run.status, Status::Solved, "{hysteretic} {viscous}");
        // a^(3/2) = (3/2) r q where the forces balance: x = a^2 - q a^(1/2).
        let q = (4.0_f64 / 3.0).sqrt();
        let radius = (1.5 * q).powf(2.0 / 3.0);
        let equilibrium = radius * radius - q * radius.sqrt();
        let indentation = settled.motion.unwrap().indentation;
        assert!((indentation / equilibrium - 1.0).abs() < 2e-3, "{indentation} {equilibrium}");
        // What it brought and what the first touch gave it, less the depth of the well there, has gone into the materials.
        let well = |a: f64| 0.4 * a.powi(5) - q * a.powf(3.5) + 0.375 * q * q * a * a;
        let lost = 0.5 + well(q.powf(2.0 / 3.0)) - well(radius);
        assert!((settled.outputs.1.material / lost - 1.0).abs() < 1e-5, "{} {lost}", settled.outputs.1.material);

        let critical = scene.critical_speed(&method).unwrap();
        let CriticalSpeed::At(critical) = critical else {
            assert_eq!((critical, hysteretic), (CriticalSpeed::NeverRebounds, 3.0));
            let fastest = scene.solve(&NormalMotion::new(1e6).unwrap(), &method).unwrap();
            // Damping takes all but a fraction below the tolerance.
            assert_ne!(fastest.normal.outcome(), Some(Outcome::Rebound));
            continue;
        };
        for (ratio, outcome) in [(1.0 - 1e-7, Outcome::Capture), (1.0 + 1e-7, Outcome::Rebound)] {
            let motion = NormalMotion::new(ratio * critical).unwrap();
            let found = scene.solve(&motion, &method).unwrap().normal.outcome();
            // Strong damping leaves so little energy that it may be within its error.
            let undecided = found == Some(Outcome::Undecided) && hysteretic + viscous > 0.5;
            assert!(undecided || found == Some(outcome), "{hysteretic} {viscous}: {found:?}");
        }
    }
}
