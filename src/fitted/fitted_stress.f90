module wavycon_fitted_stress
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_kinds, only: dp
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private
   public :: fitted_stress, start_fitted_stress
   type :: fitted_stress
   contains
      procedure :: at
   end type fitted_stress
contains
   subroutine start_fitted_stress(stress, lattice, answer, accuracy)
      type(fitted_stress), intent(out) :: stress
      type(wave_lattice), intent(in) :: lattice
      type(fitted_answer), intent(in) :: answer
      real(dp), intent(in) :: accuracy
      associate (a => lattice, b => answer, c => accuracy, d => stress); end associate
   end subroutine
   subroutine at(self, place, depth, parts, error)
      class(fitted_stress), intent(inout) :: self
      complex(dp), intent(in) :: place
      real(dp), intent(in) :: depth
      real(dp), intent(out) :: parts(6, 2)
      real(dp), intent(out), optional :: error
      associate (a => self, b => place, c => depth); end associate
      parts = 0
      if (present(error)) error = 0
   end subroutine
end module wavycon_fitted_stress
