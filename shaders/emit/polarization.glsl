/* Polarisation of light from gas in the plane. The constant of Walker & Penrose (1970) carries the direction of
 * polarisation along the ray. With F = k ^ f, where k is the light's wave vector and f the direction of its electric
 * field,
 *
 *   kappa = (A - i B)(r - i a cos(theta)),   A = k^t f^r - k^r f^t,   B = k^phi f^theta - k^theta f^phi
 *
 * is constant along the ray. The components are those in Carter's frame (Chandrasekhar 1983, section 60). For a vector
 * V they are
 *
 *   V^t = ((r^2 + a^2) E - a L)/sqrt(Delta Sigma),  V^r = sqrt(Delta/Sigma) V_r,  V^theta = V_theta/sqrt(Sigma),
 *   V^phi = (L/sin(theta) - a E sin(theta))/sqrt(Sigma),
 *
 * with E = -V_t and L = V_phi. In the equatorial plane the components that are needed, times sqrt(Delta/Sigma), are
 * finite wherever gas can be. At the observer, a quarter turn of f from right to up multiplies kappa by -i. So the
 * direction f = x right + y up satisfies x - i y = kappa/kappa(right). Therefore only kappa(right) is computed at the
 * observer.
 *
 * Stokes Q and U follow the IAU (1973): the angle of the electric field counts from the top of the picture, taken as
 * north, to its left, taken as east. */
#ifndef KD_BLOCK_polarization
/* polarised fraction as a function of sqrt(mu), with mu the cosine of emission: value in this row and in the next */
#define KD_SCATTERING_ROWS 128
/* polarised fraction: that of an ordered field, times the field's degree of order */
#define KD_BLOCK_polarization(F, U, A) F(fraction)
#define KD_TABLES_polarization(T) T(scattering, KD_SCATTERING_ROWS)
#define KD_TRAIT_SCATTERED \
    2u /* light scattered by electrons is polarised across the plane of light and normal; otherwise light is polarised \
        * by a field, across the plane of light and field */
#define KD_TRAIT_RADIAL 4u   /* the field is along the radius */
#define KD_TRAIT_VERTICAL 8u /* the field is along the normal. If neither trait is set, it is round the axis */
#define KD_TRAITS_polarization(T) T(SCATTERED) T(RADIAL) T(VERTICAL)
#define KD_BUFFERS_polarization(B)
#define KD_PASS_polarization(P)
#endif

#ifdef KD_EMIT_CODE
/* kappa of the unit vector that points right in the picture, up to a positive factor. place: place of the ray in the
 * picture. */
vec2 kd_polarization_right(uvec2 place)
{
    kd_ray k = kd_camera_ray(place.x, place.y);
    float a = cam.spin, s = cam.s;
    /* times r, kappa of the direction of alpha is alpha + a sin(theta) + i beta; kappa of the direction of beta is
     * -i times that */
    if (!FINITE) {
        vec2 alpha = vec2(a * s - k.l, k.p), right = vec2(cam.cxx, cam.cxy);
        return vec2(right.x * alpha.x + right.y * alpha.y, right.x * alpha.y - right.y * alpha.x);
    }
    vec3 c0 = vec3(cam.c0x, cam.c0y, cam.c0z), cx = vec3(cam.cxx, cam.cxy, cam.cxz),
         cy = vec3(cam.cyx, cam.cyy, cam.cyz);
    vec2 at = vec2(float(place.x) - cam.middle_x, cam.middle_y - float(place.y)), off = at;
    float ahead = kd_camera_ahead(off.x, off.y);
    vec3 look = normalize(ahead * c0 + off.x * cx + off.y * cy), up = cy;
    /* on a dome, `right` is transported from the middle along great circles, because this transport has no pole
     * there */
    if (SIGHT == KD_SIGHT_DOME) {
        float d = length(at);
        vec2 to = d > 0.0 ? at / d : vec2(0.0, 1.0), angle = kd_quarter_turns(d * cam.turn_x);
        up = to.y * (angle.x * (to.x * cx + to.y * cy) - angle.y * c0) + to.x * (to.x * cy - to.y * cx);
    }
    vec3 f = normalize(cross(look, up));
    float w2 = cam.w0 * cam.w0, aw2 = a * w2;
    float energy = cam.e_r * f.x + cam.e_theta * f.y + cam.e_phi * f.z,
          momentum = cam.l_r * f.x + cam.l_theta * f.y + cam.l_phi * f.z;
    float p = cam.p_r * f.x + cam.p_theta * f.y + cam.p_phi * f.z,
          dw = cam.dw_r * f.x + cam.dw_theta * f.y + cam.dw_phi * f.z;
    float a_t = k.e * (1.0 + a * aw2) - aw2 * k.l * s, f_t = energy * (1.0 + a * aw2) - aw2 * momentum * s;
    vec2 ab = vec2((a_t * dw - k.dw * f_t) / kd_delta(cam.w0, cam.root),
                   -w2 * ((k.l - a * k.e * s) * p - k.p * (momentum - a * energy * s)));
    float turn = -a * cam.u * cam.w0;
    return vec2(ab.x - turn * ab.y, ab.y + turn * ab.x);
}

/* Polarisation of light where it leaves the gas: the polarised fraction, and kappa of the electric field, up to a
 * positive or negative factor. */
struct kd_polarized {
    float fraction;
    vec2 kappa;
};

/* Polarisation of the light of a crossing where it leaves the gas. down: true if the light goes down through the plane.
 */
kd_polarized kd_polarization_left(kd_sample s, bool down)
{
    float a = cam.spin, w = s.w, w2 = w * w, delta = kd_delta(w, cam.root), root = sqrt(max(delta, 1e-12));
    bool falls = kd_plunge_falls(s);
    /* Vectors of the light, the gas and the field in Carter's frame. Their t and r components are multiplied by
     * sqrt(Delta)/r. */
    float k_theta = (down ? w : -w) * sqrt(max(s.q, 0.0));
    vec4 k = vec4(s.energy * (1.0 + a * a * w2) - a * w2 * s.momentum, s.slope, root * k_theta,
                  root * w * (s.momentum - a * s.energy));
    vec4 u = falls ? vec4(emission.plunge.energy - a * emission.plunge.j * w2, kd_plunge_speed(w), 0.0,
                          root * w * emission.plunge.j)
                   /* on a circular orbit the gas has the speed (sqrt(r - q^2) - a)/sqrt(Delta) */
                   : vec4(root, 0.0, 0.0, (kd_circle_root(w) - a) * w);
    vec4 b = vec4(-a * root * root, 0.0, 0.0, root * (1.0 / w + a * a * w)); /* d/dphi */
    if ((TRAITS_polarization & KD_TRAIT_RADIAL) != 0u)
        b = vec4(0.0, 1.0, 0.0, 0.0);
    if ((TRAITS_polarization & (KD_TRAIT_VERTICAL | KD_TRAIT_SCATTERED)) != 0u)
        b = vec4(0.0, 0.0, 1.0, 0.0);
    /* f is orthogonal to u, k and b. Components of b along u or k have no effect. */
    vec3 f = u.x * cross(k.yzw, b.yzw) - k.x * cross(u.yzw, b.yzw) + b.x * cross(u.yzw, k.yzw);
    float f_t = dot(u.yzw, cross(k.yzw, b.yzw));
    kd_polarized out_ =
        kd_polarized(emission.polarization.fraction, vec2(k.x * f.x - k.y * f_t, -(k.w * f.y - k.z * f.z)));
    if ((TRAITS_polarization & KD_TRAIT_SCATTERED) != 0u) {
        float at = sqrt(clamp(s.cosine, 0.0, 1.0)) * float(KD_SCATTERING_ROWS);
        uint row = min(uint(at), KD_SCATTERING_ROWS - 1u);
        vec2 of = kd_table_row(scattering, row).xy;
        out_.fraction *= mix(of.x, of.y, at - float(row));
    }
    return out_;
}

/* Stokes Q and U of the light of a crossing, relative to its I. A ray traced back from above the plane first goes down
 * through the plane, so its light comes up. For an observer in the plane the camera's direction decides. right: the
 * result of kd_polarization_right for the ray's place. */
vec2 kd_polarization_at(kd_sample s, vec2 right, float up)
{
    float above = cam.u != 0.0 ? cam.u : up;
    kd_polarized left = kd_polarization_left(s, (above > 0.0) == ((s.order & 1u) != 0u));
    vec2 z = vec2(left.kappa.x * right.x + left.kappa.y * right.y, left.kappa.y * right.x - left.kappa.x * right.y);
    float size = dot(z, z);
    /* x - i y is z, and Q + i U has the phase of (north + i east)^2 = (y - i x)^2 = -conj(z)^2 */
    return size > 0.0 ? left.fraction / size * vec2(z.y * z.y - z.x * z.x, 2.0 * z.x * z.y) : vec2(0.0);
}
#endif
