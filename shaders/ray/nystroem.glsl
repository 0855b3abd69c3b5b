/* Runge-Kutta-Nystroem methods for y'' = f(y), for scalars and vectors. A step of length h goes from (y, v) to (y_out,
 * v_out). T is the type of y, and PULL(m, y) is the function f. Before it includes this file, a kernel may define
 * KD_NYSTROEM_ORDER as a specialisation constant, which selects the method:
 *   6: J. Albrecht's method in five stages (1955, ZAMM 35, 100);
 *   4: E. J. Nystroem's method in three, the fewest possible (1925, Acta Soc. Sci. Fenn. 50, 13; Hairer, Norsett &
 *     Wanner 1993, II.14).
 * The sums are `precise`. Without this qualifier a driver may add a step's small terms to y one by one (Vulkan allows
 * reassociation), each with a rounding error of y. tests/gpu/test_rays.c verifies the orders: with twice as many steps
 * the error falls to a sixty-fourth (order 6) or a sixteenth (order 4). */
#ifndef KD_NYSTROEM_GLSL
#define KD_NYSTROEM_GLSL

#ifndef KD_NYSTROEM_ORDER
#define KD_NYSTROEM_ORDER 6
#endif

#define KD_NYSTROEM_STEP(T, PULL, m, y, v, h, y_out, v_out) \
    float h2 = h * h; \
    T hv = h * v; \
    T k1 = PULL(m, y); \
    if (KD_NYSTROEM_ORDER == 4) { \
        T k2 = PULL(m, y + 0.5 * hv + h2 * 0.125 * k1); \
        T k3 = PULL(m, y + hv + h2 * 0.5 * k2); \
        precise T y_step = hv + h2 * (1.0 / 6.0) * (k1 + 2.0 * k2), y_sum = y + y_step; \
        precise T v_step = h * (1.0 / 6.0) * (k1 + 4.0 * k2 + k3), v_sum = v + v_step; \
        y_out = y_sum; \
        v_out = v_sum; \
    } else { \
        T k2 = PULL(m, y + 0.25 * hv + h2 * (1.0 / 32.0) * k1); \
        T k3 = PULL(m, y + 0.5 * hv + h2 * (1.0 / 24.0) * (4.0 * k2 - k1)); \
        T k4 = PULL(m, y + 0.75 * hv + h2 * (1.0 / 32.0) * (3.0 * k1 + 4.0 * k2 + 2.0 * k3)); \
        T k5 = PULL(m, y + hv + h2 * (1.0 / 14.0) * (6.0 * k2 - k3 + 2.0 * k4)); \
        precise T y_step = hv + h2 * (1.0 / 90.0) * (7.0 * k1 + 24.0 * k2 + 6.0 * k3 + 8.0 * k4); \
        precise T v_step = h * (1.0 / 90.0) * (7.0 * (k1 + k5) + 32.0 * (k2 + k4) + 12.0 * k3); \
        precise T y_sum = y + y_step, v_sum = v + v_step; \
        y_out = y_sum; \
        v_out = v_sum; \
    }

#endif
