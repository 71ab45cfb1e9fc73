/* What one simulation is given, what it works on, and the small matrices of its equations. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
/* Rows of sensitivities are short: of vectors of 512 bits the remainders take an eighth of a simulation's time. */
#pragma GCC target("prefer-vector-width=256")
#endif
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NX (v->m->nx)
#define NL (v->m->nl)
#define NU (v->m->nu)
#define NY (v->m->ny)
#define NXX NX
#define NON(n) ((n) > 0 ? (n) : 1)
/* Rows of sensitivities are padded with zeros to whole vectors of the processor, so that no loop has a remainder. */
#define WIDE 4
#define PADDED(n) (((n) + WIDE - 1) / WIDE * WIDE)

typedef struct {
    long N, early, substeps, method, nq, nqp, nqx, nh, npast; /* rows of t and u from -early to N - 1 */
    const double *t, *u, *du, *ddu, *w, *p, *c, *x0; /* first and second derivatives of u, null where no input has any */
    const int *qp, *qx;             /* which parameters, which initial states */
    const double *gain, *recorded;  /* (1 + npast) x NX x NY corrections at the samples, or null: of the
                                       state now, and of what it was 1, 2 ... sample intervals ago */
    const double *dgain;            /* slopes of each element of gain, padded rows, or null */
    const double *ht, *hx, *hs;     /* given history before the start, and its NX x (nqp + nqx) slopes, or null */
    double limit;
    long stiff;                     /* result: steps in which something was stiff */
    double *X, *Y, *SX, *SY;        /* results: N x NX, N x NY, N x NX x nq, N x NY x nq */
} Run;

typedef struct {
    Run r;
    const Ode *m;
    long steps, *hint, nq;              /* nq: sensitivities in a padded row */
    const int *column;                  /* of each parameter among the sensitivities, -1 where not asked for */
    double *when, *span, *poly, *spoly; /* the last `kept` steps: x0, k1, k2 + k3, k4 of states, then of S */
    long kept;                          /* step n is stored in the place n % kept */
    double *told;                       /* what a sample tells of the past, see `correct_past` */
    double *lag, *dlag;                 /* NL, NL x nq */
    double tk, hk;                      /* start and length of the present step; 0 between steps */
    double *ak, *sak;                   /* rate of change of x' in the last step, and of S' */
    double *xk, *k1, *sk, *sk1; /* start of the present step */
    double *size;                       /* the largest that each state was */
    double *err, span_err;              /* of the two steps before, the later first; how long these were */
    double calm;                        /* what steps erred by before the rates bent, of the sizes; 0 at the start */
    int smooth;                         /* so many steps before this one were looked at, and are smooth */
    long begun, cuts;                   /* steps that a run was to make so far, and how often they were halved */
    long stiff;                         /* steps in which something was stiff */
    int inside;                         /* k1 of the present step is known */
    double *x, *S, *xs, *Sx;            /* the state and its sensitivities, now and within a step */
    double *rate[4], *Rate[4], *lS, *A; /* of the stages, of S there; of late signals; derivative of the rates by x */
} Work;

static void add(double a, const double *restrict x, double *restrict y, long padded)
{
    for (long k = 0; k < padded; k += WIDE) for (int j = 0; j < WIDE; j++) y[k+j] += a * x[k+j];
}

static void swap(double *restrict x, double *restrict y, long n)
{
    for (long k = 0; k < n; k++) { double s = x[k]; x[k] = y[k]; y[k] = s; }
}

/* b = M^-1 b, and M = P L U in its place, by partial pivoting, with the inverses of the pivots on its diagonal; 1 where
 * it is singular. */
static inline __attribute__((always_inline)) int factored(const int n, double *restrict M, int *restrict pivot,
                                                         double *restrict b)
{
#pragma GCC unroll 6
    for (int k = 0; k < n; k++) {
        int piv = k;
        for (int i = k + 1; i < n; i++) if (fabs(M[i*n+k]) > fabs(M[piv*n+k])) piv = i;
        double largest = M[piv*n+k];
        if (!(fabs(largest) > 1e-300)) return 1;
        pivot[k] = piv;
        if (piv != k) { swap(M + k*n, M + piv*n, n); swap(b + k, b + piv, 1); }
        double inv = M[k*n+k] = largest == 1.0 ? 1.0 : 1.0 / largest;
        for (int i = k + 1; i < n; i++) {
            double f = M[i*n+k];
            if (f == 0.0) continue;
            M[i*n+k] = f *= inv;
            for (int j = k + 1; j < n; j++) M[i*n+j] -= f * M[k*n+j];
            b[i] -= f * b[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int i = k + 1; i < n; i++) if (M[k*n+i] != 0.0) b[k] -= M[k*n+i] * b[i];
        b[k] *= M[k*n+k];
    }
    return 0;
}

/* Unrolled loops of a known length are about twice as fast. */
static int factor(int n, double *restrict M, int *restrict pivot, double *restrict b)
{
    switch (n) {
    case 1: return factored(1, M, pivot, b);
    case 2: return factored(2, M, pivot, b);
    case 3: return factored(3, M, pivot, b);
    case 4: return factored(4, M, pivot, b);
    case 5: return factored(5, M, pivot, b);
    case 6: return factored(6, M, pivot, b);
    default: return factored(n, M, pivot, b);
    }
}

/* B = M^-1 B for n padded rows of B, those of the numbers `rows` or the first ones, with the factors of M. */
static void solve(int n, const double *M, const int *pivot, const int *rows, double *B, long padded)
{
    double *row[NON(n)];
    for (int k = 0; k < n; k++) row[k] = B + (rows ? rows[k] : k)*padded;
    for (int k = 0; k < n; k++) if (pivot[k] != k) swap(row[k], row[pivot[k]], padded);
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i < n; i++)
            if (M[i*n+k] != 0.0) add(-M[i*n+k], row[k], row[i], padded);
    for (int k = n - 1; k >= 0; k--) {
        for (int i = k + 1; i < n; i++)
            if (M[k*n+i] != 0.0) add(-M[k*n+i], row[i], row[k], padded);
        double inv = M[k*n+k];
        if (inv != 1.0) for (long j = 0; j < padded; j += WIDE) for (int l = 0; l < WIDE; l++) row[k][j+l] *= inv;
    }
}
