!> From a deck file to a deck, or to the complete list of what is wrong with it.
!>
!> The text is scanned first, because a compiler's own namelist errors mislead: a misspelt group reads as the
!> end of the file, a repeated key or an empty value as nothing at all. What passes is read with NAMELIST, so
!> that it means what it means to any Fortran program; then the values are checked against each other.
module wavycon_read_deck
   use wavycon_deck, only: deck_tables, deck_type, load_number, material_number, method_number, &
      number_of_groups, output_number, scene_number, surface_number
   use wavycon_deck_scanner, only: scan_deck, scan_type
   use wavycon_deck_text, only: deck_text_type, read_deck_text
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_group_input, only: group_input_type, take_groups
   use wavycon_load_group, only: read_load_group
   use wavycon_material_group, only: read_material_group
   use wavycon_method_group, only: read_method_group
   use wavycon_output_group, only: read_output_group
   use wavycon_plain_text, only: escaped
   use wavycon_problems, only: problem_list_type, problem_report
   use wavycon_scene_group, only: read_scene_group
   use wavycon_surface_group, only: read_surface_group, surface_dimension, surface_is_paper_wave
   implicit none (type, external)
   private

   public :: read_deck, parse_deck

contains

   !> Reads a deck file.
   !>
   !> Errors: `exit_file_trouble` if the file is not there or cannot be read, `exit_bad_input` with a report
   !> of all problems if what it holds is no deck.
   subroutine read_deck(path, deck, error)
      character(*), intent(in) :: path
      type(deck_type), intent(out) :: deck  !! to be used only if there is no error
      type(error_type), allocatable, intent(out) :: error

      type(deck_text_type) :: text

      call read_deck_text(path, text, error)
      if (allocated(error)) return
      call parse_deck(text, deck, error)
   end subroutine read_deck

   !> Reads a deck from its text. Errors: `exit_bad_input`.
   subroutine parse_deck(text, deck, error)
      type(deck_text_type), intent(in) :: text
      type(deck_type), intent(out) :: deck  !! to be used only if there is no error
      type(error_type), allocatable, intent(out) :: error

      type(group_input_type) :: inputs(number_of_groups)
      type(problem_list_type) :: problems
      type(scan_type) :: scan
      integer :: dimension
      logical :: paper_wave

      call scan_deck(text, scan, problems)
      if (size(scan%tokens) == 0) then
         call fatal_error(error, exit_bad_input, escaped(text%path)//': the deck is empty')
         return
      end if
      call take_groups(text, scan, deck_tables(), inputs, problems)

      deck%path = text%path
      call read_scene_group(inputs(scene_number), text%path, deck%scene, problems)
      call read_material_group(inputs(material_number), deck%material, problems)
      call read_surface_group(inputs(surface_number), deck%surface, problems)
      call read_load_group(inputs(load_number), deck%load, problems)
      dimension = 0
      if (deck%surface%kind /= '') dimension = surface_dimension(deck%surface)
      ! What is said of an unknown surface would only mislead.
      paper_wave = dimension == 0 .or. surface_is_paper_wave(deck%surface)
      call read_method_group(inputs(method_number), dimension, paper_wave, deck%surface%kind == 'file', &
                             deck%method, problems)
      call read_output_group(inputs(output_number), trim(deck%scene%case), trim(deck%method%solver), paper_wave, &
                             deck%output, problems)

      if (problems%number > 0) call fatal_error(error, exit_bad_input, problem_report(problems, text))
   end subroutine parse_deck

end module wavycon_read_deck
