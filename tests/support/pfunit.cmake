# pFUnit, or the stand-in for it that compiles the same .pf files.
find_package(Python3 3.8 REQUIRED COMPONENTS Interpreter)
find_package(PFUNIT QUIET)
if(PFUNIT_FOUND)
  message(STATUS "wavycon: tests use pFUnit ${PFUNIT_VERSION} (${PFUNIT_DIR})")
elseif(WAVYCON_REQUIRE_PFUNIT)
  message(FATAL_ERROR "wavycon: WAVYCON_REQUIRE_PFUNIT is ON but pFUnit was not found; set PFUNIT_DIR")
else()
  message(STATUS "wavycon: pFUnit not found, tests use the stand-in in tests/support")
  include(${CMAKE_CURRENT_LIST_DIR}/standin.cmake)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/test_properties.cmake)

# What every test program does first and last. pFUnit alone would pass a program that a test stopped with status 0.
set(wavycon_early_exit EXTRA_USE early_exit EXTRA_INITIALIZE refuse_early_exit EXTRA_FINALIZE allow_exit)

# wavycon_add_pf_test(name label source.pf [library ...]): one test program and its ctest.
function(wavycon_add_pf_test name label source)
  add_pfunit_ctest(${name} TEST_SOURCES ${source} LINK_LIBRARIES early_exit ${ARGN} ${wavycon_early_exit})
  # Tests spend their time in the library: less optimisation of their own code halves the time to compile it.
  target_compile_options(${name} PRIVATE ${wavycon_test_flags} $<$<CONFIG:Release>:-O1>)
  wavycon_test_properties(${name} ${label})
endfunction()

# wavycon_add_pf_tests(label): each test_<subject>.pf of this directory is a ctest <label>.<subject>.
# The directory is searched, so that no file can be forgotten.
function(wavycon_add_pf_tests label)
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} test_*.pf)
  if(NOT sources)
    message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR} has no test_*.pf")
  endif()
  foreach(source IN LISTS sources)
    string(REGEX REPLACE "^test_(.*)\\.pf$" "${label}.\\1" name ${source})
    wavycon_add_pf_test(${name} ${label} ${source} unit_support)
  endforeach()
endfunction()
