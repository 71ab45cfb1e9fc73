// bb88a3037f4b438d77e02bcd32d5cd2a
// {"name": "double pendulum on a bench interval", "m": 4, "n_local": 8, "n_shared": 2, "n_data": 2, "n_constants": 20, "jacobian": [[0, 0], [0, 2], [0, 4], [0, 6], [1, 1], [1, 3], [1, 5], [1, 7], [2, 0], [2, 1], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [2, 8], [2, 9], [3, 0], [3, 1], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7], [3, 9]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2], [3, 0], [3, 1], [3, 3], [4, 2], [4, 3], [4, 4], [5, 2], [5, 3], [5, 4], [5, 5], [6, 0], [6, 1], [6, 4], [6, 5], [6, 6], [7, 0], [7, 1], [7, 4], [7, 5], [7, 7], [8, 2], [8, 6], [9, 2], [9, 3], [9, 6], [9, 7]]}
// local[0]: link1_angle#0
// local[1]: link2_angle#0
// local[2]: link1_velocity#0
// local[3]: link2_velocity#0
// local[4]: link1_angle#1
// local[5]: link2_angle#1
// local[6]: link1_velocity#1
// local[7]: link2_velocity#1
// shared[0]: viscous_friction_joint1_coefficient_Nms_rad
// shared[1]: viscous_friction_joint2_coefficient_Nms_rad
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
// constants[14]: scale viscous_friction_joint1_coefficient_Nms_rad
// constants[15]: scale viscous_friction_joint2_coefficient_Nms_rad
// constants[16]: scale link1_kinematics
// constants[17]: scale link2_kinematics
// constants[18]: scale link1_balance
// constants[19]: scale link2_balance
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
    const double v0 = (1.0 / constants[16]);
    const double v1 = (0.5 * constants[12]);
    const double v2 = (1.0 / constants[9]);
    const double v3 = (constants[10] * v2);
    const double v4 = (1.0 / constants[17]);
    const double v5 = (0.5 * constants[13]);
    const double v6 = (constants[11] * v2);
    const double v7 = (1.0 / constants[18]);
    const double v9 = (shared[1] * constants[15]);
    const double v10 = (0.5 * v9);
    const double v14 = ((-0.5) * (constants[4] * (constants[3] * constants[7])));
    const double v17 = ((-0.5) * (constants[0] * (constants[1] * constants[7])));
    const double v18 = ((-0.5) * (shared[0] * (constants[12] * constants[14])));
    const double v20 = (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v2));
    const double v24 = (constants[4] * (constants[3] * constants[5]));
    const double v25 = ((-0.5) * ((constants[13] * constants[13]) * v24));
    const double v31 = ((-0.5) * (v2 * (constants[13] * v24)));
    const double v33 = (1.0 / constants[19]);
    const double v34 = ((-0.5) * v9);
    const double v35 = ((-0.5) * (constants[4] * (constants[5] * constants[7])));
    const double v36 = ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v2));
    const double v37 = (0.5 * (v24 * (constants[12] * constants[12])));
    const double v38 = ((-0.5) * (v2 * (constants[12] * v24)));
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
            const double v8 = ((constants[13] * local_column[3][i]) - (constants[12] * local_column[2][i]));
            const double v11 = ((constants[13] * local_column[7][i]) - (constants[12] * local_column[6][i]));
            const double v12 = (constants[10] * local_column[0][i]);
            const double v13 = sin(v12);
            const double v15 = (constants[10] * local_column[4][i]);
            const double v16 = sin(v15);
            const double v19 = (local_column[6][i] - local_column[2][i]);
            const double v21 = (constants[11] * local_column[1][i]);
            const double v22 = (v12 - v21);
            const double v23 = sin(v22);
            const double v26 = (constants[11] * local_column[5][i]);
            const double v27 = (v15 - v26);
            const double v28 = sin(v27);
            const double v29 = (local_column[7][i] - local_column[3][i]);
            const double v30 = cos(v22);
            const double v32 = cos(v27);
            value[0][i] = (v0 * ((v1 * (local_column[2][i] + local_column[6][i])) - (v3 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v4 * ((v5 * (local_column[3][i] + local_column[7][i])) - (v6 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v7 * ((v31 * (v29 * v32)) + ((v31 * (v29 * v30)) + ((v25 * ((local_column[7][i] * local_column[7][i]) * v28)) + ((v25 * ((local_column[3][i] * local_column[3][i]) * v23)) + (((v18 * local_column[6][i]) + ((v18 * local_column[2][i]) + ((v17 * v16) + ((v17 * v13) + ((v14 * v16) + ((v14 * v13) + ((v10 * v11) + ((v10 * v8) + (data_column[1][i] - data_column[0][i]))))))))) - (v20 * v19)))))));
            value[3][i] = (v33 * ((v38 * (v19 * v32)) + ((v38 * (v19 * v30)) + ((v37 * (v28 * (local_column[6][i] * local_column[6][i]))) + ((v37 * (v23 * (local_column[2][i] * local_column[2][i]))) + (((v35 * sin(v26)) + ((v35 * sin(v21)) + ((v34 * v11) + ((v34 * v8) - data_column[1][i])))) - (v36 * v29)))))));
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
    const double v0 = (1.0 / constants[16]);
    const double v1 = (1.0 / constants[9]);
    const double v2 = (1.0 / constants[17]);
    const double v3 = (1.0 / constants[18]);
    const double v4 = (shared[1] * constants[15]);
    const double v7 = (constants[12] * constants[14]);
    const double v12 = (constants[4] * (constants[3] * constants[5]));
    const double v19 = (1.0 / constants[19]);
    const double v20 = ((-0.5) * (v3 * (v1 * (constants[13] * v12))));
    const double v25 = ((-0.5) * (v3 * ((constants[13] * constants[13]) * v12)));
    const double v30 = (v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1)));
    const double v31 = ((-0.5) * (v3 * (shared[0] * v7)));
    const double v32 = ((-0.5) * (v3 * v7));
    const double v33 = (((-0.5) * (v3 * (constants[0] * (constants[1] * constants[7])))) + ((-0.5) * (v3 * (constants[4] * (constants[3] * constants[7])))));
    const double v34 = (v3 * v4);
    const double v35 = ((-0.5) * (constants[12] * v34));
    const double v36 = (0.5 * (constants[13] * v34));
    const double v38 = (0.5 * (constants[15] * v3));
    const double v39 = ((-0.5) * (v19 * (v1 * (constants[12] * v12))));
    const double v41 = (0.5 * (v19 * (v12 * (constants[12] * constants[12]))));
    const double v42 = (v41 + v41);
    const double v43 = (v19 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1)));
    const double v44 = ((-0.5) * (v19 * (constants[4] * (constants[5] * constants[7]))));
    const double v45 = (v4 * v19);
    const double v50 = (0.5 * (constants[12] * v45));
    const double v51 = ((-0.5) * (constants[13] * v45));
    const double v52 = ((-0.5) * (constants[15] * v19));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double value[27][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v5 = (constants[10] * local_column[0][i]);
            const double v6 = (constants[10] * local_column[4][i]);
            const double v8 = (local_column[6][i] - local_column[2][i]);
            const double v9 = (constants[11] * local_column[1][i]);
            const double v10 = (v5 - v9);
            const double v11 = sin(v10);
            const double v13 = (constants[11] * local_column[5][i]);
            const double v14 = (v6 - v13);
            const double v15 = sin(v14);
            const double v16 = (local_column[7][i] - local_column[3][i]);
            const double v17 = cos(v10);
            const double v18 = cos(v14);
            const double v21 = (v20 * (v15 * v16));
            const double v22 = (v17 + v18);
            const double v23 = (v20 * v22);
            const double v24 = (v20 * (v11 * v16));
            const double v26 = (v25 * ((local_column[7][i] * local_column[7][i]) * v18));
            const double v27 = (v25 * (local_column[7][i] * v15));
            const double v28 = (v25 * ((local_column[3][i] * local_column[3][i]) * v17));
            const double v29 = (v25 * (local_column[3][i] * v11));
            const double v37 = (((constants[13] * local_column[3][i]) - (constants[12] * local_column[2][i])) + ((constants[13] * local_column[7][i]) - (constants[12] * local_column[6][i])));
            const double v40 = (v39 * v22);
            const double v46 = (v39 * (v8 * v15));
            const double v47 = (v39 * (v8 * v11));
            const double v48 = (v41 * (v18 * (local_column[6][i] * local_column[6][i])));
            const double v49 = (v41 * (v17 * (local_column[2][i] * local_column[2][i])));
            value[0][i] = (v0 * (constants[10] * v1));
            value[1][i] = (0.5 * (constants[12] * v0));
            value[2][i] = (-(v0 * (constants[10] * v1)));
            value[3][i] = (0.5 * (constants[12] * v0));
            value[4][i] = (v2 * (constants[11] * v1));
            value[5][i] = (0.5 * (constants[13] * v2));
            value[6][i] = (-(v2 * (constants[11] * v1)));
            value[7][i] = (0.5 * (constants[13] * v2));
            value[8][i] = (constants[10] * ((v28 - v24) + (v33 * cos(v5))));
            value[9][i] = (constants[11] * (v24 - v28));
            value[10][i] = ((v30 + v31) + v35);
            value[11][i] = (v36 + (v29 + (v29 - v23)));
            value[12][i] = (constants[10] * ((v26 - v21) + (v33 * cos(v6))));
            value[13][i] = (constants[11] * (v21 - v26));
            value[14][i] = ((v31 - v30) + v35);
            value[15][i] = (v36 + (v27 + (v23 + v27)));
            value[16][i] = (v32 * (local_column[2][i] + local_column[6][i]));
            value[17][i] = (v38 * v37);
            value[18][i] = (constants[10] * (v49 - v47));
            value[19][i] = (constants[11] * ((v44 * cos(v9)) + (v47 - v49)));
            value[20][i] = (v50 + ((v42 * (local_column[2][i] * v11)) - v40));
            value[21][i] = (v43 + v51);
            value[22][i] = (constants[10] * (v48 - v46));
            value[23][i] = (constants[11] * ((v44 * cos(v13)) + (v46 - v48)));
            value[24][i] = (v50 + (v40 + (v42 * (local_column[6][i] * v15))));
            value[25][i] = (v51 - v43);
            value[26][i] = (v52 * v37);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 27; j++) out[k * 27 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[9]);
    const double v1 = (1.0 / constants[18]);
    const double v7 = (constants[4] * (constants[3] * constants[5]));
    const double v13 = (1.0 / constants[19]);
    const double v14 = (v1 * (v0 * (constants[13] * v7)));
    const double v15 = ((-0.5) * v14);
    const double v16 = (v1 * ((constants[13] * constants[13]) * v7));
    const double v17 = ((-0.5) * v16);
    const double v18 = ((-0.5) * (v1 * (constants[12] * constants[14])));
    const double v19 = (v13 * (v0 * (constants[12] * v7)));
    const double v20 = ((-0.5) * v19);
    const double v21 = (0.5 * (v13 * (v7 * (constants[12] * constants[12]))));
    const double v22 = (v21 + v21);
    const double v28 = ((-0.5) * (constants[10] * v19));
    const double v31 = (constants[10] * v22);
    const double v32 = ((-0.5) * (constants[10] * v14));
    const double v35 = (constants[10] * constants[11]);
    const double v37 = ((-0.5) * (constants[10] * v16));
    const double v39 = (constants[10] * (((-0.5) * (v1 * (constants[0] * (constants[1] * constants[7])))) + ((-0.5) * (v1 * (constants[4] * (constants[3] * constants[7]))))));
    const double v40 = ((-0.5) * (constants[11] * v19));
    const double v41 = (constants[11] * v22);
    const double v42 = ((-0.5) * (constants[11] * (v13 * (constants[4] * (constants[5] * constants[7])))));
    const double v43 = ((-0.5) * (constants[11] * v14));
    const double v44 = ((-0.5) * (constants[11] * v16));
    const double v46 = ((-0.5) * (constants[12] * v13));
    const double v48 = (0.5 * (constants[12] * v1));
    const double v49 = ((-0.5) * (constants[13] * v13));
    const double v51 = (v17 + v17);
    const double v52 = (0.5 * (constants[13] * v1));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[32][BLOCK] __attribute__((aligned(64)));
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
            const double v23 = (v10 * multipliers_column[3][i]);
            const double v24 = (v6 * multipliers_column[3][i]);
            const double v25 = ((v20 * ((local_column[6][i] - local_column[2][i]) * multipliers_column[3][i])) + (v15 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])));
            const double v26 = (v10 * multipliers_column[2][i]);
            const double v27 = (v6 * multipliers_column[2][i]);
            const double v29 = (v28 * v24);
            const double v30 = (local_column[2][i] * (v11 * multipliers_column[3][i]));
            const double v33 = (v32 * v27);
            const double v34 = ((v11 * v25) + (v6 * ((v21 * ((local_column[2][i] * local_column[2][i]) * multipliers_column[3][i])) + (v17 * ((local_column[3][i] * local_column[3][i]) * multipliers_column[2][i])))));
            const double v36 = (local_column[3][i] * (v11 * multipliers_column[2][i]));
            const double v38 = (v37 * v36);
            const double v45 = (v44 * v36);
            const double v47 = (v40 * v23);
            const double v50 = (v43 * v26);
            const double v53 = (local_column[6][i] * (v12 * multipliers_column[3][i]));
            const double v54 = ((v12 * v25) + (v10 * ((v21 * ((local_column[6][i] * local_column[6][i]) * multipliers_column[3][i])) + (v17 * ((local_column[7][i] * local_column[7][i]) * multipliers_column[2][i])))));
            const double v55 = (local_column[7][i] * (v12 * multipliers_column[2][i]));
            const double v56 = (v37 * v55);
            const double v57 = (v44 * v55);
            value[0][i] = (-(constants[10] * ((constants[10] * v34) + (v39 * (sin(v2) * multipliers_column[2][i])))));
            value[1][i] = (v35 * v34);
            value[2][i] = (-(constants[11] * ((v42 * (sin(v4) * multipliers_column[3][i])) + (constants[11] * v34))));
            value[3][i] = (v29 + (v31 * v30));
            value[4][i] = (-((v40 * v24) + (v41 * v30)));
            value[5][i] = (v22 * v24);
            value[6][i] = (v38 + (v33 + v38));
            value[7][i] = (-(v45 + ((v43 * v27) + v45)));
            value[8][i] = (v51 * v27);
            value[9][i] = (v28 * v23);
            value[10][i] = (v32 * v26);
            value[11][i] = (-(constants[10] * ((constants[10] * v54) + (v39 * (sin(v3) * multipliers_column[2][i])))));
            value[12][i] = (-v47);
            value[13][i] = (-v50);
            value[14][i] = (v35 * v54);
            value[15][i] = (-(constants[11] * ((v42 * (sin(v8) * multipliers_column[3][i])) + (constants[11] * v54))));
            value[16][i] = (-v29);
            value[17][i] = (v40 * v24);
            value[18][i] = ((v31 * v53) - (v28 * v23));
            value[19][i] = (v47 - (v41 * v53));
            value[20][i] = (v22 * v23);
            value[21][i] = (-v33);
            value[22][i] = (v43 * v27);
            value[23][i] = (v56 + (v56 - (v32 * v26)));
            value[24][i] = ((v50 - v57) - v57);
            value[25][i] = (v51 * v26);
            value[26][i] = (v18 * multipliers_column[2][i]);
            value[27][i] = (v18 * multipliers_column[2][i]);
            value[28][i] = (-(constants[15] * ((v46 * multipliers_column[3][i]) + (v48 * multipliers_column[2][i]))));
            value[29][i] = (constants[15] * ((v49 * multipliers_column[3][i]) + (v52 * multipliers_column[2][i])));
            value[30][i] = (-(constants[15] * ((v46 * multipliers_column[3][i]) + (v48 * multipliers_column[2][i]))));
            value[31][i] = (constants[15] * ((v49 * multipliers_column[3][i]) + (v52 * multipliers_column[2][i])));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 32; j++) out[index[k * 32 + j]] += value[j][i];
        }
    }
}
