// b5097133d9901198a8cbecc5f86d7cbe
// {"name": "double pendulum on a bench interval", "m": 4, "n_local": 8, "n_shared": 0, "n_data": 2, "n_constants": 18, "jacobian": [[0, 0], [0, 2], [0, 4], [0, 6], [1, 1], [1, 3], [1, 5], [1, 7], [2, 0], [2, 1], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [3, 0], [3, 1], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2], [3, 0], [3, 1], [3, 3], [4, 2], [4, 3], [4, 4], [5, 2], [5, 3], [5, 4], [5, 5], [6, 0], [6, 1], [6, 4], [6, 5], [6, 6], [7, 0], [7, 1], [7, 4], [7, 5], [7, 7]]}
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
    const double v1 = (0.5 * constants[12]);
    const double v2 = (1.0 / constants[9]);
    const double v3 = (constants[10] * v2);
    const double v4 = (1.0 / constants[15]);
    const double v5 = (0.5 * constants[13]);
    const double v6 = (constants[11] * v2);
    const double v7 = (1.0 / constants[16]);
    const double v10 = ((-0.5) * (constants[4] * (constants[3] * constants[7])));
    const double v13 = ((-0.5) * (constants[0] * (constants[1] * constants[7])));
    const double v15 = (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v2));
    const double v19 = (constants[4] * (constants[3] * constants[5]));
    const double v20 = ((-0.5) * ((constants[13] * constants[13]) * v19));
    const double v26 = ((-0.5) * (v2 * (constants[13] * v19)));
    const double v28 = (1.0 / constants[17]);
    const double v29 = ((-0.5) * (constants[4] * (constants[5] * constants[7])));
    const double v30 = ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v2));
    const double v31 = (0.5 * (v19 * (constants[12] * constants[12])));
    const double v32 = ((-0.5) * (v2 * (constants[12] * v19)));
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
            const double v8 = (constants[10] * local_column[0][i]);
            const double v9 = sin(v8);
            const double v11 = (constants[10] * local_column[4][i]);
            const double v12 = sin(v11);
            const double v14 = (local_column[6][i] - local_column[2][i]);
            const double v16 = (constants[11] * local_column[1][i]);
            const double v17 = (v8 - v16);
            const double v18 = sin(v17);
            const double v21 = (constants[11] * local_column[5][i]);
            const double v22 = (v11 - v21);
            const double v23 = sin(v22);
            const double v24 = (local_column[7][i] - local_column[3][i]);
            const double v25 = cos(v17);
            const double v27 = cos(v22);
            value[0][i] = (v0 * ((v1 * (local_column[2][i] + local_column[6][i])) - (v3 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v4 * ((v5 * (local_column[3][i] + local_column[7][i])) - (v6 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v7 * ((v26 * (v24 * v27)) + ((v26 * (v24 * v25)) + ((v20 * ((local_column[7][i] * local_column[7][i]) * v23)) + ((v20 * ((local_column[3][i] * local_column[3][i]) * v18)) + (((v13 * v12) + ((v13 * v9) + ((v10 * v12) + ((v10 * v9) + (data_column[1][i] - data_column[0][i]))))) - (v15 * v14)))))));
            value[3][i] = (v28 * ((v32 * (v14 * v27)) + ((v32 * (v14 * v25)) + ((v31 * (v23 * (local_column[6][i] * local_column[6][i]))) + ((v31 * (v18 * (local_column[2][i] * local_column[2][i]))) + (((v29 * sin(v21)) + ((v29 * sin(v16)) - data_column[1][i])) - (v30 * v24)))))));
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
    const double v10 = (constants[4] * (constants[3] * constants[5]));
    const double v17 = (1.0 / constants[17]);
    const double v18 = ((-0.5) * (v3 * (v1 * (constants[13] * v10))));
    const double v23 = ((-0.5) * (v3 * ((constants[13] * constants[13]) * v10)));
    const double v28 = (((-0.5) * (v3 * (constants[0] * (constants[1] * constants[7])))) + ((-0.5) * (v3 * (constants[4] * (constants[3] * constants[7])))));
    const double v29 = ((-0.5) * (v17 * (v1 * (constants[12] * v10))));
    const double v31 = (0.5 * (v17 * (v10 * (constants[12] * constants[12]))));
    const double v32 = (v31 + v31);
    const double v33 = ((-0.5) * (v17 * (constants[4] * (constants[5] * constants[7]))));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double value[24][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v4 = (constants[10] * local_column[0][i]);
            const double v5 = (constants[10] * local_column[4][i]);
            const double v6 = (local_column[6][i] - local_column[2][i]);
            const double v7 = (constants[11] * local_column[1][i]);
            const double v8 = (v4 - v7);
            const double v9 = sin(v8);
            const double v11 = (constants[11] * local_column[5][i]);
            const double v12 = (v5 - v11);
            const double v13 = sin(v12);
            const double v14 = (local_column[7][i] - local_column[3][i]);
            const double v15 = cos(v8);
            const double v16 = cos(v12);
            const double v19 = (v18 * (v13 * v14));
            const double v20 = (v15 + v16);
            const double v21 = (v18 * v20);
            const double v22 = (v18 * (v9 * v14));
            const double v24 = (v23 * ((local_column[7][i] * local_column[7][i]) * v16));
            const double v25 = (v23 * (local_column[7][i] * v13));
            const double v26 = (v23 * ((local_column[3][i] * local_column[3][i]) * v15));
            const double v27 = (v23 * (local_column[3][i] * v9));
            const double v30 = (v29 * v20);
            const double v34 = (v29 * (v6 * v13));
            const double v35 = (v29 * (v6 * v9));
            const double v36 = (v31 * (v16 * (local_column[6][i] * local_column[6][i])));
            const double v37 = (v31 * (v15 * (local_column[2][i] * local_column[2][i])));
            value[0][i] = (v0 * (constants[10] * v1));
            value[1][i] = (0.5 * (constants[12] * v0));
            value[2][i] = (-(v0 * (constants[10] * v1)));
            value[3][i] = (0.5 * (constants[12] * v0));
            value[4][i] = (v2 * (constants[11] * v1));
            value[5][i] = (0.5 * (constants[13] * v2));
            value[6][i] = (-(v2 * (constants[11] * v1)));
            value[7][i] = (0.5 * (constants[13] * v2));
            value[8][i] = (constants[10] * ((v26 - v22) + (v28 * cos(v4))));
            value[9][i] = (constants[11] * (v22 - v26));
            value[10][i] = (v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1)));
            value[11][i] = (v27 + (v27 - v21));
            value[12][i] = (constants[10] * ((v24 - v19) + (v28 * cos(v5))));
            value[13][i] = (constants[11] * (v19 - v24));
            value[14][i] = (-(v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1))));
            value[15][i] = (v25 + (v21 + v25));
            value[16][i] = (constants[10] * (v37 - v35));
            value[17][i] = (constants[11] * ((v33 * cos(v7)) + (v35 - v37)));
            value[18][i] = ((v32 * (local_column[2][i] * v9)) - v30);
            value[19][i] = (v17 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1)));
            value[20][i] = (constants[10] * (v36 - v34));
            value[21][i] = (constants[11] * ((v33 * cos(v11)) + (v34 - v36)));
            value[22][i] = (v30 + (v32 * (local_column[6][i] * v13)));
            value[23][i] = (-(v17 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1))));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 24; j++) out[k * 24 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[9]);
    const double v1 = (1.0 / constants[16]);
    const double v7 = (constants[4] * (constants[3] * constants[5]));
    const double v13 = (1.0 / constants[17]);
    const double v14 = (v1 * (v0 * (constants[13] * v7)));
    const double v15 = ((-0.5) * v14);
    const double v16 = (v1 * ((constants[13] * constants[13]) * v7));
    const double v17 = ((-0.5) * v16);
    const double v18 = (v13 * (v0 * (constants[12] * v7)));
    const double v19 = ((-0.5) * v18);
    const double v20 = (0.5 * (v13 * (v7 * (constants[12] * constants[12]))));
    const double v21 = (v20 + v20);
    const double v27 = ((-0.5) * (constants[10] * v18));
    const double v30 = (constants[10] * v21);
    const double v31 = ((-0.5) * (constants[10] * v14));
    const double v34 = (constants[10] * constants[11]);
    const double v36 = ((-0.5) * (constants[10] * v16));
    const double v38 = (constants[10] * (((-0.5) * (v1 * (constants[0] * (constants[1] * constants[7])))) + ((-0.5) * (v1 * (constants[4] * (constants[3] * constants[7]))))));
    const double v39 = ((-0.5) * (constants[11] * v18));
    const double v40 = (constants[11] * v21);
    const double v41 = ((-0.5) * (constants[11] * (v13 * (constants[4] * (constants[5] * constants[7])))));
    const double v42 = ((-0.5) * (constants[11] * v14));
    const double v43 = ((-0.5) * (constants[11] * v16));
    const double v47 = (v17 + v17);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[26][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 4; j++) multipliers_column[j][i] = multipliers[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v2 = (constants[10] * local_column[0][i]);
            const double v3 = (constants[10] * local_column[4][i]);
            const double v4 = (constants[11] * local_column[1][i]);
            const double v5 = (v2 - v4);
            const double v6 = sin(v5);
            const double v8 = (constants[11] * local_column[5][i]);
            const double v9 = (v3 - v8);
            const double v10 = sin(v9);
            const double v11 = cos(v5);
            const double v12 = cos(v9);
            const double v22 = (v10 * multipliers_column[3][i]);
            const double v23 = (v6 * multipliers_column[3][i]);
            const double v24 = ((v19 * ((local_column[6][i] - local_column[2][i]) * multipliers_column[3][i])) + (v15 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])));
            const double v25 = (v10 * multipliers_column[2][i]);
            const double v26 = (v6 * multipliers_column[2][i]);
            const double v28 = (v27 * v23);
            const double v29 = (local_column[2][i] * (v11 * multipliers_column[3][i]));
            const double v32 = (v31 * v26);
            const double v33 = ((v11 * v24) + (v6 * ((v20 * ((local_column[2][i] * local_column[2][i]) * multipliers_column[3][i])) + (v17 * ((local_column[3][i] * local_column[3][i]) * multipliers_column[2][i])))));
            const double v35 = (local_column[3][i] * (v11 * multipliers_column[2][i]));
            const double v37 = (v36 * v35);
            const double v44 = (v43 * v35);
            const double v45 = (v39 * v22);
            const double v46 = (v42 * v25);
            const double v48 = (local_column[6][i] * (v12 * multipliers_column[3][i]));
            const double v49 = ((v12 * v24) + (v10 * ((v20 * ((local_column[6][i] * local_column[6][i]) * multipliers_column[3][i])) + (v17 * ((local_column[7][i] * local_column[7][i]) * multipliers_column[2][i])))));
            const double v50 = (local_column[7][i] * (v12 * multipliers_column[2][i]));
            const double v51 = (v36 * v50);
            const double v52 = (v43 * v50);
            value[0][i] = (-(constants[10] * ((constants[10] * v33) + (v38 * (sin(v2) * multipliers_column[2][i])))));
            value[1][i] = (v34 * v33);
            value[2][i] = (-(constants[11] * ((v41 * (sin(v4) * multipliers_column[3][i])) + (constants[11] * v33))));
            value[3][i] = (v28 + (v30 * v29));
            value[4][i] = (-((v39 * v23) + (v40 * v29)));
            value[5][i] = (v21 * v23);
            value[6][i] = (v37 + (v32 + v37));
            value[7][i] = (-(v44 + ((v42 * v26) + v44)));
            value[8][i] = (v47 * v26);
            value[9][i] = (v27 * v22);
            value[10][i] = (v31 * v25);
            value[11][i] = (-(constants[10] * ((constants[10] * v49) + (v38 * (sin(v3) * multipliers_column[2][i])))));
            value[12][i] = (-v45);
            value[13][i] = (-v46);
            value[14][i] = (v34 * v49);
            value[15][i] = (-(constants[11] * ((v41 * (sin(v8) * multipliers_column[3][i])) + (constants[11] * v49))));
            value[16][i] = (-v28);
            value[17][i] = (v39 * v23);
            value[18][i] = ((v30 * v48) - (v27 * v22));
            value[19][i] = (v45 - (v40 * v48));
            value[20][i] = (v21 * v22);
            value[21][i] = (-v32);
            value[22][i] = (v42 * v26);
            value[23][i] = (v51 + (v51 - (v31 * v25)));
            value[24][i] = ((v46 - v52) - v52);
            value[25][i] = (v47 * v25);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 26; j++) out[index[k * 26 + j]] += value[j][i];
        }
    }
}
