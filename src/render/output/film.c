/* Encodes the pictures of all frames as a film with the program ffmpeg: H.264 in an MP4 file, or VP9 in a WebM file.
 * ffmpeg writes to an unlinked file, because the index of an MP4 file comes before its pictures and is written last.
 * When ffmpeg is done, this module produces the contents of that file. */
#include "base/clock.h"
#include "base/program.h"
#include "image/png.h"
#include "render/output/gather.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define PICTURE_MAX (32u << 20) /* largest size of one frame's file in bytes: twice that of a 4K picture */
#define MORE (1u << 20)         /* largest size of a film's header in bytes, in addition to its pictures */
/* largest size of the scene's text in bytes, because one argument of a program may have 128 KiB */
#define SCENE_MAX 100000
#define IDLE_MS 30e3 /* ffmpeg is killed if it makes no progress for this long */
#define HEAD 24      /* bytes of a PNG file up to the end of its width and height */

struct film {
    const struct kd_gather_source *source;
    const char *const *codec; /* options of the codec, NULL at the end */
    const char *container;
    struct kd_program program;
    int fd; /* output file; -1: not started */
    bool done;
    struct kd_buffer picture; /* the file of frame `next`; ffmpeg has taken `at` bytes. at == size: no file is loaded */
    size_t at;
    unsigned next;
    uint8_t size[8]; /* width and height of frame 0, as in a PNG file */
    uint64_t given;  /* bytes of the film's file produced so far */
    off_t written;   /* size of the film's file when last checked */
};

/* Options of the codecs, with a quality at which films look like the pictures. At a lower quality, the first visible
 * fault would be banding in a black sky. */
static const char *const h264[] = { "-c:v", "libx264",   "-preset",    "medium", "-crf",
                                    "17",   "-movflags", "+faststart", NULL };
static const char *const vp9[] = { "-c:v", "libvpx-vp9", "-crf", "24",        "-b:v", "0", "-row-mt",
                                   "1",    "-deadline",  "good", "-cpu-used", "4",    NULL };

static enum kd_status open_film(const struct kd_gather_source *source, const char *const *codec, const char *container,
                                void **state, struct kd_error *error)
{
    struct film *f = calloc(1, sizeof *f);
    *state = f;
    if (!f)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a film");
    *f = (struct film) {
        .source = source, .codec = codec, .container = container, .program = KD_PROGRAM_NONE, .fd = -1
    };
    return KD_OK;
}

static enum kd_status open_mp4(const struct kd_gather_source *source, void **state, struct kd_error *error)
{
    return open_film(source, h264, "mp4", state, error);
}

static enum kd_status open_webm(const struct kd_gather_source *source, void **state, struct kd_error *error)
{
    return open_film(source, vp9, "webm", state, error);
}

static uint32_t be32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Loads the next frame's whole file; a picture is some hundred kilobytes. */
static enum kd_status load(struct film *f, struct kd_error *error)
{
    const struct kd_gather_source *source = f->source;
    static const uint8_t zeros[4096];
    uint64_t size;
    enum kd_status status = KD_OK;
    f->picture.size = f->at = 0;
    if (!source->size(source->user, f->next, &size) || size < HEAD)
        return kd_error_set(error, KD_EIO, "the file of frame %u cannot be read", f->next);
    if (size > PICTURE_MAX)
        return kd_error_set(error, KD_ETOOBIG, "the picture of frame %u has %.0f MB; in a film it must have at most %u",
                            f->next, 1e-6 * (double)size, PICTURE_MAX >> 20);
    for (uint64_t left = size; left && !status; left -= left < sizeof zeros ? left : sizeof zeros)
        status = kd_buffer_append(&f->picture, zeros, left < sizeof zeros ? (size_t)left : sizeof zeros);
    if (status)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a film");
    if (!source->read(source->user, f->next, 0, f->picture.data, f->picture.size))
        return kd_error_set(error, KD_EIO, "the file of frame %u cannot be read", f->next);
    const uint8_t *here = (const uint8_t *)f->picture.data + HEAD - sizeof f->size;
    if (!f->next)
        memcpy(f->size, here, sizeof f->size);
    if (memcmp(f->size, here, sizeof f->size))
        return kd_error_field(error, "/format",
                              "frame %u has %u x %u pixels and frame 0 has %u x %u; all frames of a film must have one "
                              "size; a zip may have several",
                              f->next, be32(here), be32(here + 4), be32(f->size), be32(f->size + 4));
    return KD_OK;
}

/* Creates a file that vanishes when its descriptor is closed. */
static int nameless(void)
{
    const char *folder = getenv("TMPDIR");
    char path[4096];
    folder = folder && *folder ? folder : "/tmp";
    int fd = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (fd >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL))
        return fd;
    snprintf(path, sizeof path, "%.4000s/kerrd-film-XXXXXX", folder);
    if ((fd = mkostemp(path, O_CLOEXEC)) >= 0)
        unlink(path);
    return fd;
}

static uint64_t bytes_of(const struct kd_gather_source *source)
{
    uint64_t all = 0, size;
    for (unsigned i = 0; i < source->n; i++)
        all += source->size(source->user, i, &size) ? size : 0;
    return all;
}

/* Starts ffmpeg. The scene of frame 0, as stored in its picture, goes into the film. Colours: the pictures are sRGB;
 * players display them alike if BT.709 is named. The conversion to Y'CbCr is that of BT.709, in video range. Since
 * ffmpeg 7 an encoder uses the colour tags of its frames, which for a PNG are those of sRGB, and ignores its own
 * options. So the filter setparams sets the tags as well. Two pixels share a chroma sample, so odd sides are padded. */
static enum kd_status begin(struct film *f, struct kd_error *error)
{
    static const char filter[] = "pad=ceil(iw/2)*2:ceil(ih/"
                                 "2)*2,scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+"
                                 "full_chroma_inp,format=yuv420p,"
                                 "setparams=range=tv:color_primaries=bt709:color_trc=bt709:colorspace=bt709";
    struct kd_buffer comment = { 0 };
    struct kd_png shown = { 0 };
    char rate[16], titled[80];
    const char *argv[48] = { "ffmpeg", "-nostdin",   "-hide_banner", "-loglevel", "error",  "-f",  "image2pipe", "-c:v",
                             "png",    "-framerate", rate,           "-i",        "pipe:0", "-vf", filter };
    size_t n = 15;
    enum kd_status status;
    KD_TRY(load(f, error));
    KD_TRY(kd_png_decode(f->picture.data, f->picture.size, &shown, error));
    const char *scene = kd_png_text_find(&shown, "kerrd:scene");
    if (!scene || strlen(scene) > SCENE_MAX) {
        status =
            !scene ? kd_error_set(error, KD_EIO, "the picture of frame 0 contains no scene")
                   : kd_error_set(
                         error, KD_ETOOBIG,
                         "the scene has %zu bytes; in a film it must have at most %d; a zip stores it in each picture",
                         strlen(scene), SCENE_MAX);
        goto done;
    }
    KD_TRY(kd_buffer_printf(&comment, "comment=%s", scene));
    snprintf(rate, sizeof rate, "%u", f->source->rate);
    snprintf(titled, sizeof titled, "title=kerrd %s, %u frames", KD_VERSION, f->source->n);
    for (const char *const *option = f->codec; *option; option++)
        argv[n++] = *option;
    const char *const rest[] = { "-colorspace",
                                 "bt709",
                                 "-color_primaries",
                                 "bt709",
                                 "-color_trc",
                                 "bt709",
                                 "-color_range",
                                 "tv",
                                 "-metadata",
                                 (const char *)comment.data,
                                 "-metadata",
                                 titled,
                                 "-f",
                                 f->container,
                                 "-y",
                                 "/dev/fd/3",
                                 NULL };
    memcpy(argv + n, rest, sizeof rest);
    if ((f->fd = nameless()) < 0)
        status =
            kd_error_set(error, errno == ENOSPC ? KD_EFULL : KD_EIO, "cannot create the film: %s", strerror(errno));
    else
        status = kd_program_start(argv, f->fd, bytes_of(f->source) + MORE, &f->program, error);
    if (status == KD_EABSENT)
        kd_error_set(
            error, KD_EABSENT,
            "the program ffmpeg, which encodes films, is not on the PATH; a zip of numbered pictures does not need it");
done:
    if (status == KD_ENOMEM)
        kd_error_set(error, KD_ENOMEM, "out of memory for a film");
    kd_png_finish(&shown);
    kd_buffer_finish(&comment);
    return status;
}

/* True if the film's file has grown since the last check. */
static bool has_written(struct film *f)
{
    struct stat about;
    const off_t before = f->written;
    f->written = fstat(f->fd, &about) ? before : about.st_size;
    return f->written > before;
}

/* Writes as much as ffmpeg accepts now, and checks whether ffmpeg has ended. */
static enum kd_status feed(struct film *f, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    bool moved = has_written(f);
    int code;
    while (f->next < f->source->n && !status) {
        size_t left = f->picture.size - f->at,
               taken = kd_program_write(&f->program, (const char *)f->picture.data + f->at, left);
        f->at += taken;
        moved = moved || taken;
        if (taken < left)
            break;
        if (++f->next < f->source->n)
            status = load(f, error);
        else
            kd_program_hang_up(&f->program);
    }
    if (status)
        return status;
    if (!kd_program_over(&f->program, &code))
        return kd_program_idle_ms(&f->program, moved, kd_clock_ms()) < IDLE_MS
                   ? KD_OK
                   : kd_error_set(error, KD_EIO, "ffmpeg has made no progress for %.0f s, at frame %u of %u",
                                  1e-3 * IDLE_MS, f->next, f->source->n);
    f->done = true;
    if (!code && f->next == f->source->n)
        return KD_OK;
    char reason[300];
    kd_program_reason(&f->program, reason);
    return kd_error_set(
        error, strstr(f->program.said, "No space left") || strstr(f->program.last, "No space left") ? KD_EFULL : KD_EIO,
        "ffmpeg failed at frame %u: %s", f->next, *reason ? reason : "without an error message");
}

static enum kd_status give(struct film *f, struct kd_buffer *out, bool *over, struct kd_error *error)
{
    char piece[65536];
    ssize_t n = pread(f->fd, piece, sizeof piece, (off_t)f->given);
    *over = n == 0;
    if (n < 0 || (*over && !f->given))
        return kd_error_set(error, KD_EIO, "cannot read the film: %s",
                            n < 0 ? strerror(errno) : "ffmpeg wrote nothing");
    f->given += (uint64_t)n;
    return kd_buffer_append(out, piece, (size_t)n) ? kd_error_set(error, KD_ENOMEM, "out of memory for a film") : KD_OK;
}

static enum kd_status next_piece(void *state, struct kd_buffer *out, bool *over, struct kd_error *error)
{
    struct film *f = state;
    enum kd_status status;
    if (f->fd < 0)
        KD_TRY(begin(f, error));
    if (!f->done)
        KD_TRY(feed(f, error));
    status = f->done ? give(f, out, over, error) : KD_OK;
done:
    return status;
}

static void close_film(void *state)
{
    struct film *f = state;
    kd_program_end(&f->program);
    if (f->fd >= 0)
        close(f->fd);
    kd_buffer_finish(&f->picture);
    free(f);
}

static size_t holds(const struct kd_gather_source *source)
{
    (void)source;
    return 2 * PICTURE_MAX; /* memory for the file of a picture, and for the picture's decoded pixels */
}

const struct kd_gather_format kd_gather_mp4 = {
    .name = "mp4",
    .media_type = "video/mp4",
    .of = &kd_format_png,
    .holds = holds,
    .waits = true,
    .open = open_mp4,
    .next = next_piece,
    .close = close_film,
};
const struct kd_gather_format kd_gather_webm = {
    .name = "webm",
    .media_type = "video/webm",
    .of = &kd_format_png,
    .holds = holds,
    .waits = true,
    .open = open_webm,
    .next = next_piece,
    .close = close_film,
};
