/* Explicit fixed-step integration of M(x) x' = -force with forward sensitivities, lags and gains.
 * Compiled once after symid/codegen/ode.h; the model is a table of generated functions.
 * Sensitivities S = dx/dq obey M S' = -(r_x S + r_late S_late + r_p); q = chosen parameters,
 * then chosen initial states. Runge-Kutta 4 carries its own dense output (Hairer, Norsett &
 * Wanner 1993, II.6) for the delayed signals. Stiff steps are those of ROS2 (Verwer, Spee, Blom & Hundsdorfer
 * 1999, eq. 1.3 and 1.4): of order 2 with any matrix, so that S may have the same one as x. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NX (v->m->nx)
#define NL (v->m->nl)
#define NU (v->m->nu)
#define NY (v->m->ny)
#define NXX NX
#define NON(n) ((n) > 0 ? (n) : 1)
#define EULER 1
#define STIFF 2
/* Decays together faster than this in a step are stiff: the explicit method follows 2.785. */
#define FAST 2.0
/* Of ROS2, 1 - 1/sqrt(2): what is infinitely stiff is gone after one step. */
#define GAMMA 0.29289321881345248
/* Where what decays changes more than this within a step the method of order 2 would overshoot. */
#define EVEN 0.5
/* At most so many has a step within which something stiff sets in. */
#define PIECES 64
/* Rows of sensitivities are padded with zeros to whole vectors of the processor, so that no loop has a remainder. */
#define WIDE 4
#define PADDED(n) (((n) + WIDE - 1) / WIDE * WIDE)

typedef struct {
    long N, substeps, method, nq, nqp, nqx, nh, npast;
    const double *t, *u, *w, *p, *c, *x0;
    const int *qp, *qx;             /* which parameters, which initial states */
    const double *gain, *recorded;  /* (1 + npast) x NX x NY corrections at the samples, or null: of the
                                       state now, and of what it was 1, 2 ... sample intervals ago */
    const double *ht, *hx;          /* given history before the start, or null */
    double limit;
    double *X, *Y, *SX, *SY;        /* results: N x NX, N x NY, N x NX x nq, N x NY x nq */
} Run;

typedef struct {
    Run r;
    const Ode *m;
    long steps, *hint, nq;              /* nq: sensitivities in a padded row */
    const int *column;                  /* of each parameter among the sensitivities, -1 where not asked for */
    double *when, *span, *poly, *spoly; /* stored steps: x0, k1, k2 + k3, k4 of states, then of S */
    double *lag, *dlag;                 /* NL, NL x nq */
    double tk, *ak, *sak;                /* rate of change of x' in the last step, and of S' */
    double *xk, *k1, *sk, *sk1; /* start of the present step */
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

/* b = M^-1 b, and M = P L U in its place, by partial pivoting; 1 where it is singular. */
static int factor(int n, double *restrict M, int *restrict pivot, double *restrict b)
{
    for (int k = 0; k < n; k++) {
        int piv = k;
        for (int i = k + 1; i < n; i++) if (fabs(M[i*n+k]) > fabs(M[piv*n+k])) piv = i;
        if (!(fabs(M[piv*n+k]) > 1e-300)) return 1;
        pivot[k] = piv;
        if (piv != k) { swap(M + k*n, M + piv*n, n); swap(b + k, b + piv, 1); }
        double inv = 1.0 / M[k*n+k];
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
        b[k] *= 1.0 / M[k*n+k];
    }
    return 0;
}

/* B = M^-1 B for n rows of B, padded, with the factors of M. */
static void solve(int n, const double *M, const int *pivot, double *B, long padded)
{
    for (int k = 0; k < n; k++) if (pivot[k] != k) swap(B + k*padded, B + pivot[k]*padded, padded);
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i < n; i++)
            if (M[i*n+k] != 0.0) add(-M[i*n+k], B + k*padded, B + i*padded, padded);
    for (int k = n - 1; k >= 0; k--) {
        for (int i = k + 1; i < n; i++)
            if (M[k*n+i] != 0.0) add(-M[k*n+i], B + i*padded, B + k*padded, padded);
        double inv = 1.0 / M[k*n+k], *row = B + k*padded;
        for (long j = 0; j < padded; j += WIDE) for (int l = 0; l < WIDE; l++) row[j+l] *= inv;
    }
}

/* Slope of input i at sample k of two or more: of the parabola through the three samples next to it (cubic Bessel
 * interpolation; de Boor 1978, chapter IV). */
static double slope_at(const Work *v, long k, int i)
{
    const Run *r = &v->r;
    if (r->N == 2) return (r->u[NU+i] - r->u[i]) / (r->t[1] - r->t[0]);
    long middle = k == 0 ? 1 : k == r->N - 1 ? k - 1 : k;
    const double *u = r->u + middle*NU + i, *t = r->t + middle;
    double before = (u[0] - u[-NU]) / (t[0] - t[-1]), after = (u[NU] - u[0]) / (t[1] - t[0]);
    double bend = (after - before) / (t[1] - t[-1]);
    return before + bend * (t[0] - t[-1] + 2 * (r->t[k] - t[0]));
}

/* All inputs at time s: linear or cubic between samples or held, constant beyond the ends. slope may be null.
 * k is the present interval: at its end a held input still has the value of its start. */
static void inputs_at(const Work *v, double s, long k, double *u, double *slope)
{
    const Run *r = &v->r;
    if (NU == 0) return;
    long present = k;
    if (k > r->N - 2) k = r->N - 2;
    if (k < 0) k = 0;
    while (k > 0 && s < r->t[k]) k--;
    while (k < r->N - 2 && s > r->t[k+1]) k++;
    double h = r->N > 1 ? r->t[k+1] - r->t[k] : 1.0, f = (s - r->t[k]) / h;
    int out = f < 0 || f > 1 || r->N < 2;
    if (f < 0 || r->N < 2) f = 0;
    if (f > 1) f = 1;
    const double *a = r->u + k*NU, *b = r->N > 1 ? a + NU : a;
    long held = present == k-1 && s - r->t[k] < 1e-9*h ? present : present > k && f == 1 ? r->N - 1 : k;
    for (int i = 0; i < NU; i++) {
        if (v->m->input_between[i] == 1) {
            u[i] = r->u[held*NU+i];
            if (slope) slope[i] = 0.0;
            continue;
        }
        u[i] = a[i] + f * (b[i] - a[i]);
        if (slope) slope[i] = out ? 0.0 : (b[i] - a[i]) / h;
        if (v->m->input_between[i] == 2 && !out) {
            /* Hermite's cubic: what its slopes at both samples differ from the straight line's. */
            double line = (b[i] - a[i]) / h, g = 1 - f;
            double first = slope_at(v, k, i) - line, last = slope_at(v, k + 1, i) - line;
            u[i] += h * f * g * (g * first - f * last);
            if (slope) slope[i] += g * (1 - 3*f) * first - f * (2 - 3*f) * last;
        }
    }
}

/* out += sign * (entries of a Jacobian) S, and the same for the chosen parameters themselves. */
static void chain(double sign, const Entries *e, const double *d, const double *S, double *out, long nq)
{
    for (int i = 0; i < e->count; i++) add(sign * d[i], S + e->col[i]*nq, out + e->row[i]*nq, nq);
}

static void direct(double sign, const Entries *e, const double *d, const Work *v, double *out)
{
    for (int i = 0; i < e->count; i++) {
        int m = v->column[e->col[i]];
        if (m >= 0) out[e->row[i]*v->nq+m] += sign * d[i];
    }
}

/* Value, rate and sensitivities of state i at time s, from history, stored steps or this step. */
static void state_at(Work *v, int j, int i, double s, double *value, double *rate, double *S)
{
    const Run *r = &v->r;
    long nq = v->nq;
    if (v->inside ? s >= v->tk : v->steps == 0 ? s >= r->t[0] : s > v->tk) {
        double d = s - v->tk;
        *value = v->xk[i] + d * v->k1[i] + 0.5 * d * d * v->ak[i];
        *rate = v->k1[i] + d * v->ak[i];
        for (long k = 0; k < nq; k++)
            S[k] = v->sk[i*nq+k] + d * v->sk1[i*nq+k] + 0.5 * d * d * v->sak[i*nq+k];
        return;
    }
    if (s <= r->t[0] || v->steps == 0) {
        *rate = 0;
        memset(S, 0, nq * sizeof(double));
        if (r->nh == 0) {
            *value = r->x0[i];
            for (long k = 0; k < r->nqx; k++) if (r->qx[k] == i) S[r->nqp+k] = 1;
            return;
        }
        long k = 0;
        while (k < r->nh - 2 && s > r->ht[k+1]) k++;
        if (r->nh < 2) { *value = r->hx[i]; return; }
        double h = r->ht[k+1] - r->ht[k], f = (s - r->ht[k]) / h;
        if (f < 0) f = 0;
        double a = r->hx[k*NX+i], b = r->hx[(k+1)*NX+i];
        *value = a + f * (b - a);
        *rate = f > 0 ? (b - a) / h : 0;
        return;
    }
    long k = v->hint[j];
    if (k >= v->steps) k = v->steps - 1;
    while (k > 0 && s < v->when[k]) k--;
    while (k < v->steps - 1 && s > v->when[k] + v->span[k]) k++;
    v->hint[j] = k;
    double h = v->span[k], q = (s - v->when[k]) / h, q2 = q*q, q3 = q2*q;
    double b1 = h * (q - 1.5*q2 + 2*q3/3), b2 = h * (q2 - 2*q3/3), b4 = h * (-0.5*q2 + 2*q3/3);
    const double *P = v->poly + k*4*NX;
    *value = P[i] + b1*P[NX+i] + b2*P[2*NX+i] + b4*P[3*NX+i];
    *rate = (1 - 3*q + 2*q2)*P[NX+i] + (2*q - 2*q2)*P[2*NX+i] + (-q + 2*q2)*P[3*NX+i];
    if (nq) {
        const double *Q = v->spoly + k*4*NX*nq + i*nq;
        for (long m = 0; m < nq; m++)
            S[m] = Q[m] + b1*Q[NX*nq+m] + b2*Q[2*NX*nq+m] + b4*Q[3*NX*nq+m];
    }
}

/* All late signals at time t, given the present x (used where a lag is zero). */
static void late_at(Work *v, double t, long k, const double *x, const double *S, double *l, double *lS)
{
    long nq = v->nq;
    for (int j = 0; j < NL; j++) {
        double rate = 0, u[NON(NU)], slope[NON(NU)];
        int i = v->m->late_index[j];
        double *row = lS + j*nq;
        if (v->m->late_kind[j]) {
            memset(row, 0, nq * sizeof(double));
            inputs_at(v, t - v->lag[j], k, u, slope);
            l[j] = u[i];
            rate = slope[i];
        } else if (v->lag[j] == 0) {
            l[j] = x[i];
            rate = v->k1[i];
            if (nq) memcpy(row, S + i*nq, nq * sizeof(double));
        } else {
            state_at(v, j, i, t - v->lag[j], &l[j], &rate, row);
        }
        add(-rate, v->dlag + j*nq, row, nq);
    }
}

/* Rates of x and S; and their derivative A by x, in padded rows, unless that is null. 1 where M is singular. */
static int rates(Work *v, double t, long k, const double *x, const double *S, double *xd, double *Sd, double *lS,
                 double *A)
{
    const Run *r = &v->r;
    long nq = v->nq;
    double u[NON(NU)], l[NON(NL)], M[NXX*NXX];
    const Ode *m = v->m;
    const double *w = r->w + k*m->nw;
    inputs_at(v, t, k, u, 0);
    late_at(v, t, k, x, S, l, lS);
    m->mass(xd, x, l, u, w, r->p, r->c, t, M, xd);
    int pivot[NXX];
    for (int i = 0; i < NX; i++) xd[i] = -xd[i];
    if (factor(NX, M, pivot, xd)) return 1;
    if (!nq && !A) return 0;
    double dx[NON(m->rx.count)], dl[NON(m->rl.count)], dp[NON(m->rp.count)], dw[NON(m->rw.count)];
    m->slopes(xd, x, l, u, w, r->p, r->c, t, dx, dl, dp, dw);
    if (A) {
        memset(A, 0, NX * PADDED(NX) * sizeof(double));
        for (int i = 0; i < m->rx.count; i++) A[m->rx.row[i]*PADDED(NX) + m->rx.col[i]] -= dx[i];
        solve(NX, M, pivot, A, PADDED(NX));
    }
    if (!nq) return 0;
    memset(Sd, 0, NX * nq * sizeof(double));
    chain(-1, &m->rx, dx, S, Sd, nq);
    chain(-1, &m->rl, dl, lS, Sd, nq);
    direct(-1, &m->rp, dp, v, Sd);
    solve(NX, M, pivot, Sd, nq);
    return 0;
}

static void observe_at(Work *v, double t, long k, const double *xd, const double *Sd, const double *x,
                       const double *S, double *y, double *Sy, double *lS)
{
    const Run *r = &v->r;
    long nq = v->nq;
    double u[NON(NU)], l[NON(NL)];
    const double *w = r->w + (k < r->N - 1 ? k : k > 0 ? k - 1 : 0)*v->m->nw;
    inputs_at(v, t, k, u, 0);
    late_at(v, t, k, x, S, l, lS);
    const Ode *m = v->m;
    m->observe(xd, x, l, u, w, r->p, r->c, t, y);
    if (!nq) return;
    double dx[NON(m->hx.count)], dl[NON(m->hl.count)], dp[NON(m->hp.count)], dr[NON(m->hxd.count)];
    m->observe_slopes(xd, x, l, u, w, r->p, r->c, t, dx, dl, dp, dr);
    memset(Sy, 0, NY * nq * sizeof(double));
    chain(1, &m->hx, dx, S, Sy, nq);
    chain(1, &m->hl, dl, lS, Sy, nq);
    chain(1, &m->hxd, dr, Sd, Sy, nq);
    direct(1, &m->hp, dp, v, Sy);
}

static int healthy(int n, const double *x, double limit)
{
    for (int i = 0; i < n; i++) if (!(fabs(x[i]) < limit)) return 0;
    return 1;
}

/* Correction of state i per unit of surprise o, `late` sample intervals before the sample. */
static double past_gain(const Work *v, double late, int i, int o)
{
    long j = (long)late, size = NX*NY;
    if (late < 0) return v->r.gain[i*NY+o];
    if (j >= v->r.npast) return 0;
    double f = late - j;
    return (1-f) * v->r.gain[j*size + i*NY+o] + f * v->r.gain[(j+1)*size + i*NY+o];
}

/* What a sample says about the past that delayed signals still read: a fixed-lag smoother
 * (Anderson & Moore 1979, 7.3) on the stored steps, linear within each. */
static void correct_past(Work *v, double now, double interval, const double *e, const double *Sy)
{
    long nq = v->nq, big = NX*nq;
    for (long n = v->steps - 1; n >= 0; n--) {
        double h = v->span[n], a = (now - v->when[n]) / interval, b = a - h / interval;
        if (b >= v->r.npast) break;
        double *P = v->poly + n*4*NX, *Q = v->spoly + n*4*big;
        for (int i = 0; i < NX; i++)
            for (int o = 0; o < NY; o++) {
                double start = past_gain(v, a, i, o), slope = (past_gain(v, b, i, o) - start) / h;
                double part[4] = {start, slope, 2*slope, slope};
                for (int k = 0; k < 4; k++) {
                    P[k*NX+i] += part[k] * e[o];
                    add(-part[k], Sy + o*nq, Q + k*big + i*nq, nq);
                }
            }
    }
}

/* What decays, less what grows, in a second: the trace of A has the sum of all eigenvalues, in whatever units. */
static double decay(int n, const double *A)
{
    double trace = 0;
    for (int i = 0; i < n; i++) trace += A[i*PADDED(n)+i];
    return -trace;
}

/* A straight step at the first rates. */
static int euler_step(Work *v, double h)
{
    long big = NX * v->nq;
    const double *k1 = v->rate[0], *K1 = v->Rate[0];
    memcpy(v->rate[3], k1, NX * sizeof(double)); memcpy(v->Rate[3], K1, big * sizeof(double));
    for (int i = 0; i < NX; i++) { v->rate[1][i] = 2*k1[i]; v->x[i] += h*k1[i]; }
    for (long i = 0; i < big; i++) { v->Rate[1][i] = 2*K1[i]; v->S[i] += h*K1[i]; }
    return 0;
}

/* One step of ROS2 from x and S, whose rates are known. Its stages become those of a straight line to its end. */
static int implicit_step(Work *v, double t, double h, long k)
{
    long nq = v->nq, big = NX*nq;
    double W[NXX*NXX], d[NXX*WIDE], A[NXX*PADDED(NX)], *k1 = v->rate[0], *k2 = v->rate[1], *g = v->rate[2];
    double *K1 = v->Rate[0], *K2 = v->Rate[1], *G = v->Rate[2];
    int pivot[NXX];
    memset(d, 0, sizeof(d));
    for (int i = 0; i < NX; i++)
        for (int j = 0; j < NX; j++) W[i*NX+j] = (i == j) - GAMMA * h * v->A[i*PADDED(NX)+j];
    /* What the rates change by where all but x goes on, and all but S: else the answer to an input would be late. */
    if (rates(v, t + h, k, v->x, v->S, g, G, v->lS, 0)) return 1;
    for (int i = 0; i < NX; i++) { g[i] = GAMMA * (g[i] - k1[i]); k1[i] += g[i]; }
    if (factor(NX, W, pivot, k1)) return 1;
    for (int i = 0; i < NX; i++) v->xs[i] = v->x[i] + h*k1[i];
    if (nq && rates(v, t + h, k, v->xs, v->S, k2, G, v->lS, 0)) return 1;
    for (long i = 0; i < big; i++) { G[i] = GAMMA * (G[i] - K1[i]); K1[i] += G[i]; }
    solve(NX, W, pivot, K1, nq);
    for (long i = 0; i < big; i++) v->Sx[i] = v->S[i] + h*K1[i];
    if (rates(v, t + h, k, v->xs, v->Sx, k2, K2, v->lS, A)) return 1;
    double before = decay(NX, v->A), after = decay(NX, A);
    if (!(after > EVEN * before && before > EVEN * after)) return euler_step(v, h);
    for (int i = 0; i < NX; i++) d[i*WIDE] = k2[i] - 2*k1[i] - g[i];
    for (long i = 0; i < big; i++) K2[i] -= 2*K1[i] + G[i];
    solve(NX, W, pivot, d, WIDE);
    solve(NX, W, pivot, K2, nq);
    for (int i = 0; i < NX; i++) k1[i] = 1.5*k1[i] + 0.5*d[i*WIDE];
    for (long i = 0; i < big; i++) K1[i] = 1.5*K1[i] + 0.5*K2[i];
    return euler_step(v, h);
}

/* One step of Runge-Kutta 4 likewise. Where `fast` is asked for it is the decay in the stiffest stage, and A that of
 * its rates. */
static int explicit_step(Work *v, double t, double h, long k, double *fast)
{
    long big = NX * v->nq;
    double A[NXX*PADDED(NX)];
    const double part[3] = {0.5, 0.5, 1.0};
    for (int s = 0; s < 3; s++) {
        const double *d = v->rate[s], *D = v->Rate[s], a = part[s] * h;
        for (int i = 0; i < NX; i++) v->xs[i] = v->x[i] + a*d[i];
        for (long i = 0; i < big; i++) v->Sx[i] = v->S[i] + a*D[i];
        if (rates(v, t + a, k, v->xs, v->Sx, v->rate[s+1], v->Rate[s+1], v->lS, fast ? A : 0)) return 1;
        if (fast && decay(NX, A) > *fast) {
            *fast = decay(NX, A);
            memcpy(v->A, A, sizeof(A));
        }
    }
    double *k1 = v->rate[0], *k2 = v->rate[1], *k3 = v->rate[2], *k4 = v->rate[3];
    double *K1 = v->Rate[0], *K2 = v->Rate[1], *K3 = v->Rate[2], *K4 = v->Rate[3];
    for (int i = 0; i < NX; i++) { k2[i] += k3[i]; v->x[i] += h/6 * (k1[i] + 2*k2[i] + k4[i]); }
    for (long i = 0; i < big; i++) { K2[i] += K3[i]; v->S[i] += h/6 * (K1[i] + 2*K2[i] + K4[i]); }
    return 0;
}

/* One step from x and S, and its stages; 1 where a mass matrix is singular. */
static int step(Work *v, double t, double h, long k, int whole)
{
    long big = NX * v->nq;
    int stiff = v->r.method == STIFF;
    v->inside = 0;
    v->tk = t;
    memcpy(v->xk, v->x, NX * sizeof(double)); memcpy(v->sk, v->S, big * sizeof(double));
    if (rates(v, t, k, v->x, v->S, v->rate[0], v->Rate[0], v->lS, stiff ? v->A : 0)) return 1;
    memcpy(v->k1, v->rate[0], NX * sizeof(double)); memcpy(v->sk1, v->Rate[0], big * sizeof(double));
    v->inside = 1;
    if (v->r.method == EULER) return euler_step(v, h);
    if (stiff && decay(NX, v->A) * h > FAST) return implicit_step(v, t, h, k);
    double fast = 0;
    if (explicit_step(v, t, h, k, stiff ? &fast : 0)) return 1;
    if (fast * h <= FAST) return 0;
    /* Something sets in within the step, as dry friction does where it comes to stick. */
    memcpy(v->x, v->xk, NX * sizeof(double)); memcpy(v->S, v->sk, big * sizeof(double));
    if (!whole) return implicit_step(v, t, h, k);
    long pieces = (long)fmin(ceil(fast * h / FAST), PIECES);
    for (long i = 0; i < pieces; i++) if (step(v, t + i * h / pieces, h / pieces, k, 0)) return 1;
    return 0;
}

/* Rows of sensitivities without their padding. */
static void shown(double *out, const double *S, long rows, long nq, long padded)
{
    for (long i = 0; i < rows; i++) memcpy(out + i*nq, S + i*padded, nq * sizeof(double));
}

/* Returns the number of samples that were reached before the run left `limit`. */
long simulate(const Ode *model, const Run *given)
{
    Work work, *v = &work;
    memset(v, 0, sizeof(work));
    v->r = *given;
    v->m = model;
    const Run *r = &v->r;
    v->nq = PADDED(r->nq);
    long nq = v->nq, big = NX * nq, m = r->substeps, keep = NL > 0;
    int column[NON(model->np)];
    for (int i = 0; i < model->np; i++) column[i] = -1;
    for (long k = 0; k < r->nqp; k++) column[r->qp[k]] = (int)k;
    v->column = column;
    long nsteps = keep ? (r->N - 1) * m + 1 : 0;
    double *space = calloc(9 * big + 2 * NON(NL) * nq + NON(NY) * nq + 64, sizeof(double));
    double x[NXX], xs[NXX], rate[4*NXX], y[NON(NY)], xk[NXX], first[NXX], ak[NXX], lag[NON(NL)], A[NXX*PADDED(NX)];
    long hint[NON(NL)];
    memset(ak, 0, NX * sizeof(double)); memset(first, 0, NX * sizeof(double)); memset(hint, 0, NON(NL) * sizeof(long));
    memset(rate, 0, NX * sizeof(double));
    v->xk = xk; v->k1 = first; v->ak = ak; v->lag = lag; v->hint = hint; v->x = x; v->xs = xs; v->A = A;
    double *S = v->S = space, *room = S + big;
    v->Sx = room; room += big;
    for (int s = 0; s < 4; s++) { v->rate[s] = rate + s*NX; v->Rate[s] = room; room += big; }
    v->sk = room; v->sk1 = room + big; v->sak = room + 2*big; v->dlag = room + 3*big;
    double *lS = v->lS = v->dlag + NON(NL)*nq, *Sy = lS + NON(NL)*nq;
    double *k1 = v->rate[0], *k2 = v->rate[1], *k4 = v->rate[3], *K1 = v->Rate[0], *K2 = v->Rate[1], *K4 = v->Rate[3];
    if (keep) {
        v->when = malloc(2 * nsteps * sizeof(double));
        v->span = v->when + nsteps;
        v->poly = malloc(nsteps * 4 * NXX * (1 + nq) * sizeof(double));
        v->spoly = v->poly + nsteps * 4 * NXX;
    }
    long done = 0;
    if (!space || (keep && (!v->when || !v->poly))) { done = -1; goto end; }
    memcpy(x, r->x0, NX * sizeof(double));
    for (long k = 0; k < r->nqx; k++) S[r->qx[k]*nq + r->nqp + k] = 1;
    v->m->lags(x, x, x, x, x, r->p, r->c, 0, v->lag);
    if (NL && nq) {
        double dp[NON(v->m->lp.count)];
        v->m->lag_slopes(x, x, x, x, x, r->p, r->c, 0, dp);
        direct(1, &v->m->lp, dp, v, v->dlag);
    }
    memcpy(v->xk, x, NX * sizeof(double)); memcpy(v->sk, S, big * sizeof(double));
    v->tk = r->t[0];
    for (long k = 0; k < r->N; k++) {
        long interval = k < r->N - 1 ? k : k > 0 ? k - 1 : 0;
        if (!healthy(NX, x, r->limit)) break;
        if (v->m->outputs_need_rates) {
            v->inside = 0;
            if (rates(v, r->t[k], interval, x, S, k1, K1, lS, 0)) break;
        }
        observe_at(v, r->t[k], k, k1, K1, x, S, y, Sy, lS);
        if (r->X) memcpy(r->X + k*NX, x, NX * sizeof(double));
        if (r->Y) memcpy(r->Y + k*NY, y, NY * sizeof(double));
        if (nq && r->SX) shown(r->SX + k*NX*r->nq, S, NX, r->nq, nq);
        if (nq && r->SY) shown(r->SY + k*NY*r->nq, Sy, NY, r->nq, nq);
        done = k + 1;
        if (k == r->N - 1) break;
        if (r->gain) {
            double e[NON(NY)];
            for (int j = 0; j < NY; j++) {
                e[j] = r->recorded[k*NY+j] - y[j];
                if (isnan(e[j])) { e[j] = 0; memset(Sy + j*nq, 0, nq * sizeof(double)); }
                for (int i = 0; i < NX; i++) {
                    x[i] += r->gain[i*NY+j] * e[j];
                    add(-r->gain[i*NY+j], Sy + j*nq, S + i*nq, nq);
                }
            }
            if (keep && r->npast) correct_past(v, r->t[k], r->t[k+1] - r->t[k], e, Sy);
        }
        double h = (r->t[k+1] - r->t[k]) / m;
        for (long s = 0; s < m; s++) {
            double t = r->t[k] + s * h;
            if (step(v, t, h, k, !keep)) goto end;
            if (keep) {
                long n = v->steps;
                double *P = v->poly + n*4*NX, *Q = v->spoly + n*4*big;
                v->when[n] = t; v->span[n] = h;
                memcpy(P, v->xk, NX*sizeof(double)); memcpy(P+NX, k1, NX*sizeof(double));
                memcpy(P+2*NX, k2, NX*sizeof(double)); memcpy(P+3*NX, k4, NX*sizeof(double));
                memcpy(Q, v->sk, big*sizeof(double)); memcpy(Q+big, K1, big*sizeof(double));
                memcpy(Q+2*big, K2, big*sizeof(double)); memcpy(Q+3*big, K4, big*sizeof(double));
                for (int i = 0; i < NX; i++) v->ak[i] = (k4[i] - k1[i]) / h;
                for (long i = 0; i < big; i++) v->sak[i] = (K4[i] - K1[i]) / h;
                v->steps = n + 1;
                v->tk = t + h;
                v->inside = 0;
            }
        }
    }
end:
    if (keep) { free(v->when); free(v->poly); }
    free(space);
    return done;
}

static void spread(const Entries *e, const double *d, int columns, double *out)
{
    for (int i = 0; i < e->count; i++) out[e->row[i]*columns + e->col[i]] = d[i];
}

/* Derivatives of the residuals and outputs at one point, dense and row-major, for linearisation. */
void linearise(const Ode *m, const double *xd, const double *x, const double *l, const double *u, const double *w,
               const double *p, const double *c, double t, double *M, double *Rx, double *Rl, double *Rw,
               double *Hx, double *Hl, double *lag)
{
    double force[m->nx], dx[NON(m->rx.count)], dl[NON(m->rl.count)], dp[NON(m->rp.count)], dw[NON(m->rw.count)];
    double ox[NON(m->hx.count)], ol[NON(m->hl.count)], op[NON(m->hp.count)], od[NON(m->hxd.count)];
    m->mass(xd, x, l, u, w, p, c, t, M, force);
    m->slopes(xd, x, l, u, w, p, c, t, dx, dl, dp, dw);
    m->observe_slopes(xd, x, l, u, w, p, c, t, ox, ol, op, od);
    m->lags(xd, x, l, u, w, p, c, t, lag);
    spread(&m->rx, dx, m->nx, Rx);
    spread(&m->rl, dl, m->nl, Rl);
    spread(&m->rw, dw, m->nw, Rw);
    spread(&m->hx, ox, m->nx, Hx);
    spread(&m->hl, ol, m->nl, Hl);
}
