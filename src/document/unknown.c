/* Suggestions for names that a document does not have. */
#include "document/document_internal.h"

#include "base/spelling.h"
#include "document/text.h"

#include <stdio.h>
#include <string.h>

struct search {
    const struct kd_document *document;
    const struct kd_object *in;
    const char *name;
    bool bare; /* true if a typed name is given without the name of its object */
    int best;
    char meant[120];
};

static void offer(struct search *s, const char *known, int worse, const char *meant)
{
    const int score = kd_spelling_score(s->name, known) + worse;
    if (score < s->best) {
        s->best = score;
        snprintf(s->meant, sizeof s->meant, "%s", meant);
    }
}

/* Offers the name of a row as a suggestion. A field in another object counts one edit more, or two edits more if
 * that object's name is very different. The same name in another object is thus as near as a misspelt name in this
 * object. */
static void offer_row(struct search *s, const struct kd_row *row)
{
    const char *object = row->object ? row->object : "";
    const struct kd_list *list = kd_document_list(s->document, object);
    const bool same = !strcmp(object, s->in->name);
    const struct kd_object of = { object, list, same ? s->in->index : 0 };
    if (s->bare)
        offer(s, row->name, 0, row->name);
    else
        offer(s, row->name, !same + (!same && kd_spelling_distance(s->in->name, object) > 2),
              kd_mention_of("", &of, row->name).called);
}

static void add(char list[400], const char *name)
{
    const size_t used = strlen(list);
    snprintf(list + used, 400 - used, "%s%s", used ? ", " : "", name);
}

/* Offers and lists the objects that are members of the document itself. */
static void add_objects(struct search *s, char list[400])
{
    for (size_t i = 0; i < s->document->n; i++) {
        const struct kd_row *row = &s->document->rows[i];
        const char *dot = row->object ? strrchr(row->object, '.') : NULL;
        if (!row->object || !*row->object || (i && row->object == s->document->rows[i - 1].object))
            continue;
        offer(s, dot ? dot + 1 : row->object, dot ? 1 : 0, row->object);
        if (kd_row_opens(s->document, row, ""))
            add(list, row->object);
    }
}

enum kd_status kd_unknown(const struct kd_document *document, const struct kd_object *object, const char *name,
                          bool typed, const char *pointer, struct kd_error *error)
{
    const bool bare = typed && !document->paths, top = !bare && !*object->name;
    if (!error) /* a caller without an error needs no suggestion, which takes long to find */
        return KD_EINVAL;
    struct search s = { document, object, name, bare, KD_SPELLING_FAR, "" };
    char list[400] = "", other[KD_WORD_ROOM], in[48], shown[60];
    for (size_t i = 0; i < document->n; i++)
        if (kd_row_is_of(document, &document->rows[i], document->rows[i].object))
            offer_row(&s, &document->rows[i]);
    if (top)
        add_objects(&s, list);
    for (size_t i = 0; i < document->n; i++)
        if (kd_row_is_of(document, &document->rows[i], bare ? document->rows[i].object : object->name))
            add(list, document->rows[i].name);
    for (int i = 0; top && kd_word_at(document->others, i, other); i++) {
        offer(&s, other, 0, other);
        add(list, other);
    }
    kd_text_clip(in, sizeof in, object->name);
    kd_text_clip(shown, sizeof shown, name);
    const struct kd_object clipped = { in, object->list, object->index };
    return kd_error_field(error, pointer, "there is no %s %s%s; %s%s%s", bare ? "parameter" : "field",
                          kd_mention_of("", &clipped, shown).called, typed ? "" : " here",
                          *s.meant ? "did you mean "
                          : bare   ? "the parameters are "
                                   : "the fields are ",
                          *s.meant ? s.meant : list, *s.meant ? "?" : "");
}

enum kd_status kd_document_unknown(const struct kd_document *document, const char *name, struct kd_error *error)
{
    const struct kd_object whole = { .name = "" };
    return kd_unknown(document, &whole, name, true, kd_mention_of("", &whole, name).pointer, error);
}
