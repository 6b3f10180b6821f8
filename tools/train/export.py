# SPDX-License-Identifier: Apache-2.0
"""Writes the networks as ONNX, the detector in YOLO11's output layout, using only what OpenCV 4.6 can run."""

import copy
import math
from pathlib import Path

import onnx
import torch
from torch import nn

from dataset import INPUT_HEIGHT, INPUT_WIDTH
from model import TargetDetector, cells
from patches import PATCH_PX
from second_look_model import SecondLook

OPSET = 12
PATCHES_AT_ONCE = 8
CLASS_NAMES = {0: "target"}


class ExportedDetector(nn.Module):
    """Images [1, 3, H, W] in 0..1 to [1, 5, N]: centre x, y, width, height in input pixels, score in 0..1."""

    def __init__(self, detector: TargetDetector):
        super().__init__()
        self.detector = detector
        centres, strides = cells(INPUT_HEIGHT, INPUT_WIDTH)
        # OpenCV 4.6 does not broadcast constants, so each has the full shape of the other operand.
        self.register_buffer("centres", centres[None].contiguous())
        self.register_buffer("strides", strides[None, None].repeat(1, 2, 1).contiguous())

    def forward(self, images: torch.Tensor) -> torch.Tensor:
        boxes, scores = self.detector(images)
        centre = self.centres + boxes[:, 0:2] * self.strides
        size = torch.exp(boxes[:, 2:4]) * self.strides
        return torch.cat((centre, size, scores.sigmoid()), 1)


class ExportedSecondLook(nn.Module):
    """Patches [B, 3, 48, 48] to [B, 6]: score in 0..1; off-centre x and y, width, height, sigma in sides of the patch."""

    def __init__(self, model: SecondLook, sigma_factor: float):
        super().__init__()
        self.model = copy.deepcopy(model)
        with torch.no_grad():
            self.model.answer[-1].bias[5] += math.log(sigma_factor)

    def forward(self, patches: torch.Tensor) -> torch.Tensor:
        answers = self.model(patches)
        return torch.cat((answers[:, 0:1].sigmoid(), answers[:, 1:3], torch.exp(answers[:, 3:6])), 1)


def inline_identities(graph: onnx.GraphProto) -> None:
    """torch names equal constants twice through Identity nodes, which OpenCV 4.6 cannot read."""
    identities = [node for node in graph.node if node.op_type == "Identity"]
    original = {node.output[0]: node.input[0] for node in identities}
    for node in identities:
        graph.node.remove(node)
    for node in graph.node:
        for index, name in enumerate(node.input):
            node.input[index] = original.get(name, name)


def add_metadata(model: onnx.ModelProto, entries: dict[str, str]) -> None:
    for key, value in entries.items():
        entry = model.metadata_props.add()
        entry.key, entry.value = key, value


def write(module: nn.Module, example: torch.Tensor, names: tuple[str, str], file: Path, metadata: dict[str, str]) -> None:
    """names: of the input and of the output."""
    part = file.with_suffix(".partial")
    torch.onnx.export(
        module.eval(),
        example,
        str(part),
        opset_version=OPSET,
        input_names=[names[0]],
        output_names=[names[1]],
        dynamo=False,
    )
    model = onnx.load(str(part))
    inline_identities(model.graph)
    add_metadata(model, metadata)
    onnx.checker.check_model(model)
    onnx.save(model, str(part))
    part.replace(file)


def export(detector: TargetDetector, file: Path, centre_sigma_px: tuple[float, float] | None) -> None:
    """centre_sigma_px: a, b of the per-axis sigma hypot(a, b * square root of the box's area), in input pixels."""
    metadata = {"names": str(CLASS_NAMES), "geoloc_second_look": second_look_file(file).name}
    if centre_sigma_px:
        metadata["geoloc_centre_sigma_px"] = ",".join(f"{value:.4f}" for value in centre_sigma_px)
    images = torch.zeros(1, 3, INPUT_HEIGHT, INPUT_WIDTH)
    write(ExportedDetector(detector), images, ("images", "output0"), file, metadata)


def second_look_file(detector: Path) -> Path:
    return detector.with_name(f"{detector.stem}_second_look.onnx")


def export_second_look(model: SecondLook, file: Path, sigma_factor: float) -> None:
    patches = torch.zeros(PATCHES_AT_ONCE, 3, PATCH_PX, PATCH_PX)
    write(ExportedSecondLook(model, sigma_factor), patches, ("patches", "answers"), file, {})
