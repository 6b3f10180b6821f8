// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/config/calibration_file.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace geoloc::io {
namespace {

using nlohmann::json;

void read_component(const json& calibration, const char* key, double& value, double& sigma) {
  const auto found = calibration.find(key);
  const auto number = [&](const char* member) {
    if (found == calibration.end() || !found->is_object() || !found->contains(member) ||
        !(*found)[member].is_number())
      throw std::runtime_error(std::string(key) + "." + member + " must be a number");
    return (*found)[member].get<double>();
  };
  value = number("value");
  sigma = number("sigma");
  if (!(sigma > 0.0)) throw std::runtime_error(std::string(key) + ".sigma must be > 0");
}

}  // namespace

CalibrationPrior parse_calibration(const std::string& text, const std::string& name,
                                   const CalibrationPrior& prior, double sigma_yaw_deg) {
  json document = json::parse(text, nullptr, false);
  if (document.is_object() && document.contains("calibration")) document = json(document["calibration"]);
  if (!document.is_object()) {
    throw std::runtime_error(
        name + ": holds no calibration; give a file that --out of a run with --method joint wrote");
  }
  CalibrationPrior learnt = prior;
  try {
    read_component(document, "boresight_x_deg", learnt.boresight_x_deg, learnt.sigma_boresight_x_deg);
    read_component(document, "boresight_y_deg", learnt.boresight_y_deg, learnt.sigma_boresight_y_deg);
    read_component(document, "boresight_z_deg", learnt.boresight_z_deg, learnt.sigma_boresight_z_deg);
    read_component(document, "latency_s", learnt.latency_s, learnt.sigma_latency_s);
    if (document.contains("position_lag_s"))
      read_component(document, "position_lag_s", learnt.position_lag_s, learnt.sigma_position_lag_s);
    if (document.contains("focal_percent"))
      read_component(document, "focal_percent", learnt.focal_percent, learnt.sigma_focal_percent);
    learnt.sigma_boresight_z_deg = std::hypot(learnt.sigma_boresight_z_deg, sigma_yaw_deg);
    for (const std::string& problem : learnt.problems()) throw std::runtime_error(problem);
  } catch (const std::exception& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
  return learnt;
}

CalibrationPrior read_calibration(const std::filesystem::path& file, const CalibrationPrior& prior,
                                  double sigma_yaw_deg) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file.string() + ": cannot be opened");
  return parse_calibration({std::istreambuf_iterator<char>(stream), {}}, file.string(), prior, sigma_yaw_deg);
}

}  // namespace geoloc::io
