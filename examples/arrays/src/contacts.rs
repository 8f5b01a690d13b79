//! Scenes of the contact simulation: spheres, laws of contact, and what happens along the surface.

use microimpact::contact::{AnyLaw, AnyScene, Contact, HertzLaw, JkrEnd};
use microimpact::{InputError, Real, Sphere, Stiffness};

use crate::Column;

/// Spheres and the physics of their contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contacts<'a> {
    /// Radius, m.
    pub radius: Column<'a>,
    /// Density, kg/m^3.
    pub density: Column<'a>,
    /// Squared radius of gyration over the squared radius; 0.4 for a solid sphere.
    pub gyration_ratio: Column<'a>,
    /// Hertz stiffness K, Pa.
    pub stiffness: Column<'a>,
    /// Adhesion, and the end of contact.
    pub law: Law<'a>,
    /// Damping of the materials.
    pub damping: Damping<'a>,
    /// Constant external force, N, positive out of the surface.
    pub external_force: Column<'a>,
    /// What happens along the surface.
    pub surface: Surface<'a>,
}

/// Adhesion, and where contact ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law<'a> {
    /// No adhesion.
    Hertz,
    /// No adhesion; contact ends where damping cancels the elastic force.
    WithoutTension,
    /// The paper's ring.
    Ring {
        /// Strength f0, N/m.
        strength: Column<'a>,
        /// Damping zeta_A on rebound.
        damping: Column<'a>,
    },
    /// Derjaguin, Muller and Toporov.
    Dmt {
        /// Work of adhesion per area, J/m^2.
        work: Column<'a>,
    },
    /// Johnson, Kendall and Roberts.
    Jkr {
        /// Work of adhesion per area, J/m^2.
        work: Column<'a>,
        /// Where contact ends.
        end: JkrEnd,
    },
}

/// Damping of the materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping<'a> {
    /// None.
    None,
    /// Hysteretic, of strength zeta_H.
    Hysteretic(Column<'a>),
    /// Viscoelastic, by the relaxation time, s.
    Viscoelastic(Column<'a>),
    /// Constant, by the restitution that it leaves without adhesion.
    Constant(Column<'a>),
}

/// What happens along the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface<'a> {
    /// Coulomb's friction.
    Coulomb {
        /// Friction coefficient f.
        friction: Column<'a>,
    },
    /// Friction, and a peeling moment. Only in a plane, and with the ring.
    Peeling {
        /// Friction coefficient f.
        friction: Column<'a>,
        /// Strength lambda, N m.
        moment: Column<'a>,
    },
    /// Friction on a contact that sticks elastically. Only with Hertz's contact.
    Compliant {
        /// Friction coefficient f.
        friction: Column<'a>,
        /// Stiffness ratio chi.
        stiffness_ratio: Column<'a>,
    },
}

impl Default for Contacts<'_> {
    /// Elastic solid spheres without friction. Radius, density and stiffness are NaN, which is refused: give them.
    fn default() -> Self {
        let missing = Column::All(f64::NAN);
        Self {
            radius: missing,
            density: missing,
            gyration_ratio: Column::All(0.4),
            stiffness: missing,
            law: Law::Hertz,
            damping: Damping::None,
            external_force: Column::All(0.0),
            surface: Surface::Coulomb { friction: Column::All(0.0) },
        }
    }
}

impl Contacts<'_> {
    /// The sphere of a row.
    pub(crate) fn sphere(&self, row: usize) -> Result<Sphere<f64>, InputError> {
        self.sphere_of(|column| column.at(row))
    }

    /// The sphere whose numbers `at` takes from the columns: those of a row, or of several in lanes.
    pub(crate) fn sphere_of<T: Real>(&self, at: impl Fn(&Column<'_>) -> T) -> Result<Sphere<T>, InputError> {
        Sphere::new(at(&self.radius), at(&self.density), at(&self.gyration_ratio))
    }

    pub(crate) fn friction(&self) -> Column<'_> {
        let (Surface::Coulomb { friction } | Surface::Peeling { friction, .. } | Surface::Compliant { friction, .. }) =
            self.surface;
        friction
    }

    /// Hertz's contact, without anything else.
    pub(crate) fn hertz<T: Real>(&self, at: impl Fn(&Column<'_>) -> T) -> Result<HertzLaw<T>, InputError> {
        Ok(HertzLaw::new(Stiffness::new(at(&self.stiffness))?))
    }

    /// Their law of contact.
    pub(crate) fn law<T: Real>(&self, at: impl Fn(&Column<'_>) -> T) -> Result<AnyLaw<T>, InputError> {
        let stiffness = Stiffness::new(at(&self.stiffness))?;
        let law = match &self.law {
            Law::Hertz => AnyLaw::hertz(stiffness),
            Law::WithoutTension => AnyLaw::without_tension(stiffness),
            Law::Ring { strength, damping } => AnyLaw::ring(stiffness, at(strength), at(damping))?,
            Law::Dmt { work } => AnyLaw::dmt(stiffness, at(work))?,
            Law::Jkr { work, end } => AnyLaw::jkr(stiffness, at(work), *end)?,
        };
        let law = match &self.damping {
            Damping::None => law,
            Damping::Hysteretic(zeta) => law.with_damping(at(zeta))?,
            Damping::Viscoelastic(time) => law.with_viscoelastic_damping(at(time))?,
            Damping::Constant(restitution) => law.with_constant_damping(at(restitution))?,
        };
        let force = at(&self.external_force);
        // A force of zero is none, which the solver can tell.
        if force == T::ZERO { Ok(law) } else { law.with_external_force(force) }
    }

    /// The scene of a row, with its friction but without a peeling moment or compliance.
    ///
    /// # Errors
    /// A number outside its range, or that does not go with the law.
    pub fn scene(&self, row: usize) -> Result<AnyScene<f64>, InputError> {
        self.scene_of(self.sphere(row)?, |column| column.at(row))
    }

    /// The same scene of another sphere, with the numbers that `at` takes from the columns.
    pub(crate) fn scene_of<T: Real>(
        &self,
        sphere: Sphere<T>,
        at: impl Fn(&Column<'_>) -> T,
    ) -> Result<AnyScene<T>, InputError> {
        Contact::new(sphere, self.law(&at)?).with_friction(at(&self.friction()))
    }
}
