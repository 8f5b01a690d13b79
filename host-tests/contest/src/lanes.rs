//! `FixedCost` on four impacts at once, on one thread.

use impact_arrays::{Column, Contacts, Damping, Impacts, Law, Motions, Quantity, RowStatus};
use microimpact::contact::{Adaptive, FixedCost, PhaseSamples};
use rayon::{ThreadPool, ThreadPoolBuilder};
use reference::Case;

use std::hint::black_box;
use std::rc::Rc;

use crate::contestant::{Answer, Asked, Contestant, Solver};

/// Name of the method in lanes.
pub const IN_LANES: &str = "FixedCost, four lanes";

/// All numbers of nodes and iterations. What the method does not decide takes `Adaptive`.
pub fn contestants(cases: &[Case], asked: Asked) -> Vec<Contestant> {
    let columns = Rc::new(Columns::new(cases));
    let mut all = with_nodes::<5, 8>(&columns, asked);
    all.extend(with_nodes::<6, 9>(&columns, asked));
    all.extend(with_nodes::<7, 10>(&columns, asked));
    all.extend(with_nodes::<8, 11>(&columns, asked));
    all.extend(with_nodes::<9, 12>(&columns, asked));
    all.extend(with_nodes::<10, 13>(&columns, asked));
    all
}

fn with_nodes<const N: usize, const M: usize>(columns: &Rc<Columns>, asked: Asked) -> Vec<Contestant>
where
    f64: PhaseSamples<N, M>,
    impact_arrays::F64x4: PhaseSamples<N, M>,
{
    let with = |iterations: u32| {
        let method = FixedCost::<N>::new(iterations).ok()?.with_outputs::<M>();
        let solver = Lanes { columns: Rc::clone(columns), method, otherwise: Adaptive::new(1e-12).ok()?, asked };
        Some(Contestant::of(IN_LANES, format!("{N} nodes"), format!("{iterations} iterations"), solver))
    };
    (2..=10).filter_map(with).collect()
}

/// Impacts as a column for each number.
struct Columns {
    radius: Vec<f64>,
    density: Vec<f64>,
    stiffness: Vec<f64>,
    adhesion: Vec<f64>,
    material_damping: Vec<f64>,
    adhesion_damping: Vec<f64>,
    speed: Vec<f64>,
    thread: ThreadPool,
}

impl Columns {
    fn new(cases: &[Case]) -> Self {
        let column = |name: &str| cases.iter().map(|case| case.number(name)).collect();
        Self {
            radius: column("radius_m"),
            density: column("density_kg_m3"),
            stiffness: column("stiffness_pa"),
            adhesion: column("adhesion_n_m"),
            material_damping: column("zeta_h"),
            adhesion_damping: column("zeta_a"),
            speed: column("speed_normal_m_s"),
            thread: ThreadPoolBuilder::new().num_threads(1).build().expect("there is a thread"),
        }
    }
}

struct Lanes<const N: usize, const M: usize> {
    columns: Rc<Columns>,
    method: FixedCost<N, M>,
    otherwise: Adaptive<f64>,
    asked: Asked,
}

impl<const N: usize, const M: usize> Lanes<N, M>
where
    f64: PhaseSamples<N, M>,
    impact_arrays::F64x4: PhaseSamples<N, M>,
{
    fn impacts(&self) -> Impacts {
        let columns = black_box(&*self.columns);
        let contacts = Contacts {
            radius: Column::Each(&columns.radius),
            density: Column::Each(&columns.density),
            stiffness: Column::Each(&columns.stiffness),
            law: Law::Ring {
                strength: Column::Each(&columns.adhesion),
                damping: Column::Each(&columns.adhesion_damping),
            },
            damping: Damping::Hysteretic(Column::Each(&columns.material_damping)),
            ..Contacts::default()
        };
        let zero = Column::All(0.0);
        let speed_normal = Column::Each(&columns.speed);
        let motions = Motions::Planar { speed_normal, speed_tangential: zero, spin: zero };
        let quantities = match self.asked {
            Asked::Restitution => &[Quantity::OverallRestitution][..],
            Asked::Outputs => &[Quantity::OverallRestitution, Quantity::ContactTime, Quantity::ImpulseHertz],
        };
        let (method, otherwise) = (&self.method, &self.otherwise);
        let count = columns.speed.len();
        columns.thread.install(|| contacts.simulate_in_lanes(&motions, count, method, otherwise, quantities))
    }
}

impl<const N: usize, const M: usize> Solver for Lanes<N, M>
where
    f64: PhaseSamples<N, M>,
    impact_arrays::F64x4: PhaseSamples<N, M>,
{
    fn solve(&mut self, tell: &mut dyn FnMut(Option<Answer>)) {
        let impacts = self.impacts();
        let number = |quantity, row: usize| Some(*impacts.numbers(quantity)?.get(row)?);
        for (row, status) in impacts.status.iter().enumerate() {
            let answer = number(Quantity::OverallRestitution, row).map(|restitution| Answer {
                restitution,
                contact_time: number(Quantity::ContactTime, row),
                impulse: number(Quantity::ImpulseHertz, row),
                effort: None,
            });
            tell(answer.filter(|_| *status == RowStatus::Solved));
        }
    }
}
