/* Null geodesics of Kerr by Taylor series in extended precision (long double: 64 bits of significand on x86, 113 on
 * aarch64): crossings of the equatorial plane. Errors are 1e-3 of the resolution of double precision. A ray takes some
 * tenths of a millisecond.
 *
 * It uses neither elliptic functions nor steps of a fixed order, but the equations in Mino time of
 * tests/oracle/null_reference.py,
 *
 *     w'' = A w + 3K w^2 + 2C w^3        n'' = a^2 n_z z - (eta + lambda^2 + 2 a^2 n_z^2) n        chi' = a (2r - a
 *                                        lambda)/Delta
 *
 * for w = 1/r and n, the unit vector of the direction, for which turning points and the axis are not special. Labels
 * as in physics/null/null_geodesic.h; azimuths source minus observer. Pure; any thread. */
#ifndef KD_TESTS_NULL_SERIES_H
#define KD_TESTS_NULL_SERIES_H

#include <stdbool.h>

enum { SERIES_CROSSINGS = 16 };

struct series_ray {
    long double spin, radius; /* INFINITY allowed */
    long double cosine, sine; /* cosine and sine of the observer's polar angle */
    long double alpha, beta;
    bool outward;
};

enum series_fate { SERIES_CAPTURED, SERIES_ESCAPED, SERIES_LOST };

struct series_path {
    enum series_fate fate; /* LOST: the ray winds round the hole without end */
    int crossings;
    long double r[SERIES_CROSSINGS], phi[SERIES_CROSSINGS];
    long double u, sky_phi; /* direction of escape: cosine of the polar angle, and azimuth */
};

/* Cosine and sine of an angle in degrees, each with full precision. */
void series_angle(double degrees, long double *cosine, long double *sine);

struct series_path series_trace(const struct series_ray *ray, int orders);

#endif
