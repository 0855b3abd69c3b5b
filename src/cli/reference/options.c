#include "cli/reference/options.h"

#include "cli/commands.h"
#include "quantity/quantity.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Options that argp adds to every parser. -h is kerrd's own hidden alias of -?. */
static const struct argp_option built_in[] = {
    { "help", '?', NULL, 0, "Give this help list", -1 },
    { "usage", 0, NULL, 0, "Give a short usage message", -1 },
    { "version", 'V', NULL, 0, "Print program version", -1 },
    { 0 },
};

static bool is_end(const struct argp_option *o) { return !o->name && !o->key && !o->doc && !o->group; }
static char letter_of(const struct argp_option *o) { return o->key > ' ' && o->key <= '~' ? (char)o->key : 0; }

/* If two options claim the same letter, argp gives it to the option that it finds first: the parent's. */
static char free_letter(const struct kd_options *out, const struct argp_option *o)
{
    for (size_t i = 0; i < out->n; i++)
        if (out->list[i].letter == letter_of(o))
            return 0;
    return letter_of(o);
}

static bool add_alias(struct kd_options *out, const struct argp_option *o)
{
    struct kd_option *of = out->n ? &out->list[out->n - 1] : NULL;
    if (!of || of->n_names == KD_OPTION_NAMES)
        return false;
    if (!of->letter)
        of->letter = free_letter(out, o);
    if (o->name)
        of->names[of->n_names++] = o->name;
    return true;
}

/* Appends an option and updates *group by argp's rules: group 0 means the group of the previous option, and a
 * heading starts the next group. */
static bool add(struct kd_options *out, const struct argp_option *o, int *group)
{
    const bool heading = !o->name && !letter_of(o);
    *group = o->group ? o->group : heading ? *group + 1 : *group;
    if (o->flags & OPTION_HIDDEN)
        return true;
    if (o->flags & OPTION_ALIAS)
        return add_alias(out, o);
    if (out->n == KD_OPTIONS_MOST)
        return false;
    const char *doc = o->doc ? o->doc : "";
    out->list[out->n++] = (struct kd_option) {
        .letter = free_letter(out, o),
        .names = { o->name },
        .n_names = o->name ? 1 : 0,
        .argument = o->arg,
        .optional = o->flags & OPTION_ARG_OPTIONAL,
        .again = strstr(doc, "may be repeated") || strstr(doc, "again for each more"),
        .takes = kd_argument_of(o->arg),
        .doc = doc,
        .group = *group,
    };
    return true;
}

static bool add_heading(struct kd_options *out, const char *text, int group)
{
    const struct argp_option heading = { .doc = text, .group = group };
    int at = 0;
    return add(out, &heading, &at);
}

static bool add_all(const struct argp *argp, struct kd_options *out)
{
    int group = 0;
    for (const struct argp_option *o = argp->options; o && !is_end(o); o++)
        if (!add(out, o, &group))
            return false;
    for (const struct argp_child *child = argp->children; child && child->argp; child++)
        if ((child->header && *child->header && !add_heading(out, child->header, child->group)) ||
            !add_all(child->argp, out))
            return false;
    return true;
}

/* Position of a group in argp's order: 0, 1, 2, ..., then the negative numbers, with -1 at the very end. */
static long rank(int group) { return group < 0 ? 2L * INT_MAX + 2 + group : group; }

static void sort(struct kd_options *options)
{
    for (size_t i = 1; i < options->n; i++) {
        const struct kd_option o = options->list[i];
        size_t j = i;
        for (; j && rank(options->list[j - 1].group) > rank(o.group); j--)
            options->list[j] = options->list[j - 1];
        options->list[j] = o;
    }
}

bool kd_options_read(const struct argp *argp, struct kd_options *out)
{
    const struct argp own = { .options = built_in };
    *out = (struct kd_options) { 0 };
    const bool all = add_all(argp, out) && add_all(&own, out);
    sort(out);
    return all;
}

bool kd_context_at(size_t i, struct kd_context *out)
{
    *out = (struct kd_context) { 0 };
    if (i >= kd_n_commands + kd_quantity_count)
        return false;
    if (i < kd_n_commands) {
        snprintf(out->name, sizeof out->name, "%s", kd_commands[i].name);
        out->help = kd_commands[i].help;
        out->argp = kd_commands[i].argp();
    } else {
        const struct kd_quantity *quantity = kd_quantities[i - kd_n_commands];
        snprintf(out->name, sizeof out->name, "physics %s", quantity->name);
        out->help = quantity->summary;
        out->argp = kd_cli_quantity_argp(quantity);
    }
    out->complete = kd_options_read(out->argp, &out->options);
    return true;
}

void kd_options_texts(const struct argp *argp, bool after,
                      void (*one)(struct kd_writer *w, const char *text, size_t length), struct kd_writer *w)
{
    const char *doc = argp->doc ? argp->doc : "", *end = strchrnul(doc, '\v');
    if (after && *end)
        one(w, end + 1, strlen(end + 1));
    else if (!after && end > doc)
        one(w, doc, (size_t)(end - doc));
    for (const struct argp_child *child = argp->children; child && child->argp; child++)
        kd_options_texts(child->argp, after, one, w);
}
