/* Times a pair of FFTW's own distributed transforms, real to complex and back, in single precision and in place, with
   FFTW_MPI_TRANSPOSED_OUT and _IN. `bench_ranks` times the pair that wavycon-mpi uses in their place.

      mpirun -n RANKS bench_fftw_mpi POINTS

   writes for FFTW_ESTIMATE and FFTW_MEASURE the median and the least time of the slowest rank [s] on POINTS x POINTS
   points. */
#include <fftw3-mpi.h>
#include <stdio.h>
#include <stdlib.h>

#define REPEATS 11

static int compare(const void *a, const void *b)
{
   const double x = *(const double *)a, y = *(const double *)b;
   return (x > y) - (x < y);
}

static void time_pair(ptrdiff_t points, unsigned flag, const char *name)
{
   ptrdiff_t columns, first, rows, first_row;
   const ptrdiff_t size = fftwf_mpi_local_size_2d_transposed(points, points/2 + 1, MPI_COMM_WORLD, &columns, &first,
                                                             &rows, &first_row);
   float *field = fftwf_alloc_real(2*size);
   fftwf_plan forward = fftwf_mpi_plan_dft_r2c_2d(points, points, field, (fftwf_complex *)field, MPI_COMM_WORLD,
                                                  flag | FFTW_MPI_TRANSPOSED_OUT);
   fftwf_plan backward = fftwf_mpi_plan_dft_c2r_2d(points, points, (fftwf_complex *)field, field, MPI_COMM_WORLD,
                                                   flag | FFTW_MPI_TRANSPOSED_IN);
   double times[REPEATS];
   int i, rank;

   MPI_Comm_rank(MPI_COMM_WORLD, &rank);
   for (i = 0; i < REPEATS; i++) {
      double seconds;
      ptrdiff_t k;

      for (k = 0; k < 2*size; k++) field[k] = (float)(k % 97);
      MPI_Barrier(MPI_COMM_WORLD);
      seconds = MPI_Wtime();
      fftwf_execute(forward);
      fftwf_execute(backward);
      seconds = MPI_Wtime() - seconds;
      MPI_Allreduce(&seconds, &times[i], 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
   }
   qsort(times, REPEATS, sizeof times[0], compare);
   if (rank == 0) printf("%s %.4g %.4g\n", name, times[REPEATS/2], times[0]);
   fftwf_destroy_plan(forward);
   fftwf_destroy_plan(backward);
   fftwf_free(field);
}

int main(int argc, char **argv)
{
   ptrdiff_t points;

   MPI_Init(&argc, &argv);
   fftwf_mpi_init();
   points = argc > 1 ? atol(argv[1]) : 0;
   if (points < 2) {
      fprintf(stderr, "usage: mpirun -n RANKS bench_fftw_mpi POINTS\n");
      MPI_Abort(MPI_COMM_WORLD, 1);
   }
   time_pair(points, FFTW_ESTIMATE, "FFTW_ESTIMATE");
   time_pair(points, FFTW_MEASURE, "FFTW_MEASURE");
   MPI_Finalize();
   return 0;
}
