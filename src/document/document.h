/* Documents: requests and scenes as tables of fields. A table has one row for each field of a document. The table
 * determines the defaults, the readers of JSON and of typed text, the error messages, the writer and the JSON Schema.
 * This module does not depend on the meaning of any field. Constant data and pure functions, any thread.
 *
 *     struct tea { double minutes; uint32_t cups; int leaf; bool milk; };
 *     #define AT(member) offsetof(struct tea, member)
 *     static const struct kd_row rows[] = {
 *         { .name = "minutes", .kind = KD_KIND_REAL, .offset = AT(minutes), .initial = 3, .least = 0, .most = 10,
 *           .unit = "min", .help = "time to draw" },
 *         { .name = "cups", .kind = KD_KIND_INT, .offset = AT(cups), .initial = 1, .least = 1, .most = 8,
 *           .help = "number of cups" },
 *         { .name = "leaf", .kind = KD_KIND_WORD, .offset = AT(leaf), .words = "green|black", .help = "kind of leaf" },
 *         { .object = "with", .name = "milk", .kind = KD_KIND_BOOL, .offset = AT(milk), .help = "with milk or not" },
 *     };
 *     static const struct kd_document document = { rows, sizeof rows / sizeof *rows };
 *
 *     struct tea tea;
 *     kd_document_defaults(&document, &tea);
 *     kd_tree_parse(text, length, 4096, 64, &tree, error);             {"cups": 9, "with": {"milk": true}}
 *     kd_document_read(&document, &tea, tree, "", NULL, error);        cups is 9; it must be a whole number from 1 to 8
 *     kd_document_set(&document, &tea, "milk", "true", NULL, error);   as on a command line
 *     kd_document_write(&json, &document, &tea);                       {"minutes":3,"cups":1,...}
 *
 * An error is KD_EINVAL with the field's pointer. Its message gives the field's name in the request, its value, and the
 * allowed values. For an unknown name the message suggests the nearest known name, or lists all known names. */
#ifndef KD_DOCUMENT_DOCUMENT_H
#define KD_DOCUMENT_DOCUMENT_H

#include "base/error.h"
#include "base/json.h"
#include "document/asset_name.h"
#include "document/value.h"
#include "document/words.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum kd_kind {
    KD_KIND_REAL, /* double: a number or, with `words`, also that one word */
    KD_KIND_INT,  /* uint32_t */
    KD_KIND_BOOL, /* bool */
    KD_KIND_WORD, /* int or an enumeration: one of `words`, stored as its index plus `first` */
    /* struct kd_number_list: an array of `fewest` to `room` numbers within the range; `fewest` 0 means one */
    KD_KIND_WORDS,
    KD_KIND_LIST,   /* struct kd_number_list: an array of `fewest` (0: one) to `room` numbers within the range */
    KD_KIND_VECTOR, /* double[room]: an array of `room` numbers within the range */
    KD_KIND_TEXT,   /* char[room]: a string shorter than `room` */
    KD_KIND_ASSET,  /* char[KD_ASSET_NAME]: null, stored as "", or an asset (document/asset_name.h) */
    KD_KIND_SERIES, /* struct kd_words: some of `words` in any order, each once (document/words.h) */
    KD_KIND_JSON,   /* const cJSON *: any value, which the caller reads while the tree exists; NULL: not given */
};
enum kd_open { KD_CLOSED, KD_OPEN, KD_OPEN_ABOVE, KD_OPEN_BELOW }; /* ends of the range that are not allowed */

struct kd_number_list {
    double *at; /* malloc'd */
    size_t n;
};

struct kd_row {
    /* object: the member of the document that contains the field. It may be a nested one such as "disk.gas". NULL or
     * "": the document itself */
    const char *object, *name;
    enum kd_kind kind;
    bool needed, fixed;          /* needed: must be given; fixed: cannot be changed afterwards */
    size_t offset;               /* offset in the struct that is filled */
    double initial, least, most; /* for numbers; `initial` is also the default of a WORD and a BOOL */
    enum kd_open open;
    double above_0;    /* the smallest allowed value above 0, if 0 itself is allowed too */
    const char *words; /* "a|b|c" */
    double stands;     /* value for which the word of a REAL stands: INFINITY or NAN; the word of an INT is stored as
                        * 0 */
    int first;
    const char *typed; /* default as typed text, for a row that may be a range (kd_row_range) */
    size_t room, fewest;
    unsigned of;             /* bit mask of the kinds of documents that have this field; 0: all kinds */
    const char *unit, *help; /* unit NULL, "" or "1": none */
    /* Texts that replace the generated ones: the allowed values in words, and the members of the JSON Schema without
     * the description, such as "\"type\":\"number\"". They are for limits that depend on more than one field. */
    const char *allowed, *schema;
};

/* An object that is a list: an array of objects with the same fields. The rows of such an object are those of the
 * first element. */
struct kd_list {
    const char *object;
    /* limit of elements; bytes from one element to the next; offset of the number of elements */
    size_t most, stride, size_at;
};
/* A former name of an element. */
struct kd_former {
    const char *name, *object;
    size_t index;
};

struct kd_document {
    const struct kd_row *rows;
    size_t n;
    unsigned of;        /* only rows of these kinds of documents are renamed; 0: all rows */
    const char *others; /* "a|b": further members, which the caller reads; NULL: none */
    /* Combinations of members that an object cannot have, as JSON Schema; the list ends with a NULL name. May be
     * NULL. */
    const struct kd_document_not { const char *object, *schema; } *nots;
    const struct kd_list *lists;
    size_t n_lists;
    const struct kd_former *formers;
    size_t n_formers;
    bool paths; /* true: a typed name is the whole path of a field, such as "table.milk" or "spots.0.r"; false: "milk"
                 * is sufficient */
};

void kd_document_defaults(const struct kd_document *document, void *to);

/* Finds a row of the document by "name" or "object.name"; NULL: none. */
const struct kd_row *kd_document_find(const struct kd_document *document, const char *name);

/* Reads the members that an object has; other fields keep their values. pointer: the object's own. given: receives the
 * bit of each row that was given, with 64 rows to a word; may be NULL. A member that is unknown or given twice is an
 * error.
 *
 * An array replaces a whole list. An object {"0": {...}} changes elements by index; the next free index appends one. If
 * the document uses a former name of an element, the elements before that element are created. New elements at the end
 * of the list that still have all defaults are removed again. */
enum kd_status kd_document_read(const struct kd_document *document, void *to, const cJSON *object, const char *pointer,
                                uint64_t *given, struct kd_error *error);
/* Like kd_document_read, as a merge patch (RFC 7396): null resets a field, or all fields of an object or element, and
 * empties a list. */
enum kd_status kd_document_patch(const struct kd_document *document, void *to, const cJSON *object, const char *pointer,
                                 uint64_t *given, struct kd_error *error);
/* Sets one field by "name" or "object.name" from typed text; lists and sets have commas between their items. */
enum kd_status kd_document_set(const struct kd_document *document, void *to, const char *name, const char *text,
                               uint64_t *given, struct kd_error *error);
/* The place that a typed path names. The element need not exist. */
struct kd_typed_place {
    const struct kd_row *row;
    const struct kd_list *list; /* NULL: none */
    size_t index;
    bool former; /* the path uses a former name of the element */
};
enum kd_status kd_document_place(const struct kd_document *document, const char *path, struct kd_typed_place *out,
                                 struct kd_error *error);

/* kd_document_list finds a list by name. kd_list_resize sets the number of elements; elements that are added or
 * removed get their defaults. */
const struct kd_list *kd_document_list(const struct kd_document *document, const char *object);
size_t kd_list_size(const struct kd_list *list, const void *from);
void kd_list_resize(const struct kd_document *document, const struct kd_list *list, void *to, size_t size);
/* KD_EINVAL at the first element beyond the limit. */
enum kd_status kd_list_check(const struct kd_list *list, size_t size, struct kd_error *error);

/* Sets one field from a value; not for arrays. called: the field's name in messages. */
enum kd_status kd_row_put(const struct kd_row *row, void *to, const struct kd_value *value, const char *called,
                          const char *pointer, struct kd_error *error);
/* The two halves of kd_row_put. kd_row_take stores the value and returns whether the row accepts it. kd_row_refuse
 * returns KD_EINVAL with "X is V; it must be ...". */
bool kd_row_take(const struct kd_row *row, void *to, const struct kd_value *value);
enum kd_status kd_row_refuse(const struct kd_row *row, const struct kd_value *value, const char *called,
                             const char *pointer, struct kd_error *error);
/* A row's value as a double, for every kind except TEXT, LIST, WORDS and VECTOR. A BOOL is 0 or 1, a WORD is its
 * index, and the word of an INT is INFINITY. An ASSET is 1 if it is set; putting 0 removes it. A SERIES of exactly
 * one word without a number is the index of that word. Any other SERIES is NAN. */
double kd_row_get(const struct kd_row *row, const void *from);
void kd_row_put_number(const struct kd_row *row, void *to, double value);
/* True if the row allows this value: the value is in the row's range (and whole if the kind requires that), or
 * stands for the row's word. */
bool kd_row_holds(const struct kd_row *row, double value);
/* Replaces a LIST by room for n numbers. KD_EINVAL at the pointer if the row does not allow n numbers. */
enum kd_status kd_row_make_room(const struct kd_row *row, void *to, size_t n, const char *pointer,
                                struct kd_number_list **list, struct kd_error *error);
/* Evenly spaced numbers, both ends included. */
enum { KD_RANGE_MOST = 100000 };
struct kd_range {
    double first, last;
    size_t count; /* 1: a single number */
};
double kd_range_at(const struct kd_range *range, size_t i);
/* Reads a row of numbers from typed text: a number or the row's word, or "first:last:count". For a WORD, the range
 * consists of the word's index. On an error *range is unchanged. */
enum kd_status kd_row_range(const struct kd_row *row, const char *text, const char *pointer, struct kd_range *range,
                            struct kd_error *error);
/* Writes the schema of what kd_row_range reads, with the default, as a member. */
void kd_row_range_schema(struct kd_json *json, const char *name, const struct kd_row *row);

/* KD_EINVAL with "there is no parameter X; did you mean Y?", or with a list of the known ones. */
enum kd_status kd_document_unknown(const struct kd_document *document, const char *name, struct kd_error *error);
/* Describes the values that a row allows: "0 to 10 M, or \"isco\"". */
void kd_row_allowed(const struct kd_row *row, char out[KD_ALLOWED_SIZE]);

/* Writes all fields but LISTs, as members of the object that is open. */
void kd_document_write(struct kd_json *json, const struct kd_document *document, const void *from);
/* Writes one row's value as a member. A list is left out. */
void kd_row_write(struct kd_json *json, const struct kd_row *row, const void *from);
/* Like kd_row_write, under another name. Within an array, the name is NULL. */
void kd_row_write_as(struct kd_json *json, const char *name, const struct kd_row *row, const void *from);
/* Writes the value that kd_row_get returns, in the form that it has in a document. */
void kd_row_write_value(struct kd_json *json, const char *name, const struct kd_row *row, double value);
/* Writes the schema of each field, as members of the object "properties" that is open. */
void kd_document_properties(struct kd_json *json, const struct kd_document *document);
/* Writes the members of one row's schema without its description. */
void kd_row_type_members(struct kd_json *json, const struct kd_row *row);
/* Writes one row's schema as a member. */
void kd_row_schema(struct kd_json *json, const char *name, const struct kd_row *row);
/* Like kd_row_schema, without the row's description. */
void kd_row_type(struct kd_json *json, const char *name, const struct kd_row *row);
/* Writes the member "required" if a field must be given. The field may be one of the document itself or of one of
 * its objects. */
void kd_document_required(struct kd_json *json, const struct kd_document *document);
/* Writes the array `name` of {"name", "type", "default", "least", "most", "words", "fixed", "help"}, for a page's
 * controls. Lists, vectors and texts are left out. */
void kd_document_describe(struct kd_json *json, const char *name, const struct kd_document *document);

#endif
