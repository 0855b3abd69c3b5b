/* List of kerrd's subcommands, for main, --help, manual pages and completions (cli/reference). Constant data, any
 * thread. */
#ifndef KD_CLI_COMMANDS_H
#define KD_CLI_COMMANDS_H

#include <argp.h>
#include <stddef.h>

/* X(name, identifier in functions, one-line description), in the order of --help. Each line declares two functions,
 * which the subcommand's file defines. One is int kd_cli_ID(int argc, char **argv), described in cli.h. The other is
 * const struct argp *kd_cli_ID_argp(void), which returns its options, the same at each call. */
#define KD_COMMANDS(X) \
    X("render", render, "a scene to a PNG file") \
    X("view", view, "a scene, or a picture that is there, in the terminal") \
    X("light-curve", light_curve, "flux and centroid of a scene as its time goes on") \
    X("sweep", sweep, "a scene for all values of some fields: an array, or pictures") \
    X("film", film, "a film, or numbered pictures, of keyframes or of a playground") \
    X("particles", particles, "where the particles of a scene are, as an array") \
    X("rays", rays, "end points of listed rays: crossings, redshift, delay") \
    X("pixel", pixel, "what one pixel of a picture shows: its ray, each emitter on it") \
    X("orbit", orbit, "path of a body round the hole, its constants and frequencies") \
    X("line", line, "the profile of a line from a thin disk: photons by energy") \
    X("transfer-function", transfer_function, "how rings of a thin disk are seen, by redshift") \
    X("spectrum", spectrum, "what a thin disk, or a volume, sends, by frequency") \
    X("visibility", visibility, "what an interferometer measures of a scene, by baseline") \
    X("compare", compare, "a scene beside an observation of the EHT: chi^2, by baseline and closure") \
    X("playground", playground, "bodies round the hole that pull one another, merge, are torn") \
    X("physics", physics, "numbers of a hole, an orbit, a disk: one point or a curve") \
    X("plan", plan, "what a scene costs on this device") \
    X("scene", scene, "the merged scene, every field named") \
    X("presets", presets, "the scenes known by name") \
    X("serve", serve, "the HTTP service") \
    X("doctor", doctor, "what this machine can do and what it lacks") \
    X("bench", bench, "how fast and how exact each engine is on this device")

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
#define KD_CLI_EXIT_CODES "0 done, 1 failed, 2 bad input or usage, 3 a device that was lost or hangs"

/* Options of one quantity of `kerrd physics`, whose first argument is the quantity's name. The result is valid until
 * the next call. */
struct kd_quantity;
const struct argp *kd_cli_quantity_argp(const struct kd_quantity *quantity);

#endif
