#include "scene/hint.h"

#include "scene/table.h"
#include "scene/text.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { NAME_MAX_BYTES = 40, FAR = 1000, HINT_SIZE = 256 };

static int least(int a, int b, int c)
{
    int m = a < b ? a : b;
    return m < c ? m : c;
}

/* Edit distance (Levenshtein) to a name of ours, all lower case; FAR for names longer than any of ours. */
static int distance(const char *given, const char *known)
{
    size_t na = strnlen(given, NAME_MAX_BYTES + 1), nb = strnlen(known, NAME_MAX_BYTES + 1);
    int row[NAME_MAX_BYTES + 1];
    if (na > NAME_MAX_BYTES || nb > NAME_MAX_BYTES)
        return FAR;
    for (size_t j = 0; j <= nb; j++)
        row[j] = (int)j;
    for (size_t i = 1; i <= na; i++) {
        int diagonal = row[0];
        row[0] = (int)i;
        for (size_t j = 1; j <= nb; j++) {
            int differs = tolower((unsigned char)given[i - 1]) != known[j - 1];
            int here = least(row[j] + 1, row[j - 1] + 1, diagonal + differs);
            diagonal = row[j];
            row[j] = here;
        }
    }
    return row[nb];
}

/* FAR unless near enough to be a slip: one edit in three letters, or the name without its unit. */
static int slip(const char *given, const char *known)
{
    size_t n = strnlen(given, NAME_MAX_BYTES + 1);
    int d = distance(given, known);
    if (n >= 3 && n < strlen(known) && !strncmp(given, known, n) && known[n] == '_')
        return 1;
    return d <= (int)(n / 3) ? d : FAR;
}

static void known_names(const struct kd_section *section, char out[HINT_SIZE])
{
    size_t used = (size_t)snprintf(out, HINT_SIZE, "; known are ");
    const char *separator = "";
    bool whole = !*section->name;
    for (size_t i = 0; whole && i + 1 < KD_SECTION_COUNT && used < HINT_SIZE; i++, separator = ", ")
        used += (size_t)snprintf(out + used, HINT_SIZE - used, "%s%s", separator, kd_sections[i].name);
    for (size_t i = 0; i < section->count && used < HINT_SIZE; i++, separator = ", ")
        used += (size_t)snprintf(out + used, HINT_SIZE - used, "%s%s", separator,
                                 kd_fields[section->first + i].name);
}

/* "; did you mean camera.r?" or "; known are ..." */
static void hint(const char *section, const char *name, char out[HINT_SIZE])
{
    int best = FAR;
    char meant[KD_PATH_SIZE] = "";
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_field *field = &kd_fields[i];
        /* Another section counts as one edit: the same name there is as near as a misspelt one here. */
        int score = slip(name, field->name) + (strcmp(section, field->section) ? 1 : 0) +
                    (distance(section, field->section) > 2 ? 1 : 0);
        if (score < best) {
            best = score;
            kd_field_path(field, meant);
        }
    }
    for (size_t i = 0; !*section && i + 1 < KD_SECTION_COUNT; i++) {
        int score = slip(name, kd_sections[i].name);
        if (score < best) {
            best = score;
            snprintf(meant, sizeof meant, "%s", kd_sections[i].name);
        }
    }
    const struct kd_section *home = kd_section_find(section);
    if (best < FAR)
        snprintf(out, HINT_SIZE, "; did you mean %s?", meant);
    else
        known_names(home ? home : &kd_sections[KD_SECTION_COUNT - 1], out);
}

enum kd_status kd_hint_unknown(struct kd_error *error, const char *section, const char *name)
{
    char shown_section[48], shown_name[64], suggestion[HINT_SIZE], pointer[sizeof error->pointer] = "";
    kd_text_clip(shown_section, sizeof shown_section, section);
    kd_text_clip(shown_name, sizeof shown_name, name);
    hint(section, name, suggestion);
    if (*section)
        kd_text_pointer(pointer, sizeof pointer, section);
    kd_text_pointer(pointer, sizeof pointer, name);
    return kd_error_field(error, pointer, "unknown field %s%s%s%s", shown_section, *section ? "." : "",
                          shown_name, suggestion);
}
