# SPDX-License-Identifier: Apache-2.0
"""The network that looks again, and closer, at each box that the detector proposes."""

import torch
from torch import nn

from model import convolution
from patches import PATCH_PX

WIDTHS = (16, 40, 80)  # channels at a half, a quarter and an eighth of the patch
SUMMARY = 64
ANSWERS = 6  # score, off-centre x, y, width, height, sigma of the centre


class Block(nn.Module):
    """Two 3x3 convolutions, added to their input."""

    def __init__(self, channels: int):
        super().__init__()
        self.path = nn.Sequential(
            convolution(channels, channels, 3),
            nn.Conv2d(channels, channels, 3, 1, 1, bias=False),
            nn.BatchNorm2d(channels),
        )

    def forward(self, features: torch.Tensor) -> torch.Tensor:
        return torch.relu(features + self.path(features))


class SecondLook(nn.Module):
    """Patches [B, 3, 48, 48] as patches.normalised() makes them to [B, 6]: the score (a logit); the offset of the centre
    from that of the patch, in its sides; the logarithms of width, height and of the centre's sigma, in the same unit."""

    def __init__(self) -> None:
        super().__init__()
        layers: list[nn.Module] = []
        inputs = 3
        for width in WIDTHS:
            layers += [convolution(inputs, width, 3, 2), Block(width)]
            inputs = width
        coarsest = PATCH_PX // 2 ** len(WIDTHS)
        self.features = nn.Sequential(*layers, convolution(inputs, 24, 1))
        self.answer = nn.Sequential(
            nn.Flatten(),
            nn.Linear(24 * coarsest * coarsest, SUMMARY),
            nn.ReLU(inplace=True),
            nn.Linear(SUMMARY, ANSWERS),
        )

    def forward(self, patches: torch.Tensor) -> torch.Tensor:
        return self.answer(self.features(patches))
