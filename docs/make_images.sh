#!/usr/bin/env bash
# Makes the pictures of the README and of docs/*.md from those of these runs:
#     ./run && ./run run gallery && ./run emva results/emva
#     ./run depth results/depth
#     pairs=tests/data/stereo-calibration
#     ./run calibrate stereo --left "$pairs/left*.jpg" --right "$pairs/right*.jpg" --corners 9x6 \
#       --square-mm 30 --out results/rig
#     docs/make_images.sh [results]
# Needs ImageMagick (apt-get install imagemagick).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
results=${1:-results}

convert "$results/emva/photon_transfer.png" -colors 64 docs/images/photon_transfer.png
convert "$results/depth/depth_curves.png" -colors 64 docs/images/depth_curves.png
convert "$results/rig/residuals.png" -colors 64 docs/images/residuals.png

pictures=$results/paper/pictures
stereo=("$pictures"/cell_*_stereo_stereo/paper-stereo)
rgbd=("$pictures"/cell_*_near_rgbd/paper-rgbd)
montage \
  "${stereo[0]}"/{left,1_rectified,2_depth_image,3_closed_contour}.png \
  "${rgbd[1]}"/{color,depth,2_segmentation,3_range_image}.png \
  -background white -tile 4x2 -geometry 400x280+4+4 -quality 88 docs/images/paper.jpg

# Rows: the left stereo camera, the colour camera, the depth image; columns: four lights.
shots=()
for shot in stereo/paper-stereo/left rgbd/paper-rgbd/color rgbd/paper-rgbd/depth; do
  for light in overcast noon low-sun night; do
    folder=("$results"/gallery/pictures/cell_*_"${light}_${shot%%/*}")
    shots+=("${folder[0]}/${shot#*/}.png")
  done
done
montage "${shots[@]}" -background white -tile 4x3 -geometry 360x270+4+4 -quality 88 \
  docs/images/gallery.jpg

# The paper's two pipelines, stage by stage, for docs/detectors.md.
small() { convert "$1" -resize 360x ${3:+-colors "$3"} -quality 80 "docs/images/$2"; }
small "${stereo[0]}/1_rectified.png" paper_stereo_rectified.jpg
small "${stereo[0]}/2_depth_image.png" paper_stereo_depth.jpg
small "${stereo[0]}/3_closed_contour.png" paper_stereo_closed.jpg
small "${stereo[0]}/4_edges.png" paper_stereo_edges.png 8
small "${rgbd[1]}/2_segmentation.png" paper_rgbd_segmentation.png 32
small "${rgbd[1]}/3_range_image.png" paper_rgbd_key_points.png 64
