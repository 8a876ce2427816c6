# shellcheck shell=bash
# What the bash scripts that build and run the program share. To be sourced.

root=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
build=$root/build

# Fedora and its kin keep the programs of MPI where `module load mpi` adds them to PATH.
if ! command -v mpifort >/dev/null 2>&1 && [ -d /usr/lib64/openmpi ]; then PATH=$PATH:/usr/lib64/openmpi/bin; fi

# say WORDS...: a message on standard error, after the script's name.
say() {
   echo "${0##*/}: $*" >&2
}

# answer_help [OPTION...]: prints the script's `usage` and exits if the first option asks for help.
answer_help() {
   case ${1-} in
   -h | --help)
      usage
      exit 0
      ;;
   esac
}

# bad_usage WORDS...: a message, the usage, and exit status 1.
bad_usage() {
   say "$*"
   usage >&2
   exit 1
}

# check_ctest_options WORDS...: refuses what ctest would pass over, and then run all tests: options that it does not
# know, and words that belong to no option. Without ctest, which scripts/build installs, nothing is checked.
check_ctest_options() {
   local before='' known word
   known=$(ctest --help 2>/dev/null | tr ' ,=[<' '\n') || return 0
   for word; do
      case $word in
      -j[0-9]*) ;;
      -*) grep -qxF -e "${word%%=*}" <<<"$known" || bad_usage "unknown option '$word'" ;;
      *) [[ $before = -* ]] || bad_usage "'$word' belongs to no option" ;;
      esac
      before=$word
   done
}

# sha256 WORDS...: sha256sum; macOS has shasum instead.
sha256() {
   if command -v sha256sum >/dev/null 2>&1; then sha256sum "$@"; else shasum -a 256 "$@"; fi
}

# cached PATTERN: the values of the entries of CMake's cache whose names match.
cached() {
   sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"
}

# build_all: builds the programs and all tests; without what needs MPI where that cannot be installed.
build_all() {
   # If MPI cannot be installed, do not try again on every run, but only after `scripts/build --mpi` has succeeded.
   local no_mpi=$build/no-mpi
   if [ ! -e "$no_mpi" ] && "$root/scripts/dependencies" --mpi; then
      "$root/scripts/build" --mpi all
   else
      say 'the tests of the parallel program are SKIPPED: MPI cannot be installed'
      "$root/scripts/build"
      : >"$no_mpi"
   fi
}

# python_with_numpy: prints the name of a Python with NumPy, which is installed into build/peers if necessary.
python_with_numpy() {
   python3 "$root/tests/bench/peer_install.py" "$build/peers"
}
