// The text under each curve, and its derivation, which is folded at first.
import { t } from './language.js';

export const explained = {
  'null-potential': {
    text: t(
      'explained.null-potential',
      'Light has no mass, but it has an energy E and an angular momentum L, and both stay the same on its way. Only their ratio b = L/E matters: it is the distance by which the light would miss the hole if it went straight. The hill is the least energy that light with L = 1 needs to be at r. Where the line 1/b runs into the hill, light turns back; where it passes above the top, nothing holds it and it falls in. On the top itself light can go round in a circle, but the smallest push takes it off. This circle is the photon orbit, and the edge of the shadow is made of rays that almost stay there.',
    ),
    steps: [
      t(
        'explained.null-potential.0',
        'Without spin a null path in the plane obeys (dr/dλ)² = E² − (L²/r²)(1 − 2M/r). It turns where the right-hand side is zero, so where 1/b² = (1 − 2M/r)/r².',
      ),
      t(
        'explained.null-potential.1',
        'The hill is highest where the slope of 1/r² − 2M/r³ is zero: −2/r³ + 6M/r⁴ = 0, so r = 3M.',
      ),
      t(
        'explained.null-potential.2',
        'There 1/b² = (1 − 2/3)/(9M²) = 1/(27M²): light with b below √27 M = 5.196 M is caught. With spin the hill is another one for each sense of turning.',
      ),
    ],
  },
  deflection: {
    text: t(
      'explained.deflection',
      'A ray that passes far outside is bent by 4M/b, twice as much as Newton’s particles of light would be: half of it comes from time, which runs slower near the mass, and half from space, which is curved there. Closer in the exact angle grows faster, and next to b_c it grows without bound: the ray winds round the hole once, twice, any number of times before it leaves. So each thing behind the hole is seen again and again, in images that crowd together at the edge of the shadow. With spin, light that goes round in its sense can come closer than light that goes against it.',
    ),
    steps: [
      t(
        'explained.deflection.0',
        'With u = 1/r the orbit of light is u″ + u = 3Mu². Without the right-hand side it is a straight line, u = sin φ / b.',
      ),
      t(
        'explained.deflection.1',
        'Put that line into the small term on the right: the solution bends by 2M/b on each half of the way, 4M/b in all.',
      ),
      t(
        'explained.deflection.2',
        'Near the photon orbit a departure grows by a factor e for each radian or so, so the angle goes as −ln(b/b_c − 1).',
      ),
    ],
  },
  'photon-rings': {
    text: t(
      'explained.photon-rings',
      'Light that has made n half turns round the hole is seen as a ring of order n, and each ring holds a whole picture of all that surrounds the hole. The rings do not get fainter per area but thinner: each is e^−γ times as wide as the one before. γ is the Lyapunov exponent of the photon orbit that is seen in that direction: in half a turn a small departure grows by the factor e^γ. Without spin it is π all round, and each ring 23 times thinner than the last; with spin γ depends on the place along the edge. Light also arrives later by half a turn for each order, an echo that no telescope has resolved yet.',
    ),
    steps: [
      t(
        'explained.photon-rings.0',
        'Beside an orbit r̃ of the photon shell the radial potential is R ≈ ½R″(r̃)(r − r̃)², so in Mino time τ a distance grows as exp(τ√(½R″)).',
      ),
      t(
        'explained.photon-rings.1',
        'From one crossing of the equatorial plane to the next passes the half period τ½ of the motion in latitude: γ = τ½ √(½R″(r̃)).',
      ),
      t(
        'explained.photon-rings.2',
        'To be just outside at the same place after one half turn more, a ray must start e^γ times closer to the critical curve: so widths go as e^−γn.',
      ),
    ],
  },
  potential: {
    text: t(
      'explained.potential',
      'A body of given L moves like a ball in a valley: it can be where its energy line lies above the curve. Newton’s valley always has a floor. Here gravity wins in the end: the curve falls again close to the hole, so that next to the stable circle in the valley there is an unstable one on the hill. With less L the two come together, and at the ISCO they meet: the valley is gone, and what comes nearer plunges without another push. That is why disks have an inner edge.',
    ),
    steps: [
      t(
        'explained.potential.0',
        'Without spin V² = (1 − 2M/r)(1 + L²/r²). A circle needs dV²/dr = 0, which gives L² = Mr²/(r − 3M): no circle inside 3M.',
      ),
      t(
        'explained.potential.1',
        'It is stable where V² has a minimum. L² as a function of r is least where r = 6M, with L = √12 M: there minimum and maximum merge.',
      ),
      t(
        'explained.potential.2',
        'On that orbit E = √(8/9): falling to it has freed 5.7 % of the mass. With a spin near the largest it is 42 %.',
      ),
    ],
  },
  redshift: {
    text: t(
      'explained.redshift',
      'One number says what becomes of light on its way: g, the frequency that arrives over the frequency that was sent. Gas deep in the well and gas that moves fast has slower clocks, and g falls; gas that comes towards us raises it again. Brightness goes as the fourth power of g, so that a small difference makes one side of the disk blinding and the other dim. The colour goes along: a black body of temperature T looks like one of temperature gT. None of this is put in by hand; it follows from the path of each ray.',
    ),
    steps: [
      t(
        'explained.redshift.0',
        'Photons neither crowd nor thin out in phase space (Liouville), so I_ν/ν³ is the same all along a ray: I_ν,obs = g³ I_ν,em.',
      ),
      t(
        'explained.redshift.1',
        'Summed over frequencies one more g comes from dν: I = g⁴ I_em. Counted otherwise: each photon brings g of its energy, they come g times as often, and into a solid angle g² times smaller.',
      ),
      t(
        'explained.redshift.2',
        'For a circle in the equatorial plane g = 1/(u^t (1 − Ωλ)), with the gas’s Ω and u^t and the ray’s λ = L/E.',
      ),
    ],
  },
  kerr: {
    text: t(
      'explained.kerr',
      'Five radii tell most of what a spin does. The horizon shrinks from 2M to M. Light that goes round with the spin can do so ever closer to it, light that goes against it only farther out, up to 4M. The last stable orbit of matter follows: from 6M inwards with the spin, out to 9M against it. A disk that turns with its hole therefore reaches deeper, is hotter, and turns more of its matter into light.',
    ),
    steps: [
      t(
        'explained.kerr.0',
        'In the equatorial plane the radial motion is R = [E(r² + a²) − aL]² − Δ[μ²r² + (L − aE)²], Δ = r² − 2Mr + a².',
      ),
      t(
        'explained.kerr.1',
        'A circular orbit of light has R = R′ = 0 with μ = 0: r^{3/2} − 3Mr^{1/2} ± 2aM^{1/2} = 0, whose root is the formula above.',
      ),
      t('explained.kerr.2', 'The ISCO has R = R′ = R″ = 0 with μ = 1: r² − 6Mr ± 8a√(Mr) − 3a² = 0.'),
    ],
  },
  'disk-flux': {
    text: t(
      'explained.disk-flux',
      'Gas in a disk loses its orbital energy to friction and radiates it on the spot. The dashed line is what Newton’s gravity gives if the disk is simply cut off at the ISCO. The full line is the exact balance of energy and angular momentum in Kerr, under the assumption that nothing pulls on the gas at the inner edge. The light peaks a little farther out than the edge, and the temperature follows as its fourth root. How bright and how blue a disk is depends on the hole’s mass: large holes have cool disks.',
    ),
    steps: [
      t(
        'explained.disk-flux.0',
        'A ring that hands its angular momentum outwards at a rate Ṁ L,r must radiate the work of the torque: F = −(Ṁ/4πr) Ω,r (E − ΩL)⁻² ∫(E − ΩL) L,r dr from the ISCO to r (Page & Thorne 1974).',
      ),
      t('explained.disk-flux.1', 'Far out F → 3MṀ/(8πr³), so T = (F/σ)^¼ falls as r^−3/4.'),
      t(
        'explained.disk-flux.2',
        'All of it together is the binding energy of the ISCO: the efficiency is 1 − E(ISCO), whatever the friction is.',
      ),
    ],
  },
  returning: {
    text: t(
      'explained.returning',
      'Not all light of a disk gets away. Some of it falls into the hole, and some is bent over the hole and comes down on the disk again, mostly on the other side. The nearer a ring is to the hole, the more of its light has this fate; next to a fast hole most of it has. The gas that is lit absorbs this light and shines a little hotter, and part of that returns once more. The light that falls in also brakes the hole’s spin: this is why accretion does not drive it beyond about 0.998.',
    ),
    steps: [
      t(
        'explained.returning.0',
        'A photon keeps its energy E and angular momentum L at infinity. Gas on a circular orbit sees it with u^t (E − ΩL), and g is the ratio of two of these.',
      ),
      t(
        'explained.returning.1',
        'F is the light of one face, F₀ what the gas would radiate alone, and the integral is over all directions from which light of the disk arrives, at the angle whose cosine is μ.',
      ),
      t(
        'explained.returning.2',
        'Returning light brings less angular momentum than the gas has. The stress F_t that carries the difference away does work, so that energy is conserved (Cunningham 1976).',
      ),
      t(
        'explained.returning.3',
        'The equation is solved by counting returns: one more in each step, until nothing changes.',
      ),
    ],
  },
  'returning-by-spin': {
    text: t(
      'explained.returning-by-spin',
      'The faster the hole turns with the disk, the deeper the disk reaches, and the more of its light the hole bends back to it. Of a whole disk little returns, because most of its light comes from farther out. Of the innermost ring’s light more than half may return, counted by energy. What falls into the hole from that ring also grows at first; next to the largest spin it falls again, because nearly all light then meets the disk first. A disk round a fast hole lights itself: models of its spectrum and polarisation must count this light.',
    ),
    steps: [
      t(
        'explained.returning-by-spin.0',
        'From a ring at r rays are followed in all directions of the gas’s sky. Each ends at infinity, on the disk or in the hole.',
      ),
      t(
        'explained.returning-by-spin.1',
        'Each direction counts by the light it carries: cos of its angle to the normal, times the energy at infinity, E = 1/(u^t (1 − ΩL/E)).',
      ),
      t(
        'explained.returning-by-spin.2',
        'The whole disk is the sum over its rings, each with its flux (Page & Thorne 1974) and its area.',
      ),
    ],
  },
  'line-of-rings': {
    text: t(
      'explained.line-of-rings',
      'Iron that is lit by X-rays shines in a narrow line at 6.4 keV. From a ring of the disk this line arrives with two horns: the bluer one from gas that approaches, the redder one from gas that recedes. The smaller the ring, the wider its horns stand apart, and the more all of it is shifted to the red by gravity. The whole line is the sum of the rings. Its long red tail is the light of the innermost ones, and that is how a line tells the spin: with a faster hole the disk reaches deeper and the tail gets longer.',
    ),
    steps: [
      t(
        'explained.line-of-rings.0',
        'A piece of the picture sends dN = g³ ε(r) dα dβ photons, at g times the energy that they have at rest (Cunningham 1975).',
      ),
      t(
        'explained.line-of-rings.1',
        'On a ring g depends on the azimuth alone. Next to its least and its largest value it changes slowly, so that many photons have nearly this energy: the horns.',
      ),
      t(
        'explained.line-of-rings.2',
        'The page requests the line of each ring, with the number of its photons, and adds the shares.',
      ),
    ],
  },
  echo: {
    text: t(
      'explained.echo',
      'A lamp above the hole flashes once. Its light reaches the disk’s middle first and then runs outwards, and each place answers with the iron line. The first answer that we see is from gas on the near side, from where the way to us is shortest. Then the innermost rings answer, on all sides: for a short while the line reaches far into the red. What follows is gas farther and farther out, whose line is narrow and nearly at rest. Telescopes measure the delay between the lamp’s own light and its echo, and learn from it how high the lamp stands.',
    ),
    steps: [
      t(
        'explained.echo.0',
        'Each ray from the lamp has a time t₁ to the disk, and each ray from the disk a time t₂ to us. The light that comes directly takes t₀; time is counted from there.',
      ),
      t(
        'explained.echo.1',
        'A piece of the picture sends dN = g³ ε(r, t₁) dt₁ dα dβ photons at g × 6.4 keV and at t₁ + t₂ − t₀.',
      ),
      t(
        'explained.echo.2',
        'The bright cells are these photons by energy and time. Their mean time is the lag of the echo, before the lamp’s own light in the same band dilutes it.',
      ),
    ],
  },
  'frame-dragging': {
    text: t(
      'explained.frame-dragging',
      'A spinning hole takes space along. Something dropped from rest with no angular momentum at all is soon going round, at the rate ω. Farther in even light has little choice: all that moves does so between the two outer lines. Where the lower one crosses zero begins the ergosphere, in which nothing can stand still as seen from afar. At the horizon the three lines meet: there everything turns at the one rate of the hole itself.',
    ),
    steps: [
      t(
        'explained.frame-dragging.0',
        'L = g_tφ ṫ + g_φφ φ̇ is kept. For L = 0 the angular velocity is dφ/dt = −g_tφ/g_φφ = ω.',
      ),
      t(
        'explained.frame-dragging.1',
        'Light moves round at Ω± = ω ± √(ω² − g_tt/g_φφ). The lower one is zero where g_tt = 0: r = 2M in the equatorial plane, for every spin.',
      ),
      t(
        'explained.frame-dragging.2',
        'Far away ω → 2J/r³. Gravity Probe B measured how the Earth’s rotation turns a gyroscope in this way: by 37 milliseconds of arc a year.',
      ),
    ],
  },
  flamm: {
    text: t(
      'explained.flamm',
      'Stop the clock and cut the space round the hole along its equatorial plane: the cut is not flat. Drawn as a bowl in ordinary space, its circles have the right circumference and its slopes the right distance from one circle to the next. Near the horizon the wall is steep: there is much more room between two circles than on paper. It is a picture of space alone, and not a funnel that things roll down: what makes things fall is mostly time, which the picture leaves out.',
    ),
    steps: [
      t(
        'explained.flamm.0',
        'At one instant, a = 0, θ = 90°: dl² = dr²/(1 − 2M/r) + r² dφ². A surface z(r) in flat space has dl² = (1 + z′²)dr² + r² dφ².',
      ),
      t(
        'explained.flamm.1',
        'So z′² = 2M/(r − 2M), and z = 2√(2M(r − 2M)): half a parabola that is turned round (L. Flamm 1916).',
      ),
      t(
        'explained.flamm.2',
        'With spin a circle at r has the circumference 2π√g_φφ, larger than 2πr; the line is then computed step by step.',
      ),
    ],
  },
  qnm: {
    text: t(
      'explained.qnm',
      'A hole that has been struck rings like a bell, at pitches that depend on its mass and spin alone. But it is a poor bell: light and waves that linger at the photon orbit leak away within a few swings. The pitch is about the frequency of light on its circular orbit, and the sound fades as fast as that orbit is unstable. So this curve and the curve of photon rings have the same cause. Listening to the ringdown of a merger therefore weighs the new hole and tells its spin; two tones of one hole would test whether it is Kerr’s at all.',
    ),
    steps: [
      t(
        'explained.qnm.0',
        'A small wave on Kerr splits into e^{−iωt} e^{imφ} S(θ) R(r) (Teukolsky 1973). Nothing may come out of the horizon, and nothing may come in from afar: only some complex ω allow this.',
      ),
      t(
        'explained.qnm.1',
        'As a power series with these boundary conditions built in, R has coefficients with a three-term recurrence. The recurrence has a minimal solution where a continued fraction is zero (Leaver 1985).',
      ),
      t(
        'explained.qnm.2',
        'For large l: ω ≈ l Ω_ph − i(n + ½)|λ|, with the orbit’s frequency and its Lyapunov exponent in time.',
      ),
    ],
  },
  inspiral: {
    text: t(
      'explained.inspiral',
      'Two masses that go round each other send out waves, the waves carry energy away, and so the orbit shrinks. The smaller it gets the faster it turns and the more it loses: pitch and loudness rise together, ever faster, to the merger. How fast the pitch rises tells one combination of the masses, the chirp mass. The curve is the leading order, which is good while the two are far apart; the last few turns need more terms, and the merger itself a supercomputer.',
    ),
    steps: [
      t(
        'explained.inspiral.0',
        'Power of the waves: P = (32/5) m₁²m₂²(m₁ + m₂)/a⁵ (G = c = 1; Peters 1964). Energy of the orbit: −m₁m₂/(2a).',
      ),
      t(
        'explained.inspiral.1',
        'dE/dt = −P gives the da/dt above, so a⁴ falls evenly and the time that is left is (5/256) a⁴/(m₁m₂(m₁ + m₂)).',
      ),
      t('explained.inspiral.2', 'By Kepler f = √((m₁ + m₂)/a³)/π, and f goes as (time left)^−3/8.'),
    ],
  },
  tidal: {
    text: t(
      'explained.tidal',
      'A star that comes too close is pulled harder on its near side than on its far side, until its own gravity no longer holds it. Half of it is flung out, the other half stays bound and comes back, the most tightly bound first. How much comes back a day then falls as t^−5/3, and so, roughly, does the flare that telescopes see. Around a very heavy hole the tide at the horizon is too weak: it swallows a sunlike star whole.',
    ),
    steps: [
      t('explained.tidal.0', 'The tide beats the star’s own gravity where (M/r³)R > m/R²: within r_t = R (M/m)^{1/3}.'),
      t(
        'explained.tidal.1',
        'There the energies of the debris spread by ± M R/r_t², about evenly. By Kepler an energy −ε comes back after t = 2πM/(2ε)^{3/2}.',
      ),
      t('explained.tidal.2', 'An even spread dm/dε with ε as t^−2/3 gives dm/dt as t^−5/3 (Rees 1988, Phinney 1989).'),
    ],
  },
};
