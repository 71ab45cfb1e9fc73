// 732f99df1c9e3a03c94a52fa01cf2d8e
// {"name": "standing on a moving platform, FullStatePD interval", "m": 16, "n_local": 20, "n_shared": 10, "n_data": 5, "n_constants": 28, "jacobian": [[0, 2], [0, 4], [1, 3], [1, 5], [2, 0], [2, 1], [2, 2], [2, 3], [2, 6], [2, 7], [2, 20], [2, 21], [2, 22], [2, 23], [2, 28], [2, 29], [3, 0], [3, 1], [3, 2], [3, 3], [3, 6], [3, 7], [3, 24], [3, 25], [3, 26], [3, 27], [3, 28], [3, 29], [4, 2], [4, 6], [4, 8], [4, 10], [4, 14], [5, 3], [5, 7], [5, 9], [5, 11], [5, 15], [6, 0], [6, 1], [6, 2], [6, 3], [6, 4], [6, 5], [6, 6], [6, 7], [6, 8], [6, 9], [6, 10], [6, 11], [6, 12], [6, 13], [6, 14], [6, 15], [6, 20], [6, 21], [6, 22], [6, 23], [6, 28], [6, 29], [7, 0], [7, 1], [7, 2], [7, 3], [7, 4], [7, 5], [7, 6], [7, 7], [7, 8], [7, 9], [7, 10], [7, 11], [7, 12], [7, 13], [7, 14], [7, 15], [7, 24], [7, 25], [7, 26], [7, 27], [7, 28], [7, 29], [8, 12], [8, 18], [9, 13], [9, 19], [10, 14], [10, 15], [10, 16], [10, 17], [10, 18], [10, 19], [10, 20], [10, 21], [10, 22], [10, 23], [10, 28], [10, 29], [11, 14], [11, 15], [11, 16], [11, 17], [11, 18], [11, 19], [11, 24], [11, 25], [11, 26], [11, 27], [11, 28], [11, 29], [12, 0], [12, 4], [12, 8], [12, 12], [12, 16], [13, 1], [13, 5], [13, 9], [13, 13], [13, 17], [14, 2], [14, 6], [14, 10], [14, 14], [14, 18], [15, 3], [15, 7], [15, 11], [15, 15], [15, 19]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 1], [2, 2], [3, 1], [3, 2], [3, 3], [4, 0], [4, 1], [4, 4], [5, 0], [5, 1], [5, 2], [5, 3], [5, 4], [5, 5], [6, 1], [6, 2], [6, 3], [6, 5], [6, 6], [7, 1], [7, 2], [7, 3], [7, 5], [7, 6], [7, 7], [8, 0], [8, 1], [8, 4], [8, 5], [8, 8], [9, 0], [9, 1], [9, 2], [9, 3], [9, 4], [9, 5], [9, 6], [9, 7], [9, 8], [9, 9], [10, 1], [10, 2], [10, 3], [10, 5], [10, 6], [10, 7], [10, 9], [10, 10], [11, 1], [11, 2], [11, 3], [11, 5], [11, 6], [11, 7], [11, 9], [11, 10], [11, 11], [12, 0], [12, 1], [12, 4], [12, 5], [12, 8], [12, 9], [12, 12], [13, 0], [13, 1], [13, 2], [13, 3], [13, 4], [13, 5], [13, 6], [13, 7], [13, 8], [13, 9], [13, 10], [13, 11], [13, 12], [13, 13], [14, 1], [14, 2], [14, 3], [14, 5], [14, 6], [14, 7], [14, 9], [14, 10], [14, 11], [14, 13], [14, 14], [15, 1], [15, 2], [15, 3], [15, 5], [15, 6], [15, 7], [15, 9], [15, 10], [15, 11], [15, 13], [15, 14], [15, 15], [16, 16], [17, 14], [17, 15], [17, 16], [17, 17], [18, 17], [18, 18], [19, 17], [19, 18], [19, 19], [20, 0], [20, 4], [20, 8], [20, 12], [20, 16], [21, 1], [21, 5], [21, 9], [21, 13], [21, 17], [22, 2], [22, 6], [22, 10], [22, 14], [22, 18], [23, 3], [23, 7], [23, 11], [23, 15], [23, 19], [24, 0], [24, 4], [24, 8], [24, 12], [24, 16], [25, 1], [25, 5], [25, 9], [25, 13], [25, 17], [26, 2], [26, 6], [26, 10], [26, 14], [26, 18], [27, 3], [27, 7], [27, 11], [27, 15], [27, 19], [28, 20], [28, 24], [29, 21], [29, 25]]}
// local[0]: ankle_angle#0
// local[1]: hip_angle#0
// local[2]: ankle_velocity#0
// local[3]: hip_velocity#0
// local[4]: ankle_angle#1
// local[5]: hip_angle#1
// local[6]: ankle_velocity#1
// local[7]: hip_velocity#1
// local[8]: ankle_angle#2
// local[9]: hip_angle#2
// local[10]: ankle_velocity#2
// local[11]: hip_velocity#2
// local[12]: ankle_angle#3
// local[13]: hip_angle#3
// local[14]: ankle_velocity#3
// local[15]: hip_velocity#3
// local[16]: ankle_angle#4
// local[17]: hip_angle#4
// local[18]: ankle_velocity#4
// local[19]: hip_velocity#4
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
// data[1]: platform_acceleration#1
// data[2]: platform_acceleration#2
// data[3]: ankle_torque_noise
// data[4]: hip_torque_noise
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
    const double v22 = (constants[4] * (constants[5] * constants[5]));
    const double v24 = (constants[4] * (constants[3] * constants[5]));
    const double v25 = (2.0 * v24);
    const double v26 = (v22 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v27 = (constants[12] * v1);
    const double v28 = (constants[17] * (shared[3] * constants[13]));
    const double v29 = (constants[6] + v22);
    const double v31 = (constants[13] * v1);
    const double v32 = (2.0 * constants[12]);
    const double v34 = (constants[4] * (constants[5] * (constants[3] * constants[13])));
    const double v35 = (1.0 / constants[27]);
    const double v36 = (constants[5] * constants[7]);
    const double v37 = (shared[4] * constants[18]);
    const double v38 = (shared[5] * constants[19]);
    const double v39 = (constants[20] * (shared[6] * constants[12]));
    const double v40 = (constants[21] * (shared[7] * constants[13]));
    const double v41 = (v29 * v31);
    const double v42 = (v24 * (constants[12] * constants[12]));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[20][BLOCK] __attribute__((aligned(64)));
        double data_column[5][BLOCK] __attribute__((aligned(64)));
        double value[16][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 20; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 5; j++) data_column[j][i] = data[k * 5 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v4 = (constants[13] * local_column[3][i]);
            const double v7 = (constants[10] * local_column[0][i]);
            const double v8 = cos(v7);
            const double v9 = sin(v7);
            const double v11 = (constants[11] * local_column[1][i]);
            const double v12 = (v7 + v11);
            const double v13 = sin(v12);
            const double v14 = cos(v12);
            const double v16 = (v7 - v15);
            const double v19 = (v11 - v18);
            const double v23 = cos(v11);
            const double v30 = (v29 + (v24 * v23));
            const double v33 = sin(v11);
            const double v43 = (((-0.041666666666666664) * local_column[14][i]) + ((0.20833333333333334 * local_column[6][i]) + (local_column[2][i] + (0.3333333333333333 * local_column[10][i]))));
            const double v44 = (((-0.041666666666666664) * local_column[15][i]) + ((0.20833333333333334 * local_column[7][i]) + (local_column[3][i] + (0.3333333333333333 * local_column[11][i]))));
            const double v45 = (constants[13] * v44);
            const double v46 = (constants[10] * (((-0.041666666666666664) * local_column[12][i]) + ((0.20833333333333334 * local_column[4][i]) + (local_column[0][i] + (0.3333333333333333 * local_column[8][i])))));
            const double v47 = cos(v46);
            const double v48 = sin(v46);
            const double v49 = (constants[11] * (((-0.041666666666666664) * local_column[13][i]) + ((0.20833333333333334 * local_column[5][i]) + (local_column[1][i] + (0.3333333333333333 * local_column[9][i])))));
            const double v50 = (v46 + v49);
            const double v51 = sin(v50);
            const double v52 = cos(v50);
            const double v53 = (v46 - v15);
            const double v54 = (v49 - v18);
            const double v55 = cos(v49);
            const double v56 = (v29 + (v24 * v55));
            const double v57 = sin(v49);
            const double v58 = (constants[13] * local_column[19][i]);
            const double v59 = (constants[10] * local_column[16][i]);
            const double v60 = cos(v59);
            const double v61 = sin(v59);
            const double v62 = (constants[11] * local_column[17][i]);
            const double v63 = (v59 + v62);
            const double v64 = sin(v63);
            const double v65 = cos(v63);
            const double v66 = (v59 - v15);
            const double v67 = (v62 - v18);
            const double v68 = cos(v62);
            const double v69 = (v29 + (v24 * v68));
            const double v70 = sin(v62);
            value[0][i] = (v0 * ((constants[12] * local_column[2][i]) - (v2 * local_column[4][i])));
            value[1][i] = (v3 * (v4 - (v5 * local_column[5][i])));
            value[2][i] = (v6 * ((v34 * (v33 * (local_column[3][i] * (v4 + (v32 * local_column[2][i]))))) - ((v31 * (local_column[7][i] * v30)) + ((v28 * local_column[3][i]) + ((v27 * (local_column[6][i] * (v26 + (v25 * v23)))) + ((v21 * local_column[2][i]) + ((v20 * v19) + ((v17 * v16) + ((constants[4] * ((data_column[0][i] * ((constants[3] * v8) + (constants[5] * v14))) - (constants[7] * ((constants[3] * v9) + (constants[5] * v13))))) + (data_column[3][i] + (constants[0] * ((constants[1] * (data_column[0][i] * v8)) - (v10 * v9)))))))))))));
            value[3][i] = (-(v35 * ((v42 * (v33 * (local_column[2][i] * local_column[2][i]))) + ((v41 * local_column[7][i]) + ((v40 * local_column[3][i]) + ((v27 * (local_column[6][i] * v30)) + ((v39 * local_column[2][i]) + ((v38 * v19) + ((v37 * v16) + (data_column[4][i] + (constants[4] * ((constants[5] * (data_column[0][i] * v14)) - (v36 * v13)))))))))))));
            value[4][i] = (v0 * ((constants[12] * v43) - (v2 * local_column[8][i])));
            value[5][i] = (v3 * (v45 - (v5 * local_column[9][i])));
            value[6][i] = (v6 * ((v34 * (v57 * (v44 * (v45 + (v32 * v43))))) - ((v28 * v44) + ((v21 * v43) + ((v31 * (local_column[11][i] * v56)) + ((v27 * (local_column[10][i] * (v26 + (v25 * v55)))) + ((v20 * v54) + ((v17 * v53) + ((constants[4] * ((data_column[1][i] * ((constants[3] * v47) + (constants[5] * v52))) - (constants[7] * ((constants[3] * v48) + (constants[5] * v51))))) + (data_column[3][i] + (constants[0] * ((constants[1] * (data_column[1][i] * v47)) - (v10 * v48)))))))))))));
            value[7][i] = (-(v35 * ((v42 * (v57 * (v43 * v43))) + ((v40 * v44) + ((v39 * v43) + ((v41 * local_column[11][i]) + ((v27 * (local_column[10][i] * v56)) + ((v38 * v54) + ((v37 * v53) + (data_column[4][i] + (constants[4] * ((constants[5] * (data_column[1][i] * v52)) - (v36 * v51)))))))))))));
            value[8][i] = (v0 * ((constants[12] * local_column[18][i]) - (v2 * local_column[12][i])));
            value[9][i] = (v3 * (v58 - (v5 * local_column[13][i])));
            value[10][i] = (v6 * ((v34 * (v70 * (local_column[19][i] * (v58 + (v32 * local_column[18][i]))))) - ((v28 * local_column[19][i]) + ((v31 * (local_column[15][i] * v69)) + ((v21 * local_column[18][i]) + ((v27 * (local_column[14][i] * (v26 + (v25 * v68)))) + ((v20 * v67) + ((v17 * v66) + ((constants[4] * ((data_column[2][i] * ((constants[3] * v60) + (constants[5] * v65))) - (constants[7] * ((constants[3] * v61) + (constants[5] * v64))))) + (data_column[3][i] + (constants[0] * ((constants[1] * (data_column[2][i] * v60)) - (v10 * v61)))))))))))));
            value[11][i] = (-(v35 * ((v42 * (v70 * (local_column[18][i] * local_column[18][i]))) + ((v40 * local_column[19][i]) + ((v41 * local_column[15][i]) + ((v39 * local_column[18][i]) + ((v27 * (local_column[14][i] * v69)) + ((v38 * v67) + ((v37 * v66) + (data_column[4][i] + (constants[4] * ((constants[5] * (data_column[2][i] * v65)) - (v36 * v64)))))))))))));
            value[12][i] = (((-0.6666666666666666) * local_column[8][i]) + (((-0.16666666666666666) * local_column[12][i]) + (((-0.16666666666666666) * local_column[4][i]) + (local_column[16][i] - local_column[0][i]))));
            value[13][i] = (((-0.6666666666666666) * local_column[9][i]) + (((-0.16666666666666666) * local_column[13][i]) + (((-0.16666666666666666) * local_column[5][i]) + (local_column[17][i] - local_column[1][i]))));
            value[14][i] = (((-0.6666666666666666) * local_column[10][i]) + (((-0.16666666666666666) * local_column[14][i]) + (((-0.16666666666666666) * local_column[6][i]) + (local_column[18][i] - local_column[2][i]))));
            value[15][i] = (((-0.6666666666666666) * local_column[11][i]) + (((-0.16666666666666666) * local_column[15][i]) + (((-0.16666666666666666) * local_column[7][i]) + (local_column[19][i] - local_column[3][i]))));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 16; j++) out[k * 16 + j] = value[j][i];
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
    const double v12 = (constants[4] * (constants[5] * constants[5]));
    const double v14 = (constants[4] * (constants[3] * constants[5]));
    const double v15 = (2.0 * v14);
    const double v16 = (v12 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v17 = (constants[12] * v1);
    const double v18 = (constants[6] + v12);
    const double v20 = (constants[13] * v1);
    const double v21 = (2.0 * constants[12]);
    const double v24 = (1.0 / constants[27]);
    const double v47 = (constants[12] * v0);
    const double v48 = (constants[13] * v2);
    const double v49 = (v3 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v51 = (2.0 * (constants[12] * v49));
    const double v52 = (v3 * v20);
    const double v53 = (v14 * v52);
    const double v54 = (v3 * (constants[17] * (shared[3] * constants[13])));
    const double v55 = (constants[13] * (constants[17] * v3));
    const double v56 = (v3 * v17);
    const double v57 = (2.0 * (v14 * v56));
    const double v58 = (v3 * (constants[16] * (shared[2] * constants[12])));
    const double v59 = (constants[12] * (constants[16] * v3));
    const double v60 = (v3 * (shared[1] * constants[15]));
    const double v61 = (constants[15] * v3);
    const double v62 = (v3 * (shared[0] * constants[14]));
    const double v63 = (constants[14] * v3);
    const double v64 = (constants[4] * v3);
    const double v65 = (constants[5] * v64);
    const double v67 = (constants[7] * v64);
    const double v68 = (constants[5] * v67);
    const double v70 = (constants[0] * v3);
    const double v71 = ((constants[3] * v67) + ((constants[1] * constants[7]) * v70));
    const double v72 = ((constants[3] * v64) + (constants[1] * v70));
    const double v73 = (constants[13] * v49);
    const double v74 = (v24 * (v14 * (constants[12] * constants[12])));
    const double v75 = (v74 + v74);
    const double v76 = (v24 * (v18 * v20));
    const double v77 = (v24 * (constants[21] * (shared[7] * constants[13])));
    const double v78 = (constants[13] * (constants[21] * v24));
    const double v79 = (v17 * v24);
    const double v80 = (v24 * (constants[20] * (shared[6] * constants[12])));
    const double v81 = (constants[12] * (constants[20] * v24));
    const double v82 = (v24 * (shared[5] * constants[19]));
    const double v83 = (constants[19] * v24);
    const double v84 = (v24 * (shared[4] * constants[18]));
    const double v85 = (constants[18] * v24);
    const double v86 = (constants[4] * v24);
    const double v87 = ((constants[5] * constants[7]) * v86);
    const double v88 = (constants[5] * v86);
    const double v89 = (v14 * v79);
    const double v96 = ((-0.041666666666666664) * constants[11]);
    const double v97 = (0.20833333333333334 * constants[11]);
    const double v98 = (0.3333333333333333 * constants[11]);
    const double v100 = ((-0.041666666666666664) * constants[10]);
    const double v101 = (0.20833333333333334 * constants[10]);
    const double v102 = (0.3333333333333333 * constants[10]);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[20][BLOCK] __attribute__((aligned(64)));
        double data_column[5][BLOCK] __attribute__((aligned(64)));
        double value[130][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 20; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 5; j++) data_column[j][i] = data[k * 5 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v4 = (constants[10] * local_column[0][i]);
            const double v5 = (constants[11] * local_column[1][i]);
            const double v6 = (v4 + v5);
            const double v7 = cos(v6);
            const double v9 = (v4 - v8);
            const double v11 = (v5 - v10);
            const double v13 = cos(v5);
            const double v19 = (v18 + (v14 * v13));
            const double v22 = ((constants[13] * local_column[3][i]) + (v21 * local_column[2][i]));
            const double v23 = sin(v5);
            const double v25 = (((-0.041666666666666664) * local_column[14][i]) + ((0.20833333333333334 * local_column[6][i]) + (local_column[2][i] + (0.3333333333333333 * local_column[10][i]))));
            const double v26 = (((-0.041666666666666664) * local_column[15][i]) + ((0.20833333333333334 * local_column[7][i]) + (local_column[3][i] + (0.3333333333333333 * local_column[11][i]))));
            const double v27 = (constants[10] * (((-0.041666666666666664) * local_column[12][i]) + ((0.20833333333333334 * local_column[4][i]) + (local_column[0][i] + (0.3333333333333333 * local_column[8][i])))));
            const double v28 = (constants[11] * (((-0.041666666666666664) * local_column[13][i]) + ((0.20833333333333334 * local_column[5][i]) + (local_column[1][i] + (0.3333333333333333 * local_column[9][i])))));
            const double v29 = (v27 + v28);
            const double v30 = cos(v29);
            const double v31 = (v27 - v8);
            const double v32 = (v28 - v10);
            const double v33 = cos(v28);
            const double v34 = (v18 + (v14 * v33));
            const double v35 = ((constants[13] * v26) + (v21 * v25));
            const double v36 = sin(v28);
            const double v37 = (constants[10] * local_column[16][i]);
            const double v38 = (constants[11] * local_column[17][i]);
            const double v39 = (v37 + v38);
            const double v40 = cos(v39);
            const double v41 = (v37 - v8);
            const double v42 = (v38 - v10);
            const double v43 = cos(v38);
            const double v44 = (v18 + (v14 * v43));
            const double v45 = ((constants[13] * local_column[19][i]) + (v21 * local_column[18][i]));
            const double v46 = sin(v38);
            const double v50 = (local_column[3][i] * v23);
            const double v66 = (data_column[0][i] * sin(v6));
            const double v69 = ((v65 * v66) + (v68 * v7));
            const double v90 = ((v88 * v66) + (v87 * v7));
            const double v91 = (v26 * v36);
            const double v92 = ((v51 * v91) - v58);
            const double v93 = (data_column[1][i] * sin(v29));
            const double v94 = ((v65 * v93) + (v68 * v30));
            const double v95 = ((((v49 * (v33 * (v26 * v35))) + (v36 * ((v53 * local_column[11][i]) + (v57 * local_column[10][i])))) - v60) + v94);
            const double v99 = (((v94 - v62) + (v71 * cos(v27))) + (v72 * (data_column[1][i] * sin(v27))));
            const double v103 = (((v49 * (v35 * v36)) - v54) + (v73 * v91));
            const double v104 = (v80 + (v75 * (v25 * v36)));
            const double v105 = ((v88 * v93) + (v87 * v30));
            const double v106 = (v105 - v84);
            const double v107 = ((((v89 * (local_column[10][i] * v36)) - (v74 * (v33 * (v25 * v25)))) - v82) + v105);
            const double v108 = (local_column[19][i] * v46);
            const double v109 = (data_column[2][i] * sin(v39));
            const double v110 = ((v65 * v109) + (v68 * v40));
            const double v111 = ((v88 * v109) + (v87 * v40));
            value[0][i] = v47;
            value[1][i] = (-(v0 * (constants[10] * v1)));
            value[2][i] = v48;
            value[3][i] = (-(v2 * (constants[11] * v1)));
            value[4][i] = (constants[10] * (((v69 - v62) + (v71 * cos(v4))) + (v72 * (data_column[0][i] * sin(v4)))));
            value[5][i] = (constants[11] * ((((v49 * (v13 * (local_column[3][i] * v22))) + (v23 * ((v53 * local_column[7][i]) + (v57 * local_column[6][i])))) - v60) + v69));
            value[6][i] = ((v51 * v50) - v58);
            value[7][i] = (((v49 * (v22 * v23)) - v54) + (v73 * v50));
            value[8][i] = (-(v56 * (v16 + (v15 * v13))));
            value[9][i] = (-(v52 * v19));
            value[10][i] = (-(v63 * v9));
            value[11][i] = (-(v61 * v11));
            value[12][i] = (-(v59 * local_column[2][i]));
            value[13][i] = (-(v55 * local_column[3][i]));
            value[14][i] = (constants[22] * v62);
            value[15][i] = (constants[23] * v60);
            value[16][i] = (constants[10] * (v90 - v84));
            value[17][i] = (constants[11] * ((((v89 * (local_column[6][i] * v23)) - (v74 * (v13 * (local_column[2][i] * local_column[2][i])))) - v82) + v90));
            value[18][i] = (-(v80 + (v75 * (local_column[2][i] * v23))));
            value[19][i] = (-v77);
            value[20][i] = (-(v79 * v19));
            value[21][i] = (-v76);
            value[22][i] = (-(v85 * v9));
            value[23][i] = (-(v83 * v11));
            value[24][i] = (-(v81 * local_column[2][i]));
            value[25][i] = (-(v78 * local_column[3][i]));
            value[26][i] = (constants[22] * v84);
            value[27][i] = (constants[23] * v82);
            value[28][i] = v47;
            value[29][i] = (0.20833333333333334 * v47);
            value[30][i] = (-(v0 * (constants[10] * v1)));
            value[31][i] = (0.3333333333333333 * v47);
            value[32][i] = ((-0.041666666666666664) * v47);
            value[33][i] = v48;
            value[34][i] = (0.20833333333333334 * v48);
            value[35][i] = (-(v2 * (constants[11] * v1)));
            value[36][i] = (0.3333333333333333 * v48);
            value[37][i] = ((-0.041666666666666664) * v48);
            value[38][i] = (constants[10] * v99);
            value[39][i] = (constants[11] * v95);
            value[40][i] = v92;
            value[41][i] = v103;
            value[42][i] = (v101 * v99);
            value[43][i] = (v97 * v95);
            value[44][i] = (0.20833333333333334 * v92);
            value[45][i] = (0.20833333333333334 * v103);
            value[46][i] = (v102 * v99);
            value[47][i] = (v98 * v95);
            value[48][i] = ((0.3333333333333333 * v92) - (v56 * (v16 + (v15 * v33))));
            value[49][i] = ((0.3333333333333333 * v103) - (v52 * v34));
            value[50][i] = (v100 * v99);
            value[51][i] = (v96 * v95);
            value[52][i] = ((-0.041666666666666664) * v92);
            value[53][i] = ((-0.041666666666666664) * v103);
            value[54][i] = (-(v63 * v31));
            value[55][i] = (-(v61 * v32));
            value[56][i] = (-(v59 * v25));
            value[57][i] = (-(v55 * v26));
            value[58][i] = (constants[22] * v62);
            value[59][i] = (constants[23] * v60);
            value[60][i] = (constants[10] * v106);
            value[61][i] = (constants[11] * v107);
            value[62][i] = (-v104);
            value[63][i] = (-v77);
            value[64][i] = (v101 * v106);
            value[65][i] = (v97 * v107);
            value[66][i] = ((-0.20833333333333334) * v104);
            value[67][i] = ((-0.20833333333333334) * v77);
            value[68][i] = (v102 * v106);
            value[69][i] = (v98 * v107);
            value[70][i] = (((-0.3333333333333333) * v104) - (v79 * v34));
            value[71][i] = (((-0.3333333333333333) * v77) - v76);
            value[72][i] = (v100 * v106);
            value[73][i] = (v96 * v107);
            value[74][i] = (0.041666666666666664 * v104);
            value[75][i] = (0.041666666666666664 * v77);
            value[76][i] = (-(v85 * v31));
            value[77][i] = (-(v83 * v32));
            value[78][i] = (-(v81 * v25));
            value[79][i] = (-(v78 * v26));
            value[80][i] = (constants[22] * v84);
            value[81][i] = (constants[23] * v82);
            value[82][i] = (-(v0 * (constants[10] * v1)));
            value[83][i] = v47;
            value[84][i] = (-(v2 * (constants[11] * v1)));
            value[85][i] = v48;
            value[86][i] = (-(v56 * (v16 + (v15 * v43))));
            value[87][i] = (-(v52 * v44));
            value[88][i] = (constants[10] * (((v110 - v62) + (v71 * cos(v37))) + (v72 * (data_column[2][i] * sin(v37)))));
            value[89][i] = (constants[11] * ((((v49 * (v43 * (local_column[19][i] * v45))) + (v46 * ((v53 * local_column[15][i]) + (v57 * local_column[14][i])))) - v60) + v110));
            value[90][i] = ((v51 * v108) - v58);
            value[91][i] = (((v49 * (v45 * v46)) - v54) + (v73 * v108));
            value[92][i] = (-(v63 * v41));
            value[93][i] = (-(v61 * v42));
            value[94][i] = (-(v59 * local_column[18][i]));
            value[95][i] = (-(v55 * local_column[19][i]));
            value[96][i] = (constants[22] * v62);
            value[97][i] = (constants[23] * v60);
            value[98][i] = (-(v79 * v44));
            value[99][i] = (-v76);
            value[100][i] = (constants[10] * (v111 - v84));
            value[101][i] = (constants[11] * ((((v89 * (local_column[14][i] * v46)) - (v74 * (v43 * (local_column[18][i] * local_column[18][i])))) - v82) + v111));
            value[102][i] = (-(v80 + (v75 * (local_column[18][i] * v46))));
            value[103][i] = (-v77);
            value[104][i] = (-(v85 * v41));
            value[105][i] = (-(v83 * v42));
            value[106][i] = (-(v81 * local_column[18][i]));
            value[107][i] = (-(v78 * local_column[19][i]));
            value[108][i] = (constants[22] * v84);
            value[109][i] = (constants[23] * v82);
            value[110][i] = (-1.0);
            value[111][i] = (-0.16666666666666666);
            value[112][i] = (-0.6666666666666666);
            value[113][i] = (-0.16666666666666666);
            value[114][i] = 1.0;
            value[115][i] = (-1.0);
            value[116][i] = (-0.16666666666666666);
            value[117][i] = (-0.6666666666666666);
            value[118][i] = (-0.16666666666666666);
            value[119][i] = 1.0;
            value[120][i] = (-1.0);
            value[121][i] = (-0.16666666666666666);
            value[122][i] = (-0.6666666666666666);
            value[123][i] = (-0.16666666666666666);
            value[124][i] = 1.0;
            value[125][i] = (-1.0);
            value[126][i] = (-0.16666666666666666);
            value[127][i] = (-0.6666666666666666);
            value[128][i] = (-0.16666666666666666);
            value[129][i] = 1.0;
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 130; j++) out[k * 130 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[9]);
    const double v1 = (1.0 / constants[26]);
    const double v6 = (constants[4] * (constants[3] * constants[5]));
    const double v7 = (constants[12] * v0);
    const double v8 = (2.0 * constants[12]);
    const double v11 = (1.0 / constants[27]);
    const double v27 = (v1 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v28 = (constants[12] * v27);
    const double v29 = (2.0 * v28);
    const double v30 = (v1 * (constants[13] * v0));
    const double v31 = (v6 * v30);
    const double v32 = (constants[13] * (constants[17] * v1));
    const double v33 = (v1 * v7);
    const double v34 = (2.0 * (v6 * v33));
    const double v35 = (constants[12] * (constants[16] * v1));
    const double v36 = (constants[15] * v1);
    const double v37 = (constants[14] * v1);
    const double v38 = (constants[4] * v1);
    const double v39 = (constants[5] * v38);
    const double v40 = (constants[7] * v38);
    const double v41 = (constants[5] * v40);
    const double v42 = (constants[0] * v1);
    const double v43 = (constants[13] * v27);
    const double v44 = (v11 * (v6 * (constants[12] * constants[12])));
    const double v45 = (v44 + v44);
    const double v46 = (constants[13] * (constants[21] * v11));
    const double v47 = (v7 * v11);
    const double v48 = (constants[12] * (constants[20] * v11));
    const double v49 = (constants[19] * v11);
    const double v50 = (constants[18] * v11);
    const double v51 = (constants[4] * v11);
    const double v52 = ((constants[5] * constants[7]) * v51);
    const double v53 = (constants[5] * v51);
    const double v54 = (v6 * v47);
    const double v55 = ((-0.041666666666666664) * constants[11]);
    const double v56 = (0.20833333333333334 * constants[11]);
    const double v57 = (0.3333333333333333 * constants[11]);
    const double v58 = ((-0.041666666666666664) * constants[10]);
    const double v59 = (0.20833333333333334 * constants[10]);
    const double v60 = (0.3333333333333333 * constants[10]);
    const double v73 = (constants[10] * constants[11]);
    const double v74 = ((-0.041666666666666664) * v73);
    const double v75 = (0.20833333333333334 * v73);
    const double v76 = (0.3333333333333333 * v73);
    const double v78 = (constants[10] * ((constants[3] * v40) + ((constants[1] * constants[7]) * v42)));
    const double v80 = (constants[10] * ((constants[3] * v38) + (constants[1] * v42)));
    const double v83 = (constants[10] * v50);
    const double v85 = (constants[10] * v37);
    const double v87 = (constants[11] * v6);
    const double v89 = (constants[11] * v45);
    const double v90 = (v47 * v87);
    const double v93 = (constants[11] * v27);
    const double v95 = (constants[11] * v28);
    const double v96 = (2.0 * v95);
    const double v98 = (v30 * v87);
    const double v99 = (v33 * v87);
    const double v100 = (2.0 * v99);
    const double v102 = (constants[11] * constants[11]);
    const double v103 = ((-0.041666666666666664) * v102);
    const double v104 = (0.20833333333333334 * v102);
    const double v105 = (0.3333333333333333 * v102);
    const double v106 = (constants[13] * v93);
    const double v108 = (constants[11] * v44);
    const double v110 = (constants[11] * v49);
    const double v113 = (constants[11] * v36);
    const double v114 = (2.0 * v44);
    const double v116 = ((-0.08333333333333333) * v28);
    const double v117 = (0.4166666666666667 * v28);
    const double v118 = (0.6666666666666666 * v28);
    const double v119 = ((-0.041666666666666664) * v45);
    const double v120 = (0.20833333333333334 * v45);
    const double v121 = (0.3333333333333333 * v45);
    const double v123 = ((-0.041666666666666664) * v93);
    const double v124 = (0.20833333333333334 * v93);
    const double v125 = (0.3333333333333333 * v93);
    const double v126 = (v43 + v43);
    const double v127 = ((-0.041666666666666664) * v126);
    const double v128 = (0.20833333333333334 * v126);
    const double v129 = (0.3333333333333333 * v126);
    const double v131 = ((-0.008680555555555556) * v73);
    const double v132 = (0.04340277777777778 * v73);
    const double v133 = (0.06944444444444445 * v73);
    const double v134 = (0.20833333333333334 * v78);
    const double v135 = (0.20833333333333334 * v80);
    const double v137 = (0.20833333333333334 * v83);
    const double v138 = (0.20833333333333334 * v85);
    const double v139 = (0.20833333333333334 * v89);
    const double v140 = (0.20833333333333334 * v90);
    const double v141 = (0.4166666666666667 * v95);
    const double v143 = (0.20833333333333334 * v98);
    const double v144 = (0.4166666666666667 * v99);
    const double v145 = ((-0.008680555555555556) * v102);
    const double v146 = (0.04340277777777778 * v102);
    const double v147 = (0.06944444444444445 * v102);
    const double v148 = (0.20833333333333334 * v106);
    const double v150 = (0.20833333333333334 * v110);
    const double v151 = (0.20833333333333334 * v113);
    const double v152 = (0.4166666666666667 * v44);
    const double v154 = ((-0.017361111111111112) * v28);
    const double v155 = (0.08680555555555557 * v28);
    const double v156 = (0.1388888888888889 * v28);
    const double v157 = ((-0.008680555555555556) * v45);
    const double v158 = (0.04340277777777778 * v45);
    const double v159 = (0.06944444444444445 * v45);
    const double v160 = (0.20833333333333334 * v48);
    const double v161 = (0.20833333333333334 * v35);
    const double v162 = (0.20833333333333334 * constants[13]);
    const double v163 = (0.20833333333333334 * v43);
    const double v165 = (v163 + v163);
    const double v166 = ((-0.041666666666666664) * v165);
    const double v167 = (0.20833333333333334 * v165);
    const double v168 = (0.3333333333333333 * v165);
    const double v169 = (0.20833333333333334 * v46);
    const double v170 = (0.20833333333333334 * v32);
    const double v171 = ((-0.013888888888888888) * v73);
    const double v172 = (0.1111111111111111 * v73);
    const double v173 = (0.3333333333333333 * v78);
    const double v174 = (0.3333333333333333 * v80);
    const double v176 = (0.3333333333333333 * v83);
    const double v177 = (0.3333333333333333 * v85);
    const double v178 = (0.3333333333333333 * v89);
    const double v179 = (0.3333333333333333 * v90);
    const double v180 = (0.6666666666666666 * v95);
    const double v182 = (0.3333333333333333 * v98);
    const double v183 = (0.6666666666666666 * v99);
    const double v184 = ((-0.013888888888888888) * v102);
    const double v185 = (0.1111111111111111 * v102);
    const double v186 = (0.3333333333333333 * v106);
    const double v188 = (0.3333333333333333 * v110);
    const double v189 = (0.3333333333333333 * v113);
    const double v190 = (0.6666666666666666 * v44);
    const double v191 = ((-0.027777777777777776) * v28);
    const double v192 = (0.2222222222222222 * v28);
    const double v193 = ((-0.013888888888888888) * v45);
    const double v194 = (0.1111111111111111 * v45);
    const double v195 = (0.3333333333333333 * v48);
    const double v196 = (0.3333333333333333 * v35);
    const double v197 = (0.3333333333333333 * constants[13]);
    const double v198 = (0.3333333333333333 * v43);
    const double v199 = (v198 + v198);
    const double v200 = ((-0.041666666666666664) * v199);
    const double v201 = (0.3333333333333333 * v199);
    const double v202 = (0.3333333333333333 * v46);
    const double v203 = (0.3333333333333333 * v32);
    const double v204 = (0.001736111111111111 * v73);
    const double v205 = ((-0.041666666666666664) * v78);
    const double v206 = ((-0.041666666666666664) * v80);
    const double v207 = ((-0.041666666666666664) * v83);
    const double v208 = ((-0.041666666666666664) * v85);
    const double v209 = ((-0.041666666666666664) * v89);
    const double v210 = ((-0.08333333333333333) * v95);
    const double v211 = (0.001736111111111111 * v102);
    const double v212 = ((-0.041666666666666664) * v106);
    const double v213 = ((-0.041666666666666664) * v110);
    const double v214 = ((-0.041666666666666664) * v113);
    const double v215 = (0.003472222222222222 * v28);
    const double v216 = (0.001736111111111111 * v45);
    const double v217 = ((-0.041666666666666664) * v48);
    const double v218 = ((-0.041666666666666664) * v35);
    const double v219 = (constants[11] * v31);
    const double v220 = ((-0.041666666666666664) * v43);
    const double v221 = ((-0.041666666666666664) * (v220 + v220));
    const double v222 = ((-0.041666666666666664) * v46);
    const double v223 = ((-0.041666666666666664) * v32);
    const double v225 = (v108 + v108);
    const double v229 = (constants[22] * v37);
    const double v230 = (constants[23] * v36);
    const double v232 = (constants[22] * v50);
    const double v233 = (constants[23] * v49);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[20][BLOCK] __attribute__((aligned(64)));
        double data_column[5][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[16][BLOCK] __attribute__((aligned(64)));
        double value[158][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 20; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 5; j++) data_column[j][i] = data[k * 5 + j];
            for (int j = 0; j < 16; j++) multipliers_column[j][i] = multipliers[k * 16 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v2 = (constants[10] * local_column[0][i]);
            const double v3 = (constants[11] * local_column[1][i]);
            const double v4 = (v2 + v3);
            const double v5 = cos(v3);
            const double v9 = ((constants[13] * local_column[3][i]) + (v8 * local_column[2][i]));
            const double v10 = sin(v3);
            const double v12 = (((-0.041666666666666664) * local_column[14][i]) + ((0.20833333333333334 * local_column[6][i]) + (local_column[2][i] + (0.3333333333333333 * local_column[10][i]))));
            const double v13 = (((-0.041666666666666664) * local_column[15][i]) + ((0.20833333333333334 * local_column[7][i]) + (local_column[3][i] + (0.3333333333333333 * local_column[11][i]))));
            const double v14 = (constants[13] * v13);
            const double v15 = (constants[10] * (((-0.041666666666666664) * local_column[12][i]) + ((0.20833333333333334 * local_column[4][i]) + (local_column[0][i] + (0.3333333333333333 * local_column[8][i])))));
            const double v16 = (constants[11] * (((-0.041666666666666664) * local_column[13][i]) + ((0.20833333333333334 * local_column[5][i]) + (local_column[1][i] + (0.3333333333333333 * local_column[9][i])))));
            const double v17 = (v15 + v16);
            const double v18 = cos(v16);
            const double v19 = (v14 + (v8 * v12));
            const double v20 = sin(v16);
            const double v21 = (constants[10] * local_column[16][i]);
            const double v22 = (constants[11] * local_column[17][i]);
            const double v23 = (v21 + v22);
            const double v24 = cos(v22);
            const double v25 = ((constants[13] * local_column[19][i]) + (v8 * local_column[18][i]));
            const double v26 = sin(v22);
            const double v61 = (v26 * multipliers_column[10][i]);
            const double v62 = (data_column[2][i] * multipliers_column[10][i]);
            const double v63 = (v20 * multipliers_column[7][i]);
            const double v64 = (v12 * multipliers_column[7][i]);
            const double v65 = (v20 * multipliers_column[6][i]);
            const double v66 = (v13 * multipliers_column[6][i]);
            const double v67 = (data_column[1][i] * multipliers_column[6][i]);
            const double v68 = (v10 * multipliers_column[3][i]);
            const double v69 = (v44 * v68);
            const double v70 = (v10 * multipliers_column[2][i]);
            const double v71 = (data_column[0][i] * multipliers_column[2][i]);
            const double v72 = ((cos(v17) * ((v53 * (data_column[1][i] * multipliers_column[7][i])) + (v39 * v67))) - (sin(v17) * ((v52 * multipliers_column[7][i]) + (v41 * multipliers_column[6][i]))));
            const double v77 = (sin(v15) * multipliers_column[6][i]);
            const double v79 = (cos(v15) * v67);
            const double v81 = (((constants[10] * v72) - (v78 * v77)) + (v80 * v79));
            const double v82 = (multipliers_column[3][i] + multipliers_column[7][i]);
            const double v84 = (multipliers_column[2][i] + multipliers_column[6][i]);
            const double v86 = ((cos(v4) * ((v53 * (data_column[0][i] * multipliers_column[3][i])) + (v39 * v71))) - (sin(v4) * ((v52 * multipliers_column[3][i]) + (v41 * multipliers_column[2][i]))));
            const double v88 = (v12 * (v18 * multipliers_column[7][i]));
            const double v91 = (v18 * multipliers_column[6][i]);
            const double v92 = (v19 * v91);
            const double v94 = (v13 * v91);
            const double v97 = ((v96 * v94) - (v89 * v88));
            const double v101 = (v72 + ((v18 * ((v6 * ((v47 * (local_column[10][i] * multipliers_column[7][i])) + (v30 * (local_column[11][i] * multipliers_column[6][i])))) + (v34 * (local_column[10][i] * multipliers_column[6][i])))) - (v20 * ((v27 * ((v13 * v19) * multipliers_column[6][i])) - (v44 * ((v12 * v12) * multipliers_column[7][i]))))));
            const double v107 = ((v93 * v92) + (v106 * v94));
            const double v109 = (v108 * (local_column[2][i] * (v5 * multipliers_column[3][i])));
            const double v111 = (v5 * multipliers_column[2][i]);
            const double v112 = (local_column[3][i] * v111);
            const double v115 = (v18 * ((v29 * v66) - (v114 * v64)));
            const double v122 = (v18 * (multipliers_column[6][i] * (v14 + v19)));
            const double v130 = (v43 * v70);
            const double v136 = (((v59 * v72) - (v134 * v77)) + (v135 * v79));
            const double v142 = ((v141 * v94) - (v139 * v88));
            const double v149 = ((v124 * v92) + (v148 * v94));
            const double v153 = (v18 * ((v117 * v66) - (v152 * v64)));
            const double v164 = (v18 * (multipliers_column[6][i] * ((0.20833333333333334 * v19) + (v162 * v13))));
            const double v175 = (((v60 * v72) - (v173 * v77)) + (v174 * v79));
            const double v181 = ((v180 * v94) - (v178 * v88));
            const double v187 = ((v125 * v92) + (v186 * v94));
            const double v224 = ((cos(v23) * ((v53 * (data_column[2][i] * multipliers_column[11][i])) + (v39 * v62))) - (sin(v23) * ((v52 * multipliers_column[11][i]) + (v41 * multipliers_column[10][i]))));
            const double v226 = (v24 * multipliers_column[10][i]);
            const double v227 = (local_column[19][i] * v226);
            const double v228 = (multipliers_column[2][i] + (multipliers_column[6][i] + multipliers_column[10][i]));
            const double v231 = (multipliers_column[3][i] + (multipliers_column[7][i] + multipliers_column[11][i]));
            value[0][i] = (constants[10] * (v81 + (((constants[10] * v86) - (v78 * (sin(v2) * multipliers_column[2][i]))) + (v80 * (cos(v2) * v71)))));
            value[1][i] = (v73 * (v72 + v86));
            value[2][i] = (v102 * (v101 + (v86 + ((v5 * ((v6 * ((v47 * (local_column[6][i] * multipliers_column[3][i])) + (v30 * (local_column[7][i] * multipliers_column[2][i])))) + (v34 * (local_column[6][i] * multipliers_column[2][i])))) - (v10 * ((v27 * ((local_column[3][i] * v9) * multipliers_column[2][i])) - (v44 * ((local_column[2][i] * local_column[2][i]) * multipliers_column[3][i]))))))));
            value[3][i] = (((v97 - v109) - v109) + (v96 * v112));
            value[4][i] = (-(v69 + (v69 + (v45 * v63))));
            value[5][i] = ((v107 + (v93 * (v9 * v111))) + (v106 * v112));
            value[6][i] = (v29 * (v65 + v70));
            value[7][i] = (v130 + ((v126 * v65) + v130));
            value[8][i] = (v59 * v81);
            value[9][i] = (v75 * v72);
            value[10][i] = (v59 * v136);
            value[11][i] = (v75 * v72);
            value[12][i] = (v104 * v101);
            value[13][i] = (v56 * v115);
            value[14][i] = (v124 * v122);
            value[15][i] = (v132 * v72);
            value[16][i] = (v146 * v101);
            value[17][i] = (((0.20833333333333334 * v97) + (v90 * v68)) + (v100 * v70));
            value[18][i] = (-(v120 * v63));
            value[19][i] = (v117 * v65);
            value[20][i] = (0.20833333333333334 * v142);
            value[21][i] = (-(v158 * v63));
            value[22][i] = ((0.20833333333333334 * v107) + (v98 * v70));
            value[23][i] = (v117 * v65);
            value[24][i] = (v128 * v65);
            value[25][i] = (0.20833333333333334 * v149);
            value[26][i] = (v155 * v65);
            value[27][i] = (v167 * v65);
            value[28][i] = (v60 * v81);
            value[29][i] = (v76 * v72);
            value[30][i] = (v60 * v136);
            value[31][i] = (v133 * v72);
            value[32][i] = (v60 * v175);
            value[33][i] = (v76 * v72);
            value[34][i] = (v105 * v101);
            value[35][i] = (v57 * v115);
            value[36][i] = (v125 * v122);
            value[37][i] = (v133 * v72);
            value[38][i] = (v147 * v101);
            value[39][i] = (v57 * v153);
            value[40][i] = (v125 * v164);
            value[41][i] = (v172 * v72);
            value[42][i] = (v185 * v101);
            value[43][i] = (((v90 * v63) + (v100 * v65)) + (0.3333333333333333 * v97));
            value[44][i] = (-(v121 * v63));
            value[45][i] = (v118 * v65);
            value[46][i] = (((v140 * v63) + (v144 * v65)) + (0.3333333333333333 * v142));
            value[47][i] = (-(v159 * v63));
            value[48][i] = (v156 * v65);
            value[49][i] = (((v179 * v63) + (v183 * v65)) + (0.3333333333333333 * v181));
            value[50][i] = (-(v194 * v63));
            value[51][i] = ((v98 * v65) + (0.3333333333333333 * v107));
            value[52][i] = (v118 * v65);
            value[53][i] = (v129 * v65);
            value[54][i] = ((v143 * v65) + (0.3333333333333333 * v149));
            value[55][i] = (v156 * v65);
            value[56][i] = (v168 * v65);
            value[57][i] = ((v182 * v65) + (0.3333333333333333 * v187));
            value[58][i] = (v192 * v65);
            value[59][i] = (v201 * v65);
            value[60][i] = (v58 * v81);
            value[61][i] = (v74 * v72);
            value[62][i] = (v58 * v136);
            value[63][i] = (v131 * v72);
            value[64][i] = (v58 * v175);
            value[65][i] = (v171 * v72);
            value[66][i] = (v58 * (((v58 * v72) - (v205 * v77)) + (v206 * v79)));
            value[67][i] = (v74 * v72);
            value[68][i] = (v103 * v101);
            value[69][i] = (v55 * v115);
            value[70][i] = (v123 * v122);
            value[71][i] = (v131 * v72);
            value[72][i] = (v145 * v101);
            value[73][i] = (v55 * v153);
            value[74][i] = (v123 * v164);
            value[75][i] = (v171 * v72);
            value[76][i] = (v184 * v101);
            value[77][i] = (v55 * ((v18 * ((v118 * v66) - (v190 * v64))) + (v20 * ((v54 * multipliers_column[7][i]) + (v34 * multipliers_column[6][i])))));
            value[78][i] = (v55 * ((v27 * (v18 * (multipliers_column[6][i] * ((0.3333333333333333 * v19) + (v197 * v13))))) + (v31 * v65)));
            value[79][i] = (v204 * v72);
            value[80][i] = (v211 * v101);
            value[81][i] = ((-0.041666666666666664) * v97);
            value[82][i] = (-(v119 * v63));
            value[83][i] = (v116 * v65);
            value[84][i] = ((-0.041666666666666664) * v142);
            value[85][i] = (-(v157 * v63));
            value[86][i] = (v154 * v65);
            value[87][i] = ((-0.041666666666666664) * v181);
            value[88][i] = (-(v193 * v63));
            value[89][i] = (v191 * v65);
            value[90][i] = ((-0.041666666666666664) * ((v210 * v94) - (v209 * v88)));
            value[91][i] = (-(v216 * v63));
            value[92][i] = ((-0.041666666666666664) * v107);
            value[93][i] = (v116 * v65);
            value[94][i] = (v127 * v65);
            value[95][i] = ((-0.041666666666666664) * v149);
            value[96][i] = (v154 * v65);
            value[97][i] = (v166 * v65);
            value[98][i] = ((-0.041666666666666664) * v187);
            value[99][i] = (v191 * v65);
            value[100][i] = (v200 * v65);
            value[101][i] = ((-0.041666666666666664) * ((v123 * v92) + (v212 * v94)));
            value[102][i] = (v215 * v65);
            value[103][i] = (v221 * v65);
            value[104][i] = (constants[10] * (((constants[10] * v224) - (v78 * (sin(v21) * multipliers_column[10][i]))) + (v80 * (cos(v21) * v62))));
            value[105][i] = (constants[11] * (v26 * ((v54 * multipliers_column[11][i]) + (v34 * multipliers_column[10][i]))));
            value[106][i] = (v219 * v61);
            value[107][i] = (v73 * v224);
            value[108][i] = (v102 * (v224 + ((v24 * ((v6 * ((v47 * (local_column[14][i] * multipliers_column[11][i])) + (v30 * (local_column[15][i] * multipliers_column[10][i])))) + (v34 * (local_column[14][i] * multipliers_column[10][i])))) - (v26 * ((v27 * ((local_column[19][i] * v25) * multipliers_column[10][i])) - (v44 * ((local_column[18][i] * local_column[18][i]) * multipliers_column[11][i])))))));
            value[109][i] = ((v96 * v227) - (v225 * (local_column[18][i] * (v24 * multipliers_column[11][i]))));
            value[110][i] = (-(v45 * (v26 * multipliers_column[11][i])));
            value[111][i] = ((v93 * (v25 * v226)) + (v106 * v227));
            value[112][i] = (v29 * v61);
            value[113][i] = (v126 * v61);
            value[114][i] = (-(v85 * v84));
            value[115][i] = (-(v138 * multipliers_column[6][i]));
            value[116][i] = (-(v177 * multipliers_column[6][i]));
            value[117][i] = (-(v208 * multipliers_column[6][i]));
            value[118][i] = (-(v85 * multipliers_column[10][i]));
            value[119][i] = (-(v113 * v84));
            value[120][i] = (-(v151 * multipliers_column[6][i]));
            value[121][i] = (-(v189 * multipliers_column[6][i]));
            value[122][i] = (-(v214 * multipliers_column[6][i]));
            value[123][i] = (-(v113 * multipliers_column[10][i]));
            value[124][i] = (-(v35 * v84));
            value[125][i] = (-(v161 * multipliers_column[6][i]));
            value[126][i] = (-(v196 * multipliers_column[6][i]));
            value[127][i] = (-(v218 * multipliers_column[6][i]));
            value[128][i] = (-(v35 * multipliers_column[10][i]));
            value[129][i] = (-(v32 * v84));
            value[130][i] = (-(v170 * multipliers_column[6][i]));
            value[131][i] = (-(v203 * multipliers_column[6][i]));
            value[132][i] = (-(v223 * multipliers_column[6][i]));
            value[133][i] = (-(v32 * multipliers_column[10][i]));
            value[134][i] = (-(v83 * v82));
            value[135][i] = (-(v137 * multipliers_column[7][i]));
            value[136][i] = (-(v176 * multipliers_column[7][i]));
            value[137][i] = (-(v207 * multipliers_column[7][i]));
            value[138][i] = (-(v83 * multipliers_column[11][i]));
            value[139][i] = (-(v110 * v82));
            value[140][i] = (-(v150 * multipliers_column[7][i]));
            value[141][i] = (-(v188 * multipliers_column[7][i]));
            value[142][i] = (-(v213 * multipliers_column[7][i]));
            value[143][i] = (-(v110 * multipliers_column[11][i]));
            value[144][i] = (-(v48 * v82));
            value[145][i] = (-(v160 * multipliers_column[7][i]));
            value[146][i] = (-(v195 * multipliers_column[7][i]));
            value[147][i] = (-(v217 * multipliers_column[7][i]));
            value[148][i] = (-(v48 * multipliers_column[11][i]));
            value[149][i] = (-(v46 * v82));
            value[150][i] = (-(v169 * multipliers_column[7][i]));
            value[151][i] = (-(v202 * multipliers_column[7][i]));
            value[152][i] = (-(v222 * multipliers_column[7][i]));
            value[153][i] = (-(v46 * multipliers_column[11][i]));
            value[154][i] = (v229 * v228);
            value[155][i] = (v232 * v231);
            value[156][i] = (v230 * v228);
            value[157][i] = (v233 * v231);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 158; j++) out[index[k * 158 + j]] += value[j][i];
        }
    }
}
