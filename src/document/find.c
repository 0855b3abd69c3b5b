/* Finds the parts of a document by their names. */
#include "document/document_internal.h"

#include <string.h>

static const char *own(const char *object) { return object ? object : ""; }

bool kd_row_is_of(const struct kd_document *document, const struct kd_row *row, const char *object)
{
    return (!document->of || !row->of || row->of & document->of) && !strcmp(own(row->object), own(object));
}

/* after: the row that was found last. The search starts after this row, because fields mostly come in the order of
 * the rows. */
const struct kd_row *kd_find_row(const struct kd_document *document, const char *object, const char *name,
                                 const struct kd_row *after)
{
    const size_t first = after ? (size_t)(after - document->rows) + 1 : 0;
    for (size_t i = 0; i < document->n; i++) {
        const struct kd_row *row = &document->rows[(first + i) % document->n];
        if (!strcmp(row->name, name) && kd_row_is_of(document, row, object))
            return row;
    }
    return NULL;
}

/* True if `whole` is "object.name", or "name" if the object is the document itself. */
static bool joins(const char *whole, const char *object, const char *name)
{
    const size_t n = strlen(object);
    return n ? !strncmp(whole, object, n) && whole[n] == '.' && !strcmp(whole + n + 1, name) : !strcmp(whole, name);
}

const char *kd_find_object(const struct kd_document *document, const char *object, const char *name)
{
    for (size_t i = 0; *name && !strchr(name, '.') && i < document->n; i++) {
        const struct kd_row *row = &document->rows[i];
        if (joins(own(row->object), object, name) && kd_row_is_of(document, row, row->object))
            return row->object;
    }
    return NULL;
}

const struct kd_former *kd_find_former(const struct kd_document *document, const char *name)
{
    for (size_t i = 0; i < document->n_formers; i++)
        if (!strcmp(document->formers[i].name, name))
            return &document->formers[i];
    return NULL;
}

const struct kd_list *kd_document_list(const struct kd_document *document, const char *object)
{
    for (size_t i = 0; i < document->n_lists; i++)
        if (!strcmp(document->lists[i].object, object))
            return &document->lists[i];
    return NULL;
}

bool kd_row_opens(const struct kd_document *document, const struct kd_row *row, const char *object)
{
    const char *name = own(row->object), *dot = strrchr(name, '.');
    const size_t n = dot ? (size_t)(dot - name) : 0;
    if (!*name || strlen(own(object)) != n || strncmp(own(object), name, n))
        return false;
    for (const struct kd_row *before = row; before-- > document->rows;)
        if (kd_row_is_of(document, before, name))
            return false;
    return true;
}

const struct kd_row *kd_document_find(const struct kd_document *document, const char *name)
{
    const char *dot = strrchr(name, '.');
    for (size_t i = 0; i < document->n; i++) {
        const struct kd_row *row = &document->rows[i];
        const char *object = own(row->object);
        if (strcmp(row->name, dot ? dot + 1 : name) || !kd_row_is_of(document, row, object))
            continue;
        if (!dot || (strlen(object) == (size_t)(dot - name) && !strncmp(object, name, (size_t)(dot - name))))
            return row;
    }
    return NULL;
}
