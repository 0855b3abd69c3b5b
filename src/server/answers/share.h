/* Title, description and addresses of a shared scene, for other sites. HTTP thread. */
#ifndef KD_SERVER_ANSWERS_SHARE_H
#define KD_SERVER_ANSWERS_SHARE_H

#include "base/buffer.h"
#include "server/http/request.h"
#include "server/render/shared.h"

/* The texts are UTF-8 with a NUL at the end. They consist of kerrd's own strings and of numbers, and contain no text
 * from the client. */
struct kd_shared {
    /* link: link of the left picture (scene/link.h); code: code for all pictures (image/text_code.h) */
    struct kd_buffer link, code;
    /* For two pictures side by side; otherwise "". pair: the fields in which the right picture differs, such as
     * "pair.spacetime.spin=0.998". other: code of the right picture alone. other_picture: absolute address of the
     * right picture, or "" if it is not rendered. */
    struct kd_buffer pair, other, other_picture;
    struct kd_buffer title, about; /* title: for example "Gargantua"; about: one or two sentences */
    /* absolute addresses, signed if the request came by a signed link; home: that of the page, without a slash at
     * its end; address: that of /s/CODE */
    struct kd_buffer home, address;
    struct kd_buffer picture; /* absolute address of the picture, which is KD_SHARED_WIDTH pixels wide */
};

/* Makes the texts. Errors: KD_EINVAL with a pointer, KD_ETOOBIG, KD_ENOMEM. kd_shared_finish must be called in every
 * case. */
enum kd_status kd_shared_tell(const struct kd_request *request, const struct kd_shared_scenes *scenes,
                              struct kd_shared *out, struct kd_error *error);
/* Appends the fragment of the page's address, which is the text after the #. The fragment always names the preset,
 * because otherwise the page would start from its first view. */
enum kd_status kd_shared_fragment(const struct kd_shared *shared, struct kd_buffer *out);
void kd_shared_finish(struct kd_shared *shared);
/* Appends a query (with its "?") that gives the user of an address the same access as this request has. If the
 * request came by a signed link, the query consists of the parameters that sign the path; otherwise it is empty.
 * path: decoded path below the base path. */
enum kd_status kd_shared_sign(const struct kd_request *request, const char *path, struct kd_buffer *out);

#endif
