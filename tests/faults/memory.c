/* Preloaded: makes allocations fail when a test requests it (control.h), for the program and the libraries that it is
 * linked with, but not for a Vulkan driver or the dynamic loader. A thread that cannot be started counts as a failed
 * allocation. */
#include "control.h"

#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* The function exists under a sanitizer only. */
void __lsan_disable(void) __attribute__((weak));
void __lsan_enable(void) __attribute__((weak));

enum { OBJECTS = 64, EARLY = 1 << 16, DEEPEST = 64 };

static struct kd_faults unused = { .fail_at = -1, .files_at = -1 };
struct kd_faults *kd_faults = &unused;

static struct object {
    uintptr_t begin, end, base;
    bool library; /* libmicrohttpd */
} objects[OBJECTS];
static size_t n_objects;
static bool tells; /* true if KD_FAULTS_TELL is set: prints the stack of each failed allocation */

/* Memory for the allocations of dlsym, which are made before the real functions are known. */
static _Alignas(16) unsigned char early[EARLY];
static _Atomic size_t early_used;
static void *(*real_malloc)(size_t), *(*real_calloc)(size_t, size_t), *(*real_realloc)(void *, size_t);
static void (*real_free)(void *);
static _Atomic bool resolving;

static void resolve(void)
{
    if (atomic_exchange(&resolving, true))
        return;
    real_calloc = (void *(*)(size_t, size_t))(uintptr_t)dlsym(RTLD_NEXT, "calloc");
    real_realloc = (void *(*)(void *, size_t))(uintptr_t)dlsym(RTLD_NEXT, "realloc");
    real_free = (void (*)(void *))(uintptr_t)dlsym(RTLD_NEXT, "free");
    real_malloc = (void *(*)(size_t))(uintptr_t)dlsym(RTLD_NEXT, "malloc");
}

static bool is_early(const void *block)
{
    return (const unsigned char *)block >= early && (const unsigned char *)block < early + EARLY;
}

static void *early_block(size_t size)
{
    size_t at = atomic_fetch_add(&early_used, (size + 15) & ~(size_t)15);
    return at + size <= EARLY ? early + at : NULL;
}

/* Records the objects that are loaded before main. Drivers are loaded later, so they are not among them. */
static int note(struct dl_phdr_info *info, size_t size, void *unused_user)
{
    static const char *const others[] = { "libc.so", "ld-linux", "libstdc++", "libgcc_s",
                                          "libasan", "libubsan", "libfaults", "linux-vdso" };
    struct object *o = &objects[n_objects];
    (void)size, (void)unused_user;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strstr(info->dlpi_name, others[i]))
            return 0;
    if (n_objects == OBJECTS)
        return 1;
    *o = (struct object) { .begin = UINTPTR_MAX,
                           .base = info->dlpi_addr,
                           .library = strstr(info->dlpi_name, "libmicrohttpd") };
    for (int i = 0; i < info->dlpi_phnum; i++)
        if (info->dlpi_phdr[i].p_type == PT_LOAD && info->dlpi_phdr[i].p_flags & PF_X) {
            o->begin = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
            o->end = o->begin + info->dlpi_phdr[i].p_memsz;
        }
    n_objects++;
    return 0;
}

__attribute__((constructor)) static void begin(void)
{
    void *stack[1];
    const char *path = getenv("KD_FAULTS");
    int fd = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
    void *map = fd < 0 ? MAP_FAILED : mmap(NULL, sizeof unused, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    dl_iterate_phdr(note, NULL);
    if (__lsan_disable)
        __lsan_disable(); /* the first call of backtrace loads a library, which is never unloaded */
    tells = backtrace(stack, 1) && getenv("KD_FAULTS_TELL");
    if (__lsan_enable)
        __lsan_enable();
    if (map != MAP_FAILED)
        kd_faults = map;
    if (fd >= 0)
        close(fd);
}

bool kd_fault_ours(const void *caller, uint64_t *where)
{
    const uintptr_t at = (uintptr_t)caller;
    for (size_t i = 0; i < n_objects; i++)
        if (at >= objects[i].begin && at < objects[i].end) {
            *where = (uint64_t)i << 48 | (at - objects[i].base);
            return true;
        }
    return false;
}

/* Hash of the stack's return addresses in the recorded objects. Always above 1. */
static int64_t stack_number(void)
{
    void *frames[DEEPEST];
    const int n = backtrace(frames, DEEPEST);
    uint64_t number = UINT64_C(0xCBF29CE484222325), where; /* FNV-1a */
    for (int i = 0; i < n; i++)
        if (kd_fault_ours(frames[i], &where))
            for (int k = 0; k < 64; k += 8)
                number = (number ^ (where >> k & 255)) * UINT64_C(0x100000001B3);
    return (int64_t)(number >> 1 | 2);
}

static void note_stack(int64_t number, uint64_t where)
{
    for (size_t n = 0; n < KD_FAULT_STACKS; n++) {
        struct kd_fault_stack *s = &kd_faults->stacks[((uint64_t)number + n) % KD_FAULT_STACKS];
        int64_t found = 0;
        if (!atomic_compare_exchange_strong(&s->stack, &found, number) && found != number)
            continue;
        atomic_store(&s->from, where);
        atomic_fetch_add(&s->count, 1);
        return;
    }
    abort(); /* the table of stacks is full */
}

/* True if this allocation counts. If a single stack is selected, only its allocations count. */
static bool of_stack(uint64_t where)
{
    const int64_t wanted = atomic_load(&kd_faults->by_stack), number = wanted ? stack_number() : 0;
    if (wanted == 1)
        note_stack(number, where);
    return wanted <= 1 || wanted == number;
}

static bool fails(const void *caller, uint64_t *where)
{
    void *stack[40];
    if (!kd_fault_ours(caller, where))
        return false;
    atomic_fetch_add(&kd_faults->allocations, 1);
    if (!of_stack(*where) || !kd_fault_next(&kd_faults->fail_at, &kd_faults->fail_for))
        return false;
    atomic_fetch_add(&kd_faults->failed, 1);
    atomic_store(&kd_faults->failed_from, (int64_t)*where);
    if (objects[*where >> 48].library)
        atomic_fetch_add(&kd_faults->by_library, 1);
    if (tells)
        backtrace_symbols_fd(stack, backtrace(stack, 40), STDERR_FILENO);
    errno = ENOMEM;
    return true;
}

static uint64_t slot_of(const void *block) { return ((uintptr_t)block >> 4) * UINT64_C(0x9E3779B97F4A7C15) >> 40; }

static void *counted(void *block, uint64_t where)
{
    for (uint64_t i = slot_of(block), n = 0; block && n < KD_FAULT_BLOCKS; n++) {
        struct kd_fault_block *b = &kd_faults->blocks[(i + n) % KD_FAULT_BLOCKS];
        uint64_t none = 0;
        if (!atomic_compare_exchange_strong(&b->at, &none, (uintptr_t)block))
            continue;
        atomic_store(&b->from, where);
        atomic_fetch_add(&kd_faults->live, 1);
        break;
    }
    return block;
}

/* Removes a block from the table. Returns false if the block is not in the table. Looks at as many slots as probing can
 * displace an entry in a table that is a quarter full. *where: the caller that allocated the block. */
static bool uncount(const void *block, uint64_t *where)
{
    for (uint64_t i = slot_of(block), n = 0; n < 64; n++) {
        struct kd_fault_block *b = &kd_faults->blocks[(i + n) % KD_FAULT_BLOCKS];
        uint64_t self = (uintptr_t)block;
        if (atomic_load(&b->at) != self)
            continue;
        *where = atomic_load(&b->from);
        if (!atomic_compare_exchange_strong(&b->at, &self, 0))
            continue;
        atomic_fetch_sub(&kd_faults->live, 1);
        return true;
    }
    return false;
}

void *malloc(size_t size)
{
    uint64_t where = 0;
    if (!real_malloc)
        resolve();
    if (!real_malloc)
        return early_block(size);
    if (!n_objects || !kd_fault_ours(__builtin_return_address(0), &where))
        return real_malloc(size);
    return fails(__builtin_return_address(0), &where) ? NULL : counted(real_malloc(size), where);
}

void *calloc(size_t n, size_t size)
{
    uint64_t where = 0;
    if (!real_malloc)
        resolve();
    if (!real_malloc)
        return early_block(n * size);
    if (!n_objects || !kd_fault_ours(__builtin_return_address(0), &where))
        return real_calloc(n, size);
    return fails(__builtin_return_address(0), &where) ? NULL : counted(real_calloc(n, size), where);
}

void *realloc(void *old, size_t size)
{
    uint64_t where = 0, before = 0;
    if (!real_malloc)
        resolve();
    if (is_early(old) || !real_malloc) {
        void *block = malloc(size);
        if (block && old)
            memcpy(block, old,
                   size < (size_t)(early + EARLY - (unsigned char *)old)
                       ? size
                       : (size_t)(early + EARLY - (unsigned char *)old));
        return block;
    }
    const bool ours = n_objects && kd_fault_ours(__builtin_return_address(0), &where);
    if (ours && fails(__builtin_return_address(0), &where))
        return NULL;
    const bool known = old && uncount(old, &before);
    void *block = real_realloc(old, size);
    if (known && !block && size)
        counted(old, before);
    return ours || known ? counted(block, ours ? where : before) : block;
}

void free(void *block)
{
    uint64_t where;
    if (!block || is_early(block))
        return;
    uncount(block, &where);
    real_free(block);
}

char *strdup(const char *text)
{
    uint64_t where = 0;
    size_t size = strlen(text) + 1;
    if (fails(__builtin_return_address(0), &where))
        return NULL;
    char *copy = malloc(size);
    return copy ? memcpy(counted(copy, where), text, size) : NULL;
}

char *strndup(const char *text, size_t most)
{
    uint64_t where = 0;
    size_t size = strnlen(text, most);
    if (fails(__builtin_return_address(0), &where))
        return NULL;
    char *copy = malloc(size + 1);
    if (copy)
        memcpy(counted(copy, where), text, size), copy[size] = 0;
    return copy;
}

static int print(char **out, const char *format, va_list arguments, const void *caller)
{
    uint64_t where = 0;
    const bool ours = kd_fault_ours(caller, &where);
    if (fails(caller, &where)) {
        *out = NULL;
        return -1;
    }
    int n = vasprintf(out, format, arguments);
    if (n >= 0 && ours)
        counted(*out, where);
    return n;
}

int asprintf(char **out, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int n = print(out, format, arguments, __builtin_return_address(0));
    va_end(arguments);
    return n;
}

int __asprintf_chk(char **out, int flag, const char *format, ...);
int __asprintf_chk(char **out, int flag, const char *format, ...)
{
    va_list arguments;
    (void)flag;
    va_start(arguments, format);
    int n = print(out, format, arguments, __builtin_return_address(0));
    va_end(arguments);
    return n;
}

char *realpath(const char *path, char *out)
{
    uint64_t where = 0;
    KD_FAULT_REAL(char *, "realpath", const char *, char *);
    if (!out && fails(__builtin_return_address(0), &where))
        return NULL;
    char *found = real(path, out);
    return out || !where ? found : counted(found, where);
}

int pthread_create(pthread_t *out, const pthread_attr_t *attributes, void *(*main)(void *), void *user)
{
    uint64_t where = 0;
    KD_FAULT_REAL(int, "pthread_create", pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    return fails(__builtin_return_address(0), &where) ? EAGAIN : real(out, attributes, main, user);
}
