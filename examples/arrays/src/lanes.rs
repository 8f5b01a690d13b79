//! Number types that hold a number of each of several impacts, one a lane, in a vector of the processor.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use microimpact::{Real, lift_tables};
use wide::{CmpEq, CmpGt, CmpLt, f32x8, f64x4};

/// A number type with lanes. A comparison is true only if it is true in every lane, so that a check of a range accepts what is inside in
/// all of them.
macro_rules! number_with_lanes {
    ($(#[$doc:meta])* $lanes:ident, $vector:ident, $number:ident, $count:literal) => {
        $(#[$doc])*
        ///
        /// By [`Contact::solve_lanes`](microimpact::contact::Contact::solve_lanes) and
        /// [`RigidBody::impact`](microimpact::RigidBody::impact) a scene in this type gives the impacts of its lanes; other methods do not
        /// take one.
        #[derive(Clone, Copy, Debug)]
        pub struct $lanes($vector);

        lift_tables!([] $lanes, |wide: f64| $lanes($vector::new([wide as $number; $count])));

        impl From<[$number; $count]> for $lanes {
            #[inline]
            fn from(numbers: [$number; $count]) -> Self {
                Self($vector::from(numbers))
            }
        }

        impl From<$lanes> for [$number; $count] {
            #[inline]
            fn from(lanes: $lanes) -> Self {
                lanes.0.to_array()
            }
        }

        impl $lanes {
            /// The same function in each lane.
            #[inline]
            fn each(self, function: impl Fn($number) -> $number) -> Self {
                let mut numbers = self.0.to_array();
                for number in &mut numbers {
                    *number = function(*number);
                }
                Self::from(numbers)
            }
        }

        number_with_lanes!(@operators $lanes; Add add, Sub sub, Mul mul, Div div);

        impl Neg for $lanes {
            type Output = Self;

            #[inline]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl PartialEq for $lanes {
            #[inline]
            fn eq(&self, other: &Self) -> bool {
                self.0.cmp_eq(other.0).all()
            }
        }

        impl PartialOrd for $lanes {
            #[inline]
            fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
                if self.0.cmp_lt(other.0).all() {
                    Some(Ordering::Less)
                } else if self.0.cmp_gt(other.0).all() {
                    Some(Ordering::Greater)
                } else {
                    (self == other).then_some(Ordering::Equal)
                }
            }
        }

        impl Real for $lanes {
            const ZERO: Self = Self($vector::new([0.0; $count]));
            const ONE: Self = Self($vector::new([1.0; $count]));
            const EPSILON: Self = Self($vector::new([$number::EPSILON; $count]));
            const HAS_LANES: bool = true;
            const SMALLEST: Self = Self($vector::new([$number::MIN_POSITIVE; $count]));

            #[inline]
            fn constant(value: f64) -> Self {
                Self($vector::splat(value as $number))
            }

            /// The number of the first lane.
            #[inline]
            fn to_f64(self) -> f64 {
                let [first, ..] = self.0.to_array();
                first.into()
            }

            #[inline]
            fn is_finite(self) -> bool {
                self.0.is_finite().all()
            }

            #[inline]
            fn sqrt(self) -> Self {
                Self(self.0.sqrt())
            }

            #[inline]
            fn two_fifths_power(self) -> Self {
                self.each(Real::two_fifths_power)
            }

            #[inline]
            fn exp(self) -> Self {
                self.each(Real::exp)
            }

            #[inline]
            fn ln(self) -> Self {
                self.each(Real::ln)
            }

            // In this order of operands minimum and maximum keep a quotient that is not a number, as `clamp` does.
            #[inline]
            fn saturating_div(self, divisor: Self) -> Self {
                let (least, largest) = ($vector::splat($number::MIN), $vector::splat($number::MAX));
                Self(largest.fast_min(least.fast_max(self.0 / divisor.0)))
            }

            #[inline]
            fn any_above(self, other: Self) -> bool {
                self.0.cmp_gt(other.0).any()
            }

            #[inline]
            fn where_above(self, other: Self, then: Self, otherwise: Self) -> Self {
                Self(self.0.cmp_gt(other.0).blend(then.0, otherwise.0))
            }

            #[inline]
            fn abs(self) -> Self {
                Self(self.0.abs())
            }

            // In this order of operands the first number stays unless the other is smaller or larger, as by default.
            #[inline]
            fn min(self, other: Self) -> Self {
                Self(other.0.fast_min(self.0))
            }

            #[inline]
            fn max(self, other: Self) -> Self {
                Self(other.0.fast_max(self.0))
            }
        }
    };
    (@operators $lanes:ident; $($operator:ident $name:ident),*) => {$(
        impl $operator for $lanes {
            type Output = Self;

            #[inline]
            fn $name(self, other: Self) -> Self {
                Self(self.0.$name(other.0))
            }
        }
    )*};
}

number_with_lanes!(
    /// Four numbers in double precision.
    F64x4, f64x4, f64, 4
);
number_with_lanes!(
    /// Eight numbers in single precision.
    F32x8, f32x8, f32, 8
);
