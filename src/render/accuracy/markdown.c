/* Writes the accuracy table as Markdown. */
#include "render/accuracy/table.h"

#include <math.h>

static enum kd_status add_error(struct kd_buffer *out, double value)
{
    return isfinite(value) ? kd_buffer_printf(out, " %.1e |", value) : kd_buffer_printf(out, " – |");
}

static enum kd_status add_row(struct kd_buffer *out, const struct kd_accuracy_table *table,
                              const struct kd_accuracy_row *row, enum kd_accuracy_set set)
{
    const struct kd_accuracy_entry *e = &row->sets[set];
    enum kd_status status;
    if (!e->rays)
        return KD_OK;
    bool closed = row->engine == KD_ENGINE_CLOSED;
    uint32_t cores = closed || !table->cores ? 1 : table->cores;
    KD_TRY(kd_buffer_printf(out, "| %s | %s |", kd_engine_name(row->engine), kd_precision_name(row->precision)));
    KD_TRY(row->steps ? kd_buffer_printf(out, " %u |", row->steps) : kd_buffer_printf(out, " – |"));
    KD_TRY(kd_buffer_printf(out, " %.3g |", e->rays_per_s / cores * 1e-6));
    for (int q = 0; q < KD_ACCURACY_QUANTITIES; q++) {
        KD_TRY(add_error(out, e->of[q].median));
        KD_TRY(add_error(out, e->of[q].p99));
        KD_TRY(add_error(out, e->of[q].worst));
    }
    KD_TRY(closed ? kd_buffer_printf(out, " – |\n") : kd_buffer_printf(out, " %u of %u |\n", e->differ, e->rays));
done:
    return status;
}

static enum kd_status add_set(struct kd_buffer *out, const struct kd_accuracy_table *table, enum kd_accuracy_set set)
{
    enum kd_status status =
        kd_buffer_printf(out,
                         "\n**%s**: %s\n\n"
                         "| engine | precision | steps | Mray/s%s | r: median | 99 %% | worst | φ: median | 99 %% | "
                         "worst | delay: median | 99 %% | worst "
                         "| g: median | 99 %% | worst | differ |\n"
                         "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
                         kd_accuracy_set_names[set], kd_accuracy_set_rays[set], table->cores ? "/core" : "");
    for (uint32_t i = 0; i < table->n && !status; i++)
        status = add_row(out, table, &table->rows[i], set);
    return status;
}

enum kd_status kd_accuracy_to_markdown(const struct kd_accuracy_table *table, struct kd_buffer *out)
{
    enum kd_status status =
        kd_buffer_printf(out, "kerrd %s, %s, %s, %s: `%s`.%s%s\n", table->version, table->date, table->machine,
                         table->device, table->command, table->skipped[0] ? " Skipped: " : "", table->skipped);
    for (int k = 0; k < KD_ACCURACY_SETS && !status; k++)
        status = add_set(out, table, (enum kd_accuracy_set)k);
    return status;
}
