"""Refusals of values that are valid each by itself but not together, which no schema of OpenAPI 3.1 can express. They
are listed by the operations that give them, as they are written in the source.

A sentence is a format string of the C source, verbatim. If it contains a bar, the part before the bar is the format
into which the rest is inserted. The test contract_sentences checks that each sentence is in the source. A rule that a
schema can express (a bound, a word, a member that requires or excludes another) does not belong here: if a case fits
the document and is refused for such a rule, the document is wrong.
"""

# Invalid combinations of an observer's values, with the names of these fields in a scene, in rays and in physics.
OBSERVER = (
    '%s%s |is %s M; for %s%s "infall" it must be more than %s M, the inner horizon, where the model ends',
    '%s%s |is %s M; for %s%s "%s" at this inclination it must be more than %s M, %s; %s%s %s can be inside',
    "%svelocity_r, velocity_theta and velocity_phi make a speed of %s; it must be less than 1, that of light",
    '%sinfall_energy |is %s with %sinfall_from %s M; it must be "rest"',
    "%sinfall_from |is %s M; it must be at least %s%s, %s M",
    "%sinfall_energy |is %s; at %s%s %s M with this angular momentum it must be at least %s",
    "%sinfall_momentum |is %s M, with which the observer turns outside %s%s %s M; it must be nearer to 0",
)

# Fields of a scene that depend on each other. A document is applied over a preset, and a patch over the present scene.
# So a member that is missing in the request still has a value, which counts.
SCENE = (
    "there is no %s.%zu: the list has %zu element%s, and the next free index is %zu",
    "%s is an old name of %s.%zu, and %s is given too; only one of them may be given",
    '%s is "%.64s", which is no SHA-256, and no name of an asset that is known here',
    '%s is "%s", and there is no such asset here; it must be %s',
    'camera.projection is "%s" with camera.r "infinity"; it needs a finite camera.r, at infinity use "plane"',
    'camera.projection is "plane" with camera.r %s M; parallel rays need camera.r "infinity", at a finite radius use "pinhole"',
    'camera.projection is "ring" with camera.r %s M; it must be "infinity"',
    "camera.%s is %s; it must be 0 in the %s projection, which is aimed with %s",
    "camera.ring_decades_min is %s; it must be less than camera.ring_decades_max, %s",
    "camera.r is %s M; it must be more than %s M, the horizon of spacetime.spin %s",
    *OBSERVER,
    'camera.%s is %s; it must be %s unless camera.observer is "%s" at a finite camera.r',
    "motion.proper_time_rate is %s; it must be 0 unless camera.observer stays, goes round in the equatorial plane or falls without leaving its latitude, from a finite camera.r",
    "disk.slow_light is true; it must be false with motion.proper_time_rate %s of one who falls: the way leads into the ergosphere, where there is none",
    "motion.%s is %s; it must be 0 with motion.proper_time_rate %s: time and azimuth go on as they do on the observer's way",
    'camera.stereo is "pair"; it must be "none" but from a finite camera.r in pinhole projection',
    "camera.eye_distance is %s M, with which an eye would be where camera.observer cannot be; it must be smaller",
    'disk.inner is %s M; it must be at least %s M, the ISCO of spacetime.spin %s, or "isco"',
    "disk.outer is %s M; it must be more than the inner edge, %s M%s",
    'disk.height is %s; where disk.model it must be "particles" is 0',
    "volume.torus_radius is %s M; it must be more than the ISCO, %s M",
    "volume.inner is %s%s M; it must be less than volume.torus_radius, %s M, and more than the orbit of light, %s M",
    "volume.torus_radius is %s M with the inner edge at %s M: gas that goes round like that has no outer edge; it must be less, or the inner edge further out",
    "volume.gamma_max is %s; it must be more than volume.gamma_min, %s",
    "volume.normalise_to_jy is %s Jy; it must be 0 but where a volume at a radio frequency shines alone, in the plane and pinhole projections",
    "volume.normalise_to_jy is %s Jy; for a pair of eyes it must be 0: each would see another density",
    "volume.outer is %s M; it must be more than the inner edge, %s M",
    "jets.falloff is %s, with which light grows more than 2^60 times from %s to %s M; it must be at least %s",
    "jets.outer is %s M; it must be more than the inner edge, %s M",
    "%s is %s M; it must be at least %s M, the ISCO of spacetime.spin %s",
    "%s is %s; it must be |at least %s M, a twentieth outside the horizon",
    '%s is %s; it must be |90 with motion "%s", which is an orbit in the disk\'s plane',
    '%s is %s; it must be |more than %s M, %s, with motion "%s": inside %s',
    "%s is %s; it must be |a velocity of at most 0.999 together with the other two components",
    '%s is %s; it must be |0 unless motion is "velocity"',
    "style.ringdown is %s; it must be 0 with spacetime.spin %s: beyond %s the modes of a hole crowd and none of them rings alone",
    "camera.field_uas is %s microarcseconds; it must be %s to %s, camera.field_m %s to %s, at this spacetime.mass_msun and spacetime.distance_pc",
    "style.beam_uas is %s; it must be 0 but in the plane and pinhole projections: in the others pixels are not of one angle",
    "style.beam_uas is %s microarcseconds; it must be at most %s, %d times the width of the picture at this spacetime.mass_msun and spacetime.distance_pc",
    'style.colour_bar is true; it must be false unless style.palette is "heat" and style.tone_map "srgb": else brightness has no one colour, or no even scale',
    "image.tile.width is %d and image.tile.height %d pixels; both must be above 0, or both 0, for the whole picture",
    "image.tile.left is %d and image.tile.top %d pixels; both must be 0 without image.tile.width and image.tile.height",
    "image.tile.width is %d pixels from column %d on; it must be at most %d in a picture of image.width %d",
    "image.tile.height is %d pixels from row %d on; it must be at most %d in a picture of image.height %d",
    'polarization.model is "transfer", which needs a volume.model with electrons in a magnetic field: "riaf", "torus", "grid"',
    'volume.kappa is %s; with polarization.model "transfer" it must be 3.5 to 5, for which Faraday rotation is known',
    'polarization.model is "transfer", which needs a scene where nothing but the volume shines: disk.model and sky.model "none", no jets, spots or bodies',
    'polarization.model is "transfer"; it must be "none" with camera.projection "ring", where a picture has no up',
    "volume.grid is matter round a hole of the spin %s, and spacetime.spin is %s; it must be the same",
    # found by the plan of a scene
    "image.layers holds %s; its image orders must be below accuracy.orders, %d",
    "image.layers holds %s; where there it must be volumes or bodies is %.*s: their light is between the crossings",
    'image.layers holds %s with polarization.model "none", where no light is polarised: it must be another',
    'image.layers holds stokes_v, which needs polarization.model "transfer": other light is not polarised circularly',
    'image.layers holds %s with camera.projection "ring", where a picture has no up: it must hold other layers',
    'image.layers holds %s, which needs a scene where nothing but a volume at a radio frequency shines: volume.model "gold", "riaf", "torus" or "grid", disk.model and sky.model "none", no jets, spots or bodies',
    "image.layers holds %s, which is of the place where a thin disk is crossed, with disk.height %.9g: it must be 0",
    "image.layers holds %s, which is that of one crossing: there must be no volumes",
    'image.layers holds %s with disk.model "none", where nothing has a temperature',
    "image.layer_min is %.9g; it must be less than image.layer_max, %.9g",
    "image.layer_min is %.9g; it must be more than 0: %s is shown on a logarithmic scale",
    "image.layer_max is %.9g; it must be more than 0: %s is shown on a logarithmic scale",
    "accuracy.tolerance is %.3g: a picture keeps radii in 32 bits and holds %.3g and above; lists of rays (POST /v1/rays, kerrd rays) hold %.3g%s",
    "accuracy.tolerance is %.3g: light through volumes is added up in 32 bits and holds %.3g and above",
    'accuracy.engine is "%s" in %s; inside the ergosphere, camera.r %.9g, it must be "auto", "closed" or a Mino engine in f32, or the camera outside %.9g M',
    'accuracy.precision is "f32", and in the ring projection must be "f64" or "auto"',
    "disk.slow_light is true; within the horizon, camera.r %.9g, it must be false: no far clock tells when light of the gas arrives there",
    'accuracy.engine is "%s" in %s; within the horizon, camera.r %.9g, it must be a Mino engine in f32, without delay of light',
    "the closed form in f32 is for an observer beyond %.9g M, outside the orbits of light, and knows no delay of light: it must be f64",
    "image.layers holds delay, which is not known inside the ergosphere, camera.r %.9g",
    "disk.slow_light is true; inside the ergosphere, camera.r %.9g, it must be false",
    'camera.projection is "ring", whose rays are listed, where light is followed through volumes and to bodies: it must be another',
    'image.layer_%s is "auto", and in a tile must be a number: its own would not be those of the whole picture',
    "image.legend is true; in a tile it must be false: the bar stands in a corner of the whole picture",
    'style.exposure is "auto"; in a tile it must be a number: its own would not be that of the whole picture; a small picture of the same scene tells one',
    "style.bloom is %.9g; in a tile it must be 0: a lens spreads light over the whole picture",
    "style.beam_uas is %.9g; in a tile it must be 0: a beam spreads light over the whole picture",
    "style.colour_bar is true; in a tile it must be false: the bar stands in a corner of the whole picture",
    'camera.stereo is "pair"; in a tile it must be "none"',
    'camera.projection is "ring"; in a tile it must be another',
    'image.samples is "auto"; in a tile it must be 1 to 8: rays are chosen by what the whole picture shows',
    "camera is where a ray next to the critical curve does not escape: no stars can be sought there",
    'accuracy.tolerance is %.3g: the ring projection needs f64, which this device has not; it must be "profile"',
    "volume.normalise_to_jy is %.9g Jy, but %s %.4g Jy; it must be 0, or a flux that this matter has at some density",
    'volume.grid is "%s", and the bytes of this asset are not here; it must be %s',
    'sky.image is "%s", and the bytes of this asset are not here; it must be %s',
)
# These depend on the engine and its precision, and on the device or the table of its driver.
ENGINE = (
    'the closed engine works in double precision: precision must be "f64", or the engine another one',
    "the closed engine takes no steps: steps must be 0, or the engine another one",
    "steps is %u beside a tolerance, which chooses them: it must be 0",
    'tolerance is %.9g beside the engine "closed", which has one accuracy, that of its precision',
    "steps is %u, and for %s must be a multiple of 4 up to %u, or 0 for the engine's default",
    'precision is f64, which this device has not: it must be f32, or the engine "closed"',
    "the accuracy table of this device has no row that can be relied on for what was asked; `kerrd bench accuracy` makes a new one",
)
# Reasons why a scene cannot be given in a format.
PICTURE = (
    "image.layers holds %d; in a file of the format %s it must hold one; fits, exr, npz and npy hold all",
    'sky.model is not "catalogue": the stars of no other sky have names',
    'camera.projection is "ring", which has no stars to name: it must be another one',
    "image.tile.width is %d; it must be 0 where stars are named: places are those of the whole picture",
    'camera.stereo is "pair"; it must be "none" where stars are named: places in a picture are those of one eye',
    'camera.stereo is "pair", whose stars are not named: it must be "none"',
)
TIMELINE = (
    "look_at is given, which needs a finite camera.r",
    "look_at is the place of the camera itself; it must be another place",
    "proper_time is %.9g M; it must be 0 unless camera.observer stays, goes round in the equatorial plane or falls without leaving its latitude, from a finite camera.r",
    "%s follows a keyframe at %.9g, the last place that there may be",
    "%s is given with motion.proper_time_rate; only one of them may be given",
    "keyframes/%zu/at is %s; it must be |a number %s %.9g to %.9g",  # each keyframe is later than the one before it
    "keyframes/%zu/frame is %s; it must be |a whole number from %u to %u",
    "frames is %s; it must be |a whole number from %u to %u",
    'keyframes/%zu/proper_time is %s; it must be |0 to 1000000000000 M, or "horizon" or "end" of an observer that falls from further out without leaving its latitude',
    "keyframes/%zu/proper_time is %s; it must be |0 unless camera.observer stays, goes round in the equatorial plane or falls without leaving its latitude, from a finite camera.r",
)
RADII = (
    'inner is %.9g, within the ISCO of this spin, %.9g M; it must be at least that, or "isco"',
    "outer is %.9g and inner is %.9g; outer must be larger than inner",
    "spin is %.17g: double precision does not follow the disk's image at inclination_deg %.9g so near an extremal hole",
)
SESSION = (
    "image.layers holds %zu; in a session, which shows a picture, it must hold one",
    "image.tile.width is %u; it must be 0 in a session, which shows whole pictures of any size",
)

OF_SCENES = "(GET|POST) /v1/(render|pixel|share)$|POST /v1/(plan|sessions|jobs|playground|visibility|compare|spectrum)$|PATCH /v1/(sessions|playground)/{id}(/frame)?$|POST /v1/sessions/{id}/path$"

# (operations, their sentences)
TOGETHER = [
    (OF_SCENES, SCENE + ENGINE),
    ("(GET|POST) /v1/render|POST /v1/jobs", PICTURE),
    (
        "(GET|POST) /v1/share",
        (
            "%s names an asset of this server, which a link does not hold; it must be null",
            "it is too long for a link, which has at most %d characters",
        ),
    ),
    (
        "(GET|POST) /v1/pixel",
        ('at is "%s"; it must be X,Y: pixels from the upper left corner, below %u across and %u down',),
    ),
    ("(POST|PATCH) /v1/playground", SESSION),
    (
        "POST /v1/sessions|PATCH /v1/sessions/{id}(/frame)?|POST /v1/sessions/{id}/path",
        SESSION + ("patience_ms stands without least, whose width it is the patience for",),
    ),
    ("POST /v1/sessions/{id}/path|POST /v1/jobs", TIMELINE),
    (
        "POST /v1/sessions/{id}/path",
        (
            "the last keyframe is at 0 s; it must be later",
            "keyframe %zu changes motion, which stays what it is along a path",
            "proper_time is given, which needs motion.time_rate and motion.azimuth_rate_deg 0 alone: time and azimuth go on as they do on the observer's way",
        ),
    ),
    (
        "GET /v1/sessions/{id}/particles",
        (
            'disk.model is "%.*s"; for a list of particles it must be "particles"',
            "%s is %s; it must be a whole number from %g to %.0f of the scene's %u particles",
            "count is %zu; it must be 1 to %zu: from the %u particles, first %u, stride %u",
            "count is %zu with %zu bytes a particle; it must be 1 to %llu: the rest with first, or fewer with stride",
        ),
    ),
    # depends on the contents of a job
    (
        "GET /v1/jobs/{id}/result",
        (
            "frame is the number of a frame of this job, from 0 on",
            "rate is a whole number of frames a second, from 1 to 120, of format=mp4 or webm",
            "format is %s|, which hold%s all, or %s or %s, both with frame=NUMBER if wanted",
            "format is %s: the frames of this job are %s",
            "frame goes with pictures; a %s comes whole",
        ),
    ),
    ("GET /v1/jobs/{id}/preview.png", ("the frames of this job are %s: there is nothing to look at",)),
    (
        "POST /v1/line",
        RADII
        + (
            "%s is %.9g after %.9g; each must be larger than the one before",
            "height is %.9g; it must be at least %.9g, 1.05 times the horizon of this spin",
            "energy_max is %.9g and energy_min %.9g; energy_max must be larger than energy_min",
            "height is %.9g: its light is not found on the whole disk",
            "spin is %.17g: the sum is no number, so near an extremal hole",
        ),
    ),
    (
        "POST /v1/transfer-function",
        RADII
        + (
            "a radius is %.9g; it must be %.9g to %.9g, from inner to outer",
            "%zu radii with %zu g* are more than %u places",
            "a radius is %.9g, whose ends of g were not found at this inclination; the inclination must be further from face on and edge on",
            "a radius is %.9g, whose place of g* %.9g was not found",
        ),
    ),
    (
        "POST /v1/spectrum",
        RADII
        + (
            "%s is %.9g after %.9g; each must be larger than the one before",
            "frequency_max_hz is %.9g and frequency_min_hz %.9g; frequency_max_hz must be larger than frequency_min_hz",
            "spin is %.17g: the sum is no number at %.9g Hz, so near an extremal hole",
            "volume.model has no light of one frequency in physical units, which a spectrum is of; it must be one with volume.frequency_ghz, "
            "such as gold and riaf; without scene and preset the spectrum is that of a thin disk",
            'something shines beside the volume, whose light has no frequency: disk.model and sky.model must be "none", without jets, spots and bodies',
            "camera.projection has no areas to scale, by which flux is measured; it must be plane or pinhole",
        ),
    ),
    (
        "POST /v1/visibility",
        (
            "u has %zu numbers and v has %zu; both must have as many",
            "%zu lengths at %zu angles are more than %u baselines",
            "%zu baselines with %u orders are more than %u rows",
            "orders is %u, and there is no disk whose image orders could be told apart; it must be 0",
            "orders is %u; it must be 0 to %d, accuracy.orders of the scene",
            'camera sees no flat map from far away, which visibilities are of; it must be camera.r "infinity" and the projections auto and plane',
            "nothing shines in the picture of %u x %u pixels, whose visibility was asked for",
        ),
    ),
    (
        "POST /v1/compare",
        (
            "observation names no asset that is here; it must be the SHA-256 of one",
            "solve has flux, and products has no amplitude, which tells it",
            "nothing is left to compare of %zu visibilities, %zu of which are too short: uv_min_gl and snr_cut must leave some",
            "%zu visibilities and %zu rows are left to compare; it must be at most %u of each: average_s averages them",
            "the observation has more than %d amplitudes and closures, the limit: average over longer times, or use a minimal set",
            'camera sees no flat map from far away, which visibilities are of; it must be camera.r "infinity" and the projections auto and plane',
            "nothing shines in the picture of %u x %u pixels, whose visibility was asked for",
        ),
    ),
    # pictures whose light is measured
    (
        "POST /v1/(spectrum|visibility|compare|jobs)",
        (
            'camera.stereo is "pair"; it must be "none" where light is measured: there is one flux for each eye',
            'camera.projection is "ring", "equirectangular" or "fulldome"; it must be "plane" or "pinhole" where light is measured: areas of the others are not to scale',
            "image.tile.width is %d; it must be 0 where light is measured: it is that of the whole picture",
        ),
    ),
    (
        "POST /v1/rays",
        ENGINE
        + (
            # OpenAPI's parameters apply to all bodies of an operation
            "the query may hold parameters beside a body of application/x-npy| only; in JSON they belong to the document",
            'r is %.16g; it must be "infinity" or a radius above that of the horizon, %.9g at this spin, up to %g',
            *OBSERVER,
            "no light with the constants of ray %zu, alpha = %.9g and beta = %.9g, reaches an observer at r = %.9g",
        ),
    ),
    (
        "POST /v1/orbits",
        (
            "%u samples of %zu orbits are more than %u in all",
            "energy %s and angular_momentum %s lead to the unstable circle at r = %.9g, so closely that double precision does not tell how long the body whirls there, "
            "and whether it falls or returns: they must differ from these by some parts in 1e12",
            "observer_r is %.9g; it must be a radius outside the horizon, r = %.9g",
            "observer_r is %.9g, where there is no observer %s; observers there are %s",
            "steps is %u, too few to find the end of this path",
            "this path cannot be followed to its end in double precision",
            "periods belong to a bound orbit, and this one is to %s: leave the duration out, or give or_end beside it, to follow it to its end, or give a time",
            'method is "closed", which follows bound orbits only, and this one is to %s',
            "the duration takes %.3g steps; it must take at most %.0f",
            "r_max is %g, too far for the steps that a path with a whirl like this one is followed in",
            "r is %.16g; it must be above the horizon at %.9g",
            "r is %.16g, where a particle of these constants cannot be",
            "energy is %.16g: no particle outside the horizon has these constants",
            "%s at r = %.16g, inside %s, which ends at %.9g here: use %s",
            "the speed is %.16g; it must be below 1, that of light",
            "the motion from r = %.16g cannot be followed in double precision",
            "p is %.16g; it must be above the horizon at %.9g",
            "p is %.16g; with this spin, e and inclination_deg an orbit has its turning points there only above %.9g, the separatrix",
        ),
    ),
    (
        "GET /v1/physics/(disk-flux|flamm|frame-dragging|potential|kerr|tidal|infall)$",
        ("%s is %s, |inside the horizon at %.9g M; it must be outside",),
    ),
    (
        "GET /v1/physics/(deflection|redshift|ring-image|shadow|sky|photon-rings|infall)$",
        (*OBSERVER, "%s is %s, |not outside the horizon at %.9g M"),
    ),
    (
        "GET /v1/physics/infall$",
        (
            "%s is %s, |not outside %.9g M, where the model ends",
            "%s is %s, |where it would not stay at this latitude; with spin it must be 0, 90 or 180, or the fall begin at rest at infinity",
        ),
    ),
    (
        "GET /v1/physics/inspiral$",
        (
            "%s is %s, |which is a = %.6g M: the orbit comes inside 6 M, where nothing of this holds; the periods must be longer",
        ),
    ),
    (
        "GET /v1/physics/photon-rings$",
        (
            "%s is %s, |inside the horizon at %.9g M; it must be outside",
            "%s is %s, |and must be more than inner, %.9g M",
        ),
    ),
    (
        "GET /v1/physics/qnm$",
        (
            "%s is %s, |and l is %g; it must be -%g to %g",
            "%s is %s, |where the iteration for this mode does not settle",
            "%s is a range of %zu values; in a sound it must be one",
            "t is %g; it must be 0: a sound holds all times",
            "mass_msun is %g, which rings at %.3g Hz with this shift_octaves; %g to %g Hz can be heard: it must be %.4g to %.4g solar masses, or shift_octaves %.0f to %.0f",
            "stretch is %g, which makes the sound fade by e in %.3g s; it must be 1 to %.4g, which is %g s",
        ),
    ),
    ("GET /v1/physics/redshift$", ("%s is %s, |so near the horizon that its image was not found; it must be larger",)),
    (
        "GET /v1/physics/(redshift|ring-image)$",
        (
            "%s is %s, |where the ring is a line; it must be 0 to 89.9 or 90.1 to 180",
            "%s is %s, |not outside the horizon at %.9g M",
        ),
    ),
    (
        "GET /v1/physics/ring-image$",
        (
            "%s is %s, |too near the horizon for its image to be found; it must be larger",
            "%s is %s, |inside the horizon at %.9g M; it must be outside",
        ),
    ),
    (
        "GET /v1/physics/scale$",
        (
            'mass_msun is "hole", and hole is "none": one of them must be given',
            'distance_pc is "hole", and hole is "none": one of them must be given',
        ),
    ),
    ("GET /v1/physics/(shadow|sky)$", ("there is no critical curve for this observer",)),
    ("GET /v1/physics/", ("the ranges make more than %d points together",)),
    # The refusal of a scene of a sweep, or of one between two keyframes, inside a message of its own.
    (
        "POST /v1/(jobs|plan)",
        (
            "the axes make %.6g scenes; they must make at most %d",
            "%s is given twice",
            '%s is "%s"; it must be a list of values or a range that leads from its start to its stop: "10:80:15", start:stop:step, or "10:80/15", start:stop/how many',
            "%s holds %s twice",
        ),
    ),
    (
        "POST /v1/jobs",
        (
            '%s is an axis, and no cube has pictures of several sizes or layers; they need files of their own, as "pictures" or "fits"',
            "scene %u is %u x %u pixels and scene 0 is %u x %u, and no cube has pictures of several sizes",
            "scene %u has other layers than scene 0, and no cube has pictures of several kinds",
            'camera.stereo is "pair"; with motion_blur it must be "none"',
            "image.tile.width is %u; with motion_blur it must be 0: the whole picture",
            'image.layers names numbers; with motion_blur it must be "rgb": only light has a mean that can be seen',
            "the picture is of another size or kind at the end of the shutter's opening than at its begin: motion_blur takes one",
        ),
    ),
    (
        "(POST|PATCH) /v1/playground|POST /v1/jobs",
        (
            "spacetime.spin is %.9g; it must be %.9g: the playground's bodies move round a hole of that spin",
            "velocity is %.9g c; it must be %s",
            "position is %.9g M from the hole; it must be more than %g M: closer in all is the hole's",
            "there is no such body in a snapshot: it is the hole's, or faster than c",
            "name is no string of up to %zu bytes",  # a schema counts characters, not bytes
            "r is %.16g; it must be above the horizon at %.9g",  # this and what follows: with gravity "kerr"
            "%s at r = %.16g, inside %s, which ends at %.9g here: use %s",
            "the motion from r = %.16g cannot be followed in double precision",
        ),
    ),
    (
        "PATCH /v1/playground/{id}",
        (
            "there is no body %.0f, or it is there no more",
            "there is no body with this id, or it is there no more",
            "gravity is chosen when a playground is made, and stays",
            "spin is chosen when a playground is made, and stays",
        ),
    ),
    (
        "POST /v1/sessions/{id}/ringdown",
        (
            "motion.time_rate is %s; for a hole to be struck it must be more than 0 M per second: what rings, rings as time goes on",
        ),
    ),
]
# If there are several scenes, the sentence is preceded by a name of the scene.
AMONG = ("scene %u: ", "frame %u: ", "with %s: ", "between keyframes, frame %.9g is no valid scene: ")
