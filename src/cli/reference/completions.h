/* Writes shell completions. The file for a shell consists of tables, which these functions write, and of the functions
 * in completion.bash, completion.zsh or completion.fish, which read the tables. One thread. */
#ifndef KD_CLI_REFERENCE_COMPLETIONS_H
#define KD_CLI_REFERENCE_COMPLETIONS_H

#include "document/writer.h"

void kd_completions_bash(struct kd_writer *w);
void kd_completions_zsh(struct kd_writer *w);
void kd_completions_fish(struct kd_writer *w);

/* Writes the fields of a scene and the settings of a playground, as arrays of bash and zsh. */
void kd_write_tables(struct kd_writer *w);

#endif
