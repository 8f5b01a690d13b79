//! What the library promises, checked in every run.

use boards::REFERENCE_CORE;
use boards::figures::{Figure, Quantity, Subject};

/// The scalar for which the promises hold.
pub(crate) const SCALAR: &str = "f32";

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

/// Whether a scene has the probabilities of classes.
pub(crate) fn is_uncertain(scene: &str) -> bool {
    scene.starts_with("uncertain/")
}

/// Whether a scene is computed in fixed point.
pub(crate) fn is_fixed_point(scene: &str) -> bool {
    scene.ends_with("fixed-point")
}

/// Whether a scene is there for the price of one term, law or function.
fn is_variant(scene: &str) -> bool {
    ["rigid/", "fixed-cost/", "collocation/", "law/", "law-fixed-cost/", "function/"]
        .iter()
        .any(|family| scene.starts_with(family))
}

/// Whether a scene is a calibration.
pub(crate) fn is_calibration(scene: &str) -> bool {
    scene.starts_with("calibrate/")
}

/// The limit that a quantity must keep on the reference core.
pub(crate) fn of(scene: &str, quantity: Quantity) -> Option<f64> {
    match quantity {
        Quantity::Classify if scene == "simulation/fixed-class" => Some(1600.0),
        Quantity::Classify if scene == "simulation/fixed-1e-5" => Some(2200.0),
        Quantity::Classify if scene == "simulation/fixed-1e-6" => Some(2950.0),
        Quantity::Classify if scene == "simulation/fixed-oblique-1e-5" => Some(3100.0),
        Quantity::Classify if scene == "simulation/fixed-oblique-1e-6" => Some(4100.0),
        Quantity::Classify if scene == "simulation/fixed-point" => Some(9000.0),
        Quantity::Classify if scene == "simulation/fixed-point-oblique" => Some(17e3),
        Quantity::Stack if scene == "simulation/fixed-point-oblique" => Some(768.0),
        Quantity::Classify if is_fixed_point(scene) => Some(750.0),
        Quantity::Stack if scene.starts_with("simulation/fixed") => Some(544.0),
        Quantity::Flash if scene == "small/fixed-oblique-1e-5" => Some(7.0 * 1024.0),
        Quantity::Flash if is_small(scene) => None,
        Quantity::StaticMemory | Quantity::AbsentTerms => Some(0.0),
        Quantity::Error if scene == "simulation/fixed-class" || scene.starts_with("simulation/fixed-point") => {
            Some(1e-4)
        }
        Quantity::Error if scene == "simulation/fixed-1e-5" => Some(1e-5),
        // One of the impacts lies closer to the critical speed than the scenes for which the method promises 1e-6.
        Quantity::Error if scene == "simulation/fixed-1e-6" => Some(2e-6),
        Quantity::Error if scene == "table/restitution" => Some(1e-3),
        Quantity::Classify if scene == "table/boundary" => Some(60.0),
        Quantity::Classify if scene == "table/restitution" => Some(300.0),
        Quantity::Classify if scene == "uncertain/speed" => Some(20e3),
        // The inputs within the bound and the bound itself are two integrals.
        Quantity::Classify if scene == "uncertain/bounded" => Some(30e3),
        _ if is_uncertain(scene) => None,
        _ if is_simulated(scene) || is_table(scene) || is_calibration(scene) => None,
        Quantity::Classify => Some(150.0),
        Quantity::SetUpAndClassify | Quantity::Calibrate | Quantity::Code | Quantity::Error => None,
        Quantity::Flash => Some(1024.0),
        Quantity::Stack => Some(256.0),
    }
}

/// Limits without a floating-point unit.
const ELSEWHERE: [(&str, &str, f64); 5] = [
    ("Cortex-M0", "table/boundary", 250.0),
    ("Cortex-M0", "simulation/fixed-point", 50e3),
    ("Cortex-M3", "simulation/fixed-point", 9e3),
    ("Cortex-M0", "simulation/fixed-point-oblique", 74e3),
    ("Cortex-M3", "simulation/fixed-point-oblique", 17.5e3),
];

/// The figures of the scenes for use: the worst of each scene and quantity.
pub(crate) fn check(figures: &[Figure]) -> Vec<Figure> {
    let mut checked: Vec<Figure> = Vec::new();
    for figure in figures {
        let Figure { subject, value } = figure;
        if subject.core != REFERENCE_CORE || subject.scalar != SCALAR || is_variant(&subject.scene) {
            continue;
        }
        let same =
            |other: &&mut Figure| other.subject.scene == subject.scene && other.subject.quantity == subject.quantity;
        match checked.iter_mut().find(same) {
            Some(known) if known.value >= *value => {}
            Some(known) => known.clone_from(figure),
            None => checked.push(figure.clone()),
        }
    }
    checked
}

/// Every broken promise.
pub(crate) fn broken(checked: &[Figure]) -> Vec<String> {
    exceeding(checked, |subject| of(&subject.scene, subject.quantity))
}

/// Every broken promise on another core than the reference.
pub(crate) fn broken_elsewhere(figures: &[Figure]) -> Vec<String> {
    exceeding(figures, |subject| {
        let promised = |(core, scene, _): &&(&str, &str, f64)| subject.core == *core && subject.scene == *scene;
        match subject.quantity {
            _ if subject.core == REFERENCE_CORE => None,
            Quantity::AbsentTerms => Some(0.0),
            Quantity::Classify => ELSEWHERE.iter().find(promised).map(|(.., limit)| *limit),
            _ => None,
        }
    })
}

/// Every figure that is larger than its limit.
fn exceeding(figures: &[Figure], limit: impl Fn(&Subject) -> Option<f64>) -> Vec<String> {
    let exceeds = |Figure { subject, value }: &Figure| {
        let (limit, unit) = (limit(subject)?, subject.quantity.unit());
        (*value > limit).then(|| format!("{subject}: {value} {unit}; the promise is at most {limit}"))
    };
    figures.iter().filter_map(exceeds).collect()
}

/// The code and constants of a scene may differ from those of a firmware for it alone by this number of bytes and this
/// fraction together, since the compiler inlines and merges other functions there, and the ranges of all parameters are one table.
const JOINED: (f64, f64) = (500.0, 0.05);

/// Every scene whose two numbers of bytes do not go together: a reference that was overlooked would make code and constants
/// much fewer than the scene takes alone.
pub(crate) fn doubtful_bytes(figures: &[Figure]) -> Vec<String> {
    let both = figures.iter().filter(|figure| figure.subject.quantity == Quantity::Flash).filter_map(|alone| {
        let subject = Subject { quantity: Quantity::Code, ..alone.subject.clone() };
        let among = figures.iter().find(|figure| figure.subject == subject)?;
        Some((subject, alone.value, among.value))
    });
    let doubtful = both.filter(|(_, alone, among)| (among - alone).abs() > JOINED.0 + JOINED.1 * alone);
    doubtful
        .map(|(subject, alone, among)| format!("{subject}: {among}, and {alone} in a firmware of its own"))
        .collect()
}
