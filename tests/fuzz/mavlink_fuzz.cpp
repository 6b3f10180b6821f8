// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

#include "geoloc/io/mavlink/camera_component.hpp"
#include "geoloc/io/mavlink/link_guard.hpp"
#include "geoloc/io/mavlink/message_table.hpp"
#include "geoloc/io/mavlink/vehicle_link.hpp"

namespace {

using namespace geoloc;
using namespace std::chrono_literals;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Checks that whatever reaches the estimator is usable, whatever the input.
class DistrustfulSink : public io::TelemetrySink {
 public:
  void on_attitude(const AttitudeSample& sample) override {
    const EulerAngles& angles = sample.angles;
    require(std::isfinite(angles.roll_rad + angles.pitch_rad + angles.yaw_rad));
    require(sample.time.time_since_epoch() >= 0ns);
  }
  void on_position(const PositionSample& sample) override {
    require(is_valid(sample.position));
    require(std::isfinite(sample.height_above_home_m + *sample.height_msl_m));
    require(!sample.sigma_horizontal_m || *sample.sigma_horizontal_m > 0.0);
    require(sample.time.time_since_epoch() >= 0ns);
  }
  void on_range(const RangeSample& sample) override {
    require(sample.distance_m > 0.0 && std::isfinite(sample.distance_m));
  }
  void on_gimbal(const GimbalSample& sample) override {
    require(std::abs(sample.level_from_gimbal.norm() - 1.0) < 1e-6);
    require(sample.time.time_since_epoch() < std::chrono::hours{24 * 366 * 100});
  }
  void on_field_of_view(const FieldOfViewSample& sample) override {
    require(sample.horizontal_rad || sample.vertical_rad);
    for (const auto& angle_rad : {sample.horizontal_rad, sample.vertical_rad})
      require(!angle_rad || (*angle_rad > 0.0 && *angle_rad < 3.15));
    require(sample.time.time_since_epoch() < std::chrono::hours{24 * 366 * 100});
  }
  void on_reboot() override {}
  void on_clock_step(Duration) override {}
  void on_frame(HostTime, const std::uint8_t* frame, std::size_t size) override {
    require(size >= 8 && size <= 280 && (frame[0] == 0xFD || frame[0] == 0xFE));
  }
};

using Bytes = std::vector<std::uint8_t>;

/// A MAVLink 2 frame of the vehicle with the right checksum, which mutations seldom find by themselves.
Bytes checksummed_frame(std::uint16_t message_id, const std::uint8_t* payload, std::size_t size,
                        std::uint8_t component = 1) {
  const std::uint8_t header[] = {0xFD,
                                 static_cast<std::uint8_t>(size),
                                 0,
                                 0,
                                 0,
                                 1,
                                 component,
                                 static_cast<std::uint8_t>(message_id),
                                 static_cast<std::uint8_t>(message_id >> 8U),
                                 0};
  Bytes frame(std::size(header) + size);
  std::copy_n(payload, size, std::copy(std::begin(header), std::end(header), frame.begin()));
  Bytes covered(frame.begin() + 1, frame.end());
  covered.push_back(io::message_spec(message_id)->checksum_seed);
  unsigned crc = 0xFFFF;
  for (const unsigned byte : covered) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0x8408 : crc >> 1;
  }
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
  return frame;
}

/// Reads the input as a list of messages (which one, payload size, payload) and frames them.
Bytes framed(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint16_t kDecoded[] = {0, 2, 24, 30, 31, 33, 76, 77, 111, 158, 193, 230, 265, 285, 260, 271};
  constexpr std::uint8_t kGimbal = 154, kCamera = 100;
  Bytes stream = checksummed_frame(0, reinterpret_cast<const std::uint8_t*>("\0\0\0\0\2\3\0\4\3"), 9);
  for (std::size_t at = 0; at + 2 <= size;) {
    const std::uint16_t message_id = kDecoded[data[at] % std::size(kDecoded)];
    const bool is_camera = message_id == 0 || message_id == 77 || message_id == 260 || message_id == 271;
    const bool is_gimbal = message_id >= 158 && !is_camera;
    const std::uint8_t component = data[at] < 0x80 ? 1 : is_camera ? kCamera : is_gimbal ? kGimbal : 1;
    const std::size_t payload_size = std::min<std::size_t>(data[at + 1], size - at - 2);
    const Bytes frame = checksummed_frame(message_id, data + at + 2, payload_size, component);
    stream.insert(stream.end(), frame.begin(), frame.end());
    at += 2 + payload_size;
  }
  return stream;
}

/// A camera of vehicle 1 with one object in view.
io::CameraComponent camera_at(HostTime now) {
  io::CameraComponent camera(105, CameraIntrinsics{});
  io::CameraView view;
  view.captured_at = now;
  view.targets.push_back({7, {-22.9, -43.1}, 0.5, 12.0, 0.3, 20.0, Eigen::Vector2d(0.5, 0.5)});
  camera.update(view);
  camera.poll(now, io::MavAddress{1, 1}, true, [](const std::uint8_t*, std::size_t) {});
  return camera;
}

void play(const Bytes& stream, std::size_t piece) {
  io::VehicleLink link{io::MavlinkConfig{}};
  DistrustfulSink sink;
  HostTime now{std::chrono::hours{24 * 365 * 57}};
  io::CameraComponent camera = camera_at(now);
  const auto check_sent = [](const std::uint8_t*, std::size_t sent) { require(sent >= 8 && sent <= 280); };
  for (std::size_t at = 0; at < stream.size(); at += piece) {
    link.consume(now, &stream[at], std::min(piece, stream.size() - at), sink);
    link.poll(now, check_sent);
    camera.consume(&stream[at], std::min(piece, stream.size() - at));
    int camera_frames = 0;
    camera.poll(now, io::MavAddress{1, 1}, true, [&](const std::uint8_t* frame, std::size_t sent) {
      check_sent(frame, sent);
      ++camera_frames;
    });
    require(camera_frames <= 40);
    const auto mapped = link.clock().to_vehicle(now);
    require(!mapped || mapped->time_since_epoch() < 0ns || link.clock().to_host(*mapped) == now);
    now += 50ms;
  }
  const io::LinkStatus status = link.status(now);
  require(status.telemetry.vehicle_frames + status.telemetry.foreign_frames == status.frames.frames);
  require(status.frames.junk_bytes <= stream.size());
}

/// The door of a live link: pieces from two sources in turn, with a key and without.
void pass_guard(const Bytes& stream, std::size_t piece) {
  const io::LinkSigning signing(io::SigningKey{}, {});
  for (io::LinkGuard guard : {io::LinkGuard({}), io::LinkGuard({}, signing)}) {
    io::VehicleLink link{io::MavlinkConfig{}};
    DistrustfulSink sink;
    HostTime now{std::chrono::hours{24 * 365 * 57}};
    const auto send = [&](const std::uint8_t* frame, std::size_t size) {
      const io::OutgoingFrame sent = guard.outgoing(now, frame, size);
      require(sent.size == size + (guard.signing_stamps() ? 13 : 0) || frame[0] == 0xFE);
    };
    std::uint64_t admitted = 0;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      io::LinkSource source;
      source.port = static_cast<std::uint16_t>(at / piece % 2);
      guard.receive(now, source, &stream[at], std::min(piece, stream.size() - at),
                    [&](const std::uint8_t* frame, std::size_t size) {
                      ++admitted;
                      require(!guard.signing_stamps() || (frame[2] & 1) != 0);
                      link.consume(now, frame, size, sink);
                    });
      link.poll(now, send);
      now += 50ms;
    }
    require(guard.counts().admitted == admitted && link.status(now).frames.frames == admitted);
  }
}

void read_texts(const Bytes& bytes) {
  const std::string text(bytes.begin(), bytes.end());
  io::parse_signing_key(text);
  const auto stamps = io::parse_signing_stamps(text);
  require(!stamps || io::parse_signing_stamps(io::to_text(*stamps)) == stamps);
}

}  // namespace

/// Fuzzes framing, decoding, the link's state, its answers and those of a camera, and the link's door with
/// its key's and stamps' files. The first byte sets the size of the pieces in which the rest arrives, and
/// whether the rest is raw bytes or messages to be framed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr std::uint8_t kFramedFlag = 0x80;
  const std::size_t piece = 1 + (data[0] & 0x7F);
  const Bytes input(data + 1, data + size);
  const Bytes stream = (data[0] & kFramedFlag) != 0 ? framed(data + 1, size - 1) : input;
  play(stream, piece);
  pass_guard(stream, piece);
  read_texts(input);
  return 0;
}
