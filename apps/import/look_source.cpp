// SPDX-License-Identifier: Apache-2.0
#include "import/look_source.hpp"

#include <vector>

#include "geoloc/io/text_file.hpp"
#include "import/import_words.hpp"

namespace geoloc::apps {
namespace {

std::vector<io::TrueTarget> true_targets(const std::vector<io::SurveyedMark>& marks) {
  std::vector<io::TrueTarget> targets;
  for (const io::SurveyedMark& mark : marks) {
    io::TrueTarget target;
    target.id = static_cast<int>(targets.size());
    if (!mark.name.empty()) target.id = mark.name;
    target.position = mark.position;
    targets.push_back(target);
  }
  return targets;
}

}  // namespace

std::optional<io::Labels> labels_in(const std::string& labels_file) {
  if (labels_file.empty()) return std::nullopt;
  return io::parse_labels(io::read_text_file(labels_file), labels_file);
}

void open_detector_unless_labelled(const DetectorOptions& options, const DetectorTuning& tuning,
                                   LookSource& source) {
  if (source.labels) return;
  const io::DetectorFiles files = detector_files(options);
  const io::DetectionConfig wanted = detection_of(options, tuning, {});
  source.config = io::with_model_defaults(files, wanted);
  source.detector = io::open_detector(files, source.config);
  const std::string note = confidence_note(options, wanted.confidence, source.config.confidence);
  if (!note.empty()) tell(note);
}

void write_classes_and_truth(const LookSource& source, io::RecordingWriter& writer) {
  if (source.labels && !source.labels->marks.empty()) writer.write_truth(true_targets(source.labels->marks));
  const auto& class_names = source.labels ? source.labels->class_names : source.detector->class_names();
  if (!class_names.empty()) writer.write_class_names(class_names);
}

void tell_next_step(const LookSource& source, std::size_t detections, const std::string& recording) {
  if (source.detector && detections == 0)
    tell(nothing_detected(source.detector->counts(), source.config.confidence));
  tell("next: geoloc_replay " + recording + " --out objects.geojson");
}

}  // namespace geoloc::apps
