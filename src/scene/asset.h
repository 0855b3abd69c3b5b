/* Assets are bytes that a scene names and does not hold. A document names one by the SHA-256 of its bytes or by a name that whoever reads the
 * document knows it by; a name is resolved into the hash before the scene is used, so that the identity of a scene, and of its picture, is the
 * content. Nothing is ever fetched for a name. Any thread. */
#ifndef KD_SCENE_ASSET_H
#define KD_SCENE_ASSET_H

#include "scene/scene.h"

/* A hash is 64 hexadecimal digits, lower case. */
bool kd_asset_is_hash(const char *text);
/* A name is a letter, and up to 62 letters, digits, dots, dashes and underscores. */
bool kd_asset_is_name(const char *text);

/* Puts the hash in the place of each name, by find(user, name or hash, hash), which is asked about hashes too. Where that knows none:
 * KD_EINVAL with the field's pointer, and *scene unchanged. */
typedef bool (*kd_asset_find_fn)(void *user, const char *name, char hash[KD_ASSET_NAME]);
enum kd_status kd_scene_resolve(struct kd_scene *scene, kd_asset_find_fn find, void *user, struct kd_error *error);

#endif
