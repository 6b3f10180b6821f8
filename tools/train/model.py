# SPDX-License-Identifier: Apache-2.0
"""A small one-stage detector for one class of small objects, fast on a CPU.

It reads a whole 1280 x 720 image: the first convolution reduces it to a quarter at once, which costs little more than
halving the image beforehand and loses nothing. There are two grids of predictors, one every 8 and one every 16 input
pixels. Each predicts for the object with the nearest centre: the centre's offset and the logarithm of width and height,
both in units of the grid's stride, and a score that is trained to follow the IoU of that very box.
"""

import torch
from torch import nn

STRIDES = (8, 16)
BOX_VALUES = 4  # dx, dy, log width, log height
COARSEST_STRIDE = 32  # of the features; an image's height and width must be multiples of it
LARGEST_LOG_SIZE = 5.0  # keeps exp() finite early in training


def convolution(inputs: int, outputs: int, kernel: int, stride: int = 1) -> nn.Sequential:
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, kernel, stride, (kernel - stride + 1) // 2, bias=False),
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
    """Images [B, 3, H, W] in 0..1 (H, W multiples of 32) to boxes [B, 4, N] and scores [B, 1, N] (logits),
    N = cells of the stride-8 grid, row by row, then those of the stride-16 grid."""

    def __init__(self) -> None:
        super().__init__()
        fine, middle, coarse = 32, 48, 80  # channels at strides 8, 16, 32
        self.to_stride_8 = nn.Sequential(
            convolution(3, 16, 4, 4), convolution(16, fine, 3, 2), Residual(fine), Residual(fine)
        )
        self.to_stride_16 = nn.Sequential(convolution(fine, middle, 3, 2), Residual(middle), Residual(middle))
        self.to_stride_32 = nn.Sequential(
            convolution(middle, coarse, 3, 2), Residual(coarse), Residual(coarse), Residual(coarse)
        )
        self.enlarge = nn.Upsample(scale_factor=2, mode="nearest")
        self.lateral_32 = convolution(coarse, middle, 1)
        self.lateral_16 = convolution(middle, middle, 1)
        self.refine_16 = Residual(middle)
        self.to_fine = convolution(middle, fine, 1)
        self.lateral_8 = convolution(fine, fine, 1)
        self.refine_8 = Residual(fine)
        self.box = nn.ModuleList(nn.Conv2d(channels, BOX_VALUES, 1) for channels in (fine, middle))
        self.score = nn.ModuleList(nn.Conv2d(channels, 1, 1) for channels in (fine, middle))
        for score in self.score:
            nn.init.constant_(score.bias, -5.0)  # nearly every cell is background

    def forward(self, images: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        stride_8 = self.to_stride_8(images)
        stride_16 = self.to_stride_16(stride_8)
        stride_32 = self.lateral_32(self.to_stride_32(stride_16))
        stride_16 = self.refine_16(self.lateral_16(stride_16) + self.enlarge(stride_32))
        stride_8 = self.refine_8(self.lateral_8(stride_8) + self.enlarge(self.to_fine(stride_16)))
        levels = (stride_8, stride_16)
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
    size = torch.exp(boxes[:, 2:].clamp(max=LARGEST_LOG_SIZE)) * strides
    return torch.cat((centre, size), 1)
