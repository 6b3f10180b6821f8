// SPDX-License-Identifier: Apache-2.0
#include "onnx_network.hpp"

#include <fstream>
#include <iterator>
#include <opencv2/core/utils/logger.hpp>
#include <stdexcept>

#include "geoloc/io/detection/onnx_metadata.hpp"
#include "geoloc/io/detection/yolo_decode.hpp"

namespace geoloc::io {
namespace {

constexpr std::uintmax_t kLargestFile = 2'000'000'000;  // protobuf's own limit is 2 GiB
constexpr std::int64_t kLongestSide = 8192;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& fault) {
  throw std::runtime_error(file.string() + ": " + fault);
}

/// OpenCV logs what it throws; here that is told once, in our words.
class QuietOpencv {
 public:
  QuietOpencv() : level_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietOpencv() { cv::utils::logging::setLogLevel(level_); }
  QuietOpencv(const QuietOpencv&) = delete;
  QuietOpencv& operator=(const QuietOpencv&) = delete;

 private:
  cv::utils::logging::LogLevel level_;
};

std::vector<char> read_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) fail(file, "cannot be read: " + error.message());
  if (size > kLargestFile) fail(file, "too large for an ONNX file");
  std::ifstream stream{file, std::ios::binary};
  std::vector<char> bytes{std::istreambuf_iterator<char>{stream}, {}};
  if (!stream || bytes.empty()) fail(file, "is empty or cannot be read");
  return bytes;
}

std::string shape_text(const std::vector<std::int64_t>& shape) {
  std::string text = "[";
  for (const std::int64_t length : shape) {
    text += (text.size() > 1 ? ", " : "") + (length == kUnknownLength ? "?" : std::to_string(length));
  }
  return text + "]";
}

ImageSize input_size(const std::filesystem::path& file, const OnnxMetadata& metadata) {
  if (metadata.inputs.size() != 1) {
    fail(file, "has " + std::to_string(metadata.inputs.size()) + " inputs; a detector takes one image");
  }
  const auto& shape = metadata.inputs.front().shape;
  const auto is_side = [](std::int64_t length) { return length > 0 && length <= kLongestSide; };
  if (shape.size() == 4 && shape[0] == 1 && shape[1] == 3 && is_side(shape[2]) && is_side(shape[3])) {
    return {static_cast<int>(shape[3]), static_cast<int>(shape[2])};
  }
  fail(file,
       "its input is " + shape_text(shape) +
           "; it must be [1, 3, height, width] with fixed lengths: export again with dynamic=False batch=1");
}

std::string remedy(const std::filesystem::path& file) {
  return "; convert it: python3 tools/onnx_for_opencv.py " + file.string() + " " + file.stem().string() +
         "_opencv.onnx (it takes exports with a fixed input size; of float16 models, export half=False)";
}

/// "load" or "run" failed on an exception of OpenCV's.
[[noreturn]] void fail_in_opencv(const std::filesystem::path& file, const char* action,
                                 const OnnxMetadata& metadata, std::string reason) {
  for (char& c : reason)
    c = c == '\n' ? ' ' : c;  // OpenCV's quote is several lines, each with "> " before it
  reason.erase(0, reason.find_first_not_of("> "));
  reason.erase(reason.find_last_not_of("> ") + 1);
  fail(file, "OpenCV " CV_VERSION " cannot " + std::string{action} + " this model of opset " +
                 std::to_string(metadata.opset) + " (" + reason + ")" + remedy(file));
}

/// Before 4.8 (opencv/opencv#23482), OpenCV ignores the sizes and splits into equal parts: wrong results, not
/// an error.
void check_splits(const std::filesystem::path& file, const OnnxMetadata& metadata) {
  constexpr bool kIgnoresSizes = CV_VERSION_MAJOR < 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR < 8);
  if (!kIgnoresSizes || !metadata.has_split_by_input) return;
  fail_in_opencv(file, "run", metadata, "it does not know Split as of opset 13");
}

cv::dnn::Net load(const std::filesystem::path& file, const std::vector<char>& bytes,
                  const OnnxMetadata& metadata) {
  try {
    return cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
  } catch (const cv::Exception& error) {
    fail_in_opencv(file, "load", metadata, error.err);
  } catch (const std::exception& error) {
    fail_in_opencv(file, "load", metadata, error.what());
  }
}

std::vector<int> output_shape(const std::filesystem::path& file, OnnxNetwork& network,
                              const OnnxMetadata& metadata) {
  try {
    network.net.setInput(cv::Mat{std::vector<int>{1, 3, network.input.height_px, network.input.width_px},
                                 CV_32F, cv::Scalar{0}});
    const cv::Mat output = network.net.forward();
    return {output.size.p, output.size.p + output.dims};
  } catch (const cv::Exception& error) {
    fail_in_opencv(file, "run", metadata, error.err);
  } catch (const std::exception& error) {
    fail_in_opencv(file, "run", metadata, error.what());
  }
}

void check_output(const std::filesystem::path& file, OnnxNetwork& network, const OnnxMetadata& metadata) {
  if (const auto outputs = network.net.getUnconnectedOutLayersNames(); outputs.size() != 1) {
    fail(file, "has " + std::to_string(outputs.size()) +
                   " outputs; a detector has one (segmentation is not supported)");
  }
  const std::vector<int> shape = output_shape(file, network, metadata);
  const bool has_names = network.class_names.has_value();
  const std::size_t rows = has_names ? YoloOutput::kBoxRows + network.class_names->size() : 0;
  const bool fits = shape.size() == 3 && shape[0] == 1 && shape[1] > YoloOutput::kBoxRows &&
                    (has_names ? static_cast<std::size_t>(shape[1]) == rows : shape[1] < shape[2]);
  if (!fits) {
    fail(file, "its output is " + shape_text({shape.begin(), shape.end()}) + ", not [1, " +
                   (has_names ? std::to_string(rows) : "4 + classes") +
                   ", candidates] as of YOLO11 detection models; YOLOv5's layout, exports with nms=True, and "
                   "models for "
                   "segmentation, pose or rotated boxes are not supported");
  }
  network.classes = shape[1] - YoloOutput::kBoxRows;
  network.candidates = shape[2];
}

}  // namespace

OnnxNetwork load_onnx_network(const std::filesystem::path& file) {
  const std::vector<char> bytes = read_file(file);
  const auto metadata = read_onnx_metadata(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  if (!metadata) fail(file, "is not an ONNX file, or is cut short: export with format=onnx");

  OnnxNetwork network;
  network.input = input_size(file, *metadata);
  if (const auto names = metadata->properties.find("names"); names != metadata->properties.end()) {
    network.class_names = parse_class_names(names->second);
  }
  check_splits(file, *metadata);
  const QuietOpencv quiet;
  network.net = load(file, bytes, *metadata);
  check_output(file, network, *metadata);
  return network;
}

std::vector<std::string> read_class_names(const std::filesystem::path& file) {
  std::ifstream stream{file};
  if (!stream) fail(file, "cannot be read");
  std::vector<std::string> names;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    names.push_back(line);
  }
  while (!names.empty() && names.back().empty()) names.pop_back();
  if (names.empty()) fail(file, "names no class; it must have one name a line");
  return names;
}

}  // namespace geoloc::io
