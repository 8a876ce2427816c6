!> Formats that are not read, and how their files can be converted.
module wavycon_foreign_format
   use wavycon_plain_text, only: lower_case
   implicit none (type, external)
   private

   public :: remedy_of_content, remedy_of_name

   character(*), parameter :: by_gwyddion = 'open it in Gwyddion and save it as .gsf (File > Save As), or read it '// &
      'in Python with SurfaceTopography and write numpy.save(file, z.T), z = numpy.ma.filled(topography.heights(), '// &
      'numpy.nan), of a profile numpy.savetxt(file, numpy.c_[topography.positions(), z])'
   character(*), parameter :: by_spreadsheet = 'save the heights as text (.csv)'
   character(*), parameter :: by_numpy = 'read it in Python and write its heights by numpy.save'

contains

   !> Names the format of a file that is recognised but cannot be read, and says how to convert it; empty for any other
   !> file.
   pure function remedy_of_content(head, path) result(words)
      character(*), intent(in) :: head   !! the first bytes of the file
      character(*), intent(in) :: path
      character(:), allocatable :: words

      !> First bytes of files of instruments and their programs; the last is that of a family of containers.
      character(*), parameter :: instruments(*) = [character(18) :: 'GWYP', 'Gwyddion XYZ Field', 'AliconaImaging', &
         'DIGITAL SURF', 'DSCOMPRESSED', 'aISO-1.0', 'bISO-1.0', 'aBCR-', 'bBCR-', 'VK4_', 'VK6', '\*File list', &
         char(208)//char(207)//char(17)//char(224)]
      !> Bytes that no text has.
      character(*), parameter :: no_text = char(0)//char(1)//char(2)//char(3)//char(4)//char(5)//char(6)//char(127)
      integer :: i

      words = ''
      if (begins(char(137)//'PNG') .or. begins(char(255)//char(216)//char(255)) .or. begins('GIF8') .or. &
          begins('II*'//char(0)) .or. begins('MM'//char(0)//'*')) then
         words = 'this is a picture, whose colours are no lengths: '//by_gwyddion
      else if (begins(char(255)//char(254)) .or. begins(char(254)//char(255))) then
         words = 'this is a text of two bytes a character (UTF-16): save it as UTF-8 or ASCII'
      else if (begins(char(31)//char(139)) .or. begins('BZh') .or. begins(char(253)//'7zXZ')) then
         words = 'this is a compressed file: expand it first'
      else if (begins(char(137)//'HDF') .or. begins('CDF')) then
         words = 'this is a file of HDF5 or NetCDF: '//by_numpy
      else if (begins('MATLAB')) then
         words = 'this is a file of MATLAB: '//by_numpy//', or write them there by writematrix'
      else if (begins('PK'//char(3)//char(4))) then
         ! Archives, which differ by their names.
         words = remedy_of_name(path)
         if (words == '') words = 'this is an archive: '//by_gwyddion
      else if (any([(begins(trim(instruments(i))), i=1, size(instruments))])) then
         words = 'this is a file of an instrument or of Gwyddion: '//by_gwyddion
      else if (scan(head, no_text) > 0) then
         words = remedy_of_name(path)
         if (words == '') words = 'this is no text, and no binary format that is read: '//by_gwyddion
      end if

   contains

      pure logical function begins(magic)
         character(*), intent(in) :: magic

         begins = index(head, magic) == 1
      end function begins

   end function remedy_of_content

   !> Recognises such a file by the ending of its name.
   pure function remedy_of_name(path) result(words)
      character(*), intent(in) :: path
      character(:), allocatable :: words

      select case (lower_case(path(index(path, '.', back=.true.) + 1:)))
      case ('png', 'jpg', 'jpeg', 'tif', 'tiff', 'bmp', 'gif')
         words = 'by its name this is a picture, whose colours are no lengths: '//by_gwyddion
      case ('sdf', 'x3p', 'plux', 'al3d', 'plu', 'opd', 'opdx', 'sur', 'vk4', 'vk6', 'gwy', 'spm', 'ibw', 'nid', 'mi', &
            'mnt', 'zmg', 'os3d', 'stp', 'xyzgz', 'gxyzf', 'nms', 'tmd', 'frt', 'bcrf', 'hfm', 'top')
         words = 'by its name this is a file of an instrument or of Gwyddion: '//by_gwyddion
      case ('mat', 'h5', 'hdf5', 'nc')
         words = 'by its name this is a file of MATLAB, HDF5 or NetCDF: '//by_numpy
      case ('npz')
         words = 'this is an archive of arrays: write the heights alone, by numpy.save'
      case ('xls', 'xlsx', 'ods')
         words = 'by its name this is a spreadsheet: '//by_spreadsheet
      case ('zip', 'gz', 'bz2', 'xz')
         words = 'by its name this is a compressed file: expand it first'
      case default
         words = ''
      end select
   end function remedy_of_name

end module wavycon_foreign_format
