//! An emulated board with a serial line to this program, a button for reset, and a log.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use std::{fs, str};

use defmt_decoder::{DecodeError, Table};

use boards::Board;

/// An instruction takes 2^6 ns of emulated time.
const INSTRUCTION_TIME: &str = "shift=6";
const INSTRUCTION_NS: u64 = 1 << 6;
/// A tick of the board's clock, which QEMU takes for 200 MHz over the reset value of its divisor.
const TICK_NS: u64 = 80;
const LIMIT: Duration = Duration::from_secs(20);
const PROMPT: &str = "(qemu) ";

/// Instructions that take so many ticks.
pub(crate) fn instructions(ticks: u64) -> u64 {
    ticks * TICK_NS / INSTRUCTION_NS
}

/// A running board.
pub(crate) struct Session {
    emulator: Child,
    monitor: BufReader<TcpStream>,
}

impl Session {
    /// Starts a firmware and gives the other end of its serial line.
    pub(crate) fn start(board: &Board, firmware: &Path) -> Result<(Self, TcpStream), String> {
        let listener = || TcpListener::bind("127.0.0.1:0").and_then(|listener| Ok((listener.local_addr()?, listener)));
        let failed = |error: io::Error| format!("{}: cannot run {}: {error}", board.core, board.emulator.program);
        let (serial_address, serial) = listener().map_err(failed)?;
        let (monitor_address, monitor) = listener().map_err(failed)?;
        let log = Log::of(firmware)?;
        let mut emulator = Command::new(board.emulator.program)
            .args(["-machine", board.machine, "-display", "none", "-icount", INSTRUCTION_TIME])
            .args(["-serial", &format!("tcp:{serial_address},nodelay=on")])
            .args(["-monitor", &format!("tcp:{monitor_address}")])
            .args(["-semihosting-config", "enable=on,target=native"])
            .arg("-kernel")
            .arg(firmware)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(failed)?;
        if let Some(output) = emulator.stdout.take() {
            thread::spawn(move || log.print(output));
        }
        let serial = accept(&serial, &mut emulator).map_err(failed)?;
        let monitor = accept(&monitor, &mut emulator).map_err(failed)?;
        let mut session = Self { emulator, monitor: BufReader::new(monitor) };
        session.read_to_prompt().map_err(failed)?;
        Ok((session, serial))
    }

    /// Presses the button for reset.
    pub(crate) fn reset(&mut self) -> Result<(), String> {
        self.command("system_reset").map(drop)
    }

    /// A word of the board's memory or of a device.
    pub(crate) fn word(&mut self, address: u32) -> Result<u32, String> {
        let answer = self.command(&format!("xp /1wx {address:#x}"))?;
        let word = answer.lines().find_map(|line| line.split_once(": 0x")).map(|(_, word)| word.trim());
        let word = word.and_then(|word| u32::from_str_radix(word, 16).ok());
        word.ok_or_else(|| format!("the emulator's monitor says {answer}"))
    }

    fn command(&mut self, command: &str) -> Result<String, String> {
        let answer = writeln!(self.monitor.get_mut(), "{command}").and_then(|()| self.read_to_prompt());
        answer.map_err(|error| format!("the emulator's monitor does not answer: {error}"))
    }

    fn read_to_prompt(&mut self) -> io::Result<String> {
        let mut answer = Vec::new();
        while !answer.ends_with(PROMPT.as_bytes()) {
            if self.monitor.read_until(b' ', &mut answer)? == 0 {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
        }
        Ok(String::from_utf8_lossy(&answer).into_owned())
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        // Nothing is left to be done if the emulator has ended by itself.
        let _ = self.emulator.kill();
        let _ = self.emulator.wait();
    }
}

/// The connection that the emulator makes, unless it ends first.
fn accept(listener: &TcpListener, emulator: &mut Child) -> io::Result<TcpStream> {
    listener.set_nonblocking(true)?;
    let start = Instant::now();
    loop {
        match listener.accept() {
            Ok((stream, _)) => {
                stream.set_nonblocking(false)?;
                return Ok(stream);
            }
            Err(error) if error.kind() == io::ErrorKind::WouldBlock && start.elapsed() < LIMIT => {}
            Err(error) => return Err(error),
        }
        if let Some(status) = emulator.try_wait()? {
            return Err(io::Error::other(format!("it ended with {status}")));
        }
        thread::sleep(Duration::from_millis(10));
    }
}

/// What the firmware logs; its texts are in the file and not in the board's flash.
struct Log {
    table: Table,
}

impl Log {
    fn of(firmware: &Path) -> Result<Self, String> {
        let name = firmware.display();
        let bytes = fs::read(firmware).map_err(|error| format!("cannot read {name}: {error}"))?;
        match Table::parse(&bytes) {
            Ok(Some(table)) => Ok(Self { table }),
            Ok(None) => Err(format!("{name} does not log")),
            Err(error) => Err(format!("cannot understand the log of {name}: {error}")),
        }
    }

    /// Prints lines until the output ends.
    fn print(&self, mut output: ChildStdout) {
        let mut decoder = self.table.new_stream_decoder();
        let mut chunk = [0; 1024];
        while let Ok(length @ 1..) = output.read(&mut chunk) {
            decoder.received(&chunk[..length]);
            loop {
                match decoder.decode() {
                    Ok(frame) => {
                        let level = frame.level().map_or("", |level| level.as_str());
                        eprintln!("firmware: {level} {}", frame.display_message());
                    }
                    Err(DecodeError::UnexpectedEof) => break,
                    Err(DecodeError::Malformed) => eprintln!("firmware: a line of its log was damaged"),
                }
            }
        }
    }
}
