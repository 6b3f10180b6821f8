// SPDX-License-Identifier: Apache-2.0
#pragma once

// The SQL of a fleet's tables. $1 is the fleet, $2 what is written, as JSON.
namespace geoloc::io {

inline constexpr const char* kMakeTables = R"sql(
CREATE SCHEMA IF NOT EXISTS geoloc;
CREATE TABLE IF NOT EXISTS geoloc.summaries (
  fleet text NOT NULL, flight text NOT NULL, sequence numeric(20) NOT NULL, summary bytea NOT NULL,
  kept_at timestamptz NOT NULL DEFAULT now(), PRIMARY KEY (fleet, flight));
CREATE TABLE IF NOT EXISTS geoloc.flights (
  fleet text NOT NULL, flight text NOT NULL, vehicle text NOT NULL, sequence numeric(20) NOT NULL,
  verdict text NOT NULL, reason text NOT NULL, objects integer NOT NULL, shared_objects integer NOT NULL,
  error_east_m float8 NOT NULL, error_north_m float8 NOT NULL, error_up_m float8 NOT NULL,
  sigma_east_m float8 NOT NULL, sigma_north_m float8 NOT NULL, sigma_up_m float8 NOT NULL, chi2 float8 NOT NULL,
  fused_at timestamptz NOT NULL DEFAULT now(), PRIMARY KEY (fleet, flight));
CREATE TABLE IF NOT EXISTS geoloc.objects (
  fleet text NOT NULL, id bigint NOT NULL, status text NOT NULL, position geography(Point, 4326) NOT NULL,
  class_id integer NOT NULL, class_name text NOT NULL, confidence float8 NOT NULL, hits integer NOT NULL,
  first_seen timestamptz NOT NULL, last_seen timestamptz NOT NULL,
  sigma_major_m float8 NOT NULL, sigma_minor_m float8 NOT NULL, sigma_azimuth_deg float8 NOT NULL,
  variance_east_m2 float8 NOT NULL, covariance_east_north_m2 float8 NOT NULL, variance_north_m2 float8 NOT NULL,
  height_above_home_m float8, sigma_height_m float8, height_msl_m float8, height_ellipsoid_m float8,
  flights text[] NOT NULL, fused_at timestamptz NOT NULL DEFAULT now(), PRIMARY KEY (fleet, id));
CREATE INDEX IF NOT EXISTS objects_position ON geoloc.objects USING gist (position);
CREATE TABLE IF NOT EXISTS geoloc.contributions (
  fleet text NOT NULL, flight text NOT NULL, object numeric(20) NOT NULL, id bigint NOT NULL,
  PRIMARY KEY (fleet, flight, object));
CREATE TABLE IF NOT EXISTS geoloc.history (
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, fleet text NOT NULL, id bigint NOT NULL,
  at timestamptz NOT NULL DEFAULT now(), status text NOT NULL, position geography(Point, 4326) NOT NULL,
  sigma_major_m float8 NOT NULL, sigma_minor_m float8 NOT NULL, sigma_azimuth_deg float8 NOT NULL,
  flights text[] NOT NULL);
CREATE INDEX IF NOT EXISTS history_object ON geoloc.history (fleet, id, number);
)sql";

/// One service at a time writes a fleet; the lock ends with the transaction.
inline constexpr const char* kLock = "SELECT pg_advisory_xact_lock(hashtext('geoloc fleet ' || $1))";

/// $2: flight, $3: sequence number, $4: bytes.
inline constexpr const char* kKeepSummary = R"sql(
INSERT INTO geoloc.summaries AS old (fleet, flight, sequence, summary) VALUES ($1, $2, $3, $4)
ON CONFLICT (fleet, flight) DO UPDATE SET sequence = excluded.sequence, summary = excluded.summary, kept_at = now()
WHERE old.sequence < excluded.sequence
)sql";

inline constexpr const char* kKeepFlights = R"sql(
INSERT INTO geoloc.flights SELECT $1, f.*, now() FROM jsonb_to_recordset($2::jsonb) AS f(
  flight text, vehicle text, sequence numeric, verdict text, reason text, objects integer, shared_objects integer,
  error_east_m float8, error_north_m float8, error_up_m float8, sigma_east_m float8, sigma_north_m float8,
  sigma_up_m float8, chi2 float8)
ON CONFLICT (fleet, flight) DO UPDATE SET vehicle = excluded.vehicle, sequence = excluded.sequence,
  verdict = excluded.verdict, reason = excluded.reason, objects = excluded.objects,
  shared_objects = excluded.shared_objects, error_east_m = excluded.error_east_m,
  error_north_m = excluded.error_north_m, error_up_m = excluded.error_up_m, sigma_east_m = excluded.sigma_east_m,
  sigma_north_m = excluded.sigma_north_m, sigma_up_m = excluded.sigma_up_m, chi2 = excluded.chi2,
  fused_at = now()
)sql";

/// What kNoteChanged and kKeepObjects begin with: the rows as a table.
inline constexpr const char* kIncomingObjects = R"sql(
WITH incoming AS (
  SELECT o.*, ST_SetSRID(ST_MakePoint(longitude_deg, latitude_deg), 4326)::geography AS position,
    ARRAY(SELECT jsonb_array_elements_text(flight_list)) AS flights
  FROM jsonb_to_recordset($2::jsonb) AS o(
    id bigint, longitude_deg float8, latitude_deg float8, class_id integer, class_name text, confidence float8,
    hits integer, first_seen timestamptz, last_seen timestamptz, sigma_major_m float8, sigma_minor_m float8,
    sigma_azimuth_deg float8, variance_east_m2 float8, covariance_east_north_m2 float8, variance_north_m2 float8,
    height_above_home_m float8, sigma_height_m float8, height_msl_m float8, height_ellipsoid_m float8,
    flight_list jsonb))
)sql";

/// A line for what has changed by more than a centimetre, or is of other flights. Before kKeepObjects.
inline constexpr const char* kNoteChanged = R"sql(
INSERT INTO geoloc.history (fleet, id, status, position, sigma_major_m, sigma_minor_m, sigma_azimuth_deg, flights)
SELECT $1, i.id, 'present', i.position, i.sigma_major_m, i.sigma_minor_m, i.sigma_azimuth_deg, i.flights
FROM incoming i LEFT JOIN geoloc.objects o ON o.fleet = $1 AND o.id = i.id
WHERE o.id IS NULL OR o.status <> 'present' OR o.flights <> i.flights
  OR abs(o.sigma_major_m - i.sigma_major_m) > 0.01 OR ST_Distance(o.position, i.position) > 0.01
)sql";

inline constexpr const char* kKeepObjects = R"sql(
INSERT INTO geoloc.objects
SELECT $1, i.id, 'present', i.position, i.class_id, i.class_name, i.confidence, i.hits, i.first_seen, i.last_seen,
  i.sigma_major_m, i.sigma_minor_m, i.sigma_azimuth_deg, i.variance_east_m2, i.covariance_east_north_m2,
  i.variance_north_m2, i.height_above_home_m, i.sigma_height_m, i.height_msl_m, i.height_ellipsoid_m, i.flights,
  now() FROM incoming i
ON CONFLICT (fleet, id) DO UPDATE SET status = excluded.status, position = excluded.position,
  class_id = excluded.class_id, class_name = excluded.class_name, confidence = excluded.confidence,
  hits = excluded.hits, first_seen = excluded.first_seen, last_seen = excluded.last_seen,
  sigma_major_m = excluded.sigma_major_m, sigma_minor_m = excluded.sigma_minor_m,
  sigma_azimuth_deg = excluded.sigma_azimuth_deg, variance_east_m2 = excluded.variance_east_m2,
  covariance_east_north_m2 = excluded.covariance_east_north_m2, variance_north_m2 = excluded.variance_north_m2,
  height_above_home_m = excluded.height_above_home_m, sigma_height_m = excluded.sigma_height_m,
  height_msl_m = excluded.height_msl_m, height_ellipsoid_m = excluded.height_ellipsoid_m,
  flights = excluded.flights, fused_at = excluded.fused_at
)sql";

/// What the map no longer has keeps its line, as retracted.
inline constexpr const char* kRetractGone = R"sql(
WITH gone AS (
  UPDATE geoloc.objects SET status = 'retracted', fused_at = now()
  WHERE fleet = $1 AND status = 'present'
    AND id NOT IN (SELECT o.id FROM jsonb_to_recordset($2::jsonb) AS o(id bigint))
  RETURNING *)
INSERT INTO geoloc.history (fleet, id, status, position, sigma_major_m, sigma_minor_m, sigma_azimuth_deg, flights)
SELECT fleet, id, status, position, sigma_major_m, sigma_minor_m, sigma_azimuth_deg, flights FROM gone
)sql";

inline constexpr const char* kKeepIds = R"sql(
INSERT INTO geoloc.contributions AS old SELECT $1, c.* FROM jsonb_to_recordset($2::jsonb) AS c(
  flight text, object numeric, id bigint)
ON CONFLICT (fleet, flight, object) DO UPDATE SET id = excluded.id WHERE old.id <> excluded.id
)sql";

}  // namespace geoloc::io
