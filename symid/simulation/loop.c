/* Explicit fixed-step integration of M(x) x' = -r0 with forward sensitivities, lags and gains.
 * The text before this one (symid/codegen/ode.py) gives the sizes and the model's functions.
 * Sensitivities S = dx/dq obey M S' = -(r_x S + r_late S_late + r_p); q = chosen parameters,
 * then chosen initial states. Runge-Kutta 4 carries its own dense output (Hairer, Norsett &
 * Wanner 1993, II.6) for the delayed signals. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NXX (NX > 0 ? NX : 1)
#define NON(n) ((n) > 0 ? (n) : 1)

typedef struct {
    long N, substeps, method, nq, nqp, nqx, nh;
    const double *t, *u, *w, *p, *c, *x0;
    const int *qp, *qx;             /* which parameters, which initial states */
    const double *gain, *recorded;  /* NX x NY correction at the samples, or null */
    const double *ht, *hx;          /* given history before the start, or null */
    double limit;
    double *X, *Y, *SX, *SY;        /* results: N x NX, N x NY, N x NX x nq, N x NY x nq */
} Run;

typedef struct {
    Run r;
    long steps, hint[NON(NL)];
    double *when, *span, *poly, *spoly; /* stored steps: x0, k1, k2 + k3, k4 of states, then of S */
    double lag[NON(NL)], *dlag;         /* NL x nq */
    double tk, ak[NXX], *sak;           /* rate of change of x' in the last step, and of S' */
    double xk[NXX], k1[NXX], *sk, *sk1; /* start of the present step */
    int inside;                         /* k1 of the present step is known */
} Work;

static int solve(double *M, double *B, long nb)
{
    for (int k = 0; k < NX; k++) {
        int piv = k;
        for (int i = k + 1; i < NX; i++) if (fabs(M[i*NX+k]) > fabs(M[piv*NX+k])) piv = i;
        if (!(fabs(M[piv*NX+k]) > 1e-300)) return 1;
        if (piv != k) {
            for (int j = 0; j < NX; j++) { double s = M[k*NX+j]; M[k*NX+j] = M[piv*NX+j]; M[piv*NX+j] = s; }
            for (long j = 0; j < nb; j++) { double s = B[k*nb+j]; B[k*nb+j] = B[piv*nb+j]; B[piv*nb+j] = s; }
        }
        double inv = 1.0 / M[k*NX+k];
        for (int i = k + 1; i < NX; i++) {
            double f = M[i*NX+k] * inv;
            if (f == 0.0) continue;
            for (int j = k + 1; j < NX; j++) M[i*NX+j] -= f * M[k*NX+j];
            for (long j = 0; j < nb; j++) B[i*nb+j] -= f * B[k*nb+j];
        }
    }
    for (int k = NX - 1; k >= 0; k--) {
        for (int i = k + 1; i < NX; i++) {
            double f = M[k*NX+i];
            if (f == 0.0) continue;
            for (long j = 0; j < nb; j++) B[k*nb+j] -= f * B[i*nb+j];
        }
        double inv = 1.0 / M[k*NX+k];
        for (long j = 0; j < nb; j++) B[k*nb+j] *= inv;
    }
    return 0;
}

static void add(double a, const double *x, double *y, long n) { for (long k = 0; k < n; k++) y[k] += a * x[k]; }

/* All inputs at time s: linear between samples, constant beyond the ends. slope may be null. */
static void inputs_at(const Run *r, double s, long k, double *u, double *slope)
{
    if (NU == 0) return;
    if (k > r->N - 2) k = r->N - 2;
    if (k < 0) k = 0;
    while (k > 0 && s < r->t[k]) k--;
    while (k < r->N - 2 && s > r->t[k+1]) k++;
    double h = r->N > 1 ? r->t[k+1] - r->t[k] : 1.0, f = (s - r->t[k]) / h;
    int out = f < 0 || f > 1 || r->N < 2;
    if (f < 0 || r->N < 2) f = 0;
    if (f > 1) f = 1;
    const double *a = r->u + k*NU, *b = r->N > 1 ? a + NU : a;
    for (int i = 0; i < NU; i++) {
        u[i] = a[i] + f * (b[i] - a[i]);
        if (slope) slope[i] = out ? 0.0 : (b[i] - a[i]) / h;
    }
}

/* Value, rate and sensitivities of state i at time s, from history, stored steps or this step. */
static void state_at(Work *v, int j, int i, double s, double *value, double *rate, double *S)
{
    const Run *r = &v->r;
    long nq = r->nq;
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
    long nq = v->r.nq;
    for (int j = 0; j < NL; j++) {
        double rate = 0, u[NON(NU)], slope[NON(NU)];
        int i = late_index[j];
        double *row = lS + j*nq;
        if (late_kind[j]) {
            memset(row, 0, nq * sizeof(double));
            inputs_at(&v->r, t - v->lag[j], k, u, slope);
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

static int rates(Work *v, double t, long k, const double *x, const double *S, double *xd, double *Sd, double *lS)
{
    const Run *r = &v->r;
    long nq = r->nq;
    double u[NON(NU)], l[NON(NL)], M[NXX*NXX];
    const double *w = r->w + k*NW;
    inputs_at(r, t, k, u, 0);
    late_at(v, t, k, x, S, l, lS);
    mass(xd, x, l, u, w, r->p, r->c, t, M, xd);
    double Mc[NXX*NXX];
    if (nq) memcpy(Mc, M, sizeof(M));
    for (int i = 0; i < NX; i++) xd[i] = -xd[i];
    if (solve(M, xd, 1)) return 1;
    if (!nq) return 0;
    double dx[NON(SLOPES_X)], dl[NON(SLOPES_L)], dp[NON(SLOPES_P)], dw[NON(SLOPES_W)];
    slopes(xd, x, l, u, w, r->p, r->c, t, dx, dl, dp, dw);
    memset(Sd, 0, NX * nq * sizeof(double));
    for (int e = 0; e < SLOPES_X; e++) add(-dx[e], S + slopes_x_col[e]*nq, Sd + slopes_x_row[e]*nq, nq);
    for (int e = 0; e < SLOPES_L; e++) add(-dl[e], lS + slopes_l_col[e]*nq, Sd + slopes_l_row[e]*nq, nq);
    for (long m = 0; m < r->nqp; m++)
        for (int e = 0; e < SLOPES_P; e++) if (slopes_p_col[e] == r->qp[m]) Sd[slopes_p_row[e]*nq+m] -= dp[e];
    return solve(Mc, Sd, nq);
}

static void observe_at(Work *v, double t, long k, const double *xd, const double *Sd, const double *x,
                       const double *S, double *y, double *Sy, double *lS)
{
    const Run *r = &v->r;
    long nq = r->nq;
    double u[NON(NU)], l[NON(NL)];
    const double *w = r->w + (k < r->N - 1 ? k : k > 0 ? k - 1 : 0)*NW;
    inputs_at(r, t, k, u, 0);
    late_at(v, t, k, x, S, l, lS);
    observe(xd, x, l, u, w, r->p, r->c, t, y);
    if (!nq) return;
    double dx[NON(OBSERVE_SLOPES_X)], dl[NON(OBSERVE_SLOPES_L)], dp[NON(OBSERVE_SLOPES_P)], dr[NON(OBSERVE_SLOPES_XD)];
    observe_slopes(xd, x, l, u, w, r->p, r->c, t, dx, dl, dp, dr);
    memset(Sy, 0, NY * nq * sizeof(double));
    for (int e = 0; e < OBSERVE_SLOPES_X; e++) add(dx[e], S + observe_slopes_x_col[e]*nq, Sy + observe_slopes_x_row[e]*nq, nq);
    for (int e = 0; e < OBSERVE_SLOPES_L; e++) add(dl[e], lS + observe_slopes_l_col[e]*nq, Sy + observe_slopes_l_row[e]*nq, nq);
    for (int e = 0; e < OBSERVE_SLOPES_XD; e++) add(dr[e], Sd + observe_slopes_xd_col[e]*nq, Sy + observe_slopes_xd_row[e]*nq, nq);
    for (long m = 0; m < r->nqp; m++)
        for (int e = 0; e < OBSERVE_SLOPES_P; e++)
            if (observe_slopes_p_col[e] == r->qp[m]) Sy[observe_slopes_p_row[e]*nq+m] += dp[e];
}

static int healthy(const double *x, double limit)
{
    for (int i = 0; i < NX; i++) if (!(fabs(x[i]) < limit)) return 0;
    return 1;
}

/* Returns the number of samples that were reached before the run left `limit`. */
long simulate(const Run *given)
{
    Work work, *v = &work;
    memset(v, 0, sizeof(work));
    v->r = *given;
    const Run *r = &v->r;
    long nq = r->nq, big = NXX * nq, m = r->substeps, keep = NL > 0;
    long nsteps = keep ? (r->N - 1) * m + 1 : 0;
    double *space = calloc(14 * big + 2 * NON(NL) * nq + NON(NY) * nq + 64, sizeof(double));
    double *S = space, *Sx = S + big, *K1 = Sx + big, *K2 = K1 + big, *K3 = K2 + big, *K4 = K3 + big;
    double *lS, x[NXX], xs[NXX], k1[NXX], k2[NXX], k3[NXX], k4[NXX], y[NON(NY)], *Sy;
    v->sk = K4 + big; v->sk1 = v->sk + big; v->sak = v->sk1 + big;
    v->dlag = v->sak + big; lS = v->dlag + NON(NL)*nq; Sy = lS + NON(NL)*nq;
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
    lags(x, x, x, x, x, r->p, r->c, 0, v->lag);
    if (NL && nq) {
        double dp[NON(LAG_SLOPES_P)];
        lag_slopes(x, x, x, x, x, r->p, r->c, 0, dp);
        for (long q = 0; q < r->nqp; q++)
            for (int e = 0; e < LAG_SLOPES_P; e++)
                if (lag_slopes_p_col[e] == r->qp[q]) v->dlag[lag_slopes_p_row[e]*nq+q] = dp[e];
    }
    memcpy(v->xk, x, sizeof(x)); memcpy(v->sk, S, big * sizeof(double));
    v->tk = r->t[0];
    for (long k = 0; k < r->N; k++) {
        long interval = k < r->N - 1 ? k : k > 0 ? k - 1 : 0;
        if (!healthy(x, r->limit)) break;
        if (OUTPUTS_NEED_RATES) {
            v->inside = 0;
            if (rates(v, r->t[k], interval, x, S, k1, K1, lS)) break;
        }
        observe_at(v, r->t[k], k, k1, K1, x, S, y, Sy, lS);
        if (r->X) memcpy(r->X + k*NX, x, NX * sizeof(double));
        if (r->Y) memcpy(r->Y + k*NY, y, NY * sizeof(double));
        if (nq && r->SX) memcpy(r->SX + k*big, S, big * sizeof(double));
        if (nq && r->SY) memcpy(r->SY + k*NY*nq, Sy, NY * nq * sizeof(double));
        done = k + 1;
        if (k == r->N - 1) break;
        if (r->gain)
            for (int j = 0; j < NY; j++) {
                double e = r->recorded[k*NY+j] - y[j];
                if (isnan(e)) continue;
                for (int i = 0; i < NX; i++) {
                    x[i] += r->gain[i*NY+j] * e;
                    add(-r->gain[i*NY+j], Sy + j*nq, S + i*nq, nq);
                }
            }
        double h = (r->t[k+1] - r->t[k]) / m;
        for (long s = 0; s < m; s++) {
            double t = r->t[k] + s * h;
            v->inside = 0;
            v->tk = t;
            memcpy(v->xk, x, sizeof(x)); memcpy(v->sk, S, big * sizeof(double));
            if (rates(v, t, k, x, S, k1, K1, lS)) goto end;
            memcpy(v->k1, k1, sizeof(k1)); memcpy(v->sk1, K1, big * sizeof(double));
            v->inside = 1;
            if (r->method) {
                memcpy(k4, k1, sizeof(k1)); memcpy(K4, K1, big * sizeof(double));
                for (int i = 0; i < NX; i++) { k2[i] = 2*k1[i]; x[i] += h*k1[i]; }
                for (long i = 0; i < big; i++) { K2[i] = 2*K1[i]; S[i] += h*K1[i]; }
            } else {
                for (int i = 0; i < NX; i++) xs[i] = x[i] + 0.5*h*k1[i];
                for (long i = 0; i < big; i++) Sx[i] = S[i] + 0.5*h*K1[i];
                if (rates(v, t + 0.5*h, k, xs, Sx, k2, K2, lS)) goto end;
                for (int i = 0; i < NX; i++) xs[i] = x[i] + 0.5*h*k2[i];
                for (long i = 0; i < big; i++) Sx[i] = S[i] + 0.5*h*K2[i];
                if (rates(v, t + 0.5*h, k, xs, Sx, k3, K3, lS)) goto end;
                for (int i = 0; i < NX; i++) { xs[i] = x[i] + h*k3[i]; k2[i] += k3[i]; }
                for (long i = 0; i < big; i++) { Sx[i] = S[i] + h*K3[i]; K2[i] += K3[i]; }
                if (rates(v, t + h, k, xs, Sx, k4, K4, lS)) goto end;
                for (int i = 0; i < NX; i++) x[i] += h/6 * (k1[i] + 2*k2[i] + k4[i]);
                for (long i = 0; i < big; i++) S[i] += h/6 * (K1[i] + 2*K2[i] + K4[i]);
            }
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

/* Derivatives of the residuals and outputs at one point, dense and row-major, for linearisation. */
void linearise(const double *xd, const double *x, const double *l, const double *u, const double *w,
               const double *p, const double *c, double t, double *M, double *Rx, double *Rl, double *Rw,
               double *Hx, double *Hl, double *lag)
{
    double r0[NXX], dx[NON(SLOPES_X)], dl[NON(SLOPES_L)], dp[NON(SLOPES_P)], dw[NON(SLOPES_W)];
    mass(xd, x, l, u, w, p, c, t, M, r0);
    slopes(xd, x, l, u, w, p, c, t, dx, dl, dp, dw);
    for (int e = 0; e < SLOPES_X; e++) Rx[slopes_x_row[e]*NX + slopes_x_col[e]] = dx[e];
    for (int e = 0; e < SLOPES_L; e++) Rl[slopes_l_row[e]*NL + slopes_l_col[e]] = dl[e];
    for (int e = 0; e < SLOPES_W; e++) Rw[slopes_w_row[e]*NW + slopes_w_col[e]] = dw[e];
    double ox[NON(OBSERVE_SLOPES_X)], ol[NON(OBSERVE_SLOPES_L)], op[NON(OBSERVE_SLOPES_P)], od[NON(OBSERVE_SLOPES_XD)];
    observe_slopes(xd, x, l, u, w, p, c, t, ox, ol, op, od);
    for (int e = 0; e < OBSERVE_SLOPES_X; e++) Hx[observe_slopes_x_row[e]*NX + observe_slopes_x_col[e]] = ox[e];
    for (int e = 0; e < OBSERVE_SLOPES_L; e++) Hl[observe_slopes_l_row[e]*NL + observe_slopes_l_col[e]] = ol[e];
    lags(xd, x, l, u, w, p, c, t, lag);
}
