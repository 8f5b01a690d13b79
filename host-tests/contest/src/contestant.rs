//! A method with one setting, and what it answers.

/// What a method says of a contact, as far as it does.
#[derive(Clone, Copy)]
pub struct Answer {
    /// e.
    pub restitution: f64,
    /// s
    pub contact_time: Option<f64>,
    /// Of Hertz's force, N s.
    pub impulse: Option<f64>,
    /// What was counted, and how much of it.
    pub effort: Option<(usize, &'static str)>,
}

impl Answer {
    /// e alone.
    pub fn of_restitution(restitution: f64, effort: Option<(usize, &'static str)>) -> Self {
        Self { restitution, contact_time: None, impulse: None, effort }
    }

    /// Error of e, and relative errors of contact time and impulse.
    pub fn errors(&self, exact: &Self) -> [Option<f64>; 3] {
        let relative = |value: Option<f64>, exact: Option<f64>| Some((value? / exact? - 1.0).abs());
        [
            Some((self.restitution - exact.restitution).abs()),
            relative(self.contact_time, exact.contact_time),
            relative(self.impulse, exact.impulse),
        ]
    }
}

/// A method with one setting.
pub struct Contestant {
    /// Whose settings compete for one row: a method of this library, or a peer.
    pub entry: &'static str,
    /// Which of its algorithms.
    pub method: String,
    /// What sets the error.
    pub setting: String,
    /// Solves the contact; `None` where the solver gives up.
    pub run: Box<dyn FnMut() -> Option<Answer>>,
}

impl Contestant {
    /// A setting, run from the start each time.
    pub fn new(
        entry: &'static str,
        method: impl Into<String>,
        setting: impl Into<String>,
        run: impl FnMut() -> Option<Answer> + 'static,
    ) -> Self {
        Self { entry, method: method.into(), setting: setting.into(), run: Box::new(run) }
    }
}

/// Tolerances from loose to tight.
pub fn tolerances() -> impl Iterator<Item = f64> {
    (4..=30).map(|half_decades| 10f64.powf(-0.5 * f64::from(half_decades)))
}
