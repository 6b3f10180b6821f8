// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/klv/klv_sink.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "geoloc/io/klv/klv_target.hpp"
#include "geoloc/io/klv/uas_datalink.hpp"
#include "geoloc/io/output/growing_output.hpp"
#include "udp_sender.hpp"

namespace geoloc::io {

/// Where the packets go. They come from the stream's thread, all else from the sink's.
class KlvSink::Destination {
 public:
  Destination(std::string target, OldFile old_file, TellUser tell)
      : file_("--klv", target, old_file, std::move(tell)) {
    if (const auto receiver = parse_klv_target(target)) network_.emplace(*receiver);
  }

  std::string name() const { return file_.name(); }

  void write(std::string_view packets) {
    if (network_) return network_->send(packets);
    const std::lock_guard lock(mutex_);
    file_.write(packets);
  }

  void sync() {
    const std::lock_guard lock(mutex_);
    file_.sync();
  }

  void finish() {
    const std::lock_guard lock(mutex_);
    file_.finish();
  }

 private:
  std::mutex mutex_;
  GrowingOutput file_;  // never opened where there is a network
  std::optional<UdpSender> network_;
};

KlvSink::KlvSink(std::string target, OldFile old_file, TellUser tell, std::shared_ptr<HeldVideo> video)
    : tell_(tell),
      video_(std::move(video)),
      destination_(std::make_unique<Destination>(std::move(target), old_file, std::move(tell))) {
  TransportStream::require();
}

KlvSink::~KlvSink() = default;

std::string KlvSink::name() const {
  return destination_->name();
}

/// After a step that has failed there are no more: packets would be missing.
template <typename Step>
void KlvSink::attempt(const Step& step) {
  if (has_failed_) return;
  has_failed_ = true;  // unless it comes to its end
  step();
  has_failed_ = false;
}

/// A frame that is none of the video's, as where it was stamped anew, goes with the newest picture.
Duration KlvSink::shown_at(HostTime captured_at) {
  if (video_) return video_->shown_at(captured_at).value_or(newest_);
  if (!first_captured_at_) first_captured_at_ = captured_at;
  return captured_at - *first_captured_at_;
}

void KlvSink::begin(const HeldVideo::Pictures& pictures) {
  if (stream_) return;
  has_video_ = !pictures.empty();
  if (video_ && !has_video_)
    tell_(name() + ": the video is neither H.264 nor H.265, so the metadata is written without it");
  stream_ = std::make_unique<TransportStream>(
      name(), has_video_ ? pictures.front().format : "",
      [destination = destination_.get()](std::string_view packets) { destination->write(packets); });
}

void KlvSink::write(const HeldVideo::Pictures& pictures) {
  if (!has_video_) return;
  for (const EncodedPicture& picture : pictures) {
    stream_->add(picture);
    newest_ = std::max(newest_, picture.shown_at);
  }
}

/// The metadata comes first, so that nothing waits for it.
void KlvSink::on_frame(const OutputFrame& frame) {
  const Duration at = shown_at(frame.captured_at);
  const HeldVideo::Pictures pictures = video_ ? video_->take_through(at) : HeldVideo::Pictures{};
  attempt([&] {
    begin(pictures);
    stream_->add_metadata(uas_datalink_set(frame), at);
    write(pictures);
  });
}

void KlvSink::write_alone(const HeldVideo::Pictures& pictures) {
  if (pictures.empty()) return;
  attempt([&] {
    begin(pictures);
    stream_->none_until(pictures.back().shown_at);
    write(pictures);
  });
}

void KlvSink::on_status(const LiveStatus& /*status*/) {
  if (video_) write_alone(video_->take_overdue());
  if (video_ && video_->take_lost() > 0 && !std::exchange(has_told_loss_, true))
    tell_(name() + ": too slow, pictures are left out");
  attempt([this] { destination_->sync(); });
}

void KlvSink::on_end() {
  if (video_) write_alone(video_->take_all());
  if (!stream_) return;
  attempt([this] {
    stream_->finish();
    destination_->finish();
  });
}

}  // namespace geoloc::io
