//! The scenes, their solutions, and the methods of the library.

use std::hint::black_box;

use microimpact::contact::{Collocation, FixedCost, Method, RingScene, RunReport, RungeKuttaGill, Times};
use microimpact::{CriticalSpeed, NormalMotion, Stiffness};
use reference::{Case, case};

use contest::contestant::{Answer, Contestant, tolerances};
use contest::problem::Problem;
use contest::scene::{normal_scene, solution, solved};

/// The formulation that the others are compared with.
pub const COLLOCATION: &str = "Collocation";

/// A scene with its solution.
pub struct Scene {
    pub name: &'static str,
    pub exact: Answer,
    scene: RingScene<f64>,
    stiffness: Stiffness<f64>,
    motion: NormalMotion<f64>,
}

impl Scene {
    pub fn all() -> [Self; 6] {
        [
            Self::checked("Table 1", &case("table1")),
            Self::checked("no adhesion", &case("mean_sphere_no_adhesion")),
            Self::checked("5 um at 30 m/s", &case("d5um_v30")),
            Self::near_critical(),
            Self::checked("strong damping", &case("x002")),
            Self::overwhelmed(),
        ]
    }

    fn of(name: &'static str, case: &Case) -> Self {
        let (scene, motion) = normal_scene(case);
        let stiffness = Stiffness::new(case.number("stiffness_pa")).unwrap();
        Self { name, exact: solution(case), scene, stiffness, motion }
    }

    /// A scene of the reference, with the reference's solution confirmed by the library.
    fn checked(name: &'static str, case: &Case) -> Self {
        let mut scene = Self::of(name, case);
        let solved = scene.solve();
        for error in solved.errors(&scene.exact).into_iter().flatten() {
            assert!(error < 1e-12, "{name}: {error:e}");
        }
        scene.exact = solved;
        scene
    }

    fn near_critical() -> Self {
        let mut near_critical = Self::of("Table 1 at 1.13 times the critical speed", &case("table1"));
        let CriticalSpeed::At(speed) = near_critical.scene.critical_speed(&exactly()).unwrap() else {
            panic!("the sphere of Table 1 has a critical speed");
        };
        near_critical.motion = NormalMotion::new(1.13 * speed).unwrap();
        near_critical.exact = near_critical.solve();
        near_critical
    }

    /// Damping a thousand times that of the paper, without adhesion, where e has a closed form:
    /// d (1 + e) = ln((1 + d)/(1 - e d)), d = c_H v.
    fn overwhelmed() -> Self {
        let case = case("mean_sphere_no_adhesion");
        let mut scene = Self::of("no adhesion, damping a thousandfold", &case);
        scene.scene = scene.scene.with_damping(1000.0 * case.number("zeta_h")).unwrap();
        scene.exact = scene.solve();
        let equations = scene.equations();
        let (e, d) = (scene.exact.restitution, equations.material_damping * equations.start()[1]);
        // In this form it is not ill-conditioned.
        let error = (e * d - 1.0 + (1.0 + d) * (-d * (1.0 + e)).exp()).abs();
        assert!(error < 1e-12, "{error:e}");
        scene
    }

    fn solve(&self) -> Answer {
        answer(&self.scene, &self.motion, &exactly(), |_| None).unwrap()
    }

    pub fn equations(&self) -> Problem {
        Problem::new(&self.scene, self.stiffness, &self.motion)
    }

    /// The methods of the library.
    pub fn contestants(&self) -> Vec<Contestant> {
        let mut all = self.collocation::<5>();
        all.extend(self.collocation::<7>());
        all.extend(self.collocation::<9>());
        all.extend(self.collocation::<12>());
        all.extend(self.collocation::<14>());
        all.extend(self.fixed_cost::<4>());
        all.extend(self.fixed_cost::<5>());
        all.extend(self.fixed_cost::<6>());
        all.extend(self.fixed_cost::<7>());
        all.extend(self.fixed_cost::<8>());
        all.extend(self.paper_method());
        all
    }

    /// With the contact time, and for e alone.
    fn collocation<const N: usize>(&self) -> Vec<Contestant> {
        let mut all = Vec::new();
        for tolerance in tolerances() {
            let Ok(method) = Collocation::<N, f64>::new(tolerance) else { continue };
            let (scene, motion) = (self.scene, self.motion);
            let (name, setting) = (format!("{N} nodes"), format!("{tolerance:.0e}"));
            all.push(Contestant::new(COLLOCATION, name.clone(), setting.clone(), move || {
                answer(black_box(&scene), black_box(&motion), &method, |run| {
                    Some(((run.evaluations / N as u32) as usize, "products"))
                })
            }));
            all.push(Contestant::new("Collocation, e alone", name, setting, move || {
                let contact = black_box(&scene).solve_normal(black_box(&motion), &method).ok()?;
                let restitution = solved(contact.overall_restitution(), contact.status())?;
                Some(Answer::of_restitution(restitution, None))
            }));
        }
        all
    }

    fn fixed_cost<const N: usize>(&self) -> Vec<Contestant> {
        let contestant = |iterations: u32| {
            let (scene, motion, method) = (self.scene, self.motion, FixedCost::<N>::new(iterations).unwrap());
            let setting = format!("{N} nodes, {iterations} iterations");
            Contestant::new("whole phase, weighted Gauss", "FixedCost", setting, move || {
                let contact = black_box(&scene).solve_normal(black_box(&motion), &method).ok()?;
                let restitution = solved(contact.overall_restitution(), contact.status())?;
                Some(Answer::of_restitution(restitution, Some((2 * iterations as usize, "products"))))
            })
        };
        (2..=12).map(contestant).collect()
    }

    fn paper_method(&self) -> Vec<Contestant> {
        let contestant = |half_octaves: u32| {
            let steps = (64.0 * 2f64.powf(0.5 * f64::from(half_octaves))) as u32;
            let (scene, motion, method) = (self.scene, self.motion, RungeKuttaGill::new(steps));
            Contestant::new("the paper's equations", "Runge-Kutta-Gill", format!("{steps} steps"), move || {
                answer(black_box(&scene), black_box(&motion), &method, |run| {
                    Some((run.evaluations as usize, "evaluations"))
                })
            })
        };
        (0..19).map(contestant).collect()
    }
}

/// The restitution and the contact time of an impact, with what was counted; `None` where the method found no solution.
fn answer(
    scene: &RingScene<f64>,
    motion: &NormalMotion<f64>,
    method: &impl Method<f64>,
    effort: impl Fn(&RunReport<f64>) -> Option<(usize, &'static str)>,
) -> Option<Answer> {
    let (impact, times) = scene.solve_for(motion, method, Times).ok()?;
    let restitution = solved(impact.normal.overall_restitution(), impact.run.status)?;
    Some(Answer { restitution, contact_time: times.contact, impulse: None, effort: effort(&impact.run) })
}

/// The setting that the others are measured by.
fn exactly() -> Collocation<14, f64> {
    Collocation::new(1e-13).unwrap()
}
