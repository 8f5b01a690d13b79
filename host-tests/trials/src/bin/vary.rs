//! Trials with other values of a constant of the solver: what each value costs, and which errors it leaves.

use std::error::Error;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Parser;

/// Runs the trials with other values of a constant of the solver.
///
/// `cargo vary SECOND_COEFFICIENT 0 1 -- --kind mild --method Adaptive` shows what the constant is good for.
#[derive(Parser)]
struct Arguments {
    /// Name of the constant; behind that of its file where several have it, as `interval::TAIL_ERROR`
    name: String,
    /// Values besides its own
    #[arg(required = true, allow_negative_numbers = true)]
    values: Vec<String>,
    /// What `cargo trials` takes, behind `--`
    #[arg(last = true)]
    trials: Vec<String>,
}

/// Where the constants of the solver are.
const FOLDER: &str = "src/contact";

/// A constant in a line of its own.
#[derive(Debug, PartialEq)]
struct Constant {
    file: PathBuf,
    line: usize,
    value: String,
}

fn main() -> Result<(), Box<dyn Error>> {
    let Arguments { name, values, trials } = Arguments::parse();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let constant = Constant::named(&name, &root)?;
    let copy = root.join("target/vary");
    copy_folder(&root, &copy)?;
    let source = fs::read_to_string(root.join(&constant.file))?;
    for value in [&constant.value].into_iter().chain(&values) {
        fs::write(copy.join(&constant.file), constant.put(&source, value))?;
        println!("{name} = {value}\n");
        let mut command = Command::new(env!("CARGO"));
        command.args(["run", "--quiet", "--release", "--package", "trials", "--bin", "trials", "--"]).args(&trials);
        let status = command.current_dir(&copy).env("CARGO_TARGET_DIR", copy.join("target")).status()?;
        if !status.success() {
            return Err(format!("the trials with {name} = {value} ended with {status}").into());
        }
    }
    Ok(())
}

impl Constant {
    /// The constant of a name, with or without that of its file.
    fn named(name: &str, root: &Path) -> Result<Self, String> {
        let (file, constant) = name.rsplit_once("::").map_or((None, name), |(file, constant)| (Some(file), constant));
        let mut found = Vec::new();
        let mut folders = vec![PathBuf::from(FOLDER)];
        while let Some(folder) = folders.pop() {
            for path in entries(&root.join(&folder))? {
                let path = folder.join(path.file_name().unwrap_or_default());
                if root.join(&path).is_dir() {
                    folders.push(path);
                } else if file.is_none_or(|file| path.file_stem() == Some(OsStr::new(file))) {
                    let source = fs::read_to_string(root.join(&path)).map_err(|error| error.to_string())?;
                    found.extend(Self::in_source(constant, &path, &source));
                }
            }
        }
        if found.len() > 1 {
            let files: Vec<_> = found.iter().map(|constant| constant.file.display().to_string()).collect();
            return Err(format!(
                "{name} is in {}; put the name of one of these files before it, as file::{constant}",
                files.join(", ")
            ));
        }
        found.pop().ok_or_else(|| format!("no file of {FOLDER} has a constant {name} in a line of its own"))
    }

    fn in_source(name: &str, file: &Path, source: &str) -> Option<Self> {
        let begin = format!("const {name}: ");
        let value = |line: &str| {
            let (_, definition) = line.split_once(&begin)?;
            let (_, value) = definition.split_once(" = ")?;
            value.strip_suffix(';').map(str::to_owned)
        };
        let found = source.lines().enumerate().find_map(|(number, line)| Some((number, value(line)?)));
        found.map(|(line, value)| Self { file: file.to_owned(), line, value })
    }

    /// The source with another value of the constant. An integer may stand for a number with a decimal point.
    fn put(&self, source: &str, value: &str) -> String {
        let lines = source.lines().enumerate().map(|(number, line)| match line.rsplit_once(" = ") {
            Some((definition, _)) if number == self.line => {
                let point = if definition.ends_with("f64") && value.parse::<i64>().is_ok() { ".0" } else { "" };
                format!("{definition} = {value}{point};\n")
            }
            _ => format!("{line}\n"),
        });
        lines.collect()
    }
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(entries.filter_map(|entry| Some(entry.ok()?.path())).collect())
}

/// Copies what a build reads. Files that are the same keep their times, so that they are not compiled again.
fn copy_folder(from: &Path, to: &Path) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(to)?;
    for path in entries(from)? {
        let name = path.file_name().unwrap_or_default();
        let other = to.join(name);
        if path.is_dir() {
            if name != "target" && name != ".git" {
                copy_folder(&path, &other)?;
            }
        } else {
            let contents = fs::read(&path)?;
            if fs::read(&other).ok().as_ref() != Some(&contents) {
                fs::write(&other, contents)?;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::Constant;

    #[test]
    fn constants_are_found_by_their_names() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let one = Constant::named("SECOND_COEFFICIENT", &root).unwrap();
        assert!(one.file.ends_with("solve/interval.rs") && one.value.parse::<f64>().is_ok(), "{one:?}");
        let several = Constant::named("TAIL_ERROR", &root).unwrap_err();
        assert!(several.contains("solve/interval.rs") && several.contains("along/compliance.rs"), "{several}");
        assert!(Constant::named("compliance::TAIL_ERROR", &root).unwrap().file.ends_with("along/compliance.rs"));
        assert!(Constant::named("NO_SUCH", &root).unwrap_err().contains("no file of src/contact"));
    }

    #[test]
    fn one_line_gets_the_other_value() {
        let source = "/// One.\nconst ONE: f64 = 1.0;\n\npub(super) const TWO: u32 = 2;\n";
        let two = Constant::in_source("TWO", Path::new("a.rs"), source).unwrap();
        assert_eq!((two.line, two.value.as_str()), (3, "2"));
        assert_eq!(two.put(source, "5"), "/// One.\nconst ONE: f64 = 1.0;\n\npub(super) const TWO: u32 = 5;\n");
        let one = Constant::in_source("ONE", Path::new("a.rs"), source).unwrap();
        assert_eq!(one.put(source, "0"), "/// One.\nconst ONE: f64 = 0.0;\n\npub(super) const TWO: u32 = 2;\n");
        assert_eq!(Constant::in_source("THREE", Path::new("a.rs"), source), None);
    }
}
