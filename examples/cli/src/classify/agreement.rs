//! Where the two models give different classes, and why.

use microimpact::Outcome;
use sheet::Row;

use super::contact::Simulated;
use super::rigid_body::Classified;
use crate::command::Number;
use crate::words::moving;

/// The columns that are computed.
pub const COLUMNS: [&str; 2] = ["models_agree", "models_differ_because"];

/// Columns of terms along the surface that one model has and the other lacks.
const OF_ONE_MODEL: [&str; 4] = ["impulse_ratio", "rolling_arm_m", "peeling_n_m", "stiffness_ratio"];

/// Why the models give different classes of a row; `None` if they agree.
pub fn difference<T: Number>(row: &Row<'_>, simulated: &Simulated<T>, body: &Classified<T>) -> Option<String> {
    if moving(simulated.class) == moving(body.class()) {
        return None;
    }
    if simulated.outcome == Outcome::Undecided {
        return Some("the method of the simulation does not decide; use --method adaptive".into());
    }
    if simulated.outcome != body.classification.outcome {
        return Some(outcomes(simulated, body));
    }
    let own = OF_ONE_MODEL.into_iter().find(|column| row.or_zero::<T>(column).is_ok_and(|value| value != T::ZERO));
    if let Some(column) = own {
        return Some(format!("only one of the models has the term {column}, which acts along the surface"));
    }
    Some(motions(simulated, body))
}

/// Why one model captures a sphere that rebounds in the other.
fn outcomes<T: Number>(simulated: &Simulated<T>, body: &Classified<T>) -> String {
    let body_says = match body.classification.speed_over_critical {
        Some(ratio) => format!("the speed is {ratio:.3} of the critical speed of the rigid body"),
        None => "the rigid body has no critical speed".into(),
    };
    let simulation_says = match simulated.restitution() {
        Some(e) if simulated.outcome == Outcome::Rebound => format!("the simulation has e = {e:.3}"),
        _ => "the simulated sphere has too little energy to leave".into(),
    };
    format!(
        "{body_says}, but {simulation_says}: restitution and adhesion of the rigid body do not match stiffness, damping and \
         adhesion of the simulation; trust the model whose numbers were measured"
    )
}

/// Why the contact point slides in one model only.
fn motions<T: Number>(simulated: &Simulated<T>, body: &Classified<T>) -> String {
    if simulated.outcome == Outcome::Capture {
        return "friction stops the slip of a captured sphere in the simulation, where the surface goes on to press on it; in \
                the rigid body friction ends with the impact"
            .into();
    }
    let over = |limit: Option<T>| limit.map_or_else(|| "more than enough".into(), |over| format!("{over:.3}"));
    format!(
        "friction over what stops the slip is {} in the simulation, where it is proportional to the elastic force alone, and \
         {} in the rigid body, where it is proportional to the whole normal impulse",
        over(simulated.friction_over_limit()),
        over(body.classification.contact.friction_over_limit)
    )
}
