# The stand-in for pFUnit's add_pfunit_ctest, as far as wavycon uses it.
# N.B. It links early_exit by itself; pFUnit is given it by EXTRA_INITIALIZE and EXTRA_FINALIZE.

# wavycon_standin_executable(name source.pf ...): the test program alone, without a ctest.
function(wavycon_standin_executable name)
  set(here ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  set(generated "")
  set(suite_interfaces "")
  set(suite_calls "")
  foreach(source IN LISTS ARGN)
    get_filename_component(path ${source} ABSOLUTE)
    get_filename_component(stem ${source} NAME_WE)
    # A failure is reported with the path from the top of the sources.
    file(RELATIVE_PATH shown_path ${PROJECT_SOURCE_DIR} ${path})
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${stem}.F90)
    add_custom_command(OUTPUT ${output}
      COMMAND Python3::Interpreter ${here}/pf2f90.py ${shown_path} ${output}
      DEPENDS ${path} ${here}/pf2f90.py
      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
      VERBATIM)
    list(APPEND generated ${output})
    string(APPEND suite_interfaces
      "      type(TestSuite) function ${stem}_suite()\n"
      "         import :: TestSuite\n"
      "      end function ${stem}_suite\n")
    string(APPEND suite_calls "   call run_suite(${stem}_suite())\n")
  endforeach()
  set(driver ${CMAKE_CURRENT_BINARY_DIR}/${name}_driver.f90)
  configure_file(${here}/driver.f90.in ${driver} @ONLY)
  add_executable(${name} ${generated} ${driver})
  set_target_properties(${name} PROPERTIES
    Fortran_MODULE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/mod/${name})
  target_link_libraries(${name} funit)
endfunction()

# add_pfunit_ctest(name TEST_SOURCES source.pf ... [LINK_LIBRARIES ...]): program and ctest.
function(add_pfunit_ctest name)
  cmake_parse_arguments(PARSE_ARGV 1 PF "" "" "TEST_SOURCES;LINK_LIBRARIES")
  if(NOT PF_TEST_SOURCES)
    message(FATAL_ERROR "add_pfunit_ctest(${name}): no TEST_SOURCES")
  endif()
  if(PF_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "add_pfunit_ctest(${name}): the stand-in has no ${PF_UNPARSED_ARGUMENTS}")
  endif()
  wavycon_standin_executable(${name} ${PF_TEST_SOURCES})
  target_link_libraries(${name} ${PF_LINK_LIBRARIES})
  add_test(NAME ${name} COMMAND ${name})
endfunction()
