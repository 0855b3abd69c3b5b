/* Albrecht's Runge-Kutta-Nystroem method of order 6 in five stages for y'' = f(y) (J. Albrecht 1955, ZAMM 35, 100), for scalars
 * and vectors alike: from (y, v) over a step h to (y_out, v_out), T being the type and PULL(m, y) the function f.
 * Its order is seen in tests/gpu/test_rays.c: twice the steps leave a sixty-fourth of the error. */
#ifndef KD_NYSTROEM_GLSL
#define KD_NYSTROEM_GLSL

#define KD_NYSTROEM_STEP(T, PULL, m, y, v, h, y_out, v_out)                                                      \
    float h2 = h * h;                                                                                            \
    T hv = h * v;                                                                                                \
    T k1 = PULL(m, y);                                                                                           \
    T k2 = PULL(m, y + 0.25 * hv + h2 * (1.0 / 32.0) * k1);                                                      \
    T k3 = PULL(m, y + 0.5 * hv + h2 * (1.0 / 24.0) * (4.0 * k2 - k1));                                          \
    T k4 = PULL(m, y + 0.75 * hv + h2 * (1.0 / 32.0) * (3.0 * k1 + 4.0 * k2 + 2.0 * k3));                        \
    T k5 = PULL(m, y + hv + h2 * (1.0 / 14.0) * (6.0 * k2 - k3 + 2.0 * k4));                                     \
    y_out = y + (hv + h2 * (1.0 / 90.0) * (7.0 * k1 + 24.0 * k2 + 6.0 * k3 + 8.0 * k4));                         \
    v_out = v + h * (1.0 / 90.0) * (7.0 * (k1 + k5) + 32.0 * (k2 + k4) + 12.0 * k3)

#endif
