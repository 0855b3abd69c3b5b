/* Gas that plunges from the ISCO with the energy E and angular momentum L of the orbit there.
 * src/render/emit/plunging.h describes its parcels.
 *
 * The gas is a grey body of one temperature. Its optical depth is proportional to its surface density: 1/(r |u^r|)
 * times the ratio of the number of particles to the expected number. With W = (r^2 + a^2 - aL/E) E/r^2 of the gas and
 * of the light, D = Delta/r^2, J = L - aE,
 *
 *   (u^r)^2 = 2/(3 r0) gap^3 (stretch - bend gap),   gap = r0/r - 1,   r0 the ISCO's radius
 *                                                (Mummery & Balbus 2022, arXiv:2209.03579; physics/orbit/plunge.c)
 *   1/g = -p.u = (W W' - w' u^r)/D - J J'/r^2 ,                         (Carter 1968)
 *
 * where primed quantities are those of the light. w' is positive where a ray traced back goes inwards, so that the
 * light comes outwards. */
#ifndef KD_BLOCK_plunge
#define KD_PLUNGE_TABLE 512
/* clang-format off */
#define KD_BLOCK_plunge(F, U, A) \
    F(first) F(last)       /* w = 1/r at the start and at the end of the plunge */ \
    F(energy) F(j)         /* constants of the gas: E, and L - aE */ \
    F(stretch) F(bend)     /* stretch and bend of the formula above; 1 and 0 without charge */ \
    F(temperature)         /* temperature, relative to the disk's largest */ \
    F(depth)               /* optical depth of the expected number of particles where r |u^r| = 1 */ \
    F(log_first) F(step_)  /* argument of the table's first entry; number of entries per unit of the argument */ \
    F(laps) F(turns)       /* fraction of the plunge, and turns at the ISCO, per M of time */ \
    U(at)                  /* offset of this grid in the buffer, after the grid of the other particles */ \
    U(rows) U(columns) \
    U(lap_rows) U(lead_rows) /* number of rows from the plunge's start to its end; number of rows before the start */
/* clang-format on */
#define KD_TABLES_plunge(T) \
    T(plunge, KD_PLUNGE_TABLE) /* phase and azimuth, in turns, as functions of log2 (r_isco - r)/(r - r+) */
#define KD_TRAITS_plunge(T) KD_TRAITS_disk(T)
#define KD_BUFFERS_plunge(B)
#define KD_PASS_plunge(P)
#endif

#ifdef KD_EMIT_CODE
/* Place on the grid of phases and azimuths at the ISCO. With slow light the matter is shown as it was at the time `ago`
 * before now; otherwise as it is now. */
kd_density_place kd_plunge_place(kd_sample s, float turn)
{
    float way = log2((emission.frame.r_isco * s.w - 1.0) / (1.0 - s.w / cam.horizon));
    way = (way - emission.plunge.log_first) * emission.plunge.step_;
    uint k = min(uint(max(way, 0.0)), KD_PLUNGE_TABLE - 2);
    vec2 at = mix(kd_table_row(plunge, k).xy, kd_table_row(plunge, k + 1).xy, clamp(way - float(k), 0.0, 1.0));
    float ago = (TRAITS_particles & KD_TRAIT_SLOW) != 0u ? s.ago : 0.0;
    float row =
        (at.x + ago * emission.plunge.laps) * float(emission.plunge.lap_rows) + float(emission.plunge.lead_rows);
    turn += ago * emission.plunge.turns - at.y;
    row = clamp(row, 0.0, float(emission.plunge.rows));
    return kd_density_place(emission.plunge.at, emission.plunge.rows, emission.plunge.columns, row, turn, turn);
}

/* u^r of the gas. */
float kd_plunge_speed(float w)
{
    float r0 = emission.frame.r_isco, gap = max(r0 * w - 1.0, 1e-12);
    return -sqrt(gap * (2.0 / 3.0) / r0 * (emission.plunge.stretch - emission.plunge.bend * gap)) * gap;
}

/* The shift g due to the Doppler effect, to gravity, or to both. */
float kd_plunge_shift(kd_sample s, bool doppler, bool redshift)
{
    float a = cam.spin, w2 = s.w * s.w, d = kd_delta(s.w, cam.root);
    float own = emission.plunge.energy - a * emission.plunge.j * w2, g = 1.0;
    if (doppler) {
        float j = s.momentum - a * s.energy;
        g = 1.0 / max(((s.energy - a * j * w2) * own - s.slope * kd_plunge_speed(s.w)) / d - j * emission.plunge.j * w2,
                      1e-20);
    } else if (FINITE) {
        g = 1.0 / s.energy;
    }
    if (doppler != redshift) {
        float ut = (1.0 + a * a * w2) * own / d + a * emission.plunge.j * w2;
        g *= redshift ? 1.0 / ut : ut;
    }
    return g;
}

/* The gas as the observer sees it. number: ratio of the number of particles to the expected number. */
kd_gas kd_plunge_gas(kd_sample s, float number)
{
    float g = kd_plunge_shift(s, (TRAITS_plunge & KD_TRAIT_DOPPLER) != 0u, (TRAITS_plunge & KD_TRAIT_REDSHIFT) != 0u);
    float depth = emission.plunge.depth * s.w * number / kd_plunge_speed(s.w);
    return kd_gas(emission.plunge.temperature * g, emission.disk.opacity * (1.0 - exp(depth)));
}

/* True if the gas at a crossing plunges. */
bool kd_plunge_falls(kd_sample s)
{
    return KD_HAS(plunge) && s.w >= emission.plunge.first && s.w <= emission.plunge.last;
}
#endif
