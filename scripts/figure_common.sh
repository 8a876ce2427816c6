# shellcheck shell=sh
# What the scripts of the figures share: options, the program, the decks, gnuplot. To be sourced.

# start_figure NAME TITLE [OPTION...]: reads the options, changes to the top of the tree, finds the program.
start_figure() {
   figure=$1
   title=$2
   shift 2
   format=png
   while [ $# -gt 0 ]; do
      case $1 in
         --format) [ $# -gt 1 ] || refuse '--format wants png, svg or pdf'; format=$2; shift ;;
         --format=*) format=${1#--format=} ;;
         --help | -h) show_help; exit 0 ;;
         *) refuse "unknown option '$1'" ;;
      esac
      shift
   done
   case $format in
      png | svg | pdf) ;;
      *) refuse "unknown format '$format': png, svg or pdf" ;;
   esac

   # A relative path in WAVYCON starts at the caller's directory, not at the top of the tree.
   wavycon=${WAVYCON-}
   case $wavycon in
      */*) wavycon=$(cd "$(dirname "$wavycon")" && pwd)/$(basename "$wavycon") ;;
   esac
   cd "$(dirname "$0")/.." || exit
   [ -n "$wavycon" ] || wavycon=$PWD/build/wavycon
   command -v "$wavycon" >/dev/null ||
      stop "no program $wavycon: build it, 'cmake -S . -B build && cmake --build build', or set WAVYCON"
   command -v gnuplot >/dev/null || stop 'gnuplot is not installed'
}

show_help() {
   case $figure in
      fig*) title="$title of Johnson, Greenwood & Higginson (1985)" ;;
   esac
   cat <<EOF
usage: $(basename "$0") [--format png|svg|pdf] [--help]

Draws $title.

The picture is outputs/figures/$figure.FORMAT, by default png, drawn from tables that the program writes under
outputs/. Prints its name. The program is build/wavycon of the tree, or the one that the variable WAVYCON names.

Exit status: 0 drawn, 1 if not.
EOF
}

refuse() {
   printf '%s: %s\n' "$(basename "$0")" "$1" >&2
   show_help >&2
   exit 1
}

stop() {
   printf '%s: %s\n' "$(basename "$0")" "$1" >&2
   exit 1
}

# run_decks CASE...: runs inputs/CASE.nml, results under outputs/CASE/.
run_decks() {
   for case in "$@"; do
      "$wavycon" --quiet "inputs/$case.nml"
   done
}

# header_value CASE TABLE NAME: the number of 'NAME[unit] = number' in the head of a table, whatever the unit.
header_value() {
   awk -v name="$3 =" '/^#/ && !/^# title:/ { gsub(/\[[^]]*\]/, "") } /^#/ && (i = index($0, name)) {
      split(substr($0, i + length(name)), field, ","); print field[1]; exit }' "outputs/$1/$1.$2.dat"
}

# draw_figure WIDTH HEIGHT [NAME=VALUE...]: draws the gnuplot commands of the standard input, with width and height in
# points of 1/72 inch. The picture appears only when it is complete.
draw_figure() {
   settings="width = $1; height = $2; format = '$format'"
   shift 2
   for setting in "$@"; do
      settings="$settings; $setting"
   done
   mkdir -p outputs/figures
   picture=outputs/figures/$figure.$format
   aside=outputs/figures/.$figure.$$.$format
   trap 'rm -f "$aside"' EXIT
   # -d: without the user's own gnuplot settings. UTF-8 in any locale, for the labels.
   LC_ALL=C.UTF-8 gnuplot -d -e "$settings; picture = '$aside'" scripts/figure_style.gp /dev/stdin
   # Some programs drop the blanks where a text of an svg changes its face, unless it asks for them.
   if [ "$format" = svg ]; then
      sed 's/<text>/<text xml:space="preserve">/' "$aside" >"$aside.part"
      mv "$aside.part" "$aside"
   fi
   mv "$aside" "$picture"
   printf '%s\n' "$PWD/$picture"
}
