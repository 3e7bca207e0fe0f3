#!/usr/bin/env bash
# Makes docs/images/paper.jpg from the pictures of a run: ./run && docs/make_images.sh [results/paper]
# Needs ImageMagick (apt-get install imagemagick).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
pictures=${1:-results/paper}/pictures
stereo=("$pictures"/cell_*_stereo_stereo/paper-stereo)
rgbd=("$pictures"/cell_*_near_rgbd/paper-rgbd)
montage \
  "${stereo[0]}"/{left,1_rectified,2_depth_image,3_closed_contour}.png \
  "${rgbd[1]}"/{color,depth,2_segmentation,3_range_image}.png \
  -background white -tile 4x2 -geometry 400x280+4+4 -quality 88 docs/images/paper.jpg
