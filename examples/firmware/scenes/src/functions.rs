//! The functions that the models take from `libm` or from `micromath`, each alone.

use core::marker::PhantomData;

use microimpact::{Dual, Real};

use super::approximate::Approximate;
use super::impacts::Impact;
use super::scenes::{Answer, Measured, Number, Scene, Visitor};

/// Their arguments. The negative powers of e are what decays.
static ARGUMENTS: [Impact; 4] =
    [argument("near-zero", 0.03), argument("third", 0.37), argument("near-one", 1.7), argument("three", 2.9)];

const fn argument(name: &'static str, x: f64) -> Impact {
    Impact { name, approach_m_s: x, tangential_m_s: 0.0, spin_rad_s: 0.0 }
}

/// A function of one number.
pub trait Function {
    /// Name of its scene.
    const NAME: &'static str;
    /// The function.
    fn of<T: Real>(x: T) -> T;
}

/// A square root.
pub struct Root;
/// The power 2/5.
pub struct TwoFifthsPower;
/// An exponential function of a negative number.
pub struct Decay;
/// The standard error of a result of three numbers of which each has one.
pub struct StandardError;

impl Function for Root {
    const NAME: &'static str = "function/root";

    fn of<T: Real>(x: T) -> T {
        x.sqrt()
    }
}

impl Function for TwoFifthsPower {
    const NAME: &'static str = "function/two-fifths-power";

    fn of<T: Real>(x: T) -> T {
        x.two_fifths_power()
    }
}

impl Function for Decay {
    const NAME: &'static str = "function/decay";

    fn of<T: Real>(x: T) -> T {
        (-x).exp()
    }
}

impl Function for StandardError {
    const NAME: &'static str = "function/standard-error";

    fn of<T: Real>(x: T) -> T {
        let [a, b, c] = Dual::variables([x, x + T::ONE, x + x]);
        let tenth = T::constant(0.1);
        (a * b + c).standard_error(&[tenth * x, tenth, tenth * x])
    }
}

/// A function as a scene, whose answer stands in the place of a restitution.
pub struct Alone<F>(PhantomData<F>);

impl<T: Number, F: Function> Scene<T> for Alone<F> {
    const NAME: &'static str = F::NAME;
    const PLANAR: bool = false;
    type Motion = T;
    type Verdict = Answer<T>;

    fn new() -> Option<Self> {
        Some(Self(PhantomData))
    }

    fn motion(&self, measured: &Measured<T>) -> Option<T> {
        Some(measured.approach_m_s)
    }

    #[inline(always)]
    fn classify(&self, x: &T) -> Answer<T> {
        Answer { class: "value", speed_margin: None, friction_margin: None, restitution: Some(F::of(*x)) }
    }

    fn restitution(argument: &Impact) -> Option<f64> {
        Some(F::of(argument.approach_m_s))
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        ARGUMENTS.iter()
    }
}

/// Goes through the functions, the library's own and those of micromath.
pub fn visit_functions(visitor: &mut impl Visitor) {
    visit::<Root>(visitor);
    visit::<TwoFifthsPower>(visitor);
    visit::<Decay>(visitor);
    visit::<StandardError>(visitor);
}

fn visit<F: Function>(visitor: &mut impl Visitor) {
    visitor.visit::<f32, Alone<F>>();
    visitor.visit::<Approximate, Alone<F>>();
}
