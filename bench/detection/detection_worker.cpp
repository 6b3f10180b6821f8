// SPDX-License-Identifier: Apache-2.0
// detection_worker MODEL opencv|openvino THREADS PICTURE: for each number on stdin, searches the picture that
// many times, and answers with the mean time of a search [ms] and the number of objects. For speed.py, which
// takes turns between several.
#include <chrono>
#include <cstdio>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "geoloc/io/detection/yolo_detector.hpp"

namespace {

using namespace geoloc;

int run(const std::string& model, const std::string& backend, int threads, const std::string& picture_file) {
  io::DetectionConfig config;
  config.backend = backend == "openvino" ? io::Backend::kOpenvino : io::Backend::kOpencv;
  config.threads = threads;
  const auto detector = io::open_detector({model, {}}, config);
  const cv::Mat picture = cv::imread(picture_file);
  for (std::string line; std::getline(std::cin, line);) {
    const int looks = std::stoi(line);
    std::size_t found = 0;
    const auto begun = std::chrono::steady_clock::now();
    for (int i = 0; i < looks; ++i) found = detector->detect(picture).size();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
    std::cout << took.count() / looks << ' ' << found << std::endl;
  }
  return detector->counts().failed_images + detector->counts().unusable_images > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  try {
    return run(argv[1], argv[2], std::stoi(argv[3]), argv[4]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "detection_worker: %s\n", error.what());
    return 2;
  }
}
