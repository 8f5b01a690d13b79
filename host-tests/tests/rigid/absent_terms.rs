//! What a scene does not use takes no room in it.

use microimpact::contact::{Contact, FixedCost, Times, Works};
use microimpact::rigid::NoMicroforce;
use microimpact::{
    Classification, ConstantRestitution, ContactClass, Impact, NoAdhesion, NoFriction, NormalImpact, NormalMotion,
    ObliqueMotion, PlanarMotion, RigidBody, Sphere, Stiffness,
};

const NUMBER: usize = size_of::<f32>();

#[test]
fn absent_terms_have_size_zero() {
    assert_eq!(size_of::<(NoAdhesion, NoFriction, NoMicroforce)>(), 0);
    assert_eq!(size_of::<RigidBody<f32, ConstantRestitution<f32>>>(), size_of::<Sphere<f32>>() + NUMBER);
}

#[test]
fn each_term_adds_its_own_numbers() {
    let sphere = Sphere::solid(1e-6_f32, 1000.0).unwrap();
    let scene = RigidBody::new(sphere, ConstantRestitution::new(0.9).unwrap());
    let bare = size_of_val(&scene);
    assert_eq!(size_of_val(&scene.with_adhesion_coefficient(0.1).unwrap()), bare + NUMBER);
    assert_eq!(size_of_val(&scene.with_work_of_adhesion(1e-12).unwrap()), bare + NUMBER);
    assert_eq!(size_of_val(&scene.with_external_impulses(0.0, 0.0).unwrap()), bare + 2 * NUMBER);
    let frictional = scene.with_friction(0.1).unwrap();
    assert_eq!(size_of_val(&frictional), bare + NUMBER);
    assert_eq!(size_of_val(&frictional.with_rolling_dissipation(1e-9).unwrap()), bare + 2 * NUMBER);
}

/// The same of a simulation, and the outputs that it is not asked for are absent from its result.
#[test]
fn absent_terms_of_a_simulation() {
    let sphere = Sphere::solid(1e-6_f32, 1000.0).unwrap();
    let scene = Contact::hertz(sphere, Stiffness::new(1e10).unwrap());
    let bare = size_of::<Sphere<f32>>() + NUMBER;
    assert_eq!(size_of_val(&scene), bare);
    assert_eq!(size_of_val(&scene.with_damping(1.0).unwrap()), bare + NUMBER);
    assert_eq!(size_of_val(&scene.with_external_force(1.0).unwrap()), bare + NUMBER);
    let held = scene.with_ring(1.0, 1.0).unwrap();
    assert_eq!(size_of_val(&held), bare + 2 * NUMBER);
    let frictional = held.with_friction(0.1).unwrap();
    assert_eq!(size_of_val(&frictional), bare + 3 * NUMBER);
    assert_eq!(size_of_val(&frictional.with_peeling(1.0).unwrap()), bare + 4 * NUMBER);
    let (motion, method) = (NormalMotion::new(1.0).unwrap(), FixedCost::<7>::new(3).unwrap());
    let impact = scene.solve(&motion, &method).unwrap();
    let of_impact = size_of_val(&impact);
    assert_eq!(size_of_val(&scene.solve_for(&motion, &method, ()).unwrap()), of_impact);
    assert_eq!(size_of_val(&scene.solve_for(&motion, &method, Works).unwrap()), of_impact + 2 * NUMBER);
    assert_eq!(size_of_val(&(Times, Works)), 0);
}

#[test]
fn motions_and_results_have_no_more_than_they_need() {
    assert_eq!(size_of::<NormalMotion<f32>>(), NUMBER);
    assert_eq!(size_of::<ObliqueMotion<f32>>(), 2 * NUMBER);
    assert_eq!(size_of::<PlanarMotion<f32>>(), 3 * NUMBER);
    assert_eq!(size_of::<Impact<f32, ()>>(), size_of::<NormalImpact<f32>>());
    assert!(size_of::<Classification<f32, ()>>() < size_of::<Classification<f32, ContactClass<f32>>>());
}
