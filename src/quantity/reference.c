/* Writes docs/physics-quantities.md from the tables of quantities. */
#include "quantity/sound.h"
#include "quantity/text.h"

static const char introduction[] = "# The numbers by name\n"
                                   "\n"
                                   "`GET /v1/physics/NAME?parameter=value&...` and `kerrd physics NAME --parameter "
                                   "value ...` give the same answers, as JSON or\n"
                                   "as CSV (`Accept: text/csv` or `format=csv`; `--format csv` or `-o FILE.csv`). `GET "
                                   "/v1/physics` lists what is listed here.\n"
                                   "On the command line a parameter is written with `-` for `_`. This page is "
                                   "generated from `src/quantity`; do not edit it.\n"
                                   "What the numbers mean is in [docs/physics](physics/README.md). (`kerrd` on the "
                                   "PATH and a server: [README](../README.md).)\n"
                                   "\n"
                                   "    kerrd physics kerr --spin 0:0.998:100 -o kerr.csv\n"
                                   "    curl 'http://127.0.0.1:8080/v1/physics/kerr?spin=0:0.998:100'\n"
                                   "    kerrd physics qnm --mass-msun 62 -o ringdown.wav\n"
                                   "\n"
                                   "A value may be a range, `first:last:count`, with both ends; every point of several "
                                   "ranges is computed, the last parameter of\n"
                                   "the table varying fastest, up to 100000 points. In JSON a parameter that is a "
                                   "range is an array, and so is every value that it\n"
                                   "changes; values of several ranges are flat, with their `ranges` and `shape` beside "
                                   "them. `null`, and an empty field in CSV, is\n"
                                   "a number that does not exist. `digits=6` (`--digits 6`) writes no more significant "
                                   "digits than that of the numbers in lists, in\n"
                                   "CSV of all: a third of the bytes, for who draws a curve. G = c = M = 1 where no "
                                   "other unit is named. What lies outside the domain of a quantity is an\n"
                                   "error (422) that names the parameter and the reason.\n";

static void write_escaped(struct kd_writer *w, const char *text)
{
    for (const char *c = text; *c; c++)
        kd_write(w, *c == '|' ? "\\%c" : "%c", *c);
}

static void write_list(struct kd_writer *w, const char *title, const char *const *sentences)
{
    for (size_t i = 0; sentences[i]; i++) {
        kd_write(w, i ? "; " : "\n%s: ", title);
        kd_write(w, "%s", sentences[i]);
    }
    kd_write(w, sentences[0] ? ".\n" : "");
}

static void write_quantity(struct kd_writer *w, const struct kd_quantity *quantity)
{
    kd_write(w, "\n## %s\n\n%c%s.\n\n| parameter | unit | default | allowed | meaning |\n|---|---|---|---|---|\n",
             quantity->name, quantity->summary[0] - 'a' + 'A', quantity->summary + 1);
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        const struct kd_parameter *p = &quantity->parameters[i];
        char allowed[KD_ALLOWED_TEXT];
        kd_parameter_allowed(p, allowed);
        kd_write(w, "| `%s` | %s | `%s` | %s | ", p->name, p->words ? "" : p->unit, p->initial, allowed);
        write_escaped(w, p->help);
        kd_write(w, " |\n");
    }
    kd_write(w, "\n| value | unit | meaning |\n|---|---|---|\n");
    for (size_t i = 0; i < quantity->n_outputs; i++) {
        kd_write(w, "| `%s` | %s | ", quantity->outputs[i].name, quantity->outputs[i].unit);
        write_escaped(w, quantity->outputs[i].help);
        kd_write(w, " |\n");
    }
    if (quantity->sound)
        kd_write(w,
                 "\nAs a sound with `Accept: audio/wav` or `format=wav`, `--format wav` or `-o FILE.wav`: 16 bits, 48 "
                 "kHz, from full scale at time 0 until "
                 "half a step is left, then silence up to 0.25 s.\nIt is of one point. Frequencies outside %g to %g Hz "
                 "are an error that says which "
                 "masses are heard, and by how many `shift_octaves` the others are.\n",
                 KD_SOUND_HZ_MIN, KD_SOUND_HZ_MAX);
    write_list(w, "Sources", quantity->sources);
    write_list(w, "Approximations", quantity->approximations);
}

enum kd_status kd_quantity_reference(struct kd_buffer *out)
{
    struct kd_writer writer = { .out = out }, *w = &writer;
    kd_write(w, "%s", introduction);
    for (size_t i = 0; i < kd_quantity_count; i++)
        write_quantity(w, kd_quantities[i]);
    return writer.status;
}
