#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bench/detection/run.sh [--yolo FOLDER] [--rounds N]: the time to search an image on two cores: our model and YOLO11n, with both
# back ends, compared with ONNX Runtime's Python package. Prints the table of docs/detection.md and writes it to build/detection.
# FOLDER has yolo11n_320.onnx and yolo11n_640.onnx of export_yolo.py; without it they are made, which installs torch (3 GB).
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
cd "$ROOT"
yolo=build/detection/yolo rounds=40
while [ $# -gt 0 ]; do
  case $1 in
    --yolo) yolo=$2; shift ;;
    --rounds) rounds=$2; shift ;;
    *) sed -n '3,5s/^# //p' "$0"; [ "$1" = --help ] && exit 0; exit 2 ;;
  esac
  shift
done
mkdir -p build/detection
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
bash scripts/openvino.sh

install_from_pypi build/detection/venv bench/detection/requirements.txt
if [ ! -f "$yolo/yolo11n_640.onnx" ]; then
  install_from_pypi build/detection/venv-yolo bench/detection/yolo_requirements.txt
  mkdir -p "$yolo"
  build/detection/venv-yolo/bin/python bench/detection/export_yolo.py "$yolo"
fi

say "Building"
[ -f build/release/build.ninja ] || cmake --preset release >build/detection/configure.log
cmake -S . -B build/release -DGEOLOC_BUILD_BENCH=ON >>build/detection/configure.log  # finds OpenVINO, if it was just installed
cmake --build build/release --target detection_worker >build/detection/build.log

say "Converting for OpenCV"
python=build/detection/venv/bin/python
networks=("our default=data/models/fiducial.onnx")
for size in 320 640; do
  for_opencv=build/detection/yolo11n_${size}_opencv.onnx
  "$python" tools/onnx_for_opencv.py "$yolo/yolo11n_$size.onnx" "$for_opencv"
  networks+=("YOLO11n, $size px=$yolo/yolo11n_$size.onnx,$for_opencv")
done

say "Measuring"
taskset -c 0,1 "$python" bench/detection/speed.py "${networks[@]}" --worker build/release/bin/detection_worker \
  --threads 2 --rounds "$rounds" | tee build/detection/speed.md
