/* Fixed-step integration of M(x) x' = -force with forward sensitivities, lags and gains.
 * Compiled once after symid/codegen/ode.h, run.h, rates.c and steps.c; the model is a table of generated functions. */

const long padded_to = WIDE;

/* Rows of sensitivities without their padding. */
static void shown(double *out, const double *S, long rows, long nq, long padded)
{
    for (long i = 0; i < rows; i++) memcpy(out + i*nq, S + i*padded, nq * sizeof(double));
}

/* Returns the number of samples that were reached before the run left `limit`. */
long simulate(const Ode *model, Run *given)
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
    double *space = calloc(9 * big + 2 * NON(NL) * nq + NON(NY) * nq + 64, sizeof(double));
    if (!space) return -1;
    double x[NXX], xs[NXX], rate[4*NXX], y[NON(NY)], xk[NXX], first[NXX], ak[NXX], lag[NON(NL)], A[NXX*PADDED(NX)], size[NXX], err[2*NXX];
    long hint[NON(NL)];
    memset(ak, 0, NX * sizeof(double)); memset(first, 0, NX * sizeof(double)); memset(hint, 0, NON(NL) * sizeof(long));
    memset(rate, 0, NX * sizeof(double)); memset(size, 0, NX * sizeof(double)); memset(err, 0, 2*NX * sizeof(double));
    v->xk = xk; v->k1 = first; v->ak = ak; v->lag = lag; v->hint = hint; v->x = x; v->xs = xs; v->A = A; v->size = size; v->err = err;
    double *S = v->S = space, *room = S + big;
    v->Sx = room; room += big;
    for (int s = 0; s < 4; s++) { v->rate[s] = rate + s*NX; v->Rate[s] = room; room += big; }
    v->sk = room; v->sk1 = room + big; v->sak = room + 2*big; v->dlag = room + 3*big;
    double *lS = v->lS = v->dlag + NON(NL)*nq, *Sy = lS + NON(NL)*nq;
    double *k1 = v->rate[0], *k2 = v->rate[1], *k4 = v->rate[3], *K1 = v->Rate[0], *K2 = v->Rate[1], *K4 = v->Rate[3];
    long done = 0;
    memcpy(x, r->x0, NX * sizeof(double));
    for (long k = 0; k < r->nqx; k++) S[r->qx[k]*nq + r->nqp + k] = 1;
    v->m->lags(x, x, x, x, x, r->p, r->c, 0, v->lag);
    if (NL && nq) {
        double dp[NON(v->m->lp.count)];
        v->m->lag_slopes(x, x, x, x, x, r->p, r->c, 0, dp);
        direct(1, &v->m->lp, dp, v, v->dlag);
    }
    if (keep) {
        long n = v->kept = steps_kept(v);
        v->when = malloc(2 * n * sizeof(double));
        v->span = v->when + n;
        v->poly = malloc(n * 4 * NXX * (1 + nq) * sizeof(double));
        v->spoly = v->poly + n * 4 * NXX;
        v->told = malloc((r->npast + 1) * NXX * (1 + nq) * sizeof(double));
        if (!v->when || !v->poly || !v->told) { done = -1; goto end; }
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
            int known = 0;
            for (int j = 0; j < NY; j++) {
                e[j] = r->recorded[k*NY+j] - y[j];
                if (isnan(e[j])) { e[j] = 0; memset(Sy + j*nq, 0, nq * sizeof(double)); continue; }
                known = 1;
                for (int i = 0; i < NX; i++) {
                    x[i] += r->gain[i*NY+j] * e[j];
                    add(-r->gain[i*NY+j], Sy + j*nq, S + i*nq, nq);
                    if (r->dgain) add(e[j], r->dgain + (i*NY+j)*nq, S + i*nq, nq);
                }
            }
            if (keep && r->npast && known) correct_past(v, r->t[k], r->t[k+1] - r->t[k], e, Sy);
        }
        double h = (r->t[k+1] - r->t[k]) / m;
        for (long s = 0; s < m; s++) {
            double t = r->t[k] + s * h;
            v->begun++;
            if (step(v, t, h, k, keep ? 0 : HALVINGS, 0)) goto end;
            v->hk = 0;
            if (keep) {
                long n = v->steps;
                double *P = v->poly + n % v->kept * 4*NX, *Q = v->spoly + n % v->kept * 4*big;
                v->when[n % v->kept] = t; v->span[n % v->kept] = h;
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
    given->stiff = v->stiff;
    if (keep) { free(v->when); free(v->poly); free(v->told); }
    free(space);
    return done;
}

static void gather(double part, const Entries *e, const double *d, int columns, double *out)
{
    for (int i = 0; i < e->count; i++) out[e->row[i]*columns + e->col[i]] += part * d[i];
}

/* Means over so many points x, l of the mass matrix and of the derivatives of the residuals and outputs, dense and
 * row-major, for linearisation, added to what is there. */
void linearise(const Ode *m, long points, const double *xd, const double *x, const double *l, const double *u,
               const double *w, const double *p, const double *c, double *M, double *Rx, double *Rl, double *Rw,
               double *Hx, double *Hl, double *lag)
{
    double mass[m->nx*m->nx], force[m->nx], late[NON(m->nl)], part = 1.0 / points;
    double dx[NON(m->rx.count)], dl[NON(m->rl.count)], dp[NON(m->rp.count)], dw[NON(m->rw.count)];
    double shared[NON(m->nshared)];
    double ox[NON(m->hx.count)], ol[NON(m->hl.count)], op[NON(m->hp.count)], od[NON(m->hxd.count)];
    for (long k = 0; k < points; k++, x += m->nx, l += m->nl) {
        m->mass(xd, x, l, u, w, p, c, 0.0, mass, force, shared);
        m->slopes(xd, x, l, u, w, p, c, 0.0, dx, dl, dp, dw, shared);
        m->observe_slopes(xd, x, l, u, w, p, c, 0.0, ox, ol, op, od);
        m->lags(xd, x, l, u, w, p, c, 0.0, late);
        for (int i = 0; i < m->nx*m->nx; i++) M[i] += part * mass[i];
        for (int i = 0; i < m->nl; i++) lag[i] += part * late[i];
        gather(part, &m->rx, dx, m->nx, Rx);
        gather(part, &m->rl, dl, m->nl, Rl);
        gather(part, &m->rw, dw, m->nw, Rw);
        gather(part, &m->hx, ox, m->nx, Hx);
        gather(part, &m->hl, ol, m->nl, Hl);
    }
}
