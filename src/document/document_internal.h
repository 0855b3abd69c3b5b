/* Functions shared by the files of this module. */
#ifndef KD_DOCUMENT_INTERNAL_H
#define KD_DOCUMENT_INTERNAL_H

#include "document/document.h"

/* An object of the document that is being read; "" is the document itself. list: the list that has the object as an
 * element, or NULL. */
struct kd_object {
    const char *name;
    const struct kd_list *list;
    size_t index;
};

/* A place in a document: its pointer, and its name in messages. */
struct kd_mention { char pointer[sizeof((struct kd_error *)0)->pointer], called[120]; };
/* place.c: the place of a member of the object. name NULL: the object itself. */
struct kd_mention kd_mention_of(const char *pointer, const struct kd_object *object, const char *name);

/* find.c: whether a row belongs to the document and to the given object. object NULL or "": the object is the
 * document itself. */
bool kd_row_is_of(const struct kd_document *document, const struct kd_row *row, const char *object);
const struct kd_row *kd_find_row(const struct kd_document *document, const char *object, const char *name,
                                 const struct kd_row *after);
/* The object `name` within an object, or NULL. */
const char *kd_find_object(const struct kd_document *document, const char *object, const char *name);
const struct kd_former *kd_find_former(const struct kd_document *document, const char *name);
/* True if the row is the first row of an object that is a member of the given object. */
bool kd_row_opens(const struct kd_document *document, const struct kd_row *row, const char *object);

/* unknown.c: KD_EINVAL with "there is no field X here; did you mean Y?". typed: the name comes from a command line. */
enum kd_status kd_unknown(const struct kd_document *document, const struct kd_object *object, const char *name,
                          bool typed, const char *pointer, struct kd_error *error);

/* Sets a row to its default. put.c */
void kd_row_reset(const struct kd_row *row, void *to);
/* list.c. The first function reads an index, such as "3", which must be below the list's limit and not beyond the
 * next free index. The second removes elements with all defaults from the end, but keeps `least` elements. */
enum kd_status kd_list_index(const struct kd_list *list, const char *token, const char *pointer, size_t *index,
                             struct kd_error *error);
enum kd_status kd_list_reach(const struct kd_list *list, size_t size, size_t index, const char *pointer,
                             struct kd_error *error);
void kd_list_trim(const struct kd_document *document, const struct kd_list *list, void *to, size_t least);

/* Writes the members of the schema of a row's numbers. write.c */
void kd_row_number_members(struct kd_json *json, const struct kd_row *row);

#endif
