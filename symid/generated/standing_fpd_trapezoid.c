// 6df3ba0af51f9e8cab38f00ab11a22fd
// {"name": "standing on a moving platform, FullStatePD interval", "m": 4, "n_local": 8, "n_shared": 10, "n_data": 4, "n_constants": 28, "jacobian": [[0, 0], [0, 2], [0, 4], [0, 6], [1, 1], [1, 3], [1, 5], [1, 7], [2, 0], [2, 1], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [2, 8], [2, 9], [2, 10], [2, 11], [2, 16], [2, 17], [3, 0], [3, 1], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7], [3, 12], [3, 13], [3, 14], [3, 15], [3, 16], [3, 17]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 1], [2, 2], [3, 1], [3, 2], [3, 3], [4, 4], [5, 2], [5, 3], [5, 4], [5, 5], [6, 1], [6, 5], [6, 6], [7, 1], [7, 5], [7, 6], [7, 7], [8, 0], [8, 4], [9, 1], [9, 5], [10, 2], [10, 6], [11, 3], [11, 7], [12, 0], [12, 4], [13, 1], [13, 5], [14, 2], [14, 6], [15, 3], [15, 7], [16, 8], [16, 12], [17, 9], [17, 13]]}
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
// data[1]: platform_acceleration#1
// data[2]: ankle_torque_noise
// data[3]: hip_torque_noise
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
    const double v1 = (0.5 * constants[12]);
    const double v2 = (1.0 / constants[9]);
    const double v3 = (constants[10] * v2);
    const double v4 = (1.0 / constants[25]);
    const double v5 = (0.5 * constants[13]);
    const double v6 = (constants[11] * v2);
    const double v7 = (1.0 / constants[26]);
    const double v11 = (constants[1] * constants[7]);
    const double v12 = ((-0.5) * constants[0]);
    const double v20 = ((-0.5) * constants[4]);
    const double v25 = (shared[8] * constants[22]);
    const double v27 = ((-0.5) * (shared[0] * constants[14]));
    const double v29 = (shared[9] * constants[23]);
    const double v31 = ((-0.5) * (shared[1] * constants[15]));
    const double v33 = ((-0.5) * (constants[16] * (shared[2] * constants[12])));
    const double v34 = ((-0.5) * (constants[17] * (shared[3] * constants[13])));
    const double v36 = (constants[4] * (constants[5] * constants[5]));
    const double v38 = (constants[4] * (constants[3] * constants[5]));
    const double v39 = (2.0 * v38);
    const double v40 = (v36 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v41 = ((-0.5) * (constants[12] * v2));
    const double v44 = (constants[6] + v36);
    const double v46 = (constants[13] * v2);
    const double v47 = ((-0.5) * v46);
    const double v49 = (2.0 * constants[12]);
    const double v51 = (0.5 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v53 = (1.0 / constants[27]);
    const double v54 = (constants[5] * constants[7]);
    const double v55 = ((-0.5) * (shared[4] * constants[18]));
    const double v56 = ((-0.5) * (shared[5] * constants[19]));
    const double v57 = ((-0.5) * (constants[20] * (shared[6] * constants[12])));
    const double v58 = ((-0.5) * (constants[21] * (shared[7] * constants[13])));
    const double v59 = (v44 * v46);
    const double v60 = ((-0.5) * (v38 * (constants[12] * constants[12])));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[4][BLOCK] __attribute__((aligned(64)));
        double value[4][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 4; j++) data_column[j][i] = data[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v8 = (constants[10] * local_column[0][i]);
            const double v9 = cos(v8);
            const double v10 = sin(v8);
            const double v13 = (constants[10] * local_column[4][i]);
            const double v14 = cos(v13);
            const double v15 = sin(v13);
            const double v16 = (constants[11] * local_column[1][i]);
            const double v17 = (v8 + v16);
            const double v18 = sin(v17);
            const double v19 = cos(v17);
            const double v21 = (constants[11] * local_column[5][i]);
            const double v22 = (v13 + v21);
            const double v23 = sin(v22);
            const double v24 = cos(v22);
            const double v26 = (v8 - v25);
            const double v28 = (v13 - v25);
            const double v30 = (v16 - v29);
            const double v32 = (v21 - v29);
            const double v35 = (local_column[6][i] - local_column[2][i]);
            const double v37 = cos(v16);
            const double v42 = cos(v21);
            const double v43 = (local_column[7][i] - local_column[3][i]);
            const double v45 = (v44 + (v38 * v37));
            const double v48 = (v44 + (v38 * v42));
            const double v50 = sin(v16);
            const double v52 = sin(v21);
            value[0][i] = (v0 * ((v1 * (local_column[2][i] + local_column[6][i])) - (v3 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v4 * ((v5 * (local_column[3][i] + local_column[7][i])) - (v6 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v7 * ((v51 * (v52 * (local_column[7][i] * ((constants[13] * local_column[7][i]) + (v49 * local_column[6][i]))))) + ((v51 * (v50 * (local_column[3][i] * ((constants[13] * local_column[3][i]) + (v49 * local_column[2][i]))))) + ((v47 * (v43 * v48)) + ((v47 * (v43 * v45)) + ((v41 * (v35 * (v40 + (v39 * v42)))) + ((v41 * (v35 * (v40 + (v39 * v37)))) + ((v34 * local_column[7][i]) + ((v34 * local_column[3][i]) + ((v33 * local_column[6][i]) + ((v33 * local_column[2][i]) + ((v31 * v32) + ((v31 * v30) + ((v27 * v28) + ((v27 * v26) + ((v20 * ((data_column[1][i] * ((constants[3] * v14) + (constants[5] * v24))) - (constants[7] * ((constants[3] * v15) + (constants[5] * v23))))) + ((v20 * ((data_column[0][i] * ((constants[3] * v9) + (constants[5] * v19))) - (constants[7] * ((constants[3] * v10) + (constants[5] * v18))))) + ((v12 * ((constants[1] * (data_column[1][i] * v14)) - (v11 * v15))) + ((v12 * ((constants[1] * (data_column[0][i] * v9)) - (v11 * v10))) - data_column[2][i])))))))))))))))))));
            value[3][i] = (v53 * ((v60 * (v52 * (local_column[6][i] * local_column[6][i]))) + ((v60 * (v50 * (local_column[2][i] * local_column[2][i]))) + (((v41 * (v35 * v48)) + ((v41 * (v35 * v45)) + ((v58 * local_column[7][i]) + ((v58 * local_column[3][i]) + ((v57 * local_column[6][i]) + ((v57 * local_column[2][i]) + ((v56 * v32) + ((v56 * v30) + ((v55 * v28) + ((v55 * v26) + ((v20 * ((constants[5] * (data_column[1][i] * v24)) - (v54 * v23))) + ((v20 * ((constants[5] * (data_column[0][i] * v19)) - (v54 * v18))) - data_column[3][i])))))))))))) - (v59 * v43)))));
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
    const double v3 = (1.0 / constants[25]);
    const double v5 = (1.0 / constants[26]);
    const double v14 = (shared[8] * constants[22]);
    const double v15 = (shared[9] * constants[23]);
    const double v17 = (constants[4] * (constants[5] * constants[5]));
    const double v19 = (constants[4] * (constants[3] * constants[5]));
    const double v20 = (2.0 * v19);
    const double v21 = (v17 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v22 = (constants[12] * v1);
    const double v24 = (constants[6] + v17);
    const double v25 = (constants[13] * v1);
    const double v26 = (2.0 * constants[12]);
    const double v31 = (1.0 / constants[27]);
    const double v32 = (v5 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v33 = (0.5 * v32);
    const double v35 = (constants[12] * v32);
    const double v36 = (0.5 * (constants[13] * v32));
    const double v38 = (v5 * v25);
    const double v39 = ((-0.5) * v38);
    const double v40 = ((-0.5) * (v19 * v38));
    const double v43 = (v5 * v22);
    const double v44 = ((-0.5) * v43);
    const double v45 = (v19 * v43);
    const double v48 = ((-0.5) * (v5 * (constants[17] * (shared[3] * constants[13]))));
    const double v49 = ((-0.5) * (constants[13] * (constants[17] * v5)));
    const double v50 = ((-0.5) * (v5 * (constants[16] * (shared[2] * constants[12]))));
    const double v51 = ((-0.5) * (constants[12] * (constants[16] * v5)));
    const double v52 = (v5 * (shared[1] * constants[15]));
    const double v53 = ((-0.5) * v52);
    const double v54 = (0.5 * v52);
    const double v56 = ((-0.5) * (constants[15] * v5));
    const double v57 = (v5 * (shared[0] * constants[14]));
    const double v58 = ((-0.5) * v57);
    const double v59 = (0.5 * v57);
    const double v61 = ((-0.5) * (constants[14] * v5));
    const double v62 = (constants[4] * v5);
    const double v63 = ((-0.5) * (constants[5] * v62));
    const double v65 = (constants[7] * v62);
    const double v66 = (0.5 * (constants[5] * v65));
    const double v70 = (constants[0] * v5);
    const double v71 = ((0.5 * (constants[3] * v65)) + (0.5 * ((constants[1] * constants[7]) * v70)));
    const double v72 = (((-0.5) * (constants[3] * v62)) + ((-0.5) * (constants[1] * v70)));
    const double v73 = ((-0.5) * (v31 * (v19 * (constants[12] * constants[12]))));
    const double v74 = (v73 + v73);
    const double v75 = (v31 * (v24 * v25));
    const double v76 = (v22 * v31);
    const double v77 = ((-0.5) * v76);
    const double v79 = ((-0.5) * (v31 * (constants[21] * (shared[7] * constants[13]))));
    const double v80 = ((-0.5) * (constants[13] * (constants[21] * v31)));
    const double v81 = ((-0.5) * (v31 * (constants[20] * (shared[6] * constants[12]))));
    const double v82 = ((-0.5) * (constants[12] * (constants[20] * v31)));
    const double v83 = (v31 * (shared[5] * constants[19]));
    const double v84 = ((-0.5) * v83);
    const double v85 = ((-0.5) * (constants[19] * v31));
    const double v86 = (v31 * (shared[4] * constants[18]));
    const double v87 = ((-0.5) * v86);
    const double v88 = ((-0.5) * (constants[18] * v31));
    const double v89 = (constants[4] * v31);
    const double v90 = (0.5 * ((constants[5] * constants[7]) * v89));
    const double v91 = ((-0.5) * (constants[5] * v89));
    const double v92 = ((-0.5) * (v19 * v76));
    const double v93 = (0.5 * v83);
    const double v94 = (0.5 * v86);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[4][BLOCK] __attribute__((aligned(64)));
        double value[36][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 4; j++) data_column[j][i] = data[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v2 = (local_column[2][i] + local_column[6][i]);
            const double v4 = (local_column[3][i] + local_column[7][i]);
            const double v6 = (constants[10] * local_column[0][i]);
            const double v7 = (constants[10] * local_column[4][i]);
            const double v8 = (constants[11] * local_column[1][i]);
            const double v9 = (v6 + v8);
            const double v10 = cos(v9);
            const double v11 = (constants[11] * local_column[5][i]);
            const double v12 = (v7 + v11);
            const double v13 = cos(v12);
            const double v16 = (local_column[6][i] - local_column[2][i]);
            const double v18 = cos(v8);
            const double v23 = cos(v11);
            const double v27 = ((constants[13] * local_column[3][i]) + (v26 * local_column[2][i]));
            const double v28 = sin(v8);
            const double v29 = ((constants[13] * local_column[7][i]) + (v26 * local_column[6][i]));
            const double v30 = sin(v11);
            const double v34 = (local_column[7][i] * v30);
            const double v37 = (local_column[3][i] * v28);
            const double v41 = ((v24 + (v19 * v18)) + (v24 + (v19 * v23)));
            const double v42 = (v39 * v41);
            const double v46 = ((v40 * (local_column[7][i] - local_column[3][i])) - (v45 * v16));
            const double v47 = (v44 * ((v21 + (v20 * v18)) + (v21 + (v20 * v23))));
            const double v55 = ((v8 - v15) + (v11 - v15));
            const double v60 = ((v6 - v14) + (v7 - v14));
            const double v64 = (data_column[1][i] * sin(v12));
            const double v67 = ((v66 * v13) - (v63 * v64));
            const double v68 = (data_column[0][i] * sin(v9));
            const double v69 = ((v66 * v10) - (v63 * v68));
            const double v78 = (v77 * v41);
            const double v95 = ((v90 * v13) - (v91 * v64));
            const double v96 = ((v90 * v10) - (v91 * v68));
            value[0][i] = (v0 * (constants[10] * v1));
            value[1][i] = (0.5 * (constants[12] * v0));
            value[2][i] = (-(v0 * (constants[10] * v1)));
            value[3][i] = (0.5 * (constants[12] * v0));
            value[4][i] = (v3 * (constants[11] * v1));
            value[5][i] = (0.5 * (constants[13] * v3));
            value[6][i] = (-(v3 * (constants[11] * v1)));
            value[7][i] = (0.5 * (constants[13] * v3));
            value[8][i] = (constants[10] * (((v58 + v69) + (v71 * cos(v6))) - (v72 * (data_column[0][i] * sin(v6)))));
            value[9][i] = (constants[11] * ((v53 + ((v33 * (v18 * (local_column[3][i] * v27))) - (v28 * v46))) + v69));
            value[10][i] = (v50 + ((v35 * v37) - v47));
            value[11][i] = (v48 + (((v33 * (v27 * v28)) + (v36 * v37)) - v42));
            value[12][i] = (constants[10] * (((v58 + v67) + (v71 * cos(v7))) - (v72 * (data_column[1][i] * sin(v7)))));
            value[13][i] = (constants[11] * ((v53 + ((v33 * (v23 * (local_column[7][i] * v29))) - (v30 * v46))) + v67));
            value[14][i] = (v50 + ((v35 * v34) + v47));
            value[15][i] = (v48 + (((v33 * (v29 * v30)) + (v36 * v34)) + v42));
            value[16][i] = (v61 * v60);
            value[17][i] = (v56 * v55);
            value[18][i] = (v51 * v2);
            value[19][i] = (v49 * v4);
            value[20][i] = (constants[22] * (v59 + v59));
            value[21][i] = (constants[23] * (v54 + v54));
            value[22][i] = (constants[10] * (v87 + v96));
            value[23][i] = (constants[11] * ((v84 + ((v73 * (v18 * (local_column[2][i] * local_column[2][i]))) - (v92 * (v16 * v28)))) + v96));
            value[24][i] = ((v81 + (v74 * (local_column[2][i] * v28))) - v78);
            value[25][i] = (v75 + v79);
            value[26][i] = (constants[10] * (v87 + v95));
            value[27][i] = (constants[11] * ((v84 + ((v73 * (v23 * (local_column[6][i] * local_column[6][i]))) - (v92 * (v16 * v30)))) + v95));
            value[28][i] = (v78 + (v81 + (v74 * (local_column[6][i] * v30))));
            value[29][i] = (v79 - v75);
            value[30][i] = (v88 * v60);
            value[31][i] = (v85 * v55);
            value[32][i] = (v82 * v2);
            value[33][i] = (v80 * v4);
            value[34][i] = (constants[22] * (v94 + v94));
            value[35][i] = (constants[23] * (v93 + v93));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 36; j++) out[k * 36 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[9]);
    const double v1 = (1.0 / constants[26]);
    const double v10 = (constants[4] * (constants[3] * constants[5]));
    const double v11 = (constants[12] * v0);
    const double v13 = (2.0 * constants[12]);
    const double v18 = (1.0 / constants[27]);
    const double v19 = (v1 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v20 = (0.5 * v19);
    const double v21 = (constants[12] * v19);
    const double v22 = (constants[13] * v19);
    const double v23 = (0.5 * v22);
    const double v24 = (v1 * (constants[13] * v0));
    const double v25 = ((-0.5) * v24);
    const double v26 = (v1 * v11);
    const double v27 = (v10 * v26);
    const double v28 = ((-0.5) * (constants[13] * (constants[17] * v1)));
    const double v29 = ((-0.5) * (constants[12] * (constants[16] * v1)));
    const double v30 = (constants[15] * v1);
    const double v31 = (constants[14] * v1);
    const double v32 = (constants[4] * v1);
    const double v33 = ((-0.5) * (constants[5] * v32));
    const double v34 = (constants[7] * v32);
    const double v35 = (constants[0] * v1);
    const double v36 = ((-0.5) * (v18 * (v10 * (constants[12] * constants[12]))));
    const double v37 = (v36 + v36);
    const double v38 = (v11 * v18);
    const double v39 = ((-0.5) * v38);
    const double v40 = ((-0.5) * (constants[13] * (constants[21] * v18)));
    const double v41 = ((-0.5) * (constants[12] * (constants[20] * v18)));
    const double v42 = (constants[19] * v18);
    const double v43 = (constants[18] * v18);
    const double v44 = (constants[4] * v18);
    const double v45 = ((-0.5) * (constants[5] * v44));
    const double v46 = ((-0.5) * (v10 * v38));
    const double v49 = ((-0.5) * ((constants[5] * constants[7]) * v44));
    const double v54 = ((-0.5) * (constants[5] * v34));
    const double v57 = ((-0.5) * (constants[10] * v43));
    const double v58 = ((-0.5) * (constants[10] * v31));
    const double v60 = (constants[10] * constants[11]);
    const double v61 = (constants[10] * (((-0.5) * (constants[3] * v34)) + ((-0.5) * ((constants[1] * constants[7]) * v35))));
    const double v62 = (constants[10] * (((-0.5) * (constants[3] * v32)) + ((-0.5) * (constants[1] * v35))));
    const double v63 = (constants[11] * v10);
    const double v64 = (constants[11] * v37);
    const double v65 = ((-0.5) * (v38 * v63));
    const double v67 = ((-0.5) * (constants[11] * v42));
    const double v69 = (0.5 * (constants[11] * v19));
    const double v71 = (constants[11] * v21);
    const double v72 = (0.5 * (constants[11] * v22));
    const double v73 = ((-0.5) * (v24 * v63));
    const double v75 = (v26 * v63);
    const double v77 = ((-0.5) * (constants[11] * v30));
    const double v78 = (constants[11] * constants[11]);
    const double v79 = (v23 + v23);
    const double v80 = ((-0.5) * (constants[11] * (v10 * v24)));
    const double v84 = (constants[22] * v31);
    const double v85 = (constants[23] * v30);
    const double v86 = (constants[22] * v43);
    const double v87 = (constants[23] * v42);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[4][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[40][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 4; j++) data_column[j][i] = data[k * 4 + j];
            for (int j = 0; j < 4; j++) multipliers_column[j][i] = multipliers[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v2 = (constants[10] * local_column[0][i]);
            const double v3 = (constants[10] * local_column[4][i]);
            const double v4 = (constants[11] * local_column[1][i]);
            const double v5 = (v2 + v4);
            const double v6 = (constants[11] * local_column[5][i]);
            const double v7 = (v3 + v6);
            const double v8 = (local_column[6][i] - local_column[2][i]);
            const double v9 = cos(v4);
            const double v12 = cos(v6);
            const double v14 = ((constants[13] * local_column[3][i]) + (v13 * local_column[2][i]));
            const double v15 = sin(v4);
            const double v16 = ((constants[13] * local_column[7][i]) + (v13 * local_column[6][i]));
            const double v17 = sin(v6);
            const double v47 = (v17 * multipliers_column[3][i]);
            const double v48 = (v15 * multipliers_column[3][i]);
            const double v50 = (v17 * multipliers_column[2][i]);
            const double v51 = (v15 * multipliers_column[2][i]);
            const double v52 = ((v10 * ((v39 * (v8 * multipliers_column[3][i])) + (v25 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) - (v27 * (v8 * multipliers_column[2][i])));
            const double v53 = (data_column[1][i] * multipliers_column[2][i]);
            const double v55 = ((v49 * multipliers_column[3][i]) + (v54 * multipliers_column[2][i]));
            const double v56 = (data_column[0][i] * multipliers_column[2][i]);
            const double v59 = ((cos(v5) * ((v45 * (data_column[0][i] * multipliers_column[3][i])) + (v33 * v56))) - (sin(v5) * v55));
            const double v66 = (v65 * v48);
            const double v68 = (v9 * multipliers_column[2][i]);
            const double v70 = (local_column[3][i] * v68);
            const double v74 = (v73 * v51);
            const double v76 = (v75 * v51);
            const double v81 = ((cos(v7) * ((v45 * (data_column[1][i] * multipliers_column[3][i])) + (v33 * v53))) - (sin(v7) * v55));
            const double v82 = (v12 * multipliers_column[2][i]);
            const double v83 = (local_column[7][i] * v82);
            value[0][i] = (constants[10] * (((v61 * (sin(v2) * multipliers_column[2][i])) - (constants[10] * v59)) - (v62 * (cos(v2) * v56))));
            value[1][i] = (-(v60 * v59));
            value[2][i] = (-(v78 * (v59 + ((v15 * ((v36 * ((local_column[2][i] * local_column[2][i]) * multipliers_column[3][i])) + (v20 * ((local_column[3][i] * v14) * multipliers_column[2][i])))) + (v9 * v52)))));
            value[3][i] = (((v64 * (local_column[2][i] * (v9 * multipliers_column[3][i]))) + (v71 * v70)) + (v66 - v76));
            value[4][i] = (v37 * v48);
            value[5][i] = (((v69 * (v14 * v68)) + (v72 * v70)) + v74);
            value[6][i] = (v21 * v51);
            value[7][i] = (v79 * v51);
            value[8][i] = (constants[10] * (((v61 * (sin(v3) * multipliers_column[2][i])) - (constants[10] * v81)) - (v62 * (cos(v3) * v53))));
            value[9][i] = (-(constants[11] * (v17 * ((v27 * multipliers_column[2][i]) - (v46 * multipliers_column[3][i])))));
            value[10][i] = (v80 * v50);
            value[11][i] = (-(v60 * v81));
            value[12][i] = (-(v78 * (v81 + ((v17 * ((v36 * ((local_column[6][i] * local_column[6][i]) * multipliers_column[3][i])) + (v20 * ((local_column[7][i] * v16) * multipliers_column[2][i])))) + (v12 * v52)))));
            value[13][i] = (v76 - v66);
            value[14][i] = (((v64 * (local_column[6][i] * (v12 * multipliers_column[3][i]))) + (v71 * v83)) + ((v75 * v50) - (v65 * v47)));
            value[15][i] = (v37 * v47);
            value[16][i] = (-v74);
            value[17][i] = (((v69 * (v16 * v82)) + (v72 * v83)) - (v73 * v50));
            value[18][i] = (v21 * v50);
            value[19][i] = (v79 * v50);
            value[20][i] = (v58 * multipliers_column[2][i]);
            value[21][i] = (v58 * multipliers_column[2][i]);
            value[22][i] = (v77 * multipliers_column[2][i]);
            value[23][i] = (v77 * multipliers_column[2][i]);
            value[24][i] = (v29 * multipliers_column[2][i]);
            value[25][i] = (v29 * multipliers_column[2][i]);
            value[26][i] = (v28 * multipliers_column[2][i]);
            value[27][i] = (v28 * multipliers_column[2][i]);
            value[28][i] = (v57 * multipliers_column[3][i]);
            value[29][i] = (v57 * multipliers_column[3][i]);
            value[30][i] = (v67 * multipliers_column[3][i]);
            value[31][i] = (v67 * multipliers_column[3][i]);
            value[32][i] = (v41 * multipliers_column[3][i]);
            value[33][i] = (v41 * multipliers_column[3][i]);
            value[34][i] = (v40 * multipliers_column[3][i]);
            value[35][i] = (v40 * multipliers_column[3][i]);
            value[36][i] = (v84 * multipliers_column[2][i]);
            value[37][i] = (v86 * multipliers_column[3][i]);
            value[38][i] = (v85 * multipliers_column[2][i]);
            value[39][i] = (v87 * multipliers_column[3][i]);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 40; j++) out[index[k * 40 + j]] += value[j][i];
        }
    }
}
