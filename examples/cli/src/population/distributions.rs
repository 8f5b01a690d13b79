//! The distributions that a row, or a file of samples, states.

use std::path::Path;
use std::slice::from_ref;

use population::{DIAMETERS, Distribution, DistributionError};
use sheet::{Input, Row, Sheet};

use super::Model;
use crate::command::open;

/// A quantity of a population and its columns.
pub(super) struct Quantity {
    ways: &'static [Way],
    /// Values, medians and means.
    columns: &'static [&'static str],
    /// Their deviations.
    deviations: &'static [&'static str],
    /// What is used if no column gives it; `None` if it is required.
    default: Option<&'static str>,
}

/// A way to give a quantity.
struct Way {
    /// Column of the value, median or mean.
    column: &'static str,
    form: Form,
    /// The quantity over the number in the column.
    factor: f64,
}

/// The form of a distribution.
#[derive(Clone, Copy)]
enum Form {
    /// One value, or samples.
    Value,
    /// Median, and geometric standard deviation in this column.
    LogNormal(&'static str),
    /// Mean, and standard deviation in this column.
    Normal(&'static str),
}

impl Form {
    fn deviation(self) -> Option<&'static str> {
        match self {
            Self::Value => None,
            Self::LogNormal(column) | Self::Normal(column) => Some(column),
        }
    }
}

/// A quantity with a default, by the words of its columns before and after the unit, each with the quantity over its number.
macro_rules! quantity {
    ($default:expr, $($base:literal $unit:literal $factor:literal),+) => {
        Quantity {
            ways: &[$(
                Way { column: concat!($base, $unit), form: Form::Value, factor: $factor },
                Way {
                    column: concat!($base, "_median", $unit),
                    form: Form::LogNormal(concat!($base, "_geometric_deviation")),
                    factor: $factor,
                },
                Way {
                    column: concat!($base, "_mean", $unit),
                    form: Form::Normal(concat!($base, "_deviation", $unit)),
                    factor: $factor,
                },
            )+],
            columns: &[$(concat!($base, $unit), concat!($base, "_median", $unit), concat!($base, "_mean", $unit)),+],
            deviations: &[$(concat!($base, "_geometric_deviation"), concat!($base, "_deviation", $unit)),+],
            default: $default,
        }
    };
}

pub(super) static DIAMETER: Quantity = quantity!(None, "diameter" "_m" 1.0, "radius" "_m" 2.0);
pub(super) static SPEED: Quantity = quantity!(None, "speed" "_m_s" 1.0);
/// An angle may be zero, so that it has no log-normal distribution.
pub(super) static ANGLE: Quantity = Quantity {
    ways: &[
        Way { column: "angle_deg", form: Form::Value, factor: 1.0 },
        Way { column: "angle_mean_deg", form: Form::Normal("angle_deviation_deg"), factor: 1.0 },
    ],
    columns: &["angle_deg", "angle_mean_deg"],
    deviations: &["angle_deviation_deg"],
    default: Some("0 degrees"),
};
pub(super) static RING: Quantity = quantity!(Some("0 N/m"), "adhesion" "_n_m" 1.0);
/// The geometric deviations of both works have the same name, and only one of the works is read.
pub(super) static WORK_PER_AREA: Quantity =
    quantity!(Some("none; dmt and jkr need it"), "work_of_adhesion" "_j_m2" 1.0);
pub(super) static WORK: Quantity = quantity!(Some("no adhesion"), "work_of_adhesion" "_j" 1.0);

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
            _ if !samples.of(quantity).is_empty() => Input::optional(quantity.columns, "the samples"),
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
        let filled: Vec<_> = self.ways.iter().filter(|way| row.has(way.column)).collect();
        let sampled = samples.of(self);
        if filled.len() + sampled.len() > 1 {
            let ways = filled.iter().map(|way| way.column.to_owned());
            let ways: Vec<_> = ways.chain(sampled.iter().map(|(way, _)| format!("--samples {}", way.column))).collect();
            return Err(format!("{}: given twice, by {}; keep one of them", self.column(), ways.join(" and ")));
        }
        let refused = |way: &'static Way| move |error: DistributionError| reason(row, way, error);
        let scaled = |distribution: Distribution, way: &'static Way| {
            let range = DIAMETERS.map(|diameter| diameter / way.factor);
            let checked = if self.is_size() { distribution.lengths_within(range) } else { Ok(distribution) };
            checked.map(|valid| valid.scaled(way.factor)).map_err(refused(way))
        };
        let (distribution, deviation) = if let [(way, values)] = sampled[..] {
            (scaled(self.of_samples(values.clone()).map_err(refused(way))?, way)?, None)
        } else if let [way] = filled[..] {
            let number = row.required(way.column)?;
            let distribution = match way.form {
                Form::Normal(column) if self.is_angle() => {
                    Distribution::normal_from(number, row.required(column)?, 0.0)
                }
                Form::Normal(column) => Distribution::normal(number, row.required(column)?),
                Form::LogNormal(column) => Distribution::log_normal(number, row.required(column)?),
                // A quantity that is required is positive; the model checks adhesion, which may be zero.
                Form::Value if self.default.is_none() => Distribution::samples(vec![number]),
                Form::Value => Distribution::fixed(number),
            };
            (scaled(distribution.map_err(refused(way))?, way)?, way.form.deviation())
        } else {
            return Ok(None);
        };
        match self.deviations.iter().find(|other| Some(**other) != deviation && row.has(other)) {
            Some(other) => Err(format!("{other}: it goes with another way to give the quantity; leave the cell empty")),
            None => Ok(Some(distribution)),
        }
    }

    /// The distribution that a row must state.
    pub(super) fn required(&self, row: &Row<'_>, samples: &SampleFiles) -> Result<Distribution, String> {
        self.read(row, samples)?.ok_or_else(|| format!("{}: missing; enter a number", self.columns.join(" or ")))
    }

    fn is_angle(&self) -> bool {
        self.column() == ANGLE.column()
    }

    fn is_size(&self) -> bool {
        self.column() == DIAMETER.column()
    }

    fn of_samples(&self, values: Vec<f64>) -> Result<Distribution, DistributionError> {
        if self.is_angle() { Distribution::samples_of_any_sign(values) } else { Distribution::samples(values) }
    }

    /// The column of one value in the unit of the quantity.
    pub(super) fn column(&self) -> &'static str {
        self.ways[0].column
    }

    /// The ways that one value, or samples, may give.
    fn values(&self) -> impl Iterator<Item = &'static Way> {
        self.ways.iter().filter(|way| matches!(way.form, Form::Value))
    }
}

/// What is wrong with a distribution, after the name of its column in the header.
fn reason(row: &Row<'_>, way: &Way, error: DistributionError) -> String {
    let of_deviation =
        matches!(error, DistributionError::NegativeDeviation(_) | DistributionError::GeometricBelowOne(_));
    let column = way.form.deviation().filter(|_| of_deviation).unwrap_or(way.column);
    let (name, message) = (row.name_in_header(column), error.to_string());
    // The remedy is one for metres.
    let message = if name == column { &message } else { message.split(';').next().unwrap_or_default() };
    format!("{name}: {message}")
}

/// The angles of a row, rad.
pub(super) fn angles(row: &Row<'_>, samples: &SampleFiles) -> Result<Distribution, String> {
    let column = ANGLE.column();
    let degrees = match ANGLE.read(row, samples)? {
        Some(distribution) => distribution,
        None => Distribution::fixed(0.0).map_err(|error| error.to_string())?,
    };
    degrees.incidence().map_err(|error| format!("{column}: {error}"))
}

/// Samples of quantities, by the names of their columns.
pub(super) struct SampleFiles(Vec<(&'static str, Vec<f64>)>);

impl SampleFiles {
    /// No samples.
    pub(super) fn none() -> Self {
        Self(Vec::new())
    }

    /// Reads the files of options `NAME=FILE`.
    pub(super) fn read(options: &[String], model: Model) -> Result<Self, String> {
        let mut files: Vec<(&'static str, Vec<f64>)> = Vec::new();
        for option in options {
            let columns =
                || quantities(model).iter().flat_map(|quantity| quantity.values().map(move |way| (*quantity, way)));
            let known = || columns().map(|(_, way)| way.column).collect::<Vec<_>>().join(", ");
            let Some((name, path)) = option.split_once('=') else {
                return Err(format!("--samples: \"{option}\" is refused: enter NAME=FILE, NAME one of {}", known()));
            };
            let Some((quantity, way)) = columns().find(|(_, way)| way.column == name) else {
                return Err(format!("--samples: {name} has no distribution; choose one of {}", known()));
            };
            if files.iter().any(|(other, _)| *other == name) {
                return Err(format!("--samples: {name} is given twice; keep one of the files"));
            }
            files.push((way.column, values(quantity, way, Path::new(path))?));
        }
        Ok(Self(files))
    }

    /// The samples of a quantity, each with the way that they are of: in a table that can be computed one at most.
    fn of(&self, quantity: &Quantity) -> Vec<(&'static Way, &Vec<f64>)> {
        let of_way =
            |way: &'static Way| self.0.iter().find(|(name, _)| *name == way.column).map(|(_, values)| (way, values));
        quantity.values().filter_map(of_way).collect()
    }
}

/// The samples in a file.
fn values(quantity: &Quantity, way: &'static Way, path: &Path) -> Result<Vec<f64>, String> {
    let name = |reason: String| format!("{}: {reason}", path.display());
    let inputs = [Input::required(from_ref(&way.column))];
    let mut sheet = Sheet::open(open(path)?, &inputs, None).map_err(name)?;
    let mut values = Vec::new();
    while let Some(row) = sheet.next_row().map_err(name)? {
        let value = row.check().and_then(|()| row.required::<f64>(way.column));
        values.push(value.map_err(|reason| name(format!("row {}: {reason}", row.index())))?);
    }
    // What is wrong with a sample is known before a population is computed.
    quantity.of_samples(values.clone()).map_err(|error| name(format!("{}: {error}", way.column)))?;
    Ok(values)
}
