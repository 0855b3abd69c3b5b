/* Functions shared by the files of this module. */
#ifndef KD_DOCUMENT_INTERNAL_H
#define KD_DOCUMENT_INTERNAL_H

#include "document/document.h"

/* An object of the document that is being read; its name is "" for the document itself. list: the list of which the
 * object is an element, or NULL. */
struct kd_object {
    const char *name;
    const struct kd_list *list;
    size_t index;
};

/* A place in a document: its JSON pointer, and its name in messages. */
struct kd_mention { char pointer[sizeof((struct kd_error *)0)->pointer], called[120]; };
/* place.c: returns the place of a member of the object, or of the object itself if name is NULL. */
struct kd_mention kd_mention_of(const char *pointer, const struct kd_object *object, const char *name);

/* find.c: true if the row belongs to the document and to the given object. If object is NULL or "", the object is
 * the document itself. */
bool kd_row_is_of(const struct kd_document *document, const struct kd_row *row, const char *object);
const struct kd_row *kd_find_row(const struct kd_document *document, const char *object, const char *name,
                                 const struct kd_row *after);
/* Returns the object `name` within an object; NULL if there is none. */
const char *kd_find_object(const struct kd_document *document, const char *object, const char *name);
const struct kd_former *kd_find_former(const struct kd_document *document, const char *name);
/* True if the row is the first row of an object that is itself a member of the given object. */
bool kd_row_opens(const struct kd_document *document, const struct kd_row *row, const char *object);

/* unknown.c: returns KD_EINVAL with "there is no field X here; did you mean Y?". typed: true if the name comes from
 * a command line. */
enum kd_status kd_unknown(const struct kd_document *document, const struct kd_object *object, const char *name,
                          bool typed, const char *pointer, struct kd_error *error);

/* put.c: sets a row to its default. */
void kd_row_reset(const struct kd_row *row, void *to);
/* list.c: the first function reads an index such as "3". The index must be below the list's limit, and at most the
 * next free index. The second function removes elements that have all defaults from the end of the list, but keeps
 * `least` elements. */
enum kd_status kd_list_index(const struct kd_list *list, const char *token, const char *pointer, size_t *index,
                             struct kd_error *error);
enum kd_status kd_list_reach(const struct kd_list *list, size_t size, size_t index, const char *pointer,
                             struct kd_error *error);
void kd_list_trim(const struct kd_document *document, const struct kd_list *list, void *to, size_t least);

/* write.c: writes the members of the schema of a row's numbers. */
void kd_row_number_members(struct kd_json *json, const struct kd_row *row);

#endif
