// 5f6cfdb69cdf67f68df8ff36d2d0e07a
// {"name": "standing on a moving platform, FullStatePD interval", "m": 4, "n_local": 8, "n_shared": 10, "n_data": 3, "n_constants": 28, "jacobian": [[0, 0], [0, 4], [0, 6], [1, 1], [1, 5], [1, 7], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [2, 8], [2, 9], [2, 10], [2, 11], [2, 16], [2, 17], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7], [3, 12], [3, 13], [3, 14], [3, 15], [3, 16], [3, 17]], "hessian": [[4, 4], [5, 2], [5, 3], [5, 4], [5, 5], [6, 5], [6, 6], [7, 5], [7, 6], [7, 7], [8, 4], [9, 5], [10, 6], [11, 7], [12, 4], [13, 5], [14, 6], [15, 7], [16, 8], [16, 12], [17, 9], [17, 13]]}
// local[0]: ankle_angle#0
// local[1]: hip_angle#0
// local[2]: ankle_velocity#0
// local[3]: hip_velocity#0
// local[4]: ankle_angle#1
// local[5]: hip_angle#1
// local[6]: ankle_velocity#1
// local[7]: hip_velocity#1
// shared[0]: kp_aa
// shared[1]: kp_ah
// shared[2]: kd_aa
// shared[3]: kd_ah
// shared[4]: kp_ha
// shared[5]: kp_hh
// shared[6]: kd_ha
// shared[7]: kd_hh
// shared[8]: ref_ankle
// shared[9]: ref_hip
// data[0]: platform_acceleration#0
// data[1]: ankle_torque_noise
// data[2]: hip_torque_noise
// constants[0]: leg_mass
// constants[1]: leg_com
// constants[2]: leg_inertia
// constants[3]: leg_length
// constants[4]: trunk_mass
// constants[5]: trunk_com
// constants[6]: trunk_inertia
// constants[7]: gravity
// constants[8]: friction_speed
// constants[9]: step h
// constants[10]: scale ankle_angle
// constants[11]: scale hip_angle
// constants[12]: scale ankle_velocity
// constants[13]: scale hip_velocity
// constants[14]: scale kp_aa
// constants[15]: scale kp_ah
// constants[16]: scale kd_aa
// constants[17]: scale kd_ah
// constants[18]: scale kp_ha
// constants[19]: scale kp_hh
// constants[20]: scale kd_ha
// constants[21]: scale kd_hh
// constants[22]: scale ref_ankle
// constants[23]: scale ref_hip
// constants[24]: scale ankle_kinematics
// constants[25]: scale hip_kinematics
// constants[26]: scale ankle_balance
// constants[27]: scale hip_balance
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
    const double v0 = (1.0 / constants[24]);
    const double v1 = (1.0 / constants[9]);
    const double v2 = (constants[10] * v1);
    const double v3 = (1.0 / constants[25]);
    const double v5 = (constants[11] * v1);
    const double v6 = (1.0 / constants[26]);
    const double v10 = (constants[1] * constants[7]);
    const double v15 = (shared[8] * constants[22]);
    const double v17 = (shared[0] * constants[14]);
    const double v18 = (shared[9] * constants[23]);
    const double v20 = (shared[1] * constants[15]);
    const double v21 = (constants[16] * (shared[2] * constants[12]));
    const double v22 = (constants[17] * (shared[3] * constants[13]));
    const double v24 = (constants[4] * (constants[5] * constants[5]));
    const double v26 = (constants[4] * (constants[3] * constants[5]));
    const double v27 = (2.0 * v26);
    const double v28 = (v24 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v29 = (constants[12] * v1);
    const double v31 = (constants[6] + v24);
    const double v33 = (constants[13] * v1);
    const double v34 = (2.0 * constants[12]);
    const double v36 = (constants[4] * (constants[5] * (constants[3] * constants[13])));
    const double v37 = (1.0 / constants[27]);
    const double v38 = (constants[5] * constants[7]);
    const double v39 = (shared[4] * constants[18]);
    const double v40 = (shared[5] * constants[19]);
    const double v41 = (constants[20] * (shared[6] * constants[12]));
    const double v42 = (constants[21] * (shared[7] * constants[13]));
    const double v43 = (v31 * v33);
    const double v44 = (v26 * (constants[12] * constants[12]));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[3][BLOCK] __attribute__((aligned(64)));
        double value[4][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 3; j++) data_column[j][i] = data[k * 3 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v4 = (constants[13] * local_column[7][i]);
            const double v7 = (constants[10] * local_column[4][i]);
            const double v8 = cos(v7);
            const double v9 = sin(v7);
            const double v11 = (constants[11] * local_column[5][i]);
            const double v12 = (v7 + v11);
            const double v13 = sin(v12);
            const double v14 = cos(v12);
            const double v16 = (v7 - v15);
            const double v19 = (v11 - v18);
            const double v23 = (local_column[6][i] - local_column[2][i]);
            const double v25 = cos(v11);
            const double v30 = (local_column[7][i] - local_column[3][i]);
            const double v32 = (v31 + (v26 * v25));
            const double v35 = sin(v11);
            value[0][i] = (v0 * ((constants[12] * local_column[6][i]) - (v2 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v3 * (v4 - (v5 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v6 * ((v36 * (v35 * (local_column[7][i] * (v4 + (v34 * local_column[6][i]))))) - ((v33 * (v30 * v32)) + ((v29 * (v23 * (v28 + (v27 * v25)))) + ((v22 * local_column[7][i]) + ((v21 * local_column[6][i]) + ((v20 * v19) + ((v17 * v16) + ((constants[4] * ((data_column[0][i] * ((constants[3] * v8) + (constants[5] * v14))) - (constants[7] * ((constants[3] * v9) + (constants[5] * v13))))) + (data_column[1][i] + (constants[0] * ((constants[1] * (data_column[0][i] * v8)) - (v10 * v9)))))))))))));
            value[3][i] = (-(v37 * ((v44 * (v35 * (local_column[6][i] * local_column[6][i]))) + ((v43 * v30) + ((v29 * (v23 * v32)) + ((v42 * local_column[7][i]) + ((v41 * local_column[6][i]) + ((v40 * v19) + ((v39 * v16) + (data_column[2][i] + (constants[4] * ((constants[5] * (data_column[0][i] * v14)) - (v38 * v13)))))))))))));
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
    const double v0 = (1.0 / constants[24]);
    const double v1 = (1.0 / constants[9]);
    const double v2 = (1.0 / constants[25]);
    const double v3 = (1.0 / constants[26]);
    const double v8 = (shared[8] * constants[22]);
    const double v10 = (shared[9] * constants[23]);
    const double v13 = (constants[4] * (constants[5] * constants[5]));
    const double v15 = (constants[4] * (constants[3] * constants[5]));
    const double v16 = (2.0 * v15);
    const double v17 = (v13 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v18 = (constants[12] * v1);
    const double v19 = (constants[6] + v13);
    const double v21 = (constants[13] * v1);
    const double v22 = (2.0 * constants[12]);
    const double v25 = (1.0 / constants[27]);
    const double v26 = (v3 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v28 = (2.0 * (constants[12] * v26));
    const double v29 = (v3 * v21);
    const double v30 = (v15 * v29);
    const double v31 = (v3 * v18);
    const double v32 = (2.0 * (v15 * v31));
    const double v33 = (v3 * (constants[17] * (shared[3] * constants[13])));
    const double v34 = (constants[13] * (constants[17] * v3));
    const double v35 = (v3 * (constants[16] * (shared[2] * constants[12])));
    const double v36 = (constants[12] * (constants[16] * v3));
    const double v37 = (v3 * (shared[1] * constants[15]));
    const double v38 = (constants[15] * v3);
    const double v39 = (v3 * (shared[0] * constants[14]));
    const double v40 = (constants[14] * v3);
    const double v41 = (constants[4] * v3);
    const double v42 = (constants[5] * v41);
    const double v44 = (constants[7] * v41);
    const double v45 = (constants[5] * v44);
    const double v47 = (constants[0] * v3);
    const double v48 = ((constants[3] * v44) + ((constants[1] * constants[7]) * v47));
    const double v49 = ((constants[3] * v41) + (constants[1] * v47));
    const double v50 = (constants[13] * v26);
    const double v51 = (v25 * (v15 * (constants[12] * constants[12])));
    const double v52 = (v51 + v51);
    const double v53 = (v18 * v25);
    const double v54 = (constants[13] * (constants[21] * v25));
    const double v55 = (v25 * (constants[20] * (shared[6] * constants[12])));
    const double v56 = (constants[12] * (constants[20] * v25));
    const double v57 = (v25 * (shared[5] * constants[19]));
    const double v58 = (constants[19] * v25);
    const double v59 = (v25 * (shared[4] * constants[18]));
    const double v60 = (constants[18] * v25);
    const double v61 = (constants[4] * v25);
    const double v62 = ((constants[5] * constants[7]) * v61);
    const double v63 = (constants[5] * v61);
    const double v64 = (v15 * v53);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[3][BLOCK] __attribute__((aligned(64)));
        double value[30][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 3; j++) data_column[j][i] = data[k * 3 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v4 = (constants[10] * local_column[4][i]);
            const double v5 = (constants[11] * local_column[5][i]);
            const double v6 = (v4 + v5);
            const double v7 = cos(v6);
            const double v9 = (v4 - v8);
            const double v11 = (v5 - v10);
            const double v12 = (local_column[6][i] - local_column[2][i]);
            const double v14 = cos(v5);
            const double v20 = (v19 + (v15 * v14));
            const double v23 = ((constants[13] * local_column[7][i]) + (v22 * local_column[6][i]));
            const double v24 = sin(v5);
            const double v27 = (local_column[7][i] * v24);
            const double v43 = (data_column[0][i] * sin(v6));
            const double v46 = ((v42 * v43) + (v45 * v7));
            const double v65 = ((v63 * v43) + (v62 * v7));
            value[0][i] = (v0 * (constants[10] * v1));
            value[1][i] = (-(v0 * (constants[10] * v1)));
            value[2][i] = (constants[12] * v0);
            value[3][i] = (v2 * (constants[11] * v1));
            value[4][i] = (-(v2 * (constants[11] * v1)));
            value[5][i] = (constants[13] * v2);
            value[6][i] = (v31 * (v17 + (v16 * v14)));
            value[7][i] = (v29 * v20);
            value[8][i] = (constants[10] * (((v46 - v39) + (v48 * cos(v4))) + (v49 * (data_column[0][i] * sin(v4)))));
            value[9][i] = (constants[11] * ((((v26 * (v14 * (local_column[7][i] * v23))) + (v24 * ((v30 * (local_column[7][i] - local_column[3][i])) + (v32 * v12)))) - v37) + v46));
            value[10][i] = (((v28 * v27) - (v31 * (v17 + (v16 * v14)))) - v35);
            value[11][i] = ((((v26 * (v23 * v24)) - (v29 * v20)) - v33) + (v50 * v27));
            value[12][i] = (-(v40 * v9));
            value[13][i] = (-(v38 * v11));
            value[14][i] = (-(v36 * local_column[6][i]));
            value[15][i] = (-(v34 * local_column[7][i]));
            value[16][i] = (constants[22] * v39);
            value[17][i] = (constants[23] * v37);
            value[18][i] = (v53 * v20);
            value[19][i] = (v25 * (v19 * v21));
            value[20][i] = (constants[10] * (v65 - v59));
            value[21][i] = (constants[11] * ((((v64 * (v12 * v24)) - (v51 * (v14 * (local_column[6][i] * local_column[6][i])))) - v57) + v65));
            value[22][i] = (-((v53 * v20) + (v55 + (v52 * (local_column[6][i] * v24)))));
            value[23][i] = (-((v25 * (v19 * v21)) + (v25 * (constants[21] * (shared[7] * constants[13])))));
            value[24][i] = (-(v60 * v9));
            value[25][i] = (-(v58 * v11));
            value[26][i] = (-(v56 * local_column[6][i]));
            value[27][i] = (-(v54 * local_column[7][i]));
            value[28][i] = (constants[22] * v59);
            value[29][i] = (constants[23] * v57);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 30; j++) out[k * 30 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[9]);
    const double v1 = (1.0 / constants[26]);
    const double v7 = (constants[4] * (constants[3] * constants[5]));
    const double v8 = (constants[12] * v0);
    const double v9 = (2.0 * constants[12]);
    const double v12 = (1.0 / constants[27]);
    const double v13 = (v1 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v14 = (constants[12] * v13);
    const double v15 = (2.0 * v14);
    const double v16 = (v1 * (constants[13] * v0));
    const double v17 = (v1 * v8);
    const double v18 = (2.0 * (v7 * v17));
    const double v19 = (constants[13] * (constants[17] * v1));
    const double v20 = (constants[12] * (constants[16] * v1));
    const double v21 = (constants[15] * v1);
    const double v22 = (constants[14] * v1);
    const double v23 = (constants[4] * v1);
    const double v24 = (constants[5] * v23);
    const double v25 = (constants[7] * v23);
    const double v26 = (constants[5] * v25);
    const double v27 = (constants[0] * v1);
    const double v28 = (constants[13] * v13);
    const double v29 = (v12 * (v7 * (constants[12] * constants[12])));
    const double v30 = (v29 + v29);
    const double v31 = (v8 * v12);
    const double v32 = (constants[13] * (constants[21] * v12));
    const double v33 = (constants[12] * (constants[20] * v12));
    const double v34 = (constants[19] * v12);
    const double v35 = (constants[18] * v12);
    const double v36 = (constants[4] * v12);
    const double v37 = ((constants[5] * constants[7]) * v36);
    const double v38 = (constants[5] * v36);
    const double v39 = (v7 * v31);
    const double v43 = (constants[11] * (v7 * v16));
    const double v44 = (constants[10] * v35);
    const double v45 = (constants[10] * v22);
    const double v47 = (constants[10] * constants[11]);
    const double v48 = (constants[10] * ((constants[3] * v25) + ((constants[1] * constants[7]) * v27)));
    const double v49 = (constants[10] * ((constants[3] * v23) + (constants[1] * v27)));
    const double v50 = (constants[11] * v7);
    const double v51 = (constants[11] * v30);
    const double v52 = (v31 * v50);
    const double v53 = (constants[11] * v34);
    const double v55 = (constants[11] * v13);
    const double v57 = (2.0 * (constants[11] * v14));
    const double v58 = (v16 * v50);
    const double v59 = (2.0 * (v17 * v50));
    const double v60 = (constants[11] * v21);
    const double v61 = (constants[11] * constants[11]);
    const double v62 = (constants[13] * v55);
    const double v63 = (v28 + v28);
    const double v64 = (constants[22] * v22);
    const double v65 = (constants[23] * v21);
    const double v66 = (constants[22] * v35);
    const double v67 = (constants[23] * v34);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[3][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[22][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 3; j++) data_column[j][i] = data[k * 3 + j];
            for (int j = 0; j < 4; j++) multipliers_column[j][i] = multipliers[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v2 = (constants[10] * local_column[4][i]);
            const double v3 = (constants[11] * local_column[5][i]);
            const double v4 = (v2 + v3);
            const double v5 = (local_column[6][i] - local_column[2][i]);
            const double v6 = cos(v3);
            const double v10 = ((constants[13] * local_column[7][i]) + (v9 * local_column[6][i]));
            const double v11 = sin(v3);
            const double v40 = (v11 * multipliers_column[3][i]);
            const double v41 = (v11 * multipliers_column[2][i]);
            const double v42 = (data_column[0][i] * multipliers_column[2][i]);
            const double v46 = ((cos(v4) * ((v38 * (data_column[0][i] * multipliers_column[3][i])) + (v24 * v42))) - (sin(v4) * ((v37 * multipliers_column[3][i]) + (v26 * multipliers_column[2][i]))));
            const double v54 = (v6 * multipliers_column[2][i]);
            const double v56 = (local_column[7][i] * v54);
            value[0][i] = (constants[10] * (((constants[10] * v46) - (v48 * (sin(v2) * multipliers_column[2][i]))) + (v49 * (cos(v2) * v42))));
            value[1][i] = (-(constants[11] * (v11 * ((v39 * multipliers_column[3][i]) + (v18 * multipliers_column[2][i])))));
            value[2][i] = (-(v43 * v41));
            value[3][i] = (v47 * v46);
            value[4][i] = (v61 * (v46 + ((v6 * ((v7 * ((v31 * (v5 * multipliers_column[3][i])) + (v16 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) + (v18 * (v5 * multipliers_column[2][i])))) - (v11 * ((v13 * ((local_column[7][i] * v10) * multipliers_column[2][i])) - (v29 * ((local_column[6][i] * local_column[6][i]) * multipliers_column[3][i])))))));
            value[5][i] = (((v57 * v56) - (v51 * (local_column[6][i] * (v6 * multipliers_column[3][i])))) + ((v52 * v40) + (v59 * v41)));
            value[6][i] = (-(v30 * v40));
            value[7][i] = (((v55 * (v10 * v54)) + (v58 * v41)) + (v62 * v56));
            value[8][i] = (v15 * v41);
            value[9][i] = (v63 * v41);
            value[10][i] = (-(v45 * multipliers_column[2][i]));
            value[11][i] = (-(v60 * multipliers_column[2][i]));
            value[12][i] = (-(v20 * multipliers_column[2][i]));
            value[13][i] = (-(v19 * multipliers_column[2][i]));
            value[14][i] = (-(v44 * multipliers_column[3][i]));
            value[15][i] = (-(v53 * multipliers_column[3][i]));
            value[16][i] = (-(v33 * multipliers_column[3][i]));
            value[17][i] = (-(v32 * multipliers_column[3][i]));
            value[18][i] = (v64 * multipliers_column[2][i]);
            value[19][i] = (v66 * multipliers_column[3][i]);
            value[20][i] = (v65 * multipliers_column[2][i]);
            value[21][i] = (v67 * multipliers_column[3][i]);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 22; j++) out[index[k * 22 + j]] += value[j][i];
        }
    }
}
