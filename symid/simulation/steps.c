/* One step of the integrator. Runge-Kutta 4 carries its own dense output (Hairer, Norsett & Wanner 1993, II.6) for
 * the delayed signals. Stiff steps are those of ROS2 (Verwer, Spee, Blom & Hundsdorfer 1999): of order 2 with any
 * matrix, so that S may have the same one as x. */

#define EULER 1
#define STIFF 2
/* Decays together faster than this in a step are stiff: the explicit method follows 2.785. */
#define FAST 2.0
/* Of ROS2, 1 - 1/sqrt(2): what is infinitely stiff is gone after one step. */
#define GAMMA 0.29289321881345248
/* Where what decays changes more than this within a step the method of order 2 would overshoot. */
#define EVEN 0.5
/* So often a step is halved in which something sets in, as dry friction does where it comes to stick. */
#define HALVINGS 10
#define CUT 2
/* A run ends that is cut everywhere: for each step that it was to make so many times, and at a few places to the last.
 * Of 59000 runs with cuts (dry friction, hysteresis, a valve) 75 were cut more often than 30 times a step: near a
 * singular mass or far from any motion. In the searches that had them they took 0.9 of all steps and more. */
#define CUTS_A_STEP 30
#define MOST_CUTS 2000
/* What a step may err by where its rates bend, of the size of each state: a precise sensor sees 1e-6 of its range, and
 * a motion that cannot be followed for long makes 100 times as much of it. */
#define UNSEEN 1e-8
/* Where rates are smooth, both halves of a step err alike, and a step between these many times as much as both together,
 * 16 of very short ones. Where they bend in one half, that errs so many times as much as the other. Where they bend in
 * the middle all this may look smooth by chance, but the step errs so many times as much as the calm ones before it. */
#define UNEQUAL 10.0
#define LEAST 6.0
#define MOST 50.0
/* Steps are equally long up to what rounding makes of times. */
#define SAME 1e-6
#define FIRST_HALF 1
#define SECOND_HALF 2

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

/* One step of the linearly implicit Euler method with the matrix in A, which forgets what is fast for good, whatever it
 * has become meanwhile; ROS2's first stage alone would amplify it. */
static int damped_step(Work *v, double t, double h, long k)
{
    double W[NXX*NXX], *k1 = v->rate[0], *K1 = v->Rate[0];
    int pivot[NXX];
    for (int i = 0; i < NX; i++)
        for (int j = 0; j < NX; j++) W[i*NX+j] = (i == j) - h * v->A[i*PADDED(NX)+j];
    if (rates(v, t + h, k, v->x, v->S, k1, K1, v->lS, 0) || factor(NX, W, pivot, k1)) return 1;
    solve(NX, W, pivot, 0, K1, v->nq);
    return euler_step(v, h);
}

/* One step of ROS2 from x and S, whose rates are known. Its stages become those of a straight line to its end. CUT
 * where what decays changes within it, if it may be halved. */
static int implicit_step(Work *v, double t, double h, long k, int halvings)
{
    long nq = v->nq, big = NX*nq;
    double W[NXX*NXX], d[NXX*WIDE], A[NXX*PADDED(NX)], *k1 = v->rate[0], *k2 = v->rate[1], *g = v->rate[2];
    double *K1 = v->Rate[0], *K2 = v->Rate[1], *G = v->Rate[2];
    int pivot[NXX];
    v->stiff++;
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
    solve(NX, W, pivot, 0, K1, nq);
    for (long i = 0; i < big; i++) v->Sx[i] = v->S[i] + h*K1[i];
    if (rates(v, t + h, k, v->xs, v->Sx, k2, K2, v->lS, A)) return 1;
    double before = decay(NX, v->A), after = decay(NX, A);
    if (!(after > EVEN * before && before > EVEN * after)) return halvings ? CUT : damped_step(v, t, h, k);
    for (int i = 0; i < NX; i++) d[i*WIDE] = k2[i] - 2*k1[i] - g[i];
    for (long i = 0; i < big; i++) K2[i] -= 2*K1[i] + G[i];
    solve(NX, W, pivot, 0, d, WIDE);
    solve(NX, W, pivot, 0, K2, nq);
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

/* The state alone, one step of Runge-Kutta 4 after x, where its rates are k1. */
static int state_step(Work *v, double t, double h, long k, const double *x, const double *k1, double *to)
{
    double k2[NXX], k3[NXX], k4[NXX];
    for (int i = 0; i < NX; i++) to[i] = x[i] + h/2*k1[i];
    if (rates(v, t + h/2, k, to, 0, k2, 0, 0, 0)) return 1;
    for (int i = 0; i < NX; i++) to[i] = x[i] + h/2*k2[i];
    if (rates(v, t + h/2, k, to, 0, k3, 0, 0, 0)) return 1;
    for (int i = 0; i < NX; i++) to[i] = x[i] + h*k3[i];
    if (rates(v, t + h, k, to, 0, k4, 0, 0, 0)) return 1;
    for (int i = 0; i < NX; i++) to[i] = x[i] + h/6 * (k1[i] + 2*(k2[i] + k3[i]) + k4[i]);
    return 0;
}

/* What a step from x, where the rates are k1, to `end` errs by, also of the size of each state. 0 where it cannot be
 * halved; halves : where its first half ends, the rates there, and where the second ends. */
static double error_of(Work *v, double t, double h, long k, const double *x, const double *k1, const double *end,
                       double *halves, double *error)
{
    double *middle = halves, *rate = halves + NX, *twice = halves + 2*NX, worst = 0;
    memset(error, 0, NX * sizeof(double));
    if (state_step(v, t, h/2, k, x, k1, middle) || rates(v, t + h/2, k, middle, 0, rate, 0, 0, 0)
        || state_step(v, t + h/2, h/2, k, middle, rate, twice)) return 0;
    for (int i = 0; i < NX; i++) {
        error[i] = twice[i] - end[i];
        worst = fmax(worst, fabs(error[i]) / v->size[i]);
    }
    return worst;
}

/* Whether a whole step errs as the two before let expect, and so is smooth as they are; it is kept beside them. */
static int as_before(Work *v, double h, const double *error)
{
    int same = fabs(h - v->span_err) < SAME * h;
    double *before = v->err, *earlier = v->err + NX, worst = 0;
    for (int i = 0; i < NX; i++) worst = fmax(worst, fabs(error[i] - 2*before[i] + earlier[i]) / v->size[i]);
    int expected = same && v->smooth > 1 && worst <= UNSEEN;
    v->smooth = same ? v->smooth + 1 : 1;
    v->span_err = h;
    memcpy(earlier, before, NX * sizeof(double)); memcpy(before, error, NX * sizeof(double));
    return expected;
}

/* Whether a whole step errs far more than calm ones. Each that does makes the next less sudden: a motion may begin. */
static int is_sudden(Work *v, double whole)
{
    int sudden = v->calm > 0 && whole > UNEQUAL * v->calm;
    v->calm = sudden ? UNEQUAL * v->calm : fmax(whole, UNSEEN);
    return sudden;
}

/* In which halves of the explicit step from xk to x the rates bend so that it errs; both, in a `bend` that is known. */
static int bends(Work *v, double t, double h, long k, int halvings, int bend)
{
    long nq = v->nq;
    int both = FIRST_HALF + SECOND_HALF, found = 0;
    double halves[3*NXX], error[NXX], unused[3*NXX], *middle = halves, *rate = halves + NX, *end = halves + 2*NX;
    v->nq = 0;
    double whole = error_of(v, t, h, k, v->xk, v->k1, v->x, halves, error);
    int uncut = halvings == HALVINGS, expected = uncut && as_before(v, h, error), sudden = uncut && is_sudden(v, whole);
    if (whole > UNSEEN && (bend || sudden)) found = both;
    else if (whole > UNSEEN && !expected) {
        double first = error_of(v, t, h/2, k, v->xk, v->k1, middle, unused, error);
        double second = error_of(v, t + h/2, h/2, k, middle, rate, end, unused, error);
        int smooth = LEAST * (first + second) < whole && whole < MOST * (first + second);
        found = first > UNEQUAL * second ? FIRST_HALF : second > UNEQUAL * first ? SECOND_HALF : smooth ? 0 : both;
    }
    if (found) v->smooth = 0;
    v->nq = nq;
    return found;
}

/* One step from x and S, and its stages, which may be halved so often; 1 where a mass matrix is singular, or too many
 * steps were cut.
 * bend : whether the rates bend in it. */
static int step(Work *v, double t, double h, long k, int halvings, int bend)
{
    long big = NX * v->nq;
    int stiff = v->r.method == STIFF, halves = FIRST_HALF + SECOND_HALF;
    v->inside = 0;
    v->tk = t; v->hk = h;
    memcpy(v->xk, v->x, NX * sizeof(double)); memcpy(v->sk, v->S, big * sizeof(double));
    if (rates(v, t, k, v->x, v->S, v->rate[0], v->Rate[0], v->lS, stiff ? v->A : 0)) return 1;
    memcpy(v->k1, v->rate[0], NX * sizeof(double)); memcpy(v->sk1, v->Rate[0], big * sizeof(double));
    v->inside = 1;
    if (v->r.method == EULER) return euler_step(v, h);
    for (int i = 0; i < NX; i++) v->size[i] = fmax(v->size[i], fmax(fabs(v->x[i]), h * fabs(v->k1[i])));
    if (stiff && decay(NX, v->A) * h > FAST) {
        int end = implicit_step(v, t, h, k, halvings);
        if (end != CUT) return end;
    } else {
        double fast = 0;
        if (explicit_step(v, t, h, k, stiff ? &fast : 0)) return 1;
        int sets_in = fast * h > FAST;
        v->stiff += sets_in;
        if (!sets_in) {
            halves = stiff && halvings ? bends(v, t, h, k, halvings, bend) : 0;
            if (!halves) return 0;
        } else if (!halvings) {
            memcpy(v->x, v->xk, NX * sizeof(double)); memcpy(v->S, v->sk, big * sizeof(double));
            return implicit_step(v, t, h, k, 0);
        }
    }
    memcpy(v->x, v->xk, NX * sizeof(double)); memcpy(v->S, v->sk, big * sizeof(double));
    if (++v->cuts > MOST_CUTS + CUTS_A_STEP * v->begun) return 1;
    return step(v, t, h/2, k, halvings - 1, halves & FIRST_HALF)
        || step(v, t + h/2, h/2, k, halvings - 1, halves & SECOND_HALF);
}
