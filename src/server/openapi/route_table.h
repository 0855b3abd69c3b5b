/* The table of all operations in readable form, for docs/routes.md and the page /docs. */
#ifndef KD_SERVER_OPENAPI_ROUTE_TABLE_H
#define KD_SERVER_OPENAPI_ROUTE_TABLE_H

#include "base/buffer.h"
#include "base/error.h"

enum kd_status kd_route_table_markdown(struct kd_buffer *out);
enum kd_status kd_route_table_html(struct kd_buffer *out);

#endif
