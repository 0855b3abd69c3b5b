#include "render/emit/matter_array.h"

#include "image/npy.h"

#include <stdio.h>
#include <string.h>

enum kd_status kd_matter_refuse(const char *name, const char *what, struct kd_error *error)
{
    return kd_error_set(error, KD_EINVAL, "the file is not a grid of matter (an NPZ file of arrays): %s %s", name,
                        what);
}

enum kd_status kd_matter_no_memory(struct kd_error *error)
{
    return kd_error_set(error, KD_ENOMEM, "out of memory for a grid of matter");
}

static const struct kd_unzip_member *find(const struct kd_unzip *zip, const char *name)
{
    char file[40];
    snprintf(file, sizeof file, "%s.npy", name);
    return kd_unzip_find(zip, file);
}

bool kd_matter_has(const struct kd_unzip *zip, const char *name) { return find(zip, name); }

enum kd_status kd_matter_member(const struct kd_unzip *zip, const char *name, size_t most, struct kd_buffer *out,
                                struct kd_error *error)
{
    const struct kd_unzip_member *member = find(zip, name);
    struct kd_error why = { 0 };
    enum kd_status status = member ? kd_unzip_take(zip, member, most, out, &why) : KD_EINVAL;
    if (status == KD_EINVAL)
        return kd_matter_refuse(name, member ? why.message : "is missing", error);
    return status ? kd_matter_no_memory(error) : KD_OK;
}

enum kd_status kd_matter_array_take(const struct kd_unzip *zip, const char *name, size_t most,
                                    struct kd_matter_array *out, struct kd_error *error)
{
    struct kd_npy npy = { 0 };
    struct kd_error why = { 0 };
    enum kd_status status;
    *out = (struct kd_matter_array) { 0 };
    KD_TRY(kd_matter_member(zip, name, 8 * most + KD_NPY_HEADER_MAX + 12, &out->file, error));
    if (kd_npy_read(out->file.data, out->file.size, &npy, &why))
        KD_TRY(kd_matter_refuse(name, why.message, error));
    if (npy.n_fields != 1 || npy.fields[0].name[0] || npy.fields[0].type > KD_NPY_F4)
        KD_TRY(kd_matter_refuse(name, "the element type must be <f8 or <f4", error));
    if (!npy.items || npy.items > most) {
        char told[100];
        snprintf(told, sizeof told, "has %llu numbers; it must have 1 to %zu", (unsigned long long)npy.items, most);
        KD_TRY(kd_matter_refuse(name, told, error));
    }
    out->numbers = out->file.data + npy.header_size;
    out->single = npy.fields[0].type == KD_NPY_F4;
    out->n = (size_t)npy.items;
    out->dimensions = npy.n_dimensions;
    memcpy(out->shape, npy.shape, sizeof out->shape);
done:
    if (status)
        kd_matter_array_finish(out);
    return status;
}

double kd_matter_array_at(const struct kd_matter_array *array, size_t i)
{
    double value;
    float single;
    if (!array->single) {
        memcpy(&value, array->numbers + 8 * i, 8);
        return value;
    }
    memcpy(&single, array->numbers + 4 * i, 4);
    return single;
}

void kd_matter_array_finish(struct kd_matter_array *array)
{
    kd_buffer_finish(&array->file);
    *array = (struct kd_matter_array) { 0 };
}
