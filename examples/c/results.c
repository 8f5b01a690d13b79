/* Classifies and simulates some impacts, in one plane and in space, looks them up in tables, and prints every bit of the results.
   Runs on a microcontroller and on a host. */

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "boundary.h"
#include "microimpact.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* Silver-coated glass on steel: Brach & Dunn (1995), Table 1. */
static const MicroimpactRigidScene BODY = {
    .radius = 5.06e-6f, .density = 2600.0f, .restitution_speed = 130.0f, .work_of_adhesion = 2.22e-12f, .friction = 0.1f};
static const MicroimpactContactScene CONTACT = {
    .radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f, .material_damping = 10.5f,
    .adhesion_strength = 250.0f, .adhesion_damping = 6.25f, .friction = 0.1f};
/* The same without damping, adhesion and friction, which need not be named. */
static const MicroimpactContactScene ELASTIC = {.radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f};
/* Other laws of contact. */
static const MicroimpactContactScene LAWS[] = {
    {.radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f, .dmt_work = 2.0f, .nominal_restitution = 0.8f, .friction = 0.1f},
    {.radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f, .jkr_work = 2.0f, .relaxation_time = 1e-10f, .friction = 0.1f},
    {.radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f, .jkr_work = 2.0f, .ends_by_force = 1, .friction = 0.1f},
    {.radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f, .relaxation_time = 1e-10f, .ends_by_force = 1, .friction = 0.1f},
};

/* Contacts that give sideways, by both rules of unloading. */
static const MicroimpactCompliantScene COMPLIANT[] = {
    {.contact = {.radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f, .material_damping = 10.5f, .friction = 0.1f},
     .stiffness_ratio = 0.85f},
    {.contact = {.radius = 5.06e-6f, .density = 2600.0f, .stiffness = 7.5e10f, .friction = 0.3f},
     .stiffness_ratio = 10.0f, .incremental_unloading = 1},
};

static MicroimpactRigidScene body;
static MicroimpactContactScene contact, elastic;

static const MicroimpactMotion MOTIONS[] = {
    {2.8f, 0.0f, 0.0f},  {2.8f, 0.0f, 0.7388f}, {2.8f, 20.0f, 0.0f}, {2.8f, 1.0f, -2.5f},
    {1.85f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f},    {1.75f, 0.2f, 0.0f}, {1.0f, 5.0f, 0.0f},
};

/* Of one material on one surface, for the tables. */
static const float RADII[] = {1e-6f, 2.5e-6f, 5.06e-6f, 1e-5f};
static const MicroimpactMotion LOOKED_UP[] = {
    {5.15957f, 0.0f, 0.0f}, {2.8f, 0.0f, 0.7388f}, {2.8f, 20.0f, 0.0f}, {1.4f, 0.0f, 0.0f}, {9.0f, 1.0f, -2.5f}, {300.0f, 0.0f, 0.0f},
};
static const float SMALLEST_RADIUS = 2e-6f, LARGEST_SPEED_RATIO = 10.0f;

/* As `cargo microimpact table` has written it. */
static const MicroimpactBoundaryTable CONSTANT = {BOUNDARY_SMALLEST_RADIUS, BOUNDARY_MARGIN, boundary, BOUNDARY_CELLS};

/* Motions in space: onto walls, one of which moves, and of spheres that collide. */
static const MicroimpactWall WALLS[] = {
    {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}}, {{0.48f, -0.6f, 0.64f}, {0.3f, 0.2f, 0.1f}},
};
static const MicroimpactSpatialMotion IN_SPACE[] = {
    {{0.3f, 0.4f, -2.8f}, {1e5f, -2e5f, 7e4f}}, {{12.0f, 16.0f, -3.0f}, {0.0f, 0.0f, 0.0f}}, {{-0.1f, 0.3f, -0.5f}, {0.0f, 3e4f, 0.0f}},
};
static const MicroimpactPair PAIRS[] = {
    {{5.06e-6f, 5.06e-6f}, {2600.0f, 2600.0f}, {1.0f, 0.0f, 0.0f}, {{{-2.8f, 0.2f, 0.1f}, {0.0f, 0.0f, 1e5f}}, {{2.8f, 0.0f, 0.0f}, {0}}}},
    {{4e-6f, 1.2e-5f}, {2600.0f, 1300.0f}, {0.0f, 0.6f, 0.8f},
     {{{0.2f, -1.0f, -4.0f}, {0.0f, 3e4f, -1e4f}}, {{9.0f, 0.5f, 0.4f}, {2e4f, 0.0f, 0.0f}}}},
    {{6e-6f, 5e-6f}, {1000.0f, 2000.0f}, {0.0f, 0.0f, 1.0f}, {{{0.1f, 0.0f, -0.3f}, {0}}, {{0}, {0}}}},
};

static unsigned long bits(float number)
{
    uint32_t word;
    memcpy(&word, &number, sizeof word);
    return word;
}

static int classify(const char *name, const MicroimpactBoundaryTable *table)
{
    MicroimpactVerdict verdict;
    for (size_t i = 0; i < COUNT(RADII); i++) {
        for (size_t j = 0; j < COUNT(LOOKED_UP); j++) {
            if (microimpact_boundary_classify(table, RADII[i], &LOOKED_UP[j], &verdict, NULL) != MICROIMPACT_STATUS_OK)
                return 0;
            printf("%s %lu %lu %d\n", name, (unsigned long)i, (unsigned long)j, (int)verdict);
            /* The function that comes with the constant says the same. */
            if (table == &CONSTANT && (int)verdict != (int)boundary_classify(RADII[i], LOOKED_UP[j].approach))
                return 0;
        }
    }
    return 1;
}

/* The trajectory of every motion, whole and in the least room. */
static int trajectories(const char *name, const MicroimpactContactScene *scene)
{
    static const size_t ROOM[] = {MICROIMPACT_LARGEST_TRAJECTORY, MICROIMPACT_SMALLEST_TRAJECTORY};
    static MicroimpactSample samples[MICROIMPACT_LARGEST_TRAJECTORY];
    MicroimpactContact c;
    size_t written;
    for (size_t i = 0; i < COUNT(MOTIONS); i++) {
        for (size_t j = 0; j < COUNT(ROOM); j++) {
            if (microimpact_simulate_trajectory(scene, &MOTIONS[i], samples, ROOM[j], &written, &c, NULL) != MICROIMPACT_STATUS_OK)
                return 0;
            printf("%s %lu %d %08lx\n", name, (unsigned long)i, (int)c.impact_class, bits(c.restitution));
            for (size_t k = 0; k < written; k++)
                printf("sample %08lx %08lx %08lx %08lx %08lx\n", bits(samples[k].time), bits(samples[k].indentation),
                       bits(samples[k].velocity), bits(samples[k].force), bits(samples[k].elastic));
        }
    }
    return 1;
}

static int boundaries(void)
{
    static int32_t cells[4][4];
    MicroimpactBoundaryTable made;
    if (microimpact_boundary_check(&CONSTANT, NULL) != MICROIMPACT_STATUS_OK || !classify("constant", &CONSTANT))
        return 0;
    if (microimpact_boundary_make(&contact, SMALLEST_RADIUS, cells, COUNT(cells), &made, NULL) != MICROIMPACT_STATUS_OK)
        return 0;
    printf("made %08lx %lu\n", bits(made.smallest_radius), (unsigned long)made.margin);
    for (size_t i = 0; i < made.count; i++)
        printf("cell %ld %ld %ld %ld\n", (long)cells[i][0], (long)cells[i][1], (long)cells[i][2], (long)cells[i][3]);
    return classify("boundary", &made);
}

static int restitutions(void)
{
    static MicroimpactRestitutionTable table;
    MicroimpactTableReading r;
    if (microimpact_restitution_make(&contact, SMALLEST_RADIUS, LARGEST_SPEED_RATIO, &table, NULL) != MICROIMPACT_STATUS_OK)
        return 0;
    for (size_t i = 0; i < COUNT(RADII); i++) {
        for (size_t j = 0; j < COUNT(LOOKED_UP); j++) {
            if (microimpact_restitution_read(&table, RADII[i], &LOOKED_UP[j], &r, NULL) != MICROIMPACT_STATUS_OK)
                return 0;
            printf("restitution %lu %lu %d %d %08lx %08lx %08lx %08lx\n", (unsigned long)i, (unsigned long)j, (int)r.verdict,
                   (int)r.surface_motion, bits(r.restitution), bits(r.restitution_error), bits(r.tangential), bits(r.peripheral));
        }
    }
    return 1;
}

static int simulations(const char *name, const MicroimpactContactScene *scene)
{
    static MicroimpactContact contacts[COUNT(MOTIONS)];
    size_t written;
    if (microimpact_simulate(scene, MOTIONS, COUNT(MOTIONS), contacts, COUNT(contacts), &written, NULL) != MICROIMPACT_STATUS_OK)
        return 0;
    for (size_t i = 0; i < written; i++)
        printf("%s %lu %d %08lx %08lx %08lx %08lx\n", name, (unsigned long)i, (int)contacts[i].impact_class, bits(contacts[i].restitution),
               bits(contacts[i].peak_indentation), bits(contacts[i].tangential), bits(contacts[i].spin));
    return 1;
}

static int compliant(void)
{
    static MicroimpactCompliantContact contacts[COUNT(MOTIONS)];
    MicroimpactCompliantScene scene;
    size_t written;
    for (size_t i = 0; i < COUNT(COMPLIANT); i++) {
        if (microimpact_compliant_init(&COMPLIANT[i], &scene, NULL) != MICROIMPACT_STATUS_OK
            || microimpact_simulate_compliant(&scene, MOTIONS, COUNT(MOTIONS), contacts, COUNT(contacts), &written, NULL)
                   != MICROIMPACT_STATUS_OK)
            return 0;
        for (size_t j = 0; j < written; j++) {
            const MicroimpactCompliantContact *c = &contacts[j];
            printf("compliant %lu %lu %d %lu %08lx %08lx %08lx %08lx %08lx %08lx\n", (unsigned long)i, (unsigned long)j,
                   (int)c->impact_class, (unsigned long)c->phases, bits(c->restitution), bits(c->peak_indentation), bits(c->tangential),
                   bits(c->spin), bits(c->slip), bits(c->impulse_ratio));
        }
    }
    return 1;
}

static void print_motion(const MicroimpactSpatialMotion *motion)
{
    printf(" %08lx %08lx %08lx %08lx %08lx %08lx", bits(motion->velocity[0]), bits(motion->velocity[1]), bits(motion->velocity[2]),
           bits(motion->spin[0]), bits(motion->spin[1]), bits(motion->spin[2]));
}

static int walls(void)
{
    MicroimpactMotion planar;
    MicroimpactContact c;
    MicroimpactSpatialMotion after;
    float sideways;
    size_t written;
    for (size_t i = 0; i < COUNT(WALLS); i++) {
        for (size_t j = 0; j < COUNT(IN_SPACE); j++) {
            if (microimpact_wall_incidence(&WALLS[i], contact.radius, &IN_SPACE[j], &planar, NULL) != MICROIMPACT_STATUS_OK
                || microimpact_wall_sideways(&WALLS[i], contact.radius, &IN_SPACE[j], &sideways, NULL) != MICROIMPACT_STATUS_OK
                || microimpact_simulate(&contact, &planar, 1, &c, 1, &written, NULL) != MICROIMPACT_STATUS_OK
                || microimpact_wall_after(&WALLS[i], contact.radius, &IN_SPACE[j], c.restitution, c.tangential, &after, NULL)
                       != MICROIMPACT_STATUS_OK)
                return 0;
            printf("wall %lu %lu %d %08lx %08lx %08lx %08lx", (unsigned long)i, (unsigned long)j, (int)c.impact_class,
                   bits(planar.approach), bits(planar.tangential), bits(planar.peripheral), bits(sideways));
            print_motion(&after);
            printf("\n");
        }
    }
    return 1;
}

static int pairs(void)
{
    MicroimpactMotion planar;
    MicroimpactContact c;
    MicroimpactSpatialMotion after[2];
    size_t written;
    for (size_t i = 0; i < COUNT(PAIRS); i++) {
        MicroimpactContactScene scene = contact;
        if (microimpact_pair_incidence(&PAIRS[i], &scene.radius, &scene.density, &planar, NULL) != MICROIMPACT_STATUS_OK
            || microimpact_simulate(&scene, &planar, 1, &c, 1, &written, NULL) != MICROIMPACT_STATUS_OK
            || microimpact_pair_after(&PAIRS[i], c.restitution, c.tangential, after, NULL) != MICROIMPACT_STATUS_OK)
            return 0;
        printf("pair %lu %d %08lx %08lx %08lx %08lx", (unsigned long)i, (int)c.impact_class, bits(scene.radius), bits(scene.density),
               bits(planar.approach), bits(planar.tangential));
        print_motion(&after[0]);
        print_motion(&after[1]);
        printf("\n");
    }
    return 1;
}

/* Scenes that are one structure: laws that the others do not have, a hollow sphere, and the method of fixed cost. */
static int of_one_scene(void)
{
    MicroimpactSceneConfig power = {.friction = 0.1f, .model = MICROIMPACT_MODEL_RIGID_BODY,
                                    .restitution_law = MICROIMPACT_RESTITUTION_LAW_POWER, .restitution_speed = 90.0f, .restitution_power = 0.75f,
                                    .rebound_adhesion = MICROIMPACT_REBOUND_ADHESION_SPEED, .adhesion_speed = 1.5f, .adhesion_power = 2.0f};
    MicroimpactSceneConfig fixed_cost = {.radius = 5.06e-6f, .density = 2600.0f, .friction = 0.1f, .model = MICROIMPACT_MODEL_CONTACT,
                                         .stiffness = 7.5e10f, .damping = MICROIMPACT_DAMPING_HYSTERETIC, .material_damping = 10.5f,
                                         .adhesion = MICROIMPACT_ADHESION_RING, .adhesion_strength = 250.0f, .adhesion_damping = 6.25f,
                                         .iterations = 3};
    MicroimpactSceneImpact c;
    if (microimpact_sphere_hollow(5.06e-6f, 1e-6f, 2600.0f, &power, NULL) != MICROIMPACT_STATUS_OK
        || microimpact_scene_init(&power, &power, NULL) != MICROIMPACT_STATUS_OK
        || microimpact_scene_init(&fixed_cost, &fixed_cost, NULL) != MICROIMPACT_STATUS_OK)
        return 0;
    for (size_t i = 0; i < COUNT(MOTIONS); i++) {
        if (microimpact_scene_classify(&power, &MOTIONS[i], &c, NULL) != MICROIMPACT_STATUS_OK)
            return 0;
        printf("power %lu %d %08lx %08lx %08lx\n", (unsigned long)i, (int)c.impact_class, bits(c.restitution), bits(c.tangential), bits(c.peripheral));
        const MicroimpactStatus status = microimpact_scene_classify(&fixed_cost, &MOTIONS[i], &c, NULL);
        if (status == MICROIMPACT_STATUS_UNSOLVED)
            printf("fixed-cost %lu unsolved\n", (unsigned long)i);
        else if (status == MICROIMPACT_STATUS_OK)
            printf("fixed-cost %lu %d %08lx %08lx %08lx\n", (unsigned long)i, (int)c.impact_class, bits(c.restitution), bits(c.tangential),
                   bits(c.peripheral));
        else
            return 0;
    }
    return 1;
}

/* The nearest eighth of a velocity, in 2^-24 of 4 m/s. */
static int32_t in_units(float velocity)
{
    const float eighths = velocity * 8.0f;
    return (int32_t)(eighths < 0.0f ? eighths - 0.5f : eighths + 0.5f) * (MICROIMPACT_FIXED_ONE / 32);
}

static int integers(void)
{
    MicroimpactFixedBody fixed;
    MicroimpactFixedResult c;
    if (microimpact_fixed_init(&body, 4.0f, &fixed, NULL) != MICROIMPACT_STATUS_OK)
        return 0;
    for (size_t i = 0; i < COUNT(MOTIONS); i++) {
        const MicroimpactFixedMotion motion = {in_units(MOTIONS[i].approach), in_units(MOTIONS[i].tangential), in_units(MOTIONS[i].peripheral)};
        if (microimpact_fixed_classify(&fixed, &motion, &c, NULL) != MICROIMPACT_STATUS_OK)
            return 0;
        printf("integers %lu %d %ld %ld %ld\n", (unsigned long)i, (int)c.impact_class, (long)c.restitution, (long)c.tangential, (long)c.peripheral);
    }
    return 1;
}

int main(void)
{
    MicroimpactError error;
    /* Header and library belong together, and this compiler lays out structures as the library does. */
    if (microimpact_abi() != MICROIMPACT_ABI || microimpact_layout() != MICROIMPACT_LAYOUT)
        return 10;
    if (microimpact_rigid_init(&BODY, &body, &error) != MICROIMPACT_STATUS_OK
        || microimpact_contact_init(&CONTACT, &contact, &error) != MICROIMPACT_STATUS_OK
        || microimpact_contact_init(&ELASTIC, &elastic, &error) != MICROIMPACT_STATUS_OK)
        return 1;
    for (size_t i = 0; i < COUNT(MOTIONS); i++) {
        MicroimpactClassification c;
        if (microimpact_classify(&body, &MOTIONS[i], &c, &error) != MICROIMPACT_STATUS_OK)
            return 2;
        printf("rigid %lu %d %08lx %08lx %08lx %08lx %08lx\n", (unsigned long)i, (int)c.impact_class, bits(c.speed_over_critical),
               bits(c.friction_over_limit), bits(c.restitution), bits(c.tangential), bits(c.peripheral));
    }
    if (!simulations("contact", &contact))
        return 3;
    for (size_t i = 0; i < COUNT(LAWS); i++) {
        MicroimpactContactScene scene;
        if (microimpact_contact_init(&LAWS[i], &scene, &error) != MICROIMPACT_STATUS_OK || !simulations("law", &scene))
            return 7;
    }
    if (!trajectories("trajectory", &contact) || !trajectories("elastic", &elastic))
        return 4;
    if (!boundaries())
        return 5;
    if (!restitutions())
        return 6;
    if (!walls() || !pairs())
        return 8;
    if (!compliant())
        return 9;
    if (!of_one_scene() || !integers())
        return 11;
    return 0;
}
