//! A table of materials, each number with its source.

use crate::{InputError, Material, Real};

/// A number with the publication that states it.
///
/// ```
/// use microimpact::MATERIALS;
///
/// assert!(MATERIALS.iter().all(|material| !material.density.source.is_empty()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Sourced {
    /// The number.
    pub value: f64,
    /// Authors and year, or the publisher of a data sheet.
    pub source: &'static str,
}

/// A material of the table [`MATERIALS`]. A number for which no source was found is `None`.
///
/// ```
/// use microimpact::{KnownMaterial, Sphere, Sticking, Stiffness};
///
/// // A polystyrene sphere of 1 um radius on glass: both surface energies would be needed for the work of adhesion.
/// let polystyrene = KnownMaterial::named("polystyrene").unwrap();
/// let glass = KnownMaterial::named("soda-lime glass").unwrap();
/// let stiffness = Stiffness::between(&polystyrene.elastic()?, &glass.elastic()?)?;
/// assert!(polystyrene.surface_energy.is_some() && glass.surface_energy.is_none());
/// // On polystyrene it is twice the surface energy.
/// let work = 2.0 * polystyrene.surface_energy.unwrap().value;
/// let sphere = Sphere::solid(1e-6, polystyrene.density.value)?;
/// assert!(Sticking::new(&sphere, stiffness, work)?.speed > 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct KnownMaterial {
    /// Its name, in lower case.
    pub name: &'static str,
    /// Young's modulus E, Pa.
    pub youngs_modulus: Sourced,
    /// Poisson's ratio nu.
    pub poisson_ratio: Sourced,
    /// Density, kg/m^3.
    pub density: Sourced,
    /// Surface energy gamma, J/m^2. The work of adhesion of two equal surfaces is twice as large.
    pub surface_energy: Option<Sourced>,
    /// Contact yield pressure p_y, Pa.
    pub yield_pressure: Option<Sourced>,
}

impl KnownMaterial {
    /// A material with its elastic constants and its density from one source.
    const fn new(name: &'static str, modulus: f64, poisson: f64, density: f64, source: &'static str) -> Self {
        Self {
            name,
            youngs_modulus: Sourced { value: modulus, source },
            poisson_ratio: Sourced { value: poisson, source },
            density: Sourced { value: density, source },
            surface_energy: None,
            yield_pressure: None,
        }
    }

    const fn with_density(self, value: f64, source: &'static str) -> Self {
        Self { density: Sourced { value, source }, ..self }
    }

    const fn with_surface_energy(self, value: f64, source: &'static str) -> Self {
        Self { surface_energy: Some(Sourced { value, source }), ..self }
    }

    const fn with_yield_pressure(self, value: f64, source: &'static str) -> Self {
        Self { yield_pressure: Some(Sourced { value, source }), ..self }
    }

    /// The material with a name.
    ///
    /// ```
    /// use microimpact::KnownMaterial;
    ///
    /// assert_eq!(KnownMaterial::named("steel").unwrap().youngs_modulus.value, 208e9);
    /// assert!(KnownMaterial::named("cheese").is_none());
    /// ```
    pub fn named(name: &str) -> Option<&'static Self> {
        MATERIALS.iter().find(|material| material.name == name)
    }

    /// Its elastic constants.
    ///
    /// # Errors
    /// None with the numbers of [`MATERIALS`].
    ///
    /// ```
    /// use microimpact::{MATERIALS, Material};
    ///
    /// let material = &MATERIALS[0];
    /// let same = Material::new(material.youngs_modulus.value, material.poisson_ratio.value);
    /// assert_eq!(material.elastic::<f64>(), same);
    /// ```
    pub fn elastic<T: Real>(&self) -> Result<Material<T>, InputError> {
        Material::new(T::constant(self.youngs_modulus.value), T::constant(self.poisson_ratio.value))
    }
}

const BRACH_DUNN: &str = "Brach and Dunn 1995, Aerosol Sci. Technol. 23:51";
const CHUNG_OOI: &str = "Chung and Ooi 2011, Granular Matter 13:643";
const PASHA: &str = "Pasha et al. 2014, Granular Matter 16:151, table 1";
const PILKINGTON: &str = "Pilkington 2008, data sheet ATS-129";
const MAKE_IT_FROM: &str = "MakeItFrom.com, fused silica";
const PHARES: &str = "Phares et al. 2000, by the database of Nasr";
const SURFACE_ENERGIES: &str = "Sabreen Group, surface energies of untreated polymers";
const WEB_ELEMENTS: &str = "WebElements, gold";
const GIZMO: &str = "GIZMO code, silicate grains";
const AZOM: &str = "AZoM, article 9282";

/// Materials of particles and of surfaces, in alphabetical order.
///
/// Numbers of real samples differ from these, surface energies by factors. They serve a first estimate.
///
/// ```
/// use microimpact::MATERIALS;
///
/// for material in &MATERIALS {
///     println!("{}: E = {:e} Pa ({})", material.name, material.youngs_modulus.value, material.youngs_modulus.source);
/// }
/// ```
pub const MATERIALS: [KnownMaterial; 15] = [
    KnownMaterial::new("aluminium alloy", 70e9, 0.33, 2700.0, CHUNG_OOI),
    KnownMaterial::new("aluminium oxide", 380e9, 0.23, 4000.0, CHUNG_OOI),
    KnownMaterial::new("ammonium fluorescein", 1.2e9, 0.3, 1350.0, PASHA).with_yield_pressure(35.3e6, PASHA),
    KnownMaterial::new("cast iron", 100e9, 0.25, 7000.0, CHUNG_OOI),
    KnownMaterial::new("copper", 120e9, 0.35, 8900.0, CHUNG_OOI),
    KnownMaterial::new("fused silica", 73e9, 0.17, 2200.0, MAKE_IT_FROM),
    KnownMaterial::new("glass", 72e9, 0.21, 2600.0, BRACH_DUNN),
    KnownMaterial::new("gold", 78e9, 0.44, 19_300.0, WEB_ELEMENTS),
    KnownMaterial::new("ice", 9e9, 0.32, 922.5, "Petrovic 2003, J. Mater. Sci. 38:1")
        .with_density(922.5, "Squire et al. 1995, Annu. Rev. Fluid Mech. 27:115")
        .with_surface_energy(0.19, "Gundlach et al. 2011, Icarus 214:717"),
    KnownMaterial::new("limestone", 20e9, 0.25, 2500.0, CHUNG_OOI),
    KnownMaterial::new("polystyrene", 2.8e9, 0.33, 1050.0, PHARES)
        .with_density(1050.0, "Cardarelli 2018, Materials Handbook")
        .with_surface_energy(0.038, SURFACE_ENERGIES),
    KnownMaterial::new("silica grain", 54e9, 0.17, 2650.0, GIZMO)
        .with_density(2650.0, "DustSimulation code, silicate")
        .with_surface_energy(0.025, GIZMO),
    KnownMaterial::new("silver", 76e9, 0.37, 10_500.0, AZOM),
    KnownMaterial::new("soda-lime glass", 72e9, 0.23, 2530.0, PILKINGTON),
    KnownMaterial::new("steel", 208e9, 0.3, 7850.0, CHUNG_OOI),
];

#[cfg(test)]
mod tests {
    use super::MATERIALS;
    use crate::Parameter;

    #[test]
    fn every_number_is_valid_and_has_a_source() {
        assert!(MATERIALS.is_sorted_by(|a, b| a.name < b.name));
        for material in &MATERIALS {
            let numbers = [
                (Parameter::YoungsModulus, Some(material.youngs_modulus)),
                (Parameter::PoissonRatio, Some(material.poisson_ratio)),
                (Parameter::Density, Some(material.density)),
                (Parameter::AdhesionEnergy, material.surface_energy),
                (Parameter::YieldPressure, material.yield_pressure),
            ];
            for (parameter, number) in numbers {
                let valid =
                    number.is_none_or(|number| parameter.check(number.value).is_ok() && number.source.len() > 10);
                assert!(valid, "{} {parameter:?} {number:?}", material.name);
            }
            assert!(material.elastic::<f32>().is_ok());
        }
    }
}
