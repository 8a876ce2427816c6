# The page for man and the completion for bash and zsh, made from the program's --help. `cmake --install` and a wheel
# have them below share/.
find_package(Python3 COMPONENTS Interpreter QUIET)
if(NOT Python3_FOUND)
  message(STATUS "wavycon: no page for man and no completion in shells, which need Python")
  return()
endif()

set(folder ${PROJECT_BINARY_DIR}/shell)
set(maker ${PROJECT_SOURCE_DIR}/src/library/install/make_shell_files.py)
set(files wavycon.1 wavycon.bash _wavycon)
set(templates ${files})
list(TRANSFORM files PREPEND ${folder}/)
list(TRANSFORM templates APPEND .in)
list(TRANSFORM templates PREPEND ${PROJECT_SOURCE_DIR}/src/library/install/)
file(MAKE_DIRECTORY ${folder})
file(STRINGS ${PROJECT_SOURCE_DIR}/CITATION.cff date REGEX "^date-released: ")
string(REPLACE "date-released: " "" date "${date}")
# The address sanitizer takes the variables of a Fortran main program for leaks.
add_custom_command(OUTPUT ${files} DEPENDS wavycon ${maker} ${templates} VERBATIM
  COMMAND ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0
    $<TARGET_FILE:Python3::Interpreter> ${maker} $<TARGET_FILE:wavycon> ${date} ${folder})
add_custom_target(wavycon-shell ALL DEPENDS ${files})

set(share share)
if(SKBUILD)
  set(share ${SKBUILD_DATA_DIR}/share)
endif()
install(FILES ${folder}/wavycon.1 DESTINATION ${share}/man/man1)
install(FILES ${folder}/wavycon.bash DESTINATION ${share}/bash-completion/completions RENAME wavycon)
install(FILES ${folder}/_wavycon DESTINATION ${share}/zsh/site-functions)
