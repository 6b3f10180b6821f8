// SPDX-License-Identifier: Apache-2.0
#include <all/mavlink.h>
#include <benchmark/benchmark.h>

#include <cstdint>
#include <random>
#include <vector>

#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "geoloc/io/recording/tlog.hpp"

namespace {

using namespace geoloc;
using Bytes = std::vector<std::uint8_t>;

class NullSink : public io::TelemetrySink {
 public:
  void on_attitude(const AttitudeSample&) override {}
  void on_position(const PositionSample&) override {}
  void on_reboot() override {}
  void on_clock_step(Duration) override {}
  void on_frame(HostTime, const std::uint8_t*, std::size_t) override {}
};

const io::Tlog& flight() {
  static const io::Tlog log = io::read_tlog(GEOLOC_SOURCE_DIR "/data/flights/stock_path1.tlog");
  return log;
}

/// All frames of a flight in sequence, with up to `most_junk` random bytes before each.
Bytes stream(std::size_t most_junk) {
  std::mt19937 random(1);
  Bytes bytes;
  for (const io::TlogRecord& record : flight().records()) {
    for (std::size_t left = most_junk == 0 ? 0 : random() % (most_junk + 1); left > 0; --left) {
      bytes.push_back(static_cast<std::uint8_t>(random()));
    }
    bytes.insert(bytes.end(), record.frame, record.frame + record.size);
  }
  return bytes;
}

void report(benchmark::State& state, const Bytes& bytes, std::int64_t found_a_pass) {
  const auto sent = static_cast<std::int64_t>(flight().records().size());
  state.SetItemsProcessed(state.iterations() * found_a_pass);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
  state.counters["found_percent"] = 100.0 * static_cast<double>(found_a_pass) / static_cast<double>(sent);
}

void BM_FrameParser(benchmark::State& state) {
  const Bytes bytes = stream(static_cast<std::size_t>(state.range(0)));
  std::int64_t found = 0;
  for (auto _ : state) {
    io::FrameParser parser;
    found = 0;
    for (std::size_t at = 0; at < bytes.size();) {
      at += parser.append(&bytes[at], std::min<std::size_t>(1400, bytes.size() - at));
      while (const auto frame = parser.next()) {
        const std::uint8_t* payload = frame->payload;
        benchmark::DoNotOptimize(payload);
        ++found;
      }
    }
  }
  report(state, bytes, found);
}
BENCHMARK(BM_FrameParser)->Arg(0)->Arg(40)->ArgName("junk");

/// The parser of MAVLink's own C library, for comparison.
void BM_MavlinkCLibrary(benchmark::State& state) {
  const Bytes bytes = stream(static_cast<std::size_t>(state.range(0)));
  std::int64_t found = 0;
  for (auto _ : state) {
    mavlink_message_t buffer{}, message{};
    mavlink_status_t parsing{}, status{};
    found = 0;
    for (const std::uint8_t byte : bytes) {
      found += mavlink_frame_char_buffer(&buffer, &parsing, byte, &message, &status) == MAVLINK_FRAMING_OK;
    }
    benchmark::DoNotOptimize(message);
  }
  report(state, bytes, found);
}
BENCHMARK(BM_MavlinkCLibrary)->Arg(0)->Arg(40)->ArgName("junk");

/// Framing, decoding, clock and gates: the whole cost of a datagram with one frame.
void BM_VehicleLink(benchmark::State& state) {
  NullSink sink;
  for (auto _ : state) {
    io::VehicleLink link{io::MavlinkConfig{}};
    for (const io::TlogRecord& record : flight().records()) {
      link.consume(record.received_at, record.frame, record.size, sink);
    }
    benchmark::DoNotOptimize(link.clock().to_vehicle(flight().records().back().received_at));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(flight().records().size()));
}
BENCHMARK(BM_VehicleLink);

}  // namespace
