"""The scene as dataclasses, written by generate.py from the schema; None leaves a field to the server."""

# This file is generated: change src/scene/fields.h, then run clients/python/generate.py.

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

__all__ = ["Accuracy", "Body", "Camera", "Disk", "Gas", "Image", "Jets", "Motion", "Polarization", "Scene", "Sky", "Source", "Spacetime", "Spot", "Style", "Tile", "Volume"]


@dataclass
class Spacetime:
    """The hole.

    spin: spin parameter a; a < 0 is a disk retrograde to its hole; in M; -0.999999999999 to 0.999999999999; default 0.7.
    mass_msun: mass of the hole; sets the temperature when disk.colour is "accretion"; in solar masses; 0.001 to 1e+12; default
        100000000.
    distance_pc: (angular diameter) distance of the hole: with its mass it says how wide a picture is on the sky, for a beam and a
        scale; in pc; 0.001 to 100000000000; default 260000.
    """

    spin: float | None = None
    mass_msun: float | None = None
    distance_pc: float | None = None


@dataclass
class Camera:
    """Where the observer is and what it looks at.

    r: Boyer-Lindquist radius of the observer; in M; 0.01 to 10000000; default "infinity".
    inclination_deg: polar angle of the observer: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to 180; default
        82.
    azimuth_deg: Boyer-Lindquist azimuth of the observer; of one that falls, ingoing Kerr-Schild azimuth, the same far away; in degrees;
        -360 to 360; default 0.
    observer: state of motion at a finite radius; static: at rest with respect to infinity; zamo: with zero angular momentum; keplerian:
        on a circular orbit towards +phi, as the disk, whose highest latitude is here; retrograde: on a circular orbit towards -phi,
        against the disk, whose highest latitude is here; infall: in free fall, by default from rest at infinity; velocity: with any
        velocity past the one of zero angular momentum; default "static".
    velocity_r: velocity outwards, past one of zero angular momentum (observer: velocity); in c; -1 to 1; default 0.
    velocity_theta: velocity away from the north pole, likewise (observer: velocity); in c; -1 to 1; default 0.
    velocity_phi: velocity along the disk's rotation, likewise (observer: velocity); in c; -1 to 1; default 0.
    infall_from: radius from which the observer falls, at rest there but for its angular momentum (observer: infall); in M; 1 to
        10000000; default "infinity".
    infall_energy: energy per mass of the falling observer; rest: as infall_from has it (observer: infall); -100 to 1000; default
        "rest".
    infall_momentum: angular momentum per mass of the falling observer, which moves in r and azimuth, not in latitude (observer:
        infall); in M; -10000 to 10000; default 0.
    projection: plane: parallel rays, image plane in M, at infinity only; pinhole: at a finite radius only; ring: angle round the
        critical curve against the logarithm of the distance to it, at infinity only; equirectangular: all directions from a finite
        radius, longitude across and latitude upwards; fulldome: the angle from the middle as the distance from it, 90 degrees at the
        nearer edges, from a finite radius; auto: plane or pinhole, whichever fits camera.r; default "auto".
    field_m: width of the image plane (plane projection); in M; 1e-06 to 10000000; default 46.
    field_uas: the same width on the sky, at spacetime.mass_msun and spacetime.distance_pc: camera.field_m is what it comes to; none:
        camera.field_m says it; in microarcseconds; 1e-12 to 1e+12; default "none".
    fov_deg: horizontal field of view (pinhole projection); in degrees; 1e-06 to 179; default 50.
    centre_alpha: image-plane alpha at the middle of the picture (plane); in M; -10000000 to 10000000; default 0.
    centre_beta: image-plane beta at the middle of the picture (plane); in M; -10000000 to 10000000; default 0.
    yaw_deg: look to the right of the hole (from a finite radius); in degrees; -180 to 180; default 0.
    pitch_deg: look above the hole (from a finite radius); in degrees; -90 to 90; default 0.
    roll_deg: turn the camera clockwise about its axis; ring: the angle in the middle of the picture, 0 at alpha > 0, rising to the
        right; in degrees; -360 to 360; default 0.
    stereo: pair: two pictures side by side, the left eye's on the left, each image.width wide and in pinhole projection; none: one eye;
        default "none".
    eye_distance: distance of the eyes, across the way the camera looks (stereo: pair); in M; 1e-06 to 1000000; default 0.5.
    ring_decades_max: log10 of the distance to the critical curve, over its radius, at the upper and lower edge (ring); in decades; -12
        to 0; default 0.
    ring_decades_min: the same at the middle line, above which rays pass outside the curve and below which inside (ring); in decades;
        -13 to -1; default -10.
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
    octaves: scales of the turbulence, each about half the one before; 1 to 8; default 6.
    scale: size of the largest eddies, over r, before they are drawn out; 0.02 to 2; default 0.4.
    shear: azimuth by which streaks trail, radians for each unit of ln r; they are 1 + shear^2 times as long as wide; below 0 they lead;
        -20 to 20; default 5.
    seed: another number, other gas; 0 to 2147483647; default 1.
    """

    amplitude: float | None = None
    octaves: int | None = None
    scale: float | None = None
    shear: float | None = None
    seed: int | None = None


@dataclass
class Disk:
    """The accretion disk in the equatorial plane, turning towards +phi.

    model: radial flux: none, the exact Page-Thorne integral, or the Newtonian thin disk cut at the ISCO; particles: the exact one, made
        of orbiting particles; default "novikov-thorne".
    inner: inner edge; never inside the ISCO; in M; 1 to 1000000; default "isco".
    outer: outer edge; larger than the inner one; in M; 1 to 1000000; default 22.
    taper: the outer fraction of the radius over which the disk fades out; 0 cuts it sharply; 0 to 1; default 0.7.
    opacity: opacity of one crossing; 1 is optically thick; 0 to 1; default 1.
    emission_opacity: optical depth along the normal where the disk is brightest, elsewhere as its flux: a crossing takes 1 -
        exp(-depth/cos) of disk.opacity, by the angle of emission in the gas's frame; 0: opacity is the same everywhere; 0 to 1000000;
        default 10.
    height: height of the gas over its distance from the axis, at 10 M: where its density has fallen to exp(-1/2); it has the thin
        disk's optical depth from top to bottom; 0: a thin disk; 0 to 0.5; default 0.
    flare: power of the distance from the axis that the ratio grows as; -0.5 to 0.5; default 0.
    colour: temperature scale: a chosen peak temperature, or from spacetime.mass_msun and disk.mdot_edd; default "peak".
    peak_temperature_k: largest effective temperature of the disk, in its own frame (colour: peak); in K; 300 to 1000000000; default
        3600.
    mdot_edd: accretion rate: luminosity over the Eddington luminosity, with the efficiency of this spin; in Eddington rates; 1e-12 to
        1000; default 0.1.
    hardening: colour temperature over effective temperature; 1 to 3; default 1.
    band: brightness: bolometric, g^4 F; or visible, the luminance of the Planck spectrum as the eye weighs it; default "bolometric".
    doppler: the Doppler shift and beaming of the orbiting gas; default true.
    redshift: gravitational redshift and time dilation of the orbiting gas; default true.
    particles: number of particles (model: particles); 1000 to 10000000; default 300000.
    seed: another number, other particles (model: particles); 0 to 2147483647; default 1.
    density_index: particles per area fall as r to this power; 2 puts as many into each octave of r (model: particles); 0 to 4; default
        2.
    plunging: share of the particles that fall from the ISCO on its energy and angular momentum; none do where disk.inner is not "isco"
        (model: particles); 0 to 0.5; default 0.02.
    plunging_temperature: temperature of the plunging gas over the disk's largest; 0: it is not seen (model: particles); 0 to 1; default
        0.7.
    epicycles: largest oscillations in latitude, radians, and in r over r, the latter times (kappa/Omega)^2, which vanishes at the ISCO
        (model: particles); 0 to 0.2; default 0.02.
    slow_light: each ray shows particles, gas and spots where they were when its light left them, instead of all at one coordinate time;
        default false.
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
    band: Literal['bolometric', 'visible'] | None = None
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

    brightness: surface brightness at the centre in the gas's own frame, in units of the disk's brightest; 0: there is no such spot; 0
        to 1000000; default 0.
    r: radius of the circular orbit that the centre goes round on; never inside the ISCO; in M; 1 to 1000000; default 9.
    phase_deg: azimuth of the centre at time 0; in degrees; -360 to 360; default 0.
    size: distance from the centre at which the Gaussian has fallen to exp(-1/2); in M; 0.001 to 100000; default 1.
    index: spectral index: I_nu falls as nu to this power, so that g^(3 + index) of it is seen; -4 to 6; default 1.
    temperature_k: colour: that of a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 9000.
    """

    brightness: float | None = None
    r: float | None = None
    phase_deg: float | None = None
    size: float | None = None
    index: float | None = None
    temperature_k: float | None = None


@dataclass
class Body:
    """One of `bodies`.

    radius: radius of the sphere, in its own frame; 0: there is no such body; in M; 0 to 1000000; default 0.
    r: Boyer-Lindquist radius of its centre, at least a twentieth outside the horizon's; in M; 1 to 10000000; default 15.
    inclination_deg: polar angle of the centre: 0 over the pole of the disk's rotation, 90 in its plane; in degrees; 0 to 180; default
        90.
    phase_deg: azimuth of the centre at time 0; 0 is that of the observer's camera.azimuth_deg 0; in degrees; -360 to 360; default 0.
    motion: state of motion, which shifts its light; static, zamo, keplerian and retrograde take it round with time, the last two in the
        disk's plane alone; static: at rest with respect to infinity; zamo: with zero angular momentum; keplerian: on a circular orbit
        towards +phi, as the disk, whose highest latitude is here; retrograde: on a circular orbit towards -phi, against the disk, whose
        highest latitude is here; infall: in free fall, by default from rest at infinity; velocity: with any velocity past the one of
        zero angular momentum; default "keplerian".
    velocity_r: velocity outwards, past one of zero angular momentum (motion: velocity); in c; -1 to 1; default 0.
    velocity_theta: velocity away from the north pole, likewise (motion: velocity); in c; -1 to 1; default 0.
    velocity_phi: velocity along the disk's rotation, likewise (motion: velocity); in c; -1 to 1; default 0.
    temperature_k: it shines as a black body of this temperature, shifted by g; in K; 300 to 1000000000; default 6000.
    brightness: light of its surface over that of the black body, on the scale of the disk's temperatures; 0: dark; 0 to 1000000000;
        default 1.
    limb_darkening: light of its rim is less by so much than that of its middle, linearly in the cosine of the angle; 0: none; 0 to 1;
        default 0.6.
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
    """Matter all along the rays.

    model: matter all along the rays: none; uniform, a shell that is the same everywhere and does not move: what light and opacity along
        bent rays come to; at one radio frequency gold, the analytic model of Gold et al. 2020, riaf, a hot, thin flow whose density,
        temperature and magnetic field are powers of r, torus, a thick one in equilibrium, and grid, numbers from a file; default
        "none".
    inner: inner edge; horizon: as near to it as it may be, a hundredth outside it, or a two-thousandth for what is seen at a radio
        frequency; of a torus half of the radius of its largest pressure; in M; 1 to 30000; default "horizon".
    outer: outer edge; larger than the inner one; in M; 1 to 30000; default 20.
    emissivity: light of a length of M, in its own frame, in units of the disk's brightest (model: uniform); in 1/M; 0 to 1e+30; default
        0.02.
    opacity: optical depth of a length of M, in its own frame (model: uniform); in 1/M; 0 to 1e+30; default 0.02.
    temperature_k: colour: that of a black body of this temperature, shifted by g (model: uniform); in K; 300 to 1000000000; default
        6500.
    redshift: the frequency shift of the matter (model: uniform); default true.
    frequency_ghz: frequency that is observed (models: gold, riaf, torus, grid); in GHz; 1e-06 to 1e+12; default 230.
    grid: density, temperature, velocity and magnetic field of electrons on a grid of r, theta and phi, an NPZ file (model: grid);
        without one there is no matter; default null.
    grid_scale: factor on the density of the file; its magnetic field is multiplied by the square root of this (model: grid); 0 to
        1e+30; default 1.
    gold_emission: C n0: emissivity at 230 GHz where the density is largest (model: gold); in erg/(s cm^3 Hz sr); 0 to 1e+30; default
        3e-18.
    gold_index: alpha: emissivity goes as nu^-alpha, absorptivity as nu^-(2.5 + alpha) (model: gold); -10 to 10; default 0.
    gold_flattening: h: density goes as exp(-(h cos(theta))^2/2); 0: round (model: gold); 0 to 10000; default 0.
    gold_momentum: l0: angular momentum, l0 R^(3/2)/(1 + R) an energy of 1, R = r sin(theta); 0: zero angular momentum (model: gold); -1
        to 1; default 0.
    gold_absorption: A: absorptivity in 1/cm over emissivity in erg/(s cm^3 Hz sr), at 230 GHz (model: gold); 0 to 1e+30; default 0.
    density_cm3: electrons at 1 M in the plane, as their power law has it (model: riaf), or where there are most of them (model: torus);
        in 1/cm^3; 0 to 1e+30; default 30000000.
    density_index: density goes as r^-p, p being this number (model: riaf); -10 to 10; default 1.1.
    electron_temperature_k: temperature of the electrons at 1 M (model: riaf); in K; 1 to 1e+30; default 300000000000.
    temperature_index: temperature goes as r^-p, p being this number (model: riaf); -10 to 10; default 0.84.
    height: height over the distance from the axis at which the density has fallen to exp(-1/2); 0: it is the same at all heights
        (model: riaf); 0 to 10; default 0.1.
    magnetisation: magnetic pressure over the rest energy of a proton for each electron, at 1 M (model: riaf); 0 to 1e+12; default
        0.016666666666666666.
    magnetisation_index: magnetisation goes as r^-p, p being this number (model: riaf); -10 to 10; default 1.
    field: magnetic field: round the axis, along it, or along the radius, made perpendicular to the motion (models: riaf, torus);
        default "toroidal".
    flow: motion: with the circular orbit's angular velocity at each r, and falling in from the ISCO; or at rest for observers of zero
        angular momentum (model: riaf); default "orbits".
    electrons: energies of the electrons (models: riaf, torus, grid); kappa: thermal ones with a tail of a power law; default "thermal".
    electrons_index: p: electrons of energy gamma go as gamma to minus this (electrons: power-law); 1.1 to 10; default 3.5.
    kappa: kappa: electrons of high energy gamma go as gamma to 1 minus this (electrons: kappa); 3.1 to 7.5; default 4.
    torus_radius: where the pressure is largest; the inner edge is volume.inner (model: torus); in M; 1 to 1000; default 12.
    adiabatic_index: of the gas (model: torus); 1.1 to 2; default 1.4444444444444444.
    temperature_ratio: temperature of the ions over that of the electrons (model: torus); 0 to 1000000; default 3.
    beta: pressure of the gas over that of the magnetic field (model: torus); 1e-06 to 1e+12; default 10.
    gamma_min: least energy of the electrons over that at rest (electrons: power-law); 1 to 1000000000; default 30.
    gamma_max: largest energy of the electrons, more than the least (electrons: power-law); 1 to 1e+12; default 100000.
    normalise_to_jy: flux that the picture shall have: the density (of gold the emissivity, of a grid its factor) is multiplied by what
        it takes, which kerrd finds by small pictures and answers tell; 0: left as it is (models: gold, riaf, torus, grid); in Jy; 0 to
        1e+12; default 0.
    normalise_ghz: frequency of that flux; observed: the one that the picture shows; in GHz; 1e-06 to 1e+12; default "observed".
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

    brightness: light of a length of M in its own frame, carried back to the inner edge, where it begins smoothly, in units of the
        disk's brightest; 0: there are none; in 1/M; 0 to 1000000000; default 0.
    opening_deg: half of the angle of the cone; in degrees; 1 to 60; default 8.
    lorentz: Lorentz factor: how fast the light's source flies outwards; 1 to 100; default 2.
    inner: where the light begins, at least a twentieth outside the horizon; in M; 1 to 1000000; default 4.
    outer: where it ends; larger than the inner edge; in M; 1 to 1000000; default 60.
    falloff: light along the jet goes as r to minus this; -10 to 10; default 1.5.
    sheath: from a bright spine, 0, to bright edges, 1; 0 to 1; default 0.5.
    spectral_index: brightness goes as the frequency shift to 2 plus this; -10 to 10; default 0.7.
    temperature_k: colour: that of a black body of this temperature, not shifted; in K; 300 to 1000000000; default 14000.
    counterjet: the jet below the disk, too; default true.
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
    """How light is polarised: what layers and ticks show of it; of light from the disk's plane no picture does.

    model: of light from the disk's plane: none; synchrotron, across polarization.field and the light, in the gas's frame; or
        scattering, of a deep atmosphere of free electrons, across the normal and the light; transfer: of a volume at a radio frequency,
        Stokes I, Q, U and V all along the rays; default "none".
    field: direction of the magnetic field in the plane: round the axis, outwards, or along the normal (model: synchrotron); default
        "toroidal".
    electron_index: electrons have energies E as E to minus this power p, and the light of a field in order is polarised by (p + 1)/(p +
        7/3) (model: synchrotron); 1 to 10; default 3.
    order: part of that polarisation which disorder within a pixel leaves; 0 to 1; default 1.
    faraday: electrons turn the direction of light that passes (Faraday rotation), and make linear of circular polarisation and back
        (model: transfer); default true.
    rotation: fit of the Faraday rotation by thermal electrons: of Shcherbakov 2008, or of Dexter 2016, as Huang and Shcherbakov 2011
        have it (model: transfer); default "shcherbakov".
    """

    model: Literal['none', 'synchrotron', 'scattering', 'transfer'] | None = None
    field: Literal['toroidal', 'radial', 'vertical'] | None = None
    electron_index: float | None = None
    order: float | None = None
    faraday: bool | None = None
    rotation: Literal['shcherbakov', 'dexter'] | None = None


@dataclass
class Sky:
    """What lies at infinity.

    model: what lies at infinity: nothing; a celestial grid that shows the lensing; stars and a Milky Way that are made up; the stars of
        the Hipparcos catalogue over that Milky Way; or sky.image without stars; default "none".
    brightness: brightness of the sky in units of the disk's brightest surface brightness at g = 1: of the grid; of 21 magnitudes a
        square arcsecond, by which stars and the Milky Way keep their true ratio; auto: 0.2, or 0.01 of stars and the Milky Way where
        something shines before them; 0 to 100; default "auto".
    grid_deg: spacing of the celestial grid; in degrees; 1 to 90; default 15.
    milky_way: brightness of the Milky Way, or of sky.image, over its own; 0: stars alone; 0 to 100; default 1.
    image: picture of the whole sky in the place of the Milky Way that is made up (model: stars, catalogue, image): twice as wide as
        high, galactic longitude across, growing to the left from 0 in the middle, latitude upwards; its white is 21 magnitudes a square
        arcsecond; default null.
    limit_mag: stars fainter than this are left out; in magnitudes; -2 to 14; default 14.
    seed: another number, another sky that is made up; 0 to 2147483647; default 1.
    orientation: galactic, equatorial: the hole's axis points to that pole of the sky, and azimuth 0 to longitude 0; sgra, m87: from
        azimuth 0 the hole stands before that one, as seen from the Earth, with the galactic or the celestial pole above; default
        "galactic".
    turn_deg: the sky is turned about the hole's axis by so much, as by camera.azimuth_deg; in degrees; -360 to 360; default 0.
    tilt_deg: and, after that, about the horizontal axis of the picture from azimuth 0; in degrees; -180 to 180; default 0.
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
    """A part of the picture, made by itself, the same to the byte as there.

    left: columns of the picture to its left; in pixels; 0 to 32767; default 0.
    top: rows of the picture above it; in pixels; 0 to 32767; default 0.
    width: its width; 0: the whole picture is made, and no tile; in pixels; 0 to 32768; default 0.
    height: its height, likewise; in pixels; 0 to 32768; default 0.
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
    samples: rays along each side of a pixel: n gives n x n rays, averaged; auto: one, and 16 where the picture shows that one was not
        enough; 1 to 8; default 1.
    pixel_error: by how much of white a pixel of one ray may seem to be off before it is given more (samples: auto); 0.001 to 0.5;
        default 0.003.
    critical_factor: so many times as many along each side of the pixels that the critical curve passes, where the photon ring is
        thinner than they are; at most 16 in all; 1 to 16; default 4.
    bit_depth: bits a channel: 8 or 16; in bits; 8 to 16; default 8.
    layers: what the file holds: the picture, or maps of the rays (docs/layers.md); of the first crossing on the disk, or behind _N of
        image order N; a PNG shows one in false colour, FITS, EXR, NPZ and NPY hold several as numbers; default ["rgb"].
    layer_min: number at the lower end of the colours of a layer; auto: what docs/layers.md says of each; -1e+12 to 1e+12; default
        "auto".
    layer_max: the same at their upper end; -1e+12 to 1e+12; default "auto".
    legend: a colour bar in the lower left corner of a layer in false colour; default true.
    tile: a part of the picture, made by itself, the same to the byte as there.
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

    name: a preset of what makes the look, which a document sets by naming it, but for the fields that it sets itself; none: nothing;
        default "film".
    exposure: brightness as a power of two over the disk's brightest surface brightness at g = 1; auto: by what shines, and stars alone
        no further than that space is black; in stops; -40 to 40; default "auto".
    tone_map: aces: film-like curve; srgb: proportional to light, clipped; neutral: keeps colours and compresses what is near white;
        default "aces".
    bloom: share of bright light that a lens spreads round its place: all of what is over 0.6 of white, by an even knee from 0.2 on; 0:
        none; 0 to 1; default 0.4.
    beam_uas: full width at half maximum of the round Gaussian beam of a telescope that sees the picture from spacetime.distance_pc; 0:
        none; in microarcseconds; 0 to 1e+12; default 0.
    palette: colour: that of light; heat: brightness in false colour, black, red, orange, white, by a lightness that is proportional to
        it; default "colour".
    colour_bar: a bar of brightness (palette: heat; tone_map: srgb) in the lower left corner, a scale of the sky and the beam in the
        upper right one; default false.
    dither: half a step of ordered noise before rounding, against banding; default true.
    ringdown: a struck hole, as an illustration: light of image orders 1 and up is multiplied by 1 + this * e^(-t/tau) cos(w t), the
        quasi-normal mode l = m = 2, n = 0 of the hole; 0: none; 0 to 1; default 0.
    ringdown_time: time at which it was struck; before that nothing rings; in M; -1e+12 to 1e+12; default 0.
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
    """The source on the sky that the hole stands for: FITS files tell it, and no pixel depends on it.

    name: the source on the sky that the hole stands for; default "none".
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
    """What goes on by itself in a live session; a still picture knows none of it.

    azimuth_rate_deg: the observer goes round the axis; in degrees per second; -360 to 360; default 0.
    time_rate: coordinate time goes on; in M per second; -1000000 to 1000000; default 0.
    proper_time_rate: the observer goes on by its own clock: it falls, to where a camera can be at last, or goes round, and coordinate
        time goes on as it does on its way; in M per second; 0 to 1000000; default 0.
    """

    azimuth_rate_deg: float | None = None
    time_rate: float | None = None
    proper_time_rate: float | None = None


@dataclass
class Accuracy:
    """How closely the rays are followed.

    profile: how closely rays are followed, coarse to fine; reference is double precision; default "balanced".
    tolerance: relative error of the crossing radii to be held, by the accuracy table of the device, instead of the profile; 1e-18 to
        0.1; default "profile".
    engine: what traces the rays; auto: the closed form outside the orbits of light, else mino-rkn6; default "auto".
    precision: of the arithmetic; auto: what the profile means; default "auto".
    steps: steps of the integrator a half turn, a multiple of 4; 0: what the profile means; 0 to 2048; default 0.
    orders: equatorial crossings kept a ray: image orders 0 to n - 1; 1 to 8; default 3.
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
    camera: where the observer is and what it looks at.
    disk: the accretion disk in the equatorial plane, turning towards +phi.
    spots: hot spots: Gaussians in the equatorial plane that go round with the gas; up to 16.
    bodies: bodies: spheres that shine, before the hole, behind it and in the disk; up to 8.
    volume: matter all along the rays.
    jets: stylised jets along the spin axis.
    polarization: how light is polarised: what layers and ticks show of it; of light from the disk's plane no picture does.
    sky: what lies at infinity.
    image: the size of the picture.
    style: from brightness to the colours of the file.
    source: the source on the sky that the hole stands for: FITS files tell it, and no pixel depends on it.
    motion: what goes on by itself in a live session; a still picture knows none of it.
    accuracy: how closely the rays are followed.
    time: coordinate time of the picture; in M; -1e+12 to 1e+12; default 0.
    """

    spacetime: Spacetime | None = None
    camera: Camera | None = None
    disk: Disk | None = None
    spots: Sequence[Spot] | None = None
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
