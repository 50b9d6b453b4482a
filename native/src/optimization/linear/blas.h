// The dense kernels of BLAS and LAPACK that the factorization needs, by their Fortran names, which every BLAS has.
#pragma once

// NOLINTBEGIN(readability-identifier-naming): the names are Fortran's.
extern "C" {
void dpotrf_(const char* triangle, const int* n, double* a, const int* stride, int* info);
void dtrsm_(const char* side, const char* triangle, const char* transposed, const char* unit, const int* rows,
            const int* columns, const double* scale, const double* a, const int* stride, double* b,
            const int* stride_b);
void dsyrk_(const char* triangle, const char* transposed, const int* n, const int* depth, const double* scale,
            const double* a, const int* stride, const double* scale_c, double* c, const int* stride_c);
void dgemm_(const char* transposed_a, const char* transposed_b, const int* rows, const int* columns, const int* depth,
            const double* scale, const double* a, const int* stride, const double* b, const int* stride_b,
            const double* scale_c, double* c, const int* stride_c);
}
// NOLINTEND(readability-identifier-naming)
