// SPDX-License-Identifier: Apache-2.0
#include "page_frames.hpp"

namespace geoloc::io::testing {

ObjectReport page_object(std::uint64_t id) {
  ObjectReport object;
  object.id = id;
  object.class_name = "target";
  object.confidence = 0.99;
  object.hits = 5;
  object.position_in_enu = {0.1 * static_cast<double>(id), 2.0};
  object.position = {1.0, 2.0 + 1e-6 * static_cast<double>(id)};
  object.ellipse = {0.2, 0.1, 30.0};
  return object;
}

OutputFrame page_frame(int number, std::uint64_t objects) {
  OutputFrame frame;
  frame.captured_at = HostTime{std::chrono::milliseconds{1'795'339'800'000 + 100 * number}};
  frame.view.emplace();
  frame.view->vehicle = {1.0, 2.0};
  frame.view->vehicle_in_enu = {0.5 * number, 0.0, 20.0};
  frame.view->yaw_deg = 90.0;
  FixReport fix;
  fix.detection.confidence = 0.8;
  fix.ground.position_in_enu = {0.5 * number, 1.0};
  frame.fixes.push_back(fix);
  for (std::uint64_t id = 1; id <= objects; ++id) frame.objects.push_back(page_object(id));
  return frame;
}

}  // namespace geoloc::io::testing
