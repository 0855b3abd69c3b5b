/* A celestial sphere: four quadrants in quiet colours, meridians and parallels in white. The line's width is a fortieth of the
 * spacing. */
#ifndef KD_BLOCK_sky
#define KD_BLOCK_sky(F, U, A)                                                                                   \
    F(brightness)                                                                                              \
    F(spacing)             /* of the grid, radians */
#define KD_TABLES_sky(T)
#define KD_TRAITS_sky(T)
#define KD_BUFFERS_sky(B)
#endif

#ifdef KD_EMIT_CODE
vec3 kd_sky_end(kd_end end)
{
    float u = end.u, phi = end.phi + emission.frame.azimuth, s = sqrt(max(1.0 - u * u, 0.0));
    float latitude = atan(u, s);
    float longitude = phi - 2.0 * KD_PI * floor(phi / (2.0 * KD_PI));
    vec2 q = vec2(longitude, latitude) / emission.sky.spacing;
    vec2 d = abs(q - floor(q + 0.5));
    d.x *= s; /* meridians keep their width towards the pole */
    float line = min(d.x, d.y) < 0.025 ? 1.0 : 0.0;
    vec3 base = longitude < KD_PI ? (u > 0.0 ? vec3(0.10, 0.22, 0.55) : vec3(0.08, 0.38, 0.26))
                                  : (u > 0.0 ? vec3(0.45, 0.16, 0.30) : vec3(0.48, 0.33, 0.08));
    return emission.sky.brightness * mix(base, vec3(1.0), line);
}
#endif
