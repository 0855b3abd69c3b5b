/* Media types that are used in several parts of the program. Constant data. */
#ifndef KD_BASE_MEDIA_H
#define KD_BASE_MEDIA_H

#define KD_JSON_TYPE "application/json"
#define KD_NDJSON_TYPE "application/x-ndjson"
#define KD_PATCH_TYPE "application/merge-patch+json" /* RFC 7396 */
#define KD_PROBLEM_TYPE "application/problem+json"   /* RFC 9457 */
#define KD_HTML_TYPE "text/html; charset=utf-8"
#define KD_CSV_TYPE "text/csv"
/* header=present (RFC 4180) means that the first line has the names of the columns */
#define KD_CSV_HEADED_TYPE KD_CSV_TYPE "; charset=utf-8; header=present"
#define KD_EVENTS_TYPE "text/event-stream"
#define KD_BYTES_TYPE "application/octet-stream"
#define KD_FRAMES_TYPE "application/x-kerrd-frames" /* docs/live.md */
#define KD_NPY_TYPE "application/x-npy"
#define KD_NPZ_TYPE "application/x-npz"
#define KD_FITS_TYPE "application/fits"
#define KD_UVFITS_TYPE "application/x-uvfits"
#define KD_PNG_TYPE "image/png"
#define KD_JPEG_TYPE "image/jpeg"
#define KD_WAV_TYPE "audio/wav"

#endif
