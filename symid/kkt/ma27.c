/* The entry points through which Ipopt calls (linear_solver=ma27, hsllib=this library), and our own.

   Ipopt keeps nothing for us but its work arrays: the number of a factorisation stands in IKEEP
   after the analysis and in IW after the factorisation. One solve at a time uses this library. */

#define WORTH 50000 /* multiplications per unknown: above, a solver for any sparse matrix does better */
#define SLOTS 3 /* the problem, its restoration, and one that may still be asked */

typedef struct {
    Factor factor;
    int used, generation;
    int64_t nz;
    uint64_t pattern;
    int64_t last;
} Slot;

typedef struct {
    double factorisations, solves, seconds_analysis, seconds_factor, seconds_solve;
    double unknowns, border, tasks, fill, delayed, null, smallest, refused;
} Report;

#include <time.h>
#ifndef SYMID_CLOCK
#define SYMID_CLOCK CLOCK_MONOTONIC
#endif

static Slot slots[SLOTS];
static int64_t clock_of_slots;
static int threads = 1;
static double least_threshold;
static Report report;

static double seconds(void) {
    struct timespec t;
    clock_gettime(SYMID_CLOCK, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static uint64_t pattern_of(int n, int64_t nz, const int *irn, const int *jcn) {
    uint64_t h = 1469598103934665603u ^ (uint64_t)n;
    for (int64_t k = 0; k < nz; k++) h = (h ^ ((uint64_t)(unsigned)irn[k] << 32 | (unsigned)jcn[k])) * 1099511628211u;
    return h;
}

/* A slot for the pattern: an idle one that knows it, else an empty one, else the one used longest ago. */
static Slot *slot_for(int n, int64_t nz, uint64_t pattern, int *known) {
    Slot *oldest = NULL;
    for (int i = 0; i < SLOTS; i++) {
        Slot *s = &slots[i];
        *known = !s->used && s->factor.tree.n == n && s->nz == nz && s->pattern == pattern && s->factor.part;
        if (*known) return s;
    }
    for (int i = 0; i < SLOTS; i++) {
        Slot *s = &slots[i];
        if (!oldest || s->used < oldest->used || (s->used == oldest->used && s->last < oldest->last)) oldest = s;
    }
    *known = oldest->factor.tree.n == n && oldest->nz == nz && oldest->pattern == pattern && oldest->factor.part;
    return oldest;
}

static int all_finite(const double *a, int64_t count) {
    const int64_t exponent = (int64_t)0x7ff << 52;
    int64_t strange = 0;
    for (int64_t i = 0; i < count; i++) {
        int64_t bits;
        memcpy(&bits, a + i, 8);
        strange |= (bits & exponent) == exponent;
    }
    return !strange;
}

void ma27id_(int *icntl, double *cntl) {
    memset(icntl, 0, 30 * sizeof(int));
    memset(cntl, 0, 5 * sizeof(double));
    cntl[0] = 0.1;
}

void ma27ad_(const int *n, const int *nz, const int *irn, const int *jcn, int *iw, const int *liw, int *ikeep, int *iw1,
             int *nsteps, const int *iflag, const int *icntl, const double *cntl, int *info, double *ops) {
    (void)iw, (void)liw, (void)iw1, (void)iflag, (void)icntl, (void)cntl;
    double began = seconds();
    uint64_t pattern = pattern_of(*n, *nz, irn, jcn);
    int known;
    Slot *s = slot_for(*n, *nz, pattern, &known);
    memset(info, 0, 20 * sizeof(int));
    if (!known) {
        free_factor(&s->factor);
        s->nz = *nz, s->pattern = pattern;
        int made = make_factor(&s->factor, *n, *nz, irn, jcn);
        if (!made || s->factor.tree.flops > (double)WORTH * *n) {
            info[0] = -7;
            report.refused = made ? s->factor.tree.flops / *n : INFINITY;
            free_factor(&s->factor);
        }
    }
    if (s->factor.scale) memset(s->factor.scale, 0, *n);
    s->factor.scaled = 0; /* a new solve depends on none before it */
    s->used = 1, s->last = ++clock_of_slots, s->factor.threads = threads;
    ikeep[0] = (int)(s - slots);
    *nsteps = 1;
    *ops = s->factor.tree.flops;
    info[4] = 1, info[5] = 16; /* work space that we want: next to none */
    report.unknowns = *n, report.border = s->factor.tree.border, report.tasks = s->factor.tree.tasks;
    report.seconds_analysis += seconds() - began;
}

void ma27bd_(const int *n, const int *nz, const int *irn, const int *jcn, double *a, const int *la, int *iw,
             const int *liw, int *ikeep, const int *nsteps, int *maxfrt, int *iw1, const int *icntl, double *cntl,
             int *info) {
    (void)la, (void)liw, (void)nsteps, (void)iw1, (void)icntl;
    double began = seconds();
    Slot *s = &slots[ikeep[0]];
    Factor *f = &s->factor;
    memset(info, 0, 20 * sizeof(int));
    *maxfrt = 1;
    s->last = ++clock_of_slots;
    iw[0] = ikeep[0], iw[1] = ++s->generation;
    if (!all_finite(a, *nz)) info[0] = -5;
    else {
        f->threshold = fmax(cntl[0], least_threshold);
        if (!factorise(f, *nz, irn, jcn, a)) info[0] = -7;
        else if (f->counts.null) info[0] = 3, info[1] = *n - (int)f->counts.null;
        info[14] = (int)f->counts.negative;
        report.factorisations++, report.delayed += (double)f->counts.delayed, report.null += (double)f->counts.null;
        if ((double)f->counts.factor > report.fill) report.fill = (double)f->counts.factor;
        if (f->counts.smallest < report.smallest) report.smallest = f->counts.smallest;
    }
    report.seconds_factor += seconds() - began;
}

void ma27cd_(const int *n, const double *a, const int *la, int *iw, const int *liw, double *w, const int *maxfrt,
             double *rhs, int *iw1, const int *nsteps, const int *icntl, const double *cntl) {
    (void)la, (void)liw, (void)w, (void)maxfrt, (void)iw1, (void)nsteps, (void)icntl, (void)cntl;
    double began = seconds();
    Slot *s = &slots[iw[0]];
    int known = s->generation == iw[1];
    if (known && s->factor.values) { /* once: Ipopt writes them anew before it factorises again */
        forget(a, sizeof *a * (size_t)s->nz);
        s->factor.values = NULL;
    }
    if (!known || !solve(&s->factor, rhs))
        for (int i = 0; i < *n; i++) rhs[i] = NAN;
    report.solves++, report.seconds_solve += seconds() - began;
}

/* ---- our own: called before and after a solve ---- */

/* Before a solve. `threshold`: pivots whose multipliers exceed its inverse are delayed, whatever Ipopt allows. */
void symid_kkt_begin(int wanted_threads, double threshold) {
    threads = wanted_threads, least_threshold = threshold;
    report = (Report){.smallest = INFINITY};
}

/* After a solve: slots are idle, and those larger than `keep_bytes` are given back. */
void symid_kkt_end(double keep_bytes, double *out) {
    memcpy(out, &report, sizeof report);
    for (int i = 0; i < SLOTS; i++) {
        Slot *s = &slots[i];
        double bytes = 0;
        s->used = 0;
        for (int a = 0; s->factor.work && a < s->factor.tree.tasks + 2; a++)
            bytes += (double)bytes_of(&s->factor.work[a].factors);
        if (bytes > keep_bytes) free_factor(&s->factor);
    }
}
