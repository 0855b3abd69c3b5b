/* Visibilities of a model as an array would have measured them, with its noise. Any thread.
 *
 * The noise is Gaussian and independent between visibilities, with the error of the observation for each of the real
 * and the imaginary part. The noise of a visibility depends only on the seed and on the visibility's number in the
 * file. */
#ifndef KD_OBSERVE_SIMULATE_H
#define KD_OBSERVE_SIMULATE_H

#include "base/buffer.h"
#include "observe/observation.h"

enum { KD_SIMULATION_MARKS = KD_OBSERVATION_ROWS / 8 };

struct kd_simulation {
    const struct kd_observation *observation;
    /* bytes of the observation's uvfits file; NULL: the observation was not uvfits. kd_simulate writes the model's
     * visibilities into them. Weights and flagged data stay unchanged. */
    uint8_t *file;
    size_t size;
    uint8_t *marks; /* if there is a file: KD_SIMULATION_MARKS bytes, initially 0 */
    bool noise;
    uint64_t seed;
};

/* model[i]: visibility in Jy at observation->at[i]. out[i]: the simulated visibility, rounded as the file
 * stores it. Two kinds of data in the file become 0 with the weight 0: cross hands, and groups that the observation
 * does not contain. */
void kd_simulate(const struct kd_simulation *simulation, const double (*model)[2], double (*out)[2]);

/* Writes visibilities in the EHT's CSV. */
enum kd_status kd_observation_write_csv(const struct kd_observation *observation, const double (*visibility)[2],
                                        struct kd_buffer *out);

#endif
