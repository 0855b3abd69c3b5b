/* kerrd doctor: shows what this machine supports and what is missing, and renders a tiny picture to prove that
 * rendering works. With an option it runs the self-test instead. */
#include "cli/cli.h"
#include "cli/progress.h"
#include "cli/selftest.h"
#include "render/selftest/first_start.h"
#include "render/render.h"
#include "vk/vk.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define WIDTH "64"
#define HEIGHT "36"

struct arguments {
    const char *device;
    bool selftest, json, devices;
};

enum { KEY_SELFTEST = 0x100, KEY_JSON, KEY_DEVICES };

static const struct argp_option options[] = {
    { "selftest", KEY_SELFTEST, NULL, 0,
      "self-test: compute rays, orbits, radii and brightnesses with known results, and print each error with its bound",
      0 },
    { "json", KEY_JSON, NULL, 0, "the self-test's table as JSON", 0 },
    { "devices", KEY_DEVICES, NULL, 0, "only list the devices, one a line: index, tab, name", 0 },
    { 0 },
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &arguments->device; return 0;
    case KEY_SELFTEST: arguments->selftest = true; return 0;
    case KEY_JSON: arguments->json = true; return 0;
    case KEY_DEVICES: arguments->devices = true; return 0;
    case ARGP_KEY_ARG: argp_error(state, "%s cannot be used, because the command takes no argument", text); return 0;
    case ARGP_KEY_END:
        if (arguments->json && !arguments->selftest)
            argp_error(state, "--json cannot be used without --selftest");
        if (arguments->devices && arguments->selftest)
            argp_error(state, "--devices cannot be used with --selftest");
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static double mib(uint64_t bytes) { return (double)bytes / (1 << 20); }

static void print_device(const struct kd_vk_info *info)
{
    uint32_t v = info->api_version;
    printf("device %u: %s\n", info->index, info->name);
    printf("  %s, Vulkan %u.%u.%u, driver %s%s%s\n", kd_vk_type_name(info->type), v >> 22 & 0x7f, v >> 12 & 0x3ff,
           v & 0xfff, info->driver, *info->driver_info ? " " : "", info->driver_info);
    if (info->own_driver)
        printf("  this driver is part of kerrd, because the system has no driver of Vulkan 1.2\n");
    printf("  memory %.0f MiB, one binding %.0f MiB, one allocation %.0f MiB\n", mib(info->heap_bytes),
           mib(info->max_binding_bytes), mib(info->max_allocation_bytes));
    printf("  subgroup %u, workgroup %u, push constants %u bytes, f64 %s, timestamps %s\n", info->subgroup_size,
           info->max_workgroup, info->max_push_bytes, info->float64 ? "yes" : "no", info->timestamps ? "yes" : "no");
    printf("  %s%s\n", info->missing[0] ? "not usable, because it lacks " : "usable", info->missing);
}

/* Prints every device. Returns true if one is usable. */
static bool print_devices(struct kd_error *error)
{
    struct kd_vk_info *list = NULL;
    size_t n = 0;
    bool usable = false;
    if (kd_vk_list(&list, &n, error)) {
        printf("devices: none (%s)\n", error->message);
        return false;
    }
    for (size_t i = 0; i < n; i++) {
        print_device(&list[i]);
        usable = usable || !list[i].missing[0];
    }
    if (n == 0)
        printf("devices: none\n");
    free(list);
    return usable;
}

/* Prints the devices in a form for scripts and for completions of --device. */
static int list_devices(void)
{
    struct kd_vk_info *list = NULL;
    struct kd_error error = { 0 };
    size_t n = 0;
    if (kd_vk_list(&list, &n, &error))
        return kd_cli_fail(&error);
    for (size_t i = 0; i < n; i++)
        printf("%u\t%s\n", list[i].index, list[i].name);
    free(list);
    return kd_cli_print("", 0);
}

static enum kd_status print_choice(const char *device, struct kd_error *error)
{
    struct kd_vk *vk = NULL;
    enum kd_status status = kd_vk_create(&(struct kd_vk_params) { .device = device, .cache_dir = "" }, &vk, error);
    if (!status)
        printf("choice: %s\n", kd_vk_choice(vk));
    kd_vk_destroy(vk);
    return status;
}

/* Prints the default folder of kd_vk_params.cache_dir. */
static void print_cache(void)
{
    const char *xdg = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    char *path = NULL;
    int n = xdg && xdg[0] == '/' ? asprintf(&path, "%s/kerrd", xdg)
            : home && *home      ? asprintf(&path, "%s/.cache/kerrd", home)
                                 : -1;
    if (n < 0)
        printf("kernel cache: none, because neither XDG_CACHE_HOME nor HOME is set; each start compiles all kernels\n");
    else if (access(path, F_OK) && errno == ENOENT)
        printf("kernel cache: %s, does not exist yet\n", path);
    else if (access(path, R_OK | W_OK | X_OK))
        printf("kernel cache: %s: %s; each start compiles all kernels\n", path, strerror(errno));
    else
        printf("kernel cache: %s, writable\n", path);
    if (n >= 0)
        free(path);
}

/* Prints whether validation layers are available. This is only known after an attempt to load them. */
static void print_validation(const char *device)
{
    struct kd_vk *vk = NULL;
    struct kd_error error = { 0 };
    if (kd_vk_create(&(struct kd_vk_params) { .device = device, .cache_dir = "", .validate = true }, &vk, &error))
        printf("validation layer: no (%s); it is for developers: apt install vulkan-validationlayers\n", error.message);
    else
        printf("validation layer: present (KERRD_VALIDATE=1 turns it on)\n");
    kd_vk_destroy(vk);
}

static enum kd_status draw(struct kd_renderer *renderer, struct kd_error *error)
{
    struct kd_scene scene;
    struct kd_capacity capacity;
    struct kd_plan plan;
    kd_scene_defaults(&scene);
    kd_renderer_capacity(renderer, &capacity);
    struct kd_frame frame = { 0 };
    enum kd_status status;
    KD_TRY(kd_scene_set(&scene, "image.width", WIDTH, error));
    KD_TRY(kd_scene_set(&scene, "image.height", HEIGHT, error));
    KD_TRY(kd_plan_make(&scene, &capacity, &plan, error));
    for (int i = 0; i < 2; i++) { /* two runs, because the first one also compiles the kernels */
        double started = kd_progress_clock();
        kd_frame_finish(&frame);
        KD_TRY(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, error));
        printf("render: " WIDTH " x " HEIGHT " pixels in %.1f ms%s\n", 1e3 * (kd_progress_clock() - started),
               i ? "" : ", compilation of kernels included");
    }
done:
    kd_frame_finish(&frame);
    return status;
}

static void print_selftest(const struct kd_verdict *tested)
{
    printf("self-test: %s", kd_verdict_word(tested));
    if (tested->result == KD_FAILED)
        printf(", %u of %u checks, first %s; --selftest shows all of them", tested->failed, tested->checks,
               tested->worst);
    else if (tested->result == KD_PASSED)
        printf(", %u checks in %.1f s%s", tested->checks, tested->seconds,
               tested->now ? "" : " at kerrd's first start with this device and driver; --selftest runs it again");
    printf("\n");
}

static enum kd_status try_render(const char *device, struct kd_error *error)
{
    struct kd_renderer *renderer = NULL;
    enum kd_status status = kd_renderer_create(
        &(struct kd_renderer_params) { .device = device, .prove = kd_first_start }, &renderer, error);
    if (status)
        return status;
    print_selftest(kd_renderer_verdict(renderer));
    status = draw(renderer, error);
    if (status == KD_EDEVICE)
        kd_cli_device_lost(error);
    kd_renderer_destroy(renderer);
    return status;
}

static int examine(const char *device)
{
    struct kd_error error = { 0 };
    printf("kerrd %s\n", KD_VERSION);
    bool any = print_devices(&error);
    print_cache();
    enum kd_status status = print_choice(device, &error);
    if (!status) {
        print_validation(device);
        status = try_render(device, &error);
    }
    if (!any)
        printf("for a driver that works on any machine: apt install mesa-vulkan-drivers\n");
    printf("verdict: %s\n", status ? "not usable" : "usable");
    if (!status)
        return kd_cli_print("", 0);
    fflush(stdout); /* so that the text on stdout comes before the message on stderr */
    kd_cli_fail(&error);
    return status == KD_EINVAL ? KD_EXIT_USAGE : KD_EXIT_FAILURE;
}

static int selftest(const struct arguments *arguments)
{
    struct kd_error error = { 0 };
    unsigned failed = 0;
    if (kd_cli_selftest(arguments->device, arguments->json, &failed, &error))
        return kd_cli_fail(&error);
    int code = kd_cli_print("", 0);
    return failed ? KD_EXIT_FAILURE : code;
}

const struct argp *kd_cli_doctor_argp(void)
{
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .doc =
            "List the Vulkan devices, say which would be used and why, and render a tiny picture on it.\v"
            "The exit code is 0 if kerrd can work here and 1 if it cannot, or if a check of --selftest failed. The "
            "self-test takes a few seconds; docs/accuracy.md lists the numbers that it compares, and their references.",
        .children = kd_cli_device_children,
    };
    return &argp;
}

int kd_cli_doctor(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    argp_parse(kd_cli_doctor_argp(), argc, argv, 0, NULL, &arguments);
    return arguments.devices ? list_devices() : arguments.selftest ? selftest(&arguments) : examine(arguments.device);
}
