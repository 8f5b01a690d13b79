//! `cargo qemu templates`: the firmware to start from, on emulated boards. What each counts is compared with what the host finds.

use boards::packages::Permission;
use boards::toolchain::Choice;
use boards::{BOARDS, Board, INSTRUMENT_BOARD, NO_ATOMICS_BOARD, REFERENCE_CORE, emulator, firmware};
use microimpact::Class;
use microimpact::instrument::{ClassSet, PlanarReading, Reading};
use microimpact_templates::{READINGS, Scene, read_sensor, scene};

/// Binaries, each with its feature and the place of its board: that of the reference core, of the instrument, whose interrupts one
/// names, or without atomic instructions.
const TEMPLATES: [(&str, &str, usize); 4] =
    [("bare", "bare", 0), ("with_embassy", "embassy", 0), ("with_rtic", "rtic", 1), ("riscv", "riscv", 2)];

/// Every template that does not print what the host finds.
pub(crate) fn compare(choice: Choice, permission: Permission) -> Result<Vec<String>, String> {
    let reference =
        BOARDS.into_iter().find(|board| board.core == REFERENCE_CORE).ok_or("there is no reference core")?;
    let boards = [reference, INSTRUMENT_BOARD, NO_ATOMICS_BOARD];
    let toolchain = crate::tools(choice, &boards, permission)?;
    let expected = expected()?;
    let mut failures = Vec::new();
    for (binary, feature, place) in TEMPLATES {
        let board: &Board = &boards[place];
        eprintln!("building {binary} for {} and running it on {} ...", board.core, board.machine);
        let folder = firmware::build_template(&toolchain, board, feature, binary)?;
        let printed = emulator::run(board, &folder.join(binary))?;
        println!("{binary}:\n{printed}");
        if printed != expected {
            failures.push(format!("{binary} printed\n{printed}instead of\n{expected}"));
        }
    }
    Ok(failures)
}

/// What a template prints if it loses nothing: the classes of all readings, here in f64 and without queue and tally.
fn expected() -> Result<String, String> {
    let scene: Scene<f64> = scene().map_err(|error| error.to_string())?;
    let classes: Vec<Option<Class>> = (0..READINGS).map(|number| class(&scene, &read_sensor(number))).collect();
    let count = |wanted| classes.iter().filter(|class| **class == wanted).count();
    let mut text: String = Class::ALL.iter().map(|&class| format!("{class}: {}\n", count(Some(class)))).collect();
    text.push_str(&format!("refused: {}\nlost: 0\n", count(None)));
    Ok(text)
}

/// The class of a reading, if a particle can have it.
fn class(scene: &Scene<f64>, reading: &PlanarReading<f32>) -> Option<Class> {
    let PlanarReading { approach, tangential, peripheral } = reading;
    let [approach, tangential, peripheral] = [approach, tangential, peripheral].map(|&speed| f64::from(speed));
    let motion = PlanarReading { approach, tangential, peripheral }.motion().ok()?;
    Some(scene.classify(&motion).class())
}
