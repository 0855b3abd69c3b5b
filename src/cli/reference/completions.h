/* Writes shell completions. The completion file of a shell consists of tables and of functions that read the tables.
 * The tables are written by the functions below. The functions of the shell are in completion.bash, completion.zsh
 * or completion.fish. One thread. */
#ifndef KD_CLI_REFERENCE_COMPLETIONS_H
#define KD_CLI_REFERENCE_COMPLETIONS_H

#include "document/writer.h"

void kd_completions_bash(struct kd_writer *w);
void kd_completions_zsh(struct kd_writer *w);
void kd_completions_fish(struct kd_writer *w);

/* Writes the fields of a scene and the settings of a playground, as arrays of bash and zsh. */
void kd_write_tables(struct kd_writer *w);

#endif
