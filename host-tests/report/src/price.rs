//! What each part costs: scenes that differ by one term, and the differences of their instructions, bytes and stack on each
//! board, from the figures that `cargo qemu --overwrite` has stored.

use boards::absent::PROOFS;
use boards::figures::{self, Figure as Measured, Quantity, Stored};
use boards::{BOARDS, REFERENCE_CORE};

use crate::content::{Cell, Figure, Part, Run, Section, Table};
use crate::plot::{self, Axis, Bar, Panel};

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

const CLASSIFICATION: (Quantity, &str) = (Quantity::Classify, "instructions of the most expensive impact");
const CALIBRATION: (Quantity, &str) = (Quantity::Calibrate, "instructions");

const FAMILIES: [Family; 8] = [
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
        title: "Functions, the library's own and those of micromath",
        name: "functions",
        work: CLASSIFICATION,
        steps: &[
            start("function/root", "square root"),
            start("function/two-fifths-power", "power 2/5"),
            start("function/decay", "exponential function"),
            start("function/standard-error", "standard error by three inputs"),
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

/// Cores with floating point of their own, and those without: bars of both would not fit on one axis.
const WITH_FLOATING_POINT: [&str; 3] = ["Cortex-M4F", "Cortex-M7", "Cortex-M33"];
const WITHOUT: [&str; 3] = ["Cortex-M3", "Cortex-M0", "RV32IMAC"];

/// A chain of scenes, each with a term more than the one before, and the names of the terms.
struct Chain {
    title: &'static str,
    scenes: &'static [(&'static str, &'static str)],
}

const CHAINS: [Chain; 3] = [
    Chain {
        title: "Rigid body",
        scenes: &[
            ("rigid/bare", "restitution alone"),
            ("rigid/adhesion", "work of adhesion"),
            ("rigid/friction", "friction"),
            ("rigid/spin", "spin"),
            ("rigid/rolling-dissipation", "rolling dissipation"),
        ],
    },
    Chain {
        title: "Simulation, FixedCost<5>, 3 iterations",
        scenes: &[
            ("fixed-cost/bare", "undamped contact"),
            ("fixed-cost/damping", "damping"),
            ("fixed-cost/adhesion", "adhesion"),
            ("fixed-cost/friction", "friction and spin"),
        ],
    },
    Chain {
        title: "Simulation, Collocation<7>, 1e-6",
        scenes: &[("simulation/normal", "contact with adhesion"), ("simulation/oblique", "friction and spin")],
    },
];

pub(crate) fn section(_: &Run) -> Result<Section, String> {
    let stored = Stored::read(&Stored::path())?;
    let first = FAMILIES[0].steps[0].scene;
    let knows = |compiler: &&str| stored.rows_of(compiler).any(|figure| figure.subject.scene == first);
    let Some(compiler) = stored.compilers().into_iter().find(knows) else {
        return Err(format!("no figures of {first} are stored; `cargo qemu --overwrite` stores them"));
    };
    let prices = Prices { figures: stored.rows_of(compiler).collect() };
    let work = (FAMILIES[0].work.0, Axis::linear("instructions", "N", "1"));
    let memory = (Quantity::Code, Axis::linear("code and constants", "m", "bytes"));
    let lead = Figure {
        title: "What does each term cost?".to_owned(),
        ..prices.bars("price-lead", &WITH_FLOATING_POINT, &work, prices.sentence())?
    };
    let soft = prices.in_software();
    let flash = "Memory for code and constants, set-up and validation included.".to_owned();
    let mut parts = vec![
        Part::Figure(Figure {
            title: "Instructions on cores without floating point".to_owned(),
            ..prices.bars("price-without-floating-point", &WITHOUT, &work, soft)?
        }),
        Part::Figure(Figure {
            title: "Bytes on cores with floating point".to_owned(),
            ..prices.bars("price-bytes", &WITH_FLOATING_POINT, &memory, flash)?
        }),
    ];
    for family in &FAMILIES {
        let quantities = [family.work].into_iter().chain(MEMORY);
        let tables = quantities.map(|(quantity, unit)| Part::Table(prices.table(family, quantity, unit)));
        parts.push(Part::Fold(family.title.to_owned(), tables.collect()));
    }
    let absent = "The firmware of each scene below is built twice: with the library as it is, and with a copy of its source without \
                  any item that names an absent term. The table counts the bytes in which both differ.";
    parts.push(Part::Fold(
        "An absent term costs nothing".to_owned(),
        vec![Part::Text(absent.to_owned()), Part::Table(prices.absent())],
    ));
    let method = format!(
        "The figures are stored in `host-tests/data/footprint`; `cargo qemu --all-cores --counts` measures them again. They come \
         from {compiler}, optimised for speed, on emulated boards. In a table the first row of each number type is the cost of its \
         scene, and each row below is what its term adds to the scene with one term less. Instructions are not cycles: a division \
         counts 1. Code and constants are all that the firmware needs to set up a scene, to validate a motion and to classify it, \
         or to calibrate, including the compiler's routines for arithmetic in software. Two scenes may use the same function, so a \
         price can be negative; a bar shows it as zero."
    );
    parts.push(Part::Fold("How it is measured".to_owned(), vec![Part::Text(method)]));
    Ok(Section { title: "Price of each term", name: "price", lead: Some(lead), left_out: None, parts })
}

struct Prices<'a> {
    figures: Vec<&'a Measured>,
}

impl Prices<'_> {
    /// The largest figure of a scene.
    fn of(&self, scene: &str, scalar: &str, core: &str, quantity: Quantity) -> Option<f64> {
        figures::largest(self.figures.iter().copied(), core, scene, scalar, quantity)
    }

    /// The most that a chain costs on a core in f32.
    fn whole(&self, chain: &Chain, core: &str) -> f64 {
        let of = |(scene, _): &(&str, &str)| self.of(scene, SCALARS[0], core, Quantity::Classify);
        chain.scenes.iter().filter_map(of).fold(0.0, f64::max)
    }

    /// What the first picture says.
    fn sentence(&self) -> String {
        let [rigid, fixed, collocation] = CHAINS.each_ref().map(|chain| self.whole(chain, REFERENCE_CORE));
        format!(
            "On a {REFERENCE_CORE} the rigid body takes at most {rigid:.0} instructions with all its terms, the simulation {fixed:.0} at \
             a fixed cost and {collocation:.0} with a bounded error; each colour is the price of one term (stored figures, f32)."
        )
    }

    /// How many times as many instructions a core without floating point takes.
    fn in_software(&self) -> String {
        let ratio = |chain, core| self.whole(chain, core) / self.whole(chain, REFERENCE_CORE);
        let ratios = || CHAINS.iter().flat_map(|chain| WITHOUT.map(|core| ratio(chain, core)));
        let (least, most) = (ratios().fold(f64::INFINITY, f64::min), ratios().fold(0.0, f64::max));
        format!(
            "A core that computes with floating point in software takes {least:.0} to {most:.0} times as many instructions as a \
             {REFERENCE_CORE} for the same scene."
        )
    }

    /// A panel for each chain with a bar for each core, in f32.
    fn bars(&self, name: &str, cores: &[&str], work: &(Quantity, Axis), caption: String) -> Result<Figure, String> {
        let mut rows = Vec::new();
        let mut panels = Vec::new();
        for Chain { title, scenes } in &CHAINS {
            let mut bars = Vec::new();
            for core in cores {
                let (mut before, mut pieces) = (0.0, Vec::new());
                for (scene, term) in *scenes {
                    let Some(whole) = self.of(scene, SCALARS[0], core, work.0) else { continue };
                    rows.push(vec![(*title).into(), (*core).into(), (*term).into(), (whole - before).into()]);
                    pieces.push((whole - before).max(0.0));
                    before = whole;
                }
                bars.push(Bar { name: (*core).to_owned(), pieces });
            }
            let names = scenes.iter().map(|(_, term)| *term).collect();
            panels.push(Panel { title: (*title).to_owned(), axis: work.1.clone(), names, bars });
        }
        let columns = ["method", "core", "term", work.0.unit()].map(str::to_owned).to_vec();
        let data = Table { name: name.to_owned(), caption, columns, rows };
        Ok(Figure { title: String::new(), drawing: plot::bars(&panels)?, data })
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
