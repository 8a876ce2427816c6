# In a source archive git has put the commit here (.gitattributes).
set(archived "$Format:%H$")
string(SUBSTRING "${archived}" 0 10 revision)
if(NOT revision MATCHES "^[0-9a-f]+$")
  set(revision unknown)
endif()
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS ${source_dir}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=10 --exclude=*
    WORKING_DIRECTORY ${source_dir} OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE
    RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(revision ${described})
  endif()
endif()
configure_file(${template} ${output} @ONLY)
