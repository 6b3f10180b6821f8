# SPDX-License-Identifier: Apache-2.0
"""Writes the detector as ONNX in YOLO11's output layout, with nothing in it that OpenCV 4.6 cannot run."""

from pathlib import Path

import onnx
import torch
from torch import nn

from dataset import INPUT_HEIGHT, INPUT_WIDTH
from model import TargetDetector, cells

OPSET = 12
CLASS_NAMES = {0: "target"}


class Exported(nn.Module):
    """Images [1, 3, H, W] in 0..1 to [1, 5, N]: centre x, y, width, height in input pixels, score in 0..1."""

    def __init__(self, detector: TargetDetector):
        super().__init__()
        self.detector = detector
        centres, strides = cells(INPUT_HEIGHT, INPUT_WIDTH)
        # OpenCV 4.6 does not broadcast constants: each has the full shape of what it meets.
        self.register_buffer("centres", centres[None].contiguous())
        self.register_buffer("strides", strides[None, None].repeat(1, 2, 1).contiguous())

    def forward(self, images: torch.Tensor) -> torch.Tensor:
        boxes, scores = self.detector(images)
        centre = self.centres + boxes[:, 0:2] * self.strides
        size = torch.exp(boxes[:, 2:4]) * self.strides
        return torch.cat((centre, size, scores.sigmoid()), 1)


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


def export(detector: TargetDetector, file: Path, centre_sigma_px: tuple[float, float] | None) -> None:
    """centre_sigma_px: a, b of sigma = hypot(a, b * root of the box's area), an axis, in input pixels."""
    exported = Exported(detector).eval()
    images = torch.zeros(1, 3, INPUT_HEIGHT, INPUT_WIDTH)
    part = file.with_suffix(".partial")
    torch.onnx.export(
        exported,
        images,
        str(part),
        opset_version=OPSET,
        input_names=["images"],
        output_names=["output0"],
        dynamo=False,
    )
    model = onnx.load(str(part))
    inline_identities(model.graph)
    add_metadata(model, {"names": str(CLASS_NAMES)})
    if centre_sigma_px:
        sigma = ",".join(f"{value:.4f}" for value in centre_sigma_px)
        add_metadata(model, {"geoloc_centre_sigma_px": sigma})
    onnx.checker.check_model(model)
    onnx.save(model, str(part))
    part.replace(file)
