/* The layers of a frame besides "rgb". A layer is a map with one number for each pixel. Each layer has one line here.
 * `number` is the index of the layer's name among the words of image.layers (src/scene/fields.h), where "rgb" is 0.
 * src/render/plan/layer_kinds.c defines the unit and the colours of each layer.
 *
 *   LIGHT(number, name, needs, value)      of the mean light of all rays of a pixel (light/layers.comp). value: GLSL
 *                                          of its Stokes I, Q, U and V, the vec4 `light`
 *   CROSSING(number, name, needs, value, met)  of the place where the pixel's middle ray crosses the disk. value: GLSL
 *                                          of the sample s and its delay. met: GLSL of kd_met met, if the ray meets a
 *                                          body before
 *   RAY(number, name, needs, value)        of the end of that ray. value: GLSL of its fate and of kd_end end
 *
 * needs: quantities of the lens map besides W. NaN means no value; infinity is a value. */
#ifndef KD_LAYERS_H
#define KD_LAYERS_H

#define KD_LAYERS(LIGHT, CROSSING, RAY) \
    LIGHT(1, intensity, 0u, light.x) \
    CROSSING(2, g, 0, kd_layer_g(s), kd_layer_met_g(met)) \
    CROSSING(3, temperature, 0, kd_layer_temperature(s), kd_layer_met_temperature(met)) \
    CROSSING(4, r, 0, 1.0 / s.w, 1.0 / met.w) \
    CROSSING(5, phi, KD_LENS_PHI, kd_layer_turned(s.phi + emission.frame.azimuth), \
             kd_layer_turned(met.phi + emission.frame.azimuth)) \
    CROSSING(6, delay, KD_LENS_DELAY, delay, KD_NOTHING) \
    CROSSING(7, emission_angle, 0, kd_layer_angle(kd_layer_g(s) * sqrt(max(s.q, 0.0)) * s.w), \
             kd_layer_angle(met.cosine)) \
    CROSSING(8, order, 0, float(s.order), float(met.crossed)) \
    RAY(9, sky_theta, KD_LENS_SKY, fate == KD_FATE_ESCAPED ? kd_layer_angle(end.u) : KD_NOTHING) \
    RAY(10, sky_phi, KD_LENS_SKY, \
        fate == KD_FATE_ESCAPED ? kd_layer_turned(end.phi + emission.frame.azimuth) : KD_NOTHING) \
    RAY(11, fate, KD_LENS_SKY, fate) \
    CROSSING(12, footprint, KD_LENS_PHI | KD_LENS_FOOTPRINT, kd_layer_size(s.footprint, KD_FOOTPRINT_LEAST / s.w), \
             KD_NOTHING) \
    RAY(13, sky_footprint, KD_LENS_SKY | KD_LENS_SKY_FOOTPRINT, \
        fate == KD_FATE_ESCAPED ? kd_layer_size(end.footprint, KD_FOOTPRINT_LEAST) : KD_NOTHING) \
    CROSSING(14, optical_depth, 0, kd_layer_depth(s), uintBitsToFloat(KD_INFINITE_BITS)) \
    LIGHT(15, stokes_q, KD_LENS_SLOPE, light.y) \
    LIGHT(16, stokes_u, KD_LENS_SLOPE, light.z) \
    LIGHT(17, evpa, KD_LENS_SLOPE, kd_layer_evpa(light)) \
    LIGHT(18, polarization_fraction, KD_LENS_SLOPE, kd_layer_polarized(light)) \
    LIGHT(19, brightness_temperature, 0u, light.x *emission.frame.kelvin) \
    LIGHT(20, specific_intensity, 0u, light.x *emission.frame.jansky) \
    LIGHT(21, stokes_v, KD_LENS_SLOPE, light.w) \
    LIGHT(22, jy_per_pixel, 0u, light.x *emission.frame.jansky_pixel)

#endif
