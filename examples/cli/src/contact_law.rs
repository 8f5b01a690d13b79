//! The law of contact that a row states.

use clap::ValueEnum;
use microimpact::contact::{AnyLaw, Contact, Groups, JkrEnd};
use microimpact::{InputError, Parameter, PlanarMotion, Sphere, Stiffness};
use sheet::{Input, Row, Scalar};

use crate::words::{name_of, word};

/// The strength of the ring.
pub const RING_INPUT: Input = Input::optional(&["adhesion_n_m"], "0 N/m");

/// The work of adhesion per area.
pub const WORK_INPUT: Input = Input::optional(&["work_of_adhesion_j_m2"], "none; dmt and jkr need it");

/// The columns of a law of contact.
pub const LAW_INPUTS: [Input; 10] = [
    Input::required(&["stiffness_pa"]),
    RING_INPUT,
    Input::optional(&["zeta_h"], "0"),
    Input::optional(&["zeta_a"], "0"),
    Input::optional(&["external_force_n"], "0 N"),
    Input::optional(&["law"], "ring if adhesion_n_m is not 0, otherwise hertz"),
    WORK_INPUT,
    Input::optional(&["damping"], "hysteretic by zeta_h"),
    Input::optional(&["damping_value"], "none"),
    Input::optional(&["end_rule"], "no-indentation; snap-off with jkr"),
];

/// Law of the elastic force and of adhesion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LawName {
    Hertz,
    Ring,
    Dmt,
    Jkr,
}

impl LawName {
    /// The law of a row.
    fn of<T: Scalar>(row: &Row<'_>) -> Result<Self, String> {
        let without_word = if row.or_zero::<T>("adhesion_n_m")? == T::ZERO { Self::Hertz } else { Self::Ring };
        Ok(word(row, "law", Self::value_variants())?.unwrap_or(without_word))
    }

    /// Its word in a table.
    pub fn word(self) -> &'static str {
        match self {
            Self::Hertz => "hertz",
            Self::Ring => "ring",
            Self::Dmt => "dmt",
            Self::Jkr => "jkr",
        }
    }

    /// How its contact can end; first the rule of a row that gives none.
    fn end_rules(self) -> &'static [EndRule] {
        match self {
            Self::Hertz => &[EndRule::NoIndentation, EndRule::NoForce],
            Self::Ring | Self::Dmt => &[EndRule::NoIndentation],
            Self::Jkr => &[EndRule::SnapOff, EndRule::PullOff],
        }
    }

    /// Checks that a row gives no number of another law, which would have no effect.
    fn refuse_numbers_of_others<T: Scalar>(self, row: &Row<'_>) -> Result<(), String> {
        for (column, owner, others) in OWNERS {
            if let Some(text) = row.text(column)
                && others.contains(&self)
                && row.or_zero::<T>(column)? != T::ZERO
            {
                let law = name_of(&self);
                return Err(format!(
                    "{column}: \"{text}\" is refused: it belongs to {owner}, but the law of the row is {law}; leave the \
                     cell empty or choose another law"
                ));
            }
        }
        Ok(())
    }
}

/// Columns of one law or two, with those of the other laws that take no number but zero there.
const OWNERS: [(&str, &str, &[LawName]); 3] = [
    ("adhesion_n_m", "the ring", &[LawName::Hertz, LawName::Dmt, LawName::Jkr]),
    // Hertz's contact is the ring of strength zero, whatever its damping.
    ("zeta_a", "the ring", &[LawName::Dmt, LawName::Jkr]),
    ("work_of_adhesion_j_m2", "dmt and jkr", &[LawName::Hertz, LawName::Ring]),
];

/// Damping of the materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DampingName {
    None,
    Hysteretic,
    Viscoelastic,
    Constant,
}

/// Where contact ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum EndRule {
    NoIndentation,
    NoForce,
    SnapOff,
    PullOff,
}

/// The law of contact of a row, with its numbers.
#[derive(Clone, Copy)]
pub struct RowLaw<T> {
    pub name: LawName,
    end_rule: EndRule,
    pub stiffness: Stiffness<T>,
    /// Strength of the ring, N/m, and its damping.
    ring: (T, T),
    /// Work of adhesion per area, J/m^2; zero where the law has none.
    work: T,
    /// Damping of the materials, and its value; zero where there is none.
    damping: (DampingName, T),
    external_force: T,
}

impl<T: Scalar> RowLaw<T> {
    /// The law that a row states.
    pub fn read(row: &Row<'_>) -> Result<Self, String> {
        let stiffness = Stiffness::new(row.required("stiffness_pa")?).map_err(|error| row.reason(error))?;
        let name = LawName::of::<T>(row)?;
        name.refuse_numbers_of_others::<T>(row)?;
        let rules = name.end_rules();
        let end_rule =
            word(row, "end_rule", rules).map_err(|reason| format!("{reason} with law {}", name_of(&name)))?;
        Ok(Self {
            name,
            end_rule: end_rule.unwrap_or(rules[0]),
            stiffness,
            ring: (row.or_zero("adhesion_n_m")?, row.or_zero("zeta_a")?),
            work: match name {
                LawName::Hertz | LawName::Ring => T::ZERO,
                LawName::Dmt | LawName::Jkr => row.required("work_of_adhesion_j_m2")?,
            },
            damping: damping(row)?,
            external_force: row.or_zero("external_force_n")?,
        })
    }

    /// Whether its adhesion is the ring.
    pub fn has_ring(&self) -> bool {
        self.name == LawName::Ring
    }

    /// The same law with another strength of the ring (N/m) or work of adhesion per area (J/m^2), whichever it has.
    pub fn with_adhesion(mut self, adhesion: T) -> Self {
        match self.name {
            LawName::Hertz => {}
            LawName::Ring => self.ring.0 = adhesion,
            LawName::Dmt | LawName::Jkr => self.work = adhesion,
        }
        self
    }

    /// The law of the library.
    pub fn law(&self) -> Result<AnyLaw<T>, InputError> {
        let law = self.undamped()?;
        let (damping, value) = self.damping;
        let law = match damping {
            DampingName::None => law,
            DampingName::Hysteretic => law.with_damping(value)?,
            DampingName::Viscoelastic => law.with_viscoelastic_damping(value)?,
            DampingName::Constant => law.with_constant_damping(value)?,
        };
        if self.external_force == T::ZERO { Ok(law) } else { law.with_external_force(self.external_force) }
    }

    fn undamped(&self) -> Result<AnyLaw<T>, InputError> {
        let Self { stiffness, ring: (strength, zeta), work, .. } = *self;
        match (self.name, self.end_rule) {
            (LawName::Hertz, end_rule) => {
                // Without a ring the number has no effect, but it is checked as with one.
                Parameter::AdhesionDamping.check(zeta)?;
                let tension = end_rule != EndRule::NoForce;
                Ok(if tension { AnyLaw::hertz(stiffness) } else { AnyLaw::without_tension(stiffness) })
            }
            (LawName::Ring, _) => AnyLaw::ring(stiffness, strength, zeta),
            (LawName::Dmt, _) => AnyLaw::dmt(stiffness, work),
            (LawName::Jkr, EndRule::PullOff) => AnyLaw::jkr(stiffness, work, JkrEnd::PullOff),
            (LawName::Jkr, _) => AnyLaw::jkr(stiffness, work, JkrEnd::SnapOff),
        }
    }

    /// The dimensionless groups of an impact; `None` if the law or its damping is not among those that they describe.
    pub fn groups(&self, sphere: Sphere<T>, before: &PlanarMotion<T>) -> Result<Option<Groups<T>>, InputError> {
        let (LawName::Hertz | LawName::Ring, (DampingName::None | DampingName::Hysteretic, zeta_h)) =
            (self.name, self.damping)
        else {
            return Ok(None);
        };
        let (strength, zeta_a) = self.ring;
        let scene = Contact::hertz(sphere, self.stiffness).with_damping(zeta_h)?.with_ring(strength, zeta_a)?;
        let groups = if self.external_force == T::ZERO {
            scene.groups(before)
        } else {
            scene.with_external_force(self.external_force)?.groups(before)
        };
        groups.map(Some)
    }
}

/// The damping of the materials that a row states, by name or by `zeta_h` alone, and its value.
fn damping<T: Scalar>(row: &Row<'_>) -> Result<(DampingName, T), String> {
    let named = word(row, "damping", DampingName::value_variants())?;
    match (named, row.number("zeta_h")?) {
        (Some(_), Some(_)) => Err("damping: given twice, as zeta_h and damping; leave one of them empty".into()),
        (None | Some(DampingName::None), zeta_h) => {
            refuse_damping_value::<T>(row)?;
            Ok(zeta_h.map_or((DampingName::None, T::ZERO), |zeta| (DampingName::Hysteretic, zeta)))
        }
        (Some(damping), None) => Ok((damping, row.required("damping_value")?)),
    }
}

/// Checks that a row which names no damping has no value of one.
fn refuse_damping_value<T: Scalar>(row: &Row<'_>) -> Result<(), String> {
    match row.text("damping_value") {
        Some(text) if row.or_zero::<T>("damping_value")? != T::ZERO => Err(format!(
            "damping_value: \"{text}\" is refused: the row names no damping; enter hysteretic, viscoelastic or constant in \
             the column damping, or leave the cell empty"
        )),
        _ => Ok(()),
    }
}
