//! Bins of speed and of size.

use crate::{Fault, InputError, Parameter, Real};

/// Bins of approach speed. Each bin ends below its edge and begins at the edge before it; the first begins at zero.
///
/// ```
/// use microimpact::instrument::SpeedBins;
///
/// let bins = SpeedBins::new([1.0, 2.0, 5.0])?;
/// assert_eq!((bins.bin(0.5), bins.bin(1.0), bins.bin(5.0)), (Some(0), Some(1), None));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "Edges<T, BINS>",
        bound(serialize = "T: serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct SpeedBins<T, const BINS: usize> {
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    edges: [T; BINS],
}

impl<T: Real, const BINS: usize> SpeedBins<T, BINS> {
    /// Creates bins from their upper `edges`, m/s.
    ///
    /// # Errors
    /// An edge is outside the range of approach speeds, or not above the edge before it.
    ///
    /// ```
    /// use microimpact::instrument::SpeedBins;
    ///
    /// assert!(SpeedBins::new([1.0_f32, 3.0, 10.0]).is_ok());
    /// assert!(SpeedBins::new([3.0_f32, 1.0, 10.0]).is_err());
    /// ```
    pub fn new(edges: [T; BINS]) -> Result<Self, InputError> {
        check_edges(Parameter::ApproachSpeed, &edges)?;
        Ok(Self { edges })
    }

    /// Upper edges of the bins, m/s.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::SpeedBins::new([1.0, 2.0])?.edges(), &[1.0, 2.0]);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn edges(&self) -> &[T; BINS] {
        &self.edges
    }

    /// Index of the bin that contains a `speed` (m/s); `None` from the last edge on.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::SpeedBins::new([1.0, 2.0])?.bin(1.5), Some(1));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn bin(&self, speed: T) -> Option<usize> {
        position(&self.edges, speed)
    }
}

/// Bins of particle radius. Each bin ends below its edge and begins at the edge before it; the first begins at zero.
///
/// ```
/// use microimpact::instrument::SizeBins;
///
/// let bins = SizeBins::new([1e-6, 2e-6, 5e-6])?;
/// assert_eq!((bins.bin(0.5e-6), bins.bin(1e-6), bins.bin(5e-6)), (Some(0), Some(1), None));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "Edges<T, BINS>",
        bound(serialize = "T: serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct SizeBins<T, const BINS: usize> {
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    edges: [T; BINS],
}

impl<T: Real, const BINS: usize> SizeBins<T, BINS> {
    /// Creates bins from their upper `edges`, m.
    ///
    /// # Errors
    /// An edge is outside the range of radii, or not above the edge before it.
    ///
    /// ```
    /// use microimpact::instrument::SizeBins;
    ///
    /// assert!(SizeBins::new([1e-6_f32, 3e-6]).is_ok());
    /// assert!(SizeBins::new([3e-6_f32, 1e-6]).is_err());
    /// ```
    pub fn new(edges: [T; BINS]) -> Result<Self, InputError> {
        check_edges(Parameter::Radius, &edges)?;
        Ok(Self { edges })
    }

    /// Upper edges of the bins, m.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::SizeBins::new([1e-6, 2e-6])?.edges(), &[1e-6, 2e-6]);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn edges(&self) -> &[T; BINS] {
        &self.edges
    }

    /// Index of the bin that contains a `radius` (m); `None` from the last edge on.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::SizeBins::new([1e-6, 2e-6])?.bin(1.5e-6), Some(1));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn bin(&self, radius: T) -> Option<usize> {
        position(&self.edges, radius)
    }
}

/// Checks that each edge is a valid value of the `parameter` and lies above the edge before it.
fn check_edges<T: Real>(parameter: Parameter, edges: &[T]) -> Result<(), InputError> {
    let mut before = T::ZERO;
    for &edge in edges {
        if parameter.check(edge)? <= before {
            return Err(InputError { parameter, fault: Fault::OutOfOrder, value: edge.to_f64() as f32 });
        }
        before = edge;
    }
    Ok(())
}

/// Index of the first edge above a value.
#[inline]
fn position<T: Real>(edges: &[T], value: T) -> Option<usize> {
    edges.iter().position(|&edge| value < edge)
}

/// Deserialized bins that are not checked yet.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(bound(deserialize = "T: serde::Deserialize<'de>"))]
struct Edges<T, const BINS: usize> {
    #[serde(with = "serde_big_array::BigArray")]
    edges: [T; BINS],
}

#[cfg(feature = "serde")]
impl<T: Real, const BINS: usize> TryFrom<Edges<T, BINS>> for SpeedBins<T, BINS> {
    type Error = InputError;

    fn try_from(outside: Edges<T, BINS>) -> Result<Self, InputError> {
        Self::new(outside.edges)
    }
}

#[cfg(feature = "serde")]
impl<T: Real, const BINS: usize> TryFrom<Edges<T, BINS>> for SizeBins<T, BINS> {
    type Error = InputError;

    fn try_from(outside: Edges<T, BINS>) -> Result<Self, InputError> {
        Self::new(outside.edges)
    }
}
