// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <opencv2/dnn.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "geoloc/io/detection/yolo_decode.hpp"
#include "geoloc/io/detection/yolo_detector.hpp"

// Time per frame of 1280 x 720 with the default model and where it is spent, and the cost of tiles of a large
// picture.
namespace {

using namespace geoloc;

constexpr const char* kModel = GEOLOC_SOURCE_DIR "/data/models/fiducial.onnx";
constexpr const char* kPicture = GEOLOC_SOURCE_DIR "/tests/data/detection/targets.jpg";
constexpr io::ImageSize kPictureSize{1280, 720};

io::ImageSize input_size() {
  return io::YoloDetector{{kModel, {}}, {}}.input_size();
}

cv::Mat letterboxed(const cv::Mat& picture, io::ImageSize input) {
  cv::Mat canvas{input.height_px, input.width_px, CV_8UC3, cv::Scalar::all(114)};
  const io::Letterbox box = io::fit_letterbox(kPictureSize, input);
  cv::Mat target = canvas(cv::Rect{box.left_px, box.top_px, box.scaled.width_px, box.scaled.height_px});
  cv::resize(picture, target, target.size(), 0, 0, cv::INTER_LINEAR);
  return canvas;
}

void detect(benchmark::State& state) {
  const auto detector = io::open_detector({kModel, {}}, {});
  const cv::Mat picture = cv::imread(kPicture);
  for (auto _ : state) benchmark::DoNotOptimize(detector->detect(picture));
}
BENCHMARK(detect)->Unit(benchmark::kMillisecond)->UseRealTime();

void detect_without_second_look(benchmark::State& state) {
  io::YoloDetector detector{{kModel, {}}, {}};
  const cv::Mat picture = cv::imread(kPicture);
  for (auto _ : state) benchmark::DoNotOptimize(detector.detect(picture));
}
BENCHMARK(detect_without_second_look)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A picture of 3840 x 2160 in a grid of tiles.
void detect_in_tiles(benchmark::State& state) {
  io::DetectionConfig config;
  config.tile_columns = config.tile_rows = static_cast<int>(state.range(0));
  const auto detector = io::open_detector({kModel, {}}, config);
  cv::Mat picture;
  cv::resize(cv::imread(kPicture), picture, {3840, 2160});
  for (auto _ : state) benchmark::DoNotOptimize(detector->detect(picture));
}
BENCHMARK(detect_in_tiles)->DenseRange(1, 4)->Unit(benchmark::kMillisecond)->UseRealTime();

void preprocess(benchmark::State& state) {
  const cv::Mat picture = cv::imread(kPicture);
  const io::ImageSize size = input_size();
  cv::Mat input;
  for (auto _ : state) {
    cv::dnn::blobFromImage(letterboxed(picture, size), input, 1.0 / 255.0, {}, {}, true);
    benchmark::DoNotOptimize(input.data);
  }
}
BENCHMARK(preprocess)->Unit(benchmark::kMillisecond)->UseRealTime();

void forward(benchmark::State& state) {
  cv::dnn::Net net = cv::dnn::readNetFromONNX(kModel);
  const cv::Mat input =
      cv::dnn::blobFromImage(letterboxed(cv::imread(kPicture), input_size()), 1.0 / 255.0, {}, {}, true);
  for (auto _ : state) {
    net.setInput(input);
    benchmark::DoNotOptimize(net.forward().data);
  }
}
BENCHMARK(forward)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Decoding with a thousand of 4800 candidates above the threshold: far more than a good network gives.
void decode(benchmark::State& state) {
  constexpr int kCandidates = 4800;
  std::mt19937 random{1};
  std::uniform_real_distribution<float> place{0, 600};
  std::uniform_real_distribution<float> score{0, 0.7F};
  std::vector<float> values(5 * kCandidates);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t row = i / kCandidates;
    values[i] = row < 2 ? place(random) : row < 4 ? 20.0F : score(random);
  }
  constexpr io::ImageSize kInput{640, 384};
  const io::Letterbox box = io::fit_letterbox(kPictureSize, kInput);
  const io::OutputForm form{io::OutputLayout::kYolo11, 1, kCandidates, 5};
  io::DetectionConfig config;
  config.confidence = 0.55;
  for (auto _ : state) {
    benchmark::DoNotOptimize(io::decode_yolo({values.data(), form}, box, kInput, kPictureSize, config));
  }
}
BENCHMARK(decode)->Unit(benchmark::kMillisecond);

}  // namespace
