/* Misuse of every function, on a host, under the sanitizers of addresses and of undefined behaviour. With an argument, misuse
   that the library cannot recognise and the sanitizer must. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "microimpact.h"

#undef NDEBUG
#include <assert.h>

static const MicroimpactRigidScene BODY = {5.06e-6f, 2600.0f, 130.0f, 2.22e-12f, 0.1f};
static const MicroimpactContactScene CONTACT = {
    .radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f, .material_damping = 10.5f, .adhesion_strength = 250.0f,
    .adhesion_damping = 6.25f, .friction = 0.1f, .tolerance = 1e-6f};
static const MicroimpactMotion MOTION = {2.8f, 1.0f, 0.0f};

/* That a number was refused, and by which name. */
static void refused(MicroimpactStatus status, const MicroimpactError *error, const char *parameter)
{
    char name[40];
    assert(status == MICROIMPACT_STATUS_INPUT);
    assert(error->fault != MICROIMPACT_FAULT_NONE && error->smallest < error->largest);
    microimpact_parameter_name(error->parameter, name, sizeof name);
    assert(strcmp(name, parameter) == 0);
}

/* A copy on the heap, where the sanitizer watches its bounds. */
static void *copy(const void *original, size_t size)
{
    void *block = malloc(size);
    assert(block);
    return memcpy(block, original, size);
}

static void initialise_rigid(void)
{
    const MicroimpactRigidScene zeros = {0}, least = {.radius = 5.06e-6f, .density = 2600.0f, .restitution_speed = 130.0f};
    MicroimpactRigidScene *parameters = copy(&BODY, sizeof BODY);
    MicroimpactRigidScene *scene = malloc(sizeof *scene);
    MicroimpactError *error = malloc(sizeof *error);
    MicroimpactClassification result;

    assert(microimpact_rigid_init(parameters, scene, error) == MICROIMPACT_STATUS_OK && error->fault == MICROIMPACT_FAULT_NONE);
    assert(memcmp(scene, &BODY, sizeof BODY) == 0 && memcmp(parameters, &BODY, sizeof BODY) == 0);
    /* In its place, and without what may be left out. */
    assert(microimpact_rigid_init(scene, scene, NULL) == MICROIMPACT_STATUS_OK && memcmp(scene, &BODY, sizeof BODY) == 0);
    assert(microimpact_rigid_init(&least, scene, error) == MICROIMPACT_STATUS_OK && memcmp(scene, &least, sizeof least) == 0);
    assert(microimpact_classify(scene, &MOTION, &result, error) == MICROIMPACT_STATUS_OK);

    assert(microimpact_rigid_init(parameters, NULL, error) == MICROIMPACT_STATUS_POINTER);
    MicroimpactRigidScene *crooked = (MicroimpactRigidScene *)((uintptr_t)scene + 1);
    assert(microimpact_rigid_init(parameters, crooked, error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_rigid_init(NULL, NULL, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(memcmp(scene, &least, sizeof least) == 0);
    assert(microimpact_rigid_init(NULL, scene, error) == MICROIMPACT_STATUS_POINTER && memcmp(scene, &zeros, sizeof zeros) == 0);

    static const char *const NAMES[] = {"radius", "density", "restitution speed", "work of adhesion", "friction coefficient"};
    static const float BAD[] = {NAN, INFINITY, -INFINITY, -1.0f, 3.4e38f};
    for (size_t field = 0; field < sizeof NAMES / sizeof NAMES[0]; field++) {
        for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
            float *values = (float *)(void *)parameters, good = values[field];
            values[field] = BAD[i];
            memset(scene, 0xff, sizeof *scene);
            refused(microimpact_rigid_init(parameters, scene, error), error, NAMES[field]);
            assert(memcmp(scene, &zeros, sizeof zeros) == 0);
            assert(microimpact_classify(scene, &MOTION, &result, error) == MICROIMPACT_STATUS_INPUT);
            values[field] = good;
        }
    }
    /* Of two bad values, the first is named. */
    parameters->friction = NAN;
    parameters->density = 0.0f;
    refused(microimpact_rigid_init(parameters, scene, error), error, "density");

    free(parameters), free(scene), free(error);
}

static void initialise_contact(void)
{
    const MicroimpactContactScene zeros = {0}, least = {.radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f};
    MicroimpactContactScene *parameters = copy(&CONTACT, sizeof CONTACT);
    MicroimpactContactScene *scene = malloc(sizeof *scene);
    MicroimpactError *error = malloc(sizeof *error);
    MicroimpactContact result;
    size_t written;

    assert(microimpact_contact_init(parameters, scene, error) == MICROIMPACT_STATUS_OK && error->fault == MICROIMPACT_FAULT_NONE);
    assert(memcmp(scene, &CONTACT, sizeof CONTACT) == 0 && memcmp(parameters, &CONTACT, sizeof CONTACT) == 0);
    assert(microimpact_contact_init(scene, scene, NULL) == MICROIMPACT_STATUS_OK && memcmp(scene, &CONTACT, sizeof CONTACT) == 0);
    /* The tolerance is filled in; without damping, adhesion and friction nothing is lost. */
    assert(microimpact_contact_init(&least, scene, error) == MICROIMPACT_STATUS_OK && scene->tolerance == CONTACT.tolerance);
    assert(microimpact_simulate(scene, &MOTION, 1, &result, 1, &written, error) == MICROIMPACT_STATUS_OK);
    assert(result.impact_class == MICROIMPACT_CLASS_REBOUND_SLIDING && fabsf(result.restitution - 1.0f) < 1e-6f);

    assert(microimpact_contact_init(parameters, NULL, error) == MICROIMPACT_STATUS_POINTER);
    MicroimpactContactScene *crooked = (MicroimpactContactScene *)((uintptr_t)scene + 1);
    assert(microimpact_contact_init(parameters, crooked, error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_contact_init(NULL, NULL, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(scene->tolerance == CONTACT.tolerance);
    assert(microimpact_contact_init(NULL, scene, error) == MICROIMPACT_STATUS_POINTER && memcmp(scene, &zeros, sizeof zeros) == 0);

    static const char *const NAMES[] = {
        "radius", "density", "stiffness", "material damping", "adhesion strength", "adhesion damping", "friction coefficient", "tolerance",
    };
    static const float BAD[] = {NAN, INFINITY, -INFINITY, -1.0f, 3.4e38f};
    for (size_t field = 0; field < sizeof NAMES / sizeof NAMES[0]; field++) {
        for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
            float *values = (float *)(void *)parameters, good = values[field];
            values[field] = BAD[i];
            memset(scene, 0xff, sizeof *scene);
            refused(microimpact_contact_init(parameters, scene, error), error, NAMES[field]);
            assert(memcmp(scene, &zeros, sizeof zeros) == 0);
            assert(microimpact_simulate(scene, &MOTION, 1, &result, 1, &written, error) == MICROIMPACT_STATUS_INPUT);
            values[field] = good;
        }
    }
    /* Of several bad values, the first is named. */
    parameters->tolerance = parameters->friction = NAN;
    parameters->stiffness = 0.0f;
    refused(microimpact_contact_init(parameters, scene, error), error, "stiffness");
    /* Tables refuse the zeros, too, although they take their radii elsewhere. */
    static MicroimpactRestitutionTable table;
    int32_t cells[2][4];
    MicroimpactBoundaryTable made;
    assert(microimpact_boundary_make(scene, 5e-6f, cells, 2, &made, error) == MICROIMPACT_STATUS_INPUT);
    assert(microimpact_restitution_make(scene, 2e-6f, 10.0f, &table, error) == MICROIMPACT_STATUS_INPUT);

    free(parameters), free(scene), free(error);
}

/* Laws that exclude each other, and bad values of each. */
static void choose_laws(void)
{
    const MicroimpactContactScene elastic = {.radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f};
    MicroimpactContactScene p, scene;
    MicroimpactError error;

    p = elastic, p.dmt_work = 0.1f, p.relaxation_time = 1e-10f;
    assert(microimpact_contact_init(&p, &scene, &error) == MICROIMPACT_STATUS_OK);
    p.ends_by_force = 1;
    refused(microimpact_contact_init(&p, &scene, &error), &error, "work of adhesion per area");
    assert(error.fault == MICROIMPACT_FAULT_OTHER_LAW);
    p.ends_by_force = 0, p.jkr_work = 0.1f;
    refused(microimpact_contact_init(&p, &scene, &error), &error, "work of adhesion per area");
    p.dmt_work = 0.0f, p.ends_by_force = 0xffffffffu;
    assert(microimpact_contact_init(&p, &scene, &error) == MICROIMPACT_STATUS_OK);
    p.adhesion_strength = 1.0f;
    refused(microimpact_contact_init(&p, &scene, &error), &error, "adhesion strength");
    p = elastic, p.ends_by_force = 1, p.nominal_restitution = 0.5f;
    assert(microimpact_contact_init(&p, &scene, &error) == MICROIMPACT_STATUS_OK);
    p.material_damping = 1.0f;
    refused(microimpact_contact_init(&p, &scene, &error), &error, "nominal restitution");
    p.relaxation_time = 1e-10f;
    refused(microimpact_contact_init(&p, &scene, &error), &error, "relaxation time");

    static const float BAD[] = {NAN, INFINITY, -1.0f};
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        p = elastic, p.dmt_work = BAD[i];
        refused(microimpact_contact_init(&p, &scene, &error), &error, "work of adhesion per area");
        p = elastic, p.jkr_work = BAD[i];
        refused(microimpact_contact_init(&p, &scene, &error), &error, "work of adhesion per area");
        p = elastic, p.relaxation_time = BAD[i];
        refused(microimpact_contact_init(&p, &scene, &error), &error, "relaxation time");
        p = elastic, p.nominal_restitution = BAD[i];
        refused(microimpact_contact_init(&p, &scene, &error), &error, "nominal restitution");
    }
}

static void classify(void)
{
    MicroimpactRigidScene *scene = copy(&BODY, sizeof BODY);
    MicroimpactMotion *motion = copy(&MOTION, sizeof MOTION);
    MicroimpactClassification *result = malloc(sizeof *result);
    MicroimpactError *error = malloc(sizeof *error);

    assert(microimpact_classify(scene, motion, result, error) == MICROIMPACT_STATUS_OK);
    assert(result->impact_class == MICROIMPACT_CLASS_REBOUND_ROLLING && error->fault == MICROIMPACT_FAULT_NONE);
    assert(microimpact_classify(scene, motion, result, NULL) == MICROIMPACT_STATUS_OK);

    assert(microimpact_classify(NULL, motion, result, error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_classify(scene, NULL, result, error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_classify(scene, motion, NULL, error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_classify(NULL, NULL, NULL, NULL) == MICROIMPACT_STATUS_POINTER);
    /* A misaligned pointer, made without being followed here. */
    const MicroimpactMotion *crooked = (const MicroimpactMotion *)((uintptr_t)motion + 1);
    assert(microimpact_classify(scene, crooked, result, error) == MICROIMPACT_STATUS_POINTER);

    const float bad[] = {NAN, INFINITY, -INFINITY, -1.0f, 0.0f, 3.4e38f};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        motion->approach = bad[i];
        assert(microimpact_classify(scene, motion, result, error) == MICROIMPACT_STATUS_INPUT);
        assert(error->fault != MICROIMPACT_FAULT_NONE && error->smallest < error->largest);
        char name[32];
        size_t length = microimpact_parameter_name(error->parameter, name, sizeof name);
        assert(length == strlen("approach speed") && strcmp(name, "approach speed") == 0);
    }
    motion->approach = 2.8f;
    /* A scene that was never filled. */
    memset(scene, 0, sizeof *scene);
    assert(microimpact_classify(scene, motion, result, error) == MICROIMPACT_STATUS_INPUT);
    memset(scene, 0xff, sizeof *scene);
    assert(microimpact_classify(scene, motion, result, error) == MICROIMPACT_STATUS_INPUT);

    free(scene), free(motion), free(result), free(error);
}

static void simulate(void)
{
    enum { MOTIONS = 5 };
    MicroimpactContactScene *scene = copy(&CONTACT, sizeof CONTACT);
    MicroimpactMotion *motions = malloc(MOTIONS * sizeof *motions);
    for (size_t i = 0; i < MOTIONS; i++)
        motions[i] = (MicroimpactMotion){2.0f + (float)i, 0.5f, 0.0f};
    size_t *written = malloc(sizeof *written);
    MicroimpactError error;

    for (size_t capacity = 0; capacity <= MOTIONS + 1; capacity++) {
        /* Room for so many and not one more. */
        MicroimpactContact *results = malloc(capacity ? capacity * sizeof *results : 1);
        MicroimpactStatus status = microimpact_simulate(scene, motions, MOTIONS, results, capacity, written, &error);
        assert(status == (capacity < MOTIONS ? MICROIMPACT_STATUS_CAPACITY : MICROIMPACT_STATUS_OK));
        assert(*written == (capacity < MOTIONS ? capacity : MOTIONS));
        for (size_t i = 0; i < *written; i++)
            assert(results[i].restitution > 0.6f && results[i].restitution < 1.0f);
        free(results);
    }

    MicroimpactContact *results = malloc(MOTIONS * sizeof *results);
    assert(microimpact_simulate(scene, NULL, 0, NULL, 0, written, NULL) == MICROIMPACT_STATUS_OK && *written == 0);
    assert(microimpact_simulate(NULL, motions, MOTIONS, results, MOTIONS, written, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_simulate(scene, NULL, MOTIONS, results, MOTIONS, written, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_simulate(scene, motions, MOTIONS, NULL, MOTIONS, written, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_simulate(scene, motions, MOTIONS, results, MOTIONS, NULL, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_simulate(scene, NULL, SIZE_MAX, NULL, SIZE_MAX, written, NULL) == MICROIMPACT_STATUS_POINTER);

    motions[3].tangential = NAN;
    assert(microimpact_simulate(scene, motions, MOTIONS, results, MOTIONS, written, &error) == MICROIMPACT_STATUS_INPUT);
    assert(*written == 3 && error.fault == MICROIMPACT_FAULT_NOT_FINITE);
    scene->tolerance = 0.0f;
    assert(microimpact_simulate(scene, motions, MOTIONS, results, MOTIONS, written, &error) == MICROIMPACT_STATUS_INPUT);
    assert(*written == 0);

    free(scene), free(motions), free(written), free(results);
}

/* What an impact is within a number of intervals is what it is without, or nothing. */
static void simulate_within(void)
{
    MicroimpactContactScene *scene = copy(&CONTACT, sizeof CONTACT);
    MicroimpactMotion *motion = copy(&MOTION, sizeof MOTION);
    MicroimpactContact expected, result;
    size_t written, solved = 0, unsolved = 0;
    MicroimpactError error;

    assert(microimpact_simulate(scene, motion, 1, &expected, 1, &written, &error) == MICROIMPACT_STATUS_OK);
    for (uint32_t intervals = 0; intervals < 12; intervals++) {
        memset(&result, 0, sizeof result);
        const MicroimpactStatus status = microimpact_simulate_within(scene, intervals, motion, 1, &result, 1, &written, &error);
        assert(status == (written == 1 ? MICROIMPACT_STATUS_OK : MICROIMPACT_STATUS_UNSOLVED));
        if (written == 1)
            assert(result.restitution == expected.restitution && result.spin == expected.spin), solved++;
        else
            assert(solved == 0), unsolved++;
    }
    assert(solved > 0 && unsolved > 1);
    assert(microimpact_simulate_within(scene, UINT32_MAX, motion, 1, &result, 1, &written, &error) == MICROIMPACT_STATUS_OK);
    assert(result.restitution == expected.restitution);
    assert(microimpact_simulate_within(NULL, 9, motion, 1, &result, 1, &written, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_simulate_within(scene, 9, NULL, 1, &result, 1, &written, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_simulate_within(scene, 9, motion, 1, NULL, 1, &written, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_simulate_within(scene, 9, motion, 1, &result, 1, NULL, &error) == MICROIMPACT_STATUS_POINTER);

    free(scene), free(motion);
}

/* The first sample that is at rest. */
static const MicroimpactSample *peak(const MicroimpactSample *samples, size_t count)
{
    size_t i = 0;
    while (i < count && samples[i].velocity != 0.0f)
        i++;
    assert(i < count);
    return &samples[i];
}

/* That a trajectory is one of the whole's, in the order of time, with all that is never left out. */
static void thinned(const MicroimpactSample *samples, size_t count, const MicroimpactSample *whole, size_t all)
{
    size_t found = 0;
    for (size_t i = 0; i < all && found < count; i++)
        found += memcmp(&samples[found], &whole[i], sizeof *whole) == 0;
    assert(found == count);
    for (size_t i = 1; i < count; i++)
        assert(samples[i].time > samples[i - 1].time);
    assert(memcmp(peak(samples, count), peak(whole, all), sizeof *whole) == 0);
    assert(memcmp(&samples[0], &whole[0], sizeof *whole) == 0);
    assert(memcmp(&samples[count - 1], &whole[all - 1], sizeof *whole) == 0);
}

static void trajectory(void)
{
    enum { MOST = MICROIMPACT_LARGEST_TRAJECTORY, LEAST = MICROIMPACT_SMALLEST_TRAJECTORY };
    /* That which begins to roll, that which slides on, and that which the surface holds. */
    static const MicroimpactMotion MOTIONS[] = {{2.8f, 1.0f, 0.0f}, {2.8f, 20.0f, 0.0f}, {0.5f, 0.0f, 0.0f}};
    MicroimpactContactScene *scene = copy(&CONTACT, sizeof CONTACT);
    MicroimpactMotion *motion = copy(&MOTION, sizeof MOTION);
    MicroimpactSample *whole = malloc(MOST * sizeof *whole);
    MicroimpactContact *result = malloc(sizeof *result), expected;
    size_t *written = malloc(sizeof *written), all;
    MicroimpactError error;

    for (size_t m = 0; m < sizeof MOTIONS / sizeof MOTIONS[0]; m++) {
        *motion = MOTIONS[m];
        assert(microimpact_simulate(scene, motion, 1, &expected, 1, written, &error) == MICROIMPACT_STATUS_OK);
        assert(microimpact_simulate_trajectory(scene, motion, whole, MOST, &all, result, &error) == MICROIMPACT_STATUS_OK);
        assert(memcmp(result, &expected, sizeof expected) == 0 && error.fault == MICROIMPACT_FAULT_NONE);
        assert(all > 2 * LEAST && all <= MOST && whole[0].time == 0.0f);
        assert(fabsf(whole[0].velocity / motion->approach - 1.0f) < 1e-6f);
        for (size_t capacity = 0; capacity <= MOST + 1; capacity++) {
            /* Room for so many and not one more. */
            MicroimpactSample *samples = malloc(capacity ? capacity * sizeof *samples : 1);
            MicroimpactStatus status =
                microimpact_simulate_trajectory(scene, motion, samples, capacity, written, result, &error);
            assert(status == (capacity < LEAST ? MICROIMPACT_STATUS_CAPACITY : MICROIMPACT_STATUS_OK));
            assert(*written <= capacity && (*written == 0) == (capacity < LEAST) && (*written == all) == (capacity >= all));
            if (*written)
                thinned(samples, *written, whole, all);
            free(samples);
        }
    }

    /* A result stays as it is where there is none, and a capacity that no memory has is not followed. */
    memset(result, 0x55, sizeof *result);
    memcpy(&expected, result, sizeof expected);
    const MicroimpactSample before = whole[1];
    MicroimpactSample *crooked = (MicroimpactSample *)((uintptr_t)whole + 1);
    const MicroimpactStatus null = MICROIMPACT_STATUS_POINTER;
    assert(microimpact_simulate_trajectory(NULL, motion, whole, MOST, written, result, &error) == null && *written == 0);
    assert(microimpact_simulate_trajectory(scene, NULL, whole, MOST, written, result, &error) == null);
    assert(microimpact_simulate_trajectory(scene, motion, NULL, MOST, written, result, &error) == null);
    assert(microimpact_simulate_trajectory(scene, motion, crooked, MOST, written, result, &error) == null);
    assert(microimpact_simulate_trajectory(scene, motion, NULL, SIZE_MAX, written, result, NULL) == null);
    assert(microimpact_simulate_trajectory(scene, motion, whole, MOST, NULL, result, &error) == null);
    assert(microimpact_simulate_trajectory(scene, motion, whole, MOST, written, NULL, &error) == null && *written == 0);
    assert(microimpact_simulate_trajectory(NULL, NULL, NULL, 0, NULL, NULL, NULL) == null);
    assert(microimpact_simulate_trajectory(scene, motion, NULL, 0, written, result, NULL) == MICROIMPACT_STATUS_CAPACITY);
    motion->approach = NAN;
    refused(microimpact_simulate_trajectory(scene, motion, whole, MOST, written, result, &error), &error, "approach speed");
    motion->approach = 2.8f;
    scene->tolerance = 0.0f;
    refused(microimpact_simulate_trajectory(scene, motion, whole, MOST, written, result, &error), &error, "tolerance");
    memset(scene, 0, sizeof *scene);
    refused(microimpact_simulate_trajectory(scene, motion, whole, MOST, written, result, &error), &error, "radius");
    assert(*written == 0 && memcmp(result, &expected, sizeof expected) == 0 && memcmp(&whole[1], &before, sizeof before) == 0);

    free(scene), free(motion), free(whole), free(result), free(written);
}

static void boundary(void)
{
    enum { CELLS = 2 };
    int32_t(*cells)[4] = malloc(CELLS * sizeof *cells);
    memset(cells, 0, CELLS * sizeof *cells);
    MicroimpactContactScene *scene = copy(&CONTACT, sizeof CONTACT);
    MicroimpactMotion *motion = copy(&MOTION, sizeof MOTION);
    MicroimpactBoundaryTable *table = malloc(sizeof *table);
    MicroimpactVerdict *verdict = malloc(sizeof *verdict);
    MicroimpactError error;

    assert(microimpact_boundary_make(scene, 5e-6f, cells, CELLS, table, &error) == MICROIMPACT_STATUS_OK);
    assert(table->cells == cells && table->count == CELLS && table->smallest_radius <= 5e-6f);
    assert(microimpact_boundary_check(table, &error) == MICROIMPACT_STATUS_OK);
    assert(microimpact_boundary_classify(table, 5e-6f, motion, verdict, &error) == MICROIMPACT_STATUS_OK);
    assert(*verdict == MICROIMPACT_VERDICT_REBOUND);
    motion->approach = 0.5f;
    assert(microimpact_boundary_classify(table, 5e-6f, motion, verdict, NULL) == MICROIMPACT_STATUS_OK);
    assert(*verdict == MICROIMPACT_VERDICT_CAPTURE);
    const float outside[] = {1e-6f, 1e-5f}, none[] = {NAN, INFINITY, -INFINITY, -5e-6f, 0.0f, 3.4e38f};
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; i++) {
        assert(microimpact_boundary_classify(table, outside[i], motion, verdict, &error) == MICROIMPACT_STATUS_OK);
        assert(*verdict == MICROIMPACT_VERDICT_OUTSIDE_TABLE);
    }
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        assert(microimpact_boundary_classify(table, none[i], motion, verdict, &error) == MICROIMPACT_STATUS_INPUT);
        assert(error.parameter == 0 && error.fault != MICROIMPACT_FAULT_NONE);
    }

    assert(microimpact_boundary_make(NULL, 5e-6f, cells, CELLS, table, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_boundary_make(scene, 5e-6f, NULL, CELLS, table, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_boundary_make(scene, 5e-6f, cells, CELLS, NULL, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_boundary_make(scene, 5e-6f, cells, SIZE_MAX, table, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_boundary_make(scene, NAN, cells, CELLS, table, &error) == MICROIMPACT_STATUS_INPUT);
    assert(error.fault == MICROIMPACT_FAULT_NOT_FINITE);
    /* The cells of a failure hold no table. */
    assert(microimpact_boundary_check(table, &error) == MICROIMPACT_STATUS_INPUT);
    assert(microimpact_boundary_make(scene, 5e-6f, cells, CELLS, table, NULL) == MICROIMPACT_STATUS_OK);
    assert(microimpact_boundary_check(NULL, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_boundary_classify(NULL, 5e-6f, motion, verdict, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_boundary_classify(table, 5e-6f, NULL, verdict, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_boundary_classify(table, 5e-6f, motion, NULL, &error) == MICROIMPACT_STATUS_POINTER);
    motion->approach = NAN;
    assert(microimpact_boundary_classify(table, 5e-6f, motion, verdict, &error) == MICROIMPACT_STATUS_INPUT);
    motion->approach = 2.8f;

    /* A cell that is spoilt, in the whole table and around a radius, and a margin that is too small. */
    cells[0][0] = INT32_MAX;
    assert(microimpact_boundary_check(table, &error) == MICROIMPACT_STATUS_INPUT);
    assert(microimpact_boundary_classify(table, 5e-6f, motion, verdict, &error) == MICROIMPACT_STATUS_INPUT);
    cells[0][0] = cells[1][0];
    table->margin = 0;
    assert(microimpact_boundary_check(table, &error) == MICROIMPACT_STATUS_INPUT);
    assert(microimpact_boundary_classify(table, 5e-6f, motion, verdict, &error) == MICROIMPACT_STATUS_INPUT);
    /* A scene without a boundary. */
    scene->adhesion_strength = 0.0f;
    assert(microimpact_boundary_make(scene, 5e-6f, cells, CELLS, table, &error) == MICROIMPACT_STATUS_INPUT);
    /* A table that was never filled. */
    memset(table, 0, sizeof *table);
    assert(microimpact_boundary_classify(table, 5e-6f, motion, verdict, &error) == MICROIMPACT_STATUS_POINTER);
    memset(table, 0xff, sizeof *table);
    assert(microimpact_boundary_classify(table, 5e-6f, motion, verdict, &error) == MICROIMPACT_STATUS_POINTER);

    free(cells), free(scene), free(motion), free(table), free(verdict);
}

static void boundary_in_steps(void)
{
    enum { CELLS = 2, CALLS = 7 * CELLS };
    int32_t(*cells)[4] = malloc(CELLS * sizeof *cells), (*expected)[4] = malloc(CELLS * sizeof *expected);
    MicroimpactContactScene *scene = copy(&CONTACT, sizeof CONTACT);
    MicroimpactBoundaryMaker *maker = malloc(sizeof *maker);
    MicroimpactBoundaryTable *table = malloc(sizeof *table), at_once;
    size_t *remaining = malloc(sizeof *remaining);
    MicroimpactError error;
    const MicroimpactStatus null = MICROIMPACT_STATUS_POINTER;

    assert(microimpact_boundary_make(scene, 5e-6f, expected, CELLS, &at_once, &error) == MICROIMPACT_STATUS_OK);
    for (size_t budget = 1; budget <= CALLS + 1; budget++) {
        size_t left = CALLS;
        memset(cells, 0x55, CELLS * sizeof *cells), memset(maker, 0x55, sizeof *maker), memset(table, 0x55, sizeof *table);
        assert(microimpact_boundary_begin(scene, 5e-6f, cells, CELLS, maker, &error) == MICROIMPACT_STATUS_OK);
        do {
            left = left > budget ? left - budget : 0;
            assert(microimpact_boundary_step(maker, budget, table, remaining, &error) == MICROIMPACT_STATUS_OK);
            assert(*remaining == left);
        } while (*remaining > 0);
        assert(memcmp(cells, expected, CELLS * sizeof *cells) == 0);
        assert(table->cells == cells && table->count == CELLS && table->margin == at_once.margin);
        assert(table->smallest_radius == at_once.smallest_radius);
        assert(microimpact_boundary_check(table, &error) == MICROIMPACT_STATUS_OK);
    }

    /* A step of nothing, and pointers that are null. */
    assert(microimpact_boundary_begin(scene, 5e-6f, cells, CELLS, maker, NULL) == MICROIMPACT_STATUS_OK);
    assert(microimpact_boundary_step(maker, 0, table, remaining, NULL) == MICROIMPACT_STATUS_OK && *remaining == CALLS);
    assert(microimpact_boundary_step(NULL, 1, table, remaining, &error) == null);
    assert(microimpact_boundary_step(maker, 1, NULL, remaining, &error) == null);
    assert(microimpact_boundary_step(maker, 1, table, NULL, &error) == null);
    assert(microimpact_boundary_begin(NULL, 5e-6f, cells, CELLS, maker, &error) == null);
    assert(microimpact_boundary_begin(scene, 5e-6f, NULL, CELLS, maker, &error) == null);
    assert(microimpact_boundary_begin(scene, 5e-6f, cells, SIZE_MAX, maker, &error) == null);
    assert(microimpact_boundary_begin(scene, 5e-6f, cells, CELLS, NULL, &error) == null);
    refused(microimpact_boundary_begin(scene, -1.0f, cells, CELLS, maker, &error), &error, "radius");
    /* Memory in which nothing was begun. */
    memset(maker, 0xff, sizeof *maker);
    assert(microimpact_boundary_step(maker, 1, table, remaining, &error) == MICROIMPACT_STATUS_UNMADE);
    /* A scene without a boundary: the step says so, and again when it is repeated. */
    scene->adhesion_strength = scene->adhesion_damping = 0.0f;
    assert(microimpact_boundary_begin(scene, 5e-6f, cells, CELLS, maker, &error) == MICROIMPACT_STATUS_OK);
    for (int i = 0; i < 2; i++)
        assert(microimpact_boundary_step(maker, 1, table, remaining, &error) == MICROIMPACT_STATUS_INPUT);
    scene->density = 0.0f;
    refused(microimpact_boundary_begin(scene, 5e-6f, cells, CELLS, maker, &error), &error, "density");

    free(cells), free(expected), free(scene), free(maker), free(table), free(remaining);
}

static void restitution_in_steps(void)
{
    enum { CALLS = 392 };
    static const size_t BUDGETS[] = {1, 50, 57, CALLS};
    MicroimpactContactScene *scene = copy(&CONTACT, sizeof CONTACT);
    MicroimpactRestitutionMaker *maker = malloc(sizeof *maker);
    MicroimpactRestitutionTable *table = malloc(sizeof *table), *expected = malloc(sizeof *expected);
    size_t *remaining = malloc(sizeof *remaining);
    MicroimpactError error;
    const MicroimpactStatus null = MICROIMPACT_STATUS_POINTER;

    memset(expected, 0, sizeof *expected);
    assert(microimpact_restitution_make(scene, 2e-6f, 10.0f, expected, &error) == MICROIMPACT_STATUS_OK);
    for (size_t i = 0; i < sizeof BUDGETS / sizeof BUDGETS[0]; i++) {
        size_t left = CALLS;
        memset(maker, 0x55, sizeof *maker), memset(table, 0, sizeof *table);
        assert(microimpact_restitution_begin(scene, 2e-6f, 10.0f, maker, &error) == MICROIMPACT_STATUS_OK);
        do {
            left = left > BUDGETS[i] ? left - BUDGETS[i] : 0;
            assert(microimpact_restitution_step(maker, BUDGETS[i], table, remaining, &error) == MICROIMPACT_STATUS_OK);
            assert(*remaining == left);
        } while (*remaining > 0);
        assert(memcmp(table, expected, sizeof *table) == 0);
    }
    assert(microimpact_restitution_begin(scene, 2e-6f, 10.0f, maker, NULL) == MICROIMPACT_STATUS_OK);
    assert(microimpact_restitution_step(maker, 0, table, remaining, NULL) == MICROIMPACT_STATUS_OK && *remaining == CALLS);
    assert(microimpact_restitution_step(NULL, 1, table, remaining, &error) == null);
    assert(microimpact_restitution_step(maker, 1, NULL, remaining, &error) == null);
    assert(microimpact_restitution_step(maker, 1, table, NULL, &error) == null);
    assert(microimpact_restitution_begin(NULL, 2e-6f, 10.0f, maker, &error) == null);
    assert(microimpact_restitution_begin(scene, 2e-6f, 10.0f, NULL, &error) == null);
    refused(microimpact_restitution_begin(scene, 2e-6f, 1.0f, maker, &error), &error, "largest over critical speed");
    memset(maker, 0, sizeof *maker);
    assert(microimpact_restitution_step(maker, 1, table, remaining, &error) == MICROIMPACT_STATUS_UNMADE);
    scene->friction = -1.0f;
    refused(microimpact_restitution_begin(scene, 2e-6f, 10.0f, maker, &error), &error, "friction coefficient");

    free(scene), free(maker), free(table), free(expected), free(remaining);
}

static void restitution(void)
{
    MicroimpactContactScene *scene = copy(&CONTACT, sizeof CONTACT);
    MicroimpactMotion *motion = copy(&MOTION, sizeof MOTION);
    MicroimpactRestitutionTable *table = malloc(sizeof *table);
    MicroimpactTableReading *reading = malloc(sizeof *reading);
    MicroimpactError error;

    memset(table, 0, sizeof *table);
    assert(microimpact_restitution_read(table, 5e-6f, motion, reading, &error) == MICROIMPACT_STATUS_UNMADE);
    memset(table, 0xff, sizeof *table);
    assert(microimpact_restitution_read(table, 5e-6f, motion, reading, &error) == MICROIMPACT_STATUS_UNMADE);

    assert(microimpact_restitution_make(scene, 2e-6f, 10.0f, table, &error) == MICROIMPACT_STATUS_OK);
    assert(microimpact_restitution_read(table, 5.06e-6f, motion, reading, NULL) == MICROIMPACT_STATUS_OK);
    assert(reading->verdict == MICROIMPACT_VERDICT_REBOUND && reading->surface_motion != MICROIMPACT_SURFACE_MOTION_NONE);
    assert(reading->restitution > 0.74f && reading->restitution < 0.75f && reading->restitution_error < 1e-3f);
    motion->approach = 0.5f;
    assert(microimpact_restitution_read(table, 5.06e-6f, motion, reading, &error) == MICROIMPACT_STATUS_OK);
    assert(reading->verdict == MICROIMPACT_VERDICT_CAPTURE && reading->restitution == 0.0f);
    const float outside[] = {1e-6f, 1e-5f}, none[] = {NAN, INFINITY, -INFINITY, -5e-6f, 0.0f, 3.4e38f};
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; i++) {
        assert(microimpact_restitution_read(table, outside[i], motion, reading, &error) == MICROIMPACT_STATUS_OK);
        assert(reading->verdict == MICROIMPACT_VERDICT_OUTSIDE_TABLE && reading->restitution < 0.0f);
    }
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        assert(microimpact_restitution_read(table, none[i], motion, reading, &error) == MICROIMPACT_STATUS_INPUT);

    assert(microimpact_restitution_read(NULL, 5e-6f, motion, reading, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_restitution_read(table, 5e-6f, NULL, reading, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_restitution_read(table, 5e-6f, motion, NULL, &error) == MICROIMPACT_STATUS_POINTER);
    const MicroimpactRestitutionTable *crooked = (const MicroimpactRestitutionTable *)((uintptr_t)table + 1);
    assert(microimpact_restitution_read(crooked, 5e-6f, motion, reading, &error) == MICROIMPACT_STATUS_POINTER);
    motion->tangential = NAN;
    assert(microimpact_restitution_read(table, 5e-6f, motion, reading, &error) == MICROIMPACT_STATUS_INPUT);
    /* Everything in it but the mark is spoilt. */
    motion->tangential = 0.0f;
    for (size_t i = 0; i < sizeof table->words / sizeof table->words[0]; i++) {
        uint32_t word = table->words[i];
        table->words[i] = 0xffffffffu;
        microimpact_restitution_read(table, 5e-6f, motion, reading, &error);
        table->words[i] = word;
    }

    assert(microimpact_restitution_make(NULL, 2e-6f, 10.0f, table, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_restitution_make(scene, 2e-6f, 10.0f, NULL, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_restitution_make(scene, 2e-6f, 0.5f, table, &error) == MICROIMPACT_STATUS_INPUT);
    char name[32];
    microimpact_parameter_name(error.parameter, name, sizeof name);
    assert(strstr(name, "speed"));

    free(scene), free(motion), free(table), free(reading);
}

static int close_to(float value, float expected, float scale)
{
    return fabsf(value - expected) < 2e-6f * scale;
}

/* What a scene gives for a planar motion of a sphere. */
struct after {
    float restitution, tangential;
    MicroimpactClass impact_class;
};

static struct after impact_of(float radius, float density, const MicroimpactMotion *planar, int simulated)
{
    struct after after;
    MicroimpactError error;
    if (simulated) {
        MicroimpactContactScene scene = CONTACT;
        MicroimpactContact result;
        size_t written;
        scene.radius = radius, scene.density = density;
        assert(microimpact_contact_init(&scene, &scene, &error) == MICROIMPACT_STATUS_OK);
        assert(microimpact_simulate(&scene, planar, 1, &result, 1, &written, &error) == MICROIMPACT_STATUS_OK);
        after = (struct after){result.restitution, result.tangential, result.impact_class};
    } else {
        MicroimpactRigidScene scene = BODY;
        MicroimpactClassification result;
        scene.radius = radius, scene.density = density;
        assert(microimpact_rigid_init(&scene, &scene, &error) == MICROIMPACT_STATUS_OK);
        assert(microimpact_classify(&scene, planar, &result, &error) == MICROIMPACT_STATUS_OK);
        after = (struct after){result.restitution, result.tangential, result.impact_class};
    }
    return after;
}

static void wall_values(void)
{
    const float r = BODY.radius;
    const MicroimpactWall floor = {{0.0f, 0.0f, 1.0f}, {0}}, lift = {{0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.5f}};
    const MicroimpactWall slope = {{0.6f, 0.0f, 0.8f}, {0}};
    MicroimpactSpatialMotion motion = {{0.3f, 0.4f, -2.8f}, {0.0f, 0.0f, 7.0f}}, after, moved;
    MicroimpactMotion planar;
    MicroimpactError error;

    for (int simulated = 0; simulated < 2; simulated++) {
        /* Along x and y at once; it rolls off with 5/7 of the tangential velocity and goes on spinning about the normal. */
        assert(microimpact_wall_incidence(&floor, r, &motion, &planar, &error) == MICROIMPACT_STATUS_OK);
        assert(planar.approach == 2.8f && close_to(planar.tangential, 0.5f, 0.5f) && planar.peripheral == 0.0f);
        struct after end = impact_of(r, BODY.density, &planar, simulated);
        assert(end.impact_class == MICROIMPACT_CLASS_REBOUND_ROLLING && end.restitution > 0.5f);
        assert(microimpact_wall_after(&floor, r, &motion, end.restitution, end.tangential, &after, &error) == MICROIMPACT_STATUS_OK);
        assert(close_to(after.velocity[0], 0.3f * 5.0f / 7.0f, 1.0f) && close_to(after.velocity[1], 0.4f * 5.0f / 7.0f, 1.0f));
        assert(close_to(after.velocity[2], 2.8f * end.restitution, 2.8f) && after.spin[2] == 7.0f);
        assert(close_to(r * after.spin[1], after.velocity[0], 1.0f) && close_to(-r * after.spin[0], after.velocity[1], 1.0f));

        /* Seen from a lift, all is the same. */
        MicroimpactSpatialMotion seen = motion;
        for (size_t i = 0; i < 3; i++)
            seen.velocity[i] += lift.velocity[i];
        assert(microimpact_wall_incidence(&lift, r, &seen, &planar, &error) == MICROIMPACT_STATUS_OK);
        assert(close_to(planar.approach, 2.8f, 2.8f) && close_to(planar.tangential, 0.5f, 1.0f));
        assert(microimpact_wall_after(&lift, r, &seen, end.restitution, end.tangential, &moved, NULL) == MICROIMPACT_STATUS_OK);
        for (size_t i = 0; i < 3; i++)
            assert(close_to(moved.velocity[i] - lift.velocity[i], after.velocity[i], 2.8f));
    }

    /* Straight onto a slope, and the same memory for both motions. */
    motion = (MicroimpactSpatialMotion){{-1.2f, 0.0f, -1.6f}, {0}};
    assert(microimpact_wall_incidence(&slope, r, &motion, &planar, NULL) == MICROIMPACT_STATUS_OK);
    assert(close_to(planar.approach, 2.0f, 2.0f) && close_to(planar.tangential, 0.0f, 2.0f));
    assert(microimpact_wall_after(&slope, r, &motion, 0.5f, 0.0f, &motion, NULL) == MICROIMPACT_STATUS_OK);
    assert(close_to(motion.velocity[0], 0.6f, 2.0f) && motion.velocity[1] == 0.0f && close_to(motion.velocity[2], 0.8f, 2.0f));
    /* A captured sphere stays on its wall. */
    motion = (MicroimpactSpatialMotion){{0.0f, 0.0f, -0.5f}, {0}};
    assert(microimpact_wall_incidence(&lift, r, &motion, &planar, &error) == MICROIMPACT_STATUS_OK);
    assert(close_to(planar.approach, 1.0f, 1.0f) && close_to(planar.tangential, 1.0f, 1.0f));
    assert(microimpact_wall_after(&lift, r, &motion, 0.0f, 0.0f, &after, &error) == MICROIMPACT_STATUS_OK);
    for (size_t i = 0; i < 3; i++)
        assert(close_to(after.velocity[i], lift.velocity[i], 1.0f));
}

static void pair_values(void)
{
    const float r = BODY.radius, density = BODY.density;
    const MicroimpactPair head_on = {{2.0f * r, 2.0f * r}, {density, density}, {1.0f, 0.0f, 0.0f},
                                     {{{-1.4f, 0.0f, 0.0f}, {0}}, {{1.4f, 0.0f, 0.0f}, {0}}}};
    const MicroimpactPair oblique = {{r, 3.0f * r}, {density, 0.5f * density}, {0.0f, 0.6f, 0.8f},
                                     {{{0.2f, -1.0f, -2.0f}, {0.0f, 3e4f, -1e4f}}, {{0.1f, 0.5f, 0.4f}, {2e4f, 0.0f, 0.0f}}}};
    MicroimpactSpatialMotion after[2];
    MicroimpactMotion planar;
    MicroimpactError error;
    float radius, reduced;

    /* Equal spheres exchange their velocities but for what is lost. */
    assert(microimpact_pair_incidence(&head_on, &radius, &reduced, &planar, &error) == MICROIMPACT_STATUS_OK);
    assert(close_to(radius / r, 1.0f, 1.0f) && close_to(reduced / density, 4.0f, 4.0f));
    assert(planar.approach == 2.8f && planar.tangential == 0.0f && planar.peripheral == 0.0f);
    struct after end = impact_of(radius, reduced, &planar, 1);
    assert(end.restitution > 0.5f && end.restitution < 1.0f && end.tangential == 0.0f);
    assert(microimpact_pair_after(&head_on, end.restitution, end.tangential, after, &error) == MICROIMPACT_STATUS_OK);
    assert(close_to(after[0].velocity[0], 1.4f * end.restitution, 1.4f) && close_to(after[1].velocity[0], -1.4f * end.restitution, 1.4f));
    /* What holds them makes them go on together. */
    assert(microimpact_pair_after(&head_on, 0.0f, 0.0f, after, NULL) == MICROIMPACT_STATUS_OK);
    assert(close_to(after[0].velocity[0], 0.0f, 1.4f) && close_to(after[1].velocity[0], 0.0f, 1.4f));

    /* Unequal ones that spin: momentum is kept, and they roll off each other. */
    const float mass[2] = {1.0f, 13.5f};
    for (int simulated = 0; simulated < 2; simulated++) {
        assert(microimpact_pair_incidence(&oblique, &radius, &reduced, &planar, &error) == MICROIMPACT_STATUS_OK);
        assert(close_to(radius / r, 0.75f, 1.0f) && close_to(reduced / density, 13.5f / 14.5f * 64.0f / 27.0f, 3.0f));
        assert(close_to(planar.approach, 2.82f, 2.82f) && planar.tangential > 0.0f && planar.peripheral == 0.0f);
        end = impact_of(radius, reduced, &planar, simulated);
        assert(end.impact_class == MICROIMPACT_CLASS_REBOUND_ROLLING);
        assert(microimpact_pair_after(&oblique, end.restitution, end.tangential, after, &error) == MICROIMPACT_STATUS_OK);
        float normal = 0.0f;
        for (size_t i = 0; i < 3; i++) {
            const size_t j = (i + 1) % 3, k = (i + 2) % 3;
            const MicroimpactSpatialMotion *before = oblique.motion;
            float momentum = 0.0f, slip = after[0].velocity[i] - after[1].velocity[i];
            for (size_t s = 0; s < 2; s++) {
                const float *n = oblique.normal, *spin = after[s].spin;
                momentum += mass[s] * (after[s].velocity[i] - before[s].velocity[i]);
                slip -= oblique.radius[s] * (spin[j] * n[k] - spin[k] * n[j]);
            }
            normal += (after[0].velocity[i] - after[1].velocity[i]) * oblique.normal[i];
            assert(close_to(momentum, 0.0f, 14.0f) && close_to(slip, 2.82f * end.restitution * oblique.normal[i], 4.0f));
        }
        assert(close_to(normal, 2.82f * end.restitution, 4.0f));
    }

    /* In the memory of the motions before. */
    MicroimpactPair *pair = copy(&oblique, sizeof oblique);
    assert(microimpact_pair_after(pair, end.restitution, end.tangential, pair->motion, &error) == MICROIMPACT_STATUS_OK);
    assert(memcmp(pair->motion, after, sizeof after) == 0 && memcmp(pair, &oblique, offsetof(MicroimpactPair, motion)) == 0);
    free(pair);
}

/* A contact that gives sideways, of a sphere on a wall and of two spheres. */
static void compliance(void)
{
    const float r = BODY.radius;
    const MicroimpactCompliantScene elastic = {
        .contact = {.radius = r, .density = BODY.density, .stiffness = 7.5e10f, .friction = 0.5f, .tolerance = 1e-6f},
        .stiffness_ratio = 6.0f / 7.0f};
    MicroimpactCompliantScene *p = copy(&elastic, sizeof elastic), *scene = malloc(sizeof *scene), zeros = {0};
    MicroimpactMotion motions[] = {{1.0f, 0.1f, 0.0f}, {1.0f, 1.0f, 0.0f}, {1.0f, 5.0f, 0.0f}};
    enum { MOTIONS = sizeof motions / sizeof motions[0] };
    MicroimpactCompliantContact *results = malloc(MOTIONS * sizeof *results);
    MicroimpactError error;
    size_t written;

    /* Sticking, then slip; slip, sticking and slip back; slip throughout, which takes f (1 + e) of the approach speed. */
    p->contact.tolerance = 0.0f;
    assert(microimpact_compliant_init(p, scene, &error) == MICROIMPACT_STATUS_OK && memcmp(scene, &elastic, sizeof elastic) == 0);
    assert(microimpact_simulate_compliant(scene, motions, MOTIONS, results, MOTIONS, &written, &error) == MICROIMPACT_STATUS_OK);
    assert(written == 3 && results[0].phases == 2 && results[1].phases == 3 && results[2].phases == 1);
    assert(close_to(results[2].tangential, 4.0f, 5.0f) && close_to(results[2].impulse_ratio, -0.5f, 1.0f));
    for (size_t i = 0; i < MOTIONS; i++) {
        const MicroimpactCompliantContact *c = &results[i];
        assert(c->impact_class == MICROIMPACT_CLASS_REBOUND_SLIDING && close_to(c->restitution, 1.0f, 1.0f));
        assert(close_to(c->slip, c->tangential - r * c->spin, 5.0f));
    }
    assert(results[1].slip < 0.0f);
    /* The other rule of unloading. */
    MicroimpactCompliantContact other;
    p->incremental_unloading = 0xffffffffu;
    assert(microimpact_compliant_init(p, p, NULL) == MICROIMPACT_STATUS_OK);
    assert(microimpact_simulate_compliant(p, &motions[0], 1, &other, 1, &written, NULL) == MICROIMPACT_STATUS_OK);
    assert(fabsf(other.slip - results[0].slip) > 1e-3f && other.restitution == results[0].restitution);
    assert(microimpact_simulate_compliant(p, motions, MOTIONS, results, 2, &written, NULL) == MICROIMPACT_STATUS_CAPACITY && written == 2);

    /* Two spheres: momentum is kept. */
    const MicroimpactPair pair = {{r, 2.0f * r}, {BODY.density, BODY.density}, {0.0f, 0.0f, 1.0f},
                                  {{{0.3f, 0.0f, -1.0f}, {0.0f, 1e4f, 0.0f}}, {{0.0f, 0.2f, 0.5f}, {0}}}};
    MicroimpactSpatialMotion after[2];
    MicroimpactMotion planar;
    *p = elastic;
    assert(microimpact_pair_incidence(&pair, &p->contact.radius, &p->contact.density, &planar, &error) == MICROIMPACT_STATUS_OK);
    assert(microimpact_compliant_init(p, scene, &error) == MICROIMPACT_STATUS_OK);
    assert(microimpact_simulate_compliant(scene, &planar, 1, &other, 1, &written, &error) == MICROIMPACT_STATUS_OK);
    assert(microimpact_pair_after(&pair, other.restitution, other.tangential, after, &error) == MICROIMPACT_STATUS_OK);
    for (size_t i = 0; i < 3; i++) {
        const float *u = pair.motion[0].velocity, *v = pair.motion[1].velocity;
        assert(close_to(after[0].velocity[i] - u[i], -8.0f * (after[1].velocity[i] - v[i]), 8.0f));
    }
    assert(close_to(after[0].velocity[2] - after[1].velocity[2], 1.5f, 1.5f) && after[0].velocity[0] != 0.3f);

    /* What it does not go with, bad values and bad pointers. */
    static const float BAD[] = {NAN, INFINITY, 0.0f, -1.0f, 1001.0f};
    *p = elastic;
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        p->stiffness_ratio = BAD[i];
        refused(microimpact_compliant_init(p, scene, &error), &error, "stiffness ratio");
        assert(memcmp(scene, &zeros, sizeof zeros) == 0);
        refused(microimpact_simulate_compliant(p, motions, 1, &other, 1, &written, &error), &error, "stiffness ratio");
    }
    *p = elastic, p->contact.adhesion_strength = 250.0f;
    refused(microimpact_compliant_init(p, scene, &error), &error, "stiffness ratio");
    assert(error.fault == MICROIMPACT_FAULT_OTHER_LAW);
    *p = elastic, p->contact.friction = -1.0f;
    refused(microimpact_compliant_init(p, scene, &error), &error, "friction coefficient");
    *p = elastic, motions[0].tangential = NAN;
    refused(microimpact_simulate_compliant(p, motions, 1, &other, 1, &written, &error), &error, "tangential velocity");
    const MicroimpactStatus null = MICROIMPACT_STATUS_POINTER;
    assert(microimpact_compliant_init(NULL, scene, &error) == null && microimpact_compliant_init(p, NULL, NULL) == null);
    assert(microimpact_simulate_compliant(NULL, motions, 1, &other, 1, &written, &error) == null);
    assert(microimpact_simulate_compliant(p, NULL, 1, &other, 1, &written, &error) == null);
    assert(microimpact_simulate_compliant(p, &motions[1], 1, NULL, 1, &written, &error) == null);
    assert(microimpact_simulate_compliant(p, motions, 1, &other, 1, NULL, &error) == null);

    free(p), free(scene), free(results);
}

/* A captured sphere whose plane shows it at rest rolls sideways. */
static void rolls_sideways(void)
{
    const MicroimpactWall floor = {{0.0f, 0.0f, 1.0f}, {0.0f, 0.5f, 0.0f}};
    const MicroimpactRigidScene sticky = {.radius = 1.0f, .density = 1000.0f, .restitution_speed = 1.0f, .work_of_adhesion = 1e6f, .friction = 1e3f};
    /* It slips along x, where its spin is just what stops it, and rolls along y with 1 m/s on a floor that moves. */
    const MicroimpactSpatialMotion motion = {{1.0f, 1.5f, -1.0f}, {-1.0f, -2.5f, 0.0f}};
    MicroimpactMotion planar;
    MicroimpactClassification result;
    MicroimpactError error;
    float sideways;

    assert(microimpact_wall_incidence(&floor, 1.0f, &motion, &planar, &error) == MICROIMPACT_STATUS_OK);
    assert(microimpact_classify(&sticky, &planar, &result, &error) == MICROIMPACT_STATUS_OK);
    assert(result.impact_class == MICROIMPACT_CLASS_CAPTURED_RESTING);
    assert(microimpact_wall_sideways(&floor, 1.0f, &motion, &sideways, &error) == MICROIMPACT_STATUS_OK);
    assert(close_to(fabsf(sideways), 1.0f, 1.0f));

    assert(microimpact_wall_sideways(NULL, 1.0f, &motion, &sideways, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_wall_sideways(&floor, 1.0f, NULL, &sideways, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_wall_sideways(&floor, 1.0f, &motion, NULL, &error) == MICROIMPACT_STATUS_POINTER);
    refused(microimpact_wall_sideways(&floor, NAN, &motion, &sideways, &error), &error, "radius");
}

static void wall_misuse(void)
{
    const MicroimpactStatus null = MICROIMPACT_STATUS_POINTER;
    const MicroimpactWall floor = {{0.0f, 0.0f, 1.0f}, {0}};
    const MicroimpactSpatialMotion falls = {{0.3f, 0.4f, -2.8f}, {0}};
    const float r = BODY.radius;
    MicroimpactWall *wall = copy(&floor, sizeof floor);
    MicroimpactSpatialMotion *motion = copy(&falls, sizeof falls), *after = copy(&falls, sizeof falls);
    MicroimpactMotion *planar = copy(&MOTION, sizeof MOTION);
    MicroimpactError error;

    assert(microimpact_wall_incidence(NULL, r, motion, planar, &error) == null);
    assert(microimpact_wall_incidence(wall, r, NULL, planar, &error) == null);
    assert(microimpact_wall_incidence(wall, r, motion, NULL, &error) == null);
    assert(microimpact_wall_incidence((const MicroimpactWall *)((uintptr_t)wall + 1), r, motion, planar, &error) == null);
    assert(microimpact_wall_after(NULL, r, motion, 0.5f, 0.0f, after, &error) == null);
    assert(microimpact_wall_after(wall, r, NULL, 0.5f, 0.0f, after, &error) == null);
    assert(microimpact_wall_after(wall, r, motion, 0.5f, 0.0f, NULL, &error) == null);
    assert(microimpact_wall_after(wall, r, motion, 0.5f, 0.0f, (MicroimpactSpatialMotion *)((uintptr_t)after + 2), &error) == null);

    static const float BAD[] = {NAN, INFINITY, -INFINITY, -3.4e38f, 3.4e38f};
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        for (size_t axis = 0; axis < 3; axis++) {
            float *const places[] = {&wall->normal[axis], &wall->velocity[axis], &motion->velocity[axis], &motion->spin[axis]};
            static const char *const NAMES[] = {"length of the normal", "component of the velocity", "component of the velocity", "spin"};
            for (size_t place = 0; place < sizeof places / sizeof places[0]; place++) {
                const float good = *places[place];
                *places[place] = BAD[i];
                refused(microimpact_wall_incidence(wall, r, motion, planar, &error), &error, NAMES[place]);
                refused(microimpact_wall_after(wall, r, motion, 0.5f, 0.0f, after, &error), &error, NAMES[place]);
                *places[place] = good;
            }
        }
        refused(microimpact_wall_incidence(wall, BAD[i], motion, planar, &error), &error, "radius");
        refused(microimpact_wall_after(wall, BAD[i], motion, 0.5f, 0.0f, after, &error), &error, "radius");
        refused(microimpact_wall_after(wall, r, motion, BAD[i], 0.0f, after, &error), &error, "restitution");
        refused(microimpact_wall_after(wall, r, motion, 0.5f, BAD[i], after, &error), &error, "tangential velocity");
    }
    refused(microimpact_wall_after(wall, r, motion, -0.001f, 0.0f, after, &error), &error, "restitution");
    refused(microimpact_wall_after(wall, r, motion, 1.001f, 0.0f, after, &error), &error, "restitution");
    assert(error.fault == MICROIMPACT_FAULT_TOO_LARGE);

    /* A normal that is not of length one, and one that points into the wall; what rests on the wall does not approach it. */
    wall->normal[2] = 1.01f;
    refused(microimpact_wall_incidence(wall, r, motion, planar, &error), &error, "length of the normal");
    wall->normal[2] = 0.0f;
    refused(microimpact_wall_incidence(wall, r, motion, planar, &error), &error, "length of the normal");
    wall->normal[2] = -1.0f;
    refused(microimpact_wall_incidence(wall, r, motion, planar, &error), &error, "approach speed");
    assert(error.fault == MICROIMPACT_FAULT_RECEDING);
    refused(microimpact_wall_after(wall, r, motion, 0.5f, 0.0f, after, &error), &error, "approach speed");
    assert(error.fault == MICROIMPACT_FAULT_RECEDING);
    wall->normal[2] = 1.0f, motion->velocity[2] = 0.0f;
    refused(microimpact_wall_incidence(wall, r, motion, planar, &error), &error, "approach speed");
    assert(memcmp(after, &falls, sizeof falls) == 0 && memcmp(planar, &MOTION, sizeof MOTION) == 0);

    free(wall), free(motion), free(after), free(planar);
}

static void pair_misuse(void)
{
    const MicroimpactStatus null = MICROIMPACT_STATUS_POINTER;
    const MicroimpactPair meeting = {{1e-5f, 2e-5f}, {1000.0f, 2600.0f}, {1.0f, 0.0f, 0.0f},
                                     {{{-1.4f, 0.0f, 0.0f}, {0}}, {{1.4f, 0.5f, 0.0f}, {0}}}};
    MicroimpactPair *pair = copy(&meeting, sizeof meeting);
    /* Room for two motions and not one more. */
    MicroimpactSpatialMotion *after = copy(meeting.motion, sizeof meeting.motion);
    MicroimpactMotion *planar = copy(&MOTION, sizeof MOTION);
    float *radius = copy(&BODY.radius, sizeof BODY.radius), *density = copy(&BODY.density, sizeof BODY.density);
    MicroimpactError error;

    assert(microimpact_pair_incidence(NULL, radius, density, planar, &error) == null);
    assert(microimpact_pair_incidence(pair, NULL, density, planar, &error) == null);
    assert(microimpact_pair_incidence(pair, radius, NULL, planar, &error) == null);
    assert(microimpact_pair_incidence(pair, radius, density, NULL, &error) == null);
    assert(microimpact_pair_incidence((const MicroimpactPair *)((uintptr_t)pair + 1), radius, density, planar, &error) == null);
    assert(microimpact_pair_after(NULL, 0.5f, 0.0f, after, &error) == null);
    assert(microimpact_pair_after(pair, 0.5f, 0.0f, NULL, &error) == null);
    assert(microimpact_pair_after(pair, 0.5f, 0.0f, (MicroimpactSpatialMotion *)((uintptr_t)after + 2), NULL) == null);

    static const float BAD[] = {NAN, INFINITY, -INFINITY, -3.4e38f, 3.4e38f};
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        for (size_t s = 0; s < 2; s++) {
            float *const places[] = {&pair->radius[s], &pair->density[s], &pair->normal[s], &pair->motion[s].velocity[s],
                                     &pair->motion[s].spin[s]};
            static const char *const NAMES[] = {"radius", "density", "length of the normal", "component of the velocity", "spin"};
            for (size_t place = 0; place < sizeof places / sizeof places[0]; place++) {
                const float good = *places[place];
                *places[place] = BAD[i];
                refused(microimpact_pair_incidence(pair, radius, density, planar, &error), &error, NAMES[place]);
                refused(microimpact_pair_after(pair, 0.5f, 0.0f, after, &error), &error, NAMES[place]);
                *places[place] = good;
            }
        }
        refused(microimpact_pair_after(pair, BAD[i], 0.0f, after, &error), &error, "restitution");
        refused(microimpact_pair_after(pair, 0.5f, BAD[i], after, &error), &error, "tangential velocity");
    }
    pair->normal[0] = -1.0f;
    refused(microimpact_pair_incidence(pair, radius, density, planar, &error), &error, "approach speed");
    assert(error.fault == MICROIMPACT_FAULT_RECEDING);
    refused(microimpact_pair_after(pair, 0.5f, 0.0f, after, &error), &error, "approach speed");
    /* A pair that was never filled. */
    memset(pair, 0, sizeof *pair);
    refused(microimpact_pair_incidence(pair, radius, density, planar, &error), &error, "radius");
    memset(pair, 0xff, sizeof *pair);
    refused(microimpact_pair_after(pair, 0.5f, 0.0f, after, &error), &error, "radius");
    assert(memcmp(after, meeting.motion, sizeof meeting.motion) == 0 && memcmp(planar, &MOTION, sizeof MOTION) == 0);
    assert(*radius == BODY.radius && *density == BODY.density);

    free(pair), free(after), free(planar), free(radius), free(density);
}

static void parameter_names(void)
{
    for (size_t capacity = 0; capacity < 10; capacity++) {
        char *buffer = malloc(capacity ? capacity : 1);
        memset(buffer, '#', capacity ? capacity : 1);
        assert(microimpact_parameter_name(0, buffer, capacity) == strlen("radius"));
        if (capacity)
            assert(strncmp(buffer, "radius", capacity - 1) == 0 && memchr(buffer, 0, capacity));
        free(buffer);
    }
    char empty[1] = "#";
    assert(microimpact_parameter_name(UINT32_MAX, empty, sizeof empty) == 0 && empty[0] == 0);
    assert(microimpact_parameter_name(0, NULL, 100) == strlen("radius"));
}

/* Less room than the capacity says. */
static void overflow(void)
{
    const MicroimpactMotion motions[] = {MOTION, MOTION};
    MicroimpactContact *results = malloc(sizeof *results);
    size_t written;
    microimpact_simulate(&CONTACT, motions, 2, results, 2, &written, NULL);
    free(results);
}

int main(int count, char **arguments)
{
    (void)arguments;
    if (count > 1) {
        overflow();
        return 0;
    }
    initialise_rigid();
    initialise_contact();
    choose_laws();
    classify();
    simulate();
    simulate_within();
    trajectory();
    boundary();
    boundary_in_steps();
    restitution_in_steps();
    restitution();
    wall_values();
    pair_values();
    compliance();
    rolls_sideways();
    wall_misuse();
    pair_misuse();
    parameter_names();
    return 0;
}
