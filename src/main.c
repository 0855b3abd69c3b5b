/* Finds the subcommand and runs it. */
#include "base/spelling.h"
#include "cli/cli.h"
#include "vk/own_enter.h"

#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *argp_program_version = "kerrd " KD_VERSION;

struct choice {
    const struct kd_command *command;
    int index; /* index in argv of the subcommand's name */
    bool help; /* `kerrd help COMMAND` */
};

static const struct kd_command *find(const char *name, struct argp_state *state)
{
    char known[300] = "";
    struct kd_spelling_best meant = { 0 };
    for (size_t i = 0; i < kd_n_commands; i++) {
        size_t used = strlen(known);
        if (!strcmp(name, kd_commands[i].name))
            return &kd_commands[i];
        kd_spelling_offer(&meant, name, kd_commands[i].name);
        snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", kd_commands[i].name);
    }
    if (meant.name)
        argp_error(state, "there is no command \"%s\"; did you mean %s? The commands are %s", name, meant.name, known);
    else
        argp_error(state, "there is no command \"%s\"; the commands are %s", name, known);
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
        state->next = state->argc; /* the remaining arguments belong to the subcommand */
        return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "a command is missing"); return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static const struct argp_option options[] = {
    { NULL, 'h', NULL, OPTION_HIDDEN, NULL, 0 }, /* -h does the same as --help; argp itself adds -? */
    { 0 },
};

/* Makes the text of --help, which contains the list of commands. Names that are longer than the column are not
 * aligned. */
static const char *help_text(void)
{
    static char text[4000];
    size_t used =
        (size_t)snprintf(text, sizeof text, "%s", KD_CLI_ABOUT "\vCommands (`kerrd help COMMAND` says more):\n");
    for (size_t i = 0; i < kd_n_commands && used < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "  %-11s  %s\n", kd_commands[i].name,
                                 kd_commands[i].help);
    if (used < sizeof text)
        snprintf(text + used, sizeof text - used, "%s", "\nExit codes: " KD_CLI_EXIT_CODES ".");
    return text;
}

/* Opens /dev/null for each standard stream that the parent process has closed. Otherwise a client's socket or a file
 * could get the stream's number, and messages would be written into it. It is opened in the wrong mode, so that
 * reading or writing fails as on a closed stream. */
static void hold_standard_streams(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
}

int main(int argc, char **argv)
{
    static char zero[] = "kerrd";
    const struct argp argp = {
        .options = options, .parser = parse, .args_doc = "COMMAND [OPTION...]", .doc = help_text()
    };
    struct choice choice = { 0 };
    char name[32];

    hold_standard_streams();
    if (argc > 0)
        kd_vk_own_enter(argc, argv);
    argp_err_exit_status = KD_EXIT_USAGE;
    /* A client that disconnects must not end the server. Other commands handle a closed pipe in
     * kd_cli_stdout_failed. */
    signal(SIGPIPE, SIG_IGN);
    /* With this signal ignored, a write beyond `ulimit -f` fails with an error, after which the partial file is
     * removed. */
    signal(SIGXFSZ, SIG_IGN);
    atexit(kd_cli_close_stdout);
    if (argc < 1)
        return KD_EXIT_USAGE;
    argv[0] = zero; /* so that messages show the program's name without its path */
    argp_parse(&argp, argc, argv, ARGP_IN_ORDER, NULL, &choice);
    snprintf(name, sizeof name, "kerrd %s", choice.command->name);
    argv[choice.index] = name;
    char *help[] = { name, (char[]) { "--help" }, NULL };
    if (choice.help)
        return choice.command->run(2, help);
    return choice.command->run(argc - choice.index, argv + choice.index);
}
