/* Limits of query parameters. They are literals, so that openapi.json can print the same numbers that the parser
 * uses. */
#ifndef KD_SERVER_HTTP_QUERY_H
#define KD_SERVER_HTTP_QUERY_H

#define KD_WAIT_MS 25000       /* default of the parameter wait_ms: proxies commonly give up after 30 s */
#define KD_WAIT_MS_MAX 60000   /* largest value of wait_ms */
#define KD_VERSION_LETTERS 40  /* longest value of the parameter v */
#define KD_MIN_SCALE_MIN 0.25  /* smallest value of the parameter min_scale; the largest is 1 */
#define KD_MAX_FRAME_MS_MIN 10 /* smallest value of the parameter max_frame_ms */
#define KD_MAX_FRAME_MS_MAX 60000
/* largest value of the parameter order; the smallest is 1. It is 2^53, because every client can represent integers
 * up to it exactly */
#define KD_ORDER_MAX 9007199254740992
#define KD_SENTENCES_MAX 4294967295  /* largest value of the parameter sentences: 32 bits */
#define KD_DEPRECATION "@1795910400" /* date since when the former names of parameters are deprecated: 2026-11-29 */

#endif
