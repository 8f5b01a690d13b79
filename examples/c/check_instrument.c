/* Events, the queue, the tally and the frames of an instrument, on a host, under the sanitizers. */

/* Signals and timers, beside C11. */
#define _DEFAULT_SOURCE

#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/time.h>

#include "microimpact.h"
#include "microimpact_link.h"
#include "microimpact_instrument_link.h"

#undef NDEBUG
#include <assert.h>

static MicroimpactSceneConfig scene_of(float work)
{
    MicroimpactSceneConfig scene;
    memset(&scene, 0, sizeof scene);
    scene.radius = 5.06e-6f, scene.density = 2600.0f, scene.friction = 0.1f, scene.restitution = 0.9f;
    scene.rebound_adhesion = MICROIMPACT_REBOUND_ADHESION_WORK, scene.work_of_adhesion = work;
    assert(microimpact_scene_init(&scene, &scene, NULL) == MICROIMPACT_STATUS_OK);
    return scene;
}

static MicroimpactEvent numbered(uint32_t number)
{
    MicroimpactEvent event;
    memset(&event, 0, sizeof event);
    event.ticks = event.material = number, event.radius = (float)number, event.motion.approach = (float)number;
    return event;
}

/* In order, round and round, full and empty. */
static void first_in_first_out(void)
{
    for (uint32_t capacity = 1; capacity < 6; capacity++) {
        MicroimpactEvent room[5], event;
        MicroimpactQueue queue;
        uint32_t sent = 0, taken = 0, lost = 0;
        assert(microimpact_queue_init(&queue, room, capacity) == MICROIMPACT_STATUS_OK);
        assert(microimpact_queue_pop(&queue, &event) == MICROIMPACT_STATUS_CAPACITY);
        for (uint32_t turn = 0; turn < 200; turn++) {
            for (uint32_t i = 0; i < turn % 7; i++) {
                event = numbered(sent);
                if (microimpact_queue_push(&queue, &event) == MICROIMPACT_STATUS_OK)
                    sent++;
                else
                    assert(sent - taken == capacity && microimpact_queue_lost(&queue) == ++lost);
            }
            for (uint32_t i = 0; i < turn % 5; i++) {
                if (microimpact_queue_pop(&queue, &event) == MICROIMPACT_STATUS_OK)
                    assert(event.ticks == taken && event.motion.approach == (float)taken++);
                else
                    assert(sent == taken);
            }
        }
        assert(sent > 100 && lost > 0);
    }
}

static MicroimpactQueue shared;
static volatile uint32_t rung;

static void ring(int number)
{
    (void)number;
    MicroimpactEvent event = numbered(rung);
    if (microimpact_queue_push(&shared, &event) == MICROIMPACT_STATUS_OK)
        rung++;
}

/* A signal stands for the interrupt: it comes between any two instructions of the main loop. */
static void from_an_interrupt(void)
{
    static MicroimpactEvent room[3];
    const struct itimerval often = {{0, 50}, {0, 50}}, never = {{0, 0}, {0, 0}};
    MicroimpactEvent event;
    uint32_t taken = 0;
    assert(microimpact_queue_init(&shared, room, 3) == MICROIMPACT_STATUS_OK);
    signal(SIGALRM, ring);
    setitimer(ITIMER_REAL, &often, NULL);
    while (taken < 2000) {
        if (microimpact_queue_pop(&shared, &event) == MICROIMPACT_STATUS_OK) {
            assert(event.ticks == taken && event.material == taken && event.motion.approach == (float)taken);
            taken++;
        }
    }
    setitimer(ITIMER_REAL, &never, NULL);
    signal(SIGALRM, SIG_IGN);
}

static void misuse_of_the_queue(void)
{
    MicroimpactEvent room[2], event = numbered(1);
    MicroimpactQueue queue;
    assert(microimpact_queue_init(&queue, room, 0) == MICROIMPACT_STATUS_CAPACITY);
    assert(microimpact_queue_init(&queue, room, (size_t)-1) == MICROIMPACT_STATUS_CAPACITY);
    assert(microimpact_queue_init(&queue, NULL, 2) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_queue_init(NULL, room, 2) == MICROIMPACT_STATUS_POINTER);
    memset(&queue, 0, sizeof queue);
    assert(microimpact_queue_push(&queue, &event) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_queue_pop(&queue, &event) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_queue_push(NULL, &event) == MICROIMPACT_STATUS_POINTER && microimpact_queue_lost(NULL) == 0);
    assert(microimpact_queue_init(&queue, room, 2) == MICROIMPACT_STATUS_OK);
    assert(microimpact_queue_push(&queue, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_queue_pop(&queue, NULL) == MICROIMPACT_STATUS_POINTER);
    /* Places that cannot be do not lead out of the room. */
    queue.first = 7;
    assert(microimpact_queue_push(&queue, &event) == MICROIMPACT_STATUS_UNMADE);
    assert(microimpact_queue_pop(&queue, &event) == MICROIMPACT_STATUS_UNMADE);
    queue.first = 0, queue.end = 3;
    assert(microimpact_queue_pop(&queue, &event) == MICROIMPACT_STATUS_UNMADE);
}

/* A small sphere is held where a large one rebounds, and each material by its own adhesion. */
static void sized_events(void)
{
    const MicroimpactSceneConfig materials[] = {scene_of(0.0f), scene_of(2.22e-12f)};
    MicroimpactEvent event;
    MicroimpactSceneImpact impact;
    MicroimpactError error;
    memset(&event, 0, sizeof event);
    event.motion.approach = 2.8f, event.material = 1;
    assert(microimpact_event_classify(materials, 2, &event, &impact, &error) == MICROIMPACT_STATUS_OK && impact.restitution > 0.5f);
    event.radius = 2e-6f;
    assert(microimpact_event_classify(materials, 2, &event, &impact, &error) == MICROIMPACT_STATUS_OK && impact.restitution == 0.0f);
    event.material = 0;
    assert(microimpact_event_classify(materials, 2, &event, &impact, &error) == MICROIMPACT_STATUS_OK && fabsf(impact.restitution - 0.9f) < 1e-6f);
    event.material = 2;
    assert(microimpact_event_classify(materials, 2, &event, &impact, &error) == MICROIMPACT_STATUS_INPUT);
    assert(error.fault == MICROIMPACT_FAULT_NOT_IN_TABLE && error.value == 2.0 && error.largest == 1.0);
    event.material = 0, event.radius = -1.0f;
    assert(microimpact_event_classify(materials, 2, &event, &impact, &error) == MICROIMPACT_STATUS_INPUT && error.parameter == 0);
    assert(microimpact_event_classify(NULL, 2, &event, &impact, &error) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_event_classify(materials, 2, NULL, &impact, &error) == MICROIMPACT_STATUS_POINTER);
}

static void counts(void)
{
    const float edges[8] = {1, 2, 3, 4, 5, 6, 7, 8}, falling[8] = {1, 2, 3, 4, 5, 4, 7, 8};
    MicroimpactTally tally;
    MicroimpactTallyReport report;
    MicroimpactSceneImpact impact = {MICROIMPACT_CLASS_REBOUND_ROLLING, 0.5f, 0.0f, 0.0f};
    MicroimpactError error;
    memset(&tally, 0, sizeof tally);
    assert(microimpact_tally_read(&tally, &report) == MICROIMPACT_STATUS_UNMADE);
    assert(microimpact_tally_record(&tally, 1.5f, MICROIMPACT_STATUS_OK, &impact) == MICROIMPACT_STATUS_UNMADE);
    assert(microimpact_tally_init(&tally, falling, &error) == MICROIMPACT_STATUS_INPUT && error.fault == MICROIMPACT_FAULT_OUT_OF_ORDER);
    assert(microimpact_tally_init(&tally, edges, &error) == MICROIMPACT_STATUS_OK);
    for (int i = 0; i < 4; i++) {
        impact.restitution = 0.5f + 0.1f * (float)i;
        assert(microimpact_tally_record(&tally, 1.5f, MICROIMPACT_STATUS_OK, &impact) == MICROIMPACT_STATUS_OK);
    }
    impact.impact_class = MICROIMPACT_CLASS_CAPTURED_RESTING, impact.restitution = 0.0f;
    assert(microimpact_tally_record(&tally, 0.5f, MICROIMPACT_STATUS_OK, &impact) == MICROIMPACT_STATUS_OK);
    impact.impact_class = MICROIMPACT_CLASS_REBOUND_SLIDING, impact.restitution = 0.9f;
    assert(microimpact_tally_record(&tally, 80.0f, MICROIMPACT_STATUS_OK, &impact) == MICROIMPACT_STATUS_OK);
    assert(microimpact_tally_record(&tally, 80.0f, MICROIMPACT_STATUS_INPUT, NULL) == MICROIMPACT_STATUS_OK);
    assert(microimpact_tally_record(&tally, 80.0f, MICROIMPACT_STATUS_UNSOLVED, NULL) == MICROIMPACT_STATUS_OK);
    /* What is no class, or no impact, is not counted. */
    impact.impact_class = 6;
    assert(microimpact_tally_record(&tally, 1.5f, MICROIMPACT_STATUS_OK, &impact) == MICROIMPACT_STATUS_CHOICE);
    impact.impact_class = MICROIMPACT_CLASS_REBOUND_SLIDING, impact.restitution = 1.5f;
    assert(microimpact_tally_record(&tally, 1.5f, MICROIMPACT_STATUS_OK, &impact) == MICROIMPACT_STATUS_INPUT);
    impact.restitution = NAN;
    assert(microimpact_tally_record(&tally, 1.5f, MICROIMPACT_STATUS_OK, &impact) == MICROIMPACT_STATUS_INPUT);
    impact.restitution = 0.9f;
    assert(microimpact_tally_record(&tally, -1.5f, MICROIMPACT_STATUS_OK, &impact) == MICROIMPACT_STATUS_INPUT);
    assert(microimpact_tally_record(&tally, 1.5f, MICROIMPACT_STATUS_OK, NULL) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_tally_record(NULL, 1.5f, MICROIMPACT_STATUS_OK, &impact) == MICROIMPACT_STATUS_POINTER);
    assert(microimpact_tally_read(&tally, &report) == MICROIMPACT_STATUS_OK);
    assert(report.classes[0] == 1 && report.classes[1] == 4 && report.classes[4] == 1 && report.classes[5] == 0);
    assert(report.refused == 1 && report.unsolved == 1 && report.rebounds[1] == 4 && report.rebounds[8] == 1);
    /* The variance of 0.5, 0.6, 0.7 and 0.8 is 0.05/3. */
    assert(fabsf(report.mean[1] - 0.65f) < 1e-6f && fabsf(report.variance[1] - 0.05f / 3.0f) < 1e-6f);
    assert(report.mean[0] == 0.0f && report.variance[0] < 0.0f && report.variance[8] < 0.0f && report.edges[7] == 8.0f);
    assert(microimpact_tally_read(&tally, NULL) == MICROIMPACT_STATUS_POINTER);
}

/* A scene is written in a type of numbers that there is, or not at all. */
static void types_of_numbers(void)
{
    const MicroimpactSceneConfig scene = scene_of(0.0f);
    uint8_t frame[MICROIMPACT_LINK_FRAME];
    for (uint8_t number = 0; number < 5; number++) {
        const MicroimpactLinkSchema schema = {number, MICROIMPACT_LINK_PLANAR, MICROIMPACT_LINK_FRICTION};
        const size_t length = microimpact_link_configure(&schema, 1, &scene, frame, sizeof frame);
        assert((length > 0) == (number == MICROIMPACT_LINK_F32 || number == MICROIMPACT_LINK_F64));
    }
}

int main(void)
{
    first_in_first_out();
    from_an_interrupt();
    misuse_of_the_queue();
    sized_events();
    counts();
    types_of_numbers();
    return 0;
}
