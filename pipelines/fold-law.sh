# shellcheck shell=bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What pipelines/ice-cream/law and pipelines/folding/law share, sourced after common.sh: $out/law.csv has a line for each run.
#   kind       what is varied: speed or height
#   speed      of the sheet at the slot [m/s]; height of the slot above the belt [m]
#   edge       length of the edges [m]; tolerance: error of a step, in edges
#   period     of the folds [s]: the median; middle_half: the range of the middle half of them [s]
#   thickness, width  of the sheet where the folds are seen [m], means over the later half of the run
: "${out:?pipelines/common.sh says where results go}"
echo "kind,speed,height,edge,tolerance,period,middle_half,thickness,width" > "$out/law.csv"

# fold_run KIND SPEED HEIGHT EDGE TOLERANCE UNTIL FPS BELT LOW HIGH SCENE [OPTION...]: runs the scene (options: sheet-init's) until
# that time, with that many frames a second, and adds its line. The folds are seen LOW to HIGH metres above the belt, which is at the
# height BELT [m].
fold_run() {
  local kind=$1 speed=$2 height=$3 edge=$4 tolerance=$5 until=$6 fps=$7 belt=$8 low=$9 high=${10} name="$2-$3-$4-$5"
  ring "$name" "$until" "$fps" "sheet-remesh --edge-length $edge --smooth | sheet-emit | sheet-step --tolerance $tolerance | sheet-collide" \
    "${@:11}" --set "solid.0.center=[0,$belt,0]"
  sheet-check "$out/$name.sheet"
  pipelines/folds "$out/$name.sheet" "$belt" "$out/$name-swing.csv" "$out/$name-folds.csv" "$low" "$high"
  local size
  size=$(awk -F, -v u="$until" 'NR > 1 && $1 > u / 2 { n++; h += $3; w += $4 } END { if (n) printf "%.4g,%.4g", h / n, w / n; else printf "nan,nan" }' \
    "$out/$name-swing.csv")
  awk -F, 'NR > 1 && $2 > 0 { print $2 }' "$out/$name-folds.csv" | sort -g |
    awk -v row="$kind,$speed,$height,$edge,$tolerance" -v size="$size" '{ t[NR] = $1 }
      END { if (NR < 2) { print row ": too few folds; simulate more periods" > "/dev/stderr"; exit 1 }
        middle = (t[int((NR + 1) / 2)] + t[int(NR / 2) + 1]) / 2; quarter = int((NR + 3) / 4)
        printf "%s,%.5g,%.3g,%s\n", row, middle, t[NR + 1 - quarter] - t[quarter], size }' >> "$out/law.csv"
}

# exponent KIND EDGE TOLERANCE [LEAST [MOST]]: that of frequency in what is varied, by least squares of logarithms; of the values
# from LEAST to MOST alone.
exponent() {
  awk -F, -v kind="$1" -v edge="$2" -v tolerance="$3" -v least="${4:-0}" -v most="${5:-1e9}" '
    $1 == kind && $4 == edge && $5 == tolerance { q = kind == "speed" ? $2 : $3; if (q < least || q > most) next
      x = log(q); y = -log($6); n++; a += x; b += y; d += x * x; e += x * y }
    END { if (n > 1) printf "%.3f", (n * e - a * b) / (n * d - a * a) }' "$out/law.csv"
}
