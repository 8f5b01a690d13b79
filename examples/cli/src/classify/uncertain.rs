//! Probabilities of the classes of a row whose numbers have standard errors.
//!
//! Small errors are propagated by the expansion of the library, [`ClassProbabilities`]; its error is below a hundredth for
//! standard errors of up to a tenth. For larger errors, for numbers near the bound of their range, and for scenes that the
//! expansion does not know, the model classifies random rows.

use microimpact::measure::{ClassProbabilities, Uncertain};
use microimpact::{Class, Fault, InputError, Parameter};
use rand::SeedableRng;
use rand::rngs::StdRng;
use rand_distr::{Distribution, StandardNormal};
use sheet::{Header, Input, Row, Scalar, Value};

use crate::command::Number;
use crate::words::{CANNOT_TELL, moving};

/// A number that may have a standard error.
struct Quantity {
    column: &'static str,
    error: &'static str,
    parameter: Parameter,
    /// Whether an empty cell means zero.
    is_zero_if_empty: bool,
}

const fn quantity(column: &'static str, error: &'static str, parameter: Parameter) -> Quantity {
    Quantity { column, error, parameter, is_zero_if_empty: false }
}

const fn or_zero(column: &'static str, error: &'static str, parameter: Parameter) -> Quantity {
    Quantity { column, error, parameter, is_zero_if_empty: true }
}

/// Most numbers with an error in a model.
const MOST: usize = 14;

/// The numbers of both models.
const SHARED: [Quantity; 7] = [
    quantity("radius_m", "radius_error_m", Parameter::Radius),
    // A table has one of them. No sphere is so large or so small that the range of the other matters.
    quantity("diameter_m", "diameter_error_m", Parameter::Radius),
    quantity("density_kg_m3", "density_error_kg_m3", Parameter::Density),
    quantity("speed_normal_m_s", "speed_normal_error_m_s", Parameter::ApproachSpeed),
    or_zero("speed_tangential_m_s", "speed_tangential_error_m_s", Parameter::TangentialVelocity),
    or_zero("spin_rad_s", "spin_error_rad_s", Parameter::Spin),
    or_zero("friction", "friction_error", Parameter::Friction),
];

const RIGID_BODY: [Quantity; 6] = [
    quantity("restitution", "restitution_error", Parameter::Restitution),
    quantity("restitution_speed_m_s", "restitution_speed_error_m_s", Parameter::RestitutionSpeed),
    quantity("yield_speed_m_s", "yield_speed_error_m_s", Parameter::YieldSpeed),
    quantity("adhesion_coefficient", "adhesion_coefficient_error", Parameter::AdhesionCoefficient),
    quantity("work_of_adhesion_j", "work_of_adhesion_error_j", Parameter::WorkOfAdhesion),
    quantity("adhesion_speed_m_s", "adhesion_speed_error_m_s", Parameter::AdhesionSpeed),
];

const SIMULATION: [Quantity; 6] = [
    quantity("stiffness_pa", "stiffness_error_pa", Parameter::Stiffness),
    quantity("adhesion_n_m", "adhesion_error_n_m", Parameter::AdhesionStrength),
    quantity("work_of_adhesion_j_m2", "work_of_adhesion_error_j_m2", Parameter::AdhesionEnergy),
    quantity("zeta_h", "zeta_h_error", Parameter::MaterialDamping),
    quantity("zeta_a", "zeta_a_error", Parameter::AdhesionDamping),
    or_zero("external_force_n", "external_force_error_n", Parameter::ExternalForce),
];

/// The columns of the standard errors of some numbers.
const fn errors<const N: usize>(quantities: &[Quantity; N]) -> [&'static str; N] {
    let mut columns = [""; N];
    let mut index = 0;
    while index < N {
        columns[index] = quantities[index].error;
        index += 1;
    }
    columns
}

const SHARED_INPUT: Input = Input::further(&const { errors(&SHARED) });
const RIGID_BODY_INPUT: Input = Input::further(&const { errors(&RIGID_BODY) });
const SIMULATION_INPUT: Input = Input::further(&const { errors(&SIMULATION) });

/// The columns that are computed.
const COLUMNS: [&str; 10] = [
    "probability_capture",
    "probability_sliding",
    "probability_rolling",
    "probability_rebound_sliding",
    "probability_rebound_rolling",
    "probability_captured_sliding",
    "probability_captured_rolling",
    "probability_error",
    "probability_by",
    "class",
];

/// The classes in the order of their columns. A captured sphere that rests counts as rolling.
const CLASSES: [Class; 4] =
    [Class::ReboundSliding, Class::ReboundRolling, Class::CapturedSliding, Class::CapturedRolling];

/// Largest relative standard error for which the accuracy of the expansion is known, and that accuracy.
const LARGEST_ERROR: f64 = 0.1;
const ACCURACY: f64 = 0.01;

/// Distance of a bound, in standard errors, that no number reaches.
const FAR: f64 = 6.0;

/// Standard errors of a fraction of random rows that are stated as its error.
const DEVIATIONS: f64 = 3.0;

/// The model that classifies.
pub enum Kind {
    RigidBody,
    Simulation,
}

impl Kind {
    /// The columns of the standard errors that the model reads.
    pub fn inputs(&self) -> [Input; 2] {
        match self {
            Self::RigidBody => [SHARED_INPUT, RIGID_BODY_INPUT],
            Self::Simulation => [SHARED_INPUT, SIMULATION_INPUT],
        }
    }

    fn quantities(&self) -> impl Iterator<Item = &'static Quantity> {
        let own: &[Quantity] = match self {
            Self::RigidBody => &RIGID_BODY,
            Self::Simulation => &SIMULATION,
        };
        SHARED.iter().chain(own)
    }

    /// Whether a table has a column of standard errors.
    fn is_given(&self, header: &Header<'_>) -> bool {
        self.quantities().any(|quantity| header.has(quantity.error))
    }

    /// The columns that a table gets: none without a column of standard errors.
    pub fn columns(&self, header: &Header<'_>) -> impl Iterator<Item = String> {
        let given = self.is_given(header);
        COLUMNS.iter().filter(move |_| given).map(|column| (*column).to_owned())
    }
}

/// A number with its standard error.
struct Deviating {
    column: &'static str,
    parameter: Parameter,
    value: f64,
    error: f64,
}

impl Deviating {
    /// Whether the expansion is known to be accurate for this error.
    fn is_small(&self) -> bool {
        let (smallest, largest) = self.parameter.range();
        // A velocity or a force may have either sign; slip is linear in them.
        let of_one_sign = smallest >= 0.0;
        let near = |bound: f64| (bound - self.value).abs() < FAR * self.error;
        let is_large = of_one_sign && self.error > LARGEST_ERROR * self.value;
        !(is_large || near(smallest) || near(largest))
    }

    /// A random value; beyond its range, the nearest value of the range.
    fn drawn(&self, random: &mut StdRng) -> f64 {
        let deviation: f64 = StandardNormal.sample(random);
        let (smallest, largest) = self.parameter.range();
        (self.value + self.error * deviation).clamp(smallest, largest)
    }
}

/// The numbers of a row that have standard errors.
pub struct Deviations<'a, 'b> {
    row: &'a Row<'b>,
    numbers: Vec<Deviating>,
}

/// The numbers of a row that have standard errors, so many that the library takes them at once.
pub type Inputs<T> = [Uncertain<T>; MOST];

/// Values of these numbers.
pub type Values<T> = [T; MOST];

/// The probabilities of the classes of a row.
pub struct Probabilities {
    classes: [f64; 4],
    /// Largest error of the probabilities.
    error: f64,
    by: &'static str,
}

impl<'a, 'b> Deviations<'a, 'b> {
    /// The standard errors of a row; `None` if it has none.
    pub fn read<T: Number>(row: &'a Row<'b>, kind: &Kind) -> Result<Option<Self>, String> {
        if !kind.is_given(&row.header()) {
            return Ok(None);
        }
        let mut numbers = Vec::new();
        for Quantity { column, error: name, parameter, is_zero_if_empty } in kind.quantities() {
            let Some(error) = row.number::<T>(name)? else { continue };
            let error: f64 = Parameter::StandardError.check(error).map_err(|error| format!("{name}: {error}"))?.into();
            let value: Option<T> = row.number(column)?;
            let value = match value {
                Some(value) => value.into(),
                None if *is_zero_if_empty => 0.0,
                None => return Err(format!("{name}: {column} is empty; give it too or leave the cell empty")),
            };
            if error > 0.0 {
                numbers.push(Deviating { column, parameter: *parameter, value, error });
            }
        }
        let given = kind.quantities().any(|quantity| row.has(quantity.error));
        Ok(given.then_some(Self { row, numbers }))
    }

    /// The row with other numbers.
    fn with<T: Number>(&self, values: impl Iterator<Item = T>) -> Row<'b> {
        self.row.with_all(self.numbers.iter().map(|number| number.column).zip(values))
    }

    /// Whether the expansion is known to be accurate.
    pub fn are_small(&self) -> bool {
        self.numbers.iter().all(Deviating::is_small)
    }

    /// The probabilities by the expansion of the library; `expand` calls it.
    pub fn expanded<T: Number>(
        &self,
        expand: impl FnOnce(&Inputs<T>, &dyn Fn(Values<T>) -> Row<'b>) -> Result<ClassProbabilities<T>, String>,
    ) -> Result<Probabilities, String> {
        let none = Uncertain::new(T::ZERO, T::ZERO).map_err(|error| self.row.reason(error))?;
        let mut inputs = [none; MOST];
        for (input, number) in inputs.iter_mut().zip(&self.numbers) {
            let uncertain = Uncertain::new(T::constant(number.value), T::constant(number.error));
            let within = uncertain.and_then(|uncertain| uncertain.within(number.parameter));
            *input = within.map_err(|error| self.row.reason(error))?;
        }
        let found = expand(&inputs, &|values| self.with(values.into_iter()))?;
        let classes = CLASSES.map(|class| found.of(class).into());
        Ok(Probabilities { classes, error: ACCURACY, by: "expansion" })
    }

    /// The fractions of the classes of random rows.
    pub fn drawn<T: Number>(
        &self,
        draws: u32,
        class: impl Fn(&Row<'_>) -> Result<Class, String>,
    ) -> Result<Probabilities, String> {
        let mut random = StdRng::seed_from_u64(1);
        let mut counts = [0_u32; 4];
        for _ in 0..draws {
            let row = self.with(self.numbers.iter().map(|number| T::constant(number.drawn(&mut random))));
            let refused =
                |reason| format!("with random numbers of these standard errors: {reason}; check the standard errors");
            let class = moving(class(&row).map_err(refused)?);
            let Some(index) = CLASSES.iter().position(|other| *other == class) else {
                return Err("the class of a random row is undecided; use --method adaptive".into());
            };
            counts[index] += 1;
        }
        let draws = f64::from(draws);
        let classes = counts.map(|count| f64::from(count) / draws);
        let error = classes.map(|p| DEVIATIONS * (p * (1.0 - p)).max(1.0 / draws).sqrt() / draws.sqrt());
        Ok(Probabilities { classes, error: error.into_iter().fold(0.0, f64::max), by: "random rows" })
    }
}

impl Probabilities {
    /// The most probable class, if it has at least this probability.
    pub fn class(&self, level: f64) -> String {
        let best = self.best();
        if best.1 >= level { best.0.to_string() } else { CANNOT_TELL.into() }
    }

    /// The class in words, with its probability.
    pub fn in_words(&self, level: f64) -> String {
        let (class, probability) = self.best();
        if probability >= level {
            format!("{class} ({probability:.2})")
        } else {
            format!("{CANNOT_TELL} ({class} {probability:.2})")
        }
    }

    fn best(&self) -> (Class, f64) {
        let pairs = CLASSES.into_iter().zip(self.classes);
        pairs.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((Class::Undecided, 0.0))
    }

    /// The cells of the computed columns.
    pub fn cells(&self, level: f64) -> Vec<Value> {
        let [rebound_sliding, rebound_rolling, captured_sliding, captured_rolling] = self.classes;
        let numbers = [
            captured_sliding + captured_rolling,
            rebound_sliding + captured_sliding,
            rebound_rolling + captured_rolling,
            rebound_sliding,
            rebound_rolling,
            captured_sliding,
            captured_rolling,
            self.error,
        ];
        let cells = numbers.into_iter().map(Scalar::value);
        cells.chain([self.by.into(), self.class(level).into()]).collect()
    }
}

/// Reports a reason in words through a function that returns an error of the library.
pub struct Reason(std::cell::RefCell<Option<String>>);

impl Reason {
    pub fn new() -> Self {
        Self(std::cell::RefCell::new(None))
    }

    /// Keeps the first reason; the error takes its place.
    pub fn keep<V>(&self, result: Result<V, String>) -> Result<V, InputError> {
        result.map_err(|reason| {
            self.0.borrow_mut().get_or_insert(reason);
            InputError { parameter: Parameter::StandardError, fault: Fault::NotFinite, value: f32::NAN }
        })
    }

    /// The reason that was kept, or what the library says itself.
    pub fn of(self, row: &Row<'_>, error: InputError) -> String {
        self.0.into_inner().unwrap_or_else(|| row.reason(error))
    }
}
