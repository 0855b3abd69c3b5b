/* Limits of query parameters, for the parser and for openapi.json, which prints them; so they are literals. */
#ifndef KD_SERVER_HTTP_QUERY_H
#define KD_SERVER_HTTP_QUERY_H

#define KD_WAIT_MS 25000      /* default of wait_ms: proxies commonly give up after 30 s */
#define KD_WAIT_MS_MAX 60000  /* largest wait_ms */
#define KD_LOSSY_MAX 100      /* largest lossy; the smallest is 1 */
#define KD_LEAST_MIN 0.25     /* smallest least; the largest is 1 */
#define KD_PATIENCE_MS_MIN 10 /* smallest patience_ms */
#define KD_PATIENCE_MS_MAX 60000
/* largest order: 2^53, the largest range of integers that every client represents exactly; the smallest is 1 */
#define KD_ORDER_MAX 9007199254740992
#define KD_SENTENCES_MAX 4294967295 /* largest sentences: 32 bits */

#endif
