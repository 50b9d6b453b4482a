// The dense kernels of BLAS and LAPACK that the factorization needs, by their Fortran names, which every BLAS has.
#pragma once

extern "C" {
void dpotrf_(const char* triangle, const int* n, double* A, const int* stride, int* info);
void dtrsm_(const char* side, const char* triangle, const char* transposed, const char* unit, const int* rows,
            const int* columns, const double* scale, const double* A, const int* stride, double* B,
            const int* stride_of_B);
void dsyrk_(const char* triangle, const char* transposed, const int* n, const int* depth, const double* scale,
            const double* A, const int* stride, const double* scale_of_C, double* C, const int* stride_of_C);
void dgemm_(const char* A_transposed, const char* B_transposed, const int* rows, const int* columns, const int* depth,
            const double* scale, const double* A, const int* stride, const double* B, const int* stride_of_B,
            const double* scale_of_C, double* C, const int* stride_of_C);
}
