//! Which law the data follow, and what they say of it.

use rayon::prelude::*;

use crate::fit::{LawFit, ScatterModel};
use crate::law::Law;
use crate::observation::{Observation, median_mass};
use crate::profile::Interval;
use crate::stop::Stop;

/// Probability below which a law does not fit.
pub const LEAST_P_VALUE: f64 = 0.001;

/// Rebounds below which nothing is stated.
pub const LEAST_REBOUNDS: usize = 12;

/// Ratio of the largest to the smallest speed below which the data do not show how the restitution depends on speed.
pub const LEAST_RANGE: f64 = 1.2;

/// Difference of Akaike's criterion above which a law is much less likely than another (Burnham and Anderson 2002).
pub const TOLD_APART: f64 = 6.0;

/// A law among those that compete.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The law.
    pub law: Law,
    /// Akaike's criterion less that of the best law.
    pub aic: f64,
    /// Probability of data at least as far from the law.
    pub p_value: f64,
}

impl Candidate {
    /// A fit among others, of which the best has the least criterion.
    fn of(fit: &LawFit, least: f64) -> Self {
        Self { law: fit.law, aic: fit.aic() - least, p_value: fit.judgement.p_value() }
    }

    /// Whether the law fits and is not much less likely than the best.
    fn is_likely(&self) -> bool {
        self.fits() && self.aic < TOLD_APART
    }

    /// Whether the law fits.
    #[must_use]
    pub fn fits(&self) -> bool {
        self.p_value >= LEAST_P_VALUE
    }
}

/// A quantity with its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Its name, which ends with the unit.
    pub name: &'static str,
    /// Its symbol.
    pub symbol: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Value and interval of 95 %.
    pub interval: Interval,
}

/// Name, symbol and unit of the critical speed.
const CRITICAL_SPEED: (&str, &str, &str) = ("critical_speed_m_s", "critical speed", "m/s");

/// What the data say.
pub enum Verdict {
    /// Nothing; the reason.
    NotEnough(String),
    /// No law fits. The laws that were tried, the best first.
    NoLaw(Vec<Candidate>),
    /// A law fits.
    Fits(Box<Statement>),
}

/// A law that fits, with its quantities.
pub struct Statement {
    /// The fit.
    pub fit: LawFit,
    /// Its quantities.
    pub quantities: Vec<Quantity>,
    /// All laws that were tried, the best first.
    pub candidates: Vec<Candidate>,
}

impl Statement {
    /// Other laws that fit and are not much less likely.
    #[must_use]
    pub fn not_told_apart(&self) -> Vec<Law> {
        let alike = |candidate: &&Candidate| candidate.is_likely() && candidate.law != self.fit.law;
        self.candidates.iter().filter(alike).map(|candidate| candidate.law).collect()
    }

    /// A quantity of a name.
    #[must_use]
    pub fn quantity(&self, name: &str) -> Option<Interval> {
        self.quantities.iter().find(|quantity| quantity.name == name).map(|quantity| quantity.interval)
    }
}

/// Fits each of some `laws`, and states the quantities of the most likely one that fits. Of laws that the data do not tell apart,
/// a constant or the paper's law is chosen, and the interval of the critical speed is that of all of them. An observation whose numbers
/// are none that a fit can compute with is not enough.
#[must_use]
pub fn compete(observations: &[Observation], laws: &[Law], scatter: ScatterModel) -> Verdict {
    verdict(&Stop::default(), observations, laws, scatter)
}

/// The same, which ends within some milliseconds after `stop` is asked from another thread; `None` if it was.
#[must_use]
pub fn compete_until(
    stop: &Stop,
    observations: &[Observation],
    laws: &[Law],
    scatter: ScatterModel,
) -> Option<Verdict> {
    let verdict = verdict(stop, observations, laws, scatter);
    (!stop.is_asked()).then_some(verdict)
}

fn verdict(stop: &Stop, observations: &[Observation], laws: &[Law], scatter: ScatterModel) -> Verdict {
    for (index, observation) in observations.iter().enumerate() {
        if let Err(error) = observation.check() {
            return Verdict::NotEnough(format!("row {}: {error}", index + 1));
        }
    }
    let rebounds = observations.iter().filter(|observation| observation.rebounds()).count();
    if rebounds < LEAST_REBOUNDS {
        return Verdict::NotEnough(format!(
            "not enough data: a fit needs at least {LEAST_REBOUNDS} rebounds; the table has {rebounds}"
        ));
    }
    let speeds = observations.iter().filter(|observation| observation.rebounds()).map(|observation| observation.speed);
    let (low, high) = speeds.fold((f64::MAX, 0.0_f64), |(low, high), speed| (low.min(speed), high.max(speed)));
    if high < LEAST_RANGE * low {
        let [low, high] = [low, high].map(|speed| format!("{speed:.4}"));
        let range = if low == high { format!("of {low} m/s") } else { format!("from {low} to {high} m/s") };
        return Verdict::NotEnough(format!(
            "not enough data: all rebounds have approach speeds {range}, but a law needs speeds that differ by a factor of at least \
             {LEAST_RANGE}"
        ));
    }
    let mut fits: Vec<LawFit> =
        laws.par_iter().filter_map(|law| LawFit::until(stop, observations, *law, scatter)).collect();
    let least = fits.iter().map(LawFit::aic).fold(f64::INFINITY, f64::min);
    let candidate = |fit: &LawFit| Candidate::of(fit, least);
    let mut candidates: Vec<Candidate> = fits.iter().map(candidate).collect();
    candidates.sort_by(|a, b| a.aic.total_cmp(&b.aic));
    let fitting = |fit: &&LawFit| candidate(fit).fits();
    let best = candidates.iter().filter(|candidate| candidate.fits()).map(|candidate| candidate.aic);
    let best = best.fold(f64::INFINITY, f64::min);
    let chosen = fits.iter().filter(fitting).min_by(|a, b| preference(a).total_cmp(&preference(b))).map(|fit| fit.law);
    let chosen = fits.iter().position(|fit| Some(fit.law) == chosen);
    // A law much less likely than one that does not fit is no better description of the data.
    let refuted = best > REFUTED;
    match chosen {
        Some(chosen) if !refuted => {
            let mut fit = fits.swap_remove(chosen);
            let mut quantities = quantities(&mut fit, median_mass(observations));
            let alike = |other: &&mut LawFit| candidate(other).is_likely();
            let others: Vec<Interval> =
                fits.par_iter_mut().filter(alike).map(|other| other.critical_speed().unwrap_or(NONE)).collect();
            widen(&mut quantities, &others);
            Verdict::Fits(Box::new(Statement { fit, quantities, candidates }))
        }
        _ => Verdict::NoLaw(candidates),
    }
}

/// The critical speed by a law without adhesion.
const NONE: Interval = Interval { value: 0.0, low: 0.0, high: 0.0 };

/// Widens the interval of the critical speed by those of other laws that the data do not tell apart: which law holds is not known.
fn widen(quantities: &mut [Quantity], others: &[Interval]) {
    for quantity in quantities.iter_mut().filter(|quantity| quantity.name == CRITICAL_SPEED.0) {
        for other in others {
            quantity.interval.low = quantity.interval.low.min(other.low);
            quantity.interval.high = quantity.interval.high.max(other.high);
        }
    }
}

/// Difference of Akaike's criterion from a law that does not fit, above which a law that passes the tests is refuted too.
const REFUTED: f64 = 30.0;

/// Akaike's criterion with a handicap, so that the data must speak clearly for laws other than a constant and the paper's law.
fn preference(fit: &LawFit) -> f64 {
    fit.aic() + if matches!(fit.law, Law::Constant | Law::SpeedRestitution) { 0.0 } else { TOLD_APART }
}

fn quantities(fit: &mut LawFit, mass: Option<f64>) -> Vec<Quantity> {
    let reference = fit.reference();
    let quantity = |(name, symbol, unit), interval| Quantity { name, symbol, unit, interval };
    let first = fit.first();
    let mut found = vec![match fit.law {
        Law::Constant => quantity(("restitution", "R", "1"), first),
        Law::SpeedRestitution => quantity(("restitution_speed_m_s", "k", "m/s"), first.reciprocal(reference)),
        Law::ElasticPlastic => quantity(("yield_speed_m_s", "v_y", "m/s"), first.map(|log| log.exp() * reference)),
        Law::Viscoelastic => {
            quantity(("viscoelastic_x_at_1_m_s", "x at 1 m/s", "1"), first.map(|x| x * reference.powf(-0.2)))
        }
        Law::Ring | Law::Dmt | Law::Jkr => {
            quantity(("damping_at_largest_speed", "c_H v at the largest speed", "1"), first)
        }
    }];
    if !fit.has_adhesion {
        return found;
    }
    let (work, critical) = (fit.work(), fit.critical_speed());
    if let Some(work) = work {
        let energy = 0.5 * reference * reference;
        found.push(match mass {
            Some(mass) => quantity(("work_of_adhesion_j", "W_A", "J"), work.map(|work| work * energy * mass)),
            None => quantity(("work_of_adhesion_j_kg", "W_A/m", "J/kg"), work.map(|work| work * energy)),
        });
    }
    if let Some(critical) = critical {
        found.push(quantity(CRITICAL_SPEED, critical));
    }
    found
}
