// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/io/output/cot_config.hpp"
#include "settings/rules.hpp"

namespace geoloc::io {

/// Letters and digits in groups, as in a-f-G-U-C.
bool is_cot_type(const std::string& text);
bool is_uid_prefix(const std::string& text);

template <class Visitor>
void visit_fields(Visitor& v, CotConfig& cot) {
  constexpr Form kType{&is_cot_type, "a CoT type, such as a-u-G"};
  v.field("uid_prefix", cot.uid_prefix, Form{&is_uid_prefix, "1-32 letters, digits, '-', '_' or '.'"}, "",
          "First part of every object's uid");
  v.field("type", cot.type, kType, "", "CoT type of objects; a-u-G: unknown, on the ground");
  v.field("types", cot.types, kType, "", "CoT types by class name: `{\"car\": \"a-n-G-E-V-C\"}`");
  v.field("period_s", cot.period_s, Range::closed(0.5, 3600), "s",
          "Time after which an object is sent again");
  v.field("stale_s", cot.stale_s, Range::closed(0.5, 86400), "s",
          "Time after its last event at which an object is out of date; at least period_s");
  v.relation("stale_s", cot.stale_s, cot.stale_s >= cot.period_s, "must be at least period_s");
  v.field("sensor_period_s", cot.sensor_period_s, Range::closed(0, 3600), "s",
          "Time after which the vehicle, what its camera sees and the ground at the image's centre are sent "
          "again; 0: they are not sent");
  v.field("vehicle_type", cot.vehicle_type, kType, "",
          "CoT type of the vehicle; a-f-A-M-H-Q: a friendly drone");
  v.field("error_probability", cot.error_probability, Range::closed(0.1, 0.999), "",
          "Probability that ce and le hold the object; 0.9: CE90 and LE90, as ATAK takes them");
  v.field("sigma_height_m", cot.sigma_height_m, Range::above(0, 1000), "m",
          "1-sigma of the ground above sea level");
  v.field("multicast_ttl", cot.multicast_ttl, Range::closed(0, 255), "",
          "Networks that a multicast datagram may cross; 1: our own");
  v.field("multicast_interface", cot.multicast_interface, Any{}, "",
          "Network interface of multicast datagrams, by name; empty: the system chooses");
  v.field("tls_ca_file", cot.tls_ca_file, Any{}, "",
          "Certificates of the authorities by which TLS servers are trusted, PEM or PKCS#12; empty: those of "
          "the system");
  v.field("tls_client_file", cot.tls_client_file, Any{}, "",
          "Our certificate for TLS servers, with its key, PEM or PKCS#12 (.p12); empty: none");
  v.field("tls_key_file", cot.tls_key_file, Any{}, "",
          "Key of our certificate, PEM, where it is in a file of its own");
  v.field("tls_password_file", cot.tls_password_file, Any{}, "",
          "File whose first line is the password of the PKCS#12 files or the key; empty: they have none");
  v.field("tls_server_name", cot.tls_server_name, Any{}, "",
          "Name for which the server must have its certificate; empty: the host of --cot");
}

}  // namespace geoloc::io
