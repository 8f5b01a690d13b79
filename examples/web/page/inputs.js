// What the user sets. Each number has the column that the program reads, its symbol, its unit with the factor to SI, the range
// of its slider, and where it starts: at the paper's Table 1. A slider without zero is logarithmic. What is `aside` is no column of the
// program; what is `optional` has a column only where it differs from where it starts.

const SIMULATION = { scene_model: ["simulation"] }, RIGID_BODY = { scene_model: ["rigid-body"] };

// A material of the list of the program; "" where its numbers are set by hand.
const material = (key, label) => ({ aside: true, key, label, start: "", choices: { "": "by its numbers" } });

const MODEL = [
    {
        aside: true, key: "scene_model", label: "Model", start: "simulation", choices: {
            simulation: "simulation of the contact",
            "rigid-body": "rigid body",
        },
    },
];

const PARTICLE = [
    material("sphere_material", "Material of the sphere"),
    { column: "radius_m", label: "Radius", symbol: "r", unit: "µm", si: 1e-6, least: 0.1, most: 500, start: 5.06 },
    { column: "density_kg_m3", label: "Density", symbol: "ρ", unit: "kg/m³", si: 1, least: 100, most: 20000, start: 2600, of: "sphere_material" },
];

const SURFACE = [
    material("surface_material", "Material of the surface"),
    { column: "stiffness_pa", label: "Hertz stiffness", symbol: "K", unit: "GPa", si: 1e9, least: 0.001, most: 500, start: 75, of: "surface_material", where: SIMULATION },
    {
        column: "law", label: "Law of contact", start: "ring", where: SIMULATION, choices: {
            hertz: "Hertz, no adhesion",
            ring: "ring of adhesion (Brach, Dunn)",
            dmt: "DMT (Derjaguin et al.)",
            jkr: "JKR (Johnson et al.)",
        },
    },
    { column: "adhesion_n_m", label: "Strength of adhesion", symbol: "f₀", unit: "N/m", si: 1, least: 0.1, most: 10000, start: 250, where: { ...SIMULATION, law: ["ring"] } },
    { column: "zeta_a", label: "Damping of adhesion", symbol: "ζ_A", unit: "1", si: 1, least: 0, most: 50, start: 6.25, where: { ...SIMULATION, law: ["ring"] } },
    { column: "work_of_adhesion_j_m2", label: "Work of adhesion", symbol: "G", unit: "mJ/m²", si: 1e-3, least: 1, most: 10000, start: 100, of: "surface_material", where: { ...SIMULATION, law: ["dmt", "jkr"] } },
    {
        column: "damping", label: "Damping in the materials", start: "hysteretic", where: SIMULATION, choices: {
            none: "none",
            hysteretic: "hysteretic (Brach, Dunn)",
            viscoelastic: "viscoelastic",
            constant: "constant restitution",
        },
    },
    { column: "zeta_h", label: "Hysteretic damping", symbol: "ζ_H", unit: "1", si: 1, least: 0, most: 100, start: 10.5, where: { ...SIMULATION, damping: ["hysteretic"] } },
    { column: "damping_value", key: "relaxation", label: "Relaxation time", symbol: "τ", unit: "ns", si: 1e-9, least: 0.001, most: 1000, start: 1, where: { ...SIMULATION, damping: ["viscoelastic"] } },
    { column: "damping_value", key: "nominal", label: "Nominal restitution", symbol: "R₀", unit: "1", si: 1, least: 0.01, most: 1, start: 0.9, where: { ...SIMULATION, damping: ["constant"] } },
    {
        aside: true, key: "restitution_law", label: "Restitution without adhesion", start: "speed", where: RIGID_BODY, choices: {
            speed: "falls with the speed, R = k/(k + v)",
            power: "by a power of the speed, R = kᵖ/(kᵖ + vᵖ)",
            yield: "elastic-plastic sphere (Thornton)",
            constant: "the same at every speed",
        },
    },
    { column: "restitution_speed_m_s", label: "Speed of restitution", symbol: "k", unit: "m/s", si: 1, least: 1, most: 10000, start: 130, where: { ...RIGID_BODY, restitution_law: ["speed", "power"] } },
    { column: "restitution_power", label: "Power of restitution", symbol: "p", unit: "1", si: 1, least: 0.01, most: 1, start: 0.5, where: { ...RIGID_BODY, restitution_law: ["power"] } },
    { column: "yield_speed_m_s", label: "Speed at which it starts to yield", symbol: "v_y", unit: "m/s", si: 1, least: 0.001, most: 1000, start: 0.5, where: { ...RIGID_BODY, restitution_law: ["yield"] } },
    { column: "restitution", label: "Restitution", symbol: "R", unit: "1", si: 1, least: 0, most: 1, start: 0.978, where: { ...RIGID_BODY, restitution_law: ["constant"] } },
    {
        aside: true, key: "adhesion_law", label: "Adhesion", start: "work", where: RIGID_BODY, choices: {
            none: "none",
            work: "work of adhesion",
            coefficient: "coefficient",
            speed: "coefficient by speed, ρ = l^q/(l^q + v^q)",
        },
    },
    { column: "work_of_adhesion_j", label: "Work of adhesion", symbol: "W_A", unit: "pJ", si: 1e-12, least: 0.001, most: 1000, start: 2.22, where: { ...RIGID_BODY, adhesion_law: ["work"] } },
    { column: "adhesion_coefficient", label: "Adhesion coefficient", symbol: "ρ", unit: "1", si: 1, least: 0, most: 1, start: 0.237, where: { ...RIGID_BODY, adhesion_law: ["coefficient"] } },
    { column: "adhesion_speed_m_s", label: "Speed of adhesion", symbol: "l", unit: "m/s", si: 1, least: 0.001, most: 1000, start: 1, where: { ...RIGID_BODY, adhesion_law: ["speed"] } },
    { column: "adhesion_power", label: "Power of adhesion", symbol: "q", unit: "1", si: 1, least: 0.01, most: 16, start: 2, where: { ...RIGID_BODY, adhesion_law: ["speed"] } },
    { column: "friction", label: "Friction", symbol: "f", unit: "1", si: 1, least: 0, most: 1, start: 0.1 },
];

const COMPONENTS = { arrival: ["components"] }, PATH = { arrival: ["path"] };
const MOTION = [
    {
        aside: true, key: "arrival", label: "Given by", start: "components", choices: {
            components: "normal and tangential velocity",
            path: "speed and angle of incidence",
        },
    },
    { column: "speed_normal_m_s", label: "Approach speed", symbol: "v_n", unit: "m/s", si: 1, least: 0.01, most: 100, start: 2.8, where: COMPONENTS },
    { column: "speed_tangential_m_s", label: "Tangential velocity", symbol: "v_t", unit: "m/s", si: 1, least: -10, most: 10, start: 0, where: COMPONENTS },
    { aside: true, key: "path_speed", label: "Speed along the path", symbol: "v", unit: "m/s", si: 1, least: 0.01, most: 100, start: 2.8, where: PATH },
    { aside: true, key: "path_angle", label: "Angle between path and normal", symbol: "θ", unit: "°", si: 1, least: 0, most: 89, start: 0, where: PATH },
    { column: "spin_rad_s", label: "Spin", symbol: "ω", unit: "10³ rad/s", si: 1e3, least: -1000, most: 1000, start: 146 },
];

// The program knows compliance with these terms alone.
const COMPLIANT = { ...SIMULATION, law: ["hertz"], damping: ["none", "hysteretic"] };
const ALONG = [
    { column: "peeling_n_m", optional: true, label: "Peeling moment", symbol: "λ", unit: "pN m", si: 1e-12, least: 0, most: 100, start: 0, where: { ...SIMULATION, law: ["ring"] } },
    {
        aside: true, key: "compliance", label: "Contact that sticks", start: "rigid", where: COMPLIANT,
        choices: { rigid: "is rigid", elastic: "is elastic (Maw, Barber, Fawcett)" },
    },
    { column: "stiffness_ratio", label: "Tangential over normal stiffness", symbol: "χ", unit: "1", si: 1, least: 0.1, most: 2, start: 0.83, where: { ...COMPLIANT, compliance: ["elastic"] } },
    { column: "rolling_arm_m", optional: true, label: "Rolling-dissipation arm", symbol: "μₘa_c", unit: "nm", si: 1e-9, least: 0, most: 1000, start: 0, where: RIGID_BODY },
];

const MORE = [
    { column: "gyration_ratio", optional: true, label: "Squared radius of gyration over r²: 0.4 solid, 0.667 hollow", symbol: "κ", unit: "1", si: 1, least: 0.2, most: 0.667, start: 0.4 },
    { column: "external_force_n", optional: true, label: "External force, away from the surface", symbol: "F", unit: "µN", si: 1e-6, least: -100, most: 100, start: 0, where: SIMULATION },
    {
        column: "end_rule", key: "end_of_hertz", optional: true, label: "Contact ends", start: "no-indentation", where: { ...SIMULATION, law: ["hertz"] },
        choices: { "no-indentation": "where the indentation is zero", "no-force": "where the force is zero" },
    },
    {
        column: "end_rule", key: "end_of_jkr", optional: true, label: "Contact ends", start: "snap-off", where: { ...SIMULATION, law: ["jkr"] },
        choices: { "snap-off": "where the contact snaps off", "pull-off": "at the largest tension" },
    },
    { column: "yield_pressure_pa", optional: true, label: "Contact pressure at which it yields, 0 where not known", symbol: "p_y", unit: "GPa", si: 1e9, least: 0, most: 20, start: 0, where: SIMULATION },
];

// Standard errors: in percent of a number that is not zero, or in the unit of a number that may be zero.
const error = (errorOf, column, label, symbol, where = {}) =>
    ({ errorOf, column, label, symbol, unit: "%", least: 0, most: 50, start: 0, where });
const errorIn = (unit, si, most, column, label, symbol, where = {}) =>
    ({ optional: true, column, label, symbol, unit, si, least: 0, most, start: 0, where });
const ERRORS = [
    error("radius_m", "radius_error_m", "of the radius", "r"),
    error("density_kg_m3", "density_error_kg_m3", "of the density", "ρ"),
    error("stiffness_pa", "stiffness_error_pa", "of the stiffness", "K", SIMULATION),
    error("adhesion_n_m", "adhesion_error_n_m", "of the strength of adhesion", "f₀", { ...SIMULATION, law: ["ring"] }),
    error("zeta_a", "zeta_a_error", "of the damping of adhesion", "ζ_A", { ...SIMULATION, law: ["ring"] }),
    error("work_of_adhesion_j_m2", "work_of_adhesion_error_j_m2", "of the work of adhesion", "G", { ...SIMULATION, law: ["dmt", "jkr"] }),
    error("zeta_h", "zeta_h_error", "of the hysteretic damping", "ζ_H", { ...SIMULATION, damping: ["hysteretic"] }),
    error("restitution_speed_m_s", "restitution_speed_error_m_s", "of the speed of restitution", "k", { ...RIGID_BODY, restitution_law: ["speed", "power"] }),
    error("yield_speed_m_s", "yield_speed_error_m_s", "of the speed of yield", "v_y", { ...RIGID_BODY, restitution_law: ["yield"] }),
    errorIn("1", 1, 0.2, "restitution_error", "of the restitution", "R", { ...RIGID_BODY, restitution_law: ["constant"] }),
    error("work_of_adhesion_j", "work_of_adhesion_error_j", "of the work of adhesion", "W_A", { ...RIGID_BODY, adhesion_law: ["work"] }),
    errorIn("1", 1, 0.2, "adhesion_coefficient_error", "of the adhesion coefficient", "ρ", { ...RIGID_BODY, adhesion_law: ["coefficient"] }),
    error("adhesion_speed_m_s", "adhesion_speed_error_m_s", "of the speed of adhesion", "l", { ...RIGID_BODY, adhesion_law: ["speed"] }),
    errorIn("1", 1, 0.2, "friction_error", "of the friction", "f"),
    error("speed_normal_m_s", "speed_normal_error_m_s", "of the approach speed", "v_n"),
    errorIn("m/s", 1, 5, "speed_tangential_error_m_s", "of the tangential velocity", "v_t"),
    errorIn("10³ rad/s", 1e3, 100, "spin_error_rad_s", "of the spin", "ω"),
    errorIn("µN", 1e-6, 10, "external_force_error_n", "of the external force", "F", SIMULATION),
];

const INPUTS = [...MODEL, ...PARTICLE, ...SURFACE, ...MOTION, ...ALONG, ...MORE, ...ERRORS];

// Columns of a file for which the page offers a choice, with what they hold, its symbol, and the model that reads them if it is
// one; the others are read by their names.
const OFFERED = [
    ["radius_m", "radius", "r"],
    ["diameter_m", "diameter, instead of the radius", "d"],
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

// What a table may lack. It lacks a group if it has none of its columns; a model that is named here then cannot compute a row.
const RIGID = "rigid-body", SIMULATED = "simulation";
const SPACE = ["velocity_x_m_s", "velocity_y_m_s", "velocity_z_m_s"];
const GROUPS = [
    { needed: [RIGID, SIMULATED], measured: true, columns: ["radius_m", "diameter_m"] },
    { needed: [RIGID, SIMULATED], columns: ["density_kg_m3"] },
    { needed: [RIGID, SIMULATED], measured: true, columns: ["speed_normal_m_s", ...SPACE] },
    { needed: [], columns: ["speed_tangential_m_s", ...SPACE] },
    { needed: [], columns: ["spin_rad_s", ...SPACE] },
    { needed: [], columns: ["gyration_ratio"] },
    { needed: [], columns: ["friction", "impulse_ratio"] },
    { needed: [SIMULATED], columns: ["stiffness_pa"] },
    { needed: [], columns: ["law", "adhesion_n_m", "zeta_a", "work_of_adhesion_j_m2", "end_rule"] },
    { needed: [], columns: ["zeta_h", "damping", "damping_value"] },
    { needed: [], columns: ["external_force_n"] },
    { needed: [], columns: ["peeling_n_m"] },
    { needed: [], columns: ["stiffness_ratio"] },
    { needed: [], columns: ["rolling_arm_m"] },
    { needed: [], columns: ["yield_pressure_pa"] },
    { needed: [RIGID], columns: ["restitution", "restitution_speed_m_s", "restitution_power", "yield_speed_m_s"] },
    { needed: [], columns: ["adhesion_coefficient", "work_of_adhesion_j", "adhesion_speed_m_s", "adhesion_power"] },
];
