!> Formats that are not read, and how their files can be converted.
module wavycon_foreign_format
   use wavycon_plain_text, only: lower_case
   implicit none (type, external)
   private

   public :: remedy_of_content, remedy_of_name

   character(*), parameter :: by_gwyddion = 'open it in Gwyddion and save it as .gsf (File > Save As), or read it '// &
      'in Python with SurfaceTopography and write numpy.save(file, z.T), z = numpy.ma.filled(topography.heights(), '// &
      'numpy.nan), of a profile numpy.savetxt(file, numpy.c_[topography.positions(), z])'

   !> Kinds of formats.
   integer, parameter :: picture = 1, instrument = 2, numbers = 3, compressed = 4, spreadsheet = 5, arrays = 6, wide = 7

   !> What a file of each kind is, and how to convert it.
   character(*), parameter :: remedies(*) = [character(400) :: &
      'a picture, whose colours are no lengths: '//by_gwyddion, &
      'a file of an instrument or of Gwyddion: '//by_gwyddion, &
      'a file of HDF5, NetCDF or MATLAB: read it in Python and write its heights by numpy.save', &
      'a compressed file: expand it first', &
      'a spreadsheet: save the heights as text (.csv)', &
      'an archive of arrays: write the heights alone, by numpy.save', &
      'a text of two bytes a character (UTF-16): save it as UTF-8 or ASCII']

   !> Endings of the names of their files.
   character(*), parameter :: endings(*) = [character(160) :: &
      ' png jpg jpeg tif tiff bmp gif ', &
      ' sdf x3p plux al3d plu opd opdx sur vk4 vk6 gwy spm ibw nid mi mnt zmg os3d stp xyzgz gxyzf nms tmd frt '// &
      'bcrf hfm top ', &
      ' mat h5 hdf5 nc ', ' zip gz bz2 xz ', ' xls xlsx ods ', ' npz ']

   !> First bytes of files, and their kinds. The last of an instrument are those of a family of containers.
   character(*), parameter :: magics(*) = [character(18) :: char(137)//'PNG', char(255)//char(216)//char(255), 'GIF8', &
      'II*'//char(0), 'MM'//char(0)//'*', &
      'GWYP', 'Gwyddion XYZ Field', 'AliconaImaging', 'DIGITAL SURF', 'DSCOMPRESSED', 'aISO-1.0', 'bISO-1.0', 'aBCR-', &
      'bBCR-', 'VK4_', 'VK6', '\*File list', 'DSAA', 'DSBB', char(208)//char(207)//char(17)//char(224), &
      char(137)//'HDF', 'CDF', 'MATLAB', &
      char(31)//char(139), 'BZh', char(253)//'7zXZ', &
      char(255)//char(254), char(254)//char(255)]
   integer, parameter :: kinds(*) = [spread(picture, 1, 5), spread(instrument, 1, 15), spread(numbers, 1, 3), &
                                     spread(compressed, 1, 3), spread(wide, 1, 2)]

contains

   !> Names the format of a file that is recognised but cannot be read, and says how to convert it; empty for any other
   !> file.
   pure function remedy_of_content(head, path) result(words)
      character(*), intent(in) :: head   !! the first bytes of the file
      character(*), intent(in) :: path
      character(:), allocatable :: words

      !> Bytes that no text has.
      character(*), parameter :: no_text = char(0)//char(1)//char(2)//char(3)//char(4)//char(5)//char(6)//char(127)
      logical :: is_archive
      integer :: i

      words = ''
      do i = 1, size(magics)
         if (index(head, trim(magics(i))) == 1) words = 'this is '//trim(remedies(kinds(i)))
      end do
      is_archive = index(head, 'PK'//char(3)//char(4)) == 1
      if (words /= '' .or. .not. (is_archive .or. scan(head, no_text) > 0)) return
      words = remedy_of_name(path)
      if (words /= '') return
      words = 'this is no text, and no binary format that is read, which are .npy and .gsf: '//by_gwyddion
      if (is_archive) words = 'this is an archive: '//by_gwyddion
   end function remedy_of_content

   !> Recognises such a file by the ending of its name.
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
