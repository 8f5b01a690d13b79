/* Misuse of every function, on a host, under the sanitizers of addresses and of undefined behaviour. With an argument, misuse
   that the library cannot recognise and the sanitizer must. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "microimpact.h"

#undef NDEBUG
#include <assert.h>

static const MicroimpactRigidScene BODY = {5.06e-6f, 2600.0f, 130.0f, 2.22e-12f, 0.1f};
static const MicroimpactContactScene CONTACT = {5.06e-6f, 2600.0f, 7.5e10f, 10.5f, 250.0f, 6.25f, 0.1f, 1e-6f};
static const MicroimpactMotion MOTION = {2.8f, 1.0f, 0.0f};

/* A copy on the heap, where the sanitizer watches its bounds. */
static void *copy(const void *original, size_t size)
{
    void *block = malloc(size);
    assert(block);
    return memcpy(block, original, size);
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
    classify();
    simulate();
    parameter_names();
    return 0;
}
