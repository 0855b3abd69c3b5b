/* An approximation: something that a picture leaves out, or a choice that it makes. Constant data.
 *
 * An approximation's name, such as "disk.thin", is short and never changes, because headers and programs use it.
 * Names are unique, and all of them together fit into one header of an HTTP response (tests/unit/emitters.c). */
#ifndef KD_RENDER_EMIT_APPROXIMATION_H
#define KD_RENDER_EMIT_APPROXIMATION_H

struct kd_approximation { const char *name, *text; /* text: one sentence */ };

#endif
