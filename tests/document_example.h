/* A document with a field of each kind, for the tests of src/document. */
#ifndef KD_TESTS_DOCUMENT_EXAMPLE_H
#define KD_TESTS_DOCUMENT_EXAMPLE_H

#include "document/document.h"

#include <math.h>

struct tea {
    double minutes, sugar_g, heat, place[3];
    uint32_t cups, with;
    int leaf, pot;
    bool iced, milk;
    struct kd_number_list times;
    char name[8];
};

enum { TEA_POT = 1, TEA_BAG = 2 };

#define AT(member) offsetof(struct tea, member)
static const struct kd_row tea_rows[] = {
    { .name = "minutes",
      .kind = KD_KIND_REAL,
      .offset = AT(minutes),
      .initial = 3,
      .most = 10,
      .open = KD_OPEN_ABOVE,
      .unit = "min",
      .help = "how long it draws" },
    { .name = "sugar_g",
      .kind = KD_KIND_REAL,
      .offset = AT(sugar_g),
      .most = 50,
      .above_0 = 0.5,
      .unit = "g",
      .help = "sugar" },
    { .name = "heat",
      .kind = KD_KIND_REAL,
      .offset = AT(heat),
      .initial = INFINITY,
      .least = 50,
      .most = 100,
      .open = KD_OPEN,
      .words = "boiling",
      .stands = INFINITY,
      .help = "temperature" },
    { .name = "cups",
      .kind = KD_KIND_INT,
      .offset = AT(cups),
      .initial = 1,
      .least = 1,
      .most = 8,
      .needed = true,
      .help = "number of cups" },
    { .name = "leaf",
      .kind = KD_KIND_WORD,
      .offset = AT(leaf),
      .initial = 1,
      .words = "none|green|black",
      .first = 0,
      .fixed = true,
      .help = "kind of leaf" },
    { .name = "pot",
      .kind = KD_KIND_WORD,
      .offset = AT(pot),
      .initial = -1,
      .words = "auto|iron|clay",
      .first = -1,
      .of = TEA_POT,
      .help = "kind of pot" },
    { .name = "iced", .kind = KD_KIND_BOOL, .offset = AT(iced), .help = "with ice or not" },
    { .object = "table",
      .name = "milk",
      .kind = KD_KIND_BOOL,
      .offset = AT(milk),
      .of = TEA_POT,
      .needed = true,
      .help = "with milk or not" },
    { .object = "table",
      .name = "with",
      .kind = KD_KIND_WORDS,
      .offset = AT(with),
      .least = 1,
      .initial = 1,
      .words = "bread|cake|fruit",
      .help = "what is eaten" },
    { .name = "times",
      .kind = KD_KIND_LIST,
      .offset = AT(times),
      .most = 24,
      .room = 4,
      .unit = "h",
      .help = "times of the day" },
    { .name = "place",
      .kind = KD_KIND_VECTOR,
      .offset = AT(place),
      .least = -9,
      .most = 9,
      .room = 3,
      .help = "x, y, z" },
    { .name = "name", .kind = KD_KIND_TEXT, .offset = AT(name), .room = 8, .help = "whose it is" },
};
#undef AT
static const struct kd_document tea_document = { tea_rows, sizeof tea_rows / sizeof *tea_rows, 0, "host|guests", NULL };

/* A document with nested objects, a list, and a former name of an element. A name with a type is a path. */
struct tray {
    double weight_g;
    uint32_t plates;
    bool red;
    char label[KD_ASSET_NAME];
    struct kd_words fruit;
    struct {
        size_t count;
        struct biscuit {
            double size_cm;
            int kind;
        } at[3];
    } biscuits;
};

#define AT(member) offsetof(struct tray, member)
static const struct kd_row tray_rows[] = {
    { .object = "", .name = "weight_g", .kind = KD_KIND_REAL, .offset = AT(weight_g), .initial = 200, .most = 1e3 },
    { .object = "on",
      .name = "plates",
      .kind = KD_KIND_INT,
      .offset = AT(plates),
      .least = 1,
      .most = 9,
      .words = "auto" },
    { .object = "on", .name = "label", .kind = KD_KIND_ASSET, .offset = AT(label) },
    { .object = "on.cloth", .name = "red", .kind = KD_KIND_BOOL, .offset = AT(red), .initial = 1 },
    { .object = "", .name = "fruit", .kind = KD_KIND_SERIES, .offset = AT(fruit), .words = "apple|plum_N" },
    { .object = "biscuits",
      .name = "size_cm",
      .kind = KD_KIND_REAL,
      .offset = AT(biscuits.at[0].size_cm),
      .initial = 5,
      .most = 10 },
    { .object = "biscuits",
      .name = "kind",
      .kind = KD_KIND_WORD,
      .offset = AT(biscuits.at[0].kind),
      .words = "oat|rye" },
};
static const struct kd_list tray_lists[] = {
    { "biscuits", 3, sizeof(struct biscuit), AT(biscuits.count) },
};
static const struct kd_former tray_formers[] = { { "biscuit2", "biscuits", 1 } };
#undef AT
static const struct kd_document tray_document = {
    .rows = tray_rows,
    .n = sizeof tray_rows / sizeof *tray_rows,
    .lists = tray_lists,
    .n_lists = 1,
    .formers = tray_formers,
    .n_formers = 1,
    .paths = true,
};

#endif
