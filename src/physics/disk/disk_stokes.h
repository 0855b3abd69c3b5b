/* Polarised spectrum of a thin disk of electron-scattering atmospheres, as a distant observer receives it (J. D.
 * Schnittman & J. H. Krolik 2009, ApJ 701, 1175). Double precision; any thread.
 *
 * Each ring shines as a dilute black body with the angular law and the polarisation of a deep atmosphere of free
 * electrons (scattering.h). If `scattered` is true, light that returns to the disk for the first time is reflected by
 * this atmosphere's law of diffuse reflection. Reflection changes no photon's energy in the gas's frame. Polarisation
 * is carried along the ray to the disk and along the ray to the observer by the constant of M. Walker & R. Penrose
 * 1970, Commun. Math. Phys. 18, 265. The constant is computed from components in Carter's frame, as in
 * shaders/emit/polarization.glsl.
 *
 * All light is a sum of black bodies. Nodes are evenly spaced in the logarithm of the temperature that the observer
 * sees. Each black body is shared among four neighbouring nodes with the weights of cubic interpolation. The spectrum
 * at a frequency is a sum over the nodes. */
#ifndef KD_PHYSICS_DISK_DISK_STOKES_H
#define KD_PHYSICS_DISK_DISK_STOKES_H

#include "physics/disk/disk_spectrum.h"

enum { KD_STOKES_NODES = 640 };

/* Stokes I, Q and U by the IAU convention of 1973: angles count from north, the projected axis of the disk, to the
 * east. */
struct kd_disk_iqu { double i, q, u; };

struct kd_disk_stokes {
    double hottest_k, scale; /* colour temperature at ln T = 0, K; unit of the fluxes */
    struct kd_disk_iqu direct[KD_STOKES_NODES], scattered[KD_STOKES_NODES];
};

/* Computes the parts of the spectrum. params->limb must be KD_LIMB_SCATTERING. If params->returning is given, the
 * disk's flux includes the light that returns, and `scattered` must be false. Takes some 0.1 s, or 1 s with
 * `scattered`. */
enum kd_status kd_disk_stokes_init(struct kd_disk_stokes *stokes, const struct kd_disk_image *image,
                                   const struct kd_disk_spectrum_params *params, bool scattered,
                                   struct kd_error *error);

/* The spectrum at a frequency in Hz, in W m^-2 Hz^-1. */
struct kd_disk_iqu kd_disk_stokes_at(const struct kd_disk_stokes *stokes,
                                     const struct kd_disk_iqu nodes[KD_STOKES_NODES], double frequency);

#endif
