!> Writes a deck with every key that applies and the value in effect: read again, it gives the same run.
module wavycon_resolved_deck
   use wavycon_deck, only: deck_type
   use wavycon_deck_writer, only: deck_writer_type
   use wavycon_load_group, only: write_load_group
   use wavycon_material_group, only: write_material_group
   use wavycon_method_group, only: write_method_group
   use wavycon_output_group, only: write_output_group
   use wavycon_plain_text, only: escaped
   use wavycon_scene_group, only: write_scene_group
   use wavycon_surface_group, only: surface_dimension, write_surface_group
   implicit none (type, external)
   private

   public :: write_resolved_deck

contains

   subroutine write_resolved_deck(deck, unit, iostat, iomsg)
      type(deck_type), intent(in) :: deck  !! as read
      integer, intent(in) :: unit          !! open for formatted writing
      integer, intent(out), optional :: iostat          !! of the first write that failed, 0 if none
      character(*), intent(inout), optional :: iomsg    !! its words

      type(deck_writer_type) :: writer

      writer = deck_writer_type(unit)
      call writer%put_comment(escaped(deck%path)//' with the value in effect of every key that applies.')
      call write_scene_group(deck%scene, writer)
      call write_material_group(deck%material, writer)
      call write_surface_group(deck%surface, writer)
      call write_load_group(deck%load, writer)
      call write_method_group(deck%method, surface_dimension(deck%surface), writer)
      call write_output_group(deck%output, writer)
      if (present(iostat)) iostat = writer%status
      if (present(iomsg) .and. writer%status /= 0) iomsg = writer%message
   end subroutine write_resolved_deck

end module wavycon_resolved_deck
