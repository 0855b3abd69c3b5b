/* Ringdown of a struck hole, as an illustration: light of image orders 1 and higher oscillates. */
#ifndef KD_BLOCK_ringdown
#define KD_BLOCK_ringdown(F, U, A) F(factor)
#define KD_TABLES_ringdown(T)
#define KD_TRAITS_ringdown(T)
#define KD_BUFFERS_ringdown(B)
#define KD_PASS_ringdown(P)
#endif

#ifdef KD_EMIT_CODE
float kd_ringdown_over(uint order) { return order > 0u ? emission.ringdown.factor : 1.0; }
#endif
