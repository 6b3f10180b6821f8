# SPDX-License-Identifier: Apache-2.0
"""A small one-stage detector for one class of small objects, fast on a CPU.

Two grids of predictors, one every 8 and one every 16 input pixels. Each predicts, of the object whose centre
is nearest: the centre's offset and the logarithm of width and height, both in units of the grid's
stride, and a score that is trained to follow the IoU of that very box.
"""

import torch
from torch import nn

STRIDES = (8, 16)
BOX_VALUES = 4  # dx, dy, log width, log height


def convolution(inputs: int, outputs: int, kernel: int, stride: int = 1) -> nn.Sequential:
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, kernel, stride, kernel // 2, bias=False),
        nn.BatchNorm2d(outputs),
        nn.ReLU(inplace=True),
    )


class Residual(nn.Module):
    """A bottleneck: half the channels, 3x3 back to all of them, added to the input."""

    def __init__(self, channels: int):
        super().__init__()
        self.path = nn.Sequential(
            convolution(channels, channels // 2, 1), convolution(channels // 2, channels, 3)
        )

    def forward(self, features: torch.Tensor) -> torch.Tensor:
        return features + self.path(features)


class TargetDetector(nn.Module):
    """Images [B, 3, H, W] in 0..1 (H, W multiples of 16) to boxes [B, 4, N] and scores [B, 1, N] (logits),
    N = cells of the stride-8 grid, row by row, then those of the stride-16 grid."""

    def __init__(self, neck: int = 48):
        super().__init__()
        self.to_stride_8 = nn.Sequential(
            convolution(3, 12, 3, 2),
            convolution(12, 24, 3, 2),
            Residual(24),
            convolution(24, 48, 3, 2),
            Residual(48),
            Residual(48),
        )
        self.to_stride_16 = nn.Sequential(convolution(48, 80, 3, 2), Residual(80), Residual(80), Residual(80))
        self.lateral_8 = convolution(48, neck, 1)
        self.lateral_16 = convolution(80, neck, 1)
        self.enlarge = nn.Upsample(scale_factor=2, mode="nearest")
        self.refine = nn.ModuleList(Residual(neck) for _ in STRIDES)
        self.box = nn.ModuleList(nn.Conv2d(neck, BOX_VALUES, 1) for _ in STRIDES)
        self.score = nn.ModuleList(nn.Conv2d(neck, 1, 1) for _ in STRIDES)
        for score in self.score:
            nn.init.constant_(score.bias, -5.0)  # nearly every cell is background

    def forward(self, images: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        stride_8 = self.to_stride_8(images)
        stride_16 = self.lateral_16(self.to_stride_16(stride_8))
        stride_8 = self.lateral_8(stride_8) + self.enlarge(stride_16)
        levels = [refine(level) for refine, level in zip(self.refine, (stride_8, stride_16))]
        boxes = torch.cat([box(level).flatten(2) for box, level in zip(self.box, levels)], 2)
        scores = torch.cat([score(level).flatten(2) for score, level in zip(self.score, levels)], 2)
        return boxes, scores


def cells(height: int, width: int) -> tuple[torch.Tensor, torch.Tensor]:
    """Centres [2, N] (x, y) and strides [N] of all predictors, in input pixels from the image's edge."""
    centres, strides = [], []
    for stride in STRIDES:
        y, x = torch.meshgrid(torch.arange(height // stride), torch.arange(width // stride), indexing="ij")
        centres.append((torch.stack((x, y)).flatten(1) + 0.5) * stride)
        strides.append(torch.full((centres[-1].shape[1],), float(stride)))
    return torch.cat(centres, 1), torch.cat(strides)


def decode(boxes: torch.Tensor, centres: torch.Tensor, strides: torch.Tensor) -> torch.Tensor:
    """Raw boxes [B, 4, N] to centre x, y, width, height in input pixels."""
    centre = centres + boxes[:, :2] * strides
    size = torch.exp(boxes[:, 2:].clamp(max=5.0)) * strides
    return torch.cat((centre, size), 1)
