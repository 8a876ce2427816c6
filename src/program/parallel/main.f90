!> The parallel program, for several processes: `mpirun -n 4 wavycon-mpi deck.nml`.
program wavycon_mpi_main
   use wavycon_mpi_ranks, only: start_mpi
   use wavycon_run_program, only: run_program
   implicit none (type, external)

   call start_mpi()
   call run_program()
end program wavycon_mpi_main
