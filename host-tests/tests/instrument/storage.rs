//! Records in flash whose power fails.

use embassy_futures::block_on;
use embedded_storage_async::nor_flash::{
    ErrorType, MultiwriteNorFlash, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash,
};
use microimpact::{AdhesionConfig, DampingConfig, ModelConfig, SceneConfig};
use microimpact_storage::{MapConfigError, Record, Storage, StorageError};
use serde::{Deserialize, Serialize};

const PAGE: usize = 256;
const WORD: usize = 4;
const LENGTH: usize = 4 * PAGE;
const ERASED: u8 = 0xff;

/// Flash of four pages, whose power fails after so many bytes that are written or erased.
#[derive(Clone)]
struct Flash {
    bytes: [u8; LENGTH],
    power: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Failure {
    Power,
    OutOfBounds,
    /// A word that is not erased.
    Overwritten,
}

impl NorFlashError for Failure {
    fn kind(&self) -> NorFlashErrorKind {
        match self {
            Self::OutOfBounds => NorFlashErrorKind::OutOfBounds,
            Self::Power | Self::Overwritten => NorFlashErrorKind::Other,
        }
    }
}

impl Flash {
    fn new() -> Self {
        Self { bytes: [ERASED; LENGTH], power: usize::MAX }
    }

    /// Changes bytes one after the other while there is power.
    fn change(&mut self, from: usize, bytes: impl Iterator<Item = u8>) -> Result<(), Failure> {
        for (place, byte) in (from..).zip(bytes) {
            self.power = self.power.checked_sub(1).ok_or(Failure::Power)?;
            self.bytes[place] = byte;
        }
        Ok(())
    }
}

impl ErrorType for Flash {
    type Error = Failure;
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Failure> {
        let offset = offset as usize;
        let read = self.bytes.get(offset..offset + bytes.len()).ok_or(Failure::OutOfBounds)?;
        bytes.copy_from_slice(read);
        Ok(())
    }

    fn capacity(&self) -> usize {
        LENGTH
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = WORD;
    const ERASE_SIZE: usize = PAGE;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), Failure> {
        self.change(from as usize, (from..to).map(|_| ERASED))
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Failure> {
        let offset = offset as usize;
        let place = self.bytes.get(offset..offset + bytes.len()).ok_or(Failure::OutOfBounds)?;
        // Flash clears bits alone.
        if place.iter().zip(bytes).any(|(old, new)| new & !old != 0) {
            return Err(Failure::Overwritten);
        }
        self.change(offset, bytes.iter().copied())
    }
}

impl MultiwriteNorFlash for Flash {}

const ADDRESSES: core::ops::Range<u32> = 0..LENGTH as u32;

fn storage(flash: Flash) -> Storage<Flash, 128> {
    Storage::new(flash, ADDRESSES).unwrap()
}

/// The configuration of a given number.
fn config(number: u8) -> SceneConfig<f64> {
    let (damping, adhesion) =
        (DampingConfig::Hysteretic { zeta: f64::from(number) }, AdhesionConfig::Dmt { work: 0.1 });
    SceneConfig::solid(1e-6, 1000.0, ModelConfig::Contact { stiffness: 1e10, damping, adhesion, force: 0.0 })
}

fn save(flash: Flash, number: u8) -> (Result<(), StorageError<Failure>>, Flash) {
    let mut storage = storage(flash);
    let saved = block_on(storage.save(&config(number)));
    (saved, storage.release())
}

fn load(flash: &Flash) -> Result<Option<SceneConfig<f64>>, StorageError<Failure>> {
    block_on(storage(flash.clone()).load())
}

#[test]
fn latest_configuration_is_read() {
    assert_eq!(load(&Flash::new()), Ok(None));
    let mut flash = Flash::new();
    for number in 0..50 {
        let (saved, after) = save(flash, number);
        assert_eq!((saved, load(&after)), (Ok(()), Ok(Some(config(number)))));
        flash = after;
    }
}

/// Each write of each of many saves, which go round all pages, is cut at each byte. The next start finds the earlier or the later
/// configuration, and can save another.
#[test]
fn power_loss_at_any_byte_loses_nothing() {
    const SAVES: u8 = 20;
    let (_, mut flash) = save(Flash::new(), 0);
    let mut cuts = [0; 2];
    for number in 1..SAVES {
        for power in 0.. {
            let (saved, cut) = save(Flash { power, ..flash.clone() }, number);
            if saved.is_ok() {
                break;
            }
            assert_eq!(saved, Err(StorageError::Flash(Failure::Power)));
            let restarted = Flash { power: usize::MAX, ..cut };
            let found = load(&restarted);
            let is_later = found == Ok(Some(config(number)));
            assert!(is_later || found == Ok(Some(config(number - 1))), "save {number}, cut at {power}: {found:?}");
            cuts[usize::from(is_later)] += 1;
            let (saved, after) = save(restarted, 99);
            assert_eq!((saved, load(&after)), (Ok(()), Ok(Some(config(99)))), "save {number}, cut at {power}");
        }
        (_, flash) = save(flash, number);
    }
    // Power has failed while pages were erased, too.
    assert!(cuts[0] > usize::from(SAVES) * 100 && cuts[0] > 2 * PAGE, "{cuts:?}");
}

/// Settings of another firmware under the same key.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Later {
    radius: f32,
}

impl Record for Later {
    const KEY: u8 = <SceneConfig<f64> as Record>::KEY;
    const SCHEMA: u16 = 2;
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Mistaken(u8);

impl Record for Mistaken {
    const KEY: u8 = <SceneConfig<f64> as Record>::KEY;
    const SCHEMA: u16 = <SceneConfig<f64> as Record>::SCHEMA;
}

#[test]
fn records_of_other_firmware_are_named() {
    let (_, flash) = save(Flash::new(), 1);
    let mut storage = storage(flash);
    let found = <SceneConfig<f64> as Record>::SCHEMA;
    assert_eq!(block_on(storage.load::<Later>()), Err(StorageError::Schema { found, expected: 2 }));
    // Numbers of another type are not misread.
    assert!(matches!(block_on(storage.load::<SceneConfig<f32>>()), Err(StorageError::Schema { .. })));
    assert_eq!(block_on(storage.load::<Mistaken>()), Err(StorageError::Content));
    block_on(storage.save(&Later { radius: 1.0 })).unwrap();
    assert_eq!(block_on(storage.load()), Ok(Some(Later { radius: 1.0 })));
}

/// The longest configuration fits the buffer that the documentation states.
#[test]
fn longest_configuration_fits() {
    let mut storage = Storage::<_, 80>::new(Flash::new(), ADDRESSES).unwrap();
    let damping = DampingConfig::Hysteretic { zeta: 10.5 };
    let adhesion = AdhesionConfig::Ring { strength: 250.0, zeta: 6.25 };
    let model = ModelConfig::Contact { stiffness: 1e10, damping, adhesion, force: 0.0 };
    let longest = SceneConfig::solid(1e-6, 1000.0, model);
    block_on(storage.save(&longest)).unwrap();
    assert_eq!(block_on(storage.load()), Ok(Some(longest)));
}

#[test]
fn pages_and_buffers_that_do_not_do_are_refused() {
    assert_eq!(Storage::<_, 128>::new(Flash::new(), 0..PAGE as u32).err(), Some(MapConfigError::RangeTooSmall));
    assert_eq!(
        Storage::<_, 128>::new(Flash::new(), 3..LENGTH as u32).err(),
        Some(MapConfigError::StartRangeNotAtPageBoundary)
    );
    let mut short = Storage::<_, 16>::new(Flash::new(), ADDRESSES).unwrap();
    assert_eq!(block_on(short.save(&config(1))), Err(StorageError::TooLong));
    let mut foreign = storage(Flash { bytes: [0x5a; LENGTH], power: usize::MAX });
    assert!(block_on(foreign.load::<SceneConfig<f64>>()).is_err_and(|error| !error.to_string().is_empty()));
}
