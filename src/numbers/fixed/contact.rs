//! The dimensionless contact simulation in fixed point, and the tables that its solver needs.

// All indices are below the lengths of their arrays.
#![allow(clippy::indexing_slicing)]

use super::{FRACTION, FixedPoint, InFixedPoint};
use crate::contact::{
    DimensionlessImpact, Dmt, HertzLaw, HystereticDamping, NoForce, PhaseNodes, Ring, ViscoelasticDamping,
};
use crate::{InputError, Parameter, Real, lift_tables};

/// A group in the range of its parameter, by a factor between the two.
fn bounded<T: Real>(parameter: Parameter, value: T, factor: f64) -> Result<FixedPoint, InputError> {
    parameter.check(value * T::constant(factor))?;
    Ok(FixedPoint::nearest(value.to_f64()))
}

/// In units of an impact.
impl<T: Real> InFixedPoint<T> for HystereticDamping<T> {
    type Fixed = HystereticDamping<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        Ok(HystereticDamping { rate: bounded(Parameter::DimensionlessDamping, self.rate, 1.0)? })
    }
}

/// In units of an impact.
impl<T: Real> InFixedPoint<T> for ViscoelasticDamping<T> {
    type Fixed = ViscoelasticDamping<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        // Over the elastic force at the peak, 5/4.
        Ok(ViscoelasticDamping { time: bounded(Parameter::DimensionlessDamping, self.time, 0.8)? })
    }
}

/// In units of an impact.
impl<T: Real> InFixedPoint<T> for Ring<T> {
    type Fixed = Ring<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        Ok(Ring {
            strength: bounded(Parameter::DimensionlessAdhesion, self.strength, 1.0)?,
            damping: bounded(Parameter::DimensionlessDamping, self.damping, 1.0)?,
        })
    }
}

/// In units of an impact.
impl<T: Real> InFixedPoint<T> for Dmt<T> {
    type Fixed = Dmt<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        // The energy before the impact is one half less the strength.
        Ok(Dmt { strength: bounded(Parameter::DimensionlessAdhesion, self.strength, 2.0)? })
    }
}

impl<T: Real, D: InFixedPoint<T>, A: InFixedPoint<T>> DimensionlessImpact<T, D, A> {
    /// Converts the impact to fixed point, for [`FixedCost`](crate::contact::FixedCost). [`FixedPoint`] states the error.
    ///
    /// Hertz's contact, the ring and DMT's adhesion can be converted, with no, hysteretic or viscoelastic damping.
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
    pub fn in_fixed_point(&self) -> Result<DimensionlessImpact<FixedPoint, D::Fixed, A::Fixed>, InputError> {
        let HertzLaw { damping, adhesion, .. } = &self.law;
        let adhesion = adhesion.in_fixed_point(T::ONE)?;
        let damping = damping.in_fixed_point(T::ONE)?;
        let law = HertzLaw { stiffness: FixedPoint::ONE, damping, adhesion, force: NoForce };
        Ok(DimensionlessImpact { law, energy: FixedPoint::nearest(self.energy.to_f64()) })
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
