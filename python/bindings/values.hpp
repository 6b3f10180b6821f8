// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "geoloc/calibration/calibration.hpp"
#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::python {

namespace nb = nanobind;

/// Arrays of NumPy, rows in a line: shapes (N,), and (N, columns).
using Numbers = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Integers = nb::ndarray<const std::int64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
template <int columns>
using Table = nb::ndarray<const double, nb::shape<-1, columns>, nb::c_contig, nb::device::cpu>;

/// Python's ValueError where columns of a table differ in length.
inline void require_rows(std::size_t rows, std::size_t wanted) {
  if (rows != wanted) throw std::invalid_argument("arrays of different lengths");
}

/// NaN stands for what is not told.
inline std::optional<double> unless_nan(double value) {
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

inline Eigen::Vector3d vector3(const double* values) {
  return {values[0], values[1], values[2]};
}

/// Names and what they stand for.
using Fields = nb::typed<nb::dict, nb::str, nb::any>;
using Counts = nb::typed<nb::dict, nb::str, nb::int_>;

/// The bytes of rows, for numpy.frombuffer().
template <typename Row>
nb::bytes bytes_of(const std::vector<Row>& rows) {
  return nb::bytes(rows.data(), rows.size() * sizeof(Row));
}

/// None, or the fields of geoloc.Calibration.
std::optional<Fields> calibration_of(const std::optional<Calibration>& learnt);

/// What came in and what became of it.
Counts counts_of(const Geolocator& geolocator);

/// What `body` returns; what it cannot use becomes Python's ValueError.
template <typename Body>
auto or_value_error(const Body& body) {
  try {
    return body();
  } catch (const std::invalid_argument&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
}

void bind_fleet(nb::module_& module);
void bind_geolocator(nb::module_& module);
void bind_recordings(nb::module_& module);

}  // namespace geoloc::python
