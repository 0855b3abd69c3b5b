/* A uniform shell of matter about the hole: in its own frame, emission and absorption per length are the same
 * everywhere. The matter is at rest for observers of zero angular momentum (Bardeen, Press & Teukolsky 1972), who
 * measure the energy
 *
 *   -k.U = (E - omega L) sqrt(A/(Sigma Delta)),   omega = 2 a r/A,   A = (r^2 + a^2)^2 - a^2 Delta sin^2(theta).
 *
 * If the redshift is switched off, the frequencies of the matter are taken as those of the observer. Lengths are then
 * those of the affine parameter, which has a closed form. */
#ifndef KD_BLOCK_volume
/* clang-format off */
#define KD_BLOCK_volume(F, U, A) \
    F(inner) F(outer)      /* M */ \
    F(emissivity)          /* emission per unit of length, 1/M; the unit is the disk's largest surface brightness */ \
    F(opacity)             /* optical depth per unit of length, 1/M */ \
    F(temperature)         /* temperature, K, of a black body of the light's colour */
/* clang-format on */
#define KD_TABLES_volume(T)
#define KD_TRAITS_volume(T) T(REDSHIFT)
#define KD_BUFFERS_volume(B)
#define KD_PASS_volume(P)
#endif

#ifdef KD_EMIT_CODE
/* The photon's energy -k.U, as an observer of zero angular momentum at the place measures it. */
float kd_volume_energy(kd_midst p)
{
    kd_place at = kd_place_at(p.w, p.u, 1.0 - p.u * p.u);
    return (p.energy - at.omega * p.momentum) * sqrt(at.area / (at.sigma * at.delta));
}

/* Least grain next to an edge of the shell, as a fraction of r. The march finds only the outer edges of all volumes
 * together, and the shell's edges may be inside other volumes. There a stretch is no longer than the distance to the
 * shell's edge, or than this fraction of r if that is longer. The fraction is the uncertainty of the shell's length at
 * accuracy `balanced`, and is smaller for finer stretches. */
#define KD_VOLUME_EDGE 2.5e-4
float kd_volume_grain(float r, float grain)
{
    float edge = min(abs(r - emission.volume.inner), abs(r - emission.volume.outer));
    return KD_VOLUMES > 1 ? min(grain, max(edge, KD_VOLUME_EDGE * r)) : grain;
}

kd_medium kd_volume_along(kd_midst p)
{
    bool shifts = (TRAITS_volume & KD_TRAIT_REDSHIFT) != 0u;
    float r = 1.0 / p.w, seen = shifts ? kd_volume_energy(p) : 1.0, g = 1.0 / max(seen, 1e-6);
    vec3 colour = kd_colour_of(kd_colour_at(g * emission.volume.temperature));
    kd_medium medium =
        kd_medium(min(emission.volume.emissivity * g * g * g, 1e30) * colour, emission.volume.opacity * seen,
                  kd_volume_grain(r, shifts ? 0.6 * (r - 1.0 / cam.horizon) : 1e30));
    if (r < emission.volume.inner || r > emission.volume.outer)
        return kd_medium(vec3(0.0), 0.0,
                         kd_volume_grain(r, max(max(emission.volume.inner - r, r - emission.volume.outer), 0.1 * r)));
    return medium;
}
#endif
