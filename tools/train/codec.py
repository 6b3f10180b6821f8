# SPDX-License-Identifier: Apache-2.0
"""The effect of a video link on an image: H.264 as a drone's encoder makes it, with blocks and lost grain."""

from fractions import Fraction
from io import BytesIO

import av
import cv2
import numpy as np

FRAMES = 4  # the first is a key frame, the others are predicted; the last one is kept
FRAME_RATE = 30
QUANTIZERS = (20, 41)  # 20: 720p at more than 20 Mbit/s, 41: under 1 Mbit/s
FASTEST_PX = 8.0  # per frame
SHARE_FILMED = 0.75  # of the images; the others are left as they are


def encode(frames: list[np.ndarray], quantizer: int) -> bytes:
    file = BytesIO()
    with av.open(file, "w", format="h264") as video:
        stream = video.add_stream("libx264", rate=Fraction(FRAME_RATE))
        stream.height, stream.width = frames[0].shape[:2]
        stream.pix_fmt = "yuv420p"
        stream.options = {
            "preset": "ultrafast",
            "tune": "zerolatency",
            "qp": str(quantizer),
            "threads": "1",
        }
        for frame in frames:
            video.mux(stream.encode(av.VideoFrame.from_ndarray(frame, format="rgb24")))
        video.mux(stream.encode())
    return file.getvalue()


def last_frame(video: bytes) -> np.ndarray:
    with av.open(BytesIO(video), format="h264") as file:
        return [frame.to_ndarray(format="rgb24") for frame in file.decode(video=0)][-1]


class Film:
    """Draws quality, motion and noise from its seed; an image's place in the sequence decides what it gets."""

    def __init__(self, seed: int, height: int, width: int):
        self._random = np.random.default_rng(seed)
        margin = 64
        self._noise = self._random.standard_normal((height + margin, width + margin, 3), np.float32)
        self._margin = margin

    def _noisy(self, frame: np.ndarray, sigma: float) -> np.ndarray:
        top, left = self._random.integers(self._margin, size=2)
        noise = self._noise[top : top + frame.shape[0], left : left + frame.shape[1]]
        return np.clip(frame + sigma * noise, 0, 255).astype(np.uint8)

    def through(self, picture: np.ndarray) -> np.ndarray:
        """The picture [H, W, 3] (RGB) as the last frame of a short film in which it moves to its place."""
        filmed, quantizer = self._random.random() < SHARE_FILMED, int(self._random.integers(*QUANTIZERS))
        motion, sigma = self._random.uniform(-FASTEST_PX, FASTEST_PX, 2), self._random.uniform(0.0, 5.0)
        if not filmed:
            return picture
        frames = []
        for index in range(FRAMES):
            shift = np.float64([[1, 0, 0], [0, 1, 0]])
            shift[:, 2] = motion * (index + 1 - FRAMES)
            moved = cv2.warpAffine(
                picture, shift, picture.shape[1::-1], flags=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REFLECT
            )
            frames.append(self._noisy(moved, sigma))
        return last_frame(encode(frames, quantizer))
