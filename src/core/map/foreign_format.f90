!> File formats that cannot be read, recognised by the endings of names, and advice how to convert such files.
module wavycon_foreign_format
   use wavycon_plain_text, only: lower_case
   implicit none (type, external)
   private

   public :: remedy_of_content, remedy_of_name

   character(*), parameter :: by_gwyddion = 'open it in Gwyddion and save it as .gsf (File > Save As)'
   character(*), parameter :: by_python = 'the command wavycon-convert writes a .gsf or .npy of many such files, '// &
      'and wavycon.read reads them in Python; otherwise '//by_gwyddion

   !> Endings of names by group; below, for each group, what such a file is and how to convert it.
   character(*), parameter :: endings(*) = [character(200) :: &
      ' png jpg jpeg tif tiff bmp gif ', &
      ' sdf x3p plux al3d plu apx opd opdx datx sur ezd vk3 vk4 vk6 vk7 gwy spm di ibw nid mi mnt mdt jpk lext zmg '// &
      'zon oir poir qep os3d stp cur tom xyzgz gxyzf nms tmd frt bcr bcrf hfm top grd ', &
      ' mat h5 hdf5 nc ', ' zip gz bz2 xz ', ' xls xlsx ods ', ' npz ']
   character(*), parameter :: remedies(*) = [character(400) :: &
      'a picture, which has no scale of heights: '//by_gwyddion//', or read it in '// &
      'Python by another package as an array, and give that, in lengths, to wavycon.heights', &
      'a file of an instrument or of Gwyddion: '//by_python, &
      'a file of HDF5, NetCDF or MATLAB: if wavycon-convert does not read it write its heights in Python, by '// &
      'numpy.save', &
      'a compressed file: expand it first', &
      'a spreadsheet: save the heights as text (.csv)', &
      'an archive of arrays: write the heights alone, by numpy.save']

contains

   !> Advice for a file that is not a text: what the file is by its name, and how to convert it. Empty for a text.
   pure function remedy_of_content(head, path) result(words)
      character(*), intent(in) :: head   !! the first bytes of the file
      character(*), intent(in) :: path
      character(:), allocatable :: words

      words = ''
      ! A text has none of these bytes.
      if (scan(head, char(0)//char(1)//char(2)//char(3)//char(4)//char(5)//char(6)//char(127)) == 0) return
      words = remedy_of_name(path)
      if (words == '') words = 'this is no text in UTF-8, UTF-16 or ASCII, and neither .npy nor .gsf: '//by_gwyddion
   end function remedy_of_content

   !> The same advice by the name of the file alone. Empty if the name has none of the endings.
   pure function remedy_of_name(path) result(words)
      character(*), intent(in) :: path
      character(:), allocatable :: words

      integer :: i

      words = ''
      do i = 1, size(endings)
         if (index(endings(i), ' '//lower_case(path(index(path, '.', back=.true.) + 1:))//' ') > 0) &
            words = 'by its name this is '//trim(remedies(i))
      end do
   end function remedy_of_name

end module wavycon_foreign_format
