/* Two masses spiral together under gravitational radiation. Double precision, pure functions, any thread. G = c = 1
 * and the total mass is 1; a is the semi-major axis, e the eccentricity, eta = m1 m2 (0 < eta <= 1/4).
 *
 * Leading order: the quadrupole formula on a Kepler ellipse, averaged over an orbit. Its relative error is of the
 * order of 1/a and grows to tens of per cent at the last stable orbit, a = 6, where a chirp given here ends.
 *
 * Sources: P. C. Peters & J. Mathews 1963, Phys. Rev. 131, 435 [PM]; P. C. Peters 1964, Phys. Rev. 136, B1224 [P];
 * M. Maggiore 2008, Gravitational Waves 1, section 4.1 (chirp, strain). The formulas are held to a few ulp, the
 * integral in kd_inspiral_time to 1e-13. Outside of 0 < eta <= 1/4, a > 0, 0 <= e < 1: NaN. */
#ifndef KD_PHYSICS_WAVES_INSPIRAL_H
#define KD_PHYSICS_WAVES_INSPIRAL_H

/* m1 m2/(m1 + m2)^2 for the ratio q = m2/m1 > 0; and the chirp mass eta^(3/5). */
double kd_inspiral_eta(double q);
double kd_inspiral_chirp_mass(double eta);

/* By how much an ellipse radiates more than a circle of the same a [PM eq. 17]:
 * (1 + 73/24 e^2 + 37/96 e^4)/(1 - e^2)^(7/2). */
double kd_inspiral_enhancement(double e);

/* Radiated power [P 5.4], and da/dt, de/dt [P 5.6, 5.7], all averaged. */
double kd_inspiral_power(double eta, double a, double e);
double kd_inspiral_axis_rate(double eta, double a, double e);
double kd_inspiral_eccentricity_rate(double eta, double a, double e);

/* dP/dt of the orbital period P = 2 pi a^(3/2), a pure number: Hulse and Taylor's -2.40e-12. */
double kd_inspiral_period_rate(double eta, double a, double e);

/* The axis when the eccentricity has become e, 0 < e < 1, from (a0, e0) [P 5.11]; 0 for e = 0 < e0. */
double kd_inspiral_axis(double a0, double e0, double e);

/* Time to coalescence, a = 0 [P 5.10 and 5.14]. A circle spends (6/a)^4 of it inside a = 6. */
double kd_inspiral_time(double eta, double a, double e);

/* Frequency of the waves of a circular orbit, twice the orbital one, at time tau before coalescence [Maggiore 4.19];
 * NaN inside a = 6. The end of the chirp: 1/(6^(3/2) pi). */
double kd_inspiral_frequency(double eta, double tau);
double kd_inspiral_frequency_isco(void);

/* Strain amplitude of either polarisation, seen along the orbit's axis at distance d, at wave frequency f of a
 * circular orbit [Maggiore 4.3]. Seen from the side h+ is half of it, hx nothing. */
double kd_inspiral_strain(double eta, double f, double d);

#endif
