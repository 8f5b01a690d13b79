/* What every function of the library takes on a Cortex-M3 that is emulated with a fixed time for each instruction: instructions and
   stack, the most over a grid of motions. One line for each function: its name, instructions, bytes of stack. */

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "microimpact.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* The shared grid of impacts, which cargo qemu c writes: radius, stiffness, speed, damping of the materials, strength of the ring and
   damping of adhesion, in SI units. Without it, the scene of the paper. */
static const float GRID[][6] = {
#ifdef GRID_FILE
#include GRID_FILE
#else
    {5.06e-6f, 7.5e10f, 2.8f, 10.5f, 250.0f, 6.25f},
#endif
};

/* The timer of the core, SysTick: control, reload value, and value, which falls through 24 bits. */
#define TIMER ((volatile uint32_t *)0xe000e010u)
#define LARGEST 0xffffffu
/* Enabled, with an exception at each round, by the clock of the core. */
#define RUNNING 7u

/* Bytes of stack that are painted, those next to the stack pointer that are not, and the paint. */
#define PAINTED 16384u
#define SPARED 64u
#define PAINT 0xa5c3965au

static volatile uint32_t rounds;

void timer_round(void);
void timer_round(void)
{
    rounds++;
}

/* What is measured. */
static MicroimpactRigidScene body = {5.06e-6f, 2600.0f, 130.0f, 2.22e-12f, 0.1f};
static MicroimpactContactScene contact;
static MicroimpactCompliantScene compliant;
static MicroimpactSceneConfig scenes[3];
static MicroimpactFixedBody fixed;
static MicroimpactFixedContact fixed_contact;
static MicroimpactMotion motion;
static MicroimpactBoundaryTable boundary;
static int32_t cells[12][4];
static MicroimpactRestitutionTable table;
static MicroimpactBoundaryMaker boundary_maker;
static MicroimpactRestitutionMaker restitution_maker;
static MicroimpactCriticalSearch search;
static uint32_t found;
static size_t remaining;
static MicroimpactTally tally;
static MicroimpactQueue queue;
static MicroimpactEvent events[8], event;
static MicroimpactError error;
static MicroimpactSceneImpact impact;
static MicroimpactMeasuredImpact measured[30];
static MicroimpactFitRoom room[30];
static MicroimpactPair pair = {{5.06e-6f, 8e-6f}, {2600.0f, 2600.0f}, {1.0f, 0.0f, 0.0f}, {{{-1.5f, 0.2f, 0.0f}, {0.0f, 0.0f, 0.0f}}, {{1.5f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}}};
static MicroimpactWall wall = {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};
static MicroimpactSpatialMotion in_space = {{0.3f, 0.4f, -2.8f}, {1e5f, -2e5f, 7e4f}}, after[2];
static const float EDGES[MICROIMPACT_TALLY_BINS] = {1, 2, 3, 4, 5, 6, 7, 8};
static char text[MICROIMPACT_LARGEST_TEXT];
static float number, another;
static MicroimpactMotion planar;
static MicroimpactFixedMotion fixed_motion;

static void nothing(void) {}
static void rigid_init(void) { MicroimpactRigidScene scene; microimpact_rigid_init(&body, &scene, &error); }
static void classify(void) { MicroimpactClassification c; microimpact_classify(&body, &motion, &c, &error); }
static void contact_init(void) { MicroimpactContactScene scene; microimpact_contact_init(&contact, &scene, &error); }
static void simulate(void) { MicroimpactContact c; size_t n; microimpact_simulate(&contact, &motion, 1, &c, 1, &n, &error); }
static void simulate_within(void) { MicroimpactContact c; size_t n; microimpact_simulate_within(&contact, 12u, &motion, 1, &c, 1, &n, &error); }
static void simulate_trajectory(void)
{
    static MicroimpactSample samples[MICROIMPACT_LARGEST_TRAJECTORY];
    static MicroimpactContact c;
    size_t n;
    microimpact_simulate_trajectory(&contact, &motion, samples, COUNT(samples), &n, &c, &error);
}
static void compliant_init(void) { MicroimpactCompliantScene scene; microimpact_compliant_init(&compliant, &scene, &error); }
static void simulate_compliant(void) { MicroimpactCompliantContact c; size_t n; microimpact_simulate_compliant(&compliant, &motion, 1, &c, 1, &n, &error); }
static void scene_init(void) { MicroimpactSceneConfig scene; microimpact_scene_init(&scenes[1], &scene, &error); }
static void scene_rigid(void) { microimpact_scene_classify(&scenes[0], &motion, &impact, &error); }
static void scene_contact(void) { microimpact_scene_classify(&scenes[1], &motion, &impact, &error); }
static void scene_fixed_cost(void) { microimpact_scene_classify(&scenes[2], &motion, &impact, &error); }
static void critical_rigid(void) { microimpact_scene_critical_speed(&scenes[0], &number, &error); }
static void critical_contact(void) { microimpact_scene_critical_speed(&scenes[1], &number, &error); }
static void critical_begin(void) { microimpact_critical_speed_begin(&scenes[1], &search, &error); }
static void critical_step(void)
{
    const MicroimpactStatus status = microimpact_critical_speed_step(&search, 1u, &number, &found, &error);
    remaining = status == MICROIMPACT_STATUS_OK && found == 0u;
}
static void probabilities_of(const MicroimpactSceneConfig *scene)
{
    static MicroimpactUncertainClass c;
    MicroimpactUncertainMotion m;
    memset(&m, 0, sizeof m);
    m.approach.value = motion.approach, m.approach.standard_error = 0.05f * motion.approach;
    m.tangential.value = motion.tangential, m.tangential.standard_error = 0.05f;
    m.peripheral.value = motion.peripheral, m.peripheral.standard_error = 0.05f;
    m.radius.value = 5.06e-6f, m.radius.standard_error = 0.1e-6f;
    microimpact_scene_probabilities(scene, &m, 0.9f, &c, &error);
}
static void probabilities_rigid(void) { probabilities_of(&scenes[0]); }
static void probabilities_contact(void) { probabilities_of(&scenes[1]); }
static void sphere_hollow(void) { MicroimpactSceneConfig s = scenes[0]; microimpact_sphere_hollow(5e-6f, 1e-6f, 2000.0f, &s, &error); }
static void sphere_coated(void) { MicroimpactSceneConfig s = scenes[0]; microimpact_sphere_coated(5e-6f, 1e-6f, 2000.0f, 9000.0f, &s, &error); }
static void fixed_init(void) { MicroimpactFixedBody made; microimpact_fixed_init(&body, 8.0f, &made, &error); }
static void fixed_classify(void)
{
    static MicroimpactFixedResult c;
    microimpact_fixed_classify(&fixed, &fixed_motion, &c, &error);
}
static void fixed_contact_init(void) { MicroimpactFixedContact made; microimpact_fixed_contact_init(&contact, 8.0f, &made, &error); }
static void fixed_simulate(void)
{
    static MicroimpactFixedImpact c;
    microimpact_fixed_simulate(&fixed_contact, &fixed_motion, &c, &error);
}
static void boundary_make(void) { microimpact_boundary_make(&contact, 2e-6f, cells, COUNT(cells), &boundary, &error); }
static void boundary_begin(void) { microimpact_boundary_begin(&contact, 2e-6f, cells, COUNT(cells), &boundary_maker, &error); }
static void boundary_step(void)
{
    if (microimpact_boundary_step(&boundary_maker, 1u, &boundary, &remaining, &error) != MICROIMPACT_STATUS_OK)
        remaining = 0u;
}
static void boundary_check(void) { microimpact_boundary_check(&boundary, &error); }
static void boundary_classify(void) { MicroimpactVerdict v; microimpact_boundary_classify(&boundary, 5.06e-6f, &motion, &v, &error); }
static void restitution_make(void) { microimpact_restitution_make(&contact, 2e-6f, 10.0f, &table, &error); }
static void restitution_begin(void) { microimpact_restitution_begin(&contact, 2e-6f, 10.0f, &restitution_maker, &error); }
static void restitution_step(void)
{
    if (microimpact_restitution_step(&restitution_maker, 1u, &table, &remaining, &error) != MICROIMPACT_STATUS_OK)
        remaining = 0u;
}
static void restitution_read(void) { MicroimpactTableReading r; microimpact_restitution_read(&table, 5.06e-6f, &motion, &r, &error); }
static void wall_incidence(void) { microimpact_wall_incidence(&wall, 5.06e-6f, &in_space, &planar, &error); }
static void wall_after(void) { microimpact_wall_after(&wall, 5.06e-6f, &in_space, 0.7f, 0.4f, after, &error); }
static void wall_sideways(void) { microimpact_wall_sideways(&wall, 5.06e-6f, &in_space, &number, &error); }
static void pair_incidence(void) { microimpact_pair_incidence(&pair, &number, &another, &planar, &error); }
static void pair_after(void) { microimpact_pair_after(&pair, 0.7f, 0.1f, after, &error); }
static void event_classify(void) { event.motion = motion, event.radius = 5e-6f; microimpact_event_classify(scenes, 1, &event, &impact, &error); }
static void queue_init(void) { microimpact_queue_init(&queue, events, COUNT(events)); }
static void queue_push(void) { microimpact_queue_push(&queue, &event); }
static void queue_pop(void) { microimpact_queue_pop(&queue, &event); }
static void queue_lost(void) { (void)microimpact_queue_lost(&queue); }
static void tally_init(void) { microimpact_tally_init(&tally, EDGES, &error); }
static void tally_record(void) { microimpact_tally_record(&tally, motion.approach, MICROIMPACT_STATUS_OK, &impact); }
static void tally_read(void) { static MicroimpactTallyReport r; microimpact_tally_read(&tally, &r); }
static void fit_restitution(void) { static MicroimpactFit f; microimpact_fit_restitution(measured, room, COUNT(measured), &f, &error); }
static void fit_damping(void) { microimpact_fit_material_damping(&contact, 13.0f, 0.909f, &number, &error); }
static void describe(void) { microimpact_describe(8, MICROIMPACT_FAULT_OTHER_LAW, text, sizeof text); }
static uint32_t parameter;
static void name(void) { microimpact_parameter_name(parameter, text, sizeof text); }
static void unit(void) { microimpact_parameter_unit(parameter, text, sizeof text); }
static void version(void) { (void)microimpact_version(); }
static void abi(void) { (void)microimpact_abi(); }
static void layout(void) { (void)microimpact_layout(); }

/* For each motion; until the table is complete or the speed is found; for each impact of the shared grid; or for each parameter. */
#define EACH 1
#define STEPS 2
#define SHARED 3
#define NUMBERED 4

static const struct {
    const char *name;
    void (*call)(void);
    int each; /* whether it runs once, or as often as above */
} FUNCTIONS[] = {
    {"rigid_init", rigid_init, 0}, {"classify", classify, 1}, {"contact_init", contact_init, 0}, {"simulate", simulate, 1},
    {"simulate_trajectory", simulate_trajectory, 1}, {"compliant_init", compliant_init, 0}, {"simulate_compliant", simulate_compliant, 1},
    {"scene_init", scene_init, 0}, {"scene_classify, rigid body", scene_rigid, 1}, {"scene_classify, tolerance", scene_contact, 1},
    {"scene_classify, 3 iterations", scene_fixed_cost, 1}, {"scene_critical_speed, rigid body", critical_rigid, 0},
    {"scene_critical_speed, contact", critical_contact, 0},
    {"critical_speed_begin", critical_begin, 0}, {"critical_speed_step, a trial", critical_step, STEPS}, {"scene_probabilities, rigid body", probabilities_rigid, 1},
    {"scene_probabilities, contact", probabilities_contact, 0}, {"sphere_hollow", sphere_hollow, 0}, {"sphere_coated", sphere_coated, 0},
    {"fixed_init", fixed_init, 0}, {"fixed_classify", fixed_classify, 1},
    {"fixed_contact_init", fixed_contact_init, 0}, {"fixed_simulate", fixed_simulate, 1}, {"boundary_make, 12 cells", boundary_make, 0},
    {"boundary_begin, 12 cells", boundary_begin, 0}, {"boundary_step, a critical speed of 12 cells", boundary_step, STEPS},
    {"boundary_check, 12 cells", boundary_check, 0}, {"boundary_classify", boundary_classify, 1}, {"restitution_make", restitution_make, 0},
    {"restitution_begin", restitution_begin, 0}, {"restitution_step, a critical speed or a simulation", restitution_step, STEPS},
    {"restitution_read", restitution_read, 1}, {"wall_incidence", wall_incidence, 0}, {"wall_after", wall_after, 0},
    {"wall_sideways", wall_sideways, 0}, {"pair_incidence", pair_incidence, 0}, {"pair_after", pair_after, 0},
    {"event_classify, rigid body", event_classify, 1}, {"simulate, the shared grid", simulate, SHARED},
    {"simulate_within, 12 intervals on the shared grid", simulate_within, SHARED},
    {"scene_classify, tolerance on the shared grid", scene_contact, SHARED},
    {"scene_classify, 3 iterations on the shared grid", scene_fixed_cost, SHARED}, {"queue_init", queue_init, 0}, {"queue_push", queue_push, 0},
    {"queue_pop", queue_pop, 0}, {"queue_lost", queue_lost, 0}, {"tally_init", tally_init, 0}, {"tally_record", tally_record, 1},
    {"tally_read", tally_read, 0}, {"fit_restitution, 30 impacts", fit_restitution, 0}, {"fit_material_damping", fit_damping, 0},
    {"describe", describe, 0}, {"parameter_name", name, NUMBERED}, {"parameter_unit", unit, NUMBERED},
    {"version", version, 0}, {"abi", abi, 0}, {"layout", layout, 0},
};

/* The motions of the scene of the paper. */
static const float SPEEDS[] = {0.1f, 0.5f, 1.2f, 1.4f, 1.42f, 1.8f, 2.8f, 8.0f, 30.0f}, ALONG[] = {0.0f, 1.0f, 20.0f, -3.0f};

/* Sets the motion, in integers too: the unit of speed is 8 m/s. */
static void move(float approach, float tangential)
{
    motion.approach = approach, motion.tangential = tangential, motion.peripheral = 0.7f;
    fixed_motion.approach = (int32_t)(approach / 8.0f * (float)MICROIMPACT_FIXED_ONE);
    fixed_motion.tangential = (int32_t)(tangential / 8.0f * (float)MICROIMPACT_FIXED_ONE);
    fixed_motion.peripheral = (int32_t)(0.7f / 8.0f * (float)MICROIMPACT_FIXED_ONE);
}

static void prepare(void)
{
    size_t i;
    memset(&contact, 0, sizeof contact);
    contact.radius = 5.06e-6f, contact.density = 2600.0f, contact.stiffness = 7.5e10f, contact.material_damping = 10.5f;
    contact.adhesion_strength = 250.0f, contact.adhesion_damping = 6.25f, contact.friction = 0.1f, contact.tolerance = 1e-6f;
    memset(&compliant, 0, sizeof compliant);
    compliant.contact = contact, compliant.contact.adhesion_strength = compliant.contact.adhesion_damping = 0.0f;
    compliant.stiffness_ratio = 0.85f;
    memset(scenes, 0, sizeof scenes);
    for (i = 0; i < COUNT(scenes); i++) {
        scenes[i].radius = 5.06e-6f, scenes[i].density = 2600.0f, scenes[i].friction = 0.1f, scenes[i].gyration_ratio = 0.4f;
        scenes[i].restitution_law = MICROIMPACT_RESTITUTION_LAW_SPEED, scenes[i].restitution_speed = 130.0f;
        scenes[i].rebound_adhesion = MICROIMPACT_REBOUND_ADHESION_WORK, scenes[i].work_of_adhesion = 2.22e-12f;
        scenes[i].model = i > 0 ? MICROIMPACT_MODEL_CONTACT : MICROIMPACT_MODEL_RIGID_BODY;
        scenes[i].stiffness = 7.5e10f, scenes[i].damping = MICROIMPACT_DAMPING_HYSTERETIC, scenes[i].material_damping = 10.5f;
        scenes[i].adhesion = MICROIMPACT_ADHESION_RING, scenes[i].adhesion_strength = 250.0f, scenes[i].adhesion_damping = 6.25f;
        scenes[i].tolerance = 1e-6f;
    }
    scenes[2].iterations = 3;
    for (i = 0; i < COUNT(measured); i++) {
        const float speed = 2.0f + 0.5f * (float)i;
        measured[i].radius = 5.06e-6f, measured[i].density = 2600.0f, measured[i].approach.value = speed;
        measured[i].rebound.value = speed * 130.0f / (130.0f + speed) - 1.5f / speed + (i % 3 == 0 ? 0.05f : -0.02f);
    }
    microimpact_fixed_init(&body, 8.0f, &fixed, NULL);
    microimpact_fixed_contact_init(&contact, 8.0f, &fixed_contact, NULL);
    move(2.8f, 1.0f);
}

/* Takes over an impact of the shared grid, at 45 degrees. */
static void take(const float *impact)
{
    size_t i;
    contact.radius = impact[0], contact.stiffness = impact[1], contact.material_damping = impact[3];
    contact.adhesion_strength = impact[4], contact.adhesion_damping = impact[5], contact.friction = 0.3f;
    for (i = 1; i < COUNT(scenes); i++) {
        scenes[i].radius = impact[0], scenes[i].stiffness = impact[1], scenes[i].material_damping = impact[3];
        scenes[i].adhesion_strength = impact[4], scenes[i].adhesion_damping = impact[5], scenes[i].friction = 0.3f;
    }
    motion.approach = motion.tangential = impact[2], motion.peripheral = 0.0f;
}

/* Ticks and stack of a call. Not inlined, so that every call has the same frame around it. */
__attribute__((noinline)) static uint64_t ticks_of(void (*call)(void), uint32_t *stack)
{
    uint32_t pointer, bottom, last, done;
    volatile uint32_t *word;
    __asm__ volatile("mov %0, sp" : "=r"(pointer));
    bottom = (pointer - PAINTED) & ~3u;
    for (word = (volatile uint32_t *)(uintptr_t)bottom; (uintptr_t)word < pointer - SPARED; word++)
        *word = PAINT;
    rounds = 0u;
    TIMER[2] = 0u;
    call();
    do {
        done = rounds;
        last = TIMER[2];
    } while (done != rounds);
    for (word = (volatile uint32_t *)(uintptr_t)bottom; *word == PAINT; word++) {
    }
    *stack = pointer - (uint32_t)(uintptr_t)word;
    return (uint64_t)done * (LARGEST + 1u) + LARGEST - last;
}

/* A million turns of a loop of two instructions show how many ticks an instruction takes. */
static void calibration(void)
{
    uint32_t turns = 1000000u;
    __asm__ volatile("1: subs %0, %0, #1\n\tbne 1b" : "+r"(turns) : : "cc");
}

int main(void)
{
    uint32_t stack, least;
    uint64_t per_million, empty;
    size_t i, j, parameters = 0u;
    while (microimpact_parameter_name((uint32_t)parameters, NULL, 0u) > 0u)
        parameters++;
    prepare();
    TIMER[1] = LARGEST;
    TIMER[2] = 0u;
    TIMER[0] = RUNNING;
    empty = ticks_of(nothing, &least);
    per_million = (ticks_of(calibration, &stack) - empty) / 2u;
    if (per_million < 2000000u)
        return 1; /* the timer does not follow the instructions */
    for (i = 0; i < COUNT(FUNCTIONS); i++) {
        const size_t runs[] = {1u, COUNT(SPEEDS) * COUNT(ALONG), 1u, COUNT(GRID), parameters};
        uint64_t most = 0u;
        uint32_t deepest = 0u;
        for (j = 0; j < runs[FUNCTIONS[i].each]; j++) {
            if (FUNCTIONS[i].each == EACH)
                move(SPEEDS[j / COUNT(ALONG)], ALONG[j % COUNT(ALONG)]);
            if (FUNCTIONS[i].each == SHARED)
                take(GRID[j]);
            if (FUNCTIONS[i].each == NUMBERED)
                parameter = (uint32_t)j;
            do {
                const uint64_t ticks = ticks_of(FUNCTIONS[i].call, &stack);
                most = ticks > most ? ticks : most;
                deepest = stack > deepest ? stack : deepest;
            } while (FUNCTIONS[i].each == STEPS && remaining > 0u);
        }
        most = most > empty ? most - empty : 0u;
        prepare();
        printf("%s;%lu;%lu\n", FUNCTIONS[i].name, (unsigned long)((most * 1000000u + per_million / 2u) / per_million), (unsigned long)deepest);
        fflush(stdout);
    }
    return 0;
}
