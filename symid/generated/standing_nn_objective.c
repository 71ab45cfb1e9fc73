// 78d19e0275499a15e8127f8ae722fb69
// {"name": "standing on a moving platform, NeuralNetwork objective", "m": 1, "n_local": 4, "n_shared": 30, "n_data": 2, "n_constants": 46, "jacobian": [[0, 0], [0, 1]], "hessian": [[0, 0], [1, 1]]}
// local[0]: ankle_angle
// local[1]: hip_angle
// local[2]: ankle_velocity
// local[3]: hip_velocity
// shared[0]: w_in_1_1
// shared[1]: w_in_1_2
// shared[2]: w_in_1_3
// shared[3]: w_in_1_4
// shared[4]: w_in_1_5
// shared[5]: w_in_2_1
// shared[6]: w_in_2_2
// shared[7]: w_in_2_3
// shared[8]: w_in_2_4
// shared[9]: w_in_2_5
// shared[10]: w_in_3_1
// shared[11]: w_in_3_2
// shared[12]: w_in_3_3
// shared[13]: w_in_3_4
// shared[14]: w_in_3_5
// shared[15]: w_in_4_1
// shared[16]: w_in_4_2
// shared[17]: w_in_4_3
// shared[18]: w_in_4_4
// shared[19]: w_in_4_5
// shared[20]: w_out_1_1
// shared[21]: w_out_1_2
// shared[22]: w_out_1_3
// shared[23]: w_out_1_4
// shared[24]: w_out_1_5
// shared[25]: w_out_2_1
// shared[26]: w_out_2_2
// shared[27]: w_out_2_3
// shared[28]: w_out_2_4
// shared[29]: w_out_2_5
// data[0]: measured_ankle_angle#recorded
// data[1]: measured_hip_angle#recorded
// constants[0]: leg_mass
// constants[1]: leg_com
// constants[2]: leg_inertia
// constants[3]: leg_length
// constants[4]: trunk_mass
// constants[5]: trunk_com
// constants[6]: trunk_inertia
// constants[7]: gravity
// constants[8]: friction_speed
// constants[9]: torque_scale
// constants[10]: scale ankle_angle
// constants[11]: scale hip_angle
// constants[12]: scale ankle_velocity
// constants[13]: scale hip_velocity
// constants[14]: scale w_in_1_1
// constants[15]: scale w_in_1_2
// constants[16]: scale w_in_1_3
// constants[17]: scale w_in_1_4
// constants[18]: scale w_in_1_5
// constants[19]: scale w_in_2_1
// constants[20]: scale w_in_2_2
// constants[21]: scale w_in_2_3
// constants[22]: scale w_in_2_4
// constants[23]: scale w_in_2_5
// constants[24]: scale w_in_3_1
// constants[25]: scale w_in_3_2
// constants[26]: scale w_in_3_3
// constants[27]: scale w_in_3_4
// constants[28]: scale w_in_3_5
// constants[29]: scale w_in_4_1
// constants[30]: scale w_in_4_2
// constants[31]: scale w_in_4_3
// constants[32]: scale w_in_4_4
// constants[33]: scale w_in_4_5
// constants[34]: scale w_out_1_1
// constants[35]: scale w_out_1_2
// constants[36]: scale w_out_1_3
// constants[37]: scale w_out_1_4
// constants[38]: scale w_out_1_5
// constants[39]: scale w_out_2_1
// constants[40]: scale w_out_2_2
// constants[41]: scale w_out_2_3
// constants[42]: scale w_out_2_4
// constants[43]: scale w_out_2_5
// constants[44]: measured_ankle_angle#weight
// constants[45]: measured_hip_angle#weight
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

    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[4][BLOCK] __attribute__((aligned(64)));
        double data_column[2][BLOCK] __attribute__((aligned(64)));
        double value[1][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 4; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 2; j++) data_column[j][i] = data[k * 2 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v0 = ((constants[10] * local_column[0][i]) - data_column[0][i]);
            const double v1 = ((constants[11] * local_column[1][i]) - data_column[1][i]);
            value[0][i] = ((constants[44] * (v0 * v0)) + (constants[45] * (v1 * v1)));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 1; j++) out[k * 1 + j] = value[j][i];
        }
    }
}


void jacobian(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (constants[11] * (constants[45] + constants[45]));
    const double v1 = (constants[10] * (constants[44] + constants[44]));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[4][BLOCK] __attribute__((aligned(64)));
        double data_column[2][BLOCK] __attribute__((aligned(64)));
        double value[2][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 4; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 2; j++) data_column[j][i] = data[k * 2 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            value[0][i] = (v1 * ((constants[10] * local_column[0][i]) - data_column[0][i]));
            value[1][i] = (v0 * ((constants[11] * local_column[1][i]) - data_column[1][i]));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 2; j++) out[k * 2 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (constants[10] * (constants[10] * (constants[44] + constants[44])));
    const double v1 = (constants[11] * (constants[11] * (constants[45] + constants[45])));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double multipliers_column[1][BLOCK] __attribute__((aligned(64)));
        double value[2][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 1; j++) multipliers_column[j][i] = multipliers[k * 1 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            value[0][i] = (v0 * multipliers_column[0][i]);
            value[1][i] = (v1 * multipliers_column[0][i]);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 2; j++) out[index[k * 2 + j]] += value[j][i];
        }
    }
}
