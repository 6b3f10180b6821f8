# SPDX-License-Identifier: Apache-2.0
"""Trains the target detector on pictures of `geoloc_sim --images`, from scratch, on a CPU."""

import argparse
import copy
import math
from pathlib import Path

import numpy as np
import torch
from tqdm import tqdm

from dataset import Example, load, training_batch
from evaluate import evaluate
from export import export
from loss import detection_loss
from model import TargetDetector, cells, decode

CROP_PX = 160
BATCH = 32
PEAK_RATE = 3e-3
WARM_UP_STEPS = 100
THRESHOLDS = (0.25, 0.4, 0.55, 0.7)  # of confidence, at which the model is judged
AVERAGE_DECAY = 0.998  # the exported weights are a running mean over the last few hundred steps


def rate_at(step: int, steps: int) -> float:
    """Cosine decay after a linear start."""
    return (
        PEAK_RATE * min(1.0, (step + 1) / WARM_UP_STEPS) * 0.5 * (1.0 + math.cos(math.pi * step / steps))
        + 1e-5
    )


def update_average(average: TargetDetector, model: TargetDetector, step: int) -> None:
    decay = min(AVERAGE_DECAY, (step + 1) / (step + 10))
    with torch.no_grad():
        for mean, value in zip(average.state_dict().values(), model.state_dict().values()):
            if mean.is_floating_point():
                mean.mul_(decay).add_(value, alpha=1.0 - decay)
            else:
                mean.copy_(value)


class Training:
    """The state of a run: everything that a checkpoint holds."""

    def __init__(self, epochs: int, seed: int, bfloat16: bool):
        torch.manual_seed(seed)
        self.epochs, self.seed, self.epoch, self.bfloat16 = epochs, seed, 0, bfloat16
        self.model = TargetDetector()
        self.average = copy.deepcopy(self.model)
        self.optimizer = torch.optim.AdamW(self.model.parameters(), PEAK_RATE, weight_decay=5e-4)

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

    def run_epoch(self, examples: list[Example]) -> None:
        random = np.random.default_rng((self.seed, self.epoch))
        order = random.permutation(len(examples))
        batches = len(order) // BATCH
        centres, strides = cells(CROP_PX, CROP_PX)
        self.model.train()
        progress = tqdm(range(batches), desc=f"epoch {self.epoch + 1}/{self.epochs}", mininterval=2.0)
        for batch in progress:
            step = self.epoch * batches + batch
            for group in self.optimizer.param_groups:
                group["lr"] = rate_at(step, self.epochs * batches)
            chosen = [examples[i] for i in order[batch * BATCH : (batch + 1) * BATCH]]
            images, targets = training_batch(chosen, CROP_PX, random)
            with torch.autocast("cpu", torch.bfloat16, enabled=self.bfloat16):
                boxes, scores = self.model(torch.from_numpy(images))
            decoded = decode(boxes.float(), centres, strides)
            loss = detection_loss(
                decoded, scores.float(), [torch.from_numpy(t) for t in targets], centres, strides
            )
            self.optimizer.zero_grad()
            loss.backward()
            torch.nn.utils.clip_grad_norm_(self.model.parameters(), 10.0)
            self.optimizer.step()
            update_average(self.average, self.model, step)
            progress.set_postfix(loss=f"{loss.item():.3f}", refresh=False)
        self.epoch += 1


def parse_arguments() -> argparse.Namespace:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--train", type=Path, required=True, help="folder of geoloc_sim --images")
    arguments.add_argument(
        "--held-back", type=Path, required=True, help="the same with another seed, for judging"
    )
    arguments.add_argument(
        "--out", type=Path, required=True, help="the .onnx to write; the checkpoint stands beside it"
    )
    arguments.add_argument("--epochs", type=int, default=24)
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--threads", type=int, default=2)
    arguments.add_argument(
        "--bfloat16", action="store_true", help="faster on processors that have it (avx512_bf16)"
    )
    arguments.add_argument("--judge-every", type=int, default=5, help="epochs between two judgements")
    return arguments.parse_args()


def main() -> None:
    options = parse_arguments()
    torch.set_num_threads(options.threads)
    training = Training(options.epochs, options.seed, options.bfloat16)
    checkpoint = options.out.with_suffix(".checkpoint")
    if checkpoint.exists():
        training.restore(checkpoint)
    examples, held_back = load(options.train), load(options.held_back)
    while training.epoch < options.epochs:
        training.run_epoch(examples)
        training.save(checkpoint)
        if training.epoch % options.judge_every == 0 or training.epoch == options.epochs:
            for threshold, quality in zip(THRESHOLDS, evaluate(training.average, held_back, THRESHOLDS)):
                print(f"  at {threshold}: {quality}", flush=True)
    export(training.average.eval(), options.out)
    print(f"{options.out}: {options.out.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
