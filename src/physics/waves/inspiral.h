/* Inspiral of two masses under gravitational radiation. Double precision, pure functions, any thread. G = c = 1, and
 * the total mass is 1. a is the semi-major axis, e the eccentricity, and eta = m1 m2 (0 < eta <= 1/4).
 *
 * The formulas are of leading order: the quadrupole formula on a Kepler ellipse, averaged over an orbit. Their relative
 * error is of the order of 1/a and grows to tens of per cent at the last stable orbit, a = 6, where a chirp ends here.
 *
 * Sources: P. C. Peters & J. Mathews 1963, Phys. Rev. 131, 435 [PM]; P. C. Peters 1964, Phys. Rev. 136, B1224 [P]; M.
 * Maggiore 2008, Gravitational Waves 1, section 4.1 (chirp, strain). The numerical error is a few ulp, or 1e-13 for the
 * integral in kd_inspiral_time. Results are NaN outside of 0 < eta <= 1/4, a > 0, 0 <= e < 1. */
#ifndef KD_PHYSICS_WAVES_INSPIRAL_H
#define KD_PHYSICS_WAVES_INSPIRAL_H

/* kd_inspiral_eta: eta = m1 m2/(m1 + m2)^2 for the mass ratio q = m2/m1 > 0. The other function: the chirp mass,
 * eta^(3/5). */
double kd_inspiral_eta(double q);
double kd_inspiral_chirp_mass(double eta);

/* Ratio of the power radiated on an ellipse to that on a circle of the same a [PM eq. 17]: (1 + 73/24 e^2 + 37/96
 * e^4)/(1 - e^2)^(7/2). */
double kd_inspiral_enhancement(double e);

/* Averages over an orbit. The functions give, in this order, the radiated power [P 5.4], da/dt [P 5.6] and de/dt [P
 * 5.7]. */
double kd_inspiral_power(double eta, double a, double e);
double kd_inspiral_axis_rate(double eta, double a, double e);
double kd_inspiral_eccentricity_rate(double eta, double a, double e);

/* Rate of change dP/dt of the orbital period P = 2 pi a^(3/2), which is a pure number. For the Hulse-Taylor pulsar it
 * is -2.40e-12. */
double kd_inspiral_period_rate(double eta, double a, double e);

/* Semi-major axis, when the eccentricity is e (0 < e < 1), of an orbit that began with (a0, e0) [P 5.11]; 0 for e = 0 <
 * e0. */
double kd_inspiral_axis(double a0, double e0, double e);

/* Time until coalescence, that is, until a = 0 [P 5.10 and 5.14]. A circular orbit spends (6/a)^4 of this time inside a
 * = 6. */
double kd_inspiral_time(double eta, double a, double e);

/* kd_inspiral_frequency: frequency of the waves of a circular orbit, which is twice the orbital frequency, at the time
 * tau before coalescence [Maggiore 4.19]; NaN inside a = 6. The other function: frequency at the end of the chirp,
 * 1/(6^(3/2) pi). */
double kd_inspiral_frequency(double eta, double tau);
double kd_inspiral_frequency_isco(void);

/* Strain amplitude of each polarisation at the distance d along the orbit's axis, for a circular orbit with the wave
 * frequency f [Maggiore 4.3]. For an observer edge-on, h+ is half of this and hx is 0. */
double kd_inspiral_strain(double eta, double f, double d);

#endif
