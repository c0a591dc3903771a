# shellcheck shell=bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What pipelines/ice-cream/law and pipelines/folding/law share, sourced after common.sh: $out/law.csv has a line for
# each run.
#   kind       what is varied: speed or height
#   speed      of the sheet at the slot [m/s]; height of the slot above the belt [m]
#   edge       length of the edges [m]; tolerance: error of a step, in edges
#   period     of the folds [s]: the median; middle_half: the range of the middle half of them [s]
#   thickness, width  of the sheet where the folds are seen [m], means over the later half of the run
: "${out:?pipelines/common.sh says where results go}"
echo "kind,speed,height,edge,tolerance,period,middle_half,thickness,width" > "$out/law.csv"

# fold_run KIND SPEED HEIGHT EDGE TOLERANCE UNTIL FPS BELT LOW HIGH SCENE [OPTION...]: runs the scene (options:
# sheet-init's) until that time, with that many frames a second, and adds its line. The folds are seen LOW to HIGH
# metres above the belt, which is at the height BELT [m].
fold_run() {
  local kind=$1 speed=$2 height=$3 edge=$4 tolerance=$5 until=$6 fps=$7 belt=$8 low=$9 high=${10} name="$2-$3-$4-$5"
  ring "$name" "$until" "$fps" "sheet-remesh --edge-length $edge --smooth | sheet-emit | sheet-step --tolerance \
$tolerance | sheet-collide" \
    "${@:11}" --set "solid.0.center=[0,$belt,0]"
  sheet-check "$out/$name.sheet"
  pipelines/folds "$out/$name.sheet" "$belt" "$out/$name-swing.csv" "$out/$name-folds.csv" "$low" "$high"
  local line
  line=$(pipelines/fold-law.py line "$out/$name-swing.csv" "$out/$name-folds.csv" "$until")
  echo "$kind,$speed,$height,$edge,$tolerance,$line" >> "$out/law.csv"
}

# exponent KIND EDGE TOLERANCE [LEAST [MOST]]: that of frequency in what is varied, by least squares of logarithms; of
# the values from LEAST to MOST alone.
exponent() {
  pipelines/fold-law.py exponent "$out/law.csv" "$@"
}
