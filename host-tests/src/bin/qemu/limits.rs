//! What the library promises, checked in every run.

use crate::boards::REFERENCE_CORE;
use crate::figures::{Figure, Quantity, Subject};

/// The scalar for which the promises hold.
pub(crate) const SCALAR: &str = "f32";

/// The largest figure of its kind in a scene.
pub(crate) struct Checked {
    pub(crate) subject: Subject,
    pub(crate) value: u32,
}

/// Whether contact is simulated in a scene.
pub(crate) fn is_simulated(scene: &str) -> bool {
    scene.starts_with("simulation/")
}

/// The limit that a quantity must keep on the reference core.
pub(crate) fn of(scene: &str, quantity: Quantity) -> Option<u32> {
    match quantity {
        Quantity::Classify if scene == "simulation/fixed-1e-5" => Some(2000),
        _ if is_simulated(scene) => None,
        Quantity::Classify => Some(150),
        Quantity::SetUpAndClassify => None,
        Quantity::Flash => Some(1024),
        Quantity::StaticMemory => Some(0),
        Quantity::Stack => Some(256),
    }
}

/// The promised figures: the worst of each scene and quantity.
pub(crate) fn check(figures: &[Figure]) -> Vec<Checked> {
    let mut checked: Vec<Checked> = Vec::new();
    for Figure { subject, value } in figures {
        if subject.core != REFERENCE_CORE || subject.scalar != SCALAR {
            continue;
        }
        let same =
            |other: &&mut Checked| other.subject.scene == subject.scene && other.subject.quantity == subject.quantity;
        match checked.iter_mut().find(same) {
            Some(known) if known.value >= *value => {}
            Some(known) => (known.subject, known.value) = (subject.clone(), *value),
            None => checked.push(Checked { subject: subject.clone(), value: *value }),
        }
    }
    checked
}

/// Every broken promise.
pub(crate) fn broken(checked: &[Checked]) -> Vec<String> {
    let mut broken = Vec::new();
    for Checked { subject, value } in checked {
        if let Some(limit) = of(&subject.scene, subject.quantity)
            && *value > limit
        {
            let unit = subject.quantity.unit();
            broken.push(format!("{subject}: {value} {unit}; the promise is at most {limit}"));
        }
    }
    broken
}
