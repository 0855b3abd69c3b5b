/* The options of `kerrd serve`. This list determines the flags, the members of the configuration file, the
 * environment variables, the help, the manual page, the completions and docs/options.md. Constant data. */
#ifndef KD_CLI_SERVE_SETTINGS_H
#define KD_CLI_SERVE_SETTINGS_H

#include "cli/cli.h"
#include "cli/settings.h"

/* GROUP(heading of the options that follow)
 * S(id, name, letter, argument, kind, least, most, default, where, help) */
#define KD_SERVE_SETTINGS(S, GROUP) \
    GROUP("Addresses:") \
    S(LISTEN, "listen", 'a', "ADDRESS", TEXT, 0, 0, "127.0.0.1", ANYWHERE, \
      "numeric address to listen on (default 127.0.0.1)") \
    S(PORT, "port", 'p', "PORT", NUMBER, 0, 65535, "8080", ANYWHERE, "TCP port, 0 for any free one (default 8080)") \
    S(BASE_PATH, "base-path", 'b', "/PREFIX", TEXT, 0, 0, NULL, ANYWHERE, \
      "path prefix of all requests that a proxy passes on, like /some/prefix (default: none)") \
    S(HOST, "host", 'H', "NAME", LIST, 0, 0, NULL, ANYWHERE, \
      "answer requests for this host name too; may be repeated") \
    S(PUBLIC_URL, "public-url", 'u', "URL", TEXT, 0, 0, NULL, ANYWHERE, \
      "public address of the page, like https://example.org/black-holes, for links and pictures on other sites; its " \
      "host is accepted like that of --host (default: the Host of a request)") \
    GROUP("Access:") \
    S(TOKEN_FILE, "token-file", 'T', "FILE", TEXT, 0, 0, NULL, ANYWHERE, \
      "accept only requests with a token of this file; a line is NAME ROLE TOKEN, and ROLE is view or render, or " \
      "link for a key that signs links") \
    S(SHARE_KEY, "share-key", 'K', "NAME", TEXT, 0, 0, NULL, ANYWHERE, \
      "let everybody see the scenes that users share, by links that are valid for 30 days and signed with this key " \
      "of the token file") \
    S(INSECURE, "insecure", 'I', "yes|no", SWITCH, 0, 0, "no", ANYWHERE, \
      "allow --listen, without a token file, on an address that other machines reach: everybody on them may use the " \
      "server") \
    S(CROSS_SITE, "allow-cross-site", 'X', "yes|no", SWITCH, 0, 0, "no", ANYWHERE, \
      "accept requests from pages of other sites, for example from an <img>") \
    S(CORS_ORIGIN, "cors-origin", 'O', "ORIGIN", LIST, 0, 0, NULL, ANYWHERE, \
      "let pages of this origin, like https://example.org, use the server and read its answers; may be repeated, or " \
      "be several separated by commas") \
    S(EMBED_ORIGIN, "embed-origin", 'F', "ORIGIN", LIST, 0, 0, NULL, ANYWHERE, \
      "as --cors-origin; pages of this origin may also show the hole, in a frame of /embed or by the element " \
      "kerr-hole") \
    GROUP("The page:") \
    S(SKY, "sky", 'y', "FILE", TEXT, 0, 0, NULL, ANYWHERE, \
      "PNG file with a photograph of the whole sky, as scripts/sky makes it; the page offers it by one click") \
    GROUP("Limits:") \
    S(QUEUE, "queue", 'q', "N", NUMBER, 1, 100000, "16", ANYWHERE, \
      "limit of renders that wait for the device (default 16)") \
    S(SESSIONS, "sessions", 's', "N", NUMBER, 1, 10000, "16", ANYWHERE, \
      "limit of open live sessions, and also of open playgrounds (default 16)") \
    S(JOBS, "jobs", 'j', "N", NUMBER, 1, 1000, "16", ANYWHERE, "limit of unfinished jobs (default 16)") \
    S(CLIENT_SHARE, "client-share", 'C', "PERCENT", NUMBER, 1, 100, "75", ANYWHERE, \
      "largest share in percent of each of these limits for one client, which is a token or an address (default 75)") \
    S(CLIENT_DEVICE_S, "client-device-seconds", 'D', "S", NUMBER, 1, 60, NULL, ANYWHERE, \
      "seconds of device time that one client may use in a minute, 1 to 60 (default: no limit)") \
    S(CLIENT_JOBS, "jobs-per-client", 'J', "N", NUMBER, 1, 1000, NULL, ANYWHERE, \
      "limit of unfinished jobs of one client (default: by --client-share)") \
    S(MEMORY, "memory", 'M', "SIZE", BYTES, 0, 0, NULL, ANYWHERE, KD_CLI_MEMORY_DOC) \
    GROUP("State and shutdown:") \
    S(STATE, "state", 'S', "DIR", TEXT, 0, 0, NULL, ANYWHERE, \
      "folder for jobs, their frames, assets and the spent budgets of links, which then survive a restart") \
    S(DRAIN, "drain-seconds", 'g', "S", NUMBER, 1, 86400, "600", ANYWHERE, \
      "seconds after SIGTERM in which accepted requests may finish; the others are then answered with an error " \
      "(default 600)") \
    S(UNTIL_EOF, "until-eof", 'E', "yes|no", SWITCH, 0, 0, "no", ANYWHERE, \
      "stop when standard input ends, for example when the program that started the server is gone") \
    GROUP("The device:") \
    S(DEVICE, "device", 'd', "DEVICE", TEXT, 0, 0, "auto", ANYWHERE, KD_CLI_DEVICE_DOC) \
    S(DEVICE_TIMEOUT, "device-timeout", 't', "SECONDS", NUMBER, 1, 3600, "60", ANYWHERE, \
      "seconds after which an unfinished submission means that the device hangs, so that kerrd ends with exit code 3 " \
      "(default 60)") \
    S(DEVICE_REOPENINGS, "device-reopenings", 'R', "N", NUMBER, 0, 1000000, "3", ANYWHERE, \
      "how often within ten minutes a failed device is reopened before kerrd ends with exit code 3 (default 3)") \
    GROUP("Log and configuration:") \
    S(LOG_LEVEL, "log-level", 'l', KD_CLI_LOG_LEVELS, WORDS, 0, 0, "warn", ANYWHERE, KD_CLI_LOG_LEVEL_DOC) \
    S(LOG_FORMAT, "log-format", 'L', "text|json", WORDS, 0, 0, "text", ANYWHERE, \
      "format of the log: text for people, or one JSON object a line (default: text)") \
    S(CONFIG, "config", 'c', "FILE", TEXT, 0, 0, NULL, NOT_IN_FILE, \
      "read options from this file, a JSON object like {\"port\": 9090}; with -FILE the file need not exist") \
    S(SHOW_CONFIG, "show-config", 'w', NULL, SWITCH, 0, 0, NULL, FLAG, \
      "print every option with its value and the source of the value, then exit")

#define KD_SERVE_ID(id, ...) KD_SERVE_##id,
#define KD_SERVE_NOTHING(text)
enum { KD_SERVE_SETTINGS(KD_SERVE_ID, KD_SERVE_NOTHING) KD_SERVE_COUNT };
#undef KD_SERVE_ID
extern const struct kd_cli_setting kd_serve_settings[KD_SERVE_COUNT]; /* defined in serve.c */

#endif
