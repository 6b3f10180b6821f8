# SPDX-License-Identifier: Apache-2.0
"""Training of both networks."""

import copy
import math
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import torch
from torch import nn
from tqdm import tqdm

WARM_UP_STEPS = 100
AVERAGE_DECAY = 0.998  # the exported weights are a running mean over the last few hundred steps
LARGEST_GRADIENT = 10.0


def rate_at(peak: float, step: int, steps: int) -> float:
    """Cosine decay after a linear start."""
    return (
        peak * min(1.0, (step + 1) / WARM_UP_STEPS) * 0.5 * (1.0 + math.cos(math.pi * step / steps))
        + 1e-5
    )


def ahead(make: Callable[[int], Any], count: int) -> Iterator[Any]:
    """make(0), make(1), ... in order, each made while the previous one is in use."""
    with ThreadPoolExecutor(1) as executor:
        following = executor.submit(make, 0)
        for index in range(count):
            current = following.result()
            if index + 1 < count:
                following = executor.submit(make, index + 1)
            yield current


class Run:
    """A training run that can be resumed after every epoch: everything in its checkpoint."""

    def __init__(self, model: nn.Module, peak_rate: float, epochs: int, batches: int, seed: int, bfloat16: bool):
        self.model, self.peak_rate, self.epochs, self.batches = model, peak_rate, epochs, batches
        self.seed, self.bfloat16, self.epoch = seed, bfloat16, 0
        self.average = copy.deepcopy(model)
        self.optimizer = torch.optim.AdamW(model.parameters(), peak_rate, weight_decay=5e-4)

    def save(self, file: Path) -> None:
        state = {name: getattr(self, name).state_dict() for name in ("model", "average", "optimizer")}
        part = file.with_suffix(".partial")
        torch.save(state | {"epoch": self.epoch, "epochs": self.epochs, "seed": self.seed}, part)
        part.replace(file)

    def restore(self, file: Path) -> None:
        state = torch.load(file, weights_only=False)
        if (state["epochs"], state["seed"]) != (self.epochs, self.seed):
            raise SystemExit(
                f"{file} belongs to a run with other --epochs or --seed; remove it to start anew"
            )
        for name in ("model", "average", "optimizer"):
            getattr(self, name).load_state_dict(state[name])
        self.epoch = state["epoch"]

    def run_epoch(self, batch_of: Callable[[int], Any], loss_of: Callable[[Any], torch.Tensor]) -> None:
        """One step per batch; loss_of() runs the model in bfloat16 if requested."""
        self.model.train()
        progress = tqdm(range(self.batches), desc=f"epoch {self.epoch + 1}/{self.epochs}", mininterval=2.0)
        for index, batch in zip(progress, ahead(batch_of, self.batches)):
            step = self.epoch * self.batches + index
            for group in self.optimizer.param_groups:
                group["lr"] = rate_at(self.peak_rate, step, self.epochs * self.batches)
            loss = loss_of(batch)
            self.optimizer.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_(self.model.parameters(), LARGEST_GRADIENT)
            self.optimizer.step()
            self._update_average(step)
            progress.set_postfix(loss=f"{loss.item():.3f}", refresh=False)
        self.epoch += 1

    def _update_average(self, step: int) -> None:
        decay = min(AVERAGE_DECAY, (step + 1) / (step + 10))
        with torch.no_grad():
            for mean, value in zip(self.average.state_dict().values(), self.model.state_dict().values()):
                if mean.is_floating_point():
                    mean.mul_(decay).add_(value, alpha=1.0 - decay)
                else:
                    mean.copy_(value)
