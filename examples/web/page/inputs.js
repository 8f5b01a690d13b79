// What the user sets. Each number has the column that the program reads, its symbol, its unit with the factor to SI, the range
// of its slider, and where it starts: at the paper's Table 1. A slider without zero is logarithmic.

const PARTICLE = [
    { column: "radius_m", label: "Radius", symbol: "r", unit: "µm", si: 1e-6, least: 0.1, most: 500, start: 5.06 },
    { column: "density_kg_m3", label: "Density", symbol: "ρ", unit: "kg/m³", si: 1, least: 100, most: 20000, start: 2600 },
];

const SURFACE = [
    { column: "stiffness_pa", label: "Hertz stiffness", symbol: "K", unit: "GPa", si: 1e9, least: 0.001, most: 500, start: 75 },
    {
        column: "law", label: "Law of contact", start: "ring", choices: {
            hertz: "Hertz, no adhesion",
            ring: "ring of adhesion (Brach, Dunn)",
            dmt: "DMT (Derjaguin et al.)",
            jkr: "JKR (Johnson et al.)",
        },
    },
    { column: "adhesion_n_m", label: "Strength of adhesion", symbol: "f₀", unit: "N/m", si: 1, least: 0.1, most: 10000, start: 250, where: { law: ["ring"] } },
    { column: "zeta_a", label: "Damping of adhesion", symbol: "ζ_A", unit: "1", si: 1, least: 0, most: 50, start: 6.25, where: { law: ["ring"] } },
    { column: "work_of_adhesion_j_m2", label: "Work of adhesion", symbol: "G", unit: "mJ/m²", si: 1e-3, least: 1, most: 10000, start: 100, where: { law: ["dmt", "jkr"] } },
    {
        column: "damping", label: "Damping in the materials", start: "hysteretic", choices: {
            none: "none",
            hysteretic: "hysteretic (Brach, Dunn)",
            viscoelastic: "viscoelastic",
            constant: "constant restitution",
        },
    },
    { column: "zeta_h", label: "Hysteretic damping", symbol: "ζ_H", unit: "1", si: 1, least: 0, most: 100, start: 10.5, where: { damping: ["hysteretic"] } },
    { column: "damping_value", key: "relaxation", label: "Relaxation time", symbol: "τ", unit: "ns", si: 1e-9, least: 0.001, most: 1000, start: 1, where: { damping: ["viscoelastic"] } },
    { column: "damping_value", key: "nominal", label: "Nominal restitution", symbol: "R₀", unit: "1", si: 1, least: 0.01, most: 1, start: 0.9, where: { damping: ["constant"] } },
    { column: "friction", label: "Friction", symbol: "f", unit: "1", si: 1, least: 0, most: 1, start: 0.1 },
];

const MOTION = [
    { column: "speed_normal_m_s", label: "Approach speed", symbol: "v_n", unit: "m/s", si: 1, least: 0.01, most: 100, start: 2.8 },
    { column: "speed_tangential_m_s", label: "Tangential velocity", symbol: "v_t", unit: "m/s", si: 1, least: -10, most: 10, start: 0 },
    { column: "spin_rad_s", label: "Spin", symbol: "ω", unit: "10³ rad/s", si: 1e3, least: -1000, most: 1000, start: 146 },
];

// Standard errors in percent of the number.
const error = (of, column, label, symbol, where = {}) =>
    ({ of, column, label, symbol, unit: "%", least: 0, most: 50, start: 0, where });
const ERRORS = [
    error("radius_m", "radius_error_m", "of the radius", "r"),
    error("stiffness_pa", "stiffness_error_pa", "of the stiffness", "K"),
    error("adhesion_n_m", "adhesion_error_n_m", "of the strength of adhesion", "f₀", { law: ["ring"] }),
    error("work_of_adhesion_j_m2", "work_of_adhesion_error_j_m2", "of the work of adhesion", "G", { law: ["dmt", "jkr"] }),
    error("zeta_h", "zeta_h_error", "of the hysteretic damping", "ζ_H", { damping: ["hysteretic"] }),
    error("speed_normal_m_s", "speed_normal_error_m_s", "of the approach speed", "v_n"),
];

const INPUTS = [...PARTICLE, ...SURFACE, ...MOTION, ...ERRORS];

// Columns of a file for which the page offers a choice, with what they hold, its symbol, and the model that reads them if it is
// one; the others are read by their names.
const OFFERED = [
    ["radius_m", "radius", "r"],
    ["density_kg_m3", "density", "ρ"],
    ["speed_normal_m_s", "approach speed", "v_n"],
    ["speed_tangential_m_s", "tangential velocity", "v_t"],
    ["spin_rad_s", "spin", "ω"],
    ["friction", "friction", "f"],
    ["stiffness_pa", "stiffness", "K", "simulation"],
    ["adhesion_n_m", "strength of adhesion", "f₀", "simulation"],
    ["zeta_h", "damping in the materials", "ζ_H", "simulation"],
    ["zeta_a", "damping of adhesion", "ζ_A", "simulation"],
    ["law", "law of contact", "", "simulation"],
    ["work_of_adhesion_j_m2", "work of adhesion per area", "G", "simulation"],
    ["restitution", "restitution without adhesion", "R", "rigid-body"],
    ["restitution_speed_m_s", "speed k of R = k/(k + v)", "", "rigid-body"],
    ["adhesion_coefficient", "adhesion coefficient", "ρ", "rigid-body"],
    ["work_of_adhesion_j", "work of adhesion", "W_A", "rigid-body"],
];
