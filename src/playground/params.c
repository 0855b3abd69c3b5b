#include "playground/params.h"

#include "playground/body.h"

#include <stdio.h>
#include <string.h>

#define AT(name) offsetof(struct kd_playground_params, name)
#define REAL(name, value, least, most, help) { #name, KD_SETTING_REAL, AT(name), value, least, most, 0, NULL, help },
#define INT(name, value, least, most, help) { #name, KD_SETTING_INT, AT(name), value, least, most, 0, NULL, help },
#define BOOL(name, value, help) { #name, KD_SETTING_BOOL, AT(name), value, 0, 1, 0, NULL, help },
#define WORD(name, value, words, help) { #name, KD_SETTING_WORD, AT(name), value, 0, 0, 0, words, help },
const struct kd_playground_setting kd_playground_settings[] = { KD_PLAYGROUND_SETTINGS(REAL, INT, BOOL, WORD) };
#undef AT
const size_t kd_playground_n_settings = sizeof kd_playground_settings / sizeof *kd_playground_settings;

#define AT(name) offsetof(struct kd_playground_body, name)
const struct kd_playground_setting kd_playground_body_fields[] = {
    { "mass", KD_SETTING_REAL, AT(mass), 1e-6, 0, 1e12, KD_PLAYGROUND_LEAST, NULL,
      "mass in units of the hole's mass, at least 1e-30; 0: a test body that attracts nothing" },
    { "radius", KD_SETTING_REAL, AT(radius), 0, 0, 1e6, KD_PLAYGROUND_LEAST, NULL,
      "radius in M, at least 1e-30; 0: a point without collisions and tides" },
    REAL(temperature_k, 5800, 0, 1e10, "temperature of the surface in K; 0: dark")
};
const size_t kd_playground_n_body_fields = sizeof kd_playground_body_fields / sizeof *kd_playground_body_fields;

struct kd_playground_params kd_playground_defaults(void)
{
    return (struct kd_playground_params) {
#define VALUE(name, value, ...) .name = (value),
        KD_PLAYGROUND_SETTINGS(VALUE, VALUE, VALUE, VALUE)
    };
}

bool kd_playground_word(const char *words, int i, char *out, size_t size)
{
    for (; i > 0 && words; i--) {
        words = strchr(words, '|');
        words = words ? words + 1 : NULL;
    }
    if (!words)
        return false;
    snprintf(out, size, "%.*s", (int)strcspn(words, "|"), words);
    return true;
}
