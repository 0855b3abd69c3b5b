/* What other sites show of a shared scene: title, description, addresses. HTTP thread. */
#ifndef KD_SERVER_ANSWERS_SHARE_H
#define KD_SERVER_ANSWERS_SHARE_H

#include "base/buffer.h"
#include "scene/scene.h"
#include "server/http/request.h"

/* Texts in UTF-8, each with a NUL behind it. All are made of kerrd's own tables and numbers. */
struct kd_shared {
    struct kd_buffer link, code;    /* of scene/link.h; of it image/text_code.h */
    struct kd_buffer title, about;  /* "Gargantua"; a sentence or two */
    struct kd_buffer home, address; /* absolute: of the page, without the slash behind it; of /s/CODE */
    struct kd_buffer picture;       /* absolute: its address, of KD_SHARED_WIDTH pixels */
};

/* Fails with KD_EINVAL and a pointer, KD_ETOOBIG or KD_ENOMEM. Whatever the result, finish it. */
enum kd_status kd_shared_tell(const struct kd_request *request, const struct kd_scene *scene, struct kd_shared *out,
                              struct kd_error *error);
/* Appends what the page's address has behind its #: without a preset it would be the first view. */
enum kd_status kd_shared_fragment(const struct kd_shared *shared, struct kd_buffer *out);
void kd_shared_finish(struct kd_shared *shared);

#endif
