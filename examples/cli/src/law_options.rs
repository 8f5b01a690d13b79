//! The law of contact by options, for commands that read no rows.

use clap::Args;
use microimpact::contact::AnyLaw;
use sheet::{Decimal, Sheet};

use crate::contact_law::{DampingName, EndRule, LAW_INPUTS, LawName, RowLaw};
use crate::words::name_of;

/// Options of the law of contact; those that are left out are the paper's. The help names most of them in two lines, and the manual has
/// all.
#[derive(Args)]
pub struct LawOptions {
    /// Hertz stiffness K, Pa
    #[arg(long, default_value_t = 7.5e10)]
    stiffness: f64,
    /// Law of contact
    #[arg(long, value_enum, default_value_t = LawName::Ring)]
    law: LawName,
    /// Ring: strength f0 of adhesion, N/m [default: 250]
    #[arg(long, hide_short_help = true)]
    adhesion: Option<f64>,
    /// Ring: damping zeta_A of adhesion [default: 6.25]
    #[arg(long, hide_short_help = true)]
    zeta_a: Option<f64>,
    /// Dmt and jkr: work of adhesion per area, J/m^2
    #[arg(long, value_name = "WORK", hide_short_help = true)]
    work_of_adhesion: Option<f64>,
    /// Hysteretic damping zeta_H in the materials [default: 10.5 without --damping]
    #[arg(long, conflicts_with = "damping")]
    zeta_h: Option<f64>,
    /// Damping in the materials, instead of --zeta-h
    #[arg(long, value_enum, hide_short_help = true)]
    damping: Option<DampingName>,
    /// Its value: zeta_H, relaxation time in s, or restitution without adhesion
    #[arg(long, value_name = "VALUE", requires = "damping", hide_short_help = true)]
    damping_value: Option<f64>,
    /// Where contact ends
    #[arg(long, value_enum, hide_short_help = true)]
    end_rule: Option<EndRule>,
    /// Constant force, N, positive out of the surface
    #[arg(long, value_name = "FORCE", hide_short_help = true)]
    external_force: Option<f64>,
}

/// The options that a short help does not list, for the end of the help.
pub const FURTHER: &str = "\
Also of the law: --adhesion, --zeta-a (ring); --work-of-adhesion (dmt, jkr); --damping and --damping-value; --end-rule; \
--external-force. `cargo microimpact man table` explains them.";

/// The paper's strength of adhesion in N/m, its damping, half of the printed value as in the paper's program, and the damping of the
/// materials.
const ADHESION: f64 = 250.0;
const ZETA_A: f64 = 6.25;
const ZETA_H: f64 = 10.5;

/// A column of a law, the option that gives it, its name in a text, and its unit.
struct Named(&'static str, &'static str, &'static str, &'static str);

/// In the order in which a text names them. A column whose name is a part of that of another comes after that.
const NAMES: [Named; 10] = [
    Named("stiffness_pa", "--stiffness", "K", " Pa"),
    Named("law", "--law", "law", ""),
    Named("work_of_adhesion_j_m2", "--work-of-adhesion", "work of adhesion", " J/m^2"),
    Named("adhesion_n_m", "--adhesion", "f0", " N/m"),
    Named("zeta_h", "--zeta-h", "zeta_H", ""),
    Named("zeta_a", "--zeta-a", "zeta_A", ""),
    Named("damping", "--damping", "damping", ""),
    Named("damping_value", "--damping-value", "of value", ""),
    Named("end_rule", "--end-rule", "contact ends by", ""),
    Named("external_force_n", "--external-force", "external force", " N"),
];

impl LawOptions {
    /// The cells of a row that states the law, in the order of [`NAMES`]; `None` where it gives none.
    fn cells(&self) -> [Option<String>; 10] {
        let number = |value: Option<f64>| value.map(|value| format!("{value:e}"));
        let of_ring = |value: Option<f64>, paper: f64| number(value.or((self.law == LawName::Ring).then_some(paper)));
        [
            number(Some(self.stiffness)),
            Some(name_of(&self.law)),
            number(self.work_of_adhesion),
            of_ring(self.adhesion, ADHESION),
            number(self.zeta_h.or(self.damping.is_none().then_some(ZETA_H))),
            of_ring(self.zeta_a, ZETA_A),
            self.damping.map(|damping| name_of(&damping)),
            number(self.damping_value),
            self.end_rule.map(|rule| name_of(&rule)),
            number(self.external_force),
        ]
    }

    /// The law, checked as that of a row.
    pub fn law(&self) -> Result<AnyLaw<f64>, String> {
        let given = NAMES.iter().zip(self.cells()).filter_map(|(Named(column, ..), cell)| Some((*column, cell?)));
        let (columns, cells): (Vec<_>, Vec<_>) = given.unzip();
        let table = format!("{}\n{}\n", columns.join(","), cells.join(","));
        let mut sheet = Sheet::open(table.as_bytes(), &LAW_INPUTS, Some(Decimal::Point))?;
        let row = sheet.next_row()?.ok_or("the options state no law")?;
        let law = RowLaw::read(&row).and_then(|law| law.law().map_err(|error| row.reason(error)));
        law.map_err(|reason| by_options(&reason))
    }

    /// What is stated of the law, in words.
    pub fn in_words(&self) -> String {
        let is_ring = self.law == LawName::Ring;
        let named = NAMES.iter().zip(self.cells()).filter(|(Named(column, ..), _)| !is_ring || *column != "law");
        let words = named.filter_map(|(Named(_, _, name, unit), cell)| {
            let cell = cell?;
            // A number in the shortest form, but for a stiffness.
            let short = cell.parse::<f64>().ok().filter(|value| *name != "K" && (1e-3..1e6).contains(&value.abs()));
            Some(format!("{name} {}{unit}", short.map_or(cell, |value| value.to_string())))
        });
        words.collect::<Vec<_>>().join(", ")
    }
}

/// A reason that a row is refused for, with options in place of columns.
fn by_options(reason: &str) -> String {
    let words = NAMES.iter().filter(|Named(column, ..)| column.contains('_'));
    let named = words.fold(reason.to_owned(), |text, Named(column, option, ..)| text.replace(column, option));
    let named = match named.split_once(": ") {
        Some(("law", rest)) => format!("--law: {rest}"),
        Some(("damping", rest)) => format!("--damping: {rest}"),
        _ => named,
    };
    named.replace(" of the row", "").replace("leave the cell empty", "leave it out")
}
