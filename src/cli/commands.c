#include "cli/commands.h"

#define ROW(name, id, help) { name, kd_cli_##id, kd_cli_##id##_argp, help },
const struct kd_command kd_commands[] = { KD_COMMANDS(ROW) };
const size_t kd_n_commands = sizeof kd_commands / sizeof *kd_commands;
