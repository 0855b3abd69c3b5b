/* Starts the program within the C library of its own driver (own_driver.h). */
#ifndef KD_VK_OWN_ENTER_H
#define KD_VK_OWN_ENTER_H

/* If the driver is needed here and this system's C library is too old for it, starts the program anew within the
 * driver's C library, and does not return. Call this before anything else has begun. */
void kd_vk_own_enter(int argc, char **argv);

#endif
