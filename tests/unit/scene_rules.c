/* Tests of the rules that connect fields, and of the presets. */
#include "scene_support.h"
#include "scene/label.h"

#include "physics/spacetime/kerr.h"
#include "render/emit/motion.h"

struct rule {
    const char *json;
    const char *pointer; /* place of the mistake; NULL: the document is valid */
    const char *fragment;
};

/* Radii computed by hand: r+ = 1 + sqrt(1 - a^2) is 1.8 at a = 0.6; the ergosphere is 2 in the plane; the ISCO is 6
 * at a = 0. */
static const struct rule rules[] = {
    { "{\"image\":{\"bit_depth\":8}}", NULL, NULL },
    { "{\"polarization\":{\"model\":\"transfer\"}}", "/polarization/model",
      "which needs a volume.model with electrons in a magnetic field" },
    { "{\"disk\":{\"model\":\"none\"},\"volume\":{\"model\":\"riaf\"},\"polarization\":{\"model\":\"transfer\"}}", NULL,
      NULL },
    { "{\"disk\":{\"model\":\"none\"},\"volume\":{\"model\":\"gold\"},\"polarization\":{\"model\":\"transfer\"}}",
      "/polarization/model", "\"riaf\"" },
    { "{\"disk\":{\"model\":\"none\"},\"volume\":{\"model\":\"riaf\",\"electrons\":\"kappa\"},\"polarization\":{"
      "\"model\":\"transfer\"}}",
      NULL, NULL },
    { "{\"disk\":{\"model\":\"none\"},\"volume\":{\"model\":\"torus\",\"electrons\":\"kappa\",\"kappa\":5.5},"
      "\"polarization\":{\"model\":\"transfer\"}}",
      "/volume/kappa", "volume.kappa is 5.5; with polarization.model \"transfer\" it must be 3.5 to 5" },
    { "{\"volume\":{\"model\":\"riaf\"},\"polarization\":{\"model\":\"transfer\"}}", "/polarization/model",
      "only the volume shines" },
    { "{\"disk\":{\"model\":\"none\"},\"volume\":{\"model\":\"riaf\"},\"polarization\":{\"model\":\"transfer\"},"
      "\"camera\":{\"projection\":\"ring\"}}",
      "/polarization/model", "no upward direction" },
    { "{\"image\":{\"bit_depth\":16}}", NULL, NULL },
    { "{\"image\":{\"bit_depth\":12}}", "/image/bit_depth", "image.bit_depth is 12; it must be 8 or 16 bits" },
    { "{\"camera\":{\"projection\":\"pinhole\"}}", "/camera/projection", "which needs a finite camera.r" },
    { "{\"camera\":{\"projection\":\"fulldome\"}}", "/camera/projection",
      "camera.projection is \"fulldome\", which needs a finite camera.r" },
    { "{\"camera\":{\"projection\":\"equirectangular\",\"r\":30,\"centre_beta\":1}}", "/camera/centre_beta",
      "in the equirectangular projection it must be 0" },
    { "{\"camera\":{\"projection\":\"pinhole\",\"r\":20}}", NULL, NULL },
    { "{\"camera\":{\"projection\":\"plane\",\"r\":20}}", "/camera/projection", "at 20 M it must be \"pinhole\"" },
    { "{\"camera\":{\"projection\":\"plane\"}}", NULL, NULL },
    { "{\"camera\":{\"projection\":\"auto\",\"r\":20}}", NULL, NULL },
    { "{\"camera\":{\"projection\":\"ring\",\"r\":20}}", "/camera/projection",
      "needs camera.r \"infinity\"; at 20 M it must be \"pinhole\"" },
    { "{\"camera\":{\"projection\":\"ring\",\"roll_deg\":90}}", NULL, NULL },
    { "{\"camera\":{\"projection\":\"ring\",\"centre_beta\":1}}", "/camera/centre_beta",
      "in the ring projection it must be 0" },
    { "{\"camera\":{\"projection\":\"ring\",\"yaw_deg\":1}}", "/camera/yaw_deg", "camera.ring_decades_max" },
    { "{\"camera\":{\"ring_decades_min\":-3,\"ring_decades_max\":-3}}", "/camera/ring_decades_min",
      "camera.ring_decades_min is -3; it must be less than camera.ring_decades_max, -3" },
    { "{\"camera\":{\"ring_decades_min\":-3.5,\"ring_decades_max\":-3}}", NULL, NULL },
    { "{\"camera\":{\"yaw_deg\":5}}", "/camera/yaw_deg", "camera.yaw_deg is 5; in the plane projection it must be 0" },
    { "{\"camera\":{\"pitch_deg\":-5}}", "/camera/pitch_deg", "because camera.centre_alpha" },
    { "{\"camera\":{\"r\":20,\"yaw_deg\":5,\"pitch_deg\":5}}", NULL, NULL },
    { "{\"camera\":{\"r\":20,\"centre_alpha\":5}}", "/camera/centre_alpha", "because camera.yaw_deg" },
    { "{\"camera\":{\"r\":20,\"centre_beta\":5}}", "/camera/centre_beta", "in the pinhole projection" },
    { "{\"camera\":{\"centre_alpha\":5,\"centre_beta\":-5}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0.6},\"camera\":{\"r\":1.8,\"observer\":\"zamo\"}}", "/camera/r",
      "camera.r is 1.8 M; it must be more than 1.8 M, the horizon of spacetime.spin 0.6" },
    { "{\"spacetime\":{\"spin\":-0.6},\"camera\":{\"r\":1.7,\"observer\":\"zamo\"}}", "/camera/r", "the horizon" },
    { "{\"spacetime\":{\"spin\":0.6},\"camera\":{\"r\":1.81,\"observer\":\"zamo\"}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0.6},\"camera\":{\"r\":1.9,\"inclination_deg\":90}}", "/camera/r",
      "camera.r is 1.9 M; for camera.observer \"static\" at this inclination it must be more than 2 M" },
    { "{\"spacetime\":{\"spin\":0.6},\"camera\":{\"r\":1.9,\"inclination_deg\":90}}", "/camera/r", "\"zamo\"" },
    { "{\"spacetime\":{\"spin\":0.6},\"camera\":{\"r\":2,\"inclination_deg\":90}}", "/camera/r", "ergosphere" },
    { "{\"spacetime\":{\"spin\":0.6},\"camera\":{\"r\":2.01,\"inclination_deg\":90}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0.6},\"camera\":{\"r\":1.81,\"inclination_deg\":0}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0.6},\"camera\":{\"r\":1.81,\"inclination_deg\":180}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":3,\"observer\":\"keplerian\"}}", "/camera/r",
      "for camera.observer \"keplerian\" at this inclination it must be more than 3 M, the photon orbit; "
      "inside, camera.observer must be \"static\" or" },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":3.001,\"observer\":\"keplerian\",\"inclination_deg\":0}}", NULL,
      NULL },
    { "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"r\":1.6,\"observer\":\"keplerian\",\"inclination_deg\":90}}", NULL,
      NULL }, /* the photon orbit is at 1.558 */
    { "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"r\":1.5,\"observer\":\"keplerian\",\"inclination_deg\":90}}",
      "/camera/r", "1.5578" },
    { "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"r\":3.9,\"observer\":\"retrograde\",\"inclination_deg\":90}}",
      "/camera/r", "3.910" },
    { "{\"camera\":{\"r\":9,\"observer\":\"velocity\",\"velocity_r\":-0.6,\"velocity_phi\":0.79}}", NULL, NULL },
    { "{\"camera\":{\"r\":9,\"observer\":\"velocity\",\"velocity_r\":-0.6,\"velocity_phi\":0.8}}",
      "/camera/velocity_phi", "make a speed of 1 c; it must be less than 1" },
    { "{\"camera\":{\"r\":9,\"observer\":\"velocity\",\"velocity_r\":-0.8,\"velocity_phi\":0.6}}", "/camera/velocity_r",
      "make a speed of 1" },
    { "{\"camera\":{\"r\":9,\"velocity_theta\":0.1}}", "/camera/velocity_theta",
      "camera.velocity_theta is 0.1; it must be 0 unless camera.observer is \"velocity\" at a finite camera.r" },
    { "{\"camera\":{\"observer\":\"velocity\",\"velocity_phi\":0.1}}", "/camera/velocity_phi", "at a finite camera.r" },
    { "{\"image\":{\"tile\":{\"left\":1216,\"top\":656,\"width\":64,\"height\":64}}}", NULL, NULL },
    { "{\"image\":{\"tile\":{\"left\":1217,\"width\":64,\"height\":64}}}", "/image/tile/width",
      "it must be at most 63 in a picture of image.width 1280" },
    { "{\"image\":{\"tile\":{\"top\":720,\"width\":64,\"height\":64}}}", "/image/tile/height",
      "it must be at most 0 in a picture of image.height 720" },
    { "{\"image\":{\"tile\":{\"width\":64}}}", "/image/tile/height", "both must be above 0, or both 0" },
    { "{\"image\":{\"tile\":{\"height\":64}}}", "/image/tile/width", "both must be above 0, or both 0" },
    { "{\"image\":{\"tile\":{\"left\":3}}}", "/image/tile/left", "both must be 0 without" },
    { "{\"camera\":{\"stereo\":\"pair\"}}", "/camera/stereo", "it must be \"none\" unless camera.r is finite" },
    { "{\"camera\":{\"stereo\":\"pair\",\"r\":9}}", NULL, NULL },
    { "{\"camera\":{\"stereo\":\"pair\",\"r\":9,\"projection\":\"fulldome\"}}", "/camera/stereo",
      "the projection is pinhole" },
    { "{\"camera\":{\"stereo\":\"pair\",\"r\":9,\"eye_distance\":9}}", "/camera/eye_distance", "is 9 M" },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"stereo\":\"pair\",\"r\":2.05,\"yaw_deg\":90,\"eye_distance\":1}}",
      "/camera/eye_distance", "it must be smaller" },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"stereo\":\"pair\",\"r\":2.05,\"yaw_deg\":90,\"eye_distance\":0.5}}",
      NULL, NULL },
    { "{\"motion\":{\"proper_time_rate\":1}}", "/motion/proper_time_rate",
      "is 1; it must be 0 unless the observer stays" },
    { "{\"camera\":{\"r\":9},\"motion\":{\"proper_time_rate\":1}}", NULL, NULL },
    { "{\"camera\":{\"r\":9,\"observer\":\"keplerian\"},\"motion\":{\"proper_time_rate\":1}}",
      "/motion/proper_time_rate", "orbits there in the equatorial plane" },
    { "{\"camera\":{\"r\":9,\"observer\":\"velocity\"},\"motion\":{\"proper_time_rate\":1}}",
      "/motion/proper_time_rate", "it must be 0 unless" },
    { "{\"camera\":{\"r\":9,\"observer\":\"infall\",\"infall_from\":10},\"motion\":{\"proper_time_rate\":1}}",
      "/motion/proper_time_rate", "at constant latitude" },
    { "{\"camera\":{\"r\":9,\"observer\":\"infall\"},\"disk\":{\"slow_light\":true},\"motion\":{\"proper_time_rate\":1}"
      "}",
      "/disk/slow_light",
      "disk.slow_light is true; with motion.proper_time_rate 1 of a falling observer it must be false" },
    { "{\"camera\":{\"r\":9,\"observer\":\"zamo\"},\"disk\":{\"slow_light\":true},\"motion\":{\"proper_time_rate\":1}}",
      NULL, NULL },
    { "{\"camera\":{\"r\":9,\"observer\":\"infall\"},\"motion\":{\"proper_time_rate\":1,\"time_rate\":2}}",
      "/motion/time_rate", "motion.time_rate is 2; with motion.proper_time_rate 1 it must be 0" },
    { "{\"camera\":{\"r\":9,\"observer\":\"infall\"},\"motion\":{\"proper_time_rate\":1,\"azimuth_rate_deg\":2}}",
      "/motion/azimuth_rate_deg", "motion.azimuth_rate_deg is 2; with motion.proper_time_rate 1 it must be 0" },
    { "{\"camera\":{\"r\":9,\"infall_from\":10}}", "/camera/infall_from",
      "it must be \"infinity\" unless camera.observer is \"infall\"" },
    { "{\"camera\":{\"r\":9,\"infall_energy\":2}}", "/camera/infall_energy", "it must be \"rest\" unless" },
    { "{\"camera\":{\"r\":9,\"infall_momentum\":2}}", "/camera/infall_momentum", "it must be 0 unless" },
    { "{\"camera\":{\"r\":9,\"observer\":\"infall\"}}", NULL, NULL },
    { "{\"camera\":{\"r\":9,\"observer\":\"infall\",\"infall_from\":9}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":2,\"observer\":\"infall\"}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":0.01,\"observer\":\"infall\"}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":2,\"observer\":\"velocity\"}}", "/camera/r",
      "more than 2 M, the horizon" },
    { "{\"spacetime\":{\"spin\":0.6},\"camera\":{\"r\":0.201,\"observer\":\"infall\"}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":-0.6},\"camera\":{\"r\":0.199,\"observer\":\"infall\"}}", "/camera/r",
      "camera.r is 0.199 M; for camera.observer \"infall\" it must be more than 0.2 M, the inner horizon, where the "
      "model ends" },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":1,\"observer\":\"infall\",\"inclination_deg\":90,\"infall_"
      "energy\":-0.1}}",
      "/camera/infall_energy", "it must be at least 0" },
    { "{\"camera\":{\"r\":9,\"observer\":\"infall\",\"infall_from\":8.9}}", "/camera/infall_from",
      "is 8.9 M; it must be at least camera.r, 9 M" },
    { "{\"camera\":{\"r\":9,\"observer\":\"infall\",\"infall_from\":10,\"infall_energy\":1}}", "/camera/infall_energy",
      "camera.infall_energy is 1 with camera.infall_from 10 M; it must be \"rest\"" },
    /* At a = 0, E^2 = 1 - 2/r for a body at rest, and (1 - 2/r) (1 + L^2/r^2) with angular momentum L: 25/36 at r = 4,
     * L = 2.5. A marginally bound body turns back if |L| > 4. */
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":8,\"observer\":\"infall\",\"infall_energy\":0.86}}",
      "/camera/infall_energy", "at camera.r 8 M with this angular momentum it must be at least 0.866025" },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":8,\"observer\":\"infall\",\"infall_energy\":0.8661}}", NULL,
      NULL },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":3,\"observer\":\"infall\",\"inclination_deg\":90,\"infall_"
      "momentum\":3.99}}",
      NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":3,\"observer\":\"infall\",\"inclination_deg\":90,\"infall_"
      "momentum\":4.01}}",
      "/camera/infall_momentum", "with which the observer turns back outside camera.r 3 M" },
    { "{\"camera\":{\"r\":9,\"observer\":\"infall\",\"inclination_deg\":0,\"infall_momentum\":1}}",
      "/camera/infall_momentum", "turns" }, /* no L is possible on the axis */
    { "{\"spacetime\":{\"spin\":0.9999},\"style\":{\"ringdown\":1}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":-0.99991},\"style\":{\"ringdown\":0}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0.8,\"charge\":0.599999999}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0,\"charge\":0.999999999999}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0.8,\"charge\":0.6}}", "/spacetime/charge",
      "spacetime.charge is 0.6 M; with spacetime.spin 0.8 it must be at most 0.599999999 M" },
    { "{\"spacetime\":{\"spin\":-0.999999999999,\"charge\":0.1}}", "/spacetime/charge", "it must be at most" },
    { "{\"spacetime\":{\"spin\":0.6,\"charge\":0.5},\"camera\":{\"r\":1.6,\"observer\":\"zamo\"}}", "/camera/r",
      "more than 1.6244998 M, the horizon of spacetime.spin 0.6 and spacetime.charge 0.5" },
    { "{\"spacetime\":{\"spin\":0.1,\"charge\":0.9},\"camera\":{\"r\":0.576,\"observer\":\"infall\"}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0.1,\"charge\":0.9},\"camera\":{\"r\":0.575,\"observer\":\"infall\"}}", "/camera/r",
      "camera.r is 0.575 M; for camera.observer \"infall\" it must be more than 0.575735932 M, the inner horizon, "
      "where "
      "the model ends" },
    { "{\"spacetime\":{\"spin\":0,\"charge\":0.5},\"disk\":{\"inner\":5.6}}", "/disk/inner",
      "at least 5.606643428 M, the ISCO of spacetime.spin 0 and spacetime.charge 0.5" },
    { "{\"spacetime\":{\"spin\":0,\"charge\":0.5},\"disk\":{\"inner\":5.61}}", NULL, NULL },
    { "{\"spacetime\":{\"charge\":0.5},\"style\":{\"ringdown\":0.5}}", "/style/ringdown",
      "style.ringdown is 0.5; with spacetime.charge 0.5 it must be 0, because it is known for an uncharged hole only" },
    { "{\"spacetime\":{\"charge\":0.5},\"disk\":{\"model\":\"particles\"}}", NULL, NULL },
    { "{\"spacetime\":{\"charge\":0.5},\"volume\":{\"model\":\"grid\"}}", NULL, NULL },
    { "{\"spacetime\":{\"charge\":0.5},\"disk\":{\"height\":0.1},\"volume\":{\"model\":\"riaf\"},\"jets\":{"
      "\"brightness\":1},"
      "\"bodies\":[{\"radius\":1}]}",
      NULL, NULL },
    { "{\"spacetime\":{\"spin\":-0.99991},\"style\":{\"ringdown\":0.5}}", "/style/ringdown",
      "style.ringdown is 0.5; with spacetime.spin -0.99991 it must be 0, because beyond 0.9999" },
    /* M is 3.8189932 uas for m87's mass and distance: 10 M are 38.19 */
    { "{\"style\":{\"name\":\"eht\"}}", NULL, NULL },
    { "{\"style\":{\"name\":\"eht\"},\"camera\":{\"r\":20}}", NULL, NULL },
    { "{\"style\":{\"beam_uas\":20},\"camera\":{\"projection\":\"ring\"}}", "/style/beam_uas",
      "style.beam_uas is 20; it must be 0 except in the plane and pinhole projections" },
    { "{\"style\":{\"beam_uas\":20},\"camera\":{\"projection\":\"fulldome\",\"r\":20}}", "/style/beam_uas",
      "in the others the angle of a pixel varies" },
    { "{\"style\":{\"palette\":\"heat\"},\"camera\":{\"projection\":\"ring\"}}", NULL, NULL },
    { "{\"style\":{\"beam_uas\":38189},\"spacetime\":{\"mass_msun\":6.5e9,\"distance_pc\":16.8e6},\"camera\":{\"field_"
      "m\":10}}",
      NULL, NULL },
    { "{\"style\":{\"beam_uas\":38191},\"spacetime\":{\"mass_msun\":6.5e9,\"distance_pc\":16.8e6},\"camera\":{\"field_"
      "m\":10}}",
      "/style/beam_uas", "style.beam_uas is 38191 microarcseconds; it must be at most 38189.9" },
    /* 2 10^6 M tan(5e-6) is 10 M, too */
    { "{\"style\":{\"beam_uas\":38189},\"spacetime\":{\"mass_msun\":6.5e9,\"distance_pc\":16.8e6},\"camera\":{\"r\":"
      "1e6,\"fov_deg\":5.729577951e-4}}",
      NULL, NULL },
    { "{\"style\":{\"beam_uas\":38191},\"spacetime\":{\"mass_msun\":6.5e9,\"distance_pc\":16.8e6},\"camera\":{\"r\":"
      "1e6,\"fov_deg\":5.729577951e-4}}",
      "/style/beam_uas", "it must be at most 38189.9" },
    { "{\"style\":{\"colour_bar\":true,\"palette\":\"heat\",\"tone_map\":\"srgb\"}}", NULL, NULL },
    { "{\"style\":{\"colour_bar\":true,\"palette\":\"heat\"}}", "/style/colour_bar",
      "style.colour_bar is true; it must be false unless" },
    { "{\"style\":{\"colour_bar\":true,\"tone_map\":\"srgb\"}}", "/style/colour_bar",
      "style.palette is \"heat\" and style.tone_map \"srgb\"" },
    { "{\"style\":{\"palette\":\"heat\",\"bloom\":1,\"beam_uas\":5}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"disk\":{\"inner\":6}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"disk\":{\"inner\":5.999}}", "/disk/inner",
      "disk.inner is 5.999 M; it must be at least 6 M, the ISCO of spacetime.spin 0" },
    { "{\"spacetime\":{\"spin\":0},\"disk\":{\"inner\":5,\"model\":\"none\"}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0.9},\"disk\":{\"inner\":2.4}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":-0.9},\"disk\":{\"inner\":2.4}}", "/disk/inner", "8.71" }, /* retrograde */
    { "{\"spacetime\":{\"spin\":0},\"disk\":{\"outer\":5.9}}", "/disk/outer",
      "more than the inner edge, 6 M, which is the ISCO" },
    { "{\"spacetime\":{\"spin\":0},\"disk\":{\"outer\":6.001}}", NULL, NULL },
    { "{\"disk\":{\"inner\":15,\"outer\":15}}", "/disk/outer",
      "disk.outer is 15 M; it must be more than the inner edge, 15 M" },
    { "{\"disk\":{\"inner\":15,\"outer\":14,\"model\":\"none\"}}", NULL, NULL },
    { "{\"disk\":{\"inner\":15,\"outer\":15.5}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"spot2\":{\"brightness\":1,\"r\":5.999}}", "/spots/1/r",
      "spots.1.r is 5.999 M; it must be at least 6 M, the ISCO of spacetime.spin 0" },
    { "{\"flash\":{\"brightness\":1}}", NULL, NULL },
    { "{\"flash\":{\"brightness\":1,\"height\":2},\"spacetime\":{\"spin\":0}}", "/flash/height",
      "flash.height is 2 M; it must be at least 2.1 M for spacetime.spin 0" },
    { "{\"flash\":{\"height\":1}}", NULL, NULL },
    { "{\"flash\":{\"brightness\":1,\"duration\":2,\"period\":23}}", "/flash/period",
      "flash.period is 23 M; it must be 0 or at least 24 M, 12 times flash.duration" },
    { "{\"flash\":{\"brightness\":1,\"duration\":2,\"period\":24}}", NULL, NULL },
    { "{\"flash\":{\"brightness\":1},\"disk\":{\"height\":0.1}}", "/flash/brightness",
      "flash.brightness is 1; with disk.height 0.1 it must be 0" },
    { "{\"flash\":{\"brightness\":1},\"disk\":{\"model\":\"none\",\"inner\":2}}", "/disk/inner", "ISCO" },
    { "{\"flash\":{\"brightness\":1},\"disk\":{\"model\":\"none\",\"outer\":2}}", "/disk/outer", "inner edge" },
    { "{\"disk\":{\"model\":\"none\",\"inner\":2}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":-0.9},\"spot3\":{\"brightness\":1,\"r\":8}}", "/spots/2/r", "8.71" },
    { "{\"spacetime\":{\"spin\":0},\"spot1\":{\"brightness\":1,\"r\":6}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"spot1\":{\"brightness\":0,\"r\":2}}", NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"spots\":[{\"r\":2},{\"brightness\":1,\"r\":5}]}", "/spots/1/r",
      "spots.1.r is 5 M" },
    { "{\"volume\":{\"model\":\"torus\"}}", NULL, NULL },
    { "{\"disk\":{\"band\":\"frequency\",\"peak_temperature_k\":10000,\"hardening\":2,\"frequency_ghz\":26670872}}",
      NULL, NULL },
    { "{\"disk\":{\"band\":\"frequency\",\"peak_temperature_k\":10000,\"hardening\":2,\"frequency_ghz\":26670873}}",
      "/disk/frequency_ghz", "disk.frequency_ghz is 26670873 GHz; it must be at most 26670872.47" },
    { "{\"disk\":{\"band\":\"bolometric\",\"peak_temperature_k\":10000,\"frequency_ghz\":26670873}}", NULL, NULL },
    { "{\"disk\":{\"band\":\"frequency\",\"frequency_ghz\":230},\"volume\":{\"normalise_to_jy\":1}}",
      "/volume/normalise_to_jy", "it must be 0" },
    { "{\"volume\":{\"model\":\"riaf\",\"normalise_to_jy\":2.4}}", "/volume/normalise_to_jy",
      "volume.normalise_to_jy is 2.4 Jy; it must be 0 unless only a volume at a radio frequency shines" },
    { "{\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":\"none\"},\"volume\":{\"model\":\"riaf\",\"normalise_to_jy\":"
      "2.4}}",
      NULL, NULL },
    { "{\"spacetime\":{\"spin\":0},\"volume\":{\"model\":\"torus\",\"torus_radius\":6}}", "/volume/torus_radius",
      "volume.torus_radius is 6 M; it must be more than the ISCO, 6 M" },
    { "{\"volume\":{\"model\":\"torus\",\"inner\":12}}", "/volume/inner",
      "volume.inner is 12 M; it must be less than volume.torus_radius, 12 M, and more than the photon "
      "orbit" },
    { "{\"spacetime\":{\"spin\":-0.9},\"volume\":{\"model\":\"torus\",\"inner\":3}}", "/volume/inner",
      "photon orbit, 3.91" },
    { "{\"spacetime\":{\"spin\":0.9},\"volume\":{\"model\":\"torus\",\"inner\":6,\"torus_radius\":40}}",
      "/volume/torus_radius",
      "volume.torus_radius is 40 M with the inner edge at 6 M, for which the torus has no outer edge" },
    { "{\"volume\":{\"model\":\"torus\",\"electrons\":\"power-law\",\"gamma_max\":2}}", "/volume/gamma_max",
      "more than volume.gamma_min" },
};

static void fields_fit_each_other(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
        const struct rule *rule = &rules[i];
        struct kd_scene scene;
        struct kd_error error = { 0 };
        kd_scene_defaults(&scene);
        if (support_parse(&scene, rule->json, &error))
            fail_msg("%s: %s", rule->json, error.message);
        enum kd_status status = kd_scene_validate(&scene, &error);
        if ((status == KD_OK) != !rule->pointer)
            fail_msg("%s gave %d %s", rule->json, status, error.message);
        if (rule->pointer && (strcmp(error.pointer, rule->pointer) || !strstr(error.message, rule->fragment)))
            fail_msg("%s gave \"%s\" \"%s\"", rule->json, error.pointer, error.message);
        assert_int_equal(kd_scene_validate(&scene, NULL), status);
    }
}

/* The inner edge may be exactly at the ISCO, but not at the next smaller double. */
static void inner_edge_may_touch_the_isco(void **state)
{
    (void)state;
    for (double spin = -0.998; spin < 0.999; spin += 0.0625) {
        struct kd_scene scene;
        kd_scene_defaults(&scene);
        scene.spacetime.spin = spin;
        scene.disk.inner = kd_kerr_isco(kd_hole(spin));
        assert_int_equal(kd_scene_validate(&scene, NULL), KD_OK);
        scene.disk.inner = nextafter(scene.disk.inner, 0);
        assert_int_equal(kd_scene_validate(&scene, NULL), KD_EINVAL);
    }
}

/* A scene filled in by hand, without any parser. */
static void put_wrong(struct kd_scene *scene, const struct kd_row *field, size_t index)
{
    if (field->kind == KD_KIND_ASSET)
        assert_int_equal(
            kd_field_store(scene, field, index, &(struct kd_value) { KD_VALUE_STRING, 0, "nobody-knows" }, NULL),
            KD_OK);
    else
        kd_field_put(scene, field, index, field->kind >= KD_KIND_INT ? -7 : -INFINITY);
}

static void ranges_are_checked_again(void **state)
{
    (void)state;
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_row *field = &kd_fields[i];
        struct kd_scene scene;
        struct kd_error error;
        char pointer[KD_PATH_SIZE];
        if (field->kind == KD_KIND_BOOL)
            continue;
        kd_scene_defaults(&scene);
        const struct kd_section *section = kd_section_find(field->object);
        size_t last = section->most ? section->most - 1 : 0;
        put_wrong(&scene, field, last);
        kd_field_pointer(field, last, pointer);
        if (section->most) { /* elements beyond the end of a list are not checked */
            assert_int_equal(kd_scene_validate(&scene, &error), KD_OK);
            kd_section_resize(&scene, section, last);
            kd_section_resize(&scene, section, last + 1);
            put_wrong(&scene, field, last);
        }
        assert_int_equal(kd_scene_validate(&scene, &error), KD_EINVAL);
        assert_string_equal(error.pointer, pointer);
    }
}

static void lists_have_an_end(void **state)
{
    (void)state;
    struct kd_scene scene;
    struct kd_error error;
    kd_scene_defaults(&scene);
    scene.spots.count = KD_SPOTS;
    assert_int_equal(kd_scene_validate(&scene, &error), KD_OK);
    scene.spots.count = KD_SPOTS + 1;
    assert_int_equal(kd_scene_validate(&scene, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/spots/16");
    assert_string_equal(error.message, "spots has 17 elements; it must have at most 16");
}

/* A session draws a new frame if a visible part of the scene has moved. */
static void what_moves(void **state)
{
    (void)state;
    static const struct {
        const char *json;
        bool moves;
    } cases[] = {
        { "{}", false },
        { "{\"motion\":{\"time_rate\":5,\"azimuth_rate_deg\":5}}", false },
        { "{\"motion\":{\"time_rate\":5},\"spot3\":{\"brightness\":1}}", true },
        { "{\"motion\":{\"azimuth_rate_deg\":5},\"spot2\":{\"brightness\":1}}", true },
        { "{\"spot1\":{\"brightness\":1}}", false },
        { "{\"motion\":{\"time_rate\":5},\"disk\":{\"model\":\"particles\"}}", true },
        { "{\"motion\":{\"azimuth_rate_deg\":-5},\"sky\":{\"model\":\"grid\"}}", true },
        { "{\"motion\":{\"time_rate\":5},\"sky\":{\"model\":\"grid\"}}", false },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kd_scene scene;
        kd_scene_smooth(&scene);
        assert_int_equal(support_parse(&scene, cases[i].json, NULL), KD_OK);
        if (kd_emit_moves(&scene) != cases[i].moves)
            fail_msg("%s: it %s", cases[i].json, cases[i].moves ? "does not move" : "moves");
    }
}

static void presets_are_valid(void **state)
{
    (void)state;
    static const char *const names[] = { "smooth",       "schwarzschild", "reissner-nordstrom",
                                         "gargantua",    "m87",           "sgra",
                                         "luminet1979",  "edge-on",       "face-on",
                                         "photon-rings", "living-disk",   "hot-spot",
                                         "echo",         "milky-way",     "gas",
                                         "gas-stars",    "thick-disk",    "star-behind",
                                         "companions",   "falling",       "infall",
                                         "jet",          "gargantua-gas", "polarised-ring",
                                         "gold-1",       "gold-2",        "gold-3",
                                         "gold-4",       "gold-5",        "riaf",
                                         "torus" };
    char hashes[sizeof names / sizeof *names][65];
    assert_int_equal(kd_scene_preset_count(), sizeof names / sizeof *names);
    for (size_t i = 0; i < kd_scene_preset_count(); i++) {
        struct kd_scene scene;
        struct kd_error error;
        assert_string_equal(kd_scene_preset_name(i), names[i]);
        assert_true(strlen(kd_scene_preset_title(i)) > 10);
        /* tests that the label fits in one line beside a small picture */
        assert_in_range(strlen(kd_scene_preset_label(i)), 3, 26);
        memset(&scene, 0xff, sizeof scene);
        if (kd_scene_preset(&scene, names[i], &error) || kd_scene_validate(&scene, &error))
            fail_msg("%s: %s %s", names[i], error.pointer, error.message);
        assert_int_equal(kd_scene_hash(&scene, hashes[i]), KD_OK);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(hashes[i], hashes[j]);
    }
    assert_null(kd_scene_preset_name(kd_scene_preset_count()));
    assert_null(kd_scene_preset_label(SIZE_MAX));
    assert_null(kd_scene_preset_title(SIZE_MAX));
}

static void presets_show_what_they_say(void **state)
{
    (void)state;
    static const char *const stirred[] = { "falling", "infall", "jet", "thick-disk", "companions" };
    struct kd_scene scene, base;
    for (size_t i = 0; i < kd_scene_preset_count(); i++) { /* electrons are required only in scenes with gas */
        assert_int_equal(kd_scene_preset(&scene, kd_scene_preset_name(i), NULL), KD_OK);
        bool gas = strstr(kd_scene_preset_name(i), "gas");
        for (size_t k = 0; k < sizeof stirred / sizeof *stirred; k++)
            gas |= !strcmp(kd_scene_preset_name(i), stirred[k]);
        assert_true((scene.gas.amplitude > 0) == gas && (scene.disk.emission_opacity > 0) == gas);
    }
    kd_scene_smooth(&base);
    assert_int_equal(kd_scene_preset(&scene, "smooth", NULL), KD_OK);
    assert_memory_equal(&scene, &base, sizeof scene);
    kd_scene_defaults(&base);
    assert_int_equal(kd_scene_preset(&scene, "gas", NULL), KD_OK);
    assert_true(scene.motion.time_rate == 6);
    scene.motion.time_rate = 0;
    assert_memory_equal(&scene, &base, sizeof scene);
    assert_int_equal(kd_scene_preset(&scene, "schwarzschild", NULL), KD_OK);
    assert_true(scene.spacetime.spin == 0);
    assert_int_equal(kd_scene_preset(&scene, "gargantua", NULL), KD_OK);
    assert_true(scene.spacetime.spin == 0.999 && scene.disk.doppler && scene.disk.redshift);
    assert_int_equal(kd_scene_preset(&scene, "m87", NULL), KD_OK);
    assert_true(scene.camera.inclination_deg == 163 && scene.spacetime.mass_msun == 6.5e9);
    struct kd_scene old;
    assert_int_equal(kd_scene_preset(&old, "m87-eht", NULL), KD_OK); /* its former name */
    assert_memory_equal(&old, &scene, sizeof old);
    assert_int_equal(kd_scene_preset(&scene, "edge-on", NULL), KD_OK);
    assert_true(scene.camera.inclination_deg == 90);
    assert_int_equal(kd_scene_preset(&scene, "face-on", NULL), KD_OK);
    assert_true(scene.camera.inclination_deg == 0);
}

static void unknown_preset_names_the_known(void **state)
{
    (void)state;
    struct kd_scene scene, before;
    struct kd_error error;
    kd_scene_defaults(&scene);
    before = scene;
    static const char *const wrong[] = { "", "Gargantua", "gargantua ", "garg", "\x1b[2J" };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(kd_scene_preset(&scene, wrong[i], &error), KD_EINVAL);
        for (size_t p = 0; p < kd_scene_preset_count(); p++)
            assert_non_null(strstr(error.message, kd_scene_preset_name(p)));
        assert_null(strchr(error.message, '\x1b'));
        assert_memory_equal(&scene, &before, sizeof before);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_fit_each_other),
        cmocka_unit_test(inner_edge_may_touch_the_isco),
        cmocka_unit_test(ranges_are_checked_again),
        cmocka_unit_test(presets_are_valid),
        cmocka_unit_test(presets_show_what_they_say),
        cmocka_unit_test(unknown_preset_names_the_known),
        cmocka_unit_test(what_moves),
        cmocka_unit_test(lists_have_an_end),
    };
    return cmocka_run_group_tests_name("scene rules", tests, NULL, NULL);
}
