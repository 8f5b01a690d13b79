//! What the library refuses, in terms of the table: the column, and the text of the cell.

use microimpact::{Fault, ImpactError, Parameter};

use crate::Row;
use crate::catalogue::{COLUMNS, Range};

/// Larger diameters are not taken for micrometres.
const MOST_MICROMETRES: f64 = 1e4;

/// The columns that can give a parameter.
fn columns(parameter: Parameter) -> Vec<&'static str> {
    let parameter = match parameter {
        Parameter::PeripheralVelocity => Parameter::Spin,
        parameter => parameter,
    };
    let by_range = COLUMNS.iter().filter(|column| column.range == Range::Of(parameter)).map(|column| column.name);
    let others: &[&str] = match parameter {
        Parameter::Radius => &["diameter_m"],
        Parameter::DampingRatio => &["stiffness_pa", "zeta_h", "zeta_a", "damping_value", "speed_normal_m_s"],
        Parameter::AdhesionRatio => &["stiffness_pa", "adhesion_n_m", "work_of_adhesion_j_m2", "speed_normal_m_s"],
        Parameter::ForceRatio => &["stiffness_pa", "external_force_n", "speed_normal_m_s"],
        Parameter::MaterialDamping | Parameter::RelaxationTime | Parameter::NominalRestitution => &["damping_value"],
        _ => &[],
    };
    by_range.chain(others.iter().copied()).collect()
}

impl Row<'_> {
    /// Why the library refuses this row. The text quotes the cell: the error holds its number only as f32, where 1e300 is
    /// infinite.
    pub fn reason(&self, error: impl Into<ImpactError>) -> String {
        let error = error.into();
        let message = error.to_string();
        let ImpactError::Input(input) = error else {
            return message;
        };
        // Of a vector no component is wrong by itself.
        if input.parameter == Parameter::NormalLength {
            return format!("{}: {message}", columns(input.parameter).join(", "));
        }
        // They are wrong only together.
        if matches!(input.parameter, Parameter::DampingRatio | Parameter::AdhesionRatio | Parameter::ForceRatio) {
            let given: Vec<_> = columns(input.parameter).into_iter().filter(|column| self.has(column)).collect();
            return format!("{}: {message}", given.join(", "));
        }
        if input.fault == Fault::Receding {
            let velocity = columns(Parameter::VelocityComponent).into_iter();
            let given: Vec<_> = velocity.filter(|column| self.has(column)).collect();
            let given = if given.is_empty() { columns(input.parameter) } else { given };
            return format!("{}: {message}", given.join(", "));
        }
        let read = |column: &&str| self.frame.inputs.iter().any(|input| input.columns().contains(column));
        let given = columns(input.parameter).into_iter().filter(read).filter_map(|column| {
            let number = self.number::<f64>(column).ok()??;
            Some((number, column, self.text(column)?.into_owned()))
        });
        // A range that two columns share is symmetric, so that the larger number is the one outside it.
        let largest = given.max_by(|(a, ..), (b, ..)| a.abs().total_cmp(&b.abs()));
        let (Some((number, column, text)), Some((_, demand))) = (largest, message.split_once(", but must ")) else {
            return message;
        };
        let (name, header) = (input.parameter.name(), self.name_in_header(column));
        let range = demand.split_once(';').map_or(demand, |(range, _)| range);
        let unit = input.parameter.unit();
        let in_si = if header == column || unit == "1" { String::new() } else { format!(" ({number:?} {unit})") };
        // The library speaks of the radius.
        if column == "diameter_m" {
            let (smallest, largest) = input.parameter.range();
            let refused = format!(
                "{header}: \"{text}\"{in_si} is refused: diameter must be {:e} to {} m",
                2.0 * smallest,
                2.0 * largest
            );
            let is_micrometres = header == column && (2.0 * largest..MOST_MICROMETRES).contains(&number);
            return refused + &if is_micrometres { format!("; enter {text} um as {number}e-6") } else { String::new() };
        }
        // The remedy has the number of the library, in its own unit.
        if header != column {
            let turned = text.strip_prefix('-').filter(|_| input.parameter == Parameter::ApproachSpeed);
            let remedy = turned.map_or_else(String::new, |turned| format!("; enter {text} as {turned}"));
            return format!("{header}: \"{text}\"{in_si} is refused: {name} must {range}{remedy}");
        }
        format!("{column}: \"{text}\" is refused: {name} must {demand}")
    }
}
