/* Laws of limb darkening: the intensity that a disk's surface emits, as a function of the cosine mu of the angle from
 * its normal in the gas's frame. Pictures, line profiles and spectra use the same laws. Pure functions, any thread. */
#ifndef KD_PHYSICS_DISK_LIMB_H
#define KD_PHYSICS_DISK_LIMB_H

/* Laws f(mu). ISOTROPIC: 1. LAOR: 1 + 2.06 mu (Laor 1991, ApJ 376, 90). HAARDT: ln(1 + 1/mu) (Haardt 1993, ApJ 413,
 * 680). SCATTERING: the law of a deep atmosphere of free electrons (scattering.h). */
enum kd_limb { KD_LIMB_ISOTROPIC, KD_LIMB_LAOR, KD_LIMB_HAARDT, KD_LIMB_SCATTERING };

/* f for mu from 0 to 1. The first call for KD_LIMB_SCATTERING makes a table, which takes some milliseconds. Values from
 * this table differ from those of scattering.h by less than 1e-8. */
double kd_limb_at(enum kd_limb law, double mu);

/* Factor by which f is multiplied so that the integral of f mu dmu is 1/2. The surface then radiates the same total as
 * an isotropic one. */
double kd_limb_scale(enum kd_limb law);

#endif
