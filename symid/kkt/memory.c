/* Memory that is allocated once for a structure and used again by every factorisation. */
#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

#define SHARE 16 /* part of what is expected that is added where it does not suffice */
#define WORTH_FORGETTING (1 << 26) /* bytes; less is not worth the time in which pages are taken and cleared anew */
#define LANES 8 /* doubles in the widest vector; columns of fronts are padded to it */

typedef struct Chunk {
    struct Chunk *next;
    size_t size, used; /* doubles */
    double *data;
} Chunk;

/* A list of chunks that is filled from the front and emptied as a whole or back to a mark. */
typedef struct {
    Chunk *first, *now;
    size_t usual; /* size of a new chunk */
} Arena;

typedef struct {
    Chunk *chunk;
    size_t used;
} Mark;

static int padded(int n) { return (n + LANES - 1) & ~(LANES - 1); }

static void *zeros(size_t count, size_t size) { return calloc(count ? count : 1, size); }

static Chunk *new_chunk(size_t size) {
    Chunk *c = malloc(sizeof(Chunk));
    void *data = NULL;
    if (!c || posix_memalign(&data, 64, (size + LANES) * sizeof(double))) { /* a vector may begin at the last one */
        free(c);
        return NULL;
    }
    *c = (Chunk){NULL, size, 0, data};
    return c;
}

/* Memory whose content nobody needs any more: its pages go back to the system until it is written again. */
static void forget(const void *at, size_t bytes) {
#ifdef __linux__ /* elsewhere the advice means other things */
    uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE), first = ((uintptr_t)at + page - 1) / page * page;
    uintptr_t end = ((uintptr_t)at + bytes) / page * page;
    if (bytes >= WORTH_FORGETTING) madvise((void *)first, end - first, MADV_DONTNEED);
#else
    (void)at, (void)bytes;
#endif
}

/* `count` doubles, aligned to a vector, or NULL where memory is out. */
static double *take(Arena *a, size_t count) {
    count = (count + LANES - 1) / LANES * LANES;
    while (a->now && a->now->used + count > a->now->size && a->now->next) {
        a->now = a->now->next;
        a->now->used = 0;
    }
    if (!a->now || a->now->used + count > a->now->size) {
        size_t more = a->first ? a->usual / SHARE + 4096 : a->usual;
        Chunk *fresh = new_chunk(count > more ? count : more);
        if (!fresh) return NULL;
        if (a->now) a->now->next = fresh;
        else a->first = fresh;
        a->now = fresh;
    }
    double *out = a->now->data + a->now->used;
    a->now->used += count;
    return out;
}

static Mark mark(const Arena *a) { return (Mark){a->now, a->now ? a->now->used : 0}; }

static void back_to(Arena *a, Mark m) {
    a->now = m.chunk ? m.chunk : a->first;
    if (a->now) a->now->used = m.used;
}

static void empty(Arena *a) { back_to(a, (Mark){NULL, 0}); }

static size_t bytes_of(const Arena *a) {
    size_t total = 0;
    for (const Chunk *c = a->first; c; c = c->next) total += c->size * sizeof(double);
    return total;
}

static void free_arena(Arena *a) {
    for (Chunk *c = a->first, *next; c; c = next) {
        next = c->next;
        free(c->data);
        free(c);
    }
    a->first = a->now = NULL;
}
