/* Inputs, late signals, rates and outputs at one time of a run, with forward sensitivities S = dx/dq, which obey
 * M S' = -(r_x S + r_late S_late + r_p); q = chosen parameters, then chosen initial states. */

/* All inputs at time s: linear or curved between samples or held, constant beyond the ends. slope may be null.
 * k is the present interval: at its end a held input still has the value of its start. */
static void inputs_at(const Work *v, double s, long k, double *u, double *slope)
{
    const Run *r = &v->r;
    if (NU == 0) return;
    long present = k;
    if (k > r->N - 2) k = r->N - 2;
    if (k < -r->early) k = -r->early;
    while (k > -r->early && s < r->t[k]) k--;
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
        if (v->m->input_between[i] >= 2 && !out) {
            /* Hermite's cubic: what its slopes at both samples differ from the straight line's. */
            double line = (b[i] - a[i]) / h, g = 1 - f;
            double first = r->du[k*NU+i] - line, last = r->du[(k+1)*NU+i] - line;
            u[i] += h * f * g * (g * first - f * last);
            if (slope) slope[i] += g * (1 - 3*f) * first - f * (2 - 3*f) * last;
            if (v->m->input_between[i] == 2) continue;
            /* His quintic: what its second derivatives at both samples differ from the cubic's. */
            double p = h * (h * r->ddu[k*NU+i] + 4*first + 2*last) / 2;
            double q = h * (h * r->ddu[(k+1)*NU+i] - 2*first - 4*last) / 2, both = g*p + f*q;
            u[i] += f*g*f*g * both;
            if (slope) slope[i] += f*g * (2*(g - f) * both + f*g * (q - p)) / h;
        }
    }
}

/* Mean over the present step of input i as it was `lag` ago, which is held from sample to sample, and its slope in
 * time, by a little more lag where a sample is met: what it was at one moment would not answer to a small change of the
 * lag. k is the present interval. */
static double held_mean(const Work *v, double lag, long k, int i, double *slope)
{
    const Run *r = &v->r;
    double begin = v->tk - lag, end = begin + v->hk, met = 1e-9 * v->hk, sum = 0;
    while (k > -r->early && begin <= r->t[k] + met) k--;
    while (k < r->N - 1 && begin > r->t[k+1] + met) k++;
    double first = r->u[k*NU+i];
    for (; k < r->N - 1 && end > r->t[k+1] + met; k++) {
        sum += r->u[k*NU+i] * (r->t[k+1] - begin);
        begin = r->t[k+1];
    }
    *slope = (r->u[k*NU+i] - first) / v->hk;
    return (sum + r->u[k*NU+i] * (end - begin)) / v->hk;
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
        if (r->hs) {
            long known = r->nqp + r->nqx;
            const double *A = r->hs + (k*NX+i)*known, *B = A + NX*known;
            for (long m = 0; m < known; m++) S[m] = A[m] + f * (B[m] - A[m]);
        }
        return;
    }
    long n = v->hint[j], oldest = v->steps > v->kept ? v->steps - v->kept : 0, k;
    if (n >= v->steps) n = v->steps - 1;
    if (n < oldest) n = oldest;
    while (n > oldest && s < v->when[n % v->kept]) n--;
    while (n < v->steps - 1 && s > v->when[n % v->kept] + v->span[n % v->kept]) n++;
    v->hint[j] = n;
    k = n % v->kept;
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
            if (v->hk > 0 && v->m->input_between[i] == 1) {
                l[j] = held_mean(v, v->lag[j], k, i, &rate);
            } else {
                inputs_at(v, t - v->lag[j], k, u, slope);
                l[j] = u[i];
                rate = slope[i];
            }
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
    const Ode *m = v->m;
    const int n = m->ncoupled, *coupled = m->coupled;
    double u[NON(NU)], l[NON(NL)], M[NXX*NXX], C[NON(n*n)], b[NON(n)], shared[NON(m->nshared)];
    const double *w = r->w + k*m->nw;
    inputs_at(v, t, k, u, 0);
    late_at(v, t, k, x, S, l, lS);
    m->mass(xd, x, l, u, w, r->p, r->c, t, M, xd, shared);
    int pivot[NON(n)];
    for (int i = 0; i < NX; i++) xd[i] = -xd[i];
    for (int i = 0; i < n; i++) {
        b[i] = xd[coupled[i]];
        for (int j = 0; j < n; j++) C[i*n+j] = M[coupled[i]*NX+coupled[j]];
    }
    if (factor(n, C, pivot, b)) return 1;
    for (int i = 0; i < n; i++) xd[coupled[i]] = b[i];
    if (!nq && !A) return 0;
    double dx[NON(m->rx.count)], dl[NON(m->rl.count)], dp[NON(m->rp.count)], dw[NON(m->rw.count)];
    m->slopes(xd, x, l, u, w, r->p, r->c, t, dx, dl, dp, dw, shared);
    if (A) {
        memset(A, 0, NX * PADDED(NX) * sizeof(double));
        for (int i = 0; i < m->rx.count; i++) A[m->rx.row[i]*PADDED(NX) + m->rx.col[i]] -= dx[i];
        solve(n, C, pivot, coupled, A, PADDED(NX));
    }
    if (!nq) return 0;
    memset(Sd, 0, NX * nq * sizeof(double));
    chain(-1, &m->rx, dx, S, Sd, nq);
    chain(-1, &m->rl, dl, lS, Sd, nq);
    direct(-1, &m->rp, dp, v, Sd);
    solve(n, C, pivot, coupled, Sd, nq);
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

/* How many steps late signals and the corrections of the past may still read. */
static long steps_kept(const Work *v)
{
    const Run *r = &v->r;
    double longest = 0, least = INFINITY, most = 0, all = (double)(r->N - 1) * r->substeps + 1;
    for (int j = 0; j < NL; j++) if (!v->m->late_kind[j] && !(v->lag[j] <= longest)) longest = v->lag[j];
    for (long k = 0; k < r->N - 1; k++) {
        double h = r->t[k+1] - r->t[k];
        if (h < least) least = h;
        if (h > most) most = h;
    }
    double kept = ((longest + (r->npast + 1) * most) / least + 4) * r->substeps;
    return (long)(kept < all ? kept : all);
}

/* A value and its row of sensitivities `late` sample intervals before a sample, between those at whole ones. */
static double told_at(const Work *v, double late, int i, double *row)
{
    long j = late < 0 ? 0 : (long)late, wide = 1 + v->nq;
    memset(row, 0, v->nq * sizeof(double));
    if (j >= v->r.npast) return 0;
    double f = late < 0 ? 0 : late - j;
    const double *one = v->told + (j*NX + i)*wide, *next = one + NX*wide;
    add(1 - f, one + 1, row, v->nq);
    add(f, next + 1, row, v->nq);
    return (1-f) * one[0] + f * next[0];
}

/* What a sample says about the past that delayed signals still read: a fixed-lag smoother
 * (Anderson & Moore 1979, 7.3) on the stored steps, linear within each. First `told`: by how much each state was more
 * than was thought, 0, 1 ... sample intervals ago, and the slopes of that. */
static void correct_past(Work *v, double now, double interval, const double *e, const double *Sy)
{
    long nq = v->nq, big = NX*nq, wide = 1 + nq;
    for (long j = 0; j <= v->r.npast; j++)
        for (int i = 0; i < NX; i++) {
            double *told = v->told + (j*NX + i)*wide;
            const double *gain = v->r.gain + (j*NX + i)*NY;
            memset(told, 0, wide * sizeof(double));
            for (int o = 0; o < NY; o++) {
                told[0] += gain[o] * e[o];
                add(-gain[o], Sy + o*nq, told + 1, nq);
                if (v->r.dgain) add(e[o], v->r.dgain + ((j*NX + i)*NY + o)*nq, told + 1, nq);
            }
        }
    double start[NON(nq)], slope[NON(nq)];
    for (long n = v->steps - 1; n >= 0 && n >= v->steps - v->kept; n--) {
        long at = n % v->kept;
        double h = v->span[at], a = (now - v->when[at]) / interval, b = a - h / interval;
        if (b >= v->r.npast) break;
        double *P = v->poly + at*4*NX, *Q = v->spoly + at*4*big;
        for (int i = 0; i < NX; i++) {
            double begin = told_at(v, a, i, start), rate = (told_at(v, b, i, slope) - begin) / h;
            for (long q = 0; q < nq; q++) slope[q] = (slope[q] - start[q]) / h;
            add(1, start, Q + i*nq, nq);
            P[i] += begin;
            for (int k = 1; k < 4; k++) {
                P[k*NX+i] += k == 2 ? 2*rate : rate;
                add(k == 2 ? 2 : 1, slope, Q + k*big + i*nq, nq);
            }
        }
    }
}
