// SPDX-License-Identifier: Apache-2.0
#include "import/picture_looks.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/last_words.hpp"
#include "common/progress_line.hpp"
#include "geoloc/io/picture/picture_file.hpp"
#include "import/name_list.hpp"

namespace geoloc::apps {
namespace {

/// Labels that no picture takes.
std::vector<std::string> names_without_picture(const std::vector<Exposure>& exposures,
                                               const io::Labels& labels) {
  std::vector<std::string> there;
  for (const Exposure& exposure : exposures) there.push_back(io::label_key(exposure.file.string()));
  std::sort(there.begin(), there.end());
  std::vector<std::string> names;
  for (const auto& [name, detections] : labels.by_picture) {
    if (!std::binary_search(there.begin(), there.end(), name)) names.push_back(name);
  }
  return names;
}

/// A network that failed saw nothing, which must not count as that nothing was there.
std::vector<Detection> look_at(const std::filesystem::path& file, io::Detector& detector) {
  const std::uint64_t failed_before = detector.counts().failed_images;
  std::vector<Detection> detections = detector.detect(io::read_picture(file));
  if (detector.counts().failed_images > failed_before)
    throw std::runtime_error(file.string() + ": the network failed on it");
  return detections;
}

}  // namespace

PictureLooks labelled_looks(const std::vector<Exposure>& exposures, const io::Labels& labels,
                            const std::string& labels_file) {
  PictureLooks looks;
  const std::vector<std::string> missing = names_without_picture(exposures, labels);
  if (missing.size() == labels.by_picture.size())
    throw std::runtime_error(labels_file + ": none of its pictures is there: " + name_list(missing));
  if (!missing.empty())
    looks.left_out.push_back(labels_file +
                             ": has labels of pictures that are not there: " + name_list(missing));
  for (const Exposure& exposure : exposures) {
    const auto found = labels.by_picture.find(io::label_key(exposure.file.string()));
    looks.by_exposure.push_back(found == labels.by_picture.end() ? std::nullopt
                                                                 : std::optional(found->second));
  }
  return looks;
}

PictureLooks detected_looks(const std::vector<Exposure>& exposures, io::Detector& detector,
                            const StopSignal& stop) {
  PictureLooks looks;
  ProgressLine progress("looking for objects", exposures.size());
  for (const Exposure& exposure : exposures) {
    if (stop.is_requested()) break;
    try {
      looks.by_exposure.emplace_back(look_at(exposure.file, detector));
    } catch (const std::exception& error) {
      looks.by_exposure.emplace_back(std::nullopt);
      looks.left_out.emplace_back(reason_of(error));
    }
    progress.show(looks.by_exposure.size());
  }
  progress.finish();
  return looks;
}

}  // namespace geoloc::apps
