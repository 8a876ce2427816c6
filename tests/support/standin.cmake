# The stand-in for pFUnit's add_pfunit_ctest, as far as wavycon uses it.

# wavycon_standin_executable(name TEST_SOURCES source.pf [LINK_LIBRARIES ...] EXTRA_USE module
#   EXTRA_INITIALIZE procedure EXTRA_FINALIZE procedure): the test program alone, without a ctest.
function(wavycon_standin_executable name)
  set(extras EXTRA_USE EXTRA_INITIALIZE EXTRA_FINALIZE)
  cmake_parse_arguments(PARSE_ARGV 1 PF "" "TEST_SOURCES;${extras}" "LINK_LIBRARIES")
  set(source ${PF_TEST_SOURCES})
  set(translator ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/pf2f90.py)
  get_filename_component(path ${source} ABSOLUTE)
  get_filename_component(stem ${source} NAME_WE)
  # A failure is reported with the path from the top of the sources.
  file(RELATIVE_PATH shown_path ${PROJECT_SOURCE_DIR} ${path})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${stem}.F90)
  add_custom_command(OUTPUT ${output}
    COMMAND Python3::Interpreter ${translator} ${shown_path} ${output}
    DEPENDS ${path} ${translator}
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    VERBATIM)
  add_executable(${name} ${output})
  set_target_properties(${name} PROPERTIES
    Fortran_MODULE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/mod/${name})
  target_link_libraries(${name} funit ${PF_LINK_LIBRARIES})
  foreach(extra IN LISTS extras)
    target_compile_definitions(${name} PRIVATE PFUNIT_${extra}=${PF_${extra}})
  endforeach()
endfunction()

# add_pfunit_ctest(name, and the same arguments): program and ctest.
function(add_pfunit_ctest name)
  wavycon_standin_executable(${name} ${ARGN})
  add_test(NAME ${name} COMMAND ${name})
endfunction()
