/* The serial protocol of instruments, in plain C90: frames, requests and replies. It needs no library, and suits a host as well as a
   microcontroller. Include it where it is used; every function is static, and re-entrant for other structures.

   microimpact::instrument::link documents the protocol, byte by byte. */

#ifndef MICROIMPACT_LINK_H
#define MICROIMPACT_LINK_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Version of the protocol. */
#define MICROIMPACT_LINK_PROTOCOL 3u

/* Bytes that suffice for every message and its checksum, and for every frame. */
#define MICROIMPACT_LINK_MESSAGE 192u
#define MICROIMPACT_LINK_FRAME (MICROIMPACT_LINK_MESSAGE + 4u)

/* Most classes of a set, and the numbers of a report. */
#define MICROIMPACT_LINK_CLASSES 16u
#define MICROIMPACT_LINK_REPORT 17u

/* The compiler need not use every function. */
#if defined(__GNUC__)
#define MICROIMPACT_LINK_FUNCTION static __attribute__((unused))
#else
#define MICROIMPACT_LINK_FUNCTION static
#endif

/* What becomes of a byte that comes in. The four in the middle are numbered as in a report. */
enum {
    MICROIMPACT_LINK_WAITS,    /* the frame goes on */
    MICROIMPACT_LINK_MESSAGE_IN, /* the decoder holds a message */
    MICROIMPACT_LINK_OVERSIZED,
    MICROIMPACT_LINK_STUFFING, /* cut off, or not encoded by COBS */
    MICROIMPACT_LINK_CHECKSUM,
    MICROIMPACT_LINK_CONTENT,  /* no known message */
    MICROIMPACT_LINK_SCHEMA    /* an instrument of another version, number type, reading or set of classes */
};

/* Number types, readings and sets of classes of a schema. */
enum { MICROIMPACT_LINK_F32 = 1, MICROIMPACT_LINK_F64 };
enum {
    MICROIMPACT_LINK_NORMAL = 1,
    MICROIMPACT_LINK_OBLIQUE,
    MICROIMPACT_LINK_PLANAR,
    MICROIMPACT_LINK_UNCERTAIN,
    MICROIMPACT_LINK_SIZED = 16,  /* added to the others: radius and material */
    MICROIMPACT_LINK_STAMPED = 32 /* added to the others: ticks of a clock */
};
enum {
    MICROIMPACT_LINK_OUTCOMES = 1,
    MICROIMPACT_LINK_FRICTION,
    MICROIMPACT_LINK_BOUNDARY_TABLE,
    MICROIMPACT_LINK_RESTITUTION_TABLE
};

/* Requests, and replies. */
enum {
    MICROIMPACT_LINK_EVENT,
    MICROIMPACT_LINK_ASK_REPORT,
    MICROIMPACT_LINK_DESCRIBE,
    MICROIMPACT_LINK_ASK_COUNTS,
    MICROIMPACT_LINK_ASK_RESET,
    MICROIMPACT_LINK_CONFIGURE
};
enum {
    MICROIMPACT_LINK_STARTED,
    MICROIMPACT_LINK_CLASSIFIED,
    MICROIMPACT_LINK_REJECTED,
    MICROIMPACT_LINK_REPORT_IS,
    MICROIMPACT_LINK_DESCRIPTION,
    MICROIMPACT_LINK_COUNTS,
    MICROIMPACT_LINK_RESET,
    MICROIMPACT_LINK_CONFIGURED,
    MICROIMPACT_LINK_REFUSED
};

typedef struct MicroimpactLinkSchema {
    uint8_t number;
    uint8_t reading;
    uint8_t classes;
} MicroimpactLinkSchema;

/* Bytes that come in, until they are a message. All zeros is a decoder at its start. */
typedef struct MicroimpactLinkDecoder {
    uint8_t message[MICROIMPACT_LINK_MESSAGE];
    size_t length;
    uint8_t left;      /* bytes of the present block of COBS that are to come */
    uint8_t zero_next; /* whether a zero is between this block and the next */
    uint8_t inside;    /* whether a byte has come since the last zero byte */
    uint8_t oversized;
} MicroimpactLinkDecoder;

/* A reading; what the schema does not have is not looked at. Standard errors are of reading 4. */
typedef struct MicroimpactLinkReading {
    uint32_t ticks;
    double radius;
    uint8_t material;
    double approach;
    double tangential;
    double peripheral;
    double errors[4]; /* of approach speed, tangential and peripheral velocity, and radius */
} MicroimpactLinkReading;

/* A reply; what its kind does not have is zero. */
typedef struct MicroimpactLinkReply {
    int kind;
    uint32_t number;
    uint32_t protocol; /* of STARTED and DESCRIPTION */
    MicroimpactLinkSchema schema;
    uint8_t impact_class; /* of CLASSIFIED */
    uint8_t has_restitution;
    double restitution;
    uint8_t unsolved;   /* of REJECTED: the method did not converge; of REFUSED: the scene does not change */
    uint32_t parameter; /* of REJECTED and REFUSED otherwise: what was refused */
    uint32_t fault;
    float value;
    uint64_t report[MICROIMPACT_LINK_REPORT]; /* of REPORT, in the order of the documentation */
    size_t count;                             /* of COUNTS and RESET */
    uint64_t counts[MICROIMPACT_LINK_CLASSES];
} MicroimpactLinkReply;

/* CRC-32 of Ethernet and zip, bit by bit. */
MICROIMPACT_LINK_FUNCTION uint32_t microimpact_link_checksum(const uint8_t *bytes, size_t length)
{
    uint32_t crc = 0xffffffffu;
    size_t i;
    int bit;
    for (i = 0u; i < length; i++) {
        crc ^= bytes[i];
        for (bit = 0; bit < 8; bit++) {
            crc = ((crc & 1u) != 0u) ? ((crc >> 1) ^ 0xedb88320u) : (crc >> 1);
        }
    }
    return ~crc;
}

MICROIMPACT_LINK_FUNCTION void microimpact_link_append(MicroimpactLinkDecoder *decoder, uint8_t byte)
{
    if (decoder->length < MICROIMPACT_LINK_MESSAGE) {
        decoder->message[decoder->length] = byte;
        decoder->length++;
    } else {
        decoder->oversized = 1u;
    }
}

/* Takes a byte, and says what has become of it. After MICROIMPACT_LINK_MESSAGE_IN, `message` holds `length` bytes of a message without
   its checksum, until the next byte is taken. */
MICROIMPACT_LINK_FUNCTION int microimpact_link_take(MicroimpactLinkDecoder *decoder, uint8_t byte)
{
    if (byte == 0u) {
        const uint8_t inside = decoder->inside;
        const uint8_t left = decoder->left;
        const uint8_t oversized = decoder->oversized;
        const size_t length = decoder->length;
        uint32_t found;
        decoder->inside = 0u;
        decoder->left = 0u;
        decoder->zero_next = 0u;
        decoder->oversized = 0u;
        decoder->length = 0u;
        if (inside == 0u) {
            return MICROIMPACT_LINK_WAITS;
        }
        if (oversized != 0u) {
            return MICROIMPACT_LINK_OVERSIZED;
        }
        if (left != 0u) {
            return MICROIMPACT_LINK_STUFFING;
        }
        if (length < 4u) {
            return MICROIMPACT_LINK_CHECKSUM;
        }
        found = (uint32_t)decoder->message[length - 4u] | ((uint32_t)decoder->message[length - 3u] << 8)
                | ((uint32_t)decoder->message[length - 2u] << 16) | ((uint32_t)decoder->message[length - 1u] << 24);
        if (found != microimpact_link_checksum(decoder->message, length - 4u)) {
            return MICROIMPACT_LINK_CHECKSUM;
        }
        decoder->length = length - 4u;
        return MICROIMPACT_LINK_MESSAGE_IN;
    }
    if (decoder->inside == 0u) {
        decoder->length = 0u;
    }
    if (decoder->left == 0u) {
        /* The first byte of a block: how many bytes come before the next zero. */
        if ((decoder->inside != 0u) && (decoder->zero_next != 0u)) {
            microimpact_link_append(decoder, 0u);
        }
        decoder->left = (uint8_t)(byte - 1u);
        if (byte == 0xffu) {
            decoder->zero_next = 0u;
        } else {
            decoder->zero_next = 1u;
        }
    } else {
        microimpact_link_append(decoder, byte);
        decoder->left--;
    }
    decoder->inside = 1u;
    return MICROIMPACT_LINK_WAITS;
}

/* Makes a frame of a message: writes it, and returns its length, or zero where it does not fit. */
MICROIMPACT_LINK_FUNCTION size_t microimpact_link_frame(const uint8_t *message, size_t length, uint8_t *frame, size_t capacity)
{
    const uint32_t crc = microimpact_link_checksum(message, length);
    size_t i;
    size_t out = 2u;
    size_t block = 1u;
    if ((length > (MICROIMPACT_LINK_MESSAGE - 4u)) || (capacity < (length + 7u))) {
        return 0u;
    }
    /* At most 192 bytes, so that no block is longer than 254. */
    frame[0] = 0u;
    for (i = 0u; i < (length + 4u); i++) {
        const uint8_t byte = (uint8_t)((i < length) ? message[i] : (crc >> (8u * (i - length))));
        if (byte == 0u) {
            frame[block] = (uint8_t)(out - block);
            block = out;
        } else {
            frame[out] = byte;
        }
        out++;
    }
    frame[block] = (uint8_t)(out - block);
    frame[out] = 0u;
    return out + 1u;
}

/* A place in a message that is read or written; `good` is zero from the first byte on that is missing or wrong. */
typedef struct MicroimpactLinkCursor {
    const uint8_t *bytes;
    uint8_t *room;
    size_t length;
    size_t at;
    int good;
} MicroimpactLinkCursor;

MICROIMPACT_LINK_FUNCTION uint8_t microimpact_link_byte(MicroimpactLinkCursor *in)
{
    uint8_t byte = 0u;
    if ((in->good != 0) && (in->at < in->length)) {
        byte = in->bytes[in->at];
        in->at++;
    } else {
        in->good = 0;
    }
    return byte;
}

MICROIMPACT_LINK_FUNCTION MicroimpactLinkCursor microimpact_link_reader(const uint8_t *bytes, size_t length)
{
    MicroimpactLinkCursor in;
    in.bytes = bytes;
    in.room = NULL;
    in.length = length;
    in.at = 0u;
    in.good = 1;
    return in;
}

MICROIMPACT_LINK_FUNCTION MicroimpactLinkCursor microimpact_link_writer(uint8_t *room, size_t length)
{
    MicroimpactLinkCursor out;
    out.bytes = NULL;
    out.room = room;
    out.length = length;
    out.at = 0u;
    out.good = 1;
    return out;
}

/* An integer of at most `bits` bits. */
MICROIMPACT_LINK_FUNCTION uint64_t microimpact_link_integer(MicroimpactLinkCursor *in, unsigned bits)
{
    uint64_t value = 0u;
    unsigned shift = 0u;
    for (;;) {
        const uint8_t byte = microimpact_link_byte(in);
        const uint64_t part = (uint64_t)byte & 0x7fu;
        uint64_t beyond = 0u;
        if (shift >= bits) {
            in->good = 0;
        } else if ((bits - shift) < 7u) {
            const unsigned within = bits - shift;
            beyond = part;
            beyond >>= within;
        } else {
            /* All seven bits are within. */
        }
        if (beyond != 0u) {
            in->good = 0;
        }
        if (in->good == 0) {
            return 0u;
        }
        value |= part << shift;
        if ((byte & 0x80u) == 0u) {
            return value;
        }
        shift += 7u;
    }
}

/* Bytes of a number. */
MICROIMPACT_LINK_FUNCTION unsigned microimpact_link_width(uint8_t type)
{
    unsigned width = 4u;
    if (type == (uint8_t)MICROIMPACT_LINK_F64) {
        width = 8u;
    }
    return width;
}

/* Whether a type of numbers is one that there is. */
MICROIMPACT_LINK_FUNCTION int microimpact_link_is_number(uint8_t type)
{
    return ((type == (uint8_t)MICROIMPACT_LINK_F32) || (type == (uint8_t)MICROIMPACT_LINK_F64)) ? 1 : 0;
}

MICROIMPACT_LINK_FUNCTION double microimpact_link_number(MicroimpactLinkCursor *in, uint8_t type)
{
    uint64_t bits = 0u;
    const unsigned length = microimpact_link_width(type);
    double number;
    unsigned i;
    for (i = 0u; i < length; i++) {
        const unsigned place = 8u * i;
        uint64_t byte = microimpact_link_byte(in);
        byte <<= place;
        bits |= byte;
    }
    if (length == 8u) {
        (void)memcpy(&number, &bits, sizeof number);
    } else {
        const uint32_t word = (uint32_t)bits;
        float narrow;
        (void)memcpy(&narrow, &word, sizeof narrow);
        number = (double)narrow;
    }
    return number;
}

MICROIMPACT_LINK_FUNCTION void microimpact_link_put(MicroimpactLinkCursor *out, uint8_t byte)
{
    if (out->at >= out->length) {
        out->good = 0;
    } else {
        out->room[out->at] = byte;
        out->at++;
    }
}

MICROIMPACT_LINK_FUNCTION void microimpact_link_put_integer(MicroimpactLinkCursor *out, uint64_t value)
{
    uint64_t rest = value;
    while (rest >= 0x80u) {
        microimpact_link_put(out, (uint8_t)((rest & 0x7fu) | 0x80u));
        rest >>= 7;
    }
    microimpact_link_put(out, (uint8_t)rest);
}

MICROIMPACT_LINK_FUNCTION void microimpact_link_put_number(MicroimpactLinkCursor *out, uint8_t type, double number)
{
    const unsigned length = microimpact_link_width(type);
    uint64_t bits;
    unsigned i;
    if (length == 8u) {
        (void)memcpy(&bits, &number, sizeof bits);
    } else {
        const float narrow = (float)number;
        uint32_t word;
        (void)memcpy(&word, &narrow, sizeof word);
        bits = word;
    }
    for (i = 0u; i < length; i++) {
        microimpact_link_put(out, (uint8_t)(bits & 0xffu));
        bits >>= 8;
    }
}

/* Makes a frame of a request without fields: a report, a description, counts or a reset. */
MICROIMPACT_LINK_FUNCTION size_t microimpact_link_request(int kind, uint32_t number, uint8_t *frame, size_t capacity)
{
    uint8_t message[8];
    MicroimpactLinkCursor out = microimpact_link_writer(message, sizeof message);
    if ((kind < MICROIMPACT_LINK_ASK_REPORT) || (kind > MICROIMPACT_LINK_ASK_RESET)) {
        return 0u;
    }
    microimpact_link_put(&out, (uint8_t)kind);
    microimpact_link_put_integer(&out, number);
    return microimpact_link_frame(message, out.at, frame, capacity);
}

/* Makes a frame of an event for an instrument of a schema; zero if the schema has no such reading, or the frame does not fit. */
MICROIMPACT_LINK_FUNCTION size_t microimpact_link_event(const MicroimpactLinkSchema *schema, uint32_t number,
                                                        const MicroimpactLinkReading *reading, uint8_t *frame, size_t capacity)
{
    uint8_t message[MICROIMPACT_LINK_MESSAGE];
    const unsigned kind = (unsigned)schema->reading & 0x0fu;
    const uint8_t type = schema->number;
    MicroimpactLinkCursor out = microimpact_link_writer(message, sizeof message);
    double values[4];
    unsigned i;
    values[0] = reading->approach;
    values[1] = reading->tangential;
    values[2] = reading->peripheral;
    values[3] = reading->radius;
    if ((kind < (unsigned)MICROIMPACT_LINK_NORMAL) || (kind > (unsigned)MICROIMPACT_LINK_UNCERTAIN) || (schema->reading >= 64u)
        || (microimpact_link_is_number(type) == 0)) {
        return 0u;
    }
    microimpact_link_put(&out, (uint8_t)MICROIMPACT_LINK_EVENT);
    microimpact_link_put_integer(&out, number);
    if (((unsigned)schema->reading & (unsigned)MICROIMPACT_LINK_STAMPED) != 0u) {
        microimpact_link_put_integer(&out, reading->ticks);
    }
    if (((unsigned)schema->reading & (unsigned)MICROIMPACT_LINK_SIZED) != 0u) {
        microimpact_link_put_number(&out, type, reading->radius);
        microimpact_link_put(&out, reading->material);
    }
    for (i = 0u; i < kind; i++) {
        microimpact_link_put_number(&out, type, values[i]);
        if (kind == (unsigned)MICROIMPACT_LINK_UNCERTAIN) {
            microimpact_link_put_number(&out, type, reading->errors[i]);
        }
    }
    return microimpact_link_frame(message, out.at, frame, capacity);
}

/* Whether an instrument is of another protocol or schema than a host expects. */
MICROIMPACT_LINK_FUNCTION int microimpact_link_differs(const MicroimpactLinkReply *reply, const MicroimpactLinkSchema *expected)
{
    int differs = 0;
    if ((reply->protocol != MICROIMPACT_LINK_PROTOCOL) || (reply->schema.number != expected->number)
        || (reply->schema.reading != expected->reading) || (reply->schema.classes != expected->classes)) {
        differs = 1;
    }
    return differs;
}

/* Number of classes of a set, the largest one of your own sets, from 128 on; zero for one that is not known. */
MICROIMPACT_LINK_FUNCTION unsigned microimpact_link_classes(uint8_t set)
{
    static const uint8_t COUNTS[5] = {0u, 3u, 6u, 4u, 5u};
    unsigned count = 0u;
    if (set >= 128u) {
        count = MICROIMPACT_LINK_CLASSES;
    } else if (set < 5u) {
        count = COUNTS[set];
    } else {
        /* Not known. */
    }
    return count;
}

MICROIMPACT_LINK_FUNCTION void microimpact_link_choice(MicroimpactLinkCursor *in, MicroimpactLinkReply *reply)
{
    const uint64_t choice = microimpact_link_integer(in, 32u);
    if (choice == 1u) {
        reply->unsolved = 1u;
    } else if (choice == 0u) {
        reply->parameter = (uint32_t)microimpact_link_integer(in, 32u);
        reply->fault = (uint32_t)microimpact_link_integer(in, 32u);
        reply->value = (float)microimpact_link_number(in, (uint8_t)MICROIMPACT_LINK_F32);
    } else {
        in->good = 0;
    }
}

/* Reads the reply in a decoder after MICROIMPACT_LINK_MESSAGE_IN, from an instrument of the expected schema. STARTED and DESCRIPTION of
   another one are read too, and are MICROIMPACT_LINK_SCHEMA: what follows them must not be read. */
MICROIMPACT_LINK_FUNCTION int microimpact_link_reply(const MicroimpactLinkDecoder *decoder, const MicroimpactLinkSchema *expected,
                                                     MicroimpactLinkReply *reply)
{
    MicroimpactLinkCursor in = microimpact_link_reader(decoder->message, decoder->length);
    size_t i;
    (void)memset(reply, 0, sizeof *reply);
    reply->kind = (int)microimpact_link_integer(&in, 31u);
    if (reply->kind != MICROIMPACT_LINK_STARTED) {
        reply->number = (uint32_t)microimpact_link_integer(&in, 32u);
    }
    switch (reply->kind) {
    case MICROIMPACT_LINK_STARTED:
    case MICROIMPACT_LINK_DESCRIPTION:
        reply->protocol = (uint32_t)microimpact_link_integer(&in, 32u);
        /* Another version may describe itself otherwise. */
        if ((in.good != 0) && (reply->protocol != MICROIMPACT_LINK_PROTOCOL)) {
            return MICROIMPACT_LINK_SCHEMA;
        }
        reply->schema.number = microimpact_link_byte(&in);
        reply->schema.reading = microimpact_link_byte(&in);
        reply->schema.classes = microimpact_link_byte(&in);
        break;
    case MICROIMPACT_LINK_CLASSIFIED: {
        const uint64_t number_of_class = microimpact_link_integer(&in, 32u);
        const uint8_t option = microimpact_link_byte(&in);
        if ((number_of_class >= microimpact_link_classes(expected->classes)) || (option > 1u)) {
            in.good = 0;
        }
        reply->impact_class = (uint8_t)number_of_class;
        reply->has_restitution = option;
        if (option == 1u) {
            reply->restitution = microimpact_link_number(&in, expected->number);
        }
        break;
    }
    case MICROIMPACT_LINK_REJECTED:
    case MICROIMPACT_LINK_REFUSED:
        microimpact_link_choice(&in, reply);
        break;
    case MICROIMPACT_LINK_REPORT_IS:
        for (i = 0u; i < MICROIMPACT_LINK_REPORT; i++) {
            reply->report[i] = microimpact_link_integer(&in, 64u);
        }
        break;
    case MICROIMPACT_LINK_COUNTS:
    case MICROIMPACT_LINK_RESET:
        reply->count = (size_t)microimpact_link_integer(&in, 32u);
        if (reply->count > MICROIMPACT_LINK_CLASSES) {
            reply->count = 0u;
            in.good = 0;
        }
        for (i = 0u; i < reply->count; i++) {
            reply->counts[i] = microimpact_link_integer(&in, 64u);
        }
        break;
    case MICROIMPACT_LINK_CONFIGURED:
        break;
    default:
        in.good = 0;
        break;
    }
    if ((in.good == 0) || (in.at != in.length)) {
        return MICROIMPACT_LINK_CONTENT;
    }
    if (((reply->kind == MICROIMPACT_LINK_STARTED) || (reply->kind == MICROIMPACT_LINK_DESCRIPTION))
        && (microimpact_link_differs(reply, expected) != 0)) {
        return MICROIMPACT_LINK_SCHEMA;
    }
    return MICROIMPACT_LINK_MESSAGE_IN;
}

#endif /* MICROIMPACT_LINK_H */
