/* Limits of query parameters. They are literals, so that openapi.json can contain the same numbers that the parser
 * uses. */
#ifndef KD_SERVER_HTTP_QUERY_H
#define KD_SERVER_HTTP_QUERY_H

#define KD_WAIT_MS 25000       /* default of the parameter wait_ms, below 30 s because proxies commonly give up then */
#define KD_WAIT_MS_MAX 60000   /* maximum of wait_ms */
#define KD_VERSION_LETTERS 40  /* maximum length of the parameter v */
#define KD_MIN_SCALE_MIN 0.25  /* minimum of the parameter min_scale; its maximum is 1 */
#define KD_MAX_FRAME_MS_MIN 10 /* minimum of the parameter max_frame_ms */
#define KD_MAX_FRAME_MS_MAX 60000
/* maximum of the parameter order, whose minimum is 1: 2^53, because all clients represent integers up to it exactly */
#define KD_ORDER_MAX 9007199254740992
#define KD_SENTENCES_MAX 4294967295 /* maximum of the parameter sentences: 32 bits */
/* date from which on the former names of parameters are deprecated: 2026-11-29 */
#define KD_DEPRECATION "@1795910400"

#endif
