/* Completions of kerrd are tables for a shell, which are made here, and the functions that read them, which stand in
 * completion.bash, completion.zsh and completion.fish: the file that the shell reads is the tables and then the
 * functions. One thread. */
#ifndef KD_CLI_REFERENCE_COMPLETIONS_H
#define KD_CLI_REFERENCE_COMPLETIONS_H

#include "scene/writer.h"

void kd_completions_bash(struct kd_writer *w);
void kd_completions_zsh(struct kd_writer *w);
void kd_completions_fish(struct kd_writer *w);

/* The fields of a scene and the settings of a playground, as arrays of bash and zsh. */
void kd_write_tables(struct kd_writer *w);

#endif
