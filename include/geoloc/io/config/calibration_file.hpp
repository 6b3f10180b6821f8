// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "geoloc/calibration/calibration.hpp"

namespace geoloc::io {

/// What an earlier flight learnt of a camera, as the prior of the next: a file of objects (its
/// `calibration`), or that object alone. Boresight, latency and, where it has one, the focal length's error
/// are taken over; height and position offset belong to a flight, and sigma_yaw_deg, the compass' own error
/// of a flight, is added to the boresight about the vertical. Throws std::runtime_error with file and reason.
CalibrationPrior read_calibration(const std::filesystem::path& file, const CalibrationPrior& prior,
                                  double sigma_yaw_deg);

/// The same from the file's text; `name` stands for the file in messages.
CalibrationPrior parse_calibration(const std::string& text, const std::string& name,
                                   const CalibrationPrior& prior, double sigma_yaw_deg);

}  // namespace geoloc::io
