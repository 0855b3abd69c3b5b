/* The fuzz targets, one file each; the head of each file describes its input. meson.build has the same list. */
#ifndef KD_FUZZ_TARGETS_H
#define KD_FUZZ_TARGETS_H

#include <stddef.h>
#include <stdint.h>

/* clang-format off */
#define KD_FUZZ_TARGETS(TARGET) \
    TARGET(access) TARGET(assets) TARGET(config) TARGET(document) TARGET(files) TARGET(http) TARGET(integrals) \
    TARGET(job) TARGET(line) TARGET(link) TARGET(orbits) TARGET(patch) TARGET(pictures) \
    TARGET(playground) TARGET(quantity) TARGET(query) TARGET(rays) TARGET(scene) TARGET(state)
/* clang-format on */

/* Runs a target on an input; aborts if a property does not hold. Always returns 0. */
#define KD_FUZZ_DECLARE(name) int kd_fuzz_##name(const uint8_t *data, size_t size);
KD_FUZZ_TARGETS(KD_FUZZ_DECLARE)
#undef KD_FUZZ_DECLARE

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
