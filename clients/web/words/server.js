// Sentences of the server that have no name in its answers. (Approximations have names.) Each gets an identifier here,
// under which locale/LANGUAGE.json has its translation. This module is loaded only for languages other than English.
const sentences = {
  'said.thin-disk': 'thin disk',
  'said.thick-disk': 'thick disk',
  'said.particles': 'particles',
  'said.plunging-gas': 'plunging gas',
  'said.spots': 'spots',
  'said.lamp': 'lamp',
  'said.echo-of-a-flash': 'echo of a flash',
  'said.ringdown': 'ringdown',
  'said.sky': 'sky',
  'said.gas': 'gas',
  'said.volume': 'volume',
  'said.radio-volume': 'radio volume',
  'said.jets': 'jets',
  'said.bodies': 'bodies',
  'said.debris': 'debris',
  'said.polarisation': 'polarisation',
  'said.disk-of-particles': 'Disk of particles',
  'said.hot-spot': 'Hot spot',
  'said.flash': 'Flash',
  'said.body': 'Body',
  'said.jets-2': 'Jets',
  'said.a-celestial-grid-behind': 'A celestial grid behind.',
  'said.stars-and-a-milky-way': 'Stars and a Milky Way behind.',
  'said.the-stars-of-the-hipparcos': 'The stars of the Hipparcos catalogue and a Milky Way behind.',
  'said.stars-behind': 'Stars behind.',
  'said.the-stars-of-the-hipparcos-catalogue': 'The stars of the Hipparcos catalogue behind.',
  'said.a-milky-way-behind': 'A Milky Way behind.',
  'said.a-picture-of-the-sky': 'A picture of the sky behind.',
  'said.stars-over-a-picture-of': 'Stars over a picture of the sky behind.',
  'said.the-stars-of-the-hipparcos-catalogue-over':
    'The stars of the Hipparcos catalogue over a picture of the sky behind.',
  'said.the-server-is-stopping-and': 'the server is stopping and accepts no new sessions',
  'said.each-point-has-one-image':
    'each point has one image, which continues the image of the point before; this is the direct image, except that close to a spinning hole seen nearly edge on it may become an image whose light has gone round the hole; points within 1.2 horizon radii have no image',
  'hole.charged':
    'hole: it has a charge, which matter around a real hole would soon neutralise; light and matter here are neutral, and the charge affects them only through space-time',
  'said.the-body-is-a-test':
    'the body is a test particle: it has no gravity of its own, does not radiate, and is not disrupted by tides',
  'said.spin-parameter-a-a-0': 'spin parameter a; a < 0: the orbit or the disk turns against its hole',
  'said.spin-parameter-a-a-0-the': "spin parameter a; a < 0: the star's orbit is against the hole's spin",
  'said.spin-parameter-a-closer-to':
    'spin parameter a; closer to 1, damped and undamped modes crowd together and l, n no longer label them uniquely',
  'said.spin-parameter-a': 'spin parameter a',
  'said.impact-parameter-of-light-in': 'impact parameter of light in the equatorial plane, |L|/E',
  'said.polar-angle-of-the-observer':
    'polar angle of the observer, who is at infinity; at 90 the equatorial plane is seen edge-on',
  'said.polar-angle-of-the-observer-at': 'polar angle of the observer, at infinity; not within 0.1 of 90',
  'said.where-on-the-critical-curve':
    'position on the critical curve: angle about its centre, from the right over the top',
  'said.angular-momentum-positive-towards-phi':
    'angular momentum, positive towards +phi: per unit mass for matter, and of the photon for v_light',
  'said.radius-of-the-ring': 'radius of the ring',
  'said.mass-of-the-hole': 'mass of the hole',
  'said.accretion-rate-as-luminosity-over':
    'accretion rate as luminosity over the Eddington luminosity, with the efficiency of this spin',
  'said.multipole': 'multipole',
  'said.azimuthal-number-l-to-l': 'azimuthal number, -l to l; m > 0 turns with a hole of positive spin',
  'said.mass-of-the-hole-with': 'mass of the hole, with any redshift: m (1 + z)',
  'said.one-mass': 'mass of one body',
  'said.the-other': 'mass of the other body',
  'said.mass-of-the-star': 'mass of the star',
  'said.its-radius': 'radius of the star',
  'playground.star': 'star',
  'playground.moon': 'moon',
  'playground.companion': 'companion',
  'playground.first': 'first',
  'playground.second': 'second',
  'playground.third': 'third',
  'playground.fourth': 'fourth',
  'playground.fifth': 'fifth',
  'playground.one': 'one',
  'playground.two': 'two',
  'playground.three': 'three',
  'playground.other': 'other',
  'playground.a-star-on-a-pass': 'A star on a pass so close that the tide tears it apart',
  'playground.a-white-dwarf-torn-apart':
    'A white dwarf torn apart by a hole of a thousand suns: its debris comes back within a minute',
  'playground.white-dwarf': 'white dwarf',
  'playground.five-planets-round-the-hole': 'Five planets round the hole, and a moon',
  'playground.two-bodies-that-spiral-into':
    'Two bodies that spiral into each other; their loss to waves is exaggerated a thousand times',
  'playground.a-light-body-that-spirals':
    'A light body that spirals into the hole; its loss to waves is exaggerated twenty times',
  'playground.four-hundred-bodies-round-the': 'Four hundred bodies round the hole',
  'playground.three-bodies-that-follow-one':
    'Three bodies that follow one another along a figure of eight, far from the hole',
  'playground.gravity-of-the-hole-a':
    'gravity of the hole: a potential, in which bodies also attract one another, or exact geodesics of test bodies',
  'playground.charge-of-the-hole-gravity':
    'charge Q of the hole in M (gravity "kerr" only); the bodies are neutral; a^2 + Q^2 < 1',
  'playground.spin-of-the-hole-gravity': 'spin of the hole (gravity "kerr" only)',
  'playground.softening-length-in-m-of': "softening length in M of the bodies' mutual attraction",
  'playground.longest-sub-step-in-m': 'longest sub-step in M, and the interval at which debris is advanced',
  'playground.factor-c-of-the-limit':
    'factor C of the limit C (r - 2) of the sub-step, and of its limit for two close bodies',
  'playground.limit-of-the-sub-steps':
    'limit of the sub-steps of one advance; if it is reached, the advance is shorter than requested',
  'playground.bodies-that-touch-merge': 'bodies that touch merge',
  'playground.the-holes-tide-sheds-a': "the hole's tide sheds a star's mass, and tears it apart",
  'playground.bodies-lose-energy-to-gravitational': 'bodies lose energy to gravitational waves',
  'playground.factor-on-that-loss-1': 'factor on the loss to gravitational waves; 1: the physical value',
  'playground.debris-that-has-returned-is':
    'debris that has returned is counted as accreted and removed; otherwise it moves on',
  'playground.largest-number-of-pieces-of':
    'largest number of pieces of debris; beyond it, a new piece replaces the oldest',
  'playground.pieces-that-a-body-falls': 'number of pieces of debris of a body that is torn apart',
  'playground.temperature-in-k-of-the': 'temperature in K of the debris, a black body in pictures',
  'playground.share-of-the-disks-light':
    "share of the disk's light that bodies reflect in pictures; 0: reflection is not computed",
  'playground.optical-depth-in-pictures-of':
    'optical depth in pictures that the debris of one body has if it is spread over 1000 M^2',
  'playground.seed-of-the-random-directions': 'seed of the random directions of debris',
  'playground.mass-in-units-of-the':
    "mass in units of the hole's mass, at least 1e-30; 0: a test body that attracts nothing",
  'playground.radius-in-m-at-least': 'radius in M, at least 1e-30; 0: a point without collisions and tides',
  'playground.temperature-of-the-surface-in': 'temperature of the surface in K; 0: dark',
  'playground.the-simulation-has-reached-its': 'The simulation has reached its end, 1e12 M.',
  'playground.bodies-are-test-bodies-no':
    'Bodies are test bodies: no mutual attraction, no collisions, no tides, no gravitational waves.',
  'playground.the-holes-gravity-is-the':
    "The hole's gravity is the potential of Paczynski and Wiita, with Schwarzschild's last stable orbit, but without frame dragging and time dilation; its r is taken as Schwarzschild's.",
  'playground.the-hole-does-not-move': 'The hole does not move, and captured bodies do not increase its mass.',
  'playground.bodies-attract-one-another-by': "Bodies attract one another by Newton's law, softened and without delay.",
  'playground.speeds-are-limited-to-c': 'Speeds of bodies are limited to c.',
  'playground.bodies-accelerated-one-another-beyond':
    'Bodies accelerated one another to the speed limit c; limiting their speeds removed momentum.',
  'playground.the-loss-to-gravitational-waves':
    "The loss to gravitational waves follows Peters' formula, which is of leading order: at r = 10 M its power is 4 % too high for a = 0 and 27 % too high for a = 0.9; the error falls below 1 % only near 300 M.",
  'playground.the-exaggerated-loss-to-waves': 'The exaggerated loss to waves was limited to a tenth of the attraction.',
  'playground.there-are-too-many-bodies':
    'There are too many bodies to compute waves of all pairs: each body radiates only with the hole.',
  'playground.debris-starts-with-a-flat':
    "Debris starts with a flat distribution of energies, and moves in the hole's potential alone.",
};

// Patterns of error messages and of descriptions of what is seen. {} stands for a value with its unit, {…} for a list,
// and {?} for a remark on the type of the value. The first pattern that matches is used.
const patterns = [
  [
    'refusal.names-an-asset-of-this-server-which',
    '{} names an asset of this server, which a link cannot contain; it must be null',
  ],
  ['refusal.is-it-must-be-a-radius-outside', '{} is {}; it must be a radius outside the horizon, r = {}'],
  ['refusal.is-where-no-observer-can-be-observer', '{} is {}, where no observer can be {}; observer must be {…} there'],
  [
    'refusal.is-it-must-be-0-except-in',
    '{} is {}; it must be 0 except in the plane and pinhole projections, because in the others the angle of a pixel varies',
  ],
  [
    'refusal.is-it-must-be-to-camera-field',
    '{} is {}; it must be {} to {}, camera.field_m {} to {}, at this spacetime.mass_msun and spacetime.distance_pc',
  ],
  [
    'refusal.is-it-must-be-at-most-times',
    '{} is {}; it must be at most {}, {} times the width of the picture at this spacetime.mass_msun and spacetime.distance_pc',
  ],
  [
    'refusal.is-it-must-be-false-unless-style',
    '{} is {}; it must be false unless style.palette is {} and style.tone_map {}, because otherwise a brightness has no unique colour, or the scale is not linear',
  ],
  ['refusal.is-it-must-be-a-whole-number', '{} is {}{?}; it must be a whole number from {} to {}'],
  ['refusal.is-it-must-be-a-text-of', '{} is {}; it must be a text of {} to {} characters without control characters'],
  ['refusal.is-it-must-be-a-list-of', '{} is {}; it must be a list of {} to {} choices'],
  ['refusal.is-it-must-be-the-id-of', '{} is {}; it must be the id of an open session'],
  [
    'refusal.a-request-that-changes-or-stores-something',
    'a request that changes or stores something needs a token with the role render; yours has the role view',
  ],
  ['refusal.too-many-open-lessons-limit', 'too many open lessons (limit {})'],
  ['refusal.you-have-too-many-open-lessons-limit', 'you have too many open lessons (limit {} for one client)'],
  ['refusal.is-it-must-be-0-or-a', '{} is {}; it must be 0 or a multiple of 4 up to {}'],
  ['refusal.is-it-must-be-a-number-above', '{} is {}{?}; it must be a number above {} and below {}'],
  ['refusal.is-it-must-be-a-number-above-up', '{} is {}{?}; it must be a number above {}, up to {}'],
  ['refusal.is-it-must-be-up-to-not', '{} is {}{?}; it must be {} up to, not including, {}'],
  ['refusal.is-it-must-be-to-or', '{} is {}{?}; it must be {} to {}, or {}'],
  ['refusal.is-it-must-be-to', '{} is {}{?}; it must be {} to {}'],
  [
    'refusal.frame-the-picture-needs-of-memory-it',
    'frame {}: the picture needs {} of {} memory; it must be at most {} (limit: {…}): lower image.width, image.height or image.samples',
  ],
  [
    'refusal.is-in-a-tile-it-must-be',
    '{} is {}; in a tile it must be a number, because {} depends on the whole picture; a small picture of the same scene gives one',
  ],
  [
    'refusal.is-in-a-tile-it-must-be-0',
    '{} is {}; in a tile it must be 0, because a lens spreads light over the whole picture',
  ],
  [
    'refusal.is-in-a-tile-it-must-be-0-because',
    '{} is {}; in a tile it must be 0, because a beam spreads light over the whole picture',
  ],
  [
    'refusal.is-in-a-tile-it-must-be-false',
    '{} is {}; in a tile it must be false, because the bar is in a corner of the whole picture',
  ],
  [
    'refusal.is-in-a-tile-it-must-be-1',
    '{} is {}; in a tile it must be 1 to 8, because {} depends on the whole picture',
  ],
  [
    'refusal.is-in-a-tile-it-must-be-a',
    '{} is {}; in a tile it must be a number, because {} depends on the whole picture',
  ],
  ['refusal.frame-it-would-take-about-more-than', 'frame {}: it would take about {}; a frame must take at most {}'],
  ['refusal.is-it-must-be-at-least-the', '{} is {}; it must be at least {}, the ISCO of {} {}, or {}'],
  ['refusal.is-it-must-be-at-least-the-isco', '{} is {}; it must be at least {}, the ISCO of {} {} and {} {}, or {}'],
  ['refusal.is-it-must-be-at-least-the-isco-of', '{} is {}; it must be at least {}, the ISCO of {} {} and {} {}'],
  ['refusal.is-it-must-be-more-than-the', '{} is {}; it must be more than {}, the horizon of {} {} and {} {}'],
  ['refusal.is-with-spin-its-magnitude-must-be', '{} is {}; with spin {} its magnitude must be below {}'],
  ['refusal.is-with-spacetime-spin-it-must-be', '{} is {}; with spacetime.spin {} it must be at most {}'],
  [
    'refusal.is-with-spacetime-charge-it-must-be',
    '{} is {}; with spacetime.charge {} it must be {}, because it is known for an uncharged hole only',
  ],
  [
    'refusal.spacetime-charge-is-it-must-be-that',
    "spacetime.charge is {}; it must be {}, because the playground's bodies move round a hole of that charge",
  ],
  [
    'refusal.bodies-and-debris-move-in-the-potential',
    "spacetime.charge is {}; it must be {}, because the playground's bodies and debris move in the potential of an uncharged hole",
  ],
  [
    'refusal.the-potential-is-that-of-an-uncharged',
    'charge is {}; without gravity "kerr" it must be {}, because the potential is that of an uncharged hole',
  ],
  ['refusal.is-it-must-be-at-least-the-isco-of-2', '{} is {}; it must be at least {}, the ISCO of {} {}'],
  ['refusal.is-it-must-be-more-than-the-horizon', '{} is {}; it must be more than {}, the horizon of {} {}'],
  ['refusal.is-it-must-be-more-than-the-inner', '{} is {}; it must be more than the inner edge, {}, which is the ISCO'],
  ['refusal.is-it-must-be-more-than-the-inner-edge', '{} is {}; it must be more than the inner edge, {}'],
  ['refusal.is-it-must-be-less-than', '{} is {}; it must be less than {}, {}'],
  ['refusal.is-with-it-must-be', '{} is {} with {} {}; it must be {}'],
  [
    'refusal.is-for-camera-observer-at-this-inclination',
    '{} is {}; for camera.observer {} at this inclination it must be more than {}, the ergosphere; inside, camera.observer must be {…}',
  ],
  [
    'refusal.is-for-camera-observer-at-this-inclination-it',
    '{} is {}; for camera.observer {} at this inclination it must be more than {}, the photon orbit; inside, camera.observer must be {…}',
  ],
  [
    'refusal.is-it-must-be-a-velocity-of',
    '{} is {}; it must be a velocity of at most 0.999 together with the other two components',
  ],
  [
    'refusal.camera-velocity-r-velocity-theta-and-velocity',
    'camera.velocity_r, velocity_theta and velocity_phi make a speed of {} c; it must be less than 1',
  ],
  [
    'refusal.is-for-camera-observer-it-must-be',
    '{} is {}; for camera.observer {} it must be more than {}, the inner horizon, where the model ends',
  ],
  ['refusal.is-it-must-be-at-least-camera', '{} is {}; it must be at least camera.r, {}'],
  [
    'refusal.is-at-camera-r-with-this-angular',
    '{} is {}; at camera.r {} with this angular momentum it must be at least {}',
  ],
  [
    'refusal.is-with-which-the-observer-turns-back',
    '{} is {}, with which the observer turns back outside camera.r {}; it must be closer to 0',
  ],
  [
    'refusal.is-with-motion-proper-time-rate-of',
    '{} is {}; with motion.proper_time_rate {} of a falling observer it must be {}, because the fall enters the ergosphere, where slow light is not computed',
  ],
  [
    'refusal.is-it-must-be-unless-camera-r',
    '{} is {}; it must be {} unless camera.r is finite and the projection is pinhole',
  ],
  [
    'refusal.is-it-must-be-smaller-because-camera',
    "{} is {}; it must be smaller, because camera.observer cannot exist at an eye's position",
  ],
  [
    'refusal.is-it-must-be-0-unless-camera',
    '{} is {}; it must be 0 unless the observer stays at a finite camera.r, orbits there in the equatorial plane, or falls from there at constant latitude',
  ],
  [
    'refusal.is-with-motion-proper-time-rate-it',
    "{} is {}; with motion.proper_time_rate {} it must be 0, because the observer's path determines time and azimuth",
  ],
  [
    'refusal.is-it-must-be-unless-camera-observer',
    '{} is {}; it must be {} unless camera.observer is {} at a finite camera.r',
  ],
  ['refusal.is-which-needs-a-finite-at-it', '{} is {}, which needs a finite {}; at {} it must be {}'],
  ['refusal.is-which-needs-a-thin-disk-with', '{} is {}, which needs a thin disk; with {} {} it must be {}'],
  ['refusal.is-which-needs-the-exact-flux', '{} is {}, which needs the exact flux; with {} {} it must be {}'],
  ['refusal.is-which-needs-with-it-must-be', '{} is {}, which needs {} {}; with {} {} M it must be {}'],
  ['refusal.is-which-needs-a-2-q-2', '{} is {}, which needs a^2 + Q^2 of at most {}^2; with {} {} it must be {}'],
  [
    'refusal.is-ghz-it-must-be-at-most',
    "{} is {} GHz; it must be at most {} GHz, {} k T/h of the disk's largest colour temperature, beyond which the disk is dark",
  ],
  ['refusal.is-which-needs-at-it-must-be', '{} is {}, which needs {} {}; at {} it must be {}'],
  ['refusal.is-whose-parallel-rays-need-at-it', '{} is {}, whose parallel rays need {} {}; at {} it must be {}'],
  [
    'refusal.is-with-it-must-be-0-because',
    '{} is {}; with {} {} it must be 0, because beyond {} the modes of a hole crowd together and none rings alone',
  ],
  [
    'refusal.is-with-this-hole-e-and-inclination',
    '{} is {}; with this hole, e and inclination_deg it must be above the separatrix at {}',
  ],
  [
    'refusal.is-inside-the-horizon-at-it-must',
    "{} is {}; inside the horizon, at {} {}, it must be {}, because coordinate time does not define the light's delay there",
  ],
  ['refusal.is-inside-the-horizon-at-it-must-be', '{} is {}; it must be at least {}, the horizon'],
  ['refusal.is-not-outside-the-horizon-at', '{} is {}; it must be more than {}, the horizon'],
  ['refusal.is-and-l-is-it-must-be', '{} is {}; with l {} it must be {} to {}'],
  [
    'refusal.there-is-no-the-list-has-elements',
    'there is no {}: the list has {} elements, and the next free index is {}',
  ],
  [
    'refusal.there-is-no-the-list-has-element',
    'there is no {}: the list has {} element, and the next free index is {}',
  ],
  ['refusal.too-many-open-sessions-limit', 'too many open sessions (limit {})'],
  [
    'refusal.is-for-an-orbit-that-will-plunge',
    '{} is {}; for an orbit that will plunge it must be another, because {} follows only bound orbits',
  ],
  [
    'refusal.volume-grid-has-matter-for-a-hole',
    'volume.grid has matter for a hole of spin {}; spacetime.spin is {} and must be the same',
  ],
  [
    'refusal.volume-grid-has-matter-for-a-charged-hole',
    'volume.grid has matter for a hole of charge {}; spacetime.charge is {} and must be the same',
  ],
  ['refusal.is-a-picture-of-x-it-must', '{} is a picture of {} x {}; it must be a grid of matter, an NPZ file'],
  [
    'refusal.is-a-grid-of-matter-of-x',
    '{} is a grid of matter of {} x {} x {} nodes; it must be a picture of the whole sky',
  ],
  [
    'refusal.a-grid-of-matter-is-an-npz',
    'the file is not a grid of matter (an NPZ file of arrays): {} is missing, damaged or longer than {} bytes',
  ],
  [
    'refusal.a-grid-of-matter-is-an-npz-file',
    'the file is not a grid of matter (an NPZ file of arrays): {} is missing; it must be {}',
  ],
  [
    'refusal.a-grid-of-matter-is-an-npz-file-of',
    'the file is not a grid of matter (an NPZ file of arrays): {…} is {}; it must be {}',
  ],
  [
    'refusal.a-grid-of-matter-is-an-npz-file-of-arrays',
    'the file is not a grid of matter (an NPZ file of arrays): {…}',
  ],
  ['seen.matter-from-a-grid-of-numbers-from', 'Matter from a grid of numbers from {} to {}, at {} GHz.'],
  [
    'seen.matter-from-a-series-of-grids-from',
    'Matter from a series of grids from {} to {}, at {} GHz, whose times are {} to {}; its light left at {} to {}.',
  ],
  ['seen.no-matter-no-file-is-chosen', 'No matter: no file is chosen.'],
  ['seen.a-thin-disk-from-the-isco-to', 'A thin disk from the ISCO to {}.'],
  ['seen.a-thin-disk-from-to', 'A thin disk from {} to {}.'],
  ['seen.a-thick-disk-of-turbulent-gas-from', 'A thick disk of turbulent gas from the ISCO to {}.'],
  ['seen.a-thick-disk-of-turbulent-gas-from-to', 'A thick disk of turbulent gas from {} to {}.'],
  ['seen.a-thick-disk-from-the-isco-to', 'A thick disk from the ISCO to {}.'],
  ['seen.a-thick-disk-from-to', 'A thick disk from {} to {}.'],
  ['seen.matter-all-round-from-to', 'Matter all round from {} to {}.'],
  ['seen.a-thin-disk-of-turbulent-gas-from', 'A thin disk of turbulent gas from the ISCO to {}.'],
  ['seen.a-thin-disk-of-turbulent-gas-from-to', 'A thin disk of turbulent gas from {} to {}.'],
  ['seen.a-disk-of-particles-from-the-isco', 'A disk of {} particles from the ISCO to {}.'],
  ['seen.a-disk-of-particles-from-to', 'A disk of {} particles from {} to {}.'],
  ['seen.the-echo-of-a-flash', 'The echo of a flash at {} on the axis.'],
  ['seen.hot-spots-going-round-at', 'Hot spots going round at {…}.'],
  ['seen.a-body-at', 'A body at {…}.'],
  ['seen.bodies-at', 'Bodies at {…}.'],
  ['seen.bodies-of-a-playground-at-m-of', '{…} bodies of a playground at {…} M of its time.'],
  ['seen.body-of-a-playground-at-m-of', '{…} body of a playground at {…} M of its time.'],
  [
    'seen.bodies-that-are-not-shown-because-they',
    'Bodies that are not shown, because they have no radius or are at the horizon: {…}.',
  ],
  ['seen.pieces-of-debris-from-m-to-m', '{…} pieces of debris, from {…} M to {…} M.'],
  ['refusal.is-it-must-be-or', '{} is {}; it must be {…} or {}'],
  ['refusal.body', 'body {}'],
  ['refusal.swarm', 'swarm {}'],
  [
    'refusal.position-is-from-the-hole-it-must',
    'position is {} from the hole; it must be more than {}, inside which the hole captures everything',
  ],
  ['refusal.position-holds-it-must-be-to', 'position holds {}; it must be {} to {}'],
  ['refusal.velocity-is-c-it-must-be-at', 'velocity is {} c; it must be at most c'],
  ['refusal.velocity-is-c-it-must-be-less', 'velocity is {} c; it must be less than c'],
  ['refusal.too-many-bodies-limit-for-a-playground', 'too many bodies (limit {} for a playground)'],
  ['refusal.there-is-no-body-or-it-no', 'there is no body {}, or it no longer exists'],
  ['refusal.there-is-no-body-with-this-id', 'there is no body with this id, or it no longer exists'],
  ['refusal.cannot-change-after-a-playground-is-made', '{} cannot change after a playground is made'],
  [
    'refusal.preset-cannot-be-used-with-a-snapshot',
    'preset cannot be used with a snapshot, because a snapshot has its own bodies',
  ],
  ['seen.the-loss-to-gravitational-waves-is-exaggerated', 'The loss to gravitational waves is exaggerated {} times.'],
];

// Units and remarks that occur within the values of a pattern.
const amounts = {
  'amount.a-string-where-a-number-is-needed': ', a string where a number is needed',
  'amount.where-a-number-is-needed': ' where a number is needed',
  'amount.a-range-whose-count-is': ', a range whose count is',
  'amount.a-range-with-the-value': ', a range with the value',
  'amount.solar-masses': 'solar masses',
  'amount.solar-radii': 'solar radii',
  'amount.eddington-rates': 'Eddington rates',
  'amount.the-free-memory-of-the-host': 'the free memory of the host',
  'amount.the-device': 'the device',
  'amount.device': 'device',
  'amount.host': 'host',
  'amount.microarcseconds': 'microarcseconds',
  'amount.pixels': 'pixels',
  'amount.degrees-per-second': 'degrees per second',
  'amount.degrees': 'degrees',
  'amount.decades': 'decades',
  'amount.bits': 'bits',
  'amount.stops': 'stops',
  'amount.days': 'days',
};

const named = new Map(Object.entries(amounts).map(([id, english]) => [english, id]));
// Matches whole words only, and none within quotes or a dotted name: "bits" matches neither "orbits" nor image.bits.
const whole = english => `${/^\w/.test(english) ? '(?<![\\w./-])' : ''}${english}(?![\\w/-]|\\.\\w)`,
  measured = new RegExp(['"[^"]*"', ...[...named.keys()].map(whole)].join('|'), 'g');

const value =
  '("[^"]*"|[^ ,;:]+(?: (?:M|[A-Z]?[a-z]+ rates|solar masses|solar radii|pixels|degrees(?: per second)?|decades|bits|stops|days|pc|microarcseconds|GiB|s))?)';
const remark =
  '(, a string where a number is needed| where a number is needed|, a range (?:whose count is|with the value) [^;]+|)';
const shape = english =>
  new RegExp(
    `^${english
      .replace(/[.*+()^]/g, '\\$&')
      .replaceAll('{}', value)
      .replaceAll('{…}', '(.+)')
      .replace('{?}', remark)}$`,
  );
const shapes = patterns.map(([id, english]) => [id, shape(english)]),
  exact = new Map(Object.entries(sentences).map(([id, english]) => [english, id])),
  strips = '; strips might fit, but ',
  ranges = /, or a range first:last:count of (\d+) to (\d+) such values$/;

// Translates the sentence with the words of a locale. Returns undefined if the sentence is not known.
export function translated(text, words) {
  if (exact.has(text)) return words[exact.get(text)];
  const fill = (id, values) => words[id]?.replace(/\{(\d)\}/g, (_, i) => values[i]);
  const [whole, why] = text.split(strips);
  if (why)
    return fill(
      'refusal.strips',
      [whole, why].map(part => translated(part, words) ?? part),
    );
  const range = ranges.exec(text);
  if (range) {
    const one = translated(text.slice(0, range.index), words);
    return one && fill('refusal.range', [one, range[1], range[2]]);
  }
  for (const [id, pattern] of shapes) {
    const values = pattern.exec(text)?.slice(1);
    if (values)
      return fill(
        id,
        values.map(part => part.replace(measured, found => words[named.get(found)] ?? found)),
      );
  }
}
