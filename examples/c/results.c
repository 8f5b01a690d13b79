/* Classifies and simulates some impacts and prints every bit of the results. Runs on a microcontroller and on a host. */

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "microimpact.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* Silver-coated glass on steel: Brach & Dunn (1995), Table 1. */
static const MicroimpactRigidScene BODY = {5.06e-6f, 2600.0f, 130.0f, 2.22e-12f, 0.1f};
static const MicroimpactContactScene CONTACT = {5.06e-6f, 2600.0f, 7.5e10f, 10.5f, 250.0f, 6.25f, 0.1f, 1e-6f};

static const MicroimpactMotion MOTIONS[] = {
    {2.8f, 0.0f, 0.0f},  {2.8f, 0.0f, 0.7388f}, {2.8f, 20.0f, 0.0f}, {2.8f, 1.0f, -2.5f},
    {1.85f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f},    {1.75f, 0.2f, 0.0f}, {1.0f, 5.0f, 0.0f},
};

static unsigned long bits(float number)
{
    uint32_t word;
    memcpy(&word, &number, sizeof word);
    return word;
}

int main(void)
{
    static MicroimpactContact contacts[COUNT(MOTIONS)];
    MicroimpactError error;
    size_t written;
    for (size_t i = 0; i < COUNT(MOTIONS); i++) {
        MicroimpactClassification c;
        if (microimpact_classify(&BODY, &MOTIONS[i], &c, &error) != MICROIMPACT_STATUS_OK)
            return 1;
        printf("rigid %lu %d %08lx %08lx %08lx %08lx %08lx\n", (unsigned long)i, (int)c.impact_class, bits(c.speed_over_critical),
               bits(c.friction_over_limit), bits(c.restitution), bits(c.tangential), bits(c.peripheral));
    }
    if (microimpact_simulate(&CONTACT, MOTIONS, COUNT(MOTIONS), contacts, COUNT(contacts), &written, &error)
        != MICROIMPACT_STATUS_OK)
        return 2;
    for (size_t i = 0; i < written; i++)
        printf("contact %lu %d %08lx %08lx %08lx %08lx\n", (unsigned long)i, (int)contacts[i].impact_class, bits(contacts[i].restitution),
               bits(contacts[i].peak_indentation), bits(contacts[i].tangential), bits(contacts[i].spin));
    return 0;
}
