program wavycon_main
   implicit none (type, external)
end program wavycon_main
