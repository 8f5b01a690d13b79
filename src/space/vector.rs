//! Vectors of three numbers.

use crate::Real;

pub(super) type Vector<T> = [T; 3];

#[inline]
pub(super) fn dot<T: Real>([a, b, c]: Vector<T>, [x, y, z]: Vector<T>) -> T {
    a * x + b * y + c * z
}

#[inline]
pub(super) fn cross<T: Real>([a, b, c]: Vector<T>, [x, y, z]: Vector<T>) -> Vector<T> {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// a + factor b.
#[inline]
pub(super) fn add<T: Real>([a, b, c]: Vector<T>, factor: T, [x, y, z]: Vector<T>) -> Vector<T> {
    [a + factor * x, b + factor * y, c + factor * z]
}

#[inline]
pub(super) fn scaled<T: Real>(vector: Vector<T>, factor: T) -> Vector<T> {
    vector.map(|x| factor * x)
}

#[inline]
fn largest<T: Real>([a, b, c]: Vector<T>) -> T {
    a.abs().max(b.abs()).max(c.abs())
}

/// Length and direction; `None` for the vector zero.
#[inline]
pub(super) fn polar<T: Real>(vector: Vector<T>) -> Option<(T, Vector<T>)> {
    // Squares of small numbers would be zero.
    let size = largest(vector);
    if size <= T::ZERO {
        return None;
    }
    let near_one = vector.map(|x| x / size);
    let length = dot(near_one, near_one).sqrt();
    Some((size * length, near_one.map(|x| x / length)))
}

#[inline]
pub(super) fn length<T: Real>(vector: Vector<T>) -> T {
    polar(vector).map_or(T::ZERO, |(length, _)| length)
}

/// A direction across another.
#[inline]
pub(super) fn across<T: Real>(direction: Vector<T>) -> Vector<T> {
    // The axis along which it points least.
    let [x, y, z] = direction.map(T::abs);
    let (zero, one) = (T::ZERO, T::ONE);
    let axis = if x <= y && x <= z {
        [one, zero, zero]
    } else if y <= z {
        [zero, one, zero]
    } else {
        [zero, zero, one]
    };
    polar(cross(direction, axis)).map_or(axis, |(_, direction)| direction)
}
