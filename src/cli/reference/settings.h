/* Writes docs/options.md. One thread. */
#ifndef KD_CLI_REFERENCE_SETTINGS_H
#define KD_CLI_REFERENCE_SETTINGS_H

#include "document/writer.h"

void kd_settings_page(struct kd_writer *w);

#endif
