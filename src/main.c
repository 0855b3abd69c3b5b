/* main finds the subcommand and hands over. */
#include "base/slip.h"
#include "cli/cli.h"

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *argp_program_version = "kerrd " KD_VERSION;

static const struct command {
    const char *name;
    int (*run)(int argc, char **argv);
} commands[] = {
    { "render", kd_cli_render },   { "light-curve", kd_cli_light_curve }, { "sweep", kd_cli_sweep }, { "film", kd_cli_film }, { "particles", kd_cli_particles },
    { "rays", kd_cli_rays },       { "pixel", kd_cli_pixel },    { "orbit", kd_cli_orbit },
    { "line", kd_cli_line }, { "transfer-function", kd_cli_transfer_function }, { "spectrum", kd_cli_spectrum }, { "visibility", kd_cli_visibility },
    { "playground", kd_cli_playground },
    { "physics", kd_cli_physics }, { "plan", kd_cli_plan },
    { "scene", kd_cli_scene },     { "presets", kd_cli_presets }, { "serve", kd_cli_serve }, { "doctor", kd_cli_doctor },
    { "bench", kd_cli_bench },
};

struct choice {
    const struct command *command;
    int index; /* of its name in argv */
    bool help; /* `kerrd help COMMAND` */
};

static const struct command *find(const char *name, struct argp_state *state)
{
    char known[300] = "";
    struct kd_slip_best meant = { 0 };
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        size_t used = strlen(known);
        if (!strcmp(name, commands[i].name))
            return &commands[i];
        kd_slip_offer(&meant, name, commands[i].name);
        snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", commands[i].name);
    }
    if (meant.name)
        argp_error(state, "there is no command \"%s\"; did you mean %s? Known are %s", name, meant.name, known);
    else
        argp_error(state, "there is no command \"%s\"; known are %s", name, known);
    return NULL;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct choice *choice = state->input;
    switch (key) {
    case 'h': argp_state_help(state, stdout, ARGP_HELP_STD_HELP); return 0;
    case ARGP_KEY_ARG:
        if (!strcmp(text, "help") && state->next == state->argc)
            argp_state_help(state, stdout, ARGP_HELP_STD_HELP);
        if (!strcmp(text, "help")) {
            choice->help = true;
            text = state->argv[state->next++];
        }
        choice->command = find(text, state);
        choice->index = state->next - 1;
        state->next = state->argc; /* the rest is the command's */
        return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "a command is missing"); return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static const struct argp_option options[] = {
    { NULL, 'h', NULL, OPTION_HIDDEN, NULL, 0 }, /* as --help, which argp itself gives -? */
    { 0 },
};

static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "COMMAND [OPTION...]",
    .doc = "Pictures of black holes: a Kerr renderer on a Vulkan device.\v"
           "Commands (`kerrd help COMMAND` says more):\n"
           "  render       a scene to a PNG file\n"
           "  light-curve  flux and centroid of a scene as its time goes on\n"
           "  sweep        a scene for all values of some fields, as one array or many pictures\n"
           "  film         a scene that keyframes change, or a playground, as a film or numbered pictures\n"
           "  particles    where the particles of a scene are, as an array\n"
           "  rays         end points of listed rays: crossings, redshift, delay\n"
           "  pixel        what one pixel of a picture shows: its ray, each emitter on it, why it ends\n"
           "  orbit        path of a body round the hole, its constants and frequencies\n"
           "  line         the profile of a line from a thin disk: photons by energy\n"
           "  transfer-function  how rings of a thin disk are seen, by redshift\n"
           "  spectrum     what a thin disk of black bodies, or a volume, sends, by frequency\n"
           "  visibility   what an interferometer measures of a scene, by baseline\n"
           "  playground   bodies round the hole that pull one another, merge, and are torn apart\n"
           "  physics      numbers of a hole, an orbit, a disk: one point or a curve\n"
           "  plan         what a scene costs on this device\n"
           "  scene        the merged scene, every field named\n"
           "  presets      the scenes known by name\n"
           "  serve        the HTTP service\n"
           "  doctor       what this machine can do and what it lacks\n"
           "  bench        how fast and how exact each engine is on this device\n"
           "\n"
           "Exit codes: 0 done, 1 failed, 2 bad input or usage.",
};

int main(int argc, char **argv)
{
    static char zero[] = "kerrd";
    struct choice choice = { 0 };
    char name[32];

    argp_err_exit_status = KD_EXIT_USAGE;
    signal(SIGPIPE, SIG_IGN); /* a reader that left is no end for a server; other commands: kd_cli_stdout_failed */
    atexit(kd_cli_close_stdout);
    if (argc < 1)
        return KD_EXIT_USAGE;
    argv[0] = zero; /* as messages name the program, wherever it lies */
    argp_parse(&argp, argc, argv, ARGP_IN_ORDER, NULL, &choice);
    snprintf(name, sizeof name, "kerrd %s", choice.command->name);
    argv[choice.index] = name;
    char *help[] = { name, (char[]) { "--help" }, NULL };
    if (choice.help)
        return choice.command->run(2, help);
    return choice.command->run(argc - choice.index, argv + choice.index);
}
