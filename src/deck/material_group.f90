!> The &material group: how stiff the two bodies are.
module wavycon_material_group
   use wavycon_deck_writer, only: deck_writer_type
   use wavycon_group_input, only: group_input_type
   use wavycon_key_table, only: key_group, key_group_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: material_group_type, material_table, read_material_group, write_material_group

   !> What &material says. `e_star` holds in either form of the group.
   type :: material_group_type
      real(dp) :: e_star = 1               !! plane-strain modulus [pressure]
      logical :: from_moduli = .false.     !! whether e1, nu1 (and e2, nu2) were given
      logical :: second_is_rigid = .true.  !! with from_moduli: whether e2, nu2 were left out
      real(dp) :: e1 = 0, e2 = 0           !! Young's moduli [pressure]; 0 where not given
      real(dp) :: nu1 = 0, nu2 = 0         !! Poisson's ratios [-]; 0 where not given
   end type material_group_type

contains

   function material_table() result(table)
      type(key_group_type) :: table

      table = key_group('material', 'how stiff the two bodies are: e_star, or e1 and nu1 (and e2, nu2)', [ &
         real_key('e_star', '1.0', 'pressure', &
            'Plane-strain modulus E* of the pair, 1/E* = (1 - nu1^2)/e1 + (1 - nu2^2)/e2.', above=0.0_dp), &
         real_key('e1', '', 'pressure', "Young's modulus of the first body; needs nu1.", above=0.0_dp), &
         real_key('nu1', '', '-', "Poisson's ratio of the first body.", above=-1.0_dp, most=0.5_dp), &
         real_key('e2', '', 'pressure', &
            "Young's modulus of the second body; needs nu2. Without it the second body is rigid.", &
            above=0.0_dp), &
         real_key('nu2', '', '-', "Poisson's ratio of the second body.", above=-1.0_dp, most=0.5_dp)])
   end function material_table

   subroutine read_material_group(input, group, problems)
      type(group_input_type), intent(in) :: input
      type(material_group_type), intent(out) :: group
      type(problem_list_type), intent(inout) :: problems

      character(*), parameter :: advice = 'give e_star, or e1 and nu1 (and e2, nu2)'
      real(dp) :: e_star, e1, e2, nu1, nu2
      character(200) :: message
      integer :: i, status
      character(3), parameter :: moduli(*) = ['e1 ', 'nu1', 'e2 ', 'nu2']
      namelist /material/ e_star, e1, nu1, e2, nu2

      e_star = group%e_star
      e1 = group%e1
      nu1 = group%nu1
      e2 = group%e2
      nu2 = group%nu2
      read (input%record, nml=material, iostat=status, iomsg=message)
      if (status /= 0) call problems%add(input%place, trim(message))

      call input%require(problems, 'e1', 'nu1')
      call input%require(problems, 'nu1', 'e1')
      call input%require(problems, 'e2', 'nu2')
      call input%require(problems, 'nu2', 'e2')
      call input%require(problems, 'e2', 'e1')
      do i = 1, size(moduli)
         call input%forbid(problems, 'e_star', trim(moduli(i)), advice)
         if (input%has(trim(moduli(i))) .and. input%has('e_star')) exit
      end do

      group%from_moduli = input%has('e1')
      group%second_is_rigid = .not. input%has('e2')
      group%e1 = e1
      group%nu1 = nu1
      group%e2 = e2
      group%nu2 = nu2
      group%e_star = e_star
      if (group%from_moduli .and. e1 > 0) group%e_star = plane_strain_modulus(group)
   end subroutine read_material_group

   subroutine write_material_group(group, writer)
      type(material_group_type), intent(in) :: group
      type(deck_writer_type), intent(inout) :: writer

      call writer%open_group(material_table())
      if (group%from_moduli) then
         call writer%put('e1', group%e1)
         call writer%put('nu1', group%nu1)
         if (.not. group%second_is_rigid) then
            call writer%put('e2', group%e2)
            call writer%put('nu2', group%nu2)
         end if
      else
         call writer%put('e_star', group%e_star)
      end if
      call writer%close_group()
   end subroutine write_material_group

   !> E* from the moduli: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, a rigid body adding nothing [unit of e1].
   pure real(dp) function plane_strain_modulus(group)
      type(material_group_type), intent(in) :: group  !! e1 > 0

      real(dp) :: compliance

      compliance = (1 - group%nu1**2)/group%e1
      if (group%e2 > 0) compliance = compliance + (1 - group%nu2**2)/group%e2
      plane_strain_modulus = 1/compliance
   end function plane_strain_modulus

end module wavycon_material_group
