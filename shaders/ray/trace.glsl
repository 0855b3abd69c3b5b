/* Records the steps of a kernel for `kerrd rays --trace`. If the kernel is compiled with KD_TRACE, it follows a single
 * ray and writes a record of each step to binding 2; otherwise this file compiles to nothing. The output is the number
 * of records, then the constants of motion, then the records. A record holds the stage, the step, four numbers, their
 * derivatives, and chi. Records that do not fit are only counted. */
#ifndef KD_TRACE_GLSL
#define KD_TRACE_GLSL

#ifdef KD_TRACE
layout(set = 0, binding = 2) writeonly buffer Steps { float steps[]; };
uint kd_trace_records = 0;

void kd_trace(float stage, float h, vec4 y, vec4 dy, float chi)
{
    uint at = KD_TRACE_HEADER + KD_TRACE_RECORD * kd_trace_records++;
    steps[0] = float(kd_trace_records);
    if (at + KD_TRACE_RECORD > uint(steps.length()))
        return;
    steps[at] = stage;
    steps[at + 1] = h;
    for (uint k = 0; k < 4; k++) {
        steps[at + 2 + k] = y[k];
        steps[at + 6 + k] = dy[k];
    }
    steps[at + 10] = chi;
}
#define KD_TRACE_CONSTANTS(m) \
    steps[1] = m.momentum, steps[2] = m.q, steps[3] = m.energy2, steps[4] = m.a2, steps[5] = m.k, steps[6] = m.d
#define KD_TRACE_STEP(stage, h, y, dy, chi) kd_trace(stage, h, y, dy, chi)
#else
#define KD_TRACE_CONSTANTS(m)
#define KD_TRACE_STEP(stage, h, y, dy, chi)
#endif

#endif
