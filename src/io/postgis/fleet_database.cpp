// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/postgis/fleet_database.hpp"

#include <libpq-fe.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "fleet_rows.hpp"
#include "fleet_tables.hpp"
#include "geoloc/io/endpoint.hpp"
#include "geoloc/io/fleet/summary_file.hpp"

namespace geoloc::io {
namespace {

struct Clear {
  void operator()(PGresult* result) const { PQclear(result); }
};
struct FreeOptions {
  void operator()(PQconninfoOption* options) const { PQconninfoFree(options); }
};
using Answer = std::unique_ptr<PGresult, Clear>;

/// What a server may take for an answer, and a network to say that it is gone.
constexpr std::array<std::pair<const char*, const char*>, 5> kDefaults{
    {{"connect_timeout", "5"},
     {"keepalives_idle", "10"},
     {"tcp_user_timeout", "10000"},
     {"application_name", "geoloc_fuse"},
     {"options", "-c statement_timeout=20000"}}};

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// A parameter of a statement: text, or bytes.
struct Parameter {
  std::string_view value;
  bool is_binary = false;
};

std::string_view cell(const Answer& answer, int row, int column) {
  return {PQgetvalue(answer.get(), row, column),
          static_cast<std::size_t>(PQgetlength(answer.get(), row, column))};
}

std::uint64_t number_in(const Answer& answer, int row, int column) {
  return std::strtoull(PQgetvalue(answer.get(), row, column), nullptr, 10);
}

bool is_here(const std::string& host) {
  return host.empty() || host.front() == '/' || is_loopback(host);
}

}  // namespace

struct FleetDatabase::State {
  struct Finish {
    void operator()(PGconn* its_connection) const { PQfinish(its_connection); }
  };

  State(const std::string& url, std::string its_fleet) : fleet(std::move(its_fleet)) {
    char* reason = nullptr;
    const std::unique_ptr<PQconninfoOption, FreeOptions> options(PQconninfoParse(url.c_str(), &reason));
    if (!options) {
      const std::string words = reason == nullptr ? "no memory" : trimmed(reason);
      PQfreemem(reason);
      throw std::invalid_argument("--postgis: " + words + "; it is postgresql://USER@HOST/DATABASE");
    }
    for (const PQconninfoOption* option = options.get(); option->keyword != nullptr; ++option) {
      if (option->val == nullptr) continue;
      const std::string_view keyword = option->keyword;
      if (keyword == "password")
        throw std::invalid_argument(
            "--postgis: a password does not belong on a command line, where every user of the computer can "
            "read it: put it into ~/.pgpass, or into the environment (PGPASSWORD)");
      settings.emplace_back(keyword, option->val);
      if (keyword == "host") host = option->val;
      if (keyword == "dbname") name = option->val;
    }
    for (const auto& [keyword, value] : kDefaults) {
      const bool is_told =
          std::any_of(settings.begin(), settings.end(),
                      [&, key = keyword](const auto& setting) { return setting.first == key; });
      if (!is_told) settings.emplace_back(keyword, value);
    }
    name = (host.empty() ? "this computer" : host) + "/" + name;
  }

  [[noreturn]] void fail() {
    throw std::runtime_error("--postgis " + name + ": " + trimmed(PQerrorMessage(connection.get())));
  }

  void connect() {
    if (connection && PQstatus(connection.get()) == CONNECTION_OK) return;
    std::vector<const char*> keywords, values;
    for (const auto& [keyword, value] : settings) {
      keywords.push_back(keyword.c_str());
      values.push_back(value.c_str());
    }
    keywords.push_back(nullptr);
    values.push_back(nullptr);
    connection.reset(PQconnectdbParams(keywords.data(), values.data(), 0));
    if (!connection) throw std::runtime_error("--postgis: no memory for a connection");
    if (PQstatus(connection.get()) != CONNECTION_OK) fail();
    PQsetNoticeProcessor(
        connection.get(), [](void*, const char*) {}, nullptr);  // "already exists, skipping"
  }

  Answer checked(PGresult* result) {
    Answer answer(result);
    const ExecStatusType status = PQresultStatus(result);
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK) fail();
    return answer;
  }

  Answer run(const char* statements) { return checked(PQexec(connection.get(), statements)); }

  Answer run(const std::string& statement, const std::vector<Parameter>& parameters,
             bool is_binary_answer = false) {
    std::vector<const char*> values;
    std::vector<int> lengths, formats;
    std::vector<std::string> texts;  // ended as C's are
    texts.reserve(parameters.size());
    for (const Parameter& parameter : parameters) {
      texts.emplace_back(parameter.value);
      values.push_back(texts.back().c_str());
      lengths.push_back(static_cast<int>(parameter.value.size()));
      formats.push_back(parameter.is_binary ? 1 : 0);
    }
    return checked(PQexecParams(connection.get(), statement.c_str(), static_cast<int>(parameters.size()),
                                nullptr, values.data(), lengths.data(), formats.data(),
                                is_binary_answer ? 1 : 0));
  }

  /// All that `step` does, or nothing.
  template <typename Step>
  void in_transaction(const Step& step) {
    connect();
    run("BEGIN");
    try {
      run(kLock, {{fleet}});
      if (!has_tables) make_tables();
      step();
      run("COMMIT");
      has_tables = true;
    } catch (...) {
      const Answer answer(PQexec(connection.get(), "ROLLBACK"));
      throw;
    }
  }

  void make_tables() {
    const Answer extension = run("SELECT 1 FROM pg_extension WHERE extname = 'postgis'");
    if (PQntuples(extension.get()) == 0) run("CREATE EXTENSION postgis");
    run("SELECT pg_advisory_xact_lock(hashtext('geoloc tables'))");
    run(kMakeTables);
  }

  void read_summaries(KeptFleet& kept) {
    const Answer answer =
        run("SELECT flight, summary FROM geoloc.summaries WHERE fleet = $1", {{fleet}}, true);
    for (int row = 0; row < PQntuples(answer.get()); ++row) {
      const std::string flight(cell(answer, row, 0));
      try {
        kept.summaries.push_back(
            summary_from_bytes(cell(answer, row, 1), "--postgis: the summary of " + flight));
      } catch (const std::runtime_error& error) {
        kept.faults.emplace_back(error.what());
      }
    }
  }

  void read_ids(ObjectIds& ids) {
    const Answer answer =
        run("SELECT flight, object::text, id::text FROM geoloc.contributions WHERE fleet = $1", {{fleet}});
    for (int row = 0; row < PQntuples(answer.get()); ++row) {
      const std::uint64_t id = number_in(answer, row, 2);
      ids.of[std::string(cell(answer, row, 0))][number_in(answer, row, 1)] = id;
      ids.next = std::max(ids.next, id + 1);
    }
    const Answer most =
        run("SELECT coalesce(max(id), 0)::text FROM geoloc.objects WHERE fleet = $1", {{fleet}});
    ids.next = std::max(ids.next, number_in(most, 0, 0) + 1);
  }

  std::string fleet;
  std::vector<std::pair<std::string, std::string>> settings;
  std::string host, name;
  std::unique_ptr<PGconn, Finish> connection;
  bool has_tables = false;
  std::string ids_written;  // the last
};

FleetDatabase::FleetDatabase(const std::string& url, std::string fleet)
    : state_(std::make_unique<State>(url, std::move(fleet))) {}
FleetDatabase::~FleetDatabase() = default;
FleetDatabase::FleetDatabase(FleetDatabase&&) noexcept = default;

const std::string& FleetDatabase::name() const {
  return state_->name;
}

bool FleetDatabase::is_exposed() const {
  return state_->connection && PQsslInUse(state_->connection.get()) == 0 && !is_here(state_->host);
}

KeptFleet FleetDatabase::read() {
  KeptFleet kept;
  state_->in_transaction([&] {
    state_->read_summaries(kept);
    state_->read_ids(kept.ids);
  });
  return kept;
}

void FleetDatabase::write(const SummaryOutbox::Summaries& summaries, const RunRecord& run) {
  State& state = *state_;
  const std::string flights = rows_of_flights(run), objects = rows_of_objects(run);
  std::string ids = run.object_ids ? rows_of_ids(*run.object_ids) : "[]";
  state.in_transaction([&] {
    for (const auto& [flight, bytes] : summaries) {
      const std::string sequence = std::to_string(summary_from_bytes(*bytes, flight).identity.sequence);
      state.run(kKeepSummary, {{state.fleet}, {flight}, {sequence}, {*bytes, true}});
    }
    state.run(kKeepFlights, {{state.fleet}, {flights}});
    state.run(std::string(kIncomingObjects) + kNoteChanged, {{state.fleet}, {objects}});
    state.run(std::string(kIncomingObjects) + kKeepObjects, {{state.fleet}, {objects}});
    state.run(kRetractGone, {{state.fleet}, {objects}});
    if (ids != state.ids_written) state.run(kKeepIds, {{state.fleet}, {ids}});
  });
  state.ids_written = std::move(ids);
}

}  // namespace geoloc::io
