//! Solver tables for any number type.

/// Gives a number type the tables of the solver: [`Nodes`], [`PhaseNodes`] and [`PhaseSamples`] for every number of nodes.
///
/// The compiler computes all tables in f64. This macro converts them to another type, also at compile time, so that a
/// conversion costs no instructions. It takes the type and a conversion, written like a closure. The conversion must be
/// possible in a constant, and the type must implement [`Real`].
///
/// ```
/// use core::ops::{Add, Div, Mul, Neg, Sub};
/// use microimpact::simulation::{DimensionlessImpact, FixedCost};
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
/// its own, the function `add_running`. In the block, `NODES` is the number of nodes. If `PhaseNodes for` comes first, the
/// type gets no other tables, and only [`FixedCost`] for the normal motion accepts it.
///
/// ```text
/// lift_tables!(PhaseNodes for FixedPoint, |wide: f64| FixedPoint::nearest(wide), {
///     const SLOWEST: Self = FixedPoint::nearest(5e-3);
/// });
/// ```
///
/// [`FixedCost`]: crate::simulation::FixedCost
/// [`Nodes`]: crate::simulation::Nodes
/// [`PhaseNodes`]: crate::simulation::PhaseNodes
/// [`PhaseSamples`]: crate::simulation::PhaseSamples
/// [`Real`]: crate::Real
#[macro_export]
macro_rules! lift_tables {
    (PhaseNodes for $number:ty, |$wide:ident: $source:ty| $lift:expr, $own:tt) => {
        #[allow(clippy::indexing_slicing)] // All indices are below the lengths, and the compiler evaluates them.
        const _: () = {
            $crate::lift_tables!(@functions [] $number, $wide, $source, $lift);
            $crate::lift_tables!(@phase_nodes [] $number, $source, $own);
        };
    };
    ([] $number:ty, |$wide:ident: $source:ty| $lift:expr $(, $own:tt)?) => {
        $crate::lift_tables!(@all [] $number, $wide, $source, $lift $(, $own)?);
    };
    ([$($generics:tt)+] $number:ty, |$wide:ident: $source:ty| $lift:expr $(, $own:tt)?) => {
        $crate::lift_tables!(@all [$($generics)+,] $number, $wide, $source, $lift $(, $own)?);
    };
    (@all $generics:tt $number:ty, $wide:ident, $source:ty, $lift:expr) => {
        $crate::lift_tables!(@all $generics $number, $wide, $source, $lift, {
            const SLOWEST: Self = number(<$source as $crate::simulation::PhaseNodes<NODES>>::SLOWEST);
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

        const fn shares<$($generics)* const NODES: usize>(
            wide: [$crate::simulation::Share<$source>; NODES],
        ) -> [$crate::simulation::Share<$number>; NODES] {
            let zero = <$number as $crate::Real>::ZERO;
            let mut lifted =
                [$crate::simulation::Share { radius: zero, square: zero, cubic: zero, quintic: zero }; NODES];
            let mut i = 0;
            while i < NODES {
                lifted[i] = $crate::simulation::Share {
                    radius: number(wide[i].radius),
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
        impl<$($generics)* const NODES: usize> $crate::simulation::Nodes<NODES> for $number
        where
            $source: $crate::simulation::Nodes<NODES>,
        {
            const Z: [Self; NODES] = row(<$source as $crate::simulation::Nodes<NODES>>::Z);
            const RUNNING: [[Self; NODES]; NODES] = rows(<$source as $crate::simulation::Nodes<NODES>>::RUNNING);
            const TURNING: [[Self; NODES]; NODES] = rows(<$source as $crate::simulation::Nodes<NODES>>::TURNING);
            const WHOLE: [Self; NODES] = row(<$source as $crate::simulation::Nodes<NODES>>::WHOLE);
            const WHOLE_TURNING: [Self; NODES] = row(<$source as $crate::simulation::Nodes<NODES>>::WHOLE_TURNING);
            const TAIL: [Self; NODES] = row(<$source as $crate::simulation::Nodes<NODES>>::TAIL);
            const LEGENDRE: [[Self; NODES]; NODES] = rows(<$source as $crate::simulation::Nodes<NODES>>::LEGENDRE);
        }

        impl<$($generics)* const NODES: usize, const SAMPLES: usize>
            $crate::simulation::PhaseSamples<NODES, SAMPLES> for $number
        where
            $source: $crate::simulation::PhaseSamples<NODES, SAMPLES>,
        {
            const SHARES: [$crate::simulation::Share<Self>; SAMPLES] =
                shares(<$source as $crate::simulation::PhaseSamples<NODES, SAMPLES>>::SHARES);
            const RUNNING: [[Self; SAMPLES]; NODES] =
                rows(<$source as $crate::simulation::PhaseSamples<NODES, SAMPLES>>::RUNNING);
        }
    };
    (@phase_nodes [$($generics:tt)*] $number:ty, $source:ty, {$($own:tt)*}) => {
        impl<$($generics)* const NODES: usize> $crate::simulation::PhaseNodes<NODES> for $number
        where
            $source: $crate::simulation::PhaseNodes<NODES>,
        {
            const Z: [Self; NODES] = row(<$source as $crate::simulation::PhaseNodes<NODES>>::Z);
            const SHARES: [$crate::simulation::Share<Self>; NODES] =
                shares(<$source as $crate::simulation::PhaseNodes<NODES>>::SHARES);
            const RUNNING: [[Self; NODES]; NODES] = rows(<$source as $crate::simulation::PhaseNodes<NODES>>::RUNNING);
            const RUNNING_ENDS: [(Self, Self); NODES] =
                pairs(<$source as $crate::simulation::PhaseNodes<NODES>>::RUNNING_ENDS);
            const WHOLE: [Self; NODES] = row(<$source as $crate::simulation::PhaseNodes<NODES>>::WHOLE);
            const WHOLE_ENDS: (Self, Self) = pair(<$source as $crate::simulation::PhaseNodes<NODES>>::WHOLE_ENDS);
            const TAIL: [Self; NODES] = row(<$source as $crate::simulation::PhaseNodes<NODES>>::TAIL);
            $($own)*
        }
    };
    ($number:ty, |$wide:ident: $source:ty| $lift:expr) => {
        $crate::lift_tables!(@all [] $number, $wide, $source, $lift);
    };
}
