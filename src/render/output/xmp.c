#include "render/output/xmp.h"

#include "base/markup.h"

#include <string.h>

#define PREFIX "kerrd:"
#define SCENE "kerrd:scene"

/* A tile is an area that is cropped from the full panorama. */
static enum kd_status put_panorama(const struct kd_scene *scene, struct kd_buffer *out)
{
    const struct kd_window window = kd_scene_window(scene);
    return kd_buffer_printf(out,
                            "<rdf:Description rdf:about=\"\" xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" "
                            "GPano:ProjectionType=\"equirectangular\" GPano:UsePanoramaViewer=\"True\" "
                            "GPano:FullPanoWidthPixels=\"%d\" GPano:FullPanoHeightPixels=\"%d\" "
                            "GPano:CroppedAreaImageWidthPixels=\"%u\" GPano:CroppedAreaImageHeightPixels=\"%u\" "
                            "GPano:CroppedAreaLeftPixels=\"%u\" GPano:CroppedAreaTopPixels=\"%u\"/>\n",
                            scene->image.width, scene->image.height, window.width, window.height, window.left,
                            window.top);
}

enum kd_status kd_xmp_put(const struct kd_picture *picture, const struct kd_note *notes, size_t n_notes,
                          struct kd_buffer *out)
{
    const bool panorama = picture->scene->camera.projection == KD_PROJECTION_EQUIRECTANGULAR;
    enum kd_status status = KD_OK;
    if (!panorama && !n_notes)
        return KD_OK;
    KD_TRY(kd_buffer_printf(out, "<?xpacket begin=\"\xef\xbb\xbf\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
                                 "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
                                 "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"));
    if (panorama)
        KD_TRY(put_panorama(picture->scene, out));
    if (n_notes)
        KD_TRY(kd_buffer_printf(out,
                                "<rdf:Description rdf:about=\"\" xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\" "
                                "xmlns:dc=\"http://purl.org/dc/elements/1.1/\" xmlns:kerrd=\"urn:x-kerrd:notes#\">\n"
                                "<xmp:CreatorTool>kerrd " KD_VERSION "</xmp:CreatorTool>\n"));
    if (n_notes && *picture->frame->credit) {
        KD_TRY(kd_buffer_printf(out, "<dc:rights><rdf:Alt><rdf:li xml:lang=\"x-default\">"));
        KD_TRY(kd_markup_escape(picture->frame->credit, KD_MARKUP_CONTENT, out));
        KD_TRY(kd_buffer_printf(out, "</rdf:li></rdf:Alt></dc:rights>\n"));
    }
    for (size_t i = 0; i < n_notes; i++) {
        if (strncmp(notes[i].name, PREFIX, sizeof PREFIX - 1))
            continue; /* written above as a property that other programs know */
        KD_TRY(kd_buffer_printf(out, "<%s>", notes[i].name));
        KD_TRY(kd_markup_escape(notes[i].text, KD_MARKUP_CONTENT, out));
        KD_TRY(kd_buffer_printf(out, "</%s>\n", notes[i].name));
    }
    KD_TRY(kd_buffer_printf(out, "%s</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"r\"?>",
                            n_notes ? "</rdf:Description>\n" : ""));
done:
    return status;
}

enum kd_status kd_xmp_scene(const void *xmp, size_t size, struct kd_scene *out, struct kd_error *error)
{
    static const char begin[] = "<" SCENE ">", end[] = "</" SCENE ">";
    const char *from = memmem(xmp, size, begin, sizeof begin - 1);
    if (from)
        from += sizeof begin - 1;
    const char *to = from ? memmem(from, size - (size_t)(from - (const char *)xmp), end, sizeof end - 1) : NULL;
    if (!to)
        return kd_error_set(error, KD_EINVAL, "the picture has no scene; it must be one that kerrd wrote");
    struct kd_buffer text = { 0 };
    enum kd_status status = kd_buffer_append(&text, from, (size_t)(to - from));
    if (!status) {
        kd_markup_unescape(&text);
        status = kd_notes_scene((const char *)text.data, text.size, out, error);
    } else {
        kd_error_set(error, status, "out of memory for the scene of a picture");
    }
    kd_buffer_finish(&text);
    return status;
}
