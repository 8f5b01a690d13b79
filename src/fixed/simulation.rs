//! The dimensionless motion of the simulation in fixed point, and the tables it is solved with.

// Indices run over arrays of the length that their loops count to; the compiler evaluates the tables.
#![allow(clippy::indexing_slicing)]

use super::{FRACTION, FixedPoint};
use crate::contact::{DimensionlessImpact, Fraction, Nodes, PhaseNodes, PhaseSamples};
use crate::{InputError, Parameter, Real};

impl<T: Real + Into<f64>> DimensionlessImpact<T> {
    /// The same impact in fixed point.
    ///
    /// # Errors
    /// Adhesion or damping outside its range for [`FixedPoint`].
    ///
    /// ```
    /// use microimpact::simulation::{DimensionlessImpact, FixedCost};
    ///
    /// let impact = DimensionlessImpact::new(0.5, 0.1, 0.1)?;
    /// let (narrow, wide) = (impact.in_fixed_point()?, impact);
    /// let method = FixedCost::<4>::new(2)?;
    /// let difference = narrow.solve(&method).overall_restitution().to_f64() - wide.solve(&method).overall_restitution();
    /// assert!(difference.abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn in_fixed_point(&self) -> Result<DimensionlessImpact<FixedPoint>, InputError> {
        let adhesion = Parameter::DimensionlessAdhesion.check(self.adhesion)?;
        let material_damping = Parameter::DimensionlessDamping.check(self.material_damping)?;
        let adhesion_damping = Parameter::DimensionlessDamping.check(self.adhesion_damping)?;
        Ok(DimensionlessImpact {
            adhesion: FixedPoint::nearest(adhesion.into()),
            energy: FixedPoint::nearest(self.energy.into()),
            material_damping: FixedPoint::nearest(material_damping.into()),
            adhesion_damping: FixedPoint::nearest(adhesion_damping.into()),
        })
    }
}

/// Numbers of a table, each the nearest.
const fn nearest_all<const M: usize>(table: [f64; M]) -> [FixedPoint; M] {
    let mut nearest = [FixedPoint::ZERO; M];
    let mut i = 0;
    while i < M {
        nearest[i] = FixedPoint::nearest(table[i]);
        i += 1;
    }
    nearest
}

impl<const M: usize> PhaseNodes<M> for FixedPoint {
    const Z: [Self; M] = nearest_all(<f64 as PhaseNodes<M>>::Z);
    const FRACTIONS: [Fraction<Self>; M] = nearest_shares(<f64 as PhaseNodes<M>>::FRACTIONS);
    const RUNNING: [[Self; M]; M] = nearest_rows(<f64 as PhaseNodes<M>>::RUNNING);
    const RUNNING_ENDS: [(Self, Self); M] = nearest_pairs(<f64 as PhaseNodes<M>>::RUNNING_ENDS);
    const WHOLE: [Self; M] = nearest_all(<f64 as PhaseNodes<M>>::WHOLE);
    const WHOLE_ENDS: (Self, Self) = nearest_pairs([<f64 as PhaseNodes<M>>::WHOLE_ENDS])[0];
    const TAIL: [Self; M] = nearest_all(<f64 as PhaseNodes<M>>::TAIL);
    const SLOWEST: Self = Self::nearest(5e-3);

    #[inline]
    fn add_running(sums: &mut [Self; M], f: &[Self; M], g: &[Self; M]) {
        const { assert!(heaviest_column(&<f64 as PhaseNodes<M>>::RUNNING) < 1.0, "sums of 64 bits would overflow") };
        let mut products = *f;
        for (product, g) in products.iter_mut().zip(g) {
            *product = *product * *g;
        }
        for (j, sum) in sums.iter_mut().enumerate() {
            let mut wide = i64::from(sum.0.to_bits()) << FRACTION;
            for (row, value) in <Self as PhaseNodes<M>>::RUNNING.iter().zip(&products) {
                wide += row[j].0.wide_mul(value.0).to_bits();
            }
            *sum = Self::rounded(wide);
        }
    }
}

impl<const M: usize> Nodes<M> for FixedPoint {
    const Z: [Self; M] = nearest_all(<f64 as Nodes<M>>::Z);
    const RUNNING: [[Self; M]; M] = nearest_rows(<f64 as Nodes<M>>::RUNNING);
    const TURNING: [[Self; M]; M] = nearest_rows(<f64 as Nodes<M>>::TURNING);
    const WHOLE: [Self; M] = nearest_all(<f64 as Nodes<M>>::WHOLE);
    const WHOLE_TURNING: [Self; M] = nearest_all(<f64 as Nodes<M>>::WHOLE_TURNING);
    const TAIL: [Self; M] = nearest_all(<f64 as Nodes<M>>::TAIL);
    const LEGENDRE: [[Self; M]; M] = nearest_rows(<f64 as Nodes<M>>::LEGENDRE);
}

impl<const N: usize, const M: usize> PhaseSamples<N, M> for FixedPoint {
    const FRACTIONS: [Fraction<Self>; M] = nearest_shares(<f64 as PhaseSamples<N, M>>::FRACTIONS);
    const RUNNING: [[Self; M]; N] = nearest_rows(<f64 as PhaseSamples<N, M>>::RUNNING);
}

/// The largest sum of the sizes in a column.
const fn heaviest_column<const N: usize, const M: usize>(rows: &[[f64; M]; N]) -> f64 {
    let (mut heaviest, mut j) = (0.0, 0);
    while j < M {
        let (mut sum, mut k) = (0.0, 0);
        while k < N {
            sum += rows[k][j].abs();
            k += 1;
        }
        heaviest = if sum > heaviest { sum } else { heaviest };
        j += 1;
    }
    heaviest
}

/// The same for a table of rows.
const fn nearest_rows<const M: usize, const L: usize>(table: [[f64; M]; L]) -> [[FixedPoint; M]; L] {
    let mut nearest = [[FixedPoint::ZERO; M]; L];
    let mut i = 0;
    while i < L {
        nearest[i] = nearest_all(table[i]);
        i += 1;
    }
    nearest
}

/// The same for contact radii.
const fn nearest_shares<const M: usize>(shares: [Fraction<f64>; M]) -> [Fraction<FixedPoint>; M] {
    let zero = FixedPoint::ZERO;
    let mut nearest = [Fraction { value: zero, square: zero, cubic: zero, quintic: zero }; M];
    let mut i = 0;
    while i < M {
        let Fraction { value, square, cubic, quintic } = shares[i];
        nearest[i] = Fraction {
            value: FixedPoint::nearest(value),
            square: FixedPoint::nearest(square),
            cubic: FixedPoint::nearest(cubic),
            quintic: FixedPoint::nearest(quintic),
        };
        i += 1;
    }
    nearest
}

/// The same for pairs.
const fn nearest_pairs<const M: usize>(pairs: [(f64, f64); M]) -> [(FixedPoint, FixedPoint); M] {
    let mut nearest = [(FixedPoint::ZERO, FixedPoint::ZERO); M];
    let mut i = 0;
    while i < M {
        nearest[i] = (FixedPoint::nearest(pairs[i].0), FixedPoint::nearest(pairs[i].1));
        i += 1;
    }
    nearest
}
