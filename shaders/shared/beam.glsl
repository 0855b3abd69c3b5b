/* Shared by the kernels of a telescope's beam: beam_*.comp. */
#ifndef KD_BEAM_GLSL
#define KD_BEAM_GLSL

/* A quadratic B-spline with nodes at unit distance. For any place t, its weights for three neighbouring cells have the
 * sum 1, the mean t and the variance 1/4. The spline therefore shifts nothing, and widens everything equally. */
float beam_spline(float t)
{
    float far = max(1.5 - abs(t), 0.0), near = max(0.5 - abs(t), 0.0);
    return 0.5 * far * far - 1.5 * near * near;
}

#endif
