!> The program for several processes: `mpirun -n 4 wavycon-mpi deck.nml`.
program wavycon_mpi_main
   use wavycon_mpi_ranks, only: start_mpi
   use wavycon_run_program, only: run_program
   use wavycon_threads, only: let_waiting_threads_sleep
   implicit none (type, external)

   call let_waiting_threads_sleep()
   call start_mpi()
   call run_program()
end program wavycon_mpi_main
