/* Reads and writes the files of assets, and no others. Never follows a link. Private to store.c. */
#ifndef KD_SERVER_ASSET_FOLDER_H
#define KD_SERVER_ASSET_FOLDER_H

#include "base/buffer.h"
#include "server/asset/store.h"

/* Opens STATE/assets, which is created if it does not exist. *out: its descriptor. KD_EIO with a message that
 * contains the path. */
enum kd_status kd_asset_folder_open(const char *state, int *out, struct kd_error *error);

/* Calls found() for each complete asset that kd_asset_look accepts. found() becomes the owner of the bytes. Removes
 * unfinished files that a killed server has left. */
enum kd_status kd_asset_folder_load(int folder,
                                    void (*found)(void *user, const struct kd_asset_about *about,
                                                  struct kd_buffer *bytes),
                                    void *user, struct kd_error *error);

/* Writes the bytes, and then the record. Returns KD_EFULL if the disk is full. */
enum kd_status kd_asset_folder_write(int folder, const struct kd_asset_about *about, struct kd_error *error);
void kd_asset_folder_remove(int folder, const char *hash);

/* Gets a description of the bytes. Returns KD_EINVAL if they are not a picture, grid or observation of a supported
 * type. */
enum kd_status kd_asset_look(const void *data, size_t size, struct kd_asset_about *out, struct kd_error *error);

#endif
