#!/bin/sh
# Pictures of the gallery from the examples.
#   examples/make_pictures.sh DDA [DIRECTORY]   the program, with its path; where they go, by default doc/
set -e
dda=$1
here=$(cd "$(dirname "$0")" && pwd)
doc=${2:-$here/../doc}
mkdir -p "$doc"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for name in plane_failure two_wedges slope_two_sets; do
  "$dda" safety "$here/$name.toml" -o "$scratch/$name" --quiet
  cp "$scratch/$name/safety_moved.svg" "$doc/example_$name.svg"
done
"$dda" run "$here/arch_quarter_load.toml" --set parameters.load=-80e3 -o "$scratch/arch" --quiet
"$dda" plot "$scratch/arch" --field s2 --forces --thrust -o "$doc/example_arch_quarter_load.svg"
"$dda" run "$here/wall_door.toml" --set parameters.push=9.5e3 -o "$scratch/wall" --quiet
"$dda" plot "$scratch/wall" --field s2 --forces -o "$doc/example_wall_door.svg"
"$dda" plot "$here/dam.toml" --names -o "$doc/example_dam.svg"
"$dda" run "$here/rockfall.toml" -o "$scratch/rockfall" --quiet
"$dda" plot "$scratch/rockfall" --field displacement --reference -o "$doc/example_rockfall.svg"
"$dda" run "$here/drums.toml" --set output.every=5 -o "$scratch/drums" --quiet
"$dda" plot "$scratch/drums" --frame 805 -o "$doc/example_drums.svg"
"$dda" safety "$here/retaining_wall.toml" -o "$scratch/retaining" --quiet
cp "$scratch/retaining/safety_moved.svg" "$doc/example_retaining_wall.svg"
"$dda" run "$here/tunnel_bolts.toml" --set parameters.bond=1 -o "$scratch/loose" --quiet
"$dda" run "$here/tunnel_bolts.toml" -o "$scratch/bolted" --quiet
"$dda" plot "$scratch/loose" "$scratch/bolted" --field none --window 7,29,7,22 -o "$doc/example_tunnel_bolts.svg"
"$dda" run "$here/arch_bridge.toml" -o "$scratch/bridge" --quiet
"$dda" plot "$scratch/bridge" --frame 80 --field s2 --forces -o "$doc/example_arch_bridge.svg"
"$dda" run "$here/jointed_column.toml" -o "$scratch/column" --quiet
"$dda" plot "$scratch/column" --frame 160 --field s2 -o "$doc/example_jointed_column.svg"
for picture in $(grep -o 'example_[a-z_]*\.svg' "$here/../doc/gallery.md"); do
  test -s "$doc/$picture" || { echo "$picture of the gallery is not made here" >&2; exit 1; }
done
