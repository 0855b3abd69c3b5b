/* Functions shared by the files of this module. */
#ifndef KD_DOCUMENT_INTERNAL_H
#define KD_DOCUMENT_INTERNAL_H

#include "document/document.h"

/* Whether a row is one of the document's, and in this object; NULL: in the document itself. read.c */
bool kd_row_is_of(const struct kd_document *document, const struct kd_row *row, const char *object);
/* "X is V; it must be ...". put.c */
enum kd_status kd_row_refuse(const struct kd_row *row, const struct kd_value *value, const char *called,
                             const char *pointer, struct kd_error *error);
/* Write the members of a row's schema; and those of its numbers. write.c */
void kd_row_type_members(struct kd_json *json, const struct kd_row *row);
void kd_row_number_members(struct kd_json *json, const struct kd_row *row);

#endif
