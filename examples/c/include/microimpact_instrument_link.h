/* The other side of the serial protocol, in plain C90: an instrument that reads requests and writes replies, and a host that sets a
   scene. It needs the types of microimpact.h, but no function of the library. */

#ifndef MICROIMPACT_INSTRUMENT_LINK_H
#define MICROIMPACT_INSTRUMENT_LINK_H

#include "microimpact.h"
#include "microimpact_link.h"

/* A request; what its kind does not have is zero. */
typedef struct MicroimpactLinkRequest {
    int kind;
    uint32_t number;
    MicroimpactLinkReading reading; /* of EVENT */
    MicroimpactSceneConfig scene;   /* of CONFIGURE; nothing of it is checked: see microimpact_scene_init */
} MicroimpactLinkRequest;

/* Most numbers of a term. */
#define MICROIMPACT_LINK_TERM 2u

/* The fields of a term of a scene that the protocol has for a choice, in its order; null behind the last one. */
typedef struct MicroimpactLinkTerm {
    float *fields[MICROIMPACT_LINK_TERM];
} MicroimpactLinkTerm;

MICROIMPACT_LINK_FUNCTION MicroimpactLinkTerm microimpact_link_term(float *first, float *second)
{
    MicroimpactLinkTerm term;
    term.fields[0] = first;
    term.fields[1] = second;
    return term;
}

MICROIMPACT_LINK_FUNCTION MicroimpactLinkTerm microimpact_link_restitution(MicroimpactSceneConfig *scene)
{
    MicroimpactLinkTerm term;
    term = microimpact_link_term(NULL, NULL);
    switch (scene->restitution_law) {
    case MICROIMPACT_RESTITUTION_LAW_CONSTANT:
        term = microimpact_link_term(&scene->restitution, NULL);
        break;
    case MICROIMPACT_RESTITUTION_LAW_SPEED:
        term = microimpact_link_term(&scene->restitution_speed, NULL);
        break;
    case MICROIMPACT_RESTITUTION_LAW_POWER:
        term = microimpact_link_term(&scene->restitution_speed, &scene->restitution_power);
        break;
    case MICROIMPACT_RESTITUTION_LAW_ELASTIC_PLASTIC:
        term = microimpact_link_term(&scene->yield_speed, NULL);
        break;
    case MICROIMPACT_RESTITUTION_LAW_VISCOELASTIC:
        term = microimpact_link_term(&scene->stiffness, &scene->relaxation_time);
        break;
    default:
        /* Not known. */
        break;
    }
    return term;
}

MICROIMPACT_LINK_FUNCTION MicroimpactLinkTerm microimpact_link_rebound_adhesion(MicroimpactSceneConfig *scene)
{
    MicroimpactLinkTerm term;
    term = microimpact_link_term(NULL, NULL);
    switch (scene->rebound_adhesion) {
    case MICROIMPACT_REBOUND_ADHESION_COEFFICIENT:
        term = microimpact_link_term(&scene->adhesion_coefficient, NULL);
        break;
    case MICROIMPACT_REBOUND_ADHESION_WORK:
        term = microimpact_link_term(&scene->work_of_adhesion, NULL);
        break;
    case MICROIMPACT_REBOUND_ADHESION_SPEED:
        term = microimpact_link_term(&scene->adhesion_speed, &scene->adhesion_power);
        break;
    default:
        /* None. */
        break;
    }
    return term;
}

MICROIMPACT_LINK_FUNCTION MicroimpactLinkTerm microimpact_link_damping(MicroimpactSceneConfig *scene)
{
    MicroimpactLinkTerm term;
    term = microimpact_link_term(NULL, NULL);
    switch (scene->damping) {
    case MICROIMPACT_DAMPING_HYSTERETIC:
        term = microimpact_link_term(&scene->material_damping, NULL);
        break;
    case MICROIMPACT_DAMPING_VISCOELASTIC:
        term = microimpact_link_term(&scene->relaxation_time, NULL);
        break;
    case MICROIMPACT_DAMPING_CONSTANT:
        term = microimpact_link_term(&scene->nominal_restitution, NULL);
        break;
    default:
        /* None. */
        break;
    }
    return term;
}

MICROIMPACT_LINK_FUNCTION MicroimpactLinkTerm microimpact_link_adhesion(MicroimpactSceneConfig *scene)
{
    MicroimpactLinkTerm term;
    term = microimpact_link_term(NULL, NULL);
    switch (scene->adhesion) {
    case MICROIMPACT_ADHESION_RING:
        term = microimpact_link_term(&scene->adhesion_strength, &scene->adhesion_damping);
        break;
    case MICROIMPACT_ADHESION_DMT:
    case MICROIMPACT_ADHESION_JKR_SNAP_OFF:
    case MICROIMPACT_ADHESION_JKR_PULL_OFF:
        term = microimpact_link_term(&scene->adhesion_energy, NULL);
        break;
    default:
        /* None. */
        break;
    }
    return term;
}

/* Reads a choice below `choices`. */
MICROIMPACT_LINK_FUNCTION uint32_t microimpact_link_chosen(MicroimpactLinkCursor *in, uint32_t choices)
{
    const uint32_t choice = (uint32_t)microimpact_link_integer(in, 32u);
    if (choice >= choices) {
        in->good = 0;
    }
    return choice;
}

MICROIMPACT_LINK_FUNCTION void microimpact_link_read_term(MicroimpactLinkCursor *in, uint8_t type, MicroimpactLinkTerm term)
{
    size_t i;
    for (i = 0u; i < MICROIMPACT_LINK_TERM; i++) {
        if (term.fields[i] != NULL) {
            *term.fields[i] = (float)microimpact_link_number(in, type);
        }
    }
}

MICROIMPACT_LINK_FUNCTION void microimpact_link_put_term(MicroimpactLinkCursor *out, uint8_t type, uint32_t choice, MicroimpactLinkTerm term)
{
    size_t i;
    microimpact_link_put_integer(out, choice);
    for (i = 0u; i < MICROIMPACT_LINK_TERM; i++) {
        if (term.fields[i] != NULL) {
            microimpact_link_put_number(out, type, (double)*term.fields[i]);
        }
    }
}

MICROIMPACT_LINK_FUNCTION void microimpact_link_read_scene(MicroimpactLinkCursor *in, uint8_t type, MicroimpactSceneConfig *scene)
{
    scene->radius = (float)microimpact_link_number(in, type);
    scene->density = (float)microimpact_link_number(in, type);
    scene->gyration_ratio = (float)microimpact_link_number(in, type);
    scene->friction = (float)microimpact_link_number(in, type);
    scene->model = microimpact_link_chosen(in, 2u);
    if (scene->model == (uint32_t)MICROIMPACT_MODEL_RIGID_BODY) {
        scene->restitution_law = microimpact_link_chosen(in, 5u);
        microimpact_link_read_term(in, type, microimpact_link_restitution(scene));
        scene->rebound_adhesion = microimpact_link_chosen(in, 4u);
        microimpact_link_read_term(in, type, microimpact_link_rebound_adhesion(scene));
    } else {
        scene->stiffness = (float)microimpact_link_number(in, type);
        scene->damping = microimpact_link_chosen(in, 4u);
        microimpact_link_read_term(in, type, microimpact_link_damping(scene));
        scene->adhesion = microimpact_link_chosen(in, 5u);
        microimpact_link_read_term(in, type, microimpact_link_adhesion(scene));
        if (scene->adhesion == (uint32_t)MICROIMPACT_ADHESION_JKR_SNAP_OFF) {
            /* Where contact ends is a choice of its own in the protocol. */
            scene->adhesion += microimpact_link_chosen(in, 2u);
        }
        scene->external_force = (float)microimpact_link_number(in, type);
    }
}

/* Reads the request in a decoder after MICROIMPACT_LINK_MESSAGE_IN, for an instrument of a schema: MICROIMPACT_LINK_MESSAGE_IN, or
   MICROIMPACT_LINK_CONTENT where it is none. */
MICROIMPACT_LINK_FUNCTION int microimpact_link_read_request(const MicroimpactLinkDecoder *decoder, const MicroimpactLinkSchema *schema,
                                                            MicroimpactLinkRequest *request)
{
    const unsigned kind = (unsigned)schema->reading & 0x0fu;
    const uint8_t type = schema->number;
    MicroimpactLinkCursor in = microimpact_link_reader(decoder->message, decoder->length);
    MicroimpactLinkReading *reading = &request->reading;
    double values[4] = {0.0, 0.0, 0.0, 0.0};
    unsigned i;
    (void)memset(request, 0, sizeof *request);
    request->kind = (int)microimpact_link_integer(&in, 31u);
    request->number = (uint32_t)microimpact_link_integer(&in, 32u);
    if ((kind < (unsigned)MICROIMPACT_LINK_NORMAL) || (kind > (unsigned)MICROIMPACT_LINK_UNCERTAIN)
        || (request->kind > MICROIMPACT_LINK_CONFIGURE) || (microimpact_link_is_number(type) == 0)) {
        in.good = 0;
    } else if (request->kind == MICROIMPACT_LINK_EVENT) {
        if (((unsigned)schema->reading & (unsigned)MICROIMPACT_LINK_STAMPED) != 0u) {
            reading->ticks = (uint32_t)microimpact_link_integer(&in, 32u);
        }
        if (((unsigned)schema->reading & (unsigned)MICROIMPACT_LINK_SIZED) != 0u) {
            values[3] = microimpact_link_number(&in, type);
            reading->material = microimpact_link_byte(&in);
        }
        for (i = 0u; i < kind; i++) {
            values[i] = microimpact_link_number(&in, type);
            if (kind == (unsigned)MICROIMPACT_LINK_UNCERTAIN) {
                reading->errors[i] = microimpact_link_number(&in, type);
            }
        }
        reading->approach = values[0];
        reading->tangential = values[1];
        reading->peripheral = values[2];
        reading->radius = values[3];
    } else if (request->kind == MICROIMPACT_LINK_CONFIGURE) {
        microimpact_link_read_scene(&in, type, &request->scene);
    } else {
        /* A number alone. */
    }
    return ((in.good != 0) && (in.at == in.length)) ? (int)MICROIMPACT_LINK_MESSAGE_IN : (int)MICROIMPACT_LINK_CONTENT;
}

/* Makes a frame of the request to classify by a scene from now on; zero if it or the schema has an unknown choice, or the frame does not fit. The
   tolerance and the iterations of the scene are the instrument's own. */
MICROIMPACT_LINK_FUNCTION size_t microimpact_link_configure(const MicroimpactLinkSchema *schema, uint32_t number,
                                                            const MicroimpactSceneConfig *scene, uint8_t *frame, size_t capacity)
{
    uint8_t message[MICROIMPACT_LINK_MESSAGE];
    MicroimpactLinkCursor out = microimpact_link_writer(message, sizeof message);
    /* A copy, since the fields of a term are found for reading them too. */
    MicroimpactSceneConfig copy = *scene;
    const uint8_t type = schema->number;
    if ((copy.model > 1u) || (copy.restitution_law > 4u) || (copy.rebound_adhesion > 3u) || (copy.damping > 3u) || (copy.adhesion > 5u)
        || (microimpact_link_is_number(type) == 0)) {
        return 0u;
    }
    microimpact_link_put(&out, (uint8_t)MICROIMPACT_LINK_CONFIGURE);
    microimpact_link_put_integer(&out, number);
    microimpact_link_put_number(&out, type, (double)copy.radius);
    microimpact_link_put_number(&out, type, (double)copy.density);
    microimpact_link_put_number(&out, type, (double)copy.gyration_ratio);
    microimpact_link_put_number(&out, type, (double)copy.friction);
    microimpact_link_put_integer(&out, copy.model);
    if (copy.model == (uint32_t)MICROIMPACT_MODEL_RIGID_BODY) {
        microimpact_link_put_term(&out, type, copy.restitution_law, microimpact_link_restitution(&copy));
        microimpact_link_put_term(&out, type, copy.rebound_adhesion, microimpact_link_rebound_adhesion(&copy));
    } else {
        const uint32_t jkr = (uint32_t)MICROIMPACT_ADHESION_JKR_SNAP_OFF;
        microimpact_link_put_number(&out, type, (double)copy.stiffness);
        microimpact_link_put_term(&out, type, copy.damping, microimpact_link_damping(&copy));
        microimpact_link_put_term(&out, type, (copy.adhesion < jkr) ? copy.adhesion : jkr, microimpact_link_adhesion(&copy));
        if (copy.adhesion >= jkr) {
            microimpact_link_put_integer(&out, (uint64_t)copy.adhesion - (uint64_t)jkr);
        }
        microimpact_link_put_number(&out, type, (double)copy.external_force);
    }
    return (out.good != 0) ? microimpact_link_frame(message, out.at, frame, capacity) : 0u;
}

/* Makes a frame of a reply of an instrument of a schema; zero if there is no such reply, or the frame does not fit. What goes out in
   STARTED and DESCRIPTION is the schema, not that of the reply. */
MICROIMPACT_LINK_FUNCTION size_t microimpact_link_write_reply(const MicroimpactLinkSchema *schema, const MicroimpactLinkReply *reply,
                                                              uint8_t *frame, size_t capacity)
{
    uint8_t message[MICROIMPACT_LINK_MESSAGE];
    MicroimpactLinkCursor out = microimpact_link_writer(message, sizeof message);
    size_t i;
    microimpact_link_put(&out, (uint8_t)reply->kind);
    if (reply->kind != MICROIMPACT_LINK_STARTED) {
        microimpact_link_put_integer(&out, reply->number);
    }
    switch (reply->kind) {
    case MICROIMPACT_LINK_STARTED:
    case MICROIMPACT_LINK_DESCRIPTION:
        microimpact_link_put_integer(&out, MICROIMPACT_LINK_PROTOCOL);
        microimpact_link_put(&out, schema->number);
        microimpact_link_put(&out, schema->reading);
        microimpact_link_put(&out, schema->classes);
        break;
    case MICROIMPACT_LINK_CLASSIFIED:
        microimpact_link_put_integer(&out, reply->impact_class);
        microimpact_link_put(&out, reply->has_restitution);
        if (reply->has_restitution != 0u) {
            microimpact_link_put_number(&out, schema->number, reply->restitution);
        }
        break;
    case MICROIMPACT_LINK_REJECTED:
    case MICROIMPACT_LINK_REFUSED:
        microimpact_link_put(&out, reply->unsolved);
        if (reply->unsolved == 0u) {
            microimpact_link_put_integer(&out, reply->parameter);
            microimpact_link_put_integer(&out, reply->fault);
            microimpact_link_put_number(&out, (uint8_t)MICROIMPACT_LINK_F32, (double)reply->value);
        }
        break;
    case MICROIMPACT_LINK_REPORT_IS:
        for (i = 0u; i < MICROIMPACT_LINK_REPORT; i++) {
            microimpact_link_put_integer(&out, reply->report[i]);
        }
        break;
    case MICROIMPACT_LINK_COUNTS:
    case MICROIMPACT_LINK_RESET:
        if (reply->count > MICROIMPACT_LINK_CLASSES) {
            out.good = 0;
            break;
        }
        microimpact_link_put_integer(&out, reply->count);
        for (i = 0u; i < reply->count; i++) {
            microimpact_link_put_integer(&out, reply->counts[i]);
        }
        break;
    case MICROIMPACT_LINK_CONFIGURED:
        break;
    default:
        out.good = 0;
        break;
    }
    return (out.good != 0) ? microimpact_link_frame(message, out.at, frame, capacity) : 0u;
}

/* Fills in why a reading was refused, from an error of the library: the protocol numbers faults from zero on. */
MICROIMPACT_LINK_FUNCTION void microimpact_link_reject(MicroimpactLinkReply *reply, const MicroimpactError *error)
{
    reply->kind = MICROIMPACT_LINK_REJECTED;
    reply->unsolved = (error->fault == (MicroimpactFault)MICROIMPACT_FAULT_NONE) ? 1u : 0u;
    reply->parameter = error->parameter;
    reply->fault = (reply->unsolved != 0u) ? 0u : (error->fault - 1u);
    reply->value = (float)error->value;
}

#endif /* MICROIMPACT_INSTRUMENT_LINK_H */
