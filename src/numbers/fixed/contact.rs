//! The contact simulation in fixed point, and the tables that its solver needs.

// All indices are below the lengths of their arrays.
#![allow(clippy::indexing_slicing)]

use super::{FRACTION, FixedPoint, InFixedPoint};
use crate::contact::{
    Attraction, Contact, ContactLaw, Damping, DimensionlessImpact, Dmt, HertzLaw, HystereticDamping, NoDamping,
    NoForce, PhaseNodes, Ring, ViscoelasticDamping, unit_damping,
};
use crate::{InputError, NoAdhesion, Parameter, Real, Sphere, lift_tables};

/// Damping or adhesion of Hertz's contact that can be converted to fixed point: [`NoDamping`], [`HystereticDamping`] or
/// [`ViscoelasticDamping`], and [`NoAdhesion`], [`Ring`] or [`Dmt`].
pub trait FixedPointTerm<T>: Copy {
    /// The same term in fixed point.
    type Fixed;

    /// The numbers of this term in natural units.
    #[must_use]
    fn in_natural_units(&self, units: &NaturalUnits<T>) -> Self;

    /// The numbers of this term, as they stand.
    fn nearest(&self) -> Self::Fixed;
}

/// Units in which radius, mass and stiffness of a sphere are one. With the unit of speed U the unit of length is
/// L = r (m U^2/(r^3 K))^(2/5), but for the radius: it enters the forces only as sqrt(r) K.
#[derive(Clone, Copy, Debug)]
pub struct NaturalUnits<T> {
    stiffness: T,
    length: T,
    speed: T,
    /// L/r: the damping of strength zeta = 1 at the unit of speed (B4).
    damping: T,
    /// Acceleration r G/m by the unit G of work of adhesion.
    adhesion: T,
}

impl<T: Real> NaturalUnits<T> {
    fn new(sphere: &Sphere<T>, stiffness: T, speed: T, damping: T) -> Self {
        let length = sphere.radius() * damping;
        Self { stiffness, length, speed, damping, adhesion: sphere.radius() / sphere.mass() }
    }
}

/// Terms that hold no number.
macro_rules! nothing_to_convert {
    ($($term:ident),*) => {$(
        impl<T> FixedPointTerm<T> for $term {
            type Fixed = Self;

            fn in_natural_units(&self, _units: &NaturalUnits<T>) -> Self {
                *self
            }

            fn nearest(&self) -> Self {
                *self
            }
        }
    )*};
}

nothing_to_convert!(NoAdhesion, NoDamping);

impl<T: Real> FixedPointTerm<T> for HystereticDamping<T> {
    type Fixed = HystereticDamping<FixedPoint>;

    fn in_natural_units(&self, units: &NaturalUnits<T>) -> Self {
        Self { rate: self.rate * units.damping }
    }

    fn nearest(&self) -> Self::Fixed {
        HystereticDamping { rate: nearest(self.rate) }
    }
}

impl<T: Real> FixedPointTerm<T> for ViscoelasticDamping<T> {
    type Fixed = ViscoelasticDamping<FixedPoint>;

    fn in_natural_units(&self, units: &NaturalUnits<T>) -> Self {
        Self { time: self.time * (units.speed / units.length) }
    }

    fn nearest(&self) -> Self::Fixed {
        ViscoelasticDamping { time: nearest(self.time) }
    }
}

impl<T: Real> FixedPointTerm<T> for Ring<T> {
    type Fixed = Ring<FixedPoint>;

    fn in_natural_units(&self, units: &NaturalUnits<T>) -> Self {
        Self { strength: self.strength / units.stiffness / units.length, damping: self.damping * units.damping }
    }

    fn nearest(&self) -> Self::Fixed {
        Ring { strength: nearest(self.strength), damping: nearest(self.damping) }
    }
}

impl<T: Real> FixedPointTerm<T> for Dmt<T> {
    type Fixed = Dmt<FixedPoint>;

    fn in_natural_units(&self, units: &NaturalUnits<T>) -> Self {
        Self { strength: self.strength * units.adhesion / units.speed * (units.length / units.speed) }
    }

    fn nearest(&self) -> Self::Fixed {
        Dmt { strength: nearest(self.strength) }
    }
}

/// The number in fixed point, or the closest bound.
fn nearest<T: Real>(value: T) -> FixedPoint {
    FixedPoint::nearest(value.to_f64())
}

impl<T, D, A> HertzLaw<T, D, A>
where
    T: Real,
    D: Damping<T> + FixedPointTerm<T>,
    A: Attraction<T> + FixedPointTerm<T>,
{
    /// The law with its numbers as they stand, which nothing but the set-up of an impact multiplies by the stiffness.
    fn nearest(&self) -> HertzLaw<FixedPoint, D::Fixed, A::Fixed> {
        let (damping, adhesion) = (self.damping.nearest(), self.adhesion.nearest());
        HertzLaw { stiffness: FixedPoint::ONE, damping, adhesion, force: NoForce }
    }
}

impl<T, D, A> DimensionlessImpact<T, D, A>
where
    T: Real,
    D: Damping<T> + FixedPointTerm<T>,
    A: Attraction<T> + FixedPointTerm<T>,
{
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
        self.law.fits_fixed_point()?;
        Ok(DimensionlessImpact { law: self.law.nearest(), energy: nearest(self.energy) })
    }
}

/// ```
/// use microimpact::contact::{Contact, FixedCost};
/// use microimpact::{Class, InFixedPoint, NormalMotion, Sphere, Stiffness};
///
/// let sphere = Sphere::solid(5.06e-6_f32, 2600.0)?;
/// let scene = Contact::hertz(sphere, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?
///     .with_friction(0.1)?;
/// let motion = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.454e5)?;
///
/// // The set-up uses floating point. The impact uses integers only.
/// let unit = 4.0;
/// let (scene, motion) = (scene.in_fixed_point(unit)?, motion.in_fixed_point(unit)?);
/// let impact = scene.solve(&motion, &FixedCost::<5>::new(3)?.with_outputs::<7>())?;
/// assert_eq!(impact.class(), Some(Class::ReboundRolling));
/// assert!((impact.normal.overall_restitution().to_f64() - 0.746193).abs() < 1e-5);
/// assert!((4.0 * impact.tangential.velocity().to_f64() - 0.2102).abs() < 1e-4);
/// # Ok::<(), microimpact::InputError>(())
/// ```
impl<T, D, A, S> InFixedPoint<T> for Contact<T, HertzLaw<T, D, A>, S>
where
    T: Real,
    D: Damping<T> + FixedPointTerm<T>,
    A: Attraction<T> + FixedPointTerm<T>,
    S: InFixedPoint<T>,
{
    type Fixed = Contact<FixedPoint, HertzLaw<FixedPoint, D::Fixed, A::Fixed>, S::Fixed>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        let unit = Parameter::SpeedUnit.check(unit)?;
        let Self { sphere, law, surface } = self;
        law.in_units(sphere, unit)?.0.fits_fixed_point()?;
        let units = NaturalUnits::new(sphere, law.stiffness, unit, unit_damping(sphere, law.stiffness, unit));
        let law = HertzLaw {
            damping: law.damping.in_natural_units(&units),
            adhesion: law.adhesion.in_natural_units(&units),
            ..*law
        };
        Ok(Contact { sphere: sphere.in_fixed_point(unit)?, law: law.nearest(), surface: surface.in_fixed_point(unit)? })
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
