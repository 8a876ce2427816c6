!> Reads the keys of one group from a text that holds nothing else, without '&name' and '/'.
module wavycon_group_text
   use wavycon_deck_groups, only: take_groups
   use wavycon_deck_scanner, only: scan_deck, scan_type
   use wavycon_deck_text, only: deck_text_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_group_type
   use wavycon_plain_text, only: newline
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: read_group_text

contains

   !> Reads the keys and checks them against the table, as those of a deck.
   subroutine read_group_text(table, keys, values, text, problems)
      type(key_group_type), intent(in) :: table
      character(*), intent(in) :: keys                     !! such as "solver = 'grid', accuracy = 1e-4"
      type(group_values), intent(out) :: values
      type(deck_text_type), intent(out) :: text            !! to which the places of the problems refer
      type(problem_list_type), intent(inout) :: problems

      type(group_values) :: groups(1)
      type(key_group_type) :: tables(1)
      type(scan_type) :: scan

      ! The keys may end in a comment, so that the '/' needs a line of its own.
      text = deck_text_type('&'//trim(table%name), '&'//trim(table%name)//' '//keys//newline//'/')
      tables(1) = table
      call scan_deck(text, scan, problems)
      call take_groups(text, scan, tables, groups, problems)
      values = groups(1)
   end subroutine read_group_text

end module wavycon_group_text
