/* Physical constants in SI units. Sources: for measured constants CODATA 2018 (E. Tiesinga et al. 2021, Rev. Mod. Phys.
 * 93, 025010); for nominal solar values IAU 2015 resolution B3 (A. Prsa et al. 2016, AJ 152, 41); for lengths IAU 2012
 * resolution B2 and IAU 2015 resolution B2. Constants marked "exact" are exact by the definition of their units (SI
 * 2019). */
#ifndef KD_PHYSICS_MATH_CONSTANTS_H
#define KD_PHYSICS_MATH_CONSTANTS_H

#define KD_C_M_S 299792458.0    /* speed of light, exact */
#define KD_H_J_S 6.62607015e-34 /* Planck constant, exact */
#define KD_K_J_K 1.380649e-23   /* Boltzmann constant, exact */
/* Newtonian constant of gravitation, m^3 kg^-1 s^-2, CODATA 2018; relative error 2.2e-5 */
#define KD_G_SI 6.67430e-11
#define KD_PROTON_KG 1.67262192369e-27  /* mass of a proton, CODATA 2018 */
#define KD_ELECTRON_KG 9.1093837015e-31 /* mass of an electron, CODATA 2018 */
#define KD_CHARGE_C 1.602176634e-19     /* charge of a proton in C, exact */
#define KD_EPSILON_0 8.8541878128e-12   /* vacuum permittivity, F/m, CODATA 2018 */
#define KD_THOMSON_M2 6.6524587321e-29  /* Thomson cross section, CODATA 2018 */
/* Stefan-Boltzmann constant, W m^-2 K^-4: 2 pi^5 k^4 / (15 h^3 c^2), exact */
#define KD_STEFAN_BOLTZMANN_SI 5.670374419184429e-8
#define KD_WIEN_M_K \
    2.89777195518517266e-3 /* wavelength of the peak of B_lambda, m K: h c / (4.965114231744276 k), exact */
/* Wien's constant of frequency, Hz/K: peak of B_nu at 2.821439372122079 k / h, exact */
#define KD_WIEN_HZ_K 5.87892575764682495e10

/* G times the Sun's mass, m^3 s^-2, IAU 2015 B3, nominal; masses in kg are known to 2e-5 only */
#define KD_GM_SUN_SI 1.3271244e20
#define KD_R_SUN_M 6.957e8                            /* radius of the Sun, IAU 2015 B3, nominal */
#define KD_L_SUN_W 3.828e26                           /* luminosity of the Sun, IAU 2015 B3, nominal */
#define KD_AU_M 149597870700.0                        /* astronomical unit, IAU 2012 B2, exact */
#define KD_PARSEC_M 3.0856775814913673e16             /* parsec: 648000/pi au, IAU 2015 B2 note 4 */
#define KD_JANSKY_SI 1e-26                            /* jansky in W m^-2 Hz^-1, exact */
#define KD_YEAR_S 31557600.0                          /* Julian year of the IAU */
#define KD_MICROARCSECOND_RAD 4.84813681109535994e-12 /* microarcsecond: pi / 6.48e11 */

/* M for a hole of one solar mass m: G m / c^2 in metres, and G m / c^3 in seconds. */
#define KD_M_SUN_M (KD_GM_SUN_SI / (KD_C_M_S * KD_C_M_S))
#define KD_M_SUN_S (KD_M_SUN_M / KD_C_M_S)

#endif
