/* Symmetric scaling: every row's largest entry comes near one (Ruiz 2001), by powers of two, which round nothing.

   Without it a parameter's unit decides on pivots, and so do Ipopt's regularisations, of which far
   from feasible points one is 1e10 and the other 1e-8. */

#define PASSES 12 /* from a factorisation to the next one or two suffice: scales start from the last ones */
#define NEAR 3    /* binary digits from one that are near enough */

static inline int binary_exponent(double x) {
    int64_t bits;
    memcpy(&bits, &x, 8);
    return (int)(bits >> 52 & 2047) - 1022;
}

static inline double power_of_two(int e) {
    int64_t bits = (int64_t)((e < -1000 ? -1000 : e > 1000 ? 1000 : e) + 1023) << 52;
    double out;
    memcpy(&out, &bits, 8);
    return out;
}

/* Improve scale (n,) for the entries a; `most` (n,) is room. */
static void equilibrate(int n, int64_t nz, const int *irn, const int *jcn, const double *a, double *scale, double *most) {
    for (int pass = 0, far = 1; far && pass < PASSES; pass++) {
        memset(most, 0, sizeof(double) * n);
        for (int64_t k = 0; k < nz; k++) {
            int i = irn[k] - 1, j = jcn[k] - 1;
            double x = fabs(a[k]) * scale[i] * scale[j];
            if (x > most[i]) most[i] = x;
            if (x > most[j]) most[j] = x;
        }
        far = 0;
        for (int i = 0; i < n; i++) {
            int e = most[i] > 0 ? binary_exponent(most[i]) : 0;
            if (e >= -NEAR && e <= NEAR) continue;
            far = 1;
            scale[i] *= power_of_two(-(e / 2));
        }
    }
}
