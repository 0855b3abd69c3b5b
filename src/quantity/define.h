/* Macros that define a quantity from its tables of parameters and outputs. Private to src/quantity.
 *
 *     #define PARAMETERS(P) P(spin, .unit = "M", .typed = "0.9", ...) P(r, ...)
 *     #define OUTPUTS(O) O(isco, .unit = "M", .fixed = true, .help = "...") ...
 *     KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)
 *     static enum kd_status evaluate(const double *in, double *out, ...)
 *     { const struct parameters *p = KD_QUANTITY_IN(in); struct outputs *o = KD_QUANTITY_OUT(out); ... }
 *     KD_QUANTITY(kerr, "kerr", "the hole in numbers", .point_us = 1)
 *
 * Struct parameters and struct outputs have a double member for each row, in the order of the tables. */
#ifndef KD_QUANTITY_DEFINE_H
#define KD_QUANTITY_DEFINE_H

#include "physics/spacetime/hole.h"
#include "physics/spacetime/observer.h"
#include "quantity/quantity.h"

#include <math.h>

#define KD_DEFINE_MEMBER(member, ...) double member;
#define KD_DEFINE_ROW(member, ...) { .name = #member, __VA_ARGS__ },

#define KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS) \
    struct parameters { PARAMETERS(KD_DEFINE_MEMBER) }; \
    struct outputs { OUTPUTS(KD_DEFINE_MEMBER) }; \
    static const struct kd_row parameter_rows[] = { PARAMETERS(KD_DEFINE_ROW) }; \
    static const struct kd_output output_rows[] = { OUTPUTS(KD_DEFINE_ROW) }; \
    _Static_assert(sizeof(struct parameters) <= KD_QUANTITY_PARAMETERS * sizeof(double), "too many parameters"); \
    _Static_assert(sizeof(struct outputs) <= KD_QUANTITY_OUTPUTS * sizeof(double), "too many outputs");

#define KD_QUANTITY_IN(in) ((const struct parameters *)(const void *)(in))
#define KD_QUANTITY_OUT(out) ((struct outputs *)(void *)(out))

/* Defines a quantity. The file must define `evaluate`, and the NULL-terminated lists `sources` and `approximations`. */
#define KD_QUANTITY(symbol, name_, summary_, ...) \
    const struct kd_quantity kd_quantity_##symbol = { .name = name_, \
                                                      .summary = summary_, \
                                                      .parameters = parameter_rows, \
                                                      .n_parameters = sizeof parameter_rows / sizeof *parameter_rows, \
                                                      .outputs = output_rows, \
                                                      .n_outputs = sizeof output_rows / sizeof *output_rows, \
                                                      .sources = sources, \
                                                      .approximations = approximations, \
                                                      .evaluate = evaluate, \
                                                      __VA_ARGS__ };

/* Parameters shared by several quantities. */
#define KD_PARAMETER_SPIN(P) \
    P(spin, .unit = "M", .typed = "0.9", .least = -1, .most = 1, .open = KD_OPEN, \
      .help = "spin parameter a; a < 0: the orbit or the disk turns against its hole")
#define KD_DEFINE_MORE(P, name, member, least_, most_, shown, unit_, card, what, bound, ...) \
    P(name, .unit = unit_, .typed = "0", .least = -1, .most = 1, .open = KD_OPEN, \
      .help = what "; light and matter are neutral; " bound)
#define KD_PARAMETER_HOLE_MORE(P) KD_HOLE_MORE(KD_DEFINE_MORE, P)
/* The hole with these parameters, for use as a function's argument: kd_kerr_isco(KD_QUANTITY_HOLE(p)). */
#define KD_QUANTITY_HOLE(p) ((const struct kd_hole[]) { kd_hole_in(p) })
/* Rows of the outputs right, up and inwards: the direction from which light reaches an observer at a finite radius. */
#define KD_RESULTS_DIRECTION(O) \
    O(right, .unit = "1", \
      .help = "unit vector of the viewing direction at a finite radius: component towards +phi; null at infinity") \
    O(up, .unit = "1", \
      .help = \
          "unit vector of the viewing direction at a finite radius: component up, towards -theta; null at infinity") \
    O(inwards, .unit = "1", \
      .help = \
          "unit vector of the viewing direction at a finite radius: component inwards, towards -r; null at infinity")
#define KD_PARAMETER_MASS(P) \
    P(mass_msun, .unit = "solar masses", .typed = "1e8", .least = 1e-3, .most = 1e12, .help = "mass of the hole")
#define KD_PARAMETER_OBSERVER(P) \
    P(observer_r, .unit = "M", .typed = "infinity", .least = 0.01, .most = 1e7, .words = "infinity", \
      .stands = INFINITY, .help = "radius of the observer") \
    P(observer, .typed = "static", .kind = KD_KIND_WORD, .words = KD_OBSERVER_WORDS, \
      .help = "state of motion at a finite radius" KD_OBSERVER_HELP) \
    P(velocity_r, .unit = "c", .typed = "0", .least = -1, .most = 1, \
      .help = "velocity outwards, relative to the observer of zero angular momentum (observer velocity)") \
    P(velocity_theta, .unit = "c", .typed = "0", .least = -1, .most = 1, \
      .help = \
          "velocity away from the north pole, relative to the observer of zero angular momentum (observer velocity)") \
    P(velocity_phi, .unit = "c", .typed = "0", .least = -1, .most = 1, \
      .help = "velocity towards +phi, relative to the observer of zero angular momentum (observer velocity)") \
    P(infall_from, .unit = "M", .typed = "infinity", .least = 1, .most = 1e7, .words = "infinity", .stands = INFINITY, \
      .help = "radius at which the observer's fall begins, at rest except for its angular momentum (observer infall)") \
    P(infall_energy, .unit = "1", .typed = "rest", .least = -100, .most = 1e3, .words = "rest", .stands = INFINITY, \
      .help = "energy per mass of the falling observer; rest: the energy that follows from infall_from") \
    P(infall_momentum, .unit = "M", .typed = "0", .least = -1e4, .most = 1e4, \
      .help = "angular momentum per mass of the falling observer")
/* The motion of the observer with the parameters of KD_PARAMETER_OBSERVER. */
#define KD_QUANTITY_MOTION(p) \
    (struct kd_observer_motion) \
    { \
        .observer = (enum kd_observer)(p)->observer, \
        .velocity = { (p)->velocity_r, (p)->velocity_theta, (p)->velocity_phi }, .fall_from = (p)->infall_from, \
        .fall_energy = (p)->infall_energy, .fall_momentum = (p)->infall_momentum, \
    }

/* Returns KD_EINVAL at "/name". The message is "r is 1.2, " followed by the reason, which should end with the allowed
 * values. */
enum kd_status kd_quantity_outside(struct kd_error *error, const char *name, double value, const char *reason, ...)
    __attribute__((format(printf, 4, 5)));
/* Checks that r is at or outside the hole's horizon; otherwise returns the error of kd_quantity_outside. */
enum kd_status kd_quantity_outside_horizon(const struct kd_hole *hole, double r, struct kd_error *error);
/* Checks that the observer exists. Otherwise returns an error, whose pointer is /observer_r or the name of the invalid
 * number. */
enum kd_status kd_quantity_observer_exists(const struct kd_observer_motion *motion, const struct kd_vantage *at,
                                           struct kd_error *error);

#endif
