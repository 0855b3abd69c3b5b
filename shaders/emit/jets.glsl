/* Two stylised jets: optically thin light in cones along the spin axis. Their matter moves radially outwards at one
 * speed relative to observers of zero angular momentum (Bardeen, Press & Teukolsky 1972). In the frame of these
 * observers a photon has the energy and radial momentum
 *
 *   e = (E - omega L) sqrt(A/(Sigma Delta)),   k_r = p_r sqrt(Delta/Sigma),
 *
 * and in the frame of the matter the energy -k.U = Gamma (e - beta k_r).
 *
 * A spectrum j_nu ~ nu^-alpha keeps its shape under a shift, and j_nu/nu^2 is invariant. Per unit of the observer's
 * affine parameter the emitted light is therefore g^(2 + alpha) j with g = 1/(-k.U). The factor is the D^(2 + alpha) of
 * a steady jet (Lind & Blandford 1985, ApJ 295, 358).
 *
 * Across the jet, with x = tan(theta)/tan(opening), light has the profile of a spine, (1 - x^2)^2, and of a sheath,
 * 27/4 x^2 (1 - x^2)^2. Along the jet it has the profile (r/inner)^-falloff, with smooth ends. */
#ifndef KD_BLOCK_jets
#define KD_JETS_RISE 0.5 /* fraction of the inner radius over which light rises */
#define KD_JETS_FADE 0.3 /* fraction of the outer radius over which light fades */
/* clang-format off */
#define KD_BLOCK_jets(F, U, A) \
    F(inner) F(outer)      /* M */ \
    F(cot)                 /* 1/tan of the opening angle */ \
    F(tan_)                /* tangent of the opening angle */ \
    /* log2 of the light per M of length at the spine's inner edge, in units of the disk's largest surface \
     * brightness */ \
    F(brightness) \
    F(sheath)              /* fraction of the light that comes from the sheath, 0 to 1 */ \
    F(falloff) F(power)    /* falloff: exponent of the profile along the jet. power: 2 + alpha */ \
    F(gamma) F(gamma_beta) \
    F(counter)             /* ratio of the lower jet's light to the upper jet's */ \
    F(temperature)         /* temperature, K, of a black body of the light's colour */
/* clang-format on */
#define KD_TABLES_jets(T)
#define KD_TRAITS_jets(T)
#define KD_BUFFERS_jets(B)
#define KD_PASS_jets(P)
#endif

#ifdef KD_EMIT_CODE
/* The photon's energy -k.U in the frame of the matter, computed without a difference of nearly equal numbers. For light
 * along the jet, e - k_r is across^2/(e + k_r), with across^2 = k_theta^2 + k_phi^2 = (p_theta^2 + L^2 Sigma^2/(A
 * sin^2))/Sigma. By p_theta^2 = Q + a^2 E^2 u^2 - L^2 u^2/sin^2 and A = (r^2 + a^2)^2 - a^2 Delta sin^2 this has no
 * sine in a denominator: Sigma across^2 = Q + L^2 + a^2 E^2 u^2 - L^2 a^2 (Sigma + 2r - q^2)/A. */
float kd_jets_energy(kd_midst p)
{
    kd_place at = kd_place_at(p.w, p.u, 1.0 - p.u * p.u);
    float e = (p.energy - at.omega * p.momentum) * sqrt(at.area / (at.sigma * at.delta)),
          k = p.dw * inversesqrt(at.delta * at.sigma);
    float ae = cam.spin * p.energy, l2 = p.momentum * p.momentum,
          across = p.w * p.w / at.sigma *
                   max(p.q + l2 + ae * ae * p.u * p.u - l2 * at.aw2 * (at.sigma + kd_mass_term(p.w)) / at.area, 0.0);
    float along =
        emission.jets.gamma * across / (e + abs(k)) + abs(k) / (emission.jets.gamma + emission.jets.gamma_beta);
    return max(k > 0.0 ? along : emission.jets.gamma * e - emission.jets.gamma_beta * k, 1e-30);
}

kd_medium kd_jets_along(kd_midst p)
{
    float r = 1.0 / p.w, c = abs(p.u), s = sqrt(max(1.0 - p.u * p.u, 0.0)),
          x = min(s / max(c, 1e-6) * emission.jets.cot, 1e6);
    float inner = emission.jets.inner, outer = emission.jets.outer, width = r * emission.jets.tan_;
    float in_cone = max(1.0 - x * x, 0.0),
          across = in_cone * in_cone * (1.0 - emission.jets.sheath + emission.jets.sheath * 6.75 * x * x);
    float up = clamp((r - inner) / (KD_JETS_RISE * inner), 0.0, 1.0),
          down = clamp((outer - r) / (KD_JETS_FADE * outer), 0.0, 1.0);
    float along = up * up * (3.0 - 2.0 * up) * down * down * (3.0 - 2.0 * down);
    /* Both powers and the brightness are computed as one exponential, because separate factors could overflow even if
     * their product is 1: the 12th power of g may be 2^92, and the 10th power of r/inner 2^199. */
    float light = exp2(clamp(emission.jets.brightness - emission.jets.falloff * log2(r / inner) -
                                 emission.jets.power * log2(kd_jets_energy(p)),
                             -126.0, 120.0));
    float side = p.u > 0.0 ? 1.0 : emission.jets.counter;
    light *= side * across * along;
    /* Outside the jet the grain is the distance to the cone. It is at least the grain that the cone's smooth edge
     * needs. */
    float away =
        max(r * (s - c * emission.jets.tan_) * inversesqrt(1.0 + emission.jets.tan_ * emission.jets.tan_), 0.0);
    float grain = min(max(away, 0.25 * width), r);
    return kd_medium(light * kd_colour_of(kd_colour_at(emission.jets.temperature)), 0.0, grain);
}
#endif
