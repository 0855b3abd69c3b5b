/* Simulates an observation: the visibilities of a model as an array would have measured them, with noise. Any thread.
 *
 * The noise is Gaussian and independent between visibilities. Its standard deviation is the error of the observed
 * visibility, for the real part and for the imaginary part. The noise of a visibility depends only on the seed and on
 * the visibility's number in the file. */
#ifndef KD_OBSERVE_SIMULATE_H
#define KD_OBSERVE_SIMULATE_H

#include "base/buffer.h"
#include "observe/observation.h"

enum { KD_SIMULATION_MARKS = KD_OBSERVATION_ROWS / 8 };

struct kd_simulation {
    const struct kd_observation *observation;
    /* bytes of the observation's uvfits file; NULL if the observation was not read from uvfits. kd_simulate writes the
     * model's visibilities into these bytes. Weights and flagged data stay unchanged. */
    uint8_t *file;
    size_t size;
    uint8_t *marks; /* if there is a file: KD_SIMULATION_MARKS bytes of memory, initially 0 */
    bool noise;
    uint64_t seed;
};

/* model[i]: the model's visibility at observation->at[i], Jy. out[i]: the simulated visibility, rounded as the file
 * stores it. In the file, cross hands and groups that the observation does not contain become 0 with the weight 0. */
void kd_simulate(const struct kd_simulation *simulation, const double (*model)[2], double (*out)[2]);

/* Writes visibilities in the EHT's CSV. */
enum kd_status kd_observation_write_csv(const struct kd_observation *observation, const double (*visibility)[2],
                                        struct kd_buffer *out);

#endif
