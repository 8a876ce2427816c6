!> The list of all kinds of surface. A new kind adds its line to `get_surface_kinds`.
module wavycon_surface_kinds
   use wavycon_crossed_1d, only: crossed_1d_kind
   use wavycon_height_map, only: height_map_kind
   use wavycon_hexagonal, only: hexagonal_kind
   use wavycon_key_alternatives, only: alternative_type
   use wavycon_self_affine, only: self_affine_kind
   use wavycon_surface_kind, only: surface_kind
   use wavycon_wave_1d, only: wave_1d_kind
   use wavycon_wave_2d, only: wave_2d_kind
   use wavycon_wave_sum, only: wave_sum_kind
   implicit none (type, external)
   private

   public :: surface_kind_item, get_surface_kinds, keys_of_kinds, paper_waves, is_paper_kind

   type :: surface_kind_item
      class(surface_kind), allocatable :: kind
   end type surface_kind_item

contains

   !> All kinds, in the order of the key reference.
   subroutine get_surface_kinds(kinds)
      type(surface_kind_item), allocatable, intent(out) :: kinds(:)

      allocate (kinds(0))
      call add(kinds, wave_1d_kind())
      call add(kinds, wave_2d_kind())
      call add(kinds, crossed_1d_kind())
      call add(kinds, hexagonal_kind())
      call add(kinds, wave_sum_kind())
      call add(kinds, height_map_kind())
      call add(kinds, self_affine_kind())
   end subroutine get_surface_kinds

   subroutine add(kinds, kind)
      type(surface_kind_item), allocatable, intent(inout) :: kinds(:)
      class(surface_kind), intent(in) :: kind

      type(surface_kind_item), allocatable :: longer(:)
      integer :: i

      allocate (longer(size(kinds) + 1))
      do i = 1, size(kinds)
         call move_alloc(kinds(i)%kind, longer(i)%kind)
      end do
      allocate (longer(size(longer))%kind, source=kind)
      call move_alloc(longer, kinds)
   end subroutine add

   !> The name and the keys of each kind.
   subroutine keys_of_kinds(kinds, alternatives)
      type(surface_kind_item), intent(in) :: kinds(:)
      type(alternative_type), allocatable, intent(out) :: alternatives(:)

      integer :: i

      allocate (alternatives(size(kinds)))
      do i = 1, size(kinds)
         alternatives(i)%name = kinds(i)%kind%name()
         alternatives(i)%meaning = kinds(i)%kind%meaning()
         alternatives(i)%keys = kinds(i)%kind%keys()
      end do
   end subroutine keys_of_kinds

   !> The kinds that are waves of Johnson, Greenwood & Higginson (1985), eqs. (3) and (21), and their conditions, for
   !> messages.
   function paper_waves() result(words)
      character(:), allocatable :: words

      type(surface_kind_item), allocatable :: kinds(:)
      character(:), allocatable :: condition
      integer :: i

      call get_surface_kinds(kinds)
      words = ''
      do i = 1, size(kinds)
         condition = kinds(i)%kind%paper_wave_if()
         if (condition == '') cycle
         if (words /= '') words = words//', '
         words = words//condition
      end do
   end function paper_waves

   !> Whether a kind is by definition a wave of the paper, perhaps on a condition. A sum of waves may equal one; use
   !> surface_type%is_paper_wave to find out.
   logical function is_paper_kind(name)
      character(*), intent(in) :: name   !! of a kind; .false. for any other text

      type(surface_kind_item), allocatable :: kinds(:)
      integer :: i

      call get_surface_kinds(kinds)
      is_paper_kind = .false.
      do i = 1, size(kinds)
         if (kinds(i)%kind%name() == name) is_paper_kind = kinds(i)%kind%paper_wave_if() /= ''
      end do
   end function is_paper_kind

end module wavycon_surface_kinds
