/* Times DAQP, a dual active-set method in C, on the programme and the loads that programmes.py hands on.
 *
 * Standard input: n and m; the n columns of D, c, and the m rows of C of  min 1/2 x'Dx - c'x,  Cx >= -P;  then lines
 * with a load P, a tolerance of Cx >= -P and a number of solves. Each is answered by three lines: exit flag and
 * iterations; the times of the solves [ms], each from the matrices, with setup; x. */
#include "api.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double clock_ms(void)
{
   struct timespec now;
   clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
   return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static double *numbers(int count)
{
   double *values = malloc((size_t)count * sizeof *values);
   for (int i = 0; values && i < count; i++)
      if (scanf("%lf", values + i) != 1) exit(1);
   return values;
}

int main(void)
{
   int n, m, solves;
   double load, tolerance;
   if (scanf("%d %d", &n, &m) != 2) return 1;
   double *hessian = numbers(n * n), *linear = numbers(n), *rows = numbers(n * m);
   double *lower = malloc((size_t)m * sizeof *lower), *upper = malloc((size_t)m * sizeof *upper);
   double *x = malloc((size_t)n * sizeof *x), *multipliers = malloc((size_t)m * sizeof *multipliers);
   int *sense = malloc((size_t)m * sizeof *sense);
   if (!hessian || !linear || !rows || !lower || !upper || !x || !multipliers || !sense) return 1;
   for (int i = 0; i < n; i++) linear[i] = -linear[i];

   while (scanf("%lf %lf %d", &load, &tolerance, &solves) == 3) {
      double *times = malloc((size_t)solves * sizeof *times);
      DAQPResult result = {0};
      if (!times) return 1;
      for (int k = 0; k < solves; k++) {
         DAQPProblem programme = {0};
         DAQPSettings settings;
         for (int i = 0; i < m; i++) {
            lower[i] = -load;
            upper[i] = DAQP_INF;
         }
         memset(sense, 0, (size_t)m * sizeof *sense);
         programme.n = n;
         programme.m = m;
         programme.H = hessian;
         programme.f = linear;
         programme.A = rows;
         programme.blower = lower;
         programme.bupper = upper;
         programme.sense = sense;
         daqp_default_settings(&settings);
         settings.primal_tol = tolerance;
         result.x = x;
         result.lam = multipliers;
         double before = clock_ms();
         daqp_quadprog(&result, &programme, &settings);
         times[k] = clock_ms() - before;
      }
      printf("%d %d\n", result.exitflag, result.iter);
      for (int k = 0; k < solves; k++) printf("%.6f ", times[k]);
      printf("\n");
      for (int i = 0; i < n; i++) printf("%.17g ", x[i]);
      printf("\n");
      fflush(stdout);
      free(times);
   }
   return 0;
}
