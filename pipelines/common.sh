# shellcheck shell=bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the scripts pipelines/NAME/run share; each begins by sourcing it. Results go to $out.
#   OUT=FOLDER         where results go, if not to out/NAME
#   FILM=WIDTHxHEIGHT  size of films and pictures (default 640x360); FILM=no: none
#   SAMPLES=N          samples a pixel of films (default 4, denoised; false colours 24), a quarter of those of pictures
#   SHEET_BIN=FOLDER   looked into for programs before build/bin: put one of your own there to take a stage's place
# A run that was interrupted goes on where it was.
set -euo pipefail
if [[ ${1:-} == -h || ${1:-} == --help ]]; then # the comment that heads the script
  sed -n '3,/^[^#]/s/^# \{0,1\}//p' "${BASH_SOURCE[1]}"
  exit 0
fi
# check_arguments [ARGUMENT...]: refuses more of them, up to a --, than the script's head names, as [EDGE [UNTIL]], and
# lengths and times that are no numbers above 0. What is empty has its default.
check_arguments() {
  local script usage names name
  [[ " $* " != *' -- '* ]] || set -- "${@:1:$(printf '%s\n' "$@" | grep -nxm1 -e -- | cut -d: -f1) - 1}"
  script=$(realpath --relative-to="$(dirname "${BASH_SOURCE[0]}")/.." "${BASH_SOURCE[2]}")
  usage=$(sed -n '3,/^[^#]/s/^#  *pipelines\/[^ ]* *\(\[[][A-Z_ ]*\]\).*/\1/p' "${BASH_SOURCE[2]}" | head -1)
  read -ra names <<< "${usage//[][]/ }"
  ((${#names[@]} > 0)) || return 0 # the script reads its arguments itself
  (($# <= ${#names[@]})) ||
    { echo "$script: argument ${*:${#names[@]}+1:1} is one too many: $usage (see --help)" >&2; exit 2; }
  for name in "${names[@]:0:$#}"; do
    if [[ -n $1 && $name == @(EDGE|UNTIL|TOLERANCE|TIME|DT) ]]; then
      [[ $1 =~ ^[0-9]*\.?[0-9]*([eE][-+]?[0-9]+)?$ && $1 =~ ^[0.]*[1-9] ]] ||
        { echo "$script: $name: $1 is not a number above 0 (see --help)" >&2; exit 2; }
    fi
    shift
  done
}
check_arguments "$@"
[[ -z ${OUT:-} ]] || OUT=$(realpath -m "$OUT")
[[ -z ${SHEET_BIN:-} ]] || SHEET_BIN=$(realpath -m "$SHEET_BIN")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export PATH=${SHEET_BIN:+$SHEET_BIN:}$PWD/build/bin:$PATH
export PYTHONPATH=$PWD/pipelines${PYTHONPATH:+:$PYTHONPATH} # columns.py
name=$(dirname "${BASH_SOURCE[1]}") # the folder of the script that sources this
out=${OUT:-out/${name##*/}}
mkdir -p "$out" || { echo "the results go to $out, which cannot be made: give another folder by OUT=" >&2; exit 6; }
FILM=${FILM:-640x360}

# ring NAME UNTIL FPS STAGES SCENE [OPTION...]: runs the ring from the scene (options: sheet-init's) until that time;
# frames at the output times go to $out/NAME.sheet. What is there already is kept, and gone on with.
ring() {
  local stream=$out/$1.sheet until=$2 fps=$3 stages=$4
  shift 4
  local how="sheet-init $* | sheet-loop --fps $fps -- '$stages'"
  if [[ ! -e $stream ]]; then
    echo "$how" > "$stream.how"
    sheet-init "$@" > "$stream.start"
    mv "$stream.start" "$stream"
  elif [[ $how != "$(cat "$stream.how")" ]]; then
    echo "$stream was made with other options ($stream.how): remove it, or give another folder by OUT=" >&2
    exit 2
  fi
  sheet-loop --resume "$stream" --until "$until" --fps "$fps" -- "$stages"
}

# measure NAME: checks every frame, exactly, and leaves what sheet-info measures of each in $out/NAME.csv.
measure() {
  sheet-check "$out/$1.sheet"
  sheet-info --csv "$out/$1.sheet" > "$out/$1.csv"
}

# draw FACTOR NAME [OPTION...]: sheet-render with that multiple of the samples of a film. False colours have no noise,
# only edges.
draw() {
  local samples=${SAMPLES:-4} how=(--denoise)
  if [[ " $* " == *" --look "* ]]; then
    samples=${SAMPLES:-24} how=()
  fi
  sheet-render "$out/$2.sheet" --size "$FILM" --samples $(($1 * samples)) "${how[@]}" "${@:3}"
}

# film NAME FILM.mp4 [OPTION...]: options are sheet-render's.
film() {
  [[ $FILM != no ]] || return 0
  draw 1 "$1" "${@:3}" --y4m | ffmpeg -y -loglevel error -i - -pix_fmt yuv420p "$out/$2"
}

# picture NAME FRAME PICTURE.png [OPTION...]: one frame (-1: the last), with four times the samples.
picture() {
  [[ $FILM != no ]] || return 0
  draw 4 "$1" --frames "$2" "${@:4}" -o "$out/$3"
}

# plot NAME << END: $out/NAME.png by gnuplot, from commands that read CSV files.
plot() {
  {
    echo "set terminal pngcairo size 900, 600 font 'sans,12'; set output '$out/$1.png'"
    echo "set datafile separator ','; set grid linecolor rgb '#cccccc'"
    echo "set linetype 1 linecolor rgb '#0060ad'; set linetype 2 linecolor rgb '#dd181f'"
    echo "set linetype 3 linecolor rgb '#00a050'; set linetype 4 linecolor rgb '#c08000'; set linetype 5 linecolor \
rgb '#7030a0'; set key Left reverse"
    cat
  } | gnuplot
}

# panels hstack|vstack NAME PERCENT,PERCENT,... PICTURE.png [OPTION...]: the frames at these parts of a run that was
# measured (100: the last) beside or below each other, in 256 colours.
panels() {
  [[ $FILM != no ]] || return 0
  local folder percents=() shown=() inputs=() percent frame last
  last=$(($(wc -l < "$out/$2.csv") - 2))
  folder=$(mktemp -d "$out/.panels.XXXXXX")
  IFS=, read -ra percents <<< "$3"
  for percent in "${percents[@]}"; do
    frame=$(((percent * last + 50) / 100))
    shown+=("$frame")
    inputs+=(-i "$folder/$frame.png")
  done
  draw 4 "$2" --frames "$(IFS=,; echo "${shown[*]}")" "${@:5}" -o "$folder/%d.png"
  ffmpeg -y -loglevel error "${inputs[@]}" -filter_complex \
    "$1=${#percents[@]},split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=dither=none" "$out/$4"
  rm -r "$folder"
}
