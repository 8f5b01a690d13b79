/* Made by cargo microimpact table --smallest-radius 2e-6 --cells 8 --format c */
/* Critical speeds: density 2600 kg/m^3, K 7.5e10 Pa, f0 250 N/m, zeta_H 10.5, zeta_A 6.25; greatest relative error 4.9e-5. */
#include <stdint.h>
#include <string.h>

/* With microimpact.h: {BOUNDARY_SMALLEST_RADIUS, BOUNDARY_MARGIN, boundary, BOUNDARY_CELLS} is a table. */
#define BOUNDARY_CELLS 8u
#define BOUNDARY_SMALLEST_RADIUS 1.9073486e-6f /* m */
#define BOUNDARY_FIRST 905969664u /* bits of the smallest radius */
#define BOUNDARY_MARGIN 592u

static const int32_t boundary[BOUNDARY_CELLS][4] = {
    {1088728656, -5161287, 647136, -107606},
    {1084119581, -4133047, 413760, -54992},
    {1080350653, -3446374, 287329, -31829},
    {1077162420, -2955240, 211141, -20043},
    {1073145078, -4869162, 575996, -90242},
    {1068771779, -3942560, 376946, -47813},
    {1065162811, -3311965, 265777, -28334},
    {1062090562, -2855114, 197421, -18139},
};

enum boundary_verdict { BOUNDARY_REBOUND, BOUNDARY_CAPTURE, BOUNDARY_TOO_CLOSE_TO_CALL, BOUNDARY_OUTSIDE_TABLE };

/* Radius in m; approach speed in m/s, from 1e-12 to 1e6. Right shifts of negative numbers keep the sign. */
static inline enum boundary_verdict boundary_classify(float radius, float speed)
{
    uint32_t r, v, from_first, f, q;
    memcpy(&r, &radius, sizeof r);
    memcpy(&v, &speed, sizeof v);
    from_first = r - BOUNDARY_FIRST;
    if ((from_first >> 21) >= BOUNDARY_CELLS || v < 0x2b8cbcccu || v > 0x49742400u)
        return BOUNDARY_OUTSIDE_TABLE;
    const int32_t *cell = boundary[from_first >> 21];
    int64_t place = (int64_t)((from_first >> 5) & 0xffffu) - 0x8000;
    int32_t edge = cell[3];
    for (int i = 2; i >= 0; i--)
        edge = cell[i] + (int32_t)((edge * place) >> 16);
    f = (v >> 7) & 0xffffu;
    q = 19455u - ((5918u * f) >> 16);
    q = 35020u - ((q * f) >> 16);
    q = 57923u - ((q * f) >> 16);
    int32_t excess = (int32_t)(v + ((((f * (0x10000u - f)) >> 14) * q) >> 12)) - edge;
    if (excess < 0)
        return BOUNDARY_CAPTURE;
    return (uint32_t)excess <= 2u * BOUNDARY_MARGIN ? BOUNDARY_TOO_CLOSE_TO_CALL : BOUNDARY_REBOUND;
}
