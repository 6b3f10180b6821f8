// SPDX-License-Identifier: Apache-2.0
#pragma once

/// All that onboard software needs of libgeoloc (docs/library.md).
#include "geoloc/camera/camera.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/camera/field_of_view.hpp"
#include "geoloc/fleet/flight_summary.hpp"
#include "geoloc/fleet/fusion.hpp"
#include "geoloc/fleet/object_ids.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/pipeline/frame_outcome.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/pipeline/geolocator_config.hpp"
#include "geoloc/projection/ground_model.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/state/samples.hpp"
#include "geoloc/state/state_provider.hpp"
#include "geoloc/tracking/track.hpp"
