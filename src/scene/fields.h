/* The table of scene fields, version 1 of the scene document. Each row is a field; rows are grouped in sections and
 * in lists of sections.
 *
 * Each row expands to the struct member, the default, the JSON parser, --set, the query parameter, the JSON Schema
 * and docs/scene.md. A new field must be added only here.
 *
 *     REAL(section, name, nature, place, default, minimum, maximum, unit, help)
 *     WORD(section, name, nature, place, default, minimum, maximum, unit, help, word)
 *          a real number, or the word, which is stored as INFINITY
 *     INT (section, name, nature, place, default, minimum, maximum, unit, help)
 *     BOOL(section, name, nature, place, default, help)
 *     ENUM(section, name, nature, place, default, help, words)
 *          words "a|b|c": the value is the index of one of them
 *     ASSET(section, name, nature, place, help)
 *          an asset, named by the SHA-256 of its bytes, or none (scene/asset.h)
 *     WORDS(section, name, nature, place, help, words)
 *          a set of words of "a|b_N|c", in any order; b_N stands for b, b_0, b_1, ...; default: the first word
 *
 * The nature says what it means to change the field. Every row must have a nature.
 *     PHYSICS  an exact consequence of general relativity or radiative transfer, or its numerical accuracy
 *     MODEL    chooses a model of matter or of a source, or a parameter of the model
 *     LOOK     a choice of presentation, which changes the picture but not the physics
 * The place tells where the page shows the field: FRONT among the few that most visitors use, REST among the others.
 * The group of a section (LOOK, GAS, HOLE, CAMERA or MORE) is the group in which the page shows its fields.
 *
 * Bounds are inclusive. Lengths are in M = GM/c^2; the unit "1" means a pure number. The canonical form and the
 * reference have the fields in the order of this table. */
#ifndef KD_SCENE_FIELDS_H
#define KD_SCENE_FIELDS_H

#include "physics/spacetime/observer.h"
#include "physics/spacetime/parameters.h"

#define KD_HOLE_FIELD_(REAL, name, member, least, most, shown, unit, card, what, bound, help, ...) \
    REAL(spacetime, name, PHYSICS, REST, 0.0, least, most, unit, help)
#define KD_SPACETIME_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(spacetime, spin, PHYSICS, FRONT, 0.7, -0.999999999999, 0.999999999999, "M", \
         "spin parameter a; a < 0: the disk is retrograde to its hole") \
    KD_HOLE_MORE(KD_HOLE_FIELD_, REAL) \
    REAL(spacetime, mass_msun, PHYSICS, REST, 1e8, 1e-3, 1e12, "solar masses", \
         "mass of the hole; sets the temperature when disk.colour is \"accretion\"") \
    REAL(spacetime, distance_pc, PHYSICS, REST, 260000.0, 1e-3, 1e11, "pc", \
         "angular diameter distance of the hole; with the mass it determines the width of a picture on the sky, for " \
         "a beam and a scale bar")

#define KD_CAMERA_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    WORD(camera, r, PHYSICS, FRONT, INFINITY, 0.01, 1e7, "M", "Boyer-Lindquist radius of the observer", "infinity") \
    REAL(camera, inclination_deg, PHYSICS, FRONT, 82.0, 0.0, 180.0, "degrees", \
         "polar angle of the observer: 0 over the pole of the disk's rotation, 90 in its plane") \
    REAL(camera, azimuth_deg, PHYSICS, REST, 0.0, -360.0, 360.0, "degrees", \
         "Boyer-Lindquist azimuth of the observer; for a falling observer the ingoing Kerr-Schild azimuth, " \
         "which is the same far away") \
    ENUM(camera, observer, PHYSICS, FRONT, KD_OBSERVER_STATIC, "state of motion at a finite radius" KD_OBSERVER_HELP, \
         KD_OBSERVER_WORDS) \
    REAL(camera, velocity_r, PHYSICS, REST, 0.0, -1.0, 1.0, "c", \
         "outward velocity in the frame of the local observer of zero angular momentum (observer: velocity)") \
    REAL(camera, velocity_theta, PHYSICS, REST, 0.0, -1.0, 1.0, "c", \
         "velocity away from the north pole, in the frame of the local observer of zero angular momentum " \
         "(observer: velocity)") \
    REAL(camera, velocity_phi, PHYSICS, REST, 0.0, -1.0, 1.0, "c", \
         "velocity along the disk's rotation, in the frame of the local observer of zero angular momentum " \
         "(observer: velocity)") \
    WORD(camera, infall_from, PHYSICS, REST, INFINITY, 1.0, 1e7, "M", \
         "radius at which the observer's fall begins, at rest except for its angular momentum (observer: " \
         "infall)", \
         "infinity") \
    WORD(camera, infall_energy, PHYSICS, REST, INFINITY, -100.0, 1e3, "1", \
         "energy per mass of the falling observer; rest: the energy that follows from infall_from (observer: " \
         "infall)", \
         "rest") \
    REAL(camera, infall_momentum, PHYSICS, REST, 0.0, -1e4, 1e4, "M", \
         "angular momentum per mass of the falling observer, which moves in r and azimuth but not in latitude " \
         "(observer: infall)") \
    ENUM(camera, projection, LOOK, REST, KD_PROJECTION_AUTO, \
         "plane: parallel rays, image plane in M, at infinity only; pinhole: at a finite radius only; ring: the " \
         "angle round the critical curve across, the logarithm of the distance to it upwards, at infinity only; " \
         "equirectangular: all directions from a finite radius, longitude to the right and latitude upwards; " \
         "fulldome: the angle from the middle as distance, 90 degrees at the nearer edges, from a finite radius; " \
         "auto: plane at infinity, otherwise pinhole", \
         "auto|plane|pinhole|ring|equirectangular|fulldome") \
    REAL(camera, field_m, LOOK, FRONT, 46.0, 1e-6, 1e7, "M", "width of the image plane (plane projection)") \
    WORD(camera, field_uas, LOOK, REST, INFINITY, 1e-12, 1e12, "microarcseconds", \
         "width of the image plane on the sky, at spacetime.mass_msun and spacetime.distance_pc; it sets " \
         "camera.field_m; none: camera.field_m is used", \
         "none") \
    REAL(camera, fov_deg, LOOK, FRONT, 50.0, 1e-6, 179.0, "degrees", "horizontal field of view (pinhole projection)") \
    REAL(camera, centre_alpha, LOOK, REST, 0.0, -1e7, 1e7, "M", \
         "image-plane alpha at the middle of the picture (plane)") \
    REAL(camera, centre_beta, LOOK, REST, 0.0, -1e7, 1e7, "M", \
         "image-plane beta at the middle of the picture (plane)") \
    REAL(camera, yaw_deg, LOOK, REST, 0.0, -180.0, 180.0, "degrees", \
         "look to the right of the hole (from a finite radius)") \
    REAL(camera, pitch_deg, LOOK, REST, 0.0, -90.0, 90.0, "degrees", "look above the hole (from a finite radius)") \
    REAL(camera, roll_deg, LOOK, REST, 0.0, -360.0, 360.0, "degrees", \
         "turn the camera clockwise about its axis; ring: the angle " \
         "in the middle of the picture, 0 at alpha > 0, rising to the right") \
    ENUM(camera, stereo, LOOK, REST, KD_STEREO_NONE, \
         "pair: two pictures side by side, the left eye's on the left, each image.width wide and in pinhole " \
         "projection; none: one eye", \
         "none|pair") \
    REAL(camera, eye_distance, LOOK, REST, 0.5, 1e-6, 1e6, "M", \
         "distance between the eyes, perpendicular to the viewing direction (stereo: pair)") \
    REAL(camera, ring_decades_max, LOOK, REST, 0.0, -12.0, 0.0, "decades", \
         "log10 of the distance between the critical curve and the picture's upper and lower edges, in units of the " \
         "curve's radius (ring)") \
    REAL(camera, ring_decades_min, LOOK, REST, -10.0, -13.0, -1.0, "decades", \
         "log10 of the distance to the critical curve at the picture's middle line; rays above the line pass outside " \
         "the curve, rays below it inside (ring)")

#define KD_DISK_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    ENUM(disk, model, MODEL, FRONT, KD_DISK_NOVIKOV_THORNE, \
         "radial flux: none; the exact Page-Thorne integral; the Newtonian thin disk cut at the ISCO; or " \
         "particles: the exact flux, as orbiting particles", \
         "none|novikov-thorne|shakura-sunyaev|particles") \
    WORD(disk, inner, MODEL, REST, INFINITY, 1.0, 1e6, "M", "inner edge; at least the ISCO", "isco") \
    REAL(disk, outer, MODEL, FRONT, 22.0, 1.0, 1e6, "M", "outer edge; larger than the inner one") \
    REAL(disk, taper, MODEL, REST, 0.7, 0.0, 1.0, "1", \
         "outer fraction of the radius over which the disk fades out; 0: a sharp edge") \
    REAL(disk, opacity, MODEL, REST, 1.0, 0.0, 1.0, "1", "opacity of one crossing; 1 is optically thick") \
    REAL(disk, emission_opacity, MODEL, REST, 10.0, 0.0, 1e6, "1", \
         "optical depth along the normal where the disk is brightest; elsewhere it is proportional to the " \
         "flux. A crossing has the opacity 1 - exp(-depth/cos) times disk.opacity, with the angle of emission " \
         "in the gas's frame; 0: the same opacity everywhere") \
    REAL(disk, height, MODEL, REST, 0.0, 0.0, 0.5, "1", \
         "relative half height H/R at R = 10 M: H is the height above the plane at which the density has fallen " \
         "to exp(-1/2), R the distance from the axis; the optical depth from top to bottom is that of the thin " \
         "disk; 0: a thin disk") \
    REAL(disk, flare, MODEL, REST, 0.0, -0.5, 0.5, "1", "exponent p: H/R is proportional to R^p (disk.height)") \
    ENUM(disk, colour, MODEL, REST, KD_COLOUR_PEAK, \
         "temperature scale: a chosen peak temperature, or from spacetime.mass_msun and disk.mdot_edd", \
         "peak|accretion") \
    REAL(disk, peak_temperature_k, MODEL, FRONT, 3600.0, 300.0, 1e9, "K", \
         "largest effective temperature of the disk, in its own frame (colour: peak)") \
    REAL(disk, mdot_edd, MODEL, REST, 0.1, 1e-12, 1e3, "Eddington rates", \
         "accretion rate: luminosity over the Eddington luminosity, with the efficiency for this spin") \
    REAL(disk, hardening, MODEL, REST, 1.0, 1.0, 3.0, "1", "colour temperature over effective temperature") \
    ENUM(disk, atmosphere, MODEL, REST, KD_ATMOSPHERE_ISOTROPIC, \
         "how the light of the thin disk's surface depends on mu, the cosine of the angle to its normal in the " \
         "gas's frame. isotropic; laor: as 1 + 2.06 mu; scattering: as from a deep atmosphere of free electrons, " \
         "which polarization.model \"scattering\" polarises. Each law has the disk's flux", \
         "isotropic|laor|scattering") \
    ENUM( \
        disk, returning, MODEL, REST, KD_RETURNS_NONE, \
        "light that the hole bends back to the disk. none: it is ignored; thermalised: the disk absorbs it with its " \
        "angular momentum, and radiates it again as a black body; reflected: the disk reflects the share disk.albedo " \
        "with the spectrum of the arriving light, and thermalises the rest. Light may return any number of times", \
        "none|thermalised|reflected") \
    REAL(disk, albedo, MODEL, REST, 0.5, 0.0, 1.0, "1", "share of the returning light that is reflected") \
    ENUM(disk, band, LOOK, REST, KD_BAND_BOLOMETRIC, \
         "brightness: bolometric, g^4 F; visible, the luminance that the eye perceives of the Planck " \
         "spectrum; or frequency, the specific intensity at disk.frequency_ghz, in physical units", \
         "bolometric|visible|frequency") \
    REAL(disk, frequency_ghz, PHYSICS, REST, 230.0, 1e-6, 1e12, "GHz", "observed frequency (band: frequency)") \
    BOOL(disk, doppler, PHYSICS, REST, true, "include the Doppler shift and beaming of the orbiting gas") \
    BOOL(disk, redshift, PHYSICS, REST, true, \
         "include the gravitational redshift and time dilation of the orbiting gas") \
    INT(disk, particles, MODEL, REST, 300000, 1000, 10000000, "1", "number of particles (model: particles)") \
    INT(disk, seed, MODEL, REST, 1, 0, 2147483647, "1", \
        "seed of the random numbers that place the particles (model: particles)") \
    REAL(disk, density_index, MODEL, REST, 2.0, 0.0, 4.0, "1", \
         "p: the number of particles per area is proportional to r^-p; for p = 2 every octave of r has the same " \
         "number (model: particles)") \
    REAL(disk, plunging, MODEL, REST, 0.02, 0.0, 0.5, "1", \
         "share of the particles that fall from the ISCO, with its energy and angular momentum; none fall " \
         "unless disk.inner is \"isco\" (model: particles)") \
    REAL(disk, plunging_temperature, MODEL, REST, 0.7, 0.0, 1.0, "1", \
         "temperature of the plunging gas over the disk's largest temperature; 0: it is invisible (model: " \
         "particles)") \
    REAL(disk, epicycles, MODEL, REST, 0.02, 0.0, 0.2, "1", \
         "largest amplitude of oscillations in latitude, in radians; times (kappa/Omega)^2, which vanishes at the " \
         "ISCO, also the largest relative amplitude of oscillations in r (model: particles)") \
    BOOL(disk, slow_light, PHYSICS, REST, false, \
         "show particles, gas, spots and a flash at the time when the light of each ray left them, instead of at one " \
         "coordinate time")

#define KD_GAS_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(gas, amplitude, MODEL, FRONT, 0.8, 0.0, 3.0, "1", \
         "turbulence: standard deviation of the logarithm of the flux, and of the optical depth; 0: a smooth disk") \
    INT(gas, octaves, MODEL, REST, 6, 1, 8, "1", \
        "number of scales of the turbulence; each scale is about half the one before") \
    REAL(gas, scale, MODEL, REST, 0.4, 0.02, 2.0, "1", \
         "size of the largest eddies over r, before shear stretches them") \
    REAL(gas, shear, MODEL, REST, 5.0, -20.0, 20.0, "1", \
         "azimuth by which streaks trail, in radians for each unit of ln r; below 0 they lead. Streaks are 1 + " \
         "shear^2 times as long as they are wide") \
    INT(gas, seed, MODEL, REST, 1, 0, 2147483647, "1", "seed of the random numbers of the turbulence")

#define KD_SPOTS_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(spots, brightness, MODEL, FRONT, 0.0, 0.0, 1e6, "1", \
         "surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no " \
         "spot") \
    REAL(spots, r, MODEL, FRONT, 9.0, 1.0, 1e6, "M", \
         "radius of the circular orbit of the spot's centre; at least the ISCO") \
    REAL(spots, phase_deg, MODEL, REST, 0.0, -360.0, 360.0, "degrees", "azimuth of the spot's centre at time 0") \
    REAL(spots, size, MODEL, FRONT, 1.0, 1e-3, 1e5, "M", \
         "distance from the spot's centre at which the brightness has fallen to exp(-1/2)") \
    REAL(spots, index, MODEL, REST, 1.0, -4.0, 6.0, "1", \
         "spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by " \
         "g^(3 + index)") \
    REAL(spots, temperature_k, MODEL, REST, 9000.0, 300.0, 1e9, "K", \
         "colour: that of a black body of this temperature, shifted by g")
#define KD_SPOTS 16 /* maximum number of spots, for which the kernels have room */

#define KD_FLASH_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(flash, brightness, MODEL, REST, 0.0, 0.0, 1e6, "1", \
         "surface brightness in the gas's frame where the flash lights the disk most, at its peak, in units of the " \
         "disk's brightest; 0: no flash") \
    REAL(flash, height, MODEL, FRONT, 10.0, 1.0, 1e4, "M", \
         "Boyer-Lindquist radius of the lamp on the axis; at least 1.05 times that of the horizon") \
    REAL(flash, start, MODEL, REST, 0.0, -1e12, 1e12, "M", "coordinate time at which the lamp is brightest") \
    REAL(flash, duration, MODEL, FRONT, 1.0, 1e-3, 1e6, "M", \
         "time before and after the peak at which the lamp's light is exp(-1/2) of the peak") \
    REAL(flash, period, MODEL, REST, 0.0, 0.0, 1e9, "M", \
         "time from one flash to the next, at least 12 times flash.duration; 0: one flash only") \
    REAL(flash, photon_index, MODEL, REST, 2.0, 1.0, 4.0, "1", \
         "photon index Gamma of the lamp: it emits E^-Gamma photons per energy, which sets how its light on the disk " \
         "depends on the shift from the lamp to the gas") \
    REAL(flash, index, MODEL, REST, 0.0, -4.0, 6.0, "1", \
         "spectral index of the lit gas: I_nu falls as nu to this power, so that the observed brightness is " \
         "multiplied by g^(3 + index)") \
    REAL(flash, temperature_k, MODEL, REST, 6500.0, 300.0, 1e9, "K", \
         "colour of the lit gas: that of a black body of this temperature, shifted by g")

#define KD_BODIES_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(bodies, radius, MODEL, FRONT, 0.0, 0.0, 1e6, "M", "radius of the sphere in its own frame; 0: no body") \
    REAL(bodies, r, MODEL, FRONT, 15.0, 1.0, 1e7, "M", \
         "Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon") \
    REAL(bodies, inclination_deg, MODEL, REST, 90.0, 0.0, 180.0, "degrees", \
         "polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane") \
    REAL(bodies, phase_deg, MODEL, FRONT, 0.0, -360.0, 360.0, "degrees", \
         "azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0") \
    ENUM(bodies, motion, MODEL, REST, KD_OBSERVER_KEPLERIAN, \
         "state of motion, which shifts the body's light; static, zamo, " KD_OBSERVER_CIRCULAR \
         " move it round with time, the last two only in the disk's plane" KD_OBSERVER_HELP, \
         KD_OBSERVER_WORDS) \
    REAL(bodies, velocity_r, MODEL, REST, 0.0, -1.0, 1.0, "c", \
         "outward velocity in the frame of the local observer of zero angular momentum (motion: velocity)") \
    REAL(bodies, velocity_theta, MODEL, REST, 0.0, -1.0, 1.0, "c", \
         "velocity away from the north pole, in the frame of the local observer of zero angular momentum " \
         "(motion: velocity)") \
    REAL(bodies, velocity_phi, MODEL, REST, 0.0, -1.0, 1.0, "c", \
         "velocity along the disk's rotation, in the frame of the local observer of zero angular momentum " \
         "(motion: velocity)") \
    REAL(bodies, temperature_k, MODEL, FRONT, 6000.0, 300.0, 1e9, "K", \
         "temperature of the body, which shines as a black body shifted by g") \
    REAL(bodies, brightness, MODEL, REST, 1.0, 0.0, 1e9, "1", \
         "surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark") \
    REAL(bodies, limb_darkening, MODEL, REST, 0.6, 0.0, 1.0, "1", \
         "fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none")
#define KD_SCENE_BODIES 8 /* limit of the number of bodies */

#define KD_VOLUME_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    ENUM(volume, model, MODEL, FRONT, KD_VOLUME_NONE, \
         "matter along the rays. none; uniform: a homogeneous shell at rest. At one radio frequency: gold, the " \
         "analytic model of Gold et al. 2020; riaf, a hot, thin flow whose density, temperature and magnetic field " \
         "are powers of r; torus, a thick disk in equilibrium; grid, numbers from a file", \
         "none|uniform|gold|riaf|torus|grid") \
    WORD(volume, inner, MODEL, REST, INFINITY, 1.0, 3e4, "M", \
         "inner edge; horizon: 1 % outside the horizon, or 0.05 % for the models at a radio frequency; for a torus, " \
         "half of volume.torus_radius", \
         "horizon") \
    REAL(volume, outer, MODEL, FRONT, 20.0, 1.0, 3e4, "M", "outer edge of the matter; larger than the inner edge") \
    REAL(volume, emissivity, MODEL, FRONT, 0.02, 0.0, 1e30, "1/M", \
         "light emitted along 1 M in the matter's frame, in units of the disk's brightest (model: uniform)") \
    REAL(volume, opacity, MODEL, FRONT, 0.02, 0.0, 1e30, "1/M", \
         "optical depth of 1 M in the matter's frame (model: uniform)") \
    REAL(volume, temperature_k, MODEL, REST, 6500.0, 300.0, 1e9, "K", \
         "colour: that of a black body of this temperature, shifted by g (model: uniform)") \
    BOOL(volume, redshift, PHYSICS, REST, true, "include the frequency shift of the matter (model: uniform)") \
    REAL(volume, frequency_ghz, PHYSICS, FRONT, 230.0, 1e-6, 1e12, "GHz", \
         "observed frequency (models: gold, riaf, torus, grid)") \
    ASSET(volume, grid, MODEL, FRONT, \
          "NPZ file with density, temperature, velocity and magnetic field of the electrons on a grid of r, " \
          "theta and phi (model: grid); without it there is no matter") \
    REAL(volume, grid_scale, MODEL, FRONT, 1.0, 0.0, 1e30, "1", \
         "factor on the file's density; the magnetic field is multiplied by the square root of it (model: " \
         "grid)") \
    BOOL(volume, slow_light, PHYSICS, REST, false, \
         "show each place of a grid with several frames at the time when its light left it, instead of the whole " \
         "grid at `time` (model: grid)") \
    REAL(volume, gold_emission, MODEL, REST, 3e-18, 0.0, 1e30, "erg/(s cm^3 Hz sr)", \
         "C n0: emissivity at 230 GHz at the largest density (model: gold)") \
    REAL(volume, gold_index, MODEL, REST, 0.0, -10.0, 10.0, "1", \
         "alpha: emissivity goes as nu^-alpha, absorptivity as nu^-(2.5 + alpha) (model: gold)") \
    REAL(volume, gold_flattening, MODEL, FRONT, 0.0, 0.0, 1e4, "1", \
         "h: density goes as exp(-(h cos(theta))^2/2); 0: round (model: gold)") \
    REAL(volume, gold_momentum, MODEL, REST, 0.0, -1.0, 1.0, "1", \
         "l0: angular momentum over energy is l0 R^(3/2)/(1 + R) with R = r sin(theta); 0: zero angular momentum " \
         "(model: gold)") \
    REAL(volume, gold_absorption, MODEL, REST, 0.0, 0.0, 1e30, "1", \
         "A: absorptivity in 1/cm over emissivity in erg/(s cm^3 Hz sr), at 230 GHz (model: gold)") \
    REAL(volume, density_cm3, MODEL, FRONT, 3e7, 0.0, 1e30, "1/cm^3", \
         "electron density: at r = 1 M in the equatorial plane, by its power law (model: riaf); its maximum " \
         "(model: torus)") \
    REAL(volume, density_index, MODEL, REST, 1.1, -10.0, 10.0, "1", \
         "p: density is proportional to r^-p (model: riaf)") \
    REAL(volume, electron_temperature_k, MODEL, FRONT, 3e11, 1.0, 1e30, "K", \
         "electron temperature at r = 1 M (model: riaf)") \
    REAL(volume, temperature_index, MODEL, REST, 0.84, -10.0, 10.0, "1", \
         "p: electron temperature is proportional to r^-p (model: riaf)") \
    REAL(volume, height, MODEL, REST, 0.1, 0.0, 10.0, "1", \
         "height over the distance from the axis at which the density has fallen to exp(-1/2); 0: the density " \
         "does not depend on height (model: riaf)") \
    REAL(volume, magnetisation, MODEL, REST, 0.016666666666666666, 0.0, 1e12, "1", \
         "magnetic pressure over the rest energy of a proton per electron, at r = 1 M (model: riaf)") \
    REAL(volume, magnetisation_index, MODEL, REST, 1.0, -10.0, 10.0, "1", \
         "p: magnetisation is proportional to r^-p (model: riaf)") \
    ENUM(volume, field, MODEL, REST, KD_VOLUME_TOROIDAL, \
         "direction of the magnetic field: round the axis, along it, or radial; its part along the motion is removed " \
         "(models: riaf, torus)", \
         "toroidal|vertical|radial") \
    ENUM(volume, flow, MODEL, REST, KD_VOLUME_ORBITS, \
         "motion of the matter: with the angular velocity of the circular orbit at each r, and in free fall inside " \
         "the ISCO; or at rest relative to observers of zero angular momentum (model: riaf)", \
         "orbits|rest") \
    ENUM(volume, electrons, MODEL, REST, KD_VOLUME_THERMAL, \
         "energy distribution of the electrons (models: riaf, torus, grid); kappa: thermal with a power-law " \
         "tail", \
         "thermal|power-law|kappa") \
    REAL(volume, electrons_index, MODEL, REST, 3.5, 1.1, 10.0, "1", \
         "p: the number of electrons is proportional to gamma^-p (electrons: power-law)") \
    REAL(volume, kappa, MODEL, REST, 4.0, 3.1, 7.5, "1", \
         "kappa: at high energies the number of electrons is proportional to gamma^(1 - kappa) (electrons: " \
         "kappa)") \
    REAL(volume, torus_radius, MODEL, FRONT, 12.0, 1.0, 1e3, "M", \
         "radius of the largest pressure; the inner edge is volume.inner (model: torus)") \
    REAL(volume, adiabatic_index, MODEL, REST, 1.4444444444444444, 1.1, 2.0, "1", \
         "adiabatic index of the gas (model: torus)") \
    REAL(volume, temperature_ratio, MODEL, REST, 3.0, 0.0, 1e6, "1", \
         "ion temperature over electron temperature (model: torus)") \
    REAL(volume, beta, MODEL, REST, 10.0, 1e-6, 1e12, "1", "gas pressure over magnetic pressure (model: torus)") \
    REAL(volume, gamma_min, MODEL, REST, 30.0, 1.0, 1e9, "1", \
         "smallest Lorentz factor of the electrons (electrons: power-law)") \
    REAL(volume, gamma_max, MODEL, REST, 1e5, 1.0, 1e12, "1", \
         "largest Lorentz factor of the electrons; above gamma_min (electrons: power-law)") \
    REAL(volume, normalise_to_jy, MODEL, REST, 0.0, 0.0, 1e12, "Jy", \
         "flux to which the picture is normalised: kerrd multiplies the density (gold: the emissivity; grid: the " \
         "factor) by a number that small pictures determine, and reports this number; 0: no change (models: gold, " \
         "riaf, torus, grid)") \
    WORD(volume, normalise_ghz, MODEL, REST, INFINITY, 1e-6, 1e12, "GHz", \
         "frequency of that flux; observed: volume.frequency_ghz", "observed")

#define KD_JETS_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(jets, brightness, MODEL, FRONT, 0.0, 0.0, 1e9, "1/M", \
         "light that the jet emits along 1 M in its own frame, in units of the disk's brightest surface brightness. " \
         "It is the value of the power law at the inner edge; the actual light is 0 there and rises smoothly to the " \
         "power law. 0: no jets") \
    REAL(jets, opening_deg, MODEL, FRONT, 8.0, 1.0, 60.0, "degrees", "half of the cone's opening angle") \
    REAL(jets, lorentz, MODEL, FRONT, 2.0, 1.0, 100.0, "1", "Lorentz factor of the outflow") \
    REAL(jets, inner, MODEL, REST, 4.0, 1.0, 1e6, "M", \
         "radius at which the light begins, at least 1.05 times that of the horizon") \
    REAL(jets, outer, MODEL, REST, 60.0, 1.0, 1e6, "M", "radius at which the light ends; larger than the inner edge") \
    REAL(jets, falloff, MODEL, REST, 1.5, -10.0, 10.0, "1", "p: the jet's light is proportional to r^-p") \
    REAL(jets, sheath, MODEL, REST, 0.5, 0.0, 1.0, "1", \
         "distribution of brightness across the jet: 0, a bright spine; 1, bright edges") \
    REAL(jets, spectral_index, MODEL, REST, 0.7, -10.0, 10.0, "1", \
         "index: brightness is proportional to g^(2 + index)") \
    REAL(jets, temperature_k, LOOK, REST, 14000.0, 300.0, 1e9, "K", \
         "colour of a black body of this temperature, not shifted") \
    BOOL(jets, counterjet, MODEL, REST, true, "include the jet below the disk")

#define KD_POLARIZATION_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    ENUM(polarization, model, MODEL, FRONT, KD_POLARIZATION_NONE, \
         "polarisation. none; synchrotron: of light from the disk's plane, perpendicular to polarization.field and " \
         "the ray in the gas's frame; scattering: of light from the disk's plane, by a deep atmosphere of free " \
         "electrons, perpendicular to the normal and the ray; transfer: of a volume at a radio frequency, Stokes I, " \
         "Q, U and V along the rays", \
         "none|synchrotron|scattering|transfer") \
    ENUM(polarization, field, MODEL, REST, KD_FIELD_TOROIDAL, \
         "direction of the magnetic field in the plane: round the axis, outwards, or along the normal (model: " \
         "synchrotron)", \
         "toroidal|radial|vertical") \
    REAL(polarization, electron_index, MODEL, REST, 3.0, 1.0, 10.0, "1", \
         "p: the number of electrons is proportional to E^-p; an ordered field polarises their light by (p + " \
         "1)/(p + 7/3) (model: synchrotron)") \
    REAL(polarization, order, MODEL, REST, 1.0, 0.0, 1.0, "1", \
         "factor on the polarisation, below 1 for a field that is disordered within a pixel") \
    BOOL(polarization, faraday, PHYSICS, REST, true, \
         "include Faraday rotation, and conversion between linear and circular polarisation, by the electrons " \
         "(model: transfer)") \
    ENUM(polarization, rotation, PHYSICS, REST, KD_ROTATION_SHCHERBAKOV, \
         "fit of the Faraday rotation by thermal electrons: Shcherbakov 2008, or Dexter 2016 in the form of " \
         "Huang and Shcherbakov 2011 (model: transfer)", \
         "shcherbakov|dexter")

#define KD_SKY_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    ENUM(sky, model, MODEL, FRONT, KD_SKY_NONE, \
         "sky at infinity: none; a celestial grid that shows the lensing; generated stars and a generated Milky Way; " \
         "the stars of the Hipparcos catalogue over that Milky Way; or sky.image without stars", \
         "none|grid|stars|catalogue|image") \
    WORD(sky, brightness, MODEL, FRONT, INFINITY, 0.0, 100.0, "1", \
         "brightness of the grid, or of a sky of 21 magnitudes per square arcsecond, in units of the disk's " \
         "brightest surface brightness at g = 1; stars and the Milky Way keep their real ratio. auto: 0.2, or 0.01 " \
         "for stars and the Milky Way behind other light", \
         "auto") \
    REAL(sky, grid_deg, MODEL, REST, 15.0, 1.0, 90.0, "degrees", "spacing of the celestial grid") \
    REAL(sky, milky_way, MODEL, FRONT, 1.0, 0.0, 100.0, "1", \
         "factor on the natural brightness of the Milky Way or of sky.image; 0: only stars") \
    ASSET(sky, image, MODEL, FRONT, \
          "picture of the whole sky instead of the generated Milky Way (model: stars, catalogue, image): twice as " \
          "wide as high, with galactic longitude 0 in the middle and rising to the left, latitude rising upwards; " \
          "its white is 21 magnitudes per square arcsecond") \
    REAL(sky, limit_mag, MODEL, REST, 14.0, -2.0, 14.0, "magnitudes", \
         "magnitude of the faintest stars that are shown") \
    INT(sky, seed, MODEL, REST, 1, 0, 2147483647, "1", "seed of the random numbers of the generated sky") \
    ENUM( \
        sky, orientation, MODEL, FRONT, KD_SKY_GALACTIC, \
        "galactic, equatorial: the hole's axis points to that pole of the sky, and azimuth 0 to longitude 0; sgra, " \
        "m87: an observer at azimuth 0 sees the hole where the Earth sees that source, with the galactic pole (sgra) " \
        "or the celestial pole (m87) above", \
        "galactic|equatorial|sgra|m87") \
    REAL(sky, turn_deg, MODEL, REST, 0.0, -360.0, 360.0, "degrees", \
         "rotation of the sky about the hole's axis, in the sense of camera.azimuth_deg") \
    REAL(sky, tilt_deg, MODEL, REST, 0.0, -180.0, 180.0, "degrees", \
         "a second rotation of the sky, about the horizontal axis of the picture from azimuth 0")

#define KD_IMAGE_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    INT(image, width, LOOK, FRONT, 1280, 1, 32768, "pixels", "width of the picture") \
    INT(image, height, LOOK, FRONT, 720, 1, 32768, "pixels", "height of the picture") \
    INT(image, samples, LOOK, FRONT, 1, 1, 8, "1", \
        "rays along each side of a pixel: n gives the mean of n x n rays; auto: one ray, and 16 for pixels that " \
        "differ from their neighbours", \
        "auto") \
    REAL(image, pixel_error, LOOK, REST, 0.003, 0.001, 0.5, "1", \
         "apparent error, as a fraction of white, above which a pixel of one ray gets more rays (samples: auto)") \
    INT(image, critical_factor, LOOK, REST, 4, 1, 16, "1", \
        "factor on the number of rays along each side of pixels at the critical curve, where the photon ring is " \
        "thinner than a pixel; the product is at most 16") \
    INT(image, bit_depth, LOOK, REST, 8, 8, 16, "bits", "bits a channel: 8 or 16") \
    WORDS(image, layers, LOOK, REST, \
          "contents of the file: the picture, or maps of the rays (docs/layers.md) for the first crossing of the " \
          "disk, or with the suffix _N for image order N; a PNG shows one map in false colour, FITS, EXR, NPZ and " \
          "NPY have several as numbers", \
          "rgb|intensity_N|g_N|temperature_N|r_N|phi_N|delay_N|emission_angle_N|order|sky_theta|sky_phi|fate|" \
          "footprint_N|sky_footprint|optical_depth_N|stokes_q_N|stokes_u_N|evpa_N|polarization_fraction_N|brightness_" \
          "temperature|specific_intensity|stokes_v|jy_per_pixel") \
    WORD(image, layer_min, LOOK, REST, INFINITY, -1e12, 1e12, "1", \
         "value at the lower end of a layer's colour scale; auto: docs/layers.md gives it for each layer", "auto") \
    WORD(image, layer_max, LOOK, REST, INFINITY, -1e12, 1e12, "1", \
         "value at the upper end of a layer's colour scale; auto: docs/layers.md gives it for each layer", "auto") \
    BOOL(image, legend, LOOK, REST, true, "draw a colour bar in the lower left corner of a layer in false colour")

#define KD_TILE_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    INT(tile, left, LOOK, REST, 0, 0, 32767, "pixels", "columns of the picture to the left of the tile") \
    INT(tile, top, LOOK, REST, 0, 0, 32767, "pixels", "rows of the picture above the tile") \
    INT(tile, width, LOOK, REST, 0, 0, 32768, "pixels", \
        "width of the tile; 0: no tile, the whole picture is rendered") \
    INT(tile, height, LOOK, REST, 0, 0, 32768, "pixels", \
        "height of the tile; 0: no tile, the whole picture is rendered")

#define KD_STYLE_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    ENUM(style, name, LOOK, FRONT, KD_STYLE_FILM, \
         "style, which sets all fields of the look except those that the document sets; none: no style", \
         "none|film|raw|dngr|eht|starless") \
    WORD(style, exposure, LOOK, FRONT, INFINITY, -40.0, 40.0, "stops", \
         "exposure as an exponent of 2, relative to the disk's brightest surface brightness at g = 1; auto: by the " \
         "light in the picture, with a limit for pictures of stars alone so that empty space is black", \
         "auto") \
    ENUM(style, tone_map, LOOK, FRONT, KD_TONE_ACES, \
         "aces: film-like curve; srgb: proportional to light, clipped; neutral: keeps colours, and compresses light " \
         "near white", \
         "aces|srgb|neutral") \
    REAL(style, bloom, LOOK, FRONT, 0.4, 0.0, 1.0, "1", \
         "share of bright light that the lens spreads around its place: all light over 0.6 of white, with a " \
         "smooth transition from 0.2 on; 0: none") \
    REAL(style, beam_uas, LOOK, REST, 0.0, 0.0, 1e12, "microarcseconds", \
         "full width at half maximum of a round Gaussian telescope beam, seen from spacetime.distance_pc; 0: none") \
    ENUM(style, palette, LOOK, REST, KD_PALETTE_COLOUR, \
         "colour: the colour of the light; heat: brightness in false colour (black, red, orange, white), with " \
         "lightness proportional to it", \
         "colour|heat") \
    BOOL(style, colour_bar, LOOK, REST, false, \
         "draw a brightness bar in the lower left corner (palette: heat; tone_map: srgb), and in the upper " \
         "right corner an angular scale and the shape of the beam") \
    BOOL(style, dither, LOOK, REST, true, "add half a step of ordered noise before rounding, against banding") \
    REAL(style, ringdown, LOOK, REST, 0.0, 0.0, 1.0, "1", \
         "illustration of a struck hole: light of image orders 1 and up is multiplied by 1 + ringdown e^(-t/tau) " \
         "cos(w t), with the hole's quasi-normal mode l = m = 2, n = 0; 0: none") \
    REAL(style, ringdown_time, LOOK, REST, 0.0, -1e12, 1e12, "M", \
         "time at which the hole was struck, and the ringing begins")

#define KD_SOURCE_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    ENUM(source, name, MODEL, FRONT, KD_SOURCE_NONE, "the source on the sky that the hole represents", \
         "none|m87|sgra") \
    REAL(source, ra_deg, MODEL, REST, 0.0, 0.0, 360.0, "degrees", "right ascension of the hole (ICRS)") \
    REAL(source, dec_deg, MODEL, REST, 0.0, -90.0, 90.0, "degrees", "declination of the hole (ICRS)") \
    WORD(source, mjd, MODEL, REST, INFINITY, 0.0, 1e6, "days", "date of the picture, as a modified Julian date", "none")

#define KD_MOTION_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(motion, azimuth_rate_deg, LOOK, FRONT, 0.0, -360.0, 360.0, "degrees per second", \
         "rate at which the observer goes round the axis") \
    REAL(motion, time_rate, LOOK, FRONT, 0.0, -1e6, 1e6, "M per second", "rate of coordinate time") \
    REAL(motion, proper_time_rate, LOOK, REST, 0.0, 0.0, 1e6, "M per second", \
         "rate of the observer's proper time: the observer moves along its path, a fall to the last possible " \
         "position or an orbit; coordinate time follows")

/* Words that both scenes and requests for rays use. */
#define KD_PROFILE_WORDS "draft|interactive|balanced|high|reference"
#define KD_ENGINE_WORDS "auto|closed|mino-rkn4|mino-rkn6|ks-euler|ks-rk4|ks-tao6"
#define KD_PRECISION_WORDS "auto|f32|f64"
#define KD_ACCURACY_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    ENUM(accuracy, profile, PHYSICS, FRONT, KD_PROFILE_BALANCED, \
         "accuracy with which rays are traced, from coarse to fine; reference: double precision", KD_PROFILE_WORDS) \
    WORD(accuracy, tolerance, PHYSICS, REST, INFINITY, 1e-18, 0.1, "1", \
         "largest relative error of the crossing radii, by the accuracy table of the device; profile: the error of " \
         "accuracy.profile", \
         "profile") \
    ENUM(accuracy, engine, PHYSICS, REST, KD_ENGINE_WORD_AUTO, \
         "method that traces the rays; auto: the closed form outside the photon orbits, otherwise mino-rkn6", \
         KD_ENGINE_WORDS) \
    ENUM(accuracy, precision, PHYSICS, REST, KD_PRECISION_WORD_AUTO, \
         "precision of the arithmetic; auto: chosen by accuracy.profile", KD_PRECISION_WORDS) \
    INT(accuracy, steps, PHYSICS, REST, 0, 0, 2048, "1", \
        "integrator steps for a half turn, a multiple of 4; 0: chosen by accuracy.profile") \
    INT(accuracy, orders, PHYSICS, REST, 3, 1, 8, "1", \
        "equatorial crossings kept for each ray: image orders 0 to n - 1")

#define KD_TOP_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(top, time, PHYSICS, FRONT, 0.0, -1e12, 1e12, "M", "coordinate time of the picture")

/* The sections, in order. SECTION(name, rows, group, help) is one object. LIST(name, element, rows, group, most,
 * help) is a list of up to `most` elements that all have these rows. The rows of the section "top" are members of
 * the document itself. */
#define KD_SCENE_SECTIONS(SECTION, LIST) \
    SECTION(spacetime, KD_SPACETIME_FIELDS, HOLE, "the hole") \
    SECTION(camera, KD_CAMERA_FIELDS, CAMERA, "position, motion and view of the observer") \
    SECTION(disk, KD_DISK_FIELDS, GAS, "the accretion disk in the equatorial plane, turning towards +phi") \
    SECTION(gas, KD_GAS_FIELDS, GAS, "turbulence in the gas of the smooth disk models") \
    LIST(spots, spot, KD_SPOTS_FIELDS, GAS, KD_SPOTS, \
         "hot spots: Gaussians in the equatorial plane that go round with the gas") \
    SECTION(flash, KD_FLASH_FIELDS, GAS, "a flash of a lamp on the axis, which runs over the thin disk") \
    LIST(bodies, body, KD_BODIES_FIELDS, GAS, KD_SCENE_BODIES, "bodies: luminous spheres round the hole") \
    SECTION(volume, KD_VOLUME_FIELDS, GAS, "matter along the rays") \
    SECTION(jets, KD_JETS_FIELDS, GAS, "stylised jets along the spin axis") \
    SECTION(polarization, KD_POLARIZATION_FIELDS, MORE, \
            "polarisation of light, as layers and ticks show it; in a picture it changes only the light of volumes") \
    SECTION(sky, KD_SKY_FIELDS, LOOK, "the sky at infinity") \
    SECTION(image, KD_IMAGE_FIELDS, MORE, "the size of the picture") \
    SECTION(tile, KD_TILE_FIELDS, MORE, "a part of the picture, rendered alone, with the same bytes as in the whole") \
    SECTION(style, KD_STYLE_FIELDS, LOOK, "from brightness to the colours of the file") \
    SECTION(source, KD_SOURCE_FIELDS, MORE, \
            "the source on the sky that the hole represents, for FITS files; it changes no pixel") \
    SECTION(motion, KD_MOTION_FIELDS, CAMERA, "motion in a live session; a still picture ignores it") \
    SECTION(accuracy, KD_ACCURACY_FIELDS, MORE, "accuracy of the rays") \
    SECTION(top, KD_TOP_FIELDS, CAMERA, "members of the document itself")

/* Sections that are members of another section of the document: PART(s, name, section). s is passed through to PART. */
#define KD_SCENE_PARTS(PART, s) PART(s, gas, disk) PART(s, tile, image)

/* Styles. A document that names a style in style.name gets the style's values for these fields, except for fields
 * that the document sets itself (scene/style.h). ROW(section, name, values) has one value of the field for each word
 * of style.name except "none". Values have the form that kd_field_put accepts. The fields belong to sections that
 * are not lists. NAN: the style leaves the field unchanged.
 *
 * film: a bright scene, seen by the eye through a lens. raw: light without post-processing. dngr: as in
 * Interstellar, without the frequency shifts of the disk's gas, with lens flare (O. James et al. 2015, section 4.3).
 * eht: as the Event Horizon Telescope shows its pictures, at its resolution of about 20 microarcseconds (EHT
 * Collaboration 2019, ApJL 875, L4). starless: no disk, but a lensed synthetic sky, as in R. Antonelli's ray tracer
 * of that name (2015). */
#define KD_STYLES 5
#define KD_SCENE_STYLES(ROW) \
    /* columns: film, raw, dngr, eht, starless */ \
    ROW(disk, model, NAN, NAN, NAN, NAN, KD_DISK_NONE) \
    ROW(disk, doppler, 1, 1, 0, 1, 1) \
    ROW(disk, redshift, 1, 1, 0, 1, 1) \
    ROW(sky, model, NAN, NAN, NAN, NAN, KD_SKY_STARS) \
    ROW(style, exposure, NAN, NAN, NAN, NAN, 0.5) \
    ROW(style, tone_map, KD_TONE_ACES, KD_TONE_SRGB, KD_TONE_ACES, KD_TONE_SRGB, KD_TONE_ACES) \
    ROW(style, bloom, 0.4, 0, 0.4, 0, 0.4) \
    ROW(style, beam_uas, 0, 0, 0, 20, 0) \
    ROW(style, palette, KD_PALETTE_COLOUR, KD_PALETTE_COLOUR, KD_PALETTE_COLOUR, KD_PALETTE_HEAT, KD_PALETTE_COLOUR) \
    ROW(style, colour_bar, 0, 0, 0, 1, 0) \
    ROW(style, dither, 1, 0, 1, 1, 1)

/* Sky models that include diffuse light between the stars, or that are a picture of it. */
/* clang-format off */
#define KD_WITH_SPREAD_(WITH, path) \
    WITH(path, "model", KD_SKY_STARS) WITH(path, "model", KD_SKY_CATALOGUE) WITH(path, "model", KD_SKY_IMAGE)
/* clang-format on */

#define KD_HOLE_SPAN_(SPAN, name, member, least, most, shown, ...) SPAN("spacetime." #name, least, shown)

/* Controls of the page (scene/control.h). Fields are named by their paths, without an index for lists. The rows of a
 * section must be adjacent. */
/* clang-format off */
#define KD_SCENE_CONTROLS(SPAN, FIRST, SWITCH, WITH, VARIES, BUTTON) \
    SPAN("spacetime.spin", -0.998, 0.998) \
    KD_HOLE_MORE(KD_HOLE_SPAN_, SPAN) \
    SPAN("spacetime.mass_msun", 1, 1e10) \
    SPAN("spacetime.distance_pc", 1e3, 1e9) \
    SPAN("camera.r", 2.1, 1000) FIRST("camera.r", 60) \
    SPAN("camera.field_m", 4, 400) \
    SPAN("camera.field_uas", 20, 2000) FIRST("camera.field_uas", 200) \
    SPAN("camera.fov_deg", 2, 120) \
    SPAN("camera.azimuth_deg", -180, 180) \
    SPAN("camera.centre_alpha", -50, 50) \
    SPAN("camera.centre_beta", -50, 50) \
    SPAN("camera.roll_deg", -180, 180) \
    WITH("camera.eye_distance", "stereo", KD_STEREO_PAIR) SPAN("camera.eye_distance", 0.01, 10) \
    SPAN("camera.infall_from", 2.1, 1000) FIRST("camera.infall_from", 100) \
    SPAN("camera.infall_energy", 0, 10) FIRST("camera.infall_energy", 1) \
    SPAN("camera.infall_momentum", -5, 5) \
    BUTTON("disk.model", KD_DISK_PARTICLES, "Disk of particles") \
    SPAN("disk.inner", 1, 50) FIRST("disk.inner", 6) \
    SPAN("disk.outer", 3, 200) \
    WITH("disk.peak_temperature_k", "colour", KD_COLOUR_PEAK) SPAN("disk.peak_temperature_k", 1000, 1e5) \
    WITH("disk.mdot_edd", "colour", KD_COLOUR_ACCRETION) SPAN("disk.mdot_edd", 1e-3, 10) \
    WITH("disk.frequency_ghz", "band", KD_BAND_FREQUENCY) SPAN("disk.frequency_ghz", 10, 1e9) \
    WITH("disk.albedo", "returning", KD_RETURNS_REFLECTED) \
    VARIES("disk.slow_light", "moves_with_time") \
    WITH("disk.particles", "model", KD_DISK_PARTICLES) \
    WITH("disk.seed", "model", KD_DISK_PARTICLES) SPAN("disk.seed", 0, 1000) \
    WITH("disk.density_index", "model", KD_DISK_PARTICLES) \
    WITH("disk.plunging", "model", KD_DISK_PARTICLES) \
    WITH("disk.plunging_temperature", "model", KD_DISK_PARTICLES) \
    WITH("disk.epicycles", "model", KD_DISK_PARTICLES) \
    SWITCH("disk.gas.amplitude") \
    SPAN("disk.gas.seed", 0, 1000) \
    SWITCH("spots.brightness") BUTTON("spots.brightness", 4, "Hot spot") \
    SWITCH("flash.brightness") BUTTON("flash.brightness", 1, "Flash") \
    SPAN("flash.height", 2, 100) SPAN("flash.start", -100, 100) SPAN("flash.duration", 0.1, 20) \
    SPAN("flash.period", 0, 500) \
    SWITCH("bodies.radius") SPAN("bodies.radius", 0.1, 20) BUTTON("bodies.radius", 2, "Body") \
    SPAN("bodies.r", 3, 200) SPAN("bodies.phase_deg", -180, 180) SPAN("bodies.temperature_k", 1000, 1e5) \
    WITH("bodies.velocity_r", "motion", KD_OBSERVER_VELOCITY) \
    WITH("bodies.velocity_theta", "motion", KD_OBSERVER_VELOCITY) \
    WITH("bodies.velocity_phi", "motion", KD_OBSERVER_VELOCITY) \
    SWITCH("volume.model") SPAN("volume.outer", 3, 200) \
    SPAN("volume.inner", 1, 100) FIRST("volume.inner", 6) \
    WITH("volume.emissivity", "model", KD_VOLUME_UNIFORM) SPAN("volume.emissivity", 1e-4, 10) \
    WITH("volume.opacity", "model", KD_VOLUME_UNIFORM) SPAN("volume.opacity", 1e-4, 10) \
    WITH("volume.temperature_k", "model", KD_VOLUME_UNIFORM) SPAN("volume.temperature_k", 1000, 1e5) \
    WITH("volume.redshift", "model", KD_VOLUME_UNIFORM) \
    WITH("volume.frequency_ghz", "model", KD_VOLUME_GOLD) WITH("volume.frequency_ghz", "model", KD_VOLUME_RIAF) \
    WITH("volume.frequency_ghz", "model", KD_VOLUME_TORUS) WITH("volume.frequency_ghz", "model", KD_VOLUME_GRID) \
    SPAN("volume.frequency_ghz", 10, 1e4) \
    WITH("volume.grid", "model", KD_VOLUME_GRID) WITH("volume.grid_scale", "model", KD_VOLUME_GRID) \
    SPAN("volume.grid_scale", 1e-4, 1e4) \
    WITH("volume.slow_light", "model", KD_VOLUME_GRID) \
    WITH("volume.gold_emission", "model", KD_VOLUME_GOLD) SPAN("volume.gold_emission", 1e-20, 1e-15) \
    WITH("volume.gold_index", "model", KD_VOLUME_GOLD) SPAN("volume.gold_index", -4, 4) \
    WITH("volume.gold_flattening", "model", KD_VOLUME_GOLD) SPAN("volume.gold_flattening", 0, 40) \
    WITH("volume.gold_momentum", "model", KD_VOLUME_GOLD) \
    WITH("volume.gold_absorption", "model", KD_VOLUME_GOLD) SPAN("volume.gold_absorption", 0, 1e6) \
    WITH("volume.density_cm3", "model", KD_VOLUME_RIAF) WITH("volume.density_cm3", "model", KD_VOLUME_TORUS) \
    SPAN("volume.density_cm3", 10000, 1e+10) \
    WITH("volume.density_index", "model", KD_VOLUME_RIAF) SPAN("volume.density_index", 0, 3) \
    WITH("volume.electron_temperature_k", "model", KD_VOLUME_RIAF) SPAN("volume.electron_temperature_k", 1e+09, 1e+13) \
    WITH("volume.temperature_index", "model", KD_VOLUME_RIAF) SPAN("volume.temperature_index", 0, 2) \
    WITH("volume.height", "model", KD_VOLUME_RIAF) SPAN("volume.height", 0, 1) \
    WITH("volume.magnetisation", "model", KD_VOLUME_RIAF) SPAN("volume.magnetisation", 0.0001, 1) \
    WITH("volume.magnetisation_index", "model", KD_VOLUME_RIAF) SPAN("volume.magnetisation_index", 0, 3) \
    WITH("volume.field", "model", KD_VOLUME_RIAF) WITH("volume.field", "model", KD_VOLUME_TORUS) \
    WITH("volume.flow", "model", KD_VOLUME_RIAF) \
    WITH("volume.electrons", "model", KD_VOLUME_RIAF) WITH("volume.electrons", "model", KD_VOLUME_TORUS) \
    WITH("volume.electrons", "model", KD_VOLUME_GRID) \
    WITH("volume.kappa", "electrons", KD_VOLUME_KAPPA) \
    WITH("volume.torus_radius", "model", KD_VOLUME_TORUS) SPAN("volume.torus_radius", 5, 50) \
    WITH("volume.adiabatic_index", "model", KD_VOLUME_TORUS) \
    WITH("volume.temperature_ratio", "model", KD_VOLUME_TORUS) SPAN("volume.temperature_ratio", 1, 100) \
    WITH("volume.beta", "model", KD_VOLUME_TORUS) SPAN("volume.beta", 0.1, 1000) \
    WITH("volume.electrons_index", "electrons", KD_VOLUME_POWER_LAW) SPAN("volume.electrons_index", 2, 6) \
    WITH("volume.gamma_min", "electrons", KD_VOLUME_POWER_LAW) SPAN("volume.gamma_min", 1, 1000) \
    WITH("volume.gamma_max", "electrons", KD_VOLUME_POWER_LAW) SPAN("volume.gamma_max", 1000, 1e+07) \
    WITH("volume.normalise_to_jy", "model", KD_VOLUME_GOLD) WITH("volume.normalise_to_jy", "model", KD_VOLUME_RIAF) \
    WITH("volume.normalise_to_jy", "model", KD_VOLUME_TORUS) WITH("volume.normalise_to_jy", "model", KD_VOLUME_GRID) \
    SPAN("volume.normalise_to_jy", 0, 10) \
    WITH("volume.normalise_ghz", "model", KD_VOLUME_GOLD) WITH("volume.normalise_ghz", "model", KD_VOLUME_RIAF) \
    WITH("volume.normalise_ghz", "model", KD_VOLUME_TORUS) WITH("volume.normalise_ghz", "model", KD_VOLUME_GRID) \
    SPAN("volume.normalise_ghz", 10, 1e4) FIRST("volume.normalise_ghz", 230) \
    SWITCH("jets.brightness") SPAN("jets.brightness", 0.001, 10) BUTTON("jets.brightness", 0.1, "Jets") \
    SPAN("jets.lorentz", 1, 10) SPAN("jets.outer", 5, 500) SPAN("jets.inner", 1, 50) \
    SWITCH("polarization.model") \
    WITH("polarization.field", "model", KD_POLARIZATION_SYNCHROTRON) \
    WITH("polarization.electron_index", "model", KD_POLARIZATION_SYNCHROTRON) \
    SPAN("polarization.electron_index", 1, 5) \
    WITH("polarization.order", "model", KD_POLARIZATION_SYNCHROTRON) \
    WITH("polarization.order", "model", KD_POLARIZATION_SCATTERING) \
    WITH("polarization.order", "model", KD_POLARIZATION_TRANSFER) \
    WITH("polarization.faraday", "model", KD_POLARIZATION_TRANSFER) \
    WITH("polarization.rotation", "model", KD_POLARIZATION_TRANSFER) \
    SWITCH("sky.model") \
    SPAN("sky.brightness", 1e-4, 1) FIRST("sky.brightness", 0.01) \
    WITH("sky.grid_deg", "model", KD_SKY_GRID) \
    SPAN("sky.milky_way", 0, 4) KD_WITH_SPREAD_(WITH, "sky.milky_way") \
    KD_WITH_SPREAD_(WITH, "sky.image") \
    WITH("sky.limit_mag", "model", KD_SKY_STARS) WITH("sky.limit_mag", "model", KD_SKY_CATALOGUE) \
    SPAN("sky.seed", 0, 1000) KD_WITH_SPREAD_(WITH, "sky.seed") \
    KD_WITH_SPREAD_(WITH, "sky.orientation") KD_WITH_SPREAD_(WITH, "sky.turn_deg") \
    KD_WITH_SPREAD_(WITH, "sky.tilt_deg") \
    FIRST("image.samples", 2) \
    WITH("image.pixel_error", "samples", INFINITY) \
    SPAN("style.exposure", -10, 10) FIRST("style.exposure", 0) \
    SPAN("style.beam_uas", 0, 50) \
    WITH("style.colour_bar", "palette", KD_PALETTE_HEAT) \
    SPAN("style.ringdown_time", -1000, 1000) \
    SPAN("accuracy.tolerance", 1e-12, 1e-2) FIRST("accuracy.tolerance", 1e-6) \
    SPAN("motion.time_rate", -100, 100) VARIES("motion.time_rate", "moves_with_time|dims_with_time") \
    SPAN("motion.proper_time_rate", 0, 20) \
    SPAN("time", -1000, 1000) VARIES("time", "moves_with_time|dims_with_time")
/* clang-format on */

/* Obsolete names of list elements: OLD(name, list, index). They are still read, but never written. */
#define KD_SCENE_OLD_NAMES(OLD) OLD(spot1, spots, 0) OLD(spot2, spots, 1) OLD(spot3, spots, 2)

enum kd_projection {
    KD_PROJECTION_AUTO,
    KD_PROJECTION_PLANE,
    KD_PROJECTION_PINHOLE,
    KD_PROJECTION_RING,
    KD_PROJECTION_EQUIRECTANGULAR,
    KD_PROJECTION_FULLDOME
};
enum kd_stereo { KD_STEREO_NONE, KD_STEREO_PAIR };
enum kd_source_name { KD_SOURCE_NONE, KD_SOURCE_M87, KD_SOURCE_SGRA };
enum kd_disk_model { KD_DISK_NONE, KD_DISK_NOVIKOV_THORNE, KD_DISK_SHAKURA_SUNYAEV, KD_DISK_PARTICLES };
enum kd_volume_model {
    KD_VOLUME_NONE,
    KD_VOLUME_UNIFORM,
    KD_VOLUME_GOLD,
    KD_VOLUME_RIAF,
    KD_VOLUME_TORUS,
    KD_VOLUME_GRID
};
enum kd_polarization_model {
    KD_POLARIZATION_NONE,
    KD_POLARIZATION_SYNCHROTRON,
    KD_POLARIZATION_SCATTERING,
    KD_POLARIZATION_TRANSFER
};
enum kd_polarization_rotation { KD_ROTATION_SHCHERBAKOV, KD_ROTATION_DEXTER };
enum kd_polarization_field { KD_FIELD_TOROIDAL, KD_FIELD_RADIAL, KD_FIELD_VERTICAL };
enum kd_volume_field { KD_VOLUME_TOROIDAL, KD_VOLUME_VERTICAL, KD_VOLUME_RADIAL };
enum kd_volume_flow { KD_VOLUME_ORBITS, KD_VOLUME_REST };
enum kd_volume_electrons { KD_VOLUME_THERMAL, KD_VOLUME_POWER_LAW, KD_VOLUME_KAPPA };
enum kd_colour { KD_COLOUR_PEAK, KD_COLOUR_ACCRETION };
enum kd_atmosphere { KD_ATMOSPHERE_ISOTROPIC, KD_ATMOSPHERE_LAOR, KD_ATMOSPHERE_SCATTERING };
enum kd_returns { KD_RETURNS_NONE, KD_RETURNS_THERMALISED, KD_RETURNS_REFLECTED };
enum kd_band { KD_BAND_BOLOMETRIC, KD_BAND_VISIBLE, KD_BAND_FREQUENCY };
enum kd_sky_model { KD_SKY_NONE, KD_SKY_GRID, KD_SKY_STARS, KD_SKY_CATALOGUE, KD_SKY_IMAGE };
enum kd_sky_orientation { KD_SKY_GALACTIC, KD_SKY_EQUATORIAL, KD_SKY_SGRA, KD_SKY_M87 };
enum { KD_STYLE_NONE, KD_STYLE_FILM };
enum kd_tone_map { KD_TONE_ACES, KD_TONE_SRGB, KD_TONE_NEUTRAL };
enum kd_palette { KD_PALETTE_COLOUR, KD_PALETTE_HEAT };
enum kd_profile {
    KD_PROFILE_DRAFT,
    KD_PROFILE_INTERACTIVE,
    KD_PROFILE_BALANCED,
    KD_PROFILE_HIGH,
    KD_PROFILE_REFERENCE,
};
enum { KD_ENGINE_WORD_AUTO, KD_PRECISION_WORD_AUTO = 0 }; /* all other words are in render/accuracy/engine.h */

#endif
