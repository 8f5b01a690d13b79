//! The page as one file: its parts, and the program for WebAssembly, compressed and in base64.

use std::fmt;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use boards::packages::Permission;
use boards::toolchain::{Choice, Toolchain};
use flate2::Compression;
use flate2::write::GzEncoder;

/// WebAssembly with the system interface that a program needs for its streams and arguments.
const TARGET: &str = "wasm32-wasip1";

const FRAME: &str = include_str!("../page/index.html");

/// What stands in the frame for each part, and the part.
const PARTS: [(&str, &str); 9] = [
    ("/* style */", include_str!("../page/style.css")),
    ("/* worker */", include_str!("../page/worker.js")),
    ("/* program */", include_str!("../page/program.js")),
    ("/* inputs */", include_str!("../page/inputs.js")),
    ("/* chart */", include_str!("../page/chart.js")),
    ("/* scene */", include_str!("../page/scene.js")),
    ("/* answer */", include_str!("../page/answer.js")),
    ("/* mapping */", include_str!("../page/mapping.js")),
    ("/* table */", include_str!("../page/table.js")),
];

/// Where the program stands in the frame.
const MODULE: &str = "<!-- module -->";

/// Sizes in bytes.
pub struct Sizes {
    module: usize,
    compressed: usize,
    page: usize,
}

/// Compilers differ by so much in the size of what they make.
const SAME_SIZE: f64 = 0.05;

impl Sizes {
    /// Fails if the README states other sizes.
    pub fn check(&self) -> Result<(), String> {
        const README: &str = include_str!("../README.md");
        let Self { module, compressed, page } = *self;
        for (what, size) in
            [("WebAssembly", module), ("the same, compressed with gzip", compressed), ("the whole page", page)]
        {
            let cell = README.lines().find_map(|line| line.strip_prefix(&format!("| {what} | "))?.strip_suffix(" |"));
            let stated: f64 =
                cell.and_then(|text| text.parse().ok()).ok_or(format!("README states no size of {what}"))?;
            if (stated / size as f64 - 1.0).abs() > SAME_SIZE {
                return Err(format!(
                    "README states {stated} bytes for {what}, which has {size}; enter the new size there"
                ));
            }
        }
        Ok(())
    }
}

impl fmt::Display for Sizes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { module, compressed, page } = self;
        write!(f, "{page} bytes; the program in it has {module} bytes of WebAssembly, {compressed} compressed")
    }
}

/// Builds the program for WebAssembly, and writes the page to a file.
pub fn build(target_folder: &Path, file: &Path, permission: Permission) -> Result<Sizes, String> {
    let toolchain = Toolchain::find(Choice::Rustup, &[TARGET], permission)?;
    let mut cargo = toolchain.cargo(TARGET);
    cargo.current_dir(boards::firmware::repository()).arg("--locked");
    cargo.args(["--package", "web-module", "--profile", "web", "--target-dir"]).arg(target_folder);
    // A slow machine takes long: cargo shows how far it is.
    let status = cargo.status().map_err(|error| format!("cannot run cargo: {error}"))?;
    if !status.success() {
        return Err("the build of web-module failed; the messages of cargo above say why".into());
    }
    let module = target_folder.join(TARGET).join("web/web-module.wasm");
    let module = fs::read(&module).map_err(|error| format!("{}: {error}", module.display()))?;
    let compressed = compressed(&module).map_err(|error| error.to_string())?;
    let page = page(&compressed)?;
    fs::write(file, &page).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(Sizes { module: module.len(), compressed: compressed.len(), page: page.len() })
}

fn compressed(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// The frame with its parts.
fn page(module: &[u8]) -> Result<String, String> {
    let put = |page: String, place: &str, part: &str| {
        if page.matches(place).count() == 1 {
            Ok(page.replace(place, part))
        } else {
            Err(format!("the page must have one place for {place}"))
        }
    };
    let page = PARTS.iter().try_fold(FRAME.to_owned(), |page, (place, part)| put(page, place, part))?;
    put(page, MODULE, &STANDARD.encode(module))
}
