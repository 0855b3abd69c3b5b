/* Finds the size, the orientation and the position of a model that fit an observation best. Any thread.
 *
 * chi^2 is summed over all data of the comparison. Size and orientation are searched on a grid first, because closure
 * phases give chi^2 several minima. The best places of the grid are then refined by the simplex method of J. A. Nelder
 * & R. Mead 1965, Comput. J. 7, 308. At each place the flux follows in closed form (kd_comparison_scale). The shift is
 * found by a grid and Newton's method. This is cheap, because the shift affects only the sum of Re(d* m exp(2 pi i (u x
 * + v y)))/sigma^2. */
#ifndef KD_OBSERVE_ALIGN_H
#define KD_OBSERVE_ALIGN_H

#include "observe/comparison.h"

enum { KD_ALIGN_FLUX = 1, KD_ALIGN_SIZE = 2, KD_ALIGN_ANGLE = 4, KD_ALIGN_SHIFT = 8 };

/* Numbers of steps of the grids of size, of angle, and of shift. For a ring of 50 uas, a step of 7.5 degrees, or of 9
 * percent in size, shifts the phase of the EHT's longest baselines by less than a sixth of a turn. */
enum { KD_ALIGN_SIZES = 17, KD_ALIGN_ANGLES = 48, KD_ALIGN_SHIFTS = 65 };

#define KD_ALIGN_LEAST_SIZE 0.5
#define KD_ALIGN_MOST_SIZE 2.0

struct kd_alignment {
    double size;        /* factor of the model's angular size, at the same flux */
    double angle_deg;   /* rotation from north to east, degrees */
    double east, north; /* shift to the east and to the north, radians */
    double scale;       /* factor of the flux */
    unsigned evaluations;
    bool converged[4]; /* true if the quantity converged or was not searched for: flux, size, angle, shift */
};
#define KD_ALIGNMENT_NONE ((struct kd_alignment) { .size = 1, .scale = 1, .converged = { true, true, true, true } })

struct kd_align_params {
    unsigned solve;    /* bits KD_ALIGN_... of the quantities to search for */
    double most_shift; /* largest shift along each axis, radians */
    /* Function that computes the model's visibilities for a size and a rotation, without shift and scale. */
    void (*model)(void *user, double size, double angle_deg, double (*out)[2]);
    void *user;
};

/* Memory of a search. It needs no initialisation. */
struct kd_align_vertex { double at[2], value; };
struct kd_align_room {
    struct kd_align_vertex grid[KD_ALIGN_SIZES * KD_ALIGN_ANGLES];
    double shift[KD_ALIGN_SHIFTS * KD_ALIGN_SHIFTS];
};

/* Upper bound of the number of evaluations of the model in a search. */
unsigned kd_align_evaluations(unsigned solve);
/* Runs the search. On entry, out->scale is the scale that is used if the flux is not solved for. On return, *out is the
 * result, and model[i] is the model's visibility for this result, with the shift but without the scale. */
void kd_align(const struct kd_comparison *comparison, const struct kd_align_params *params, struct kd_align_room *room,
              double (*model)[2], struct kd_alignment *out);
/* Shifts a model. east, north: shift in radians. */
void kd_align_shift(const struct kd_comparison *comparison, double east, double north, double (*model)[2]);

#endif
