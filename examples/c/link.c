/* Reads the frames of an instrument from standard input, and says what is in them: one line for each frame. With the argument
   "requests", it writes the requests of the documentation instead, one in each line, as hexadecimal numbers; with "repeat-requests" and
   "repeat-replies" it reads those, and writes each again; with "scenes" it says what is in the scenes that a host sets. */

#include <stdio.h>
#include <string.h>

#include "microimpact_instrument_link.h"

static const MicroimpactLinkSchema EXPECTED = {MICROIMPACT_LINK_F32, MICROIMPACT_LINK_PLANAR, MICROIMPACT_LINK_FRICTION};

static void show(const MicroimpactLinkReply *reply)
{
    size_t i;
    printf("%d %lu", reply->kind, (unsigned long)reply->number);
    switch (reply->kind) {
    case MICROIMPACT_LINK_STARTED:
    case MICROIMPACT_LINK_DESCRIPTION:
        printf(" version %lu schema %u %u %u", (unsigned long)reply->protocol, (unsigned)reply->schema.number,
               (unsigned)reply->schema.reading, (unsigned)reply->schema.classes);
        break;
    case MICROIMPACT_LINK_CLASSIFIED:
        printf(" class %u", (unsigned)reply->impact_class);
        if (reply->has_restitution)
            printf(" e %.6g", reply->restitution);
        break;
    case MICROIMPACT_LINK_REJECTED:
    case MICROIMPACT_LINK_REFUSED:
        if (reply->unsolved)
            printf(" without");
        else
            printf(" parameter %lu fault %lu value %.6g", (unsigned long)reply->parameter, (unsigned long)reply->fault, (double)reply->value);
        break;
    case MICROIMPACT_LINK_REPORT_IS:
        for (i = 0; i < MICROIMPACT_LINK_REPORT; i++)
            printf(" %lu", (unsigned long)reply->report[i]);
        break;
    case MICROIMPACT_LINK_COUNTS:
    case MICROIMPACT_LINK_RESET:
        for (i = 0; i < reply->count; i++)
            printf(" %lu", (unsigned long)reply->counts[i]);
        break;
    default:
        break;
    }
    printf("\n");
}

static void write_frame(const uint8_t *frame, size_t length)
{
    size_t i;
    for (i = 0; i < length; i++)
        printf("%s%02x", i > 0 ? " " : "", (unsigned)frame[i]);
    printf("\n");
}

static void requests(void)
{
    uint8_t frame[MICROIMPACT_LINK_FRAME];
    MicroimpactLinkReading reading;
    memset(&reading, 0, sizeof reading);
    reading.approach = 2.8, reading.peripheral = 0.739;
    write_frame(frame, microimpact_link_event(&EXPECTED, 1, &reading, frame, sizeof frame));
    write_frame(frame, microimpact_link_request(MICROIMPACT_LINK_ASK_REPORT, 300, frame, sizeof frame));
    write_frame(frame, microimpact_link_request(MICROIMPACT_LINK_DESCRIBE, 2, frame, sizeof frame));
    write_frame(frame, microimpact_link_request(MICROIMPACT_LINK_ASK_COUNTS, 3, frame, sizeof frame));
    write_frame(frame, microimpact_link_request(MICROIMPACT_LINK_ASK_RESET, 4, frame, sizeof frame));
}

/* The numbers of a scene that are not zero. */
static void show_scene(const MicroimpactSceneConfig *scene)
{
#define SHOW(field) \
    if (scene->field != 0) \
        printf(#field "=%.6g ", (double)scene->field);
    SHOW(radius) SHOW(density) SHOW(gyration_ratio) SHOW(friction) SHOW(model) SHOW(restitution_law) SHOW(restitution)
    SHOW(restitution_speed) SHOW(restitution_power) SHOW(yield_speed) SHOW(rebound_adhesion) SHOW(adhesion_coefficient)
    SHOW(work_of_adhesion) SHOW(adhesion_speed) SHOW(adhesion_power) SHOW(stiffness) SHOW(relaxation_time) SHOW(damping)
    SHOW(material_damping) SHOW(nominal_restitution) SHOW(adhesion) SHOW(adhesion_strength) SHOW(adhesion_damping)
    SHOW(adhesion_energy) SHOW(external_force)
#undef SHOW
    printf("\n");
}

static void scene(const MicroimpactLinkDecoder *decoder)
{
    MicroimpactLinkRequest request;
    if (microimpact_link_read_request(decoder, &EXPECTED, &request) == MICROIMPACT_LINK_MESSAGE_IN)
        show_scene(&request.scene);
}

/* Reads the message in a decoder and writes it again. */
static void repeat(const MicroimpactLinkDecoder *decoder, int are_requests)
{
    uint8_t frame[MICROIMPACT_LINK_FRAME];
    MicroimpactLinkRequest request;
    MicroimpactLinkReply reply;
    size_t length = 0;
    if (are_requests && microimpact_link_read_request(decoder, &EXPECTED, &request) == MICROIMPACT_LINK_MESSAGE_IN) {
        if (request.kind == MICROIMPACT_LINK_EVENT)
            length = microimpact_link_event(&EXPECTED, request.number, &request.reading, frame, sizeof frame);
        else if (request.kind == MICROIMPACT_LINK_CONFIGURE)
            length = microimpact_link_configure(&EXPECTED, request.number, &request.scene, frame, sizeof frame);
        else
            length = microimpact_link_request(request.kind, request.number, frame, sizeof frame);
    } else if (!are_requests && microimpact_link_reply(decoder, &EXPECTED, &reply) == MICROIMPACT_LINK_MESSAGE_IN) {
        length = microimpact_link_write_reply(&EXPECTED, &reply, frame, sizeof frame);
    }
    write_frame(frame, length);
}

int main(int count, char **arguments)
{
    static const char *const FAULTS[] = {"", "", "oversized", "stuffing", "checksum", "content", "schema"};
    MicroimpactLinkDecoder decoder;
    MicroimpactLinkReply reply;
    int byte;
    if (count > 1 && strcmp(arguments[1], "requests") == 0) {
        requests();
        return 0;
    }
    memset(&decoder, 0, sizeof decoder);
    if (count > 1) {
        while ((byte = getchar()) != EOF) {
            if (microimpact_link_take(&decoder, (uint8_t)byte) != MICROIMPACT_LINK_MESSAGE_IN)
                continue;
            if (strcmp(arguments[1], "scenes") == 0)
                scene(&decoder);
            else
                repeat(&decoder, strcmp(arguments[1], "repeat-requests") == 0);
        }
        return 0;
    }
    while ((byte = getchar()) != EOF) {
        int state = microimpact_link_take(&decoder, (uint8_t)byte);
        if (state == MICROIMPACT_LINK_MESSAGE_IN)
            state = microimpact_link_reply(&decoder, &EXPECTED, &reply);
        if (state == MICROIMPACT_LINK_MESSAGE_IN)
            show(&reply);
        else if (state != MICROIMPACT_LINK_WAITS)
            printf("%s\n", FAULTS[state]);
    }
    return 0;
}
