#!/usr/bin/env python3
"""wavycon_test_properties: which ends of a test are failures, as CTest itself sees them."""

import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

PROPERTIES = pathlib.Path(__file__).resolve().parent.parent / 'test_properties.cmake'
PASSED = 'OK\\n (3 tests)\\n'  # pFUnit's last lines, as printf takes them

# {name: (what the test prints, exit status, whether it passes)}
ENDS = {
    'all_is_well': (PASSED, 0, True),
    'status_after_ok': (PASSED, 1, False),
    'leak_after_ok': (PASSED + '==1==ERROR: LeakSanitizer: detected memory leaks\\n', 23, False),
    'leak_with_status_0': (PASSED + 'SUMMARY: AddressSanitizer: 8 byte(s) leaked in 1 allocation(s).\\n', 0, False),
    'bad_address': ('==1==ERROR: AddressSanitizer: heap-use-after-free\\n' + PASSED, 0, False),
    'undefined_behaviour': ('a.c:3:5: runtime error: signed integer overflow\\n' + PASSED, 0, False),
    'no_tests': ('OK\\n (0 tests)\\n', 0, False),
    'ten_tests': ('OK\\n (10 tests)\\n', 0, True),
}


class TestProperties(unittest.TestCase):
    def test_ends(self):
        lines = ['cmake_minimum_required(VERSION 3.20)', 'project(ends LANGUAGES NONE)', 'enable_testing()',
                 f'include("{PROPERTIES.as_posix()}")']
        for name, (output, status, _) in ENDS.items():
            lines += [f"add_test(NAME {name} COMMAND sh -c [==[printf '{output}'; exit {status}]==])",
                      f'wavycon_test_properties({name} ends)']
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, 'CMakeLists.txt').write_text('\n'.join(lines) + '\n', encoding='utf-8')
            subprocess.run(['cmake', '-S', folder, '-B', folder, *(['-GNinja'] if shutil.which('ninja') else [])],
                           check=True, capture_output=True)
            run = subprocess.run(['ctest', '--test-dir', folder, '-L', 'ends'], check=False, capture_output=True, text=True)
        found = dict(re.findall(r'Test +#\d+: (\w+) \.+\** *(Passed|Failed)', run.stdout.replace('***', '* ')))
        self.assertEqual({name: 'Passed' if passes else 'Failed' for name, (_, _, passes) in ENDS.items()}, found)


if __name__ == '__main__':
    unittest.main()
