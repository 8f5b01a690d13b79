//! A program that solves the regularised equations on request, over a pipe.
//!
//! It reads commands, a line each, and answers every one at once:
//!
//! | command | answer |
//! | --- | --- |
//! | `version` | its solver's version |
//! | `scenes COUNT`, then a line `A B h g SPEED` for each | the names of its methods for them |
//! | `solve METHOD TOLERANCE OUTPUTS` | a line `SPEED TIME IMPULSE` at separation for each scene, `nan` for what is unknown |
//! | `time METHOD TOLERANCE OUTPUTS REPEATS` | seconds that all scenes take, and how many of them are not the solver's |
//!
//! `OUTPUTS` is 1 if time and impulse are asked for, else 0.

use std::cell::RefCell;
use std::io::{BufRead, BufReader, Lines, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::rc::Rc;

use crate::contestant::{Answer, Asked, Contestant, Solver, tolerances};
use crate::problem::Problem;
use crate::race::Sample;

/// A running program; it ends when it is dropped.
pub struct Program {
    name: &'static str,
    version: String,
    pipe: Rc<RefCell<Pipe>>,
}

struct Pipe {
    child: Child,
    input: ChildStdin,
    output: Lines<BufReader<ChildStdout>>,
}

impl Program {
    /// Starts a program.
    ///
    /// # Errors
    /// It does not start, or does not answer.
    pub fn start(name: &'static str, command: &mut Command) -> Result<Self, String> {
        let child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
        let mut child = child.map_err(|error| format!("{name} does not start: {error}"))?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(format!("{name} has no pipes"));
        };
        let mut pipe = Pipe { child, input, output: BufReader::new(output).lines() };
        let version = pipe.ask("version").ok_or_else(|| format!("{name} does not answer"))?;
        Ok(Self { name, version, pipe: Rc::new(RefCell::new(pipe)) })
    }

    /// Its name, and the version of its solver.
    pub fn title(&self) -> String {
        format!("{} {}", self.name, self.version)
    }

    /// All of its methods and settings on impacts, one after another. Those of impacts given before are void.
    pub fn contestants(&self, problems: &Rc<[Problem]>, asked: Asked) -> Vec<Contestant> {
        let mut request = format!("scenes {}", problems.len());
        for problem in problems.iter() {
            let dampings = [problem.material_damping, problem.adhesion_damping];
            let numbers = [problem.elastic, problem.adhesion, dampings[0], dampings[1], problem.speed()];
            request += &format!("\n{}", numbers.map(|number| format!("{number:e}")).join(" "));
        }
        let methods = self.pipe.borrow_mut().ask(&request).expect("the program names its methods");
        let contestant = |method: &str, tolerance: f64| {
            let setting = format!("{method} {tolerance:e} {}", u8::from(asked == Asked::Outputs));
            let solver = Asker { pipe: Rc::clone(&self.pipe), problems: Rc::clone(problems), setting };
            Contestant::of(self.name, method.replace('_', " "), format!("{tolerance:.0e}"), solver)
        };
        let settings = methods.split_whitespace().flat_map(|method| tolerances().map(move |one| (method, one)));
        settings.map(|(method, tolerance)| contestant(method, tolerance)).collect()
    }
}

impl Pipe {
    fn ask(&mut self, request: &str) -> Option<String> {
        writeln!(self.input, "{request}").ok()?;
        self.input.flush().ok()?;
        self.line()
    }

    fn line(&mut self) -> Option<String> {
        self.output.next()?.ok()
    }
}

impl Drop for Pipe {
    fn drop(&mut self) {
        // If it has ended already, there is nothing to end.
        _ = self.child.kill();
        _ = self.child.wait();
    }
}

/// One setting of a program.
struct Asker {
    pipe: Rc<RefCell<Pipe>>,
    problems: Rc<[Problem]>,
    setting: String,
}

impl Solver for Asker {
    fn solve(&mut self, tell: &mut dyn FnMut(Option<Answer>)) {
        let mut pipe = self.pipe.borrow_mut();
        let mut line = pipe.ask(&format!("solve {}", self.setting));
        for (index, problem) in self.problems.iter().enumerate() {
            if index > 0 {
                line = pipe.line();
            }
            let numbers: Option<[f64; 3]> = line.as_deref().and_then(numbers);
            tell(numbers.filter(|[speed, ..]| speed.is_finite()).map(|[speed, time, impulse]| {
                let answer = problem.answer([0.0, speed, time, impulse], None);
                let known = |value: Option<f64>| value.filter(|value| value.is_finite());
                Answer { contact_time: known(answer.contact_time), impulse: known(answer.impulse), ..answer }
            }));
        }
    }

    fn time(&mut self, repeats: u32) -> Sample {
        let answer = self.pipe.borrow_mut().ask(&format!("time {} {repeats}", self.setting));
        let [whole, beside] = answer.as_deref().and_then(numbers).expect("the program tells its time");
        Sample { whole, beside }
    }
}

/// As many numbers as are expected.
fn numbers<const N: usize>(line: &str) -> Option<[f64; N]> {
    let numbers: Vec<f64> = line.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    numbers.try_into().ok()
}
