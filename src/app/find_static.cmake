# Sets wavycon_archives to the archives to which the program is linked statically; empty if it is linked to shared
# libraries, whose loading takes as long as a small deck. WAVYCON_STATIC is AUTO, ON or OFF.
set(wavycon_archives)
# libgfortran calls these if a program has threads; OpenMP brings its other functions of threads, but not these.
set(wavycon_static_options -static -fopenmp LINKER:-u,pthread_mutex_destroy,-u,pthread_mutex_init)
if(WAVYCON_STATIC)
  # The archives beside the shared libraries, so that they fit the headers. The compiler's own may be missing, and
  # sanitizers cannot be linked statically.
  set(archives ${LAPACK_LIBRARIES} ${GSL_LIBRARIES} ${wavycon-fftw_LIBRARY} ${wavycon-fftw_SINGLE_LIBRARY} ${CMAKE_DL_LIBS})
  list(TRANSFORM archives REPLACE "\\.so$" ".a")
  set(CMAKE_REQUIRED_LIBRARIES ${archives})
  set(CMAKE_REQUIRED_LINK_OPTIONS ${wavycon_static_options})
  include(CheckSourceCompiles)
  check_source_compiles(Fortran "use omp_lib\nexternal :: dposv, openblas_set_num_threads
    call dposv()\ncall openblas_set_num_threads(omp_get_max_threads())\nend" wavycon_links_statically SRC_EXT f90)
  unset(CMAKE_REQUIRED_LIBRARIES)
  unset(CMAKE_REQUIRED_LINK_OPTIONS)
  if(wavycon_links_statically)
    set(wavycon_archives ${archives})
  elseif(NOT WAVYCON_STATIC STREQUAL "AUTO")
    message(FATAL_ERROR "wavycon: WAVYCON_STATIC is ${WAVYCON_STATIC}, but archives of OpenBLAS, FFTW, GSL or the "
      "compiler's libraries are missing or cannot be linked")
  endif()
endif()
if(wavycon_archives)
  message(STATUS "wavycon: the program is linked statically")
else()
  message(STATUS "wavycon: the program is linked to shared libraries")
endif()
