#include "physics/spacetime/hole.h"
#include "quantity/define.h"

#include "physics/spacetime/scale.h"
#include "physics/waves/qnm.h"
#include "physics/waves/ringdown.h"

#include <stdlib.h>

#define PARAMETERS(P) \
    P(l, .unit = "1", .typed = "2", .least = KD_QNM_L_MIN, .most = KD_QNM_L_MAX, .kind = KD_KIND_INT, \
      .help = "multipole") \
    P(m, .unit = "1", .typed = "2", .least = -KD_QNM_L_MAX, .most = KD_QNM_L_MAX, .kind = KD_KIND_INT, \
      .help = "azimuthal number, -l to l; m > 0 turns with a hole of positive spin") \
    P(n, .unit = "1", .typed = "0", .least = 0, .most = KD_QNM_N_MAX, .kind = KD_KIND_INT, \
      .help = "overtone number, as labelled at spin 0; n = 0 decays most slowly") \
    P(spin, .unit = "M", .typed = "0.7", .least = -KD_QNM_SPIN_MAX, .most = KD_QNM_SPIN_MAX, \
      .help = "spin parameter a; closer to 1, damped and undamped modes crowd together and l, n no longer label them " \
              "uniquely") \
    P(mass_msun, .unit = "solar masses", .typed = "60", .least = 1e-3, .most = 1e12, \
      .help = "mass of the hole, with any redshift: m (1 + z)") \
    P(t, .unit = "M", .typed = "0", .least = 0, .most = 1e6, .help = "time at which `wave` is computed") \
    P(shift_octaves, .unit = "1", .typed = "0", .least = -40, .most = 40, \
      .help = \
          "octaves by which the sound is higher than the ringing; the sound also decays faster by the same factor") \
    P(stretch, .unit = "1", .typed = "1", .least = 1, .most = 1e6, \
      .help = "factor by which the decay of the shifted sound is slowed down, at the same pitch")
#define OUTPUTS(O) \
    O(omega_re, .unit = "1/M", .fixed = true, .help = "angular frequency") \
    O(omega_im, .unit = "1/M", .fixed = true, .help = "imaginary part of the frequency, minus the damping rate") \
    O(separation_re, .unit = "1", .fixed = true, .help = "separation constant A_lm(a omega), l(l+1) - 2 at spin 0") \
    O(separation_im, .unit = "1", .fixed = true, .help = "imaginary part of the separation constant") \
    O(quality, .unit = "1", .fixed = true, .help = "Q = omega_re/(-2 omega_im)") \
    O(quality_cubic, .unit = "1", .fixed = true, \
      .help = "quality factor by 2.1 + 11.3 a^3, a common formula for l = m = 2, n = 0; null for other modes") \
    O(quality_cubic_error, .unit = "1", .fixed = true, .help = "relative error of quality_cubic") \
    O(fit_omega_re, .unit = "1/M", .fixed = true, \
      .help = "omega_re by the fit of Berti et al. 2006 for l = m = 2, n = 0 to 2; null for other modes") \
    O(fit_quality, .unit = "1", .fixed = true, .help = "quality factor by that fit") \
    O(fit_omega_re_error, .unit = "1", .fixed = true, .help = "relative error of fit_omega_re") \
    O(fit_quality_error, .unit = "1", .fixed = true, .help = "relative error of fit_quality") \
    O(frequency_hz, .unit = "Hz", .help = "omega_re/(2 pi) for mass_msun") \
    O(damping_s, .unit = "s", .help = "time in which the amplitude falls by a factor e") \
    O(t_s, .unit = "s", .help = "t for mass_msun") \
    O(wave, .unit = "1", .help = "e^(omega_im t) cos(omega_re t)") \
    O(sound_hz, .unit = "Hz", .help = "frequency of the WAV file: frequency_hz shifted by shift_octaves") \
    O(sound_damping_s, .unit = "s", \
      .help = "damping time of the WAV file: damping_s shifted by shift_octaves, times stretch")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "S. A. Teukolsky 1973, ApJ 185, 635; E. W. Leaver 1985, Proc. R. Soc. Lond. A 402, 285 (continued fractions)",
    "H.-P. Nollert 1993, Phys. Rev. D 47, 5253 (remainder of the continued fractions)",
    "S. R. Dolan & A. C. Ottewill 2009, Class. Quantum Grav. 26, 225003 (start at spin 0)",
    "fit: E. Berti, V. Cardoso & C. M. Will 2006, Phys. Rev. D 73, 064030, table VIII",
    "quality_cubic: no source is known; it is given for comparison",
    NULL,
};
static const char *const approximations[] = {
    "the perturbation is of first order, and consists only of gravitational waves (spin weight -2)",
    "wave is a single mode with amplitude 1 and phase 0, not a signal",
    NULL,
};

static void fill_fits(const struct parameters *p, struct outputs *o)
{
    double a = fabs(p->spin);
    bool with = p->l == 2 && p->m == (p->spin < 0 ? -2 : 2);
    struct kd_ringdown_fit fit = kd_ringdown_fit(with ? (int)p->n : -1, kd_hole(a));
    o->quality_cubic = with && p->n == 0 ? kd_ringdown_quality_cubic(kd_hole(a)) : NAN;
    o->quality_cubic_error = o->quality_cubic / o->quality - 1;
    o->fit_omega_re = fit.omega_re;
    o->fit_quality = fit.quality;
    o->fit_omega_re_error = fit.omega_re / o->omega_re - 1;
    o->fit_quality_error = fit.quality / o->quality - 1;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    (void)memory;
    if (fabs(p->m) > p->l)
        return kd_quantity_outside(error, "m", p->m, "; with l %g it must be -%g to %g", p->l, p->l, p->l);
    if (fresh) {
        struct kd_qnm mode;
        if (!kd_qnm_find((int)p->l, (int)p->m, (int)p->n, kd_hole(p->spin), &mode))
            return kd_quantity_outside(
                error, "spin", p->spin,
                "; it must be different, because the iteration for this mode does not converge there");
        o->omega_re = creal(mode.omega), o->omega_im = cimag(mode.omega);
        o->separation_re = creal(mode.separation), o->separation_im = cimag(mode.separation);
        o->quality = kd_ringdown_quality(mode.omega);
        fill_fits(p, o);
    }
    double unit = kd_scale_seconds(p->mass_msun);
    o->frequency_hz = o->omega_re / (2 * M_PI * unit);
    o->damping_s = -unit / o->omega_im;
    o->t_s = p->t * unit;
    o->wave = kd_ringdown_wave(o->omega_re + I * o->omega_im, p->t);
    o->sound_hz = o->frequency_hz * exp2(p->shift_octaves);
    o->sound_damping_s = o->damping_s * exp2(-p->shift_octaves) * p->stretch;
    return KD_OK;
}

KD_QUANTITY(qnm, "qnm", "quasi-normal modes of a Kerr hole, and its ringdown", .along = 4, .point_us = 1,
            .fresh_us = 1500, .sound = true)
