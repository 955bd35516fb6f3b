#!/usr/bin/env bash
# MakeGallery.sh PROGRAM CLOUDS [DOCUMENTATION]: draws the clouds of the table below at first glance, with no option but the
# size, and writes Gallery.md and Images/gallery-*.jpg into DOCUMENTATION (default: the folder of this script). CLOUDS is a
# folder with the files: they are data of other people and not in this repository. Where the terms of one do not go with
# those of this repository, its picture is left in a folder that is said at the end, and Gallery.md has words
# alone. Needs an X server (DISPLAY) and ImageMagick. Exit code 0: all were drawn; 1: not, the last line says which.
set -euo pipefail
if (($# < 2 || $# > 3)); then
  echo "usage: MakeGallery.sh PROGRAM CLOUDS [DOCUMENTATION]" >&2
  exit 2
fi
program="$(realpath -- "$1")"
clouds="$(realpath -- "$2")"
documentation="$(realpath -- "${3:-$(dirname -- "${BASH_SOURCE[0]}")}")"
page="$documentation/Gallery.md"
apart="$(mktemp -d)"
command -v convert >/dev/null || { echo "MakeGallery.sh: convert is not there; install imagemagick" >&2; exit 1; }

# FILE | kept or apart: where the picture goes | what one sees | source and terms
table() {
  cat <<'ROWS'
bun_zipper.ply|kept|The fur is carved and the thigh folds over: clay, because the scan's intensity tells nothing.|Stanford Bunny, range scans. Stanford Computer Graphics Laboratory, Stanford 3D Scanning Repository: research use with credit, no commercial use without permission.
lucy_50k.ply|kept|Folds of the gown and feathers from 50,000 points without a mesh.|Lucy, from the data of VTK. Stanford Computer Graphics Laboratory, Stanford 3D Scanning Repository: as above.
happy_543652.ply|kept|Fifteen raw scans, not merged: where they lie on each other their noise casts no shadows.|Happy Buddha, 15 aligned range scans. Stanford Computer Graphics Laboratory, Stanford 3D Scanning Repository: as above.
lion_takanawa.ply|kept|A lion in its photographed colours: the stone stays grey, light only shapes it, and the pavement frays into points.|Potree, lion_takanawa: BSD 2-Clause.
office1.pcd|kept|One frame of a depth camera, from where the camera stood.|Point Cloud Library, test/office1.pcd: BSD 3-Clause.
outdoor_lidar.ply|kept|A street by a spinning scanner: rings and railings are lines, and walls turn their faces to the viewer.|small_gicp, data/target.ply: MIT.
room_scan1.pcd|kept|A room of 30 m as a doll's house: near walls are left out, and can still be felt.|Point Cloud Library, tutorials/room_scan1.pcd: BSD 3-Clause.
samp11-utm.pcd|kept|A village on a slope, across the window: roofs close, trees stay points, colours are heights.|ISPRS filter test, from the Point Cloud Library's terrain data: BSD 3-Clause.
Megaplot.las|apart|A forest from the air beside open ground: crowns are loose points, the ground closes.|lasR, Megaplot.las: GPL 3.
pine.las|apart|One pine of 20 m: trunk, dead branches and crown, each needle a point.|TreeLS, pine.laz: GPL 3.
ROWS
}

{
  echo "# Gallery"
  echo
  echo "This is what \`pointhaptics view FILE\` shows at first glance of clouds that nobody tuned it for: kind of cloud, size of the"
  echo "points, light, colours and camera are decided from the data alone. [Tour.md](Tour.md) says which key changes what. The files"
  echo "are other people's; below each picture stands whose, and under which terms. \`Documentation/MakeGallery.sh\` makes this page of a"
  echo "folder of them; of meshes it shows the vertices (\`--vertices\`). Corners mark the workspace that the hand reaches."
} >"$page"
left=""
while IFS='|' read -r file place seen source; do
  name="gallery-${file%.*}"
  folder="$documentation/Images"
  [[ "$place" == apart ]] && folder="$apart"
  if ! "$program" view "$clouds/$file" --vertices --size 800x500 --screenshot "$apart/$name.png" </dev/null; then
    echo "MakeGallery.sh: $clouds/$file could not be drawn" >&2
    exit 1
  fi
  convert "$apart/$name.png" -strip -quality 86 "$folder/$name.jpg"
  points="$("$program" info "$clouds/$file" --json | sed -nE 's/.*"points": *([0-9]+).*/\1/p' |
    sed -E ':next; s/([0-9])([0-9]{3})(,|$)/\1,\2\3/; t next')"
  {
    echo
    echo "## ${file%.*}: $points points"
    echo
    if [[ "$place" == kept ]]; then
      echo "![$file at first glance](Images/$name.jpg)"
      echo
    fi
    echo "$seen"
    echo
    echo "*$source*"
  } >>"$page"
  [[ "$place" == apart ]] && left="$left $folder/$name.jpg"
done < <(table)
echo "wrote $page; not for this repository:$left"
