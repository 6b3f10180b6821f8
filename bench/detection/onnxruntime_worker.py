# SPDX-License-Identifier: Apache-2.0
"""onnxruntime_worker.py MODEL THREADS PICTURE: the same task as detection_worker's, done with ONNX Runtime's Python
package and what a Python programmer would put around it: OpenCV's resize, blobFromImage and NMSBoxes, and numpy; the second
look, if the model names one, likewise."""

import sys
import time
from pathlib import Path

import cv2
import numpy as np
import onnxruntime

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools/train"))
from patches import boxes_of, cut, in_batches, judged, normalised, resized, squares_around  # noqa: E402

CONFIDENCE, OVERLAP = 0.8, 0.5  # geoloc's defaults
PROPOSED, MOST_PROPOSED = 0.1, 40  # likewise, for models with a second look


def suppressed(boxes: np.ndarray, scores: np.ndarray, classes: np.ndarray, confidence: float) -> np.ndarray:
    """Indices of the boxes (centre x, y, width, height) that are kept, best first."""
    corners = np.column_stack((boxes[:, :2] - boxes[:, 2:] / 2, boxes[:, 2:]))
    return np.array(cv2.dnn.NMSBoxesBatched(corners, scores, classes, confidence, OVERLAP), int)


class Detector:
    def __init__(self, model: str, threads: int):
        self.options = onnxruntime.SessionOptions()
        self.options.intra_op_num_threads = threads
        self.session = self.open(model)
        self.input = self.session.get_inputs()[0]
        self.canvas = np.full((*self.input.shape[2:], 3), 114, np.uint8)
        second_look = self.session.get_modelmeta().custom_metadata_map.get("geoloc_second_look")
        self.second_look = self.open(str(Path(model).with_name(second_look))) if second_look else None

    def open(self, model: str) -> onnxruntime.InferenceSession:
        return onnxruntime.InferenceSession(model, self.options, providers=["CPUExecutionProvider"])

    def detect(self, picture: np.ndarray) -> np.ndarray:
        """Rows of centre x, y, width, height [px of the picture]."""
        if self.second_look is None:
            return self.look(picture, CONFIDENCE)
        return self.look_again(picture, self.look(picture, PROPOSED)[:MOST_PROPOSED])

    def look(self, picture: np.ndarray, confidence: float) -> np.ndarray:
        scale = min(self.canvas.shape[0] / picture.shape[0], self.canvas.shape[1] / picture.shape[1])
        height, width = (round(length * scale) for length in picture.shape[:2])
        top, left = (self.canvas.shape[0] - height) // 2, (self.canvas.shape[1] - width) // 2
        cv2.resize(picture, (width, height), self.canvas[top : top + height, left : left + width])
        blob = cv2.dnn.blobFromImage(self.canvas, 1 / 255, swapRB=True)
        output = self.session.run(None, {self.input.name: blob})[0][0]
        scores = output[4:].max(0)
        kept = np.flatnonzero(scores >= confidence)
        boxes, scores, classes = output[:4, kept].T, scores[kept], output[4:, kept].argmax(0)
        boxes = boxes[suppressed(boxes, scores, classes, confidence)]
        return (boxes - [left, top, 0, 0]) / scale

    def look_again(self, picture: np.ndarray, boxes: np.ndarray) -> np.ndarray:
        patches = self.second_look.get_inputs()[0]
        squares = squares_around(boxes, picture)
        if not len(squares):
            return boxes

        def answers_to(pixels: np.ndarray) -> np.ndarray:
            return in_batches(pixels, patches.shape[0], lambda part: self.second_look.run(None, {patches.name: part})[0])

        pixels = np.array([normalised(resized(cut(picture, square))[:, :, ::-1]) for square in squares])
        answers = judged(pixels, answers_to)
        answers, squares = answers[answers[:, 0] >= CONFIDENCE], squares[answers[:, 0] >= CONFIDENCE]
        found = boxes_of(answers[:, 1:5], squares)
        return found[suppressed(found, answers[:, 0], np.zeros(len(found), int), CONFIDENCE)]


def main() -> None:
    detector, picture = Detector(sys.argv[1], int(sys.argv[2])), cv2.imread(sys.argv[3])
    cv2.setNumThreads(int(sys.argv[2]))
    for line in sys.stdin:
        looks = int(line)
        begun = time.perf_counter()
        for _ in range(looks):
            found = detector.detect(picture)
        print(1e3 * (time.perf_counter() - begun) / looks, len(found), flush=True)


if __name__ == "__main__":
    main()
