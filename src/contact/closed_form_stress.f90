!> The stresses under Westergaard's pressure.
module wavycon_closed_form_stress
   use wavycon_constants, only: pi
   use wavycon_elastic_body, only: elastic_body
   use wavycon_kinds, only: dp
   use wavycon_stress_fields, only: stress_fields
   use wavycon_westergaard, only: westergaard_contact_area_fraction, westergaard_peak_pressure_over_pstar
   use wavycon_westergaard_stress, only: westergaard_stress
   implicit none (type, external)
   private

   public :: closed_form_stress

   type, extends(stress_fields) :: closed_form_stress
   contains
      procedure :: at
      procedure :: start_places
   end type closed_form_stress

contains

   subroutine at(self, x, y, depth, parts, error)
      class(closed_form_stress), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(in) :: depth
      real(dp), intent(out) :: parts(6, 2)
      real(dp), intent(out), optional :: error

      !> Error of the stresses over the peak pressure.
      real(dp), parameter :: rounding = 1e-14_dp

      associate (unused => y); end associate
      call westergaard_stress(x, depth, self%pbar_over_pstar, parts)
      if (present(error)) error = rounding*westergaard_peak_pressure_over_pstar(self%pbar_over_pstar)
   end subroutine at

   !> Places across the contact, at depths from the surface to that of the longest wave.
   subroutine start_places(self, body, places, widths, stresses)
      class(closed_form_stress), intent(inout) :: self
      type(elastic_body), intent(in) :: body
      real(dp), allocatable, intent(out) :: places(:, :)
      real(dp), allocatable, intent(out) :: widths(:)
      real(dp), allocatable, intent(out) :: stresses(:, :)

      !> Places over the half width of the contact.
      real(dp), parameter :: across(*) = [0.0_dp, 0.3_dp, 0.6_dp, 0.9_dp, 1.0_dp, 1.1_dp], &
                             below(*) = [0.0_dp, 0.1_dp, 0.2_dp, 0.4_dp, 0.8_dp, 1.2_dp]
      real(dp) :: half_width
      integer :: i, k

      half_width = pi*westergaard_contact_area_fraction(self%pbar_over_pstar)
      allocate (places(3, size(across)*size(below)), widths(size(across)*size(below)))
      do k = 1, size(below)
         do i = 1, size(across)
            places(:, (k - 1)*size(across) + i) = half_width*[across(i), 0.0_dp, below(k)]
         end do
      end do
      widths = 0.5_dp*half_width
      call self%at_places(body, places, stresses)
   end subroutine start_places

end module wavycon_closed_form_stress
