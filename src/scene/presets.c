#include "scene/label.h"
#include "scene/presets.h"

#include "base/spelling.h"
#include "physics/spacetime/scale.h"
#include "scene/scene.h"
#include "document/text.h"

#include <stdio.h>
#include <string.h>

#define SMOOTH \
    "{\"disk\":{\"emission_opacity\":0,\"peak_temperature_k\":5600,\"gas\":{\"amplitude\":0}},\"style\":{\"name\":" \
    "\"none\",\"bloom\":0}}"

/* A scene of R. Gold et al. 2020 (ApJ 897, 148), section 3.2: the picture is 30 M wide and high. */
#define GOLD(spin, rest) \
    "{\"spacetime\":{\"spin\":" spin ",\"mass_msun\":4.063e6,\"distance_pc\":7778}," \
    "\"camera\":{\"inclination_deg\":60,\"field_m\":30}," \
    "\"disk\":{\"model\":\"none\"}," \
    "\"volume\":{\"model\":\"gold\",\"outer\":80," rest "}," \
    "\"style\":{\"name\":\"raw\",\"palette\":\"heat\"}," \
    "\"image\":{\"width\":512,\"height\":512}}"

/* The coordinates of M87* are those of S. B. Lambert & A.-M. Gontier 2009 (A&A 493, 317), and those of Sagittarius
 * A* are from M. J. Reid & A. Brunthaler 2004 (ApJ 616, 872). The dates are those of the pictures that the Event
 * Horizon Telescope has published: 11 and 7 April 2017 (ApJL 875, L1; ApJL 930, L12). */
#define M87_(rest) "\"source\":{\"name\":\"m87\",\"ra_deg\":187.7059308,\"dec_deg\":12.3911233" rest "},"
#define SGRA_(rest) "\"source\":{\"name\":\"sgra\",\"ra_deg\":266.4168371,\"dec_deg\":-29.0078106" rest "},"
#define M87 M87_("")
#define M87_2017 M87_(",\"mjd\":57854")
#define SGRA SGRA_("")
#define SGRA_2017 SGRA_(",\"mjd\":57850")

#define TEXT_(tokens) #tokens
#define TEXT(macro) TEXT_(macro)
#define HOLE(mass, distance) "\"mass_msun\":" TEXT(mass) ",\"distance_pc\":" TEXT(distance)
#define M87_HOLE HOLE(KD_SCALE_M87_MSUN, KD_SCALE_M87_PC)
#define SGRA_HOLE HOLE(KD_SCALE_SGRA_MSUN, KD_SCALE_SGRA_PC)

/* A thick, hot flow at 230 GHz (docs/physics/volume.md). */
#define HOT_FLOW(inner, density) \
    "\"disk\":{\"model\":\"none\"}," \
    "\"volume\":{\"model\":\"riaf\",\"inner\":" inner ",\"outer\":25,\"density_cm3\":" density "," \
    "\"height\":0.3,\"electron_temperature_k\":3e11,\"frequency_ghz\":230},"

const struct kd_preset kd_presets[] = {
    { "smooth", "Smooth disk", "A smooth, opaque disk with the exact Page-Thorne flux, without the glare of a lens",
      false, SMOOTH },
    { "schwarzschild", "No spin", "A hole without spin, its disk seen from 10 degrees above", true,
      "{\"spacetime\":{\"spin\":0},"
      "\"camera\":{\"inclination_deg\":80},"
      "\"image\":{\"samples\":2}}" },
    { "reissner-nordstrom", "A charged hole",
      "A hole without spin that is charged almost to the limit: the shadow is nearly a quarter narrower than without "
      "charge, "
      "and light circles at 2 M instead of 3 M",
      true,
      "{\"spacetime\":{\"spin\":0,\"charge\":0.999},"
      "\"camera\":{\"inclination_deg\":80,\"field_m\":36},"
      "\"image\":{\"samples\":2}}" },
    { "gargantua", "Gargantua, unaltered",
      "The hole and camera of James et al. 2015: nearly extremal spin, seen from 74 M, a disk from 9.26 to 18.7 M at "
      "about 4500 K; with the Doppler shift and the redshift that the film left out",
      true,
      "{\"spacetime\":{\"spin\":0.999,\"mass_msun\":1e8},"
      "\"camera\":{\"r\":74.1,\"inclination_deg\":86.56,\"fov_deg\":38},"
      "\"disk\":{\"inner\":9.26,\"outer\":18.7,\"taper\":0.15,\"peak_temperature_k\":14000},"
      "\"image\":{\"samples\":2}}" },
    /* The next two presets have the same scale: 214 microarcseconds across. The inner edge of the flow is chosen so
     * that the ring has the measured diameter when it is seen through the beam. The density is chosen so that the
     * flux is close to the measured flux, 0.6 or 2.4 Jy. The beam is much wider than a pixel, so one ray per pixel
     * is enough, even at the critical curve. */
    { "m87", "M87*",
      "A hot flow round a hole of the mass of M87*, seen at 230 GHz as the Event Horizon Telescope would: a beam of 20 "
      "microarcseconds, north up, brightness in false colour; the flow's inner edge is chosen so that the ring is as "
      "wide as measured",
      true,
      "{\"spacetime\":{\"spin\":0.9," M87_HOLE "}," M87_2017
      "\"camera\":{\"inclination_deg\":163,\"field_m\":56,\"roll_deg\":108},"
      /* puts the approaching jet at a position angle of 288 degrees */
      HOT_FLOW("4.5", "9.5e5") "\"style\":{\"name\":\"eht\"},\"image\":{\"critical_factor\":1}}" },
    { "sgra", "Sagittarius A*",
      "A hot flow round a hole of the mass of Sagittarius A*, seen at 230 GHz as the Event Horizon Telescope would: a "
      "beam of 20 microarcseconds, brightness in false colour; the flow's inner edge is chosen so that the ring is as "
      "wide as measured",
      true,
      "{\"spacetime\":{\"spin\":0.9," SGRA_HOLE "}," SGRA_2017
      "\"camera\":{\"inclination_deg\":30,\"field_m\":41.7}," HOT_FLOW(
          "3.2", "2.1e7") "\"style\":{\"name\":\"eht\"},\"image\":{\"critical_factor\":1}}" },
    { "luminet1979", "The first picture, 1979",
      "The first picture of a black hole with a disk: no spin, from 10 degrees above, bolometric brightness", true,
      "{\"spacetime\":{\"spin\":0},"
      "\"camera\":{\"r\":\"infinity\",\"inclination_deg\":80,\"field_m\":46},"
      "\"disk\":{\"model\":\"novikov-thorne\",\"outer\":20,\"taper\":0,\"peak_temperature_k\":6500,"
      "\"band\":\"bolometric\",\"doppler\":true,\"redshift\":true},"
      "\"style\":{\"tone_map\":\"srgb\"},"
      "\"image\":{\"samples\":2}}" },
    { "edge-on", "Edge on", "The disk seen edge on: only bent light makes it visible", true,
      "{\"camera\":{\"inclination_deg\":90},"
      "\"image\":{\"samples\":2}}" },
    { "face-on", "Face on", "The disk seen from its pole", true,
      "{\"camera\":{\"inclination_deg\":0,\"field_m\":80},"
      "\"image\":{\"samples\":2}}" },
    { "photon-rings", "Six photon rings",
      "Six photon rings, one above the other: the angle round the shadow's edge to the right, the logarithm of the "
      "distance to the edge upwards, over nine and a half decades",
      true,
      "{\"spacetime\":{\"spin\":0.9},"
      "\"camera\":{\"projection\":\"ring\",\"inclination_deg\":60,\"roll_deg\":90,\"ring_decades_min\":-9.5},"
      "\"disk\":{\"inner\":4.3,\"outer\":20,\"taper\":0.8,\"opacity\":0.5,\"peak_temperature_k\":6500},"
      "\"accuracy\":{\"orders\":7}}" },
    { "living-disk", "Living disk",
      "A disk of 300 000 orbiting particles, lensed in every image order; in a live session they move", true,
      "{\"spacetime\":{\"spin\":0.9},"
      "\"camera\":{\"inclination_deg\":76,\"field_m\":38},"
      "\"disk\":{\"model\":\"particles\",\"outer\":18,\"peak_temperature_k\":5000},"
      "\"style\":{\"exposure\":0.75},"
      "\"motion\":{\"time_rate\":8}}" },
    { "hot-spot", "A flare",
      "A flare as GRAVITY observed round the hole of our Galaxy: a hot spot on a circular orbit of one hour, "
      "clockwise, seen 25 degrees from the axis, over a faint disk; the events of a live session give its light curve "
      "and track",
      true,
      "{\"spacetime\":{\"spin\":0.5,\"mass_msun\":4.3e6,\"distance_pc\":8277}," SGRA
      "\"camera\":{\"inclination_deg\":155,\"field_m\":50},"
      "\"disk\":{\"outer\":16,\"opacity\":0.3,\"peak_temperature_k\":4500},"
      "\"spots\":[{\"brightness\":4,\"r\":9,\"size\":1.2}],"
      "\"style\":{\"exposure\":-0.5},"
      "\"motion\":{\"time_rate\":10}}" },
    { "echo", "The echo of a flash",
      "A lamp above the hole flashes, and its light runs over the disk as a ring: first over the near side, then, bent "
      "by the hole, over the far side; each place is shown when its light left it. In a live session it flashes again "
      "and again",
      true,
      "{\"spacetime\":{\"spin\":0.9},"
      "\"camera\":{\"inclination_deg\":40,\"field_m\":84,\"centre_beta\":-6},"
      "\"disk\":{\"outer\":46,\"taper\":0.4,\"peak_temperature_k\":4200,\"slow_light\":true},"
      "\"flash\":{\"brightness\":14,\"height\":8,\"start\":-14,\"duration\":0.9,\"period\":60,"
      "\"temperature_k\":9000},"
      "\"style\":{\"exposure\":-0.6},"
      "\"image\":{\"samples\":2},"
      "\"motion\":{\"time_rate\":6}}" },
    { "milky-way", "Milky Way",
      "The stars of the Hipparcos catalogue and a Milky Way, lensed by a hole without a disk in front of the centre of "
      "the Galaxy; from 40 M",
      true,
      "{\"spacetime\":{\"spin\":0.9},"
      "\"camera\":{\"r\":40,\"inclination_deg\":85,\"fov_deg\":70},"
      "\"disk\":{\"model\":\"none\"},"
      "\"sky\":{\"model\":\"catalogue\",\"orientation\":\"sgra\"},"
      "\"style\":{\"exposure\":0.3,\"bloom\":0.4},"
      "\"motion\":{\"azimuth_rate_deg\":1}}" },
    { "gas", "Turbulent gas",
      "The default scene: a disk of turbulent gas, opaque where it is bright and transparent where it is faint; in a "
      "live session it rotates",
      false, "{\"motion\":{\"time_rate\":6}}" },
    { "gas-stars", "Gas and stars",
      "Turbulent gas round a hole in front of the stars of the Hipparcos catalogue; each image of a star has its "
      "lensed brightness; in a live session the gas rotates",
      false,
      "{\"sky\":{\"model\":\"catalogue\",\"milky_way\":0},"
      "\"motion\":{\"time_rate\":6}}" },
    { "thick-disk", "Thick disk",
      "A disk of turbulent gas whose height is a tenth of the distance from the axis, integrated along each ray; in a "
      "live session it rotates",
      false,
      "{\"disk\":{\"height\":0.1},\"image\":{\"critical_factor\":1},"
      "\"motion\":{\"time_rate\":6}}" },
    { "star-behind", "A star from behind",
      "A star that comes round from behind a hole, which lenses it to a ring, in front of other stars; in a live "
      "session it moves",
      true,
      "{\"spacetime\":{\"spin\":0.5},"
      "\"camera\":{\"inclination_deg\":90,\"field_m\":50},"
      "\"disk\":{\"model\":\"none\"},"
      "\"bodies\":[{\"radius\":1.2,\"r\":25,\"phase_deg\":178,\"temperature_k\":5000}],"
      "\"sky\":{\"model\":\"catalogue\",\"orientation\":\"sgra\",\"brightness\":0.02},"
      "\"style\":{\"exposure\":-0.5,\"bloom\":0.3},"
      "\"motion\":{\"time_rate\":4}}" },
    { "companions", "Two companions",
      "Two stars that orbit in a disk of gas, one with it and one against it, with their lensed images", false,
      "{\"spacetime\":{\"spin\":0.9},"
      "\"camera\":{\"inclination_deg\":78,\"field_m\":52},"
      "\"bodies\":[{\"radius\":2,\"r\":17,\"phase_deg\":150,\"temperature_k\":4500},"
      "{\"radius\":1,\"r\":9,\"phase_deg\":-50,\"temperature_k\":9000,\"motion\":\"retrograde\"}],"
      "\"sky\":{\"model\":\"catalogue\",\"milky_way\":0},"
      "\"motion\":{\"time_rate\":6}}" },
    { "falling", "Falling in, at 6 M",
      "The view of an observer in free fall from far away, at 6 M; camera.r may be lowered through the horizon", false,
      "{\"camera\":{\"r\":6,\"observer\":\"infall\",\"fov_deg\":120},"
      "\"sky\":{\"model\":\"catalogue\",\"brightness\":0.02}}" },
    { "infall", "The fall",
      "A free fall from 20 M through the horizon, in the observer's proper time, for the mass of Sagittarius A*; a "
      "live session shows the fall",
      false,
      "{\"spacetime\":{\"mass_msun\":4.3e6},"
      "\"camera\":{\"r\":20,\"observer\":\"infall\",\"fov_deg\":120},"
      "\"sky\":{\"model\":\"catalogue\",\"brightness\":0.02},"
      "\"motion\":{\"proper_time_rate\":2}}" },
    { "jet", "Jets",
      "Two stylised jets from a hole in turbulent gas, in front of stars; the approaching jet is brighter", false,
      "{\"camera\":{\"inclination_deg\":66,\"field_m\":110,\"roll_deg\":-58},"
      "\"jets\":{\"brightness\":0.2,\"opening_deg\":6,\"lorentz\":1.6,\"outer\":90,\"falloff\":1.3},"
      "\"sky\":{\"model\":\"catalogue\"},\"motion\":{\"time_rate\":6}}" },
    { "gargantua-gas", "Gargantua as in the film",
      "Turbulent gas round the hole of James et al. 2015, without Doppler shift and redshift, as in the film", false,
      "{\"spacetime\":{\"spin\":0.999,\"mass_msun\":1e8},"
      "\"camera\":{\"r\":74.1,\"inclination_deg\":86.56,\"fov_deg\":34},"
      "\"disk\":{\"inner\":7,\"outer\":19,\"taper\":0.6,\"emission_opacity\":30,\"peak_temperature_k\":7000,"
      "\"gas\":{\"amplitude\":0.6,\"scale\":0.6,\"shear\":8}},"
      "\"style\":{\"name\":\"dngr\"},"
      "\"image\":{\"samples\":2},"
      "\"motion\":{\"time_rate\":6}}" },
    { "polarised-ring", "Polarised ring",
      "A ring at 6 M, seen at 17 degrees like M87*; a field along the axis polarises its synchrotron light in a "
      "spiral, which ticks show over the picture",
      false,
      "{\"spacetime\":{\"spin\":0.5," M87_HOLE "}," M87
      "\"camera\":{\"inclination_deg\":163,\"field_m\":36,\"roll_deg\":108},"
      "\"disk\":{\"inner\":5,\"outer\":8,\"taper\":0.3,\"opacity\":0.3,\"emission_opacity\":0,\"gas\":{\"amplitude\":0}"
      "},"
      "\"polarization\":{\"model\":\"synchrotron\",\"field\":\"vertical\"},"
      "\"style\":{\"palette\":\"heat\",\"tone_map\":\"srgb\",\"bloom\":0},"
      "\"image\":{\"samples\":2}}" },
    { "gold-1", "Gold et al. 2020, test 1",
      "Test 1 of the comparison of programs for radiation near black holes: no absorption, emissivity as the cube of "
      "the frequency, spherical, of zero angular momentum; 230 GHz",
      true, GOLD("0.9", "\"gold_index\":-3") },
    { "gold-2", "Gold et al. 2020, test 2",
      "Test 2 of the comparison of programs for radiation near black holes: no spin, no absorption, spherical, "
      "orbiting (l0 = 1); 230 GHz",
      true, GOLD("0", "\"gold_index\":-2,\"gold_momentum\":1") },
    { "gold-3", "Gold et al. 2020, test 3",
      "Test 3 of the comparison of programs for radiation near black holes: no absorption, flattened (h = 10/3), "
      "orbiting; 230 GHz",
      true, GOLD("0.9", "\"gold_flattening\":3.3333333333333335,\"gold_momentum\":1") },
    { "gold-4", "Gold et al. 2020, test 4",
      "Test 4 of the comparison of programs for radiation near black holes: flattened, orbiting, optically thick (A = "
      "1e5); 230 GHz",
      true, GOLD("0.9", "\"gold_flattening\":3.3333333333333335,\"gold_momentum\":1,\"gold_absorption\":1e5") },
    { "gold-5", "Gold et al. 2020, test 5",
      "Test 5 of the comparison of programs for radiation near black holes: a thin layer (h = 100/3), orbiting, "
      "optically thick (A = 1e6); 230 GHz",
      true, GOLD("0.9", "\"gold_flattening\":33.333333333333336,\"gold_momentum\":1,\"gold_absorption\":1e6") },
    /* This picture is 200 microarcseconds wide, as in ipole's model/riaf. */
    { "riaf", "A hot flow at 223 GHz",
      "A hot, thin flow with the mass and the distance of Sagittarius A*: its synchrotron light at 223 GHz, as in the "
      "program ipole",
      true,
      "{\"spacetime\":{\"spin\":0.9375,\"mass_msun\":4.3e6,\"distance_pc\":8300}," SGRA
      "\"camera\":{\"inclination_deg\":60,\"field_m\":39.11063},"
      "\"disk\":{\"model\":\"none\"},"
      "\"volume\":{\"model\":\"riaf\",\"inner\":1.4479853,\"outer\":100,\"frequency_ghz\":223.005},"
      "\"style\":{\"name\":\"raw\",\"palette\":\"heat\"},"
      "\"image\":{\"width\":512,\"height\":512}}" },
    /* The usual initial torus of GRMHD simulations. Its density is chosen to give the 2.4 Jy of Sagittarius A*. */
    { "torus", "A torus at 230 GHz",
      "The torus of Fishbone and Moncrief 1976, in equilibrium, with the mass and the distance of Sagittarius A*: its "
      "synchrotron light at 230 GHz",
      true,
      "{\"spacetime\":{\"spin\":0.9375,\"mass_msun\":4.3e6,\"distance_pc\":8300}," SGRA
      "\"camera\":{\"inclination_deg\":60,\"field_m\":44},"
      "\"disk\":{\"model\":\"none\"},"
      "\"volume\":{\"model\":\"torus\",\"inner\":6,\"outer\":100,\"density_cm3\":1.776e7,\"temperature_ratio\":1},"
      "\"style\":{\"name\":\"raw\",\"palette\":\"heat\"},"
      "\"image\":{\"width\":512,\"height\":512}}" },
};
const size_t kd_preset_count = sizeof kd_presets / sizeof *kd_presets;

static enum kd_status unknown(const char *name, struct kd_error *error)
{
    char known[480] = "", shown[48];
    struct kd_spelling_best meant = { 0 };
    kd_text_clip(shown, sizeof shown, name);
    for (size_t i = 0, used = 0; i < kd_preset_count && used < sizeof known; i++) {
        kd_spelling_offer(&meant, name, kd_presets[i].name);
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", kd_presets[i].name);
    }
    if (meant.name)
        return kd_error_set(error, KD_EINVAL, "there is no preset \"%s\"; did you mean %s? The presets are %s", shown,
                            meant.name, known);
    return kd_error_set(error, KD_EINVAL, "there is no preset \"%s\"; the presets are %s", shown, known);
}

void kd_scene_smooth(struct kd_scene *scene)
{
    /* These lines repeat SMOOTH, and a test compares the two. SMOOTH is not parsed here, because parsing could run
     * out of memory, and callers of this function rely on its success. */
    kd_scene_defaults(scene);
    scene->disk.emission_opacity = 0;
    scene->disk.peak_temperature_k = 5600;
    scene->gas.amplitude = 0;
    scene->style.name = KD_STYLE_NONE;
    scene->style.bloom = 0;
}

const char *kd_scene_preset_name_now(const char *name) { return strcmp(name, "m87-eht") ? name : "m87"; }

enum kd_status kd_scene_preset(struct kd_scene *scene, const char *name, struct kd_error *error)
{
    name = kd_scene_preset_name_now(name);
    for (size_t i = 0; i < kd_preset_count; i++) {
        if (strcmp(kd_presets[i].name, name))
            continue;
        struct kd_scene preset;
        (kd_presets[i].smooth ? kd_scene_smooth : kd_scene_defaults)(&preset);
        const char *json = kd_presets[i].json;
        enum kd_status status = kd_scene_from_json(&preset, json, strlen(json), error);
        if (!status)
            *scene = preset;
        return status;
    }
    return unknown(name, error);
}

size_t kd_scene_preset_count(void) { return kd_preset_count; }

const char *kd_scene_preset_name(size_t index) { return index < kd_preset_count ? kd_presets[index].name : NULL; }

const char *kd_scene_preset_label(size_t index) { return index < kd_preset_count ? kd_presets[index].label : NULL; }

const char *kd_scene_preset_title(size_t index) { return index < kd_preset_count ? kd_presets[index].title : NULL; }
