//! The interface for C: its header is current, misuse is harmless, and its results are those of Rust.

use std::path::{Path, PathBuf};

use reference::c_results;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/c")
}

fn header() -> String {
    let mut text = Vec::new();
    let config = cbindgen::Config::from_file(folder().join("cbindgen.toml")).unwrap();
    let bindings = cbindgen::Builder::new().with_crate(folder()).with_config(config).generate().unwrap();
    bindings.write(&mut text);
    in_c90(&String::from_utf8(text).unwrap())
}

/// What cbindgen writes, in the words that C90, C++98 and all later languages share: each enumeration is a nameless one and a type of 32
/// bits, since the size of an enumeration differs from compiler to compiler; no line comments, and no comma before a brace.
fn in_c90(text: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut enumeration = None;
    // Depth of the conditions around the size of an enumeration, and around its type.
    let mut skipped = 0;
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("enum ") {
            enumeration = Some(name.to_owned());
            lines.push("enum {".to_owned());
            continue;
        }
        let Some(name) = enumeration.as_deref() else {
            lines.push(line.split_once(" // ").map_or(line.to_owned(), |(code, note)| format!("{code} /* {note} */")));
            continue;
        };
        if line.starts_with("#if") {
            skipped += 1;
        } else if line.starts_with("#endif") {
            skipped -= 1;
            // The type comes after the braces, in conditions of its own.
            if skipped == 0 && lines.last().is_some_and(|last| last == "};") {
                lines.push(format!("typedef uint32_t {name};"));
                enumeration = None;
            }
        } else if line == "};" {
            let last = lines.last_mut().unwrap();
            *last = last.trim_end_matches(',').to_owned();
            lines.push(line.to_owned());
        } else if skipped == 0 && line != " {" {
            lines.push(line.to_owned());
        }
    }
    compact(&with_costs(&lines))
}

/// The same with what README says of each function at the end of its comment.
fn with_costs(lines: &[String]) -> Vec<String> {
    let page = std::fs::read_to_string(folder().join("README.md")).unwrap();
    let mut told: Vec<String> = Vec::new();
    for line in lines {
        if let Some(function) = function(line) {
            let comment = told.iter().rposition(|line| line == "/*").unwrap();
            let safety = told[comment..].iter().position(|line| line.trim() == "# Safety");
            // Before the empty line above the section, or the end of the comment.
            let end = safety.map_or(told.len() - 1, |safety| comment + safety - 1);
            told.splice(end..end, costs(&page, function));
        }
        told.push(line.clone());
    }
    told
}

/// The function that a line declares, without the beginning of its name.
fn function(line: &str) -> Option<&str> {
    let (result, function) = line.split_once(" microimpact_")?;
    let is_result = ["MicroimpactStatus", "uint32_t", "size_t"].contains(&result);
    is_result.then(|| function.split('(').next().unwrap())
}

/// Lines of a comment with the costs of a function, one for each row of README's table.
fn costs(page: &str, function: &str) -> Vec<String> {
    let row = |line: &str| {
        let cells: Vec<_> = line.strip_prefix("| ")?.strip_suffix(" |")?.split(" | ").collect();
        let [name, instructions, stack] = *cells else { return None };
        let (of, case) = name.split_once(", ").unwrap_or((name, ""));
        let case = if case.is_empty() { String::new() } else { format!(", {case}") };
        let text = format!(" On a Cortex-M3{case}, at most {instructions} instructions and {stack} bytes of stack.");
        (of == function).then_some(text)
    };
    page.lines().filter_map(row).collect()
}

/// The same with each comment of one line on one line.
fn compact(lines: &[String]) -> String {
    let mut text = String::new();
    let mut rest = lines;
    while let Some(line) = rest.first() {
        match rest {
            [open, comment, close, ..] if open.trim() == "/*" && close.trim() == "*/" => {
                text += &format!("{open} {} */\n", comment.trim_start());
                rest = &rest[3..];
            }
            _ => {
                text += line;
                text.push('\n');
                rest = &rest[1..];
            }
        }
    }
    text
}

/// The table that `microimpact table` writes for C.
fn constant() -> String {
    let output = crate::microimpact("table", &c_results::CONSTANT, b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    let arguments = c_results::CONSTANT.join(" ");
    let made_by = format!("/* Made by cargo microimpact table {arguments} */\n");
    made_by + &String::from_utf8(output.stdout).unwrap()
}

fn constant_file() -> PathBuf {
    folder().join("boundary.h")
}

fn header_file() -> PathBuf {
    folder().join("include/microimpact.h")
}

#[test]
fn header_is_current() {
    let stored = std::fs::read_to_string(header_file()).unwrap();
    let write = "cargo test --package host-tests --test programs -- --ignored";
    assert_eq!(stored, header(), "the interface has changed; `{write}` writes its header anew");
}

/// Whether an interrupt may call it, and what it takes, is stated for every function.
#[test]
fn every_function_says_whether_an_interrupt_may_call_it_and_what_it_takes() {
    let header = header();
    let (mut at, mut functions) = (0, 0);
    for line in header.lines() {
        if let Some(function) = function(line) {
            let (_, comment) = header[..at].rsplit_once("/*").unwrap();
            assert!(["e-entrant", "interrupt"].iter().any(|word| comment.contains(word)), "{function}");
            assert!(comment.contains("bytes of stack"), "{function}");
            functions += 1;
        }
        at += line.len() + 1;
    }
    assert!(functions > 35);
}

#[test]
fn constant_is_current() {
    assert_eq!(std::fs::read_to_string(constant_file()).unwrap(), constant());
}

#[test]
#[ignore = "writes the headers anew"]
fn write_headers() {
    std::fs::write(header_file(), header()).unwrap();
    std::fs::write(constant_file(), constant()).unwrap();
}

/// The C programs under the sanitizers; the library is built for that of addresses too, so that it sees what Rust writes.
#[cfg(target_os = "linux")]
mod sanitized {
    use std::path::{Path, PathBuf};
    use std::process::{Command, Output};
    use std::sync::OnceLock;

    use reference::c_results;

    use super::folder;

    const TEMPORARY: &str = env!("CARGO_TARGET_TMPDIR");

    /// The static library, built once.
    fn library() -> &'static Path {
        static LIBRARY: OnceLock<PathBuf> = OnceLock::new();
        LIBRARY.get_or_init(|| {
            let triple = format!("{}-unknown-linux-gnu", std::env::consts::ARCH);
            let target = Path::new(TEMPORARY).join("c");
            let mut cargo = Command::new(env!("CARGO"));
            cargo.args(["build", "--release", "--locked", "--target", &triple]);
            cargo.arg("--manifest-path").arg(folder().join("Cargo.toml")).arg("--target-dir").arg(&target);
            cargo.env("RUSTC_BOOTSTRAP", "1").env("RUSTFLAGS", "-Zsanitizer=address");
            assert!(cargo.status().unwrap().success());
            target.join(triple).join("release/libmicroimpact_c.a")
        })
    }

    /// Compiles a C program and runs it with arguments.
    fn run(program: &str, name: &str, arguments: &[&str]) -> Output {
        let executable = Path::new(TEMPORARY).join(name);
        let mut compiler = Command::new("cc");
        compiler.args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-g"]);
        compiler.args(["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]);
        compiler.arg("-I").arg(folder().join("include")).arg(folder().join(program)).arg(library());
        assert!(compiler.args(["-lm", "-o"]).arg(&executable).status().unwrap().success());
        Command::new(executable).args(arguments).output().unwrap()
    }

    #[test]
    fn misuse_is_reported_and_harmless() {
        for program in ["check", "check_scenes", "check_instrument"] {
            let output = run(&format!("{program}.c"), program, &[]);
            assert!(output.status.success(), "{program}: {}", String::from_utf8_lossy(&output.stderr));
        }
    }

    /// A program of the headers without a word of any later language.
    #[test]
    fn headers_are_valid_in_every_standard() {
        let program = "#include \"microimpact.h\"\n#include \"microimpact_link.h\"\n\
            #include \"microimpact_instrument_link.h\"\n\
            int main(void) { return microimpact_layout() == MICROIMPACT_LAYOUT ? 0 : 1; }\n";
        let languages: [(&str, &str, &[&str]); 2] =
            [("cc", "c", &["c90", "c99", "c11", "c17"]), ("c++", "cpp", &["c++98", "c++11", "c++17", "c++20"])];
        for (compiler, extension, standards) in languages {
            let source = Path::new(TEMPORARY).join(format!("standards.{extension}"));
            std::fs::write(&source, program).unwrap();
            for standard in standards {
                let mut command = Command::new(compiler);
                command.arg(format!("-std={standard}")).args([
                    "-pedantic",
                    "-Wall",
                    "-Wextra",
                    "-Werror",
                    "-fsyntax-only",
                ]);
                let output = command.arg("-I").arg(folder().join("include")).arg(&source).output().unwrap();
                assert!(output.status.success(), "{standard}: {}", String::from_utf8_lossy(&output.stderr));
            }
        }
    }

    #[test]
    fn program_of_the_guide_prints_what_its_page_shows() {
        let output = run("../guide/classify.c", "classify", &[]);
        let page = include_str!("../../../examples/guide/pages/step_5_programs.md");
        let printed = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && page.contains(&format!("```text\n{printed}```")), "{printed}");
    }

    #[test]
    fn the_sanitizer_sees_what_rust_writes() {
        let output = run("check.c", "overflow", &["overflow"]);
        let complaint = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success() && complaint.contains("heap-buffer-overflow"), "{complaint}");
    }

    #[test]
    fn results_are_those_of_rust_to_the_last_bit() {
        let output = run("results.c", "results", &[]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let printed = String::from_utf8(output.stdout).unwrap();
        assert_eq!(printed, c_results::expected().unwrap());
        let lines = |kind: &str| printed.lines().filter(|line| line.starts_with(kind)).count();
        assert_eq!(lines("rigid") + lines("contact"), 2 * c_results::MOTIONS.len());
        assert_eq!(lines("law"), 4 * c_results::MOTIONS.len());
        // Compliance by both rules of unloading: one phase, and several.
        assert_eq!(lines("compliant"), 2 * c_results::MOTIONS.len());
        for kind in ["power", "fixed-cost", "integers"] {
            assert_eq!(lines(kind), c_results::MOTIONS.len(), "{kind}");
        }
        let unsolved = printed.lines().filter(|line| line.ends_with("unsolved")).count();
        assert!(unsolved < c_results::MOTIONS.len() / 2, "{printed}");
        let phases: Vec<_> = printed
            .lines()
            .filter(|line| line.starts_with("compliant"))
            .filter_map(|line| line.split(' ').nth(4))
            .collect();
        assert!(phases.contains(&"1") && phases.contains(&"3"), "{phases:?}");
        // Every trajectory twice; in the least room it is four samples, or three of a sphere that does not begin to roll.
        assert_eq!(lines("trajectory"), 2 * c_results::MOTIONS.len());
        assert_eq!(lines("elastic"), 2 * c_results::MOTIONS.len());
        let starts = |line: &&str| line.starts_with("trajectory") || line.starts_with("elastic");
        let lengths: Vec<usize> = printed
            .split_inclusive('\n')
            .collect::<Vec<_>>()
            .chunk_by(|_, next| next.starts_with("sample"))
            .filter(|chunk| chunk.first().is_some_and(starts))
            .map(|chunk| chunk.len() - 1)
            .collect();
        assert!(lengths.chunks(2).all(|pair| pair[0] > 2 * pair[1]), "{lengths:?}");
        assert!([3, 4].iter().all(|least| lengths.contains(least)), "{lengths:?}");
        // Every verdict of each table, and both motions along the surface.
        let looked_up = c_results::RADII.len() * c_results::LOOKED_UP.len();
        for table in ["constant", "boundary", "restitution"] {
            assert_eq!(lines(table), looked_up);
            for verdict in ["0", "1", "2", "3"] {
                let said = |line: &str| line.starts_with(table) && line.split(' ').nth(3) == Some(verdict);
                assert!(printed.lines().any(said), "{table} {verdict}");
            }
        }
        // Rebound and capture on walls and of pairs.
        assert_eq!(lines("wall"), c_results::WALLS.len() * c_results::IN_SPACE.len());
        assert_eq!(lines("pair"), c_results::PAIRS.len());
        for (kind, column) in [("wall", 3), ("pair", 2)] {
            let classes: Vec<_> = printed
                .lines()
                .filter(|line| line.starts_with(kind))
                .filter_map(|line| line.split(' ').nth(column))
                .collect();
            for class in ["0", "1"] {
                assert!(classes.contains(&class), "{kind}: {classes:?}");
            }
            assert!(classes.iter().any(|class| ["2", "3", "4"].contains(class)), "{kind}: {classes:?}");
        }
        for surface_motion in ["0 1", "0 2"] {
            let said = |line: &str| {
                line.starts_with("restitution")
                    && line.split(' ').skip(3).take(2).collect::<Vec<_>>().join(" ") == surface_motion
            };
            assert!(printed.lines().any(said), "{surface_motion}");
        }
    }
}
