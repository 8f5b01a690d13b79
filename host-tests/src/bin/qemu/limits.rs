//! What the library promises, checked in every run.

use host_tests::boards::REFERENCE_CORE;
use host_tests::boards::figures::{Figure, Quantity, Subject};

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

/// Whether a scene is built for flash rather than speed.
pub(crate) fn is_small(scene: &str) -> bool {
    scene.starts_with("small/")
}

/// Whether a scene is read from a table.
pub(crate) fn is_table(scene: &str) -> bool {
    scene.starts_with("table/")
}

/// The limit that a quantity must keep on the reference core.
pub(crate) fn of(scene: &str, quantity: Quantity) -> Option<u32> {
    match quantity {
        Quantity::Classify if scene == "simulation/fixed-class" => Some(1600),
        Quantity::Classify if scene == "simulation/fixed-1e-5" => Some(2000),
        Quantity::Classify if scene == "simulation/fixed-1e-6" => Some(2600),
        Quantity::Classify if scene == "simulation/fixed-oblique-1e-5" => Some(2800),
        Quantity::Classify if scene == "simulation/fixed-oblique-1e-6" => Some(3640),
        Quantity::Stack if scene.starts_with("simulation/fixed") => Some(512),
        Quantity::Flash if scene == "small/fixed-oblique-1e-5" => Some(6 * 1024),
        Quantity::Flash if is_small(scene) => None,
        Quantity::StaticMemory => Some(0),
        Quantity::Classify if scene == "table/boundary" => Some(62),
        Quantity::Classify if scene == "table/restitution" => Some(300),
        _ if is_simulated(scene) || is_table(scene) => None,
        Quantity::Classify => Some(150),
        Quantity::SetUpAndClassify => None,
        Quantity::Flash => Some(1024),
        Quantity::Stack => Some(256),
    }
}

/// A limit without a floating-point unit.
const ELSEWHERE: (&str, &str, u32) = ("Cortex-M0", "table/boundary", 250);

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

/// Every broken promise on another core than the reference.
pub(crate) fn broken_elsewhere(figures: &[Figure]) -> Vec<String> {
    let (core, scene, limit) = ELSEWHERE;
    let promised =
        |subject: &Subject| subject.core == core && subject.scene == scene && subject.quantity == Quantity::Classify;
    let broken = figures.iter().filter(|figure| promised(&figure.subject) && figure.value > limit);
    broken.map(|Figure { subject, value }| format!("{subject}: {value}; the promise is at most {limit}")).collect()
}
