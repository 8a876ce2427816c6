# FFTW's MPI libraries in double and single precision, as the target wavycon::fftw-mpi, and the directory of their
# Fortran interface, wavycon-fftw-mpi_INCLUDE_DIR. Used to build wavycon-mpi, after find_package(MPI) and
# find_package(wavycon-fftw).

# Some systems keep the libraries that depend on MPI beside MPI's own.
set(wavycon_mpi_folders)
foreach(library IN LISTS MPI_Fortran_LIBRARIES)
  get_filename_component(folder "${library}" DIRECTORY)
  list(APPEND wavycon_mpi_folders "${folder}")
endforeach()

find_path(wavycon-fftw-mpi_INCLUDE_DIR fftw3-mpi.f03 HINTS ${MPI_Fortran_INCLUDE_DIRS})
find_library(wavycon-fftw-mpi_LIBRARY fftw3_mpi HINTS ${wavycon_mpi_folders})
find_library(wavycon-fftw-mpi_SINGLE_LIBRARY fftw3f_mpi HINTS ${wavycon_mpi_folders})
mark_as_advanced(wavycon-fftw-mpi_INCLUDE_DIR wavycon-fftw-mpi_LIBRARY wavycon-fftw-mpi_SINGLE_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(wavycon-fftw-mpi REQUIRED_VARS
  wavycon-fftw-mpi_LIBRARY wavycon-fftw-mpi_SINGLE_LIBRARY wavycon-fftw-mpi_INCLUDE_DIR)

if(wavycon-fftw-mpi_FOUND AND NOT TARGET wavycon::fftw-mpi)
  add_library(wavycon::fftw-mpi INTERFACE IMPORTED)
  set_target_properties(wavycon::fftw-mpi PROPERTIES
    INTERFACE_LINK_LIBRARIES
    "${wavycon-fftw-mpi_SINGLE_LIBRARY};${wavycon-fftw-mpi_LIBRARY};wavycon::fftw;MPI::MPI_Fortran")
endif()
