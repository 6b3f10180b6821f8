#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tools/train/reproduce.sh [OUT]: images, training and the figures of docs/model.md, from a built checkout
# (build/release/bin/geoloc_sim exists). OUT (out/model) takes 27 GB. Files that exist there are kept, so an interrupted run
# continues.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
cd "$ROOT"
OUT=${1:-out/model}
mkdir -p "$OUT"
[ -d "$OUT/venv" ] || { python3 -m venv "$OUT/venv" && "$OUT/venv/bin/pip" install -q -r tools/train/requirements.txt; }

pictures() { # name count seed grounds [least and greatest distance]
  [ -d "$OUT/$1" ] || build/release/bin/geoloc_sim --images "$2" --seed "$3" --grounds "$4" ${5:+--range-m $5} \
    --crisp --out "$OUT/$1"
}
for seed in 1 2 3 4; do pictures "train_$seed" 1300 "$seed" train; done
pictures train_far 1300 5 train "35 85"
pictures validation 160 501 train
for seed in 9001 9002 9003; do pictures "held_back_$seed" 300 "$seed" held-back; done

export OMP_WAIT_POLICY=passive  # spinning threads would take time from each other on a busy machine
BFLOAT16=$(grep -qm1 avx512_bf16 /proc/cpuinfo && echo --bfloat16 || true)
python=$OUT/venv/bin/python
[ -f "$OUT/fiducial.onnx" ] || "$python" tools/train/train.py --train "$OUT"/train_[1-4] --validation "$OUT/validation" \
  --out "$OUT/fiducial.onnx" $BFLOAT16
[ -f "$OUT/fiducial_second_look.onnx" ] || "$python" tools/train/train_second_look.py --train "$OUT"/train_[1-4] "$OUT/train_far" \
  --validation "$OUT/validation" --detector "$OUT/fiducial.onnx" --out "$OUT/fiducial_second_look.onnx" $BFLOAT16
"$python" tools/train/evaluate.py "$OUT/fiducial.onnx" --validation "$OUT/validation" --held-back "$OUT"/held_back_* \
  --figures "$OUT/figures"
