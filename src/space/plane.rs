//! The plane of an impact: normal, slip, and the axis across both.

use super::vector::{Vector, across, add, cross, dot, polar, scaled};
use crate::{Fault, InputError, Parameter, Real};

/// The directions of an impact: the normal n, the direction t of the slip or, where nothing slips, of the tangential velocity, and
/// n x t.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Plane<T> {
    pub(super) normal: Vector<T>,
    pub(super) tangent: Vector<T>,
    pub(super) axis: Vector<T>,
}

/// Largest deviation from unit length with which a normal is taken for one that was rounded.
const LENGTH_TOLERANCE: f64 = 1e-3;

/// Roundings of a velocity within which its tangential part is none: so much may be left of its normal part.
const ROUNDINGS: f64 = 16.0;

/// A direction of unit length.
pub(super) fn unit<T: Real>(direction: Vector<T>) -> Result<Vector<T>, InputError> {
    let (length, unit) = match direction.iter().find(|component| !component.is_finite()) {
        Some(component) => (*component, direction),
        None => polar(direction).unwrap_or((T::ZERO, direction)),
    };
    let (least, most) = (T::constant(1.0 - LENGTH_TOLERANCE), T::constant(1.0 + LENGTH_TOLERANCE));
    if length >= least && length <= most {
        return Ok(unit);
    }
    let fault = if !length.is_finite() {
        Fault::NotFinite
    } else if length < least {
        Fault::TooSmall
    } else {
        Fault::TooLarge
    };
    Err(InputError { parameter: Parameter::NormalLength, fault, value: length.to_f64() as f32 })
}

impl<T: Real> Plane<T> {
    /// The plane of a normal in which a velocity of the contact point lies; where that has no tangential part, in which a velocity of
    /// the centre lies. Parts are none that are no larger than the rounding of the `largest` velocity.
    pub(super) fn of(normal: Vector<T>, contact_point: Vector<T>, centre: Vector<T>, largest: T) -> Self {
        let least = T::constant(ROUNDINGS) * T::EPSILON * largest;
        let tangent = Self::along(normal, contact_point, least).or_else(|| Self::along(normal, centre, least));
        let tangent = tangent.unwrap_or_else(|| across(normal));
        Self { normal, tangent, axis: cross(normal, tangent) }
    }

    /// Direction of the tangential part of a velocity, if that is larger than `least`.
    fn along(normal: Vector<T>, velocity: Vector<T>, least: T) -> Option<Vector<T>> {
        let tangential = add(velocity, -dot(velocity, normal), normal);
        let (_, direction) = polar(tangential).filter(|(length, _)| *length > least)?;
        // What rounding has left along the normal, which is not much of it.
        polar(add(direction, -dot(direction, normal), normal)).map(|(_, direction)| direction)
    }

    /// A vector in the plane from its components.
    pub(super) fn vector(&self, normal: T, tangential: T) -> Vector<T> {
        add(scaled(self.normal, normal), tangential, self.tangent)
    }
}
