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
    KD_KIND_REAL, /* double: a number; if the row has `words`, that one word is also accepted */
    KD_KIND_INT,  /* uint32_t */
    KD_KIND_BOOL, /* bool */
    KD_KIND_WORD, /* int or an enumeration: one of `words`, stored as the word's index plus `first` */
    /* uint32_t: an array of some of `words`, stored as one bit for each word */
    KD_KIND_WORDS,
    KD_KIND_LIST,   /* struct kd_number_list: an array of `fewest` (0: one) to `room` numbers within the range */
    KD_KIND_VECTOR, /* double[room]: an array of `room` numbers within the range */
    KD_KIND_TEXT,   /* char[room]: a string shorter than `room` */
    KD_KIND_ASSET,  /* char[KD_ASSET_NAME]: null, stored as "", or an asset (document/asset_name.h) */
    KD_KIND_SERIES, /* struct kd_words: some of `words` in any order, each once (document/words.h) */
    KD_KIND_JSON,   /* const cJSON *: any value; the caller reads it while the tree exists; NULL if not given */
};
/* the ends of a row's range that are excluded: none, both, the upper end, or the lower end */
enum kd_open { KD_CLOSED, KD_OPEN, KD_OPEN_ABOVE, KD_OPEN_BELOW };

struct kd_number_list {
    double *at; /* malloc'd */
    size_t n;
};

struct kd_row {
    /* object: the member of the document that contains the field, such as "disk.gas"; NULL or "": the document
     * itself */
    const char *object, *name;
    enum kd_kind kind;
    bool needed, fixed;          /* needed: the field must be given; fixed: the field cannot be changed later */
    size_t offset;               /* offset of the field in the struct that is filled */
    double initial, least, most; /* range and default of numbers; `initial` is also the default of a WORD and a BOOL */
    enum kd_open open;
    double above_0;    /* for fields that may be 0: the smallest allowed value above 0 */
    const char *words; /* "a|b|c" */
    /* number that the word of a REAL stands for: INFINITY or NAN; the word of an INT is stored as 0 */
    double stands;
    int first;
    const char *typed; /* default as typed text, for a row that may be a range (kd_row_range) */
    size_t room, fewest;
    unsigned of;             /* bit mask of the kinds of documents that have this field; 0: all kinds have it */
    const char *unit, *help; /* unit: NULL, "" or "1" if there is none */
    /* Texts that replace generated ones, for limits that depend on more than one field. allowed: the accepted values
     * in words. schema: members of the JSON Schema without the description, such as "\"type\":\"number\"". */
    const char *allowed, *schema;
};

/* An object that is a list: an array of objects that all have the same fields. The rows of the list describe its
 * first element. */
struct kd_list {
    const char *object;
    /* most: limit of the number of elements; stride: bytes from one element to the next; size_at: offset of the
     * number of elements */
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
    unsigned of;        /* bit mask: only the rows of these kinds of documents are renamed; 0: all rows */
    const char *others; /* names of other members, as "a|b", which the caller reads; NULL if there are none */
    /* Combinations of members that an object must not have, as JSON Schemas. The list ends with an entry whose name
     * is NULL. The list may be NULL. */
    const struct kd_document_not { const char *object, *schema; } *nots;
    const struct kd_list *lists;
    size_t n_lists;
    const struct kd_former *formers;
    size_t n_formers;
    /* true: a typed name must be the whole path of a field, such as "table.milk" or "spots.0.r"; false: "milk" is
     * sufficient */
    bool paths;
};

void kd_document_defaults(const struct kd_document *document, void *to);

/* Finds a row of the document by "name" or "object.name". Returns NULL if there is none. */
const struct kd_row *kd_document_find(const struct kd_document *document, const char *name);

/* Reads the members of an object; all other fields keep their values. pointer: JSON pointer of the object. given:
 * bit set that receives a bit for each row that was given, 64 rows per word; may be NULL. A member that is unknown
 * or given twice is an error.
 *
 * An array replaces a whole list. An object {"0": {...}} changes elements by index; the next free index appends one.
 * If the document uses a former name of an element, the elements before that element are created. New elements at
 * the end of the list that still have all defaults are removed again. */
enum kd_status kd_document_read(const struct kd_document *document, void *to, const cJSON *object, const char *pointer,
                                uint64_t *given, struct kd_error *error);
/* Like kd_document_read, but as a merge patch (RFC 7396): null resets a field, resets all fields of an object or
 * element, or empties a list. */
enum kd_status kd_document_patch(const struct kd_document *document, void *to, const cJSON *object, const char *pointer,
                                 uint64_t *given, struct kd_error *error);
/* Sets one field, named as "name" or "object.name", from typed text. The items of lists and sets are separated by
 * commas. */
enum kd_status kd_document_set(const struct kd_document *document, void *to, const char *name, const char *text,
                               uint64_t *given, struct kd_error *error);
/* The place that a typed path leads to. Its element need not exist. */
struct kd_typed_place {
    const struct kd_row *row;
    const struct kd_list *list; /* NULL: none */
    size_t index;
    bool former; /* true if the path uses a former name of the element */
};
enum kd_status kd_document_place(const struct kd_document *document, const char *path, struct kd_typed_place *out,
                                 struct kd_error *error);

/* kd_document_list finds a list by its name. kd_list_resize sets the number of elements. Elements that are added or
 * removed are set to their defaults. */
const struct kd_list *kd_document_list(const struct kd_document *document, const char *object);
size_t kd_list_size(const struct kd_list *list, const void *from);
void kd_list_resize(const struct kd_document *document, const struct kd_list *list, void *to, size_t size);
/* Returns KD_EINVAL, with a pointer to the first element beyond the limit, if there are too many. */
enum kd_status kd_list_check(const struct kd_list *list, size_t size, struct kd_error *error);

/* Sets one field from a value. Not for arrays. called: name of the field in messages. */
enum kd_status kd_row_put(const struct kd_row *row, void *to, const struct kd_value *value, const char *called,
                          const char *pointer, struct kd_error *error);
/* The two halves of kd_row_put. kd_row_take stores the value if the row accepts it, and returns whether it did.
 * kd_row_refuse returns KD_EINVAL with the message "X is V; it must be ...". */
bool kd_row_take(const struct kd_row *row, void *to, const struct kd_value *value);
enum kd_status kd_row_refuse(const struct kd_row *row, const struct kd_value *value, const char *called,
                             const char *pointer, struct kd_error *error);
/* Returns a row's value as a double, for every kind except TEXT, LIST, WORDS and VECTOR. A BOOL gives 0 or 1, a WORD
 * its index, and the word of an INT gives INFINITY. An ASSET gives 1 if it is set; writing 0 removes the asset. A
 * SERIES with exactly one word, and no number after it, gives the index of that word. Any other SERIES gives NAN. */
double kd_row_get(const struct kd_row *row, const void *from);
void kd_row_put_number(const struct kd_row *row, void *to, double value);
/* True if the row accepts this value. Either the value is in the row's range (and whole, if the kind requires that),
 * or it stands for the row's word. */
bool kd_row_holds(const struct kd_row *row, double value);
/* Replaces a LIST by one with room for n numbers. Returns KD_EINVAL with this pointer if the row does not accept n
 * numbers. */
enum kd_status kd_row_make_room(const struct kd_row *row, void *to, size_t n, const char *pointer,
                                struct kd_number_list **list, struct kd_error *error);
/* Evenly spaced numbers, both ends included. */
enum { KD_RANGE_MOST = 100000 };
struct kd_range {
    double first, last;
    size_t count; /* number of numbers; 1: a single number */
};
double kd_range_at(const struct kd_range *range, size_t i);
/* Reads a row of numbers from typed text: a number or the row's word, or "first:last:count". For a WORD, the result
 * is a single number, the index of the word. On an error *range is unchanged. */
enum kd_status kd_row_range(const struct kd_row *row, const char *text, const char *pointer, struct kd_range *range,
                            struct kd_error *error);
/* Writes a member with the schema, including the default, of the text that kd_row_range reads. */
void kd_row_range_schema(struct kd_json *json, const char *name, const struct kd_row *row);

/* Returns KD_EINVAL with "there is no parameter X; did you mean Y?", or with a list of all known parameters. */
enum kd_status kd_document_unknown(const struct kd_document *document, const char *name, struct kd_error *error);
/* Describes the values that a row accepts, for example "0 to 10 M, or \"isco\"". */
void kd_row_allowed(const struct kd_row *row, char out[KD_ALLOWED_SIZE]);

/* Writes all fields except LISTs as members of the open object. */
void kd_document_write(struct kd_json *json, const struct kd_document *document, const void *from);
/* Writes the value of a row as a member. A LIST is left out. */
void kd_row_write(struct kd_json *json, const struct kd_row *row, const void *from);
/* Like kd_row_write, but with another name. Within an array, the name is NULL. */
void kd_row_write_as(struct kd_json *json, const char *name, const struct kd_row *row, const void *from);
/* Writes a value as returned by kd_row_get, in the form that it has in a document. */
void kd_row_write_value(struct kd_json *json, const char *name, const struct kd_row *row, double value);
/* Writes the schema of each field as members of the open object "properties". */
void kd_document_properties(struct kd_json *json, const struct kd_document *document);
/* Writes the members of a row's schema, without the description. */
void kd_row_type_members(struct kd_json *json, const struct kd_row *row);
/* Writes one row's schema as a member. */
void kd_row_schema(struct kd_json *json, const char *name, const struct kd_row *row);
/* Like kd_row_schema, without the row's description. */
void kd_row_type(struct kd_json *json, const char *name, const struct kd_row *row);
/* Writes the member "required" if a field of the document, or of one of its objects, must be given. */
void kd_document_required(struct kd_json *json, const struct kd_document *document);
/* Writes the array `name` for the controls of a page. Each entry is {"name", "type", "default", "least", "most",
 * "words", "fixed", "help"}. Lists, vectors and texts are left out. */
void kd_document_describe(struct kd_json *json, const char *name, const struct kd_document *document);

#endif
