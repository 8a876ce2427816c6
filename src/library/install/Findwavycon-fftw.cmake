# FFTW in double and single precision, as the target wavycon::fftw, and the directory of its Fortran interface,
# wavycon-fftw_INCLUDE_DIR. Used to build wavycon, and installed for programs that link the static library.
find_path(wavycon-fftw_INCLUDE_DIR fftw3.f03)
find_library(wavycon-fftw_LIBRARY fftw3)
find_library(wavycon-fftw_SINGLE_LIBRARY fftw3f)
mark_as_advanced(wavycon-fftw_INCLUDE_DIR wavycon-fftw_LIBRARY wavycon-fftw_SINGLE_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(wavycon-fftw REQUIRED_VARS
  wavycon-fftw_LIBRARY wavycon-fftw_SINGLE_LIBRARY wavycon-fftw_INCLUDE_DIR)

if(wavycon-fftw_FOUND AND NOT TARGET wavycon::fftw)
  add_library(wavycon::fftw INTERFACE IMPORTED)
  set_target_properties(wavycon::fftw PROPERTIES
    INTERFACE_LINK_LIBRARIES "${wavycon-fftw_SINGLE_LIBRARY};${wavycon-fftw_LIBRARY}")
endif()
