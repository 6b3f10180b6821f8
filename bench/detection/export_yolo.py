# SPDX-License-Identifier: Apache-2.0
"""export_yolo.py FOLDER: YOLO11n as ultralytics builds it, with untrained weights (nothing is downloaded; speed does not
depend on them), at 320 and 640 px: FOLDER/yolo11n_320.onnx, FOLDER/yolo11n_640.onnx. Needs ultralytics (AGPL-3.0), which is
a tool here and no part of geoloc."""

import sys
from pathlib import Path

from ultralytics import YOLO

folder = Path(sys.argv[1])
for size in (320, 640):
    exported = YOLO("yolo11n.yaml").export(format="onnx", imgsz=size, opset=17, simplify=False)
    Path(exported).replace(folder / f"yolo11n_{size}.onnx")
