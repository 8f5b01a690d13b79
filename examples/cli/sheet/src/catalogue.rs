//! The columns that the commands read and write: one line for each, with unit, range, meaning and an example.
//!
//! Headers are read by this table, messages name its columns, and the list of columns and the templates are made from it. Which
//! command reads a column, and what it uses where the column is absent, the command itself says by its [`Input`](crate::Input)s.

use microimpact::Parameter;
use microimpact::Parameter as P;

use crate::header::stated_unit;
use crate::units::units_of;

/// The values that a column may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Those of a parameter of the library, whose errors are reported for this column.
    Of(Parameter),
    /// Those of a parameter whose errors are reported for another column.
    Like(Parameter),
    /// From a number to another; infinity is no bound.
    Between(f64, f64),
    /// In words.
    Words(&'static str),
}

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Its name, which ends with its unit.
    pub name: &'static str,
    /// Symbol of its unit; `1` for a number without one, empty for a word.
    pub unit: &'static str,
    /// The values that it may have.
    pub range: Range,
    /// A value for a template; empty where the cell is best left empty.
    pub example: &'static str,
    /// What it holds.
    pub meaning: &'static str,
}

impl Column {
    /// The column with a name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        COLUMNS.iter().find(|column| column.name == name)
    }

    /// Its name without its unit.
    pub(crate) fn base(&self) -> &'static str {
        let suffix = self.unit.replace(['/', ' '], "_").to_lowercase();
        self.name.strip_suffix(suffix.as_str()).and_then(|base| base.strip_suffix('_')).unwrap_or(self.name)
    }

    /// Headings that name the column, one for each unit, with the symbol of the unit. The first is its own name.
    #[must_use]
    pub fn names(&self) -> Vec<(String, &'static str)> {
        let mut names = vec![(self.name.to_owned(), self.unit)];
        for unit in units_of(self.unit).iter().filter(|unit| unit.symbol != self.unit) {
            let name = format!("{}_{}", self.base(), unit.suffix());
            // A name in lower case does not tell a milli from a mega, and a number without a unit has none in its name.
            let is_clear = self.base() != self.name && names.iter().all(|(other, _)| *other != name);
            names.push((if is_clear { name } else { format!("{} [{}]", self.base(), unit.symbol) }, unit.symbol));
        }
        names
    }

    /// The one of [`names`](Self::names) whose unit a heading with other words states, in brackets or at its end; `None` if it states
    /// none of this quantity.
    #[must_use]
    pub fn name_in_unit_of(&self, heading: &str) -> Option<String> {
        let unit = stated_unit(heading, units_of(self.unit))?;
        self.names().into_iter().find(|(_, symbol)| *symbol == unit.symbol).map(|(name, _)| name)
    }

    /// The range in words.
    #[must_use]
    pub fn range_in_words(&self) -> String {
        let (low, high) = match self.range {
            Range::Of(parameter) | Range::Like(parameter) => parameter.range(),
            Range::Between(low, high) => (low, high),
            Range::Words(words) => return words.to_owned(),
        };
        match (low.is_finite(), high.is_finite()) {
            (true, true) => format!("{} to {}", short(low), short(high)),
            (true, false) => format!("{} or more", short(low)),
            (false, true) => format!("{} or less", short(high)),
            (false, false) => "any number".to_owned(),
        }
    }
}

/// Decimal exponents from which a bound is written with a power of ten.
const LONG: f64 = 1e5;

fn short(bound: f64) -> String {
    let size = bound.abs();
    if bound == 0.0 || (size >= 1.0 / LONG.sqrt() && size < LONG) { bound.to_string() } else { format!("{bound:e}") }
}

const INFINITE: f64 = f64::INFINITY;
const POSITIVE: Range = Range::Between(0.0, INFINITE);
const ANY: Range = Range::Between(-INFINITE, INFINITE);
const FRACTION: Range = Range::Between(0.0, 1.0);
const ERROR: Range = Range::Between(0.0, 1e18);
const TEXT: Range = Range::Words("text");

macro_rules! columns {
    ($($name:literal $unit:literal $range:expr, $example:literal, $meaning:literal;)+) => {
        /// All columns, inputs first.
        pub const COLUMNS: &[Column] =
            &[$(Column { name: $name, unit: $unit, range: $range, example: $example, meaning: $meaning }),+];
    };
}

columns! {
    "name" "" TEXT, "Table 1: glass on steel", "label of the row; never read as a number";
    // The sphere.
    "radius_m" "m" Range::Of(P::Radius), "5.06e-6", "outer radius r of the sphere";
    "diameter_m" "m" Range::Between(2e-10, 2.0), "1.012e-5", "outer diameter of the sphere, instead of its radius";
    "density_kg_m3" "kg/m3" Range::Of(P::Density), "2600", "density of the sphere";
    "gyration_ratio" "1" Range::Of(P::GyrationRatio), "0.4", "k^2/r^2 with the radius of gyration k; 0.4 for a solid sphere";
    "mass_kg" "kg" POSITIVE, "1.4e-12", "mass of the sphere, instead of diameter and density";
    // Its motion.
    "speed_normal_m_s" "m/s" Range::Of(P::ApproachSpeed), "2.8", "approach speed: normal velocity towards the surface, a positive number";
    "speed_tangential_m_s" "m/s" Range::Of(P::TangentialVelocity), "0", "tangential velocity before the impact";
    "spin_rad_s" "rad/s" Range::Of(P::Spin), "1.46e5", "spin before the impact";
    "velocity_x_m_s" "m/s" Range::Of(P::VelocityComponent), "1", "velocity before the impact, x";
    "velocity_y_m_s" "m/s" Range::Of(P::VelocityComponent), "0", "velocity before the impact, y";
    "velocity_z_m_s" "m/s" Range::Of(P::VelocityComponent), "-2.8", "velocity before the impact, z";
    "spin_x_rad_s" "rad/s" Range::Like(P::Spin), "0", "spin before the impact about the x axis";
    "spin_y_rad_s" "rad/s" Range::Like(P::Spin), "0", "spin before the impact about the y axis";
    "spin_z_rad_s" "rad/s" Range::Like(P::Spin), "0", "spin before the impact about the z axis";
    "normal_x" "1" Range::Of(P::NormalLength), "0", "normal of unit length from the wall, or the second sphere, to the sphere, x";
    "normal_y" "1" Range::Of(P::NormalLength), "0", "the same, y";
    "normal_z" "1" Range::Of(P::NormalLength), "1", "the same, z";
    "wall_velocity_x_m_s" "m/s" Range::Like(P::VelocityComponent), "0", "velocity of the wall at the contact, x";
    "wall_velocity_y_m_s" "m/s" Range::Like(P::VelocityComponent), "0", "velocity of the wall at the contact, y";
    "wall_velocity_z_m_s" "m/s" Range::Like(P::VelocityComponent), "0", "velocity of the wall at the contact, z";
    "radius_2_m" "m" Range::Like(P::Radius), "5.06e-6", "radius of a second sphere, which takes the place of the wall";
    "density_2_kg_m3" "kg/m3" Range::Like(P::Density), "2600", "density of the second sphere";
    "gyration_ratio_2" "1" Range::Like(P::GyrationRatio), "0.4", "k^2/r^2 of the second sphere";
    "velocity_2_x_m_s" "m/s" Range::Like(P::VelocityComponent), "0", "velocity of the second sphere before the impact, x";
    "velocity_2_y_m_s" "m/s" Range::Like(P::VelocityComponent), "0", "velocity of the second sphere before the impact, y";
    "velocity_2_z_m_s" "m/s" Range::Like(P::VelocityComponent), "0", "velocity of the second sphere before the impact, z";
    "spin_2_x_rad_s" "rad/s" Range::Like(P::Spin), "0", "spin of the second sphere before the impact about the x axis";
    "spin_2_y_rad_s" "rad/s" Range::Like(P::Spin), "0", "spin of the second sphere before the impact about the y axis";
    "spin_2_z_rad_s" "rad/s" Range::Like(P::Spin), "0", "spin of the second sphere before the impact about the z axis";
    // Both models.
    "friction" "1" Range::Of(P::Friction), "0.1", "Coulomb's friction coefficient f";
    // The rigid body.
    "restitution" "1" Range::Of(P::Restitution), "0.978", "kinetic restitution R: that of the sphere without adhesion";
    "restitution_speed_m_s" "m/s" Range::Of(P::RestitutionSpeed), "130", "k of R = k^p/(k^p + v^p)";
    "restitution_power" "1" Range::Of(P::RestitutionPower), "", "p of R = k^p/(k^p + v^p)";
    "yield_speed_m_s" "m/s" Range::Of(P::YieldSpeed), "0.5", "speed at which an elastic-plastic sphere starts to yield (Thornton 1997)";
    "adhesion_coefficient" "1" Range::Of(P::AdhesionCoefficient), "0.237", "adhesion coefficient rho of a rigid body";
    "adhesion_speed_m_s" "m/s" Range::Of(P::AdhesionSpeed), "1", "l of rho = l^q/(l^q + v^q)";
    "adhesion_power" "1" Range::Of(P::AdhesionPower), "", "q of rho = l^q/(l^q + v^q)";
    "work_of_adhesion_j" "J" Range::Of(P::WorkOfAdhesion), "2.22e-12", "work of adhesion W_A of one contact";
    "impulse_ratio" "1" Range::Of(P::ImpulseRatio), "", "tangential over normal impulse mu, instead of friction";
    "rolling_arm_m" "m" Range::Of(P::RollingArm), "0", "rolling-dissipation coefficient times its arm, mu_m a_c";
    // The simulation.
    "stiffness_pa" "Pa" Range::Of(P::Stiffness), "7.5e10", "Hertz stiffness K";
    "law" "" Range::Words("hertz, ring, dmt or jkr"), "", "law of contact";
    "adhesion_n_m" "N/m" Range::Of(P::AdhesionStrength), "250", "strength f0 of the ring of adhesion, a force per length";
    "work_of_adhesion_j_m2" "J/m2" Range::Of(P::AdhesionEnergy), "", "work of adhesion G per area, of the laws dmt and jkr";
    "zeta_h" "1" Range::Of(P::MaterialDamping), "10.5", "hysteretic damping: c_H/C, where the elastic force is multiplied by 1 + c_H v and C = (m/(r^3 K sqrt(v)))^(2/5)";
    "zeta_a" "1" Range::Of(P::AdhesionDamping), "6.25", "damping of the ring of adhesion";
    "damping" "" Range::Words("none, hysteretic, viscoelastic or constant"), "", "damping of the materials, where zeta_h is empty";
    "damping_value" "" Range::Words("by damping"), "", "zeta_h of hysteretic damping, relaxation time in s of viscoelastic damping, or restitution of constant damping, 0.001 to 1";
    "end_rule" "" Range::Words("no-indentation, no-force, snap-off or pull-off"), "", "where contact ends: no-indentation or no-force with hertz, no-indentation with ring and dmt, snap-off or pull-off with jkr";
    "external_force_n" "N" Range::Of(P::ExternalForce), "0", "constant force, positive out of the surface; not with jkr and no-force";
    "peeling_n_m" "N m" Range::Of(P::PeelingMoment), "0", "strength lambda of the peeling moment, a moment";
    "stiffness_ratio" "1" Range::Of(P::StiffnessRatio), "0.83", "tangential over normal stiffness chi = k_t/((3/2) K a), 2 (1 - nu)/(2 - nu) of equal materials; only with hertz and the method adaptive";
    "yield_pressure_pa" "Pa" Range::Of(P::YieldPressure), "1e9", "contact pressure at which the material yields";
    // Standard errors of inputs.
    "radius_error_m" "m" ERROR, "1e-7", "standard error of radius_m";
    "density_error_kg_m3" "kg/m3" ERROR, "10", "standard error of density_kg_m3";
    "speed_normal_error_m_s" "m/s" ERROR, "0.02", "standard error of speed_normal_m_s";
    "speed_tangential_error_m_s" "m/s" ERROR, "0.02", "standard error of speed_tangential_m_s";
    "spin_error_rad_s" "rad/s" ERROR, "1e3", "standard error of spin_rad_s";
    "friction_error" "1" ERROR, "0.01", "standard error of friction";
    "restitution_error" "1" ERROR, "0.01", "standard error of restitution";
    "restitution_speed_error_m_s" "m/s" ERROR, "5", "standard error of restitution_speed_m_s";
    "yield_speed_error_m_s" "m/s" ERROR, "0.05", "standard error of yield_speed_m_s";
    "adhesion_coefficient_error" "1" ERROR, "0.01", "standard error of adhesion_coefficient";
    "work_of_adhesion_error_j" "J" ERROR, "1e-13", "standard error of work_of_adhesion_j";
    "adhesion_speed_error_m_s" "m/s" ERROR, "0.05", "standard error of adhesion_speed_m_s";
    "stiffness_error_pa" "Pa" ERROR, "1e9", "standard error of stiffness_pa";
    "adhesion_error_n_m" "N/m" ERROR, "10", "standard error of adhesion_n_m";
    "work_of_adhesion_error_j_m2" "J/m2" ERROR, "1e-3", "standard error of work_of_adhesion_j_m2";
    "zeta_h_error" "1" ERROR, "0.5", "standard error of zeta_h";
    "zeta_a_error" "1" ERROR, "0.5", "standard error of zeta_a";
    "external_force_error_n" "N" ERROR, "0", "standard error of external_force_n";
    // Measurements.
    "rebound_speed_m_s" "m/s" Range::Of(P::ReboundSpeed), "2.09", "normal velocity away from the surface after the impact";
    "speed_tangential_out_m_s" "m/s" Range::Of(P::TangentialVelocity), "0.21", "tangential velocity after the impact";
    "spin_out_rad_s" "rad/s" Range::Of(P::Spin), "4.16e4", "spin after the impact";
    "overall_restitution" "1" FRACTION, "0.746", "overall restitution e: rebound speed over approach speed; 0 for a capture";
    "outcome" "" Range::Words("rebound, capture, undecided or cannot tell"), "", "how the impact ends";
    "velocity_error_m_s" "m/s" Range::Of(P::VelocityError), "0.02", "standard error of each measured velocity";
    "rebound_speed_error_m_s" "m/s" ERROR, "0.02", "standard error of rebound_speed_m_s";
    "speed_tangential_out_error_m_s" "m/s" ERROR, "0.02", "standard error of speed_tangential_out_m_s";
    "spin_out_error_rad_s" "rad/s" ERROR, "1e3", "standard error of spin_out_rad_s";
    "overall_restitution_error" "1" ERROR, "0.01", "standard error of overall_restitution";
    "diameter_error_m" "m" ERROR, "1e-7", "standard error of diameter_m";
    // Distributions of populations.
    "diameter_median_m" "m" POSITIVE, "8.6e-6", "median of a log-normal distribution of diameters";
    "diameter_geometric_deviation" "1" Range::Between(1.0, INFINITE), "1.2", "geometric standard deviation of the diameters";
    "diameter_mean_m" "m" POSITIVE, "8.6e-6", "mean of a normal distribution of diameters";
    "diameter_deviation_m" "m" POSITIVE, "1e-6", "standard deviation of the diameters";
    "radius_median_m" "m" POSITIVE, "4.3e-6", "median of a log-normal distribution of radii";
    "radius_geometric_deviation" "1" Range::Between(1.0, INFINITE), "1.2", "geometric standard deviation of the radii, which is that of the diameters";
    "radius_mean_m" "m" POSITIVE, "4.3e-6", "mean of a normal distribution of radii";
    "radius_deviation_m" "m" POSITIVE, "5e-7", "standard deviation of the radii";
    "speed_m_s" "m/s" POSITIVE, "1.9", "speed along the path of all spheres";
    "speed_median_m_s" "m/s" POSITIVE, "1.9", "median of a log-normal distribution of speeds along the path";
    "speed_geometric_deviation" "1" Range::Between(1.0, INFINITE), "1.3", "geometric standard deviation of the speeds";
    "speed_mean_m_s" "m/s" POSITIVE, "1.9", "mean of a normal distribution of speeds along the path";
    "speed_deviation_m_s" "m/s" POSITIVE, "0.3", "standard deviation of the speeds";
    "angle_deg" "deg" Range::Between(0.0, 89.9), "0", "angle between the path and the normal of the surface";
    "angle_mean_deg" "deg" Range::Between(0.0, 89.9), "30", "mean of a normal distribution of these angles";
    "angle_deviation_deg" "deg" POSITIVE, "5", "standard deviation of these angles";
    "adhesion_median_n_m" "N/m" POSITIVE, "250", "median of a log-normal distribution of adhesion_n_m";
    "adhesion_geometric_deviation" "1" Range::Between(1.0, INFINITE), "1.2", "geometric standard deviation of adhesion_n_m";
    "adhesion_mean_n_m" "N/m" POSITIVE, "250", "mean of a normal distribution of adhesion_n_m";
    "adhesion_deviation_n_m" "N/m" POSITIVE, "20", "standard deviation of adhesion_n_m";
    "work_of_adhesion_median_j_m2" "J/m2" POSITIVE, "0.05", "median of a log-normal distribution of work_of_adhesion_j_m2";
    "work_of_adhesion_mean_j_m2" "J/m2" POSITIVE, "0.05", "mean of a normal distribution of work_of_adhesion_j_m2";
    "work_of_adhesion_deviation_j_m2" "J/m2" POSITIVE, "0.01", "standard deviation of work_of_adhesion_j_m2";
    "work_of_adhesion_median_j" "J" POSITIVE, "2.22e-12", "median of a log-normal distribution of work_of_adhesion_j";
    "work_of_adhesion_mean_j" "J" POSITIVE, "2.22e-12", "mean of a normal distribution of work_of_adhesion_j";
    "work_of_adhesion_deviation_j" "J" POSITIVE, "1e-13", "standard deviation of work_of_adhesion_j";
    "work_of_adhesion_geometric_deviation" "1" Range::Between(1.0, INFINITE), "1.2", "geometric standard deviation of a work of adhesion";
    // Results of impacts.
    "error" "" TEXT, "", "why a row is bad; empty otherwise";
    "motion" "" Range::Words("sliding, rolling, resting, assumed rolling or cannot tell"), "", "motion of the contact point at separation or, of a captured sphere, when its slip has ended";
    "impulse_ratio_out" "1" ANY, "", "tangential over normal impulse of the impact; with a stiffness_ratio negative for a positive slip";
    "rolling_ratio" "1" ANY, "", "impulse ratio mu_0 that just ends the slip";
    "speed_over_critical" "1" POSITIVE, "", "approach speed over critical speed: rebound above 1";
    "friction_over_limit" "1" POSITIVE, "", "friction over the least friction that ends the slip: rolling above 1";
    "energy_before_j" "J" POSITIVE, "", "kinetic energy before the impact, of two spheres that of both";
    "work_material_j" "J" ANY, "", "energy lost by the materials' damping or restitution";
    "work_adhesion_j" "J" ANY, "", "energy lost by adhesion";
    "work_friction_j" "J" ANY, "", "energy lost by friction";
    "work_rolling_j" "J" ANY, "", "energy lost by rolling";
    "max_indentation_m" "m" POSITIVE, "", "largest indentation";
    "turning_indentation_m" "m" POSITIVE, "", "indentation at which a captured sphere first turns back; none where it creeps to rest";
    "time_peak_s" "s" POSITIVE, "", "time from first contact to the largest indentation";
    "contact_time_s" "s" POSITIVE, "", "duration of the contact of a rebound";
    "time_roll_s" "s" Range::Words("0 or more, or -1"), "", "time at which the slip ends: 0 without slip, -1 if it does not end";
    "impulse_hertz_n_s" "N s" POSITIVE, "", "impulse of the elastic force";
    "impulse_adhesion_rebound_n_s" "N s" POSITIVE, "", "impulse of adhesion on the way out, with its damping";
    "rotation_rad" "rad" ANY, "", "angle by which the sphere turns during contact";
    "displacement_tangential_m" "m" ANY, "", "path of the centre along the surface during contact";
    "group_a" "1" POSITIVE, "", "dimensionless elasticity A";
    "group_b" "1" POSITIVE, "", "dimensionless adhesion B";
    "group_h" "1" POSITIVE, "", "dimensionless damping h of the materials";
    "group_g" "1" POSITIVE, "", "dimensionless damping g of adhesion";
    "speed_over_yield" "1" POSITIVE, "", "approach speed over that at which the material yields; above 1 the impact leaves a dent, which the simulation does not know";
    "phases" "1" POSITIVE, "", "number of times that a compliant contact sticks or slips";
    "velocity_out_x_m_s" "m/s" ANY, "", "velocity after the impact, x";
    "velocity_out_y_m_s" "m/s" ANY, "", "velocity after the impact, y";
    "velocity_out_z_m_s" "m/s" ANY, "", "velocity after the impact, z";
    "spin_out_x_rad_s" "rad/s" ANY, "", "spin after the impact about the x axis";
    "spin_out_y_rad_s" "rad/s" ANY, "", "spin after the impact about the y axis";
    "spin_out_z_rad_s" "rad/s" ANY, "", "spin after the impact about the z axis";
    "energy_in_j" "J" POSITIVE, "", "kinetic energy of the sphere before the impact, seen as the velocities are given";
    "energy_out_j" "J" POSITIVE, "", "kinetic energy of the sphere after the impact";
    "velocity_2_out_x_m_s" "m/s" ANY, "", "velocity of the second sphere after the impact, x";
    "velocity_2_out_y_m_s" "m/s" ANY, "", "velocity of the second sphere after the impact, y";
    "velocity_2_out_z_m_s" "m/s" ANY, "", "velocity of the second sphere after the impact, z";
    "spin_2_out_x_rad_s" "rad/s" ANY, "", "spin of the second sphere after the impact about the x axis";
    "spin_2_out_y_rad_s" "rad/s" ANY, "", "spin of the second sphere after the impact about the y axis";
    "spin_2_out_z_rad_s" "rad/s" ANY, "", "spin of the second sphere after the impact about the z axis";
    "energy_2_in_j" "J" POSITIVE, "", "kinetic energy of the second sphere before the impact";
    "energy_2_out_j" "J" POSITIVE, "", "kinetic energy of the second sphere after the impact";
    "models_agree" "" Range::Words("yes or no"), "", "whether both models give the same class";
    "models_differ_because" "" TEXT, "", "why they do not";
    "probability_capture" "1" FRACTION, "", "probability of capture, from the standard errors of the row";
    "probability_sliding" "1" FRACTION, "", "probability of sliding";
    "probability_rolling" "1" FRACTION, "", "probability of rolling; a sphere that rests counts as rolling";
    "probability_rebound_sliding" "1" FRACTION, "", "probability of a rebound that slides";
    "probability_rebound_rolling" "1" FRACTION, "", "probability of a rebound that rolls";
    "probability_captured_sliding" "1" FRACTION, "", "probability of a capture that slides";
    "probability_captured_rolling" "1" FRACTION, "", "probability of a capture that rolls";
    "probability_error" "1" FRACTION, "", "largest error of these probabilities";
    "probability_by" "" Range::Words("expansion or random rows"), "", "how the probabilities were computed";
    "class" "" Range::Words("a class, or cannot tell"), "", "most probable class; `cannot tell` if its probability is below --level";
    "confidence" "1" FRACTION, "", "probability of the most likely class";
    "incidence_deg" "deg" Range::Between(0.0, 90.0), "", "angle between the surface and the path before the impact";
    "impulse_ratio_error" "1" ERROR, "", "standard error of impulse_ratio_out";
    "spin_implied_rad_s" "rad/s" ANY, "", "spin before the impact that rolling at separation implies, where none was measured";
    "critical_speed_m_s" "m/s" POSITIVE, "", "speed at which, and below which, spheres are captured";
    "critical" "" Range::Words("speed, always rebounds or never rebounds"), "", "whether there is a critical speed from 1e-12 to 1e6 m/s";
    // Impacts in time.
    "time_s" "s" POSITIVE, "", "time from first contact";
    "indentation_m" "m" ANY, "", "indentation";
    "indentation_rate_m_s" "m/s" ANY, "", "rate of the indentation: positive on the way in, negative on the way out";
    "force_n" "N" ANY, "", "normal force of the surface, positive where it repels";
    "elastic_force_n" "N" POSITIVE, "", "elastic part of that force";
    "event" "" Range::Words("contact, peak, rolls or end"), "", "what happens at that time, if anything; `end` is the separation or, of a captured sphere, its first turning point";
    // Statistics of populations and parameters of fits, a row for each.
    "population" "" TEXT, "", "name of the population";
    "model" "" Range::Words("rigid-body or simulation"), "", "model that computed the number";
    "quantity" "" TEXT, "", "name of the number";
    "from" "" ANY, "", "lower end of a range of diameters, m, or a speed, m/s";
    "to" "" ANY, "", "upper end of that range";
    "value" "" ANY, "", "the number, in the unit of its quantity";
    "numerical_error" "" POSITIVE, "", "error of the quadrature, and of the interpolation between simulated impacts";
    "low" "" ANY, "", "lower end of the interval of 95 %";
    "high" "" ANY, "", "upper end of the interval of 95 %; empty where the data set no bound";
    // Materials.
    "youngs_modulus_pa" "Pa" Range::Like(P::YoungsModulus), "7.2e10", "Young's modulus E";
    "poisson_ratio" "1" Range::Like(P::PoissonRatio), "0.21", "Poisson's ratio nu";
    "surface_energy_j_m2" "J/m2" POSITIVE, "", "surface energy; the work of adhesion of equal surfaces is twice as large";
    "sources" "" TEXT, "", "publications of these numbers";
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Input;
    use crate::header::Heading;
    use crate::units::{unit_by_suffix, units_of};

    /// Each name is unique, ends with its unit, and says which one it is.
    #[test]
    fn names_end_with_their_units() {
        for (index, column) in COLUMNS.iter().enumerate() {
            assert!(COLUMNS[..index].iter().all(|other| other.name != column.name), "{}", column.name);
            assert!(!column.meaning.is_empty() && !column.meaning.ends_with('.'), "{}", column.name);
            if !matches!(column.unit, "" | "1") {
                assert!(
                    units_of(column.unit).first().is_some_and(|unit| unit.symbol == column.unit),
                    "{}",
                    column.name
                );
                let end = column.name.strip_prefix(column.base()).unwrap();
                assert!(unit_by_suffix(units_of(column.unit), &end[1..]).is_some_and(|unit| unit.is_si()), "{end}");
            }
        }
    }

    /// Every unit has a heading of its own, and a heading with other words names the column in the unit that it states.
    #[test]
    fn units_of_headings() {
        for column in COLUMNS {
            for (name, symbol) in column.names() {
                let read = Heading::of(&name, &[Input::further(std::slice::from_ref(&column.name))]).unwrap();
                let is_own =
                    units_of(column.unit).iter().find(|unit| unit.symbol == symbol).filter(|unit| !unit.is_si());
                assert_eq!((read.name.as_str(), read.unit.as_ref()), (column.name, is_own), "{name}");
            }
        }
        for (column, heading, name) in [
            ("speed_normal_m_s", "Impact vel [cm/s]", Some("speed_normal_cm_s")),
            ("speed_normal_m_s", "v (km/h)", Some("speed_normal_km_h")),
            ("speed_normal_m_s", "impact_vel_mm_s", Some("speed_normal_mm_s")),
            ("speed_normal_m_s", "vel cm/s", Some("speed_normal_cm_s")),
            ("speed_normal_m_s", "v [um]", None),
            ("speed_normal_m_s", "speeds", None),
            ("diameter_m", "Size d (µm)", Some("diameter_um")),
            ("stiffness_pa", "K [mPa]", Some("stiffness [mPa]")),
            ("stiffness_pa", "K [GPa]", Some("stiffness_gpa")),
            ("friction", "f in %", Some("friction [%]")),
            ("friction", "friction", None),
            ("friction", "f [%]", Some("friction [%]")),
        ] {
            assert_eq!(Column::named(column).unwrap().name_in_unit_of(heading).as_deref(), name, "{heading}");
        }
    }

    /// An example lies within its range.
    #[test]
    fn examples_are_in_range() {
        for column in COLUMNS.iter().filter(|column| !column.example.is_empty() && !column.unit.is_empty()) {
            let value: f64 = column.example.parse().unwrap();
            let (low, high) = match column.range {
                Range::Of(parameter) | Range::Like(parameter) if parameter != P::NormalLength => parameter.range(),
                Range::Between(low, high) => (low, high),
                _ => continue,
            };
            assert!((low..=high).contains(&value), "{}", column.name);
        }
    }
}
