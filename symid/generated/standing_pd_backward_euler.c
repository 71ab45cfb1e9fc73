// 66a93265676cf60c31e3e0bd51f0f3fd
// {"name": "standing on a moving platform, PD interval", "m": 4, "n_local": 8, "n_shared": 6, "n_data": 3, "n_constants": 24, "jacobian": [[0, 0], [0, 4], [0, 6], [1, 1], [1, 5], [1, 7], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [2, 8], [2, 9], [2, 12], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7], [3, 10], [3, 11], [3, 13]], "hessian": [[4, 4], [5, 2], [5, 3], [5, 4], [5, 5], [6, 5], [6, 6], [7, 5], [7, 6], [7, 7], [8, 4], [9, 6], [10, 5], [11, 7], [12, 8], [13, 10]]}
// local[0]: ankle_angle#0
// local[1]: hip_angle#0
// local[2]: ankle_velocity#0
// local[3]: hip_velocity#0
// local[4]: ankle_angle#1
// local[5]: hip_angle#1
// local[6]: ankle_velocity#1
// local[7]: hip_velocity#1
// shared[0]: kp_ankle
// shared[1]: kd_ankle
// shared[2]: kp_hip
// shared[3]: kd_hip
// shared[4]: ref_ankle
// shared[5]: ref_hip
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
    const double v19 = (constants[4] * (constants[5] * constants[5]));
    const double v21 = (constants[4] * (constants[3] * constants[5]));
    const double v22 = (2.0 * v21);
    const double v23 = (v19 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v24 = (constants[12] * v1);
    const double v26 = (constants[6] + v19);
    const double v28 = (constants[13] * v1);
    const double v29 = (2.0 * constants[12]);
    const double v31 = (constants[4] * (constants[5] * (constants[3] * constants[13])));
    const double v32 = (1.0 / constants[23]);
    const double v33 = (constants[5] * constants[7]);
    const double v34 = (shared[5] * constants[19]);
    const double v35 = (shared[2] * constants[16]);
    const double v36 = (constants[17] * (shared[3] * constants[13]));
    const double v37 = (v26 * v28);
    const double v38 = (v21 * (constants[12] * constants[12]));
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
            const double v18 = (local_column[6][i] - local_column[2][i]);
            const double v20 = cos(v11);
            const double v25 = (local_column[7][i] - local_column[3][i]);
            const double v27 = (v26 + (v21 * v20));
            const double v30 = sin(v11);
            value[0][i] = (v0 * ((constants[12] * local_column[6][i]) - (v2 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v3 * (v4 - (v5 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v6 * ((v31 * (v30 * (local_column[7][i] * (v4 + (v29 * local_column[6][i]))))) - ((v28 * (v25 * v27)) + ((v24 * (v18 * (v23 + (v22 * v20)))) + ((v17 * local_column[6][i]) + ((v16 * (v7 - v15)) + ((constants[4] * ((data_column[0][i] * ((constants[3] * v8) + (constants[5] * v14))) - (constants[7] * ((constants[3] * v9) + (constants[5] * v13))))) + (data_column[1][i] + (constants[0] * ((constants[1] * (data_column[0][i] * v8)) - (v10 * v9)))))))))));
            value[3][i] = (-(v32 * ((v38 * (v30 * (local_column[6][i] * local_column[6][i]))) + ((v37 * v25) + ((v24 * (v18 * v27)) + ((v36 * local_column[7][i]) + ((v35 * (v11 - v34)) + (data_column[2][i] + (constants[4] * ((constants[5] * (data_column[0][i] * v14)) - (v33 * v13)))))))))));
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
    const double v0 = (1.0 / constants[20]);
    const double v1 = (1.0 / constants[9]);
    const double v2 = (1.0 / constants[21]);
    const double v3 = (1.0 / constants[22]);
    const double v8 = (shared[4] * constants[18]);
    const double v10 = (constants[4] * (constants[5] * constants[5]));
    const double v12 = (constants[4] * (constants[3] * constants[5]));
    const double v13 = (2.0 * v12);
    const double v14 = (v10 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v15 = (constants[12] * v1);
    const double v16 = (constants[6] + v10);
    const double v18 = (constants[13] * v1);
    const double v19 = (2.0 * constants[12]);
    const double v22 = (1.0 / constants[23]);
    const double v23 = (shared[5] * constants[19]);
    const double v24 = (v3 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v26 = (2.0 * (constants[12] * v24));
    const double v27 = (v3 * v18);
    const double v28 = (v12 * v27);
    const double v29 = (v3 * v15);
    const double v30 = (2.0 * (v12 * v29));
    const double v31 = (v3 * (constants[15] * (shared[1] * constants[12])));
    const double v32 = (constants[12] * (constants[15] * v3));
    const double v33 = (v3 * (shared[0] * constants[14]));
    const double v34 = (constants[14] * v3);
    const double v35 = (constants[4] * v3);
    const double v36 = (constants[5] * v35);
    const double v38 = (constants[7] * v35);
    const double v39 = (constants[5] * v38);
    const double v41 = (constants[0] * v3);
    const double v42 = ((constants[3] * v38) + ((constants[1] * constants[7]) * v41));
    const double v43 = ((constants[3] * v35) + (constants[1] * v41));
    const double v44 = (constants[13] * v24);
    const double v45 = (v22 * (v12 * (constants[12] * constants[12])));
    const double v46 = (v45 + v45);
    const double v47 = (v15 * v22);
    const double v48 = (constants[13] * (constants[17] * v22));
    const double v49 = (v22 * (shared[2] * constants[16]));
    const double v50 = (constants[16] * v22);
    const double v51 = (constants[4] * v22);
    const double v52 = ((constants[5] * constants[7]) * v51);
    const double v53 = (constants[5] * v51);
    const double v54 = (v12 * v47);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[3][BLOCK] __attribute__((aligned(64)));
        double value[24][BLOCK] __attribute__((aligned(64)));
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
            const double v9 = (local_column[6][i] - local_column[2][i]);
            const double v11 = cos(v5);
            const double v17 = (v16 + (v12 * v11));
            const double v20 = ((constants[13] * local_column[7][i]) + (v19 * local_column[6][i]));
            const double v21 = sin(v5);
            const double v25 = (local_column[7][i] * v21);
            const double v37 = (data_column[0][i] * sin(v6));
            const double v40 = ((v36 * v37) + (v39 * v7));
            const double v55 = ((v53 * v37) + (v52 * v7));
            value[0][i] = (v0 * (constants[10] * v1));
            value[1][i] = (-(v0 * (constants[10] * v1)));
            value[2][i] = (constants[12] * v0);
            value[3][i] = (v2 * (constants[11] * v1));
            value[4][i] = (-(v2 * (constants[11] * v1)));
            value[5][i] = (constants[13] * v2);
            value[6][i] = (v29 * (v14 + (v13 * v11)));
            value[7][i] = (v27 * v17);
            value[8][i] = (constants[10] * (((v40 - v33) + (v42 * cos(v4))) + (v43 * (data_column[0][i] * sin(v4)))));
            value[9][i] = (constants[11] * (((v24 * (v11 * (local_column[7][i] * v20))) + (v21 * ((v28 * (local_column[7][i] - local_column[3][i])) + (v30 * v9)))) + v40));
            value[10][i] = (((v26 * v25) - (v29 * (v14 + (v13 * v11)))) - v31);
            value[11][i] = (((v24 * (v20 * v21)) - (v27 * v17)) + (v44 * v25));
            value[12][i] = (-(v34 * (v4 - v8)));
            value[13][i] = (-(v32 * local_column[6][i]));
            value[14][i] = (constants[18] * v33);
            value[15][i] = (v47 * v17);
            value[16][i] = (v22 * (v16 * v18));
            value[17][i] = (constants[10] * v55);
            value[18][i] = (constants[11] * (((v54 * (v9 * v21)) - (v49 + (v45 * (v11 * (local_column[6][i] * local_column[6][i]))))) + v55));
            value[19][i] = (-((v46 * (local_column[6][i] * v21)) + (v47 * v17)));
            value[20][i] = (-((v22 * (v16 * v18)) + (v22 * (constants[17] * (shared[3] * constants[13])))));
            value[21][i] = (-(v50 * (v5 - v23)));
            value[22][i] = (-(v48 * local_column[7][i]));
            value[23][i] = (constants[19] * v49);
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
    const double v1 = (1.0 / constants[22]);
    const double v7 = (constants[4] * (constants[3] * constants[5]));
    const double v8 = (constants[12] * v0);
    const double v9 = (2.0 * constants[12]);
    const double v12 = (1.0 / constants[23]);
    const double v13 = (v1 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v14 = (constants[12] * v13);
    const double v15 = (2.0 * v14);
    const double v16 = (v1 * (constants[13] * v0));
    const double v17 = (v1 * v8);
    const double v18 = (2.0 * (v7 * v17));
    const double v19 = (constants[12] * (constants[15] * v1));
    const double v20 = (constants[14] * v1);
    const double v21 = (constants[4] * v1);
    const double v22 = (constants[5] * v21);
    const double v23 = (constants[7] * v21);
    const double v24 = (constants[5] * v23);
    const double v25 = (constants[0] * v1);
    const double v26 = (constants[13] * v13);
    const double v27 = (v12 * (v7 * (constants[12] * constants[12])));
    const double v28 = (v27 + v27);
    const double v29 = (v8 * v12);
    const double v30 = (constants[13] * (constants[17] * v12));
    const double v31 = (constants[16] * v12);
    const double v32 = (constants[4] * v12);
    const double v33 = ((constants[5] * constants[7]) * v32);
    const double v34 = (constants[5] * v32);
    const double v35 = (v7 * v29);
    const double v39 = (constants[11] * (v7 * v16));
    const double v40 = (constants[10] * v20);
    const double v42 = (constants[10] * constants[11]);
    const double v43 = (constants[10] * ((constants[3] * v23) + ((constants[1] * constants[7]) * v25)));
    const double v44 = (constants[10] * ((constants[3] * v21) + (constants[1] * v25)));
    const double v45 = (constants[11] * v7);
    const double v46 = (constants[11] * v28);
    const double v47 = (v29 * v45);
    const double v48 = (constants[11] * v31);
    const double v50 = (constants[11] * v13);
    const double v52 = (2.0 * (constants[11] * v14));
    const double v53 = (v16 * v45);
    const double v54 = (2.0 * (v17 * v45));
    const double v55 = (constants[11] * constants[11]);
    const double v56 = (constants[13] * v50);
    const double v57 = (v26 + v26);
    const double v58 = (constants[18] * v20);
    const double v59 = (constants[19] * v31);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[3][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[16][BLOCK] __attribute__((aligned(64)));
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
            const double v36 = (v11 * multipliers_column[3][i]);
            const double v37 = (v11 * multipliers_column[2][i]);
            const double v38 = (data_column[0][i] * multipliers_column[2][i]);
            const double v41 = ((cos(v4) * ((v34 * (data_column[0][i] * multipliers_column[3][i])) + (v22 * v38))) - (sin(v4) * ((v33 * multipliers_column[3][i]) + (v24 * multipliers_column[2][i]))));
            const double v49 = (v6 * multipliers_column[2][i]);
            const double v51 = (local_column[7][i] * v49);
            value[0][i] = (constants[10] * (((constants[10] * v41) - (v43 * (sin(v2) * multipliers_column[2][i]))) + (v44 * (cos(v2) * v38))));
            value[1][i] = (-(constants[11] * (v11 * ((v35 * multipliers_column[3][i]) + (v18 * multipliers_column[2][i])))));
            value[2][i] = (-(v39 * v37));
            value[3][i] = (v42 * v41);
            value[4][i] = (v55 * (v41 + ((v6 * ((v7 * ((v29 * (v5 * multipliers_column[3][i])) + (v16 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) + (v18 * (v5 * multipliers_column[2][i])))) - (v11 * ((v13 * ((local_column[7][i] * v10) * multipliers_column[2][i])) - (v27 * ((local_column[6][i] * local_column[6][i]) * multipliers_column[3][i])))))));
            value[5][i] = (((v52 * v51) - (v46 * (local_column[6][i] * (v6 * multipliers_column[3][i])))) + ((v47 * v36) + (v54 * v37)));
            value[6][i] = (-(v28 * v36));
            value[7][i] = (((v50 * (v10 * v49)) + (v53 * v37)) + (v56 * v51));
            value[8][i] = (v15 * v37);
            value[9][i] = (v57 * v37);
            value[10][i] = (-(v40 * multipliers_column[2][i]));
            value[11][i] = (-(v19 * multipliers_column[2][i]));
            value[12][i] = (-(v48 * multipliers_column[3][i]));
            value[13][i] = (-(v30 * multipliers_column[3][i]));
            value[14][i] = (v58 * multipliers_column[2][i]);
            value[15][i] = (v59 * multipliers_column[3][i]);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 16; j++) out[index[k * 16 + j]] += value[j][i];
        }
    }
}
