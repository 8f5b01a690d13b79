//! What the library refuses, in terms of the table: the column, and the text of the cell.

use microimpact::{Fault, ImpactError, Parameter};

use crate::Row;
use crate::catalogue::{COLUMNS, Range};

/// The columns that can give a parameter.
fn columns(parameter: Parameter) -> Vec<&'static str> {
    let parameter = match parameter {
        Parameter::PeripheralVelocity => Parameter::Spin,
        parameter => parameter,
    };
    let by_range = COLUMNS.iter().filter(|column| column.range == Range::Of(parameter)).map(|column| column.name);
    let others: &[&str] = match parameter {
        Parameter::Radius => &["diameter_m"],
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
        if input.fault == Fault::Receding {
            let velocity = columns(Parameter::VelocityComponent).into_iter();
            let given: Vec<_> = velocity.filter(|column| self.has(column)).collect();
            let given = if given.is_empty() { columns(input.parameter) } else { given };
            return format!("{}: {message}", given.join(", "));
        }
        let read = |column: &&str| self.frame.inputs.iter().any(|input| input.columns().contains(column));
        let given = columns(input.parameter).into_iter().filter(read).filter_map(|column| {
            let number = self.number::<f64>(column).ok()??;
            Some((number.abs(), column, self.text(column)?.into_owned()))
        });
        // A range that two columns share is symmetric, so that the larger number is the one outside it.
        let largest = given.max_by(|(a, ..), (b, ..)| a.total_cmp(b));
        let (Some((_, column, text)), Some((_, demand))) = (largest, message.split_once(", but must ")) else {
            return message;
        };
        let (name, header) = (input.parameter.name(), self.name_in_header(column));
        let range = demand.split_once(';').map_or(demand, |(range, _)| range);
        // The remedy has the number of the library, which is that of the radius, and in its own unit.
        if column == "diameter_m" {
            return format!("{header}: \"{text}\" is refused: half of it, the {name}, must {range}");
        }
        if header != column {
            let turned = text.strip_prefix('-').filter(|_| input.parameter == Parameter::ApproachSpeed);
            let remedy = turned.map_or_else(String::new, |turned| format!("; enter {text} as {turned}"));
            return format!("{header}: \"{text}\" is refused: {name} must {range}{remedy}");
        }
        format!("{column}: \"{text}\" is refused: {name} must {demand}")
    }
}
