// SPDX-License-Identifier: Apache-2.0
// Metres of the run's frame, pixels of the map, degrees for reading.

const EQUATORIAL_RADIUS_M = 6378137.0;
const ECCENTRICITY_SQUARED = 0.00669437999014;
const RAD = Math.PI / 180;
const REACH = 6; // typical points lie within so many times the median distance from their centre
const LEAST_REACH_M = 60;

/** Degrees [latitude, longitude] of a point, by the ellipsoid's curvature at the anchor: centimetres within a kilometre. */
export function toDegrees(anchor, [east, north]) {
  const { perLatitude, perLongitude } = metresPerDegree(anchor.latitude_deg);
  return [anchor.latitude_deg + (north - anchor.at[1]) / perLatitude,
    anchor.longitude_deg + (east - anchor.at[0]) / perLongitude];
}

/** The inverse: [east, north]. */
export function toMetres(anchor, [latitude, longitude]) {
  const { perLatitude, perLongitude } = metresPerDegree(anchor.latitude_deg);
  return [anchor.at[0] + (longitude - anchor.longitude_deg) * perLongitude,
    anchor.at[1] + (latitude - anchor.latitude_deg) * perLatitude];
}

function metresPerDegree(latitude) {
  const sine = Math.sin(latitude * RAD);
  const root = Math.sqrt(1 - ECCENTRICITY_SQUARED * sine * sine);
  return {
    perLatitude: RAD * EQUATORIAL_RADIUS_M * (1 - ECCENTRICITY_SQUARED) / root ** 3,
    perLongitude: RAD * EQUATORIAL_RADIUS_M * Math.cos(latitude * RAD) / root,
  };
}

/** The way between two points of the run's frame: direction clockwise from north, and distance. */
export function wayTo(from, to) {
  const [east, north] = [to[0] - from[0], to[1] - from[1]];
  return { azimuth_deg: (Math.atan2(east, north) / RAD + 360) % 360, distance_m: Math.hypot(east, north) };
}

const middle = (values) => values.sort((a, b) => a - b)[values.length >> 1];

/** The points without those far from all others: what a single false one would add to a view is left out. */
export function typical(points) {
  if (points.length < 3) return points;
  const centre = [middle(points.map(([x]) => x)), middle(points.map(([, y]) => y))];
  const distances = points.map(([x, y]) => Math.hypot(x - centre[0], y - centre[1]));
  const reach = Math.max(LEAST_REACH_M, REACH * middle([...distances]));
  return points.filter((_, i) => distances[i] <= reach);
}

/** 1, 2 or 5 times a power of ten, not less than `least`. */
export function roundStep(least) {
  const decade = 10 ** Math.floor(Math.log10(least));
  return decade * [1, 2, 5, 10].find((factor) => factor * decade >= least * 0.999999);
}

/** The part of the ground that a map of a given size shows: a centre [m] and a scale [px/m]. */
export class Viewport {
  constructor() {
    this.width = 1;
    this.height = 1;
    this.centre = [0, 0];
    this.scale = 8;
  }

  toScreen([east, north]) {
    return [this.width / 2 + (east - this.centre[0]) * this.scale,
      this.height / 2 - (north - this.centre[1]) * this.scale];
  }

  toGround([x, y]) {
    return [this.centre[0] + (x - this.width / 2) / this.scale, this.centre[1] - (y - this.height / 2) / this.scale];
  }

  pan(dx, dy) {
    this.centre = [this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale];
  }

  /** Keeps the ground under the pixel where it is. */
  zoom(factor, pixel) {
    const before = this.toGround(pixel);
    this.scale = Math.min(5000, Math.max(0.002, this.scale * factor));
    const after = this.toGround(pixel);
    this.centre = [this.centre[0] + before[0] - after[0], this.centre[1] + before[1] - after[1]];
  }

  /** Brings all points into view, with a margin, and clear of the buttons over the right edge. */
  fit(points, toolsWidth) {
    let [west, south, east, north] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const [x, y] of points) {
      west = Math.min(west, x);
      east = Math.max(east, x);
      south = Math.min(south, y);
      north = Math.max(north, y);
    }
    if (west > east) return;
    const margin = Math.min(48, 0.1 * Math.min(this.width, this.height));
    const inner = { width: this.width - 2 * margin - toolsWidth, height: this.height - 2 * margin };
    this.scale = Math.min(200, inner.width / Math.max(4, east - west), inner.height / Math.max(4, north - south));
    this.centre = [(west + east) / 2 + toolsWidth / 2 / this.scale, (south + north) / 2];
  }
}
