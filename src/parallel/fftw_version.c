/* The version of FFTW, a variable of unknown length, which Fortran cannot declare. */
#include <fftw3.h>

const char *wavycon_fftw_version(void);

const char *wavycon_fftw_version(void)
{
   return fftw_version;
}
