//! Records of an instrument in NOR flash: its configuration, and what else must survive a restart.
//!
//! Each kind of [`Record`] has a key and the version of its schema. A record is written in the format of postcard behind its
//! version, and `sequential-storage` adds a CRC, spreads the wear over the pages, and keeps the earlier record until the later one
//! is complete. So whenever power is lost, the next start finds the one or the other.
//!
//! The flash is a driver with the traits of `embedded-storage-async`. For a driver with the blocking traits there is
//! `embassy_embedded_hal::adapter::BlockingAsync`.

#![no_std]
#![forbid(unsafe_code)]

use core::fmt;
use core::ops::Range;

use embedded_storage_async::nor_flash::NorFlash;
use microimpact::SceneConfig;
use sequential_storage::cache::{Cache, Uncached};
use sequential_storage::map::{MapConfig, MapStorage};
use serde::Serialize;
use serde::de::DeserializeOwned;

pub use sequential_storage::map::MapConfigError;

/// What is kept, one value of each kind.
pub trait Record: Serialize + DeserializeOwned {
    /// The kind. No two kinds in the same flash have the same key.
    const KEY: u8;
    /// Version of the fields of the type. It changes when they do, so that firmware never misreads what other firmware wrote.
    const SCHEMA: u16;
}

/// Version of the fields of [`SceneConfig`].
const SCENE: u16 = 1;

/// Added to a version where numbers are of double precision.
const DOUBLE: u16 = 0x8000;

impl Record for SceneConfig<f32> {
    const KEY: u8 = 0;
    const SCHEMA: u16 = SCENE;
}

impl Record for SceneConfig<f64> {
    const KEY: u8 = 0;
    const SCHEMA: u16 = SCENE | DOUBLE;
}

/// Bytes of the version in front of a record.
const VERSION_BYTES: usize = size_of::<u16>();

/// Why a record is not to be had, for a flash with errors `E`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StorageError<E> {
    /// The record was written with another version of its schema. Save a new one over it.
    Schema {
        /// The version found.
        found: u16,
        /// The version of this firmware.
        expected: u16,
    },
    /// The record does not have the fields of its schema. Save a new one over it.
    Content,
    /// The record is longer than the buffer.
    TooLong,
    /// The records do not fit the pages of flash.
    Full,
    /// The pages of flash contain something else. Erase them.
    Corrupted,
    /// An error of the flash itself.
    Flash(E),
}

impl<E: fmt::Debug> fmt::Display for StorageError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Schema { found, expected } => {
                write!(
                    f,
                    "the record has schema {found}, but this firmware reads {expected}; save a new record over it"
                )
            }
            Self::Content => f.write_str("the record does not have the fields of its schema; save a new one over it"),
            Self::TooLong => f.write_str("the record is longer than the buffer; give the storage a longer one"),
            Self::Full => f.write_str("the records do not fit the pages of flash; give the storage more pages"),
            Self::Corrupted => f.write_str("the pages of flash contain something else; erase them"),
            Self::Flash(error) => write!(f, "the flash failed: {error:?}"),
        }
    }
}

impl<E: fmt::Debug> core::error::Error for StorageError<E> {}

impl<E> From<sequential_storage::Error<E>> for StorageError<E> {
    fn from(error: sequential_storage::Error<E>) -> Self {
        match error {
            sequential_storage::Error::Storage { value, .. } => Self::Flash(value),
            sequential_storage::Error::FullStorage | sequential_storage::Error::ItemTooBig => Self::Full,
            sequential_storage::Error::BufferTooBig | sequential_storage::Error::BufferTooSmall(_) => Self::TooLong,
            _ => Self::Corrupted,
        }
    }
}

/// Records in some pages of flash. `BYTES` is the length of the longest record, and three bytes for its key and version, rounded up to
/// words of the flash: 80 for a [`SceneConfig`] in double precision, whose longest has 75 bytes.
pub struct Storage<F: NorFlash, const BYTES: usize> {
    records: MapStorage<u8, F, Cache<Uncached, Uncached, Uncached, u8>>,
    buffer: [u8; BYTES],
}

impl<F: NorFlash, const BYTES: usize> Storage<F, BYTES> {
    /// Records in the pages at these addresses, at least two pages.
    ///
    /// # Errors
    /// The addresses are not those of whole pages, or there is only one.
    pub fn new(flash: F, addresses: Range<u32>) -> Result<Self, MapConfigError> {
        let pages = MapConfig::try_new(addresses)?;
        Ok(Self { records: MapStorage::new(flash, pages, Cache::new_uncached()), buffer: [0; BYTES] })
    }

    /// Writes a record in the place of the earlier one of its kind.
    ///
    /// # Errors
    /// It is too long, or the flash fails. The earlier record is then still there.
    pub async fn save<R: Record>(&mut self, record: &R) -> Result<(), StorageError<F::Error>> {
        let mut written = [0; BYTES];
        let (version, fields) = written.split_first_chunk_mut::<VERSION_BYTES>().ok_or(StorageError::TooLong)?;
        *version = R::SCHEMA.to_le_bytes();
        let length = postcard::to_slice(record, fields).map_err(|_| StorageError::TooLong)?.len();
        let written = written.get(..VERSION_BYTES + length).ok_or(StorageError::TooLong)?;
        Ok(self.records.store_item(&mut self.buffer, &R::KEY, &written).await?)
    }

    /// The latest record of a kind; `None` if there never was one.
    ///
    /// # Errors
    /// The record has another schema, or the flash fails.
    pub async fn load<R: Record>(&mut self) -> Result<Option<R>, StorageError<F::Error>> {
        let Some(read) = self.records.fetch_item::<&[u8]>(&mut self.buffer, &R::KEY).await? else {
            return Ok(None);
        };
        let (version, fields) = read.split_first_chunk::<VERSION_BYTES>().ok_or(StorageError::Content)?;
        let (found, expected) = (u16::from_le_bytes(*version), R::SCHEMA);
        if found != expected {
            return Err(StorageError::Schema { found, expected });
        }
        match postcard::take_from_bytes(fields) {
            Ok((record, [])) => Ok(Some(record)),
            _ => Err(StorageError::Content),
        }
    }

    /// The flash, as for a driver that is used elsewhere too.
    pub fn release(self) -> F {
        self.records.destroy().0
    }
}
