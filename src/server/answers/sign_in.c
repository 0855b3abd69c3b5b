/* The sign-in page, for browsers without a valid access token. It works without scripts: its form sends the token in
 * the page's address. The form has no action, because only then does the browser keep the fragment of the address,
 * which names a lesson or a scene. Accept-Language selects the language, which is English if nothing matches. */
#include "server/http/reply.h"

#include <string.h>
#include <strings.h>

static const struct {
    const char *tag, *title, *asks, *wrong, *later, *label, *button;
} words[] = {
    { "en", "kerrd: access token", "This server needs an access token. Ask its operator for one.",
      "The server does not know this token.",
      "Too many wrong tokens have come from your address. Try again in a few seconds.", "Access token", "Go in" },
    { "it", "kerrd: token d’accesso", "Questo server richiede un token d’accesso. Chiedilo a chi lo gestisce.",
      "Il server non conosce questo token.",
      "Dal tuo indirizzo sono arrivati troppi token sbagliati. Riprova tra qualche secondo.", "Token d’accesso",
      "Entra" },
    { "de", "kerrd: Zugangstoken", "Dieser Server verlangt ein Zugangstoken. Frag den Betreiber danach.",
      "Der Server kennt dieses Token nicht.",
      "Von deiner Adresse sind zu viele falsche Token gekommen. Versuche es in einigen Sekunden noch einmal.",
      "Zugangstoken", "Eintreten" },
};
enum { LANGUAGES = sizeof words / sizeof *words };

/* Returns the first language in Accept-Language that the page supports. Browsers list languages in order of
 * preference. */
static size_t language(struct kd_request *request)
{
    struct kd_buffer list = kd_reply_header_list(request, "Accept-Language");
    size_t found = LANGUAGES;
    for (const char *at = (const char *)list.data; at && found == LANGUAGES; at = strchr(at, ',')) {
        at += strspn(at, ", ");
        for (size_t i = 0; i < LANGUAGES && found == LANGUAGES; i++)
            found = !strncasecmp(at, words[i].tag, 2) && !strchr("abcdefghijklmnopqrstuvwxyz", at[2] | 32) ? i : found;
    }
    kd_buffer_finish(&list);
    return found % LANGUAGES;
}

bool kd_sign_in_wanted(struct kd_request *request, const struct kd_problem *problem)
{
    static const char *const types[] = { KD_PROBLEM_TYPE, "text/html" };
    return (problem->type == KD_PROBLEM_UNAUTHORIZED || problem->type == KD_PROBLEM_WRONG_TOKENS) && request->matched &&
           request->matched->page && !request->body_announced &&
           kd_reply_accepted(request, 2, kd_accept_string, types) == 1;
}

static enum kd_status write_page(struct kd_request *request, const struct kd_problem *problem, struct kd_buffer *page)
{
    const size_t i = language(request);
    const bool tried = kd_target_value(&request->target, KD_ACCESS_QUERY);
    const char *says = problem->type == KD_PROBLEM_WRONG_TOKENS ? words[i].later : tried ? words[i].wrong : "";
    return kd_buffer_printf(
        page,
        "<!doctype html>\n<html lang=\"%s\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width\">\n<title>%s</title>\n"
        "<style>:root{color-scheme:light dark;font:1.1rem/1.5 system-ui,sans-serif}main{max-width:24rem;margin:15vh "
        "auto 0;padding:0 1rem}"
        "label,input,button{display:block;box-sizing:border-box;width:100%%;margin:.4rem "
        "0}input,button{font:inherit;padding:.5rem}</style>\n"
        "<main>\n<h1>kerrd</h1>\n<p id=\"why\">%s</p>\n<p role=\"alert\">%s</p>\n<form>\n<label "
        "for=\"access\">%s</label>\n"
        "<input id=\"access\" name=\"" KD_ACCESS_QUERY
        "\" type=\"password\" autocomplete=\"current-password\" aria-describedby=\"why\" required autofocus>\n"
        "<button>%s</button>\n</form>\n</main>\n</html>\n",
        words[i].tag, words[i].title, words[i].asks, says, words[i].label, words[i].button);
}

enum MHD_Result kd_sign_in_page(struct kd_request *request, const struct kd_problem *problem)
{
    struct kd_buffer page = { 0 };
    if (write_page(request, problem, &page)) {
        kd_buffer_finish(&page);
        return kd_reply_no_memory(request);
    }
    struct MHD_Response *response = kd_reply_take(&page, KD_HTML_TYPE);
    if (!response)
        return kd_reply_no_memory(request);
    MHD_add_response_header(
        response, "Content-Security-Policy",
        "default-src 'none'; style-src 'unsafe-inline'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'");
    MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
    MHD_add_response_header(response, "Vary", "Accept, Accept-Language");
    return kd_reply_refuse(request, problem, response);
}
