# SPDX-License-Identifier: Apache-2.0
"""Stone Soup as a tracker of static objects: global nearest neighbour, one 2-D Kalman filter per object."""

import time
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime, timedelta

import numpy as np
from stonesoup.base import Property
from stonesoup.dataassociator.neighbour import GNNWith2DAssignment
from stonesoup.deleter.base import Deleter
from stonesoup.deleter.time import UpdateTimeDeleter
from stonesoup.hypothesiser.distance import DistanceHypothesiser
from stonesoup.initiator.simple import MultiMeasurementInitiator
from stonesoup.measures import Mahalanobis
from stonesoup.models.measurement.linear import LinearGaussian
from stonesoup.models.transition.linear import (
    CombinedLinearGaussianTransitionModel,
    LinearGaussianTimeInvariantTransitionModel,
    RandomWalk,
)
from stonesoup.predictor.kalman import KalmanPredictor
from stonesoup.tracker.simple import MultiTargetTracker
from stonesoup.types.detection import Detection
from stonesoup.types.state import GaussianState
from stonesoup.updater.kalman import KalmanUpdater


@dataclass(frozen=True)
class TrackerSettings:
    noise_m: float  # per-axis 1-sigma of a fix
    gate: float  # Mahalanobis distance, 1
    confirm_hits: int  # fixes that confirm a tentative object
    hold_s: float  # a tentative object without a fix for this long is dropped
    drift_m: float  # random walk of an object in one second, per-axis 1-sigma


class Never(Deleter):
    """Static objects stay where they are: one that is out of sight is not deleted."""

    def check_for_deletion(self, track, **kwargs):
        return False


class NearbyGNN(GNNWith2DAssignment):
    """The same associations in less time: tracks whose gate no fix can reach are left as they are."""

    noise_m: float = Property(doc="per-axis 1-sigma of a fix [m]")
    drift_m: float = Property(doc="per-axis 1-sigma of the random walk in one second [m]")
    gate: float = Property(doc="Mahalanobis distance")

    def generate_hypotheses(self, tracks, detections, timestamp, **kwargs):
        if not tracks or not detections:
            return {}
        tracks = list(tracks)
        fixes = np.array([detection.state_vector[:, 0] for detection in detections], dtype=float)
        means = np.array([track.state_vector[:, 0] for track in tracks], dtype=float)
        age_s = np.array([(timestamp - track.timestamp).total_seconds() for track in tracks])
        variance = np.array([track.covar[0, 0] for track in tracks]) + self.drift_m**2 * age_s + self.noise_m**2
        nearest_m = np.sqrt(((means[:, None] - fixes[None]) ** 2).sum(axis=2).min(axis=1))
        near = nearest_m <= self.gate * np.sqrt(variance) * (1 + 1e-9)
        close = {track for track, is_near in zip(tracks, near) if is_near}
        return super().generate_hypotheses(close, detections, timestamp, **kwargs)


def track_objects(
    times: Iterable[datetime], frames: Iterable[np.ndarray], settings: TrackerSettings
) -> tuple[np.ndarray, float]:
    """Confirmed objects (n, 2) after the last frame, east and north [m], and the CPU time it took [s].

    A frame is its fixes (k, 2) [m], none included."""
    detections = [
        (time_, {Detection(fix.reshape(2, 1), timestamp=time_) for fix in frame}) for time_, frame in zip(times, frames)
    ]
    begin = time.process_time()
    tracker = make_tracker(detections, settings)
    tracks = set()
    for _, tracks in tracker:
        pass
    spent_s = time.process_time() - begin
    return np.array([track.state_vector[:, 0] for track in tracks], dtype=float).reshape(-1, 2), spent_s


def make_tracker(detections: list[tuple[datetime, set[Detection]]], settings: TrackerSettings) -> MultiTargetTracker:
    model = LinearGaussian(ndim_state=2, mapping=(0, 1), noise_covar=settings.noise_m**2 * np.eye(2))
    if settings.drift_m > 0:
        motion = CombinedLinearGaussianTransitionModel([RandomWalk(settings.drift_m**2)] * 2)
    else:  # a third faster
        motion = LinearGaussianTimeInvariantTransitionModel(
            transition_matrix=np.eye(2), covariance_matrix=np.zeros((2, 2))
        )
    predictor = KalmanPredictor(motion)
    updater = KalmanUpdater(model)
    hypothesiser = DistanceHypothesiser(predictor, updater, Mahalanobis(), missed_distance=settings.gate)
    initiator = MultiMeasurementInitiator(
        prior_state=GaussianState([[0.0], [0.0]], np.zeros((2, 2))),
        measurement_model=model,
        deleter=UpdateTimeDeleter(timedelta(seconds=settings.hold_s)),
        data_associator=GNNWith2DAssignment(hypothesiser),
        updater=updater,
        min_points=settings.confirm_hits,
    )
    return MultiTargetTracker(
        initiator=initiator,
        deleter=Never(),
        detector=detections,
        data_associator=NearbyGNN(
            hypothesiser, noise_m=settings.noise_m, drift_m=settings.drift_m, gate=settings.gate
        ),
        updater=updater,
    )
