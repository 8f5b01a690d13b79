/* Scenes of both models as one structure, fixed cost, integers, probabilities and fits: results against what is known otherwise, and
   misuse. On a host, under the sanitizers. */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "microimpact.h"

#undef NDEBUG
#include <assert.h>

static const MicroimpactMotion MOTION = {2.8f, 1.0f, 0.0f};

static MicroimpactSceneConfig rigid(void)
{
    MicroimpactSceneConfig scene;
    memset(&scene, 0, sizeof scene);
    scene.radius = 5.06e-6f, scene.density = 2600.0f, scene.friction = 0.1f;
    scene.model = MICROIMPACT_MODEL_RIGID_BODY;
    scene.restitution_law = MICROIMPACT_RESTITUTION_LAW_SPEED, scene.restitution_speed = 130.0f;
    scene.rebound_adhesion = MICROIMPACT_REBOUND_ADHESION_WORK, scene.work_of_adhesion = 2.22e-12f;
    return scene;
}

static MicroimpactSceneConfig contact(void)
{
    MicroimpactSceneConfig scene;
    memset(&scene, 0, sizeof scene);
    scene.radius = 5.06e-6f, scene.density = 2600.0f, scene.friction = 0.1f;
    scene.model = MICROIMPACT_MODEL_CONTACT, scene.stiffness = 7.5e10f;
    scene.damping = MICROIMPACT_DAMPING_HYSTERETIC, scene.material_damping = 10.5f;
    scene.adhesion = MICROIMPACT_ADHESION_RING, scene.adhesion_strength = 250.0f, scene.adhesion_damping = 6.25f;
    return scene;
}

static void versions(void)
{
    char text[MICROIMPACT_LARGEST_TEXT];
    assert(microimpact_version() == MICROIMPACT_VERSION && microimpact_abi() == MICROIMPACT_ABI);
    assert(microimpact_layout() == MICROIMPACT_LAYOUT);
    /* The texts of all errors fit. */
    for (unsigned parameter = 0; parameter < 100; parameter++)
        for (unsigned fault = 0; fault < 20; fault++)
            assert(microimpact_describe(parameter, fault, text, sizeof text) < sizeof text);
    assert(microimpact_describe(8, MICROIMPACT_FAULT_TOO_SMALL, text, sizeof text) == strlen(text));
    assert(strcmp(text, "approach speed (m/s): below the smallest valid value") == 0);
    assert(microimpact_describe(8, MICROIMPACT_FAULT_TOO_SMALL, text, 9) == 52 && strcmp(text, "approach") == 0);
    assert(microimpact_describe(8, MICROIMPACT_FAULT_NONE, text, sizeof text) == 0 && text[0] == 0);
    assert(microimpact_describe(8, 1, NULL, 9) > 0);
    assert(microimpact_parameter_unit(7, text, sizeof text) == 2 && strcmp(text, "Pa") == 0);
}

/* The same results as those of the functions for one model. */
static void same_as_each_model(void)
{
    const MicroimpactRigidScene body = {5.06e-6f, 2600.0f, 130.0f, 2.22e-12f, 0.1f};
    MicroimpactContactScene material;
    MicroimpactSceneConfig made, scene = rigid();
    MicroimpactSceneImpact impact;
    MicroimpactClassification classified;
    MicroimpactContact end;
    MicroimpactError error;
    size_t written;
    float speed;

    assert(microimpact_scene_init(&scene, &scene, &error) == MICROIMPACT_STATUS_OK && scene.gyration_ratio == 0.4f);
    assert(microimpact_scene_classify(&scene, &MOTION, &impact, &error) == MICROIMPACT_STATUS_OK);
    assert(microimpact_classify(&body, &MOTION, &classified, NULL) == MICROIMPACT_STATUS_OK);
    assert(impact.impact_class == classified.impact_class && impact.restitution == classified.restitution);
    assert(impact.tangential == classified.tangential && impact.peripheral == classified.peripheral);
    assert(microimpact_scene_critical_speed(&scene, &speed, NULL) == MICROIMPACT_STATUS_OK);
    assert(fabsf(2.8f / speed / classified.speed_over_critical - 1.0f) < 1e-6f);

    memset(&material, 0, sizeof material);
    material.radius = 5.06e-6f, material.density = 2600.0f, material.stiffness = 7.5e10f, material.material_damping = 10.5f;
    material.adhesion_strength = 250.0f, material.adhesion_damping = 6.25f, material.friction = 0.1f, material.tolerance = 1e-6f;
    scene = contact();
    assert(microimpact_scene_init(&scene, &scene, &error) == MICROIMPACT_STATUS_OK && scene.tolerance == 1e-6f);
    assert(microimpact_scene_classify(&scene, &MOTION, &impact, &error) == MICROIMPACT_STATUS_OK);
    assert(microimpact_simulate(&material, &MOTION, 1, &end, 1, &written, NULL) == MICROIMPACT_STATUS_OK);
    assert(impact.impact_class == end.impact_class && impact.restitution == end.restitution);
    assert(impact.tangential == end.tangential);
    assert(microimpact_scene_critical_speed(&scene, &speed, NULL) == MICROIMPACT_STATUS_OK && fabsf(speed - 1.41f) < 0.01f);

    /* The restitution of the paper's scene, by the method of fixed cost. */
    scene.iterations = 3;
    assert(microimpact_scene_classify(&scene, &MOTION, &impact, &error) == MICROIMPACT_STATUS_OK);
    assert(fabsf(impact.restitution - 0.746193f) < 1e-5f && impact.impact_class == end.impact_class);
    assert(fabsf(impact.tangential - end.tangential) < 1e-5f);
    assert(microimpact_scene_critical_speed(&scene, &speed, NULL) == MICROIMPACT_STATUS_CHOICE);
    scene.iterations = 41;
    assert(microimpact_scene_classify(&scene, &MOTION, &impact, &error) == MICROIMPACT_STATUS_INPUT && error.value == 41.0);
    /* A law without a method of fixed cost is refused when the scene is made. */
    scene.iterations = 3, scene.adhesion = MICROIMPACT_ADHESION_JKR_SNAP_OFF, scene.adhesion_energy = 0.1f;
    assert(microimpact_scene_init(&scene, &made, &error) == MICROIMPACT_STATUS_CHOICE);
    scene.adhesion = MICROIMPACT_ADHESION_WITHOUT_TENSION;
    assert(microimpact_scene_classify(&scene, &MOTION, &impact, &error) == MICROIMPACT_STATUS_CHOICE);
}

static void misuse_of_scenes(void)
{
    MicroimpactSceneConfig zeros, parameters = rigid(), scene;
    MicroimpactSceneImpact impact;
    MicroimpactError error;
    uint32_t *const choices[] = {&parameters.model, &parameters.restitution_law, &parameters.rebound_adhesion,
                                 &parameters.damping, &parameters.adhesion};
    memset(&zeros, 0, sizeof zeros);
    for (size_t i = 0; i < sizeof choices / sizeof choices[0]; i++) {
        parameters = i < 3 ? rigid() : contact();
        *choices[i] = 0xffffffffu;
        memset(&scene, 0xff, sizeof scene);
        assert(microimpact_scene_init(&parameters, &scene, &error) == MICROIMPACT_STATUS_CHOICE);
        assert(memcmp(&scene, &zeros, sizeof zeros) == 0);
    }
    assert(microimpact_scene_classify(&zeros, &MOTION, &impact, &error) == MICROIMPACT_STATUS_INPUT);
    parameters = rigid(), parameters.work_of_adhesion = -1.0f;
    assert(microimpact_scene_init(&parameters, &scene, &error) == MICROIMPACT_STATUS_INPUT);
    assert(error.parameter == 26 && error.fault == MICROIMPACT_FAULT_TOO_SMALL && error.value == -1.0);
    assert(microimpact_scene_init(NULL, &scene, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_scene_init(&parameters, NULL, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_scene_classify(NULL, &MOTION, &impact, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_scene_critical_speed(NULL, NULL, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_scene_probabilities(NULL, NULL, 0.9f, NULL, NULL) == MICROIMPACT_STATUS_POINTER);
}

/* The critical speed found in steps is the one found at once, and each step makes no more trials than it may. */
static void critical_speed_in_steps(void)
{
    MicroimpactSceneConfig scenes[2];
    MicroimpactCriticalSearch search;
    MicroimpactError error;
    float speed = 0.0f, expected;
    uint32_t found, budget;
    scenes[0] = rigid(), scenes[1] = contact();
    for (size_t i = 0; i < 2; i++) {
        assert(microimpact_scene_init(&scenes[i], &scenes[i], &error) == MICROIMPACT_STATUS_OK);
        assert(microimpact_scene_critical_speed(&scenes[i], &expected, &error) == MICROIMPACT_STATUS_OK);
        for (budget = 1; budget < 12; budget++) {
            uint32_t steps = 0;
            memset(&search, 0x55, sizeof search);
            assert(microimpact_critical_speed_begin(&scenes[i], &search, &error) == MICROIMPACT_STATUS_OK);
            do {
                steps++, speed = -2.0f;
                assert(microimpact_critical_speed_step(&search, budget, &speed, &found, &error) == MICROIMPACT_STATUS_OK);
                assert(found == 1 || (found == 0 && speed == -2.0f));
            } while (found == 0);
            assert(speed == expected && (i == 0 ? steps == 1 : steps > 1 || budget > 3));
            /* Asked again. */
            assert(microimpact_critical_speed_step(&search, 0, &speed, &found, NULL) == MICROIMPACT_STATUS_OK);
            assert(found == 1 && speed == expected);
        }
    }
    assert(microimpact_critical_speed_begin(&scenes[1], &search, NULL) == MICROIMPACT_STATUS_OK);
    assert(microimpact_critical_speed_step(&search, 0, &speed, &found, NULL) == MICROIMPACT_STATUS_OK && found == 0);
    assert(microimpact_critical_speed_step(NULL, 1, &speed, &found, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_critical_speed_step(&search, 1, NULL, &found, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_critical_speed_step(&search, 1, &speed, NULL, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_critical_speed_begin(NULL, &search, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_critical_speed_begin(&scenes[1], NULL, NULL) == MICROIMPACT_STATUS_POINTER);
    /* Memory in which nothing was begun; a method without a tolerance; a scene that is not valid. */
    memset(&search, 0xff, sizeof search);
    assert(microimpact_critical_speed_step(&search, 1, &speed, &found, NULL) == MICROIMPACT_STATUS_UNMADE);
    scenes[1].iterations = 3;
    assert(microimpact_critical_speed_begin(&scenes[1], &search, NULL) == MICROIMPACT_STATUS_CHOICE);
    scenes[1].iterations = 0, scenes[1].stiffness = -1.0f;
    assert(microimpact_critical_speed_begin(&scenes[1], &search, &error) == MICROIMPACT_STATUS_INPUT && error.value == -1.0);
}

/* Mass and moment of inertia by integration over shells. */
static void spheres(void)
{
    MicroimpactSceneConfig scene = rigid();
    MicroimpactError error;
    const double q = 0.8, kappa = 0.4 * (1.0 - pow(q, 5.0)) / (1.0 - pow(q, 3.0));
    assert(microimpact_sphere_hollow(10e-6f, 2e-6f, 2000.0f, &scene, &error) == MICROIMPACT_STATUS_OK);
    assert(fabs(scene.gyration_ratio / kappa - 1.0) < 1e-6 && fabs(scene.density / (2000.0 * (1.0 - pow(q, 3.0))) - 1.0) < 1e-6);
    assert(scene.radius == 10e-6f && scene.restitution_speed == 130.0f);
    assert(microimpact_sphere_coated(10e-6f, 2e-6f, 2000.0f, 2000.0f, &scene, &error) == MICROIMPACT_STATUS_OK);
    assert(fabsf(scene.gyration_ratio - 0.4f) < 1e-6f && fabsf(scene.density - 2000.0f) < 0.01f);
    assert(microimpact_sphere_hollow(1e-6f, 2e-6f, 2000.0f, &scene, &error) == MICROIMPACT_STATUS_INPUT);
    assert(error.fault == MICROIMPACT_FAULT_EXCEEDS_RADIUS && error.value == 2e-6f);
    assert(microimpact_sphere_hollow(10e-6f, 2e-6f, 2000.0f, NULL, &error) == MICROIMPACT_STATUS_POINTER);
}

/* In integers as in floating point, by the error that the documentation states. */
static void integers(void)
{
    const MicroimpactRigidScene body = {5.06e-6f, 2600.0f, 130.0f, 2.22e-12f, 0.1f};
    const float unit = 4.0f, one = (float)MICROIMPACT_FIXED_ONE;
    MicroimpactFixedBody fixed;
    MicroimpactFixedResult result;
    MicroimpactClassification expected;
    MicroimpactError error;
    memset(&fixed, 0, sizeof fixed);
    MicroimpactFixedMotion motion = {MICROIMPACT_FIXED_ONE, 0, 0};
    assert(microimpact_fixed_classify(&fixed, &motion, &result, NULL) == MICROIMPACT_STATUS_UNMADE);
    assert(microimpact_fixed_init(&body, 0.0f, &fixed, &error) == MICROIMPACT_STATUS_INPUT && error.parameter == 57);
    assert(microimpact_fixed_init(&body, unit, &fixed, &error) == MICROIMPACT_STATUS_OK);
    for (int i = 1; i <= 40; i++) {
        for (int j = -20; j <= 20; j++) {
            MicroimpactMotion real = {0.25f * (float)i, 0.5f * (float)j, 0.125f * (float)(j * i % 13)};
            motion.approach = (int32_t)(real.approach / unit * one), motion.tangential = (int32_t)(real.tangential / unit * one);
            motion.peripheral = (int32_t)(real.peripheral / unit * one);
            assert(microimpact_fixed_classify(&fixed, &motion, &result, &error) == MICROIMPACT_STATUS_OK);
            assert(microimpact_classify(&body, &real, &expected, NULL) == MICROIMPACT_STATUS_OK);
            assert(result.impact_class == expected.impact_class);
            assert(fabsf((float)result.tangential / one * unit - expected.tangential) < 4e-5f);
            assert(fabsf((float)result.peripheral / one * unit - expected.peripheral) < 4e-5f);
            assert(fabsf((float)result.restitution / one - expected.restitution) < 4e-4f);
        }
    }
    motion.approach = -1;
    assert(microimpact_fixed_classify(&fixed, &motion, &result, &error) == MICROIMPACT_STATUS_INPUT && error.parameter == 50);
    assert(microimpact_fixed_classify(NULL, &motion, &result, &error) == MICROIMPACT_STATUS_POINTER);
}

/* The simulation in integers as in floating point. */
static void contact_in_integers(void)
{
    MicroimpactContactScene scene;
    const float unit = 4.0f, one = (float)MICROIMPACT_FIXED_ONE;
    MicroimpactFixedContact fixed;
    MicroimpactFixedMotion motion = {MICROIMPACT_FIXED_ONE, 0, 0};
    MicroimpactFixedImpact impact;
    MicroimpactContact expected;
    MicroimpactError error;
    size_t written, classes[6] = {0};
    memset(&scene, 0, sizeof scene), memset(&fixed, 0, sizeof fixed);
    scene.radius = 5.06e-6f, scene.density = 2600.0f, scene.stiffness = 7.5e10f, scene.material_damping = 10.5f;
    scene.adhesion_strength = 250.0f, scene.adhesion_damping = 6.25f, scene.friction = 0.1f, scene.tolerance = 1e-6f;
    assert(microimpact_fixed_simulate(&fixed, &motion, &impact, NULL) == MICROIMPACT_STATUS_UNMADE);
    assert(microimpact_fixed_contact_init(&scene, unit, &fixed, &error) == MICROIMPACT_STATUS_OK);
    for (int i = 4; i <= 40; i++) {
        for (int j = -20; j <= 20; j++) {
            MicroimpactMotion real = {0.25f * (float)i, 0.5f * (float)j, 0.125f * (float)(j * i % 13)};
            motion.approach = (int32_t)(real.approach / unit * one), motion.tangential = (int32_t)(real.tangential / unit * one);
            motion.peripheral = (int32_t)(real.peripheral / unit * one);
            assert(microimpact_fixed_simulate(&fixed, &motion, &impact, &error) == MICROIMPACT_STATUS_OK);
            assert(microimpact_simulate(&scene, &real, 1, &expected, 1, &written, NULL) == MICROIMPACT_STATUS_OK);
            assert(impact.impact_class == expected.impact_class);
            assert(fabsf((float)impact.tangential / one * unit - expected.tangential) < 4e-4f);
            assert(fabsf((float)impact.peripheral / one * unit - expected.spin * scene.radius) < 4e-4f);
            assert(fabsf((float)impact.restitution / one - expected.restitution) < 1e-4f);
            classes[impact.impact_class]++;
        }
    }
    assert(classes[MICROIMPACT_CLASS_REBOUND_SLIDING] > 100 && classes[MICROIMPACT_CLASS_REBOUND_ROLLING] > 100);
    assert(classes[MICROIMPACT_CLASS_CAPTURED_ROLLING] > 50 && classes[MICROIMPACT_CLASS_CAPTURED_RESTING] > 0);
    motion.approach = MICROIMPACT_FIXED_ONE / 20;
    assert(microimpact_fixed_simulate(&fixed, &motion, &impact, &error) == MICROIMPACT_STATUS_INPUT);
    assert(microimpact_fixed_simulate(NULL, &motion, &impact, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_fixed_simulate(&fixed, NULL, &impact, &error) == MICROIMPACT_STATUS_POINTER);
    motion.approach = MICROIMPACT_FIXED_ONE;
    assert(microimpact_fixed_simulate(&fixed, &motion, NULL, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_fixed_contact_init(NULL, unit, &fixed, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_fixed_contact_init(&scene, unit, NULL, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_fixed_contact_init(&scene, 0.0f, &fixed, &error) == MICROIMPACT_STATUS_INPUT);
    scene.ends_by_force = 1;
    assert(microimpact_fixed_contact_init(&scene, unit, &fixed, &error) == MICROIMPACT_STATUS_CHOICE);
    scene.ends_by_force = 0, scene.dmt_work = 0.1f;
    assert(microimpact_fixed_contact_init(&scene, unit, &fixed, &error) == MICROIMPACT_STATUS_INPUT);
    assert(error.fault == MICROIMPACT_FAULT_OTHER_LAW);
}

/* At the critical speed every second sphere rebounds, if only the speed is uncertain. */
static void probabilities(void)
{
    MicroimpactSceneConfig scene = rigid();
    MicroimpactUncertainMotion motion;
    MicroimpactUncertainClass found;
    MicroimpactError error;
    float critical, sum = 0.0f;
    int model;
    for (model = 0; model < 2; model++) {
        scene = model ? contact() : rigid();
        assert(microimpact_scene_init(&scene, &scene, NULL) == MICROIMPACT_STATUS_OK);
        assert(microimpact_scene_critical_speed(&scene, &critical, NULL) == MICROIMPACT_STATUS_OK);
        memset(&motion, 0, sizeof motion);
        motion.approach.value = critical, motion.approach.standard_error = 0.02f * critical;
        motion.radius.value = scene.radius;
        assert(microimpact_scene_probabilities(&scene, &motion, 0.9f, &found, &error) == MICROIMPACT_STATUS_OK);
        assert(found.impact_class == MICROIMPACT_CLASS_UNDECIDED);
        assert(fabsf(found.probabilities[0] + found.probabilities[1] - 0.5f) < 0.01f);
        for (int i = 0; i < MICROIMPACT_CLASSES; i++)
            sum += found.probabilities[i];
        motion.approach.value = 2.0f * critical;
        assert(microimpact_scene_probabilities(&scene, &motion, 0.9f, &found, &error) == MICROIMPACT_STATUS_OK);
        assert(found.impact_class == MICROIMPACT_CLASS_REBOUND_ROLLING);
        assert(microimpact_scene_probabilities(&scene, &motion, 0.4f, &found, &error) == MICROIMPACT_STATUS_INPUT);
        /* So much of this distribution is negative that no class has a known probability. */
        motion.approach.standard_error = critical;
        assert(microimpact_scene_probabilities(&scene, &motion, 0.9f, &found, &error) == MICROIMPACT_STATUS_INPUT);
        assert(error.value == 2.0 * (double)critical && error.fault == MICROIMPACT_FAULT_TOO_UNCERTAIN);
        motion.approach.standard_error = 0.02f * critical;
    }
    assert(fabsf(sum - 2.0f) < 1e-5f);
    scene.iterations = 3;
    assert(microimpact_scene_probabilities(&scene, &motion, 0.9f, &found, &error) == MICROIMPACT_STATUS_CHOICE);
}

/* Rebounds that follow a law give its parameters back. */
static void fits(void)
{
    enum { COUNT = 20 };
    MicroimpactMeasuredImpact impacts[COUNT];
    static MicroimpactFitRoom room[COUNT];
    MicroimpactFit fit;
    MicroimpactError error;
    float zeta;
    const double mass = 2600.0 * 4.0 / 3.0 * 3.14159265358979 * pow(5.06e-6, 3.0);
    memset(impacts, 0, sizeof impacts);
    for (int i = 0; i < COUNT; i++) {
        const double speed = 2.0 + i, r = 130.0 / (130.0 + speed);
        impacts[i].radius = 5.06e-6f, impacts[i].density = 2600.0f, impacts[i].approach.value = (float)speed;
        impacts[i].rebound.value = (float)(speed * sqrt(r * r - 2.0 * 2.22e-12 / (mass * speed * speed)));
        impacts[i].approach.standard_error = impacts[i].rebound.standard_error = 0.03f;
    }
    assert(microimpact_fit_restitution(impacts, room, COUNT, &fit, &error) == MICROIMPACT_STATUS_OK && fit.fits == 1);
    assert(fit.rebounds == COUNT && fit.captures == 0 && fit.outliers == 0);
    assert(fabsf(fit.restitution_speed.value / 130.0f - 1.0f) < 0.01f && fabsf(fit.work_of_adhesion.value / 2.22e-12f - 1.0f) < 0.01f);
    assert(fit.restitution_speed.low <= 130.1f && fit.restitution_speed.high >= 129.9f);
    assert(fabs(fit.mass / mass - 1.0) < 1e-5);
    assert(microimpact_fit_restitution(impacts, room, 11, &fit, &error) == MICROIMPACT_STATUS_TOO_FEW);
    assert(microimpact_fit_restitution(impacts, room, (size_t)-1, &fit, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_fit_restitution(NULL, room, COUNT, &fit, &error) == MICROIMPACT_STATUS_POINTER);
    impacts[3].radius = NAN;
    assert(microimpact_fit_restitution(impacts, room, COUNT, &fit, &error) == MICROIMPACT_STATUS_INPUT);
    assert(error.parameter == 0 && isnan(error.value));

    /* zeta_H of the paper: R of silver-coated glass on steel at 13 m/s gives 10.45. */
    MicroimpactContactScene scene;
    memset(&scene, 0, sizeof scene);
    scene.radius = 4.3e-6f, scene.density = 2600.0f, scene.stiffness = 7.5e10f, scene.tolerance = 1e-6f;
    assert(microimpact_fit_material_damping(&scene, 13.0f, 130.0f / 143.0f, &zeta, &error) == MICROIMPACT_STATUS_OK);
    assert(fabsf(zeta - 10.5f) < 0.1f);
    assert(microimpact_fit_material_damping(&scene, 13.0f, 1.5f, &zeta, &error) == MICROIMPACT_STATUS_INPUT);
    assert(microimpact_fit_material_damping(NULL, 13.0f, 0.5f, &zeta, &error) == MICROIMPACT_STATUS_POINTER);
}

int main(void)
{
    versions();
    same_as_each_model();
    misuse_of_scenes();
    critical_speed_in_steps();
    spheres();
    integers();
    contact_in_integers();
    probabilities();
    fits();
    return 0;
}
