/* Writes docs/physics-quantities.md from the tables of quantities. */
#include "quantity/sound.h"
#include "quantity/text.h"

static const char introduction[] =
    "# The numbers by name\n\n`GET /v1/physics/NAME?parameter=value&...` and `kerrd physics NAME --parameter value "
    "...` give the same answers, as JSON or\nas CSV (`Accept: text/csv` or `format=csv`; `--format csv` or `-o "
    "FILE.csv`). `GET /v1/physics` lists the quantities of this page.\nOn the command line a parameter has `-` for "
    "`_`. This page is generated from `src/quantity`; do not edit it.\n[docs/physics](physics/README.md) has the "
    "theory. (`kerrd` on the PATH and a server: [README](../README.md).)\n\n    kerrd physics kerr --spin 0:0.998:100 "
    "-o kerr.csv\n    curl 'http://127.0.0.1:8080/v1/physics/kerr?spin=0:0.998:100'\n    kerrd physics qnm --mass-msun "
    "62 -o ringdown.wav\n\nA value may be a range, `first:last:count`, which includes both ends. With several ranges, "
    "all combinations are computed, at\nmost 100000 points; the last parameter of the table varies fastest. In JSON a "
    "parameter with a range is an array, and so is\nevery value that depends on it. With several ranges, arrays are "
    "flat, and `ranges` and `shape` describe them. `null`, or an\nempty field in CSV, means that the number does not "
    "exist. "
    "`digits=6` (`--digits 6`) limits the significant digits of numbers in\nlists, and of all numbers in CSV; a "
    "plotted curve then takes a third of the bytes. Units are G = c = M = 1 if no other is\nnamed. A value outside the "
    "domain of a quantity is an error (422) that names the parameter and the reason.\n";

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
        const struct kd_row *p = &quantity->parameters[i];
        char allowed[KD_ALLOWED_SIZE];
        kd_row_allowed(p, allowed);
        kd_write(w, "| `%s` | %s | `%s` | %s | ", p->name, p->kind == KD_KIND_WORD ? "" : p->unit, p->typed, allowed);
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
                 "\n`Accept: audio/wav` or `format=wav`, `--format wav` or `-o FILE.wav` give a sound of one point: 16 "
                 "bits, 48 kHz, from full scale at time 0 until half a step is left, then silence up to 0.25 s.\nA "
                 "frequency outside %g to %g Hz is an error that names the audible masses, and the `shift_octaves` "
                 "that makes this one audible.\n",
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
