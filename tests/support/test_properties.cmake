# What no test may print, whatever its exit status. The undefined behaviour sanitizer reports an error and goes on;
# pFUnit finds nothing wrong with a program that has no tests.
# N.B. No test of a program has a PASS_REGULAR_EXPRESSION: with one CTest ignores the exit status.
set(wavycon_failure_words
  "ERROR: [A-Za-z]+Sanitizer" "SUMMARY: [A-Za-z]+Sanitizer" "runtime error:" "OK\n \\(0 tests\\)")

# wavycon_test_properties(name labels): a test passes if its exit status is 0 and it prints none of these words.
# Tests with the label `long` are left out by scripts/test and run by scripts/stress.
function(wavycon_test_properties name labels)
  set_property(TEST ${name} PROPERTY LABELS ${labels})
  # What tests in Python import.
  set_property(TEST ${name} PROPERTY ENVIRONMENT
    "PYTHONPATH=${CMAKE_CURRENT_FUNCTION_LIST_DIR}" PYTHONDONTWRITEBYTECODE=1)
  set_property(TEST ${name} APPEND PROPERTY FAIL_REGULAR_EXPRESSION ${wavycon_failure_words})
endfunction()
