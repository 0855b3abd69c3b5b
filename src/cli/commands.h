/* List of kerrd's subcommands, for main, --help, manual pages and completions (cli/reference). Constant data, any
 * thread. */
#ifndef KD_CLI_COMMANDS_H
#define KD_CLI_COMMANDS_H

#include <argp.h>
#include <stddef.h>

/* X(name, identifier in function names, one-line description), in the order of --help. Each line declares two
 * functions, which are defined in the subcommand's file: int kd_cli_ID(int argc, char **argv), described in cli.h,
 * and const struct argp *kd_cli_ID_argp(void), which returns the options, the same at each call. */
#define KD_COMMANDS(X) \
    X("render", render, "render a scene to a picture file") \
    X("view", view, "show a scene or an existing picture in the terminal") \
    X("light-curve", light_curve, "flux and centroid of a scene over time") \
    X("sweep", sweep, "render a scene for all values of some fields: an array, or pictures") \
    X("film", film, "render a film, or numbered pictures, from keyframes or a playground") \
    X("particles", particles, "positions and velocities of a scene's particles, as an array") \
    X("rays", rays, "end points of listed rays: crossings, redshift, delay") \
    X("pixel", pixel, "explain one pixel of a picture: its ray and each emitter on the ray") \
    X("orbit", orbit, "path of a body round the hole, its constants and frequencies") \
    X("line", line, "the profile of a line from a thin disk: photons by energy") \
    X("table", table, "the profiles of a line as a table model for XSPEC") \
    X("transfer-function", transfer_function, "Cunningham's transfer function of a thin disk") \
    X("impulse", impulse, "echo of a flash on a thin disk, by energy and time") \
    X("lags", lags, "lags of that echo, by frequency and energy") \
    X("spectrum", spectrum, "spectrum of a thin disk or of a volume") \
    X("visibility", visibility, "visibilities of a scene by baseline, as an interferometer measures them") \
    X("observe", observe, "visibilities of a scene as an array would have measured them, with noise") \
    X("compare", compare, "compare a scene with an observation of the EHT: amplitudes, closures, chi^2") \
    X("playground", playground, "simulate bodies round the hole: attraction, mergers, tidal disruption") \
    X("physics", physics, "compute quantities of a hole, an orbit or a disk at a point or along a curve") \
    X("plan", plan, "estimate the time and memory of a picture on this device") \
    X("scene", scene, "print the merged scene with every field") \
    X("presets", presets, "list the presets") \
    X("serve", serve, "run the HTTP server") \
    X("sign", sign, "make an address of a server that works without an access token until it expires") \
    X("doctor", doctor, "check this machine: devices, drivers, caches") \
    X("bench", bench, "measure the speed and accuracy of each engine on this device")

#define KD_COMMAND_FUNCTIONS(name, id, help) \
    int kd_cli_##id(int argc, char **argv); \
    const struct argp *kd_cli_##id##_argp(void);
KD_COMMANDS(KD_COMMAND_FUNCTIONS)

struct kd_command {
    const char *name;
    int (*run)(int argc, char **argv);
    const struct argp *(*argp)(void);
    const char *help;
};
extern const struct kd_command kd_commands[];
extern const size_t kd_n_commands;

/* Texts about the whole program in --help and the manual. */
#define KD_CLI_ABOUT "Pictures of black holes: a Kerr renderer on a Vulkan device."
#define KD_CLI_EXIT_CODES "0 success, 1 failure, 2 bad input or usage, 3 the device was lost or hangs"

/* Options of one quantity of `kerrd physics`; the first argument of that subcommand is the quantity's name. The
 * result is valid until the next call. */
struct kd_quantity;
const struct argp *kd_cli_quantity_argp(const struct kd_quantity *quantity);

#endif
