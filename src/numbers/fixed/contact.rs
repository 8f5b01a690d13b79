//! The dimensionless contact simulation in fixed point, and the tables that its solver needs.

// All indices are below the lengths of their arrays.
#![allow(clippy::indexing_slicing)]

use super::{FRACTION, FixedPoint};
use crate::contact::{DimensionlessImpact, PhaseNodes};
use crate::{InputError, Parameter, Real, lift_tables};

impl<T: Real> DimensionlessImpact<T> {
    /// Converts the impact to fixed point, for [`FixedCost`](crate::contact::FixedCost). [`FixedPoint`] states the error.
    ///
    /// # Errors
    /// The adhesion or the damping is outside its range for [`FixedPoint`].
    ///
    /// ```
    /// use microimpact::contact::{DimensionlessImpact, FixedCost};
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
            adhesion: FixedPoint::nearest(adhesion.to_f64()),
            energy: FixedPoint::nearest(self.energy.to_f64()),
            material_damping: FixedPoint::nearest(material_damping.to_f64()),
            adhesion_damping: FixedPoint::nearest(adhesion_damping.to_f64()),
        })
    }
}

lift_tables!([] FixedPoint, |wide: f64| FixedPoint::nearest(wide), {
    const SLOWEST: Self = FixedPoint::nearest(5e-3);

    #[inline]
    fn add_integrals(sums: &mut [Self; NODES], f: &[Self; NODES], g: &[Self; NODES]) {
        const {
            let largest = largest_column_sum(&<f64 as PhaseNodes<NODES>>::INTEGRATION);
            assert!(largest < 1.0, "sums of 64 bits would overflow")
        };
        let mut products = *f;
        for (product, g) in products.iter_mut().zip(g) {
            *product = *product * *g;
        }
        for (j, sum) in sums.iter_mut().enumerate() {
            let mut wide = i64::from(sum.0.to_bits()) << FRACTION;
            for (row, value) in <Self as PhaseNodes<NODES>>::INTEGRATION.iter().zip(&products) {
                wide += row[j].0.wide_mul(value.0).to_bits();
            }
            *sum = Self::rounded(wide);
        }
    }
});

/// Largest sum of the absolute values in one column.
const fn largest_column_sum<const N: usize, const M: usize>(rows: &[[f64; M]; N]) -> f64 {
    let (mut largest, mut j) = (0.0, 0);
    while j < M {
        let (mut sum, mut k) = (0.0, 0);
        while k < N {
            sum += rows[k][j].abs();
            k += 1;
        }
        largest = if sum > largest { sum } else { largest };
        j += 1;
    }
    largest
}
