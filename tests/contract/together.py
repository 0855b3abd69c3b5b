"""Refusals of values that are valid each by itself but not together, which no schema of OpenAPI 3.1 can express. They
are listed by operation. Each sentence is a format string of the C source, verbatim. In a sentence with a bar, the part
before the bar is the format into which the rest is inserted. The test contract_sentences checks that each sentence is
in the source. A rule that a schema can express (a bound, a word, a member that requires or excludes another) does not
belong here: if a case fits the document and is refused for such a rule, the document is wrong.
"""

# Invalid combinations of an observer's values, with the names of these fields in a scene, in rays and in physics.
OBSERVER = (
    '%s%s |is %s M; for %s%s "infall" it must be more than %s M, the inner horizon, where the model ends',
    '%s%s |is %s M; for %s%s "%s" at this inclination it must be more than %s M, %s; inside, %s%s must be %s',
    "%svelocity_r, velocity_theta and velocity_phi make a speed of %s c; it must be less than 1",
    '%sinfall_energy |is %s with %sinfall_from %s M; it must be "rest"',
    "%sinfall_from |is %s M; it must be at least %s%s, %s M",
    "%sinfall_energy |is %s; at %s%s %s M with this angular momentum it must be at least %s",
    "%sinfall_momentum |is %s M, with which the observer turns back outside %s%s %s M; it must be closer to 0",
)

# Refusals about a hole's spin and charge.
HOLE = "charge is %.16g M; with spin %.16g its magnitude must be below %.9g M"

# Fields of a scene that depend on each other. A document is applied over a preset, and a patch over the current scene.
# The rules therefore apply also to values that the request does not contain.
SCENE = (
    "there is no %s.%zu: the list has %zu element%s, and the next free index is %zu",
    "%s is an old name of %s.%zu, and cannot be used with %s",
    '%s is "%.64s"; it must be a SHA-256, or the name of a known asset',
    '%s is "%s", which is not a known asset; it must be %s',
    'camera.projection is "%s", which needs a finite camera.r; at "infinity" it must be "plane"',
    'camera.projection is "plane", whose parallel rays need camera.r "infinity"; at %s M it must be "pinhole"',
    'camera.projection is "ring", which needs camera.r "infinity"; at %s M it must be "pinhole"',
    "camera.%s is %s; in the %s projection it must be 0, because %s aim the camera",
    "camera.ring_decades_min is %s; it must be less than camera.ring_decades_max, %s",
    "spacetime.charge is %s M; with spacetime.spin %s it must be at most %s M",
    "flash.height is %s M; it must be at least %s M for %s",
    "flash.period is %s M; it must be 0 or at least %s M, %d times flash.duration",
    "flash.brightness is %s; with disk.height %s it must be 0, because a flash needs a thin disk",
    "style.ringdown is %s; with spacetime.charge %s it must be 0, because it is known for an uncharged hole only",
    "camera.r is %s M; it must be more than %s M, the horizon of %s",
    *OBSERVER,
    'camera.%s is %s; it must be %s unless camera.observer is "%s" at a finite camera.r',
    "motion.proper_time_rate is %s; it must be 0 unless the observer stays at a finite camera.r, orbits there in the equatorial plane, or falls from there at constant latitude",
    "%s.slow_light is true; with motion.proper_time_rate %s of a falling observer it must be false, because the fall enters the ergosphere, where slow light is not computed",
    "motion.%s is %s; with motion.proper_time_rate %s it must be 0, because the observer's path determines time and azimuth",
    'camera.stereo is "pair"; it must be "none" unless camera.r is finite and the projection is pinhole',
    "camera.eye_distance is %s M; it must be smaller, because camera.observer cannot exist at an eye's position",
    'disk.inner is %s M; it must be at least %s M, the ISCO of %s, or "isco"',
    "disk.outer is %s M; it must be more than the inner edge, %s M%s",
    'disk.height is %s; with disk.model "particles" it must be 0',
    'disk.atmosphere is "%s", which needs a thin disk; with disk.height %s it must be "isotropic"',
    "disk.frequency_ghz is %s GHz; it must be at most %s GHz, %d k T/h of the disk's largest colour temperature, beyond which the disk is dark",
    'disk.returning is "%s", which needs the exact flux; with disk.model "shakura-sunyaev" it must be "none"',
    'disk.returning is "%s", which needs disk.inner "isco"; with disk.inner %s M it must be "none"',
    'disk.returning is "%s", which needs a thin disk; with disk.height %s it must be "none"',
    'disk.returning is "%s", which needs a^2 + Q^2 of at most %s^2; with %s it must be "none"',
    "volume.torus_radius is %s M; it must be more than the ISCO, %s M",
    "volume.inner is %s%s M; it must be less than volume.torus_radius, %s M, and more than the photon orbit, %s M",
    "volume.torus_radius is %s M with the inner edge at %s M, for which the torus has no outer edge; it must be smaller, or volume.inner larger",
    "volume.gamma_max is %s; it must be more than volume.gamma_min, %s",
    "volume.normalise_to_jy is %s Jy; it must be 0 unless only a volume at a radio frequency shines, in the plane or pinhole projection",
    "volume.normalise_to_jy is %s Jy; for a pair of eyes it must be 0, because the density would differ between the eyes",
    "volume.outer is %s M; it must be more than the inner edge, %s M",
    "jets.falloff is %s, for which the light grows by more than 2^60 from %s to %s M; it must be at least %s",
    "jets.outer is %s M; it must be more than the inner edge, %s M",
    "%s is %s M; it must be at least %s M, the ISCO of %s",
    "%s is %s; it must be |at least %s M, a twentieth outside the horizon",
    '%s is %s; it must be |90 with motion "%s", which is an orbit in the disk\'s plane',
    '%s is %s; it must be |more than %s M, %s, with motion "%s", because inside %s',
    "%s is %s; it must be |a velocity of at most 0.999 together with the other two components",
    '%s is %s; it must be |0 unless motion is "velocity"',
    "style.ringdown is %s; with spacetime.spin %s it must be 0, because beyond %s the modes of a hole crowd together and none rings alone",
    "camera.field_uas is %s microarcseconds; it must be %s to %s, camera.field_m %s to %s, at this spacetime.mass_msun and spacetime.distance_pc",
    "style.beam_uas is %s; it must be 0 except in the plane and pinhole projections, because in the others the angle of a pixel varies",
    "style.beam_uas is %s microarcseconds; it must be at most %s, %d times the width of the picture at this spacetime.mass_msun and spacetime.distance_pc",
    'style.colour_bar is true; it must be false unless style.palette is "heat" and style.tone_map "srgb", because otherwise a brightness has no unique colour, or the scale is not linear',
    "image.tile.width is %d and image.tile.height %d pixels; both must be above 0, or both 0, for the whole picture",
    "image.tile.left is %d and image.tile.top %d pixels; both must be 0 without image.tile.width and image.tile.height",
    "image.tile.width is %d pixels from column %d; it must be at most %d in a picture of image.width %d",
    "image.tile.height is %d pixels from row %d; it must be at most %d in a picture of image.height %d",
    'polarization.model is "transfer", which needs a volume.model with electrons in a magnetic field: "riaf", "torus" or "grid"',
    'volume.kappa is %s; with polarization.model "transfer" it must be 3.5 to 5, for which Faraday rotation is known',
    'polarization.model is "transfer", which needs a scene where only the volume shines: disk.model and sky.model "none", no jets, spots, flash or bodies',
    'polarization.model is "transfer"; with camera.projection "ring", whose picture has no upward direction, it must be "none"',
    "volume.grid has matter for a hole of %s %s; spacetime.%s is %s and must be the same",
    # refused when the scene is planned
    "image.layers has %s; its image orders must be below accuracy.orders, %d",
    "image.layers has %s; with volumes or bodies, whose light is between the crossings, it must be %.*s",
    'image.layers has %s, which needs polarised light: polarization.model must not be "none"',
    'image.layers has stokes_v, which needs circular polarisation: polarization.model must be "transfer"',
    'image.layers has %s, which camera.projection "ring" cannot show, because its picture has no upward direction',
    'image.layers has %s, which needs light of one frequency alone: of a volume.model "gold", "riaf", "torus" or "grid", or of a disk with disk.band "frequency"; sky.model "none", no jets, spots, flash or bodies',
    "image.layers has %s, which needs a thin disk: disk.height is %.9g; it must be 0",
    "image.layers has %s, which belongs to one crossing of the disk: there must be no volumes",
    'image.layers has %s, which needs matter with a temperature: disk.model must not be "none"',
    "image.layer_min is %.9g; it must be less than image.layer_max, %.9g",
    "image.layer_min is %.9g; it must be more than 0: %s is shown on a logarithmic scale",
    "image.layer_max is %.9g; it must be more than 0: %s is shown on a logarithmic scale",
    "accuracy.tolerance is %.3g; for a picture, with radii in 32 bits, it must be at least %.3g; lists of rays (POST /v1/rays, kerrd rays) reach %.3g%s",
    "accuracy.tolerance is %.3g; for light through volumes, in 32 bits, it must be at least %.3g",
    'accuracy.engine is "%s" in %s; inside the ergosphere, at camera.r %.9g, it must be "auto", "closed" or a Mino engine in f32, or the camera must be outside %.9g M',
    'accuracy.precision is "f32"; in the ring projection it must be "f64" or "auto"',
    "%s.slow_light is true; inside the horizon, at camera.r %.9g, it must be false, because coordinate time does not define the light's delay there",
    'accuracy.engine is "%s" in %s; inside the horizon, at camera.r %.9g, it must be a Mino engine in f32, without the light\'s delay',
    "accuracy.precision must be f64 for the closed form: in f32 it needs an observer outside %.9g M, beyond the photon orbits, and has no delay of light",
    "image.layers has delay, which is not computed inside the ergosphere, at camera.r %.9g",
    "disk.slow_light is true; inside the ergosphere, at camera.r %.9g, it must be false",
    'camera.projection is "ring"; with volumes or bodies it must be another',
    'image.layer_%s is "auto"; in a tile it must be a number, because "auto" depends on the whole picture',
    "image.legend is true; in a tile it must be false, because the bar is in a corner of the whole picture",
    'style.exposure is "auto"; in a tile it must be a number, because "auto" depends on the whole picture; a small picture of the same scene gives one',
    "style.bloom is %.9g; in a tile it must be 0, because a lens spreads light over the whole picture",
    "style.beam_uas is %.9g; in a tile it must be 0, because a beam spreads light over the whole picture",
    "style.colour_bar is true; in a tile it must be false, because the bar is in a corner of the whole picture",
    'camera.stereo is "pair"; in a tile it must be "none"',
    'camera.projection is "ring"; in a tile it must be another',
    'image.samples is "auto"; in a tile it must be 1 to 8, because "auto" depends on the whole picture',
    "images of stars cannot be computed at this camera position, because a ray close to the critical curve does not escape",
    'accuracy.tolerance is %.3g; in the ring projection it must be "profile", because this device lacks the f64 that a tolerance needs',
    "volume.normalise_to_jy is %.9g Jy, but %s %.4g Jy; it must be 0, or a flux that this matter has at some density",
    '%s is "%s", whose file is missing; it must be %s',
)
# Refusals that depend on the engine and its precision, and on the device or the table of its driver.
ENGINE = (
    'with engine "closed" precision must be "f64", because that engine works in double precision',
    'steps cannot be used with engine "closed", because that engine takes no steps; steps must be 0',
    "steps is %u; with a tolerance, which determines the steps, it must be 0",
    'tolerance is %.9g; it cannot be used with the engine "closed", whose accuracy depends only on its precision',
    "steps is %u; for %s it must be a multiple of 4 up to %u, or 0 for the engine's default",
    'precision is f64, which this device lacks; it must be f32, or the engine must be "closed"',
    "the accuracy table of this device has no reliable row for this request; `kerrd bench accuracy` makes a new table",
)
# Reasons why a scene cannot be given in a format.
PICTURE = (
    "image.layers has %d layers; for a file of the format %s it must have one; fits, exr, npz and npy take several",
    "image.bit_depth is %d; for a file of the format %s it must be 8; png takes 16",
    "the picture has %u x %u pixels; for a file of the format %s each side must be at most %u",
    'sky.model must be "catalogue", because only its stars have names',
    'camera.projection is "ring", whose stars have no names; it must be another',
    "image.tile.width is %d; for names of stars it must be 0, because positions are those of the whole picture",
    'camera.stereo is "pair"; for names of stars it must be "none", because positions are those of one eye',
    'camera.stereo is "pair"; for names of stars it must be "none"',
)
TIMELINE = (
    'look_at cannot be used with camera.r "infinity"; camera.r must be finite',
    "look_at is the position of the camera; it must be another position",
    "proper_time is %.9g M; it must be 0 unless the observer stays at a finite camera.r, orbits there in the equatorial plane, or falls from there at constant latitude",
    "%s cannot be used, because the keyframe before it is at %.9g, the latest place",
    "%s cannot be used with motion.proper_time_rate",
    # each keyframe must be later than the one before it
    "keyframes/%zu/at is %s; it must be |a number %s %.9g to %.9g",
    "keyframes/%zu/frame is %s; it must be |a whole number from %u to %u",
    "frames is %s; it must be |a whole number from %u to %u",
    'keyframes/%zu/proper_time is %s; it must be |0 to 1000000000000 M, or "horizon" or "end" for an observer that falls from further out at constant latitude',
    "keyframes/%zu/proper_time is %s; it must be |0 unless the observer stays at a finite camera.r, orbits there in the equatorial plane, or falls from there at constant latitude",
)
RADII = (
    HOLE,
    'inner is %.9g; it must be "isco" or at least %.9g M, the ISCO of this hole',
    "outer is %.9g and inner is %.9g; outer must be larger than inner",
    "%s is %.17g, too close to an extremal hole for double precision to follow the disk's image at inclination_deg %.9g",
)
CORONA = (
    "height is %.9g, which places the source %.9g M from the hole; the source must be at least %.9g M away, %g times the radius of the ergosphere",
    "height is %.9g; it must be at least %.9g, %g times corona_radius",
    "motion is corotating, which is faster than light %.9g M from the axis and %.9g M above the plane; it must be static or zamo, or the corona must be elsewhere",
    "height is %.9g; it must be at least %.9g, 1.05 times the horizon of this hole",
    "no direct light from the source to the observer was found for this height and corona_radius; one of them, or inclination_deg, must be different",
)
SESSION = (
    "image.layers has %zu layers; in a session, which shows one picture, it must have one",
    "image.tile.width is %u; in a session, which shows whole pictures of any size, it must be 0",
)

OF_SCENES = "(GET|POST) /v1/(render|pixel|share)$|POST /v1/(plan|sessions|jobs|playground|visibility|compare|observe|spectrum)$|PATCH /v1/(sessions|playground)/{id}(/frame)?$|POST /v1/sessions/{id}/path$"

# (operations, their sentences)
TOGETHER = [
    (OF_SCENES, SCENE + ENGINE),
    ("(GET|POST) /v1/render|POST /v1/jobs", PICTURE),
    ("(GET|POST) /v1/render", ("quality is %s; it cannot be used with format %s, which is exact",)),
    (
        "(GET|POST) /v1/share",
        (
            "%s names an asset of this server, which a link cannot contain; it must be null",
            "it is too long for a link, which has at most %d characters",
        ),
    ),
    (
        "(GET|POST) /v1/pixel",
        ('at is "%s"; it must be X,Y in pixels from the upper left corner, X below %u and Y below %u',),
    ),
    ("(POST|PATCH) /v1/playground", SESSION),
    (
        "POST /v1/sessions|PATCH /v1/sessions/{id}(/frame)?|POST /v1/sessions/{id}/path",
        SESSION
        + (
            "%s cannot be used without min_scale, because it lets frames become narrower than min_scale",
            "the query has %s, and its former name %s too",
        ),
    ),
    ("POST /v1/sessions/{id}/path|POST /v1/jobs", TIMELINE),
    (
        "POST /v1/sessions/{id}/path",
        (
            "the last keyframe is at 0 s; it must be later",
            "keyframe %zu changes motion, which must not change along a path",
            "proper_time needs motion.time_rate and motion.azimuth_rate_deg 0, because the observer's path determines time and azimuth",
        ),
    ),
    (
        "GET /v1/sessions/{id}/particles",
        (
            'disk.model is "%.*s"; for a list of particles it must be "particles"',
            "%s is %s; it must be a whole number from %g to %.0f of the scene's %u particles",
            "count is %zu; it must be 1 to %zu for %u particles with first %u and stride %u",
            "count is %zu with %zu bytes a particle; it must be 1 to %llu in one answer; first selects the rest, and a larger stride selects fewer",
        ),
    ),
    # the refusal depends on the contents of a job
    (
        "GET /v1/jobs/{id}/result",
        (
            "frame must be the number of a frame of this job, counted from 0",
            "rate must be a whole number of frames a second from 1 to 120, with format=mp4 or webm",
            "format must be %s| for all frames; or %s or %s, optionally with frame=NUMBER",
            "format must be %s, because the frames of this job are %s",
            "frame cannot be used with a %s; it belongs to pictures",
        ),
    ),
    ("GET /v1/jobs/{id}/preview.png", ("the frames of this job are %s and have no picture",)),
    (
        "POST /v1/line",
        RADII
        + CORONA
        + (
            "corona_inner is %.9g and corona_radius %.9g; corona_radius must be larger than corona_inner",
            "corona_top is %.9g and height %.9g; corona_top must be larger than height",
            "%s has %.9g after %.9g; each must be larger than the one before",
            "energy_max is %.9g and energy_min %.9g; energy_max must be larger than energy_min",
            "height is %.9g M; it must be different, because no rays from there to some radii of the disk were found",
            "%s is %.17g, so close to an extremal hole that the profile is not a number",
        ),
    ),
    (
        "POST /v1/transfer-function",
        RADII
        + (
            "a radius is %.9g; it must be %.9g to %.9g, from inner to outer",
            "%zu radii with %zu values of g* make too many rows (limit %u)",
            "a radius is %.9g, for which no extreme values of g were found at this inclination; the inclination must be further from face on and edge on",
            "a radius is %.9g, for which no position with g* %.9g was found",
        ),
    ),
    (
        "POST /v1/(impulse|lags)",
        RADII
        + CORONA
        + (
            "%s has %.9g after %.9g; each must be larger than the one before",
            "energy_max is %.9g and energy_min %.9g; energy_max must be larger than energy_min",
            "no rays from the source to some radii of the disk were found for this height and corona_radius; one of them must be different",
            "no ray to the ring at %.9g M was found for this inclination_deg; it must be different",
        ),
    ),
    (
        "POST /v1/impulse",
        (
            "time_max is %.9g and time_min %.9g; time_max must be larger than time_min",
            "%u bins of energy with %u of time make too many rows (limit %u)",
        ),
    ),
    (
        "POST /v1/lags",
        (
            "frequency_max is %.9g and frequency_min %.9g; frequency_max must be larger than frequency_min",
            "reference_max is %.9g and reference_min %.9g; reference_max must be larger than reference_min",
            "%u bins with %u frequencies make too many rows (limit %u)",
            "the first edge is 0; it must be above 0, because a power law has infinitely many photons down to 0",
        ),
    ),
    (
        "POST /v1/spectrum",
        RADII
        + (
            "%s has %.9g after %.9g; each must be larger than the one before",
            "frequency_max_hz is %.9g and frequency_min_hz %.9g; frequency_max_hz must be larger than frequency_min_hz",
            "%s is %.17g, so close to an extremal hole that the flux at %.9g Hz is not a number",
            "%s is %.17g, so close to an extremal hole that the energy balance of returning light has an error of %.1g (limit %g); it must be further from extremal",
            'inner is %.9g; with returning "%s" it must be the ISCO, %.9g M, or "isco"',
            'returning is "scattered", which needs an atmosphere of electrons; limb must be "scattering"',
            "inclination_deg is %.9g; %s it must be 0 to 87 or 93 to 180, because nearer to edge on the lower face of the disk is seen too (3 %% of the light at 89 degrees, half at 90)",
            'polarization is "yes", which needs an atmosphere of electrons; limb must be "scattering"',
            'the scene has no light of one frequency in physical units, which a spectrum needs; volume.model must be "gold", "riaf", "torus" or "grid", or disk.band must be "frequency"; without scene and preset the spectrum is that of a thin disk',
            'a spectrum needs a scene where only a volume, or only a disk with disk.band "frequency", shines: sky.model must be "none", and there must be no jets, spots, flash or bodies',
            "camera.projection does not preserve areas, as a flux needs; it must be plane or pinhole",
        ),
    ),
    (
        "POST /v1/visibility",
        (
            "u has %zu numbers and v has %zu; both must have the same number",
            "%zu lengths at %zu angles make too many baselines (limit %u)",
            "%zu baselines with %u orders make too many rows (limit %u)",
            "orders is %u; without a disk, which alone has separate image orders, it must be 0",
            "orders is %u; it must be 0 to %d, accuracy.orders of the scene",
            'visibilities need a flat map seen from infinity: camera.r must be "infinity", and camera.projection auto or plane',
            "the picture of %u x %u pixels is dark and has no visibilities",
        ),
    ),
    (
        "POST /v1/compare",
        (
            "observation is not an asset of this server; it must be the SHA-256 of one, or %s",
            "solve has flux; products must have amplitude or visibility, because closures do not depend on the flux",
            "check is finer; with sets it must be none",
            "set %zu: %.400s",
            "solve has shift; products must have visibility, because amplitudes and closures do not depend on the position",
            "none of the %zu visibilities can be compared, and %zu of them have too short baselines: uv_min_gl or snr_cut must be lower",
            "there are %zu visibilities and %zu rows to compare; there must be at most %u of each; a larger average_s gives fewer",
            'the observation has more than %d amplitudes and closures; a larger average_s or closures "minimal" gives fewer',
            'visibilities need a flat map seen from infinity: camera.r must be "infinity", and camera.projection auto or plane',
            "the picture of %u x %u pixels is dark and has no visibilities",
        ),
    ),
    (
        "POST /v1/observe",
        (
            "observation is not an asset of this server; it must be the SHA-256 of one, or %s",
            "flux_jy is auto; it must be a number, because the scene's light has no frequency and thus no flux in Jy",
            "observation is a CSV, which has no positions of stations; for uvfits it must be a uvfits file",
            "the observation has %zu visibilities; it must have at most %u to be simulated",
            'visibilities need a flat map seen from infinity: camera.r must be "infinity", and camera.projection auto or plane',
            "the picture of %u x %u pixels is dark and has no visibilities",
        ),
    ),
    # the job measures the light of pictures
    (
        "POST /v1/(spectrum|visibility|compare|observe|jobs)",
        (
            'camera.stereo is "pair"; for a measurement of light it must be "none", because each eye has its own flux',
            'camera.projection is "ring", "equirectangular" or "fulldome"; for a measurement of light it must be "plane" or "pinhole", because areas of the others are not to scale',
            "image.tile.width is %d; for a measurement of light it must be 0, because the light is that of the whole picture",
        ),
    ),
    (
        "POST /v1/rays",
        ENGINE
        + (
            # in OpenAPI, parameters of an operation apply to all kinds of its bodies
            "the query may have parameters only with a body of application/x-npy|; with JSON they must be in the document",
            'r is %.16g; it must be "infinity", or more than %.9g, the horizon, and at most %g',
            HOLE,
            *OBSERVER,
            "no light with the constants of ray %zu, alpha = %.9g and beta = %.9g, reaches an observer at r = %.9g",
        ),
    ),
    (
        "POST /v1/orbits",
        (
            HOLE,
            "samples is %u for each of %zu orbits; there must be at most %u samples in all",
            "energy %s and angular_momentum %s are too close to those of the unstable circular orbit at r = %.9g: double precision cannot decide how long the body whirls there, or whether it falls in or returns; they must differ from these by some parts in 1e12",
            "observer_r is %.9g; it must be a radius outside the horizon, r = %.9g",
            "observer_r is %.9g, where no observer can be %s; observer must be %s there",
            "steps is %u; it must be larger to find the end of this path",
            "double precision cannot follow this path to its end",
            "periods cannot be used with an orbit that will %s, because it has none; give a time, or leave the duration out or add or_end to follow the orbit to its end",
            'method is "closed"; for an orbit that will %s it must be another, because "closed" follows only bound orbits',
            "the duration takes %.3g steps; it must take at most %.0f",
            "r_max is %g; it must be smaller, because this path whirls near an unstable circular orbit and needs short steps",
            "r is %.16g; it must be above the horizon at %.9g",
            "r is %.16g, which no particle with these constants reaches",
            "energy is %.16g; it must be different, because no particle outside the horizon has these constants",
            "%s at r = %.16g, inside %s, which ends at %.9g here; frame must be %s",
            "the speed is %.16g c; it must be below 1",
            "double precision cannot follow the motion from r = %.16g",
            "p is %.16g; it must be above the horizon at %.9g",
            "p is %.16g; with this hole, e and inclination_deg it must be above the separatrix at %.9g",
        ),
    ),
    ("GET /v1/physics/", (HOLE,)),
    (
        "GET /v1/physics/(disk-flux|flamm|frame-dragging|potential|kerr|tidal|infall)$",
        ("%s is %s|; it must be at least %.9g M, the horizon",),
    ),
    (
        "GET /v1/physics/returning$",
        (
            "%s is %s|; it must be at least %.9g M, the ISCO",
            "%s is %s|, so close to an extremal hole that the energy balance has an error of %.1g (limit %g); it must be smaller",
        ),
    ),
    (
        "GET /v1/physics/(deflection|redshift|ring-image|shadow|sky|photon-rings|infall)$",
        (*OBSERVER, "%s is %s|; it must be more than %.9g M, the horizon"),
    ),
    (
        "GET /v1/physics/infall$",
        (
            "%s is %s|; it must be more than %.9g M, where the model ends",
            "%s is %s|; with spin it must be 0, 90 or 180, or the fall must begin at rest at infinity, because any other fall changes its latitude",
        ),
    ),
    (
        "GET /v1/physics/inspiral$",
        (
            "%s is %s|, for which a = %.6g M and the orbit comes inside 6 M, where these formulas fail; it must be longer",
        ),
    ),
    (
        "GET /v1/physics/photon-rings$",
        (
            "%s is %s|; it must be at least %.9g M, the horizon",
            "%s is %s|; it must be more than %.9g M, the value of inner",
        ),
    ),
    (
        "GET /v1/physics/qnm$",
        (
            "%s is %s|; with l %g it must be -%g to %g",
            "%s is %s|; it must be different, because the iteration for this mode does not converge there",
            "%s is a range of %zu values; for a sound it must be one value",
            "t is %g; for a sound it must be 0, because a sound has all times",
            "mass_msun is %g, which rings at %.3g Hz with this shift_octaves; for an audible %g to %g Hz it must be %.4g to %.4g solar masses, or shift_octaves %.0f to %.0f",
            "stretch is %g, which makes the sound fade by e in %.3g s; it must be 1 to %.4g, which is %g s",
        ),
    ),
    (
        "GET /v1/physics/redshift$",
        ("%s is %s|; it must be larger, because so close to the horizon no image of the ring is found",),
    ),
    (
        "GET /v1/physics/(redshift|ring-image)$",
        (
            "%s is %s|; it must be 0 to 89.9 or 90.1 to 180, because from the equatorial plane the ring is a line",
            "%s is %s|; it must be more than %.9g M, the horizon",
        ),
    ),
    (
        "GET /v1/physics/ring-image$",
        (
            "%s is %s|; it must be larger, because so close to the horizon no image of the ring is found",
            "%s is %s|; it must be at least %.9g M, the horizon",
        ),
    ),
    (
        "GET /v1/physics/scale$",
        (
            'mass_msun is "hole" with hole "none"; it must be a number, or hole must be a known one',
            'distance_pc is "hole" with hole "none"; it must be a number, or hole must be a known one',
        ),
    ),
    ("GET /v1/physics/(shadow|sky)$", ("there is no critical curve for this observer",)),
    ("GET /v1/physics/", ("the ranges make more than %d points together",)),
    # The refusal of one scene of a sweep, or of a scene between two keyframes, is inserted into another message.
    (
        "POST /v1/(jobs|plan)",
        (
            "the axes make %.6g scenes; they must make at most %d",
            "%s is given twice",
            '%s is "%s"; it must be a list of values, or a range whose steps lead from start to stop: "10:80:15" (start:stop:step) or "10:80/15" (start:stop/count)',
            "%s holds %s twice",
        ),
    ),
    (
        "POST /v1/jobs",
        (
            '%s cannot be an axis of a cube, because a cube has one size and one set of layers: use separate files, with output "pictures" or "fits"',
            "scene %u has %u x %u pixels and scene 0 has %u x %u; all pictures of a cube must have one size",
            "scene %u has other layers than scene 0; all pictures of a cube must have the same layers",
            'camera.stereo is "pair"; with motion_blur it must be "none"',
            "image.tile.width is %u; with motion_blur it must be 0: the whole picture",
            'image.layers names maps of numbers; with motion_blur it must be "rgb", because only light can be averaged',
            "the picture changes its size or kind while the shutter is open; with motion_blur both must stay the same",
        ),
    ),
    (
        "(POST|PATCH) /v1/playground|POST /v1/jobs",
        (
            "spacetime.%s is %.9g; it must be %.9g, because the playground's bodies move round a hole of that %s",
            HOLE,
            '%s is %.9g; without gravity "kerr" it must be 0, because the potential is that of an uncharged hole',
            "spacetime.%s is %.9g; it must be 0, because the playground's bodies and debris move in the potential of an uncharged hole",
            "velocity is %.9g c; it must be %s",
            "position is %.9g M from the hole; it must be more than %g M, inside which the hole captures everything",
            "a snapshot cannot have this body, because it is captured by the hole or faster than c",
            "name is not a string of at most %zu bytes",  # a schema limits characters, but the server limits bytes
            # this sentence and the next two are given with gravity "kerr"
            "r is %.16g; it must be above the horizon at %.9g",
            "%s at r = %.16g, inside %s, which ends at %.9g here; frame must be %s",
            "double precision cannot follow the motion from r = %.16g",
        ),
    ),
    (
        "PATCH /v1/playground/{id}",
        (
            "there is no body %.0f, or it no longer exists",
            "there is no body with this id, or it no longer exists",
            "gravity cannot change after a playground is made",
            "spin cannot change after a playground is made",
            "%s cannot change after a playground is made",
        ),
    ),
    (
        "POST /v1/lessons|PATCH /v1/lessons/{id}",
        (
            "session is %s; it must be the id of an open session",
            "question.right is %d; it must be 0 to %u, the number of a choice",
        ),
    ),
    ("POST /v1/lessons/{id}/hands", ("choice is %u; it must be 0 to %u",)),
    (
        "POST /v1/sessions/{id}/ringdown",
        (
            "motion.time_rate is %s; for a strike it must be more than 0 M per second, because the ringing evolves in coordinate time",
        ),
    ),
]
# With several scenes, the sentence follows the name of the scene.
AMONG = ("scene %u: ", "frame %u: ", "with %s: ", "frame %.9g, between two keyframes, is not a valid scene: ")
