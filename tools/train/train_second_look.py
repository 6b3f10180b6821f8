# SPDX-License-Identifier: Apache-2.0
"""Trains the second-look network on what the detector proposes, from scratch, on a CPU."""

import argparse
import math
from pathlib import Path

import numpy as np
import torch
from torch.nn import functional
from tqdm import tqdm

from dataset import Example, load
from export import export_second_look
from looks import Looks, collect, proposed, training_looks
from onnx_model import load_network
from optimisation import Run, ahead
from patches import PATCH_PX
from second_look_model import SecondLook

BATCH = 256
BATCHES_AN_EPOCH = 200
PEAK_RATE = 3e-3
SIZE_WEIGHT = 0.3  # a score and a centre, in pixels of the patch, cost 1
SIGMA_STEPS, SIGMA_RATE = 150, 1e-2
USUAL_SIGMA = 0.01  # of the side of a patch: the initial value
VALIDATION_LOOKS = 4096


def loss_of(answers: torch.Tensor, is_target: torch.Tensor, truth: torch.Tensor) -> torch.Tensor:
    score = functional.binary_cross_entropy_with_logits(answers[:, 0], is_target)
    shown, there = answers[is_target > 0], truth[is_target > 0]
    centre = functional.smooth_l1_loss(shown[:, 1:3] * PATCH_PX, there[:, :2] * PATCH_PX, beta=0.5)
    size = functional.smooth_l1_loss(shown[:, 3:5], there[:, 2:].log(), beta=0.1)
    return score + centre + SIZE_WEIGHT * size


def train_epoch(run: Run, looks: Looks, examples: list[Example]) -> None:
    random = np.random.default_rng((run.seed, run.epoch))

    def batch_of(_: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return training_looks(looks, examples, BATCH, random)

    def loss_of_batch(batch: tuple[np.ndarray, np.ndarray, np.ndarray]) -> torch.Tensor:
        patches, is_target, truth = (torch.from_numpy(values) for values in batch)
        with torch.autocast("cpu", torch.bfloat16, enabled=run.bfloat16):
            answers = run.model(patches)
        return loss_of(answers.float(), is_target, truth)

    run.run_epoch(batch_of, loss_of_batch)


def learn_sigma(model: SecondLook, looks: Looks, examples: list[Example], seed: int) -> None:
    """Trains the sigma last, from the errors of the finished network, so that stating errors does not cause any."""
    random = np.random.default_rng((seed, SIGMA_STEPS))
    weight = torch.zeros(model.answer[-1].in_features, requires_grad=True)
    bias = torch.tensor(math.log(USUAL_SIGMA), requires_grad=True)
    optimizer = torch.optim.Adam([weight, bias], SIGMA_RATE)
    for _, batch in zip(
        tqdm(range(SIGMA_STEPS), desc="sigma", mininterval=2.0),
        ahead(lambda _: training_looks(looks, examples, BATCH, random), SIGMA_STEPS),
    ):
        patches, is_target, truth = (torch.from_numpy(values) for values in batch)
        with torch.no_grad():
            summary = model.answer[:-1](model.features(patches[is_target > 0]))
            off_centre = model.answer[-1](summary)[:, 1:3] - truth[is_target > 0, :2]
        log_sigma = (summary @ weight + bias)[:, None]
        surprise = (off_centre.abs() / log_sigma.exp() + log_sigma).mean()  # of a Laplace density: some are far off
        optimizer.zero_grad()
        surprise.backward()
        optimizer.step()
    with torch.no_grad():
        model.answer[-1].weight[5], model.answer[-1].bias[5] = weight, bias


def answers_to(model: SecondLook, looks: Looks, examples: list[Example]) -> tuple[np.ndarray, ...]:
    """For the same patches every time: answers [K, 6], whether each shows a target [K], and where it is [K, 4]."""
    patches, is_target, truth = training_looks(
        looks, examples, VALIDATION_LOOKS, np.random.default_rng(0)
    )
    with torch.no_grad():
        answers = torch.cat([model.eval()(part) for part in torch.from_numpy(patches).split(BATCH)])
    return answers.numpy(), is_target > 0, truth


def report(answers: np.ndarray, is_target: np.ndarray, truth: np.ndarray) -> str:
    is_found = answers[:, 0] > 0.0
    recall, precision = is_found[is_target].mean(), is_target[is_found].mean()
    off = (answers[is_target, 1:3] - truth[is_target, :2]) * PATCH_PX
    deviation = 1.4826 * np.median(np.abs(off))
    return f"  at 0.5: recall {recall:.4f}, precision {precision:.4f}; centres {deviation:.2f} px of a patch"


def sigma_factor(answers: np.ndarray, is_target: np.ndarray, truth: np.ndarray) -> float:
    """The median ratio of actual to stated errors on unseen targets."""
    off = answers[is_target, 1:3] - truth[is_target, :2]
    return float(1.4826 * np.median(np.abs(off) / np.exp(answers[is_target, 5:])))


def parse_arguments() -> argparse.Namespace:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--detector", type=Path, required=True, help="the .onnx that proposes")
    arguments.add_argument(
        "--train", type=Path, nargs="+", required=True, help="folders of geoloc_sim --images"
    )
    arguments.add_argument("--validation", type=Path, required=True, help="the same with another seed")
    arguments.add_argument(
        "--out", type=Path, required=True, help="the .onnx to write; the checkpoint stands beside it"
    )
    arguments.add_argument("--epochs", type=int, default=30)
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--threads", type=int, default=2)
    arguments.add_argument("--bfloat16", action="store_true", help="faster where the processor has avx512_bf16")
    return arguments.parse_args()


def main() -> None:
    options = parse_arguments()
    torch.set_num_threads(options.threads)
    torch.manual_seed(options.seed)
    detector = load_network(options.detector, options.threads)
    examples = [example for folder in options.train for example in load(folder)]
    validation = load(options.validation)
    looks = collect(examples, proposed(detector, examples))
    unseen = collect(validation, proposed(detector, validation))
    print(f"{len(looks.targets)} targets, {len(looks.mined)} other proposals, {len(looks.look_alikes)} look-alikes")
    run = Run(SecondLook(), PEAK_RATE, options.epochs, BATCHES_AN_EPOCH, options.seed, options.bfloat16)
    checkpoint = options.out.with_suffix(".checkpoint")
    if checkpoint.exists():
        run.restore(checkpoint)
    while run.epoch < options.epochs:
        train_epoch(run, looks, examples)
        run.save(checkpoint)
        print(report(*answers_to(run.average, unseen, validation)), flush=True)
    learn_sigma(run.average.eval(), looks, examples, options.seed)
    factor = sigma_factor(*answers_to(run.average, unseen, validation))
    export_second_look(run.average, options.out, factor)
    print(f"{options.out}: {options.out.stat().st_size / 1e6:.2f} MB; sigma times {factor:.2f}")


if __name__ == "__main__":
    main()
