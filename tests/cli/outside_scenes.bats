#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Scenes as users write them: too much of something, something left out, something that cannot be.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > disk.toml << 'END'
[sheet]
shape = "disk"
radius = 1
edge_length = 0.4
thickness = 0.01
[material]
viscosity = 100
density = 1000
END
}

@test "1: more holds or solids than a frame has bits for are refused, by every program" {
  for kind in hold solid; do
    cp disk.toml many.toml
    for i in $(seq 65); do
      [[ $kind != hold ]] || printf '[[hold]]\nregion = "rim"\n'
      [[ $kind != solid ]] || printf '[[solid]]\nshape = "sphere"\ncenter = [9, 0, %d]\nradius = 0.1\n' "$i"
    done >> many.toml
    printf '[contact]\n' >> many.toml
    run -3 sheet-init many.toml -o many.sheet
    [[ $output == *"$kind: 65 tables [[$kind]]; a scene may have 64"* ]]
    run -3 sheet-init --check many.toml
    sheet-init disk.toml | sheet-print | grep -v '^| ' | sed '/^array scene /r '<(sed 's/^/| /' many.toml) |
      sheet-parse > many.sheet
    run -3 sheet-collide many.sheet -o out.sheet
    run -3 sheet-step --dt 0.01 many.sheet -o out.sheet
  done
}

@test "3: what a hold has let go is remeshed like what nothing ever held" {
  remeshed() { # SCENE: a second after its start, with edges twice as long
    sheet-init "$1" --set sheet.edge_length=0.1 | sheet-print | sed 's/^time 0$/time 1/' | sheet-parse |
      sheet-remesh --edge-length 0.2
  }
  remeshed disk.toml > free.sheet
  { cat disk.toml; printf '[[hold]]\nregion = "rim"\naxes = "z"\nuntil = 0.5\n[[hold]]\nregion = "rim"\nuntil = 2\n'; } > holds.toml
  remeshed holds.toml > held.sheet
  sed '/^until = 2/s/2/1/' holds.toml > released.toml
  remeshed released.toml > released.sheet
  sheet-diff --ignore hold --ignore scene --ignore provenance free.sheet released.sheet
  run -1 sheet-diff --ignore hold --ignore scene --ignore provenance free.sheet held.sheet
  sheet-print held.sheet | sed -n '/^array hold /,/^array /p' | grep '^[0-9]*$' | sort -u | tr '\n' ' ' > bits
  [[ $(cat bits) == '0 2 ' ]]
}
