#include "render/sky/milky_way_file.h"

#include "base/buffer.h"
#include "base/log.h"
#include "base/read.h"
#include "base/replace.h"
#include "render/sky/panorama.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>

/* Header of the file. The last letter of the mark changes whenever mips are computed differently: is_ours compares
 * texels of level 0, but not mips. */
struct head {
    char mark[8];
    uint64_t hash;
    int32_t seed;
    uint32_t columns, rows, n;
};
static const char mark[8] = "kdmway1";

static size_t words_of(void) { return kd_panorama_words(KD_MILKY_WAY_WIDTH, KD_MILKY_WAY_HEIGHT); }

/* FNV-1a (64 bits), a word at a time. It guards against damage, not against malice: the directory is the user's own. */
static uint64_t hash_of(const uint32_t *words, size_t n)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ words[i]) * UINT64_C(0x100000001b3);
    return hash;
}

static struct head head_of(int32_t seed, const uint32_t *words)
{
    struct head head = { .hash = hash_of(words, words_of()),
                         .seed = seed,
                         .columns = KD_MILKY_WAY_WIDTH,
                         .rows = KD_MILKY_WAY_HEIGHT,
                         .n = (uint32_t)words_of() };
    memcpy(head.mark, mark, sizeof mark);
    return head;
}

/* True if this program would compute the same picture. Another version of the program or of its mathematics library may
 * compute another picture. */
static bool is_ours(int32_t seed, const uint32_t *words)
{
    static const uint32_t rows[] = {
        5, 301, 422, 483, 512, 561, 702, 1022
    }; /* rows of five kinds: at the poles, in clouds, in dust, at nodes, and between nodes */
    enum { N = sizeof rows / sizeof *rows };
    float *texels = malloc(sizeof(float) * 3 * N * KD_MILKY_WAY_WIDTH);
    bool same = texels && !kd_milky_way_rows(seed, rows, N, texels, NULL);
    for (size_t i = 0; same && i < (size_t)N * KD_MILKY_WAY_WIDTH; i++)
        same = kd_panorama_pack(&texels[3 * i]) ==
               words[(size_t)rows[i / KD_MILKY_WAY_WIDTH] * KD_MILKY_WAY_WIDTH + i % KD_MILKY_WAY_WIDTH];
    free(texels);
    return same;
}

bool kd_milky_way_recall(const char *path, int32_t seed, uint32_t *words)
{
    const size_t bytes = words_of() * sizeof *words;
    struct kd_buffer file = { 0 };
    struct head head;
    bool good = kd_read_file(AT_FDCWD, path, 0, sizeof head + bytes, &file) && file.size == sizeof head + bytes;
    if (good) {
        memcpy(words, file.data + sizeof head, bytes);
        head = head_of(seed, words);
        good = !memcmp(&head, file.data, sizeof head) && is_ours(seed, words);
    }
    kd_buffer_finish(&file);
    return good;
}

void kd_milky_way_keep(const char *path, int32_t seed, const uint32_t *words)
{
    const size_t bytes = words_of() * sizeof *words;
    const struct head head = head_of(seed, words);
    uint8_t *file = malloc(sizeof head + bytes);
    if (!file)
        return;
    memcpy(file, &head, sizeof head);
    memcpy(file + sizeof head, words, bytes);
    if (!kd_replace_file(path, file, sizeof head + bytes))
        kd_log(KD_LOG_DEBUG, "cannot write %s: %s", path, strerror(errno));
    free(file);
}
