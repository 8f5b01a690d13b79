//! Who takes part in the comparison of errors and costs.

use microimpact_scenes::methods::{ours, raw, regularised};

use crate::content::{Cell, Table};

/// A method or a crate.
pub(super) struct Method {
    /// In figures and tables.
    pub(super) name: &'static str,
    /// What it is.
    text: &'static str,
    /// Where it comes from; `None` for this repository.
    address: Option<&'static str>,
    /// Whether it is a method of this library, and no peer.
    pub(super) ours: bool,
}

const fn own(name: &'static str, text: &'static str) -> Method {
    Method { name, text, address: None, ours: true }
}

const fn plain(name: &'static str, text: &'static str) -> Method {
    Method { name, text, address: None, ours: false }
}

const fn solver(name: &'static str, text: &'static str, address: &'static str) -> Method {
    Method { name, text, address: Some(address), ours: false }
}

/// Methods in the order of their colours, which they have in every figure.
pub(super) const METHODS: [Method; 11] = [
    own(ours::FIXED_COST, "this library, a fixed number of iterations"),
    own(ours::COLLOCATION, "this library, intervals by tolerance"),
    own(ours::ADAPTIVE, "this library, chooses nodes and method"),
    own(ours::PAPER, "this library, Runge-Kutta-Gill in time"),
    plain(raw::NAME, "classical Runge-Kutta on B6 to B10 as printed"),
    plain(regularised::NAME, "classical Runge-Kutta in the contact radius"),
    solver("numeris", "explicit and stiff, also on boards", "https://github.com/ssmichael1/numeris"),
    solver("multicalc", "explicit, also on boards", "https://github.com/kmolan/multicalc-rust"),
    solver("ode_solvers", "explicit", "https://github.com/srenevey/ode-solvers"),
    solver("differential-equations", "explicit", "https://github.com/Ryan-D-Gast/differential-equations"),
    solver("diffsol", "implicit and explicit", "https://github.com/martinjrobins/diffsol"),
];

/// What each of them is given.
pub(super) const RULES: &str = "This library's methods and RK4 in time start from SI units. RK4 in z and the crates solve the \
    regularised equations in the contact radius, which are set up before. A crate that does not find events is given a \
    place shortly before each event and integrates the rest against the event's own variable; other entries find the \
    event on the dense output of a crate or by its own search. The crates take part in normal scenes only: friction and \
    spin are quadratures after the normal motion, so the comparison would be the same. RK4 in time and the crates do not \
    run in fixed point, which cannot hold SI units. In fixed point the groups of the scene are computed before.";

/// Whether the crate takes part that needs a newer compiler.
pub(super) const DIFFSOL: &str = if cfg!(feature = "diffsol") {
    "The crate diffsol takes part, with its own search for events and without."
} else {
    "The crate diffsol, which takes minutes to build, takes part in \
     `cargo run --release --package report --features diffsol`."
};

/// Whether a method is one of this library.
pub(super) fn is_ours(name: &str) -> bool {
    METHODS.iter().any(|method| method.ours && method.name == name)
}

/// All of them, with links.
pub(super) fn table() -> Table {
    let takes_part = |method: &&Method| method.name != "diffsol" || cfg!(feature = "diffsol");
    let row = |method: &Method| {
        let name = match method.address {
            Some(address) => Cell::Link(method.name, address),
            None => Cell::from(method.name),
        };
        vec![name, Cell::from(method.text)]
    };
    Table {
        name: "cost-contestants".to_owned(),
        caption:
            "Who is compared below. A peer is whatever is no method of this library. Solvers in other languages take part in the \
                  first picture only, and so do scenes with strong damping."
                .to_owned(),
        columns: ["method", "what it is"].map(str::to_owned).to_vec(),
        rows: METHODS.iter().filter(takes_part).map(row).collect(),
    }
}
