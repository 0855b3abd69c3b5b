/* List of the options of `kerrd serve`. Flags, members of the configuration file, environment variables, help, the
 * manual page, completions and docs/options.md are made from this list. Constant data. */
#ifndef KD_CLI_SERVE_SETTINGS_H
#define KD_CLI_SERVE_SETTINGS_H

#include "cli/cli.h"
#include "cli/settings.h"

/* GROUP(heading of the options that follow)
 * S(id, name, letter, argument, kind, least, most, default, where, help) */
#define KD_SERVE_SETTINGS(S, GROUP) \
    GROUP("Where it listens:") \
    S(LISTEN, "listen", 'a', "ADDRESS", TEXT, 0, 0, "127.0.0.1", ANYWHERE, \
      "numeric address to listen on (default 127.0.0.1)") \
    S(PORT, "port", 'p', "PORT", NUMBER, 0, 65535, "8080", ANYWHERE, "TCP port, 0 for any free one (default 8080)") \
    S(BASE_PATH, "base-path", 'b', "/PREFIX", TEXT, 0, 0, NULL, ANYWHERE, \
      "what stands before every path, as a proxy passes it on, like /some/prefix (default: nothing)") \
    S(HOST, "host", 'H', "NAME", LIST, 0, 0, NULL, ANYWHERE, \
      "answer requests for this host name too; may be repeated") \
    S(PUBLIC_URL, "public-url", 'u', "URL", TEXT, 0, 0, NULL, ANYWHERE, \
      "by which others reach the page, like https://example.org/black-holes: links and pictures that other sites " \
      "show " \
      "have it, and its host is answered as that of --host is (default: by the Host of a request)") \
    GROUP("Who may use it:") \
    S(TOKEN_FILE, "token-file", 'T', "FILE", TEXT, 0, 0, NULL, ANYWHERE, \
      "take requests with a token of this file alone; a line is NAME ROLE TOKEN, the role view or render") \
    S(INSECURE, "insecure", 'I', "yes|no", SWITCH, 0, 0, "no", ANYWHERE, \
      "listen on an address that other machines reach without a token file: whoever reaches it may use it") \
    S(CROSS_SITE, "allow-cross-site", 'X', "yes|no", SWITCH, 0, 0, "no", ANYWHERE, \
      "take requests that pages of other sites make, as by an <img>") \
    S(CORS_ORIGIN, "cors-origin", 'O', "ORIGIN", LIST, 0, 0, NULL, ANYWHERE, \
      "let pages of this origin, like https://example.org, use the server and read its answers; may be repeated, or " \
      "several with commas between") \
    S(EMBED_ORIGIN, "embed-origin", 'F', "ORIGIN", LIST, 0, 0, NULL, ANYWHERE, \
      "let pages of this origin do so, and show the hole, by /embed in a frame or by the element kerr-hole; given as " \
      "--cors-origin is") \
    GROUP("How much at once, and for whom:") \
    S(QUEUE, "queue", 'q', "N", NUMBER, 1, 100000, "16", ANYWHERE, \
      "renders that may wait for the device (default 16)") \
    S(SESSIONS, "sessions", 's', "N", NUMBER, 1, 10000, "16", ANYWHERE, \
      "live sessions at once, and as many playgrounds (default 16)") \
    S(JOBS, "jobs", 'j', "N", NUMBER, 1, 1000, "16", ANYWHERE, "unfinished jobs at once (default 16)") \
    S(CLIENT_SHARE, "client-share", 'C', "PERCENT", NUMBER, 1, 100, "75", ANYWHERE, \
      "of each of these that one client, a token or an address, may have (default 75)") \
    S(CLIENT_DEVICE_S, "client-device-seconds", 'D', "S", NUMBER, 1, 60, NULL, ANYWHERE, \
      "of the device's time that one client may use in a minute, 1 to 60 (default: all)") \
    S(CLIENT_JOBS, "jobs-per-client", 'J', "N", NUMBER, 1, 1000, NULL, ANYWHERE, \
      "unfinished jobs of one client (default: by --client-share)") \
    S(MEMORY, "memory", 'M', "SIZE", BYTES, 0, 0, NULL, ANYWHERE, KD_CLI_MEMORY_DOC) \
    GROUP("What it keeps, and how it ends:") \
    S(STATE, "state", 'S', "DIR", TEXT, 0, 0, NULL, ANYWHERE, \
      "keep jobs and their frames, and assets, there, so that they survive a restart") \
    S(DRAIN, "drain-seconds", 'g', "S", NUMBER, 1, 86400, "600", ANYWHERE, \
      "after SIGTERM let what was accepted take so long, then end the rest with an answer that says so (default 600)") \
    S(UNTIL_EOF, "until-eof", 'E', "yes|no", SWITCH, 0, 0, "no", ANYWHERE, \
      "stop when standard input ends, as it does when the program that holds its other end is gone") \
    GROUP("The device:") \
    S(DEVICE, "device", 'd', "DEVICE", TEXT, 0, 0, "auto", ANYWHERE, KD_CLI_DEVICE_DOC) \
    S(DEVICE_TIMEOUT, "device-timeout", 't', "SECONDS", NUMBER, 1, 3600, "60", ANYWHERE, \
      "end with exit code 3 when the device has not finished a piece of work after so long (default 60)") \
    S(DEVICE_REOPENINGS, "device-reopenings", 'R', "N", NUMBER, 0, 1000000, "3", ANYWHERE, \
      "open a device that fails again, so many times in ten minutes, before ending with exit code 3 (default 3)") \
    GROUP("Log and configuration:") \
    S(LOG_LEVEL, "log-level", 'l', KD_CLI_LOG_LEVELS, WORDS, 0, 0, "warn", ANYWHERE, KD_CLI_LOG_LEVEL_DOC) \
    S(LOG_FORMAT, "log-format", 'L', "text|json", WORDS, 0, 0, "text", ANYWHERE, \
      "its format: lines for people, or one JSON object a line (default: text)") \
    S(CONFIG, "config", 'c', "FILE", TEXT, 0, 0, NULL, NOT_IN_FILE, \
      "read options from this file, a JSON object of them, like {\"port\": 9090}; -FILE: if it is there") \
    S(SHOW_CONFIG, "show-config", 'w', NULL, SWITCH, 0, 0, NULL, FLAG, \
      "print every option with its value and where that comes from, and serve nothing")

#define KD_SERVE_ID(id, ...) KD_SERVE_##id,
#define KD_SERVE_NOTHING(text)
enum { KD_SERVE_SETTINGS(KD_SERVE_ID, KD_SERVE_NOTHING) KD_SERVE_COUNT };
#undef KD_SERVE_ID
extern const struct kd_cli_setting kd_serve_settings[KD_SERVE_COUNT]; /* defined in serve.c */

#endif
