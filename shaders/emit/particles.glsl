/* The disk as particles: the brightness of the smooth disk is multiplied by the ratio of the number of particles to the
 * mean number (src/render/emit/particles.h). */
#ifndef KD_BLOCK_particles
/* clang-format off */
#define KD_BLOCK_particles(F, U, A) \
    U(rows) U(columns)     /* number of intervals along r; number of columns, a power of 2 */ \
    F(rows_octave)         /* number of rows in which r doubles */
/* clang-format on */
#define KD_TABLES_particles(T)
#define KD_TRAITS_particles(T) KD_TRAITS_disk(T) T(SLOW)
/* density relative to the expected one: on the disk's grid, then on the grid of plunge.glsl */
#define KD_BUFFERS_particles(B) B(0, floats, density)
#define KD_PASS_particles(P) P(particles, PARTICLE, "particle", 40)
#endif

#ifdef KD_EMIT_CODE
/* A place on one of the grids. The grid begins at node `first`. The place has a row with a fraction, and an azimuth in
 * turns for each of the two rows about it. */
struct kd_density_place {
    uint first, rows, columns;
    float row, before, after;
};

/* Number of turns by which matter that rotates with a row's Omega advances in the time `ago`, M. */
float kd_particles_ahead(uint row, float ago)
{
    float r = emission.disk.r_in * exp2(float(row) / emission.particles.rows_octave);
    return ago * (0.5 / KD_PI) / kd_circle_time(r);
}

kd_density_place kd_particles_place(kd_sample s, float turn)
{
    float rows = float(emission.particles.rows);
    float row = clamp(-log2(s.w * emission.disk.r_in) * emission.particles.rows_octave, 0.0, rows);
    kd_density_place o = kd_density_place(0, emission.particles.rows, emission.particles.columns, row, turn, turn);
    if ((TRAITS_particles & KD_TRAIT_SLOW) != 0u) {
        uint i = min(uint(row), emission.particles.rows - 1);
        o.before += kd_particles_ahead(i, s.ago);
        o.after += kd_particles_ahead(i + 1, s.ago);
    }
    return o;
}

float kd_density_of_row(kd_density_place at, uint row, float turn)
{
    float column = (turn - floor(turn)) * float(at.columns);
    uint j = uint(column), first = at.first + row * at.columns;
    return mix(KD_OWN_FLOAT(density, first + (j & (at.columns - 1))),
               KD_OWN_FLOAT(density, first + ((j + 1) & (at.columns - 1))), column - float(j));
}

/* Ratio of the number of particles to the expected number, bilinear between the nodes. */
float kd_density_at(kd_density_place at)
{
    uint i = min(uint(at.row), at.rows - 1);
    return mix(kd_density_of_row(at, i, at.before), kd_density_of_row(at, i + 1, at.after), at.row - float(i));
}

/* Azimuth of a crossing in turns, in the frame of the grids. */
float kd_sample_turn(kd_sample s) { return (s.phi + emission.frame.azimuth) * (0.5 / KD_PI); }

/* Defined in plunge.glsl. */
bool kd_plunge_falls(kd_sample s);
kd_density_place kd_plunge_place(kd_sample s, float turn);
kd_gas kd_plunge_gas(kd_sample s, float number);

/* Light of the particles. Orbiting and plunging particles (plunge.glsl) share one read of the grids and one evaluation
 * of the black body. */
kd_glow kd_particles_glow(kd_sample s)
{
    float turn = kd_sample_turn(s);
    bool falls = kd_plunge_falls(s);
    kd_density_place place = kd_particles_place(s, turn);
    kd_gas gas = kd_disk_gas(s, TRAITS_particles);
    if (falls)
        place = kd_plunge_place(s, turn);
    float number = kd_density_at(place);
    if (falls)
        gas = kd_plunge_gas(s, number);
    vec3 light = falls ? kd_black_body(gas.t, TRAITS_particles) : kd_disk_surface(gas.t, s, TRAITS_particles);
    return kd_glow(gas.alpha * (falls ? 1.0 : number) * light, gas.alpha, 0.0);
}
#endif
