#include "scene/hint.h"

#include "base/spelling.h"
#include "scene/table.h"
#include "document/text.h"

#include <stdio.h>
#include <string.h>

enum { HINT_SIZE = 256 };

static void known_names(const struct kd_section *section, char out[HINT_SIZE])
{
    size_t used = (size_t)snprintf(out, HINT_SIZE, "; known are ");
    const char *separator = "";
    bool whole = !*section->name;
    for (size_t i = 0; whole && i + 1 < KD_SECTION_COUNT && used < HINT_SIZE; i++, separator = ", ") {
        if (strchr(kd_sections[i].name, '.')) /* the section is nested in another one */
            continue;
        used += (size_t)snprintf(out + used, HINT_SIZE - used, "%s%s", separator, kd_sections[i].name);
    }
    for (size_t i = 0; i < section->count && used < HINT_SIZE; i++, separator = ", ")
        used += (size_t)snprintf(out + used, HINT_SIZE - used, "%s%s", separator, kd_fields[section->first + i].name);
}

/* Writes "; did you mean camera.r?" or "; known are ...". */
static void hint(const char *section, size_t index, const char *name, char out[HINT_SIZE])
{
    int best = KD_SPELLING_FAR;
    char meant[KD_PATH_SIZE] = "";
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_row *field = &kd_fields[i];
        /* A different section counts as one edit: the same name in another section is as near as a misspelt name in
         * this one. */
        int score = kd_spelling_score(name, field->name) + (strcmp(section, field->object) ? 1 : 0) +
                    (kd_spelling_distance(section, field->object) > 2 ? 1 : 0);
        if (score < best) {
            best = score;
            kd_field_path(field, strcmp(section, field->object) ? 0 : index, meant);
        }
    }
    for (size_t i = 0; !*section && i + 1 < KD_SECTION_COUNT; i++) {
        int score =
            kd_spelling_score(name, kd_section_member(&kd_sections[i])) + (strchr(kd_sections[i].name, '.') ? 1 : 0);
        if (score < best) {
            best = score;
            snprintf(meant, sizeof meant, "%s", kd_sections[i].name);
        }
    }
    const struct kd_section *home = kd_section_find(section);
    if (best < KD_SPELLING_FAR)
        snprintf(out, HINT_SIZE, "; did you mean %s?", meant);
    else
        known_names(home ? home : &kd_sections[KD_SECTION_COUNT - 1], out);
}

enum kd_status kd_hint_unknown(struct kd_error *error, const char *section, size_t index, const char *name)
{
    const struct kd_section *known = kd_section_find(section);
    char shown_section[48], shown_name[64], element[24] = "", suggestion[HINT_SIZE],
                                            pointer[sizeof error->pointer] = "";
    kd_text_clip(shown_section, sizeof shown_section, section);
    kd_text_clip(shown_name, sizeof shown_name, name);
    hint(section, index, name, suggestion);
    if (known)
        kd_section_pointer(known, pointer);
    else if (*section)
        kd_text_pointer(pointer, sizeof pointer, section);
    if (known && known->most) {
        snprintf(element, sizeof element, ".%zu", index);
        kd_text_pointer(pointer, sizeof pointer, element + 1);
    }
    kd_text_pointer(pointer, sizeof pointer, name);
    return kd_error_field(error, pointer, "unknown field %s%s%s%s%s", shown_section, element, *section ? "." : "",
                          shown_name, suggestion);
}
