//! Scenes as plain data, and what is stored and read back.

use std::fmt::Debug;

use microimpact::contact::{
    Adaptive, AnyScene, Collocation, Contact, FixedCost, HertzScene, JkrEnd, JkrLaw, PaperScene, RestCriterion,
    RingScene, RungeKuttaGill, TotalAndPullOff, TotalForce, Unloading,
};
use microimpact::instrument::{Classifier, Instrument, NoLines, PlanarReading, Simulated, SpeedBins};
use microimpact::measure::{Estimate, MeasuredImpact, RestitutionFit};
use microimpact::rigid::{AnyRigidBody, ElasticPlasticRestitution, PowerRestitution, ViscoelasticRestitution};
use microimpact::table::{BoundaryTable, RestitutionParts, RestitutionTable, TableRebound};
use microimpact::{
    AdhesionConfig, AnyModel, Class, ConstantRestitution, CriticalSpeed, DampingConfig, Dual, InputError, ModelConfig,
    NormalMotion, PlanarMotion, ReboundAdhesionConfig, RestitutionConfig, RigidBody, SceneConfig, SpeedRestitution,
    Sphere, Stiffness,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

const RADIUS: f64 = 5e-6;
const DENSITY: f64 = 2600.0;
const STIFFNESS: f64 = 7.5e10;
const FRICTION: f64 = 0.1;

fn sphere() -> Sphere<f64> {
    Sphere::solid(RADIUS, DENSITY).unwrap()
}

fn stiffness() -> Stiffness<f64> {
    Stiffness::new(STIFFNESS).unwrap()
}

fn motion() -> PlanarMotion<f64> {
    NormalMotion::new(3.0).unwrap().with_tangential(1.0).unwrap().with_spin(&sphere(), 1e4).unwrap()
}

fn config(model: ModelConfig<f64>) -> SceneConfig<f64> {
    SceneConfig { friction: FRICTION, ..SceneConfig::solid(RADIUS, DENSITY, model) }
}

fn rigid(restitution: RestitutionConfig<f64>, adhesion: ReboundAdhesionConfig<f64>) -> SceneConfig<f64> {
    config(ModelConfig::RigidBody { restitution, adhesion })
}

fn contact(damping: DampingConfig<f64>, adhesion: AdhesionConfig<f64>, force: f64) -> SceneConfig<f64> {
    config(ModelConfig::Contact { stiffness: STIFFNESS, damping, adhesion, force })
}

/// One configuration with each term.
fn configurations() -> Vec<SceneConfig<f64>> {
    use AdhesionConfig as Adhesion;
    use DampingConfig as Damping;
    use ReboundAdhesionConfig as Held;
    use RestitutionConfig as Restitution;
    vec![
        rigid(Restitution::Constant { restitution: 0.9 }, Held::None),
        rigid(Restitution::Speed { speed: 130.0 }, Held::Coefficient { coefficient: 0.2 }),
        rigid(Restitution::Power { speed: 40.0, power: 0.5 }, Held::Work { work: 1e-12 }),
        rigid(Restitution::ElasticPlastic { yield_speed: 0.5 }, Held::Speed { speed: 0.4, power: 2.0 }),
        rigid(Restitution::Viscoelastic { stiffness: STIFFNESS, relaxation_time: 1e-9 }, Held::None),
        contact(Damping::None, Adhesion::None, 0.0),
        contact(Damping::Hysteretic { zeta: 10.5 }, Adhesion::Ring { strength: 250.0, zeta: 6.25 }, -1e-6),
        contact(Damping::Viscoelastic { relaxation_time: 1e-10 }, Adhesion::WithoutTension, 0.0),
        contact(Damping::Constant { restitution: 0.8 }, Adhesion::Dmt { work: 0.2 }, 0.0),
        contact(Damping::Hysteretic { zeta: 5.0 }, Adhesion::Jkr { work: 0.2, end: JkrEnd::PullOff }, 0.0),
    ]
}

/// What a typed scene makes of the motion: class and restitution.
type Answer = (Class, u64);

fn answer(classifier: &impl Classifier<f64, PlanarMotion<f64>, Class = Class>) -> Answer {
    let verdict = classifier.verdict(&motion()).unwrap();
    (verdict.class, verdict.restitution.unwrap().to_bits())
}

const TOLERANCE: f64 = 1e-9;

fn method() -> Adaptive<f64> {
    Adaptive::new(TOLERANCE).unwrap()
}

#[test]
fn configured_scene_is_the_typed_one() -> Result<(), InputError> {
    let (sphere, stiffness) = (sphere(), stiffness());
    macro_rules! simulated {
        ($scene:expr) => {
            answer(&Simulated { scene: $scene.with_friction(FRICTION)?, method: method() })
        };
    }
    let typed = [
        answer(&RigidBody::new(sphere, ConstantRestitution::new(0.9)?).with_friction(FRICTION)?),
        answer(
            &RigidBody::new(sphere, SpeedRestitution::new(130.0)?)
                .with_adhesion_coefficient(0.2)?
                .with_friction(FRICTION)?,
        ),
        answer(
            &RigidBody::new(sphere, PowerRestitution::new(40.0, 0.5)?)
                .with_work_of_adhesion(1e-12)?
                .with_friction(FRICTION)?,
        ),
        answer(
            &RigidBody::new(sphere, ElasticPlasticRestitution::new(0.5)?)
                .with_adhesion_at_speed(0.4, 2.0)?
                .with_friction(FRICTION)?,
        ),
        answer(
            &RigidBody::new(sphere, ViscoelasticRestitution::new(&sphere, stiffness, 1e-9)?).with_friction(FRICTION)?,
        ),
        simulated!(Contact::hertz(sphere, stiffness)),
        simulated!(
            Contact::hertz(sphere, stiffness).with_damping(10.5)?.with_ring(250.0, 6.25)?.with_external_force(-1e-6)?
        ),
        simulated!(Contact::hertz(sphere, stiffness).with_viscoelastic_damping(1e-10)?.without_tension()),
        simulated!(Contact::hertz(sphere, stiffness).with_constant_damping(0.8)?.with_dmt(0.2)?),
        simulated!(Contact::new(sphere, JkrLaw::new(stiffness, 0.2)?.ending_at(JkrEnd::PullOff).with_damping(5.0)?)),
    ];
    let configured = configurations();
    assert_eq!(configured.len(), typed.len());
    for (config, typed) in configured.iter().zip(typed) {
        let scene = config.scene()?;
        assert_eq!(answer(&Simulated { scene, method: method() }), typed, "{config:?}");
    }
    Ok(())
}

#[test]
fn configuration_is_checked() {
    let wrong = |config: SceneConfig<f64>| config.scene().unwrap_err().to_string();
    let plain = configurations()[5];
    assert_eq!(wrong(SceneConfig { density: 0.0, ..plain }), "density is 0 kg/m^3, but must be 0.01 to 1e6 kg/m^3");
    assert!(wrong(SceneConfig { friction: -1.0, ..plain }).starts_with("friction"));
    assert!(wrong(SceneConfig { gyration_ratio: f64::NAN, ..plain }).starts_with("gyration ratio"));
    let power = RestitutionConfig::Power { speed: 1.0, power: 2.0 };
    assert!(wrong(rigid(power, ReboundAdhesionConfig::None)).starts_with("power of the restitution law"));
}

/// Writes a value and reads it back, in a text and in bytes.
fn assert_read_back<V: Serialize + DeserializeOwned + PartialEq + Debug>(value: &V) {
    let text = serde_json::to_string(value).unwrap();
    assert_eq!(&serde_json::from_str::<V>(&text).unwrap(), value);
    let mut buffer = [0; 4096];
    let bytes = postcard::to_slice(value, &mut buffer).unwrap();
    assert_eq!(&postcard::from_bytes::<V>(bytes).unwrap(), value);
}

#[test]
fn configurations_methods_fits_and_tables_are_read_back_as_written() -> Result<(), InputError> {
    configurations().iter().for_each(assert_read_back);
    assert_read_back(&method());
    assert_read_back(&method().with_budget(40));
    assert_read_back(&Collocation::<9, f64>::new(1e-9)?);
    assert_read_back(&FixedCost::<5>::new(3)?.with_outputs::<7>());
    assert_read_back(&RungeKuttaGill::new(200));
    assert_read_back(&RestCriterion::new(1e-6, 100)?);
    assert_read_back(&fit());
    assert_read_back(&table());
    Ok(())
}

#[test]
fn typed_scenes_are_read_back_as_written() -> Result<(), InputError> {
    for config in configurations() {
        let scene = config.scene()?;
        assert_read_back(&scene);
        match scene {
            AnyModel::RigidBody(body) => assert_read_back::<AnyRigidBody<f64>>(&body),
            AnyModel::Contact(scene) => assert_read_back::<AnyScene<f64>>(&scene),
        }
    }
    let hollow = Sphere::hollow(RADIUS, 1e-6, DENSITY)?;
    let elastic = Contact::hertz(hollow, stiffness());
    let damped: HertzScene<f64> = elastic.with_damping(10.5)?;
    let ring: RingScene<f64> = damped.with_ring(250.0, 6.25)?;
    let paper: PaperScene<f64> = ring.with_friction(FRICTION)?;
    assert_read_back(&damped);
    assert_read_back(&ring);
    assert_read_back(&paper);
    assert_read_back(&paper.with_peeling(1e-12)?);
    assert_read_back(&ring.with_friction_under(FRICTION, TotalForce::new())?);
    assert_read_back(&ring.with_friction_under(FRICTION, TotalAndPullOff::new())?);
    assert_read_back(&elastic.with_viscoelastic_damping(1e-10)?.without_tension());
    assert_read_back(&elastic.with_constant_damping(0.8)?.with_dmt(0.2)?.with_external_force(-1e-6)?);
    assert_read_back(&Contact::new(hollow, JkrLaw::new(stiffness(), 0.2)?.ending_at(JkrEnd::PullOff)));
    let compliant = damped.with_friction(FRICTION)?.with_compliance(0.85)?;
    assert_read_back(&compliant.with_unloading(Unloading::Incremental));
    let body = RigidBody::new(hollow, ConstantRestitution::new(0.9)?);
    assert_read_back(&body);
    assert_read_back(
        &body.with_external_impulses(1e-13, -1e-13)?.with_friction(FRICTION)?.with_rolling_dissipation(1e-7)?,
    );

    // In single precision, too, and at the ends of the ranges of computed numbers.
    for restitution in [1e-3_f32, 1.0] {
        let sphere = Sphere::solid(5e-6_f32, 2600.0)?;
        assert_read_back(&Contact::hertz(sphere, Stiffness::new(7.5e10)?).with_constant_damping(restitution)?);
        assert_read_back(
            &RigidBody::new(sphere, ConstantRestitution::new(restitution)?).with_adhesion_coefficient(restitution)?,
        );
    }
    Ok(())
}

/// A number out of range in what is stored is refused with the words of the constructor.
#[test]
fn damaged_scenes_are_refused() -> Result<(), InputError> {
    fn refused<V: Serialize + DeserializeOwned + Debug>(scene: &V, path: &str, number: f64) -> String {
        let mut stored = serde_json::to_value(scene).unwrap();
        *stored.pointer_mut(path).unwrap() = number.into();
        serde_json::from_value::<V>(stored).unwrap_err().to_string()
    }
    let ring: RingScene<f64> = Contact::hertz(sphere(), stiffness()).with_damping(10.5)?.with_ring(250.0, 6.25)?;
    let paper: PaperScene<f64> = ring.with_friction(FRICTION)?;
    let radius = Sphere::solid(-1.0, DENSITY).unwrap_err().to_string();
    assert_eq!(refused(&paper, "/sphere/radius", -1.0), radius);
    let numbers = [
        ("/sphere/density", "density"),
        ("/sphere/gyration_ratio", "gyration ratio"),
        ("/law/stiffness", "stiffness"),
        ("/law/damping/rate", "material damping"),
        ("/law/adhesion/strength", "adhesion strength"),
        ("/law/adhesion/damping", "adhesion damping"),
        ("/surface/coefficient", "friction coefficient"),
    ];
    for (path, name) in numbers {
        let message = refused(&paper, path, -1.0);
        assert!(message.starts_with(&format!("{name} is -1")), "{path}: {message}");
    }
    let computed = [
        (
            configurations()[1],
            "/adhesion/Coefficient/remainder",
            "one less the adhesion coefficient is -1e0, but must be 0 to 1e0",
        ),
        (configurations()[2], "/adhesion/Work/speed", "speed that a work of adhesion stops"),
        (configurations()[4], "/restitution/Viscoelastic/strength", "strength of a viscoelastic restitution"),
        (configurations()[8], "/law/Dmt/damping/Constant/alpha", "alpha of a constant damping"),
        (configurations()[9], "/law/Jkr/adhesion", "work of adhesion per area is -1"),
    ];
    for (config, path, words) in computed {
        let scene = config.scene()?;
        let model = if matches!(scene, AnyModel::RigidBody(_)) { "/RigidBody" } else { "/Contact" };
        let message = refused(&scene, &format!("{model}{path}"), -1.0);
        assert!(message.starts_with(words), "{path}: {message}");
    }
    Ok(())
}

/// A fit to impacts of R = k/(k + v) with k = 100 m/s and a critical speed of 1 m/s.
fn fit() -> RestitutionFit<f64> {
    let measured = |value| Estimate { value, standard_error: 0.01 };
    let impacts: Vec<_> = (2..20)
        .map(|speed| {
            let v = f64::from(speed);
            let e = ((100.0 / (100.0 + v)).powi(2) - (100.0 / 101.0 / v).powi(2)).sqrt();
            MeasuredImpact { sphere: sphere(), approach: measured(v), rebound: Some(measured(e * v)) }
        })
        .collect();
    RestitutionFit::of(&impacts).unwrap()
}

type Table = RestitutionTable<f64, 2, 3, 5>;

fn table() -> Table {
    let boundary = BoundaryTable::<2>::new(1e-6, |radius: f64| Ok(CriticalSpeed::At(1e-6 / radius))).unwrap();
    let source = |radius: f64, speed: f64| {
        let restitution = (1.0 - (1e-6 / radius / speed).powi(2)).max(0.0).sqrt();
        Ok(TableRebound { restitution, impulse: 1.0 + restitution })
    };
    Table::new(boundary, 10.0, source).unwrap()
}

#[test]
fn what_is_damaged_is_refused() {
    fn refused<V: DeserializeOwned + Debug>(text: &str) -> String {
        serde_json::from_str::<V>(text).unwrap_err().to_string()
    }
    assert!(refused::<Adaptive<f64>>(r#"{"tolerance":0.0}"#).contains("tolerance is 0"));
    assert!(refused::<Adaptive<f32>>(r#"{"tolerance":1e-9}"#).contains("tolerance is 1e-9"));
    assert!(refused::<Collocation<5, f64>>(r#"{"tolerance":1e-12}"#).contains("tolerance"));
    assert!(refused::<FixedCost<5>>(r#"{"iterations":0}"#).contains("iterations"));
    assert!(refused::<RestCriterion<f64>>(r#"{"fraction":2.0,"turning_points":5}"#).contains("is 2"));
    let table = table();
    let text = serde_json::to_string(&table).unwrap();
    assert!(refused::<RestitutionTable<f64, 2, 3, 4>>(&text).contains("24 numbers"));
    assert!(refused::<RestitutionTable<f64, 2, 3, 6>>(&text).contains("36 numbers"));
    assert!(Table::from_parts(RestitutionParts { end: 0, ..table.parts() }).is_err());
    assert!(Table::from_parts(RestitutionParts { near: f64::INFINITY, ..table.parts() }).is_err());
    let mut nodes = table.parts().nodes;
    nodes[2][4][1] = -1.0;
    assert!(Table::from_parts(RestitutionParts { nodes, ..table.parts() }).is_err());
    assert_eq!(Table::from_parts(table.parts()), Ok(table));
}

/// A changed configuration takes effect at once, and the counts go on.
#[test]
fn instrument_is_configured_while_it_counts() -> Result<(), InputError> {
    let classifier =
        |config: &SceneConfig<f64>| Ok::<_, InputError>(Simulated { scene: config.scene()?, method: method() });
    let bins = SpeedBins::new([1.0, 10.0])?;
    let configurations = configurations();
    let mut instrument: Instrument<_, _, _, 6, 2> = Instrument::new(classifier(&configurations[0])?, NoLines, bins);
    let reading = PlanarReading { approach: 3.0, tangential: 1.0, peripheral: 0.05 };
    for config in &configurations[1..] {
        let before = instrument.reconfigure(classifier(config)?);
        let verdict = instrument.process(&reading).unwrap();
        assert_eq!(Ok(verdict), classifier(config)?.verdict(&motion()));
        assert_ne!(before, *instrument.classifier());
    }
    let (classifier, lines, tally) = instrument.release();
    assert_eq!(tally.classified(), configurations.len() as u64 - 1);
    let mut resumed: Instrument<_, _, _, 6, 2> = Instrument::resume(classifier, lines, tally);
    assert!(matches!(resumed.classifier().scene, AnyModel::Contact(_)));
    assert_eq!((resumed.reset(), resumed.tally().classified()), (tally, 0));
    Ok(())
}

/// A configuration may also hold numbers with derivatives; nothing of it depends on the number type.
#[test]
fn configuration_of_dual_numbers() -> Result<(), InputError> {
    let model = ModelConfig::RigidBody {
        restitution: RestitutionConfig::Constant { restitution: Dual::variables([0.9])[0] },
        adhesion: ReboundAdhesionConfig::None,
    };
    let config = SceneConfig::solid(Dual::fixed(RADIUS), Dual::fixed(DENSITY), model);
    let AnyModel::RigidBody(body) = config.scene()? else { unreachable!("a rigid body was configured") };
    let e = body.impact(&NormalMotion::new(Dual::fixed(1.0))?.with_tangential(Dual::fixed(0.0))?);
    assert_eq!(e.normal.overall_restitution().partials, [1.0]);
    Ok(())
}
