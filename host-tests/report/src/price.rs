//! What each part costs: scenes that differ by one term, and the differences of their instructions, bytes and stack on each
//! board, from the figures that `cargo qemu --overwrite` has stored.

use boards::BOARDS;
use boards::absent::PROOFS;
use boards::figures::{self, Figure as Measured, Quantity, Stored};

use crate::content::{Cell, Figure, Part, Run, Section, Table};
use crate::plot::{self, Line, Mark};

/// A scene, and the one that it has a term more than.
struct Step {
    scene: &'static str,
    term: &'static str,
    without: Option<&'static str>,
}

const fn start(scene: &'static str, term: &'static str) -> Step {
    Step { scene, term, without: None }
}

const fn more(scene: &'static str, term: &'static str, without: &'static str) -> Step {
    Step { scene, term, without: Some(without) }
}

/// Scenes that are solved in one way.
struct Family {
    title: &'static str,
    /// Name in those of files.
    name: &'static str,
    /// What is counted.
    work: (Quantity, &'static str),
    steps: &'static [Step],
}

impl Family {
    /// The title as far as the settings.
    fn short_title(&self) -> &'static str {
        self.title.split([',', ':']).next().unwrap_or(self.title)
    }
}

const CLASSIFICATION: (Quantity, &str) = (Quantity::Classify, "instructions of the most expensive impact");
const CALIBRATION: (Quantity, &str) = (Quantity::Calibrate, "instructions");

const FAMILIES: [Family; 7] = [
    Family {
        title: "Rigid body with R = k/(k + v), classified",
        name: "rigid-body",
        work: CLASSIFICATION,
        steps: &[
            start("rigid/bare", "normal, restitution alone"),
            more("rigid/adhesion", "+ work of adhesion", "rigid/bare"),
            more("rigid/friction", "+ friction", "rigid/adhesion"),
            more("rigid/spin", "+ spin", "rigid/friction"),
            more("rigid/rolling-dissipation", "+ rolling dissipation", "rigid/spin"),
        ],
    },
    Family {
        title: "Simulation by FixedCost<5>, 3 iterations, to class and restitution",
        name: "fixed-cost",
        work: CLASSIFICATION,
        steps: &[
            start("fixed-cost/bare", "normal, undamped"),
            more("fixed-cost/damping", "+ damping", "fixed-cost/bare"),
            more("fixed-cost/adhesion", "+ adhesion", "fixed-cost/damping"),
            more("fixed-cost/force", "+ external force", "fixed-cost/adhesion"),
            more("fixed-cost/friction", "adhesion + friction and spin", "fixed-cost/adhesion"),
        ],
    },
    Family {
        title: "Simulation by Collocation, 7 nodes and 1e-6 in f32, 9 nodes and 1e-9 in f64",
        name: "collocation",
        work: CLASSIFICATION,
        steps: &[
            start("simulation/normal", "normal, damping and adhesion"),
            more("simulation/oblique", "+ friction and spin", "simulation/normal"),
            more("collocation/peeling", "+ peeling", "simulation/oblique"),
            more("collocation/recording-16", "normal + recording, 16 samples", "simulation/normal"),
            more("collocation/recording-32", "normal + recording, 32 samples", "collocation/recording-16"),
        ],
    },
    Family {
        title: "Laws of contact by Adaptive at 1e-6: each in a firmware of its own, measured on one board",
        name: "laws-adaptive",
        work: CLASSIFICATION,
        steps: &[
            start("law/hertz", "Hertz"),
            start("law/hertz-hysteretic", "Hertz, hysteretic damping"),
            start("law/hertz-viscoelastic", "Hertz, viscoelastic damping"),
            start("law/hertz-constant", "Hertz, constant damping"),
            start("law/hertz-viscoelastic-without-tension", "Hertz, viscoelastic damping, end without tension"),
            start("law/ring-hysteretic", "ring, hysteretic damping"),
            start("law/dmt", "DMT"),
            start("law/dmt-viscoelastic", "DMT, viscoelastic damping"),
            start("law/jkr", "JKR"),
            start("law/jkr-hysteretic", "JKR, hysteretic damping"),
            start("law/jkr-viscoelastic", "JKR, viscoelastic damping"),
            start("law/jkr-constant", "JKR, constant damping"),
        ],
    },
    Family {
        title: "Laws of contact by FixedCost<7>, 3 iterations: each in a firmware of its own, measured on one board",
        name: "laws-fixed-cost",
        work: CLASSIFICATION,
        steps: &[
            start("law-fixed-cost/hertz", "Hertz"),
            start("law-fixed-cost/hertz-hysteretic", "Hertz, hysteretic damping"),
            start("law-fixed-cost/hertz-viscoelastic", "Hertz, viscoelastic damping"),
            start("law-fixed-cost/hertz-constant", "Hertz, constant damping"),
            start("law-fixed-cost/ring-hysteretic", "ring, hysteretic damping"),
            start("law-fixed-cost/dmt", "DMT"),
            start("law-fixed-cost/dmt-viscoelastic", "DMT, viscoelastic damping"),
        ],
    },
    Family {
        title: "Alternatives: tables, fixed point, and the functions of micromath",
        name: "alternatives",
        work: CLASSIFICATION,
        steps: &[
            start("table/boundary", "boundary table"),
            start("table/restitution", "restitution table, made on the board"),
            start("planar/work", "rigid body with friction and spin"),
            start("planar/work-fixed-point", "the same in fixed point"),
            start("simulation/fixed-class", "FixedCost<4>, 2 iterations, set-up included"),
            start("simulation/fixed-point", "the same in fixed point, set up before"),
        ],
    },
    Family {
        title: "Calibrations",
        name: "calibrations",
        work: CALIBRATION,
        steps: &[
            start("calibrate/material-damping", "zeta_H from a measured R"),
            start("calibrate/adhesion-damping", "zeta_A from a measured e"),
            start("calibrate/adhesion-strength", "f0 from a contact radius at rest"),
            start("calibrate/radius", "radius from a measured e"),
            start("calibrate/restitution-law", "k and W_A from 12 rebounds"),
            start("calibrate/friction", "friction from 12 impulse ratios"),
        ],
    },
];

const SCALARS: [&str; 3] = ["f32", "f64", "micromath"];
const MEMORY: [(Quantity, &str); 2] = [
    (Quantity::Code, "bytes of code and constants, set-up and validation included"),
    (Quantity::Stack, "bytes of stack, painted"),
];

pub(crate) fn section(_: &Run) -> Result<Section, String> {
    let stored = Stored::read(&Stored::path())?;
    let first = FAMILIES[0].steps[0].scene;
    let knows = |compiler: &&str| stored.rows_of(compiler).any(|figure| figure.subject.scene == first);
    let Some(compiler) = stored.compilers().into_iter().find(knows) else {
        return Err(format!("no figures of {first} are stored; `cargo qemu --overwrite` stores them"));
    };
    let prices = Prices { figures: stored.rows_of(compiler).collect() };
    let mut parts = vec![Part::Text(format!(
        "Measured by `cargo qemu --all-cores --counts` with {compiler}, optimised for speed, on emulated boards. The first row of each \
         number type is the cost of its scene. Each row below is what its term adds to the scene with one term less. \
         Instructions are not cycles: a division counts 1. Code and constants are all that the firmware needs to set up \
         a scene, to validate a motion and to classify it, or to calibrate, including the compiler's routines for \
         arithmetic in software. Two scenes may use the same function, so a price can be negative."
    ))];
    for family in &FAMILIES {
        parts.push(Part::Heading(family.short_title().to_owned()));
        let quantities = [family.work].into_iter().chain(MEMORY);
        parts.extend(quantities.map(|(quantity, unit)| Part::Table(prices.table(family, quantity, unit))));
        if family.steps.iter().any(|step| step.without.is_some()) {
            parts.push(Part::Figure(prices.figure(family)?));
        }
    }
    parts.push(Part::Heading("Absent terms".to_owned()));
    parts.push(Part::Text(
        "An absent term costs nothing. The firmware of each scene below is built twice: with the library as it is, and with a \
         copy of its source without any item that names an absent term. The table counts the bytes in which both differ."
            .to_owned(),
    ));
    parts.push(Part::Table(prices.absent()));
    Ok(Section { title: "What each part costs", name: "price", parts })
}

struct Prices<'a> {
    figures: Vec<&'a Measured>,
}

impl Prices<'_> {
    /// The largest figure of a scene.
    fn of(&self, scene: &str, scalar: &str, core: &str, quantity: Quantity) -> Option<f64> {
        figures::largest(self.figures.iter().copied(), core, scene, scalar, quantity)
    }

    /// What each term adds, a column for each core.
    fn table(&self, family: &Family, quantity: Quantity, unit: &str) -> Table {
        let mut rows = Vec::new();
        for scalar in SCALARS {
            for Step { scene, term, without } in family.steps {
                let price = |core| {
                    let whole = self.of(scene, scalar, core, quantity)?;
                    let before = without.map_or(Some(0.0), |scene| self.of(scene, scalar, core, quantity))?;
                    Some(whole - before)
                };
                let prices = BOARDS.map(|board| price(board.core));
                if prices.iter().any(Option::is_some) {
                    rows.push([scalar, term].map(Cell::from).into_iter().chain(prices.map(Cell::from)).collect());
                }
            }
        }
        Table {
            name: format!("price-{}-{}", family.name, quantity.name().replace(' ', "-")),
            caption: format!("{}: {unit}", family.title),
            columns: ["scalar", "scene or term"]
                .into_iter()
                .chain(BOARDS.map(|board| board.core))
                .map(str::to_owned)
                .collect(),
            rows,
        }
    }

    /// Instructions of the scenes in f32 against their bytes.
    fn figure(&self, family: &Family) -> Result<Figure, String> {
        let scalar = SCALARS[0];
        let (mut lines, mut rows) = (Vec::new(), Vec::new());
        for core in BOARDS.map(|board| board.core) {
            let mut points = Vec::new();
            for Step { scene, term, .. } in family.steps {
                let figure = |quantity| self.of(scene, scalar, core, quantity);
                if let (Some(bytes), Some(instructions)) = (figure(Quantity::Code), figure(Quantity::Classify)) {
                    points.push((bytes, instructions));
                    rows.push(vec![core.into(), (*term).into(), bytes.into(), instructions.into()]);
                }
            }
            lines.push(Line::new(core, Mark::Joined, points));
        }
        let drawing = plot::log_log(family.short_title(), "code and constants, bytes", "instructions", &lines)?;
        let columns = ["core", "scene or term", "code and constants, bytes", "instructions"];
        let data = Table {
            name: format!("price-{}", family.name),
            caption: format!(
                "{}: instructions against bytes in f32, a point for each row of the tables, joined in their order",
                family.title
            ),
            columns: columns.map(str::to_owned).to_vec(),
            rows,
        };
        Ok(Figure { drawing, data })
    }

    /// Bytes of absent terms.
    fn absent(&self) -> Table {
        let mut rows = Vec::new();
        for proof in &PROOFS {
            for core in BOARDS.map(|board| board.core) {
                if let Some(bytes) = self.of(proof.scene, SCALARS[0], core, Quantity::AbsentTerms) {
                    rows.push(vec![proof.scene.into(), proof.absent().as_str().into(), core.into(), Cell::from(bytes)]);
                }
            }
        }
        Table {
            name: "price-absent".to_owned(),
            caption: "Absent terms".to_owned(),
            columns: ["scene", "absent", "core", "bytes that differ"].map(str::to_owned).to_vec(),
            rows,
        }
    }
}
