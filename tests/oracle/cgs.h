/* Constants in CGS (CODATA 2018): speed of light, squared electron charge, electron and proton mass, Planck and
 * Boltzmann constant, and GM of the Sun (IAU 2015). */
#ifndef KD_TESTS_CGS_H
#define KD_TESTS_CGS_H

#define C 2.99792458e10
#define E2 (4.80320471e-10 * 4.80320471e-10)
#define ME 9.1093837015e-28
#define MP 1.67262192369e-24
#define H 6.62607015e-27
#define K 1.380649e-16
#define GM_SUN 1.3271244e26

#endif
