/* The kernels of a telescope's beam share this: beam_*.comp. */
#ifndef KD_BEAM_GLSL
#define KD_BEAM_GLSL

/* A quadratic B-spline of unit width: of three neighbours at unit distance the weights have the sum 1, the mean t
 * and the variance 1/4, wherever t is. So it moves nothing, and widens all alike. */
float beam_spline(float t)
{
    float far = max(1.5 - abs(t), 0.0), near = max(0.5 - abs(t), 0.0);
    return 0.5 * far * far - 1.5 * near * near;
}

#endif
