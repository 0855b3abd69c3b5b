/* The parameters of a hole, in one list. Members of structs, fields of scenes and requests, rows of tables, FITS
 * keywords, cache keys and members of answers are generated from it (docs/adding-a-metric.md). All are doubles.
 *
 * KD_HOLE_MORE(P, x) calls P(x, name, member, ...) for each parameter besides the spin. The default of each is 0, with
 * which the hole is Kerr's. The arguments are
 *     name         of the field, and of the members of structs that have it
 *     member       of struct kd_hole (hole.h)
 * least, most in a scene; shown: the largest value of the page's control
 *     unit, card   the unit, and the keyword in FITS
 * what, bound in help texts: what the parameter is, and which values a hole may have
 *     help         of the scene's field
 *     source       of the metric
 *     told, text   name and sentence of the approximation that is reported wherever the parameter is not 0
 * x is passed to P unchanged; it may be the macro of another list. */
#ifndef KD_PHYSICS_SPACETIME_PARAMETERS_H
#define KD_PHYSICS_SPACETIME_PARAMETERS_H

#include <stdbool.h>

#define KD_HOLE_MORE(P, x) \
    P(x, charge, q, 0.0, 0.999999999999, 0.99, "M", "CHARGE", "charge Q of the hole", "a^2 + Q^2 < 1", \
      "electric charge Q of the hole (Kerr-Newman), which acts on space-time alone: light and matter are neutral", \
      "E. T. Newman et al. 1965, J. Math. Phys. 6, 918 (the charged hole)", "hole.charged", \
      "hole: it has a charge, which matter around a real hole would soon neutralise; light and matter here are " \
      "neutral, and the charge affects them only through space-time")

/* Lists made from KD_HOLE_MORE. KD_HOLE_MEMBERS declares all parameters as members, the spin first. */
#define KD_HOLE_MEMBER_(x, name, ...) double name;
#define KD_HOLE_MORE_MEMBERS KD_HOLE_MORE(KD_HOLE_MEMBER_, )
#define KD_HOLE_MEMBERS \
    double spin; \
    KD_HOLE_MORE_MEMBERS
#define KD_HOLE_ONE_(x, name, ...) +1
enum { KD_HOLE_MORE_COUNT = 0 KD_HOLE_MORE(KD_HOLE_ONE_, ) };
/* Names of the parameters, to follow "spin" in a sentence. */
#define KD_HOLE_NAME_(x, name, ...) ", " #name
#define KD_HOLE_MORE_NAMES KD_HOLE_MORE(KD_HOLE_NAME_, )

/* Initialisers of the parameters: copies from another struct that has them, or one value for all. */
#define KD_HOLE_TAKE_(from, name, ...) , .name = (from)->name
#define KD_HOLE_FROM(from) .spin = (from)->spin KD_HOLE_MORE(KD_HOLE_TAKE_, from)
#define KD_HOLE_IS_(value, name, ...) , .name = value
#define KD_HOLE_ALL(value) .spin = value KD_HOLE_MORE(KD_HOLE_IS_, value)

/* The parameters of a hole as they were given. kd_hole_given(from) takes them from any struct that has them. */
struct kd_hole_given { KD_HOLE_MEMBERS };
#define kd_hole_given(from) ((struct kd_hole_given) { KD_HOLE_FROM(from) })

/* Copies the parameters from one struct to another. */
#define KD_HOLE_SET_(to, name, ...) (to)->name = kd_given_.name;
#define KD_HOLE_COPY(to, from) \
    do { \
        const struct kd_hole_given kd_given_ = kd_hole_given(from); \
        (to)->spin = kd_given_.spin; \
        KD_HOLE_MORE(KD_HOLE_SET_, to) \
    } while (0)

/* True if any parameter besides the spin is given. */
#define KD_HOLE_OR_(given, name, ...) || (given).name != 0
static inline bool kd_hole_has_more(struct kd_hole_given given) { return false KD_HOLE_MORE(KD_HOLE_OR_, given); }

#endif
