/* Writes shell completions. The completion file of each shell consists of tables, which the functions below write,
 * and of shell functions that read the tables. The shell functions are in completion.bash, completion.zsh and
 * completion.fish. One thread. */
#ifndef KD_CLI_REFERENCE_COMPLETIONS_H
#define KD_CLI_REFERENCE_COMPLETIONS_H

#include "document/writer.h"

void kd_completions_bash(struct kd_writer *w);
void kd_completions_zsh(struct kd_writer *w);
void kd_completions_fish(struct kd_writer *w);

/* Writes the fields of a scene and the settings of a playground as arrays in the syntax of bash and zsh. */
void kd_write_tables(struct kd_writer *w);

#endif
