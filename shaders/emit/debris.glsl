/* Debris that tides have torn off bodies, as an emitter: a density on the plane of the disk
 * (src/scene/dynamic_bodies.h, src/playground/show.h).
 *
 * Where the column density is S bodies per M^2, debris is a black body of one temperature with an optical depth D S.
 * Debris moves with its local mean velocity (v_r, v_phi) relative to the observer of zero angular momentum there
 * (Bardeen, Press & Teukolsky 1972). In the equatorial plane, with A = (r^2 + a^2)^2 - a^2 Delta, lapse^2 is r^2
 * Delta/A, g_rr = r^2/Delta, g_phiphi = A/r^2, the dragging 2ar/A, and
 *
 *   1/g = gamma ((E - dragging L)/lapse - v_r p_r/sqrt(g_rr) - v_phi L/sqrt(g_phiphi)),
 *   light = (1 - exp(-D S)) B(g T). */
#ifndef KD_BLOCK_debris
/* clang-format off */
#define KD_BLOCK_debris(F, U, A) \
    U(turn) U(rows) U(columns) /* numbers of nodes in a whole turn, of rows, and of nodes in a row */ \
    F(first_row) F(first_column) F(rows_octave) /* log2 r of the first row; first azimuth; rows per doubling of r */ \
    F(depth)                /* D, the optical depth for one body per M^2, divided by a node's area at r = 1 */ \
    F(temperature)              /* temperature, relative to the disk's largest */
/* clang-format on */
#define KD_TABLES_debris(T)
#define KD_TRAITS_debris(T) T(VISIBLE)
#define KD_BUFFERS_debris(B) \
    B(4, floats, debris) /* three numbers for each node: its matter, in bodies; matter times v_r; matter times v_phi \
                          */
#define KD_PASS_debris(P)
#endif

#ifdef KD_EMIT_CODE
vec3 kd_debris_node(uint row, uint column)
{
    uint at = 3u * (row * emission.debris.columns + (column == emission.debris.columns ? 0u : column));
    return vec3(KD_OWN_FLOAT(debris, at), KD_OWN_FLOAT(debris, at + 1u), KD_OWN_FLOAT(debris, at + 2u));
}

/* Values at a place, bilinear between the nodes; 0 outside the grid. */
vec3 kd_debris_at(float row, float turn)
{
    float turns = float(emission.debris.turn), columns = float(emission.debris.columns),
          from = turn - emission.debris.first_column / turns;
    float column = (from - floor(from)) * turns;
    bool round_ = emission.debris.columns == emission.debris.turn;
    if (!(row >= 0.0 && row <= float(emission.debris.rows - 1u)) || !(round_ || column <= columns - 1.0))
        return vec3(0.0);
    uint i = min(uint(row), emission.debris.rows - 2u),
         j = min(uint(column), emission.debris.columns - (round_ ? 1u : 2u));
    float right = column - float(j);
    return mix(mix(kd_debris_node(i, j), kd_debris_node(i, j + 1u), right),
               mix(kd_debris_node(i + 1u, j), kd_debris_node(i + 1u, j + 1u), right), row - float(i));
}

/* 1/g of matter with the velocity v = (v_r, v_phi). */
float kd_debris_shift(kd_sample s, vec2 v)
{
    kd_place at = kd_place_at(s.w, 0.0, 1.0);
    float delta = max(at.delta, 1e-12), lapse = sqrt(delta / at.area), gamma = inversesqrt(max(1.0 - dot(v, v), 1e-6));
    float along = s.slope * inversesqrt(delta), round_ = s.momentum * s.w * inversesqrt(at.area);
    return max(gamma * ((s.energy - at.omega * s.momentum) / lapse - v.x * along - v.y * round_), 1e-6);
}

kd_glow kd_debris_glow(kd_sample s)
{
    float row = -log2(s.w) * emission.debris.rows_octave - emission.debris.first_row;
    vec3 here = kd_debris_at(row, (s.phi + emission.frame.azimuth) * (0.5 / KD_PI));
    if (!(here.x > 0.0))
        return kd_glow(vec3(0.0), 0.0, 0.0);
    float alpha = 1.0 - exp(-min(emission.debris.depth * here.x * s.w * s.w, 80.0));
    float t = emission.debris.temperature / kd_debris_shift(s, here.yz / here.x);
    return kd_glow(alpha * min(kd_black_body(min(t, 1e6), TRAITS_debris), 1e30), alpha, 0.0);
}
#endif
