!> Finds the largest stresses of all loads of a scene.
module wavycon_find_stresses
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_largest_stress, only: find_largest_stresses, largest_stress
   use wavycon_plain_text, only: integer_text
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_stress_fields, only: stress_fields
   use wavycon_work_sharing, only: distributed_loads, work_sharing
   implicit none (type, external)
   private

   public :: find_stresses

contains

   !> Finds the largest von Mises stress and the largest shear stress of each load and body, of the own loads, and
   !> takes those of the others.
   subroutine find_stresses(results, log)
      type(results_type), intent(inout) :: results   !! with a group &stress and all loads solved with their fields
      type(run_log), intent(inout) :: log            !! shows the progress

      class(stress_fields), allocatable :: fields
      integer :: body, load
      logical :: are_distributed

      are_distributed = results%sharing%kind == distributed_loads
      if (are_distributed) call results%sharing%work_alone(.true.)
      associate (setting => results%scene%stress_setting)
         allocate (results%von_mises(size(setting%body), size(results%loads)))
         allocate (results%shear(size(setting%body), size(results%loads)))
         do load = 1, size(results%loads)
            if (.not. results%sharing%is_own_load(load)) cycle
            call results%loads(load)%stresses(results%solver%surface, fields)
            if (results%loads(load)%is_good() .and. .not. fields%exist) call log%say( &
               'note: there is not enough memory for the stresses of load '//integer_text(load))
            do body = 1, size(setting%body)
               call find_largest_stresses(fields, setting%body(body), results%von_mises(body, load), &
                                          results%shear(body, load))
            end do
            call log%say_progress('stresses of '//integer_text(load)//' of '//integer_text(size(results%loads))// &
                                  ' loads')
         end do
      end associate
      if (.not. are_distributed) return
      call results%sharing%work_alone(.false.)
      call share_stresses(results%sharing, results%von_mises)
      call share_stresses(results%sharing, results%shear)
   end subroutine find_stresses

   !> Gives all ranks the largest stresses of all loads.
   subroutine share_stresses(sharing, stresses)
      type(work_sharing), intent(in) :: sharing
      type(largest_stress), intent(inout) :: stresses(:, :)   !! shape (bodies, loads); of the own loads

      integer(int64) :: words(size(stresses)*storage_size(stresses)/storage_size(0_int64))

      words = transfer(stresses, words)
      call sharing%share_loads(words)
      stresses = reshape(transfer(words, stresses), shape(stresses))
   end subroutine share_stresses

end module wavycon_find_stresses
