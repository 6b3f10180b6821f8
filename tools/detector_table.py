#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the table of detectors in docs/detection.md: what ultralytics exports, and what geoloc_detect says to it.

    python3 -m venv VENV && VENV/bin/pip install -r tools/detector_table_requirements.txt
    VENV/bin/python tools/detector_table.py build/release/bin/geoloc_detect FOLDER
    VENV/bin/python tools/detector_table.py build/release/bin/geoloc_detect PICTURES --weights MODEL.onnx

Each network is made of ultralytics' architecture files with random weights, exported into FOLDER (once), and run on a picture
of noise with each back end. A conversion that a refusal advises is made. Boxes are compared with those of ultralytics' own
post-processing on ONNX Runtime. --weights compares one model on all pictures of a folder instead. ultralytics is licensed
under the AGPL-3.0: nothing of it is part of geoloc.
"""

import argparse
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

SIDE_PX = 320
CONFIDENCE, OVERLAP = 0.25, 0.5
BACKENDS = ("opencv", "openvino")
PLACES = 80  # that reach it, before suppression
SPREAD = 1.0  # 1-sigma of the logits of their scores
MARGIN = 0.005  # a score so close to the threshold may fall on either side of it
SAME_PX = 1
MOST_LETTERS = 400  # of a refusal; some quote the back end at length
TOOLS = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Case:
    words: str
    architecture: str
    arguments: dict = field(default_factory=dict)
    options: tuple = ()  # of geoloc_detect

    @property
    def file(self) -> str:
        words = [f"{key}_{value}" for key, value in self.arguments.items()]
        return "-".join([self.architecture, "exported", *words]) + ".onnx"


OPEN, END_TO_END = {"dynamic": True}, {"nms": False}
CASES = [
    Case("YOLOv8n", "yolov8n"),
    Case("YOLO11n", "yolo11n"),
    Case("YOLO12n", "yolo12n"),
    Case("YOLO11n, `opset=12`", "yolo11n", {"opset": 12}),
    Case("YOLO11n, `opset=17`", "yolo11n", {"opset": 17}),
    Case("YOLO11n, `opset=20`", "yolo11n", {"opset": 20}),
    Case("YOLO11n, `dynamic=True`", "yolo11n", OPEN),
    Case("the same with `--input-size 320 320`", "yolo11n", OPEN, ("--input-size", SIDE_PX, SIDE_PX)),
    Case("YOLO11n, `half=True`", "yolo11n", {"half": True}),
    Case("YOLO11n, `batch=2`", "yolo11n", {"batch": 2}),
    Case("YOLO11n, `nms=True`", "yolo11n", {"nms": True}),
    Case("YOLO11n, `nms=True opset=12`", "yolo11n", {"nms": True, "opset": 12}),
    Case("YOLOv10n", "yolov10n"),
    Case("YOLOv10n, end to end (`nms=False`)", "yolov10n", END_TO_END),
    Case("YOLO26n", "yolo26n"),
    Case("YOLO26n, end to end", "yolo26n", END_TO_END),
    Case("RT-DETR-l", "rtdetr-l"),
    Case("YOLO11n-obb", "yolo11n-obb"),
    Case("YOLO11n-obb, `nms=True`", "yolo11n-obb", {"nms": True}),
    Case("YOLO26n-obb", "yolo26n-obb"),
    Case("YOLO26n-obb, end to end", "yolo26n-obb", END_TO_END),
    Case("YOLO11n-seg", "yolo11n-seg"),
    Case("YOLO11n-seg, `nms=True`", "yolo11n-seg", {"nms": True}),
    Case("YOLO26n-seg", "yolo26n-seg"),
    Case("YOLO26n-seg, end to end", "yolo26n-seg", END_TO_END),
    Case("YOLO11n-pose", "yolo11n-pose"),
    Case("YOLO11n-pose, `nms=True`", "yolo11n-pose", {"nms": True}),
    Case("YOLO11n-cls", "yolo11n-cls"),
]


def varied(network, picture: Path) -> None:
    """Fresh weights score all places alike. These differ, and a few places of the picture reach the threshold."""
    import cv2
    import torch

    torch.manual_seed(0)
    head = network.model[-1]
    width = lambda module: getattr(module, "out_channels", getattr(module, "out_features", None))  # noqa: E731
    last = [module for module in head.modules() if width(module) and getattr(module, "bias", None) is not None]
    scoring = [module for module in last if width(module) == head.nc]
    bins = getattr(head, "reg_max", 1)
    for module in last if bins > 1 else []:
        if width(module) == 4 * bins:  # of a box's four distances: near ones, so that boxes are small
            module.bias.data = -0.5 * torch.arange(bins).repeat(4).float()
    scores = []
    for module in scoring:
        torch.nn.init.normal_(module.weight, 0, 4 / module.weight[0].numel() ** 0.5)
        torch.nn.init.normal_(module.bias, 0, 0.5)
        module.register_forward_hook(lambda _, __, out: scores.append(out.detach()))
    rgb = cv2.cvtColor(cv2.resize(cv2.imread(str(picture)), (SIDE_PX, SIDE_PX)), cv2.COLOR_BGR2RGB)
    image = torch.from_numpy(rgb).permute(2, 0, 1)[None] / 255.0
    network.eval()
    normalized = [module for module in network.modules() if isinstance(module, torch.nn.BatchNorm2d)]
    for module in normalized:  # to the picture itself, since differences fade in deep networks else
        module.momentum = 1.0
        module.train()
    with torch.no_grad():
        network(image)
        network.eval()
        scores.clear()
        network(image)
        best = torch.cat([(s.amax(1) if s.dim() == 4 else s.amax(2)).ravel() for s in scores])
        spread = SPREAD / best.std()
        for module in scoring:
            module.weight *= spread
            module.bias *= spread
            module.bias += torch.logit(torch.tensor(CONFIDENCE)) - spread * best.sort().values[-PLACES]
            module._forward_hooks.clear()


def export(case: Case, folder: Path, picture: Path) -> Path:
    file = folder / case.file
    if not file.exists():
        from ultralytics import RTDETR, YOLO

        model = (RTDETR if case.architecture.startswith("rtdetr") else YOLO)(f"{case.architecture}.yaml")
        if model.task != "classify":  # which scores no places
            varied(model.model, picture)
        with tempfile.TemporaryDirectory(dir=folder) as scratch:
            os.chdir(scratch)  # ultralytics writes where it is run
            made = Path(model.export(format="onnx", imgsz=SIDE_PX, simplify=True, **case.arguments)).resolve()
            made.replace(file)
            os.chdir(folder)
    return file


def reference(file: Path, picture: Path) -> list[tuple]:
    """(class, confidence, left, top, right, bottom) by ultralytics on ONNX Runtime."""
    from ultralytics import RTDETR, YOLO

    model = RTDETR(str(file)) if "rtdetr" in file.name else YOLO(str(file))
    options = {"conf": CONFIDENCE - MARGIN, "iou": OVERLAP, "imgsz": SIDE_PX, "verbose": False, "device": "cpu"}
    [result] = model.predict(str(picture), **options)
    found = result.obb if result.obb is not None else result.boxes
    size = result.orig_shape[::-1]
    boxes = zip(found.cls.tolist(), found.conf.tolist(), found.xyxy.tolist())
    inside = [clipped((int(class_id), score, *box), size) for class_id, score, box in boxes]
    return [box for box in inside if box[4] > box[2] and box[5] > box[3]]


def detected(line: str) -> list[tuple]:
    boxes = []
    for found in json.loads(line)["detections"]:
        left, top, width, height = found["box"]
        boxes.append((found["class_id"], found["confidence"], left, top, left + width, top + height))
    return boxes


def clipped(box: tuple, size: tuple[int, int]) -> tuple:
    return (*box[:2], *(min(max(edge, 0), limit) for edge, limit in zip(box[2:], (*size, *size))))


def farthest_px(ours: list[tuple], theirs: list[tuple], may_have_more: bool = False) -> float:
    """The largest difference of an edge over all boxes, each from the nearest of its class in the other list.

    ultralytics leaves boxes out that geoloc gives: of rotated ones those that overlap one that is itself left out, and
    those whose mask is empty.
    """
    def one_way(wanted, given):
        for box in wanted:
            if box[1] < CONFIDENCE + MARGIN:
                continue
            same = [other for other in given if other[0] == box[0]]
            yield min((max(abs(a - b) for a, b in zip(box[2:], other[2:])) for other in same), default=float("inf"))

    return max([*one_way(theirs, ours), *([] if may_have_more else one_way(ours, theirs))], default=float("nan"))


def agreement(ours: list[tuple], theirs: list[tuple], may_have_more: bool) -> str:
    farthest = farthest_px(ours, theirs, may_have_more)
    if farthest < SAME_PX:
        return f"{farthest:.3f} px"
    sure = [box for box in theirs if box[1] >= CONFIDENCE + MARGIN]
    same = sum(farthest_px(ours, [box], True) < SAME_PX for box in sure)
    return f"{same} of {len(sure)} boxes within {SAME_PX} px"


def noted(cell: str, notes: list[str]) -> str:
    """A refusal's number among the notes below the table, which get it where they lack it."""
    if not cell.startswith("refused: "):
        return cell
    words = cell.removeprefix("refused: ")
    words = words if len(words) <= MOST_LETTERS else words[:MOST_LETTERS].rsplit(" ", 1)[0] + " …"
    if words not in notes:
        notes.append(words)
    return f"refused ({notes.index(words) + 1})"


class Detect:
    def __init__(self, program: Path, picture: Path):
        self.program, self.picture = program, picture

    def run(self, file: Path, backend: str, options: tuple) -> tuple[str | None, str]:
        command = [self.program, self.picture, "--model", file, "--backend", backend, "--confidence", CONFIDENCE, "--json", "-"]
        done = subprocess.run([*map(str, [*command, *options])], capture_output=True, text=True)
        return (done.stdout, "") if done.returncode == 0 else (None, done.stderr.strip())

    def advised(self, file: Path, backend: str, options: tuple = ()) -> tuple[str | None, str]:
        """The same; a model that must be converted first is, as the words say. The words are then what was done."""
        line, words = self.run(file, backend, options)
        advice = re.search(r"onnx_for_opencv\.py ([^;,]*)", words)
        if line is not None or not advice:
            return line, words or "runs"
        converted = file.with_name(file.stem + "_opencv.onnx")
        sizes = shlex.split(advice[1].replace("WIDTH HEIGHT", f"{SIDE_PX} {SIDE_PX}"))[2:]
        command = [sys.executable, TOOLS / "onnx_for_opencv.py", file, converted, *sizes]
        done = subprocess.run([*map(str, command)], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{file.name}: its advice fails: {words}\n{done.stderr}")
        line, words = self.run(converted, backend, ())
        converted.unlink()
        if line is None:
            raise SystemExit(f"{file.name}: after conversion: {words}")
        return line, "runs converted"

    def judged(self, file: Path, theirs: list[tuple], backend: str, options: tuple) -> str:
        line, words = self.advised(file, backend, options)
        if line is not None:
            may_have_more = "-obb" in file.name or "-seg" in file.name
            return f"{words}, {agreement(detected(line), theirs, may_have_more)}"
        return "refused: " + re.sub(r"^geoloc_detect: (\S+\.onnx: )?", "", words).replace(f"{file.parent}/", "")


def noise(file: Path) -> Path:
    """A picture in which no two places look alike, so that no two scores are the same."""
    import cv2
    import numpy as np

    generator = np.random.default_rng(0)
    coarse = cv2.resize(generator.random((SIDE_PX // 16, SIDE_PX // 16, 3)), (SIDE_PX, SIDE_PX), interpolation=cv2.INTER_CUBIC)
    cv2.imwrite(str(file), np.clip(200 * coarse + 50 * generator.random(coarse.shape), 0, 255).astype(np.uint8))
    return file


def print_table(folder: Path, program: Path) -> None:
    detect = Detect(program, noise(folder / "noise.png"))
    print("| export | OpenCV | OpenVINO | boxes |\n|---|---|---|---|")
    notes = []
    for case in CASES:
        file = export(case, folder, detect.picture)
        can_be_run = not case.architecture.endswith("-cls") and "batch" not in case.arguments
        theirs = reference(file, detect.picture) if can_be_run else []
        judged = [noted(detect.judged(file, theirs, backend, case.options), notes) for backend in BACKENDS]
        print(f"| {case.words} | {judged[0]} | {judged[1]} | {len(theirs)} |", flush=True)
    print("\n" + "\n".join(f"{number}. {words}" for number, words in enumerate(notes, 1)))


def print_comparison(model: Path, folder: Path, program: Path) -> None:
    pictures = sorted(file for file in folder.iterdir() if file.suffix.lower() in (".jpg", ".png"))
    theirs = {picture: reference(model, picture) for picture in pictures}
    for backend in BACKENDS:
        line, words = Detect(program, folder).advised(model, backend)
        if line is None:
            raise SystemExit(words)
        ours = {Path(json.loads(one)["image"]).resolve(): detected(one) for one in line.splitlines()}
        differences = [farthest_px(ours[picture.resolve()], boxes) for picture, boxes in theirs.items()]
        farthest = max(difference for difference in differences if difference == difference)  # NaN: nothing to compare
        counts = sum(map(len, ours.values())), sum(len([b for b in boxes if b[1] >= CONFIDENCE]) for boxes in theirs.values())
        print(f"{backend} {words}: {len(pictures)} pictures, {counts[0]} boxes (ultralytics: {counts[1]}), at most {farthest:.4f} px apart")


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("geoloc_detect", type=Path)
    arguments.add_argument("folder", type=Path, help="for the exports, or of the pictures")
    arguments.add_argument("--weights", type=Path, metavar="FILE", help="a model to compare on a folder of pictures")
    options = arguments.parse_args()
    program = options.geoloc_detect.resolve()
    if options.weights:
        print_comparison(options.weights.resolve(), options.folder.resolve(), program)
    else:
        print_table(options.folder.resolve(), program)


if __name__ == "__main__":
    main()
