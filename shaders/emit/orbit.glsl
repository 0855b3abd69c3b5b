/* Redshift of gas on circular orbits outside the ISCO.
 *
 *   g = nu_obs / nu_em = 1 / (u^t (E - Omega L)),   E, L per unit of energy that the observer measures,
 *   u^t = (1 + a r^-3/2) / sqrt(1 - 3/r + 2a r^-3/2),   Omega = 1/(r^3/2 + a)      (Bardeen, Press & Teukolsky 1972)
 *
 * With charge q, and s^2 = r - q^2, sigma = s - a, P^2 = Delta - sigma^2 as in src/physics/spacetime/kerr.h, these are
 *
 *   u^t = (r^2 + a s) / (r P),   Omega = s / (r^2 + a s). */
#ifndef KD_BLOCK_orbit
#define KD_BLOCK_orbit(F, U, A)
#define KD_TRAIT_DOPPLER 2u  /* emitters on orbits: g includes the factor 1 / (E - Omega L) */
#define KD_TRAIT_REDSHIFT 4u /* emitters on orbits: g includes the factor 1 / u^t */
#endif

#ifdef KD_EMIT_CODE
/* g r^(-3/4) at r = 1/w. It multiplies T r^(3/4) of the disk's table, which gives g T. */
float kd_orbit_cooled(float w, float energy, float momentum, uint traits)
{
    /* The factor x^3 in P^2 (kd_circle_at) cancels against r^(-3/4). */
    kd_circle at = kd_circle_at(w, emission.frame.one_minus_a);
    float r = 1.0 / w, x = sqrt(r), x3 = r * x, all = at.all, rest = at.rest;
    bool doppler = (traits & KD_TRAIT_DOPPLER) != 0u, redshift = (traits & KD_TRAIT_REDSHIFT) != 0u;
    float under = doppler ? all * energy - momentum : FINITE ? all * energy : all;
    return redshift ? sqrt(max(rest, 0.0)) / under : inversesqrt(x3) * all / under;
}

/* The redshift factor g. */
float kd_orbit_shift(float w, float energy, float momentum, uint traits)
{
    float r = 1.0 / w;
    return kd_orbit_cooled(w, energy, momentum, traits) * sqrt(r * sqrt(r));
}
#endif
