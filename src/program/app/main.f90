!> The program.
program wavycon_main
   use wavycon_run_program, only: run_program
   use wavycon_threads, only: let_waiting_threads_sleep
   implicit none (type, external)

   call let_waiting_threads_sleep()
   call run_program()
end program wavycon_main
