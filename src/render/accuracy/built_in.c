/* The accuracy table that is embedded in the program. */
#include "render/accuracy/table.h"

#include <pthread.h>
#include <stdlib.h>

/* A file of bench/results, embedded by embed.py. */
extern const unsigned char kd_accuracy_json[];
extern const size_t kd_accuracy_json_size;

static struct kd_accuracy_table *built_in;
static void read_built_in(void)
{
    struct kd_accuracy_table *table = malloc(sizeof *table);
    if (table && !kd_accuracy_from_json((const char *)kd_accuracy_json, kd_accuracy_json_size, table, NULL))
        built_in = table;
    else
        free(table);
}

const struct kd_accuracy_table *kd_accuracy_built_in(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, read_built_in);
    return built_in;
}
