/* Gravitational quasi-normal modes of Kerr (spin weight s = -2), fields ~ exp(i m phi - i omega t). Double
 * precision, pure functions, any thread. Units G = c = M = 1.
 *
 *   Teukolsky's equation 1973, ApJ 185, 635, with no wave from the horizon and none from infinity, separates into
 *   S(cos theta) with eigenvalue A_lm(a omega) and R(r). Both are solved by series with three-term recurrences. omega
 *   is a zero of the continued fraction of the radial recurrence.
 *
 * Sources: E. W. Leaver 1985, Proc. R. Soc. Lond. A 402, 285, eqs. 18-27 (recurrences, inversion of the fraction for
 * the overtone n); H.-P. Nollert 1993, Phys. Rev. D 47, 5253 (remainder of the fraction after its last term); S. R.
 * Dolan & A. C. Ottewill 2009, Class. Quantum Grav. 26, 225003 (the first guess at a = 0). From there a mode is
 * followed in spin, so that l and n keep their meaning at a = 0.
 *
 * omega has Re > 0 and Im < 0; the mirror modes are -conj(omega) at -m. A is Leaver's separation constant, l(l+1) - 2
 * at a = 0. A spin a < 0 is that of the hole turned over: omega(-a, m) = omega(a, -m). For m > 0 and a > 0 the mode
 * rotates with the hole. The domain is 2 <= l <= 4, |m| <= l, 0 <= n <= 3 and |a| <= 0.9999, where fewer than 1e5 terms
 * suffice. Beyond this spin the damped and the undamped modes of m > 0 crowd together at omega = m/2 (Yang et al. 2013,
 * Phys. Rev. D 87, 041502), and l and n no longer identify them. Relative errors of omega and A, as complex numbers,
 * measured against another method (tests/oracle/qnm_reference.py): below 1e-13 up to a = 0.99, 1e-12 up to 0.999;
 * beyond, rounding leaves 1e-10 for the overtones of l = 4. */
#ifndef KD_PHYSICS_WAVES_QNM_H
#define KD_PHYSICS_WAVES_QNM_H

#include "physics/spacetime/hole.h"

#include <complex.h>
#include <stdbool.h>

enum { KD_QNM_L_MIN = 2, KD_QNM_L_MAX = 4, KD_QNM_N_MAX = 3 };
#define KD_QNM_SPIN_MAX 0.9999

struct kd_qnm {
    double complex omega;      /* frequency omega, 1/M */
    double complex separation; /* separation constant A_lm, a pure number */
};

/* A mode that is followed in spin. Moving to a nearby spin is cheap, 20 to 200 us, so one branch should be used for a
 * whole curve.
 */
struct kd_qnm_branch {
    int l, m, n;
    double a; /* spin, >= 0; the sign of m expresses a negative spin */
    struct kd_qnm at;
    double step; /* next step in the variable -ln(1 - a) */
    int points;  /* number of stored points for extrapolation */
    double y[3];
    struct kd_qnm past[3];
};

/* Begins a branch at a = 0. Returns false if (l, m, n) is outside the domain. */
bool kd_qnm_start(struct kd_qnm_branch *branch, int l, int m, int n);

/* Moves the branch to the hole's spin, which must be >= 0. Returns false if the spin is outside the domain or the
 * iteration fails; the branch is then at the last spin reached. */
bool kd_qnm_move(struct kd_qnm_branch *branch, const struct kd_hole *hole);

/* Finds a mode by kd_qnm_start and kd_qnm_move, for a spin of either sign. On failure it returns false, and *mode is
 * NAN. */
bool kd_qnm_find(int l, int m, int n, const struct kd_hole *hole, struct kd_qnm *mode);

#endif
