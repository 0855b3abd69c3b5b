/* Functions shared by the files of this module. */
#ifndef KD_DOCUMENT_INTERNAL_H
#define KD_DOCUMENT_INTERNAL_H

#include "document/document.h"

/* Whether a row is one of the document's, and in this object; NULL: in the document itself. read.c */
bool kd_row_is_of(const struct kd_document *document, const struct kd_row *row, const char *object);
/* Writes the members of the schema of a row's numbers. write.c */
void kd_row_number_members(struct kd_json *json, const struct kd_row *row);

#endif
