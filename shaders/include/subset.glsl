/* The common subset of GLSL and C that shared physics is written in: scalars of type `real`, structs by value,
 * no overloads, no swizzles, no out parameters. In GLSL real is float, or double with KD_REAL_DOUBLE; in C the
 * including file defines real and KD_R beforehand (tests do, to run the same text in double). */
#ifndef KD_SUBSET_GLSL
#define KD_SUBSET_GLSL

#ifdef VULKAN
#ifdef KD_REAL_DOUBLE
#define real double
#else
#define real float
#endif
#define KD_R(x) real(x)
#define KD_FN
#else
#define KD_FN static inline
#endif

#define KD_PI KD_R(3.14159265358979323846)

#endif
