"""The scene as dataclasses, written by generate.py from the schema; None leaves a field to the server."""

# This file is generated: change src/scene/fields.h, then run clients/python/generate.py.

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

__all__ = ["Accuracy", "Body", "Camera", "Disk", "Flash", "Gas", "Image", "Jets", "Motion", "Polarization", "Scene", "Sky", "Source", "Spacetime", "Spot", "Style", "Tile", "Volume"]


@dataclass
class Spacetime:
    """The hole.

    spin: spin parameter a; a < 0: the disk is retrograde to its hole; in M; -0.999999999999 to 0.999999999999; default 0.7.
    charge: electric charge Q of the hole (Kerr-Newman), which acts on space-time alone: light and matter are neutral; in M; 0 to
        0.999999999999; default 0.
    mass_msun: mass of the hole; sets the temperature when disk.colour is "accretion"; in solar masses; 0.001 to 1e+12; default
        100000000.
    distance_pc: angular diameter distance of the hole; with the mass it determines the width of a picture on the sky, for a beam and a
        scale bar; in pc; 0.001 to 100000000000; default 260000.
    """

    spin: float | None = None
    charge: float | None = None
    mass_msun: float | None = None
    distance_pc: float | None = None


@dataclass
class Camera:
    """Position, motion and view of the observer.

    r: Boyer-Lindquist radius of the observer; in M; 0.01 to 10000000; default "infinity".
    inclination_deg: polar angle of the observer: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to 180; default
        82.
    azimuth_deg: Boyer-Lindquist azimuth of the observer; for a falling observer the ingoing Kerr-Schild azimuth, which is the same far
        away; in degrees; -360 to 360; default 0.
    observer: state of motion at a finite radius; static: at rest with respect to infinity; zamo: with zero angular momentum; keplerian:
        on a circular orbit towards +phi like the disk, at its highest latitude; retrograde: on a circular orbit towards -phi, against
        the disk, at its highest latitude; infall: in free fall, by default from rest at infinity; velocity: with any velocity relative
        to the observer of zero angular momentum; default "static".
    velocity_r: outward velocity in the frame of the local observer of zero angular momentum (observer: velocity); in c; -1 to 1;
        default 0.
    velocity_theta: velocity away from the north pole, in the frame of the local observer of zero angular momentum (observer: velocity);
        in c; -1 to 1; default 0.
    velocity_phi: velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (observer: velocity);
        in c; -1 to 1; default 0.
    infall_from: radius at which the observer's fall begins, at rest except for its angular momentum (observer: infall); in M; 1 to
        10000000; default "infinity".
    infall_energy: energy per mass of the falling observer; rest: the energy that follows from infall_from (observer: infall); -100 to
        1000; default "rest".
    infall_momentum: angular momentum per mass of the falling observer, which moves in r and azimuth but not in latitude (observer:
        infall); in M; -10000 to 10000; default 0.
    projection: plane: parallel rays, image plane in M, at infinity only; pinhole: at a finite radius only; ring: the angle round the
        critical curve across, the logarithm of the distance to it upwards, at infinity only; equirectangular: all directions from a
        finite radius, longitude to the right and latitude upwards; fulldome: the angle from the middle as distance, 90 degrees at the
        nearer edges, from a finite radius; auto: plane at infinity, otherwise pinhole; default "auto".
    field_m: width of the image plane (plane projection); in M; 1e-06 to 10000000; default 46.
    field_uas: width of the image plane on the sky, at spacetime.mass_msun and spacetime.distance_pc; it sets camera.field_m; none:
        camera.field_m is used; in microarcseconds; 1e-12 to 1e+12; default "none".
    fov_deg: horizontal field of view (pinhole projection); in degrees; 1e-06 to 179; default 50.
    centre_alpha: image-plane alpha at the middle of the picture (plane); in M; -10000000 to 10000000; default 0.
    centre_beta: image-plane beta at the middle of the picture (plane); in M; -10000000 to 10000000; default 0.
    yaw_deg: look to the right of the hole (from a finite radius); in degrees; -180 to 180; default 0.
    pitch_deg: look above the hole (from a finite radius); in degrees; -90 to 90; default 0.
    roll_deg: turn the camera clockwise about its axis; ring: the angle in the middle of the picture, 0 at alpha > 0, rising to the
        right; in degrees; -360 to 360; default 0.
    stereo: pair: two pictures side by side, the left eye's on the left, each image.width wide and in pinhole projection; none: one eye;
        default "none".
    eye_distance: distance between the eyes, perpendicular to the viewing direction (stereo: pair); in M; 1e-06 to 1000000; default 0.5.
    ring_decades_max: log10 of the distance between the critical curve and the picture's upper and lower edges, in units of the curve's
        radius (ring); in decades; -12 to 0; default 0.
    ring_decades_min: log10 of the distance to the critical curve at the picture's middle line; rays above the line pass outside the
        curve, rays below it inside (ring); in decades; -13 to -1; default -10.
    """

    r: Literal['infinity'] | float | None = None
    inclination_deg: float | None = None
    azimuth_deg: float | None = None
    observer: Literal['static', 'zamo', 'keplerian', 'retrograde', 'infall', 'velocity'] | None = None
    velocity_r: float | None = None
    velocity_theta: float | None = None
    velocity_phi: float | None = None
    infall_from: Literal['infinity'] | float | None = None
    infall_energy: Literal['rest'] | float | None = None
    infall_momentum: float | None = None
    projection: Literal['auto', 'plane', 'pinhole', 'ring', 'equirectangular', 'fulldome'] | None = None
    field_m: float | None = None
    field_uas: Literal['none'] | float | None = None
    fov_deg: float | None = None
    centre_alpha: float | None = None
    centre_beta: float | None = None
    yaw_deg: float | None = None
    pitch_deg: float | None = None
    roll_deg: float | None = None
    stereo: Literal['none', 'pair'] | None = None
    eye_distance: float | None = None
    ring_decades_max: float | None = None
    ring_decades_min: float | None = None


@dataclass
class Gas:
    """Turbulence in the gas of the smooth disk models.

    amplitude: turbulence: standard deviation of the logarithm of the flux, and of the optical depth; 0: a smooth disk; 0 to 3; default
        0.8.
    octaves: number of scales of the turbulence; each scale is about half the one before; 1 to 8; default 6.
    scale: size of the largest eddies over r, before shear stretches them; 0.02 to 2; default 0.4.
    shear: azimuth by which streaks trail, in radians for each unit of ln r; below 0 they lead. Streaks are 1 + shear^2 times as long as
        they are wide; -20 to 20; default 5.
    seed: seed of the random numbers of the turbulence; 0 to 2147483647; default 1.
    """

    amplitude: float | None = None
    octaves: int | None = None
    scale: float | None = None
    shear: float | None = None
    seed: int | None = None


@dataclass
class Disk:
    """The accretion disk in the equatorial plane, turning towards +phi.

    model: radial flux: none; the exact Page-Thorne integral; the Newtonian thin disk cut at the ISCO; or particles: the exact flux, as
        orbiting particles; default "novikov-thorne".
    inner: inner edge; at least the ISCO; in M; 1 to 1000000; default "isco".
    outer: outer edge; larger than the inner one; in M; 1 to 1000000; default 22.
    taper: outer fraction of the radius over which the disk fades out; 0: a sharp edge; 0 to 1; default 0.7.
    opacity: opacity of one crossing; 1 is optically thick; 0 to 1; default 1.
    emission_opacity: optical depth along the normal where the disk is brightest; elsewhere it is proportional to the flux. A crossing
        has the opacity 1 - exp(-depth/cos) times disk.opacity, with the angle of emission in the gas's frame; 0: the same opacity
        everywhere; 0 to 1000000; default 10.
    height: relative half height H/R at R = 10 M: H is the height above the plane at which the density has fallen to exp(-1/2), R the
        distance from the axis; the optical depth from top to bottom is that of the thin disk; 0: a thin disk; 0 to 0.5; default 0.
    flare: exponent p: H/R is proportional to R^p (disk.height); -0.5 to 0.5; default 0.
    colour: temperature scale: a chosen peak temperature, or from spacetime.mass_msun and disk.mdot_edd; default "peak".
    peak_temperature_k: largest effective temperature of the disk, in its own frame (colour: peak); in K; 300 to 1000000000; default
        3600.
    mdot_edd: accretion rate: luminosity over the Eddington luminosity, with the efficiency for this spin; in Eddington rates; 1e-12 to
        1000; default 0.1.
    hardening: colour temperature over effective temperature; 1 to 3; default 1.
    atmosphere: how the light of the thin disk's surface depends on mu, the cosine of the angle to its normal in the gas's frame.
        isotropic; laor: as 1 + 2.06 mu; scattering: as from a deep atmosphere of free electrons, which polarization.model "scattering"
        polarises. Each law has the disk's flux; default "isotropic".
    returning: light that the hole bends back to the disk. none: it is ignored; thermalised: the disk absorbs it with its angular
        momentum, and radiates it again as a black body; reflected: the disk reflects the share disk.albedo with the spectrum of the
        arriving light, and thermalises the rest. Light may return any number of times; default "none".
    albedo: share of the returning light that is reflected; 0 to 1; default 0.5.
    band: brightness: bolometric, g^4 F; visible, the luminance that the eye perceives of the Planck spectrum; or frequency, the
        specific intensity at disk.frequency_ghz, in physical units; default "bolometric".
    frequency_ghz: observed frequency (band: frequency); in GHz; 1e-06 to 1e+12; default 230.
    doppler: include the Doppler shift and beaming of the orbiting gas; default true.
    redshift: include the gravitational redshift and time dilation of the orbiting gas; default true.
    particles: number of particles (model: particles); 1000 to 10000000; default 300000.
    seed: seed of the random numbers that place the particles (model: particles); 0 to 2147483647; default 1.
    density_index: p: the number of particles per area is proportional to r^-p; for p = 2 every octave of r has the same number (model:
        particles); 0 to 4; default 2.
    plunging: share of the particles that fall from the ISCO, with its energy and angular momentum; none fall unless disk.inner is
        "isco" (model: particles); 0 to 0.5; default 0.02.
    plunging_temperature: temperature of the plunging gas over the disk's largest temperature; 0: it is invisible (model: particles); 0
        to 1; default 0.7.
    epicycles: largest amplitude of oscillations in latitude, in radians; times (kappa/Omega)^2, which vanishes at the ISCO, also the
        largest relative amplitude of oscillations in r (model: particles); 0 to 0.2; default 0.02.
    slow_light: show particles, gas, spots and a flash at the time when the light of each ray left them, instead of at one coordinate
        time; default false.
    gas: turbulence in the gas of the smooth disk models.
    """

    model: Literal['none', 'novikov-thorne', 'shakura-sunyaev', 'particles'] | None = None
    inner: Literal['isco'] | float | None = None
    outer: float | None = None
    taper: float | None = None
    opacity: float | None = None
    emission_opacity: float | None = None
    height: float | None = None
    flare: float | None = None
    colour: Literal['peak', 'accretion'] | None = None
    peak_temperature_k: float | None = None
    mdot_edd: float | None = None
    hardening: float | None = None
    atmosphere: Literal['isotropic', 'laor', 'scattering'] | None = None
    returning: Literal['none', 'thermalised', 'reflected'] | None = None
    albedo: float | None = None
    band: Literal['bolometric', 'visible', 'frequency'] | None = None
    frequency_ghz: float | None = None
    doppler: bool | None = None
    redshift: bool | None = None
    particles: int | None = None
    seed: int | None = None
    density_index: float | None = None
    plunging: float | None = None
    plunging_temperature: float | None = None
    epicycles: float | None = None
    slow_light: bool | None = None
    gas: Gas | None = None


@dataclass
class Spot:
    """One of `spots`.

    brightness: surface brightness at the spot's centre in the gas's frame, in units of the disk's brightest; 0: no spot; 0 to 1000000;
        default 0.
    r: radius of the circular orbit of the spot's centre; at least the ISCO; in M; 1 to 1000000; default 9.
    phase_deg: azimuth of the spot's centre at time 0; in degrees; -360 to 360; default 0.
    size: distance from the spot's centre at which the brightness has fallen to exp(-1/2); in M; 0.001 to 100000; default 1.
    index: spectral index: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 + index); -4 to 6;
        default 1.
    temperature_k: colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000.
    """

    brightness: float | None = None
    r: float | None = None
    phase_deg: float | None = None
    size: float | None = None
    index: float | None = None
    temperature_k: float | None = None


@dataclass
class Flash:
    """A flash of a lamp on the axis, which runs over the thin disk.

    brightness: surface brightness in the gas's frame where the flash lights the disk most, at its peak, in units of the disk's
        brightest; 0: no flash; 0 to 1000000; default 0.
    height: Boyer-Lindquist radius of the lamp on the axis; at least 1.05 times that of the horizon; in M; 1 to 10000; default 10.
    start: coordinate time at which the lamp is brightest; in M; -1e+12 to 1e+12; default 0.
    duration: time before and after the peak at which the lamp's light is exp(-1/2) of the peak; in M; 0.001 to 1000000; default 1.
    period: time from one flash to the next, at least 12 times flash.duration; 0: one flash only; in M; 0 to 1000000000; default 0.
    photon_index: photon index Gamma of the lamp: it emits E^-Gamma photons per energy, which sets how its light on the disk depends on
        the shift from the lamp to the gas; 1 to 4; default 2.
    index: spectral index of the lit gas: I_nu falls as nu to this power, so that the observed brightness is multiplied by g^(3 +
        index); -4 to 6; default 0.
    temperature_k: colour of the lit gas: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 6500.
    """

    brightness: float | None = None
    height: float | None = None
    start: float | None = None
    duration: float | None = None
    period: float | None = None
    photon_index: float | None = None
    index: float | None = None
    temperature_k: float | None = None


@dataclass
class Body:
    """One of `bodies`.

    radius: radius of the sphere in its own frame; 0: no body; in M; 0 to 1000000; default 0.
    r: Boyer-Lindquist radius of the body's centre, at least 1.05 times that of the horizon; in M; 1 to 10000000; default 15.
    inclination_deg: polar angle of the body's centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to 180;
        default 90.
    phase_deg: azimuth of the body's centre at time 0; 0 is that of camera.azimuth_deg 0; in degrees; -360 to 360; default 0.
    motion: state of motion, which shifts the body's light; static, zamo, keplerian and retrograde move it round with time, the last two
        only in the disk's plane; static: at rest with respect to infinity; zamo: with zero angular momentum; keplerian: on a circular
        orbit towards +phi like the disk, at its highest latitude; retrograde: on a circular orbit towards -phi, against the disk, at
        its highest latitude; infall: in free fall, by default from rest at infinity; velocity: with any velocity relative to the
        observer of zero angular momentum; default "keplerian".
    velocity_r: outward velocity in the frame of the local observer of zero angular momentum (motion: velocity); in c; -1 to 1; default
        0.
    velocity_theta: velocity away from the north pole, in the frame of the local observer of zero angular momentum (motion: velocity);
        in c; -1 to 1; default 0.
    velocity_phi: velocity along the disk's rotation, in the frame of the local observer of zero angular momentum (motion: velocity); in
        c; -1 to 1; default 0.
    temperature_k: temperature of the body, which shines as a black body shifted by g; in K; 300 to 1000000000; default 6000.
    brightness: surface brightness over that of a black body, on the scale of the disk's temperatures; 0: dark; 0 to 1000000000; default
        1.
    limb_darkening: fraction by which the rim is darker than the middle, linear in the cosine of the angle; 0: none; 0 to 1; default
        0.6.
    """

    radius: float | None = None
    r: float | None = None
    inclination_deg: float | None = None
    phase_deg: float | None = None
    motion: Literal['static', 'zamo', 'keplerian', 'retrograde', 'infall', 'velocity'] | None = None
    velocity_r: float | None = None
    velocity_theta: float | None = None
    velocity_phi: float | None = None
    temperature_k: float | None = None
    brightness: float | None = None
    limb_darkening: float | None = None


@dataclass
class Volume:
    """Matter along the rays.

    model: matter along the rays. none; uniform: a homogeneous shell at rest. At one radio frequency: gold, the analytic model of Gold
        et al. 2020; riaf, a hot, thin flow whose density, temperature and magnetic field are powers of r; torus, a thick disk in
        equilibrium; grid, numbers from a file; default "none".
    inner: inner edge; horizon: 1 % outside the horizon, or 0.05 % for the models at a radio frequency; for a torus, half of
        volume.torus_radius; in M; 1 to 30000; default "horizon".
    outer: outer edge of the matter; larger than the inner edge; in M; 1 to 30000; default 20.
    emissivity: light emitted along 1 M in the matter's frame, in units of the disk's brightest (model: uniform); in 1/M; 0 to 1e+30;
        default 0.02.
    opacity: optical depth of 1 M in the matter's frame (model: uniform); in 1/M; 0 to 1e+30; default 0.02.
    temperature_k: colour: that of a black body of this temperature, shifted by g (model: uniform); in K; 300 to 1000000000; default
        6500.
    redshift: include the frequency shift of the matter (model: uniform); default true.
    frequency_ghz: observed frequency (models: gold, riaf, torus, grid); in GHz; 1e-06 to 1e+12; default 230.
    grid: NPZ file with density, temperature, velocity and magnetic field of the electrons on a grid of r, theta and phi (model: grid);
        without it there is no matter; default null.
    grid_scale: factor on the file's density; the magnetic field is multiplied by the square root of it (model: grid); 0 to 1e+30;
        default 1.
    slow_light: show each place of a grid with several frames at the time when its light left it, instead of the whole grid at `time`
        (model: grid); default false.
    gold_emission: C n0: emissivity at 230 GHz at the largest density (model: gold); in erg/(s cm^3 Hz sr); 0 to 1e+30; default 3e-18.
    gold_index: alpha: emissivity goes as nu^-alpha, absorptivity as nu^-(2.5 + alpha) (model: gold); -10 to 10; default 0.
    gold_flattening: h: density goes as exp(-(h cos(theta))^2/2); 0: round (model: gold); 0 to 10000; default 0.
    gold_momentum: l0: angular momentum over energy is l0 R^(3/2)/(1 + R) with R = r sin(theta); 0: zero angular momentum (model: gold);
        -1 to 1; default 0.
    gold_absorption: A: absorptivity in 1/cm over emissivity in erg/(s cm^3 Hz sr), at 230 GHz (model: gold); 0 to 1e+30; default 0.
    density_cm3: electron density: at r = 1 M in the equatorial plane, by its power law (model: riaf); its maximum (model: torus); in
        1/cm^3; 0 to 1e+30; default 30000000.
    density_index: p: density is proportional to r^-p (model: riaf); -10 to 10; default 1.1.
    electron_temperature_k: electron temperature at r = 1 M (model: riaf); in K; 1 to 1e+30; default 300000000000.
    temperature_index: p: electron temperature is proportional to r^-p (model: riaf); -10 to 10; default 0.84.
    height: height over the distance from the axis at which the density has fallen to exp(-1/2); 0: the density does not depend on
        height (model: riaf); 0 to 10; default 0.1.
    magnetisation: magnetic pressure over the rest energy of a proton per electron, at r = 1 M (model: riaf); 0 to 1e+12; default
        0.016666666666666666.
    magnetisation_index: p: magnetisation is proportional to r^-p (model: riaf); -10 to 10; default 1.
    field: direction of the magnetic field: round the axis, along it, or radial; its part along the motion is removed (models: riaf,
        torus); default "toroidal".
    flow: motion of the matter: with the angular velocity of the circular orbit at each r, and in free fall inside the ISCO; or at rest
        relative to observers of zero angular momentum (model: riaf); default "orbits".
    electrons: energy distribution of the electrons (models: riaf, torus, grid); kappa: thermal with a power-law tail; default
        "thermal".
    electrons_index: p: the number of electrons is proportional to gamma^-p (electrons: power-law); 1.1 to 10; default 3.5.
    kappa: kappa: at high energies the number of electrons is proportional to gamma^(1 - kappa) (electrons: kappa); 3.1 to 7.5; default
        4.
    torus_radius: radius of the largest pressure; the inner edge is volume.inner (model: torus); in M; 1 to 1000; default 12.
    adiabatic_index: adiabatic index of the gas (model: torus); 1.1 to 2; default 1.4444444444444444.
    temperature_ratio: ion temperature over electron temperature (model: torus); 0 to 1000000; default 3.
    beta: gas pressure over magnetic pressure (model: torus); 1e-06 to 1e+12; default 10.
    gamma_min: smallest Lorentz factor of the electrons (electrons: power-law); 1 to 1000000000; default 30.
    gamma_max: largest Lorentz factor of the electrons; above gamma_min (electrons: power-law); 1 to 1e+12; default 100000.
    normalise_to_jy: flux to which the picture is normalised: kerrd multiplies the density (gold: the emissivity; grid: the factor) by a
        number that small pictures determine, and reports this number; 0: no change (models: gold, riaf, torus, grid); in Jy; 0 to
        1e+12; default 0.
    normalise_ghz: frequency of that flux; observed: volume.frequency_ghz; in GHz; 1e-06 to 1e+12; default "observed".
    """

    model: Literal['none', 'uniform', 'gold', 'riaf', 'torus', 'grid'] | None = None
    inner: Literal['horizon'] | float | None = None
    outer: float | None = None
    emissivity: float | None = None
    opacity: float | None = None
    temperature_k: float | None = None
    redshift: bool | None = None
    frequency_ghz: float | None = None
    grid: None | str | None = None
    grid_scale: float | None = None
    slow_light: bool | None = None
    gold_emission: float | None = None
    gold_index: float | None = None
    gold_flattening: float | None = None
    gold_momentum: float | None = None
    gold_absorption: float | None = None
    density_cm3: float | None = None
    density_index: float | None = None
    electron_temperature_k: float | None = None
    temperature_index: float | None = None
    height: float | None = None
    magnetisation: float | None = None
    magnetisation_index: float | None = None
    field: Literal['toroidal', 'vertical', 'radial'] | None = None
    flow: Literal['orbits', 'rest'] | None = None
    electrons: Literal['thermal', 'power-law', 'kappa'] | None = None
    electrons_index: float | None = None
    kappa: float | None = None
    torus_radius: float | None = None
    adiabatic_index: float | None = None
    temperature_ratio: float | None = None
    beta: float | None = None
    gamma_min: float | None = None
    gamma_max: float | None = None
    normalise_to_jy: float | None = None
    normalise_ghz: Literal['observed'] | float | None = None


@dataclass
class Jets:
    """Stylised jets along the spin axis.

    brightness: light that the jet emits along 1 M in its own frame, in units of the disk's brightest surface brightness. It is the
        value of the power law at the inner edge; the actual light is 0 there and rises smoothly to the power law. 0: no jets; in 1/M; 0
        to 1000000000; default 0.
    opening_deg: half of the cone's opening angle; in degrees; 1 to 60; default 8.
    lorentz: Lorentz factor of the outflow; 1 to 100; default 2.
    inner: radius at which the light begins, at least 1.05 times that of the horizon; in M; 1 to 1000000; default 4.
    outer: radius at which the light ends; larger than the inner edge; in M; 1 to 1000000; default 60.
    falloff: p: the jet's light is proportional to r^-p; -10 to 10; default 1.5.
    sheath: distribution of brightness across the jet: 0, a bright spine; 1, bright edges; 0 to 1; default 0.5.
    spectral_index: index: brightness is proportional to g^(2 + index); -10 to 10; default 0.7.
    temperature_k: colour of a black body of this temperature, not shifted; in K; 300 to 1000000000; default 14000.
    counterjet: include the jet below the disk; default true.
    """

    brightness: float | None = None
    opening_deg: float | None = None
    lorentz: float | None = None
    inner: float | None = None
    outer: float | None = None
    falloff: float | None = None
    sheath: float | None = None
    spectral_index: float | None = None
    temperature_k: float | None = None
    counterjet: bool | None = None


@dataclass
class Polarization:
    """Polarisation of light, as layers and ticks show it; in a picture it changes only the light of volumes.

    model: polarisation. none; synchrotron: of light from the disk's plane, perpendicular to polarization.field and the ray in the gas's
        frame; scattering: of light from the disk's plane, by a deep atmosphere of free electrons, perpendicular to the normal and the
        ray; transfer: of a volume at a radio frequency, Stokes I, Q, U and V along the rays; default "none".
    field: direction of the magnetic field in the plane: round the axis, outwards, or along the normal (model: synchrotron); default
        "toroidal".
    electron_index: p: the number of electrons is proportional to E^-p; an ordered field polarises their light by (p + 1)/(p + 7/3)
        (model: synchrotron); 1 to 10; default 3.
    order: factor on the polarisation, below 1 for a field that is disordered within a pixel; 0 to 1; default 1.
    faraday: include Faraday rotation, and conversion between linear and circular polarisation, by the electrons (model: transfer);
        default true.
    rotation: fit of the Faraday rotation by thermal electrons: Shcherbakov 2008, or Dexter 2016 in the form of Huang and Shcherbakov
        2011 (model: transfer); default "shcherbakov".
    """

    model: Literal['none', 'synchrotron', 'scattering', 'transfer'] | None = None
    field: Literal['toroidal', 'radial', 'vertical'] | None = None
    electron_index: float | None = None
    order: float | None = None
    faraday: bool | None = None
    rotation: Literal['shcherbakov', 'dexter'] | None = None


@dataclass
class Sky:
    """The sky at infinity.

    model: sky at infinity: none; a celestial grid that shows the lensing; generated stars and a generated Milky Way; the stars of the
        Hipparcos catalogue over that Milky Way; or sky.image without stars; default "none".
    brightness: brightness of the grid, or of a sky of 21 magnitudes per square arcsecond, in units of the disk's brightest surface
        brightness at g = 1; stars and the Milky Way keep their real ratio. auto: 0.2, or 0.01 for stars and the Milky Way behind other
        light; 0 to 100; default "auto".
    grid_deg: spacing of the celestial grid; in degrees; 1 to 90; default 15.
    milky_way: factor on the natural brightness of the Milky Way or of sky.image; 0: only stars; 0 to 100; default 1.
    image: picture of the whole sky instead of the generated Milky Way (model: stars, catalogue, image): twice as wide as high, with
        galactic longitude 0 in the middle and rising to the left, latitude rising upwards; its white is 21 magnitudes per square
        arcsecond; default null.
    limit_mag: magnitude of the faintest stars that are shown; in magnitudes; -2 to 14; default 14.
    seed: seed of the random numbers of the generated sky; 0 to 2147483647; default 1.
    orientation: galactic, equatorial: the hole's axis points to that pole of the sky, and azimuth 0 to longitude 0; sgra, m87: an
        observer at azimuth 0 sees the hole where the Earth sees that source, with the galactic pole (sgra) or the celestial pole (m87)
        above; default "galactic".
    turn_deg: rotation of the sky about the hole's axis, in the sense of camera.azimuth_deg; in degrees; -360 to 360; default 0.
    tilt_deg: a second rotation of the sky, about the horizontal axis of the picture from azimuth 0; in degrees; -180 to 180; default 0.
    """

    model: Literal['none', 'grid', 'stars', 'catalogue', 'image'] | None = None
    brightness: Literal['auto'] | float | None = None
    grid_deg: float | None = None
    milky_way: float | None = None
    image: None | str | None = None
    limit_mag: float | None = None
    seed: int | None = None
    orientation: Literal['galactic', 'equatorial', 'sgra', 'm87'] | None = None
    turn_deg: float | None = None
    tilt_deg: float | None = None


@dataclass
class Tile:
    """A part of the picture, rendered alone, with the same bytes as in the whole.

    left: columns of the picture to the left of the tile; in pixels; 0 to 32767; default 0.
    top: rows of the picture above the tile; in pixels; 0 to 32767; default 0.
    width: width of the tile; 0: no tile, the whole picture is rendered; in pixels; 0 to 32768; default 0.
    height: height of the tile; 0: no tile, the whole picture is rendered; in pixels; 0 to 32768; default 0.
    """

    left: int | None = None
    top: int | None = None
    width: int | None = None
    height: int | None = None


@dataclass
class Image:
    """The size of the picture.

    width: width of the picture; in pixels; 1 to 32768; default 1280.
    height: height of the picture; in pixels; 1 to 32768; default 720.
    samples: rays along each side of a pixel: n gives the mean of n x n rays; auto: one ray, and 16 for pixels that differ from their
        neighbours; 1 to 8; default 1.
    pixel_error: apparent error, as a fraction of white, above which a pixel of one ray gets more rays (samples: auto); 0.001 to 0.5;
        default 0.003.
    critical_factor: factor on the number of rays along each side of pixels at the critical curve, where the photon ring is thinner than
        a pixel; the product is at most 16; 1 to 16; default 4.
    bit_depth: bits a channel: 8 or 16; in bits; 8 to 16; default 8.
    layers: contents of the file: the picture, or maps of the rays (docs/layers.md) for the first crossing of the disk, or with the
        suffix _N for image order N; a PNG shows one map in false colour, FITS, EXR, NPZ and NPY have several as numbers; default
        ["rgb"].
    layer_min: value at the lower end of a layer's colour scale; auto: docs/layers.md gives it for each layer; -1e+12 to 1e+12; default
        "auto".
    layer_max: value at the upper end of a layer's colour scale; auto: docs/layers.md gives it for each layer; -1e+12 to 1e+12; default
        "auto".
    legend: draw a colour bar in the lower left corner of a layer in false colour; default true.
    tile: a part of the picture, rendered alone, with the same bytes as in the whole.
    """

    width: int | None = None
    height: int | None = None
    samples: Literal['auto'] | int | None = None
    pixel_error: float | None = None
    critical_factor: int | None = None
    bit_depth: int | None = None
    layers: Sequence[str] | None = None
    layer_min: Literal['auto'] | float | None = None
    layer_max: Literal['auto'] | float | None = None
    legend: bool | None = None
    tile: Tile | None = None


@dataclass
class Style:
    """From brightness to the colours of the file.

    name: style, which sets all fields of the look except those that the document sets; none: no style; default "film".
    exposure: exposure as an exponent of 2, relative to the disk's brightest surface brightness at g = 1; auto: by the light in the
        picture, with a limit for pictures of stars alone so that empty space is black; in stops; -40 to 40; default "auto".
    tone_map: aces: film-like curve; srgb: proportional to light, clipped; neutral: keeps colours, and compresses light near white;
        default "aces".
    bloom: share of bright light that the lens spreads around its place: all light over 0.6 of white, with a smooth transition from 0.2
        on; 0: none; 0 to 1; default 0.4.
    beam_uas: full width at half maximum of a round Gaussian telescope beam, seen from spacetime.distance_pc; 0: none; in
        microarcseconds; 0 to 1e+12; default 0.
    palette: colour: the colour of the light; heat: brightness in false colour (black, red, orange, white), with lightness proportional
        to it; default "colour".
    colour_bar: draw a brightness bar in the lower left corner (palette: heat; tone_map: srgb), and in the upper right corner an angular
        scale and the shape of the beam; default false.
    dither: add half a step of ordered noise before rounding, against banding; default true.
    ringdown: illustration of a struck hole: light of image orders 1 and up is multiplied by 1 + ringdown e^(-t/tau) cos(w t), with the
        hole's quasi-normal mode l = m = 2, n = 0; 0: none; 0 to 1; default 0.
    ringdown_time: time at which the hole was struck, and the ringing begins; in M; -1e+12 to 1e+12; default 0.
    """

    name: Literal['none', 'film', 'raw', 'dngr', 'eht', 'starless'] | None = None
    exposure: Literal['auto'] | float | None = None
    tone_map: Literal['aces', 'srgb', 'neutral'] | None = None
    bloom: float | None = None
    beam_uas: float | None = None
    palette: Literal['colour', 'heat'] | None = None
    colour_bar: bool | None = None
    dither: bool | None = None
    ringdown: float | None = None
    ringdown_time: float | None = None


@dataclass
class Source:
    """The source on the sky that the hole represents, for FITS files; it changes no pixel.

    name: the source on the sky that the hole represents; default "none".
    ra_deg: right ascension of the hole (ICRS); in degrees; 0 to 360; default 0.
    dec_deg: declination of the hole (ICRS); in degrees; -90 to 90; default 0.
    mjd: date of the picture, as a modified Julian date; in days; 0 to 1000000; default "none".
    """

    name: Literal['none', 'm87', 'sgra'] | None = None
    ra_deg: float | None = None
    dec_deg: float | None = None
    mjd: Literal['none'] | float | None = None


@dataclass
class Motion:
    """Motion in a live session; a still picture ignores it.

    azimuth_rate_deg: rate at which the observer goes round the axis; in degrees per second; -360 to 360; default 0.
    time_rate: rate of coordinate time; in M per second; -1000000 to 1000000; default 0.
    proper_time_rate: rate of the observer's proper time: the observer moves along its path, a fall to the last possible position or an
        orbit; coordinate time follows; in M per second; 0 to 1000000; default 0.
    """

    azimuth_rate_deg: float | None = None
    time_rate: float | None = None
    proper_time_rate: float | None = None


@dataclass
class Accuracy:
    """Accuracy of the rays.

    profile: accuracy with which rays are traced, from coarse to fine; reference: double precision; default "balanced".
    tolerance: largest relative error of the crossing radii, by the accuracy table of the device; profile: the error of
        accuracy.profile; 1e-18 to 0.1; default "profile".
    engine: method that traces the rays; auto: the closed form outside the photon orbits, otherwise mino-rkn6; default "auto".
    precision: precision of the arithmetic; auto: chosen by accuracy.profile; default "auto".
    steps: integrator steps for a half turn, a multiple of 4; 0: chosen by accuracy.profile; 0 to 2048; default 0.
    orders: equatorial crossings kept for each ray: image orders 0 to n - 1; 1 to 8; default 3.
    """

    profile: Literal['draft', 'interactive', 'balanced', 'high', 'reference'] | None = None
    tolerance: Literal['profile'] | float | None = None
    engine: Literal['auto', 'closed', 'mino-rkn4', 'mino-rkn6', 'ks-euler', 'ks-rk4', 'ks-tao6'] | None = None
    precision: Literal['auto', 'f32', 'f64'] | None = None
    steps: int | None = None
    orders: int | None = None


@dataclass
class Scene:
    """A scene, version 1.

    spacetime: the hole.
    camera: position, motion and view of the observer.
    disk: the accretion disk in the equatorial plane, turning towards +phi.
    spots: hot spots: Gaussians in the equatorial plane that go round with the gas; up to 16.
    flash: a flash of a lamp on the axis, which runs over the thin disk.
    bodies: bodies: luminous spheres round the hole; up to 8.
    volume: matter along the rays.
    jets: stylised jets along the spin axis.
    polarization: polarisation of light, as layers and ticks show it; in a picture it changes only the light of volumes.
    sky: the sky at infinity.
    image: the size of the picture.
    style: from brightness to the colours of the file.
    source: the source on the sky that the hole represents, for FITS files; it changes no pixel.
    motion: motion in a live session; a still picture ignores it.
    accuracy: accuracy of the rays.
    time: coordinate time of the picture; in M; -1e+12 to 1e+12; default 0.
    """

    spacetime: Spacetime | None = None
    camera: Camera | None = None
    disk: Disk | None = None
    spots: Sequence[Spot] | None = None
    flash: Flash | None = None
    bodies: Sequence[Body] | None = None
    volume: Volume | None = None
    jets: Jets | None = None
    polarization: Polarization | None = None
    sky: Sky | None = None
    image: Image | None = None
    style: Style | None = None
    source: Source | None = None
    motion: Motion | None = None
    accuracy: Accuracy | None = None
    time: float | None = None
