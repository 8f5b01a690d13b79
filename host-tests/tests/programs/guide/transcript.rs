//! The guide's commands print what it shows below them.
//!
//! A block `sh` has commands; a block `text` that follows it has what they print, where a line of three dots stands for any lines.

use std::cell::RefCell;
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::rc::Rc;

use clap::Parser;
use microimpact_cli::{Arguments, Streams};

use super::{folder, keep_current, page, pages, repository};

/// What stands for lines that are not shown.
const LEFT_OUT: &str = "...";

/// Commands of the guide that this test does not run, the file of the gate that runs them, and how they begin there.
const ELSEWHERE: [(&str, &str, &str); 6] = [
    ("cargo install --locked", ".ci/run", "cargo install --locked"),
    (
        "cargo build --release --locked --manifest-path examples/c",
        ".ci/run",
        "cargo build --release --locked --manifest-path examples/c",
    ),
    ("cc -I examples/c/include", ".ci/run", "cc -I examples/c/include"),
    ("target/classify", ".ci/run", "target/classify"),
    ("cargo qemu instrument", ".ci/run", "cargo qemu instrument"),
    ("pip install ./examples/python", "examples/python/check.sh", "\"./examples/python"),
];

/// A block of commands, and what follows it.
struct Block {
    commands: Vec<String>,
    shown: Option<String>,
}

/// The lines of a text up to the end of a block, and the rest.
fn block(text: &str) -> (&str, &str) {
    text.split_once("\n```\n").expect("the block ends")
}

/// The blocks of a page, and the page with what they print.
fn blocks(page: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    for part in page.split("\n```sh\n").skip(1) {
        let (commands, rest) = block(part);
        let commands = commands.replace("\\\n", " ").lines().map(str::to_owned).collect();
        let shown = rest.strip_prefix("\n```text").map(|text| block(text).0.trim_start_matches('\n').to_owned());
        blocks.push(Block { commands, shown });
    }
    blocks
}

/// Both streams of a terminal.
#[derive(Clone, Default)]
struct Terminal(Rc<RefCell<Vec<u8>>>);

impl Write for Terminal {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The words of a command, as a shell splits them.
fn words(command: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quote = None;
    for letter in command.chars() {
        match (letter, quote) {
            ('\'' | '"', None) => quote = Some(letter),
            (letter, Some(open)) if letter == open => quote = None,
            (' ', None) => words.push(String::new()),
            ('#', None) if words.last().is_some_and(String::is_empty) => break,
            (letter, _) => words.last_mut().unwrap().push(letter),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// A file of the repository, or one that the guide writes, for which a folder of its own takes the place of `target`.
fn located(word: &str, page: &str) -> String {
    let own = Path::new(env!("CARGO_TARGET_TMPDIR")).join("guide").join(page);
    fs::create_dir_all(&own).unwrap();
    for (option, path) in [word.split_once('=').unwrap_or(("", word)), ("", word)] {
        let option = if option.is_empty() { String::new() } else { format!("{option}=") };
        if let Some(name) = path.strip_prefix("target/") {
            return option + own.join(name).to_str().unwrap();
        }
        if path.starts_with("examples/") || path.starts_with("host-tests/") {
            return option + repository().join(path).to_str().unwrap();
        }
    }
    word.to_owned()
}

/// Runs one command of a pipe.
fn run(command: &str, page: &str, mut input: &[u8], output: &mut dyn Write, errors: &mut dyn Write) -> u8 {
    let words: Vec<_> = words(command).iter().map(|word| located(word, page)).collect();
    match &words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["head", "-n", count, file] => {
            let text = fs::read_to_string(file).unwrap();
            text.split_inclusive('\n').take(count.parse().unwrap()).for_each(|line| write!(output, "{line}").unwrap());
            0
        }
        ["printf", text] => {
            write!(output, "{}", text.replace("\\n", "\n")).unwrap();
            0
        }
        ["cargo", "microimpact", arguments @ ..] | ["microimpact", arguments @ ..] => {
            let arguments = ["microimpact"].iter().chain(arguments);
            match Arguments::try_parse_from(arguments) {
                Ok(arguments) => arguments.run(&mut Streams { input: &mut input, output, errors }),
                Err(message) => {
                    write!(errors, "{message}").unwrap();
                    u8::try_from(message.exit_code()).unwrap()
                }
            }
        }
        _ => panic!("{page}: this test cannot run `{command}`"),
    }
}

/// Whether something else runs a command, or only the exhaustive tests do: seven laws compete for half a minute in a build for tests.
fn is_left_out(command: &str) -> bool {
    let is_long = command.starts_with("microimpact fit") && !command.contains("--law");
    let exhaustive = std::env::var_os("MICROIMPACT_EXHAUSTIVE").is_some();
    ELSEWHERE.iter().any(|(prefix, ..)| command.starts_with(prefix)) || (is_long && !exhaustive)
}

/// What a command prints on a terminal. A remark `# exit status 1` states its status, otherwise 0.
fn printed(line: &str, page: &str) -> String {
    let terminal = Terminal::default();
    let (command, file) = line.split_once(" > ").unwrap_or((line, ""));
    let mut input = Vec::new();
    let mut status = 0;
    let mut commands = command.split(" | ").peekable();
    while let Some(command) = commands.next() {
        let mut output = Vec::new();
        if commands.peek().is_none() && file.is_empty() {
            status = run(command, page, &input, &mut terminal.clone(), &mut terminal.clone());
        } else {
            status = run(command, page, &input, &mut output, &mut terminal.clone());
        }
        input = output;
    }
    if let Some(file) = words(file).first() {
        fs::write(located(file, page), input).unwrap();
    }
    let expected = line.split_once("# exit status ").map_or(0, |(_, status)| status.parse().unwrap());
    let text = String::from_utf8(terminal.0.take()).unwrap();
    assert_eq!(status, expected, "{page}: {line}\n{text}");
    text
}

/// Whether a text is what is shown, except for lines that are left out.
fn is_shown(shown: &str, printed: &str) -> bool {
    let mut rest = format!("{}\n", printed.trim_end());
    let mut left_out = false;
    for part in shown.split_inclusive('\n') {
        let line = part.trim_end();
        if line == LEFT_OUT {
            left_out = true;
            continue;
        }
        let line = format!("{line}\n");
        let found = if left_out { rest.find(&line) } else { rest.starts_with(&line).then_some(0) };
        let Some(place) = found else { return false };
        rest = rest.split_off(place + line.len());
        left_out = false;
    }
    left_out || rest.is_empty()
}

fn check(name: &str) {
    for Block { commands, shown } in blocks(&page(name)) {
        if commands.iter().any(|command| is_left_out(command)) {
            continue;
        }
        let text: String = commands.iter().map(|command| without_trailing_spaces(&printed(command, name))).collect();
        if let Some(shown) = shown {
            assert!(is_shown(&shown, &text), "{name}: {commands:?} prints\n{text}");
        }
    }
}

/// Lines end without spaces in the guide.
fn without_trailing_spaces(text: &str) -> String {
    text.lines().map(|line| format!("{}\n", line.trim_end())).collect()
}

#[test]
fn commands_print_what_the_guide_shows() {
    let names = pages();
    std::thread::scope(|scope| {
        for name in &names {
            scope.spawn(|| check(name));
        }
    });
}

#[test]
fn the_gate_runs_the_other_commands() {
    for (command, file, line) in ELSEWHERE {
        let gate = fs::read_to_string(repository().join(file)).unwrap();
        let runs = gate.lines().any(|text| text.trim_start().starts_with(line) || text.contains(&format!(" {line}")));
        assert!(runs, "{file} does not run {command}");
    }
}

#[test]
fn a_text_that_differs_is_noticed() {
    let printed = "a\nb\nc\nd\n";
    for shown in ["a\nb\nc\nd", "a\n...\nd", "...\nc\nd", "a\n..."] {
        assert!(is_shown(shown, printed), "{shown}");
    }
    for shown in ["a\nb\nc", "a\nd", "...\nc", "b\n...", "a\n...\ne"] {
        assert!(!is_shown(shown, printed), "{shown}");
    }
}

/// Writes what the commands print below them, where nothing is left out.
#[test]
#[ignore = "writes the guide's pages anew"]
fn write_transcripts() {
    for name in pages() {
        let mut text = page(&name);
        for Block { commands, shown } in blocks(&text.clone()) {
            let Some(shown) = shown.filter(|shown| !shown.lines().any(|line| line == LEFT_OUT)) else { continue };
            if commands.iter().any(|command| is_left_out(command)) {
                continue;
            }
            let printed: String =
                commands.iter().map(|command| without_trailing_spaces(&printed(command, &name))).collect();
            let command = commands.last().unwrap();
            let block = |content: &str| format!("{command}\n```\n\n```text\n{content}```");
            let ended = |text: &str| if text.is_empty() { String::new() } else { format!("{text}\n") };
            text = text.replacen(&block(&ended(&shown)), &block(&ended(printed.trim_end())), 1);
        }
        keep_current(folder().join("pages").join(name), &text, true);
    }
}
