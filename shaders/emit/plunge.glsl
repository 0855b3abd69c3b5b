/* Light of gas that plunges from the ISCO with its energy E and angular momentum L: src/render/emit/plunging.h for the parcels it
 * comes in.
 *
 * A grey body of one temperature, seen through by its optical depth, which is as its surface density, 1/(r |u^r|) times the
 * particles over those expected. With W = (r^2 + a^2 - aL/E) E/r^2 of the gas and of the light, D = Delta/r^2, J = L - aE,
 *   u^r = -sqrt(2/(3 r0)) (r0/r - 1)^(3/2),   r0 the ISCO's radius     (Mummery & Balbus 2022, arXiv:2209.03579)
 *   1/g = -p.u = (W W' - w' u^r)/D - J J'/r^2 ,                         (Carter 1968)
 * the primed ones and w', which is positive where a ray traced back goes in and the light comes out, the light's. Part of
 * transfer.comp. */
#ifndef KD_PLUNGE_GLSL
#define KD_PLUNGE_GLSL

/* On the grid of phases and azimuths at the ISCO: what is here now, or was a time `ago`. */
kd_place plunge_place(float w, float turn, float ago)
{
    float way = (log2((tr.r_isco * w - 1.0) / (1.0 - w / cam.horizon)) - tr.plunge_log) * tr.plunge_step;
    uint k = min(uint(max(way, 0.0)), KD_PLUNGE_TABLE - 2);
    vec2 at = mix(tables.plunge_table[k], tables.plunge_table[k + 1], clamp(way - float(k), 0.0, 1.0));
    float row = (at.x + ago * tr.plunge_laps) * float(tr.lap_rows) + float(tr.lead_rows);
    turn += ago * tr.plunge_turns - at.y;
    return kd_place(tr.plunge_at, tr.plunge_rows, tr.plunge_columns, clamp(row, 0.0, float(tr.plunge_rows)), turn, turn);
}

/* Seen at w = 1/r by a ray that goes on with dw = w', where there is this number of particles over that expected. */
kd_gas plunge_gas(float w, float dw, float energy, float momentum, float number)
{
    float a = cam.spin, w2 = w * w, d = kd_delta(w, cam.root);
    float gap = max(tr.r_isco * w - 1.0, 1e-12), ur = -sqrt(gap * (2.0 / 3.0) / tr.r_isco) * gap;
    float own = tr.plunge_energy - a * tr.plunge_j * w2, g = 1.0;
    if (DOPPLER) {
        float j = momentum - a * energy;
        g = 1.0 / max(((energy - a * j * w2) * own - dw * ur) / d - j * tr.plunge_j * w2, 1e-20);
    } else if (FINITE) {
        g = 1.0 / energy;
    }
    if (DOPPLER != REDSHIFT) { /* one factor without the other */
        float ut = (1.0 + a * a * w2) * own / d + a * tr.plunge_j * w2;
        g *= REDSHIFT ? 1.0 / ut : ut;
    }
    return kd_gas(tr.plunge_temperature * g, tr.opacity * (1.0 - exp(tr.plunge_depth * w * number / ur)));
}

#endif
