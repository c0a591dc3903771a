#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# pipelines/fit: parameters from measurements.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_DIRNAME/../.." || exit
  t=$BATS_TEST_TMPDIR
  cp pipelines/fitting/strip/* "$t"
}

# usage: found KEY PYTHON: whether the expression of value and error (v, e) holds
found() {
  python3 -c "
import json, sys
r = json.load(open('$t/fit/fit.json'))
v, e = r['values']['$1'], r['errors']['$1']
sys.exit(0 if $2 else f'{v} {e}')"
}

@test "a viscosity is found within its error, and the same command goes on" {
  run -0 --separate-stderr pipelines/fit "$t/fit.toml" -o "$t/fit"
  found material.viscosity 'abs(v - 1e8) < 2 * e and 0.005e8 < e < 0.03e8'
  [[ $output == *"they agree within sigma"* && -s $t/fit/fit.png ]]
  before=$output
  find "$t/fit" -name run.sheet -exec stat -c '%n %Y %Z' {} + | sort > "$t/before"
  run -0 --separate-stderr pipelines/fit "$t/fit.toml" -o "$t/fit"
  [[ $output == "$before" ]]
  find "$t/fit" -name run.sheet -exec stat -c '%n %Y %Z' {} + | sort | cmp - "$t/before"
}

@test "three parameters are found in three scenes" {
  three() { # FIT.toml KEY TRUE KEY TRUE KEY TRUE
    run -0 --separate-stderr pipelines/fit "pipelines/fitting/$1" -o "$t/fit"
    for ((i = 2; i <= $#; i += 2)); do
      found "${!i}" "abs(v - ${*:i+1:1}) < 3 * e and e < 0.1 * v"
    done
  }
  three strip/weighed.toml material.viscosity 1e8 material.density 2500 sheet.thickness 5
  three dome/fit.toml material.viscosity 1e5 sheet.thickness 1.5 environment.pressure.amount 64
  three bubble/fit.toml material.viscosity 10 material.surface_tension 0.05 sheet.thickness 1
}

@test "how often a true value is within the stated error is counted" {
  run -0 --separate-stderr pipelines/fitting/coverage "$t/fit.toml" material.viscosity=1e8 --seeds 3 -o "$t/coverage"
  [[ ${lines[0]} =~ ^'material.viscosity: '[01].[036][037]' within the error; mean '[-+].*', deviation ' ]]
  # A fit of one parameter is right as often as a linear one of the same noise.
  [[ ${lines[1]} =~ ^'all: '(0.[036][037]|1.00)' of 3; with true slopes '(.*)$ ]]
  [[ ${BASH_REMATCH[1]} == "${BASH_REMATCH[2]}" ]]
  run -2 --separate-stderr pipelines/fitting/coverage "$t/fit.toml" material.density=1 -o "$t/coverage"
  [[ $stderr == *"true values of material.viscosity are needed"* ]]
}

@test "a row of the thickness is a parameter like others" {
  sed 's/^edge_length.*/edge_length = "4 mm"/' pipelines/designing/dome/scene.toml > "$t/scene.toml"
  sheet-init "$t/scene.toml" --set 'sheet.thickness.radial.0.1=2 mm' |
    sheet-loop -q --until 10 --fps 0.5 -- 'sheet-step --dt 0.5' | sheet-info --csv |
    awk -F, 'NR == 1 { print "time [s], thickness_min [m]" } NR > 2 { print $2 "," $7 }' > "$t/thin.csv"
  printf '%s\n' 'scene = "scene.toml"' 'ring = "sheet-step --dt 0.5"' 'until = 10' 'fps = 0.5' '[[parameter]]' \
    'key = "sheet.thickness.radial.0.1"' 'from = "1.2 mm"' 'to = "3 mm"' '[[measured]]' 'file = "thin.csv"' \
    'observer = "thickness_min"' 'sigma = "1 um"' > "$t/fit.toml"
  run -0 --separate-stderr pipelines/fit "$t/fit.toml" -o "$t/fit"
  found sheet.thickness.radial.0.1 'abs(v - 2) < 1e-3'
}

@test "what the data do not tell is said" {
  printf '\n[[parameter]]\nkey = "material.density"\nfrom = "1000 kg/m^3"\nto = "5000 kg/m^3"\n' >> "$t/fit.toml"
  run -0 --separate-stderr pipelines/fit "$t/fit.toml" -o "$t/fit"
  [[ $output == *"material.density is not determined by these data"* ]]
  [[ $output == *"nothing that was measured changes with material.viscosity by "*" and material.density by "* ]]
}

@test "what is wrong is told, with its place" {
  wrong() { # SED-COMMAND FILE MESSAGE
    cp pipelines/fitting/strip/* "$t"
    sed -i "$1" "$t/$2"
    run -3 pipelines/fit "$t/fit.toml" -o "$t/wrong"
    [[ $output == *"$3"* ]] || { echo "$output"; return 1; }
  }
  wrong 's/^until.*//' fit.toml 'until when?'
  wrong 's/"1e10 Pa\*s"/"1e10"/' fit.toml 'parameter 1: from, to and start are numbers of one unit'
  wrong 's/"1e10 /"1e6 /' fit.toml 'material.viscosity: a range goes from a number to a greater one'
  wrong 's/^log/lag/' fit.toml 'parameter 1: unknown key "lag"'
  wrong 's/^sigma.*//' fit.toml 'measured 1: sigma, the standard deviation'
  wrong 's/"y_min"/"lowest"/; s/$//' fit.toml 'sag.csv:2: unknown column "y_min"; known: time, lowest, sigma'
  wrong 's/\[mm\]/[kg]/' sag.csv 'column "y_min": [kg] is not [m], nor a part of it'
  wrong 's/,/;/; s/[.]/,/g' sag.csv 'sag.csv:2: columns are separated by commas, not by semicolons; numbers have a decimal point'
  wrong 's/-8.241/high/' sag.csv 'sag.csv:4: expected 2 numbers'
  wrong 's/2000, /3000, /' sag.csv 'measured 1: times from 500 to 3000 s, but'
  wrong 's/material.viscosity/material.viskosity/' fit.toml 'did you mean "viscosity"?'
  wrong 's/scene.toml/scenes.toml/' fit.toml 'scenes.toml'
  wrong 's/sag.csv/gas.csv/' fit.toml 'gas.csv: No such file'
}
