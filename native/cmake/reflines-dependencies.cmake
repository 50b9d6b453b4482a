# The solver's libraries that bring no CMake package of their own, as two imported targets. The build includes this file,
# and so does the installed package. A prefix that native/superbuild has filled brings both. Elsewhere each path can be set
# from outside: CHOLMOD, UMFPACK, OPENBLAS, SUITESPARSE_INCLUDE, OPENBLAS_INCLUDE and OSD_CPU.
find_package(reflines-libraries QUIET)
if(NOT TARGET reflines::suitesparse)
  find_library(CHOLMOD cholmod REQUIRED)
  find_library(UMFPACK umfpack REQUIRED)
  find_library(OPENBLAS openblas REQUIRED)
  find_path(SUITESPARSE_INCLUDE umfpack.h PATH_SUFFIXES suitesparse REQUIRED)
  if(NOT REFLINES_SERIAL_BLAS)
    # MSYS2 has it in that folder, Homebrew below a prefix of its own.
    find_path(OPENBLAS_INCLUDE cblas.h PATH_SUFFIXES openblas REQUIRED)
  endif()
  add_library(reflines::suitesparse INTERFACE IMPORTED GLOBAL)
  target_include_directories(reflines::suitesparse SYSTEM INTERFACE ${SUITESPARSE_INCLUDE} ${OPENBLAS_INCLUDE})
  target_link_libraries(reflines::suitesparse INTERFACE ${UMFPACK} ${CHOLMOD} ${OPENBLAS})
endif()

if(NOT TARGET reflines::opensubdiv)
  find_library(OSD_CPU osdCPU REQUIRED)
  add_library(reflines::opensubdiv INTERFACE IMPORTED GLOBAL)
  target_link_libraries(reflines::opensubdiv INTERFACE ${OSD_CPU})
endif()
