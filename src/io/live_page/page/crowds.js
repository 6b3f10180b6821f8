// SPDX-License-Identifier: Apache-2.0
// Where more objects are in view than can be told apart, those that stand close are drawn as one crowd.

const MOST_SINGLE = 1500; // that are drawn one by one
const CELL_PX = 48;
const MARGIN_PX = 20; // beyond the map's edge, where a mark may still reach into it
const LEAST_RADIUS_PX = 10;
const MOST_ROWS = 1e7; // of cells

/** Objects by where on the ground they stand, in cells of CELL_PX at one scale: they lie still while the map is moved. */
export class Cells {
  constructor(objects, scale) {
    Object.assign(this, { objects, scale });
    this.cells = new Map();
    for (const object of objects) {
      const column = Math.floor(object.at[0] * scale / CELL_PX);
      const row = Math.floor(object.at[1] * scale / CELL_PX);
      const key = column * MOST_ROWS + row;
      const cell = this.cells.get(key);
      if (cell) cell.members.push(object);
      else this.cells.set(key, { column, row, members: [object] });
    }
  }

  isOf(objects, scale) {
    return this.objects === objects && this.scale === scale;
  }

  inView(viewport) {
    const [west, north] = viewport.toGround([-MARGIN_PX, -MARGIN_PX]).map((metres) => metres * this.scale / CELL_PX);
    const [east, south] = viewport.toGround([viewport.width + MARGIN_PX, viewport.height + MARGIN_PX])
      .map((metres) => metres * this.scale / CELL_PX);
    return [...this.cells.values()].filter(({ column, row }) =>
      column > west - 1 && column < east && row > south - 1 && row < north);
  }
}

/** The objects in view: those to be drawn one by one, and crowds { at [px], count, radius_px, isConfirmed: whether any of
 * them is }. `isApart(object)`: whether one is drawn by itself, whatever its surroundings. */
export function crowdsOf(cells, viewport, isApart) {
  const inView = cells.inView(viewport);
  const count = inView.reduce((sum, { members }) => sum + members.length, 0);
  if (count <= MOST_SINGLE) return { single: inView.flatMap(({ members }) => members), crowds: [] };
  const isCrowd = ({ members }) => members.length > 1;
  const single = inView.flatMap((cell) => (isCrowd(cell) ? cell.members.filter(isApart) : cell.members));
  return { single, crowds: inView.filter(isCrowd).map((cell) => crowdOf(cell, viewport)) };
}

/** Its disk stays within its cell, so that it covers no other one. */
function crowdOf(cell, viewport) {
  cell.crowd ??= summaryOf(cell.members);
  const { count, mean, isConfirmed } = cell.crowd;
  const radius_px = Math.min(0.5 * CELL_PX - 1, LEAST_RADIUS_PX + 2.2 * Math.log2(count));
  const at = viewport.toScreen([cell.column, cell.row].map((number, axis) => {
    const inset_px = mean[axis] * viewport.scale - number * CELL_PX;
    return (number * CELL_PX + Math.min(CELL_PX - radius_px, Math.max(radius_px, inset_px))) / viewport.scale;
  }));
  return { at, count, radius_px, isConfirmed };
}

function summaryOf(members) {
  const mean = [0, 1].map((axis) => members.reduce((sum, { at }) => sum + at[axis], 0) / members.length);
  return { count: members.length, mean, isConfirmed: members.some(({ confirmed }) => confirmed) };
}

/** Disks with how many objects each stands for. */
export function drawCrowds(pen, crowds) {
  const { context, colours } = pen;
  context.font = `600 14px ${pen.font}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineWidth = 1.5 * pen.weight;
  context.strokeStyle = colours.map;
  for (const { at: [x, y], count, radius_px, isConfirmed } of crowds) {
    context.beginPath();
    context.arc(x, y, radius_px, 0, 2 * Math.PI);
    context.fillStyle = isConfirmed ? colours.object : colours.tentative;
    context.fill();
    context.stroke();
    context.fillStyle = colours.map;
    context.fillText(count < 1000 ? String(count) : `${(count / 1000).toFixed(count < 10000 ? 1 : 0)}k`, x, y);
  }
}
