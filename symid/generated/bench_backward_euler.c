// c9643a36c4c44e7c903a5a546bea5d56
// {"name": "double pendulum on a bench interval", "m": 4, "n_local": 8, "n_shared": 0, "n_data": 2, "n_constants": 18, "jacobian": [[0, 0], [0, 4], [0, 6], [1, 1], [1, 5], [1, 7], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7]], "hessian": [[4, 2], [4, 3], [4, 4], [5, 2], [5, 3], [5, 4], [5, 5], [6, 4], [6, 5], [6, 6], [7, 4], [7, 5], [7, 7]]}
// local[0]: link1_angle#0
// local[1]: link2_angle#0
// local[2]: link1_velocity#0
// local[3]: link2_velocity#0
// local[4]: link1_angle#1
// local[5]: link2_angle#1
// local[6]: link1_velocity#1
// local[7]: link2_velocity#1
// data[0]: joint1_torque_noise
// data[1]: joint2_torque_noise
// constants[0]: m1
// constants[1]: a1
// constants[2]: I1
// constants[3]: L1
// constants[4]: m2
// constants[5]: a2
// constants[6]: I2
// constants[7]: gravity
// constants[8]: friction_speed
// constants[9]: step h
// constants[10]: scale link1_angle
// constants[11]: scale link2_angle
// constants[12]: scale link1_velocity
// constants[13]: scale link2_velocity
// constants[14]: scale link1_kinematics
// constants[15]: scale link2_kinematics
// constants[16]: scale link1_balance
// constants[17]: scale link2_balance
#include <math.h>
#include <stddef.h>
#if defined(SYMID_LIBMVEC)
#define SYMID_VECTOR __attribute__((simd("notinbranch"), const, nothrow))
SYMID_VECTOR extern double sin(double);
SYMID_VECTOR extern double cos(double);
SYMID_VECTOR extern double exp(double);
SYMID_VECTOR extern double log(double);
SYMID_VECTOR extern double pow(double, double);
#if __GLIBC_PREREQ(2, 35)
SYMID_VECTOR extern double tan(double);
SYMID_VECTOR extern double asin(double);
SYMID_VECTOR extern double acos(double);
SYMID_VECTOR extern double atan(double);
SYMID_VECTOR extern double atan2(double, double);
SYMID_VECTOR extern double sinh(double);
SYMID_VECTOR extern double cosh(double);
SYMID_VECTOR extern double tanh(double);
#endif
#endif
#define BLOCK 8

void residual(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[14]);
    const double v1 = (1.0 / constants[9]);
    const double v2 = (constants[10] * v1);
    const double v3 = (1.0 / constants[15]);
    const double v4 = (constants[11] * v1);
    const double v5 = (1.0 / constants[16]);
    const double v8 = (constants[4] * (constants[3] * constants[7]));
    const double v9 = (constants[0] * (constants[1] * constants[7]));
    const double v11 = (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1));
    const double v15 = (constants[4] * (constants[3] * constants[5]));
    const double v16 = ((constants[13] * constants[13]) * v15);
    const double v19 = (v1 * (constants[13] * v15));
    const double v20 = (1.0 / constants[17]);
    const double v21 = (constants[4] * (constants[5] * constants[7]));
    const double v22 = ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1));
    const double v23 = (v15 * (constants[12] * constants[12]));
    const double v24 = (v1 * (constants[12] * v15));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[2][BLOCK] __attribute__((aligned(64)));
        double value[4][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 2; j++) data_column[j][i] = data[k * 2 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v6 = (constants[10] * local_column[4][i]);
            const double v7 = sin(v6);
            const double v10 = (local_column[6][i] - local_column[2][i]);
            const double v12 = (constants[11] * local_column[5][i]);
            const double v13 = (v6 - v12);
            const double v14 = sin(v13);
            const double v17 = (local_column[7][i] - local_column[3][i]);
            const double v18 = cos(v13);
            value[0][i] = (v0 * ((constants[12] * local_column[6][i]) - (v2 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v3 * ((constants[13] * local_column[7][i]) - (v4 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v5 * ((((((data_column[1][i] - data_column[0][i]) - (v8 * v7)) - (v9 * v7)) - (v11 * v10)) - (v16 * ((local_column[7][i] * local_column[7][i]) * v14))) - (v19 * (v17 * v18))));
            value[3][i] = (v20 * (((v23 * (v14 * (local_column[6][i] * local_column[6][i]))) - ((v22 * v17) + (data_column[1][i] + (v21 * sin(v12))))) - (v24 * (v10 * v18))));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 4; j++) out[k * 4 + j] = value[j][i];
        }
    }
}


void jacobian(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[14]);
    const double v1 = (1.0 / constants[9]);
    const double v2 = (1.0 / constants[15]);
    const double v3 = (1.0 / constants[16]);
    const double v8 = (constants[4] * (constants[3] * constants[5]));
    const double v10 = (1.0 / constants[17]);
    const double v11 = (v3 * (v1 * (constants[13] * v8)));
    const double v13 = (v3 * ((constants[13] * constants[13]) * v8));
    const double v16 = ((v3 * (constants[0] * (constants[1] * constants[7]))) + (v3 * (constants[4] * (constants[3] * constants[7]))));
    const double v17 = (v10 * (v1 * (constants[12] * v8)));
    const double v18 = (v10 * (v8 * (constants[12] * constants[12])));
    const double v19 = (v18 + v18);
    const double v20 = (v10 * (constants[4] * (constants[5] * constants[7])));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double value[18][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v4 = (constants[10] * local_column[4][i]);
            const double v5 = (constants[11] * local_column[5][i]);
            const double v6 = (v4 - v5);
            const double v7 = sin(v6);
            const double v9 = cos(v6);
            const double v12 = (v11 * (v7 * (local_column[7][i] - local_column[3][i])));
            const double v14 = (v13 * ((local_column[7][i] * local_column[7][i]) * v9));
            const double v15 = (v13 * (local_column[7][i] * v7));
            const double v21 = ((v17 * ((local_column[6][i] - local_column[2][i]) * v7)) + (v18 * (v9 * (local_column[6][i] * local_column[6][i]))));
            value[0][i] = (v0 * (constants[10] * v1));
            value[1][i] = (-(v0 * (constants[10] * v1)));
            value[2][i] = (constants[12] * v0);
            value[3][i] = (v2 * (constants[11] * v1));
            value[4][i] = (-(v2 * (constants[11] * v1)));
            value[5][i] = (constants[13] * v2);
            value[6][i] = (v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1)));
            value[7][i] = (v11 * v9);
            value[8][i] = (constants[10] * ((v12 - v14) - (v16 * cos(v4))));
            value[9][i] = (constants[11] * (v14 - v12));
            value[10][i] = (-(v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1))));
            value[11][i] = (-(v15 + ((v11 * v9) + v15)));
            value[12][i] = (v17 * v9);
            value[13][i] = (v10 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1)));
            value[14][i] = (constants[10] * v21);
            value[15][i] = (-(constants[11] * ((v20 * cos(v5)) + v21)));
            value[16][i] = ((v19 * (local_column[6][i] * v7)) - (v17 * v9));
            value[17][i] = (-(v10 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1))));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 18; j++) out[k * 18 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[9]);
    const double v1 = (1.0 / constants[16]);
    const double v6 = (constants[4] * (constants[3] * constants[5]));
    const double v8 = (1.0 / constants[17]);
    const double v9 = (v1 * (v0 * (constants[13] * v6)));
    const double v10 = (v1 * ((constants[13] * constants[13]) * v6));
    const double v11 = (v8 * (v0 * (constants[12] * v6)));
    const double v12 = (v8 * (v6 * (constants[12] * constants[12])));
    const double v13 = (v12 + v12);
    const double v16 = (constants[11] * v11);
    const double v17 = (constants[10] * v11);
    const double v19 = (constants[11] * v9);
    const double v20 = (constants[10] * v9);
    const double v23 = (constants[10] * v13);
    const double v27 = (constants[10] * constants[11]);
    const double v29 = (constants[10] * v10);
    const double v31 = (constants[10] * ((v1 * (constants[0] * (constants[1] * constants[7]))) + (v1 * (constants[4] * (constants[3] * constants[7])))));
    const double v32 = (constants[11] * v13);
    const double v33 = (constants[11] * (v8 * (constants[4] * (constants[5] * constants[7]))));
    const double v34 = (constants[11] * v10);
    const double v36 = (v10 + v10);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[13][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 4; j++) multipliers_column[j][i] = multipliers[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v2 = (constants[10] * local_column[4][i]);
            const double v3 = (constants[11] * local_column[5][i]);
            const double v4 = (v2 - v3);
            const double v5 = sin(v4);
            const double v7 = cos(v4);
            const double v14 = (v5 * multipliers_column[3][i]);
            const double v15 = (v5 * multipliers_column[2][i]);
            const double v18 = (v17 * v14);
            const double v21 = (v20 * v15);
            const double v22 = (local_column[6][i] * (v7 * multipliers_column[3][i]));
            const double v24 = (v7 * ((v11 * ((local_column[6][i] - local_column[2][i]) * multipliers_column[3][i])) + (v9 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i]))));
            const double v25 = (v5 * ((v12 * ((local_column[6][i] * local_column[6][i]) * multipliers_column[3][i])) - (v10 * ((local_column[7][i] * local_column[7][i]) * multipliers_column[2][i]))));
            const double v26 = (v24 - v25);
            const double v28 = (local_column[7][i] * (v7 * multipliers_column[2][i]));
            const double v30 = (v29 * v28);
            const double v35 = (v34 * v28);
            value[0][i] = (-v18);
            value[1][i] = (-v21);
            value[2][i] = (constants[10] * ((constants[10] * v26) + (v31 * (sin(v2) * multipliers_column[2][i]))));
            value[3][i] = (v16 * v14);
            value[4][i] = (v19 * v15);
            value[5][i] = (-(v27 * v26));
            value[6][i] = (-(constants[11] * ((constants[11] * (v25 - v24)) - (v33 * (sin(v3) * multipliers_column[3][i])))));
            value[7][i] = (v18 + (v23 * v22));
            value[8][i] = (-((v16 * v14) + (v32 * v22)));
            value[9][i] = (v13 * v14);
            value[10][i] = (-(v30 + (v30 - v21)));
            value[11][i] = (v35 - ((v19 * v15) - v35));
            value[12][i] = (-(v36 * v15));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 13; j++) out[index[k * 13 + j]] += value[j][i];
        }
    }
}
