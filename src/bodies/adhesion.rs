//! What a work of adhesion means for a sphere on a flat surface.

use core::f64::consts::PI;

use crate::numbers::cube_root;
use crate::{InputError, Parameter, Real, Sphere, Stiffness};

/// Strength f0 of the ring whose contact radius at rest is this fraction of the radius: f0 = K r (a/r)^2/(2 pi), the equilibrium of B6.
pub(crate) fn strength_at_rest<T: Real>(sphere: &Sphere<T>, stiffness: Stiffness<T>, ratio: T) -> T {
    stiffness.pascals() * sphere.radius() * T::constant(0.5 / PI) * ratio * ratio
}

/// What a work of adhesion G (J/m^2) does to an elastic sphere, by Johnson, Kendall and Roberts (1971). G of equal materials is
/// twice their surface energy.
///
/// ```
/// use microimpact::{Sphere, Sticking, Stiffness};
///
/// // A ring of 250 N/m holds the sphere of the paper's Table 1 as a work of adhesion of 5.4 J/m^2 would, far more than materials
/// // have: 0.02 to 2 J/m^2.
/// let sticking = Sticking::new(&Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?, 5.36)?;
/// assert!((sticking.ring_strength - 250.0_f64).abs() < 0.3);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Sticking<T> {
    /// Contact radius at rest, the cube root of 6 pi G r^2/K, m.
    pub contact_radius: T,
    /// Force that pulls the sphere off, (3/2) pi G r, N.
    pub pull_off_force: T,
    /// Energy that an elastic impact loses when contact snaps off, W_s = 7.09220 (G^5 r^4/E*^2)^(1/3) (Thornton and Ning 1998), J.
    pub work: T,
    /// Speed up to which an elastic sphere sticks, V_s = sqrt(2 W_s/m), m/s.
    pub speed: T,
    /// Strength f0 of the paper's ring with the same contact radius at rest, N/m.
    pub ring_strength: T,
}

/// W_s over G r^2 (G/(E* r))^(2/3).
const WORK: f64 = 7.092_195_971_863_959;

impl<T: Real> Sticking<T> {
    /// Computes it for a sphere, the stiffness of its contact, and a work of adhesion, J/m^2.
    ///
    /// # Errors
    /// A work outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Sticking, Stiffness};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// assert!(Sticking::new(&sphere, Stiffness::new(1e10)?, -0.1).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(sphere: &Sphere<T>, stiffness: Stiffness<T>, work: T) -> Result<Self, InputError> {
        let work = Parameter::AdhesionEnergy.check(work)?;
        let (radius, pascals) = (sphere.radius(), stiffness.pascals());
        // In this order no product leaves the range of single precision.
        let rest = cube_root(T::constant(6.0 * PI) * work / pascals / radius);
        // E* = (3/4) K.
        let softness = cube_root(T::constant(4.0 / 3.0) * work / pascals / radius);
        let scale = T::constant(WORK) * softness * softness;
        let speed_squared = T::constant(1.5 / PI) * scale * (work / radius) / sphere.density();
        Ok(Self {
            contact_radius: radius * rest,
            pull_off_force: T::constant(1.5 * PI) * work * radius,
            work: scale * work * radius * radius,
            speed: speed_squared.sqrt(),
            ring_strength: strength_at_rest(sphere, stiffness, rest),
        })
    }
}

/// Which law suits an adhesive contact (Tabor 1977).
///
/// ```
/// use microimpact::{AdhesionRegime, Sphere, Stiffness};
///
/// // Polystyrene on quartz, 1 um in diameter, with atoms 0.4 nm apart.
/// let (sphere, stiffness) = (Sphere::solid(0.5e-6, 1050.0)?, Stiffness::new(4.6e9)?);
/// let (regime, number) = AdhesionRegime::of(&sphere, stiffness, 0.06_f64, 0.4e-9)?;
/// assert!((number - 1.3).abs() < 0.1);
/// assert_eq!(regime, AdhesionRegime::Between);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum AdhesionRegime {
    /// Small and stiff spheres, Tabor's number up to 0.1: [`Dmt`](crate::contact::Dmt).
    Dmt,
    /// Neither law is exact; they differ by a third in the pull-off force.
    Between,
    /// Large and soft spheres, Tabor's number from 5: [`JkrLaw`](crate::contact::JkrLaw).
    Jkr,
}

/// Tabor's numbers between which neither law is exact (Johnson and Greenwood 1997).
const DMT_UP_TO: f64 = 0.1;
const JKR_FROM: f64 = 5.0;

impl AdhesionRegime {
    /// The law that suits a sphere, the stiffness of its contact, a work of adhesion G (J/m^2) and the distance z_0 between atoms
    /// in contact (m; 0.2 to 0.4 nm as a rule), with Tabor's number (r G^2/(E*^2 z_0^3))^(1/3).
    ///
    /// # Errors
    /// A work or a distance outside its range.
    ///
    /// ```
    /// use microimpact::{AdhesionRegime, Sphere, Stiffness};
    ///
    /// let of = |radius| AdhesionRegime::of(&Sphere::solid(radius, 1000.0)?, Stiffness::new(1e10)?, 0.1, 0.3e-9);
    /// assert_eq!(of(1e-10)?.0, AdhesionRegime::Dmt);
    /// assert_eq!(of(1e-3)?.0, AdhesionRegime::Jkr);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn of<T: Real>(
        sphere: &Sphere<T>,
        stiffness: Stiffness<T>,
        work: T,
        spacing: T,
    ) -> Result<(Self, T), InputError> {
        let (work, spacing) = (Parameter::AdhesionEnergy.check(work)?, Parameter::AtomicSpacing.check(spacing)?);
        let strain = T::constant(4.0 / 3.0) * work / stiffness.pascals() / spacing;
        let number = cube_root(sphere.radius() / spacing * strain * strain);
        let regime = if number <= T::constant(DMT_UP_TO) {
            Self::Dmt
        } else if number < T::constant(JKR_FROM) {
            Self::Between
        } else {
            Self::Jkr
        };
        Ok((regime, number))
    }
}
