// 9099fd452bb09085eb4dc3edcadad9c1
// {"name": "standing on a moving platform, PD interval", "m": 16, "n_local": 20, "n_shared": 6, "n_data": 5, "n_constants": 24, "jacobian": [[0, 2], [0, 4], [1, 3], [1, 5], [2, 0], [2, 1], [2, 2], [2, 3], [2, 6], [2, 7], [2, 20], [2, 21], [2, 24], [3, 0], [3, 1], [3, 2], [3, 3], [3, 6], [3, 7], [3, 22], [3, 23], [3, 25], [4, 2], [4, 6], [4, 8], [4, 10], [4, 14], [5, 3], [5, 7], [5, 9], [5, 11], [5, 15], [6, 0], [6, 1], [6, 2], [6, 3], [6, 4], [6, 5], [6, 6], [6, 7], [6, 8], [6, 9], [6, 10], [6, 11], [6, 12], [6, 13], [6, 14], [6, 15], [6, 20], [6, 21], [6, 24], [7, 0], [7, 1], [7, 2], [7, 3], [7, 4], [7, 5], [7, 6], [7, 7], [7, 8], [7, 9], [7, 10], [7, 11], [7, 12], [7, 13], [7, 14], [7, 15], [7, 22], [7, 23], [7, 25], [8, 12], [8, 18], [9, 13], [9, 19], [10, 14], [10, 15], [10, 16], [10, 17], [10, 18], [10, 19], [10, 20], [10, 21], [10, 24], [11, 14], [11, 15], [11, 16], [11, 17], [11, 18], [11, 19], [11, 22], [11, 23], [11, 25], [12, 0], [12, 4], [12, 8], [12, 12], [12, 16], [13, 1], [13, 5], [13, 9], [13, 13], [13, 17], [14, 2], [14, 6], [14, 10], [14, 14], [14, 18], [15, 3], [15, 7], [15, 11], [15, 15], [15, 19]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 1], [2, 2], [3, 1], [3, 2], [3, 3], [4, 0], [4, 1], [4, 4], [5, 0], [5, 1], [5, 2], [5, 3], [5, 4], [5, 5], [6, 1], [6, 2], [6, 3], [6, 5], [6, 6], [7, 1], [7, 2], [7, 3], [7, 5], [7, 6], [7, 7], [8, 0], [8, 1], [8, 4], [8, 5], [8, 8], [9, 0], [9, 1], [9, 2], [9, 3], [9, 4], [9, 5], [9, 6], [9, 7], [9, 8], [9, 9], [10, 1], [10, 2], [10, 3], [10, 5], [10, 6], [10, 7], [10, 9], [10, 10], [11, 1], [11, 2], [11, 3], [11, 5], [11, 6], [11, 7], [11, 9], [11, 10], [11, 11], [12, 0], [12, 1], [12, 4], [12, 5], [12, 8], [12, 9], [12, 12], [13, 0], [13, 1], [13, 2], [13, 3], [13, 4], [13, 5], [13, 6], [13, 7], [13, 8], [13, 9], [13, 10], [13, 11], [13, 12], [13, 13], [14, 1], [14, 2], [14, 3], [14, 5], [14, 6], [14, 7], [14, 9], [14, 10], [14, 11], [14, 13], [14, 14], [15, 1], [15, 2], [15, 3], [15, 5], [15, 6], [15, 7], [15, 9], [15, 10], [15, 11], [15, 13], [15, 14], [15, 15], [16, 16], [17, 14], [17, 15], [17, 16], [17, 17], [18, 17], [18, 18], [19, 17], [19, 18], [19, 19], [20, 0], [20, 4], [20, 8], [20, 12], [20, 16], [21, 2], [21, 6], [21, 10], [21, 14], [21, 18], [22, 1], [22, 5], [22, 9], [22, 13], [22, 17], [23, 3], [23, 7], [23, 11], [23, 15], [23, 19], [24, 20], [25, 22]]}
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
// shared[0]: kp_ankle
// shared[1]: kd_ankle
// shared[2]: kp_hip
// shared[3]: kd_hip
// shared[4]: ref_ankle
// shared[5]: ref_hip
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
// constants[14]: scale kp_ankle
// constants[15]: scale kd_ankle
// constants[16]: scale kp_hip
// constants[17]: scale kd_hip
// constants[18]: scale ref_ankle
// constants[19]: scale ref_hip
// constants[20]: scale ankle_kinematics
// constants[21]: scale hip_kinematics
// constants[22]: scale ankle_balance
// constants[23]: scale hip_balance
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
    const double v0 = (1.0 / constants[20]);
    const double v1 = (1.0 / constants[9]);
    const double v2 = (constants[10] * v1);
    const double v3 = (1.0 / constants[21]);
    const double v5 = (constants[11] * v1);
    const double v6 = (1.0 / constants[22]);
    const double v10 = (constants[1] * constants[7]);
    const double v15 = (shared[4] * constants[18]);
    const double v16 = (shared[0] * constants[14]);
    const double v17 = (constants[15] * (shared[1] * constants[12]));
    const double v18 = (constants[4] * (constants[5] * constants[5]));
    const double v20 = (constants[4] * (constants[3] * constants[5]));
    const double v21 = (2.0 * v20);
    const double v22 = (v18 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v23 = (constants[12] * v1);
    const double v24 = (constants[6] + v18);
    const double v26 = (constants[13] * v1);
    const double v27 = (2.0 * constants[12]);
    const double v29 = (constants[4] * (constants[5] * (constants[3] * constants[13])));
    const double v30 = (1.0 / constants[23]);
    const double v31 = (constants[5] * constants[7]);
    const double v32 = (shared[5] * constants[19]);
    const double v33 = (shared[2] * constants[16]);
    const double v34 = (constants[17] * (shared[3] * constants[13]));
    const double v35 = (v24 * v26);
    const double v36 = (v20 * (constants[12] * constants[12]));
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
            const double v19 = cos(v11);
            const double v25 = (v24 + (v20 * v19));
            const double v28 = sin(v11);
            const double v37 = (((-0.041666666666666664) * local_column[14][i]) + ((0.20833333333333334 * local_column[6][i]) + (local_column[2][i] + (0.3333333333333333 * local_column[10][i]))));
            const double v38 = (((-0.041666666666666664) * local_column[15][i]) + ((0.20833333333333334 * local_column[7][i]) + (local_column[3][i] + (0.3333333333333333 * local_column[11][i]))));
            const double v39 = (constants[13] * v38);
            const double v40 = (constants[10] * (((-0.041666666666666664) * local_column[12][i]) + ((0.20833333333333334 * local_column[4][i]) + (local_column[0][i] + (0.3333333333333333 * local_column[8][i])))));
            const double v41 = cos(v40);
            const double v42 = sin(v40);
            const double v43 = (constants[11] * (((-0.041666666666666664) * local_column[13][i]) + ((0.20833333333333334 * local_column[5][i]) + (local_column[1][i] + (0.3333333333333333 * local_column[9][i])))));
            const double v44 = (v40 + v43);
            const double v45 = sin(v44);
            const double v46 = cos(v44);
            const double v47 = cos(v43);
            const double v48 = (v24 + (v20 * v47));
            const double v49 = sin(v43);
            const double v50 = (constants[13] * local_column[19][i]);
            const double v51 = (constants[10] * local_column[16][i]);
            const double v52 = cos(v51);
            const double v53 = sin(v51);
            const double v54 = (constants[11] * local_column[17][i]);
            const double v55 = (v51 + v54);
            const double v56 = sin(v55);
            const double v57 = cos(v55);
            const double v58 = cos(v54);
            const double v59 = (v24 + (v20 * v58));
            const double v60 = sin(v54);
            value[0][i] = (v0 * ((constants[12] * local_column[2][i]) - (v2 * local_column[4][i])));
            value[1][i] = (v3 * (v4 - (v5 * local_column[5][i])));
            value[2][i] = (v6 * ((v29 * (v28 * (local_column[3][i] * (v4 + (v27 * local_column[2][i]))))) - ((v26 * (local_column[7][i] * v25)) + ((v23 * (local_column[6][i] * (v22 + (v21 * v19)))) + ((v17 * local_column[2][i]) + ((v16 * (v7 - v15)) + ((constants[4] * ((data_column[0][i] * ((constants[3] * v8) + (constants[5] * v14))) - (constants[7] * ((constants[3] * v9) + (constants[5] * v13))))) + (data_column[3][i] + (constants[0] * ((constants[1] * (data_column[0][i] * v8)) - (v10 * v9)))))))))));
            value[3][i] = (-(v30 * ((v36 * (v28 * (local_column[2][i] * local_column[2][i]))) + ((v35 * local_column[7][i]) + ((v34 * local_column[3][i]) + ((v23 * (local_column[6][i] * v25)) + ((v33 * (v11 - v32)) + (data_column[4][i] + (constants[4] * ((constants[5] * (data_column[0][i] * v14)) - (v31 * v13)))))))))));
            value[4][i] = (v0 * ((constants[12] * v37) - (v2 * local_column[8][i])));
            value[5][i] = (v3 * (v39 - (v5 * local_column[9][i])));
            value[6][i] = (v6 * ((v29 * (v49 * (v38 * (v39 + (v27 * v37))))) - ((v17 * v37) + ((v26 * (local_column[11][i] * v48)) + ((v23 * (local_column[10][i] * (v22 + (v21 * v47)))) + ((v16 * (v40 - v15)) + ((constants[4] * ((data_column[1][i] * ((constants[3] * v41) + (constants[5] * v46))) - (constants[7] * ((constants[3] * v42) + (constants[5] * v45))))) + (data_column[3][i] + (constants[0] * ((constants[1] * (data_column[1][i] * v41)) - (v10 * v42)))))))))));
            value[7][i] = (-(v30 * ((v36 * (v49 * (v37 * v37))) + ((v34 * v38) + ((v35 * local_column[11][i]) + ((v23 * (local_column[10][i] * v48)) + ((v33 * (v43 - v32)) + (data_column[4][i] + (constants[4] * ((constants[5] * (data_column[1][i] * v46)) - (v31 * v45)))))))))));
            value[8][i] = (v0 * ((constants[12] * local_column[18][i]) - (v2 * local_column[12][i])));
            value[9][i] = (v3 * (v50 - (v5 * local_column[13][i])));
            value[10][i] = (v6 * ((v29 * (v60 * (local_column[19][i] * (v50 + (v27 * local_column[18][i]))))) - ((v26 * (local_column[15][i] * v59)) + ((v17 * local_column[18][i]) + ((v23 * (local_column[14][i] * (v22 + (v21 * v58)))) + ((v16 * (v51 - v15)) + ((constants[4] * ((data_column[2][i] * ((constants[3] * v52) + (constants[5] * v57))) - (constants[7] * ((constants[3] * v53) + (constants[5] * v56))))) + (data_column[3][i] + (constants[0] * ((constants[1] * (data_column[2][i] * v52)) - (v10 * v53)))))))))));
            value[11][i] = (-(v30 * ((v36 * (v60 * (local_column[18][i] * local_column[18][i]))) + ((v34 * local_column[19][i]) + ((v35 * local_column[15][i]) + ((v23 * (local_column[14][i] * v59)) + ((v33 * (v54 - v32)) + (data_column[4][i] + (constants[4] * ((constants[5] * (data_column[2][i] * v57)) - (v31 * v56)))))))))));
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
    const double v0 = (1.0 / constants[20]);
    const double v1 = (1.0 / constants[9]);
    const double v2 = (1.0 / constants[21]);
    const double v3 = (1.0 / constants[22]);
    const double v8 = (shared[4] * constants[18]);
    const double v9 = (constants[4] * (constants[5] * constants[5]));
    const double v11 = (constants[4] * (constants[3] * constants[5]));
    const double v12 = (2.0 * v11);
    const double v13 = (v9 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v14 = (constants[12] * v1);
    const double v15 = (constants[6] + v9);
    const double v17 = (constants[13] * v1);
    const double v18 = (2.0 * constants[12]);
    const double v21 = (1.0 / constants[23]);
    const double v22 = (shared[5] * constants[19]);
    const double v41 = (constants[12] * v0);
    const double v42 = (constants[13] * v2);
    const double v43 = (v3 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v45 = (2.0 * (constants[12] * v43));
    const double v46 = (v3 * v17);
    const double v47 = (v11 * v46);
    const double v48 = (v3 * v14);
    const double v49 = (2.0 * (v11 * v48));
    const double v50 = (v3 * (constants[15] * (shared[1] * constants[12])));
    const double v51 = (constants[12] * (constants[15] * v3));
    const double v52 = (v3 * (shared[0] * constants[14]));
    const double v53 = (constants[14] * v3);
    const double v54 = (constants[4] * v3);
    const double v55 = (constants[5] * v54);
    const double v57 = (constants[7] * v54);
    const double v58 = (constants[5] * v57);
    const double v60 = (constants[0] * v3);
    const double v61 = ((constants[3] * v57) + ((constants[1] * constants[7]) * v60));
    const double v62 = ((constants[3] * v54) + (constants[1] * v60));
    const double v63 = (constants[13] * v43);
    const double v64 = (v21 * (v11 * (constants[12] * constants[12])));
    const double v65 = (v64 + v64);
    const double v66 = (v21 * (v15 * v17));
    const double v67 = (v21 * (constants[17] * (shared[3] * constants[13])));
    const double v68 = (constants[13] * (constants[17] * v21));
    const double v69 = (v14 * v21);
    const double v70 = (v21 * (shared[2] * constants[16]));
    const double v71 = (constants[16] * v21);
    const double v72 = (constants[4] * v21);
    const double v73 = ((constants[5] * constants[7]) * v72);
    const double v74 = (constants[5] * v72);
    const double v75 = (v11 * v69);
    const double v82 = ((-0.041666666666666664) * constants[11]);
    const double v83 = (0.20833333333333334 * constants[11]);
    const double v84 = (0.3333333333333333 * constants[11]);
    const double v86 = ((-0.041666666666666664) * constants[10]);
    const double v87 = (0.20833333333333334 * constants[10]);
    const double v88 = (0.3333333333333333 * constants[10]);
    const double v93 = ((-0.041666666666666664) * v65);
    const double v94 = (0.20833333333333334 * v65);
    const double v95 = (0.3333333333333333 * v65);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[20][BLOCK] __attribute__((aligned(64)));
        double data_column[5][BLOCK] __attribute__((aligned(64)));
        double value[112][BLOCK] __attribute__((aligned(64)));
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
            const double v10 = cos(v5);
            const double v16 = (v15 + (v11 * v10));
            const double v19 = ((constants[13] * local_column[3][i]) + (v18 * local_column[2][i]));
            const double v20 = sin(v5);
            const double v23 = (((-0.041666666666666664) * local_column[14][i]) + ((0.20833333333333334 * local_column[6][i]) + (local_column[2][i] + (0.3333333333333333 * local_column[10][i]))));
            const double v24 = (((-0.041666666666666664) * local_column[15][i]) + ((0.20833333333333334 * local_column[7][i]) + (local_column[3][i] + (0.3333333333333333 * local_column[11][i]))));
            const double v25 = (constants[10] * (((-0.041666666666666664) * local_column[12][i]) + ((0.20833333333333334 * local_column[4][i]) + (local_column[0][i] + (0.3333333333333333 * local_column[8][i])))));
            const double v26 = (constants[11] * (((-0.041666666666666664) * local_column[13][i]) + ((0.20833333333333334 * local_column[5][i]) + (local_column[1][i] + (0.3333333333333333 * local_column[9][i])))));
            const double v27 = (v25 + v26);
            const double v28 = cos(v27);
            const double v29 = cos(v26);
            const double v30 = (v15 + (v11 * v29));
            const double v31 = ((constants[13] * v24) + (v18 * v23));
            const double v32 = sin(v26);
            const double v33 = (constants[10] * local_column[16][i]);
            const double v34 = (constants[11] * local_column[17][i]);
            const double v35 = (v33 + v34);
            const double v36 = cos(v35);
            const double v37 = cos(v34);
            const double v38 = (v15 + (v11 * v37));
            const double v39 = ((constants[13] * local_column[19][i]) + (v18 * local_column[18][i]));
            const double v40 = sin(v34);
            const double v44 = (local_column[3][i] * v20);
            const double v56 = (data_column[0][i] * sin(v6));
            const double v59 = ((v55 * v56) + (v58 * v7));
            const double v76 = ((v74 * v56) + (v73 * v7));
            const double v77 = (v24 * v32);
            const double v78 = ((v45 * v77) - v50);
            const double v79 = (data_column[1][i] * sin(v27));
            const double v80 = ((v55 * v79) + (v58 * v28));
            const double v81 = (((v43 * (v29 * (v24 * v31))) + (v32 * ((v47 * local_column[11][i]) + (v49 * local_column[10][i])))) + v80);
            const double v85 = (((v80 - v52) + (v61 * cos(v25))) + (v62 * (data_column[1][i] * sin(v25))));
            const double v89 = ((v43 * (v31 * v32)) + (v63 * v77));
            const double v90 = (v23 * v32);
            const double v91 = ((v74 * v79) + (v73 * v28));
            const double v92 = (((v75 * (local_column[10][i] * v32)) - (v70 + (v64 * (v29 * (v23 * v23))))) + v91);
            const double v96 = (local_column[19][i] * v40);
            const double v97 = (data_column[2][i] * sin(v35));
            const double v98 = ((v55 * v97) + (v58 * v36));
            const double v99 = ((v74 * v97) + (v73 * v36));
            value[0][i] = v41;
            value[1][i] = (-(v0 * (constants[10] * v1)));
            value[2][i] = v42;
            value[3][i] = (-(v2 * (constants[11] * v1)));
            value[4][i] = (constants[10] * (((v59 - v52) + (v61 * cos(v4))) + (v62 * (data_column[0][i] * sin(v4)))));
            value[5][i] = (constants[11] * (((v43 * (v10 * (local_column[3][i] * v19))) + (v20 * ((v47 * local_column[7][i]) + (v49 * local_column[6][i])))) + v59));
            value[6][i] = ((v45 * v44) - v50);
            value[7][i] = ((v43 * (v19 * v20)) + (v63 * v44));
            value[8][i] = (-(v48 * (v13 + (v12 * v10))));
            value[9][i] = (-(v46 * v16));
            value[10][i] = (-(v53 * (v4 - v8)));
            value[11][i] = (-(v51 * local_column[2][i]));
            value[12][i] = (constants[18] * v52);
            value[13][i] = (constants[10] * v76);
            value[14][i] = (constants[11] * (((v75 * (local_column[6][i] * v20)) - (v70 + (v64 * (v10 * (local_column[2][i] * local_column[2][i]))))) + v76));
            value[15][i] = (-(v65 * (local_column[2][i] * v20)));
            value[16][i] = (-v67);
            value[17][i] = (-(v69 * v16));
            value[18][i] = (-v66);
            value[19][i] = (-(v71 * (v5 - v22)));
            value[20][i] = (-(v68 * local_column[3][i]));
            value[21][i] = (constants[19] * v70);
            value[22][i] = v41;
            value[23][i] = (0.20833333333333334 * v41);
            value[24][i] = (-(v0 * (constants[10] * v1)));
            value[25][i] = (0.3333333333333333 * v41);
            value[26][i] = ((-0.041666666666666664) * v41);
            value[27][i] = v42;
            value[28][i] = (0.20833333333333334 * v42);
            value[29][i] = (-(v2 * (constants[11] * v1)));
            value[30][i] = (0.3333333333333333 * v42);
            value[31][i] = ((-0.041666666666666664) * v42);
            value[32][i] = (constants[10] * v85);
            value[33][i] = (constants[11] * v81);
            value[34][i] = v78;
            value[35][i] = v89;
            value[36][i] = (v87 * v85);
            value[37][i] = (v83 * v81);
            value[38][i] = (0.20833333333333334 * v78);
            value[39][i] = (0.20833333333333334 * v89);
            value[40][i] = (v88 * v85);
            value[41][i] = (v84 * v81);
            value[42][i] = ((0.3333333333333333 * v78) - (v48 * (v13 + (v12 * v29))));
            value[43][i] = ((0.3333333333333333 * v89) - (v46 * v30));
            value[44][i] = (v86 * v85);
            value[45][i] = (v82 * v81);
            value[46][i] = ((-0.041666666666666664) * v78);
            value[47][i] = ((-0.041666666666666664) * v89);
            value[48][i] = (-(v53 * (v25 - v8)));
            value[49][i] = (-(v51 * v23));
            value[50][i] = (constants[18] * v52);
            value[51][i] = (constants[10] * v91);
            value[52][i] = (constants[11] * v92);
            value[53][i] = (-(v65 * v90));
            value[54][i] = (-v67);
            value[55][i] = (v87 * v91);
            value[56][i] = (v83 * v92);
            value[57][i] = (-(v94 * v90));
            value[58][i] = ((-0.20833333333333334) * v67);
            value[59][i] = (v88 * v91);
            value[60][i] = (v84 * v92);
            value[61][i] = (-((v69 * v30) + (v95 * v90)));
            value[62][i] = (((-0.3333333333333333) * v67) - v66);
            value[63][i] = (v86 * v91);
            value[64][i] = (v82 * v92);
            value[65][i] = (-(v93 * v90));
            value[66][i] = (0.041666666666666664 * v67);
            value[67][i] = (-(v71 * (v26 - v22)));
            value[68][i] = (-(v68 * v24));
            value[69][i] = (constants[19] * v70);
            value[70][i] = (-(v0 * (constants[10] * v1)));
            value[71][i] = v41;
            value[72][i] = (-(v2 * (constants[11] * v1)));
            value[73][i] = v42;
            value[74][i] = (-(v48 * (v13 + (v12 * v37))));
            value[75][i] = (-(v46 * v38));
            value[76][i] = (constants[10] * (((v98 - v52) + (v61 * cos(v33))) + (v62 * (data_column[2][i] * sin(v33)))));
            value[77][i] = (constants[11] * (((v43 * (v37 * (local_column[19][i] * v39))) + (v40 * ((v47 * local_column[15][i]) + (v49 * local_column[14][i])))) + v98));
            value[78][i] = ((v45 * v96) - v50);
            value[79][i] = ((v43 * (v39 * v40)) + (v63 * v96));
            value[80][i] = (-(v53 * (v33 - v8)));
            value[81][i] = (-(v51 * local_column[18][i]));
            value[82][i] = (constants[18] * v52);
            value[83][i] = (-(v69 * v38));
            value[84][i] = (-v66);
            value[85][i] = (constants[10] * v99);
            value[86][i] = (constants[11] * (((v75 * (local_column[14][i] * v40)) - (v70 + (v64 * (v37 * (local_column[18][i] * local_column[18][i]))))) + v99));
            value[87][i] = (-(v65 * (local_column[18][i] * v40)));
            value[88][i] = (-v67);
            value[89][i] = (-(v71 * (v34 - v22)));
            value[90][i] = (-(v68 * local_column[19][i]));
            value[91][i] = (constants[19] * v70);
            value[92][i] = (-1.0);
            value[93][i] = (-0.16666666666666666);
            value[94][i] = (-0.6666666666666666);
            value[95][i] = (-0.16666666666666666);
            value[96][i] = 1.0;
            value[97][i] = (-1.0);
            value[98][i] = (-0.16666666666666666);
            value[99][i] = (-0.6666666666666666);
            value[100][i] = (-0.16666666666666666);
            value[101][i] = 1.0;
            value[102][i] = (-1.0);
            value[103][i] = (-0.16666666666666666);
            value[104][i] = (-0.6666666666666666);
            value[105][i] = (-0.16666666666666666);
            value[106][i] = 1.0;
            value[107][i] = (-1.0);
            value[108][i] = (-0.16666666666666666);
            value[109][i] = (-0.6666666666666666);
            value[110][i] = (-0.16666666666666666);
            value[111][i] = 1.0;
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 112; j++) out[k * 112 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[9]);
    const double v1 = (1.0 / constants[22]);
    const double v6 = (constants[4] * (constants[3] * constants[5]));
    const double v7 = (constants[12] * v0);
    const double v8 = (2.0 * constants[12]);
    const double v11 = (1.0 / constants[23]);
    const double v27 = (v1 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v28 = (constants[12] * v27);
    const double v29 = (2.0 * v28);
    const double v30 = (v1 * (constants[13] * v0));
    const double v31 = (v6 * v30);
    const double v32 = (v1 * v7);
    const double v33 = (2.0 * (v6 * v32));
    const double v34 = (constants[12] * (constants[15] * v1));
    const double v35 = (constants[14] * v1);
    const double v36 = (constants[4] * v1);
    const double v37 = (constants[5] * v36);
    const double v38 = (constants[7] * v36);
    const double v39 = (constants[5] * v38);
    const double v40 = (constants[0] * v1);
    const double v41 = (constants[13] * v27);
    const double v42 = (v11 * (v6 * (constants[12] * constants[12])));
    const double v43 = (v42 + v42);
    const double v44 = (constants[13] * (constants[17] * v11));
    const double v45 = (v7 * v11);
    const double v46 = (constants[16] * v11);
    const double v47 = (constants[4] * v11);
    const double v48 = ((constants[5] * constants[7]) * v47);
    const double v49 = (constants[5] * v47);
    const double v50 = (v6 * v45);
    const double v51 = ((-0.041666666666666664) * constants[11]);
    const double v52 = (0.20833333333333334 * constants[11]);
    const double v53 = (0.3333333333333333 * constants[11]);
    const double v54 = ((-0.041666666666666664) * constants[10]);
    const double v55 = (0.20833333333333334 * constants[10]);
    const double v56 = (0.3333333333333333 * constants[10]);
    const double v57 = ((-0.041666666666666664) * v43);
    const double v58 = (0.20833333333333334 * v43);
    const double v59 = (0.3333333333333333 * v43);
    const double v70 = (constants[10] * constants[11]);
    const double v71 = ((-0.041666666666666664) * v70);
    const double v72 = (0.20833333333333334 * v70);
    const double v73 = (0.3333333333333333 * v70);
    const double v75 = (constants[10] * ((constants[3] * v38) + ((constants[1] * constants[7]) * v40)));
    const double v77 = (constants[10] * ((constants[3] * v36) + (constants[1] * v40)));
    const double v80 = (constants[10] * v35);
    const double v82 = (constants[11] * v6);
    const double v84 = (constants[11] * v43);
    const double v85 = (v45 * v82);
    const double v88 = (constants[11] * v27);
    const double v90 = (constants[11] * v28);
    const double v91 = (2.0 * v90);
    const double v93 = (v30 * v82);
    const double v94 = (v32 * v82);
    const double v95 = (2.0 * v94);
    const double v97 = (constants[11] * constants[11]);
    const double v98 = ((-0.041666666666666664) * v97);
    const double v99 = (0.20833333333333334 * v97);
    const double v100 = (0.3333333333333333 * v97);
    const double v101 = (constants[13] * v88);
    const double v103 = (constants[11] * v42);
    const double v106 = (constants[11] * v46);
    const double v110 = (2.0 * v42);
    const double v113 = ((-0.08333333333333333) * v28);
    const double v114 = (0.4166666666666667 * v28);
    const double v115 = (0.6666666666666666 * v28);
    const double v117 = ((-0.041666666666666664) * v88);
    const double v118 = (0.20833333333333334 * v88);
    const double v119 = (0.3333333333333333 * v88);
    const double v120 = (v41 + v41);
    const double v121 = ((-0.041666666666666664) * v120);
    const double v122 = (0.20833333333333334 * v120);
    const double v123 = (0.3333333333333333 * v120);
    const double v125 = ((-0.008680555555555556) * v70);
    const double v126 = (0.04340277777777778 * v70);
    const double v127 = (0.06944444444444445 * v70);
    const double v128 = (0.20833333333333334 * v75);
    const double v129 = (0.20833333333333334 * v77);
    const double v131 = (0.20833333333333334 * v80);
    const double v132 = (0.20833333333333334 * v84);
    const double v133 = (0.20833333333333334 * v85);
    const double v134 = (0.4166666666666667 * v90);
    const double v136 = (0.20833333333333334 * v93);
    const double v137 = (0.4166666666666667 * v94);
    const double v138 = ((-0.008680555555555556) * v97);
    const double v139 = (0.04340277777777778 * v97);
    const double v140 = (0.06944444444444445 * v97);
    const double v141 = (0.20833333333333334 * v101);
    const double v143 = (0.20833333333333334 * v106);
    const double v144 = (0.4166666666666667 * v42);
    const double v146 = ((-0.017361111111111112) * v28);
    const double v147 = (0.08680555555555557 * v28);
    const double v148 = (0.1388888888888889 * v28);
    const double v149 = ((-0.008680555555555556) * v43);
    const double v150 = (0.04340277777777778 * v43);
    const double v151 = (0.06944444444444445 * v43);
    const double v152 = (0.20833333333333334 * v34);
    const double v153 = (0.20833333333333334 * constants[13]);
    const double v154 = (0.20833333333333334 * v41);
    const double v156 = (v154 + v154);
    const double v157 = ((-0.041666666666666664) * v156);
    const double v158 = (0.20833333333333334 * v156);
    const double v159 = (0.3333333333333333 * v156);
    const double v160 = (0.20833333333333334 * v44);
    const double v161 = ((-0.013888888888888888) * v70);
    const double v162 = (0.1111111111111111 * v70);
    const double v163 = (0.3333333333333333 * v75);
    const double v164 = (0.3333333333333333 * v77);
    const double v166 = (0.3333333333333333 * v80);
    const double v167 = (0.3333333333333333 * v84);
    const double v168 = (0.3333333333333333 * v85);
    const double v169 = (0.6666666666666666 * v90);
    const double v171 = (0.3333333333333333 * v93);
    const double v172 = (0.6666666666666666 * v94);
    const double v173 = ((-0.013888888888888888) * v97);
    const double v174 = (0.1111111111111111 * v97);
    const double v175 = (0.3333333333333333 * v101);
    const double v177 = (0.3333333333333333 * v106);
    const double v178 = (0.6666666666666666 * v42);
    const double v179 = ((-0.027777777777777776) * v28);
    const double v180 = (0.2222222222222222 * v28);
    const double v181 = ((-0.013888888888888888) * v43);
    const double v182 = (0.1111111111111111 * v43);
    const double v183 = (0.3333333333333333 * v34);
    const double v184 = (0.3333333333333333 * constants[13]);
    const double v185 = (0.3333333333333333 * v41);
    const double v186 = (v185 + v185);
    const double v187 = ((-0.041666666666666664) * v186);
    const double v188 = (0.3333333333333333 * v186);
    const double v189 = (0.3333333333333333 * v44);
    const double v190 = (0.001736111111111111 * v70);
    const double v191 = ((-0.041666666666666664) * v75);
    const double v192 = ((-0.041666666666666664) * v77);
    const double v193 = ((-0.041666666666666664) * v80);
    const double v194 = ((-0.041666666666666664) * v84);
    const double v195 = ((-0.08333333333333333) * v90);
    const double v196 = (0.001736111111111111 * v97);
    const double v197 = ((-0.041666666666666664) * v101);
    const double v198 = ((-0.041666666666666664) * v106);
    const double v199 = (0.003472222222222222 * v28);
    const double v200 = (0.001736111111111111 * v43);
    const double v201 = ((-0.041666666666666664) * v34);
    const double v202 = (constants[11] * v31);
    const double v203 = ((-0.041666666666666664) * v41);
    const double v204 = ((-0.041666666666666664) * (v203 + v203));
    const double v205 = ((-0.041666666666666664) * v44);
    const double v207 = (v103 + v103);
    const double v210 = (constants[18] * v35);
    const double v211 = (constants[19] * v46);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[20][BLOCK] __attribute__((aligned(64)));
        double data_column[5][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[16][BLOCK] __attribute__((aligned(64)));
        double value[136][BLOCK] __attribute__((aligned(64)));
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
            const double v60 = (v26 * multipliers_column[10][i]);
            const double v61 = (data_column[2][i] * multipliers_column[10][i]);
            const double v62 = (v20 * multipliers_column[7][i]);
            const double v63 = (v20 * multipliers_column[6][i]);
            const double v64 = (data_column[1][i] * multipliers_column[6][i]);
            const double v65 = (v10 * multipliers_column[3][i]);
            const double v66 = (v42 * v65);
            const double v67 = (v10 * multipliers_column[2][i]);
            const double v68 = (data_column[0][i] * multipliers_column[2][i]);
            const double v69 = ((cos(v17) * ((v49 * (data_column[1][i] * multipliers_column[7][i])) + (v37 * v64))) - (sin(v17) * ((v48 * multipliers_column[7][i]) + (v39 * multipliers_column[6][i]))));
            const double v74 = (sin(v15) * multipliers_column[6][i]);
            const double v76 = (cos(v15) * v64);
            const double v78 = (((constants[10] * v69) - (v75 * v74)) + (v77 * v76));
            const double v79 = (multipliers_column[2][i] + multipliers_column[6][i]);
            const double v81 = ((cos(v4) * ((v49 * (data_column[0][i] * multipliers_column[3][i])) + (v37 * v68))) - (sin(v4) * ((v48 * multipliers_column[3][i]) + (v39 * multipliers_column[2][i]))));
            const double v83 = (v12 * (v18 * multipliers_column[7][i]));
            const double v86 = (v18 * multipliers_column[6][i]);
            const double v87 = (v19 * v86);
            const double v89 = (v13 * v86);
            const double v92 = ((v91 * v89) - (v84 * v83));
            const double v96 = (v69 + ((v18 * ((v6 * ((v45 * (local_column[10][i] * multipliers_column[7][i])) + (v30 * (local_column[11][i] * multipliers_column[6][i])))) + (v33 * (local_column[10][i] * multipliers_column[6][i])))) - (v20 * ((v27 * ((v13 * v19) * multipliers_column[6][i])) - (v42 * ((v12 * v12) * multipliers_column[7][i]))))));
            const double v102 = ((v88 * v87) + (v101 * v89));
            const double v104 = (v103 * (local_column[2][i] * (v5 * multipliers_column[3][i])));
            const double v105 = (multipliers_column[3][i] + multipliers_column[7][i]);
            const double v107 = (v5 * multipliers_column[2][i]);
            const double v108 = (local_column[3][i] * v107);
            const double v109 = (v12 * multipliers_column[7][i]);
            const double v111 = (v13 * multipliers_column[6][i]);
            const double v112 = (v18 * ((v29 * v111) - (v110 * v109)));
            const double v116 = (v18 * (multipliers_column[6][i] * (v14 + v19)));
            const double v124 = (v41 * v67);
            const double v130 = (((v55 * v69) - (v128 * v74)) + (v129 * v76));
            const double v135 = ((v134 * v89) - (v132 * v83));
            const double v142 = ((v118 * v87) + (v141 * v89));
            const double v145 = (v18 * ((v114 * v111) - (v144 * v109)));
            const double v155 = (v18 * (multipliers_column[6][i] * ((0.20833333333333334 * v19) + (v153 * v13))));
            const double v165 = (((v56 * v69) - (v163 * v74)) + (v164 * v76));
            const double v170 = ((v169 * v89) - (v167 * v83));
            const double v176 = ((v119 * v87) + (v175 * v89));
            const double v206 = ((cos(v23) * ((v49 * (data_column[2][i] * multipliers_column[11][i])) + (v37 * v61))) - (sin(v23) * ((v48 * multipliers_column[11][i]) + (v39 * multipliers_column[10][i]))));
            const double v208 = (v24 * multipliers_column[10][i]);
            const double v209 = (local_column[19][i] * v208);
            value[0][i] = (constants[10] * (v78 + (((constants[10] * v81) - (v75 * (sin(v2) * multipliers_column[2][i]))) + (v77 * (cos(v2) * v68)))));
            value[1][i] = (v70 * (v69 + v81));
            value[2][i] = (v97 * (v96 + (v81 + ((v5 * ((v6 * ((v45 * (local_column[6][i] * multipliers_column[3][i])) + (v30 * (local_column[7][i] * multipliers_column[2][i])))) + (v33 * (local_column[6][i] * multipliers_column[2][i])))) - (v10 * ((v27 * ((local_column[3][i] * v9) * multipliers_column[2][i])) - (v42 * ((local_column[2][i] * local_column[2][i]) * multipliers_column[3][i]))))))));
            value[3][i] = (((v92 - v104) - v104) + (v91 * v108));
            value[4][i] = (-(v66 + (v66 + (v43 * v62))));
            value[5][i] = ((v102 + (v88 * (v9 * v107))) + (v101 * v108));
            value[6][i] = (v29 * (v63 + v67));
            value[7][i] = (v124 + ((v120 * v63) + v124));
            value[8][i] = (v55 * v78);
            value[9][i] = (v72 * v69);
            value[10][i] = (v55 * v130);
            value[11][i] = (v72 * v69);
            value[12][i] = (v99 * v96);
            value[13][i] = (v52 * v112);
            value[14][i] = (v118 * v116);
            value[15][i] = (v126 * v69);
            value[16][i] = (v139 * v96);
            value[17][i] = (((0.20833333333333334 * v92) + (v85 * v65)) + (v95 * v67));
            value[18][i] = (-(v58 * v62));
            value[19][i] = (v114 * v63);
            value[20][i] = (0.20833333333333334 * v135);
            value[21][i] = (-(v150 * v62));
            value[22][i] = ((0.20833333333333334 * v102) + (v93 * v67));
            value[23][i] = (v114 * v63);
            value[24][i] = (v122 * v63);
            value[25][i] = (0.20833333333333334 * v142);
            value[26][i] = (v147 * v63);
            value[27][i] = (v158 * v63);
            value[28][i] = (v56 * v78);
            value[29][i] = (v73 * v69);
            value[30][i] = (v56 * v130);
            value[31][i] = (v127 * v69);
            value[32][i] = (v56 * v165);
            value[33][i] = (v73 * v69);
            value[34][i] = (v100 * v96);
            value[35][i] = (v53 * v112);
            value[36][i] = (v119 * v116);
            value[37][i] = (v127 * v69);
            value[38][i] = (v140 * v96);
            value[39][i] = (v53 * v145);
            value[40][i] = (v119 * v155);
            value[41][i] = (v162 * v69);
            value[42][i] = (v174 * v96);
            value[43][i] = (((v85 * v62) + (v95 * v63)) + (0.3333333333333333 * v92));
            value[44][i] = (-(v59 * v62));
            value[45][i] = (v115 * v63);
            value[46][i] = (((v133 * v62) + (v137 * v63)) + (0.3333333333333333 * v135));
            value[47][i] = (-(v151 * v62));
            value[48][i] = (v148 * v63);
            value[49][i] = (((v168 * v62) + (v172 * v63)) + (0.3333333333333333 * v170));
            value[50][i] = (-(v182 * v62));
            value[51][i] = ((v93 * v63) + (0.3333333333333333 * v102));
            value[52][i] = (v115 * v63);
            value[53][i] = (v123 * v63);
            value[54][i] = ((v136 * v63) + (0.3333333333333333 * v142));
            value[55][i] = (v148 * v63);
            value[56][i] = (v159 * v63);
            value[57][i] = ((v171 * v63) + (0.3333333333333333 * v176));
            value[58][i] = (v180 * v63);
            value[59][i] = (v188 * v63);
            value[60][i] = (v54 * v78);
            value[61][i] = (v71 * v69);
            value[62][i] = (v54 * v130);
            value[63][i] = (v125 * v69);
            value[64][i] = (v54 * v165);
            value[65][i] = (v161 * v69);
            value[66][i] = (v54 * (((v54 * v69) - (v191 * v74)) + (v192 * v76)));
            value[67][i] = (v71 * v69);
            value[68][i] = (v98 * v96);
            value[69][i] = (v51 * v112);
            value[70][i] = (v117 * v116);
            value[71][i] = (v125 * v69);
            value[72][i] = (v138 * v96);
            value[73][i] = (v51 * v145);
            value[74][i] = (v117 * v155);
            value[75][i] = (v161 * v69);
            value[76][i] = (v173 * v96);
            value[77][i] = (v51 * ((v18 * ((v115 * v111) - (v178 * v109))) + (v20 * ((v50 * multipliers_column[7][i]) + (v33 * multipliers_column[6][i])))));
            value[78][i] = (v51 * ((v27 * (v18 * (multipliers_column[6][i] * ((0.3333333333333333 * v19) + (v184 * v13))))) + (v31 * v63)));
            value[79][i] = (v190 * v69);
            value[80][i] = (v196 * v96);
            value[81][i] = ((-0.041666666666666664) * v92);
            value[82][i] = (-(v57 * v62));
            value[83][i] = (v113 * v63);
            value[84][i] = ((-0.041666666666666664) * v135);
            value[85][i] = (-(v149 * v62));
            value[86][i] = (v146 * v63);
            value[87][i] = ((-0.041666666666666664) * v170);
            value[88][i] = (-(v181 * v62));
            value[89][i] = (v179 * v63);
            value[90][i] = ((-0.041666666666666664) * ((v195 * v89) - (v194 * v83)));
            value[91][i] = (-(v200 * v62));
            value[92][i] = ((-0.041666666666666664) * v102);
            value[93][i] = (v113 * v63);
            value[94][i] = (v121 * v63);
            value[95][i] = ((-0.041666666666666664) * v142);
            value[96][i] = (v146 * v63);
            value[97][i] = (v157 * v63);
            value[98][i] = ((-0.041666666666666664) * v176);
            value[99][i] = (v179 * v63);
            value[100][i] = (v187 * v63);
            value[101][i] = ((-0.041666666666666664) * ((v117 * v87) + (v197 * v89)));
            value[102][i] = (v199 * v63);
            value[103][i] = (v204 * v63);
            value[104][i] = (constants[10] * (((constants[10] * v206) - (v75 * (sin(v21) * multipliers_column[10][i]))) + (v77 * (cos(v21) * v61))));
            value[105][i] = (constants[11] * (v26 * ((v50 * multipliers_column[11][i]) + (v33 * multipliers_column[10][i]))));
            value[106][i] = (v202 * v60);
            value[107][i] = (v70 * v206);
            value[108][i] = (v97 * (v206 + ((v24 * ((v6 * ((v45 * (local_column[14][i] * multipliers_column[11][i])) + (v30 * (local_column[15][i] * multipliers_column[10][i])))) + (v33 * (local_column[14][i] * multipliers_column[10][i])))) - (v26 * ((v27 * ((local_column[19][i] * v25) * multipliers_column[10][i])) - (v42 * ((local_column[18][i] * local_column[18][i]) * multipliers_column[11][i])))))));
            value[109][i] = ((v91 * v209) - (v207 * (local_column[18][i] * (v24 * multipliers_column[11][i]))));
            value[110][i] = (-(v43 * (v26 * multipliers_column[11][i])));
            value[111][i] = ((v88 * (v25 * v208)) + (v101 * v209));
            value[112][i] = (v29 * v60);
            value[113][i] = (v120 * v60);
            value[114][i] = (-(v80 * v79));
            value[115][i] = (-(v131 * multipliers_column[6][i]));
            value[116][i] = (-(v166 * multipliers_column[6][i]));
            value[117][i] = (-(v193 * multipliers_column[6][i]));
            value[118][i] = (-(v80 * multipliers_column[10][i]));
            value[119][i] = (-(v34 * v79));
            value[120][i] = (-(v152 * multipliers_column[6][i]));
            value[121][i] = (-(v183 * multipliers_column[6][i]));
            value[122][i] = (-(v201 * multipliers_column[6][i]));
            value[123][i] = (-(v34 * multipliers_column[10][i]));
            value[124][i] = (-(v106 * v105));
            value[125][i] = (-(v143 * multipliers_column[7][i]));
            value[126][i] = (-(v177 * multipliers_column[7][i]));
            value[127][i] = (-(v198 * multipliers_column[7][i]));
            value[128][i] = (-(v106 * multipliers_column[11][i]));
            value[129][i] = (-(v44 * v105));
            value[130][i] = (-(v160 * multipliers_column[7][i]));
            value[131][i] = (-(v189 * multipliers_column[7][i]));
            value[132][i] = (-(v205 * multipliers_column[7][i]));
            value[133][i] = (-(v44 * multipliers_column[11][i]));
            value[134][i] = (v210 * (multipliers_column[2][i] + (multipliers_column[6][i] + multipliers_column[10][i])));
            value[135][i] = (v211 * (multipliers_column[3][i] + (multipliers_column[7][i] + multipliers_column[11][i])));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 136; j++) out[index[k * 136 + j]] += value[j][i];
        }
    }
}
