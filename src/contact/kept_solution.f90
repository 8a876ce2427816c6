!> What a checkpoint keeps of a solution, as 8-byte words, so that a resumed run need not compute it again.
module wavycon_kept_solution
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_status, only: interrupted, no_memory
   use wavycon_grid_source, only: grid_source
   use wavycon_kinds, only: dp
   use wavycon_solution_record, only: by_grids, record_of_words, record_words, words_of_record
   implicit none (type, external)
   private

   public :: is_kept, pack_solution, unpack_solution

contains

   !> Whether a solution is written to checkpoints: those on grids may take minutes, those of other solvers take
   !> seconds. A load that lacked memory or was interrupted is solved again.
   pure logical function is_kept(solution)
      type(contact_solution), intent(in) :: solution

      is_kept = solution%solver == by_grids .and. .not. any(solution%status == [interrupted, no_memory])
   end function is_kept

   !> The record of a solution and, if it has a source of fields, the numbers of that.
   subroutine pack_solution(solution, words)
      type(contact_solution), intent(in) :: solution           !! is_kept(solution) is true
      integer(int64), allocatable, intent(out) :: words(:)     !! not allocated if there is not enough memory

      real(dp), allocatable :: values(:)

      allocate (values(0))
      if (allocated(solution%source)) then
         select type (source => solution%source)
         type is (grid_source)
            call source%pack(values)
         end select
      end if
      if (allocated(values)) words = [words_of_record(solution), transfer(values, [0_int64])]
   end subroutine pack_solution

   !> Restores what pack_solution made. A grid that is distributed is restored by the words of all ranks that had
   !> columns of it: called for one after the other, in any order.
   subroutine unpack_solution(words, whole, solution, complete, understood)
      integer(int64), intent(in) :: words(:)
      logical, intent(in) :: whole   !! whether this rank needs all columns of a grid that was distributed
      type(contact_solution), intent(inout) :: solution  !! without a source at first
      logical, intent(out) :: complete                   !! whether nothing is missing any more
      logical, intent(out) :: understood                 !! .false. if these are not the words of a solution

      complete = .false.
      understood = size(words) >= record_words
      if (.not. understood) return
      solution%solution_record = record_of_words(words(:record_words))
      complete = size(words) == record_words
      if (complete) return
      if (.not. allocated(solution%source)) allocate (grid_source :: solution%source)
      select type (source => solution%source)
      type is (grid_source)
         call source%unpack(transfer(words(record_words + 1:), [0.0_dp]), whole, understood)
         if (understood) complete = source%has_all_columns()
      end select
   end subroutine unpack_solution

end module wavycon_kept_solution
