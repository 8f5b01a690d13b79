//! The distributions that a row, or a file of samples, states.

use std::path::Path;

use population::{Distribution, DistributionError};
use sheet::{Input, Row, Sheet};

use super::Model;
use crate::command::open;

/// A quantity of a population and its columns.
pub(super) struct Quantity {
    /// One value, or samples.
    value: &'static str,
    /// Median and geometric standard deviation; an angle may be zero, so that it has none.
    log_normal: Option<[&'static str; 2]>,
    /// Mean and standard deviation.
    normal: [&'static str; 2],
    /// Value, median and mean.
    columns: &'static [&'static str],
    /// Both deviations.
    deviations: &'static [&'static str],
    /// What is used if no column gives it; `None` if it is required.
    default: Option<&'static str>,
}

/// A quantity by the words before and after its unit.
macro_rules! quantity {
    ($base:literal, $unit:literal, $default:expr) => {
        Quantity {
            value: concat!($base, $unit),
            log_normal: Some([concat!($base, "_median", $unit), concat!($base, "_geometric_deviation")]),
            normal: [concat!($base, "_mean", $unit), concat!($base, "_deviation", $unit)],
            columns: &[concat!($base, $unit), concat!($base, "_median", $unit), concat!($base, "_mean", $unit)],
            deviations: &[concat!($base, "_geometric_deviation"), concat!($base, "_deviation", $unit)],
            default: $default,
        }
    };
}

pub(super) static DIAMETER: Quantity = quantity!("diameter", "_m", None);
pub(super) static SPEED: Quantity = quantity!("speed", "_m_s", None);
pub(super) static ANGLE: Quantity = Quantity {
    value: "angle_deg",
    log_normal: None,
    normal: ["angle_mean_deg", "angle_deviation_deg"],
    columns: &["angle_deg", "angle_mean_deg"],
    deviations: &["angle_deviation_deg"],
    default: Some("0 degrees"),
};
pub(super) static RING: Quantity = quantity!("adhesion", "_n_m", Some("0 N/m"));
/// The geometric deviations of both works have the same name, and only one of the works is read.
pub(super) static WORK_PER_AREA: Quantity = quantity!("work_of_adhesion", "_j_m2", Some("none; dmt and jkr need it"));
pub(super) static WORK: Quantity = quantity!("work_of_adhesion", "_j", Some("no adhesion"));

/// The quantities of a model.
fn quantities(model: Model) -> &'static [&'static Quantity] {
    static SIMULATION: [&Quantity; 5] = [&DIAMETER, &SPEED, &ANGLE, &RING, &WORK_PER_AREA];
    static RIGID_BODY: [&Quantity; 4] = [&DIAMETER, &SPEED, &ANGLE, &WORK];
    match model {
        Model::Simulation => &SIMULATION,
        Model::RigidBody => &RIGID_BODY,
    }
}

/// The columns that give the distributions.
pub(super) fn inputs(model: Model, samples: &SampleFiles) -> Vec<Input> {
    let inputs = quantities(model).iter().flat_map(|quantity| {
        let values = match quantity.default {
            _ if samples.of(quantity).is_some() => Input::optional(quantity.columns, "the samples"),
            Some(default) => Input::optional(quantity.columns, default),
            None => Input::required(quantity.columns),
        };
        [values, Input::further(quantity.deviations)]
    });
    inputs.collect()
}

impl Quantity {
    /// The distribution that a row or the samples state; `None` if neither does.
    pub(super) fn read(&self, row: &Row<'_>, samples: &SampleFiles) -> Result<Option<Distribution>, String> {
        let filled: Vec<_> = self.columns.iter().filter(|column| row.has(column)).collect();
        let sampled = samples.of(self);
        if filled.len() + usize::from(sampled.is_some()) > 1 {
            let mut ways: Vec<_> = filled.iter().map(|column| (**column).to_owned()).collect();
            ways.extend(sampled.map(|_| format!("--samples {}", self.value)));
            return Err(format!("{}: given twice, by {}; keep one of them", self.value, ways.join(" and ")));
        }
        let refused = |column: &'static str| move |error: DistributionError| format!("{column}: {error}");
        let (distribution, deviation) = if let Some(values) = sampled {
            (Some(self.of_samples(values.clone()).map_err(refused(self.value))?), None)
        } else {
            match filled.first() {
                None => (None, None),
                Some(column) if **column == self.normal[0] => {
                    let [mean, deviation] = self.normal;
                    let numbers = (row.required(mean)?, row.required(deviation)?);
                    let normal = if self.is_angle() {
                        Distribution::normal_from(numbers.0, numbers.1, 0.0)
                    } else {
                        Distribution::normal(numbers.0, numbers.1)
                    };
                    (Some(normal.map_err(refused(mean))?), Some(deviation))
                }
                Some(column) if **column == self.value => {
                    let value = row.required(self.value)?;
                    // A quantity that is required is positive; the model checks adhesion, which may be zero.
                    let one = match self.default {
                        None => Distribution::samples(vec![value]),
                        Some(_) => Distribution::fixed(value),
                    };
                    (Some(one.map_err(refused(self.value))?), None)
                }
                Some(_) => {
                    let Some([median, deviation]) = self.log_normal else { return Ok(None) };
                    let numbers = (row.required(median)?, row.required(deviation)?);
                    let log_normal = Distribution::log_normal(numbers.0, numbers.1);
                    (Some(log_normal.map_err(refused(median))?), Some(deviation))
                }
            }
        };
        for other in self.deviations.iter().filter(|other| Some(**other) != deviation && distribution.is_some()) {
            if row.has(other) {
                return Err(format!("{other}: it goes with another way to give the quantity; leave the cell empty"));
            }
        }
        Ok(distribution)
    }

    /// The distribution that a row must state.
    pub(super) fn required(&self, row: &Row<'_>, samples: &SampleFiles) -> Result<Distribution, String> {
        self.read(row, samples)?.ok_or_else(|| format!("{}: missing; enter a number", self.columns.join(" or ")))
    }

    fn is_angle(&self) -> bool {
        self.value == ANGLE.value
    }

    fn of_samples(&self, values: Vec<f64>) -> Result<Distribution, DistributionError> {
        if self.is_angle() { Distribution::samples_of_any_sign(values) } else { Distribution::samples(values) }
    }

    /// The column of one value.
    pub(super) fn column(&self) -> &'static str {
        self.value
    }
}

/// The angles of a row, rad.
pub(super) fn angles(row: &Row<'_>, samples: &SampleFiles) -> Result<Distribution, String> {
    let column = ANGLE.value;
    let degrees = match ANGLE.read(row, samples)? {
        Some(distribution) => distribution,
        None => Distribution::fixed(0.0).map_err(|error| error.to_string())?,
    };
    degrees.incidence().map_err(|error| format!("{column}: {error}"))
}

/// Samples of quantities, by the names of their columns.
pub(super) struct SampleFiles(Vec<(String, Vec<f64>)>);

impl SampleFiles {
    /// No samples.
    pub(super) fn none() -> Self {
        Self(Vec::new())
    }

    /// Reads the files of options `NAME=FILE`.
    pub(super) fn read(options: &[String], model: Model) -> Result<Self, String> {
        let mut files: Vec<(String, Vec<f64>)> = Vec::new();
        for option in options {
            let known = || quantities(model).iter().map(|quantity| quantity.value).collect::<Vec<_>>().join(", ");
            let Some((name, path)) = option.split_once('=') else {
                return Err(format!("--samples: \"{option}\" is refused: enter NAME=FILE, NAME one of {}", known()));
            };
            let Some(quantity) = quantities(model).iter().find(|quantity| quantity.value == name) else {
                return Err(format!("--samples: {name} has no distribution; choose one of {}", known()));
            };
            if files.iter().any(|(other, _)| other == name) {
                return Err(format!("--samples: {name} is given twice; keep one of the files"));
            }
            files.push((name.into(), values(quantity, Path::new(path))?));
        }
        Ok(Self(files))
    }

    fn of(&self, quantity: &Quantity) -> Option<&Vec<f64>> {
        self.0.iter().find(|(name, _)| name == quantity.value).map(|(_, values)| values)
    }
}

/// The samples in a file.
fn values(quantity: &Quantity, path: &Path) -> Result<Vec<f64>, String> {
    let name = |reason: String| format!("{}: {reason}", path.display());
    let inputs = [Input::required(&quantity.columns[..1])];
    let mut sheet = Sheet::open(open(path)?, &inputs, None).map_err(name)?;
    let mut values = Vec::new();
    while let Some(row) = sheet.next_row().map_err(name)? {
        let value = row.check().and_then(|()| row.required::<f64>(quantity.value));
        values.push(value.map_err(|reason| name(format!("row {}: {reason}", row.index())))?);
    }
    // What is wrong with a sample is known before a population is computed.
    quantity.of_samples(values.clone()).map_err(|error| name(format!("{}: {error}", quantity.value)))?;
    Ok(values)
}
