// SPDX-License-Identifier: Apache-2.0
#include "sim/flight_video.hpp"

#include <opencv2/core/mat.hpp>
#include <optional>
#include <stdexcept>

#include "common/progress_line.hpp"
#include "geoloc/io/video/video_file.hpp"
#include "geoloc/sim/live/camera_telemetry.hpp"
#include "geoloc/sim/live/flight_camera.hpp"

namespace geoloc::sim {

void write_flight_video(const std::filesystem::path& file, const Flight& flight, const RunSettings& settings,
                        const std::vector<io::RecordedFrame>& frames, bool has_sei) {
  constexpr int kDistractors = 20;  // as in live runs
  FlightClock clock(flight.truth.span(), 1.0);
  clock.release(flight.host_time(flight.truth.span().begin));
  FlightCamera camera(flight, settings, clock,
                      make_run_scene(make_targets(settings), kDistractors, settings.seed));
  const CameraIntrinsics& size = settings.camera.intrinsics;
  const CameraTelemetry told(flight, clock, size);
  io::VideoFile video(file, {size.width_px, size.height_px}, frames.front().captured_at);
  if (has_sei && !video.takes_telemetry())
    throw std::runtime_error(
        file.string() +
        ": --sei needs H.264, and GStreamer has no x264enc or h264parse: apt-get install "
        "gstreamer1.0-plugins-ugly gstreamer1.0-plugins-bad");
  apps::ProgressLine progress("drawing the video", frames.size());
  cv::Mat bgr;
  std::size_t drawn = 0;
  for (const io::RecordedFrame& frame : frames) {
    camera.render(camera.draw_view(frame.captured_at), bgr);
    std::optional<io::VideoTelemetry> telemetry;
    if (has_sei) telemetry = told.at(frame.captured_at);
    video.add(bgr, frame.captured_at - frames.front().captured_at, telemetry);
    progress.show(++drawn);
  }
  video.finish();
  progress.finish();
}

}  // namespace geoloc::sim
