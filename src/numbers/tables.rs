//! Solver tables for any number type.

/// Gives a number type the tables of the solver: [`Nodes`], [`PhaseNodes`] and [`PhaseSamples`] for every number of nodes.
///
/// The compiler computes all tables in f64. This macro converts them to another type, also at compile time, so that a
/// conversion costs no instructions. It takes the type and a conversion, written like a closure. The conversion must be
/// possible in a constant, and the type must implement [`Real`].
///
/// ```
/// use core::ops::{Add, Div, Mul, Neg, Sub};
/// use microimpact::contact::{DimensionlessImpact, FixedCost};
/// use microimpact::{Real, lift_tables};
///
/// /// A single-precision number of one's own.
/// #[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
/// struct Own(f32);
///
/// lift_tables!(Own, |wide: f64| Own(wide as f32));
///
/// impl Neg for Own {
///     type Output = Self;
///     fn neg(self) -> Self {
///         Own(-self.0)
///     }
/// }
/// macro_rules! operator {
///     ($($operator:ident $name:ident),*) => {$(
///         impl $operator for Own {
///             type Output = Self;
///             fn $name(self, other: Self) -> Self {
///                 Own(self.0.$name(other.0))
///             }
///         }
///     )*};
/// }
/// operator!(Add add, Sub sub, Mul mul, Div div);
///
/// impl Real for Own {
///     const ZERO: Self = Own(0.0);
///     const ONE: Self = Own(1.0);
///     const EPSILON: Self = Own(f32::EPSILON);
///     const SMALLEST: Self = Own(f32::MIN_POSITIVE);
///     fn constant(value: f64) -> Self {
///         Own(value as f32)
///     }
///     fn to_f64(self) -> f64 {
///         self.0.into()
///     }
///     fn is_finite(self) -> bool {
///         self.0.is_finite()
///     }
///     fn sqrt(self) -> Self {
///         Own(self.0.sqrt())
///     }
///     fn two_fifths_power(self) -> Self {
///         Own(self.0.two_fifths_power())
///     }
///     fn exp(self) -> Self {
///         Own(self.0.exp())
///     }
///     fn saturating_div(self, divisor: Self) -> Self {
///         Own(self.0.saturating_div(divisor.0))
///     }
/// }
///
/// let [adhesion, damping] = [0.5, 0.1].map(Own::constant);
/// let method = FixedCost::<5>::new(3)?;
/// let own = DimensionlessImpact::new(adhesion, damping, damping)?.solve(&method).overall_restitution();
/// let single = DimensionlessImpact::new(0.5_f32, 0.1, 0.1)?.solve(&method).overall_restitution();
/// assert_eq!(own.0, single);
/// # Ok::<(), microimpact::InputError>(())
/// ```
///
/// For a generic type, the parameters stand in brackets before the type. Tables can be lifted from any type that has them:
///
/// ```text
/// lift_tables!([T: Real, const N: usize] Dual<T, N>, |wide: T| Dual::fixed(wide));
/// ```
///
/// A block at the end replaces the items of [`PhaseNodes`] that are not tables: the constant `SLOWEST` and, if the type needs
/// its own, the function `add_integrals`. In the block, `NODES` is the number of nodes.
///
/// ```text
/// lift_tables!([] FixedPoint, |wide: f64| FixedPoint::nearest(wide), {
///     const SLOWEST: Self = FixedPoint::nearest(5e-3);
/// });
/// ```
///
/// [`Nodes`]: crate::contact::Nodes
/// [`PhaseNodes`]: crate::contact::PhaseNodes
/// [`PhaseSamples`]: crate::contact::PhaseSamples
/// [`Real`]: crate::Real
#[macro_export]
macro_rules! lift_tables {
    ([] $number:ty, |$wide:ident: $source:ty| $lift:expr $(, $own:tt)?) => {
        $crate::lift_tables!(@all [] $number, $wide, $source, $lift $(, $own)?);
    };
    ([$($generics:tt)+] $number:ty, |$wide:ident: $source:ty| $lift:expr $(, $own:tt)?) => {
        $crate::lift_tables!(@all [$($generics)+,] $number, $wide, $source, $lift $(, $own)?);
    };
    (@all $generics:tt $number:ty, $wide:ident, $source:ty, $lift:expr) => {
        $crate::lift_tables!(@all $generics $number, $wide, $source, $lift, {
            const SLOWEST: Self = number(<$source as $crate::contact::PhaseNodes<NODES>>::SLOWEST);
        });
    };
    (@all $generics:tt $number:ty, $wide:ident, $source:ty, $lift:expr, $own:tt) => {
        #[allow(clippy::indexing_slicing)] // All indices are below the lengths, and the compiler evaluates them.
        const _: () = {
            $crate::lift_tables!(@functions $generics $number, $wide, $source, $lift);
            $crate::lift_tables!(@nodes $generics $number, $source);
            $crate::lift_tables!(@phase_nodes $generics $number, $source, $own);
        };
    };
    (@functions [$($generics:tt)*] $number:ty, $wide:ident, $source:ty, $lift:expr) => {
        const fn number<$($generics)*>($wide: $source) -> $number {
            $lift
        }

        const fn row<$($generics)* const NODES: usize>(wide: [$source; NODES]) -> [$number; NODES] {
            let mut lifted = [<$number as $crate::Real>::ZERO; NODES];
            let mut i = 0;
            while i < NODES {
                lifted[i] = number(wide[i]);
                i += 1;
            }
            lifted
        }

        const fn rows<$($generics)* const NODES: usize, const ROWS: usize>(
            wide: [[$source; NODES]; ROWS],
        ) -> [[$number; NODES]; ROWS] {
            let mut lifted = [[<$number as $crate::Real>::ZERO; NODES]; ROWS];
            let mut i = 0;
            while i < ROWS {
                lifted[i] = row(wide[i]);
                i += 1;
            }
            lifted
        }

        const fn pair<$($generics)*>(wide: ($source, $source)) -> ($number, $number) {
            (number(wide.0), number(wide.1))
        }

        const fn pairs<$($generics)* const NODES: usize>(
            wide: [($source, $source); NODES],
        ) -> [($number, $number); NODES] {
            let zero = <$number as $crate::Real>::ZERO;
            let mut lifted = [(zero, zero); NODES];
            let mut i = 0;
            while i < NODES {
                lifted[i] = pair(wide[i]);
                i += 1;
            }
            lifted
        }

        const fn fractions<$($generics)* const NODES: usize>(
            wide: [$crate::contact::Fraction<$source>; NODES],
        ) -> [$crate::contact::Fraction<$number>; NODES] {
            let zero = <$number as $crate::Real>::ZERO;
            let mut lifted =
                [$crate::contact::Fraction { value: zero, square: zero, cubic: zero, quintic: zero }; NODES];
            let mut i = 0;
            while i < NODES {
                lifted[i] = $crate::contact::Fraction {
                    value: number(wide[i].value),
                    square: number(wide[i].square),
                    cubic: number(wide[i].cubic),
                    quintic: number(wide[i].quintic),
                };
                i += 1;
            }
            lifted
        }
    };
    (@nodes [$($generics:tt)*] $number:ty, $source:ty) => {
        impl<$($generics)* const NODES: usize> $crate::contact::Nodes<NODES> for $number
        where
            $source: $crate::contact::Nodes<NODES>,
        {
            const Z: [Self; NODES] = row(<$source as $crate::contact::Nodes<NODES>>::Z);
            const INTEGRATION: [[Self; NODES]; NODES] = rows(<$source as $crate::contact::Nodes<NODES>>::INTEGRATION);
            const TURNING_INTEGRATION: [[Self; NODES]; NODES] = rows(<$source as $crate::contact::Nodes<NODES>>::TURNING_INTEGRATION);
            const WEIGHTS: [Self; NODES] = row(<$source as $crate::contact::Nodes<NODES>>::WEIGHTS);
            const TURNING_WEIGHTS: [Self; NODES] = row(<$source as $crate::contact::Nodes<NODES>>::TURNING_WEIGHTS);
            const HIGHEST_COEFFICIENT: [Self; NODES] = row(<$source as $crate::contact::Nodes<NODES>>::HIGHEST_COEFFICIENT);
            const LEGENDRE: [[Self; NODES]; NODES] = rows(<$source as $crate::contact::Nodes<NODES>>::LEGENDRE);
        }

        impl<$($generics)* const NODES: usize, const SAMPLES: usize>
            $crate::contact::PhaseSamples<NODES, SAMPLES> for $number
        where
            $source: $crate::contact::PhaseSamples<NODES, SAMPLES>,
        {
            const FRACTIONS: [$crate::contact::Fraction<Self>; SAMPLES] =
                fractions(<$source as $crate::contact::PhaseSamples<NODES, SAMPLES>>::FRACTIONS);
            const INTEGRATION: [[Self; SAMPLES]; NODES] =
                rows(<$source as $crate::contact::PhaseSamples<NODES, SAMPLES>>::INTEGRATION);
        }
    };
    (@phase_nodes [$($generics:tt)*] $number:ty, $source:ty, {$($own:tt)*}) => {
        impl<$($generics)* const NODES: usize> $crate::contact::PhaseNodes<NODES> for $number
        where
            $source: $crate::contact::PhaseNodes<NODES>,
        {
            const Z: [Self; NODES] = row(<$source as $crate::contact::PhaseNodes<NODES>>::Z);
            const FRACTIONS: [$crate::contact::Fraction<Self>; NODES] =
                fractions(<$source as $crate::contact::PhaseNodes<NODES>>::FRACTIONS);
            const INTEGRATION: [[Self; NODES]; NODES] = rows(<$source as $crate::contact::PhaseNodes<NODES>>::INTEGRATION);
            const END_INTEGRATION: [(Self, Self); NODES] =
                pairs(<$source as $crate::contact::PhaseNodes<NODES>>::END_INTEGRATION);
            const WEIGHTS: [Self; NODES] = row(<$source as $crate::contact::PhaseNodes<NODES>>::WEIGHTS);
            const END_WEIGHTS: (Self, Self) = pair(<$source as $crate::contact::PhaseNodes<NODES>>::END_WEIGHTS);
            const HIGHEST_COEFFICIENT: [Self; NODES] = row(<$source as $crate::contact::PhaseNodes<NODES>>::HIGHEST_COEFFICIENT);
            $($own)*
        }
    };
    ($number:ty, |$wide:ident: $source:ty| $lift:expr) => {
        $crate::lift_tables!(@all [] $number, $wide, $source, $lift);
    };
}
