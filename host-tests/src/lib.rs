//! What several tests need: the reference solutions, as scenes, and the examples, run as a person runs them.

pub mod boards;
pub mod c_results;
pub mod contest;
pub mod fit;
pub mod link;
#[path = "../../examples/firmware/src/table_1.rs"]
pub mod table_1;

use std::collections::HashMap;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Output, Stdio};
use std::sync::{LazyLock, Mutex};

use microimpact::simulation::{HystereticDamping, Ring, Simulation};
use microimpact::{Coulomb, InputError, NormalMotion, PlanarMotion, Real, Sphere, Stiffness};

const CASES: &str = include_str!("../data/cases.csv");

/// An impact with its solution to 20 digits: a row of `data/cases.csv`.
#[derive(Clone)]
pub struct Case {
    names: csv::StringRecord,
    cells: csv::StringRecord,
}

/// A scene of the reference, still without a peeling moment.
pub type Scene<T> = Simulation<T, HystereticDamping<T>, Ring<T>, Coulomb<T>>;

/// All cases.
///
/// # Panics
/// If the file is not a table.
pub fn cases() -> Vec<Case> {
    let mut reader = csv::Reader::from_reader(CASES.as_bytes());
    let names = reader.headers().expect("the reference has a header").clone();
    let cells = reader.records().map(|cells| cells.expect("the reference is a table"));
    cells.map(|cells| Case { names: names.clone(), cells }).collect()
}

impl Case {
    /// A cell.
    ///
    /// # Panics
    /// If there is no such column.
    pub fn text(&self, column: &str) -> &str {
        let index = self.names.iter().position(|name| name == column);
        &self.cells[index.unwrap_or_else(|| panic!("the reference has no column {column}"))]
    }

    /// A number.
    ///
    /// # Panics
    /// If there is no such column, or it does not hold numbers.
    pub fn number(&self, column: &str) -> f64 {
        let text = self.text(column);
        text.parse().unwrap_or_else(|_| panic!("{column} of the reference is no number: {text}"))
    }

    /// The case with the number in a column multiplied by a factor; its solution is no longer that of its inputs.
    ///
    /// # Panics
    /// As [`number`](Self::number).
    #[must_use]
    pub fn scaled(&self, column: &str, factor: f64) -> Self {
        let value = factor * self.number(column);
        let cells = self.names.iter().zip(&self.cells);
        let cells = cells.map(|(name, cell)| if name == column { format!("{value:e}") } else { cell.to_owned() });
        Self { names: self.names.clone(), cells: cells.collect() }
    }

    /// The motion before the impact.
    ///
    /// # Errors
    /// A value that the number type cannot hold.
    pub fn motion<T: Real>(&self) -> Result<PlanarMotion<T>, InputError> {
        NormalMotion::new(self.scalar("speed_normal_m_s"))?
            .with_tangential(self.scalar("speed_tangential_m_s"))?
            .with_spin(&self.sphere()?, self.scalar("spin_rad_s"))
    }

    /// The scene.
    ///
    /// # Errors
    /// A value that the number type cannot hold.
    pub fn scene<T: Real>(&self) -> Result<Scene<T>, InputError> {
        Simulation::new(self.sphere()?, Stiffness::new(self.scalar("stiffness_pa"))?)
            .with_damping(self.scalar("zeta_h"))?
            .with_ring(self.scalar("adhesion_n_m"), self.scalar("zeta_a"))?
            .with_friction(self.scalar("friction"))
    }

    /// The strength of the peeling moment, if there is one.
    pub fn peeling<T: Real>(&self) -> Option<T> {
        (self.number("peeling_n_m") > 0.0).then(|| self.scalar("peeling_n_m"))
    }

    fn sphere<T: Real>(&self) -> Result<Sphere<T>, InputError> {
        Sphere::solid(self.scalar("radius_m"), self.scalar("density_kg_m3"))
    }

    fn scalar<T: Real>(&self, column: &str) -> T {
        T::constant(self.number(column))
    }
}

/// Runs an example of the library with arguments and standard input.
///
/// # Panics
/// If the example does not build or cannot be run.
pub fn run_example(example: &'static str, arguments: &[&str], input: &[u8]) -> Output {
    let mut command = std::process::Command::new(built_example(example));
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the example runs");
    let mut stdin = child.stdin.take().expect("its standard input is a pipe");
    let input = input.to_owned();
    let feeder = std::thread::spawn(move || stdin.write_all(&input));
    let output = child.wait_with_output().expect("the example ends");
    // A run that ends early does not read all of its input.
    let _ = feeder.join();
    output
}

/// The program of an example, built once.
fn built_example(example: &'static str) -> PathBuf {
    static BUILT: LazyLock<Mutex<HashMap<&'static str, PathBuf>>> = LazyLock::new(Mutex::default);
    let mut built = BUILT.lock().expect("no build of an example fails");
    let path = built.entry(example).or_insert_with(|| {
        let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml");
        let build = escargot::CargoBuild::new().manifest_path(manifest).package("microimpact").example(example);
        build.run().expect("the example builds").path().to_owned()
    });
    path.clone()
}
