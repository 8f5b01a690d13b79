
/* The restitution of one curve: between points it is linear. */
static double curve_restitution(int curve, double speed)
{
    int low = curve_begin[curve], high = curve_begin[curve + 1] - 1;
    if (speed <= critical_speed[curve])
        return 0.0;
    if (speed <= point_speed[low])
        return point_restitution[low];
    if (speed >= point_speed[high])
        return point_restitution[high];
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (point_speed[middle] < speed)
            low = middle;
        else
            high = middle;
    }
    return point_restitution[low] + (speed - point_speed[low]) / (point_speed[high] - point_speed[low])
        * (point_restitution[high] - point_restitution[low]);
}

/* Radii and speeds within rounding of the ends of the table are in it. */
#define ROUNDING 1e-6

/* In place of a restitution that the table does not hold. */
#define OUTSIDE_TABLE (-1.0)

/* The restitution of a sphere of this radius in m at this approach speed in m/s; 0 if it is captured, OUTSIDE_TABLE if the table
   does not hold it. Between two radii it is that of both curves at the same multiple of the critical speed. */
static double impact_restitution(double radius, double speed)
{
    int next = 0;
    double part, slow, fast, over_critical;
    if (!(radius >= (1.0 - ROUNDING) * curve_radius[0] && radius <= (1.0 + ROUNDING) * curve_radius[CURVES - 1]
            && speed <= (1.0 + ROUNDING) * FASTEST))
        return OUTSIDE_TABLE;
    while (next < CURVES && curve_radius[next] < radius)
        next++;
    if (next == 0 || next == CURVES)
        return curve_restitution(next == 0 ? 0 : CURVES - 1, speed);
    part = log(radius / curve_radius[next - 1]) / log(curve_radius[next] / curve_radius[next - 1]);
    slow = critical_speed[next - 1];
    fast = critical_speed[next];
    if (slow <= 0.0 || fast <= 0.0)
        return (1.0 - part) * curve_restitution(next - 1, speed) + part * curve_restitution(next, speed);
    over_critical = speed / exp(log(slow) + part * log(fast / slow));
    return (1.0 - part) * curve_restitution(next - 1, over_critical * slow)
        + part * curve_restitution(next, over_critical * fast);
}

/* Boundary condition of particles: the wall keeps what it captures, and changes only the normal velocity of what rebounds. The
   wall must be at rest; for axisymmetric swirl the normal must be turned as Fluent's manual says. A particle outside the table is
   aborted, so that Fluent counts it as such, and the first one is reported. */
DEFINE_DPM_BC(microimpact, p, t, f, f_normal, dim)
{
    static int is_reported = 0;
    double normal_velocity = 0.0, restitution;
    int i;
    for (i = 0; i < dim; i++)
        normal_velocity += TP_VEL(p)[i] * f_normal[i];
    restitution = impact_restitution(0.5 * TP_DIAM(p), fabs(normal_velocity));
    if (restitution == OUTSIDE_TABLE) {
        if (!is_reported)
            Message("microimpact: aborted a particle of radius %g m at %g m/s: the table holds radii from %g to %g m and speeds "
                    "up to %g m/s; make a table that covers it\n",
                0.5 * TP_DIAM(p), fabs(normal_velocity), curve_radius[0], curve_radius[CURVES - 1], FASTEST);
        is_reported = 1;
        return PATH_ABORT;
    }
    if (restitution <= 0.0)
        return PATH_END;
    for (i = 0; i < dim; i++) {
        TP_VEL(p)[i] -= (1.0 + restitution) * normal_velocity * f_normal[i];
        TP_VEL0(p)[i] = TP_VEL(p)[i];
    }
    return PATH_ACTIVE;
}
