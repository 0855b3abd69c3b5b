/* Limits of query parameters, for the parser and for openapi.json. They are literals, because openapi.json prints
 * them. */
#ifndef KD_SERVER_HTTP_QUERY_H
#define KD_SERVER_HTTP_QUERY_H

#define KD_WAIT_MS 25000      /* without wait_ms: below the half minute after which proxies give up */
#define KD_WAIT_MS_MAX 60000  /* wait_ms */
#define KD_LOSSY_MAX 100      /* lossy, from 1 */
#define KD_LEAST_MIN 0.25     /* least, up to 1 */
#define KD_PATIENCE_MS_MIN 10 /* patience_ms */
#define KD_PATIENCE_MS_MAX 60000
#define KD_ORDER_MAX 9007199254740992 /* order, from 1: 2^53, a whole number in any client */
#define KD_SENTENCES_MAX 4294967295   /* sentences: 32 bits */

#endif
