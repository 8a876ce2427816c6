!> The program `wavycon`, a single process.
program wavycon_main
   use wavycon_run_program, only: run_program
   implicit none (type, external)

   call run_program()
end program wavycon_main
