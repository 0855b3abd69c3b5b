// The requests and answers of a kerrd server as types. This file is generated: change src/server/openapi, then run
// clients/javascript/generate.py.

/** A body that is not JSON. */
export type Binary = Blob | ArrayBuffer | Uint8Array | string;

/** A merge patch (RFC 7396): null takes a field to its default; of a list, single elements by their index. */
export type Patch<T> = T extends readonly (infer E)[]
  ? T | { [index: number]: Patch<E> | null }
  : T extends object
    ? { [K in keyof T]?: Patch<T[K]> | null }
    : T;

/** The name of a preset. */
export type PresetName =
  | 'smooth' | 'schwarzschild' | 'reissner-nordstrom' | 'gargantua' | 'm87' | 'sgra' | 'luminet1979' | 'edge-on'
  | 'face-on' | 'photon-rings' | 'living-disk' | 'hot-spot' | 'echo' | 'milky-way' | 'gas' | 'gas-stars' | 'thick-disk'
  | 'star-behind' | 'companions' | 'falling' | 'infall' | 'jet' | 'gargantua-gas' | 'polarised-ring' | 'gold-1'
  | 'gold-2' | 'gold-3' | 'gold-4' | 'gold-5' | 'riaf' | 'torus';

export interface Scene {
  /** version of this document format. */
  version?: 1;
  /** the hole. */
  spacetime?: {
    /**
     * spin parameter a; a < 0: the disk is retrograde to its hole; in M; -0.999999999999 to 0.999999999999; default
     * 0.7.
     */
    spin?: number;
    /**
     * electric charge Q of the hole (Kerr-Newman), which acts on space-time alone: light and matter are neutral; in
     * M; 0 to 0.999999999999; default 0.
     */
    charge?: number;
    /**
     * mass of the hole; sets the temperature when disk.colour is "accretion"; in solar masses; 0.001 to 1e+12;
     * default 100000000.
     */
    mass_msun?: number;
    /**
     * angular diameter distance of the hole; with the mass it determines the width of a picture on the sky, for a
     * beam and a scale bar; in pc; 0.001 to 100000000000; default 260000.
     */
    distance_pc?: number;
  };
  /** position, motion and view of the observer. */
  camera?: {
    /** Boyer-Lindquist radius of the observer; in M; 0.01 to 10000000; default "infinity". */
    r?: 'infinity' | number;
    /**
     * polar angle of the observer: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to 180;
     * default 82.
     */
    inclination_deg?: number;
    /**
     * Boyer-Lindquist azimuth of the observer; for a falling observer the ingoing Kerr-Schild azimuth, which is the
     * same far away; in degrees; -360 to 360; default 0.
     */
    azimuth_deg?: number;
    /**
     * state of motion at a finite radius; static: at rest with respect to infinity; zamo: with zero angular
     * momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude; retrograde: on
     * a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free fall, by default
     * from rest at infinity; velocity: with any velocity relative to the observer of zero angular momentum; default
     * "static".
     */
    observer?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
    /**
     * outward velocity in the frame of the local observer of zero angular momentum (observer: velocity); in c; -1
     * to 1; default 0.
     */
    velocity_r?: number;
    /**
     * velocity away from the north pole, in the frame of the local observer of zero angular momentum (observer:
     * velocity); in c; -1 to 1; default 0.
     */
    velocity_theta?: number;
    /**
     * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (observer:
     * velocity); in c; -1 to 1; default 0.
     */
    velocity_phi?: number;
    /**
     * radius at which the observer's fall begins, at rest except for its angular momentum (observer: infall); in M;
     * 1 to 10000000; default "infinity".
     */
    infall_from?: 'infinity' | number;
    /**
     * energy per mass of the falling observer; rest: the energy that follows from infall_from (observer: infall);
     * -100 to 1000; default "rest".
     */
    infall_energy?: 'rest' | number;
    /**
     * angular momentum per mass of the falling observer, which moves in r and azimuth but not in latitude
     * (observer: infall); in M; -10000 to 10000; default 0.
     */
    infall_momentum?: number;
    /**
     * plane: parallel rays, image plane in M, at infinity only; pinhole: at a finite radius only; ring: the angle
     * round the critical curve across, the logarithm of the distance to it upwards, at infinity only;
     * equirectangular: all directions from a finite radius, longitude to the right and latitude upwards; fulldome:
     * the angle from the middle as distance, 90 degrees at the nearer edges, from a finite radius; auto: plane at
     * infinity, otherwise pinhole; default "auto".
     */
    projection?: 'auto' | 'plane' | 'pinhole' | 'ring' | 'equirectangular' | 'fulldome';
    /** width of the image plane (plane projection); in M; 1e-06 to 10000000; default 46. */
    field_m?: number;
    /**
     * width of the image plane on the sky, at spacetime.mass_msun and spacetime.distance_pc; it sets
     * camera.field_m; none: camera.field_m is used; in microarcseconds; 1e-12 to 1e+12; default "none".
     */
    field_uas?: 'none' | number;
    /** horizontal field of view (pinhole projection); in degrees; 1e-06 to 179; default 50. */
    fov_deg?: number;
    /** image-plane alpha at the middle of the picture (plane); in M; -10000000 to 10000000; default 0. */
    centre_alpha?: number;
    /** image-plane beta at the middle of the picture (plane); in M; -10000000 to 10000000; default 0. */
    centre_beta?: number;
    /** look to the right of the hole (from a finite radius); in degrees; -180 to 180; default 0. */
    yaw_deg?: number;
    /** look above the hole (from a finite radius); in degrees; -90 to 90; default 0. */
    pitch_deg?: number;
    /**
     * turn the camera clockwise about its axis; ring: the angle in the middle of the picture, 0 at alpha > 0,
     * rising to the right; in degrees; -360 to 360; default 0.
     */
    roll_deg?: number;
    /**
     * pair: two pictures side by side, the left eye's on the left, each image.width wide and in pinhole projection;
     * none: one eye; default "none".
     */
    stereo?: 'none' | 'pair';
    /**
     * distance between the eyes, perpendicular to the viewing direction (stereo: pair); in M; 1e-06 to 1000000;
     * default 0.5.
     */
    eye_distance?: number;
    /**
     * log10 of the distance between the critical curve and the picture's upper and lower edges, in units of the
     * curve's radius (ring); in decades; -12 to 0; default 0.
     */
    ring_decades_max?: number;
    /**
     * log10 of the distance to the critical curve at the picture's middle line; rays above the line pass outside
     * the curve, rays below it inside (ring); in decades; -13 to -1; default -10.
     */
    ring_decades_min?: number;
  };
  /** the accretion disk in the equatorial plane, turning towards +phi. */
  disk?: {
    /**
     * radial flux: none; the exact Page-Thorne integral; the Newtonian thin disk cut at the ISCO; or particles: the
     * exact flux, as orbiting particles; default "novikov-thorne".
     */
    model?: 'none' | 'novikov-thorne' | 'shakura-sunyaev' | 'particles';
    /** inner edge; at least the ISCO; in M; 1 to 1000000; default "isco". */
    inner?: 'isco' | number;
    /** outer edge; larger than the inner one; in M; 1 to 1000000; default 22. */
    outer?: number;
    /** outer fraction of the radius over which the disk fades out; 0: a sharp edge; 0 to 1; default 0.7. */
    taper?: number;
    /** opacity of one crossing; 1 is optically thick; 0 to 1; default 1. */
    opacity?: number;
    /**
     * optical depth along the normal where the disk is brightest; elsewhere it is proportional to the flux. A
     * crossing has the opacity 1 - exp(-depth/cos) times disk.opacity, with the angle of emission in the gas's
     * frame; 0: the same opacity everywhere; 0 to 1000000; default 10.
     */
    emission_opacity?: number;
    /**
     * relative half height H/R at R = 10 M: H is the height above the plane at which the density has fallen to
     * exp(-1/2), R the distance from the axis; the optical depth from top to bottom is that of the thin disk; 0: a
     * thin disk; 0 to 0.5; default 0.
     */
    height?: number;
    /** exponent p: H/R is proportional to R^p (disk.height); -0.5 to 0.5; default 0. */
    flare?: number;
    /**
     * temperature scale: a chosen peak temperature, or from spacetime.mass_msun and disk.mdot_edd; default "peak".
     */
    colour?: 'peak' | 'accretion';
    /**
     * largest effective temperature of the disk, in its own frame (colour: peak); in K; 300 to 1000000000; default
     * 3600.
     */
    peak_temperature_k?: number;
    /**
     * accretion rate: luminosity over the Eddington luminosity, with the efficiency for this spin; in Eddington
     * rates; 1e-12 to 1000; default 0.1.
     */
    mdot_edd?: number;
    /** colour temperature over effective temperature; 1 to 3; default 1. */
    hardening?: number;
    /**
     * how the light of the thin disk's surface depends on mu, the cosine of the angle to its normal in the gas's
     * frame. isotropic; laor: as 1 + 2.06 mu; scattering: as from a deep atmosphere of free electrons, which
     * polarization.model "scattering" polarises. Each law has the disk's flux; default "isotropic".
     */
    atmosphere?: 'isotropic' | 'laor' | 'scattering';
    /**
     * light that the hole bends back to the disk. none: it is ignored; thermalised: the disk absorbs it with its
     * angular momentum, and radiates it again as a black body; reflected: the disk reflects the share disk.albedo
     * with the spectrum of the arriving light, and thermalises the rest. Light may return any number of times;
     * default "none".
     */
    returning?: 'none' | 'thermalised' | 'reflected';
    /** share of the returning light that is reflected; 0 to 1; default 0.5. */
    albedo?: number;
    /**
     * brightness: bolometric, g^4 F; visible, the luminance that the eye perceives of the Planck spectrum; or
     * frequency, the specific intensity at disk.frequency_ghz, in physical units; default "bolometric".
     */
    band?: 'bolometric' | 'visible' | 'frequency';
    /** observed frequency (band: frequency); in GHz; 1e-06 to 1e+12; default 230. */
    frequency_ghz?: number;
    /** include the Doppler shift and beaming of the orbiting gas; default true. */
    doppler?: boolean;
    /** include the gravitational redshift and time dilation of the orbiting gas; default true. */
    redshift?: boolean;
    /** number of particles (model: particles); 1000 to 10000000; default 300000. */
    particles?: number;
    /** seed of the random numbers that place the particles (model: particles); 0 to 2147483647; default 1. */
    seed?: number;
    /**
     * p: the number of particles per area is proportional to r^-p; for p = 2 every octave of r has the same number
     * (model: particles); 0 to 4; default 2.
     */
    density_index?: number;
    /**
     * share of the particles that fall from the ISCO, with its energy and angular momentum; none fall unless
     * disk.inner is "isco" (model: particles); 0 to 0.5; default 0.02.
     */
    plunging?: number;
    /**
     * temperature of the plunging gas over the disk's largest temperature; 0: it is invisible (model: particles); 0
     * to 1; default 0.7.
     */
    plunging_temperature?: number;
    /**
     * largest amplitude of oscillations in latitude, in radians; times (kappa/Omega)^2, which vanishes at the ISCO,
     * also the largest relative amplitude of oscillations in r (model: particles); 0 to 0.2; default 0.02.
     */
    epicycles?: number;
    /**
     * show particles, gas, spots and a flash at the time when the light of each ray left them, instead of at one
     * coordinate time; default false.
     */
    slow_light?: boolean;
    /** turbulence in the gas of the smooth disk models. */
    gas?: {
      /**
       * turbulence: standard deviation of the logarithm of the flux, and of the optical depth; 0: a smooth disk; 0 to
       * 3; default 0.8.
       */
      amplitude?: number;
      /** number of scales of the turbulence; each scale is about half the one before; 1 to 8; default 6. */
      octaves?: number;
      /** size of the largest eddies over r, before shear stretches them; 0.02 to 2; default 0.4. */
      scale?: number;
      /**
       * azimuth by which streaks trail, in radians for each unit of ln r; below 0 they lead. Streaks are 1 + shear^2
       * times as long as they are wide; -20 to 20; default 5.
       */
      shear?: number;
      /** seed of the random numbers of the turbulence; 0 to 2147483647; default 1. */
      seed?: number;
    };
  };
  /** hot spots: Gaussians in the equatorial plane that go round with the gas; up to 16; default []. */
  spots?: {
    /**
     * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
     * to 1000000; default 0.
     */
    brightness?: number;
    /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
    r?: number;
    /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
    phase_deg?: number;
    /**
     * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
     * default 1.
     */
    size?: number;
    /**
     * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
     * index); -4 to 6; default 1.
     */
    index?: number;
    /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
    temperature_k?: number;
  }[];
  /** a flash of a lamp on the axis, which runs over the thin disk. */
  flash?: {
    /**
     * surface brightness in the gas's frame where the flash lights the disk most, at its peak, in units of the
     * disk's brightest; 0: no flash; 0 to 1000000; default 0.
     */
    brightness?: number;
    /**
     * Boyer-Lindquist radius of the lamp on the axis; at least 1.05 times that of the horizon; in M; 1 to 10000;
     * default 10.
     */
    height?: number;
    /** coordinate time at which the lamp is brightest; in M; -1e+12 to 1e+12; default 0. */
    start?: number;
    /**
     * time before and after the peak at which the lamp's light is exp(-1/2) of the peak; in M; 0.001 to 1000000;
     * default 1.
     */
    duration?: number;
    /**
     * time from one flash to the next, at least 12 times flash.duration; 0: one flash only; in M; 0 to 1000000000;
     * default 0.
     */
    period?: number;
    /**
     * photon index Gamma of the lamp: it emits E^-Gamma photons per energy, which sets how its light on the disk
     * depends on the shift from the lamp to the gas; 1 to 4; default 2.
     */
    photon_index?: number;
    /**
     * spectral index of the lit gas: I_nu falls as nu to this power, so that the observed brightness is multiplied
     * by g^(3 + index); -4 to 6; default 0.
     */
    index?: number;
    /**
     * colour of the lit gas: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000;
     * default 6500.
     */
    temperature_k?: number;
  };
  /** bodies: luminous spheres round the hole; up to 8; default []. */
  bodies?: {
    /** radius of the sphere in its own frame; 0: no body; in M; 0 to 1000000; default 0. */
    radius?: number;
    /**
     * Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon; in M; 1 to 10000000;
     * default 15.
     */
    r?: number;
    /**
     * polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to
     * 180; default 90.
     */
    inclination_deg?: number;
    /**
     * azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0; in degrees; -360 to 360; default
     * 0.
     */
    phase_deg?: number;
    /**
     * state of motion, which shifts the body's light; static, zamo, keplerian and retrograde move it round with
     * time, the last two only in the disk's plane; static: at rest with respect to infinity; zamo: with zero
     * angular momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude;
     * retrograde: on a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free
     * fall, by default from rest at infinity; velocity: with any velocity relative to the observer of zero angular
     * momentum; default "keplerian".
     */
    motion?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
    /**
     * outward velocity in the frame of the local observer of zero angular momentum (motion: velocity); in c; -1 to
     * 1; default 0.
     */
    velocity_r?: number;
    /**
     * velocity away from the north pole, in the frame of the local observer of zero angular momentum (motion:
     * velocity); in c; -1 to 1; default 0.
     */
    velocity_theta?: number;
    /**
     * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (motion:
     * velocity); in c; -1 to 1; default 0.
     */
    velocity_phi?: number;
    /**
     * temperature of the body, which shines as a black body shifted by g; in K; 300 to 1000000000; default 6000.
     */
    temperature_k?: number;
    /**
     * surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark; 0 to
     * 1000000000; default 1.
     */
    brightness?: number;
    /**
     * fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none; 0 to 1;
     * default 0.6.
     */
    limb_darkening?: number;
  }[];
  /** matter along the rays. */
  volume?: {
    /**
     * matter along the rays. none; uniform: a homogeneous shell at rest. At one radio frequency: gold, the analytic
     * model of Gold et al. 2020; riaf, a hot, thin flow whose density, temperature and magnetic field are powers of
     * r; torus, a thick disk in equilibrium; grid, numbers from a file; default "none".
     */
    model?: 'none' | 'uniform' | 'gold' | 'riaf' | 'torus' | 'grid';
    /**
     * inner edge; horizon: 1 % outside the horizon, or 0.05 % for the models at a radio frequency; for a torus,
     * half of volume.torus_radius; in M; 1 to 30000; default "horizon".
     */
    inner?: 'horizon' | number;
    /** outer edge of the matter; larger than the inner edge; in M; 1 to 30000; default 20. */
    outer?: number;
    /**
     * light emitted along 1 M in the matter's frame, in units of the disk's brightest (model: uniform); in 1/M; 0
     * to 1e+30; default 0.02.
     */
    emissivity?: number;
    /** optical depth of 1 M in the matter's frame (model: uniform); in 1/M; 0 to 1e+30; default 0.02. */
    opacity?: number;
    /**
     * colour: that of a black body of this temperature, shifted by g (model: uniform); in K; 300 to 1000000000;
     * default 6500.
     */
    temperature_k?: number;
    /** include the frequency shift of the matter (model: uniform); default true. */
    redshift?: boolean;
    /** observed frequency (models: gold, riaf, torus, grid); in GHz; 1e-06 to 1e+12; default 230. */
    frequency_ghz?: number;
    /**
     * NPZ file with density, temperature, velocity and magnetic field of the electrons on a grid of r, theta and
     * phi (model: grid); without it there is no matter; default null.
     */
    grid?: null | string;
    /**
     * factor on the file's density; the magnetic field is multiplied by the square root of it (model: grid); 0 to
     * 1e+30; default 1.
     */
    grid_scale?: number;
    /**
     * show each place of a grid with several frames at the time when its light left it, instead of the whole grid
     * at `time` (model: grid); default false.
     */
    slow_light?: boolean;
    /**
     * C n0: emissivity at 230 GHz at the largest density (model: gold); in erg/(s cm^3 Hz sr); 0 to 1e+30; default
     * 3e-18.
     */
    gold_emission?: number;
    /**
     * alpha: emissivity goes as nu^-alpha, absorptivity as nu^-(2.5 + alpha) (model: gold); -10 to 10; default 0.
     */
    gold_index?: number;
    /** h: density goes as exp(-(h cos(theta))^2/2); 0: round (model: gold); 0 to 10000; default 0. */
    gold_flattening?: number;
    /**
     * l0: angular momentum over energy is l0 R^(3/2)/(1 + R) with R = r sin(theta); 0: zero angular momentum
     * (model: gold); -1 to 1; default 0.
     */
    gold_momentum?: number;
    /**
     * A: absorptivity in 1/cm over emissivity in erg/(s cm^3 Hz sr), at 230 GHz (model: gold); 0 to 1e+30; default
     * 0.
     */
    gold_absorption?: number;
    /**
     * electron density: at r = 1 M in the equatorial plane, by its power law (model: riaf); its maximum (model:
     * torus); in 1/cm^3; 0 to 1e+30; default 30000000.
     */
    density_cm3?: number;
    /** p: density is proportional to r^-p (model: riaf); -10 to 10; default 1.1. */
    density_index?: number;
    /** electron temperature at r = 1 M (model: riaf); in K; 1 to 1e+30; default 300000000000. */
    electron_temperature_k?: number;
    /** p: electron temperature is proportional to r^-p (model: riaf); -10 to 10; default 0.84. */
    temperature_index?: number;
    /**
     * height over the distance from the axis at which the density has fallen to exp(-1/2); 0: the density does not
     * depend on height (model: riaf); 0 to 10; default 0.1.
     */
    height?: number;
    /**
     * magnetic pressure over the rest energy of a proton per electron, at r = 1 M (model: riaf); 0 to 1e+12;
     * default 0.016666666666666666.
     */
    magnetisation?: number;
    /** p: magnetisation is proportional to r^-p (model: riaf); -10 to 10; default 1. */
    magnetisation_index?: number;
    /**
     * direction of the magnetic field: round the axis, along it, or radial; its part along the motion is removed
     * (models: riaf, torus); default "toroidal".
     */
    field?: 'toroidal' | 'vertical' | 'radial';
    /**
     * motion of the matter: with the angular velocity of the circular orbit at each r, and in free fall inside the
     * ISCO; or at rest relative to observers of zero angular momentum (model: riaf); default "orbits".
     */
    flow?: 'orbits' | 'rest';
    /**
     * energy distribution of the electrons (models: riaf, torus, grid); kappa: thermal with a power-law tail;
     * default "thermal".
     */
    electrons?: 'thermal' | 'power-law' | 'kappa';
    /** p: the number of electrons is proportional to gamma^-p (electrons: power-law); 1.1 to 10; default 3.5. */
    electrons_index?: number;
    /**
     * kappa: at high energies the number of electrons is proportional to gamma^(1 - kappa) (electrons: kappa); 3.1
     * to 7.5; default 4.
     */
    kappa?: number;
    /**
     * radius of the largest pressure; the inner edge is volume.inner (model: torus); in M; 1 to 1000; default 12.
     */
    torus_radius?: number;
    /** adiabatic index of the gas (model: torus); 1.1 to 2; default 1.4444444444444444. */
    adiabatic_index?: number;
    /** ion temperature over electron temperature (model: torus); 0 to 1000000; default 3. */
    temperature_ratio?: number;
    /** gas pressure over magnetic pressure (model: torus); 1e-06 to 1e+12; default 10. */
    beta?: number;
    /** smallest Lorentz factor of the electrons (electrons: power-law); 1 to 1000000000; default 30. */
    gamma_min?: number;
    /**
     * largest Lorentz factor of the electrons; above gamma_min (electrons: power-law); 1 to 1e+12; default 100000.
     */
    gamma_max?: number;
    /**
     * flux to which the picture is normalised: kerrd multiplies the density (gold: the emissivity; grid: the
     * factor) by a number that small pictures determine, and reports this number; 0: no change (models: gold, riaf,
     * torus, grid); in Jy; 0 to 1e+12; default 0.
     */
    normalise_to_jy?: number;
    /** frequency of that flux; observed: volume.frequency_ghz; in GHz; 1e-06 to 1e+12; default "observed". */
    normalise_ghz?: 'observed' | number;
  };
  /** stylised jets along the spin axis. */
  jets?: {
    /**
     * light that the jet emits along 1 M in its own frame, in units of the disk's brightest surface brightness. It
     * is the value of the power law at the inner edge; the actual light is 0 there and rises smoothly to the power
     * law. 0: no jets; in 1/M; 0 to 1000000000; default 0.
     */
    brightness?: number;
    /** half of the cone's opening angle; in degrees; 1 to 60; default 8. */
    opening_deg?: number;
    /** Lorentz factor of the outflow; 1 to 100; default 2. */
    lorentz?: number;
    /**
     * radius at which the light begins, at least 1.05 times that of the horizon; in M; 1 to 1000000; default 4.
     */
    inner?: number;
    /** radius at which the light ends; larger than the inner edge; in M; 1 to 1000000; default 60. */
    outer?: number;
    /** p: the jet's light is proportional to r^-p; -10 to 10; default 1.5. */
    falloff?: number;
    /** distribution of brightness across the jet: 0, a bright spine; 1, bright edges; 0 to 1; default 0.5. */
    sheath?: number;
    /** index: brightness is proportional to g^(2 + index); -10 to 10; default 0.7. */
    spectral_index?: number;
    /** colour of a black body of this temperature, not shifted; in K; 300 to 1000000000; default 14000. */
    temperature_k?: number;
    /** include the jet below the disk; default true. */
    counterjet?: boolean;
  };
  /** polarisation of light, as layers and ticks show it; in a picture it changes only the light of volumes. */
  polarization?: {
    /**
     * polarisation. none; synchrotron: of light from the disk's plane, perpendicular to polarization.field and the
     * ray in the gas's frame; scattering: of light from the disk's plane, by a deep atmosphere of free electrons,
     * perpendicular to the normal and the ray; transfer: of a volume at a radio frequency, Stokes I, Q, U and V
     * along the rays; default "none".
     */
    model?: 'none' | 'synchrotron' | 'scattering' | 'transfer';
    /**
     * direction of the magnetic field in the plane: round the axis, outwards, or along the normal (model:
     * synchrotron); default "toroidal".
     */
    field?: 'toroidal' | 'radial' | 'vertical';
    /**
     * p: the number of electrons is proportional to E^-p; an ordered field polarises their light by (p + 1)/(p +
     * 7/3) (model: synchrotron); 1 to 10; default 3.
     */
    electron_index?: number;
    /** factor on the polarisation, below 1 for a field that is disordered within a pixel; 0 to 1; default 1. */
    order?: number;
    /**
     * include Faraday rotation, and conversion between linear and circular polarisation, by the electrons (model:
     * transfer); default true.
     */
    faraday?: boolean;
    /**
     * fit of the Faraday rotation by thermal electrons: Shcherbakov 2008, or Dexter 2016 in the form of Huang and
     * Shcherbakov 2011 (model: transfer); default "shcherbakov".
     */
    rotation?: 'shcherbakov' | 'dexter';
  };
  /** the sky at infinity. */
  sky?: {
    /**
     * sky at infinity: none; a celestial grid that shows the lensing; generated stars and a generated Milky Way;
     * the stars of the Hipparcos catalogue over that Milky Way; or sky.image without stars; default "none".
     */
    model?: 'none' | 'grid' | 'stars' | 'catalogue' | 'image';
    /**
     * brightness of the grid, or of a sky of 21 magnitudes per square arcsecond, in units of the disk's brightest
     * surface brightness at g = 1; stars and the Milky Way keep their real ratio. auto: 0.2, or 0.01 for stars and
     * the Milky Way behind other light; 0 to 100; default "auto".
     */
    brightness?: 'auto' | number;
    /** spacing of the celestial grid; in degrees; 1 to 90; default 15. */
    grid_deg?: number;
    /** factor on the natural brightness of the Milky Way or of sky.image; 0: only stars; 0 to 100; default 1. */
    milky_way?: number;
    /**
     * picture of the whole sky instead of the generated Milky Way (model: stars, catalogue, image): twice as wide
     * as high, with galactic longitude 0 in the middle and rising to the left, latitude rising upwards; its white
     * is 21 magnitudes per square arcsecond; default null.
     */
    image?: null | string;
    /** magnitude of the faintest stars that are shown; in magnitudes; -2 to 14; default 14. */
    limit_mag?: number;
    /** seed of the random numbers of the generated sky; 0 to 2147483647; default 1. */
    seed?: number;
    /**
     * galactic, equatorial: the hole's axis points to that pole of the sky, and azimuth 0 to longitude 0; sgra,
     * m87: an observer at azimuth 0 sees the hole where the Earth sees that source, with the galactic pole (sgra)
     * or the celestial pole (m87) above; default "galactic".
     */
    orientation?: 'galactic' | 'equatorial' | 'sgra' | 'm87';
    /**
     * rotation of the sky about the hole's axis, in the sense of camera.azimuth_deg; in degrees; -360 to 360;
     * default 0.
     */
    turn_deg?: number;
    /**
     * a second rotation of the sky, about the horizontal axis of the picture from azimuth 0; in degrees; -180 to
     * 180; default 0.
     */
    tilt_deg?: number;
  };
  /** the size of the picture. */
  image?: {
    /** width of the picture; in pixels; 1 to 32768; default 1280. */
    width?: number;
    /** height of the picture; in pixels; 1 to 32768; default 720. */
    height?: number;
    /**
     * rays along each side of a pixel: n gives the mean of n x n rays; auto: one ray, and 16 for pixels that differ
     * from their neighbours; 1 to 8; default 1.
     */
    samples?: 'auto' | number;
    /**
     * apparent error, as a fraction of white, above which a pixel of one ray gets more rays (samples: auto); 0.001
     * to 0.5; default 0.003.
     */
    pixel_error?: number;
    /**
     * factor on the number of rays along each side of pixels at the critical curve, where the photon ring is
     * thinner than a pixel; the product is at most 16; 1 to 16; default 4.
     */
    critical_factor?: number;
    /** bits a channel: 8 or 16; in bits; 8 to 16; default 8. */
    bit_depth?: number;
    /**
     * contents of the file: the picture, or maps of the rays (docs/layers.md) for the first crossing of the disk,
     * or with the suffix _N for image order N; a PNG shows one map in false colour, FITS, EXR, NPZ and NPY have
     * several as numbers; up to 16; default ["rgb"].
     */
    layers?: string[];
    /**
     * value at the lower end of a layer's colour scale; auto: docs/layers.md gives it for each layer; -1e+12 to
     * 1e+12; default "auto".
     */
    layer_min?: 'auto' | number;
    /**
     * value at the upper end of a layer's colour scale; auto: docs/layers.md gives it for each layer; -1e+12 to
     * 1e+12; default "auto".
     */
    layer_max?: 'auto' | number;
    /** draw a colour bar in the lower left corner of a layer in false colour; default true. */
    legend?: boolean;
    /** a part of the picture, rendered alone, with the same bytes as in the whole. */
    tile?: {
      /** columns of the picture to the left of the tile; in pixels; 0 to 32767; default 0. */
      left?: number;
      /** rows of the picture above the tile; in pixels; 0 to 32767; default 0. */
      top?: number;
      /** width of the tile; 0: no tile, the whole picture is rendered; in pixels; 0 to 32768; default 0. */
      width?: number;
      /** height of the tile; 0: no tile, the whole picture is rendered; in pixels; 0 to 32768; default 0. */
      height?: number;
    };
  };
  /** from brightness to the colours of the file. */
  style?: {
    /**
     * style, which sets all fields of the look except those that the document sets; none: no style; default "film".
     */
    name?: 'none' | 'film' | 'raw' | 'dngr' | 'eht' | 'starless';
    /**
     * exposure as an exponent of 2, relative to the disk's brightest surface brightness at g = 1; auto: by the
     * light in the picture, with a limit for pictures of stars alone so that empty space is black; in stops; -40 to
     * 40; default "auto".
     */
    exposure?: 'auto' | number;
    /**
     * aces: film-like curve; srgb: proportional to light, clipped; neutral: keeps colours, and compresses light
     * near white; default "aces".
     */
    tone_map?: 'aces' | 'srgb' | 'neutral';
    /**
     * share of bright light that the lens spreads around its place: all light over 0.6 of white, with a smooth
     * transition from 0.2 on; 0: none; 0 to 1; default 0.4.
     */
    bloom?: number;
    /**
     * full width at half maximum of a round Gaussian telescope beam, seen from spacetime.distance_pc; 0: none; in
     * microarcseconds; 0 to 1e+12; default 0.
     */
    beam_uas?: number;
    /**
     * colour: the colour of the light; heat: brightness in false colour (black, red, orange, white), with lightness
     * proportional to it; default "colour".
     */
    palette?: 'colour' | 'heat';
    /**
     * draw a brightness bar in the lower left corner (palette: heat; tone_map: srgb), and in the upper right corner
     * an angular scale and the shape of the beam; default false.
     */
    colour_bar?: boolean;
    /** add half a step of ordered noise before rounding, against banding; default true. */
    dither?: boolean;
    /**
     * illustration of a struck hole: light of image orders 1 and up is multiplied by 1 + ringdown e^(-t/tau) cos(w
     * t), with the hole's quasi-normal mode l = m = 2, n = 0; 0: none; 0 to 1; default 0.
     */
    ringdown?: number;
    /** time at which the hole was struck, and the ringing begins; in M; -1e+12 to 1e+12; default 0. */
    ringdown_time?: number;
  };
  /** the source on the sky that the hole represents, for FITS files; it changes no pixel. */
  source?: {
    /** the source on the sky that the hole represents; default "none". */
    name?: 'none' | 'm87' | 'sgra';
    /** right ascension of the hole (ICRS); in degrees; 0 to 360; default 0. */
    ra_deg?: number;
    /** declination of the hole (ICRS); in degrees; -90 to 90; default 0. */
    dec_deg?: number;
    /** date of the picture, as a modified Julian date; in days; 0 to 1000000; default "none". */
    mjd?: 'none' | number;
  };
  /** motion in a live session; a still picture ignores it. */
  motion?: {
    /** rate at which the observer goes round the axis; in degrees per second; -360 to 360; default 0. */
    azimuth_rate_deg?: number;
    /** rate of coordinate time; in M per second; -1000000 to 1000000; default 0. */
    time_rate?: number;
    /**
     * rate of the observer's proper time: the observer moves along its path, a fall to the last possible position
     * or an orbit; coordinate time follows; in M per second; 0 to 1000000; default 0.
     */
    proper_time_rate?: number;
  };
  /** accuracy of the rays. */
  accuracy?: {
    /**
     * accuracy with which rays are traced, from coarse to fine; reference: double precision; default "balanced".
     */
    profile?: 'draft' | 'interactive' | 'balanced' | 'high' | 'reference';
    /**
     * largest relative error of the crossing radii, by the accuracy table of the device; profile: the error of
     * accuracy.profile; 1e-18 to 0.1; default "profile".
     */
    tolerance?: 'profile' | number;
    /**
     * method that traces the rays; auto: the closed form outside the photon orbits, otherwise mino-rkn6; default
     * "auto".
     */
    engine?: 'auto' | 'closed' | 'mino-rkn4' | 'mino-rkn6' | 'ks-euler' | 'ks-rk4' | 'ks-tao6';
    /** precision of the arithmetic; auto: chosen by accuracy.profile; default "auto". */
    precision?: 'auto' | 'f32' | 'f64';
    /** integrator steps for a half turn, a multiple of 4; 0: chosen by accuracy.profile; 0 to 2048; default 0. */
    steps?: number;
    /** equatorial crossings kept for each ray: image orders 0 to n - 1; 1 to 8; default 3. */
    orders?: number;
  };
  /** coordinate time of the picture; in M; -1e+12 to 1e+12; default 0. */
  time?: number;
}

export type FieldPath =
  | 'version' | 'spacetime.spin' | 'spacetime.charge' | 'spacetime.mass_msun' | 'spacetime.distance_pc' | 'camera.r'
  | 'camera.inclination_deg' | 'camera.azimuth_deg' | 'camera.observer' | 'camera.velocity_r' | 'camera.velocity_theta'
  | 'camera.velocity_phi' | 'camera.infall_from' | 'camera.infall_energy' | 'camera.infall_momentum'
  | 'camera.projection' | 'camera.field_m' | 'camera.field_uas' | 'camera.fov_deg' | 'camera.centre_alpha'
  | 'camera.centre_beta' | 'camera.yaw_deg' | 'camera.pitch_deg' | 'camera.roll_deg' | 'camera.stereo'
  | 'camera.eye_distance' | 'camera.ring_decades_max' | 'camera.ring_decades_min' | 'disk.model' | 'disk.inner'
  | 'disk.outer' | 'disk.taper' | 'disk.opacity' | 'disk.emission_opacity' | 'disk.height' | 'disk.flare'
  | 'disk.colour' | 'disk.peak_temperature_k' | 'disk.mdot_edd' | 'disk.hardening' | 'disk.atmosphere'
  | 'disk.returning' | 'disk.albedo' | 'disk.band' | 'disk.frequency_ghz' | 'disk.doppler' | 'disk.redshift'
  | 'disk.particles' | 'disk.seed' | 'disk.density_index' | 'disk.plunging' | 'disk.plunging_temperature'
  | 'disk.epicycles' | 'disk.slow_light' | 'disk.gas.amplitude' | 'disk.gas.octaves' | 'disk.gas.scale'
  | 'disk.gas.shear' | 'disk.gas.seed' | 'spots.0.brightness' | 'spots.0.r' | 'spots.0.phase_deg' | 'spots.0.size'
  | 'spots.0.index' | 'spots.0.temperature_k' | 'spots.1.brightness' | 'spots.1.r' | 'spots.1.phase_deg'
  | 'spots.1.size' | 'spots.1.index' | 'spots.1.temperature_k' | 'spots.2.brightness' | 'spots.2.r'
  | 'spots.2.phase_deg' | 'spots.2.size' | 'spots.2.index' | 'spots.2.temperature_k' | 'spots.3.brightness'
  | 'spots.3.r' | 'spots.3.phase_deg' | 'spots.3.size' | 'spots.3.index' | 'spots.3.temperature_k'
  | 'spots.4.brightness' | 'spots.4.r' | 'spots.4.phase_deg' | 'spots.4.size' | 'spots.4.index'
  | 'spots.4.temperature_k' | 'spots.5.brightness' | 'spots.5.r' | 'spots.5.phase_deg' | 'spots.5.size'
  | 'spots.5.index' | 'spots.5.temperature_k' | 'spots.6.brightness' | 'spots.6.r' | 'spots.6.phase_deg'
  | 'spots.6.size' | 'spots.6.index' | 'spots.6.temperature_k' | 'spots.7.brightness' | 'spots.7.r'
  | 'spots.7.phase_deg' | 'spots.7.size' | 'spots.7.index' | 'spots.7.temperature_k' | 'spots.8.brightness'
  | 'spots.8.r' | 'spots.8.phase_deg' | 'spots.8.size' | 'spots.8.index' | 'spots.8.temperature_k'
  | 'spots.9.brightness' | 'spots.9.r' | 'spots.9.phase_deg' | 'spots.9.size' | 'spots.9.index'
  | 'spots.9.temperature_k' | 'spots.10.brightness' | 'spots.10.r' | 'spots.10.phase_deg' | 'spots.10.size'
  | 'spots.10.index' | 'spots.10.temperature_k' | 'spots.11.brightness' | 'spots.11.r' | 'spots.11.phase_deg'
  | 'spots.11.size' | 'spots.11.index' | 'spots.11.temperature_k' | 'spots.12.brightness' | 'spots.12.r'
  | 'spots.12.phase_deg' | 'spots.12.size' | 'spots.12.index' | 'spots.12.temperature_k' | 'spots.13.brightness'
  | 'spots.13.r' | 'spots.13.phase_deg' | 'spots.13.size' | 'spots.13.index' | 'spots.13.temperature_k'
  | 'spots.14.brightness' | 'spots.14.r' | 'spots.14.phase_deg' | 'spots.14.size' | 'spots.14.index'
  | 'spots.14.temperature_k' | 'spots.15.brightness' | 'spots.15.r' | 'spots.15.phase_deg' | 'spots.15.size'
  | 'spots.15.index' | 'spots.15.temperature_k' | 'flash.brightness' | 'flash.height' | 'flash.start' | 'flash.duration'
  | 'flash.period' | 'flash.photon_index' | 'flash.index' | 'flash.temperature_k' | 'bodies.0.radius' | 'bodies.0.r'
  | 'bodies.0.inclination_deg' | 'bodies.0.phase_deg' | 'bodies.0.motion' | 'bodies.0.velocity_r'
  | 'bodies.0.velocity_theta' | 'bodies.0.velocity_phi' | 'bodies.0.temperature_k' | 'bodies.0.brightness'
  | 'bodies.0.limb_darkening' | 'bodies.1.radius' | 'bodies.1.r' | 'bodies.1.inclination_deg' | 'bodies.1.phase_deg'
  | 'bodies.1.motion' | 'bodies.1.velocity_r' | 'bodies.1.velocity_theta' | 'bodies.1.velocity_phi'
  | 'bodies.1.temperature_k' | 'bodies.1.brightness' | 'bodies.1.limb_darkening' | 'bodies.2.radius' | 'bodies.2.r'
  | 'bodies.2.inclination_deg' | 'bodies.2.phase_deg' | 'bodies.2.motion' | 'bodies.2.velocity_r'
  | 'bodies.2.velocity_theta' | 'bodies.2.velocity_phi' | 'bodies.2.temperature_k' | 'bodies.2.brightness'
  | 'bodies.2.limb_darkening' | 'bodies.3.radius' | 'bodies.3.r' | 'bodies.3.inclination_deg' | 'bodies.3.phase_deg'
  | 'bodies.3.motion' | 'bodies.3.velocity_r' | 'bodies.3.velocity_theta' | 'bodies.3.velocity_phi'
  | 'bodies.3.temperature_k' | 'bodies.3.brightness' | 'bodies.3.limb_darkening' | 'bodies.4.radius' | 'bodies.4.r'
  | 'bodies.4.inclination_deg' | 'bodies.4.phase_deg' | 'bodies.4.motion' | 'bodies.4.velocity_r'
  | 'bodies.4.velocity_theta' | 'bodies.4.velocity_phi' | 'bodies.4.temperature_k' | 'bodies.4.brightness'
  | 'bodies.4.limb_darkening' | 'bodies.5.radius' | 'bodies.5.r' | 'bodies.5.inclination_deg' | 'bodies.5.phase_deg'
  | 'bodies.5.motion' | 'bodies.5.velocity_r' | 'bodies.5.velocity_theta' | 'bodies.5.velocity_phi'
  | 'bodies.5.temperature_k' | 'bodies.5.brightness' | 'bodies.5.limb_darkening' | 'bodies.6.radius' | 'bodies.6.r'
  | 'bodies.6.inclination_deg' | 'bodies.6.phase_deg' | 'bodies.6.motion' | 'bodies.6.velocity_r'
  | 'bodies.6.velocity_theta' | 'bodies.6.velocity_phi' | 'bodies.6.temperature_k' | 'bodies.6.brightness'
  | 'bodies.6.limb_darkening' | 'bodies.7.radius' | 'bodies.7.r' | 'bodies.7.inclination_deg' | 'bodies.7.phase_deg'
  | 'bodies.7.motion' | 'bodies.7.velocity_r' | 'bodies.7.velocity_theta' | 'bodies.7.velocity_phi'
  | 'bodies.7.temperature_k' | 'bodies.7.brightness' | 'bodies.7.limb_darkening' | 'volume.model' | 'volume.inner'
  | 'volume.outer' | 'volume.emissivity' | 'volume.opacity' | 'volume.temperature_k' | 'volume.redshift'
  | 'volume.frequency_ghz' | 'volume.grid' | 'volume.grid_scale' | 'volume.slow_light' | 'volume.gold_emission'
  | 'volume.gold_index' | 'volume.gold_flattening' | 'volume.gold_momentum' | 'volume.gold_absorption'
  | 'volume.density_cm3' | 'volume.density_index' | 'volume.electron_temperature_k' | 'volume.temperature_index'
  | 'volume.height' | 'volume.magnetisation' | 'volume.magnetisation_index' | 'volume.field' | 'volume.flow'
  | 'volume.electrons' | 'volume.electrons_index' | 'volume.kappa' | 'volume.torus_radius' | 'volume.adiabatic_index'
  | 'volume.temperature_ratio' | 'volume.beta' | 'volume.gamma_min' | 'volume.gamma_max' | 'volume.normalise_to_jy'
  | 'volume.normalise_ghz' | 'jets.brightness' | 'jets.opening_deg' | 'jets.lorentz' | 'jets.inner' | 'jets.outer'
  | 'jets.falloff' | 'jets.sheath' | 'jets.spectral_index' | 'jets.temperature_k' | 'jets.counterjet'
  | 'polarization.model' | 'polarization.field' | 'polarization.electron_index' | 'polarization.order'
  | 'polarization.faraday' | 'polarization.rotation' | 'sky.model' | 'sky.brightness' | 'sky.grid_deg' | 'sky.milky_way'
  | 'sky.image' | 'sky.limit_mag' | 'sky.seed' | 'sky.orientation' | 'sky.turn_deg' | 'sky.tilt_deg' | 'image.width'
  | 'image.height' | 'image.samples' | 'image.pixel_error' | 'image.critical_factor' | 'image.bit_depth'
  | 'image.layers' | 'image.layer_min' | 'image.layer_max' | 'image.legend' | 'image.tile.left' | 'image.tile.top'
  | 'image.tile.width' | 'image.tile.height' | 'style.name' | 'style.exposure' | 'style.tone_map' | 'style.bloom'
  | 'style.beam_uas' | 'style.palette' | 'style.colour_bar' | 'style.dither' | 'style.ringdown' | 'style.ringdown_time'
  | 'source.name' | 'source.ra_deg' | 'source.dec_deg' | 'source.mjd' | 'motion.azimuth_rate_deg' | 'motion.time_rate'
  | 'motion.proper_time_rate' | 'accuracy.profile' | 'accuracy.tolerance' | 'accuracy.engine' | 'accuracy.precision'
  | 'accuracy.steps' | 'accuracy.orders' | 'time';

export interface RaysRequest {
  /** spin of the hole, a/M; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  observer?: {
    /** radius of the observer, M; outside the horizon; 1 to 10000000. */
    r?: 'infinity' | number;
    /** polar angle of the observer, from the hole's axis; 0 to 180. */
    inclination_deg?: number;
    /**
     * motion of an observer at a finite r, as camera.observer of a scene; a ray is then a direction in the
     * observer's frame, [yaw, pitch] in degrees.
     */
    motion?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
    /** velocity outwards, as camera.velocity_r (motion: velocity); -1 to 1. */
    velocity_r?: number;
    /** velocity away from the north pole, as camera.velocity_theta (motion: velocity); -1 to 1. */
    velocity_theta?: number;
    /** velocity along the disk's rotation, as camera.velocity_phi (motion: velocity); -1 to 1. */
    velocity_phi?: number;
    /** radius at which the observer was at rest, as camera.infall_from, M (motion: infall); 1 to 10000000. */
    infall_from?: 'infinity' | number;
    /** energy per mass, as camera.infall_energy (motion: infall); -100 to 1000. */
    infall_energy?: 'rest' | number;
    /** angular momentum per mass, as camera.infall_momentum, M (motion: infall); -10000 to 10000. */
    infall_momentum?: number;
  };
  /** number of equatorial crossings in the answer; 1 to 16. */
  orders?: number;
  accuracy?: {
    /** as accuracy.profile of a scene; without profile and engine, the closed form is used. */
    profile?: 'draft' | 'interactive' | 'balanced' | 'high' | 'reference';
    /** largest relative error of the crossing radii, instead of the profile; 0 to 1. */
    tolerance?: 'profile' | number;
    /** method that traces the rays; auto: by profile or tolerance. */
    engine?: 'auto' | 'closed' | 'mino-rkn4' | 'mino-rkn6' | 'ks-euler' | 'ks-rk4' | 'ks-tao6';
    /** precision of the arithmetic; the closed form has only f64. */
    precision?: 'auto' | 'f32' | 'f64';
    /** integrator steps for a half period of the radial motion; some engines take fewer; 0 to 2048. */
    steps?: number;
  };
  /** pairs [alpha, beta], in M; with observer.motion [yaw, pitch], in degrees; up to 1000000. */
  rays: number[][];
}

export interface RaysObserver {
  /** radius of the observer, M; outside the horizon; 1 to 10000000. */
  r: 'infinity' | number;
  /** polar angle of the observer, from the hole's axis; 0 to 180. */
  inclination_deg: number;
  /**
   * motion of an observer at a finite r, as camera.observer of a scene; a ray is then a direction in the
   * observer's frame, [yaw, pitch] in degrees.
   */
  motion?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
  /** velocity outwards, as camera.velocity_r (motion: velocity); -1 to 1. */
  velocity_r?: number;
  /** velocity away from the north pole, as camera.velocity_theta (motion: velocity); -1 to 1. */
  velocity_theta?: number;
  /** velocity along the disk's rotation, as camera.velocity_phi (motion: velocity); -1 to 1. */
  velocity_phi?: number;
  /** radius at which the observer was at rest, as camera.infall_from, M (motion: infall); 1 to 10000000. */
  infall_from?: 'infinity' | number;
  /** energy per mass, as camera.infall_energy (motion: infall); -100 to 1000. */
  infall_energy?: 'rest' | number;
  /** angular momentum per mass, as camera.infall_momentum, M (motion: infall); -10000 to 10000. */
  infall_momentum?: number;
}

export interface RaysAccuracy {
  engine: 'closed' | 'mino-rkn4' | 'mino-rkn6' | 'ks-euler' | 'ks-rk4' | 'ks-tao6';
  precision: 'f32' | 'f64';
  /** at least 0. */
  steps: number;
  /** at least 0. */
  rays: number;
  /** at least 0. */
  undecided: number;
  tolerance?: number;
  /** at least 0. */
  followed_again?: number;
  /** at least 0. */
  beyond?: number;
  holds?: number;
  worst_error?: number;
  median_error?: number;
}

/** lengths and times in M, angles in radians. */
export interface RayCrossing {
  /** at least 0. */
  order: number;
  r?: number;
  phi?: number;
  delay?: number;
  g?: number;
}

/** lengths and times in M, angles in radians. */
export interface RaySky {
  theta: number;
  phi?: number;
}

/** lengths and times in M, angles in radians. */
export interface Ray {
  fate: 'captured' | 'escaped' | 'undecided';
  crossings: RayCrossing[];
  sky?: RaySky;
  energy?: number;
  error?: number;
}

export interface RaysAnswer {
  spin: number;
  charge?: number;
  observer: RaysObserver;
  /** at least 0. */
  orders: number;
  accuracy: RaysAccuracy;
  approximations: string[];
  rays: Ray[];
}

export interface OrbitByShape {
  /** spin of the hole, a/M; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; the body is neutral; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  /** semi-latus rectum of a bound orbit; its radii are between p/(1+e) and p/(1-e) [M]; 1 to 1e+20. */
  p: number;
  /** eccentricity; 0 to 1. */
  e: number;
  /** inclination; above 90 is retrograde [deg]; 0 to 180. */
  inclination_deg?: number;
}

export interface OrbitByConstants {
  /** spin of the hole, a/M; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; the body is neutral; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  /** energy per rest mass; -1000000 to 1000000. */
  energy: number;
  /** angular momentum about the axis, per rest mass [M]; -1e+20 to 1e+20. */
  angular_momentum: number;
  /** Carter's constant, per rest mass [M^2]; 0 in the equatorial plane; 0 to 1e+30. */
  carter?: number;
  /** radius where the path starts [M]; 1 to 1e+20. */
  r?: number;
  /** whether the path starts outwards. */
  outward?: boolean;
}

export interface OrbitByState {
  /** spin of the hole, a/M; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; the body is neutral; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  position: {
    /** radius [M]; 1 to 1e+20. */
    r: number;
    /** polar angle [deg]; 0 to 180. */
    theta_deg?: number;
    /** azimuth [deg]; -360 to 360. */
    phi_deg?: number;
  };
  velocity?: {
    /** observer whose frame the velocity refers to. */
    frame?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall';
    /** component along r [c]; -1 to 1. */
    v_r?: number;
    /** component along theta [c]; -1 to 1. */
    v_theta?: number;
    /** component along phi [c]; -1 to 1. */
    v_phi?: number;
  };
}

export interface OrbitByCase {
  /** spin of the hole, a/M; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; the body is neutral; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  /** an orbit by name. */
  case: 'mercury' | 'zoom-whirl' | 'plunge' | 'isco' | 'spherical';
}

export type Orbit = OrbitByShape | OrbitByConstants | OrbitByState | OrbitByCase;

export interface OrbitsRequest {
  /** spin of the hole, a/M; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; the body is neutral; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  /**
   * number of samples of the path, both ends included; 0 for none; at most 20000 if "seen" is given; 0 to 200000.
   */
  samples?: number;
  /** significant digits of the series as text; 1 to 17. */
  digits?: number;
  /** steps per radial period, instead of a tolerance; 0: by tolerance; 0 to 100000000. */
  steps?: number;
  /** largest relative error after a period; it determines the step; 1e-14 to 0.001. */
  tolerance?: number;
  /** method of integration. */
  method?: 'yoshida6' | 'rkn6' | 'closed';
  /** radius at which an escaping orbit ends [M]; 2 to 1000000. */
  r_max?: number;
  /** mass of the hole [solar masses]; adds frequencies in Hz and the advance per century; 1e-20 to 1e+20. */
  mass_msun?: number;
  /** for a list: whether the answer has the samples of each orbit. */
  series?: boolean;
  duration?: {
    /** duration in radial periods, or in revolutions if r is constant; 0 to 1000000000. */
    periods?: number;
    /** coordinate time [M]; 0 to 1e+30. */
    time?: number;
    /** follow an orbit to its end if it plunges or escapes, and so has no periods. */
    or_end?: boolean;
  };
  seen?: {
    /** radius of the observer [M]; default infinity; 1 to 10000000. */
    observer_r?: number;
    /** polar angle of the observer [deg]; 0 to 180. */
    observer_inclination_deg?: number;
    /** azimuth of the observer [deg]; -1000000 to 1000000. */
    observer_azimuth_deg?: number;
    /** motion of the observer. */
    observer?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall';
  };
  orbit?: Orbit;
  /** up to 10000. */
  orbits?: Orbit[];
}

/** per rest mass; lengths and times in M, angles in radians unless a name ends in _deg. */
export interface OrbitConstants {
  energy: number;
  binding: number;
  angular_momentum: number;
  carter: number;
  binet_c?: number | null;
}

/** per rest mass; lengths and times in M, angles in radians unless a name ends in _deg. */
export interface OrbitTurningPoints {
  r_min: number | null;
  r_max: number | null;
  theta_min_deg: number;
  theta_max_deg: number | null;
}

/** per rest mass; lengths and times in M, angles in radians unless a name ends in _deg. */
export interface OrbitShape {
  p: number;
  e: number;
  inclination_deg: number;
}

/** per rest mass; lengths and times in M, angles in radians unless a name ends in _deg. */
export interface OrbitAdvance {
  periastron: number | null;
  weak_field: number | null;
  node: number | null;
  periastron_arcsec_per_century?: number | null;
}

/** in radians per Mino time, in radians per M, or in Hz, by the name of the member. */
export interface OrbitMinoFrequencies {
  r: number | null;
  theta: number | null;
  phi: number | null;
  t: number | null;
  tau_proper: number | null;
}

/** in radians per Mino time, in radians per M, or in Hz, by the name of the member. */
export interface OrbitThreeFrequencies {
  r: number | null;
  theta: number | null;
  phi: number | null;
}

export interface OrbitFrequencies {
  mino: OrbitMinoFrequencies;
  coordinate: OrbitThreeFrequencies;
  proper: OrbitThreeFrequencies;
  hz?: OrbitThreeFrequencies;
}

export interface OrbitSeries {
  columns: (
      | 'mino' | 'tau_proper' | 't' | 'r' | 'theta' | 'phi' | 'x' | 'y' | 'z' | 'energy_error' | 'alpha' | 'beta'
      | 'right' | 'up' | 'inwards' | 'delay' | 'off'
    )[];
  rows: ((number | null)[])[];
}

export interface OrbitDrift {
  energy: number | null;
  angular_momentum: number;
  carter: number | null;
  mass: number | null;
  binet_c?: number | null;
}

/** per rest mass; lengths and times in M, angles in radians unless a name ends in _deg. */
export interface OrbitDifference {
  tau_proper: number | null;
  t: number | null;
  r: number | null;
  theta: number | null;
  phi: number | null;
}

/** per rest mass; lengths and times in M, angles in radians unless a name ends in _deg. */
export interface OrbitResult {
  method: 'yoshida6' | 'rkn6' | 'closed';
  end: 'duration' | 'horizon' | 'r_max';
  mino_end: number | null;
  /** at least 0. */
  steps?: number;
  mino_step?: number | null;
  error_estimate?: number | null;
  drift?: OrbitDrift;
  /** at least 0. */
  periastra?: number;
  periastron_advance_measured?: number | null;
  closed_form_difference?: OrbitDifference;
  approximations: string[];
}

/** per rest mass; lengths and times in M, angles in radians unless a name ends in _deg. */
export interface OrbitPath {
  spin: number;
  charge?: number;
  fate: 'bound' | 'plunge' | 'escape';
  circular: boolean;
  constants: OrbitConstants;
  turning_points: OrbitTurningPoints;
  shape?: OrbitShape;
  frequencies?: OrbitFrequencies;
  advance?: OrbitAdvance;
  series?: OrbitSeries;
  result: OrbitResult;
}

export interface OrbitPaths {
  orbits: OrbitPath[];
}

export interface LineRequest {
  /** spin of the hole; below 0 the disk rotates against the hole [M]; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; the gas is neutral; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  /** angle between the axis and the observer, who is at infinity [deg]; 0 to 180. */
  inclination_deg?: number;
  /** radius of the disk's inner edge, at least that of the ISCO [M]; 1 to 1000000. */
  inner?: 'isco' | number;
  /** outer edge of the disk [M]; 1 to 1000000. */
  outer?: number;
  /**
   * dependence of the line's emissivity on radius. power, broken: powers of r; lamppost, ring, disk, slab: in
   * proportion to the light that the disk receives from a point on the axis, or from a ring, a flat layer or a
   * slab above it.
   */
  emissivity?: 'power' | 'broken' | 'lamppost' | 'ring' | 'disk' | 'slab';
  /** power and broken: the light per area falls as r^-index; -10 to 20. */
  index?: number;
  /** broken: index beyond break_r; -10 to 20. */
  outer_index?: number;
  /** broken: radius at which the index changes [M]; 1 to 1000000. */
  break_r?: number;
  /**
   * lamppost, ring, disk, slab: height of the source above the plane, r cos(theta); for a slab, height of its
   * lower side [M]; 0.1 to 10000.
   */
  height?: number;
  /** ring: distance from the axis, r sin(theta); disk, slab: outer radius of the source [M]; 0.001 to 10000. */
  corona_radius?: number;
  /** disk, slab: inner radius of the source [M]; 0 to 10000. */
  corona_inner?: number;
  /** slab: height of its upper side [M]; 0.1 to 10000. */
  corona_top?: number;
  /**
   * ring, disk, slab: motion of the source: at rest, with zero angular momentum, or with the angular velocity of
   * the disk's gas at the same distance from the axis (within the ISCO, that of the ISCO).
   */
  motion?: 'static' | 'zamo' | 'corotating';
  /** lamppost, ring, disk, slab: photon index of the source's power law; 0 to 10. */
  photon_index?: number;
  /**
   * dependence of the light on mu, the cosine of the angle from the disk's normal: none, 1 + 2.06 mu, ln(1 +
   * 1/mu), or that of a deep atmosphere of free electrons.
   */
  limb?: 'isotropic' | 'laor' | 'haardt' | 'scattering';
  /**
   * accepted error of the cumulative share: sums are refined until they meet it, or to the finest level; 0:
   * always to the finest level; 0 to 0.1.
   */
  tolerance?: number;
  /** quantity that a bin counts. */
  counts?: 'photons' | 'energy';
  /** energy of the line in the gas's frame, in any unit; edges have the same unit; 1e-09 to 1000000000. */
  rest_energy?: number;
  /** first edge of bins of equal width; 0 to 1000000000. */
  energy_min?: number;
  /** last edge; auto: 1.7 times rest_energy; 0 to 1000000000. */
  energy_max?: 'auto' | number;
  /** number of bins of equal width; 1 to 20000. */
  bins?: number;
  /** edges of the bins in ascending order, instead of energy_min, energy_max and bins; up to 20001. */
  edges?: number[];
}

export interface LineProfile {
  integral: 'line';
  parameters: {
    spin: number;
    charge: number;
    inclination_deg: number;
    inner: number;
    outer: number;
    emissivity: string;
    index: number;
    outer_index: number;
    break_r: number;
    height: number;
    corona_radius: number;
    corona_inner: number;
    corona_top: number;
    motion: string;
    photon_index: number;
    limb: string;
    tolerance: number;
    counts: string;
    rest_energy: number;
    energy_min: number;
    energy_max: number;
    bins: number;
  };
  values: {
    /** innermost stable circular orbit. */
    isco: number | null;
    /**
     * number of the line's photons, which is the integral of g^3 epsilon f over the image plane; with counts
     * "energy", energy of the line, the integral of g^4 epsilon f.
     */
    total: number | null;
    /** share of the line between the first and the last edge. */
    inside: number | null;
    /** estimated largest error of the cumulative share at any edge. */
    error: number | null;
    /**
     * equivalent width of the line at the observer over that in the gas's frame, for gas that emits as many line
     * photons as continuum photons per unit of energy reach it; null without a source.
     */
    strength: number | null;
    /**
     * ratio of the source's continuum at the observer to that of the same source at rest far from the hole; null
     * without a source.
     */
    direct_flux: number | null;
    /** mean redshift factor of the source's continuum at the observer; null without a source. */
    direct_g: number | null;
  };
  columns: {
    /** edge of the bin. */
    energy_low: (number | null)[];
    /** edge of the bin. */
    energy_high: (number | null)[];
    /** share of the line's photons, or of its energy, in the bin. */
    share: (number | null)[];
    /** share of the line from the first edge to energy_high. */
    cumulative: (number | null)[];
  };
  units: Record<string, string>;
  sources: string[];
  approximations: string[];
}

export interface TransferFunctionRequest {
  /** spin of the hole; below 0 the disk rotates against the hole [M]; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; the gas is neutral; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  /**
   * angle between the axis and the observer, who is at infinity; not 89.99 to 90.01 [deg]; 0.1 to 89.99; 90.01 to
   * 179.9.
   */
  inclination_deg?: number;
  /** radius of the disk's inner edge, at least that of the ISCO [M]; 1 to 1000000. */
  inner?: 'isco' | number;
  /** outer edge of the disk [M]; 1 to 1000000. */
  outer?: number;
  /** number of radii, from inner to outer at equal ratios; 1 to 1000. */
  rings?: number;
  /** radii, instead of rings; between inner and outer [M]; up to 20001. */
  radii?: number[];
  /** number of values of g* at each radius: the midpoints of equal parts of the range 0 to 1; 1 to 1000. */
  g_stars?: number;
  /**
   * values of g* instead of g_stars, each between 0 (the reddest light of the ring) and 1 (the bluest); up to
   * 20001.
   */
  g_star?: number[];
}

export interface TransferFunction {
  integral: 'transfer-function';
  parameters: {
    spin: number;
    charge: number;
    inclination_deg: number;
    inner: number;
    outer: number;
    rings: number;
    g_stars: number;
  };
  values: {
    /** innermost stable circular orbit. */
    isco: number | null;
  };
  columns: {
    /** radius of the ring. */
    r: (number | null)[];
    /** (g - g_min)/(g_max - g_min). */
    g_star: (number | null)[];
    /** redshift factor: energy at infinity over energy in the gas's frame. */
    g: (number | null)[];
    /** f of the side that is closer to the observer. */
    f_near: (number | null)[];
    /** f of the far side. */
    f_far: (number | null)[];
    /** near side: cosine of the angle between the emitted light and the disk's normal in the gas's frame. */
    mu_near: (number | null)[];
    /** far side: cosine of the same angle. */
    mu_far: (number | null)[];
    /** smallest g of the ring. */
    g_min: (number | null)[];
    /** largest g of the ring. */
    g_max: (number | null)[];
  };
  units: Record<string, string>;
  sources: string[];
  approximations: string[];
}

export interface SpectrumRequest {
  /** preset to which the scene is merged. */
  preset?:
    | 'smooth' | 'schwarzschild' | 'reissner-nordstrom' | 'gargantua' | 'm87' | 'sgra' | 'luminet1979' | 'edge-on'
    | 'face-on' | 'photon-rings' | 'living-disk' | 'hot-spot' | 'echo' | 'milky-way' | 'gas' | 'gas-stars'
    | 'thick-disk' | 'star-behind' | 'companions' | 'falling' | 'infall' | 'jet' | 'gargantua-gas' | 'polarised-ring'
    | 'gold-1' | 'gold-2' | 'gold-3' | 'gold-4' | 'gold-5' | 'riaf' | 'torus';
  scene?: Scene;
  /** spin of the hole; below 0 the disk rotates against the hole [M]; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; the gas is neutral; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  /** angle between the axis and the observer, who is at infinity [deg]; 0 to 180. */
  inclination_deg?: number;
  /** radius of the disk's inner edge, at least that of the ISCO [M]; 1 to 1000000. */
  inner?: 'isco' | number;
  /** outer edge of the disk [M]; 1 to 1000000. */
  outer?: number;
  /**
   * dependence of the light on mu, the cosine of the angle from the disk's normal: none, 1 + 2.06 mu, ln(1 +
   * 1/mu), or that of a deep atmosphere of free electrons.
   */
  limb?: 'isotropic' | 'laor' | 'haardt' | 'scattering';
  /** mass of the hole [solar masses]; 1e-05 to 1e+12. */
  mass_msun?: number;
  /** distance of the hole [pc]; 0.001 to 1e+12. */
  distance_pc?: number;
  /**
   * accretion rate as luminosity over the Eddington luminosity, with the efficiency of this spin [Eddington
   * rates]; 1e-12 to 1000.
   */
  mdot_edd?: number;
  /** colour temperature over effective temperature; 1 to 10. */
  colour_correction?: number;
  /**
   * yes: the disk absorbs the light that returns to it, and radiates it again as a black body; scattered: its
   * atmosphere of free electrons reflects the light that returns for the first time; inner must then be the ISCO.
   */
  returning?: 'no' | 'yes' | 'scattered';
  /**
   * yes: degree and angle of the polarisation of a deep atmosphere of free electrons, for which limb must be
   * "scattering".
   */
  polarization?: 'no' | 'yes';
  /**
   * first frequency; auto: 0.001 k/h times the hottest ring's colour temperature; for a scene 1/30 of its
   * frequency [Hz]; 0.001 to 1e+25.
   */
  frequency_min_hz?: 'auto' | number;
  /**
   * last frequency; auto: 30 k/h times the hottest ring's colour temperature; for a scene 30 times its frequency,
   * for a disk at most 64 k/h times its largest colour temperature [Hz]; 0.001 to 1e+25.
   */
  frequency_max_hz?: 'auto' | number;
  /**
   * number of frequencies, spaced by equal ratios; default 200; for a scene the default is 13 and the most is
   * 200; 2 to 1000.
   */
  frequencies?: number;
  /** frequencies, instead of frequency_min_hz, frequency_max_hz and frequencies [Hz]; up to 20001. */
  frequencies_hz?: number[];
  /** pixels along the longer side of a picture; default 128 for a spectrum, 256 otherwise; 16 to 2048. */
  pixels?: number;
  /** estimate of the error: from the same picture with 1.5 times as many pixels along each side, or none. */
  check?: 'finer' | 'none';
}

export interface DiskSpectrum {
  integral: 'spectrum';
  parameters: {
    spin: number;
    charge: number;
    inclination_deg: number;
    inner: number;
    outer: number;
    limb: string;
    mass_msun: number;
    distance_pc: number;
    mdot_edd: number;
    colour_correction: number;
    returning: string;
    polarization: string;
    frequency_min_hz: number;
    frequency_max_hz: number;
    frequencies: number;
  };
  values: {
    /** innermost stable circular orbit. */
    isco: number | null;
    /** effective temperature of the hottest ring. */
    t_max_k: number | null;
    /** efficiency times Mdot c^2. */
    luminosity_w: number | null;
    /** estimated relative error of the flux where it exceeds a millionth of its maximum. */
    error: number | null;
  };
  columns: {
    /** at the observer. */
    frequency_hz: (number | null)[];
    /** F_nu. */
    flux_w_m2_hz: (number | null)[];
    /** F_nu. */
    flux_jy: (number | null)[];
    /** 4 pi D^2 nu F_nu, the luminosity of an isotropic source with this flux. */
    nu_l_nu_w: (number | null)[];
    /** degree of linear polarisation; null unless polarization is yes. */
    degree: (number | null)[];
    /**
     * angle of the electric field from the projection of the disk's axis, which is north, to the east, from -90 to
     * 90; null unless polarization is yes.
     */
    angle_deg: (number | null)[];
  };
  units: Record<string, string>;
  sources: string[];
  approximations: string[];
}

export interface ImpulseRequest {
  /** spin of the hole; below 0 the disk rotates against the hole [M]; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; the gas is neutral; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  /** angle between the axis and the observer, who is at infinity; not 87 to 93 [deg]; 0 to 87; 93 to 180. */
  inclination_deg?: number;
  /** radius of the disk's inner edge, at least that of the ISCO [M]; 1 to 1000000. */
  inner?: 'isco' | number;
  /** outer edge of the disk [M]; 1 to 1000000. */
  outer?: number;
  /** source of the light that the disk receives: a point on the axis, or a ring about it. */
  emissivity?: 'lamppost' | 'ring';
  /**
   * lamppost, ring, disk, slab: height of the source above the plane, r cos(theta); for a slab, height of its
   * lower side [M]; 0.1 to 10000.
   */
  height?: number;
  /** ring: distance from the axis, r sin(theta); disk, slab: outer radius of the source [M]; 0.001 to 10000. */
  corona_radius?: number;
  /**
   * ring, disk, slab: motion of the source: at rest, with zero angular momentum, or with the angular velocity of
   * the disk's gas at the same distance from the axis (within the ISCO, that of the ISCO).
   */
  motion?: 'static' | 'zamo' | 'corotating';
  /** lamppost, ring, disk, slab: photon index of the source's power law; 0 to 10. */
  photon_index?: number;
  /**
   * dependence of the light on mu, the cosine of the angle from the disk's normal: none, 1 + 2.06 mu, ln(1 +
   * 1/mu), or that of a deep atmosphere of free electrons.
   */
  limb?: 'isotropic' | 'laor' | 'haardt' | 'scattering';
  /** energy of the line in the gas's frame, in any unit; edges have the same unit; 1e-09 to 1000000000. */
  rest_energy?: number;
  /** first edge of bins of equal width; 0 to 1000000000. */
  energy_min?: number;
  /** last edge; auto: 1.7 times rest_energy; 0 to 1000000000. */
  energy_max?: 'auto' | number;
  /** number of bins of equal width; 1 to 20000. */
  bins?: number;
  /** edges of the bins in ascending order, instead of energy_min, energy_max and bins; up to 20001. */
  edges?: number[];
  /** first edge of the bins of time, after the direct light's mean arrival [M]; -1000000 to 1000000. */
  time_min?: number;
  /** last edge of the bins of time [M]; -1000000 to 1000000. */
  time_max?: number;
  /** number of bins of time, of equal width; 1 to 4096. */
  times?: number;
  /** mass of the hole [solar masses]; 1e-05 to 1e+12. */
  mass_msun?: number;
}

export interface ImpulseResponse {
  integral: 'impulse';
  parameters: {
    spin: number;
    charge: number;
    inclination_deg: number;
    inner: number;
    outer: number;
    emissivity: string;
    height: number;
    corona_radius: number;
    motion: string;
    photon_index: number;
    limb: string;
    rest_energy: number;
    energy_min: number;
    energy_max: number;
    bins: number;
    time_min: number;
    time_max: number;
    times: number;
    mass_msun: number;
  };
  values: {
    /** innermost stable circular orbit. */
    isco: number | null;
    /**
     * equivalent width of the line at the observer over that in the gas's frame, for gas that emits as many line
     * photons as continuum photons per unit of energy reach it.
     */
    strength: number | null;
    /** ratio of the source's continuum at the observer to that of the same source at rest far from the hole. */
    direct_flux: number | null;
    /** mean redshift factor of the continuum. */
    direct_g: number | null;
    /** mean arrival time of the continuum after the flash, minus r + 2 ln r at the observer's radius r. */
    direct_time: number | null;
    /** GM/c^3. */
    unit_s: number | null;
    /** share of the line in all bins. */
    inside: number | null;
    /** mean time of all photons of the line. */
    mean_time: number | null;
    /** estimated largest error of the share of the line before a time and below an energy. */
    error: number | null;
  };
  columns: {
    /** edge of the bin. */
    energy_low: (number | null)[];
    /** edge of the bin. */
    energy_high: (number | null)[];
    /** edge of the bin, after the direct light's mean arrival. */
    time_low: (number | null)[];
    /** edge of the bin. */
    time_high: (number | null)[];
    /** share of the line's photons in the bin. */
    share: (number | null)[];
  };
  units: Record<string, string>;
  sources: string[];
  approximations: string[];
}

export interface LagsRequest {
  /** spin of the hole; below 0 the disk rotates against the hole [M]; -1 to 1. */
  spin?: number;
  /** charge Q of the hole; the gas is neutral; a^2 + Q^2 < 1 [M]; -1 to 1. */
  charge?: number;
  /** angle between the axis and the observer, who is at infinity; not 87 to 93 [deg]; 0 to 87; 93 to 180. */
  inclination_deg?: number;
  /** radius of the disk's inner edge, at least that of the ISCO [M]; 1 to 1000000. */
  inner?: 'isco' | number;
  /** outer edge of the disk [M]; 1 to 1000000. */
  outer?: number;
  /** source of the light that the disk receives: a point on the axis, or a ring about it. */
  emissivity?: 'lamppost' | 'ring';
  /**
   * lamppost, ring, disk, slab: height of the source above the plane, r cos(theta); for a slab, height of its
   * lower side [M]; 0.1 to 10000.
   */
  height?: number;
  /** ring: distance from the axis, r sin(theta); disk, slab: outer radius of the source [M]; 0.001 to 10000. */
  corona_radius?: number;
  /**
   * ring, disk, slab: motion of the source: at rest, with zero angular momentum, or with the angular velocity of
   * the disk's gas at the same distance from the axis (within the ISCO, that of the ISCO).
   */
  motion?: 'static' | 'zamo' | 'corotating';
  /** lamppost, ring, disk, slab: photon index of the source's power law; 0 to 10. */
  photon_index?: number;
  /**
   * dependence of the light on mu, the cosine of the angle from the disk's normal: none, 1 + 2.06 mu, ln(1 +
   * 1/mu), or that of a deep atmosphere of free electrons.
   */
  limb?: 'isotropic' | 'laor' | 'haardt' | 'scattering';
  /** energy of the line in the gas's frame, in any unit; edges have the same unit; 1e-09 to 1000000000. */
  rest_energy?: number;
  /** first edge of bins of equal width; 0 to 1000000000. */
  energy_min?: number;
  /** last edge; auto: 1.7 times rest_energy; 0 to 1000000000. */
  energy_max?: 'auto' | number;
  /** number of bins of equal width; 1 to 20000. */
  bins?: number;
  /** edges of the bins in ascending order, instead of energy_min, energy_max and bins; up to 20001. */
  edges?: number[];
  /** first Fourier frequency [c^3/GM]; 1e-09 to 10. */
  frequency_min?: number;
  /** last Fourier frequency [c^3/GM]; 1e-09 to 10. */
  frequency_max?: number;
  /** number of Fourier frequencies, at equal ratios; 1 to 200. */
  frequencies?: number;
  /** Fourier frequencies, instead of frequency_min, frequency_max and frequencies [c^3/GM]; up to 200. */
  frequencies_m?: number[];
  /**
   * ratio of the line's photons at all energies to the continuum's photons between the first and the last edge,
   * both at the observer; 0 to 1000000.
   */
  reflection?: number;
  /**
   * lower end of the band that lags are measured against, in the unit of rest_energy; continuum: the direct light
   * alone; 1e-09 to 1000000000.
   */
  reference_min?: 'continuum' | number;
  /**
   * upper end of the band that lags are measured against; continuum: the direct light alone; 1e-09 to 1000000000.
   */
  reference_max?: 'continuum' | number;
  /** mass of the hole [solar masses]; 1e-05 to 1e+12. */
  mass_msun?: number;
}

export interface Lags {
  integral: 'lags';
  parameters: {
    spin: number;
    charge: number;
    inclination_deg: number;
    inner: number | string;
    outer: number;
    emissivity: string;
    height: number;
    corona_radius: number;
    motion: string;
    photon_index: number;
    limb: string;
    rest_energy: number;
    energy_min: number;
    energy_max: number | string;
    bins: number;
    frequency_min: number;
    frequency_max: number;
    frequencies: number;
    reflection: number;
    reference_min: number | string;
    reference_max: number | string;
    mass_msun: number;
  };
  values: {
    /** innermost stable circular orbit. */
    isco: number | null;
    /**
     * equivalent width of the line at the observer over that in the gas's frame, for gas that emits as many line
     * photons as continuum photons per unit of energy reach it.
     */
    strength: number | null;
    /** ratio of the source's continuum at the observer to that of the same source at rest far from the hole. */
    direct_flux: number | null;
    /** mean redshift factor of the continuum. */
    direct_g: number | null;
    /** mean arrival time of the continuum after the flash, minus r + 2 ln r at the observer's radius r. */
    direct_time: number | null;
    /** GM/c^3. */
    unit_s: number | null;
    /** largest value of the column error. */
    error: number | null;
  };
  columns: {
    /** Fourier frequency. */
    frequency: (number | null)[];
    /** the same. */
    frequency_hz: (number | null)[];
    /** edge of the bin. */
    energy_low: (number | null)[];
    /** edge of the bin. */
    energy_high: (number | null)[];
    /** phase of the cross spectrum over 2 pi frequency; positive: the bin comes after the reference. */
    lag: (number | null)[];
    /** the same. */
    lag_s: (number | null)[];
    /** share of the line in the bin's photons: R/(1 + R), the dilution. */
    reflected: (number | null)[];
    /** estimated error of the lag. */
    error: (number | null)[];
  };
  units: Record<string, string>;
  sources: string[];
  approximations: string[];
}

export interface VolumeSpectrum {
  integral: 'spectrum';
  parameters: {
    frequency_min_hz: number;
    frequency_max_hz: number;
    frequencies: number;
    pixels: number;
    check: string;
  };
  values: {
    /** of each picture. */
    width: number | null;
    /** of each picture. */
    height: number | null;
    /** largest value of the column error. */
    error: number | null;
  };
  columns: {
    /** at the observer. */
    frequency_hz: (number | null)[];
    /** F_nu. */
    flux_w_m2_hz: (number | null)[];
    /** F_nu. */
    flux_jy: (number | null)[];
    /** 4 pi D^2 nu F_nu, the luminosity of an isotropic source with this flux. */
    nu_l_nu_w: (number | null)[];
    /**
     * estimated relative error of the flux, from a picture 1.5 times as fine; 1: the error is at least as large as
     * the flux.
     */
    error: (number | null)[];
  };
  units: Record<string, string>;
  sources: string[];
  approximations: string[];
  scene: Scene;
}

export interface VisibilityRequest {
  /** preset to which the scene is merged. */
  preset?:
    | 'smooth' | 'schwarzschild' | 'reissner-nordstrom' | 'gargantua' | 'm87' | 'sgra' | 'luminet1979' | 'edge-on'
    | 'face-on' | 'photon-rings' | 'living-disk' | 'hot-spot' | 'echo' | 'milky-way' | 'gas' | 'gas-stars'
    | 'thick-disk' | 'star-behind' | 'companions' | 'falling' | 'infall' | 'jet' | 'gargantua-gas' | 'polarised-ring'
    | 'gold-1' | 'gold-2' | 'gold-3' | 'gold-4' | 'gold-5' | 'riaf' | 'torus';
  scene?: Scene;
  /**
   * eastward components of the baselines, in units of 1e9 wavelengths; as many numbers as v has [Gl]; up to
   * 20001.
   */
  u?: number[];
  /** northward components of the baselines [Gl]; up to 20001. */
  v?: number[];
  /**
   * lengths of baselines, instead of u and v; each length is combined with each of angles_deg [Gl]; up to 20001.
   */
  lengths?: number[];
  /**
   * longest baseline, for lengths from 0 to it instead of lengths; auto: half of the longest baseline that the
   * map's pixels resolve [Gl]; 1e-09 to 1e+15.
   */
  length_max?: 'auto' | number;
  /** number of lengths from 0 to length_max; 2 to 20000. */
  baselines?: number;
  /**
   * position angles of the baselines given by lengths, from north to east; default 0 and 90 [deg]; up to 20001.
   */
  angles_deg?: number[];
  /** number of image orders, from order 0, whose visibilities are also given separately; 0 to 8. */
  orders?: number;
  /** pixels along the longer side of a picture; default 128 for a spectrum, 256 otherwise; 16 to 2048. */
  pixels?: number;
  /** estimate of the error: from the same picture with 1.5 times as many pixels along each side, or none. */
  check?: 'finer' | 'none';
  /** significant digits of the columns as text; 1 to 17. */
  digits?: number;
}

export interface Visibilities {
  integral: 'visibility';
  parameters: {
    length_max: number | string;
    baselines: number;
    orders: number;
    pixels: number;
    check: string;
    digits: number;
  };
  values: {
    /** flux of the whole map; null if its light has no frequency. */
    flux_jy: number | null;
    /** distance from one pixel to the next. */
    pixel_uas: number | null;
    /** width of the map. */
    width_uas: number | null;
    /** height of the map. */
    height_uas: number | null;
    /** longest baseline that the width of the pixels resolves. */
    nyquist_gl: number | null;
    /** flux of a map that is everywhere as bright as the map's border, as a share of the map's flux. */
    edge_share: number | null;
    /** number of pixels whose light is not a number; they count as dark. */
    undefined: number | null;
    /** largest value of the column error. */
    error: number | null;
  };
  columns: {
    /** baseline to the east, in units of 1e9 wavelengths. */
    u_gl: (number | null)[];
    /** to the north. */
    v_gl: (number | null)[];
    /** of the baseline. */
    length_gl: (number | null)[];
    /** -1: all light; n: light of image order n alone. */
    order: (number | null)[];
    /** real part. */
    re: (number | null)[];
    /** imaginary part. */
    im: (number | null)[];
    /** amplitude, in Jy or as a share of the flux of all light. */
    amplitude: (number | null)[];
    /** phase about the position of the hole, from -180 to 180. */
    phase_deg: (number | null)[];
    /** estimated error of re and im, from a map 1.5 times as fine. */
    error: (number | null)[];
  };
  units: Record<string, string>;
  sources: string[];
  approximations: string[];
  scene: Scene;
}

export interface CompareRequest {
  /** preset to which the scene is merged. */
  preset?:
    | 'smooth' | 'schwarzschild' | 'reissner-nordstrom' | 'gargantua' | 'm87' | 'sgra' | 'luminet1979' | 'edge-on'
    | 'face-on' | 'photon-rings' | 'living-disk' | 'hot-spot' | 'echo' | 'milky-way' | 'gas' | 'gas-stars'
    | 'thick-disk' | 'star-behind' | 'companions' | 'falling' | 'infall' | 'jet' | 'gargantua-gas' | 'polarised-ring'
    | 'gold-1' | 'gold-2' | 'gold-3' | 'gold-4' | 'gold-5' | 'riaf' | 'torus';
  scene?: Scene;
  /**
   * SHA-256 of an asset of the server: uvfits, or the EHT's CSV; or the name of an observation that the server
   * has: m87-2017-04-05-lo.
   */
  observation: string;
  /**
   * parameter sets; chi^2 is computed for each. A set may have fields of the scene, named by their paths (such as
   * spacetime.spin), and flux_jy, size and position_angle_deg; up to 4096.
   */
  sets?: (Record<string, number | string | boolean>)[];
  /** quantities that are compared; visibility: real and imaginary parts, which need calibrated phases. */
  products?: ('amplitude' | 'closure_phase' | 'log_closure_amplitude' | 'visibility')[];
  /**
   * length in seconds of the bins in which visibilities are averaged, counted from 1960-01-01; 0: no averaging
   * [s]; 0 to 86400.
   */
  average_s?: number;
  /**
   * shortest baseline that is compared, in units of 1e9 wavelengths; shorter ones, within one site, see light
   * from outside the map [Gl]; 0 to 1000000.
   */
  uv_min_gl?: number;
  /** lowest signal-to-noise ratio of amplitudes and closures that are compared; 0 to 1000000. */
  snr_cut?: number;
  systematic?: {
    /**
     * share of each visibility's amplitude that is added to its error in quadrature, before all other steps; 0 to
     * 1.
     */
    visibility?: number;
    /** relative error of a station; sqrt(2) times it is added to an amplitude's error in quadrature; 0 to 1. */
    amplitude?: number;
    /** systematic error that is added to the error of a closure phase in quadrature [deg]; 0 to 180. */
    closure_phase_deg?: number;
  };
  /** yes: amplitudes are sqrt(|V|^2 - sigma^2), also in closures; no: as measured. */
  debias?: 'yes' | 'no';
  /** minimal: independent triangles and quadrangles with the first station; maximal: all. */
  closures?: 'minimal' | 'maximal';
  /** shape of a pixel's light. */
  pulse?: 'triangle' | 'rectangle' | 'point';
  /**
   * interstellar scattering of the model: sgra: the average kernel towards Sagittarius A* at the observation's
   * frequency.
   */
  scattering?: 'none' | 'sgra';
  /**
   * flux to which the whole map is scaled; auto: the scene's flux; if its light has no frequency, a comparison
   * takes the best fit to the amplitudes [Jy]; 1e-12 to 1e+12.
   */
  flux_jy?: 'auto' | number;
  /**
   * quantities that are fitted for the smallest chi^2 of all data: flux, angular size, position angle, and the
   * position, which needs the product visibility.
   */
  solve?: ('flux' | 'size' | 'position_angle' | 'shift')[];
  /** pixels along the longer side of a picture; default 128 for a spectrum, 256 otherwise; 16 to 2048. */
  pixels?: number;
  /** estimate of the error: from the same picture with 1.5 times as many pixels along each side, or none. */
  check?: 'finer' | 'none';
  /** significant digits of the columns as text; 1 to 17. */
  digits?: number;
}

export interface Comparison {
  integral: 'compare';
  parameters: {
    products: string[];
    average_s: number;
    uv_min_gl: number;
    snr_cut: number;
    systematic: {
      visibility: number;
      amplitude: number;
      closure_phase_deg: number;
    };
    debias: string;
    closures: string;
    pulse: string;
    scattering: string;
    flux_jy: number | string;
    solve: string[];
    pixels: number;
    check: string;
    digits: number;
  };
  values: {
    /** flux of the whole compared map; null if nothing determines it. */
    flux_jy: number | null;
    /** distance from one pixel to the next. */
    pixel_uas: number | null;
    /** width of the map. */
    width_uas: number | null;
    /** height of the map. */
    height_uas: number | null;
    /** longest baseline that the width of the pixels resolves. */
    nyquist_gl: number | null;
    /** flux of a map that is everywhere as bright as the map's border, as a share of the map's flux. */
    edge_share: number | null;
    /** number of pixels whose light is not a number; they count as dark. */
    undefined: number | null;
    /** largest estimated error of the model's amplitudes, from a map 1.5 times as fine. */
    model_error: number | null;
    /** factor by which the map is enlarged, at the same flux. */
    size: number | null;
    /** angle by which the map is rotated, from north to east. */
    position_angle_deg: number | null;
    /** shift of the map to the east. */
    shift_east_uas: number | null;
    /** shift of the map to the north. */
    shift_north_uas: number | null;
  };
  columns: {
    /** amplitude, closure_phase, log_closure_amplitude, visibility_re or visibility_im. */
    product: (string | null)[];
    /** UTC, hours since the start of the observation's mjd. */
    hour: (number | null)[];
    /** station of the baseline, triangle or quadrangle. */
    station_1: (string | null)[];
    /** the same. */
    station_2: (string | null)[];
    /** station of a triangle or quadrangle. */
    station_3: (string | null)[];
    /** station of a quadrangle: the log closure amplitude is that of 12 34 / 14 23. */
    station_4: (string | null)[];
    /** baseline of an amplitude or visibility, in units of 1e9 wavelengths. */
    u_gl: (number | null)[];
    /** the same. */
    v_gl: (number | null)[];
    /** observed amplitude, closure phase, log closure amplitude or part of a visibility. */
    data: (number | null)[];
    /** error of the datum, with systematic errors. */
    error: (number | null)[];
    /** value of the scene. */
    model: (number | null)[];
    /** difference of data and model over the error. */
    residual: (number | null)[];
  };
  units: Record<string, string>;
  sources: string[];
  approximations: string[];
  scene: Scene;
  /** chi^2 over the number of data; null for a product without data. */
  chi2: {
    amplitude: number | null;
    closure_phase: number | null;
    log_closure_amplitude: number | null;
    visibility: number | null;
  };
  /** chi^2 over the number of data for a map 1.5 times as fine; null with check none. */
  chi2_finer: {
    amplitude: number | null;
    closure_phase: number | null;
    log_closure_amplitude: number | null;
    visibility: number | null;
  };
  /** number of data; two for each visibility. */
  n: {
    /** at least 0. */
    amplitude: number;
    /** at least 0. */
    closure_phase: number;
    /** at least 0. */
    log_closure_amplitude: number;
    /** at least 0. */
    visibility: number;
  };
  /**
   * quantities that were fitted; converged is false if a search ended at its bounds or before its steps became
   * small.
   */
  solved: {
    name: string;
    value: number | null;
    converged: boolean;
  }[];
  observation: {
    source: string;
    mjd: number;
    frequency_ghz: number;
    stations: string[];
    /** at least 0. */
    visibilities: number;
    /** at least 0. */
    flagged: number;
    /** at least 0. */
    duplicates: number;
    /** at least 0. */
    averaged: number;
    /** at least 0. */
    too_short: number;
  };
}

export interface ComparisonOfSets {
  integral: 'compare';
  parameters: {
    products: string[];
    average_s: number;
    uv_min_gl: number;
    snr_cut: number;
    systematic: {
      visibility: number;
      amplitude: number;
      closure_phase_deg: number;
    };
    debias: string;
    closures: string;
    pulse: string;
    scattering: string;
    flux_jy: number | string;
    solve: string[];
    pixels: number;
    check: string;
    digits: number;
  };
  values: {
    /** number of different scenes, each rendered once. */
    pictures: number | null;
    /** distance from one pixel to the next, in the last picture. */
    pixel_uas: number | null;
    /** width of the last map. */
    width_uas: number | null;
    /** height of the last map. */
    height_uas: number | null;
    /** longest baseline that the pixels of the last map resolve. */
    nyquist_gl: number | null;
    /**
     * flux of a map that is everywhere as bright as the map's border, as a share of the map's flux; the largest of
     * all maps.
     */
    edge_share: number | null;
    /** number of pixels whose light is not a number, in all pictures; they count as dark. */
    undefined: number | null;
  };
  columns: {
    /** chi^2 of the amplitudes over their number; null without data, or if the picture is dark. */
    chi2_amplitude: (number | null)[];
    /** chi^2 of the closure phases over their number. */
    chi2_closure_phase: (number | null)[];
    /** chi^2 of the log closure amplitudes over their number. */
    chi2_log_closure_amplitude: (number | null)[];
    /** chi^2 of the visibilities over their number. */
    chi2_visibility: (number | null)[];
    /** chi^2 summed over all data; null if the picture is dark. */
    total: (number | null)[];
    /** flux of the compared map; null if nothing determines it. */
    flux_jy: (number | null)[];
    /** factor by which the map is enlarged, at the same flux. */
    size: (number | null)[];
    /** angle by which the map is rotated, from north to east. */
    position_angle_deg: (number | null)[];
    /** shift of the map to the east. */
    shift_east_uas: (number | null)[];
    /** shift of the map to the north. */
    shift_north_uas: (number | null)[];
    /** 1: all searches converged; 0: one did not, or the picture is dark. */
    converged: (number | null)[];
  };
  units: Record<string, string>;
  sources: string[];
  approximations: string[];
  scene: Scene;
  observation: {
    source: string;
    mjd: number;
    frequency_ghz: number;
    stations: string[];
    /** at least 0. */
    visibilities: number;
    /** at least 0. */
    flagged: number;
    /** at least 0. */
    duplicates: number;
    /** at least 0. */
    averaged: number;
    /** at least 0. */
    too_short: number;
  };
  /** number of data; two for each visibility. */
  n: {
    /** at least 0. */
    amplitude: number;
    /** at least 0. */
    closure_phase: number;
    /** at least 0. */
    log_closure_amplitude: number;
    /** at least 0. */
    visibility: number;
  };
}

export interface ObserveRequest {
  /** preset to which the scene is merged. */
  preset?:
    | 'smooth' | 'schwarzschild' | 'reissner-nordstrom' | 'gargantua' | 'm87' | 'sgra' | 'luminet1979' | 'edge-on'
    | 'face-on' | 'photon-rings' | 'living-disk' | 'hot-spot' | 'echo' | 'milky-way' | 'gas' | 'gas-stars'
    | 'thick-disk' | 'star-behind' | 'companions' | 'falling' | 'infall' | 'jet' | 'gargantua-gas' | 'polarised-ring'
    | 'gold-1' | 'gold-2' | 'gold-3' | 'gold-4' | 'gold-5' | 'riaf' | 'torus';
  scene?: Scene;
  /**
   * SHA-256 of an asset of the server: uvfits, or the EHT's CSV; or the name of an observation that the server
   * has: m87-2017-04-05-lo.
   */
  observation: string;
  /** shape of a pixel's light. */
  pulse?: 'triangle' | 'rectangle' | 'point';
  /**
   * interstellar scattering of the model: sgra: the average kernel towards Sagittarius A* at the observation's
   * frequency.
   */
  scattering?: 'none' | 'sgra';
  /**
   * flux to which the whole map is scaled; auto: the scene's flux; if its light has no frequency, a comparison
   * takes the best fit to the amplitudes [Jy]; 1e-12 to 1e+12.
   */
  flux_jy?: 'auto' | number;
  /** yes: Gaussian noise with the errors of the observation; no: none. */
  noise?: 'yes' | 'no';
  /** seed of the noise; 0 to 4294967295. */
  seed?: number;
  /** pixels along the longer side of a picture; default 128 for a spectrum, 256 otherwise; 16 to 2048. */
  pixels?: number;
  /** estimate of the error: from the same picture with 1.5 times as many pixels along each side, or none. */
  check?: 'finer' | 'none';
}

export interface Simulation {
  integral: 'observe';
  parameters: {
    pulse: string;
    scattering: string;
    flux_jy: number | string;
    noise: string;
    seed: number;
    pixels: number;
    check: string;
  };
  values: {
    /** flux of the whole map. */
    flux_jy: number | null;
    /** distance from one pixel to the next. */
    pixel_uas: number | null;
    /** width of the map. */
    width_uas: number | null;
    /** height of the map. */
    height_uas: number | null;
    /** longest baseline that the width of the pixels resolves. */
    nyquist_gl: number | null;
    /** flux of a map that is everywhere as bright as the map's border, as a share of the map's flux. */
    edge_share: number | null;
    /** number of pixels whose light is not a number; they count as dark. */
    undefined: number | null;
    /** largest estimated error of the model, from a map 1.5 times as fine. */
    model_error: number | null;
  };
  columns: {
    /** UTC, hours since the start of the observation's mjd. */
    hour: (number | null)[];
    /** station of the baseline. */
    station_1: (string | null)[];
    /** the same. */
    station_2: (string | null)[];
    /** baseline to the east, in units of 1e9 wavelengths. */
    u_gl: (number | null)[];
    /** to the north. */
    v_gl: (number | null)[];
    /** real part of the simulated visibility. */
    re: (number | null)[];
    /** imaginary part. */
    im: (number | null)[];
    /** error of each part, as in the observation. */
    sigma: (number | null)[];
    /** real part without noise. */
    model_re: (number | null)[];
    /** imaginary part without noise. */
    model_im: (number | null)[];
  };
  units: Record<string, string>;
  sources: string[];
  approximations: string[];
  scene: Scene;
  observation: {
    source: string;
    mjd: number;
    frequency_ghz: number;
    stations: string[];
    /** at least 0. */
    visibilities: number;
    /** at least 0. */
    flagged: number;
    /** at least 0. */
    duplicates: number;
  };
}

export interface PlaygroundBody {
  name?: string;
  /** mass in units of the hole's mass, at least 1e-30; 0: a test body that attracts nothing; 0 to 1e+12. */
  mass?: number;
  /** radius in M, at least 1e-30; 0: a point without collisions and tides; 0 to 1000000. */
  radius?: number;
  /** temperature of the surface in K; 0: dark; 0 to 10000000000. */
  temperature_k?: number;
  /** x, y, z in M; the hole is at the origin, its axis along z; up to 3. */
  position: number[];
  /** velocity in c; the speed must be at most 1; up to 3. */
  velocity?: number[];
}

export interface PlaygroundBodyChange {
  /** 1 to 4294967295. */
  id: number;
  name?: string;
  /** mass in units of the hole's mass, at least 1e-30; 0: a test body that attracts nothing; 0 to 1e+12. */
  mass?: number;
  /** radius in M, at least 1e-30; 0: a point without collisions and tides; 0 to 1000000. */
  radius?: number;
  /** temperature of the surface in K; 0: dark; 0 to 10000000000. */
  temperature_k?: number;
  /** x, y, z in M; the hole is at the origin, its axis along z; up to 3. */
  position?: number[];
  /** velocity in c; the speed must be at most 1; up to 3. */
  velocity?: number[];
}

export interface Playground {
  /** pace in M per second of real time; a preset has its own default; 0 to 1000000000. */
  rate?: number;
  /** default false. */
  paused?: boolean;
  scene?: Scene;
  /**
   * gravity of the hole: a potential, in which bodies also attract one another, or exact geodesics of test
   * bodies.
   */
  gravity?: 'paczynski-wiita' | 'kerr';
  /** spin of the hole (gravity "kerr" only); -0.999 to 0.999. */
  spin?: number;
  /** charge Q of the hole in M (gravity "kerr" only); the bodies are neutral; a^2 + Q^2 < 1; 0 to 0.999. */
  charge?: number;
  /** softening length in M of the bodies' mutual attraction; 0.0001 to 1000. */
  softening?: number;
  /** longest sub-step in M, and the interval at which debris is advanced; 1e-06 to 1000000. */
  h_max?: number;
  /** factor C of the limit C (r - 2) of the sub-step, and of its limit for two close bodies; 0.0001 to 0.2. */
  safety?: number;
  /**
   * limit of the sub-steps of one advance; if it is reached, the advance is shorter than requested; 1 to
   * 100000000.
   */
  budget?: number;
  /** bodies that touch merge. */
  mergers?: boolean;
  /** the hole's tide sheds a star's mass, and tears it apart. */
  tides?: boolean;
  /** bodies lose energy to gravitational waves. */
  waves?: boolean;
  /** factor on the loss to gravitational waves; 1: the physical value; 0 to 1000000000. */
  amplification?: number;
  /** debris that has returned is counted as accreted and removed; otherwise it moves on. */
  feeds?: boolean;
  /** largest number of pieces of debris; beyond it, a new piece replaces the oldest; 0 to 1000000. */
  debris_capacity?: number;
  /** number of pieces of debris of a body that is torn apart; 16 to 1000000. */
  debris_per_body?: number;
  /** temperature in K of the debris, a black body in pictures; 300 to 1000000000. */
  debris_temperature_k?: number;
  /** optical depth in pictures that the debris of one body has if it is spread over 1000 M^2; 0 to 1000000. */
  debris_depth?: number;
  /** share of the disk's light that bodies reflect in pictures; 0: reflection is not computed; 0 to 1. */
  albedo?: number;
  /** seed of the random directions of debris; 0 to 4294967295. */
  seed?: number;
  preset?: 'disruption' | 'white-dwarf' | 'system' | 'binary' | 'emri' | 'swarm' | 'figure-eight';
  /** up to 4096. */
  bodies?: PlaygroundBody[];
  /**
   * further state of a snapshot, on which the motion depends. Return it unchanged; its form depends on the
   * version.
   */
  state?: Record<string, unknown>;
}

export interface PlaygroundChange {
  /** pace in M per second of real time; a preset has its own default; 0 to 1000000000. */
  rate?: number;
  /** default false. */
  paused?: boolean;
  scene?: Scene;
  /**
   * gravity of the hole: a potential, in which bodies also attract one another, or exact geodesics of test
   * bodies.
   */
  gravity?: 'paczynski-wiita' | 'kerr';
  /** spin of the hole (gravity "kerr" only); -0.999 to 0.999. */
  spin?: number;
  /** charge Q of the hole in M (gravity "kerr" only); the bodies are neutral; a^2 + Q^2 < 1; 0 to 0.999. */
  charge?: number;
  /** softening length in M of the bodies' mutual attraction; 0.0001 to 1000. */
  softening?: number;
  /** longest sub-step in M, and the interval at which debris is advanced; 1e-06 to 1000000. */
  h_max?: number;
  /** factor C of the limit C (r - 2) of the sub-step, and of its limit for two close bodies; 0.0001 to 0.2. */
  safety?: number;
  /**
   * limit of the sub-steps of one advance; if it is reached, the advance is shorter than requested; 1 to
   * 100000000.
   */
  budget?: number;
  /** bodies that touch merge. */
  mergers?: boolean;
  /** the hole's tide sheds a star's mass, and tears it apart. */
  tides?: boolean;
  /** bodies lose energy to gravitational waves. */
  waves?: boolean;
  /** factor on the loss to gravitational waves; 1: the physical value; 0 to 1000000000. */
  amplification?: number;
  /** debris that has returned is counted as accreted and removed; otherwise it moves on. */
  feeds?: boolean;
  /** largest number of pieces of debris; beyond it, a new piece replaces the oldest; 0 to 1000000. */
  debris_capacity?: number;
  /** number of pieces of debris of a body that is torn apart; 16 to 1000000. */
  debris_per_body?: number;
  /** temperature in K of the debris, a black body in pictures; 300 to 1000000000. */
  debris_temperature_k?: number;
  /** optical depth in pictures that the debris of one body has if it is spread over 1000 M^2; 0 to 1000000. */
  debris_depth?: number;
  /** share of the disk's light that bodies reflect in pictures; 0: reflection is not computed; 0 to 1. */
  albedo?: number;
  /** seed of the random directions of debris; 0 to 4294967295. */
  seed?: number;
  /** up to 4096. */
  add?: PlaygroundBody[];
  /** up to 4096. */
  change?: PlaygroundBodyChange[];
  /** up to 4096. */
  remove?: number[];
}

export interface PlaygroundSettings {
  gravity: string;
  spin: number;
  charge: number;
  softening: number;
  h_max: number;
  safety: number;
  /** at least 0. */
  budget: number;
  mergers: boolean;
  tides: boolean;
  waves: boolean;
  amplification: number;
  feeds: boolean;
  /** at least 0. */
  debris_capacity: number;
  /** at least 0. */
  debris_per_body: number;
  debris_temperature_k: number;
  debris_depth: number;
  albedo: number;
  /** at least 0. */
  seed: number;
}

/**
 * lengths and times in M, masses and energies in units of the hole's mass, speeds in c; rates in M per second
 * of real time.
 */
export interface PlaygroundBodyState {
  /** at least 1. */
  id: number;
  name: string;
  /** up to 3. */
  position: number[];
  /** up to 3. */
  velocity: number[];
  mass: number;
  radius: number;
  temperature_k: number;
}

/**
 * lengths and times in M, masses and energies in units of the hole's mass, speeds in c; rates in M per second
 * of real time.
 */
export interface PlaygroundTotals {
  mass: number;
  energy: number | null;
  /** up to 3. */
  momentum: number[];
  /** up to 3. */
  angular_momentum: number[];
  separation: number | null;
  wave_frequency: number | null;
}

/**
 * lengths and times in M, masses and energies in units of the hole's mass, speeds in c; rates in M per second
 * of real time.
 */
export interface PlaygroundSpent {
  captured_mass: number;
  captured_energy: number;
  /** up to 3. */
  captured_angular_momentum: number[];
  merged_energy: number;
  capped_energy: number;
  /** up to 3. */
  capped_momentum: number[];
  radiated_energy: number;
  torn_mass: number;
  torn_energy: number;
}

/**
 * lengths and times in M, masses and energies in units of the hole's mass, speeds in c; rates in M per second
 * of real time.
 */
export interface PlaygroundSource {
  /** at least 0. */
  number: number;
  name: string;
  t: number;
  piece_mass: number;
  energy_spread: number;
  /** at least 0. */
  pieces: number;
  /** at least 0. */
  back: number;
  /** at least 0. */
  captured: number;
  /** at least 0. */
  lost: number;
}

/**
 * lengths and times in M, masses and energies in units of the hole's mass, speeds in c; rates in M per second
 * of real time.
 */
export interface PlaygroundDebris {
  t: number;
  /** at least 0. */
  pieces: number;
  sources: PlaygroundSource[];
}

/**
 * lengths and times in M, masses and energies in units of the hole's mass, speeds in c; rates in M per second
 * of real time.
 */
export interface PlaygroundStatus {
  id: string;
  token?: string;
  rate: number;
  rate_reached: number | null;
  paused: boolean;
  slowed: boolean;
  resting: boolean;
  /** at least 0. */
  watchers: number;
  /** at least 0. */
  generation: number;
  asked?: number;
  done?: number;
  added?: number[];
  t: number;
  /** at least 0. */
  steps: number;
  settings: PlaygroundSettings;
  /** up to 4096. */
  bodies: PlaygroundBodyState[];
  totals: PlaygroundTotals;
  spent: PlaygroundSpent;
  debris: PlaygroundDebris;
  /** at least 0. */
  events: number;
  approximations: string[];
  scene: Scene;
}

export interface PlaygroundPresetTold {
  name: string;
  title: string;
  rate: number;
  /** up to 3. */
  centre: number[];
  reach: number;
}

export interface PlaygroundRow {
  name: string;
  type: 'number' | 'integer' | 'boolean' | 'string';
  default: number | boolean | string;
  least?: number;
  most?: number;
  words?: string[];
  fixed?: boolean;
  help: string;
}

export interface PlaygroundCatalogue {
  presets: PlaygroundPresetTold[];
  settings: PlaygroundRow[];
  pace: PlaygroundRow[];
  body: PlaygroundRow[];
}

/**
 * lengths and times in M, masses and energies in units of the hole's mass, speeds in c; rates in M per second
 * of real time.
 */
export interface PlaygroundColumns {
  t: (number | null)[];
  bodies: (number | null)[];
  energy: (number | null)[];
  energy_balance: (number | null)[];
  angular_momentum_x: (number | null)[];
  angular_momentum_y: (number | null)[];
  angular_momentum_z: (number | null)[];
  radiated: (number | null)[];
  separation: (number | null)[];
  wave_frequency: (number | null)[];
  h_plus: (number | null)[];
  h_cross: (number | null)[];
  debris: (number | null)[];
  debris_back: (number | null)[];
}

export interface PlaygroundSeries {
  columns: PlaygroundColumns;
}

/**
 * lengths and times in M, masses and energies in units of the hole's mass, speeds in c; rates in M per second
 * of real time.
 */
export interface PlaygroundHappened {
  /** at least 0. */
  number: number;
  t: number;
  kind: 'merger' | 'shedding' | 'disruption' | 'capture' | 'inspiral' | 'escape';
  /** at least 0. */
  body: number;
  name: string;
  mass: number;
  /** at least 0. */
  other?: number;
  other_name?: string;
  other_mass?: number;
  mass_left?: number;
  r: number;
  energy: number | null;
  tidal_radius?: number;
  energy_spread?: number;
}

/**
 * lengths and times in M, masses and energies in units of the hole's mass, speeds in c; rates in M per second
 * of real time.
 */
export interface PlaygroundTick {
  /** at least 0. */
  generation: number;
  rate: number;
  rate_reached: number | null;
  paused: boolean;
  slowed: boolean;
  resting: boolean;
  /** at least 0. */
  watchers: number;
  /** at least 0. */
  debris_lost: number;
  fallback_rate: number | null;
  /** at least 0. */
  event: number;
  /** up to 3. */
  angular_momentum: number[];
  t: number | null;
  bodies: number | null;
  energy: number | null;
  energy_balance: number | null;
  radiated: number | null;
  separation: number | null;
  wave_frequency: number | null;
  h_plus: number | null;
  h_cross: number | null;
  debris: number | null;
  debris_back: number | null;
}

export interface Asset {
  /** SHA-256 of the bytes; the name of the asset in a scene. */
  sha256: string;
  /** token that deletes the asset. */
  token?: string;
  type: 'image/png' | 'application/x-npz' | 'application/x-uvfits' | 'text/csv';
  /** at least 0. */
  width?: number;
  /** at least 0. */
  height?: number;
  /** at least 0. */
  bit_depth?: number;
  /** at least 0. */
  channels?: number;
  /** at least 0. */
  bytes: number;
  /** seconds since 1970. */
  created: number;
  /** numbers of nodes in r, theta and phi; up to 3. */
  nodes?: number[];
  /** frames in time, of a series of grids; at least 2. */
  frames?: number;
  /** times of the first and the last frame, in M; up to 2. */
  times?: number[];
  /** spin of the hole that the grid is for. */
  spin?: number;
  /** charge of the hole that the grid is for, in M. */
  charge?: number;
  /** at least 0. */
  visibilities?: number;
  /** at least 0. */
  stations?: number;
}

export interface AssetLimits {
  /** at least 0. */
  assets: number;
  /** at least 0. */
  bytes: number;
  /** at least 0. */
  asset_bytes: number;
  /** at least 0. */
  asset_pixels: number;
}

export interface Assets {
  /** at least 0. */
  assets: number;
  /** at least 0. */
  bytes: number;
  limits: AssetLimits;
  /** SHA-256 of the operator's photograph of the sky, for sky.image; null: there is none. */
  sky: string | null;
  types: string[];
}

export type Precision = 'f32' | 'f64';

export interface DeviceSelftest {
  result: 'passed' | 'failed' | 'not run';
  /** at least 0. */
  checks?: number;
  /** at least 0. */
  failed?: number;
  seconds?: number;
  now?: boolean;
  first_failure?: string;
}

export interface DeviceLimits {
  /** at least 0. */
  heap_bytes: number;
  /** at least 0. */
  memory_bytes: number;
  memory_by: string;
  /** at least 0. */
  binding_bytes: number;
  /** at least 0. */
  allocation_bytes: number;
  /** at least 0. */
  workgroups: number;
  /** at least 0. */
  subgroup_size: number;
}

export interface DeviceFigures {
  basis: 'measured' | 'guess';
  ray_radius: number;
  ray_full: number;
  sample_transfer: number;
  pixel_post: number;
  ray_march: number;
  ray_refined: number;
  ray_stars: number;
  sample_stars: number;
  particle: number;
}

export interface Device {
  kerrd: string;
  name: string;
  type: 'other device' | 'CPU' | 'virtual GPU' | 'integrated GPU' | 'discrete GPU';
  driver: string;
  driver_info: string;
  vulkan: string;
  /** at least 0. */
  index: number;
  choice: string;
  precision: Precision[];
  float64_hardware: boolean;
  timestamps: boolean;
  selftest: DeviceSelftest;
  limits: DeviceLimits;
  ns_per_item: DeviceFigures;
}

export interface Approximation {
  name: string;
  of: string;
  sentence: string;
}

export interface Approximations {
  approximations: Approximation[];
}

export interface PresetTold {
  name: string;
  label: string;
  title: string;
}

export interface Presets {
  presets: PresetTold[];
}

export interface QuantityParameter {
  name: string;
  unit?: string;
  default: string;
  allowed: string;
  help: string;
}

export interface QuantityOutput {
  name: string;
  unit: string;
  help: string;
}

export interface QuantityTold {
  name: string;
  summary: string;
  parameters: QuantityParameter[];
  outputs: QuantityOutput[];
  sources: string[];
  approximations: string[];
}

export interface Quantities {
  quantities: QuantityTold[];
}

export interface PlanPass {
  name:
    | 'trace' | 'interpolate' | 'footprint' | 'audit' | 'particles' | 'stars' | 'transfer' | 'march' | 'march_error'
    | 'refine' | 'layers' | 'light' | 'beam' | 'expose' | 'bloom' | 'post' | 'readback';
  kernel?: string;
  /** at least 0. */
  invocations: number;
  estimate_ms: number;
}

export interface PlanConstants {
  /** at least 0. */
  orders: number;
  /** at least 0. */
  steps: number;
  /** at least 0. */
  samples: number;
  radius_only: boolean;
  phi: boolean;
  sky: boolean;
}

export interface PlanAccuracy {
  engine: 'closed' | 'mino-rkn4' | 'mino-rkn6' | 'ks-euler' | 'ks-rk4' | 'ks-tao6';
  precision: 'f32' | 'f64';
  /** at least 0. */
  steps: number;
  holds?: number;
  table: 'measured' | 'built-in';
}

export interface PlanBytes {
  /** at least 0. */
  lens_map: number;
  /** at least 0. */
  device: number;
  /** at least 0. */
  host: number;
}

export interface Plan {
  /** at least 0. */
  rays: number;
  /** at least 0. */
  critical_pixels: number;
  /** at least 0. */
  critical_rays: number;
  /** at least 0. */
  width: number;
  /** at least 0. */
  height: number;
  /** at least 0. */
  eyes?: number;
  /** at least 0. */
  strips?: number;
  passes: PlanPass[];
  specialisation: PlanConstants;
  accuracy: PlanAccuracy;
  bytes: PlanBytes;
  /** at least 0. */
  bands: number;
  lens_map_cacheable: boolean;
  lens_map_key: string;
  kernels_ms?: number;
  estimate_ms: number;
  estimate_basis: 'measured' | 'guess';
  approximations: string[];
}

export interface SweepBytes {
  /** at least 0. */
  device: number;
  /** at least 0. */
  host: number;
  /** at least 0. */
  files?: number;
}

export interface SweepPlan {
  /** at least 0. */
  scenes: number;
  /** at least 0. */
  lens_maps: number;
  /** at least 0. */
  rays: number;
  bytes: SweepBytes;
  estimate_ms: number;
  shared_ms: number;
  estimate_basis: 'measured' | 'guess';
  axes: Record<string, (number | string | boolean | string[])[]>;
}

export interface AccuracyErrors {
  median?: number;
  p99?: number;
  worst?: number;
}

export interface AccuracyEntry {
  rays_per_s?: number;
  rays_per_s_per_core?: number;
  /** at least 0. */
  rays: number;
  /** at least 0. */
  crossings: number;
  /** at least 0. */
  differ: number;
}

export interface AccuracyRow {
  engine: 'closed' | 'mino-rkn4' | 'mino-rkn6' | 'ks-euler' | 'ks-rk4' | 'ks-tao6';
  precision: 'f32' | 'f64';
  /** at least 0. */
  steps: number;
  holds?: number;
  sets: Record<string, AccuracyEntry>;
}

export interface AccuracyTable {
  /** at least 0. */
  format: number;
  kerrd: string;
  date: string;
  command: string;
  machine: string;
  device: string;
  /** at least 0. */
  cores: number;
  clock: 'device' | 'host';
  quick: boolean;
  seconds?: number;
  skipped: string;
  reference: string;
  /** at least 0. */
  orders: number;
  quantile: number;
  sets: Record<string, string>;
  rows: AccuracyRow[];
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface RayConstants {
  alpha: number;
  beta: number;
  lambda: number;
  eta: number;
  E: number;
  L: number;
  Q: number;
  outward: boolean;
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface RayRadial {
  case: 'I' | 'II' | 'III' | 'IV';
  /** at least 0. */
  real_roots: number;
  roots: number[][];
  horizon_r: number;
  turning_r: number | null;
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface RayPolar {
  case: 'ordinary' | 'vortical' | 'fixed';
  roots: number[];
  theta: number[];
}

export interface PixelGlow {
  name:
    | 'disk' | 'particles' | 'plunge' | 'spots' | 'ringdown' | 'sky' | 'gas' | 'volume' | 'jets' | 'thick' | 'bodies'
    | 'debris' | 'polarization' | 'plasma' | 'stokes' | 'lamp' | 'flash';
  /** up to 3. */
  light: number[];
  /** up to 3. */
  seen: number[];
  luminance: number;
  luminance_seen: number;
  opacity?: number;
  points?: boolean;
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface PixelPictured {
  r: number;
  g: number;
  footprint?: number;
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface PixelCrossing {
  /** at least 0. */
  order: number;
  r: number | null;
  phi: number | null;
  azimuth: number | null;
  delay: number | null;
  g: number | null;
  seen: boolean;
  temperature?: number;
  emission_angle?: number;
  speed?: number | null;
  approach?: number | null;
  evpa?: number | null;
  polarization_fraction?: number | null;
  picture?: PixelPictured;
  through?: number;
  emitters?: PixelGlow[];
  optical_depth?: number | null;
}

export interface PixelVolume {
  name:
    | 'disk' | 'particles' | 'plunge' | 'spots' | 'ringdown' | 'sky' | 'gas' | 'volume' | 'jets' | 'thick' | 'bodies'
    | 'debris' | 'polarization' | 'plasma' | 'stokes' | 'lamp' | 'flash';
  /** up to 3. */
  seen: number[];
  luminance_seen: number;
  optical_depth: number | null;
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface PixelStretch {
  /** at least 0. */
  order: number;
  from_r: number | null;
  from_theta: number;
  from_delay: number | null;
  to_r: number | null;
  to_theta: number;
  to_delay: number | null;
  /** up to 3. */
  seen: number[];
  through: number;
  optical_depth: number | null;
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface PixelAlong {
  names: string[];
  /** at least 0. */
  steps: number;
  /** at least 0. */
  samples: number;
  /** up to 3. */
  seen: number[];
  luminance_seen: number;
  optical_depth: number | null;
  delay: number | null;
  volumes: PixelVolume[];
  stretches?: PixelStretch[];
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface PixelMet {
  name:
    | 'disk' | 'particles' | 'plunge' | 'spots' | 'ringdown' | 'sky' | 'gas' | 'volume' | 'jets' | 'thick' | 'bodies'
    | 'debris' | 'polarization' | 'plasma' | 'stokes' | 'lamp' | 'flash';
  /** at least 0. */
  index: number;
  /** at least 0. */
  order: number;
  r: number;
  theta: number;
  phi: number;
  azimuth: number | null;
  g: number;
  emission_angle: number;
  /** up to 3. */
  light: number[];
  /** up to 3. */
  seen: number[];
  luminance_seen: number;
  through: number;
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface PixelPolarization {
  /** up to 4. */
  stokes: number[];
  evpa: number | null;
  polarization_fraction: number | null;
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface PixelEnd {
  fate: 'captured' | 'escaped' | 'undecided';
  why: string;
  through: number;
  optical_depth: number | null;
  theta?: number | null;
  phi?: number | null;
  azimuth?: number | null;
  g?: number;
  emitters: PixelGlow[];
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface PixelPath {
  /** at least 0. */
  steps: number;
  least_r: number;
  coordinates: 'ingoing' | 'Boyer-Lindquist';
  whole: boolean;
  columns: string[];
  points: ((number | null)[])[];
}

export interface PixelTrace {
  none?: string;
  engine?: 'closed' | 'mino-rkn4' | 'mino-rkn6' | 'ks-euler' | 'ks-rk4' | 'ks-tao6';
  precision?: 'f32' | 'f64';
  /** at least 0. */
  steps_a_half_period?: number;
  fate?: 'captured' | 'escaped' | 'undecided';
  /** at least 0. */
  crossings?: number;
  /** at least 0. */
  not_shown?: number;
  same_without_trace?: boolean;
  columns?: string[];
  steps?: ((number | null | string)[])[];
}

export interface PixelAccuracy {
  engine: 'closed' | 'mino-rkn4' | 'mino-rkn6' | 'ks-euler' | 'ks-rk4' | 'ks-tao6';
  precision: 'f32' | 'f64';
  /** at least 0. */
  steps: number;
  closed_form: number | null;
  picture: number | null;
  path: number | null;
  first_integrals: number | null;
  sum: number | null;
}

export interface PixelColour {
  /** up to 3. */
  shown: number[];
  /** up to 3. */
  pixel: number[];
  /** up to 3. */
  ray: number[];
  exposure: number;
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface PixelRay {
  /** up to 2. */
  ray_at: number[];
  weight: number;
  constants: RayConstants;
  radial: RayRadial;
  polar: RayPolar;
  crossings: PixelCrossing[];
  along?: PixelAlong;
  met?: PixelMet;
  end: PixelEnd;
  polarization?: PixelPolarization;
  /** at least 0. */
  lost: number;
  /** up to 3. */
  light: number[];
  luminance: number;
  closed_form: number | null;
  picture: number | null;
}

/** lengths and times in M, angles in radians; frequencies relative to those that the observer measures. */
export interface Pixel {
  /** up to 2. */
  ray_at: number[];
  weight: number;
  constants: RayConstants;
  radial: RayRadial;
  polar: RayPolar;
  crossings: PixelCrossing[];
  along?: PixelAlong;
  met?: PixelMet;
  end: PixelEnd;
  polarization?: PixelPolarization;
  /** at least 0. */
  lost: number;
  /** up to 2. */
  pixel: number[];
  eye?: 'left' | 'right';
  /** at least 0. */
  rays: number;
  colour: PixelColour;
  path: PixelPath;
  pixel_polarization?: PixelPolarization;
  trace?: PixelTrace;
  accuracy: PixelAccuracy;
  each_ray: PixelRay[];
  approximations: string[];
}

export interface StarImage {
  name: string;
  designation: string;
  magnitude: number;
  x: number;
  y: number;
  x_by_azimuth: number;
  y_by_azimuth: number;
  magnification: number;
  g: number;
  through: number;
  seen_magnitude: number | null;
  mirrored: boolean;
}

export interface Stars {
  /** at least 0. */
  width: number;
  /** at least 0. */
  height: number;
  azimuth_deg: number;
  /** at least 0. */
  found: number;
  images: StarImage[];
}

export interface Share {
  url: string;
  embed?: string;
  code: string;
  other?: string;
  title: string;
  about: string;
  /** Unix time at which the url ends, if the server signed it. */
  expires?: number;
}

export interface OEmbed {
  version: '1.0';
  type: 'photo';
  title: string;
  provider_name: string;
  provider_url: string;
  url: string;
  /** at least 0. */
  width: number;
  /** at least 0. */
  height: number;
}

export type SessionVaries = 'moves_with_time' | 'dims_with_time' | 'moves_with_azimuth';

export interface EmitterTold {
  name: string;
  title: string;
  at: string;
  apart: boolean;
  sentence?: string;
}

/** times in seconds. */
export interface SessionPath {
  at: number;
  end: number;
}

/** times in seconds. */
export interface SessionRendering {
  fraction: number;
  remaining_s: number | null;
}

/** times in seconds. */
export interface SessionRefining {
  fraction: number;
  remaining_s: number | null;
}

/** in M, and in seconds where a name ends in _s. */
export interface FallClock {
  proper_time_to_horizon: number | null;
  proper_time_to_end: number;
  proper_time_to_horizon_s: number | null;
  proper_time_to_end_s: number;
}

export interface Session {
  id: string;
  token?: string;
  /** at least 0. */
  revision: number;
  /** at least 0. */
  frame: number;
  /** at least 0. */
  viewers: number;
  scene: Scene;
  varies: SessionVaries[];
  emitters: EmitterTold[];
  path?: SessionPath;
  rendering?: SessionRendering;
  refining?: SessionRefining;
  clock?: FallClock;
  /** at least 0. */
  order?: number;
}

export interface SessionPatched {
  /** at least 0. */
  revision: number;
  /** at least 0. */
  order?: number;
}

export interface LessonQuestion {
  /** at least 0. */
  number: number;
  text: string;
  choices: string[];
  open: boolean;
  /** at least 0. */
  answered: number;
  /** 0 to 5. */
  right?: number | null;
  tally?: number[];
}

export interface LessonHand {
  name: string;
  /** 0 to 5. */
  choice: number | null;
}

export interface Lesson {
  id: string;
  token?: string;
  session: string;
  link: string;
  about: string;
  lang: string;
  /** at least 0. */
  pupils: number;
  question: null | LessonQuestion;
  /** 0 to 5. */
  choice?: number | null;
  copies?: boolean;
  hands?: LessonHand[];
}

export interface NewLesson {
  session: string;
  link?: string;
  about?: string;
  /** language of about and question. */
  lang?: string;
  /** whether the question accepts answers. */
  open?: boolean;
  question?: {
    text: string;
    /** up to 6. */
    choices: string[];
    /** 0 to 5. */
    right?: number | null;
  } | null;
}

export interface LessonChange {
  session?: string;
  link?: string;
  about?: string;
  /** language of about and question. */
  lang?: string;
  /** whether the question accepts answers. */
  open?: boolean;
  question?: {
    text: string;
    /** up to 6. */
    choices: string[];
    /** 0 to 5. */
    right?: number | null;
  } | null;
}

export type SweepAxes = Record<string, (number | string | boolean | string[])[] | string>;

/** created and ended are seconds since 1970. */
export interface Job {
  id: string;
  token?: string;
  state: 'waiting' | 'running' | 'done' | 'failed' | 'deleted';
  output: 'pictures' | 'layers' | 'npy' | 'npz' | 'fits' | 'exr' | 'cube' | 'light-curve';
  /** at least 0. */
  place: number;
  /** at least 0. */
  frames: number;
  /** at least 0. */
  finished: number;
  fraction: number;
  remaining_s: number | null;
  /** at least 0. */
  bytes: number;
  /** at least 0. */
  lens_maps_traced: number;
  exposure?: number;
  axes?: Record<string, number>;
  created: number;
  ended: number | null;
  delayed?: string;
  error?: string;
}

export interface Problem {
  type:
    | 'urn:kerrd:problem:bad-request' | 'urn:kerrd:problem:malformed-json' | 'urn:kerrd:problem:unauthorized'
    | 'urn:kerrd:problem:role' | 'urn:kerrd:problem:link' | 'urn:kerrd:problem:cross-site'
    | 'urn:kerrd:problem:forbidden' | 'urn:kerrd:problem:not-found' | 'urn:kerrd:problem:method-not-allowed'
    | 'urn:kerrd:problem:not-acceptable' | 'urn:kerrd:problem:not-ready' | 'urn:kerrd:problem:conflict'
    | 'urn:kerrd:problem:timeout' | 'urn:kerrd:problem:precondition-failed' | 'urn:kerrd:problem:body-too-large'
    | 'urn:kerrd:problem:uri-too-long' | 'urn:kerrd:problem:unsupported-media-type' | 'urn:kerrd:problem:misdirected'
    | 'urn:kerrd:problem:range-not-satisfiable' | 'urn:kerrd:problem:invalid-scene' | 'urn:kerrd:problem:invalid-rays'
    | 'urn:kerrd:problem:invalid-parameters' | 'urn:kerrd:problem:invalid-orbit' | 'urn:kerrd:problem:invalid-job'
    | 'urn:kerrd:problem:invalid-playground' | 'urn:kerrd:problem:invalid-asset' | 'urn:kerrd:problem:too-large'
    | 'urn:kerrd:problem:idempotency-key-reused' | 'urn:kerrd:problem:quota' | 'urn:kerrd:problem:wrong-tokens'
    | 'urn:kerrd:problem:header-too-large' | 'urn:kerrd:problem:internal' | 'urn:kerrd:problem:device-lost'
    | 'urn:kerrd:problem:not-installed' | 'urn:kerrd:problem:out-of-memory' | 'urn:kerrd:problem:queue-full'
    | 'urn:kerrd:problem:links-full' | 'urn:kerrd:problem:too-many-connections' | 'urn:kerrd:problem:stopping'
    | 'urn:kerrd:problem:disk-full' | 'urn:kerrd:problem:assets-full' | 'urn:kerrd:problem:http-version';
  title: string;
  /** 400 to 599. */
  status: number;
  detail: string;
  /** JSON pointer into the request (RFC 6901). */
  pointer?: string;
  /** accepted media types. */
  offered?: string;
  /** as in the header X-Request-Id. */
  request_id?: string;
}

/** A scene in a query, by dotted paths. */
export interface SceneQuery {
  /** version of this document format. */
  version?: 1;
  /**
   * spin parameter a; a < 0: the disk is retrograde to its hole; in M; -0.999999999999 to 0.999999999999; default
   * 0.7.
   */
  'spacetime.spin'?: number;
  /**
   * electric charge Q of the hole (Kerr-Newman), which acts on space-time alone: light and matter are neutral; in
   * M; 0 to 0.999999999999; default 0.
   */
  'spacetime.charge'?: number;
  /**
   * mass of the hole; sets the temperature when disk.colour is "accretion"; in solar masses; 0.001 to 1e+12;
   * default 100000000.
   */
  'spacetime.mass_msun'?: number;
  /**
   * angular diameter distance of the hole; with the mass it determines the width of a picture on the sky, for a
   * beam and a scale bar; in pc; 0.001 to 100000000000; default 260000.
   */
  'spacetime.distance_pc'?: number;
  /** Boyer-Lindquist radius of the observer; in M; 0.01 to 10000000; default "infinity". */
  'camera.r'?: 'infinity' | number;
  /**
   * polar angle of the observer: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to 180;
   * default 82.
   */
  'camera.inclination_deg'?: number;
  /**
   * Boyer-Lindquist azimuth of the observer; for a falling observer the ingoing Kerr-Schild azimuth, which is the
   * same far away; in degrees; -360 to 360; default 0.
   */
  'camera.azimuth_deg'?: number;
  /**
   * state of motion at a finite radius; static: at rest with respect to infinity; zamo: with zero angular
   * momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude; retrograde: on
   * a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free fall, by default
   * from rest at infinity; velocity: with any velocity relative to the observer of zero angular momentum; default
   * "static".
   */
  'camera.observer'?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
  /**
   * outward velocity in the frame of the local observer of zero angular momentum (observer: velocity); in c; -1
   * to 1; default 0.
   */
  'camera.velocity_r'?: number;
  /**
   * velocity away from the north pole, in the frame of the local observer of zero angular momentum (observer:
   * velocity); in c; -1 to 1; default 0.
   */
  'camera.velocity_theta'?: number;
  /**
   * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (observer:
   * velocity); in c; -1 to 1; default 0.
   */
  'camera.velocity_phi'?: number;
  /**
   * radius at which the observer's fall begins, at rest except for its angular momentum (observer: infall); in M;
   * 1 to 10000000; default "infinity".
   */
  'camera.infall_from'?: 'infinity' | number;
  /**
   * energy per mass of the falling observer; rest: the energy that follows from infall_from (observer: infall);
   * -100 to 1000; default "rest".
   */
  'camera.infall_energy'?: 'rest' | number;
  /**
   * angular momentum per mass of the falling observer, which moves in r and azimuth but not in latitude
   * (observer: infall); in M; -10000 to 10000; default 0.
   */
  'camera.infall_momentum'?: number;
  /**
   * plane: parallel rays, image plane in M, at infinity only; pinhole: at a finite radius only; ring: the angle
   * round the critical curve across, the logarithm of the distance to it upwards, at infinity only;
   * equirectangular: all directions from a finite radius, longitude to the right and latitude upwards; fulldome:
   * the angle from the middle as distance, 90 degrees at the nearer edges, from a finite radius; auto: plane at
   * infinity, otherwise pinhole; default "auto".
   */
  'camera.projection'?: 'auto' | 'plane' | 'pinhole' | 'ring' | 'equirectangular' | 'fulldome';
  /** width of the image plane (plane projection); in M; 1e-06 to 10000000; default 46. */
  'camera.field_m'?: number;
  /**
   * width of the image plane on the sky, at spacetime.mass_msun and spacetime.distance_pc; it sets
   * camera.field_m; none: camera.field_m is used; in microarcseconds; 1e-12 to 1e+12; default "none".
   */
  'camera.field_uas'?: 'none' | number;
  /** horizontal field of view (pinhole projection); in degrees; 1e-06 to 179; default 50. */
  'camera.fov_deg'?: number;
  /** image-plane alpha at the middle of the picture (plane); in M; -10000000 to 10000000; default 0. */
  'camera.centre_alpha'?: number;
  /** image-plane beta at the middle of the picture (plane); in M; -10000000 to 10000000; default 0. */
  'camera.centre_beta'?: number;
  /** look to the right of the hole (from a finite radius); in degrees; -180 to 180; default 0. */
  'camera.yaw_deg'?: number;
  /** look above the hole (from a finite radius); in degrees; -90 to 90; default 0. */
  'camera.pitch_deg'?: number;
  /**
   * turn the camera clockwise about its axis; ring: the angle in the middle of the picture, 0 at alpha > 0,
   * rising to the right; in degrees; -360 to 360; default 0.
   */
  'camera.roll_deg'?: number;
  /**
   * pair: two pictures side by side, the left eye's on the left, each image.width wide and in pinhole projection;
   * none: one eye; default "none".
   */
  'camera.stereo'?: 'none' | 'pair';
  /**
   * distance between the eyes, perpendicular to the viewing direction (stereo: pair); in M; 1e-06 to 1000000;
   * default 0.5.
   */
  'camera.eye_distance'?: number;
  /**
   * log10 of the distance between the critical curve and the picture's upper and lower edges, in units of the
   * curve's radius (ring); in decades; -12 to 0; default 0.
   */
  'camera.ring_decades_max'?: number;
  /**
   * log10 of the distance to the critical curve at the picture's middle line; rays above the line pass outside
   * the curve, rays below it inside (ring); in decades; -13 to -1; default -10.
   */
  'camera.ring_decades_min'?: number;
  /**
   * radial flux: none; the exact Page-Thorne integral; the Newtonian thin disk cut at the ISCO; or particles: the
   * exact flux, as orbiting particles; default "novikov-thorne".
   */
  'disk.model'?: 'none' | 'novikov-thorne' | 'shakura-sunyaev' | 'particles';
  /** inner edge; at least the ISCO; in M; 1 to 1000000; default "isco". */
  'disk.inner'?: 'isco' | number;
  /** outer edge; larger than the inner one; in M; 1 to 1000000; default 22. */
  'disk.outer'?: number;
  /** outer fraction of the radius over which the disk fades out; 0: a sharp edge; 0 to 1; default 0.7. */
  'disk.taper'?: number;
  /** opacity of one crossing; 1 is optically thick; 0 to 1; default 1. */
  'disk.opacity'?: number;
  /**
   * optical depth along the normal where the disk is brightest; elsewhere it is proportional to the flux. A
   * crossing has the opacity 1 - exp(-depth/cos) times disk.opacity, with the angle of emission in the gas's
   * frame; 0: the same opacity everywhere; 0 to 1000000; default 10.
   */
  'disk.emission_opacity'?: number;
  /**
   * relative half height H/R at R = 10 M: H is the height above the plane at which the density has fallen to
   * exp(-1/2), R the distance from the axis; the optical depth from top to bottom is that of the thin disk; 0: a
   * thin disk; 0 to 0.5; default 0.
   */
  'disk.height'?: number;
  /** exponent p: H/R is proportional to R^p (disk.height); -0.5 to 0.5; default 0. */
  'disk.flare'?: number;
  /**
   * temperature scale: a chosen peak temperature, or from spacetime.mass_msun and disk.mdot_edd; default "peak".
   */
  'disk.colour'?: 'peak' | 'accretion';
  /**
   * largest effective temperature of the disk, in its own frame (colour: peak); in K; 300 to 1000000000; default
   * 3600.
   */
  'disk.peak_temperature_k'?: number;
  /**
   * accretion rate: luminosity over the Eddington luminosity, with the efficiency for this spin; in Eddington
   * rates; 1e-12 to 1000; default 0.1.
   */
  'disk.mdot_edd'?: number;
  /** colour temperature over effective temperature; 1 to 3; default 1. */
  'disk.hardening'?: number;
  /**
   * how the light of the thin disk's surface depends on mu, the cosine of the angle to its normal in the gas's
   * frame. isotropic; laor: as 1 + 2.06 mu; scattering: as from a deep atmosphere of free electrons, which
   * polarization.model "scattering" polarises. Each law has the disk's flux; default "isotropic".
   */
  'disk.atmosphere'?: 'isotropic' | 'laor' | 'scattering';
  /**
   * light that the hole bends back to the disk. none: it is ignored; thermalised: the disk absorbs it with its
   * angular momentum, and radiates it again as a black body; reflected: the disk reflects the share disk.albedo
   * with the spectrum of the arriving light, and thermalises the rest. Light may return any number of times;
   * default "none".
   */
  'disk.returning'?: 'none' | 'thermalised' | 'reflected';
  /** share of the returning light that is reflected; 0 to 1; default 0.5. */
  'disk.albedo'?: number;
  /**
   * brightness: bolometric, g^4 F; visible, the luminance that the eye perceives of the Planck spectrum; or
   * frequency, the specific intensity at disk.frequency_ghz, in physical units; default "bolometric".
   */
  'disk.band'?: 'bolometric' | 'visible' | 'frequency';
  /** observed frequency (band: frequency); in GHz; 1e-06 to 1e+12; default 230. */
  'disk.frequency_ghz'?: number;
  /** include the Doppler shift and beaming of the orbiting gas; default true. */
  'disk.doppler'?: boolean;
  /** include the gravitational redshift and time dilation of the orbiting gas; default true. */
  'disk.redshift'?: boolean;
  /** number of particles (model: particles); 1000 to 10000000; default 300000. */
  'disk.particles'?: number;
  /** seed of the random numbers that place the particles (model: particles); 0 to 2147483647; default 1. */
  'disk.seed'?: number;
  /**
   * p: the number of particles per area is proportional to r^-p; for p = 2 every octave of r has the same number
   * (model: particles); 0 to 4; default 2.
   */
  'disk.density_index'?: number;
  /**
   * share of the particles that fall from the ISCO, with its energy and angular momentum; none fall unless
   * disk.inner is "isco" (model: particles); 0 to 0.5; default 0.02.
   */
  'disk.plunging'?: number;
  /**
   * temperature of the plunging gas over the disk's largest temperature; 0: it is invisible (model: particles); 0
   * to 1; default 0.7.
   */
  'disk.plunging_temperature'?: number;
  /**
   * largest amplitude of oscillations in latitude, in radians; times (kappa/Omega)^2, which vanishes at the ISCO,
   * also the largest relative amplitude of oscillations in r (model: particles); 0 to 0.2; default 0.02.
   */
  'disk.epicycles'?: number;
  /**
   * show particles, gas, spots and a flash at the time when the light of each ray left them, instead of at one
   * coordinate time; default false.
   */
  'disk.slow_light'?: boolean;
  /**
   * turbulence: standard deviation of the logarithm of the flux, and of the optical depth; 0: a smooth disk; 0 to
   * 3; default 0.8.
   */
  'disk.gas.amplitude'?: number;
  /** number of scales of the turbulence; each scale is about half the one before; 1 to 8; default 6. */
  'disk.gas.octaves'?: number;
  /** size of the largest eddies over r, before shear stretches them; 0.02 to 2; default 0.4. */
  'disk.gas.scale'?: number;
  /**
   * azimuth by which streaks trail, in radians for each unit of ln r; below 0 they lead. Streaks are 1 + shear^2
   * times as long as they are wide; -20 to 20; default 5.
   */
  'disk.gas.shear'?: number;
  /** seed of the random numbers of the turbulence; 0 to 2147483647; default 1. */
  'disk.gas.seed'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.0.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.0.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.0.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.0.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.0.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.0.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.1.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.1.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.1.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.1.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.1.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.1.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.2.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.2.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.2.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.2.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.2.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.2.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.3.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.3.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.3.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.3.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.3.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.3.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.4.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.4.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.4.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.4.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.4.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.4.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.5.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.5.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.5.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.5.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.5.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.5.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.6.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.6.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.6.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.6.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.6.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.6.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.7.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.7.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.7.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.7.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.7.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.7.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.8.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.8.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.8.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.8.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.8.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.8.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.9.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.9.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.9.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.9.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.9.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.9.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.10.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.10.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.10.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.10.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.10.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.10.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.11.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.11.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.11.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.11.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.11.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.11.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.12.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.12.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.12.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.12.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.12.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.12.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.13.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.13.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.13.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.13.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.13.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.13.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.14.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.14.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.14.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.14.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.14.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.14.temperature_k'?: number;
  /**
   * surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0
   * to 1000000; default 0.
   */
  'spots.15.brightness'?: number;
  /** radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9. */
  'spots.15.r'?: number;
  /** azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0. */
  'spots.15.phase_deg'?: number;
  /**
   * distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000;
   * default 1.
   */
  'spots.15.size'?: number;
  /**
   * spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
   * index); -4 to 6; default 1.
   */
  'spots.15.index'?: number;
  /** colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000. */
  'spots.15.temperature_k'?: number;
  /**
   * surface brightness in the gas's frame where the flash lights the disk most, at its peak, in units of the
   * disk's brightest; 0: no flash; 0 to 1000000; default 0.
   */
  'flash.brightness'?: number;
  /**
   * Boyer-Lindquist radius of the lamp on the axis; at least 1.05 times that of the horizon; in M; 1 to 10000;
   * default 10.
   */
  'flash.height'?: number;
  /** coordinate time at which the lamp is brightest; in M; -1e+12 to 1e+12; default 0. */
  'flash.start'?: number;
  /**
   * time before and after the peak at which the lamp's light is exp(-1/2) of the peak; in M; 0.001 to 1000000;
   * default 1.
   */
  'flash.duration'?: number;
  /**
   * time from one flash to the next, at least 12 times flash.duration; 0: one flash only; in M; 0 to 1000000000;
   * default 0.
   */
  'flash.period'?: number;
  /**
   * photon index Gamma of the lamp: it emits E^-Gamma photons per energy, which sets how its light on the disk
   * depends on the shift from the lamp to the gas; 1 to 4; default 2.
   */
  'flash.photon_index'?: number;
  /**
   * spectral index of the lit gas: I_nu falls as nu to this power, so that the observed brightness is multiplied
   * by g^(3 + index); -4 to 6; default 0.
   */
  'flash.index'?: number;
  /**
   * colour of the lit gas: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000;
   * default 6500.
   */
  'flash.temperature_k'?: number;
  /** radius of the sphere in its own frame; 0: no body; in M; 0 to 1000000; default 0. */
  'bodies.0.radius'?: number;
  /**
   * Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon; in M; 1 to 10000000;
   * default 15.
   */
  'bodies.0.r'?: number;
  /**
   * polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to
   * 180; default 90.
   */
  'bodies.0.inclination_deg'?: number;
  /**
   * azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0; in degrees; -360 to 360; default
   * 0.
   */
  'bodies.0.phase_deg'?: number;
  /**
   * state of motion, which shifts the body's light; static, zamo, keplerian and retrograde move it round with
   * time, the last two only in the disk's plane; static: at rest with respect to infinity; zamo: with zero
   * angular momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude;
   * retrograde: on a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free
   * fall, by default from rest at infinity; velocity: with any velocity relative to the observer of zero angular
   * momentum; default "keplerian".
   */
  'bodies.0.motion'?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
  /**
   * outward velocity in the frame of the local observer of zero angular momentum (motion: velocity); in c; -1 to
   * 1; default 0.
   */
  'bodies.0.velocity_r'?: number;
  /**
   * velocity away from the north pole, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.0.velocity_theta'?: number;
  /**
   * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.0.velocity_phi'?: number;
  /**
   * temperature of the body, which shines as a black body shifted by g; in K; 300 to 1000000000; default 6000.
   */
  'bodies.0.temperature_k'?: number;
  /**
   * surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark; 0 to
   * 1000000000; default 1.
   */
  'bodies.0.brightness'?: number;
  /**
   * fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none; 0 to 1;
   * default 0.6.
   */
  'bodies.0.limb_darkening'?: number;
  /** radius of the sphere in its own frame; 0: no body; in M; 0 to 1000000; default 0. */
  'bodies.1.radius'?: number;
  /**
   * Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon; in M; 1 to 10000000;
   * default 15.
   */
  'bodies.1.r'?: number;
  /**
   * polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to
   * 180; default 90.
   */
  'bodies.1.inclination_deg'?: number;
  /**
   * azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0; in degrees; -360 to 360; default
   * 0.
   */
  'bodies.1.phase_deg'?: number;
  /**
   * state of motion, which shifts the body's light; static, zamo, keplerian and retrograde move it round with
   * time, the last two only in the disk's plane; static: at rest with respect to infinity; zamo: with zero
   * angular momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude;
   * retrograde: on a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free
   * fall, by default from rest at infinity; velocity: with any velocity relative to the observer of zero angular
   * momentum; default "keplerian".
   */
  'bodies.1.motion'?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
  /**
   * outward velocity in the frame of the local observer of zero angular momentum (motion: velocity); in c; -1 to
   * 1; default 0.
   */
  'bodies.1.velocity_r'?: number;
  /**
   * velocity away from the north pole, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.1.velocity_theta'?: number;
  /**
   * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.1.velocity_phi'?: number;
  /**
   * temperature of the body, which shines as a black body shifted by g; in K; 300 to 1000000000; default 6000.
   */
  'bodies.1.temperature_k'?: number;
  /**
   * surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark; 0 to
   * 1000000000; default 1.
   */
  'bodies.1.brightness'?: number;
  /**
   * fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none; 0 to 1;
   * default 0.6.
   */
  'bodies.1.limb_darkening'?: number;
  /** radius of the sphere in its own frame; 0: no body; in M; 0 to 1000000; default 0. */
  'bodies.2.radius'?: number;
  /**
   * Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon; in M; 1 to 10000000;
   * default 15.
   */
  'bodies.2.r'?: number;
  /**
   * polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to
   * 180; default 90.
   */
  'bodies.2.inclination_deg'?: number;
  /**
   * azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0; in degrees; -360 to 360; default
   * 0.
   */
  'bodies.2.phase_deg'?: number;
  /**
   * state of motion, which shifts the body's light; static, zamo, keplerian and retrograde move it round with
   * time, the last two only in the disk's plane; static: at rest with respect to infinity; zamo: with zero
   * angular momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude;
   * retrograde: on a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free
   * fall, by default from rest at infinity; velocity: with any velocity relative to the observer of zero angular
   * momentum; default "keplerian".
   */
  'bodies.2.motion'?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
  /**
   * outward velocity in the frame of the local observer of zero angular momentum (motion: velocity); in c; -1 to
   * 1; default 0.
   */
  'bodies.2.velocity_r'?: number;
  /**
   * velocity away from the north pole, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.2.velocity_theta'?: number;
  /**
   * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.2.velocity_phi'?: number;
  /**
   * temperature of the body, which shines as a black body shifted by g; in K; 300 to 1000000000; default 6000.
   */
  'bodies.2.temperature_k'?: number;
  /**
   * surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark; 0 to
   * 1000000000; default 1.
   */
  'bodies.2.brightness'?: number;
  /**
   * fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none; 0 to 1;
   * default 0.6.
   */
  'bodies.2.limb_darkening'?: number;
  /** radius of the sphere in its own frame; 0: no body; in M; 0 to 1000000; default 0. */
  'bodies.3.radius'?: number;
  /**
   * Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon; in M; 1 to 10000000;
   * default 15.
   */
  'bodies.3.r'?: number;
  /**
   * polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to
   * 180; default 90.
   */
  'bodies.3.inclination_deg'?: number;
  /**
   * azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0; in degrees; -360 to 360; default
   * 0.
   */
  'bodies.3.phase_deg'?: number;
  /**
   * state of motion, which shifts the body's light; static, zamo, keplerian and retrograde move it round with
   * time, the last two only in the disk's plane; static: at rest with respect to infinity; zamo: with zero
   * angular momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude;
   * retrograde: on a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free
   * fall, by default from rest at infinity; velocity: with any velocity relative to the observer of zero angular
   * momentum; default "keplerian".
   */
  'bodies.3.motion'?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
  /**
   * outward velocity in the frame of the local observer of zero angular momentum (motion: velocity); in c; -1 to
   * 1; default 0.
   */
  'bodies.3.velocity_r'?: number;
  /**
   * velocity away from the north pole, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.3.velocity_theta'?: number;
  /**
   * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.3.velocity_phi'?: number;
  /**
   * temperature of the body, which shines as a black body shifted by g; in K; 300 to 1000000000; default 6000.
   */
  'bodies.3.temperature_k'?: number;
  /**
   * surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark; 0 to
   * 1000000000; default 1.
   */
  'bodies.3.brightness'?: number;
  /**
   * fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none; 0 to 1;
   * default 0.6.
   */
  'bodies.3.limb_darkening'?: number;
  /** radius of the sphere in its own frame; 0: no body; in M; 0 to 1000000; default 0. */
  'bodies.4.radius'?: number;
  /**
   * Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon; in M; 1 to 10000000;
   * default 15.
   */
  'bodies.4.r'?: number;
  /**
   * polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to
   * 180; default 90.
   */
  'bodies.4.inclination_deg'?: number;
  /**
   * azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0; in degrees; -360 to 360; default
   * 0.
   */
  'bodies.4.phase_deg'?: number;
  /**
   * state of motion, which shifts the body's light; static, zamo, keplerian and retrograde move it round with
   * time, the last two only in the disk's plane; static: at rest with respect to infinity; zamo: with zero
   * angular momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude;
   * retrograde: on a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free
   * fall, by default from rest at infinity; velocity: with any velocity relative to the observer of zero angular
   * momentum; default "keplerian".
   */
  'bodies.4.motion'?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
  /**
   * outward velocity in the frame of the local observer of zero angular momentum (motion: velocity); in c; -1 to
   * 1; default 0.
   */
  'bodies.4.velocity_r'?: number;
  /**
   * velocity away from the north pole, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.4.velocity_theta'?: number;
  /**
   * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.4.velocity_phi'?: number;
  /**
   * temperature of the body, which shines as a black body shifted by g; in K; 300 to 1000000000; default 6000.
   */
  'bodies.4.temperature_k'?: number;
  /**
   * surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark; 0 to
   * 1000000000; default 1.
   */
  'bodies.4.brightness'?: number;
  /**
   * fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none; 0 to 1;
   * default 0.6.
   */
  'bodies.4.limb_darkening'?: number;
  /** radius of the sphere in its own frame; 0: no body; in M; 0 to 1000000; default 0. */
  'bodies.5.radius'?: number;
  /**
   * Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon; in M; 1 to 10000000;
   * default 15.
   */
  'bodies.5.r'?: number;
  /**
   * polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to
   * 180; default 90.
   */
  'bodies.5.inclination_deg'?: number;
  /**
   * azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0; in degrees; -360 to 360; default
   * 0.
   */
  'bodies.5.phase_deg'?: number;
  /**
   * state of motion, which shifts the body's light; static, zamo, keplerian and retrograde move it round with
   * time, the last two only in the disk's plane; static: at rest with respect to infinity; zamo: with zero
   * angular momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude;
   * retrograde: on a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free
   * fall, by default from rest at infinity; velocity: with any velocity relative to the observer of zero angular
   * momentum; default "keplerian".
   */
  'bodies.5.motion'?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
  /**
   * outward velocity in the frame of the local observer of zero angular momentum (motion: velocity); in c; -1 to
   * 1; default 0.
   */
  'bodies.5.velocity_r'?: number;
  /**
   * velocity away from the north pole, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.5.velocity_theta'?: number;
  /**
   * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.5.velocity_phi'?: number;
  /**
   * temperature of the body, which shines as a black body shifted by g; in K; 300 to 1000000000; default 6000.
   */
  'bodies.5.temperature_k'?: number;
  /**
   * surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark; 0 to
   * 1000000000; default 1.
   */
  'bodies.5.brightness'?: number;
  /**
   * fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none; 0 to 1;
   * default 0.6.
   */
  'bodies.5.limb_darkening'?: number;
  /** radius of the sphere in its own frame; 0: no body; in M; 0 to 1000000; default 0. */
  'bodies.6.radius'?: number;
  /**
   * Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon; in M; 1 to 10000000;
   * default 15.
   */
  'bodies.6.r'?: number;
  /**
   * polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to
   * 180; default 90.
   */
  'bodies.6.inclination_deg'?: number;
  /**
   * azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0; in degrees; -360 to 360; default
   * 0.
   */
  'bodies.6.phase_deg'?: number;
  /**
   * state of motion, which shifts the body's light; static, zamo, keplerian and retrograde move it round with
   * time, the last two only in the disk's plane; static: at rest with respect to infinity; zamo: with zero
   * angular momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude;
   * retrograde: on a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free
   * fall, by default from rest at infinity; velocity: with any velocity relative to the observer of zero angular
   * momentum; default "keplerian".
   */
  'bodies.6.motion'?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
  /**
   * outward velocity in the frame of the local observer of zero angular momentum (motion: velocity); in c; -1 to
   * 1; default 0.
   */
  'bodies.6.velocity_r'?: number;
  /**
   * velocity away from the north pole, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.6.velocity_theta'?: number;
  /**
   * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.6.velocity_phi'?: number;
  /**
   * temperature of the body, which shines as a black body shifted by g; in K; 300 to 1000000000; default 6000.
   */
  'bodies.6.temperature_k'?: number;
  /**
   * surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark; 0 to
   * 1000000000; default 1.
   */
  'bodies.6.brightness'?: number;
  /**
   * fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none; 0 to 1;
   * default 0.6.
   */
  'bodies.6.limb_darkening'?: number;
  /** radius of the sphere in its own frame; 0: no body; in M; 0 to 1000000; default 0. */
  'bodies.7.radius'?: number;
  /**
   * Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon; in M; 1 to 10000000;
   * default 15.
   */
  'bodies.7.r'?: number;
  /**
   * polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to
   * 180; default 90.
   */
  'bodies.7.inclination_deg'?: number;
  /**
   * azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0; in degrees; -360 to 360; default
   * 0.
   */
  'bodies.7.phase_deg'?: number;
  /**
   * state of motion, which shifts the body's light; static, zamo, keplerian and retrograde move it round with
   * time, the last two only in the disk's plane; static: at rest with respect to infinity; zamo: with zero
   * angular momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude;
   * retrograde: on a circular orbit towards -phi, against the disk, at its highest latitude; infall: in free
   * fall, by default from rest at infinity; velocity: with any velocity relative to the observer of zero angular
   * momentum; default "keplerian".
   */
  'bodies.7.motion'?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
  /**
   * outward velocity in the frame of the local observer of zero angular momentum (motion: velocity); in c; -1 to
   * 1; default 0.
   */
  'bodies.7.velocity_r'?: number;
  /**
   * velocity away from the north pole, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.7.velocity_theta'?: number;
  /**
   * velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (motion:
   * velocity); in c; -1 to 1; default 0.
   */
  'bodies.7.velocity_phi'?: number;
  /**
   * temperature of the body, which shines as a black body shifted by g; in K; 300 to 1000000000; default 6000.
   */
  'bodies.7.temperature_k'?: number;
  /**
   * surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark; 0 to
   * 1000000000; default 1.
   */
  'bodies.7.brightness'?: number;
  /**
   * fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none; 0 to 1;
   * default 0.6.
   */
  'bodies.7.limb_darkening'?: number;
  /**
   * matter along the rays. none; uniform: a homogeneous shell at rest. At one radio frequency: gold, the analytic
   * model of Gold et al. 2020; riaf, a hot, thin flow whose density, temperature and magnetic field are powers of
   * r; torus, a thick disk in equilibrium; grid, numbers from a file; default "none".
   */
  'volume.model'?: 'none' | 'uniform' | 'gold' | 'riaf' | 'torus' | 'grid';
  /**
   * inner edge; horizon: 1 % outside the horizon, or 0.05 % for the models at a radio frequency; for a torus,
   * half of volume.torus_radius; in M; 1 to 30000; default "horizon".
   */
  'volume.inner'?: 'horizon' | number;
  /** outer edge of the matter; larger than the inner edge; in M; 1 to 30000; default 20. */
  'volume.outer'?: number;
  /**
   * light emitted along 1 M in the matter's frame, in units of the disk's brightest (model: uniform); in 1/M; 0
   * to 1e+30; default 0.02.
   */
  'volume.emissivity'?: number;
  /** optical depth of 1 M in the matter's frame (model: uniform); in 1/M; 0 to 1e+30; default 0.02. */
  'volume.opacity'?: number;
  /**
   * colour: that of a black body of this temperature, shifted by g (model: uniform); in K; 300 to 1000000000;
   * default 6500.
   */
  'volume.temperature_k'?: number;
  /** include the frequency shift of the matter (model: uniform); default true. */
  'volume.redshift'?: boolean;
  /** observed frequency (models: gold, riaf, torus, grid); in GHz; 1e-06 to 1e+12; default 230. */
  'volume.frequency_ghz'?: number;
  /**
   * NPZ file with density, temperature, velocity and magnetic field of the electrons on a grid of r, theta and
   * phi (model: grid); without it there is no matter; default null.
   */
  'volume.grid'?: null | string;
  /**
   * factor on the file's density; the magnetic field is multiplied by the square root of it (model: grid); 0 to
   * 1e+30; default 1.
   */
  'volume.grid_scale'?: number;
  /**
   * show each place of a grid with several frames at the time when its light left it, instead of the whole grid
   * at `time` (model: grid); default false.
   */
  'volume.slow_light'?: boolean;
  /**
   * C n0: emissivity at 230 GHz at the largest density (model: gold); in erg/(s cm^3 Hz sr); 0 to 1e+30; default
   * 3e-18.
   */
  'volume.gold_emission'?: number;
  /**
   * alpha: emissivity goes as nu^-alpha, absorptivity as nu^-(2.5 + alpha) (model: gold); -10 to 10; default 0.
   */
  'volume.gold_index'?: number;
  /** h: density goes as exp(-(h cos(theta))^2/2); 0: round (model: gold); 0 to 10000; default 0. */
  'volume.gold_flattening'?: number;
  /**
   * l0: angular momentum over energy is l0 R^(3/2)/(1 + R) with R = r sin(theta); 0: zero angular momentum
   * (model: gold); -1 to 1; default 0.
   */
  'volume.gold_momentum'?: number;
  /**
   * A: absorptivity in 1/cm over emissivity in erg/(s cm^3 Hz sr), at 230 GHz (model: gold); 0 to 1e+30; default
   * 0.
   */
  'volume.gold_absorption'?: number;
  /**
   * electron density: at r = 1 M in the equatorial plane, by its power law (model: riaf); its maximum (model:
   * torus); in 1/cm^3; 0 to 1e+30; default 30000000.
   */
  'volume.density_cm3'?: number;
  /** p: density is proportional to r^-p (model: riaf); -10 to 10; default 1.1. */
  'volume.density_index'?: number;
  /** electron temperature at r = 1 M (model: riaf); in K; 1 to 1e+30; default 300000000000. */
  'volume.electron_temperature_k'?: number;
  /** p: electron temperature is proportional to r^-p (model: riaf); -10 to 10; default 0.84. */
  'volume.temperature_index'?: number;
  /**
   * height over the distance from the axis at which the density has fallen to exp(-1/2); 0: the density does not
   * depend on height (model: riaf); 0 to 10; default 0.1.
   */
  'volume.height'?: number;
  /**
   * magnetic pressure over the rest energy of a proton per electron, at r = 1 M (model: riaf); 0 to 1e+12;
   * default 0.016666666666666666.
   */
  'volume.magnetisation'?: number;
  /** p: magnetisation is proportional to r^-p (model: riaf); -10 to 10; default 1. */
  'volume.magnetisation_index'?: number;
  /**
   * direction of the magnetic field: round the axis, along it, or radial; its part along the motion is removed
   * (models: riaf, torus); default "toroidal".
   */
  'volume.field'?: 'toroidal' | 'vertical' | 'radial';
  /**
   * motion of the matter: with the angular velocity of the circular orbit at each r, and in free fall inside the
   * ISCO; or at rest relative to observers of zero angular momentum (model: riaf); default "orbits".
   */
  'volume.flow'?: 'orbits' | 'rest';
  /**
   * energy distribution of the electrons (models: riaf, torus, grid); kappa: thermal with a power-law tail;
   * default "thermal".
   */
  'volume.electrons'?: 'thermal' | 'power-law' | 'kappa';
  /** p: the number of electrons is proportional to gamma^-p (electrons: power-law); 1.1 to 10; default 3.5. */
  'volume.electrons_index'?: number;
  /**
   * kappa: at high energies the number of electrons is proportional to gamma^(1 - kappa) (electrons: kappa); 3.1
   * to 7.5; default 4.
   */
  'volume.kappa'?: number;
  /**
   * radius of the largest pressure; the inner edge is volume.inner (model: torus); in M; 1 to 1000; default 12.
   */
  'volume.torus_radius'?: number;
  /** adiabatic index of the gas (model: torus); 1.1 to 2; default 1.4444444444444444. */
  'volume.adiabatic_index'?: number;
  /** ion temperature over electron temperature (model: torus); 0 to 1000000; default 3. */
  'volume.temperature_ratio'?: number;
  /** gas pressure over magnetic pressure (model: torus); 1e-06 to 1e+12; default 10. */
  'volume.beta'?: number;
  /** smallest Lorentz factor of the electrons (electrons: power-law); 1 to 1000000000; default 30. */
  'volume.gamma_min'?: number;
  /**
   * largest Lorentz factor of the electrons; above gamma_min (electrons: power-law); 1 to 1e+12; default 100000.
   */
  'volume.gamma_max'?: number;
  /**
   * flux to which the picture is normalised: kerrd multiplies the density (gold: the emissivity; grid: the
   * factor) by a number that small pictures determine, and reports this number; 0: no change (models: gold, riaf,
   * torus, grid); in Jy; 0 to 1e+12; default 0.
   */
  'volume.normalise_to_jy'?: number;
  /** frequency of that flux; observed: volume.frequency_ghz; in GHz; 1e-06 to 1e+12; default "observed". */
  'volume.normalise_ghz'?: 'observed' | number;
  /**
   * light that the jet emits along 1 M in its own frame, in units of the disk's brightest surface brightness. It
   * is the value of the power law at the inner edge; the actual light is 0 there and rises smoothly to the power
   * law. 0: no jets; in 1/M; 0 to 1000000000; default 0.
   */
  'jets.brightness'?: number;
  /** half of the cone's opening angle; in degrees; 1 to 60; default 8. */
  'jets.opening_deg'?: number;
  /** Lorentz factor of the outflow; 1 to 100; default 2. */
  'jets.lorentz'?: number;
  /**
   * radius at which the light begins, at least 1.05 times that of the horizon; in M; 1 to 1000000; default 4.
   */
  'jets.inner'?: number;
  /** radius at which the light ends; larger than the inner edge; in M; 1 to 1000000; default 60. */
  'jets.outer'?: number;
  /** p: the jet's light is proportional to r^-p; -10 to 10; default 1.5. */
  'jets.falloff'?: number;
  /** distribution of brightness across the jet: 0, a bright spine; 1, bright edges; 0 to 1; default 0.5. */
  'jets.sheath'?: number;
  /** index: brightness is proportional to g^(2 + index); -10 to 10; default 0.7. */
  'jets.spectral_index'?: number;
  /** colour of a black body of this temperature, not shifted; in K; 300 to 1000000000; default 14000. */
  'jets.temperature_k'?: number;
  /** include the jet below the disk; default true. */
  'jets.counterjet'?: boolean;
  /**
   * polarisation. none; synchrotron: of light from the disk's plane, perpendicular to polarization.field and the
   * ray in the gas's frame; scattering: of light from the disk's plane, by a deep atmosphere of free electrons,
   * perpendicular to the normal and the ray; transfer: of a volume at a radio frequency, Stokes I, Q, U and V
   * along the rays; default "none".
   */
  'polarization.model'?: 'none' | 'synchrotron' | 'scattering' | 'transfer';
  /**
   * direction of the magnetic field in the plane: round the axis, outwards, or along the normal (model:
   * synchrotron); default "toroidal".
   */
  'polarization.field'?: 'toroidal' | 'radial' | 'vertical';
  /**
   * p: the number of electrons is proportional to E^-p; an ordered field polarises their light by (p + 1)/(p +
   * 7/3) (model: synchrotron); 1 to 10; default 3.
   */
  'polarization.electron_index'?: number;
  /** factor on the polarisation, below 1 for a field that is disordered within a pixel; 0 to 1; default 1. */
  'polarization.order'?: number;
  /**
   * include Faraday rotation, and conversion between linear and circular polarisation, by the electrons (model:
   * transfer); default true.
   */
  'polarization.faraday'?: boolean;
  /**
   * fit of the Faraday rotation by thermal electrons: Shcherbakov 2008, or Dexter 2016 in the form of Huang and
   * Shcherbakov 2011 (model: transfer); default "shcherbakov".
   */
  'polarization.rotation'?: 'shcherbakov' | 'dexter';
  /**
   * sky at infinity: none; a celestial grid that shows the lensing; generated stars and a generated Milky Way;
   * the stars of the Hipparcos catalogue over that Milky Way; or sky.image without stars; default "none".
   */
  'sky.model'?: 'none' | 'grid' | 'stars' | 'catalogue' | 'image';
  /**
   * brightness of the grid, or of a sky of 21 magnitudes per square arcsecond, in units of the disk's brightest
   * surface brightness at g = 1; stars and the Milky Way keep their real ratio. auto: 0.2, or 0.01 for stars and
   * the Milky Way behind other light; 0 to 100; default "auto".
   */
  'sky.brightness'?: 'auto' | number;
  /** spacing of the celestial grid; in degrees; 1 to 90; default 15. */
  'sky.grid_deg'?: number;
  /** factor on the natural brightness of the Milky Way or of sky.image; 0: only stars; 0 to 100; default 1. */
  'sky.milky_way'?: number;
  /**
   * picture of the whole sky instead of the generated Milky Way (model: stars, catalogue, image): twice as wide
   * as high, with galactic longitude 0 in the middle and rising to the left, latitude rising upwards; its white
   * is 21 magnitudes per square arcsecond; default null.
   */
  'sky.image'?: null | string;
  /** magnitude of the faintest stars that are shown; in magnitudes; -2 to 14; default 14. */
  'sky.limit_mag'?: number;
  /** seed of the random numbers of the generated sky; 0 to 2147483647; default 1. */
  'sky.seed'?: number;
  /**
   * galactic, equatorial: the hole's axis points to that pole of the sky, and azimuth 0 to longitude 0; sgra,
   * m87: an observer at azimuth 0 sees the hole where the Earth sees that source, with the galactic pole (sgra)
   * or the celestial pole (m87) above; default "galactic".
   */
  'sky.orientation'?: 'galactic' | 'equatorial' | 'sgra' | 'm87';
  /**
   * rotation of the sky about the hole's axis, in the sense of camera.azimuth_deg; in degrees; -360 to 360;
   * default 0.
   */
  'sky.turn_deg'?: number;
  /**
   * a second rotation of the sky, about the horizontal axis of the picture from azimuth 0; in degrees; -180 to
   * 180; default 0.
   */
  'sky.tilt_deg'?: number;
  /** width of the picture; in pixels; 1 to 32768; default 1280. */
  'image.width'?: number;
  /** height of the picture; in pixels; 1 to 32768; default 720. */
  'image.height'?: number;
  /**
   * rays along each side of a pixel: n gives the mean of n x n rays; auto: one ray, and 16 for pixels that differ
   * from their neighbours; 1 to 8; default 1.
   */
  'image.samples'?: 'auto' | number;
  /**
   * apparent error, as a fraction of white, above which a pixel of one ray gets more rays (samples: auto); 0.001
   * to 0.5; default 0.003.
   */
  'image.pixel_error'?: number;
  /**
   * factor on the number of rays along each side of pixels at the critical curve, where the photon ring is
   * thinner than a pixel; the product is at most 16; 1 to 16; default 4.
   */
  'image.critical_factor'?: number;
  /** bits a channel: 8 or 16; in bits; 8 to 16; default 8. */
  'image.bit_depth'?: number;
  /**
   * contents of the file: the picture, or maps of the rays (docs/layers.md) for the first crossing of the disk,
   * or with the suffix _N for image order N; a PNG shows one map in false colour, FITS, EXR, NPZ and NPY have
   * several as numbers; up to 16; default ["rgb"].
   */
  'image.layers'?: string[];
  /**
   * value at the lower end of a layer's colour scale; auto: docs/layers.md gives it for each layer; -1e+12 to
   * 1e+12; default "auto".
   */
  'image.layer_min'?: 'auto' | number;
  /**
   * value at the upper end of a layer's colour scale; auto: docs/layers.md gives it for each layer; -1e+12 to
   * 1e+12; default "auto".
   */
  'image.layer_max'?: 'auto' | number;
  /** draw a colour bar in the lower left corner of a layer in false colour; default true. */
  'image.legend'?: boolean;
  /** columns of the picture to the left of the tile; in pixels; 0 to 32767; default 0. */
  'image.tile.left'?: number;
  /** rows of the picture above the tile; in pixels; 0 to 32767; default 0. */
  'image.tile.top'?: number;
  /** width of the tile; 0: no tile, the whole picture is rendered; in pixels; 0 to 32768; default 0. */
  'image.tile.width'?: number;
  /** height of the tile; 0: no tile, the whole picture is rendered; in pixels; 0 to 32768; default 0. */
  'image.tile.height'?: number;
  /**
   * style, which sets all fields of the look except those that the document sets; none: no style; default "film".
   */
  'style.name'?: 'none' | 'film' | 'raw' | 'dngr' | 'eht' | 'starless';
  /**
   * exposure as an exponent of 2, relative to the disk's brightest surface brightness at g = 1; auto: by the
   * light in the picture, with a limit for pictures of stars alone so that empty space is black; in stops; -40 to
   * 40; default "auto".
   */
  'style.exposure'?: 'auto' | number;
  /**
   * aces: film-like curve; srgb: proportional to light, clipped; neutral: keeps colours, and compresses light
   * near white; default "aces".
   */
  'style.tone_map'?: 'aces' | 'srgb' | 'neutral';
  /**
   * share of bright light that the lens spreads around its place: all light over 0.6 of white, with a smooth
   * transition from 0.2 on; 0: none; 0 to 1; default 0.4.
   */
  'style.bloom'?: number;
  /**
   * full width at half maximum of a round Gaussian telescope beam, seen from spacetime.distance_pc; 0: none; in
   * microarcseconds; 0 to 1e+12; default 0.
   */
  'style.beam_uas'?: number;
  /**
   * colour: the colour of the light; heat: brightness in false colour (black, red, orange, white), with lightness
   * proportional to it; default "colour".
   */
  'style.palette'?: 'colour' | 'heat';
  /**
   * draw a brightness bar in the lower left corner (palette: heat; tone_map: srgb), and in the upper right corner
   * an angular scale and the shape of the beam; default false.
   */
  'style.colour_bar'?: boolean;
  /** add half a step of ordered noise before rounding, against banding; default true. */
  'style.dither'?: boolean;
  /**
   * illustration of a struck hole: light of image orders 1 and up is multiplied by 1 + ringdown e^(-t/tau) cos(w
   * t), with the hole's quasi-normal mode l = m = 2, n = 0; 0: none; 0 to 1; default 0.
   */
  'style.ringdown'?: number;
  /** time at which the hole was struck, and the ringing begins; in M; -1e+12 to 1e+12; default 0. */
  'style.ringdown_time'?: number;
  /** the source on the sky that the hole represents; default "none". */
  'source.name'?: 'none' | 'm87' | 'sgra';
  /** right ascension of the hole (ICRS); in degrees; 0 to 360; default 0. */
  'source.ra_deg'?: number;
  /** declination of the hole (ICRS); in degrees; -90 to 90; default 0. */
  'source.dec_deg'?: number;
  /** date of the picture, as a modified Julian date; in days; 0 to 1000000; default "none". */
  'source.mjd'?: 'none' | number;
  /** rate at which the observer goes round the axis; in degrees per second; -360 to 360; default 0. */
  'motion.azimuth_rate_deg'?: number;
  /** rate of coordinate time; in M per second; -1000000 to 1000000; default 0. */
  'motion.time_rate'?: number;
  /**
   * rate of the observer's proper time: the observer moves along its path, a fall to the last possible position
   * or an orbit; coordinate time follows; in M per second; 0 to 1000000; default 0.
   */
  'motion.proper_time_rate'?: number;
  /**
   * accuracy with which rays are traced, from coarse to fine; reference: double precision; default "balanced".
   */
  'accuracy.profile'?: 'draft' | 'interactive' | 'balanced' | 'high' | 'reference';
  /**
   * largest relative error of the crossing radii, by the accuracy table of the device; profile: the error of
   * accuracy.profile; 1e-18 to 0.1; default "profile".
   */
  'accuracy.tolerance'?: 'profile' | number;
  /**
   * method that traces the rays; auto: the closed form outside the photon orbits, otherwise mino-rkn6; default
   * "auto".
   */
  'accuracy.engine'?: 'auto' | 'closed' | 'mino-rkn4' | 'mino-rkn6' | 'ks-euler' | 'ks-rk4' | 'ks-tao6';
  /** precision of the arithmetic; auto: chosen by accuracy.profile; default "auto". */
  'accuracy.precision'?: 'auto' | 'f32' | 'f64';
  /** integrator steps for a half turn, a multiple of 4; 0: chosen by accuracy.profile; 0 to 2048; default 0. */
  'accuracy.steps'?: number;
  /** equatorial crossings kept for each ray: image orders 0 to n - 1; 1 to 8; default 3. */
  'accuracy.orders'?: number;
  /** coordinate time of the picture; in M; -1e+12 to 1e+12; default 0. */
  time?: number;
}

/**
 * Operations by method and path. takes: parameters of the path and the query, and the body with its media type; gives:
 * what an answer holds by its media type, undefined where there is none. Left out are the page's files, and answers
 * that are streams without an end.
 */
export interface Operations {
  /** 200 while the process lives. */
  'GET /healthz': {
    takes: {};
    gives: {
      'application/json': {
        status: 'alive';
      };
    };
  };
  /** 200 while renders are accepted, 503 during shutdown. */
  'GET /readyz': {
    takes: {};
    gives: {
      'application/json': {
        status: 'ready';
      };
    };
  };
  /** Counters and gauges for Prometheus. */
  'GET /metrics': {
    takes: {};
    gives: {
      'text/plain': string;
    };
  };
  /** Device, driver, precision, memory, versions. */
  'GET /v1/device': {
    takes: {};
    gives: {
      'application/json': Device;
    };
  };
  /** Measured speed and error of the engines on this device; made by `kerrd bench accuracy`. */
  'GET /v1/accuracy': {
    takes: {};
    gives: {
      'application/json': AccuracyTable;
    };
  };
  /** Names and titles of the presets. */
  'GET /v1/presets': {
    takes: {};
    gives: {
      'application/json': Presets;
    };
  };
  /** The scene of a preset. */
  'GET /v1/presets/{name}': {
    takes: {
      path: {
        name: PresetName;
      };
    };
    gives: {
      'application/json': Scene;
    };
  };
  /** A small picture of a preset, 192 by 120 pixels, rendered at the first request and then cached. */
  'GET /v1/presets/{name}/thumbnail.png': {
    takes: {
      path: {
        name: PresetName;
      };
    };
    gives: {
      'image/png': Uint8Array;
    };
  };
  /** JSON Schema of a scene. */
  'GET /v1/schema': {
    takes: {};
    gives: {
      'application/schema+json': unknown;
    };
  };
  /** All approximations: their names, which Kerrd-Approximations lists, and their sentences. */
  'GET /v1/approximations': {
    takes: {};
    gives: {
      'application/json': Approximations;
    };
  };
  /**
   * Cost of a scene: passes, rays, bytes, estimated time, approximations; with axes, the total cost of a sweep.
   */
  'POST /v1/plan': {
    takes: {
      query?: {
        preset?: PresetName;
      };
      body: Scene | {
        scene?: Scene;
        axes: SweepAxes;
        exposure?: 'each';
        output?: 'pictures' | 'layers' | 'npy' | 'npz' | 'fits' | 'exr' | 'cube' | 'light-curve';
      };
      type?: 'application/json';
    };
    gives: {
      'application/json': Plan | SweepPlan;
    };
  };
  /** End points of listed rays: equatorial crossings, redshift, delay, direction of escape, error. */
  'POST /v1/rays': {
    takes: {
      query?: {
        /** spin of the hole, a/M; -1 to 1. */
        spin?: number;
        /** charge Q of the hole; a^2 + Q^2 < 1 [M]; -1 to 1. */
        charge?: number;
        /** radius of the observer, M; outside the horizon; 1 to 10000000. */
        r?: 'infinity' | number;
        /** polar angle of the observer, from the hole's axis; 0 to 180. */
        inclination_deg?: number;
        /**
         * motion of an observer at a finite r, as camera.observer of a scene; a ray is then a direction in the
         * observer's frame, [yaw, pitch] in degrees.
         */
        motion?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
        /** velocity outwards, as camera.velocity_r (motion: velocity); -1 to 1. */
        velocity_r?: number;
        /** velocity away from the north pole, as camera.velocity_theta (motion: velocity); -1 to 1. */
        velocity_theta?: number;
        /** velocity along the disk's rotation, as camera.velocity_phi (motion: velocity); -1 to 1. */
        velocity_phi?: number;
        /** radius at which the observer was at rest, as camera.infall_from, M (motion: infall); 1 to 10000000. */
        infall_from?: 'infinity' | number;
        /** energy per mass, as camera.infall_energy (motion: infall); -100 to 1000. */
        infall_energy?: 'rest' | number;
        /** angular momentum per mass, as camera.infall_momentum, M (motion: infall); -10000 to 10000. */
        infall_momentum?: number;
        /** number of equatorial crossings in the answer; 1 to 16. */
        orders?: number;
        /** as accuracy.profile of a scene; without profile and engine, the closed form is used. */
        profile?: 'draft' | 'interactive' | 'balanced' | 'high' | 'reference';
        /** largest relative error of the crossing radii, instead of the profile; 0 to 1. */
        tolerance?: 'profile' | number;
        /** method that traces the rays; auto: by profile or tolerance. */
        engine?: 'auto' | 'closed' | 'mino-rkn4' | 'mino-rkn6' | 'ks-euler' | 'ks-rk4' | 'ks-tao6';
        /** precision of the arithmetic; the closed form has only f64. */
        precision?: 'auto' | 'f32' | 'f64';
        /** integrator steps for a half period of the radial motion; some engines take fewer; 0 to 2048. */
        steps?: number;
      };
      body: RaysRequest;
      type?: 'application/json';
    } | {
      query?: {
        /** spin of the hole, a/M; -1 to 1. */
        spin?: number;
        /** charge Q of the hole; a^2 + Q^2 < 1 [M]; -1 to 1. */
        charge?: number;
        /** radius of the observer, M; outside the horizon; 1 to 10000000. */
        r?: 'infinity' | number;
        /** polar angle of the observer, from the hole's axis; 0 to 180. */
        inclination_deg?: number;
        /**
         * motion of an observer at a finite r, as camera.observer of a scene; a ray is then a direction in the
         * observer's frame, [yaw, pitch] in degrees.
         */
        motion?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
        /** velocity outwards, as camera.velocity_r (motion: velocity); -1 to 1. */
        velocity_r?: number;
        /** velocity away from the north pole, as camera.velocity_theta (motion: velocity); -1 to 1. */
        velocity_theta?: number;
        /** velocity along the disk's rotation, as camera.velocity_phi (motion: velocity); -1 to 1. */
        velocity_phi?: number;
        /** radius at which the observer was at rest, as camera.infall_from, M (motion: infall); 1 to 10000000. */
        infall_from?: 'infinity' | number;
        /** energy per mass, as camera.infall_energy (motion: infall); -100 to 1000. */
        infall_energy?: 'rest' | number;
        /** angular momentum per mass, as camera.infall_momentum, M (motion: infall); -10000 to 10000. */
        infall_momentum?: number;
        /** number of equatorial crossings in the answer; 1 to 16. */
        orders?: number;
        /** as accuracy.profile of a scene; without profile and engine, the closed form is used. */
        profile?: 'draft' | 'interactive' | 'balanced' | 'high' | 'reference';
        /** largest relative error of the crossing radii, instead of the profile; 0 to 1. */
        tolerance?: 'profile' | number;
        /** method that traces the rays; auto: by profile or tolerance. */
        engine?: 'auto' | 'closed' | 'mino-rkn4' | 'mino-rkn6' | 'ks-euler' | 'ks-rk4' | 'ks-tao6';
        /** precision of the arithmetic; the closed form has only f64. */
        precision?: 'auto' | 'f32' | 'f64';
        /** integrator steps for a half period of the radial motion; some engines take fewer; 0 to 2048. */
        steps?: number;
      };
      body: Binary;
      type: 'application/x-npy';
    };
    gives: {
      'application/json': RaysAnswer;
      'application/x-npy': Uint8Array;
    };
  };
  /** The quantities that /v1/physics/NAME gives. */
  'GET /v1/physics': {
    takes: {};
    gives: {
      'application/json': Quantities;
    };
  };
  /** radii, ISCO and frequencies of circular orbits of a Kerr hole. */
  'GET /v1/physics/kerr': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** polar angle at which the ergosphere is given [degrees]; 0 to 180; default 90. */
        theta_deg?: number | string;
        /** radius of the circular orbit whose frequencies are given [M]; 1 to 1000000000; default 10. */
        r?: 'isco' | number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'kerr';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          theta_deg: number | number[];
          r: 'isco' | number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** outer horizon r+. */
          horizon: number | null | (number | null)[];
          /** inner horizon r-. */
          inner_horizon: number | null | (number | null)[];
          /** angular velocity of the horizon, a/(2 r+ - Q^2). */
          horizon_omega: number | null | (number | null)[];
          /** static limit r_E at theta_deg. */
          ergosphere: number | null | (number | null)[];
          /** circular photon orbit that turns towards +phi. */
          photon_prograde: number | null | (number | null)[];
          /** circular photon orbit that turns towards -phi. */
          photon_retrograde: number | null | (number | null)[];
          /** circular orbit with E = 1, towards +phi. */
          marginally_bound: number | null | (number | null)[];
          /** circular orbit with E = 1, towards -phi. */
          marginally_bound_retrograde: number | null | (number | null)[];
          /** innermost stable circular orbit, towards +phi. */
          isco: number | null | (number | null)[];
          /** innermost stable circular orbit, towards -phi. */
          isco_retrograde: number | null | (number | null)[];
          /** specific energy E at the ISCO. */
          isco_energy: number | null | (number | null)[];
          /** specific angular momentum L at the ISCO. */
          isco_momentum: number | null | (number | null)[];
          /** angular velocity Omega at the ISCO. */
          isco_omega: number | null | (number | null)[];
          /** 1 - E at the ISCO. */
          efficiency: number | null | (number | null)[];
          /** specific energy E at r; null at and inside the photon orbit. */
          energy: number | null | (number | null)[];
          /** specific angular momentum L at r; null at and inside the photon orbit. */
          momentum: number | null | (number | null)[];
          /** orbital angular frequency Omega_phi at r, in coordinate time; null at and inside the photon orbit. */
          omega_phi: number | null | (number | null)[];
          /** radial epicyclic frequency at r; null inside the ISCO. */
          kappa: number | null | (number | null)[];
          /** vertical epicyclic frequency at r; null at and inside the photon orbit. */
          omega_theta: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          theta_deg: string;
          r: string;
          horizon: string;
          inner_horizon: string;
          horizon_omega: string;
          ergosphere: string;
          photon_prograde: string;
          photon_retrograde: string;
          marginally_bound: string;
          marginally_bound_retrograde: string;
          isco: string;
          isco_retrograde: string;
          isco_energy: string;
          isco_momentum: string;
          isco_omega: string;
          efficiency: string;
          energy: string;
          momentum: string;
          omega_phi: string;
          kappa: string;
          omega_theta: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** the critical curve, which is the edge of the shadow, for any observer, with its size and shape. */
  'GET /v1/physics/shadow': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** polar angle of the observer [degrees]; 0 to 180; default 60. */
        inclination_deg?: number | string;
        /** radius of the observer [M]; 0.01 to 10000000; default "infinity". */
        observer_r?: 'infinity' | number | string;
        /**
         * state of motion at a finite radius; static: at rest with respect to infinity; zamo: with zero angular
         * momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude; retrograde: on
         * a circular orbit towards -phi, against the disk, at its highest latitude; infall: in fre; default "static".
         */
        observer?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
        /**
         * velocity outwards, relative to the observer of zero angular momentum (observer velocity) [c]; -1 to 1;
         * default 0.
         */
        velocity_r?: number | string;
        /**
         * velocity away from the north pole, relative to the observer of zero angular momentum (observer velocity) [c];
         * -1 to 1; default 0.
         */
        velocity_theta?: number | string;
        /**
         * velocity towards +phi, relative to the observer of zero angular momentum (observer velocity) [c]; -1 to 1;
         * default 0.
         */
        velocity_phi?: number | string;
        /**
         * radius at which the observer's fall begins, at rest except for its angular momentum (observer infall) [M]; 1
         * to 10000000; default "infinity".
         */
        infall_from?: 'infinity' | number | string;
        /**
         * energy per mass of the falling observer; rest: the energy that follows from infall_from; -100 to 1000;
         * default "rest".
         */
        infall_energy?: 'rest' | number | string;
        /** angular momentum per mass of the falling observer [M]; -10000 to 10000; default 0. */
        infall_momentum?: number | string;
        /** angle about the curve's centre, from the right over the top [degrees]; -360 to 720; default "0:355:72". */
        angle_deg?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'shadow';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          inclination_deg: number | number[];
          observer_r: 'infinity' | number | number[];
          observer: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
          velocity_r: number | number[];
          velocity_theta: number | number[];
          velocity_phi: number | number[];
          infall_from: 'infinity' | number | number[];
          infall_energy: 'rest' | number | number[];
          infall_momentum: number | number[];
          angle_deg: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /**
           * coordinate of the curve on the image plane, to the right; at any distance it labels the constants of motion.
           */
          alpha: number | null | (number | null)[];
          /**
           * coordinate of the curve on the image plane, along the projected spin; at any distance it labels the constants
           * of motion.
           */
          beta: number | null | (number | null)[];
          /** distance from the centre, in M for an observer at infinity, otherwise an angle on the sky. */
          rho: number | null | (number | null)[];
          /** unit vector of the viewing direction at a finite radius: component towards +phi; null at infinity. */
          right: number | null | (number | null)[];
          /** unit vector of the viewing direction at a finite radius: component up, towards -theta; null at infinity. */
          up: number | null | (number | null)[];
          /**
           * unit vector of the viewing direction at a finite radius: component inwards, towards -r; null at infinity.
           */
          inwards: number | null | (number | null)[];
          /** radius of the photon orbit seen at this point of the curve. */
          orbit_r: number | null | (number | null)[];
          /** Lyapunov exponent gamma of this orbit: with each half turn, images lie closer to the curve by e^-gamma. */
          lyapunov: number | null | (number | null)[];
          /** area of the shadow in M^2, or its solid angle. */
          area: number | null | (number | null)[];
          /** mean of rho about the midpoint of the left and right ends. */
          mean_radius: number | null | (number | null)[];
          /** displacement of the midpoint of the left and right ends from the hole's centre, to the right. */
          displacement: number | null | (number | null)[];
          /** twice the root mean square of the difference of rho and its mean. */
          asymmetry: number | null | (number | null)[];
          /** extent from left to right. */
          width: number | null | (number | null)[];
          /** extent from bottom to top. */
          height: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          inclination_deg: string;
          observer_r: string;
          velocity_r: string;
          velocity_theta: string;
          velocity_phi: string;
          infall_from: string;
          infall_energy: string;
          infall_momentum: string;
          angle_deg: string;
          alpha: string;
          beta: string;
          rho: string;
          right: string;
          up: string;
          inwards: string;
          orbit_r: string;
          lyapunov: string;
          area: string;
          mean_radius: string;
          displacement: string;
          asymmetry: string;
          width: string;
          height: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** bending of light in the equatorial plane, exact and in its limits. */
  'GET /v1/physics/deflection': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** impact parameter of light in the equatorial plane, |L|/E [M]; 1 to 1e+12; default 10. */
        b?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'deflection';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          b: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** total bending towards +phi, whole turns included; null if captured, b < b_critical. */
          angle: number | null | (number | null)[];
          /** total bending of light that turns towards -phi, whole turns included; null if captured. */
          angle_retrograde: number | null | (number | null)[];
          /** weak field, 4/b. */
          weak: number | null | (number | null)[];
          /** weak-field bending towards +phi to second order, 4/b + (15 pi/4 - 4a - 3 pi Q^2/4)/b^2. */
          weak_second: number | null | (number | null)[];
          /** weak-field bending towards -phi to second order. */
          weak_second_retrograde: number | null | (number | null)[];
          /**
           * strong-field limit of the bending towards +phi near b_critical, -rate ln(b/b_critical - 1) + offset; null if
           * captured.
           */
          strong: number | null | (number | null)[];
          /** strong-field limit of the bending towards -phi near b_critical_retrograde; null if captured. */
          strong_retrograde: number | null | (number | null)[];
          /** closest approach r of the light towards +phi; null if captured. */
          closest: number | null | (number | null)[];
          /** closest approach r of the light towards -phi; null if captured. */
          closest_retrograde: number | null | (number | null)[];
          /**
           * largest radius that light towards +phi reaches if it is emitted inside the photon orbit and falls back; null
           * if it escapes, or if no light inside has this b.
           */
          farthest: number | null | (number | null)[];
          /** largest radius that light towards -phi reaches if it is emitted inside the photon orbit and falls back. */
          farthest_retrograde: number | null | (number | null)[];
          /** impact parameter of the circular photon orbit towards +phi. */
          b_critical: number | null | (number | null)[];
          /** impact parameter of the circular photon orbit towards -phi. */
          b_critical_retrograde: number | null | (number | null)[];
          /** rate of the strong limit, 1 at spin 0. */
          strong_rate: number | null | (number | null)[];
          /** offset of the strong limit. */
          strong_offset: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          b: string;
          angle: string;
          angle_retrograde: string;
          weak: string;
          weak_second: string;
          weak_second_retrograde: string;
          strong: string;
          strong_retrograde: string;
          closest: string;
          closest_retrograde: string;
          farthest: string;
          farthest_retrograde: string;
          b_critical: string;
          b_critical_retrograde: string;
          strong_rate: string;
          strong_offset: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** effective potential of light and of matter in the equatorial plane, with its extrema. */
  'GET /v1/physics/potential': {
    takes: {
      query?: {
        /** spin parameter a [M]; -1 to 1; default 0. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /**
         * angular momentum, positive towards +phi: per unit mass for matter, and of the photon for v_light [M];
         * -1000000 to 1000000; default 4.
         */
        l?: number | string;
        /** radius [M]; 1 to 1000000000; default "2:30:281". */
        r?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'potential';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          l: number | number[];
          r: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** smallest specific energy of matter with L at r. */
          v_matter: number | null | (number | null)[];
          /** smallest energy of light with L at r. */
          v_light: number | null | (number | null)[];
          /** 1 - 1/r + L^2/(2 r^2), the Newtonian counterpart of v_matter. */
          newton: number | null | (number | null)[];
          /** unstable circular orbit of matter with L; null if none. */
          r_max_matter: number | null | (number | null)[];
          /** v_matter there. */
          v_max_matter: number | null | (number | null)[];
          /** stable circular orbit of matter with L; null if none. */
          r_min_matter: number | null | (number | null)[];
          /** v_matter there. */
          v_min_matter: number | null | (number | null)[];
          /** circular photon orbit with the sense of L; null for L = 0. */
          r_max_light: number | null | (number | null)[];
          /** v_light there, |L|/b_c. */
          v_max_light: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          l: string;
          r: string;
          v_matter: string;
          v_light: string;
          newton: string;
          r_max_matter: string;
          v_max_matter: string;
          r_min_matter: string;
          v_min_matter: string;
          r_max_light: string;
          v_max_light: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** redshift factor g and g^4 along a ring of gas, with the ring's lensed images. */
  'GET /v1/physics/redshift': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** polar angle of the observer, at infinity; not within 0.1 of 90 [degrees]; 0 to 180; default 60. */
        inclination_deg?: number | string;
        /** radius of the ring [M]; 1 to 10000; default 6. */
        r?: 'isco' | number | string;
        /**
         * azimuth on the ring relative to the observer's: 0 is the near side, at 90 the gas recedes [degrees]; -360 to
         * 720; default "0:355:72".
         */
        phi_deg?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'redshift';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          inclination_deg: number | number[];
          r: 'isco' | number | number[];
          phi_deg: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** redshift factor nu_observed/nu_emitted of the direct image. */
          g: number | null | (number | null)[];
          /** g^4: bolometric intensity of the direct image over the emitted intensity. */
          g4: number | null | (number | null)[];
          /** position of the direct image, to the right. */
          alpha: number | null | (number | null)[];
          /** position of the direct image, along the projected spin. */
          beta: number | null | (number | null)[];
          /** time of flight of the direct image's light, minus r_o + 2 ln r_o, with r_o the observer's radius. */
          delay: number | null | (number | null)[];
          /**
           * number of direct images: 1, or 3 or more beyond a caustic, close to edge on; the answer has the first from
           * +alpha towards +beta.
           */
          images: number | null | (number | null)[];
          /** g of the image of order 1, whose light passes the other side of the hole. */
          g_1: number | null | (number | null)[];
          /** g^4 of the image of order 1. */
          g4_1: number | null | (number | null)[];
          /** position of the image of order 1, to the right. */
          alpha_1: number | null | (number | null)[];
          /** position of the image of order 1, along the projected spin. */
          beta_1: number | null | (number | null)[];
          /** time of flight of the light of the image of order 1, minus r_o + 2 ln r_o. */
          delay_1: number | null | (number | null)[];
          /** number of images of order 1. */
          images_1: number | null | (number | null)[];
          /** sqrt(1 - 3/r)/(1 - v.n), v = sqrt(1/(r - 2)), without lensing or spin; null for r <= 3. */
          g_flat: number | null | (number | null)[];
          /** fourth power of g_flat. */
          g4_flat: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          inclination_deg: string;
          r: string;
          phi_deg: string;
          g: string;
          g4: string;
          alpha: string;
          beta: string;
          delay: string;
          images: string;
          g_1: string;
          g4_1: string;
          alpha_1: string;
          beta_1: string;
          delay_1: string;
          images_1: string;
          g_flat: string;
          g4_flat: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** images of a ring in the equatorial plane, direct or past the hole, from any distance. */
  'GET /v1/physics/ring-image': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** polar angle of the observer; not within 0.1 of 90 [degrees]; 0 to 180; default 60. */
        inclination_deg?: number | string;
        /** radius of the observer [M]; 0.01 to 10000000; default "infinity". */
        observer_r?: 'infinity' | number | string;
        /**
         * state of motion at a finite radius; static: at rest with respect to infinity; zamo: with zero angular
         * momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude; retrograde: on
         * a circular orbit towards -phi, against the disk, at its highest latitude; infall: in fre; default "static".
         */
        observer?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
        /**
         * velocity outwards, relative to the observer of zero angular momentum (observer velocity) [c]; -1 to 1;
         * default 0.
         */
        velocity_r?: number | string;
        /**
         * velocity away from the north pole, relative to the observer of zero angular momentum (observer velocity) [c];
         * -1 to 1; default 0.
         */
        velocity_theta?: number | string;
        /**
         * velocity towards +phi, relative to the observer of zero angular momentum (observer velocity) [c]; -1 to 1;
         * default 0.
         */
        velocity_phi?: number | string;
        /**
         * radius at which the observer's fall begins, at rest except for its angular momentum (observer infall) [M]; 1
         * to 10000000; default "infinity".
         */
        infall_from?: 'infinity' | number | string;
        /**
         * energy per mass of the falling observer; rest: the energy that follows from infall_from; -100 to 1000;
         * default "rest".
         */
        infall_energy?: 'rest' | number | string;
        /** angular momentum per mass of the falling observer [M]; -10000 to 10000; default 0. */
        infall_momentum?: number | string;
        /** radius of the ring [M]; 1 to 10000; default 6. */
        r?: 'isco' | number | string;
        /** order of the image: 0 direct, 1 past the other side of the hole; 0 to 1; default 0. */
        order?: number | string;
        /**
         * angle psi in the image plane, uniform along an unlensed ring: the direction from the origin is (cos psi, cos
         * i sin psi); at a finite radius the origin is the direction -r on the sky of an observer that falls from rest
         * at infinity [degrees]; -360 to 720; default "0:355:72".
         */
        angle_deg?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'ring-image';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          inclination_deg: number | number[];
          observer_r: 'infinity' | number | number[];
          observer: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
          velocity_r: number | number[];
          velocity_theta: number | number[];
          velocity_phi: number | number[];
          infall_from: 'infinity' | number | number[];
          infall_energy: 'rest' | number | number[];
          infall_momentum: number | number[];
          r: 'isco' | number | number[];
          order: number | number[];
          angle_deg: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /**
           * coordinate on the image plane, to the right; at any distance it labels the constants of motion; null where
           * light has no energy at infinity.
           */
          alpha: number | null | (number | null)[];
          /** coordinate on the image plane, along the projected spin; null where light has no energy at infinity. */
          beta: number | null | (number | null)[];
          /** unit vector of the viewing direction at a finite radius: component towards +phi; null at infinity. */
          right: number | null | (number | null)[];
          /** unit vector of the viewing direction at a finite radius: component up, towards -theta; null at infinity. */
          up: number | null | (number | null)[];
          /**
           * unit vector of the viewing direction at a finite radius: component inwards, towards -r; null at infinity.
           */
          inwards: number | null | (number | null)[];
          /**
           * azimuth of the visible point of the ring relative to the observer's, with whole turns; null for an observer
           * inside the horizon, and for light whose energy at infinity is not positive.
           */
          phi_deg: number | null | (number | null)[];
          /** time of flight; for an observer at infinity minus r_o + 2 ln r_o; null where phi_deg is null. */
          delay: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          inclination_deg: string;
          observer_r: string;
          velocity_r: string;
          velocity_theta: string;
          velocity_phi: string;
          infall_from: string;
          infall_energy: string;
          infall_momentum: string;
          r: string;
          order: string;
          angle_deg: string;
          alpha: string;
          beta: string;
          right: string;
          up: string;
          inwards: string;
          phi_deg: string;
          delay: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** photon rings: their edges relative to the critical curve, and their widths. */
  'GET /v1/physics/photon-rings': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /**
         * polar angle of the observer, who is at infinity; at 90 the equatorial plane is seen edge-on [degrees]; 0 to
         * 180; default 60.
         */
        inclination_deg?: number | string;
        /**
         * position on the critical curve: angle about its centre, from the right over the top [degrees]; -360 to 720;
         * default 0.
         */
        angle_deg?: number | string;
        /** inner radius of the light's source in the equatorial plane [M]; 1 to 1000000000; default "horizon". */
        inner?: 'horizon' | number | string;
        /** outer radius of the light's source [M]; 1 to 1000000000; default "infinity". */
        outer?: 'infinity' | number | string;
        /** order of the ring: number of half turns of its light round the hole; 1 to 12; default "1:6:6". */
        order?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'photon-rings';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          inclination_deg: number | number[];
          angle_deg: number | number[];
          inner: 'horizon' | number | number[];
          outer: 'infinity' | number | number[];
          order: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /**
           * distance of the image of inner from the critical curve, along the curve's radius and in units of it; below 0
           * inside the curve; null if there is no image.
           */
          inner_edge: number | null | (number | null)[];
          /** distance of the image of outer from the critical curve, in the same units; null if there is no image. */
          outer_edge: number | null | (number | null)[];
          /** width of the ring at this angle, from edge to edge. */
          width: number | null | (number | null)[];
          /** width by the limit of high orders: that of order 1 times e^(-gamma (order - 1)). */
          ladder: number | null | (number | null)[];
          /** Lyapunov exponent, for each half turn, of the photon orbit seen at this angle; pi for a = 0. */
          gamma: number | null | (number | null)[];
          /** radius of the photon orbit seen at this angle. */
          orbit_r: number | null | (number | null)[];
          /** distance of the critical curve from its centre at this angle. */
          rho: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          inclination_deg: string;
          angle_deg: string;
          inner: string;
          outer: string;
          order: string;
          inner_edge: string;
          outer_edge: string;
          width: string;
          ladder: string;
          gamma: string;
          orbit_r: string;
          rho: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** flux, temperature and luminosity of a thin accretion disk. */
  'GET /v1/physics/disk-flux': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** mass of the hole [solar masses]; 0.001 to 1e+12; default 100000000. */
        mass_msun?: number | string;
        /**
         * accretion rate as luminosity over the Eddington luminosity, with the efficiency of this spin [Eddington
         * rates]; 1e-12 to 1000; default 0.1.
         */
        mdot_edd?: number | string;
        /** radius in the disk [M]; 1 to 1000000000; default 20. */
        r?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'disk-flux';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          mass_msun: number | number[];
          mdot_edd: number | number[];
          r: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** F/Mdot of one face; zero at and inside the ISCO. */
          page_thorne: number | null | (number | null)[];
          /** F/Mdot of one face in Newton's gravity, cut at the ISCO. */
          shakura_sunyaev: number | null | (number | null)[];
          /** F. */
          page_thorne_w_m2: number | null | (number | null)[];
          /** F in Newton's gravity for the same accretion rate. */
          shakura_sunyaev_w_m2: number | null | (number | null)[];
          /** effective temperature, Page-Thorne. */
          t_eff_k: number | null | (number | null)[];
          /** effective temperature, Shakura-Sunyaev. */
          t_eff_newton_k: number | null | (number | null)[];
          /** inner edge, the ISCO. */
          inner: number | null | (number | null)[];
          /** radius of the largest Page-Thorne flux. */
          r_peak: number | null | (number | null)[];
          /** effective temperature at r_peak. */
          t_peak_k: number | null | (number | null)[];
          /** luminosity over Mdot c^2, 1 - E at the ISCO. */
          efficiency: number | null | (number | null)[];
          /** luminosity over Mdot c^2 of the Newtonian disk, 1/(2 r_isco). */
          efficiency_newton: number | null | (number | null)[];
          /** accretion rate. */
          mdot_kg_s: number | null | (number | null)[];
          /** accretion rate. */
          mdot_msun_yr: number | null | (number | null)[];
          /** efficiency times Mdot c^2. */
          luminosity_w: number | null | (number | null)[];
          /** efficiency times Mdot c^2. */
          luminosity_lsun: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          mass_msun: string;
          mdot_edd: string;
          r: string;
          page_thorne: string;
          shakura_sunyaev: string;
          page_thorne_w_m2: string;
          shakura_sunyaev_w_m2: string;
          t_eff_k: string;
          t_eff_newton_k: string;
          inner: string;
          r_peak: string;
          t_peak_k: string;
          efficiency: string;
          efficiency_newton: string;
          mdot_kg_s: string;
          mdot_msun_yr: string;
          luminosity_w: string;
          luminosity_lsun: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** light of a thin disk that returns to it, falls into the hole, or escapes. */
  'GET /v1/physics/returning': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** light of the disk's surface by the angle to its normal: the laws of /v1/spectrum; default "isotropic". */
        limb?: 'isotropic' | 'laor' | 'haardt' | 'scattering';
        /** radius in the disk, at least the ISCO [M]; 1 to 1000000; default 10. */
        r?: 'isco' | number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'returning';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          limb: 'isotropic' | 'laor' | 'haardt' | 'scattering';
          r: 'isco' | number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** share of the photons of the ring at r that falls on the disk. */
          returns: number | null | (number | null)[];
          /** share of the ring's photons that falls into the hole. */
          falls_in: number | null | (number | null)[];
          /** share of the ring's photons that escapes to infinity. */
          escapes: number | null | (number | null)[];
          /** share of the ring's light, by energy at infinity, that falls on the disk. */
          energy_returns: number | null | (number | null)[];
          /** share of the ring's light, by energy at infinity, that falls into the hole. */
          energy_falls_in: number | null | (number | null)[];
          /** share of the ring's light, by energy at infinity, that escapes. */
          energy_escapes: number | null | (number | null)[];
          /** F/Mdot of one face without returning light. */
          page_thorne: number | null | (number | null)[];
          /** F/Mdot of one face that absorbs the returning light and radiates it again. */
          flux: number | null | (number | null)[];
          /** F/Mdot of the light that returns; flux - page_thorne - received is the work of stresses. */
          received: number | null | (number | null)[];
          /**
           * effective temperature with returning light over that without it; null at the ISCO, where the latter is 0.
           */
          temperature_ratio: number | null | (number | null)[];
          /** inner edge of the disk. */
          isco: number | null | (number | null)[];
          /** share of the luminosity L of the whole disk, without returning light, that falls on the disk again. */
          disk_returns: number | null | (number | null)[];
          /** share of L that falls into the hole directly. */
          disk_falls_in: number | null | (number | null)[];
          /** share of L that escapes directly. */
          disk_escapes: number | null | (number | null)[];
          /** share of L that ends in the hole, directly or after any number of returns. */
          ends_in_hole: number | null | (number | null)[];
          /** share of L that ends at infinity, directly or after any number of returns. */
          ends_escaped: number | null | (number | null)[];
          /** 1 - E at the ISCO. */
          efficiency: number | null | (number | null)[];
          /** efficiency times ends_escaped. */
          efficiency_seen: number | null | (number | null)[];
          /** number of returns that are followed, to 1e-12. */
          iterations: number | null | (number | null)[];
          /**
           * largest relative error of two checks: the energy that arrives over the energy that returns, and ends_in_hole
           * + ends_escaped; both should be 1.
           */
          error: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          r: string;
          returns: string;
          falls_in: string;
          escapes: string;
          energy_returns: string;
          energy_falls_in: string;
          energy_escapes: string;
          page_thorne: string;
          flux: string;
          received: string;
          temperature_ratio: string;
          isco: string;
          disk_returns: string;
          disk_falls_in: string;
          disk_escapes: string;
          ends_in_hole: string;
          ends_escaped: string;
          efficiency: string;
          efficiency_seen: string;
          iterations: string;
          error: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** colour of a black body: chromaticity, sRGB, peak. */
  'GET /v1/physics/blackbody': {
    takes: {
      query?: {
        /** temperature [K]; 100 to 1000000000; default 5772. */
        temperature_k?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'blackbody';
        parameters: {
          temperature_k: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** CIE 1931 chromaticity x. */
          x: number | null | (number | null)[];
          /** CIE 1931 chromaticity y. */
          y: number | null | (number | null)[];
          /** linear sRGB of luminance 1, not clipped: negative outside the gamut. */
          linear_r: number | null | (number | null)[];
          /** linear sRGB, green. */
          linear_g: number | null | (number | null)[];
          /** linear sRGB, blue. */
          linear_b: number | null | (number | null)[];
          /** encoded sRGB, 0 to 1: brightest component 1, moved to the edge of the gamut. */
          srgb_r: number | null | (number | null)[];
          /** encoded sRGB, green. */
          srgb_g: number | null | (number | null)[];
          /** encoded sRGB, blue. */
          srgb_b: number | null | (number | null)[];
          /** wavelength of the largest radiance a unit of wavelength (Wien). */
          peak_nm: number | null | (number | null)[];
          /** frequency of the largest radiance a unit of frequency. */
          peak_hz: number | null | (number | null)[];
          /** sigma T^4/pi. */
          radiance: number | null | (number | null)[];
          /** luminous efficiency: luminance Y over radiance. */
          luminous_fraction: number | null | (number | null)[];
        };
        units: {
          temperature_k: string;
          x: string;
          y: string;
          linear_r: string;
          linear_g: string;
          linear_b: string;
          srgb_r: string;
          srgb_g: string;
          srgb_b: string;
          peak_nm: string;
          peak_hz: string;
          radiance: string;
          luminous_fraction: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** quasi-normal modes of a Kerr hole, and its ringdown. */
  'GET /v1/physics/qnm': {
    takes: {
      query?: {
        /** multipole; 2 to 4; default 2. */
        l?: number | string;
        /** azimuthal number, -l to l; m > 0 turns with a hole of positive spin; -4 to 4; default 2. */
        m?: number | string;
        /** overtone number, as labelled at spin 0; n = 0 decays most slowly; 0 to 3; default 0. */
        n?: number | string;
        /**
         * spin parameter a; closer to 1, damped and undamped modes crowd together and l, n no longer label them
         * uniquely [M]; -0.9999 to 0.9999; default 0.7.
         */
        spin?: number | string;
        /** mass of the hole, with any redshift: m (1 + z) [solar masses]; 0.001 to 1e+12; default 60. */
        mass_msun?: number | string;
        /** time at which `wave` is computed [M]; 0 to 1000000; default 0. */
        t?: number | string;
        /**
         * octaves by which the sound is higher than the ringing; the sound also decays faster by the same factor; -40
         * to 40; default 0.
         */
        shift_octaves?: number | string;
        /**
         * factor by which the decay of the shifted sound is slowed down, at the same pitch; 1 to 1000000; default 1.
         */
        stretch?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv' | 'wav';
      };
    };
    gives: {
      'application/json': {
        quantity: 'qnm';
        parameters: {
          l: number | number[];
          m: number | number[];
          n: number | number[];
          spin: number | number[];
          mass_msun: number | number[];
          t: number | number[];
          shift_octaves: number | number[];
          stretch: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** angular frequency. */
          omega_re: number | null | (number | null)[];
          /** imaginary part of the frequency, minus the damping rate. */
          omega_im: number | null | (number | null)[];
          /** separation constant A_lm(a omega), l(l+1) - 2 at spin 0. */
          separation_re: number | null | (number | null)[];
          /** imaginary part of the separation constant. */
          separation_im: number | null | (number | null)[];
          /** Q = omega_re/(-2 omega_im). */
          quality: number | null | (number | null)[];
          /** quality factor by 2.1 + 11.3 a^3, a common formula for l = m = 2, n = 0; null for other modes. */
          quality_cubic: number | null | (number | null)[];
          /** relative error of quality_cubic. */
          quality_cubic_error: number | null | (number | null)[];
          /** omega_re by the fit of Berti et al. 2006 for l = m = 2, n = 0 to 2; null for other modes. */
          fit_omega_re: number | null | (number | null)[];
          /** quality factor by that fit. */
          fit_quality: number | null | (number | null)[];
          /** relative error of fit_omega_re. */
          fit_omega_re_error: number | null | (number | null)[];
          /** relative error of fit_quality. */
          fit_quality_error: number | null | (number | null)[];
          /** omega_re/(2 pi) for mass_msun. */
          frequency_hz: number | null | (number | null)[];
          /** time in which the amplitude falls by a factor e. */
          damping_s: number | null | (number | null)[];
          /** t for mass_msun. */
          t_s: number | null | (number | null)[];
          /** e^(omega_im t) cos(omega_re t). */
          wave: number | null | (number | null)[];
          /** frequency of the WAV file: frequency_hz shifted by shift_octaves. */
          sound_hz: number | null | (number | null)[];
          /** damping time of the WAV file: damping_s shifted by shift_octaves, times stretch. */
          sound_damping_s: number | null | (number | null)[];
        };
        units: {
          l: string;
          m: string;
          n: string;
          spin: string;
          mass_msun: string;
          t: string;
          shift_octaves: string;
          stretch: string;
          omega_re: string;
          omega_im: string;
          separation_re: string;
          separation_im: string;
          quality: string;
          quality_cubic: string;
          quality_cubic_error: string;
          fit_omega_re: string;
          fit_quality: string;
          fit_omega_re_error: string;
          fit_quality_error: string;
          frequency_hz: string;
          damping_s: string;
          t_s: string;
          wave: string;
          sound_hz: string;
          sound_damping_s: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
      'audio/wav': Uint8Array;
    };
  };
  /** the equatorial plane embedded in flat space: Flamm's paraboloid, and Kerr's. */
  'GET /v1/physics/flamm': {
    takes: {
      query?: {
        /** spin parameter a [M]; -1 to 1; default 0. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** Boyer-Lindquist radius, at or outside the horizon [M]; 1 to 1000000000; default "2:20:73". */
        r?: number | string;
        /** azimuth; ranges of azimuth and r make a mesh [degrees]; -360 to 360; default 0. */
        phi_deg?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'flamm';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          r: number | number[];
          phi_deg: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** x of the embedded surface: its radius times cos(phi). */
          x: number | null | (number | null)[];
          /** y of the embedded surface: its radius times sin(phi). */
          y: number | null | (number | null)[];
          /** z of the embedded surface: height over the horizon's circle. */
          z: number | null | (number | null)[];
          /** circumference over 2 pi, sqrt(r^2 + a^2 + a^2 (2r - Q^2)/r^2). */
          radius: number | null | (number | null)[];
          /** proper distance from the horizon along r. */
          proper_distance: number | null | (number | null)[];
          /** Flamm's paraboloid, sqrt(8 (r - 2)), which is z for a = Q = 0; null for r < 2. */
          flamm: number | null | (number | null)[];
          /** radius at which the surface begins. */
          horizon: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          r: string;
          phi_deg: string;
          x: string;
          y: string;
          z: string;
          radius: string;
          proper_distance: string;
          flamm: string;
          horizon: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** angular velocity of the dragged frame, and its far field. */
  'GET /v1/physics/frame-dragging': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** polar angle [degrees]; 0 to 180; default 90. */
        theta_deg?: number | string;
        /** radius [M]; 1 to 1000000000; default 10. */
        r?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'frame-dragging';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          theta_deg: number | number[];
          r: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** angular velocity of an observer of zero angular momentum, -g_tphi/g_phiphi. */
          omega: number | null | (number | null)[];
          /** 2J/r^3 with J = aM. */
          far_field: number | null | (number | null)[];
          /** smallest angular velocity of any observer at r; positive inside the ergosphere. */
          omega_least: number | null | (number | null)[];
          /** largest angular velocity of any observer at r; this and the smallest are null on the axis. */
          omega_most: number | null | (number | null)[];
          /** angular velocity of the horizon, a/(2 r+ - Q^2). */
          horizon_omega: number | null | (number | null)[];
          /** static limit at theta_deg. */
          ergosphere: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          theta_deg: string;
          r: string;
          omega: string;
          far_field: string;
          omega_least: string;
          omega_most: string;
          horizon_omega: string;
          ergosphere: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** free fall into the hole: proper time to the horizon and to the end. */
  'GET /v1/physics/infall': {
    takes: {
      query?: {
        /** spin parameter a [M]; -1 to 1; default 0. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** polar angle of the falling observer [degrees]; 0 to 180; default 90. */
        inclination_deg?: number | string;
        /**
         * radius at which the fall begins, at rest except for the angular momentum [M]; 1 to 10000000; default
         * "infinity".
         */
        infall_from?: 'infinity' | number | string;
        /**
         * energy per mass of the falling observer; rest: the energy that follows from infall_from; -100 to 1000;
         * default "rest".
         */
        infall_energy?: 'rest' | number | string;
        /** angular momentum per mass of the falling observer [M]; -10000 to 10000; default 0. */
        infall_momentum?: number | string;
        /** mass of the hole [solar masses]; 0.001 to 1e+12; default 100000000. */
        mass_msun?: number | string;
        /** radius of the falling observer [M]; 0.001 to 10000000; default "0.2:20:100". */
        r?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'infall';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          inclination_deg: number | number[];
          infall_from: 'infinity' | number | number[];
          infall_energy: 'rest' | number | number[];
          infall_momentum: number | number[];
          mass_msun: number | number[];
          r: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** proper time from r to the outer horizon; null inside it. */
          proper_time_to_horizon: number | null | (number | null)[];
          /**
           * proper time from r to the end of the model: the inner horizon, or without spin and charge the singularity.
           */
          proper_time_to_end: number | null | (number | null)[];
          /** proper time from r to the outer horizon, in seconds; null inside it. */
          proper_time_to_horizon_s: number | null | (number | null)[];
          /** proper time from r to the end of the model, in seconds. */
          proper_time_to_end_s: number | null | (number | null)[];
          /**
           * velocity towards the hole relative to the observer of zero angular momentum, in units of c; null inside the
           * horizon.
           */
          velocity: number | null | (number | null)[];
          /**
           * frequency of starlight from straight behind as the falling observer measures it, over its frequency at
           * infinity.
           */
          g_behind: number | null | (number | null)[];
          /**
           * change of the ingoing Kerr-Schild azimuth until the end of the model; camera.azimuth_deg is such an azimuth.
           */
          azimuth_to_end_deg: number | null | (number | null)[];
          /**
           * coordinate time until the end of the model, in ingoing Kerr-Schild coordinates, which are regular at the
           * outer horizon.
           */
          time_to_end: number | null | (number | null)[];
          /** per mass. */
          energy: number | null | (number | null)[];
          /** radius where the model ends. */
          end: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          inclination_deg: string;
          infall_from: string;
          infall_energy: string;
          infall_momentum: string;
          mass_msun: string;
          r: string;
          proper_time_to_horizon: string;
          proper_time_to_end: string;
          proper_time_to_horizon_s: string;
          proper_time_to_end_s: string;
          velocity: string;
          g_behind: string;
          azimuth_to_end_deg: string;
          time_to_end: string;
          energy: string;
          end: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** the redshift of the sky for any observer, and the size of the hole's black disk. */
  'GET /v1/physics/sky': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** polar angle of the observer [degrees]; 0 to 180; default 60. */
        inclination_deg?: number | string;
        /** radius of the observer [M]; 0.01 to 10000000; default "infinity". */
        observer_r?: 'infinity' | number | string;
        /**
         * state of motion at a finite radius; static: at rest with respect to infinity; zamo: with zero angular
         * momentum; keplerian: on a circular orbit towards +phi like the disk, at its highest latitude; retrograde: on
         * a circular orbit towards -phi, against the disk, at its highest latitude; infall: in fre; default "static".
         */
        observer?: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
        /**
         * velocity outwards, relative to the observer of zero angular momentum (observer velocity) [c]; -1 to 1;
         * default 0.
         */
        velocity_r?: number | string;
        /**
         * velocity away from the north pole, relative to the observer of zero angular momentum (observer velocity) [c];
         * -1 to 1; default 0.
         */
        velocity_theta?: number | string;
        /**
         * velocity towards +phi, relative to the observer of zero angular momentum (observer velocity) [c]; -1 to 1;
         * default 0.
         */
        velocity_phi?: number | string;
        /**
         * radius at which the observer's fall begins, at rest except for its angular momentum (observer infall) [M]; 1
         * to 10000000; default "infinity".
         */
        infall_from?: 'infinity' | number | string;
        /**
         * energy per mass of the falling observer; rest: the energy that follows from infall_from; -100 to 1000;
         * default "rest".
         */
        infall_energy?: 'rest' | number | string;
        /** angular momentum per mass of the falling observer [M]; -10000 to 10000; default 0. */
        infall_momentum?: number | string;
        /**
         * direction of g: angle to the right of the hole, as camera.yaw_deg; 180 is away from the hole [degrees]; -360
         * to 360; default "0:180:37".
         */
        yaw_deg?: number | string;
        /** direction of g: angle upwards, as camera.pitch_deg [degrees]; -90 to 90; default 0. */
        pitch_deg?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'sky';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          inclination_deg: number | number[];
          observer_r: 'infinity' | number | number[];
          observer: 'static' | 'zamo' | 'keplerian' | 'retrograde' | 'infall' | 'velocity';
          velocity_r: number | number[];
          velocity_theta: number | number[];
          velocity_phi: number | number[];
          infall_from: 'infinity' | number | number[];
          infall_energy: 'rest' | number | number[];
          infall_momentum: number | number[];
          yaw_deg: number | number[];
          pitch_deg: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /**
           * measured frequency of starlight from that direction over its frequency at infinity; null in the dark disk.
           */
          g: number | null | (number | null)[];
          /** g from straight ahead, towards the hole; null in the dark disk. */
          g_ahead: number | null | (number | null)[];
          /** g from straight behind, away from the hole; null in the dark disk. */
          g_behind: number | null | (number | null)[];
          /** g from overhead, towards -theta; null in the dark disk. */
          g_above: number | null | (number | null)[];
          /** towards +theta. */
          g_below: number | null | (number | null)[];
          /** towards +phi. */
          g_right: number | null | (number | null)[];
          /** towards -phi. */
          g_left: number | null | (number | null)[];
          /** smallest g over the visible sky. */
          g_least: number | null | (number | null)[];
          /** largest g over the visible sky. */
          g_greatest: number | null | (number | null)[];
          /** angular radius of a round disk with the solid angle of the black disk. */
          dark_radius_deg: number | null | (number | null)[];
          /** solid angle of the black disk. */
          dark_sr: number | null | (number | null)[];
          /** share of all directions in the black disk. */
          dark_share: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          inclination_deg: string;
          observer_r: string;
          velocity_r: string;
          velocity_theta: string;
          velocity_phi: string;
          infall_from: string;
          infall_energy: string;
          infall_momentum: string;
          yaw_deg: string;
          pitch_deg: string;
          g: string;
          g_ahead: string;
          g_behind: string;
          g_above: string;
          g_below: string;
          g_right: string;
          g_left: string;
          g_least: string;
          g_greatest: string;
          dark_radius_deg: string;
          dark_sr: string;
          dark_share: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** scales of a hole in kilometres, seconds and microarcseconds, with the measured rings. */
  'GET /v1/physics/scale': {
    takes: {
      query?: {
        /** a hole whose ring has been measured: M87*, Sgr A*; default "m87". */
        hole?: 'm87' | 'sgra' | 'none';
        /** spin parameter a [M]; -1 to 1; default 0. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /** polar angle of the observer, for the shadow of a hole with spin [degrees]; 0 to 180; default 0. */
        inclination_deg?: number | string;
        /** mass of the hole [solar masses]; 0.001 to 1e+12; default "hole". */
        mass_msun?: 'hole' | number | string;
        /** angular diameter distance of the hole [pc]; 0.001 to 100000000000; default "hole". */
        distance_pc?: 'hole' | number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'scale';
        parameters: {
          hole: 'm87' | 'sgra' | 'none';
          spin: number | number[];
          charge: number | number[];
          inclination_deg: number | number[];
          mass_msun: 'hole' | number | number[];
          distance_pc: 'hole' | number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** as used. */
          mass: number | null | (number | null)[];
          /** as used. */
          distance: number | null | (number | null)[];
          /** M as a length, G m/c^2. */
          m_km: number | null | (number | null)[];
          /** M as a time, G m/c^3. */
          m_s: number | null | (number | null)[];
          /** angle of M on the sky. */
          m_uas: number | null | (number | null)[];
          /** mean diameter of the shadow for this hole and inclination; 2 sqrt(27) M for a = Q = 0. */
          shadow_uas: number | null | (number | null)[];
          /** measured diameter of the ring; null if hole is none. */
          ring_uas: number | null | (number | null)[];
          /** error of the measured diameter, one sigma. */
          ring_error_uas: number | null | (number | null)[];
          /** ratio of measured to computed diameter. */
          ring_over_shadow: number | null | (number | null)[];
          /** radius of the horizon r+. */
          horizon_km: number | null | (number | null)[];
          /** radius of the horizon r+. */
          horizon_au: number | null | (number | null)[];
          /** light-crossing time of the horizon, 2 r+/c. */
          light_crossing_s: number | null | (number | null)[];
          /** period of the ISCO for an observer far away. */
          isco_period_s: number | null | (number | null)[];
          /** period of the circular photon orbit towards +phi, for an observer far away. */
          photon_period_s: number | null | (number | null)[];
          /**
           * proper time from horizon to singularity of a fall from rest at infinity, a = Q = 0: 4/3 M; null with charge.
           */
          fall_s: number | null | (number | null)[];
          /** longest proper time from horizon to singularity, a = Q = 0: pi M; null with charge. */
          fall_longest_s: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          inclination_deg: string;
          mass_msun: string;
          distance_pc: string;
          mass: string;
          distance: string;
          m_km: string;
          m_s: string;
          m_uas: string;
          shadow_uas: string;
          ring_uas: string;
          ring_error_uas: string;
          ring_over_shadow: string;
          horizon_km: string;
          horizon_au: string;
          light_crossing_s: string;
          isco_period_s: string;
          photon_period_s: string;
          fall_s: string;
          fall_longest_s: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** decay of a binary under gravitational radiation, and its chirp. */
  'GET /v1/physics/inspiral': {
    takes: {
      query?: {
        /** mass of one body [solar masses]; 1e-10 to 1e+12; default 1.4398. */
        mass1_msun?: number | string;
        /** mass of the other body [solar masses]; 1e-10 to 1e+12; default 1.3886. */
        mass2_msun?: number | string;
        /** orbital period now [s]; 1e-09 to 1e+20; default 27906.979587. */
        period_s?: number | string;
        /** eccentricity now; 0 to 0.999999; default 0.6171334. */
        eccentricity?: number | string;
        /** smaller eccentricity of the same orbit at a later time; 0 to 0.999999; default 0. */
        eccentricity_later?: number | string;
        /**
         * distance (luminosity distance, with redshifted masses and times) [pc]; 0.001 to 100000000000; default 6400.
         */
        distance_pc?: number | string;
        /**
         * time before coalescence, for the chirp of a circular orbit of these masses [s]; 1e-09 to 1e+20; default 1.
         */
        before_s?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'inspiral';
        parameters: {
          mass1_msun: number | number[];
          mass2_msun: number | number[];
          period_s: number | number[];
          eccentricity: number | number[];
          eccentricity_later: number | number[];
          distance_pc: number | number[];
          before_s: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** (m1 m2)^(3/5)/(m1 + m2)^(1/5). */
          chirp_mass: number | null | (number | null)[];
          /** m1 m2/(m1 + m2)^2. */
          eta: number | null | (number | null)[];
          /** semi-major axis a, by Kepler's law. */
          axis_km: number | null | (number | null)[];
          /** semi-major axis a, in units of the total mass M. */
          axis: number | null | (number | null)[];
          /** radiated power over the power of a circular orbit with the same a. */
          enhancement: number | null | (number | null)[];
          /** radiated power. */
          power_w: number | null | (number | null)[];
          /** da/dt. */
          axis_rate: number | null | (number | null)[];
          /** de/dt. */
          eccentricity_rate: number | null | (number | null)[];
          /** dP/dt. */
          period_rate: number | null | (number | null)[];
          /** time to coalescence. */
          time_s: number | null | (number | null)[];
          /** time to coalescence. */
          time_yr: number | null | (number | null)[];
          /** wave frequency at a = 6 M, where the chirp is cut. */
          isco_hz: number | null | (number | null)[];
          /** time before coalescence at a = 6 M. */
          isco_before_s: number | null | (number | null)[];
          /**
           * a at the time when the eccentricity is eccentricity_later; null if eccentricity_later is larger than the
           * present eccentricity.
           */
          axis_later_km: number | null | (number | null)[];
          /** time until the eccentricity is eccentricity_later; null if that is larger than the present eccentricity. */
          time_later_yr: number | null | (number | null)[];
          /** wave frequency of a circular orbit before_s before coalescence; null inside a = 6 M. */
          chirp_hz: number | null | (number | null)[];
          /** semi-major axis of a circular orbit before_s before coalescence; null inside a = 6 M. */
          chirp_axis: number | null | (number | null)[];
          /** amplitude of h+ and hx of this circular orbit, seen along the axis; null inside a = 6 M. */
          chirp_strain: number | null | (number | null)[];
        };
        units: {
          mass1_msun: string;
          mass2_msun: string;
          period_s: string;
          eccentricity: string;
          eccentricity_later: string;
          distance_pc: string;
          before_s: string;
          chirp_mass: string;
          eta: string;
          axis_km: string;
          axis: string;
          enhancement: string;
          power_w: string;
          axis_rate: string;
          eccentricity_rate: string;
          period_rate: string;
          time_s: string;
          time_yr: string;
          isco_hz: string;
          isco_before_s: string;
          axis_later_km: string;
          time_later_yr: string;
          chirp_hz: string;
          chirp_axis: string;
          chirp_strain: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** tidal disruption of a star: tidal radius, fallback, and the heaviest hole that disrupts it. */
  'GET /v1/physics/tidal': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the star's orbit is against the hole's spin [M]; -1 to 1; default 0. */
        spin?: number | string;
        /** mass of the hole [solar masses]; 0.001 to 1e+12; default 1000000. */
        mass_msun?: number | string;
        /** mass of the star [solar masses]; 0.001 to 1000; default 1. */
        star_mass_msun?: number | string;
        /** radius of the star [solar radii]; 1e-06 to 10000; default 1. */
        star_radius_rsun?: number | string;
        /** tidal radius over pericentre of its parabolic orbit; 0.1 to 100; default 1. */
        penetration?: number | string;
        /**
         * time after the disruption, for the rate of fallback; "fallback": when the first debris returns [days]; 0 to
         * 1000000000; default "fallback".
         */
        time_days?: 'fallback' | number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'tidal';
        parameters: {
          spin: number | number[];
          mass_msun: number | number[];
          star_mass_msun: number | number[];
          star_radius_rsun: number | number[];
          penetration: number | number[];
          time_days: 'fallback' | number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** r_t = R (M/m)^(1/3). */
          tidal_radius: number | null | (number | null)[];
          /** r_t. */
          tidal_radius_km: number | null | (number | null)[];
          /** outer horizon. */
          horizon: number | null | (number | null)[];
          /** parabolic orbits with a smaller pericentre are captured. */
          marginally_bound: number | null | (number | null)[];
          /** mass of a hole whose horizon is at r_t of this star (Hills). */
          hills_msun: number | null | (number | null)[];
          /** mass of a hole whose marginally bound orbit is at r_t: the heaviest that tears this star. */
          capture_msun: number | null | (number | null)[];
          /** half the range of specific energy in the debris, M R/r_t^2. */
          energy_spread: number | null | (number | null)[];
          /** time t_fb until the first debris returns. */
          fallback_s: number | null | (number | null)[];
          /** t_fb in days. */
          fallback_days: number | null | (number | null)[];
          /** largest rate of fallback, m/(3 t_fb). */
          peak_msun_yr: number | null | (number | null)[];
          /** largest rate of fallback in units of the Eddington rate, with the efficiency of this spin. */
          peak_eddington: number | null | (number | null)[];
          /** time until the rate falls to the Eddington rate; null if it never exceeds that. */
          above_eddington_days: number | null | (number | null)[];
          /** r_t over penetration. */
          pericentre: number | null | (number | null)[];
          /** pericentre over marginally_bound; below 1 the star is captured whole. */
          pericentre_over_capture: number | null | (number | null)[];
          /** rate of fallback at time_days, as t^(-5/3) after t_fb, 0 before. */
          rate_msun_yr: number | null | (number | null)[];
        };
        units: {
          spin: string;
          mass_msun: string;
          star_mass_msun: string;
          star_radius_rsun: string;
          penetration: string;
          time_days: string;
          tidal_radius: string;
          tidal_radius_km: string;
          horizon: string;
          marginally_bound: string;
          hills_msun: string;
          capture_msun: string;
          energy_spread: string;
          fallback_s: string;
          fallback_days: string;
          peak_msun_yr: string;
          peak_eddington: string;
          above_eddington_days: string;
          pericentre: string;
          pericentre_over_capture: string;
          rate_msun_yr: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /** separatrix of bound orbits: the smallest p of a stable one, by eccentricity and inclination. */
  'GET /v1/physics/separatrix': {
    takes: {
      query?: {
        /** spin parameter a; a < 0: the orbit or the disk turns against its hole [M]; -1 to 1; default 0.9. */
        spin?: number | string;
        /** charge Q of the hole; light and matter are neutral; a^2 + Q^2 < 1 [M]; -1 to 1; default 0. */
        charge?: number | string;
        /**
         * inclination of the orbit to the equator, defined as in /v1/orbits; more than 90 is retrograde [degrees]; 0 to
         * 180; default 0.
         */
        inclination_deg?: number | string;
        /** eccentricity; 0 to 0.999999; default 0. */
        e?: number | string;
        /** significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision; 1 to 17. */
        digits?: number;
        /** format of the answer, instead of Accept. */
        format?: 'json' | 'csv';
      };
    };
    gives: {
      'application/json': {
        quantity: 'separatrix';
        parameters: {
          spin: number | number[];
          charge: number | number[];
          inclination_deg: number | number[];
          e: number | number[];
        };
        ranges?: string[];
        shape?: number[];
        values: {
          /** smallest semi-latus rectum of a stable bound orbit. */
          p: number | null | (number | null)[];
          /** radius at which a body on the separatrix whirls: its periapsis p/(1 + e). */
          r_min: number | null | (number | null)[];
          /** apoapsis of this orbit, p/(1 - e). */
          r_max: number | null | (number | null)[];
          /**
           * radius of the photon orbit of this inclination; circular orbits exist above it, and are unstable below the
           * separatrix.
           */
          circle: number | null | (number | null)[];
        };
        units: {
          spin: string;
          charge: string;
          inclination_deg: string;
          e: string;
          p: string;
          r_min: string;
          r_max: string;
          circle: string;
        };
        sources: string[];
        approximations: string[];
      };
      'text/csv': string;
    };
  };
  /**
   * Timelike orbits: path, turning points, constants of motion and their drift, frequencies, periastron advance.
   */
  'POST /v1/orbits': {
    takes: {
      body: OrbitsRequest;
      type?: 'application/json';
    };
    gives: {
      'application/json': OrbitPath | OrbitPaths;
      'application/x-ndjson': Uint8Array;
      'text/csv': string;
      'application/x-npy': Uint8Array;
    };
  };
  /** The profile of a line that the gas of a thin disk emits: the share of its photons in each bin of energy. */
  'POST /v1/line': {
    takes: {
      body: LineRequest;
      type?: 'application/json';
    };
    gives: {
      'application/json': LineProfile;
      'text/csv': string;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
    };
  };
  /** Cunningham's transfer function f(g*, r) of a thin disk, near and far side. */
  'POST /v1/transfer-function': {
    takes: {
      body: TransferFunctionRequest;
      type?: 'application/json';
    };
    gives: {
      'application/json': TransferFunction;
      'text/csv': string;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
    };
  };
  /**
   * The echo of a flash on a thin disk: the share of a line's photons by energy and time, from a lamp or a ring.
   */
  'POST /v1/impulse': {
    takes: {
      body: ImpulseRequest;
      type?: 'application/json';
    };
    gives: {
      'application/json': ImpulseResponse;
      'text/csv': string;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
    };
  };
  /** Lags of that echo, diluted by the continuum: by Fourier frequency and by energy. */
  'POST /v1/lags': {
    takes: {
      body: LagsRequest;
      type?: 'application/json';
    };
    gives: {
      'application/json': Lags;
      'text/csv': string;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
    };
  };
  /** The spectrum of a thin disk of black bodies, or of a scene at one frequency, in SI units. */
  'POST /v1/spectrum': {
    takes: {
      body: SpectrumRequest;
      type?: 'application/json';
    };
    gives: {
      'application/json': DiskSpectrum | VolumeSpectrum;
      'text/csv': string;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
    };
  };
  /**
   * Visibilities of a scene's picture: amplitude and phase by baseline, for all its light and by image order.
   */
  'POST /v1/visibility': {
    takes: {
      body: VisibilityRequest;
      type?: 'application/json';
    };
    gives: {
      'application/json': Visibilities;
      'text/csv': string;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
    };
  };
  /**
   * Comparison of a scene with an interferometer's observation: amplitudes, closure phases and log closure
   * amplitudes, and chi^2 of each.
   */
  'POST /v1/compare': {
    takes: {
      body: CompareRequest;
      type?: 'application/json';
    };
    gives: {
      'application/json': Comparison | ComparisonOfSets;
      'text/csv': string;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
    };
  };
  /** Visibilities of a scene as the array of an observation would have measured them, with its noise. */
  'POST /v1/observe': {
    takes: {
      body: ObserveRequest;
      type?: 'application/json';
    };
    gives: {
      'application/json': Simulation;
      'text/csv': string;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
      'application/x-uvfits': Uint8Array;
    };
  };
  /** Opens a live session of a scene; the answer has its id and the token for changes. */
  'POST /v1/sessions': {
    takes: {
      query?: {
        /**
         * smallest width of a frame while the scene changes, as a fraction of image.width; default 0.25; 0.25 to 1.
         */
        min_scale?: number;
        /** former name of min_scale; 0.25 to 1. */
        least?: number;
        /** limit of a frame's time in ms: frames that take longer are made narrower than min_scale; 10 to 60000. */
        max_frame_ms?: number;
        /** former name of max_frame_ms; 10 to 60000. */
        patience_ms?: number;
        preset?: PresetName;
      };
      body: Scene;
      type?: 'application/json';
    };
    gives: {
      'application/json': Session;
    };
  };
  /**
   * The scene of a session; PATCH: a merge patch (RFC 7396), to which the answer with Prefer: return=minimal is
   * only the revision; DELETE: ends the session.
   */
  'GET /v1/sessions/{id}': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      'application/json': Session;
    };
  };
  /**
   * The scene of a session; PATCH: a merge patch (RFC 7396), to which the answer with Prefer: return=minimal is
   * only the revision; DELETE: ends the session.
   */
  'PATCH /v1/sessions/{id}': {
    takes: {
      path: {
        id: string;
      };
      query?: {
        /**
         * smallest width of a frame while the scene changes, as a fraction of image.width; default 0.25; 0.25 to 1.
         */
        min_scale?: number;
        /** former name of min_scale; 0.25 to 1. */
        least?: number;
        /** limit of a frame's time in ms: frames that take longer are made narrower than min_scale; 10 to 60000. */
        max_frame_ms?: number;
        /** former name of max_frame_ms; 10 to 60000. */
        patience_ms?: number;
        /**
         * order of concurrent patches: the highest number counts, and a patch that arrives after a higher one has no
         * effect; 1 to 9.00719925474e+15.
         */
        order?: number;
      };
      body: Patch<Scene>;
      type?: 'application/json' | 'application/merge-patch+json';
    };
    gives: {
      'application/json': Session | SessionPatched;
    };
  };
  /**
   * The scene of a session; PATCH: a merge patch (RFC 7396), to which the answer with Prefer: return=minimal is
   * only the revision; DELETE: ends the session.
   */
  'DELETE /v1/sessions/{id}': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      /** without a body. */
      '': undefined;
    };
  };
  /**
   * Strikes the hole: sets style.ringdown, and style.ringdown_time to the present time; the answer is the scene.
   */
  'POST /v1/sessions/{id}/ringdown': {
    takes: {
      path: {
        id: string;
      };
      body?: {
        /** new style.ringdown; default: the present value, or 1 if it is 0; 0 to 1. */
        amplitude?: number;
      };
      type?: 'application/json';
    };
    gives: {
      'application/json': Session;
    };
  };
  /** Moves a session along keyframes, whose places are in seconds; DELETE: stops it at its present state. */
  'POST /v1/sessions/{id}/path': {
    takes: {
      path: {
        id: string;
      };
      body: {
        /** up to 1000. */
        keyframes: {
          /** seconds from now; 0 to 3600. */
          at: number;
          scene?: Scene;
          /** 0 to 1e+12. */
          proper_time?: number | 'horizon' | 'end';
          ease?: 'none' | 'in' | 'out' | 'in-out';
          look_at?: 'hole' | 'free' | {
            /** 0 to 1e+12. */
            r?: number;
            /** 0 to 180. */
            theta_deg?: number;
            /** -360 to 360. */
            phi_deg?: number;
          };
        }[];
        interpolation?: 'linear' | 'smooth' | 'catmull-rom';
        distances?: 'linear' | 'geometric';
        angles?: 'as-given' | 'shorter';
        ease?: 'none' | 'in' | 'out' | 'in-out';
        look_at?: 'hole' | 'free' | {
          /** 0 to 1e+12. */
          r?: number;
          /** 0 to 180. */
          theta_deg?: number;
          /** -360 to 360. */
          phi_deg?: number;
        };
      };
      type?: 'application/json';
    };
    gives: {
      'application/json': Session;
    };
  };
  /** Moves a session along keyframes, whose places are in seconds; DELETE: stops it at its present state. */
  'DELETE /v1/sessions/{id}/path': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      /** without a body. */
      '': undefined;
    };
  };
  /** Positions of the particles, their constants and rates: 32-bit little-endian floats, row by row. */
  'GET /v1/sessions/{id}/particles': {
    takes: {
      path: {
        id: string;
      };
      query?: {
        /** number of the first particle; default 0; at least 0. */
        first?: number;
        /** step from one particle number to the next; default 1; at least 1. */
        stride?: number;
        /** number of particles; default: all; at least 1. */
        count?: number;
        /** time in M; default: the session's present time; -1e+12 to 1e+12. */
        time?: number;
        /** columns of a row; default x,y,z. */
        fields?: (
            | 'x' | 'y' | 'z' | 'r' | 'phi' | 'latitude' | 'energy' | 'angular_momentum' | 'dr_dt' | 'dphi_dt'
            | 'dlatitude_dt'
          )[];
      };
    };
    gives: {
      'application/octet-stream': Uint8Array;
    };
  };
  /** The newest frame, as soon as its number is above after; 204 if there is none within wait_ms. */
  'GET /v1/sessions/{id}/frame.png': {
    takes: {
      path: {
        id: string;
      };
      query?: {
        /** number of the client's last frame; default 0; 0 to 1e+18. */
        after?: number;
        /** longest time in ms to wait for a newer answer; 0 to 60000. */
        wait_ms?: number;
      };
    };
    gives: {
      'image/png': Uint8Array;
      /** without a body. */
      '': undefined;
    };
  };
  /**
   * The newest frame, as at frame.png; with lossy=Q, frames before the last are JPEG. PATCH: applies a merge
   * patch (RFC 7396) to the scene, and the answer is a frame of the changed scene.
   */
  'GET /v1/sessions/{id}/frame': {
    takes: {
      path: {
        id: string;
      };
      query?: {
        /** number of the client's last frame; default 0; 0 to 1e+18. */
        after?: number;
        /** longest time in ms to wait for a newer answer; 0 to 60000. */
        wait_ms?: number;
        /** quality of JPEG for frames before the last; without it all of these are PNG; 1 to 100. */
        lossy?: number;
        /** quality of JPEG for the last frame; without it that is PNG; 1 to 100. */
        last?: number;
        /**
         * Kerrd-Sentences of the client's frame; a newer frame with the same approximations omits them; 0 to
         * 4294967295.
         */
        sentences?: number;
      };
    };
    gives: {
      'image/png': Uint8Array;
      'image/jpeg': Uint8Array;
      /** without a body. */
      '': undefined;
    };
  };
  /**
   * The newest frame, as at frame.png; with lossy=Q, frames before the last are JPEG. PATCH: applies a merge
   * patch (RFC 7396) to the scene, and the answer is a frame of the changed scene.
   */
  'PATCH /v1/sessions/{id}/frame': {
    takes: {
      path: {
        id: string;
      };
      query?: {
        /**
         * order of concurrent patches: the highest number counts, and a patch that arrives after a higher one has no
         * effect; 1 to 9.00719925474e+15.
         */
        order?: number;
        /** number of the client's last frame; default 0; 0 to 1e+18. */
        after?: number;
        /** longest time in ms to wait for a newer answer; 0 to 60000. */
        wait_ms?: number;
        /** quality of JPEG for frames before the last; without it all of these are PNG; 1 to 100. */
        lossy?: number;
        /** quality of JPEG for the last frame; without it that is PNG; 1 to 100. */
        last?: number;
        /**
         * Kerrd-Sentences of the client's frame; a newer frame with the same approximations omits them; 0 to
         * 4294967295.
         */
        sentences?: number;
      };
      body: Patch<Scene>;
      type?: 'application/json' | 'application/merge-patch+json';
    };
    gives: {
      'image/png': Uint8Array;
      'image/jpeg': Uint8Array;
      /** without a body. */
      '': undefined;
    };
  };
  /**
   * Stream of the newest frames; with Accept: application/x-kerrd-frames, length, number, revision and 0 precede
   * each frame.
   */
  'GET /v1/sessions/{id}/frames': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {};
  };
  /** Stream of the numbers of each frame: its quality, times and accuracy. */
  'GET /v1/sessions/{id}/events': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {};
  };
  /** Opens a lesson, whose pupils follow a session; the answer has its id and the token of the teacher. */
  'POST /v1/lessons': {
    takes: {
      body: NewLesson;
      type?: 'application/json';
    };
    gives: {
      'application/json': Lesson;
    };
  };
  /**
   * A lesson: its session, the number of pupils, the question; with the teacher's token also who chose what.
   * PATCH: changes the session, asks or closes a question; DELETE: ends the lesson.
   */
  'GET /v1/lessons/{id}': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      'application/json': Lesson;
    };
  };
  /**
   * A lesson: its session, the number of pupils, the question; with the teacher's token also who chose what.
   * PATCH: changes the session, asks or closes a question; DELETE: ends the lesson.
   */
  'PATCH /v1/lessons/{id}': {
    takes: {
      path: {
        id: string;
      };
      body: Patch<LessonChange>;
      type?: 'application/json' | 'application/merge-patch+json';
    };
    gives: {
      'application/json': Lesson;
    };
  };
  /**
   * A lesson: its session, the number of pupils, the question; with the teacher's token also who chose what.
   * PATCH: changes the session, asks or closes a question; DELETE: ends the lesson.
   */
  'DELETE /v1/lessons/{id}': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      /** without a body. */
      '': undefined;
    };
  };
  /** Reports that a pupil is present, and which choice it makes; the answer is the lesson. */
  'POST /v1/lessons/{id}/hands': {
    takes: {
      path: {
        id: string;
      };
      body: {
        pupil: string;
        name?: string;
        /** 1 to 1000000000. */
        question?: number;
        /** 0 to 5. */
        choice?: number;
      };
      type?: 'application/json';
    };
    gives: {
      'application/json': Lesson;
    };
  };
  /**
   * Presets, settings and fields of a body; POST: opens a playground, and the answer has its id and the token for
   * changes.
   */
  'GET /v1/playground': {
    takes: {};
    gives: {
      'application/json': PlaygroundCatalogue;
    };
  };
  /**
   * Presets, settings and fields of a body; POST: opens a playground, and the answer has its id and the token for
   * changes.
   */
  'POST /v1/playground': {
    takes: {
      body: Playground;
      type?: 'application/json';
    };
    gives: {
      'application/json': PlaygroundStatus;
    };
  };
  /** State of a playground; PATCH: changes its pace, settings and bodies; DELETE: ends it. */
  'GET /v1/playground/{id}': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      'application/json': PlaygroundStatus;
    };
  };
  /** State of a playground; PATCH: changes its pace, settings and bodies; DELETE: ends it. */
  'PATCH /v1/playground/{id}': {
    takes: {
      path: {
        id: string;
      };
      body: Patch<PlaygroundChange>;
      type?: 'application/json' | 'application/merge-patch+json';
    };
    gives: {
      'application/json': PlaygroundStatus;
    };
  };
  /** State of a playground; PATCH: changes its pace, settings and bodies; DELETE: ends it. */
  'DELETE /v1/playground/{id}': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      /** without a body. */
      '': undefined;
    };
  };
  /** Advances a paused playground, as `kerrd playground --time` does. */
  'POST /v1/playground/{id}/step': {
    takes: {
      path: {
        id: string;
      };
      body: {
        /** M; 0 to 1e+12. */
        by: number;
      };
      type?: 'application/json';
    };
    gives: {
      'application/json': PlaygroundStatus;
    };
  };
  /** Stream of the numbers of a playground (tick) and of its numbered events (happened), each event once. */
  'GET /v1/playground/{id}/events': {
    takes: {
      path: {
        id: string;
      };
      query?: {
        /**
         * number of the event after which the stream begins, like Last-Event-ID; default: all stored events; 0 to
         * 1e+18.
         */
        since?: number;
      };
    };
    gives: {};
  };
  /**
   * The bodies of a playground as packed 32-bit words: a header of eight, then ten for each body; 204 if there is
   * nothing new within wait_ms.
   */
  'GET /v1/playground/{id}/bodies': {
    takes: {
      path: {
        id: string;
      };
      query?: {
        /** generation of the client's data; without it the answer is immediate; 0 to 1e+18. */
        after?: number;
        /** longest time in ms to wait for a newer answer; 0 to 60000. */
        wait_ms?: number;
      };
    };
    gives: {
      'application/octet-stream': Uint8Array;
      'application/x-npy': Uint8Array;
      /** without a body. */
      '': undefined;
    };
  };
  /**
   * A subset of the debris as packed 32-bit words: a header of eight, then four for each piece; 204 if there is
   * nothing new within wait_ms.
   */
  'GET /v1/playground/{id}/debris': {
    takes: {
      path: {
        id: string;
      };
      query?: {
        /** generation of the client's data; without it the answer is immediate; 0 to 1e+18. */
        after?: number;
        /** longest time in ms to wait for a newer answer; 0 to 60000. */
        wait_ms?: number;
        /** largest number of pieces; of more, the answer has every k-th; default 20000; 1 to 1000000. */
        at_most?: number;
      };
    };
    gives: {
      'application/octet-stream': Uint8Array;
      'application/x-npy': Uint8Array;
      /** without a body. */
      '': undefined;
    };
  };
  /**
   * The newest picture of a playground, as soon as its number is above after; 204 if there is none within
   * wait_ms.
   */
  'GET /v1/playground/{id}/frame.png': {
    takes: {
      path: {
        id: string;
      };
      query?: {
        /** number of the client's last frame; default 0; 0 to 1e+18. */
        after?: number;
        /** longest time in ms to wait for a newer answer; 0 to 60000. */
        wait_ms?: number;
      };
    };
    gives: {
      'image/png': Uint8Array;
      /** without a body. */
      '': undefined;
    };
  };
  /** Stream of the newest pictures of a playground, as for a session. */
  'GET /v1/playground/{id}/frames': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {};
  };
  /** A snapshot, from which a playground continues exactly, here or on the command line. */
  'GET /v1/playground/{id}/snapshot': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      'application/json': Playground;
    };
  };
  /** Energy, angular momentum, separation, wave frequency, strain and debris over time. */
  'GET /v1/playground/{id}/series': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      'text/csv': string;
      'application/x-npy': Uint8Array;
      'application/json': PlaygroundSeries;
    };
  };
  /** Rate at which debris has returned, with the law t^(-5/3) for comparison. */
  'GET /v1/playground/{id}/fallback': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      'text/csv': string;
      'application/x-npy': Uint8Array;
    };
  };
  /**
   * Number of assets and its limit; PUT: stores a picture, a grid of matter or an observation, and the answer has
   * its SHA-256 and the token that deletes it.
   */
  'GET /v1/assets': {
    takes: {};
    gives: {
      'application/json': Assets;
    };
  };
  /**
   * Number of assets and its limit; PUT: stores a picture, a grid of matter or an observation, and the answer has
   * its SHA-256 and the token that deletes it.
   */
  'PUT /v1/assets': {
    takes: {
      body: Binary;
      type: 'image/png' | 'application/x-npz' | 'application/x-uvfits' | 'text/csv';
    };
    gives: {
      'application/json': Asset;
    };
  };
  /** The bytes of an asset; DELETE: deletes it. */
  'GET /v1/assets/{sha256}': {
    takes: {
      path: {
        sha256: string;
      };
    };
    gives: {
      'image/png': Uint8Array;
      'application/x-npz': Uint8Array;
      'application/x-uvfits': Uint8Array;
      'text/csv': string;
    };
  };
  /** The bytes of an asset; DELETE: deletes it. */
  'DELETE /v1/assets/{sha256}': {
    takes: {
      path: {
        sha256: string;
      };
    };
    gives: {
      /** without a body. */
      '': undefined;
    };
  };
  /**
   * Starts a job of one scene, of a list, or of a scene with keyframes; the answer has its id and the token that
   * ends it.
   */
  'POST /v1/jobs': {
    takes: {
      query?: {
        preset?: PresetName;
      };
      body: {
        scene: Scene;
        /** up to 1000. */
        keyframes?: {
          /** 0 to 9999. */
          frame: number;
          scene?: Scene;
          /** 0 to 1e+12. */
          proper_time?: number | 'horizon' | 'end';
          ease?: 'none' | 'in' | 'out' | 'in-out';
          look_at?: 'hole' | 'free' | {
            /** 0 to 1e+12. */
            r?: number;
            /** 0 to 180. */
            theta_deg?: number;
            /** -360 to 360. */
            phi_deg?: number;
          };
        }[];
        interpolation?: 'linear' | 'smooth' | 'catmull-rom';
        distances?: 'linear' | 'geometric';
        angles?: 'as-given' | 'shorter';
        ease?: 'none' | 'in' | 'out' | 'in-out';
        look_at?: 'hole' | 'free' | {
          /** 0 to 1e+12. */
          r?: number;
          /** 0 to 180. */
          theta_deg?: number;
          /** -360 to 360. */
          phi_deg?: number;
        };
        /** 1 to 10000. */
        frames?: number;
        motion_blur?: {
          /** 1 to 64. */
          samples: number;
          /** open time of the shutter, as a fraction of a frame's time; 0 to 1; default 0.5. */
          shutter?: number;
        };
        exposure?: 'one' | 'each';
        output?: 'pictures' | 'layers' | 'npy' | 'npz' | 'fits' | 'exr' | 'light-curve';
      } | {
        scene?: Scene;
        axes: SweepAxes;
        exposure?: 'each';
        output?: 'pictures' | 'layers' | 'npy' | 'npz' | 'fits' | 'exr' | 'cube' | 'light-curve';
      } | {
        /**
         * a document of a playground, or a snapshot, as POST /v1/playground takes them, without rate, paused and scene.
         */
        playground: Playground;
        /** time in M from one frame to the next; 0 to 1e+12. */
        every: number;
        scene?: Scene;
        /** up to 1000. */
        keyframes?: {
          /** 0 to 9999. */
          frame: number;
          scene?: Scene;
          /** 0 to 1e+12. */
          proper_time?: number | 'horizon' | 'end';
          ease?: 'none' | 'in' | 'out' | 'in-out';
          look_at?: 'hole' | 'free' | {
            /** 0 to 1e+12. */
            r?: number;
            /** 0 to 180. */
            theta_deg?: number;
            /** -360 to 360. */
            phi_deg?: number;
          };
        }[];
        interpolation?: 'linear' | 'smooth' | 'catmull-rom';
        distances?: 'linear' | 'geometric';
        angles?: 'as-given' | 'shorter';
        ease?: 'none' | 'in' | 'out' | 'in-out';
        look_at?: 'hole' | 'free' | {
          /** 0 to 1e+12. */
          r?: number;
          /** 0 to 180. */
          theta_deg?: number;
          /** -360 to 360. */
          phi_deg?: number;
        };
        /** 1 to 10000. */
        frames?: number;
        exposure?: 'each';
        output?: 'pictures' | 'layers' | 'npy' | 'npz' | 'fits' | 'exr' | 'light-curve';
      } | {
        /** up to 10000. */
        scenes: Scene[];
        exposure?: 'one' | 'each';
        output?: 'pictures' | 'layers' | 'npy' | 'npz' | 'fits' | 'exr' | 'light-curve';
      };
      type?: 'application/json';
    };
    gives: {
      'application/json': Job;
    };
  };
  /** Progress of a job; DELETE: ends it and deletes its files. */
  'GET /v1/jobs/{id}': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      'application/json': Job;
    };
  };
  /** Progress of a job; DELETE: ends it and deletes its files. */
  'DELETE /v1/jobs/{id}': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      /** without a body. */
      '': undefined;
    };
  };
  /** Stream of the progress of a job. */
  'GET /v1/jobs/{id}/events': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {};
  };
  /**
   * The finished part of the unfinished frame, or otherwise the last finished frame; 409 while there is neither.
   */
  'GET /v1/jobs/{id}/preview.png': {
    takes: {
      path: {
        id: string;
      };
    };
    gives: {
      'image/png': Uint8Array;
    };
  };
  /**
   * The picture of a job with one frame, or a ZIP of all frames; with format=png one frame, with format=stream
   * the frames as they finish; for a sweep with output cube one array for each layer, as application/fits or with
   * format=npz; for a light curve its rows, as application/json or text/csv.
   */
  'GET /v1/jobs/{id}/result': {
    takes: {
      path: {
        id: string;
      };
      query?: {
        /**
         * json and csv: a light curve; fits and npz without frame: the cube of a sweep; mp4 and webm: a film of
         * pictures, by the program ffmpeg; the others: pictures or files of numbers.
         */
        format?: 'zip' | 'mp4' | 'webm' | 'png' | 'stream' | 'npy' | 'npz' | 'fits' | 'exr' | 'json' | 'csv';
        /**
         * number of a single frame, with format=png, fits, npz, npy or exr; with format=stream, number of the first
         * frame; 0 to 1e+18.
         */
        frame?: number;
        /** frames a second, with format=mp4 or webm; default 24; 1 to 120. */
        rate?: number;
      };
    };
    gives: {
      'application/zip': Uint8Array;
      'video/mp4': Uint8Array;
      'video/webm': Uint8Array;
      'image/png': Uint8Array;
      'application/x-kerrd-frames': Uint8Array;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
      'application/fits': Uint8Array;
      'image/x-exr': Uint8Array;
      'application/json': unknown;
      'text/csv': string;
    };
  };
  /**
   * Explanation of one pixel of a scene's picture: its ray, what the ray crosses, the light of each emitter,
   * where the ray ends and why; with trace=steps the engine's steps along it.
   */
  'GET /v1/pixel': {
    takes: {
      query: SceneQuery & {
        /** position X,Y of the pixel, in pixels from the upper left corner. */
        at: string;
        /** steps: the answer has the engine's steps along the middle ray. */
        trace?: 'steps';
        preset?: PresetName;
      };
    };
    gives: {
      'application/json': Pixel;
    };
  };
  /**
   * Explanation of one pixel of a scene's picture: its ray, what the ray crosses, the light of each emitter,
   * where the ray ends and why; with trace=steps the engine's steps along it.
   */
  'POST /v1/pixel': {
    takes: {
      query: {
        /** position X,Y of the pixel, in pixels from the upper left corner. */
        at: string;
        /** steps: the answer has the engine's steps along the middle ray. */
        trace?: 'steps';
        preset?: PresetName;
      };
      body: Scene;
      type?: 'application/json';
    };
    gives: {
      'application/json': Pixel;
    };
  };
  /** A short address of a scene, for sharing. */
  'GET /v1/share': {
    takes: {
      query?: SceneQuery & {
        /**
         * for two pictures side by side: what differs on the right, as a query of fields, spacetime.spin=0.998; or
         * data=1 for the measurements of M87*.
         */
        pair?: string;
        preset?: PresetName;
      };
    };
    gives: {
      'application/json': Share;
    };
  };
  /** A short address of a scene, for sharing. */
  'POST /v1/share': {
    takes: {
      query?: {
        /**
         * for two pictures side by side: what differs on the right, as a query of fields, spacetime.spin=0.998; or
         * data=1 for the measurements of M87*.
         */
        pair?: string;
        preset?: PresetName;
      };
      body: Scene;
      type?: 'application/json';
    };
    gives: {
      'application/json': Share;
    };
  };
  /** The picture of a shared scene, 1200 by 630 pixels. */
  'GET /v1/share/{code}/picture.png': {
    takes: {
      path: {
        code: string;
      };
      query?: {
        /** width in pixels, from which the height follows; default 1200; 64 to 1200. */
        width?: number;
      };
    };
    gives: {
      'image/png': Uint8Array;
    };
  };
  /** The picture of a scene. */
  'GET /v1/render': {
    takes: {
      query?: SceneQuery & {
        /** format of the picture, instead of Accept. */
        format?: 'png' | 'jpg' | 'webp' | 'npy' | 'npz' | 'fits' | 'exr' | 'stars';
        /** quality of a jpg or webp, default 90; without format, the answer is one of them; 1 to 100. */
        quality?: number;
        /**
         * version for which the address was made: if it is this server's, and the scene names no asset, caches may keep
         * the picture for a year.
         */
        v?: string;
        preset?: PresetName;
      };
    };
    gives: {
      'image/png': Uint8Array;
      'image/jpeg': Uint8Array;
      'image/webp': Uint8Array;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
      'application/fits': Uint8Array;
      'image/x-exr': Uint8Array;
      'application/vnd.kerrd.stars+json': Stars;
    };
  };
  /** The picture of a scene. */
  'POST /v1/render': {
    takes: {
      query?: {
        /** format of the picture, instead of Accept. */
        format?: 'png' | 'jpg' | 'webp' | 'npy' | 'npz' | 'fits' | 'exr' | 'stars';
        /** quality of a jpg or webp, default 90; without format, the answer is one of them; 1 to 100. */
        quality?: number;
        /**
         * version for which the address was made: if it is this server's, and the scene names no asset, caches may keep
         * the picture for a year.
         */
        v?: string;
        preset?: PresetName;
      };
      body: Scene;
      type?: 'application/json';
    };
    gives: {
      'image/png': Uint8Array;
      'image/jpeg': Uint8Array;
      'image/webp': Uint8Array;
      'application/x-npy': Uint8Array;
      'application/x-npz': Uint8Array;
      'application/fits': Uint8Array;
      'image/x-exr': Uint8Array;
      'application/vnd.kerrd.stars+json': Stars;
    };
  };
}

/** A method and a path. */
export type Operation = keyof Operations;

/** The media types of an operation's answers. */
export type MediaOf<O extends Operation> = keyof Operations[O]['gives'] & string;

/** What an answer holds, of the media types that were asked for. */
export type DataOf<O extends Operation, M extends MediaOf<O> = MediaOf<O>> =
  | Operations[O]['gives'][M]
  | ('' extends keyof Operations[O]['gives'] ? undefined : never);

/** What a request may say beside its parameters and its body. */
export interface Sending<M extends string = string> {
  /** Which media type the answer has, where there are several. */
  accept?: M;
  /** The token of the session, playground, job or asset. */
  token?: string;
  /** Further headers. */
  headers?: Record<string, string>;
  /** Ends the request, and waiting to send it again. */
  signal?: AbortSignal;
  /** Seconds for which a busy server is asked again. */
  patience?: number;
}

/** Parameters and body of an operation, and how they are sent; may be left out where nothing is needed. */
export type Options<O extends Operation, M extends MediaOf<O> = MediaOf<O>> = {} extends Operations[O]['takes']
  ? [options?: Operations[O]['takes'] & Sending<M>]
  : [options: Operations[O]['takes'] & Sending<M>];
